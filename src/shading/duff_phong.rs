//! Phong shading by forward differences: N·N is a quadratic along a span, and no vector is needed there (Duff 1979).

use super::increments::Quadratic;
use super::{
    Info, Linear, Lit, LitAt, Local, Model, PerLight, Perspective, Pixel, Planes, Roundings, Seen,
    Shader, Span, Stepped, Walk,
};
use crate::number::{Num, Vec3};
use crate::reference::Model as Truth;

/// Phong shading by forward differences, for up to `L` directional lights: `J = L·N` and `K = V·N` by one addition each,
/// `D = N·N` by two, then one root and one division. The picture is naive Phong's to rounding.
#[derive(Clone, Copy, Debug)]
pub struct DuffPhong<const L: usize>;

impl<const L: usize> Shader for DuffPhong<L> {
    const INFO: Info = Info {
        name: "duff-phong",
        title: "scalar products by forward differences: no vector on a span",
        formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = 1 / sqrt(D)\n\
                  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "Duff 1979; with positions: L.L, V.V, L.N, N.V and L.V likewise",
        model: Truth::Phong,
        roundings: Roundings {
            start: 6.0,
            step: 2.0,
            of: Stepped::Products,
        },
        derivation: "J, K and the first difference of D are each rounded by half of 2^-24 at each step, the latter then added up: D \
                     is off by 3 a step and its root by half of that, 1.5, beside the 0.5 of J or K; with positions L.N is a \
                     product too, off by 3, and divided by two roots: three times as much, and the lengths of the vectors vary \
                     by the square of the bound's spread",
        fails: "where normals cancel inside a span, D is a small difference of large sums",
        parameters: &[],
        perspective: Perspective::Free,
        local: Local::PerPixel,
        lit_at: LitAt::Pixel,
        barycentric: false,
    };
    type Varying<F: Num> = (PerLight<F, L>, F, Vec3<F>); // J of each light, K, N
    type Walk<F: Num> = (Linear<(PerLight<F, L>, F)>, Quadratic<F>); // J of each light, K; D

    #[inline(always)]
    fn new(_: &[u32], _: &Model) -> Self {
        DuffPhong
    }
    #[inline(always)]
    fn vertex<F: Num>(self, lit: &Lit<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        let mut j = PerLight::new(lit.count(), n.x);
        for light in lit.lights() {
            j[light.index] = n.dot(light.to); // J = L · N
        }
        (j, n.dot(lit.view), n) // K = V · N
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &Lit<'_, F>, span: Span<Self, F>) -> Self::Walk<F> {
        let ((j, k, n), (dj, dk, dn)) = (span.at, span.step);
        let cosines = Linear {
            at: (j, k),
            step: (dj, dk),
        };
        (cosines, Quadratic::square(n, dn)) // 4.3
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, ((j, k), d): Pixel<Self, F>) -> Vec3<F> {
        shade(lit, j, k, d.like(1.0) / d.sqrt())
    }
}

/// Returns the colour of a pixel from J, K and r = 1/√D.
#[inline(always)]
pub(super) fn shade<F: Num, const L: usize>(
    lit: &Lit<'_, F>,
    j: PerLight<F, L>,
    k: F,
    r: F,
) -> Vec3<F> {
    let v_n = k * r;
    let mut colour = lit.ambient();
    for light in lit.lights() {
        let l_n = j[light.index] * r;
        colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n)); // 4.5
    }
    colour
}

/// The same with up to `L` lights, some of them or the eye at positions. The vectors L and V grow linearly along a span like N,
/// and their six products `N·N`, `L·L`, `V·V`, `L·N`, `N·V`, `L·V` are quadratics: twelve additions a pixel for one light, six for
/// each further one, and two for 1/w², where naive Phong follows vectors and multiplies them out at each pixel:
///
/// ```text
/// diffuse = L·N / √(N·N L·L)        R·V = (2 (L·N)(N·V) − (N·N)(L·V)) / (N·N √(L·L V·V))
/// ```
///
/// Under perspective all of them are divided by w², which cancels; only the falloff of a light needs 1/w² itself.
#[derive(Clone, Copy, Debug)]
pub struct DuffPhongNear<const L: usize>;

