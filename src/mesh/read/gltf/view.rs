//! The camera and the lights of a glTF file. A scene made from only this file uses them.

use super::container;
use super::document::{self, Document, numbers, whole};
use super::nodes::{Placed, placed};
use crate::picture::Rgb;
use core::f64::consts::PI;
use glam::DVec3;
use serde_json::Value;
use std::format;
use std::string::String;
use std::vec::Vec;

/// The camera and the lights of a mesh file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FileView {
    /// The first camera that can be used.
    pub camera: Option<FileCamera>,
    /// The lights that shine.
    pub lights: Vec<FileLight>,
    /// One sentence for each kind of camera or light that cannot be used as the file means it.
    pub left_out: Vec<String>,
}

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FileCamera {
    pub eye: DVec3,
    pub target: DVec3,
    pub up: DVec3,
    pub lens: FileLens,
}

/// What a camera shows from bottom to top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FileLens {
    /// A perspective projection's vertical field of view in degrees.
    Fovy(f64),
    /// Half the height of an orthographic projection.
    HalfHeight(f64),
}

/// A light at a position or in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FileLight {
    /// The unit vector toward a light at infinity. `None` for a light at `place`, whose strength
    /// falls off with the square of the distance.
    pub toward: Option<DVec3>,
    pub place: DVec3,
    pub colour: Rgb,
}

/// Returns the camera and the lights of the glTF file `bytes`; `None` if it has neither or is no
/// glTF file.
pub(crate) fn view(bytes: &[u8]) -> Option<FileView> {
    let file = container::open(bytes).ok()?;
    let document = document::parse(file.json, file.is_glb).ok()?;
    let nodes = placed(&document).ok()?;
    let middle = middle(&document, &nodes);
    let mut left_out = Vec::new();
    let mut leave_out = |why: String| {
        if !left_out.contains(&why) {
            left_out.push(why);
        }
    };
    let cameras = nodes
        .iter()
        .filter_map(|placed| camera(&document, placed, middle));
    let mut used = None;
    for camera in cameras {
        match camera {
            Ok(camera) => {
                used = Some(camera);
                break;
            }
            Err(why) => leave_out(why),
        }
    }
    let mut lights = Vec::new();
    for light in nodes.iter().filter_map(|placed| light(&document, placed)) {
        match light {
            Ok((light, is_spot)) => {
                lights.push(light);
                if is_spot {
                    leave_out("spot lights of the file shine all around".into());
                }
            }
            Err(why) => leave_out(why),
        }
    }
    scale(&mut lights, middle);
    let view = FileView {
        camera: used,
        lights,
        left_out,
    };
    (view != FileView::default()).then_some(view)
}

/// Returns the middle of the box around all meshes. The accessors of their positions state the
/// boxes.
fn middle(document: &Document, nodes: &[Placed]) -> DVec3 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for placed in nodes.iter().filter(|placed| placed.is_visible) {
        let mesh = placed.node.mesh.and_then(|mesh| document.meshes.get(mesh));
        let primitives = mesh.iter().flat_map(|mesh| &mesh.primitives);
        let positions = primitives.filter_map(|primitive| primitive.attributes.get("POSITION"));
        for accessor in positions.filter_map(|index| document.accessors.get(*index)) {
            let vector = |value: &Value| numbers(value).map(DVec3::from_array);
            if let (Some(least), Some(most)) = (vector(&accessor.min), vector(&accessor.max)) {
                // Bit `axis` of `corner` picks the upper end along that axis.
                for corner in 0..8 {
                    let pick = |axis: usize| match corner >> axis & 1 {
                        0 => least[axis],
                        _ => most[axis],
                    };
                    let corner = DVec3::new(pick(0), pick(1), pick(2));
                    let corner = placed.world.transform_point3(corner);
                    (low, high) = (low.min(corner), high.max(corner));
                }
            }
        }
    }
    if low.is_finite() && high.is_finite() {
        0.5 * (low + high)
    } else {
        DVec3::ZERO
    }
}

