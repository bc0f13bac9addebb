//! Methods in integers, for processors without a floating-point unit: the loops of [`crate::integer`] on the spans of the engines.
//!
//! ```text
//! edges (f32, the span engine's) ─► normals at both ends of a span ─► 15 bits ─► a loop in integers ─► 8 bits a channel
//! ```
//!
//! A span is shaded whole, whatever is seen of it, and its visible pixels are copied: so nothing that is fitted over it changes with what
//! hides parts of it. Spans of over [`integer::Span::MAX`] pixels are shaded in pieces.
//!
//! [`integer::ErrorBound`] derives the errors against the closed form from the formats. Colours are those of 8 bits: half a level of it is
//! a part that no other method has.

pub(crate) mod fast;
pub(crate) mod fast_printed;
pub(crate) mod gouraud;
pub(crate) mod naive;
pub(crate) mod naive_printed;
pub(crate) mod quadratic;
pub(crate) mod slerp;

use crate::frame::{Frame, Polygon};
use crate::integer::{
    self, ErrorBound, Halfway, Highlight, Light, Material, NoHighlight, Reflection, Rgb888, Vector,
};
use crate::number::{Counts, Num, Real, Vec3, vec3};
use crate::reference::Model;
use crate::scene::{Interpolation, Lighting, Place, SpecularGate, SpecularModel};
use crate::shading::bounds::polygon_ranges::Extent;
use crate::shading::kernels::operation_counts::{CountedSpan, OperationCounts, count};
use crate::shading::kernels::runs::{PolygonConstants, Run};
use crate::shading::kernels::{PixelKernel, Pixels};
use crate::shading::light::Uniforms;
use crate::shading::walks::GreatCircle;
use crate::shading::{
    Approximation, Constant, Corners, Extras, Fit, Info, Lit, Method, MethodParameter, Needs,
    Normal, On, Perspective, Pixel, Roundings, RunList, Shader, Span, SpanBench, SpanPlace, Spans,
    Stepped, UniformsIndex, Value, Variant, Vertices,
};
use alloc::vec::Vec;
use core::ops::Range;
use fixed::types::U16F16;

/// The pixels of a span that are shaded at once.
const MOST: usize = integer::Span::MAX;
/// The lights of the methods that know several.
pub(crate) const LIGHTS: usize = 4;
/// The least cosine of the angles between normals and their mean for which [`ErrorBound`] holds: normals are up to 90° apart, and up to
/// 60° of [`Form::Waves`].
const LEAST_COSINE: f64 = core::f64::consts::FRAC_1_SQRT_2;
const LEAST_COSINE_OF_WAVES: f64 = 0.866_025_403_784_438_6;

/// What the span engine's edges round: as of naive Phong shading.
pub(crate) const ROUNDINGS: Roundings = Roundings::new(4.0, 0.9, Stepped::Cosines);
/// The same on great circles: as of slerp Phong shading.
pub(crate) const CIRCLE_ROUNDINGS: Roundings = Roundings::new(28.0, 2.1, Stepped::GreatCircles);
/// The reason for the stated approximation.
pub(crate) const DERIVATION: &str = "edges as of naive-phong; then normals, cosines and roots are rounded to 15 bits, cosines to the \
                                     entries of tables, and colours to 8 bits: the formats' errors are those of the approximation";
/// What these methods are not for.
pub(crate) const FAILS: &str =
    "where normals turn by more than 90 degrees over a polygon; lights and eye are at infinity";

/// The parameter of methods that find 1/|N| by table.
pub(crate) const PARAMETERS: &[MethodParameter] = &[MethodParameter::whole(
    "steps",
    "Newton's steps after the table of 1/|N|",
    0,
    [0, 1],
)];

/// Returns the value of [`PARAMETERS`].
pub(crate) fn steps(parameters: &[Value]) -> u32 {
    parameters[0].whole().unwrap_or(0)
}

/// A description to begin from.
pub(crate) const INFO: Info = Info {
    roundings: ROUNDINGS,
    derivation: DERIVATION,
    approximation: |frame, polygon, _| approximation(frame, polygon, Form::Table),
    fails: FAILS,
    has_power: false,
    model: Model::PhongConstant,
    ..Info::OF_PIXELS
};

