//! Comparison: how far each method is from the reference, and how fast it gets there.
//!
//! Speed and error are found together, on the same frame, and are always shown together: either alone says nothing.
//!
//! ```
//! use fastphong::compare::comparison::{Input, Options, TableKind, compare, table};
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::mesh::vertex_normals::NormalSource;
//! use fastphong::scene::{Camera, Fit, Light, Object, Scene};
//! use fastphong::shading::Variant;
//! use glam::{DAffine3, DVec3};
//!
//! let mesh = builtin("sphere?rings=8&segments=16")?;
//! let fit = Fit { direction: DVec3::Z, up: DVec3::Y, fraction: 0.9, fovy: None, aspect: 1.0 };
//! let points = mesh.positions().iter().map(|p| p.as_dvec3());
//! let camera = Camera::fit(points, &fit).ok_or("the mesh is empty")?;
//! let scene = Scene {
//!     width: 48,
//!     height: 48,
//!     lights: vec![Light::directional(DVec3::new(1.0, 1.0, 2.0).normalize(), [1.0; 3])],
//!     objects: vec![Object {
//!         mesh: mesh.into(),
//!         transform: DAffine3::IDENTITY,
//!         material: None,
//!         normals: NormalSource::Averaged,
//!     }],
//!     ..Scene::new(camera)
//! };
//! let frame = scene.frame()?;
//!
//! let variants = [Variant::parse("gouraud")?, Variant::parse("fast-phong:steps=1")?];
//! let options = Options { timing: None, ..Options::default() }; // errors only
//! let comparison = compare(&Input { name: "sphere".into(), frame: &frame }, &variants, &options, &mut |_, _| {});
//! let [naive, gouraud, fast] = &comparison.rows[..] else { unreachable!("naive Phong is always among them") };
//! assert!(naive.error.rms < fast.error.rms && fast.error.rms < gouraud.error.rms);
//! println!("{}", table(&comparison, TableKind::Short));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod document;
mod pictures;
mod speed;
pub(crate) mod table;
#[cfg(test)]
mod tests;
mod triangulation;

pub use document::{
    ComparisonData, Document, DocumentError, RendererData, RowData, SCHEMA, StatsData, parse,
};
pub use speed::{Speed, WHAT_IS_TIMED};
pub use table::{TableKind, table};
pub use triangulation::{Triangulation, triangulation};

use super::metrics::{Difference, Perceived, mean_flip};
use super::timing::Limits;
use crate::frame::triangulate::triangulated;
use crate::frame::{Frame, FrameStats};
use crate::number::Level;
use crate::picture::encoding::store;
use crate::picture::{Encoding, LinearPicture, Picture8};
use crate::raster::{self, Renderer, coverage};
use crate::scene::Interpolation;
use crate::shading::{METHODS, Variant};
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use pictures::References;

/// The method that speed is stated against: what the lecture makes fast.
pub const BASELINE: &str = "naive-phong";

/// What the errors of a [`Row`] are, in one line.
pub const WHAT_IS_COMPARED: &str = "linear channels before rounding to 8 bits against the f64 reference, where both show the same polygon";

/// What is to be compared on.
#[derive(Clone, Debug)]
pub struct Input<'a> {
    /// What people call it.
    pub name: String,
    /// The frame.
    pub frame: &'a Frame,
}

/// How to compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// How long to take times; `None` takes none, so that the result is the same to the last bit at every run.
    pub timing: Option<Limits>,
    /// How the variants draw. The barycentric renderer has one way only.
    pub renderer: Renderer,
}

impl Default for Options {
    /// With times, in the lecture's own form.
    fn default() -> Self {
        Options {
            timing: Some(Limits::default()),
            renderer: Renderer::LECTURE,
        }
    }
}

