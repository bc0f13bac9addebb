//! The error of reading a mesh file, and words of a file as messages quote them.

use std::path::PathBuf;
use std::string::{String, ToString};
use std::vec::Vec;

/// A mesh file that could not be read: which file, where in it, what is wrong and what was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{}: {problem}", path.display(), place.map(|place| place.to_string()).unwrap_or_default())]
pub struct ReadError {
    /// The file, as it was named when it was asked for.
    pub path: PathBuf,
    /// The place; `None` when the whole file is meant.
    pub place: Option<Place>,
    /// What is wrong, and what was expected.
    pub problem: String,
    /// What was odd before it, as in [`LoadedMesh::warnings`](super::LoadedMesh::warnings): often its cause.
    pub warnings: Vec<String>,
    /// True if the file is not there, or the operating system did not read it.
    pub(crate) is_unreadable: bool,
}

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Place {
    /// A line of a text, counted from 1.
    #[error(":{0}")]
    Line(usize),
    /// A byte of a binary file after it was unpacked, counted from 0.
    #[error(": byte {0}")]
    Byte(usize),
}

/// What a reader says of a file that it refuses.
#[derive(Debug)]
pub(super) struct Refusal {
    /// The place; `None` for the file as a whole.
    pub place: Option<Place>,
    pub problem: String,
    /// What was odd before.
    pub notes: Vec<String>,
}

impl Refusal {
    /// Refuses the file as a whole.
    pub(super) fn whole(problem: impl Into<String>) -> Refusal {
        Refusal {
            place: None,
            problem: problem.into(),
            notes: Vec::new(),
        }
    }

    /// Refuses the file for what stands at `place`.
    pub(super) fn at(place: Place, problem: impl Into<String>) -> Refusal {
        Refusal {
            place: Some(place),
            ..Refusal::whole(problem)
        }
    }
}

/// At most this many characters of a file are quoted in an error: more would not be read.
const QUOTED: usize = 32;

/// Returns `text` as it can stand in a one-line message: control characters escaped, long text cut.
pub(super) fn quote(text: &str) -> String {
    if text.is_empty() {
        return "nothing".to_string();
    }
    let mut characters = text.chars();
    let start = characters.by_ref().take(QUOTED);
    let mut quoted = String::new();
    for character in start {
        match character {
            // Names hold these as they are.
            '\\' | '"' | '\'' => quoted.push(character),
            // Not `\0`, which may be a part of a name.
            '\0' => quoted.push_str("\\u{0}"),
            _ => quoted.extend(character.escape_debug()),
        }
    }
    if characters.next().is_some() {
        quoted.push('…');
    }
    quoted
}

/// Returns a hint for numbers whose decimals follow a comma, and for those past the range of an `f32`.
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
