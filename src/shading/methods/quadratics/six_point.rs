//! Phong shading by one quadratic per polygon, with no root and no division at a pixel (Seiler
//! 1998).

use crate::frame::{Frame, Polygon};
use crate::number::{Real, Vec3};
use crate::reference::Model;
use crate::shading::methods::quadratics::over_triangle::{
    Growth, Quadratics, lagrange, longest, narrow_triangle, set_up_triangle, width,
};
use crate::shading::methods::quadratics::over_triangle_at_positions::{
    self as positional, OverTriangle, Placed, QuadraticsLocal, set_light, set_up_placed, set_view,
};
use crate::shading::methods::roots::duff_phong::{DuffOfNormals, DuffPhongLocal};
use crate::shading::{
    Approximation, Chosen, Corner, Corners, Family, Info, LightAt, LightModel, Method,
    MethodParameter, Needs, OneOf, Roundings, Spans, Stepped, Tier, Value, Values,
};

/// Six-point quadratics, for up to `L` lights. `J = L·N` and `K = V·N` of *unit* normals are
/// computed at the corners of a triangle and half-way along its edges. The quadratic through these
/// six points, in the barycentric coordinates b, c of two corners, is
///
/// ```text
/// F = A + b (4 AB − 3 A − B) + c (4 AC − 3 A − C) + b² 2 (A + B − 2 AB) + c² 2 (A + C − 2 AC) + bc 4 (A + BC − AB − AC)
/// ```
///
/// It is a quadratic in x and y, which a run steps by two additions. Triangles that share an edge
/// share three of the points, so the picture has no seams. Under perspective the points are those
/// on the screen, where N/w is linear: the value half-way is N_1/w_1 + N_2/w_2. Other polygons,
/// pieces that clipping has cut off, slivers, and triangles whose normals turn by more than about
/// 60° are shaded as in [`DuffPhong`](crate::shading::methods::roots::duff_phong::DuffPhong).
///
/// **Its error.** Let v = Σ b_i N_i w_i be the interpolated normal, D the longest distance between
/// two of the N_i w_i, and ℓ the least length of v. The quadratic Πg follows g = v/|v|. With φ_i
/// the weights of the six points p_i (Ciarlet, Wagschal 1971)
///
/// ```text
/// |g − Πg| ≤ ⅙ Σ |φ_i| |g‴| |v − v(p_i)|³,     |g‴| ≤ 3/ℓ³
/// ```
/// where g‴ is the third derivative along a line, of a unit vector whose angle is atan(s/h) at the
/// distance h of the line from 0. `|v − v(p_i)|` is at most D times half of the sum of the
/// differences of the coordinates. With this, the sum is below 0.204 everywhere on a triangle, so
/// the error is below 0.102 (D/ℓ)³. As for ℓ, v is at least as long as its part along the mean
/// direction m of the corners: min w_i · min N_i·m.
///
/// **Midpoints after Barrera.** With `midpoints=barrera`, normals half-way along edges take no root
/// (Barrera, Hast, Bengtsson 2006):
///
/// ```text
/// (N_1 + N_2)/|N_1 + N_2| ~ (N_1 + N_2) (5 − N_1·N_2)/8,    of length √(1 − u/2) (1 + u/4) ≤ 1,    u = 1 − N_1·N_2
/// ```
/// Their weights in F, 4 b_i b_j, sum to at most 4/3, so the error grows by 4/3 of what the
/// shortest one lacks. Under perspective, where the weights of corners differ, midpoints are always
/// exact.
#[derive(Clone, Copy, Debug, Default)]
pub struct SixPoint<const L: usize> {
    is_near: bool,
}

/// The value `barrera` of the only parameter.
const BARRERA: Value = Value::Word(1);

/// The error of quadratics as a share of the third derivative: a sixth of the sum of weights and
/// cubes of distances.
const SHARE: f64 = 0.204 / 6.0;

/// True if all corners have the same weight.
fn is_alike([a, b, c]: [f32; 3]) -> bool {
    a == b && b == c
}

/// Returns the unit normals half-way along the edges AB, BC, CA: by Barrera's polynomial if
/// `is_near` and corners have the same weight.
#[inline(always)]
fn midway<R: Real>(corners: [Corner<R>; 3], is_near: bool) -> [Vec3<R>; 3] {
    if is_near && is_alike(corners.map(|corner| corner.weight.value())) {
        let [a, b, c] = corners.map(|corner| corner.normal);
        return [(a, b), (b, c), (c, a)].map(|(a, b)| (a + b) * ((-a.dot(b) + 5.0) * 0.125));
    }
    let [a, b, c] = corners.map(|corner| corner.normal * corner.weight);
    [(a, b), (b, c), (c, a)].map(|(a, b)| (a + b).unit())
}

/// Returns how much shorter than 1 Barrera's midpoint of two unit normals is.
fn lack([a, b]: [Vec3<f32>; 2]) -> f64 {
    let u = f64::from(1.0 - a.dot(b)).clamp(0.0, 2.0);
    1.0 - libm::sqrt(1.0 - u / 2.0) * (1.0 + u / 4.0)
}

