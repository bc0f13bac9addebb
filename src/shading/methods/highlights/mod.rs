//! Methods with another formula for highlights, from N and H.

pub(crate) mod difference_vector;
pub(crate) mod duff_half;
pub(crate) mod slerp_half;
