//! Triangle set-up, a batch at a time, with eight triangles in the lanes of a block: gathers
//! positions, bounds them, sets up edge functions, and, once coverage is known, plane equations.
//!
//! Where triangles have a pixel or two, many cover no pixel centre though their bounding boxes hold
//! one. So positions are gathered first, then coverage is found, and varyings are read only for
//! triangles that cover a pixel.
//!
//! Edge functions implement the fill rule: left and top edges own the pixel centres that lie on
//! them (`Batch::edge`).

use super::tile::{MOST, ValueCount};
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

/// How many triangles a batch has.
pub(super) const BATCH: usize = 32;
/// The largest width, in pixels, of triangles that are covered by edge functions over their
/// bounding box. In wider ones testing blocks in vain takes longer than finding the crossings of
/// each row.
pub(super) const SMALL_WIDTH: i32 = 48;
/// The largest height, in pixels, of those triangles. Their edge functions fit in 32 bits: blocks
/// begin up to 7 pixels left of the box and end as far right of it, so no function is over 2 · 62 ·
/// 64 · 2¹⁶ < 2²⁹.
pub(super) const SMALL_HEIGHT: i32 = 64;

/// An integer or a float for each triangle.
pub(super) type Ints = [i32; BATCH];
type Floats = [f32; BATCH];

/// The path by which a triangle is drawn. 0 stands for a triangle that is not drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CoveragePath {
    /// Edge functions, block by block.
    Small = 1,
    /// Crossings, run by run, because the triangle is too large for edge functions in 32 bits, or a
    /// sliver.
    Large = 2,
    /// Edge functions, pixel by pixel, because the triangle is at most [`TINY_WIDTH`] pixels wide
    /// and [`TINY_HEIGHT`] high.
    Tiny = 3,
}

/// Triangles that are gathered and set up together.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    pub(super) count: usize,
    /// The polygons.
    listed: [Listed; BATCH],
    /// The index in its polygon of each corner, from the top down, at equal height from left to
    /// right. Depth is rounded in this order, so it depends neither on the corner that a polygon
    /// begins with nor on the way it runs.
    order: [Ints; 3],
    /// Columns and rows of the corners, in sub-pixels. Once they are bounded, corners are in the
    /// order of `order`.
    pub(super) x: [Ints; 3],
    pub(super) y: [Ints; 3],
    /// The pixels of the tile whose centres lie in the bounding boxes: the first column and the one
    /// after the last, and the same for rows.
    pub(super) columns: [Ints; 2],
    pub(super) rows: [Ints; 2],
    /// The [`CoveragePath`] of each triangle.
    pub(super) path: Ints,
    pub(super) over_area: Floats,
    pub(super) edges: [EdgeFunctions; 3],
    pub(super) planes: PlaneEquations,
}

/// An edge function of each triangle, in sub-pixels². It is 0 or more inside.
///
/// `at` is its value at the centre of the first pixel of the first block of the first row, less 1
/// for right and bottom edges, which do not own the centres that lie on them. `right` and `down`
/// are its growth from column to column and from row to row. `off` is the 1 or 0 that was
/// subtracted, over the area.
#[derive(Debug, Default)]
pub(super) struct EdgeFunctions {
    pub at: Ints,
    pub right: Ints,
    pub down: Ints,
    pub off: Floats,
    /// The barycentric coordinate at the centre of that first pixel, except for edge 0, and its
    /// growth from column to column and from row to row. From here on, fields are set only for
    /// small triangles that are not tiny.
    pub weight: Floats,
    pub growth: Floats,
    pub fall: Floats,
    /// For left edges −1/slope: how many columns it takes to the edge, per unit of the edge
    /// function. For others 0.
    pub begins: Floats,
    /// For right edges −1/slope, and 0. For others 0, and more columns than any small triangle has.
    pub ends: [Floats; 2],
}

/// How many floats there is room for in a corner's values: whole blocks.
pub(super) const LINE: usize = MOST.next_multiple_of(BLOCK);
/// The values of a corner or a pixel, depth first.
pub(super) type Values = [f32; LINE];

