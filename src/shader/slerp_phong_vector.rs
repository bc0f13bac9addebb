//! Slerp Phong shading with vectors: unit normals by incremental sines and cosines (L21 4.4, steps i–iv).

use super::local::{Far, Lights, Near};
use super::{
    Corner, Corners, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped,
};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Constant, Sines, UnitNormal, Walk};

/// Slerp Phong shading, vector form: unit normals walk great circles along edges *and* along spans, then eq 2.1 at
/// every pixel, without renormalising (L21 4.4, steps i–iv).
#[derive(Debug)]
pub struct SlerpPhongVector;

impl Method for SlerpPhongVector {
    const INFO: Info = Info {
        name: "slerp-phong-vector",
        title: "unit normals along great circles, by incremental sines and cosines",
        formula: "N(t) = sin((1-t)phi)/sin(phi) N1 + sin(t phi)/sin(phi) N2; sines by eq 4.9-4.12; eq 2.1",
        source: "L21 4.4, eq 4.7-4.12, steps i-iv",
        model: Model::Slerp,
        roundings: Roundings {
            start: 4.0,
            step: 2.0,
            of: Stepped::Cosines,
        },
        derivation: "as slerp-phong: the same sines carry the normals",
        fails: "as slerp-phong, at a higher price a pixel",
        parameters: &[],
        perspective: Perspective::ScreenOnly,
        local: Local::PerPolygon,
        barycentric: false,
    };
    type Screen<const L: usize> = Of<Far, L>;
    type Perspective<const L: usize> = Of<Far, L>;
    type Local<const L: usize> = Of<Near, L>;
    type LocalPerspective<const L: usize> = Of<Near, L>;
}

/// Slerp Phong shading with `L` lights and vectors.
#[derive(Debug)]
pub struct Of<P, const L: usize>(P);

/// A unit normal along a great circle: the ends, divided by sin φ, and the weights between them.
#[derive(Clone, Copy, Debug)]
pub struct Normals<F> {
    sines: Sines<F>,
    from: [F; 3],
    to: [F; 3],
}

impl<F: Num> Walk for Normals<F> {
    type Out = [F; 3];

    #[inline(always)]
    fn next(&mut self) -> [F; 3] {
        let (from, to) = self.sines.next(); // 4.9–4.12
        each(
            #[inline(always)]
            |i| from * self.from[i] + to * self.to[i], // 4.8
        )
    }
}

impl<P: Lights, const L: usize> Shader for Of<P, L> {
    type Consts<N: Num> = P::Of<N, L>;
    type Attribute<R: Real> = UnitNormal<R>;
    type Polygon<R: Real> = P::There<R, L>;
    type Walk<M: Machine> = (Normals<M::F>, Constant<P::There<M::F, L>>);
    type Pixel<F: Num> = ([F; 3], P::There<F, L>);

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> P::Of<N, L> {
        P::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &P::Of<M::One, L>, corner: &Corner<'_, M>) -> UnitNormal<M::One> {
        UnitNormal(corner.normal())
    }
    #[inline(always)]
    fn polygon<M: Machine>(
        c: &P::Of<M::One, L>,
        corners: &Corners<'_, M, UnitNormal<M::One>>,
    ) -> P::There<M::One, L> {
        P::there(c, || corners.mean_position())
    }
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &P::Of<M::One, L>,
        there: &P::There<M::One, L>,
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let arc = &span.attribute;
        let sines = Sines::new(m, arc.phi, arc.t0, arc.dt);
        let normals = Normals {
            sines,
            from: m.splat3(arc.from),
            to: m.splat3(arc.to),
        };
        (normals, Constant(P::splat(m, there)))
    }
    #[inline(always)]
    fn shade<F: Num>(c: &P::Of<F, L>, (n, there): Self::Pixel<F>) -> [F; 3] {
        P::model(c).lit(n, P::seen(c, &there)) // 2.1
    }
}
