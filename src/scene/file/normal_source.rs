//! The source of vertex normals that a scene file asks for, and notes on what of a mesh file it leaves unused.

use super::check::Section;
use super::diagnostics::SceneError;
use crate::mesh::PolygonMesh;
use crate::mesh::vertex_normals::{NormalSource, NormalUse};
use crate::scene::ranges::CREASE;
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

/// Returns the source of the vertex normals of an object.
pub(super) fn normals(object: &Section) -> Result<NormalSource, SceneError> {
    let why = "expected one of them: `crease` averages up to an angle";
    object.exclude("crease", "normals", why)?;
    let crease = object.number("crease", &CREASE)?;
    Ok(crease.map_or_else(|| object.word("normals"), NormalSource::Crease))
}

/// Adds a note, once, for normals and smoothing groups of the mesh file `name` that `source` leaves unused.
pub(super) fn note_unused(
    name: &str,
    mesh: &PolygonMesh,
    source: NormalSource,
    notes: &mut Vec<String>,
) {
    let used = NormalUse::of(mesh, source);
    let by = match source {
        NormalSource::Auto => "normals = \"auto\"".to_string(),
        NormalSource::Averaged => "normals = \"averaged\"".to_string(),
        NormalSource::Given => "normals = \"given\"".to_string(),
        NormalSource::Crease(degrees) => format!("crease = {degrees}"),
    };
    for (is_left, what) in [
        (used.leaves_normals, "normals"),
        (used.leaves_groups, "smoothing groups"),
    ] {
        let note = format!(
            "{name}: the {what} of the file are not used under {by}, but by normals = \"auto\""
        );
        if is_left && !notes.contains(&note) {
            notes.push(note);
        }
    }
}
