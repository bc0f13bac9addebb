//! Speeds of all methods as multiples of naive Phong's: scalar and SIMD, shading alone and in a whole frame.

use super::{Canvas, ExperimentError, prepared_sphere, sphere};
use crate::compare::comparison::{is_baseline, with_baseline};
use crate::compare::timing::{Candidate, Ratio, SpanRow, TimeLimits, Timing, time_interleaved};
use crate::frame::PreparedScene;
use crate::number::Level;
use crate::picture::Picture8;
use crate::picture::encoding::quantise;
use crate::raster::Renderer;
use crate::shading::{SpanBench, Variant};
use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use core::hint::black_box;
use core::time::Duration;
use serde::Serialize;

/// The angle between the normals at the ends of the span, in degrees: that of a coarse mesh.
const DEGREES: f32 = 20.0;

/// The mesh, picture and span to draw, and the time to spend.
#[derive(Clone, Debug)]
pub struct SpeedupOptions {
    /// Triangles of the sphere, about.
    pub triangles: usize,
    /// Pixels a row of its picture, and rows.
    pub size: [u32; 2],
    /// Pixels of a span; whole groups of eight.
    pub span: usize,
    /// The time of all.
    pub limits: TimeLimits,
}

impl Default for SpeedupOptions {
    /// Returns a sphere of 5,000 triangles on 1920 × 1080 pixels, spans of 1,024, six seconds.
    fn default() -> Self {
        SpeedupOptions {
            triangles: 5_000,
            size: [1920, 1080],
            span: 1_024,
            limits: TimeLimits {
                time_budget: Duration::from_secs(6),
                rounds: 25,
                warm_up_rounds: 2,
            },
        }
    }
}

/// The work that is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Work {
    /// A long span shaded by the method alone: vertices and set-up, then every pixel.
    Kernel,
    /// A whole frame, from the prepared scene to the stored picture in RGBA8, in the memory of the frame before: projection,
    /// culling, vertex lighting, rasterization, shading and storing; on one thread; not vertex normals.
    Frame,
}

/// One of the ways in which every method is timed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SpeedCorner {
    /// The work that is timed.
    pub work: Work,
    /// True for the lecture's way: one pixel at a time, frames in [`Renderer::LECTURE`]; else the fastest of this machine,
    /// frames by [`Renderer::fastest`].
    pub scalar: bool,
    /// The instruction set.
    pub level: &'static str,
    /// Lights.
    pub lights: usize,
}

/// The speed of a method in one corner.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speedup {
    /// Times of one span or frame.
    pub timing: Timing,
    /// Against naive Phong in the same corner; `None` if a clock too coarse gave no time over 0.
    pub ratio_to_naive: Option<Ratio>,
}

/// The speeds of a method in all corners.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodSpeedups {
    /// The variant, as a user names it.
    pub method: String,
    /// The largest difference of a channel from naive Phong's in grey levels, in frames and in spans, in all corners.
    pub levels_off: u8,
    /// One a corner, in the order of [`Speedups::corners`].
    pub corners: Vec<Speedup>,
}

/// The gain of fast Phong when it was invented, and today.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Speedups {
    /// The mesh of the frames.
    pub mesh: String,
    /// Pixels a row, rows.
    pub size: [u32; 2],
    /// Pixels of a span.
    pub span: usize,
    /// Kernels scalar and SIMD, frames scalar and SIMD, with one light; then kernels with four. A machine without SIMD has no
    /// such kernels.
    pub corners: Vec<SpeedCorner>,
    /// The methods; naive Phong is among them.
    pub methods: Vec<MethodSpeedups>,
}

impl Speedups {
    /// Draws and times `variants`, and naive Phong, in one interleaved run on the current pool of threads. `progress` hears
    /// which part is done, 0..=1, and what comes next; never while a time is taken.
    ///
    /// # Errors
    /// [`ExperimentError`] if there is no such mesh or picture.
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
        let timings = time_interleaved(&mut candidates, options.limits, |part| {
            progress(part, "timing")
        });
        drop(candidates);
        let naive = variants.iter().position(is_baseline).unwrap_or(0);
        let speedup = |method: usize, corner: usize| {
            let timing = |method: usize| &timings[corner * variants.len() + method];
            let (naive, timing) = (timing(naive), timing(method));
            Speedup {
                timing: timing.clone(),
                ratio_to_naive: Ratio::paired(&naive.samples_ns, &timing.samples_ns),
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
            methods: methods.map(method).collect(),
            corners,
        })
    }
}

/// Returns the instruction set in the corners of the lecture, or in those of today.
fn level(scalar: bool) -> Level {
    if scalar { Level::Scalar } else { Level::best() }
}

/// Returns all corners that this machine has.
fn corners() -> Vec<SpeedCorner> {
    let best = Level::best();
    let both = |(work, lights)| [true, false].map(|scalar| (work, lights, scalar));
    let all = [(Work::Kernel, 1), (Work::Frame, 1), (Work::Kernel, 4)].map(both);
    // The best kernel of a machine without SIMD is the scalar one, which is there already.
    let differ = all
        .into_iter()
        .flatten()
        .filter(|(work, _, scalar)| *scalar || *work == Work::Frame || best != Level::Scalar);
    let corner = |(work, lights, scalar)| SpeedCorner {
        work,
        scalar,
        level: level(scalar).name(),
        lights,
    };
    differ.map(corner).collect()
}

/// Returns a candidate that shades a span by the method alone.
fn kernel(variant: &Variant, level: Level, lights: usize, length: usize) -> Candidate<'_> {
    let bench = SpanBench::new(DEGREES, lights);
    if level == Level::Scalar {
        let mut colours = vec![[0.0; 3]; length];
        return Box::new(move || variant.shade_span(black_box(&bench), black_box(&mut colours)));
    }
    let mut row = SpanRow::new(variant, &bench, length);
    Box::new(move || variant.shade_span_on(level, black_box(&bench), black_box(&mut row)))
}

/// Returns the largest difference of each variant's pictures from naive Phong's, in all corners.
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

/// Draws a span as it would be stored.
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

/// Returns the largest difference of a channel of two pictures of one size, in grey levels.
fn farthest(a: &Picture8, b: &Picture8) -> u8 {
    let [a, b] = [a, b].map(|picture| picture.pixels().as_flattened());
    let differences = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    differences.max().unwrap_or(0)
}