/// A method: its loop over a piece of a span.
pub(crate) trait Line: Sized + 'static {
    /// The description of the method.
    const INFO: Info;
    /// What it asks of engines: [`Normals`] or [`Circles`].
    type Shell: Method;
    /// The most lights that it knows.
    const LIGHTS: usize = LIGHTS;
    /// Shades runs by its loop.
    const PIXELS: PixelKernel = pixels::<Self>;

    /// Returns the operations of a span's set-up, of a step and of a pixel with so many lights, as the loops stand.
    fn counts(lights: u32, parameters: &[Value]) -> [Counts; 3];
    /// Shades `line` from the normal at its first pixel to that at the pixel after its last.
    fn shade<H: Highlight, const L: usize>(
        parameters: &[Value],
        span: integer::Span,
        line: &mut [Rgb888],
        lights: &[Light<'_, Rgb888>; L],
    );
}

/// Interpolates normals over spans that engines keep: what the methods in integers ask of engines. Those for one light are the
/// methods as printed, which know highlights by R·V only.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Normals<const LIGHTS: usize>;

impl<const LIGHTS: usize> Shader for Normals<LIGHTS> {
    const INFO: Info = Info::OF_PIXELS;
    const NEEDS: Needs = Needs {
        perspective: Perspective::ScreenOnly,
        spans: Spans::Ends,
        scalar_only: WHY_SCALAR,
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = Constant<Vec3<F>>;

    fn on(on: On<'_>) -> Fit {
        on.each(|lighting, how| {
            let is_halfway = lighting.specular == SpecularModel::Blinn;
            refuses(lighting, how, LIGHTS).or((LIGHTS == 1 && is_halfway)
                .then_some("as printed, its highlights are those of R.V, not of N.H"))
        })
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &Lit<'_, F>, span: Span<'_, Self, F>) -> Constant<Vec3<F>> {
        Constant(span.linear().at)
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &Lit<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        n
    }
}

/// Carries unit normals along great circles, as [`Normals`] carries them along lines.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Circles;

impl Shader for Circles {
    const INFO: Info = Info::OF_PIXELS;
    const NEEDS: Needs = Needs {
        scalar_only: WHY_SCALAR,
        ..Needs::GREAT_CIRCLES
    };
    type Constants<F: Num> = Vec3<F>; // the polygon's normal
    type Carries = Normal;
    type Walk<F: Num> = Constant<Vec3<F>>;

    fn on(on: On<'_>) -> Fit {
        on.each(|lighting, how| refuses(lighting, how, 1))
    }
    #[inline(always)]
    fn polygon<R: Real>(self, _: &Lit<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &Lit<'_, F>, _: Span<'_, Self, F>) -> Constant<Vec3<F>> {
        Constant(vec3([lit.zero(); 3]))
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &Lit<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        n
    }
}

/// The reason why methods in integers are scalar only.
pub(crate) const WHY: &str = "it computes in integers, one pixel at a time";
const WHY_SCALAR: Option<&'static str> = Some(WHY);

/// Returns the reason why a material is not for methods in integers of so many lights.
pub(crate) fn refuses(
    lighting: &Lighting,
    interpolation: Interpolation,
    lights: usize,
) -> Option<&'static str> {
    let n = lighting.shininess;
    let is_whole = (1.0..=1000.0).contains(&n) && n == libm::floorf(n);
    if lighting.is_local() {
        return Some("in integers, lights and eye are at infinity");
    }
    if interpolation == Interpolation::Perspective {
        return Some("in integers, normals are interpolated on the screen");
    }
    if lighting.lights.len() > lights {
        return Some(match lights {
            1 => "in integers, it has one light",
            _ => "in integers, it has at most four lights",
        });
    }
    if lighting.vertex_colours {
        return Some(
            "in integers, a material has one colour (`--colours off` leaves out those of vertices)",
        );
    }
    if lighting.gate != SpecularGate::Gated {
        return Some("in integers, highlights end where L·N = 0");
    }
    if !is_whole {
        return Some("in integers, exponents are whole numbers from 1 to 1000");
    }
    None
}

/// Returns a vector in 15 fractional bits, rounded, or 0 if it is no number: a frame's builder takes any finite normal, and lines between such
/// may overflow.
pub(crate) fn vector(v: Vec3<f32>) -> Vector {
    Vector::from_f32(v.array()).unwrap_or_default()
}

/// Makes the tables of a material for each light: the first one has the ambient light.
pub(crate) fn materials(lighting: &Lighting) -> Vec<Material<Rgb888>> {
    let shininess = (lighting.shininess as u32).clamp(1, 1000);
    let colour = |c: [f32; 3]| c.map(|c| U16F16::saturating_from_num(c.max(0.0)));
    let none = [0.0; 3];
    let mut ambient = lighting.ambient;
    let lit = lighting.lights.iter().map(|l| (l.diffuse, l.specular));
    // A material without lights has ambient light all the same.
    let dark = lighting.lights.is_empty().then_some((none, none));
    lit.chain(dark)
        .map(|(diffuse, specular)| {
            let ambient = core::mem::replace(&mut ambient, none);
            Material::new(
                colour(ambient),
                colour(diffuse),
                colour(specular),
                shininess,
            )
        })
        .collect()
}

