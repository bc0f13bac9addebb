//! Convex quadrangles, eight at a time in the lanes of a block. Their edges step from row to row,
//! and each row yields a run of each quadrangle.
//!
//! A quadrangle has no plane equation: its varyings are interpolated between its edges, as in the
//! span engine. This file does the same operations in the same order, so its bits equal the bits of
//! the run path (`runs.rs`).

use super::HEIGHT;
use super::runs::{RunPlace, draw_run};
use super::tile::{MOST, ValueCount, Writer};
use super::triangles::{Values, bits};
use crate::frame::Frame;
use crate::number::lanes::{Int, Lanes};
use crate::number::simd::BLOCK;
use crate::raster::bins::Listed;
use crate::raster::depth::SampleDepth;
use crate::raster::setup::SetUp;
use crate::shading::CellLayout;
use core::ops::Range;
use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x8, f64x4, i32x8, mask32x8};

/// How many corners a quadrangle has, and how many edges: edge i runs from corner i to the next
/// one.
const CORNERS: usize = 4;
/// The corners of one quadrangle must be less than this many sub-pixels apart in each direction.
/// Then 32 bits hold the difference of two products of such distances, and 256 times a distance is
/// exact in the 24 bits of a float.
const REACH: i32 = 1 << 15;

/// An integer or a float for each quadrangle.
type Ints = [i32; BLOCK];
type Floats = [f32; BLOCK];

/// Gathered quadrangles, and their runs in a tile.
#[derive(Debug, Default)]
#[repr(align(32))]
pub(crate) struct QuadBatch {
    count: usize,
    /// The polygons, and the vertices at their corners.
    polygons: [u32; BLOCK],
    vertices: [[u32; CORNERS]; BLOCK],
    /// Columns and rows of the corners, in sub-pixels.
    x: [Ints; CORNERS],
    y: [Ints; CORNERS],
    /// The values at the corners, in the order of [`CellLayout`].
    values: [[Floats; MOST]; CORNERS],
    edges: [Edges; CORNERS],
    /// The first row of each quadrangle, and how many rows it has.
    rows: [Ints; 2],
    /// The runs of each row, counted from each quadrangle's own first row.
    runs: [Runs; HEIGHT],
}

/// An edge of each quadrangle, at the row where it begins.
#[derive(Debug, Default)]
struct Edges {
    /// The row where the edge begins, counted from the quadrangle's first; −1 if it crosses no row.
    begins: Ints,
    /// −1 for a left edge, else 0.
    is_left: Ints,
    /// The crossing there: see [`Crossings`].
    crossing: [Ints; 5],
    /// The values there, and their growth from row to row.
    at: [Floats; MOST],
    step: [Floats; MOST],
}

/// A run of each quadrangle.
#[derive(Debug, Default)]
struct Runs {
    /// The first pixel, and the one after the last. The run is empty if the first is not less.
    pixels: [Ints; 2],
    /// The values at the first pixel, and their growth from pixel to pixel.
    at: [Floats; MOST],
    step: [Floats; MOST],
}

/// Eight crossings in 32 bits, stored as [`EdgeCrossing`](crate::raster::spans::edge::EdgeCrossing)
/// stores one: `pixel − rest / denominator`. A denominator is 256 times a height below [`REACH`],
/// and so below 2²³.
#[derive(Clone, Copy)]
struct Crossings<S: Simd> {
    pixel: i32x8<S>,
    rest: i32x8<S>,
    step_pixels: i32x8<S>,
    step_rest: i32x8<S>,
    denominator: i32x8<S>,
}

