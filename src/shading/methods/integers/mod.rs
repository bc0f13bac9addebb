//! Methods in integers, for processors without a floating-point unit: the engines' spans, shaded by
//! the loops of [`crate::integer`].
//!
//! ```text
//! edges (f32, the span engine's) ─► normals at both ends of a span ─► 15 bits ─► a loop in integers ─► 8 bits a channel
//! ```
//!
//! A span is always shaded whole, and its visible pixels are copied, so that nothing that is fitted
//! over it depends on what hides parts of it. Spans of more than [`integer::Span::MAX`] pixels are
//! shaded in pieces.
//!
//! [`integer::ErrorBound`] derives the errors against the closed form from the formats. Colours
//! have 8 bits; their error of half a level is one that no other method has.

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
    Approximation, Constant, Corners, Extras, Fit, Info, LightAt, Method, MethodParameter, Needs,
    Normal, On, Perspective, Pixel, Roundings, RunList, Shader, Span, SpanBench, SpanPlace, Spans,
    Stepped, UniformsIndex, Value, Variant, Vertices,
};
use alloc::vec::Vec;
use fixed::types::U16F16;

/// How many pixels of a span are shaded at once.
const MOST: usize = integer::Span::MAX;
/// How many lights these methods support, but for those that support one.
pub(crate) const LIGHTS: usize = 4;
/// The least cosine of the angles between normals and their mean for which [`ErrorBound`] holds:
/// normals are up to 90° apart, and up to 60° apart for [`Form::Waves`].
const LEAST_COSINE: f64 = core::f64::consts::FRAC_1_SQRT_2;
const LEAST_COSINE_OF_WAVES: f64 = 0.866_025_403_784_438_6;

/// The roundings of the span engine's edges, as in naive Phong shading.
pub(crate) const ROUNDINGS: Roundings = Roundings::new(4.0, 0.9, Stepped::Cosines);
/// The roundings of edges along great circles, as in slerp Phong shading.
pub(crate) const CIRCLE_ROUNDINGS: Roundings = Roundings::new(28.0, 2.1, Stepped::GreatCircles);
/// The derivation of the stated approximation.
pub(crate) const DERIVATION: &str = "edges as in naive-phong; then normals, cosines and roots are rounded to 15 bits, cosines to the \
                                     entries of tables, and colours to 8 bits: the approximation contains these errors of the formats";
/// Where these methods fail.
pub(crate) const FAILS: &str =
    "where normals turn by more than 90 degrees over a polygon; lights and eye must be at infinity";

/// The parameter of methods that read 1/|N| from a table.
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

/// An integer method: its loop over a piece of a span, and what the loop costs.
pub(crate) trait Line: Sized + 'static {
    /// The description of the method.
    const INFO: Info;
    /// The method that engines see: [`Normals`] or [`Circles`].
    type Shell: Method;
    /// The most lights that it supports.
    const LIGHTS: usize = LIGHTS;
    /// Shades runs by its loop.
    const PIXELS: PixelKernel = pixels::<Self>;

    /// Returns the operations of a span's set-up, of a step and of a pixel with this many lights,
    /// as listed by hand from the loops.
    fn counts(lights: u32, parameters: &[Value]) -> [Counts; 3];
    /// Shades `line` between the normal at its first pixel and the normal at the pixel after its
    /// last.
    fn shade<H: Highlight, const L: usize>(
        parameters: &[Value],
        span: integer::Span,
        line: &mut [Rgb888],
        lights: &[Light<'_, Rgb888>; L],
    );
}

/// The method that engines see in the place of an integer method: it interpolates normals and
/// stores the ends of spans. With one light it stands for the methods as printed, which support
/// highlights by R·V only.
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
                .then_some("as printed, its highlights are by R.V, not by N.H"))
        })
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Constant<Vec3<F>> {
        Constant(span.linear().at)
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        n
    }
}

