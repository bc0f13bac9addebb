//! Phong shading by Taylor's quadratic about the middle of a triangle, with no root and no division
//! at a pixel (Bishop, Weimer 1986).

use crate::frame::{Frame, Polygon};
use crate::number::{Real, Vec3, vec3};
use crate::reference::Model;
use crate::scene::{Falloff, Place};
use crate::shading::light::{LightUniforms, toward};
use crate::shading::methods::quadratics::over_triangle::{
    Growth, OverPolygon, Quadratics, each_of, farthest, narrow_triangle, relative, set_up_triangle,
};
use crate::shading::methods::quadratics::over_triangle_at_positions::{
    self as positional, OverTriangle, Placed, QuadraticsLocal, set_light, set_up_placed, set_view,
};
use crate::shading::methods::roots::duff_phong::{DuffOfNormals, DuffPhongLocal};
use crate::shading::{
    Approximation, Chosen, Corner, Corners, Family, Info, LightAt, Method, Needs, OneOf, Roundings,
    Spans, Stepped, Values,
};

/// Taylor's quadratics, for up to `L` lights. With `v = v_0 + x v_x + y v_y` the interpolated
/// normal, from the middle of a triangle,
///
/// ```text
/// J/|N| = L·v / √(v·v)  ~  T_0 + T_1 x + T_2 y + T_3 x² + T_4 xy + T_5 y²,     K/|N| in the same way
/// ```
/// which a run steps by two additions. The coefficients come from values that carry their
/// derivatives ([`Jet`]), because the printed ones, as they are usually copied, contain two
/// mistakes. Under perspective v is N/w. Polygons with more corners, pieces that clipping has cut
/// off, slivers, and triangles whose normals turn by more than about 60° are shaded as in
/// [`DuffPhong`](crate::shading::methods::roots::duff_phong::DuffPhong).
///
/// **Its error.** The rest of Taylor's formula is a third derivative. With r the longest distance
/// of a corner's v from v_0, ℓ the least length of v, and g = v/|v|,
///
/// ```text
/// |g − T| ≤ ⅙ |g‴| r³ ≤ ½ (r/ℓ)³,     |g‴| ≤ 3/ℓ³
/// ```
/// as [`SixPoint`](crate::shading::methods::quadratics::six_point::SixPoint) derives. The quadratic
/// misses the corners themselves, so neighbours differ along their edge by as much.
#[derive(Clone, Copy, Debug, Default)]
pub struct BishopWeimer<const L: usize>;

/// Returns a bound of the error of Taylor's quadratics on a polygon.
fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let Some(corners) = narrow_triangle(frame, polygon) else {
        return Approximation::NONE;
    };
    if frame.is_local() {
        return positional::approximation(frame, polygon, farthest, 1.0 / 6.0);
    }
    Approximation {
        cosine: 0.5 * libm::pow(relative(farthest, corners).into(), 3.0),
        ..Approximation::NONE
    }
}

/// Returns the middle of a triangle in the picture, in pixels.
#[inline(always)]
fn middle<R: Real>([a, b, c]: [Corner<R>; 3]) -> [R; 2] {
    [0, 1].map(|i| (a.place[i] + b.place[i] + c.place[i]) * (1.0 / 3.0))
}

/// A value as a function of x and y, cut off after the second order: the coefficients of 1, x, y,
/// x², xy, y².
#[derive(Clone, Copy)]
struct Jet<R>([R; 6]);

/// A vector as a linear function of x and y: the coefficients of 1, x, y.
type Plane<R> = [Vec3<R>; 3];

/// Returns the linear vector through three vectors at the corners of a triangle, from its middle
/// on.
#[inline(always)]
fn plane<R: Real>([a, b, c]: [Vec3<R>; 3], Growth { p, q, r, s }: Growth<R>) -> Plane<R> {
    let (to_b, to_c) = (b - a, c - a);
    let middle = (a + b + c) * (1.0 / 3.0);
    [middle, to_b * p + to_c * r, to_b * q + to_c * s]
}

impl<R: Real> Jet<R> {
    /// Returns the product with a linear function.
    #[inline(always)]
    fn times_linear(self, [c, x, y]: [R; 3]) -> Jet<R> {
        let [r, rx, ry, rxx, rxy, ryy] = self.0;
        Jet([
            r * c,
            r * x + rx * c,
            r * y + ry * c,
            rx * x + rxx * c,
            rx * y + ry * x + rxy * c,
            ry * y + ryy * c,
        ])
    }

    /// Makes a linear function.
    #[inline(always)]
    fn linear([c, x, y]: [R; 3]) -> Jet<R> {
        let zero = c.broadcast(0.0);
        Jet([c, x, y, zero, zero, zero])
    }

