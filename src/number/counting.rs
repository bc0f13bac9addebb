//! Numbers that count every operation on them: the machine that checks the papers' operation counts.

use super::{Machine, Num, Real};
use core::ops::{Add, Div, Mul, Neg, Sub};
use core::sync::atomic::{AtomicU32, Ordering};

/// How many operations of each kind were carried out. Changes of sign and copies are not counted.
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
    /// Maxima, minima and gates.
    pub comparisons: u32,
    /// Sines, cosines (a pair counts once) and inverse tangents.
    pub trigonometric: u32,
    /// Powers to an exponent that is not an integer.
    pub powers: u32,
}

impl Sub for Counts {
    type Output = Counts;

    fn sub(self, before: Counts) -> Counts {
        Counts {
            additions: self.additions - before.additions,
            multiplications: self.multiplications - before.multiplications,
            divisions: self.divisions - before.divisions,
            roots: self.roots - before.roots,
            comparisons: self.comparisons - before.comparisons,
            trigonometric: self.trigonometric - before.trigonometric,
            powers: self.powers - before.powers,
        }
    }
}

/// Where the numbers of a [`Counting`] machine write down what is done with them.
#[derive(Debug, Default)]
pub struct Counter([AtomicU32; 7]);

impl Counter {
    /// What was counted so far.
    pub fn counts(&self) -> Counts {
        let [
            additions,
            multiplications,
            divisions,
            roots,
            comparisons,
            trigonometric,
            powers,
        ] = [0, 1, 2, 3, 4, 5, 6].map(|kind: usize| self.0[kind].load(Ordering::Relaxed));
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

    fn note(&self, add: impl FnOnce(&mut Counts)) {
        let mut one = Counts::default();
        add(&mut one);
        let Counts {
            additions,
            multiplications,
            divisions,
            roots,
            comparisons,
            trigonometric,
            powers,
        } = one;
        let all = [
            additions,
            multiplications,
            divisions,
            roots,
            comparisons,
            trigonometric,
            powers,
        ];
        for (sum, more) in self.0.iter().zip(all) {
            sum.fetch_add(more, Ordering::Relaxed);
        }
    }
}

/// The machine of [`Counted`] numbers.
#[derive(Clone, Copy, Debug)]
pub struct Counting<'a>(pub &'a Counter);

/// An `f32` that tells its counter about every operation.
#[derive(Clone, Copy, Debug)]
pub struct Counted<'a> {
    value: f32,
    counter: &'a Counter,
}

impl<'a> Counted<'a> {
    fn with(self, value: f32, add: impl FnOnce(&mut Counts)) -> Self {
        self.counter.note(add);
        Counted {
            value,
            counter: self.counter,
        }
    }
}

impl Add for Counted<'_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.with(self.value + other.value, |c| c.additions += 1)
    }
}

// What counts is not what is computed: a difference adds one to the additions.
#[allow(clippy::suspicious_arithmetic_impl)]
impl Sub for Counted<'_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.with(self.value - other.value, |c| c.additions += 1)
    }
}

#[allow(clippy::suspicious_arithmetic_impl)]
impl Mul for Counted<'_> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.with(self.value * other.value, |c| c.multiplications += 1)
    }
}

#[allow(clippy::suspicious_arithmetic_impl)]
impl Div for Counted<'_> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.with(self.value / other.value, |c| c.divisions += 1)
    }
}

impl Neg for Counted<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Counted {
            value: -self.value,
            counter: self.counter,
        }
    }
}

impl Num for Counted<'_> {
    fn sqrt(self) -> Self {
        self.with(Num::sqrt(self.value), |c| c.roots += 1)
    }
    fn over_sqrt(self) -> Self {
        let root = self.with(Num::sqrt(self.value), |c| c.roots += 1);
        root.with(1.0 / root.value, |c| c.divisions += 1)
    }
    fn max(self, other: Self) -> Self {
        self.with(Num::max(self.value, other.value), |c| c.comparisons += 1)
    }
    fn min(self, other: Self) -> Self {
        self.with(Num::min(self.value, other.value), |c| c.comparisons += 1)
    }
    fn gate(self, condition: Self) -> Self {
        self.with(self.value.gate(condition.value), |c| c.comparisons += 1)
    }
    fn is_over(self, least: Self) -> bool {
        self.with(self.value, |c| c.comparisons += 1).value > least.value
    }
    fn powf(self, exponent: f32) -> Self {
        self.with(Num::powf(self.value, exponent), |c| c.powers += 1)
    }
}

impl Real for Counted<'_> {
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = Real::sin_cos(self.value);
        let sin = self.with(sin, |c| c.trigonometric += 1);
        (
            sin,
            Counted {
                value: cos,
                counter: self.counter,
            },
        )
    }
    fn atan2(self, x: Self) -> Self {
        self.with(Real::atan2(self.value, x.value), |c| c.trigonometric += 1)
    }
    fn value(self) -> f32 {
        self.value
    }
}

impl<'a> Machine for Counting<'a> {
    type One = Counted<'a>;
    type F = Counted<'a>;
    const WIDTH: usize = 1;

    fn one(self, x: f32) -> Counted<'a> {
        Counted {
            value: x,
            counter: self.0,
        }
    }
    fn splat(self, x: Counted<'a>) -> Counted<'a> {
        x
    }
    fn ramp(self, at: Counted<'a>, _step: Counted<'a>) -> Counted<'a> {
        at
    }
    fn stride(self, step: Counted<'a>) -> Counted<'a> {
        step
    }
    fn take(self, mut next: impl FnMut() -> Counted<'a>) -> Counted<'a> {
        next()
    }
    fn first(self, x: Counted<'a>) -> f32 {
        x.value
    }
}
