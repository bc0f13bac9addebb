//! Phong shading by a quadratic through unit normals along each span, with nothing normalised at a
//! pixel (Hast, Barrera, Bengtsson 2002).

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::bounds::polygon_ranges::Extent;
use crate::shading::walks::Quadratic;
use crate::shading::{
    Approximation, Family, Info, LightAt, Needs, Normal, Pixel, Roundings, Shader, Span, Spans,
    Stepped,
};

/// Quadratic vectors. The normals at both ends of a span and in its middle are normalised, and the
/// quadratic through them is stepped by six additions per pixel. Its length is so nearly 1 that it
/// is not normalised again.
///
/// ```text
/// N(t) = N_1 + (4 N_m − 3 N_1 − N_2) t + 2 (N_1 + N_2 − 2 N_m) t²,     N_m = (N_1 + N_2)/|N_1 + N_2| of the ends before they are normalised
/// ```
/// Edges are stepped as in naive Phong shading, so neighbours agree on them. Under perspective the
/// middle is the middle on the screen, where N/w is linear.
///
/// **Its error.** Along a span let v = a + t (b − a) and g = v/|v|. The quadratic Πg through three
/// points of g has an error of
///
/// ```text
/// |g − Πg| ≤ ⅙ |g‴| max |t (t − ½) (t − 1)| = ⅙ |g‴| √3/36 ≤ 0.0241 (|b − a|/ℓ)³,     |g‴| ≤ 3 |b − a|³/ℓ³
/// ```
/// with ℓ the least length of v, as
/// [`SixPoint`](crate::shading::methods::quadratics::six_point::SixPoint) derives. Both ends lie
/// between the corners, so their distance is at most that of two corners: 2 sin θ for unit normals
/// within θ of one direction, or `2 w sin θ + w − 1` for weights of up to w times the least; and ℓ
/// is at least cos θ.
#[derive(Clone, Copy, Debug, Default)]
pub struct QuadraticNormals;

fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let extent = Extent::of(frame, polygon);
    let apart = extent.weights * extent.apart() + extent.weights - 1.0;
    let cosine = if extent.cosine > 0.0 {
        0.0241 * libm::pow(apart / extent.cosine, 3.0)
    } else {
        f64::INFINITY
    };
    Approximation {
        cosine,
        ..Approximation::NONE
    }
}

impl Shader for QuadraticNormals {
    const INFO: Info = Info {
        name: "quadratic-normals",
        ids: &["M22"],
        family: Family::Quadratics,
        title: "normals as a quadratic along each span, not normalised at pixels",
        formula: "N(t) = N1 + (4 Nm - 3 N1 - N2) t + 2 (N1 + N2 - 2 Nm) t^2;  N_next = N + dN;  dN_next = dN + ddN\n\
                  I = Ia ka + Ip kd L.N + Ip ks (2 (L.N) (V.N) - L.V)^n",
        source: "Hast, Barrera, Bengtsson 2002",
        claimed: "no normalisation",
        model: Model::PhongConstant,
        roundings: Roundings::new(24.0, 3.0, Stepped::Cosines),
        derivation: "unit vectors take 3 roundings, the quadratic's coefficients 8 of them; each component is a quadratic of values of at most 1, which \
                     gathers 3 per step, and as a vector no more along L or V",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        fails: "where normals turn by more than 60 degrees along a span; on short spans, which pay three roots",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        spans: Spans::Ends,
        scalar_only: Some(
            "quadratic-normals takes three roots to set up a span, where SIMD takes the roots of eight pixels at once",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = [Quadratic<F>; 3];
    const VALUES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let [a, b] = span.ends();
        let [t0, dt] = span.parameter();
        let (n1, nm, n2) = (a.unit(), (a + b).unit(), b.unit());
        let slope = nm * 4.0 - n1 * 3.0 - n2;
        let curve = (n1 + n2 - nm - nm) * 2.0;
        let zero = lit.zero();
        let component = |n: F::One, slope: F::One, curve: F::One| {
            let at = n + (slope + curve * t0) * t0;
            let step = (slope + curve * t0 * 2.0) * dt;
            let [at, step, second] = [at, step, curve * dt * dt].map(|x| zero.of_each(|_| x));
            Quadratic::new(at, step, second)
        };
        [
            component(n1.x, slope.x, curve.x),
            component(n1.y, slope.y, curve.y),
            component(n1.z, slope.z, curve.z),
        ]
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        let v_n = n.dot(lit.view()); // K = V · N
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = n.dot(light.to); // J = L · N
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n));
        }
        colour
    }
}
