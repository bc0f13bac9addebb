//! Scene files: any text gives a scene or one error, a printed scene is read unchanged, and the
//! scene can be drawn.
//!
//! Whatever mesh a file asks for, it gets a built-in one of a few cells.

use fastphong::mesh::builtin::builtin;
use fastphong::raster::Renderer;
use fastphong::scene::file::{SceneFile, UnusableMesh};
use fastphong::shading::METHODS;
use std::path::Path;
use std::sync::Arc;

/// Longer files are skipped, because they only repeat what shorter ones have.
const MOST_BYTES: usize = 1 << 13;

/// Built-in meshes with more polygons would take as long as many other inputs.
const MOST_POLYGONS: usize = 2000;

pub fn run(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    if text.len() > MOST_BYTES {
        return;
    }
    let file = match SceneFile::parse(text, "fuzz.toml") {
        Ok(file) => file,
        Err(error) => {
            assert!(!error.render(false).is_empty());
            return;
        }
    };
    let printed = file.to_toml();
    let again = SceneFile::parse(&printed, "printed.toml")
        .unwrap_or_else(|error| panic!("{}\n{printed}", error.render(false)));
    assert_eq!(file, again, "{printed}");
    let load = |name: &str, _: &Path| {
        // A name with a number of three digits asks for a large mesh.
        let is_large = name
            .split(|c: char| !c.is_ascii_digit())
            .any(|n| n.len() > 2);
        let name = name.strip_prefix("builtin:").filter(|_| !is_large);
        let mesh = builtin(name.unwrap_or("cube"));
        let mesh = mesh.map_err(|error| UnusableMesh::new(error.to_string()))?;
        if mesh.polygon_count() > MOST_POLYGONS {
            Err(UnusableMesh::new("more polygons than are drawn here"))
        } else {
            Ok((Arc::new(mesh), Default::default()))
        }
    };
    let mut scene = match file.resolve(load) {
        Ok(resolved) => resolved.scene,
        Err(error) => {
            assert!(!error.render(false).is_empty());
            return;
        }
    };
    (scene.width, scene.height) = (scene.width.min(12), scene.height.min(9));
    let Ok(frame) = scene.frame() else {
        return;
    };
    for entry in METHODS {
        for renderer in [Renderer::LECTURE, Renderer::fastest()] {
            let variant = entry.variant();
            if variant.plan(&frame, renderer).renderer().is_none() {
                continue; // in integers
            }
            let picture = variant
                .render_linear_with(&frame, renderer)
                .expect("a method for the frame");
            for pixel in picture.pixels() {
                let is_colour = pixel.iter().all(|channel| (0.0..=1.0).contains(channel));
                assert!(is_colour, "{}: {pixel:?}", entry.info.name);
            }
        }
    }
}
