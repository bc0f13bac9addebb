//! Corners of faces: `v`, `v/vt`, `v//vn` and `v/vt/vn`, and the positions that their indices name.

use super::error::{ObjProblem, quote};
use std::vec::Vec;

/// A corner with absolute indices, counted from 0.
pub(super) struct ObjCorner {
    pub position: usize,
    pub normal: Option<usize>,
}

/// A corner as it stands in the file: indices counted from 1, or backwards from -1.
pub(super) struct WrittenCorner {
    pub position: i64,
    pub texture: Option<i64>,
    pub normal: Option<i64>,
}

impl WrittenCorner {
    /// Reads a word of an `f` statement.
    pub(super) fn read(word: &str) -> Result<Self, ObjProblem> {
        let bad = || ObjProblem::BadCorner(quote(word));
        let mut rest = Some(word);
        let mut index = || {
            let part = rest.unwrap_or_default();
            // Words are short: looking at every byte is faster than a search made for long texts.
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

/// The positions of a file, as far as it was read.
#[derive(Default)]
pub(super) struct Entries {
    /// The number of entries so far.
    pub count: usize,
    /// Lines that name an entry not read yet, each farther ahead than those before it.
    ahead: Vec<(usize, usize)>,
}

impl Entries {
    /// Returns the entry, counted from 0, that `index` names.
    ///
    /// A positive index may be ahead of its entry: [`Entries::missing`] tells at the end of the file.
    pub(super) fn resolve(&mut self, line: usize, index: i64) -> Result<usize, ObjProblem> {
        let entry = match usize::try_from(index.unsigned_abs()) {
            Ok(number @ 1..) if index > 0 => Some(number - 1),
            Ok(back @ 1..) => self.count.checked_sub(back),
            _ => None,
        };
        let entry = entry.ok_or_else(|| self.out_of_range(index))?;
        if entry >= self.count && self.ahead.last().is_none_or(|&(_, most)| entry > most) {
            self.ahead.push((line, entry));
        }
        Ok(entry)
    }

    /// Returns the first line that names an entry past the last one, with the error about it.
    pub(super) fn missing(&self) -> Option<(usize, ObjProblem)> {
        let mut ahead = self.ahead.iter();
        let &(line, entry) = ahead.find(|&&(_, entry)| entry >= self.count)?;
        Some((line, self.out_of_range(entry as i64 + 1)))
    }

    /// Makes the error for `index`, which names no entry.
    fn out_of_range(&self, index: i64) -> ObjProblem {
        let (what, count) = ("position", self.count);
        ObjProblem::IndexOutOfRange { what, index, count }
    }
}
