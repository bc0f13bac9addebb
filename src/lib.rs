//! Phong shading on a scanline rasterizer: 38 methods to run, time, look at and check against an f64 reference.
//!
//! *Lecture 21: Shading* (L21) shades polygons on a scan-line rasterizer: flat, with vertex colours (Gouraud), with interpolated normals
//! (Phong), and then draws Phong's picture for a few additions per pixel. Each of these is a *method* here: one file and one
//! line of [`shading::METHODS`]. All methods draw the same [`frame::Frame`], so their pictures differ by shading and by nothing
//! else. Each is measured against a closed form in `f64` that shares no arithmetic with it.
//!
//! # From a mesh to a number
//!
//! ```
//! use fastphong::compare::metrics::compare;
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::reference::{self, Model};
//! use fastphong::scene::Scene;
//! use fastphong::shading::Variant;
//!
//! // A mesh: polygons of any number of sides. `mesh::read` reads them from files.
//! let mesh = builtin("teapot?res=6")?;
//! // A scene: the mesh, a camera that sees it, a light. All fields are public.
//! let mut scene = Scene::of_mesh(mesh);
//! (scene.width, scene.height) = (160, 120);
//! // A frame: the polygons that the camera sees, projected, clipped and checked.
//! let frame = scene.frame()?;
//! // A picture, by the lecture's fast method with one step of Newton's. All that can fail from here on is a method that is not for
//! // such a frame, and says why.
//! let fast = Variant::parse("fast-phong:steps=1")?.render(&frame)?;
//! // The reference picture, and the difference from it.
//! let exact = reference::render(&frame, Model::Phong).to_picture8();
//! let difference = compare(&exact, &fast)?;
//! assert_eq!(difference.coverage_mismatches, 0);
//! assert!(255.0 * difference.rms < 1.0, "less than a grey level");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where things are
//!
//! | for | items |
//! |---|---|
//! | pictures | [`picture::Picture`], [`picture::encoding`], `picture::image_file` |
//! | arithmetic | [`number::Num`]: scalar, SIMD or counting, behind one trait |
//! | shapes | [`mesh::builtin::builtin`], `mesh::read::load_mesh`, [`mesh::MeshBuilder`], [`mesh::vertex_normals`] (L21 1.1, 3.1) |
//! | scenes | [`scene::Scene::of_mesh`], [`scene::Camera`], [`scene::Light`], `scene::file::SceneFile`, `scene::input::load` |
//! | frames | [`frame::Frame`], the interface between geometry and shading: from [`scene::Scene::frame`], [`frame::PreparedScene`] for many frames, [`frame::FrameBuilder`] for polygons from elsewhere |
//! | the reference | [`mod@reference`]: four closed forms in `f64` |
//! | methods | [`shading::Variant::render`], [`shading::methods`], [`shading::METHODS`]; [`shading::Shader`] to add one from outside this crate |
//! | a window, a depth buffer of your own | [`shading::Variant::draw`] into a [`picture::PictureMut`] |
//! | a rasterizer of your own | [`shading::SpanShader`]: a method without an engine |
//! | numbers of your own at vertices | [`mesh::MeshBuilder::attributes`], [`frame::FrameBuilder::attributes`], [`shading::Lit::attributes`] |
//! | engines | [`raster`]: scan lines as in the lecture, SIMD rows, barycentric coordinates to compare with |
//! | a processor without a floating-point unit | [`integer`]: spans and triangles in fixed point |
//! | errors, times | [`compare::metrics::compare`], [`compare::metrics::difference_map`], [`shading::Variant::operations`] |
//!
//! Vectors of scenes and meshes are those of [`glam`], coordinates on the picture numbers of [`fixed`]: both are re-exported, so that
//! versions agree. A shader computes with [`number::Vec3`], whose components may be blocks of pixels.
//!
//! # Features
//!
//! Without features the crate is [`integer`] alone: `no_std` without an allocator, for processors without a floating-point unit.
//! `alloc` adds all else that needs no operating system: no files, no clocks, and the same bits on every platform, as all
//! functions beyond + − × ÷ and the root are from `libm`. `std` takes roots from the hardware. `io` reads and writes
//! files: scenes (TOML), meshes (OBJ, STL, PLY, OFF; glTF with the feature `gltf`), pictures (PNG, PPM, PFM). `threads` works on several threads, those of rayon's
//! current pool, and changes no bit. `cli`, the default, is the command-line tool, and `view` adds its
//! window.
#![no_std]
#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

pub use fixed;
#[cfg(feature = "alloc")]
pub use glam;

#[cfg(feature = "alloc")]
pub mod compare;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod diagnose;
#[cfg(feature = "alloc")]
pub mod frame;
pub mod integer;
#[cfg(feature = "lectures")]
#[doc(hidden)]
pub mod lectures;
#[cfg(feature = "alloc")]
pub mod mesh;
#[cfg(feature = "alloc")]
pub mod number;
#[cfg(feature = "alloc")]
pub mod picture;
#[cfg(feature = "alloc")]
pub mod raster;
#[cfg(feature = "alloc")]
pub mod reference;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod report;
#[cfg(feature = "alloc")]
pub mod scene;
#[cfg(feature = "alloc")]
pub mod shading;
// Its tests need no display: they run with all others.
#[cfg(any(feature = "view", all(test, feature = "cli")))]
#[doc(hidden)]
pub mod view;

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
