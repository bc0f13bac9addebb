//! Checks `docs/methods.md`: it says of every method what the code does not say. `fastphong
//! explain` prints the rest.

use crate::markdown::read;
use fastphong::shading::METHODS;

const FILE: &str = "docs/methods.md";

/// The shortest text of a method, in bytes. It says at least where the method degenerates.
const SHORTEST: usize = 25;

#[test]
fn every_method_has_a_heading_and_a_text_in_the_order_of_the_table() {
    let page = read(FILE);
    let methods = page.split("\n# ").next().expect("a first part");
    let entries = methods
        .split("\n## `")
        .skip(1)
        .map(|entry| entry.split_once("`\n").expect("a heading"));
    let (names, texts): (Vec<&str>, Vec<&str>) = entries.unzip();
    let all: Vec<&str> = METHODS.iter().map(|entry| entry.info.name).collect();
    assert_eq!(names, all, "headings of {FILE}, and methods");
    for (name, text) in names.iter().zip(texts) {
        assert!(text.trim().len() > SHORTEST, "{FILE}: no text of `{name}`");
    }
}

/// The keys of the published methods in the catalogue.
const CATALOGUE: [&str; 35] = [
    "M01", "M02", "M03", "M03b", "M04", "M05", "M05h", "M06", "M07", "M07b", "M08", "M09", "M10",
    "M11", "M11v", "M12", "M12h", "M13", "M14", "M15", "M16", "M17", "M18", "M19", "M20", "M21",
    "M22", "M23", "M24", "M25", "M26", "M27", "M28", "M29", "M30",
];

/// Every published method is drawn by a method of the table, or is left out with a reason.
#[test]
fn every_published_method_is_drawn_or_left_out_with_the_reason() {
    let text = read(FILE);
    let (_, left_out) = text
        .split_once("\n# Left out, with the reason\n")
        .expect("a section");
    let left_out = left_out.split("\n# ").next().expect("a section").lines();
    let left_out = left_out.filter_map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let is_row = cells.get(1).is_some_and(|cell| cell.starts_with('M'));
        is_row.then(|| {
            assert!(cells[3].len() > 20, "{line}: no reason");
            cells[1]
        })
    });
    let drawn = METHODS.iter().flat_map(|entry| entry.info.ids).copied();
    let mut all: Vec<&str> = drawn.chain(left_out).collect();
    all.sort_unstable();
    assert_eq!(all, CATALOGUE);
}
