//! Products of vectors toward lights and eye at positions as quadratics over a triangle, for the
//! methods that set up one per polygon.

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3, vec3};
use crate::scene::{Falloff, LightTerm, Place};
use crate::shading::methods::quadratics::over_triangle::{
    Growth, WIDEST, along, each_of, least_length, longest, plain, relative, set_up_triangle,
};
use crate::shading::walks::Quadratic;
use crate::shading::walks::products;
use crate::shading::{
    Approximation, Corner, Corners, Info, LightAt, NormalAndPlace, PerLight, Pixel, Shader, Span,
};

products! {
    /// The products of unit vectors: K = V·N; J = L·N and L·V of each light, and its strength.
    UnitProducts { k } per light { j, l_v, strength }
}

/// The coefficients of 1, x, y, x², xy, y².
type Coefficients<F, const L: usize> = [UnitProducts<F, L>; 6];

/// The coefficients, and the point of the picture from which x and y are measured, in pixels.
pub(crate) type OverTriangle<F, const L: usize> = (Coefficients<F, L>, [F; 2]);

/// Sets the coefficients of K.
#[inline(always)]
pub(crate) fn set_view<F: Copy, const L: usize>(to: &mut Coefficients<F, L>, k: [F; 6]) {
    for (of, k) in to.iter_mut().zip(k) {
        of.k = k;
    }
}

/// Sets the coefficients of J, L·V and the strength of a light.
#[inline(always)]
pub(crate) fn set_light<F: Copy, const L: usize>(
    to: &mut Coefficients<F, L>,
    light: usize,
    all: [(F, F, F); 6],
) {
    for (of, (j, l_v, strength)) in to.iter_mut().zip(all) {
        of.j.values[light] = j;
        of.l_v.values[light] = l_v;
        of.strength.values[light] = strength;
    }
}

/// A corner of a triangle and its position in the world.
pub(crate) type Placed<R> = (Corner<R>, Vec3<R>);

/// Returns the corners of a polygon and the growth over it, if products are quadratics there: if it
/// is a triangle but no sliver, and no vector toward a light or the eye, and no normal, changes by
/// too much. Not inlined, because the code is equal for any count of lights.
#[inline(never)]
pub(crate) fn set_up_placed<R: Real>(
    lit: &LightAt<'_, R>,
    polygon: &Corners<'_, R>,
) -> Option<([Placed<R>; 3], Growth<R>)> {
    let ([a, b, c], growth) = set_up_triangle(polygon)?;
    let corners = [(a, a.position), (b, b.position), (c, c.position)];
    let lights = lit.stored.iter().map(|light| (light.place, light.falloff));
    let seen = Triangle(corners.map(|(v, p)| (plain(v.normal), plain(p), v.weight.value())));
    seen.is_narrow(lit.model.eye, lights)
        .then_some((corners, growth))
}

/// A measure of the distance across a triangle of vectors, by which a quadratic's error grows.
pub(crate) type Across = fn([Vec3<f32>; 3]) -> f32;

/// Unit normals, positions and weights of the corners of a triangle.
///
/// **The error of a quadratic** is a share of the third derivative along a line. Let v be a vector
/// that is linear on the screen, as N/w and (p − P)/w are, g = v/|v| its direction, and a = D/ℓ
/// with a distance D `across` the triangle and the least length ℓ of v. Then
///
/// ```text
/// |g′| ≤ a,   |g″| ≤ √(4/3) a²,   |g‴| ≤ 3 a³,      so that of the product of two   |(g·h)‴| ≤ 3 (a + b)³
/// ```
/// as for a unit vector at the angle atan(s/h) on a line at the distance h from 0. There the nth
/// derivative of 1/r is at most n!/rⁿ⁺¹, and that of 1/r² at most (n + 1)!/rⁿ⁺². For strengths,
/// with ρ the difference of weights as a share of the largest weight w, this gives
///
/// ```text
/// |(w/|v|)‴| ≤ 6 (a + ρ)³ w/ℓ,      |(w²/|v|²)‴| ≤ 24 (a + ρ)³ w²/ℓ²
/// ```
/// for 1/d and 1/d², and for 1/(1 + k d²) if v is (w, √k (p − P)/w), of four coordinates.
pub(crate) struct Triangle(pub(crate) [(Vec3<f32>, Vec3<f32>, f32); 3]);

impl Triangle {
    /// Returns a third of the largest third derivative of a product: (a + b)³ of the two vectors
    /// that turn most.
    fn turn(
        &self,
        across: Across,
        eye: Place<Vec3<f32>>,
        lights: impl Iterator<Item = Light>,
    ) -> f32 {
        let normal = relative(across, self.0.map(|(n, _, weight)| (n, weight)));
        let view = self.vectors(eye).map_or(0.0, |to| relative(across, to));
        let light = |light: Light| self.vectors(light.0).map_or(0.0, |to| relative(across, to));
        let light = lights.map(light).fold(0.0, f32::max);
        let most = (normal + view).max(normal + light).max(view + light);
        most * most * most
    }

