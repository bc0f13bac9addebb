//! Writes the methods' descriptions from the code into `docs/methods.md`, or checks that they are
//! current.
//!
//! `FASTPHONG_BLESS=1 cargo test --test documents methods` writes them. The description stands
//! between a method's heading and the line `<!-- by hand -->`. It comes from `Info` and the
//! constants of the method's `Shader`. The text after that line is written by hand, and this test
//! leaves it alone.

use crate::markdown::read;
use fastphong::number::Counts;
use fastphong::shading::{METHODS, MethodRow};
use std::fmt::Write;

const FILE: &str = "docs/methods.md";
const BY_HAND: &str = "<!-- by hand -->\n";

/// Formats a method's operations with one and with four lights. Equal counts are written once, and
/// rates without operations are left out.
fn operations(entry: &'static MethodRow) -> String {
    let (one, four) = (entry.variant().operations(1), entry.variant().operations(4));
    let cells = |a: Counts, b: Counts| {
        let kinds: [fn(&Counts) -> u32; 8] = [
            |c| c.additions,
            |c| c.multiplications,
            |c| c.divisions,
            |c| c.roots,
            |c| c.comparisons,
            |c| c.trigonometric,
            |c| c.lookups,
            |c| c.powers,
        ];
        assert_eq!(a.powers + b.powers, 0, "the table has no column for powers");
        let cell = |kind: &fn(&Counts) -> u32| match (kind(&a), kind(&b)) {
            (0, 0) => " |".to_string(),
            (a, b) if a == b => format!(" {a} |"),
            (a, b) => format!(" {a} / {b} |"),
        };
        kinds[..7].iter().map(cell).collect::<String>()
    };
    let rates = [
        ("vertex", one.vertex, four.vertex),
        ("polygon", one.polygon, four.polygon),
        ("edge", one.edge, four.edge),
        ("edge and scanline", one.edge_step, four.edge_step),
        ("span", one.span, four.span),
        ("pixel: walk", one.walk, four.walk),
        ("pixel: shade", one.shade, four.shade),
    ];
    let mut table = String::from(
        "| once per | + − | × | ÷ | √ | compare | sin, atan | table |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (rate, one, four) in rates {
        if (one, four) != Default::default() {
            table += &format!("| {rate} |{}\n", cells(one, four));
        }
    }
    table
}

/// Returns the description of a method from the code.
fn described(entry: &'static MethodRow) -> String {
    let info = entry.info;
    let mut text = format!("\n{}.\n\n```text\n{}\n```\n\n", info.title, info.formula);
    let mut say = |head: &str, what: &str| {
        writeln!(text, "**{head}:** {}.\n", what.trim_end_matches('.')).expect("a string");
    };
    let words = [info.family.name(), info.tier.name()];
    let family: Vec<_> = words.iter().chain(info.ids).copied().collect();
    say("Family", &family.join(", "));
    say("Source", info.source);
    say("Where it fails", info.fails);
    let roundings = info.roundings;
    let steps = match roundings.step {
        0.0 => String::new(),
        step => format!(", and {step} more at each step"),
    };
    let error = format!(
        "{} roundings of 2⁻²⁴ against `{}`{steps}: {}",
        roundings.start,
        info.model.name(),
        info.derivation
    );
    say("Error", &error);
    say("Perspective", entry.needs.perspective.sentence());
    say("Lights at positions", entry.needs.local.sentence());
    for p in info.parameters {
        let auto = p
            .auto
            .map_or(String::new(), |auto| format!("; `auto`: {}", auto.meaning));
        let (values, default) = (p.values(), p.text(p.default));
        let what = format!("{}, {values}, default {default}{auto}", p.meaning);
        say(&format!("`{}`", p.name), &what);
    }
    if !entry.kinds().is_empty() {
        say("Kinds of polygons", &entry.kinds().join(", "));
    }
    if let Some(why) = entry.scalar_only() {
        say("Scalar only", why);
    }
    if !info.claimed.is_empty() {
        say("Operations that the source states", info.claimed);
    }
    text + &operations(entry) + "\n"
}

#[test]
fn methods_are_described_as_in_the_code() {
    let old = read(FILE);
    let mut new = old.clone();
    for entry in METHODS {
        let name = entry.info.name;
        let heading = format!("\n## `{name}`\n");
        let place = new.find(&heading);
        let from = place.unwrap_or_else(|| panic!("{FILE} has no heading for `{name}`"));
        let from = from + heading.len();
        let length = new[from..]
            .find(BY_HAND)
            .unwrap_or_else(|| panic!("{FILE}: no `{BY_HAND}` after `{name}`"));
        assert!(
            !new[from..from + length].contains("\n## "),
            "{FILE}: no `{BY_HAND}` for `{name}`"
        );
        new.replace_range(from..from + length, &described(entry));
    }
    let headings = new
        .lines()
        .filter_map(|line| line.strip_prefix("## `")?.strip_suffix('`'));
    for name in headings {
        assert!(
            MethodRow::named(name).is_some(),
            "{FILE} describes `{name}`, which does not exist"
        );
    }
    if std::env::var_os("FASTPHONG_BLESS").is_some() {
        std::fs::write(crate::markdown::root().join(FILE), &new).expect("a file to write");
    } else {
        assert!(
            old == new,
            "{FILE} differs from the code: write it by FASTPHONG_BLESS=1 cargo test --test documents methods"
        );
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
    let left_out = left_out
        .split("\n# ")
        .next()
        .expect("a section")
        .lines()
        .filter_map(|line| {
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
