//! A frame together with its scene, to tell which object and mesh a polygon came from.

use crate::frame::Frame;
use crate::scene::{Object, Scene};
use alloc::vec::Vec;

/// A frame and the scene that it shows.
pub(super) struct DrawnScene<'a> {
    pub scene: &'a Scene,
    pub frame: &'a Frame,
    /// For each object, the index in the scene of its first polygon.
    starts: Vec<usize>,
}

impl<'a> DrawnScene<'a> {
    /// Makes it of the `scene` and a `frame` that shows it.
    pub fn new(scene: &'a Scene, frame: &'a Frame) -> Self {
        let mut count = 0;
        let start = |object: &Object| {
            let start = count;
            count += object.mesh.polygon_count();
            start
        };
        let starts = scene.objects.iter().map(start).collect();
        DrawnScene {
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

    /// Returns the name of an object: its mesh's, or its number if it has none.
    pub fn name(&self, object: usize) -> &str {
        match self.scene.objects[object].name.as_str() {
            "" => "the mesh",
            name => name,
        }
    }
}