/// Returns a bound of the error of six-point products on a polygon: see [`SixPoint`].
fn approximation(frame: &Frame, polygon: &Polygon, parameters: &[Value]) -> Approximation {
    let Some(corners) = narrow_triangle(frame, polygon) else {
        return Approximation::NONE;
    };
    let [a, b, c] = corners.map(|(normal, _)| normal);
    let lacks = [[a, b], [b, c], [c, a]].map(lack);
    let short = if parameters[0] == BARRERA && is_alike(corners.map(|(_, weight)| weight)) {
        4.0 / 3.0 * lacks.into_iter().fold(0.0, f64::max)
    } else {
        0.0
    };
    let mut error = if frame.is_local() {
        positional::approximation(frame, polygon, longest, SHARE)
    } else {
        Approximation {
            cosine: 0.102 * libm::pow(width(corners).into(), 3.0),
            ..Approximation::NONE
        }
    };
    error.cosine += short;
    error
}

const SIX_POINT: Info = Info {
    name: "six-point",
    ids: &["M10"],
    family: Family::Quadratics,
    tier: Tier::Default,
    title: "J = L.N and K = V.N as quadratics over each triangle",
    formula: "F(b) = sum Fi bi (2 bi - 1) + 4 (F12 b1 b2 + F23 b2 b3 + F31 b3 b1) of unit normals;  F_next = F + dF;  \
              dF_next = dF + ddF\nI = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
    source: "Seiler 1998; Kirk, Voorhies 1990; midpoints=barrera: Barrera, Hast, Bengtsson 2006",
    model: Model::Phong,
    fails: "where normals turn by more than 30 degrees over a triangle: a highlight may end, or peak, elsewhere",
    roundings: Roundings::new(24.0, 3.0, Stepped::Products),
    derivation: "as duff-phong, which shades other polygons; the coefficients of a quadratic take 6 roundings of sums of up to \
                 8 products of at most 1, and x^2 and y^2 as many, of coordinates of at most 1",
    approximation,
    parameters: &[MethodParameter::word(
        "midpoints",
        "unit normals half-way along edges: by roots, or by Barrera's polynomial",
        &["exact", "barrera"],
    )],
    ..Info::OF_PIXELS
};

const SCALAR_ONLY: Option<&str> =
    Some("six-point steps quadratics of each polygon, and the row engine has no spans");

impl<const L: usize> Method for SixPoint<L> {
    const INFO: Info = SIX_POINT;
    const NEEDS: Needs = Needs {
        spans: Spans::Ends,
        scalar_only: SCALAR_ONLY,
        ..Needs::PIXELS
    };
    type Kinds = (Quadratics<L>, DuffOfNormals<L>);

    #[inline(always)]
    fn new(parameters: &[Value], _: &LightModel) -> Self {
        SixPoint {
            is_near: parameters[0] == BARRERA,
        }
    }
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let Some(([a, b, c], growth)) = set_up_triangle(polygon) else {
            return OneOf::Second(());
        };
        let products = |n| lit.products::<L>(n);
        let [fa, fb, fc] = [a, b, c].map(|corner| products(corner.normal));
        let midway = midway([a, b, c], self.is_near).map(products);
        let in_screen = lagrange([fa, fb, fc], midway, growth);
        OneOf::First((in_screen, a.place))
    }
}

