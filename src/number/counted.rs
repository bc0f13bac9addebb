//! Counts in sentences: grouped digits, singular and plural.

use alloc::format;
use alloc::string::{String, ToString};

/// Writes `1234567` as `1,234,567`.
pub fn grouped(count: usize) -> String {
    match count {
        0..1000 => count.to_string(),
        _ => format!("{},{:03}", grouped(count / 1000), count % 1000),
    }
}

/// Writes how many of `all` things: `3 of 12 polygons`, or `the only polygon`.
pub fn part_of(count: usize, all: usize, noun: &str) -> String {
    match all {
        1 => format!("the only {noun}"),
        _ => format!("{} of {} {noun}s", grouped(count), grouped(all)),
    }
}

/// Writes a count with its noun, and a verb if there is one: `one` after 1, `more` after other
/// counts.
pub fn counted(count: usize, one: &str, more: &str) -> String {
    let words = if count == 1 { one } else { more };
    format!("{} {words}", grouped(count))
}