    /// Makes the product of two linear vectors.
    #[inline(always)]
    fn dot([v, vx, vy]: Plane<R>, [w, wx, wy]: Plane<R>) -> Jet<R> {
        Jet([
            v.dot(w),
            v.dot(wx) + vx.dot(w),
            v.dot(wy) + vy.dot(w),
            vx.dot(wx),
            vx.dot(wy) + vy.dot(wx),
            vy.dot(wy),
        ])
    }

    /// Returns the product with another function.
    #[inline(always)]
    fn times(self, Jet([c, x, y, xx, xy, yy]): Jet<R>) -> Jet<R> {
        let [r, rx, ry, rxx, rxy, ryy] = self.0;
        Jet([
            r * c,
            r * x + rx * c,
            r * y + ry * c,
            r * xx + rx * x + rxx * c,
            r * xy + rx * y + ry * x + rxy * c,
            r * yy + ry * y + ryy * c,
        ])
    }

    /// Returns the square.
    #[inline(always)]
    fn square(self) -> Jet<R> {
        self.times(self)
    }

    /// Returns the sum of this function and `other` times a factor.
    #[inline(always)]
    fn plus(self, Jet(other): Jet<R>, factor: f32) -> Jet<R> {
        let mut sum = self.0;
        for (sum, other) in sum.iter_mut().zip(other) {
            *sum = *sum + other * factor;
        }
        Jet(sum)
    }

    /// Returns 1 over the root. Let d be the constant part, and d (1 + q) the function; to the
    /// second order
    ///
    /// ```text
    /// 1/√(d (1 + q)) = (1 − q/2 + 3 q²/8) / √d
    /// ```
    #[inline(always)]
    fn rsqrt(self) -> Jet<R> {
        let [d, x, y, xx, xy, yy] = self.0;
        let over = d.broadcast(1.0) / d;
        let (x, y) = (x * over, y * over);
        let [xx, xy, yy] = [xx, xy, yy].map(|square| square * over);
        let r = over.sqrt();
        Jet([
            r,
            r * x * -0.5,
            r * y * -0.5,
            r * (x * x * 0.375 - xx * 0.5),
            r * (x * y * 0.75 - xy * 0.5),
            r * (y * y * 0.375 - yy * 0.5),
        ])
    }
}

const BISHOP_WEIMER: Info = Info {
    name: "bishop-weimer",
    ids: &["M09"],
    family: Family::Quadratics,
    title: "J and K of unit normals by Taylor's quadratic about the middle of each triangle",
    formula: "F(x, y) = T0 + T1 x + T2 y + T3 x^2 + T4 x y + T5 y^2 ~ L.N / |N|;  F_next = F + dF;  dF_next = dF + ddF\n\
              I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
    source: "Bishop, Weimer 1986, coefficients derived anew",
    claimed: "2 additions a pixel for diffuse light; 5 additions and 1 memory reference for Phong's model",
    model: Model::Phong,
    roundings: Roundings::new(40.0, 3.0, Stepped::Products),
    derivation: "as six-point; coefficients take three times as many roundings, as products of derivatives",
    approximation: |frame, polygon, _| approximation(frame, polygon),
    fails: "where normals turn by more than 15 degrees over a triangle; neighbours differ along their edge, which shows as seams",
    ..Info::OF_PIXELS
};

const SCALAR_ONLY: Option<&str> =
    Some("bishop-weimer steps quadratics of each polygon, and the row engine has no spans");

impl<const L: usize> Method for BishopWeimer<L> {
    const INFO: Info = BISHOP_WEIMER;
    const NEEDS: Needs = Needs {
        spans: Spans::Ends,
        scalar_only: SCALAR_ONLY,
        ..Needs::PIXELS
    };
    type Kinds = (Quadratics<L>, DuffOfNormals<L>);

    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let mut constants = OverPolygon::<R, L>::filled(lit.count(), lit.zero());
        let Some(([a, b, c], growth)) = set_up_triangle(polygon) else {
            return OneOf::Second(());
        };
        let [v, vx, vy] = plane([a, b, c].map(|v| v.normal * v.weight), growth);
        let [x, y, xy] = [v.dot(vx), v.dot(vy), vx.dot(vy)];
        let square = Jet([v.dot(v), x + x, y + y, vx.dot(vx), xy + xy, vy.dot(vy)]); // D
        let over = square.rsqrt();
        let unit = |to: Vec3<R>| over.times_linear([v.dot(to), vx.dot(to), vy.dot(to)]).0;
        let view = unit(lit.view());
        for (of, k) in constants.0.iter_mut().zip(view) {
            of.1 = k;
        }
        for light in lit.lights() {
            let j = unit(light.to);
            for (of, j) in constants.0.iter_mut().zip(j) {
                of.0.values[light.index] = j;
            }
        }
        constants.1 = middle([a, b, c]);
        OneOf::First(constants)
    }
}

