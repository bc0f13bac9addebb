//! Gouraud shading: vertex colours, interpolated linearly (L21 3).

use super::local::{Far, Lights, Near};
use super::{
    Corner, Corners, Given, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped,
};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Lerp, Linear};

/// Gouraud shading: eq 2.1 at the vertices, then one addition a channel along edges and spans (L21 3.5–3.6).
///
/// The vertex colours are clamped to 0..=1 before they are interpolated, so no pixel needs a clamp.
#[derive(Debug)]
pub struct Gouraud;

impl Method for Gouraud {
    const INFO: Info = Info {
        name: "gouraud",
        title: "vertex colours, interpolated along edges and spans",
        formula: "dI = (I2 - I1) / (y2 - y1) along edges, (I2 - I1) / (x2 - x1) along spans; I_next = I + dI",
        source: "L21 3, eq 3.5, 3.6 (Gouraud 1971)",
        model: Model::Gouraud,
        roundings: Roundings {
            start: 4.0,
            step: 1.0,
            of: Stepped::Colours,
        },
        derivation: "a vertex is lit as in flat shading; each step of a colour of at most 1 rounds by half of 2^-24, and so does the \
                     weight under perspective",
        fails: "highlights inside a polygon are lost or smeared; the slope of the intensity still jumps at edges",
        parameters: &[],
        perspective: Perspective::Divides,
        local: Local::PerVertex,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<Far, L>;
    type Perspective<const L: usize> = Weighted<Far, L>;
    type Local<const L: usize> = Of<Near, L>;
    type LocalPerspective<const L: usize> = Weighted<Near, L>;
}

/// The clamped colour of a vertex.
#[inline(always)]
fn colour<P: Lights, M: Machine, const L: usize>(
    c: &P::Of<M::One, L>,
    corner: &Corner<'_, M>,
) -> [M::One; 3] {
    let (model, there) = (P::model(c), P::there(c, || corner.position()));
    model.clamped(model.lit(corner.normal(), P::seen(c, &there))) // 2.1
}

/// Gouraud shading with `L` lights, linear on the screen.
#[derive(Debug)]
pub struct Of<P, const L: usize>(P);

impl<P: Lights, const L: usize> Shader for Of<P, L> {
    type Consts<N: Num> = P::Of<N, L>;
    type Attribute<R: Real> = Lerp<[R; 3]>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = [Linear<M::F>; 3];
    type Pixel<F: Num> = [F; 3];
    const GIVEN: Given = Given::Attribute;

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> P::Of<N, L> {
        P::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(c: &P::Of<M::One, L>, corner: &Corner<'_, M>) -> Lerp<[M::One; 3]> {
        Lerp(colour::<P, M, L>(c, corner))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &P::Of<M::One, L>, _: &Corners<'_, M, Lerp<[M::One; 3]>>) {}
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &P::Of<M::One, L>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let (at, step) = (span.attribute.at, span.attribute.step);
        each(
            #[inline(always)]
            |i| Linear::new(m, at[i], step[i]), // 3.5, 3.6
        )
    }
    #[inline(always)]
    fn shade<F: Num>(_: &P::Of<F, L>, colour: [F; 3]) -> [F; 3] {
        colour
    }
    /// Clamped colours are at most 1 between vertices too.
    #[inline(always)]
    fn usual<N: Num>(consts: &P::Of<N, L>, _: N) -> Option<P::Of<N, L>> {
        Some(*consts)
    }
    #[inline(always)]
    fn scaled<F: Num>(_: &P::Of<F, L>, colour: [F; 3], scale: F) -> [F; 3] {
        [colour[0] * scale, colour[1] * scale, colour[2] * scale]
    }
}

/// Gouraud shading with `L` lights, linear in space: `I/w` and `1/w` are interpolated and divided.
#[derive(Debug)]
pub struct Weighted<P, const L: usize>(P);

impl<P: Lights, const L: usize> Shader for Weighted<P, L> {
    type Consts<N: Num> = P::Of<N, L>;
    type Attribute<R: Real> = Lerp<([R; 3], R)>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = ([Linear<M::F>; 3], Linear<M::F>);
    type Pixel<F: Num> = ([F; 3], F);
    const GIVEN: Given = Given::Attribute;

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> P::Of<N, L> {
        P::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(
        c: &P::Of<M::One, L>,
        corner: &Corner<'_, M>,
    ) -> Lerp<([M::One; 3], M::One)> {
        Lerp((colour::<P, M, L>(c, corner), P::model(c).one()))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &P::Of<M::One, L>, _: &Corners<'_, M, Lerp<([M::One; 3], M::One)>>) {}
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &P::Of<M::One, L>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let (at, step) = (span.attribute.at, span.attribute.step);
        let colour = each(
            #[inline(always)]
            |i| Linear::new(m, at.0[i], step.0[i]),
        );
        (colour, Linear::new(m, at.1, step.1))
    }
    #[inline(always)]
    fn shade<F: Num>(c: &P::Of<F, L>, (colour, weight): Self::Pixel<F>) -> [F; 3] {
        let w = P::model(c).one() / weight;
        [colour[0] * w, colour[1] * w, colour[2] * w]
    }
}
