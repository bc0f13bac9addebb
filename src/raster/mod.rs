//! The engines: they own the loops over polygons, scanlines and runs, and know nothing of lights. The loops over pixels are those
//! of a method's kernels (`shading/kernels.rs`).
//!
//! - `spans` is the lecture's, scalar: an edge table, active edges that step their varyings from scanline to scanline, a depth
//!   buffer of one line, and visible runs that are walked and shaded once. Everything can be drawn by it.
//! - `rows` (feature `simd`) is a deferred renderer: bands of scanlines, a G-buffer, each row shaded once.
//! - `barycentric` is the bounding-box rasterizer that the span engine is measured against: three edge functions per pixel.
//!
//! All of them have the same fill rule, and draw exactly the same pixels: those whose centres have an odd number of polygon edges
//! to their left, counted in exact integers on corners snapped to 1/256 pixel. Polygons that share an edge share none of its
//! pixels and leave no hole. The rule is `first_centre` and `EdgeCrossing` in `spans/edge.rs` with the parity in
//! `ActiveEdges::spans` (`spans/active.rs`), and as edge functions `EdgeFunctions` in `rows/triangles.rs`.
//!
//! Start with `spans/mod.rs`. `render.rs` chooses the engine, `setup.rs` computes uniforms and varyings before the first scanline.

mod aov;
mod auto;
#[cfg(feature = "simd")]
mod bands;
mod barycentric;
#[cfg(feature = "simd")]
mod bins;
mod depth;
mod engine;
pub mod painter;
mod render;
#[cfg(feature = "simd")]
mod rows;
mod setup;
mod spans;
mod target;

pub use aov::{checkerboard, coverage, depth, normals, polygon_numbers, vertex_colours};
pub use barycentric::{Edges, barycentric_polygon_numbers};
pub use engine::{Engine, Plan, Renderer};
pub use spans::{EdgeCrossing, NOTHING};
