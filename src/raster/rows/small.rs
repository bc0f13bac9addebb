//! Small triangles, drawn block by block by edge functions. Narrow ones draw their whole boxes,
//! others only the blocks between the limits of each row.

use super::tile::{MOST, Writer};
use super::triangles::Batch;
use crate::number::lanes::Lanes;
use crate::number::simd::BLOCK;
use core::ops::Range;
use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8, i32x8};

/// The values of a block of pixels, depth first.
type BlockValues<S> = [f32x8<S>; MOST];

/// A small triangle, which is drawn block by block.
///
/// Its values are exact but for rounding at the first pixel of its first block (or of the first
/// block of each row), and grow from there.
///
/// That costs accuracy where a triangle is thin. Barycentric coordinates are in 0..=1 where it is
/// covered, and grow by at most [`STEEPEST`](crate::frame::row_tiles::STEEPEST) per pixel. A
/// covered pixel is at most 15 rows and 15 columns from where values begin, so no coordinate is
/// over 121 on the way. The roundings are 6 of that at the start, one in each of 17 sums, and 6 in
/// each of 30 steps. Together they are below 3600 · 2⁻²⁴, which is below 2⁻¹² of how far corners
/// are apart. Along a row, from its first block on, they are smaller: where a coordinate grows by
/// more than 1 per pixel, no two pixels of a row are covered. A triangle that is 2 pixels thick is
/// within 2⁻¹⁵. `Variant::bound` counts these roundings for each triangle (`Extent::growth`).
pub(super) struct SmallTriangle<'a, S: Simd> {
    m: Lanes<S>,
    batch: &'a Batch,
    /// The index in the batch.
    k: usize,
    /// The blocks of a row between which the triangle lies.
    blocks: [usize; 2],
    /// The growth of its edge functions from a block's first pixel to each of its pixels, from
    /// block to block, and from row to row.
    ramp: [i32x8<S>; 3],
    across: [i32x8<S>; 3],
    down: [i32x8<S>; 3],
}

/// The first blocks in eight rows of a small triangle, one row per lane.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowStarts {
    /// The first block, counted from the triangle's first, and the one after the last.
    blocks: [[i32; BLOCK]; 2],
    /// The edge functions at the first pixel of the first block.
    functions: [[i32; BLOCK]; 3],
    /// The interpolated values at the first pixel of the first block.
    values: [[f32; BLOCK]; MOST],
}

impl<'a, S: Simd> SmallTriangle<'a, S> {
    /// Sets up triangle `k` of a batch.
    #[inline(always)]
    pub fn new(m: Lanes<S>, batch: &'a Batch, k: usize) -> Self {
        let [a, b, c] = &batch.edges;
        let right = [m.int(a.right[k]), m.int(b.right[k]), m.int(c.right[k])];
        let (counted, width) = (m.counted(), m.int(BLOCK as i32));
        let [start, end] = [0, 1].map(|side| batch.columns[side][k] as usize);
        SmallTriangle {
            m,
            batch,
            k,
            blocks: [start / BLOCK, end.div_ceil(BLOCK)],
            ramp: [counted * right[0], counted * right[1], counted * right[2]],
            across: [width * right[0], width * right[1], width * right[2]],
            down: [m.int(a.down[k]), m.int(b.down[k]), m.int(c.down[k])],
        }
    }

    /// Draws the triangle into a tile whose first row is `top`.
    #[inline(always)]
    pub fn draw<const N: usize>(
        &self,
        starts: &mut RowStarts,
        top: usize,
        writer: &mut Writer<'_, S, N>,
    ) {
        let [first, end] = self.blocks;
        let [begin, stop] = [self.batch.rows[0][self.k], self.batch.rows[1][self.k]];
        let rows = begin as usize - top..stop as usize - top;
        if end - first <= 2 {
            self.narrow(rows, writer);
        } else {
            self.wide(starts, rows, writer);
        }
    }

    /// Draws all blocks of the box, one or two per row. Finding the limits of each row would take
    /// longer.
    #[inline(always)]
    fn narrow<const N: usize>(&self, rows: Range<usize>, writer: &mut Writer<'_, S, N>) {
        let (m, k, [_, b, c]) = (self.m, self.k, &self.batch.edges);
        let [first, end] = self.blocks;
        let count = writer.count.get();
        let growth = self.growth(count, [b.growth[k], c.growth[k]]);
        let down = self.growth(count, [b.fall[k], c.fall[k]]);
        let weights = [b.weight[k], c.weight[k]];
        let start = self.batch.planes.at(m, k, count, weights);
        let (counted, width) = (m.float(m.counted()), m.splat(BLOCK as f32));
        let (mut at, mut across) = (growth, growth);
        for i in 0..count {
            at[i] = growth[i].mul_add(counted, m.splat(start[i]));
            across[i] = growth[i] * width;
        }
        let first_of = |edge: usize| m.int(self.batch.edges[edge].at[k]);
        let mut functions = grown([first_of(0), first_of(1), first_of(2)], self.ramp);
        let stride = writer.stride();
        let mut place = (rows.start * writer.blocks + first) * stride;
        for _ in rows {
            writer.put(
                place,
                outside(functions),
                #[inline(always)]
                |i| at[i],
            );
            if end - first == 2 {
                writer.put(
                    place + stride,
                    outside(grown(functions, self.across)),
                    #[inline(always)]
                    |i| at[i] + across[i],
                );
            }
            functions = grown(functions, self.down);
            for i in 0..count {
                at[i] += down[i];
            }
            place += writer.blocks * stride;
        }
    }

