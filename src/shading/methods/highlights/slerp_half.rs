//! Slerp Phong shading with N·H: highlights follow Chebyshev's recurrence, as diffuse light does
//! (Barrera, Hast, Bengtsson 2004).

use crate::number::{Num, Real, Vec3};
use crate::shading::methods::angles::slerp_chebyshev::SlerpChebyshev;
use crate::shading::methods::highlights::duff_half::refuses_light;
use crate::shading::walks::{Chebyshev, GreatCircle};
use crate::shading::{
    Corners, Family, Fit, Info, LightAt, Needs, Normal, On, PerLight, Pixel, Shader, Span,
};

/// Slerp Phong shading for highlights by the half vector, for up to `L` lights. Along a great
/// circle, `J = L·N` and `M = H·N` take two additions and a product each. A pixel needs no root and
/// no division; only the light model remains.
#[derive(Clone, Copy, Debug, Default)]
pub struct SlerpHalf<const L: usize>;

impl<const L: usize> Shader for SlerpHalf<L> {
    const INFO: Info = Info {
        name: "slerp-half",
        family: Family::Highlights,
        ids: &["M12h"],
        title: "L.N and N.H along great circles, by Chebyshev's recurrence",
        formula: "J_next = J + dJ;  dJ_next = dJ - a J_next;  a = 4 sin^2(d/2), d the angle of a pixel; M = N.H in the same way\n\
                  I = Ia ka + Ip kd J + Ip ks M^n",
        source: "Barrera, Hast, Bengtsson 2004; L21 4.4, eq 4.7; H as CS171 2",
        derivation: "as slerp-chebyshev",
        fails: "as slerp-phong: a span has the same set-up; for N.H only, with lights and eye at infinity",
        ..SlerpChebyshev::<1>::INFO
    };
    const NEEDS: Needs = Needs {
        general_only: true,
        scalar_only: Some(
            "slerp-half walks along spans, and a block of pixels would store two values per light",
        ),
        ..SlerpChebyshev::<L>::NEEDS
    };
    type Constants<F: Num> = Vec3<F>; // the polygon's normal
    type Carries = Normal;
    type Walk<F: Num> = Chebyshev<F, (PerLight<F, L>, PerLight<F, L>)>;
    const VALUES: &'static [&'static str] = &["J_i", "M_i"];

    fn on(on: On<'_>) -> Fit {
        on.each(|lighting, _| refuses_light(lighting))
    }
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
            |n| lit.half_products(n),
        )
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_half_products(products)
    }
}
