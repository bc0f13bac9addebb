//! Triangles that a renderer of your own has projected: straight into a frame, without mesh, camera or scene.
//!
//! ```text
//! cargo run --release --example own_triangles > own_triangles.ppm
//! cargo run --release --example own_triangles gouraud > own_triangles.ppm
//! ```
//!
//! Needs no feature of the crate: it also runs with `--no-default-features`, as on a machine without an operating system.
//! `Variant::draw` draws into memory of yours, on SIMD where `Renderer::fastest()` has it, and beside a depth buffer of yours.

use fastphong::frame::{FrameBuilder, Vertex, sub_pixel};
use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::Material;
use fastphong::scene::{Light, Lighting};
use fastphong::shading::Variant;
use std::error::Error;
use std::io::Write;

fn main() -> Result<(), Box<dyn Error>> {
    let mut builder = FrameBuilder::new(320, 240);

    // A material with the light on it: directions and normals are vectors of one space, here that of the screen, with x to
    // the right, y up and z toward the eye. Those that are no unit vectors become such.
    let light = Light::directional(DVec3::new(-0.4, 0.6, 0.7).normalize(), [0.9; 3]);
    let material = Material {
        shininess: 40.0,
        ..Material::default()
    };
    let lit = builder.lighting(Lighting::new(&material, [1.0; 3], &[light], DVec3::Z));

    // A fan around the pole of a ball. Columns and rows are in pixels, downward from the upper left corner; depth is 0 at
    // the near plane and 1 at the far plane. Under perspective it is −1/w after `builder.depth_range`, `inv_w` is near/w, and
    // the frame's interpolation `Interpolation::Perspective`.
    let mut corner = |normal: Vec3| {
        builder.vertex(Vertex {
            x: sub_pixel(160.0 + 110.0 * normal.x),
            y: sub_pixel(120.0 - 110.0 * normal.y),
            depth: f64::from(0.5 - 0.4 * normal.z),
            inv_w: 1.0,
            normal: normal.to_array(),
            material: lit,
        })
    };
    let pole = corner(Vec3::Z);
    let rim: Vec<u32> = (0..8)
        .map(|i| std::f32::consts::FRAC_PI_4 * i as f32)
        .map(|angle| corner(Vec3::new(angle.cos(), angle.sin(), 0.3).normalize()))
        .collect();

    // Triangles in drawing order, with their own normals for flat shading. Winding is free: culling is yours. The last
    // number is yours too; `fastphong render --aov polygon` shows it.
    for (i, &a) in rim.iter().enumerate() {
        let b = rim[(i + 1) % rim.len()];
        let middle = std::f32::consts::FRAC_PI_4 * (i as f32 + 0.5);
        let facet = Vec3::new(middle.cos(), middle.sin(), 1.2).normalize();
        builder.polygon(&[pole, a, b], facet.to_array(), i as u32);
    }

    // Checked once; from here on nothing fails but a method that is not for such a frame.
    let frame = builder.finish()?;
    let method = std::env::args().nth(1);
    let picture = Variant::parse(method.as_deref().unwrap_or("phong-rsqrt"))?.render(&frame)?;

    let mut file = format!("P6\n{} {}\n255\n", picture.width(), picture.height()).into_bytes();
    file.extend(picture.pixels().iter().flat_map(|[r, g, b, _]| [r, g, b]));
    std::io::stdout().write_all(&file)?;
    Ok(())
}
