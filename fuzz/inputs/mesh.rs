//! Mesh files of every format: any bytes give a mesh or one error, reading them again gives an
//! equal result, and the mesh can be drawn.

use fastphong::mesh::PolygonMesh;
use fastphong::mesh::read::{ReadError, parse_mesh};
use fastphong::mesh::vertex_normals::{NormalSource, vertex_normals};
use fastphong::raster::Renderer;
use fastphong::scene::Scene;
use fastphong::shading::METHODS;
use std::io::ErrorKind;

/// Longer files are skipped, because they only repeat what shorter ones have.
pub const MOST_BYTES: usize = 1 << 14;

/// Meshes with more corners are read but not drawn.
const MOST_CORNERS: usize = 2000;

/// Reads `bytes` twice, as a file that ends in `ending`, and draws the mesh.
#[allow(dead_code)] // the target `obj` has its own
pub fn run(ending: &str, bytes: &[u8]) {
    if bytes.len() > MOST_BYTES {
        return;
    }
    let read = || {
        let none = |_: &str| Err(ErrorKind::NotFound.into());
        parse_mesh(format!("fuzz.{ending}"), bytes, none)
    };
    match (read(), read()) {
        (Ok(loaded), Ok(again)) => {
            assert_eq!(loaded.mesh, again.mesh);
            for note in &loaded.notes {
                let text = note.to_string();
                assert!(is_one_line(&text), "{text:?}");
            }
            draw(loaded.mesh);
        }
        (Err(error), Err(again)) => {
            assert_eq!(error, again);
            check_message(&error);
        }
        _ => panic!("read and refused"),
    }
}

/// Draws a mesh by all methods that can draw its frame.
pub fn draw(mesh: PolygonMesh) {
    assert!(
        mesh.polygon_count() > 0,
        "a file without polygons is an error"
    );
    if mesh.corners().len() > MOST_CORNERS {
        return;
    }
    for source in [
        NormalSource::Auto,
        NormalSource::Averaged,
        NormalSource::Given,
        NormalSource::Crease(30.0),
    ] {
        vertex_normals(&mesh, source);
    }
    let mut scene = Scene::of_mesh(mesh);
    (scene.width, scene.height) = (16, 12);
    if let Ok(frame) = scene.frame() {
        for entry in METHODS {
            let variant = entry.variant();
            if variant.plan(&frame, Renderer::LECTURE).renderer().is_some() {
                variant
                    .render_linear(&frame)
                    .expect("a method for the frame");
            }
        }
    }
}

/// Checks that a message is one line, and that it comes from our own checks. The parser behind them
/// should find nothing more to refuse.
pub fn check_message(error: &ReadError) {
    let text = error.to_string();
    assert!(is_one_line(&text), "{text:?}");
    assert!(!text.contains("gave up"), "{text:?}");
}

pub fn is_one_line(text: &str) -> bool {
    !text.is_empty() && !text.contains(['\n', '\r'])
}
