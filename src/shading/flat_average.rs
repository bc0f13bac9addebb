//! Flat shading in the other definition: one colour a polygon, from the mean of its vertices (CS171 3, Algorithm 6).

use super::flat::Flat;
use super::{
    Constant, Info, Lit, LitAt, Local, Model, Perspective, Pixel, Roundings, Shader, Span, Stepped,
};
use crate::number::{Num, Vec3};
use crate::reference::Model as Truth;

/// Flat shading as CS171 defines it: the mean of the vertex normals, at the mean of the vertex positions, lit once.
///
/// The mean is normalised, which Algorithm 6 leaves out: the lighting model is for unit normals (trap T20).
#[derive(Clone, Copy, Debug)]
pub struct FlatAverage;

impl Shader for FlatAverage {
    const INFO: Info = Info {
        name: "flat-average",
        title: "one colour a polygon, from the mean of its vertex normals",
        formula: "N = (N1 + ... + Nn) / |N1 + ... + Nn|;  P = (P1 + ... + Pn) / n;  I = eq 2.1 of N at P",
        source: "CS171 3, Algorithm 6",
        model: Truth::FlatAverage,
        roundings: Roundings {
            start: 8.0,
            step: 0.0,
            of: Stepped::Colours,
        },
        derivation: "as flat, and the mean normal takes 4 more roundings until it is a unit vector",
        fails: "as flat; where the vertex normals cancel there is no mean normal, and ambient light remains",
        parameters: &[],
        perspective: Perspective::Unaffected,
        local: Local::PerPolygon,
        lit_at: LitAt::PolygonMean,
        barycentric: true,
    };
    type Varying<F: Num> = Vec3<F>;
    type Walk<F: Num> = Constant<Vec3<F>>;

    #[inline(always)]
    fn new(_: &[u32], _: &Model) -> Self {
        FlatAverage
    }
    #[inline(always)]
    fn vertex<F: Num>(self, lit: &Lit<'_, F>, n: Vec3<F>) -> Vec3<F> {
        Flat.vertex(lit, n)
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<Self, F>) -> Constant<Vec3<F>> {
        Flat.walk(lit, span)
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, colour: Pixel<Self, F>) -> Vec3<F> {
        Flat.shade(lit, colour)
    }
}
