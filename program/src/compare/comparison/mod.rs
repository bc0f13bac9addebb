//! Compares methods on one frame: their errors and their times.
//!
//! [`compare`] draws a frame with each variant, with the `f64` reference and with the barycentric
//! renderer (`pictures.rs`), and times them in interleaved rounds (`speed.rs`). The result is a
//! [`Comparison`]. Serialised, it is the JSON of `docs/bench-json.md`; `table.rs` writes it for
//! terminals, [`crate::report`] as a page.

mod pictures;
mod speed;
pub(crate) mod table;
#[cfg(test)]
mod tests;

pub(crate) use speed::{Speed, WHAT_IS_TIMED};
pub(crate) use table::{TableKind, table};

use super::timing::{Noise, TimeLimits, Trust};
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use fastphong::compare::metrics::{Difference, MAX_PERCEIVED, Perceived, flip_map, mean_flip};
use fastphong::frame::triangulate::triangulated;
use fastphong::frame::{Frame, FrameStats};
use fastphong::picture::encoding::store;
use fastphong::picture::{Alpha, Encoding, LinearPicture, Picture8};
use fastphong::raster::{Plan, PolygonKind, Renderer, coverage};
use fastphong::reference::{Clamping, Model};
use fastphong::scene::Interpolation;
use fastphong::shading::{self, METHODS, MethodParameter, Variant};
use pictures::{Displayed, References};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use serde_json::Value;

/// The method that the speed of others is compared with: the one that the lecture makes fast.
pub const BASELINE: &str = "naive-phong";

/// The definition of [`MethodRow::error`], in one line.
pub const WHAT_IS_COMPARED: &str = "linear channels before rounding to 8 bits against the f64 reference, where both show the same polygon";

/// The clamped share of the covered picture from which on tables mention it.
pub(crate) const NOTABLE_CLAMPING: f64 = Clamping::NOTABLE;

/// A frame to compare methods on.
#[derive(Clone, Debug)]
pub struct Input<'a> {
    /// Its name in tables and files.
    pub name: String,
    /// The frame.
    pub frame: &'a Frame,
}

/// The result of comparing methods on one frame.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// The name of the frame.
    pub name: String,
    /// A short title of the scene; may be empty.
    pub title: String,
    /// The purpose of the scene; may be empty.
    pub description: String,
    /// The width of the picture in pixels.
    pub width: usize,
    /// The height of the picture in pixels.
    pub height: usize,
    /// The interpolation of varyings over the screen.
    pub interpolation: Interpolation,
    /// The encoding of stored pictures. Errors are always of linear channels.
    pub encoding: Encoding,
    /// The number of lights.
    pub lights: usize,
    /// The number of polygons in the frame.
    pub polygons: usize,
    /// The number of triangles that the polygons can be cut into: two less than corners, for each
    /// polygon.
    pub triangles: usize,
    /// The number of polygons that the barycentric renderer does not draw, because they cross
    /// themselves on the picture.
    pub not_simple: usize,
    /// The number of pixels that any polygon covers.
    pub covered_pixels: usize,
    /// The number of pixels of all polygons together, including hidden ones.
    pub fragments: usize,
    /// The part of the Phong reference whose light is over 1 before clamping. Errors vanish there,
    /// whatever a method computes.
    pub clamping: Clamping,
    /// Counts of the scene's polygons on their way into the frame.
    pub stats: FrameStats,
    /// The renderer that was asked for. Each row has the one that drew it.
    pub renderer: DrawnBy,
    #[serde(skip)]
    requested: Renderer,
    /// How far to trust the times; `None` if there are none.
    pub noise: Option<Noise>,
    /// The variants drawn by scanlines, in the order of the request. Naive Phong comes first if it
    /// was not requested.
    pub rows: Vec<MethodRow>,
    /// The variants that cannot draw this frame.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<LeftOut>,
    /// The methods of the barycentric renderer that the rows are compared with.
    pub barycentric: Vec<MethodRow>,
    /// The effect of cutting the polygons into triangles; `None` if they are triangles already.
    pub triangulation: Option<Triangulation>,
    /// The picture of the `f64` Phong reference.
    #[serde(skip)]
    pub reference: LinearPicture,
}

/// The difference that cutting polygons into triangles makes to the Phong reference.
///
/// Varyings interpolated along scanlines depend on the orientation of a polygon of four or more
/// corners, but not on that of a triangle (L21 3, Figure 5). Cutting polygons into triangles
/// therefore changes the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Triangulation {
    /// The number of triangles that the frame was cut into.
    pub triangles: usize,
    /// The number of polygons left out because they cross themselves on the picture.
    pub not_simple: usize,
    /// The difference at the pixels where both show the same polygon.
    pub difference: Difference,
}

