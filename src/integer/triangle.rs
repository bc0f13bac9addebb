//! Triangles and convex polygons by each method.

use super::canvas::{Canvas, Vertex};
use super::fast::fast;
use super::gouraud::run;
use super::gradients::{Gradients, Plane};
use super::light::{Highlight, Light, scaled};
use super::naive::{light_normal, naive};
use super::pixel::{Pixel, halves};
use super::ramp::{Quadratic, Ramp};
use super::scan::{Point, scan};
use super::sliver::{cross, normals};
use super::vector::{Bits, dot};

/// Calls `draw` for the triangles of a polygon around its first corner. Returns false, and calls
/// nothing, if the polygon does not fit: see [`is_fit`].
#[inline(always)]
pub(super) fn fan<T: Copy>(
    polygon: &[T],
    vertex: impl Fn(&T) -> &Vertex,
    mut draw: impl FnMut([T; 3]),
) -> bool {
    let is_fit = is_fit(polygon, vertex);
    if let ([first, rest @ ..], true) = (polygon, is_fit) {
        for pair in rest.windows(2) {
            if let [second, third] = pair {
                draw([*first, *second, *third]);
            }
        }
    }
    is_fit
}

/// True if all corners lie within ±1,024 pixels and the polygon is convex. Triangles always are.
#[inline(always)]
fn is_fit<T>(polygon: &[T], vertex: impl Fn(&T) -> &Vertex) -> bool {
    let point = |corner: &T| {
        let Vertex { x, y, .. } = vertex(corner);
        [x.to_bits(), y.to_bits()]
    };
    let is_near = |p: Point| p[0].unsigned_abs() <= 1 << 18 && p[1].unsigned_abs() <= 1 << 18;
    polygon.iter().all(|corner| is_near(point(corner)))
        && (polygon.len() <= 3 || is_convex(polygon.iter().map(point)))
}

/// True if a polygon turns one way only, and goes down once and up once. The second condition
/// excludes stars, which turn one way, too.
#[inline(never)]
fn is_convex(corners: impl Iterator<Item = Point> + Clone) -> bool {
    let (mut is_right, mut is_left, mut reversals, mut down) = (false, false, 0, 0);
    // Go around twice, so that every turn and every reversal is met wherever the corners begin.
    let around = corners
        .clone()
        .cycle()
        .skip(1)
        .zip(corners.clone().cycle().skip(2));
    let rounds = 2 * corners.clone().count();
    for (at, (next, after)) in corners.cycle().zip(around).take(rounds) {
        let side = [next[0] - at[0], next[1] - at[1]];
        let turn = cross(side, [after[0] - next[0], after[1] - next[1]]);
        is_right |= turn > 0;
        is_left |= turn < 0;
        let sign = side[1].signum();
        if sign != 0 && sign != down {
            reversals += i32::from(down != 0);
            down = sign;
        }
    }
    // A convex polygon reverses twice per round: at most four times in two rounds.
    !(is_right && is_left) && reversals <= 4
}

/// A triangle that is set up for plane equations: its corners in sub-pixels, their depths, and its
/// gradients.
pub(super) struct SetUp {
    pub(super) points: [Point; 3],
    pub(super) depths: [u16; 3],
    pub(super) gradients: Gradients,
}

impl SetUp {
    /// Sets up a triangle. Returns `None` if it is seen from behind or has no area.
    #[inline(always)]
    pub(super) fn new(t: &[Vertex; 3]) -> Option<Self> {
        let points = t.map(|v| [v.x.to_bits(), v.y.to_bits()]);
        Some(Self {
            points,
            depths: t.map(|v| v.depth),
            gradients: Gradients::new(points)?,
        })
    }
}

/// Returns the ramp of a plane along a row, starting at a pixel.
#[inline(always)]
fn ramp(plane: &Plane, at: Point) -> Ramp {
    Ramp::from_bits(plane.at(at), plane.step)
}

