//! The span engine: the lecture as written, one pixel at a time.
//!
//! ```text
//! edge table ─► active edges ─► spans ─► visible line ─► visible runs ─► pixel kernel ─► picture
//! (by first      ΔI along edges,          which span is     ΔI along spans,
//!  scanline)     once per scanline       seen at a pixel   once per pixel
//! ```
//!
//! On each scanline the active edges form spans. Where some lie over others, a depth buffer of one
//! line decides which span is seen at each pixel. Then each visible run is walked and shaded once,
//! so hidden pixels are never shaded. One call shades all runs of a scanline. This engine draws
//! everything: polygons of any shape, every method, every kind of depth buffer.

pub(super) mod active;
mod columns;
pub(super) mod edge;
pub(super) mod edge_table;
pub(super) mod line;

use active::ActiveEdges;
pub use line::NO_POLYGON;
use line::VisibleLine;

use super::depth::SampleDepth;
use super::setup::{SetUp, Varyings};
use super::target::Target;
use crate::frame::Frame;
use crate::shading::RunList;
use alloc::vec;
use edge_table::EdgeTable;

/// Walks down the scanlines of a frame. Calls `visit` for each scanline on which anything is drawn,
/// with its index, its visible line, and the active edges that the line's spans refer to.
pub(super) fn scan(
    frame: &Frame,
    varyings: &Varyings<'_>,
    visit: &mut dyn FnMut(usize, &mut VisibleLine, &ActiveEdges<'_>),
) {
    let table = EdgeTable::new(frame);
    let mut line = VisibleLine::new(frame.width(), SampleDepth::new(frame));
    let mut active = ActiveEdges::new(frame, varyings);
    for row in 0..frame.height() {
        active.next(table.bucket(row).iter(), row as i32);
        if active.is_empty() {
            continue;
        }
        line.clear();
        active.spans(frame.width() as u32, |_, span| line.add(span));
        visit(row, &mut line, &active);
    }
}

/// Draws a method's frame into `target`.
pub(super) fn draw(setup: &SetUp<'_>, target: &mut dyn Target) {
    // Visible runs of a scanline do not overlap: each pixel has its own place.
    let mut colours = vec![[0.0f32; 3]; setup.frame.width()];
    let mut list = RunList::new(setup.varyings.count);
    scan(setup.frame, &setup.varyings, &mut |row, line, edges| {
        list.clear();
        if let Some(stored) = target.depth(row) {
            line.hide_behind(stored);
        }
        line.runs(|span, pixels| {
            let uniforms = setup.uniforms_of(span.polygon);
            edges.add_run(span, row, pixels, uniforms, &mut list);
        });
        (setup.kernels.pixels)(&setup.pixels(&list), &mut colours);
        line.stretches(|pixels| target.store(pixels.start, row, &colours[pixels]));
    });
}
