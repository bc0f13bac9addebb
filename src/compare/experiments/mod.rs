//! Studies: what a whole report says beside its scenes, measured on meshes of its own.
//!
//! - [`Speedups`]: how many times as fast as naive Phong each method is, in scalar and in wide arithmetic, where it shades
//!   alone and in a whole frame: what fast Phong gained when it was invented, and what is left of it.
//! - [`Scaling`]: how the time of a frame grows with triangles and with pixels, and what a vertex, a triangle, a span and a
//!   pixel cost.
//!
//! Both time on the threads of rayon's current pool: one, where times are to be compared with others.

mod fit;
mod scaling;
mod speedups;
#[cfg(test)]
mod tests;

pub use fit::{Observation, fit};
pub use scaling::{Axis, Costs, Curve, Point, Scaling, ScalingOptions};
pub use speedups::{Corner, MethodSpeedups, Speedup, SpeedupOptions, Speedups, Work};

use super::comparison::BASELINE;
use super::timing::Candidate;
use crate::frame::{Frame, FrameError, PreparedScene};
use crate::mesh::builtin::{BuiltinError, builtin};
use crate::picture::Picture8;
use crate::raster::Renderer;
use crate::scene::Scene;
use crate::shading::{METHODS, Variant};
use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::fmt;
use core::hint::black_box;

/// What the time of a whole frame holds, in one line.
pub const WHAT_A_FRAME_IS: &str = "from the prepared scene to the stored picture in RGBA8, in the memory of the frame \
                                   before: projection, culling, vertex lighting, rasterization, shading and storing; on \
                                   one thread; not vertex normals";

/// Why a study could not be made: the mesh or the picture it is measured on refused.
#[derive(Clone, Debug, thiserror::Error)]
#[error(transparent)]
pub enum StudyError {
    /// There is no mesh of so many polygons.
    Mesh(#[from] BuiltinError),
    /// There is no picture of that size.
    Frame(#[from] FrameError),
}

/// The sphere of about so many triangles, as one names it on the command line without `builtin:`.
fn sphere(triangles: impl fmt::Display) -> String {
    format!("sphere?polygons={triangles}&triangles=true")
}

/// A scene ready for frames of `size`; mesh and scene are gone then.
fn prepared_sphere(
    triangles: usize,
    [width, height]: [u32; 2],
) -> Result<PreparedScene, StudyError> {
    let mut scene = Scene::of_mesh(builtin(&sphere(triangles))?);
    (scene.width, scene.height) = (width, height);
    Ok(scene.prepare()?)
}

/// The memory of a frame and of its picture, which all that is timed on one scene share.
struct Canvas(RefCell<(Frame, Picture8)>);

impl Canvas {
    fn new(scene: &PreparedScene) -> Result<Canvas, FrameError> {
        Ok(Canvas(RefCell::new((
            scene.frame()?,
            Picture8::new(0, 0, [0; 4]),
        ))))
    }

    /// Projects the scene.
    fn projects<'a>(&'a self, scene: &'a PreparedScene) -> Candidate<'a> {
        Box::new(move || {
            let (frame, _) = &mut *self.0.borrow_mut();
            black_box(scene)
                .frame_into(frame)
                .expect("a scene that was projected before");
            black_box(frame);
        })
    }

    /// Projects the scene and draws it.
    fn draws<'a>(
        &'a self,
        scene: &'a PreparedScene,
        variant: &'a Variant,
        renderer: Renderer,
    ) -> Candidate<'a> {
        Box::new(move || {
            let (frame, picture) = &mut *self.0.borrow_mut();
            black_box(scene)
                .frame_into(frame)
                .expect("a scene that was projected before");
            variant.render_with(frame, renderer, picture);
            black_box(picture);
        })
    }
}

/// `variants`, after naive Phong if that is not among them.
fn with_baseline(variants: &[Variant]) -> Vec<Variant> {
    crate::compare::comparison::with_baseline(variants)
}

/// Those of `names` that are among `variants`, and naive Phong in any case, with their default parameters.
fn chosen(names: &[&str], variants: &[Variant]) -> Vec<Variant> {
    let is_asked = |name: &str| {
        name == BASELINE
            || variants
                .iter()
                .any(|v| v.info().name == name && v.is_default())
    };
    let entries = METHODS
        .iter()
        .filter(|entry| names.contains(&entry.info.name) && is_asked(entry.info.name));
    entries.map(|entry| entry.variant()).collect()
}
