//! Numbers that count every operation on them: what checks the papers' operation counts.

use super::{MulAdd, Num, Real};
use core::ops::{Add, Div, Mul, Neg, Sub};
use core::sync::atomic::{AtomicU32, Ordering};

/// Operations of each kind. Changes of sign and copies are not counted.
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
}

/// The counter that [`Counted`] numbers write to.
#[derive(Debug, Default)]
pub struct Counter([AtomicU32; 7]);

impl Counter {
    /// Returns what was counted since the last call, and starts anew.
    pub fn take(&self) -> Counts {
        let [
            additions,
            multiplications,
            divisions,
            roots,
            comparisons,
            trigonometric,
            powers,
        ] = [0, 1, 2, 3, 4, 5, 6].map(|kind: usize| self.0[kind].swap(0, Ordering::Relaxed));
        Counts {
            additions,
            multiplications,
            divisions,
            roots,
            comparisons,
            trigonometric,
            powers,
        }
    }

    /// Returns `x` as a number that writes to this counter.
    pub fn number(&self, value: f32) -> Counted<'_> {
        Counted {
            value,
            counter: self,
        }
    }
}

/// An `f32` that tells its counter about every operation.
#[derive(Clone, Copy, Debug)]
pub struct Counted<'a> {
    value: f32,
    counter: &'a Counter,
}

/// The entry of [`Counter`] for each kind of operation, in the order of [`Counts`].
const ADDITION: usize = 0;
const MULTIPLICATION: usize = 1;
const DIVISION: usize = 2;
const ROOT: usize = 3;
const COMPARISON: usize = 4;
const TRIGONOMETRIC: usize = 5;
const POWER: usize = 6;

impl Counted<'_> {
    fn did(self, kind: usize, value: f32) -> Self {
        self.counter.0[kind].fetch_add(1, Ordering::Relaxed);
        Counted { value, ..self }
    }
}

macro_rules! operator {
    ($($operator:ident $name:ident $kind:ident),*) => { $(
        impl $operator for Counted<'_> {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                self.did($kind, $operator::$name(self.value, other.value))
            }
        }
        impl $operator<f32> for Counted<'_> {
            type Output = Self;
            fn $name(self, other: f32) -> Self {
                self.did($kind, $operator::$name(self.value, other))
            }
        }
    )* };
}
operator!(Add add ADDITION, Sub sub ADDITION, Mul mul MULTIPLICATION, Div div DIVISION);

impl Neg for Counted<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Counted {
            value: -self.value,
            ..self
        }
    }
}

impl<G> MulAdd<G> for Counted<'_>
where
    Self: Mul<G, Output = Self>,
{
    fn mul_add(self, factor: G, summand: Self) -> Self {
        self * factor + summand
    }
    fn mul_sub(self, factor: G, subtrahend: Self) -> Self {
        self * factor - subtrahend
    }
}

impl Num for Counted<'_> {
    const WIDTH: usize = 1;

    fn like(self, value: f32) -> Self {
        Counted { value, ..self }
    }
    fn sqrt(self) -> Self {
        self.did(ROOT, Num::sqrt(self.value))
    }
    fn rsqrt(self) -> Self {
        self.did(ROOT, 0.0).did(DIVISION, Num::rsqrt(self.value))
    }
    fn powf(self, exponent: f32) -> Self {
        self.did(POWER, Num::powf(self.value, exponent))
    }
    fn max(self, least: f32) -> Self {
        self.did(COMPARISON, Num::max(self.value, least))
    }
    fn gate(self, condition: Self, least: f32) -> Self {
        self.did(COMPARISON, self.value.gate(condition.value, least))
    }
    fn any_over(self, least: f32) -> bool {
        self.did(COMPARISON, self.value).value > least
    }
}

impl Real for Counted<'_> {
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(self.value);
        (self.did(TRIGONOMETRIC, sin), self.like(cos))
    }
    fn atan2(self, x: Self) -> Self {
        self.did(TRIGONOMETRIC, Real::atan2(self.value, x.value))
    }
    fn value(self) -> f32 {
        self.value
    }
}
