//! The ways in which a sub-command ends.

use fastphong::scene::file::diagnostics::SceneError;
use std::error::Error;

/// The finding of a sub-command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All that was asked for is done: exit code 0.
    Done,
    /// A comparison failed: exit code 1.
    Differs,
}

/// Why a sub-command could not do its work: exit code 2.
#[derive(Debug)]
pub struct Failure(Box<dyn Error + Send + Sync>);

impl<E: Into<Box<dyn Error + Send + Sync>>> From<E> for Failure {
    fn from(error: E) -> Self {
        Failure(error.into())
    }
}

impl Failure {
    /// Returns the error as text that starts with `error: ` and ends a line. Errors of inputs show themselves.
    pub fn render(&self, colour: bool) -> String {
        let text = match self.0.downcast_ref::<SceneError>() {
            Some(error) => error.render(colour),
            None if colour => format!("\x1b[1;31merror\x1b[0m: {}", self.0),
            None => format!("error: {}", self.0),
        };
        format!("{}\n", text.trim_end_matches('\n'))
    }
}
