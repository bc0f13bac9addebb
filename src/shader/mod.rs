//! The shading methods: one trait, one table, one file a method.
//!
//! Methods differ in *what is computed how often*: once a vertex, a polygon, a span or a pixel. [`Shader`] says that and
//! nothing else; the loops belong to [`crate::raster`]. **Memory of the previous pixel is walk; shade is a pure
//! function** of what the walk gives. [`METHODS`] lists all methods: what is in it is rendered, compared, timed,
//! counted, tested and drawn; what is not does not exist.

mod bands;
mod bound;
mod count;
mod dispatch;
mod info;
mod power;
mod span;
mod spread;
mod streamed;
mod table;

pub mod illumination;
pub mod local;

mod duff_phong;
mod fast_phong;
mod fast_phong_rsqrt;
mod flat;
mod flat_average;
mod gouraud;
mod gouraud_separate;
mod naive_phong;
mod one_colour;
mod phong_rsqrt;
mod slerp_phong;
mod slerp_phong_vector;

pub use bound::{Roundings, Stepped};
pub use count::OperationCounts;
pub use duff_phong::DuffPhong;
pub use fast_phong::FastPhong;
pub use fast_phong_rsqrt::FastPhongRsqrt;
pub use flat::Flat;
pub use flat_average::FlatAverage;
pub use gouraud::Gouraud;
pub use gouraud_separate::GouraudSeparate;
pub use info::{Auto, Info, Local, Parameter, Perspective};
pub use naive_phong::NaivePhong;
pub use phong_rsqrt::PhongRsqrt;
pub use slerp_phong::SlerpPhong;
pub use slerp_phong_vector::SlerpPhongVector;
pub use span::SpanBench;
pub use table::{Entry, METHODS, MethodError, Variant};

use crate::frame::{Frame, Polygon};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Planes, Real};
use crate::walk::{Attribute, Walk};

/// One vertex, for what a shader computes once a vertex: nothing of it is read unless asked for.
#[derive(Clone, Copy, Debug)]
pub struct Corner<'a, M> {
    pub(crate) machine: M,
    pub(crate) frame: &'a Frame,
    pub(crate) vertex: u32,
}

impl<M: Machine> Corner<'_, M> {
    /// The unit vertex normal in world space (L21 3.1).
    #[inline(always)]
    pub fn normal(&self) -> [M::One; 3] {
        self.machine.three(self.frame.normal(self.vertex))
    }

    /// Where it is: see [`Frame::position`].
    #[inline(always)]
    pub fn position(&self) -> [M::One; 3] {
        self.machine.three(self.frame.position(self.vertex))
    }

    /// Where it is in the world, rounded once.
    #[inline(always)]
    pub fn world(&self) -> [M::One; 3] {
        let (eye, from_eye) = (self.frame.eye(), self.frame.position(self.vertex));
        self.machine.three(core::array::from_fn(|i| {
            (eye[i] + f64::from(from_eye[i])) as f32
        }))
    }

    /// Its colour: see [`Frame::colour`].
    #[inline(always)]
    pub fn colour(&self) -> [M::One; 3] {
        self.machine.three(self.frame.colour(self.vertex))
    }
}

/// The corners of one polygon, for what a shader computes once a polygon.
#[derive(Debug)]
pub struct Corners<'a, M, A> {
    pub(crate) machine: M,
    pub(crate) frame: &'a Frame,
    pub(crate) polygon: &'a Polygon,
    pub(crate) attributes: &'a [A],
}

impl<M: Machine, A: Copy> Corners<'_, M, A> {
    /// The unit normal by Newell's formula (L21 1.1).
    #[inline(always)]
    pub fn normal(&self) -> [M::One; 3] {
        self.machine.three(self.frame.polygon_normal(self.polygon))
    }

    /// The mean position of the corners, before clipping: see [`Frame::mean`].
    #[inline(always)]
    pub fn mean_position(&self) -> [M::One; 3] {
        self.machine.three(self.frame.mean(self.polygon).position)
    }

    /// The mean of the vertex normals, before clipping and not normalised.
    #[inline(always)]
    pub fn mean_normal(&self) -> [M::One; 3] {
        self.machine.three(self.frame.mean(self.polygon).normal)
    }

    /// How many corners there are, three or more.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        self.polygon.count as usize
    }

    /// Column and row of corner `i` on the picture, in pixels.
    pub fn position(&self, i: usize) -> [M::One; 2] {
        let vertex = &self.frame.vertices()[self.frame.corners(self.polygon)[i] as usize];
        [
            self.machine.one(vertex.x.to_num()),
            self.machine.one(vertex.y.to_num()),
        ]
    }

    /// The attribute of corner `i`.
    pub fn attribute(&self, i: usize) -> A {
        self.attributes[self.frame.corners(self.polygon)[i] as usize]
    }
}

