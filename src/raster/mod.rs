//! Rasterizers: the engines that draw a frame by a shading method.
//!
//! [`Variant::render`](crate::shading::Variant::render) draws a new picture.
//! [`Variant::draw`](crate::shading::Variant::draw) draws into memory that you own, and tests
//! against your own depth buffer if you pass one. Its [`DrawOptions`] name the [`Renderer`]: the
//! engine and its instruction set.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::picture::PictureMut;
//! use fastphong::raster::{DrawOptions, NO_POLYGON, Renderer, polygon_indices};
//! use fastphong::scene::Scene;
//! use fastphong::shading::methods;
//!
//! let mut scene = Scene::of_mesh(builtin("teapot?res=4")?);
//! (scene.width, scene.height) = (64, 48);
//! let frame = scene.frame()?;
//! let method = methods::PHONG_RSQRT.variant();
//! let mut window = vec![0u32; 64 * 48]; // 0xAARRGGBB
//! let options = DrawOptions::by(Renderer::fastest());
//! method.draw(&frame, PictureMut::argb(&mut window, 64, 48), options)?;
//! // Alpha is 0 exactly where no polygon is seen.
//! let polygons = polygon_indices(&frame);
//! for (pixel, polygon) in window.iter().zip(polygons.pixels()) {
//!     assert_eq!(pixel >> 24 == 0, *polygon == NO_POLYGON);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Renderer::default`] is the span engine: scalar, one thread for all pixels, the same bits on
//! every machine. [`Renderer::fastest`] is the row engine where the machine has SIMD; it uses all
//! threads of rayon's current pool (feature `threads`). A method that the row engine cannot draw is
//! drawn by the span engine, and `draw` returns which engine drew.
//! [`Variant::plan`](crate::shading::Variant::plan) says so in advance, with the reason.
//!
//! From frame to frame keep the [`Variant`](crate::shading::Variant), the picture's memory and your
//! depth buffer. An engine itself keeps nothing: each drawing allocates its working memory (the
//! varyings of the vertices, edge tables or bins, the G-buffer's bands) and frees it.
//!
//! [`coverage`], [`depth()`], [`normals`] and [`polygon_indices`] draw the other pictures of a
//! frame: covered pixels, depths, normals, and the polygon at each pixel.
//!
//! # Inside
//!
//! An engine finds the visible pixels, and the method's kernels shade them
//! (`shading/kernels/mod.rs`). No engine evaluates the light model.
//!
//! - `spans` is the lecture's engine, one pixel at a time. It has an edge table, active edges that
//!   step their varyings from scanline to scanline, and a depth buffer of one line. Each visible
//!   run is walked and shaded once. It can draw everything.
//! - `rows` (feature `simd`) is a deferred renderer. It fills a G-buffer band by band and shades
//!   each row once.
//! - `barycentric` is the bounding-box rasterizer as a baseline for timing. It evaluates three edge
//!   functions per pixel.
//!
//! All engines follow one fill rule and draw exactly the same pixels; `barycentric` does so for
//! triangles with `Edges::TopLeft`. A polygon covers a pixel if an odd number of its edges lie left
//! of the pixel's centre, counted in exact integers on corners snapped to 1/256 pixel. A centre on
//! an edge belongs to the polygon right of the edge or below it (the top-left rule). So polygons
//! that share an edge share no pixel and leave no hole.
//!
//! | rule | where |
//! |---|---|
//! | fill rule, by crossings | `first_centre` and `EdgeCrossing` in `spans/edge.rs`, the parity in `ActiveEdges::spans` |
//! | fill rule, by edge functions | `Batch::edge` in `rows/triangles.rs`; `EdgeFunction` in `barycentric.rs` |
//! | depth at a sample | `depth.rs` |
//! | samples at which rounding decides the depth test | `depth_ties.rs` |
//! | second passes over a caller's depths | `second_pass.rs` |
//! | depth test | `VisibleLine::draw` in `spans/line.rs`; `Writer` in `rows/tile.rs`; `SampleDepth::seen` in `depth.rs` |
//!
//! Start reading at `spans/mod.rs`. `render.rs` chooses the engine. Before the first scanline
//! `setup.rs` prepares uniforms and lights the vertices, on all threads. For the row engine
//! `bins.rs` sorts polygons into bands of scanlines, and `bands.rs` hands the bands to threads.

mod aov;
mod auto;
#[cfg(feature = "simd")]
mod bands;
mod barycentric;
#[cfg(feature = "simd")]
mod bins;
mod depth;
pub(crate) mod depth_ties;
mod draw;
mod engine;
#[doc(hidden)]
pub mod painter_conflicts;
mod render;
#[cfg(feature = "simd")]
mod rows;
#[cfg(feature = "simd")]
mod second_pass;
mod setup;
mod spans;
mod target;
#[cfg(feature = "io")]
pub mod trace;

#[doc(hidden)]
pub use aov::for_each_polygon_row;
pub use aov::{checkerboard, vertex_colours};
pub use aov::{coverage, depth, normals, polygon_indices};
pub use barycentric::{Edges, barycentric_polygon_indices};
pub use depth::DepthTest;
pub use draw::{Background, DrawError, DrawOptions};
pub use engine::{Engine, Plan, PolygonKind, Renderer};
pub use spans::NO_POLYGON;
