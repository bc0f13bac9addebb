//! Plain `f32`, one pixel at a time.

use super::{Machine, Num, Real};

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
