//! How many operations a method takes, counted by running it on numbers that count.

use super::dispatch::{Job, dispatch_counts};
use super::span::SpanBench;
use super::{Corner, Corners, Method, Shader, Span};
use crate::frame::Frame;
use crate::number::{Counter, Counting, Counts, Machine};
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

pub(super) fn count<D: Method>(parameters: &[u32], bench: &SpanBench) -> OperationCounts {
    struct Count<'a>(&'a [u32], &'a Frame);
    impl Job for Count<'_> {
        type Out = OperationCounts;
        fn run<S: Shader>(self) -> OperationCounts {
            run::<S>(self.0, self.1)
        }
    }
    dispatch_counts::<D, _>(bench.frame(), Count(parameters, bench.frame()))
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
    let consts = S::consts(&frame.lightings()[0], parameters, &one);
    let vertex = |vertex| {
        S::vertex(
            &consts,
            &Corner {
                machine: m,
                frame,
                vertex,
            },
        )
    };
    lap();
    let first = vertex(0);
    let at_vertex = lap();
    let attributes = [first, vertex(1), vertex(2)];
    let polygon = &frame.polygons()[0];
    let corners = Corners {
        machine: m,
        frame,
        polygon,
        attributes: &attributes,
    };
    lap();
    let over_polygon = S::polygon(&consts, &corners);
    let polygon_counts = lap();
    let (face, t0, dt) = (frame.polygon_normal(polygon).map(one), one(0.01), one(0.02));
    let mut left = S::Attribute::edge(m, face, attributes[0], attributes[2], t0, dt);
    let edge = lap();
    S::Attribute::advance(&mut left);
    let edge_step = lap();
    let right = S::Attribute::edge(m, face, attributes[1], attributes[2], t0, dt);
    lap();
    let (l, r) = (S::Attribute::at(&left), S::Attribute::at(&right));
    let attribute = S::Attribute::span(m, face, l, r, t0, dt);
    let start = Span {
        x: one(0.5),
        y: one(0.5),
        attribute,
    };
    let mut walk = S::walk(m, &consts, &over_polygon, &start);
    let span = lap();
    let pixel = walk.next();
    let walk = lap();
    S::shade(&consts, pixel);
    let shade = lap();
    OperationCounts {
        vertex: at_vertex,
        polygon: polygon_counts,
        edge,
        edge_step,
        span,
        walk,
        shade,
    }
}
