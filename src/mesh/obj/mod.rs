//! Wavefront OBJ files, with their MTL materials.
//!
//! Read are positions, their colours (`v x y z r g b`), normals, faces of any number of sides (concave ones too, never
//! triangulated), `mtllib` and
//! `usemtl`. All objects and groups become one mesh that shares positions by their index in the file; positions that no
//! face uses are dropped, the others keep the order in which faces first name them.
//!
//! One pass reads the text and knows its lines; [`MeshBuilder`] checks the mesh. What cannot be read is an [`ObjError`]; what can be read only in part is a warning.

mod corner;
mod error;
mod lines;
mod mtl;
mod scan;
#[cfg(test)]
mod tests;

pub use error::{ObjError, ObjProblem};

use super::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use glam::{DVec3, Vec3};
use mtl::Library;
use scan::{Limits, Scan};
use std::borrow::ToOwned;
use std::collections::HashMap;
use std::path::Path;
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
}

/// Reads the OBJ file at `path`, and from the same directory the MTL files that it names.
///
/// A missing MTL file is a warning.
///
/// # Errors
/// [`ObjError`] with the line where there is one: the file cannot be read, is not OBJ text, has no polygons, holds numbers that are
/// not finite or indices that do not exist, or is larger than a [`PolygonMesh`] may be.
pub fn load_obj(path: &Path) -> Result<LoadedObj, ObjError> {
    let failed = |problem| ObjError::new(path, None, problem);
    if path.is_dir() {
        return Err(failed(ObjProblem::Directory));
    }
    let bytes =
        fs::read(path).map_err(|error| failed(ObjProblem::Unreadable(error.to_string())))?;
    let directory = path.parent().unwrap_or(Path::new(""));
    parse_obj(path, &bytes, |library| read_library(directory, library))
}

/// Reads the bytes of the material library `name`, looked for from `directory`, and last by its bare file name there.
fn read_library(directory: &Path, name: &str) -> io::Result<Vec<u8>> {
    // A device or a pipe might never end.
    let read = |file: &Path| {
        if fs::metadata(file)?.is_file() {
            fs::read(file)
        } else {
            Err(io::Error::other("not a file"))
        }
    };
    // Exporters write paths of the machine they ran on, often with the other separator.
    let path = directory.join(name.replace('\\', "/"));
    read(&path).or_else(|error| match path.file_name() {
        Some(bare) => read(&directory.join(bare)).map_err(|_| error),
        None => Err(error),
    })
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
    let limits = Limits {
        polygons: PolygonMesh::MAX_POLYGONS,
        corners: PolygonMesh::MAX_CORNERS,
    };
    parse_limited(path.as_ref(), bytes, load_mtl, limits)
}

fn parse_limited(
    path: &Path,
    bytes: &[u8],
    mut load_mtl: impl FnMut(&str) -> io::Result<Vec<u8>>,
    limits: Limits,
) -> Result<LoadedObj, ObjError> {
    if let Some(line) = lines::binary_line(bytes) {
        return Err(ObjError::new(path, Some(line), ObjProblem::NotText));
    }
    let text = lines::decode(bytes);
    if text.trim().is_empty() {
        return Err(ObjError::new(path, None, ObjProblem::Empty));
    }
    let scan =
        scan::scan(&text, limits).map_err(|(line, problem)| ObjError::new(path, line, problem))?;
    let mut warnings = scan.warnings();

    let corners = scan.corners.iter().map(|corner| corner.0);
    let (used, corners) = in_order_of_use(scan.positions.len(), corners);
    let mut builder = MeshBuilder::new(used.iter().map(|&i| scan.positions[i]).collect());
    builder.reserve(scan.sides.len(), corners.len());
    let mut rest = &corners[..];
    for &sides in &scan.sides {
        let (polygon, others) = rest.split_at(sides);
        builder.polygon(polygon);
        rest = others;
    }
    if scan.has_normals() {
        let corners = scan.corners.iter().filter_map(|corner| corner.1);
        let (used, corners) = in_order_of_use(scan.normals.len(), corners);
        let values = used.iter().map(|&i| unit_or_zero(scan.normals[i]));
        let values: Vec<Vec3> = values.collect();
        let zeros = values.iter().filter(|&&n| n == Vec3::ZERO).count();
        if zeros > 0 {
            let have = match zeros {
                1 => "normal of the file has",
                _ => "normals of the file have",
            };
            let what = format!("{have} length zero: averaged ones are used there");
            warnings.push(format!("{zeros} {what}"));
        }
        builder.normals(GivenNormals {
            values,
            corners: Some(corners),
        });
    }
    if scan.has_colours() {
        builder.colours(used.iter().map(|&i| scan.colours[i]).collect());
    }
    if !scan.material_names.is_empty() {
        let libraries = Libraries::load(&scan, &mut load_mtl, &mut warnings);
        let (materials, of_polygons) = assign_materials(&scan, &libraries, &mut warnings);
        builder.materials(materials, of_polygons);
    }
    let mesh = builder
        .finish()
        .map_err(|error| ObjError::new(path, None, ObjProblem::Mesh(error)))?;
    Ok(LoadedObj { mesh, warnings })
}

