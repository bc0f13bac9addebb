//! Why an OBJ file could not be read.

use super::super::{MeshError, PolygonMesh};
use std::format;
use std::path::{Path, PathBuf};
use std::string::{String, ToString};

/// Why an OBJ file could not be read: which file, which line, what is wrong and what was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{}: {problem}", path.display(), line.map_or(String::new(), |line| format!(":{line}")))]
pub struct ObjError {
    path: PathBuf,
    line: Option<usize>,
    problem: ObjProblem,
}

impl ObjError {
    /// Makes an error at a line, or about the whole file.
    pub(super) fn new(path: &Path, line: Option<usize>, problem: ObjProblem) -> Self {
        ObjError {
            path: path.to_path_buf(),
            line,
            problem,
        }
    }

    /// Returns the file, as it was named when it was asked for.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the line, counted from 1; `None` when the whole file is meant.
    pub fn line(&self) -> Option<usize> {
        self.line
    }

    /// Returns the problem.
    pub fn problem(&self) -> &ObjProblem {
        &self.problem
    }
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
    /// The file is text, but has no face of three corners or more.
    #[error("has {}an `f` line of at least three corners", match points_or_lines {
        true => "points or lines but no polygon: expected ",
        false => "no polygon: expected OBJ text with ",
    })]
    NoPolygons {
        /// True if it has points or lines instead.
        points_or_lines: bool,
    },
    /// A `v` or `vn` has fewer than three numbers.
    #[error("`{keyword}` has too few numbers: expected three, found {found}")]
    TooFewNumbers {
        /// The statement.
        keyword: &'static str,
        /// The number of its numbers.
        found: usize,
    },
    /// Something stands where a finite number should.
    #[error("`{found}` in `{keyword}`: expected a finite number")]
    BadNumber {
        /// The statement.
        keyword: &'static str,
        /// The text that stands there.
        found: String,
    },
    /// A corner is none of `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    #[error("`{0}` is no corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers")]
    BadCorner(String),
    /// A corner names a position or normal that the file does not have.
    #[error("{what} index {index}{}", expected_index(what, *index, *count))]
    IndexOutOfRange {
        /// `position` or `normal`.
        what: &'static str,
        /// The index as written: counted from 1, or backwards from -1.
        index: i64,
        /// The number of entries: in the whole file, or so far when the index counts backwards.
        count: usize,
    },
    /// More polygons than [`PolygonMesh::MAX_POLYGONS`].
    #[error("too many polygons: expected at most {}", PolygonMesh::MAX_POLYGONS)]
    TooManyPolygons,
    /// More corners than [`PolygonMesh::MAX_CORNERS`].
    #[error("too many corners: expected at most {}", PolygonMesh::MAX_CORNERS)]
    TooManyCorners,
    /// The mesh refused its data.
    #[error("{0}: expected a mesh within its limits")]
    Mesh(MeshError),
}

/// Says what is wrong with an index, and which would do.
fn expected_index(what: &str, index: i64, count: usize) -> String {
    match (index, count) {
        (0, _) => ": expected 1 or more (or -1 and below, counted backwards)".into(),
        (_, 0) => format!(" is out of range: expected a {what} to be given first, there is none"),
        (..0, _) => format!(" is out of range: expected -{count} to -1 at this line"),
        _ => format!(" is out of range: expected 1 to {count}"),
    }
}

/// At most this many characters of a file are quoted in an error: more would not be read.
const QUOTED: usize = 32;

/// Returns `text` as it can stand in a one-line message: control characters escaped, long text cut.
pub(super) fn quote(text: &str) -> String {
    let mut characters = text.chars();
    let mut quoted: String = characters
        .by_ref()
        .take(QUOTED)
        .flat_map(char::escape_debug)
        .collect();
    if characters.next().is_some() {
        quoted.push('…');
    }
    if quoted.is_empty() {
        "nothing".to_string()
    } else {
        quoted
    }
}
