//! Text for terminals: wrapped lines and measured values.

pub use fastphong::number::counted::{counted, grouped, part_of};

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

/// Writes a measured value with four decimals, or with an exponent from 10¹⁵ on, where digits would
/// fill the line.
pub fn measured(value: f64) -> String {
    match value {
        _ if value.is_infinite() => "inf".to_owned(),
        _ if value.abs() >= 1e15 => format!("{value:.4e}"),
        _ => format!("{value:.4}"),
    }
}
