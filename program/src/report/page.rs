//! The page: a template, filled with the data, the pictures, and the parts that are readable
//! without JavaScript.

use super::document::{list, number, text};
use super::modules::joined;
use super::pictures::data_uri;
use super::tables::{self, Trusted};
use super::{Report, answer, course, live};
use crate::compare::table::html_text;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use fastphong_report::{SCRIPT, STYLE, TEMPLATE, VIEWER};
use serde_json::{Number, Value};

/// Joins the script of a page, whose first module is `entry`.
pub(super) fn script(entry: &str) -> String {
    bare(&joined(SCRIPT, entry).expect("a test joins all modules"))
}

/// Fills the template.
pub(super) fn page(report: &Report) -> String {
    let data = &report.data;
    let title = match (list(data, "/figures"), list(data, "/comparisons")) {
        ([one], []) => text(one, "/title"),
        (_, []) => "The lectures, made again",
        _ => "Phong shading, measured",
    };
    let parts = [
        ("title", html_text(title)),
        ("style", bare(STYLE)),
        (
            "answer",
            answer::html(data, &answer::quiet()) + &limits(report),
        ),
        ("static", readable(report)),
        ("course", course::html(data)),
        ("made", html_text(&made(data))),
        ("data", script_text(&json(report))),
        ("pictures", pictures(report)),
        ("viewer", VIEWER.to_string()),
        ("script", script("page.js")),
    ];
    filled(TEMPLATE, &parts)
}

/// Says which values of the documents cannot be compared, if there are any.
fn limits(report: &Report) -> String {
    match &*report.limits() {
        "" => String::new(),
        limits => format!("<p class=\"remarks\">{}</p>", html_text(limits)),
    }
}

/// Replaces each `{{name}}` of a template. It does not look for names in the parts that it fills
/// in.
pub(super) fn filled(template: &str, parts: &[(&str, String)]) -> String {
    let mut pieces = template.split("{{");
    let mut text = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").expect("every place is closed");
        let part = parts.iter().find(|(key, _)| *key == name);
        text += &part.expect("every place has a part").1;
        text += rest;
    }
    text
}

/// Removes everything from a script or a style that browsers ignore: indentation, empty lines,
/// comments that have their own lines, and commas at the ends of lists. No string in the scripts
/// has a line that looks like one of these.
fn bare(script: &str) -> String {
    let mut text = String::new();
    let mut is_comment = false;
    for line in script.lines().map(|line| line.trim_start_matches('\t')) {
        let begins = line.starts_with("/*");
        if !(is_comment || begins || line.starts_with("//") || line.is_empty()) {
            if text.ends_with(",\n") && line.starts_with([')', ']', '}']) {
                text.truncate(text.len() - 2);
                text.push('\n');
            }
            text += line;
            text.push('\n');
        }
        is_comment = (is_comment || begins) && !line.ends_with("*/");
    }
    text
}

/// Escapes every `<` of JSON, so that a `<script>` around it contains neither `</script` nor
/// `<!--`.
fn script_text(json: &str) -> String {
    // JSON has `<` only in strings, where this escape is allowed.
    json.replace('<', "\\u003c")
}

/// Writes the document, and the documents beside it, with six digits and without samples. Nobody
/// sees more on the page, and `--json` has everything.
fn json(report: &Report) -> String {
    let mut data = report.data.clone();
    if !report.beside.is_empty() {
        data["beside"] = report.beside.clone().into();
    }
    shorten(&mut data);
    data.to_string()
}

/// Rounds all fractions to six significant digits, and replaces samples by their count, `rounds`.
fn shorten(value: &mut Value) {
    match value {
        Value::Number(number) if number.is_f64() => {
            let short = number.as_f64().map(|v| format!("{v:.5e}"));
            let short = short
                .and_then(|text| text.parse().ok())
                .and_then(Number::from_f64);
            *number = short.unwrap_or_else(|| number.clone());
        }
        Value::Array(list) => list.iter_mut().for_each(shorten),
        Value::Object(fields) => {
            if let Some(Value::Array(samples)) = fields.get_mut("samples_ns") {
                let rounds = core::mem::take(samples).len();
                fields.insert("rounds".into(), rounds.into());
            }
            fields.values_mut().for_each(shorten);
        }
        _ => {}
    }
}

