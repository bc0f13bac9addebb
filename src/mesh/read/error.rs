//! The error of reading a mesh file, and how messages quote words of a file.

use crate::note::Notes;
use std::path::PathBuf;
use std::string::{String, ToString};

/// The error for a mesh file that cannot be read: which file, where in it, what is wrong and what
/// was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{}: {problem}", path.display(), place.map(|place| place.to_string()).unwrap_or_default())]
#[non_exhaustive]
pub struct ReadError {
    /// The path that the caller passed.
    pub path: PathBuf,
    /// The place in the file; `None` if the problem is with the file as a whole.
    pub place: Option<Place>,
    /// What is wrong and what was expected, in one line.
    pub problem: String,
    /// Notes from before the error, as in [`LoadedMesh::notes`](super::LoadedMesh::notes). They
    /// often explain its cause.
    pub notes: Notes,
    /// True if the file does not exist or the operating system could not read it.
    pub(crate) is_unreadable: bool,
}

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Place {
    /// A line of a text file, counted from 1.
    #[error(":{0}")]
    Line(usize),
    /// A byte of a binary file, counted from 0 after unpacking.
    #[error(": byte {0}")]
    Byte(usize),
}

/// A reader's reason for refusing a file. It becomes a [`ReadError`].
#[derive(Debug)]
pub(super) struct Refusal {
    /// The place; `None` for the file as a whole.
    pub place: Option<Place>,
    pub problem: String,
    /// Notes from before the problem.
    pub notes: Notes,
}

impl Refusal {
    /// Refuses the file as a whole.
    pub(super) fn whole(problem: impl Into<String>) -> Refusal {
        Refusal {
            place: None,
            problem: problem.into(),
            notes: Notes::default(),
        }
    }

    /// Refuses the file because of a problem at `place`.
    pub(super) fn at(place: Place, problem: impl Into<String>) -> Refusal {
        Refusal {
            place: Some(place),
            ..Refusal::whole(problem)
        }
    }
}

/// The most characters of a file that a message quotes. Nobody would read more.
const QUOTED: usize = 32;

/// Returns `text` in a form that fits a one-line message: control characters are escaped and long
/// text is cut.
pub(super) fn quote(text: &str) -> String {
    if text.is_empty() {
        return "nothing".to_string();
    }
    let mut characters = text.chars();
    let start = characters.by_ref().take(QUOTED);
    let mut quoted = String::new();
    for character in start {
        match character {
            // Paths and names contain these, and `escape_debug` would put a backslash before them.
            '\\' | '"' | '\'' => quoted.push(character),
            // `escape_debug` would write `\0`, which could also be the end of a Windows path.
            '\0' => quoted.push_str("\\u{0}"),
            _ => quoted.extend(character.escape_debug()),
        }
    }
    if characters.next().is_some() {
        quoted.push('…');
    }
    quoted
}

/// Returns a hint for a number with a decimal comma, and for one past the range of an `f32`.
pub(super) fn hint(found: &str) -> &'static str {
    let is_number = |text: &str| text.parse().is_ok_and(f64::is_finite);
    match is_number(found) {
        true => ", at most 3.4e38, and in a scene 1e15",
        false if found.contains(',') && is_number(&found.replacen(',', ".", 1)) => {
            " with a decimal point"
        }
        false => "",
    }
}
