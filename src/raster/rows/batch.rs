//! Many triangles at a time: read, bounded, and set up, a group of triangles where pixels come in groups.
//!
//! Where triangles have a pixel or two, many cover no pixel centre though their bounding boxes hold one. So places are read first,
//! then it is found what is covered, and only of triangles that cover something are depths and attributes read.

use super::facets::Facets;
use super::triangle::Triangle;
use crate::number::each;
use crate::raster::bins::Listed;
use core::ops::Range;

/// This many triangles are read before they are drawn.
pub(super) const MOST: usize = 32;
/// Up to this many pixels wide coverage comes from edge functions over the bounding box: beyond, more groups of pixels are
/// looked at in vain than it takes to find the limits of each row.
pub(super) const SMALL_WIDTH: i32 = 48;
/// And up to this many pixels high. 32 bits hold the functions: groups begin up to 7 pixels left of the box and end as far
/// right of it, so that none is over 2 · 62 · 64 · 2¹⁶ < 2²⁹.
pub(super) const SMALL_HEIGHT: i32 = 64;

/// Up to this many pixels wide a triangle is drawn pixel by pixel, a group of triangles at a time.
pub(super) const TINY_WIDTH: i32 = 5;
/// And up to this many pixels high: its box has no more pixels than a number has bits.
pub(super) const TINY_HEIGHT: i32 = 6;

/// Barycentric coordinates of a small triangle grow by at most this from pixel to pixel: it is not thinner than a quarter of one.
pub(super) const STEEPEST: i32 = 4;

/// Whole numbers, one for each triangle.
pub(super) type All = [i32; MOST];

/// Triangles, as they are read and as they are set up.
#[derive(Debug)]
pub(crate) struct Batch {
    pub(super) count: usize,
    pub(super) listed: [Listed; MOST],
    pub(super) material: [u32; MOST],
    /// Columns and rows of the corners in sub-pixels.
    pub(super) x: [All; 3],
    pub(super) y: [All; 3],
    /// The pixels whose centres the bounding boxes hold, of the band: first column and the one after the last, rows.
    pub(super) columns: [All; 2],
    pub(super) rows: [All; 2],
    /// What is to be drawn: see [`Kind`].
    pub(super) kind: All,
    /// Bit k: whether triangle k is small or large.
    pub(super) others: u32,
    pub(super) over_area: [f32; MOST],
    pub(super) edges: [Functions; 3],
    pub(super) facets: Facets,
}

/// An edge function of each triangle, over 0 inside, in sub-pixels²: at the centre of the first pixel of the first group of the
/// first row, less 1 for right and bottom edges, which do not own the centres that lie on them; how much it grows from column
/// to column, from group to group, and from row to row; and what was taken off, over the area.
#[derive(Debug)]
pub(super) struct Functions {
    pub at: All,
    pub right: All,
    pub across: All,
    pub down: All,
    pub off: [f32; MOST],
    /// What follows is that of small triangles that are not tiny. The barycentric coordinate at the centre of that first pixel, but for
    /// edge 0, and its growth from column to column and from row to row.
    pub weight: [f32; MOST],
    pub growth: [f32; MOST],
    pub fall: [f32; MOST],
    /// Where it grows to the right, how many columns on it becomes 0, per value; else 0.
    pub begins: [f32; MOST],
    /// Where it falls to the right, likewise, and 0; else 0, and more columns than any has.
    pub ends: [[f32; MOST]; 2],
}

/// What of a triangle is to be drawn; 0 is nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// By edge functions.
    Small = 1,
    /// By crossings: it is large, or not known to be small.
    Large = 2,
    /// Pixel by pixel: it is at most [`TINY_WIDTH`] pixels wide and [`TINY_HEIGHT`] high.
    Tiny = 3,
}

/// A small triangle of a batch. Its numbers are read where they are needed, straight into all pixels of a group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Small<'a>(&'a Batch, usize);

impl Small<'_> {
    /// Its columns: the first one and that after the last.
    #[inline(always)]
    pub fn columns(&self) -> [usize; 2] {
        [
            self.0.columns[0][self.1] as usize,
            self.0.columns[1][self.1] as usize,
        ]
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

    /// The barycentric coordinates of the second and the third corner at the centre of the first pixel of the first group of the first row.
    #[inline(always)]
    pub fn weights(&self) -> [f32; 2] {
        let [_, b, c] = &self.0.edges;
        [b.weight[self.1], c.weight[self.1]]
    }

    /// How much they grow from pixel to pixel.
    #[inline(always)]
    pub fn growth(&self) -> [f32; 2] {
        let [_, b, c] = &self.0.edges;
        [b.growth[self.1], c.growth[self.1]]
    }

    /// The same from row to row.
    #[inline(always)]
    pub fn fall(&self) -> [f32; 2] {
        let [_, b, c] = &self.0.edges;
        [b.fall[self.1], c.fall[self.1]]
    }

    /// What was taken off for ownership, over the area.
    #[inline(always)]
    pub fn off(&self, edge: usize) -> f32 {
        self.0.edges[edge].off[self.1]
    }

    /// Where it begins and ends: see [`Functions`].
    #[inline(always)]
    pub fn limits(&self, edge: usize) -> [f32; 3] {
        let Functions { begins, ends, .. } = &self.0.edges[edge];
        [begins[self.1], ends[0][self.1], ends[1][self.1]]
    }
}

impl Default for Batch {
    fn default() -> Self {
        let (all, none) = ([0; MOST], [0.0; MOST]);
        let edges = || Functions {
            at: all,
            right: all,
            across: all,
            down: all,
            off: none,
            weight: none,
            growth: none,
            fall: none,
            begins: none,
            ends: [none; 2],
        };
        Batch {
            count: 0,
            listed: [Listed::default(); MOST],
            material: [0; MOST],
            x: [all; 3],
            y: [all; 3],
            columns: [all; 2],
            rows: [all; 2],
            kind: all,
            others: 0,
            over_area: none,
            edges: [edges(), edges(), edges()],
            facets: Facets::default(),
        }
    }
}

impl Batch {
    /// How many were read.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.count
    }

    /// What of triangle `k` is to be drawn, as [`Kind`] numbers it.
    #[inline(always)]
    pub(super) fn kind(&self, k: usize) -> i32 {
        self.kind[k]
    }

    /// Bit k: whether triangle k is to be drawn as a small or a large one.
    #[inline(always)]
    pub fn others(&self) -> u32 {
        self.others
    }

    /// The material of triangle `k`, where it was read.
    #[inline(always)]
    pub fn material(&self, k: usize) -> u32 {
        self.material[k]
    }

    /// Number and material of triangle `k`, the latter where it was read.
    #[inline(always)]
    pub fn polygon(&self, k: usize) -> (u32, u32) {
        (self.listed[k].number, self.material[k])
    }

    /// The corners of triangle `k`.
    #[inline(always)]
    pub fn corners(&self, k: usize) -> [usize; 3] {
        each(
            #[inline(always)]
            |i| self.listed[k].corners[i] as usize,
        )
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
        Triangle::new(
            [place(0), place(1), place(2)],
            columns,
            self.rows[0][k]..self.rows[1][k],
        )
    }
}

/// Gives the number of each bit that is 1, from the lowest on.
#[inline(always)]
pub(super) fn each_bit(bits: u32, mut visit: impl FnMut(usize)) {
    let mut left = bits;
    while left != 0 {
        visit(left.trailing_zeros() as usize % MOST);
        left &= left - 1;
    }
}
