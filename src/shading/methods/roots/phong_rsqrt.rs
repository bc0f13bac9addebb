//! Phong shading from normals by scalars, for processors that shade a block of pixels at a time,
//! row by row.

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::{
    Info, LightAt, Linear, Needs, Normal, Pixel, Roundings, Shader, Span, Stepped, Tier,
};

/// Naive Phong shading without vectors at the light: three additions per pixel for N, then
/// `J = L·N`, `K = V·N`, `D = N·N` and one reciprocal root `r = 1/√D`. The cosines are `J r` and
/// `2 (J r) (K r) − L·V` (L21 4.3, 4.6).
///
/// It steps three values for any count of lights, where fast Phong steps one per light, one for K
/// and two for D. Varyings stay in memory until a row is shaded, and memory costs more than
/// products, so few varyings are fast.
#[derive(Clone, Copy, Debug, Default)]
pub struct PhongRsqrt;

impl Shader for PhongRsqrt {
    const INFO: Info = Info {
        name: "phong-rsqrt",
        ids: &["M03b"],
        tier: Tier::Default,
        title: "normals interpolated; J = L.N, K = V.N, D = N.N and 1/sqrt(D) at every pixel",
        formula: "N_next = N + dN;  J = L.N;  K = V.N;  r = 1 / sqrt(N.N);  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "L21 4.1-4.3, eq 4.5, with one root and one division for all cosines of a pixel",
        model: Model::Phong,
        roundings: Roundings::new(8.0, 0.9, Stepped::Cosines),
        derivation: "as naive-phong at a step; L takes 1, J and K 2.5; D takes 3, of which its root has half; the root and the quotient take 1 each, the \
                     products with r and R.V half each",
        fails: "as naive-phong",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        sums_lights: true,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = Linear<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
        span.linear() // 4.2
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        let r = n.dot(n).rsqrt(); // D = N · N
        let v_n = n.dot(lit.view()) * r; // K = V · N
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = n.dot(light.to) * r; // J = L · N
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n));
        }
        colour
    }
}
