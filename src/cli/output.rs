//! The destination of a picture: a file, or standard output.

use super::CliError;
use super::files::{self, Destination};
use super::log::{to_stderr, to_stdout, to_stdout_by};
use fastphong::picture::image_file::{FilePicture, Format};
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// The destination of a picture, and its format.
#[derive(Clone, Debug)]
pub struct Output {
    /// `None`: standard output.
    pub path: Option<PathBuf>,
    /// Given, or by the ending of the path; PNG on standard output.
    pub format: Format,
}

impl Output {
    /// Reads the values of `-o` and `--format`.
    ///
    /// # Errors
    /// When neither names a format, or standard output is a terminal.
    pub fn new(path: &Path, format: Option<Format>) -> Result<Output, CliError> {
        let path = (path.as_os_str() != "-").then(|| path.to_owned());
        if path.is_none() && io::stdout().is_terminal() {
            let expected = "expected `-o FILE`, or `-o -` into a pipe or a file";
            return Err(format!("a picture is not for a terminal: {expected}").into());
        }
        let format = match (format, &path) {
            (Some(format), _) => format,
            (None, Some(path)) => Format::of_path(path)?,
            (None, None) => Format::Png,
        };
        Ok(Output { path, format })
    }

    /// Writes `picture`; a file whole or not at all.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, picture: &FilePicture) -> Result<(), CliError> {
        self.write_by(|out| picture.write_to(self.format, out))
    }

    /// Writes the bytes that `write` writes; a file whole or not at all.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn write_by(
        &self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), CliError> {
        match &self.path {
            Some(path) => files::write(Output::destination(path), write),
            None => to_stdout_by(write),
        }
    }

    /// Returns the place that is written to, standard output too.
    pub fn place(&self) -> &Path {
        self.path.as_deref().unwrap_or(Path::new(files::STDOUT))
    }

    /// Returns the destination that `--output` names.
    pub fn destination(path: &Path) -> Destination<'_> {
        Destination {
            name: "--output",
            path,
        }
    }
}

/// Prints text beside a picture: to standard error if that goes to standard output.
///
/// # Errors
/// As [`to_stdout`].
pub fn print_beside(picture: Option<&Output>, text: &str) -> Result<(), CliError> {
    match picture {
        Some(Output { path: None, .. }) => {
            to_stderr(text);
            Ok(())
        }
        _ => to_stdout(text),
    }
}

/// Reads `png`, `ppm` or `pfm`.
pub fn format(text: &str) -> Result<Format, String> {
    let mut formats = Format::ALL.into_iter();
    let format = formats.find(|format| format.ending() == text);
    format.ok_or_else(|| "expected png, ppm or pfm".to_owned())
}
