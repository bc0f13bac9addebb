//! The run path: draws large triangles, polygons of any shape, and methods that remember the pixel
//! before, by runs of pixels on a scanline.

use super::tile::{Tile, Writer};
use super::triangles::Batch;
use crate::frame::SubPixel;
use crate::number::lanes::Lanes;
use crate::number::simd::BLOCK;
use crate::raster::setup::SetUp;
use crate::raster::spans::active::ActiveEdges;
use crate::raster::spans::edge::{EdgeCrossing, first_centre};
use crate::raster::spans::edge_table::{TableEdge, for_each_edge};
use crate::shading::{CellLayout, GROUP, Run, RunList, RunValues, WalkKernel};
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::{Simd, f32x8, i32x8};

/// The place of a run: its row in the tile, the depth at its first pixel, and the growth of depth
/// per pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct RunPlace {
    pub row: usize,
    pub depth: [f32; 2],
}

/// Runs that wait for one call to walk along them all.
#[derive(Debug, Default)]
pub(crate) struct RunQueue {
    places: Vec<RunPlace>,
    list: RunList,
    /// The pixels that the walks return.
    walked: Vec<f32>,
    /// How many blocks all runs have.
    blocks: usize,
    /// A polygon's edges from the top down, each with its first row.
    edges: Vec<(i32, TableEdge)>,
}

/// How many blocks one call walks along. Their pixels stay in the first cache.
const MOST_BLOCKS: usize = 128;

impl RunQueue {
    /// Prepares for runs with `count` values, varyings and extras together.
    pub fn prepare(&mut self, count: usize) {
        self.list.prepare(count);
    }

    /// True if there are enough runs to draw.
    pub fn is_full(&self) -> bool {
        self.blocks >= MOST_BLOCKS
    }

    /// Adds the runs of `polygon`, which may have any shape. Its edges step their varyings from row
    /// to row.
    pub fn add_polygon(
        &mut self,
        setup: &SetUp<'_>,
        active: &mut ActiveEdges<'_>,
        polygon: u32,
        rows: &Range<usize>,
    ) {
        let frame = setup.frame;
        let (uniforms, width) = (setup.uniforms_of(polygon), frame.width() as u32);
        let mut edges = core::mem::take(&mut self.edges);
        edges.clear();
        let (top, bottom) = (rows.start as i32, rows.end as i32);
        for_each_edge(frame, top..bottom, polygon, |row, edge| {
            edges.push((row, edge))
        });
        edges.sort_by_key(|(row, _)| *row);
        let mut rest = &edges[..];
        for row in edges.first().map_or(bottom, |(row, _)| *row)..bottom {
            let is_later = |(first, _): &(i32, TableEdge)| *first != row;
            let count = rest.iter().position(is_later).unwrap_or(rest.len());
            let (new, later) = rest.split_at(count);
            rest = later;
            // In most rows no edge begins or ends. Then the edges are stepped in place and not
            // copied.
            if !(new.is_empty() && active.step(row)) {
                active.next(new.iter().map(|(_, edge)| edge), row);
            }
            if active.is_empty() && rest.is_empty() {
                break;
            }
            active.spans(width, |active, span| {
                let pixels = span.start as usize..span.end as usize;
                self.blocks += pixels.len().div_ceil(BLOCK);
                active.add_run(&span, row as usize, pixels, uniforms, &mut self.list);
                self.places.push(RunPlace {
                    row: row as usize - rows.start,
                    depth: [span.depth, span.depth_step],
                });
            });
        }
        active.clear();
        self.edges = edges;
    }

    /// True if no run waits.
    pub fn is_empty(&self) -> bool {
        self.list.runs.is_empty()
    }

    /// Reports to `tile` the blocks that the runs may draw.
    pub fn extend(&self, tile: &mut Tile) {
        for run in &self.list.runs {
            let pixels = pixels_of(run);
            tile.extend(pixels.start / BLOCK..pixels.end.div_ceil(BLOCK));
        }
    }

    /// Draws the runs in order, with the varyings and extras of `cell`. They are the values that
    /// `walk` returns, if the method has a walk, and are interpolated otherwise.
    #[inline(always)]
    pub fn draw<S: Simd>(
        &mut self,
        m: Lanes<S>,
        setup: &SetUp<'_>,
        walk: Option<WalkKernel>,
        cell: CellLayout,
        mut writer: Writer<'_, S, 0>,
    ) {
        let count = cell.varyings + cell.extras;
        if let Some(walk) = walk {
            let room = self.blocks * BLOCK * count;
            // Block loads may overrun a run at either end, and a mask drops those lanes. So a block
            // of padding stands before and behind.
            let len = self.walked.len().max(room + 2 * BLOCK);
            self.walked.resize(len, 0.0);
            let job = setup.pixels(&self.list);
            walk(&job, &mut self.walked[BLOCK..BLOCK + room]);
        }
        debug_assert_eq!(self.list.runs.len(), self.places.len(), "a place a run");
        let mut walked = BLOCK;
        for (i, (run, place)) in self.list.runs.iter().zip(&self.places).enumerate() {
            let (uniforms, pixels) = (
                m.splat(CellLayout::of_uniforms(run.uniforms)),
                pixels_of(run),
            );
            if walk.is_some() {
                let length = pixels.len().next_multiple_of(BLOCK);
                // Starts a block early, as the run's first block may begin up to 7 pixels before
                // the run.
                let from = &self.walked[walked - BLOCK..walked + length * count + BLOCK];
                draw_run(
                    m,
                    *place,
                    pixels,
                    &mut writer,
                    #[inline(always)]
                    |index, x| match index - CellLayout::varying(0) {
                        plane if plane < count => {
                            m.load(&from[(BLOCK as isize + x) as usize + plane * length..])
                        }
                        _ => uniforms,
                    },
                );
                walked += length * count;
            } else {
                let RunValues(groups) = self.list.starts.of(i);
                draw_run(
                    m,
                    *place,
                    pixels,
                    &mut writer,
                    #[inline(always)]
                    |index, x| match index - CellLayout::varying(0) {
                        i if i < count => {
                            let [at, step] = &groups[i / GROUP];
                            m.ramp(at[i % GROUP], x as i32, step[i % GROUP])
                        }
                        _ => uniforms,
                    },
                );
            }
        }
        self.places.clear();
        self.list.clear();
        self.blocks = 0;
    }
}

