//! Checks the text and the place of errors.

use super::cubes;
use crate::scene::file::SceneError;
use crate::scene::file::SceneFile;
use std::format;
use std::string::ToString;

/// Returns the error of `text`, from parsing or resolving.
pub(super) fn error(text: &str) -> SceneError {
    match SceneFile::parse(text, "scene.toml").and_then(|file| file.resolve(cubes)) {
        Ok(_) => panic!("no error in\n{text}"),
        Err(error) => error,
    }
}

/// Checks one wrong scene. The mark `«…»` is removed before parsing, and the caret must point at
/// the marked text.
pub(super) fn check(marked: &str, message: &str, expected: &str, hint: Option<&str>) {
    let start = marked.find('«').expect("a mark");
    let line = marked[..start].matches('\n').count() + 1;
    let column = start - marked[..start].rfind('\n').map_or(0, |i| i + 1) + 1;
    let inside = &marked[start + '«'.len_utf8()..marked.find('»').expect("a mark")];
    let error = error(&marked.replace(['«', '»'], ""));
    let gap = if expected.is_empty() { "" } else { ": " };
    let sentence = format!("scene.toml:{line}:{column}: {message}{gap}{expected}");
    assert_eq!(error.to_string(), sentence, "in\n{marked}");
    let shown = error.render(false);
    let help = shown.split_once("help: ").map(|(_, help)| help);
    assert_eq!(help.map(str::trim_end), hint, "in\n{marked}\n{shown}");
    assert!(shown.starts_with(&format!("error: {message}\n")), "{shown}");
    assert!(
        shown.contains(&format!("--> scene.toml:{line}:{column}\n")),
        "{shown}"
    );
    // There is a caret under each character of the first marked line, starting at its column.
    let carets = "^".repeat(
        inside
            .lines()
            .next()
            .map_or(1, |line| line.chars().count().max(1)),
    );
    if !inside.contains('\n') {
        let caret_line = shown
            .lines()
            .find(|line| line.contains('^'))
            .unwrap_or_else(|| panic!("no caret in\n{shown}"));
        let under = caret_line.split_once("| ").map_or("", |(_, under)| under);
        let end = column - 1 + carets.len();
        assert_eq!(under.find('^'), Some(column - 1), "{shown}");
        assert!(
            under[column - 1..].starts_with(&carets) && !under[end..].starts_with('^'),
            "{shown}"
        );
    }
}
