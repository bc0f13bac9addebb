//! From the camera of a scene file to the camera of the scene.

use super::check::{Check, is_coordinate, is_position};
use super::diagnostics::SceneError;
use super::value::{Located, Origin};
use super::{CameraSection, SceneFile};
use crate::scene::{Camera, Fit, Projection};
use glam::DVec3;
use std::string::String;
use std::vec::Vec;

/// The least sine of the angle between `up` and the line of sight: below it, rounding decides what is up.
const LEAST_TILT: f64 = 1e-6;

/// A camera whose every value is valid by itself; what depends on the objects is still open.
pub(super) struct Viewpoint {
    stand: Stand,
    up: DVec3,
    half_height: Option<f64>,
    fovy: Option<f64>,
    near: Option<f64>,
    far: Option<f64>,
    fraction: f64,
    /// Where `near` or `far` was given, for errors that need both.
    planes_at: Origin,
    /// Where the place was given, for errors that need the objects.
    stand_at: Origin,
}

enum Stand {
    /// Exactly there.
    Fixed { eye: DVec3, target: DVec3 },
    /// Around the objects, in this direction.
    Fitted { direction: DVec3 },
}

impl Viewpoint {
    pub fn new(section: &CameraSection, check: &Check) -> Result<Self, SceneError> {
        exclusions(section, check)?;
        let half_height = section
            .half_height
            .as_ref()
            .map(|given| check.length(given, "camera.half_height"));
        let half_height = half_height.transpose()?;
        let fovy = section.fovy.as_ref().map(|given| {
            check.number(
                given,
                "camera.fovy",
                |v| (1e-3..=179.999).contains(&v),
                "degrees over 0 and under 180 (0.001 to 179.999)",
            )
        });
        let fovy = fovy.transpose()?;
        let fit = section.fit.as_ref().map(|given| {
            check.number(
                given,
                "camera.fit",
                |v| (1e-3..=100.0).contains(&v),
                "a part of the frame, 0.001 to 100",
            )
        });
        let fit = fit.transpose()?;
        let (near, far) = planes(section, check)?;
        let stand = stand(section, check)?;
        let toward_eye = match stand {
            Stand::Fixed { eye, target } => (eye - target).normalize(),
            Stand::Fitted { direction } => direction,
        };
        let planes_at = section
            .far
            .as_ref()
            .or(section.near.as_ref())
            .map_or(Origin::Program, |v| v.origin.clone());
        let stand_at = section
            .eye
            .as_ref()
            .map_or(Origin::Program, |eye| eye.origin.clone());
        Ok(Viewpoint {
            stand,
            up: up(section, toward_eye, check)?,
            half_height,
            fovy,
            near,
            far,
            fraction: fit.unwrap_or(SceneFile::DEFAULT_FIT),
            planes_at,
            stand_at,
        })
    }

    /// The camera, now that it is known what it looks at.
    pub fn camera(
        &self,
        points: impl Iterator<Item = DVec3> + Clone,
        aspect: f64,
        check: &Check,
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
                    check.scene_error(
                        "the objects have no polygons",
                        "nothing to fit the camera to",
                    )
                })?
            }
        };
        if let Some(half_height) = self.half_height {
            camera.projection = Projection::Orthographic { half_height };
        }
        camera.near = self.near.unwrap_or(camera.near);
        camera.far = self.far.unwrap_or(camera.far);
        if camera.near >= camera.far {
            // One of them was given, the other one is where the objects end.
            let problem = std::format!(
                "leaves nothing between near = {} and far = {}",
                camera.near,
                camera.far
            );
            let key = if self.far.is_some() {
                "camera.far"
            } else {
                "camera.near"
            };
            return Err(check.error(&self.planes_at, key, &problem, "expected near below far"));
        }
        if !is_position(camera.eye) {
            let problem = "puts the eye too far away";
            return Err(check.error(
                &self.stand_at,
                "camera",
                problem,
                "expected coordinates up to 1e15",
            ));
        }
        Ok(camera)
    }

    /// A camera at a given place; the planes, and without a projection the half height, follow from the objects.
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

/// Keys that exclude or need each other.
fn exclusions(section: &CameraSection, check: &Check) -> Result<(), SceneError> {
    if let (Some(half_height), Some(fovy)) = (&section.half_height, &section.fovy) {
        let why = "expected one of them: `half_height` is orthographic, `fovy` is perspective";
        return Err(check.conflict(
            "camera.fovy",
            &fovy.origin,
            "camera.half_height",
            &half_height.origin,
            why,
        ));
    }
    if let (Some(half_height), Some(fit)) = (&section.half_height, &section.fit) {
        let why = "expected one of them: `fit` finds the half height";
        return Err(check.conflict(
            "camera.fit",
            &fit.origin,
            "camera.half_height",
            &half_height.origin,
            why,
        ));
    }
    let turns = [
        (
            "camera.direction",
            section.direction.as_ref().map(|v| &v.origin),
        ),
        (
            "camera.azimuth",
            section.azimuth.as_ref().map(|v| &v.origin),
        ),
        (
            "camera.elevation",
            section.elevation.as_ref().map(|v| &v.origin),
        ),
    ];
    let mut turns = turns.into_iter().filter_map(|(key, at)| Some((key, at?)));
    let Some((key, at)) = turns.next() else {
        return match (&section.target, &section.eye) {
            (Some(target), None) => Err(check.error(
                &target.origin,
                "camera.target",
                "needs `eye`",
                "a fitted camera looks at the middle of the objects",
            )),
            _ => Ok(()),
        };
    };
    let placed = [
        ("camera.eye", section.eye.as_ref().map(|v| &v.origin)),
        ("camera.target", section.target.as_ref().map(|v| &v.origin)),
    ];
    for (place, place_at) in placed {
        if let Some(place_at) = place_at {
            let why = "expected a place (`eye`, `target`) or a direction, not both";
            return Err(check.conflict(key, at, place, place_at, why));
        }
    }
    match turns.next() {
        Some((other, other_at)) if key == "camera.direction" => {
            let why = "expected `direction`, or `azimuth` and `elevation`";
            Err(check.conflict(other, other_at, key, at, why))
        }
        _ => Ok(()),
    }
}

