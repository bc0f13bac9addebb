//! glTF 2.0 files: JSON with buffers, or one GLB file.
//!
//! Only what is drawn is read. All nodes of the scene become one mesh in the coordinates of the
//! scene; transforms are multiplied in `f64`. The format has no polygons other than triangles.
//! Triangles without normals are flat, as the specification says.

mod accessors;
mod container;
mod document;
mod nodes;
mod primitives;
mod reader;
mod view;

pub(crate) use view::{FileLens, FileLight, FileView, view};

use super::error::Refusal;
use super::{Beside, MeshFormat, Parts};
use accessors::Buffers;
use glam::DAffine3;
use reader::Reader;
use std::collections::HashMap;

/// The format.
pub(super) struct Gltf;

impl MeshFormat for Gltf {
    fn name(&self) -> &'static str {
        "a glTF file"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["gltf", "glb"]
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        let is_json = super::content::foreign(bytes) == Some("a glTF file (JSON)");
        bytes.starts_with(container::GLB) || is_json
    }

    fn read(&self, bytes: &[u8], beside: Beside) -> Result<Parts, Refusal> {
        let file = container::open(bytes)?;
        let document = document::parse(file.json, file.is_glb)?;
        let nodes = nodes::placed(&document)?;
        if nodes.is_empty() && !document.nodes.is_empty() {
            let problem = "its scene has no `nodes`, so nothing is drawn: expected a list of nodes";
            return Err(Refusal::whole(problem));
        }
        let worlds = nodes.iter().map(|placed| (placed.index, placed.world));
        let worlds: HashMap<usize, DAffine3> = worlds.collect();
        let mut buffers = Buffers::new(&document, file.bin, beside);
        let mut reader = Reader::new(&document);
        let drawn = nodes.iter().filter(|placed| placed.is_visible);
        for placed in drawn.filter(|placed| placed.node.mesh.is_some()) {
            let poses = nodes::poses(placed, &worlds, &document, &mut buffers)?;
            reader.add(placed.node, &poses, &mut buffers)?;
        }
        if reader.count() == 0 {
            let problem = if reader.has_points_or_lines() {
                "has points or lines but no triangle: expected a scene with meshes of triangles"
            } else {
                "has no triangle: expected a scene with meshes"
            };
            return Err(Refusal::whole(problem));
        }
        reader.finish()
    }
}
