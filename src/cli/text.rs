//! Text in lines of a readable length.

/// The longest line of running text.
const LINE: usize = 96;

/// Indents every line of `text` by `indent`, and breaks it between words where it would be too long.
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
pub fn grouped(number: usize) -> String {
    match number {
        0..1000 => number.to_string(),
        _ => format!("{},{:03}", grouped(number / 1000), number % 1000),
    }
}

/// Writes a number that was measured with four digits after the point, and from 10¹⁵ on, where digits would fill the line, with an
/// exponent.
pub fn measured(number: f64) -> String {
    match number {
        _ if number.is_infinite() => "inf".to_owned(),
        _ if number.abs() >= 1e15 => format!("{number:.4e}"),
        _ => format!("{number:.4}"),
    }
}

/// Says how many of `all` things of one kind: `3 of 12 polygons`, or `the only polygon`.
pub fn part_of(number: usize, all: usize, noun: &str) -> String {
    match all {
        1 => format!("the only {noun}"),
        _ => format!("{} of {} {noun}s", grouped(number), grouped(all)),
    }
}

/// Writes a number with its noun and verb: `one` after 1, `more` after others.
pub fn counted(number: usize, one: &str, more: &str) -> String {
    let words = if number == 1 { one } else { more };
    format!("{} {words}", grouped(number))
}