impl<P: Pixel> Canvas<'_, P> {
    /// Draws a convex polygon by Gouraud shading. Each corner comes with its colour, which
    /// [`colour`](super::colour) computes. Returns false, and draws nothing, if the polygon does
    /// not [fit](Canvas).
    pub fn gouraud(&mut self, polygon: &[(Vertex, u32)]) -> bool {
        fan(polygon, |(vertex, _)| vertex, |t| self.gouraud_triangle(t))
    }

    /// Draws a convex polygon by naive Phong shading, as [`Span::naive`](super::Span::naive) does.
    /// N is a plane over each triangle. Returns false, and draws nothing, if the polygon does not
    /// [fit](Canvas).
    pub fn naive<H: Highlight, const REFINED: bool, const L: usize>(
        &mut self,
        polygon: &[Vertex],
        lights: &[Light<'_, P>; L],
    ) -> bool {
        fan(
            polygon,
            |v| v,
            |t| self.naive_triangle::<H, REFINED, L>(&t, lights),
        )
    }

    /// Draws a convex polygon by fast Phong shading, as [`Span::fast`](super::Span::fast) does. J,
    /// K and N are planes over each triangle. Returns false, and draws nothing, if the polygon does
    /// not [fit](Canvas).
    pub fn fast<H: Highlight, const REFINED: bool, const L: usize>(
        &mut self,
        polygon: &[Vertex],
        lights: &[Light<'_, P>; L],
    ) -> bool {
        fan(
            polygon,
            |v| v,
            |t| self.fast_triangle::<H, REFINED, L>(&t, lights),
        )
    }

    fn gouraud_triangle(&mut self, t: [(Vertex, u32); 3]) {
        // Stay 128 away from both ends of 16 bits, which is the room that planes and steps need to
        // round. The tables' own colours are that far away already.
        let within = |half: u32| half.clamp(128, 65_408);
        let [a, b, c] = t.map(|(_, colour)| {
            let (red_blue, green) = halves(colour);
            let (red, blue) = (within(red_blue >> 16), within(red_blue & 0xFFFF));
            (red << 16 | blue, within(green))
        });
        let red = [a.0 >> 16, b.0 >> 16, c.0 >> 16];
        let blue = [a.0 & 0xFFFF, b.0 & 0xFFFF, c.0 & 0xFFFF];
        let green = [a.1, b.1, c.1];
        let corners = t.map(|(vertex, _)| vertex);
        let Some(SetUp {
            points,
            depths,
            gradients: g,
        }) = SetUp::new(&corners)
        else {
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
        // A rounded step is off by up to ½ per pixel, which is 64 over a piece of 128 pixels, and a
        // plane by up to 20. Corners are 128 away from both ends of 16 bits, so no channel carries
        // into another.
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
        let Some(SetUp {
            points,
            depths,
            gradients: g,
        }) = SetUp::new(t)
        else {
            return;
        };
        let n = lowered(t);
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
        let Some(SetUp {
            points,
            depths,
            gradients: g,
        }) = SetUp::new(t)
        else {
            return;
        };
        let n = lowered(t);
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
        // ΔN in Q18, rounded, below 2¹⁵. ΔN·ΔN is below 3 · 2³⁰, which only an unsigned number
        // holds.
        let growth = [nx.step, ny.step, nz.step].map(|step| (step + (1 << 11)) >> 12);
        let square = |x: i32| (x * x) as u32;
        let bend = ((square(growth[0]) + square(growth[1]) + square(growth[2])) >> 6) as i32;
        scan(points, (self.width, self.height), |y, first, end| {
            self.row(y, (first, end), (&z, &g), |line, x| {
                let at = g.place(x, y);
                let n = [nx.at(at) >> 15, ny.at(at) >> 15, nz.at(at) >> 15];
                // D_next − D = 2 N·ΔN + ΔN·ΔN. Each product of N and ΔN is in Q33 and below 2³⁰;
                // doubled and shifted to Q30 that is a shift by 2.
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

    /// Returns the plane of depth, or `None` if it is too steep. Without a depth buffer any plane
    /// will do.
    #[inline(always)]
    pub(super) fn depth_plane(&self, g: &Gradients, depths: [u16; 3]) -> Option<Plane> {
        if self.has_depth() {
            g.plane16(depths)
        } else {
            Some(Plane::default())
        }
    }
}

/// Returns the unit normals of a triangle's corners, times 255/256.
///
/// The scale changes no colour, because dividing by √D cancels it. It makes room for errors of D
/// below the 1 + 2⁻¹¹ where its table wraps: sides of 32 pixels and more lose bits, which moves a
/// normal by up to 2⁻¹¹ in each component, and over 128 pixels the rounding of ΔN adds √3 2⁻¹¹ to
/// D.
#[inline(always)]
fn lowered(t: &[Vertex; 3]) -> [Bits; 3] {
    let [a, b, c] = normals(t);
    [scaled(a), scaled(b), scaled(c)]
}

/// Returns the planes of N's components, or `None` if one is too steep.
#[inline(always)]
fn normal_planes(g: &Gradients, [a, b, c]: [Bits; 3]) -> Option<[Plane; 3]> {
    let one = |i: usize| g.plane([a[i], b[i], c[i]]);
    Some([one(0)?, one(1)?, one(2)?])
}

/// The planes of J and K of each light.
type ProductPlanes<const L: usize> = ([Plane; L], [Plane; L]);

/// Returns the planes of J and K of each light, or `None` if one is too steep (L21 4.3).
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
