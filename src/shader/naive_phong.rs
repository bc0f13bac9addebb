//! Naive Phong shading: normals, interpolated and renormalised at every pixel (L21 4.1).

use super::illumination::{Illumination, Seen};
use super::local::Local as LocalLight;
use super::{
    Corner, Corners, Given, Info, Local, Method, Perspective, Roundings, Shader, SpanOf, Stepped,
};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, dot, each};
use crate::reference::Model;
use crate::walk::{Lerp, Linear, Ramp};

/// Naive Phong shading: N by three additions a pixel, then a root, a division and eq 2.1 (L21 4.1–4.2).
///
/// The interpolated normal and the unit normal are two variables, as in section 4.1. The lecture's summary feeds the
/// unit normal back into the sum (`N_next = (N + ΔN)/|N + ΔN|`), which is not linear interpolation and never arrives at
/// N_2. Where a light or the eye is at a position, positions are interpolated beside the normals, and the vectors to
/// each of them are normalised at each pixel too (CS171 3, Algorithm 7). Normals on edges are not renormalised: on triangles the picture would then depend on how they lie.
#[derive(Debug)]
pub struct NaivePhong;

impl Method for NaivePhong {
    const INFO: Info = Info {
        name: "naive-phong",
        title: "normals, interpolated and renormalised at every pixel",
        formula: "N_next = N + dN;  N_unit = N / |N|;  R = 2 (L.N_unit) N_unit - L;  eq 2.1 at every pixel",
        source: "L21 4.1, eq 4.1, 4.2 (Phong 1975)",
        model: Model::Phong,
        roundings: Roundings {
            start: 4.0,
            step: 0.9,
            of: Stepped::Cosines,
        },
        derivation: "each step rounds the three components of N by half of 2^-24, which is a vector of length 0.87 * 2^-24; what \
                     lies along N is lost when N is normalised",
        fails: "where normals cancel inside a span; the slope of the intensity still jumps at edges (Duff 1979)",
        parameters: &[],
        perspective: Perspective::Free,
        local: Local::PerPixel,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<Renormalised, L>;
    type Perspective<const L: usize> = Of<Renormalised, L>;
    type Local<const L: usize> = Near<0, L>;
    type LocalPerspective<const L: usize> = Near<1, L>;
}

/// What is made of an interpolated normal at a pixel.
pub(super) trait AtPixel: 'static {
    /// The colour of a surface whose normal has the direction of `n`, before the clamp, if `USUAL` with constants of that kind.
    fn colour<F: Num, const L: usize, const USUAL: bool>(
        c: &Illumination<F, L>,
        n: [F; 3],
    ) -> [F; 3];
}

/// It is divided by its length, and lit.
#[derive(Debug)]
pub struct Renormalised;

impl AtPixel for Renormalised {
    #[inline(always)]
    fn colour<F: Num, const L: usize, const USUAL: bool>(
        c: &Illumination<F, L>,
        n: [F; 3],
    ) -> [F; 3] {
        let r = c.one() / dot(n, n).sqrt();
        c.lit_of::<USUAL>([n[0] * r, n[1] * r, n[2] * r], c.far()) // N_unit = N / |N|, 2.1
    }
}

/// Phong shading from interpolated normals with `L` lights, of which `Q` makes colours.
#[derive(Debug)]
pub struct Of<Q, const L: usize>(Q);

impl<Q: AtPixel, const L: usize> Shader for Of<Q, L> {
    type Consts<N: Num> = Illumination<N, L>;
    type Attribute<R: Real> = Lerp<[R; 3]>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = [Linear<M::F>; 3];
    type Pixel<F: Num> = [F; 3];
    const GIVEN: Given = Given::Attribute;
    const ATTRIBUTE_IS_NORMAL: bool = true;

    fn consts<N: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> Illumination<N, L> {
        Illumination::new(lighting, of)
    }
    #[inline(always)]
    fn usual<N: Num>(consts: &Illumination<N, L>, scale: N) -> Option<Illumination<N, L>> {
        consts.usual(scale)
    }
    #[inline(always)]
    fn vertex<M: Machine>(
        _: &Illumination<M::One, L>,
        corner: &Corner<'_, M>,
    ) -> Lerp<[M::One; 3]> {
        Lerp(corner.normal())
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &Illumination<M::One, L>, _: &Corners<'_, M, Lerp<[M::One; 3]>>) {}
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &Illumination<M::One, L>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let (n, dn) = (span.attribute.at, span.attribute.step);
        each(
            #[inline(always)]
            |i| Linear::new(m, n[i], dn[i]), // 4.1, 4.2
        )
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Illumination<F, L>, n: [F; 3]) -> [F; 3] {
        Q::colour::<F, L, false>(c, n)
    }
    #[inline(always)]
    fn scaled<F: Num>(c: &Illumination<F, L>, n: [F; 3], _: F) -> [F; 3] {
        Q::colour::<F, L, true>(c, n)
    }
}

/// Naive Phong shading with `L` lights, some of them or the eye at positions, with `W` weights: linear in space (1) or on
/// the screen (0).
#[derive(Debug)]
pub struct Near<const W: usize, const L: usize>;

/// Normal, position, and the weight of perspective interpolation.
pub(super) type Point<R> = ([R; 3], [R; 3], R);

/// The attribute of methods that follow normals and positions.
#[inline(always)]
pub(super) fn point<M: Machine>(m: M, corner: &Corner<'_, M>) -> Lerp<Point<M::One>> {
    Lerp((corner.normal(), corner.position(), m.one(1.0)))
}

#[inline(always)]
fn linear<M: Machine>(m: M, at: [M::One; 3], step: [M::One; 3]) -> [Linear<M::F>; 3] {
    each(
        #[inline(always)]
        |i| Linear::new(m, at[i], step[i]), // 4.1, 4.2
    )
}

impl<const W: usize, const L: usize> Shader for Near<W, L> {
    type Consts<N: Num> = LocalLight<N, L>;
    type Attribute<R: Real> = Lerp<Point<R>>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = ([Linear<M::F>; 3], [Linear<M::F>; 3], [Linear<M::F>; W]);
    type Pixel<F: Num> = ([F; 3], [F; 3], [F; W]);
    const GIVEN: Given = Given::Attribute;

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
        _: &LocalLight<M::One, L>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let Ramp {
            at: (n, p, w),
            step: (dn, dp, dw),
        } = span.attribute;
        (
            linear(m, n, dn),
            linear(m, p, dp),
            [Linear::new(m, w, dw); W],
        )
    }
    #[inline(always)]
    fn shade<F: Num>(c: &LocalLight<F, L>, (n, p, weight): Self::Pixel<F>) -> [F; 3] {
        let inv_w = if W == 1 { Some(weight[0]) } else { None };
        let one = c.model.one();
        let unit = |v: [F; 3], square: F| {
            let r = one / square.sqrt();
            [v[0] * r, v[1] * r, v[2] * r]
        };
        let inv_w_square = inv_w.map(|w| w * w);
        let mut strength = [one; L];
        let light = each(
            #[inline(always)]
            |i| {
                let l = c.toward_light(i, p, inv_w);
                let square = dot(l, l);
                strength[i] = c.strength(i, square, inv_w_square).unwrap_or(one);
                unit(l, square)
            },
        );
        let v = c.toward_eye(p, inv_w);
        let strength = if c.is_attenuated() {
            Some(strength)
        } else {
            None
        };
        let seen = Seen::new(light, unit(v, dot(v, v)), strength, &c.model);
        c.model.lit(unit(n, dot(n, n)), &seen) // 2.1
    }
}
