//! Recurrences that are stepped along a span, from pixel to pixel or from block to block.
//!
//! A [`Walk`] returns the value at the current pixel and steps to the next one. Tuples, arrays of
//! three and [`PerLight`] of walks are walks too, so a method combines them:
//!
//! | walk | steps | a pixel costs |
//! |---|---|---|
//! | [`Linear`] | varyings (L21 3.6, 4.2) | one addition per value |
//! | [`Constant`] | nothing | nothing |
//! | [`Quadratic`] | products of two linear vectors, by forward differences | two additions |
//! | [`Newton`] | **fast Phong's root**: \|N\| from the pixel before (L21 4.4) | a division per step |
//! | [`GreatCircle`] | unit normals along great circles (L21 4.7–4.12) | eight products for the sines, and two per value |
//! | [`Chebyshev`] | sines and cosines from two values | two additions and a product per value |
//!
//! Your own method uses them as the built-in methods do. This is the lecture's fast Phong shading,
//! with two steps of Newton's method per pixel:
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::number::{Num, Vec3};
//! use fastphong::scene::Scene;
//! use fastphong::shading::walks::{Linear, Newton, NewtonSteps};
//! use fastphong::shading::{
//!     Info, LightAt, LightModel, MethodRow, Needs, PerLight, Pixel, ProductsAndNormal, Shader, Span, Value, methods,
//! };
//!
//! /// Fast Phong shading for up to `L` lights.
//! #[derive(Clone, Copy, Default)]
//! struct Mine<const L: usize> {
//!     steps: NewtonSteps,
//! }
//!
//! impl<const L: usize> Shader for Mine<L> {
//!     const INFO: Info = Info { name: "mine", ..Info::OF_PIXELS };
//!     const NEEDS: Needs = Needs::PIXELS_BY_POLYGON;
//!     type Constants<F: Num> = ();
//!     type Carries = ProductsAndNormal<L>;
//!     type Walk<F: Num> = (Linear<(PerLight<F, L>, F)>, Newton<F>);
//!
//!     #[inline(always)]
//!     fn new(_: &[Value], _: &LightModel) -> Self {
//!         Mine { steps: NewtonSteps::new(2, NewtonSteps::LARGEST_ERROR) }
//!     }
//!     #[inline(always)]
//!     fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
//!         let Linear { at: (at, n), step: (step, dn) } = span.linear();
//!         (Linear { at, step }, Newton::new(n, dn, &self.steps))
//!     }
//!     #[inline(always)]
//!     fn shade<F: Num>(self, lit: &LightAt<'_, F>, ((j, k), (d, square)): Pixel<Self, F>) -> Vec3<F> {
//!         let (over_d, twice_k) = (d.broadcast(1.0) / d, k * 2.0 / square);
//!         let mut colour = lit.ambient();
//!         for light in lit.lights() {
//!             let j = j.values[light.index];
//!             colour = lit.add(colour, &light, j * over_d, twice_k * j - light.l_v);
//!         }
//!         colour
//!     }
//! }
//!
//! static MINE: MethodRow = MethodRow::by_lights::<Mine<1>, Mine<4>, Mine<64>>();
//! let mut scene = Scene::of_mesh(builtin("torus")?);
//! (scene.width, scene.height) = (96, 72);
//! let frame = scene.frame()?;
//! let built_in = methods::FAST_PHONG.variant().with("steps", 2)?;
//! assert_eq!(MINE.variant().render(&frame)?, built_in.render(&frame)?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Inside
//!
//! | walk | file |
//! |---|---|
//! | `Linear`, `Constant` | `linear.rs` |
//! | `Quadratic` | `quadratic.rs` |
//! | `Cubic`: cubics along spans, by three additions per value | `cubic.rs` |
//! | `Newton`, whose iteration is `Newton::root` | `newton.rs` |
//! | `WarmRsqrt`: 1/√D from the pixel before, by three products and a sum per step | `rsqrt.rs` |
//! | `Sines`, `GreatCircle` | `sines.rs` |
//! | `Chebyshev` | `chebyshev.rs` |
//!
//! The same code steps one pixel at a time or a block: in a block, lane k starts at pixel k and
//! steps are a block long ([`Span`](crate::shading::Span)). To add a recurrence, write its closed
//! form into `tests.rs` and derive its drift.

mod chebyshev;
mod cubic;
mod linear;
mod newton;
mod products;
mod quadratic;
mod rsqrt;
#[doc(hidden)]
pub mod sines;
pub(crate) mod values;
pub(crate) mod vertices;

pub use chebyshev::Chebyshev;
pub(crate) use cubic::Cubic;
pub use linear::{Constant, Linear};
pub use newton::{Newton, NewtonSteps};
pub(super) use products::products;
pub use quadratic::Quadratic;
pub(crate) use rsqrt::{WarmRsqrt, WarmSteps};
pub use sines::GreatCircle;
pub(crate) use sines::LARGEST_ANGLE;

use crate::number::{Num, Vec3, vec3};
use crate::shading::walks::values::{PerLight, Values};

/// A running state along a span. All memory of the previous pixel is here.
///
/// [`Shader::walk`](crate::shading::Shader::walk) makes one at the first pixel; a kernel then calls
/// [`Walk::next`] once per pixel or block and passes the result to
/// [`Shader::shade`](crate::shading::Shader::shade), at once or later.
pub trait Walk<F: Num>: Copy {
    /// The input of a pixel to shading. The row engine stores it in the G-buffer.
    type Pixel: Values<F>;
    /// True if the pixel is the interpolated varying itself. Engines may then compute it without a
    /// walk.
    const LINEAR: bool = false;
    /// True if a pixel needs the pixels before it, and not only the varyings there. If false, SIMD
    /// starts a walk at each block, from varyings that are interpolated over triangles.
    const REMEMBERS: bool = true;

    /// Returns the value at the current pixel (or block), and steps to the next.
    fn next(&mut self) -> Self::Pixel;
    /// Calls `see` with the intermediate values of the next pixel that `next` does not return, by
    /// name: Newton's guesses, sines. Values of one name belong together. Only traces
    /// (`raster/trace/`) call it.
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
        // The first light's value also fills the places after the last light, which nothing reads.
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
