//! Spans and triangles compared with a closed form in `f64`, and some that could overflow.

mod closed_form;
mod errors;
mod extremes;
mod frames;
mod large_triangles;
mod sweeps;

pub(super) use closed_form::Random;