    /// Draws any number of blocks per row, between the limits of each row.
    #[inline(always)]
    fn wide<const N: usize>(
        &self,
        starts: &mut RowStarts,
        rows: Range<usize>,
        writer: &mut Writer<'_, S, N>,
    ) {
        let (m, [_, b, c]) = (self.m, &self.batch.edges);
        let (count, stride) = (writer.count.get(), writer.stride());
        let mut across = self.growth(count, [b.growth[self.k], c.growth[self.k]]);
        let mut ramps = [m.splat(0.0); MOST];
        let (counted, width) = (m.float(m.counted()), m.splat(BLOCK as f32));
        for i in 0..count {
            (across[i], ramps[i]) = (across[i] * width, across[i] * counted);
        }
        let first_block = rows.start * writer.blocks + self.blocks[0];
        for row in 0..rows.len() {
            // The limits of eight rows are found at once, a row in each lane.
            let of_eight = row % BLOCK;
            if of_eight == 0 {
                self.start_rows(starts, row, count);
            }
            let first_of = |edge: usize| m.int(starts.functions[edge][of_eight]);
            let mut functions = grown([first_of(0), first_of(1), first_of(2)], self.ramp);
            let mut at = ramps;
            for i in 0..count {
                at[i] = m.splat(starts.values[i][of_eight]) + ramps[i];
            }
            let before = first_block + row * writer.blocks;
            // Limits are block indices from 0 on. An empty row has an end of at most its start, and
            // the loop below does nothing.
            let [from, to] = [starts.blocks[0][of_eight], starts.blocks[1][of_eight]];
            let mut place = (before + from as u32 as usize) * stride;
            for _ in from..to {
                writer.put(
                    place,
                    outside(functions),
                    #[inline(always)]
                    |i| at[i],
                );
                functions = grown(functions, self.across);
                for i in 0..count {
                    at[i] += across[i];
                }
                place += stride;
            }
        }
    }

    /// Finds the limits of eight rows, from the triangle's row `row` on, and the values at their
    /// first blocks. There are `count` values. Rows past the last one may overflow 32 bits, but are
    /// not drawn.
    #[inline(always)]
    fn start_rows(&self, starts: &mut RowStarts, row: usize, count: usize) {
        let (m, k, edges) = (self.m, self.k, &self.batch.edges);
        let over_area = m.splat(self.batch.over_area[k]);
        let rows = m.counted() + m.int(row as i32);
        let at = |edge: usize| m.int(edges[edge].at[k]) + rows * self.down[edge];
        let mut start = [at(0), at(1), at(2)];
        let [from, to] = self.limits(start);
        m.store_int(from, &mut starts.blocks[0]);
        m.store_int(to, &mut starts.blocks[1]);
        for (i, start) in start.iter_mut().enumerate() {
            *start += from * self.across[i];
            m.store_int(*start, &mut starts.functions[i]);
        }
        let off = |edge: usize| m.splat(edges[edge].off[k]);
        let weight = |edge: usize| m.float(start[edge]).mul_add(over_area, off(edge));
        let ([at, to_b, to_c], b, c) = (&self.batch.planes.0[k], weight(1), weight(2));
        for i in 0..count {
            let value = m.splat(to_b[i]).mul_add(b, m.splat(at[i]));
            m.store(m.splat(to_c[i]).mul_add(c, value), &mut starts.values[i]);
        }
    }

    /// Returns the first block of each row, and the one after the last, between which all edge
    /// functions may be over 0. Blocks count from the triangle's first. `start` holds the functions
    /// at the first pixel of the rows' first blocks.
    ///
    /// Three roundings go into the zero of a function. With at most 62 columns they move it by less
    /// than 2⁻¹⁶ of a column. Where that could matter, one more block is drawn.
    #[inline(always)]
    fn limits(&self, start: [i32x8<S>; 3]) -> [i32x8<S>; 2] {
        let (m, k, [first, end]) = (self.m, self.k, self.blocks);
        let blocks = 1.0 / BLOCK as f32;
        let doubt = m.splat(blocks / 1024.0);
        let (mut from, mut to) = (m.splat(0.0), m.splat(((end - first) * BLOCK - 1) as f32));
        // Left edges raise `from`, right edges lower `to`. `begins` and `ends` are set up so that
        // every edge may do both: the wrong one changes nothing.
        for (edge, start) in self.batch.edges.iter().zip(start) {
            let here = m.float(start);
            from = from.max(here * m.splat(edge.begins[k]));
            to = to.min(here.mul_add(m.splat(edge.ends[0][k]), m.splat(edge.ends[1][k])));
        }
        let blocks = m.splat(blocks);
        let end = m.truncated(to.mul_add(blocks, doubt)) + m.int(1);
        [m.truncated(from.mul_add(blocks, -doubt)), end]
    }

    /// Returns the growth of the values where the coordinates grow by `growth`.
    #[inline(always)]
    fn growth(&self, count: usize, growth: [f32; 2]) -> BlockValues<S> {
        let steps = self.batch.planes.growth(self.m, self.k, count, growth);
        let mut grown = [self.m.splat(0.0); MOST];
        for i in 0..count {
            grown[i] = self.m.splat(steps[i]);
        }
        grown
    }
}

/// Returns values below 0 at pixels that are not covered: the sign of an or is set where any
/// function is below 0.
#[inline(always)]
fn outside<S: Simd>([a, b, c]: [i32x8<S>; 3]) -> i32x8<S> {
    a | b | c
}

/// Returns edge functions one step on.
#[inline(always)]
pub(super) fn grown<S: Simd>(at: [i32x8<S>; 3], step: [i32x8<S>; 3]) -> [i32x8<S>; 3] {
    [at[0] + step[0], at[1] + step[1], at[2] + step[2]]
}
