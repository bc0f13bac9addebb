//! The error of a name or a value that is unknown or not available.

use super::SimdLevel;
use super::suggest::{one_of, unknown};
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// The reason why a text names no method, parameter, power function or instruction set.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NameError {
    /// Nothing of this kind has this name.
    Unknown {
        /// The kind of thing, as in `method`.
        kind: &'static str,
        /// The unknown name.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// A method or a power function has no parameter with this name.
    UnknownParameter {
        /// The kind of its owner, `method` or `power`.
        kind: &'static str,
        /// The name of its owner.
        owner: &'static str,
        /// The unknown name.
        name: String,
        /// The parameters that the owner has.
        known: Vec<&'static str>,
    },
    /// A parameter does not accept this value.
    Value {
        /// The parameter.
        parameter: &'static str,
        /// The rejected value.
        value: String,
        /// The accepted values, as in `expected a whole number from 1 to 8`.
        expected: String,
    },
    /// A method with its own table of powers accepts no power function.
    OwnPowers {
        /// The method.
        method: &'static str,
    },
    /// This machine lacks an instruction set.
    NotOnThisMachine {
        /// The missing instruction set.
        level: SimdLevel,
        /// The instruction sets of this machine, and `auto`.
        available: Vec<&'static str>,
    },
}

impl fmt::Display for NameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let expected = |known: &[&'static str]| one_of(known.iter().copied());
        match self {
            NameError::Unknown { kind, name, known } => {
                f.write_str(&unknown(kind, name, known.iter().copied()))
            }
            NameError::UnknownParameter {
                kind,
                owner,
                name,
                known,
            } if known.is_empty() => write!(
                f,
                "{kind} `{owner}` has no parameters, so `{name}` means nothing"
            ),
            NameError::UnknownParameter {
                kind,
                owner,
                name,
                known,
            } => write!(
                f,
                "{kind} `{owner}` has no parameter `{name}`: {}",
                expected(known)
            ),
            NameError::Value {
                parameter,
                value,
                expected,
            } => write!(f, "`{parameter}={value}`: {expected}"),
            NameError::OwnPowers { method } => {
                write!(f, "method `{method}` has its own table of powers")
            }
            NameError::NotOnThisMachine { level, available } => write!(
                f,
                "this machine does not have `{level}`: {}",
                expected(available)
            ),
        }
    }
}

impl core::error::Error for NameError {}
