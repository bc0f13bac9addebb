//! Reads `[[light]]`: from a table to a light.

use super::check::Section;
use super::diagnostics::SceneError;
use crate::number::Written;
use crate::picture::Rgb;
use crate::scene::ranges::STRENGTH;
use crate::scene::{Falloff, Light, Place, stands_at};
use glam::DVec3;
use std::format;

/// Returns the light that a table describes. `number` is the light's number in messages, from 1.
pub(super) fn light(section: &Section, number: usize) -> Result<Light, SceneError> {
    let why = "expected one of them: a light is at infinity or at a place";
    section.exclude("position", "direction", why)?;
    let direction = section.direction("direction")?.map(Place::Infinite);
    let place = direction.or(section.point("position")?.map(Place::Local));
    let nowhere = || {
        let problem = format!("light number {number} has neither `direction` nor `position`");
        section.table_error(&problem, "expected one of them in every [[light]]")
    };
    Ok(Light {
        place: place.ok_or_else(nowhere)?,
        colour: colour(section)?,
        falloff: falloff(section)?,
    })
}

/// Returns the colour times the intensity.
fn colour(section: &Section) -> Result<Rgb, SceneError> {
    let colour = section.channels("colour", &STRENGTH)?;
    let intensity = section.strength("intensity")?.unwrap_or(1.0);
    let colour = colour.unwrap_or([1.0; 3]);
    let colour = colour.map(|channel| (f64::from(channel) * intensity) as f32);
    if colour.iter().all(|channel| channel.is_finite()) {
        return Ok(colour);
    }
    let expected = "expected a product with the colour of up to 3.4e38";
    let problem = format!("is {}", Written(intensity));
    Err(section.error("intensity", &problem, expected))
}

/// Returns the falloff, which only a light at a position has.
fn falloff(section: &Section) -> Result<Falloff, SceneError> {
    for key in ["attenuation", "falloff"] {
        if section.has(key) && section.has("direction") {
            let expected = "expected it beside `position`: a light at infinity has no distance";
            let problem = "is set for a light with a `direction`";
            return Err(section.error(key, problem, expected));
        }
    }
    let why = "expected one of them: `attenuation` is a falloff too";
    section.exclude("attenuation", "falloff", why)?;
    Ok(match section.strength("attenuation")? {
        Some(k) => Falloff::Attenuation(k as f32),
        None => section.word("falloff"),
    })
}

/// Refuses a light that stands at one of `points`, where the direction toward it is undefined.
/// `eye` is the camera's eye.
pub(super) fn check_distance(
    section: &Section,
    points: &[DVec3],
    eye: DVec3,
) -> Result<(), SceneError> {
    let Some(light) = section.table.triple("position") else {
        return Ok(());
    };
    let Some(p) = points.iter().find(|point| stands_at(light, **point, eye)) else {
        return Ok(());
    };
    let [x, y, z] = p.to_array().map(Written);
    let problem = format!("is at a vertex, ({x}, {y}, {z})");
    let expected =
        "expected a place off the vertices: there the direction toward the light is undefined";
    Err(section.error("position", &problem, expected))
}
