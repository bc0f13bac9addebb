//! Methods that interpolate colours, or have one per polygon, and need no normal at a pixel.

pub(crate) mod flat;
pub(crate) mod flat_average;
pub(crate) mod gouraud;
pub(crate) mod gouraud_separate;
