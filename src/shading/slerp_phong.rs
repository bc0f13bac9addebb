//! Slerp Phong shading with scalars: `J` and `K` by incremental sines and cosines (L21 4.4, summary c).

use super::increments::{GreatCircle, Sines};
use super::{
    Info, Lit, LitAt, Local, Model, PerLight, Perspective, Pixel, Planes, Roundings, Shader, Span,
    Stepped, UnitNormal, Walk,
};
use crate::number::{Num, Vec3};
use crate::reference::Model as Truth;

/// Slerp Phong shading, scalar form, for up to `L` lights: unit normals walk great circles along the edges; along a span only
/// `J = L·N` and `K = V·N` are formed, from sines stepped by (4.9)–(4.12). No root and no division a pixel.
#[derive(Clone, Copy, Debug)]
pub struct SlerpPhong<const L: usize>;

impl<const L: usize> Shader for SlerpPhong<L> {
    const INFO: Info = Info {
        name: "slerp-phong",
        title: "J = L.N and K = V.N along great circles, by incremental sines and cosines",
        formula: "J(t) = sin((1-t)phi)/sin(phi) L.N1 + sin(t phi)/sin(phi) L.N2, K likewise; sines by eq 4.9-4.12\n\
                  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "L21 4.4, eq 4.7-4.12, summary c",
        model: Truth::Slerp,
        roundings: Roundings {
            start: 4.0,
            step: 2.0,
            of: Stepped::Cosines,
        },
        derivation: "each step turns a vector of length 1 by two products and a sum in each component, 1.5 * 2^-24 in all, with a \
                     rotation whose entries are rounded by half of 2^-24",
        fails: "on short spans, which pay one inverse tangent, three pairs of sine and cosine, two roots and a \
                division each; on triangles the picture depends on how they lie; opposite normals have no great circle",
        parameters: &[],
        perspective: Perspective::ScreenOnly,
        local: Local::PerPolygon,
        lit_at: LitAt::Pixel,
        barycentric: false,
    };
    type Varying<F: Num> = UnitNormal<F>;
    type Walk<F: Num> = Cosines<F, L>;

    #[inline(always)]
    fn new(_: &[u32], _: &Model) -> Self {
        SlerpPhong
    }
    #[inline(always)]
    fn vertex<F: Num>(self, _: &Lit<'_, F>, n: Vec3<F>) -> UnitNormal<F> {
        UnitNormal(n)
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<Self, F>) -> Cosines<F, L> {
        let GreatCircle { from, to, sines } = span;
        let none = PerLight::new(lit.count(), from.x);
        let mut j = [none, none];
        for light in lit.lights() {
            j[0][light.index] = from.dot(light.to); // J = L · N
            j[1][light.index] = to.dot(light.to);
        }
        let k = [from.dot(lit.view), to.dot(lit.view)]; // K = V · N
        Cosines {
            sines,
            j,
            k,
            lights: lit.count(),
        }
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, (j, k): Pixel<Self, F>) -> Vec3<F> {
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = j[light.index];
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, k)); // 4.5
        }
        colour
    }
}

/// `J` of each light and `K` along a great circle: those of both ends, divided by sin φ, and the weights between them.
#[derive(Clone, Copy, Debug)]
pub struct Cosines<F, const L: usize> {
    sines: Sines<F>,
    j: [PerLight<F, L>; 2],
    k: [F; 2],
    lights: usize,
}

impl<F: Num, const L: usize> Walk<F> for Cosines<F, L> {
    type Pixel = (PerLight<F, L>, F);

    #[inline(always)]
    fn next(&mut self) -> Self::Pixel {
        let (from, to) = self.sines.next(); // 4.9–4.12
        let mut j = self.j[0];
        let mut i = 0;
        while i < <PerLight<F, L> as Planes<F>>::count(self.lights) {
            j[i] = from * self.j[0][i] + to * self.j[1][i]; // 4.8, times L
            i += 1;
        }
        (j, from * self.k[0] + to * self.k[1]) // 4.8, times V
    }
}
