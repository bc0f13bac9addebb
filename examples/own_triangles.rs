//! Triangles that your own renderer has projected, put straight into a frame without mesh, camera
//! or scene.
//!
//! ```text
//! cargo run --release --example own_triangles > own_triangles.ppm
//! cargo run --release --example own_triangles gouraud > own_triangles.ppm
//! ```
//!
//! It needs only the feature `alloc`, so it also runs with
//! `-p fastphong --no-default-features --features alloc`. `Variant::draw` draws into your own
//! memory, with SIMD where `Renderer::fastest()` has it, and can test depth against your own depth
//! buffer.

use fastphong::frame::{FrameBuilder, Vertex};
use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::Material;
use fastphong::scene::{Light, Lighting};
use fastphong::shading::Variant;
use std::error::Error;
use std::io::Write;

fn main() -> Result<(), Box<dyn Error>> {
    let mut builder = FrameBuilder::new(320, 240);

    // A material with the light on it. Directions and normals are vectors in one space, here the
    // space of the screen, with x to the right, y up and z toward the eye. They are normalised if
    // they are not unit vectors.
    let light = Light::directional(DVec3::new(-0.4, 0.6, 0.7).normalize(), [0.9; 3]);
    let material = Material {
        shininess: 40.0,
        ..Material::default()
    };
    let lit = builder.lighting(Lighting::new(&material, [1.0; 3], &[light], DVec3::Z));

    // A fan around the pole of a ball. x and y are in pixels from the upper left corner, with y
    // downward. Depth is 0 at the near plane and 1 at the far plane. Under perspective set the
    // frame's interpolation to `Interpolation::Perspective`, call `builder.depth_range`, and pass
    // −1/w as depth and near/w as `inv_w`.
    let mut corner = |normal: Vec3| {
        let place = [160.0 + 110.0 * normal.x, 120.0 - 110.0 * normal.y].map(f64::from);
        let depth = f64::from(0.5 - 0.4 * normal.z);
        builder.vertex(Vertex {
            material: lit,
            ..Vertex::new(place, depth, normal.to_array())
        })
    };
    let pole = corner(Vec3::Z);
    let rim: Vec<u32> = (0..8)
        .map(|i| std::f32::consts::FRAC_PI_4 * i as f32)
        .map(|angle| corner(Vec3::new(angle.cos(), angle.sin(), 0.3).normalize()))
        .collect();

    // Triangles in drawing order, each with a normal for flat shading. They may wind either way,
    // because you cull. The last argument is an id that you choose;
    // `fastphong render --aov polygon` shows it.
    for (i, &a) in rim.iter().enumerate() {
        let b = rim[(i + 1) % rim.len()];
        let middle = std::f32::consts::FRAC_PI_4 * (i as f32 + 0.5);
        let facet = Vec3::new(middle.cos(), middle.sin(), 1.2).normalize();
        builder.polygon(&[pole, a, b], facet.to_array(), i as u32);
    }

    // `finish` checks everything once. After it, drawing fails only if the method cannot draw this
    // frame.
    let frame = builder.finish()?;
    let method = std::env::args().nth(1);
    let picture = Variant::parse(method.as_deref().unwrap_or("phong-rsqrt"))?.render(&frame)?;

    let mut file = format!("P6\n{} {}\n255\n", picture.width(), picture.height()).into_bytes();
    file.extend(picture.pixels().iter().flat_map(|[r, g, b, _]| [r, g, b]));
    std::io::stdout().write_all(&file)?;
    Ok(())
}
