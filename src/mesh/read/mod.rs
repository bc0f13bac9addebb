//! Mesh files: OBJ, STL, PLY, OFF and glTF.
//!
//! [`load_mesh`] reads a file, and [`parse_mesh`] reads bytes that are in memory already:
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
//! Files may be packed by gzip. The bytes of a file decide its format. If they do not, the ending
//! of its name does, and without a known ending the file counts as OBJ (glTF needs the feature
//! `gltf`).
//!
//! Polygons keep all their sides and are never triangulated. Positions are read with 64 bits, and a
//! mesh far from 0 is rounded relative to [`PolygonMesh::origin`]. A file that cannot be read is a
//! [`ReadError`] with its line or byte. If only parts of a file cannot be used, the mesh comes with
//! [`Notes`].

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
pub(crate) use gltf::{FileLens, FileLight, FileView, view};
#[doc(hidden)]
pub use polygons::coloured;

use super::{MeshBuilder, PolygonMesh};
use crate::note::{Note, Notes};
use error::Refusal;
use glam::DVec3;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::string::ToString;
use std::vec::Vec;
use std::{format, fs, io};

/// A mesh from a file, and notes about everything in the file that the mesh does not show.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct LoadedMesh {
    /// The mesh. It has the materials that its polygons use; a polygon without a material gets the
    /// default one.
    pub mesh: PolygonMesh,
    /// One note for each kind of thing that was skipped or changed, most with the line number of
    /// the first case. The kinds of those about materials begin with `material/`. They do not
    /// matter if other materials replace the file's.
    pub notes: Notes,
}

/// The result of a format's reader.
struct Parts {
    builder: MeshBuilder,
    /// The positions of the builder before rounding.
    positions: Vec<DVec3>,
    notes: Notes,
}

/// A function that reads a file that the mesh file names.
type Beside<'a> = &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>;

/// A format of mesh files.
trait MeshFormat: Sync {
    /// Returns the name of a file of this format, with its article: `an OBJ file`.
    fn name(&self) -> &'static str;

    /// Returns the endings of this format's file names, in lower case.
    fn endings(&self) -> &'static [&'static str];

    /// True if `bytes` are plainly of this format.
    fn recognises(&self, bytes: &[u8]) -> bool;

    /// Reads the polygons in `bytes`, and calls `beside` for the files that these name. Memory is
    /// allocated for the bytes that are there, never for a count that the file only claims.
    ///
    /// # Errors
    /// If there are no polygons, or something in the file is wrong.
    fn read(&self, bytes: &[u8], beside: Beside) -> Result<Parts, Refusal>;
}

/// All formats.
static FORMATS: &[&dyn MeshFormat] = &[
    &obj::Obj,
    &stl::Stl,
    &ply::Ply,
    &off::Off,
    #[cfg(feature = "gltf")]
    &gltf::Gltf,
];

/// The formats, in the words of messages.
pub(crate) const EXPECTED: &str = "a mesh file (OBJ, STL, PLY, OFF or glTF)";

/// Returns the endings of mesh files, in lower case and without the dot.
#[doc(hidden)]
pub fn mesh_endings() -> impl Iterator<Item = &'static str> {
    FORMATS
        .iter()
        .flat_map(|format| format.endings().iter().copied())
}

