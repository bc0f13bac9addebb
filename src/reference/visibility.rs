//! Which polygon is seen at each pixel.

use super::coverage::{Scanline, bounding_box};
use crate::frame::Frame;
use crate::picture::Picture;

/// What is seen at each pixel of a frame, whatever its shading.
#[derive(Clone, Debug, PartialEq)]
pub struct Visibility {
    /// The polygon seen: its place in [`Frame::polygons`], [`Visibility::NONE`] where there is none.
    pub polygons: Picture<u32>,
    /// Its depth (z/w, linear on the screen); infinite where there is none.
    pub depth: Picture<f64>,
    /// How much farther the next polygon behind it is: where this is within the rounding of depths, other arithmetic may
    /// see the other polygon. Infinite where no other covers the pixel, and where there is no depth test to decide.
    pub depth_gap: Picture<f64>,
}

impl Visibility {
    /// The number of no polygon.
    pub const NONE: u32 = u32::MAX;

    /// One more polygon, `depth` away, covers the pixel (`x`, `y`).
    fn add(&mut self, (x, y): (usize, usize), polygon: u32, depth: f64, depth_test: bool) {
        let seen = &mut self.depth.row_mut(y)[x];
        let is_visible = !depth_test || depth < *seen;
        if depth_test {
            // All others are behind the one seen so far: a new nearest has that one next behind it.
            let gap = &mut self.depth_gap.row_mut(y)[x];
            *gap = if is_visible { *seen - depth } else { gap.min(depth - *seen) };
        }
        if is_visible {
            *seen = depth;
            self.polygons.row_mut(y)[x] = polygon;
        }
    }
}

/// What is seen of `frame`: of the polygons that cover a pixel centre the nearest one, of equally near ones the first; or
/// without depth test the last one.
pub fn visibility(frame: &Frame) -> Visibility {
    let (width, height) = (frame.width(), frame.height());
    let mut visibility = Visibility {
        polygons: Picture::new(width, height, Visibility::NONE),
        depth: Picture::new(width, height, f64::INFINITY),
        depth_gap: Picture::new(width, height, f64::INFINITY),
    };
    let mut scanline = Scanline::new(frame);
    for (number, polygon) in (0..).zip(frame.polygons()) {
        let corners = frame.corners(polygon);
        let (columns, rows) = bounding_box(frame, corners);
        for y in rows {
            scanline.cut(corners, y);
            for x in columns.clone() {
                if let Some(weights) = scanline.weights(x) {
                    let depth = weights.sum(|v| f64::from(frame.vertices()[v].depth));
                    visibility.add((x, y), number, depth, frame.depth_test());
                }
            }
        }
    }
    visibility
}