/// Returns the pixels of a run.
#[inline(always)]
fn pixels_of(run: &Run) -> Range<usize> {
    run.x as usize..(run.x + run.pixels) as usize
}

/// Draws a run. `value(i, x)` returns value i, of any but depth, for the block that begins `x`
/// pixels after the run's first pixel; `x` may be negative.
#[inline(always)]
pub(super) fn draw_run<S: Simd, const N: usize>(
    m: Lanes<S>,
    RunPlace { row, depth }: RunPlace,
    pixels: Range<usize>,
    writer: &mut Writer<'_, S, N>,
    value: impl Fn(usize, isize) -> f32x8<S>,
) {
    for block in pixels.start / BLOCK..pixels.end.div_ceil(BLOCK) {
        // Blocks lie at multiples of 8 pixels in the tile, so the first one may begin before the
        // run.
        let x = (block * BLOCK) as isize - pixels.start as isize;
        writer.put(
            (row * writer.blocks + block) * writer.stride(),
            outside(m, block, &pixels),
            #[inline(always)]
            |i| match i {
                CellLayout::DEPTH => m.ramp(depth[0], x as i32, depth[1]),
                _ => value(i, x),
            },
        );
    }
}

/// Draws large triangle `k` of a batch into a tile whose first row is `top`. The pixels of a row
/// lie between the crossings of two edges with it.
#[inline(always)]
pub(super) fn draw_large<S: Simd, const N: usize>(
    m: Lanes<S>,
    batch: &Batch,
    k: usize,
    top: usize,
    writer: &mut Writer<'_, S, N>,
) {
    let [x, y] = [&batch.x, &batch.y].map(|at| [at[0][k], at[1][k], at[2][k]]);
    let [columns, rows] = [&batch.columns, &batch.rows].map(|ends| ends[0][k]..ends[1][k]);
    // Twice the area of the triangle of corners i and j and a point. It is below 0 where the
    // triangle runs the other way round.
    let doubled = |i: usize, j: usize, px: i64, py: i64| {
        let [xi, xj, yi, yj] = [x[i], x[j], y[i], y[j]].map(i64::from);
        (xj - xi) * (py - yi) - (yj - yi) * (px - xi)
    };
    let area = doubled(0, 1, i64::from(x[2]), i64::from(y[2]));
    if area == 0 {
        return;
    }
    let over_area = 1.0 / area as f32;
    // A quotient of two areas is a barycentric coordinate, whichever way the triangle runs:
    // numerator and `area` have one sign.
    let scale = 256.0 * over_area;
    let across = [(y[2] - y[0]) as f32 * scale, (y[0] - y[1]) as f32 * scale];
    // The growth of the second and third corner's coordinates per column. A column is 256
    // sub-pixels.
    let count = writer.count.get();
    let step = batch.planes.growth(m, k, count, across);
    // Two edges go down from the top corner. The shorter one ends at the middle corner, from which
    // the third edge goes on.
    let [above, middle, below] = [0, 1, 2].map(|i| [x[i], y[i]].map(SubPixel::from_bits));
    let bend = first_centre(middle[1]).clamp(rows.start, rows.end);
    let mut long = EdgeCrossing::new(above, below, rows.start);
    for (from, to, rows) in [
        (above, middle, rows.start..bend),
        (middle, below, bend..rows.end),
    ] {
        if rows.is_empty() {
            continue;
        }
        let mut short = EdgeCrossing::new(from, to, rows.start);
        for row in rows {
            let (p, q) = (long.pixel(), short.pixel());
            // Either edge may be the left one: the crossings are ordered without a branch.
            let (start, end) = (p.min(q).max(columns.start), p.max(q).min(columns.end));
            if start < end {
                let [px, py] = [start, row].map(|at| 256 * i64::from(at) + 128);
                let weight = |i, j| doubled(i, j, px, py) as f32 * over_area;
                let at = batch.planes.at(m, k, count, [weight(2, 0), weight(0, 1)]);
                let place = RunPlace {
                    row: row as usize - top,
                    depth: [at[CellLayout::DEPTH], step[CellLayout::DEPTH]],
                };
                draw_run(
                    m,
                    place,
                    start as usize..end as usize,
                    writer,
                    #[inline(always)]
                    |i, x| m.ramp(at[i], x as i32, step[i]),
                );
            }
            long.advance();
            short.advance();
        }
    }
}

/// Returns values below 0 in the lanes of block `block` that a run does not cover.
#[inline(always)]
fn outside<S: Simd>(m: Lanes<S>, block: usize, pixels: &Range<usize>) -> i32x8<S> {
    let (first, k) = ((block * BLOCK) as i32, m.counted());
    // The first difference is below 0 left of the run, the second one right of it. An or keeps
    // either sign.
    (k - m.int(pixels.start as i32 - first)) | (m.int(pixels.end as i32 - 1 - first) - k)
}
