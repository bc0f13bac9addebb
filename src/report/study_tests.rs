//! Tests of what the page says beside its scenes.

use super::page::paragraphs;
use super::tests::{assert_balanced, assert_tables_are_even, report, script_data};
use super::*;
use crate::compare::comparison::RatioData;
use crate::compare::experiments::{Corner, Costs, Curve, MethodSpeedups, Point, Speedup, Work};
use crate::compare::timing::{Ratio, Timing};
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::vec;

fn timing(ns: f64) -> Timing {
    Timing::of(vec![ns; 5], 1).unwrap()
}

/// Methods with how far their pictures are off, and how many times as fast as naive Phong they are in each of four corners,
/// with intervals of 2 % to both sides.
fn speedups(methods: &[(&str, u8, [f64; 4])]) -> Speedups {
    let corner = |(work, scalar): (Work, bool)| {
        let level = if scalar { "scalar" } else { "avx2" };
        Corner {
            work,
            scalar,
            level: level.to_owned(),
            lights: 1,
        }
    };
    let corners = [
        (Work::Kernel, true),
        (Work::Kernel, false),
        (Work::Frame, true),
        (Work::Frame, false),
    ]
    .map(corner);
    let speedup = |ratio: f64| {
        let reach = if ratio == 1.0 { 1.0 } else { 1.02 };
        let ratio_to_naive = Ratio {
            median: ratio,
            low: ratio / reach,
            high: ratio * reach,
        };
        Speedup {
            timing: timing(4e6 / ratio),
            ratio_to_naive: Some(RatioData::from(ratio_to_naive)),
        }
    };
    let naive = ("naive-phong", 0, [1.0; 4]);
    let method = |(name, levels_off, ratios): &(&str, u8, [f64; 4])| MethodSpeedups {
        method: (*name).to_owned(),
        levels_off: *levels_off,
        corners: ratios.iter().map(|ratio| speedup(*ratio)).collect(),
    };
    let methods = core::iter::once(&naive)
        .chain(methods)
        .map(method)
        .collect();
    Speedups {
        mesh: "builtin:<sphere>".into(),
        size: [1920, 1080],
        span: 1024,
        corners: corners.into(),
        methods,
    }
}

/// A sphere in meshes and pictures of several sizes, whose times are exactly those of its costs but for the last one, which
/// is `worst` times that.
fn scaling(worst: f64) -> Scaling {
    let point = |asked: usize, size: [u32; 2], away| {
        let share = if away { 0.02 } else { 0.3 };
        let pixels = (share * f64::from(size[0]) * f64::from(size[1])) as usize;
        let (drawn, spans) = (asked / 2, pixels.min(2 * asked));
        let projection = timing(10.0 * asked as f64);
        Point {
            asked,
            size,
            away,
            vertices: asked / 2,
            triangles: asked,
            drawn,
            spans,
            pixels,
            projection,
        }
    };
    let points = vec![
        point(1_000, [1920, 1080], false),
        point(4_000, [160, 120], false),
        point(4_000, [1920, 1080], false),
        point(4_000, [1920, 1080], true),
        point(1_000_000, [1920, 1080], false),
    ];
    let costs = Costs {
        vertex_ns: 20.0,
        triangle_ns: 50.0,
        span_ns: 0.0,
        pixel_ns: 3.0,
        background_ns: 0.5,
        worst: worst - 1.0,
        worst_point: 4,
    };
    let mut times: Vec<_> = points
        .iter()
        .map(|point| Some(timing(costs.explain(point))))
        .collect();
    times[4] = times[4].as_ref().map(|t: &Timing| timing(worst * t.min_ns));
    let curve = |method: &str, engine: &str, level: &str, costs| Curve {
        method: method.to_owned(),
        engine: engine.to_owned(),
        level: level.to_owned(),
        times: times.clone(),
        costs,
    };
    let lecture = Curve {
        times: vec![times[0].clone(), None, None, None, None],
        ..curve("naive-phong", "span", "scalar", None)
    };
    let curves = vec![curve("naive-phong", "row", "avx2", Some(costs)), lecture];
    Scaling {
        mesh: "builtin:sphere?polygons=N".into(),
        at: [1920, 1080],
        of: 4_000,
        points,
        curves,
    }
}

fn studied(speedups: Option<Speedups>, scaling: Option<Scaling>) -> Report {
    Report {
        studies: Studies { speedups, scaling },
        ..report(vec![])
    }
}

