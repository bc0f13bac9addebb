//! A table, and its forms as aligned text, Markdown, HTML and CSV.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// A table of text cells. The first cell of a row is its name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// The caption, for readers and for screen readers.
    pub caption: String,
    /// The headings of the columns, with their units.
    pub head: Vec<String>,
    /// The rows. Each has as many cells as the head.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Makes an empty table.
    pub fn new(caption: impl Into<String>, head: &[&str]) -> Table {
        Table {
            caption: caption.into(),
            head: head.iter().map(|&cell| cell.into()).collect(),
            rows: Vec::new(),
        }
    }

    /// Returns the table as text in columns. The first column is left-aligned, the others are
    /// right-aligned.
    pub fn text(&self) -> String {
        let lines: Vec<&[String]> = self.lines().map(|line| &line[..]).collect();
        aligned(&lines, &[0])
    }

    /// Returns the head, then the rows.
    fn lines(&self) -> impl Iterator<Item = &Vec<String>> {
        core::iter::once(&self.head).chain(&self.rows)
    }

    /// Returns the table in Markdown, with all cells escaped.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| markdown_text(cell)).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = "---:|".repeat(self.head.len().saturating_sub(1));
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        format!("{}|---|{rule}\n{rows}", line(&self.head))
    }

    /// Returns the table in HTML, with its caption.
    pub fn html(&self) -> String {
        let head = |cell: &String| format!("<th scope=\"col\">{}</th>", html_text(cell));
        let cell = |(i, cell): (usize, &String)| match i {
            0 => format!("<th scope=\"row\">{}</th>", html_text(cell)),
            _ => format!("<td>{}</td>", html_text(cell)),
        };
        let row = |row: &Vec<String>| {
            let cells: String = row.iter().enumerate().map(cell).collect();
            format!("<tr>{cells}</tr>")
        };
        let caption = html_text(&self.caption);
        let head: String = self.head.iter().map(head).collect();
        let head = format!("<caption>{caption}</caption><thead><tr>{head}</tr></thead>");
        let rows: String = self.rows.iter().map(row).collect();
        format!("<table>{head}<tbody>{rows}</tbody></table>")
    }

    /// Returns the table as comma-separated values (RFC 4180).
    pub fn csv(&self) -> String {
        let cell = |cell: &String| {
            if cell.contains(['"', ',', '\n', '\r']) {
                format!("\"{}\"", cell.replace('"', "\"\""))
            } else {
                cell.clone()
            }
        };
        let line = |cells: &Vec<String>| cells.iter().map(cell).collect::<Vec<_>>().join(",");
        self.lines().map(|cells| line(cells) + "\r\n").collect()
    }
}

/// Returns lines of cells as text in columns. The columns whose indices are in `left` are
/// left-aligned, the others right-aligned.
pub fn aligned(lines: &[impl AsRef<[String]>], left: &[usize]) -> String {
    let mut widths: Vec<usize> = Vec::new();
    for line in lines {
        let letters = line.as_ref().iter().map(|cell| cell.chars().count());
        widths.resize(widths.len().max(line.as_ref().len()), 0);
        widths
            .iter_mut()
            .zip(letters)
            .for_each(|(w, n)| *w = n.max(*w));
    }
    let mut text = String::new();
    for line in lines {
        let cells = line
            .as_ref()
            .iter()
            .zip(&widths)
            .enumerate()
            .map(|(column, (cell, width))| {
                if left.contains(&column) {
                    format!("{cell:width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
        text += cells.collect::<Vec<_>>().join("  ").trim_end();
        text.push('\n');
    }
    text
}

/// Escapes text for HTML, between tags and between the quotes of attributes.
pub fn html_text(text: &str) -> String {
    // HTML allows no other control characters, not even as numeric references.
    let is_none = |letter: char| letter.is_control() && !matches!(letter, '\n' | '\t');
    text.replace(is_none, "\u{FFFD}")
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&#39;")
}

/// Escapes text for Markdown, also within a table.
pub fn markdown_text(text: &str) -> String {
    let mut text = text
        .replace(char::is_control, " ")
        .replace('&', "&amp;")
        .replace('<', "&lt;");
    // The backslash comes first, because escaping the others adds backslashes.
    for letter in ['\\', '`', '*', '_', '[', ']', '|', '#', '~', '!'] {
        text = text.replace(letter, &format!("\\{letter}"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new("A <caption>", &["name", "x, ms"]);
        table.rows.push(["a|b".into(), "1".into()].into());
        table.rows.push(["<\"c\">".into(), "10.5".into()].into());
        table
    }

    #[test]
    fn columns_are_aligned() {
        assert_eq!(
            table().text(),
            "name   x, ms\na|b        1\n<\"c\">   10.5\n"
        );
    }

    #[test]
    fn cells_mean_themselves_in_every_form() {
        assert_eq!(
            table().markdown(),
            "| name | x, ms |\n|---|---:|\n| a\\|b | 1 |\n| &lt;\"c\"> | 10.5 |\n"
        );
        let html = table().html();
        assert!(html.contains("<caption>A &lt;caption&gt;</caption>"));
        assert!(html.contains("<th scope=\"row\">&lt;&quot;c&quot;&gt;</th><td>10.5</td>"));
        assert_eq!(
            table().csv(),
            "name,\"x, ms\"\r\na|b,1\r\n\"<\"\"c\"\">\",10.5\r\n"
        );
        assert_eq!(html_text("\0é'"), "\u{FFFD}é&#39;");
    }
}
