//! From the camera of a scene file to the camera of the scene.

use super::check::{Section, is_coordinate, is_position};
use super::diagnostics::SceneError;
use crate::scene::of_mesh::unit;
use crate::scene::{Camera, Fit, Projection, Scene};
use glam::DVec3;
use std::format;
use std::string::String;
use std::vec::Vec;

/// The least sine of the angle between `up` and the line of sight: below it, rounding decides what is up.
const LEAST_TILT: f64 = 1e-6;

/// A camera whose every value is valid by itself; what depends on the objects is still open.
pub(super) struct Viewpoint<'a> {
    section: Section<'a>,
    stand: Stand,
    up: DVec3,
    half_height: Option<f64>,
    fovy: Option<f64>,
    near: Option<f64>,
    far: Option<f64>,
    fraction: f64,
}

enum Stand {
    /// Exactly there.
    Fixed { eye: DVec3, target: DVec3 },
    /// Around the objects, in this direction.
    Fitted { direction: DVec3 },
}

impl<'a> Viewpoint<'a> {
    /// Reads `[camera]`.
    pub fn new(section: Section<'a>) -> Result<Self, SceneError> {
        exclusions(&section)?;
        let half_height = section.length("half_height")?;
        let is_angle = |v| (1e-3..=179.999).contains(&v);
        let expected = "degrees over 0 and under 180 (0.001 to 179.999)";
        let fovy = section.number("fovy", is_angle, expected)?;
        let is_part = |v| (1e-3..=100.0).contains(&v);
        let fit = section.number("fit", is_part, "a part of the frame, 0.001 to 100")?;
        let (near, far) = planes(&section)?;
        let stand = stand(&section)?;
        let toward_eye = match stand {
            Stand::Fixed { eye, target } => (eye - target).normalize(),
            Stand::Fitted { direction } => direction,
        };
        Ok(Viewpoint {
            section,
            stand,
            up: up(&section, toward_eye)?,
            half_height,
            fovy,
            near,
            far,
            fraction: fit.unwrap_or(Scene::DEFAULT_FIT),
        })
    }

    /// Returns the camera, now that it is known what it looks at.
    pub fn camera(
        &self,
        points: impl Iterator<Item = DVec3> + Clone,
        aspect: f64,
        warnings: &mut Vec<String>,
    ) -> Result<Camera, SceneError> {
        let mut camera = match self.stand {
            Stand::Fixed { eye, target } => self.fixed(eye, target, points, aspect, warnings),
            Stand::Fitted { direction } => {
                let fit = Fit {
                    direction,
                    up: self.up,
                    fraction: self.fraction,
                    fovy: self.fovy,
                    aspect,
                };
                Camera::fit(points, &fit).ok_or_else(|| {
                    let expected = "nothing to fit the camera to";
                    self.section
                        .scene_error("the objects have no polygons", expected)
                })?
            }
        };
        if let Some(half_height) = self.half_height {
            camera.projection = Projection::Orthographic { half_height };
        }
        camera.near = self.near.unwrap_or(camera.near);
        camera.far = self.far.unwrap_or(camera.far);
        let Camera { near, far, eye, .. } = camera;
        if near >= far {
            // One of them was given, the other one is where the objects end.
            let problem = format!("leaves nothing between near = {near} and far = {far}");
            let key = if self.far.is_some() { "far" } else { "near" };
            return Err(self.section.error(key, &problem, "expected near below far"));
        }
        if !is_position(eye) {
            let expected = "expected coordinates up to 1e15";
            let problem = "puts the eye too far away";
            return Err(self.section.error("eye", problem, expected));
        }
        Ok(camera)
    }

    /// Makes a camera at a given place; the planes, and without a projection the half height, follow from the objects.
    fn fixed(
        &self,
        eye: DVec3,
        target: DVec3,
        points: impl Iterator<Item = DVec3> + Clone,
        aspect: f64,
        warnings: &mut Vec<String>,
    ) -> Camera {
        let projection = match self.fovy {
            Some(fovy) => Projection::Perspective { fovy },
            None => Projection::Orthographic { half_height: 1.0 },
        };
        let mut camera = Camera {
            eye,
            target,
            up: self.up,
            projection,
            near: 1.0,
            far: 2.0,
        };
        if self.fovy.is_none() && self.half_height.is_none() {
            let half_height = camera.half_height_around(points.clone(), self.fraction, aspect);
            camera.projection = Projection::Orthographic { half_height };
        }
        match camera.depth_range(points) {
            Some(range) => (camera.near, camera.far) = range,
            None => warnings.push("nothing lies before the eye".into()),
        }
        camera
    }
}

