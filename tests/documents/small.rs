//! Compares the tables of `docs/small.md` with `report/small.json`, which `examples/small/run`
//! writes.

use crate::markdown::read;
use serde_json::Value;

/// Returns numbers with this many decimals, separated by commas.
fn numbers(value: &Value, decimals: usize) -> String {
    let all = value
        .as_array()
        .expect("a list")
        .iter()
        .map(|x| format!("{:.decimals$}", x.as_f64().expect("a number")));
    all.collect::<Vec<_>>().join(", ")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn the_tables_hold_the_measured_figures() {
    let page = read("docs/small.md");
    let data: Value = serde_json::from_str(&read("report/small.json")).expect("JSON");
    let list = |key: &str| data[key].as_array().expect("a list").clone();
    let has = |row: String| assert!(page.contains(&row), "docs/small.md has no row {row}");
    // The page shows some of the measured spans.
    let mut spans = Vec::new();
    for span in list("spans") {
        let row = |in_loop: f64| {
            format!(
                "| `{}` | {} | {} | {in_loop} | {} | {} |",
                span["method"].as_str().expect("a name"),
                numbers(&span["m0p_instructions"], 1),
                numbers(&span["m0p_cycles"], 1),
                numbers(&span["rv32_instructions"], 1),
                numbers(&span["worst_error"], 2),
            )
        };
        // The JSON has one decimal, so it may have been rounded to a half from either side.
        let in_loop = number(&span["m0p_cycles_in_loop"]);
        spans.extend([row(in_loop.round()), row((in_loop - 0.5).ceil())]);
    }
    let (shown, _) = page.split_once("\n## Frames\n").expect("a heading");
    let shown: Vec<&str> = shown
        .lines()
        .filter(|line| line.starts_with("| `"))
        .collect();
    assert!(shown.len() > 12, "{} rows of spans", shown.len());
    for row in shown {
        let is_measured = spans.iter().any(|span| span == row);
        assert!(is_measured, "report/small.json has no row {row}");
    }
    for frame in list("frames") {
        let millions = |key: &str| format!("{:.2} M", number(&frame[key]) / 1e6);
        let error = |key: &str| {
            frame[key]
                .as_f64()
                .map_or(String::new(), |e| format!("{e:.2}"))
        };
        has(format!(
            "| `{}` | {} | {} | {} | {:.0} | {} | {} | {} |",
            frame["method"].as_str().expect("a name"),
            frame["triangles"],
            millions("m0p_instructions"),
            millions("m0p_cycles"),
            133e6 / number(&frame["m0p_cycles"]),
            millions("rv32_instructions"),
            error("worst_error"),
            error("rms_error"),
        ));
    }
    // The first paragraph states these figures.
    let fast = list("spans")
        .into_iter()
        .find(|span| span["method"] == "fast")
        .expect("it is measured");
    let [instructions, cycles] =
        ["m0p_instructions", "m0p_cycles"].map(|key| number(&fast[key][1]).round());
    has(format!(
        "{instructions} instructions and {cycles} cycles a pixel"
    ));
}
