//! Phong shading by additions alone: unit products as cubics along a span.

use super::increments::{Cubic, Quadratic, Walk};
use super::planes::scaled;
use super::series_phong::{approximation, of_corners};
use super::{
    Corners, Family, Info, Linear, Lit, Needs, Normal, PerLight, Pixel, Roundings, Shader, Span,
    Stepped,
};
use crate::number::{Num, Real, Vec3};
use crate::reference::Model;

/// Cubic Phong shading for up to `L` lights. With a line for 1/√D, as [`SeriesPhong`](super::series_phong::SeriesPhong) of order 1 has it,
/// the unit products are a linear function times a quadratic one: cubics, three additions a pixel each and nothing else.
///
/// ```text
/// J/√D ~ J (k_0 + k_1 D),   K/√D likewise
/// ```
/// Polygons without a line take roots.
#[derive(Clone, Copy, Debug, Default)]
pub struct CubicPhong<const L: usize> {
    kind: u8,
}

const ROOTS: u8 = 1;

type Products<F, const L: usize> = (PerLight<F, L>, F); // J of each light, K

impl<const L: usize> Shader for CubicPhong<L> {
    const INFO: Info = Info {
        name: "cubic-phong",
        ids: &["M08"],
        family: Family::Series,
        title: "J and K of unit normals as cubics along a span, by additions alone",
        formula: "F = J (k0 + k1 N.N) or K (k0 + k1 N.N);  F_next = F + dF;  dF_next = dF + ddF;  ddF_next = ddF + dddF\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "ours, of US patent 5,369,737",
        model: Model::PhongConstant,
        roundings: Roundings::new(20.0, 3.0, Stepped::Products),
        derivation: "a cubic of at most 1 whose slope and curvature over a span are at most 3 is off by 1 + 3/2 + 3/6 roundings a step; \
                     its coefficients take 8 roundings of products, and those of the line as many",
        approximation: |frame, polygon, _| approximation(frame, polygon, 1),
        fails: "where normals turn by more than about 15 degrees over a polygon: a highlight's peak is off by n times the error",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs::PIXELS_BY_POLYGON;
    const KINDS: &'static [&'static str] = &["cubics", "roots"];
    type Constants<F: Num> = [F; 2]; // the line
    type Carries = Normal;
    type Walk<F: Num> = CubicWalk<F, L>;

    #[inline(always)]
    fn of_kind(self, kind: u8) -> Self {
        CubicPhong { kind }
    }
    #[inline(always)]
    fn polygon<R: Real>(
        self,
        lit: &Lit<'_, R>,
        polygon: &Corners<'_, R>,
    ) -> (u8, Self::Constants<R>) {
        let zero = lit.zero();
        match of_corners(1, polygon) {
            Some([k0, k1, _]) => (0, [zero.broadcast(k0), zero.broadcast(k1)]),
            None => (ROOTS, [zero; 2]),
        }
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at: n, step: dn } = span.linear();
        let at = lit.products::<L>(n);
        let step = lit.products::<L>(dn);
        let zero = lit.zero();
        let none = Cubic::zero(zero);
        let mut walk = CubicWalk {
            cubics: (PerLight::new(lit.count(), none), none),
            products: Linear { at, step },
            square: Quadratic::zero(zero),
            kind: self.kind,
        };
        if self.kind == ROOTS {
            walk.square = Quadratic::square(n, dn);
            return walk;
        }
        let [k0, k1] = span.constants();
        let (k0, k1) = (zero.of_each(|_| k0), zero.of_each(|_| k1));
        let half = n.dot(dn);
        let line = [k0 + k1 * n.dot(n), k1 * (half + half), k1 * dn.dot(dn)];
        walk.cubics.1 = Cubic::product([at.1, step.1], line);
        for i in 0..lit.count() {
            walk.cubics.0.values[i] = Cubic::product([at.0.values[i], step.0.values[i]], line);
        }
        walk
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}

/// Products of unit normals as cubics; or of other normals, linear, with their squared length.
#[derive(Clone, Copy, Debug)]
pub struct CubicWalk<F, const L: usize> {
    cubics: (PerLight<Cubic<F>, L>, Cubic<F>),
    products: Linear<Products<F, L>>,
    square: Quadratic<F>,
    kind: u8,
}

impl<F: Num, const L: usize> Walk<F> for CubicWalk<F, L> {
    type Pixel = Products<F, L>;

    #[inline(always)]
    fn next(&mut self) -> Self::Pixel {
        if self.kind != ROOTS {
            return self.cubics.next();
        }
        let (products, d) = (self.products.next(), self.square.next());
        scaled(products, d.broadcast(1.0) / d.sqrt())
    }
}
