//! Kernels: a compiled method, as a table of plain functions that contain the loops over its
//! vertices, runs and pixels.
//!
//! Engines call these functions once per row, per batch of runs or per range of vertices, so
//! engines are compiled once and not for each method. The loops:
//!
//! | loop | function | runs |
//! |---|---|---|
//! | vertices | `light` | scalar in `vertices`, in blocks of 8 in `vertex_blocks` |
//! | pixels of a run | `RunLoop::visit` | scalar: starts a walk, then `walk.next()` and `shade` per pixel |
//! | walk along runs | `walk` | SIMD, for methods whose pixels need the pixel before: stores the pixels, `shade_blocks` shades them later |
//! | pixels of a row | `shade_blocks` | SIMD, from the G-buffer |
//!
//! The loops are generic over the method and inlined into one function per instruction set. Two
//! literals compile the pixel loops several times: without `general`, the light model is on its
//! fast path and there are no extras; without `coloured`, there are no vertex colours. [`Extras`]
//! are the varyings that kernels add: position, vertex colour and weight.
//!
//! `runs.rs` has the runs that engines hand in and the [`Span`] that walks start from;
//! `gbuffer_cell.rs` the layout of a pixel in the G-buffer; `operation_counts.rs` runs the same
//! code on values that count; `walked.rs` reports each step to traces.

#![cfg_attr(not(feature = "simd"), allow(dead_code))] // without it there is no row engine

mod bench_polygon;
pub(crate) mod gbuffer_cell;
pub(crate) mod operation_counts;
pub(crate) mod runs;
pub(crate) mod sample_span;
#[cfg(feature = "simd")]
pub(crate) mod timed_span;
#[cfg(feature = "io")]
pub(crate) mod walked;

#[cfg(feature = "simd")]
use crate::number::simd::{Block, Token, deinterleaved, vectorize};
use crate::number::{BLOCK, Num, SimdLevel, Vec3, vec3};
use crate::shading::kernels::gbuffer_cell::CellLayout;
use crate::shading::kernels::runs::{RunList, RunStart};
#[cfg(feature = "simd")]
use crate::shading::light::UniformsRef;
#[cfg(feature = "simd")]
use crate::shading::light::at_most;
use crate::shading::light::eye_frame::carried;
use crate::shading::light::{LightAt, LightModel, Uniforms};
use crate::shading::walks::values::{Values, count, each, least, scaled};
use crate::shading::walks::{Linear, Walk};
use crate::shading::{
    Carried, Carries, CarriesOf, Corners, Kinds, Method, Needs, Pixel, PolygonConstants, Run,
    Shader, Span, Value, Visit,
};
#[cfg(feature = "simd")]
use crate::shading::{ShadingRate, Varying};
#[cfg(feature = "simd")]
use fearless_simd::*;

/// The index of uniforms in the list that a method has for a frame. It is not the index of a
/// material, because under local lights each polygon may have its own uniforms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct UniformsIndex(pub u32);

/// The varyings that kernels add to a method's own, in the order of the fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Extras {
    /// True if there is the position of the point, because lights are seen from each pixel.
    pub point: bool,
    /// True if there is the vertex colour, because it multiplies the material at each pixel.
    pub albedo: bool,
    /// True if there is the weight of perspective, 1/w, because varyings or extras must be divided
    /// by it.
    pub weight: bool,
    /// True if the method's own varyings are divided by the weight too.
    pub divides: bool,
}

/// The values of the extras at a pixel. Those that [`Extras`] lacks mean nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extra<F> {
    pub point: Vec3<F>,
    pub albedo: Vec3<F>,
    pub weight: F,
}

impl Extras {
    /// Returns how many values the extras have.
    pub fn count(self) -> usize {
        3 * (usize::from(self.point) + usize::from(self.albedo)) + usize::from(self.weight)
    }

    /// Returns the extras with absent ones as literals, so that loops are compiled without them.
    #[inline(always)]
    fn known(self, general: bool, coloured: bool) -> Extras {
        debug_assert_eq!(self.albedo, coloured, "colours have their own loops");
        Extras {
            point: general && self.point,
            albedo: coloured,
            weight: general && self.weight,
            divides: general && self.divides,
        }
    }