impl<S: Simd> Crossings<S> {
    /// Returns the crossings of edges with scanlines whose centres lie `past` sub-pixels below the
    /// edges' upper ends. The array holds the columns of the upper ends, the widths and the
    /// heights, all in sub-pixels. `over` is 256 over the heights, rounded.
    ///
    /// Each division is done in floats and then corrected. A float quotient is less than ½ off, so
    /// rounding it yields one of two neighbours, and the sign of the remainder says which.
    #[inline(always)]
    fn new(m: Lanes<S>, past: i32x8<S>, [x, dx, dy]: [i32x8<S>; 3], over: f32x8<S>) -> Self {
        let half = m.splat(0.5);
        let denominator = dy << 8;
        // The numerator is the crossing's distance from the centre of pixel 0, times the
        // denominator. The quotient is −½ or more, and below REACH / 256 + 1.
        let numerator = (x - m.int(128)) * dy + past * dx;
        let quotient = m.float(numerator) * (over * m.splat(1.0 / 65536.0));
        // `quotient + ½` is not negative, so truncation rounds it to the nearest integer.
        let pixel = m.truncated(quotient + half);
        let rest = pixel * denominator - numerator;
        let is_left = rest >> 31;
        // Conversions truncate toward 0. Adding REACH keeps the slope over 0, so that they round
        // down.
        let slope = m.float(dx) * (over * m.splat(1.0 / 256.0));
        let step = m.truncated(slope + m.splat(REACH as f32 + 0.5)) - m.int(REACH);
        let step_rest = dx - step * dy;
        let is_over = step_rest >> 31;
        Crossings {
            // `is_left` is −1 where the remainder is negative: subtracting it moves one pixel to
            // the right.
            pixel: pixel - is_left,
            rest: rest + (denominator & is_left),
            step_pixels: step + is_over,
            step_rest: (step_rest + (dy & is_over)) << 8,
            denominator,
        }
    }

    /// Returns the distances from the crossings to the centres of their pixels, in pixels.
    #[inline(always)]
    fn offset(&self, m: Lanes<S>) -> [f64x4<S>; 2] {
        let (rest, denominator) = (wide(m, self.rest), wide(m, self.denominator));
        [rest[0] / denominator[0], rest[1] / denominator[1]]
    }

    /// Steps to the next scanline. It is `EdgeCrossing::advance` with a mask in place of the
    /// branch.
    #[inline(always)]
    fn advance(&mut self) {
        let rest = self.rest - self.step_rest;
        let is_left = rest >> 31;
        self.pixel = self.pixel + self.step_pixels - is_left;
        self.rest = rest + (self.denominator & is_left);
    }

    #[inline(always)]
    fn load(m: Lanes<S>, [pixel, rest, step_pixels, step_rest, denominator]: &[Ints; 5]) -> Self {
        Crossings {
            pixel: m.load_int(pixel),
            rest: m.load_int(rest),
            step_pixels: m.load_int(step_pixels),
            step_rest: m.load_int(step_rest),
            denominator: m.load_int(denominator),
        }
    }

    #[inline(always)]
    fn store(&self, m: Lanes<S>, to: &mut [Ints; 5]) {
        let [pixel, rest, step_pixels, step_rest, denominator] = to;
        m.store_int(self.pixel, pixel);
        m.store_int(self.rest, rest);
        m.store_int(self.step_pixels, step_pixels);
        m.store_int(self.step_rest, step_rest);
        m.store_int(self.denominator, denominator);
    }
}

/// The left or the right edges of eight quadrangles, on their way down.
#[derive(Clone, Copy)]
struct Side<S: Simd> {
    crossing: Crossings<S>,
    at: [f32x8<S>; MOST],
    step: [f32x8<S>; MOST],
}

impl<S: Simd> Side<S> {
    /// Returns a side of vertical edges in column 0, until other edges [begin](Side::begin).
    #[inline(always)]
    fn new(m: Lanes<S>) -> Self {
        Side {
            crossing: Crossings {
                pixel: m.int(0),
                rest: m.int(0),
                step_pixels: m.int(0),
                step_rest: m.int(0),
                // Not 0, because `offset` divides by it.
                denominator: m.int(1),
            },
            at: [m.splat(0.0); MOST],
            step: [m.splat(0.0); MOST],
        }
    }

