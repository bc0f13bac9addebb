//! The scalar backend: plain `f32`, one pixel at a time, the same bits on every platform.

use super::{MulAdd, Num, Real};

impl MulAdd for f32 {}

impl Num for f32 {
    const WIDTH: usize = 1;
    type One = f32;

    #[inline(always)]
    fn one(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn of_each(self, mut of: impl FnMut(usize) -> f32) -> f32 {
        of(0)
    }

    #[inline(always)]
    fn broadcast(self, x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn sqrt(self) -> f32 {
        // Both are correctly rounded (IEEE 754), so the picture does not depend on which one runs.
        #[cfg(feature = "std")]
        return f32::sqrt(self);
        #[cfg(not(feature = "std"))]
        return libm::sqrtf(self);
    }
    #[inline(always)]
    fn powf(self, exponent: f32) -> f32 {
        libm::powf(self, exponent)
    }
    #[inline(always)]
    fn exp2(self) -> f32 {
        libm::exp2f(self)
    }
    #[inline(always)]
    fn lookup(self, table: &[f32]) -> f32 {
        // A value at the last entry, or a rounding past it, also interpolates between the last two.
        let below = (self as usize).min(table.len() - 2);
        let (low, high) = (table[below], table[below + 1]);
        low + (high - low) * (self - below as f32)
    }
    #[inline(always)]
    fn max(self, least: f32) -> f32 {
        f32::max(self, least)
    }
    #[inline(always)]
    fn gate(self, condition: f32, least: f32) -> f32 {
        if condition > least { self } else { 0.0 }
    }
    #[inline(always)]
    fn any_over(self, least: f32) -> bool {
        self > least
    }
}

impl Real for f32 {
    #[inline(always)]
    fn sin_cos(self) -> (f32, f32) {
        libm::sincosf(self)
    }
    #[inline(always)]
    fn atan2(self, x: f32) -> f32 {
        libm::atan2f(self, x)
    }
    #[inline(always)]
    fn value(self) -> f32 {
        self
    }
}
