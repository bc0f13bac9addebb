//! Scenes: objects, lights, a camera, and how to draw them.
//!
//! [`Scene::of_mesh`] chooses camera, light and material for one mesh. [`Scene::new`] starts with a
//! camera only. All fields of a scene are public, and [`Scene::frame`] checks them.
//!
//! ```
//! use fastphong::glam::{DAffine3, DVec3};
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::scene::{Camera, Falloff, Light, Object, Projection, Scene};
//!
//! let eye = DVec3::new(0.0, 1.0, 6.0);
//! let mut scene = Scene::new(Camera::looking_at(eye, DVec3::ZERO, Projection::Perspective { fovy: 40.0 }));
//! scene.lights.push(Light::directional(DVec3::Z, [0.5; 3]));
//! let lamp = Light::positional(DVec3::new(2.0, 3.0, 1.0), [5.0; 3]);
//! scene.lights.push(lamp.with_falloff(Falloff::InverseSquare));
//! let mut torus = Object::new(builtin("torus")?);
//! torus.transform = DAffine3::from_rotation_x(0.5);
//! scene.objects.push(torus);
//! assert_eq!(scene.frame()?.light_count(), 2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod camera;
mod camera_fit;
pub(crate) mod direction;
#[cfg(feature = "io")]
pub mod file;
#[cfg(feature = "io")]
pub mod input;
#[cfg(feature = "io")]
mod light_rig;
mod lighting;
mod of_mesh;
#[cfg(feature = "io")]
pub mod open;
#[doc(hidden)]
pub mod orbit;
mod power;
pub(crate) mod ranges;
mod settings;

pub use camera::{Camera, Projection};
pub use camera_fit::Fit;
pub use lighting::{Falloff, Light, LightTerm, Lighting, Place, SpecularGate, SpecularModel};
pub use power::Power;
pub use settings::{
    Clipping, Culling, DepthBits, DepthBuffer, DepthSource, HiddenSurfaces, Interpolation,
    PainterKey,
};

use crate::mesh::vertex_normals::NormalRule;
use crate::mesh::{Material, PolygonMesh};
use crate::picture::{Encoding, Rgb};
use crate::sync::Arc;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DAffine3, DMat3, DVec3};

/// A mesh, placed in the world.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Object {
    /// The name for notes: the mesh file's, `builtin:cube`, or empty.
    pub name: String,
    /// The shape. Objects may share it.
    pub mesh: Arc<PolygonMesh>,
    /// The transform from model space to world space. The positions of the mesh are relative to its
    /// origin. Normals are transformed by the inverse transpose. A mirroring transform keeps the
    /// winding (outside stays outside).
    pub transform: DAffine3,
    /// Replaces the materials of the mesh, if present.
    pub material: Option<Material>,
    /// Where the vertex normals come from, and how averages are weighted.
    pub normals: NormalRule,
}

impl Object {
    /// Places `mesh` at the origin of the world, in its own materials (the default one for polygons
    /// without any), with vertex normals by [`PolygonMesh::normal_rule`].
    pub fn new(mesh: impl Into<Arc<PolygonMesh>>) -> Object {
        let mesh = mesh.into();
        Object {
            name: String::new(),
            normals: mesh.normal_rule(),
            mesh,
            transform: DAffine3::IDENTITY,
            material: None,
        }
    }

    /// Returns the transform from [`PolygonMesh::positions`] to world space: `transform` after the
    /// origin of the mesh is added.
    pub fn positions_to_world(&self) -> DAffine3 {
        match self.mesh.origin() {
            DVec3::ZERO => self.transform,
            origin => self.transform * DAffine3::from_translation(origin),
        }
    }

    /// Returns the world positions that polygons use, each once.
    pub fn world_points(&self) -> impl Iterator<Item = DVec3> {
        let mesh = &self.mesh;
        let mut used = vec![false; mesh.positions().len()];
        for &corner in mesh.corners() {
            used[corner as usize] = true;
        }
        let points = mesh.positions().iter().zip(used);
        let to_world = self.positions_to_world();
        points
            .filter(|(_, used)| *used)
            .map(move |(p, _)| to_world.transform_point3(p.as_dvec3()))
    }
}

