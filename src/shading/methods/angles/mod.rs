//! Interpolation of angles, or by another chart of the sphere.

pub(in crate::shading) mod chart_errors;
pub(in crate::shading) mod half_reflection;
pub(in crate::shading) mod kuijk_blake;
pub(in crate::shading) mod phong_map;
pub(in crate::shading) mod quaternion_phong;
pub(in crate::shading) mod slerp_chebyshev;
pub(in crate::shading) mod slerp_phong;
pub(in crate::shading) mod slerp_phong_vector;
pub(in crate::shading) mod stereographic_phong;
