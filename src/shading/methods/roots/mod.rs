//! Normals or products of normals, and a root or a quotient at each pixel.

pub(in crate::shading) mod duff_newton;
pub(in crate::shading) mod duff_phong;
pub(in crate::shading) mod eye_frame_phong;
pub(in crate::shading) mod fast_phong;
pub(in crate::shading) mod fast_phong_rsqrt;
pub(in crate::shading) mod naive_phong;
pub(in crate::shading) mod phong_rsqrt;
pub(in crate::shading) mod phong_unnormalised;
