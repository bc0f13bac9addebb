//! Flat shading: one colour a polygon (L21 2).

use super::local::{Far, Lights, Near};
use super::{Corner, Corners, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real};
use crate::reference::Model;
use crate::walk::{Constant, Lerp};

/// Flat (uniform) shading: the polygon's own normal, lit once (L21 2.1).
///
/// Light and eye at positions are seen from the mean of the polygon's corners.
#[derive(Debug)]
pub struct Flat;

impl Method for Flat {
    const INFO: Info = Info {
        name: "flat",
        title: "one colour a polygon, from its own normal",
        formula: "I = Ia ka + Ip kd (L.N) + Ip ks (R.V)^n, N the polygon's normal by Newell's formula",
        source: "L21 2, eq 2.1 (Bouknight 1970)",
        model: Model::Flat,
        roundings: Roundings { start: 4.0, step: 0.0, of: Stepped::Colours },
        derivation: "nothing is stepped; L.N and R.V take 8 roundings each of at most half of 2^-24",
        fails: "every polygon edge is visible, and exaggerated by the eye (Mach bands)",
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

/// Flat shading with `L` lights.
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
        model.clamped(model.lit(corners.normal(), P::seen(c, &there))) // 2.1
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
