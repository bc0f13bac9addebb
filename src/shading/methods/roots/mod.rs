//! Methods that interpolate normals or products of normals and take a root or a quotient at each
//! pixel.

pub(crate) mod duff_newton;
pub(crate) mod duff_phong;
pub(crate) mod eye_frame_phong;
pub(crate) mod fast_phong;
pub(crate) mod fast_phong_rsqrt;
pub(crate) mod naive_phong;
pub(crate) mod phong_rsqrt;
pub(crate) mod phong_unnormalised;
