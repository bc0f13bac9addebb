//! Quadratics over a polygon or a span in place of unit vectors.

pub(in crate::shading) mod biquadratic_normals;
pub(in crate::shading) mod bishop_weimer;
pub(in crate::shading) mod over_triangle;
pub(in crate::shading) mod over_triangle_at_positions;
pub(in crate::shading) mod quadratic_normals;
pub(in crate::shading) mod six_point;
