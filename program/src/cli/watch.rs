//! `--watch`: draws again whenever a file of the scene changes.

use super::files;
use super::input_name::path_behind;
use super::log::{Log, colour, to_stderr};
use super::text::counted;
use super::{CliError, Outcome};
use fastphong::scene::input::has_known_ending;
use std::path::{Path, PathBuf};

/// An input whose files are watched. A file may disappear and come back, be replaced, or appear
/// only later.
pub struct Watched(PathBuf);

impl Watched {
    /// Watches `input`.
    ///
    /// # Errors
    /// If `input` is not the name of a file.
    pub fn new(input: &str) -> Result<Self, CliError> {
        let path = path_behind(Path::new(input));
        let may_come = !path.exists() && has_known_ending(&path);
        if !path.is_file() && !may_come {
            let expected = "expected a scene file or a mesh file with `--watch`";
            return Err(format!("`{input}` is not a file, so it never changes: {expected}").into());
        }
        Ok(Watched(path))
    }

    /// Forgets the files read so far. Files read from now on are watched.
    pub fn begin(&self) {
        files::forget();
        // A file that is gone is not read, but it may come back.
        files::will_read_of_scene(&self.0);
    }

    /// Waits until a file changes that was read or looked for since [`Watched::begin`]. `ends` is
    /// what stops the watching, for the note: "Ctrl-C".
    pub fn wait(&self, log: Log, ends: &str) {
        files::wait_for_change(|count| {
            let files = counted(count, "file", "files");
            log.note(&format!("watching {files}: {ends} ends"));
        });
    }
}

/// Calls `draw`, and again after every change of a file that it read or looked for, until the
/// program is ended. Errors are printed and do not end it, because a later change may fix them.
///
/// # Errors
/// If `input` is not the name of a file, or `draw` would write a file that it reads.
pub fn watch(
    input: &str,
    log: Log,
    draw: impl Fn() -> Result<Outcome, CliError>,
) -> Result<Outcome, CliError> {
    let watched = Watched::new(input)?;
    loop {
        watched.begin();
        match draw() {
            Err(failure) if failure.is_of_files() => return Err(failure),
            Err(failure) => to_stderr(&failure.render(colour())),
            Ok(_) => {}
        }
        watched.wait(log, "Ctrl-C");
    }
}