/// A variant that cannot draw a frame.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// The variant as a user names it.
    pub variant: String,
    /// The reason, as a sentence without its full stop.
    pub reason: &'static str,
}

/// The loops that drew a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct DrawnBy {
    /// `span`, `row` or `barycentric`.
    pub engine: &'static str,
    /// The instruction set of the pixel loops.
    pub level: &'static str,
    /// The number of threads that shaded pixels: [`Renderer::threads`].
    pub threads: usize,
}

impl DrawnBy {
    /// The loops of [`Variant::render_barycentric`].
    pub const BARYCENTRIC: DrawnBy = DrawnBy {
        engine: "barycentric",
        level: "scalar",
        threads: 1,
    };

    /// Returns the description of `renderer` on the current pool of threads.
    pub fn new(renderer: Renderer) -> DrawnBy {
        DrawnBy {
            engine: renderer.engine().name(),
            level: renderer.level().name(),
            threads: renderer.threads(),
        }
    }
}

impl fmt::Display for DrawnBy {
    /// Writes `the span engine, scalar, 1 thread`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let s = if self.threads == 1 { "" } else { "s" };
        let (engine, level, threads) = (self.engine, self.level, self.threads);
        write!(f, "the {engine} engine, {level}, {threads} thread{s}")
    }
}

/// One variant drawn by one renderer: its error, its speed, its picture.
#[derive(Clone, Debug, Serialize)]
pub struct MethodRow {
    /// The variant: `variant`, `method`, `parameters` and `model` in JSON.
    #[serde(flatten, serialize_with = "variant_members")]
    pub variant: Variant,
    /// The loops that drew it.
    #[serde(flatten)]
    pub drawn_by: DrawnBy,
    /// The difference from the Phong reference: see [`WHAT_IS_COMPARED`].
    pub error: Difference,
    /// The difference from its own closed form ([`fastphong::shading::Info::model`]), which shows
    /// how well it computes what it is meant to. For the barycentric renderer, the closed form is
    /// on triangles.
    pub own: Difference,
    /// The largest `own.max` that rounding and the method's approximation by design can cause on
    /// this frame: [`fastphong::shading::Variant::bound`].
    pub bound: f64,
    /// The largest difference by design from the method's model with tⁿ:
    /// [`fastphong::shading::Variant::approximation`]. It is 0 for most methods.
    pub approximation: f64,
    /// True if `own.max` is at most `bound`. Newton's method on short spans with large angles may
    /// exceed it.
    pub within_bound: bool,
    /// The number of pixels at which it shows a different polygon from the reference. They are left
    /// out of `error`, because their colours differ by depth and not by shading.
    pub other_polygon: usize,
    /// The number of covered pixels with a channel that is 1, either clamped or exactly 1.
    pub clamped: usize,
    /// How many polygons each of its kinds draws; empty if the method has one kind.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub kinds: Vec<PolygonKind>,
    /// The speed, if it was measured.
    pub speed: Option<Speed>,
    /// The stored picture.
    #[serde(skip)]
    pub picture: Picture8,
}

impl MethodRow {
    /// Returns the variant as a user names it.
    pub fn name(&self) -> String {
        self.variant.to_string()
    }
}

/// Serialises a variant as members of its row.
fn variant_members<S: Serializer>(variant: &Variant, to: S) -> Result<S::Ok, S::Error> {
    let info = variant.info();
    let values = info.parameters.iter().zip(variant.parameters());
    let parameters = values.map(|(p, value)| (p.name, parameter_json(p, *value)));
    let mut members = to.serialize_map(Some(4))?;
    members.serialize_entry("variant", &variant.to_string())?;
    members.serialize_entry("method", info.name)?;
    members.serialize_entry("parameters", &parameters.collect::<BTreeMap<_, _>>())?;
    members.serialize_entry("model", info.model.name())?;
    members.end()
}

/// Returns the value of a method's parameter as JSON: a number, or a word such as `"auto"`.
pub fn parameter_json(parameter: &MethodParameter, value: shading::Value) -> Value {
    match value {
        shading::Value::Whole(whole) => whole.into(),
        shading::Value::Decimal(decimal) => decimal.into(),
        word => parameter.text(word).into(),
    }
}

/// The share of the progress for pictures, if times are measured too.
const PICTURES_PART: f32 = 0.3;

