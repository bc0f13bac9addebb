//! The scene file: TOML whose keys are listed in [`schema`].
//!
//! A scene that was read has known keys and values of the right kind; ranges are checked by [`SceneFile::resolve`], for
//! values from files and from command-line flags alike.

mod check;
mod colours;
pub mod diagnostics;
mod file_view;
mod lights;
mod normal_source;
pub mod resolve;
pub mod schema;
mod sides;
#[cfg(test)]
mod tests;
mod upright;
pub mod value;
mod viewpoint;
mod visibility;

use super::Scene;
use crate::mesh::Material;
use crate::mesh::read::content::foreign;
use crate::mesh::read::{cause, gzip};
use diagnostics::{Origin, SceneError, SourceText};
use glam::DVec3;
use schema::SCENE;
use std::path::Path;
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec::Vec;
use std::{format, io};
use value::{Data, SceneTable, Value};

/// The beginning of the name of a built-in mesh.
pub(super) const BUILTIN: &str = "builtin:";

/// The name of standard input, as an input and as the mesh of a scene.
pub const STANDARD_INPUT: &str = "-";

/// Returns the name of an input or a mesh as messages show it.
pub fn shown(name: &str) -> &str {
    match name {
        STANDARD_INPUT => "standard input",
        name => name,
    }
}

/// A scene as it is written. Two scene files are equal when they say the same, wherever it stands.
#[derive(Clone, Debug, Default)]
pub struct SceneFile {
    table: SceneTable,
    source: Option<Arc<SourceText>>,
    /// What a mesh file has and the scene cannot have.
    notes: Vec<String>,
    /// What a mesh file has given: its camera and its lights.
    of_mesh_file: SceneTable,
}

impl PartialEq for SceneFile {
    fn eq(&self, other: &Self) -> bool {
        self.table == other.table
    }
}

