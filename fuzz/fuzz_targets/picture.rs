#![no_main]

#[path = "../inputs/picture.rs"]
mod picture;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| picture::run(bytes));
