//! Visibility: the polygon that is seen at each pixel.

use super::coverage::{Scanline, VertexWeights, bounding_box};
use crate::frame::{DepthRange, Frame};
use crate::picture::Picture;
use crate::scene::{Clipping, DepthBuffer, DepthSource, HiddenSurfaces};
use core::ops::Range;

/// The polygon seen at each sample of a frame, whatever its shading: at each pixel, unless it has several samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Visibility {
    /// The index of the polygon seen in [`Frame::polygons`], [`Visibility::NONE`] where there is none.
    pub polygons: Picture<u32>,
    /// The depth of that polygon as it is compared, 0 at the near plane, 1 at the far plane; infinite where there is none.
    pub depth: Picture<f64>,
    /// The distance to the next polygon behind it: where it is within the rounding of depths, other arithmetic may see the
    /// other polygon. Infinite where no other covers the pixel, and where there is no depth test to decide.
    pub depth_gap: Picture<f64>,
}

impl Visibility {
    /// The number of no polygon.
    pub const NONE: u32 = u32::MAX;

    /// Adds a polygon, `depth` away, that covers the pixel (`x`, `y`).
    fn add(&mut self, (x, y): (usize, usize), polygon: u32, depth: f64, depth_test: bool) {
        let seen = &mut self.depth.row_mut(y)[x];
        let is_visible = !depth_test || depth < *seen;
        if depth_test {
            // All others are behind the one seen so far: a new nearest has that one next behind it.
            let gap = &mut self.depth_gap.row_mut(y)[x];
            *gap = if is_visible {
                *seen - depth
            } else {
                gap.min(depth - *seen)
            };
        }
        if is_visible {
            *seen = depth;
            self.polygons.row_mut(y)[x] = polygon;
        }
    }
}

/// Returns the depth buffer of a frame; the default one if it has none.
fn buffer(frame: &Frame) -> DepthBuffer {
    match frame.hidden_surfaces() {
        HiddenSurfaces::ZBuffer(buffer) => buffer,
        HiddenSurfaces::Painter(_) | HiddenSurfaces::DrawOrder => DepthBuffer::default(),
    }
}

/// Returns the depth of a sample that is made of a polygon's corners in these shares.
fn depth(frame: &Frame, weights: &VertexWeights) -> f64 {
    let vertex = |v: usize| &frame.vertices()[v];
    let interpolated = || weights.sum(|v| f64::from(vertex(v).depth));
    match (buffer(frame).source, frame.depth_range()) {
        (DepthSource::Interpolated, _) => interpolated(),
        (DepthSource::PerSample, DepthRange::Perspective { near: n, far: f }) => {
            // The eye looks along −z; 1/z is linear on the screen.
            let z = -n / weights.sum(|v| f64::from(vertex(v).inv_w));
            let ndc = (f + n) / (f - n) + (1.0 / z) * (2.0 * f * n) / (f - n); // L5
            (ndc + 1.0) / 2.0
        }
        (DepthSource::PerSample, DepthRange::Orthographic { near: n, far: f }) => {
            let distance = weights.sum(|v| n + f64::from(vertex(v).depth) * (f - n));
            (distance - n) / (f - n)
        }
    }
}

/// Rounds `depth` as the depth buffer stores it: not at all, or to the nearest of 2ᵇ levels.
fn kept(frame: &Frame, depth: f64) -> f64 {
    match buffer(frame).bits.most() {
        None => depth,
        Some(most) => libm::floor(depth.clamp(0.0, 1.0) * f64::from(most) + 0.5) / f64::from(most),
    }
}

/// Finds the polygon seen at each pixel centre of `frame`: the nearest one that covers it, the first of equally near ones; or
/// without depth test the last one.
pub fn visibility(frame: &Frame) -> Visibility {
    visibility_on_grid(frame, 1)
}

/// Finds the polygon seen at each `step`-th pixel centre of each `step`-th row, from the first on, as [`visibility`] does.
pub(super) fn visibility_on_grid(frame: &Frame, step: usize) -> Visibility {
    let [width, height] = [frame.width(), frame.height()].map(|side| side.div_ceil(step));
    let on_grid = |pixels: Range<usize>| pixels.start.div_ceil(step)..pixels.end.div_ceil(step);
    let mut visibility = Visibility {
        polygons: Picture::new(width, height, Visibility::NONE),
        depth: Picture::new(width, height, f64::INFINITY),
        depth_gap: Picture::new(width, height, f64::INFINITY),
    };
    let mut scanline = Scanline::new(frame);
    for (number, polygon) in (0..).zip(frame.polygons()) {
        let corners = frame.corners(polygon);
        let (columns, rows) = bounding_box(frame, corners);
        let (columns, rows) = (on_grid(columns), on_grid(rows));
        if columns.is_empty() {
            continue;
        }
        for y in rows {
            scanline.cut(corners, y * step);
            for x in columns.clone() {
                if let Some(weights) = scanline.weights(x * step) {
                    let z = depth(frame, &weights);
                    if frame.clipping() == Clipping::NdcCube && !(0.0..=1.0).contains(&z) {
                        continue;
                    }
                    visibility.add((x, y), number, kept(frame, z), frame.depth_test());
                }
            }
        }
    }
    visibility
}
