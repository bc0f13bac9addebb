//! Mesh files: OBJ, STL, PLY, OFF and glTF, packed by gzip or not.
//!
//! ```
//! use fastphong::mesh::read::parse_mesh;
//!
//! let off = b"OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
//! let loaded = parse_mesh("a.off", off, |_| Err(std::io::ErrorKind::NotFound.into()))?;
//! assert_eq!(loaded.mesh.polygon(0), [0, 1, 2]);
//! # Ok::<(), fastphong::mesh::read::ReadError>(())
//! ```
//!
//! The bytes of a file decide what it is, and where they do not, the ending of its name; without one of those it counts as OBJ. Each
//! format has a reader in a file of its own. It makes polygons of any number of sides, never triangulated, of 64-bit positions: a mesh
//! far from 0 is rounded relative to [`PolygonMesh::origin`]. What cannot be read is a [`ReadError`] with its line or byte; what can be
//! read only in part is a warning.

pub(crate) mod content;
mod error;
#[cfg(feature = "gltf")]
mod gltf;
pub(crate) mod gzip;
mod obj;
mod off;
mod ply;
mod polygons;
mod rounding;
mod stl;
#[cfg(test)]
mod tests;
mod words;

pub use error::{Place, ReadError};
#[cfg(feature = "gltf")]
pub(crate) use gltf::{FileLight, FileView, view};

use super::{MeshBuilder, PolygonMesh};
use error::Refusal;
use glam::DVec3;
use std::ffi::OsStr;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::string::String;
use std::vec::Vec;
use std::{format, fs, io};

/// A mesh from a file, and what the file held that the mesh does not.
#[derive(Clone, Debug)]
pub struct LoadedMesh {
    /// The mesh. Its materials are those that its polygons use; a polygon without one has the default material.
    pub mesh: PolygonMesh,
    /// One line for each kind of thing that was passed over, most with the number of the first line concerned.
    pub warnings: Vec<String>,
    /// Those of the warnings that say nothing where other materials replace those of the file.
    #[doc(hidden)]
    pub material_warnings: Range<usize>,
}

/// What a reader makes of a file.
struct Parts {
    builder: MeshBuilder,
    /// The positions of the builder as the file has them.
    positions: Vec<DVec3>,
    /// What becomes [`LoadedMesh::warnings`], and those of them about materials.
    notes: Vec<String>,
    material_notes: Range<usize>,
}

/// Reads a file that a mesh file names.
type Beside<'a> = &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>;

/// A format of mesh files.
trait MeshFormat: Sync {
    /// Returns what a file of the format is called, with its article.
    fn name(&self) -> &'static str;

    /// Returns the endings of names of such files, in lower case.
    fn endings(&self) -> &'static [&'static str];

    /// True if `bytes` are plainly of this format.
    fn recognises(&self, bytes: &[u8]) -> bool;

    /// Reads the polygons in `bytes`, and by `beside` the files that these name. Takes memory for what there is, never for what a
    /// number in the file says that there will be.
    ///
    /// # Errors
    /// When there are none, or something in the file is not as it must be.
    fn read(&self, bytes: &[u8], beside: Beside) -> Result<Parts, Refusal>;
}

/// The formats that are read.
static FORMATS: &[&dyn MeshFormat] = &[
    &obj::Obj,
    &stl::Stl,
    &ply::Ply,
    &off::Off,
    #[cfg(feature = "gltf")]
    &gltf::Gltf,
];

/// The formats that are read, as messages name them.
pub(crate) const EXPECTED: &str = "a mesh file (OBJ, STL, PLY, OFF or glTF)";

/// Returns the endings of mesh files, in lower case and without a point.
#[doc(hidden)]
pub fn mesh_endings() -> impl Iterator<Item = &'static str> {
    FORMATS
        .iter()
        .flat_map(|format| format.endings().iter().copied())
}

