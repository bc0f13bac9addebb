//! Flat shading in the other definition: one colour a polygon, from the mean of its vertices (CS171 3, Algorithm 6).

use super::local::{Far, Lights, Near};
use super::{Corner, Corners, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, dot};
use crate::reference::Model;
use crate::walk::{Constant, Lerp};

/// Flat shading as CS171 defines it: the mean of the vertex normals, at the mean of the vertex positions, lit once.
///
/// The mean is normalised, which Algorithm 6 leaves out: the lighting model is for unit normals (trap T20).
#[derive(Debug)]
pub struct FlatAverage;

impl Method for FlatAverage {
    const INFO: Info = Info {
        name: "flat-average",
        title: "one colour a polygon, from the mean of its vertex normals",
        formula: "N = (N1 + ... + Nn) / |N1 + ... + Nn|;  P = (P1 + ... + Pn) / n;  I = eq 2.1 of N at P",
        source: "CS171 3, Algorithm 6",
        model: Model::FlatAverage,
        roundings: Roundings { start: 8.0, step: 0.0, of: Stepped::Colours },
        derivation: "as flat, and the mean normal takes 4 more roundings until it is a unit vector",
        fails: "as flat; where the vertex normals cancel there is no mean normal, and ambient light remains",
        parameters: &[],
        perspective: Perspective::Unaffected,
        local: Local::PerPolygon,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<Far, L>;
    type Perspective<const L: usize> = Of<Far, L>;
    type Local<const L: usize> = Of<Near, L>;
    type LocalPerspective<const L: usize> = Of<Near, L>;
}

/// Flat shading by mean normals with `L` lights.
#[derive(Debug)]
pub struct Of<P, const L: usize>(P);

impl<P: Lights, const L: usize> Shader for Of<P, L> {
    type Consts<N: Num> = P::Of<N, L>;
    type Attribute<R: Real> = Lerp<()>;
    type Polygon<R: Real> = [R; 3];
    type Walk<M: Machine> = Constant<[M::F; 3]>;
    type Pixel<F: Num> = [F; 3];

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> P::Of<N, L> {
        P::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &P::Of<M::One, L>, _: &Corner<'_, M>) -> Lerp<()> {
        Lerp(())
    }
    #[inline(always)]
    fn polygon<M: Machine>(c: &P::Of<M::One, L>, corners: &Corners<'_, M, Lerp<()>>) -> [M::One; 3] {
        let (model, there) = (P::model(c), P::there(c, || corners.mean_position()));
        let n = corners.mean_normal();
        let over_length = model.one() / dot(n, n).sqrt();
        let unit = [n[0] * over_length, n[1] * over_length, n[2] * over_length];
        model.clamped(model.lit(unit, P::seen(c, &there))) // 2.1
    }
    #[inline(always)]
    fn walk<M: Machine>(m: M, _: &P::Of<M::One, L>, colour: &[M::One; 3], _: &SpanOf<Self, M::One>) -> Self::Walk<M> {
        Constant(m.splat3(*colour))
    }
    #[inline(always)]
    fn shade<F: Num>(_: &P::Of<F, L>, colour: [F; 3]) -> [F; 3] {
        colour
    }
}
