//! Angular interpolation: along a great circle, all cosines are those of angles that grow evenly
//! (Kuijk, Blake 1989).

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3};
use crate::reference::Model;
use crate::scene::{Falloff, SpecularGate, SpecularModel};
use crate::shading::light::LightModel;
use crate::shading::light::powers::power_by_call;
use crate::shading::methods::angles::slerp_phong::SlerpPhong;
use crate::shading::walks::{Constant, LARGEST_ANGLE, Linear};
use crate::shading::{
    Approximation, Corners, Family, Fit, Info, LightAt, Needs, Normal, On, PerLight, Pixel,
    Roundings, Shader, Span, Stepped, Value,
};

/// Angular interpolation for highlights by the half vector, for up to `L` lights. Let m be the
/// normal in the middle of a span, e the unit vector across it in the plane of the great circle,
/// and φ the angle of the span. Only the parts of L and H in that plane matter:
///
/// ```text
/// N = m cos α + e sin α,       α = (t − ½) φ
/// L·N = p cos(α − ψ),          p cos ψ = L·m,   p sin ψ = L·e;       H·N in the same way
/// ```
///
/// An angle thus takes one addition per pixel. The cosine takes one read of a table over the square
/// of the angle, of which it is a smooth function. ψ is at most 180° and α at most 90°; beyond 90°
/// the cosine is nowhere over 0.
///
/// **Powers of cosines** are approximated by three parabolas, with two constants that depend on the
/// exponent n:
///
/// ```text
/// cosⁿ x ≈ 1 − x²/(ab)             |x| < a              a = (n + 5.6)/(n (0.09 n + 5.2))
///          (|x| − b)²/(b (b − a))  a ≤ |x| < b          b = (n + 65)/(5 n + 31.7)
///          0                       elsewhere
///        = ((b − |x|)₊² / b − (a − |x|)₊² / a) / (b − a)
/// ```
/// where ₊ replaces negative values by 0. The two parabolas and their slopes agree at a. These are
/// Kuijk's constants of 1991; the paper of 1989 mixes them up. The power of p itself is computed
/// once per span. [`fit_error`] is the error of the parabolas.
#[derive(Clone, Copy, Debug, Default)]
pub struct KuijkBlake<const L: usize> {
    a: f32,
    b: f32,
    /// 1/(a (b − a)) and 1/(b (b − a)).
    over_a: f32,
    over_b: f32,
}

/// The steps of the table of cosines, from 0 to the square of 90°.
const STEPS: usize = 1024;
const LARGEST_SQUARE: f64 = core::f64::consts::FRAC_PI_2 * core::f64::consts::FRAC_PI_2;
/// cos √x. Between two entries a line has an error of at most a quarter of 2⁻²², because the second
/// derivative is at most 1/12.
static COSINES: [f32; STEPS + 1] = cosines();

/// The angle between the ends of a span, in radians, below which they have one normal: it is a few
/// of their roundings.
const LEAST_ANGLE: f32 = 1e-6;

/// Computes the table by the series of the cosine, whose 12 terms leave less than 10⁻¹⁸.
const fn cosines() -> [f32; STEPS + 1] {
    let mut table = [0.0; STEPS + 1]; // of 90° too
    let mut i = 0;
    while i < STEPS {
        let x = LARGEST_SQUARE * i as f64 / STEPS as f64;
        let (mut sum, mut k) = (1.0, 12);
        // Horner's scheme for Σ (−x)ᵏ / (2k)!, from the last term on.
        while k > 0 {
            sum = 1.0 - sum * x / ((2 * k) * (2 * k - 1)) as f64;
            k -= 1;
        }
        table[i] = sum as f32;
        i += 1;
    }
    table
}

/// Returns a and b for an exponent.
fn constants(n: f64) -> [f64; 2] {
    [
        (n + 5.6) / (n * (0.09 * n + 5.2)),
        (n + 65.0) / (5.0 * n + 31.7),
    ]
}

/// Returns a bound of the difference between the parabolas and the power of a cosine, for exponents
/// from 1 on: below 0.056, from 4 to 80 below 0.0235, then growing with the logarithm of n. A test
/// searches all angles.
fn fit_error(n: f64) -> f64 {
    match n {
        _ if n < 4.0 => 0.056,
        _ if n < 80.0 => 0.0235,
        _ => f64::min(1.0, 0.0235 + 0.155 * libm::log(n / 80.0)),
    }
}

