//! Makes every figure of the lectures, and compares the findings that support its claims with
//! theory.

mod lighting;
mod projection;
mod shading;
mod surfaces;

use fastphong_cli::lectures::{Agreement, FIGURES, Figure, FigureBlock, FigureContent};
use std::collections::BTreeSet;

/// Makes a figure, and checks the properties that every figure must have.
#[track_caller]
fn made(name: &str) -> FigureContent {
    let figure = Figure::find(name).expect("it stands in the table");
    let content = figure.make().expect("what it draws can be drawn");
    assert!(
        !content.blocks.is_empty() && !content.findings.is_empty(),
        "{name} shows nothing"
    );
    let mut keys = BTreeSet::new();
    for finding in &content.findings {
        assert!(
            finding.value.is_finite(),
            "{name}, {}: {}",
            finding.key,
            finding.value
        );
        assert!(
            keys.insert(&finding.key),
            "{name} has two findings called {}",
            finding.key
        );
        assert!(
            finding.verdict.ends_with('.') && !finding.label.is_empty(),
            "{name}, {}: no sentence",
            finding.key
        );
    }
    for block in &content.blocks {
        match block {
            FigureBlock::Text(text) => assert!(!text.is_empty()),
            FigureBlock::Pictures { shown, .. } => assert!(
                shown
                    .iter()
                    .all(|s| !s.alt.is_empty() && !s.caption.is_empty())
            ),
            FigureBlock::Plot(plot) => {
                assert!(
                    (1..=6).contains(&plot.series.len()),
                    "{name}, {}: curves that look alike",
                    plot.title
                );
                assert!(
                    plot.series.iter().all(|s| s.points.len() > 1),
                    "{name}, {}: an empty curve",
                    plot.title
                );
            }
            FigureBlock::Table { head, rows } => {
                assert!(rows.iter().all(|row| row.len() == head.len()), "{name}")
            }
            FigureBlock::Trace { trace, .. } => assert!(!trace.lines.is_empty(), "{name}"),
        }
    }
    content
}

/// Returns the value of a finding.
#[track_caller]
fn value(content: &FigureContent, key: &str) -> f64 {
    content
        .finding(key)
        .unwrap_or_else(|| panic!("no finding {key}"))
        .value
}

#[track_caller]
fn agreement(content: &FigureContent, key: &str) -> Agreement {
    content
        .finding(key)
        .unwrap_or_else(|| panic!("no finding {key}"))
        .agreement
}

#[test]
fn every_figure_has_a_unique_name_and_a_test() {
    let sources = [
        include_str!("shading.rs"),
        include_str!("surfaces.rs"),
        include_str!("lighting.rs"),
        include_str!("projection.rs"),
    ];
    let mut names = BTreeSet::new();
    for figure in FIGURES {
        assert!(
            names.insert(figure.name),
            "two figures are called {}",
            figure.name
        );
        assert!(
            figure
                .name
                .chars()
                .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
        );
        let call = format!("made(\"{}\")", figure.name);
        assert!(
            sources.iter().any(|source| source.contains(&call)),
            "no test makes {}",
            figure.name
        );
    }
    assert!(
        Figure::find("exercise")
            .unwrap_err()
            .contains("did you mean `exercises`?")
    );
}
