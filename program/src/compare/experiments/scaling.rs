//! How the time of a frame grows with the triangles of a sphere and with the pixels of its picture.
//!
//! [`Scaling::measure`] draws and times spheres of more and more triangles, and one sphere on more
//! and more pixels.

use super::{Canvas, ExperimentError, chosen, clock, prepared_sphere, sphere};
use crate::compare::comparison::BASELINE;
use crate::compare::timing::{Candidate, Noise, TimeLimits, Timing, time_interleaved};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::time::Duration;
use fastphong::frame::{Frame, PreparedScene};
use fastphong::raster::{Renderer, coverage};
use fastphong::shading::Variant;
use serde::Serialize;

/// The methods that are drawn: the cheapest one, the one that the lecture starts from, and the
/// fastest with the same picture.
const METHODS: [&str; 3] = ["gouraud", BASELINE, "phong-rsqrt"];

/// The meshes and pictures to draw, and the time to spend.
#[derive(Clone, Debug)]
pub struct ScalingOptions {
    /// The approximate numbers of triangles of the meshes.
    pub triangles: Vec<usize>,
    /// The size of the picture for all meshes.
    pub at: [u32; 2],
    /// The sizes of pictures for one mesh.
    pub sizes: Vec<[u32; 2]>,
    /// The approximate number of triangles of that mesh.
    pub of: usize,
    /// The largest mesh to draw in the lecture's span engine, which is slow.
    pub lecture_up_to: usize,
    /// The time limits of each point.
    pub limits: TimeLimits,
}

impl Default for ScalingOptions {
    /// Returns options with a thousand to four million triangles, 160 × 120 to 3840 × 2160 pixels,
    /// and a quarter of a second per point, but at least three rounds.
    fn default() -> Self {
        ScalingOptions {
            triangles: [1_000, 4_000, 16_000, 64_000, 256_000, 1_000_000, 4_000_000].into(),
            at: [1920, 1080],
            sizes: [
                [160, 120],
                [320, 240],
                [640, 480],
                [1280, 720],
                [1920, 1080],
                [3840, 2160],
            ]
            .into(),
            of: 4_000,
            lecture_up_to: 64_000,
            limits: TimeLimits {
                time_budget: Duration::from_millis(250),
                rounds: usize::MAX,
                warm_up_rounds: 1,
            },
        }
    }
}

/// A frame that was timed: the counts that cost time, and the time of projecting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScalingPoint {
    /// The number of triangles asked for.
    pub asked: usize,
    /// The width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Triangles of the frame: those that face the eye.
    pub drawn: usize,
    /// Pixels that triangles cover, including hidden ones.
    pub pixels: usize,
    /// How far to trust the times.
    pub noise: Noise,
    /// The times of projecting only.
    pub projection: Timing,
}

/// The times of one method by one renderer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// The method.
    pub method: String,
    /// `span` or `row`.
    pub engine: &'static str,
    /// The instruction set.
    pub level: &'static str,
    /// The times of whole frames, one for each point; `None` for points that were left out.
    pub times: Vec<Option<Timing>>,
}

/// The result of the experiment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scaling {
    /// The name of the meshes, with `N` for the number of triangles.
    pub mesh: String,
    /// The size of the picture while the number of triangles varies.
    pub at: [u32; 2],
    /// The number of triangles asked for while the number of pixels varies.
    pub of: usize,
    /// The frames that were drawn.
    pub points: Vec<ScalingPoint>,
    /// The methods; the last one is naive Phong in the lecture's span engine.
    pub curves: Vec<Curve>,
}

/// The method and renderer of a curve, and the largest mesh that they draw, in triangles.
type Way = (Variant, Renderer, usize);