/// Plane equations of each triangle: the values at its uppermost corner, and the differences of the
/// other two corners from it.
///
/// ```text
/// A = A_a + β (A_b − A_a) + γ (A_c − A_a)
/// ```
/// β and γ come from exact integers and are in 0..=1 inside, so nothing cancels, however thin the
/// triangle is.
///
/// The values of a corner lie together, in the order of [`CellLayout`], as they are read and as a
/// pixel needs them. They fill whole blocks, whose last floats mean nothing.
#[derive(Debug, Default)]
#[repr(align(32))]
pub(super) struct PlaneEquations(pub [[Values; 3]; BATCH]);

impl PlaneEquations {
    /// Returns the first `count` values of triangle `k` where its second and third corner have the
    /// coordinates `weights`.
    #[inline(always)]
    pub fn at<S: Simd>(&self, m: Lanes<S>, k: usize, count: usize, weights: [f32; 2]) -> Values {
        self.from(m, k, count, &self.0[k][0], weights)
    }

    /// Returns the growth of the values of triangle `k` where the coordinates grow by `by`.
    #[inline(always)]
    pub fn growth<S: Simd>(&self, m: Lanes<S>, k: usize, count: usize, by: [f32; 2]) -> Values {
        self.from(m, k, count, &[0.0; LINE], by)
    }

    /// Returns the values `at` plus the growth over the coordinates `weights`.
    #[inline(always)]
    fn from<S: Simd>(
        &self,
        m: Lanes<S>,
        k: usize,
        count: usize,
        at: &Values,
        weights: [f32; 2],
    ) -> Values {
        let ([_, to_b, to_c], [b, c]) = (&self.0[k], [m.splat(weights[0]), m.splat(weights[1])]);
        let mut values = [0.0; LINE];
        let mut i = 0;
        while i < count {
            let value = m.load(&to_b[i..]).mul_add(b, m.load(&at[i..]));
            m.store(m.load(&to_c[i..]).mul_add(c, value), &mut values[i..]);
            i += BLOCK;
        }
        values
    }
}

/// Sorts the corners of eight triangles from the top down, at equal height from left to right.
/// `order` is permuted with them.
///
/// A triangle with an area has its corners at three different positions, so nothing else decides
/// their order.
#[inline(always)]
fn sort_corners<S: Simd>(
    m: Lanes<S>,
    x: &mut [i32x8<S>; 3],
    y: &mut [i32x8<S>; 3],
    order: &mut [i32x8<S>; 3],
) {
    // A sorting network of three exchanges.
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        let is_level = (y[i].less(y[j]) | y[j].less(y[i])) ^ m.int(-1);
        let swaps = y[j].less(y[i]) | (is_level & x[j].less(x[i]));
        for values in [&mut *x, &mut *y, &mut *order] {
            // Without a branch: an exclusive or with the difference of bits exchanges two values;
            // with 0 it changes nothing.
            let difference = (values[i] ^ values[j]) & swaps;
            (values[i], values[j]) = (values[i] ^ difference, values[j] ^ difference);
        }
    }
}

/// Eight triangles in relation to the pixels.
#[derive(Clone, Copy)]
struct Bounded<S: Simd> {
    /// The corners, relative to the upper left corner of the box. They are small, and 0 where 32
    /// bits might not hold what is computed from them.
    x: [i32x8<S>; 3],
    y: [i32x8<S>; 3],
    /// The centre of the first pixel of the first block of the first row, relative to the same
    /// corner.
    px: i32x8<S>,
    py: i32x8<S>,
    /// −1 where the corners run the other way round.
    turned: i32x8<S>,
    over_area: f32x8<S>,
    /// The first column of each box and the one after the last. A triangle that is not drawn has an
    /// empty range, which widens no other.
    columns: [i32x8<S>; 2],
    /// True if any triangle is small.
    has_small: bool,
}

impl Batch {
    /// Gathers the positions of triangles from the front of `polygons`, until the batch is full or
    /// a polygon has another shape. Returns how many it gathered.
    ///
    /// The positions lie far from one another in memory. Without unpredictable branches in this
    /// loop, the reads of many triangles overlap.
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

