//! Timing: the time of a call, and the ratio between the speeds of two candidates, with a
//! confidence interval.
//!
//! Disturbances of a machine (clock frequency, other programs) change slowly compared with the
//! length of a sample. Therefore `time_interleaved` does not time one candidate after the other.
//! Every round samples each of them once, and `Ratio::paired` compares two candidates round by
//! round, when both met the machine in the same state.

mod machine;
mod rounds;
mod statistics;

pub use fastphong::shading::SpanRow;
pub(crate) use machine::Machine;
pub(crate) use rounds::{Candidate, TimeLimits, time_interleaved};
pub(crate) use statistics::{Ratio, Timing};
