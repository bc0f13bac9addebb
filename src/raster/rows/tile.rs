//! The G-buffer, a tile of scanlines that holds depth, varyings and material of each pixel; and the
//! row engine's depth test (`Writer::put` for a block, `Writer::put_one` for a pixel).

use crate::number::lanes::Lanes;
use crate::number::simd::BLOCK;
use crate::raster::depth::{CallersDepth, DepthTest, SampleDepth, level_of};
use crate::shading::CellLayout;
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::{Simd, SimdBase, f32x8, i32x8};

/// The largest count of floats per pixel that are interpolated over triangles: depth, L·N of eight
/// lights, V·N, a normal, and the material.
pub(super) const MOST: usize = 14;

/// How many floats a pixel has in the G-buffer. `N` is the count, known to the compiler; if `N` is
/// 0 the field is.
#[derive(Clone, Copy, Debug)]
pub(super) struct ValueCount<const N: usize>(pub usize);

impl<const N: usize> ValueCount<N> {
    #[inline(always)]
    pub fn get(self) -> usize {
        if N == 0 { self.0 } else { N }
    }
}

/// A tile of pixels in blocks of 8. Each block is contiguous: 8 depths, then 8 of the next value,
/// in the order of [`CellLayout`].
///
/// A load reads the address and the width of an earlier store, of the last triangle that touched
/// the block. So store-to-load forwarding works.
#[derive(Debug, Default)]
pub(crate) struct Tile {
    rows: usize,
    /// How many blocks a row has: an even number.
    blocks: usize,
    pub cell: CellLayout,
    values: Vec<f32>,
    /// The blocks of any row between which something may have been drawn: see [`Tile::drawn`].
    drawn: Range<usize>,
}

impl Tile {
    /// Makes room for `rows` empty rows of `width` pixels.
    pub fn prepare(&mut self, rows: usize, width: usize, cell: CellLayout) {
        let blocks = width.div_ceil(2 * BLOCK) * 2;
        // Shading leaves the tile empty. Only a change of layout clears it here.
        if (self.rows, self.blocks, self.cell) != (rows, blocks, cell) {
            (self.rows, self.blocks, self.cell) = (rows, blocks, cell);
            self.values.clear();
            self.values
                .resize(rows * blocks * cell.stride(), f32::INFINITY);
        }
        // Empty, and the first call of `extend` replaces both ends.
        self.drawn = blocks..0;
    }

    /// Reports that these blocks of any row may have been drawn.
    #[inline(always)]
    pub fn extend(&mut self, blocks: Range<usize>) {
        self.drawn = self.drawn.start.min(blocks.start)..self.drawn.end.max(blocks.end);
    }

    /// Returns the blocks of each row between which something may have been drawn. Start and end
    /// are even, because kernels may shade two blocks at once.
    pub fn drawn(&self) -> Range<usize> {
        // If nothing was drawn the range is blocks..0, which becomes 0..0.
        self.drawn.start.min(self.drawn.end) & !1..self.drawn.end.next_multiple_of(2)
    }

    /// Returns the distance from one block to the next, in floats.
    pub fn stride(&self) -> usize {
        self.cell.stride()
    }

    /// Returns blocks of a row, from left to right.
    pub fn row(&self, row: usize, blocks: Range<usize>) -> &[f32] {
        let first = (row * self.blocks + blocks.start) * self.stride();
        &self.values[first..first + blocks.len() * self.stride()]
    }

    /// Takes the depths of a row over from a tile of the same pixels, and empties the row there.
    pub fn take_depths(&mut self, row: usize, from: &mut Tile) {
        let (drawn, stride) = (self.drawn(), self.stride());
        let first = (row * self.blocks + drawn.start) * stride;
        let blocks = self.values[first..][..drawn.len() * stride].chunks_exact_mut(stride);
        let others = from.row(row, drawn).chunks_exact(from.stride());
        let depths = BLOCK * CellLayout::DEPTH..BLOCK * (CellLayout::DEPTH + 1);
        for (block, other) in blocks.zip(others) {
            block[depths.clone()].copy_from_slice(&other[depths.clone()]);
        }
        from.clear_row(row);
    }

