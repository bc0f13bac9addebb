//! How a sub-command ends.

use fastphong::compare::metrics::SizeMismatch;
use fastphong::frame::FrameError;
use fastphong::picture::image_file::ImageFileError;
use fastphong::scene::file::diagnostics::SceneError;
use fastphong::scene::input::InputError;

/// What a sub-command found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All that was asked for is done: exit code 0.
    Done,
    /// A comparison failed: exit code 1.
    Differs,
}

/// Why a sub-command could not do what was asked for: exit code 2.
#[derive(Debug)]
pub enum Failure {
    /// One sentence.
    Message(String),
    /// An input, which shows its errors itself. Boxed: results are passed about more often than they fail.
    Input(Box<InputError>),
}

impl Failure {
    /// The error as text that starts with `error: ` and ends a line.
    pub fn render(&self, colour: bool) -> String {
        let mut text = match self {
            Failure::Message(message) if colour => format!("\x1b[1;31merror\x1b[0m: {message}"),
            Failure::Message(message) => format!("error: {message}"),
            Failure::Input(error) => error.render(colour),
        };
        if !text.ends_with('\n') {
            text.push('\n');
        }
        text
    }
}

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Failure::Message(message)
    }
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Failure::Input(Box::new(error))
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        InputError::Scene(error).into()
    }
}

impl From<ImageFileError> for Failure {
    fn from(error: ImageFileError) -> Self {
        Failure::Message(error.to_string())
    }
}

impl From<FrameError> for Failure {
    fn from(error: FrameError) -> Self {
        Failure::Message(error.to_string())
    }
}

impl From<SizeMismatch> for Failure {
    fn from(error: SizeMismatch) -> Self {
        Failure::Message(error.to_string())
    }
}
