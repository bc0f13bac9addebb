//! Triangle set-up, a batch at a time, eight triangles in the lanes of a block: gather, bounds, edge functions, and, after
//! coverage, plane equations.
//!
//! Where triangles have a pixel or two, many cover no pixel centre though their bounding boxes hold one. So positions are gathered
//! first, then coverage is found, and varyings are read only for triangles that cover a pixel.
//!
//! Edge functions hold the fill rule: left and top edges own the pixel centres that lie on them (`Batch::edge`).

use super::tile::{MOST, NumberCount};
use crate::frame::Frame;
use crate::frame::row_tiles::{STEEPEST, TINY_HEIGHT, TINY_WIDTH};
use crate::number::lanes::{Int, Lanes};
use crate::number::simd::BLOCK;
use crate::raster::bins::Listed;
use crate::raster::depth::SampleDepth;
use crate::raster::setup::{Per, SetUp};
use crate::shading::CellLayout;
use core::ops::Range;
use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8, i32x8};

/// Triangles of a batch.
pub(super) const BATCH: usize = 32;
/// Up to this many pixels wide coverage comes from edge functions over the bounding box: beyond, more blocks are looked at in
/// vain than it takes to find the crossings of each row.
pub(super) const SMALL_WIDTH: i32 = 48;
/// And up to this many pixels high. 32 bits hold the functions: blocks begin up to 7 pixels left of the box and end as far right
/// of it, so that none is over 2 · 62 · 64 · 2¹⁶ < 2²⁹.
pub(super) const SMALL_HEIGHT: i32 = 64;

/// An integer, or a float, for each triangle.
pub(super) type Ints = [i32; BATCH];
type Floats = [f32; BATCH];

/// The path by which a triangle is drawn; 0 stands for a triangle that is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CoveragePath {
    /// By edge functions, block by block.
    Small = 1,
    /// By crossings, run by run: it is too large for edge functions of 32 bits, or a sliver.
    Large = 2,
    /// By edge functions, pixel by pixel: it is at most [`TINY_WIDTH`] pixels wide and [`TINY_HEIGHT`] high.
    Tiny = 3,
}

/// Triangles as they are gathered and set up.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    pub(super) count: usize,
    /// The polygons.
    listed: [Listed; BATCH],
    /// The numbers of the corners in their polygon, from the top down, at equal height from left to right: depth is rounded by that
    /// order, and so does not depend on the corner that a polygon begins with, nor on the way in which it runs.
    numbers: [Ints; 3],
    /// Columns and rows of the corners in sub-pixels, once they are bounded in the order of `numbers`.
    pub(super) x: [Ints; 3],
    pub(super) y: [Ints; 3],
    /// The pixels of the tile whose centres the bounding boxes hold: first column and the one after the last, rows.
    pub(super) columns: [Ints; 2],
    pub(super) rows: [Ints; 2],
    /// The [`CoveragePath`].
    pub(super) path: Ints,
    pub(super) over_area: Floats,
    pub(super) edges: [EdgeFunctions; 3],
    pub(super) planes: PlaneEquations,
}

/// An edge function of each triangle, over 0 inside, in sub-pixels²: at the centre of the first pixel of the first block of the
/// first row, less 1 for right and bottom edges, which do not own the centres that lie on them; its growth from column to
/// column and from row to row; and the number taken off, over the area.
#[derive(Debug, Default)]
pub(super) struct EdgeFunctions {
    pub at: Ints,
    pub right: Ints,
    pub down: Ints,
    pub off: Floats,
    /// The barycentric coordinate at the centre of that first pixel, except for edge 0, and its growth from column to column and
    /// from row to row. This and the following is set for small triangles that are not tiny.
    pub weight: Floats,
    pub growth: Floats,
    pub fall: Floats,
    /// For left edges −1/slope: columns to the edge per unit of the edge function; else 0.
    pub begins: Floats,
    /// For right edges −1/slope, and 0; else 0, and more columns than any picture has.
    pub ends: [Floats; 2],
}