/// Writes the pictures of each scene and of the figures as separate elements, which the script
/// parses when it first shows them.
fn pictures(report: &Report) -> String {
    let element = |id: String, json: &str| {
        let json = script_text(json);
        format!("<script type=\"application/json\" id=\"{id}\">{json}</script>\n")
    };
    let scenes = report.pictures.iter().enumerate();
    let scenes = scenes.map(|(i, scene)| element(format!("pictures-{i}"), &scene.packed));
    let text: String = scenes.collect();
    let live = report.pictures.iter().enumerate();
    let live = live.filter_map(|(i, scene)| Some((i, scene.live.as_ref()?)));
    let live: String = live
        .map(|(i, scene)| element(format!("live-{i}"), scene))
        .collect();
    let has_handles = list(&report.data, "/figures")
        .iter()
        .any(|figure| figure.get("live").is_some());
    // The page contains the module only if it has something to move.
    let module = if has_handles || !live.is_empty() {
        element("live-module".into(), &live::module())
    } else {
        String::new()
    };
    let uris = |figure: &Vec<Vec<u8>>| figure.iter().map(|png| data_uri(png)).collect();
    let files: Value = report
        .figures
        .iter()
        .map(uris)
        .collect::<Vec<Value>>()
        .into();
    let traces = match &*report.traces {
        "" => String::new(),
        packed => element("figure-traces".into(), &format!("\"{packed}\"")),
    };
    text + &live + &module + &element("figure-pictures".into(), &files.to_string()) + &traces
}

/// Writes pictures and tables for readers without JavaScript.
fn readable(report: &Report) -> String {
    let mut html = spheres(report);
    let shown = report
        .pictures
        .first()
        .map_or(&[][..], |first| &first.small);
    for (name, png) in shown.iter().take(2) {
        let (uri, name) = (data_uri(png), html_text(name));
        html += &format!(
            "<figure><img src=\"{uri}\" alt=\"{name}\"><figcaption>{name}</figcaption></figure>"
        );
    }
    let shown = |of: &Trusted| {
        let noise = match &*of.noise {
            "" => String::new(),
            noise => format!("<p>{}</p>", html_text(noise)),
        };
        format!("<div class=\"scroll\">{}</div>{noise}", of.table.html())
    };
    let folded = |of: &Trusted| {
        let caption = html_text(&of.table.caption);
        format!(
            "<details><summary>{caption}</summary>{}</details>",
            shown(of)
        )
    };
    let tables = tables::all(&report.data);
    if let [first, rest @ ..] = &tables[..] {
        html += &shown(first);
        html.extend(rest.iter().map(folded));
    }
    html
}

/// Writes the first two pictures of the figure at the top of the page, and the finding about them.
fn spheres(report: &Report) -> String {
    let figures = list(&report.data, "/figures").iter().zip(&report.figures);
    let found = figures
        .into_iter()
        .find(|(figure, _)| text(figure, "/name") == "spheres");
    let Some((figure, files)) = found else {
        return String::new();
    };
    let blocks = list(figure, "/blocks").iter();
    let shown = blocks.flat_map(|block| list(block, "/pictures/shown"));
    let picture = |(png, panel): (&Vec<u8>, &Value)| {
        let [alt, caption] = ["/alt", "/caption"].map(|part| html_text(text(panel, part)));
        let uri = data_uri(png);
        format!(
            "<figure><img src=\"{uri}\" alt=\"{alt}\"><figcaption>{caption}</figcaption></figure>"
        )
    };
    let pictures: String = files.iter().zip(shown).take(2).map(picture).collect();
    let verdict = html_text(text(figure, "/findings/0/verdict"));
    format!("{pictures}<p>{verdict}</p>")
}

