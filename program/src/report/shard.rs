//! Parts of long runs, which several machines can do in any order: `--shard 3/16` does one,
//! `--from` joins all.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// A part of a run. It has the items at the indices `number − 1`, `number − 1 + of` and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Shard {
    /// The number of the part, counted from 1.
    pub number: u32,
    /// How many parts there are.
    pub of: u32,
}

impl Shard {
    /// A whole run, which has one part.
    pub const WHOLE: Shard = Shard { number: 1, of: 1 };

    /// Reads a part that a user wrote as `3/16`.
    ///
    /// # Errors
    /// A sentence that says what was expected.
    pub fn parse(text: &str) -> Result<Shard, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| {
            Some(Shard {
                number: number.parse().ok()?,
                of: of.parse().ok()?,
            })
        });
        numbers
            .filter(Shard::is_part)
            .ok_or_else(|| "expected a part of a whole of 100000 at most, as in 3/16".into())
    }

    /// True if the number is from 1 to the count of parts, which is at most 100,000.
    pub fn is_part(&self) -> bool {
        (1..=self.of).contains(&self.number) && self.of <= 100_000
    }

    /// True if the item at this index belongs to the part.
    pub fn has(&self, item: usize) -> bool {
        item % self.of as usize == self.number as usize - 1
    }
}

/// The document of a part.
#[derive(Clone, Debug)]
pub struct PartOf {
    /// The file that it was read from, as the user named it.
    pub file: String,
    /// The text that all parts of one run have in common.
    pub run: String,
    /// The part.
    pub shard: Shard,
}

/// Checks parts before they are joined: all must be parts of one run with the same count of parts,
/// none may be missing, and none may be there twice.
///
/// # Errors
/// A sentence that names the file or the parts.
pub fn check_whole(parts: &[PartOf]) -> Result<(), String> {
    let Some(first) = parts.first() else {
        return Ok(());
    };
    let of = first.shard.of;
    let mut seen = BTreeSet::new();
    for part in parts {
        if (&part.run, part.shard.of) != (&first.run, of) {
            return Err(format!(
                "{}: part of another run than {}: expected parts of one, of as many parts",
                part.file, first.file
            ));
        }
        if !seen.insert(part.shard.number) {
            let number = part.shard.number;
            return Err(format!(
                "{}: part {number} of {of} is there twice",
                part.file
            ));
        }
    }
    let missing: Vec<_> = (1..=of)
        .filter(|number| !seen.contains(number))
        .map(|number| number.to_string())
        .collect();
    if missing.is_empty() {
        return Ok(());
    }
    const SHOWN: usize = 10;
    let more = match missing.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let shown = missing[..missing.len().min(SHOWN)].join(", ");
    Err(format!(
        "{}: of {of} parts of this run are missing: {shown}{more}",
        first.file
    ))
}