/// The room for the numbers of a corner: whole blocks.
pub(super) const LINE: usize = MOST.next_multiple_of(BLOCK);
/// The numbers of a corner or a pixel, depth first.
pub(super) type Numbers = [f32; LINE];

/// Plane equations of each triangle: numbers at its uppermost corner, and the differences of the other two from it.
///
/// ```text
/// A = A_a + β (A_b − A_a) + γ (A_c − A_a)
/// ```
/// β and γ come from exact integers and are in 0..=1 inside, so that nothing cancels, however thin the triangle is.
///
/// The numbers of a corner lie together, in the order of [`CellLayout`], as they are read and as a pixel needs them; in whole
/// blocks, whose last numbers mean nothing.
#[derive(Debug, Default)]
#[repr(align(32))]
pub(super) struct PlaneEquations(pub [[Numbers; 3]; BATCH]);

impl PlaneEquations {
    /// Returns the first `count` numbers of triangle `k` where its second and third corner have the coordinates `weights`.
    #[inline(always)]
    pub fn at<S: Simd>(&self, m: Lanes<S>, k: usize, count: usize, weights: [f32; 2]) -> Numbers {
        self.from(m, k, count, &self.0[k][0], weights)
    }

    /// Returns the growth of the numbers where the coordinates grow `by` so much.
    #[inline(always)]
    pub fn growth<S: Simd>(&self, m: Lanes<S>, k: usize, count: usize, by: [f32; 2]) -> Numbers {
        self.from(m, k, count, &[0.0; LINE], by)
    }

    /// Returns the numbers `at`, grown by the coordinates `weights`.
    #[inline(always)]
    fn from<S: Simd>(
        &self,
        m: Lanes<S>,
        k: usize,
        count: usize,
        at: &Numbers,
        weights: [f32; 2],
    ) -> Numbers {
        let ([_, to_b, to_c], [b, c]) = (&self.0[k], [m.splat(weights[0]), m.splat(weights[1])]);
        let mut numbers = [0.0; LINE];
        let mut i = 0;
        while i < count {
            let value = m.load(&to_b[i..]).mul_add(b, m.load(&at[i..]));
            m.store(m.load(&to_c[i..]).mul_add(c, value), &mut numbers[i..]);
            i += BLOCK;
        }
        numbers
    }
}

/// Sorts the corners of eight triangles from the top down, at equal height from left to right, and their numbers with them.
///
/// Corners of a triangle that has an area are at three places, so that nothing else decides their order.
#[inline(always)]
fn sort_corners<S: Simd>(
    m: Lanes<S>,
    x: &mut [i32x8<S>; 3],
    y: &mut [i32x8<S>; 3],
    number: &mut [i32x8<S>; 3],
) {
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        let is_level = (y[i].less(y[j]) | y[j].less(y[i])) ^ m.int(-1);
        let swaps = y[j].less(y[i]) | (is_level & x[j].less(x[i]));
        for values in [&mut *x, &mut *y, &mut *number] {
            // Without a branch: exclusive or with the difference of bits is an exchange, with 0 it is none.
            let difference = (values[i] ^ values[j]) & swaps;
            (values[i], values[j]) = (values[i] ^ difference, values[j] ^ difference);
        }
    }
}

/// Eight triangles in relation to the pixels.
#[derive(Clone, Copy)]
struct Bounded<S: Simd> {
    /// Corners from the left upper corner of the box on: small numbers, and 0 where 32 bits might not hold what follows.
    x: [i32x8<S>; 3],
    y: [i32x8<S>; 3],
    /// The centre of the first pixel of the first block of the first row, from that corner on.
    px: i32x8<S>,
    py: i32x8<S>,
    /// −1 where the corners run the other way around.
    turned: i32x8<S>,
    over_area: f32x8<S>,
    /// The columns of the boxes: none where nothing is to be drawn.
    columns: [i32x8<S>; 2],
    /// True if any is small.
    has_small: bool,
}

