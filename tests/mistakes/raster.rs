//! Filling: the pixels of triangles and polygons, and the varyings at each pixel.

use crate::options::{BoxEnd, SamplePoint, Weights};
use crate::variation::Edges;
use std::array::from_fn;

/// The varyings of a corner: position, normal, and what is computed there.
pub const CARRIED: usize = 9;

/// A corner of a polygon on the screen.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// The distance from the left and from the top, in pixels.
    pub x: f64,
    pub y: f64,
    /// The depth, 0 at the near plane and 1 at the far one.
    pub depth: f64,
    /// The weight of the varyings: 1/w under perspective interpolation.
    pub weight: f64,
    /// The varyings.
    pub carried: [f64; CARRIED],
}

/// A pixel of a polygon.
pub struct Fragment {
    pub x: usize,
    pub y: usize,
    pub depth: f64,
    pub carried: [f64; CARRIED],
}

/// The settings for filling polygons.
#[derive(Clone, Copy)]
pub struct Filler {
    pub width: usize,
    pub height: usize,
    pub edges: Edges,
    pub sample_point: SamplePoint,
    pub weights: Weights,
    pub box_end: BoxEnd,
}

impl Filler {
    /// Returns the offset of the tested point from the upper left corner of its pixel.
    fn offset(&self) -> f64 {
        match self.sample_point {
            SamplePoint::Centre => 0.5,
            SamplePoint::Corner => 0.0,
        }
    }

    /// Returns the first pixel whose point is at `from` or later, and the one after the last whose
    /// point is at `to` or earlier, within a picture of `size`.
    fn pixels(&self, from: f64, to: f64, size: usize) -> (usize, usize) {
        let end = match self.box_end {
            BoxEnd::Inclusive => (to - self.offset()).floor() + 1.0,
            BoxEnd::Exclusive => to.floor(),
        };
        // Conversions of floats saturate.
        let first = (from - self.offset()).ceil().max(0.0) as usize;
        (first, (end.max(0.0) as usize).min(size))
    }

    /// Calls `draw` for each pixel of a triangle of either winding.
    pub fn triangle(&self, corners: [&Corner; 3], draw: &mut impl FnMut(Fragment)) {
        let [a, mut b, mut c] = corners;
        let area = cross(a, b, c.x, c.y);
        if area < 0.0 {
            (b, c) = (c, b);
        }
        let area = area.abs();
        if !(area > 0.0 && area.is_finite()) {
            return;
        }
        let low = |of: fn(&Corner) -> f64| of(a).min(of(b)).min(of(c));
        let high = |of: fn(&Corner) -> f64| of(a).max(of(b)).max(of(c));
        let (left, right) = self.pixels(low(|c| c.x), high(|c| c.x), self.width);
        let (top, bottom) = self.pixels(low(|c| c.y), high(|c| c.y), self.height);
        let owned = [(b, c), (c, a), (a, b)].map(|(from, to)| self.is_owned(from, to));
        for y in top..bottom {
            let py = y as f64 + self.offset();
            for x in left..right {
                let px = x as f64 + self.offset();
                let w = [
                    cross(b, c, px, py),
                    cross(c, a, px, py),
                    cross(a, b, px, py),
                ];
                if (0..3).all(|i| w[i] > 0.0 || w[i] == 0.0 && owned[i]) {
                    let shares = w.map(|w| w / area);
                    draw(self.fragment([x, y], [a, b, c], shares));
                }
            }
        }
    }

    /// True if pixels whose point lies on the edge belong to the triangle on its right-hand side.
    fn is_owned(&self, from: &Corner, to: &Corner) -> bool {
        let is_top_or_left = to.y < from.y || to.y == from.y && to.x > from.x;
        is_top_or_left == (self.edges != Edges::BottomRight)
    }

    fn fragment(&self, [x, y]: [usize; 2], corners: [&Corner; 3], shares: [f64; 3]) -> Fragment {
        let sum = |of: &dyn Fn(&Corner) -> f64| -> f64 {
            shares
                .iter()
                .zip(corners)
                .map(|(share, corner)| share * of(corner))
                .sum()
        };
        let depth = sum(&|corner| corner.depth);
        let [s, t, u] = match self.weights {
            Weights::Right => shares,
            Weights::Rotated => [shares[1], shares[2], shares[0]],
        };
        let [a, b, c] = corners;
        let [s, t, u] = [s * a.weight, t * b.weight, u * c.weight];
        let whole = s + t + u;
        let [s, t, u] = [s / whole, t / whole, u / whole];
        let carried = from_fn(|i| s * a.carried[i] + t * b.carried[i] + u * c.carried[i]);
        Fragment {
            x,
            y,
            depth,
            carried,
        }
    }

    /// Calls `draw` for each pixel of a polygon of any shape, scan line by scan line (L21 3).
    /// Varyings are interpolated along edges, then between them.
    pub fn polygon(&self, corners: &[Corner], draw: &mut impl FnMut(Fragment)) {
        let low = corners.iter().map(|c| c.y).fold(f64::INFINITY, f64::min);
        let high = corners
            .iter()
            .map(|c| c.y)
            .fold(f64::NEG_INFINITY, f64::max);
        let (top, bottom) = self.pixels(low, high, self.height);
        let mut crossings: Vec<Corner> = Vec::new();
        for y in top..bottom {
            let py = y as f64 + self.offset();
            crossings.clear();
            for (i, from) in corners.iter().enumerate() {
                let to = &corners[(i + 1) % corners.len()];
                // Half-open, so that a corner on the scan line counts once.
                if (from.y <= py) != (to.y <= py) {
                    let (upper, lower) = if from.y < to.y {
                        (from, to)
                    } else {
                        (to, from)
                    };
                    crossings.push(between(upper, lower, (py - upper.y) / (lower.y - upper.y)));
                }
            }
            crossings.sort_by(|a, b| a.x.total_cmp(&b.x));
            for ends in crossings.chunks_exact(2) {
                self.span(y, &ends[0], &ends[1], draw);
            }
        }
    }

    fn span(&self, y: usize, left: &Corner, right: &Corner, draw: &mut impl FnMut(Fragment)) {
        let (first, end) = self.pixels(left.x, right.x, self.width);
        for x in first..end {
            let px = x as f64 + self.offset();
            if px >= right.x {
                break;
            }
            let at = between(left, right, (px - left.x) / (right.x - left.x));
            draw(Fragment {
                x,
                y,
                depth: at.depth,
                carried: at.carried,
            });
        }
    }
}

/// Returns twice the area of the triangle from an edge to a point: over 0 where the edge turns
/// clockwise around it on a screen whose y points downward.
fn cross(from: &Corner, to: &Corner, x: f64, y: f64) -> f64 {
    (to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x)
}

/// Returns the point at `t` from `a` to `b`.
pub fn between(a: &Corner, b: &Corner, t: f64) -> Corner {
    let (s, t) = (1.0 - t, t);
    let weight = s * a.weight + t * b.weight;
    let (p, q) = (s * a.weight / weight, t * b.weight / weight);
    Corner {
        x: s * a.x + t * b.x,
        y: s * a.y + t * b.y,
        depth: s * a.depth + t * b.depth,
        weight,
        carried: from_fn(|i| p * a.carried[i] + q * b.carried[i]),
    }
}
