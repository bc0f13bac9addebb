//! Colours, constant or interpolated: no normal at a pixel.

pub(in crate::shading) mod flat;
pub(in crate::shading) mod flat_average;
pub(in crate::shading) mod gouraud;
pub(in crate::shading) mod gouraud_separate;
