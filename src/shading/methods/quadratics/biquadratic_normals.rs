//! Phong shading of a smoother surface: normals are quadratics over triangles, which follow
//! inflections (van Overveld, Wyvill 1997).

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3, vec3};
use crate::reference::Model;
use crate::shading::methods::quadratics::over_triangle::{
    Growth, WIDEST, along, each_of, lagrange, least_length, plain, width,
};
use crate::shading::methods::roots::phong_rsqrt::PhongRsqrt;
use crate::shading::walks::Quadratic;
use crate::shading::{
    Approximation, Chosen, Corner, Corners, Family, Info, LightAt, Method, Needs, Normal, OneOf,
    Pixel, Roundings, Shader, Span, Spans, Stepped,
};

/// Biquadratic normals. Linear normals hide inflections: an edge between two equal normals is
/// shaded flat, even if its ends lie as on an S. Here the normal half-way along an edge is the sum
/// of both, reflected in the plane across the edge. A triangle's normals are the quadratic through
/// its three normals and these three (as in PN triangles, Vlachos 2001):
///
/// ```text
/// N_m = unit(N_1 + N_2 − v (P_2 − P_1)),     v = 2 (P_2 − P_1)·(N_1 + N_2) / |P_2 − P_1|²
/// N = Σ N_i b_i (2 b_i − 1) + 4 Σ N_ij b_i b_j,     normalised at each pixel
/// ```
/// Under perspective b_i is a_i w_i/Σ a_j w_j, with a_i those on the screen. Multiplied by (Σ a_j
/// w_j)², N is again a quadratic on the screen, and normalising removes the factor. Polygons with
/// more corners, pieces that clipping has cut off, slivers and wide triangles are shaded by
/// [`PhongRsqrt`](crate::shading::methods::roots::phong_rsqrt::PhongRsqrt).
///
/// **Its distance from Phong's picture.** N differs from the linear normal by
/// `Σ 4 b_i b_j (N_ij − (N_i + N_j)/2)`, at most 4/3 of the longest of these vectors. Its direction
/// differs by at most 2/ℓ times as much, with ℓ the least length of linear normals.
#[derive(Clone, Copy, Debug, Default)]
pub struct BiquadraticNormals;

/// Returns the unit normal half-way along an edge, from the unit normals and positions of its ends.
#[inline(always)]
fn midway<R: Real>([n1, n2]: [Vec3<R>; 2], [p1, p2]: [Vec3<R>; 2]) -> Vec3<R> {
    let (sum, edge) = (n1 + n2, p2 - p1);
    let square = edge.dot(edge);
    if square.value() > 0.0 {
        (sum - edge * (edge.dot(sum) * 2.0 / square)).unit()
    } else {
        sum.unit() // a frame without positions
    }
}

fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let &[a, b, c] = frame.corners(polygon) else {
        return Approximation::NONE;
    };
    if [a, b, c].iter().any(|&v| frame.clip_corner(v).is_some()) {
        return Approximation::NONE;
    }
    let normals = [a, b, c].map(|v| vec3(frame.normal(v)));
    let positions = [a, b, c].map(|v| vec3(frame.position(v)));
    let width = width(normals.map(|n| (n, 1.0)));
    let apart = |i: usize, j: usize| {
        let (n, p) = ([normals[i], normals[j]], [positions[i], positions[j]]);
        let from = midway(n, p) - (n[0] + n[1]) * 0.5;
        libm::sqrt(from.dot(from).into())
    };
    let most = [apart(0, 1), apart(1, 2), apart(2, 0)]
        .into_iter()
        .fold(0.0, f64::max);
    let length = f64::from(least_length(normals.map(|n| (n, 1.0))));
    if width > WIDEST {
        return Approximation::NONE;
    }
    Approximation {
        cosine: f64::min(2.0, 8.0 / 3.0 * most / length),
        ..Approximation::NONE
    }
}

impl Method for BiquadraticNormals {
    const INFO: Info = Info {
        name: "biquadratic-normals",
        ids: &["M23"],
        family: Family::Quadratics,
        title: "normals as quadratics over triangles that follow inflections of the surface",
        formula: "Nm = unit(N1 + N2 - v (P2 - P1));  v = 2 (P2 - P1).(N1 + N2) / |P2 - P1|^2\n\
                  N = sum Ni bi (2 bi - 1) + 4 (N12 b1 b2 + N23 b2 b3 + N31 b3 b1);  N_next = N + dN;  dN_next = dN + ddN;  eq 2.1 of N / |N|",
        source: "van Overveld, Wyvill 1997; the normals half-way are those of Vlachos 2001",
        model: Model::PhongConstant,
        roundings: Roundings::new(40.0, 3.0, Stepped::Products),
        derivation: "as six-point, for vectors; the normal half-way takes 10 roundings, and is normalised again at the pixel",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        fails: "it shades another surface: flat faces between unlike normals become waves",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        spans: Spans::Ends,
        scalar_only: Some(
            "biquadratic-normals steps quadratics of each polygon, and the row engine has no spans",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Kinds = (QuadraticOfNormals, PhongRsqrt);

    #[inline(always)]
    fn polygon<R: Real>(self, _: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let &[a, b, c] = polygon.all else {
            return OneOf::Second(());
        };
        let Some(growth) = Growth::of([&a, &b, &c]) else {
            return OneOf::Second(());
        };
        let width = width([a, b, c].map(|v| (plain(v.normal), 1.0)));
        if !polygon.is_whole || width > WIDEST {
            return OneOf::Second(());
        }
        // N (Σ a_j w_j)² at a corner, and half-way along an edge, where both a_i are ½.
        let at_corner = |v: Corner<R>| v.normal * (v.weight * v.weight);
        let at_edge = |v: Corner<R>, w: Corner<R>| {
            let normal = midway([v.normal, w.normal], [v.position, w.position]);
            let apart = v.normal * v.weight - w.normal * w.weight;
            normal * (v.weight * w.weight) + apart * ((v.weight - w.weight) * 0.25)
        };
        let of = lagrange(
            [a, b, c].map(at_corner),
            [at_edge(a, b), at_edge(b, c), at_edge(c, a)],
            growth,
        );
        OneOf::First((of, a.place))
    }
}

/// The kind of polygons whose normals are a quadratic over a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct QuadraticOfNormals;

impl Shader for QuadraticOfNormals {
    const INFO: Info = Info::of_kind("quadratic");
    type Constants<F: Num> = ([Vec3<F>; 6], [F; 2]); // of 1, x, y, x², xy, y²; from the first corner
    type Carries = Normal;
    type Walk<F: Num> = [Quadratic<F>; 3];
    const VALUES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let ((of, from), [x, y]) = (span.constants(), span.place());
        let from = [x - x.of_each(|_| from[0]), y - y.of_each(|_| from[1])];
        [
            along(each_of(|i| of[i].x), from),
            along(each_of(|i| of[i].y), from),
            along(each_of(|i| of[i].z), from),
        ]
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        PhongRsqrt.shade(lit, n)
    }
}
