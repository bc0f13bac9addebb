//! Gouraud shading: vertex colours are interpolated linearly (L21 3).

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::{
    Colour, Family, Info, LightAt, Linear, Local, Needs, Perspective, Pixel, Roundings, Shader,
    ShadingRate, Span, Stepped, Tier,
};

/// Gouraud shading: equation 2.1 at the vertices, then one addition per channel along edges and
/// spans (L21 3.5–3.6).
///
/// The vertex colours are clamped to 0..=1 before they are interpolated, so no pixel needs a clamp.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gouraud;

impl Shader for Gouraud {
    const INFO: Info = Info {
        name: "gouraud",
        ids: &["M02"],
        family: Family::Colours,
        tier: Tier::Default,
        title: "vertex colours, interpolated along edges and spans",
        formula: "dI = (I2 - I1) / (y2 - y1) along edges, (I2 - I1) / (x2 - x1) along spans; I_next = I + dI",
        source: "L21 3, eq 3.5, 3.6 (Gouraud 1971)",
        claimed: "one addition a pixel and channel (L21 3.6)",
        model: Model::Gouraud,
        roundings: Roundings::new(4.0, 1.0, Stepped::Colours),
        derivation: "a vertex is lit as in flat shading; each step rounds a colour of at most 1 by half of 2^-24, and under perspective \
                     the weight too",
        fails: "highlights inside a polygon are lost or smeared; the slope of the intensity still jumps at edges",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        shading_rate: ShadingRate::Vertex,
        local: Local::PerVertex,
        perspective: Perspective::Divides,
        sums_lights: true,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Colour;
    type Walk<F: Num> = Linear<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["Ir", "Ig", "Ib"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
        span.linear() // 3.5, 3.6
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, colour: Pixel<Self, F>) -> Vec3<F> {
        colour
    }
}
