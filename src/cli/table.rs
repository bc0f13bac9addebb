//! Text in columns, and text in lines of a readable length.

/// The longest line of running text.
const LINE: usize = 96;

/// Sets rows of cells in columns. The first row is the heading if `headed`; columns named in `right` are set flush right.
pub fn columns<const N: usize>(rows: &[[String; N]], headed: bool, right: &[usize]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: [usize; N] = std::array::from_fn(|column| width(column).unwrap_or(0));
    let line = |row: &[String; N]| {
        let cells = row.iter().zip(widths).enumerate();
        let cells = cells.map(|(column, (cell, width))| match right.contains(&column) {
            true => format!("{cell:>width$}"),
            false => format!("{cell:width$}"),
        });
        format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    let mut lines: Vec<String> = rows.iter().map(line).collect();
    if headed {
        lines.insert(1, line(&widths.map(|width| "-".repeat(width))));
    }
    lines.concat()
}

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
