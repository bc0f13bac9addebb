//! Slerp Phong shading with vectors: unit normals by incremental sines and cosines (L21 4.4, steps i–iv).

use super::illumination::Illumination;
use super::{Corners, Info, Method, Perspective, Roundings, Shader, SpanOf, Stepped};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Sines, UnitNormal, Walk};

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
        roundings: Roundings { start: 4.0, step: 2.0, of: Stepped::Cosines },
        derivation: "as slerp-phong: the same sines carry the normals",
        fails: "as slerp-phong, at a higher price a pixel",
        parameters: &[],
        perspective: Perspective::ScreenOnly,
        barycentric: false,
    };
    type Screen<const L: usize> = Of<L>;
    type Perspective<const L: usize> = Of<L>;
}

/// Slerp Phong shading with `L` lights and vectors.
#[derive(Debug)]
pub struct Of<const L: usize>;

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

impl<const L: usize> Shader for Of<L> {
    type Consts<N: Num> = Illumination<N, L>;
    type Attribute<R: Real> = UnitNormal<R>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = Normals<M::F>;
    type Pixel<F: Num> = [F; 3];

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: impl Fn(f32) -> N) -> Illumination<N, L> {
        Illumination::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<R: Real>(_: &Illumination<R, L>, normal: [R; 3]) -> UnitNormal<R> {
        UnitNormal(normal)
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &Illumination<M::One, L>, _: &Corners<'_, M, UnitNormal<M::One>>) {}
    #[inline(always)]
    fn walk<M: Machine>(m: M, _: &Illumination<M::One, L>, _: &(), span: &SpanOf<Self, M::One>) -> Self::Walk<M> {
        let arc = &span.attribute;
        let splat = |v: [M::One; 3]| [m.splat(v[0]), m.splat(v[1]), m.splat(v[2])];
        Normals { sines: Sines::new(m, arc.phi, arc.t0, arc.dt), from: splat(arc.from), to: splat(arc.to) }
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Illumination<F, L>, n: [F; 3]) -> [F; 3] {
        c.lit(n)
    }
}
