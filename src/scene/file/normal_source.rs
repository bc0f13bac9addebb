//! Where vertex normals come from, as a scene file says, and notes on what it leaves unused in a
//! mesh file.

use super::Overlay;
use super::check::Section;
use super::diagnostics::{Origin, SceneError};
use super::value::{Data, SceneTable};
use crate::mesh::PolygonMesh;
use crate::mesh::vertex_normals::{NormalRule, NormalSource, NormalUse, NormalWeight};
use crate::note::{Note, Notes, Setting};
use crate::scene::ranges::{CREASE, WELD};
use std::format;
use std::string::ToString;

/// What an object states about its vertex normals: a source, a weight, both, or neither.
#[derive(Clone, Copy)]
pub(super) struct StatedNormals {
    source: Option<NormalSource>,
    weight: Option<NormalWeight>,
}

impl StatedNormals {
    /// Reads the keys of an object.
    pub fn new(object: &Section) -> Result<Self, SceneError> {
        let why = "expected one of them: `crease` averages up to an angle";
        object.exclude("crease", "normals", why)?;
        let crease = object.number("crease", &CREASE)?.map(NormalSource::Crease);
        Ok(StatedNormals {
            source: crease.or_else(|| object.choice("normals")),
            weight: object.choice("normals_weight"),
        })
    }

    /// Returns the rule for the object. What it does not state comes from `usual`.
    pub fn or(self, usual: NormalRule) -> NormalRule {
        NormalRule {
            source: self.source.unwrap_or(usual.source),
            weight: self.weight.unwrap_or(usual.weight),
        }
    }
}

impl Overlay {
    /// Returns the rule for vertex normals that every object gets. What it does not state comes
    /// from `usual`.
    ///
    /// # Errors
    /// [`SceneError`] if it states two sources, or a crease that is no angle.
    pub fn normal_rule(&self, usual: NormalRule) -> Result<NormalRule, SceneError> {
        let object = Section {
            table: &self.every_object,
            name: "object",
        };
        Ok(StatedNormals::new(&object)?.or(usual))
    }

    /// Returns the fraction of a mesh's size within which vertices are merged, if it is set.
    ///
    /// # Errors
    /// [`SceneError`] if it is no fraction.
    #[doc(hidden)]
    pub fn weld(&self) -> Result<Option<f64>, SceneError> {
        let object = Section {
            table: &self.every_object,
            name: "object",
        };
        object.number("weld", &WELD)
    }
}

/// Writes into an object's table what the table does not state and where `rule` differs from the
/// defaults of scene files. Returns true if anything was written.
pub(super) fn spell_out(rule: NormalRule, object: &mut SceneTable) -> bool {
    let is_open = |key: &str| object.get(key).is_none();
    let source = match rule.source {
        _ if !is_open("normals") || !is_open("crease") => None,
        NormalSource::Averaged => None,
        NormalSource::Auto => Some(("normals", Data::Text("auto".into()))),
        NormalSource::Given => Some(("normals", Data::Text("given".into()))),
        NormalSource::Crease(degrees) => Some(("crease", Data::Number(degrees))),
    };
    let word = match rule.weight {
        _ if !is_open("normals_weight") => None,
        NormalWeight::Uniform => None,
        NormalWeight::Area => Some("area"),
        NormalWeight::Angle => Some("angle"),
        NormalWeight::Max => Some("max"),
    };
    let weight = word.map(|word| ("normals_weight", Data::Text(word.into())));
    let given = source.into_iter().chain(weight);
    given
        .map(|(key, data)| object.set(key, data, Origin::Program))
        .count()
        > 0
}

/// Adds a note, once, if `source` does not use the normals or the smoothing groups of the mesh file
/// `name`, or leaves polygons flat for which the file has no normals.
pub(super) fn note_normals(
    name: &str,
    mesh: &PolygonMesh,
    source: NormalSource,
    notes: &mut Notes,
) {
    let used = NormalUse::of(mesh, source);
    if mesh.is_flat_for_lack() && used.obeys_groups {
        let all = mesh.polygon_count();
        let is_flat =
            |polygon: &usize| mesh.smoothing_group(*polygon) == Some(PolygonMesh::FACETED);
        let flat = (0..all).filter(is_flat).count();
        let which = if flat == all {
            "the file has no normals".into()
        } else {
            format!("{flat} of {all} polygons have no normals")
        };
        let note = Note::warning(
            "normals-missing",
            format!("{which}: drawn flat, as glTF says; "),
        )
        .set(Setting::word("object.normals", "averaged"))
        .say(" or ")
        .set(Setting::number("object.crease", "40"))
        .say(" smooths");
        notes.push(note.about(name));
    }
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
        if is_left {
            let text = format!("the {what} of the file are not used under {by}: ");
            let note = Note::remark("normals-unused", text)
                .set(Setting::word("object.normals", "auto"))
                .say(" uses them");
            notes.push(note.about(name));
        }
    }
}
