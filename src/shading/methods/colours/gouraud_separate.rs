//! Gouraud shading that interpolates diffuse and specular light separately (L21 3; OpenGL's
//! separate specular colour).

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::methods::colours::gouraud::Gouraud;
use crate::shading::{
    Carries, Family, Info, LightAt, Linear, Needs, Pixel, Roundings, Shader, Span, Stepped,
};

/// Gouraud shading with two vertex colours that are not clamped, ambient plus diffuse light and
/// specular light. Both are interpolated, then summed and clamped at each pixel.
///
/// As interpolation is linear, a pixel is the interpolated sum of the vertex colours, clamped last.
/// Where lights add up to more than 1 at a vertex, [`Gouraud`] shows a slope that starts at once,
/// and this method first a plateau. Separate colours can be treated differently: a texture would
/// multiply only the first.
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
        derivation: "as gouraud, with two colours that are stepped and added; together they are at most the sum of all light",
        fails: "as gouraud",
        ..Gouraud::INFO
    };
    const NEEDS: Needs = Gouraud::NEEDS;
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<(Vec3<F>, Vec3<F>)>;
    const VALUES: &'static [&'static str] = &["Dr", "Dg", "Db", "Sr", "Sg", "Sb"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear() // 3.5, 3.6
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, (diffuse, specular): Pixel<Self, F>) -> Vec3<F> {
        diffuse + specular
    }
}

impl Carries for GouraudSeparate {
    type Varying<F: Num> = (Vec3<F>, Vec3<F>);
    const NAMES: &'static [&'static str] = &["Dr", "Dg", "Db", "Sr", "Sg", "Sb"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> (Vec3<F>, Vec3<F>) {
        lit.shade_apart(n) // 2.1
    }
}
