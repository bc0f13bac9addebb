//! The documents against the code.

mod lectures;
mod markdown;
mod rooms;
mod tidy;
