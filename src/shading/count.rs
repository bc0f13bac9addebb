//! How many operations a method takes, counted by running it on numbers that count.

use super::increments::{GreatCircle, Walk};
use super::kernels::{clamped, ramp};
use super::lighting::Lit;
use super::planes::Planes;
use super::span_bench::FACE;
use super::varying::Varying;
use super::{LitAt, Local, Shader, SpanBench, Variant};
use crate::number::{Counted, Counter, Counts, Num, Vec3, vec3};
use alloc::vec::Vec;

/// The operations of one method at each rate, for a material of shininess 32 (five multiplications a light).
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

/// Counts what a method does for a span whose pixels have a highlight, and for its vertices and edges.
pub(super) fn count<M: Shader>(bench: &SpanBench, variant: &Variant) -> OperationCounts {
    let counter = Counter::default();
    let number = |x: f32| counter.number(x);
    let three = |v: [f32; 3]| vec3(v.map(number));
    let uniforms = bench.uniforms(M::INFO.local, 1.0);
    let (model, lights) = (uniforms.model, &uniforms.lights[..]);
    let method = M::new(variant.parameters(), &model);
    let lit = |point: [f32; 3]| Lit::new(model, lights, three(point), model.is_general);
    let is_polygon = matches!(M::INFO.lit_at, LitAt::Polygon | LitAt::PolygonMean);

    let mut counts = OperationCounts::default();
    let mut corners: [Vec<Counted<'_>>; 3] = [Vec::new(), Vec::new(), Vec::new()];
    for (i, corner) in corners.iter_mut().enumerate() {
        counter.take();
        let normal = match M::INFO.lit_at {
            LitAt::Polygon => three(FACE),
            LitAt::PolygonMean => mean_normal(&counter, bench).unit(),
            LitAt::Vertex | LitAt::Pixel => three(bench.normals[i]),
        };
        let varying = method.vertex(&lit(bench.points[i]), normal);
        varying.put(&mut |value| corner.push(clamped::<M, _>(value, model.scale)));
        let lit_here = counter.take();
        if is_polygon {
            counts.polygon = lit_here;
        } else {
            counts.vertex = lit_here;
        }
    }
    let extras = bench.extras(variant);
    let own = corners[0].len();
    for (corner, point) in corners.iter_mut().zip(bench.points) {
        if extras.point {
            corner.extend(point.map(number));
        }
        if extras.weight {
            corner.push(number(1.0));
        }
    }
    if M::INFO.local == Local::PerPolygon && bench.lighting.is_local() {
        // Light and eye as the polygon sees them.
        let near = super::lighting::Uniforms::new(&bench.lighting, 1.0);
        let lit = Lit::new(near.model, &near.lights, three(bench.points[0]), true);
        lit.lights().count();
        let seen = counter.take();
        counts.polygon = add(counts.polygon, seen);
    }

    let (t0, dt) = (number(0.01), number(0.02));
    let [a, b, c] = &corners;
    let (mut start, mut steps) = (Vec::new(), Vec::new());
    counter.take();
    if <M::Varying<Counted<'_>> as Varying<Counted<'_>>>::GREAT_CIRCLE {
        let face = three(FACE);
        let mut left = GreatCircle::new(face, [normal(a), normal(c)], t0, dt);
        counts.edge = counter.take();
        left.sines.next();
        counts.edge_step = counter.take();
        let right = GreatCircle::new(face, [normal(b), normal(c)], t0, dt);
        counter.take();
        GreatCircle::new(face, [left.normal(), right.normal()], t0, dt)
            .put(&mut |value| start.push(value));
    } else if !is_polygon {
        let mut left: Vec<_> = a.iter().zip(c).map(|(a, c)| ramp(*a, *c, t0, dt)).collect();
        counts.edge = counter.take();
        left.iter_mut().for_each(|[at, step]| *at = *at + *step);
        counts.edge_step = counter.take();
        let right: Vec<_> = b.iter().zip(c).map(|(b, c)| ramp(*b, *c, t0, dt)).collect();
        counter.take();
        for (left, right) in left.iter().zip(&right) {
            let [at, step] = ramp(left[0], right[0], t0, dt);
            start.push(at);
            steps.push(step);
        }
    } else {
        start.clone_from(a);
        steps = a.iter().map(|value| Num::like(*value, 0.0)).collect();
    }
    let extra = start.split_off(if steps.is_empty() { start.len() } else { own });
    let extra_steps = if steps.is_empty() {
        Vec::new()
    } else {
        steps.split_off(own)
    };
    start.extend(steps);
    let mut numbers = start.into_iter();
    let none = number(0.0);
    let span = Planes::get(lights.len(), &mut || numbers.next().unwrap_or(none));
    let here = lit(bench.points[0]);
    let mut walk = method.walk(&here, span);
    counts.span = counter.take();

    let mut pixel = walk.next();
    for (at, step) in extra.iter().zip(&extra_steps) {
        let _ = *at + *step;
    }
    counts.walk = counter.take();
    let mut lit = here;
    if extras.weight {
        let w = number(1.0) / number(1.0);
        let mut all = Vec::new();
        pixel.put(&mut |value| all.push(value * w));
        let mut all = all.into_iter();
        pixel = Planes::get(lights.len(), &mut || all.next().unwrap_or(none));
        if extras.point {
            lit.point = lit.point * w;
        }
    }
    let lit = Lit::new(model, lights, lit.point, model.is_general);
    method.shade(&lit, pixel);
    counts.shade = counter.take();
    counts
}

/// Returns the normal that a corner begins with.
fn normal<'a>(corner: &[Counted<'a>]) -> Vec3<Counted<'a>> {
    vec3([corner[0], corner[1], corner[2]])
}

/// Returns the sum of the vertex normals, which are there before anything is lit.
fn mean_normal<'a>(counter: &'a Counter, bench: &SpanBench) -> Vec3<Counted<'a>> {
    let [a, b, c] = bench.normals.map(vec3);
    let sum = (a + b + c) * (1.0 / 3.0);
    vec3(sum.array().map(|x| counter.number(x)))
}

fn add(a: Counts, b: Counts) -> Counts {
    Counts {
        additions: a.additions + b.additions,
        multiplications: a.multiplications + b.multiplications,
        divisions: a.divisions + b.divisions,
        roots: a.roots + b.roots,
        comparisons: a.comparisons + b.comparisons,
        trigonometric: a.trigonometric + b.trigonometric,
        powers: a.powers + b.powers,
    }
}
