//! Timing in rounds, comparison of methods, experiments, and their tables.

pub(crate) mod comparison;
pub mod experiments;
pub(crate) mod table;
pub mod timing;
