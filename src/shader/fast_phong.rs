//! Fast Phong shading: scalars instead of vectors, Newton's root instead of a true one (L21 4.2–4.3).

use super::illumination::{Illumination, Seen, SeenScalars};
use super::local::{Lights, Local as LocalLight, Near as NearLights};
use super::{
    Auto, Corner, Corners, Info, Local, Method, Parameter, Perspective, Roundings, Shader, SpanOf,
    Stepped,
};
use crate::lighting::{Lighting, SpecularModel};
use crate::number::{Machine, Num, Real, each};
use crate::reference::Model;
use crate::walk::{Constant, Lerp, Linear, Newton, Steps};

/// Fast Phong shading as the lecture prints it: `J = L·N` for each light, `K = V·N` and N by additions, `D = N·N`, and
/// `d = √D` by Newton's method from the previous pixel's (L21 4.2–4.3).
///
/// The diffuse term is `J/d`, the specular term `(2JK/D − L·V)^n`: the root touches only the former. With m steps a
/// pixel costs m + 2 divisions, where naive Phong has one division and one root. By default each span takes the fewest steps
/// that cannot be seen, one on all but the shortest, and true roots where normals nearly cancel ([`Steps::within`]);
/// `steps=2` takes two everywhere, unguarded, as printed.
#[derive(Debug)]
pub struct FastPhong;

impl Method for FastPhong {
    const INFO: Info = Info {
        name: "fast-phong",
        title: "J = L.N, K = V.N and N by additions, the root by Newton's method",
        formula: "J_next = J + dJ;  K_next = K + dK;  N_next = N + dN;  D = N.N;  d = sqrt(D) by Newton from the \
                  previous pixel\nI = Ia ka + Ip kd J/d + Ip ks (2 J K / D - L.V)^n",
        source: "L21 4.2, 4.3, eq 4.3-4.6",
        model: Model::PhongConstant,
        roundings: Roundings {
            start: 4.0,
            step: 1.4,
            of: Stepped::Cosines,
        },
        derivation: "each step rounds J and K by half of 2^-24, and the three components of N, so d = |N|, by 0.87 * 2^-24: \
                     J/d is off by 1.4, and 2 J K / D by 2 (0.5 + 0.5 + 2 * 0.87) = 5.5, which is 4 * 1.4",
        fails: "with a number of steps given: on spans of few pixels over a large angle, where the previous length is a bad \
                first guess, and where normals cancel inside a span",
        parameters: &[Parameter {
            name: "steps",
            meaning: "steps of Newton's method a pixel",
            default: Parameter::AUTO,
            least: 1,
            most: 8,
            auto: Some(Auto {
                meaning: "on each span the fewest that leave every term within 0.001 of itself, a true root where 3 do not",
                length_error: largest_error,
            }),
        }],
        perspective: Perspective::Free,
        local: Local::PerPolygon,
        barycentric: false,
    };
    type Screen<const L: usize> = Of<L>;
    type Perspective<const L: usize> = Of<L>;
    type Local<const L: usize> = Near<L>;
    type LocalPerspective<const L: usize> = Near<L>;
}

/// Fast Phong shading with `L` lights.
#[derive(Debug)]
pub struct Of<const L: usize>;

/// The largest relative error of a length with which `steps=auto` is content: [`Newton::LARGEST_ERROR`] where only diffuse
/// cosines are divided by it. N·H is divided by it too, and raised to n, which multiplies a small error by n.
fn largest_error(lighting: &Lighting) -> f32 {
    match lighting.specular {
        SpecularModel::Phong => Newton::<f32>::LARGEST_ERROR,
        SpecularModel::Blinn => Newton::<f32>::LARGEST_ERROR / lighting.shininess.max(1.0),
    }
}

/// The steps that the value of the parameter stands for.
fn steps<N: Num>(lighting: &Lighting, parameters: &[u32], of: &dyn Fn(f32) -> N) -> Steps<N> {
    match parameters[0] {
        Parameter::AUTO => Steps::within(largest_error(lighting), of),
        count => Steps::Fixed(count),
    }
}

/// The light, and how many steps of Newton's method a pixel takes.
#[derive(Clone, Copy, Debug)]
pub struct Consts<N, const L: usize> {
    light: Illumination<N, L>,
    steps: Steps<N>,
}

/// J of each light, K, N.
type Jkn<R, const L: usize> = ([R; L], R, [R; 3]);

impl<const L: usize> Shader for Of<L> {
    type Consts<N: Num> = Consts<N, L>;
    type Attribute<R: Real> = Lerp<Jkn<R, L>>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = ([Linear<M::F>; L], Linear<M::F>, Newton<M::F>);
    type Pixel<F: Num> = ([F; L], F, (F, F));

