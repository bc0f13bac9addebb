//! Which pixels triangles cover: by edge functions where they are small, by crossings where they are large, which is the same
//! rule bit for bit. It does not know what is drawn.

use crate::frame::{Frame, SubPixel, Vertex};
use crate::number::{Lanes, each};
use crate::raster::edge::{Crossing, first_centre};
use alloc::vec::Vec;
use core::ops::Range;

/// Up to this many columns coverage comes from edge functions, eight pixels at a time: 32 bits hold them.
const SMALL_WIDTH: i32 = 24;
/// And up to this many pixels from top to bottom: 24 · 64 · 2¹⁶ is below 2²⁷, of which each function is four at most.
const SMALL_HEIGHT: i32 = 64;
/// This many triangles are covered before they are drawn.
const BATCH: usize = 64;

/// The pixels of a triangle on one scanline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub row: u32,
    pub start: u32,
    pub end: u32,
    /// The barycentric coordinates of the second and the third corner at the centre of the first pixel.
    pub weights: [f32; 2],
}

/// A triangle that covers pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Covered {
    pub number: u32,
    /// Its corners, in the order in which its area is over 0.
    pub corners: [u32; 3],
    /// How much the barycentric coordinates of the second and the third corner grow from pixel to pixel.
    pub across: [f32; 2],
    /// How many of the runs that follow are its own.
    pub runs: u32,
}

/// Triangles and their pixels, until they are drawn.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    pub(super) triangles: Vec<Covered>,
    pub(super) runs: Vec<Run>,
}

impl Batch {
    /// Covers triangles from the front of `numbers` until there are enough, or there is a polygon of another shape; gives how
    /// many it took.
    #[inline(never)]
    pub fn fill<M: Lanes>(&mut self, m: M, frame: &Frame, numbers: &[u32], band: &Range<usize>) -> usize {
        self.triangles.clear();
        self.runs.clear();
        m.vectorize(
            #[inline(always)]
            || {
                for (taken, &number) in numbers.iter().enumerate() {
                    if self.triangles.len() == BATCH {
                        return taken;
                    }
                    let [a, b, c] = *frame.corners(&frame.polygons()[number as usize]) else { return taken };
                    self.cover(m, frame, number, [a, b, c], band);
                }
                numbers.len()
            },
        )
    }

    #[inline(always)]
    fn cover<M: Lanes>(&mut self, m: M, frame: &Frame, number: u32, [a, b, c]: [u32; 3], band: &Range<usize>) {
        let vertices = frame.vertices();
        let corners = [a, b, c].map(|v| &vertices[v as usize]);
        let place = |v: &Vertex| [v.x.to_bits(), v.y.to_bits()];
        let [[xa, ya], [xb, yb], [xc, yc]] = corners.map(place);
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
        let before = self.runs.len();
        let height = ya.max(yb).max(yc) - ya.min(yb).min(yc);
        // Corners outside the picture are far from its pixels.
        let is_whole = wide(xa.max(xb).max(xc)) - wide(xa.min(xb).min(xc)) <= wide(SMALL_WIDTH * 256);
        if is_whole && height < SMALL_HEIGHT * 256 {
            self.small(m, x, y, over_area, columns, rows);
        } else {
            self.large(x, y, over_area, columns, rows);
        }
        let runs = (self.runs.len() - before) as u32;
        if runs > 0 {
            self.triangles.push(Covered { number, corners, across, runs });
        }
    }

    /// Edge functions over the bounding box: f_ij > 0 inside, in sub-pixels², in 32 bits.
    #[inline(always)]
    fn small<M: Lanes>(
        &mut self,
        m: M,
        x: [i32; 3],
        y: [i32; 3],
        over_area: f32,
        columns: Range<i32>,
        rows: Range<i32>,
    ) {
        let (px, py) = (256 * columns.start + 128, 256 * rows.start + 128);
        let (mut at, mut step, mut down, mut least) = ([0; 3], [0; 3], [0; 3], [0; 3]);
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (dx, dy) = (x[j] - x[i], y[j] - y[i]);
            at[k] = dx * (py - y[i]) - dy * (px - x[i]);
            (step[k], down[k]) = (-256 * dy, 256 * dx);
            // Right and bottom edges do not own the centres that lie on them.
            least[k] = i32::from(!(dy < 0 || (dy == 0 && dx > 0)));
        }
        let width = columns.len();
        let outside = !0u32 << width; // at most 25 columns
        for row in rows {
            let mut inside = 0;
            let mut group = 0;
            while group < width {
                let k = group as i32;
                inside |= m.inside(each(|i| at[i] - least[i] + k * step[i]), step) << group;
                group += 8;
            }
            inside &= !outside;
            if inside != 0 {
                let first = inside.trailing_zeros();
                let weight = |i: usize| (at[i] + first as i32 * step[i]) as f32 * over_area;
                let weights = [weight(1), weight(2)];
                let left = columns.start as u32;
                let (start, end) = (left + first, left + 32 - inside.leading_zeros());
                self.runs.push(Run { row: row as u32, start, end, weights });
            }
            at = each(|i| at[i] + down[i]);
        }
    }

    /// Crossings of the edges with the scanlines, in exact integers.
    #[inline(always)]
    fn large(&mut self, x: [i32; 3], y: [i32; 3], over_area: f32, columns: Range<i32>, rows: Range<i32>) {
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
                    self.runs.push(Run { row: row as u32, start: start as u32, end: end as u32, weights });
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
    let centre = |bits: i32| first_centre(SubPixel::from_bits(bits));
    centre(from).max(limits.start as i32)..centre(to).min(limits.end as i32)
}

#[cfg(test)]
mod tests;
