//! A scene for other programs, as files in memory: the mesh in world space, all numbers, the
//! expected picture, and the light at ten pixels.
//!
//! It knows no files, clocks or threads. Whoever calls it writes the files.

mod document;
mod formats;
mod mesh;
mod points;
mod readme;
mod terms;
mod triangles;

use alloc::string::String;
use alloc::vec::Vec;
use fastphong::frame::{Frame, FrameError, PreparedScene};
use fastphong::mesh::MeshError;
use fastphong::picture::encoding::store_f64;
use fastphong::picture::image_file::{FilePicture, Format};
use fastphong::reference::{self, Model, ReferencePicture};
use fastphong::scene::Scene;
use mesh::Mesh;
pub use points::HEAD;
use std::io;

/// The beginning of a text that marks a file as ours.
pub const MADE_BY: &str = "Made by `fastphong export";

/// The names of the files, in the order of [`Export::files`].
pub const NAMES: [&str; 8] = [
    "README.txt",
    "mesh.obj",
    "mesh.mtl",
    "scene.json",
    "scene.h",
    "scene.py",
    "points.csv",
    "expected.png",
];

/// Bytes per corner of the scene's polygons: triangles, text, and tables that find equal vertices.
const CORNER: u64 = 250;

/// Estimates the memory, in bytes, that the mesh of an export takes beside the scene and its frame.
pub fn memory_needed(scene: &Scene) -> u64 {
    let corners = scene.objects.iter().map(|o| o.mesh.corners().len() as u64);
    CORNER * corners.sum::<u64>()
}

/// The faces of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faces {
    /// Triangles, which every program reads.
    Triangles,
    /// The polygons of the scene.
    Polygons,
}

/// A scene that is ready to be written.
pub struct Export {
    name: String,
    scene: Scene,
    prepared: PreparedScene,
    frame: Frame,
    left_out: usize,
}

/// The reason why a scene cannot be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// Its triangles make no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A concave polygon has too many corners.
    #[error(
        "{mesh}: polygon {polygon} is concave and has {corners} corners: \
         expected at most {most} to cut into triangles"
    )]
    Corners {
        /// The name of its mesh.
        mesh: String,
        /// Its index in the mesh.
        polygon: usize,
        /// How many it has.
        corners: usize,
        /// How many it may have.
        most: usize,
    },
    /// It cannot be projected.
    #[error(transparent)]
    Frame(#[from] FrameError),
}

impl Export {
    /// Prepares `scene`, seen at one sample per pixel. `name` is the scene's name for its users.
    ///
    /// # Errors
    /// If the scene has too many triangles, or cannot be projected.
    pub fn new(scene: &Scene, name: &str, faces: Faces) -> Result<Export, ExportError> {
        let (mut scene, left_out) = match faces {
            Faces::Triangles => triangles::in_triangles(scene)?,
            Faces::Polygons => (scene.clone(), 0),
        };
        scene.samples = 1;
        let prepared = scene.prepare()?;
        Ok(Export {
            name: name.chars().map(plain).collect(),
            frame: prepared.frame()?,
            scene,
            prepared,
            left_out,
        })
    }

    /// Returns the frame of the expected picture.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns how many polygons were left out because they cross themselves, so that triangles
    /// cannot cover them.
    pub fn left_out(&self) -> usize {
        self.left_out
    }

    /// Draws the picture, and returns the name and the bytes of each file.
    ///
    /// # Errors
    /// If the picture has no PNG file.
    pub fn files(&self) -> io::Result<Vec<(&'static str, Vec<u8>)>> {
        let drawn = reference::render(&self.frame, Model::Phong);
        let mesh = Mesh::new(&self.scene, &self.prepared);
        let entries = document::entries(&self.scene, &self.name, &mesh);
        let made = self.made();
        let contents: [Vec<u8>; NAMES.len()] = [
            readme::text(&self.scene, &self.name, &made).into(),
            mesh.obj(&self.scene, &self.prepared, &made),
            mesh.mtl(&self.scene, &made).into(),
            formats::json(&entries, &made).into(),
            formats::c(&entries, &made).into(),
            formats::python(&entries, &made).into(),
            points::csv(self, &mesh, &drawn).into(),
            self.png(&drawn)?,
        ];
        Ok(NAMES.into_iter().zip(contents).collect())
    }

    /// Returns the sentence that begins each text.
    fn made(&self) -> String {
        format!("{MADE_BY} {}`.", self.name)
    }

    /// Returns the picture over the scene's background as a PNG file.
    fn png(&self, drawn: &ReferencePicture) -> io::Result<Vec<u8>> {
        let mut picture = store_f64(&drawn.picture, self.scene.encoding);
        picture
            .pixels_mut()
            .iter_mut()
            .for_each(|pixel| pixel[3] = 255);
        // Levels without a statement about them, as other programs write them: then viewers show
        // both pictures alike, and `diff` compares them as they are.
        FilePicture::stored(picture).encode(Format::Png)
    }
}

/// Returns a character that may stand in comments and strings of any language, or `_` for another.
fn plain(letter: char) -> char {
    let is_plain = letter.is_alphanumeric() || " -_.:/?=&,+()'".contains(letter);
    if is_plain { letter } else { '_' }
}
