//! Linear interpolation by one addition a pixel.

use super::Walk;
use crate::number::{Machine, Num};

/// A value that grows by the same amount from pixel to pixel.
///
/// ```text
/// I_next = I_current + ΔI        (L21 3.6; for normals L21 4.2)
/// ```
///
/// One addition a pixel. In `f32` each addition is off by at most half a unit in the last place, so that after k steps
/// the value is off by at most k · 2⁻²⁴ · max|I|.
#[derive(Clone, Copy, Debug)]
pub struct Linear<F> {
    at: F,
    step: F,
}

impl<F: Num> Linear<F> {
    /// Starts at `at` on the first pixel and grows by `step` a pixel.
    #[inline(always)]
    pub fn new<M: Machine<F = F>>(m: M, at: M::One, step: M::One) -> Self {
        Linear {
            at: m.ramp(at, step),
            step: m.stride(step),
        }
    }
}

impl<F: Num> Walk for Linear<F> {
    type Out = F;

    #[inline(always)]
    fn next(&mut self) -> F {
        let here = self.at;
        self.at = here + self.step; // 3.6, 4.2
        here
    }
}

/// A value that stays: no operation a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Constant<T>(pub T);

impl<T: Copy> Walk for Constant<T> {
    type Out = T;

    #[inline(always)]
    fn next(&mut self) -> T {
        self.0
    }
}
