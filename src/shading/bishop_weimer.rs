//! Phong shading by Taylor's quadratic about the middle of a triangle: no root and no division at a pixel (Bishop, Weimer 1986).

use super::quadratic_products::{
    Growth, OverPolygon, QuadraticProducts, least_length, narrow_triangle, set_up_triangle,
};
use super::{
    Approximation, Corners, Family, Info, Lit, Local, Pixel, Planes, Roundings, Shader, Span,
    Stepped,
};
use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3};
use crate::reference::Model;

/// Taylor's quadratics, for up to `L` lights: with `v = v_0 + x v_x + y v_y` the interpolated normal, from the middle of a triangle,
///
/// ```text
/// J/|N| = L·v / √(v·v)  ~  T_0 + T_1 x + T_2 y + T_3 x² + T_4 xy + T_5 y²,     K/|N| likewise
/// ```
/// which a run steps by two additions. The coefficients come from numbers that carry their derivatives ([`Jet`]): the printed ones, as they
/// are copied about, are wrong twice. Under perspective v is that of N/w. Polygons of more corners, pieces that clipping cut, slivers,
/// and triangles whose normals turn by more than about 60° are shaded as by [`DuffPhong`](super::duff_phong::DuffPhong).
///
/// **Its error.** The rest of Taylor's formula is a third derivative: with r the longest distance of a corner's v from v_0 and ℓ the least
/// length of v, g = v/|v| is followed to
///
/// ```text
/// |g − T| ≤ ⅙ |g‴| r³ ≤ ½ (r/ℓ)³,     |g‴| ≤ 3/ℓ³
/// ```
/// as [`SixPoint`](super::six_point::SixPoint) says. Corners themselves are not met: neighbours differ along their edge by as much.
#[derive(Clone, Copy, Debug, Default)]
pub struct BishopWeimer<const L: usize> {
    kind: u8,
}

/// The kind of polygons without a quadratic.
const ROOTS: u8 = 1;

/// Bounds the error of Taylor's quadratics on a polygon.
fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let Some(corners) = narrow_triangle(frame, polygon) else {
        return Approximation::NONE;
    };
    let [a, b, c] = corners.map(|(normal, weight)| normal * weight);
    let middle = (a + b + c) * (1.0 / 3.0);
    let square = |v: Vec3<f32>| (v - middle).dot(v - middle);
    let farthest = Num::sqrt(square(a).max(square(b)).max(square(c)));
    Approximation {
        cosine: 0.5 * libm::pow(f64::from(farthest / least_length(corners)), 3.0),
        ..Approximation::NONE
    }
}

/// A number as a function of x and y, cut off after the second order: the coefficients of 1, x, y, x², xy, y².
#[derive(Clone, Copy)]
struct Jet<R>([R; 6]);

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

    /// Returns 1 over the root: with q what is added to 1, divided by the constant part,
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

impl<const L: usize> Shader for BishopWeimer<L> {
    const INFO: Info = Info {
        name: "bishop-weimer",
        ids: &["M09"],
        family: Family::Quadratics,
        title: "J and K of unit normals by Taylor's quadratic about the middle of each triangle",
        formula: "F(x, y) = T0 + T1 x + T2 y + T3 x^2 + T4 x y + T5 y^2 ~ L.N / |N|;  F_next = F + dF;  dF_next = dF + ddF\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "Bishop, Weimer 1986, coefficients derived anew",
        claimed: "2 additions a pixel for diffuse light; 5 additions and 1 memory reference for Phong's model",
        model: Model::PhongConstant,
        roundings: Roundings::new(40.0, 3.0, Stepped::Products),
        derivation: "as six-point; coefficients take three times as many roundings, as products of derivatives",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        fails: "where normals turn by more than 15 degrees over a triangle; neighbours differ along their edge, which is seen as seams",
        ..Info::OF_PIXELS
    };
    const LOCAL: Local = Local::PerPolygon;
    const PASSES_NORMAL: bool = true;
    const KINDS: &'static [&'static str] = &["quadratic", "roots"];
    const READS_SPAN: bool = true;
    const SCALAR_ONLY: Option<&'static str> =
        Some("bishop-weimer steps quadratics of a polygon's own, and the row engine has no spans");
    type Constants<F: Num> = OverPolygon<F, L>; // from the middle
    type Varying<F: Num> = Vec3<F>; // N
    type Walk<F: Num> = QuadraticProducts<F, L>;

    #[inline(always)]
    fn of_kind(self, kind: u8) -> Self {
        BishopWeimer { kind }
    }
    #[inline(always)]
    fn polygon<R: Real>(
        self,
        lit: &Lit<'_, R>,
        polygon: &Corners<'_, R>,
    ) -> (u8, Self::Constants<R>) {
        let mut constants = Self::Constants::<R>::filled(lit.count(), lit.zero());
        let Some(([a, b, c], growth)) = set_up_triangle(polygon) else {
            return (ROOTS, constants);
        };
        let Growth { p, q, r, s } = growth;
        let [va, vb, vc] = [a, b, c].map(|corner| corner.normal * corner.weight);
        let third = 1.0 / 3.0;
        let v = (va + vb + vc) * third;
        let (to_b, to_c) = (vb - va, vc - va);
        let (vx, vy) = (to_b * p + to_c * r, to_b * q + to_c * s);
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
        constants.1 = [0, 1].map(|i| (a.place[i] + b.place[i] + c.place[i]) * third);
        (0, constants)
    }
    #[inline(always)]
    fn vertex<F: Num>(self, _: &Lit<'_, F>, n: Vec3<F>) -> Vec3<F> {
        n
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        match self.kind {
            ROOTS => QuadraticProducts::of_normals(lit, span.linear()),
            _ => QuadraticProducts::over_polygon(lit, span.constants(), span.place()),
        }
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}
