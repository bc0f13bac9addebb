//! Warns of lights that light nothing, and of pictures that no light reaches.

use super::drawn_scene::DrawnScene;
use crate::frame::{Frame, Polygon};
use crate::mesh::orientation::is_inside_closed_surface;
use crate::note::{Note, Notes};
use crate::number::counted::counted;
use crate::scene::{Falloff, LightTerm, Place};
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// How many lights inside surfaces the warnings name at most.
const MOST_NAMED: usize = 4;

/// Warns of lights inside closed surfaces that they cannot light, and of a picture that no light
/// reaches.
pub(super) fn unlit(drawn: &DrawnScene, notes: &mut Notes) {
    let lit = LitObjects::of(drawn);
    for text in inside(drawn, &lit) {
        notes.push(Note::warning("light/inside", text));
    }
    if let Some(text) = no_light(drawn, &lit) {
        notes.push(Note::warning("light/none", text));
    }
}

/// The reasons why a light reaches nothing.
const WHY: &str = "surfaces face away, or light or surfaces are black or too dark to show";

/// The visible objects, and which lights fall on them.
struct LitObjects {
    lights: usize,
    is_seen: Vec<bool>,
    /// For each object and each light: true if the light falls on a corner that is drawn.
    is_lit: Vec<bool>,
    /// True if a material that is drawn reflects ambient light that shows.
    has_ambient: bool,
}

impl LitObjects {
    fn of(drawn: &DrawnScene) -> LitObjects {
        let (frame, objects) = (drawn.frame, drawn.scene.objects.len());
        let lights = frame.light_count();
        let mut lit = LitObjects {
            lights,
            is_seen: vec![false; objects],
            is_lit: vec![false; objects * lights],
            has_ambient: false,
        };
        // How many lights of each object are not known to fall on it yet. Most drop out at its
        // first polygons, so that the other polygons are skipped.
        let mut open = vec![lights; objects];
        let least = least_shown(frame);
        for polygon in frame.polygons() {
            let (object, _) = drawn.place(polygon.source);
            let lighting = &frame.lightings()[polygon.material as usize];
            lit.is_seen[object] = true;
            lit.has_ambient |= brightest(lighting.ambient) >= least;
            if open[object] == 0 {
                continue;
            }
            let of_object = &mut lit.is_lit[object * lights..][..lights];
            let unknown = lighting.lights.iter().zip(of_object);
            for (light, is_lit) in unknown.filter(|(_, is_lit)| !**is_lit) {
                let mut corners = frame.corners(polygon).iter();
                *is_lit = strongest(light, frame, polygon) >= least
                    && corners.any(|&corner| {
                        // A corner made by clipping has no normal. Assume that it is lit, so as not
                        // to warn without reason.
                        frame.clip_corner(corner).is_some()
                            || falls(light, frame.normal(corner), frame.position(corner))
                    });
                open[object] -= usize::from(*is_lit);
            }
        }
        lit
    }

    /// True if a light falls on an object.
    fn is_lit(&self, object: usize, light: usize) -> bool {
        self.is_lit[object * self.lights + light]
    }
}

/// Returns the light, in a channel, under which a pixel may be stored as black: half a level,
/// shared by all lights and the ambient light.
fn least_shown(frame: &Frame) -> f64 {
    frame.encoding().decode(0.5 / 255.0) / (frame.light_count() + 1) as f64
}

/// Returns the largest channel of a colour.
fn brightest(colour: [f32; 3]) -> f64 {
    colour.into_iter().fold(0.0, f32::max).into()
}

/// Returns the most light that a light can give a polygon in a channel.
fn strongest(light: &LightTerm, frame: &Frame, polygon: &Polygon) -> f64 {
    let full = brightest(light.diffuse) + brightest(light.specular);
    let corners = frame.corners(polygon);
    let Place::Local(at) = light.place.map(wide) else {
        return full;
    };
    // A corner made by clipping has no position.
    let is_cut = |corner: &u32| frame.clip_corner(*corner).is_some();
    if corners.iter().any(is_cut) {
        return full;
    }
    let places = corners.iter().map(|corner| wide(frame.position(*corner)));
    let low = places.clone().fold(DVec3::INFINITY, DVec3::min);
    let high = places.fold(DVec3::NEG_INFINITY, DVec3::max);
    // No point of the polygon is nearer than its bounding box.
    let square = at.distance_squared(at.clamp(low, high));
    full * match light.falloff {
        Falloff::None => 1.0,
        Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * square),
        Falloff::InverseSquare => 1.0 / square,
        Falloff::Inverse => 1.0 / libm::sqrt(square),
    }
}

/// Converts a vector to double precision.
fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// True if light falls on a surface with this normal.
fn falls(light: &LightTerm, normal: [f32; 3], position: [f32; 3]) -> bool {
    let toward = match light.place {
        Place::Infinite(direction) => wide(direction),
        Place::Local(at) => wide(at) - wide(position),
    };
    toward.dot(wide(normal)) > 0.0
}

/// Returns a warning for each light at a position inside a closed surface that it does not light.
fn inside(drawn: &DrawnScene, lit: &LitObjects) -> Vec<String> {
    let mut found = Vec::new();
    for (light, place) in drawn
        .scene
        .lights
        .iter()
        .map(|light| light.place)
        .enumerate()
    {
        let Place::Local(at) = place else {
            continue;
        };
        for (index, object) in drawn.scene.objects.iter().enumerate() {
            if !lit.is_seen[index] || lit.is_lit(index, light) {
                continue;
            }
            let in_mesh = object.positions_to_world().inverse().transform_point3(at);
            if is_inside_closed_surface(&object.mesh, in_mesh) {
                let (mesh, [x, y, z]) = (drawn.name(index), at.to_array());
                let place = format!("light number {}, at ({x}, {y}, {z}),", light + 1);
                found.push(format!(
                    "{place} stands inside the closed surface of {mesh} and cannot light its outside"
                ));
            }
        }
    }
    found.dedup();
    let others = found.len().saturating_sub(MOST_NAMED);
    found.truncate(MOST_NAMED);
    if others > 0 {
        found.push(
            counted(others, "more surface", "more surfaces")
                + " around a light that cannot light them",
        );
    }
    found
}

/// Returns a warning if polygons are visible but no light falls on them.
fn no_light(drawn: &DrawnScene, lit: &LitObjects) -> Option<String> {
    if drawn.frame.polygons().is_empty() || lit.is_lit.contains(&true) {
        return None;
    }
    match (lit.lights, lit.has_ambient) {
        // A scene with only ambient light is intended.
        (0, true) => None,
        (0, false) => {
            let why = "there is no light, and no ambient light: everything visible is black";
            Some(why.to_owned())
        }
        (lights, has_ambient) => {
            let lights = match lights {
                1 => "the light does not reach".to_owned(),
                n => format!("none of the {n} lights reaches"),
            };
            let left = if has_ambient {
                "only ambient light is drawn"
            } else {
                "there is no ambient light, so everything visible is black"
            };
            Some(format!("{lights} anything visible: {WHY}; {left}"))
        }
    }
}