    fn consts<N: Num>(
        lighting: &Lighting,
        parameters: &[u32],
        of: &dyn Fn(f32) -> N,
    ) -> Consts<N, L> {
        Consts {
            light: Illumination::new(lighting, of),
            steps: steps(lighting, parameters, of),
        }
    }
    #[inline(always)]
    fn vertex<M: Machine>(c: &Consts<M::One, L>, corner: &Corner<'_, M>) -> Lerp<Jkn<M::One, L>> {
        let (normal, seen) = (corner.normal(), c.light.far());
        Lerp((seen.light_cosines(normal), seen.view_cosine(normal), normal))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &Consts<M::One, L>, _: &Corners<'_, M, Self::Attribute<M::One>>) {}
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        c: &Consts<M::One, L>,
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let ((j, k, n), (dj, dk, dn)) = (span.attribute.at, span.attribute.step);
        let light = each(
            #[inline(always)]
            |i| Linear::new(m, j[i], dj[i]), // 4.3
        );
        (light, Linear::new(m, k, dk), Newton::new(m, n, dn, c.steps))
    }
    #[inline(always)]
    fn usual<N: Num>(consts: &Consts<N, L>, scale: N) -> Option<Consts<N, L>> {
        Some(Consts {
            light: consts.light.usual(scale)?,
            steps: consts.steps,
        })
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Consts<F, L>, (j, k, (d, squared)): Self::Pixel<F>) -> [F; 3] {
        colour::<F, L, false>(&c.light, j, k, d, squared, &c.light.far().scalars)
    }
    #[inline(always)]
    fn scaled<F: Num>(c: &Consts<F, L>, (j, k, (d, squared)): Self::Pixel<F>, _: F) -> [F; 3] {
        colour::<F, L, true>(&c.light, j, k, d, squared, &c.light.far().scalars)
    }
}

/// The colour of a pixel from J, K, d and D, if `USUAL` with constants of that kind.
#[inline(always)]
fn colour<F: Num, const L: usize, const USUAL: bool>(
    light: &Illumination<F, L>,
    j: [F; L],
    k: F,
    d: F,
    squared: F,
    seen: &SeenScalars<F, L>,
) -> [F; 3] {
    let (over_d, twice_k) = (light.one() / d, light.two() * k / squared);
    light.colour_of::<USUAL>(
        #[inline(always)]
        |i| j[i] * over_d,
        #[inline(always)]
        |i| twice_k * j[i] - seen.light_view[i], // 4.6
        #[inline(always)]
        |i| (j[i] + k) * over_d * seen.half[i], // N·H = (L·N + V·N) / |L + V|
        #[inline(always)]
        |i| seen.strength(i),
    )
}

/// Fast Phong shading with `L` lights, some of them or the eye at positions: as the lecture assumes, L and V are constant
/// along each polygon (L21 1), those of the mean of its corners.
#[derive(Debug)]
pub struct Near<const L: usize>;

/// The light, and how many steps of Newton's method a pixel takes.
#[derive(Clone, Copy, Debug)]
pub struct NearConsts<N, const L: usize> {
    light: LocalLight<N, L>,
    steps: Steps<N>,
}

impl<const L: usize> Shader for Near<L> {
    type Consts<N: Num> = NearConsts<N, L>;
    type Attribute<R: Real> = Lerp<[R; 3]>;
    type Polygon<R: Real> = Seen<R, L>;
    type Walk<M: Machine> = (
        [Linear<M::F>; L],
        Linear<M::F>,
        Newton<M::F>,
        Constant<SeenScalars<M::F, L>>,
    );
    type Pixel<F: Num> = ([F; L], F, (F, F), SeenScalars<F, L>);

    fn consts<N: Num>(
        lighting: &Lighting,
        parameters: &[u32],
        of: &dyn Fn(f32) -> N,
    ) -> NearConsts<N, L> {
        NearConsts {
            light: LocalLight::new(lighting, of),
            steps: steps(lighting, parameters, of),
        }
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &NearConsts<M::One, L>, corner: &Corner<'_, M>) -> Lerp<[M::One; 3]> {
        Lerp(corner.normal())
    }
    #[inline(always)]
    fn polygon<M: Machine>(
        c: &NearConsts<M::One, L>,
        corners: &Corners<'_, M, Lerp<[M::One; 3]>>,
    ) -> Seen<M::One, L> {
        c.light.seen_from(corners.mean_position())
    }
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        c: &NearConsts<M::One, L>,
        seen: &Seen<M::One, L>,
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let (n, dn) = (span.attribute.at, span.attribute.step);
        let (j, dj) = (seen.light_cosines(n), seen.light_cosines(dn));
        let light = each(
            #[inline(always)]
            |i| Linear::new(m, j[i], dj[i]), // 4.3
        );
        let view = Linear::new(m, seen.view_cosine(n), seen.view_cosine(dn));
        let scalars = NearLights::splat(m, seen).scalars;
        (
            light,
            view,
            Newton::new(m, n, dn, c.steps),
            Constant(scalars),
        )
    }
    #[inline(always)]
    fn shade<F: Num>(c: &NearConsts<F, L>, (j, k, (d, squared), seen): Self::Pixel<F>) -> [F; 3] {
        colour::<F, L, false>(&c.light.model, j, k, d, squared, &seen)
    }
}
