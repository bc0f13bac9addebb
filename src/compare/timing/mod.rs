//! Timing: the time of a call, and the speed of one candidate as a multiple of another's, with its interval.
//!
//! Disturbances of a machine (clock frequency, other programs) change slowly against one sample. So candidates are not
//! timed one after the other but [interleaved](time_interleaved): every round samples each of them once, and two
//! candidates are compared [round by round](Ratio::paired), where both met the same machine.

mod free_memory;
mod machine;
mod rounds;
mod spans;
mod statistics;

#[doc(hidden)]
pub use free_memory::free_memory;
pub use machine::Machine;
pub use rounds::{Candidate, TimeLimits, time_interleaved};
pub use spans::SpanRow;
pub use statistics::{CONFIDENCE, Ratio, Timing};
