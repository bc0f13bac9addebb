//! The keys of a scene that Python passes, under the names of Python's arguments.

use crate::errors::value_error;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, SceneTable};
use pyo3::PyResult;

/// Keys and the arguments that set them. Messages name a key by its argument.
const ARGUMENTS: &[(&str, &str)] = &[
    ("camera.azimuth", "view"),
    ("camera.direction", "view"),
    ("camera.elevation", "view"),
    ("camera.fovy", "fovy"),
    ("camera.up", "up"),
    ("image.background", "background"),
    ("image.height", "size"),
    ("image.samples", "samples"),
    ("image.width", "size"),
    ("light.direction", "light"),
    ("object.crease", "normals"),
    ("object.normals", "normals"),
    ("object.normals_weight", "weight"),
];

/// Keys that override those of a scene.
#[derive(Default)]
pub struct Settings {
    over: SceneTable,
    /// The keys that every object gets.
    every_object: SceneTable,
}

impl Settings {
    /// Reads keys as they stand in a scene file. An object among them stands for all objects.
    pub fn parse(text: &str) -> PyResult<Settings> {
        let mut over = SceneTable::parse(text).map_err(value_error)?;
        name_arguments(&mut over, "");
        let mut every_object = SceneTable::default();
        if let Some(objects) = over.entries.remove("object")
            && let Data::Tables(objects) = objects.data
        {
            every_object = objects.into_iter().next().unwrap_or_default();
            every_object.entries.remove("mesh");
        }
        Ok(Settings { over, every_object })
    }

    /// True if there is no key.
    pub fn is_empty(&self) -> bool {
        self.over.entries.is_empty() && self.every_object.entries.is_empty()
    }

    /// Overrides the keys of a scene.
    pub fn lay_over(self, file: &mut SceneFile) {
        file.overlay(self.over);
        let is_source = |key: &&str| matches!(*key, "normals" | "crease");
        let gives_source = self.every_object.entries.keys().any(is_source);
        for object in file.objects_mut() {
            if gives_source {
                object.entries.retain(|key, _| !is_source(key));
            }
            object.overlay(self.every_object.clone());
        }
    }
}

/// Sets the origin of each value in `table` to the argument that sets it, or else to its path.
fn name_arguments(table: &mut SceneTable, path: &str) {
    for (key, value) in &mut table.entries {
        let path = match path {
            "" => (*key).to_owned(),
            path => format!("{path}.{key}"),
        };
        match &mut value.data {
            Data::Table(table) => name_arguments(table, &path),
            Data::Tables(tables) => {
                tables
                    .iter_mut()
                    .for_each(|table| name_arguments(table, &path));
            }
            _ => {}
        }
        let argument = ARGUMENTS.iter().find(|(key, _)| *key == path);
        value.origin = Origin::Flag(argument.map_or(path, |(_, name)| (*name).to_owned()));
    }
}
