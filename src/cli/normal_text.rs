//! The source of vertex normals in words.

use super::text::grouped;
use fastphong::mesh::vertex_normals::{NormalSource, NormalUse};
use fastphong::scene::Object;

/// Describes the source of an object's vertex normals.
pub fn describe(object: &Object) -> String {
    let mesh = &object.mesh;
    let used = NormalUse::of(mesh, object.normals);
    let faceted = Some(fastphong::mesh::PolygonMesh::FACETED);
    let is_faceted = |p| mesh.smoothing_group(p) == faceted;
    let averaged = match object.normals {
        NormalSource::Crease(angle) => format!("averaged up to a crease of {angle} degrees"),
        _ if used.obeys_groups && (0..mesh.polygon_count()).all(is_faceted) => {
            "those of polygons: its smoothing is off".to_owned()
        }
        _ if used.obeys_groups => "averaged within its smoothing groups".to_owned(),
        _ => "averaged".to_owned(),
    };
    let found = match (used.given, used.averaged) {
        (0, _) if object.normals == NormalSource::Given => format!("{averaged}: the mesh has none"),
        (0, _) => averaged,
        (_, 0) => "given with the mesh".to_owned(),
        (given, others) => {
            let [given, all] = [given, given + others].map(grouped);
            format!("given with the mesh at {given} of {all} corners, elsewhere {averaged}")
        }
    };
    match object.normals {
        NormalSource::Auto => format!("{found} (chosen by auto)"),
        _ => found,
    }
}
