//! Your own rasterizer with our shading: this file has triangles, edges, spans and a depth buffer,
//! and the library shades each span.
//!
//! ```text
//! cargo run --release --example own_rasterizer > own_rasterizer.ppm
//! ```
//!
//! It needs only the feature `alloc`, so it also runs with
//! `-p fastphong --no-default-features --features alloc`.

use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::Material;
use fastphong::picture::encoding::store_line;
use fastphong::scene::{Interpolation, Light, Lighting};
use fastphong::shading::{MethodRow, SpanShader, SpanVertex, methods};
use std::io::Write;

const WIDTH: usize = 480;
const HEIGHT: usize = 160;

/// A picture and its depth buffer. Depth grows away from the eye.
struct Canvas {
    pixels: Vec<[u8; 4]>,
    depth: Vec<f32>,
}

/// A point on the screen, in pixels with y downward, and the values that are interpolated.
#[derive(Clone)]
struct Point {
    x: f32,
    y: f32,
    depth: f32,
    varyings: Vec<f32>,
}

impl Point {
    /// Returns the point on the line from `self` to `other` at the height `y`, which must be
    /// between them.
    fn at_row(&self, other: &Point, y: f32) -> Point {
        // Always interpolate from the upper end, so that two triangles get equal points on a shared
        // edge.
        let [a, b] = if self.y <= other.y {
            [self, other]
        } else {
            [other, self]
        };
        let t = (y - a.y) / (b.y - a.y);
        let mix = |a: f32, b: f32| a + t * (b - a);
        let varyings = a.varyings.iter().zip(&b.varyings);
        Point {
            x: mix(a.x, b.x),
            y,
            depth: mix(a.depth, b.depth),
            varyings: varyings.map(|(a, b)| mix(*a, *b)).collect(),
        }
    }
}

impl Canvas {
    /// Draws a triangle: on each scanline the span between two edges.
    fn triangle(&mut self, shader: &mut SpanShader, [a, b, c]: [&Point; 3]) {
        let top = a.y.min(b.y).min(c.y).max(0.0) as usize;
        let bottom = (a.y.max(b.y).max(c.y).max(0.0) as usize + 1).min(HEIGHT);
        let (mut colours, mut bytes) = ([[0.0; 3]; WIDTH], [[0; 4]; WIDTH]);
        for row in top..bottom {
            // Pixels have their centres at ½. An end that lies exactly on the row counts as above
            // it, so a row crosses either two edges or none.
            let y = row as f32 + 0.5;
            let crossed = [(a, b), (b, c), (c, a)]
                .into_iter()
                .filter(|(p, q)| (p.y <= y) != (q.y <= y));
            let mut ends: Vec<Point> = crossed.map(|(p, q)| p.at_row(q, y)).collect();
            ends.sort_by(|p, q| p.x.total_cmp(&q.x));
            let [left, right] = &ends[..] else { continue };
            let column = |x: f32| ((x - 0.5).ceil().max(0.0) as usize).min(WIDTH);
            let columns = column(left.x)..column(right.x);
            if columns.is_empty() {
                continue;
            }
            let colours = &mut colours[..columns.len()];
            let span = [(left.x, &left.varyings[..]), (right.x, &right.varyings[..])];
            shader.shade(span, [columns.start as u32, row as u32], colours);
            store_line(colours, None, &mut bytes);
            let slope = (right.depth - left.depth) / (right.x - left.x);
            for (x, pixel) in columns.zip(&bytes) {
                let depth = left.depth + (x as f32 + 0.5 - left.x) * slope;
                let place = row * WIDTH + x;
                if depth < self.depth[place] {
                    (self.depth[place], self.pixels[place]) = (depth, *pixel);
                }
            }
        }
    }

    /// Draws a ball of `rings` × `2 rings` quadrangles, each as two triangles.
    fn ball(&mut self, shader: &mut SpanShader, [x, y, radius]: [f32; 3], rings: usize) {
        let point = |ring: usize, segment: usize| {
            let (s, c) = (std::f32::consts::PI * ring as f32 / rings as f32).sin_cos();
            let (sin, cos) = (std::f32::consts::PI * segment as f32 / rings as f32).sin_cos();
            let n = Vec3::new(s * cos, c, s * sin);
            Point {
                x: x + radius * n.x,
                y: y - radius * n.y,
                depth: -n.z,
                varyings: shader.vertex(SpanVertex::of_normal(n.to_array())),
            }
        };
        let grid: Vec<Vec<Point>> = (0..=rings)
            .map(|ring| {
                (0..=2 * rings)
                    .map(|segment| point(ring, segment))
                    .collect()
            })
            .collect();
        for (upper, lower) in grid.iter().zip(&grid[1..]) {
            for (p, q) in upper.windows(2).zip(lower.windows(2)) {
                self.triangle(shader, [&p[0], &p[1], &q[1]]);
                self.triangle(shader, [&p[0], &q[1], &q[0]]);
            }
        }
    }
}

/// Draws a ball by each of three methods.
pub fn picture() -> Vec<[u8; 4]> {
    let mut canvas = Canvas {
        pixels: vec![[0, 0, 0, 255]; WIDTH * HEIGHT],
        depth: vec![f32::INFINITY; WIDTH * HEIGHT],
    };
    let light = Light::directional(DVec3::new(-0.4, 0.6, 0.7).normalize(), [0.9; 3]);
    let lighting = Lighting::new(&Material::default(), [1.0; 3], &[light], DVec3::Z);
    let all: [&'static MethodRow; 3] =
        [methods::GOURAUD, methods::PHONG_RSQRT, methods::DUFF_PHONG];
    for (column, method) in all.into_iter().enumerate() {
        let mut shader = SpanShader::new(&method.variant(), &lighting, Interpolation::Screen)
            .expect("a method for any light");
        canvas.ball(&mut shader, [80.0 + 160.0 * column as f32, 80.0, 70.0], 8);
    }
    canvas.pixels
}

fn main() -> std::io::Result<()> {
    let mut file = format!("P6\n{WIDTH} {HEIGHT}\n255\n").into_bytes();
    file.extend(picture().iter().flat_map(|[r, g, b, _]| [r, g, b]));
    std::io::stdout().write_all(&file)
}
