//! Many triangles at a time: read, bounded, and their edge functions set up, a group of triangles where pixels come in groups.

use super::triangle::Triangle;
use crate::frame::Frame;
use crate::number::{Int, Lanes, each};
use core::ops::Range;

/// This many triangles are read before they are drawn.
const MOST: usize = 32;
/// Up to this many pixels wide coverage comes from edge functions over the bounding box: beyond, more groups of pixels are
/// looked at in vain than it takes to find the limits of each row.
pub(super) const SMALL_WIDTH: i32 = 48;
/// And up to this many pixels high. 32 bits hold the functions: groups begin up to 7 pixels left of the box and end as far
/// right of it, so that none is over 2 · 62 · 64 · 2¹⁶ < 2²⁹.
pub(super) const SMALL_HEIGHT: i32 = 64;

/// Whole numbers, one for each triangle.
type All = [i32; MOST];

/// Triangles, as they are read and as they are set up.
#[derive(Debug)]
pub(crate) struct Batch {
    count: usize,
    number: [u32; MOST],
    material: [u32; MOST],
    corners: [[u32; 3]; MOST],
    /// Columns and rows of the corners in sub-pixels.
    x: [All; 3],
    y: [All; 3],
    /// The pixels whose centres the bounding boxes hold, of the band: first column and the one after the last, rows.
    columns: [All; 2],
    rows: [All; 2],
    /// What is to be drawn: see [`Kind`].
    kind: All,
    /// −1 where the second and the third corner change places, so that the area is over 0.
    swapped: All,
    over_area: [f32; MOST],
    edges: [Functions; 3],
}

/// An edge function of each triangle, over 0 inside, in sub-pixels²: at the centre of the first pixel of the first group of the
/// first row, less 1 for right and bottom edges, which do not own the centres that lie on them; how much it grows from column
/// to column, from group to group, and from row to row; and what was taken off, over the area.
#[derive(Debug)]
struct Functions {
    at: All,
    right: All,
    across: All,
    down: All,
    off: [f32; MOST],
}

/// What of a triangle is to be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Nothing = 0,
    /// By edge functions.
    Small = 1,
    /// By crossings: it is large, or not known to be small.
    Large = 2,
}

/// A small triangle of a batch. Its numbers are read where they are needed, straight into all pixels of a group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Small<'a>(&'a Batch, usize);

impl Small<'_> {
    /// Its columns: the first one and that after the last.
    #[inline(always)]
    pub fn columns(&self) -> [usize; 2] {
        [self.0.columns[0][self.1] as usize, self.0.columns[1][self.1] as usize]
    }

    /// Its rows in the band that begins with row `top`.
    #[inline(always)]
    pub fn rows(&self, top: usize) -> Range<usize> {
        self.0.rows[0][self.1] as usize - top..self.0.rows[1][self.1] as usize - top
    }

    /// One over twice its area, in 1 / sub-pixels².
    #[inline(always)]
    pub fn over_area(&self) -> f32 {
        self.0.over_area[self.1]
    }

    /// Edge function `edge` at the centre of the first pixel of the first group of the first row, less 1 for edges that do not
    /// own the centres that lie on them.
    #[inline(always)]
    pub fn at(&self, edge: usize) -> i32 {
        self.0.edges[edge].at[self.1]
    }

    /// Its growth from column to column.
    #[inline(always)]
    pub fn right(&self, edge: usize) -> i32 {
        self.0.edges[edge].right[self.1]
    }

    /// Its growth from group to group.
    #[inline(always)]
    pub fn across(&self, edge: usize) -> i32 {
        self.0.edges[edge].across[self.1]
    }

    /// Its growth from row to row.
    #[inline(always)]
    pub fn down(&self, edge: usize) -> i32 {
        self.0.edges[edge].down[self.1]
    }

    /// What was taken off of it, over twice the area.
    #[inline(always)]
    pub fn off(&self, edge: usize) -> f32 {
        self.0.edges[edge].off[self.1]
    }
}

impl Default for Batch {
    fn default() -> Self {
        let all = [0; MOST];
        let edges = || Functions { at: all, right: all, across: all, down: all, off: [0.0; MOST] };
        Batch {
            count: 0,
            number: [0; MOST],
            material: [0; MOST],
            corners: [[0; 3]; MOST],
            x: [all; 3],
            y: [all; 3],
            columns: [all; 2],
            rows: [all; 2],
            kind: all,
            swapped: all,
            over_area: [0.0; MOST],
            edges: [edges(), edges(), edges()],
        }
    }
}

impl Batch {
    /// Room for the places of all triangles.
    pub(super) const PLACES: [u8; MOST] = [0; MOST];

    /// Reads triangles from the front of `numbers` until there are enough, or a polygon has another shape; gives how many. In
    /// a loop of its own: nothing in it has to be guessed, so that the reads of many overlap. Their places in memory are far
    /// from one another, and waiting for them took a third of the time.
    #[inline(always)]
    pub fn read(&mut self, frame: &Frame, numbers: &[u32]) -> usize {
        let (polygons, vertices) = (frame.polygons(), frame.vertices());
        self.count = 0;
        for &number in &numbers[..numbers.len().min(MOST)] {
            let polygon = &polygons[number as usize];
            let &[a, b, c] = frame.corners(polygon) else { break };
            let k = self.count;
            (self.number[k], self.material[k], self.corners[k]) = (number, polygon.material, [a, b, c]);
            let mut i = 0;
            while i < 3 {
                let vertex = &vertices[self.corners[k][i] as usize];
                (self.x[i][k], self.y[i][k]) = (vertex.x.to_bits(), vertex.y.to_bits());
                i += 1;
            }
            self.count += 1;
        }
        self.count
    }