/// Returns six points, each as the light seen from it and its unit normal: the corners, then
/// half-way along the edges AB, BC, CA on the screen.
#[inline(never)]
fn six_points<'a, R: Real>(
    lit: &LightAt<'a, R>,
    [a, b, c]: [Placed<R>; 3],
    is_near: bool,
) -> [(LightAt<'a, R>, Vec3<R>); 6] {
    let [ab, bc, ca] = midway([a.0, b.0, c.0], is_near);
    let at = |(corner, point): Placed<R>| (lit.at(point), corner.normal);
    let half_way = |normal, (a, p): Placed<R>, (b, q): Placed<R>| {
        let weights = a.weight + b.weight;
        let point = (p * a.weight + q * b.weight) * (weights.broadcast(1.0) / weights);
        (lit.at(point), normal)
    };
    [
        at(a),
        at(b),
        at(c),
        half_way(ab, a, b),
        half_way(bc, b, c),
        half_way(ca, c, a),
    ]
}

/// Returns the quadratic of K.
#[inline(never)]
fn of_view<R: Real>(points: &[(LightAt<'_, R>, Vec3<R>); 6], growth: Growth<R>) -> [R; 6] {
    let [a, b, c, ab, bc, ca] = points.map(|(lit, n)| n.dot(lit.view()));
    lagrange([a, b, c], [ab, bc, ca], growth)
}

/// Returns the quadratics of J, L·V and the strength of a light. Not inlined, because the code is
/// equal for any count of lights.
#[inline(never)]
fn of_light<R: Real>(
    points: &[(LightAt<'_, R>, Vec3<R>); 6],
    light: usize,
    growth: Growth<R>,
) -> [(R, R, R); 6] {
    let [a, b, c, ab, bc, ca] = points.map(|(lit, n)| {
        let seen = lit.seen(light);
        let strength = seen.strength.unwrap_or(n.x.broadcast(1.0));
        (n.dot(seen.to), seen.l_v, strength)
    });
    lagrange([a, b, c], [ab, bc, ca], growth)
}

/// Six-point quadratics where a light or the eye is at a position, for up to `L` lights. Beside J
/// and K there are quadratics of L·V and of each light's strength, with positions half-way along
/// edges on the screen, `(P_1/w_1 + P_2/w_2)/(1/w_1 + 1/w_2)`. Triangles that are near to a light
/// or the eye are shaded by Duff's method.
#[derive(Clone, Copy, Debug, Default)]
pub struct SixPointLocal<const L: usize>(SixPoint<L>);

impl<const L: usize> Method for SixPointLocal<L> {
    const INFO: Info = SIX_POINT;
    const NEEDS: Needs = Needs {
        spans: Spans::Ends,
        scalar_only: SCALAR_ONLY,
        general_only: true,
        ..Needs::PIXELS
    };
    type Kinds = (QuadraticsLocal<L>, DuffPhongLocal<L>);

    #[inline(always)]
    fn new(parameters: &[Value], model: &LightModel) -> Self {
        SixPointLocal(SixPoint::new(parameters, model))
    }
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let Some((corners, growth)) = set_up_placed(lit, polygon) else {
            return OneOf::Second(());
        };
        let points = six_points(lit, corners, self.0.is_near);
        let mut constants = OverTriangle::<R, L>::filled(lit.count(), lit.zero());
        set_view(&mut constants.0, of_view(&points, growth));
        for light in 0..lit.count() {
            set_light(&mut constants.0, light, of_light(&points, light, growth));
        }
        constants.1 = corners[0].0.place;
        OneOf::First(constants)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;
    use crate::number::vec3;
    use crate::scene::{Falloff, Place};
    use crate::shading::methods::quadratics::over_triangle::WIDEST;
    use crate::shading::methods::quadratics::over_triangle_at_positions::Triangle;
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

    /// The sum of weights and cubes of distances is below the constant in the bound.
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

    /// Random triangles of normals, with and without weights: the error is below the bound, and
    /// somewhere not far below it.
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

    /// Random triangles at random distances from a light, with and without weights: the error of a
    /// strength's quadratic is below the bound, and somewhere not far below it.
    #[test]
    fn no_quadratic_is_farther_from_a_strength_than_stated() {
        let mut random = Random::new(11);
        let falloffs = [
            Falloff::Attenuation(0.7),
            Falloff::Inverse,
            Falloff::InverseSquare,
        ];
        for falloff in falloffs {
            let (mut most, mut tried) = (0.0f64, 0);
            while tried < 2000 {
                let corner = |random: &mut Random| {
                    let point = vec3([random.signed(), random.signed(), random.signed()]);
                    let weight = 1.0 + 0.2 * random.signed();
                    (vec3([0.0, 0.0, 1.0]), point, weight)
                };
                let triangle = Triangle([(); 3].map(|()| corner(&mut random)));
                let light = random
                    .unit()
                    .map(|c| c * (2.0 + 8.0 * random.signed().abs()));
                let light = (Place::Local(vec3(light)), falloff);
                let [factor, strength] = triangle.fall(longest, light).map(f64::from);
                if factor > f64::from(WIDEST).powi(3) {
                    continue;
                }
                tried += 1;
                let at = |b: Vector| {
                    let weights = [0, 1, 2].map(|i| b[i] * f64::from(triangle.0[i].2));
                    let points = triangle.0.map(|(_, p, _)| p.array().map(f64::from));
                    let terms = [0, 1, 2].map(|i| (weights[i], points[i]));
                    let over = 1.0 / weights.iter().sum::<f64>();
                    let Place::Local(position) = light.0 else {
                        unreachable!("a position")
                    };
                    let to = sum(&[(1.0, position.array().map(f64::from)), (-over, sum(&terms))]);
                    let r = length(to);
                    match falloff {
                        Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * r * r),
                        Falloff::Inverse => 1.0 / r,
                        _ => 1.0 / (r * r),
                    }
                };
                let bound = 3.0 * SHARE * factor * strength;
                for b in grid(12) {
                    let terms = weights(b).into_iter().zip(POINTS.map(at));
                    let quadratic: f64 = terms.map(|(weight, value)| weight * value).sum();
                    let error = (quadratic - at(b)).abs();
                    assert!(
                        error <= bound * (1.0 + 1e-5),
                        "{falloff:?}, {:?} from {light:?} at {b:?}: {error} over {bound}",
                        triangle.0
                    );
                    most = most.max(error / bound);
                }
            }
            assert!(most > 0.05, "{falloff:?}: {most}");
        }
    }
}
