//! Operation counts: a method runs on numbers that count.

use super::increments::{GreatCircle, Walk};
use super::kernels::{clamped, ramp};
use super::lighting::{Lit, Uniforms};
use super::planes::{Planes, each};
use super::varying::Varying;
use super::{LitAt, Local, Shader, Span, SpanBench, Variant};
use crate::number::{Counted, Counter, Counts, vec3};
use alloc::vec::Vec;

/// The operations of one method at each rate, for a material of shininess 32 (five multiplications per light).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OperationCounts {
    /// Once a vertex.
    pub vertex: Counts,
    /// Once a polygon.
    pub polygon: Counts,
    /// Once an edge.
    pub edge: Counts,
    /// Once an edge and scanline.
    pub edge_step: Counts,
    /// Once a span: from two edges to the first pixel.
    pub span: Counts,
    /// Once a pixel: stepping from the previous one.
    pub walk: Counts,
    /// Once a pixel: its colour.
    pub shade: Counts,
}

/// Counts the operations of a method on a span whose pixels have a highlight, and on its vertices and edges.
pub(super) fn count<M: Shader>(bench: &SpanBench, variant: &Variant) -> OperationCounts {
    let counter = Counter::default();
    let number = |x: f32| counter.number(x);
    let three = |v: [f32; 3]| vec3(v.map(number));
    let (info, extras) = (variant.info(), bench.extras(variant));
    let Uniforms { model, lights } = &bench.uniforms(info.local, 1.0);
    let method = M::new(variant.parameters(), model);
    let lit = |point| Lit::new(*model, lights, point, model.is_general);
    let is_polygon = matches!(info.lit_at, LitAt::Polygon | LitAt::PolygonMean);
    let mut counts = OperationCounts::default();

    let corners = [0, 1, 2].map(|i| {
        counter.take();
        let normal = match info.lit_at {
            LitAt::Polygon => three(SpanBench::FACE),
            LitAt::PolygonMean => {
                let [a, b, c] = bench.normals.map(vec3);
                three(((a + b + c) * (1.0 / 3.0)).array()).unit()
            }
            LitAt::Vertex | LitAt::Pixel => three(bench.normals[i]),
        };
        let varying = method.vertex(&lit(three(bench.points[i])), normal);
        let mut corner: Vec<Counted<'_>> = Vec::new();
        each(varying, |_, x| {
            corner.push(clamped::<M, _>(*x, model.scale))
        });
        if extras.point {
            corner.extend(bench.points[i].map(number));
        }
        if extras.weight {
            corner.push(number(1.0));
        }
        corner
    });
    if !is_polygon {
        counts.vertex = counter.take();
    }
    if info.local == Local::PerPolygon && bench.is_near() {
        // Light and eye as the polygon sees them.
        let Uniforms { model, lights } = Uniforms::new(&bench.lighting, 1.0);
        let lit = Lit::new(model, &lights, three(bench.points[0]), true);
        lit.lights().count();
    }
    counts.polygon = counter.take();

    let (face, t0, dt) = (three(SpanBench::FACE), number(0.01), number(0.02));
    let [a, b, c] = &corners;
    let (mut start, mut extra) = (Vec::new(), Vec::new());
    if <M::Varying<Counted<'_>> as Varying<Counted<'_>>>::GREAT_CIRCLE {
        let normal = |corner: &[_]| vec3([corner[0], corner[1], corner[2]]);
        let circle = |from, to| GreatCircle::new(face, [from, to], t0, dt);
        let mut left = circle(normal(a), normal(c));
        counts.edge = counter.take();
        left.sines.next();
        counts.edge_step = counter.take();
        let right = circle(normal(b), normal(c));
        counter.take();
        let span = circle(left.normal(), right.normal());
        each(span, |_, value| start.push(*value));
    } else {
        let ramps = |from: &[_], to: &[_]| -> Vec<_> {
            let ends = from.iter().zip(to);
            ends.map(|(a, b)| ramp(*a, *b, t0, dt)).collect()
        };
        let column =
            |ramps: &[[_; 2]], i: usize| -> Vec<_> { ramps.iter().map(|r| r[i]).collect() };
        let mut left = ramps(a, c);
        counts.edge = counter.take();
        left.iter_mut().for_each(|[at, step]| *at = *at + *step);
        counts.edge_step = counter.take();
        let right = ramps(b, c);
        counter.take();
        let mut span = ramps(&column(&left, 0), &column(&right, 0));
        extra = span.split_off(span.len() - extras.count());
        start = [column(&span, 0), column(&span, 1)].concat();
    }
    if is_polygon {
        // Nothing is interpolated.
        counter.take();
        (counts.edge, counts.edge_step) = Default::default();
    }
    let here = lit(three(bench.points[0]));
    let span = Span::<M, _>::filled(lights.len(), start[0]);
    let mut walk = method.walk(&here, each(span, |i, number| *number = start[i]));
    counts.span = counter.take();

    let pixel = walk.next();
    for [at, step] in extra {
        let _ = at + step;
    }
    counts.walk = counter.take();
    let (pixel, point) = extras.divided(pixel, (here.point, number(1.0)));
    method.shade(&lit(point), pixel);
    counts.shade = counter.take();
    counts
}
