//! Tiny triangles: a group of them at a time, pixel by pixel of their boxes. Where a triangle has a pixel or two, setting up
//! its rows is most of its cost; this way nothing is set up for one triangle alone.

use super::band::Layout;
use super::batch::{Batch, Kind, MOST, TINY_HEIGHT, TINY_WIDTH};
use super::facets::LINE;
use crate::number::{Int, Lanes, Num};

/// Pixels of a box.
const SLOTS: usize = (TINY_WIDTH * TINY_HEIGHT) as usize;
/// Pixels of a box that there is room for: one a bit.
const ROOM: usize = 32;
/// Pixels of the boxes of a batch.
const ALL: usize = MOST * ROOM;

/// The pixels that the tiny triangles of a batch cover.
#[derive(Debug)]
pub(crate) struct Fragments {
    /// Where each pixel of each box is in the band: group of triangles by group, by pixel, then by triangle.
    places: [i32; ALL],
    /// The barycentric coordinates of the second and the third corner there.
    weights: [[f32; ALL]; 2],
    /// Bit [`TINY_HEIGHT`] column + row: whether that pixel of the box is covered, for each triangle.
    covered: [i32; MOST],
}

impl Default for Fragments {
    fn default() -> Self {
        Fragments {
            places: [0; ALL],
            weights: [[0.0; ALL]; 2],
            covered: [0; MOST],
        }
    }
}

impl Fragments {
    /// Finds what the tiny triangles of a batch cover in a band that begins with row `top`. Gives which of them cover anything: bit k
    /// for triangle k.
    #[inline(always)]
    pub(super) fn find<M: Lanes>(
        &mut self,
        m: M,
        batch: &Batch,
        top: usize,
        layout: Layout,
    ) -> u32 {
        let (mut drawn, mut first) = (0, 0);
        while first < batch.count() {
            drawn |= self.find_group(m, batch, (first, top), layout) << first;
            first += M::WIDTH;
        }
        drawn
    }

    /// Finds what those cover of the group of triangles from number `first` on; bit k for triangle `first` + k.
    #[inline(always)]
    fn find_group<M: Lanes>(
        &mut self,
        m: M,
        batch: &Batch,
        (first, top): (usize, usize),
        layout: Layout,
    ) -> u32 {
        let one = m.int(1);
        let others = m
            .load_int(&batch.kind[first..])
            .less(m.int(Kind::Tiny as i32));
        if !m.any(m.not_negative(others)) {
            return 0;
        }
        let columns = [
            m.load_int(&batch.columns[0][first..]),
            m.load_int(&batch.columns[1][first..]),
        ];
        let rows = [
            m.load_int(&batch.rows[0][first..]),
            m.load_int(&batch.rows[1][first..]),
        ];
        // From the first pixel of the group to that of the box.
        let skipped = columns[0] & m.int(M::WIDTH as i32 - 1);
        let [a, b, c] = &batch.edges;
        let right = [
            m.load_int(&a.right[first..]),
            m.load_int(&b.right[first..]),
            m.load_int(&c.right[first..]),
        ];
        let down = [
            m.load_int(&a.down[first..]),
            m.load_int(&b.down[first..]),
            m.load_int(&c.down[first..]),
        ];
        let mut column = [
            m.load_int(&a.at[first..]) + skipped * right[0],
            m.load_int(&b.at[first..]) + skipped * right[1],
            m.load_int(&c.at[first..]) + skipped * right[2],
        ];
        let over_area = m.load(&batch.over_area[first..]);
        let back = [m.load(&b.off[first..]), m.load(&c.off[first..])];
        // Columns and rows that are left, less 1: below 0 outside the box. As many are looked at as the widest and the highest of
        // the triangles have, whether any covers a pixel there or not: that would often be guessed wrong.
        let (mut beside, all_below) = (
            (columns[1] - columns[0] - one) | others,
            (rows[1] - rows[0] - one) | others,
        );
        let (mut across_at, next_row) = (columns[0], layout.places(m, one, m.int(0)));
        let mut covered = m.int(0);
        let mut slot = 0;
        while slot < SLOTS && m.any(m.not_negative(beside)) {
            let (mut here, mut below) = (column, all_below);
            let mut place = layout.places(m, rows[0] - m.int(top as i32), across_at);
            let mut bit = m.int(1 << slot);
            let mut at = first * ROOM + slot * M::WIDTH;
            let mut row = 0;
            while row < TINY_HEIGHT && m.any(m.not_negative(below)) {
                let outside = here[0] | here[1] | here[2] | below | beside;
                covered = covered | (m.int(-1).less(outside) & bit);
                m.store_int(place, &mut self.places[at..]);
                let [to_b, to_c] = &mut self.weights;
                m.store(
                    m.number(here[1]).mul_add(over_area, back[0]),
                    &mut to_b[at..],
                );
                m.store(
                    m.number(here[2]).mul_add(over_area, back[1]),
                    &mut to_c[at..],
                );
                here = [here[0] + down[0], here[1] + down[1], here[2] + down[2]];
                (below, place, bit) = (below - one, place + next_row, bit + bit);
                (at, row) = (at + M::WIDTH, row + 1);
            }
            column = [
                column[0] + right[0],
                column[1] + right[1],
                column[2] + right[2],
            ];
            (beside, across_at) = (beside - one, across_at + one);
            slot += TINY_HEIGHT as usize;
        }
        m.store_int(covered, &mut self.covered[first..]);
        m.bits(m.not_negative(m.int(0).less(covered) ^ m.int(-1)))
    }

    /// The covered pixels of tiny triangle `k`, of which there must be one: their places, and the first `facets` numbers of the
    /// triangle there.
    #[inline(always)]
    pub fn each<M: Lanes>(
        &self,
        m: M,
        (batch, facets): (&Batch, usize),
        k: usize,
        mut visit: impl FnMut(i32, &[f32; LINE]),
    ) {
        let first = k / M::WIDTH * M::WIDTH * ROOM + k % M::WIDTH;
        let mut left = self.covered[k] as u32;
        loop {
            let at = (first + left.trailing_zeros() as usize * M::WIDTH) % ALL;
            let numbers = batch
                .facets
                .at(m, k, facets, [self.weights[0][at], self.weights[1][at]]);
            visit(self.places[at], &numbers);
            left &= left.wrapping_sub(1);
            if left == 0 {
                return;
            }
        }
    }
}
