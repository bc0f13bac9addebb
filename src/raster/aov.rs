//! Pictures of other quantities than shaded colours: depth, normals, polygon indices, coverage,
//! interpolated colours and checkerboards.
//!
//! A mean of depths or of polygon indices would mean nothing. So these pictures are not filtered:
//! they have one pixel per sample, [`Frame::width`] × [`Frame::height`] of them.
//!
//! Vertex colours and checkerboards (L5, Interpolation Across Triangles) are filtered like any
//! picture. They are linear on the screen, or, if the frame asks for perspective interpolation,
//! linear in space for one division per pixel. Under a perspective camera interpolation on the
//! screen bends the squares of a board at every diagonal (L5, *What's wrong?*); interpolation in
//! space does not.

use super::barycentric::{self, Edges};
use super::engine::Renderer;
use super::setup::{Varyings, finish, unit};
use super::spans::{NO_POLYGON, scan};
use super::target::{Target, drawn, drawn_anyhow, linear_samples};
use crate::frame::Frame;
use crate::picture::{LinearPicture, Picture, Rgb};
use crate::scene::Interpolation;
use crate::shading::{GROUP, RunList, UniformsIndex, Variant};
use alloc::vec::Vec;
use core::ops::Range;

/// Returns the index in [`Frame::polygons`] of the polygon seen at each sample, or [`NO_POLYGON`].
///
/// The span engine decides, so the picture does not depend on the shading method.
/// [`Variant::polygon_indices`] asks any scanline engine.
pub fn polygon_indices(frame: &Frame) -> Picture<u32> {
    let mut picture = Picture::new(frame.width(), frame.height(), NO_POLYGON);
    scan(frame, &Varyings::none(), &mut |row, line, _| {
        let line = line.drawn();
        for (x, polygon) in picture.row_mut(row).iter_mut().enumerate() {
            *polygon = line.polygon(x);
        }
    });
    picture
}

/// A function that receives a row's index, and a function from columns to polygon indices.
type VisitRow<'a> = &'a mut dyn FnMut(usize, &dyn Fn(usize) -> u32);

/// Calls `visit` for each row on which anything is drawn. It passes the row's index and a function
/// that returns the index of the polygon at a column, as [`polygon_indices`] does. The picture is
/// never in memory as a whole.
pub fn for_each_polygon_row(frame: &Frame, visit: VisitRow<'_>) {
    scan(frame, &Varyings::none(), &mut |row, line, _| {
        let line = line.drawn();
        visit(row, &|x| line.polygon(x));
    });
}

impl Variant {
    /// Returns the index in [`Frame::polygons`] of the polygon seen at each sample where `renderer`
    /// draws this method, or [`NO_POLYGON`].
    ///
    /// Where two polygons have equal depths but for rounding, engines, instruction sets and methods
    /// may show different ones. So the loops that draw the method decide.
    pub fn polygon_indices(&self, frame: &Frame, renderer: Renderer) -> Picture<u32> {
        #[cfg(feature = "simd")]
        if let Some(Renderer::Row(level)) = self.plan(frame, renderer).renderer() {
            return super::rows::polygon_indices(self, frame, level);
        }
        let _ = renderer; // without SIMD there is one engine
        polygon_indices(frame)
    }
}

/// Returns the depth at each sample as the depth test compares it: 0 at the near plane, 1 at the
/// far plane, and infinite where nothing is seen.
pub fn depth(frame: &Frame) -> Picture<f32> {
    let mut picture = Picture::new(frame.width(), frame.height(), f32::INFINITY);
    scan(frame, &Varyings::none(), &mut |row, line, _| {
        for (pixel, depth) in picture.row_mut(row).iter_mut().zip(line.drawn().depth()) {
            *pixel = depth;
        }
    });
    picture
}

/// Calls `visit` with every span of every polygon, hidden ones too. It passes the polygon's index,
/// the row, and the pixels whose centres the span covers.
///
/// Rows come in order from the top, and within a row polygons come in drawing order. A pixel is
/// covered if an odd number of the polygon's edges lie left of its centre.
pub fn coverage(frame: &Frame, mut visit: impl FnMut(u32, usize, Range<usize>)) {
    scan(frame, &Varyings::none(), &mut |row, line, _| {
        for span in line.spans() {
            visit(span.polygon, row, span.pixels());
        }
    });
}

