//! Draws one triangle, from three positions to a picture, without reading a file: a tour of the
//! library.
//!
//! ```text
//! cargo run --release --example one_triangle > triangle.ppm
//! cargo run --release --example one_triangle slerp-phong > triangle.ppm
//! ```
//!
//! It needs only the feature `alloc`, so it also runs with
//! `-p fastphong --no-default-features --features alloc`.

use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::mesh::{GivenNormals, Material, MeshBuilder};
use fastphong::picture::Encoding;
use fastphong::scene::{Camera, Light, Object, Projection, Scene};
use fastphong::shading::Variant;
use std::error::Error;
use std::io::Write;

fn main() -> Result<(), Box<dyn Error>> {
    // A mesh: positions, and polygons that index them counter-clockwise as seen from outside. Its
    // normals lean outward like those of a ball. Without them the normals would be averaged (L21
    // 3.1), and here they would all be equal.
    let positions = vec![
        Vec3::new(-1.0, -0.8, 0.0),
        Vec3::new(1.0, -0.8, 0.0),
        Vec3::new(0.0, 0.9, 0.0),
    ];
    let leaning: Vec<Vec3> = positions
        .iter()
        .map(|p| (*p + 1.2 * Vec3::Z).normalize())
        .collect();
    let mut mesh = MeshBuilder::new(positions);
    mesh.polygon(&[0, 1, 2])
        .normals(GivenNormals::by_vertex(leaning));

    // A scene: objects, lights and camera. `Scene::of_mesh` would choose lights and camera for a
    // mesh; here they are written out.
    let projection = Projection::Orthographic { half_height: 1.1 };
    let mut camera = Camera::looking_at(4.0 * DVec3::Z, DVec3::ZERO, projection);
    (camera.near, camera.far) = (1.0, 10.0);
    let mut triangle = Object::new(mesh.finish()?);
    triangle.normals = NormalSource::Given.into();
    triangle.material = Some(Material {
        shininess: 60.0,
        ..Material::default()
    });
    let mut scene = Scene::new(camera);
    (scene.width, scene.height) = (320, 240);
    scene.background = [0.02, 0.02, 0.03];
    scene.encoding = Encoding::Srgb;
    let toward_light = DVec3::new(0.3, 0.4, 1.0).normalize();
    scene
        .lights
        .push(Light::directional(toward_light, [1.0; 3]));
    scene.objects.push(triangle);

    // A frame: projected, clipped and checked.
    let frame = scene.frame()?;

    // A picture, by the method named in the first argument. A method that cannot draw this frame
    // returns an error that says why.
    let method = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "naive-phong".into());
    let picture = Variant::parse(&method)?.render(&frame)?;

    // A file: a portable pixmap is a header and the bytes. With the feature `io`, `image_file`
    // writes PNG, too.
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
