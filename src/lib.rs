//! Every way of making Phong shading fast, after *Lecture 21: Shading* (L21).
#![no_std]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub mod camera;
pub mod camera_fit;
pub mod lighting;
pub mod mesh;
pub mod picture;
pub mod scene;
pub mod suggest;
