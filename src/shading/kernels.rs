//! Methods as tables of plain functions, with the loops over pixels in them: engines are compiled once and call these.

use super::increments::{GreatCircle, Walk};
use super::lighting::{Lit, Uniforms};
use super::planes::{Planes, get_each, put_each};
use super::varying::Varying;
use super::{LitAt, Pixel, Shader, Stepped};
#[cfg(feature = "simd")]
use crate::number::Vec3;
#[cfg(feature = "simd")]
use crate::number::simd::{BLOCK, Block, Token, vectorize};
use crate::number::{Level, Num, vec3};
#[cfg(feature = "simd")]
use fearless_simd::{SimdBase, f32x8};

/// What a span of a method starts from.
pub type Span<S, F> = <<S as Shader>::Varying<F> as Varying<F>>::Span;

/// A run of pixels of one polygon on one scanline. What it starts from stands in a list of its own, `start_len` numbers a run.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The uniforms that it is shaded with.
    pub uniforms: u32,
    /// The column of its first pixel.
    pub x: u32,
    /// How many pixels it has.
    pub pixels: u32,
}

/// What the house interpolates beside a method's varyings, in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Extras {
    /// The position of the point, where lights are seen from each pixel.
    pub point: bool,
    /// The weight of perspective, 1/w, where varyings must be divided by it.
    pub weight: bool,
}

impl Extras {
    /// Returns how many numbers they have.
    pub fn count(self) -> usize {
        3 * usize::from(self.point) + usize::from(self.weight)
    }
}

/// Numbers that a run starts from: its `varyings` at the first pixel, then their steps; or for great circles both unit normals,
/// t and Δt at the first pixel, and the polygon's normal.
pub(crate) const fn start_len(great_circle: bool, varyings: usize) -> usize {
    if great_circle {
        GREAT_CIRCLE
    } else {
        2 * varyings
    }
}

const GREAT_CIRCLE: usize = 11;

/// The vertices whose varyings are computed together: they have the same material.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertices<'a> {
    pub parameters: &'a [u32],
    pub uniforms: &'a Uniforms,
    pub normals: &'a [[f32; 3]],
    /// Positions, if anything is lit from a position.
    pub points: &'a [[f32; 3]],
    /// Numbers from the varyings of a vertex to those of the next.
    pub stride: usize,
}

/// Runs of pixels that are shaded, or walked along, together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pixels<'a> {
    pub parameters: &'a [u32],
    /// By the number in [`Run::uniforms`].
    pub uniforms: &'a [Uniforms],
    pub extras: Extras,
    /// Runs, whose pixels stand one after the other.
    pub runs: &'a [Run],
    /// What each run starts from.
    pub starts: &'a [f32],
}

