//! The files of a command: those that it reads, and those that it writes. None is both.
//!
//! Every file is registered before it is read, and every place that is written is looked up among these: before anything is drawn
//! where the place is known ([`check`]), and in any case when it is written ([`write`]). No other module of the commands opens files
//! (`tests/documents/tidy.rs`). Files are told apart by their places and not by name, so that symbolic links do not hide one. A hard
//! link may: as files are replaced and not written over, the one that is read stays as it is under its other name.
//!
//! `--watch` looks at the same list ([`wait_for_change`]): a file that is not there, or was there, is in it like any other.

use super::input_name::{is_stand_in, path_behind};
use super::{CliError, memory, signals};
use fastphong::mesh::read::mesh_endings;
use fastphong::picture::image_file::{
    FilePicture, ImageFileError, place, read_picture, write_file_by, write_files_by,
};
use fastphong::scene::file::diagnostics::SceneError;
use fastphong::scene::file::resolve::Resolved;
use fastphong::scene::file::{STANDARD_INPUT, SceneFile};
use fastphong::scene::input::{self, InputFormat, has_ending, read_input};
use std::collections::BTreeSet;
use std::fmt;
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// A file that is read, as it was before that.
#[derive(Clone, Debug)]
struct FileRead {
    path: PathBuf,
    /// The part that it has in the command: `the scene`.
    part: &'static str,
    state: Option<State>,
}

/// A file on the disk: two states differ if anything was written to it since, or another file has its name now.
#[derive(Clone, Debug, PartialEq)]
struct State {
    place: PathBuf,
    size: u64,
    written: Option<SystemTime>,
}

/// A place that a command writes to.
#[derive(Clone, Copy, Debug)]
pub struct Destination<'a> {
    /// The flag that names it: `--output`.
    pub name: &'a str,
    pub path: &'a Path,
}

/// Standard output, which may lead to a file: that is one that is read where a shell appends to it.
pub const STDOUT: &str = "/dev/stdout";

/// Standard input, which may come from a file.
const STDIN: &str = "/dev/stdin";

/// The reason why a file is not written: the command reads it, or writes something else to it.
#[derive(Debug)]
pub struct OneFileError(String);

impl fmt::Display for OneFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for OneFileError {}

/// The files of a command.
#[derive(Debug)]
struct Files {
    read: Vec<FileRead>,
    /// The paths of those.
    paths: BTreeSet<PathBuf>,
    written: Vec<PathBuf>,
}

const NONE: Files = Files {
    read: Vec::new(),
    paths: BTreeSet::new(),
    written: Vec::new(),
};

/// All files since [`forget`].
static FILES: Mutex<Files> = Mutex::new(NONE);

fn files() -> MutexGuard<'static, Files> {
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Forgets all files: a command begins anew.
pub fn forget() {
    *files() = NONE;
}

/// Registers a file that is going to be read, as `part` of the command.
pub fn will_read(path: &Path, part: &'static str) {
    if is_read(path) {
        return;
    }
    let file = FileRead {
        path: path.to_owned(),
        part,
        state: State::of(path),
    };
    let mut files = files();
    files.paths.insert(path.to_owned());
    files.read.push(file);
}

/// True if a file of this name is registered.
fn is_read(path: &Path) -> bool {
    files().paths.contains(path)
}

/// Registers standard input, which is going to be read as `part` of the command.
pub fn will_read_stdin(part: &'static str) {
    will_read(Path::new(STDIN), part);
}

/// Registers a file that a scene is made of, which is going to be read.
pub fn will_read_of_scene(path: &Path) {
    let part = match path {
        path if has_ending(path, "toml") => "the scene",
        path if mesh_endings().any(|ending| has_ending(path, ending)) => "the mesh",
        path if has_ending(path, "mtl") => "the material library",
        // A scene, a mesh or a library, as its bytes say.
        _ => "a file of the scene",
    };
    will_read(path, part);
}

/// Reads a file that a scene is made of, by the name that it has there.
fn read_of_scene(name: &Path) -> io::Result<Vec<u8>> {
    let path = path_behind(name);
    match name.as_os_str() == STANDARD_INPUT {
        true => will_read_stdin("the input"),
        false => will_read_of_scene(&path),
    }
    read_input(&path)
}

/// Loads the scene that `input` names, as [`input::load`] does; on standard input it has `format`. Its mesh files are registered,
/// though not yet read.
///
/// # Errors
/// As [`input::load`].
pub fn load(input: &str, format: Option<InputFormat>) -> Result<SceneFile, SceneError> {
    let file = match input {
        STANDARD_INPUT => input::load_standard_input(format, &mut read_of_scene)?,
        // Under a name that is no file's, which is why only its ending is asked.
        name if is_stand_in(name) && has_ending(Path::new(name), "toml") => {
            SceneFile::load_by(Path::new(name), &mut read_of_scene)?
        }
        name if is_stand_in(name) => SceneFile::for_mesh(name),
        input => input::load_by(input, &mut read_of_scene)?,
    };
    let folder = file.path().and_then(Path::parent).unwrap_or(Path::new(""));
    for mesh in file.meshes().filter(|mesh| input::is_mesh_file(mesh)) {
        will_read_of_scene(&path_behind(&folder.join(mesh)));
    }
    Ok(file)
}

