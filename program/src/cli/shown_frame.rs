//! A frame together with its scene, to tell which object and mesh a polygon came from.

use fastphong::frame::Frame;
use fastphong::scene::file::{SceneFile, shown};
use fastphong::scene::{Object, Scene};

/// A frame and the scene that it shows.
pub struct ShownFrame<'a> {
    file: &'a SceneFile,
    pub scene: &'a Scene,
    pub frame: &'a Frame,
    /// For each object, the index in the scene of its first polygon.
    starts: Vec<usize>,
}

impl<'a> ShownFrame<'a> {
    /// Makes it of a `frame`, the `scene` that it shows, and the scene's `file`, which has the
    /// names.
    pub fn new(file: &'a SceneFile, scene: &'a Scene, frame: &'a Frame) -> Self {
        let mut count = 0;
        let start = |object: &Object| {
            let start = count;
            count += object.mesh.polygon_count();
            start
        };
        let starts = scene.objects.iter().map(start).collect();
        ShownFrame {
            file,
            scene,
            frame,
            starts,
        }
    }

    /// Returns the index of the object that a polygon of the scene belongs to, and the polygon's
    /// index in the object's mesh.
    pub fn place(&self, source: u32) -> (usize, usize) {
        let source = source as usize;
        // If several objects start at the same polygon, all but the last are empty.
        // `partition_point` finds the last.
        let object = self.starts.partition_point(|start| *start <= source) - 1;
        (object, source - self.starts[object])
    }

    /// True if the scene, or a flag, states a value for `key`.
    pub fn states(&self, key: &str) -> bool {
        self.file.table().get(key).is_some()
    }

    /// Returns the name of the mesh of an object.
    pub fn mesh_name(&self, object: usize) -> &str {
        shown(self.file.meshes().nth(object).unwrap_or_default())
    }
}
