//! How the time of a frame grows: with the triangles of a sphere, and with the pixels of its picture.

use super::{Canvas, Observation, StudyError, chosen, fit, prepared_sphere, sphere};
use crate::compare::comparison::BASELINE;
use crate::compare::timing::{Candidate, Limits, Timing, time_interleaved};
use crate::frame::PreparedScene;
use crate::raster::{Plan, Renderer, coverage};
use crate::scene::Projection;
use crate::shading::Variant;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::time::Duration;
use serde::Serialize;

/// The methods that are drawn: what the lecture starts from, what draws its picture fastest, and the floor.
const METHODS: [&str; 3] = ["gouraud", BASELINE, "phong-rsqrt"];

/// How many times as far away the sphere is in the frames that tell pixels that are covered from those that are not.
const AWAY: f64 = 4.0;

/// What is drawn, and for how long.
#[derive(Clone, Debug)]
pub struct ScalingOptions {
    /// Triangles of the meshes, about.
    pub triangles: Vec<usize>,
    /// The size of the picture in which they are drawn.
    pub at: [u32; 2],
    /// Sizes of pictures.
    pub sizes: Vec<[u32; 2]>,
    /// Triangles of the mesh that is drawn in them.
    pub of: usize,
    /// Meshes of more triangles than this are not drawn in the lecture's own form, which takes long.
    pub lecture_up_to: usize,
    /// How long each point is timed.
    pub limits: Limits,
}

impl Default for ScalingOptions {
    /// A thousand to four million triangles, 160 × 120 to 3840 × 2160 pixels, a quarter of a second a point, but five rounds
    /// in any case.
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
            limits: Limits {
                time_budget: Duration::from_millis(250),
                rounds: 15,
                warm_up_rounds: 1,
            },
        }
    }
}

/// Along what points are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The triangles of the mesh, in pictures of one size.
    Triangles,
    /// The pixels of the picture, of one mesh.
    Pixels,
}

/// What was drawn, how often each cost arises in it, and how long it takes to project it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    /// About how many triangles were asked for.
    pub asked: usize,
    /// Pixels a row, rows.
    pub size: [u32; 2],
    /// True if the sphere is farther away, so that it covers less.
    pub away: bool,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Triangles of the frame: those that are seen from their front.
    pub drawn: usize,
    /// Spans: runs of pixels that one triangle covers on one scanline, hidden ones too.
    pub spans: usize,
    /// Pixels in spans.
    pub pixels: usize,
    /// Times of projecting alone.
    pub projection: Timing,
}

impl Point {
    /// Pixels of the picture, covered or not.
    pub fn picture_pixels(&self) -> f64 {
        f64::from(self.size[0]) * f64::from(self.size[1])
    }
}

/// What one of each costs, in nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Costs {
    /// A vertex of the mesh: projected, with the triangles around it culled or kept.
    pub vertex_ns: f64,
    /// A triangle of the frame: set up, with its vertices lit.
    pub triangle_ns: f64,
    /// A span.
    pub span_ns: f64,
    /// A pixel of a span.
    pub pixel_ns: f64,
    /// A pixel of the picture, covered or not: cleared and stored.
    pub background_ns: f64,
    /// The error of the largest size: the measured time over what the costs add up to, less 1.
    pub worst: f64,
    /// The point that it is of.
    pub worst_point: usize,
}

impl Costs {
    /// What they add up to at a point, in nanoseconds.
    pub fn explain(&self, point: &Point) -> f64 {
        let [drawn, spans, pixels, picture] = counts(point);
        self.vertex_ns * point.vertices as f64
            + self.triangle_ns * drawn
            + self.span_ns * spans
            + self.pixel_ns * pixels
            + self.background_ns * picture
    }
}

/// A method, by one renderer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// The method.
    pub method: String,
    /// `span` or `row`.
    pub engine: String,
    /// The instruction set.
    pub level: String,
    /// Times of whole frames, one a point; `None` where the point was left out.
    pub times: Vec<Option<Timing>>,
    /// What explains them best; `None` if the points cannot tell costs apart.
    pub costs: Option<Costs>,
}

