//! Operation counts: the same code that draws, run on values that count their operations.

use crate::number::{Counted, Counter, Counts, Real, Vec3, vec3};
use crate::shading::kernels::bench_polygon::BenchPolygon;
use crate::shading::kernels::colour;
use crate::shading::kernels::runs::{GROUP, RunStart, RunValues};
use crate::shading::light::eye_frame::carried;
use crate::shading::light::{LightAt, Uniforms};
use crate::shading::walks::values::each;
use crate::shading::walks::{GreatCircle, Walk};
use crate::shading::{
    Carries, CarriesOf, Extras, Kinds, Local, Method, Needs, Shader, ShadingRate, Span, SpanBench,
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
///
/// This is compiled for each method, so what all methods have in common is in [`Counting`].
pub(crate) fn count<M: Method>(bench: &SpanBench, variant: &Variant) -> CountedSpan {
    let counter = Counter::default();
    let uniforms = bench.uniforms(variant, 1.0);
    let method = M::new(variant.parameters(), &uniforms.model);
    let mut counting = Counting::new(&counter, bench, variant, &uniforms);

    // A loop, because a map over the array would be compiled three times for each method.
    let mut corners = [const { Vec::new() }; 3];
    for (i, corner) in corners.iter_mut().enumerate() {
        let (lit, normal) = counting.corner(i);
        put(carried::<CarriesOf<M>, _>(&uniforms, &lit, normal), corner);
        counting.add_extras(i, corner);
    }
    counting.take_vertex();

    let polygon = counting.polygon();
    let corners_of_polygon = polygon.corners();
    counter.take();
    let chosen = method.polygon(&counting.lit, &corners_of_polygon);
    let planned = counter.take();
    if M::NEEDS.reads_span() || !M::Kinds::NAMES.is_empty() {
        counting.counts.polygon = planned;
    }

    let ends = counting.ends_of_span(M::NEEDS, &corners);
    let [first, second] = counting.start(M::NEEDS, &ends);
    let mut planned = Vec::new();
    let kind = M::Kinds::put(chosen, |_, value| planned.push(*value));
    let group = |from: usize| {
        [&first, &second].map(|values| {
            let of = |k| values.get(from + k).copied().unwrap_or(counting.zero);
            core::array::from_fn(of)
        })
    };
    let groups: Vec<_> = (0..first.len()).step_by(GROUP).map(group).collect();
    let start = RunStart {
        values: RunValues(&groups),
        x: 0,
        pixels: SpanBench::PIXELS,
        place: M::NEEDS.reads_span().then(|| counting.place()),
        constants: &planned,
    };
    let mut colour = [0.0; 3];
    let run = CountedRun {
        counter: &counter,
        counts: &mut counting.counts,
        colour: &mut colour,
        lit: counting.lit,
        start,
        own: first.len() - counting.extras.count(),
        extras: counting.extras,
        zero: counting.zero,
    };
    method.kinds().visit(kind, run);
    CountedSpan {
        operations: counting.counts,
        colour,
    }
}

/// The parts of a count that are equal for all methods: the engines' work on vertices, edges and
/// the start of a span.
struct Counting<'a> {
    counter: &'a Counter,
    bench: &'a SpanBench,
    variant: &'a Variant,
    extras: Extras,
    /// True if a polygon is lit once, so that nothing is interpolated.
    is_polygon: bool,
    lit: LightAt<'a, Counted<'a>>,
    zero: Counted<'a>,
    counts: OperationCounts,
}

impl<'a> Counting<'a> {
    #[inline(never)]
    fn new(
        counter: &'a Counter,
        bench: &'a SpanBench,
        variant: &'a Variant,
        uniforms: &'a Uniforms,
    ) -> Self {
        let zero = counter.counted(0.0);
        Counting {
            counter,
            bench,
            variant,
            extras: bench.extras(variant),
            is_polygon: matches!(
                variant.row().needs.shading_rate,
                ShadingRate::Polygon | ShadingRate::PolygonMean
            ),
            lit: LightAt::new(uniforms.stored(), zero, uniforms.model.is_general),
            zero,
            counts: OperationCounts::default(),
        }
    }

