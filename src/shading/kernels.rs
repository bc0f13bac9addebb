//! Kernels: a method as a table of plain functions, with the loops over its vertices, runs and pixels in them. Engines call these and
//! are not compiled for each method.

#![cfg_attr(not(feature = "simd"), allow(dead_code))] // without it there is no row engine

use super::increments::{GreatCircle, Linear, Walk};
use super::lighting::{Lit, Uniforms};
use super::planes::{Planes, count, each, scaled};
use super::varying::Varying;
use super::{LitAt, Pixel, Shader, Stepped};
#[cfg(feature = "simd")]
use super::{Variant, lighting::LightUniforms};
#[cfg(feature = "simd")]
use crate::number::simd::{Block, Token, deinterleaved, vectorize};
use crate::number::{BLOCK, Level, Num, Vec3, vec3};
#[cfg(feature = "simd")]
use fearless_simd::*;

/// The state that a span of a method starts from.
pub type Span<S, F> = <<S as Shader>::Varying<F> as Varying<F>>::Span;

/// The number of some uniforms in the list of a method on a frame. It is not the number of a material: under local lights each polygon
/// may have uniforms of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UniformsIndex(pub u32);

/// A run of pixels of one polygon on one scanline. Its start values stand in a list beside it, `start_len` numbers per run.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The uniforms that it is shaded with.
    pub uniforms: UniformsIndex,
    /// The column of its first pixel.
    pub x: u32,
    /// The number of its pixels.
    pub pixels: u32,
}

/// The varyings that kernels add to those of a method, in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Extras {
    /// The position of the point, where lights are seen from each pixel.
    pub point: bool,
    /// The weight of perspective, 1/w, where varyings must be divided by it.
    pub weight: bool,
}

impl Extras {
    /// Returns the number of their values.
    pub fn count(self) -> usize {
        3 * usize::from(self.point) + usize::from(self.weight)
    }

    /// Returns position and weight from their numbers; a missing one is `none`.
    #[inline(always)]
    fn of<F: Num>(self, none: F, number: impl Fn(usize) -> F) -> (Vec3<F>, F) {
        let (mut point, mut weight) = (vec3([none; 3]), none);
        if self.point {
            point = vec3([number(0), number(1), number(2)]);
        }
        if self.weight {
            weight = number(self.count() - 1);
        }
        (point, weight)
    }

    /// Divides the varyings of a pixel and its position by the weight of perspective, if there is one.
    #[inline(always)]
    pub(super) fn divided<F: Num, P: Planes<F>>(
        self,
        pixel: P,
        (mut point, weight): (Vec3<F>, F),
    ) -> (P, Vec3<F>) {
        if !self.weight {
            return (pixel, point);
        }
        let w = weight.like(1.0) / weight;
        if self.point {
            point = point * w;
        }
        (scaled(pixel, w), point)
    }
}

/// Returns the number of values that a run starts from: its `varyings` at the first pixel, then their steps; or for great circles
/// both unit normals, t and Δt at the first pixel, and the polygon's normal.
pub(crate) const fn start_len(great_circle: bool, varyings: usize) -> usize {
    if great_circle { 11 } else { 2 * varyings }
}

/// The vertices whose varyings are computed together: they have the same uniforms. SIMD kernels take whole blocks of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertices<'a> {
    pub parameters: &'a [u32],
    pub uniforms: &'a Uniforms,
    pub normals: &'a [[f32; 3]],
    /// Positions, one a normal; any vectors if nothing is lit from a position.
    pub points: &'a [[f32; 3]],
}

/// Runs of pixels that are shaded, or walked along, together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixels<'a> {
    pub parameters: &'a [u32],
    /// The uniforms, indexed by [`Run::uniforms`].
    pub uniforms: &'a [Uniforms],
    pub extras: Extras,
    /// The runs, whose pixels stand one after the other.
    pub runs: &'a [Run],
    /// The numbers that each run starts from.
    pub starts: &'a [f32],
}

impl<'a> Pixels<'a> {
    /// Returns the number of lights.
    fn lights(&self) -> usize {
        self.uniforms.first().map_or(0, |all| all.lights.len())
    }

