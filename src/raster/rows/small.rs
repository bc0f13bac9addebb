//! Small triangles, block by block, by edge functions: narrow ones row by row of their boxes, others between the limits of each
//! row.

use super::tile::{MOST, Writer};
use super::triangles::Batch;
use crate::number::lanes::Lanes;
use crate::number::simd::BLOCK;
use core::ops::Range;
use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8, i32x8};

/// A depth, and the other numbers of pixels.
type Numbers<S> = [f32x8<S>; MOST];

/// A small triangle that is drawn block by block.
///
/// Its numbers are exact, but for roundings, at the first pixel of its first block, or of the first one of each row, and grow from
/// there: finding them anew in each block took 46 instructions a block where 28 do now (`phong-rsqrt`, AVX2).
///
/// That costs accuracy where a triangle is thin. Barycentric coordinates are in 0..=1 where it is covered and grow by at most
/// [`STEEPEST`](super::triangles::STEEPEST) a pixel. A covered pixel is at most 15 rows and 15 columns from where numbers begin, so
/// that no coordinate is over 121 on the way; 6 roundings of that where they begin, one of each of 17 sums, and 6 of each of 30
/// steps, are below 3600 · 2⁻²⁴, which is below 2⁻¹² of how far corners are apart. Along a row, from its first block on, it is
/// less: where a coordinate grows by more than 1 a pixel no two pixels of a row are covered. A triangle that is 2 pixels thick is
/// within 2⁻¹⁵.
pub(super) struct SmallTriangle<'a, S: Simd> {
    m: Lanes<S>,
    batch: &'a Batch,
    /// Its number in the batch.
    k: usize,
    /// The blocks of a row between which it lies.
    blocks: [usize; 2],
    /// How much its edge functions grow to each pixel of a block, from block to block, and from row to row.
    ramp: [i32x8<S>; 3],
    across: [i32x8<S>; 3],
    down: [i32x8<S>; 3],
}

/// What eight rows of a small triangle begin with, by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowStarts {
    /// The first block, counted from the triangle's first, and the one after the last.
    blocks: [[i32; BLOCK]; 2],
    functions: [[i32; BLOCK]; 3],
    /// The numbers that are interpolated, at the first pixel of the first block.
    numbers: [[f32; BLOCK]; MOST],
}

impl<'a, S: Simd> SmallTriangle<'a, S> {
    /// Sets up triangle `k` of a batch.
    #[inline(always)]
    pub fn new(m: Lanes<S>, batch: &'a Batch, k: usize) -> Self {
        let [a, b, c] = &batch.edges;
        let right = [m.int(a.right[k]), m.int(b.right[k]), m.int(c.right[k])];
        let counted = m.counted();
        SmallTriangle {
            m,
            batch,
            k,
            blocks: [
                batch.columns[0][k] as usize / BLOCK,
                (batch.columns[1][k] as usize).div_ceil(BLOCK),
            ],
            ramp: [counted * right[0], counted * right[1], counted * right[2]],
            across: [m.int(a.across[k]), m.int(b.across[k]), m.int(c.across[k])],
            down: [m.int(a.down[k]), m.int(b.down[k]), m.int(c.down[k])],
        }
    }

    /// Draws it into the tile that begins with row `top`.
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

    /// Draws one or two blocks a row: all of them are looked at. Limits would take longer than what they spare.
    #[inline(always)]
    fn narrow<const N: usize>(&self, rows: Range<usize>, writer: &mut Writer<'_, S, N>) {
        let (m, k, [_, b, c]) = (self.m, self.k, &self.batch.edges);
        let [first, end] = self.blocks;
        let count = writer.count.get();
        let growth = self.growth::<N>(count, [b.growth[k], c.growth[k]]);
        let down = self.growth::<N>(count, [b.fall[k], c.fall[k]]);
        let start = self
            .batch
            .planes
            .at(m, k, count, [b.weight[k], c.weight[k]]);
        let (counted, width) = (m.float(m.counted()), m.splat(BLOCK as f32));
        let (mut at, mut across) = (growth, growth);
        let mut i = 0;
        while i < count {
            at[i] = growth[i].mul_add(counted, m.splat(start[i]));
            across[i] = growth[i] * width;
            i += 1;
        }
        let at_first = |edge: usize| m.int(self.batch.edges[edge].at[k]) + self.ramp[edge];
        let mut functions = [at_first(0), at_first(1), at_first(2)];
        let stride = writer.stride();
        let mut place = (rows.start * writer.blocks + first) * stride;
        for _ in rows {
            writer.put(
                place,
                outside(functions),
                at[0],
                #[inline(always)]
                |i| at[i],
            );
            if end - first == 2 {
                writer.put(
                    place + stride,
                    outside(grown(functions, self.across)),
                    at[0] + across[0],
                    #[inline(always)]
                    |i| at[i] + across[i],
                );
            }
            functions = grown(functions, self.down);
            let mut i = 0;
            while i < count {
                at[i] += down[i];
                i += 1;
            }
            place += writer.blocks * stride;
        }
    }

