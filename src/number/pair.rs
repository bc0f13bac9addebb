//! Two groups of pixels at a time: what one waits for, the other fills.

use super::Num;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Two numbers that go the same way. Shading a group of pixels is a chain of results that wait for one another, longer than a
/// processor looks ahead; with a second chain beside it, it has something to do meanwhile, and decisions and constants serve
/// both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<F>(pub F, pub F);

impl<F: Num> Add for Pair<F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Pair(self.0 + other.0, self.1 + other.1)
    }
}

impl<F: Num> Sub for Pair<F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Pair(self.0 - other.0, self.1 - other.1)
    }
}

impl<F: Num> Mul for Pair<F> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Pair(self.0 * other.0, self.1 * other.1)
    }
}

impl<F: Num> Div for Pair<F> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Pair(self.0 / other.0, self.1 / other.1)
    }
}

impl<F: Num> Neg for Pair<F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Pair(-self.0, -self.1)
    }
}

impl<F: Num> Num for Pair<F> {
    #[inline(always)]
    fn sqrt(self) -> Self {
        Pair(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn over_sqrt(self) -> Self {
        Pair(self.0.over_sqrt(), self.1.over_sqrt())
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        Pair(
            self.0.mul_add(factor.0, summand.0),
            self.1.mul_add(factor.1, summand.1),
        )
    }
    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        Pair(
            self.0.mul_sub(factor.0, subtrahend.0),
            self.1.mul_sub(factor.1, subtrahend.1),
        )
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Pair(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Pair(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn gate(self, condition: Self) -> Self {
        Pair(self.0.gate(condition.0), self.1.gate(condition.1))
    }
    #[inline(always)]
    fn is_over(self, least: Self) -> bool {
        self.0.max(self.1).is_over(least.0)
    }
    #[inline(always)]
    fn powf(self, exponent: f32) -> Self {
        Pair(self.0.powf(exponent), self.1.powf(exponent))
    }
}
