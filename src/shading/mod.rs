//! Shading methods: one trait, one table, one file per method.
//!
//! A method says what a vertex carries ([`Shader::vertex`]), how it is stepped along a span ([`Shader::walk`]) and how a pixel is
//! shaded ([`Shader::shade`]), once, for every arithmetic backend. Kernels and engines do all else: positions of lights,
//! perspective, clamping, storing, loops. (Duff's method alone steps positions itself.)
//!
//! ```text
//! vertex ──► Varying ──► edges, spans ──► Walk ──► Pixel ──► shade ──► colour
//!   once per vertex       interpolated     stepped from       a pure function
//!                                          pixel to pixel
//! ```
//!
//! **All memory of the previous pixel is in the walk.** So an engine may interpolate a row now and shade it later, in blocks, or on
//! another thread, and no method changes. [`Kernels`] is a method compiled: a table of plain functions, which engines
//! call once per row, batch of runs or range of vertices. [`METHODS`] lists all methods: each is rendered, compared, timed,
//! counted, tested and drawn. Two of them are other names for the kernels of a file: `flat_average.rs` for those of `flat.rs`,
//! `fast_phong_rsqrt.rs` for those of `duff_phong.rs`. CONTRIBUTING says what a new method needs.
//!
//! Start with `gouraud.rs`, then `fast_phong.rs`, then [`lighting`], which holds all of equation 2.1.

mod bound;
mod count;
pub(crate) mod extent;
mod info;
mod kernels;
mod span_bench;
mod spread;
mod table;
mod variant;

pub mod increments;
pub mod lighting;
pub mod varying;

mod duff_phong;
mod fast_phong;
mod fast_phong_rsqrt;
mod flat;
mod flat_average;
mod gouraud;
mod gouraud_separate;
mod naive_phong;
mod phong_rsqrt;
mod planes;
mod slerp_phong;
mod slerp_phong_vector;

pub use bound::{Roundings, Stepped};
pub use count::OperationCounts;
pub use increments::{Constant, Linear, Walk};
pub use info::{Auto, Info, LitAt, Local, MethodParameter, Perspective};
pub(crate) use kernels::{Extras, Pixels, VertexKernel, Vertices, ramp};
pub use kernels::{Kernels, Run, Span, UniformsIndex};
#[cfg(feature = "simd")]
pub(crate) use kernels::{RowColours, ShadeRow, SimdKernels, WalkKernel, start_len};
pub use lighting::{LightModel, Lit, Seen};
pub use planes::{PerLight, Planes};
pub use span_bench::SpanBench;
pub use table::{Entry, METHODS};
pub use variant::Variant;
pub use varying::{UnitNormal, Varying};

use crate::number::{Num, Vec3};

/// A shading method: what is computed once per vertex, along a span, and once per pixel.
///
/// Fields are parameters; a method without any derives `Default` and leaves `new` out. Every function must be `#[inline(always)]`: without it a pixel costs 25 times as much.
pub trait Shader: Copy + Default + 'static {
    /// The description of the method.
    const INFO: Info;
    /// True if `vertex` returns the normal unchanged: engines then read the frame's normals and skip the vertex pass.
    const PASSES_NORMAL: bool = false;
    /// The varyings of a vertex, which spans interpolate: numbers, vectors and tuples of them, or a [`UnitNormal`].
    type Varying<F: Num>: Varying<F>;
    /// The state that is stepped along a span: [`Linear`] if nothing is recurrent. Its [`Walk::Pixel`] is the input of `shade`.
    type Walk<F: Num>: Walk<F>;

    /// Makes the method for `parameters`, in the order of [`Info::parameters`], on a material.
    #[inline(always)]
    fn new(_parameters: &[u32], _model: &LightModel) -> Self {
        Self::default()
    }
    /// Returns the varyings of a vertex with the unit normal `n`; once per polygon for methods that are lit there.
    fn vertex<F: Num>(self, lit: &Lit<'_, F>, n: Vec3<F>) -> Self::Varying<F>;
    /// Starts the walk along a span.
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<Self, F>) -> Self::Walk<F>;
    /// Returns the colour of a pixel: linear, not yet clamped.
    fn shade<F: Num>(self, lit: &Lit<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F>;
}

/// The input of a pixel to shading: the state of a walk at one pixel.
pub type Pixel<S, F> = <<S as Shader>::Walk<F> as Walk<F>>::Pixel;
