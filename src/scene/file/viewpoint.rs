//! From the camera of a scene file to the camera of the scene.

use super::check::Section;
use super::diagnostics::{Origin, SceneError};
use super::upright::turn;
use crate::note::{Note, Notes};
use crate::number::Written;
use crate::scene::direction::unit;
use crate::scene::ranges::{
    self, COORDINATE, FAR, FOVY, HALF_HEIGHT, NEAR, NumberRange, PLANE, TILT,
};
use crate::scene::{Camera, Fit, Projection, Scene};
use glam::{DMat3, DVec3};
use std::format;

/// The fraction of the picture that objects fill.
const FIT: NumberRange = NumberRange::new(1e-3, 100.0, "a fraction of the picture, 0.001 to 100");

/// A camera whose values are valid one by one. Values that depend on the objects are still missing.
pub(super) struct Viewpoint<'a> {
    section: Section<'a>,
    /// Eye and target, unless the camera is fitted around the objects.
    fixed: Option<[DVec3; 2]>,
    fit: Fit,
    half_height: Option<f64>,
    near: Option<f64>,
    far: Option<f64>,
}

impl<'a> Viewpoint<'a> {
    /// Reads `[camera]`. `aspect` is the width of the picture over its height.
    pub fn new(section: Section<'a>, aspect: f64) -> Result<Self, SceneError> {
        exclusions(&section)?;
        let half_height = section.number("half_height", &HALF_HEIGHT)?;
        let fovy = section.number("fovy", &FOVY)?;
        let fraction = section.number("fit", &FIT)?;
        let (near, far) = planes(&section)?;
        let turn = turn(Some(section.table));
        let (fixed, direction) = stand(&section, turn)?;
        let fit = Fit {
            direction,
            up: up(&section, direction, turn)?,
            fraction: fraction.unwrap_or(Scene::DEFAULT_FIT),
            fovy,
            aspect,
        };
        Ok(Viewpoint {
            section,
            fixed,
            fit,
            half_height,
            near,
            far,
        })
    }

    /// Returns the camera for objects at `points`.
    pub fn camera(
        &self,
        points: impl Iterator<Item = DVec3> + Clone,
        notes: &mut Notes,
    ) -> Result<Camera, SceneError> {
        let mut camera = match self.fixed {
            Some([eye, target]) => self.fixed(eye, target, points, notes),
            None => Camera::fit(points, &self.fit).ok_or_else(|| {
                let expected = "nothing to fit the camera to";
                let problem = "the objects have no polygons";
                SceneError::new(Origin::Program, problem, expected)
            })?,
        };
        if let Some(half_height) = self.half_height {
            camera.projection = Projection::Orthographic { half_height };
        }
        camera.near = self.near.unwrap_or(camera.near);
        camera.far = self.far.unwrap_or(camera.far);
        let Camera { near, far, eye, .. } = camera;
        if near >= far {
            // The scene sets one of the planes, and the other one is where the objects end.
            let [near, far] = [near, far].map(Written);
            let problem = format!("leaves nothing between near = {near} and far = {far}");
            let key = if self.far.is_some() { "far" } else { "near" };
            return Err(self.section.error(key, &problem, "expected near below far"));
        }
        if !COORDINATE.holds_all(eye) {
            let expected = "expected coordinates up to 1e15";
            let problem = "puts the eye too far away";
            return Err(self.section.error("eye", problem, expected));
        }
        Ok(camera)
    }

    /// Makes a camera at a fixed position. The planes follow from the objects, and so does the half
    /// height if the scene states no projection.
    fn fixed(
        &self,
        eye: DVec3,
        target: DVec3,
        points: impl Iterator<Item = DVec3> + Clone,
        notes: &mut Notes,
    ) -> Camera {
        let mut camera = Camera {
            eye,
            target,
            up: self.fit.up,
            projection: Projection::Orthographic { half_height: 1.0 },
            near: 1.0,
            far: 2.0,
        };
        camera.projection = match self.fit.fovy {
            Some(fovy) => Projection::Perspective { fovy },
            None => Projection::Orthographic {
                half_height: camera.half_height_around(points.clone(), &self.fit),
            },
        };
        match camera.depth_range(points) {
            Some(range) => (camera.near, camera.far) = range,
            None => notes.push(Note::warning(
                "behind-eye",
                "nothing lies in front of the eye",
            )),
        }
        camera
    }
}

