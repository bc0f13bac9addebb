//! Slerp Phong shading by Chebyshev's recurrence: `J` and `K` by two additions and a product each (Barrera, Hast, Bengtsson 2004).

use crate::number::{Num, Real, Vec3};
use crate::shading::methods::angles::slerp_phong::SlerpPhong;
use crate::shading::walks::{Chebyshev, GreatCircle};
use crate::shading::{
    Corners, Info, Lit, Needs, Normal, PerLight, Pixel, Roundings, Shader, Span, Standing, Stepped,
};

/// Slerp Phong shading whose span needs no sines: of normals along a great circle all products are `P cos kδ + Q sin kδ`, which
/// [`Chebyshev`] follows. Edges are those of [`SlerpPhong`], and so is the set-up of a span, but for the first differences.
#[derive(Clone, Copy, Debug, Default)]
pub struct SlerpChebyshev<const L: usize>;

impl<const L: usize> Shader for SlerpChebyshev<L> {
    const INFO: Info = Info {
        name: "slerp-chebyshev",
        ids: &["M12"],
        standing: Standing::Asked,
        title: "J = L.N and K = V.N along great circles, by Chebyshev's recurrence",
        formula: "J_next = J + dJ;  dJ_next = dJ - a J_next;  a = 4 sin^2(d/2), d the angle of a pixel; K likewise\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "Barrera, Hast, Bengtsson 2004; L21 4.4, eq 4.7",
        roundings: Roundings::new(28.0, 2.1, Stepped::GreatCircles),
        derivation: "F is rounded at each step, dF by its size: k (0.5 + 0.5 phi) roundings after k steps, phi the angle of the span, \
                     pi at most; and 3 phi each for a, for the first dF and for the sines of the first pixel, 28 in all",
        fails: "as slerp-phong: the set-up of a span is the same",
        ..SlerpPhong::<1>::INFO
    };
    const NEEDS: Needs = SlerpPhong::<L>::NEEDS;
    type Constants<F: Num> = Vec3<F>; // the polygon's normal
    type Carries = Normal;
    type Walk<F: Num> = Chebyshev<F, (PerLight<F, L>, F)>;
    const VALUES: &'static [&'static str] = &["J_i", "K"];

    #[inline(always)]
    fn polygon<R: Real>(self, _: &Lit<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let circle =
            GreatCircle::start(span.constants(), span.ends(), span.parameter(), lit.zero());
        Chebyshev::along(
            circle,
            #[inline(always)]
            |n| lit.products(n),
        ) // 4.8
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}
