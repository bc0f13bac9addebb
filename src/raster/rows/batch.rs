//! Many triangles at a time: read, bounded, and set up, a group of triangles where pixels come in groups.

use super::band::MOST_PLANES;
use super::triangle::Triangle;
use crate::frame::Frame;
use crate::number::each;
use crate::raster::bins::Listed;
use crate::walk::Attribute;
use core::ops::Range;

/// This many triangles are read before they are drawn.
pub(super) const MOST: usize = 32;
/// Up to this many pixels wide coverage comes from edge functions over the bounding box: beyond, more groups of pixels are
/// looked at in vain than it takes to find the limits of each row.
pub(super) const SMALL_WIDTH: i32 = 48;
/// And up to this many pixels high. 32 bits hold the functions: groups begin up to 7 pixels left of the box and end as far
/// right of it, so that none is over 2 · 62 · 64 · 2¹⁶ < 2²⁹.
pub(super) const SMALL_HEIGHT: i32 = 64;

/// Up to this many pixels wide and high a triangle is drawn pixel by pixel, a group of triangles at a time.
pub(super) const TINY: i32 = 5;

/// Barycentric coordinates of a small triangle grow by at most this from pixel to pixel: it is not thinner than a quarter of one.
pub(super) const STEEPEST: i32 = 4;

/// Whole numbers, one for each triangle.
pub(super) type All = [i32; MOST];

/// Triangles, as they are read and as they are set up.
#[derive(Debug)]
pub(crate) struct Batch {
    count: usize,
    number: [u32; MOST],
    material: [u32; MOST],
    corners: [[u32; 3]; MOST],
    /// Columns and rows of the corners in sub-pixels.
    pub(super) x: [All; 3],
    pub(super) y: [All; 3],
    /// The pixels whose centres the bounding boxes hold, of the band: first column and the one after the last, rows.
    pub(super) columns: [All; 2],
    pub(super) rows: [All; 2],
    /// What is to be drawn: see [`Kind`].
    pub(super) kind: All,
    pub(super) over_area: [f32; MOST],
    pub(super) edges: [Functions; 3],
    /// Depth, then the numbers of the attribute where it is what pixels are given.
    pub(super) facets: [Facets; 1 + MOST_PLANES],
}

/// A number over each triangle: at its first corner, and how far the other two are from it.
///
/// ```text
/// A = A_a + β (A_b − A_a) + γ (A_c − A_a)
/// ```
/// β and γ come from exact integers and are in 0..=1 inside, so that nothing cancels, however thin the triangle is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facets {
    pub at: [f32; MOST],
    pub to: [[f32; MOST]; 2],
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
    /// Pixel by pixel: it is at most [`TINY`] pixels wide and high.
    Tiny = 3,
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
        let edges =
            || Functions { at: all, right: all, across: all, down: all, off: none, begins: none, ends: [none; 2] };
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
            over_area: none,
            edges: [edges(), edges(), edges()],
            facets: [Facets { at: none, to: [none; 2] }; 1 + MOST_PLANES],
        }
    }
}

impl Batch {
    /// Reads triangles from the front of `polygons` until there are enough, or a polygon has another shape; gives how many. Of
    /// `attributes` it reads the numbers of their corners, if there are any; else the numbers of the triangles. Their materials are
    /// read with their numbers, and if they are asked for.
    ///
    /// In loops of their own, in which nothing has to be guessed: so the reads of many triangles overlap. Their places in memory
    /// are far from one another, and waiting for them took a third of the time.
    #[inline(always)]
    pub fn read<A: Attribute<f32>>(
        &mut self,
        frame: &Frame,
        attributes: Option<&[A]>,
        polygons: &[Listed],
        with_materials: bool,
    ) -> usize {
        let mut count = 0;
        for polygon in &polygons[..polygons.len().min(MOST)] {
            if polygon.corners == Listed::OTHER {
                break;
            }
            self.corners[count] = polygon.corners;
            count += 1;
        }
        let polygons = &polygons[..count];
        for (k, polygon) in polygons.iter().enumerate() {
            self.read_corners(frame, attributes, k, polygon.corners);
        }
        if with_materials || attributes.is_none() {
            for (k, polygon) in polygons.iter().enumerate() {
                self.number[k] = polygon.number;
                self.material[k] = frame.polygons()[polygon.number as usize].material;
            }
        }
        self.count = count;
        count
    }

    /// Reads the corners of triangle `k`.
    #[inline(always)]
    fn read_corners<A: Attribute<f32>>(
        &mut self,
        frame: &Frame,
        attributes: Option<&[A]>,
        k: usize,
        [a, b, c]: [u32; 3],
    ) {
        let vertices = frame.vertices();
        let corners = [a as usize, b as usize, c as usize];
        let mut i = 0;
        while i < 3 {
            let vertex = &vertices[corners[i]];
            (self.x[i][k], self.y[i][k]) = (vertex.x.to_bits(), vertex.y.to_bits());
            self.facets[0].corner(i)[k] = vertex.depth;
            if let Some(attributes) = attributes {
                let mut facet = 1;
                each_number(
                    attributes[corners[i]],
                    #[inline(always)]
                    |number| {
                        self.facets[facet].corner(i)[k] = number;
                        facet += 1;
                    },
                );
            }
            i += 1;
        }
    }

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

    /// The material of triangle `k`, where it was read.
    #[inline(always)]
    pub fn material(&self, k: usize) -> u32 {
        self.material[k]
    }

    /// Number and material of triangle `k`, where attributes were not read.
    #[inline(always)]
    pub fn polygon(&self, k: usize) -> (u32, u32) {
        (self.number[k], self.material[k])
    }

    /// The corners of triangle `k`.
    #[inline(always)]
    pub fn corners(&self, k: usize) -> [usize; 3] {
        each(
            #[inline(always)]
            |i| self.corners[k][i] as usize,
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
        Triangle::new([place(0), place(1), place(2)], columns, self.rows[0][k]..self.rows[1][k])
    }
}

impl Facets {
    /// The numbers of corner `i`, as they are read.
    #[inline(always)]
    fn corner(&mut self, i: usize) -> &mut [f32; MOST] {
        if i == 0 { &mut self.at } else { &mut self.to[i - 1] }
    }
}

/// Gives the numbers of an attribute, to what must be inlined.
#[inline(always)]
fn each_number<A: Attribute<f32>>(attribute: A, mut to: impl FnMut(f32)) {
    attribute.numbers(&mut to);
}
