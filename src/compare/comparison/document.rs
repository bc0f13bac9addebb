//! Comparisons as data: versioned JSON, described field by field in `docs/bench-json.md`.

use super::{Comparison, Row, Speed, WHAT_IS_COMPARED, WHAT_IS_TIMED};
use crate::compare::metrics::Difference;
use crate::compare::timing::Machine;
use crate::frame::FrameStats;
use crate::picture::Encoding;
use crate::raster::Renderer;
use crate::scene::Interpolation;
use crate::shading::MethodParameter;
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The schema of the documents written here. The number grows when a field changes its meaning or goes; new fields alone
/// do not change it, so readers must pass over what they do not know.
pub const SCHEMA: &str = "fastphong.bench/1";

/// Comparisons, and what they were made on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// [`SCHEMA`].
    pub schema: String,
    /// What was typed, program first.
    pub command_line: Vec<String>,
    /// What it ran on.
    pub machine: Machine,
    /// [`WHAT_IS_TIMED`].
    pub timed: String,
    /// [`WHAT_IS_COMPARED`].
    pub compared: String,
    /// One entry a frame.
    pub comparisons: Vec<ComparisonData>,
}

/// A [`Comparison`] without its pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)] // as in `Comparison`
pub struct ComparisonData {
    pub name: String,
    pub width: usize,
    pub height: usize,
    /// `screen` or `perspective`.
    pub interpolation: String,
    /// `linear` or `srgb`.
    pub encoding: String,
    pub lights: usize,
    pub polygons: usize,
    pub triangles: usize,
    pub not_simple: usize,
    pub covered_pixels: usize,
    pub fragments: usize,
    pub stats: StatsData,
    /// See [`Comparison::renderer`].
    #[serde(default)]
    pub renderer: RendererData,
    pub rows: Vec<RowData>,
    pub barycentric: Vec<RowData>,
}

/// How the variants were to be drawn; a row says how it was.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RendererData {
    /// `span` or `row`.
    pub engine: String,
    /// The instruction set of the pixel loops: `scalar`, `avx2` or `neon`.
    pub level: String,
    /// Threads.
    pub threads: usize,
}

impl Default for RendererData {
    /// The lecture's own form, in which all was drawn before there were others.
    fn default() -> Self {
        RendererData::new(Renderer::LECTURE, 1)
    }
}

impl RendererData {
    pub(super) fn new(renderer: Renderer, threads: usize) -> Self {
        RendererData {
            engine: renderer.engine().name().to_string(),
            level: renderer.level().name().to_string(),
            threads,
        }
    }

    /// What drew a row.
    pub(super) fn of_row(row: &Row) -> Self {
        RendererData {
            engine: row.engine.name().to_string(),
            level: row.level.name().to_string(),
            threads: row.threads,
        }
    }

    /// The three in words: `the span engine, scalar, 1 thread`.
    pub fn line(&self) -> String {
        let RendererData {
            engine,
            level,
            threads,
        } = self;
        alloc::format!(
            "the {engine} engine, {level}, {threads} thread{}",
            if *threads == 1 { "" } else { "s" }
        )
    }
}

/// [`FrameStats`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs)] // as in `FrameStats`
pub struct StatsData {
    pub polygons: usize,
    pub culled: usize,
    pub zero_area: usize,
    pub outside: usize,
    pub clipped: usize,
    /// See [`FrameStats::unprojected`].
    #[serde(default)]
    pub unprojected: usize,
}

/// A [`Row`] without its pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowData {
    /// The variant as a user names it.
    pub variant: String,
    /// Its method.
    pub method: String,
    /// The values of all its parameters: numbers, or `"auto"`.
    pub parameters: BTreeMap<String, Value>,
    /// `span`, `row` or `barycentric`.
    pub engine: String,
    /// The instruction set that drew it.
    #[serde(default = "lecture_level")]
    pub level: String,
    /// The threads that walked and shaded its pixels.
    #[serde(default = "lecture_threads")]
    pub threads: usize,
    /// The closed form that `own` is the difference from: `flat`, `gouraud`, `phong` or `slerp`.
    pub model: String,
    /// See [`Row::error`].
    pub error: Difference,
    /// See [`Row::own`].
    pub own: Difference,
    /// See [`Row::bound`].
    pub bound: f64,
    /// True if `own.max` is within it.
    pub within_bound: bool,
    /// See [`Row::other_polygon`].
    pub other_polygon: usize,
    /// `None` if no times were taken.
    pub speed: Option<Speed>,
}

fn lecture_level() -> String {
    RendererData::default().level
}

