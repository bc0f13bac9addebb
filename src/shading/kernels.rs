//! Methods as tables of plain functions, with the loops over pixels in them: engines are compiled once and call these.

use super::increments::{GreatCircle, Linear, Walk};
#[cfg(feature = "simd")]
use super::lighting::Light;
use super::lighting::{Lit, Uniforms};
use super::planes::{Planes, get_each, put_each, scaled};
use super::varying::Varying;
use super::{LitAt, Pixel, Shader, Stepped};
#[cfg(feature = "simd")]
use crate::number::simd::{BLOCK, Block, Token, vectorize};
use crate::number::{Level, Num, Vec3, vec3};
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

    /// Returns position and weight from their numbers; those that there are not are `none`.
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

impl<'a> Pixels<'a> {
    /// Returns how many lights there are.
    fn lights(&self) -> usize {
        self.uniforms.first().map_or(0, |all| all.lights.len())
    }

    /// Returns neighbouring runs of the same uniforms together: they share what is made of them.
    fn by_uniforms(&self) -> impl Iterator<Item = &'a [Run]> {
        self.runs.chunk_by(|a, b| a.uniforms == b.uniforms)
    }
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
        let simd = {
            use fearless_simd::{Avx2, Avx512};
            let avx2 = SimdKernels::of::<M, Avx2, Avx2>();
            let avx512 = SimdKernels::of::<M, Avx2, Avx512>();
            [Some(avx2), Some(avx512), None]
        };
        #[cfg(all(feature = "simd", target_arch = "aarch64"))]
        let simd = {
            use fearless_simd::Neon;
            [None, None, Some(SimdKernels::of::<M, Neon, Neon>())]
        };
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

/// Clamps what vertices (or polygons) are coloured to 0..=`scale`, for methods that say so.
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

fn vertices<M: Shader>(job: &Vertices<'_>, out: &mut [f32]) {
    let Uniforms { model, lights } = job.uniforms;
    let method = M::new(job.parameters, model);
    let mut points = job.points.iter();
    for (normal, out) in job.normals.iter().zip(out.chunks_mut(job.stride)) {
        let point = vec3(points.next().copied().unwrap_or_default());
        let varying = method.vertex(&Lit::new(*model, lights, point, true), vec3(*normal));
        put_each(varying, |i, value| {
            out[i] = clamped::<M, f32>(value, model.scale);
        });
    }
}

/// Returns how many numbers vertices carry for a method.
#[inline(always)]
fn varyings<M: Shader>(lights: usize) -> usize {
    <M::Varying<f32> as Planes<f32>>::count(lights)
}

/// Starts a span from the numbers of a run, of which the steps follow `step` numbers after the first.
#[inline(always)]
fn start<M: Shader>(lights: usize, step: usize, numbers: &[f32]) -> Span<M, f32> {
    if <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE {
        let mut list = [0.0; 12];
        put_each(circle(numbers), |i, value| list[i] = value);
        return get_each(lights, |i| list[i % 12]);
    }
    let own = varyings::<M>(lights);
    let (at, steps) = (&numbers[..own], &numbers[step..step + own]);
    get_each(lights, |i| if i < own { at[i] } else { steps[i - own] })
}

fn circle(numbers: &[f32]) -> GreatCircle<f32> {
    let three = |i: usize| vec3([numbers[i], numbers[i + 1], numbers[i + 2]]);
    GreatCircle::new(three(8), [three(0), three(3)], numbers[6], numbers[7])
}

/// Shades runs one pixel at a time: the lecture's loop.
fn pixels<M: Shader>(job: &Pixels<'_>, mut out: &mut [[f32; 3]]) {
    let numbers = varyings::<M>(job.lights()) + job.extras.count();
    let len = start_len(<M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE, numbers);
    let mut starts = job.starts.chunks_exact(len);
    for same in job.by_uniforms() {
        let uniforms = &job.uniforms[same[0].uniforms as usize];
        let pixels = same.iter().map(|run| run.pixels as usize).sum();
        let (here, rest) = out.split_at_mut(pixels);
        out = rest;
        let runs = same.iter().zip(starts.by_ref());
        if uniforms.model.is_general || job.extras != Extras::default() {
            shade_runs::<M>(job, uniforms, true, runs, here);
        } else {
            shade_runs::<M>(job, uniforms, false, runs, here);
        }
    }
}

