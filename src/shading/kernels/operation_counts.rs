//! Operation counts: the same code that draws, run on values that count their operations.

use crate::number::{Counted, Counter, Counts, Real, vec3};
use crate::shading::kernels::colour;
use crate::shading::kernels::runs::RunStart;
use crate::shading::light::LightAt;
use crate::shading::light::eye_frame::carried;
use crate::shading::walks::values::each;
use crate::shading::walks::{GreatCircle, Walk};
use crate::shading::{
    Carries, CarriesOf, Extras, Kinds, Local, Method, Shader, ShadingRate, Span, SpanBench,
    SpanPlace, Values, Variant, Visit, ramp,
};
use alloc::vec::Vec;

/// The operations of a method at each rate, on a material of shininess 32 (five multiplications per
/// light).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct OperationCounts {
    /// Per vertex.
    pub vertex: Counts,
    /// Per polygon.
    pub polygon: Counts,
    /// Per edge.
    pub edge: Counts,
    /// Per edge and scanline.
    pub edge_step: Counts,
    /// Per span: from two edges to the first pixel.
    pub span: Counts,
    /// Per pixel, to step from the previous one.
    pub walk: Counts,
    /// Per pixel, to compute its colour.
    pub shade: Counts,
}

/// The result of counting on a span.
pub(crate) struct CountedSpan {
    pub operations: OperationCounts,
    /// The colour of the first pixel, equal to an engine's in every bit.
    #[cfg_attr(not(test), expect(dead_code))]
    pub colour: [f32; 3],
}

