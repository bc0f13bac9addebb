//! Triangles and convex polygons by each method.

use super::canvas::{Canvas, Vertex};
use super::fast::fast;
use super::gouraud::run;
use super::gradients::{Gradients, Plane};
use super::light::{Highlight, Light};
use super::naive::{light_normal, naive};
use super::pixel::{Pixel, halves};
use super::ramp::{Quadratic, Ramp};
use super::scan::{Point, scan};
use super::sliver::normals;
use super::vector::{Bits, dot};

/// Calls `draw` for the triangles of a convex polygon about its first corner.
#[inline(always)]
pub(super) fn fan<T: Copy>(polygon: &[T], mut draw: impl FnMut([T; 3])) {
    if let [first, rest @ ..] = polygon {
        for pair in rest.windows(2) {
            if let [second, third] = pair {
                draw([*first, *second, *third]);
            }
        }
    }
}

/// Returns the corners of a triangle in sub-pixels and their depths, if they lie within ±1,024 pixels.
#[inline(always)]
pub(super) fn points(t: &[Vertex; 3]) -> Option<([Point; 3], [u16; 3])> {
    let points = t.map(|v| [v.x.to_bits(), v.y.to_bits()]);
    let is_near = |p: &Point| p[0].unsigned_abs() <= 1 << 18 && p[1].unsigned_abs() <= 1 << 18;
    let is_fit = is_near(&points[0]) && is_near(&points[1]) && is_near(&points[2]);
    is_fit.then_some((points, t.map(|v| v.depth)))
}

/// A linear value at a pixel of a row.
#[inline(always)]
fn ramp(plane: &Plane, at: Point) -> Ramp {
    Ramp::from_bits(plane.at(at), plane.step)
}

