//! `--watch`: draws again whenever a file of the scene changes.

use super::files;
use super::input_name::path_behind;
use super::log::{Log, colour, to_stderr};
use super::text::counted;
use super::{CliError, Outcome};
use fastphong::scene::input::has_known_ending;
use std::path::{Path, PathBuf};

/// An input whose files are watched. One may go, and come back, and be another one under the same name; it may also be there
/// only later.
pub struct Watched(PathBuf);

impl Watched {
    /// Watches `input`.
    ///
    /// # Errors
    /// When it is not the name of a file.
    pub fn new(input: &str) -> Result<Self, CliError> {
        let path = path_behind(Path::new(input));
        let may_come = !path.exists() && has_known_ending(&path);
        if !path.is_file() && !may_come {
            let expected = "expected a scene file or a mesh file with `--watch`";
            return Err(format!("`{input}` is no file, and never changes: {expected}").into());
        }
        Ok(Watched(path))
    }

    /// Forgets the files that were read before: what is read from now on is watched.
    pub fn begin(&self) {
        files::forget();
        // Where it is gone it is not read, and may come back.
        files::will_read_of_scene(&self.0);
    }

    /// Waits for a change of a file that was read or looked for since it [began](Watched::begin).
    pub fn wait(&self, log: Log, ends: &str) {
        files::wait_for_change(|count| {
            let files = counted(count, "file", "files");
            log.note(&format!("watching {files}: {ends} ends"));
        });
    }
}

/// Draws, and again after every change of a file that `draw` read or looked for, until the program is ended. Errors are shown,
/// once each time: a later change may mend them.
///
/// # Errors
/// When `input` is not the name of a file, or a file is to be read and written.
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
