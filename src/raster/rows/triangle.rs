//! Which pixels a triangle covers, and where they lie in it: by edge functions where it is small, by crossings where it is
//! large, which is the same rule bit for bit. It does not know what is drawn.

use super::band::MOST_PLANES;
use super::batch::Small;
use crate::frame::SubPixel;
use crate::number::{self, Lanes, Num, each};
use crate::raster::edge::{Crossing, first_centre};
use core::ops::Range;

/// A small triangle as groups of pixels, row by row. The last group of a row may reach over the edge of the picture, where a
/// band has room for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Groups<M: Lanes> {
    /// The groups of a row between which it lies.
    pub groups: [usize; 2],
    /// How much its edge functions grow to each pixel of a group, from group to group, and from row to row.
    ramp: [M::I; 3],
    across: [M::I; 3],
    down: [M::I; 3],
    over_area: M::F,
    /// What was taken off the functions for ownership, given back: the coordinates are those of the centre itself.
    back: [M::F; 2],
}

/// A row of a small triangle.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// Its number in the band.
    pub row: usize,
    /// The groups between which it has pixels: none where the end is not over the start.
    pub groups: Range<usize>,
    /// The same as numbers of the band: the first, and the one after the last.
    pub numbers: [i32; 2],
    /// Its place in the values of [`Starts`].
    pub of_eight: usize,
}

/// What eight rows of a small triangle begin with, by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Starts {
    groups: [[i32; 8]; 2],
    numbers: [[i32; 8]; 2],
    functions: [[i32; 8]; 3],
    /// The numbers that are interpolated, at the first pixel of the first group.
    pub values: [[f32; 8]; 1 + MOST_PLANES],
}

