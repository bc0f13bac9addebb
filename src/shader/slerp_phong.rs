//! Slerp Phong shading with scalars: `J` and `K` by incremental sines and cosines (L21 4.4, summary c).

use super::local::{Far, Lights, Near};
use super::{
    Corner, Corners, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped,
};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Constant, Sines, UnitNormal, Walk};

/// Slerp Phong shading, scalar form: unit normals walk great circles along the edges; along a span only `J = L·N` and
/// `K = V·N` are formed, from sines stepped by (4.9)–(4.12). No root and no division a pixel.
#[derive(Debug)]
pub struct SlerpPhong;

impl Method for SlerpPhong {
    const INFO: Info = Info {
        name: "slerp-phong",
        title: "J = L.N and K = V.N along great circles, by incremental sines and cosines",
        formula: "J(t) = sin((1-t)phi)/sin(phi) L.N1 + sin(t phi)/sin(phi) L.N2, K likewise; sines by eq 4.9-4.12\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "L21 4.4, eq 4.7-4.12, summary c",
        model: Model::Slerp,
        roundings: Roundings {
            start: 4.0,
            step: 2.0,
            of: Stepped::Cosines,
        },
        derivation: "each step turns a vector of length 1 by two products and a sum in each component, 1.5 * 2^-24 in all, with a \
                     rotation whose entries are rounded by half of 2^-24",
        fails: "on short spans, which pay one inverse tangent, three pairs of sine and cosine, two roots and a \
                division each; on triangles the picture depends on how they lie; opposite normals have no great circle",
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

/// Slerp Phong shading with `L` lights.
#[derive(Debug)]
pub struct Of<P, const L: usize>(P);

/// `J` of each light and `K` along a great circle: the ends, divided by sin φ, and the weights between them.
#[derive(Clone, Copy, Debug)]
pub struct Cosines<F, const L: usize> {
    sines: Sines<F>,
    j: [[F; 2]; L],
    k: [F; 2],
}

impl<F: Num, const L: usize> Walk for Cosines<F, L> {
    type Out = ([F; L], F);

    #[inline(always)]
    fn next(&mut self) -> Self::Out {
        let (from, to) = self.sines.next(); // 4.9–4.12
        let j = each(
            #[inline(always)]
            |i| from * self.j[i][0] + to * self.j[i][1], // 4.8, times L
        );
        (j, from * self.k[0] + to * self.k[1]) // 4.8, times V
    }
}

impl<P: Lights, const L: usize> Shader for Of<P, L> {
    type Consts<N: Num> = P::Of<N, L>;
    type Attribute<R: Real> = UnitNormal<R>;
    type Polygon<R: Real> = P::There<R, L>;
    type Walk<M: Machine> = (Cosines<M::F, L>, Constant<P::There<M::F, L>>);
    type Pixel<F: Num> = (([F; L], F), P::There<F, L>);

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
        c: &P::Of<M::One, L>,
        there: &P::There<M::One, L>,
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let (arc, seen) = (&span.attribute, P::seen(c, there));
        let (from, to) = (seen.light_cosines(arc.from), seen.light_cosines(arc.to));
        let cosines = Cosines {
            sines: Sines::new(m, arc.phi, arc.t0, arc.dt),
            j: each(
                #[inline(always)]
                |i| [m.splat(from[i]), m.splat(to[i])],
            ),
            k: [
                m.splat(seen.view_cosine(arc.from)),
                m.splat(seen.view_cosine(arc.to)),
            ],
        };
        (cosines, Constant(P::splat(m, there)))
    }
    #[inline(always)]
    fn shade<F: Num>(c: &P::Of<F, L>, ((j, k), there): Self::Pixel<F>) -> [F; 3] {
        P::model(c).colour_of_cosines(j, k, &P::seen(c, &there).scalars) // 4.5
    }
}
