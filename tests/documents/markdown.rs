//! Reads the repository's documents and sources.

use std::fs;
use std::path::{Path, PathBuf};

pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

#[track_caller]
pub fn read(path: impl AsRef<Path>) -> String {
    let path = path.as_ref();
    fs::read_to_string(root().join(path))
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Returns the paths, from the root, of all files under `folder` with this ending.
pub fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten() {
            let path = entry
                .expect("a folder of the repository can be read")
                .path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == ending) {
                found.push(
                    path.strip_prefix(root())
                        .expect("under the root")
                        .to_owned(),
                );
            }
        }
    }
    found.sort();
    found
}

/// Returns the texts between backticks, line by line, without fenced blocks.
pub fn quoted(text: &str) -> Vec<&str> {
    let mut fenced = false;
    let mut found = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            found.extend(line.split('`').skip(1).step_by(2));
        }
    }
    found
}

/// Returns the cells of each row of all tables in a document. `\|` is a bar inside a cell.
pub fn rows(text: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| {
        let line = line.replace("\\|", "\u{0}");
        let inner = line.trim().trim_matches('|');
        inner
            .split('|')
            .map(|cell| cell.trim().replace('\u{0}', "|"))
            .collect()
    };
    text.lines()
        .filter(|line| line.starts_with('|') && !line.starts_with("|---"))
        .map(cells)
        .collect()
}

pub fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// True if `source` defines the function or type `name`.
pub fn defines(source: &str, name: &str) -> bool {
    [
        "fn ", "struct ", "enum ", "trait ", "const ", "static ", "type ",
    ]
    .iter()
    .any(|keyword| {
        let definition = format!("{keyword}{name}");
        source
            .match_indices(&definition)
            .any(|(at, _)| !source[at + definition.len()..].starts_with(is_word))
    })
}

/// Splits a cell such as "`file`: `item`, `item`; `file`: `item`" into files with their items.
pub fn places(cell: &str) -> Vec<(String, Vec<String>)> {
    let place = |part: &str| {
        let (file, items) = part
            .split_once(':')
            .unwrap_or_else(|| panic!("no item in `{part}`"));
        (
            file.trim().trim_matches('`').into(),
            quoted(items).into_iter().map(String::from).collect(),
        )
    };
    cell.split(';').map(place).collect()
}
