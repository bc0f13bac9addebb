//! Forward differences with N·H: the cosine of a highlight takes one addition and no product (Duff
//! 1979).

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::scene::{Lighting, SpecularModel};
use crate::shading::walks::Quadratic;
use crate::shading::walks::values::scaled;
use crate::shading::{
    Carries, Family, Fit, Info, LightAt, Linear, Needs, On, PerLight, Pixel, Roundings, Shader,
    Span, Stepped,
};

/// Duff's forward differences for highlights by the half vector, for up to `L` lights. A pixel
/// takes one addition each for `J = L·N` and `M = H·N` of each light, two for `D = N·N`, then one
/// root and one division, which serve all lights.
#[derive(Clone, Copy, Debug, Default)]
pub struct DuffHalf<const L: usize>;

/// Returns the reason why a method that follows M = N·H along a span refuses a material, or `None`.
pub(crate) fn refuses_light(lighting: &Lighting) -> Option<&'static str> {
    if lighting.specular != SpecularModel::Blinn {
        return Some("its highlights are by N.H, not by R.V");
    }
    let reason = "it steps N.H for lights and an eye at infinity, and one of them is at a position";
    lighting.is_local().then_some(reason)
}

impl<const L: usize> Shader for DuffHalf<L> {
    const INFO: Info = Info {
        name: "duff-half",
        family: Family::Highlights,
        ids: &["M05h"],
        title: "L.N and N.H by forward differences: no vector on a span, and no product for a highlight",
        formula: "J_next = J + dJ;  M_next = M + dM;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = 1 / sqrt(D)\n\
                  I = Ia ka + Ip kd J r + Ip ks (M r)^n,  M = N.H",
        source: "Duff 1979; H as CS171 2",
        model: Model::Phong,
        roundings: Roundings::new(8.0, 2.0, Stepped::Products),
        derivation: "as duff-phong; computing H takes 2 more roundings",
        fails: "as duff-phong; for N.H only, with lights and eye at infinity",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        general_only: true,
        scalar_only: Some(
            "duff-half steps differences from pixel to pixel, and a block of pixels would store two values per light",
        ),
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = (Linear<(PerLight<F, L>, PerLight<F, L>)>, Quadratic<F>);
    const VALUES: &'static [&'static str] = &["J_i", "M_i", "D"];

    fn on(on: On<'_>) -> Fit {
        on.each(|lighting, _| refuses_light(lighting))
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at, step } = span.linear();
        let ((at, n), (step, dn)) = (at, step);
        (Linear { at, step }, Quadratic::square(n, dn))
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (products, d): Pixel<Self, F>) -> Vec3<F> {
        lit.shade_half_products(scaled(products, d.broadcast(1.0) / d.sqrt()))
    }
}

impl<const L: usize> Carries for DuffHalf<L> {
    type Varying<F: Num> = ((PerLight<F, L>, PerLight<F, L>), Vec3<F>);
    const NAMES: &'static [&'static str] = &["J_i", "M_i", "Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        (lit.half_products(n), n)
    }
}
