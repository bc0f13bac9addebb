//! Shading methods: choose one, draw with it, or write your own.
//!
//! A [`Variant`] is a method with values for its parameters. Take one from [`methods`], or parse
//! what a user wrote; it is small, and you keep it from frame to frame.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::raster::Renderer;
//! use fastphong::scene::Scene;
//! use fastphong::shading::{Variant, methods};
//!
//! let mut scene = Scene::of_mesh(builtin("teapot?res=4")?);
//! (scene.width, scene.height) = (64, 48);
//! let frame = scene.frame()?;
//! // By name, with a parameter:
//! let lecture = methods::FAST_PHONG.variant().with("steps", 2)?;
//! assert_eq!(lecture, "fast-phong:steps=2".parse::<Variant>()?);
//! let picture = lecture.render(&frame)?;
//! // Or the method that is usually the fastest with Phong's picture, for this frame and engine:
//! let (method, why) = Variant::auto(&frame, Renderer::default());
//! println!("{method}: {why}");
//! let same_shape = method.render(&frame)?;
//! assert!(picture.pixels().iter().zip(same_shape.pixels()).all(|(a, b)| a[3] == b[3]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | to | use |
//! |---|---|
//! | draw frames | [`Variant::render`], [`Variant::draw`] |
//! | shade the spans of your own rasterizer | [`SpanShader`], which you keep for each material; it reuses its memory |
//! | know how far a picture can be from the closed form | [`Variant::bound`] |
//! | count the operations of a pixel | [`Variant::operations`] |
//! | write a method | [`Shader`], [`walks`], [`light`] |
//!
//! # Inside
//!
//! Each method is one file below `methods/` and implements one trait, [`Shader`]. Three functions
//! do its work:
//! - [`Carries::vertex`] computes the *varyings* of a vertex, which edges and spans interpolate;
//! - [`Shader::walk`] starts a *walk*, which steps along a span from pixel to pixel;
//! - [`Shader::shade`] computes the colour of a pixel from the state of the walk there.
//!
//! ```text
//! vertex ──► Varying ──► edges, spans ──► Walk ──► Pixel ──► shade ──► colour
//!   once per vertex       interpolated     stepped from       a pure function
//!                                          pixel to pixel
//! ```
//!
//! **All memory of the previous pixel is in the walk.** An engine may therefore interpolate a row
//! now and shade it later, in blocks or on another thread, and no method changes.
//!
//! A method is written once, generic over the arithmetic ([`Num`]): one pixel, a block of pixels,
//! or values that count operations. Kernels and engines do everything else: the positions of
//! lights, perspective, clamping, storing and all loops. (Three methods step positions themselves,
//! or quadratics of positions, where a light is at a position: `roots/duff_phong.rs`,
//! `quadratics/six_point.rs` and `quadratics/bishop_weimer.rs`.)
//!
//! ## Where to find what
//!
//! | you look for | read |
//! |---|---|
//! | the shortest method | `methods/colours/gouraud.rs` |
//! | fast Phong shading | `methods/roots/fast_phong.rs`; its root is `Newton::root` in `walks/newton.rs` |
//! | how a span starts | `RunList::add` in `kernels/runs.rs` stores what a run starts from, [`Span`] hands it to [`Shader::walk`]; `span` in `src/raster/spans/active.rs` finds the span itself |
//! | the loops over pixels | `kernels/mod.rs`: `RunLoop` is the scalar one, `shade_blocks` the SIMD one |
//! | equation 2.1 | [`light`]: `LightAt::add` adds one light |
//! | what to change for a new highlight | [`light`], under *A new highlight* |
//! | the recurrences | [`walks`], a file each |
//! | the list of all methods | `method_table.rs`: [`METHODS`] is rendered, compared, timed, counted, tested and drawn |
//! | how to add a method | `examples/own_shader.rs`, then CONTRIBUTING |
//!
//! `Kernels` is a compiled method: a table of plain functions, which engines call once per row, per
//! batch of runs or per range of vertices. Two files hold only a description, because another
//! method's code draws them: `colours/flat_average.rs` runs `Flat`, and `roots/fast_phong_rsqrt.rs`
//! runs `DuffPhong<L, true>`.

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
    Approximation, Auto, Family, Info, Local, MethodParameter, Perspective, Range, ShadingRate,
    Tier, Value,
};
pub use fit::{Fit, On};
#[cfg(feature = "simd")]
pub(crate) use kernels::gbuffer_cell::CellLayout;
pub use kernels::operation_counts::OperationCounts;
pub use kernels::runs::{Corner, Corners, Span};
pub(crate) use kernels::runs::{
    GROUP, PolygonConstants, Run, RunList, RunValues, SpanPlace, Starts, ramp,
};
#[doc(hidden)] // for tests and benchmarks
pub use kernels::sample_span::SpanBench;
#[cfg(feature = "simd")]
#[doc(hidden)]
pub use kernels::timed_span::SpanRow;
#[cfg(feature = "io")]
pub(crate) use kernels::walked::{Walked, WalkedRun};
pub(crate) use kernels::{Extras, Pixels, VertexKernel, Vertices};
pub(crate) use kernels::{Kernels, UniformsIndex};
#[cfg(feature = "simd")]
pub(crate) use kernels::{RowColours, ShadeRow, SimdKernels, WalkKernel};
#[cfg(feature = "io")]
pub(crate) use light::LightUniforms;
pub use light::{LightAt, LightModel, SeenLight};
pub use method::{CarriesOf, Chosen, Kinds, Method, OneOf, Visit};
pub use method_table::{METHODS, MethodRow};
pub use needs::{Needs, Spans};
pub use span_shader::{SpanShader, SpanShaderError, SpanVertex};
pub use variant::Variant;
pub use walks::values::{PerLight, Values};
pub use walks::vertices::{Carried, Carries, Colour, Normal, ProductsAndNormal};
pub(crate) use walks::vertices::{NormalAndPlace, TurnedNormal};
pub use walks::{Constant, Linear, Walk};

