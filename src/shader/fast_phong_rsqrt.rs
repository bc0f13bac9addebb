//! Fast Phong shading in the terms of today's hardware: the reciprocal root that processors have, D by second differences.

use super::duff_phong::{self, OverRoot};
use super::illumination::{Seen, SeenScalars};
use super::local::{Lights, Local as LocalLight, Near as NearLights};
use super::{
    Corner, Corners, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped,
};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Constant, Lerp, Linear, Quadratic, Ramp};

/// Fast Phong shading for processors that have a reciprocal square root: `J = L·N` and `K = V·N` by one addition each,
/// `D = N·N` by two, and `r = 1/√D` by the processor's estimate and one step of Newton's, which starts from no other pixel:
/// neighbouring pixels are independent, and eight of them are shaded at a time.
///
/// The diffuse term is `J r`, the specular term `(2 (J r) (K r) − L·V)^n`. Without such an estimate the root is a root and
/// a division, and the method [`super::DuffPhong`] where light and eye are at infinity.
#[derive(Debug)]
pub struct FastPhongRsqrt;

impl Method for FastPhongRsqrt {
    const INFO: Info = Info {
        name: "fast-phong-rsqrt",
        title: "J = L.N, K = V.N by additions, N.N by second differences, the reciprocal root by the hardware",
        formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = rsqrt(D)\n\
                  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "L21 4.2, 4.3, with the root that processors have had since 1999 (SSE rsqrtps)",
        model: Model::PhongConstant,
        roundings: Roundings {
            start: 10.4,
            step: 2.0,
            of: Stepped::Products,
        },
        derivation: "as duff-phong; the estimate of the root and its step are off by 6.4 roundings, where a root and a quotient \
                     are off by 2",
        fails: "where normals cancel inside a span, D is a small difference of large sums",
        parameters: &[],
        perspective: Perspective::Free,
        local: Local::PerPolygon,
        barycentric: false,
    };
    type Screen<const L: usize> = duff_phong::Of<Estimate, L>;
    type Perspective<const L: usize> = duff_phong::Of<Estimate, L>;
    type Local<const L: usize> = Near<L>;
    type LocalPerspective<const L: usize> = Near<L>;
}

/// By the processor's estimate and one step of Newton's.
#[derive(Debug)]
pub struct Estimate;

impl OverRoot for Estimate {
    #[inline(always)]
    fn of<F: Num>(d: F, _: F) -> F {
        d.over_sqrt()
    }
}

/// The same with some lights or the eye at positions: L and V are constant along each polygon (L21 1), those of the mean of
/// its corners.
#[derive(Debug)]
pub struct Near<const L: usize>;

impl<const L: usize> Shader for Near<L> {
    type Consts<N: Num> = LocalLight<N, L>;
    type Attribute<R: Real> = Lerp<[R; 3]>;
    type Polygon<R: Real> = Seen<R, L>;
    type Walk<M: Machine> = (
        ([Linear<M::F>; L], Linear<M::F>, Quadratic<M::F>),
        Constant<SeenScalars<M::F, L>>,
    );
    type Pixel<F: Num> = (([F; L], F, F), SeenScalars<F, L>);

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> LocalLight<N, L> {
        LocalLight::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &LocalLight<M::One, L>, corner: &Corner<'_, M>) -> Lerp<[M::One; 3]> {
        Lerp(corner.normal())
    }
    #[inline(always)]
    fn polygon<M: Machine>(
        c: &LocalLight<M::One, L>,
        corners: &Corners<'_, M, Lerp<[M::One; 3]>>,
    ) -> Seen<M::One, L> {
        c.seen_from(corners.mean_position())
    }
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &LocalLight<M::One, L>,
        seen: &Seen<M::One, L>,
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let Ramp { at: n, step: dn } = span.attribute;
        let (j, dj) = (seen.light_cosines(n), seen.light_cosines(dn));
        let light = each(
            #[inline(always)]
            |i| Linear::new(m, j[i], dj[i]), // 4.3
        );
        let view = Linear::new(m, seen.view_cosine(n), seen.view_cosine(dn));
        (
            (light, view, Quadratic::square(m, n, dn)),
            Constant(NearLights::splat(m, seen).scalars),
        )
    }
    #[inline(always)]
    fn shade<F: Num>(c: &LocalLight<F, L>, ((j, k, d), seen): Self::Pixel<F>) -> [F; 3] {
        let r = d.over_sqrt();
        let cosines = each(
            #[inline(always)]
            |i| j[i] * r,
        );
        c.model.colour_of_cosines(cosines, k * r, &seen)
    }
}
