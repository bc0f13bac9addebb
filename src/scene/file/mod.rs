//! Scene files: TOML whose keys are described in `scenes/README.md`.
//!
//! [`SceneFile::parse`] and [`SceneFile::load`] check that keys are known and that values are of
//! the right kind. [`SceneFile::resolve`] checks ranges, also of values that flags set, loads the
//! meshes and returns a [`Scene`].
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::scene::file::{SceneFile, UnusableMesh};
//!
//! let file = SceneFile::parse("image.width = 320\n[[object]]\nmesh = 'cube'\n", "cube.toml")?;
//! let resolved = file.resolve(|name, _folder| match builtin(name) {
//!     Ok(mesh) => Ok((mesh.into(), Default::default())),
//!     Err(error) => Err(UnusableMesh::new(error.to_string())),
//! })?;
//! assert_eq!(resolved.scene.width, 320);
//! # Ok::<(), fastphong::scene::file::SceneError>(())
//! ```

mod check;
mod colours;
#[doc(hidden)]
pub mod diagnostics;
mod file_view;
mod lights;
mod normal_source;
mod overlay;
#[doc(hidden)]
pub mod resolve;
#[doc(hidden)]
pub mod schema;
mod sides;
#[cfg(test)]
mod tests;
mod upright;
#[doc(hidden)]
pub mod value;
mod viewpoint;
mod visibility;

pub use diagnostics::SceneError;
pub use overlay::Overlay;
pub use resolve::{Resolved, UnusableMesh, View};
pub use value::SceneTable;

use super::Scene;
use crate::mesh::Material;
use crate::mesh::read::content::foreign;
use crate::mesh::read::{cause, gzip};
use crate::note::Notes;
use diagnostics::{Origin, SourceText};
use glam::DVec3;
use schema::SCENE;
use std::path::Path;
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec::Vec;
use std::{format, io};
use value::{Data, Value};

/// The beginning of the name of a built-in mesh.
pub(super) const BUILTIN: &str = "builtin:";

/// The name of standard input, both as an input and as the mesh of a scene.
#[doc(hidden)]
pub const STANDARD_INPUT: &str = "-";

/// Returns the name of an input or a mesh for messages.
#[doc(hidden)]
pub fn shown(name: &str) -> &str {
    match name {
        STANDARD_INPUT => "standard input",
        name => name,
    }
}

/// A scene as it is written down. Two scene files are equal if they state the same values, wherever
/// these stand.
#[derive(Clone, Debug, Default)]
pub struct SceneFile {
    table: SceneTable,
    source: Option<Arc<SourceText>>,
    /// Remarks on what a mesh file has and a scene cannot have.
    notes: Notes,
    /// The camera and lights that a mesh file contributed.
    of_mesh_file: SceneTable,
}

impl PartialEq for SceneFile {
    fn eq(&self, other: &Self) -> bool {
        self.table == other.table
    }
}

impl SceneFile {
    /// Reads a scene from `text`. Messages call it `path`, and the paths of its meshes are relative
    /// to the folder of `path`.
    ///
    /// # Errors
    /// [`SceneError`] if the text is not TOML, a key or word is unknown, or a value is of the wrong
    /// kind.
    pub fn parse(text: &str, path: impl AsRef<Path>) -> Result<SceneFile, SceneError> {
        // Some editors start a file with a byte-order mark, and offsets do not count it. A NUL ends
        // a C string that was written with its end, and 1A ends a DOS text.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let text = text.trim_end_matches(['\0', '\x1a']).to_string();
        let path = path.as_ref().into();
        let source = Some(Arc::new(SourceText { path, text }));
        let text = source.as_ref().map_or("", |source| &source.text);
        match SceneTable::parse(text) {
            Ok(table) => Ok(SceneFile {
                table,
                source,
                notes: Notes::default(),
                of_mesh_file: SceneTable::default(),
            }),
            Err(error) => Err(error.within(&source)),
        }
    }