    /// Bounds what was read by a picture `width` pixels wide and the rows `band`, and sets up the edge functions of small
    /// triangles.
    #[inline(always)]
    pub fn place<M: Lanes>(&mut self, m: M, width: usize, band: &Range<usize>) {
        let mut first = 0;
        while first < self.count {
            self.place_group(m, first, width as i32, [band.start as i32, band.end as i32]);
            first += M::WIDTH;
        }
    }

    #[inline(always)]
    fn place_group<M: Lanes>(&mut self, m: M, first: usize, width: i32, band: [i32; 2]) {
        let zero = m.int(0);
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
        let rows = [centre(top).max(m.int(band[0])), centre(bottom).min(m.int(band[1]))];
        let is_there = columns[0].less(columns[1]) & rows[0].less(rows[1]);
        let is_small =
            (right - left).less(m.int(256 * SMALL_WIDTH + 1)) & (bottom - top).less(m.int(256 * SMALL_HEIGHT));
        let exact = is_there & is_small;
        // From the left upper corner of the box on: small numbers. All others are 0, so that none needs more bits.
        let mut x: [M::I; 3] = each(
            #[inline(always)]
            |i| (x[i] - left) & exact,
        );
        let mut y: [M::I; 3] = each(
            #[inline(always)]
            |i| (y[i] - top) & exact,
        );
        let area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        let swapped = area.less(zero);
        (x[1], x[2]) = (M::I::choose(swapped, x[2], x[1]), M::I::choose(swapped, x[1], x[2]));
        (y[1], y[2]) = (M::I::choose(swapped, y[2], y[1]), M::I::choose(swapped, y[1], y[2]));
        let area = (area ^ swapped) - swapped;
        let over_area = m.splat(1.0) / m.number(area);
        let group = columns[0] & m.int(-(M::WIDTH as i32));
        let px = (group * m.int(256) + m.int(128) - left) & exact;
        let py = (rows[0] * m.int(256) + m.int(128) - top) & exact;
        let mut edge = 0;
        while edge < 3 {
            let (i, j) = ((edge + 1) % 3, (edge + 2) % 3);
            let (dx, dy) = (x[j] - x[i], y[j] - y[i]);
            let level = (dy.less(zero) | zero.less(dy)) ^ m.int(-1);
            let disowns = m.int(1) + (dy.less(zero) | (level & zero.less(dx)));
            let to = &mut self.edges[edge];
            m.store_int(dx * (py - y[i]) - dy * (px - x[i]) - disowns, &mut to.at[first..]);
            m.store_int(dy * m.int(-256), &mut to.right[first..]);
            m.store_int(dy * m.int(-256 * M::WIDTH as i32), &mut to.across[first..]);
            m.store_int(dx * m.int(256), &mut to.down[first..]);
            m.store(m.number(disowns) * over_area, &mut to.off[first..]);
            edge += 1;
        }
        let small = exact & zero.less(area) & m.int(Kind::Small as i32);
        let large = is_there & (is_small ^ m.int(-1)) & m.int(Kind::Large as i32);
        m.store_int(small | large, &mut self.kind[first..]);
        m.store_int(swapped, &mut self.swapped[first..]);
        m.store(over_area, &mut self.over_area[first..]);
        for end in 0..2 {
            m.store_int(columns[end], &mut self.columns[end][first..]);
            m.store_int(rows[end], &mut self.rows[end][first..]);
        }
    }

    /// The places of those of which something is to be drawn, in order, in the front of `places`; gives how many.
    #[inline(always)]
    pub fn drawn(&self, places: &mut [u8; MOST]) -> usize {
        let mut count = 0;
        for k in 0..self.count {
            // Written anyway: which ones are drawn cannot be predicted.
            places[count] = k as u8;
            count += usize::from(self.kind[k] != Kind::Nothing as i32);
        }
        count
    }

    /// Number and material of triangle `k`.
    #[inline(always)]
    pub fn polygon(&self, k: usize) -> (u32, u32) {
        (self.number[k], self.material[k])
    }

    /// Whether 32 bits hold the edge functions of triangle `k`.
    #[inline(always)]
    pub fn is_small(&self, k: usize) -> bool {
        self.kind[k] == Kind::Small as i32
    }

    /// The corners of small triangle `k`, in the order in which its area is over 0.
    #[inline(always)]
    pub fn corners(&self, k: usize) -> [usize; 3] {
        let [a, b, c] = self.corners[k];
        let (b, c) = if self.swapped[k] != 0 { (c, b) } else { (b, c) };
        [a as usize, b as usize, c as usize]
    }

    /// Small triangle `k`.
    #[inline(always)]
    pub(super) fn small(&self, k: usize) -> Small<'_> {
        Small(self, k)
    }

    /// Large triangle `k`, if it has an area.
    #[inline(always)]
    pub(super) fn large(&self, k: usize) -> Option<Triangle> {
        let place = |i: usize| [self.x[i][k], self.y[i][k]];
        let columns = self.columns[0][k]..self.columns[1][k];
        Triangle::new(self.corners[k], [place(0), place(1), place(2)], columns, self.rows[0][k]..self.rows[1][k])
    }
}
