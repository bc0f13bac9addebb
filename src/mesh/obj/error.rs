//! The errors of reading an OBJ file.

use super::super::{MeshError, PolygonMesh};
use core::fmt;
use std::format;
use std::path::PathBuf;
use std::string::{String, ToString};
use std::vec::Vec;

/// An OBJ file that could not be read: which file, which line, what is wrong and what was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{}: {problem}", path.display(), line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct ObjError {
    /// The file, as it was named when it was asked for.
    pub path: PathBuf,
    /// The line, counted from 1; `None` when the whole file is meant.
    pub line: Option<usize>,
    /// The problem.
    pub problem: ObjProblem,
    /// What was odd in the lines before it, as in [`LoadedObj::warnings`](super::LoadedObj::warnings): often its cause.
    pub warnings: Vec<String>,
}

/// A problem with an OBJ file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjProblem {
    /// The file cannot be opened or read; the operating system's words.
    #[error("cannot be read ({0}): expected an OBJ file")]
    Unreadable(String),
    /// The path names a directory.
    #[error("is a directory: expected an OBJ file")]
    Directory,
    /// The file has no bytes, or white space only.
    #[error("is empty: expected OBJ text with `v` and `f` lines")]
    Empty,
    /// The file holds bytes that no text has.
    #[error("holds binary data: expected OBJ text with `v` and `f` lines")]
    NotText,
    /// The file is of another format; a few words for it.
    #[error("is {0}: expected OBJ text with `v` and `f` lines")]
    OtherFormat(&'static str),
    /// The file is text, but has no face of three corners or more.
    #[error("has no polygon: expected OBJ text with an `f` line of at least three corners")]
    NoPolygons,
    /// The file has points or lines, and no face of three corners or more.
    #[error("has points or lines but no polygon: expected an `f` line of at least three corners")]
    OnlyPointsOrLines,
    /// A position that a face uses is not three finite numbers.
    #[error("{problem}, and the face in line {face} uses this position")]
    BadPosition {
        /// The first problem of its line.
        problem: VectorProblem,
        /// The line of the first face that uses it.
        face: usize,
    },
    /// A corner is none of `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    #[error("`{0}` is no corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers{slash}",
        slash = slash_hint(.0))]
    BadCorner(String),
    /// A corner names a position that the file does not have.
    #[error(fmt = index_out_of_range)]
    IndexOutOfRange {
        /// `position`.
        what: &'static str,
        /// The index as written: counted from 1, or backwards from -1.
        index: i64,
        /// The entries there are: in the whole file, or so far when the index counts backwards.
        count: usize,
    },
    /// More polygons than [`PolygonMesh::MAX_POLYGONS`].
    #[error("too many polygons: expected at most {}", PolygonMesh::MAX_POLYGONS)]
    TooManyPolygons,
    /// More corners than [`PolygonMesh::MAX_CORNERS`].
    #[error("too many corners: expected at most {}", PolygonMesh::MAX_CORNERS)]
    TooManyCorners,
    /// The parser refused text that had passed every check here.
    #[error("the OBJ parser gave up ({0}): expected plain polygons")]
    Parser(String),
    /// The mesh refused its data.
    #[error("{0}: expected a mesh within its limits")]
    Mesh(MeshError),
}

/// A problem with the numbers of a position.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VectorProblem {
    /// There are fewer than three.
    #[error("`v` has too few numbers: expected three, found {found}")]
    TooFewNumbers {
        /// The number of numbers.
        found: usize,
    },
    /// Something stands where a finite number should.
    #[error("`{found}` in `v`: expected a finite number{}", hint(found))]
    BadNumber {
        /// The word in place of the number.
        found: String,
    },
}

/// Returns a hint for a corner whose numbers have backslashes between them.
fn slash_hint(corner: &str) -> &'static str {
    let is_of_numbers = corner
        .chars()
        .all(|c| c.is_ascii_digit() || "-/\\".contains(c));
    match is_of_numbers && corner.contains('\\') {
        true => " with `/` between them, not `\\`",
        false => "",
    }
}

/// Returns a hint for numbers whose decimals follow a comma, and for those past the range of an `f32`.
fn hint(found: &str) -> &'static str {
    let is_number = |text: &str| text.parse().is_ok_and(f64::is_finite);
    match is_number(found) {
        true => ", at most 3.4e38, and in a scene 1e15",
        false if found.contains(',') && is_number(&found.replacen(',', ".", 1)) => {
            " with a decimal point"
        }
        false => "",
    }
}

/// Writes [`ObjProblem::IndexOutOfRange`], with the range that there is.
fn index_out_of_range(
    what: &str,
    index: &i64,
    count: &usize,
    f: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    if *index == 0 {
        let expected = "1 or more (or -1 and below, counted backwards)";
        return write!(f, "{what} index 0: expected {expected}");
    }
    write!(f, "{what} index {index} is out of range: expected ")?;
    match (*index, *count) {
        (_, 0) => write!(f, "a {what} to be given first, there is none"),
        (..0, count) => write!(f, "-{count} to -1 at this line"),
        (_, count) => write!(f, "1 to {count}"),
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