    /// Returns neighbouring runs of the same uniforms together, each with the `len` numbers that it starts from.
    fn by_uniforms(
        &self,
        len: usize,
    ) -> impl Iterator<Item = (&'a Uniforms, impl Iterator<Item = (&'a Run, &'a [f32])>)> {
        let (uniforms, mut starts) = (self.uniforms, self.starts);
        debug_assert_eq!(
            starts.len(),
            self.runs.len() * len,
            "each run has all numbers that it starts from"
        );
        let groups = self.runs.chunk_by(|a, b| a.uniforms == b.uniforms);
        groups.map(move |runs| {
            let (here, rest) = starts.split_at(runs.len() * len);
            starts = rest;
            let uniforms = &uniforms[runs[0].uniforms.0 as usize];
            (uniforms, runs.iter().zip(here.chunks_exact(len)))
        })
    }
}

pub(crate) type VertexKernel = fn(&Vertices<'_>, &mut [f32]);
pub(crate) type WalkKernel = fn(&Pixels<'_>, &mut [f32]);

/// A method compiled for one number of lights.
#[derive(Clone, Copy, Debug)]
pub struct Kernels {
    /// Returns the numbers of a varying and of a pixel for so many lights.
    pub(crate) counts: fn(usize) -> [usize; 2],
    pub(crate) great_circle: bool,
    /// True if pixels are the varyings themselves.
    pub(crate) linear: bool,
    pub(crate) passes_normal: bool,
    /// Computes the varyings of vertices from normals and positions.
    pub(crate) vertices: VertexKernel,
    /// Shades runs: the scalar pixel loop.
    pub(crate) pixels: fn(&Pixels<'_>, &mut [[f32; 3]]),
    /// Returns the kernels of an instruction set; `None` for scalar code.
    pub(crate) simd: fn(Level) -> Option<&'static SimdKernels>,
}

/// The kernels of a method on one instruction set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimdKernels {
    /// Computes the varyings of vertices, for methods that are lit there; others use the scalar kernel.
    pub vertices: Option<VertexKernel>,
    /// Walks along runs, for methods that remember the pixel before: writes each run plane by plane, in whole blocks.
    pub walk: Option<WalkKernel>,
    /// Shades one row of the G-buffer: pixels that were walked, or varyings.
    pub shade: fn(&ShadeRow<'_>, &[f32], &mut RowColours<'_>),
}

impl Kernels {
    /// Compiles a method.
    pub const fn of<M: Shader>() -> Kernels {
        Kernels {
            counts: |lights| {
                let varyings = count::<M::Varying<f32>>(lights);
                [varyings, count::<Pixel<M, f32>>(lights)]
            },
            great_circle: <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE,
            linear: <M::Walk<f32> as Walk<f32>>::LINEAR,
            passes_normal: M::PASSES_NORMAL,
            vertices: vertices::<M>,
            pixels: pixels::<M>,
            simd: |level| match level {
                #[cfg(all(feature = "simd", target_arch = "x86_64"))]
                Level::Avx2 => Some(const { &SimdKernels::of::<M, Avx2, Avx2>() }),
                #[cfg(all(feature = "simd", target_arch = "x86_64"))]
                Level::Avx512 => Some(const { &SimdKernels::of::<M, Avx2, Avx512>() }),
                #[cfg(all(feature = "simd", target_arch = "aarch64"))]
                Level::Neon => Some(const { &SimdKernels::of::<M, Neon, Neon>() }),
                _ => None,
            },
        }
    }
}

/// Clamps a number of a vertex to 0..=`scale` if it is a colour that is not clamped later.
#[inline(always)]
pub(super) fn clamped<M: Shader, F: Num>(value: F, scale: f32) -> F {
    match (M::INFO.lit_at, M::INFO.roundings.of) {
        (LitAt::Pixel, _) | (_, Stepped::Sums) => value,
        _ => at_most(value, scale),
    }
}

/// Returns a number clamped to 0..=`most`; NaN becomes 0.
#[inline(always)]
fn at_most<F: Num>(value: F, most: f32) -> F {
    -(-value.max(0.0)).max(-most)
}

/// Lights vertices one at a time.
fn vertices<M: Shader>(job: &Vertices<'_>, out: &mut [f32]) {
    light::<M, f32>(job, true, out, |all| vec3(all[0]), |x| [x; BLOCK]);
}

/// Lights vertices, as many at a time as a number holds: `gather` makes a vector of them, `lanes` takes a number apart. Without
/// `general`, a literal, the model is fast.
#[inline(always)]
fn light<M: Shader, F: Num>(
    job: &Vertices<'_>,
    general: bool,
    out: &mut [f32],
    gather: impl Fn(&[[f32; 3]]) -> Vec3<F>,
    lanes: impl Fn(F) -> [f32; BLOCK],
) {
    let (model, lights) = (job.uniforms.model, &job.uniforms.lights[..]);
    let method = M::new(job.parameters, &model);
    let own = count::<M::Varying<f32>>(lights.len());
    debug_assert!(
        job.normals.len().is_multiple_of(F::WIDTH),
        "vertices are lit in whole blocks"
    );
    debug_assert_eq!(
        out.len(),
        job.normals.len() * own,
        "each vertex has a place for all its numbers"
    );
    let points = job.points.chunks_exact(F::WIDTH);
    let vertices = job.normals.chunks_exact(F::WIDTH).zip(points);
    let out = out.chunks_exact_mut((F::WIDTH * own).max(1));
    for ((normals, points), out) in vertices.zip(out) {
        let n = gather(normals);
        let point = if general { gather(points) } else { n };
        let varying = method.vertex(&Lit::new(model, lights, point, general), n);
        each(
            varying,
            #[inline(always)]
            |i, number| {
                let values = lanes(clamped::<M, F>(*number, model.scale));
                for k in 0..F::WIDTH {
                    out[k * own + i] = values[k];
                }
            },
        );
    }
}

/// Starts a span from the numbers of a run, of which the steps follow `step` numbers after the first.
#[inline(always)]
fn start<M: Shader>(lights: usize, step: usize, numbers: &[f32]) -> Span<M, f32> {
    let span = Span::<M, f32>::filled(lights, 0.0);
    if <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE {
        let mut list = [0.0; 12];
        each(circle(numbers), |i, number| list[i] = *number);
        return each(span, |i, number| *number = list[i % 12]);
    }
    let own = count::<M::Varying<f32>>(lights);
    let (at, steps) = (&numbers[..own], &numbers[step..step + own]);
    each(span, |i, number| {
        *number = if i < own { at[i] } else { steps[i - own] };
    })
}

fn circle(numbers: &[f32]) -> GreatCircle<f32> {
    let three = |i: usize| vec3([numbers[i], numbers[i + 1], numbers[i + 2]]);
    GreatCircle::new(three(8), [three(0), three(3)], numbers[6], numbers[7])
}

/// Shades runs one pixel at a time: the lecture's loop.
fn pixels<M: Shader>(job: &Pixels<'_>, mut out: &mut [[f32; 3]]) {
    let numbers = count::<M::Varying<f32>>(job.lights()) + job.extras.count();
    let len = start_len(<M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE, numbers);
    for (uniforms, runs) in job.by_uniforms(len) {
        out = if uniforms.model.is_general || job.extras != Extras::default() {
            shade_runs::<M>(job, uniforms, true, runs, out)
        } else {
            shade_runs::<M>(job, uniforms, false, runs, out)
        };
    }
}

/// Shades runs of the same uniforms, and returns the pixels after them. Without `general`, a literal, there are no extras and
/// no general light.
#[inline(always)]
fn shade_runs<'a, 'b, M: Shader>(
    job: &Pixels<'_>,
    Uniforms { model, lights }: &Uniforms,
    general: bool,
    runs: impl Iterator<Item = (&'a Run, &'a [f32])>,
    mut out: &'b mut [[f32; 3]],
) -> &'b mut [[f32; 3]] {
    let (model, extras) = (*model, job.extras);
    let own = count::<M::Varying<f32>>(lights.len());
    let step = own + extras.count();
    let method = M::new(job.parameters, &model);
    let directional = Lit::new(model, lights, vec3([0.0; 3]), general);
    for (run, numbers) in runs {
        let mut walk = method.walk(&directional, start::<M>(lights.len(), step, numbers));
        let mut extra = Linear {
            at: extras.of(0.0, |i| numbers[own + i]),
            step: extras.of(0.0, |i| numbers[step + own + i]),
        };
        let (here, rest) = out.split_at_mut(run.pixels as usize);
        out = rest;
        // An iterator counts triples by a division: 3 % of Gouraud's frames.
        #[expect(clippy::needless_range_loop)]
        for x in 0..here.len() {
            let (mut pixel, mut lit) = (walk.next(), directional);
            if general {
                let point;
                (pixel, point) = extras.divided(pixel, Walk::<f32>::next(&mut extra));
                lit = Lit::new(model, lights, point, true);
            }
            here[x] = method.shade(&lit, pixel).array();
        }
    }
    out
}

/// A row of the G-buffer to be shaded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadeRow<'a> {
    pub parameters: &'a [u32],
    pub uniforms: &'a Uniforms,
    pub extras: Extras,
    /// The numbers of a pixel in the G-buffer: depth, planes, extras, and others that kernels do not read.
    pub numbers: usize,
}