    /// Reads the extras from `value`, which returns their values by index, in the order of the
    /// fields; a missing one becomes `none`.
    #[inline(always)]
    fn of<F: Num>(self, none: F, value: impl Fn(usize) -> F) -> Extra<F> {
        let none = Extra {
            point: vec3([none; 3]),
            albedo: vec3([none; 3]),
            weight: none,
        };
        let mut extra = none;
        if self.point {
            extra.point = vec3([value(0), value(1), value(2)]);
        }
        if self.albedo {
            let first = 3 * usize::from(self.point);
            extra.albedo = vec3([value(first), value(first + 1), value(first + 2)]);
        }
        if self.weight {
            // The weight comes last.
            extra.weight = value(self.count() - 1);
        }
        extra
    }

    /// Writes the extras of a vertex, which follow the method's own varyings.
    pub(crate) fn write(self, to: &mut [f32], point: [f32; 3], albedo: [f32; 3]) {
        let mut rest = to;
        for (_, vector) in [(self.point, point), (self.albedo, albedo)]
            .into_iter()
            .filter(|(is_there, _)| *is_there)
        {
            let (here, others) = rest.split_at_mut(3);
            here.copy_from_slice(&vector);
            rest = others;
        }
        if self.weight {
            // Engines multiply every varying by the vertex's weight, and this 1 becomes the weight.
            rest[0] = 1.0;
        }
    }

    /// Starts the walk of the extras, which follow `own` varyings of the method.
    #[inline(always)]
    pub(crate) fn start<F: Num>(
        self,
        own: usize,
        run: &RunStart<'_, F::One>,
        zero: F,
    ) -> ExtraWalk<F> {
        let at = self.of(zero, |i| run.block_ramp(own + i, zero)[0]);
        let step = self.of(zero, |i| run.block_ramp(own + i, zero)[1]);
        ExtraWalk {
            place: Linear {
                at: (at.point, at.weight),
                step: (step.point, step.weight),
            },
            albedo: Linear {
                at: at.albedo,
                step: step.albedo,
            },
            has_albedo: self.albedo,
        }
    }

    /// Divides the extras of a pixel by the weight of perspective if there is one, and the method's
    /// varyings if it asks for that.
    #[inline(always)]
    pub(crate) fn divided<F: Num, P: Values<F>>(
        self,
        pixel: P,
        mut extra: Extra<F>,
    ) -> (P, Extra<F>) {
        if !self.weight {
            return (pixel, extra);
        }
        let w = extra.weight.broadcast(1.0) / extra.weight;
        if self.point {
            extra.point = extra.point * w;
        }
        if self.albedo {
            extra.albedo = extra.albedo * w;
        }
        if self.divides {
            (scaled(pixel, w), extra)
        } else {
            (pixel, extra)
        }
    }
}

/// The walk of the extras along a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExtraWalk<F: Num> {
    place: Linear<(Vec3<F>, F)>,
    albedo: Linear<Vec3<F>>,
    has_albedo: bool,
}

impl<F: Num> ExtraWalk<F> {
    /// Returns the extras here, and steps to the next pixel or block.
    #[inline(always)]
    pub fn next(&mut self) -> Extra<F> {
        let (point, weight) = self.place.next();
        let albedo = if self.has_albedo {
            self.albedo.next()
        } else {
            self.albedo.at
        };
        Extra {
            point,
            albedo,
            weight,
        }
    }
}

/// Vertices with the same uniforms, whose varyings are computed together. SIMD kernels take whole
/// blocks of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertices<'a> {
    pub uniforms: &'a Uniforms,
    pub normals: &'a [[f32; 3]],
    /// Positions, one per normal; any vectors if nothing is lit from a position.
    pub points: &'a [[f32; 3]],
    /// Attributes, one per normal; empty if neither the method nor the material reads them.
    pub attributes: &'a [[f32; 4]],
}

/// Runs of pixels that are shaded, or walked along, by one call.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixels<'a> {
    pub parameters: &'a [Value],
    /// The uniforms, indexed by [`Run::uniforms`].
    pub uniforms: &'a [Uniforms],
    pub extras: Extras,
    pub constants: &'a PolygonConstants,
    /// The runs.
    pub list: &'a RunList,
}

