//! Words and numbers of text files, with their line numbers.

use super::error::{Place, Refusal, hint, quote};
use std::format;
use std::string::String;

/// A cursor over the words of a text. CR, LF and CR LF each end a line. NUL, the end-of-file byte
/// of DOS and the mark of UTF-8 count as blanks: some programs write the end of a C string too, and
/// some users join files.
#[derive(Clone)]
pub(super) struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The line of the last word, counted from 1.
    line: usize,
    /// True if `#` begins a comment that lasts to the end of its line.
    has_comments: bool,
}

impl<'a> Words<'a> {
    /// Starts at byte `at`, which is in line `line`.
    pub(super) fn new(bytes: &'a [u8], at: usize, line: usize) -> Self {
        Words {
            bytes,
            at,
            line,
            has_comments: false,
        }
    }

    /// Treats `#` as the beginning of a comment.
    pub(super) fn with_comments(self) -> Self {
        Words {
            has_comments: true,
            ..self
        }
    }

    /// Returns the line of the last word.
    pub(super) fn place(&self) -> Place {
        Place::Line(self.line)
    }

    /// True if a word of this line was read already.
    pub(super) fn has_begun(&self) -> bool {
        let before = self.bytes[..self.at].last();
        before.is_some_and(|byte| !matches!(byte, b'\n' | b'\r'))
    }

    /// Returns how many bytes are left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Returns the next word, in this line or a later one.
    pub(super) fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.next_in_line() {
                return Some(word);
            }
            if !self.end_line() {
                return None;
            }
        }
    }

    /// Returns the next word of this line; `None` at its end.
    pub(super) fn next_in_line(&mut self) -> Option<&'a [u8]> {
        let is_blank = |byte: &u8| matches!(byte, b' ' | b'\t' | 0x0b | 0x0c | 0 | 0x1a);
        let rest = loop {
            let rest = &self.bytes[self.at..];
            self.at += rest.iter().position(|byte| !is_blank(byte))?;
            let rest = &self.bytes[self.at..];
            if !rest.starts_with(MARK) {
                break rest;
            }
            self.at += MARK.len();
        };
        let is_end = |byte: &u8| is_blank(byte) || matches!(byte, b'\n' | b'\r');
        let length = rest.iter().position(is_end).unwrap_or(rest.len());
        let word = &rest[..length];
        if length == 0 || (self.has_comments && word[0] == b'#') {
            return None;
        }
        self.at += length;
        // A comment may begin inside a word. The cursor then goes back to the `#`, where the next
        // call stops.
        match word.iter().position(|byte| *byte == b'#') {
            Some(mark) if self.has_comments => {
                self.at -= length - mark;
                Some(&word[..mark])
            }
            _ => Some(word),
        }
    }

    /// Skips the rest of the line and its end. Returns false at the end of the text.
    pub(super) fn end_line(&mut self) -> bool {
        let rest = &self.bytes[self.at..];
        let Some(end) = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else {
            self.at = self.bytes.len();
            return false;
        };
        self.at += end + 1;
        if rest[end] == b'\r' && rest.get(end + 1) == Some(&b'\n') {
            self.at += 1;
        }
        self.line += 1;
        true
    }

    /// Reads the next word as a finite number.
    ///
    /// # Errors
    /// If the text ends here, before `what`, or the word is no finite number.
    pub(super) fn finite(&mut self, what: &str) -> Result<f64, Refusal> {
        let word = self.next().ok_or_else(|| self.ends_before(what))?;
        number(word)
            .filter(|number| number.is_finite())
            .ok_or_else(|| self.no_number(word))
    }

    /// Makes the error for a text that ends too early. `what` is missing.
    pub(super) fn ends_before(&self, what: &str) -> Refusal {
        Refusal::at(self.place(), format!("the file ends here, before {what}"))
    }

    /// Makes the error for a word where a number should be.
    pub(super) fn no_number(&self, word: &[u8]) -> Refusal {
        let word = text(word);
        let hint = hint(&word);
        let problem = format!("`{}`: expected a finite number{hint}", quote(&word));
        Refusal::at(self.place(), problem)
    }
}

/// The byte-order mark of UTF-8.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// Returns `bytes` without the bytes that may end a text: blanks, the NUL of a C string, and the
/// end-of-file byte of DOS.
pub(super) fn text_end(bytes: &[u8]) -> &[u8] {
    let is_text = |byte: &u8| !byte.is_ascii_whitespace() && !matches!(byte, 0 | 0x1a);
    let end = bytes.iter().rposition(is_text).map_or(0, |last| last + 1);
    &bytes[..end]
}

