//! Small frames for tests.

use super::coverage::{Scanline, bounding_box};
use crate::frame::{ClipCorner, Frame, FrameBuilder, SubPixel, Vertex};
use crate::mesh::Material;
use crate::picture::Picture;
use crate::scene::{Light, Lighting};
use alloc::string::String;
use alloc::vec::Vec;
use glam::DVec3;

/// A light along z, which shows the z of a unit normal as a grey: no ambient and no specular light.
pub(crate) fn z_light() -> Lighting {
    let material = Material {
        ambient: [0.0; 3],
        diffuse: [1.0; 3],
        specular: [0.0; 3],
        shininess: 1.0,
    };
    Lighting::new(
        &material,
        [0.0; 3],
        &[Light::directional(DVec3::Z, [1.0; 3])],
        DVec3::Z,
    )
}

/// A vertex at a position in pixels, with the first material.
pub(crate) fn vertex((x, y): (f64, f64), normal: [f32; 3]) -> Vertex {
    Vertex {
        x: SubPixel::from_num(x),
        y: SubPixel::from_num(y),
        depth: 0.5,
        inv_w: 1.0,
        normal,
        material: 0,
    }
}

/// A frame of polygons with these corners, in pixels.
pub(crate) fn shape(width: u32, height: u32, polygons: &[&[(f64, f64)]]) -> Frame {
    let mut builder = FrameBuilder::new(width, height);
    builder.lighting(z_light());
    for (source, polygon) in (0..).zip(polygons) {
        let corners: Vec<u32> = polygon
            .iter()
            .map(|&p| builder.vertex(vertex(p, [0.0, 0.0, 1.0])))
            .collect();
        builder.polygon(&corners, [0.0, 0.0, 1.0], source);
    }
    builder.finish().unwrap()
}

/// A frame of one polygon with these vertices under [`z_light`]. Its face normal points along y.
pub(crate) fn polygon_of(
    side: u32,
    vertices: &[Vertex],
    change: impl FnOnce(&mut FrameBuilder),
) -> Frame {
    let mut builder = FrameBuilder::new(side, side);
    builder.lighting(z_light());
    let corners: Vec<u32> = vertices.iter().map(|&v| builder.vertex(v)).collect();
    builder.polygon(&corners, [0.0, 1.0, 0.0], 0);
    change(&mut builder);
    builder.finish().unwrap()
}

/// The clip corner `vertex` at `t` between `a` and `b`, cut from a face whose normal points along
/// x.
pub(crate) fn between(vertex: u32, a: u32, b: u32, t: f32) -> ClipCorner {
    ClipCorner {
        vertex,
        a,
        b,
        t,
        face: [1.0, 0.0, 0.0],
    }
}

/// Counts the polygons that cover each pixel.
pub(crate) fn covered(frame: &Frame) -> Picture<u32> {
    let mut counts = Picture::new(frame.width(), frame.height(), 0);
    let mut scanline = Scanline::new(frame);
    for polygon in frame.polygons() {
        let (columns, rows) = bounding_box(frame, frame.corners(polygon));
        for y in rows {
            scanline.cut(frame.corners(polygon), y);
            for x in columns.clone() {
                counts.row_mut(y)[x] += u32::from(scanline.edges(x).is_some());
            }
        }
    }
    counts
}

/// Draws what [`covered`] counts in a [`shape`], one text per row, with dots for 0.
pub(crate) fn drawing(width: u32, height: u32, polygons: &[&[(f64, f64)]]) -> Vec<String> {
    let counts = covered(&shape(width, height, polygons));
    let sign = |&n: &u32| {
        if n == 0 {
            '.'
        } else {
            char::from_digit(n, 36).unwrap_or('#')
        }
    };
    (0..counts.height())
        .map(|y| counts.row(y).iter().map(sign).collect())
        .collect()
}
