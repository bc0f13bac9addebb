//! Timing: the time of a call, and the ratio between the speeds of two candidates, with an interval
//! that holds on a busy machine.
//!
//! - [`Clock`] reads the thread's own processor time, which stands still while other programs run
//!   (`clock.rs`).
//! - [`time_interleaved`] samples all candidates in rounds (`rounds.rs`), and marks samples that
//!   were interrupted (`interruptions.rs`).
//! - [`Times`] has what comes of it (`times.rs`): a [`Timing`] for each candidate, a [`Ratio`] for
//!   each pair, and [`Noise`], which says how far to trust them (`trust.rs`).
//!
//! `benches/trust` measures how often the intervals hold beside other programs. docs/reliability.md
//! has the results, and where the constants come from.

mod clock;
mod interruptions;
mod machine;
mod rounds;
mod statistics;
mod times;
mod trust;

pub use clock::{Clock, End, Moment};
pub use fastphong::shading::SpanRow;
pub(crate) use machine::Machine;
pub use rounds::{Candidate, TimeLimits, time_interleaved};
pub use statistics::{Ratio, Timing};
pub use times::Times;
pub use trust::{Noise, Trust};
