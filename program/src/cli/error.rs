//! The ways in which a sub-command ends.

use super::files::OneFileError;
use fastphong::scene::file::SceneError;
use std::error::Error;
use std::fmt;

/// The result of a sub-command that did its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Success: exit code 0.
    Done,
    /// A comparison failed: exit code 1.
    Differs,
}

/// An error that ends a sub-command: exit code 2.
#[derive(Debug)]
pub struct CliError(Box<dyn Error + Send + Sync>);

impl<E: Into<Box<dyn Error + Send + Sync>>> From<E> for CliError {
    fn from(error: E) -> Self {
        CliError(error.into())
    }
}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl CliError {
    /// True if the command would write a file that it reads. Editing the file does not fix that, so
    /// `--watch` gives up.
    pub fn is_of_files(&self) -> bool {
        self.0.is::<OneFileError>()
    }

    /// Returns the error as text that begins with `error: ` and ends with a newline. Errors in
    /// scene files bring their own layout, with the source line.
    pub fn render(&self, colour: bool) -> String {
        let text = match self.0.downcast_ref::<SceneError>() {
            Some(error) => error.render(colour),
            None if colour => format!("\x1b[1;31merror\x1b[0m: {}", self.0),
            None => format!("error: {}", self.0),
        };
        format!("{}\n", text.trim_end_matches('\n'))
    }
}