/// How long frames take.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scaling {
    /// The meshes, with `N` for the number of triangles.
    pub mesh: String,
    /// The size of the pictures along [`Axis::Triangles`].
    pub at: [u32; 2],
    /// The triangles asked for along [`Axis::Pixels`].
    pub of: usize,
    /// What was drawn.
    pub points: Vec<Point>,
    /// The methods; in the end naive Phong in the lecture's own form.
    pub curves: Vec<Curve>,
}

/// One way to draw, in the order of [`Scaling::curves`].
struct Way {
    variant: Variant,
    renderer: Renderer,
    /// The most triangles that it draws.
    most: usize,
}

impl Scaling {
    /// Draws and times, on the current pool of threads: Gouraud, naive Phong and fast Phong by the hardware's root, as far as
    /// they are among `variants`, by [`Renderer::fastest`]; naive Phong always, and in the lecture's own form as well.
    /// `progress` is told which part is done, 0..=1, and what comes next; never while a time is taken.
    ///
    /// # Errors
    /// [`StudyError`] if there is no such mesh or picture.
    pub fn measure(
        variants: &[Variant],
        options: &ScalingOptions,
        progress: &mut dyn FnMut(f32, &str),
    ) -> Result<Scaling, StudyError> {
        let fastest = |variant| Way {
            variant,
            renderer: Renderer::fastest(),
            most: usize::MAX,
        };
        let mut ways: Vec<Way> = chosen(&METHODS, variants)
            .into_iter()
            .map(fastest)
            .collect();
        let lecture = |variant| Way {
            variant,
            renderer: Renderer::LECTURE,
            most: options.lecture_up_to,
        };
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
        // About as long as each takes: small meshes have their limits of time, large ones their rounds.
        let weight = |triangles: usize| 200_000.0 + triangles as f32;
        let all: f32 = meshes.iter().map(|n| weight(*n)).sum();
        let mut done = 0.0;
        for triangles in meshes {
            progress(done / all, &format!("{triangles} triangles"));
            let views = views(triangles, options);
            let mut scene = prepared_sphere(triangles, options.at)?;
            for (size, away) in views {
                measured.add(&mut scene, (triangles, size, away), &ways, options.limits)?;
            }
            done += weight(triangles);
        }
        measured.explain();
        progress(1.0, "done");
        Ok(measured)
    }

    /// The numbers of the points along an axis, in the order of that.
    pub fn along(&self, axis: Axis) -> Vec<usize> {
        let is_on = |point: &Point| match axis {
            _ if point.away => false,
            Axis::Triangles => point.size == self.at,
            Axis::Pixels => point.asked == self.of,
        };
        let mut numbers: Vec<usize> = (0..self.points.len())
            .filter(|i| is_on(&self.points[*i]))
            .collect();
        numbers.sort_by_key(|i| match axis {
            Axis::Triangles => self.points[*i].triangles,
            Axis::Pixels => self.points[*i].picture_pixels() as usize,
        });
        numbers
    }

