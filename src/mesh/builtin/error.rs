//! The error for a built-in mesh that cannot be made.

use super::{BUILTINS, POLYGONS};
use crate::mesh::{MeshError, PolygonMesh};
use crate::number::suggest::nearest;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// A built-in mesh that cannot be made. `Display` writes one sentence: what is wrong and what was
/// expected.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BuiltinError {
    /// No shape has this name.
    UnknownShape {
        /// The name as written.
        name: String,
    },
    /// The shape has no parameter of this name.
    UnknownParameter {
        /// The shape.
        shape: &'static str,
        /// The name as written.
        parameter: String,
    },
    /// A part of the text is not `key=value`.
    NotKeyValue {
        /// The part as written.
        found: String,
    },
    /// A parameter is set more than once.
    SetTwice {
        /// The parameter.
        parameter: &'static str,
    },
    /// A value is not of the kind that its parameter has.
    WrongKind {
        /// The parameter.
        parameter: &'static str,
        /// The kind in words: `a whole number`.
        expected: &'static str,
        /// The value as written.
        found: String,
    },
    /// A value is out of its parameter's range.
    OutOfRange {
        /// The parameter.
        parameter: &'static str,
        /// The value as written.
        found: String,
        /// The smallest value allowed.
        min: f64,
        /// The largest value allowed.
        max: f64,
    },
    /// `polygons` is set together with a parameter that it chooses itself.
    PolygonsAndResolution {
        /// The other parameter.
        parameter: &'static str,
    },
    /// `p` and `q` of a knot have a common factor: the curve would run over itself.
    CommonFactor {
        /// Their greatest common factor.
        factor: usize,
    },
    /// The mesh would have more than [`PolygonMesh::MAX_POLYGONS`] polygons.
    TooManyPolygons {
        /// How many polygons it would have.
        count: u64,
    },
    /// The shape's parameters are valid, but do not make a mesh.
    Mesh(MeshError),
}

impl fmt::Display for BuiltinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BuiltinError::UnknownShape { name } => {
                let names: Vec<_> = BUILTINS.iter().map(|shape| shape.name).collect();
                write!(f, "no built-in mesh is named `{name}`")?;
                suggest(name, &names, f)?;
                write!(f, " (there are {})", names.join(", "))
            }
            BuiltinError::UnknownParameter { shape, parameter } => {
                let entry = BUILTINS.iter().filter(|entry| entry.name == *shape);
                let names: Vec<_> = entry
                    .flat_map(|entry| entry.all_parameters())
                    .map(|p| p.name)
                    .collect();
                write!(f, "`{shape}` has no parameter `{parameter}`")?;
                suggest(parameter, &names, f)?;
                match names.len() {
                    0 => f.write_str(" (it has none)"),
                    _ => write!(f, " (it has {})", names.join(", ")),
                }
            }
            BuiltinError::NotKeyValue { found } => {
                write!(f, "`{found}` should be written as key=value")
            }
            BuiltinError::SetTwice { parameter } => write!(f, "`{parameter}` is set twice"),
            BuiltinError::WrongKind {
                parameter,
                expected,
                found,
            } => write!(f, "`{parameter}` is {expected}, not `{found}`"),
            BuiltinError::OutOfRange {
                parameter,
                found,
                min,
                max,
            } => write!(f, "`{parameter}` is {found}: expected {min} to {max}"),
            BuiltinError::PolygonsAndResolution { parameter } => write!(
                f,
                "`{POLYGONS}` chooses `{parameter}` itself: set one or the other"
            ),
            BuiltinError::CommonFactor { factor } => write!(
                f,
                "`p` and `q` of the knot have the common factor {factor}: expected two numbers without one"
            ),
            BuiltinError::TooManyPolygons { count } => write!(
                f,
                "the mesh would have {count} polygons, over the limit of {}",
                PolygonMesh::MAX_POLYGONS
            ),
            BuiltinError::Mesh(error) => error.fmt(f),
        }
    }
}

/// Asks if the one of `names` that is most like `written` was meant, if one is like it.
fn suggest(written: &str, names: &[&'static str], f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match nearest(written, names.iter().copied()) {
        Some(meant) => write!(f, "; did you mean `{meant}`?"),
        None => Ok(()),
    }
}

impl core::error::Error for BuiltinError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            // Its text is already this error's own text.
            BuiltinError::Mesh(error) => error.source(),
            _ => None,
        }
    }
}

impl From<MeshError> for BuiltinError {
    fn from(error: MeshError) -> Self {
        BuiltinError::Mesh(error)
    }
}