/// Where a walk along a span starts.
#[derive(Clone, Copy, Debug)]
pub struct Span<R, S> {
    /// Column of the centre of the first pixel.
    pub x: R,
    /// Row of the centre of the first pixel.
    pub y: R,
    /// The attribute there, and how it goes on.
    pub attribute: S,
}

/// The span of a shader's attribute.
pub type SpanOf<S, R> = Span<R, <<S as Shader>::Attribute<R> as Attribute<R>>::Span>;

/// What a walk gives to the pixels of a triangle, seen from without: where it is no recurrence, an engine may find the same
/// for each pixel by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Given {
    /// What only the walk itself knows.
    Walked,
    /// The attribute, interpolated linearly: its numbers in order, as many of them as the pixel has.
    Attribute,
    /// What holds over the polygon, finite: its numbers in order, likewise.
    Polygon,
}

/// A shading method for a fixed number of lights: what it computes at each of four rates.
///
/// Every function must be `#[inline(always)]`: one that is not costs a call a pixel.
pub trait Shader: 'static {
    /// Lights, material and parameters, made once a material.
    type Consts<N: Num>: Copy + Send + Sync;
    /// What is walked along edges.
    type Attribute<R: Real>: Attribute<R>;
    /// What holds over one polygon.
    type Polygon<R: Real>: Planes<R> + Send + Sync;
    /// What is walked along one visible run of a span.
    type Walk<M: Machine>: Walk<Out = Self::Pixel<M::F>>;
    /// What the walk gives to each pixel: numbers, arrays and tuples of them.
    type Pixel<F: Num>: Planes<F>;
    /// What the walk gives, seen from without.
    const GIVEN: Given = Given::Walked;
    /// Whether what it makes of a vertex is the vertex normal as it is, whatever the constants are, and of a polygon nothing: an
    /// engine may then read the frame's own normals.
    const ATTRIBUTE_IS_NORMAL: bool = false;

    /// Constants from the light on one material; `parameters` are in the order of [`Info::parameters`].
    fn consts<N: Num>(
        lighting: &Lighting,
        parameters: &[u32],
        of: &dyn Fn(f32) -> N,
    ) -> Self::Consts<N>;
    /// The constants again, for [`Shader::scaled`], if they ask for what most scenes do, which pixel loops are compiled for apart, without
    /// decisions. `None` by default: then there is one loop.
    #[inline(always)]
    fn usual<N: Num>(consts: &Self::Consts<N>, scale: N) -> Option<Self::Consts<N>> {
        let _ = (consts, scale);
        None
    }
    /// Once a pixel, with usual constants: `scale` times linear red, green and blue, before the clamp, of magnitudes below
    /// `scale` · 2²². By default the constants are scaled.
    #[inline(always)]
    fn scaled<F: Num>(c: &Self::Consts<F>, pixel: Self::Pixel<F>, scale: F) -> [F; 3] {
        let _ = scale;
        Self::shade(c, pixel)
    }
    /// Once a vertex.
    fn vertex<M: Machine>(
        c: &Self::Consts<M::One>,
        corner: &Corner<'_, M>,
    ) -> Self::Attribute<M::One>;
    /// Once a polygon.
    fn polygon<M: Machine>(
        c: &Self::Consts<M::One>,
        corners: &Corners<'_, M, Self::Attribute<M::One>>,
    ) -> Self::Polygon<M::One>;
    /// Once a visible run.
    fn walk<M: Machine>(
        m: M,
        c: &Self::Consts<M::One>,
        polygon: &Self::Polygon<M::One>,
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M>
    where
        Self: Sized;
    /// Once a pixel: linear red, green and blue, not yet clamped.
    fn shade<F: Num>(c: &Self::Consts<F>, pixel: Self::Pixel<F>) -> [F; 3];
}

/// A shading method: what is said about it, and its shader for every number of lights.
pub trait Method: 'static {
    /// What is said about it.
    const INFO: Info;
    /// Its shader when attributes are linear on the screen.
    type Screen<const L: usize>: Shader;
    /// Its shader when attributes are linear in space: they come weighted by 1/w.
    type Perspective<const L: usize>: Shader;
    /// Its shader when a light or the eye is at a position, attributes linear on the screen.
    type Local<const L: usize>: Shader;
    /// Likewise, attributes linear in space.
    type LocalPerspective<const L: usize>: Shader;
}