/// Draws `input` with each of `variants`, measures the errors, and times the variants: [`draw`],
/// then [`Comparison::time`]. Without `limits` there are no times, and every run returns the same
/// result to the last bit.
///
/// Calls `progress` with the part that is done, 0..=1, and the name of the next step, never while a
/// time is measured.
pub fn compare(
    input: &Input<'_>,
    variants: &[Variant],
    renderer: Renderer,
    limits: Option<TimeLimits>,
    progress: &mut dyn FnMut(f32, &str),
) -> Comparison {
    let part = limits.map_or(1.0, |_| PICTURES_PART);
    let mut comparison = draw(input, variants, renderer, &mut |done, next| {
        progress(part * done, next)
    });
    if let Some(limits) = limits {
        comparison.time(input.frame, limits, |done| {
            progress(part + (1.0 - part) * done, "timing")
        });
    }
    progress(1.0, "done");
    comparison
}

/// Draws `input` with each of `variants`, with the reference and with the barycentric renderer, and
/// measures their differences, without times.
///
/// Adds naive Phong in front if `variants` does not have it, because speeds are relative to it. The
/// barycentric renderer draws the triangulated frame by the same method if it has it, and by naive
/// Phong otherwise.
pub fn draw(
    input: &Input<'_>,
    variants: &[Variant],
    renderer: Renderer,
    progress: &mut dyn FnMut(f32, &str),
) -> Comparison {
    // Compare the pictures as they are seen: edges of supersampled frames are blended with the
    // background.
    let flattened = (input.frame.samples() > 1).then(|| {
        let mut frame = input.frame.clone();
        frame.set_alpha(Alpha::Flattened);
        frame
    });
    let frame = flattened.as_ref().unwrap_or(input.frame);
    let (mut drawn, mut left_out) = (Vec::new(), Vec::new());
    for variant in with_baseline(variants) {
        match variant.plan(frame, renderer) {
            Plan::Refused(reason) => left_out.push(LeftOut {
                variant: variant.to_string(),
                reason,
            }),
            _ => drawn.push(variant),
        }
    }
    let variants = drawn;
    let counterparts = counterparts(&variants);
    let steps = (variants.len() + counterparts.len() + 1) as f32;
    let mut step = 0.0;
    let mut next = |name: &str| {
        progress(step / steps, name);
        step += 1.0;
    };
    next("reference");
    let cut = triangulated(frame);
    let references = References::new(frame, &cut);
    let mut rows = Vec::new();
    for variant in &variants {
        next(&variant.to_string());
        rows.push(references.scanline_row(variant, renderer));
    }
    let mut barycentric = Vec::new();
    for variant in &counterparts {
        next(&alloc::format!("{variant}, barycentric"));
        barycentric.extend(references.barycentric_row(variant));
    }
    let mut fragments = 0;
    coverage(frame, |_, _, pixels| fragments += pixels.len());
    let reference = references.phong().clone();
    let is_covered = |pixel: &&[f32; 4]| pixel[3] > 0.0;
    Comparison {
        name: input.name.clone(),
        title: String::new(),
        description: String::new(),
        width: frame.picture_width(),
        height: frame.picture_height(),
        interpolation: frame.interpolation(),
        encoding: frame.encoding(),
        lights: frame.light_count(),
        polygons: frame.polygons().len(),
        triangles: frame.polygons().iter().map(|p| p.count as usize - 2).sum(),
        not_simple: cut.not_simple,
        covered_pixels: reference.pixels().iter().filter(is_covered).count(),
        fragments: fragments / frame.samples().pow(2),
        clamping: references.clamping(),
        stats: frame.stats(),
        renderer: DrawnBy::new(renderer),
        requested: renderer,
        noise: None,
        rows,
        left_out,
        barycentric,
        triangulation: references.triangulation(),
        reference,
    }
}

/// Estimates how many bytes [`draw`] needs at its peak, beside the frame. The estimate is too high,
/// by at most a fourth.
///
/// [`draw`] keeps, for each sample, the reference's polygon, depth and gap, and the polygons that
/// the engines show; for each pixel, the closed form of each model, and a stored picture for each
/// row. At the peak it also holds either a reference that is being shaded, in `f64`, or a row that
/// is being compared, whichever is larger. A frame with polygons of more than three corners has a
/// second reference.
pub fn memory_needed(frame: &Frame, variants: &[Variant]) -> u64 {
    let pixels = (frame.picture_width() * frame.picture_height()) as u64;
    let samples = (frame.width() * frame.height()) as u64;
    let variants = with_baseline(variants);
    let counterparts = counterparts(&variants);
    let is_cut = frame.polygons().iter().any(|polygon| polygon.count > 3);
    let models = |variants: &[Variant]| {
        let mut models: Vec<Model> = variants.iter().map(|v| v.info().model).collect();
        models.push(Model::Phong);
        models.sort_by_key(|model| *model as usize);
        models.dedup();
        models.len() as u64
    };
    let (visibility, polygons, linear, stored) = (4 + 8 + 8, 4, 16, 4);
    let (references, forms) = if is_cut {
        (2, models(&variants) + models(&counterparts))
    } else {
        (1, models(&[&variants[..], &counterparts].concat()))
    };
    let rows = (variants.len() + counterparts.len()) as u64;
    let shading = samples * (32 + visibility) + pixels * (32 + linear);
    // SSIM needs another stored copy of both pictures.
    let comparing = samples * polygons + pixels * (linear + 3 * stored);
    samples * (references * visibility + 2 * polygons)
        + pixels * (forms * linear + rows * stored)
        + shading.max(comparing)
}

