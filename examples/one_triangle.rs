//! Draws one triangle, from three positions to a picture, without any file: a tour of the library.
//!
//! ```text
//! cargo run --release --example one_triangle > triangle.ppm
//! cargo run --release --example one_triangle slerp-phong > triangle.ppm
//! ```
//!
//! Needs no feature of the crate, so it also runs with `--no-default-features`.

use fastphong::glam::{DAffine3, DVec3, Vec3};
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::mesh::{GivenNormals, Material, MeshBuilder};
use fastphong::picture::Encoding;
use fastphong::scene::{Camera, Light, Object, Projection, Scene};
use fastphong::shading::Variant;
use std::error::Error;
use std::io::Write;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn Error>> {
    // A mesh: positions, and polygons that index them counter-clockwise as seen from outside. The
    // normals lean outward as on a piece of a ball. Without them they would be averaged (L21 3.1),
    // here all equal.
    let positions = vec![
        Vec3::new(-1.0, -0.8, 0.0),
        Vec3::new(1.0, -0.8, 0.0),
        Vec3::new(0.0, 0.9, 0.0),
    ];
    let leaning = positions
        .iter()
        .map(|p| (*p + 1.2 * Vec3::Z).normalize())
        .collect();
    let mut mesh = MeshBuilder::new(positions);
    mesh.polygon(&[0, 1, 2]).normals(GivenNormals {
        values: leaning,
        corners: None,
    });

    // A scene: objects, lights and camera. `Scene::of_mesh` would choose them for a mesh; here they
    // are written out.
    let camera = Camera {
        eye: 4.0 * DVec3::Z,
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection: Projection::Orthographic { half_height: 1.1 },
        near: 1.0,
        far: 10.0,
    };
    let scene = Scene {
        width: 320,
        height: 240,
        background: [0.02, 0.02, 0.03],
        lights: vec![Light::directional(
            DVec3::new(0.3, 0.4, 1.0).normalize(),
            [1.0; 3],
        )],
        encoding: Encoding::Srgb,
        objects: vec![Object {
            mesh: Arc::new(mesh.finish()?),
            transform: DAffine3::IDENTITY,
            material: Some(Material {
                shininess: 60.0,
                ..Material::default()
            }),
            normals: NormalSource::Given.into(),
        }],
        ..Scene::new(camera)
    };

    // A frame: projected, clipped and checked.
    let frame = scene.frame()?;

    // A picture, by the method named in the first argument. A method that is not for such a frame
    // says why.
    let method = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "naive-phong".into());
    let picture = Variant::parse(&method)?.render(&frame)?;

    // A file: a portable pixmap is a header and the bytes. With the feature `io`, `image_file` also
    // writes PNG.
    let mut file = format!("P6\n{} {}\n255\n", picture.width(), picture.height()).into_bytes();
    file.extend(
        picture
            .pixels()
            .iter()
            .flat_map(|[r, g, b, _]| [*r, *g, *b]),
    );
    std::io::stdout().write_all(&file)?;
    Ok(())
}
