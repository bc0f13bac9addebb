//! The rooms of `src`, a folder each. Imports point one way, between rooms and between files.

use crate::markdown::{files, read, root};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::fs;

/// The rooms in order, with the rooms that each may import. These stand before it.
const ROOMS: &[(&str, &[&str])] = &[
    ("picture", &[]),
    ("number", &["picture"]),
    ("mesh", &["picture", "number"]),
    ("scene", &["picture", "number", "mesh"]),
    ("frame", &["picture", "number", "mesh", "scene"]),
    // `number`, `shading` and `raster` must stay out: the reference shares no arithmetic with the
    // engines.
    ("reference", &["picture", "scene", "frame"]),
    (
        "shading",
        &["number", "mesh", "scene", "frame", "reference"],
    ),
    // `painter.rs` needs the reference's exact spans. The engines need nothing of it.
    (
        "raster",
        &[
            "picture",
            "number",
            "scene",
            "frame",
            "reference",
            "shading",
        ],
    ),
    (
        "compare",
        &[
            "picture",
            "number",
            "mesh",
            "scene",
            "frame",
            "reference",
            "shading",
            "raster",
        ],
    ),
    (
        "lectures",
        &[
            "picture",
            "number",
            "mesh",
            "scene",
            "frame",
            "reference",
            "shading",
            "raster",
            "compare",
        ],
    ),
    (
        "report",
        &["picture", "number", "shading", "compare", "lectures"],
    ),
    (
        "cli",
        &[
            "picture",
            "number",
            "mesh",
            "scene",
            "frame",
            "reference",
            "shading",
            "raster",
            "compare",
            "lectures",
            "report",
        ],
    ),
];

/// A module as its path below the root of the crate: `frame/builder`.
type Module = Vec<String>;

/// Splits code into words and punctuation, without comments and quoted text.
fn tokens(source: &str) -> Vec<String> {
    let text: Vec<char> = source.chars().collect();
    let starts = |at: usize, with: &str| {
        with.chars()
            .enumerate()
            .all(|(i, c)| text.get(at + i) == Some(&c))
    };
    let find = |from: usize, end: &str| {
        (from..text.len())
            .find(|&at| starts(at, end))
            .unwrap_or(text.len())
    };
    let mut found: Vec<String> = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let c = text[at];
        if starts(at, "//") {
            at = find(at, "\n");
        } else if starts(at, "/*") {
            at = find(at, "*/") + 2;
        } else if c.is_alphanumeric() || c == '_' {
            let end = (at..text.len())
                .find(|&i| !(text[i].is_alphanumeric() || text[i] == '_'))
                .unwrap_or(text.len());
            found.push(text[at..end].iter().collect());
            at = end;
        } else if c == '"'
            || c == '#' && found.last().is_some_and(|word| word == "r" || word == "br")
        {
            // A string or a raw one: r#"…"#.
            let hashes = text[at..].iter().take_while(|&&c| c == '#').count();
            let raw = found.last().is_some_and(|word| word == "r" || word == "br");
            at += hashes + 1;
            while at < text.len() && !(text[at] == '"' && starts(at + 1, &"#".repeat(hashes))) {
                at += if text[at] == '\\' && !raw { 2 } else { 1 };
            }
            at += hashes + 1;
        } else if c == '\'' && (text.get(at + 1) == Some(&'\\') || text.get(at + 2) == Some(&'\''))
        {
            // A character. A lifetime has no second quote.
            at = find(at + 3 - usize::from(text[at + 1] != '\\'), "'") + 1;
        } else if starts(at, "::") {
            found.push("::".into());
            at += 2;
        } else {
            if !c.is_whitespace() {
                found.push(c.into());
            }
            at += 1;
        }
    }
    found
}

