//! The text of OBJ and MTL files: decoding, lines, comments, continued lines, and numbers.

use std::borrow::Cow;
use std::string::String;

/// Decodes a file as UTF-8 without its byte-order mark, or as Latin-1 if it is not valid UTF-8.
/// Bytes at the end that only end a text are left out: the NUL of a C string that was written
/// whole, and the end-of-file byte of DOS.
///
/// Any bytes are valid Latin-1. Unlike replacement characters, it keeps different names different,
/// so that a name in the OBJ file finds its equal in the MTL file.
pub(super) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let is_text = |byte: &u8| !matches!(byte, b'\0' | b'\x1a' | b'\n' | b'\r' | b' ');
    let end = bytes.iter().rposition(is_text).map_or(0, |last| last + 1);
    let bytes = &bytes[..end];
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| byte as char).collect::<String>()),
    }
}

/// Returns the line number, from 1, of the byte `at` in `text`.
pub(super) fn line_number(text: &str, at: usize) -> usize {
    let before = &text[..at];
    // CR LF was counted twice.
    let ends = before.matches(['\n', '\r']).count() - before.matches("\r\n").count();
    ends + 1
}

/// Returns the arguments of a statement of numbers, without its comment.
pub(super) fn without_comment(arguments: &str) -> &str {
    let mut marks = arguments.match_indices('#').map(|(at, _)| at);
    let comment = marks.find(|&at| !is_inside_a_number(arguments, at));
    comment.map_or(arguments, |at| &arguments[..at])
}

/// True if the `#` at `at` belongs to `1.#QNAN`, `-1.#IND` or `1.#INF`. The C library of Windows
/// used to write NaN and infinity like this.
fn is_inside_a_number(arguments: &str, at: usize) -> bool {
    let word = arguments[..at].rsplit(|c: char| c.is_ascii_whitespace());
    let before = word.into_iter().next().unwrap_or_default();
    let after = arguments[at + 1..].bytes().next();
    before.strip_prefix(['+', '-']).unwrap_or(before) == "1."
        && after.is_some_and(|byte| byte.is_ascii_alphabetic())
}

/// The byte-order mark of UTF-8.
const MARK: char = '\u{feff}';
/// The three bytes of [`MARK`], decoded as Latin-1.
const LATIN_MARK: &str = "\u{ef}\u{bb}\u{bf}";

/// Returns a line without meaningless characters around it: blanks, the NUL of a C string, the
/// vertical tab, the end-of-file byte of DOS, and the byte-order mark of a file that was appended
/// to another.
fn bare(line: &str) -> &str {
    let is_nothing =
        |c: char| c.is_ascii_whitespace() || matches!(c, '\0' | '\x0b' | '\x1a' | MARK);
    let line = line.trim_matches(is_nothing);
    match line.strip_prefix(LATIN_MARK) {
        Some(rest) => bare(rest),
        None => line,
    }
}

/// The statements of free-form curves and surfaces. The reader ignores them all. Their arguments
/// are numbers and some words.
pub(super) const FREE_FORM: [&str; 23] = [
    "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp", "end", "con", "bsp", "bzp", "cdc", "cdp", "res", "fm", "ctech", "stech",
];

/// The other statements whose arguments are numbers, of OBJ files and of MTL files.
const NUMERIC: [&str; 19] = [
    "v",
    "vn",
    "vt",
    "f",
    "fo",
    "l",
    "p",
    "s",
    "Ka",
    "Kd",
    "Ks",
    "Ke",
    "Tf",
    "Ns",
    "Ni",
    "d",
    "Tr",
    "illum",
    "sharpness",
];

/// The statements whose arguments are names or other words.
const WORDS: [&str; 16] = [
    "o",
    "g",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "newmtl",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "call",
    "csh",
];

/// An iterator over statements. Each item is the line number where the statement begins, and its
/// text with continued lines joined.
///
/// CR LF, LF and CR each end a line. A backslash at the end of a line continues a statement of
/// numbers, past blank lines and comments, unless another statement follows. Other statements hold
/// names, and a backslash there continues nothing: names of Windows folders end in one, and so do
/// double-byte characters whose last byte is 5C.
///
/// Comments stay in the text because a name may contain `#`. Use [`without_comment`] for statements
/// of numbers.
pub(super) struct Statements<'a> {
    rest: Option<&'a str>,
    line: usize,
    /// True if the text has a backslash, so that lines may be continued. In nearly all files this
    /// is false and saves a test per line.
    backslashes: bool,
    /// True if the text has characters that [`bare`] must remove. This, too, is false in nearly all
    /// files.
    has_odd_ends: bool,
}

