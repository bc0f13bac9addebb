//! Differences between pictures, and their cost.

#[cfg(feature = "cli")]
pub mod comparison;
#[cfg(feature = "cli")]
pub mod experiments;
pub mod metrics;
#[cfg(feature = "cli")]
pub mod table;
#[cfg(feature = "cli")]
pub mod timing;
