//! Which sides of polygons are drawn and lit: as a scene file says, or as suits a mesh file without
//! a scene.

use super::check::Section;
use super::diagnostics::Origin;
use super::shown;
use super::value::{Data, SceneTable};
use crate::mesh::PolygonMesh;
use crate::mesh::winding::WindingDoubts;
use crate::note::{Note, Notes, Setting};
use crate::scene::Culling;
use std::format;
use std::string::String;
use std::vec::Vec;

/// Which sides of polygons are drawn and lit.
pub(super) struct Sides {
    pub culling: Culling,
    pub two_sided: bool,
    /// The keys that the scene leaves open and that its mesh decided.
    pub chosen: SceneTable,
}

impl Sides {
    /// Reads the keys of `scene`. `alone` is the name and the mesh of a file that no scene file
    /// names. For such a mesh, absent keys depend on its winding: if it is doubtful, both sides are
    /// drawn and lit, and a note says why. They also are if the file has double-sided materials and
    /// the eye is within its box. From outside only front sides of a closed mesh are seen.
    pub fn new(
        scene: &Section,
        alone: Option<(&str, &PolygonMesh)>,
        is_eye_within: impl FnOnce() -> bool,
        notes: &mut Notes,
    ) -> Sides {
        let mut sides = Sides {
            culling: scene.word("cull"),
            two_sided: scene.is_on("two_sided"),
            chosen: SceneTable::default(),
        };
        let is_open =
            !scene.has("cull") || (!scene.has("two_sided") && sides.culling != Culling::Back);
        if let Some((name, mesh)) = alone.filter(|_| is_open) {
            let doubts = WindingDoubts::of(mesh);
            if doubts.any() {
                notes.push(sides.choose(scene, shown(name), &reasons(&doubts)));
            } else if mesh.is_double_sided() && is_eye_within() {
                let why =
                    "materials of the file are double-sided, and the eye is among its polygons";
                notes.push(sides.choose(scene, shown(name), why));
            }
        }
        if sides.two_sided && sides.culling == Culling::Back {
            let name = scene.name("two_sided");
            let text = format!(
                "`{name}` has no effect with cull = \"back\": polygons seen from behind are left out"
            );
            notes.push(Note::warning("no-effect", text));
        }
        sides
    }

    /// Chooses the keys that `scene` leaves open for a mesh that needs both sides. Returns the note
    /// about it.
    fn choose(&mut self, scene: &Section, name: &str, why: &str) -> Note {
        let mut note = Note::remark(
            "winding",
            format!("{why}: its polygons are lit on the side that is seen"),
        );
        let set = |table: &mut SceneTable, key, data| table.set(key, data, Origin::Program);
        if !scene.has("cull") {
            self.culling = Culling::None;
            set(&mut self.chosen, "cull", Data::Text("none".into()));
            let done = format!("{why}: its polygons are drawn and lit on both sides (");
            note = Note::remark("winding", done)
                .set(Setting::word("cull", "back"))
                .say(" draws front sides only)");
        }
        if !scene.has("two_sided") {
            self.two_sided = true;
            set(&mut self.chosen, "two_sided", Data::Switch(true));
        }
        note.about(name)
    }
}

/// Says in one line why the winding is in doubt.
fn reasons(doubts: &WindingDoubts) -> String {
    let polygons = doubts.inside_out_polygons;
    let counted = |count: usize, one: &str, more: &str| match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        n => Some(format!("{n} {more}")),
    };
    let of = format!("of the file, of {polygons} polygons,");
    let reasons = [
        counted(doubts.open_edges, "edge is open", "edges are open"),
        counted(
            doubts.uneven_edges,
            "edge lies between polygons wound differently",
            "edges lie between polygons wound differently",
        ),
        counted(
            doubts.against_normals,
            "polygon is wound against its own normals",
            "polygons are wound against their own normals",
        ),
        counted(
            doubts.inside_out,
            &format!("surface {of} is closed and wound inside out"),
            &format!("surfaces {of} are closed and wound inside out"),
        ),
    ];
    let reasons: Vec<String> = reasons.into_iter().flatten().collect();
    reasons.join(", ")
}