    /// Empties the pixels of a row that fail the test against the caller's depth. Stores the depths
    /// of the other pixels in the caller's buffer.
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
        // The last block may end beyond the picture. There `stored` is shorter, and pixels are not
        // compared.
        for (block, stored) in blocks.zip(stored.chunks_mut(BLOCK)) {
            let depths = &mut block[BLOCK * CellLayout::DEPTH..][..BLOCK];
            for (depth, stored) in depths.iter_mut().zip(stored) {
                test.hide::<REVERSED, EQUAL>(depth, stored);
            }
        }
    }

    /// Returns the depth at pixel `x` of a row.
    pub fn depth(&self, row: usize, x: usize) -> f32 {
        let block = self.row(row, x / BLOCK..x / BLOCK + 1);
        block[BLOCK * CellLayout::DEPTH + x % BLOCK]
    }

    /// Stores the value at `index` of pixel `x` of the first row.
    #[cfg(test)]
    pub fn set(&mut self, x: usize, index: usize, value: f32) {
        let block = x / BLOCK * self.stride();
        self.values[block + index * BLOCK + x % BLOCK] = value;
    }

    /// Empties the drawn blocks of a row.
    pub fn clear_row(&mut self, row: usize) {
        let (drawn, stride) = (self.drawn(), self.stride());
        let first = (row * self.blocks + drawn.start) * stride;
        for block in self.values[first..][..drawn.len() * stride].chunks_exact_mut(stride) {
            // An infinite depth empties a pixel. Its other values may stay.
            block[BLOCK * CellLayout::DEPTH..][..BLOCK].fill(f32::INFINITY);
        }
    }

    /// Returns where the first value of each pixel is stored, for pixels by row and column.
    #[inline(always)]
    pub fn places<S: Simd>(&self, m: Lanes<S>, row: i32x8<S>, column: i32x8<S>) -> i32x8<S> {
        let in_block = column & m.int(BLOCK as i32 - 1);
        // 32 bits hold an index into a tile, which has at most 16 rows.
        let pixels = row * m.int((self.blocks * BLOCK) as i32) + (column - in_block);
        pixels * m.int(self.cell.count() as i32) + in_block
    }

    /// Returns write access to all blocks. Report the blocks that you write with [`Tile::extend`],
    /// or they are not shaded.
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
            count: ValueCount(self.cell.count()),
            values: &mut self.values,
        }
    }
}

/// Write access to a tile, with the depth test.
pub(super) struct Writer<'a, S: Simd, const N: usize> {
    lanes: Lanes<S>,
    test: SampleDepth,
    /// A lower bound for stored depths. −∞ leaves them unchanged; +∞ disables the test, as every
    /// new pixel then passes.
    least: f32x8<S>,
    /// How many blocks a row has.
    pub blocks: usize,
    pub count: ValueCount<N>,
    values: &'a mut [f32],
}

impl<S: Simd, const N: usize> Writer<'_, S, N> {
    /// Returns the distance from one block to the next, in floats.
    #[inline(always)]
    pub fn stride(&self) -> usize {
        self.count.get() * BLOCK
    }

    /// Writes the block whose values begin at `place`, in the lanes where `outside` is not below 0
    /// and the depth passes the test. `value(i)` returns value i; value 0 is depth.
    ///
    /// It stores the whole block in any case, and selects the old values in the other lanes. A
    /// branch around the stores would be mispredicted where triangles are small.
    #[inline(always)]
    pub fn put(&mut self, place: usize, outside: i32x8<S>, value: impl Fn(usize) -> f32x8<S>) {
        let (m, stride) = (self.lanes, self.stride());
        let mut depth = value(0);
        if let Some(most) = self.test.most {
            depth = level_of(m, depth, most as f32);
        }
        let Some(values) = self.values.get_mut(place..place + stride) else {
            debug_assert!(false, "a block beyond the tile: {place}");
            return;
        };
        let mask = m.depth_mask(outside, depth, m.load(values).max(self.least));
        // Indexed on purpose. With `chunks_exact_mut` the rest of the crate decides if the compiler
        // unrolls this loop.
        for i in 0..self.count.get() {
            let place = &mut values[i * BLOCK..(i + 1) * BLOCK];
            let new = if i == 0 { depth } else { value(i) };
            m.store(m.select(mask, m.load(place), new), place);
        }
    }

    /// Writes one pixel, its depth and then its other values, at a place that [`Tile::places`]
    /// returned.
    #[inline(always)]
    pub fn put_one(&mut self, place: i32, pixel: &[f32]) {
        // Places are 0 or more. The cast to u32 tells the compiler, and one slice then bounds all
        // values.
        let (place, count) = (place as u32 as usize, self.count.get());
        let depth = self.test.kept(pixel[0]);
        let values = &mut self.values[place..place + (count - 1) * BLOCK + 1];
        let pixel = &pixel[..count];
        if !self.test.hides || depth < values[0] {
            values[0] = depth;
            for i in 1..count {
                values[i * BLOCK] = pixel[i];
            }
        }
    }
}
