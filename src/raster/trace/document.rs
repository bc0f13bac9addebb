//! The document of a trace, `fastphong.trace/1`. `docs/trace.md` describes its JSON.

use crate::scene::Place;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;
use serde::Serialize;

/// What the span engine does as it draws a frame by one method, line by line.
///
/// A line is a scanline of samples. Indices count from 0 within the document. Floats are the
/// engine's, bit for bit.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Trace {
    /// `fastphong.trace/1`.
    pub schema: &'static str,
    /// How many columns and lines of samples there are.
    pub size: [usize; 2],
    /// How many samples a pixel has along each side.
    pub samples: usize,
    /// How many sub-pixels a sample has: the unit of coordinates.
    pub unit: i32,
    /// The method, with its parameters.
    pub method: String,
    /// The materials of the frame, with the light on them.
    pub materials: Vec<TraceMaterial>,
    /// The names of the values in lists.
    pub names: TraceNames,
    /// The vertices.
    pub vertices: Vec<TraceVertex>,
    /// The polygons, in drawing order.
    pub polygons: Vec<TracePolygon>,
    /// The edges of all polygons, corner by corner.
    pub edges: Vec<TraceEdge>,
    /// The edges that begin on each line: the edge table.
    pub buckets: Vec<Vec<usize>>,
    /// All lines, or only the one that was asked for.
    pub lines: Vec<TraceLine>,
}

/// A material and the light on it: the factors of equation 2.1.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceMaterial {
    /// I_a k_a of each channel.
    pub ambient: [f32; 3],
    /// The lights.
    pub lights: Vec<TraceLight>,
    /// The eye: V, or its position.
    pub eye: TracePlace,
    /// The exponent n.
    pub n: f32,
}

/// A light on a material.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceLight {
    /// L, or its position.
    #[serde(flatten)]
    pub place: TracePlace,
    /// I_p k_d of each channel.
    pub diffuse: [f32; 3],
    /// I_p k_s of each channel.
    pub specular: [f32; 3],
    /// L·V, where both are at infinity.
    #[serde(rename = "LV", skip_serializing_if = "Option::is_none")]
    pub l_v: Option<f32>,
}

/// The place of a light or of the eye, at infinity or at a position.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum TracePlace {
    /// At infinity: the unit vector toward it.
    #[serde(rename = "toward")]
    Toward([f32; 3]),
    /// At a position.
    #[serde(rename = "at")]
    At([f32; 3]),
}

impl From<Place<[f32; 3]>> for TracePlace {
    fn from(place: Place<[f32; 3]>) -> Self {
        match place {
            Place::Infinite(v) => TracePlace::Toward(v),
            Place::Local(v) => TracePlace::At(v),
        }
    }
}

/// The names of the values in lists, in the order of the values.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceNames {
    /// The names of the varyings that edges carry: `J_1` and so on if there are several lights.
    pub varyings: Vec<String>,
    /// The names of [`TraceRun::values`]. Empty for methods in integers, which have no walks, and
    /// for methods of several kinds, whose runs carry their own names.
    pub pixel: Vec<String>,
}

/// A vertex.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceVertex {
    /// Column and line, in sub-pixels.
    pub at: [i32; 2],
    /// The depth, 0 at the near plane, 1 at the far one.
    pub depth: f64,
    /// The unit normal.
    pub normal: [f32; 3],
    /// Its varyings. Empty if varyings belong to the corners of polygons or to whole polygons; then
    /// [`TraceEntry`] has them.
    pub varyings: Vec<f32>,
}

/// A polygon.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TracePolygon {
    /// The vertices of its corners.
    pub corners: Vec<usize>,
    /// The index of its polygon in the scene. The pieces of a clipped polygon share it.
    pub source: u32,
    /// The index of its material.
    pub material: u32,
    /// The varyings of methods that light polygons; empty for others.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub varyings: Vec<f32>,
}

/// An edge of a polygon, from its upper to its lower end.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceEdge {
    /// The polygon.
    pub polygon: usize,
    /// The corner of the polygon at which it starts. It ends at the next corner.
    pub corner: usize,
    /// The vertex of its upper end.
    pub top: usize,
    /// The vertex of its lower end.
    pub bottom: usize,
    /// The first line whose centre is not above its upper end: ⌈y_top − ½⌉.
    pub first: i32,
    /// The first line whose centre is not above its lower end: ⌈y_bottom − ½⌉.
    pub end: i32,
    /// True if it crosses the centre of a line of the picture, and so is in the edge table.
    pub crosses: bool,
}

