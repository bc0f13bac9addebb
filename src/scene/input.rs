//! Inputs that a user names: a scene file, a mesh file, a built-in mesh, or a shipped scene.
//!
//! | input | meaning |
//! |---|---|
//! | `path/to/scene.toml` | a scene file |
//! | `path/to/mesh.obj`, `.stl`, `.ply`, `.off`, `.gltf`, `.glb` | a mesh file, in the scene of [`SceneFile::for_mesh`] |
//! | any other file, device or pipe | a scene file or a mesh file, depending on its bytes |
//! | `builtin:NAME?key=value&key=value` | a built-in mesh, in the scene of [`SceneFile::for_mesh`] |
//! | `teapot` | a shipped scene: the name of one of [`SCENES`] |
//! | `-` | a scene file or a mesh file on standard input |
//!
//! Files may be compressed by gzip, whatever their names are.
//!
//! Shipped scenes and their mesh files are compiled into the program. Scene files elsewhere can
//! name a shipped mesh `shipped:vase.obj`.
//!
//! ```
//! let file = fastphong::scene::input::load("football")?;
//! let resolved = fastphong::scene::input::resolve(&file)?;
//! assert_eq!(resolved.scene.objects.len(), 2);
//! # Ok::<(), fastphong::scene::file::SceneError>(())
//! ```

use super::file::diagnostics::{Origin, SceneError};
use super::file::resolve::{MeshResult, Resolved, UnusableMesh};
use super::file::value::{Data, Value};
use super::file::{BUILTIN, STANDARD_INPUT, SceneFile, shown};
use crate::mesh::builtin::{BUILTINS, builtin};
#[cfg(feature = "gltf")]
use crate::mesh::read::view;
use crate::mesh::read::{
    ReadError, cause, gzip, is_no_scene, load_mesh_by as read_mesh_by, mesh_endings, parse_mesh,
};
use crate::note::Notes;
use crate::number::suggest::nearest;
use std::borrow::ToOwned;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::string::{String, ToString};
use std::sync::{Arc, Mutex, PoisonError};
use std::vec::Vec;
use std::{format, fs, io};

/// A scene that is compiled into the program.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct ShippedScene {
    /// The name: the file name without its ending.
    pub name: &'static str,
    /// The contents of the file.
    pub text: &'static str,
}

macro_rules! shipped {
    ($($name:literal)*) => {
        &[$(ShippedScene { name: $name, text: include_str!(concat!("../../scenes/", $name, ".toml")) }),*]
    };
}

/// The shipped scenes, in the order of `scenes/README.md`, which says what each of them tests.
pub static SCENES: &[ShippedScene] = shipped![
    "coarse-sphere" "fine-sphere" "teapot" "knot-100k" "million" "sharp-highlight" "four-lights" "polygons" "vase"
    "football" "perspective" "figure5" "ellipsoid" "mirrored" "corrugated" "terrain"
    "cyclic-triangles" "interpenetration" "z-fighting"
    "local-lights" "blinn" "two-lights"
];

/// The files that shipped scenes name.
static SHIPPED_FILES: &[(&str, &[u8])] = &[
    ("vase.obj", include_bytes!("../../scenes/vase.obj")),
    ("vase.mtl", include_bytes!("../../scenes/vase.mtl")),
    ("football.obj", include_bytes!("../../scenes/football.obj")),
    ("football.mtl", include_bytes!("../../scenes/football.mtl")),
];

const SHIPPED: &str = "shipped:";

/// The format of an input whose name does not tell it: standard input, or a file with another
/// ending.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub enum InputFormat {
    /// A mesh file of any format.
    Mesh,
    /// A scene file.
    Toml,
}

impl InputFormat {
    /// Returns the format of `bytes`, which may be compressed. A scene file begins with a table, or
    /// with a key and `=`. Everything else is left to the reader of meshes, which says what it
    /// found.
    fn of(bytes: &[u8]) -> InputFormat {
        let text = &*gzip::start(bytes, ENOUGH);
        if is_no_scene(text) {
            return InputFormat::Mesh;
        }
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let lines = text.split(|byte| matches!(byte, b'\n' | b'\r'));
        let mut lines = lines.map(<[u8]>::trim_ascii);
        let first = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"));
        let first = first.unwrap_or_default();
        let equals = first.iter().position(|byte| *byte == b'=');
        let key = first[..equals.unwrap_or(0)].trim_ascii();
        let has_key = !key.is_empty() && !key.iter().any(u8::is_ascii_whitespace);
        if has_key || first.starts_with(b"[") {
            InputFormat::Toml
        } else {
            InputFormat::Mesh
        }
    }
}

