//! For each polygon another method.

pub(crate) mod adaptive_phong;
pub(crate) mod adaptive_plan;
pub(crate) mod h_test;
