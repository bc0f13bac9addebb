//! Fast Phong shading: scalars instead of vectors, and Newton's root instead of a true one (L21
//! 4.2–4.3).
//!
//! The root itself is `Newton::root` in `walks/newton.rs`; `NewtonSteps` there chooses how many
//! steps a span takes.

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::scene::SpecularModel;
use crate::shading::walks::{Newton, NewtonSteps};
use crate::shading::{
    Auto, Info, LightAt, LightModel, Linear, MethodParameter, Needs, PerLight, Pixel,
    ProductsAndNormal, Roundings, Shader, Span, Stepped, Tier, Value,
};

/// Fast Phong shading as the lecture prints it, for up to `L` lights (L21 4.2–4.3).
///
/// Additions step `J = L·N` of each light, `K = V·N` and N along a span. Each pixel computes
/// `D = N·N`, and `d = √D` by Newton's method from the previous pixel's d.
///
/// The diffuse term is `J/d` and the specular term `(2JK/D − L·V)^n`, so an error of the root
/// changes only the diffuse term. With m steps a pixel costs m + 2 divisions, where naive Phong has
/// one division and one root. By default each span takes the fewest steps whose error cannot be
/// seen, which is one on all but the shortest spans, and true roots where normals nearly cancel
/// ([`NewtonSteps`]). `steps=2` takes two everywhere, without a guard, as printed.
#[derive(Clone, Copy, Debug, Default)]
pub struct FastPhong<const L: usize> {
    steps: NewtonSteps,
}

const STEPS: MethodParameter = MethodParameter::whole(
    "steps",
    "steps of Newton's method per pixel",
    1,
    [1, NewtonSteps::MOST],
);

impl<const L: usize> Shader for FastPhong<L> {
    const INFO: Info = Info {
        name: "fast-phong",
        ids: &["M04"],
        tier: Tier::Default,
        title: "J = L.N, K = V.N and N by additions, the root by Newton's method",
        formula: "J_next = J + dJ;  K_next = K + dK;  N_next = N + dN;  D = N.N;  d = sqrt(D) by Newton from the \
                  previous pixel\nI = Ia ka + Ip kd J/d + Ip ks (2 J K / D - L.V)^n",
        source: "L21 4.2, 4.3, eq 4.3-4.6",
        model: Model::PhongConstant,
        roundings: Roundings::new(4.0, 1.4, Stepped::Cosines),
        derivation: "each step rounds J and K by half of 2^-24, and the three components of N, so d = |N|, by 0.87 * 2^-24: \
                     J/d gathers 1.4 roundings, and 2 J K / D gathers 2 (0.5 + 0.5 + 2 * 0.87) = 5.5, which is 4 * 1.4",
        fails: "with a fixed count of steps: on spans of few pixels over a large angle, where the previous length is a bad \
                first guess, and where normals cancel inside a span",
        parameters: &[STEPS.or_auto(Auto::new(
            "the fewest Newton steps (1 to 3) that keep the relative error on a span below 0.001; an exact root otherwise, and always with SIMD, where it costs no more",
            |lighting| largest_error(lighting.specular, lighting.shininess),
        ))],
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        sums_lights: true,
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = ProductsAndNormal<L>;
    type Walk<F: Num> = (Linear<(PerLight<F, L>, F)>, Newton<F>);
    const VALUES: &'static [&'static str] = &["J_i", "K", "d", "D"];

    #[inline(always)]
    fn new(parameters: &[Value], model: &LightModel) -> Self {
        let error = largest_error(model.specular, model.shininess);
        let steps = NewtonSteps::new(parameters[0].whole().unwrap_or(0), error);
        FastPhong { steps }
    }
    /// False for `auto`, which takes true roots in blocks and so needs no previous pixel there.
    #[inline(always)]
    fn walks_along_runs(self) -> bool {
        !self.steps.is_auto()
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at, step } = span.linear();
        // The normal goes to Newton's root; J and K are stepped beside it.
        let ((at, n), (step, dn)) = (at, step);
        (Linear { at, step }, Newton::new(n, dn, &self.steps)) // 4.3, 4.4
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, ((j, k), (d, square)): Pixel<Self, F>) -> Vec3<F> {
        // Divisions are per pixel, not per light.
        let (over_d, twice_k) = (d.broadcast(1.0) / d, k * 2.0 / square);
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let j = j.values[light.index];
            let cosine = if lit.is_halfway() {
                (j + k) * over_d * light.half // N·H
            } else {
                twice_k * j - light.l_v // 4.6
            };
            colour = lit.add(colour, &light, j * over_d, cosine);
        }
        colour
    }
}

/// Returns the largest relative error of a length that `steps=auto` tolerates. It is
/// [`NewtonSteps::LARGEST_ERROR`] where only diffuse cosines are divided by the length. N·H is
/// divided by it too and raised to n, which multiplies a small error by n.
fn largest_error(specular: SpecularModel, shininess: f32) -> f32 {
    match specular {
        SpecularModel::Phong => NewtonSteps::LARGEST_ERROR,
        SpecularModel::Blinn => NewtonSteps::LARGEST_ERROR / shininess.max(1.0),
    }
}