fn first_paragraph(methods: &[(&str, u8, [f64; 4])]) -> String {
    let report = studied(Some(speedups(methods)), None);
    let first = paragraphs(&report).remove(0);
    let html = report.html();
    let shown = html
        .split("<p class=\"opening\">")
        .nth(1)
        .unwrap()
        .split("</p>")
        .next()
        .unwrap()
        .to_owned();
    assert_eq!(
        shown,
        super::html::escape(&first),
        "it is the first paragraph of the page"
    );
    assert!(
        report
            .markdown("images")
            .text
            .starts_with(&format!("# Shading methods compared\n\n{}", &first[..20]))
    );
    first
}

#[test]
fn where_naive_phong_wins_is_said_first() {
    let said = first_paragraph(&[
        ("gouraud", 90, [5.0; 4]),
        ("fast-phong", 0, [1.7, 1.02, 0.99, 0.7]),
        ("fast-phong-rsqrt", 1, [1.9, 1.75, 1.3, 0.95]),
    ]);
    let expected = "Naive Phong wins in whole frames on AVX2 (fast Phong takes 1.43 times as long): it is the fastest method \
                    there that draws its picture to one grey level. ";
    assert!(said.starts_with(expected), "{said}");
    let kernel = "In spans of 1,024 pixels in scalar code fast-phong-rsqrt is the fastest that does, 1.90 times as fast (fast \
                  Phong is 1.70 times as fast).";
    assert!(said.contains(kernel), "{said}");
    assert!(said.contains(
        "on AVX2 fast-phong-rsqrt is the fastest that does, 1.75 times as fast (fast Phong is level with it)"
    ));
    let rsqrt = "Naive Phong is not beaten in whole frames on AVX2 (fast-phong-rsqrt is level with it, fast Phong takes 1.43";
    let level = first_paragraph(&[
        ("fast-phong", 0, [1.7, 1.02, 0.99, 0.7]),
        ("fast-phong-rsqrt", 1, [1.9, 1.75, 1.3, 1.01]),
    ]);
    assert!(level.starts_with(rsqrt), "{level}");
    let left = "gains a factor of 1.70 in the terms in which it was invented, arithmetic one pixel at a time, and nothing (it \
                takes 1.43 times as long) in whole frames on AVX2 today.";
    assert!(said.contains(left), "{said}");
    assert!(!said.contains("gouraud"), "its picture is another one");
}

#[test]
fn where_fast_phong_wins_naive_phong_is_not_said_to() {
    let said = first_paragraph(&[
        ("fast-phong", 1, [1.7, 1.5, 1.3, 1.2]),
        ("flat", 200, [9.0; 4]),
    ]);
    assert!(said.starts_with("Naive Phong wins nowhere"), "{said}");
    assert!(
        said.contains(
            "In whole frames on AVX2 fast Phong is the fastest that does, 1.20 times as fast."
        ),
        "{said}"
    );
    assert!(
        said.contains("and a factor of 1.20 in whole frames on AVX2 today."),
        "{said}"
    );
}

#[test]
fn ties_are_no_victories_and_other_pictures_no_rivals() {
    // 1.01 with 2 % to both sides holds 1; in the other corners naive Phong wins.
    let said = first_paragraph(&[("fast-phong", 0, [0.5, 0.5, 1.01, 0.5])]);
    let level = "Naive Phong is not beaten in whole frames in scalar code (fast Phong is level with it): no method that";
    assert!(said.contains(level), "{said}");
    let wins = "Naive Phong wins in spans of 1,024 pixels in scalar code (fast Phong takes 2.00 times as long), spans of";
    assert!(said.starts_with(wins), "{said}");
    let alone = studied(Some(speedups(&[("gouraud", 90, [5.0; 4])])), None);
    assert!(
        !paragraphs(&alone).concat().contains("Naive Phong"),
        "there is nobody to compare with"
    );
}