/// Counts the operations of a method on a span whose pixels have a highlight, and on its vertices
/// and edges. It calls the functions by which engines start edges and spans, walk and shade.
pub(crate) fn count<M: Method>(bench: &SpanBench, variant: &Variant) -> CountedSpan {
    let counter = Counter::default();
    let value = |x: f32| counter.counted(x);
    let three = |v: [f32; 3]| vec3(v.map(value));
    let (row, extras) = (variant.row(), bench.extras(variant));
    let uniforms = bench.uniforms(variant, 1.0);
    let method = M::new(variant.parameters(), &uniforms.model);
    let (face, zero) = (three(SpanBench::FACE), value(0.0));
    let lit = LightAt::new(uniforms.stored(), zero, uniforms.model.is_general);
    let is_polygon = matches!(
        row.needs.shading_rate,
        ShadingRate::Polygon | ShadingRate::PolygonMean
    );
    let mut counts = OperationCounts::default();

    // A loop, because a map over the array would be compiled three times for each method.
    let mut corners = [const { Vec::new() }; 3];
    for (i, corner) in corners.iter_mut().enumerate() {
        counter.take();
        let normal = match row.needs.shading_rate {
            ShadingRate::Polygon => face,
            ShadingRate::PolygonMean => {
                let [a, b, c] = bench.normals.map(vec3);
                three(((a + b + c) * (1.0 / 3.0)).array()).unit()
            }
            ShadingRate::Vertex | ShadingRate::Pixel => three(bench.normals[i]),
        };
        let lit = lit.at(three(bench.points[i]));
        let varying = carried::<CarriesOf<M>, _>(&uniforms, &lit, normal);
        put(varying, corner);
        if extras.point {
            corner.extend(bench.points[i].map(value));
        }
        if extras.weight {
            corner.push(value(1.0));
        }
    }
    if !is_polygon {
        counts.vertex = counter.take();
    }
    if row.needs.local == Local::PerPolygon && bench.is_local() {
        // Computes light and eye as the polygon sees them.
        let uniforms = variant.uniforms(&bench.lighting, 1.0);
        let lit = LightAt::new(uniforms.stored(), zero, true).at(three(bench.points[0]));
        lit.lights().count();
    }
    counts.polygon = counter.take();

    let polygon = bench.polygon(SpanBench::LENGTH, value);
    let corners_of_polygon = polygon.corners();
    counter.take();
    let chosen = method.polygon(&lit, &corners_of_polygon);
    let planned = counter.take();
    if M::NEEDS.reads_span() || !M::Kinds::NAMES.is_empty() {
        counts.polygon = planned;
    }

    let [a, b, c] = &corners;
    let [t0, dt] = SpanBench::EDGE.map(value);
    let vector = |values: &[_]| vec3([values[0], values[1], values[2]]);
    let ends: [Vec<Counted<'_>>; 2];
    if M::NEEDS.great_circles() {
        let circle = |from, to| GreatCircle::new(face, [from, to], t0, dt);
        let [left, right] = [a, b].map(|corner| circle(vector(corner), vector(c)));
        counter.take();
        circle(vector(a), vector(c));
        counts.edge = counter.take();
        left.sines.clone().next();
        counts.edge_step = counter.take();
        ends = [left, right].map(|circle| circle.normal().array().to_vec());
    } else {
        let ramps = |from: &[_], to: &[_]| -> Vec<_> {
            let ends = from.iter().zip(to);
            ends.map(|(a, b)| ramp(*a, *b, t0, dt)).collect()
        };
        let mut left = ramps(a, c);
        counts.edge = counter.take();
        let at: Vec<_> = left.iter().map(|ramp| ramp[0]).collect();
        left.iter_mut().for_each(|[at, step]| *at = *at + *step);
        counts.edge_step = counter.take();
        let right = ramps(b, c).iter().map(|ramp| ramp[0]).collect();
        counter.take();
        ends = [at, right];
    }
    if is_polygon {
        // Lit once per polygon: nothing is interpolated.
        counter.take();
        (counts.edge, counts.edge_step) = Default::default();
    }

    let [t0, dt] = SpanBench::SPAN.map(value);
    let pairs = ends[0].iter().zip(&ends[1]);
    let [mut first, mut second] = [Vec::new(), Vec::new()];
    for (a, b) in pairs {
        let [at, step] = match is_polygon {
            true => [*a, zero],
            false => M::NEEDS.start([*a, *b], t0, dt),
        };
        first.push(at);
        second.push(step);
    }
    let mut planned = Vec::new();
    let kind = M::Kinds::put(chosen, |_, value| planned.push(*value));
    let start = RunStart {
        values: [&first, &second],
        x: 0,
        pixels: SpanBench::PIXELS,
        place: M::NEEDS.reads_span().then_some(SpanPlace {
            y: 0,
            t0,
            dt,
            start: 0,
            pixels: 50,
        }),
        constants: &planned,
    };
    let own = first.len() - extras.count();
    let mut colour = [0.0; 3];
    let run = CountedRun {
        counter: &counter,
        counts: &mut counts,
        colour: &mut colour,
        lit,
        start,
        own,
        extras,
        zero,
    };
    method.kinds().visit(kind, run);
    CountedSpan {
        operations: counts,
        colour,
    }
}

/// A run of one pixel, started as in the engines' loop, for the polygon's kind.
struct CountedRun<'a, 'b> {
    counter: &'a Counter,
    counts: &'b mut OperationCounts,
    colour: &'b mut [f32; 3],
    lit: LightAt<'b, Counted<'a>>,
    start: RunStart<'b, Counted<'a>>,
    own: usize,
    extras: Extras,
    zero: Counted<'a>,
}

impl<C: Carries> Visit<C> for CountedRun<'_, '_> {
    fn visit<S: Shader<Carries = C>>(self, kind: S) {
        let (counter, counts, lit) = (self.counter, self.counts, self.lit);
        let span = Span::of_run(lit.count(), self.start, self.zero);
        let mut walk = kind.walk(&lit, span);
        counts.span = counter.take();

        let mut extra = self.extras.start(self.own, &self.start, self.zero);
        counter.take();
        let pixel = walk.next();
        counts.walk = counter.take();
        // The additions that step position and weight, if they are there.
        counts.walk.additions += self.extras.count() as u32;
        let extra = extra.next();
        counter.take();
        let colour = colour(kind, lit, self.extras, (pixel, extra));
        counts.shade = counter.take();
        *self.colour = colour.array().map(|channel| channel.value());
    }
}

/// Appends the values of a group to a list.
fn put<'a, P: Values<Counted<'a>>>(group: P, list: &mut Vec<Counted<'a>>) {
    each(group, |_, value| list.push(*value));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{Frame, FrameBuilder, SubPixel, Vertex};
    use crate::raster::Renderer;
    use crate::scene::{Falloff, Interpolation};
    use crate::shading::{METHODS, On};

    /// Returns the triangle of a bench as a frame in which the span engine draws the bench's span
    /// first.
    fn frame(bench: &SpanBench, interpolation: Interpolation) -> Frame {
        let mut builder = FrameBuilder::new(64, 64);
        let material = builder.lighting(bench.lighting.clone());
        builder.interpolation(interpolation);
        let corners = [0, 1, 2].map(|i| {
            let [x, y] =
                [0, 1].map(|axis| SubPixel::from_num(bench.points[i][axis] * SpanBench::LENGTH));
            let corner = builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: 1.0,
                normal: bench.normals[i],
                material,
            });
            builder.position(corner, bench.points[i]);
            corner
        });
        builder.polygon(&corners, SpanBench::FACE, 0);
        builder.finish().expect("a frame in its range")
    }

    /// Counting runs the engine's own arithmetic: the colour of the first pixel is the same to the
    /// bit.
    #[test]
    fn counted_spans_are_those_of_the_engine() {
        let local = |falloff, interpolation| SpanBench::local(20.0, 2, falloff, interpolation);
        let benches = [
            (SpanBench::new(20.0, 1), Interpolation::Screen),
            (SpanBench::new(20.0, 4), Interpolation::Screen),
            (
                local(Falloff::InverseSquare, Interpolation::Screen),
                Interpolation::Screen,
            ),
            (
                local(Falloff::None, Interpolation::Perspective),
                Interpolation::Perspective,
            ),
        ];
        for (index, (bench, interpolation)) in benches.iter().enumerate() {
            let frame = frame(bench, *interpolation);
            for row in METHODS {
                let variant = row.variant();
                if (row.fit)(On::Frame(&frame)).refused().is_some() {
                    continue;
                }
                let counted = row.count(bench, &variant);
                let picture = variant
                    .render_linear_with(&frame, Renderer::LECTURE)
                    .expect("a method for the frame");
                let [drawn @ .., _] = picture.get(0, 0);
                let counted = counted.colour.map(|channel| channel.clamp(0.0, 1.0));
                assert_eq!(drawn, counted, "{variant} on bench {index}");
            }
        }
    }
}
