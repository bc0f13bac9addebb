//! Gouraud shading: vertex colours, interpolated linearly (L21 3).

use super::illumination::Illumination;
use super::{Corners, Info, Method, Perspective, Roundings, Shader, SpanOf, Stepped};
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
        roundings: Roundings { start: 4.0, step: 1.0, of: Stepped::Colours },
        derivation: "a vertex is lit as in flat shading; each step of a colour of at most 1 rounds by half of 2^-24, and so does the \
                     weight under perspective",
        fails: "highlights inside a polygon are lost or smeared; the slope of the intensity still jumps at edges",
        parameters: &[],
        perspective: Perspective::Divides,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<L>;
    type Perspective<const L: usize> = Weighted<L>;
}

/// Gouraud shading with `L` lights, linear on the screen.
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
    fn vertex<R: Real>(c: &Illumination<R, L>, normal: [R; 3]) -> Lerp<[R; 3]> {
        Lerp(c.clamped(c.lit(normal)))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &Illumination<M::One, L>, _: &Corners<'_, M, Lerp<[M::One; 3]>>) {}
    #[inline(always)]
    fn walk<M: Machine>(m: M, _: &Illumination<M::One, L>, _: &(), span: &SpanOf<Self, M::One>) -> Self::Walk<M> {
        let (at, step) = (span.attribute.at, span.attribute.step);
        each(
            #[inline(always)]
            |i| Linear::new(m, at[i], step[i]), // 3.5, 3.6
        )
    }
    #[inline(always)]
    fn shade<F: Num>(_: &Illumination<F, L>, colour: [F; 3]) -> [F; 3] {
        colour
    }
}

/// Gouraud shading with `L` lights, linear in space: `I/w` and `1/w` are interpolated and divided.
#[derive(Debug)]
pub struct Weighted<const L: usize>;

impl<const L: usize> Shader for Weighted<L> {
    type Consts<N: Num> = Illumination<N, L>;
    type Attribute<R: Real> = Lerp<([R; 3], R)>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = ([Linear<M::F>; 3], Linear<M::F>);
    type Pixel<F: Num> = ([F; 3], F);

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: impl Fn(f32) -> N) -> Illumination<N, L> {
        Illumination::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<R: Real>(c: &Illumination<R, L>, normal: [R; 3]) -> Lerp<([R; 3], R)> {
        Lerp((c.clamped(c.lit(normal)), c.one()))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &Illumination<M::One, L>, _: &Corners<'_, M, Lerp<([M::One; 3], M::One)>>) {}
    #[inline(always)]
    fn walk<M: Machine>(m: M, _: &Illumination<M::One, L>, _: &(), span: &SpanOf<Self, M::One>) -> Self::Walk<M> {
        let (at, step) = (span.attribute.at, span.attribute.step);
        let colour = each(
            #[inline(always)]
            |i| Linear::new(m, at.0[i], step.0[i]),
        );
        (colour, Linear::new(m, at.1, step.1))
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Illumination<F, L>, (colour, weight): Self::Pixel<F>) -> [F; 3] {
        let w = c.one() / weight;
        [colour[0] * w, colour[1] * w, colour[2] * w]
    }
}
