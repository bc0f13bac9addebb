#![no_main]

#[path = "../inputs/results.rs"]
mod results;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| results::run(bytes));
