//! A method as a user names it.

use super::{Entry, Info, METHODS, Parameter};
use crate::frame::Frame;
use crate::number::suggest::nearest;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

/// A method with values for its parameters: what the lecture calls a variant, as in `fast-phong:steps=1`.
#[derive(Clone, Debug)]
pub struct Variant {
    entry: &'static Entry,
    parameters: Vec<u32>,
}

impl Variant {
    pub(super) fn new(entry: &'static Entry) -> Variant {
        let defaults = entry.info.parameters.iter().map(|p| p.default);
        Variant {
            entry,
            parameters: defaults.collect(),
        }
    }

    /// The variant that `text` names: `NAME` or `NAME:key=value`, further parameters after further colons.
    ///
    /// # Errors
    /// [`MethodError`] when there is no such method or parameter, or the value is outside its range.
    pub fn parse(text: &str) -> Result<Variant, MethodError> {
        let mut parts = text.split(':');
        let name = parts.next().unwrap_or_default();
        let entry = Entry::named(name).ok_or_else(|| MethodError::UnknownMethod {
            name: name.to_string(),
        })?;
        let mut variant = entry.variant();
        for part in parts {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            let place = entry
                .info
                .parameters
                .iter()
                .position(|p| p.name == key)
                .ok_or_else(|| MethodError::UnknownParameter {
                    method: entry.info,
                    key: key.to_string(),
                })?;
            let parameter = &entry.info.parameters[place];
            let number = parameter.parse(value);
            variant.parameters[place] = number.ok_or_else(|| MethodError::Value {
                parameter,
                value: value.to_string(),
            })?;
        }
        Ok(variant)
    }

    /// Its row of the method table.
    pub fn entry(&self) -> &'static Entry {
        self.entry
    }

    /// What is said about its method.
    pub fn info(&self) -> &'static Info {
        self.entry.info
    }

    /// The values of its parameters, in the order of [`Info::parameters`].
    pub fn parameters(&self) -> &[u32] {
        &self.parameters
    }

    /// True if all parameters have their default values.
    pub fn is_default(&self) -> bool {
        self.parameters
            .iter()
            .zip(self.info().parameters)
            .all(|(value, p)| *value == p.default)
    }

    /// Returns [`Info::bound`] with these values of the parameters.
    pub fn bound(&self, frame: &Frame) -> f64 {
        self.info().bound_with(frame, &self.parameters)
    }
}

impl fmt::Display for Variant {
    /// The name, and those parameters that differ from their defaults.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.info().name)?;
        for (value, parameter) in self.parameters.iter().zip(self.info().parameters) {
            if *value != parameter.default {
                write!(f, ":{}={}", parameter.name, parameter.text(*value))?;
            }
        }
        Ok(())
    }
}

/// Why a text names no variant.
#[derive(Clone, Debug)]
pub enum MethodError {
    /// There is no such method.
    UnknownMethod {
        /// The name given.
        name: String,
    },
    /// The method has no such parameter.
    UnknownParameter {
        /// What is said about the method.
        method: &'static Info,
        /// The name given.
        key: String,
    },
    /// The value is not a whole number in its range.
    Value {
        /// The parameter.
        parameter: &'static Parameter,
        /// The value given.
        value: String,
    },
}

impl fmt::Display for MethodError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MethodError::UnknownMethod { name } => {
                write!(f, "unknown method `{name}`")?;
                let names = || METHODS.iter().map(|entry| entry.info.name);
                if let Some(near) = nearest(name, names()) {
                    return write!(f, ": did you mean `{near}`?");
                }
                write!(f, ": expected one of ")?;
                list(f, names())
            }
            MethodError::UnknownParameter { method, key } if method.parameters.is_empty() => {
                write!(
                    f,
                    "method `{}` has no parameters, so `{key}` means nothing",
                    method.name
                )
            }
            MethodError::UnknownParameter { method, key } => {
                write!(
                    f,
                    "method `{}` has no parameter `{key}`: expected one of ",
                    method.name
                )?;
                list(f, method.parameters.iter().map(|p| p.name))
            }
            MethodError::Value { parameter, value } => {
                let Parameter {
                    name, least, most, ..
                } = parameter;
                let auto = if parameter.auto.is_some() {
                    "`auto` or "
                } else {
                    ""
                };
                write!(
                    f,
                    "`{name}={value}`: expected {auto}a whole number from {least} to {most}"
                )
            }
        }
    }
}

fn list<'a>(f: &mut fmt::Formatter<'_>, names: impl Iterator<Item = &'a str>) -> fmt::Result {
    for (i, name) in names.enumerate() {
        write!(f, "{}`{name}`", if i == 0 { "" } else { ", " })?;
    }
    Ok(())
}

impl core::error::Error for MethodError {}
