//! Methods that interpolate angles, or the coordinates of another chart of the sphere of normals.

pub(crate) mod chart_errors;
pub(crate) mod half_reflection;
pub(crate) mod kuijk_blake;
pub(crate) mod phong_map;
pub(crate) mod quaternion_phong;
pub(crate) mod slerp_chebyshev;
pub(crate) mod slerp_phong;
pub(crate) mod slerp_phong_vector;
pub(crate) mod stereographic_phong;
