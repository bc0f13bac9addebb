//! Another formula for highlights: by N and H alone.

pub(crate) mod difference_vector;
pub(crate) mod duff_half;
pub(crate) mod slerp_half;
