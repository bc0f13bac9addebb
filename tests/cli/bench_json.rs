//! `docs/bench-json.md` gives every field of the data, in the order in which files have it.

use super::{Folder, SPHERE};
use fastphong::number::SimdLevel;
use std::collections::BTreeSet;

const PAGE: &str = include_str!("../../docs/bench-json.md");

/// Returns the objects of a JSON text: the path of the field that holds each, and its fields in
/// their order, which `serde_json` would sort.
fn objects(json: &str) -> Vec<(String, Vec<String>)> {
    let (mut open, mut closed) = (Vec::<(String, Vec<String>)>::new(), Vec::new());
    let mut rest = json;
    while let Some(at) = rest.find(['{', '}', '"']) {
        let (mark, after) = rest[at..].split_at(1);
        rest = after;
        match mark {
            "{" => {
                let holder = open.last();
                let within = holder.map_or(String::new(), |(path, fields)| {
                    format!("{path}/{}", fields.last().expect("a field"))
                });
                open.push((within, Vec::new()));
            }
            "}" => closed.extend(open.pop()),
            _ => {
                let mut is_escaped = false;
                let end = rest.find(|c| {
                    let is_end = c == '"' && !is_escaped;
                    is_escaped = c == '\\' && !is_escaped;
                    is_end
                });
                let (text, after) = rest.split_at(end.expect("a whole string"));
                rest = &after[1..];
                if rest.trim_start().starts_with(':') {
                    open.last_mut().expect("an object").1.push(text.to_owned());
                }
            }
        }
    }
    closed
}

/// Returns the row of the page that begins with `start`.
fn row(start: &str) -> &'static str {
    let mut rows = PAGE.lines().filter_map(|line| line.strip_prefix("| "));
    let found = rows.find(|row| row.starts_with(start));
    found.unwrap_or_else(|| panic!("docs/bench-json.md has no row {start}"))
}

/// Returns the names in code, in their order.
fn names(row: &str) -> Vec<&str> {
    let code = row.split('`').skip(1).step_by(2);
    code.flat_map(|code| code.split(['.', '[', ']', ' ']))
        .collect()
}

/// Asserts that the page names these fields, in this order.
fn assert_described(start: &str, fields: &[String]) {
    let mut described = names(row(start)).into_iter();
    // A sentence names those that all other documents have.
    let is_shared = |name: &str| ["schema", "command_line", "machine", "version"].contains(&name);
    let is_other = start.starts_with('`');
    for field in fields
        .iter()
        .filter(|field| !(is_other && is_shared(field)))
    {
        let is_next = described.any(|name| name == field);
        assert!(
            is_next,
            "docs/bench-json.md, row {start}: `{field}` of {fields:?}"
        );
    }
}

/// Returns the row that describes the object at a path, or `None` if a sentence does. `whole` is
/// the row of the whole document.
fn row_of<'a>(path: &'a str, whole: &'a str) -> Option<&'a str> {
    let in_words = ["/parameters", "/blocks", "/small"];
    if in_words.iter().any(|part| path.contains(part)) {
        return None;
    }
    let (_, place) = path.rsplit_once('/').unwrap_or_default();
    Some(match place {
        "" => whole,
        "run" | "shard" => "document",
        "comparisons" => "comparison",
        "rows" | "barycentric" | "kinds" => "row",
        "error" | "own" | "difference" => "difference",
        "ratio_to_naive" | "ratio_to_barycentric" | "work_to_naive" => "ratio",
        "methods" | "operations" => "method",
        "figures" | "findings" | "live" | "handles" => "figure",
        "frame_times" | "spans" | "cases" => whole,
        "machine" | "clamping" | "triangulation" | "stats" | "renderer" | "noise" | "speed"
        | "timing" => place,
        _ => panic!("which row of docs/bench-json.md describes {path}?"),
    })
}

#[test]
fn the_page_gives_every_field_in_its_order() {
    let folder = Folder::new();
    let quick = "--resolution 24x18 --methods adaptive-phong";
    let mut places = BTreeSet::new();
    for (command, whole) in [
        (
            format!("compare {SPHERE} {quick} --time-budget 0 --json"),
            "document",
        ),
        (
            format!(
                "report {SPHERE} {quick} --figures newell --studies none --time-budget 0 -o o.html --json -"
            ),
            "document",
        ),
        (
            format!("bench {SPHERE} {quick} --frame-times --frames 1 --json -"),
            "`fastphong.frame-times/2`",
        ),
        (
            "bench --spans --methods gouraud --json -".to_owned(),
            "`fastphong.spans/2`",
        ),
        (
            "search --methods gouraud --restarts 1 --degrees 30 --lights 1 --json -".to_owned(),
            "`fastphong.search/1`",
        ),
    ] {
        let text = folder.run(&command).done().out;
        for (place, fields) in objects(&text) {
            if let Some(start) = row_of(&place, whole) {
                assert_described(start, &fields);
                places.insert(place);
            }
        }
    }
    assert!(places.len() > 20, "{places:?}");
    for level in SimdLevel::ALL {
        let is_named = names(row("renderer")).contains(&level.name());
        assert!(is_named, "docs/bench-json.md does not name {level}");
    }
}
