//! Pictures with mistakes, drawn by a separate renderer.
//!
//! `fastphong diagnose` says which mistake a student's picture shows. Its tests need pictures that
//! do not come from its own code. So the renderer here uses only the data of a scene from the crate
//! ([`fastphong::scene::Scene`]). It does everything else itself, in `f64` and the way students do:
//! camera, normals, triangles, filling, light, grey levels. It shares no arithmetic with the
//! engines or the reference.
//!
//! [`draw::draw`] draws a scene with mistakes of the table [`mistakes::MISTAKES`] and with
//! variations that are not mistakes ([`variation::Variation`]). The tests compare it with the
//! crate's reference to prove that it is right without mistakes, and prove that every mistake
//! changes a shipped scene.

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
mod sets;
mod triangulate;
mod variation;