impl<P: Pixel> Canvas<'_, P> {
    /// Draws a convex polygon by Gouraud shading. Each corner has its colour in fields beside it: see
    /// [`colour`](super::colour).
    pub fn gouraud(&mut self, polygon: &[(Vertex, u32)]) {
        fan(polygon, |t| self.gouraud_triangle(t));
    }

    /// Draws a convex polygon by naive Phong shading.
    pub fn naive<H: Highlight, const REFINED: bool, const L: usize>(
        &mut self,
        polygon: &[Vertex],
        lights: &[Light<'_, P>; L],
    ) {
        fan(polygon, |t| {
            self.naive_triangle::<H, REFINED, L>(&t, lights)
        });
    }

    /// Draws a convex polygon by fast Phong shading: J, K and N are planes over each triangle.
    pub fn fast<H: Highlight, const REFINED: bool, const L: usize>(
        &mut self,
        polygon: &[Vertex],
        lights: &[Light<'_, P>; L],
    ) {
        fan(polygon, |t| self.fast_triangle::<H, REFINED, L>(&t, lights));
    }

    fn gouraud_triangle(&mut self, t: [(Vertex, u32); 3]) {
        let [a, b, c] = t.map(|(_, colour)| halves(colour));
        let red = [a.0 >> 16, b.0 >> 16, c.0 >> 16];
        let blue = [a.0 & 0xFFFF, b.0 & 0xFFFF, c.0 & 0xFFFF];
        let green = [a.1, b.1, c.1];
        let corners = t.map(|(vertex, _)| vertex);
        let Some((points, depths)) = points(&corners) else {
            return;
        };
        let Some(g) = Gradients::new(points) else {
            return;
        };
        let plane = |values: [u32; 3]| g.plane16(values.map(|x| x as u16));
        let planes = (plane(red), plane(green), plane(blue), g.plane16(depths));
        let (Some(red_plane), Some(green_plane), Some(blue_plane), Some(z)) = planes else {
            let values = [0, 1, 2].map(|i| [red[i] as i32, green[i] as i32, blue[i] as i32]);
            self.sliver((points, depths), values, |[red, green, blue]| {
                // Halves of 16 bits as fields: 9, 10 and 9 bits.
                ((green as u32 >> 6) << 21) | ((red as u32 >> 7) << 11) | (blue as u32 >> 7)
            });
            return;
        };
        // Rounded steps leave a value by at most ½ a pixel, 64 in a piece of 128 pixels. Tables stay 128
        // away from both ends of 16 bits, so no channel carries into another.
        let rounded = |plane: &Plane| ((plane.step + (1 << 13)) >> 14) as u32;
        let steps = (
            (rounded(&red_plane) << 16).wrapping_add(rounded(&blue_plane)),
            rounded(&green_plane),
        );
        let size = (self.width, self.height);
        scan(points, size, |y, first, end| {
            self.row(y, (first, end), (&z, &g), |line, x| {
                let at = g.place(x, y);
                let at = |plane: &Plane| (plane.at(at) >> 14) as u32;
                let red_blue = (at(&red_plane) << 16).wrapping_add(at(&blue_plane));
                run(line, (red_blue, at(&green_plane)), steps);
            });
        });
    }

    #[inline(always)]
    fn naive_triangle<H: Highlight, const REFINED: bool, const L: usize>(
        &mut self,
        t: &[Vertex; 3],
        lights: &[Light<'_, P>; L],
    ) {
        let Some((points, depths)) = points(t) else {
            return;
        };
        let Some(g) = Gradients::new(points) else {
            return;
        };
        let n = normals(t);
        let planes = (normal_planes(&g, n), self.depth_plane(&g, depths));
        let (Some([nx, ny, nz]), Some(z)) = planes else {
            self.sliver((points, depths), n, |n| {
                light_normal::<P, H, REFINED, L>(lights, n)
            });
            return;
        };
        scan(points, (self.width, self.height), |y, first, end| {
            self.row(y, (first, end), (&z, &g), |line, x| {
                let at = g.place(x, y);
                let normal = [ramp(&nx, at), ramp(&ny, at), ramp(&nz, at)];
                naive::<P, H, REFINED, L>(line, normal, lights);
            });
        });
    }

    #[inline(always)]
    fn fast_triangle<H: Highlight, const REFINED: bool, const L: usize>(
        &mut self,
        t: &[Vertex; 3],
        lights: &[Light<'_, P>; L],
    ) {
        let Some((points, depths)) = points(t) else {
            return;
        };
        let Some(g) = Gradients::new(points) else {
            return;
        };
        let n = normals(t);
        let planes = (
            normal_planes(&g, n),
            product_planes::<P, H, L>(&g, n, lights),
            self.depth_plane(&g, depths),
        );
        let (Some([nx, ny, nz]), Some((j, k)), Some(z)) = planes else {
            self.sliver((points, depths), n, |n| {
                light_normal::<P, H, REFINED, L>(lights, n)
            });
            return;
        };
        // ΔN with 18 fractional bits, below 2¹⁵. Its square is below 3 · 2³⁰.
        let growth = [nx.step, ny.step, nz.step].map(|step| (step + (1 << 11)) >> 12);
        let square = |x: i32| (x * x) as u32;
        let bend = ((square(growth[0]) + square(growth[1]) + square(growth[2])) >> 6) as i32;
        scan(points, (self.width, self.height), |y, first, end| {
            self.row(y, (first, end), (&z, &g), |line, x| {
                let at = g.place(x, y);
                let n = [nx.at(at) >> 15, ny.at(at) >> 15, nz.at(at) >> 15];
                // D_next − D = 2 N·ΔN + ΔN·ΔN: each product below 2³⁰, with 33 fractional bits.
                let part = |i: usize| (n[i] * growth[i]) >> 2;
                let step = part(0) + part(1) + part(2) + bend;
                let d = Quadratic::from_bits(dot(n, n), step, 2 * bend);
                let (mut j_ramps, mut k_ramps) = ([Ramp::default(); L], [Ramp::default(); L]);
                let mut i = 0;
                while i < L {
                    j_ramps[i] = ramp(&j[i], at);
                    if H::IS_SEEN && (i == 0 || !H::SHARES_K) {
                        k_ramps[i] = ramp(&k[i], at);
                    }
                    i += 1;
                }
                fast::<P, H, REFINED, L>(line, j_ramps, k_ramps, d, lights);
            });
        });
    }

    /// Returns the plane of depth; any plane if there is no depth buffer, or `None` if it is steep.
    #[inline(always)]
    pub(super) fn depth_plane(&self, g: &Gradients, depths: [u16; 3]) -> Option<Plane> {
        if self.has_depth() {
            g.plane16(depths)
        } else {
            Some(Plane::default())
        }
    }
}

/// Returns the planes of N, if none is steep.
#[inline(always)]
fn normal_planes(g: &Gradients, [a, b, c]: [Bits; 3]) -> Option<[Plane; 3]> {
    let one = |i: usize| g.plane([a[i], b[i], c[i]]);
    Some([one(0)?, one(1)?, one(2)?])
}

/// The planes of J and K of each light.
type ProductPlanes<const L: usize> = ([Plane; L], [Plane; L]);

/// Returns the planes of J and K of each light, if none is steep (L21 4.3).
#[inline(always)]
fn product_planes<P, H: Highlight, const L: usize>(
    g: &Gradients,
    [a, b, c]: [Bits; 3],
    lights: &[Light<'_, P>; L],
) -> Option<ProductPlanes<L>> {
    let (mut j, mut k) = ([Plane::default(); L], [Plane::default(); L]);
    let along = |v: Bits| g.plane([dot(v, a) >> 15, dot(v, b) >> 15, dot(v, c) >> 15]);
    let mut i = 0;
    while i < L {
        j[i] = along(lights[i].toward)?; // 4.3
        if H::IS_SEEN && (i == 0 || !H::SHARES_K) {
            k[i] = along(H::k_of(&lights[i]))?;
        }
        i += 1;
    }
    Some((j, k))
}
