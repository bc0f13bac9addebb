//! Pictures with mistakes, drawn by a renderer of their own.
//!
//! A command that says which mistake a student's picture shows is to be tested with pictures that
//! owe nothing to the code it is made of. So the renderer here takes only the data of a scene from
//! the crate ([`fastphong::scene::Scene`]), and does everything else itself, in `f64`, the way
//! students do: camera, normals, triangles, filling, light, grey levels. It shares no arithmetic
//! with the engines and the reference.
//!
//! [`draw::draw`] draws a scene with mistakes of the table [`mistakes::MISTAKES`], and with
//! variations that are none ([`variation::Variation`]). The tests prove that it is right without
//! mistakes, by the crate's reference, and that every mistake changes a shipped scene.
#![cfg(feature = "io")]

mod camera;
mod clip;
mod draw;
mod lighting;
mod mistakes;
mod named;
mod normals;
mod options;
mod picture;
mod placed;
mod proof;
mod raster;
mod scenes;
mod triangulate;
mod variation;
