//! Products of unit normals as quadratics over a triangle, for the methods that set up one per
//! polygon.

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3, vec3};
use crate::shading::walks::Quadratic;
use crate::shading::walks::values::{each, scaled, sum};
use crate::shading::{
    Corner, Corners, Info, LightAt, Normal, PerLight, Pixel, Shader, Span, Values,
};

/// J of each light, and K.
pub(crate) type Products<F, const L: usize> = (PerLight<F, L>, F);

/// The coefficients of 1, x, y, x², xy, y², and the point of the picture from which x and y are
/// measured, in pixels.
pub(crate) type OverPolygon<F, const L: usize> = ([Products<F, L>; 6], [F; 2]);

/// The largest D/ℓ for which quadratics are used, which three normals 60° apart have. D is the
/// longest distance between two of the weighted normals, and ℓ the least length between them.
pub(crate) const WIDEST: f32 = 1.25;
/// The most by which barycentric coordinates may grow across a triangle's box: more growth loses
/// too many digits.
const STEEPEST: f32 = 64.0;

/// Returns the vector as plain `f32`, so that operations that choose a polygon's kind are not
/// counted.
#[inline(always)]
pub(crate) fn plain<R: Real>(v: Vec3<R>) -> Vec3<f32> {
    vec3([v.x.value(), v.y.value(), v.z.value()])
}

/// Returns a lower bound of ℓ: the part of v = Σ b_i N_i w_i along the mean direction m of the
/// corners is at least min w_i · min N_i·m.
pub(crate) fn least_length(corners: [(Vec3<f32>, f32); 3]) -> f32 {
    let mean = (corners[0].0 + corners[1].0 + corners[2].0).unit();
    let least = |of: [f32; 3]| of[0].min(of[1]).min(of[2]);
    least(corners.map(|(normal, _)| normal.dot(mean))) * least(corners.map(|(_, weight)| weight))
}

/// Returns D, the longest distance between two of three vectors.
pub(crate) fn longest([a, b, c]: [Vec3<f32>; 3]) -> f32 {
    let square = |d: Vec3<f32>| d.dot(d);
    Num::sqrt(square(a - b).max(square(b - c)).max(square(c - a)))
}

/// Returns the longest distance of one of three vectors from their mean.
pub(crate) fn farthest([a, b, c]: [Vec3<f32>; 3]) -> f32 {
    let middle = (a + b + c) * (1.0 / 3.0);
    let square = |v: Vec3<f32>| (v - middle).dot(v - middle);
    Num::sqrt(square(a).max(square(b)).max(square(c)))
}

/// Returns a distance `across` three unit vectors times their weights, over ℓ; infinity where ℓ may
/// be 0.
pub(crate) fn relative(across: fn([Vec3<f32>; 3]) -> f32, corners: [(Vec3<f32>, f32); 3]) -> f32 {
    let length = least_length(corners);
    if length > 0.0 {
        across(corners.map(|(unit, weight)| unit * weight)) / length
    } else {
        f32::INFINITY
    }
}

/// Returns D/ℓ of three unit normals and their weights.
pub(crate) fn width(corners: [(Vec3<f32>, f32); 3]) -> f32 {
    relative(longest, corners)
}

/// Returns the unit normals and weights of a polygon of a frame, if it is a whole triangle that is
/// not too [wide](WIDEST).
pub(crate) fn narrow_triangle(frame: &Frame, polygon: &Polygon) -> Option<[(Vec3<f32>, f32); 3]> {
    let &[a, b, c] = frame.corners(polygon) else {
        return None;
    };
    let is_whole = [a, b, c].iter().all(|&v| frame.clip_corner(v).is_none());
    let corners = [a, b, c].map(|v| (vec3(frame.normal(v)), frame.weight(v)));
    (is_whole && width(corners) <= WIDEST).then_some(corners)
}

/// Returns the corners of a polygon and the growth over it, if it is a whole triangle that is not
/// too wide, and no sliver.
#[inline(always)]
pub(crate) fn set_up_triangle<R: Real>(
    polygon: &Corners<'_, R>,
) -> Option<([Corner<R>; 3], Growth<R>)> {
    let &[a, b, c] = polygon.all else {
        return None;
    };
    let growth = Growth::of([&a, &b, &c])?;
    let width = width([a, b, c].map(|v| (plain(v.normal), v.weight.value())));
    (polygon.is_whole && width <= WIDEST).then_some(([a, b, c], growth))
}

/// The growth of the barycentric coordinates b and c over a triangle: `b = p x + q y`,
/// `c = r x + s y`, from its first corner.
#[derive(Clone, Copy)]
pub(crate) struct Growth<R> {
    pub p: R,
    pub q: R,
    pub r: R,
    pub s: R,
}