    /// Returns a third of the largest third derivative of a light's strength, as a factor and the
    /// strength that it multiplies; 0 without falloff.
    pub(crate) fn fall(&self, across: Across, (place, falloff): Light) -> [f32; 2] {
        let Some(to) = self.vectors(place) else {
            return [0.0; 2];
        };
        let weights = self.0.map(|(_, _, weight)| weight);
        let least = weights[0].min(weights[1]).min(weights[2]);
        let most = weights[0].max(weights[1]).max(weights[2]);
        let differ = across(weights.map(|weight| vec3([weight, 0.0, 0.0])));
        let (far, length) = (
            across(to.map(|(unit, length)| unit * length)),
            least_length(to),
        );
        let (factor, far, length) = match falloff {
            Falloff::None => return [0.0; 2],
            Falloff::Inverse => (2.0, far, length),
            Falloff::InverseSquare => (8.0, far, length),
            Falloff::Attenuation(k) => {
                let squared = |w: f32, v: f32| Num::sqrt(w * w + k * v * v);
                (8.0, squared(differ, far), squared(least, length.max(0.0)))
            }
        };
        let change = far / length + differ / most;
        let strength = match falloff {
            Falloff::Inverse => most / length,
            _ => most / length * (most / length),
        };
        if length > 0.0 {
            [factor * change * change * change, strength]
        } else {
            [f32::INFINITY; 2]
        }
    }

    /// Returns the unit vectors from the corners to a position, and their lengths times the
    /// weights; `None` for a place at infinity.
    fn vectors(&self, place: Place<Vec3<f32>>) -> Option<[(Vec3<f32>, f32); 3]> {
        let Place::Local(position) = place else {
            return None;
        };
        Some(self.0.map(|(_, point, weight)| {
            let to = position - point;
            let length = Num::sqrt(to.dot(to));
            (to * (1.0 / length), length * weight)
        }))
    }

    /// True if quadratics follow products and strengths as closely as [`WIDEST`] demands for
    /// normals.
    fn is_narrow(
        &self,
        eye: Place<Vec3<f32>>,
        lights: impl Iterator<Item = Light> + Clone,
    ) -> bool {
        const MOST: f32 = WIDEST * WIDEST * WIDEST;
        let mut falls = lights.clone().map(|light| self.fall(longest, light)[0]);
        self.turn(longest, eye, lights) <= MOST && falls.all(|fall| fall <= MOST)
    }
}

/// The place of a light, and its falloff.
type Light = (Place<Vec3<f32>>, Falloff);

/// Returns a bound of the error on a polygon of quadratics whose error is a `share` of their third
/// derivatives: see [`Triangle`]. The bound is 0 where the vectors are stepped instead.
pub(crate) fn approximation(
    frame: &Frame,
    polygon: &Polygon,
    across: Across,
    share: f64,
) -> Approximation {
    let &[a, b, c] = frame.corners(polygon) else {
        return Approximation::NONE;
    };
    let corner = |v: u32| {
        let [normal, point] = [frame.normal(v), frame.position(v)].map(vec3);
        (normal, point, frame.weight(v))
    };
    let triangle = Triangle([a, b, c].map(corner));
    let lighting = &frame.lightings()[polygon.material as usize];
    let eye = lighting.view.map(vec3);
    let seen = |light: &LightTerm| (light.place.map(vec3), light.falloff);
    let lights = lighting.lights.iter().map(seen);
    if !triangle.is_narrow(eye, lights.clone()) {
        return Approximation::NONE;
    }
    let mut colour = [0.0; 3];
    for (light, seen) in lighting.lights.iter().zip(lights.clone()) {
        let [factor, strength] = triangle.fall(across, seen).map(f64::from);
        for (c, colour) in colour.iter_mut().enumerate() {
            let lit = f64::from(light.diffuse[c] + light.specular[c]);
            *colour += 3.0 * share * factor * strength * lit;
        }
    }
    Approximation {
        cosine: 3.0 * share * f64::from(triangle.turn(across, eye, lights)),
        colour: colour.into_iter().fold(0.0, f64::max),
        ..Approximation::NONE
    }
}

/// The kind of polygons whose products are quadratics; the other kind is
/// [`DuffPhongLocal`](crate::shading::methods::roots::duff_phong::DuffPhongLocal).
#[derive(Clone, Copy, Debug, Default)]
pub struct QuadraticsLocal<const L: usize>;

impl<const L: usize> Shader for QuadraticsLocal<L> {
    const INFO: Info = Info::of_kind("quadratic");
    type Constants<F: Num> = OverTriangle<F, L>;
    type Carries = NormalAndPlace;
    type Walk<F: Num> = UnitProducts<Quadratic<F>, L>;
    const VALUES: &'static [&'static str] = &["K", "J_i", "L_i.V", "strength_i"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let ((of, from), [x, y]) = (span.constants(), span.place());
        let from = [x - x.of_each(|_| from[0]), y - y.of_each(|_| from[1])];
        let mut walk = UnitProducts::new(lit.count(), Quadratic::zero(lit.zero()));
        walk.k = along(each_of(|i| of[i].k), from);
        for light in 0..lit.count() {
            walk.j.values[light] = along(each_of(|i| of[i].j.values[light]), from);
            walk.l_v.values[light] = along(each_of(|i| of[i].l_v.values[light]), from);
            walk.strength.values[light] = along(each_of(|i| of[i].strength.values[light]), from);
        }
        walk
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F> {
        let mut colour = lit.ambient();
        for index in 0..lit.count() {
            let falls = lit.stored[index].falloff != Falloff::None;
            let strength = falls.then_some(pixel.strength.values[index]);
            let light = lit.light_of_strength(index, pixel.l_v.values[index], strength);
            let l_n = pixel.j.values[index];
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, pixel.k)); // 4.5
        }
        colour
    }
}
