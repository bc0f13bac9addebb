//! What a method needs of engines: one constant value, by which they and its kernels decide what to compute, keep and compile.

use super::{LitAt, Local, Perspective, ramp};
use crate::number::Num;

/// What a method needs of engines; [`Needs::PIXELS`] to begin from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// The rate at which it evaluates the light model: what engines light, and when. Where that is not the pixel, `shade` may read
    /// no uniforms but [`LightModel::scale`](super::LightModel::scale): the row engine hands it those of any material.
    pub lit_at: LitAt,
    /// The points from which it sees lights and eye at positions.
    pub local: Local,
    /// The answer to perspective interpolation.
    pub perspective: Perspective,
    /// What of a span its walk starts from.
    pub spans: Spans,
    /// True if it is only for general light, by N·H or from positions: no fast loop is compiled.
    pub general_only: bool,
    /// The reason why it is not compiled for SIMD, if it is not. Methods of several kinds never are: say
    /// here only what else stands against it.
    pub scalar_only: Option<&'static str>,
}

impl Needs {
    /// Those of a method that interpolates and lights pixels, each by what is seen from it.
    pub const PIXELS: Needs = Needs {
        lit_at: LitAt::Pixel,
        local: Local::PerPixel,
        perspective: Perspective::Free,
        spans: Spans::Pixels,
        general_only: false,
        scalar_only: None,
    };
    /// Those of one that sees lights and eye from each polygon's mean, as the lecture does.
    pub const PIXELS_BY_POLYGON: Needs = Needs {
        local: Local::PerPolygon,
        ..Needs::PIXELS
    };
    /// Those of one that follows great circles (L21 4.7).
    pub const GREAT_CIRCLES: Needs = Needs {
        perspective: Perspective::ScreenOnly,
        spans: Spans::GreatCircles,
        ..Needs::PIXELS_BY_POLYGON
    };

    /// True if engines keep the ends of spans, and their place.
    pub const fn reads_span(self) -> bool {
        !matches!(self.spans, Spans::Pixels)
    }
    /// Returns the two values that a walk starts a varying from, given those at the ends of its span.
    #[inline(always)]
    pub(crate) fn start<F: Num>(self, [a, b]: [F; 2], t0: F, dt: F) -> [F; 2] {
        match self.reads_span() {
            true => [a, b],
            false => ramp(a, b, t0, dt),
        }
    }
    /// True if edges carry normals along great circles.
    pub const fn great_circles(self) -> bool {
        matches!(self.spans, Spans::GreatCircles)
    }
}

/// What of a span a walk starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spans {
    /// The varyings at the first pixel and their growth: a span may as well be walked block by block.
    Pixels,
    /// The varyings at its ends, or its place, or a polygon's constants in a method that is compiled for SIMD: engines store the ends
    /// and the place, and SIMD walks along runs. Methods of several kinds are scalar only, and may read constants without it.
    Ends,
    /// As `Ends`; and edges carry the varying, a unit normal, along great circles (L21 4.7).
    GreatCircles,
}
