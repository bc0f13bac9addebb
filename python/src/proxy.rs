//! A scene's meshes without their polygons, for cameras: they are fitted around vertices.

use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::{MeshBuilder, MeshError, PolygonMesh};
use fastphong::scene::Scene;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::{Origin, SceneError};
use fastphong::scene::file::resolve::Resolved;
use fastphong::scene::file::value::Data;
use std::sync::Arc;

/// A scene file whose meshes are clouds of the vertices that are drawn.
pub struct Proxy {
    pub file: SceneFile,
    clouds: Vec<Arc<PolygonMesh>>,
}

/// The start of the names of clouds: what begins like this is made by the program, and nothing is
/// said about it.
const NAME: &str = "builtin:";

impl Proxy {
    /// Makes the proxy of `file`, which was resolved as `scene`.
    ///
    /// # Errors
    /// None for a scene that was resolved.
    pub fn new(mut file: SceneFile, scene: &Scene) -> Result<Proxy, MeshError> {
        let mut clouds = Vec::new();
        for (index, (table, object)) in file
            .objects_mut()
            .iter_mut()
            .zip(&scene.objects)
            .enumerate()
        {
            table.set(
                "mesh",
                Data::Text(format!("{NAME}{index}")),
                Origin::Program,
            );
            // The mesh of the scene is welded already.
            table.entries.remove("weld");
            clouds.push(Arc::new(cloud(&object.mesh)?));
        }
        Ok(Proxy { file, clouds })
    }

    /// Returns the scene that `file` describes, a proxy with other settings: with the right camera,
    /// lights and size.
    pub fn resolve(&self, file: &SceneFile) -> Result<Resolved, SceneError> {
        file.resolve(|name, _| {
            let index = name
                .strip_prefix(NAME)
                .and_then(|index| index.parse::<usize>().ok());
            let cloud = index.and_then(|index| self.clouds.get(index));
            cloud
                .map(|cloud| (cloud.clone(), Vec::new()))
                .ok_or_else(|| name.to_owned())
        })
    }
}

/// Returns a mesh of one polygon, whose corners are the vertices of `mesh` that polygons use.
///
/// # Errors
/// None for a mesh that was checked.
fn cloud(mesh: &PolygonMesh) -> Result<PolygonMesh, MeshError> {
    let mut used = vec![false; mesh.positions().len()];
    for &corner in mesh.corners() {
        used[corner as usize] = true;
    }
    let vertices = mesh.positions().iter().zip(used);
    let vertices = vertices.filter_map(|(vertex, is_used)| is_used.then_some(*vertex));
    let vertices: Vec<Vec3> = vertices.collect();
    let mut corners: Vec<u32> = (0..vertices.len() as u32).collect();
    if !corners.is_empty() {
        // All corners of a polygon may be one vertex: it has three all the same.
        corners.resize(corners.len().max(3), 0);
    }
    let mut builder = match mesh.origin() {
        DVec3::ZERO => MeshBuilder::new(vertices),
        origin => {
            let placed = vertices.iter().map(|v| origin + v.as_dvec3());
            MeshBuilder::from_f64(&placed.collect::<Vec<_>>())
        }
    };
    if !corners.is_empty() {
        builder.polygon(&corners);
    }
    builder.finish()
}
