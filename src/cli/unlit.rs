//! Lights that light nothing, and pictures that no light reaches.

use super::shown_frame::ShownFrame;
use super::text::counted;
use fastphong::mesh::orientation::is_inside_closed_surface;
use fastphong::scene::{LightTerm, Place};
use glam::DVec3;

/// The most lights inside surfaces that are named.
const MOST_NAMED: usize = 4;

/// Says which lights stand inside closed surfaces that they cannot light, and why a picture is lit by no light.
pub fn unlit_texts(shown: &ShownFrame) -> Vec<String> {
    let lit = LitObjects::of(shown);
    let mut texts = inside(shown, &lit);
    texts.extend(no_light(shown, &lit));
    texts
}

/// The objects that are seen, and which of them each light falls on.
struct LitObjects {
    lights: usize,
    is_seen: Vec<bool>,
    /// For each object, for each light: true if the light falls on a corner that is drawn.
    is_lit: Vec<bool>,
    /// True if a material that is drawn has ambient light.
    has_ambient: bool,
}

impl LitObjects {
    fn of(shown: &ShownFrame) -> LitObjects {
        let (frame, objects) = (shown.frame, shown.scene.objects.len());
        let lights = frame.light_count();
        let mut lit = LitObjects {
            lights,
            is_seen: vec![false; objects],
            is_lit: vec![false; objects * lights],
            has_ambient: false,
        };
        // Lights of each object that are not known to fall on it: most are at its first polygons.
        let mut open = vec![lights; objects];
        for polygon in frame.polygons() {
            let (object, _) = shown.place(polygon.source);
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
                    // A corner that clipping made has no normal: its light is not known, and is no reason to warn.
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

/// Names lights at positions inside closed surfaces that they do not light.
fn inside(shown: &ShownFrame, lit: &LitObjects) -> Vec<String> {
    let mut found = Vec::new();
    for (light, place) in shown
        .scene
        .lights
        .iter()
        .map(|light| light.place)
        .enumerate()
    {
        let Place::Local(at) = place else {
            continue;
        };
        for (number, object) in shown.scene.objects.iter().enumerate() {
            if !lit.is_seen[number] || lit.is_lit(number, light) {
                continue;
            }
            let in_mesh = object.positions_to_world().inverse().transform_point3(at);
            if is_inside_closed_surface(&object.mesh, in_mesh) {
                let (mesh, [x, y, z]) = (shown.mesh_name(number), at.to_array());
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

/// Says that no light falls on anything that is seen, if there is something to be seen.
fn no_light(shown: &ShownFrame, lit: &LitObjects) -> Option<String> {
    if shown.frame.polygons().is_empty() || lit.is_lit.contains(&true) {
        return None;
    }
    match (lit.lights, lit.has_ambient) {
        // Who asks for ambient light alone gets it.
        (0, true) => None,
        (0, false) => {
            let why = "there is no light, and no ambient light: all that is seen is black";
            Some(why.to_owned())
        }
        (lights, has_ambient) => {
            let lights = match lights {
                1 => "the light adds nothing".to_owned(),
                n => format!("none of the {n} lights adds anything"),
            };
            let why = "surfaces face away from it, or it or they are black";
            let left = match has_ambient {
                true => "only ambient light is drawn",
                false => "there is no ambient light, and all that is seen is black",
            };
            Some(format!("{lights} to what is seen: {why}; {left}"))
        }
    }
}