use crate::number::{Num, Real, Vec3};

/// A shading method: what is computed once per vertex, along a span, and once per pixel.
///
/// A plain method writes its description, three types, `walk` and `shade`; all else has a default.
/// The fields of the type are the method's parameters: without any, derive `Default` and leave
/// `new` out. Mark every function `#[inline(always)]`, and closures that you pass on too, because a
/// call per pixel costs 25 times as much as the arithmetic.
///
/// ```
/// use fastphong::number::{Num, Vec3};
/// use fastphong::shading::{Info, LightAt, Linear, MethodRow, Normal, Shader, Span};
///
/// /// Phong shading without highlights.
/// #[derive(Clone, Copy, Default)]
/// struct Lambert;
///
/// impl Shader for Lambert {
///     const INFO: Info = Info { name: "lambert", ..Info::OF_PIXELS };
///     type Constants<F: Num> = ();
///     type Carries = Normal;
///     type Walk<F: Num> = Linear<Vec3<F>>;
///
///     #[inline(always)]
///     fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
///         span.linear()
///     }
///     #[inline(always)]
///     fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
///         let n = n.unit();
///         let mut colour = lit.ambient();
///         for light in lit.lights() {
///             colour = lit.add_diffuse(colour, &light, n.dot(light.to).max(0.0));
///         }
///         colour
///     }
/// }
///
/// static LAMBERT: MethodRow = MethodRow::of::<Lambert>();
/// let variant = LAMBERT.variant(); // renders frames, as any other
/// assert_eq!(variant.to_string(), "lambert");
/// ```
///
/// `examples/own_shader.rs` is a method with a parameter and its own highlight.
pub trait Shader: Copy + Default + 'static {
    /// The description of the method: texts and error bounds, which no engine reads. A kind of
    /// another method needs only a name: [`Info::of_kind`].
    const INFO: Info;
    /// What the method needs from engines. Begin from [`Needs::PIXELS`].
    const NEEDS: Needs = Needs::PIXELS;
    /// The values that are set up once per polygon: values, vectors and tuples of them; `()` if
    /// there are none.
    type Constants<F: Num>: Values<F>;
    /// What a vertex carries: a type of `walks/vertices.rs`, as [`Normal`], or `Self` for varyings
    /// of your own.
    type Carries: Carries;
    /// The state that is stepped along a span: [`Linear`] if no pixel needs the previous one.
    /// `shade` receives its [`Walk::Pixel`].
    type Walk<F: Num>: Walk<F>;
    /// The names of the values of [`Walk::Pixel`], in order, for traces. A name that ends in `_i`
    /// stands for one value per light.
    const VALUES: &'static [&'static str] = &[];

    /// Decides if the method draws a frame, or spans of a material. It may depend on lights,
    /// positions, exponents and the sides of polygons. [`On::each`] helps to ask about each
    /// material.
    fn on(_: On<'_>) -> Fit {
        Fit::Draws
    }
    /// Makes the method from `parameters`, which are in the order of [`Info::parameters`], for one
    /// material.
    #[inline(always)]
    fn new(_parameters: &[Value], _model: &LightModel) -> Self {
        Self::default()
    }
    /// Returns the constants of a polygon, before its first scanline. With [`Local::PerPolygon`],
    /// `lit` is the light at the polygon's mean. Otherwise call [`LightAt::at`] before you ask for
    /// a light or an eye at a position.
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, _: &Corners<'_, R>) -> Self::Constants<R> {
        Self::Constants::filled(lit.count(), lit.zero())
    }
    /// True if SIMD must walk along runs with these parameters, because a pixel needs the pixels
    /// before it or the ends of its span. Otherwise each block starts its own walk from varyings
    /// that are interpolated over triangles, and remembers nothing.
    #[inline(always)]
    fn walks_along_runs(self) -> bool {
        Self::NEEDS.reads_span() || <Self::Walk<f32> as Walk<f32>>::REMEMBERS
    }
    /// Starts a walk at the first pixel of `span`. A block starts it with steps of 0: its pixels
    /// must then equal those along a run at equal varyings, within the error that the method allows
    /// itself.
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F>;
    /// Returns the colour of a pixel: linear and not yet clamped. It must depend on nothing but its
    /// arguments.
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F>;
}

/// The input of [`Shader::shade`]: the state of a walk at one pixel.
pub type Pixel<S, F> = <<S as Shader>::Walk<F> as Walk<F>>::Pixel;

/// The varyings of a method: what its vertices carry, and edges and spans interpolate.
pub type Varying<S, F> = <<S as Shader>::Carries as Carries>::Varying<F>;
