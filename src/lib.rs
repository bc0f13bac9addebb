//! Every way of making Phong shading fast, after *Lecture 21: Shading* (L21).
//!
//! The lecture shades polygons on a scan-line rasterizer: flat, with vertex colours (Gouraud), with interpolated normals
//! (Phong), and then Phong's picture for the price of a few additions. Each of these is a *method* here, one file and one
//! line of [`shading::METHODS`]; all of them draw the same [`frame::Frame`], so that their pictures differ by shading and by
//! nothing else, and each is measured against a closed form in `f64` that shares no arithmetic with it.
//!
//! # From a mesh to a number
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::metrics::compare;
//! use fastphong::reference::{self, Model};
//! use fastphong::scene::Scene;
//! use fastphong::shading::Variant;
//!
//! // A mesh: polygons of any number of sides. `mesh::obj` reads them from files.
//! let mesh = builtin("teapot?res=6")?;
//! // A scene: the mesh, a camera that sees it, a light. All fields are there to be changed.
//! let mut scene = Scene::of_mesh(mesh);
//! (scene.width, scene.height) = (160, 120);
//! // A frame: what the camera sees, projected and clipped. From here on nothing can fail.
//! let frame = scene.frame()?;
//! // A picture, by the lecture's fast method with one step of Newton's.
//! let fast = Variant::parse("fast-phong:steps=1")?.render(&frame);
//! // What it should be, and how far it is from that.
//! let exact = reference::render(&frame, Model::Phong).to_picture8();
//! let difference = compare(&exact, &fast)?;
//! assert_eq!(difference.coverage_mismatches, 0);
//! assert!(255.0 * difference.rms < 1.0, "less than a grey level");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where things are
//!
//! | step | items |
//! |---|---|
//! | shapes | [`mesh::builtin::builtin`], `mesh::obj::load_obj`, [`mesh::MeshBuilder`], [`mesh::vertex_normals`] (L21 1.1, 3.1) |
//! | scenes | [`scene::Scene::of_mesh`], [`scene::Scene::frame`], [`projection::PreparedScene`] for many frames, `scene::file::SceneFile`, `input::load` |
//! | the waist | [`frame::Frame`], and [`frame::FrameBuilder`] for polygons from elsewhere |
//! | methods | [`shading::Variant::render`], [`shading::METHODS`]; [`shading::Shader`] to add one from outside this crate |
//! | loops | [`raster`]: scan lines as in the lecture, barycentric coordinates to compare with |
//! | truth | [`mod@reference`]: four closed forms in `f64` |
//! | numbers | [`metrics::compare`], [`metrics::difference_map`], [`shading::Variant::operations`], `comparison` |
//! | files | `image_file` |
//!
//! # Features
//!
//! Without features the crate is `no_std` (with `alloc`): no files, no clocks, and the same bits on every platform, as all
//! functions beyond + − × ÷ and the root are from `libm`. `std` takes roots from the hardware. `io` reads and writes
//! files: scenes (TOML), meshes (OBJ), pictures (PNG, PPM, PFM). `threads` works on several threads, those of rayon's
//! current pool, and changes no bit. `cli`, the default, is the command-line tool.
#![no_std]
extern crate alloc;
#[cfg(any(feature = "std", test))]
extern crate std;

#[cfg(feature = "cli")]
pub mod bench;
pub mod camera;
pub mod camera_fit;
mod clip;
#[cfg(feature = "cli")]
pub mod comparison;
pub mod cs171;
pub mod encoding;
#[cfg(feature = "cli")]
pub mod figures;
pub mod frame;
#[cfg(feature = "io")]
pub mod image_file;
#[cfg(feature = "io")]
pub mod input;
pub mod lighting;
pub mod mesh;
pub mod metrics;
pub mod number;
pub mod painter;
mod parallel;
pub mod perspective;
pub mod picture;
pub mod projection;
pub mod raster;
pub mod reference;
#[cfg(feature = "cli")]
pub mod report;
pub mod scene;
pub mod shading;
#[cfg(feature = "cli")]
pub mod study;
pub mod suggest;
pub mod triangulate;

#[cfg(test)]
mod test_random;