/// The vectors over a triangle that are linear on the screen: N/w, the vectors toward lights and
/// eye over w, and 1/w.
struct Vectors<R> {
    corners: [Placed<R>; 3],
    growth: Growth<R>,
    n: Plane<R>,
    v: Plane<R>,
    over_n: Jet<R>,
    over_v: Jet<R>,
    weight: Jet<R>,
}

// Not inlined, because the code is equal for any count of lights.
impl<R: Real> Vectors<R> {
    #[inline(never)]
    fn of(lit: &LightAt<'_, R>, corners: [Placed<R>; 3], growth: Growth<R>) -> Self {
        let (zero, none) = (lit.zero(), vec3([lit.zero(); 3]));
        let weight = plane(corners.map(|(v, _)| vec3([v.weight, zero, zero])), growth);
        let n = plane(corners.map(|(v, _)| v.normal * v.weight), growth);
        let mut all = Vectors {
            corners,
            growth,
            n,
            v: [none; 3],
            over_n: Jet::dot(n, n).rsqrt(),
            over_v: Jet::linear([zero; 3]),
            weight: Jet::linear(weight.map(|v| v.x)),
        };
        all.v = all.toward(lit.model.eye);
        all.over_v = Jet::dot(all.v, all.v).rsqrt();
        all
    }

    #[inline(never)]
    fn toward(&self, place: Place<Vec3<f32>>) -> Plane<R> {
        match place {
            Place::Local(_) => {
                let to = |(v, p): Placed<R>| toward(place, p * v.weight, v.weight);
                plane(self.corners.map(to), self.growth)
            }
            Place::Infinite(direction) => {
                let none = self.n[0].x.broadcast(0.0);
                let none = vec3([none; 3]);
                [direction.broadcast(none.x), none, none]
            }
        }
    }

    /// Returns K.
    #[inline(never)]
    fn k(&self) -> Jet<R> {
        let product = Jet::dot(self.n, self.v);
        product.times(self.over_n).times(self.over_v)
    }

    /// Returns J, L·V and the strength of a light.
    #[inline(never)]
    fn light(&self, light: &LightUniforms) -> [Jet<R>; 3] {
        let l = self.toward(light.place);
        let square = Jet::dot(l, l);
        let over_l = square.rsqrt();
        let j = Jet::dot(l, self.n).times(over_l).times(self.over_n);
        let l_v = Jet::dot(l, self.v).times(over_l).times(self.over_v);
        let weight = self.weight;
        let strength = match light.falloff {
            Falloff::None => Jet::linear([1.0, 0.0, 0.0].map(|c| over_l.0[0].broadcast(c))),
            Falloff::Inverse => weight.times(over_l), // (1/w) / (d/w)
            Falloff::InverseSquare => weight.times(over_l).square(),
            Falloff::Attenuation(k) => {
                let all = weight.square().plus(square, k); // (1 + k d²)/w²
                weight.times(all.rsqrt()).square()
            }
        };
        [j, l_v, strength]
    }
}

/// Taylor's quadratics where a light or the eye is at a position, for up to `L` lights. Beside J
/// and K there are quadratics of L·V and of each light's strength, from derivatives of the vectors
/// toward lights and eye. Triangles that are near to a light or the eye are shaded by Duff's
/// method.
#[derive(Clone, Copy, Debug, Default)]
pub struct BishopWeimerLocal<const L: usize>;

impl<const L: usize> Method for BishopWeimerLocal<L> {
    const INFO: Info = BISHOP_WEIMER;
    const NEEDS: Needs = Needs {
        spans: Spans::Ends,
        scalar_only: SCALAR_ONLY,
        general_only: true,
        ..Needs::PIXELS
    };
    type Kinds = (QuadraticsLocal<L>, DuffPhongLocal<L>);

    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let mut constants = OverTriangle::<R, L>::filled(lit.count(), lit.zero());
        let Some((corners, growth)) = set_up_placed(lit, polygon) else {
            return OneOf::Second(());
        };
        let vectors = Vectors::of(lit, corners, growth);
        set_view(&mut constants.0, vectors.k().0);
        for (index, light) in lit.stored.iter().enumerate() {
            let [j, l_v, strength] = vectors.light(light).map(|Jet(of)| of);
            set_light(
                &mut constants.0,
                index,
                each_of(|i| (j[i], l_v[i], strength[i])),
            );
        }
        constants.1 = middle(corners.map(|(corner, _)| corner));
        OneOf::First(constants)
    }
}
