//! Phong shading by forward differences: N·N is a quadratic along a span, and no vector is needed there (Duff 1979).

use super::illumination::Illumination;
use super::local::Local as LocalLight;
use super::naive_phong::{Point, point};
use super::{
    Corner, Corners, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped,
};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Lerp, Linear, Quadratic, Ramp};

/// Phong shading by forward differences: `J = L·N` and `K = V·N` by one addition each, `D = N·N` by two, then one root and
/// one division. The picture is naive Phong's to rounding.
///
/// Where a light or the eye is at a position, the vectors L and V grow linearly along a span like N, and their six products
/// `N·N`, `L·L`, `V·V`, `L·N`, `N·V`, `L·V` are quadratics: twelve additions a pixel for one light and six for each
/// further one, where naive Phong follows vectors and multiplies them out at each pixel:
///
/// ```text
/// diffuse = L·N / √(N·N L·L)        R·V = (2 (L·N)(N·V) − (N·N)(L·V)) / (N·N √(L·L V·V))
/// ```
///
/// Under perspective all of them are divided by w², which cancels; only the falloff of a light needs 1/w² itself, two
/// additions more.
#[derive(Debug)]
pub struct DuffPhong;

impl Method for DuffPhong {
    const INFO: Info = Info {
        name: "duff-phong",
        title: "scalar products by forward differences: no vector on a span",
        formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = 1 / sqrt(D)\n\
                  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "Duff 1979; with positions: L.L, V.V, L.N, N.V and L.V likewise",
        model: Model::Phong,
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
        barycentric: false,
    };
    type Screen<const L: usize> = Of<RootAndQuotient, L>;
    type Perspective<const L: usize> = Of<RootAndQuotient, L>;
    type Local<const L: usize> = Near<false, L>;
    type LocalPerspective<const L: usize> = Near<true, L>;
}

/// How 1/√D is computed.
pub(super) trait OverRoot: 'static {
    fn of<F: Num>(d: F, one: F) -> F;
}

/// By a root and a division.
#[derive(Debug)]
pub struct RootAndQuotient;

impl OverRoot for RootAndQuotient {
    #[inline(always)]
    fn of<F: Num>(d: F, one: F) -> F {
        one / d.sqrt()
    }
}

/// Forward differences with `L` lights.
#[derive(Debug)]
pub struct Of<Q, const L: usize>(Q);

/// J of each light, K, N.
type Jkn<R, const L: usize> = ([R; L], R, [R; 3]);

impl<Q: OverRoot, const L: usize> Shader for Of<Q, L> {
    type Consts<N: Num> = Illumination<N, L>;
    type Attribute<R: Real> = Lerp<Jkn<R, L>>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = ([Linear<M::F>; L], Linear<M::F>, Quadratic<M::F>);
    type Pixel<F: Num> = ([F; L], F, F);

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> Illumination<N, L> {
        Illumination::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(
        c: &Illumination<M::One, L>,
        corner: &Corner<'_, M>,
    ) -> Lerp<Jkn<M::One, L>> {
        let (normal, seen) = (corner.normal(), c.far());
        Lerp((seen.light_cosines(normal), seen.view_cosine(normal), normal))
    }
    #[inline(always)]
    fn polygon<M: Machine>(
        _: &Illumination<M::One, L>,
        _: &Corners<'_, M, Self::Attribute<M::One>>,
    ) {
    }
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &Illumination<M::One, L>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let Ramp {
            at: (j, k, n),
            step: (dj, dk, dn),
        } = span.attribute;
        let light = each(
            #[inline(always)]
            |i| Linear::new(m, j[i], dj[i]), // 4.3
        );
        (light, Linear::new(m, k, dk), Quadratic::square(m, n, dn))
    }
    #[inline(always)]
    fn usual<N: Num>(consts: &Illumination<N, L>, scale: N) -> Option<Illumination<N, L>> {
        consts.usual(scale)
    }
    #[inline(always)]
    fn scaled<F: Num>(c: &Illumination<F, L>, pixel: Self::Pixel<F>, _: F) -> [F; 3] {
        colour::<Q, F, L, true>(c, pixel)
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Illumination<F, L>, pixel: Self::Pixel<F>) -> [F; 3] {
        colour::<Q, F, L, false>(c, pixel)
    }
}