/// Returns the scene that `file` describes, as [`input::resolve`] does.
///
/// # Errors
/// As [`input::resolve`], and when there is too little memory for its meshes.
pub fn resolve(file: &SceneFile) -> Result<Resolved, CliError> {
    memory::check_meshes(file)?;
    Ok(input::resolve_by(file, &mut read_of_scene)?)
}

/// Returns the files that `file` was made of, mesh files and material libraries, named as from the folder of the scene; `None` if a
/// mesh has more than `most` bytes, came from standard input or a pipe, or cannot be read again.
pub fn of_scene(file: &SceneFile, most: u64) -> Option<Vec<(String, Vec<u8>)>> {
    if file.meshes().any(|mesh| mesh == STANDARD_INPUT) {
        return None;
    }
    let folder = file.path().and_then(Path::parent).unwrap_or(Path::new(""));
    let mut meshes = file
        .meshes()
        .filter(|mesh| input::is_mesh_file(mesh))
        .peekable();
    if meshes.peek().is_none() {
        return Some(Vec::new());
    }
    // Judged before they are read: a pipe has nothing more to say.
    let is_small = |mesh: &str| {
        let path = path_behind(&folder.join(mesh));
        fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() <= most)
    };
    if !meshes.all(is_small) {
        return None;
    }
    let mut read = Vec::new();
    let resolved = input::resolve_by(file, &mut |path| {
        let bytes = read_input(&path_behind(path))?;
        let name = path.strip_prefix(folder).unwrap_or(path);
        read.push((name.to_string_lossy().into_owned(), bytes.clone()));
        Ok(bytes)
    });
    resolved.is_ok().then_some(read)
}

/// Endings of picture files that are read, without the dot.
const PICTURES: [&str; 8] = ["png", "pbm", "pgm", "ppm", "pam", "pfm", "bmp", "tga"];

/// The picture files in a folder.
#[derive(Debug, Default)]
pub struct PictureNames {
    /// Names within the folder, sorted.
    pub names: Vec<PathBuf>,
    /// The number of other files.
    pub others: usize,
}

/// Lists the picture files in a folder and in the folders within it, by their endings. Hidden files are left out, drafts among
/// them, as are pipes and devices; links to folders, which may lead anywhere, are not followed.
///
/// # Errors
/// When a folder cannot be read.
pub fn pictures_in(folder: &Path) -> Result<PictureNames, CliError> {
    let mut found = PictureNames::default();
    let mut open = vec![PathBuf::new()];
    while let Some(inner) = open.pop() {
        let path = folder.join(&inner);
        let refused = |error| format!("{}: cannot be read: {error}", path.display());
        for entry in fs::read_dir(&path).map_err(refused)? {
            let entry = entry.map_err(refused)?;
            let name = inner.join(entry.file_name());
            if entry.file_name().as_encoded_bytes().starts_with(b".") {
                continue;
            }
            let is_picture = PICTURES.iter().any(|ending| has_ending(&name, ending));
            let kind = entry.file_type().map_err(refused)?;
            // A link that leads nowhere is a picture that cannot be read. A pipe would be waited for.
            let target = fs::metadata(entry.path());
            let is_file = target.as_ref().map_or(true, fs::Metadata::is_file);
            match (kind.is_dir(), target.is_ok_and(|target| target.is_dir())) {
                (true, _) => open.push(name),
                (_, true) => {}
                _ if is_picture && is_file => found.names.push(name),
                _ => found.others += 1,
            }
        }
    }
    found.names.sort();
    Ok(found)
}

/// A file that is copied over another one, or to a place where there is none.
#[derive(Clone, Copy, Debug)]
pub struct Copy<'a> {
    pub from: &'a Path,
    pub to: &'a Path,
}

