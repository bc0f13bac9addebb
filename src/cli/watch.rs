//! `render --watch`: draws again whenever a file of the scene changes.

use super::log::{Log, colour, to_stderr};
use super::text::counted;
use super::{CliError, Outcome};
use fastphong::scene::file::SceneFile;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

/// The time between two looks at the files: a blink.
const PAUSE: Duration = Duration::from_millis(150);

/// A file with its size and the time when it was written, if it is there.
type Stamp = (PathBuf, Option<(u64, SystemTime)>);

/// Draws, and again after every change of a file that `input` needs, until the program is ended. Errors are shown; a later
/// change may mend them.
///
/// # Errors
/// When `input` is no file.
pub fn watch(
    input: &str,
    log: Log,
    draw: impl Fn() -> Result<Outcome, CliError>,
) -> Result<Outcome, CliError> {
    if !Path::new(input).is_file() {
        let expected = "expected a scene file or a mesh file with `--watch`";
        return Err(format!("`{input}` is no file, and never changes: {expected}").into());
    }
    loop {
        let before = stamps(files(input));
        if let Err(failure) = draw() {
            to_stderr(&failure.render(colour()));
        }
        let files = counted(before.len(), "file", "files");
        log.note(&format!("watching {files}: Ctrl-C ends"));
        while stamps(before.iter().map(|(path, _)| path.clone())) == before {
            sleep(PAUSE);
        }
        // Who writes several files, or one in several steps, may be at it still.
        sleep(PAUSE);
    }
}

fn stamps(files: impl IntoIterator<Item = PathBuf>) -> Vec<Stamp> {
    let stamp = |path: PathBuf| {
        let found = path.metadata().ok();
        let written = found.and_then(|file| Some((file.len(), file.modified().ok()?)));
        (path, written)
    };
    files.into_iter().map(stamp).collect()
}

/// Returns the files that the picture is made of: the scene file, its meshes, and their material libraries. A file that
/// cannot be read needs no others.
fn files(input: &str) -> Vec<PathBuf> {
    let input = PathBuf::from(input);
    let folder = input.parent().unwrap_or(Path::new(""));
    let scene = SceneFile::load(&input).ok();
    let meshes = scene.iter().flat_map(SceneFile::meshes);
    let mut files: Vec<PathBuf> = meshes.map(|mesh| folder.join(mesh)).collect();
    files.push(input.clone());
    files.retain(|file| file.exists());
    let libraries: Vec<PathBuf> = files.iter().flat_map(|mesh| libraries(mesh)).collect();
    files.extend(libraries);
    files
}

/// Returns the material libraries that a mesh file names: each `mtllib` line is one file name, or several.
fn libraries(mesh: &Path) -> Vec<PathBuf> {
    let text = std::fs::read(mesh).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let lines = text.lines().map(str::trim);
    let rest = lines.filter_map(|line| line.strip_prefix("mtllib "));
    let names = rest.flat_map(|rest| [rest.trim()].into_iter().chain(rest.split_whitespace()));
    let mut libraries: Vec<PathBuf> = names.map(|name| mesh.with_file_name(name)).collect();
    libraries.dedup();
    libraries
}
