//! Phong shading by forward differences: N·N is a quadratic along a span, so a span needs no vector
//! (Duff 1979).

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::light::toward;
use crate::shading::methods::roots::fast_phong_rsqrt::FAST_PHONG_RSQRT;
use crate::shading::walks::Quadratic;
use crate::shading::walks::products;
use crate::shading::walks::values::scaled;
use crate::shading::{
    Info, LightAt, Linear, Local, Needs, Normal, NormalAndPlace, PerLight, Pixel,
    ProductsAndNormal, Roundings, Shader, Span, Stepped, Tier,
};

const DUFF_PHONG: Info = Info {
    name: "duff-phong",
    ids: &["M05"],
    tier: Tier::Default,
    title: "scalar products by forward differences: no vector on a span",
    formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = 1 / sqrt(D)\n\
              I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
    source: "Duff 1979; with positions also L.L, V.V, L.N, N.V and L.V by differences",
    claimed: "3 additions, 1 division and 1 square root a pixel, for diffuse light (Bishop and Weimer 1986, of Duff)",
    model: Model::Phong,
    roundings: Roundings::new(6.0, 2.0, Stepped::Products),
    derivation: "each step rounds J, K and the first difference of D by half of 2^-24, and D adds the difference's errors up: D \
                 gathers 3 roundings per step and its root half of that, 1.5, beside the 0.5 of J or K; with positions L.N is a \
                 product too, with 3, and is divided by two roots: three times as much, and the lengths of the vectors vary \
                 by the square of the bound's spread",
    fails: "where normals cancel inside a span, D is a small difference of large sums",
    ..Info::OF_PIXELS
};

/// Phong shading by forward differences, for up to `L` directional lights.
///
/// A pixel takes one addition each for `J = L·N` and `K = V·N`, two for `D = N·N`, then one root
/// and one division. The picture is naive Phong's to rounding. With `FAST`, lights and eye at
/// positions are seen from the mean of each polygon: see [`FAST_PHONG_RSQRT`]. With SIMD each block
/// computes D from N.
#[derive(Clone, Copy, Debug, Default)]
pub struct DuffPhong<const L: usize, const FAST: bool = false>;

impl<const L: usize, const FAST: bool> Shader for DuffPhong<L, FAST> {
    const INFO: Info = if FAST { FAST_PHONG_RSQRT } else { DUFF_PHONG };
    const NEEDS: Needs = Needs {
        local: if FAST {
            Local::PerPolygon
        } else {
            Local::PerPixel
        },
        sums_lights: true,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = ProductsAndNormal<L>;
    type Walk<F: Num> = (Linear<(PerLight<F, L>, F)>, Quadratic<F>);
    const VALUES: &'static [&'static str] = &["J_i", "K", "D"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at, step } = span.linear();
        let ((at, n), (step, dn)) = (at, step);
        (Linear { at, step }, Quadratic::square(n, dn)) // 4.3
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (products, d): Pixel<Self, F>) -> Vec3<F> {
        lit.shade_products(scaled(products, d.rsqrt()))
    }
}

/// Duff's method for vertices that carry only normals: the products are computed at the start of a
/// run. Methods of several kinds use it for polygons that have nothing cheaper.
#[derive(Clone, Copy, Debug, Default)]
pub struct DuffOfNormals<const L: usize>;

impl<const L: usize> DuffOfNormals<L> {
    /// Starts the products and the square of a normal that grows linearly.
    #[inline(always)]
    pub(crate) fn start<F: Num>(
        lit: &LightAt<'_, F>,
        Linear { at: n, step: dn }: Linear<Vec3<F>>,
    ) -> <Self as Shader>::Walk<F> {
        // Products are linear in N, so those of ΔN are their steps.
        let (at, step) = (lit.products(n), lit.products(dn));
        (Linear { at, step }, Quadratic::square(n, dn)) // 4.3
    }
}

