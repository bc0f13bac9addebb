//! The scenes to time: built-in meshes of few and of many polygons, of triangles and of n-gons.

use fastphong::mesh::PolygonMesh;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::scene::{Camera, Fit, Light, Object, Scene};
use glam::DVec3;

/// Name and mesh of each scene.
#[allow(dead_code)] // not every benchmark uses it
pub const SCENES: &[(&str, &str)] = &[
    ("sphere-5k", "sphere?polygons=5000&triangles=true"),
    ("sphere-100k", "sphere?polygons=100000&triangles=true"),
    ("knot", "knot"),
    ("prism", "prism"),
];

/// Name and mesh of the scenes whose projection is timed.
#[allow(dead_code)] // not every benchmark uses it
pub const TRIANGLES: &[(&str, &str)] = &[
    ("sphere-5k", "sphere?polygons=5000&triangles=true"),
    ("sphere-100k", "sphere?polygons=100000&triangles=true"),
    ("sphere-1m", "sphere?polygons=1000000&triangles=true"),
];

/// Name, mesh and count of lights of large scenes, of which only whole frames are timed: with four
/// lights, or with a million triangles.
#[allow(dead_code)] // not every benchmark uses it
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

/// Returns a camera that looks at a mesh from the front and above, so that it fills 90 % of the
/// picture.
pub fn camera(mesh: &PolygonMesh, fovy: Option<f64>) -> Camera {
    let direction = DVec3::new(0.3, 0.5, 1.0);
    let mut fit = Fit::new(direction, 640.0 / 480.0);
    (fit.fraction, fit.fovy) = (0.9, fovy);
    Camera::fit(mesh.positions().iter().map(|p| p.as_dvec3()), &fit).expect("a mesh with vertices")
}

/// Returns the scene of a mesh under one light.
#[allow(dead_code)] // not every benchmark uses it
pub fn scene(mesh: &str) -> Scene {
    lit(mesh, 1)
}

/// Returns the scene of a mesh under up to four lights. The mesh fills 90 % of 640 × 480 pixels,
/// and is seen and lit from the front and above. Vertex normals are averaged, so they vary over
/// every polygon, even the prism's.
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
    let mut object = Object::new(mesh);
    object.normals = NormalSource::Averaged.into();
    let mut scene = Scene::new(camera);
    scene.lights = directions[..lights].iter().copied().map(light).collect();
    scene.objects = vec![object];
    scene
}
