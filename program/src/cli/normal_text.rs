//! Describes in words where vertex normals come from.

use super::text::grouped;
use fastphong::mesh::vertex_normals::{NormalRule, NormalSource, NormalUse};
use fastphong::scene::Object;

/// Describes where an object's vertex normals come from.
pub fn describe(object: &Object) -> String {
    let mesh = &object.mesh;
    let used = NormalUse::of(mesh, object.normals.source);
    let faceted = Some(fastphong::mesh::PolygonMesh::FACETED);
    let is_faceted = |p| mesh.smoothing_group(p) == faceted;
    let by = object.normals.weight.by_text();
    let averaged = match object.normals.source {
        NormalSource::Crease(angle) => format!("averaged{by} up to a crease of {angle} degrees"),
        // `up_by_custom` is y for glTF files only.
        _ if used.obeys_groups
            && (0..mesh.polygon_count()).all(is_faceted)
            && mesh.up_by_custom() == Some('y') =>
        {
            "per polygon: glTF without normals is flat by its specification".to_owned()
        }
        _ if used.obeys_groups && (0..mesh.polygon_count()).all(is_faceted) => {
            "per polygon: its smoothing is off".to_owned()
        }
        _ if used.obeys_groups => format!("averaged{by} within its smoothing groups"),
        _ => format!("averaged{by}"),
    };
    let found = match (used.given, used.averaged) {
        (0, _) if object.normals.source == NormalSource::Given => {
            format!("{averaged}: the mesh has none")
        }
        (0, _) if object.normals.source == NormalSource::Auto && !mesh.states_smoothing() => {
            let is_shape = mesh.normal_rule() == NormalRule::default();
            format!(
                "{averaged}, as the {} has none",
                if is_shape { "mesh" } else { "file" }
            )
        }
        (0, _) => averaged,
        (_, 0) => "given with the mesh".to_owned(),
        (given, others) => {
            let [given, all] = [given, given + others].map(grouped);
            format!("given with the mesh at {given} of {all} corners, elsewhere {averaged}")
        }
    };
    match object.normals.source {
        NormalSource::Auto => format!("{found} (chosen by auto)"),
        _ => found,
    }
}
