//! OBJ files with their materials: any bytes give a mesh or one error, and the mesh can be drawn.
//!
//! The input is the OBJ file and, behind the line [`NEXT`], the library that it is given for every name.

use fastphong::mesh::obj::{ObjError, parse_obj};
use fastphong::mesh::vertex_normals::{NormalSource, vertex_normals};
use fastphong::raster::Renderer;
use fastphong::scene::Scene;
use fastphong::shading::METHODS;

/// The line between the mesh and its library.
const NEXT: &[u8] = b"\n--- mtl\n";

/// Longer files only repeat what shorter ones have.
const MOST_BYTES: usize = 1 << 14;

/// Meshes of more corners are read, and not drawn.
const MOST_CORNERS: usize = 2000;

pub fn run(bytes: &[u8]) {
    if bytes.len() > MOST_BYTES {
        return;
    }
    let at = bytes.windows(NEXT.len()).position(|line| line == NEXT);
    let (obj, mtl) = match at {
        Some(at) => (&bytes[..at], &bytes[at + NEXT.len()..]),
        None => (bytes, &[][..]),
    };
    let loaded = match parse_obj("fuzz.obj", obj, |_| Ok(mtl.to_vec())) {
        Ok(loaded) => loaded,
        Err(error) => return check_message(&error),
    };
    for warning in &loaded.warnings {
        assert!(is_one_line(warning), "{warning:?}");
        assert!(!warning.contains("gave up"), "{warning:?}");
    }
    // A C string that was written whole.
    let with_nul = [obj, b"\n\0"].concat();
    let again = parse_obj("fuzz.obj", &with_nul, |_| Ok(mtl.to_vec()));
    let again = again.expect("a NUL at the end refuses nothing");
    assert_eq!(again.mesh, loaded.mesh);
    let mesh = loaded.mesh;
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

/// A message is one line, and the parser behind the checks never gives up.
fn check_message(error: &ObjError) {
    let text = error.to_string();
    assert!(is_one_line(&text), "{text:?}");
    assert!(!text.contains("gave up"), "{text:?}");
}

fn is_one_line(text: &str) -> bool {
    !text.is_empty() && !text.contains(['\n', '\r'])
}
