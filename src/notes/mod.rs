//! What to know about a frame and its meshes: what the picture does not show of its scene, and what
//! may look unexpected.
//!
//! The notes of a scene itself come with it ([`Opened::notes`](crate::scene::open::Opened::notes)).
//! Nothing here is computed unless somebody asks, so a renderer at 60 Hz pays nothing.
//!
//! **To add a note about frames**, write a function that takes a `DrawnScene` and pushes to
//! [`Notes`], call it in [`of_frame`], and add a row to `tests/doors.json`. The program, the Python
//! package and the page then show it.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::notes::{Cost, of_frame};
//! use fastphong::scene::Scene;
//!
//! let mut scene = Scene::of_mesh(builtin("cube")?);
//! scene.lights.clear();
//! scene.ambient = [0.0; 3];
//! let notes = of_frame(&scene, &scene.frame()?, Cost::Counts);
//! let black = "there is no light, and no ambient light: everything visible is black";
//! assert_eq!(notes.to_string(), black);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod clamped;
mod depth;
mod drawn_scene;
mod left_out;
mod mesh_hints;
mod painter;
mod unlit;

pub use left_out::of_polygons;
pub use mesh_hints::{lies_on_its_side, of_mesh, of_meshes};

use crate::frame::Frame;
use crate::note::{Note, Notes, Setting};
use crate::number::counted::part_of;
use crate::scene::{HiddenSurfaces, Projection, Scene};
use alloc::borrow::ToOwned;
use drawn_scene::DrawnScene;
use glam::DVec3;

/// How much may be computed for notes about a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Passes over the polygons of the frame: less than drawing it.
    Counts,
    /// Passes over the samples, too: as much as drawing it with the reference.
    Samples,
}

/// Returns the notes about `frame`, which shows `scene`: polygons left out, light that is clamped
/// or reaches nothing, depths that rounding cannot tell apart.
///
/// `frame` must be made from this scene ([`Scene::frame`]), or from the scene with other settings
/// but the same objects.
pub fn of_frame(scene: &Scene, frame: &Frame, cost: Cost) -> Notes {
    let drawn = DrawnScene::new(scene, frame);
    let mut notes = of_polygons(frame, cost);
    if cost == Cost::Samples {
        clamped::too_bright(&drawn, &mut notes);
    }
    unlit::unlit(&drawn, &mut notes);
    eye_beyond(&drawn, &mut notes);
    if cost == Cost::Samples {
        depth::ties(frame, &mut notes);
        if matches!(frame.hidden_surfaces(), HiddenSurfaces::Painter(_)) {
            painter::wrong_order(frame, &mut notes);
        }
    }
    depth::screen_interpolation(frame, &mut notes);
    notes
}

/// Warns if the eye of a parallel view with a local viewer stands behind visible polygons.
fn eye_beyond(drawn: &DrawnScene, notes: &mut Notes) {
    let (scene, frame) = (drawn.scene, drawn.frame);
    let is_parallel = matches!(scene.camera.projection, Projection::Orthographic { .. });
    if !scene.local_viewer || !is_parallel {
        return;
    }
    let [_, _, forward] = scene.camera.axes();
    let from_eye = DVec3::from_array(frame.origin()) - scene.camera.eye;
    let is_beyond = |corner: &u32| {
        let position = DVec3::from_array(frame.position(*corner).map(f64::from));
        frame.clip_corner(*corner).is_none() && forward.dot(position + from_eye) < 0.0
    };
    let polygons = frame.polygons().iter();
    let beyond = polygons.filter(|polygon| frame.corners(polygon).iter().any(is_beyond));
    let all = frame.polygons().len();
    let which = match beyond.count() {
        0 => return,
        n if n == all => "everything that is visible".to_owned(),
        n => part_of(n, all, "polygon"),
    };
    let local = Setting::word("viewer", "local");
    let note = Note::warning("eye-beyond", "the eye stands beyond ")
        .say(which)
        .say(": a parallel view also shows what is behind its eye, but ")
        .set(local.clone())
        .say(" computes highlights as seen from the eye; move the eye back, or leave out ")
        .set(local);
    notes.push(note);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::builtin::builtin;
    use crate::mesh::{MeshBuilder, PolygonMesh};
    use crate::scene::Light;
    use alloc::string::ToString;
    use alloc::vec::Vec;
    use glam::Vec3;

    /// Returns the mesh of polygons with these corners, over four positions in the plane z = 0. The
    /// last lies between the first two.
    fn mesh(polygons: &[&[u32]]) -> PolygonMesh {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0]];
        let position = |[x, y]: [f32; 2]| Vec3::new(x, y, 0.0);
        let mut builder = MeshBuilder::new(corners.map(position).to_vec());
        for polygon in polygons {
            builder.polygon(polygon);
        }
        builder.finish().expect("a mesh")
    }

    /// A program that builds its scene without a file learns what users of files learn.
    #[test]
    fn scenes_that_a_program_builds_have_all_notes() {
        let cube = || Scene::of_mesh(builtin("cube").expect("a cube"));
        let triangle = || Scene::of_mesh(mesh(&[&[0, 1, 2]]));
        let lit_from = |place: [f64; 3]| {
            let mut scene = triangle();
            let toward = DVec3::from_array(place).normalize();
            scene.lights = Vec::from([Light::directional(toward, [1.0; 3])]);
            scene
        };
        let mut dark = lit_from([0.0, 0.0, 1.0]);
        dark.lights[0].colour = [1e-9; 3];
        let mut bright = lit_from([0.0, 0.0, 1.0]);
        bright.lights[0].colour = [9.0; 3];
        let mut turned = cube();
        turned.camera.target = 2.0 * turned.camera.eye - turned.camera.target;
        for (name, scene, told) in [
            ("right", cube(), ""),
            ("empty", Scene::of_mesh(mesh(&[])), "there is no polygon"),
            (
                "without area",
                Scene::of_mesh(mesh(&[&[0, 1, 3]])),
                "has no area",
            ),
            (
                "doubled",
                Scene::of_mesh(mesh(&[&[0, 1, 2], &[1, 2, 0]])),
                "earlier one",
            ),
            ("out of view", turned, "nothing is drawn"),
            ("lit from behind", lit_from([0.0, 0.0, -1.0]), "face away"),
            ("too dark", dark, "too dark to show"),
            ("too bright", bright, "is clamped"),
        ] {
            let notes = of_frame(&scene, &scene.frame().expect("a frame"), Cost::Samples);
            assert!(notes.to_string().contains(told), "{name}: {notes}");
            assert_eq!(notes.is_empty(), told.is_empty(), "{name}: {notes}");
        }
    }
}