impl SceneFile {
    /// Reads a scene from `text`; `path` is what messages call it and what its mesh files are relative to.
    ///
    /// # Errors
    /// [`SceneError`] where the text is not TOML, a key or word is unknown, or a value is of the wrong kind.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<SceneFile, SceneError> {
        // Some editors start a file with a byte-order mark; offsets count without it. NUL ends a C string that was written whole, and 1A
        // a text of DOS.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let text = text.trim_end_matches(['\0', '\x1a']).to_string();
        let path = path.as_ref().into();
        let source = Some(Arc::new(SourceText { path, text }));
        let text = source.as_ref().map_or("", |source| &source.text);
        match SceneTable::parse(text) {
            Ok(table) => Ok(SceneFile {
                table,
                source,
                notes: Vec::new(),
                of_mesh_file: SceneTable::default(),
            }),
            Err(error) => Err(error.within(&source)),
        }
    }

    /// Reads the scene in the file `path`.
    ///
    /// # Errors
    /// [`SceneError`] when the file cannot be read or is not UTF-8, and those of [`SceneFile::parse`].
    pub fn load(path: impl AsRef<Path>) -> Result<SceneFile, SceneError> {
        SceneFile::load_by(path.as_ref(), &mut |path| std::fs::read(path))
    }

    /// Reads the scene in the file `path` as [`SceneFile::load`] does, by `read`.
    ///
    /// # Errors
    /// As [`SceneFile::load`].
    pub fn load_by(
        path: &Path,
        read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<SceneFile, SceneError> {
        let failed = |reason: String, expected: &str| {
            let title = format!("cannot read the scene `{}`: {reason}", path.display());
            SceneError::new(Origin::Program, title, expected)
        };
        let bytes = read(path).map_err(|error| failed(cause(path, error).to_string(), ""))?;
        let bytes = gzip::unpacked(&bytes).map_err(|error| failed(error.to_string(), ""))?;
        if let Some(what) = foreign(&bytes) {
            return Err(failed(format!("it is {what}"), "expected TOML in UTF-8"));
        }
        let bytes = bytes.into_owned();
        let text = String::from_utf8(bytes).map_err(|error| {
            let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = valid.iter().filter(|byte| **byte == b'\n').count() + 1;
            failed(format!("line {line} is not text"), "expected UTF-8")
        })?;
        SceneFile::parse(&text, path)
    }

    /// Returns the scene that a mesh alone gets: a fitted three-quarter view, one white light, [`Material::default`].
    ///
    /// Its vertex normals are those of
    /// [`PolygonMesh::normal_rule`](crate::mesh::PolygonMesh::normal_rule), unless keys are added: of a
    /// mesh file its own, or averaged by angle, of a built-in mesh averaged ones. Every other default
    /// that matters is spelt out, so that the printed scene shows what there is to change.
    pub fn for_mesh(mesh: impl Into<String>) -> SceneFile {
        let (width, height) = Scene::DEFAULT_SIZE;
        let (fit, direction) = (Scene::DEFAULT_FIT, Scene::DEFAULT_DIRECTION);
        let light = Scene::DEFAULT_LIGHT;
        let material = Material::default();
        let (ka, kd, ks) = (material.ambient, material.diffuse, material.specular);
        let shininess = material.shininess;
        let text = format!(
            "ambient = 1\n\
             colours = 'on'\n\
             image = {{ width = {width}, height = {height}, background = 0 }}\n\
             camera = {{ fit = {fit}, direction = {direction:?} }}\n\
             material = {{ ka = {ka:?}, kd = {kd:?}, ks = {ks:?}, shininess = {shininess} }}\n\
             light = {{ direction = {light:?} }}\n\
             object = {{ mesh = '' }}\n"
        );
        let mut file = SceneFile {
            table: SceneTable::parse(&text).expect("a scene in which all is right"),
            source: None,
            notes: Vec::new(),
            of_mesh_file: SceneTable::default(),
        };
        // Set apart, as the name may hold quotes.
        let mesh = mesh.into();
        let object = &mut file.objects_mut()[0];
        object.set("mesh", Data::Text(mesh), Origin::Program);
        file
    }

    /// Returns the scene as TOML, such that [`SceneFile::parse`] gives an equal scene.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        self.table.write(SCENE, "", &mut text);
        text
    }

    /// Returns the path of the file that the scene was read from, if it was.
    pub fn path(&self) -> Option<&Path> {
        self.source.as_ref().map(|source| source.path.as_path())
    }

    /// Returns all that is given.
    pub fn table(&self) -> &SceneTable {
        &self.table
    }

    /// Returns the name for captions.
    pub fn title(&self) -> Option<&str> {
        self.table.text("title")
    }

    /// Returns the text for captions.
    pub fn description(&self) -> Option<&str> {
        self.table.text("description")
    }

    /// Returns the names of the meshes, one for each object.
    pub fn meshes(&self) -> impl Iterator<Item = &str> {
        let objects = self.table.tables("object").iter();
        objects.filter_map(|object| object.text("mesh"))
    }

    /// True if an object shows the mesh called `mesh` in the materials that it comes with.
    pub(super) fn draws_materials_of(&self, mesh: &str) -> bool {
        let mut objects = self.table.tables("object").iter();
        objects.any(|object| object.text("mesh") == Some(mesh) && object.get("material").is_none())
    }

    /// Returns the objects, to be changed.
    pub fn objects_mut(&mut self) -> &mut [SceneTable] {
        let objects = self.table.entries.get_mut("object");
        match objects.map(|value| &mut value.data) {
            Some(Data::Tables(objects)) => objects,
            _ => &mut [],
        }
    }

    /// Replaces what `over` gives, key by key; lights and objects as whole lists.
    ///
    /// The view and the light that the program chose for a mesh alone are turned where `over` names the axis that is up.
    ///
    /// In the camera, keys that exclude each other replace each other. Near and far planes that were meant for the camera
    /// below are dropped when its place changes.
    pub fn overlay(&mut self, over: SceneTable) {
        if let Some(camera) = over.table("camera") {
            if self.source.is_none() && camera.text("up").is_some() {
                let before = upright::turn(self.table.table("camera"));
                // The inverse of a rotation is its transpose.
                let turn = upright::turn(Some(camera)) * before.transpose();
                upright::turn_default(self.table.table_mut("camera"), turn);
                if !self.has_lights_of_mesh_file()
                    && let Some(Data::Tables(lights)) = self
                        .table
                        .entries
                        .get_mut("light")
                        .map(|value| &mut value.data)
                {
                    lights
                        .iter_mut()
                        .for_each(|light| upright::turn_default(light, turn));
                }
            }
            make_way(self.table.table_mut("camera"), camera);
        }
        self.table.overlay(over);
    }
}

/// Removes from the camera `below` what `over` excludes or makes meaningless.
fn make_way(below: &mut SceneTable, over: &SceneTable) {
    /// If one of the first keys is given, the others are dropped.
    const DROPPED: [(&str, &str); 6] = [
        ("half_height fovy", "half_height fovy"),
        ("fit", "half_height"),
        ("direction azimuth elevation", "eye target direction"),
        ("direction", "azimuth elevation"),
        ("eye", "direction azimuth elevation fit"),
        (
            "direction azimuth elevation eye target fit fovy",
            "near far",
        ),
    ];
    // `half_height` replaces `fit`; where an eye was given only for its direction, that direction is all that stays of it.
    if over.get("half_height").is_some()
        && below.entries.remove("fit").is_some()
        && let Some(eye) = below.triple("eye")
    {
        let direction = eye - below.triple("target").unwrap_or(DVec3::ZERO);
        below.entries.remove("target");
        if let Some(Value { origin, .. }) = below.entries.remove("eye") {
            below.set("direction", Data::Triple(direction.to_array()), origin);
        }
    }
    for (given, dropped) in DROPPED {
        if given.split(' ').any(|key| over.get(key).is_some()) {
            let is_dropped = |key: &str| dropped.split(' ').any(|dropped| dropped == key);
            below.entries.retain(|key, _| !is_dropped(key));
        }
    }
}
