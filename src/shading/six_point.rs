//! Phong shading by one quadratic a polygon: no root and no division at a pixel (Seiler 1998).

use super::increments::{Quadratic, Walk};
use super::planes::{each, scaled};
use super::{
    Approximation, Corners, Family, Info, Linear, Lit, Local, PerLight, Pixel, Roundings, Shader,
    Span, Standing, Stepped,
};
use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3, vec3};
use crate::reference::Model;
use crate::scene::Interpolation;

/// Six-point quadratics, for up to `L` lights: `J = L·N` and `K = V·N` of *unit* normals are computed at the corners of a triangle
/// and half-way along its edges. The quadratic through these six points in the barycentric coordinates b, c of two corners
///
/// ```text
/// F = A + b (4 AB − 3 A − B) + c (4 AC − 3 A − C) + b² 2 (A + B − 2 AB) + c² 2 (A + C − 2 AC) + bc 4 (A + BC − AB − AC)
/// ```
///
/// is one in x and y, which a run steps by two additions. Triangles that share an edge share three of the points, so that the
/// picture has no seams. Under perspective the points are those of the screen, where N/w is linear: half-way stands
/// N_1/w_1 + N_2/w_2. Other polygons, pieces that clipping cut, slivers, and triangles whose normals turn by more than about 60° are
/// shaded as by [`DuffPhong`](super::duff_phong::DuffPhong).
///
/// **Its error.** Let v = Σ b_i N_i w_i be the normal that is interpolated, D the longest distance between two of the N_i w_i, and ℓ the
/// least length of v, so that g = v/|v| is what the quadratic Πg follows. With φ_i the weights of the six points p_i (Ciarlet, Wagschal
/// 1971)
///
/// ```text
/// |g − Πg| ≤ ⅙ Σ |φ_i| |g‴| |v − v(p_i)|³,     |g‴| ≤ 3/ℓ³
/// ```
/// where g‴ is the third derivative along a line: that of a unit vector whose angle is atan(s/h) at the distance h of the line from
/// 0. `|v − v(p_i)|` is at most D times half of the sum of the differences of the coordinates, with which the sum is below 0.204
/// everywhere on a triangle: the error is below 0.102 (D/ℓ)³. As for ℓ, v is at least as long as its part along the mean direction m of
/// the corners: min w_i · min N_i·m.
#[derive(Clone, Copy, Debug, Default)]
pub struct SixPoint<const L: usize> {
    kind: u8,
}

/// The kind of polygons without a quadratic.
const ROOTS: u8 = 1;
/// The largest D/ℓ: that of three normals 60° apart.
const WIDEST: f32 = 1.25;
/// The most by which barycentric coordinates grow from one side of a triangle's box to the other: more loses too many digits.
const STEEPEST: f32 = 64.0;

/// Returns D/ℓ of three unit normals and their weights: see [`SixPoint`]. More than any number where ℓ may be 0.
fn width(corners: [(Vec3<f32>, f32); 3]) -> f32 {
    let [a, b, c] = corners.map(|(normal, weight)| normal * weight);
    let square = |d: Vec3<f32>| d.dot(d);
    let longest = square(a - b).max(square(b - c)).max(square(c - a));
    let mean = (corners[0].0 + corners[1].0 + corners[2].0).unit();
    let least = |of: [f32; 3]| of[0].min(of[1]).min(of[2]);
    let cosine = least(corners.map(|(normal, _)| normal.dot(mean)));
    let length = cosine * least(corners.map(|(_, weight)| weight));
    match length > 0.0 {
        true => Num::sqrt(longest) / length,
        false => f32::INFINITY,
    }
}

/// Bounds the error of six-point products on a polygon: see [`SixPoint`].
fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let &[a, b, c] = frame.corners(polygon) else {
        return Approximation::NONE;
    };
    let corner = |corner: u32| {
        let weight = match frame.interpolation() {
            Interpolation::Screen => 1.0,
            Interpolation::Perspective => frame.vertices()[corner as usize].inv_w,
        };
        (vec3(frame.normal(corner)), weight)
    };
    let is_whole = [a, b, c].iter().all(|&v| frame.clip_corner(v).is_none());
    let width = width([a, b, c].map(corner));
    match is_whole && width <= WIDEST {
        true => Approximation {
            cosine: 0.102 * libm::pow(width.into(), 3.0),
            ..Approximation::NONE
        },
        false => Approximation::NONE,
    }
}

