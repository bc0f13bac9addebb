//! The scanline engine: the lecture as written.
//!
//! For each scanline the active edges give spans; a depth buffer of one line tells which span is seen at each pixel;
//! each visible run is then walked and shaded once, so that hidden pixels are never shaded.

use super::active::{ActiveEdge, ActiveEdges};
use super::depth::SampleDepth;
use super::edge_table::EdgeTable;
use super::setup::SetUp;
use super::target::Target;
use super::visibility::VisibleLine;
use crate::frame::Frame;
use crate::number::{Machine, each};
use crate::shader::{Shader, Span};
use crate::walk::{Attribute, Walk};
use alloc::vec;

/// Takes a scanline. Behind a pointer, so that the loops are compiled once for each kind of attribute and not for each
/// shader.
pub(super) type Visit<'a, E> = dyn FnMut(usize, &VisibleLine, &[ActiveEdge<E>]) + 'a;

/// Goes down the scanlines of `frame` with the attributes of all vertices, and gives every one on which anything is drawn:
/// its number, what is seen on it, and the active edges that its spans refer to.
pub(super) fn scan_all<M: Machine, A: Attribute<M::One>>(
    m: M,
    frame: &Frame,
    attributes: &[A],
    visit: &mut Visit<'_, A::Edge>,
) {
    let table = EdgeTable::new(frame);
    let depth = SampleDepth::new(frame);
    let (mut line, mut active) = (
        VisibleLine::new(frame.width(), depth),
        ActiveEdges::new(depth),
    );
    for row in 0..frame.height() {
        active.advance::<M, A>(row);
        active.enter(m, frame, &table, attributes, row);
        if active.edges().is_empty() {
            continue;
        }
        line.clear();
        active.spans(frame.width() as u32, |span| line.draw(span));
        visit(row, &line, active.edges());
    }
}

/// Draws `frame` with a shader into `target`.
pub(crate) fn draw<S: Shader, M: Machine>(
    m: M,
    frame: &Frame,
    parameters: &[u32],
    target: &mut dyn Target,
) {
    const { assert!(M::WIDTH == 1, "this engine walks pixel by pixel") };
    let setup = SetUp::<S, M>::new(m, frame, parameters);
    let mut colours = vec![[0.0f32; 3]; frame.width()];
    scan_all(m, frame, &setup.attributes, &mut |row, line, edges| {
        line.runs(|span, pixels| {
            let polygon = &frame.polygons()[span.polygon as usize];
            let material = polygon.material as usize;
            let face = m.three(frame.polygon_normal(polygon));
            // A run that begins inside its span starts at its own first pixel's parameter.
            let t0 = span.t0 + (pixels.start as u32 - span.start) as f32 * span.dt;
            let (left, right) = (&edges[span.left as usize], &edges[span.right as usize]);
            let (left, right) = (
                S::Attribute::at(&left.attribute),
                S::Attribute::at(&right.attribute),
            );
            let start = Span {
                x: m.one(pixels.start as f32 + 0.5),
                y: m.one(row as f32 + 0.5),
                attribute: S::Attribute::span(m, face, left, right, m.one(t0), m.one(span.dt)),
            };
            let mut walk = S::walk(
                m,
                &setup.consts[material],
                &setup.polygons[span.polygon as usize],
                &start,
            );
            let consts = &setup.pixel_consts[material];
            let run = &mut colours[..pixels.len()];
            for colour in run.iter_mut() {
                let rgb = S::shade(consts, walk.next());
                *colour = each(|i| m.first(rgb[i]));
            }
            target.store(pixels.start, row, run);
        });
    });
}
