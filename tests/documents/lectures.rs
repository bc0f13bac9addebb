//! Checks `docs/lectures.md`, which lists all items of the three lectures with their code and their
//! tests or figures. `tidy.rs` checks its equations.

use crate::markdown::{defines, places, quoted, read, root, rows};
use fastphong_cli::lectures::Figure;
use std::collections::BTreeMap;

/// How many items each lecture has that are no equations.
const ITEMS: [(&str, usize); 3] = [("L21", 35), ("CS171", 26), ("L5", 20)];

/// The most items that a test or a figure may serve. If it serves more, it shows none of them well.
/// Equations don't count: one step computes several of them.
const MOST: usize = 3;

/// Returns the rows of the table: key, item, how, code, and the tests or figures that show it. The
/// key of an item that is no equation is its section.
fn items() -> Vec<[String; 5]> {
    let rows = rows(&read("docs/lectures.md")).into_iter();
    let items = rows.filter(|row| row[0] != "key");
    items
        .map(|row| <[String; 5]>::try_from(row).expect("five cells a row"))
        .collect()
}

/// True if a row has this lecture's section as its key.
fn is_of(lecture: &str, key: &str) -> bool {
    key.split(' ').next() == Some(lecture)
}

#[test]
fn every_item_stands_in_the_table() {
    for (lecture, count) in ITEMS {
        let items = items().into_iter().filter(|[key, ..]| is_of(lecture, key));
        assert_eq!(items.count(), count, "items of {lecture}");
    }
}

#[test]
fn every_item_is_found_where_listed() {
    for [key, item, _, code, _] in items() {
        let what = format!("{key}, {item}");
        for part in code.split("; ") {
            let Some((file, names)) = part.split_once(':') else {
                let path = part.trim_matches('`');
                assert!(root().join(path).exists(), "{what}: there is no {path}");
                continue;
            };
            let source = read(file.trim_matches('`'));
            let names = quoted(names);
            assert!(!names.is_empty(), "{what}: nothing of {file} is named");
            for name in names {
                assert!(defines(&source, name), "{what}: {file} has no `{name}`");
            }
        }
    }
}

#[test]
fn every_item_is_shown_by_a_test_or_a_figure_that_shows_few_others() {
    let mut served: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for [key, item, _, _, shown] in items() {
        let what = format!("{key}, {item}");
        let counts = ITEMS.iter().any(|(lecture, _)| is_of(lecture, &key));
        for part in shown.split("; ") {
            if let Some(name) = part
                .strip_prefix("figure `")
                .and_then(|rest| rest.strip_suffix('`'))
            {
                assert!(
                    Figure::named(name).is_some(),
                    "{what}: there is no figure `{name}`"
                );
                if counts {
                    served.entry(part.into()).or_default().push(what.clone());
                }
                continue;
            }
            for (file, tests) in places(part) {
                let source = read(&file);
                assert!(!tests.is_empty(), "{what}: no test of {file} is named");
                for test in tests {
                    let at = source
                        .find(&format!("fn {test}()"))
                        .unwrap_or_else(|| panic!("{what}: {file} has no `{test}`"));
                    let before = source[..at].trim_end();
                    assert!(
                        before.ends_with("#[test]"),
                        "{what}: `{test}` of {file} is no test"
                    );
                    if counts {
                        let place = format!("{file}: {test}");
                        served.entry(place).or_default().push(what.clone());
                    }
                }
            }
        }
    }
    for (test, items) in served {
        assert!(
            items.len() <= MOST,
            "{test} serves items {}: {MOST} at most",
            items.join("; ")
        );
    }
}