/// The memory for the colours of a row, block by block.
#[derive(Debug)]
pub enum RowColours<'a> {
    /// Bytes, and the background of pixels that nothing covers.
    Bytes(&'a mut [[u8; 4]], [u8; 4]),
    /// Red, green and blue: linear, not clamped; left as they are in blocks that nothing covers.
    Linear([&'a mut [f32]; 3]),
}

#[cfg(feature = "simd")]
impl SimdKernels {
    /// Compiles a method: its pixel loop for `S`, all else for `T`, which machines with `S` have too.
    const fn of<M: Shader, T: Token, S: Token>() -> SimdKernels {
        SimdKernels {
            vertices: match M::INFO.lit_at {
                LitAt::Pixel => None,
                _ => Some(vertex_blocks::<M, T>),
            },
            walk: match <M::Walk<f32> as Walk<f32>>::REMEMBERS {
                true => Some(walk::<M, T>),
                false => None,
            },
            shade: shade::<M, S>,
        }
    }

    /// Returns the walk of a variant, if it has one. What chooses from span to span (`auto`) remembers nothing in blocks.
    pub fn walk_of(&self, variant: &Variant) -> Option<WalkKernel> {
        self.walk
            .filter(|_| !variant.info().is_auto(variant.parameters()))
    }
}

/// Lights vertices eight at a time.
#[cfg(feature = "simd")]
fn vertex_blocks<M: Shader, S: Token>(job: &Vertices<'_>, out: &mut [f32]) {
    let simd = S::get();
    vectorize(
        simd,
        #[inline(always)]
        || match job.uniforms.model.is_fast {
            true => light::<M, f32x8<S>>(job, false, out, deinterleaved(simd), |x| x.into()),
            false => light::<M, f32x8<S>>(job, true, out, deinterleaved(simd), |x| x.into()),
        },
    );
}

/// Walks along runs, a block at a time.
#[cfg(feature = "simd")]
fn walk<M: Shader, S: Token>(job: &Pixels<'_>, mut out: &mut [f32]) {
    let (simd, lights) = (S::get(), job.lights());
    let own = count::<M::Varying<f32>>(lights);
    let planes = count::<Pixel<M, f32>>(lights);
    let great_circle = <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE;
    vectorize(
        simd,
        #[inline(always)]
        move || {
            let zero = f32x8::splat(simd, 0.0);
            let counted = f32x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
            for (uniforms, runs) in job.by_uniforms(start_len(great_circle, own)) {
                let method = M::new(job.parameters, &uniforms.model);
                let lit = Lit::new(uniforms.model, &uniforms.lights, vec3([zero; 3]), true);
                for (run, numbers) in runs {
                    let length = (run.pixels as usize).next_multiple_of(BLOCK);
                    let (here, rest) = core::mem::take(&mut out).split_at_mut(planes * length);
                    out = rest;
                    let circle = match great_circle {
                        true => circle_in_blocks(numbers),
                        false => [0.0; 12 * BLOCK],
                    };
                    let span = each(
                        Span::<M, f32x8<S>>::filled(lights, zero),
                        #[inline(always)]
                        |i, block| {
                            *block = match i {
                                _ if great_circle => {
                                    f32x8::from_slice(simd, &circle[i % 12 * BLOCK..][..BLOCK])
                                }
                                _ if i < own => counted * numbers[own + i] + numbers[i],
                                _ => zero.like(numbers[i] * BLOCK as f32),
                            };
                        },
                    );
                    let mut walk = method.walk(&lit, span);
                    for x in (0..length).step_by(BLOCK) {
                        each(
                            walk.next(),
                            #[inline(always)]
                            |i, block| block.store_slice(&mut here[i * length + x..][..BLOCK]),
                        );
                    }
                }
            }
        },
    );
}

/// Starts a great circle in blocks: each pixel of the first block from the recurrence itself, one sine a run instead of one a
/// pixel; then steps a block long.
#[cfg(feature = "simd")]
#[inline(always)]
fn circle_in_blocks(numbers: &[f32]) -> [f32; 12 * BLOCK] {
    let mut circle = circle(numbers);
    let mut lanes = [0.0; 12 * BLOCK];
    for k in 0..BLOCK {
        each(circle, |i, number| lanes[i * BLOCK + k] = *number);
        circle.sines.next();
    }
    // The step of a block: eight turns of the step of a pixel, as three doublings.
    let (mut sin, mut cos) = circle.sines.step;
    for _ in 0..BLOCK.trailing_zeros() {
        (sin, cos) = (2.0 * sin * cos, cos * cos - sin * sin);
    }
    lanes[10 * BLOCK..][..BLOCK].fill(sin);
    lanes[11 * BLOCK..].fill(cos);
    lanes
}

/// Shades a row of the G-buffer. Its cells are [depth, pixel, extras], each of [`BLOCK`] values; whole [`Token::Block`]s.
#[cfg(feature = "simd")]
fn shade<M: Shader, S: Token>(job: &ShadeRow<'_>, cells: &[f32], out: &mut RowColours<'_>) {
    let lights = &job.uniforms.lights[..];
    vectorize(
        S::get(),
        #[inline(always)]
        || {
            let is_bytes = matches!(out, RowColours::Bytes(..));
            let is_fast = job.uniforms.model.is_fast && job.extras == Extras::default();
            match lights {
                _ if !(is_bytes && is_fast) => shade_blocks::<M, S>(job, lights, true, cells, out),
                // One light as a slice of length 1: its loop is unrolled.
                [one] => shade_blocks::<M, S>(job, &[*one], false, cells, out),
                all => shade_blocks::<M, S>(job, all, false, cells, out),
            }
        },
    );
}

/// Shades a row, a block at a time. Without `general`, a literal, there are no extras, and the model is fast. Cells hold pixels that
/// were walked to, or varyings, each the start of a walk of one block.
#[cfg(feature = "simd")]
#[inline(always)]
fn shade_blocks<M: Shader, S: Token>(
    job: &ShadeRow<'_>,
    lights: &[LightUniforms],
    general: bool,
    row: &[f32],
    out: &mut RowColours<'_>,
) {
    let (simd, model, extras) = (S::get(), job.uniforms.model, job.extras);
    let method = M::new(job.parameters, &model);
    let stride = BLOCK * job.numbers;
    let second = (S::Block::CELLS - 1) * stride;
    // Known when compiled, but for methods that may choose.
    let is_walked = <M::Walk<f32> as Walk<f32>>::REMEMBERS && !M::INFO.is_auto(job.parameters);
    let planes = match is_walked {
        true => count::<Pixel<M, f32>>(lights.len()),
        false => count::<M::Varying<f32>>(lights.len()),
    };
    let own = BLOCK * (1 + planes);
    let len = own + BLOCK * extras.count() * usize::from(general);
    let mut first = 0;
    for pair in row.chunks_exact(S::Block::CELLS * stride) {
        let here = first..first + S::Block::WIDTH;
        first = here.end;
        let cells = [&pair[..len], &pair[second..second + len]];
        let depth = S::Block::load(simd, cells, 0);
        if !(-depth).any_over(f32::NEG_INFINITY) {
            if let RowColours::Bytes(to, background) = out {
                to[here].fill(*background);
            }
            continue;
        }
        let mut pixel = if is_walked {
            each(
                Pixel::<M, S::Block>::filled(lights.len(), depth),
                #[inline(always)]
                |i, number| *number = S::Block::load(simd, cells, BLOCK * (1 + i)),
            )
        } else {
            let start = each(
                Span::<M, S::Block>::filled(lights.len(), depth.like(0.0)),
                #[inline(always)]
                |i, number| {
                    if i < planes {
                        *number = S::Block::load(simd, cells, BLOCK * (1 + i));
                    }
                },
            );
            let lit = Lit::new(model, lights, vec3([depth; 3]), general);
            method.walk(&lit, start).next()
        };
        let mut point = vec3([depth; 3]);
        if general {
            let extra = extras.of(
                depth,
                #[inline(always)]
                |i| S::Block::load(simd, cells, own + BLOCK * i),
            );
            (pixel, point) = extras.divided(pixel, extra);
        }
        let lit = Lit::new(model, lights, point, general);
        let mut colour = method.shade(&lit, pixel).array();
        match out {
            RowColours::Bytes(to, background) => {
                if general {
                    // What an integer does not hold is converted to the least one: clamped first.
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

/// Counts the set-up of a linearly interpolated number: its value at `t0` between `a` and `b`, and its growth in a step of `dt`.
///
/// ```text
/// ΔI = (I_2 − I_1) / (y_2 − y_1)  along edges,   ΔI = (I_2 − I_1) / (x_2 − x_1)  along scan lines      (L21 3.5, 4.1)
/// ```
#[inline(always)]
pub(crate) fn ramp<F: Num>(a: F, b: F, t0: F, dt: F) -> [F; 2] {
    let difference = b - a;
    [a + difference * t0, difference * dt] // 3.5, 4.1
}
