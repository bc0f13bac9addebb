//! Flat shading: one colour per polygon (L21 2).

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::{
    Colour, Constant, Family, Info, LightAt, Needs, Perspective, Pixel, Roundings, Shader,
    ShadingRate, Span, Stepped, Tier,
};

/// Flat (uniform) shading: the polygon's own normal, lit once (L21 2.1).
///
/// Light and eye at positions are seen from the mean of the polygon's corners.
#[derive(Clone, Copy, Debug, Default)]
pub struct Flat;

impl Shader for Flat {
    const INFO: Info = Info {
        name: "flat",
        ids: &["M01"],
        family: Family::Colours,
        tier: Tier::Default,
        title: "one colour per polygon, from its own normal",
        formula: "I = Ia ka + Ip kd (L.N) + Ip ks (R.V)^n, with N the polygon's normal by Newell's formula",
        source: "L21 2, eq 2.1 (Bouknight 1970)",
        model: Model::Flat,
        roundings: Roundings::new(4.0, 0.0, Stepped::Colours),
        derivation: "nothing is stepped; L.N and R.V take 8 roundings each of at most half of 2^-24",
        fails: "every polygon edge is visible, and the eye exaggerates it (Mach bands)",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        shading_rate: ShadingRate::Polygon,
        perspective: Perspective::Unaffected,
        sums_lights: true,
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = Colour;
    type Walk<F: Num> = Constant<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["Ir", "Ig", "Ib"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Constant<Vec3<F>> {
        Constant(span.linear().at)
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, colour: Pixel<Self, F>) -> Vec3<F> {
        colour
    }
}
