//! Checks the rooms of `src`, one folder each. Imports point one way, between rooms and between
//! files.
//!
//! It finds paths without parsing Rust: a path follows `crate::`, `super::` or `fastphong::`
//! outside comments.

use crate::markdown::{files, is_word, read, root};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// The rooms in order, each with the rooms that it may import. Those must stand before it.
const ROOMS: &[(&str, &str)] = &[
    // `integer` imports nothing: it is everything that a machine without an allocator has.
    ("integer", ""),
    ("picture", ""),
    ("number", "picture"),
    ("mesh", "picture number"),
    ("scene", "picture number mesh"),
    ("frame", "picture number mesh scene"),
    // `number`, `shading` and `raster` must stay out, because the reference shares no arithmetic
    // with the engines.
    ("reference", "picture scene frame"),
    ("shading", "integer number mesh scene frame reference"),
    // `painter_conflicts.rs` needs the reference's exact spans. The engines need nothing from the
    // reference.
    ("raster", "picture number scene frame reference shading"),
    (
        "compare",
        "picture number mesh scene frame reference shading raster",
    ),
    (
        "diagnose",
        "picture number mesh scene frame reference shading raster",
    ),
    (
        "lectures",
        "picture number mesh scene frame reference shading raster compare",
    ),
    ("report", "picture number shading compare lectures"),
    ("view", "picture mesh scene frame shading raster"),
    (
        "cli",
        "picture number mesh scene frame reference shading raster compare diagnose lectures report view",
    ),
];

/// Modules that only tests compile.
const FOR_TESTS: [&str; 3] = ["tests", "test_random", "fixtures"];

/// Adds the paths of a `use` tree behind the path `before`. Returns the text after the tree.
fn add_paths<'a>(before: &str, tree: &'a str, found: &mut Vec<String>) -> &'a str {
    let end = tree.find(|c| !is_word(c) && c != ':' && c != '*');
    let (path, mut rest) = tree.split_at(end.unwrap_or(tree.len()));
    let path = before.to_owned() + path;
    if !(path.ends_with("::") && rest.starts_with('{')) {
        found.push(path);
        return rest;
    }
    rest = &rest[1..];
    loop {
        rest = rest.trim_start_matches([' ', ',']);
        if rest.is_empty() || rest.starts_with('}') {
            return rest.get(1..).unwrap_or_default();
        }
        rest = add_paths(&path, rest, found);
    }
}

/// Returns the paths in a file, without comments and without the tests at its end.
fn paths(source: &str) -> Vec<String> {
    let (code, _) = source
        .split_once("#[cfg(test)]\nmod tests {")
        .unwrap_or((source, ""));
    let lines = code
        .lines()
        .map(|line| line.split("//").next().unwrap_or(line).trim());
    let code = lines.collect::<Vec<_>>().join(" ");
    let mut found = Vec::new();
    for start in ["crate::", "super::", "fastphong::"] {
        for (at, _) in code.match_indices(start) {
            // The second word of `super::super::` does not start a path.
            if !code[..at].ends_with(|c| is_word(c) || c == ':') {
                add_paths("", &code[at..], &mut found);
            }
        }
    }
    found
}

/// Returns the module that a path of `module` leads into.
fn target(module: &str, path: &str, modules: &BTreeSet<&str>) -> Option<String> {
    let ups = path.matches("super::").count();
    let above: Vec<&str> = module.split('/').collect();
    let mut whole = match ups {
        0 => Vec::new(),
        _ => above[..above.len().checked_sub(ups)?].to_vec(),
    };
    whole.extend(path.split("::").skip(ups.max(1)));
    let prefixes = (1..=whole.len()).rev().map(|n| whole[..n].join("/"));
    prefixes
        .into_iter()
        .find(|prefix| modules.contains(&**prefix))
}

/// Returns the imports of each file. Files are named by their modules, as in `frame/builder`.
fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let mut sources = BTreeMap::new();
    for file in files("src", "rs") {
        let path = file.to_string_lossy();
        let module = path
            .trim_start_matches("src/")
            .trim_end_matches(".rs")
            .trim_end_matches("/mod")
            .to_owned();
        let is_in_a_room = root().join("src").join(&module).is_dir() || module.contains('/');
        if is_in_a_room && !module.split('/').any(|part| FOR_TESTS.contains(&part)) {
            sources.insert(module, read(&file));
        }
    }
    let modules: BTreeSet<&str> = sources.keys().map(String::as_str).collect();
    let targets = |module: &str, source: &str| {
        let targets = paths(source)
            .into_iter()
            .filter_map(|path| target(module, &path, &modules));
        targets.filter(|target| target != module).collect()
    };
    sources
        .iter()
        .map(|(module, source)| (module.clone(), targets(module, source)))
        .collect()
}

#[test]
fn every_folder_of_src_is_a_room_and_imports_point_one_way() {
    let mut before: Vec<&str> = Vec::new();
    for (room, allowed) in ROOMS {
        for other in allowed.split_whitespace() {
            assert!(
                before.contains(&other),
                "{room} may import {other}, which does not stand before it"
            );
        }
        before.push(room);
    }
    for entry in fs::read_dir(root().join("src")).expect("src can be read") {
        let file_name = entry.expect("src can be read").file_name();
        let name = file_name.to_string_lossy();
        let is_room = before.contains(&&*name) || ["lib.rs", "main.rs"].contains(&&*name);
        assert!(
            is_room,
            "src/{name} is no room: put it into one of {before:?}"
        );
    }
    let room = |module: &str| module.split('/').next().unwrap_or_default().to_owned();
    let mut wrong = Vec::new();
    for (module, targets) in imports() {
        let here = room(&module);
        let (_, allowed) = ROOMS
            .iter()
            .find(|(room, _)| *room == here)
            .expect("a room");
        for target in targets {
            let there = room(&target);
            if here != there && !allowed.split_whitespace().any(|room| room == there) {
                wrong.push(format!("src/{module} imports {target}"));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "imports that ROOMS does not allow: {wrong:#?}"
    );
}

/// No file imports itself through other files, at any distance. Only a parent and its child may
/// import each other.
#[test]
fn no_file_imports_itself_through_others() {
    let is_within = |a: &str, b: &str| a.strip_prefix(b).is_some_and(|rest| rest.starts_with('/'));
    let mut imports = imports();
    for (module, targets) in &mut imports {
        targets.retain(|target| !is_within(module, target) && !is_within(target, module));
    }
    // Leave out files that import no other file, or that no other file imports, until only rings
    // remain.
    loop {
        let imported: BTreeSet<String> = imports.values().flatten().cloned().collect();
        let files: BTreeSet<String> = imports.keys().cloned().collect();
        imports.retain(|module, targets| {
            targets.retain(|target| files.contains(target));
            !targets.is_empty() && imported.contains(module)
        });
        if imports.len() == files.len() {
            break;
        }
    }
    assert!(
        imports.is_empty(),
        "files that import each other: {imports:#?}"
    );
}
