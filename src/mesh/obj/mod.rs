//! Wavefront OBJ files, with their MTL materials.
//!
//! Read are positions, their colours (`v x y z r g b`), normals, faces of any number of sides (concave ones too, never
//! triangulated), `mtllib` and
//! `usemtl`, objects (`o`) and smoothing groups (`s`). All objects become one mesh that shares positions by their index in
//! the file; positions that no face uses are dropped, the others keep the order in which faces first name them.
//! Numbers are read as `f64`: a mesh far from 0 is rounded relative to [`PolygonMesh::origin`].
//!
//! Files that gzip packed are unpacked. `tobj` does the parsing, between a pass that checks the text and knows its lines, and the checks of
//! [`MeshBuilder`]. What cannot be read is an [`ObjError`]; what can be read only in part is a warning.

pub(crate) mod content;
mod corner;
mod error;
pub(crate) mod gzip;
mod lines;
mod mtl;
mod parser;
mod prescan;
mod rounding;
#[cfg(test)]
mod tests;

pub use error::{ObjError, ObjProblem, VectorProblem};

use super::newell::unit_normal;
use super::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use glam::{DVec3, Vec3};
use mtl::Library;
use prescan::{MeshLimits, Prescan};
use std::collections::HashMap;
use std::ffi::OsStr;
use std::hash::Hash;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::string::{String, ToString};
use std::vec::Vec;
use std::{format, fs, io, vec};

/// A mesh from a file, and what the file held that the mesh does not.
#[derive(Clone, Debug)]
pub struct LoadedObj {
    /// The mesh. Its materials are those that its polygons use; a polygon without one has the default material.
    pub mesh: PolygonMesh,
    /// One line for each kind of thing that was passed over, most with the number of the first line concerned.
    pub warnings: Vec<String>,
    /// Those of the warnings that say nothing where other materials replace those of the file.
    #[doc(hidden)]
    pub material_warnings: Range<usize>,
}

/// Reads the OBJ file at `path`, and from the same directory the MTL files that it names.
///
/// A missing MTL file is a warning.
///
/// # Errors
/// [`ObjError`] with the line where there is one: the file cannot be read, is not OBJ text, has no polygons, has a face with a
/// position that is not three finite numbers or does not exist, or is larger than a [`PolygonMesh`] may be.
pub fn load_obj(path: &Path) -> Result<LoadedObj, ObjError> {
    load_obj_by(path, &mut |path| fs::read(path))
}

/// Reads the OBJ file at `path` and its MTL files as [`load_obj`] does, all by `read`: which may note what a mesh is made of. It is
/// asked for files that are not there, too.
///
/// # Errors
/// As [`load_obj`].
pub fn load_obj_by(
    path: &Path,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<LoadedObj, ObjError> {
    let failed = |problem| ObjError {
        path: path.into(),
        line: None,
        problem,
        warnings: Vec::new(),
    };
    if path.is_dir() {
        return Err(failed(ObjProblem::Directory));
    }
    let unreadable = |error| failed(ObjProblem::Unreadable(cause(path, error).to_string()));
    let bytes = read(path).map_err(unreadable)?;
    let directory = path.parent().unwrap_or(Path::new(""));
    let mut in_other_case = Vec::new();
    let loaded = parse_obj(path, &bytes, |name| {
        read_library(directory, name, read, &mut in_other_case)
    });
    loaded.map(|mut loaded| {
        loaded.warnings.append(&mut in_other_case);
        loaded
    })
}

/// Returns why `path` could not be read: `error`, unless it is a link to what is not there.
pub(crate) fn cause(path: &Path, error: io::Error) -> io::Error {
    match fs::read_link(path) {
        Ok(target) if error.kind() == io::ErrorKind::NotFound => io::Error::other(format!(
            "a link to {}, which is not there",
            target.display()
        )),
        _ => error,
    }
}

/// Reads the material library `name` by `read`, looked for from `directory`, and last by its bare file name there, in any case if
/// only one file has it: `warnings` tell then.
fn read_library(
    directory: &Path,
    name: &str,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    warnings: &mut Vec<String>,
) -> io::Result<Vec<u8>> {
    // A device or a pipe might never end.
    let mut read = |file: &Path| match fs::metadata(file) {
        Ok(found) if !found.is_file() => Err(io::Error::other("not a file")),
        _ => read(file),
    };
    // Exporters write paths of the machine they ran on, often with the other separator.
    let path = directory.join(name.replace('\\', "/"));
    read(&path).or_else(|error| {
        let Some(bare) = path.file_name() else {
            return Err(error);
        };
        read(&directory.join(bare)).or_else(|_| {
            let folders = [path.parent().unwrap_or(directory), directory];
            let found = folders.iter().find_map(|folder| in_any_case(folder, bare));
            // A link that leads nowhere is in its folder, too.
            let Some(found) = found.filter(|found| found.exists()) else {
                return Err(cause(&path, error));
            };
            let bytes = read(&found).map_err(|_| error)?;
            let (name, found) = (error::quote(name), found.display());
            warnings.push(format!(
                "material library `{name}` is not there: {found} is read"
            ));
            Ok(bytes)
        })
    })
}

/// Returns the only file in `folder` whose name is `name` but for the case of ASCII letters.
fn in_any_case(folder: &Path, name: &OsStr) -> Option<PathBuf> {
    let folder = match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    };
    let entries = fs::read_dir(folder).ok()?.flatten();
    let mut found = entries.filter(|entry| entry.file_name().eq_ignore_ascii_case(name));
    let first = found.next()?;
    found.next().is_none().then(|| first.path())
}