    /// Switches to the edges in the lanes of `begins`, with `count` values.
    #[inline(always)]
    fn begin(&mut self, m: Lanes<S>, edges: &Edges, begins: mask32x8<S>, count: usize) {
        let (here, new) = (&mut self.crossing, Crossings::load(m, &edges.crossing));
        here.pixel = begins.select(new.pixel, here.pixel);
        here.rest = begins.select(new.rest, here.rest);
        here.step_pixels = begins.select(new.step_pixels, here.step_pixels);
        here.step_rest = begins.select(new.step_rest, here.step_rest);
        here.denominator = begins.select(new.denominator, here.denominator);
        // `Lanes::select` reads its mask as all bits or none. Where bits are set, the old edge goes
        // on.
        let others = (!begins).to_vector();
        for i in 0..count {
            self.at[i] = m.select(others, self.at[i], m.load(&edges.at[i]));
            self.step[i] = m.select(others, self.step[i], m.load(&edges.step[i]));
        }
    }

    /// Steps to the next scanline, with `count` values.
    #[inline(always)]
    fn advance(&mut self, count: usize) {
        self.crossing.advance();
        for i in 0..count {
            self.at[i] += self.step[i];
        }
    }
}

/// Eight quadrangles in relation to a tile.
#[derive(Clone, Copy)]
pub(super) struct Bounded<S: Simd> {
    /// The first column of each box and the one after the last. A quadrangle that is not drawn has
    /// an empty range, which widens no other.
    columns: [i32x8<S>; 2],
    /// The first row of each quadrangle in the tile.
    first: i32x8<S>,
    /// The left end of each box: rounded down to a whole pixel, in pixels and in sub-pixels.
    origin: [i32x8<S>; 2],
    /// −1 where the corners run the other way round.
    turned: i32x8<S>,
    /// A bit for each quadrangle that is drawn here, and for each that the run path must draw.
    pub drawn: u32,
    pub others: u32,
}

impl<S: Simd> Bounded<S> {
    /// Returns the blocks of a row between which the quadrangles lie.
    #[inline(always)]
    pub fn blocks(&self) -> Range<usize> {
        let (left, right): (Ints, Ints) = (self.columns[0].into(), self.columns[1].into());
        let (left, right) = (left.iter().min(), right.iter().max());
        left.map_or(0, |left| *left as usize / BLOCK)
            ..right.map_or(0, |right| (*right as usize).div_ceil(BLOCK))
    }
}

/// Returns the first row (or column) whose centre does not lie before `at`: `first_centre` in 32
/// bits, for coordinates within ±2²³.
#[inline(always)]
fn centre<S: Simd>(m: Lanes<S>, at: i32x8<S>) -> i32x8<S> {
    (at + m.int(127)) >> 8
}

impl QuadBatch {
    /// Gathers the positions of quadrangles from the front of `polygons`, until there are eight or
    /// a polygon has another shape. Returns how many it gathered.
    #[inline(always)]
    pub fn gather(&mut self, frame: &Frame, polygons: &[Listed]) -> usize {
        let vertices = frame.vertices();
        let mut k = 0;
        for listed in polygons.iter().take(BLOCK) {
            let corners = || frame.corners(&frame.polygons()[listed.index as usize]);
            let quadrangle = listed.is_quadrangle().then(corners);
            let Some(corners) = quadrangle.and_then(<[u32]>::as_array::<CORNERS>) else {
                break;
            };
            (self.polygons[k], self.vertices[k]) = (listed.index, *corners);
            for (i, corner) in corners.iter().enumerate() {
                let vertex = &vertices[*corner as usize];
                (self.x[i][k], self.y[i][k]) = (vertex.x.to_bits(), vertex.y.to_bits());
            }
            k += 1;
        }
        self.count = k;
        k
    }

