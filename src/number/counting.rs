//! A backend that counts every operation, to check the operation counts of the papers.

use super::{MulAdd, Num, Real};
use core::cell::Cell;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// How many operations of each kind were counted. Changes of sign and copies are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Additions and subtractions.
    pub additions: u32,
    /// Multiplications.
    pub multiplications: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub roots: u32,
    /// Maxima, gates and comparisons.
    pub comparisons: u32,
    /// Sines, cosines (a pair counts once) and inverse tangents.
    pub trigonometric: u32,
    /// Powers to an exponent that is not an integer.
    pub powers: u32,
    /// Values read from a table, interpolated between two entries: two reads, three additions and
    /// one multiplication each.
    pub lookups: u32,
}

/// The counter to which [`Counted`] values report.
#[derive(Debug, Default)]
pub struct Counter(Cell<Counts>);

impl Counter {
    /// Returns the counts since the last call, and starts again from zero.
    pub fn take(&self) -> Counts {
        self.0.take()
    }

    /// Wraps `value` so that every operation on it is counted here.
    pub fn counted(&self, value: f32) -> Counted<'_> {
        Counted {
            value,
            counter: self,
        }
    }
}

/// An `f32` that reports every operation to its counter.
#[derive(Clone, Copy, Debug)]
pub struct Counted<'a> {
    value: f32,
    counter: &'a Counter,
}

impl Counted<'_> {
    /// Counts one operation of this kind and wraps its result.
    fn did(self, kind: fn(&mut Counts) -> &mut u32, value: f32) -> Self {
        let mut counts = self.counter.0.get();
        *kind(&mut counts) += 1;
        self.counter.0.set(counts);
        self.broadcast(value)
    }
}

macro_rules! operator {
    ($($operator:ident $name:ident $kind:ident),*) => { $(
        impl $operator for Counted<'_> {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                self.did(|c| &mut c.$kind, $operator::$name(self.value, other.value))
            }
        }
        impl $operator<f32> for Counted<'_> {
            type Output = Self;
            fn $name(self, other: f32) -> Self {
                self.did(|c| &mut c.$kind, $operator::$name(self.value, other))
            }
        }
    )* };
}
operator!(Add add additions, Sub sub additions, Mul mul multiplications, Div div divisions);

impl Neg for Counted<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.broadcast(-self.value)
    }
}

impl MulAdd for Counted<'_> {}

impl Num for Counted<'_> {
    const WIDTH: usize = 1;
    type One = Self;

    fn one(self, x: f32) -> Self {
        self.broadcast(x)
    }
    fn of_each(self, mut of: impl FnMut(usize) -> Self) -> Self {
        of(0)
    }

    fn broadcast(self, value: f32) -> Self {
        Counted { value, ..self }
    }
    fn sqrt(self) -> Self {
        self.did(|c| &mut c.roots, Num::sqrt(self.value))
    }
    fn powf(self, exponent: f32) -> Self {
        self.did(|c| &mut c.powers, Num::powf(self.value, exponent))
    }
    fn exp2(self) -> Self {
        self.did(|c| &mut c.powers, Num::exp2(self.value))
    }
    fn lookup(self, table: &[f32]) -> Self {
        self.did(|c| &mut c.lookups, Num::lookup(self.value, table))
    }
    fn max(self, least: f32) -> Self {
        self.did(|c| &mut c.comparisons, Num::max(self.value, least))
    }
    fn gate(self, condition: Self, least: f32) -> Self {
        let value = self.value.gate(condition.value, least);
        self.did(|c| &mut c.comparisons, value)
    }
    fn any_over(self, least: f32) -> bool {
        self.did(|c| &mut c.comparisons, self.value).value > least
    }
}

impl Real for Counted<'_> {
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(self.value);
        (self.did(|c| &mut c.trigonometric, sin), self.broadcast(cos))
    }
    fn atan2(self, x: Self) -> Self {
        self.did(|c| &mut c.trigonometric, Real::atan2(self.value, x.value))
    }
    fn value(self) -> f32 {
        self.value
    }
}
