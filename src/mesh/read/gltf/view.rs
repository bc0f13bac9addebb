//! The camera and the lights of a glTF file. A scene made from only this file uses them.

use super::{parse, placed};
use crate::picture::Rgb;
use core::f64::consts::PI;
use glam::{DAffine3, DVec3};
use gltf::camera::Projection;
use gltf::khr_lights_punctual::Kind;
use gltf::{Node, Semantic};
use std::format;
use std::string::String;
use std::vec::Vec;

/// The camera and the lights of a mesh file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FileView {
    /// The first perspective camera.
    pub camera: Option<FileCamera>,
    /// The lights that shine.
    pub lights: Vec<FileLight>,
    /// One sentence for each camera or light that cannot be used, with the reason.
    pub left_out: Vec<String>,
}

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FileCamera {
    pub eye: DVec3,
    pub target: DVec3,
    pub up: DVec3,
    /// The vertical field of view in degrees.
    pub fovy: f64,
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
    let (document, _) = parse(bytes).ok()?;
    let nodes = placed(&document).ok()?;
    let middle = middle(&nodes);
    let mut left_out = Vec::new();
    let mut leave_out = |why: String| {
        if !left_out.contains(&why) {
            left_out.push(why);
        }
    };
    let cameras = nodes
        .iter()
        .filter_map(|(node, placed)| camera(node, placed, middle));
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
    for light in nodes
        .iter()
        .filter_map(|(node, placed)| light(node, placed))
    {
        match light {
            Ok(light) => lights.push(light),
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
fn middle(nodes: &[(Node, DAffine3)]) -> DVec3 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (node, placed) in nodes {
        for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
            let Some(accessor) = primitive.get(&Semantic::Positions) else {
                continue;
            };
            let vector = |value: Option<gltf::json::Value>| -> Option<DVec3> {
                let value = value?;
                let of = |axis: usize| value.get(axis)?.as_f64();
                Some(DVec3::new(of(0)?, of(1)?, of(2)?))
            };
            if let (Some(least), Some(most)) = (vector(accessor.min()), vector(accessor.max())) {
                // Bit `axis` of `corner` picks the upper end along that axis.
                for corner in 0..8 {
                    let pick = |axis: usize| match corner >> axis & 1 {
                        0 => least[axis],
                        _ => most[axis],
                    };
                    let corner = DVec3::new(pick(0), pick(1), pick(2));
                    let corner = placed.transform_point3(corner);
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

/// Returns the perspective camera of a node, or the reason why it cannot be used. It looks along
/// −z, and its target is as far away as the middle of the scene.
fn camera(node: &Node, placed: &DAffine3, middle: DVec3) -> Option<Result<FileCamera, String>> {
    let camera = node.camera()?;
    let Projection::Perspective(lens) = camera.projection() else {
        return None;
    };
    let name = format!("the file's camera {}", camera.index());
    let yfov = lens.yfov();
    if !(yfov > 0.0 && f64::from(yfov) < PI) {
        let expected = "expected an angle over 0 and under 3.14159";
        return Some(Err(format!(
            "{name} is left out: its `yfov` is {yfov}: {expected}"
        )));
    }
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
        fovy: f64::from(yfov).to_degrees(),
    };
    Some(if camera.eye.is_finite() && camera.target.is_finite() {
        Ok(camera)
    } else {
        Err(flat())
    })
}

/// Returns the light of a node, or the reason why it is left out. A light with a direction shines
/// along −z.
///
/// In glTF a white diffuse surface shows 1/π of the light that falls on it; in this crate a light
/// of strength 1 shows it as 1. So intensities are divided by π. Lights that are black or negative
/// are left out.
fn light(node: &Node, placed: &DAffine3) -> Option<Result<FileLight, String>> {
    let light = node.light()?;
    let left_out = |why: String| {
        let index = light.index();
        Some(Err(format!("the file's light {index} is left out: {why}")))
    };
    let toward = match light.kind() {
        Kind::Directional => placed.matrix3.z_axis.try_normalize(),
        Kind::Point | Kind::Spot { .. } => None,
    };
    if toward.is_none() && matches!(light.kind(), Kind::Directional) {
        return left_out("its node flattens its direction".into());
    }
    let strength = f64::from(light.intensity()) / PI;
    let colour = light
        .color()
        .map(|channel| (f64::from(channel) * strength) as f32);
    let place = placed.translation;
    let (intensity, [r, g, b]) = (light.intensity(), light.color());
    let facts = format!("its intensity is {intensity}, its colour {r},{g},{b}");
    let is_sound = |value: f32| value.is_finite() && value >= 0.0;
    if ![intensity, r, g, b].into_iter().chain(colour).all(is_sound) || !place.is_finite() {
        return left_out(format!("{facts}: expected finite numbers from 0 on"));
    }
    if colour == [0.0; 3] {
        return left_out(format!("{facts}, so it does not shine"));
    }
    Some(Ok(FileLight {
        toward,
        place,
        colour,
    }))
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
