//! Hints about mesh files: what may not look as intended, and which flag to try.

use crate::mesh::PolygonMesh;
use crate::mesh::edges::EdgeCounts;
use crate::mesh::vertex_normals::{NormalSource, NormalUse};
use crate::note::{Note, Notes, Setting};
use crate::number::counted::counted;
use crate::scene::{Object, Scene};
use alloc::collections::BTreeSet;
use alloc::format;

/// The angle, in degrees, above which an edge was probably meant to be sharp.
const CREASE: f64 = 40.0;
/// The distance, as a fraction of the size of the mesh, within which two positions are probably one
/// that was rounded in two ways. Programs write 32-bit floats with seven digits.
const ROUNDED: f64 = 1e-6;

/// Returns hints about the mesh files of a scene: edges that look too smooth, vertices that nearly
/// meet, seams. Built-in meshes are right.
pub fn of_meshes(scene: &Scene) -> Notes {
    let mut notes = Notes::default();
    let mut looked_at = BTreeSet::new();
    for object in &scene.objects {
        let mesh = &*object.mesh;
        if mesh.was_read() && looked_at.insert(mesh as *const PolygonMesh) {
            notes.append(of_mesh(object));
        }
    }
    notes
}

/// Returns hints about the mesh of one object, and about its normals.
pub fn of_mesh(object: &Object) -> Notes {
    let mut notes = Notes::default();
    let (mesh, name) = (&*object.mesh, &object.name);
    let used = NormalUse::of(mesh, object.normals.source);
    let counts = EdgeCounts::of(mesh, CREASE, ROUNDED);
    // A user who asked for averaged normals needs no hint.
    let is_left_open = object.normals.source == NormalSource::Auto;
    if is_left_open && used.given == 0 && !mesh.states_smoothing() && counts.sharp > 0 {
        let edges = counted(counts.sharp, "edge that turns", "edges that turn");
        let by = object.normals.weight.by_text();
        // `vn` and `s` are words of OBJ.
        let lack = if is_obj(name) {
            "neither normals (vn) nor smoothing groups (s)"
        } else {
            "no normals"
        };
        let text = format!(
            "has {lack}: normals are averaged{by}, even over {edges} by more than {CREASE} degrees; "
        );
        let note = Note::remark("mesh/sharp", text)
            .set(Setting::number("object.crease", format!("{CREASE}")))
            .say(" keeps these sharp");
        notes.push(note.about(name));
    }
    if counts.closing > 0 {
        let edges = counted(counts.closing, "open edge", "open edges");
        let text =
            format!("{edges} would close if positions that differ only by rounding were merged: ");
        let weld = Setting::number("object.weld", format!("{ROUNDED:e}"));
        notes.push(Note::remark("mesh/weld", text).set(weld).about(name));
    }
    if counts.seams > 0 && used.averaged > 0 {
        let edges = counted(counts.seams, "edge", "edges");
        let text = format!(
            "objects (o) of the file meet in {edges} of a smooth surface: normals are not averaged across them, which shows as \
             seams; remove the `o` lines to average them"
        );
        notes.push(Note::remark("mesh/seams", text).about(name));
    }
    notes
}

/// True for the name of an OBJ file, compressed or not.
fn is_obj(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    name.strip_suffix(".gz").unwrap_or(&name).ends_with(".obj")
}

