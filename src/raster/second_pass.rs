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

/// How many spans are looked at, and at how many pixels of each. Some are hidden, and at some
/// pixels engines round alike.
const SPANS: usize = 32;
const PIXELS: usize = 7;
/// How many of these samples may hold another engine's depth by accident, where polygons touch.
/// This is chosen, not derived: without it, random worlds (`tests/worlds/passes.rs`) had right
/// passes refused. A larger number misses more wrong passes over small pictures. In a span of fewer
/// than eight pixels, a pixel counts more than once.
const BY_ACCIDENT: u32 = 8;

/// Returns the other engine, if `stored` holds depths that only it finds for polygons of `frame`,
/// and hardly any that only the engine of `renderer` finds.
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
    // How many samples hold the depth that only the span engine finds, and that only the row engine
    // finds. Where polygons touch, the depth of one may be another's by accident.
    let mut held = [0, 0];
    for k in 0..SPANS.min(SPANS * polygons) {
        // Spans of different polygons, or of different scanlines where there are few polygons.
        let polygon = k * polygons / SPANS;
        let first = (polygon * SPANS).div_ceil(polygons);
        let share = (k - first + 1) as f64 / (SPANS / polygons + 2) as f64;
        let Some((row, span)) = span_of(frame, polygon as u32, share) else {
            continue;
        };
        let width = (span.end - span.start) as usize;
        let pixels: [usize; PIXELS] =
            core::array::from_fn(|i| span.start as usize + (i + 1) * width / (PIXELS + 1));
        let by_spans = pixels.map(|x| depth_of_span(&span, x));
        let by_rows = rows.at(polygon as u32, row, pixels);
        for i in 0..PIXELS {
            let [by_span, by_row] = [value(by_spans[i]), value(by_rows[i])];
            let found = stored[row * frame.width() + pixels[i]].to_bits();
            if by_span != by_row {
                held[0] += u32::from(found == by_span);
                held[1] += u32::from(found == by_row);
            }
        }
    }
    let (own, others, other) = match renderer {
        Renderer::Row(_) => (held[1], held[0], Engine::Span),
        Renderer::Span => (held[0], held[1], Engine::Row),
    };
    // After a right pass most samples hold this engine's depth, after a wrong one the other's.
    (others > BY_ACCIDENT + 2 * own).then_some(other)
}

/// Returns the first span of a polygon on a scanline, as the span engine finds it, and the
/// scanline, which is at a `share` of its height; `None` if the polygon covers no pixel there.
fn span_of(frame: &Frame, polygon: u32, share: f64) -> Option<(usize, PolygonSpan)> {
    let corners = frame.corners(&frame.polygons()[polygon as usize]).iter();
    let rows = corners.map(|&v| first_centre(frame.vertices()[v as usize].y));
    let height = frame.height() as i32;
    let (top, bottom) = rows.fold((height, 0), |(top, bottom), row| {
        (top.min(row.max(0)), bottom.max(row.min(height)))
    });
    let row = top + (f64::from(bottom - top) * share) as i32;
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
