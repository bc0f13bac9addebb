//! Which pixels a triangle covers, and where they lie in it: by edge functions where it is small, by crossings where it is
//! large, which is the same rule bit for bit. It does not know what is drawn.

use super::batch::Small;
use crate::frame::SubPixel;
use crate::number::{Lanes, Num, each};
use crate::raster::edge::{Crossing, first_centre};
use core::ops::Range;

/// A small triangle as groups of pixels, row by row. The last group of a row may reach over the edge of the picture, where a
/// band has room for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Groups<M: Lanes> {
    /// The groups of a row between which it lies.
    pub groups: [usize; 2],
    /// Its edge functions in the first group of the row.
    row: [M::I; 3],
    /// Their growth from group to group.
    across: [M::I; 3],
    down: [M::I; 3],
    over_area: M::F,
    /// What was taken off the functions for ownership, given back: the coordinates are those of the centre itself.
    back: [M::F; 2],
}

impl<M: Lanes> Groups<M> {
    #[inline(always)]
    pub fn new(m: M, small: &Small<'_>) -> Self {
        let [first, end] = small.columns();
        Groups {
            groups: [first / M::WIDTH, end.div_ceil(M::WIDTH)],
            row: each(
                #[inline(always)]
                |i| m.int(small.at(i)) + m.counted() * m.int(small.right(i)),
            ),
            across: each(
                #[inline(always)]
                |i| m.int(small.across(i)),
            ),
            down: each(
                #[inline(always)]
                |i| m.int(small.down(i)),
            ),
            over_area: m.splat(small.over_area()),
            back: [m.splat(small.off(1)), m.splat(small.off(2))],
        }
    }

    /// The functions of the first group of this row; to the next one.
    #[inline(always)]
    pub fn next_row(&mut self) -> [M::I; 3] {
        let here = self.row;
        self.row = each(
            #[inline(always)]
            |i| here[i] + self.down[i],
        );
        here
    }

    /// The functions of the group beside.
    #[inline(always)]
    pub fn beside(&self, here: [M::I; 3]) -> [M::I; 3] {
        each(
            #[inline(always)]
            |i| here[i] + self.across[i],
        )
    }

    /// Which pixels are covered.
    #[inline(always)]
    pub fn inside(m: M, [a, b, c]: [M::I; 3]) -> M::Mask {
        m.not_negative(a | b | c)
    }

    /// The barycentric coordinates of the second and the third corner.
    #[inline(always)]
    pub fn weights(&self, m: M, [_, b, c]: [M::I; 3]) -> [M::F; 2] {
        [m.number(b).mul_add(self.over_area, self.back[0]), m.number(c).mul_add(self.over_area, self.back[1])]
    }
}

impl Small<'_> {
    /// Its pixels row by row: the row in the band that begins with row `top`, the pixels, and the barycentric coordinates of
    /// the second and the third corner at the first of them.
    #[inline(always)]
    pub fn runs<M: Lanes>(&self, m: M, top: usize, mut visit: impl FnMut(usize, Range<usize>, [f32; 2])) {
        let mut groups = Groups::new(m, self);
        let [first, end] = groups.groups;
        let (mut b, mut c) = (self.at(1), self.at(2));
        // Those of its last group that lie beyond the picture are none of it.
        let within = !(!0u64 << (self.columns()[1] - first * M::WIDTH));
        for row in self.rows(top) {
            let mut here = groups.next_row();
            // At most 62 pixels, a bit each.
            let mut inside = 0u64;
            for group in 0..end - first {
                inside |= u64::from(m.bits(Groups::inside(m, here))) << (group * M::WIDTH);
                here = groups.beside(here);
            }
            inside &= within;
            if inside != 0 {
                let skipped = inside.trailing_zeros();
                let weight =
                    |at: i32, edge| (at + skipped as i32 * self.right(edge)) as f32 * self.over_area() + self.off(edge);
                let start = first * M::WIDTH + skipped as usize;
                let pixels = start..start + (64 - (inside >> skipped).leading_zeros()) as usize;
                visit(row, pixels, [weight(b, 1), weight(c, 2)]);
            }
            (b, c) = (b + self.down(1), c + self.down(2));
        }
    }

    /// How much the barycentric coordinates of the second and the third corner grow from pixel to pixel.
    #[inline(always)]
    pub fn growth(&self) -> [f32; 2] {
        [self.right(1) as f32 * self.over_area(), self.right(2) as f32 * self.over_area()]
    }
}