/// All methods that were compared on one frame.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// What people call the frame.
    pub name: String,
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// How attributes vary over the screen.
    pub interpolation: Interpolation,
    /// How stored pictures are encoded; errors are of linear channels in any case.
    pub encoding: Encoding,
    /// Lights.
    pub lights: usize,
    /// Polygons of the frame.
    pub polygons: usize,
    /// Triangles that they are worth: two less than corners, for each polygon.
    pub triangles: usize,
    /// Polygons that the barycentric renderer does not draw because they cross themselves on the picture.
    pub not_simple: usize,
    /// Pixels that any polygon covers.
    pub covered_pixels: usize,
    /// Pixels of all polygons, hidden ones too.
    pub fragments: usize,
    /// What became of the scene's polygons on their way into the frame.
    pub stats: FrameStats,
    /// How the variants were to be drawn; a row says how it was.
    pub renderer: Renderer,
    /// Threads that there were.
    pub threads: usize,
    /// The picture of the `f64` Phong reference.
    pub reference: LinearPicture,
    /// The variants drawn by scanlines, in the order given; before them naive Phong if it was not given.
    pub rows: Vec<Row>,
    /// The methods of the barycentric renderer that the rows are measured against.
    pub barycentric: Vec<Row>,
}

impl Comparison {
    /// All rows: those drawn by scanlines, then the barycentric renderer's.
    pub fn all_rows(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().chain(&self.barycentric)
    }
}

/// What drew a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// By scanlines: [`raster::Engine::Span`] is the lecture's.
    Scanlines(raster::Engine),
    /// The one they are measured against: [`Variant::render_barycentric`](crate::shading::Variant::render_barycentric).
    Barycentric,
}

impl Engine {
    /// Its name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Scanlines(engine) => engine.name(),
            Engine::Barycentric => "barycentric",
        }
    }
}

/// One variant in one engine: its error, its speed, its pictures.
#[derive(Clone, Debug)]
pub struct Row {
    /// The variant.
    pub variant: Variant,
    /// What drew it.
    pub engine: Engine,
    /// The instruction set of its pixel loops.
    pub level: Level,
    /// How many threads walked and shaded its pixels: [`Renderer::threads`].
    pub threads: usize,
    /// Its difference from the Phong reference: see [`WHAT_IS_COMPARED`].
    pub error: Difference,
    /// Its difference from its own closed form ([`crate::shading::Info::model`]): how well it does what it means to do. In
    /// the barycentric renderer that is the closed form on triangles.
    pub own: Difference,
    /// The most that rounding can make of `own` on this frame: [`crate::shading::Info::bound`].
    pub bound: f64,
    /// Pixels at which it shows another polygon than the reference; they are left out of `error`, as their colours tell
    /// of depth and not of shading.
    pub other_polygon: usize,
    /// Its speed, if times were taken.
    pub speed: Option<Speed>,
    /// What it stores.
    pub picture: Picture8,
    /// What it computes, before rounding.
    pub linear: LinearPicture,
}

impl Row {
    /// The variant as a user names it.
    pub fn name(&self) -> String {
        self.variant.to_string()
    }

    /// True if its difference from its own closed form is what rounding makes, [`Row::bound`]. Newton's method on short
    /// spans with large angles may be over it, and is then shown to be.
    pub fn is_within_bound(&self) -> bool {
        self.own.max <= self.bound
    }
}

/// Part of the progress that the pictures take, when times are taken as well.
const PICTURES_PART: f32 = 0.3;

/// Draws `input` with each of `variants`, with the reference and with the barycentric renderer, tells how far they are
/// apart, and times them: [`draw`], then [`Comparison::time`].
///
/// `progress` is told which part is done, 0..=1, and what is being done; never while a time is taken.
pub fn compare(
    input: &Input<'_>,
    variants: &[Variant],
    options: &Options,
    progress: &mut dyn FnMut(f32, &str),
) -> Comparison {
    let part = match options.timing {
        Some(_) => PICTURES_PART,
        None => 1.0,
    };
    let mut comparison = draw(input, variants, options.renderer, &mut |done, what| {
        progress(part * done, what)
    });
    if let Some(limits) = options.timing {
        comparison.time(input.frame, limits, |done| {
            progress(part + (1.0 - part) * done, "timing")
        });
    }
    progress(1.0, "done");
    comparison
}