/// Makes the lights of uniforms that hold materials in integers.
pub(crate) fn lights<const L: usize>(uniforms: &Uniforms) -> [Light<'_, Rgb888>; L] {
    let direction = |place: Place<Vec3<f32>>| match place {
        Place::Infinite(v) | Place::Local(v) => vector(v),
    };
    let eye = direction(uniforms.model.eye);
    core::array::from_fn(|i| {
        let toward = uniforms.lights.get(i).map(|light| direction(light.place));
        Light::new(
            toward.unwrap_or_default(),
            eye,
            &uniforms.materials[i.min(uniforms.materials.len() - 1)],
        )
    })
}

/// Shades runs by the loop `M`.
pub(crate) fn pixels<M: Line>(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
    let along = |index: usize, t: f32| {
        let [a, b] = ends(job, index);
        vector(a + (b - a) * t)
    };
    shade::<M>(job, out, &along);
}

/// Shades runs by the loop `M`, between normals on great circles.
pub(crate) fn circles<M: Line>(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
    let along = |index: usize, t: f32| {
        let values = &job.constants.values;
        let polygon = job.list.runs[index].polygon as usize;
        let face = vec3([0, 1, 2].map(|i| values[3 * polygon + i]));
        let circle = GreatCircle::new(face, ends(job, index), t, 0.0);
        vector(circle.normal())
    };
    shade::<M>(job, out, &along);
}

/// Returns the varyings at both ends of a run's span.
pub(crate) fn ends(job: &Pixels<'_>, index: usize) -> [Vec3<f32>; 2] {
    let ends = job.list.starts.of(index);
    ends.map(|end| vec3([end[0], end[1], end[2]]))
}

/// Runs of the same uniforms, and the pixels that they are shaded into.
struct Group<'a, 'o, A> {
    job: &'a Pixels<'a>,
    uniforms: &'a Uniforms,
    runs: Range<usize>,
    out: &'o mut [[f32; 3]],
    /// Returns the normal of a run's span at a parameter.
    along: &'a A,
}

/// Shades runs by the loop `M`, between the normals that `along` returns for a run's span.
fn shade<M: Line>(job: &Pixels<'_>, out: &mut [[f32; 3]], along: &impl Fn(usize, f32) -> Vector) {
    let (mut first, mut rest) = (0, out);
    for runs in (job.list.runs).chunk_by(|a, b| a.uniforms == b.uniforms) {
        let pixels = runs.iter().map(|run| run.pixels as usize).sum();
        let (here, others) = rest.split_at_mut(pixels);
        rest = others;
        let group = Group {
            job,
            uniforms: &job.uniforms[runs[0].uniforms.0 as usize],
            runs: first..first + runs.len(),
            out: here,
            along,
        };
        first += runs.len();
        match group.uniforms.model.specular {
            _ if is_dull(group.uniforms) => group.by_lights::<M, NoHighlight>(),
            SpecularModel::Phong => group.by_lights::<M, Reflection>(),
            SpecularModel::Blinn => group.by_lights::<M, Halfway>(),
        }
    }
}

/// True if a material has no highlights.
pub(crate) fn is_dull(uniforms: &Uniforms) -> bool {
    (uniforms.lights.iter()).all(|light| light.specular.array() == [0.0; 3])
}

impl<A: Fn(usize, f32) -> Vector> Group<'_, '_, A> {
    /// Shades the runs by the loop for as many lights as there are.
    fn by_lights<M: Line, H: Highlight>(self) {
        match self.uniforms.lights.len() {
            0 | 1 => self.shade::<M, H, 1>(),
            2 => self.shade::<M, H, 2>(),
            3 => self.shade::<M, H, 3>(),
            _ => self.shade::<M, H, 4>(),
        }
    }

    fn shade<M: Line, H: Highlight, const L: usize>(self) {
        let (lights, mut rest) = (lights::<L>(self.uniforms), self.out);
        for index in self.runs {
            let pixels = self.job.list.runs[index].pixels as usize;
            let (here, others) = rest.split_at_mut(pixels);
            rest = others;
            shade_run(
                self.job,
                index,
                here,
                |t| (self.along)(index, t),
                |line, first, end| {
                    let span = integer::Span::new(first, end);
                    M::shade::<H, L>(self.job.parameters, span, line, &lights);
                },
            );
        }
    }
}