type Products<F, const L: usize> = (PerLight<F, L>, F); // J of each light, K

impl<const L: usize> Shader for SixPoint<L> {
    const INFO: Info = Info {
        name: "six-point",
        ids: &["M10"],
        family: Family::Quadratics,
        standing: Standing::Default,
        title: "J = L.N and K = V.N as quadratics over each triangle",
        formula: "F(b) = sum Fi bi (2 bi - 1) + 4 (F12 b1 b2 + F23 b2 b3 + F31 b3 b1) of unit normals;  F_next = F + dF;  \
                  dF_next = dF + ddF\nI = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "Seiler 1998; Kirk, Voorhies 1990",
        model: Model::PhongConstant,
        fails: "where normals turn by more than 30 degrees over a triangle: a highlight may end, or peak, elsewhere",
        roundings: Roundings::new(24.0, 3.0, Stepped::Products),
        derivation: "as duff-phong, whose roots other polygons take; the coefficients of a quadratic take 6 roundings of sums of up to \
                     8 products of at most 1, and x^2 and y^2 as many, of coordinates of at most 1",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        ..Info::OF_PIXELS
    };
    const LOCAL: Local = Local::PerPolygon;
    const PASSES_NORMAL: bool = true;
    const KINDS: &'static [&'static str] = &["quadratic", "roots"];
    const READS_SPAN: bool = true;
    const SCALAR_ONLY: Option<&'static str> =
        Some("six-point steps quadratics of a polygon's own, and the row engine has no spans");
    type Constants<F: Num> = ([Products<F, L>; 6], [F; 2]); // of 1, x, y, x², xy, y²; the first corner
    type Varying<F: Num> = Vec3<F>; // N
    type Walk<F: Num> = SixPointWalk<F, L>;

    #[inline(always)]
    fn of_kind(self, kind: u8) -> Self {
        SixPoint { kind }
    }
    #[inline(always)]
    fn polygon<R: Real>(
        self,
        lit: &Lit<'_, R>,
        polygon: &Corners<'_, R>,
    ) -> (u8, Self::Constants<R>) {
        let zero = polygon.face.x.broadcast(0.0);
        let none = ([(PerLight::new(lit.count(), zero), zero); 6], [zero; 2]);
        let &[a, b, c] = polygon.all else {
            return (ROOTS, none);
        };
        let from_a = |at: [R; 2]| [at[0] - a.place[0], at[1] - a.place[1]];
        let ([bx, by], [cx, cy]) = (from_a(b.place), from_a(c.place));
        let area = bx * cy - by * cx;
        let over_area = zero.broadcast(1.0) / area;
        // b = p x + q y, c = r x + s y
        let [p, q, r, s] = [cy, -cx, -by, bx].map(|side| side * over_area);
        let extent = [bx, by, cx, cy].map(|side| side.value().abs());
        let growth = [p, q, r, s].map(|growth| growth.value().abs());
        let is_steep = growth.iter().sum::<f32>() * extent.iter().sum::<f32>() > STEEPEST;
        // Decided by plain values: which kind a polygon has is nothing that a method computes.
        let plain = |v: Vec3<R>| vec3([v.x.value(), v.y.value(), v.z.value()]);
        let width = width([a, b, c].map(|v| (plain(v.normal), v.weight.value())));
        if !polygon.is_whole || area.value() == 0.0 || is_steep || width > WIDEST {
            return (ROOTS, none);
        }
        let products = |n| lit.products::<L>(n);
        let [fa, fb, fc] = [a, b, c].map(|corner| products(corner.normal));
        let [na, nb, nc] = [a, b, c].map(|corner| corner.normal * corner.weight);
        let [ab, bc, ca] = [(na, nb), (nb, nc), (nc, na)].map(|(a, b)| products((a + b).unit()));
        // The coefficients of b, c, b², bc, c².
        let to_b = mixed([(ab, 4.0), (fa, -3.0), (fb, -1.0)]);
        let to_c = mixed([(ca, 4.0), (fa, -3.0), (fc, -1.0)]);
        let to_bb = mixed([(fa, 2.0), (fb, 2.0), (ab, -4.0)]);
        let to_cc = mixed([(fa, 2.0), (fc, 2.0), (ca, -4.0)]);
        let to_bc = mixed([(fa, 4.0), (bc, 4.0), (ab, -4.0), (ca, -4.0)]);
        let linear = |b, c| sum([scaled(to_b, b), scaled(to_c, c)]);
        let square = |bb, bc, cc| sum([scaled(to_bb, bb), scaled(to_bc, bc), scaled(to_cc, cc)]);
        let in_screen = [
            fa,
            linear(p, r),
            linear(q, s),
            square(p * p, p * r, r * r),
            square(p * q * 2.0, p * s + q * r, r * s * 2.0),
            square(q * q, q * s, s * s),
        ];
        (0, (in_screen, a.place))
    }
    #[inline(always)]
    fn vertex<F: Num>(self, _: &Lit<'_, F>, n: Vec3<F>) -> Vec3<F> {
        n
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let none = Quadratic::zero(lit.zero());
        let mut products = (PerLight::new(lit.count(), none), none);
        if self.kind == ROOTS {
            let Linear { at, step } = span.linear();
            let (j, k) = lit.products::<L>(at);
            let (dj, dk) = lit.products::<L>(step);
            products.1 = Quadratic::new(k, dk, lit.zero());
            for i in 0..lit.count() {
                products.0.values[i] = Quadratic::new(j.values[i], dj.values[i], lit.zero());
            }
            let square = Some(Quadratic::square(at, step));
            return SixPointWalk { products, square };
        }
        let (of, first) = span.constants();
        let [x, y] = span.place();
        let from_first = [x - x.of_each(|_| first[0]), y - y.of_each(|_| first[1])];
        products.1 = along(each_of(|i| of[i].1), from_first);
        for i in 0..lit.count() {
            products.0.values[i] = along(each_of(|k| of[k].0.values[i]), from_first);
        }
        SixPointWalk {
            products,
            square: None,
        }
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}