/// Decodes a word as UTF-8, or as Latin-1 if it is not valid UTF-8.
pub(super) fn text(word: &[u8]) -> String {
    match std::str::from_utf8(word) {
        Ok(text) => text.into(),
        Err(_) => word.iter().map(|&byte| byte as char).collect(),
    }
}

/// Reads a number, which may be NaN or infinite.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    plain_number(word).or_else(|| std::str::from_utf8(word).ok()?.parse().ok())
}

/// The powers of ten that an `f64` holds exactly.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Reads a number of at most 15 significant digits with a small exponent; returns `None` for all
/// others. Most numbers of a file are like this, and this is faster than the standard library. An
/// `f64` holds both the digits and the power of ten exactly, so their product or quotient is
/// rounded only once (Clinger, *How to read floating point numbers accurately*, 1990).
fn plain_number(word: &[u8]) -> Option<f64> {
    let (is_negative, mut rest) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, word),
    };
    let (mut digits, mut significant, mut count, mut exponent) = (0u64, 0, 0, 0i32);
    // `digits` collects all digits as one integer; each digit behind the point lowers the exponent
    // by one.
    let mut is_behind_point = false;
    while let [byte, others @ ..] = rest {
        match byte {
            b'0'..=b'9' => {
                digits = digits * 10 + u64::from(byte - b'0');
                significant += usize::from(digits > 0);
                count += 1;
                exponent -= i32::from(is_behind_point);
                // Every integer of 15 digits is exact in an f64; one of 16 may not be.
                if significant > 15 {
                    return None;
                }
            }
            b'.' if !is_behind_point => is_behind_point = true,
            _ => break,
        }
        rest = others;
    }
    if count == 0 || count > 60 {
        return None;
    }
    if let [b'e' | b'E', others @ ..] = rest {
        let (sign, figures) = match others {
            [b'-', figures @ ..] => (-1, figures),
            [b'+', figures @ ..] => (1, figures),
            _ => (1, others),
        };
        if !(1..=3).contains(&figures.len()) || !figures.iter().all(u8::is_ascii_digit) {
            return None;
        }
        let value = |sum: i32, figure: &u8| sum * 10 + i32::from(figure - b'0');
        exponent += sign * figures.iter().fold(0, value);
    } else if !rest.is_empty() {
        return None;
    }
    let ten = *TENS.get(exponent.unsigned_abs() as usize)?;
    let digits = digits as f64;
    let value = if exponent < 0 {
        digits / ten
    } else {
        digits * ten
    };
    Some(if is_negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;
    use std::vec::Vec;

    #[test]
    fn numbers_equal_those_that_the_standard_library_reads() {
        let mut random = Random::new(11);
        let mut plain = 0;
        for _ in 0..300_000 {
            let length = 1 + random.below(12);
            let letter = |_| b"+-..0123456789e9"[random.below(16) as usize];
            let word: Vec<u8> = (0..length).map(letter).collect();
            let expected: Option<f64> = text(&word).parse().ok();
            plain += usize::from(plain_number(&word).is_some());
            let found = number(&word);
            let bits = |number: Option<f64>| number.map(f64::to_bits);
            assert_eq!(bits(found), bits(expected), "{}", text(&word));
        }
        assert!(plain > 10_000, "{plain}");
        for word in [
            "-0",
            "0.1",
            "1e22",
            "123456789012345e-22",
            "1e-300",
            ".5e1",
            "nan",
            "-inf",
        ] {
            let expected: f64 = word.parse().expect("a number");
            let found = number(word.as_bytes()).expect("a number");
            assert!(
                found.to_bits() == expected.to_bits() || found.is_nan(),
                "{word}"
            );
        }
        for word in [
            "", "-", ".", "e5", "1e", "1e+", "1,5", "0x1", "1.2.3", "--1",
        ] {
            assert_eq!(number(word.as_bytes()), None, "{word}");
        }
    }

    #[test]
    fn words_have_their_line_numbers() {
        let mut words = Words::new(b"a\tb\r\nc\rd\n\n e# f\n#g\nh", 0, 1).with_comments();
        let mut found = Vec::new();
        while let Some(word) = words.next() {
            found.push((text(word), words.line));
        }
        let found: Vec<(&str, usize)> = found.iter().map(|(word, line)| (&**word, *line)).collect();
        assert_eq!(
            found,
            [("a", 1), ("b", 1), ("c", 2), ("d", 3), ("e", 5), ("h", 7)]
        );
        let mut words = Words::new(b"a #b\nc", 0, 1);
        assert_eq!(words.next_in_line(), Some(&b"a"[..]));
        assert_eq!(words.next_in_line(), Some(&b"#b"[..]));
        assert_eq!(words.next_in_line(), None);
        assert!(words.end_line());
        assert_eq!(words.next_in_line(), Some(&b"c"[..]));
        assert!(!words.end_line() && words.next().is_none());
    }
}
