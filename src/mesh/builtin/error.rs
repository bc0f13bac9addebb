//! What can be wrong about a built-in mesh that is asked for.

use super::{BUILTINS, Kind, POLYGONS};
use crate::mesh::{MeshError, PolygonMesh};
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// Why a built-in mesh could not be made.
#[derive(Clone, Debug, PartialEq)]
pub enum BuiltinError {
    /// There is no such shape.
    UnknownShape {
        /// The name that was asked for.
        name: String,
        /// The name that may be meant.
        suggestion: Option<&'static str>,
    },
    /// The shape has no such parameter.
    UnknownKey {
        /// The shape.
        shape: &'static str,
        /// The name that was given.
        key: String,
        /// The names that the shape knows.
        valid: Vec<&'static str>,
        /// The name that may be meant.
        suggestion: Option<&'static str>,
    },
    /// A parameter is not written as `key=value`.
    NoValue {
        /// What stands there.
        found: String,
    },
    /// A parameter is set twice.
    Repeated {
        /// The parameter.
        key: &'static str,
    },
    /// A value is not of its parameter's kind.
    NotA {
        /// What it should be.
        kind: Kind,
        /// The parameter.
        key: &'static str,
        /// What was given.
        value: String,
    },
    /// A value is outside of its parameter's range.
    OutOfRange {
        /// The parameter.
        key: &'static str,
        /// What was given.
        value: String,
        /// The least value allowed.
        min: f64,
        /// The largest value allowed.
        max: f64,
    },
    /// [`POLYGONS`] stands beside a parameter that it sets itself.
    Conflict {
        /// That parameter.
        key: &'static str,
    },
    /// The knot's `p` and `q` have a common factor: that is not a knot, but several curves.
    NoKnot {
        /// The common factor.
        factor: usize,
    },
    /// The mesh would have more than [`PolygonMesh::MAX_POLYGONS`] polygons.
    TooManyPolygons {
        /// How many it would have.
        count: u64,
    },
    /// The mesh was refused.
    Mesh(MeshError),
}

impl fmt::Display for BuiltinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let did_you_mean = |f: &mut fmt::Formatter<'_>, suggestion: &Option<&str>| match suggestion
        {
            Some(name) => write!(f, "; did you mean `{name}`?"),
            None => Ok(()),
        };
        match self {
            BuiltinError::UnknownShape { name, suggestion } => {
                write!(f, "no built-in mesh is named `{name}`")?;
                did_you_mean(f, suggestion)?;
                f.write_str(" (there are ")?;
                write_list(f, BUILTINS.iter().map(|b| b.name))?;
                f.write_str(")")
            }
            BuiltinError::UnknownKey {
                shape,
                key,
                valid,
                suggestion,
            } => {
                write!(f, "`{shape}` has no parameter `{key}`")?;
                did_you_mean(f, suggestion)?;
                f.write_str(if valid.is_empty() {
                    " (it has none"
                } else {
                    " (it has "
                })?;
                write_list(f, valid.iter().copied())?;
                f.write_str(")")
            }
            BuiltinError::NoValue { found } => {
                write!(f, "`{found}` should be written as key=value")
            }
            BuiltinError::Repeated { key } => write!(f, "`{key}` is set twice"),
            BuiltinError::NotA { kind, key, value } => {
                write!(f, "`{key}` is {kind}, not `{value}`")
            }
            BuiltinError::OutOfRange {
                key,
                value,
                min,
                max,
            } => {
                write!(
                    f,
                    "`{key}` goes from {min} to {max}, which `{value}` is outside of"
                )
            }
            BuiltinError::Conflict { key } => {
                write!(
                    f,
                    "`{POLYGONS}` chooses `{key}` itself; give one or the other"
                )
            }
            BuiltinError::NoKnot { factor } => {
                write!(
                    f,
                    "`p` and `q` of a knot have no common factor, but these have {factor}"
                )
            }
            BuiltinError::TooManyPolygons { count } => {
                let most = PolygonMesh::MAX_POLYGONS;
                write!(
                    f,
                    "the mesh would have {count} polygons, over the limit of {most}"
                )
            }
            BuiltinError::Mesh(error) => error.fmt(f),
        }
    }
}

fn write_list(
    f: &mut fmt::Formatter<'_>,
    names: impl Iterator<Item = &'static str>,
) -> fmt::Result {
    for (i, name) in names.enumerate() {
        write!(f, "{}{name}", if i == 0 { "" } else { ", " })?;
    }
    Ok(())
}

impl core::error::Error for BuiltinError {}
