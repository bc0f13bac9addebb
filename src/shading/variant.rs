//! A method with its parameters: what a user names and a program draws with.

use super::light::Uniforms;
use super::{Carried, Info, METHODS, MethodRow, Value};
use crate::number::NameError;
use crate::reference::ClosedForm;
use crate::scene::{Lighting, Power};
use crate::shading::methods::integers;
use alloc::borrow::ToOwned;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

/// A method with values for its parameters, which the lecture calls a variant, as in
/// `fast-phong:steps=1`.
///
/// Take one from a constant, `methods::FAST_PHONG.variant()`, and change it by [`Variant::with`];
/// or read what a user wrote by [`Variant::parse`]. [`Variant::render`] and [`Variant::draw`] draw
/// frames with it.
#[derive(Clone, Debug)]
pub struct Variant {
    row: &'static MethodRow,
    parameters: Vec<Value>,
    power: Power,
}

impl MethodRow {
    /// Returns the method with its default parameters.
    pub fn variant(&'static self) -> Variant {
        let defaults = self.info.parameters.iter().map(|p| p.default);
        Variant {
            row: self,
            parameters: defaults.collect(),
            power: Power::default(),
        }
    }
}

impl Variant {
    /// Returns the variant that `text` names: `NAME` or `NAME:key=value`, with further parameters
    /// after further colons.
    ///
    /// ```
    /// use fastphong::shading::{Variant, methods};
    ///
    /// let variant = Variant::parse("fast-phong:steps=1")?;
    /// assert_eq!(variant, methods::FAST_PHONG.variant().with("steps", 1)?);
    /// assert_eq!("fast-phong:steps=1".parse::<Variant>()?, variant);
    /// # Ok::<(), fastphong::number::NameError>(())
    /// ```
    ///
    /// # Errors
    /// [`NameError`] if there is no method or parameter of this name, or the value is outside its
    /// range.
    pub fn parse(text: &str) -> Result<Variant, NameError> {
        let mut parts = text.split(':');
        let name = parts.next().unwrap_or_default();
        let row = MethodRow::named(name).ok_or_else(|| NameError::Unknown {
            kind: "method",
            name: name.to_owned(),
            known: METHODS.iter().map(|row| row.info.name).collect(),
        })?;
        let mut variant = row.variant();
        for part in parts {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            variant = variant.with(key, value)?;
        }
        Ok(variant)
    }

    /// Returns the variant with another value of a parameter, a number or a word.
    ///
    /// `power` chooses the power function of highlights ([`Power::name`]); its parameter may be set
    /// after it.
    ///
    /// ```
    /// use fastphong::shading::methods;
    ///
    /// let fast = methods::FAST_PHONG.variant().with("steps", 1)?;
    /// assert_eq!(fast.to_string(), "fast-phong:steps=1");
    /// let lookup = fast.with("power", "table")?.with("size", 128)?;
    /// assert_eq!(lookup.to_string(), "fast-phong:steps=1:power=table:size=128");
    /// # Ok::<(), fastphong::number::NameError>(())
    /// ```
    ///
    /// # Errors
    /// [`NameError`] if the method has no parameter of this name, or the value is outside its
    /// range.
    pub fn with(mut self, key: &str, value: impl fmt::Display) -> Result<Variant, NameError> {
        let (info, value) = (self.info(), value.to_string());
        if key == "power" {
            if !info.has_power {
                return Err(NameError::OwnPowers { method: info.name });
            }
            self.power = Power::named(&value)?;
        } else if (self.power.parameter()).is_some_and(|(name, _)| name == key) {
            self.power = self.power.with(key, &value)?;
        } else {
            let index = info
                .parameters
                .iter()
                .position(|p| p.name == key)
                .ok_or_else(|| NameError::UnknownParameter {
                    kind: "method",
                    owner: info.name,
                    name: key.to_owned(),
                    known: info.parameters.iter().map(|p| p.name).collect(),
                })?;
            self.parameters[index] = info.parameters[index].parse(&value)?;
        }
        Ok(self)
    }

    /// Returns the row of the method in [`METHODS`].
    pub fn row(&self) -> &'static MethodRow {
        self.row
    }

    /// Returns the description of the method.
    pub fn info(&self) -> &'static Info {
        self.row.info
    }

    /// Returns the values of the parameters, in the order of [`Info::parameters`].
    pub fn parameters(&self) -> &[Value] {
        &self.parameters
    }

    /// Returns the power function of highlights.
    pub fn power(&self) -> Power {
        self.power
    }

    /// Prepares the light on a material. Colours are multiplied by `scale`.
    pub(crate) fn uniforms(&self, lighting: &Lighting, scale: f32) -> Uniforms {
        let mut uniforms = Uniforms::new(lighting, self.power, scale);
        if self.row.is_integer {
            uniforms.materials = integers::materials(lighting);
        }
        if self.row.kernels(1, false).carries == Carried::Turned {
            uniforms = uniforms.turned();
        }
        uniforms
    }

    /// Returns the closed form that the picture is measured against.
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
        } = self.row.variant();
        self.parameters == parameters && self.power == power
    }
}

/// Variants are equal if they draw with one method and equal parameters.
impl PartialEq for Variant {
    fn eq(&self, other: &Variant) -> bool {
        // A row is compared by its address: two crates may each define a method of one name.
        core::ptr::eq(self.row, other.row)
            && self.parameters == other.parameters
            && self.power == other.power
    }
}

impl FromStr for Variant {
    type Err = NameError;

    /// Calls [`Variant::parse`].
    fn from_str(text: &str) -> Result<Variant, NameError> {
        Variant::parse(text)
    }
}

impl fmt::Display for Variant {
    /// Writes the name, and the parameters whose values are not the defaults, as [`Variant::parse`]
    /// reads them.
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