/// Returns the camera of a node, or the reason why it cannot be used. It looks along
/// −z, and its target is as far away as the middle of the scene.
fn camera(
    document: &Document,
    placed: &Placed,
    middle: DVec3,
) -> Option<Result<FileCamera, String>> {
    let index = placed.node.camera?;
    let name = format!("the file's camera {index}");
    let left_out = |why: String| Some(Err(format!("{name} is left out: {why}")));
    let Some(camera) = document.cameras.get(index) else {
        return left_out("there is none".into());
    };
    let (lens, size, expected) = match camera["type"].as_str() {
        Some("orthographic") => ("orthographic", "ymag", "a number over 0"),
        _ => ("perspective", "yfov", "an angle over 0 and under 3.14159"),
    };
    let value = &camera[lens][size];
    let lens = match (value.as_f64(), size) {
        (Some(half), "ymag") if half > 0.0 => FileLens::HalfHeight(half),
        (Some(angle), "yfov") if angle > 0.0 && angle < PI => {
            // In `f32`, as files state it.
            FileLens::Fovy(f64::from(angle as f32).to_degrees())
        }
        _ => return left_out(format!("its `{size}` is {value}: expected {expected}")),
    };
    let placed = placed.world;
    let flat = || format!("{name} is left out: its node flattens it");
    let eye = placed.translation;
    let axis = |axis: DVec3| axis.try_normalize();
    let (Some(back), Some(up)) = (axis(placed.matrix3.z_axis), axis(placed.matrix3.y_axis)) else {
        return Some(Err(flat()));
    };
    let forward = -back;
    let distance = (middle - eye).length().max(1e-3 * eye.length());
    let distance = if distance > 0.0 { distance } else { 1.0 };
    let camera = FileCamera {
        eye,
        target: eye + distance * forward,
        up,
        lens,
    };
    Some(if camera.eye.is_finite() && camera.target.is_finite() {
        Ok(camera)
    } else {
        Err(flat())
    })
}

/// Returns the light of a node and if it is a spot light, or the reason why it is left out. A light
/// with a direction shines along −z.
///
/// In glTF a white diffuse surface shows 1/π of the light that falls on it; in this crate a light
/// of strength 1 shows it as 1. So intensities are divided by π. Lights that are black or negative
/// are left out.
fn light(document: &Document, placed: &Placed) -> Option<Result<(FileLight, bool), String>> {
    const LIGHTS: &str = "KHR_lights_punctual";
    let index = whole(&placed.node.extensions[LIGHTS]["light"])?;
    let left_out = |why: String| Some(Err(format!("the file's light {index} is left out: {why}")));
    let Some(light) = document.extensions[LIGHTS]["lights"].get(index) else {
        return left_out("there is none".into());
    };
    let placed = placed.world;
    let kind = &light["type"];
    let toward = match kind.as_str() {
        Some("directional") => {
            let toward = placed.matrix3.z_axis.try_normalize();
            if toward.is_none() {
                return left_out("its node flattens its direction".into());
            }
            toward
        }
        Some("point" | "spot") => None,
        _ => {
            let expected = "expected \"directional\", \"point\" or \"spot\"";
            return left_out(format!("its `type` is {kind}: {expected}"));
        }
    };
    let (intensity, colour) = (&light["intensity"], &light["color"]);
    if !(intensity.is_null() || intensity.is_number()) {
        return left_out(format!("its `intensity` is {intensity}: expected a number"));
    }
    if !(colour.is_null() || numbers::<3>(colour).is_some()) {
        return left_out(format!("its `color` is {colour}: expected three numbers"));
    }
    let intensity = intensity.as_f64().unwrap_or(1.0) as f32;
    let [r, g, b] = numbers(colour).unwrap_or([1.0; 3]).map(|c| c as f32);
    let strength = f64::from(intensity) / PI;
    let colour = [r, g, b].map(|channel| (f64::from(channel) * strength) as f32);
    let place = placed.translation;
    let facts = format!("its intensity is {intensity}, its colour {r},{g},{b}");
    let is_sound = |value: f32| value.is_finite() && value >= 0.0;
    if ![intensity, r, g, b].into_iter().chain(colour).all(is_sound) || !place.is_finite() {
        return left_out(format!("{facts}: expected finite numbers from 0 on"));
    }
    if colour == [0.0; 3] {
        return left_out(format!("{facts}, so it does not shine"));
    }
    let light = FileLight {
        toward,
        place,
        colour,
    };
    Some(Ok((light, kind == "spot")))
}

/// Scales all lights down by one factor if they sum to more than 1 at the middle of the scene. A
/// file states candela and lux, but not the exposure of the camera that they are meant for.
fn scale(lights: &mut [FileLight], middle: DVec3) {
    let at_middle = |light: &FileLight| {
        let most = f64::from(light.colour.iter().fold(0.0, |most: f32, c| most.max(*c)));
        match light.toward {
            Some(_) => most,
            None => {
                most / (light.place - middle)
                    .length_squared()
                    .max(f64::MIN_POSITIVE)
            }
        }
    };
    let sum: f64 = lights.iter().map(at_middle).sum();
    if sum > 1.0 && sum.is_finite() {
        for light in lights {
            light.colour = light
                .colour
                .map(|channel| (f64::from(channel) / sum) as f32);
        }
    }
}
