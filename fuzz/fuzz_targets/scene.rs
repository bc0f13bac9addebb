#![no_main]

#[path = "../inputs/scene.rs"]
mod scene;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| scene::run(bytes));
