//! Text for terminals: wrapped lines, grouped digits, singular and plural.

/// The longest line of running text, in characters.
const LINE: usize = 96;

/// Indents every line of `text` by `indent` spaces, and breaks lines that would be too long between
/// words.
pub fn wrapped(text: &str, indent: usize) -> String {
    let mut out = String::new();
    for line in text.lines() {
        let mut length = 0;
        for word in line.split_whitespace() {
            let letters = word.chars().count();
            if length > 0 && indent + length + 1 + letters > LINE {
                out.push('\n');
                length = 0;
            }
            let space = if length == 0 { indent } else { 1 };
            out += &format!("{:space$}{word}", "");
            length += letters + usize::from(length > 0);
        }
        out.push('\n');
    }
    out
}

/// Writes `1234567` as `1,234,567`.
pub fn grouped(count: usize) -> String {
    match count {
        0..1000 => count.to_string(),
        _ => format!("{},{:03}", grouped(count / 1000), count % 1000),
    }
}

/// Writes a measured value with four decimals, or with an exponent from 10¹⁵ on, where digits would
/// fill the line.
pub fn measured(value: f64) -> String {
    match value {
        _ if value.is_infinite() => "inf".to_owned(),
        _ if value.abs() >= 1e15 => format!("{value:.4e}"),
        _ => format!("{value:.4}"),
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
