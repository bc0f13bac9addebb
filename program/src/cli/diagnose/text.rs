//! The answer as text for a terminal.

use super::super::text::wrapped;
use crate::diagnose::Line;

/// Writes the lines of an answer.
pub fn text(lines: &[Line]) -> String {
    let write = |line: &Line| match line {
        Line::Text(text) => wrapped(text, 0),
        Line::Item(text) => wrapped(text, 2),
        Line::Row { head, text } => row(head, text),
        Line::Gap => "\n".to_owned(),
    };
    lines.iter().map(write).collect()
}

/// Writes a heading, and beside it a text wrapped into one column.
fn row(head: &str, line: &str) -> String {
    const COLUMN: usize = 22;
    let text = wrapped(line, COLUMN);
    let head = format!("  {head:<width$}", width = COLUMN - 2);
    format!("{head}{}", text.trim_start())
}
