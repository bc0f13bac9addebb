//! Methods with quadratics over a polygon or a span in place of unit vectors.

pub(crate) mod biquadratic_normals;
pub(crate) mod bishop_weimer;
pub(crate) mod over_triangle;
pub(crate) mod over_triangle_at_positions;
pub(crate) mod quadratic_normals;
pub(crate) mod six_point;
