//! Checks how sources and documents begin: comments with a verb or a noun, the README short.

use crate::markdown::{files, read};

/// Openings that no doc comment may have, because they refer to something not yet read.
const OPENINGS: [&str; 10] = [
    "What", "How", "Whether", "Where", "Which", "Its", "Those", "The same", "Likewise", "Such",
];

/// The most lines of README.md: a stranger reads it in a minute.
const README_LINES: usize = 130;

/// The most lines of a module comment: its task, its data flow, where to start reading.
const MODULE_LINES: usize = 25;

/// Returns the text of a doc comment's line.
fn doc(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let text = line.strip_prefix("///").or(line.strip_prefix("//!"))?;
    Some(text.strip_prefix(' ').unwrap_or(text))
}

/// True if `text` begins with one of [`OPENINGS`] as a whole word.
fn begins_badly(text: &str) -> bool {
    OPENINGS.iter().any(|word| {
        text.strip_prefix(word)
            .is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    })
}

#[test]
fn doc_comments_begin_with_a_verb_or_a_noun() {
    let (mut comments, mut bad) = (0, Vec::new());
    for file in files("src", "rs") {
        let source = read(&file);
        let lines: Vec<&str> = source.lines().collect();
        for (number, line) in lines.iter().enumerate() {
            let first = number == 0 || doc(lines[number - 1]).is_none();
            let Some(text) = doc(line).filter(|text| first && !text.is_empty()) else {
                continue;
            };
            comments += 1;
            if begins_badly(text) {
                bad.push(format!("{}:{}: {text}", file.display(), number + 1));
            }
        }
    }
    assert!(comments > 1000, "only {comments} comments were found");
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

#[test]
fn module_comments_are_short() {
    let mut long = Vec::new();
    for file in files("src", "rs") {
        // The crate's own comment is its tour, with a tested example.
        if file.ends_with("src/lib.rs") {
            continue;
        }
        let lines = read(&file)
            .lines()
            .take_while(|line| line.starts_with("//!"))
            .count();
        if lines > MODULE_LINES {
            long.push(format!("{}: {lines} lines", file.display()));
        }
    }
    assert!(long.is_empty(), "over {MODULE_LINES}: {long:?}");
}

#[test]
fn the_readme_is_short() {
    let lines = read("README.md").lines().count();
    assert!(lines <= README_LINES, "README.md has {lines} lines");
}
