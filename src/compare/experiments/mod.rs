//! Experiments: measurements of a whole report beside its scenes, on spheres.
//!
//! - [`Speedups`]: speeds of all methods as multiples of naive Phong's, in scalar and SIMD arithmetic, shading alone and in
//!   a whole frame: the gain of fast Phong when it was invented, and today.
//! - [`Scaling`]: the growth of a frame's time with triangles and with pixels, and the costs of a vertex, a triangle, a
//!   span and a pixel.
//!
//! - [`climb`]: the triangle and lights on which a method errs most.
//!
//! The first two time on the threads of rayon's current pool: one, where times are to be compared with others.

mod fit;
mod scaling;
mod speedups;
#[cfg(test)]
mod tests;
mod worst;

pub use fit::{Observation, fit};
pub use scaling::{Costs, Curve, Scaling, ScalingOptions, ScalingPoint};
pub use speedups::{MethodSpeedups, SpeedCorner, Speedup, SpeedupOptions, Speedups, Work};
pub use worst::{SearchSetting, WorstCase, climb};

use super::comparison::with_baseline;
use super::timing::Candidate;
use crate::frame::{Frame, FrameError, PreparedScene};
use crate::mesh::builtin::{BuiltinError, builtin};
use crate::picture::Picture8;
use crate::raster::{DrawError, DrawOptions, Renderer};
use crate::scene::Scene;
use crate::shading::{METHODS, Variant};
use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::fmt;
use core::hint::black_box;

/// The reason why an experiment could not be made: its mesh or its picture.
#[derive(Clone, Debug, thiserror::Error)]
#[error(transparent)]
pub enum ExperimentError {
    /// There is no mesh of so many polygons.
    Mesh(#[from] BuiltinError),
    /// There is no picture of that size.
    Frame(#[from] FrameError),
    /// A method is not for the experiment's frames.
    Draw(#[from] DrawError),
}

/// Returns the name of a sphere of about so many triangles, without `builtin:`.
fn sphere(triangles: impl fmt::Display) -> String {
    format!("sphere?polygons={triangles}&triangles=true")
}

/// Prepares a sphere for frames of a size; mesh and scene are gone then.
fn prepared_sphere(
    triangles: usize,
    [width, height]: [u32; 2],
) -> Result<PreparedScene, ExperimentError> {
    let mut scene = Scene::of_mesh(builtin(&sphere(triangles))?);
    (scene.width, scene.height) = (width, height);
    Ok(scene.prepare()?)
}

/// The memory of a frame and of its picture, which all that is timed on one scene share.
struct Canvas(RefCell<(Frame, Picture8)>);

impl Canvas {
    fn new(scene: &PreparedScene) -> Result<Canvas, FrameError> {
        let frame = scene.frame()?;
        let picture = Picture8::new(frame.picture_width(), frame.picture_height(), [0; 4]);
        Ok(Canvas(RefCell::new((frame, picture))))
    }

    /// Returns a candidate that projects the scene, and draws it if a `method` is given.
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

/// Returns those of `names` that are among `variants`, and naive Phong in any case, with their default parameters.
fn chosen(names: &[&str], variants: &[Variant]) -> Vec<Variant> {
    let variants = with_baseline(variants);
    let is_asked = |name: &str| {
        let mut same = variants.iter().filter(|v| v.info().name == name);
        names.contains(&name) && same.any(Variant::is_default)
    };
    let entries = METHODS.iter().filter(|entry| is_asked(entry.info.name));
    entries.map(|entry| entry.variant()).collect()
}
