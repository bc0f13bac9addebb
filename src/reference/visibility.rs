//! Visibility: which polygon is seen at each pixel.

use super::coverage::{Scanline, VertexWeights, bounding_box};
use crate::frame::{DepthRange, Frame};
use crate::picture::Picture;
use crate::scene::{Clipping, DepthBuffer, DepthSource, HiddenSurfaces};
use core::ops::Range;

/// Which polygon is seen at each sample of a frame, whatever its shading. A pixel is one sample,
/// unless the frame has several per pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Visibility {
    /// The index of the seen polygon in [`Frame::polygons`], or [`Visibility::NONE`].
    pub polygons: Picture<u32>,
    /// The depth z of that polygon as the depth buffer stores it, 0 at the near plane and 1 at the
    /// far plane. Infinite where no polygon is seen.
    pub depth: Picture<f64>,
    /// The distance in z to the next polygon behind it, exact to `f64`. If it is within the
    /// rounding of depths, other arithmetic may see the other polygon. Infinite if no other polygon
    /// covers the pixel, or if there is no depth test.
    pub depth_gap: Picture<f64>,
}

impl Visibility {
    /// The index that stands for no polygon.
    pub const NONE: u32 = u32::MAX;

    /// Adds a polygon at `depth` that covers the pixel (`x`, `y`).
    fn add(&mut self, (x, y): (usize, usize), polygon: u32, depth: f64, depth_test: bool) {
        let seen = &mut self.depth.row_mut(y)[x];
        let is_visible = !depth_test || depth < *seen;
        if depth_test {
            // The stored polygon is the nearest so far. If the new one is nearer, the stored one is
            // next behind it.
            let gap = &mut self.depth_gap.row_mut(y)[x];
            *gap = if is_visible {
                // Infinite for the first polygon, as nothing is behind it.
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

/// Returns the depth buffer of a frame, or the default one if it has none.
fn buffer(frame: &Frame) -> DepthBuffer {
    match frame.hidden_surfaces() {
        HiddenSurfaces::ZBuffer(buffer) => buffer,
        HiddenSurfaces::Painter(_) | HiddenSurfaces::DrawOrder => DepthBuffer::default(),
    }
}

/// Returns z at the distance `w` under perspective: 0 at the near plane `n`, 1 at the far plane
/// `f`.
fn perspective_z(n: f64, f: f64, w: f64) -> f64 {
    // The eye looks along −z.
    let ndc = (f + n) / (f - n) + (1.0 / -w) * (2.0 * f * n) / (f - n); // L5
    (ndc + 1.0) / 2.0
}

/// Returns the value that a sample's depth test compares, less being nearer. Integer depths are
/// levels of z. Otherwise it is −1/w under perspective, which is linear on the screen as z is, and
/// still tells far distances apart.
fn depth(frame: &Frame, weights: &VertexWeights) -> f64 {
    let vertex = |v: usize| &frame.vertices()[v];
    let DepthBuffer { source, bits } = buffer(frame);
    let has_levels = bits.most().is_some();
    match (source, frame.depth_range()) {
        (DepthSource::Interpolated, DepthRange::Perspective { near, far }) if has_levels => {
            weights.sum(|v| perspective_z(near, far, -1.0 / vertex(v).depth))
        }
        (DepthSource::Interpolated, _) => weights.sum(|v| vertex(v).depth),
        (DepthSource::PerSample, DepthRange::Perspective { near, far }) => {
            let w = near / weights.sum(|v| vertex(v).inv_w);
            if has_levels {
                perspective_z(near, far, w)
            } else {
                -1.0 / w
            }
        }
        (DepthSource::PerSample, DepthRange::Orthographic { near: n, far: f }) => {
            let distance = weights.sum(|v| n + vertex(v).depth * (f - n));
            (distance - n) / (f - n)
        }
    }
}

/// Returns the values of [`depth`] at the near and at the far plane.
fn ends(frame: &Frame) -> [f64; 2] {
    match (buffer(frame).bits.most(), frame.depth_range()) {
        (None, DepthRange::Perspective { near, far }) => [-1.0 / near, -1.0 / far],
        _ => [0.0, 1.0],
    }
}

/// Rounds `depth` as the depth buffer stores it: to the nearest of 2ᵇ levels, or not at all.
fn kept(frame: &Frame, depth: f64) -> f64 {
    match buffer(frame).bits.most() {
        None => depth,
        Some(most) => libm::floor(depth.clamp(0.0, 1.0) * f64::from(most) + 0.5) / f64::from(most),
    }
}

/// Finds the polygon that is seen at each pixel centre of `frame`. It is the nearest polygon that
/// covers the centre, the first of equally near ones; without a depth test it is the last one.
pub fn visibility(frame: &Frame) -> Visibility {
    visibility_on_grid(frame, 1)
}

/// Finds the polygon that is seen at each `step`-th pixel centre of each `step`-th row, starting
/// with the first, as [`visibility`] does.
pub(super) fn visibility_on_grid(frame: &Frame, step: usize) -> Visibility {
    let [width, height] = [frame.width(), frame.height()].map(|side| side.div_ceil(step));
    // Point i of the grid is pixel i · step, so both ends are rounded up.
    let on_grid = |pixels: Range<usize>| pixels.start.div_ceil(step)..pixels.end.div_ceil(step);
    let mut visibility = Visibility {
        polygons: Picture::new(width, height, Visibility::NONE),
        depth: Picture::new(width, height, f64::INFINITY),
        depth_gap: Picture::new(width, height, f64::INFINITY),
    };
    let [nearest, farthest] = ends(frame);
    let mut scanline = Scanline::new(frame);
    for (index, polygon) in (0..).zip(frame.polygons()) {
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
                    if frame.clipping() == Clipping::NdcCube && !(nearest..=farthest).contains(&z) {
                        continue;
                    }
                    visibility.add((x, y), index, kept(frame, z), frame.depth_test());
                }
            }
        }
    }
    // Between the planes, z is linear in the compared value, whatever the planes' distances are.
    let range = farthest - nearest;
    let z = |depth: f64| {
        if depth.is_finite() {
            (depth - nearest) / range
        } else {
            depth
        }
    };
    Visibility {
        depth: visibility.depth.map(z),
        depth_gap: visibility.depth_gap.map(|gap| gap / range),
        ..visibility
    }
}
