//! Methods with polynomials in place of the root.

pub(crate) mod cubic_phong;
pub(crate) mod series_phong;
