//! The files that a command reads and writes. No file is both.
//!
//! Every file is registered before it is read. Every path to be written is checked against these
//! files: before anything is drawn if the path is known by then ([`check`]), and always when it is
//! written ([`write`]). No other module of the commands opens files (`tests/documents/tidy.rs`).
//! Files are compared by their canonical paths, so that a symbolic link cannot hide one. A hard
//! link can, but does no harm: files are replaced, not overwritten, so the file that was read keeps
//! its contents under its other name.
//!
//! `--watch` watches the same list ([`wait_for_change`]), which includes files that do not exist
//! yet or no longer.

use super::input_name::{is_stand_in, path_behind};
use super::{CliError, memory, signals};
use fastphong::mesh::read::mesh_endings;
use fastphong::picture::image_file::{
    FilePicture, ImageFileError, Replacements, place, read_picture, read_picture_from,
    write_file_by,
};
use fastphong::scene::file::SceneError;
use fastphong::scene::file::{STANDARD_INPUT, SceneFile};
use fastphong::scene::input::{self, InputFormat, has_ending, read_input};
use fastphong::scene::open::{Look, Opened, Overlay, open_by};
use std::collections::{BTreeSet, HashMap};
use std::fmt;
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// A file that a command reads, with its state before reading.
#[derive(Clone, Debug)]
struct FileRead {
    path: PathBuf,
    /// Its role in the command, for messages: `the scene`.
    part: &'static str,
    state: Option<State>,
}

/// The state of a file on disk. It changes when the file is written to, or when another file takes
/// its name.
#[derive(Clone, Debug, PartialEq)]
struct State {
    place: PathBuf,
    size: u64,
    written: Option<SystemTime>,
}

/// A path that a command writes to.
#[derive(Clone, Copy, Debug)]
pub struct Destination<'a> {
    /// The flag that sets it: `--output`.
    pub name: &'a str,
    pub path: &'a Path,
}

/// Standard output. It may lead to a file, even to one that the command reads, if a shell appends
/// to it.
pub const STDOUT: &str = "/dev/stdout";

/// Standard input, which may come from a file.
const STDIN: &str = "/dev/stdin";

/// The error of a command that would write a file that it reads, or write one file twice.
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
    /// The paths of the files in `read`.
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

/// Forgets all files, before a command starts again.
pub fn forget() {
    *files() = NONE;
}

/// Registers a file that is going to be read. `part` is its role in the command, for messages.
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

/// True if this path is registered.
fn is_read(path: &Path) -> bool {
    files().paths.contains(path)
}

/// Registers standard input, which is going to be read. `part` is its role in the command, for
/// messages.
pub fn will_read_stdin(part: &'static str) {
    will_read(Path::new(STDIN), part);
}

/// Registers a file of a scene that is going to be read.
pub fn will_read_of_scene(path: &Path) {
    let part = match path {
        path if has_ending(path, "toml") => "the scene",
        path if mesh_endings().any(|ending| has_ending(path, ending)) => "the mesh",
        path if has_ending(path, "mtl") => "the material library",
        // Its bytes will tell if it is a scene, a mesh or a library.
        _ => "a file of the scene",
    };
    will_read(path, part);
}

/// Reads a file of a scene, by its name in the scene.
fn read_of_scene(name: &Path) -> io::Result<Vec<u8>> {
    let path = path_behind(name);
    if name.as_os_str() == STANDARD_INPUT {
        will_read_stdin("the input")
    } else {
        will_read_of_scene(&path)
    }
    read_input(&path)
}

