//! A cursor over the values of a PLY file, which are words of a text or bytes.

use super::super::error::{Place, Refusal, quote};
use super::super::words::{Words, number, text, text_end};
use super::header::{Coding, Element, Header, Property, Type};
use std::format;

/// The values of a file that are not read yet.
pub(super) enum Body<'a> {
    Text {
        words: Words<'a>,
        /// True if each element begins a new line.
        by_lines: bool,
    },
    Binary {
        bytes: &'a [u8],
        at: usize,
        is_big: bool,
    },
}

impl<'a> Body<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header, by_lines: bool) -> Self {
        let (at, line) = header.end;
        match header.coding {
            Coding::Text => Body::Text {
                words: Words::new(bytes, at, line),
                by_lines,
            },
            coding => Body::Binary {
                bytes,
                at,
                is_big: coding == Coding::BigEndian,
            },
        }
    }

    /// Returns the place of the next value; in a text, the line of the last one.
    pub(super) fn place(&self) -> Place {
        match self {
            Body::Text { words, .. } => words.place(),
            Body::Binary { at, .. } => Place::Byte(*at),
        }
    }

    /// Skips the rest of the previous element's line, if each element begins a new line.
    #[inline]
    pub(super) fn end_element(&mut self) {
        if let Body::Text {
            words,
            by_lines: true,
        } = self
            && words.has_begun()
        {
            words.end_line();
        }
    }

    /// True if each element begins a new line.
    pub(super) fn is_by_lines(&self) -> bool {
        matches!(self, Body::Text { by_lines: true, .. })
    }

    /// True if nothing is left, or only bytes that may end a text.
    pub(super) fn is_at_its_end(&self) -> bool {
        match self {
            Body::Text { words, .. } => words.clone().next().is_none(),
            Body::Binary { bytes, at, .. } => text_end(&bytes[*at..]).is_empty(),
        }
    }

    /// Returns how many of `element` the rest of the file can hold at most. Memory is reserved for
    /// that many, whatever the header claims.
    pub(super) fn room(&self, element: &Element) -> usize {
        let least = |property: &Property| property.count.unwrap_or(property.kind).size();
        let (left, each) = match self {
            // A value takes at least a digit and a blank.
            Body::Text { words, .. } => (words.left(), 2 * element.properties.len()),
            Body::Binary { bytes, at, .. } => {
                let sizes = element.properties.iter().map(least);
                (bytes.len() - at, sizes.sum())
            }
        };
        element.count.min(left / each.max(1) + 1)
    }

    /// Reads a value, which may be NaN or infinite.
    ///
    /// # Errors
    /// At the end of the file, and for a word that is no number.
    #[inline]
    pub(super) fn value(&mut self, kind: Type) -> Result<f64, Refusal> {
        match self {
            Body::Text { words, .. } => {
                let word = words.next().ok_or_else(|| words.ends_before(LAST))?;
                number(word).ok_or_else(|| words.no_number(word))
            }
            Body::Binary { bytes, at, is_big } => {
                let size = kind.size();
                let Some(own) = bytes.get(*at..*at + size) else {
                    return Err(ends_early(bytes));
                };
                *at += size;
                Ok(decode(own, kind, *is_big))
            }
        }
    }

    /// Reads the count of a list.
    ///
    /// # Errors
    /// As [`Body::value`], and for a value that is no count.
    #[inline]
    pub(super) fn count(&mut self, kind: Type) -> Result<usize, Refusal> {
        let place = self.place();
        let count = self.value(kind)?;
        // In a binary file the place was taken before the count was read. A text knows the line
        // only after.
        let place = match self {
            Body::Text { words, .. } => words.place(),
            Body::Binary { .. } => place,
        };
        if count.fract() != 0.0 || !(0.0..4e9).contains(&count) {
            let expected = if count.fract() == 0.0 && count > 0.0 {
                "less than 4000000000"
            } else {
                "a whole number"
            };
            let problem = format!("a list of {count} entries: expected {expected}");
            return Err(Refusal::at(place, problem));
        }
        Ok(count as usize)
    }

    /// Skips a property.
    ///
    /// # Errors
    /// As [`Body::value`].
    pub(super) fn skip(&mut self, property: &Property) -> Result<(), Refusal> {
        let count = match property.count {
            Some(kind) => self.count(kind)?,
            None => 1,
        };
        match self {
            Body::Text { words, .. } => {
                // Skipped words need not be numbers.
                for _ in 0..count {
                    words.next().ok_or_else(|| words.ends_before(LAST))?;
                }
            }
            Body::Binary { bytes, at, .. } => {
                let size = count * property.kind.size();
                if size > bytes.len() - *at {
                    return Err(ends_early(bytes));
                }
                *at += size;
            }
        }
        Ok(())
    }

    /// Returns the next element of `size` bytes, and true with it if it is big-endian; `None` in a
    /// text.
    ///
    /// # Errors
    /// At the end of the file.
    #[inline]
    pub(super) fn row(&mut self, size: usize) -> Result<Option<(&'a [u8], bool)>, Refusal> {
        let Body::Binary { bytes, at, is_big } = self else {
            return Ok(None);
        };
        let row = bytes.get(*at..).and_then(|rest| rest.get(..size));
        let row = row.ok_or_else(|| ends_early(bytes))?;
        *at += size;
        Ok(Some((row, *is_big)))
    }

    /// Makes the error for a value that is no index of one of `vertices`.
    pub(super) fn no_index(&self, index: f64, vertices: usize) -> Refusal {
        let found = quote(&text(format!("{index}").as_bytes()));
        let expected = match vertices {
            0 => "vertices in the file, but there are none".into(),
            n => format!("0 to {}", n - 1),
        };
        let problem = format!("vertex index {found} is out of range: expected {expected}");
        Refusal::at(self.place(), problem)
    }
}

const LAST: &str = "its last element";

/// Makes the error for a binary file that is cut off.
fn ends_early(bytes: &[u8]) -> Refusal {
    let problem = format!("the file ends here, before {LAST}");
    Refusal::at(Place::Byte(bytes.len()), problem)
}

/// Decodes a value. `bytes` must be as long as its type; a NaN stands for any other length.
#[inline]
pub(super) fn decode(bytes: &[u8], kind: Type, is_big: bool) -> f64 {
    let four = |four: [u8; 4]| {
        if is_big {
            u32::from_be_bytes(four)
        } else {
            u32::from_le_bytes(four)
        }
    };
    match (kind, bytes) {
        (Type::F32, &[a, b, c, d]) => f64::from(f32::from_bits(four([a, b, c, d]))),
        (Type::U8, &[a]) => f64::from(a),
        (Type::I8, &[a]) => f64::from(a as i8),
        (Type::I32, &[a, b, c, d]) => f64::from(four([a, b, c, d]) as i32),
        (Type::U32, &[a, b, c, d]) => f64::from(four([a, b, c, d])),
        (Type::I16 | Type::U16, &[a, b]) => {
            let two = if is_big {
                u16::from_be_bytes([a, b])
            } else {
                u16::from_le_bytes([a, b])
            };
            match kind {
                Type::I16 => f64::from(two as i16),
                _ => f64::from(two),
            }
        }
        (Type::F64, bytes) => match (bytes.first_chunk(), is_big) {
            (Some(eight), true) => f64::from_be_bytes(*eight),
            (Some(eight), false) => f64::from_le_bytes(*eight),
            (None, _) => f64::NAN,
        },
        _ => f64::NAN,
    }
}
