//! The G-buffer: a tile of scanlines with the depth, the varyings and the material of each pixel; and the depth test of the row
//! engine (`Writer::put` for a block, `Writer::put_one` for a pixel).

use crate::number::lanes::Lanes;
use crate::number::simd::BLOCK;
use crate::raster::depth::{CallersDepth, DepthTest, SampleDepth, level_of};
use crate::shading::CellLayout;
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::{Simd, SimdBase, f32x8, i32x8};

/// The most floats per pixel that are interpolated over triangles: depth, L·N of eight lights, V·N, a normal, and the material.
pub(super) const MOST: usize = 14;

/// The floats per pixel in the G-buffer: `N`, or for `N` = 0 the field.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumberCount<const N: usize>(pub usize);

impl<const N: usize> NumberCount<N> {
    #[inline(always)]
    pub fn get(self) -> usize {
        if N == 0 { self.0 } else { N }
    }
}

/// A tile of pixels in blocks of 8. Each block is contiguous, number after number as [`CellLayout`] has them.
///
/// Loads have the address and width of the last triangle's stores, so that store-to-load forwarding works.
#[derive(Debug, Default)]
pub(crate) struct Tile {
    rows: usize,
    /// Blocks per row, an even number.
    blocks: usize,
    pub cell: CellLayout,
    values: Vec<f32>,
    /// The blocks of a row between which anything may have been drawn: see [`Tile::drawn`].
    drawn: Range<usize>,
}

impl Tile {
    /// Makes room for `rows` rows of `width` pixels, all of them empty.
    pub fn prepare(&mut self, rows: usize, width: usize, cell: CellLayout) {
        let blocks = width.div_ceil(2 * BLOCK) * 2;
        // Shading leaves the tile cleared, so only a change of layout clears it here.
        if (self.rows, self.blocks, self.cell) != (rows, blocks, cell) {
            (self.rows, self.blocks, self.cell) = (rows, blocks, cell);
            self.values.clear();
            self.values
                .resize(rows * blocks * cell.stride(), f32::INFINITY);
        }
        self.drawn = blocks..0;
    }

    /// Reports that these blocks of any row may have been drawn.
    #[inline(always)]
    pub fn extend(&mut self, blocks: Range<usize>) {
        self.drawn = self.drawn.start.min(blocks.start)..self.drawn.end.max(blocks.end);
    }

    /// Returns the blocks of each row between which anything may have been drawn: an even number from an even one on.
    pub fn drawn(&self) -> Range<usize> {
        // Nothing drawn: from the end to the beginning.
        self.drawn.start.min(self.drawn.end) & !1..self.drawn.end.next_multiple_of(2)
    }

    /// Returns the distance from one block to the next, in values.
    pub fn stride(&self) -> usize {
        self.cell.stride()
    }

    /// Returns blocks of a row, from left to right.
    pub fn row(&self, row: usize, blocks: Range<usize>) -> &[f32] {
        let first = (row * self.blocks + blocks.start) * self.stride();
        &self.values[first..first + blocks.len() * self.stride()]
    }

    /// Empties those pixels of a row that do not pass the test against the caller's depth, and stores the depths of the others there.
    pub fn hide_behind(&mut self, row: usize, depth: CallersDepth<'_>) {
        match depth.test.test {
            DepthTest::Less => self.hide::<false, false>(row, depth),
            DepthTest::LessOrEqual => self.hide::<false, true>(row, depth),
            DepthTest::Greater => self.hide::<true, false>(row, depth),
            DepthTest::GreaterOrEqual => self.hide::<true, true>(row, depth),
        }
    }

    fn hide<const REVERSED: bool, const EQUAL: bool>(
        &mut self,
        row: usize,
        CallersDepth { stored, test }: CallersDepth<'_>,
    ) {
        let (drawn, stride) = (self.drawn(), self.stride());
        let first = (row * self.blocks + drawn.start) * stride;
        let stored = stored.get_mut(drawn.start * BLOCK..).unwrap_or_default();
        let blocks = self.values[first..][..drawn.len() * stride].chunks_exact_mut(stride);
        for (block, stored) in blocks.zip(stored.chunks_mut(BLOCK)) {
            let depths = &mut block[BLOCK * CellLayout::DEPTH..][..BLOCK];
            for (depth, stored) in depths.iter_mut().zip(stored) {
                test.hide::<REVERSED, EQUAL>(depth, stored);
            }
        }
    }

