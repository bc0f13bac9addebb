//! Gouraud shading with diffuse and specular light interpolated apart (L21 3; OpenGL's separate specular colour).

use super::local::{Far, Lights, Near};
use super::{
    Corner, Corners, Given, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped,
};
use crate::lighting::{LightTerm, Lighting};
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Lerp, Linear};

/// Gouraud shading whose vertex colours are not clamped: ambient and diffuse light in one colour, specular light in
/// another, both interpolated, summed and clamped at each pixel.
///
/// As interpolation is linear this is the unclamped sum of vertex colours, clamped last (trap T12): where lights add up
/// to over 1 at a vertex, [`super::Gouraud`] shows a slope that starts at once, and this method a plateau first. Kept
/// apart, the two colours can be treated apart: a texture would be multiplied by the first only.
#[derive(Debug)]
pub struct GouraudSeparate;

impl Method for GouraudSeparate {
    const INFO: Info = Info {
        name: "gouraud-separate",
        title: "vertex colours not clamped, diffuse and specular light interpolated apart",
        formula: "D_next = D + dD;  S_next = S + dS;  I = min(1, D + S), D = Ia ka + Ip kd (L.N), S = Ip ks (R.V)^n at vertices",
        source: "L21 3, eq 3.5, 3.6; OpenGL 1.2, 2.13.1 (separate specular colour)",
        model: Model::GouraudSeparate,
        roundings: Roundings {
            start: 6.0,
            step: 1.0,
            of: Stepped::Sums,
        },
        derivation: "as Gouraud, with two colours that are stepped, added, and at most the sum of all light between them",
        fails: "as Gouraud",
        parameters: &[],
        perspective: Perspective::Divides,
        local: Local::PerVertex,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<Far, 0, L>;
    type Perspective<const L: usize> = Of<Far, 1, L>;
    type Local<const L: usize> = Of<Near, 0, L>;
    type LocalPerspective<const L: usize> = Of<Near, 1, L>;
}

/// Gouraud shading with `L` lights and two colours, with `W` weights: linear in space (1) or on the screen (0).
#[derive(Debug)]
pub struct Of<P, const W: usize, const L: usize>(P);

/// Two colours and the weight of perspective interpolation.
type Colours<R> = ([R; 3], [R; 3], R);

impl<P: Lights, const W: usize, const L: usize> Shader for Of<P, W, L> {
    /// The light without highlights, and the highlights alone.
    type Consts<N: Num> = [P::Of<N, L>; 2];
    type Attribute<R: Real> = Lerp<Colours<R>>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = ([Linear<M::F>; 3], [Linear<M::F>; 3], [Linear<M::F>; W]);
    type Pixel<F: Num> = ([F; 3], [F; 3], [F; W]);
    const GIVEN: Given = Given::Attribute;

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> Self::Consts<N> {
        let part = |change: fn(&mut LightTerm), ambient| {
            let mut part = Lighting {
                ambient,
                ..lighting.clone()
            };
            part.lights.iter_mut().for_each(change);
            P::new(&part, of)
        };
        [
            part(|l| l.specular = [0.0; 3], lighting.ambient),
            part(|l| l.diffuse = [0.0; 3], [0.0; 3]),
        ]
    }
    #[inline(always)]
    fn vertex<M: Machine>(
        c: &Self::Consts<M::One>,
        corner: &Corner<'_, M>,
    ) -> Lerp<Colours<M::One>> {
        let there = P::there(&c[0], || corner.position());
        let seen = P::seen(&c[0], &there);
        let colour = |part: usize| P::model(&c[part]).lit(corner.normal(), seen); // 2.1
        Lerp((colour(0), colour(1), P::model(&c[0]).one()))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &Self::Consts<M::One>, _: &Corners<'_, M, Self::Attribute<M::One>>) {}
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &Self::Consts<M::One>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let (at, step) = (span.attribute.at, span.attribute.step);
        let colour = |at: [M::One; 3], step: [M::One; 3]| {
            each(
                #[inline(always)]
                |i| Linear::new(m, at[i], step[i]), // 3.5, 3.6
            )
        };
        let weight = [Linear::new(m, at.2, step.2); W];
        (colour(at.0, step.0), colour(at.1, step.1), weight)
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Self::Consts<F>, (diffuse, specular, weight): Self::Pixel<F>) -> [F; 3] {
        let model = P::model(&c[0]);
        let sum: [F; 3] = each(
            #[inline(always)]
            |i| diffuse[i] + specular[i],
        );
        if W == 0 {
            return sum;
        }
        let w = model.one() / weight[0];
        [sum[0] * w, sum[1] * w, sum[2] * w]
    }
}