/// Copies files, all of them or none. This is the one way to write files that are read: to replace references is what the user
/// asked for.
///
/// # Errors
/// When a copy would be written over a file that is to be copied, or two of them to one place, or a file cannot be read or written.
pub fn copy_all(copies: &[Copy<'_>]) -> Result<(), CliError> {
    let sources: BTreeSet<PathBuf> = copies.iter().map(|copy| place(copy.from)).collect();
    let mut places = BTreeSet::new();
    for copy in copies {
        let (to, end) = (copy.to.display(), place(copy.to));
        if sources.contains(&end) {
            let problem = format!("{to} leads to a picture that is to be approved");
            return Err(OneFileError(format!("{problem}: expected a reference of its own")).into());
        }
        if !places.insert(end) {
            let problem = format!("{to} leads to the same file as another reference");
            return Err(OneFileError(format!("{problem}: expected a file for each")).into());
        }
    }
    signals::remove_drafts_at_the_end();
    let places: Vec<&Path> = copies.iter().map(|copy| copy.to).collect();
    write_files_by(&places, |i, out| {
        let mut from = fs::File::open(copies[i].from)?;
        io::copy(&mut from, out).map(|_| ())
    })?;
    Ok(())
}

/// Reads a picture, which is `part` of the command.
///
/// # Errors
/// As [`read_picture`].
pub fn picture(path: &Path, part: &'static str) -> Result<FilePicture, ImageFileError> {
    will_read(path, part);
    read_picture(path)
}

/// The largest document that is read, in bytes: those of all shipped scenes have about 1 MB.
const LARGEST: u64 = 1 << 28;

/// Reads a document of at most [`LARGEST`] bytes, from a device that never ends as well, and from standard input if the path is
/// `-`.
///
/// # Errors
/// When it cannot be read, has more bytes, or is no text.
pub fn document(path: &Path) -> io::Result<String> {
    const PART: &str = "the document";
    let mut bytes = Vec::new();
    let mut limited = |input: &mut dyn Read| input.take(LARGEST + 1).read_to_end(&mut bytes);
    if path.as_os_str() == STANDARD_INPUT {
        if is_read(Path::new(STDIN)) {
            return Err(io::Error::other("standard input holds one document"));
        }
        will_read_stdin(PART);
        limited(&mut io::stdin().lock())?;
    } else {
        will_read(path, PART);
        limited(&mut fs::File::open(path)?)?;
    }
    if bytes.len() as u64 > LARGEST {
        let problem = format!("it has more than {LARGEST} bytes: expected a file of `--json`");
        return Err(io::Error::other(problem));
    }
    // UTF-16 of plain letters is UTF-8, too, with zeros.
    let text = String::from_utf8(bytes)
        .ok()
        .filter(|text| !text.contains('\0'));
    text.ok_or_else(|| io::Error::other("it is no text in UTF-8: expected a file of `--json`"))
}

/// Returns the first `most` bytes of the plain file at `path`: none of one that cannot be read, `None` if there is no such file.
pub fn beginning(path: &Path, most: u64) -> Option<Vec<u8>> {
    if !fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let mut bytes = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes));
    Some(read.map(|_| bytes).unwrap_or_default())
}

/// Refuses to write to a file that is read, and to write twice to one file.
///
/// # Errors
/// When one of `destinations` is such a file, under any name.
pub fn check(destinations: &[Destination<'_>]) -> Result<(), CliError> {
    let read = &files().read;
    for (number, to) in destinations.iter().enumerate() {
        let is_it = |file: &&FileRead| is_one_file(&file.path, to.path);
        if let Some(FileRead { path, part, .. }) = read.iter().find(is_it) {
            let mut problem = format!("`{}` is {part} itself, {}", to.name, path.display());
            if *path != to.path {
                problem += &format!(", by the name {}", to.path.display());
            }
            return Err(OneFileError(format!("{problem}: expected another file")).into());
        }
        let before = &destinations[..number];
        if let Some(other) = before.iter().find(|other| is_one_file(other.path, to.path)) {
            let (one, two, path) = (other.name, to.name, to.path.display());
            let problem = format!("`{one}` and `{two}` name one file, {path}");
            return Err(OneFileError(format!("{problem}: expected a file for each")).into());
        }
    }
    Ok(())
}

/// Writes the bytes that `write` writes, a file whole or not at all. A signal that ends the program leaves no draft.
///
/// # Errors
/// When the place is a file that was read, or was written already, or cannot be written.
pub fn write(
    to: Destination<'_>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), CliError> {
    check(&[to])?;
    if files()
        .written
        .iter()
        .any(|path| is_one_file(path, to.path))
    {
        let (name, path) = (to.name, to.path.display());
        let problem = format!("`{name}` names {path}, which was written just now");
        return Err(OneFileError(format!("{problem}: expected a file for each")).into());
    }
    signals::remove_drafts_at_the_end();
    write_file_by(to.path, write)?;
    files().written.push(to.path.to_owned());
    Ok(())
}

/// True if both paths lead to one plain file, or would if it were there.
fn is_one_file(a: &Path, b: &Path) -> bool {
    place(a) == place(b) && fs::metadata(a).map_or(true, |found| found.is_file())
}

impl State {
    /// Returns the state of a file, if it is there.
    fn of(path: &Path) -> Option<State> {
        let found = fs::metadata(path).ok()?;
        Some(State {
            place: place(path),
            size: found.len(),
            written: found.modified().ok(),
        })
    }
}

/// The time between two looks at the files: a blink.
const PAUSE: Duration = Duration::from_millis(150);

/// Waits until one of the files that were read is another than it was before that: changed, gone, or there again. Calls `waits` with
/// their number first.
pub fn wait_for_change(waits: impl FnOnce(usize)) {
    let read = files().read.clone();
    waits(read.len());
    while read.iter().all(|file| State::of(&file.path) == file.state) {
        sleep(PAUSE);
    }
    // Who writes several files, or one in several steps, may be at it still.
    sleep(PAUSE);
}