fn lecture_threads() -> usize {
    RendererData::default().threads
}

impl RowData {
    /// True if the barycentric renderer drew it.
    pub fn is_barycentric(&self) -> bool {
        self.engine == super::Engine::Barycentric.name()
    }
}

impl Document {
    /// The document of `comparisons`.
    pub fn new(comparisons: &[Comparison], machine: &Machine, command_line: &[String]) -> Document {
        Document {
            schema: SCHEMA.to_string(),
            command_line: command_line.to_vec(),
            machine: machine.clone(),
            timed: WHAT_IS_TIMED.to_string(),
            compared: WHAT_IS_COMPARED.to_string(),
            comparisons: comparisons.iter().map(ComparisonData::from).collect(),
        }
    }

    /// Its text, indented, with fields in the order in which they are described.
    pub fn to_text(&self) -> String {
        let mut text =
            serde_json::to_string_pretty(self).expect("numbers, texts and lists of them");
        text.push('\n');
        text
    }

    /// The document of a text that [`Document::to_text`] made.
    ///
    /// # Errors
    /// [`DocumentError`] if it is not JSON, or of another schema, or lacks a field.
    pub fn parse(text: &str) -> Result<Document, DocumentError> {
        parse(text)
    }
}

/// Reads a document of schema [`SCHEMA`] from JSON, with the fields that `T` knows.
///
/// # Errors
/// As [`Document::parse`].
pub fn parse<T: DeserializeOwned>(text: &str) -> Result<T, DocumentError> {
    #[derive(Deserialize)]
    struct Head {
        schema: Option<String>,
    }
    let head: Head = serde_json::from_str(text).map_err(DocumentError::Json)?;
    match head.schema {
        Some(schema) if schema == SCHEMA => serde_json::from_str(text).map_err(DocumentError::Json),
        Some(other) => Err(DocumentError::Schema(other)),
        None => Err(DocumentError::NoSchema),
    }
}

/// Why a text is no document.
#[derive(Debug, thiserror::Error)]
pub enum DocumentError {
    /// It is not JSON, or not as described; with line and column.
    #[error("{0}: expected a document of schema `{SCHEMA}`")]
    Json(serde_json::Error),
    /// It names another schema.
    #[error("schema `{0}`: expected `{SCHEMA}`")]
    Schema(String),
    /// It names no schema.
    #[error("no `schema`: expected `{SCHEMA}`")]
    NoSchema,
}

impl From<&Comparison> for ComparisonData {
    fn from(c: &Comparison) -> Self {
        let interpolation = match c.interpolation {
            Interpolation::Screen => "screen",
            Interpolation::Perspective => "perspective",
        };
        let encoding = match c.encoding {
            Encoding::Linear => "linear",
            Encoding::Srgb => "srgb",
        };
        ComparisonData {
            name: c.name.clone(),
            width: c.width,
            height: c.height,
            interpolation: interpolation.to_string(),
            encoding: encoding.to_string(),
            lights: c.lights,
            polygons: c.polygons,
            triangles: c.triangles,
            not_simple: c.not_simple,
            covered_pixels: c.covered_pixels,
            fragments: c.fragments,
            stats: c.stats.into(),
            renderer: RendererData::new(c.renderer, c.threads),
            rows: c.rows.iter().map(RowData::from).collect(),
            barycentric: c.barycentric.iter().map(RowData::from).collect(),
        }
    }
}

impl From<FrameStats> for StatsData {
    fn from(stats: FrameStats) -> Self {
        let FrameStats {
            polygons,
            culled,
            zero_area,
            outside,
            clipped,
            unprojected,
        } = stats;
        StatsData {
            polygons,
            culled,
            zero_area,
            outside,
            clipped,
            unprojected,
        }
    }
}

impl From<&Row> for RowData {
    fn from(row: &Row) -> Self {
        let info = row.variant.info();
        let values = info.parameters.iter().zip(row.variant.parameters());
        let value = |(p, value): (&MethodParameter, &u32)| match p.is_auto(*value) {
            true => (p.name.to_string(), p.text(*value).into()),
            false => (p.name.to_string(), (*value).into()),
        };
        RowData {
            variant: row.name(),
            method: info.name.to_string(),
            parameters: values.map(value).collect(),
            engine: row.engine.name().to_string(),
            level: row.level.name().to_string(),
            threads: row.threads,
            model: info.model.name().into(),
            error: row.error,
            own: row.own,
            bound: row.bound,
            within_bound: row.is_within_bound(),
            other_polygon: row.other_polygon,
            speed: row.speed.clone(),
        }
    }
}
