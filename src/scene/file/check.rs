//! Checks values of a scene file or of flags against `scene/ranges.rs`. Errors name the key or the
//! flag.

use super::diagnostics::{Origin, SceneError};
use super::schema::ChoiceWord;
use super::value::{Data, SceneTable};
use crate::number::Written;
use crate::picture::Rgb;
use crate::scene::Scene;
use crate::scene::direction::unit;
use crate::scene::ranges::{COORDINATE, NumberRange, STRENGTH};
use glam::DVec3;
use std::borrow::ToOwned;
use std::collections::BTreeMap;
use std::format;
use std::string::String;

/// A table to be checked. Its functions return values that are in their ranges, or errors that name
/// the key, or the flag that set it, and its place.
#[derive(Clone, Copy)]
pub(super) struct Section<'a> {
    /// The table.
    pub table: &'a SceneTable,
    /// The name of the table in errors. Empty for the scene itself.
    pub name: &'static str,
}

/// The table that stands for an absent one.
static NONE: SceneTable = SceneTable {
    entries: BTreeMap::new(),
    origin: Origin::Program,
};

impl<'a> Section<'a> {
    /// Returns the table called `key`, or an empty one if it is absent. Errors call it `name`.
    pub fn section(&self, key: &str, name: &'static str) -> Section<'a> {
        let table = self.table.table(key).unwrap_or(&NONE);
        Section { table, name }
    }

    /// Returns the tables called `key`. Errors call each of them `name`.
    pub fn sections(&self, key: &str, name: &'static str) -> impl Iterator<Item = Section<'a>> {
        let tables = self.table.tables(key).iter();
        tables.map(move |table| Section { table, name })
    }

    /// True if `key` is set.
    pub fn has(&self, key: &str) -> bool {
        self.table.get(key).is_some()
    }

    /// Returns the user's name for `key`: the flag if a flag set it.
    pub fn name(&self, key: &str) -> String {
        match self.table.get(key).map(|value| &value.origin) {
            Some(Origin::Flag(flag)) => flag.clone(),
            _ if self.name.is_empty() => key.to_owned(),
            _ => format!("{}.{key}", self.name),
        }
    }

    fn data(&self, key: &str) -> Option<&'a Data> {
        self.table.get(key).map(|value| &value.data)
    }

    /// Makes an error about the value of `key`.
    pub fn error(&self, key: &str, problem: &str, expected: impl Into<String>) -> SceneError {
        let title = format!("`{}` {problem}", self.name(key));
        let value = self.table.get(key);
        let origin = value.map_or(&self.table.origin, |value| &value.origin);
        SceneError::new(origin.clone(), title, expected)
    }

    /// Makes an error about the table.
    pub fn table_error(&self, problem: &str, expected: &str) -> SceneError {
        SceneError::new(self.table.origin.clone(), problem, expected)
    }

    /// Makes `error` also point at the value of `key`, if it is set.
    pub fn pointing_at(&self, key: &str, label: &str, error: SceneError) -> SceneError {
        match self.table.get(key) {
            Some(value) => error.related(&value.origin, label),
            None => error,
        }
    }

    /// Returns the first of `keys` that is set. `keys` are names with spaces between them.
    fn given<'k>(&self, keys: &'k str) -> Option<&'k str> {
        keys.split(' ').find(|key| self.has(key))
    }

    /// Refuses one of `keys` beside one of `others`. Both are names with spaces between them. `why`
    /// says what is expected.
    pub fn exclude(&self, keys: &str, others: &str, why: &str) -> Result<(), SceneError> {
        match (self.given(keys), self.given(others)) {
            (Some(key), Some(other)) => Err(self.conflict(key, other, why)),
            _ => Ok(()),
        }
    }

    /// Makes the error for two keys that exclude each other.
    pub fn conflict(&self, key: &str, other: &str, why: &str) -> SceneError {
        let problem = format!("and `{}` exclude each other", self.name(other));
        let error = self.error(key, &problem, why);
        self.pointing_at(other, "the other one is here", error)
    }

    /// Returns a number for which `is_valid` holds, or `None` if the key is absent.
    fn number_if(
        &self,
        key: &str,
        is_valid: impl Fn(f64) -> bool,
        expected: &str,
    ) -> Result<Option<f64>, SceneError> {
        let Some(&Data::Number(value)) = self.data(key) else {
            return Ok(None);
        };
        if is_valid(value) {
            Ok(Some(value))
        } else {
            let problem = format!("is {}", Written(value));
            Err(self.error(key, &problem, format!("expected {expected}")))
        }
    }

    /// Returns a number in this range.
    pub fn number(&self, key: &str, range: &NumberRange) -> Result<Option<f64>, SceneError> {
        self.number_if(key, |value| range.holds(value), range.expected)
    }

    /// Returns an angle in radians. The user writes degrees, at most `most` in either direction.
    pub fn angle(&self, key: &str, most: f64) -> Result<Option<f64>, SceneError> {
        let expected = format!("degrees between -{most} and {most}");
        let degrees = self.number_if(key, |value| value.abs() <= most, &expected)?;
        Ok(degrees.map(f64::to_radians))
    }

    /// Returns three numbers in this range. An error names the first one that is wrong.
    fn three(
        &self,
        key: &str,
        names: [&str; 3],
        range: &NumberRange,
    ) -> Result<Option<DVec3>, SceneError> {
        let values = self.table.triple(key);
        let named = names
            .into_iter()
            .zip(values.into_iter().flat_map(|v| v.to_array()));
        let Some((name, wrong)) = named.into_iter().find(|(_, v)| !range.holds(*v)) else {
            return Ok(values);
        };
        let is_one = values.is_some_and(|v| v.to_array().map(f64::to_bits) == [wrong.to_bits(); 3]);
        let problem = if is_one {
            format!("is {}", Written(wrong))
        } else {
            format!("has {name} = {}", Written(wrong))
        };
        Err(self.error(key, &problem, format!("expected {}", range.expected)))
    }

    /// Returns a point: three numbers in the range of coordinates.
    pub fn point(&self, key: &str) -> Result<Option<DVec3>, SceneError> {
        self.three(key, ["x", "y", "z"], &COORDINATE)
    }

    /// Returns a direction as a unit vector.
    pub fn direction(&self, key: &str) -> Result<Option<DVec3>, SceneError> {
        let (problem, expected) = match self.table.triple(key) {
            Some(vector) if !vector.is_finite() => {
                ("is not finite", "expected three finite numbers")
            }
            Some(DVec3::ZERO) => ("has no length", "expected a direction: not all numbers 0"),
            vector => return Ok(vector.map(unit)),
        };
        Err(self.error(key, problem, expected))
    }

    /// Returns a number of 0 or more that an `f32` can hold.
    pub fn strength(&self, key: &str) -> Result<Option<f64>, SceneError> {
        self.number(key, &STRENGTH)
    }

    /// Returns a colour, or a coefficient per channel.
    pub fn channels(&self, key: &str, range: &NumberRange) -> Result<Option<Rgb>, SceneError> {
        let channels = self.three(key, ["red", "green", "blue"], range)?;
        Ok(channels.map(|values| values.as_vec3().to_array()))
    }

    /// Returns a whole number for which `is_valid` holds.
    pub fn whole(
        &self,
        key: &str,
        is_valid: impl Fn(u32) -> bool,
        expected: &str,
    ) -> Result<Option<u32>, SceneError> {
        let Some(&Data::Whole(value)) = self.data(key) else {
            return Ok(None);
        };
        let valid = u32::try_from(value).ok().filter(|&value| is_valid(value));
        let refused = || self.error(key, &format!("is {value}"), format!("expected {expected}"));
        valid.map(Some).ok_or_else(refused)
    }

    /// Returns the width or height of the picture.
    pub fn side(&self, key: &str) -> Result<Option<u32>, SceneError> {
        let sides = 1..=Scene::MAX_SIDE;
        let expected = format!("1 to {}", Scene::MAX_SIDE);
        self.whole(key, |side| sides.contains(&side), &expected)
    }

    /// Returns the choice, if the key is set.
    pub fn choice<T: ChoiceWord>(&self, key: &str) -> Option<T> {
        self.table.text(key).and_then(T::from_word)
    }

    /// Returns the choice, or the default one if the key is absent.
    pub fn word<T: ChoiceWord>(&self, key: &str) -> T {
        self.choice(key).unwrap_or_default()
    }

    /// True if the switch is set and on.
    pub fn is_on(&self, key: &str) -> bool {
        self.data(key) == Some(&Data::Switch(true))
    }
}
