//! A method as a user names it.

use super::{Entry, Info, METHODS, MethodParameter};
use crate::frame::Frame;
use crate::number::suggest::nearest;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

/// A method with values for its parameters: what the lecture calls a variant, as in `fast-phong:steps=1`.
#[derive(Clone, Debug)]
pub struct Variant {
    entry: &'static Entry,
    parameters: Vec<u32>,
}

impl Entry {
    /// Returns the method with its default parameters.
    pub fn variant(&'static self) -> Variant {
        let defaults = self.info.parameters.iter().map(|p| p.default);
        Variant {
            entry: self,
            parameters: defaults.collect(),
        }
    }
}

impl Variant {
    /// Returns the variant that `text` names: `NAME` or `NAME:key=value`, further parameters after further colons.
    ///
    /// # Errors
    /// [`MethodError`] when there is no such method or parameter, or the value is outside its range.
    pub fn parse(text: &str) -> Result<Variant, MethodError> {
        let mut parts = text.split(':');
        let name = parts.next().unwrap_or_default();
        let entry = Entry::named(name).ok_or_else(|| MethodError::method(name))?;
        let parameters = entry.info.parameters;
        let mut variant = entry.variant();
        for part in parts {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            let place = parameters.iter().position(|p| p.name == key);
            let place = place.ok_or_else(|| MethodError::parameter(entry.info, key))?;
            let number = parameters[place].parse(value);
            variant.parameters[place] =
                number.ok_or_else(|| MethodError::value(&parameters[place], value))?;
        }
        Ok(variant)
    }

    /// Returns its row of the method table.
    pub fn entry(&self) -> &'static Entry {
        self.entry
    }

    /// Returns the description of its method.
    pub fn info(&self) -> &'static Info {
        self.entry.info
    }

    /// Returns the values of its parameters, in the order of [`Info::parameters`].
    pub fn parameters(&self) -> &[u32] {
        &self.parameters
    }

    /// True if all parameters have their default values.
    pub fn is_default(&self) -> bool {
        self.parameters == self.entry.variant().parameters
    }

    /// Returns [`Info::bound`] with these values of the parameters.
    pub fn bound(&self, frame: &Frame) -> f64 {
        self.info().bound_with(frame, &self.parameters)
    }
}

impl fmt::Display for Variant {
    /// Writes the name, and those parameters that differ from their defaults.
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

/// The reason why a text names no variant, as a sentence.
#[derive(Clone, Debug)]
pub struct MethodError(String);

impl MethodError {
    fn method(name: &str) -> MethodError {
        let names = || METHODS.iter().map(|entry| entry.info.name);
        let advice = match nearest(name, names()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => one_of(names()),
        };
        MethodError(format!("unknown method `{name}`: {advice}"))
    }

    fn parameter(method: &Info, key: &str) -> MethodError {
        let name = method.name;
        MethodError(match method.parameters {
            [] => format!("method `{name}` has no parameters, so `{key}` means nothing"),
            all => {
                let expected = one_of(all.iter().map(|p| p.name));
                format!("method `{name}` has no parameter `{key}`: {expected}")
            }
        })
    }

    fn value(parameter: &MethodParameter, value: &str) -> MethodError {
        let (name, least, most) = (parameter.name, parameter.least, parameter.most);
        let auto = parameter.auto.map_or("", |_| "`auto` or ");
        MethodError(format!(
            "`{name}={value}`: expected {auto}a whole number from {least} to {most}"
        ))
    }
}

fn one_of<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| format!("`{name}`")).collect();
    format!("expected one of {}", names.join(", "))
}

impl fmt::Display for MethodError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for MethodError {}
