//! The row engine: bands of scanlines, shaded row by row.
//!
//! A band's polygons are scan-converted one after the other; where one is nearer than what was drawn before, what its walk
//! gives to the pixel ([`Shader::Pixel`]) is written into planes beside the depth. When the band is complete each row is
//! shaded once, a group of pixels at a time, over the row and not over the span: shading costs the same for a pixel in a
//! triangle of two pixels as in one of a thousand, and hidden pixels are never shaded.
//!
//! Bands are high enough to share the set-up of a polygon among rows, and low enough for their planes to stay in the L2
//! cache. They are independent of one another: one is one unit of work for a thread.

mod band;
mod cover;
mod polygon;
mod shade;
mod span;

use super::bands::Bands;
use super::bins::Bins;
use super::depth::SampleDepth;
use super::setup::SetUp;
use super::sink::RowSink;
use crate::frame::Frame;
use crate::number::{Lanes, Scalar};
use crate::shader::Shader;
use crate::walk::Attribute;
use alloc::vec::Vec;
pub(crate) use band::Band;
use core::ops::Range;
pub(crate) use cover::Batch;
use span::Painter;

/// The planes of a band take this many bytes at most, where its height can see to it: a common L2 cache.
const BAND_BYTES: usize = 512 << 10;

/// Whether the engine can draw `frame` with shader `S`: its depth must be interpolated and kept as it is, and what its
/// walk gives must be numbers.
pub(crate) fn can_draw<S: Shader, M: Lanes>(frame: &Frame) -> bool {
    let depth = SampleDepth::new(frame);
    span::planes::<S, M>().is_some() && depth.is_plain()
}

/// The height of a band for a row of so many values, in scanlines: 4, 8 or 16, 8 where samples need it.
fn height(frame: &Frame, planes: usize) -> usize {
    let row = 4 * frame.width() * (planes + 1);
    let fitting = (BAND_BYTES / row.max(1)).clamp(4, 16);
    let height = if fitting >= 16 {
        16
    } else if fitting >= 8 {
        8
    } else {
        4
    };
    height.max(frame.samples())
}

/// Draws `frame` with a shader, band by band.
pub(crate) fn draw<S: Shader, M: Lanes>(m: M, frame: &Frame, parameters: &[u32], bands: &mut dyn Bands) {
    let Some(planes) = span::planes::<S, M>() else { return };
    let setup = SetUp::<S, Scalar>::new(Scalar, frame, parameters);
    let consts: Vec<S::Consts<M::F>> =
        frame.lightings().iter().map(|l| S::consts(l, parameters, &|x| m.splat(x))).collect();
    let only = only_material(frame);
    let planes = planes + usize::from(only.is_none());
    let bins = Bins::new(frame, height(frame, planes));
    let depth = SampleDepth::new(frame);
    let is_planar = S::Attribute::<f32>::IS_PLANAR;
    bands.each(bins.height(), &|number, rows, scratch, sink| {
        scratch.band.prepare(frame.width(), bins.height(), planes);
        let mut painter = Painter {
            m,
            frame,
            setup: &setup,
            band: &mut scratch.band,
            rows: rows.clone(),
            hides: depth.hides(),
            notes_material: only.is_none(),
            fetched: Vec::new(),
        };
        let mut edges = polygon::Edges::default();
        for mut rest in bins.band(number) {
            while let Some((&next, others)) = rest.split_first() {
                if is_planar && frame.polygons()[next as usize].count == 3 {
                    let taken = scratch.batch.fill(m, frame, rest, &rows);
                    painter.triangles(&scratch.batch);
                    rest = &rest[taken..];
                } else {
                    edges.runs(frame, &setup.attributes, &rows, next, &mut |row, pixels, depth, attribute| {
                        painter.run(next, row, pixels, depth, attribute);
                    });
                    rest = others;
                }
            }
        }
        shade_rows::<S, M>(m, &consts, only, &mut scratch.band, &mut scratch.line, rows, sink);
    });
}

/// The number of the one material that all polygons have, if there is only one.
fn only_material(frame: &Frame) -> Option<u32> {
    let first = frame.polygons().first().map_or(0, |polygon| polygon.material);
    let is_only = frame.lightings().len() <= 1 || frame.polygons().iter().all(|polygon| polygon.material == first);
    is_only.then_some(first)
}

/// Shades the rows of a band, gives them to `sink`, and empties them.
fn shade_rows<S: Shader, M: Lanes>(
    m: M,
    consts: &[S::Consts<M::F>],
    only: Option<u32>,
    band: &mut Band,
    line: &mut [Vec<f32>; 3],
    rows: Range<usize>,
    sink: &mut dyn RowSink,
) {
    for row in 0..rows.len() {
        let mut row_of_band = band.row(row);
        let drawn = row_of_band.drawn.clone();
        for channel in line.iter_mut() {
            if channel.len() < drawn.end + 2 * M::WIDTH {
                channel.resize(drawn.end + 2 * M::WIDTH, 0.0);
            }
        }
        m.vectorize(
            #[inline(always)]
            || shade::row::<S, M>(m, consts, only, &row_of_band, line),
        );
        let [r, g, b] = &*line;
        sink.row(row, drawn.clone(), row_of_band.depth(drawn.start), [r, g, b].map(|c| &c[drawn.start..]));
        row_of_band.clear();
    }
}