impl<'a> Pixels<'a> {
    /// Returns how many lights there are.
    fn lights(&self) -> usize {
        self.uniforms.first().map_or(0, |all| all.lights.len())
    }

    /// Groups neighbouring runs with the same uniforms. Each run comes with its index.
    fn by_uniforms(
        &self,
    ) -> impl Iterator<Item = (&'a Uniforms, impl Iterator<Item = (usize, &'a Run)>)> {
        let (uniforms, runs, mut first) = (self.uniforms, &self.list.runs, 0);
        core::iter::from_fn(move || {
            let group = runs.get(first)?.uniforms;
            // A search instead of `chunk_by`, whose closure is called run by run.
            let is_other = |run: &Run| run.uniforms != group;
            let count = runs[first..].iter().position(is_other);
            let here = first..count.map_or(runs.len(), |count| first + count);
            first = here.end;
            let runs = here.clone().zip(&runs[here]);
            Some((&uniforms[group.0 as usize], runs))
        })
    }

    /// Returns the kind of a run's polygon, and what a walk along the run starts from.
    #[inline(always)]
    fn start<M: Method>(&self, index: usize, run: &Run) -> (u8, RunStart<'a, f32>) {
        let (kind, constants) = self.constants.of::<M>(self.lights(), run.polygon);
        let start = RunStart {
            values: self.list.starts.of(index),
            x: run.x,
            pixels: run.pixels,
            place: M::NEEDS.reads_span().then(|| self.list.places[index]),
            constants,
        };
        (kind, start)
    }
}

