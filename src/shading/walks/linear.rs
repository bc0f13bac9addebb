//! Linear interpolation by one addition per pixel.

use super::Walk;
use crate::number::Num;
use crate::shading::walks::values::Values;

/// A varying that is interpolated linearly: its current value and its growth per step.
///
/// ```text
/// I_next = I_current + ΔI        (L21 3.6; for normals L21 4.2)
/// ```
///
/// In `f32` each addition is rounded by at most half a unit in the last place. After k steps the
/// value has an error of at most k · 2⁻²⁴ · max|I|.
#[derive(Clone, Copy, Debug)]
pub struct Linear<V> {
    /// The current value.
    pub at: V,
    /// The growth per step.
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

/// A value that is constant along a span. A pixel costs nothing.
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
