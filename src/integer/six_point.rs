//! Triangles by quadratic surfaces through six points: the corners and the middles of the sides.

use super::canvas::{Canvas, Vertex};
use super::gradients::{Gradients, Plane};
use super::light::{Highlight, Light, NoHighlight};
use super::material::{Material, TOP};
use super::naive::light_normal;
use super::pixel::Pixel;
use super::quadratic::{NARROW, run};
use super::ramp::Quadratic;
use super::reciprocal_root::{refined_root, unit_k};
use super::scan::{Point, scan};
use super::sliver::normals;
use super::triangle::{SetUp, fan};
use super::vector::{Bits, dot};

impl<P: Pixel> Canvas<'_, P> {
    /// Draws a convex polygon whose L·N and highlight's cosine are quadratic in x and y. In each
    /// triangle they go through the corners and the middles of the sides.
    ///
    /// It skips the highlight on triangles where none can fall. Triangles less than 4 pixels high
    /// are lit pixel by pixel. Returns false, and draws nothing, if the polygon does not
    /// [fit](Canvas).
    pub fn quadratic<H: Highlight, const L: usize>(
        &mut self,
        polygon: &[Vertex],
        lights: &[Light<'_, P>; L],
    ) -> bool {
        fan(
            polygon,
            |v| v,
            |t| self.quadratic_triangle::<H, L>(&t, lights),
        )
    }

    #[inline(always)]
    fn quadratic_triangle<H: Highlight, const L: usize>(
        &mut self,
        t: &[Vertex; 3],
        lights: &[Light<'_, P>; L],
    ) {
        let Some(SetUp {
            points,
            depths,
            gradients: g,
        }) = SetUp::new(t)
        else {
            return;
        };
        let n = normals(t);
        let (Some(weights), Some(z)) = (g.weights(), self.depth_plane(&g, depths)) else {
            self.sliver((points, depths), n, |n| {
                light_normal::<P, H, true, L>(lights, n)
            });
            return;
        };
        let six = SixPoints::new(n);
        let shared = six.unit(H::k_of(&lights[0]));
        let (mut l_n, mut cosine) = ([Surface::default(); L], [Surface::default(); L]);
        let narrow = dot(n[0], n[1]).min(dot(n[0], n[2])).min(dot(n[1], n[2])) >= NARROW;
        // `leaves`: a surface may leave its table, so pixels must be clamped. `is_bright`: a
        // highlight may fall on the triangle.
        let (mut is_bright, mut leaves) = (false, false);
        let mut i = 0;
        while i < L {
            let j = six.unit(lights[i].toward);
            leaves |= most(j.map(i32::abs)) + rise(j) > 32750;
            l_n[i] = Surface::new(j, &g, weights);
            if H::IS_SEEN {
                let k = if i == 0 || H::SHARES_K {
                    shared
                } else {
                    six.unit(H::k_of(&lights[i]))
                };
                let mut s = [0; 6];
                let mut at = 0;
                while at < 6 {
                    s[at] = TOP - H::below(&lights[i], j[at], k[at]);
                    at += 1;
                }
                is_bright |= can_shine(s, lights[i].material);
                leaves |= is_bright && most(s) + rise(s) > TOP - 16;
                cosine[i] = Surface::new(s, &g, weights);
            }
            i += 1;
        }
        let triangle = (points, &g, &z);
        // Four loops, compiled separately: most triangles have no highlight and need no clamp.
        match (is_bright, narrow || !leaves) {
            (true, true) => self.surfaces::<H, false, L>(triangle, &l_n, &cosine, lights),
            (true, false) => self.surfaces::<H, true, L>(triangle, &l_n, &cosine, lights),
            (false, true) => {
                self.surfaces::<NoHighlight, false, L>(triangle, &l_n, &cosine, lights)
            }
            (false, false) => {
                self.surfaces::<NoHighlight, true, L>(triangle, &l_n, &cosine, lights)
            }
        }
    }

    /// Shades a triangle from the surfaces of L·N and of the highlight's cosine.
    #[inline(never)]
    fn surfaces<H: Highlight, const IS_CLAMPED: bool, const L: usize>(
        &mut self,
        (points, g, z): ([Point; 3], &Gradients, &Plane),
        l_n: &[Surface; L],
        cosine: &[Surface; L],
        lights: &[Light<'_, P>; L],
    ) {
        scan(points, (self.width, self.height), |y, first, end| {
            self.row(y, (first, end), (z, g), |line, x| {
                let at = g.place(x, y);
                let (mut j, mut s) = ([Quadratic::default(); L], [Quadratic::default(); L]);
                let mut i = 0;
                while i < L {
                    j[i] = l_n[i].along(at);
                    if H::IS_SEEN {
                        s[i] = cosine[i].along(at);
                    }
                    i += 1;
                }
                run::<P, H, IS_CLAMPED, L>(line, j, s, lights);
            });
        });
    }
}

/// The normals at the corners 0, 1, 2 and at the middles 0–1, 0–2, 1–2, with 1 over their lengths
/// in Q15.
struct SixPoints {
    n: [Bits; 6],
    r: [i32; 6],
}

impl SixPoints {
    #[inline(always)]
    fn new([a, b, c]: [Bits; 3]) -> Self {
        let middle =
            |a: Bits, b: Bits| [(a[0] + b[0]) >> 1, (a[1] + b[1]) >> 1, (a[2] + b[2]) >> 1];
        let n = [a, b, c, middle(a, b), middle(a, c), middle(b, c)];
        let mut r = [0; 6];
        let mut i = 0;
        while i < 6 {
            let d = dot(n[i], n[i]);
            r[i] = refined_root(d);
            i += 1;
        }
        Self { n, r }
    }

    /// Returns the cosines between a unit vector and the six normals, in Q15.
    #[inline(always)]
    fn unit(&self, v: Bits) -> [i32; 6] {
        let mut cosines = [0; 6];
        let mut i = 0;
        while i < 6 {
            cosines[i] = unit_k(dot(v, self.n[i]), self.r[i]);
            i += 1;
        }
        cosines
    }
}

/// Returns twice the distance by which the middle of a side lies below the line between its ends.
const fn sag(first: i32, middle: i32, end: i32) -> i32 {
    first + end - 2 * middle
}

/// Returns how far a quadratic surface may exceed its six values.
///
/// Over each of the four half-size triangles it is the plane through three of the points, minus ½ Σ
/// λ_i λ_j sag_ij. Σ λ_i λ_j is at most ⅓, so the difference is at most ⅙ of the largest sag. The
/// code uses 11/64, a little more, which takes a shift in place of a division.
#[inline(always)]
fn rise(s: [i32; 6]) -> i32 {
    let sags = [
        sag(s[0], s[3], s[1]),
        sag(s[0], s[4], s[2]),
        sag(s[1], s[5], s[2]),
    ];
    let [a, b, c] = sags.map(i32::abs);
    (a.max(b).max(c) * 11) >> 6
}

/// Returns the largest of six values.
#[inline(always)]
fn most(s: [i32; 6]) -> i32 {
    s[0].max(s[1]).max(s[2]).max(s[3]).max(s[4]).max(s[5])
}

/// True if the highlight's cosine may reach an entry of its table that is not black, anywhere
/// between these six values.
#[inline(always)]
fn can_shine<P>(s: [i32; 6], material: &Material<P>) -> bool {
    let reach = (material.seen as i32) << material.shift;
    most(s) + rise(s) + 32 > TOP - reach
}

/// A quadratic surface: f(x, y) = c_0 + c_x x + c_y y + c_xx x² + c_xy x y + c_yy y² in Q30, with x
/// and y in whole pixels from the origin of the triangle's [`Gradients`].
///
/// Coefficients may wrap. A value at a pixel is right modulo 2³², and lies within ±2.
#[derive(Clone, Copy, Default)]
struct Surface {
    value: i32,
    x: i32,
    y: i32,
    xx: i32,
    xy: i32,
    yy: i32,
}

impl Surface {
    /// Makes the surface through six Q15 values. In the weights β and γ of corners 1 and 2 it is
    /// f = f_0 + a_1 β + a_2 γ + b_11 β² + b_12 β γ + b_22 γ².
    ///
    /// The weights grow by less than ¼ per pixel, in Q30, and the coefficients are below 2¹⁹: sums
    /// of products stay far below 2⁶³.
    #[inline(always)]
    fn new(f: [i32; 6], g: &Gradients, [beta, gamma]: [[i32; 2]; 2]) -> Self {
        let (a1, a2) = (4 * f[3] - 3 * f[0] - f[1], 4 * f[4] - 3 * f[0] - f[2]);
        let (b11, b22) = (2 * sag(f[0], f[3], f[1]), 2 * sag(f[0], f[4], f[2]));
        let b12 = 4 * (f[0] + f[5] - f[3] - f[4]);
        // Q15 times Q30 is Q45: shift back to Q30.
        let linear = |i: usize| {
            (i64::from(a1) * i64::from(beta[i]) + i64::from(a2) * i64::from(gamma[i])) >> 15
        };
        let square = |x: i32, y: i32| (i64::from(x) * i64::from(y)) >> 30;
        let form = |u: i64, v: i64, w: i64| {
            (i64::from(b11) * u + i64::from(b12) * v + i64::from(b22) * w) >> 15
        };
        let xx = form(
            square(beta[0], beta[0]),
            square(beta[0], gamma[0]),
            square(gamma[0], gamma[0]),
        );
        let yy = form(
            square(beta[1], beta[1]),
            square(beta[1], gamma[1]),
            square(gamma[1], gamma[1]),
        );
        let xy = form(
            2 * square(beta[0], beta[1]),
            square(beta[0], gamma[1]) + square(beta[1], gamma[0]),
            2 * square(gamma[0], gamma[1]),
        );
        // Move the surface from corner 0 to the origin, by a fraction of a pixel in Q8.
        let [dx, dy] = g.origin_offset().map(i64::from);
        let (x, y) = (linear(0), linear(1));
        let part_x = x + ((xx * dx + xy * dy) >> 8);
        let part_y = y + ((yy * dy) >> 8);
        let value = (i64::from(f[0]) << 15) + ((part_x * dx + part_y * dy) >> 8);
        Self {
            value: value as i32,
            x: (x + ((2 * xx * dx + xy * dy) >> 8)) as i32,
            y: (y + ((2 * yy * dy + xy * dx) >> 8)) as i32,
            xx: xx as i32,
            xy: xy as i32,
            yy: yy as i32,
        }
    }

    /// Returns the values along a row, starting at a pixel whose column and row are counted from
    /// the origin.
    #[inline(always)]
    fn along(&self, [x, y]: Point) -> Quadratic {
        let times = i32::wrapping_mul;
        let slope = self.x.wrapping_add(times(self.xy, y));
        let here = times(slope.wrapping_add(times(self.xx, x)), x);
        let down = times(self.y.wrapping_add(times(self.yy, y)), y);
        let at = self.value.wrapping_add(here).wrapping_add(down);
        // f(x + 1) − f(x) = slope + c_xx (2x + 1), and its own growth is 2 c_xx.
        let step = slope.wrapping_add(times(self.xx, 2 * x + 1));
        Quadratic::from_bits(at, step, self.xx.wrapping_mul(2))
    }
}