pub(crate) type VertexKernel = fn(&Vertices<'_>, &mut [f32]);
pub(crate) type PolygonKernel = fn(&[Value], &Uniforms, &Corners<'_, f32>, &mut [f32]) -> u8;
/// Shades runs: the colours of each go to its own place ([`Run::to`]).
pub(crate) type PixelKernel = fn(&Pixels<'_>, &mut [[f32; 3]]);
/// Walks along runs. Their pixels follow one another in the output.
pub(crate) type WalkKernel = fn(&Pixels<'_>, &mut [f32]);

/// A compiled method.
///
/// A method whose varyings hold values per light is compiled three times: for 1, up to 4 and up to
/// 64 lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kernels {
    /// Returns how many values a varying, a pixel and a polygon's constants take for this many
    /// lights.
    pub(crate) counts: fn(usize) -> [usize; 3],
    /// The most lights that its groups of values have room for.
    pub(crate) lights: usize,
    pub(crate) needs: Needs,
    pub(crate) carries: Carried,
    pub(crate) kinds: &'static [&'static str],
    /// True if a pixel is the interpolated varying itself.
    pub(crate) linear: bool,
    /// True if SIMD must walk along runs with these parameters: [`Shader::walks_along_runs`].
    pub(crate) walks_along_runs: fn(&[Value], &LightModel) -> bool,
    /// Computes the constants of a polygon, and returns its kind.
    pub(crate) polygon: PolygonKernel,
    /// Computes the varyings of vertices from normals and positions.
    pub(crate) vertices: VertexKernel,
    /// Shades runs: the scalar pixel loop.
    pub(crate) pixels: PixelKernel,
    /// Returns the kernels of an instruction set; `None` for scalar code.
    pub(crate) simd: fn(SimdLevel) -> Option<&'static SimdKernels>,
}

/// The kernels of a method for one instruction set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimdKernels {
    /// Computes the varyings of vertices, for methods that are lit there; for other methods engines
    /// use the scalar kernel.
    pub vertices: Option<VertexKernel>,
    /// Walks along runs and stores their pixels: for each run, all values of index 0, then all of
    /// index 1, in whole blocks. Only for methods that remember the pixel before.
    pub walk: Option<WalkKernel>,
    /// Shades one row of the G-buffer, which holds stored pixels or varyings.
    pub shade: fn(&ShadeRow<'_>, &[f32], &mut RowColours<'_>),
}

/// The only kind of a method that is compiled for SIMD.
type First<M> = <<M as Method>::Kinds as Kinds>::First;

impl Kernels {
    /// Compiles a method.
    pub const fn of<M: Method>() -> Kernels {
        Kernels {
            counts: |lights| {
                let varyings = count::<<CarriesOf<M> as Carries>::Varying<f32>>(lights);
                let pixel = count::<Pixel<First<M>, f32>>(lights);
                [varyings, pixel, M::Kinds::constants(lights)]
            },
            lights: least(&[
                <CarriesOf<M> as Carries>::Varying::<f32>::LIGHTS,
                Pixel::<First<M>, f32>::LIGHTS,
                <First<M> as Shader>::Constants::<f32>::LIGHTS,
            ]),
            needs: needs::<M>(),
            carries: <CarriesOf<M> as Carries>::FROM,
            kinds: M::Kinds::NAMES,
            linear: M::Kinds::NAMES.is_empty()
                && <<First<M> as Shader>::Walk<f32> as Walk<f32>>::LINEAR,
            walks_along_runs: |parameters, model| M::new(parameters, model).walks_along_runs(),
            polygon: polygon::<M>,
            vertices: vertices::<CarriesOf<M>>,
            pixels: pixels::<M>,
            simd: match needs::<M>().scalar_only {
                None => by_level::<First<M>>,
                Some(_) => |_| None,
            },
        }
    }
}

impl Kernels {
    /// Returns the factor of all lights where SIMD kernels write bytes. A method that does not sum
    /// lights has its colours multiplied instead.
    pub fn scale_of_bytes(&self) -> f32 {
        if self.needs.sums_lights { 255.0 } else { 1.0 }
    }

    /// Makes the kernels of a method that does not compute on a [`Num`], as those in integers.
    /// Vertices are lit as by `M`, and `pixels` shades. They are scalar only, for the reason `why`.
    pub(crate) const fn of_functions<M: Method>(pixels: PixelKernel, why: &'static str) -> Kernels {
        Kernels {
            pixels,
            needs: Needs {
                scalar_only: Some(why),
                ..M::NEEDS
            },
            simd: |_| None,
            ..Kernels::of::<M>()
        }
    }
}

/// Returns the needs of a method. Those of a method of several kinds are scalar only, as the
/// G-buffer does not store kinds, and so are those of one whose pixels lack the constants of their
/// polygon there.
const fn needs<M: Method>() -> Needs {
    let needs = M::NEEDS;
    Needs {
        // The kind that SIMD shades by decides.
        sums_lights: <First<M> as Shader>::NEEDS.sums_lights,
        scalar_only: match needs.scalar_only {
            None if !M::Kinds::NAMES.is_empty() => {
                Some("each kind of polygon has its own loop, and a block of pixels has one for all")
            }
            None if size_of::<<First<M> as Shader>::Constants<f32>>() > 0
                && !needs.reads_span() =>
            {
                Some("only methods that read their span get the constants of a polygon on SIMD")
            }
            why => why,
        },
        ..needs
    }
}

/// True if a method must walk along runs for some parameters. The parameters themselves decide when
/// a frame is drawn.
const fn may_walk_along_runs<M: Shader>() -> bool {
    M::NEEDS.reads_span() || <M::Walk<f32> as Walk<f32>>::REMEMBERS
}

/// Returns the kernels of a method on an instruction set.
#[cfg_attr(not(feature = "simd"), expect(clippy::extra_unused_type_parameters))]
fn by_level<M: Shader>(level: SimdLevel) -> Option<&'static SimdKernels> {
    match level {
        #[cfg(all(feature = "simd", target_arch = "x86_64"))]
        SimdLevel::Avx2 => Some(const { &SimdKernels::of::<M, Avx2, Avx2>() }),
        #[cfg(all(feature = "simd", target_arch = "x86_64"))]
        SimdLevel::Avx512 => Some(const { &SimdKernels::of::<M, Avx2, Avx512>() }),
        #[cfg(all(feature = "simd", target_arch = "aarch64"))]
        SimdLevel::Neon => Some(const { &SimdKernels::of::<M, Neon, Neon>() }),
        _ => None,
    }
}