/// Returns the error of highlights: the parabolas' error, for all lights in the brightest channel.
fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let lighting = &frame.lightings()[polygon.material as usize];
    let lights = &lighting.lights;
    let sum = |c: usize| lights.iter().map(|l| f64::from(l.specular[c])).sum::<f64>();
    let most = [0, 1, 2].map(sum).into_iter().fold(0.0, f64::max);
    // Near a light of this falloff its strength has no bound.
    let is_strong = |falloff| matches!(falloff, Falloff::InverseSquare | Falloff::Inverse);
    let colour = if lights.iter().any(|light| is_strong(light.falloff)) {
        1.0
    } else {
        fit_error(f64::from(lighting.shininess)) * most
    };
    Approximation {
        colour,
        ..Approximation::NONE
    }
}

type Pair<F, const L: usize> = (PerLight<F, L>, PerLight<F, L>); // of L and of H of each light

impl<const L: usize> Shader for KuijkBlake<L> {
    const INFO: Info = Info {
        name: "kuijk-blake",
        ids: &["M13"],
        family: Family::Angles,
        title: "angles along great circles by one addition each, cosines from a table, and powers by three parabolas",
        formula: "L.N = p cos x, x_next = x + d, d the angle of a pixel;  N.H = q cos y, y_next = y + d\n\
                  I = Ia ka + Ip kd p cos x + Ip ks q^n f(y);  f(y) = (max(0, b - |y|)^2 / b - max(0, a - |y|)^2 / a) / (b - a)\n\
                  a = (n + 5.6) / (n (0.09 n + 5.2));  b = (n + 65) / (5 n + 31.7)",
        source: "Kuijk, Blake 1989, with the constants of Kuijk 1991",
        claimed: "two additions a pixel, in the most economic of its two forms",
        model: Model::Slerp,
        roundings: Roundings::new(40.0, 2.1, Stepped::GreatCircles),
        derivation: "each step rounds angles by 2^-23 while they are below 4, and those of edges as in slerp-phong; both inverse \
                     tangents, roots and products of a span take 30, the table 4",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        fails: "for exponents over 100, which the parabolas do not follow; on short spans, which pay two inverse tangents, two roots and \
                a power per light; as slerp-phong, on triangles",
        has_power: false,
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        general_only: true,
        scalar_only: Some("kuijk-blake reads tables, which a block of pixels must do one by one"),
        ..SlerpPhong::<L>::NEEDS
    };
    type Constants<F: Num> = Vec3<F>; // the polygon's normal
    type Carries = Normal;
    type Walk<F: Num> = (Linear<Pair<F, L>>, Constant<Pair<F, L>>);
    const VALUES: &'static [&'static str] = &["x_i", "y_i", "p_i", "q_i"];

    fn on(on: On<'_>) -> Fit {
        on.each(|lighting, _| {
            if lighting.specular != SpecularModel::Blinn {
                return Some("its highlights are by N.H, not by R.V");
            }
            let is_low = lighting.shininess < 1.0;
            is_low.then_some("its parabolas need an exponent of 1 or more")
        })
    }
    #[inline(always)]
    fn new(_: &[Value], model: &LightModel) -> Self {
        let [a, b] = constants(f64::from(model.shininess));
        let over = 1.0 / (b - a);
        KuijkBlake {
            a: a as f32,
            b: b as f32,
            over_a: (over / a) as f32,
            over_b: (over / b) as f32,
        }
    }
    #[inline(always)]
    fn polygon<R: Real>(self, _: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let ([from, to], [t0, dt]) = (span.ends(), span.parameter());
        let (sum, difference) = (from + to, to - from);
        let (cos, sin) = (sum.dot(sum).sqrt(), difference.dot(difference).sqrt());
        let half = sin.atan2(cos); // φ/2
        let one = cos.broadcast(1.0);
        let (middle, across, half) = if half.value() * 2.0 > LARGEST_ANGLE {
            (span.constants(), difference * 0.0, half * 0.0)
        } else {
            let middle = sum * (one / cos);
            // If both ends have nearly the same normal, their difference is all rounding and
            // has any direction, even along the middle.
            let across = difference - middle * difference.dot(middle);
            let length = across.dot(across).sqrt();
            let over = (one / length.max(LEAST_ANGLE)).gate(length, LEAST_ANGLE);
            (middle, across * over, half)
        };
        let here = (t0 * 2.0 - 1.0) * half; // α
        let zero = lit.zero();
        let step = zero.of_each(|_| dt * half * 2.0);
        let none = PerLight::new(lit.count(), zero);
        let (mut at, mut sizes) = ((none, none), (none, none));
        for index in 0..lit.count() {
            let [(light, size), (highlight, size_of_highlight)] = lit.light_and_half(index).map(
                #[inline(always)]
                |v| {
                    let v = v.broadcast(one);
                    let (p_cos, p_sin) = (v.dot(middle), v.dot(across));
                    let size = (p_cos * p_cos + p_sin * p_sin).sqrt();
                    (here - p_sin.atan2(p_cos), size) // α − ψ, p
                },
            );
            // Powers of cosines up to `faint` may be subnormal and are not seen: they become 0.
            let faint = lit.model.faint;
            let least = size_of_highlight.max(faint);
            let power = power_by_call(lit.model.exponent, least, &[]).gate(least, faint); // pⁿ
            at.0.values[index] = zero.of_each(|_| light);
            at.1.values[index] = zero.of_each(|_| highlight);
            sizes.0.values[index] = zero.of_each(|_| size);
            sizes.1.values[index] = zero.of_each(|_| power);
        }
        let steps = PerLight::new(lit.count(), step);
        let angles = Linear {
            at,
            step: (steps, steps),
        };
        (angles, Constant(sizes))
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F> {
        const SCALE: f32 = (STEPS as f64 / LARGEST_SQUARE) as f32;
        let ((angles, angles_of_highlights), (sizes, powers)) = pixel;
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let x = angles.values[light.index];
            // The square is clamped to the end of the table, whose entry, at 90°, is 0.
            let place = -((-(x * x * SCALE)).max(-(STEPS as f32)));
            let l_n = place.lookup(&COSINES) * sizes.values[light.index];
            let highlight = self.power(angles_of_highlights.values[light.index]);
            let highlight = highlight * powers.values[light.index];
            let specular = match lit.model.gate {
                SpecularGate::Gated => highlight.gate(l_n, 0.0),
                SpecularGate::Ungated => highlight,
                SpecularGate::Weighted => highlight * l_n,
            };
            colour = lit.plus(colour, &light, l_n, specular);
        }
        colour
    }
}