impl Scaling {
    /// Draws and times the methods of [`METHODS`] that are among `variants`, and always naive
    /// Phong, by [`Renderer::fastest`] on the current pool of threads. Naive Phong is also drawn in
    /// the lecture's span engine. Calls `progress` with the part that is done, 0..=1, and the name
    /// of the next step, never while a time is measured.
    ///
    /// # Errors
    /// If there is no such mesh or picture.
    pub fn measure(
        variants: &[Variant],
        options: &ScalingOptions,
        progress: &mut dyn FnMut(f32, &str),
    ) -> Result<Scaling, ExperimentError> {
        let fastest = |variant| (variant, Renderer::fastest(), usize::MAX);
        let lecture = |variant| (variant, Renderer::LECTURE, options.lecture_up_to);
        let mut ways: Vec<Way> = Vec::new();
        ways.extend(chosen(&METHODS, variants).into_iter().map(fastest));
        ways.extend(chosen(&[BASELINE], &[]).into_iter().map(lecture));
        let mut measured = Scaling {
            mesh: format!("builtin:{}", sphere("N")),
            at: options.at,
            of: options.of,
            points: Vec::new(),
            curves: Vec::new(),
        };
        let mut meshes = options.triangles.clone();
        meshes.push(options.of);
        meshes.sort_unstable();
        meshes.dedup();
        // The relative time for each mesh: the time limit decides for small meshes, the number of
        // rounds for large ones.
        let weight = |triangles: usize| 200_000.0 + triangles as f32;
        let all: f32 = meshes.iter().map(|n| weight(*n)).sum();
        let mut done = 0.0;
        for triangles in meshes {
            progress(done / all, &format!("{triangles} triangles"));
            let mut scene = prepared_sphere(triangles, options.at)?;
            for size in options.sizes_of(triangles) {
                measured.add(&mut scene, triangles, size, &ways, options.limits)?;
            }
            done += weight(triangles);
        }
        progress(1.0, "done");
        Ok(measured)
    }

    /// Draws and times a mesh in one size, and adds the point.
    fn add(
        &mut self,
        scene: &mut PreparedScene,
        asked: usize,
        size: [u32; 2],
        ways: &[Way],
        limits: TimeLimits,
    ) -> Result<(), ExperimentError> {
        scene.set_size(size[0], size[1]);
        let canvas = Canvas::new(scene)?;
        let mut candidates: Vec<Candidate<'_>> = Vec::from([canvas.draws(scene, None)]);
        for (variant, renderer, most) in ways {
            if asked <= *most {
                candidates.push(canvas.draws(scene, Some((variant, *renderer))));
            }
        }
        let ratios: Vec<(usize, usize)> = (1..candidates.len()).map(|i| (0, i)).collect();
        let times = time_interleaved(clock(), &mut candidates, &ratios, limits, |_| ());
        let mut timings = times.timings();
        drop(candidates);
        let (frame, _) = &*canvas.0.borrow();
        if self.curves.is_empty() {
            self.curves = ways.iter().map(|way| Curve::new(way, frame)).collect();
        }
        let mut pixels = 0;
        coverage(frame, |_, _, span| pixels += span.len());
        self.points.push(ScalingPoint {
            asked,
            size,
            vertices: frame.vertices().len(),
            triangles: frame.stats().polygons,
            drawn: frame.polygons().len(),
            pixels,
            noise: times.noise(&ratios),
            projection: timings.next().expect("a timing a candidate"),
        });
        for (curve, (.., most)) in self.curves.iter_mut().zip(ways) {
            let is_drawn = asked <= *most;
            curve.times.push(is_drawn.then(|| timings.next()).flatten());
        }
        Ok(())
    }
}

impl Curve {
    fn new((variant, renderer, _): &Way, frame: &Frame) -> Curve {
        let planned = variant.plan(frame, *renderer).renderer();
        let renderer = planned.unwrap_or(*renderer);
        Curve {
            method: variant.to_string(),
            engine: renderer.engine().name(),
            level: renderer.level().name(),
            times: Vec::new(),
        }
    }
}

impl ScalingOptions {
    /// Returns the sizes in which to draw a mesh of this many triangles.
    fn sizes_of(&self, triangles: usize) -> Vec<[u32; 2]> {
        let mut sizes = Vec::from([self.at]);
        if triangles == self.of {
            sizes.extend(self.sizes.iter().filter(|size| **size != self.at));
        }
        sizes
    }
}
