//! What makes HTML out of text.

use alloc::string::String;

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