impl<const L: usize> Shader for DuffOfNormals<L> {
    const INFO: Info = DUFF_PHONG;
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = (Linear<(PerLight<F, L>, F)>, Quadratic<F>);
    const VALUES: &'static [&'static str] = &["J_i", "K", "D"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        Self::start(lit, span.linear())
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F> {
        DuffPhong::<L>.shade(lit, pixel)
    }
}

/// Phong shading by forward differences for up to `L` lights, where some of them or the eye are at
/// positions.
///
/// The vectors L and V grow linearly along a span, as N does, so their six products `N·N`, `L·L`,
/// `V·V`, `L·N`, `N·V` and `L·V` are quadratics. They take twelve additions per pixel for one
/// light, six for each further one, and two for 1/w²; naive Phong steps the vectors and multiplies
/// them at each pixel: at each pixel:
///
/// ```text
/// diffuse = L·N / √(N·N L·L)        R·V = (2 (L·N)(N·V) − (N·N)(L·V)) / (N·N √(L·L V·V))
/// ```
///
/// Under perspective all products are divided by w², which cancels. Only the falloff of a light
/// needs 1/w² itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct DuffPhongLocal<const L: usize>;

products! {
    /// Products of the vectors N, V and L, and the square of the weight w.
    LocalProducts { nn, vv, nv, ww } per light { ll, ln, lv }
}

impl<const L: usize> DuffPhongLocal<L> {
    /// Starts the products of vectors that grow linearly.
    #[inline(always)]
    pub(crate) fn products<F: Num>(
        lit: &LightAt<'_, F>,
        Linear { at, step }: Linear<(Vec3<F>, Vec3<F>, F)>,
    ) -> LocalProducts<Quadratic<F>, L> {
        let ((n, p, w), (dn, dp, dw)) = (at, step);

        let eye = lit.model.eye;
        // `toward` is linear in point and weight, so it turns their steps into steps of the vector.
        let (v, dv) = (toward(eye, p, w), toward(eye, dp, dw));
        let half = w * dw;
        let nn = Quadratic::square(n, dn);
        let mut products = LocalProducts {
            vv: Quadratic::square(v, dv),
            nv: Quadratic::product(n, dn, v, dv),
            ww: Quadratic::new(w * w, half + half, dw * dw),
            ..LocalProducts::new(lit.stored.len(), nn)
        };
        for (i, light) in lit.stored.iter().enumerate() {
            let (l, dl) = (toward(light.place, p, w), toward(light.place, dp, dw));
            products.ll.values[i] = Quadratic::square(l, dl);
            products.ln.values[i] = Quadratic::product(l, dl, n, dn);
            products.lv.values[i] = Quadratic::product(l, dl, v, dv);
        }
        products
    }
}

impl<const L: usize> Shader for DuffPhongLocal<L> {
    const INFO: Info = DUFF_PHONG;
    const NEEDS: Needs = Needs {
        general_only: true,
        sums_lights: true,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = NormalAndPlace;
    type Walk<F: Num> = LocalProducts<Quadratic<F>, L>;
    const VALUES: &'static [&'static str] =
        &["N.N", "V.V", "N.V", "w.w", "L_i.L_i", "L_i.N", "L_i.V"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        Self::products(lit, span.linear())
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F> {
        let one = pixel.nn.broadcast(1.0);
        let (over_n, over_v) = (one / pixel.nn.sqrt(), one / pixel.vv.sqrt());
        let v_n = pixel.nv * over_n * over_v;
        let mut colour = lit.ambient();
        for index in 0..lit.stored.len() {
            // By reference: a copy would load all lights at once, and wait for the stores of each.
            let [ll, ln, lv] = [&pixel.ll, &pixel.ln, &pixel.lv].map(|all| all.values[index]);
            let over_l = one / ll.sqrt();
            let l_n = ln * (over_n * over_l); // L·N / √(N·N L·L)
            let l_v = lv * (over_v * over_l);
            let light = lit.light(index, l_v, ll, pixel.ww);
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n)); // 4.5
        }
        colour
    }
}
