//! Spans against a closed form in `f64`, and spans that could overflow.

mod closed_form;
mod errors;
mod extremes;
mod frames;
mod large_triangles;
mod sweeps;

pub(super) use closed_form::Random;
