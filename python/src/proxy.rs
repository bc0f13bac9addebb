//! A stand-in for a scene whose meshes have only vertices. Cameras are fitted around vertices, so
//! they need no polygons.

use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::{MeshBuilder, MeshError, PolygonMesh};
use fastphong::scene::Scene;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::Data;
use fastphong::scene::file::{Resolved, SceneError, SceneFile, UnusableMesh};
use std::sync::Arc;

/// A scene file whose meshes are replaced by clouds of their drawn vertices.
pub struct Proxy {
    pub file: SceneFile,
    clouds: Vec<Arc<PolygonMesh>>,
}

/// The prefix of the clouds' names. The resolver treats a name with this prefix as a built-in mesh,
/// and says nothing about it.
const NAME: &str = "builtin:";

impl Proxy {
    /// Makes the proxy of `file`, which resolves to `scene`.
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

    /// Returns the scene of `file`, which is the proxy's file with other settings. Its camera,
    /// lights and size are right; its meshes are clouds.
    pub fn resolve(&self, file: &SceneFile) -> Result<Resolved, SceneError> {
        file.resolve(|name, _| {
            let index = name
                .strip_prefix(NAME)
                .and_then(|index| index.parse::<usize>().ok());
            let cloud = index.and_then(|index| self.clouds.get(index));
            cloud
                .map(|cloud| (cloud.clone(), Vec::new()))
                .ok_or_else(|| UnusableMesh::new(name))
        })
    }
}

/// Returns a mesh with a single polygon, whose corners are the vertices that polygons of `mesh`
/// use.
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
        // A polygon needs three corners. They may all be the same vertex.
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
