//! For each polygon another method.

pub(in crate::shading) mod adaptive_phong;
pub(in crate::shading) mod adaptive_plan;
pub(in crate::shading) mod h_test;
