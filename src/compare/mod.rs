//! How far apart two pictures are.
//!
//! [`metrics::compare`] measures the difference between two pictures, [`metrics::difference_map`]
//! draws it.

pub mod metrics;