    /// Reads the scene in the file `path`.
    ///
    /// # Errors
    /// [`SceneError`] if the file cannot be read or is not UTF-8, and the errors of
    /// [`SceneFile::parse`].
    pub fn load(path: impl AsRef<Path>) -> Result<SceneFile, SceneError> {
        SceneFile::load_by(path.as_ref(), &mut |path| std::fs::read(path))
    }

    /// Reads the scene in the file `path` as [`SceneFile::load`] does. `read` returns the contents
    /// of files.
    ///
    /// # Errors
    /// As for [`SceneFile::load`].
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

    /// Returns the default scene around one mesh: a fitted three-quarter view, one white light, and
    /// [`Material::default`].
    ///
    /// Without further keys, vertex normals follow
    /// [`PolygonMesh::normal_rule`](crate::mesh::PolygonMesh::normal_rule): a mesh file's own
    /// normals, or averages by angle, and plain averages of a built-in mesh. Every other default
    /// that matters is spelt out, so that the printed scene shows what can be changed.
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
            notes: Notes::default(),
            of_mesh_file: SceneTable::default(),
        };
        // Set separately, because the name may contain quotes.
        let mesh = mesh.into();
        let object = &mut file.objects_mut()[0];
        object.set("mesh", Data::Text(mesh), Origin::Program);
        file
    }

    /// Drops all lights, so that the scene has the default one.
    pub(super) fn drop_lights(&mut self) {
        self.table.entries.remove("light");
    }

    /// Returns the scene as TOML. [`SceneFile::parse`] reads an equal scene from it.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        self.table.write(SCENE, "", &mut text);
        text
    }

    /// Returns the path of the file that the scene was read from, if there is one.
    pub fn path(&self) -> Option<&Path> {
        self.source.as_ref().map(|source| source.path.as_path())
    }

    /// Returns all keys that are set.
    pub fn table(&self) -> &SceneTable {
        &self.table
    }

    /// True if `key` is set: `interpolation`, or `camera.up` in a table.
    pub fn states(&self, key: &str) -> bool {
        let (table, key) = match key.split_once('.') {
            Some((table, key)) => (self.table.table(table), key),
            None => (Some(&self.table), key),
        };
        table.is_some_and(|table| table.get(key).is_some())
    }

    /// Returns the title, for captions.
    pub fn title(&self) -> Option<&str> {
        self.table.text("title")
    }

    /// Returns the description, for captions.
    pub fn description(&self) -> Option<&str> {
        self.table.text("description")
    }

    /// Returns the names of the meshes, one for each object.
    pub fn meshes(&self) -> impl Iterator<Item = &str> {
        let objects = self.table.tables("object").iter();
        objects.filter_map(|object| object.text("mesh"))
    }

    /// True if an object shows the mesh called `mesh` in the mesh's own materials.
    fn draws_materials_of(&self, mesh: &str) -> bool {
        let mut objects = self.table.tables("object").iter();
        objects.any(|object| object.text("mesh") == Some(mesh) && object.get("material").is_none())
    }

    /// Returns the objects for writing.
    pub fn objects_mut(&mut self) -> &mut [SceneTable] {
        let objects = self.table.entries.get_mut("object");
        match objects.map(|value| &mut value.data) {
            Some(Data::Tables(objects)) => objects,
            _ => &mut [],
        }
    }

    /// Replaces the values that `over` sets, key by key. Lists of lights and of objects are
    /// replaced as a whole.
    ///
    /// In the camera, a key replaces the keys that it excludes. Near and far planes that were meant
    /// for the old camera are dropped when the camera moves. If `over` names the axis that is up,
    /// the view and the light that the program chose for a mesh are turned with it.
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

/// Removes from the camera `below` the keys that `over` excludes or makes meaningless.
fn make_way(below: &mut SceneTable, over: &SceneTable) {
    /// If one of the first keys is set, the others are dropped.
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
    // `half_height` replaces `fit`. If an eye only said from which direction to fit, that direction
    // is kept and the eye is not.
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