/// A triangle of any size.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    /// Its corners, in the order in which its area is over 0.
    pub corners: [usize; 3],
    pub columns: Range<i32>,
    rows: Range<i32>,
    x: [i32; 3],
    y: [i32; 3],
    over_area: f32,
}

impl Triangle {
    /// The triangle with these corners, x and y each in sub-pixels, on these pixels; `None` if it has no area.
    pub fn new(corners: [u32; 3], places: [[i32; 2]; 3], columns: Range<i32>, rows: Range<i32>) -> Option<Triangle> {
        let [[xa, ya], [xb, yb], [xc, yc]] = places;
        let wide = i64::from;
        let area = wide(xb - xa) * wide(yc - ya) - wide(xc - xa) * wide(yb - ya);
        let over_area = 1.0 / area.abs() as f32;
        let [a, b, c] = corners.map(|corner| corner as usize);
        let (corners, x, y) = match area {
            0 => return None,
            1.. => ([a, b, c], [xa, xb, xc], [ya, yb, yc]),
            _ => ([a, c, b], [xa, xc, xb], [ya, yc, yb]),
        };
        Some(Triangle { corners, columns, rows, x, y, over_area })
    }

    /// How much the barycentric coordinates of the second and the third corner grow from pixel to pixel.
    #[inline(always)]
    pub fn across(&self) -> [f32; 2] {
        let (y, scale) = (&self.y, 256.0 * self.over_area);
        [(y[2] - y[0]) as f32 * scale, (y[0] - y[1]) as f32 * scale]
    }

    /// Its pixels as [`Small::runs`] gives them, by the crossings of its edges with the scanlines, in exact integers.
    #[inline(always)]
    pub fn runs(&self, band: usize, mut visit: impl FnMut(usize, Range<usize>, [f32; 2])) {
        let Triangle { x, y, columns, rows, .. } = self;
        // From the top corner two edges go down; the third one follows one of them.
        let mut order = [0usize, 1, 2];
        order.sort_unstable_by_key(|&i| y[i]);
        let [top, middle, bottom] = order.map(|i| [x[i], y[i]].map(SubPixel::from_bits));
        let bend = first_centre(middle[1]).clamp(rows.start, rows.end);
        let mut long = Crossing::new(top, bottom, rows.start);
        let function = |i: usize, j: usize, column: i32, row: i32| {
            let wide = i64::from;
            let (px, py) = (256 * wide(column) + 128, 256 * wide(row) + 128);
            wide(x[j] - x[i]) * (py - wide(y[i])) - wide(y[j] - y[i]) * (px - wide(x[i]))
        };
        for (from, to, rows) in [(top, middle, rows.start..bend), (middle, bottom, bend..rows.end)] {
            if rows.is_empty() {
                continue;
            }
            let mut short = Crossing::new(from, to, rows.start);
            for row in rows {
                let (p, q) = (long.pixel(), short.pixel());
                let (start, end) = (p.min(q).max(columns.start), p.max(q).min(columns.end));
                if start < end {
                    let weight = |i: usize, j: usize| function(i, j, start, row) as f32 * self.over_area;
                    visit(row as usize - band, start as usize..end as usize, [weight(2, 0), weight(0, 1)]);
                }
                long.advance();
                short.advance();
            }
        }
    }
}

#[cfg(test)]
mod tests;
