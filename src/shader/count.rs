//! How many operations a method takes, counted by running it on numbers that count.

use super::dispatch::{Job, dispatch_sample};
use super::span::SpanBench;
use super::{Corners, Method, Shader, Span};
use crate::frame::Frame;
use crate::number::{Counter, Counting, Counts, Machine, each};
use crate::walk::{Attribute, Walk};

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

pub(super) fn count<D: Method>(parameters: &[u32], lights: usize) -> OperationCounts {
    struct Count<'a>(&'a [u32], &'a Frame);
    impl Job for Count<'_> {
        type Out = OperationCounts;
        fn run<S: Shader>(self) -> OperationCounts {
            run::<S>(self.0, self.1)
        }
    }
    let bench = SpanBench::new(20.0, lights);
    dispatch_sample::<D, _>(lights, Count(parameters, bench.frame()))
}

fn run<S: Shader>(parameters: &[u32], frame: &Frame) -> OperationCounts {
    let counter = Counter::default();
    let m = Counting(&counter);
    let one = |x: f32| m.one(x);
    let mut last = Counts::default();
    // The operations since the last call.
    let mut lap = || {
        let now = counter.counts();
        let lap = now - last;
        last = now;
        lap
    };
    let consts = S::consts(&frame.lightings()[0], parameters, one);
    let normals: [_; 3] = each(|i| frame.vertices()[i].normal.map(one));
    lap();
    let first = S::vertex(&consts, normals[0]);
    let vertex = lap();
    let attributes = [first, S::vertex(&consts, normals[1]), S::vertex(&consts, normals[2])];
    let polygon = &frame.polygons()[0];
    let corners = Corners { machine: m, frame, polygon, attributes: &attributes };
    lap();
    let over_polygon = S::polygon(&consts, &corners);
    let polygon_counts = lap();
    let (face, t0, dt) = (polygon.normal.map(one), one(0.01), one(0.02));
    let mut left = S::Attribute::edge(m, face, attributes[0], attributes[2], t0, dt);
    let edge = lap();
    S::Attribute::advance(&mut left);
    let edge_step = lap();
    let right = S::Attribute::edge(m, face, attributes[1], attributes[2], t0, dt);
    lap();
    let (l, r) = (S::Attribute::at(&left), S::Attribute::at(&right));
    let attribute = S::Attribute::span(m, face, l, r, t0, dt);
    let start = Span { x: one(0.5), y: one(0.5), attribute };
    let mut walk = S::walk(m, &consts, &over_polygon, &start);
    let span = lap();
    let pixel = walk.next();
    let walk = lap();
    S::shade(&consts, pixel);
    let shade = lap();
    OperationCounts { vertex, polygon: polygon_counts, edge, edge_step, span, walk, shade }
}