/// A line: which edges change, which are active, and what is drawn.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceLine {
    /// The line.
    pub y: usize,
    /// The edges that end before its centre and are removed.
    pub left: Vec<usize>,
    /// The edges that are stepped to it from the line before.
    pub stepped: Vec<usize>,
    /// The edges of its bucket, which become active.
    pub entered: Vec<TraceEntry>,
    /// The active edges, by polygon, and within a polygon from left to right.
    pub active: Vec<TraceActive>,
    /// The spans, in drawing order.
    pub spans: Vec<TraceSpan>,
    /// The visible runs of pixels, from left to right.
    pub runs: Vec<TraceRun>,
}

/// An edge that becomes active.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceEntry {
    /// The edge.
    pub edge: usize,
    /// The parameter at the centre of the line: 0 at the edge's upper end, 1 at its lower one.
    pub t0: f32,
    /// The parameter's growth per line: Δt = 1 / (y_2 − y_1).
    pub dt: f32,
    /// The varyings at the upper end.
    pub from: Vec<f32>,
    /// The varyings at the lower end.
    pub to: Vec<f32>,
}

/// An active edge on a line.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceActive {
    /// The edge.
    pub edge: usize,
    /// The first pixel whose centre is not left of the crossing.
    pub pixel: i32,
    /// The crossing lies at x = `pixel` + ½ − `rest[0]`/`rest[1]`, exactly.
    pub rest: [i64; 2],
    /// One line farther down, x is greater by `step[0]` + `step[1]`/`rest[1]`, exactly.
    pub step: [i64; 2],
    /// The value that depth is computed from, here, and its growth per line.
    pub depth: [f32; 2],
    /// The varyings here. On a great circle they begin with the unit normal.
    pub at: Vec<f32>,
    /// The growth of the varyings per line. A great circle's normal has none.
    pub by: Vec<f32>,
    /// The great circle, for methods whose edges follow one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub circle: Option<TraceCircle>,
}

/// A great circle: N = `rest[0]` `from` + `t[0]` `to` (L21 4.8).
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceCircle {
    /// N_1 / sin φ.
    pub from: [f32; 3],
    /// N_2 / sin φ.
    pub to: [f32; 3],
    /// sin tφ, cos tφ.
    pub t: [f32; 2],
    /// sin (1−t)φ, cos (1−t)φ.
    pub rest: [f32; 2],
    /// sin Δtφ, cos Δtφ.
    pub step: [f32; 2],
}

/// A span: the pixels of a polygon between two of its active edges.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceSpan {
    /// The polygon.
    pub polygon: usize,
    /// The active edge at its left.
    pub left: usize,
    /// The active edge at its right.
    pub right: usize,
    /// The first pixel.
    pub start: u32,
    /// The pixel after the last one.
    pub end: u32,
    /// The parameter at the centre of the first pixel: 0 at the left crossing, 1 at the right one.
    pub t0: f32,
    /// The parameter's growth per pixel: Δt = 1 / (x_2 − x_1).
    pub dt: f32,
    /// The value that depth is computed from, at the first pixel, and its growth per pixel.
    pub depth: [f32; 2],
    /// The depth of each pixel, as it is compared and stored.
    pub depths: Vec<f32>,
    /// The stretches of pixels where it was nearer than all spans before it: the first pixel of
    /// each, and the one after the last.
    pub seen: Vec<[usize; 2]>,
}

/// A run: adjacent pixels at which a span is seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceRun {
    /// The span, an index into [`TraceLine::spans`].
    pub span: usize,
    /// The first pixel.
    pub x: u32,
    /// How many pixels it has.
    pub pixels: usize,
    /// The parameter of the span at the centre of the first pixel.
    pub t0: f32,
    /// The parameter's growth per pixel.
    pub dt: f32,
    /// The varyings at the first pixel, or at the left end of the span for methods that start from
    /// both ends.
    pub at: Vec<f32>,
    /// The growth of the varyings per pixel, or the varyings at the right end for methods that
    /// start from both ends.
    pub by: Vec<f32>,
    /// True if `at` and `by` are the two ends of the span.
    #[serde(skip_serializing_if = "is_false")]
    pub is_ends: bool,
    /// The kind of its polygon, for methods of several kinds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<TraceKind>,
    /// The values of each pixel, named by [`TraceNames::pixel`] or by its kind.
    pub values: Vec<Vec<f32>>,
    /// Intermediate results at each pixel, by name. `guess` are Newton's guesses, of which the last
    /// is the result. `t`, `rest` and `step` are sines and cosines. `from` and `to` are the ends of
    /// a great circle over sin φ. `first`, `second` and `third` are differences. `D` and `d` are
    /// N·N and its root, for methods whose values are N.
    pub inside: BTreeMap<&'static str, Vec<Vec<f32>>>,
    /// The colour of each pixel, linear and clamped to 0..=1, as it is stored.
    pub colours: Vec<[f32; 3]>,
}

/// A kind of polygon.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TraceKind {
    /// Its name.
    pub name: &'static str,
    /// The names of [`TraceRun::values`].
    pub values: Vec<String>,
}

fn is_false(value: &bool) -> bool {
    !value
}
