//! Tests pictures, coverage and counts against the reference, the lectures and the blessed
//! pictures.

mod accuracy;
mod adaptive;
mod agreement;
mod angular;
mod attributes;
mod auto;
mod clipping;
mod counts;
mod coverage;
mod cs171;
mod edges;
mod engines;
mod figures;
mod hidden_surfaces;
mod lecture;
mod lights;
mod ndc_cube;
mod pins;
mod positional;
mod published;
mod regression;
mod span_shader;
mod supersampling;
mod support;
mod two_sided;