    /// Makes a vector that counts.
    fn vector(&self, v: [f32; 3]) -> Vec3<Counted<'a>> {
        vec3(v.map(|x| self.counter.counted(x)))
    }

    /// Returns the light at a corner of the triangle, and the normal by which the corner is lit.
    /// Begins to count.
    #[inline(never)]
    fn corner(&self, i: usize) -> (LightAt<'a, Counted<'a>>, Vec3<Counted<'a>>) {
        self.counter.take();
        let normal = match self.variant.row().needs.shading_rate {
            ShadingRate::Polygon => self.vector(SpanBench::FACE),
            ShadingRate::PolygonMean => {
                let [a, b, c] = self.bench.normals.map(vec3);
                self.vector(((a + b + c) * (1.0 / 3.0)).array()).unit()
            }
            ShadingRate::Vertex | ShadingRate::Pixel => self.vector(self.bench.normals[i]),
        };
        (self.lit.at(self.vector(self.bench.points[i])), normal)
    }

    /// Appends the varyings that engines add to a corner's own.
    fn add_extras(&self, i: usize, corner: &mut Vec<Counted<'a>>) {
        if self.extras.point {
            corner.extend(self.vector(self.bench.points[i]).array());
        }
        if self.extras.weight {
            corner.push(self.counter.counted(1.0));
        }
    }

    /// Takes the counts of the last corner as those of a vertex, or of the polygon if it is lit
    /// once, with the light that the polygon sees.
    #[inline(never)]
    fn take_vertex(&mut self) {
        if !self.is_polygon {
            self.counts.vertex = self.counter.take();
        }
        if self.variant.row().needs.local == Local::PerPolygon && self.bench.is_local() {
            let uniforms = self.variant.uniforms(&self.bench.lighting, 1.0);
            let lit = LightAt::new(uniforms.stored(), self.zero, true);
            lit.at(self.vector(self.bench.points[0])).lights().count();
        }
        self.counts.polygon = self.counter.take();
    }

    #[inline(never)]
    fn polygon(&self) -> BenchPolygon<Counted<'a>> {
        (self.bench).polygon(SpanBench::LENGTH, |x| self.counter.counted(x))
    }

    /// Returns the varyings at both ends of the span, between the edges from the first two corners
    /// to the third. Counts an edge and its step, and begins to count the span.
    #[inline(never)]
    fn ends_of_span(
        &mut self,
        needs: Needs,
        [a, b, c]: &[Vec<Counted<'a>>; 3],
    ) -> [Vec<Counted<'a>>; 2] {
        let counter = self.counter;
        let [t0, dt] = SpanBench::EDGE.map(|x| counter.counted(x));
        let (edge, step, ends);
        if needs.great_circles() {
            let face = self.vector(SpanBench::FACE);
            let vector = |values: &[_]| vec3([values[0], values[1], values[2]]);
            let circles = [a, b].map(|corner| {
                counter.take();
                GreatCircle::new(face, [vector(corner), vector(c)], t0, dt)
            });
            edge = counter.take();
            circles[0].sines.clone().next();
            step = counter.take();
            // Each span pays for the normals at its ends, so they are counted.
            ends = circles.map(|circle| circle.normal().array().to_vec());
        } else {
            let ramps = |from: &[_]| -> Vec<_> {
                let ends = from.iter().zip(c);
                ends.map(|(a, b)| ramp(*a, *b, t0, dt)).collect()
            };
            let starts = |ramps: &[[_; 2]]| ramps.iter().map(|ramp| ramp[0]).collect();
            counter.take();
            let mut left = ramps(a);
            edge = counter.take();
            let first = starts(&left);
            left.iter_mut().for_each(|[at, step]| *at = *at + *step);
            step = counter.take();
            ends = [first, starts(&ramps(b))];
            counter.take();
        }
        if self.is_polygon {
            counter.take();
        } else {
            (self.counts.edge, self.counts.edge_step) = (edge, step);
        }
        ends
    }

    /// Returns the two values from which each varying starts on the span.
    #[inline(never)]
    fn start(&self, needs: Needs, [left, right]: &[Vec<Counted<'a>>; 2]) -> [Vec<Counted<'a>>; 2] {
        let SpanPlace { t0, dt, .. } = self.place();
        let mut values = [Vec::new(), Vec::new()];
        for (a, b) in left.iter().zip(right) {
            let start = if self.is_polygon {
                [*a, self.zero]
            } else {
                needs.start([*a, *b], t0, dt)
            };
            for (values, value) in values.iter_mut().zip(start) {
                values.push(value);
            }
        }
        values
    }

    /// Returns the place of the run on its span.
    fn place(&self) -> SpanPlace<Counted<'a>> {
        let [t0, dt] = SpanBench::SPAN.map(|x| self.counter.counted(x));
        SpanPlace {
            y: 0,
            t0,
            dt,
            start: 0,
            pixels: 50,
        }
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
                if row.refuses(On::Frame(&frame)).is_some() {
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
