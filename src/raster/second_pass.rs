//! Second passes: tells if a caller's depth buffer holds the depths that another engine finds for
//! the polygons of a frame.
//!
//! The span engine adds the growth of depth from pixel to pixel, the row engine computes depth at
//! each block from plane equations. The last bits differ, so a test for equal depths fails at about
//! half of the samples. One depth for both would cost what makes the row engine fast.

use super::depth::{CallersTest, DepthTest, SampleDepth};
use super::engine::{Engine, Renderer};
use super::rows::RowDepths;
use super::setup::Varyings;
use super::spans::active::{ActiveEdges, PolygonSpan};
use super::spans::edge::first_centre;
use super::spans::edge_table::for_each_edge;
use crate::frame::Frame;
use crate::number::SimdLevel;
use alloc::vec::Vec;

/// How many polygons are looked at, at most. Some are hidden, and at some pixels all engines round
/// alike.
const POLYGONS: usize = 32;

/// Returns the other engine, if `stored` holds depths that it finds for polygons of `frame`, and
/// `renderer` finds others there.
pub(super) fn other_engine(
    frame: &Frame,
    renderer: Renderer,
    test: DepthTest,
    stored: &[f32],
) -> Option<Engine> {
    let is_reversed = match test {
        DepthTest::LessOrEqual => false,
        DepthTest::GreaterOrEqual => true,
        DepthTest::Less | DepthTest::Greater => return None,
    };
    let level = match renderer {
        Renderer::Row(level) => level,
        Renderer::Span => SimdLevel::best(),
    };
    // Other frames are drawn by the span engine only: see `Variant::plan`.
    if level == SimdLevel::Scalar || !SampleDepth::new(frame).is_plain() {
        return None;
    }
    let (callers, rows) = (CallersTest::new(frame, test), RowDepths::new(frame, level));
    let value = |depth: f32| {
        let value = if is_reversed {
            callers.value::<true>(depth)
        } else {
            callers.value::<false>(depth)
        };
        value.to_bits()
    };
    let polygons = frame.polygons().len();
    let is_other = (0..POLYGONS.min(polygons)).any(|k| {
        let polygon = (k * polygons / POLYGONS.min(polygons)) as u32;
        let Some((row, span)) = middle_span(frame, polygon) else {
            return false;
        };
        let width = span.end - span.start;
        let pixels = [1, 2, 3].map(|quarter| (span.start + quarter * width / 4) as usize);
        let by_spans = pixels.map(|x| depth_of_span(&span, x));
        let by_rows = rows.at(polygon, row, pixels);
        let [own, others] = match renderer {
            Renderer::Row(_) => [by_rows, by_spans],
            Renderer::Span => [by_spans, by_rows],
        };
        let found = pixels.map(|x| stored[row * frame.width() + x].to_bits());
        (0..pixels.len()).any(|i| value(others[i]) == found[i] && value(own[i]) != found[i])
    });
    is_other.then_some(match renderer {
        Renderer::Row(_) => Engine::Span,
        Renderer::Span => Engine::Row,
    })
}

/// Returns the first span of a polygon on its middle scanline, as the span engine finds it, and the
/// scanline; `None` if it covers no pixel there.
fn middle_span(frame: &Frame, polygon: u32) -> Option<(usize, PolygonSpan)> {
    let corners = frame.corners(&frame.polygons()[polygon as usize]).iter();
    let rows = corners.map(|&v| first_centre(frame.vertices()[v as usize].y));
    let height = frame.height() as i32;
    let (top, bottom) = rows.fold((height, 0), |(top, bottom), row| {
        (top.min(row.max(0)), bottom.max(row.min(height)))
    });
    let row = top + (bottom - top) / 2;
    let mut edges = Vec::new();
    for_each_edge(frame, 0..height, polygon, |first, edge| {
        edges.push((first, edge))
    });
    let varyings = Varyings::none();
    let mut active = ActiveEdges::new(frame, &varyings);
    for here in top..=row {
        let new = edges.iter().filter(|(first, _)| *first == here);
        active.next(new.map(|(_, edge)| edge), here);
    }
    let mut found = None;
    active.spans(frame.width() as u32, |_, span| {
        found.get_or_insert((row as usize, span));
    });
    found
}

/// Returns the depth at pixel `x` of a span, by the additions of the span engine.
fn depth_of_span(span: &PolygonSpan, x: usize) -> f32 {
    (span.start as usize..x).fold(span.depth, |depth, _| depth + span.depth_step)
}
