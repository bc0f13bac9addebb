//! Slerp Phong shading by vectors: unit normals from incremental sines and cosines (L21 4.4, steps
//! i–iv).

use crate::number::{Num, Real, Vec3};
use crate::shading::methods::angles::slerp_phong::SlerpPhong;
use crate::shading::walks::GreatCircle;
use crate::shading::{Corners, Info, LightAt, Needs, Normal, Pixel, Shader, Span, Tier};

/// Slerp Phong shading in its vector form. Unit normals follow great circles along edges *and*
/// along spans. Each pixel evaluates equation 2.1 without renormalising (L21 4.4, steps i–iv).
#[derive(Clone, Copy, Debug, Default)]
pub struct SlerpPhongVector;

impl Shader for SlerpPhongVector {
    const INFO: Info = Info {
        name: "slerp-phong-vector",
        ids: &["M11v"],
        tier: Tier::Asked,
        title: "unit normals along great circles, by incremental sines and cosines",
        formula: "N(t) = sin((1-t)phi)/sin(phi) N1 + sin(t phi)/sin(phi) N2; sines by eq 4.9-4.12; eq 2.1",
        source: "L21 4.4, eq 4.7-4.12, steps i-iv",
        derivation: "as slerp-phong: the same sines carry the normals",
        fails: "as slerp-phong, at a higher price per pixel",
        ..SlerpPhong::<1>::INFO
    };
    const NEEDS: Needs = SlerpPhong::<1>::NEEDS;
    type Constants<F: Num> = Vec3<F>; // the polygon's normal
    type Carries = Normal;
    type Walk<F: Num> = GreatCircle<F>;
    const VALUES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn polygon<R: Real>(self, _: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> GreatCircle<F> {
        GreatCircle::start(span.constants(), span.ends(), span.parameter(), lit.zero()) // 4.8–4.12
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        lit.shade(n) // 2.1
    }
}
