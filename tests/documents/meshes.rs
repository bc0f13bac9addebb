//! `docs/meshes.md` says how the tool answers mesh files. The tests read its examples, and compare
//! its lists with the code.

use crate::markdown::{quoted, read, root, rows};
use fastphong::mesh::read::{mesh_endings, parse_mesh};
use fastphong::note::Notes;
use std::collections::BTreeSet;
use std::{fs, io};

const PAGE: &str = "docs/meshes.md";
const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";
const FACE: &str = "f 1 2 3\n";

/// Returns the rows of the table under a heading: statement, example and answer.
fn table(heading: &str) -> Vec<[String; 3]> {
    let page = read(PAGE);
    let (_, part) = page
        .split_once(&format!("\n{heading}\n"))
        .expect("a heading of the page");
    let part = part.split("\n## ").next().unwrap_or_default();
    let rows = rows(part).into_iter().skip(1);
    let rows = rows.map(|row| <[String; 3]>::try_from(row).expect("three cells"));
    rows.collect()
}

/// Returns the notes as sentences.
fn sentences(notes: &Notes) -> Vec<String> {
    notes.iter().map(ToString::to_string).collect()
}

/// Reads an OBJ file with a library. Returns the messages, or the error.
fn answer(obj: &str, mtl: Option<&str>) -> Result<Vec<String>, String> {
    let library = |_: &str| mtl.map(|text| text.as_bytes().to_vec());
    let loaded = parse_mesh("t.obj", obj.as_bytes(), |name| {
        library(name).ok_or_else(|| io::ErrorKind::NotFound.into())
    });
    let loaded = loaded.map_err(|error| error.to_string())?;
    Ok(sentences(&loaded.notes))
}

/// Checks that the tool answers a file as the page says.
fn check(example: &str, said: &str, found: Result<Vec<String>, String>) {
    let text = quoted(said).pop().unwrap_or_default();
    // The page does not quote names inside an answer.
    let holds = |line: &String| line.replace('`', "").contains(text);
    let is_so = match (said.split([':', ',', ';', ' ', '.']).next(), &found) {
        (Some("read" | "passed"), Ok(told)) => told.is_empty(),
        (Some("told"), Ok(told)) => !text.is_empty() && told.iter().any(holds),
        (Some("refused"), Err(error)) => !text.is_empty() && holds(error),
        _ => false,
    };
    assert!(is_so, "{PAGE}: {example}: {said}, but found {found:?}");
}

#[test]
fn every_example_is_answered_as_the_page_says() {
    let lines = |example: &str| {
        let lines = quoted(example);
        assert!(!lines.is_empty(), "{example}");
        lines.join("\n") + "\n"
    };
    for [_, example, said] in table("## OBJ") {
        let text = format!("{POINTS}{}{FACE}", lines(&example));
        check(&example, &said, answer(&text, None));
    }
    for [_, example, said] in table("## MTL") {
        let mtl = format!("newmtl m\n{}", lines(&example));
        let obj = format!("{POINTS}mtllib m.mtl\nusemtl m\n{FACE}");
        check(&example, &said, answer(&obj, Some(&mtl)));
    }
}

/// Checks the examples of every format whose files are in the corpora, and that the first table
/// lists every format of the code.
#[test]
fn every_file_is_answered_as_the_page_says() {
    for format in ["STL", "PLY", "OFF", "glTF"] {
        let mut count = 0;
        for [_, files, said] in table(&format!("## {format}")) {
            for file in quoted(&files) {
                let bytes = fs::read(root().join("fuzz/corpus").join(file));
                let bytes = bytes.unwrap_or_else(|error| panic!("{file}: {error}"));
                // The ending decides if the bytes do not identify the format.
                let name = format!("t.{}", format.to_lowercase());
                let none = |_: &str| Err(io::ErrorKind::NotFound.into());
                let loaded = parse_mesh(name, &bytes, none);
                let loaded = loaded.map_err(|error| error.to_string());
                check(file, &said, loaded.map(|loaded| sentences(&loaded.notes)));
                count += 1;
            }
        }
        assert!(count > 10, "{count} files of {format}");
    }
    let page = read(PAGE);
    let (_, first) = page.split_once("| format |").expect("the table");
    let first = first.split("\n\n").next().unwrap_or_default();
    for ending in mesh_endings().filter(|ending| ending.len() == 3) {
        let is_there = first.contains(&format!("`.{ending}`"));
        assert!(
            is_there || ending == "vrm",
            "{PAGE} does not list .{ending}"
        );
    }
}

/// Returns the words between quotes in the part of a source from `start` to `end`.
fn literals(path: &str, start: &str, end: &str) -> BTreeSet<String> {
    let source = read(path);
    let (_, part) = source.split_once(start).expect("the start of the part");
    let (part, _) = part.split_once(end).expect("the end of the part");
    let words = part.split('"').skip(1).step_by(2);
    let is_keyword = |word: &&str| {
        let mut letters = word.chars();
        letters.all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
    };
    words.filter(is_keyword).map(str::to_owned).collect()
}

#[test]
fn every_statement_of_the_code_is_on_the_page() {
    let obj = "src/mesh/read/obj/prescan.rs";
    let mut statements = literals(obj, "match &*word {", "fn vector");
    statements.extend(literals("src/mesh/read/obj/lines.rs", "FREE_FORM", "];"));
    let mtl = "src/mesh/read/obj/mtl.rs";
    let mut keys = literals(mtl, "let read = match word {", "fn read_colour");
    keys.extend(literals(mtl, "fn is_texture", "}"));
    assert!(
        statements.len() > 40 && keys.len() > 20,
        "{statements:?} {keys:?}"
    );
    for (heading, known) in [("## OBJ", statements), ("## MTL", keys)] {
        let rows = table(heading);
        let listed = rows.iter().flat_map(|[statement, ..]| quoted(statement));
        let listed: BTreeSet<String> = listed.map(str::to_ascii_lowercase).collect();
        let missing: Vec<_> = known.difference(&listed).collect();
        assert!(missing.is_empty(), "{PAGE} does not list {missing:?}");
    }
}