    /// Bounds the quadrangles by a picture `width` pixels wide and by the rows of a tile, and
    /// decides which are drawn here.
    #[inline(always)]
    pub fn bound<S: Simd>(&mut self, m: Lanes<S>, width: usize, rows: &Range<usize>) -> Bounded<S> {
        let of = |corner: &Ints| m.load_int(corner);
        let load = |[a, b, c, d]: &[Ints; CORNERS]| [of(a), of(b), of(c), of(d)];
        let (x, y) = (load(&self.x), load(&self.y));
        let least = |of: [i32x8<S>; CORNERS]| of[0].min(of[1]).min(of[2].min(of[3]));
        let most = |of: [i32x8<S>; CORNERS]| of[0].max(of[1]).max(of[2].max(of[3]));
        let (left, right, top, bottom) = (least(x), most(x), least(y), most(y));
        let columns = [
            centre(m, left).max(m.int(0)),
            centre(m, right).min(m.int(width as i32)),
        ];
        let first = centre(m, top).max(m.int(rows.start as i32));
        let end = centre(m, bottom).min(m.int(rows.end as i32));
        let is_gathered = m.counted().less(m.int(self.count as i32));
        let is_there = columns[0].less(columns[1]) & first.less(end) & is_gathered;
        let reach = m.int(REACH);
        let is_small = (right - left).less(reach) & (bottom - top).less(reach);
        // A quadrangle is convex if it turns one way only: four turns of less than half a circle
        // make one full circle. A corner that turns back on itself has a turn of 0; then another
        // corner turns the other way, or there is no area.
        let (mut lefts, mut rights) = (m.int(0), m.int(0));
        for i in 0..CORNERS {
            let (j, k) = ((i + 1) % CORNERS, (i + 2) % CORNERS);
            let turn = (x[j] - x[i]) * (y[k] - y[j]) - (y[j] - y[i]) * (x[k] - x[j]);
            // The sign bit of `lefts` collects a turn below 0, the sign bit of `rights` a turn
            // over 0. Both are set if the quadrangle turns both ways.
            (lefts, rights) = (lefts | turn, rights | (m.int(0) - turn));
        }
        let is_drawn = is_there & is_small & m.int(-1).less(lefts & rights);
        m.store_int(first, &mut self.rows[0]);
        m.store_int((end - first) & is_drawn, &mut self.rows[1]);
        let all = m.int(-1);
        Bounded {
            // An undrawn quadrangle gets the range from i32::MAX to 0, which a minimum and a
            // maximum ignore.
            columns: [
                columns[0] | ((is_drawn ^ all) & m.int(i32::MAX)),
                columns[1] & is_drawn,
            ],
            first,
            origin: [left >> 8, left & m.int(-256)],
            turned: lefts >> 31,
            // The bits that are set are those where the inverted mask is 0.
            drawn: m.bits_not_negative(is_drawn ^ all),
            others: m.bits_not_negative((is_there ^ all) | is_drawn),
        }
    }

    /// Reads the `N` values of `cell` at the corners of the quadrangles in the mask `drawn`. `N` =
    /// 0 stands for any count.
    #[inline(always)]
    pub fn read<const N: usize>(
        &mut self,
        setup: &SetUp<'_>,
        cell: CellLayout,
        test: SampleDepth,
        drawn: u32,
    ) {
        let (vertices, varyings) = (setup.frame.vertices(), &setup.varyings);
        let count = ValueCount::<N>(cell.count());
        let all = N.saturating_sub(CellLayout::varying(0));
        let is_known = N > 0 && !cell.has_uniforms && varyings.count == all;
        for k in bits(drawn) {
            let polygon = self.polygons[k];
            for (corner, (&vertex, to)) in (0..).zip(self.vertices[k].iter().zip(&mut self.values))
            {
                let depth = test.of_corner(&vertices[vertex as usize]);
                let mut line: Values = Default::default();
                if is_known {
                    let varying = varyings.of_corner_with(all, polygon, [corner, vertex]);
                    cell.write(&mut line, depth, varying, || unreachable!("it has none"));
                } else {
                    let varying = varyings.of_corner(polygon, corner, vertex);
                    cell.write(&mut line, depth, varying, || setup.uniforms_of(polygon));
                }
                for (to, value) in to.iter_mut().zip(line).take(count.get()) {
                    to[k] = value;
                }
            }
        }
    }