impl<M: Lanes> Groups<M> {
    #[inline(always)]
    pub fn new(m: M, small: &Small<'_>) -> Self {
        let [first, end] = small.columns();
        Groups {
            groups: [first / M::WIDTH, end.div_ceil(M::WIDTH)],
            ramp: each(
                #[inline(always)]
                |i| m.counted() * m.int(small.right(i)),
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

    /// Gives `visit` each row of the band that begins with row `top`, and the `count` values that it begins with: `values` at its
    /// first pixel, of the barycentric coordinates there. A band has `a_row` numbers a row and `a_group` numbers a group.
    ///
    /// As many rows at a time as groups have pixels. Rows past the last are computed and not given: there 32 bits need not hold the
    /// results.
    #[inline(always)]
    pub fn rows(
        &self,
        m: M,
        (small, top): (&Small<'_>, usize),
        [a_row, a_group]: [usize; 2],
        starts: &mut Starts,
        (count, values): (usize, impl Fn(usize, [M::F; 2]) -> M::F),
        mut visit: impl FnMut(Line, &Starts),
    ) {
        let rows = small.rows(top);
        let [first, _] = self.groups;
        let mut row = rows.start;
        while row < rows.end {
            let number = m.counted() + m.int((row - rows.start) as i32);
            let mut start: [M::I; 3] = each(
                #[inline(always)]
                |i| m.int(small.at(i)) + number * self.down[i],
            );
            let [from, to] = self.between(m, small, start);
            m.store_int(from + m.int(first as i32), &mut starts.groups[0]);
            m.store_int(to + m.int(first as i32), &mut starts.groups[1]);
            let before =
                m.int((row * a_row + first * a_group) as i32) + m.counted() * m.int(a_row as i32);
            m.store_int(
                before + from * m.int(a_group as i32),
                &mut starts.numbers[0],
            );
            let end = number::Int::max(before + to * m.int(a_group as i32), m.int(0));
            m.store_int(end, &mut starts.numbers[1]);
            let mut i = 0;
            while i < 3 {
                start[i] = start[i] + from * self.across[i];
                m.store_int(start[i], &mut starts.functions[i]);
                i += 1;
            }
            let weights = self.weights(m, start);
            let mut i = 0;
            while i < count {
                m.store(values(i, weights), &mut starts.values[i]);
                i += 1;
            }
            let rows_here = M::WIDTH.min(rows.end - row);
            for k in 0..rows_here {
                let line = Line {
                    row: row + k,
                    groups: starts.groups[0][k] as usize..Ord::max(starts.groups[1][k], 0) as usize,
                    numbers: [starts.numbers[0][k], starts.numbers[1][k]],
                    of_eight: k,
                };
                visit(line, starts);
            }
            row += rows_here;
        }
    }

    /// The groups of rows, counted from the first, between which all functions are over 0, which are `start` at the rows' first pixels.
    ///
    /// Where a function becomes 0 is off by three roundings: with at most 62 columns by less than 2⁻¹⁶ of one. A group more is looked
    /// at where that could matter.
    #[inline(always)]
    fn between(&self, m: M, small: &Small<'_>, start: [M::I; 3]) -> [M::I; 2] {
        let [first, end] = self.groups;
        let groups = 1.0 / M::WIDTH as f32;
        let doubt = m.splat(groups / 1024.0);
        let (mut from, mut to) = (m.splat(0.0), m.splat(((end - first) * M::WIDTH - 1) as f32));
        let mut i = 0;
        while i < 3 {
            let ([begins, ends, beyond], here) = (small.limits(i), m.number(start[i]));
            from = from.max(here * m.splat(begins));
            to = to.min(here.mul_add(m.splat(ends), m.splat(beyond)));
            i += 1;
        }
        let groups = m.splat(groups);
        [
            m.truncated(from.mul_add(groups, -doubt)),
            m.truncated(to.mul_add(groups, doubt)) + m.int(1),
        ]
    }

    /// The functions in the first group of a row.
    #[inline(always)]
    pub fn of_line(&self, m: M, starts: &Starts, line: &Line) -> [M::I; 3] {
        each(
            #[inline(always)]
            |i| m.int(starts.functions[i][line.of_eight]) + self.ramp[i],
        )
    }

    /// The functions in the first group of the first row.
    #[inline(always)]
    pub fn first(&self, m: M, small: &Small<'_>) -> [M::I; 3] {
        each(
            #[inline(always)]
            |i| m.int(small.at(i)) + self.ramp[i],
        )
    }

    /// The functions of the group beside.
    #[inline(always)]
    pub fn beside(&self, here: [M::I; 3]) -> [M::I; 3] {
        each(
            #[inline(always)]
            |i| here[i] + self.across[i],
        )
    }

    /// The functions of the group below.
    #[inline(always)]
    pub fn below(&self, here: [M::I; 3]) -> [M::I; 3] {
        each(
            #[inline(always)]
            |i| here[i] + self.down[i],
        )
    }

    /// Below 0 at pixels that are not covered.
    #[inline(always)]
    pub fn outside([a, b, c]: [M::I; 3]) -> M::I {
        a | b | c
    }

    /// The barycentric coordinates of the second and the third corner.
    #[inline(always)]
    pub fn weights(&self, m: M, [_, b, c]: [M::I; 3]) -> [M::F; 2] {
        [
            m.number(b).mul_add(self.over_area, self.back[0]),
            m.number(c).mul_add(self.over_area, self.back[1]),
        ]
    }
}

impl Small<'_> {
    /// Its pixels row by row: the row in the band that begins with row `top`, the pixels, and the barycentric coordinates of
    /// the second and the third corner at the first of them.
    #[inline(always)]
    pub fn runs<M: Lanes>(
        &self,
        m: M,
        top: usize,
        mut visit: impl FnMut(usize, Range<usize>, [f32; 2]),
    ) {
        let (groups, columns, rows) = (Groups::new(m, self), self.columns(), self.rows(top));
        let first = groups.groups[0] * M::WIDTH;
        groups.rows(
            m,
            (self, top),
            [0, 0],
            &mut Starts::default(),
            (
                0,
                #[inline(always)]
                |_, weights| weights[0],
            ),
            #[inline(always)]
            |line, starts| {
                let (
                    mut here,
                    Line {
                        row, groups: range, ..
                    },
                ) = (groups.of_line(m, starts, &line), line);
                // At most 62 pixels, a bit each.
                let mut inside = 0u64;
                for group in range {
                    inside |= u64::from(m.bits(m.not_negative(Groups::<M>::outside(here))))
                        << (group * M::WIDTH - first);
                    here = groups.beside(here);
                }
                // Those of its last group that lie beyond the picture are none of it.
                inside &= !(!0u64 << (columns[1] - first));
                if inside != 0 {
                    let skipped = inside.trailing_zeros();
                    let weight = |edge| {
                        let at = self.at(edge) + (row - rows.start) as i32 * self.down(edge);
                        (at + skipped as i32 * self.right(edge)) as f32 * self.over_area()
                            + self.off(edge)
                    };
                    let start = first + skipped as usize;
                    let pixels = start..start + (64 - (inside >> skipped).leading_zeros()) as usize;
                    visit(row, pixels, [weight(1), weight(2)]);
                }
            },
        );
    }
}

/// A triangle of any size.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    pub columns: Range<i32>,
    rows: Range<i32>,
    x: [i32; 3],
    y: [i32; 3],
    /// One over twice its area, below 0 where its corners run the other way around.
    over_area: f32,
}

impl Triangle {
    /// The triangle with these corners, x and y each in sub-pixels, on these pixels; `None` if it has no area.
    pub fn new(places: [[i32; 2]; 3], columns: Range<i32>, rows: Range<i32>) -> Option<Triangle> {
        let [[xa, ya], [xb, yb], [xc, yc]] = places;
        let wide = i64::from;
        let area = wide(xb - xa) * wide(yc - ya) - wide(xc - xa) * wide(yb - ya);
        let (x, y, over_area) = ([xa, xb, xc], [ya, yb, yc], 1.0 / area as f32);
        (area != 0).then_some(Triangle {
            columns,
            rows,
            x,
            y,
            over_area,
        })
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
        let Triangle {
            x,
            y,
            columns,
            rows,
            ..
        } = self;
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
        for (from, to, rows) in [
            (top, middle, rows.start..bend),
            (middle, bottom, bend..rows.end),
        ] {
            if rows.is_empty() {
                continue;
            }
            let mut short = Crossing::new(from, to, rows.start);
            for row in rows {
                let (p, q) = (long.pixel(), short.pixel());
                let (start, end) = (p.min(q).max(columns.start), p.max(q).min(columns.end));
                if start < end {
                    let weight =
                        |i: usize, j: usize| function(i, j, start, row) as f32 * self.over_area;
                    visit(
                        row as usize - band,
                        start as usize..end as usize,
                        [weight(2, 0), weight(0, 1)],
                    );
                }
                long.advance();
                short.advance();
            }
        }
    }
}

#[cfg(test)]
mod tests;