impl<const L: usize> KuijkBlake<L> {
    /// Returns the power of an angle's cosine, by three parabolas.
    #[inline(always)]
    fn power<F: Num>(self, angle: F) -> F {
        // |x|, from the only maximum that the arithmetic has.
        let angle = angle.max(0.0) + (-angle).max(0.0);
        let (wide, narrow) = ((-angle + self.b).max(0.0), (-angle + self.a).max(0.0));
        wide * wide * self.over_b - narrow * narrow * self.over_a
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::FRAC_PI_2;

    /// The table differs from the cosine by less than its stated error, and is 0 at a right angle.
    #[test]
    fn the_table_is_the_cosine() {
        let mut most = 0.0f64;
        for i in 0..100_000 {
            let x = LARGEST_SQUARE * f64::from(i) / 1e5;
            let place = (x / LARGEST_SQUARE * STEPS as f64) as f32;
            let found = f64::from(Num::lookup(place, &COSINES));
            most = most.max((found - x.sqrt().cos()).abs());
        }
        assert!(most < 4.0 / (1 << 24) as f64, "{most:e}");
        assert_eq!(Num::lookup(STEPS as f32, &COSINES), 0.0);
    }

    /// The parabolas are no farther from the power than stated, and at some angle more than a fifth
    /// as far.
    #[test]
    fn parabolas_are_as_near_to_the_power_as_stated() {
        let mut n = 1.0;
        while n < 1e5 {
            let [a, b] = constants(n);
            let over = 1.0 / (b - a);
            let method = KuijkBlake::<1> {
                a: a as f32,
                b: b as f32,
                over_a: (over / a) as f32,
                over_b: (over / b) as f32,
            };
            let off = |i: i32| {
                let x = 2.0 * FRAC_PI_2 * f64::from(i) / 10_000.0;
                let truth = x.cos().max(0.0).powf(n);
                (f64::from(method.power(x as f32)) - truth).abs()
            };
            let most = (0..10_000).map(off).fold(0.0, f64::max);
            let stated = fit_error(n);
            assert!(
                most <= stated && 5.0 * most > stated,
                "{n}: {most} {stated}"
            );
            n *= 1.05;
        }
    }
}