/// Computes the constants of a polygon.
fn polygon<M: Method>(
    parameters: &[Value],
    uniforms: &Uniforms,
    polygon: &Corners<'_, f32>,
    to: &mut [f32],
) -> u8 {
    let lit = LightAt::new(uniforms.stored(), 0.0, true);
    let chosen = M::new(parameters, &uniforms.model).polygon(&lit, polygon);
    M::Kinds::put(chosen, |i, value| to[i] = *value)
}

/// Lights vertices one at a time.
fn vertices<C: Carries>(job: &Vertices<'_>, out: &mut [f32]) {
    light::<C, f32>(job, true, out, |all| vec3(all[0]), |x| [x; BLOCK]);
}

/// Lights `F::WIDTH` vertices at a time. `gather` packs their vectors into lanes, and `lanes`
/// unpacks a value. `general` is a literal; pass `false` only for models on the fast path.
#[inline(always)]
fn light<C: Carries, F: Num>(
    job: &Vertices<'_>,
    general: bool,
    out: &mut [f32],
    gather: impl Fn(&[[f32; 3]]) -> Vec3<F>,
    lanes: impl Fn(F) -> [f32; BLOCK],
) {
    let stored = job.uniforms.stored();
    let own = count::<C::Varying<f32>>(stored.lights.len());
    debug_assert!(
        job.normals.len().is_multiple_of(F::WIDTH),
        "vertices are lit in whole blocks"
    );
    debug_assert_eq!(
        out.len(),
        job.normals.len() * own,
        "each vertex has room for all its values"
    );
    let points = job.points.chunks_exact(F::WIDTH);
    let vertices = job.normals.chunks_exact(F::WIDTH).zip(points);
    // Without varyings `own` is 0, and chunks must not be empty.
    let out = out.chunks_exact_mut((F::WIDTH * own).max(1));
    for (block, ((normals, points), out)) in vertices.zip(out).enumerate() {
        let n = gather(normals);
        let mut lit = LightAt::new(stored, n.x, general);
        // On the fast path everything is at infinity, so nothing reads the point.
        lit = lit.at(if general { gather(points) } else { n });
        let has_albedo = general && stored.model.has_albedo;
        if has_albedo || matches!(C::FROM, Carried::Attributes) {
            let all = &job.attributes[block * F::WIDTH..][..F::WIDTH];
            let of = |i: usize| n.x.of_each(|k| n.x.one(all[k][i]));
            lit = lit.with_attributes([of(0), of(1), of(2), of(3)]);
            if has_albedo {
                lit = lit.with_albedo(vec3([of(0), of(1), of(2)]));
            }
        }
        let varying = carried::<C, F>(job.uniforms, &lit, n);
        each(
            varying,
            #[inline(always)]
            |i, value| {
                // Lanes become vertices: engines read all values of a vertex next to one another.
                let values = lanes(*value);
                for k in 0..F::WIDTH {
                    out[k * own + i] = values[k];
                }
            },
        );
    }
}

/// Shades runs one pixel at a time, with the lecture's loop.
fn pixels<M: Method>(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
    for (uniforms, runs) in job.by_uniforms() {
        if !is_general::<M>(job, uniforms) {
            shade_fast_runs::<M>(job, uniforms, runs, out);
        } else if job.extras.albedo {
            shade_coloured_runs::<M>(job, uniforms, runs, out);
        } else {
            shade_runs::<M>(job, uniforms, [true, false], runs, out);
        }
    }
}

/// True if runs have extras or general light.
#[inline(always)]
fn is_general<M: Method>(job: &Pixels<'_>, uniforms: &Uniforms) -> bool {
    M::NEEDS.general_only || uniforms.model.is_general || job.extras != Extras::default()
}

/// Shades runs without extras and general light. It is a separate function, so that its loop has
/// more registers.
#[inline(never)]
fn shade_fast_runs<'a, M: Method>(
    job: &Pixels<'_>,
    uniforms: &Uniforms,
    runs: impl Iterator<Item = (usize, &'a Run)>,
    out: &mut [[f32; 3]],
) {
    shade_runs::<M>(job, uniforms, [false, false], runs, out);
}