/// Removes test-only items. Returns the names of removed modules that have their own files.
fn remove_tests(tokens: &mut Vec<String>) -> Vec<String> {
    let is = |tokens: &[String], at: usize, word: &str| tokens.get(at).is_some_and(|t| t == word);
    let mut modules = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let is_attribute =
            is(tokens, at, "#") && is(tokens, at + 1, "[") && is(tokens, at + 2, "cfg");
        let end = (at..tokens.len()).find(|&i| tokens[i] == "]").unwrap_or(at);
        // Matches `#[cfg(test)]` and `#[cfg(all(test, …))]`.
        let for_tests = is_attribute
            && (is(tokens, at + 4, "test")
                || is(tokens, at + 4, "all") && is(tokens, at + 6, "test"));
        if !for_tests {
            at += 1;
            continue;
        }
        let mut depth = 0;
        let mut last = end + 1;
        while last < tokens.len() {
            match &*tokens[last] {
                "{" | "(" | "[" => depth += 1,
                "}" | ")" | "]" => depth -= 1,
                _ => (),
            }
            if depth == 0 && (tokens[last] == ";" || tokens[last] == "}") {
                break;
            }
            last += 1;
        }
        let item = &tokens[end + 1..last.min(tokens.len())];
        if let Some(name) = item
            .iter()
            .position(|word| word == "mod")
            .and_then(|i| item.get(i + 1))
        {
            modules.push(name.clone());
        }
        tokens.drain(at..(last + 1).min(tokens.len()));
    }
    modules
}

/// Returns all paths of a file: one per leaf of its `use` trees, and those in code that start with
/// `crate`, `super`, `self` or `fastphong`.
fn paths(tokens: &[String]) -> Vec<(bool, Vec<String>)> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let is_new = at == 0 || tokens[at - 1] != "::";
        match &*tokens[at] {
            "use" => {
                at += 1;
                let mut leaves = Vec::new();
                leaves_of(tokens, &mut at, &mut Vec::new(), &mut leaves);
                found.extend(leaves.into_iter().map(|leaf| (true, leaf)));
            }
            "crate" | "super" | "self" | "fastphong" if is_new => {
                let mut path = vec![tokens[at].clone()];
                while tokens.get(at + 1).is_some_and(|t| t == "::") {
                    path.extend(tokens.get(at + 2).cloned());
                    at += 2;
                }
                found.push((false, path));
                at += 1;
            }
            _ => at += 1,
        }
    }
    found
}

/// Reads a `use` tree to the end of its branch and adds its leaves.
fn leaves_of(
    tokens: &[String],
    at: &mut usize,
    path: &mut Vec<String>,
    leaves: &mut Vec<Vec<String>>,
) {
    let depth = path.len();
    let mut is_leaf = true;
    while let Some(token) = tokens.get(*at) {
        match &**token {
            "," | ";" | "}" => break,
            "::" => *at += 1,
            "{" => {
                is_leaf = false;
                while tokens.get(*at).is_some_and(|t| t != "}") {
                    *at += 1;
                    leaves_of(tokens, at, path, leaves);
                }
                *at += 1;
            }
            // Skip the alias.
            "as" => *at += 2,
            "self" if depth > 0 => *at += 1,
            _ => {
                path.push(token.clone());
                *at += 1;
            }
        }
    }
    if is_leaf && !path.is_empty() {
        leaves.push(path.clone());
    }
    path.truncate(depth);
}

/// Returns the module that a path leads into, or `None` for other crates and local names.
fn target(
    module: &Module,
    in_use: bool,
    path: &[String],
    modules: &BTreeSet<Module>,
) -> Option<Module> {
    let ups = path.iter().take_while(|part| *part == "super").count();
    let all: Module = match &*path[0] {
        "crate" | "fastphong" => path[1..].to_vec(),
        "self" => [module, &path[1..]].concat(),
        "super" => [&module[..module.len().checked_sub(ups)?], &path[ups..]].concat(),
        child if in_use && modules.contains(&[module, &[child.to_string()][..]].concat()) => {
            [module, path].concat()
        }
        _ => return None,
    };
    (1..=all.len())
        .rev()
        .map(|n| all[..n].to_vec())
        .find(|module| modules.contains(module))
}

