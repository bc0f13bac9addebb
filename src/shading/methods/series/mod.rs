//! Polynomials in place of the root.

pub(in crate::shading) mod cubic_phong;
pub(in crate::shading) mod series_phong;
