//! Shading methods: one trait, one table, one file per method.
//!
//! A method says what a vertex carries ([`Carries::vertex`]), how it is stepped along a span ([`Shader::walk`]) and how a pixel is
//! shaded ([`Shader::shade`]), once, for every arithmetic backend. Kernels and engines do all else: positions of lights,
//! perspective, clamping, storing, loops. (Three methods step positions, or quadratics of them, themselves where a light is at a
//! position: `roots/duff_phong.rs`, `quadratics/six_point.rs` and `quadratics/bishop_weimer.rs`.)
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
//! counted, tested and drawn. Two files are descriptions only: `colours/flat_average.rs` runs `Flat`, `roots/fast_phong_rsqrt.rs` runs
//! `DuffPhong<L, true>`. CONTRIBUTING says what a new method needs.
//!
//! Start with `methods/colours/gouraud.rs`, then `methods/roots/fast_phong.rs`, then [`light`], which holds all of equation 2.1.

mod bounds;
mod description;
mod fit;
mod kernels;
mod method;
mod method_table;
mod needs;
mod span_shader;
mod variant;

pub mod light;
pub mod methods;
pub mod walks;

pub use bounds::{Roundings, Stepped};
pub use description::{
    Approximation, Auto, Family, Info, LitAt, Local, MethodParameter, Perspective, Range, Standing,
    Value,
};
pub use fit::{Fit, On};
#[cfg(feature = "simd")]
pub(crate) use kernels::gbuffer_cell::CellLayout;
pub use kernels::operation_counts::OperationCounts;
pub use kernels::runs::{Corner, Corners, Run, Span, SpanPlace};
pub(crate) use kernels::runs::{PolygonConstants, RunList, Starts, ramp};
pub use kernels::sample_span::SpanBench;
#[cfg(feature = "io")]
pub(crate) use kernels::walked::{Walked, WalkedRun};
pub(crate) use kernels::{Extras, Pixels, VertexKernel, Vertices};
pub use kernels::{Kernels, UniformsIndex};
#[cfg(feature = "simd")]
pub(crate) use kernels::{RowColours, ShadeRow, SimdKernels, WalkKernel};
#[cfg(feature = "io")]
pub(crate) use light::LightUniforms;
pub use light::{LightModel, Lit, Seen};
pub use method::{CarriesOf, Chosen, Kinds, Method, OneOf, Visit};
pub use method_table::{METHODS, MethodRow};
pub use needs::{Needs, Spans};
pub use span_shader::{SpanShader, SpanShaderError, SpanVertex};
pub use variant::Variant;
pub use walks::values::{PerLight, Values};
pub use walks::vertices::{
    Carried, Carries, Colour, Normal, NormalAndPlace, ProductsAndNormal, TurnedNormal,
};
pub use walks::{Constant, Linear, Walk};

use crate::number::{Num, Real, Vec3};

/// A shading method: what is computed once per vertex, along a span, and once per pixel.
///
/// Fields are parameters; a method without any derives `Default` and leaves `new` out. Every function must be `#[inline(always)]`: without it a pixel costs 25 times as much.
pub trait Shader: Copy + Default + 'static {
    /// The description of the method. A kind of another method needs only a name: [`Info::of_kind`].
    const INFO: Info;
    /// What it needs of engines.
    const NEEDS: Needs = Needs::PIXELS;
    /// What is set up once per polygon: values, vectors and tuples of them; `()` if nothing is.
    type Constants<F: Num>: Values<F>;
    /// What a vertex carries: a type of `walks/vertices.rs`, or `Self`.
    type Carries: Carries;
    /// The state that is stepped along a span: [`Linear`] if nothing is recurrent. Its [`Walk::Pixel`] is the input of `shade`.
    type Walk<F: Num>: Walk<F>;
    /// The names of the values of [`Walk::Pixel`], in order, for traces: a name that ends in `_i` stands for a value of each light.
    const VALUES: &'static [&'static str] = &[];

    /// Says whether it draws a frame, or spans of a material. It may ask for lights, positions, exponents, and the sides of polygons.
    fn on(_: On<'_>) -> Fit {
        Fit::Draws
    }
    /// Makes the method for `parameters`, in the order of [`Info::parameters`], on a material.
    #[inline(always)]
    fn new(_parameters: &[Value], _model: &LightModel) -> Self {
        Self::default()
    }
    /// Sets up a polygon. With [`Local::PerPolygon`] the light is that at its mean; else call [`Lit::at`] before you ask for
    /// a light or an eye at a position.
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &Lit<'_, R>, _: &Corners<'_, R>) -> Self::Constants<R> {
        Self::Constants::filled(lit.count(), lit.zero())
    }
    /// True if SIMD walks along runs with these parameters, as a pixel needs the pixels before it or its span. Else each block is a
    /// walk of its own, from varyings that are interpolated over triangles, and remembers nothing.
    #[inline(always)]
    fn walks_along_runs(self) -> bool {
        Self::NEEDS.reads_span() || <Self::Walk<f32> as Walk<f32>>::REMEMBERS
    }
    /// Starts a walk. With steps of 0, as a block starts it, it must give what it gives along a run at the same varyings, within the
    /// error that the method allows itself.
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F>;
    /// Returns the colour of a pixel: linear, not yet clamped.
    fn shade<F: Num>(self, lit: &Lit<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F>;
}

/// The input of a pixel to shading: the state of a walk at one pixel.
pub type Pixel<S, F> = <<S as Shader>::Walk<F> as Walk<F>>::Pixel;

/// The varyings of a method, which edges and spans interpolate.
pub type Varying<S, F> = <<S as Shader>::Carries as Carries>::Varying<F>;