/// How many bytes are enough to recognise the format.
const ENOUGH: usize = 1 << 16;

/// How many bytes are read at most from a pipe or a device, which may never end.
const MOST_PIPED: u64 = 1 << 30;

/// Reads a file, or standard input, whose name is [`STANDARD_INPUT`]. Standard input, pipes and
/// devices are read once, up to 1 GiB. Further calls return the same bytes.
///
/// # Errors
/// Errors of the operating system, and if a pipe holds more.
#[doc(hidden)]
pub fn read_input(path: &Path) -> io::Result<Vec<u8>> {
    static READ: Mutex<BTreeMap<PathBuf, Result<Vec<u8>, String>>> = Mutex::new(BTreeMap::new());
    let is_input = path.as_os_str() == STANDARD_INPUT;
    if !is_input {
        let found = fs::metadata(path)?;
        if found.is_file() || found.is_dir() {
            return fs::read(path);
        }
    }
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    let known = read.entry(path.to_owned()).or_insert_with(|| {
        let bytes = if is_input {
            read_to_end(io::stdin().lock())
        } else {
            fs::File::open(path).and_then(read_to_end)
        };
        bytes.map_err(|error| error.to_string())
    });
    known.clone().map_err(io::Error::other)
}

/// Reads a pipe to its end.
fn read_to_end(pipe: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    pipe.take(MOST_PIPED + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_PIPED {
        Err(io::Error::other(format!(
            "more than {} MiB come from it",
            MOST_PIPED >> 20
        )))
    } else {
        Ok(bytes)
    }
}

impl ShippedScene {
    /// Returns the shipped scene called `name`.
    pub fn named(name: &str) -> Option<&'static ShippedScene> {
        SCENES.iter().find(|scene| scene.name == name)
    }

    /// Reads the scene. Its meshes can be found from any folder.
    ///
    /// # Errors
    /// None, as long as the shipped files are the tested ones.
    pub fn load(&self) -> Result<SceneFile, SceneError> {
        let mut file = SceneFile::parse(self.text, format!("{SHIPPED}{}.toml", self.name))?;
        rename_meshes(&mut file, |mesh| {
            shipped_file(mesh).map(|_| format!("{SHIPPED}{mesh}"))
        });
        Ok(file)
    }
}

fn shipped_file(name: &str) -> Option<&'static [u8]> {
    SHIPPED_FILES
        .iter()
        .find(|(file, _)| *file == name)
        .map(|(_, bytes)| *bytes)
}

/// Reads the scene that `input` names. Its meshes are not loaded yet.
///
/// # Errors
/// [`SceneError`] if there is no such input, or it is not a valid scene file.
pub fn load(input: &str) -> Result<SceneFile, SceneError> {
    load_by(input, &mut read_input)
}