/// Returns the volume of a unit cube after `linear`, divided by the volume of a box with the same
/// edges at right angles. Returns NaN if an edge has no length.
pub(crate) fn volume(linear: DMat3) -> f64 {
    let edges = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
    linear.determinant().abs() / edges
}

/// True if a light at `light` cannot be told from `point` by positions in `f32`. The direction
/// toward it is then undefined. Positions are rounded relative to the eye, and in a mesh far from 0
/// relative to that mesh.
pub(crate) fn stands_at(light: DVec3, point: DVec3, eye: DVec3) -> bool {
    let from_zero = point.length().max(light.length());
    let from_eye = (point - eye).length().max((light - eye).length());
    (point - light).length() <= f64::from(f32::EPSILON) * from_zero.min(from_eye)
}

/// Everything that a picture shows.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Scene {
    /// Pixels per row, 1..=[`Scene::MAX_SIDE`].
    pub width: u32,
    /// Rows, 1..=[`Scene::MAX_SIDE`].
    pub height: u32,
    /// The colour where nothing is drawn, 0..=1.
    pub background: Rgb,
    /// The camera.
    pub camera: Camera,
    /// The ambient intensity `I_a` of each channel.
    pub ambient: Rgb,
    /// The lights. Without any, there is only ambient light.
    pub lights: Vec<Light>,
    /// True if highlights are seen from the camera's position. False if the eye is at infinity
    /// along the line of sight, as the lecture assumes (L21 1).
    pub local_viewer: bool,
    /// Which cosine is raised to the exponents.
    pub specular: SpecularModel,
    /// The model for which the materials' exponents were chosen. They are converted if it is not
    /// [`Scene::specular`].
    pub shininess_for: SpecularModel,
    /// What happens to highlights where the light is behind the surface.
    pub gate: SpecularGate,
    /// True if the vertex colours of meshes multiply `k_a` and `k_d`. They are interpolated as
    /// normals are. Meshes with [attributes](crate::mesh::MeshBuilder::attributes) are excepted.
    pub colours: bool,
    /// How attributes vary over the screen.
    pub interpolation: Interpolation,
    /// Which sides of polygons are left out.
    pub culling: Culling,
    /// How hidden polygons are kept out of the picture.
    pub hidden_surfaces: HiddenSurfaces,
    /// How polygons are limited to the view.
    pub clipping: Clipping,
    /// True if polygons seen from behind are lit with negated normals. These are the polygons whose
    /// corners run clockwise on the screen, unless normals that the mesh states contradict that:
    /// these normals then say where the front is.
    pub two_sided: bool,
    /// Samples per pixel along each side: 1, 2, 4 or 8. Each of the `samples`² samples is hidden,
    /// lit and shaded separately, and the pixel is their mean in linear light. `samples` times a
    /// side is at most [`Scene::MAX_SIDE`].
    pub samples: u32,
    /// How intensities are stored in eight bits.
    pub encoding: Encoding,
    /// The objects, in drawing order.
    pub objects: Vec<Object>,
}

impl Scene {
    /// Makes a scene without objects and lights, seen by `camera` on 640 × 480 pixels under white
    /// ambient light. Everything else is as in a scene file that states nothing.
    pub fn new(camera: Camera) -> Scene {
        Scene {
            width: 640,
            height: 480,
            background: [0.0; 3],
            camera,
            ambient: [1.0; 3],
            lights: Vec::new(),
            local_viewer: false,
            specular: SpecularModel::Phong,
            shininess_for: SpecularModel::Phong,
            gate: SpecularGate::Gated,
            colours: false,
            interpolation: Interpolation::Screen,
            culling: Culling::Back,
            hidden_surfaces: HiddenSurfaces::default(),
            clipping: Clipping::Planes,
            two_sided: false,
            samples: 1,
            encoding: Encoding::Linear,
            objects: Vec::new(),
        }
    }

    /// The longest side of a picture, 16,384 pixels. A 16-bit pixel coordinate with two guard bits
    /// reaches this far.
    pub const MAX_SIDE: u32 = 16_384;
    /// The largest count of lights in a scene.
    pub const MAX_LIGHTS: usize = 64;

    /// Returns the world positions that polygons use, for each object each once. A fitted camera
    /// depends on nothing else.
    pub fn world_points(&self) -> Vec<DVec3> {
        self.objects.iter().flat_map(Object::world_points).collect()
    }
}