/// The largest picture, in pixels, whose filtered reference [`Comparison::perceive`] keeps.
const MAX_KEPT: usize = 1 << 22;

impl Comparison {
    /// Returns all rows: those drawn by scanlines, then the barycentric renderer's.
    pub fn all_rows(&self) -> impl Iterator<Item = &MethodRow> {
        self.rows.iter().chain(&self.barycentric)
    }

    /// True if it was timed, and nothing can be said about the speeds.
    pub fn is_too_busy(&self) -> bool {
        let noise = self.noise.as_ref();
        noise.is_some_and(|noise| noise.trust == Trust::TooBusy)
    }

    /// Times all rows together, on the frame from which they were drawn. Triangulation is not
    /// timed. Calls `progress` with the part that is done, never while a time is measured.
    pub fn time(&mut self, frame: &Frame, limits: TimeLimits, progress: impl FnMut(f32)) {
        self.renderer = DrawnBy::new(self.requested);
        speed::time(self, frame, &triangulated(frame).frame, limits, progress);
    }

    /// Computes the mean ꟻLIP of all rows, [`Difference::flip`] of their errors. It compares the
    /// stored pictures and includes pixels that show a different polygon. Does nothing for pictures
    /// of over [`MAX_PERCEIVED`] pixels.
    pub fn perceive(&mut self) {
        let pixels = self.width * self.height;
        if pixels > MAX_PERCEIVED {
            return;
        }
        let encoding = self.encoding;
        let stored = store(&self.reference, encoding);
        let displayed = |picture| Displayed { picture, encoding };
        // Filter the reference once for all rows, unless it is large: filtered pictures take eight
        // times as much memory as stored ones.
        let kept = (pixels <= MAX_KEPT).then(|| Perceived::new(&displayed(&stored)));
        for row in self.rows.iter_mut().chain(&mut self.barycentric) {
            let actual = displayed(&row.picture);
            let map = match &kept {
                Some(reference) => reference.flip(&Perceived::new(&actual)),
                None => flip_map(&displayed(&stored), &actual),
            };
            row.error.flip = map.ok().map(|map| mean_flip(&map));
        }
    }

    /// Drops all pictures, which take most of the memory. The rows can still be timed.
    pub fn drop_pictures(&mut self) {
        self.reference = LinearPicture::new(0, 0, [0.0; 4]);
        for row in self.rows.iter_mut().chain(&mut self.barycentric) {
            row.picture = Picture8::new(0, 0, [0; 4]);
        }
    }
}

/// Returns `variants`, with naive Phong in front if it is not among them.
pub(crate) fn with_baseline(variants: &[Variant]) -> Vec<Variant> {
    let is_missing = !variants.iter().any(is_baseline);
    let baseline = METHODS
        .iter()
        .filter(|e| e.info.name == BASELINE)
        .filter(|_| is_missing)
        .map(|e| e.variant());
    baseline.chain(variants.iter().cloned()).collect()
}

/// True if `variant` is naive Phong with default parameters.
pub(crate) fn is_baseline(variant: &Variant) -> bool {
    variant.info().name == BASELINE && variant.is_default()
}

/// Returns the name of the barycentric renderer's method that `variant` is compared with.
fn counterpart(variant: &Variant) -> &'static str {
    if variant.row().is_barycentric() {
        variant.info().name
    } else {
        BASELINE
    }
}

/// Returns the barycentric renderer's methods that `variants` are compared with, without
/// duplicates, in the order of [`METHODS`].
fn counterparts(variants: &[Variant]) -> Vec<Variant> {
    let is_wanted = |name| variants.iter().any(|variant| counterpart(variant) == name);
    let entries = METHODS.iter().filter(|entry| is_wanted(entry.info.name));
    entries.map(|entry| entry.variant()).collect()
}
