//! Highlights by N·H, which is stepped itself.

pub(in crate::shading) mod difference_vector;
pub(in crate::shading) mod duff_half;
pub(in crate::shading) mod slerp_half;
