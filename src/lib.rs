//! Every way of making Phong shading fast, after *Lecture 21: Shading* (L21).
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
pub mod encoding;
pub mod frame;
#[cfg(feature = "io")]
pub mod image_file;
pub mod lighting;
pub mod mesh;
pub mod metrics;
pub mod number;
pub mod picture;
mod projection;
pub mod raster;
pub mod reference;
pub mod scene;
pub mod shader;
pub mod suggest;
pub mod triangulate;
pub mod walk;

#[cfg(test)]
mod test_random;
