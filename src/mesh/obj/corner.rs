//! Corners of faces: `v`, `v/vt`, `v//vn` and `v/vt/vn`, and what their indices name.

use super::error::{ObjProblem, quote};
use std::vec::Vec;

/// A corner as resolved: position and, if given, normal, both counted from 0.
pub(super) type Corner = (usize, Option<usize>);

/// A corner as it stands in the file: indices counted from 1, or backwards from -1.
pub(super) struct WrittenCorner {
    pub position: i64,
    pub texture: Option<i64>,
    pub normal: Option<i64>,
}

impl WrittenCorner {
    /// Reads a word of a face.
    pub(super) fn read(word: &str) -> Result<Self, ObjProblem> {
        let bad = || ObjProblem::BadCorner(quote(word));
        let (position, rest) = leading_integer(word.as_bytes()).ok_or_else(bad)?;
        let (texture, rest) = slash_integer(rest).ok_or_else(bad)?;
        let (normal, rest) = slash_integer(rest).ok_or_else(bad)?;
        let corner = WrittenCorner {
            position,
            texture,
            normal,
        };
        rest.is_empty().then_some(corner).ok_or_else(bad)
    }
}

/// Reads the integer at the start of `bytes`. Returns it and the rest; `None` when there is none or it does not fit.
fn leading_integer(bytes: &[u8]) -> Option<(i64, &[u8])> {
    let sign = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
    let digits = bytes[sign..]
        .iter()
        .take_while(|byte| byte.is_ascii_digit());
    let (number, rest) = bytes.split_at(sign + digits.count());
    Some((str::from_utf8(number).ok()?.parse().ok()?, rest))
}

/// Reads the integer after a `/`, if there is one, and what follows; `None` when something else stands there.
fn slash_integer(bytes: &[u8]) -> Option<(Option<i64>, &[u8])> {
    match bytes {
        [] => Some((None, bytes)),
        [b'/'] => Some((None, &[])),
        [b'/', b'/', ..] => Some((None, &bytes[1..])),
        [b'/', rest @ ..] => leading_integer(rest).map(|(number, rest)| (Some(number), rest)),
        _ => None,
    }
}

/// Returns the entry, counted from 0, that `index` names among `count` so far.
///
/// A positive index may be ahead of what it names: that is noted in `ahead` and checked at the end of the file.
pub(super) fn resolve(
    what: &'static str,
    index: i64,
    count: usize,
    line: usize,
    ahead: &mut Vec<(usize, usize)>,
) -> Result<usize, ObjProblem> {
    let error = || ObjProblem::IndexOutOfRange { what, index, count };
    if index <= 0 {
        let back = usize::try_from(index.unsigned_abs()).map_err(|_| error())?;
        return if back == 0 || back > count {
            Err(error())
        } else {
            Ok(count - back)
        };
    }
    let entry = usize::try_from(index - 1).map_err(|_| error())?;
    if entry >= count && ahead.last().is_none_or(|&(_, largest)| entry > largest) {
        ahead.push((line, entry));
    }
    Ok(entry)
}
