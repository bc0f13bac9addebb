//! Slerp Phong shading by Chebyshev's recurrence: two additions and a product each for `J` and `K`
//! (Barrera, Hast, Bengtsson 2004).

use crate::number::{Num, Real, Vec3};
use crate::shading::methods::angles::slerp_phong::SlerpPhong;
use crate::shading::walks::{Chebyshev, GreatCircle};
use crate::shading::{
    Corners, Info, LightAt, Needs, Normal, PerLight, Pixel, Roundings, Shader, Span, Stepped, Tier,
};

/// Slerp Phong shading whose spans need no sines. All products of normals along a great circle are
/// `P cos kδ + Q sin kδ`, which [`Chebyshev`] follows. Edges are stepped as in [`SlerpPhong`], and
/// a span is set up in the same way, but for the first differences.
#[derive(Clone, Copy, Debug, Default)]
pub struct SlerpChebyshev<const L: usize>;

impl<const L: usize> Shader for SlerpChebyshev<L> {
    const INFO: Info = Info {
        name: "slerp-chebyshev",
        ids: &["M12"],
        tier: Tier::Asked,
        title: "J = L.N and K = V.N along great circles, by Chebyshev's recurrence",
        formula: "J_next = J + dJ;  dJ_next = dJ - a J_next;  a = 4 sin^2(d/2), d the angle of a pixel; K in the same way\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "Barrera, Hast, Bengtsson 2004; L21 4.4, eq 4.7",
        roundings: Roundings::new(28.0, 2.1, Stepped::GreatCircles),
        derivation: "F is rounded at each step, and dF relative to its size: k (0.5 + 0.5 phi) roundings after k steps, with phi the angle of the span, \
                     at most pi; and 3 phi each for a, for the first dF and for the sines of the first pixel, 28 in all",
        fails: "as slerp-phong: a span has the same set-up",
        ..SlerpPhong::<1>::INFO
    };
    const NEEDS: Needs = SlerpPhong::<L>::NEEDS;
    type Constants<F: Num> = Vec3<F>; // the polygon's normal
    type Carries = Normal;
    type Walk<F: Num> = Chebyshev<F, (PerLight<F, L>, F)>;
    const VALUES: &'static [&'static str] = &["J_i", "K"];

    #[inline(always)]
    fn polygon<R: Real>(self, _: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let circle =
            GreatCircle::start(span.constants(), span.ends(), span.parameter(), lit.zero());
        Chebyshev::along(
            circle,
            #[inline(always)]
            |n| lit.products(n),
        ) // 4.8
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}