type VertexKernel = fn(&Vertices<'_>, &mut [f32]);

/// A method compiled for one number of lights.
#[derive(Clone, Copy)]
pub struct Kernels {
    /// Numbers of a varying and of a pixel, where there are so many lights.
    pub(crate) counts: fn(usize) -> [usize; 2],
    pub(crate) great_circle: bool,
    /// True if pixels are the varyings themselves.
    pub(crate) linear: bool,
    pub(crate) passes_normal: bool,
    /// Varyings of vertices from their normals and positions, `stride` numbers apart.
    pub(crate) vertices: VertexKernel,
    /// The scalar pixel loop.
    pub(crate) pixels: fn(&Pixels<'_>, &mut [[f32; 3]]),
    /// Those of each instruction set, in the order of [`Level::ALL`](crate::number::Level::ALL) from the second on.
    pub(crate) simd: [Option<SimdKernels>; 3],
}

/// The kernels of a method on one instruction set.
#[derive(Clone, Copy)]
#[cfg_attr(not(feature = "simd"), allow(dead_code))] // only the row engine reads it
pub(crate) struct SimdKernels {
    /// Varyings of vertices, for methods that are lit there: else the scalar kernel.
    pub vertices: Option<VertexKernel>,
    /// What walks give to the pixels of runs, for methods whose varyings are not that: for each run plane by plane, whole blocks.
    pub walk: Option<fn(&Pixels<'_>, &mut [f32])>,
    /// One row of the G-buffer to colours.
    pub shade: fn(&ShadeRow<'_>, &[f32], &mut RowColours<'_>),
}

impl Kernels {
    /// Returns the kernels of an instruction set; `None` for scalar code.
    pub(crate) fn on(&self, level: Level) -> Option<&SimdKernels> {
        let place = Level::ALL[1..].iter().position(|other| *other == level)?;
        self.simd[place].as_ref()
    }

    /// Compiles a method.
    pub const fn of<M: Shader>() -> Kernels {
        #[cfg(all(feature = "simd", target_arch = "x86_64"))]
        let simd = [
            Some(SimdKernels::of::<M, fearless_simd::Avx2, fearless_simd::Avx2>()),
            Some(SimdKernels::of::<
                M,
                fearless_simd::Avx2,
                fearless_simd::Avx512,
            >()),
            None,
        ];
        #[cfg(all(feature = "simd", target_arch = "aarch64"))]
        let simd = [
            None,
            None,
            Some(SimdKernels::of::<M, fearless_simd::Neon, fearless_simd::Neon>()),
        ];
        #[cfg(not(all(feature = "simd", any(target_arch = "x86_64", target_arch = "aarch64"))))]
        let simd = [None; 3];
        Kernels {
            counts: |lights| {
                [
                    <M::Varying<f32> as Planes<f32>>::count(lights),
                    <Pixel<M, f32> as Planes<f32>>::count(lights),
                ]
            },
            great_circle: <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE,
            linear: <M::Walk<f32> as Walk<f32>>::LINEAR,
            passes_normal: M::PASSES_NORMAL,
            vertices: vertices::<M>,
            pixels: pixels::<M>,
            simd,
        }
    }
}

/// Takes numbers from the front of `from`; 0 past its end.
#[inline(always)]
fn taken<P: Planes<f32>>(lights: usize, from: &[f32]) -> P {
    let mut next = 0;
    get_each(
        lights,
        #[inline(always)]
        || {
            next += 1;
            from.get(next - 1).copied().unwrap_or(0.0)
        },
    )
}

/// Clamps what vertices (or polygons) are coloured to 0..=`scale`, for methods that say so.
#[inline(always)]
pub(super) fn clamped<M: Shader, F: Num>(value: F, scale: f32) -> F {
    match (M::INFO.lit_at, M::INFO.roundings.of) {
        (LitAt::Pixel, _) | (_, Stepped::Sums) => value,
        _ => -(-value.max(0.0)).max(-scale),
    }
}

fn vertices<M: Shader>(job: &Vertices<'_>, out: &mut [f32]) {
    let Vertices {
        uniforms,
        normals,
        points,
        stride,
        ..
    } = *job;
    let model = uniforms.model;
    let method = M::new(job.parameters, &model);
    let mut points = points.iter();
    for (normal, out) in normals.iter().zip(out.chunks_mut(stride)) {
        let point = points.next().map_or(vec3([0.0; 3]), |point| vec3(*point));
        let lit = Lit::new(model, &uniforms.lights, point, true);
        let mut to = out.iter_mut();
        put_each(
            method.vertex(&lit, vec3(*normal)),
            #[inline(always)]
            |value: f32| {
                if let Some(to) = to.next() {
                    *to = clamped::<M, f32>(value, model.scale);
                }
            },
        );
    }
}

/// Starts a span from the numbers of a run.
#[inline(always)]
fn start<M: Shader>(lights: usize, varyings: usize, numbers: &[f32]) -> Span<M, f32> {
    if <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE {
        let mut list = [0.0; 12];
        put_into(circle(numbers), &mut list);
        return taken(lights, &list);
    }
    // At the first pixel, then the steps, which begin after what the house interpolates too.
    let count = <M::Varying<f32> as Planes<f32>>::count(lights);
    let (at, step) = (&numbers[..count], &numbers[varyings..varyings + count]);
    let mut next = 0;
    get_each(
        lights,
        #[inline(always)]
        || {
            next += 1;
            if next <= count {
                at[next - 1]
            } else {
                step[next - 1 - count]
            }
        },
    )
}

fn circle(numbers: &[f32]) -> GreatCircle<f32> {
    let three = |i: usize| vec3([numbers[i], numbers[i + 1], numbers[i + 2]]);
    GreatCircle::new(three(8), [three(0), three(3)], numbers[6], numbers[7])
}

#[inline(always)]
fn put_into<F: Num, P: Planes<F>>(value: P, list: &mut [F]) {
    let mut to = list.iter_mut();
    put_each(
        value,
        #[inline(always)]
        |value| {
            if let Some(to) = to.next() {
                *to = value;
            }
        },
    );
}

/// Shades runs one pixel at a time: the lecture's loop.
fn pixels<M: Shader>(job: &Pixels<'_>, mut out: &mut [[f32; 3]]) {
    let Pixels {
        uniforms,
        extras,
        runs,
        starts,
        ..
    } = *job;
    let lights = uniforms.first().map_or(0, |uniforms| uniforms.lights.len());
    let method_count = <M::Varying<f32> as Planes<f32>>::count(lights);
    let varyings = method_count + extras.count();
    let len = start_len(<M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE, varyings);
    let nowhere = vec3([0.0; 3]);
    let mut first = 0;
    while first < runs.len() {
        // Runs of the same material share what is made of it.
        let number = runs[first].uniforms;
        let same = runs[first..]
            .iter()
            .take_while(|run| run.uniforms == number)
            .count();
        let job_runs = runs[first..first + same].iter();
        let job_starts = starts[first * len..].chunks_exact(len);
        first += same;
        let uniforms = &uniforms[number as usize];
        let model = uniforms.model;
        let method = M::new(job.parameters, &model);
        if !model.is_general && extras == Extras::default() {
            let lit = Lit::new(model, &uniforms.lights, nowhere, false);
            for (run, numbers) in job_runs.zip(job_starts) {
                let mut walk = method.walk(&lit, start::<M>(lights, varyings, numbers));
                let (here, rest) = out.split_at_mut(run.pixels as usize);
                out = rest;
                for colour in here {
                    *colour = method.shade(&lit, walk.next()).array();
                }
            }
            continue;
        }
        for (run, numbers) in job_runs.zip(job_starts) {
            let (here, rest) = out.split_at_mut(run.pixels as usize);
            out = rest;
            let span = start::<M>(lights, varyings, numbers);
            let extra = |i: usize| {
                let at = method_count + i;
                [numbers[at], numbers[varyings + at]]
            };
            let mut point = [[0.0; 2]; 3];
            if extras.point {
                point = [extra(0), extra(1), extra(2)];
            }
            let mut weight = [1.0, 0.0];
            if extras.weight {
                weight = extra(extras.count() - 1);
            }
            let lit = Lit::new(model, &uniforms.lights, nowhere, true);
            let mut walk = method.walk(&lit, span);
            for colour in here {
                let mut pixel = walk.next();
                let mut at = vec3([point[0][0], point[1][0], point[2][0]]);
                if extras.weight {
                    let w = 1.0 / weight[0];
                    pixel = scaled(lights, pixel, w);
                    at = at * w;
                }
                let lit = Lit::new(model, &uniforms.lights, at, true);
                *colour = method.shade(&lit, pixel).array();
                for value in point.iter_mut().chain([&mut weight]) {
                    value[0] += value[1];
                }
            }
        }
    }
}

/// Returns a value times a factor, number by number.
#[inline(always)]
fn scaled<F: Num, P: Planes<F>>(lights: usize, value: P, factor: F) -> P {
    let mut list = [factor; MOST_DIVIDED];
    put_into(value, &mut list);
    let mut next = 0;
    get_each(
        lights,
        #[inline(always)]
        || {
            next += 1;
            list[(next - 1) % MOST_DIVIDED] * factor
        },
    )
}

/// Numbers of a pixel that is divided by its weight: at most two colours, or a normal.
const MOST_DIVIDED: usize = 8;

/// What a row of the G-buffer is shaded with.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(not(feature = "simd"), allow(dead_code))] // only the row engine reads it
pub(crate) struct ShadeRow<'a> {
    pub parameters: &'a [u32],
    pub uniforms: &'a Uniforms,
    pub extras: Extras,
    /// Numbers of a pixel in the G-buffer: depth, planes, extras, and what kernels do not read.
    pub numbers: usize,
}

/// Where the colours of a row go, a block of pixels after the other.
#[derive(Debug)]
#[cfg_attr(not(feature = "simd"), allow(dead_code))] // only the row engine reads it
pub enum RowColours<'a> {
    /// Bytes, and the background of those that nothing covers.
    Bytes(&'a mut [[u8; 4]], [u8; 4]),
    /// Red, green and blue: linear, not clamped.
    Linear([&'a mut [f32]; 3]),
}

#[cfg(feature = "simd")]
impl SimdKernels {
    /// Compiles a method for `S`; what is not a pixel loop for `T`, which machines with `S` have too.
    const fn of<M: Shader, T: Token, S: Token>() -> SimdKernels {
        SimdKernels {
            vertices: match M::INFO.lit_at {
                LitAt::Pixel => None,
                _ => Some(vertex_blocks::<M, T>),
            },
            walk: match <M::Walk<f32> as Walk<f32>>::LINEAR {
                true => None,
                false => Some(walk::<M, T>),
            },
            shade: shade::<M, S>,
        }
    }
}

/// Lights vertices eight at a time.
#[cfg(feature = "simd")]
fn vertex_blocks<M: Shader, S: Token>(job: &Vertices<'_>, out: &mut [f32]) {
    let Vertices {
        uniforms,
        normals,
        points,
        stride,
        ..
    } = *job;
    let simd = S::get();
    let model = uniforms.model;
    let method = M::new(job.parameters, &model);
    vectorize(
        simd,
        #[inline(always)]
        || {
            let mut first = 0;
            while first < normals.len() {
                let count = BLOCK.min(normals.len() - first);
                let n = transposed(simd, &normals[first..first + count]);
                let point = match points.get(first..first + count) {
                    Some(points) if !points.is_empty() => transposed(simd, points),
                    _ => n,
                };
                let varying = if model.is_fast {
                    method.vertex(&Lit::new(model, &uniforms.lights, point, false), n)
                } else {
                    method.vertex(&Lit::new(model, &uniforms.lights, point, true), n)
                };
                let out = &mut out[first * stride..];
                let mut i = 0;
                put_each(
                    varying,
                    #[inline(always)]
                    |value| {
                        let mut lanes = [0.0; BLOCK];
                        Block::store(clamped::<M, _>(value, model.scale), &mut lanes);
                        let mut k = 0;
                        while k < count {
                            out[k * stride + i] = lanes[k];
                            k += 1;
                        }
                        i += 1;
                    },
                );
                first += BLOCK;
            }
        },
    );
}

/// Returns up to eight vectors as one of blocks; the last one stands for those that are missing.
#[cfg(feature = "simd")]
#[inline(always)]
fn transposed<S: Token>(simd: S, all: &[[f32; 3]]) -> Vec3<f32x8<S>> {
    let mut lanes = [[0.0; BLOCK]; 3];
    let mut k = 0;
    while k < BLOCK {
        let [x, y, z] = all[k.min(all.len() - 1)];
        (lanes[0][k], lanes[1][k], lanes[2][k]) = (x, y, z);
        k += 1;
    }
    vec3([
        f32x8::from_slice(simd, &lanes[0]),
        f32x8::from_slice(simd, &lanes[1]),
        f32x8::from_slice(simd, &lanes[2]),
    ])
}

/// Walks along runs, a block at a time.
#[cfg(feature = "simd")]
fn walk<M: Shader, S: Token>(job: &Pixels<'_>, out: &mut [f32]) {
    let simd = S::get();
    let Pixels {
        uniforms,
        runs,
        starts,
        ..
    } = *job;
    let lights = uniforms.first().map_or(0, |uniforms| uniforms.lights.len());
    let varyings = <M::Varying<f32> as Planes<f32>>::count(lights);
    let planes = <Pixel<M, f32> as Planes<f32>>::count(lights);
    let great_circle = <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE;
    vectorize(
        simd,
        #[inline(always)]
        || {
            let mut rest = out;
            let zero = f32x8::splat(simd, 0.0);
            let counted = f32x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
            let len = start_len(great_circle, varyings);
            let mut first = 0;
            while first < runs.len() {
                // Runs of the same material share what is made of it.
                let number = runs[first].uniforms;
                let same = runs[first..]
                    .iter()
                    .take_while(|run| run.uniforms == number)
                    .count();
                let these = runs[first..first + same].iter();
                let these = these.zip(starts[first * len..].chunks_exact(len));
                first += same;
                let uniforms = &uniforms[number as usize];
                let method = M::new(job.parameters, &uniforms.model);
                let lit = Lit::new(uniforms.model, &uniforms.lights, vec3([zero; 3]), true);
                for (run, numbers) in these {
                    let length = (run.pixels as usize).next_multiple_of(BLOCK);
                    let (here, others) = core::mem::take(&mut rest).split_at_mut(planes * length);
                    rest = others;
                    let mut next = 0;
                    let span = if great_circle {
                        let mut list = [zero; 12];
                        circle_in_blocks(simd, numbers, &mut list);
                        get_each(
                            lights,
                            #[inline(always)]
                            || {
                                next += 1;
                                list[(next - 1) % 12]
                            },
                        )
                    } else {
                        let (at, step) = (&numbers[..varyings], &numbers[varyings..2 * varyings]);
                        get_each(
                            lights,
                            #[inline(always)]
                            || {
                                next += 1;
                                let i = next - 1;
                                if i < varyings {
                                    counted * step[i] + at[i]
                                } else {
                                    zero.like(step[i - varyings] * BLOCK as f32)
                                }
                            },
                        )
                    };
                    let mut walk = method.walk(&lit, span);
                    let mut x = 0;
                    while x < length {
                        let mut at = x;
                        put_each(
                            walk.next(),
                            #[inline(always)]
                            |value| {
                                Block::store(value, &mut here[at..]);
                                at += length;
                            },
                        );
                        x += BLOCK;
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
fn circle_in_blocks<S: Token>(simd: S, numbers: &[f32], list: &mut [f32x8<S>; 12]) {
    let mut circle = circle(numbers);
    let mut lanes = [[0.0; BLOCK]; 12];
    for k in 0..BLOCK {
        let mut list = [0.0; 12];
        put_into(circle, &mut list);
        for (lanes, value) in lanes.iter_mut().zip(list) {
            lanes[k] = value;
        }
        circle.sines.next();
    }
    // The step of a block: eight turns of the step of a pixel, as three doublings.
    let [mut sin, mut cos] = circle.sines.step;
    for _ in 0..BLOCK.trailing_zeros() {
        (sin, cos) = (2.0 * sin * cos, cos * cos - sin * sin);
    }
    (lanes[10], lanes[11]) = ([sin; BLOCK], [cos; BLOCK]);
    for (to, lanes) in list.iter_mut().zip(&lanes) {
        *to = f32x8::from_slice(simd, lanes);
    }
}

/// Shades a row of the G-buffer. Its cells are [depth, pixel, extras], each of [`BLOCK`] values; whole [`Token::Block`]s.
#[cfg(feature = "simd")]
fn shade<M: Shader, S: Token>(job: &ShadeRow<'_>, cells: &[f32], out: &mut RowColours<'_>) {
    let simd = S::get();
    let lights = &job.uniforms.lights[..];
    vectorize(
        simd,
        #[inline(always)]
        || match out {
            RowColours::Bytes(to, background)
                if job.uniforms.model.is_fast && job.extras == Extras::default() =>
            {
                // One light as a slice of length 1: its loop is unrolled.
                match lights {
                    [one] => shade_bytes::<M, S>(simd, job, &[*one], cells, to, *background),
                    all => shade_bytes::<M, S>(simd, job, all, cells, to, *background),
                }
            }
            _ => shade_any::<M, S>(simd, job, cells, out),
        },
    );
}

/// Loads the planes of a pixel that follow the depth.
#[cfg(feature = "simd")]
#[inline(always)]
fn load<S: Token, P: Planes<S::Block>>(simd: S, lights: usize, cells: [&[f32]; 2]) -> P {
    let mut at = 0;
    get_each(
        lights,
        #[inline(always)]
        || {
            at += BLOCK;
            S::Block::load(simd, cells, at)
        },
    )
}

/// Returns what kernels read of the one or two cells of a block: `len` values of each.
#[cfg(feature = "simd")]
#[inline(always)]
fn cells<S: Token>(cells: &[f32], stride: usize, len: usize) -> [&[f32]; 2] {
    let second = (S::Block::CELLS - 1) * stride;
    [&cells[..len], &cells[second..second + len]]
}

#[cfg(feature = "simd")]
#[inline(always)]
fn shade_bytes<M: Shader, S: Token>(
    simd: S,
    job: &ShadeRow<'_>,
    lights: &[super::lighting::Light],
    row: &[f32],
    to: &mut [[u8; 4]],
    background: [u8; 4],
) {
    let model = job.uniforms.model;
    let method = M::new(job.parameters, &model);
    let stride = BLOCK * job.numbers;
    let len = BLOCK * (1 + <Pixel<M, f32> as Planes<f32>>::count(lights.len()));
    let mut places = to.chunks_exact_mut(S::Block::WIDTH);
    for pair in row.chunks_exact(S::Block::CELLS * stride) {
        let Some(place) = places.next() else { return };
        let cells = cells::<S>(pair, stride, len);
        let depth = S::Block::load(simd, cells, 0);
        if !depth.any_drawn() {
            place.fill(background);
            continue;
        }
        let pixel = load::<S, Pixel<M, S::Block>>(simd, lights.len(), cells);
        let lit = Lit::new(model, lights, vec3([depth; 3]), false);
        let levels = method.shade(&lit, pixel).array();
        S::Block::pack(levels, depth, background, place);
    }
}

/// Any light, any extras, bytes or linear colours.
#[cfg(feature = "simd")]
#[inline(always)]
fn shade_any<M: Shader, S: Token>(
    simd: S,
    job: &ShadeRow<'_>,
    row: &[f32],
    out: &mut RowColours<'_>,
) {
    let (model, lights, extras) = (job.uniforms.model, &job.uniforms.lights[..], job.extras);
    let method = M::new(job.parameters, &model);
    let planes = <Pixel<M, f32> as Planes<f32>>::count(lights.len());
    let stride = BLOCK * job.numbers;
    let len = BLOCK * (1 + planes + extras.count());
    let mut first = 0;
    for pair in row.chunks_exact(S::Block::CELLS * stride) {
        let end = first + S::Block::WIDTH;
        let cells = cells::<S>(pair, stride, len);
        let depth = S::Block::load(simd, cells, 0);
        let is_drawn = depth.any_drawn();
        let mut colour = [depth.like(0.0); 3];
        if is_drawn {
            let mut pixel = load::<S, Pixel<M, S::Block>>(simd, lights.len(), cells);
            let extra = |i: usize| S::Block::load(simd, cells, BLOCK * (1 + planes + i));
            let mut point = vec3([depth; 3]);
            if extras.point {
                point = vec3([extra(0), extra(1), extra(2)]);
            }
            if extras.weight {
                let weight = extra(extras.count() - 1);
                let w = weight.like(1.0) / weight;
                pixel = scaled(lights.len(), pixel, w);
                point = point * w;
            }
            let lit = Lit::new(model, lights, point, true);
            colour = method.shade(&lit, pixel).array();
        }
        match out {
            RowColours::Bytes(to, background) => {
                let place = &mut to[first..end];
                if is_drawn {
                    // What an integer does not hold is converted to the least one: clamped first.
                    let bounded = [at_most(colour[0]), at_most(colour[1]), at_most(colour[2])];
                    S::Block::pack(bounded, depth, *background, place);
                } else {
                    place.fill(*background);
                }
            }
            RowColours::Linear([r, g, b]) => {
                colour[0].store(&mut r[first..end]);
                colour[1].store(&mut g[first..end]);
                colour[2].store(&mut b[first..end]);
            }
        }
        first = end;
    }
}

/// Returns a level clamped to 0..=255; NaN becomes 0.
#[cfg(feature = "simd")]
#[inline(always)]
fn at_most<F: Num>(level: F) -> F {
    -(-level.max(0.0)).max(-255.0)
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