/// True if `path` ends in a point and `ending`, in any case.
fn has_ending(path: &Path, ending: &str) -> bool {
    let found = path.extension();
    found.is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// True if `bytes` are plainly a mesh file, or a file of another kind, and no scene.
pub(crate) fn is_no_scene(bytes: &[u8]) -> bool {
    content::foreign(bytes).is_some() || FORMATS.iter().any(|format| format.recognises(bytes))
}

/// Reads the mesh file at `path`, and from the same directory the files that it names: material libraries of OBJ, buffers of glTF.
///
/// A missing material library is a warning.
///
/// # Errors
/// [`ReadError`] with the line or byte where there is one: the file cannot be read, is no mesh file, has no polygons, has a polygon
/// with a position that is not three finite numbers or does not exist, or is larger than a [`PolygonMesh`] may be.
pub fn load_mesh(path: &Path) -> Result<LoadedMesh, ReadError> {
    load_mesh_by(path, &mut |path| fs::read(path))
}

/// Reads the mesh file at `path` and those that it names as [`load_mesh`] does, all by `read`: which may note what a mesh is made of.
/// It is asked for files that are not there, too.
///
/// # Errors
/// As [`load_mesh`].
pub fn load_mesh_by(
    path: &Path,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<LoadedMesh, ReadError> {
    let failed = |is_unreadable, problem| ReadError {
        path: path.into(),
        place: None,
        problem,
        warnings: Vec::new(),
        is_unreadable,
    };
    if path.is_dir() {
        let problem = format!("is a directory: expected {EXPECTED}");
        return Err(failed(false, problem));
    }
    let bytes = read(path).map_err(|error| {
        let cause = cause(path, error);
        let problem = format!("cannot be read ({cause}): expected {EXPECTED}");
        failed(true, problem)
    })?;
    let directory = path.parent().unwrap_or(Path::new(""));
    let mut in_other_case = Vec::new();
    let loaded = parse_mesh(path, &bytes, |name| {
        read_beside(directory, name, read, &mut in_other_case)
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

/// Reads the file `name` that a mesh file names, by `read`: looked for from `directory`, and last by its bare file name there, in any case if
/// only one file has it: `warnings` tell then.
fn read_beside(
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
            let what = match has_ending(Path::new(name), "bin") {
                true => "buffer",
                false => "material library",
            };
            let name = error::quote(name);
            let found = found.display();
            warnings.push(format!("{what} `{name}` is not there: {found} is read"));
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

/// Reads the mesh file `bytes`; `path` stands in errors, and its ending counts where the bytes do not tell the format.
///
/// `beside` is asked for the bytes of each file that this one names, by the name that it gives: material libraries of OBJ, buffers of
/// glTF. When it has none under the whole rest of an `mtllib` line, it is asked for the names that the line may be made of.
///
/// # Errors
/// As [`load_mesh`].
pub fn parse_mesh(
    path: impl AsRef<Path>,
    bytes: &[u8],
    mut beside: impl FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<LoadedMesh, ReadError> {
    let path = path.as_ref();
    let failed = |refusal: Refusal| ReadError {
        path: path.into(),
        place: refusal.place,
        problem: refusal.problem,
        warnings: refusal.notes,
        is_unreadable: false,
    };
    let bytes = gzip::unpacked(bytes).map_err(|error| {
        failed(Refusal::whole(format!(
            "cannot be read ({error}): expected {EXPECTED}"
        )))
    })?;
    let (format, odd) = format_of(path, &bytes).map_err(failed)?;
    let parts = format.read(&bytes, &mut beside);
    let loaded = parts.and_then(|parts| finish(parts, odd));
    loaded.map_err(failed)
}

/// Returns the format of `bytes`, and a note if the ending of `path` is another one's.
///
/// # Errors
/// When the bytes are something else.
fn format_of(
    path: &Path,
    bytes: &[u8],
) -> Result<(&'static dyn MeshFormat, Option<String>), Refusal> {
    let mut formats = FORMATS.iter();
    let has_its_ending = |format: &dyn MeshFormat| {
        let mut endings = format.endings().iter();
        endings.any(|ending| has_ending(path, ending))
    };
    let by_ending = formats.clone().find(|format| has_its_ending(**format));
    if let Some(format) = formats.find(|format| format.recognises(bytes)) {
        let is_other = by_ending.is_some() && !has_its_ending(*format);
        let note = || {
            format!(
                "is {}, whatever its ending says, and read as one",
                format.name()
            )
        };
        return Ok((*format, is_other.then(note)));
    }
    match content::foreign(bytes) {
        Some(what) => Err(Refusal::whole(format!(
            "is {what}: expected {EXPECTED}{}",
            content::advice(what)
        ))),
        None => Ok((by_ending.copied().unwrap_or(&obj::Obj), None)),
    }
}

/// Makes the mesh of what a reader found.
fn finish(parts: Parts, odd: Option<String>) -> Result<LoadedMesh, Refusal> {
    let mut warnings = parts.notes;
    let mesh = match parts.builder.finish() {
        Ok(mesh) => mesh,
        Err(error) => {
            return Err(Refusal {
                place: None,
                problem: format!("{error}: expected a mesh within its limits"),
                notes: warnings,
            });
        }
    };
    if mesh.polygon_count() == 0 {
        return Err(Refusal {
            place: None,
            problem: "has no polygon: expected faces of at least three different corners".into(),
            notes: warnings,
        });
    }
    warnings.extend(rounding::told(&mesh, &parts.positions));
    warnings.extend(odd);
    Ok(LoadedMesh {
        mesh,
        warnings,
        material_warnings: parts.material_notes,
    })
}
