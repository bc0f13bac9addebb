//! Warns of lights that light nothing, and of pictures that no light reaches.

use super::drawn_scene::DrawnScene;
use crate::mesh::orientation::is_inside_closed_surface;
use crate::note::{Note, Notes};
use crate::number::counted::counted;
use crate::scene::{LightTerm, Place};
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

/// The visible objects, and which lights fall on them.
struct LitObjects {
    lights: usize,
    is_seen: Vec<bool>,
    /// For each object and each light: true if the light falls on a corner that is drawn.
    is_lit: Vec<bool>,
    /// True if a material that is drawn reflects ambient light.
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
        for polygon in frame.polygons() {
            let (object, _) = drawn.place(polygon.source);
            let lighting = &frame.lightings()[polygon.material as usize];
            lit.is_seen[object] = true;
            lit.has_ambient |= lighting.ambient != [0.0; 3];
            if open[object] == 0 {
                continue;
            }
            let of_object = &mut lit.is_lit[object * lights..][..lights];
            let unknown = lighting.lights.iter().zip(of_object);
            for (light, is_lit) in unknown.filter(|(_, is_lit)| !**is_lit) {
                let mut corners = frame.corners(polygon).iter();
                *is_lit = corners.any(|&corner| {
                    // A corner made by clipping has no normal. Assume that it is lit, so as not to
                    // warn without reason.
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

/// True if light falls on a surface with this normal.
fn falls(light: &LightTerm, normal: [f32; 3], position: [f32; 3]) -> bool {
    let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let toward = match light.place {
        Place::Infinite(direction) => wide(direction),
        Place::Local(at) => wide(at) - wide(position),
    };
    let is_bright = [light.diffuse, light.specular]
        .concat()
        .iter()
        .any(|c| *c > 0.0);
    is_bright && toward.dot(wide(normal)) > 0.0
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
            let why = "surfaces face away, or light or surfaces are black";
            let left = if has_ambient {
                "only ambient light is drawn"
            } else {
                "there is no ambient light, so everything visible is black"
            };
            Some(format!("{lights} anything visible: {why}; {left}"))
        }
    }
}
