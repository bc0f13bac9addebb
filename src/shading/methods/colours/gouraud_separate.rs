//! Gouraud shading with diffuse and specular light interpolated apart (L21 3; OpenGL's separate specular colour).

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::methods::colours::gouraud::Gouraud;
use crate::shading::{
    Carries, Family, Info, Linear, Lit, Needs, Pixel, Roundings, Shader, Span, Stepped,
};

/// Gouraud shading whose vertex colours are not clamped: ambient and diffuse light in one colour, specular light in another,
/// both interpolated, summed and clamped at each pixel.
///
/// As interpolation is linear this is the unclamped sum of vertex colours, clamped last: where lights add up to over
/// 1 at a vertex, [`Gouraud`] shows a slope that starts at once, and this method a plateau first. Kept apart, the two
/// colours can be treated apart: a texture would be multiplied by the first only.
#[derive(Clone, Copy, Debug, Default)]
pub struct GouraudSeparate;

impl Shader for GouraudSeparate {
    const INFO: Info = Info {
        name: "gouraud-separate",
        ids: &[],
        family: Family::Colours,
        title: "unclamped vertex colours; diffuse and specular light interpolated separately",
        formula: "D_next = D + dD;  S_next = S + dS;  I = min(1, D + S), D = Ia ka + Ip kd (L.N), S = Ip ks (R.V)^n at vertices",
        source: "L21 3, eq 3.5, 3.6; OpenGL 1.2, 2.13.1 (separate specular colour)",
        model: Model::GouraudSeparate,
        roundings: Roundings::new(6.0, 1.0, Stepped::Sums),
        derivation: "as Gouraud, with two colours that are stepped, added, and at most the sum of all light between them",
        fails: "as Gouraud",
        ..Gouraud::INFO
    };
    const NEEDS: Needs = Gouraud::NEEDS;
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<(Vec3<F>, Vec3<F>)>;
    const VALUES: &'static [&'static str] = &["Dr", "Dg", "Db", "Sr", "Sg", "Sb"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &Lit<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear() // 3.5, 3.6
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &Lit<'_, F>, (diffuse, specular): Pixel<Self, F>) -> Vec3<F> {
        diffuse + specular
    }
}

impl Carries for GouraudSeparate {
    type Varying<F: Num> = (Vec3<F>, Vec3<F>);
    const NAMES: &'static [&'static str] = &["Dr", "Dg", "Db", "Sr", "Sg", "Sb"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &Lit<'_, F>, n: Vec3<F>) -> (Vec3<F>, Vec3<F>) {
        lit.shade_apart(n) // 2.1
    }
}
