//! Why an OBJ file could not be read.

use super::super::{MeshError, PolygonMesh};
use core::fmt;
use std::path::{Path, PathBuf};
use std::string::{String, ToString};

/// Why an OBJ file could not be read: which file, which line, what is wrong and what was expected.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjError {
    path: PathBuf,
    line: Option<usize>,
    problem: ObjProblem,
}

impl ObjError {
    pub(super) fn new(path: &Path, line: Option<usize>, problem: ObjProblem) -> Self {
        ObjError {
            path: path.to_path_buf(),
            line,
            problem,
        }
    }

    /// The file, as it was named when it was asked for.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The line, counted from 1; `None` when the whole file is meant.
    pub fn line(&self) -> Option<usize> {
        self.line
    }

    /// What is wrong.
    pub fn problem(&self) -> &ObjProblem {
        &self.problem
    }
}

impl fmt::Display for ObjError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": {}", self.problem)
    }
}

impl std::error::Error for ObjError {}

/// What can be wrong with an OBJ file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ObjProblem {
    /// The file cannot be opened or read; the operating system's words.
    Unreadable(String),
    /// The path names a directory.
    Directory,
    /// The file has no bytes, or white space only.
    Empty,
    /// The file holds bytes that no text has.
    NotText,
    /// The file is text, but has no face of three corners or more.
    NoPolygons {
        /// True if it has points or lines instead.
        points_or_lines: bool,
    },
    /// A `v` or `vn` has fewer than three numbers.
    TooFewNumbers {
        /// The statement.
        keyword: &'static str,
        /// How many numbers it has.
        found: usize,
    },
    /// Something stands where a finite number should.
    BadNumber {
        /// The statement.
        keyword: &'static str,
        /// What stands there.
        found: String,
    },
    /// A corner is none of `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    BadCorner {
        /// What stands there.
        found: String,
    },
    /// A corner names a position or normal that the file does not have.
    IndexOutOfRange {
        /// `position` or `normal`.
        what: &'static str,
        /// The index as written: counted from 1, or backwards from -1.
        index: i64,
        /// How many there are: in the whole file, or so far when the index counts backwards.
        count: usize,
    },
    /// More polygons than [`PolygonMesh::MAX_POLYGONS`].
    TooManyPolygons,
    /// More corners than [`PolygonMesh::MAX_CORNERS`].
    TooManyCorners,
    /// The parser refused text that had passed every check here.
    Parser(String),
    /// The mesh refused its data.
    Mesh(MeshError),
}

impl fmt::Display for ObjProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ObjProblem::Unreadable(why) => {
                write!(f, "cannot be read ({why}): expected an OBJ file")
            }
            ObjProblem::Directory => write!(f, "is a directory: expected an OBJ file"),
            ObjProblem::Empty => write!(f, "is empty: expected OBJ text with `v` and `f` lines"),
            ObjProblem::NotText => write!(
                f,
                "holds binary data: expected OBJ text with `v` and `f` lines"
            ),
            ObjProblem::NoPolygons {
                points_or_lines: false,
            } => {
                write!(
                    f,
                    "has no polygon: expected OBJ text with an `f` line of at least three corners"
                )
            }
            ObjProblem::NoPolygons {
                points_or_lines: true,
            } => {
                write!(
                    f,
                    "has points or lines but no polygon: expected an `f` line of at least three corners"
                )
            }
            ObjProblem::TooFewNumbers { keyword, found } => {
                write!(
                    f,
                    "`{keyword}` has too few numbers: expected three, found {found}"
                )
            }
            ObjProblem::BadNumber { keyword, found } => {
                write!(f, "`{found}` in `{keyword}`: expected a finite number")
            }
            ObjProblem::BadCorner { found } => {
                write!(
                    f,
                    "`{found}` is no corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers"
                )
            }
            ObjProblem::IndexOutOfRange { what, index: 0, .. } => {
                write!(
                    f,
                    "{what} index 0: expected 1 or more (or -1 and below, counted backwards)"
                )
            }
            ObjProblem::IndexOutOfRange {
                what,
                index,
                count: 0,
            } => {
                write!(
                    f,
                    "{what} index {index} is out of range: expected a {what} to be given first, there is none"
                )
            }
            ObjProblem::IndexOutOfRange { what, index, count } if *index < 0 => {
                write!(
                    f,
                    "{what} index {index} is out of range: expected -{count} to -1 at this line"
                )
            }
            ObjProblem::IndexOutOfRange { what, index, count } => {
                write!(
                    f,
                    "{what} index {index} is out of range: expected 1 to {count}"
                )
            }
            ObjProblem::TooManyPolygons => {
                write!(
                    f,
                    "too many polygons: expected at most {}",
                    PolygonMesh::MAX_POLYGONS
                )
            }
            ObjProblem::TooManyCorners => write!(
                f,
                "too many corners: expected at most {}",
                PolygonMesh::MAX_CORNERS
            ),
            ObjProblem::Parser(why) => {
                write!(f, "the OBJ parser gave up ({why}): expected plain polygons")
            }
            ObjProblem::Mesh(why) => write!(f, "{why}: expected a mesh within its limits"),
        }
    }
}

/// At most this many characters of a file are quoted in an error: more would not be read.
const QUOTED: usize = 32;

/// `text` as it can stand in a one-line message: control characters escaped, long text cut.
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
