//! Wavefront OBJ files with their MTL materials.
//!
//! The reader uses positions, their colours (`v x y z r g b`), normals, faces of any number of
//! sides (also concave ones, and never triangulated), `mtllib` and `usemtl`, objects (`o`) and
//! smoothing groups (`s`). All objects become one mesh that shares positions by their index in the
//! file. Positions that no face uses are dropped; the others come in the order in which faces first
//! name them. Numbers are read as `f64`, and a mesh far from 0 is rounded relative to
//! [`PolygonMesh::origin`].
//!
//! `tobj` does the parsing. Before it, the pre-scan checks the text and knows its lines; after it,
//! [`MeshBuilder`] checks the mesh.

mod corner;
mod error;
mod lines;
mod mtl;
mod parser;
mod prescan;
#[cfg(test)]
mod tests;

use super::error::{Place, Refusal};
use super::polygons::like_bytes;
use super::{Beside, MeshFormat, Parts};
use crate::mesh::newell::unit_normal;
use crate::mesh::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use crate::note::{Note, Notes};
use error::ObjProblem;
use glam::{DVec3, Vec3};
use mtl::Library;
use prescan::{MeshLimits, Prescan};
use std::collections::HashMap;
use std::hash::Hash;
use std::string::{String, ToString};
use std::vec::Vec;
use std::{format, vec};

/// The format.
pub(super) struct Obj;

impl MeshFormat for Obj {
    fn name(&self) -> &'static str {
        "an OBJ file"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["obj"]
    }

    /// Returns false. Any text may be OBJ, and a file that no other format recognises counts as OBJ
    /// anyway.
    fn recognises(&self, _: &[u8]) -> bool {
        false
    }

    fn read(&self, bytes: &[u8], load_mtl: Beside) -> Result<Parts, Refusal> {
        let limits = MeshLimits {
            polygons: PolygonMesh::MAX_POLYGONS,
            corners: PolygonMesh::MAX_CORNERS,
        };
        read_limited(bytes, load_mtl, limits)
    }
}

fn read_limited(bytes: &[u8], mut load_mtl: Beside, limits: MeshLimits) -> Result<Parts, Refusal> {
    let failed = |line: Option<usize>, problem: ObjProblem, notes| Refusal {
        place: line.map(Place::Line),
        problem: problem.to_string(),
        notes,
    };
    let text = lines::decode(bytes);
    if text.trim().is_empty() {
        let problem = if bytes.contains(&b'\0') {
            ObjProblem::NotText
        } else {
            ObjProblem::Empty
        };
        return Err(failed(None, problem, Notes::default()));
    }
    let scan = prescan::prescan(&text, limits);
    let scan = scan.map_err(|refusal| failed(refusal.line, refusal.problem, refusal.notes))?;
    let mut notes = scan.notes.clone();
    let parsed =
        parser::parse(&scan).map_err(|why| failed(None, ObjProblem::Parser(why), notes.clone()))?;

    let positions: Vec<DVec3> = vectors(&parsed.positions).collect();
    let mut builder = MeshBuilder::from_f64(&positions);
    builder.read_from_file();
    builder.reserve(scan.polygons, scan.corners);
    let mut rest = &parsed.indices[..];
    for &sides in &parsed.face_arities {
        let (polygon, others) = rest.split_at(sides as usize);
        builder.polygon(polygon);
        rest = others;
    }
    if scan.has_normals() {
        let values: Vec<Vec3> = vectors(&parsed.normals).map(unit_or_zero).collect();
        // If a corner has no normal, one zero comes from the pre-scan and not from the file.
        let is_any_missing = scan.corners_with_normal < scan.corners;
        let zeros = vectors(&parsed.normals).zip(&values);
        // A NaN stands for a normal that the pre-scan reported already.
        let zeros = zeros.filter(|(written, unit)| written.is_finite() && **unit == Vec3::ZERO);
        let zeros = zeros.count();
        let (zeros, have) = match zeros - usize::from(is_any_missing) {
            1 => (1, "normal of the file has"),
            zeros => (zeros, "normals of the file have"),
        };
        if zeros > 0 {
            let text = format!(
                "{zeros} {have} length zero: corners that name one count as without a normal"
            );
            notes.push(Note::warning("normals-zero", text));
        }
        builder.normals(GivenNormals {
            values,
            corners: Some(parsed.normal_indices),
        });
    }
    if scan.has_colours_like_bytes() {
        notes.push(like_bytes());
    }
    if let Some(colours) = scan.used_colours() {
        builder.colours(colours);
    }
    builder.parts(groups(&scan.object_runs, HashMap::new(), scan.polygons));
    let off = HashMap::from([(&0, PolygonMesh::FACETED)]);
    builder.smoothing_groups(groups(&scan.smoothing_runs, off, scan.polygons));
    builder.stating_smoothing(!scan.smoothing_runs.is_empty());
    // Libraries are read even if no face uses a material, because a caller that copies the mesh's
    // files must learn of all of them. Their notes matter only if a material is used.
    let mut library = Library::load(&scan.libraries, &mut load_mtl, &mut notes);
    if !scan.material_runs.is_empty() {
        let (named, of_polygons) = assign_materials(&scan, &mut library, &mut notes);
        notes.append(library.notes());
        let (materials, names) = named.into_iter().unzip();
        builder.materials(materials, of_polygons);
        builder.material_names(names);
    } else {
        notes.remove("material/");
    }
    Ok(Parts {
        builder,
        positions,
        notes,
    })
}

