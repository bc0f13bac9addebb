//! The engines: they find the pixels that are seen, and a method's kernels shade these (`shading/kernels/mod.rs`). No engine
//! evaluates the light model.
//!
//! - `spans` is the lecture's, scalar: an edge table, active edges that step their varyings from scanline to scanline, a depth
//!   buffer of one line, and visible runs that are walked and shaded once. Everything can be drawn by it.
//! - `rows` (feature `simd`) is a deferred renderer: bands of scanlines, a G-buffer, each row shaded once.
//! - `barycentric` is the bounding-box rasterizer that the span engine is measured against: three edge functions per pixel.
//!
//! All of them have the same fill rule, and draw exactly the same pixels, `barycentric` those of triangles with `Edges::TopLeft`. A
//! polygon has the pixels whose centres have an odd number of its edges to their left, counted in exact integers on corners snapped
//! to 1/256 pixel. A centre on an edge belongs to the polygon right of the edge or below it (the top-left rule). So polygons that
//! share an edge share none of its pixels and leave no hole.
//!
//! | rule | where |
//! |---|---|
//! | fill rule, by crossings | `first_centre` and `EdgeCrossing` in `spans/edge.rs`, the parity in `ActiveEdges::spans` |
//! | fill rule, by edge functions | `Batch::edge` in `rows/triangles.rs`; `EdgeFunction` in `barycentric.rs` |
//! | depth at a sample | `depth.rs` |
//! | what depth cannot decide | `depth_ties.rs` |
//! | depth test | `VisibleLine::draw` in `spans/line.rs`; `Writer` in `rows/tile.rs`; `SampleDepth::seen` in `depth.rs` |
//!
//! Start with `spans/mod.rs`. `render.rs` chooses the engine. Before the first scanline `setup.rs` prepares uniforms and has vertices
//! lit, on all threads. For the row engine `bins.rs` sorts polygons into bands of scanlines, and `bands.rs` gives these to threads.

mod aov;
mod auto;
#[cfg(feature = "simd")]
mod bands;
mod barycentric;
#[cfg(feature = "simd")]
mod bins;
mod depth;
#[doc(hidden)]
pub mod depth_ties;
mod draw;
mod engine;
pub mod painter_conflicts;
mod render;
#[cfg(feature = "simd")]
mod rows;
mod setup;
mod spans;
mod target;
#[cfg(feature = "io")]
pub mod trace;

#[cfg(feature = "cli")]
pub(crate) use aov::for_each_polygon_row;
pub use aov::{checkerboard, coverage, depth, normals, polygon_numbers, vertex_colours};
pub use barycentric::{Edges, barycentric_polygon_numbers};
pub use depth::DepthTest;
pub use draw::{Background, DrawError, DrawOptions};
pub use engine::{Engine, Plan, PolygonKind, Renderer};
pub use spans::{EdgeCrossing, NOTHING};
