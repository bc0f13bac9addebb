//! The barycentric renderer: CS171's bounding-box rasterizer, which the span engine's speed is
//! compared with.
//!
//! It tests the pixels of each triangle's bounding box with three edge functions, and leaves a row
//! once it is past the triangle. Inside, the edge functions are the barycentric coordinates by
//! which varyings are interpolated (CS171 1, Algorithms 1, 2). The scalar kernels of the span
//! engine shade the pixels, many at a time, so the two engines differ in rasterization and
//! interpolation only.

use super::depth::SampleDepth;
use super::setup::{SetUp, Varyings};
use super::spans::NO_POLYGON;
use super::target::Target;
use crate::frame::Frame;
use crate::picture::Picture;
use crate::shading::{GROUP, Run, RunList};
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// The owner of a pixel whose centre lies exactly on an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edges {
    /// The polygon right of the edge or below it (the top-left rule), as in every other engine.
    #[default]
    TopLeft,
    /// Every triangle with that edge, as CS171 prints it: shared edges are drawn twice.
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

    /// True if a triangle whose inside is where f ≥ 0 owns the pixels on this edge: it is a left or
    /// a top edge.
    fn owns_its_pixels(&self) -> bool {
        self.across > 0 || (self.across == 0 && self.down > 0)
    }
}

/// A function that receives a visible pixel: its polygon, column and row, and the list to which the
/// pixel's varyings were just added.
type VisitPixel<'a> = dyn FnMut(u32, usize, usize, &mut RunList) + 'a;

/// Calls `visit` with the visible pixels of each triangle, in drawing order and row by row. Skips
/// polygons of more than three corners. Returns the list with the varyings that `visit` left in it.
pub(super) fn scan(
    frame: &Frame,
    varyings: &Varyings<'_>,
    edges: Edges,
    visit: &mut VisitPixel<'_>,
) -> RunList {
    let depth = SampleDepth::new(frame);
    let mut depth_buffer = vec![f32::INFINITY; frame.width() * frame.height()];
    let mut list = RunList::new(varyings.count);
    for (index, polygon) in (0..).zip(frame.polygons()) {
        let &[a, b, c] = frame.corners(polygon) else {
            continue;
        };
        let corners = [a, b, c];
        let vertices = each(|i| &frame.vertices()[corners[i] as usize]);
        let points = vertices.map(|v| [v.x, v.y].map(|at| i64::from(at.to_bits())));
        let x_range = pixels(points.map(|[x, _]| x), frame.width());
        let y_range = pixels(points.map(|[_, y]| y), frame.height());
        let doubled_area = EdgeFunction::new(points[0], points[1]).at(points[2]);
        if x_range.is_empty() || y_range.is_empty() || doubled_area == 0 {
            continue;
        }
        // Corners are ordered from the uppermost one, at equal height the leftmost. Floats do not
        // add associatively, so a fixed order makes depth independent of the corner that the
        // triangle begins with.
        let first = (0..3).min_by_key(|i| [points[*i][1], points[*i][0]]);
        // Swapping the last two corners makes the area positive, and with it all three functions
        // inside.
        let order = [[0, 1, 2], [0, 2, 1]][usize::from(doubled_area < 0)]
            .map(|step| (first.unwrap_or(0) + step) % 3);
        let [a, b, c] = each(|i| points[order[i]]);
        let functions = [(b, c), (c, a), (a, b)].map(|(i, j)| EdgeFunction::new(i, j));
        // An edge that does not own its pixels needs f > 0, which is f ≥ 1 in integers.
        let least = each(|i| i64::from(edges == Edges::TopLeft && !functions[i].owns_its_pixels()));
        let scale = 1.0 / doubled_area.abs() as f32;
        let depths = each(|i| depth.of_corner(vertices[order[i]]));
        let values = each(|i| varyings.of_corner(index, order[i] as u32, corners[order[i]]));
        let constant = varyings.of_polygon(index);
        let three = match values {
            [&[ax, ay, az], &[bx, by, bz], &[cx, cy, cz]] if constant.is_none() => {
                Some([[ax, bx, cx], [ay, by, cy], [az, bz, cz]])
            }
            _ => None,
        };
        for row in y_range {
            let y = 256 * row as i64 + 128;
            let nearest = &mut depth_buffer[row * frame.width()..][..frame.width()];
            let mut was_inside = false;
            for column in x_range.clone() {
                let x = 256 * column as i64 + 128;
                let f = each(|i| functions[i].at([x, y]));
                if f[0] < least[0] || f[1] < least[1] || f[2] < least[2] {
                    // A triangle is convex: once the row has left it, no pixel of the row is inside
                    // again.
                    if was_inside {
                        break;
                    }
                    continue;
                }
                was_inside = true;
                // α = f_bc(p) / f_bc(a), and β and γ accordingly. f_bc(a) is the doubled area for
                // all three.
                let weights = each(|i| f[i] as f32 * scale);
                let mix = |[a, b, c]: [f32; 3]| weights[0] * a + weights[1] * b + weights[2] * c;
                let Some(kept) = depth.seen(mix(depths), nearest[column]) else {
                    continue;
                };
                nearest[column] = kept;
                // A run of one pixel takes no step, so its steps are 0.
                if let Some([x, y, z]) = three {
                    // The fast path: three values, without a loop.
                    list.starts
                        .push([mix(x), mix(y), mix(z), 0.0], [0.0; GROUP]);
                } else {
                    list.starts.add(|k| match constant {
                        Some(constant) => [constant[k], 0.0],
                        None => [mix(each(|i| values[i][k])), 0.0],
                    });
                }
                visit(index, column, row, &mut list);
            }
        }
    }
    list
}

