//! Highlights from the difference of two vectors, with nothing normalised at a pixel (Lyon 1993;
//! Loisel about 1996).

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::scene::{Interpolation, SpecularModel};
use crate::shading::bounds::polygon_ranges::Extent;
use crate::shading::walks::Quadratic;
use crate::shading::{
    Approximation, Family, Fit, Info, LightAt, Linear, Needs, Normal, On, PerLight, Pixel,
    Roundings, Shader, Span, Stepped,
};

/// Phong shading that uses normals with the length that interpolation leaves them, for up to `L`
/// lights. J = L·N takes one addition per pixel. The squared difference of N and H takes two, as it
/// is a quadratic:
///
/// ```text
/// E = |N − H|² = N·N − 2 N·H + 1,      t = 1 − E/2
/// ```
/// For a unit normal t is N·H. With `power=lyon` the highlight is `(1 − n E/2ᵏ⁺¹)`, squared k
/// times, as published.
///
/// **Its error.** Let |N| = 1 − u, with u at most 1 − ℓ on a polygon. Then J is too small by the
/// share u, and
///
/// ```text
/// t − N·H/|N| = (1 − N·H/|N|) u − u²/2
/// ```
/// The power multiplies an error of the cosine by at most n t^(n−1). It makes of the first part at
/// most u/ℓ, as n (1 − t) t^(n−1) ≤ 1 for all functions of [`Power`](crate::scene::Power), and of
/// the second part n u²/2. At the peak of a highlight the error is thus of second order, where N·H
/// would have an error of n u.
#[derive(Clone, Copy, Debug, Default)]
pub struct DifferenceVector<const L: usize>;

fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let lighting = &frame.lightings()[polygon.material as usize];
    let least = Extent::of(frame, polygon).cosine.clamp(0.0, 1.0);
    let (short, n) = (1.0 - least, f64::from(lighting.shininess));
    let of_highlight = if n >= 1.0 && least > 0.0 {
        f64::min(1.0, short / least + n * short * short / 2.0)
    } else {
        1.0 // infinitely steep at 0
    };
    let of_channel = |c: usize| -> f64 {
        let all = lighting.lights.iter();
        all.map(|light| {
            f64::from(light.diffuse[c]) * short + f64::from(light.specular[c]) * of_highlight
        })
        .sum()
    };
    Approximation {
        colour: [0, 1, 2].map(of_channel).into_iter().fold(0.0, f64::max),
        ..Approximation::NONE
    }
}

impl<const L: usize> Shader for DifferenceVector<L> {
    const INFO: Info = Info {
        name: "difference-vector",
        ids: &["M17"],
        family: Family::Highlights,
        title: "highlights by the squared difference of N and H, a quadratic along a span; nothing is normalised",
        formula: "J_next = J + dJ;  E = N.N - 2 N.H + 1;  E_next = E + dE;  dE_next = dE + 2 dN.dN\n\
                  I = Ia ka + Ip kd J + Ip ks (1 - E/2)^n",
        source: "Lyon 1993; Loisel about 1996",
        claimed: "two additions and a table a pixel for the highlight (Loisel)",
        model: Model::PhongConstant,
        roundings: Roundings::new(14.0, 3.5, Stepped::Products),
        derivation: "a step rounds J by half of 2^-24, and E, which is halved, up to 3 times at values of at most 4; the products of the first normal take 12",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        fails: "where normals turn by more than 20 degrees over a polygon: its middle is darker",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        general_only: true,
        scalar_only: Some(
            "difference-vector saves a root per pixel, but SIMD takes eight roots at once",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = (Linear<PerLight<F, L>>, PerLight<Quadratic<F>, L>);
    const VALUES: &'static [&'static str] = &["J_i", "E_i"];

    fn on(on: On<'_>) -> Fit {
        on.each(|lighting, how| match (lighting.specular, how) {
            (SpecularModel::Phong, _) => Some("its highlights are by N.H, not by R.V"),
            (_, Interpolation::Perspective) => {
                Some("it uses the length of normals, which perspective changes")
            }
            _ => None,
        })
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at: n, step: dn } = span.linear();
        let (j, k) = lit.products::<L>(n);
        let (dj, dk) = lit.products::<L>(dn);
        let half = n.dot(dn);
        let (square, slope, curve) = (n.dot(n) + 1.0, half + half, dn.dot(dn));
        let none = Quadratic::zero(lit.zero());
        let mut differences = PerLight::new(lit.count(), none);
        for light in lit.lights() {
            let i = light.index;
            let twice = light.half * 2.0;
            let m = (j.values[i] + k) * twice; // 2 N·H
            let dm = (dj.values[i] + dk) * twice;
            differences.values[i] = Quadratic::new(square - m, slope - dm, curve);
        }
        (Linear { at: j, step: dj }, differences)
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (j, e): Pixel<Self, F>) -> Vec3<F> {
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let cosine = -(e.values[light.index] * 0.5 - 1.0);
            colour = lit.add(colour, &light, j.values[light.index], cosine);
        }
        colour
    }
}