/// The near and far distances that are given.
fn planes(
    section: &CameraSection,
    check: &Check,
) -> Result<(Option<f64>, Option<f64>), SceneError> {
    let near = match (&section.near, &section.fovy) {
        (None, _) => None,
        (Some(near), Some(_)) => {
            let expected = "a number over 0, as the camera is a perspective one";
            Some(check.number(
                near,
                "camera.near",
                |v| v > 0.0 && is_coordinate(v),
                expected,
            )?)
        }
        (Some(near), None) => Some(check.coordinate(near, "camera.near")?),
    };
    let far = section
        .far
        .as_ref()
        .map(|far| check.coordinate(far, "camera.far"))
        .transpose()?;
    if let (Some(given), Some(near), Some(far)) = (&section.far, near, far)
        && far <= near
    {
        let problem = std::format!("is {far}");
        let error = check.error(
            &given.origin,
            "camera.far",
            &problem,
            std::format!("expected more than near = {near}"),
        );
        return Err(match &section.near {
            Some(near) => error.related(&near.origin, "near is here"),
            None => error,
        });
    }
    Ok((near, far))
}

/// The place of the camera, or the direction from which it is fitted.
fn stand(section: &CameraSection, check: &Check) -> Result<Stand, SceneError> {
    if let Some(given) = &section.eye {
        let eye = check.point(given, "camera.eye")?;
        let target = match &section.target {
            Some(target) => check.point(target, "camera.target")?,
            None => DVec3::ZERO,
        };
        let difference = Located {
            value: (eye - target).to_array(),
            origin: given.origin.clone(),
        };
        let Ok(direction) = check.direction(&difference, "camera.eye") else {
            let error = check.error(
                &given.origin,
                "camera.eye",
                "is where `target` is",
                "expected two different points",
            );
            return Err(match &section.target {
                Some(target) => error.related(&target.origin, "target is here"),
                None => error.help("without `target` the camera looks at the origin"),
            });
        };
        return Ok(match section.fit {
            Some(_) => Stand::Fitted { direction },
            None => Stand::Fixed { eye, target },
        });
    }
    if let Some(direction) = &section.direction {
        return Ok(Stand::Fitted {
            direction: check.direction(direction, "camera.direction")?,
        });
    }
    if section.azimuth.is_none() && section.elevation.is_none() {
        return Ok(Stand::Fitted {
            direction: DVec3::from_array(SceneFile::DEFAULT_DIRECTION).normalize(),
        });
    }
    let azimuth = azimuth(section, check)?;
    let elevation = match &section.elevation {
        Some(given) => check
            .number(
                given,
                "camera.elevation",
                |v| v.abs() <= 90.0,
                "degrees between -90 and 90",
            )?
            .to_radians(),
        None => 0.0,
    };
    let (sin_a, cos_a) = libm::sincos(azimuth);
    let (sin_e, cos_e) = libm::sincos(elevation);
    Ok(Stand::Fitted {
        direction: DVec3::new(cos_e * sin_a, sin_e, cos_e * cos_a),
    })
}

/// The azimuth in radians; 0 when it is not given.
fn azimuth(section: &CameraSection, check: &Check) -> Result<f64, SceneError> {
    match &section.azimuth {
        // Beyond some turns the degrees of an angle are lost to rounding.
        Some(given) => Ok(check
            .number(
                given,
                "camera.azimuth",
                |v| v.abs() <= 36_000.0,
                "degrees between -36000 and 36000",
            )?
            .to_radians()),
        None => Ok(0.0),
    }
}

/// The upward direction: the given one, else y, else, in a view along y, the one that a camera tilted there would have.
fn up(section: &CameraSection, toward_eye: DVec3, check: &Check) -> Result<DVec3, SceneError> {
    let Some(given) = &section.up else {
        if toward_eye.cross(DVec3::Y).length() >= LEAST_TILT {
            return Ok(DVec3::Y);
        }
        let (sin, cos) = libm::sincos(azimuth(section, check)?);
        return Ok(DVec3::new(-sin, 0.0, -cos) * toward_eye.y.signum());
    };
    let up = check.direction(given, "camera.up")?;
    if toward_eye.cross(up).length() < LEAST_TILT {
        let expected = "expected a direction across it";
        return Err(check.error(
            &given.origin,
            "camera.up",
            "is parallel to the line of sight",
            expected,
        ));
    }
    Ok(up)
}
