//! Increments: values that are stepped from pixel to pixel, or from block to block.
//!
//! A [`Walk`] gives the value here and steps on. One text serves one pixel at a time and blocks of pixels: a block starts from
//! the values of each of its pixels, with steps a block long.

mod chebyshev;
mod cubic;
mod linear;
mod newton;
mod products;
mod quadratic;
mod rsqrt;
mod sines;
pub(crate) mod values;
pub(crate) mod vertices;

pub use chebyshev::Chebyshev;
pub use cubic::Cubic;
pub use linear::{Constant, Linear};
pub use newton::{Newton, NewtonSteps};
pub(super) use products::products;
pub use quadratic::Quadratic;
pub use rsqrt::{WarmRsqrt, WarmSteps};
pub(super) use sines::LARGEST_ANGLE;
pub use sines::{GreatCircle, Sines};

use crate::number::{Num, Vec3, vec3};
use crate::shading::walks::values::{PerLight, Values};

/// Running state along a span: all memory of the previous pixel.
pub trait Walk<F: Num>: Copy {
    /// The input of a pixel to shading: an entry of the G-buffer.
    type Pixel: Values<F>;
    /// True if the pixel is the interpolated varying itself.
    const LINEAR: bool = false;
    /// True if a pixel needs the pixels before it, and not only the varyings there. Where it does not, SIMD starts a walk at each
    /// block, from varyings that are interpolated over triangles.
    const REMEMBERS: bool = true;

    /// Returns the value here, and steps to the next pixel (or block).
    fn next(&mut self) -> Self::Pixel;
    /// Calls `see` with what the next value is found by and does not show, by name: Newton's guesses, sines. For traces
    /// (`raster/trace/`); several values of one name belong together.
    fn inside(&self, _see: &mut dyn FnMut(&'static str, F)) {}
}

impl<F: Num, A: Walk<F>, B: Walk<F>> Walk<F> for (A, B) {
    type Pixel = (A::Pixel, B::Pixel);
    const REMEMBERS: bool = A::REMEMBERS || B::REMEMBERS;

    #[inline(always)]
    fn next(&mut self) -> Self::Pixel {
        (self.0.next(), self.1.next())
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        self.0.inside(see);
        self.1.inside(see);
    }
}

impl<F: Num, W: Walk<F, Pixel = F>> Walk<F> for [W; 3] {
    type Pixel = Vec3<F>;
    const REMEMBERS: bool = W::REMEMBERS;

    #[inline(always)]
    fn next(&mut self) -> Vec3<F> {
        let [x, y, z] = self;
        vec3([x.next(), y.next(), z.next()])
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        self.iter().for_each(|walk| walk.inside(see));
    }
}

impl<F: Num, W: Walk<F, Pixel = F>, const L: usize> Walk<F> for PerLight<W, L> {
    type Pixel = PerLight<F, L>;
    const REMEMBERS: bool = W::REMEMBERS;

    #[inline(always)]
    fn next(&mut self) -> Self::Pixel {
        let mut pixel = PerLight::new(self.count, self.values[0].next());
        for i in 1..self.len() {
            pixel.values[i] = self.values[i].next();
        }
        pixel
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        self.values[..self.len()]
            .iter()
            .for_each(|walk| walk.inside(see));
    }
}

#[cfg(test)]
mod tests;
