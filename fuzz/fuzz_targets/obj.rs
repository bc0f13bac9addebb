#![no_main]

#[path = "../inputs/mesh.rs"]
mod mesh;
#[path = "../inputs/obj.rs"]
mod obj;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| obj::run(bytes));