/// Reads the OBJ text `bytes`; `path` stands in errors only.
///
/// `load_mtl` is asked for the bytes of each material library, by the name that the text gives it; when it has none under
/// the whole rest of an `mtllib` line, it is asked for the names that the line may be made of.
///
/// # Errors
/// As [`load_obj`].
pub fn parse_obj(
    path: impl AsRef<Path>,
    bytes: &[u8],
    load_mtl: impl FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<LoadedObj, ObjError> {
    let limits = MeshLimits {
        polygons: PolygonMesh::MAX_POLYGONS,
        corners: PolygonMesh::MAX_CORNERS,
    };
    parse_limited(path.as_ref(), bytes, load_mtl, limits)
}

fn parse_limited(
    path: &Path,
    bytes: &[u8],
    mut load_mtl: impl FnMut(&str) -> io::Result<Vec<u8>>,
    limits: MeshLimits,
) -> Result<LoadedObj, ObjError> {
    let failed = |line, problem, warnings| ObjError {
        path: path.into(),
        line,
        problem,
        warnings,
    };
    let bytes = gzip::unpacked(bytes);
    let bytes = &*bytes
        .map_err(|error| failed(None, ObjProblem::Unreadable(error.to_string()), Vec::new()))?;
    if let Some(what) = content::foreign(bytes) {
        return Err(failed(None, ObjProblem::OtherFormat(what), Vec::new()));
    }
    let text = lines::decode(bytes);
    if text.trim().is_empty() {
        let problem = match bytes.contains(&b'\0') {
            true => ObjProblem::NotText,
            false => ObjProblem::Empty,
        };
        return Err(failed(None, problem, Vec::new()));
    }
    let scan = prescan::prescan(&text, limits);
    let scan = scan.map_err(|refusal| failed(refusal.line, refusal.problem, refusal.warnings))?;
    let mut warnings = scan.warnings();
    let parsed = parser::parse(&scan)
        .map_err(|why| failed(None, ObjProblem::Parser(why), warnings.clone()))?;

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
        // One is of the pre-scan's making, if any corner has no normal.
        let is_any_missing = scan.corners_with_normal < scan.corners;
        let zeros = vectors(&parsed.normals).zip(&values);
        // A NaN is a normal that was told when it was read.
        let zeros = zeros.filter(|(written, unit)| written.is_finite() && **unit == Vec3::ZERO);
        let zeros = zeros.count();
        let (zeros, have) = match zeros - usize::from(is_any_missing) {
            1 => (1, "normal of the file has"),
            zeros => (zeros, "normals of the file have"),
        };
        if zeros > 0 {
            warnings.push(format!(
                "{zeros} {have} length zero: corners that name one count as without a normal"
            ));
        }
        builder.normals(GivenNormals {
            values,
            corners: Some(parsed.normal_indices),
        });
    }
    if let Some(colours) = scan.used_colours() {
        builder.colours(colours);
    }
    builder.parts(groups(&scan.object_runs, HashMap::new(), scan.polygons));
    let off = HashMap::from([(&0, PolygonMesh::FACETED)]);
    builder.smoothing_groups(groups(&scan.smoothing_runs, off, scan.polygons));
    builder.stating_smoothing(!scan.smoothing_runs.is_empty());
    // Libraries are read even if no face uses a material: who writes files must know all that belong to the mesh.
    let mut told = Vec::new();
    let mut library = Library::load(&scan.libraries, &mut load_mtl, &mut told);
    let first = warnings.len();
    if scan.material_runs.iter().any(|(_, name)| name.is_some()) {
        warnings.append(&mut told);
        let (named, of_polygons) = assign_materials(&scan, &mut library, &mut warnings);
        warnings.extend(library.warnings());
        let (materials, names) = named.into_iter().unzip();
        builder.materials(materials, of_polygons);
        builder.material_names(names);
    }
    let material_warnings = first..warnings.len();
    let mesh = builder.finish();
    let mesh = mesh.map_err(|error| failed(None, ObjProblem::Mesh(error), warnings.clone()))?;
    warnings.extend(rounding::told(&mesh, &positions));
    Ok(LoadedObj {
        mesh,
        warnings,
        material_warnings,
    })
}

