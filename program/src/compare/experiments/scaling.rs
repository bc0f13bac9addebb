//! How the time of a frame grows with the triangles of a sphere and with the pixels of its picture.
//!
//! [`Scaling::measure`] draws and times spheres, then fits the costs of a vertex, a triangle, a
//! span and a pixel.

use super::{Canvas, ExperimentError, Observation, chosen, fit, prepared_sphere, sphere};
use crate::compare::comparison::BASELINE;
use crate::compare::timing::{Candidate, TimeLimits, Timing, time_interleaved};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::time::Duration;
use fastphong::frame::{Frame, PreparedScene};
use fastphong::raster::{Renderer, coverage};
use fastphong::scene::Projection;
use fastphong::shading::Variant;
use serde::Serialize;

/// The methods that are drawn: the cheapest one, the one that the lecture starts from, and the
/// fastest with the same picture.
const METHODS: [&str; 3] = ["gouraud", BASELINE, "phong-rsqrt"];

/// How many times smaller the sphere is in the frames that separate the cost of covered pixels from
/// the cost of the others.
const AWAY: f64 = 4.0;

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
    /// and a quarter of a second per point, but at least five rounds.
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
                rounds: 15,
                warm_up_rounds: 1,
            },
        }
    }
}

/// A frame that was timed: the counts of everything that costs time, and the time of projecting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScalingPoint {
    /// The number of triangles asked for.
    pub asked: usize,
    /// The width and height of the picture in pixels.
    pub size: [u32; 2],
    /// True if the sphere is smaller, as if it were farther away.
    pub away: bool,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Triangles of the frame: those that face the eye.
    pub drawn: usize,
    /// Spans: runs of pixels that a triangle covers on a scanline, including hidden ones.
    pub spans: usize,
    /// Pixels in spans.
    pub pixels: usize,
    /// The times of projecting only.
    pub projection: Timing,
}

/// The fitted costs, in nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Costs {
    /// The cost of a vertex of the mesh: it is projected, and its share of the triangles is culled
    /// or kept.
    pub vertex_ns: f64,
    /// The cost of a triangle of the frame: its set-up and the lighting of its vertices.
    pub triangle_ns: f64,
    /// The cost of a span.
    pub span_ns: f64,
    /// The cost of a pixel of a span.
    pub pixel_ns: f64,
    /// The cost of a pixel of the picture, covered or not: it is cleared and stored.
    pub background_ns: f64,
    /// The relative error with the largest magnitude: measured time / sum of the costs − 1.
    pub worst: f64,
    /// The index of the point with that error.
    pub worst_point: usize,
}

impl Costs {
    /// Returns the time that the costs predict for a point, in nanoseconds.
    pub fn explain(&self, point: &ScalingPoint) -> f64 {
        let costs = [
            self.triangle_ns,
            self.span_ns,
            self.pixel_ns,
            self.background_ns,
        ];
        let sum: f64 = point.counts().iter().zip(costs).map(|(n, ns)| n * ns).sum();
        sum + self.vertex_ns * point.vertices as f64
    }
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
    /// The costs that explain the times best; `None` if the points cannot tell the costs apart.
    pub costs: Option<Costs>,
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

/// The size of a picture, and true if the sphere is small in it.
type SphereView = ([u32; 2], bool);

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
            for view in options.views(triangles) {
                measured.add(&mut scene, triangles, view, &ways, options.limits)?;
            }
            done += weight(triangles);
        }
        measured.explain();
        progress(1.0, "done");
        Ok(measured)
    }

    /// Draws and times one view of a mesh, and adds the point.
    fn add(
        &mut self,
        scene: &mut PreparedScene,
        asked: usize,
        (size, away): SphereView,
        ways: &[Way],
        limits: TimeLimits,
    ) -> Result<(), ExperimentError> {
        scene.set_size(size[0], size[1]);
        let near = *scene.camera();
        let mut camera = near;
        if let (Projection::Orthographic { half_height }, true) = (&mut camera.projection, away) {
            *half_height *= AWAY;
        }
        scene.set_camera(camera);
        let canvas = Canvas::new(scene)?;
        let mut candidates: Vec<Candidate<'_>> = Vec::from([canvas.draws(scene, None)]);
        for (variant, renderer, most) in ways {
            if asked <= *most {
                candidates.push(canvas.draws(scene, Some((variant, *renderer))));
            }
        }
        let mut timings = time_interleaved(&mut candidates, limits, |_| ()).into_iter();
        drop(candidates);
        let (frame, _) = &*canvas.0.borrow();
        if self.curves.is_empty() {
            self.curves = ways.iter().map(|way| Curve::new(way, frame)).collect();
        }
        let (mut spans, mut pixels) = (0, 0);
        coverage(frame, |_, _, span| {
            spans += usize::from(!span.is_empty());
            pixels += span.len();
        });
        self.points.push(ScalingPoint {
            asked,
            size,
            away,
            vertices: frame.vertices().len(),
            triangles: frame.stats().polygons,
            drawn: frame.polygons().len(),
            spans,
            pixels,
            projection: timings.next().expect("a timing a candidate"),
        });
        for (curve, (.., most)) in self.curves.iter_mut().zip(ways) {
            let is_drawn = asked <= *most;
            curve.times.push(is_drawn.then(|| timings.next()).flatten());
        }
        scene.set_camera(near);
        Ok(())
    }

    /// Finds the costs of each curve.
    pub(super) fn explain(&mut self) {
        let vertex = vertex_cost(&self.points);
        for curve in &mut self.curves {
            curve.costs = vertex.and_then(|vertex| costs(vertex, &self.points, &curve.times));
        }
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
            costs: None,
        }
    }
}