/// Shades the pieces of a span that a run shows, and copies its pixels. `at` returns what `draw` starts from, at a parameter of the
/// span: at the first pixel of a piece and at the pixel after its last.
pub(crate) fn shade_run<T: Copy>(
    job: &Pixels<'_>,
    index: usize,
    out: &mut [[f32; 3]],
    at: impl Fn(f32) -> T,
    mut draw: impl FnMut(&mut [Rgb888], T, T),
) {
    let (run, place) = (&job.list.runs[index], job.list.places[index]);
    let (all, mut done) = (place.pixels as usize, 0);
    // The pixel of the span that the run begins with.
    let before = (run.x - place.start) as usize;
    debug_assert!(before + out.len() <= all, "a run is a piece of its span");
    // No pixel lies beyond the ends of its span, but for rounding.
    let at = |pixel: usize| {
        let steps = pixel as f32 - before as f32;
        at((place.t0 + steps * place.dt).clamp(0.0, 1.0))
    };
    while done < out.len() {
        let pixel = before + done;
        let first = pixel / MOST * MOST;
        let count = (all - first).min(MOST);
        let mut line = [Rgb888::default(); MOST];
        let line = &mut line[..count];
        // The loop wants what is at the pixel after the last, which lies beyond the end of the span: so the last pixel stands alone.
        let inner = match first + count < all {
            true => count,
            false => count - 1,
        };
        let end = at(first + inner);
        let (inner, last) = line.split_at_mut(inner);
        // In a loop, so that what it calls is compiled once.
        for (pixels, from) in [(inner, at(first)), (last, end)] {
            if !pixels.is_empty() {
                draw(pixels, from, end);
            }
        }
        let shown = &line[pixel - first..];
        for (to, Rgb888(levels)) in out[done..].iter_mut().zip(shown) {
            *to = levels.map(|level| f32::from(level) / 255.0);
        }
        done += shown.len();
    }
}

/// The form of a loop, for its errors.
#[derive(Clone, Copy)]
pub(crate) enum Form {
    /// 1/|N| is of the table alone.
    Table,
    /// 1/|N| is refined by a step of Newton's.
    Refined,
    /// Cosines are parabolas.
    Parabola,
    /// Cosines are sines, by a recurrence.
    Waves,
}

/// Bounds the error of a form on a material, where normals turn by `angle` along a span.
pub(crate) fn error(lighting: &Lighting, angle: f64, form: Form) -> Approximation {
    let largest = |channels: [f32; 3]| f64::from(channels.into_iter().fold(0.0, f32::max));
    let levels: f64 = (lighting.lights.iter())
        .map(|light| {
            let bound = ErrorBound {
                diffuse: largest(light.diffuse),
                highlight: largest(light.specular),
                shininess: lighting.shininess as u32,
                angle,
                pixels: MOST,
                is_refined: !matches!(form, Form::Table),
                is_parabola: matches!(form, Form::Parabola),
                is_halfway: lighting.specular == SpecularModel::Blinn,
                is_slerp: matches!(form, Form::Waves),
            };
            bound.levels::<Rgb888>()
        })
        .sum();
    Approximation {
        // Without a light there is a table all the same.
        colour: levels.max(1.0) / 255.0,
        moves_gate: true,
        ..Approximation::NONE
    }
}

/// Bounds the error of a form on a polygon.
pub(crate) fn approximation(frame: &Frame, polygon: &Polygon, form: Form) -> Approximation {
    let cosine = Extent::of(frame, polygon).cosine.min(1.0);
    let least = match form {
        Form::Waves => LEAST_COSINE_OF_WAVES,
        _ => LEAST_COSINE,
    };
    if cosine < least {
        // The formats are not made for such normals: a channel may be anything.
        return Approximation {
            colour: 1.0,
            ..Approximation::NONE
        };
    }
    let lighting = &frame.lightings()[polygon.material as usize];
    error(lighting, 2.0 * libm::acos(cosine), form)
}

/// Some additions, multiplications, reads of tables and comparisons.
const fn work(additions: u32, multiplications: u32, lookups: u32, comparisons: u32) -> Counts {
    Counts {
        additions,
        multiplications,
        lookups,
        comparisons,
        divisions: 0,
        roots: 0,
        trigonometric: 0,
        powers: 0,
    }
}