/// Shades runs of the same uniforms. Without `general`, a literal, there are no extras and no general light.
#[inline(always)]
fn shade_runs<'a, M: Shader>(
    job: &Pixels<'_>,
    Uniforms { model, lights }: &Uniforms,
    general: bool,
    runs: impl Iterator<Item = (&'a Run, &'a [f32])>,
    mut out: &mut [[f32; 3]],
) {
    let (model, extras) = (*model, job.extras);
    let own = varyings::<M>(lights.len());
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
        for colour in here {
            let (mut pixel, mut lit) = (walk.next(), directional);
            if general {
                let (mut point, weight) = Walk::<f32>::next(&mut extra);
                if extras.weight {
                    let w = 1.0 / weight;
                    pixel = scaled(pixel, w);
                    point = point * w;
                }
                lit = Lit::new(model, lights, point, true);
            }
            *colour = method.shade(&lit, pixel).array();
        }
    }
}

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
    let simd = S::get();
    let (model, lights) = (job.uniforms.model, &job.uniforms.lights[..]);
    let method = M::new(job.parameters, &model);
    vectorize(
        simd,
        #[inline(always)]
        || {
            let blocks = out.chunks_mut(BLOCK * job.stride);
            let mut points = job.points.chunks(BLOCK);
            for (normals, out) in job.normals.chunks(BLOCK).zip(blocks) {
                let n = transposed(simd, normals);
                let point = match points.next() {
                    Some(points) => transposed(simd, points),
                    None => n,
                };
                let varying = if model.is_fast {
                    method.vertex(&Lit::new(model, lights, point, false), n)
                } else {
                    method.vertex(&Lit::new(model, lights, point, true), n)
                };
                put_each(
                    varying,
                    #[inline(always)]
                    |i, value| {
                        let mut lanes = [0.0; BLOCK];
                        Block::store(clamped::<M, _>(value, model.scale), &mut lanes);
                        for (k, lane) in lanes[..normals.len()].iter().enumerate() {
                            out[k * job.stride + i] = *lane;
                        }
                    },
                );
            }
        },
    );
}

/// Returns up to eight vectors as one of blocks; the last one stands for those that are missing.
#[cfg(feature = "simd")]
#[inline(always)]
fn transposed<S: Token>(simd: S, all: &[[f32; 3]]) -> Vec3<f32x8<S>> {
    let (mut x, mut y, mut z) = ([0.0; BLOCK], [0.0; BLOCK], [0.0; BLOCK]);
    let mut k = 0;
    while k < BLOCK {
        [x[k], y[k], z[k]] = all[k.min(all.len() - 1)];
        k += 1;
    }
    vec3([
        f32x8::from_slice(simd, &x),
        f32x8::from_slice(simd, &y),
        f32x8::from_slice(simd, &z),
    ])
}