/// The products of one light: L·L, L·N, L·V.
type OfLight<F> = (Quadratic<F>, Quadratic<F>, Quadratic<F>);

/// The products along a span.
#[derive(Clone, Copy, Debug)]
pub struct Products<F, const L: usize> {
    /// N·N, V·V, N·V, 1/w².
    shared: [Quadratic<F>; 4],
    lights: [OfLight<F>; L],
    count: usize,
}

impl<F: Num, const L: usize> Walk<F> for Products<F, L> {
    /// N·N, V·V, N·V, 1/w²; L·L, L·N and L·V of each light.
    type Pixel = ([F; 4], (PerLight<F, L>, PerLight<F, L>, PerLight<F, L>));

    #[inline(always)]
    fn next(&mut self) -> Self::Pixel {
        let [nn, vv, nv, ww] = &mut self.shared;
        let shared = [nn.next(), vv.next(), nv.next(), ww.next()];
        let none = PerLight::new(self.count, shared[0]);
        let (mut ll, mut ln, mut lv) = (none, none, none);
        let mut i = 0;
        while i < <PerLight<F, L> as Planes<F>>::count(self.count) {
            let light = &mut self.lights[i];
            (ll[i], ln[i], lv[i]) = (light.0.next(), light.1.next(), light.2.next());
            i += 1;
        }
        (shared, (ll, ln, lv))
    }
}

impl<const L: usize> Shader for DuffPhongNear<L> {
    const INFO: Info = DuffPhong::<L>::INFO;
    type Varying<F: Num> = (Vec3<F>, Vec3<F>, F); // N, position, 1/w
    type Walk<F: Num> = Products<F, L>;

    #[inline(always)]
    fn new(_: &[u32], _: &Model) -> Self {
        DuffPhongNear
    }
    #[inline(always)]
    fn vertex<F: Num>(self, lit: &Lit<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        (n, lit.point, n.x.like(1.0))
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, span: Span<Self, F>) -> Self::Walk<F> {
        let ((n, p, w), (dn, dp, dw)) = (span.at, span.step);
        let (v, dv) = (lit.toward_eye(p, w), lit.toward_eye(dp, dw));
        let half = w * dw;
        let shared = [
            Quadratic::square(n, dn),
            Quadratic::square(v, dv),
            Quadratic::product(n, dn, v, dv),
            Quadratic::new(w * w, half + half, dw * dw),
        ];
        let mut lights = [(shared[0], shared[0], shared[0]); L];
        for (products, light) in lights.iter_mut().zip(lit.stored()) {
            let (l, dl) = (light.toward(p, w), light.toward(dp, dw));
            *products = (
                Quadratic::square(l, dl),
                Quadratic::product(l, dl, n, dn),
                Quadratic::product(l, dl, v, dv),
            );
        }
        Products {
            shared,
            lights,
            count: lit.count(),
        }
    }
    #[inline(always)]
    fn shade<F: Num>(
        self,
        lit: &Lit<'_, F>,
        ([nn, vv, nv, ww], (ll, ln, lv)): Pixel<Self, F>,
    ) -> Vec3<F> {
        let one = nn.like(1.0);
        let (over_n, over_v) = (one / nn.sqrt(), one / vv.sqrt());
        let v_n = nv * over_n * over_v;
        let mut colour = lit.ambient();
        for index in 0..lit.count() {
            let over_l = one / ll[index].sqrt();
            let l_n = ln[index] * (over_n * over_l); // L·N / √(N·N L·L)
            let l_v = lv[index] * (over_v * over_l);
            let light = Seen::from_products(lit, index, l_v, ll[index], ww);
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n)); // 4.5
        }
        colour
    }
}