/// Adds up work, each so many times.
pub(crate) fn sum<const N: usize>(all: [(u32, Counts); N]) -> Counts {
    all.into_iter()
        .fold(Counts::default(), |sum, (times, one)| Counts {
            additions: sum.additions + times * one.additions,
            multiplications: sum.multiplications + times * one.multiplications,
            lookups: sum.lookups + times * one.lookups,
            comparisons: sum.comparisons + times * one.comparisons,
            divisions: sum.divisions + times * one.divisions,
            ..Counts::default()
        })
}

// The parts of the loops in `src/integer/`, by the names that they have there; shifts and masks are not counted.
pub(crate) const ADDITION: Counts = work(1, 0, 0, 0);
pub(crate) const DOT: Counts = work(2, 3, 0, 0);
pub(crate) const ROOT: Counts = work(1, 0, 1, 0);
pub(crate) const NEWTON: Counts = work(6, 3, 0, 1);
pub(crate) const UNIT_COSINE: Counts = work(0, 1, 0, 0);
/// R·V from the unit cosines.
pub(crate) const REFLECTION: Counts = work(1, 1, 0, 0);
pub(crate) const RECIPROCAL: Counts = work(0, 0, 1, 0);
/// `Ramp::between`.
pub(crate) const RAMP: Counts = work(2, 1, 0, 0);
/// `Quadratic::polynomial`, and `Quadratic::through`.
pub(crate) const POLYNOMIAL: Counts = work(1, 3, 0, 0);
pub(crate) const THROUGH: Counts = work(5, 6, 0, 4);
/// Clamps.
pub(crate) const CLAMP: Counts = work(0, 0, 0, 1);
/// A division.
pub(crate) const DIVISION: Counts = Counts {
    divisions: 1,
    ..work(0, 0, 0, 0)
};

/// The colour of a pixel: two entries of tables a light, sums that are clamped; cosines too where they are `clamped`.
pub(crate) fn colour(lights: u32, clamped: bool) -> Counts {
    let further = work(3, 0, 0, 0);
    let cosine = work(0, 0, 0, if clamped { 1 } else { 0 });
    sum([
        (lights, work(3, 0, 2, 0)),
        (lights - 1, further),
        (lights, cosine),
    ])
}

/// Returns the operations of a method with a highlight by R·V: those of the engine on vertices and edges, and those of the method on a
/// span, which `of` states for up to `most` lights as the loops stand. The colour is the
/// kernel's.
pub(crate) fn counted<M: Method>(
    bench: &SpanBench,
    variant: &Variant,
    kernel: PixelKernel,
    most: usize,
    of: impl Fn(u32) -> [Counts; 3],
) -> CountedSpan {
    if bench.is_local() {
        // Frames with lights at positions are refused.
        return CountedSpan {
            operations: OperationCounts::default(),
            colour: [0.0; 3],
        };
    }
    let edges = count::<M>(bench, variant).operations;
    let mut uniforms = bench.uniforms(variant, 1.0);
    uniforms.lights.truncate(most);
    let [span, walk, shade] = of(uniforms.lights.len().max(1) as u32);
    let mut list = RunList::new(3);
    let ends = bench.ends_of_span(M::NEEDS.great_circles(), |normal| {
        let mut varying = [0.0; 3];
        let job = Vertices {
            uniforms: &uniforms,
            normals: &[normal],
            points: &[[0.0; 3]],
            attributes: &[],
        };
        (variant.row().kernels(1, false).vertices)(&job, &mut varying);
        varying
    });
    let run = Run {
        uniforms: UniformsIndex(0),
        polygon: 0,
        x: 0,
        pixels: 1,
    };
    let [t0, dt] = SpanBench::SPAN;
    let place = SpanPlace {
        y: 0,
        t0,
        dt,
        start: 0,
        pixels: SpanBench::PIXELS,
    };
    list.add(M::NEEDS, run, [&ends[0], &ends[1]], place);
    let job = Pixels {
        parameters: variant.parameters(),
        uniforms: core::slice::from_ref(&uniforms),
        extras: Extras::default(),
        constants: &PolygonConstants {
            kinds: Vec::new(),
            values: SpanBench::FACE.to_vec(),
        },
        list: &list,
    };
    let mut colours = [[0.0; 3]];
    kernel(&job, &mut colours);
    CountedSpan {
        operations: OperationCounts {
            span,
            walk,
            shade,
            ..edges
        },
        colour: colours[0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_that_are_no_numbers_are_zero() {
        for v in [[f32::NAN, 0.0, 1.0], [f32::INFINITY, 0.0, 0.0]] {
            assert_eq!(vector(vec3(v)), Vector::default());
        }
    }
}