/// Refuses keys that exclude or need each other.
fn exclusions(section: &Section) -> Result<(), SceneError> {
    let two_projections =
        "expected one of them: `half_height` is orthographic, `fovy` is perspective";
    let two_sizes = "expected one of them: `fit` finds the half height";
    for (key, why) in [("fovy", two_projections), ("fit", two_sizes)] {
        if section.has("half_height") && section.has(key) {
            return Err(section.conflict(key, "half_height", why));
        }
    }
    let given = |keys: &[&'static str]| keys.iter().copied().find(|key| section.has(key));
    let turn = given(&["direction", "azimuth", "elevation"]);
    match (turn, given(&["eye", "target"])) {
        (Some(turn), Some(place)) => {
            let why = "expected a place (`eye`, `target`) or a direction, not both";
            Err(section.conflict(turn, place, why))
        }
        (None, Some("target")) => {
            let expected = "a fitted camera looks at the middle of the objects";
            Err(section.error("target", "needs `eye`", expected))
        }
        (Some("direction"), _) => match given(&["azimuth", "elevation"]) {
            Some(other) => {
                let why = "expected `direction`, or `azimuth` and `elevation`";
                Err(section.conflict(other, "direction", why))
            }
            None => Ok(()),
        },
        _ => Ok(()),
    }
}

/// Returns the near and far distances that are given.
fn planes(section: &Section) -> Result<(Option<f64>, Option<f64>), SceneError> {
    let near = if section.has("fovy") {
        let expected = "a number over 0, as the camera is a perspective one";
        section.number("near", |v| v > 0.0 && is_coordinate(v), expected)?
    } else {
        section.coordinate("near")?
    };
    let far = section.coordinate("far")?;
    match (near, far) {
        (Some(near), Some(far)) if far <= near => {
            let expected = format!("expected more than near = {near}");
            let error = section.error("far", &format!("is {far}"), expected);
            Err(section.pointing_at("near", "near is here", error))
        }
        planes => Ok(planes),
    }
}

/// Returns the place of the camera, or the direction from which it is fitted.
fn stand(section: &Section) -> Result<Stand, SceneError> {
    if let Some(eye) = section.point("eye")? {
        let target = section.point("target")?.unwrap_or(DVec3::ZERO);
        if eye == target {
            let expected = "expected two different points";
            let error = section.error("eye", "is where `target` is", expected);
            return Err(match section.has("target") {
                true => section.pointing_at("target", "target is here", error),
                false => error.help("without `target` the camera looks at the origin"),
            });
        }
        return Ok(match section.has("fit") {
            true => Stand::Fitted {
                direction: unit(eye - target),
            },
            false => Stand::Fixed { eye, target },
        });
    }
    let direction = if section.has("azimuth") || section.has("elevation") {
        let elevation = section.angle("elevation", 90.0)?.unwrap_or(0.0);
        let (sin_a, cos_a) = libm::sincos(azimuth(section)?);
        let (sin_e, cos_e) = libm::sincos(elevation);
        DVec3::new(cos_e * sin_a, sin_e, cos_e * cos_a)
    } else {
        let usual = || unit(DVec3::from_array(Scene::DEFAULT_DIRECTION));
        section.direction("direction")?.unwrap_or_else(usual)
    };
    Ok(Stand::Fitted { direction })
}

/// Returns the azimuth in radians; 0 when it is not given.
fn azimuth(section: &Section) -> Result<f64, SceneError> {
    // Beyond some turns the degrees of an angle are lost to rounding.
    Ok(section.angle("azimuth", 36_000.0)?.unwrap_or(0.0))
}

/// Returns the upward direction: the given one, else y, else, in a view along y, the one of a camera tilted there.
fn up(section: &Section, toward_eye: DVec3) -> Result<DVec3, SceneError> {
    match section.direction("up")? {
        Some(up) if toward_eye.cross(up).length() < LEAST_TILT => {
            let expected = "expected a direction across it";
            Err(section.error("up", "is parallel to the line of sight", expected))
        }
        Some(up) => Ok(up),
        None if toward_eye.cross(DVec3::Y).length() >= LEAST_TILT => Ok(DVec3::Y),
        None => {
            let (sin, cos) = libm::sincos(azimuth(section)?);
            Ok(DVec3::new(-sin, 0.0, -cos) * toward_eye.y.signum())
        }
    }
}
