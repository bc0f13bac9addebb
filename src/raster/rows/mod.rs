//! The row engine: bands of scanlines, shaded row by row.
//!
//! A band's polygons are covered one after the other, which gives the runs of each of its scanlines in drawing order. Then,
//! scanline by scanline, the runs are drawn: where one is nearer than what was drawn before, what its walk gives to the pixel
//! ([`Shader::Pixel`]) is written into planes beside the depth; and the row is shaded once, a group of pixels at a time, over
//! the row and not over the span: shading costs the same for a pixel in a triangle of two pixels as in one of a thousand, and
//! hidden pixels are never shaded.
//!
//! Bands are independent of one another: one is one unit of work for a thread.
//!
//! Tried and dropped (whole frames at 1920x1080, AVX2, one thread): planes of a whole band, of 8 or 16 scanlines, which lie in
//! the L2 cache at best (4.2 ms against 4.0 with 5,040 triangles, 10.5 against 9.9 with 100,000); a branch for groups that are
//! wholly seen, and one for those that are not seen at all (4.2 against 3.8 ms: which they are cannot be predicted).
//! Least of 40 frames on a machine that varies by more than these differences: reasons to prefer, not proofs.

mod band;
mod cover;
mod polygon;
mod shade;
mod span;

use super::bands::Bands;
use super::bins::Bins;
use super::depth::SampleDepth;
use super::setup::SetUp;
use crate::frame::Frame;
use crate::number::{Lanes, Scalar};
use crate::shader::Shader;
use crate::walk::Attribute;
use alloc::vec::Vec;
pub(crate) use band::Row;
use core::ops::Range;
pub(crate) use cover::Cover;
use cover::Run;
use span::{Painter, Sources};

/// Scanlines a band: edges are seldom started anew, and every thread gets some.
const HEIGHT: usize = 32;

/// Whether the engine can draw `frame` with shader `S`: its depth must be interpolated and kept as it is, and what its
/// walk gives must be numbers.
pub(crate) fn can_draw<S: Shader, M: Lanes>(frame: &Frame) -> bool {
    let depth = SampleDepth::new(frame);
    span::planes::<S, M>().is_some() && depth.is_plain()
}

/// Draws `frame` with a shader, band by band.
pub(crate) fn draw<S: Shader, M: Lanes>(m: M, frame: &Frame, parameters: &[u32], bands: &mut dyn Bands) {
    let Some(planes) = span::planes::<S, M>() else { return };
    let setup = SetUp::<S, Scalar>::new(Scalar, frame, parameters);
    let consts: Vec<S::Consts<M::F>> =
        frame.lightings().iter().map(|l| S::consts(l, parameters, &|x| m.splat(x))).collect();
    let only = only_material(frame);
    let bins = Bins::new(frame, HEIGHT);
    let hides = SampleDepth::new(frame).hides();
    bands.each(HEIGHT, &|number, rows, scratch, sink| {
        let sources = cover_band::<S, M>(m, frame, &setup, &bins, (number, &rows), &mut scratch.cover);
        let painter = Painter { setup: &setup, sources: &sources, hides, notes_material: only.is_none() };
        let (row, line) = (&mut scratch.row, &mut scratch.line);
        row.prepare(frame.width(), planes + usize::from(only.is_none()));
        for channel in line.iter_mut() {
            channel.resize(channel.len().max(frame.width() + 2 * M::WIDTH), 0.0);
        }
        for y in rows.clone() {
            let runs = &scratch.cover.runs[y - rows.start];
            paint_and_shade::<S, M>(m, &painter, (y, runs), (&consts, only), row, line);
            let [r, g, b] = &*line;
            let drawn = row.drawn.clone();
            sink.row(y - rows.start, drawn.clone(), row.depth(drawn.start), [r, g, b].map(|c| &c[drawn.start..]));
            row.clear();
        }
    });
}

/// Finds the runs of a band's polygons, scanline by scanline, in drawing order.
fn cover_band<S: Shader, M: Lanes>(
    m: M,
    frame: &Frame,
    setup: &SetUp<S, Scalar>,
    bins: &Bins,
    (band, rows): (usize, &Range<usize>),
    cover: &mut Cover,
) -> Sources<S> {
    let is_planar = S::Attribute::<f32>::IS_PLANAR;
    let mut sources = Sources::default();
    let mut edges = polygon::Edges::default();
    cover.clear(rows.len());
    for mut rest in bins.band(band) {
        while let Some((&next, others)) = rest.split_first() {
            if is_planar && frame.polygons()[next as usize].count == 3 {
                let before = cover.triangles.len();
                let taken = cover.add(m, frame, rest, rows);
                sources.add(frame, setup, &cover.triangles[before..]);
                rest = &rest[taken..];
            } else {
                let material = frame.polygons()[next as usize].material;
                edges.runs(frame, &setup.attributes, rows, next, &mut |row, pixels, depth, attribute| {
                    let source = sources.spans.len() as u32 | Run::SPAN;
                    sources.spans.push(([next, material], depth, attribute));
                    let (start, end) = (pixels.start as u16, pixels.end as u16);
                    cover.runs[row - rows.start].push(Run { start, end, source, weights: [0.0; 2] });
                });
                rest = others;
            }
        }
    }
    sources
}

/// Draws the runs of a scanline, then shades it.
#[inline(never)]
fn paint_and_shade<S: Shader, M: Lanes>(
    m: M,
    painter: &Painter<'_, S>,
    (y, runs): (usize, &[Run]),
    (consts, only): (&[S::Consts<M::F>], Option<u32>),
    row: &mut Row,
    line: &mut [Vec<f32>; 3],
) {
    m.vectorize(
        #[inline(always)]
        || {
            painter.runs(m, y, runs, row);
            shade::row::<S, M>(m, consts, only, row, line);
        },
    );
}

/// The number of the one material that all polygons have, if there is only one.
fn only_material(frame: &Frame) -> Option<u32> {
    let first = frame.polygons().first().map_or(0, |polygon| polygon.material);
    let is_only = frame.lightings().len() <= 1 || frame.polygons().iter().all(|polygon| polygon.material == first);
    is_only.then_some(first)
}
