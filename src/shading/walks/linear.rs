//! Linear interpolation by one addition per pixel.

use super::Walk;
use crate::number::Num;
use crate::shading::walks::values::Values;

/// A varying that is interpolated linearly: its value here, and its growth in a step.
///
/// ```text
/// I_next = I_current + ΔI        (L21 3.6; for normals L21 4.2)
/// ```
///
/// In `f32` each addition is off by at most half a unit in the last place, so that after k steps the value is off by at most
/// k · 2⁻²⁴ · max|I|.
#[derive(Clone, Copy, Debug)]
pub struct Linear<V> {
    /// The value here.
    pub at: V,
    /// The growth in a step.
    pub step: V,
}

impl<F: Num, V: Values<F>> Walk<F> for Linear<V> {
    type Pixel = V;
    const LINEAR: bool = true;
    const REMEMBERS: bool = false;

    #[inline(always)]
    fn next(&mut self) -> V {
        let here = self.at;
        self.at.zip(self.step, |at, step| at + step); // 3.6, 4.2
        here
    }
}

/// A value that stays: no operation a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Constant<V>(pub V);

impl<F: Num, V: Values<F>> Walk<F> for Constant<V> {
    type Pixel = V;
    const LINEAR: bool = true;
    const REMEMBERS: bool = false;

    #[inline(always)]
    fn next(&mut self) -> V {
        self.0
    }
}
