//! What is seen besides shaded colours: depth, normals, polygon numbers, coverage, and varyings themselves.
//!
//! A mean of depths or of polygon numbers means nothing: those are of single samples, [`Frame::width`] × [`Frame::height`] of
//! them, and where a frame has several a pixel they are not filtered.
//!
//! Colours of vertices and checkerboards (L5, Interpolation Across Triangles) are linear on the screen, or, if the frame asks for
//! it, linear in space for one division a pixel. Under a perspective camera the first bends the squares of a board at every
//! diagonal (L5, *What's wrong?*), the second does not.

use super::barycentric::{self, Edges};
use super::setup::{Varyings, unit};
use super::spans::{NOTHING, scan};
use super::target::{draw_anyhow, draw_rows, linear_picture, linear_samples};
use crate::frame::Frame;
use crate::picture::{LinearPicture, Picture, Rgb};
use crate::scene::Interpolation;
use crate::shading::ramp;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// Varyings of no numbers: for what is only seen.
fn nothing() -> Varyings<'static> {
    Varyings::of_vertices(vec![], 0)
}

/// Returns the number of the polygon seen at each pixel, an index into [`Frame::polygons`], or [`NOTHING`].
///
/// It does not depend on the shading method.
pub fn polygon_numbers(frame: &Frame) -> Picture<u32> {
    let mut picture = Picture::new(frame.width(), frame.height(), NOTHING);
    scan(frame, &nothing(), &mut |row, line, _| {
        for (x, number) in picture.row_mut(row).iter_mut().enumerate() {
            *number = line.polygon(x);
        }
    });
    picture
}

/// Returns the depth at each pixel as it is compared, 0 at the near plane, 1 at the far plane; infinite where nothing is seen.
pub fn depth(frame: &Frame) -> Picture<f32> {
    let mut picture = Picture::new(frame.width(), frame.height(), f32::INFINITY);
    scan(frame, &nothing(), &mut |row, line, _| {
        for (pixel, depth) in picture.row_mut(row).iter_mut().zip(line.depth()) {
            *pixel = depth;
        }
    });
    picture
}

/// Gives every span of every polygon, hidden ones too: polygon number, row, and the pixels whose centres it covers.
///
/// Rows come in order, and within a row polygons in drawing order. A pixel is covered when its centre has an odd number of the
/// polygon's edges to its left.
pub fn coverage(frame: &Frame, mut visit: impl FnMut(u32, usize, Range<usize>)) {
    scan(frame, &nothing(), &mut |row, line, _| {
        for span in line.spans() {
            visit(span.polygon, row, span.start as usize..span.end as usize);
        }
    });
}

/// Takes the numbers that are interpolated to a pixel.
type Visit<'a> = dyn FnMut(usize, usize, &[f32]) + 'a;

/// Gives the varyings at each pixel that is seen: column, row, numbers.
fn interpolate(
    frame: &Frame,
    varyings: &Varyings<'_>,
    edges: Option<Edges>,
    visit: &mut Visit<'_>,
) {
    let count = varyings.count;
    let mut starts = Vec::new();
    match edges {
        Some(edges) => {
            barycentric::scan(frame, varyings, edges, &mut |_, row, columns, starts| {
                for (x, start) in columns.iter().zip(starts.chunks_exact(2 * count)) {
                    visit(*x, row, &start[..count]);
                }
            });
        }
        None => scan(frame, varyings, &mut |row, line, edges| {
            line.runs(|span, pixels| {
                starts.clear();
                edges.start(span, pixels.start as u32 - span.start, &mut starts);
                let (at, step) = starts.split_at_mut(count);
                for x in pixels {
                    visit(x, row, at);
                    at.iter_mut().zip(&*step).for_each(|(at, step)| *at += step);
                }
            });
        }),
    }
}

/// Returns the unit normal at each pixel, in world space, as (N + 1)/2; alpha 0 where nothing is seen.
pub fn normals(frame: &Frame) -> LinearPicture {
    let varyings = of_vertices(frame, 3, |vertex| frame.normal(vertex));
    let mut picture = linear_samples(frame);
    interpolate(frame, &varyings, None, &mut |x, row, n| {
        let [r, g, b] = (unit(n).unit() * 0.5).array();
        picture.row_mut(row)[x] = [r + 0.5, g + 0.5, b + 0.5, 1.0].map(|c| c.clamp(0.0, 1.0));
    });
    picture
}

