//! A method as a user names it.

use super::light::Uniforms;
use super::{Carried, Info, METHODS, MethodRow, Value};
use crate::number::NameError;
use crate::number::suggest::{one_of, unknown};
use crate::reference::ClosedForm;
use crate::scene::{Lighting, Power};
use crate::shading::methods::integers;
use alloc::format;
use alloc::vec::Vec;
use core::fmt;

/// A method with values for its parameters: what the lecture calls a variant, as in `fast-phong:steps=1`.
#[derive(Clone, Debug)]
pub struct Variant {
    entry: &'static MethodRow,
    parameters: Vec<Value>,
    power: Power,
}

impl MethodRow {
    /// Returns the method with its default parameters.
    pub fn variant(&'static self) -> Variant {
        let defaults = self.info.parameters.iter().map(|p| p.default);
        Variant {
            entry: self,
            parameters: defaults.collect(),
            power: Power::default(),
        }
    }
}

impl Variant {
    /// Returns the variant that `text` names: `NAME` or `NAME:key=value`, further parameters after further colons.
    ///
    /// # Errors
    /// [`NameError`] when there is no such method or parameter, or the value is outside its range.
    pub fn parse(text: &str) -> Result<Variant, NameError> {
        let mut parts = text.split(':');
        let name = parts.next().unwrap_or_default();
        let names = METHODS.iter().map(|entry| entry.info.name);
        let entry =
            MethodRow::named(name).ok_or_else(|| NameError(unknown("method", name, names)))?;
        let parameters = entry.info.parameters;
        let mut variant = entry.variant();
        for part in parts {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            if key == "power" {
                if !entry.info.has_power {
                    return Err(NameError(format!(
                        "method `{name}` has a table of powers of its own"
                    )));
                }
                variant.power = Power::named(value)?;
                continue;
            }
            if variant
                .power
                .parameter()
                .is_some_and(|(name, _)| name == key)
            {
                variant.power = variant.power.with(key, value)?;
                continue;
            }
            let place = parameters.iter().position(|p| p.name == key);
            let place = place.ok_or_else(|| unknown_parameter(entry.info, key))?;
            variant.parameters[place] = parameters[place].parse(value)?;
        }
        Ok(variant)
    }

    /// Returns its row of the method table.
    pub fn row(&self) -> &'static MethodRow {
        self.entry
    }

    /// Returns the description of its method.
    pub fn info(&self) -> &'static Info {
        self.entry.info
    }

    /// Returns the values of its parameters, in the order of [`Info::parameters`].
    pub fn parameters(&self) -> &[Value] {
        &self.parameters
    }

    /// Returns the power function of its highlights.
    pub fn power(&self) -> Power {
        self.power
    }

    /// Prepares the light on a material, with colours multiplied by `scale`.
    pub(crate) fn uniforms(&self, lighting: &Lighting, scale: f32) -> Uniforms {
        let mut uniforms = Uniforms::new(lighting, self.power, scale);
        if self.entry.is_integer {
            uniforms.materials = integers::materials(lighting);
        }
        if self.entry.kernels(1, false).carries == Carried::Turned {
            uniforms = uniforms.turned();
        }
        uniforms
    }

    /// Returns the closed form that its picture is measured against.
    pub fn closed_form(&self) -> ClosedForm {
        ClosedForm {
            model: self.info().model,
            power: self.power,
        }
    }

    /// True if all parameters have their default values.
    pub fn is_default(&self) -> bool {
        let Variant {
            parameters, power, ..
        } = self.entry.variant();
        self.parameters == parameters && self.power == power
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
        if self.power != Power::default() {
            write!(f, ":power={}", self.power)?;
        }
        Ok(())
    }
}

/// Says that `method` has no parameter `key`.
fn unknown_parameter(method: &Info, key: &str) -> NameError {
    let name = method.name;
    NameError(match method.parameters {
        [] => format!("method `{name}` has no parameters, so `{key}` means nothing"),
        all => {
            let expected = one_of(all.iter().map(|p| p.name));
            format!("method `{name}` has no parameter `{key}`: {expected}")
        }
    })
}
