//! The frames and scenes that figures draw, and the calls that draw them.
//!
//! [`frame`] takes polygons in screen space that carry their own normals. [`scene`] puts one mesh
//! before a camera that looks along -z. [`shipped`] loads a scene that comes with the program.

use super::Result;
use alloc::{vec, vec::Vec};
use fastphong::frame::{Frame, FrameBuilder, Vertex, sub_pixel};
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::{Material, MeshBuilder};
use fastphong::picture::encoding::store;
use fastphong::picture::{Encoding, LinearPicture, Picture8};
use fastphong::reference::{self, Model};
use fastphong::scene::input::{load, resolve};
use fastphong::scene::{Camera, Culling, HiddenSurfaces, Light, Lighting, Projection, Scene};
use fastphong::shading::Variant;
use glam::DVec3;

/// A corner of a polygon in screen space.
#[derive(Clone, Copy, Debug)]
pub(super) struct ScreenCorner {
    /// Column and row, in pixels.
    pub position: [f64; 2],
    /// Depth, 0 at the near plane, 1 at the far plane.
    pub depth: f64,
    /// Unit vertex normal.
    pub normal: DVec3,
}

impl ScreenCorner {
    /// Makes a corner half-way between near and far plane.
    pub fn new(position: [f64; 2], normal: DVec3) -> ScreenCorner {
        ScreenCorner {
            position,
            depth: 0.5,
            normal,
        }
    }
}

/// A polygon in screen space.
#[derive(Clone, Debug)]
pub(super) struct ScreenPolygon {
    /// The corners in order.
    pub corners: Vec<ScreenCorner>,
    /// The unit normal of the polygon, for flat shading.
    pub normal: DVec3,
}

impl ScreenPolygon {
    /// Makes a polygon that faces the eye.
    pub fn new(corners: impl Into<Vec<ScreenCorner>>) -> ScreenPolygon {
        ScreenPolygon {
            corners: corners.into(),
            normal: DVec3::Z,
        }
    }

    /// Makes an upright strip from row 0 to row `height`. Each of its two sides has one normal.
    pub fn strip([left, right]: [f64; 2], height: f64, [from, to]: [DVec3; 2]) -> ScreenPolygon {
        ScreenPolygon::new([
            ScreenCorner::new([left, 0.0], from),
            ScreenCorner::new([right, 0.0], to),
            ScreenCorner::new([right, height], to),
            ScreenCorner::new([left, height], from),
        ])
    }

    /// Adds the polygon to a frame, as the polygon at `index`.
    pub fn add(&self, builder: &mut FrameBuilder, material: u32, index: usize) {
        let vertex = |corner: &ScreenCorner| Vertex {
            x: sub_pixel(corner.position[0]),
            y: sub_pixel(corner.position[1]),
            depth: corner.depth,
            inv_w: 1.0,
            normal: corner.normal.as_vec3().to_array(),
            material,
        };
        let corners: Vec<u32> = self
            .corners
            .iter()
            .map(|c| builder.vertex(vertex(c)))
            .collect();
        builder.polygon(&corners, self.normal.as_vec3().to_array(), index as u32);
    }
}

/// Makes a frame of `polygons` of one material under one white light. They are drawn in this order,
/// and nothing hides them.
///
/// # Errors
/// If a coordinate is beyond the guard band, or the size is not allowed.
pub(super) fn frame(
    [width, height]: [u32; 2],
    material: Material,
    light: DVec3,
    polygons: &[ScreenPolygon],
) -> Result<Frame> {
    let mut builder = FrameBuilder::new(width, height);
    builder.hidden_surfaces(HiddenSurfaces::DrawOrder);
    let light = Light::directional(light.normalize(), [1.0; 3]);
    let material = builder.lighting(Lighting::new(&material, [1.0; 3], &[light], DVec3::Z));
    for (index, polygon) in polygons.iter().enumerate() {
        polygon.add(&mut builder, material, index);
    }
    Ok(builder.finish()?)
}