/// Says how, when and on which machine the page was made, in one line.
fn made(data: &Value) -> String {
    let date = match text(data, "/date") {
        "" => String::new(),
        date => format!(" on {date}"),
    };
    let seconds = number(data, "/seconds").map_or(String::new(), |s| format!(" in {s:.0} s"));
    format!(
        "Made by {}{date}{seconds}; {}",
        command(data),
        machine(data)
    )
}

/// Describes the machine of a document in one line, like
/// [`Machine::line`](crate::compare::timing::Machine::line).
pub(super) fn machine(data: &Value) -> String {
    let m = |field: &str| text(&data["machine"], field);
    let (system, compiler) = ([m("/os"), m("/arch")].join(" "), m("/rustc"));
    let (profile, opt_level, version) = (m("/profile"), m("/opt_level"), m("/version"));
    let built = format!("{compiler}, {profile}, opt-level {opt_level}");
    format!("{}, {system}; {built}; fastphong {version}", m("/cpu"))
}

/// Returns the command line of a document, quoted for shells of the Bourne family.
pub(super) fn command(data: &Value) -> String {
    let words = list(data, "/command_line").iter();
    let words = words.map(|word| shell_word(text(word, "")));
    words.collect::<Vec<_>>().join(" ")
}

/// Quotes a word for a shell if it needs quotes.
pub fn shell_word(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_./:=,+@%".contains(c);
    match word {
        word if !word.is_empty() && word.chars().all(is_plain) => word.to_string(),
        word => format!("'{}'", word.replace('\'', "'\\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_ends_a_script() {
        let json = serde_json::to_string("</script><!--").unwrap();
        let escaped = script_text(&json);
        assert!(!escaped.contains('<'));
        let back: String = serde_json::from_str(&escaped).unwrap();
        assert_eq!(back, "</script><!--");
    }

    #[test]
    fn every_file_of_the_script_belongs_to_a_page() {
        let pages = ["page.js", "pairs.js"].map(|entry| joined(SCRIPT, entry).unwrap());
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../report/script");
        let files = std::fs::read_dir(folder).expect("the folder of the script");
        for file in files.map(|entry| entry.expect("a readable folder").path()) {
            let text = std::fs::read_to_string(&file).expect("a file of text");
            let about = text.lines().next().expect("a comment at the top");
            let is_there = |page: &String| page.contains(about);
            assert!(pages.iter().any(is_there), "{} is not used", file.display());
        }
    }

    #[test]
    fn the_page_has_the_script_without_comments() {
        let script = "/* A sum,\n   of two. */\n\tconst sum = a + b; // here\n\n// no\n/* no */\n\t\tf(\n\tsum,\n);\n";
        assert_eq!(bare(script), "const sum = a + b; // here\nf(\nsum\n);\n");
        let joined = joined(SCRIPT, "page.js").unwrap();
        for text in [&joined, STYLE] {
            let page = bare(text);
            assert!(!page.contains("\n\t") && !page.contains("\n/*") && page.len() < text.len());
        }
        // `bare` would drop all lines after a comment that ends in the middle of a line.
        let comments = joined
            .lines()
            .chain(STYLE.lines())
            .map(str::trim_start)
            .filter(|line| line.starts_with("/*"));
        for line in comments {
            let end = line.find("*/").map(|at| at + 2);
            assert!(end.is_none_or(|end| end == line.len()), "{line}");
        }
    }

    #[test]
    fn what_is_filled_in_is_not_looked_at_again() {
        let parts = [("a", "{{b}}".to_string()), ("b", "x".to_string())];
        assert_eq!(filled("1{{a}}2{{b}}3", &parts), "1{{b}}2x3");
    }

    #[test]
    fn commands_can_be_typed_again() {
        let words = ["fastphong", "report", "a b", "it's", ""];
        let data = serde_json::json!({ "command_line": words });
        assert_eq!(command(&data), "fastphong report 'a b' 'it'\\''s' ''");
    }
}
