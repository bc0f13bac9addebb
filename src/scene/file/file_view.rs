//! The camera and lights of a mesh file that is drawn without a scene file.

use super::SceneFile;
#[cfg(feature = "gltf")]
use super::value::SceneTable;
#[cfg(feature = "gltf")]
use crate::mesh::read::{FileLens, FileLight, FileView};
use crate::note::{Note, Setting};
#[cfg(feature = "gltf")]
use crate::scene::ranges::{COORDINATE, FOVY, HALF_HEIGHT};
use std::format;
use std::string::String;
#[cfg(feature = "gltf")]
use std::vec::Vec;

impl SceneFile {
    /// Adopts the camera and lights of a mesh file, as far as a scene can have them.
    #[cfg(feature = "gltf")]
    pub(in crate::scene) fn see_as(&mut self, view: &FileView) {
        let mut text = String::new();
        let left_out = view.left_out.iter().cloned();
        self.notes.append(
            left_out
                .map(|text| Note::remark("view-left-out", text))
                .collect(),
        );
        if let Some(camera) = view.camera {
            let is_near = COORDINATE.holds_all(camera.eye) && COORDINATE.holds_all(camera.target);
            let (key, size, range) = match camera.lens {
                FileLens::Fovy(fovy) => ("fovy", fovy, FOVY),
                FileLens::HalfHeight(half) => ("half_height", half, HALF_HEIGHT),
            };
            if is_near && range.holds(size) {
                let [eye, target, up] =
                    [camera.eye, camera.target, camera.up].map(|v| v.to_array());
                text = format!(
                    "camera = {{ eye = {eye:?}, target = {target:?}, up = {up:?}, {key} = {size:?} }}\n"
                );
            } else {
                let text = format!(
                    "the file's camera is left out: expected coordinates up to 1e15 and a `{key}` of {}",
                    range.expected
                );
                self.notes.push(Note::remark("view-left-out", text));
            }
        }
        let is_near = |light: &&FileLight| COORDINATE.holds_all(light.place);
        let lights: Vec<String> = view.lights.iter().filter(is_near).map(table).collect();
        if lights.len() < view.lights.len() {
            let text = "lights of the file are left out: expected coordinates up to 1e15";
            self.notes.push(Note::remark("view-left-out", text));
        }
        if !lights.is_empty() {
            text += &format!("light = [{}]\n", lights.join(", "));
        }
        if let Ok(table) = SceneTable::parse(&text) {
            self.of_mesh_file = table.clone();
            self.overlay(table);
        }
    }

    /// True if the scene still has the lights of the mesh file.
    #[doc(hidden)]
    pub fn has_lights_of_mesh_file(&self) -> bool {
        let lights = self.of_mesh_file.get("light");
        lights.is_some() && lights == self.table.get("light")
    }

    /// True if the eye and its direction are still those of the mesh file's camera.
    fn has_camera_of_mesh_file(&self) -> bool {
        let (Some(given), Some(camera)) = (
            self.of_mesh_file.table("camera"),
            self.table.table("camera"),
        ) else {
            return false;
        };
        let is_same = |key: &&str| camera.get(key) == given.get(key);
        ["eye", "target", "up"].iter().all(is_same) && camera.get("fit").is_none()
    }

    /// Says in a sentence what the scene still has of the mesh file's camera and lights.
    pub(super) fn view_note(&self) -> Option<Note> {
        let seen = self.has_camera_of_mesh_file().then(|| {
            Note::remark("view-of-file", "seen by the file's own camera (")
                .set(Setting::number("camera.azimuth", "27,15"))
                .say(" or other angles fit the mesh instead)")
        });
        if !self.has_lights_of_mesh_file() {
            return seen;
        }
        let lit = match self.table.tables("light").len() {
            1 => String::from("lit by its light"),
            count => format!("lit by its {count} lights"),
        };
        Some(match seen {
            Some(note) => note.say(", ").say(lit),
            None => Note::remark("view-of-file", lit),
        })
    }
}

/// Returns a light as TOML.
#[cfg(feature = "gltf")]
fn table(light: &FileLight) -> String {
    let colour = light.colour;
    match light.toward {
        Some(toward) => {
            let toward = toward.to_array();
            format!("{{ direction = {toward:?}, colour = {colour:?} }}")
        }
        None => {
            let place = light.place.to_array();
            format!("{{ position = {place:?}, colour = {colour:?}, falloff = 'inverse-square' }}")
        }
    }
}
