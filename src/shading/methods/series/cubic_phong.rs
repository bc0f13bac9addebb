//! Phong shading by additions only: products of unit normals are cubics along a span.

use crate::number::{Num, Real, Vec3};
use crate::reference::Model;
use crate::shading::methods::roots::duff_phong::DuffOfNormals;
use crate::shading::methods::series::series_phong::{approximation, of_corners};
use crate::shading::walks::Cubic;
use crate::shading::{
    Chosen, Corners, Family, Info, LightAt, Linear, Method, Needs, Normal, OneOf, PerLight, Pixel,
    Roundings, Shader, Span, Stepped,
};

/// Cubic Phong shading for up to `L` lights.
///
/// With a line for 1/√D, as in
/// [`SeriesPhong`](crate::shading::methods::series::series_phong::SeriesPhong) of order 1, the
/// products of unit normals are a linear function times a quadratic one: cubics, which take three
/// additions per pixel each and nothing else.
///
/// ```text
/// J/√D ~ J (k_0 + k_1 D),   K/√D ~ K (k_0 + k_1 D)
/// ```
/// Polygons whose normals turn too far for a line take roots.
#[derive(Clone, Copy, Debug, Default)]
pub struct CubicPhong<const L: usize>;

impl<const L: usize> Method for CubicPhong<L> {
    const INFO: Info = Info {
        name: "cubic-phong",
        ids: &["M08"],
        family: Family::Series,
        title: "J and K of unit normals as cubics along a span, by additions only",
        formula: "F = J (k0 + k1 N.N) or K (k0 + k1 N.N);  F_next = F + dF;  dF_next = dF + ddF;  ddF_next = ddF + dddF\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "ours, after US patent 5,369,737",
        model: Model::PhongConstant,
        roundings: Roundings::new(20.0, 3.0, Stepped::Products),
        derivation: "a cubic of at most 1 whose slope and curvature over a span are at most 3 gathers 1 + 3/2 + 3/6 roundings per step; \
                     its coefficients take 8 roundings in products, and the line's coefficients as many",
        approximation: |frame, polygon, _| approximation(frame, polygon, 1),
        fails: "where normals turn by more than about 15 degrees over a polygon: n multiplies the error at a highlight's peak",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs::PIXELS_BY_POLYGON;
    type Kinds = (Cubics<L>, DuffOfNormals<L>);

    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        match of_corners(1, polygon) {
            Some([k0, k1, _]) => OneOf::First([k0, k1].map(|k| lit.zero().broadcast(k))),
            None => OneOf::Second(()),
        }
    }
}

/// The kind of polygons whose products are cubics.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cubics<const L: usize>;

impl<const L: usize> Shader for Cubics<L> {
    const INFO: Info = Info::of_kind("cubic");
    type Constants<F: Num> = [F; 2]; // the line
    type Carries = Normal;
    type Walk<F: Num> = Cubic<(PerLight<F, L>, F)>;
    const VALUES: &'static [&'static str] = &["J_i", "K"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at: n, step: dn } = span.linear();
        let [k0, k1] = span.constants().map(|k| lit.zero().of_each(|_| k));
        let half = n.dot(dn);
        let line = [k0 + k1 * n.dot(n), k1 * (half + half), k1 * dn.dot(dn)];
        let cubics = Cubic::product([lit.products(n), lit.products(dn)], line);
        // Hides the start from LLVM. If LLVM sees it, it packs the differences of one light into a
        // register, which each pixel takes apart again.
        core::hint::black_box(cubics)
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, products: Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(products)
    }
}