/// Returns those of `count` entries that `indices` name, in the order in which they first do, and for each index the place
/// of its entry among them.
fn in_order_of_use(count: usize, indices: impl Iterator<Item = usize>) -> (Vec<usize>, Vec<u32>) {
    let mut places: Vec<Option<u32>> = vec![None; count];
    let mut used = Vec::new();
    let place = |index: usize| {
        *places[index].get_or_insert_with(|| {
            used.push(index);
            used.len() as u32 - 1
        })
    };
    let corners = indices.map(place).collect();
    (used, corners)
}

/// Returns `normal` with length one, or zero when it has no direction.
fn unit_or_zero(normal: Vec3) -> Vec3 {
    // In f64 the squares of f32 numbers neither overflow nor, unless the normal is zero, vanish.
    let wide = DVec3::new(normal.x.into(), normal.y.into(), normal.z.into());
    let length = libm::sqrt(wide.length_squared());
    if length > 0.0 {
        (wide / length).as_vec3()
    } else {
        Vec3::ZERO
    }
}

/// The materials of every `mtllib`.
#[derive(Default)]
struct Libraries {
    library: Library,
    /// The names that were asked for: why there is no such library, until it is told.
    tried: HashMap<String, Result<(), Option<io::Error>>>,
    /// True if a library could not be had.
    incomplete: bool,
}

impl Libraries {
    fn load(
        scan: &Scan,
        load_mtl: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
        warnings: &mut Vec<String>,
    ) -> Libraries {
        let mut libraries = Libraries::default();
        for (line, rest) in &scan.libraries {
            let mut names = lines::name_candidates(rest);
            if names.any(|name| libraries.add(name, load_mtl, warnings).is_ok()) {
                continue;
            }
            for name in library_names(lines::without_comment(rest)) {
                let Err(error) = libraries.add(&name, load_mtl, warnings) else {
                    continue;
                };
                if let Some(error) = error.take() {
                    let name = error::quote(&name);
                    warnings.push(format!(
                        "material library `{name}` (line {line}) cannot be read: {error}"
                    ));
                }
                libraries.incomplete = true;
            }
        }
        libraries
    }

    /// Adds the library `name`, unless it was added before.
    fn add(
        &mut self,
        name: &str,
        load_mtl: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
        warnings: &mut Vec<String>,
    ) -> &mut Result<(), Option<io::Error>> {
        let Libraries { library, tried, .. } = self;
        tried.entry(name.to_owned()).or_insert_with(|| {
            let bytes = load_mtl(name).map_err(Some)?;
            library.add(name, &bytes, warnings);
            Ok(())
        })
    }
}

/// Returns the file names in an `mtllib` line that is not one file name: each ends with `.mtl`, as names may hold spaces.
fn library_names(rest: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut open = false;
    for word in rest.split_whitespace() {
        match names.last_mut() {
            Some(name) if open => *name += &format!(" {word}"),
            _ => names.push(word.to_owned()),
        }
        let ending = word.trim_end_matches('"').to_ascii_lowercase();
        open = !ending.ends_with(".mtl");
    }
    let bare = |name: &String| name.trim_matches('"').to_owned();
    names.iter().map(bare).collect()
}

/// Returns the materials that polygons use, and for each polygon the one it has.
fn assign_materials(
    scan: &Scan,
    libraries: &Libraries,
    warnings: &mut Vec<String>,
) -> (Vec<Material>, Vec<u32>) {
    const NONE: u32 = u32::MAX;
    let mut materials = Vec::new();
    let mut unknown = Vec::new();
    // For each name: not asked for yet, or the material it stands for.
    let mut numbers: Vec<Option<u32>> = vec![None; scan.material_names.len()];
    let mut of_polygons = vec![NONE; scan.sides.len()];
    let starts = scan.material_runs.iter().map(|&(start, _)| start);
    let ends = starts.skip(1).chain([scan.sides.len()]);
    for (&(start, name), end) in scan.material_runs.iter().zip(ends) {
        let Some(name) = name.filter(|_| start < end) else {
            continue;
        };
        let number = *numbers[name].get_or_insert_with(|| {
            match libraries.library.find(&scan.material_names[name]) {
                Some(material) => {
                    materials.push(material);
                    materials.len() as u32 - 1
                }
                None => {
                    unknown.push(format!("`{}`", error::quote(&scan.material_names[name])));
                    NONE
                }
            }
        });
        of_polygons[start..end].fill(number);
    }
    // One missing library explains all names that are missing.
    if !libraries.incomplete && !unknown.is_empty() {
        warnings.push(format!(
            "no material library defines {}: the default material is used",
            list(&unknown)
        ));
    }
    if materials.is_empty() {
        of_polygons.clear();
    }
    (materials, of_polygons)
}

/// Writes `a`, `b` and 7 more: at most five names.
fn list(names: &[String]) -> String {
    match names.split_at_checked(5) {
        Some((shown, more)) if !more.is_empty() => {
            format!("{} and {} more", shown.join(", "), more.len())
        }
        _ => names.join(", "),
    }
}
