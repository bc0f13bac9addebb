//! Naive Phong shading: normals are interpolated and renormalised at every pixel (L21 4.1).

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::{
    Info, LightAt, Linear, Needs, Normal, Pixel, Roundings, Shader, Span, Stepped, Tier,
};

/// Naive Phong shading: three additions per pixel for N, then a root, a division and equation 2.1
/// (L21 4.1–4.2).
///
/// The interpolated normal and the unit normal are two variables, as in section 4.1. The lecture's
/// summary feeds the unit normal back into the sum (`N_next = (N + ΔN)/|N + ΔN|`), which is not
/// linear interpolation and never arrives at N_2.
///
/// Where a light or the eye is at a position, positions are interpolated beside the normals, and
/// the vector toward each light and toward the eye is normalised at each pixel too (CS171 3,
/// Algorithm 7). Normals on edges are not renormalised, because the picture of a triangle would
/// then depend on how it lies.
#[derive(Clone, Copy, Debug, Default)]
pub struct NaivePhong;

impl Shader for NaivePhong {
    const INFO: Info = Info {
        name: "naive-phong",
        ids: &["M03"],
        tier: Tier::Default,
        title: "normals, interpolated and renormalised at every pixel",
        formula: "N_next = N + dN;  N_unit = N / |N|;  R = 2 (L.N_unit) N_unit - L;  eq 2.1 at every pixel",
        source: "L21 4.1, eq 4.1, 4.2 (Phong 1975)",
        claimed: "three additions a pixel step the normal, which is then normalised (L21 4.1)",
        model: Model::Phong,
        roundings: Roundings::new(4.0, 0.9, Stepped::Cosines),
        derivation: "each step rounds the three components of N by half of 2^-24, which is a vector of length 0.87 * 2^-24; the part \
                     along N is lost when N is normalised",
        fails: "where normals cancel inside a span; the slope of the intensity still jumps at edges (Duff 1979)",
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
        span.linear() // 4.1, 4.2
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        lit.shade(n.unit()) // N_unit = N / |N|, 2.1
    }
}
