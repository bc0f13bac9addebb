//! The lecture's figures, made anew: each is made, and what a claim of the lecture rests on is what theory says.
#![cfg(feature = "cli")]

use fastphong::figures::{Agreement, Block, Content, FIGURES, Figure};
use fastphong::report::{LectureFigure, figures_page};
use std::collections::BTreeSet;

/// A figure, made, with what every figure must have.
#[track_caller]
fn made(name: &str) -> Content {
    let figure = Figure::find(name).expect("it stands in the table");
    let content = figure.make().expect("what it draws can be drawn");
    assert!(!content.blocks.is_empty() && !content.findings.is_empty(), "{name} shows nothing");
    let mut keys = BTreeSet::new();
    for finding in &content.findings {
        assert!(finding.value.is_finite(), "{name}, {}: {}", finding.key, finding.value);
        assert!(keys.insert(&finding.key), "{name} has two findings called {}", finding.key);
        assert!(finding.verdict.ends_with('.') && !finding.label.is_empty(), "{name}, {}: no sentence", finding.key);
    }
    for block in &content.blocks {
        match block {
            Block::Text(text) => assert!(!text.is_empty()),
            Block::Pictures { shown, .. } => assert!(shown.iter().all(|s| !s.alt.is_empty() && !s.caption.is_empty())),
            Block::Plot(plot) => {
                assert!((1..=6).contains(&plot.series.len()), "{name}, {}: curves that look alike", plot.title);
                assert!(plot.series.iter().all(|s| s.points.len() > 1), "{name}, {}: an empty curve", plot.title);
            }
            Block::Table { head, rows } => assert!(rows.iter().all(|row| row.len() == head.len()), "{name}"),
        }
    }
    let drawn = LectureFigure::new(figure, content.clone()).expect("its pictures can be written");
    let page = figures_page(&[drawn], &["fastphong".into()]);
    assert!(page.len() < 200_000, "{name} takes {} bytes of a page", page.len());
    content
}

/// The value of a finding.
#[track_caller]
fn value(content: &Content, key: &str) -> f64 {
    content.finding(key).unwrap_or_else(|| panic!("no finding {key}")).value
}

#[track_caller]
fn agreement(content: &Content, key: &str) -> Agreement {
    content.finding(key).unwrap_or_else(|| panic!("no finding {key}")).agreement
}

#[test]
fn every_figure_has_a_name_and_a_test_of_its_own() {
    let source = include_str!("figures.rs");
    let mut names = BTreeSet::new();
    for figure in FIGURES {
        assert!(names.insert(figure.name), "two figures are called {}", figure.name);
        assert!(figure.name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'));
        assert!(source.contains(&format!("made(\"{}\")", figure.name)), "no test makes {}", figure.name);
    }
    assert!(Figure::find("exercise").unwrap_err().contains("did you mean `exercises`?"));
}

#[test]
fn exercises() {
    let content = made("exercises");
    // 0.40674 + 0.3 (0.42262 − 0.40674) = 0.411504; the engine adds three steps of an f32, each off by 2⁻²⁵ at most, to
    // a start whose normal is off by as much: below 2⁻²².
    let f32_error = 1.0 / f64::from(1 << 22);
    assert!((value(&content, "sine") - 0.411504).abs() < f32_error);
    // The chord of one degree lies below the sine by at most sin 25° (1°)²/8 = 1.6e-5, and the table is off by 5e-6.
    let error = value(&content, "sine-error");
    assert!(error > 0.0 && error < 1.6e-5 + 5e-6, "{error}");
    assert_eq!(value(&content, "multiplications"), 1.0);
    // Two roundings of 2⁻²⁴ a pixel, over 1023 steps; and they do add up: a walk without drift is not a walk in f32.
    let drift = value(&content, "drift");
    assert!(drift > 1e-7 && drift < 2.0 * 1023.0 / f64::from(1 << 24), "{drift}");
    // The same over 230 pixels at most, and depth itself off by as many roundings, times the density 2.5.
    let levels = value(&content, "fog");
    assert!(levels < 255.0 * (2.0 + 2.5) * 230.0 / f64::from(1 << 24), "{levels}");
    for key in ["sine", "multiplications", "drift", "fog"] {
        assert_eq!(agreement(&content, key), Agreement::Confirms, "{key}");
    }
}

#[test]
fn square() {
    let content = made("square");
    for method in ["gouraud", "naive-phong", "fast-phong", "slerp-phong"] {
        // The middle of the square lies on the diagonal between two white corners at 0°, and between a white and the
        // black one at 90°. Half-way, Gouraud's intensity is ½, that of a normal at 45° is √½: the picture changes by half
        // of white, or by 0.29 of it. Both ways to cut differ there in the same way. The pixels beside the diagonal are
        // half a pixel away, which is less than 3 %.
        let least = 255.0 * (if method == "gouraud" { 0.5 } else { 1.0 - 0.5f64.sqrt() } - 0.03);
        for key in [format!("square-{method}"), format!("diagonals-{method}")] {
            assert!((least..160.0).contains(&value(&content, &key)), "{key}: {}", value(&content, &key));
        }
        let triangles = value(&content, &format!("triangles-{method}"));
        match method {
            // T24: great circles are not barycentric.
            "slerp-phong" => assert!(triangles > 1.0, "{triangles}"),
            // Both orientations round an affine function, over 120 rows and 120 pixels: N, J and K are each off by
            // 240 · 2⁻²⁴; a normal is not shorter than its z, 0.4 here, so that the intensity is off by √3 / 0.4 times that
            // in each. Fast Phong adds e²/2 of the second step of Newton's, after a change of d by 2 % at most: 2e-8.
            _ => assert!(triangles < 255.0 * 2.0 * 4.4 * 240.0 / f64::from(1 << 24), "{method}: {triangles}"),
        }
        let expected = if method == "slerp-phong" { Agreement::Contradicts } else { Agreement::Confirms };
        assert_eq!(agreement(&content, &format!("triangles-{method}")), expected);
    }
    assert!(value(&content, "normals-square") > 10.0);
    // As the intensities: 2 · 4.4 · 240 · 2⁻²⁴ = 1.26e-4 of a radian.
    assert!(value(&content, "normals-triangles") < 1.26e-4f64.to_degrees());
}
