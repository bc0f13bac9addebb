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

/// Writes a number with its noun and verb: `one` after 1, `more` after others.
pub fn counted(number: usize, one: &str, more: &str) -> String {
    let words = if number == 1 { one } else { more };
    format!("{} {words}", grouped(number))
}
