//! Experiments of a report, beside its scenes.
//!
//! - `Speedups` measures how much faster all methods are than naive Phong, in scalar and SIMD
//!   arithmetic, for shading only and for whole frames: the gain of fast Phong when it was
//!   invented, and today.
//! - `Scaling` measures how the time of a frame grows with triangles and with pixels.
//! - `climb` searches for the triangle and lights on which a method has the largest error.
//!
//! The first two use the threads of rayon's current pool. It should have one thread if the times
//! are to be compared with others.

mod scaling;
mod speedups;
#[cfg(test)]
mod tests;
mod worst;

pub(crate) use scaling::{Scaling, ScalingOptions};
#[cfg(test)]
pub(crate) use speedups::{MethodSpeedups, SpeedCorner, Speedup, Work};
pub(crate) use speedups::{SpeedupOptions, Speedups};
pub use worst::WorstCase;
pub(crate) use worst::{SearchSetting, climb};

use super::comparison::with_baseline;
use super::timing::{Candidate, Clock};
use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::fmt;
use core::hint::black_box;
use fastphong::frame::{Frame, FrameError, PreparedScene};
use fastphong::mesh::builtin::{BuiltinError, builtin};
use fastphong::picture::Picture8;
use fastphong::raster::{DrawError, DrawOptions, Renderer};
use fastphong::scene::Scene;
use fastphong::shading::{METHODS, Variant};

/// An error of an experiment.
#[derive(Clone, Debug, thiserror::Error)]
#[error(transparent)]
pub enum ExperimentError {
    /// A sphere of that size cannot be made.
    Mesh(#[from] BuiltinError),
    /// The sphere cannot be projected onto a picture of that size.
    Frame(#[from] FrameError),
    /// A method cannot draw the frames of the experiment.
    Draw(#[from] DrawError),
}

/// Returns the name of a sphere with about this many triangles, without `builtin:`.
fn sphere(triangles: impl fmt::Display) -> String {
    format!("sphere?polygons={triangles}&triangles=true")
}

/// Prepares a sphere for frames of a size. The mesh and the scene are dropped.
fn prepared_sphere(
    triangles: usize,
    [width, height]: [u32; 2],
) -> Result<PreparedScene, ExperimentError> {
    let mut scene = Scene::of_mesh(builtin(&sphere(triangles))?);
    (scene.width, scene.height) = (width, height);
    Ok(scene.prepare()?)
}

/// The memory for a frame and its picture, shared by all candidates that are timed on one scene.
struct Canvas(RefCell<(Frame, Picture8)>);

impl Canvas {
    fn new(scene: &PreparedScene) -> Result<Canvas, FrameError> {
        let frame = scene.frame()?;
        let picture = Picture8::new(frame.picture_width(), frame.picture_height(), [0; 4]);
        Ok(Canvas(RefCell::new((frame, picture))))
    }

    /// Returns a candidate that projects the scene, and draws it if there is a `method`.
    fn draws<'a>(
        &'a self,
        scene: &'a PreparedScene,
        method: Option<(&'a Variant, Renderer)>,
    ) -> Candidate<'a> {
        Box::new(move || {
            let (frame, picture) = &mut *self.0.borrow_mut();
            let projected = black_box(scene).frame_into(frame);
            projected.expect("a scene that was projected before");
            if let Some((variant, renderer)) = method {
                let drawn = variant.draw(frame, &mut *picture, DrawOptions::by(renderer));
                drawn.expect("a picture of the scene's size, and a method for it");
            }
            black_box((frame, picture));
        })
    }
}

/// Returns the clock for work on the current pool of threads.
fn clock() -> Clock {
    Clock::new(rayon::current_num_threads())
}

/// Returns the methods of `names` that are among `variants` with default parameters. Adds naive
/// Phong to `variants` first.
fn chosen(names: &[&str], variants: &[Variant]) -> Vec<Variant> {
    let variants = with_baseline(variants);
    let is_asked = |name: &str| {
        let mut same = variants.iter().filter(|v| v.info().name == name);
        names.contains(&name) && same.any(Variant::is_default)
    };
    let entries = METHODS.iter().filter(|entry| is_asked(entry.info.name));
    entries.map(|entry| entry.variant()).collect()
}
