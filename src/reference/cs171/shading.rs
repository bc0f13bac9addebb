//! Algorithms 4, 6, 7 and 8: the colours of pixels, and a frame drawn by them.

use super::barycentric::Weights;
use super::rasterize::{blend, raster_ndc_triangle, raster_visible_triangle};
use super::{
    Corners, Raster, Reading, Shading, TriangleCorner, lighting, raster_colored_ndc_triangle,
};
use crate::frame::{Frame, ScreenVertex};
use crate::scene::{Interpolation, Lighting};
use alloc::vec::Vec;
use glam::DVec3;

/// Lights the corners and fills the triangle by Algorithm 5 (Algorithm 4).
pub fn gouraud_shading(corners: &Corners, light: &Lighting, reading: Reading, grid: &mut Raster) {
    let colours = corners.map(|corner| lighting(corner.world, corner.normal, light));
    raster_colored_ndc_triangle(corners, colours, reading, grid);
}

/// Lights the average corner and fills the triangle with its colour (Algorithm 6).
pub fn flat_shading(corners: &Corners, light: &Lighting, reading: Reading, grid: &mut Raster) {
    let colour = flat_colour(average(corners), light, reading);
    raster_ndc_triangle(corners, reading, grid, |_| colour);
}

/// Lights every pixel, with position and normal interpolated between the corners (Algorithm 7).
pub fn phong_shading(corners: &Corners, light: &Lighting, reading: Reading, grid: &mut Raster) {
    raster_ndc_triangle(corners, reading, grid, |weights| {
        phong_colour(corners, weights, light, reading)
    });
}

/// Draws with a depth buffer and without back faces. This is Algorithm 8, which is printed for
/// Gouraud shading, with the other two kinds of shading as well.
pub fn full_shading(
    shading: Shading,
    corners: &Corners,
    light: &Lighting,
    reading: Reading,
    grid: &mut Raster,
) {
    match shading {
        Shading::Flat => {
            let colour = flat_colour(average(corners), light, reading);
            raster_visible_triangle(corners, reading, grid, |_| colour);
        }
        Shading::Gouraud => {
            let colours = corners.map(|corner| lighting(corner.world, corner.normal, light));
            raster_visible_triangle(corners, reading, grid, |weights| blend(weights, colours));
        }
        Shading::Phong => {
            raster_visible_triangle(corners, reading, grid, |w| {
                phong_colour(corners, w, light, reading)
            });
        }
    }
}

/// Returns the average position and the average normal.
fn average(corners: &Corners) -> [DVec3; 2] {
    let [a, b, c] = corners;
    [
        (a.world + b.world + c.world) / 3.0,
        (a.normal + b.normal + c.normal) / 3.0,
    ]
}

/// Returns `n`, normalised if the reading asks for it.
fn read(n: DVec3, reading: Reading) -> DVec3 {
    if reading.normalise {
        n.normalize_or_zero()
    } else {
        n
    }
}

fn flat_colour([v_avg, n_avg]: [DVec3; 2], light: &Lighting, reading: Reading) -> DVec3 {
    lighting(v_avg, read(n_avg, reading), light)
}

fn phong_colour(corners: &Corners, weights: Weights, light: &Lighting, reading: Reading) -> DVec3 {
    let n = blend(weights, corners.map(|corner| corner.normal));
    let v = blend(weights, corners.map(|corner| corner.world));
    lighting(v, read(n, reading), light)
}

/// Draws the triangles of `frame` by Algorithm 8, or, without a depth test, by Algorithms 4 to 7 in
/// drawing order.
///
/// Polygons of more than three corners are skipped:
/// [`triangulated`](crate::frame::triangulate::triangulated) cuts them into triangles. The average
/// corner is that of the scene's polygon ([`Frame::mean`]). A corner that clipping made is not lit,
/// but interpolated between two that are. A point on the near or far plane itself may be lost to
/// rounding, because the cube is closed and tested in `f64`. For a frame with several samples per
/// pixel the grid consists of samples: see [`Raster::filtered`].
pub fn render(frame: &Frame, shading: Shading, reading: Reading) -> Raster {
    let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let corners = corners(frame);
    let light = |vertex: u32| &frame.lightings()[frame.material(vertex) as usize];
    let mut colours: Vec<DVec3> = match shading {
        Shading::Gouraud => {
            let lit = (0..).zip(&corners);
            lit.map(|(vertex, corner)| lighting(corner.world, corner.normal, light(vertex)))
                .collect()
        }
        Shading::Flat | Shading::Phong => Vec::new(),
    };
    if !colours.is_empty() {
        for cut in frame.clip_corners() {
            let (a, b) = (colours[cut.a as usize], colours[cut.b as usize]);
            colours[cut.vertex as usize] = a.lerp(b, f64::from(cut.t));
        }
    }
    let mut grid = Raster::new(frame.width(), frame.height(), wide(frame.background()));
    for polygon in frame.polygons() {
        let &[a, b, c] = frame.corners(polygon) else {
            continue;
        };
        let vertices = [a, b, c].map(|vertex| vertex as usize);
        let triangle = vertices.map(|vertex| corners[vertex]);
        let light = &frame.lightings()[polygon.material as usize];
        let colour: &dyn Fn(Weights) -> DVec3 = match shading {
            Shading::Flat => {
                let mean = frame.mean(polygon);
                let colour = flat_colour([wide(mean.position), wide(mean.normal)], light, reading);
                &move |_| colour
            }
            Shading::Gouraud => &|weights| blend(weights, vertices.map(|vertex| colours[vertex])),
            Shading::Phong => &|weights| phong_colour(&triangle, weights, light, reading),
        };
        if frame.depth_test() {
            raster_visible_triangle(&triangle, reading, &mut grid, colour);
        } else {
            raster_ndc_triangle(&triangle, reading, &mut grid, colour);
        }
    }
    grid
}

/// Returns the vertices of a frame as corners. NDC come from positions on the screen and depths;
/// world coordinates are relative to the eye.
fn corners(frame: &Frame) -> Vec<TriangleCorner> {
    let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let size = [frame.width() as f64, frame.height() as f64];
    let corner = |(vertex, v): (u32, &ScreenVertex)| TriangleCorner {
        world: wide(frame.position(vertex)),
        normal: wide(frame.normal(vertex)),
        ndc: DVec3::new(
            2.0 * v.x.to_num::<f64>() / size[0] - 1.0,
            1.0 - 2.0 * v.y.to_num::<f64>() / size[1],
            2.0 * frame.depth_range().z(v.depth) - 1.0,
        ),
        inv_w: match frame.interpolation() {
            Interpolation::Screen => 1.0,
            Interpolation::Perspective => v.inv_w,
        },
    };
    let mut all: Vec<TriangleCorner> = (0..).zip(frame.vertices()).map(corner).collect();
    for cut in frame.clip_corners() {
        let (a, b, t) = (all[cut.a as usize], all[cut.b as usize], f64::from(cut.t));
        let vertex = &mut all[cut.vertex as usize];
        (vertex.world, vertex.normal) = (a.world.lerp(b.world, t), a.normal.lerp(b.normal, t));
    }
    all
}
