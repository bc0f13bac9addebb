//! The text of OBJ and MTL files: decoding, lines, comments, continued lines.

use std::borrow::Cow;
use std::string::String;

/// Decodes the text of a file: UTF-8 without its mark, else Latin-1, which no byte sequence fails.
///
/// Latin-1 and not replacement characters: two names that differ stay different, and are found in the other file.
pub(super) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| byte as char).collect::<String>()),
    }
}

/// Returns the number, counted from 1, of the first line with a byte that text does not have (a NUL), if there is one.
pub(super) fn binary_line(bytes: &[u8]) -> Option<usize> {
    // Nearly no file has one, and `contains` looks at several bytes at a time.
    let at = if bytes.contains(&0) {
        bytes.iter().position(|&byte| byte == 0)?
    } else {
        return None;
    };
    Some(1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count())
}

/// Returns `line` up to its comment, if it has one.
pub(super) fn without_comment(line: &str) -> &str {
    line.find('#').map_or(line, |at| &line[..at])
}

/// Statements one by one: the number of the line where each begins, and its text with continued lines joined.
///
/// Comments are left in, as `#` may also stand in a name: [`without_comment`] is for the statements of numbers.
pub(super) struct Statements<'a> {
    rest: Option<&'a str>,
    separator: char,
    line: usize,
    /// True if any line may be continued: nearly no file has one.
    backslashes: bool,
}

impl<'a> Statements<'a> {
    /// Begins to read `text`.
    pub(super) fn new(text: &'a str) -> Self {
        // Files from before Mac OS X end lines by a carriage return alone.
        let separator = if text.contains('\n') { '\n' } else { '\r' };
        Statements {
            rest: Some(text),
            separator,
            line: 0,
            backslashes: text.contains('\\'),
        }
    }

    fn physical_line(&mut self) -> Option<&'a str> {
        let rest = self.rest?;
        self.line += 1;
        let (line, rest) = match rest.split_once(self.separator) {
            Some((line, rest)) => (line, Some(rest)),
            None => (rest, None),
        };
        self.rest = rest;
        Some(line)
    }
}

/// Returns the part before a `\` at the end of a line, if the line goes on in the next one.
fn continued(line: &str) -> Option<&str> {
    without_comment(line).trim_end().strip_suffix('\\')
}

impl<'a> Iterator for Statements<'a> {
    type Item = (usize, Cow<'a, str>);

    /// Returns the next statement.
    fn next(&mut self) -> Option<Self::Item> {
        let line = self.physical_line()?;
        let number = self.line;
        let start = if self.backslashes {
            continued(line)
        } else {
            None
        };
        let Some(start) = start else {
            return Some((number, Cow::Borrowed(line)));
        };
        let mut joined = String::from(start);
        while let Some(line) = self.physical_line() {
            joined.push(' ');
            match continued(line) {
                Some(part) => joined.push_str(part),
                None => {
                    joined.push_str(line);
                    break;
                }
            }
        }
        Some((number, Cow::Owned(joined)))
    }
}

/// Returns the first word of a statement and the rest, both without white space around them.
pub(super) fn keyword(statement: &str) -> (&str, &str) {
    let statement = statement.trim();
    match statement
        .bytes()
        .position(|byte| byte.is_ascii_whitespace())
    {
        Some(at) => (&statement[..at], statement[at..].trim_start()),
        None => (statement, ""),
    }
}

/// Returns the names that a statement may hold: the whole rest first, then up to a comment.
///
/// `usemtl red # the lid` and the name `Material #25` are both met in real files; what exists decides.
pub(super) fn name_candidates(rest: &str) -> impl Iterator<Item = &str> {
    let comment = rest
        .match_indices('#')
        .map(|(at, _)| at)
        .find(|&at| rest[..at].ends_with(char::is_whitespace));
    core::iter::once(rest).chain(comment.map(|at| rest[..at].trim_end()))
}
