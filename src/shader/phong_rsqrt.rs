//! Phong shading from normals with scalars: what suits processors that shade eight pixels at a time, row by row.

use super::illumination::Illumination;
use super::naive_phong::{AtPixel, Near, Of};
use super::{Info, Local, Method, Perspective, Roundings, Stepped};
use crate::number::{Num, dot};
use crate::reference::Model;

/// Naive Phong shading without its vectors: N by three additions a pixel, then `J = L·N`, `K = V·N`, `D = N·N` and the
/// processor's reciprocal root `r = 1/√D`, of which the cosines are `J r` and `2 (J r) (K r) − L·V` (L21 4.3, 4.6).
///
/// It steps three numbers for any number of lights, where fast Phong steps one a light, one for K and two for D: where what is
/// stepped is kept in memory until a row is shaded, that is less to keep, and products are cheaper than memory. Where a light
/// or the eye is at a position it is naive Phong.
#[derive(Debug)]
pub struct PhongRsqrt;

impl Method for PhongRsqrt {
    const INFO: Info = Info {
        name: "phong-rsqrt",
        title: "normals interpolated; J = L.N, K = V.N, D = N.N and the hardware's reciprocal root at every pixel",
        formula: "N_next = N + dN;  J = L.N;  K = V.N;  r = rsqrt(N.N);  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "L21 4.1-4.3, eq 4.5, with the root that processors have had since 1999 (SSE rsqrtps)",
        model: Model::Phong,
        roundings: Roundings {
            start: 10.0,
            step: 0.9,
            of: Stepped::Cosines,
        },
        derivation: "as naive-phong; J, K and D take 5 roundings each, and the estimate of the root is off by 2^-22, which is 4 more",
        fails: "as naive-phong",
        parameters: &[],
        perspective: Perspective::Free,
        local: Local::PerPixel,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<Scalars, L>;
    type Perspective<const L: usize> = Of<Scalars, L>;
    type Local<const L: usize> = Near<0, L>;
    type LocalPerspective<const L: usize> = Near<1, L>;
}

/// Its scalar products with light and eye are divided by its length.
#[derive(Debug)]
pub struct Scalars;

impl AtPixel for Scalars {
    #[inline(always)]
    fn colour<F: Num, const L: usize, const USUAL: bool>(
        c: &Illumination<F, L>,
        n: [F; 3],
    ) -> [F; 3] {
        let r = dot(n, n).over_sqrt();
        let (light, k) = (&c.far().light, c.far().view_cosine(n));
        c.colour_of_unit_cosines::<USUAL>(
            #[inline(always)]
            |i| dot(light[i], n) * r,
            k * r,
            &c.far().scalars,
        )
    }
}
