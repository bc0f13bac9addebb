//! A scene: objects, lights, a camera, and how they are to be drawn.

mod camera;
mod camera_fit;
pub(crate) mod direction;
#[cfg(feature = "io")]
pub mod file;
#[cfg(feature = "io")]
pub mod input;
mod lighting;
mod of_mesh;
#[doc(hidden)]
pub mod orbit;
mod power;
pub(crate) mod ranges;
mod settings;

pub use camera::{Camera, Projection};
pub use camera_fit::{DEPTH_SLACK, Fit};
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
use alloc::vec;
use alloc::vec::Vec;
use glam::{DAffine3, DMat3, DVec3};

/// A mesh somewhere in the world.
#[derive(Clone, Debug)]
pub struct Object {
    /// The shape; may be shared between objects.
    pub mesh: Arc<PolygonMesh>,
    /// Model space, in which the positions of the mesh count from its origin, to world space. Normals follow by the inverse transpose; a mirroring transform keeps the winding
    /// (outside stays outside).
    pub transform: DAffine3,
    /// Replaces the materials of the mesh.
    pub material: Option<Material>,
    /// The source of the vertex normals, and the weight of averages.
    pub normals: NormalRule,
}

impl Object {
    /// Returns the way from [`PolygonMesh::positions`] to world space: the transform, once the origin of the mesh is added.
    pub fn positions_to_world(&self) -> DAffine3 {
        match self.mesh.origin() {
            DVec3::ZERO => self.transform,
            origin => self.transform * DAffine3::from_translation(origin),
        }
    }

    /// Returns the positions in world space that polygons use, each once.
    pub(crate) fn world_points(&self) -> impl Iterator<Item = DVec3> {
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

/// Returns the volume of a unit cube after `linear`, as a share of what its edges would have at right angles; NaN where one of
/// them has no length.
pub(crate) fn volume(linear: DMat3) -> f64 {
    let edges = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
    linear.determinant().abs() / edges
}

/// True if a light at `light` stands at `point` for all that positions in `f32` can tell, where the direction toward it is
/// undefined. Positions are rounded relative to the eye, and those of a mesh that lies far from 0 relative to that mesh.
pub(crate) fn stands_at(light: DVec3, point: DVec3, eye: DVec3) -> bool {
    let from_zero = point.length().max(light.length());
    let from_eye = (point - eye).length().max((light - eye).length());
    (point - light).length() <= f64::from(f32::EPSILON) * from_zero.min(from_eye)
}

/// All that a picture shows.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Pixels per row, 1..=[`Scene::MAX_SIDE`].
    pub width: u32,
    /// Rows, 1..=[`Scene::MAX_SIDE`].
    pub height: u32,
    /// Colour where nothing is drawn, 0..=1.
    pub background: Rgb,
    /// The camera.
    pub camera: Camera,
    /// Ambient intensity `I_a` of each channel.
    pub ambient: Rgb,
    /// Lights; none means ambient light only.
    pub lights: Vec<Light>,
    /// True if the eye is where the camera is, as each point sees it; without it, it is at infinity along the line of
    /// sight, as the lecture assumes (L21 1).
    pub local_viewer: bool,
    /// The cosine that is raised to the exponents.
    pub specular: SpecularModel,
    /// The model that the materials' exponents are meant for; they are converted where it is not [`Scene::specular`].
    pub shininess_for: SpecularModel,
    /// The treatment of highlights where the light is behind the surface.
    pub gate: SpecularGate,
    /// True if `k_a` and `k_d` are multiplied by the vertex colours of meshes that have some, and no
    /// [attributes](crate::mesh::MeshBuilder::attributes): colours are then lit, and interpolated as normals are.
    pub colours: bool,
    /// The variation of attributes over the screen.
    pub interpolation: Interpolation,
    /// The sides that are left out.
    pub culling: Culling,
    /// The search for hidden surfaces.
    pub hidden_surfaces: HiddenSurfaces,
    /// The limits of the view.
    pub clipping: Clipping,
    /// True if polygons seen from behind are lit with negated normals: those whose corners run clockwise on the screen, unless
    /// that contradicts the normals that are given for them. Then these say where the front is.
    pub two_sided: bool,
    /// Samples per pixel along each side, 1, 2, 4 or 8: `samples`² of them are hidden, lit and shaded each on its own, and
    /// their mean in linear light is the pixel. `samples` times a side is at most [`Scene::MAX_SIDE`].
    pub samples: u32,
    /// The storage of values in eight bits.
    pub encoding: Encoding,
    /// The objects, in the order of drawing.
    pub objects: Vec<Object>,
}

impl Scene {
    /// Makes a scene of nothing, seen by `camera` on 640 × 480 pixels under white ambient light; everything else as in a scene file that
    /// says nothing, but without its light. For `Scene { objects, ..Scene::new(camera) }`.
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

    /// The longest side of a picture: 16,384 pixels, as far as a 16-bit pixel coordinate with two guard bits goes.
    pub const MAX_SIDE: u32 = 16_384;
    /// The most lights a scene may have.
    pub const MAX_LIGHTS: usize = 64;
}
