//! Ranges of the values of a scene: the one place that decides, for files and flags alike.

use super::diagnostics::{Origin, SceneError};
use super::schema::ChoiceWord;
use super::value::{Data, SceneTable};
use crate::picture::Rgb;
use crate::scene::of_mesh::unit;
use crate::scene::{MAX_COORDINATE, Scene};
use glam::DVec3;
use std::borrow::ToOwned;
use std::collections::BTreeMap;
use std::format;
use std::string::String;

/// A table that is read: values in their ranges, or errors that name the key, or the flag that stands for it, and its place.
#[derive(Clone, Copy)]
pub(super) struct Section<'a> {
    /// The table.
    pub table: &'a SceneTable,
    /// The name of it in errors; empty for the scene.
    pub name: &'static str,
}

/// A table that is not given.
static NONE: SceneTable = SceneTable {
    entries: BTreeMap::new(),
    origin: Origin::Program,
};

impl<'a> Section<'a> {
    /// Returns the table called `key`, empty if it is not given; errors call it `name`.
    pub fn section(&self, key: &str, name: &'static str) -> Section<'a> {
        let table = self.table.table(key).unwrap_or(&NONE);
        Section { table, name }
    }

    /// Returns the tables called `key`; errors call each of them `name`.
    pub fn sections(&self, key: &str, name: &'static str) -> impl Iterator<Item = Section<'a>> {
        let tables = self.table.tables(key).iter();
        tables.map(move |table| Section { table, name })
    }

    /// True if `key` is given.
    pub fn has(&self, key: &str) -> bool {
        self.table.get(key).is_some()
    }

    /// Returns what the user called `key`: the flag, where one gave it.
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

    /// Makes `error` point at the value of `key`, too, if that is given.
    pub fn pointing_at(&self, key: &str, label: &str, error: SceneError) -> SceneError {
        match self.table.get(key) {
            Some(value) => error.related(&value.origin, label),
            None => error,
        }
    }

    /// Returns the first of `keys`, names with spaces between them, that is given.
    fn given<'k>(&self, keys: &'k str) -> Option<&'k str> {
        keys.split(' ').find(|key| self.has(key))
    }

    /// Refuses one of `keys` beside one of `others`, both names with spaces between them; `why` says what is expected.
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

    /// Returns a number for which `is_valid` holds; NaN and infinities are refused first.
    pub fn number(
        &self,
        key: &str,
        is_valid: impl Fn(f64) -> bool,
        expected: &str,
    ) -> Result<Option<f64>, SceneError> {
        let Some(&Data::Number(value)) = self.data(key) else {
            return Ok(None);
        };
        // A number that is finite in 64 bits need not be so in the 32 bits of the pixel loops.
        match (value as f32).is_finite() && is_valid(value) {
            true => Ok(Some(value)),
            false => Err(self.error(key, &format!("is {value}"), format!("expected {expected}"))),
        }
    }

    /// Returns a length: a number over 0 whose reciprocal stays within the range of coordinates too.
    pub fn length(&self, key: &str) -> Result<Option<f64>, SceneError> {
        let is_length = |value| (1.0 / MAX_COORDINATE..=MAX_COORDINATE).contains(&value);
        self.number(key, is_length, "a number over 0 (1e-15 to 1e15)")
    }

    /// Returns a number that is 0 or more.
    pub fn not_negative(&self, key: &str) -> Result<Option<f64>, SceneError> {
        self.number(key, |value| value >= 0.0, "0 or more")
    }

    /// Returns a number within the range of coordinates.
    pub fn coordinate(&self, key: &str) -> Result<Option<f64>, SceneError> {
        self.number(key, is_coordinate, COORDINATES)
    }

    /// Returns an angle in radians, given as at most `most` degrees in either direction.
    pub fn angle(&self, key: &str, most: f64) -> Result<Option<f64>, SceneError> {
        let expected = format!("degrees between -{most} and {most}");
        let degrees = self.number(key, |value| value.abs() <= most, &expected)?;
        Ok(degrees.map(f64::to_radians))
    }

    /// Returns three numbers for each of which `is_valid` holds; an error calls the first that is wrong by its name.
    fn three(
        &self,
        key: &str,
        names: [&str; 3],
        is_valid: impl Fn(f64) -> bool,
        expected: String,
    ) -> Result<Option<DVec3>, SceneError> {
        let values = self.table.triple(key);
        let numbers = names
            .into_iter()
            .zip(values.into_iter().flat_map(|v| v.to_array()));
        let Some((name, wrong)) = numbers.into_iter().find(|(_, v)| !is_valid(*v)) else {
            return Ok(values);
        };
        let is_one = values.is_some_and(|v| v.to_array().map(f64::to_bits) == [wrong.to_bits(); 3]);
        let problem = match is_one {
            true => format!("is {wrong}"),
            false => format!("has {name} = {wrong}"),
        };
        Err(self.error(key, &problem, expected))
    }

    /// Returns a point: three numbers within the range of coordinates.
    pub fn point(&self, key: &str) -> Result<Option<DVec3>, SceneError> {
        let expected = format!("expected {COORDINATES}");
        self.three(key, ["x", "y", "z"], is_coordinate, expected)
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

    /// Returns a colour or a coefficient of each channel: 0 or more, and at most `most`.
    pub fn channels(&self, key: &str, most: f64) -> Result<Option<Rgb>, SceneError> {
        let is_valid = |v: f64| (v as f32).is_finite() && (0.0..=most).contains(&v);
        let expected = match most.is_finite() {
            true => format!("expected 0 to {most}"),
            false => "expected 0 or more".to_owned(),
        };
        let channels = self.three(key, ["red", "green", "blue"], is_valid, expected)?;
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

    /// Returns a side of the picture.
    pub fn side(&self, key: &str) -> Result<Option<u32>, SceneError> {
        let sides = 1..=Scene::MAX_SIDE;
        let expected = format!("1 to {}", Scene::MAX_SIDE);
        self.whole(key, |side| sides.contains(&side), &expected)
    }

    /// Returns a choice, if it is given.
    pub fn choice<T: ChoiceWord>(&self, key: &str) -> Option<T> {
        self.table.text(key).and_then(T::from_word)
    }

    /// Returns a choice, its default if none is given.
    pub fn word<T: ChoiceWord>(&self, key: &str) -> T {
        self.choice(key).unwrap_or_default()
    }

    /// True if a switch is given and on.
    pub fn is_on(&self, key: &str) -> bool {
        self.data(key) == Some(&Data::Switch(true))
    }
}

/// True if `value` may be a coordinate: finite, and not over [`MAX_COORDINATE`].
pub(super) fn is_coordinate(value: f64) -> bool {
    value.abs() <= MAX_COORDINATE
}

/// True if all three may be coordinates.
pub(super) fn is_position(point: DVec3) -> bool {
    point.to_array().into_iter().all(is_coordinate)
}

/// The range of coordinates in words; see [`MAX_COORDINATE`].
pub(super) const COORDINATES: &str = "numbers between -1e15 and 1e15";