/// Walks along runs, a block at a time.
#[cfg(feature = "simd")]
fn walk<M: Shader, S: Token>(job: &Pixels<'_>, mut out: &mut [f32]) {
    let simd = S::get();
    let lights = job.lights();
    let own = varyings::<M>(lights);
    let planes = <Pixel<M, f32> as Planes<f32>>::count(lights);
    let great_circle = <M::Varying<f32> as Varying<f32>>::GREAT_CIRCLE;
    vectorize(
        simd,
        #[inline(always)]
        move || {
            let zero = f32x8::splat(simd, 0.0);
            let counted = f32x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
            let mut starts = job.starts.chunks_exact(start_len(great_circle, own));
            for same in job.by_uniforms() {
                let uniforms = &job.uniforms[same[0].uniforms as usize];
                let method = M::new(job.parameters, &uniforms.model);
                let lit = Lit::new(uniforms.model, &uniforms.lights, vec3([zero; 3]), true);
                for (run, numbers) in same.iter().zip(starts.by_ref()) {
                    let length = (run.pixels as usize).next_multiple_of(BLOCK);
                    let (here, rest) = core::mem::take(&mut out).split_at_mut(planes * length);
                    out = rest;
                    let span = if great_circle {
                        let list = circle_in_blocks(simd, numbers);
                        get_each(
                            lights,
                            #[inline(always)]
                            |i| list[i % 12],
                        )
                    } else {
                        get_each(
                            lights,
                            #[inline(always)]
                            |i| match i < own {
                                true => counted * numbers[own + i] + numbers[i],
                                false => zero.like(numbers[i] * BLOCK as f32),
                            },
                        )
                    };
                    let mut walk = method.walk(&lit, span);
                    for x in (0..length).step_by(BLOCK) {
                        put_each(
                            walk.next(),
                            #[inline(always)]
                            |i, value| Block::store(value, &mut here[i * length + x..]),
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
fn circle_in_blocks<S: Token>(simd: S, numbers: &[f32]) -> [f32x8<S>; 12] {
    let mut circle = circle(numbers);
    let mut lanes = [0.0; 12 * BLOCK];
    for k in 0..BLOCK {
        put_each(circle, |i, value| lanes[i * BLOCK + k] = value);
        circle.sines.next();
    }
    // The step of a block: eight turns of the step of a pixel, as three doublings.
    let (mut sin, mut cos) = circle.sines.step;
    for _ in 0..BLOCK.trailing_zeros() {
        (sin, cos) = (2.0 * sin * cos, cos * cos - sin * sin);
    }
    lanes[10 * BLOCK..][..BLOCK].fill(sin);
    lanes[11 * BLOCK..].fill(cos);
    let mut list = [f32x8::splat(simd, 0.0); 12];
    for (to, lanes) in list.iter_mut().zip(lanes.chunks_exact(BLOCK)) {
        *to = f32x8::from_slice(simd, lanes);
    }
    list
}

/// Shades a row of the G-buffer. Its cells are [depth, pixel, extras], each of [`BLOCK`] values; whole [`Token::Block`]s.
#[cfg(feature = "simd")]
fn shade<M: Shader, S: Token>(job: &ShadeRow<'_>, cells: &[f32], out: &mut RowColours<'_>) {
    let lights = &job.uniforms.lights[..];
    vectorize(
        S::get(),
        #[inline(always)]
        || match out {
            RowColours::Bytes(to, background)
                if job.uniforms.model.is_fast && job.extras == Extras::default() =>
            {
                let out = &mut RowColours::Bytes(to, *background);
                // One light as a slice of length 1: its loop is unrolled.
                match lights {
                    [one] => shade_blocks::<M, S>(job, &[*one], false, cells, out),
                    all => shade_blocks::<M, S>(job, all, false, cells, out),
                }
            }
            _ => shade_blocks::<M, S>(job, lights, true, cells, out),
        },
    );
}

/// Shades a row, a block at a time. Without `general`, a literal, there are no extras, and the model is fast.
#[cfg(feature = "simd")]
#[inline(always)]
fn shade_blocks<M: Shader, S: Token>(
    job: &ShadeRow<'_>,
    lights: &[Light],
    general: bool,
    row: &[f32],
    out: &mut RowColours<'_>,
) {
    let (simd, model, extras) = (S::get(), job.uniforms.model, job.extras);
    let method = M::new(job.parameters, &model);
    let stride = BLOCK * job.numbers;
    let second = (S::Block::CELLS - 1) * stride;
    let own = BLOCK * (1 + <Pixel<M, f32> as Planes<f32>>::count(lights.len()));
    let len = if general {
        own + BLOCK * extras.count()
    } else {
        own
    };
    let mut first = 0;
    for pair in row.chunks_exact(S::Block::CELLS * stride) {
        let here = first..first + S::Block::WIDTH;
        first = here.end;
        let cells = [&pair[..len], &pair[second..second + len]];
        let depth = S::Block::load(simd, cells, 0);
        let mut colour = [depth.like(0.0); 3];
        if depth.any_drawn() {
            let mut pixel: Pixel<M, S::Block> = get_each(
                lights.len(),
                #[inline(always)]
                |i| S::Block::load(simd, cells, BLOCK * (1 + i)),
            );
            let mut point = vec3([depth; 3]);
            if general {
                let weight;
                (point, weight) = extras.of(
                    depth,
                    #[inline(always)]
                    |i| S::Block::load(simd, cells, own + BLOCK * i),
                );
                if extras.weight {
                    let w = weight.like(1.0) / weight;
                    pixel = scaled(pixel, w);
                    point = point * w;
                }
            }
            colour = method
                .shade(&Lit::new(model, lights, point, general), pixel)
                .array();
        } else if let RowColours::Bytes(to, background) = out {
            to[here].fill(*background);
            continue;
        }
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
                colour[0].store(&mut r[here.clone()]);
                colour[1].store(&mut g[here.clone()]);
                colour[2].store(&mut b[here]);
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