/// Products of unit normals as quadratics; or of other normals, linear, with their squared length.
#[derive(Clone, Copy, Debug)]
pub struct SixPointWalk<F, const L: usize> {
    products: (PerLight<Quadratic<F>, L>, Quadratic<F>),
    square: Option<Quadratic<F>>,
}

impl<F: Num, const L: usize> Walk<F> for SixPointWalk<F, L> {
    type Pixel = Products<F, L>;

    #[inline(always)]
    fn next(&mut self) -> Self::Pixel {
        let products = self.products.next();
        match &mut self.square {
            None => products,
            Some(square) => {
                let square = square.next();
                scaled(products, square.broadcast(1.0) / square.sqrt())
            }
        }
    }
}

/// Returns the sum of some products.
#[inline(always)]
fn sum<F: Num, const L: usize, const N: usize>(all: [Products<F, L>; N]) -> Products<F, L> {
    let mut sum = all[0];
    for other in &all[1..] {
        super::Planes::zip(&mut sum, *other, |a, b| a + b);
    }
    sum
}

/// Returns the sum of some products, each times a factor.
#[inline(always)]
fn mixed<F: Num, const L: usize, const N: usize>(
    all: [(Products<F, L>, f32); N],
) -> Products<F, L> {
    sum(all.map(|(products, factor)| each(products, |_, x| *x = *x * factor)))
}

