//! Output: results on standard output, messages on standard error.
//!
//! If the reader of standard output goes away, as `head` does, that is not an error. `println!`
//! would panic, so nothing here uses it.

use super::files::{self, Destination};
use super::scene_flags::Flags;
use super::{CliError, Outcome};
use fastphong::note::{Level, Notes};
use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::time::Instant;

/// Which messages are written to standard error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Log {
    /// Errors only.
    Quiet,
    /// Warnings, notes and progress.
    Normal,
    /// Steps and times too.
    Verbose,
}

impl Log {
    /// Returns the level for the global flags.
    pub fn new(quiet: bool, verbose: bool) -> Log {
        match (quiet, verbose) {
            (true, _) => Log::Quiet,
            (_, true) => Log::Verbose,
            _ => Log::Normal,
        }
    }

    /// Writes a warning: something that the user should know before trusting the result.
    pub fn warning(self, text: &str) {
        self.note(&if colour() {
            format!("\x1b[1;33mwarning\x1b[0m: {text}")
        } else {
            format!("warning: {text}")
        });
    }

    /// Writes notes about a scene in the words of the command line.
    pub fn notes(self, notes: &Notes) {
        for note in notes {
            let text = note.text(&Flags);
            match note.level {
                Level::Warning => self.warning(&text),
                Level::Remark => self.note(&text),
            }
        }
    }

    /// Writes a note: something that the program did or suggests.
    pub fn note(self, text: &str) {
        if self != Log::Quiet {
            to_stderr(&format!("{text}\n"));
        }
    }

    /// Writes a detail, with `--verbose` only.
    pub fn detail(self, text: &str) {
        if self == Log::Verbose {
            to_stderr(&format!("{text}\n"));
        }
    }

    /// Writes the time since a step `started`, with `--verbose` only.
    pub fn duration(self, done: &str, started: Instant) {
        let milliseconds = 1e3 * started.elapsed().as_secs_f64();
        self.detail(&format!("{done} in {milliseconds:.1} ms"));
    }
}

/// True if standard error may be coloured.
pub fn colour() -> bool {
    is_coloured(&io::stderr())
}

/// True if `stream` may be coloured. `NO_COLOR` forbids colours (<https://no-color.org>),
/// `CLICOLOR_FORCE` forces them (<https://bixense.com/clicolors>). Otherwise a terminal that
/// supports them gets colours, unless `CLICOLOR` is 0.
pub fn is_coloured(stream: &impl IsTerminal) -> bool {
    let value = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let is_zero = |value: &OsString| value == "0";
    if value("NO_COLOR").is_some() {
        return false;
    }
    if value("CLICOLOR_FORCE").is_some_and(|value| !is_zero(&value)) {
        return true;
    }
    !value("CLICOLOR").is_some_and(|value| is_zero(&value)) && !is_dumb() && stream.is_terminal()
}

/// True if the terminal supports no escape sequences for colours and the cursor.
pub fn is_dumb() -> bool {
    std::env::var_os("TERM").is_some_and(|term| term == "dumb")
}

/// Writes `text` to standard error, and ignores errors: there is nowhere to report them.
pub fn to_stderr(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

/// Writes a result to standard output. Stops silently if the reader went away.
///
/// # Errors
/// If it cannot be written for another reason, such as a full disk.
pub fn to_stdout(text: &str) -> Result<(), CliError> {
    to_stdout_by(|out| out.write_all(text.as_bytes()))
}

/// Writes the result of `write` to standard output, as [`to_stdout`] does.
///
/// # Errors
/// As [`to_stdout`], and if standard output leads to a file that was read.
pub fn to_stdout_by(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), CliError> {
    files::check(&[Destination {
        name: "standard output",
        path: Path::new(files::STDOUT),
    }])?;
    let mut out = io::stdout().lock();
    match write(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(format!("standard output: cannot be written: {error}").into())
        }
        _ => Ok(()),
    }
}

/// Writes the whole result of a sub-command to standard output.
///
/// # Errors
/// As [`to_stdout`].
pub fn done(text: &str) -> Result<Outcome, CliError> {
    to_stdout(text)?;
    Ok(Outcome::Done)
}
