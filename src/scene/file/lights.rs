//! `[[light]]`: from a table to a light.

use super::check::Section;
use super::diagnostics::SceneError;
use crate::picture::Rgb;
use crate::scene::{Falloff, Light, Place};
use glam::DVec3;
use std::format;

/// Returns the light that a table describes, light number `number` of the scene, from 1.
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
    let colour = section.channels("colour", f64::INFINITY)?;
    let intensity = section.not_negative("intensity")?.unwrap_or(1.0);
    let colour = colour.unwrap_or([1.0; 3]);
    let colour = colour.map(|channel| (f64::from(channel) * intensity) as f32);
    if colour.iter().all(|channel| channel.is_finite()) {
        return Ok(colour);
    }
    let expected = "expected a finite product with the colour";
    Err(section.error("intensity", &format!("is {intensity}"), expected))
}

/// Returns the falloff, which only a light at a position has.
fn falloff(section: &Section) -> Result<Falloff, SceneError> {
    for key in ["attenuation", "falloff"] {
        if section.has(key) && section.has("direction") {
            let expected = "expected it beside `position`: a light at infinity has no distance";
            let problem = "is given for a light with a `direction`";
            return Err(section.error(key, problem, expected));
        }
    }
    let why = "expected one of them: `attenuation` is a falloff too";
    section.exclude("attenuation", "falloff", why)?;
    Ok(match section.not_negative("attenuation")? {
        Some(k) => Falloff::Attenuation(k as f32),
        None => section.word("falloff"),
    })
}

/// Checks that the light stands at none of `points`, where the direction toward it is undefined. Both are seen from `eye`.
pub(super) fn check_distance(
    section: &Section,
    points: &[DVec3],
    eye: DVec3,
) -> Result<(), SceneError> {
    let Some(light) = section.table.triple("position") else {
        return Ok(());
    };
    // Closer than the rounding of positions in `f32` is the same place. They are rounded relative to the eye, and those of
    // a mesh that lies far from 0 relative to that mesh.
    let is_here = |p: &&DVec3| {
        let from_zero = p.length().max(light.length());
        let from_eye = (**p - eye).length().max((light - eye).length());
        (**p - light).length() <= f64::from(f32::EPSILON) * from_zero.min(from_eye)
    };
    let Some(p) = points.iter().find(is_here) else {
        return Ok(());
    };
    let problem = format!("is at a vertex, ({}, {}, {})", p.x, p.y, p.z);
    let expected =
        "expected a place off the vertices: there the direction toward the light is undefined";
    Err(section.error("position", &problem, expected))
}
