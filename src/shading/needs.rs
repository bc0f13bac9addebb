//! The needs of a method: what engines and kernels must compute, keep and compile for it.

use super::{Local, Perspective, ShadingRate, ramp};
use crate::number::Num;

/// What a method needs from engines. Begin from [`Needs::PIXELS`] (`..Needs::PIXELS`), because
/// later versions may add fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// When the method evaluates the light model: per polygon, per vertex or per pixel. If it is
    /// not per pixel, `shade` may read no uniforms but
    /// [`LightModel::scale`](super::LightModel::scale), because the row engine then passes any
    /// material's uniforms.
    pub shading_rate: ShadingRate,
    /// The points from which the method sees lights and an eye that are at positions.
    pub local: Local,
    /// What perspective interpolation does to the method.
    pub perspective: Perspective,
    /// What its walk starts from.
    pub spans: Spans,
    /// True if colours are sums of ambient light and of terms that have a light as their factor, so
    /// that twice the light is twice the colour. Where pictures store levels, the row engine then
    /// multiplies the lights by 255, once per material. Otherwise it multiplies what `shade`
    /// returns, three products a block: leave it false for emission, tone curves and normals shown
    /// as colours.
    pub sums_lights: bool,
    /// True if the method supports only general light, as by N·H or from positions: no fast loop is
    /// compiled for it.
    pub general_only: bool,
    /// The reason why the method is not compiled for SIMD, or `None` if it is. Methods of several
    /// kinds are never compiled for SIMD; name here only what else prevents it.
    pub scalar_only: Option<&'static str>,
}

impl Needs {
    /// A method that interpolates and is lit at each pixel, with lights seen from each pixel.
    pub const PIXELS: Needs = Needs {
        shading_rate: ShadingRate::Pixel,
        local: Local::PerPixel,
        perspective: Perspective::Free,
        spans: Spans::Pixels,
        sums_lights: false,
        general_only: false,
        scalar_only: None,
    };
    /// A method that is lit at each pixel, with lights and eye seen from each polygon's mean, as in
    /// the lecture.
    pub const PIXELS_BY_POLYGON: Needs = Needs {
        local: Local::PerPolygon,
        ..Needs::PIXELS
    };
    /// A method that follows great circles (L21 4.7).
    pub const GREAT_CIRCLES: Needs = Needs {
        perspective: Perspective::ScreenOnly,
        spans: Spans::GreatCircles,
        ..Needs::PIXELS_BY_POLYGON
    };

    /// True if engines must store the ends of spans and the place of each run on its span.
    pub const fn reads_span(self) -> bool {
        !matches!(self.spans, Spans::Pixels)
    }
    /// Returns the two values that a varying starts from, computed from its values `a` and `b` at
    /// the ends of the span.
    #[inline(always)]
    pub(crate) fn start<F: Num>(self, [a, b]: [F; 2], t0: F, dt: F) -> [F; 2] {
        if self.reads_span() {
            [a, b]
        } else {
            ramp(a, b, t0, dt)
        }
    }
    /// True if edges carry normals along great circles.
    pub const fn great_circles(self) -> bool {
        matches!(self.spans, Spans::GreatCircles)
    }
}

/// What a walk starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Spans {
    /// The varyings at the first pixel and their growth per pixel. Such a walk can start at any
    /// block.
    Pixels,
    /// The varyings at both ends of the span, or its place; in methods that are compiled for SIMD,
    /// also a polygon's constants. Engines store ends and place, and SIMD walks along runs. Methods
    /// of several kinds are scalar only, and may read constants without this.
    Ends,
    /// Like `Ends`. In addition, edges carry the varying, a unit normal, along great circles (L21
    /// 4.7).
    GreatCircles,
}
