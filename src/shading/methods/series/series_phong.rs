//! Phong shading without a root or a division at a pixel: a polynomial of N·N replaces 1/√(N·N)
//! (Digital, US patent 5,369,737, 1990).

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3, vec3};
use crate::reference::Model;
use crate::shading::methods::hybrids::adaptive_plan::{
    WIDEST, line, parabola, rounded_up, spread, squares,
};
use crate::shading::methods::quadratics::over_triangle::plain;
use crate::shading::methods::roots::duff_phong::DuffOfNormals;
use crate::shading::walks::values::scaled;
use crate::shading::{
    Approximation, Chosen, Constant, Corners, Family, Info, LightAt, LightModel, Method,
    MethodParameter, Needs, Normal, OneOf, Pixel, Roundings, Shader, Span, Stepped, Tier, Value,
};

/// Series Phong shading for up to `L` lights. A pixel takes one addition each for `J = L·N` and
/// `K = V·N` and two for `D = N·N`, as in Duff's method, and
///
/// ```text
/// 1/√D ~ k_0 + k_1 D        or        k_0 + D (k_1 + k_2 D)
/// ```
///
/// about the middle of the values that D has on the polygon: see [`line`] and [`parabola`], whose
/// coefficients and errors are (a) and (d) of [`crate::shading::methods::hybrids::adaptive_plan`].
///
/// The patent has Taylor's series about 1, the value of D at corners under parallel projection.
/// Under perspective N is weighted by 1/w, and D can have any value. Polygons whose D varies by
/// more than a factor of 3, and pieces that clipping has cut off, take roots.
#[derive(Clone, Copy, Debug, Default)]
pub struct SeriesPhong<const L: usize> {
    order: u32,
}

/// The least square for which there is a polynomial. The coefficients of smaller ones exceed the
/// range of an `f32`.
const LEAST_SQUARE: f32 = 1e-12;

/// Returns the polynomial of `order` for polygons with these unit normals and weights, and its
/// relative error; `None` if they take roots.
pub(crate) fn polynomial(
    order: u32,
    normals: impl ExactSizeIterator<Item = Vec3<f32>> + Clone,
    weights: impl Iterator<Item = f32> + Clone,
) -> Option<([f32; 3], f32)> {
    let least = weights.clone().fold(f32::INFINITY, f32::min);
    let range = squares(
        rounded_up(spread(normals)),
        [least, weights.fold(0.0, f32::max)],
    );
    let is_narrow =
        range[0] > LEAST_SQUARE && range[1] - range[0] <= WIDEST * (range[1] + range[0]);
    is_narrow.then(|| match order {
        1 => line(range),
        _ => parabola(range),
    })
}

/// Returns the polynomial for a polygon as a method sets it up. The choice reads plain values, so
/// that operation counts do not include it.
pub(crate) fn of_corners<R: Real>(order: u32, polygon: &Corners<'_, R>) -> Option<[f32; 3]> {
    let normals = polygon.all.iter().map(|corner| plain(corner.normal));
    let weights = polygon.all.iter().map(|corner| corner.weight.value());
    let polynomial = polynomial(order, normals, weights)?;
    polygon.is_whole.then_some(polynomial.0)
}

/// Returns a bound of the relative error of 1/√D on a polygon of a frame.
pub(crate) fn approximation(frame: &Frame, polygon: &Polygon, order: u32) -> Approximation {
    let corners = frame.corners(polygon);
    if corners.iter().any(|&v| frame.clip_corner(v).is_some()) {
        return Approximation::NONE;
    }
    let normals = corners.iter().map(|&v| vec3(frame.normal(v)));
    let weights = corners.iter().map(|&v| frame.weight(v));
    let polynomial = polynomial(order, normals, weights);
    Approximation {
        length: polynomial.map_or(0.0, |(_, error)| error.into()),
        ..Approximation::NONE
    }
}

/// Returns the order that the first parameter sets.
fn order(parameters: &[Value]) -> u32 {
    parameters[0].whole().unwrap_or_default()
}

impl<const L: usize> Method for SeriesPhong<L> {
    const INFO: Info = Info {
        name: "series-phong",
        ids: &["M07", "M07b"],
        family: Family::Series,
        tier: Tier::Default,
        title: "J = L.N, K = V.N and D = N.N by differences; 1/sqrt(D) by a polynomial of D",
        formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = k0 + k1 D or k0 + D (k1 + k2 D)\n\
                  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "Digital Equipment, US patent 5,369,737, filed 1990; differences as Duff 1979; about the middle of D: ours",
        model: Model::PhongConstant,
        parameters: &[MethodParameter::whole(
            "order",
            "order of the polynomial",
            2,
            [1, 2],
        )],
        roundings: Roundings::new(14.0, 2.0, Stepped::Products),
        derivation: "as duff-phong; computing a run's products from normals takes 4 more, and the polynomial in place of the root, with coefficients of \
                     up to 4, another 4",
        approximation: |frame, polygon, parameters| {
            approximation(frame, polygon, order(parameters))
        },
        fails: "order 1 where normals turn by more than about 15 degrees over a polygon: n multiplies the error at a highlight's peak",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs::PIXELS_BY_POLYGON;
    type Kinds = (Polynomial<L, 2>, Polynomial<L, 3>, DuffOfNormals<L>);

    #[inline(always)]
    fn new(parameters: &[Value], _: &LightModel) -> Self {
        SeriesPhong {
            order: order(parameters),
        }
    }
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let Some(factors) = of_corners(self.order, polygon) else {
            return OneOf::Third(());
        };
        let [k0, k1, k2] = factors.map(|k| lit.zero().broadcast(k));
        match self.order {
            1 => OneOf::First([k0, k1]),
            _ => OneOf::Second([k0, k1, k2]),
        }
    }
}

/// The kind of polygons with a polynomial of `K` coefficients, two or three, for 1/√D.
#[derive(Clone, Copy, Debug, Default)]
pub struct Polynomial<const L: usize, const K: usize>;

impl<const L: usize, const K: usize> Shader for Polynomial<L, K> {
    const INFO: Info = Info::of_kind(if K == 2 { "line" } else { "parabola" });
    type Constants<F: Num> = [F; K];
    type Carries = Normal;
    type Walk<F: Num> = (<DuffOfNormals<L> as Shader>::Walk<F>, Constant<[F; K]>);
    const VALUES: &'static [&'static str] = match K {
        2 => &["J_i", "K", "D", "k0", "k1"],
        _ => &["J_i", "K", "D", "k0", "k1", "k2"],
    };

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let factors = span.constants().map(|k| lit.zero().of_each(|_| k));
        (DuffOfNormals::start(lit, span.linear()), Constant(factors))
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, ((products, d), k): Pixel<Self, F>) -> Vec3<F> {
        let r = match K {
            2 => k[0] + k[1] * d,
            _ => k[0] + d * (k[1] + k[K - 1] * d),
        };
        lit.shade_products(scaled(products, r))
    }
}