/// Guesses from the bounds of a mesh if it lies on its side, and returns a hint on how to raise it.
pub fn lies_on_its_side(mesh: &PolygonMesh) -> Option<Note> {
    const KIND: &str = "mesh/lies";
    /// The fraction of the size that counts as zero.
    const NEAR: f64 = 1e-3;
    if mesh.up_by_custom().is_some() {
        return mesh.up_note();
    }
    let (low, high) = mesh.bounds()?;
    let (low, high) = (low.to_array(), high.to_array());
    let sides = [0, 1, 2].map(|i| high[i] - low[i]);
    let size = sides.into_iter().fold(0.0, f64::max);
    let stands = |i: usize| low[i].abs() <= NEAR * size && sides[i] > NEAR * size;
    let hangs = |i: usize| high[i].abs() <= NEAR * size && sides[i] > NEAR * size;
    // The mesh reaches to both sides of 0, and neither side is much longer than the other.
    let is_around = |i: usize| f64::min(-low[i], high[i]) > 0.1 * sides[i];
    let names = ["x", "y", "z"];
    for up in [2, 0] {
        let others = (0..3).filter(|other| *other != up);
        if others.clone().all(is_around) && (stands(up) || hangs(up)) {
            let (side, sign) = if stands(up) {
                ("above", "")
            } else {
                ("below", "-")
            };
            let (name, axis) = (names[up], up_word(sign, names[up]));
            let text = format!(
                "lies {side} the plane {name} = 0, and around 0 along the other axes: if {axis} is up, "
            );
            return Some(Note::remark(KIND, text).set(Setting::word("camera.up", axis)));
        }
    }
    let [x, y, z] = sides;
    if z >= 2.0 * x.max(y) && !stands(1) {
        let note = Note::remark(KIND, "is longest along z: if it stands along z, ");
        return Some(note.set(Setting::word("camera.up", "z")));
    }
    let is_ground = 4.0 * z <= x.min(y) && is_around(0) == is_around(1) && stands(0) == stands(1);
    is_ground.then(|| {
        Note::remark(KIND, "is flat along z: if it is a terrain, ")
            .set(Setting::word("camera.up", "z"))
    })
}

/// Returns the word for an axis, turned around if `sign` is `-`.
fn up_word(sign: &str, axis: &str) -> &'static str {
    match (sign, axis) {
        ("", "x") => "x",
        ("", _) => "z",
        (_, "x") => "-x",
        _ => "-z",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    use alloc::string::ToString;
    use alloc::vec::Vec;
    use glam::Vec3;

    /// Makes a mesh with these bounds.
    fn between(low: [f32; 3], high: [f32; 3]) -> PolygonMesh {
        let corner = |i: usize| {
            let pick = |axis: usize| {
                if i >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            Vec3::new(pick(0), pick(1), pick(2))
        };
        let mut builder = MeshBuilder::new((0..8).map(corner).collect());
        builder
            .polygon(&[0, 1, 7])
            .polygon(&[0, 2, 7])
            .polygon(&[0, 4, 7]);
        builder.finish().expect("a mesh")
    }

    #[test]
    fn names_of_obj_files_are_known() {
        assert!(is_obj("a.obj") && is_obj("d/A.OBJ.gz"));
        assert!(!is_obj("a.ply") && !is_obj("it") && !is_obj("obj"));
    }

    #[test]
    fn meshes_that_do_not_stand_on_y_get_a_hint() {
        let told = |low, high| lies_on_its_side(&between(low, high));
        let up = |low, high, flag: &str| {
            let hint = told(low, high).expect("a hint").to_string();
            assert!(hint.ends_with(flag), "{hint}");
        };
        up([-2.0, -1.0, 0.0], [2.0, 1.0, 1.5], "`camera.up = \"z\"`");
        up([-2.0, -1.0, -1.5], [2.0, 1.0, 0.0], "`camera.up = \"-z\"`");
        up([0.0, -1.0, -1.0], [3.0, 1.0, 1.0], "`camera.up = \"x\"`");
        up([-1.0, -1.0, -5.0], [1.0, 1.0, 5.0], "`camera.up = \"z\"`");
        up([0.0, 0.0, -0.2], [8.0, 8.0, 0.3], "`camera.up = \"z\"`");
        // A tower, a door and a car that stand on y = 0, a ball, a cube beside 0.
        assert_eq!(told([-1.0, 0.0, -1.0], [1.0, 5.0, 1.0]), None);
        assert_eq!(told([-0.5, 0.0, -0.05], [0.5, 2.0, 0.05]), None);
        assert_eq!(told([-1.0, 0.0, -2.0], [1.0, 1.5, 2.0]), None);
        assert_eq!(told([-1.0; 3], [1.0; 3]), None);
        assert_eq!(told([0.0; 3], [1.0; 3]), None);
        let nothing = MeshBuilder::new(Vec::new()).finish().expect("a mesh");
        assert_eq!(lies_on_its_side(&nothing), None);
    }
}
