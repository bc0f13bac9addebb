//! How much faster the methods are than naive Phong: scalar and SIMD, shading only and whole
//! frames.

use super::{Canvas, ExperimentError, clock, prepared_sphere, sphere};
use crate::compare::comparison::{is_baseline, with_baseline};
use crate::compare::timing::{
    Candidate, Noise, Ratio, SpanRow, TimeLimits, Timing, time_interleaved,
};
use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use core::hint::black_box;
use core::time::Duration;
use fastphong::frame::PreparedScene;
use fastphong::number::SimdLevel;
use fastphong::picture::Picture8;
use fastphong::picture::encoding::quantise;
use fastphong::raster::Renderer;
use fastphong::shading::{SpanBench, Variant};
use serde::Serialize;

/// The angle between the normals at the ends of the span, in degrees, as on a coarse mesh.
const DEGREES: f32 = 20.0;

/// The mesh, picture and span to draw, and the time to spend.
#[derive(Clone, Debug)]
pub struct SpeedupOptions {
    /// The approximate number of triangles of the sphere.
    pub triangles: usize,
    /// The width and height of its picture in pixels.
    pub size: [u32; 2],
    /// The pixels of a span, a multiple of 16.
    pub span: usize,
    /// The time limits of the whole experiment.
    pub limits: TimeLimits,
}

impl Default for SpeedupOptions {
    /// Returns options with a sphere of 5,000 triangles on 1920 × 1080 pixels, spans of 1,024
    /// pixels, and six seconds.
    fn default() -> Self {
        SpeedupOptions {
            triangles: 5_000,
            size: [1920, 1080],
            span: 1_024,
            limits: TimeLimits {
                time_budget: Duration::from_secs(6),
                rounds: usize::MAX,
                warm_up_rounds: 2,
            },
        }
    }
}

/// The work that is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Work {
    /// A long span shaded without an engine: vertices and set-up, then every pixel.
    Kernel,
    /// A whole frame, from the prepared scene to the stored picture in RGBA8, in the memory of the
    /// previous frame: projection, culling, vertex lighting, rasterization, shading and storing, on
    /// one thread. Vertex normals are not timed.
    Frame,
}

/// One of the ways in which every method is timed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SpeedCorner {
    /// The work that is timed.
    pub work: Work,
    /// True for the lecture's way, one pixel at a time, with frames by [`Renderer::LECTURE`]. False
    /// for the fastest way on this machine, with frames by [`Renderer::fastest`].
    pub scalar: bool,
    /// The instruction set.
    pub level: &'static str,
    /// The number of lights.
    pub lights: usize,
}

/// The speed of a method in one corner.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speedup {
    /// The times of one span or frame.
    pub timing: Timing,
    /// The ratio to naive Phong in the same corner; `None` if the clock is too coarse to show any
    /// time.
    pub ratio_to_naive: Option<Ratio>,
}

/// The speeds of a method in all corners.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodSpeedups {
    /// The variant, as a user names it.
    pub method: String,
    /// The largest difference of a channel from naive Phong's, in grey levels, over the frames and
    /// spans of all corners.
    pub levels_off: u8,
    /// The speed in each corner, in the order of [`Speedups::corners`].
    pub corners: Vec<Speedup>,
}

/// The gain of fast Phong when it was invented, and today.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speedups {
    /// The mesh of the frames.
    pub mesh: String,
    /// The width and height of the pictures in pixels.
    pub size: [u32; 2],
    /// Pixels of a span.
    pub span: usize,
    /// The corners: kernels, scalar and SIMD, and frames, scalar and SIMD, with one light; then
    /// kernels with four lights. A machine without SIMD has no SIMD kernels.
    pub corners: Vec<SpeedCorner>,
    /// How far to trust the times.
    pub noise: Noise,
    /// The methods; naive Phong is among them.
    pub methods: Vec<MethodSpeedups>,
}

