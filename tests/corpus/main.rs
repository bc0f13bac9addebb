//! Replays the corpora of the fuzz targets, so that inputs that once failed are tried on every
//! machine without a fuzzer.

#[path = "../../fuzz/inputs/mesh.rs"]
mod mesh;
#[path = "../../fuzz/inputs/obj.rs"]
mod obj;
#[path = "../../fuzz/inputs/picture.rs"]
mod picture;
#[path = "../../fuzz/inputs/pixels.rs"]
mod pixels;
#[path = "../../fuzz/inputs/results.rs"]
mod results;
#[path = "../../fuzz/inputs/scene.rs"]
mod scene;

use std::fs;
use std::path::Path;

/// Runs each file of a target's corpus, and also its first half, because most readers stumble at an
/// end.
fn replay(target: &str, run: fn(&[u8])) {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/corpus")).join(target);
    let files = fs::read_dir(&folder).expect("the corpus");
    let mut count = 0;
    for path in files.map(|entry| entry.expect("an entry").path()) {
        println!("{}", path.display());
        let bytes = fs::read(&path).expect("a readable file");
        run(&bytes);
        run(&bytes[..bytes.len() / 2]);
        count += 1;
    }
    assert!(count > 0, "{} is empty", folder.display());
}

#[test]
fn obj_files_are_read_or_refused() {
    replay("obj", obj::run);
}

#[test]
fn mesh_files_are_read_or_refused() {
    replay("stl", |bytes| mesh::run("stl", bytes));
    replay("ply", |bytes| mesh::run("ply", bytes));
    replay("off", |bytes| mesh::run("off", bytes));
    replay("gltf", |bytes| mesh::run("gltf", bytes));
}

#[test]
fn scene_files_are_read_or_refused() {
    replay("scene", scene::run);
}

#[test]
fn picture_files_are_compared_or_refused() {
    replay("picture", picture::run);
}

#[test]
fn results_in_json_are_shown_or_refused() {
    replay("results", results::run);
}

#[test]
fn worlds_from_bytes_are_drawn() {
    replay("pixels", pixels::run);
}