impl<R: Real> Growth<R> {
    /// Returns the growth over a triangle; `None` if it has no area, or is so thin that too many
    /// digits would be lost.
    #[inline(always)]
    pub fn of([a, b, c]: [&Corner<R>; 3]) -> Option<Growth<R>> {
        let from_a = |at: [R; 2]| [at[0] - a.place[0], at[1] - a.place[1]];
        let ([bx, by], [cx, cy]) = (from_a(b.place), from_a(c.place));
        let area = bx * cy - by * cx;
        let over_area = area.broadcast(1.0) / area;
        let [p, q, r, s] = [cy, -cx, -by, bx].map(|side| side * over_area);
        let extent = [bx, by, cx, cy].map(|side| side.value().abs());
        let growth = [p, q, r, s].map(|growth| growth.value().abs());
        let is_steep = growth.iter().sum::<f32>() * extent.iter().sum::<f32>() > STEEPEST;
        (area.value() != 0.0 && !is_steep).then_some(Growth { p, q, r, s })
    }
}

/// Returns the quadratic through values at three corners A, B, C and half-way along the edges AB,
/// BC, CA: its coefficients of 1, x, y, x², xy, y², from the first corner. In the barycentric
/// coordinates b, c of the second and third corners it is
///
/// ```text
/// F = A + b (4 AB − 3 A − B) + c (4 CA − 3 A − C) + b² 2 (A + B − 2 AB) + c² 2 (A + C − 2 CA) + bc 4 (A + BC − AB − CA)
/// ```
#[inline(always)]
pub(crate) fn lagrange<R: Real, P: Values<R>>(
    [a, b, c]: [P; 3],
    [ab, bc, ca]: [P; 3],
    Growth { p, q, r, s }: Growth<R>,
) -> [P; 6] {
    let to_b = mixed([(ab, 4.0), (a, -3.0), (b, -1.0)]);
    let to_c = mixed([(ca, 4.0), (a, -3.0), (c, -1.0)]);
    let to_bb = mixed([(a, 2.0), (b, 2.0), (ab, -4.0)]);
    let to_cc = mixed([(a, 2.0), (c, 2.0), (ca, -4.0)]);
    let to_bc = mixed([(a, 4.0), (bc, 4.0), (ab, -4.0), (ca, -4.0)]);
    let linear = |b, c| sum([scaled(to_b, b), scaled(to_c, c)]);
    let square = |bb, bc, cc| sum([scaled(to_bb, bb), scaled(to_bc, bc), scaled(to_cc, cc)]);
    [
        a,
        linear(p, r),
        linear(q, s),
        square(p * p, p * r, r * r),
        square(p * q * 2.0, p * s + q * r, r * s * 2.0),
        square(q * q, q * s, s * s),
    ]
}

/// Returns the sum of values, each multiplied by its factor.
#[inline(always)]
fn mixed<F: Num, P: Values<F>, const N: usize>(all: [(P, f32); N]) -> P {
    sum(all.map(|(value, factor)| each(value, |_, x| *x = *x * factor)))
}

/// The kind of polygons whose products are quadratics; the other kind is
/// [`DuffOfNormals`](crate::shading::methods::roots::duff_phong::DuffOfNormals).
#[derive(Clone, Copy, Debug, Default)]
pub struct Quadratics<const L: usize>;

impl<const L: usize> Shader for Quadratics<L> {
    const INFO: Info = Info::of_kind("quadratic");
    type Constants<F: Num> = OverPolygon<F, L>;
    type Carries = Normal;
    type Walk<F: Num> = (PerLight<Quadratic<F>, L>, Quadratic<F>);
    const VALUES: &'static [&'static str] = &["J_i", "K"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let ((of, from), [x, y]) = (span.constants(), span.place());
        let from = [x - x.of_each(|_| from[0]), y - y.of_each(|_| from[1])];
        let mut j = PerLight::new(lit.count(), Quadratic::zero(lit.zero()));
        for i in 0..lit.count() {
            j.values[i] = along(each_of(|k| of[k].0.values[i]), from);
        }
        (j, along(each_of(|i| of[i].1), from))
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}

/// Returns the walk of a quadratic in x and y along a row, from a point.
#[inline(always)]
pub(crate) fn along<F: Num>(
    [c, cx, cy, cxx, cxy, cyy]: [F::One; 6],
    [x, y]: [F; 2],
) -> Quadratic<F> {
    let all = |value: F::One| x.of_each(|_| value);
    let (curve, slope) = (all(cxx), all(cx) + all(cxy) * y);
    // Horner's scheme in y, then in x; only x grows along a row, so the second difference comes
    // from x² only.
    let at = all(c) + (all(cy) + all(cyy) * y) * y + (slope + curve * x) * x;
    Quadratic::new(at, slope + curve * x * 2.0, curve)
}

/// Returns `of` of 0 to 5.
#[inline(always)]
pub(crate) fn each_of<T>(of: impl Fn(usize) -> T) -> [T; 6] {
    [of(0), of(1), of(2), of(3), of(4), of(5)]
}