/// Loads the scene that `input` names, as [`input::load`] does. `format` is the format of standard
/// input. Registers the mesh files of the scene without reading them.
///
/// # Errors
/// As [`input::load`].
pub fn load(input: &str, format: Option<InputFormat>) -> Result<SceneFile, SceneError> {
    let file = match input {
        STANDARD_INPUT => input::load_standard_input(format, &mut read_of_scene)?,
        // A stand-in is not the name of a file, so only its ending can tell what the file holds.
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

/// Opens `file`, as [`open_by`] does.
///
/// # Errors
/// As [`open_by`], and if there is too little memory for its meshes.
pub fn open(file: SceneFile, over: &Overlay, look: Look) -> Result<Opened, CliError> {
    memory::check_meshes(&file)?;
    Ok(open_by(file, over, look, &mut read_of_scene)?)
}

/// Returns the mesh files and material libraries of `file`, with names relative to the folder of
/// the scene. Returns `None` if a mesh has more than `most` bytes, came from standard input or a
/// pipe, or cannot be read again.
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
    // Check before reading: a pipe cannot be read a second time.
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

/// The endings of picture files, without the dot.
const PICTURES: [&str; 8] = ["png", "pbm", "pgm", "ppm", "pam", "pfm", "bmp", "tga"];

/// The picture files in a folder.
#[derive(Debug, Default)]
pub struct PictureNames {
    /// Paths within the folder, sorted.
    pub names: Vec<PathBuf>,
    /// How many other files there are.
    pub others: usize,
}

/// Lists the picture files in a folder and its sub-folders, by their endings. Leaves out hidden
/// files (drafts among them), pipes and devices. Does not follow links to folders, because they may
/// lead anywhere.
///
/// # Errors
/// If a folder cannot be read.
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
            // A broken link counts as a picture, so that reading it reports an error. Reading a
            // pipe would block.
            let is_file = fs::metadata(entry.path()).map_or(true, |target| target.is_file());
            if kind.is_dir() {
                open.push(name);
            } else if is_picture && is_file {
                found.names.push(name);
            } else {
                found.others += 1;
            }
        }
    }
    found.names.sort();
    Ok(found)
}

/// True if a file that is registered has changed since, or has come or gone.
pub fn has_changed(path: &Path) -> bool {
    let files = files();
    let file = files.read.iter().find(|file| file.path == path);
    file.is_some_and(FileRead::has_changed)
}

/// References that are going to be replaced, all of them or none. This is the only way to write
/// files that were read: the user asked for it.
#[derive(Default)]
pub struct Approval {
    files: Replacements,
    /// The references, as the user names them.
    references: BTreeSet<PathBuf>,
}

impl Approval {
    /// Writes the new contents of a reference to a draft, whether or not the reference exists. It
    /// was registered before it was judged.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn add(&mut self, reference: &Path, bytes: &[u8]) -> Result<(), CliError> {
        signals::remove_drafts_at_the_end();
        self.references.insert(reference.to_owned());
        Ok(self.files.add(reference, bytes)?)
    }

    /// Replaces the references in `folder`. If two programs do so at once, one waits.
    ///
    /// # Errors
    /// If a reference has changed since it was registered, leads to another file that was read or
    /// to the file of another reference, or cannot be replaced.
    pub fn finish(self, folder: &Path) -> Result<(), CliError> {
        // Not every system can lock a folder.
        let lock = fs::File::open(folder).and_then(|folder| folder.lock().map(|()| folder));
        let read = files().read.clone();
        let places: Vec<PathBuf> = read.iter().map(|file| place(&file.path)).collect();
        let mut at: HashMap<&Path, Vec<&FileRead>> = HashMap::new();
        for (file, place) in read.iter().zip(&places) {
            at.entry(place).or_default().push(file);
        }
        for (file, place) in read.iter().zip(&places) {
            if !self.references.contains(&file.path) {
                continue;
            }
            let reference = file.path.display();
            let mut others = at[&**place].iter();
            if let Some(other) = others.find(|other| other.path != file.path) {
                let (part, path) = (other.part, other.path.display());
                let problem = format!("{reference} leads to the file of {part}, {path}");
                let expected = "expected a file of its own, so nothing was approved";
                return Err(OneFileError(format!("{problem}: {expected}")).into());
            }
            if file.has_changed() {
                let problem = format!("{reference} is not as it was when the folder was listed");
                let expected = "expected no change meanwhile, so nothing was approved";
                return Err(format!("{problem}: {expected}").into());
            }
        }
        self.files.finish()?;
        drop(lock);
        Ok(())
    }
}

/// Reads a picture. `part` is its role in the command, for messages.
///
/// # Errors
/// As [`read_picture`].
pub fn picture(path: &Path, part: &'static str) -> Result<FilePicture, ImageFileError> {
    will_read(path, part);
    read_picture(path)
}

/// Reads a picture as [`picture`] does, with the bytes of its file.
///
/// # Errors
/// As [`picture`], and if there is too little memory for the file.
pub fn picture_and_file(
    path: &Path,
    part: &'static str,
) -> Result<(FilePicture, Vec<u8>), CliError> {
    will_read(path, part);
    if let Ok(found) = fs::metadata(path) {
        memory::check_file(path, found.len())?;
    }
    let bytes = fs::read(path).map_err(|cause| ImageFileError::Read {
        path: path.to_owned(),
        cause,
    })?;
    Ok((read_picture_from(&*bytes, path)?, bytes))
}

/// The largest document that is read, in bytes. One of all shipped scenes has about 1 MB.
const LARGEST: u64 = 1 << 28;