/// Calls `visit` with column, row and varyings of each visible pixel.
fn interpolate(
    frame: &Frame,
    varyings: &Varyings<'_>,
    edges: Option<Edges>,
    visit: &mut dyn FnMut(usize, usize, [f32; 4]),
) {
    let mut list = RunList::new(GROUP);
    let values = |list: &RunList| list.starts.of(0).0[0];
    match edges {
        Some(edges) => {
            barycentric::scan(frame, varyings, edges, &mut |_, x, row, list| {
                visit(x, row, values(list)[0]);
                list.clear();
            });
        }
        None => scan(frame, varyings, &mut |row, line, edges| {
            line.runs(|span, pixels| {
                list.clear();
                let uniforms = UniformsIndex(0); // nothing is lit
                edges.add_run(span, row, pixels.clone(), uniforms, &mut list);
                let [mut at, step] = values(&list);
                for x in pixels {
                    visit(x, row, at);
                    at.iter_mut().zip(step).for_each(|(at, step)| *at += step);
                }
            });
        }),
    }
}

/// Returns the unit normal at each sample, in world space, as (N + 1)/2; alpha is 0 where nothing
/// is seen.
pub fn normals(frame: &Frame) -> LinearPicture {
    let varyings = of_vertices(frame, |vertex| frame.normal(vertex));
    let mut picture = linear_samples(frame);
    interpolate(frame, &varyings, None, &mut |x, row, n| {
        let [r, g, b] = (unit(&n).unit() * 0.5).array();
        picture.row_mut(row)[x] = [r + 0.5, g + 0.5, b + 0.5, 1.0].map(|c| c.clamp(0.0, 1.0));
    });
    picture
}

/// Makes varyings of three values per vertex, followed by 1. All four are multiplied by the weight
/// of perspective if the frame asks for it.
fn of_vertices(frame: &Frame, of: impl Fn(u32) -> [f32; 3]) -> Varyings<'static> {
    let all = (0..frame.vertices().len() as u32).map(of);
    let mut values: Vec<f32> = all.flat_map(|[x, y, z]| [x, y, z, 1.0]).collect();
    let is_weighted = frame.interpolation() == Interpolation::Perspective;
    finish(frame, &mut values, 4, false, is_weighted);
    Varyings::of_vertices(values, 4)
}

/// Returns the interpolated colours of the vertices ([`Frame::colour`]), linear and clamped to
/// 0..=1; alpha is 0 where nothing is seen. `None` lets the span engine draw them. `Some(edges)`
/// lets the barycentric renderer (CS171 1, Algorithm 2), which skips polygons of more than three
/// corners.
pub fn vertex_colours(frame: &Frame, edges: Option<Edges>) -> LinearPicture {
    shown(frame, edges, |vertex| frame.colour(vertex), |colour| colour)
}

/// Returns a checkerboard on the world's x and z, the plane of a floor; alpha is 0 where nothing is
/// seen.
/// ```text
/// C(x, z) = c_1 if ⌊x/s⌋ + ⌊z/s⌋ is even, else c_2      (L5, Image Function, whose plane is x, y)
/// ```
/// `size` is s, the side of a square in world units, over 0. `colours` are c_1 and c_2, linear.
/// `edges` chooses the engine as in [`vertex_colours`].
pub fn checkerboard(
    frame: &Frame,
    edges: Option<Edges>,
    size: f64,
    colours: [Rgb; 2],
) -> LinearPicture {
    // Moving the board by a whole number of periods leaves it unchanged, and keeps coordinates
    // small far from 0.
    let period = 2048.0 * size;
    let origin = frame.origin().map(|o| o - libm::rint(o / period) * period);
    // The position of a vertex in the world, rounded once.
    let world = |vertex: u32| {
        let position = frame.position(vertex);
        core::array::from_fn(|i| (origin[i] + f64::from(position[i])) as f32)
    };
    shown(frame, edges, world, |[x, _, z]| {
        let square = |coordinate: f32| libm::floor(f64::from(coordinate) / size);
        // ⌊x/s⌋ + ⌊z/s⌋ is even where half of it is whole.
        let half = (square(x) + square(z)) / 2.0;
        colours[usize::from(half != libm::floor(half))] // C(x, z)
    })
}

/// Draws a picture of three values per vertex: interpolates them, and stores what `colour` makes of
/// them at each sample.
fn shown(
    frame: &Frame,
    edges: Option<Edges>,
    of: impl Fn(u32) -> [f32; 3],
    colour: impl Fn([f32; 3]) -> [f32; 3],
) -> LinearPicture {
    let is_weighted = frame.interpolation() == Interpolation::Perspective;
    let varyings = of_vertices(frame, of);
    let draw = |target: &mut dyn Target| {
        interpolate(frame, &varyings, edges, &mut |x, row, values| {
            let [a, b, c, weight] = values;
            let w = if is_weighted { 1.0 / weight } else { 1.0 };
            target.store(x, row, &[colour([a * w, b * w, c * w])]);
        });
    };
    match edges {
        None => drawn(frame, draw),
        // The barycentric renderer may draw a sample again after it left the row.
        Some(_) => drawn_anyhow(frame, draw),
    }
}
