//! Tiny triangles: eight at a time, in the lanes of a block, pixel by pixel of their boxes. If a
//! triangle covers a pixel or two, most of its cost is setting up its rows. Here nothing is set up
//! for a single triangle.

use super::small::grown;
use super::tile::{Tile, Writer};
use super::triangles::{BATCH, Batch, CoveragePath, Ints, bits};
use crate::frame::row_tiles::{TINY_HEIGHT, TINY_WIDTH};
use crate::number::lanes::{Int, Lanes};
use crate::number::simd::BLOCK;
use fearless_simd::{Simd, SimdFloat};

/// How many pixels a box has.
const SLOTS: usize = (TINY_WIDTH * TINY_HEIGHT) as usize;
/// How many pixels of a box there is room for: one per bit.
const ROOM: usize = 32;
/// How many pixels the boxes of a batch have room for.
const ALL: usize = BATCH * ROOM;

/// The pixels that the tiny triangles of a batch cover. Arrays are laid out as [group of eight
/// triangles][pixel of the box][triangle].
#[derive(Debug, Default)]
pub(crate) struct Fragments {
    /// Where each pixel is stored in the tile.
    places: [[i32; ROOM]; BATCH],
    /// The barycentric coordinates of the second and the third corner at each pixel.
    weights: [[[f32; ROOM]; BATCH]; 2],
    /// A mask for each triangle: bit [`TINY_HEIGHT`] · column + row is 1 if that pixel of the box
    /// is covered.
    covered: Ints,
}

impl Fragments {
    /// Finds the pixels that a batch's tiny triangles cover in a tile whose first row is `top`.
    /// Returns a bit for each triangle that covers any.
    #[inline(always)]
    pub fn find<S: Simd>(&mut self, m: Lanes<S>, batch: &Batch, top: usize, tile: &Tile) -> u32 {
        let (mut drawn, mut first) = (0, 0);
        while first < batch.count {
            drawn |= self.find_eight(m, batch, first, top, tile) << first;
            first += BLOCK;
        }
        drawn
    }

    /// Finds the pixels of eight triangles, from index `first` on.
    ///
    /// All eight boxes are scanned together, column by column and down each column, from the upper
    /// left corner of each box. A lane whose box is narrower or lower goes on outside of it, with
    /// its bits masked. Coordinates and places are stored for every pixel, covered or not: `draw`
    /// reads them by the bits of `covered`.
    #[inline(always)]
    fn find_eight<S: Simd>(
        &mut self,
        m: Lanes<S>,
        batch: &Batch,
        first: usize,
        top: usize,
        tile: &Tile,
    ) -> u32 {
        let one = m.int(1);
        let paths = m.load_int(&batch.path[first..]);
        // `Tiny` is the largest path, so every other one is less.
        let others = paths.less(m.int(CoveragePath::Tiny as i32));
        if !m.any_not_negative(others) {
            return 0;
        }
        let load = |from: &Ints| m.load_int(&from[first..]);
        let columns = [load(&batch.columns[0]), load(&batch.columns[1])];
        let rows = [load(&batch.rows[0]), load(&batch.rows[1])];
        // Edge functions start at the first pixel of a block. This is how far the box's first pixel
        // is from there.
        let skipped = columns[0] & m.int(BLOCK as i32 - 1);
        let [a, b, c] = &batch.edges;
        let right = [load(&a.right), load(&b.right), load(&c.right)];
        let down = [load(&a.down), load(&b.down), load(&c.down)];
        let mut column = [
            load(&a.at) + skipped * right[0],
            load(&b.at) + skipped * right[1],
            load(&c.at) + skipped * right[2],
        ];
        let over_area = m.load(&batch.over_area[first..]);
        let back = [m.load(&b.off[first..]), m.load(&c.off[first..])];
        // Columns and rows that are left in the box, less 1: below 0 outside of it. An or with −1
        // puts triangles that are not tiny outside from the start. The loops end with the widest
        // and the highest of the eight boxes. A branch on covered pixels would often be
        // mispredicted.
        let mut beside = (columns[1] - columns[0] - one) | others;
        let all_below = (rows[1] - rows[0] - one) | others;
        let (mut across_at, next_row) = (columns[0], tile.places(m, one, m.int(0)));
        let mut covered = m.int(0);
        let mut slot = 0;
        while slot < SLOTS && m.any_not_negative(beside) {
            let (mut here, mut below) = (column, all_below);
            let mut place = tile.places(m, rows[0] - m.int(top as i32), across_at);
            let mut bit = m.int(1 << slot);
            let mut at = first * ROOM + slot * BLOCK;
            let mut row = 0;
            while row < TINY_HEIGHT && m.any_not_negative(below) {
                let outside = here[0] | here[1] | here[2] | below | beside;
                // Five signs in one comparison: an or is below 0 where any of its terms is.
                covered |= m.int(-1).less(outside) & bit;
                m.store_int(place, &mut self.places.as_flattened_mut()[at..]);
                let [to_b, to_c] = &mut self.weights;
                let b = m.float(here[1]).mul_add(over_area, back[0]);
                let c = m.float(here[2]).mul_add(over_area, back[1]);
                m.store(b, &mut to_b.as_flattened_mut()[at..]);
                m.store(c, &mut to_c.as_flattened_mut()[at..]);
                here = grown(here, down);
                (below, place, bit) = (below - one, place + next_row, bit + bit);
                (at, row) = (at + BLOCK, row + 1);
            }
            column = grown(column, right);
            (beside, across_at) = (beside - one, across_at + one);
            slot += TINY_HEIGHT as usize;
        }
        m.store_int(covered, &mut self.covered[first..]);
        // `bits_not_negative(covered)` would also report the lanes without a pixel, where `covered`
        // is 0.
        m.bits_not_negative(m.int(0).less(covered) ^ m.int(-1))
    }

    /// Draws the covered pixels of tiny triangle `k`.
    #[inline(always)]
    pub fn draw<S: Simd, const N: usize>(
        &self,
        m: Lanes<S>,
        batch: &Batch,
        k: usize,
        writer: &mut Writer<'_, S, N>,
    ) {
        let first = k / BLOCK * BLOCK * ROOM + k % BLOCK;
        for pixel in bits(self.covered[k] as u32) {
            // The remainder changes nothing. It shows the compiler that the index is in bounds.
            let at = (first + pixel * BLOCK) % ALL;
            let weights = self.weights.each_ref().map(|to| to.as_flattened()[at]);
            let values = batch.planes.at(m, k, writer.count.get(), weights);
            writer.put_one(self.places.as_flattened()[at], &values);
        }
    }
}