    /// Finds the runs of the quadrangles in a tile of the scanlines `rows`, with `N` values, or
    /// `count` if `N` is 0.
    #[inline(always)]
    pub fn find_runs<S: Simd, const N: usize>(
        &mut self,
        m: Lanes<S>,
        bounded: &Bounded<S>,
        width: usize,
        rows: &Range<usize>,
        count: ValueCount<N>,
    ) {
        for edge in 0..CORNERS {
            self.start_edges(m, edge, bounded, rows, count);
        }
        let count = count.get();
        let [mut left, mut right] = [Side::new(m); 2];
        let most = self.rows[1].iter().copied().max().unwrap_or(0);
        // All quadrangles go down together, each from its own first row. On each side at most one
        // edge begins per row, and replaces the edge that ended above it. A quadrangle that has run
        // out of rows is stepped on to no effect: `draw` reads only its own rows.
        for (row, to) in (0..most).zip(&mut self.runs) {
            for edges in &self.edges {
                let begins = m.load_int(&edges.begins).simd_eq(m.int(row));
                if begins.any_true() {
                    let is_left = m.load_int(&edges.is_left).simd_lt(m.int(0));
                    for (side, is_this) in [(&mut left, is_left), (&mut right, !is_left)] {
                        let begins = begins & is_this;
                        if begins.any_true() {
                            side.begin(m, edges, begins, count);
                        }
                    }
                }
            }
            to.store(m, [&left, &right], width, count);
            left.advance(count);
            right.advance(count);
        }
    }

    /// Starts edge `edge` of each quadrangle at the row where it begins in a tile of the scanlines
    /// `rows`.
    #[inline(always)]
    fn start_edges<S: Simd, const N: usize>(
        &mut self,
        m: Lanes<S>,
        edge: usize,
        bounded: &Bounded<S>,
        rows: &Range<usize>,
        count: ValueCount<N>,
    ) {
        let all = m.int(-1);
        let (i, j) = (edge, (edge + 1) % CORNERS);
        let [xi, xj] = [m.load_int(&self.x[i]), m.load_int(&self.x[j])];
        let [yi, yj] = [m.load_int(&self.y[i]), m.load_int(&self.y[j])];
        let goes_down = yi.simd_lt(yj);
        let [top, bottom] = [yi.min(yj), yi.max(yj)];
        let [x, x_below] = [goes_down.select(xi, xj), goes_down.select(xj, xi)];
        let first = centre(m, top).max(m.int(rows.start as i32));
        let crosses = first.less(centre(m, bottom).min(m.int(rows.end as i32)));
        // From the upper end down to the centre of the first row.
        let past = (first << 8) + m.int(128) - top;
        let height = m.float(bottom - top);
        // The height is over 0 for every edge that crosses a row. The others divide by 0, and their
        // results are never read.
        let over = m.splat(256.0) / height;
        let size = [x - bounded.origin[1], x_below - x, bottom - top];
        let mut crossing = Crossings::new(m, past, size, over);
        crossing.pixel += bounded.origin[0];
        let to = &mut self.edges[edge];
        // −1 where the edge crosses no row: an or with all ones.
        m.store_int((first - bounded.first) | (crosses ^ all), &mut to.begins);
        // If the corners run clockwise, right edges go down. Running the other way flips every bit
        // of the mask.
        let is_right: i32x8<S> = goes_down.to_vector() ^ bounded.turned;
        m.store_int(is_right ^ all, &mut to.is_left);
        crossing.store(m, &mut to.crossing);
        let (t0, dt) = (m.float(past) / height, over);
        for n in 0..count.get() {
            let [from, to_next] = [m.load(&self.values[i][n]), m.load(&self.values[j][n])];
            let [a, b] = [
                goes_down.select(from, to_next),
                goes_down.select(to_next, from),
            ];
            let [at, step] = ramp(a, b, t0, dt);
            m.store(at, &mut to.at[n]);
            m.store(step, &mut to.step[n]);
        }
    }