    /// Draws and times one view of one mesh.
    fn add(
        &mut self,
        scene: &mut PreparedScene,
        (asked, size, away): (usize, [u32; 2], bool),
        ways: &[Way],
        limits: Limits,
    ) -> Result<(), StudyError> {
        scene.set_size(size[0], size[1]);
        let near = *scene.camera();
        scene.set_camera(crate::scene::Camera {
            projection: seen_from(near.projection, away),
            ..near
        });
        let canvas = Canvas::new(scene)?;
        let counted = count(&canvas, (asked, size, away));
        let drawing: Vec<bool> = ways.iter().map(|way| asked <= way.most).collect();
        let mut candidates: Vec<Candidate<'_>> = Vec::from([canvas.projects(scene)]);
        for (way, _) in ways.iter().zip(&drawing).filter(|(_, drawing)| **drawing) {
            candidates.push(canvas.draws(scene, &way.variant, way.renderer));
        }
        let mut timings = time_interleaved(&mut candidates, limits, |_| ()).into_iter();
        drop(candidates);
        if self.curves.is_empty() {
            let (frame, _) = &*canvas.0.borrow();
            self.curves = ways
                .iter()
                .map(|way| way.curve(way.variant.plan(frame, way.renderer)))
                .collect();
        }
        drop(canvas);
        scene.set_camera(near);
        let projection = timings.next().expect("a timing a candidate");
        self.points.push(Point {
            projection,
            ..counted
        });
        for (curve, drawing) in self.curves.iter_mut().zip(drawing) {
            curve
                .times
                .push(if drawing { timings.next() } else { None });
        }
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

impl Way {
    fn curve(&self, plan: Plan) -> Curve {
        Curve {
            method: self.variant.to_string(),
            engine: plan.renderer.engine().name().to_string(),
            level: plan.renderer.level().name().to_string(),
            times: Vec::new(),
            costs: None,
        }
    }
}

/// The sizes in which a mesh is drawn, and whether from afar.
fn views(triangles: usize, options: &ScalingOptions) -> Vec<([u32; 2], bool)> {
    let mut views = Vec::new();
    if options.triangles.contains(&triangles) || triangles == options.of {
        views.push((options.at, false));
    }
    if triangles == options.of {
        views.extend(
            options
                .sizes
                .iter()
                .filter(|size| **size != options.at)
                .map(|size| (*size, false)),
        );
        let largest = options
            .sizes
            .iter()
            .max_by_key(|[width, height]| u64::from(*width) * u64::from(*height));
        let mut away: Vec<[u32; 2]> = Vec::from([options.at]);
        away.extend(largest.filter(|size| **size != options.at));
        views.extend(away.into_iter().map(|size| (size, true)));
    }
    views
}

/// The same projection, or one in which all is smaller.
fn seen_from(projection: Projection, away: bool) -> Projection {
    match projection {
        Projection::Orthographic { half_height } if away => Projection::Orthographic {
            half_height: AWAY * half_height,
        },
        same => same,
    }
}

/// How often each cost arises in a frame; not yet timed.
fn count(canvas: &Canvas, (asked, size, away): (usize, [u32; 2], bool)) -> Point {
    let (frame, _) = &*canvas.0.borrow();
    let (mut spans, mut pixels) = (0, 0);
    coverage(frame, |_, _, span| {
        spans += usize::from(!span.is_empty());
        pixels += span.len();
    });
    let projection = Timing::of(Vec::from([0.0]), 1).expect("one finite time");
    let (vertices, drawn) = (frame.vertices().len(), frame.polygons().len());
    Point {
        asked,
        size,
        away,
        vertices,
        triangles: frame.stats().polygons,
        drawn,
        spans,
        pixels,
        projection,
    }
}

/// How often each cost but that of vertices arises.
fn counts(point: &Point) -> [f64; 4] {
    [
        point.drawn as f64,
        point.spans as f64,
        point.pixels as f64,
        point.picture_pixels(),
    ]
}

/// What projecting takes for each vertex. In one family of meshes triangles are in proportion to vertices, so that no fit of
/// frames could tell one from the other: this is the part that is timed by itself.
fn vertex_cost(points: &[Point]) -> Option<f64> {
    let observe = |point: &Point| {
        let total = point.projection.min_ns;
        Observation {
            counts: [point.vertices as f64],
            total,
            scale: total,
        }
    };
    let observations: Vec<_> = points.iter().map(observe).collect();
    fit(&observations).map(|[vertex]| vertex)
}

/// What explains times beyond `vertex` nanoseconds for each vertex. Least times are explained: points cannot be timed in turns
/// with one another, and what disturbs a machine only adds.
fn costs(vertex: f64, points: &[Point], times: &[Option<Timing>]) -> Option<Costs> {
    let timed: Vec<(usize, &Point, f64)> = (0..)
        .zip(points)
        .zip(times)
        .filter_map(|((i, p), t)| Some((i, p, t.as_ref()?.min_ns)))
        .collect();
    let observe = |&(_, point, ns): &(usize, &Point, f64)| Observation {
        counts: counts(point),
        total: ns - point.projection.min_ns,
        scale: ns,
    };
    let observations: Vec<_> = timed.iter().map(observe).collect();
    let [triangle_ns, span_ns, pixel_ns, background_ns] = fit(&observations)?;
    let costs = Costs {
        vertex_ns: vertex,
        triangle_ns,
        span_ns,
        pixel_ns,
        background_ns,
        worst: 0.0,
        worst_point: 0,
    };
    let errors = timed
        .iter()
        .map(|(i, point, ns)| (*i, ns / costs.explain(point) - 1.0));
    let (worst_point, worst) = errors.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    Some(Costs {
        worst,
        worst_point,
        ..costs
    })
}
