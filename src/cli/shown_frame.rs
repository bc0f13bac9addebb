//! A frame with the scene that it shows: where its polygons come from.

use fastphong::frame::Frame;
use fastphong::scene::file::{SceneFile, shown};
use fastphong::scene::{Object, Scene};

/// A frame, and the scene that it shows.
pub struct ShownFrame<'a> {
    file: &'a SceneFile,
    pub scene: &'a Scene,
    pub frame: &'a Frame,
    /// The number of polygons of all objects before each one.
    starts: Vec<usize>,
}

impl<'a> ShownFrame<'a> {
    /// Looks at `frame`, which shows `scene`, of which `file` has the names.
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

    /// Returns the number of the object with a polygon of the scene, and the number of the polygon in its mesh.
    pub fn place(&self, source: u32) -> (usize, usize) {
        let source = source as usize;
        // Of objects that begin at one polygon all but the last one have none.
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
