//! What values of a scene may be: the one place that decides, for files and flags alike.

use super::diagnostics::{SceneError, SourceText};
use super::value::{Located, OneOrThree, Origin};
use crate::picture::Rgb;
use crate::scene::{MAX_COORDINATE, Scene};
use glam::DVec3;
use std::format;
use std::string::String;
use std::sync::Arc;

/// Makes errors that point into the scene file, if there is one.
pub(super) struct Check<'a> {
    source: &'a Option<Arc<SourceText>>,
}

impl<'a> Check<'a> {
    pub fn new(source: &'a Option<Arc<SourceText>>) -> Self {
        Check { source }
    }

    /// An error about the value named `key` given at `origin`: its flag stands for the key when it came from one.
    pub fn error(
        &self,
        origin: &Origin,
        key: &str,
        problem: &str,
        expected: impl Into<String>,
    ) -> SceneError {
        let name = match origin {
            Origin::Flag(flag) => flag,
            Origin::File(_) | Origin::Program => key,
        };
        SceneError::new(
            self.source.clone(),
            origin.clone(),
            format!("`{name}` {problem}"),
            expected,
        )
    }

    /// An error about what no single value says; it points at `origin`.
    pub fn error_at(&self, origin: &Origin, problem: &str, expected: &str) -> SceneError {
        SceneError::new(self.source.clone(), origin.clone(), problem, expected)
    }

    /// An error about the scene as a whole.
    pub fn scene_error(&self, problem: &str, expected: &str) -> SceneError {
        SceneError::new(self.source.clone(), Origin::Program, problem, expected)
    }

    /// Two keys that exclude each other.
    pub fn conflict(
        &self,
        key: &str,
        at: &Origin,
        other_key: &str,
        other: &Origin,
        why: &str,
    ) -> SceneError {
        let other_name = match other {
            Origin::Flag(flag) => flag,
            Origin::File(_) | Origin::Program => other_key,
        };
        self.error(
            at,
            key,
            &format!("and `{other_name}` exclude each other"),
            why,
        )
        .related(other, "the other one is here")
    }

    /// A number for which `is_valid` holds; NaN and infinities are refused first.
    pub fn number(
        &self,
        given: &Located<f64>,
        key: &str,
        is_valid: impl Fn(f64) -> bool,
        expected: &str,
    ) -> Result<f64, SceneError> {
        let value = given.value;
        // What is finite in 64 bits need not be so in the 32 bits of the pixel loops.
        if (value as f32).is_finite() && is_valid(value) {
            Ok(value)
        } else {
            Err(self.error(
                &given.origin,
                key,
                &format!("is {value}"),
                format!("expected {expected}"),
            ))
        }
    }

    /// A length: a number over 0 whose reciprocal stays within the range of coordinates too.
    pub fn length(&self, given: &Located<f64>, key: &str) -> Result<f64, SceneError> {
        let is_length = |value| (1.0 / MAX_COORDINATE..=MAX_COORDINATE).contains(&value);
        self.number(given, key, is_length, "a number over 0 (1e-15 to 1e15)")
    }

    /// A number that is 0 or more.
    pub fn not_negative(&self, given: &Located<f64>, key: &str) -> Result<f64, SceneError> {
        self.number(given, key, |value| value >= 0.0, "0 or more")
    }

    /// A number within the range of coordinates.
    pub fn coordinate(&self, given: &Located<f64>, key: &str) -> Result<f64, SceneError> {
        self.number(given, key, is_coordinate, EXPECTED_COORDINATE)
    }

    /// A point: three numbers within the range of coordinates.
    pub fn point(&self, given: &Located<[f64; 3]>, key: &str) -> Result<DVec3, SceneError> {
        for (axis, value) in ["x", "y", "z"].into_iter().zip(given.value) {
            if !is_coordinate(value) {
                let problem = format!("has {axis} = {value}");
                return Err(self.error(
                    &given.origin,
                    key,
                    &problem,
                    format!("expected {EXPECTED_COORDINATE}"),
                ));
            }
        }
        Ok(DVec3::from_array(given.value))
    }

    /// A direction as a unit vector.
    pub fn direction(&self, given: &Located<[f64; 3]>, key: &str) -> Result<DVec3, SceneError> {
        let vector = DVec3::from_array(given.value);
        if !vector.is_finite() {
            return Err(self.error(
                &given.origin,
                key,
                "is not finite",
                "expected three finite numbers",
            ));
        }
        // Scaled first, so that squares neither overflow nor vanish.
        let largest = vector.abs().max_element();
        if largest == 0.0 {
            return Err(self.error(
                &given.origin,
                key,
                "has no length",
                "expected a direction: not all numbers 0",
            ));
        }
        Ok((vector / largest).normalize())
    }

    /// A colour or a coefficient of each channel: 0 or more, and at most `most`.
    pub fn channels(
        &self,
        given: &Located<OneOrThree>,
        key: &str,
        most: f64,
    ) -> Result<Rgb, SceneError> {
        let values = given.value.0;
        for (name, value) in ["red", "green", "blue"].into_iter().zip(values) {
            if (value as f32).is_finite() && (0.0..=most).contains(&value) {
                continue;
            }
            let problem =
                if values == [value; 3] || value.is_nan() && values.iter().all(|v| v.is_nan()) {
                    format!("is {value}")
                } else {
                    format!("has {name} = {value}")
                };
            let expected = if most.is_finite() {
                format!("expected 0 to {most}")
            } else {
                "expected 0 or more".into()
            };
            return Err(self.error(&given.origin, key, &problem, expected));
        }
        Ok(values.map(|value| value as f32))
    }

    /// A side of the picture.
    pub fn side(&self, given: &Located<i64>, key: &str) -> Result<u32, SceneError> {
        match u32::try_from(given.value) {
            Ok(side) if (1..=Scene::MAX_SIDE).contains(&side) => Ok(side),
            _ => {
                let expected = format!("expected 1 to {}", Scene::MAX_SIDE);
                Err(self.error(&given.origin, key, &format!("is {}", given.value), expected))
            }
        }
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

/// What a coordinate may be, in words; see [`MAX_COORDINATE`].
const EXPECTED_COORDINATE: &str = "numbers between -1e15 and 1e15";