/// Like [`Normals`], with unit normals along great circles instead of lines.
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
    fn polygon<R: Real>(self, _: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, _: Span<'_, Self, F>) -> Constant<Vec3<F>> {
        Constant(vec3([lit.zero(); 3]))
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        n
    }
}

/// The reason why integer methods are scalar only.
pub(crate) const WHY: &str = "it computes in integers, one pixel at a time";
const WHY_SCALAR: Option<&'static str> = Some(WHY);

/// Returns the reason why a material is refused by integer methods that support this many lights,
/// or `None`.
pub(crate) fn refuses(
    lighting: &Lighting,
    interpolation: Interpolation,
    lights: usize,
) -> Option<&'static str> {
    let n = lighting.shininess;
    let is_whole = (1.0..=1000.0).contains(&n) && n == libm::floorf(n);
    if lighting.is_local() {
        return Some("integer methods need lights and an eye at infinity");
    }
    if interpolation == Interpolation::Perspective {
        return Some("integer methods interpolate normals on the screen, not in perspective");
    }
    if lighting.lights.len() > lights {
        return Some(match lights {
            1 => "this integer method supports one light",
            _ => "integer methods support at most four lights",
        });
    }
    if lighting.vertex_colours {
        return Some(
            "integer methods support one colour per material (`--colours off` ignores vertex colours)",
        );
    }
    if lighting.gate != SpecularGate::Gated {
        return Some("integer methods need highlights that end where L·N = 0");
    }
    if !is_whole {
        return Some("integer methods need an exponent that is a whole number from 1 to 1000");
    }
    None
}

/// Returns a vector with 15 fractional bits, rounded. Vectors that are not finite become 0: a
/// frame's builder accepts any finite normal, and interpolation between large ones may overflow.
pub(crate) fn vector(v: Vec3<f32>) -> Vector {
    Vector::from_f32(v.array()).unwrap_or_default()
}

