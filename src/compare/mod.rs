//! How far apart two pictures are.
//!
//! [`metrics::compare`] measures the difference between two pictures, [`metrics::difference_map`]
//! draws it.

#[cfg(feature = "cli")]
pub(crate) mod comparison;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod experiments;
pub mod metrics;
#[cfg(feature = "cli")]
pub(crate) mod table;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod timing;