impl Batch {
    /// Gathers the positions of triangles from the front of `polygons` until there are enough, or a polygon has another shape.
    /// Returns their number.
    ///
    /// In a loop without unpredictable branches, so that the reads of many triangles overlap: their places in memory are far from
    /// one another.
    #[inline(always)]
    pub fn gather(&mut self, frame: &Frame, polygons: &[Listed]) -> usize {
        let (vertices, most) = (frame.vertices(), polygons.len().min(BATCH));
        let polygons = &polygons[..most];
        let mut k = 0;
        while k < most && polygons[k].is_triangle() {
            let corners = polygons[k].corners;
            self.listed[k] = polygons[k];
            for i in 0..3 {
                let vertex = &vertices[corners[i] as usize];
                (self.x[i][k], self.y[i][k]) = (vertex.x.to_bits(), vertex.y.to_bits());
            }
            k += 1;
        }
        self.count = k;
        k
    }

    /// Bounds the triangles by a picture `width` pixels wide and the rows of a tile, and sets up edge functions. Returns the blocks
    /// of a row between which the triangles lie, and a bit for each triangle that is small or large.
    #[inline(always)]
    pub fn set_up<S: Simd>(
        &mut self,
        m: Lanes<S>,
        width: usize,
        rows: &Range<usize>,
    ) -> (Range<usize>, u32) {
        let (mut left, mut right) = (m.int(width as i32), m.int(0));
        let (mut others, mut first) = (0, 0);
        while first < self.count {
            let (bounded, here) =
                self.bound(m, first, width as i32, [rows.start as i32, rows.end as i32]);
            others |= here << first;
            left = left.min(bounded.columns[0]);
            right = right.max(bounded.columns[1]);
            for edge in 0..3 {
                self.edge(m, first, edge, &bounded);
            }
            first += BLOCK;
        }
        let (lefts, rights): ([i32; BLOCK], [i32; BLOCK]) = (left.into(), right.into());
        let (left, right) = (lefts.iter().min(), rights.iter().max());
        let blocks = left.map_or(0, |left| *left as usize / BLOCK)
            ..right.map_or(0, |right| (*right as usize).div_ceil(BLOCK));
        (blocks, others)
    }