/// The colour of a pixel from J, K and D, if `USUAL` with constants of that kind.
#[inline(always)]
fn colour<Q: OverRoot, F: Num, const L: usize, const USUAL: bool>(
    c: &Illumination<F, L>,
    (j, k, d): ([F; L], F, F),
) -> [F; 3] {
    let r = Q::of(d, c.one());
    c.colour_of_unit_cosines::<USUAL>(
        #[inline(always)]
        |i| j[i] * r,
        k * r,
        &c.far().scalars,
    )
}

/// Forward differences with `L` lights, some of them or the eye at positions; linear in space (`SPACE`) or on the screen.
#[derive(Debug)]
pub struct Near<const SPACE: bool, const L: usize>;

/// What of the products belongs to one light: L·L, L·N, L·V.
type OfLight<T> = (T, T, T);

impl<const SPACE: bool, const L: usize> Shader for Near<SPACE, L> {
    type Consts<N: Num> = LocalLight<N, L>;
    type Attribute<R: Real> = Lerp<Point<R>>;
    type Polygon<R: Real> = ();
    /// N·N, V·V, N·V; those of each light; 1/w² if it is needed.
    type Walk<M: Machine> = (
        [Quadratic<M::F>; 3],
        [OfLight<Quadratic<M::F>>; L],
        Option<Quadratic<M::F>>,
    );
    type Pixel<F: Num> = ([F; 3], [OfLight<F>; L], Option<F>);

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> LocalLight<N, L> {
        LocalLight::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(
        _: &LocalLight<M::One, L>,
        corner: &Corner<'_, M>,
    ) -> Lerp<Point<M::One>> {
        point(corner.machine, corner)
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &LocalLight<M::One, L>, _: &Corners<'_, M, Lerp<Point<M::One>>>) {}
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        c: &LocalLight<M::One, L>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let Ramp {
            at: (n, p, w),
            step: (dn, dp, dw),
        } = span.attribute;
        let (inv_w, inv_w_step) = if SPACE {
            (Some(w), Some(dw))
        } else {
            (None, None)
        };
        let (v, dv) = (c.toward_eye(p, inv_w), c.eye_step(dp, inv_w_step));
        let shared = [
            Quadratic::square(m, n, dn),
            Quadratic::square(m, v, dv),
            Quadratic::product(m, n, dn, v, dv),
        ];
        let lights = each(
            #[inline(always)]
            |i| {
                let (l, dl) = (c.toward_light(i, p, inv_w), c.light_step(i, dp, inv_w_step));
                let with_view = Quadratic::product(m, l, dl, v, dv);
                (
                    Quadratic::square(m, l, dl),
                    Quadratic::product(m, l, dl, n, dn),
                    with_view,
                )
            },
        );
        let weight = if SPACE && c.is_attenuated() {
            let half = w * dw;
            Some(Quadratic::new(m, w * w, half + half, dw * dw))
        } else {
            None
        };
        (shared, lights, weight)
    }
    #[inline(always)]
    fn shade<F: Num>(
        c: &LocalLight<F, L>,
        ([nn, vv, nv], lights, inv_w_square): Self::Pixel<F>,
    ) -> [F; 3] {
        let (one, two) = (c.model.one(), c.model.two());
        let (over_n, over_v) = (one / nn.sqrt(), one / vv.sqrt());
        let n_v = nv * over_n * over_v;
        let over_l: [F; L] = each(
            #[inline(always)]
            |i| one / lights[i].0.sqrt(),
        );
        let l_n: [F; L] = each(
            #[inline(always)]
            |i| lights[i].1 * (over_n * over_l[i]), // L·N / √(N·N L·L)
        );
        let l_v = |i: usize| lights[i].2 * (over_v * over_l[i]);
        c.model.colour(
            #[inline(always)]
            |i| l_n[i],
            #[inline(always)]
            |i| two * l_n[i] * n_v - l_v(i), // 4.5
            #[inline(always)]
            |i| (l_n[i] + n_v) * c.model.over_sum(l_v(i)), // N·H
            #[inline(always)]
            |i| c.strength(i, lights[i].0, inv_w_square),
        )
    }
}
