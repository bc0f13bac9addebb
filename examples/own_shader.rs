//! A shading method outside the crate: cel shading, drawn beside naive Phong shading.
//!
//! ```text
//! cargo run --release --example own_shader > own_shader.ppm
//! ```
//!
//! All that it takes is `Toon` below: what is said about it (`Method::INFO`), what is computed once a vertex, a polygon, a
//! run and a pixel (`Shader`), and one line that makes it a row of a method table (`TOON`). The scanline engine, the
//! barycentric renderer and the counting machine then take it as their own.
//!
//! Every function of a shader is `#[inline(always)]`: one that is not costs a call a pixel.

use fastphong::lighting::Lighting;
use fastphong::mesh::builtin::builtin;
use fastphong::number::{Machine, Num, Real, dot, each};
use fastphong::reference::Model;
use fastphong::scene::Scene;
use fastphong::shader::local::{Far, Lights, Near};
use fastphong::shader::{
    Corner, Corners, Entry, Info, Local, Method, Parameter, Perspective, Roundings, Shader, SpanOf,
    Stepped, Variant,
};
use fastphong::walk::{Constant, Lerp, Linear};
use std::error::Error;
use std::io::Write;

/// Cel shading: the diffuse term in a few bands, and a highlight with a hard edge.
///
/// ```text
/// I = I_a k_a + Σ I_p k_d b/bands + Σ I_p k_s [R·V > 0.9]
/// R·V = 2 (L·N)(V·N) − L·V,   b = how many of (i − ½) / bands, i = 1, 2, …, lie below L·N
/// ```
struct Toon;

static TOON: Entry = Entry::of::<Toon>();

impl Method for Toon {
    const INFO: Info = Info {
        name: "toon",
        title: "bands of light, and a highlight with a hard edge",
        formula: "I = Ia ka + Ip kd b / bands + Ip ks [R.V > 0.9], b = how many of (i - 1/2) / bands lie below L.N",
        source: "after Lake, Marshall, Harris and Blackstein 2000",
        model: Model::Phong,
        roundings: Roundings {
            start: f64::INFINITY,
            step: 0.0,
            of: Stepped::Cosines,
        },
        derivation: "no bound: it is not an approximation of Phong shading",
        fails: "edges of bands are not smoothed",
        parameters: &[Parameter {
            name: "bands",
            meaning: "bands of light",
            default: 3,
            least: 1,
            most: 8,
            auto: None,
        }],
        perspective: Perspective::Free,
        local: Local::PerPolygon,
        barycentric: true,
    };
    // Normals are normalised at each pixel, so a weight of perspective interpolation cancels: one shader does for both.
    type Screen<const L: usize> = Of<Far, L>;
    type Perspective<const L: usize> = Of<Far, L>;
    // Lights and eye at positions are seen from the middle of each polygon: the same text, over other lights.
    type Local<const L: usize> = Of<Near, L>;
    type LocalPerspective<const L: usize> = Of<Near, L>;
}

/// Cel shading with `L` lights: `Far` ones, or `Near` ones.
struct Of<P, const L: usize>(P);

#[derive(Clone, Copy)]
struct Consts<N, C> {
    light: C,
    bands: u32,
    width: N,
    half_width: N,
    edge: N,
    zero: N,
}

impl<P: Lights, const L: usize> Shader for Of<P, L> {
    type Consts<N: Num> = Consts<N, P::Of<N, L>>;
    type Attribute<R: Real> = Lerp<[R; 3]>; // along edges: the normal, linearly
    type Polygon<R: Real> = P::There<R, L>;
    type Walk<M: Machine> = ([Linear<M::F>; 3], Constant<P::There<M::F, L>>); // along a run: three additions
    type Pixel<F: Num> = ([F; 3], P::There<F, L>);

    fn consts<N: Num>(
        lighting: &Lighting,
        parameters: &[u32],
        of: &dyn Fn(f32) -> N,
    ) -> Self::Consts<N> {
        let (bands, width) = (parameters[0], 1.0 / parameters[0] as f32);
        let light = P::new(lighting, of);
        Consts {
            light,
            bands,
            width: of(width),
            half_width: of(width / 2.0),
            edge: of(0.9),
            zero: of(0.0),
        }
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &Self::Consts<M::One>, corner: &Corner<'_, M>) -> Lerp<[M::One; 3]> {
        Lerp(corner.normal())
    }
    #[inline(always)]
    fn polygon<M: Machine>(
        c: &Self::Consts<M::One>,
        corners: &Corners<'_, M, Lerp<[M::One; 3]>>,
    ) -> P::There<M::One, L> {
        P::there(&c.light, || corners.mean_position())
    }
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &Self::Consts<M::One>,
        there: &P::There<M::One, L>,
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        let normal = each(
            #[inline(always)]
            |i| Linear::new(m, span.attribute.at[i], span.attribute.step[i]),
        );
        (normal, Constant(P::splat(m, there)))
    }
    #[inline(always)]
    fn shade<F: Num>(c: &Self::Consts<F>, (n, there): Self::Pixel<F>) -> [F; 3] {
        let (light, seen) = (P::model(&c.light), P::seen(&c.light, &there));
        let r = light.one() / dot(n, n).sqrt();
        let n = [n[0] * r, n[1] * r, n[2] * r];
        let (j, k) = (seen.light_cosines(n), seen.view_cosine(n));
        let hard = |highlight: F| light.one().gate(highlight - c.edge);
        // `colour` sums (2.1) over the lights; which cosines it is given is the method's own affair.
        light.colour(
            #[inline(always)]
            |i| {
                let (mut level, mut threshold) = (c.zero, c.half_width);
                for _ in 0..c.bands {
                    level = level + c.width.gate(j[i] - threshold);
                    threshold = threshold + c.width;
                }
                level
            },
            #[inline(always)]
            |i| hard(light.two() * j[i] * k - seen.scalars.light_view[i]),
            #[inline(always)]
            |i| hard((j[i] + k) * seen.scalars.half[i]),
            #[inline(always)]
            |i| seen.scalars.strength(i),
        )
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut scene = Scene::of_mesh(builtin("torus")?);
    (scene.width, scene.height) = (320, 240);
    let frame = scene.frame()?;
    let (own, built_in) = (TOON.variant(), Variant::parse("naive-phong")?);
    let (left, right) = (own.render(&frame), built_in.render(&frame));
    for variant in [&own, &built_in] {
        let counts = variant.operations(1);
        eprintln!(
            "{variant}: {} additions, {} multiplications, {} comparisons a pixel",
            counts.walk.additions + counts.shade.additions,
            counts.walk.multiplications + counts.shade.multiplications,
            counts.walk.comparisons + counts.shade.comparisons,
        );
    }
    let mut file = format!("P6\n{} {}\n255\n", 2 * left.width(), left.height()).into_bytes();
    for y in 0..left.height() {
        file.extend(
            left.row(y)
                .iter()
                .chain(right.row(y))
                .flat_map(|[r, g, b, _]| [*r, *g, *b]),
        );
    }
    std::io::stdout().write_all(&file)?;
    Ok(())
}
