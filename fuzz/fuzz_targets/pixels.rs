#![no_main]

#[path = "../inputs/pixels.rs"]
mod pixels;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pixels::run(bytes));
