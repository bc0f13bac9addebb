//! The barycentric renderer: CS171's bounding-box rasterizer, which the span engine's speed is measured against.
//!
//! For each triangle every pixel of its bounding box is tested with three edge functions; where it is inside, they give its
//! barycentric coordinates, by which varyings are interpolated (CS171 1, Algorithms 1, 2). Pixels are shaded by the scalar
//! kernels, a row of a triangle at a time, so that what differs in speed is rasterization and interpolation.

use super::depth::SampleDepth;
use super::setup::{SetUp, Varyings};
use super::spans::NOTHING;
use super::target::Target;
use crate::frame::Frame;
use crate::picture::Picture;
use crate::shading::Run;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// The owner of the pixels whose centres lie exactly on an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edges {
    /// The polygon right of or below the edge (the top-left rule): as in every other engine here.
    #[default]
    TopLeft,
    /// Every triangle that has the edge, as CS171 prints it: shared edges are drawn twice.
    Closed,
}

/// The edge function of the line through i and j, in exact integers (sub-pixels²).
///
/// ```text
/// f_ij(x, y) = (y_i − y_j) x + (x_j − x_i) y + x_i y_j − x_j y_i            (CS171 1)
/// ```
struct EdgeFunction {
    across: i64,
    down: i64,
    constant: i64,
}

impl EdgeFunction {
    fn new([xi, yi]: [i64; 2], [xj, yj]: [i64; 2]) -> Self {
        EdgeFunction {
            across: yi - yj,
            down: xj - xi,
            constant: xi * yj - xj * yi,
        }
    }

    #[inline(always)]
    fn at(&self, [x, y]: [i64; 2]) -> i64 {
        self.across * x + self.down * y + self.constant // f_ij
    }

    /// True if pixels on the edge itself are inside a triangle whose inside is where f ≥ 0: left and top edges.
    fn owns_its_pixels(&self) -> bool {
        self.across > 0 || (self.across == 0 && self.down > 0)
    }
}

/// A function that takes the visible pixels of a triangle on a row: the polygon, the row, the columns, and the start of a run at
/// each pixel.
type VisitRow<'a> = dyn FnMut(u32, usize, &[usize], &[f32]) + 'a;

/// Calls `visit` with the visible pixels of each triangle on each row, in drawing order. Polygons with more corners are passed
/// over.
pub(super) fn scan(frame: &Frame, varyings: &Varyings<'_>, edges: Edges, visit: &mut VisitRow<'_>) {
    let depth = SampleDepth::new(frame);
    let mut depth_buffer = vec![f32::INFINITY; frame.width() * frame.height()];
    let (mut columns, mut starts) = (Vec::new(), Vec::new());
    for (number, polygon) in (0..).zip(frame.polygons()) {
        let &[a, b, c] = frame.corners(polygon) else {
            continue;
        };
        let mut order = [(0, a), (1, b), (2, c)];
        let vertex = |v: u32| &frame.vertices()[v as usize];
        let point = |v: u32| [vertex(v).x, vertex(v).y].map(|at| i64::from(at.to_bits()));
        let doubled_area = EdgeFunction::new(point(a), point(b)).at(point(c));
        if doubled_area == 0 {
            continue;
        }
        if doubled_area < 0 {
            order.swap(1, 2);
        }
        let [a, b, c] = order.map(|(_, v)| point(v));
        let functions = [(b, c), (c, a), (a, b)].map(|(i, j)| EdgeFunction::new(i, j));
        // f ≥ 1 is f > 0 in integers: the edges that do not own their pixels need that.
        let disowns = |f: &EdgeFunction| edges == Edges::TopLeft && !f.owns_its_pixels();
        let least = functions.each_ref().map(|f| i64::from(disowns(f)));
        let scale = 1.0 / doubled_area.abs() as f32;
        let depths = order.map(|(_, v)| depth.of_corner(frame, vertex(v)));
        let values = order.map(|(corner, v)| varyings.of_corner(number, corner, v));
        let x_range = pixels([a[0], b[0], c[0]], frame.width());
        let y_range = pixels([a[1], b[1], c[1]], frame.height());
        for row in y_range {
            columns.clear();
            starts.clear();
            let y = 256 * row as i64 + 128;
            let nearest = &mut depth_buffer[row * frame.width()..][..frame.width()];
            for column in x_range.clone() {
                let x = 256 * column as i64 + 128;
                let here = functions.each_ref().map(|f| f.at([x, y]));
                if here.iter().zip(&least).any(|(f, least)| f < least) {
                    continue;
                }
                // α = f_bc(p) / f_bc(a), β and γ accordingly: f_bc(a) is the doubled area for all three.
                let weights = here.map(|f| f as f32 * scale);
                let mix = |a, b, c| weights[0] * a + weights[1] * b + weights[2] * c;
                let q = mix(depths[0], depths[1], depths[2]);
                let Some(kept) = depth.seen(q, nearest[column]) else {
                    continue;
                };
                nearest[column] = kept;
                columns.push(column);
                if let Some(constant) = varyings.of_polygon(number) {
                    starts.extend(constant);
                } else {
                    let corners = values[0].iter().zip(values[1]).zip(values[2]);
                    starts.extend(corners.map(|((a, b), c)| mix(*a, *b, *c)));
                }
                starts.resize(starts.len() + varyings.count, 0.0);
            }
            if !columns.is_empty() {
                visit(number, row, &columns, &starts);
            }
        }
    }
}

