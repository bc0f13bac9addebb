//! Differences between pictures, and their cost.

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod comparison;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod experiments;
pub mod metrics;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod table;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod timing;
