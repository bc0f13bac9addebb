//! Checks the rooms of the library in `src` and of the program in `program/src`, one folder each.
//! Imports point one way, between rooms and between files.
//!
//! It finds paths without parsing Rust: a path follows `crate::`, `super::` or `fastphong::`
//! outside comments.

use crate::markdown::{files, is_word, quoted, read, root, rows};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// The source folder of the library, and that of the program. The rooms of the program are named
/// `program/ROOM`.
const TREES: [(&str, &str); 2] = [("src", ""), ("program/src", "program/")];

/// The rooms in order, each with the rooms that it may import. Those must stand before it.
const ROOMS: &[(&str, &str)] = &[
    // `integer` imports nothing: it is everything that a machine without an allocator has.
    ("integer", ""),
    ("picture", ""),
    ("number", "picture"),
    ("note", ""),
    ("mesh", "picture number note"),
    ("scene", "picture number note mesh"),
    ("frame", "picture number mesh scene"),
    // `number`, `shading` and `raster` must stay out, because the reference shares no arithmetic
    // with the engines.
    ("reference", "picture scene frame"),
    ("shading", "integer number mesh scene frame reference"),
    // `painter_conflicts.rs` needs the reference's exact spans. The engines need nothing from the
    // reference.
    ("raster", "picture number scene frame reference shading"),
    // One method or the reference, by name.
    ("drawing", "picture number frame reference shading raster"),
    // Estimates of what stages need, for messages instead of a process that is killed.
    ("memory", "number mesh scene frame drawing"),
    ("notes", "number note mesh scene frame reference raster"),
    (
        "compare",
        "picture number mesh scene frame reference shading raster",
    ),
    (
        "program/compare",
        "picture number mesh scene frame reference shading raster compare",
    ),
    (
        "program/diagnose",
        "picture number mesh scene frame reference shading raster",
    ),
    ("program/export", "picture mesh scene frame reference"),
    (
        "program/lectures",
        "picture number mesh scene frame reference shading raster compare program/compare",
    ),
    (
        "program/report",
        "picture number shading compare program/compare program/lectures",
    ),
    ("program/view", "picture mesh scene frame shading raster"),
    (
        "program/cli",
        "picture number note mesh scene frame reference shading raster drawing memory notes compare \
         program/compare program/diagnose program/export program/lectures program/report program/view",
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
    let mut whole = if ups > 0 {
        above[..above.len().checked_sub(ups)?].to_vec()
    } else if above[0] == "program" && path.starts_with("crate::") {
        vec!["program"]
    } else {
        Vec::new()
    };
    whole.extend(path.split("::").skip(ups.max(1)));
    let prefixes = (1..=whole.len()).rev().map(|n| whole[..n].join("/"));
    prefixes
        .into_iter()
        .find(|prefix| modules.contains(&**prefix))
}

/// Returns the imports of each file. Files are named by their modules, as in `frame/builder` or
/// `program/cli/files`.
fn imports() -> BTreeMap<String, BTreeSet<String>> {
    let mut sources = BTreeMap::new();
    for (folder, package) in TREES {
        for file in files(folder, "rs") {
            let path = file.strip_prefix(folder).expect("a file of the folder");
            let path = path.with_extension("");
            let module = path.to_string_lossy();
            let module = module.trim_end_matches("/mod");
            let is_in_a_room = !["lib", "main"].contains(&module);
            if is_in_a_room && !module.split('/').any(|part| FOR_TESTS.contains(&part)) {
                sources.insert(format!("{package}{module}"), read(&file));
            }
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

/// Returns the room of a module.
fn room(module: &str) -> String {
    let is_program = module.starts_with("program/");
    let parts: Vec<&str> = module
        .split('/')
        .take(1 + usize::from(is_program))
        .collect();
    parts.join("/")
}

#[test]
fn every_source_folder_is_a_room_and_imports_point_one_way() {
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
    for (folder, package) in TREES {
        for entry in fs::read_dir(root().join(folder)).expect("the folder can be read") {
            let name = entry.expect("the folder can be read").file_name();
            let name = name.to_string_lossy();
            let room = format!("{package}{}", name.trim_end_matches(".rs"));
            assert!(
                before.contains(&&*room) || ["lib.rs", "main.rs"].contains(&&*name),
                "{folder}/{name} is no room: put it into one of {before:?}"
            );
        }
    }
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
                wrong.push(format!("{module} imports {target}"));
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

/// Returns the names of the items that a source file hides from the documentation.
fn hidden(source: &str) -> Vec<&str> {
    const KEYWORDS: [&str; 9] = [
        "pub", "const", "fn", "struct", "enum", "trait", "type", "mod", "static",
    ];
    let mut found = Vec::new();
    let mut lines = source.lines().map(str::trim);
    while let Some(line) = lines.next() {
        if !line.starts_with("#[doc(hidden)]") {
            continue;
        }
        let item = lines.find(|line| !line.starts_with(['#', '/']));
        let item = item.expect("an item after the attribute");
        if let Some(path) = item.strip_prefix("pub use ") {
            let list = path.rsplit("::").next().unwrap_or(path);
            let names = list.split(|c| !is_word(c));
            found.extend(names.filter(|name| !name.is_empty()));
        } else {
            let mut words = item.split(|c| !is_word(c));
            found.extend(words.find(|word| !word.is_empty() && !KEYWORDS.contains(word)));
        }
    }
    found
}

/// What the library opens for the program is listed, so that the list stays short.
#[test]
fn hidden_items_of_the_library_are_listed() {
    let map = read("docs/architecture.md");
    let (_, section) = map
        .split_once("### What the library hides")
        .expect("a table");
    let (section, _) = section.split_once("\n\nAround").expect("an end");
    let mut listed: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for row in rows(section).into_iter().skip(1) {
        let [room, items, _] = &row[..] else {
            panic!("{row:?}")
        };
        let names = quoted(items).into_iter().map(str::to_owned);
        let room = room.trim_matches('`').to_owned();
        listed.entry(room).or_default().extend(names);
    }
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files("src", "rs") {
        let source = read(&file);
        let names = hidden(&source);
        let room = file.iter().nth(1).expect("a file in src");
        let room = room.to_string_lossy().trim_end_matches(".rs").to_owned();
        if !names.is_empty() {
            let names = names.into_iter().map(str::to_owned);
            found.entry(room).or_default().extend(names);
        }
    }
    for names in listed.values_mut().chain(found.values_mut()) {
        names.sort();
    }
    for room in listed.keys().chain(found.keys()) {
        assert_eq!(
            listed.get(room),
            found.get(room),
            "docs/architecture.md lists the items on the left for `{room}`; the code hides those \
             on the right"
        );
    }
}

/// A package is published with the files of its own folder only. Tests may read others.
#[test]
fn packages_compile_in_only_their_own_files() {
    let mut found = 0;
    for ((folder, _), package) in TREES.into_iter().zip(["", "program"]) {
        for file in files(folder, "rs") {
            let is_test = file
                .iter()
                .any(|part| part == "tests" || part == "tests.rs");
            let source = read(&file);
            let (code, _) = source
                .split_once("#[cfg(test)]\nmod tests {")
                .unwrap_or((&source, ""));
            for call in ["include_str!(", "include_bytes!(", "include!("] {
                for (at, _) in code.match_indices(call).filter(|_| !is_test) {
                    // The text may be the first part of `concat!`.
                    let path = code[at..].split('"').nth(1).expect("a path");
                    let ups = path.matches("../").count();
                    let inner = file.strip_prefix(package).expect("a file of the package");
                    let depth = inner.iter().count() - 1;
                    assert!(ups <= depth, "{}: {path} is outside", file.display());
                    found += 1;
                }
            }
        }
    }
    assert!(found >= 5, "only {found} files are compiled in");
}
