//! Algorithms 1, 2, 5 and 8: which pixels a triangle fills.

use super::barycentric::{Weights, f, weights};
use super::{Inside, Raster, Reading, Ties, TriangleCorner};
use crate::frame::perspective::weights_in_space;
use glam::{DMat4, DVec2, DVec3};

/// Maps a point from the world to NDC (World_To_NDC). `matrix` is the camera's matrix to clip space
/// with depths in 0..=w, as [`Camera::clip_matrix`](crate::scene::Camera::clip_matrix) returns it.
///
/// A point behind the eye has a negative w. The division turns it over to the other side of the
/// picture, and a triangle that extends there is drawn wrongly. Therefore one clips first. The test
/// against the cube, pixel by pixel, comes too late.
pub fn world_to_ndc(matrix: &DMat4, v: DVec3) -> DVec3 {
    let clip = *matrix * v.extend(1.0);
    DVec3::new(clip.x, clip.y, 2.0 * clip.z - clip.w) / clip.w
}

/// Maps NDC to the screen (NDC_To_Screen): columns to the right and rows downward, in pixels,
/// rounded to the nearest 1/256 pixel as in a frame. Sums of such values are exact
/// ([`super::barycentric`]).
pub fn ndc_to_screen(ndc: DVec3, [width, height]: [usize; 2]) -> DVec2 {
    let nearest = |pixels: f64| libm::rint(pixels * 256.0) / 256.0;
    DVec2::new(
        nearest((ndc.x + 1.0) / 2.0 * width as f64),
        // Rows run downward and NDC upward. This mirrors the triangle, so back faces are recognised
        // in NDC.
        nearest((1.0 - ndc.y) / 2.0 * height as f64),
    )
}

/// Calls `fill` (Algorithm 1) for every pixel whose centre is in the triangle, with column, row and
/// the weights of the centre. `size` is the size of the grid in columns and rows.
///
/// Corners are in pixels, x to the right and y downward.
pub fn raster_triangle(
    triangle: [DVec2; 3],
    size: [usize; 2],
    inside: Inside,
    mut fill: impl FnMut(usize, usize, Weights),
) {
    let [a, b, c] = triangle;
    if f(a, b, c) == 0.0 {
        return; // no area, no coordinates
    }
    let (min, max) = (a.min(b).min(c), a.max(b).max(c));
    for x in centres(min.x, max.x, size[0]) {
        for y in centres(min.y, max.y, size[1]) {
            let [alpha, beta, gamma] =
                weights(triangle, DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
            let is_inside = |w: f64| match inside {
                Inside::Closed => (0.0..=1.0).contains(&w),
                Inside::Open => 0.0 < w && w < 1.0,
            };
            if is_inside(alpha) && is_inside(beta) && is_inside(gamma) {
                fill(x, y, [alpha, beta, gamma]);
            }
        }
    }
}

/// Returns the pixels, of a row of `count`, whose centres are in `min..=max`. The text continues
/// beyond the grid's edge, and would fill pixels there.
fn centres(min: f64, max: f64, count: usize) -> core::ops::Range<usize> {
    let first = libm::ceil(min - 0.5).max(0.0);
    let end = (libm::floor(max - 0.5) + 1.0).clamp(0.0, count as f64);
    (first as usize).min(end as usize)..end as usize
}

/// Fills a triangle (Algorithm 2) with colours interpolated between those of its corners. `places`
/// are positions as in [`raster_triangle`].
pub fn raster_colored_triangle(
    places: [DVec2; 3],
    colours: [DVec3; 3],
    inside: Inside,
    grid: &mut Raster,
) {
    raster_triangle(places, grid.size(), inside, |x, y, weights| {
        grid.fill(x, y, blend(weights, colours))
    });
}

/// Returns α v_a + β v_b + γ v_c.
pub(super) fn blend([alpha, beta, gamma]: Weights, [a, b, c]: [DVec3; 3]) -> DVec3 {
    alpha * a + beta * b + gamma * c
}

/// True if the camera sees the point.
fn is_in_cube(ndc: DVec3) -> bool {
    ndc.abs().max_element() <= 1.0
}

/// Fills the part of a triangle that lies in the cube (Algorithm 5) with colours interpolated
/// between those of its corners.
///
/// Algorithm 4 calls it with its corners a, b, c, and means their NDC and colours.
pub fn raster_colored_ndc_triangle(
    corners: &[TriangleCorner; 3],
    colours: [DVec3; 3],
    reading: Reading,
    grid: &mut Raster,
) {
    raster_ndc_triangle(corners, reading, grid, |weights| blend(weights, colours));
}

/// Runs Algorithm 5 with any colour as a function of the three weights. This is also the loop of
/// Algorithms 6 and 7.
pub(super) fn raster_ndc_triangle(
    corners: &[TriangleCorner; 3],
    reading: Reading,
    grid: &mut Raster,
    colour: impl Fn(Weights) -> DVec3,
) {
    let places = corners.map(|corner| ndc_to_screen(corner.ndc, grid.size()));
    raster_triangle(places, grid.size(), reading.inside, |x, y, weights| {
        if is_in_cube(blend(weights, corners.map(|corner| corner.ndc))) {
            grid.fill(
                x,
                y,
                colour(weights_in_space(
                    weights,
                    corners.map(|corner| corner.inv_w),
                )),
            );
        }
    });
}

/// Runs Algorithm 8 with any colour as a function of the three weights: the loop of Algorithm 5,
/// with back faces culled and a depth buffer.
pub(super) fn raster_visible_triangle(
    corners: &[TriangleCorner; 3],
    reading: Reading,
    grid: &mut Raster,
    colour: impl Fn(Weights) -> DVec3,
) {
    let ndc = corners.map(|corner| corner.ndc);
    let [a, b, c] = ndc;
    let cross = (c - b).cross(a - b);
    if reading.cull && cross.z < 0.0 {
        return;
    }
    let places = ndc.map(|ndc| ndc_to_screen(ndc, grid.size()));
    raster_triangle(places, grid.size(), reading.inside, |x, y, weights| {
        let ndc = blend(weights, ndc);
        let buffer = &mut grid.buffer.row_mut(y)[x];
        let is_seen = match reading.ties {
            Ties::Later => ndc.z <= *buffer, // !(NDC.z > buffer(x, y)): no value is NaN here
            Ties::Earlier => ndc.z < *buffer,
        };
        if is_in_cube(ndc) && is_seen {
            *buffer = ndc.z;
            grid.fill(
                x,
                y,
                colour(weights_in_space(
                    weights,
                    corners.map(|corner| corner.inv_w),
                )),
            );
        }
    });
}