    /// Draws quadrangle `k` into a tile whose first row is `top`.
    #[inline(always)]
    pub fn draw<S: Simd, const N: usize>(
        &self,
        m: Lanes<S>,
        k: usize,
        top: usize,
        writer: &mut Writer<'_, S, N>,
    ) {
        let [first, rows] = [self.rows[0][k] as usize, self.rows[1][k] as usize];
        for (row, run) in (first - top..).zip(&self.runs[..rows]) {
            let [start, end] = [run.pixels[0][k], run.pixels[1][k]];
            if start >= end {
                continue;
            }
            let depth = CellLayout::DEPTH;
            let place = RunPlace {
                row,
                depth: [run.at[depth][k], run.step[depth][k]],
            };
            draw_run(
                m,
                place,
                start as usize..end as usize,
                writer,
                #[inline(always)]
                |i, x| m.ramp(run.at[i][k], x as i32, run.step[i][k]),
            );
        }
    }
}

impl Runs {
    /// Stores the runs between two sides, in a picture `width` pixels wide.
    #[inline(always)]
    fn store<S: Simd>(
        &mut self,
        m: Lanes<S>,
        [left, right]: [&Side<S>; 2],
        width: usize,
        count: usize,
    ) {
        let (from, to) = (left.crossing.pixel, right.crossing.pixel);
        let start = from.max(m.int(0));
        m.store_int(start, &mut self.pixels[0]);
        m.store_int(to.min(m.int(width as i32)), &mut self.pixels[1]);
        let [t0, dt] = parameter(m, [&left.crossing, &right.crossing], start);
        for i in 0..count {
            let [at, step] = ramp(left.at[i], right.at[i], t0, dt);
            m.store(at, &mut self.at[i]);
            m.store(step, &mut self.step[i]);
        }
    }
}

/// Returns the parameter between two crossings at the centres of the pixels `start`, and its growth
/// from pixel to pixel. It is computed in `f64`, as in the span engine.
#[inline(always)]
fn parameter<S: Simd>(
    m: Lanes<S>,
    [left, right]: [&Crossings<S>; 2],
    start: i32x8<S>,
) -> [f32x8<S>; 2] {
    let [l, r] = [left.offset(m), right.offset(m)];
    let whole = wide(m, right.pixel - left.pixel);
    let before = wide(m, start - left.pixel);
    let one = f64x4::splat(m.0, 1.0);
    // Lanes without a run may divide by 0. Their pixel range is empty, so nothing reads the result.
    let dt = [
        one / (whole[0] + (l[0] - r[0])),
        one / (whole[1] + (l[1] - r[1])),
    ];
    let t0 = [(before[0] + l[0]) * dt[0], (before[1] + l[1]) * dt[1]];
    [
        m.0.narrow_f64x4(t0[0], t0[1]),
        m.0.narrow_f64x4(dt[0], dt[1]),
    ]
}

/// Converts integers to `f64`. They are below 2²⁴, so the `f32` in between is exact.
#[inline(always)]
fn wide<S: Simd>(m: Lanes<S>, x: i32x8<S>) -> [f64x4<S>; 2] {
    let (low, high) = m.0.widen_f32x8(m.float(x));
    [low, high]
}

/// Returns first values and growth, as [`ramp`](crate::shading::ramp) computes them.
#[inline(always)]
fn ramp<S: Simd>(a: f32x8<S>, b: f32x8<S>, t0: f32x8<S>, dt: f32x8<S>) -> [f32x8<S>; 2] {
    // Product and sum are rounded separately, as in the span engine: the bits must be equal.
    let difference = b - a;
    [a + difference * t0, difference * dt]
}
