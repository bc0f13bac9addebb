//! Tiny triangles: a group of them at a time, pixel by pixel of their boxes. Where a triangle has a pixel or two, setting up
//! its rows is most of its cost; this way nothing is set up for one triangle alone.

use super::band::{Cells, MOST_PLANES};
use super::batch::{Batch, Kind, TINY};
use crate::number::{Int, Lanes, Num, Planes};

/// Pixels of a box.
const SLOTS: usize = (TINY * TINY) as usize;

/// The pixels that a group of tiny triangles covers.
#[derive(Debug)]
pub(crate) struct Fragments {
    /// Bit `TINY` row + column: whether that pixel of the box is covered, for each triangle.
    covered: [i32; 8],
    /// Where that pixel is in the band, by pixel, then by triangle.
    places: [i32; SLOTS * 8],
    /// Depth and planes, by pixel of the box, then by number, then by triangle.
    values: [f32; SLOTS * (1 + MOST_PLANES) * 8],
}

impl Default for Fragments {
    fn default() -> Self {
        Fragments { covered: [0; 8], places: [0; SLOTS * 8], values: [0.0; SLOTS * (1 + MOST_PLANES) * 8] }
    }
}

impl Fragments {
    /// Finds what the tiny ones cover of the group of triangles from number `first` on in a band that begins with row `top`, and
    /// the `facets` numbers there.
    #[inline(always)]
    pub fn find<M: Lanes, P: Planes<M::F>>(
        &mut self,
        m: M,
        batch: &Batch,
        (first, facets): (usize, usize),
        top: usize,
        cells: &Cells<'_, M, P>,
    ) {
        let one = m.int(1);
        let others = m.load_int(&batch.kind[first..]).less(m.int(Kind::Tiny as i32));
        if !m.any(m.not_negative(others)) {
            return;
        }
        let columns = [m.load_int(&batch.columns[0][first..]), m.load_int(&batch.columns[1][first..])];
        let rows = [m.load_int(&batch.rows[0][first..]), m.load_int(&batch.rows[1][first..])];
        // From the first pixel of the group to that of the box.
        let skipped = columns[0] & m.int(M::WIDTH as i32 - 1);
        let [a, b, c] = &batch.edges;
        let right = [m.load_int(&a.right[first..]), m.load_int(&b.right[first..]), m.load_int(&c.right[first..])];
        let down = [m.load_int(&a.down[first..]), m.load_int(&b.down[first..]), m.load_int(&c.down[first..])];
        let mut row = [
            m.load_int(&a.at[first..]) + skipped * right[0],
            m.load_int(&b.at[first..]) + skipped * right[1],
            m.load_int(&c.at[first..]) + skipped * right[2],
        ];
        let over_area = m.load(&batch.over_area[first..]);
        let back = [m.load(&b.off[first..]), m.load(&c.off[first..])];
        // Rows and columns that are left, less 1: below 0 outside the box.
        let mut below = (rows[1] - rows[0] - one) | others;
        let mut down_at = rows[0] - m.int(top as i32);
        let mut covered = m.int(0);
        let mut slot = 0;
        while slot < SLOTS && m.any(m.not_negative(below)) {
            let mut here = row;
            let (mut beside, mut across_at) = (columns[1] - columns[0] - one, columns[0]);
            let mut column = 0;
            while column < TINY as usize {
                let outside = here[0] | here[1] | here[2] | below | beside;
                if m.any(m.not_negative(outside)) {
                    covered = covered | (m.int(-1).less(outside) & m.int(1 << (slot + column)));
                    m.store_int(cells.places(m, down_at, across_at), &mut self.places[(slot + column) * M::WIDTH..]);
                    let weights =
                        [m.number(here[1]).mul_add(over_area, back[0]), m.number(here[2]).mul_add(over_area, back[1])];
                    self.interpolate(m, batch, (first, facets), slot + column, weights);
                }
                here = [here[0] + right[0], here[1] + right[1], here[2] + right[2]];
                (beside, across_at) = (beside - one, across_at + one);
                column += 1;
            }
            row = [row[0] + down[0], row[1] + down[1], row[2] + down[2]];
            (below, down_at) = (below - one, down_at + one);
            slot += TINY as usize;
        }
        m.store_int(covered, &mut self.covered);
    }

    /// The numbers of a group of triangles at pixel `slot` of their boxes, with these barycentric coordinates there.
    #[inline(always)]
    fn interpolate<M: Lanes>(
        &mut self,
        m: M,
        batch: &Batch,
        (first, facets): (usize, usize),
        slot: usize,
        [b, c]: [M::F; 2],
    ) {
        let mut at = slot * facets * M::WIDTH;
        for facet in &batch.facets[..facets] {
            let [from, to_b, to_c] = [&facet.at, &facet.to[0], &facet.to[1]];
            let value = m.load(&to_b[first..]).mul_add(b, m.load(&from[first..]));
            m.store(m.load(&to_c[first..]).mul_add(c, value), &mut self.values[at..]);
            at += M::WIDTH;
        }
    }

    /// The covered pixels of tiny triangle `k` of the group that was last looked at: their places, and the numbers there, each a
    /// group's width from the one before.
    #[inline(always)]
    pub fn each<M: Lanes>(&self, k: usize, facets: usize, mut visit: impl FnMut(i32, &[f32])) {
        let k = k % M::WIDTH;
        let mut left = self.covered[k] as u32;
        while left != 0 {
            let slot = left.trailing_zeros() as usize % 32;
            left &= left - 1;
            visit(self.places[slot * M::WIDTH + k], &self.values[slot * facets * M::WIDTH + k..]);
        }
    }
}
