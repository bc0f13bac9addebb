//! Corners of faces (`v`, `v/vt`, `v//vn` and `v/vt/vn`), and the positions that their indices
//! refer to.

use super::error::{ObjProblem, quote};
use std::vec::Vec;

/// A corner with absolute indices, counted from 0.
pub(super) struct ObjCorner {
    pub position: usize,
    pub normal: Option<usize>,
}

/// A corner as written in the file, with indices counted from 1, or backwards from -1.
pub(super) struct WrittenCorner {
    pub position: i64,
    pub texture: Option<i64>,
    pub normal: Option<i64>,
}

impl WrittenCorner {
    /// Reads a word of an `f` statement.
    pub(super) fn read(word: &str) -> Result<Self, ObjProblem> {
        let bad = || ObjProblem::BadCorner(quote(word));
        // `None` after the part behind the last slash. Anything left after three parts is an error.
        let mut rest = Some(word);
        let mut index = || {
            let part = rest.unwrap_or_default();
            // Words are short, so a plain loop over the bytes is faster than a search routine made
            // for long texts.
            let slash = part.bytes().position(|byte| byte == b'/');
            rest = slash.map(|at| &part[at + 1..]);
            match &part[..slash.unwrap_or(part.len())] {
                "" => Ok(None),
                number => number.parse().map(Some).map_err(|_| bad()),
            }
        };
        let corner = WrittenCorner {
            position: index()?.ok_or_else(bad)?,
            texture: index()?,
            normal: index()?,
        };
        rest.map_or(Ok(corner), |_| Err(bad()))
    }
}

/// The positions of a file that were read so far.
#[derive(Default)]
pub(super) struct Entries {
    /// How many there are so far.
    pub count: usize,
    /// Lines that refer to an entry before it was read, with that entry. Only entries farther ahead
    /// than all previous ones are stored, so the list stays short and still has the first line for
    /// every missing entry.
    ahead: Vec<(usize, usize)>,
}

impl Entries {
    /// Returns the entry, counted from 0, for a written `index`.
    ///
    /// A positive index may come before its entry. At the end of the file [`Entries::missing`]
    /// tells if the entry came.
    pub(super) fn resolve(&mut self, line: usize, index: i64) -> Result<usize, ObjProblem> {
        let entry = match usize::try_from(index.unsigned_abs()) {
            Ok(forward @ 1..) if index > 0 => Some(forward - 1),
            Ok(back @ 1..) => self.count.checked_sub(back),
            _ => None,
        };
        let entry = entry.ok_or_else(|| self.out_of_range(index))?;
        if entry >= self.count && self.ahead.last().is_none_or(|&(_, most)| entry > most) {
            self.ahead.push((line, entry));
        }
        Ok(entry)
    }

    /// Returns the first line that refers to an entry past the last one, with the error about it.
    pub(super) fn missing(&self) -> Option<(usize, ObjProblem)> {
        let mut ahead = self.ahead.iter();
        let &(line, entry) = ahead.find(|&&(_, entry)| entry >= self.count)?;
        Some((line, self.out_of_range(entry as i64 + 1)))
    }

    /// Makes the error for an `index` without an entry.
    fn out_of_range(&self, index: i64) -> ObjProblem {
        let (what, count) = ("position", self.count);
        ObjProblem::IndexOutOfRange { what, index, count }
    }
}
