//! The timed scenes: built-in meshes of few and many polygons, of triangles and of n-gons.

use fastphong::mesh::PolygonMesh;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::scene::{Camera, Fit, Light, Object, Scene};
use glam::{DAffine3, DVec3};

/// Name and mesh of each scene.
pub const SCENES: &[(&str, &str)] = &[
    ("sphere-5k", "sphere?polygons=5000&triangles=true"),
    ("sphere-100k", "sphere?polygons=100000&triangles=true"),
    ("knot", "knot"),
    ("prism", "prism"),
];

/// Name and mesh of the scenes whose projection is timed.
#[allow(dead_code)] // not by every benchmark
pub const TRIANGLES: &[(&str, &str)] = &[
    ("sphere-5k", "sphere?polygons=5000&triangles=true"),
    ("sphere-100k", "sphere?polygons=100000&triangles=true"),
    ("sphere-1m", "sphere?polygons=1000000&triangles=true"),
];

/// Name, mesh and number of lights of scenes timed in whole frames only: four lights, a million
/// triangles.
#[allow(dead_code)] // not by every benchmark
pub const LARGE: &[(&str, &str, usize)] = &[
    (
        "sphere-5k-4-lights",
        "sphere?polygons=5000&triangles=true",
        4,
    ),
    (
        "sphere-100k-4-lights",
        "sphere?polygons=100000&triangles=true",
        4,
    ),
    ("sphere-1m", "sphere?polygons=1000000&triangles=true", 1),
    (
        "sphere-1m-4-lights",
        "sphere?polygons=1000000&triangles=true",
        4,
    ),
];

/// Returns a camera in front of and above a mesh that fills 90 % of the picture.
pub fn camera(mesh: &PolygonMesh, fovy: Option<f64>) -> Camera {
    let direction = DVec3::new(0.3, 0.5, 1.0);
    let fit = Fit {
        direction,
        up: DVec3::Y,
        fraction: 0.9,
        fovy,
        aspect: 640.0 / 480.0,
    };
    Camera::fit(mesh.positions().iter().map(|p| p.as_dvec3()), &fit).expect("a mesh with vertices")
}

/// Returns the scene of a mesh under one light.
#[allow(dead_code)] // not by every benchmark
pub fn scene(mesh: &str) -> Scene {
    lit(mesh, 1)
}

/// Returns the scene of a mesh that fills 90 % of 640 × 480 pixels, seen and lit from the front and
/// above, with up to four lights. Vertex normals are averaged, so they vary over every polygon,
/// even the prism's.
pub fn lit(mesh: &str, lights: usize) -> Scene {
    let directions = [
        (1.0, 1.0, 2.0),
        (-1.0, 1.0, 2.0),
        (1.0, -1.0, 2.0),
        (-1.0, -1.0, 2.0),
    ];
    let light = |(x, y, z): (f64, f64, f64)| {
        Light::directional(DVec3::new(x, y, z).normalize(), [1.0 / lights as f32; 3])
    };
    let mesh = builtin(mesh).expect("a built-in mesh");
    let camera = camera(&mesh, None);
    Scene {
        lights: directions[..lights].iter().copied().map(light).collect(),
        objects: vec![Object {
            mesh: mesh.into(),
            transform: DAffine3::IDENTITY,
            material: None,
            normals: NormalSource::Averaged.into(),
        }],
        ..Scene::new(camera)
    }
}
