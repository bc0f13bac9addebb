//! OBJ files with their materials: any bytes give a mesh or one error, and the mesh can be drawn.
//!
//! The input is the OBJ file and, behind the line [`NEXT`], the material library that it gets for
//! every name.

use super::mesh::{MOST_BYTES, check_message, draw, is_one_line};
use fastphong::mesh::read::parse_mesh;

/// The line between the mesh and its library.
const NEXT: &[u8] = b"\n--- mtl\n";

pub fn run(bytes: &[u8]) {
    if bytes.len() > MOST_BYTES {
        return;
    }
    let at = bytes.windows(NEXT.len()).position(|line| line == NEXT);
    let (obj, mtl) = match at {
        Some(at) => (&bytes[..at], &bytes[at + NEXT.len()..]),
        None => (bytes, &[][..]),
    };
    let loaded = match parse_mesh("fuzz.obj", obj, |_| Ok(mtl.to_vec())) {
        Ok(loaded) => loaded,
        Err(error) => return check_message(&error),
    };
    for note in &loaded.notes {
        let text = note.to_string();
        assert!(is_one_line(&text), "{text:?}");
        assert!(!text.contains("gave up"), "{text:?}");
    }
    // Some programs write a C string with its NUL.
    let with_nul = [obj, b"\n\0"].concat();
    let again = parse_mesh("fuzz.obj", &with_nul, |_| Ok(mtl.to_vec()));
    let again = again.expect("a NUL at the end refuses nothing");
    assert_eq!(again.mesh, loaded.mesh);
    draw(loaded.mesh);
}
