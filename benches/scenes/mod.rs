//! The scenes that are timed: built-in meshes of few and many polygons, of triangles and of n-gons.

use fastphong::camera::Camera;
use fastphong::camera_fit::Fit;
use fastphong::lighting::Light;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::scene::{Clipping, Culling, Encoding, HiddenSurfaces, Interpolation, Object, Scene};
use glam::{DAffine3, DVec3};

/// Name and mesh of each scene.
pub const SCENES: &[(&str, &str)] = &[
    ("sphere-5k", "sphere?polygons=5000&triangles=true"),
    ("sphere-100k", "sphere?polygons=100000&triangles=true"),
    ("knot", "knot"),
    ("prism", "prism"),
];

/// A mesh that fills 90 % of 640 × 480 pixels, seen and lit from the front and from above. Vertex normals are averaged, so
/// that they differ over every polygon, the prism's as well.
pub fn scene(mesh: &str) -> Scene {
    let mesh = builtin(mesh).expect("a built-in mesh");
    let (width, height) = (640, 480);
    let direction = DVec3::new(0.3, 0.5, 1.0);
    let fit = Fit { direction, up: DVec3::Y, fraction: 0.9, fovy: None, aspect: 640.0 / 480.0 };
    let camera = Camera::fit(mesh.positions().iter().map(|p| p.as_dvec3()), &fit).expect("a mesh with vertices");
    Scene {
        width,
        height,
        background: [0.0; 3],
        camera,
        ambient: [1.0; 3],
        lights: vec![Light { direction: DVec3::new(1.0, 1.0, 2.0).normalize(), colour: [1.0; 3] }],
        interpolation: Interpolation::Screen,
        culling: Culling::Back,
        hidden_surfaces: HiddenSurfaces::default(),
        clipping: Clipping::Planes,
        two_sided: false,
        samples: 1,
        encoding: Encoding::Linear,
        objects: vec![Object {
            mesh: mesh.into(),
            transform: DAffine3::IDENTITY,
            material: None,
            normals: NormalSource::Averaged,
        }],
    }
}