/// Returns the vectors whose coordinates stand one after the other in `flat`.
fn vectors(flat: &[f64]) -> impl Iterator<Item = DVec3> {
    flat.chunks_exact(3).map(DVec3::from_slice)
}

/// Returns `normal` with length one, or zero when it has no direction.
fn unit_or_zero(normal: DVec3) -> Vec3 {
    unit_normal(normal).map_or(Vec3::ZERO, |unit| unit.as_vec3())
}

/// Returns the number of the group of each polygon, from the statements that begin a group: those with equal keys have
/// equal numbers, `known` ones or new ones, and the polygons before the first statement have one of their own.
///
/// Empty if all polygons are in one group, unless that is [`PolygonMesh::FACETED`].
fn groups<'a, K: Eq + Hash>(
    runs: &'a [(usize, K)],
    known: HashMap<&'a K, u32>,
    polygons: usize,
) -> Vec<u32> {
    const BEFORE: u32 = PolygonMesh::FACETED + 1;
    if runs.is_empty() {
        return Vec::new();
    }
    let mut numbers = known;
    let mut of_polygons = vec![BEFORE; polygons];
    let starts = runs.iter().map(|(start, _)| *start);
    for ((start, key), end) in runs.iter().zip(starts.skip(1).chain([polygons])) {
        let new = BEFORE + 1 + numbers.len() as u32;
        of_polygons[*start..end].fill(*numbers.entry(key).or_insert(new));
    }
    let is_one = of_polygons.iter().all(|&group| group == of_polygons[0]);
    match is_one && of_polygons[0] != PolygonMesh::FACETED {
        true => Vec::new(),
        false => of_polygons,
    }
}

/// Returns the materials that polygons use with their names, and for each polygon the index of its own, `u32::MAX` for none.
fn assign_materials(
    scan: &Prescan,
    library: &mut Library,
    warnings: &mut Vec<String>,
) -> (Vec<(Material, String)>, Vec<u32>) {
    const NONE: u32 = u32::MAX;
    let mut materials = Vec::new();
    let mut unknown = Vec::new();
    let mut numbers = HashMap::new();
    let mut of_polygons = vec![NONE; scan.polygons];
    let starts = scan.material_runs.iter().map(|(start, _)| *start);
    let ends = starts.skip(1).chain([scan.polygons]);
    for ((start, name), end) in scan.material_runs.iter().zip(ends) {
        let Some(name) = name.as_ref().filter(|_| *start < end) else {
            continue;
        };
        let number = *numbers
            .entry(name)
            .or_insert_with(|| match library.use_material(name) {
                Some(material) => {
                    materials.push((material, error::quote(name)));
                    materials.len() as u32 - 1
                }
                None => {
                    unknown.push(format!("`{}`", error::quote(name)));
                    NONE
                }
            });
        of_polygons[*start..end].fill(number);
    }
    // One missing library explains all names that are missing.
    if library.is_complete && !unknown.is_empty() {
        warnings.push(format!(
            "no material library defines {}: the default material is used",
            list(&unknown)
        ));
    }
    (materials, of_polygons)
}

/// Returns `a`, `b` and 7 more: at most five names.
fn list(names: &[String]) -> String {
    let (shown, others) = names.split_at(names.len().min(5));
    let more = match others.len() {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    shown.join(", ") + &more
}