/// Refuses keys that exclude or need each other.
fn exclusions(section: &Section) -> Result<(), SceneError> {
    let why = "expected one of them: `half_height` is orthographic, `fovy` is perspective";
    section.exclude("fovy", "half_height", why)?;
    let why = "expected one of them: `fit` finds the half height";
    section.exclude("fit", "half_height", why)?;
    let why = "expected a place (`eye`, `target`) or a direction, not both";
    section.exclude("direction azimuth elevation", "eye target", why)?;
    let why = "expected `direction`, or `azimuth` and `elevation`";
    section.exclude("azimuth elevation", "direction", why)?;
    if section.has("target") && !section.has("eye") {
        let expected = "a fitted camera looks at the middle of the objects";
        return Err(section.error("target", "needs `eye`", expected));
    }
    Ok(())
}

/// Returns the near and far distances that are set.
fn planes(section: &Section) -> Result<(Option<f64>, Option<f64>), SceneError> {
    let near = if section.has("fovy") {
        section.number("near", &NEAR)?
    } else {
        section.number("near", &PLANE)?
    };
    let far = section.number("far", &FAR)?.map(ranges::far);
    match (near, far) {
        (Some(near), Some(far)) if far <= near => {
            let expected = format!("expected more than near = {}", Written(near));
            let error = section.error("far", &format!("is {}", Written(far)), expected);
            Err(section.pointing_at("near", "near is here", error))
        }
        planes => Ok(planes),
    }
}

/// Returns the eye and the target, unless the camera is fitted, and the direction toward the eye.
/// `turn` turns angles and the default direction.
fn stand(section: &Section, turn: DMat3) -> Result<(Option<[DVec3; 2]>, DVec3), SceneError> {
    if let Some(eye) = section.point("eye")? {
        let target = section.point("target")?.unwrap_or(DVec3::ZERO);
        if eye == target {
            let expected = "expected two different points";
            let error = section.error("eye", "is the point that the camera looks at", expected);
            return Err(if section.has("target") {
                section.pointing_at("target", "target is here", error)
            } else {
                error.help("`target` is the origin by default: set it, too")
            });
        }
        let fixed = (!section.has("fit")).then_some([eye, target]);
        return Ok((fixed, unit(eye - target)));
    }
    if section.has("azimuth") || section.has("elevation") {
        let (sin_a, cos_a) = libm::sincos(azimuth(section)?);
        let elevation = section.angle("elevation", 90.0)?.unwrap_or(0.0);
        let (sin_e, cos_e) = libm::sincos(elevation);
        let direction = DVec3::new(cos_e * sin_a, sin_e, cos_e * cos_a);
        return Ok((None, turn * direction));
    }
    let usual = || turn * unit(DVec3::from_array(Scene::DEFAULT_DIRECTION));
    let direction = section.direction("direction")?;
    Ok((None, direction.unwrap_or_else(usual)))
}

/// Returns the azimuth in radians, 0 by default.
fn azimuth(section: &Section) -> Result<f64, SceneError> {
    // Rounding would lose the degrees of an angle of many turns.
    Ok(section.angle("azimuth", 36_000.0)?.unwrap_or(0.0))
}

/// Returns the upward direction. It is the one that the scene states, or else the up axis of the
/// world. If the view looks along that axis, it is the upward direction of a camera that was tilted
/// there.
fn up(section: &Section, toward_eye: DVec3, turn: DMat3) -> Result<DVec3, SceneError> {
    let upright = turn * DVec3::Y;
    match section.direction("up")? {
        Some(up) if !TILT.holds(toward_eye.cross(up).length()) => {
            let expected = "expected a direction across it";
            Err(section.error("up", "is parallel to the line of sight", expected))
        }
        Some(up) => Ok(up),
        None if TILT.holds(toward_eye.cross(upright).length()) => Ok(upright),
        None => {
            let (sin, cos) = libm::sincos(azimuth(section)?);
            let tilted = DVec3::new(-sin, 0.0, -cos) * toward_eye.dot(upright).signum();
            Ok(turn * tilted)
        }
    }
}
