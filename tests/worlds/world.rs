//! A world: the files of a random scene, as a person would write them.

use fastphong::mesh::builtin::builtin;
use fastphong::mesh::read::parse_mesh;
use fastphong::scene::Scene;
use fastphong::scene::file::{SceneFile, UnusableMesh};
use std::fmt;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;

/// A scene file, and the mesh with its materials that the scene file may name.
///
/// `Debug` prints the files. The program can draw them, and a test can contain them unchanged.
#[derive(Clone, PartialEq)]
pub struct World {
    /// `world.toml`.
    pub scene: String,
    /// `world.obj`; empty if no object of the scene is this mesh.
    pub mesh: String,
    /// `world.mtl`, the library that the mesh names.
    pub materials: String,
}

impl World {
    /// Returns the names and the texts of the files.
    pub fn files(&self) -> [(&'static str, &str); 3] {
        [
            ("world.toml", &self.scene),
            ("world.obj", &self.mesh),
            ("world.mtl", &self.materials),
        ]
    }

    /// Returns the scene, read as the program reads files.
    ///
    /// # Errors
    /// The reader's message, as the program may refuse a world.
    pub fn scene(&self) -> Result<Scene, String> {
        let file = SceneFile::parse(&self.scene, "world.toml").map_err(|e| e.render(false))?;
        let load = |name: &str, _: &Path| match name.strip_prefix("builtin:") {
            Some(spec) => builtin(spec)
                .map(|mesh| (Arc::new(mesh), Default::default()))
                .map_err(|error| UnusableMesh::new(error.to_string())),
            None => parse_mesh(name, self.mesh.as_bytes(), |library| match library {
                "world.mtl" => Ok(self.materials.clone().into_bytes()),
                _ => Err(ErrorKind::NotFound.into()),
            })
            .map(|loaded| (Arc::new(loaded.mesh), loaded.notes))
            .map_err(|error| UnusableMesh::new(error.to_string())),
        };
        let resolved = file.resolve(load).map_err(|error| error.render(false))?;
        Ok(resolved.scene)
    }
}

impl fmt::Debug for World {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, text) in self.files() {
            if !text.is_empty() {
                write!(f, "\n--- {name}\n{text}")?;
            }
        }
        writeln!(f, "---")
    }
}
