//! The triangles of a batch on the pixels of a band: bounds, edge functions, a group of triangles at a time.

use super::batch::{Batch, Kind, SMALL_HEIGHT, SMALL_WIDTH, STEEPEST, TINY_HEIGHT, TINY_WIDTH};
use crate::number::{Int, Lanes, Num, each};
use core::ops::Range;

/// What a group of triangles has in common with pixels.
struct Placed<M: Lanes> {
    /// Corners from the left upper corner of the box on: small numbers, and 0 where 32 bits might not hold what follows.
    x: [M::I; 3],
    y: [M::I; 3],
    /// The centre of the first pixel of the first group of the first row, likewise.
    px: M::I,
    py: M::I,
    /// −1 where the corners run the other way around.
    turned: M::I,
    over_area: M::F,
    /// Its columns: no columns where nothing is to be drawn.
    columns: [M::I; 2],
    /// Whether any is small.
    has_small: bool,
}

impl Batch {
    /// Bounds what was read by a picture `width` pixels wide and the rows `band`, and sets up the edge functions of small triangles.
    /// With `has_tiny`, tiny triangles are told apart. Gives the groups of pixels of a row between which the triangles lie.
    #[inline(always)]
    pub fn place<M: Lanes>(
        &mut self,
        m: M,
        width: usize,
        band: &Range<usize>,
        has_tiny: bool,
    ) -> Range<usize> {
        let (mut left, mut right) = (m.int(width as i32), m.int(0));
        self.others = 0;
        let mut first = 0;
        while first < self.count() {
            let placed = self.bound(
                m,
                first,
                width as i32,
                [band.start as i32, band.end as i32],
                has_tiny,
            );
            left = left.min(placed.columns[0]);
            right = right.max(placed.columns[1]);
            let mut edge = 0;
            while edge < 3 {
                self.edge(m, first, edge, &placed);
                edge += 1;
            }
            first += M::WIDTH;
        }
        let (mut lefts, mut rights) = ([width as i32; 8], [0; 8]);
        m.store_int(left, &mut lefts);
        m.store_int(right, &mut rights);
        let (mut left, mut right) = (width as i32, 0);
        for lane in 0..M::WIDTH {
            (left, right) = (Ord::min(left, lefts[lane]), Ord::max(right, rights[lane]));
        }
        left as usize / M::WIDTH..(right as usize).div_ceil(M::WIDTH)
    }