    /// Bounds the eight triangles from number `first` on, and chooses their paths. Returns a bit for each that is small or large.
    #[inline(always)]
    fn bound<S: Simd>(
        &mut self,
        m: Lanes<S>,
        first: usize,
        width: i32,
        band: [i32; 2],
    ) -> (Bounded<S>, u32) {
        let (zero, all) = (m.int(0), m.int(-1));
        let of = |corner: &Ints| m.load_int(&corner[first..]);
        let load = |from: &[Ints; 3]| [of(&from[0]), of(&from[1]), of(&from[2])];
        let (mut x, mut y) = (load(&self.x), load(&self.y));
        let mut number = [m.int(0), m.int(1), m.int(2)];
        sort_corners(m, &mut x, &mut y, &mut number);
        for i in 0..3 {
            m.store_int(x[i], &mut self.x[i][first..]);
            m.store_int(y[i], &mut self.y[i][first..]);
            m.store_int(number[i], &mut self.numbers[i][first..]);
        }
        let (left, right) = (x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2]));
        let [top, _, bottom] = y;
        // `first_centre` in 32 bits: coordinates are within ±2²³.
        let centre = |at: i32x8<S>| (at + m.int(127)) >> 8;
        let columns = [centre(left).max(zero), centre(right).min(m.int(width))];
        let [least, most] = band.map(|row| m.int(row));
        let rows = [centre(top).max(least), centre(bottom).min(most)];
        // Those after the last one were gathered before.
        let is_gathered = m.counted().less(m.int((self.count - first) as i32));
        let is_there = columns[0].less(columns[1]) & rows[0].less(rows[1]) & is_gathered;
        let is_small = (right - left).less(m.int(256 * SMALL_WIDTH + 1))
            & (bottom - top).less(m.int(256 * SMALL_HEIGHT));
        // All corners of the others are moved into one point, so that no product below needs more than 32 bits.
        let exact = is_there & is_small;
        let from = |a: i32x8<S>, origin: i32x8<S>| (a - origin) & exact;
        let x = [from(x[0], left), from(x[1], left), from(x[2], left)];
        let y = [from(y[0], top), from(y[1], top), from(y[2], top)];
        let area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        let turned = area.less(zero);
        // Negated where `turned` is −1: −x = !x + 1.
        let area = (area ^ turned) - turned;
        let over_area = m.splat(1.0) / m.float(area);
        let drawn = exact & zero.less(area);
        let tiny = drawn
            & (columns[1] - columns[0]).less(m.int(TINY_WIDTH + 1))
            & (rows[1] - rows[0]).less(m.int(TINY_HEIGHT + 1));
        // No edge is higher or wider than the box: coordinates grow by at most 256 times that over twice the area.
        let longer = (right - left).max(bottom - top) & exact;
        let steep = drawn & area.less(longer * m.int(256 / STEEPEST)) & (tiny ^ all);
        let small = drawn & (steep ^ all);
        let large = is_there & ((is_small ^ all) | steep);
        let path = (small & m.int(CoveragePath::Small as i32))
            | (tiny & m.int(CoveragePath::Tiny as i32))
            | (large & m.int(CoveragePath::Large as i32));
        let not_small = (small & (tiny ^ all)) ^ all;
        let has_small = m.any_not_negative(not_small);
        let others = m.bits_not_negative(not_small & (large ^ all));
        m.store_int(path, &mut self.path[first..]);
        m.store(over_area, &mut self.over_area[first..]);
        for end in 0..2 {
            m.store_int(columns[end], &mut self.columns[end][first..]);
            m.store_int(rows[end], &mut self.rows[end][first..]);
        }
        let block = columns[0] & m.int(-(BLOCK as i32));
        let bounded = Bounded {
            x,
            y,
            px: from(block * m.int(256) + m.int(128), left),
            py: from(rows[0] * m.int(256) + m.int(128), top),
            turned,
            over_area,
            columns: [
                columns[0] | (is_there ^ all) & m.int(i32::MAX),
                columns[1] & is_there,
            ],
            has_small,
        };
        (bounded, others)
    }

    /// Sets up edge function `edge`, which is 0 at the two other corners.
    #[inline(always)]
    fn edge<S: Simd>(&mut self, m: Lanes<S>, first: usize, edge: usize, bounded: &Bounded<S>) {
        let Bounded { x, y, turned, .. } = *bounded;
        let (zero, none, over_area) = (m.int(0), m.splat(0.0), bounded.over_area);
        let (i, j) = ((edge + 1) % 3, (edge + 2) % 3);
        let dx = ((x[j] - x[i]) ^ turned) - turned;
        let dy = ((y[j] - y[i]) ^ turned) - turned;
        let level = (dy.less(zero) | zero.less(dy)) ^ m.int(-1);
        // Turned the one way round, left edges go up and top edges go right: −1 cancels the 1 there. A centre on another edge, where
        // the function is 0, gets −1 and lies outside.
        let disowns = m.int(1) + (dy.less(zero) | (level & zero.less(dx)));
        let to = &mut self.edges[edge];
        let at = dx * (bounded.py - y[i]) - dy * (bounded.px - x[i]) - disowns;
        let (right, down) = (dy * m.int(-256), dx * m.int(256));
        let off = m.float(disowns) * over_area;
        m.store_int(at, &mut to.at[first..]);
        m.store_int(right, &mut to.right[first..]);
        m.store_int(down, &mut to.down[first..]);
        m.store(off, &mut to.off[first..]);
        if !bounded.has_small {
            return;
        }
        if edge != 0 {
            let weight = m.float(at).mul_add(over_area, off);
            m.store(weight, &mut to.weight[first..]);
            m.store(m.float(right) * over_area, &mut to.growth[first..]);
            m.store(m.float(down) * over_area, &mut to.fall[first..]);
        }
        let right = m.float(right);
        // Level edges divide by 0: both selections below leave these infinities out.
        let columns = m.splat(-1.0) / right;
        m.store(m.where_less(none, right, columns), &mut to.begins[first..]);
        m.store(m.where_less(right, none, columns), &mut to.ends[0][first..]);
        let beyond = m.splat(2.0 * SMALL_WIDTH as f32);
        // More columns than any has, unless it falls.
        let falls = m.where_less(right, none, beyond);
        m.store(beyond - falls, &mut to.ends[1][first..]);
    }

    /// Sets up the plane equations of the triangles whose bits `drawn` has, for the `N` numbers of `cell`, or any of them for
    /// `N` = 0. A separate loop, so that cache misses overlap.
    #[inline(always)]
    pub fn set_up_planes<S: Simd, const N: usize>(
        &mut self,
        m: Lanes<S>,
        setup: &SetUp<'_>,
        (cell, test): (CellLayout, SampleDepth),
        drawn: u32,
    ) {
        let (vertices, varyings) = (setup.frame.vertices(), &setup.varyings);
        let count = NumberCount::<N>(cell.count());
        // The fast path: three numbers per vertex, without a loop over them.
        if N == 4 && !cell.has_uniforms && matches!(varyings.per, Per::Vertex) {
            let values = varyings.values.as_chunks::<3>().0;
            // Bounded once for both.
            let most = vertices.len().min(values.len());
            let (vertices, values) = (&vertices[..most], &values[..most]);
            return self.read(
                m,
                drawn,
                count,
                #[inline(always)]
                |_, _, vertex, line| {
                    let [x, y, z] = values[vertex as usize];
                    let depth = test.of_corner(&vertices[vertex as usize]);
                    cell.write(line, depth, &[x, y, z], || unreachable!("it has none"));
                },
            );
        }
        let all = N.saturating_sub(CellLayout::varying(0));
        if N > 0 && !cell.has_uniforms && varyings.count == all {
            return self.read(
                m,
                drawn,
                count,
                #[inline(always)]
                |number, corner, vertex, line| {
                    let depth = test.of_corner(&vertices[vertex as usize]);
                    let varying = varyings.of_corner_with(all, number, [corner, vertex]);
                    cell.write(line, depth, varying, || unreachable!("it has none"));
                },
            );
        }
        self.read(
            m,
            drawn,
            count,
            #[inline(always)]
            |number, corner, vertex, line| {
                let depth = test.of_corner(&vertices[vertex as usize]);
                let varying = varyings.of_corner(number, corner, vertex);
                cell.write(line, depth, varying, || setup.uniforms_of(number));
            },
        );
    }

    /// Has `read` read the corners of triangles, by polygon, corner and vertex.
    #[inline(always)]
    fn read<S: Simd, const N: usize>(
        &mut self,
        m: Lanes<S>,
        drawn: u32,
        count: NumberCount<N>,
        read: impl Fn(u32, u32, u32, &mut Numbers),
    ) {
        for k in bits(drawn) {
            let Listed { number, corners } = self.listed[k];
            let (mut at, mut to_b, mut to_c) = ([0.0; LINE], [0.0; LINE], [0.0; LINE]);
            for (i, to) in [&mut at, &mut to_b, &mut to_c].into_iter().enumerate() {
                let corner = self.numbers[i][k] as u32;
                read(number, corner, corners[corner as usize], to);
            }
            let to = &mut self.planes.0[k];
            let mut i = 0;
            while i < count.get() {
                let from = m.load(&at[i..]);
                m.store(from, &mut to[0][i..]);
                m.store(m.load(&to_b[i..]) - from, &mut to[1][i..]);
                m.store(m.load(&to_c[i..]) - from, &mut to[2][i..]);
                i += BLOCK;
            }
        }
    }
}

/// Returns the numbers of the bits that are 1, from the lowest on.
#[inline(always)]
pub(super) fn bits(mut left: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(
        #[inline(always)]
        move || {
            let k = left.trailing_zeros() as usize;
            left &= left.wrapping_sub(1);
            (k < BATCH).then_some(k)
        },
    )
}
