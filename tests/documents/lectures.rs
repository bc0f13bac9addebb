//! Checks `docs/lectures.md`, which lists all items of the three lectures with their code and their
//! tests or figures.

use crate::markdown::{defines, places, quoted, read, root, rows};
use fastphong_cli::lectures::Figure;
use std::collections::BTreeMap;

/// The count of items in the lectures. The table lists them in the order of their sections.
const ITEMS: usize = 110;

/// The most items that a test or a figure may serve. If it serves more, it shows none of them well.
const MOST: usize = 3;

/// Returns the rows of the table: the item's number, the item, its code, and the tests or figures
/// that show it.
fn items() -> Vec<[String; 4]> {
    let all = rows(&read("docs/lectures.md"));
    let numbered = all
        .into_iter()
        .filter(|row| row[0].parse::<usize>().is_ok());
    numbered
        .map(|row| <[String; 4]>::try_from(row).expect("four cells a row"))
        .collect()
}

#[test]
fn every_item_stands_in_the_table_once_and_in_order() {
    let numbers: Vec<usize> = items()
        .iter()
        .map(|[number, ..]| number.parse().expect("a number"))
        .collect();
    assert_eq!(numbers, (1..=ITEMS).collect::<Vec<_>>());
}

#[test]
fn every_item_is_found_where_listed() {
    for [number, _, code, _] in items() {
        for part in code.split("; ") {
            let Some((file, names)) = part.split_once(':') else {
                let path = part.trim_matches('`');
                assert!(root().join(path).exists(), "{number}: there is no {path}");
                continue;
            };
            let source = read(file.trim_matches('`'));
            let names = quoted(names);
            assert!(!names.is_empty(), "{number}: nothing of {file} is named");
            for name in names {
                assert!(defines(&source, name), "{number}: {file} has no `{name}`");
            }
        }
    }
}

#[test]
fn every_item_is_shown_by_a_test_or_a_figure_that_shows_few_others() {
    let mut served: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for [number, _, _, shown] in items() {
        for part in shown.split("; ") {
            if let Some(name) = part
                .strip_prefix("figure `")
                .and_then(|rest| rest.strip_suffix('`'))
            {
                assert!(
                    Figure::named(name).is_some(),
                    "{number}: there is no figure `{name}`"
                );
                served.entry(part.into()).or_default().push(number.clone());
                continue;
            }
            for (file, tests) in places(part) {
                let source = read(&file);
                assert!(!tests.is_empty(), "{number}: no test of {file} is named");
                for test in tests {
                    let at = source
                        .find(&format!("fn {test}()"))
                        .unwrap_or_else(|| panic!("{number}: {file} has no `{test}`"));
                    let before = source[..at].trim_end();
                    assert!(
                        before.ends_with("#[test]"),
                        "{number}: `{test}` of {file} is no test"
                    );
                    served
                        .entry(format!("{file}: {test}"))
                        .or_default()
                        .push(number.clone());
                }
            }
        }
    }
    for (what, items) in served {
        assert!(
            items.len() <= MOST,
            "{what} serves items {}: {MOST} at most",
            items.join(", ")
        );
    }
}