/// Returns the vectors in a flat list of coordinates.
fn vectors(flat: &[f64]) -> impl Iterator<Item = DVec3> {
    flat.chunks_exact(3).map(DVec3::from_slice)
}

/// Returns the unit vector along `normal`, or zero if it has no direction.
fn unit_or_zero(normal: DVec3) -> Vec3 {
    unit_normal(normal).map_or(Vec3::ZERO, |unit| unit.as_vec3())
}

/// Returns the group of each polygon. `runs` are the statements that begin a group, each with its
/// first polygon and a key. Equal keys make one group, whose index is in `known` or new. The
/// polygons before the first statement have their own group.
///
/// The list is empty if all polygons are in one group, unless that group is
/// [`PolygonMesh::FACETED`].
fn groups<'a, K: Eq + Hash>(
    runs: &'a [(usize, K)],
    known: HashMap<&'a K, u32>,
    polygons: usize,
) -> Vec<u32> {
    const BEFORE: u32 = PolygonMesh::FACETED + 1;
    if runs.is_empty() {
        return Vec::new();
    }
    let mut indices = known;
    let mut of_polygons = vec![BEFORE; polygons];
    let starts = runs.iter().map(|(start, _)| *start);
    // Each run ends where the next one starts.
    for ((start, key), end) in runs.iter().zip(starts.skip(1).chain([polygons])) {
        let new = BEFORE + 1 + indices.len() as u32;
        of_polygons[*start..end].fill(*indices.entry(key).or_insert(new));
    }
    let is_one = of_polygons.iter().all(|&group| group == of_polygons[0]);
    if is_one && of_polygons[0] != PolygonMesh::FACETED {
        Vec::new()
    } else {
        of_polygons
    }
}

/// Returns the materials that polygons use, with their names, and for each polygon the index of its
/// material, `u32::MAX` for none.
fn assign_materials(
    scan: &Prescan,
    library: &mut Library,
    notes: &mut Notes,
) -> (Vec<(Material, String)>, Vec<u32>) {
    const NONE: u32 = u32::MAX;
    let mut materials = Vec::new();
    let mut unknown = Vec::new();
    let mut indices = HashMap::new();
    let mut of_polygons = vec![NONE; scan.polygons];
    let starts = scan.material_runs.iter().map(|(start, _)| *start);
    let ends = starts.skip(1).chain([scan.polygons]);
    for ((start, name), end) in scan.material_runs.iter().zip(ends) {
        if *start == end {
            continue;
        }
        let index = *indices
            .entry(name)
            .or_insert_with(|| match library.use_material(name) {
                Some(material) => {
                    let name = match &name[..] {
                        "" => String::new(),
                        name => error::quote(name),
                    };
                    materials.push((material, name));
                    materials.len() as u32 - 1
                }
                None => {
                    unknown.push(match &name[..] {
                        "" => "a material without a name".into(),
                        name => format!("`{}`", error::quote(name)),
                    });
                    NONE
                }
            });
        of_polygons[*start..end].fill(index);
    }
    // If a library is missing, that was reported and explains the unknown names.
    if library.is_complete && !unknown.is_empty() {
        let names = list(&unknown);
        let text = format!("no material library defines {names}: the default material is used");
        notes.push(Note::warning("material/undefined", text));
    }
    (materials, of_polygons)
}

/// Returns names as text, at most five of them: `a, b and 7 more`.
fn list(names: &[String]) -> String {
    let (shown, others) = names.split_at(names.len().min(5));
    let more = match others.len() {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    shown.join(", ") + &more
}