impl ScalingOptions {
    /// Returns the views in which to draw a mesh of this many triangles.
    fn views(&self, triangles: usize) -> Vec<SphereView> {
        let mut views = Vec::from([(self.at, false)]);
        if triangles == self.of {
            let is_other = |size: &&[u32; 2]| **size != self.at;
            let others = self.sizes.iter().filter(is_other);
            views.extend(others.map(|size| (*size, false)));
            views.push((self.at, true));
            let pixels = |size: &&[u32; 2]| u64::from(size[0]) * u64::from(size[1]);
            let largest = self.sizes.iter().max_by_key(pixels).filter(is_other);
            views.extend(largest.map(|size| (*size, true)));
        }
        views
    }
}

impl ScalingPoint {
    /// Returns how often each cost occurs, without vertices: triangles, spans, pixels of spans,
    /// pixels of the picture.
    fn counts(&self) -> [f64; 4] {
        let picture = f64::from(self.size[0]) * f64::from(self.size[1]);
        let [drawn, spans, pixels] = [self.drawn, self.spans, self.pixels].map(|n| n as f64);
        [drawn, spans, pixels, picture]
    }
}

/// Fits the time of projecting a vertex. Projecting is timed separately, because spheres have
/// triangles in proportion to vertices: a fit to whole frames could not tell the two costs apart.
fn vertex_cost(points: &[ScalingPoint]) -> Option<f64> {
    let observe = |point: &ScalingPoint| Observation {
        counts: [point.vertices as f64],
        total: point.projection.min_ns,
        scale: point.projection.min_ns,
    };
    let observations: Vec<_> = points.iter().map(observe).collect();
    fit(&observations).map(|[vertex]| vertex)
}

/// Fits the costs other than `vertex_ns` to the times. Uses the least time of each point, because
/// points are not interleaved and disturbances only add time.
fn costs(vertex_ns: f64, points: &[ScalingPoint], times: &[Option<Timing>]) -> Option<Costs> {
    let timed = (0..).zip(points).zip(times);
    let timed = timed.filter_map(|((i, p), t)| Some((i, p, t.as_ref()?.min_ns)));
    let timed: Vec<(usize, &ScalingPoint, f64)> = timed.collect();
    let observe = |&(_, point, ns): &(usize, &ScalingPoint, f64)| Observation {
        counts: point.counts(),
        total: ns - point.projection.min_ns,
        scale: ns,
    };
    let observations: Vec<_> = timed.iter().map(observe).collect();
    let [triangle_ns, span_ns, pixel_ns, background_ns] = fit(&observations)?;
    let mut costs = Costs {
        vertex_ns,
        triangle_ns,
        span_ns,
        pixel_ns,
        background_ns,
        worst: 0.0,
        worst_point: 0,
    };
    let error =
        |(i, point, ns): &(usize, &ScalingPoint, f64)| (ns / costs.explain(point) - 1.0, *i);
    let errors = timed.iter().map(error);
    (costs.worst, costs.worst_point) = errors.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    Some(costs)
}