    /// Bounds the triangles by a picture `width` pixels wide and by the rows of a tile, and sets up
    /// their edge functions. Returns the blocks of a row between which the triangles lie, and a bit
    /// for each triangle that is small or large.
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

    /// Bounds eight triangles, from index `first` on, and chooses their paths. Returns a bit for
    /// each that is small or large.
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
        let mut order = [m.int(0), m.int(1), m.int(2)];
        sort_corners(m, &mut x, &mut y, &mut order);
        for i in 0..3 {
            m.store_int(x[i], &mut self.x[i][first..]);
            m.store_int(y[i], &mut self.y[i][first..]);
            m.store_int(order[i], &mut self.order[i][first..]);
        }
        let (left, right) = (x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2]));
        let [top, _, bottom] = y;
        // `first_centre` in 32 bits: coordinates are within ±2²³.
        let centre = |at: i32x8<S>| (at + m.int(127)) >> 8;
        let columns = [centre(left).max(zero), centre(right).min(m.int(width))];
        let [least, most] = band.map(|row| m.int(row));
        let rows = [centre(top).max(least), centre(bottom).min(most)];
        // Lanes behind the last gathered triangle hold triangles of an earlier batch.
        let is_gathered = m.counted().less(m.int((self.count - first) as i32));
        let is_there = columns[0].less(columns[1]) & rows[0].less(rows[1]) & is_gathered;
        let is_small = (right - left).less(m.int(256 * SMALL_WIDTH + 1))
            & (bottom - top).less(m.int(256 * SMALL_HEIGHT));
        // The corners of all other triangles collapse into one point, so that no product below
        // exceeds 32 bits.
        let exact = is_there & is_small;
        let from = |a: i32x8<S>, origin: i32x8<S>| (a - origin) & exact;
        let x = [from(x[0], left), from(x[1], left), from(x[2], left)];
        let y = [from(y[0], top), from(y[1], top), from(y[2], top)];
        let area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
        let turned = area.less(zero);
        // Negates the lanes where `turned` is −1: −x = !x + 1.
        let area = (area ^ turned) - turned;
        // Infinite where the area is 0. These lanes are not drawn.
        let over_area = m.splat(1.0) / m.float(area);
        let drawn = exact & zero.less(area);
        let tiny = drawn
            & (columns[1] - columns[0]).less(m.int(TINY_WIDTH + 1))
            & (rows[1] - rows[0]).less(m.int(TINY_HEIGHT + 1));
        // No edge is longer than the box in either direction. So a coordinate grows per pixel by at
        // most 256 times that length over twice the area, and the triangle is steep if this could
        // exceed STEEPEST.
        let longer = (right - left).max(bottom - top) & exact;
        let steep = drawn & area.less(longer * m.int(256 / STEEPEST)) & (tiny ^ all);
        let small = drawn & (steep ^ all);
        let large = is_there & ((is_small ^ all) | steep);
        // Tiny triangles are small ones too, and 1 | 3 is 3.
        let path = (small & m.int(CoveragePath::Small as i32))
            | (tiny & m.int(CoveragePath::Tiny as i32))
            | (large & m.int(CoveragePath::Large as i32));
        let not_small = (small & (tiny ^ all)) ^ all;
        // Masks are −1 or 0, so a lane that is not negative is one where the mask is false. The
        // bits of `others` are set for small and for large triangles.
        let has_small = m.any_not_negative(not_small);
        let others = m.bits_not_negative(not_small & (large ^ all));
        m.store_int(path, &mut self.path[first..]);
        m.store(over_area, &mut self.over_area[first..]);
        for end in 0..2 {
            m.store_int(columns[end], &mut self.columns[end][first..]);
            m.store_int(rows[end], &mut self.rows[end][first..]);
        }
        // Clears the low three bits: the first column of the block.
        let block = columns[0] & m.int(-(BLOCK as i32));
        let bounded = Bounded {
            x,
            y,
            px: from(block * m.int(256) + m.int(128), left),
            py: from(rows[0] * m.int(256) + m.int(128), top),
            turned,
            over_area,
            // An undrawn triangle gets the range from i32::MAX to 0, which a minimum and a maximum
            // ignore.
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
        // In triangles that run this way, left edges go up and top edges go right. There −1 cancels
        // the 1, and `disowns` is 0. A centre on any other edge, where the function is 0, gets −1
        // and lies outside.
        let disowns = m.int(1) + (dy.less(zero) | (level & zero.less(dx)));
        let to = &mut self.edges[edge];
        let at = dx * (bounded.py - y[i]) - dy * (bounded.px - x[i]) - disowns;
        // Per sub-pixel the function grows by −dy to the right and by dx downward. A pixel has 256.
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
        // Level edges divide by 0. Both selections below leave the infinity out.
        let columns = m.splat(-1.0) / right;
        m.store(m.where_less(none, right, columns), &mut to.begins[first..]);
        m.store(m.where_less(right, none, columns), &mut to.ends[0][first..]);
        let beyond = m.splat(2.0 * SMALL_WIDTH as f32);
        // A limit beyond every triangle's last column, and 0 for edges that fall to the right.
        let falls = m.where_less(right, none, beyond);
        m.store(beyond - falls, &mut to.ends[1][first..]);
    }

    /// Sets up the plane equations of the triangles in the mask `drawn`, for the `N` values of
    /// `cell`; `N` = 0 stands for any count. It is a separate loop, so that cache misses overlap.
    #[inline(always)]
    pub fn set_up_planes<S: Simd, const N: usize>(
        &mut self,
        m: Lanes<S>,
        setup: &SetUp<'_>,
        cell: CellLayout,
        test: SampleDepth,
        drawn: u32,
    ) {
        let (vertices, varyings) = (setup.frame.vertices(), &setup.varyings);
        let count = ValueCount::<N>(cell.count());
        // The fast path: three values per vertex, without a loop over them.
        if N == 4 && !cell.has_uniforms && matches!(varyings.per, Per::Vertex) {
            let values = varyings.values.as_chunks::<3>().0;
            // One length bounds both slices, so that one check per vertex is enough.
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
                |polygon, corner, vertex, line| {
                    let depth = test.of_corner(&vertices[vertex as usize]);
                    let varying = varyings.of_corner_with(all, polygon, [corner, vertex]);
                    cell.write(line, depth, varying, || unreachable!("it has none"));
                },
            );
        }
        self.read(
            m,
            drawn,
            count,
            #[inline(always)]
            |polygon, corner, vertex, line| {
                let depth = test.of_corner(&vertices[vertex as usize]);
                let varying = varyings.of_corner(polygon, corner, vertex);
                cell.write(line, depth, varying, || setup.uniforms_of(polygon));
            },
        );
    }

    /// Calls `read` for the corners of each triangle in the mask `drawn`, with polygon, corner and
    /// vertex, and stores plane equations.
    #[inline(always)]
    fn read<S: Simd, const N: usize>(
        &mut self,
        m: Lanes<S>,
        drawn: u32,
        count: ValueCount<N>,
        read: impl Fn(u32, u32, u32, &mut Values),
    ) {
        for k in bits(drawn) {
            let Listed { index, corners } = self.listed[k];
            let (mut at, mut to_b, mut to_c) = ([0.0; LINE], [0.0; LINE], [0.0; LINE]);
            for (i, to) in [&mut at, &mut to_b, &mut to_c].into_iter().enumerate() {
                let corner = self.order[i][k] as u32;
                read(index, corner, corners[corner as usize], to);
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

/// Returns the indices of the bits that are 1, from the lowest on.
#[inline(always)]
pub(super) fn bits(mut left: u32) -> impl Iterator<Item = usize> {
    core::iter::from_fn(
        #[inline(always)]
        move || {
            // No bit left makes `trailing_zeros` 32, which is BATCH and ends the iteration. The
            // second line clears the lowest bit.
            let k = left.trailing_zeros() as usize;
            left &= left.wrapping_sub(1);
            (k < BATCH).then_some(k)
        },
    )
}