/// Draws the triangles of a method's frame into `target`.
pub(super) fn draw(setup: &SetUp<'_>, edges: Edges, target: &mut dyn Target) {
    let mut colours = vec![[0.0; 3]; setup.frame.width()];
    let mut runs = Vec::new();
    let visit = &mut |number, row, columns: &[usize], starts: &[f32]| {
        let run = Run {
            uniforms: setup.uniforms_of(number),
            x: 0,
            pixels: 1,
        };
        runs.clear();
        runs.resize(columns.len(), run);
        (setup.kernels.pixels)(&setup.pixels(&runs, starts), &mut colours);
        for (column, colour) in columns.iter().zip(&colours) {
            target.store(*column, row, &[*colour]);
        }
    };
    scan(setup.frame, &setup.varyings, edges, visit);
}

/// Returns the number of the polygon that the barycentric renderer shows at each pixel, an index into [`Frame::polygons`], or
/// [`NOTHING`].
///
/// It agrees with [`polygon_numbers`](super::polygon_numbers) except where depths are equal within rounding.
pub fn barycentric_polygon_numbers(frame: &Frame, edges: Edges) -> Picture<u32> {
    let mut picture = Picture::new(frame.width(), frame.height(), NOTHING);
    let visit = &mut |number, row, columns: &[usize], _: &[f32]| {
        let row = picture.row_mut(row);
        columns.iter().for_each(|column| row[*column] = number);
    };
    scan(frame, &Varyings::none(), edges, visit);
    picture
}

/// Returns the pixels of 0 to `limit` whose centres lie between the least and the largest of three coordinates.
fn pixels([a, b, c]: [i64; 3], limit: usize) -> Range<usize> {
    // Centres at 256 p + 128, both ends included for closed edges.
    let first = (a.min(b).min(c) + 127).div_euclid(256).max(0) as usize;
    let end = (a.max(b).max(c) - 128).div_euclid(256) + 1;
    first.min(limit)..(end.max(0) as usize).min(limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{FrameBuilder, SubPixel, Vertex};
    use crate::mesh::Material;
    use crate::number::test_random::Random;
    use crate::raster::polygon_numbers;
    use crate::scene::Lighting;
    use glam::DVec3;

    /// Small triangles of random places and depths; enough that the second half of the number is not all of it.
    fn triangles(count: usize, side: u32) -> Frame {
        let mut random = Random::new(7);
        let mut builder = FrameBuilder::new(side, side);
        let material =
            builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
        for number in 0..count {
            let depth = 0.5 + 0.5 * random.signed();
            let centre = [
                random.below(u64::from(256 * side)) as i32,
                random.below(u64::from(256 * side)) as i32,
            ];
            let corners = [(); 3].map(|()| {
                let [x, y] =
                    centre.map(|c| SubPixel::from_bits(c + random.below(1024) as i32 - 512));
                builder.vertex(Vertex {
                    x,
                    y,
                    depth,
                    inv_w: 1.0,
                    normal: [0.0, 0.0, 1.0],
                    material,
                })
            });
            builder.polygon(&corners, [0.0, 0.0, 1.0], number as u32);
        }
        builder.finish().unwrap()
    }

    #[test]
    fn it_shows_the_polygons_of_the_scanline_engine() {
        // Depth is constant over a triangle, so that only the rounding of it could part the two: one depth in 2²³.
        let frame = triangles(30_000, 300);
        let scanline = polygon_numbers(&frame);
        let seen = scanline.pixels().iter().filter(|n| **n != NOTHING);
        assert!(
            seen.clone().any(|n| *n > 65_536 / 3),
            "numbers of over 16 bits are among them"
        );
        let barycentric = barycentric_polygon_numbers(&frame, Edges::TopLeft);
        let other = scanline
            .pixels()
            .iter()
            .zip(barycentric.pixels())
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(other, 0, "of {} pixels", seen.count());
    }
}