/// Shades runs with vertex colours. It is a separate function, so that other runs pay nothing for
/// them.
#[inline(never)]
fn shade_coloured_runs<'a, M: Method>(
    job: &Pixels<'_>,
    uniforms: &Uniforms,
    runs: impl Iterator<Item = (usize, &'a Run)>,
    out: &mut [[f32; 3]],
) {
    shade_runs::<M>(job, uniforms, [true, true], runs, out);
}

/// Shades runs with the same uniforms.
///
/// `general` and `coloured` are literals: without the first there are no extras and no general
/// light, without the second no vertex colours.
#[inline(always)]
fn shade_runs<'a, M: Method>(
    job: &Pixels<'_>,
    uniforms: &Uniforms,
    [general, coloured]: [bool; 2],
    runs: impl Iterator<Item = (usize, &'a Run)>,
    out: &mut [[f32; 3]],
) {
    let stored = uniforms.stored();
    let extras = job.extras.known(general, coloured);
    let lights = stored.lights.len();
    let own = count::<<CarriesOf<M> as Carries>::Varying<f32>>(lights);
    let method = M::new(job.parameters, &stored.model);
    let directional = LightAt::new(stored, 0.0, general);
    for (index, run) in runs {
        let (kind, start) = job.start::<M>(index, run);
        let extra = extras.start(own, &start, 0.0);
        let run = RunLoop {
            start,
            extra,
            directional,
            extras,
            here: run.of(out),
        };
        // The kind is looked up once per run, so the loop over its pixels does not branch on it.
        method.kinds().visit(kind, run);
    }
}

/// The loop over a run's pixels. `visit` is compiled for each kind of polygon.
struct RunLoop<'a> {
    start: RunStart<'a, f32>,
    extra: ExtraWalk<f32>,
    directional: LightAt<'a, f32>,
    extras: Extras,
    here: &'a mut [[f32; 3]],
}

impl<C: Carries> Visit<C> for RunLoop<'_> {
    #[inline(always)]
    fn visit<S: Shader<Carries = C>>(mut self, kind: S) {
        let lit = self.directional;
        let span = Span::of_run(lit.count(), self.start, 0.0);
        let mut walk = kind.walk(&lit, span);
        // Indexed, because an iterator would find the count of triples by a division: 3 % of
        // Gouraud's frames.
        for x in 0..self.here.len() {
            let pixel = (walk.next(), self.extra.next());
            self.here[x] = colour(kind, lit, self.extras, pixel).array();
        }
    }
}

/// Returns the colour of a pixel from the state of its walk and its extras.
#[inline(always)]
pub(crate) fn colour<M: Shader, F: Num>(
    method: M,
    lit: LightAt<'_, F>,
    extras: Extras,
    (pixel, extra): (Pixel<M, F>, Extra<F>),
) -> Vec3<F> {
    let (pixel, extra) = extras.divided(pixel, extra);
    let mut lit = lit.at_pixel(extra.point, extras.point);
    if extras.albedo {
        lit = lit.with_albedo(extra.albedo);
    }
    method.shade(&lit, pixel)
}

/// The job of shading a row of the G-buffer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadeRow<'a> {
    pub parameters: &'a [Value],
    pub uniforms: &'a Uniforms,
    pub extras: Extras,
    /// The layout of the G-buffer.
    pub cell: CellLayout,
}

