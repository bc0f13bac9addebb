//! Text in columns, and text in lines of a readable length.

/// The longest line of running text.
const LINE: usize = 96;

/// Rows of cells, of which the first row is the heading if `headed`; columns named in `right` are set flush right.
pub fn columns(rows: &[Vec<String>], headed: bool, right: &[usize]) -> String {
    let count = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter()
            .filter_map(|row| row.get(column))
            .map(|cell| cell.chars().count())
            .max()
    };
    let widths: Vec<usize> = (0..count)
        .map(|column| width(column).unwrap_or(0))
        .collect();
    let mut text = String::new();
    let mut push = |row: &[String]| {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let width = widths[column];
            let gap = if column == 0 { "" } else { "  " };
            line += &if right.contains(&column) {
                format!("{gap}{cell:>width$}")
            } else {
                format!("{gap}{cell:width$}")
            };
        }
        text += line.trim_end();
        text.push('\n');
    };
    for (i, row) in rows.iter().enumerate() {
        push(row);
        if i == 0 && headed {
            push(
                &widths
                    .iter()
                    .map(|&width| "-".repeat(width))
                    .collect::<Vec<_>>(),
            );
        }
    }
    text
}

/// `text` with every line indented by `indent` and broken between words where it would be too long.
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
            if length == 0 {
                out += &" ".repeat(indent);
            } else {
                out.push(' ');
                length += 1;
            }
            out += word;
            length += letters;
        }
        out.push('\n');
    }
    out
}
