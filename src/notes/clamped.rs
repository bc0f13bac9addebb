//! The warning about light over 1, which is clamped: how much of the picture it affects, and which
//! materials cause it.

use super::drawn_scene::DrawnScene;
use crate::note::{Note, Notes};
use crate::number::counted::counted;
use crate::reference::clamping;
use crate::scene::{Light, LightTerm, Lighting};
use alloc::borrow::ToOwned;
use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// How many materials the warning names at most.
const MOST_NAMED: usize = 3;

/// The weakest unbounded highlight to warn of: a tenth of white is visible.
const LEAST_TOLD: f64 = 0.1;

/// Warns of a frame that is too bright: how much of it is clamped, and why in which materials; or
/// which highlights cover everything that is lit.
pub(super) fn too_bright(drawn: &DrawnScene, notes: &mut Notes) {
    if let Some(text) = clamped_text(drawn) {
        notes.push(Note::warning("light/clamped", text));
    } else if let Some(text) = endless_highlight_text(drawn) {
        notes.push(Note::warning("light/endless-highlight", text));
    }
}

fn clamped_text(drawn: &DrawnScene) -> Option<String> {
    let clamping = clamping(drawn.frame);
    if !clamping.is_notable() {
        return None;
    }
    let share = 100.0 * clamping.share();
    let channels = ["red", "green", "blue"].into_iter().zip(clamping.channels);
    let channels: Vec<&str> = channels
        .filter(|(_, count)| *count > 0)
        .map(|(name, _)| name)
        .collect();
    let channels = match channels.len() {
        3 => "all channels".to_owned(),
        _ => channels.join(" and "),
    };
    let mut materials: Vec<(usize, usize)> = clamping
        .of_materials
        .iter()
        .map(|[_, clamped]| *clamped)
        .enumerate()
        .filter(|(_, clamped)| *clamped > 0)
        .collect();
    materials.sort_by_key(|(_, clamped)| core::cmp::Reverse(*clamped));
    let others = materials.len().saturating_sub(MOST_NAMED);
    materials.truncate(MOST_NAMED);
    let mut why: Vec<String> = materials
        .iter()
        .map(|(material, _)| reason(drawn, *material))
        .collect();
    if others > 0 {
        why.push(format!("{others} more materials"));
    }
    Some(format!(
        "about {share:.0} % of the covered picture is clamped: its light is over 1 in {channels}; {}",
        why.join("; ")
    ))
}

/// Names the materials whose exponent is under 1, so that the highlight covers everything that is
/// lit. This looks wrong even where the light stays under 1.
fn endless_highlight_text(drawn: &DrawnScene) -> Option<String> {
    let lightings = drawn.frame.lightings();
    let is_endless = |material: &u32| {
        let lighting = &lightings[*material as usize];
        lighting.shininess < 1.0 && terms(lighting).2 >= LEAST_TOLD
    };
    let visible = drawn
        .frame
        .polygons()
        .iter()
        .map(|polygon| polygon.material);
    let materials: BTreeSet<u32> = visible.filter(is_endless).collect();
    let names = materials.iter().take(MOST_NAMED);
    let mut names: Vec<String> = names.map(|material| name(drawn, *material)).collect();
    if materials.len() > MOST_NAMED {
        names.push(format!("{} more materials", materials.len() - MOST_NAMED));
    }
    let shininess = lightings[*materials.first()? as usize].shininess;
    Some(format!(
        "an exponent (Ns, shininess) of {shininess} makes a highlight of everything that is lit: {}",
        names.join("; ")
    ))
}

/// Names the material at an index of the frame, and says why its light is over 1.
fn reason(drawn: &DrawnScene, material: usize) -> String {
    let lighting = &drawn.frame.lightings()[material];
    let name = name(drawn, material as u32);
    let (ambient, diffuse, highlight) = terms(lighting);
    let decimal = |x: f64| format!("{}", libm::round(1e3 * x) / 1e3);
    let mut text = format!(
        "{name} reaches {}: ambient {} + diffuse {} + highlight {}",
        decimal(ambient + diffuse + highlight),
        decimal(ambient),
        decimal(diffuse),
        decimal(highlight)
    );
    if lighting.vertex_colours {
        let most = decimal(largest_colour(drawn, material as u32));
        text += &format!(
            ", of which ambient and diffuse are multiplied by vertex colours of up to {most}"
        );
    }
    let shininess = lighting.shininess;
    if shininess < 1.0 && highlight > 0.0 {
        let most = "covers everything that is lit";
        text +=
            &format!(", and with an exponent (Ns, shininess) of {shininess} the highlight {most}");
    }
    let brightest = |light: &Light| light.colour.into_iter().fold(0.0, f32::max);
    let light: f32 = drawn.scene.lights.iter().map(brightest).sum();
    if light > 1.0 {
        let lights = counted(drawn.scene.lights.len(), "light of", "lights of");
        text += &format!(", under {lights} {} in all", decimal(light.into()));
    }
    text
}

/// Returns the largest channel of all vertex colours on a material.
fn largest_colour(drawn: &DrawnScene, material: u32) -> f64 {
    let frame = drawn.frame;
    let polygons = frame.polygons().iter();
    let polygons = polygons.filter(|polygon| polygon.material == material);
    // Corners made by clipping have no vertex colours.
    let corners = polygons.flat_map(|polygon| frame.corners(polygon));
    let corners = corners.filter(|vertex| frame.clip_corner(**vertex).is_none());
    let channels = corners.flat_map(|vertex| frame.colour(*vertex));
    channels.fold(0.0, f32::max).into()
}

/// Returns the ambient, diffuse and specular light of the brightest channel, as if every light hit
/// the surface head-on.
fn terms(lighting: &Lighting) -> (f64, f64, f64) {
    let channel = |i: usize| {
        let sum = |of: fn(&LightTerm) -> [f32; 3]| -> f64 {
            lighting
                .lights
                .iter()
                .map(|light| f64::from(of(light)[i]))
                .sum()
        };
        let ambient = f64::from(lighting.ambient[i]);
        (
            ambient,
            sum(|light| light.diffuse),
            sum(|light| light.specular),
        )
    };
    let total = |(a, d, s): &(f64, f64, f64)| a + d + s;
    let all = [0, 1, 2].map(channel).into_iter();
    let most = all.max_by(|a, b| total(a).total_cmp(&total(b)));
    most.expect("three channels")
}

/// Returns a name for the material at an index of the frame, found through its first polygon: the
/// name in the mesh file, or its object.
fn name(drawn: &DrawnScene, material: u32) -> String {
    let mut polygons = drawn.frame.polygons().iter();
    let Some(polygon) = polygons.find(|polygon| polygon.material == material) else {
        return "a material".to_owned();
    };
    let (object, polygon) = drawn.place(polygon.source);
    let (of_object, mesh) = (&drawn.scene.objects[object], drawn.name(object));
    let own = of_object.mesh.polygon_material(polygon);
    let own = own.filter(|_| of_object.material.is_none());
    match own.and_then(|own| of_object.mesh.material_name(own)) {
        Some(own) => format!("material `{own}` of {mesh}"),
        None if drawn.scene.objects.len() > 1 => {
            format!("the material of object {}, {mesh},", object + 1)
        }
        None => format!("the material of {mesh}"),
    }
}