/// True if `path` ends in a dot and `ending`, in upper or lower case.
fn has_ending(path: &Path, ending: &str) -> bool {
    let found = path.extension();
    found.is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// True if `bytes` are plainly not a scene file, but a mesh file or a file of another kind.
pub(crate) fn is_no_scene(bytes: &[u8]) -> bool {
    content::foreign(bytes).is_some() || FORMATS.iter().any(|format| format.recognises(bytes))
}

/// Reads the mesh file at `path`.
///
/// Files that it names are read from its directory: material libraries of OBJ, buffers of glTF. A
/// missing material library is only a warning.
///
/// # Errors
/// [`ReadError`], with the line or byte if there is one: the file cannot be read, is no mesh file,
/// has no polygons, has a polygon with a position that does not exist or is not three finite
/// numbers, or is larger than a [`PolygonMesh`] may be.
pub fn load_mesh(path: &Path) -> Result<LoadedMesh, ReadError> {
    load_mesh_by(path, &mut |path| fs::read(path))
}

/// Reads a mesh file as [`load_mesh`] does, but opens every file through `read`, so that the caller
/// can record the files of a mesh. `read` is also called for files that do not exist.
///
/// # Errors
/// As [`load_mesh`].
pub(crate) fn load_mesh_by(
    path: &Path,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<LoadedMesh, ReadError> {
    let failed = |is_unreadable, problem| ReadError {
        path: path.into(),
        place: None,
        problem,
        notes: Notes::default(),
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
    let mut in_other_case = Notes::default();
    let loaded = parse_mesh(path, &bytes, |name| {
        read_beside(directory, name, read, &mut in_other_case)
    });
    loaded.map(|mut loaded| {
        loaded.notes.append(in_other_case);
        loaded
    })
}

/// Returns the reason why `path` could not be read. That is `error`, unless `path` is a link to a
/// file that does not exist.
pub(crate) fn cause(path: &Path, error: io::Error) -> io::Error {
    match fs::read_link(path) {
        Ok(target) if error.kind() == io::ErrorKind::NotFound => io::Error::other(format!(
            "a link to {}, which is not there",
            target.display()
        )),
        _ => error,
    }
}

/// Reads the file `name` that a mesh file names, through `read`. It is looked for as a path from
/// `directory`, then by its bare file name there, and last in upper or lower case if only one file
/// matches; that adds a note.
fn read_beside(
    directory: &Path,
    name: &str,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    notes: &mut Notes,
) -> io::Result<Vec<u8>> {
    // Reading a device or a pipe might never end.
    let mut read = |file: &Path| match fs::metadata(file) {
        Ok(found) if !found.is_file() => Err(io::Error::other("not a file")),
        _ => read(file),
    };
    // Exporters write paths of the machine that they ran on, often with backslashes.
    let path = directory.join(name.replace('\\', "/"));
    read(&path).or_else(|error| {
        let Some(bare) = path.file_name() else {
            return Err(error);
        };
        read(&directory.join(bare)).or_else(|_| {
            let folders = [path.parent().unwrap_or(directory), directory];
            let found = folders.iter().find_map(|folder| in_any_case(folder, bare));
            // A folder also lists links that lead nowhere; those do not count as found.
            let Some(found) = found.filter(|found| found.exists()) else {
                return Err(cause(&path, error));
            };
            let bytes = read(&found).map_err(|_| error)?;
            let what = if has_ending(Path::new(name), "bin") {
                "buffer"
            } else {
                "material library"
            };
            let name = error::quote(name);
            let found = found.display();
            notes.push(Note::warning(
                "file-in-other-case",
                format!("{what} `{name}` is not there: {found} is read instead"),
            ));
            Ok(bytes)
        })
    })
}

/// Returns the only file in `folder` whose name equals `name` if the case of ASCII letters is
/// ignored.
fn in_any_case(folder: &Path, name: &OsStr) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let entries = fs::read_dir(folder).ok()?.flatten();
    let mut found = entries.filter(|entry| entry.file_name().eq_ignore_ascii_case(name));
    let first = found.next()?;
    found.next().is_none().then(|| first.path())
}

/// Reads a mesh file from `bytes`. Errors name it by `path`, and the ending of `path` decides the
/// format if the bytes do not.
///
/// `beside` is called with the name of each file that this one names, and returns its bytes:
/// material libraries of OBJ, buffers of glTF. An `mtllib` line may hold one name with spaces or
/// several names, so `beside` is called with the whole line first, and with its parts if that
/// fails.
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
        notes: refusal.notes,
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

/// Returns the format of `bytes`, and a note if the ending of `path` belongs to another format.
///
/// # Errors
/// If the bytes are no mesh file.
fn format_of(
    path: &Path,
    bytes: &[u8],
) -> Result<(&'static dyn MeshFormat, Option<Note>), Refusal> {
    let mut formats = FORMATS.iter();
    let has_its_ending = |format: &dyn MeshFormat| {
        let mut endings = format.endings().iter();
        endings.any(|ending| has_ending(path, ending))
    };
    let by_ending = formats.clone().find(|format| has_its_ending(**format));
    if let Some(format) = formats.find(|format| format.recognises(bytes)) {
        let is_other = by_ending.is_some() && !has_its_ending(*format);
        let note = || {
            let name = format.name();
            let text = format!("is {name}, whatever its ending says, and read as one");
            Note::warning("ending-of-other-format", text)
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

/// Makes the mesh from the result of a reader.
fn finish(parts: Parts, odd: Option<Note>) -> Result<LoadedMesh, Refusal> {
    let mut notes = parts.notes;
    let mesh = match parts.builder.finish() {
        Ok(mesh) => mesh,
        Err(error) => {
            return Err(Refusal {
                place: None,
                problem: error.to_string(),
                notes,
            });
        }
    };
    if mesh.polygon_count() == 0 {
        return Err(Refusal {
            place: None,
            problem: "has no polygon: expected faces of at least three different corners".into(),
            notes,
        });
    }
    notes.append(rounding::notes(&mesh, &parts.positions));
    odd.into_iter().for_each(|note| notes.push(note));
    Ok(LoadedMesh { mesh, notes })
}