impl<'a> Statements<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Statements {
            rest: Some(text),
            line: 0,
            backslashes: text.contains('\\'),
            // '\u{bf}' is the last character of the mark in Latin-1.
            has_odd_ends: ['\0', '\x0b', '\x1a', MARK, '\u{bf}']
                .iter()
                .any(|c| text.contains(*c)),
        }
    }

    fn physical_line(&mut self) -> Option<&'a str> {
        let rest = self.rest?;
        self.line += 1;
        // Lines are short, so a plain loop over the bytes is as fast as a search routine made for
        // long texts.
        let end = rest.bytes().position(|byte| matches!(byte, b'\n' | b'\r'));
        let (line, end) = rest.split_at(end.unwrap_or(rest.len()));
        let next = end.strip_prefix("\r\n").or(end.get(1..));
        self.rest = next;
        Some(if self.has_odd_ends { bare(line) } else { line })
    }

    /// Returns the line that continues a statement: the next one that is neither blank nor a
    /// comment. `None` if that line begins another statement. With `words`, arguments may be words
    /// that look like a statement, which counts only directly after the backslash.
    fn continuation(&mut self, words: bool) -> Option<&'a str> {
        let mut is_next = true;
        loop {
            let before = (self.rest, self.line);
            let line = self.physical_line()?;
            let (word, _) = keyword(line);
            if !word.is_empty() && !word.starts_with('#') {
                if is_statement(word) && !(words && is_next) {
                    (self.rest, self.line) = before;
                    return None;
                }
                return Some(line);
            }
            is_next = false;
        }
    }
}

/// Returns the part of a line before a `\` at its end; `None` if it has none there.
fn continued(line: &str) -> Option<&str> {
    without_comment(line).trim_ascii_end().strip_suffix('\\')
}

/// True if the arguments of the statement in `line` are numbers.
fn is_numeric(line: &str) -> bool {
    let (word, _) = keyword(line);
    is_among(word, &FREE_FORM) || is_among(word, &NUMERIC)
}

/// True if `word` begins a statement.
fn is_statement(word: &str) -> bool {
    is_among(word, &FREE_FORM) || is_among(word, &NUMERIC) || is_among(word, &WORDS)
}

fn is_among(word: &str, known: &[&str]) -> bool {
    known.iter().any(|known| known.eq_ignore_ascii_case(word))
}

impl<'a> Iterator for Statements<'a> {
    type Item = (usize, Cow<'a, str>);

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.physical_line()?;
        let first_line = self.line;
        let start = self.backslashes.then(|| continued(line)).flatten();
        let Some(start) = start.filter(|_| is_numeric(line)) else {
            return Some((first_line, Cow::Borrowed(line)));
        };
        let words = is_among(keyword(line).0, &FREE_FORM);
        let mut joined = String::from(start);
        while let Some(line) = self.continuation(words) {
            joined.push(' ');
            match continued(line) {
                Some(part) => joined.push_str(part),
                None => {
                    joined.push_str(line);
                    break;
                }
            }
        }
        Some((first_line, Cow::Owned(joined)))
    }
}

/// Returns the first word of a statement and the rest, both without blanks around them.
///
/// Only ASCII blanks count. In text decoded as Latin-1, other white space may be a part of a
/// double-byte character.
pub(super) fn keyword(statement: &str) -> (&str, &str) {
    let statement = statement.trim_ascii();
    let end = statement
        .bytes()
        .position(|byte| byte.is_ascii_whitespace());
    let (word, rest) = statement.split_at(end.unwrap_or(statement.len()));
    (word, rest.trim_ascii_start())
}

/// Returns the possible names in the rest of a statement: first the whole rest, then the part
/// before a comment.
///
/// Real files contain both `usemtl red # the lid` and the name `Material #25`. The caller uses the
/// first name that exists.
pub(super) fn name_candidates(rest: &str) -> impl Iterator<Item = &str> {
    let names = rest.match_indices('#').map(|(at, _)| &rest[..at]);
    let is_comment = |before: &&str| before.ends_with(|c: char| c.is_ascii_whitespace());
    let mut names = names.filter(is_comment);
    core::iter::once(rest).chain(names.next().map(str::trim_ascii_end))
}

/// Reads a number, which may be NaN or infinite in any spelling: `nan`, `inf`, `1e999`, `1.#QNAN`,
/// `-1.#IND`, `-nan(ind)`.
pub(super) fn read_number(word: &str) -> Option<f32> {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
    let is_nan = || {
        let start = unsigned.get(..4).unwrap_or_default();
        unsigned.starts_with("1.#") || start.eq_ignore_ascii_case("nan(")
    };
    word.parse().ok().or_else(|| is_nan().then_some(f32::NAN))
}

/// True if `word` plainly is a finite `f32`: an optional sign, then digits with at most one point
/// among them. This is much cheaper than parsing it.
pub(super) fn is_plain_number(word: &str) -> bool {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word).as_bytes();
    let (mut digits, mut points) = (0, 0);
    for &byte in unsigned {
        digits += usize::from(byte.is_ascii_digit());
        points += usize::from(byte == b'.');
    }
    // 38 digits stay below 10^38, and an f32 reaches past that.
    digits + points == unsigned.len() && points <= 1 && (1..=38).contains(&digits)
}

#[cfg(test)]
mod tests {
    use super::is_plain_number;
    use crate::number::test_random::Random;
    use std::string::String;

    #[test]
    fn words_that_look_like_numbers_are_numbers() {
        let mut random = Random::new(9);
        let mut plain = 0;
        for _ in 0..200_000 {
            let length = 1 + random.below(5);
            let letter = |_| b"+-..012789e"[random.below(11) as usize] as char;
            let word: String = (0..length).map(letter).collect();
            if is_plain_number(&word) {
                plain += 1;
                assert!(word.parse().is_ok_and(f32::is_finite), "{word}");
            }
        }
        assert!(plain > 10_000, "{plain}");
        let nines = "9".repeat(39);
        assert!(nines[1..].parse().is_ok_and(f32::is_finite) && is_plain_number(&nines[1..]));
        assert!(!is_plain_number(&nines) && !is_plain_number(""));
    }
}