/// Draws `input` with each of `variants`, with the reference and with the barycentric renderer, and tells how far they are
/// apart, without times.
///
/// Naive Phong, which speed is stated against, comes first if `variants` does not have it. The barycentric renderer draws
/// the triangulated frame, with the same method where it has it and naive Phong otherwise.
pub fn draw(
    input: &Input<'_>,
    variants: &[Variant],
    renderer: Renderer,
    progress: &mut dyn FnMut(f32, &str),
) -> Comparison {
    let frame = input.frame;
    let variants = with_baseline(variants);
    let counterparts = counterparts(&variants);
    let steps = (variants.len() + counterparts.len() + 1) as f32;
    let mut step = 0.0;
    let mut next = |what: &str| {
        progress(step / steps, what);
        step += 1.0;
    };
    next("reference");
    let references = References::new(frame);
    let mut scanline = |variant: &Variant| {
        next(&variant.to_string());
        references.scanline_row(frame, variant, renderer)
    };
    let rows: Vec<Row> = variants.iter().map(&mut scanline).collect();
    let mut barycentric = |variant: &Variant| {
        next(&alloc::format!("{variant}, barycentric"));
        references.barycentric_row(variant)
    };
    let barycentric: Vec<Row> = counterparts.iter().filter_map(&mut barycentric).collect();
    let mut fragments = 0;
    coverage(frame, |_, _, pixels| fragments += pixels.len());
    Comparison {
        name: input.name.clone(),
        width: frame.width(),
        height: frame.height(),
        interpolation: frame.interpolation(),
        encoding: frame.encoding(),
        lights: frame.light_count(),
        polygons: frame.polygons().len(),
        triangles: frame.polygons().iter().map(|p| p.count as usize - 2).sum(),
        not_simple: references.triangulated.not_simple,
        covered_pixels: references.covered_pixels(),
        fragments,
        stats: frame.stats(),
        renderer,
        threads: renderer.threads(),
        reference: references.phong,
        rows,
        barycentric,
    }
}

impl Comparison {
    /// Times all rows together, on the frame that they were drawn from; triangulating is not timed. `progress` is told which
    /// part is done, never while a time is taken.
    pub fn time(&mut self, frame: &Frame, limits: Limits, progress: impl FnMut(f32)) {
        let triangles = triangulated(frame);
        self.threads = self.renderer.threads();
        speed::take(
            frame,
            &triangles.frame,
            &mut self.rows,
            &mut self.barycentric,
            self.covered_pixels,
            (self.renderer, limits),
            progress,
        );
    }

    /// Finds the mean ꟻLIP of all rows, [`Difference::flip`] of their errors. It is that of the pictures as they are
    /// stored; pixels that show another polygon count as well.
    pub fn perceive(&mut self) {
        let reference = Perceived::new(&store(&self.reference, self.encoding));
        for row in self.rows.iter_mut().chain(&mut self.barycentric) {
            let map = reference.flip(&Perceived::new(&row.picture));
            row.error.flip = map.ok().map(|map| mean_flip(&map));
        }
    }

    /// Drops all pictures, which take most of its memory: what is left can still be timed.
    pub fn drop_pictures(&mut self) {
        self.reference = LinearPicture::new(0, 0, [0.0; 4]);
        for row in self.rows.iter_mut().chain(&mut self.barycentric) {
            row.picture = Picture8::new(0, 0, [0; 4]);
            row.linear = LinearPicture::new(0, 0, [0.0; 4]);
        }
    }
}

pub(crate) fn with_baseline(variants: &[Variant]) -> Vec<Variant> {
    let baseline = METHODS
        .iter()
        .find(|entry| entry.info.name == BASELINE)
        .map(|entry| entry.variant());
    let missing = baseline.filter(|_| !variants.iter().any(is_baseline));
    missing
        .into_iter()
        .chain(variants.iter().cloned())
        .collect()
}

fn is_baseline(variant: &Variant) -> bool {
    variant.info().name == BASELINE && variant.is_default()
}

/// The name of the method that the barycentric renderer is to draw for a comparison with `variant`.
fn counterpart(variant: &Variant) -> &'static str {
    if variant.info().barycentric {
        variant.info().name
    } else {
        BASELINE
    }
}

/// The methods of the barycentric renderer that `variants` are measured against, each once, in the order of the table.
fn counterparts(variants: &[Variant]) -> Vec<Variant> {
    let wanted = |name| variants.iter().any(|variant| counterpart(variant) == name);
    METHODS
        .iter()
        .filter(|entry| wanted(entry.info.name))
        .map(|entry| entry.variant())
        .collect()
}
