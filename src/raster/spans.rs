//! The span engine on groups of pixels, in bands: the lecture's loops, whose visible runs are walked and shaded a group at a
//! time.
//!
//! Each band starts its edges anew on its first scanline, at that scanline's exact parameter, so that bands are independent
//! of one another and of how many threads draw them.

use super::active::ActiveEdge;
use super::bands::Bands;
use super::bins::Bins;
use super::depth::SampleDepth;
use super::edge_table::EdgeTable;
use super::scanline::scan;
use super::setup::SetUp;
use super::visibility::VisibleLine;
use crate::frame::Frame;
use crate::number::{Lanes, Scalar};
use crate::shader::{Shader, Span};
use crate::walk::{Attribute, Walk};
use alloc::vec::Vec;
use core::ops::Range;

/// Scanlines a band: enough that edges are seldom started anew, few enough that every thread gets some.
const HEIGHT: usize = 32;

type EdgeOf<S> = ActiveEdge<<<S as Shader>::Attribute<f32> as Attribute<f32>>::Edge>;

/// Draws `frame` with a shader, band by band.
pub(crate) fn draw<S: Shader, M: Lanes>(
    m: M,
    frame: &Frame,
    parameters: &[u32],
    bands: &mut dyn Bands,
) {
    let setup = SetUp::<S, Scalar>::new(Scalar, frame, parameters);
    let consts: Vec<S::Consts<M::F>> = frame
        .lightings()
        .iter()
        .map(|l| S::consts(l, parameters, &|x| m.splat(x)))
        .collect();
    let bins = Bins::<u32>::new(frame, HEIGHT);
    let depth = SampleDepth::new(frame);
    bands.each(HEIGHT, &|number, rows, scratch, sink| {
        let first = rows.start;
        let table = EdgeTable::new(frame, rows.clone(), &bins.band(number).collect::<Vec<_>>());
        let mut line = VisibleLine::new(frame.width(), depth);
        let mut next = first;
        scan(
            Scalar,
            frame,
            &table,
            &setup.attributes,
            &mut line,
            &mut |row, line, edges| {
                for empty in next..row {
                    sink.row(empty - first, 0..0, &[], [&[]; 3]);
                }
                next = row + 1;
                let drawn = line.drawn();
                let [_, rgb @ ..] = &mut scratch.line;
                for channel in rgb.iter_mut() {
                    if channel.len() < drawn.end + 2 * M::WIDTH {
                        channel.resize(drawn.end + 2 * M::WIDTH, 0.0);
                    }
                }
                shade_runs::<S, M>(m, frame, &setup, &consts, (row, line, edges), rgb);
                let [r, g, b] = rgb;
                let from = drawn.start;
                sink.row(
                    row - first,
                    drawn,
                    line.kept_depth(from),
                    [&r[from..], &g[from..], &b[from..]],
                );
            },
        );
        for empty in next..rows.end {
            sink.row(empty - first, 0..0, &[], [&[]; 3]);
        }
    });
}

/// Walks and shades the visible runs of a scanline into three channels, from left to right: what a last group has too
/// many is written over by the next run.
#[inline(never)]
fn shade_runs<S: Shader, M: Lanes>(
    m: M,
    frame: &Frame,
    setup: &SetUp<S, Scalar>,
    consts: &[S::Consts<M::F>],
    (row, line, edges): (usize, &VisibleLine, &[EdgeOf<S>]),
    [red, green, blue]: &mut [Vec<f32>; 3],
) {
    m.vectorize(
        #[inline(always)]
        || {
            line.runs(
                #[inline(always)]
                |span, pixels: Range<usize>| {
                    let polygon = &frame.polygons()[span.polygon as usize];
                    let material = polygon.material as usize;
                    // A run that begins inside its span starts at its own first pixel's parameter.
                    let t0 = span.t0 + (pixels.start as u32 - span.start) as f32 * span.dt;
                    let (left, right) = (&edges[span.left as usize], &edges[span.right as usize]);
                    let (left, right) = (
                        S::Attribute::at(&left.attribute),
                        S::Attribute::at(&right.attribute),
                    );
                    let start = Span {
                        x: pixels.start as f32 + 0.5,
                        y: row as f32 + 0.5,
                        attribute: S::Attribute::span(
                            Scalar,
                            frame.polygon_normal(polygon),
                            left,
                            right,
                            t0,
                            span.dt,
                        ),
                    };
                    let over_polygon = &setup.polygons[span.polygon as usize];
                    let mut walk = S::walk(m, &setup.consts[material], over_polygon, &start);
                    // A copy that nothing else refers to: loads from it can leave the loop.
                    let consts = consts[material];
                    let mut x = pixels.start;
                    while x < pixels.end {
                        let [r, g, b] = S::shade(&consts, walk.next());
                        m.store(r, &mut red[x..]);
                        m.store(g, &mut green[x..]);
                        m.store(b, &mut blue[x..]);
                        x += M::WIDTH;
                    }
                },
            );
        },
    );
}
