//! Which pixels triangles cover: by edge functions where they are small, by crossings where they are large, which is the same
//! rule bit for bit. It does not know what is drawn.

use crate::frame::{Frame, ScreenVertex, SubPixel};
use crate::number::Lanes;
use crate::raster::edge::{Crossing, first_centre};
use alloc::vec::Vec;
use core::ops::Range;

/// Up to this many columns coverage comes from edge functions, eight pixels at a time: 32 bits hold them.
const SMALL_WIDTH: i32 = 24;
/// And up to this many pixels from top to bottom: 24 · 64 · 2¹⁶ is below 2²⁷, of which each function is four at most.
const SMALL_HEIGHT: i32 = 64;
/// This many triangles are covered before they are drawn.
const BATCH: usize = 64;

/// The pixels of a polygon on one scanline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub start: u16,
    pub end: u16,
    /// What they belong to: a triangle by its place in [`Cover::triangles`], or with [`Run::SPAN`] something else.
    pub source: u32,
    /// Of a triangle: the barycentric coordinates of the second and the third corner at the centre of the first pixel.
    pub weights: [f32; 2],
}

impl Run {
    /// Set in the source of runs that are no triangle's.
    pub const SPAN: u32 = 1 << 31;
}

/// A triangle that covers pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Covered {
    pub number: u32,
    pub material: u32,
    /// Its corners, in the order in which its area is over 0.
    pub corners: [u32; 3],
    /// How much the barycentric coordinates of the second and the third corner grow from pixel to pixel.
    pub across: [f32; 2],
}

/// The triangles of a band, and the runs of each of its scanlines in drawing order.
#[derive(Debug, Default)]
pub(crate) struct Cover {
    pub(super) triangles: Vec<Covered>,
    pub(super) runs: Vec<Vec<Run>>,
    fetched: Vec<Fetched>,
}

/// A triangle as it is read: x and y of its corners in sub-pixels.
#[derive(Clone, Copy, Debug)]
struct Fetched {
    number: u32,
    material: u32,
    corners: [u32; 3],
    places: [[i32; 2]; 3],
}

impl Cover {
    /// Empties it, for `rows` scanlines.
    pub fn clear(&mut self, rows: usize) {
        self.triangles.clear();
        self.runs.resize_with(rows.max(self.runs.len()), Vec::new);
        self.runs.iter_mut().for_each(Vec::clear);
    }

    /// Adds triangles from the front of `numbers`, until there are enough to look at something else, or there is a polygon of
    /// another shape; gives how many it took.
    #[inline(never)]
    pub fn add<M: Lanes>(&mut self, m: M, frame: &Frame, numbers: &[u32], band: &Range<usize>) -> usize {
        m.vectorize(
            #[inline(always)]
            || {
                self.fetch(frame, numbers);
                let fetched = core::mem::take(&mut self.fetched);
                for triangle in &fetched {
                    self.cover(m, frame, triangle, band);
                }
                let taken = fetched.len();
                self.fetched = fetched;
                taken
            },
        )
    }

    /// Reads triangles in a loop of its own: nothing in it has to be guessed, so that the reads of many overlap. Their places
    /// in memory are far from one another, and waiting for them took a third of the time.
    #[inline(always)]
    fn fetch(&mut self, frame: &Frame, numbers: &[u32]) {
        let (polygons, vertices) = (frame.polygons(), frame.vertices());
        self.fetched.clear();
        for &number in numbers.iter().take(BATCH) {
            let polygon = &polygons[number as usize];
            let [a, b, c] = *frame.corners(polygon) else { return };
            let place = |v: &ScreenVertex| [v.x.to_bits(), v.y.to_bits()];
            let places = [a, b, c].map(|v| place(&vertices[v as usize]));
            self.fetched.push(Fetched { number, material: polygon.material, corners: [a, b, c], places });
        }
    }