    /// Stores number `number` of pixel `x` of the first row.
    #[cfg(test)]
    pub fn set(&mut self, x: usize, number: usize, value: f32) {
        let block = x / BLOCK * self.stride();
        self.values[block + number * BLOCK + x % BLOCK] = value;
    }

    /// Empties what was drawn of a row.
    pub fn clear_row(&mut self, row: usize) {
        let (drawn, stride) = (self.drawn(), self.stride());
        let first = (row * self.blocks + drawn.start) * stride;
        for block in self.values[first..][..drawn.len() * stride].chunks_exact_mut(stride) {
            block[BLOCK * CellLayout::DEPTH..][..BLOCK].fill(f32::INFINITY);
        }
    }

    /// Returns the places of the first numbers of pixels, from rows and columns.
    #[inline(always)]
    pub fn places<S: Simd>(&self, m: Lanes<S>, row: i32x8<S>, column: i32x8<S>) -> i32x8<S> {
        let in_block = column & m.int(BLOCK as i32 - 1);
        // 32 bits hold the numbers of a tile, which has at most 16 rows.
        let pixels = row * m.int((self.blocks * BLOCK) as i32) + (column - in_block);
        pixels * m.int(self.cell.count() as i32) + in_block
    }

    /// Returns write access to all blocks. Report the blocks written with [`Tile::extend`], or they are not shaded.
    #[inline(always)]
    pub fn writer<S: Simd, const N: usize>(
        &mut self,
        lanes: Lanes<S>,
        test: SampleDepth,
    ) -> Writer<'_, S, N> {
        let never = f32::INFINITY;
        Writer {
            lanes,
            test,
            least: lanes.splat(if test.hides { -never } else { never }),
            blocks: self.blocks,
            count: NumberCount(self.cell.count()),
            values: &mut self.values,
        }
    }
}

/// Write access to a tile, with the depth test.
pub(super) struct Writer<'a, S: Simd, const N: usize> {
    lanes: Lanes<S>,
    test: SampleDepth,
    /// The least depth that stored ones count as: +∞ disables the test, and every new pixel passes.
    least: f32x8<S>,
    /// Blocks per row.
    pub blocks: usize,
    pub count: NumberCount<N>,
    values: &'a mut [f32],
}

impl<S: Simd, const N: usize> Writer<'_, S, N> {
    /// Returns the distance from one block to the next, in values.
    #[inline(always)]
    pub fn stride(&self) -> usize {
        self.count.get() * BLOCK
    }

    /// Writes the block whose values begin at `place` where `outside` is not below 0 and its depth passes the test. `number` returns
    /// each number, depth first.
    ///
    /// It writes in any case: the processor cannot predict which blocks are seen where triangles are small.
    #[inline(always)]
    pub fn put(&mut self, place: usize, outside: i32x8<S>, number: impl Fn(usize) -> f32x8<S>) {
        let (m, stride) = (self.lanes, self.stride());
        let mut depth = number(0);
        if let Some(most) = self.test.most {
            depth = level_of(m, depth, most as f32);
        }
        let Some(values) = self.values.get_mut(place..place + stride) else {
            debug_assert!(false, "a block beyond the tile: {place}");
            return;
        };
        let mask = m.depth_mask(outside, depth, m.load(values).max(self.least));
        // By number: with `chunks_exact_mut` it depends on the rest of the crate whether the loop is unrolled.
        for i in 0..self.count.get() {
            let place = &mut values[i * BLOCK..(i + 1) * BLOCK];
            let new = if i == 0 { depth } else { number(i) };
            m.store(m.select(mask, m.load(place), new), place);
        }
    }

    /// Writes one pixel, its depth and then its numbers, at a place that [`Tile::places`] gave.
    #[inline(always)]
    pub fn put_one(&mut self, place: i32, numbers: &[f32]) {
        // Places are 0 or more: so the end of what is stored is in bounds if it is at all.
        let (place, count) = (place as u32 as usize, self.count.get());
        let depth = self.test.kept(numbers[0]);
        let values = &mut self.values[place..place + (count - 1) * BLOCK + 1];
        let numbers = &numbers[..count];
        if !self.test.hides || depth < values[0] {
            values[0] = depth;
            for i in 1..count {
                values[i * BLOCK] = numbers[i];
            }
        }
    }
}