impl Speedups {
    /// Draws and times `variants`, and naive Phong, in one interleaved run on the current pool of
    /// threads. Calls `progress` with the part that is done, 0..=1, and the name of the next step,
    /// never while a time is measured.
    ///
    /// # Errors
    /// If there is no such mesh or picture, or a method cannot draw it.
    pub fn measure(
        variants: &[Variant],
        options: &SpeedupOptions,
        progress: &mut dyn FnMut(f32, &str),
    ) -> Result<Speedups, ExperimentError> {
        let variants = with_baseline(variants);
        progress(0.0, "pictures");
        let scene = prepared_sphere(options.triangles, options.size)?;
        let canvas = Canvas::new(&scene)?;
        let corners = corners();
        let levels_off = levels_off(&variants, &scene, &corners, options.span)?;
        let mut candidates: Vec<Candidate<'_>> = Vec::new();
        for corner in &corners {
            let level = level(corner.scalar);
            for variant in &variants {
                candidates.push(match corner.work {
                    Work::Kernel => kernel(variant, level, corner.lights, options.span),
                    Work::Frame => canvas.draws(&scene, Some((variant, Renderer::on(level)))),
                });
            }
        }
        let naive = variants.iter().position(is_baseline).unwrap_or(0);
        // The pair of naive Phong and a method in a corner.
        let pair = |method: usize, corner: usize| {
            let first = corner * variants.len();
            (first + naive, first + method)
        };
        let methods = 0..variants.len();
        let ratios = (0..corners.len()).flat_map(|at| methods.clone().map(move |i| pair(i, at)));
        let ratios: Vec<(usize, usize)> = ratios.collect();
        let times = time_interleaved(clock(), &mut candidates, &ratios, options.limits, |part| {
            progress(part, "timing")
        });
        drop(candidates);
        let speedup = |method: usize, corner: usize| {
            let (naive, candidate) = pair(method, corner);
            Speedup {
                timing: times.timing(candidate),
                ratio_to_naive: times.ratio(naive, candidate),
            }
        };
        let method = |(i, (variant, levels_off)): (usize, (&Variant, u8))| MethodSpeedups {
            method: variant.to_string(),
            levels_off,
            corners: (0..corners.len()).map(|at| speedup(i, at)).collect(),
        };
        let methods = variants.iter().zip(levels_off).enumerate();
        Ok(Speedups {
            mesh: format!("builtin:{}", sphere(options.triangles)),
            size: options.size,
            span: options.span,
            noise: times.noise(&ratios),
            methods: methods.map(method).collect(),
            corners,
        })
    }
}

/// Returns the instruction set of a corner: scalar code, or the best of this machine.
fn level(scalar: bool) -> SimdLevel {
    if scalar {
        SimdLevel::Scalar
    } else {
        SimdLevel::best()
    }
}

/// Returns all corners that this machine has.
fn corners() -> Vec<SpeedCorner> {
    let best = SimdLevel::best();
    let both = |(work, lights)| [true, false].map(|scalar| (work, lights, scalar));
    let all = [(Work::Kernel, 1), (Work::Frame, 1), (Work::Kernel, 4)].map(both);
    // Without SIMD, the best kernel is the scalar one, which is in the list already.
    let differ = all
        .into_iter()
        .flatten()
        .filter(|(work, _, scalar)| *scalar || *work == Work::Frame || best != SimdLevel::Scalar);
    let corner = |(work, lights, scalar)| SpeedCorner {
        work,
        scalar,
        level: level(scalar).name(),
        lights,
    };
    differ.map(corner).collect()
}

/// Returns a candidate that shades a span without an engine.
fn kernel(variant: &Variant, level: SimdLevel, lights: usize, length: usize) -> Candidate<'_> {
    let bench = SpanBench::new(DEGREES, lights);
    if level == SimdLevel::Scalar {
        let mut colours = vec![[0.0; 3]; length];
        return Box::new(move || variant.shade_span(black_box(&bench), black_box(&mut colours)));
    }
    let mut row = SpanRow::new(variant, &bench, length);
    Box::new(move || variant.shade_span_on(level, black_box(&bench), black_box(&mut row)))
}

/// Returns the largest difference of each variant's pictures from naive Phong's over all corners,
/// in grey levels.
fn levels_off(
    variants: &[Variant],
    scene: &PreparedScene,
    corners: &[SpeedCorner],
    span: usize,
) -> Result<Vec<u8>, ExperimentError> {
    let frame = scene.frame()?;
    let mut off = vec![0; variants.len()];
    for corner in corners {
        let drawn = |variant: &Variant| match corner.work {
            Work::Kernel => Ok(span_picture(variant, corner, span)),
            Work::Frame => variant.render_with(&frame, Renderer::on(level(corner.scalar))),
        };
        if let Some(naive) = variants.iter().find(|variant| is_baseline(variant)) {
            let naive = drawn(naive)?;
            for (off, variant) in off.iter_mut().zip(variants) {
                *off = farthest(&naive, &drawn(variant)?).max(*off);
            }
        }
    }
    Ok(off)
}

/// Draws a span as a stored picture of one row.
fn span_picture(variant: &Variant, corner: &SpeedCorner, length: usize) -> Picture8 {
    let bench = SpanBench::new(DEGREES, corner.lights);
    let mut picture = Picture8::new(length, 1, [0; 4]);
    if corner.scalar {
        let mut colours = vec![[0.0f32; 3]; length];
        variant.shade_span(&bench, &mut colours);
        for (pixel, colour) in picture.pixels_mut().iter_mut().zip(&colours) {
            let [red, green, blue] = colour.map(quantise);
            *pixel = [red, green, blue, 255];
        }
    } else {
        let mut row = SpanRow::new(variant, &bench, length);
        variant.shade_span_on(level(corner.scalar), &bench, &mut row);
        picture.pixels_mut().copy_from_slice(row.bytes());
    }
    picture
}

/// Returns the largest difference of a channel between two pictures of the same size, in grey
/// levels.
fn farthest(a: &Picture8, b: &Picture8) -> u8 {
    let [a, b] = [a, b].map(|picture| picture.pixels().as_flattened());
    let differences = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    differences.max().unwrap_or(0)
}