/// Calls `of` for each of the three corners, or for the edges opposite to them, and returns the
/// results.
#[inline(always)]
fn each<T>(of: impl Fn(usize) -> T) -> [T; 3] {
    [of(0), of(1), of(2)]
}

/// How many pixels one call shades. Rows of a small triangle are too short to pay for a call each.
const BATCH: usize = 256;

/// Visible pixels in drawing order, waiting to be shaded and stored.
#[derive(Default)]
struct Waiting {
    /// Stretches of adjacent pixels: the column of the first one, the row, and the length.
    places: Vec<[usize; 3]>,
    colours: Vec<[f32; 3]>,
}

impl Waiting {
    /// Shades the pixels of `list` and stores them.
    fn flush(&mut self, setup: &SetUp<'_>, list: &mut RunList, target: &mut dyn Target) {
        self.colours.resize(list.runs.len(), [0.0; 3]);
        (setup.kernels.pixels)(&setup.pixels(list), &mut self.colours);
        let mut shaded = &self.colours[..];
        for [x, row, count] in self.places.drain(..) {
            let (here, rest) = shaded.split_at(count);
            target.store(x, row, here);
            shaded = rest;
        }
        list.clear();
    }
}

/// Draws the triangles of a method's frame into `target`.
pub(super) fn draw(setup: &SetUp<'_>, edges: Edges, target: &mut dyn Target) {
    let mut waiting = Waiting::default();
    let visit = &mut |polygon, column: usize, row, list: &mut RunList| {
        list.runs.push(Run {
            uniforms: setup.uniforms_of(polygon),
            polygon,
            x: column as u32,
            pixels: 1,
            to: list.runs.len() as u32,
        });
        match waiting.places.last_mut() {
            Some([x, its_row, count]) if *its_row == row && *x + *count == column => *count += 1,
            _ => waiting.places.push([column, row, 1]),
        }
        if list.runs.len() >= BATCH {
            waiting.flush(setup, list, target);
        }
    };
    let mut list = scan(setup.frame, &setup.varyings, edges, visit);
    waiting.flush(setup, &mut list, target);
}

/// Returns the index in [`Frame::polygons`] of the polygon that the barycentric renderer shows at
/// each sample, or [`NO_POLYGON`].
///
/// It differs from [`polygon_indices`](super::polygon_indices) only where depths are equal within
/// rounding.
pub fn barycentric_polygon_indices(frame: &Frame, edges: Edges) -> Picture<u32> {
    let mut picture = Picture::new(frame.width(), frame.height(), NO_POLYGON);
    let visit = &mut |polygon, column, row, _: &mut RunList| picture.row_mut(row)[column] = polygon;
    scan(frame, &Varyings::none(), edges, visit);
    picture
}

/// Returns the pixels in 0..`limit` whose centres lie between the smallest and the largest of three
/// coordinates.
fn pixels([a, b, c]: [i64; 3], limit: usize) -> Range<usize> {
    // Centres lie at 256 p + 128. A centre on either end counts, because closed edges own it.
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
    use crate::raster::polygon_indices;
    use crate::scene::Lighting;
    use glam::DVec3;

    /// Builds small triangles at random places and depths, so many of them that some have indices
    /// over 16 bits.
    fn triangles(count: usize, side: u32) -> Frame {
        let mut random = Random::new(7);
        let mut builder = FrameBuilder::new(side, side);
        let material =
            builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
        for index in 0..count {
            let depth = f64::from(0.5 + 0.5 * random.signed());
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
            builder.polygon(&corners, [0.0, 0.0, 1.0], index as u32);
        }
        builder.finish().unwrap()
    }

    #[test]
    fn it_shows_the_polygons_of_the_scanline_engine() {
        // Depth is constant over a triangle. So only its rounding could make the two pictures
        // differ, and rounding is one depth in 2²³.
        let frame = triangles(30_000, 300);
        let scanline = polygon_indices(&frame);
        let seen = scanline.pixels().iter().filter(|n| **n != NO_POLYGON);
        assert!(
            seen.clone().any(|n| *n > 65_536 / 3),
            "indices of over 16 bits are among them"
        );
        let barycentric = barycentric_polygon_indices(&frame, Edges::TopLeft);
        let other = scanline
            .pixels()
            .iter()
            .zip(barycentric.pixels())
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(other, 0, "of {} pixels", seen.count());
    }
}
