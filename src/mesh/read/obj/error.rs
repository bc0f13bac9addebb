//! The problems of OBJ files, with their messages.

use super::super::error::hint;
pub(super) use super::super::error::quote;
use crate::mesh::PolygonMesh;
use core::fmt;
use std::string::String;

/// A problem with an OBJ file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(super) enum ObjProblem {
    /// The file has no bytes, or only white space.
    #[error("is empty: expected OBJ text with `v` and `f` lines")]
    Empty,
    /// The file contains bytes that no text has.
    #[error("holds binary data: expected OBJ text with `v` and `f` lines")]
    NotText,
    /// The file is of another format, which the field describes in a few words.
    #[error("is {0}: expected OBJ text with `v` and `f` lines")]
    OtherFile(&'static str),
    /// The file is text but has no face of three corners or more.
    #[error("has no polygon: expected OBJ text with an `f` line of at least three corners")]
    NoPolygons,
    /// The file has points or lines but no face of three corners or more.
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
    #[error("`{0}` is not a corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers{slash}",
        slash = slash_hint(.0))]
    BadCorner(String),
    /// A corner names a position that the file does not have.
    #[error(fmt = index_out_of_range)]
    IndexOutOfRange {
        /// `position`.
        what: &'static str,
        /// The index as written: counted from 1, or backwards from -1.
        index: i64,
        /// How many entries there are: in the whole file, or so far if the index counts backwards.
        count: usize,
    },
    /// More polygons than [`PolygonMesh::MAX_POLYGONS`].
    #[error("too many polygons: expected at most {}", PolygonMesh::MAX_POLYGONS)]
    TooManyPolygons,
    /// More corners than [`PolygonMesh::MAX_CORNERS`].
    #[error("too many corners: expected at most {}", PolygonMesh::MAX_CORNERS)]
    TooManyCorners,
    /// The parser refused text that had passed every check of the pre-scan.
    #[error("the OBJ parser gave up ({0}): expected plain polygons")]
    Parser(String),
}

/// A problem with the numbers of a position.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum VectorProblem {
    /// There are fewer than three.
    #[error("`v` has too few numbers: expected three, found {found}")]
    TooFewNumbers {
        /// How many there are.
        found: usize,
    },
    /// A word is not a finite number.
    #[error("`{found}` in `v`: expected a finite number{}", hint(found))]
    BadNumber {
        /// The word in place of the number.
        found: String,
    },
}

/// Returns a hint for a corner that has backslashes between its numbers.
fn slash_hint(corner: &str) -> &'static str {
    let is_of_numbers = corner
        .chars()
        .all(|c| c.is_ascii_digit() || "-/\\".contains(c));
    if is_of_numbers && corner.contains('\\') {
        " with `/` between them, not `\\`"
    } else {
        ""
    }
}

/// Writes [`ObjProblem::IndexOutOfRange`] with the valid range.
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
        (..0, 0) => write!(f, "a {what} before this line, but there is none"),
        (_, 0) => write!(f, "a {what} in the file, but there is none"),
        (..0, count) => write!(f, "-{count} to -1 at this line"),
        (_, count) => write!(f, "1 to {count}"),
    }
}
