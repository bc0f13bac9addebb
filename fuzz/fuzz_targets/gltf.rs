#![no_main]

#[path = "../inputs/mesh.rs"]
mod mesh;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| mesh::run("gltf", bytes));