    /// Bounds the group of triangles from number `first` on, and says what is to be drawn of each.
    #[inline(always)]
    fn bound<M: Lanes>(
        &mut self,
        m: M,
        first: usize,
        width: i32,
        band: [i32; 2],
        has_tiny: bool,
    ) -> Placed<M> {
        let (zero, all) = (m.int(0), m.int(-1));
        let x: [M::I; 3] = each(
            #[inline(always)]
            |i| m.load_int(&self.x[i][first..]),
        );
        let y: [M::I; 3] = each(
            #[inline(always)]
            |i| m.load_int(&self.y[i][first..]),
        );
        let (left, right) = (x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2]));
        let (top, bottom) = (y[0].min(y[1]).min(y[2]), y[0].max(y[1]).max(y[2]));
        let centre = |at: M::I| (at + m.int(127)).whole_pixels();
        let columns = [centre(left).max(zero), centre(right).min(m.int(width))];
        let rows = [
            centre(top).max(m.int(band[0])),
            centre(bottom).min(m.int(band[1])),
        ];
        // What stands after the last one was there before.
        let is_read = m.counted().less(m.int((self.count() - first) as i32));
        let is_there = columns[0].less(columns[1]) & rows[0].less(rows[1]) & is_read;
        let is_small = (right - left).less(m.int(256 * SMALL_WIDTH + 1))
            & (bottom - top).less(m.int(256 * SMALL_HEIGHT));
        let exact = is_there & is_small;
        let x: [M::I; 3] = each(
            #[inline(always)]
            |i| (x[i] - left) & exact,
        );
        let y: [M::I; 3] = each(
            #[inline(always)]
            |i| (y[i] - top) & exact,
        );
        let area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        let turned = area.less(zero);
        let area = (area ^ turned) - turned;
        let over_area = m.splat(1.0) / m.number(area);
        let drawn = exact & zero.less(area);
        let mut tiny = zero;
        if has_tiny {
            tiny = drawn
                & (columns[1] - columns[0]).less(m.int(TINY_WIDTH + 1))
                & (rows[1] - rows[0]).less(m.int(TINY_HEIGHT + 1));
        }
        // No edge is higher or wider than the box: coordinates grow by at most 256 times that over twice the area.
        let longer = (right - left).max(bottom - top) & exact;
        let steep = drawn & area.less(longer * m.int(256 / STEEPEST)) & (tiny ^ all);
        let small = drawn & (steep ^ all);
        let large = is_there & ((is_small ^ all) | steep);
        let kind = (small & m.int(Kind::Small as i32))
            | (tiny & m.int(Kind::Tiny as i32))
            | (large & m.int(Kind::Large as i32));
        let not_small = (small & (tiny ^ all)) ^ all;
        let has_small = m.any(m.not_negative(not_small));
        self.others |= m.bits(m.not_negative(not_small & (large ^ all))) << first;
        m.store_int(kind, &mut self.kind[first..]);
        m.store(over_area, &mut self.over_area[first..]);
        for end in 0..2 {
            m.store_int(columns[end], &mut self.columns[end][first..]);
            m.store_int(rows[end], &mut self.rows[end][first..]);
        }
        let group = columns[0] & m.int(-(M::WIDTH as i32));
        let px = (group * m.int(256) + m.int(128) - left) & exact;
        let py = (rows[0] * m.int(256) + m.int(128) - top) & exact;
        let columns = [
            M::I::choose(is_there, columns[0], m.int(width)),
            columns[1] & is_there,
        ];
        Placed {
            x,
            y,
            px,
            py,
            turned,
            over_area,
            columns,
            has_small,
        }
    }

    /// Sets up edge function `edge`, which is 0 at the two other corners.
    #[inline(always)]
    fn edge<M: Lanes>(&mut self, m: M, first: usize, edge: usize, placed: &Placed<M>) {
        let Placed {
            x,
            y,
            px,
            py,
            turned,
            over_area,
            ..
        } = placed;
        let (zero, none) = (m.int(0), m.splat(0.0));
        let (i, j) = ((edge + 1) % 3, (edge + 2) % 3);
        let [dx, dy] = [
            ((x[j] - x[i]) ^ *turned) - *turned,
            ((y[j] - y[i]) ^ *turned) - *turned,
        ];
        let level = (dy.less(zero) | zero.less(dy)) ^ m.int(-1);
        let disowns = m.int(1) + (dy.less(zero) | (level & zero.less(dx)));
        let to = &mut self.edges[edge];
        let (at, right, down) = (
            dx * (*py - y[i]) - dy * (*px - x[i]) - disowns,
            dy * m.int(-256),
            dx * m.int(256),
        );
        let off = m.number(disowns) * *over_area;
        m.store_int(at, &mut to.at[first..]);
        m.store_int(right, &mut to.right[first..]);
        m.store_int(down, &mut to.down[first..]);
        m.store(off, &mut to.off[first..]);
        if !placed.has_small {
            return;
        }
        if edge != 0 {
            m.store(
                m.number(at).mul_add(*over_area, off),
                &mut to.weight[first..],
            );
            m.store(m.number(right) * *over_area, &mut to.growth[first..]);
            m.store(m.number(down) * *over_area, &mut to.fall[first..]);
        }
        m.store_int(dy * m.int(-256 * M::WIDTH as i32), &mut to.across[first..]);
        let grows = m.less(none, m.number(right));
        let falls = m.less(m.number(right), none);
        let columns = m.splat(-1.0) / m.number(right);
        m.store(m.blend(grows, columns, none), &mut to.begins[first..]);
        m.store(m.blend(falls, columns, none), &mut to.ends[0][first..]);
        m.store(
            m.blend(falls, none, m.splat(2.0 * SMALL_WIDTH as f32)),
            &mut to.ends[1][first..],
        );
    }
}
