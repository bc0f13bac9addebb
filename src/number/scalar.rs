//! Plain `f32`, one pixel at a time.

use super::{Int, Lanes, Machine, Num, Real};
use crate::encoding::{quantise, quantise_level};

/// The scalar machine: `f32` throughout. Its pictures are the same bits on every platform.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scalar;

impl Num for f32 {
    #[inline(always)]
    fn sqrt(self) -> f32 {
        // Both are correctly rounded (IEEE 754), so the picture does not depend on which one runs.
        #[cfg(feature = "std")]
        return f32::sqrt(self);
        #[cfg(not(feature = "std"))]
        return libm::sqrtf(self);
    }

    #[inline(always)]
    fn over_sqrt(self) -> f32 {
        1.0 / Num::sqrt(self)
    }

    #[inline(always)]
    fn max(self, other: f32) -> f32 {
        f32::max(self, other)
    }

    #[inline(always)]
    fn min(self, other: f32) -> f32 {
        f32::min(self, other)
    }

    #[inline(always)]
    fn gate(self, condition: f32) -> f32 {
        if condition > 0.0 { self } else { 0.0 }
    }

    #[inline(always)]
    fn is_over(self, least: Self) -> bool {
        self > least
    }

    #[inline(always)]
    fn powf(self, exponent: f32) -> f32 {
        libm::powf(self, exponent)
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

impl Int for i32 {
    #[inline(always)]
    fn min(self, other: i32) -> i32 {
        Ord::min(self, other)
    }

    #[inline(always)]
    fn max(self, other: i32) -> i32 {
        Ord::max(self, other)
    }

    #[inline(always)]
    fn whole_pixels(self) -> i32 {
        self >> 8
    }

    #[inline(always)]
    fn less(self, other: i32) -> i32 {
        -i32::from(self < other)
    }
}

impl Machine for Scalar {
    type One = f32;
    type F = f32;
    const WIDTH: usize = 1;

    #[inline(always)]
    fn one(self, x: f32) -> f32 {
        x
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32 {
        x
    }

    #[inline(always)]
    fn ramp(self, at: f32, _step: f32) -> f32 {
        at
    }

    #[inline(always)]
    fn stride(self, step: f32) -> f32 {
        step
    }

    #[inline(always)]
    fn take(self, mut next: impl FnMut() -> f32) -> f32 {
        next()
    }

    #[inline(always)]
    fn first(self, x: f32) -> f32 {
        x
    }
}

impl Lanes for Scalar {
    type Mask = bool;
    type I = i32;
    const IS_ONE_REGISTER: bool = true;

    #[inline(always)]
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T {
        work()
    }

    #[inline(always)]
    fn load(self, from: &[f32]) -> f32 {
        from[0]
    }

    #[inline(always)]
    fn store(self, x: f32, to: &mut [f32]) {
        to[0] = x;
    }

    #[inline(always)]
    fn lanes(self, from: usize, to: usize) -> bool {
        from < 1 && to > 0
    }

    #[inline(always)]
    fn less(self, a: f32, b: f32) -> bool {
        a < b
    }

    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
    }

    #[inline(always)]
    fn blend(self, mask: bool, new: f32, old: f32) -> f32 {
        if mask { new } else { old }
    }

    #[inline(always)]
    fn kept(self, outside: i32, new: f32, old: f32) -> i32 {
        if outside >= 0 && new < old { 0 } else { -1 }
    }

    #[inline(always)]
    fn keep(self, kept: i32, old: f32, new: f32) -> f32 {
        if kept == 0 { new } else { old }
    }

    #[inline(always)]
    fn bits(self, mask: bool) -> u32 {
        u32::from(mask)
    }

    #[inline(always)]
    fn int(self, x: i32) -> i32 {
        x
    }

    #[inline(always)]
    fn counted(self) -> i32 {
        0
    }

    #[inline(always)]
    fn load_int(self, from: &[i32]) -> i32 {
        from[0]
    }

    #[inline(always)]
    fn store_int(self, x: i32, to: &mut [i32]) {
        to[0] = x;
    }

    #[inline(always)]
    fn number(self, x: i32) -> f32 {
        x as f32
    }

    #[inline(always)]
    fn truncated(self, x: f32) -> i32 {
        x as i32
    }

    #[inline(always)]
    fn not_negative(self, x: i32) -> bool {
        x >= 0
    }

    #[inline(always)]
    fn pack(self, rgb: [f32; 3], covered: bool, background: [u8; 4], to: &mut [[u8; 4]]) {
        let [r, g, b] = rgb.map(quantise);
        to[0] = if covered { [r, g, b, 255] } else { background };
    }

    #[inline(always)]
    fn pack_levels(self, levels: [f32; 3], covered: bool, background: [u8; 4], to: &mut [[u8; 4]]) {
        let [r, g, b] = levels.map(quantise_level);
        to[0] = if covered { [r, g, b, 255] } else { background };
    }
}