/// Returns a quadratic in x and y along a row.
#[inline(always)]
fn along<F: Num>([c, cx, cy, cxx, cxy, cyy]: [F::One; 6], [x, y]: [F; 2]) -> Quadratic<F> {
    let all = |number: F::One| x.of_each(|_| number);
    let (curve, slope) = (all(cxx), all(cx) + all(cxy) * y);
    let at = all(c) + (all(cy) + all(cyy) * y) * y + (slope + curve * x) * x;
    Quadratic::new(at, slope + curve * x * 2.0, curve)
}

/// Returns the six numbers that `of` gives.
#[inline(always)]
fn each_of<T>(of: impl Fn(usize) -> T) -> [T; 6] {
    [of(0), of(1), of(2), of(3), of(4), of(5)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;
    use alloc::vec::Vec;

    type Vector = [f64; 3];

    fn sum(terms: &[(f64, Vector)]) -> Vector {
        [0, 1, 2].map(|c| terms.iter().map(|(factor, v)| factor * v[c]).sum())
    }

    fn length(v: Vector) -> f64 {
        v.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    fn unit(v: Vector) -> Vector {
        v.map(|c| c / length(v))
    }

    /// The weights of the six points at barycentric coordinates.
    fn weights(b: Vector) -> [f64; 6] {
        let corner = |i: usize| b[i] * (2.0 * b[i] - 1.0);
        let edge = |i: usize, j: usize| 4.0 * b[i] * b[j];
        [
            corner(0),
            corner(1),
            corner(2),
            edge(0, 1),
            edge(1, 2),
            edge(2, 0),
        ]
    }

    const POINTS: [Vector; 6] = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.5, 0.5, 0.0],
        [0.0, 0.5, 0.5],
        [0.5, 0.0, 0.5],
    ];

    fn grid(steps: u32) -> impl Iterator<Item = Vector> {
        (0..=steps).flat_map(move |i| {
            (0..=steps - i)
                .map(move |j| [i, j, steps - i - j].map(|part| f64::from(part) / f64::from(steps)))
        })
    }

    /// The sum of weights and cubes of distances that the bound takes for granted.
    #[test]
    fn the_sum_of_the_bound_is_below_its_constant() {
        let distance =
            |p: Vector, q: Vector| 0.5 * (0..3).map(|k| (p[k] - q[k]).abs()).sum::<f64>();
        let sum_at = |b: Vector| -> f64 {
            let terms = weights(b).into_iter().zip(POINTS);
            terms
                .map(|(weight, p)| weight.abs() * distance(b, p).powi(3))
                .sum()
        };
        let most = grid(400).map(sum_at).fold(0.0, f64::max);
        assert!((0.2..0.204).contains(&most), "{most}");
    }

    /// Random triangles of normals, with and without weights: the error is below the bound, and not far below it somewhere.
    #[test]
    fn no_quadratic_is_farther_from_the_unit_normal_than_stated() {
        let mut random = Random::new(10);
        let mut most = 0.0f64;
        let mut tried = 0;
        while tried < 2000 {
            let reach = 1.2 * random.signed().abs();
            let corners = [(); 3].map(|()| {
                let normal = vec3([reach * random.signed(), reach * random.signed(), 1.0]).unit();
                let weight = if tried % 2 == 0 {
                    1.0
                } else {
                    1.0 + 0.2 * random.signed()
                };
                (normal, weight)
            });
            let width = width(corners);
            if !(1e-2..=WIDEST).contains(&width) {
                continue;
            }
            tried += 1;
            let all = corners.map(|(n, w)| n.array().map(|c| f64::from(c) * f64::from(w)));
            let at = |b: Vector| unit(sum(&[(b[0], all[0]), (b[1], all[1]), (b[2], all[2])]));
            let bound = 0.102 * f64::from(width).powi(3);
            for b in grid(12) {
                let terms: Vec<_> = weights(b).into_iter().zip(POINTS.map(at)).collect();
                let error = length(sum(&[(1.0, sum(&terms)), (-1.0, at(b))]));
                // Normals are rounded to 2⁻²⁴.
                assert!(
                    error <= bound + 1e-6,
                    "{corners:?} at {b:?}: {error} over {bound}"
                );
                most = most.max(error / bound);
            }
        }
        assert!(most > 0.2, "{most}");
    }
}
