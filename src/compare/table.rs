//! One table, and its renderers: aligned text, Markdown, HTML, CSV.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Rows of cells; the first cell of a row names it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// The caption, for readers and for screen readers.
    pub caption: String,
    /// The names of the columns, with their units.
    pub head: Vec<String>,
    /// The rows, each with as many cells as the head.
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

    /// Writes it in columns: the first aligned on the left, all others on the right.
    pub fn text(&self) -> String {
        let lines: Vec<&[String]> = self.lines().map(|line| &line[..]).collect();
        aligned(&lines, &[0])
    }

    /// Returns the head and the rows.
    fn lines(&self) -> impl Iterator<Item = &Vec<String>> {
        core::iter::once(&self.head).chain(&self.rows)
    }

    /// Writes it in Markdown, where every cell means itself.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| markdown_text(cell)).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let rule = "---:|".repeat(self.head.len().saturating_sub(1));
        let rows: String = self.rows.iter().map(|row| line(row)).collect();
        format!("{}|---|{rule}\n{rows}", line(&self.head))
    }

    /// Writes it as an HTML table with a caption.
    pub fn html(&self) -> String {
        let mut html = format!(
            "<table><caption>{}</caption><thead><tr>",
            html_text(&self.caption)
        );
        for cell in &self.head {
            html += &format!("<th scope=\"col\">{}</th>", html_text(cell));
        }
        html += "</tr></thead><tbody>";
        for row in &self.rows {
            html += "<tr>";
            for (i, cell) in row.iter().enumerate() {
                let cell = html_text(cell);
                html += &match i {
                    0 => format!("<th scope=\"row\">{cell}</th>"),
                    _ => format!("<td>{cell}</td>"),
                };
            }
            html += "</tr>";
        }
        html + "</tbody></table>"
    }

    /// Writes it as comma-separated values (RFC 4180).
    pub fn csv(&self) -> String {
        let cell = |cell: &String| match cell.contains(['"', ',', '\n', '\r']) {
            true => format!("\"{}\"", cell.replace('"', "\"\"")),
            false => cell.clone(),
        };
        let line = |cells: &Vec<String>| cells.iter().map(cell).collect::<Vec<_>>().join(",");
        self.lines().map(|cells| line(cells) + "\r\n").collect()
    }
}

/// Sets lines of cells in columns: those named in `left` aligned on the left, all others on the right.
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
        let cells = line.as_ref().iter().zip(&widths).enumerate();
        let cells = cells.map(|(column, (cell, width))| match left.contains(&column) {
            true => format!("{cell:width$}"),
            false => format!("{cell:>width$}"),
        });
        text += cells.collect::<Vec<_>>().join("  ").trim_end();
        text.push('\n');
    }
    text
}

/// Escapes text for HTML, between tags and between the quotes of attributes.
pub fn html_text(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // HTML has no other control characters, not even by their number.
            '\n' | '\t' => out.push(letter),
            _ if letter.is_control() => out.push('\u{FFFD}'),
            _ => out.push(letter),
        }
    }
    out
}

/// Escapes text for Markdown, also within a table.
pub fn markdown_text(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '<' => out.push_str("&lt;"),
            '&' => out.push_str("&amp;"),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' | '!' => {
                out.push('\\');
                out.push(letter);
            }
            _ if letter.is_control() => out.push(' '),
            _ => out.push(letter),
        }
    }
    out
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
