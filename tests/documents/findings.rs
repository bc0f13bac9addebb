//! Writes `README.md`, `docs/findings.md` and `report/README.md` from the measurements of
//! `docs/findings/run`, or checks that they are current. Also checks the worst cases by drawing
//! them. `docs/findings/page.rs` makes the pages.
//!
//! `FASTPHONG_BLESS=1 cargo test --test documents findings` writes the blocks between
//! `<!-- made: NAME -->` and `<!-- end -->`, and the charts and the picture in
//! `docs/images/findings/`.

#[path = "../../docs/findings/page.rs"]
mod page;

use crate::markdown::{read, root};
use fastphong::shading::{METHODS, Variant};
use fastphong_cli::compare::experiments::WorstCase;
use page::{DEGREES, data, list, text};
use std::fs;

const FILES: [&str; 3] = ["README.md", "docs/findings.md", "report/README.md"];
const IMAGES: &str = "docs/images/findings";

#[test]
fn findings_are_the_measured_figures() {
    let blesses = std::env::var_os("FASTPHONG_BLESS").is_some();
    if blesses && root().join("target/findings/positions-4.json").exists() {
        let times = format!("{:#}\n", page::condensed());
        fs::write(root().join("docs/findings/times.json"), times).expect("a file to write");
    }
    if blesses && root().join("target/findings/report.json").exists() {
        let quiet = serde_json::to_string_pretty(&page::condensed_report()).expect("a summary");
        fs::write(root().join("report/quiet.json"), quiet + "\n").expect("a file to write");
    }
    let images = page::images();
    if blesses {
        for file in FILES {
            fs::write(root().join(file), page::page(read(file))).expect("a file to write");
        }
        fs::create_dir_all(root().join(IMAGES)).expect("a folder");
        for (name, bytes) in images {
            fs::write(root().join(IMAGES).join(name), bytes).expect("a file to write");
        }
        return;
    }
    let how = "write it by FASTPHONG_BLESS=1 cargo test --test documents findings";
    for file in FILES {
        let old = read(file);
        let new = page::page(old.clone());
        assert!(old == new, "{file} differs from what was measured: {how}");
    }
    for (name, bytes) in images.iter().filter(|(name, _)| name.ends_with(".svg")) {
        let stored = fs::read(root().join(IMAGES).join(name)).expect("a chart");
        assert!(
            stored == *bytes,
            "{name} differs from what was measured: {how}"
        );
    }
}

/// With today's methods each worst case has the error that it states.
#[test]
fn worst_cases_are_as_bad_as_stated() {
    let document = data("search");
    let mut compared = 0;
    for found in list(&document, "cases") {
        let case: WorstCase = serde_json::from_value(found.clone()).expect("a case");
        let variant = Variant::parse(text(&found["method"])).expect("a method");
        let levels = case.error(&variant).expect("a case for the method");
        assert!(
            (levels - case.levels).abs() < 1e-3,
            "{variant}, {found}: {levels} levels today"
        );
        compared += 1;
    }
    let floats = METHODS.iter().filter(|entry| !entry.is_integer).count();
    assert_eq!(
        compared,
        floats * 2 * DEGREES.len(),
        "a case a method and setting"
    );
}