    #[inline(always)]
    fn cover<M: Lanes>(&mut self, m: M, frame: &Frame, fetched: &Fetched, band: &Range<usize>) {
        let Fetched { number, material, corners: [a, b, c], places: [[xa, ya], [xb, yb], [xc, yc]] } = *fetched;
        let columns = within(xa.min(xb).min(xc), xa.max(xb).max(xc), 0..frame.width());
        let rows = within(ya.min(yb).min(yc), ya.max(yb).max(yc), band.clone());
        if columns.is_empty() || rows.is_empty() {
            return;
        }
        let wide = i64::from;
        let area = wide(xb - xa) * wide(yc - ya) - wide(xc - xa) * wide(yb - ya);
        if area == 0 {
            return;
        }
        let (corners, x, y) = match area > 0 {
            true => ([a, b, c], [xa, xb, xc], [ya, yb, yc]),
            false => ([a, c, b], [xa, xc, xb], [ya, yc, yb]),
        };
        let over_area = 1.0 / area.abs() as f32;
        // From column to column the edge functions grow by the height of the edge, 256 sub-pixels at a time.
        let scale = 256.0 * over_area;
        let across = [(y[2] - y[0]) as f32 * scale, (y[0] - y[1]) as f32 * scale];
        let height = ya.max(yb).max(yc) - ya.min(yb).min(yc);
        // Corners outside the picture are far from its pixels.
        let is_whole = wide(xa.max(xb).max(xc)) - wide(xa.min(xb).min(xc)) <= wide(SMALL_WIDTH * 256);
        let covers = if is_whole && height < SMALL_HEIGHT * 256 {
            self.small(m, [x, y], over_area, columns, rows, band.start as i32)
        } else {
            self.large([x, y], over_area, columns, rows, band.start as i32);
            true
        };
        if covers {
            self.triangles.push(Covered { number, material, corners, across });
        }
    }

    /// Edge functions over the bounding box: f_ij > 0 inside, in sub-pixels², in 32 bits. Whether any pixel is covered.
    #[inline(always)]
    fn small<M: Lanes>(
        &mut self,
        m: M,
        [x, y]: [[i32; 3]; 2],
        over_area: f32,
        columns: Range<i32>,
        rows: Range<i32>,
        top: i32,
    ) -> bool {
        let source = self.triangles.len() as u32;
        let (px, py) = (256 * columns.start + 128, 256 * rows.start + 128);
        // At the first centre, from column to column, from row to row; and 1 for right and bottom edges, which do not own the
        // centres that lie on them.
        let edge = |i: usize, j: usize| {
            let (dx, dy) = (x[j] - x[i], y[j] - y[i]);
            let owns = dy < 0 || (dy == 0 && dx > 0);
            (dx * (py - y[i]) - dy * (px - x[i]), -256 * dy, 256 * dx, i32::from(!owns))
        };
        let edges = [edge(1, 2), edge(2, 0), edge(0, 1)];
        let (step, down) = (edges.map(|e| e.1), edges.map(|e| e.2));
        let mut lines = m.edges(edges.map(|e| e.0 - e.3), step);
        let (mut b, mut c) = (edges[1].0, edges[2].0);
        let (left, width) = (columns.start as u32, columns.len());
        let within = !(!0u32 << width); // at most 25 columns
        let mut covers = false;
        for runs in &mut self.runs[(rows.start - top) as usize..(rows.end - top) as usize] {
            let mut inside = m.inside(lines);
            if width > 8 {
                let second = m.beside(lines, step.map(|s| 8 * s));
                inside |= m.inside(second) << 8;
                if width > 16 {
                    let third = m.beside(second, step.map(|s| 8 * s));
                    inside |= m.inside(third) << 16 | m.inside(m.beside(third, step.map(|s| 8 * s))) << 24;
                }
            }
            inside &= within;
            if inside != 0 {
                let first = inside.trailing_zeros();
                let weight = |at: i32, step: i32| (at + first as i32 * step) as f32 * over_area;
                let weights = [weight(b, step[1]), weight(c, step[2])];
                let (start, end) = ((left + first) as u16, (left + 32 - inside.leading_zeros()) as u16);
                runs.push(Run { start, end, source, weights });
                covers = true;
            }
            lines = m.beside(lines, down);
            (b, c) = (b + down[1], c + down[2]);
        }
        covers
    }

    /// Crossings of the edges with the scanlines, in exact integers.
    #[inline(always)]
    fn large(&mut self, [x, y]: [[i32; 3]; 2], over_area: f32, columns: Range<i32>, rows: Range<i32>, first_row: i32) {
        let source = self.triangles.len() as u32;
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
                    let weight = |i: usize, j: usize| function(i, j, start, row) as f32 * over_area;
                    let weights = [weight(2, 0), weight(0, 1)];
                    let (start, end) = (start as u16, end as u16);
                    self.runs[(row - first_row) as usize].push(Run { start, end, source, weights });
                }
                long.advance();
                short.advance();
            }
        }
    }
}

/// The pixels whose centres lie between two coordinates, within limits.
#[inline(always)]
fn within(from: i32, to: i32, limits: Range<usize>) -> Range<i32> {
    // `first_centre`, in 32 bits: coordinates have 24.
    let centre = |bits: i32| (bits + 127) >> 8;
    centre(from).max(limits.start as i32)..centre(to).min(limits.end as i32)
}

#[cfg(test)]
mod tests;