/// Returns the imports of each file, without tests.
fn imports() -> BTreeMap<Module, BTreeSet<Module>> {
    let module_of = |file: &str| -> Module {
        let path = file.trim_start_matches("src/").trim_end_matches(".rs");
        path.trim_end_matches("/mod")
            .split('/')
            .map(String::from)
            .collect()
    };
    let mut sources = BTreeMap::new();
    let mut for_tests: Vec<Module> = Vec::new();
    for file in files("src", "rs") {
        let module = module_of(&file.to_string_lossy());
        let mut tokens = tokens(&read(&file));
        let tests = remove_tests(&mut tokens);
        for_tests.extend(
            tests
                .into_iter()
                .map(|name| [&module[..], &[name]].concat()),
        );
        if module.len() > 1 || root().join("src").join(&module[0]).is_dir() {
            sources.insert(module, tokens);
        }
    }
    sources.retain(|module, _| !for_tests.iter().any(|tests| module.starts_with(tests)));
    let modules: BTreeSet<Module> = sources.keys().cloned().collect();
    let targets = |module: &Module, tokens: &[String]| {
        paths(tokens)
            .iter()
            .filter_map(|(in_use, path)| target(module, *in_use, path, &modules))
            .filter(|target| target != module)
            .collect()
    };
    sources
        .iter()
        .map(|(module, tokens)| (module.clone(), targets(module, tokens)))
        .collect()
}

/// Returns the shortest way from `from` to `to` along imports.
fn way(
    from: &Module,
    to: &Module,
    imports: &BTreeMap<Module, BTreeSet<Module>>,
) -> Option<Vec<String>> {
    let mut before: BTreeMap<&Module, &Module> = BTreeMap::new();
    let mut queue = VecDeque::from([from]);
    while let Some(here) = queue.pop_front() {
        if here == to {
            let steps = std::iter::successors(Some(here), |module| before.get(module).copied());
            let mut steps: Vec<String> = steps.map(|module| module.join("/")).collect();
            steps.reverse();
            return Some(steps);
        }
        for next in imports.get(here).into_iter().flatten() {
            if next != from && !before.contains_key(next) {
                before.insert(next, here);
                queue.push_back(next);
            }
        }
    }
    None
}

#[test]
fn every_folder_of_src_is_a_room_and_imports_point_one_way() {
    let mut before: Vec<&str> = Vec::new();
    for (room, allowed) in ROOMS {
        for other in *allowed {
            assert!(
                before.contains(other),
                "{room} may import {other}, which does not stand before it"
            );
        }
        before.push(room);
    }
    for entry in fs::read_dir(root().join("src")).expect("src can be read") {
        let name = entry
            .expect("src can be read")
            .file_name()
            .to_string_lossy()
            .into_owned();
        let is_room = before.contains(&&*name) || ["lib.rs", "main.rs"].contains(&&*name);
        assert!(
            is_room,
            "src/{name} is no room: put it into one of {before:?}"
        );
    }
    let mut wrong = Vec::new();
    for (module, targets) in imports() {
        let (_, allowed) = ROOMS
            .iter()
            .find(|(room, _)| *room == module[0])
            .expect("a room");
        for target in targets {
            let is_allowed = module[0] == target[0] || allowed.contains(&&*target[0]);
            if !is_allowed {
                wrong.push(format!(
                    "src/{} imports {}",
                    module.join("/"),
                    target.join("/")
                ));
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "imports that ROOMS does not allow: {wrong:#?}"
    );
}

/// No file imports itself through others, at any distance. Only a parent and its child may import
/// each other.
#[test]
fn no_file_imports_itself_through_others() {
    let is_family = |a: &Module, b: &Module| a.starts_with(b) || b.starts_with(a);
    let mut imports = imports();
    for (module, targets) in &mut imports {
        targets.retain(|target| !is_family(module, target));
    }
    let mut rings = BTreeSet::new();
    for (module, targets) in &imports {
        for target in targets {
            if let Some(ring) = way(target, module, &imports) {
                rings.insert(format!("{} → {}", module.join("/"), ring.join(" → ")));
            }
        }
    }
    assert!(rings.is_empty(), "files that import each other: {rings:#?}");
}