/// Returns a material that reflects all channels alike, from its `k_a`, `k_d`, `k_s` and exponent
/// (L21 2.1).
pub(super) const fn grey(ambient: f32, diffuse: f32, specular: f32, shininess: f32) -> Material {
    Material {
        ambient: [ambient; 3],
        diffuse: [diffuse; 3],
        specular: [specular; 3],
        shininess,
    }
}

/// A dull white surface: its intensity is L · N.
pub(super) const DULL: Material = grey(0.0, 1.0, 0.0, 1.0);

/// Returns the unit vector in the plane of x and z that stands `degrees` to the right of +z.
pub(super) fn toward(degrees: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    DVec3::new(sin, 0.0, cos)
}

/// Returns two unit normals `degrees` apart, symmetric about +z.
pub(super) fn ends(degrees: f64) -> [DVec3; 2] {
    [toward(-degrees / 2.0), toward(degrees / 2.0)]
}

/// Puts a built-in mesh around the origin, seen from +z, under one white light. The camera sees
/// `half_height` of the world above the origin, and as much below.
///
/// # Errors
/// If no built-in mesh matches `mesh`.
pub(super) fn scene(
    mesh: &str,
    material: Material,
    light: DVec3,
    half_height: f64,
    size: [u32; 2],
) -> Result<Scene> {
    let mut scene = fitted(mesh, size)?;
    let (eye, projection) = (5.0 * DVec3::Z, Projection::Orthographic { half_height });
    scene.camera = Camera::looking_at(eye, DVec3::ZERO, projection);
    (scene.camera.near, scene.camera.far) = (1.0, 9.0);
    scene.lights = vec![Light::directional(light.normalize(), [1.0; 3])];
    scene.objects[0].material = Some(material);
    Ok(scene)
}

/// Puts a built-in mesh before a camera that fits it.
///
/// # Errors
/// If no built-in mesh matches `mesh`.
pub(super) fn fitted(mesh: &str, [width, height]: [u32; 2]) -> Result<Scene> {
    let mut scene = Scene::of_mesh(builtin(mesh)?);
    (scene.width, scene.height) = (width, height);
    Ok(scene)
}

/// Puts a mesh of these corners and polygons before a camera, which sees both of its sides. The
/// only light is ambient.
///
/// # Errors
/// If a polygon has the index of a corner that does not exist.
pub(super) fn bare(
    corners: &[DVec3],
    polygons: &[&[u32]],
    camera: Camera,
    [width, height]: [u32; 2],
) -> Result<Scene> {
    let mut builder = MeshBuilder::new(corners.iter().map(|c| c.as_vec3()).collect());
    for polygon in polygons {
        builder.polygon(polygon);
    }
    let mut scene = Scene::new(camera);
    (scene.width, scene.height) = (width, height);
    scene.culling = Culling::None;
    scene.objects = Scene::of_mesh(builder.finish()?).objects;
    Ok(scene)
}

/// Loads a scene that comes with the program, for a picture of this size.
///
/// # Errors
/// If no shipped scene is called `name`.
pub(super) fn shipped(name: &str, [width, height]: [u32; 2]) -> Result<Scene> {
    let mut scene = resolve(&load(name)?)?.scene;
    (scene.width, scene.height) = (width, height);
    Ok(scene)
}

/// Draws a frame by a method.
///
/// # Errors
/// If no method matches `method`, or the method cannot draw the frame.
pub(super) fn draw(frame: &Frame, method: &str) -> Result<LinearPicture> {
    Ok(Variant::parse(method)?.render_linear(frame)?)
}

/// Draws a frame by each of several methods.
///
/// # Errors
/// As [`draw`].
pub(super) fn draw_each<const N: usize>(
    frame: &Frame,
    methods: [&str; N],
) -> Result<[LinearPicture; N]> {
    let pictures = methods
        .iter()
        .map(|method| draw(frame, method))
        .collect::<Result<Vec<_>>>()?;
    Ok(pictures.try_into().expect("a picture by each method"))
}

/// Draws a frame by the Phong reference.
pub(super) fn truth(frame: &Frame) -> LinearPicture {
    reference::render(frame, Model::Phong).to_linear()
}

/// Stores a picture in eight bits a channel, without a transfer function.
pub(super) fn stored(picture: &LinearPicture) -> Picture8 {
    store(picture, Encoding::Linear)
}
