//! Phong shading on a scanline rasterizer: 38 methods to run, time, look at and check against an
//! `f64` reference.
//!
//! *Lecture 21: Shading* (L21) shades polygons scanline by scanline: flat, with interpolated
//! colours (Gouraud), with interpolated normals (Phong). Then it draws Phong's picture with a few
//! additions per pixel. Each of these is a *method* here. Every method draws the same
//! [`frame::Frame`] through the same engine, so two pictures differ by shading and nothing else.
//! The [`mod@reference`] defines the correct picture. It shares no arithmetic with the methods.
//!
//! The command-line tool is the package `fastphong-cli`.
//!
//! # Example
//!
//! Draw a mesh with the lecture's fast method:
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::scene::Scene;
//! use fastphong::shading::methods;
//!
//! // A mesh: polygons of any number of sides. `mesh::read` reads them from files.
//! let mesh = builtin("teapot?res=6")?;
//! // A scene: the mesh, a camera that sees all of it, and a light. All fields are public.
//! let mut scene = Scene::of_mesh(mesh);
//! (scene.width, scene.height) = (160, 120);
//! // A frame: the polygons that the camera sees, projected, clipped and checked.
//! let frame = scene.frame()?;
//! // A picture: red, green, blue and alpha in bytes.
//! let picture = methods::FAST_PHONG.variant().render(&frame)?;
//! assert_eq!(picture.get(80, 60)[3], 255, "the teapot is in the middle");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Then measure how far a picture is from the correct one:
//!
//! ```
//! use fastphong::compare::metrics::compare;
//! use fastphong::reference::{self, Model};
//! # use fastphong::mesh::builtin::builtin;
//! # use fastphong::scene::Scene;
//! # use fastphong::shading::methods;
//! # let mut scene = Scene::of_mesh(builtin("teapot?res=6")?);
//! # (scene.width, scene.height) = (160, 120);
//! # let frame = scene.frame()?;
//!
//! // One step of Newton's method per pixel.
//! let fast = methods::FAST_PHONG.variant().with("steps", 1)?.render(&frame)?;
//! let exact = reference::render(&frame, Model::Phong).to_picture8();
//! let difference = compare(&exact, &fast)?;
//! assert_eq!(difference.coverage_mismatches, 0);
//! assert!(255.0 * difference.rms < 1.0, "less than a grey level");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The [examples](https://docs.rs/crate/fastphong/latest/source/examples/) are whole programs: one
//! triangle, your own triangles, rasterizer, shader, texture and window.
//!
//! # Where to start
//!
//! | to | use |
//! |---|---|
//! | make or read a mesh | [`mesh::MeshBuilder`], [`mesh::builtin::builtin`], `mesh::read::load_mesh` |
//! | choose vertex normals (L21 1.1, 3.1) | [`mesh::vertex_normals`] |
//! | set up camera and lights | [`scene::Scene`], [`scene::Camera`], [`scene::Light`] |
//! | draw many frames of one scene | [`scene::Scene::prepare`], [`frame::PreparedScene`] |
//! | draw polygons that your own renderer has projected | [`frame::FrameBuilder`] |
//! | choose a method | [`shading::methods`], [`shading::Variant`]; all of them are in [`shading::METHODS`] |
//! | get the fastest method for a picture | [`shading::Variant::auto`] |
//! | draw into your own memory, with your own depth buffer | [`shading::Variant::draw`], [`picture::PictureMut`] |
//! | use all SIMD lanes and threads | [`raster::Renderer::fastest`], [`raster::DrawOptions::by`] |
//! | choose an engine: scalar spans or SIMD rows | [`raster`] |
//! | save a picture | `picture::image_file::write_picture` |
//! | shade the spans of your own rasterizer | [`shading::SpanShader`] |
//! | write a method | [`shading::Shader`], [`shading::walks`] |
//! | interpolate your own vertex attributes | [`frame::FrameBuilder::attributes`], [`shading::LightAt::attributes`] |
//! | get the correct picture | [`mod@reference`] |
//! | compare two pictures | [`compare::metrics`] |
//! | count the operations of a pixel | [`shading::Variant::operations`] |
//! | shade without a floating-point unit | [`integer`] |
//! | read scene files and pictures | `scene::file::SceneFile`, `picture::image_file` |
//!
//! Scenes and meshes use the vectors of `glam`, and pixel coordinates are fixed-point types of
//! `fixed`. Both crates are re-exported so that versions agree. A shader computes with
//! [`number::Vec3`], whose components may be blocks of pixels.
//!
//! # Limits
//!
//! - A picture has at most 16,384 samples a side ([`scene::Scene::MAX_SIDE`]); with one sample per
//!   pixel these are pixels.
//! - A scene has at most 64 lights ([`scene::Scene::MAX_LIGHTS`]). They cast no shadows.
//! - A mesh has at most 16 million polygons ([`mesh::PolygonMesh::MAX_POLYGONS`]).
//! - All surfaces are opaque. Alpha is the share of a pixel that polygons cover.
//! - No built-in method reads textures. A shader of your own can: `examples/texture.rs` is one.
//!
//! # Features
//!
//! `gltf`, `simd` and `threads` are the default.
//!
//! | feature | adds |
//! |---|---|
//! | none | [`integer`] only: `no_std`, no allocator, no floating-point unit |
//! | `alloc` | everything that needs no operating system, with the same bits on every platform: roots and other functions are from `libm` |
//! | `std` | square roots by the hardware |
//! | `io` | files: scenes (TOML), meshes (OBJ, STL, PLY, OFF), pictures (PNG, PPM, PFM) |
//! | `gltf` | glTF and GLB meshes |
//! | `threads` | rayon's current thread pool; pictures do not change |
//! | `simd` | AVX2, AVX-512 or NEON, chosen at run time |
//!
//! The crate needs Rust 1.95 or later. Only a minor release (0.x) raises this version.
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#[cfg(all(doctest, feature = "alloc"))]
#[doc = include_str!("../README.md")]
struct Readme;
#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub use fixed;
#[cfg(feature = "alloc")]
pub use glam;