    /// Draws any number of blocks a row, between the limits of each row.
    #[inline(always)]
    fn wide<const N: usize>(
        &self,
        starts: &mut RowStarts,
        rows: Range<usize>,
        writer: &mut Writer<'_, S, N>,
    ) {
        let (m, k, edges) = (self.m, self.k, &self.batch.edges);
        let [first, _] = self.blocks;
        let (count, stride) = (writer.count.get(), writer.stride());
        let (mut across, mut ramps) = (
            self.growth::<N>(count, [edges[1].growth[k], edges[2].growth[k]]),
            [m.splat(0.0); MOST],
        );
        let (counted, width) = (m.float(m.counted()), m.splat(BLOCK as f32));
        let mut i = 0;
        while i < count {
            (across[i], ramps[i]) = (across[i] * width, across[i] * counted);
            i += 1;
        }
        self.each_row(
            starts,
            rows,
            count,
            #[inline(always)]
            |row, of_eight, starts| {
                let mut functions = self.functions(starts, of_eight);
                let mut at = ramps;
                let mut i = 0;
                while i < count {
                    at[i] = m.splat(starts.numbers[i][of_eight]) + ramps[i];
                    i += 1;
                }
                let before = row * writer.blocks + first;
                let [from, to] = [starts.blocks[0][of_eight], starts.blocks[1][of_eight]];
                let mut place = (before + from as u32 as usize) * stride;
                for _ in from..to {
                    writer.put(
                        place,
                        outside(functions),
                        at[0],
                        #[inline(always)]
                        |i| at[i],
                    );
                    functions = grown(functions, self.across);
                    let mut i = 0;
                    while i < count {
                        at[i] += across[i];
                        i += 1;
                    }
                    place += stride;
                }
            },
        );
    }

    /// Gives its rows: number in the tile, number among eight, and what these begin with, `count` numbers of each.
    ///
    /// Eight rows are found at a time. Rows past the last are computed and not given: there 32 bits need not hold the results.
    #[inline(always)]
    fn each_row(
        &self,
        starts: &mut RowStarts,
        rows: Range<usize>,
        count: usize,
        mut visit: impl FnMut(usize, usize, &RowStarts),
    ) {
        let (m, k, edges) = (self.m, self.k, &self.batch.edges);
        let over_area = m.splat(self.batch.over_area[k]);
        let mut row = rows.start;
        while row < rows.end {
            let number = m.counted() + m.int((row - rows.start) as i32);
            let at = |edge: usize| m.int(edges[edge].at[k]) + number * self.down[edge];
            let mut start = [at(0), at(1), at(2)];
            let [from, to] = self.limits(start);
            m.store_int(from, &mut starts.blocks[0]);
            m.store_int(to, &mut starts.blocks[1]);
            let mut i = 0;
            while i < 3 {
                start[i] += from * self.across[i];
                m.store_int(start[i], &mut starts.functions[i]);
                i += 1;
            }
            let weight = |edge: usize| {
                m.float(start[edge])
                    .mul_add(over_area, m.splat(edges[edge].off[k]))
            };
            let weights = [weight(1), weight(2)];
            let mut i = 0;
            while i < count {
                m.store(
                    self.batch.planes.number(m, k, i, weights),
                    &mut starts.numbers[i],
                );
                i += 1;
            }
            let here = BLOCK.min(rows.end - row);
            for of_eight in 0..here {
                visit(row + of_eight, of_eight, starts);
            }
            row += here;
        }
    }

    /// Returns the edge functions in the first block of a row.
    #[inline(always)]
    fn functions(&self, starts: &RowStarts, of_eight: usize) -> [i32x8<S>; 3] {
        let function = |edge: usize| self.m.int(starts.functions[edge][of_eight]) + self.ramp[edge];
        [function(0), function(1), function(2)]
    }

    /// Returns the blocks of rows, counted from the first, between which all functions are over 0, which are `start` at the rows'
    /// first pixels.
    ///
    /// Where a function becomes 0 is off by three roundings: with at most 62 columns by less than 2⁻¹⁶ of one. A block more is
    /// looked at where that could matter.
    #[inline(always)]
    fn limits(&self, start: [i32x8<S>; 3]) -> [i32x8<S>; 2] {
        let (m, k, [first, end]) = (self.m, self.k, self.blocks);
        let blocks = 1.0 / BLOCK as f32;
        let doubt = m.splat(blocks / 1024.0);
        let (mut from, mut to) = (m.splat(0.0), m.splat(((end - first) * BLOCK - 1) as f32));
        let mut i = 0;
        while i < 3 {
            let edge = &self.batch.edges[i];
            let here = m.float(start[i]);
            from = from.max(here * m.splat(edge.begins[k]));
            to = to.min(here.mul_add(m.splat(edge.ends[0][k]), m.splat(edge.ends[1][k])));
            i += 1;
        }
        let blocks = m.splat(blocks);
        [
            m.truncated(from.mul_add(blocks, -doubt)),
            m.truncated(to.mul_add(blocks, doubt)) + m.int(1),
        ]
    }

    /// Returns how much its numbers grow where the coordinates grow by `growth`.
    #[inline(always)]
    fn growth<const N: usize>(&self, count: usize, growth: [f32; 2]) -> Numbers<S> {
        let steps = self.batch.planes.growth(self.m, self.k, count, growth);
        let mut grown = [self.m.splat(0.0); MOST];
        let mut i = 0;
        while i < if N == 0 { count } else { N } {
            grown[i] = self.m.splat(steps[i]);
            i += 1;
        }
        grown
    }
}

/// Returns a number below 0 at pixels that are not covered.
#[inline(always)]
fn outside<S: Simd>([a, b, c]: [i32x8<S>; 3]) -> i32x8<S> {
    a | b | c
}

#[inline(always)]
fn grown<S: Simd>(at: [i32x8<S>; 3], step: [i32x8<S>; 3]) -> [i32x8<S>; 3] {
    [at[0] + step[0], at[1] + step[1], at[2] + step[2]]
}