/// Makes the tables of a material, one per light. The first one contains the ambient light.
pub(crate) fn materials(lighting: &Lighting) -> Vec<Material<Rgb888>> {
    let shininess = (lighting.shininess as u32).clamp(1, 1000);
    let colour = |c: [f32; 3]| c.map(|c| U16F16::saturating_from_num(c.max(0.0)));
    let none = [0.0; 3];
    let mut ambient = lighting.ambient;
    let lit = lighting.lights.iter().map(|l| (l.diffuse, l.specular));
    // A material without lights still has ambient light, which needs a table.
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

/// The lights of uniforms that hold integer tables.
pub(crate) struct Lights<'a> {
    all: [Light<'a, Rgb888>; LIGHTS],
    count: usize,
}

impl<'a> Lights<'a> {
    /// Makes the lights. There is at least one, because a dark material has a table, too.
    pub fn new(uniforms: &'a Uniforms) -> Lights<'a> {
        let direction = |place: Place<Vec3<f32>>| match place {
            Place::Infinite(v) | Place::Local(v) => vector(v),
        };
        let eye = direction(uniforms.model.eye);
        let light = |i: usize| {
            let toward = uniforms.lights.get(i).map(|light| direction(light.place));
            Light::new(toward.unwrap_or_default(), eye, &uniforms.materials[i])
        };
        let mut all = [light(0); LIGHTS];
        let count = uniforms.lights.len().clamp(1, LIGHTS);
        for (i, next) in all[..count].iter_mut().enumerate().skip(1) {
            *next = light(i);
        }
        Lights { all, count }
    }

    /// Returns the first `L` lights.
    #[inline(always)]
    pub fn first<const L: usize>(&self) -> &[Light<'a, Rgb888>; L] {
        debug_assert!(L <= self.count, "a loop for more lights than there are");
        self.all.first_chunk().expect("at most four lights")
    }
}

/// Shades runs by the loop `M`, between normals that are linear on the screen.
pub(crate) fn pixels<M: Line>(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
    shade(job, out, draw_line::<M>, |index, t| {
        let [a, b] = ends(job, index);
        vector(a + (b - a) * t)
    });
}

/// Shades runs by the loop `M`, between normals on great circles.
pub(crate) fn circles<M: Line>(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
    shade(job, out, draw_line::<M>, |index, t| {
        let values = &job.constants.values;
        let polygon = job.list.runs[index].polygon as usize;
        let face = vec3([0, 1, 2].map(|i| values[3 * polygon + i]));
        let circle = GreatCircle::new(face, ends(job, index), t, 0.0);
        vector(circle.normal())
    });
}

/// Returns the varyings at both ends of a run's span.
pub(crate) fn ends(job: &Pixels<'_>, index: usize) -> [Vec3<f32>; 2] {
    let values = job.list.starts.of(index);
    let [x, y, z] = [0, 1, 2].map(|i| values.of(i));
    [0, 1].map(|end| vec3([x[end], y[end], z[end]]))
}

/// A loop that is compiled for a kind of highlight and a count of lights: shades at most [`MOST`]
/// pixels of a span. The first argument holds the method's parameters.
type DrawLine = fn(&[Value], integer::Span, &mut [Rgb888], &Lights<'_>);

/// Returns the loop `M` for a material.
fn draw_line<M: Line>(uniforms: &Uniforms) -> DrawLine {
    let lights = uniforms.lights.len();
    match uniforms.model.specular {
        _ if is_dull(uniforms) => by_lights::<M, NoHighlight>(lights),
        SpecularModel::Phong => by_lights::<M, Reflection>(lights),
        SpecularModel::Blinn => by_lights::<M, Halfway>(lights),
    }
}

/// Returns the loop `M` for this many lights, or for one if it supports no more.
fn by_lights<M: Line, H: Highlight>(lights: usize) -> DrawLine {
    // A constant condition: the compiler leaves the other loops out.
    if const { M::LIGHTS == 1 } {
        return line::<M, H, 1>;
    }
    match lights {
        0 | 1 => line::<M, H, 1>,
        2 => line::<M, H, 2>,
        3 => line::<M, H, 3>,
        _ => line::<M, H, 4>,
    }
}

/// Shades a line: see [`DrawLine`].
fn line<M: Line, H: Highlight, const L: usize>(
    parameters: &[Value],
    span: integer::Span,
    line: &mut [Rgb888],
    lights: &Lights<'_>,
) {
    // So that the compiler leaves out what cuts longer lines.
    assert!(line.len() <= MOST, "a piece of a span");
    M::shade::<H, L>(parameters, span, line, lights.first());
}

/// True if a material has no highlights.
pub(crate) fn is_dull(uniforms: &Uniforms) -> bool {
    (uniforms.lights.iter()).all(|light| light.specular.array() == [0.0; 3])
}

/// Shades runs by the loop that `draw_line` returns for their uniforms. `along` returns the normal
/// of a run's span, by the run's index and a parameter.
fn shade(
    job: &Pixels<'_>,
    out: &mut [[f32; 3]],
    draw_line: fn(&Uniforms) -> DrawLine,
    along: impl Fn(usize, f32) -> Vector,
) {
    let mut index = 0;
    for runs in (job.list.runs).chunk_by(|a, b| a.uniforms == b.uniforms) {
        let uniforms = &job.uniforms[runs[0].uniforms.0 as usize];
        let (draw, lights) = (draw_line(uniforms), Lights::new(uniforms));
        for run in runs {
            let at = |t| along(index, t);
            shade_run(job, index, run.of(out), at, |line, first, end| {
                let span = integer::Span::new(first, end);
                draw(job.parameters, span, line, &lights);
            });
            index += 1;
        }
    }
}

/// Shades the pieces of a span that a run shows, and copies the run's pixels.
///
/// `draw` shades a piece between two values of `at`: the one at its first pixel and the one at the
/// pixel after its last. `at` takes a parameter of the span, 0 to 1.
pub(crate) fn shade_run<T: Copy>(
    job: &Pixels<'_>,
    index: usize,
    out: &mut [[f32; 3]],
    at: impl Fn(f32) -> T,
    mut draw: impl FnMut(&mut [Rgb888], T, T),
) {
    let (run, place) = (&job.list.runs[index], job.list.places[index]);
    let (all, mut done) = (place.pixels as usize, 0);
    // The index of the run's first pixel in its span.
    let before = (run.x - place.start) as usize;
    debug_assert!(before + out.len() <= all, "a run is a piece of its span");
    // Pixels lie between the ends of their span, except for rounding.
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
        // The loop needs the value at the pixel after the last. After the span's last pixel there
        // is none, so this pixel is a piece of its own, whose both values are its own.
        let inner = if first + count < all {
            count
        } else {
            count - 1
        };
        let end = at(first + inner);
        let (inner, last) = line.split_at_mut(inner);
        // A loop, so that the code of `draw` is compiled once.
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

/// The form of a loop, which decides its errors.
#[derive(Clone, Copy)]
pub(crate) enum Form {
    /// 1/|N| comes from the table only.
    Table,
    /// 1/|N| from the table is refined by one of Newton's steps.
    Refined,
    /// Cosines are parabolas along the span.
    Parabola,
    /// Cosines are sines along the span, by a recurrence.
    Waves,
}

/// Returns a bound of a form's error on a material, where normals turn by `angle` along a span, in
/// radians.
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
        // At least one level: the table of ambient light is rounded even without a light.
        colour: levels.max(1.0) / 255.0,
        moves_gate: true,
        ..Approximation::NONE
    }
}

/// Returns a bound of a form's error on a polygon.
pub(crate) fn approximation(frame: &Frame, polygon: &Polygon, form: Form) -> Approximation {
    let cosine = Extent::of(frame, polygon).cosine.min(1.0);
    let least = match form {
        Form::Waves => LEAST_COSINE_OF_WAVES,
        _ => LEAST_COSINE,
    };
    if cosine < least {
        // The formats are not made for these normals: a channel may have any value.
        return Approximation {
            colour: 1.0,
            ..Approximation::NONE
        };
    }
    let lighting = &frame.lightings()[polygon.material as usize];
    error(lighting, 2.0 * libm::acos(cosine), form)
}

/// Returns counts of additions, multiplications, reads of tables and comparisons.
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

/// Adds up counts, each multiplied by the count before it.
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

// The parts of the loops in `src/integer/`, with their names there. Shifts and masks are not
// counted.
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
/// A clamp.
pub(crate) const CLAMP: Counts = work(0, 0, 0, 1);
/// A division.
pub(crate) const DIVISION: Counts = Counts {
    divisions: 1,
    ..work(0, 0, 0, 0)
};

/// Returns the operations of a pixel's colour: per light two entries of tables and clamped sums,
/// and clamped cosines if `clamped`.
pub(crate) fn colour(lights: u32, clamped: bool) -> Counts {
    let further = work(3, 0, 0, 0);
    let cosine = work(0, 0, 0, if clamped { 1 } else { 0 });
    sum([
        (lights, work(3, 0, 2, 0)),
        (lights - 1, further),
        (lights, cosine),
    ])
}

/// Returns the operations of a method with a highlight by R·V. Those of the engine on vertices and
/// edges are counted; those of the method on a span come from `of`, which lists them for up to
/// `most` lights. The colour is the kernel's.
pub(crate) fn counted<M: Method>(
    bench: &SpanBench,
    variant: &Variant,
    kernel: PixelKernel,
    most: usize,
    of: impl Fn(u32) -> [Counts; 3],
) -> CountedSpan {
    if bench.is_local() {
        // Lights at positions are refused, so nothing is drawn.
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
        to: 0,
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