#[test]
fn the_four_corners_are_a_table_and_a_picture() {
    let methods = [
        ("gouraud", 90, [5.0, 6.0, 3.0, 1.3]),
        ("fast-phong", 0, [1.7, 1.5, 1.3, 0.7]),
    ];
    let report = studied(Some(speedups(&methods)), None);
    let html = report.html();
    assert_balanced(&html);
    let part = html
        .split("<section id=\"speedups\">")
        .nth(1)
        .unwrap()
        .split("</section>")
        .next()
        .unwrap();
    assert!(
        part.contains("<th scope=\"row\">gouraud *</th>")
            && part.contains("<th scope=\"row\">fast-phong</th>"),
        "{part}"
    );
    assert!(part.contains("* draws another picture") && part.contains("builtin:&lt;sphere&gt;"));
    // 4 ms of a frame, and 4 ms of a span of 1,024 pixels, divided by the ratio.
    assert!(
        part.contains("<td>5.71 ± 0.00<small class=\"slower\">0.70 (0.69–0.71)</small></td>"),
        "{part}"
    );
    assert!(
        part.contains("<td>2298 ± 0<small class=\"faster\">1.70 (1.67–1.73)</small></td>"),
        "{part}"
    );
    assert_eq!(part.matches("<path class=\"interval\"").count(), 2 * 4);
    assert!(html.contains("<a href=\"#speedups\">") && !html.contains("id=\"scaling\""));
    let markdown = report.markdown("images").text;
    assert_tables_are_even(&(markdown.clone() + &"\n\n| a |\n|---|".repeat(4)));
    assert!(
        markdown.contains("| gouraud \\* | 90 |") && markdown.contains("; 0.70 (0.69–0.71) |"),
        "{markdown}"
    );
}

#[test]
fn growth_is_called_linear_when_it_is() {
    let said = |worst| scaling::growth(&self::scaling(worst));
    assert!(
        said(1.05).starts_with(
            "Cost grows linearly in vertices, triangles, spans and pixels, from 1,000 to"
        ),
        "{}",
        said(1.05)
    );
    assert!(
        said(1.05).contains("from 160 × 120 to 1920 × 1080 pixels")
            && said(1.05).contains("is 105 % of it")
    );
    assert!(
        said(0.8).starts_with("Cost grows nearly linearly") && said(0.8).contains("is 80 % of it"),
        "{}",
        said(0.8)
    );
    assert!(
        said(1.8).starts_with("Cost does not grow linearly throughout"),
        "{}",
        said(1.8)
    );
    let mut unknown = self::scaling(1.0);
    unknown.curves.remove(0);
    assert!(scaling::growth(&unknown).starts_with("There are too few points"));
}

#[test]
fn growth_is_two_plots_and_two_tables() {
    let report = studied(None, Some(scaling(1.2)));
    let html = report.html();
    assert_balanced(&html);
    let part = html
        .split("<section id=\"scaling\">")
        .nth(1)
        .unwrap()
        .split("</section>")
        .next()
        .unwrap();
    assert_eq!(
        (part.matches("<svg").count(), part.matches("<table").count()),
        (2, 2)
    );
    assert!(part.contains(
        "<td>20.0</td><td>50.0</td><td>0</td><td>3.00</td><td>0.500</td><td>+20 % (1,000,000 triangles, 1920"
    ));
    assert!(
        part.contains(
            "naive-phong, the lecture’s own form</th><td>span engine, scalar</td><td>–</td>"
        ),
        "{part}"
    );
    assert!(
        part.contains("4,000</th><td>1920 × 1080, from afar</td>"),
        "{part}"
    );
    // Along triangles three points of one curve and one of the other, along pixels two; and one each in the legends.
    let marks = part.matches("class=\"mark ").count();
    assert_eq!(marks, 3 + 1 + 2 + 2 + 2, "{part}");
    let markdown = report.markdown("images").text;
    assert!(
        markdown.contains("## How cost grows") && markdown.contains("| 1,000,000 | 1920 × 1080 |"),
        "{markdown}"
    );
}

#[test]
fn studies_are_data_of_the_page() {
    let (speedups, scaling) = (speedups(&[("fast-phong", 0, [1.5; 4])]), scaling(1.2));
    let html = studied(Some(speedups.clone()), Some(scaling.clone())).html();
    let data: serde_json::Value = serde_json::from_str(script_data(&html)).unwrap();
    assert_eq!(
        serde_json::from_value::<Speedups>(data["speedups"].clone()).unwrap(),
        speedups
    );
    assert_eq!(
        serde_json::from_value::<Scaling>(data["scaling"].clone()).unwrap(),
        scaling
    );
    assert_eq!(
        data["speedups"]["corners"][1],
        serde_json::json!({"work": "kernel", "scalar": false, "level": "avx2", "lights": 1})
    );
    let none: serde_json::Value =
        serde_json::from_str(script_data(&studied(None, None).html())).unwrap();
    assert!(none["speedups"].is_null() && none["scaling"].is_null());
}
