//! Naive Phong shading: normals, interpolated and renormalised at every pixel (L21 4.1).

use super::illumination::Illumination;
use super::{Corners, Info, Method, Perspective, Roundings, Shader, SpanOf, Stepped};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, dot, each};
use crate::reference::Model;
use crate::walk::{Lerp, Linear};

/// Naive Phong shading: N by three additions a pixel, then a root, a division and eq 2.1 (L21 4.1–4.2).
///
/// The interpolated normal and the unit normal are two variables, as in section 4.1. The lecture's summary feeds the
/// unit normal back into the sum (`N_next = (N + ΔN)/|N + ΔN|`), which is not linear interpolation and never arrives at
/// N_2. Normals on edges are not renormalised: on triangles the picture would then depend on how they lie.
#[derive(Debug)]
pub struct NaivePhong;

impl Method for NaivePhong {
    const INFO: Info = Info {
        name: "naive-phong",
        title: "normals, interpolated and renormalised at every pixel",
        formula: "N_next = N + dN;  N_unit = N / |N|;  R = 2 (L.N_unit) N_unit - L;  eq 2.1 at every pixel",
        source: "L21 4.1, eq 4.1, 4.2 (Phong 1975)",
        model: Model::Phong,
        roundings: Roundings { start: 4.0, step: 0.9, of: Stepped::Cosines },
        derivation: "each step rounds the three components of N by half of 2^-24, which is a vector of length 0.87 * 2^-24; what \
                     lies along N is lost when N is normalised",
        fails: "where normals cancel inside a span; the slope of the intensity still jumps at edges (Duff 1979)",
        parameters: &[],
        perspective: Perspective::Free,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<L>;
    type Perspective<const L: usize> = Of<L>;
}

/// Naive Phong shading with `L` lights.
#[derive(Debug)]
pub struct Of<const L: usize>;

impl<const L: usize> Shader for Of<L> {
    type Consts<N: Num> = Illumination<N, L>;
    type Attribute<R: Real> = Lerp<[R; 3]>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = [Linear<M::F>; 3];
    type Pixel<F: Num> = [F; 3];

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: impl Fn(f32) -> N) -> Illumination<N, L> {
        Illumination::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<R: Real>(_: &Illumination<R, L>, normal: [R; 3]) -> Lerp<[R; 3]> {
        Lerp(normal)
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &Illumination<M::One, L>, _: &Corners<'_, M, Lerp<[M::One; 3]>>) {}
    #[inline(always)]
    fn walk<M: Machine>(m: M, _: &Illumination<M::One, L>, _: &(), span: &SpanOf<Self, M::One>) -> Self::Walk<M> {
        let (n, dn) = (span.attribute.at, span.attribute.step);
        each(
            #[inline(always)]
            |i| Linear::new(m, n[i], dn[i]), // 4.1, 4.2
        )
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Illumination<F, L>, n: [F; 3]) -> [F; 3] {
        let r = c.one() / dot(n, n).sqrt();
        c.lit([n[0] * r, n[1] * r, n[2] * r]) // N_unit = N / |N|, 2.1
    }
}
