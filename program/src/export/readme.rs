//! The text that names the files and the conventions.

use alloc::format;
use alloc::string::String;
use fastphong::picture::Encoding;
use fastphong::scene::{Scene, SpecularModel};

/// Returns the text.
pub fn text(scene: &Scene, name: &str, made: &str) -> String {
    let (width, height) = (scene.width, scene.height);
    let r = match scene.specular {
        SpecularModel::Phong => "R",
        SpecularModel::Blinn => "H",
    };
    let level = match scene.encoding {
        Encoding::Linear => "round(255 c), with c clamped to 0..1",
        Encoding::Srgb => "round(255 sRGB(c)), with c clamped to 0..1",
    };
    format!(
        "{made}

mesh.obj      all objects in world space: v, vt (without meaning), vn, f v/vt/vn, usemtl
mesh.mtl      their materials: Ka Kd Ks, and Ns, the exponent for the scene's highlight
scene.json    camera, lights, materials and rules; \"meaning\" explains each value
scene.h       the same for C and C++: arrays scene_..., macros SCENE_...
scene.py      the same for Python: from scene import *
points.csv    ten pixels: N, L, V, {r}, the three terms and the stored level, for each light
expected.png  the right picture, {width} x {height} pixels

Matrices are row-major and multiply columns: clip = projection view (x, y, z, 1).
They follow OpenGL: the camera looks along -z, y is up, clip z goes from -w to w.
Pixels count from the top left: row 0 is the top one, and its centre is at y = 0.5.
Front faces run counter-clockwise. Normals and directions of lights are unit vectors.
light = ambient ka + sum over lights of colour (kd max(L.N, 0) + ks cosine^n)
level = {level}

Compare numbers first: print yours at a pixel of points.csv. Then ask about the picture:
  fastphong diagnose mine.png {name}
  fastphong diff expected.png mine.png
A pixel on an edge may differ: fastphong rounds corners to 1/256 pixel.
"
    )
}
