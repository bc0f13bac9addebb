//! Phong shading by forward differences, with the reciprocal root by Newton's method from the
//! previous pixel.

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::walks::values::scaled;
use crate::shading::walks::{Quadratic, WarmRsqrt, WarmSteps};
use crate::shading::{
    Approximation, Info, LightAt, LightModel, Linear, Needs, PerLight, Pixel, ProductsAndNormal,
    Roundings, Shader, Span, Stepped, Value,
};

/// Duff's differences, with `r = 1/√D` by Newton's method from the previous pixel's value, for up
/// to `L` lights.
///
/// A pixel takes one addition each for `J = L·N` and `K = V·N`, two for D, and three products and a
/// sum per step for r: no root and no division. Each span takes the fewest steps, one or two, that
/// keep the error of r within [`largest_error`]. Where none do, on short spans over large angles,
/// each pixel takes a true root and a division ([`WarmSteps`]).
#[derive(Clone, Copy, Debug, Default)]
pub struct DuffNewton<const L: usize> {
    steps: WarmSteps,
}

/// Returns the largest relative error of r. It is a thousandth of a highlight's peak, because the
/// cosine has four times the error of r and the power multiplies that by n.
fn largest_error(shininess: f32) -> f32 {
    2.5e-4 / shininess.max(1.0)
}

impl<const L: usize> Shader for DuffNewton<L> {
    const INFO: Info = Info {
        name: "duff-newton",
        ids: &["M06"],
        title: "scalar products by forward differences, the reciprocal root by Newton's method from the previous pixel",
        formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r_next = r (1.5 - D/2 r^2)\n\
                  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "Duff 1979; Newton's method as in L21 4.3, for the reciprocal root",
        model: Model::PhongConstant,
        roundings: Roundings::new(9.0, 2.0, Stepped::Products),
        derivation: "as duff-phong; a step rounds r three times, where a root and a quotient round it twice",
        approximation: |frame, polygon, _| {
            let lighting = &frame.lightings()[polygon.material as usize];
            Approximation {
                length: largest_error(lighting.shininess).into(),
                ..Approximation::NONE
            }
        },
        fails: "on spans of few pixels over a large angle it falls back to true roots and divisions; each pixel waits for the previous one",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        scalar_only: Some(
            "duff-newton starts from the previous pixel, and a block of pixels has none nearby",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = ProductsAndNormal<L>;
    type Walk<F: Num> = (Linear<(PerLight<F, L>, F)>, WarmRsqrt<F>);
    const VALUES: &'static [&'static str] = &["J_i", "K", "r"];

    #[inline(always)]
    fn new(_: &[Value], model: &LightModel) -> Self {
        DuffNewton {
            steps: WarmSteps::new(largest_error(model.shininess)),
        }
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at, step } = span.linear();
        let ((at, n), (step, dn)) = (at, step);
        let (square, along, growth) = (n.dot(n), n.dot(dn), dn.dot(dn));
        let steps = self.steps.of_span(square, along, growth);
        let differences = Quadratic::new(square, along + along, growth);
        (
            Linear { at, step }, // 4.3
            WarmRsqrt::new(differences, square, steps),
        )
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (products, r): Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(scaled(products, r))
    }
}