/// How this crate was built. Times mean nothing without it.
pub mod build {
    /// The compiler, as in `rustc 1.95.0 (…)`, or `unknown`.
    pub const RUSTC: &str = env!("FASTPHONG_RUSTC");
    /// The kind of profile: `release` or `debug`.
    pub const PROFILE: &str = env!("FASTPHONG_PROFILE");
    /// The optimisation level: `0` to `3`, `s` or `z`.
    pub const OPT_LEVEL: &str = env!("FASTPHONG_OPT_LEVEL");
}
#[cfg(feature = "alloc")]
pub mod compare;
#[cfg(feature = "alloc")]
pub mod drawing;
#[cfg(feature = "alloc")]
pub mod frame;
pub mod integer;
#[cfg(feature = "io")]
#[doc(hidden)]
pub mod memory;
#[cfg(feature = "alloc")]
pub mod mesh;
#[cfg(feature = "alloc")]
pub mod note;
#[cfg(feature = "alloc")]
pub mod notes;
#[cfg(feature = "alloc")]
pub mod number;
#[cfg(feature = "alloc")]
pub mod picture;
#[cfg(feature = "alloc")]
pub mod raster;
#[cfg(feature = "alloc")]
pub mod reference;
#[cfg(feature = "alloc")]
pub mod scene;
#[cfg(feature = "alloc")]
pub mod shading;

/// Shared ownership and atomics, also on processors without compare-and-swap.
#[cfg(feature = "alloc")]
mod sync {
    #[cfg(target_has_atomic = "ptr")]
    pub use alloc::sync::Arc;
    #[cfg(target_has_atomic = "ptr")]
    pub use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
    #[cfg(not(target_has_atomic = "ptr"))]
    pub use portable_atomic::{AtomicBool, AtomicUsize, Ordering};
    #[cfg(not(target_has_atomic = "ptr"))]
    pub use portable_atomic_util::Arc;
}
