//! Slerp Phong shading by scalars: `J` and `K` from incremental sines and cosines (L21 4.4, summary
//! c).

use crate::number::{Num, Real, Vec3};
use crate::reference::Model;
use crate::shading::walks::GreatCircle;
use crate::shading::{
    Corners, Family, Info, LightAt, Needs, Normal, PerLight, Pixel, Roundings, Shader, Span,
    Stepped, Tier,
};

/// Slerp Phong shading in its scalar form, for up to `L` lights. Unit normals follow great circles
/// along the edges. Along a span only `J = L·N` and `K = V·N` are computed, from sines that
/// (4.9)–(4.12) step. A pixel needs no root and no division.
#[derive(Clone, Copy, Debug, Default)]
pub struct SlerpPhong<const L: usize>;

impl<const L: usize> Shader for SlerpPhong<L> {
    const INFO: Info = Info {
        name: "slerp-phong",
        ids: &["M11"],
        family: Family::Angles,
        tier: Tier::Default,
        title: "J = L.N and K = V.N along great circles, by incremental sines and cosines",
        formula: "J(t) = sin((1-t)phi)/sin(phi) L.N1 + sin(t phi)/sin(phi) L.N2, K in the same way; sines by eq 4.9-4.12\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "L21 4.4, eq 4.7-4.12, summary c",
        claimed: "four additions or subtractions and eight multiplications a pixel for the sines and cosines (L21 4.9-4.12)",
        model: Model::Slerp,
        roundings: Roundings::new(4.0, 2.0, Stepped::GreatCircles),
        derivation: "each step turns a vector of length 1 by two products and a sum in each component, 1.5 * 2^-24 in all, by a \
                     rotation whose entries are rounded by half of 2^-24",
        fails: "on short spans, which pay one inverse tangent, three pairs of sine and cosine, two roots and a \
                division each; the picture of a triangle depends on how it lies; opposite normals have no great circle",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        sums_lights: true,
        ..Needs::GREAT_CIRCLES
    };
    type Constants<F: Num> = Vec3<F>; // the polygon's normal
    type Carries = Normal;
    type Walk<F: Num> = GreatCircle<F, (PerLight<F, L>, F)>;
    const VALUES: &'static [&'static str] = &["J_i", "K"];

    #[inline(always)]
    fn polygon<R: Real>(self, _: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let circle =
            GreatCircle::start(span.constants(), span.ends(), span.parameter(), lit.zero());
        circle.map(
            #[inline(always)]
            |n| lit.products(n), // 4.8, times L and V
        ) // 4.9–4.12
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}
