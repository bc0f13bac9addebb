//! Ranges over a polygon: how many steps cross it and how much its attributes vary. Error bounds
//! need both.

use crate::frame::row_tiles::{STEEPEST, TILE_HEIGHT, TINY_HEIGHT, TINY_WIDTH};
use crate::frame::{Frame, Polygon, ScreenVertex, SubPixel};
use crate::scene::Interpolation;
#[allow(unused_imports)] // named by the documentation
use crate::shading::Variant;
use glam::DVec3;

/// The size of a polygon in the picture, and the variation of its vertex attributes.
pub(crate) struct Extent {
    /// The most steps from a corner to a pixel: down the rows and across the columns, within the
    /// picture.
    pub steps: f64,
    /// The largest weight of perspective over the smallest; 1 without perspective.
    pub weights: f64,
    /// The least cosine c of the angles between the corners' normals and their mean direction m; −1
    /// if they have none.
    ///
    /// No normal between the corners is shorter than c: it is a convex combination N of theirs, and
    /// |N| ≥ N·m ≥ c. A corner that clipping made is replaced by the ends of the edge that was cut.
    pub cosine: f64,
    /// How much barycentric coordinates grow at most, in the row engine, from the pixel where a
    /// triangle's values begin to a covered one.
    pub growth: f64,
    /// True if the row engine may draw the polygon by barycentric coordinates.
    is_triangle: bool,
}

impl Extent {
    pub fn of(frame: &Frame, polygon: &Polygon) -> Extent {
        let corners = frame.corners(polygon);
        let vertex = |&v: &u32| &frame.vertices()[v as usize];
        let steps = |coordinate: fn(&ScreenVertex) -> SubPixel, limit: usize| {
            let all = corners.iter().map(|v| coordinate(vertex(v)).to_bits());
            let (low, high) = (all.clone().min(), all.max());
            let range = high.unwrap_or(0) - low.unwrap_or(0);
            (range as usize / 256 + 1).min(limit)
        };
        let steps = steps(|v| v.y, frame.height()) + steps(|v| v.x, frame.width());
        let (least, most) = range(corners.iter().map(|v| vertex(v).inv_w));
        Extent {
            steps: steps as f64,
            weights: match frame.interpolation() {
                Interpolation::Screen => 1.0,
                Interpolation::Perspective => f64::max(1.0, most / least),
            },
            cosine: least_cosine(frame, corners),
            growth: match corners {
                [a, b, c] => growth([a, b, c].map(vertex)),
                _ => 0.0,
            },
            is_triangle: corners.len() == 3,
        }
    }

    /// Returns the largest distance between the normals of two corners: 2 sin θ, as all are within
    /// θ of one direction.
    pub fn apart(&self) -> f64 {
        if self.cosine > 0.0 {
            2.0 * libm::sqrt(f64::max(0.0, 1.0 - self.cosine * self.cosine))
        } else {
            2.0
        }
    }

    /// Returns the roundings of values of at most 1 over a triangle in the row engine, as
    /// [`Variant::bound`] derives them; 0 for other polygons. `step` is
    /// [`Roundings::step`](super::Roundings::step), and corners differ by `apart`.
    pub fn triangle_roundings(&self, step: f64, apart: f64) -> f64 {
        if !self.is_triangle {
            return 0.0;
        }
        let sums = self.steps.min((TILE_HEIGHT + 1) as f64);
        let largest = 1.0 + 2.0 * self.growth * apart;
        step.min(2.0) * sums * largest + (15.0 + 22.0 * self.growth) * apart
    }
}

/// Returns the least and the greatest of all values.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

pub(crate) fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// Calls `visit` with all corners. A corner that clipping made is replaced by the two ends of the
/// edge it lies on, again and again until all are the scene's own.
pub(crate) fn for_each_end(frame: &Frame, corners: &[u32], visit: &mut dyn FnMut(u32)) {
    for &corner in corners {
        match frame.clip_corner(corner) {
            Some(cut) => for_each_end(frame, &[cut.a, cut.b], visit),
            None => visit(corner),
        }
    }
}

/// Returns the least cosine of the angles between the corners' normals and their mean direction.
fn least_cosine(frame: &Frame, corners: &[u32]) -> f64 {
    let mut sum = DVec3::ZERO;
    for_each_end(frame, corners, &mut |v| sum += wide(frame.normal(v)));
    let Some(mean) = sum.try_normalize() else {
        // Normals that cancel have no mean direction, so nothing is known about them.
        return -1.0;
    };
    let mut least = 1.0;
    for_each_end(frame, corners, &mut |v| {
        least = f64::min(least, wide(frame.normal(v)).dot(mean));
    });
    least
}

/// Returns [`Extent::growth`] of a triangle.
///
/// Values begin at the first pixel of a block and of a tile, up to 7 columns and 15 rows away. The
/// function of an edge that is w columns wide and h rows high grows by h per column and by w per
/// row, over the doubled area. Tiny triangles have exact coordinates at every pixel. Slivers have
/// them at the first pixel of every row, and no other pixel of a row is more than 1 away.
fn growth(corners: [&ScreenVertex; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| [v.x, v.y].map(|at| f64::from(at.to_bits()) / 256.0));
    let size = |i: usize| {
        let (low, high) = range([a[i], b[i], c[i]].into_iter());
        high - low
    };
    let (width, height) = (size(0), size(1));
    let area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs();
    let is_tiny = width < f64::from(TINY_WIDTH) && height < f64::from(TINY_HEIGHT);
    let is_steep = f64::max(width, height) > f64::from(STEEPEST) * area;
    if is_tiny || is_steep {
        return 0.0;
    }
    let rows = height.min((TILE_HEIGHT - 1) as f64);
    (height * (width + 7.0) + width * rows) / area
}