/// The memory that receives the colours of a row.
#[derive(Debug)]
pub(crate) enum RowColours<'a> {
    /// Bytes, and the background for pixels that no polygon covers.
    Bytes(&'a mut [[u8; 4]], [u8; 4]),
    /// Red, green and blue: linear and not clamped. Blocks that no polygon covers keep their
    /// values.
    Linear([&'a mut [f32]; 3]),
}

#[cfg(feature = "simd")]
impl SimdKernels {
    /// Compiles a method: its pixel loop for `S`, the rest for `T`. Every machine with `S` must
    /// have `T`.
    const fn of<M: Shader, T: Token, S: Token>() -> SimdKernels {
        SimdKernels {
            vertices: match M::NEEDS.shading_rate {
                ShadingRate::Pixel => None,
                _ => Some(vertex_blocks::<M, T>),
            },
            walk: if may_walk_along_runs::<M>() {
                Some(walk::<M, T>)
            } else {
                None
            },
            shade: shade::<M, T, S>,
        }
    }
}

/// Lights vertices eight at a time.
#[cfg(feature = "simd")]
fn vertex_blocks<M: Shader, S: Token>(job: &Vertices<'_>, out: &mut [f32]) {
    let simd = S::get();
    vectorize(
        simd,
        #[inline(always)]
        || {
            if job.uniforms.model.is_fast && !M::NEEDS.general_only {
                light::<M::Carries, f32x8<S>>(job, false, out, deinterleaved(simd), |x| x.into())
            } else {
                light::<M::Carries, f32x8<S>>(job, true, out, deinterleaved(simd), |x| x.into())
            }
        },
    );
}

/// Walks along runs and stores their pixels, a block at a time.
///
/// A run takes `length` places per value, in whole blocks: what the last block holds past the run's
/// end means nothing. First come the pixel's values, then the extras, which are linear and need no
/// walk of the method.
#[cfg(feature = "simd")]
fn walk<M: Shader, S: Token>(job: &Pixels<'_>, mut out: &mut [f32]) {
    let (simd, lights) = (S::get(), job.lights());
    let own = count::<Varying<M, f32>>(lights);
    let walked = count::<Pixel<M, f32>>(lights);
    let planes = walked + job.extras.count();
    vectorize(
        simd,
        #[inline(always)]
        move || {
            let zero = f32x8::splat(simd, 0.0);
            for (uniforms, runs) in job.by_uniforms() {
                let method = M::new(job.parameters, &uniforms.model);
                let lit = LightAt::new(uniforms.stored(), zero, true);
                for (index, run) in runs {
                    let (_, start) = job.start::<M>(index, run);
                    let length = (run.pixels as usize).next_multiple_of(BLOCK);
                    let (here, rest) = core::mem::take(&mut out).split_at_mut(planes * length);
                    out = rest;
                    // One walk per run: its steps are a block long, and lane k starts at pixel k.
                    let mut walk = method.walk(&lit, Span::of_run(lights, start, zero));
                    for x in (0..length).step_by(BLOCK) {
                        each(
                            walk.next(),
                            #[inline(always)]
                            |i, block| block.store_slice(&mut here[i * length + x..][..BLOCK]),
                        );
                    }
                    for (i, plane) in (own..).zip(here[walked * length..].chunks_exact_mut(length))
                    {
                        let [mut at, step] = start.block_ramp(i, zero);
                        for block in plane.chunks_exact_mut(BLOCK) {
                            at.store_slice(block);
                            at += step;
                        }
                    }
                }
            }
        },
    );
}

/// Shades a row of the G-buffer: whole [`Token::Block`]s of its cells.
#[cfg(feature = "simd")]
fn shade<M: Shader, T: Token, S: Token>(
    job: &ShadeRow<'_>,
    cells: &[f32],
    out: &mut RowColours<'_>,
) {
    let stored = job.uniforms.stored();
    if job.extras.albedo {
        return shade_coloured::<M, T>(job, cells, out);
    }
    vectorize(
        S::get(),
        #[inline(always)]
        || {
            let is_bytes = matches!(out, RowColours::Bytes(..));
            let is_fast = job.uniforms.model.is_fast && job.extras == Extras::default();
            match stored.lights {
                _ if M::NEEDS.general_only || !(is_bytes && is_fast) => {
                    shade_blocks::<M, S>(job, stored, [true, false], cells, out)
                }
                // One light becomes a slice whose length the compiler knows, so that the loop over
                // lights is unrolled.
                [one] => {
                    let lights = &[*one];
                    let stored = UniformsRef { lights, ..stored };
                    shade_blocks::<M, S>(job, stored, [false, false], cells, out)
                }
                _ => shade_blocks::<M, S>(job, stored, [false, false], cells, out),
            }
        },
    );
}

/// Shades a row of the G-buffer with vertex colours. It is a separate function, so that other rows
/// pay nothing for them, and compiled only for `T`, so that the program stays small.
#[cfg(feature = "simd")]
#[inline(never)]
fn shade_coloured<M: Shader, T: Token>(
    job: &ShadeRow<'_>,
    cells: &[f32],
    out: &mut RowColours<'_>,
) {
    let stored = job.uniforms.stored();
    vectorize(
        T::get(),
        #[inline(always)]
        || shade_blocks::<M, T>(job, stored, [true, true], cells, out),
    );
}

/// Shades a row, a block at a time. Cells hold stored pixels of a walk, or varyings, from which
/// each block starts its own walk and takes one step.
///
/// `general` and `coloured` are literals: without the first there are no extras and the model is on
/// the fast path, without the second there are no vertex colours.
#[cfg(feature = "simd")]
#[inline(always)]
fn shade_blocks<M: Shader, S: Token>(
    job: &ShadeRow<'_>,
    stored: UniformsRef<'_>,
    [general, coloured]: [bool; 2],
    row: &[f32],
    out: &mut RowColours<'_>,
) {
    let (simd, lights) = (S::get(), stored.lights.len());
    let extras = job.extras.known(general, coloured);
    let method = M::new(job.parameters, &stored.model);
    // A constant unless the method's parameters decide, so only one of the two branches below is
    // compiled.
    let is_walked = may_walk_along_runs::<M>() && method.walks_along_runs();
    let planes = if is_walked {
        count::<Pixel<M, f32>>(lights)
    } else {
        count::<Varying<M, f32>>(lights)
    };
    // Equals the engine's layout, but with counts that are known at compile time: the offsets of
    // all loads below become constants.
    let cell = CellLayout {
        varyings: planes,
        extras: extras.count(),
        ..job.cell
    };
    debug_assert_eq!(cell, job.cell, "the engine's layout is the method's");
    let (stride, len) = (cell.stride(), BLOCK * cell.uniforms());
    // A block of 16 pixels is loaded from two neighbouring cells of 8. One of 8 has `CELLS` = 1:
    // both halves are its one cell.
    let second = (S::Block::CELLS - 1) * stride;
    let mut first = 0;
    for pair in row.chunks_exact(S::Block::CELLS * stride) {
        let here = first..first + S::Block::WIDTH;
        first = here.end;
        let cells = [&pair[..len], &pair[second..second + len]];
        let depth = S::Block::load(simd, cells, BLOCK * CellLayout::DEPTH);
        // Pixels that no polygon covers have the depth ∞. If no lane is covered, nothing is shaded.
        if !(-depth).any_over(f32::NEG_INFINITY) {
            if let RowColours::Bytes(to, background) = out {
                to[here].fill(*background);
            }
            continue;
        }
        let lit = LightAt::new(stored, depth, general);
        let pixel = if is_walked {
            each(
                Pixel::<M, S::Block>::filled(lights, depth),
                #[inline(always)]
                |i, value| *value = S::Block::load(simd, cells, BLOCK * CellLayout::varying(i)),
            )
        } else {
            let at = each(
                Varying::<M, S::Block>::filled(lights, depth),
                #[inline(always)]
                |i, value| *value = S::Block::load(simd, cells, BLOCK * CellLayout::varying(i)),
            );
            // With steps of 0 the first `next` returns the varyings themselves.
            let start = Span::of_block(lights, at, depth);
            method.walk(&lit, start).next()
        };
        let extra = extras.of(
            depth,
            #[inline(always)]
            |i| S::Block::load(simd, cells, BLOCK * cell.extra(i)),
        );
        let mut colour = colour(method, lit, extras, (pixel, extra)).array();
        match out {
            RowColours::Bytes(to, background) => {
                if !M::NEEDS.sums_lights {
                    // The lights were not multiplied: see `Kernels::scale_of_bytes`.
                    colour = colour.map(
                        #[inline(always)]
                        |channel| channel * 255.0,
                    );
                }
                if general || !M::NEEDS.sums_lights {
                    // A value that an `i32` cannot hold would be converted to the least one, so
                    // clamp first. On the fast path no sum of lights is that large.
                    let [r, g, b] = colour;
                    colour = [at_most(r, 255.0), at_most(g, 255.0), at_most(b, 255.0)];
                }
                S::Block::pack(colour, depth, *background, &mut to[here]);
            }
            RowColours::Linear([r, g, b]) => {
                colour[0].store_slice(&mut r[here.clone()]);
                colour[1].store_slice(&mut g[here.clone()]);
                colour[2].store_slice(&mut b[here]);
            }
        }
    }
}