/// Reads a document of at most [`LARGEST`] bytes, from standard input if the path is `-`. The limit
/// also protects from devices that never end.
///
/// # Errors
/// If the document cannot be read, has more bytes, or is not text in UTF-8.
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
    // ASCII letters in UTF-16 are valid UTF-8 with zeros between them, so a text with zeros is
    // refused.
    let text = String::from_utf8(bytes)
        .ok()
        .filter(|text| !text.contains('\0'));
    text.ok_or_else(|| io::Error::other("it is not text in UTF-8: expected a file of `--json`"))
}

/// Returns up to `most` bytes from the beginning of the plain file at `path`, or nothing if it
/// cannot be read. Returns `None` if there is no plain file.
pub fn beginning(path: &Path, most: u64) -> Option<Vec<u8>> {
    if !fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let mut bytes = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(most).read_to_end(&mut bytes));
    Some(read.map(|_| bytes).unwrap_or_default())
}

/// Checks that no destination is a file that the command reads, and that no two are the same file.
///
/// # Errors
/// If one is, even under another name.
pub fn check(destinations: &[Destination<'_>]) -> Result<(), CliError> {
    let read = &files().read;
    for (index, to) in destinations.iter().enumerate() {
        let is_it = |file: &&FileRead| is_one_file(&file.path, to.path);
        if let Some(FileRead { path, part, .. }) = read.iter().find(is_it) {
            let mut problem = format!("`{}` is {part} itself, {}", to.name, path.display());
            if *path != to.path {
                problem += &format!(", by the name {}", to.path.display());
            }
            return Err(OneFileError(format!("{problem}: expected another file")).into());
        }
        let before = &destinations[..index];
        if let Some(other) = before.iter().find(|other| is_one_file(other.path, to.path)) {
            let (one, two, path) = (other.name, to.name, to.path.display());
            let problem = format!("`{one}` and `{two}` name one file, {path}");
            return Err(OneFileError(format!("{problem}: expected a file for each")).into());
        }
    }
    Ok(())
}

/// Writes a file with `write`, either whole or not at all. A signal that ends the program leaves no
/// draft behind.
///
/// # Errors
/// If the file was read or written by this command already, or cannot be written.
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

/// Writes several files, all or none, and makes the folders that they need.
///
/// # Errors
/// If one was read by this command already, or cannot be written.
pub fn write_together(all: &[(Destination<'_>, &[u8])]) -> Result<(), CliError> {
    check(&all.iter().map(|(to, _)| *to).collect::<Vec<_>>())?;
    signals::remove_drafts_at_the_end();
    let mut together = Replacements::default();
    for (to, bytes) in all {
        together.add(to.path, bytes)?;
    }
    Ok(together.finish()?)
}

/// True if there is a plain file at `path`, or behind a link.
pub fn is_file(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| found.is_file())
}

/// Removes a plain file, if there is one.
///
/// # Errors
/// If it cannot be removed, or the command reads it.
pub fn remove(path: &Path) -> Result<(), CliError> {
    if !fs::symlink_metadata(path).is_ok_and(|found| found.is_file()) {
        return Ok(());
    }
    let name = "the file to remove";
    check(&[Destination { name, path }])?;
    let failed = |error| format!("{}: cannot be removed: {error}", path.display());
    Ok(fs::remove_file(path).map_err(failed)?)
}

/// True if both paths lead to the same plain file, or would if it existed.
fn is_one_file(a: &Path, b: &Path) -> bool {
    place(a) == place(b) && fs::metadata(a).map_or(true, |found| found.is_file())
}

impl FileRead {
    /// True if the file has changed since it was registered, or has come or gone.
    fn has_changed(&self) -> bool {
        State::of(&self.path) != self.state
    }
}

impl State {
    /// Returns the state of a file, or `None` if it does not exist.
    fn of(path: &Path) -> Option<State> {
        let found = fs::metadata(path).ok()?;
        Some(State {
            place: place(path),
            size: found.len(),
            written: found.modified().ok(),
        })
    }
}

/// The time between two checks of the files.
const PAUSE: Duration = Duration::from_millis(150);

/// Waits until one of the registered files changes, disappears or comes back. Calls `waits` first,
/// with the number of files.
pub fn wait_for_change(waits: impl FnOnce(usize)) {
    let read = files().read.clone();
    waits(read.len());
    while !read.iter().any(FileRead::has_changed) {
        sleep(PAUSE);
    }
    // An editor may still be writing, if it saves several files or one file in several steps.
    sleep(PAUSE);
}
