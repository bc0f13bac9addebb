//! From an input and the settings laid over it to a scene: one way for the program, the Python
//! package and the page.
//!
//! ```
//! use fastphong::scene::open::{Look, Overlay, open};
//!
//! let opened = open("builtin:cube", &Overlay::default(), Look::Shown)?;
//! assert_eq!(opened.scene.lights.len(), 2);
//! assert!(opened.notes.is_empty());
//! # Ok::<(), fastphong::scene::file::SceneError>(())
//! ```

use super::Scene;
pub use super::file::Overlay;
use super::file::resolve::MeshResult;
use super::file::{BUILTIN, SceneError, SceneFile, View};
use super::input;
use crate::note::{Note, Notes, Setting};
use glam::DVec3;
use std::io;
use std::path::Path;
use std::vec::Vec;

/// How a mesh without a scene file looks. Scene files look as they say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Look {
    /// As a mesh shows best: two lights, clay or the mesh's own materials, a dark background, sRGB,
    /// and 2 × 2 samples per pixel if they cost little.
    #[default]
    Shown,
    /// As comparisons need it: one white light, linear levels, one sample per pixel.
    Compared,
}

impl SceneFile {
    /// True if the input is a mesh without a scene file.
    pub fn is_mesh_alone(&self) -> bool {
        self.path().is_none()
    }

    /// True if the scene states that every pixel gets full alpha.
    pub fn is_opaque(&self) -> bool {
        let image = self.table().table("image");
        image.and_then(|image| image.text("alpha")) == Some("opaque")
    }

    /// Lays `over` over the file, loads its meshes and returns the scene. `load_mesh` is as for
    /// [`SceneFile::resolve`].
    ///
    /// # Errors
    /// As for [`SceneFile::resolve`].
    pub fn open(
        mut self,
        over: &Overlay,
        look: Look,
        load_mesh: impl FnMut(&str, &Path) -> MeshResult,
    ) -> Result<Opened, SceneError> {
        let has_rig = look == Look::Shown && self.is_mesh_alone();
        if has_rig {
            self.take_studio();
        }
        self.lay_over(over);
        let resolved = self.resolve(load_mesh)?;
        self.overlay(resolved.chosen);
        let (mut scene, mut notes) = (resolved.scene, resolved.notes);
        add_notes(&self, &scene, over, &mut notes);
        let polygons = scene.objects.iter().map(|o| o.mesh.polygon_count()).sum();
        let views = Views {
            file: self,
            rig_for: has_rig.then_some(polygons),
        };
        let mut file = views.file.clone();
        if has_rig {
            file.take_rig(&scene.camera, [scene.width, scene.height], polygons);
            (scene.lights, scene.samples) = file.lights_and_samples()?;
        }
        Ok(Opened {
            file,
            scene,
            notes,
            views,
        })
    }
}

/// Adds the notes that depend on what was laid over a scene.
fn add_notes(file: &SceneFile, scene: &Scene, over: &Overlay, notes: &mut Notes) {
    if over.every_object.get("material").is_some()
        && scene.objects.iter().any(|o| !o.mesh.materials().is_empty())
    {
        let text = "the material that is set replaces those of the mesh file";
        notes.push(Note::remark("material-replaced", text));
    }
    for object in &scene.objects {
        let name = &object.name;
        if !scene.colours && !object.mesh.colours().is_empty() && !name.starts_with(BUILTIN) {
            let note = Note::remark("colours-unused", "has vertex colours, which are not used: ")
                .set(Setting::word("colours", "on"))
                .say(" uses them");
            notes.push(note.about(name));
        }
        let is_open = file.is_mesh_alone() && !over.sets("camera.up");
        if is_open && let Some(note) = object.mesh.up_note() {
            notes.push(note.about(name));
        }
    }
}

/// Opens the input that `name` names: a scene file, a mesh file, a built-in mesh or a shipped
/// scene.
///
/// # Errors
/// [`SceneError`] if there is no such input, a value is out of its range, or a mesh cannot be used.
pub fn open(name: &str, over: &Overlay, look: Look) -> Result<Opened, SceneError> {
    open_by(input::load(name)?, over, look, &mut input::read_input)
}

/// Opens `file`. `read` returns the contents of meshes and material libraries. It is also called
/// for files that do not exist.
///
/// # Errors
/// As for [`open`].
pub fn open_by(
    file: SceneFile,
    over: &Overlay,
    look: Look,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Opened, SceneError> {
    file.open(over, look, |name, folder| {
        input::load_mesh_by(name, folder, read)
    })
}

/// A scene that was opened.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Opened {
    /// The scene as a scene file states it, with everything that was laid over it and chosen for
    /// it. Printed, it draws the same picture.
    pub file: SceneFile,
    /// The scene.
    pub scene: Scene,
    /// What to know about it. [`crate::notes`] adds what needs a frame.
    pub notes: Notes,
    /// Other views of the scene.
    pub views: Views,
}

/// Makes other views of a scene that was opened, without its meshes.
#[derive(Clone, Debug)]
pub struct Views {
    /// The scene file, without the lights and samples of the rig.
    file: SceneFile,
    /// The count of polygons, if the scene has the light rig.
    rig_for: Option<usize>,
}

impl Views {
    /// Returns the view that the scene has with `over` laid over it. `points` are the scene's
    /// [`Scene::world_points`]. The lights of the rig follow the camera.
    ///
    /// # Errors
    /// [`SceneError`] if a value is out of its range.
    pub fn view(&self, over: &Overlay, points: &[DVec3]) -> Result<View, SceneError> {
        let mut file = self.file.clone();
        file.lay_over(over);
        let mut view = file.view(points)?;
        if let Some(polygons) = self.rig_for {
            file.take_rig(&view.camera, [view.width, view.height], polygons);
            (view.lights, view.samples) = file.lights_and_samples()?;
        }
        Ok(view)
    }
}
