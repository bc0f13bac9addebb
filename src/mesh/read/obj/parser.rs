//! The call of the parser, `tobj`, and the checks of its result.

use super::prescan::Prescan;
use std::format;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::string::{String, ToString};

/// Runs the parser and turns a panic inside it into an error. The pre-scan checks the text first,
/// so this is a last resort.
fn guarded<T>(parse: impl FnOnce() -> Result<T, tobj::LoadError>) -> Result<T, String> {
    match catch_unwind(AssertUnwindSafe(parse)) {
        Ok(Ok(parsed)) => Ok(parsed),
        Ok(Err(error)) => Err(error.to_string()),
        Err(_) => Err("it panicked".to_string()),
    }
}

/// Parses the text of `scan`, which holds one model. Polygons keep all their sides, and positions
/// and normals have separate indices.
pub(super) fn parse(scan: &Prescan) -> Result<tobj::Mesh, String> {
    let options = tobj::LoadOptions {
        single_index: false,
        triangulate: false,
        ignore_points: true,
        ignore_lines: true,
    };
    // The text for the parser has no `mtllib`, so this is never called.
    let no_library = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = guarded(|| tobj::load_obj_buf(&mut &scan.text[..], &options, no_library))?;
    let [model] = <[tobj::Model; 1]>::try_from(models)
        .map_err(|models| format!("{} models", models.len()))?;
    let mut mesh = model.mesh;
    if mesh.face_arities.is_empty() {
        // The parser leaves the corner counts empty if all polygons are triangles.
        mesh.face_arities.resize(scan.polygons, 3);
    }
    let corners: usize = mesh.face_arities.iter().map(|&n| n as usize).sum();
    let found = (mesh.face_arities.len(), corners);
    let fits = found == (scan.polygons, scan.corners)
        && mesh.indices.len() == corners
        && (!scan.has_normals() || mesh.normal_indices.len() == corners)
        && mesh.positions.len() == 3 * scan.used_positions.len();
    if !fits {
        return Err(format!(
            "{} polygons with {corners} corners instead of {} with {}",
            found.0, scan.polygons, scan.corners
        ));
    }
    Ok(mesh)
}
