//! HTML that all pages share: their style and policy, escaped text, tables.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// The style of every page.
pub(super) const STYLE: &str = include_str!("page/page.css");

/// The content security policy: nothing is loaded from anywhere, whatever a title may have smuggled in.
pub(super) const POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; \
                      base-uri 'none'; form-action 'none'";

/// `text` as it may stand in HTML, between tags and between quotes of attributes.
pub(super) fn escape(text: &str) -> String {
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

/// `json` as it may stand in a `<script>`: no `<`, so that neither `</script` nor `<!--` is in it.
pub(super) fn escape_script(json: &str) -> String {
    // Outside of texts JSON has no `<`.
    json.replace('<', "\\u003c")
}

/// `text` as it may stand in `id` and in a fragment: letters and digits of ASCII, and `-` for all else.
pub(super) fn identifier(text: &str) -> String {
    text.chars()
        .map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter
            } else {
                '-'
            }
        })
        .collect()
}

/// Returns a command line as it can be typed into a shell of the Bourne family.
pub(super) fn command(words: &[String]) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,+@%".contains(c);
    let quoted = |word: &String| match word {
        word if !word.is_empty() && word.chars().all(is_plain) => word.clone(),
        word => format!("'{}'", word.replace('\'', "'\\''")),
    };
    words.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

/// Returns a table with the title for screen readers; the first cell of each row is its head.
pub(super) fn table(title: &str, head: &[String], rows: &[Vec<String>]) -> String {
    let mut html = format!(
        "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">",
        escape(title)
    );
    html += "<table><thead><tr>";
    for cell in head {
        html += &format!("<th scope=\"col\">{}</th>", escape(cell));
    }
    html += "</tr></thead><tbody>";
    for row in rows {
        html += "<tr>";
        for (i, cell) in row.iter().enumerate() {
            let cell = escape(cell);
            html += &if i == 0 {
                format!("<th scope=\"row\">{cell}</th>")
            } else {
                format!("<td>{cell}</td>")
            };
        }
        html += "</tr>";
    }
    html + "</tbody></table></div>"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_ends_a_text_or_an_attribute() {
        assert_eq!(
            escape("<a href='x' b=\"&\">\0é"),
            "&lt;a href=&#39;x&#39; b=&quot;&amp;&quot;&gt;\u{FFFD}é"
        );
        assert_eq!(escape("&lt;"), "&amp;lt;");
    }

    #[test]
    fn nothing_ends_a_script() {
        let json = serde_json::to_string("</script><!--").unwrap();
        let escaped = escape_script(&json);
        assert!(!escaped.contains('<'));
        assert_eq!(
            serde_json::from_str::<String>(&escaped).unwrap(),
            "</script><!--"
        );
    }

    #[test]
    fn identifiers_are_plain() {
        assert_eq!(identifier("my scene/ü.toml"), "my-scene---toml");
    }
}