/// Reads the scene that `input` names as [`load`] does. `read` returns the contents of files, and
/// may record which files a scene needs.
///
/// # Errors
/// As for [`load`].
pub fn load_by(
    input: &str,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<SceneFile, SceneError> {
    if input == STANDARD_INPUT {
        return load_standard_input(None, read);
    }
    if input.starts_with(BUILTIN) || input.starts_with(SHIPPED) {
        return Ok(SceneFile::for_mesh(input.to_owned()));
    }
    if let Some(scene) = ShippedScene::named(input) {
        return scene.load();
    }
    load_file_by(input, Path::new(input), read)
}

/// Reads the scene or mesh file at `path` as [`load_by`] does. `input` is its name in messages, and
/// the name of the scene's mesh.
///
/// # Errors
/// As for [`load_by`].
#[doc(hidden)]
pub fn load_file_by(
    input: &str,
    path: &Path,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<SceneFile, SceneError> {
    let is_piped = match fs::metadata(path) {
        Err(error) => return Err(missing(input, path, error)),
        Ok(found) if found.is_dir() => {
            let expected = "expected a scene file or a mesh file";
            let problem = format!("{input}: is a directory");
            return Err(SceneError::new(Origin::Program, problem, expected));
        }
        // A file that is already open belongs to no folder either.
        Ok(found) => !found.is_file() || ["/dev", "/proc"].iter().any(|top| path.starts_with(top)),
    };
    let format = match () {
        _ if has_ending(path, "toml") => InputFormat::Toml,
        _ if mesh_endings().any(|ending| has_ending(path, ending)) => InputFormat::Mesh,
        _ => match read(path) {
            Ok(bytes) => InputFormat::of(&bytes),
            Err(error) => {
                let problem = format!("{input}: cannot be read: {error}");
                return Err(SceneError::new(Origin::Program, problem, ""));
            }
        },
    };
    match format {
        InputFormat::Toml if is_piped => {
            let bytes = read(path);
            let name = pipe_name(path);
            let again = |error: &io::Error| io::Error::other(error.to_string());
            SceneFile::load_by(Path::new(&name), &mut |_| {
                bytes.as_ref().map(Vec::clone).map_err(again)
            })
        }
        InputFormat::Toml => SceneFile::load_by(path, read),
        InputFormat::Mesh => Ok(mesh_alone(input, path, read)),
    }
}

/// Returns the default scene around the mesh file `input` at `path`, with the file's camera and
/// lights if it has any.
#[cfg(feature = "gltf")]
fn mesh_alone(
    input: &str,
    path: &Path,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> SceneFile {
    let mut file = SceneFile::for_mesh(input.to_owned());
    // Files of other formats have no camera, and need not be read twice.
    let may_have_some = ["gltf", "glb", "gz"];
    let is_other = mesh_endings().any(|ending| has_ending(path, ending));
    if !is_other || may_have_some.iter().any(|ending| has_ending(path, ending)) {
        let bytes = read(path).ok();
        let bytes = bytes.as_deref().map(gzip::unpacked);
        if let Some(Ok(bytes)) = bytes
            && let Some(view) = view(&bytes)
        {
            file.see_as(&view);
        }
    }
    file
}

#[cfg(not(feature = "gltf"))]
fn mesh_alone(input: &str, _: &Path, _: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>) -> SceneFile {
    SceneFile::for_mesh(input.to_owned())
}

/// Returns the name of a scene that comes from a pipe or a device, for messages. The name has no
/// folder, so that its meshes are relative to the current one, as with standard input.
fn pipe_name(path: &Path) -> String {
    match path.to_str() {
        Some("/dev/stdin" | "/dev/fd/0" | "/proc/self/fd/0") => shown(STANDARD_INPUT).to_owned(),
        _ => format!(
            "pipe {}",
            path.file_name().unwrap_or_default().to_string_lossy()
        ),
    }
}

/// Reads the scene on standard input. `read` gets the name [`STANDARD_INPUT`]. Without a `format`,
/// the text decides.
///
/// # Errors
/// If it cannot be read, and the errors of [`SceneFile::load`].
#[doc(hidden)]
pub fn load_standard_input(
    format: Option<InputFormat>,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<SceneFile, SceneError> {
    let path = Path::new(STANDARD_INPUT);
    let bytes = read(path).map_err(|error| {
        let problem = format!("{}: cannot be read: {error}", shown(STANDARD_INPUT));
        SceneError::new(Origin::Program, problem, "")
    })?;
    match format.unwrap_or_else(|| InputFormat::of(&bytes)) {
        InputFormat::Mesh => Ok(mesh_alone(STANDARD_INPUT, path, read)),
        InputFormat::Toml => {
            SceneFile::load_by(Path::new(shown(STANDARD_INPUT)), &mut |_| Ok(bytes.clone()))
        }
    }
}

/// Makes the error for an input that does not exist or cannot be read for another reason.
fn missing(input: &str, path: &Path, error: io::Error) -> SceneError {
    use io::ErrorKind::{InvalidInput, NotADirectory, NotFound};
    let is_link = fs::read_link(path).is_ok();
    if is_link || !matches!(error.kind(), NotFound | NotADirectory | InvalidInput) {
        let problem = format!("`{input}` cannot be read: {}", cause(path, error));
        return SceneError::new(Origin::Program, problem, "");
    }
    let scenes = || SCENES.iter().map(|scene| scene.name);
    // `scenes/teapto.toml` probably means `teapot`, and `sphere` the built-in mesh.
    let stem = path.file_stem().and_then(|stem| stem.to_str());
    let stem = stem.unwrap_or(input);
    let shape = || is_builtin(stem).then(|| format!("{BUILTIN}{stem}"));
    let hint = match nearest(stem, scenes())
        .map(ToString::to_string)
        .or_else(shape)
    {
        Some(meant) => format!("; did you mean `{meant}`?"),
        None if has_known_ending(path) => String::new(),
        None => format!(
            " (expected a scene file .toml, a mesh file ({}), builtin:NAME, or one of {})",
            mesh_endings()
                .map(|ending| format!(".{ending}"))
                .collect::<Vec<_>>()
                .join(" "),
            scenes().collect::<Vec<_>>().join(", ")
        ),
    };
    let problem = "is neither a file nor the name of a shipped scene";
    SceneError::new(Origin::Program, format!("`{input}` {problem}{hint}"), "")
}

fn is_builtin(name: &str) -> bool {
    BUILTINS.iter().any(|shape| shape.name == name)
}

/// True if the mesh name `mesh` in a scene is a file, and neither compiled into the program nor
/// standard input.
#[doc(hidden)]
pub fn is_mesh_file(mesh: &str) -> bool {
    !mesh.starts_with(BUILTIN) && !mesh.starts_with(SHIPPED) && mesh != STANDARD_INPUT
}

/// True if `path` has the ending of a scene file or a mesh file.
#[doc(hidden)]
pub fn has_known_ending(path: &Path) -> bool {
    has_ending(path, "toml") || mesh_endings().any(|ending| has_ending(path, ending))
}

/// True if `path` ends in a dot and `ending`, in any case.
#[doc(hidden)]
pub fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// Returns the scene that `file` describes, with its meshes, and notes about it.
///
/// # Errors
/// [`SceneError`] if a value is out of its range or a mesh cannot be used.
pub fn resolve(file: &SceneFile) -> Result<Resolved, SceneError> {
    resolve_by(file, &mut read_input)
}

/// Returns the scene that `file` describes, as [`resolve`] does. `read` returns the contents of
/// meshes and material libraries. It is also called for files that do not exist.
///
/// # Errors
/// As for [`resolve`].
pub fn resolve_by(
    file: &SceneFile,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Resolved, SceneError> {
    file.resolve(|name, folder| load_mesh_by(name, folder, read))
}

/// Loads the mesh called `name`: `builtin:…`, `shipped:…`, `-`, or a mesh file relative to
/// `folder`. Returns it with the loader's notes.
///
/// # Errors
/// [`UnusableMesh`] says what is wrong, in which file and line, and what was expected.
pub fn load_mesh(name: &str, folder: &Path) -> MeshResult {
    load_mesh_by(name, folder, &mut read_input)
}

/// Loads the mesh called `name` as [`load_mesh`] does. `read` returns the contents of files.
///
/// # Errors
/// As for [`load_mesh`].
pub fn load_mesh_by(
    name: &str,
    folder: &Path,
    read: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
) -> MeshResult {
    if let Some(spec) = name.strip_prefix(BUILTIN) {
        let mesh = builtin(spec).map_err(|error| UnusableMesh::new(error.to_string()))?;
        return Ok((Arc::new(mesh), Notes::default()));
    }
    let loaded = if let Some(file) = name.strip_prefix(SHIPPED) {
        let Some(bytes) = shipped_file(file) else {
            let files = SHIPPED_FILES.iter().map(|(name, _)| *name);
            let meshes: Vec<&str> = files.filter(|name| name.ends_with(".obj")).collect();
            let meshes = meshes.join(", ");
            return Err(UnusableMesh::new(format!(
                "no mesh `{file}` is shipped: expected one of {meshes}"
            )));
        };
        parse_mesh(name, bytes, |name| {
            let bytes = shipped_file(name).map(<[u8]>::to_vec);
            bytes.ok_or(std::io::ErrorKind::NotFound.into())
        })
    } else if name == STANDARD_INPUT {
        read_mesh_by(Path::new(name), read).map_err(|error| ReadError {
            path: shown(name).into(),
            ..error
        })
    } else {
        let path: PathBuf = folder.join(name);
        let loaded = read_mesh_by(&path, read);
        let is_shape = is_builtin(name.split('?').next().unwrap_or_default());
        if is_shape && matches!(&loaded, Err(error) if error.is_unreadable) {
            let hint = format!("did you mean `{BUILTIN}{name}`?");
            let reason = format!("`{name}` is not a mesh file; {hint}");
            return Err(UnusableMesh::new(reason));
        }
        loaded
    };
    let loaded = loaded.map_err(|error| UnusableMesh {
        reason: error.to_string(),
        notes: error.notes,
    })?;
    Ok((Arc::new(loaded.mesh), loaded.notes.about(shown(name))))
}

/// Rewrites the mesh paths of `file` relative to the current folder, so that the scene can be
/// written down there.
#[doc(hidden)]
pub fn make_paths_relative_to_current_folder(file: &mut SceneFile) {
    let Some(folder) = file.path().and_then(Path::parent).map(Path::to_owned) else {
        return;
    };
    rename_meshes(file, |mesh| {
        is_mesh_file(mesh).then(|| folder.join(mesh).to_string_lossy().into_owned())
    });
}

/// Renames each mesh that the scene file itself names, wherever `rename` returns a name.
fn rename_meshes(file: &mut SceneFile, rename: impl Fn(&str) -> Option<String>) {
    for object in file.objects_mut() {
        if let Some(Value {
            data: Data::Text(mesh),
            origin: Origin::File(_),
        }) = object.entries.get_mut("mesh")
            && let Some(new) = rename(mesh)
        {
            *mesh = new;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every scene file of the folder is in the table, in the README's order, and its text is the
    /// file's.
    #[test]
    fn the_table_holds_every_shipped_scene() {
        let readme = include_str!("../../scenes/README.md");
        let rows = readme
            .lines()
            .filter_map(|line| line.strip_prefix("| `")?.split_once(".toml` |"));
        let listed: Vec<&str> = rows.map(|(name, _)| name).collect();
        assert_eq!(
            SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>(),
            listed
        );
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        for entry in std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
        {
            let name = entry.file_name().unwrap().to_str().unwrap();
            match name.strip_suffix(".toml") {
                Some(scene) => assert!(ShippedScene::named(scene).is_some(), "{name}"),
                None => assert!(
                    name == "README.md" || shipped_file(name).is_some(),
                    "{name}"
                ),
            }
        }
    }

    #[test]
    fn a_shipped_scene_is_the_scene_in_its_file() {
        for scene in SCENES.iter().filter(|scene| scene.name != "million") {
            let path = Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("scenes")
                .join(scene.name)
                .with_extension("toml");
            let mut from_file = resolve(&load(path.to_str().unwrap()).unwrap()).unwrap();
            let mut embedded = resolve(&load(scene.name).unwrap()).unwrap();
            // The mesh of a shipped scene is `shipped:vase.obj`.
            for resolved in [&mut from_file, &mut embedded] {
                let objects = resolved.scene.objects.iter_mut();
                objects.for_each(|object| object.name.clear());
            }
            assert_eq!(
                format!("{:?}", embedded.scene),
                format!("{:?}", from_file.scene),
                "{}",
                scene.name
            );
            assert_eq!(
                (embedded.notes, from_file.notes),
                (Notes::default(), Notes::default()),
                "{}",
                scene.name
            );
        }
    }

    #[test]
    fn the_format_of_a_text_is_seen() {
        for (text, format) in [
            ("", InputFormat::Mesh),
            ("# a=1\n\nv 0 0 0\n", InputFormat::Mesh),
            ("o a = b\r[\r", InputFormat::Mesh),
            ("=\n", InputFormat::Mesh),
            ("\u{feff}# scene\n[image]\nwidth = 3\n", InputFormat::Toml),
            ("  camera.fit=1\n", InputFormat::Toml),
            ("title = \"a\"\r\n", InputFormat::Toml),
            ("[[object]]", InputFormat::Toml),
            ("[a\0b\0", InputFormat::Toml),
            ("[\0a\0b\0", InputFormat::Mesh),
            ("{\"a\"=", InputFormat::Mesh),
        ] {
            assert_eq!(InputFormat::of(text.as_bytes()), format, "{text:?}");
        }
    }

    #[test]
    fn what_is_not_there_is_said_in_one_sentence() {
        for (input, said) in [
            (
                "taepot",
                "`taepot` is neither a file nor the name of a shipped scene; did you mean `teapot`?",
            ),
            ("scenes/taepot.toml", "did you mean `teapot`?"),
            ("torus", "did you mean `builtin:torus`?"),
            (
                "nothing-like-it.obj",
                "`nothing-like-it.obj` is neither a file nor the name of a shipped scene",
            ),
            (
                "nothing-like-it",
                "is neither a file nor the name of a shipped scene (expected a scene file .toml, a mesh file (.obj .stl .ply .off",
            ),
            (
                "src",
                "src: is a directory: expected a scene file or a mesh file",
            ),
        ] {
            let error = load(input).unwrap_err();
            assert!(error.to_string().contains(said), "{error}");
            assert!(!error.to_string().contains('\n'));
        }
        let error = resolve(&load("builtin:spere").unwrap()).unwrap_err();
        assert!(
            error
                .to_string()
                .starts_with("no built-in mesh is named `spere`; did you mean `sphere`?"),
            "{error}"
        );
        let error = resolve(&load("shipped:teapot.obj").unwrap()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "no mesh `teapot.obj` is shipped: expected one of vase.obj, football.obj"
        );
    }

    #[test]
    fn a_mesh_that_a_scene_file_names_is_told_with_its_line() {
        let file =
            SceneFile::parse("[[object]]\nmesh = \"sphere\"\n", "folder/scene.toml").unwrap();
        let error = resolve(&file).unwrap_err();
        assert!(
            error.render(false).contains("folder/scene.toml:2:8"),
            "{}",
            error.render(false)
        );
        let hint = "did you mean `builtin:sphere`?";
        assert!(error.to_string().contains(hint), "{error}");
    }
}