/// Returns three numbers a vertex as varyings, times the weight of perspective where the frame asks for it; `count` is 4 if the
/// weight follows them.
fn of_vertices(frame: &Frame, count: usize, of: impl Fn(u32) -> [f32; 3]) -> Varyings<'static> {
    let vertices = 0..frame.vertices().len() as u32;
    let mut all: Vec<[f32; 3]> = vertices.map(of).collect();
    for corner in frame.clip_corners() {
        let (a, b) = (all[corner.a as usize], all[corner.b as usize]);
        let between = |i: usize| ramp(a[i], b[i], corner.t, 0.0)[0];
        all[corner.vertex as usize] = [between(0), between(1), between(2)];
    }
    let is_weighted = frame.interpolation() == Interpolation::Perspective;
    let values = all
        .iter()
        .zip(frame.vertices())
        .flat_map(|([x, y, z], vertex)| {
            let weight = if is_weighted { vertex.inv_w } else { 1.0 };
            [*x, *y, *z, 1.0]
                .map(|value| value * weight)
                .into_iter()
                .take(count)
        });
    Varyings::of_vertices(values.collect::<Vec<f32>>(), count)
}

/// Returns the colours of the vertices ([`Frame::colour`]), interpolated: linear, clamped to 0..=1; alpha 0 where nothing is
/// seen.
pub fn vertex_colours(frame: &Frame) -> LinearPicture {
    shown(frame, None, |vertex| frame.colour(vertex), |colour| colour)
}

/// Does as [`vertex_colours`] by the barycentric renderer (CS171 1, Algorithm 2), which passes over polygons of more than three
/// corners.
pub fn barycentric_vertex_colours(frame: &Frame, edges: Edges) -> LinearPicture {
    shown(
        frame,
        Some(edges),
        |vertex| frame.colour(vertex),
        |colour| colour,
    )
}

/// Returns a checkerboard on the world's x and z, the plane of a floor: alpha 0 where nothing is seen.
/// ```text
/// C(x, z) = c_1 if ⌊x/s⌋ + ⌊z/s⌋ is even, else c_2      (L5, Image Function, whose plane is x, y)
/// ```
/// `size` is s, in world units, over 0; `colours` are c_1 and c_2.
pub fn checkerboard(frame: &Frame, size: f64, colours: [Rgb; 2]) -> LinearPicture {
    board(frame, None, size, colours)
}

/// Does as [`checkerboard`] by the barycentric renderer, which passes over polygons of more than three corners.
pub fn barycentric_checkerboard(
    frame: &Frame,
    edges: Edges,
    size: f64,
    colours: [Rgb; 2],
) -> LinearPicture {
    board(frame, Some(edges), size, colours)
}

fn board(frame: &Frame, edges: Option<Edges>, size: f64, colours: [Rgb; 2]) -> LinearPicture {
    let eye = frame.eye();
    // Where a vertex is in the world, rounded once.
    let world = |vertex: u32| {
        let from_eye = frame.position(vertex);
        core::array::from_fn(|i| (eye[i] + f64::from(from_eye[i])) as f32)
    };
    shown(frame, edges, world, |[x, _, z]| {
        let square = |coordinate: f32| libm::floor(f64::from(coordinate) / size);
        // ⌊x/s⌋ + ⌊z/s⌋ is even where half of it is whole.
        let half = (square(x) + square(z)) / 2.0;
        colours[usize::from(half != libm::floor(half))] // C(x, z)
    })
}

/// Returns three numbers a vertex as a picture: interpolated, sample by sample, as `colour` shows them.
fn shown(
    frame: &Frame,
    edges: Option<Edges>,
    of: impl Fn(u32) -> [f32; 3],
    colour: impl Fn([f32; 3]) -> [f32; 3],
) -> LinearPicture {
    let is_weighted = frame.interpolation() == Interpolation::Perspective;
    let varyings = of_vertices(frame, if is_weighted { 4 } else { 3 }, of);
    let mut picture = linear_picture(frame);
    let draw = |target: &mut dyn super::target::Target| {
        interpolate(frame, &varyings, edges, &mut |x, row, numbers| {
            let value = match *numbers {
                [x, y, z, weight] => {
                    let w = 1.0 / weight;
                    [x * w, y * w, z * w]
                }
                _ => [numbers[0], numbers[1], numbers[2]],
            };
            target.store(x, row, &[colour(value)]);
        });
    };
    match edges {
        None => draw_rows(frame, picture.texels_mut(), draw),
        // The barycentric renderer comes back to samples that it drew.
        Some(_) => draw_anyhow(frame, picture.texels_mut(), draw),
    }
    picture
}
