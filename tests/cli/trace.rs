//! `fastphong trace`: its document, and the scenes that it refuses.

use super::{Folder, SPHERE};
use fastphong::picture::image_file::read_picture;
use serde_json::Value;
use std::collections::BTreeSet;

/// Adds the names of all fields of `value` to `to`.
fn fields(value: &Value, to: &mut BTreeSet<String>) {
    for (name, value) in value.as_object().into_iter().flatten() {
        to.insert(name.clone());
        fields(value, to);
    }
    let all = value.as_array().into_iter().flatten();
    all.for_each(|value| fields(value, to));
}

#[test]
fn traced_colours_equal_those_that_render_stores() {
    let folder = Folder::new();
    for method in ["gouraud", "fast-phong:steps=1", "integer-fast"] {
        let how = format!("{SPHERE} -m {method}");
        let render = format!("render {how} --engine span --simd scalar -o out.pfm");
        folder.run(&render).done();
        let picture = read_picture(&folder.path("out.pfm"))
            .expect("a picture")
            .to_linear();
        let trace = folder.run(&format!("trace {how}")).done().json();
        let mut pixels = 0;
        for line in trace["lines"].as_array().expect("lines") {
            let y = line["y"].as_u64().expect("a line") as usize;
            for run in line["runs"].as_array().expect("runs") {
                let x = run["x"].as_u64().expect("a pixel") as usize;
                for (i, colour) in run["colours"]
                    .as_array()
                    .expect("colours")
                    .iter()
                    .enumerate()
                {
                    let stored = picture.get(x + i, y);
                    for c in 0..3 {
                        let traced = colour[c].as_f64().expect("a number") as f32;
                        assert_eq!(traced.to_bits(), stored[c].to_bits(), "{method}: {x}, {y}");
                    }
                    pixels += 1;
                }
            }
        }
        assert!(pixels > 500, "{method}: {pixels}");
    }
}

#[test]
fn the_description_names_every_field() {
    let description = include_str!("../../docs/trace.md");
    let (folder, mut all) = (Folder::new(), BTreeSet::new());
    let cases = [
        "coarse-sphere -m fast-phong:steps=2",
        "coarse-sphere -m naive-phong",
        "coarse-sphere -m slerp-phong",
        "coarse-sphere -m cubic-phong",
        "coarse-sphere -m slerp-chebyshev",
        "coarse-sphere -m flat",
        "football -m adaptive-phong",
        "local-lights -m naive-phong",
    ];
    for case in cases {
        let trace = folder.run(&format!("trace {case} --resolution 32x24"));
        fields(&trace.done().json(), &mut all);
    }
    for field in &all {
        assert!(
            description.contains(&format!("`{field}`")),
            "`{field}` is not described"
        );
    }
    assert!(all.len() > 60, "all parts were met: {all:?}");
}

#[test]
fn the_trace_of_one_line_holds_the_polygons_that_the_line_meets() {
    let folder = Folder::new();
    let whole = folder.run(&format!("trace {SPHERE}")).done().json();
    let line = folder
        .run(&format!("trace {SPHERE} --line 20"))
        .done()
        .json();
    let count = |trace: &Value, list: &str| trace[list].as_array().expect("a list").len();
    assert_eq!(count(&line, "lines"), 1);
    assert!(count(&line, "polygons") < count(&whole, "polygons"));
    // The line equals line 20 of the whole trace but for polygon indices.
    let of = |trace: &Value, y: usize| {
        let runs = trace["lines"][y]["runs"].as_array().expect("runs").iter();
        runs.map(|run| {
            (
                run["x"].clone(),
                run["values"].clone(),
                run["colours"].clone(),
            )
        })
        .collect::<Vec<_>>()
    };
    assert_eq!(of(&line, 0), of(&whole, 20));
    let sources = |trace: &Value, y: usize| {
        let spans = trace["lines"][y]["spans"].as_array().expect("spans").iter();
        let polygon = |span: &Value| span["polygon"].as_u64().expect("an index") as usize;
        spans
            .map(|span| trace["polygons"][polygon(span)]["source"].clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(sources(&line, 0), sources(&whole, 20));
}

#[test]
fn scenes_that_cannot_be_traced_are_refused_with_the_limit() {
    let folder = Folder::new();
    let trace = |flags: &str| folder.run(&format!("trace {flags}"));
    trace("coarse-sphere").refused(&["640x480 samples", "at most 64x64", "--line"]);
    trace("coarse-sphere --resolution 32x48 --samples 2")
        .refused(&["64x96 samples, 2 × 2 a pixel", "at most 64x64"]);
    trace("million --resolution 64x48").refused(&[
        "polygons are in view",
        "at most 10000",
        "--line",
    ]);
    trace(&format!("{SPHERE} --line 48")).refused(&["--line 48", "at most 47"]);
    trace(&format!("{SPHERE} -m reference")).refused(&["reference"]);
    trace("local-lights --resolution 32x24 -m integer-fast").refused(&["`integer-fast`"]);
    trace(&format!("{SPHERE} -o out.png")).refused(&["out.png", "JSON"]);
    trace("nothing.toml").refused(&["nothing.toml"]);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
    trace(&format!("{SPHERE} -o out.json"))
        .done()
        .prints("out.json");
    let written: Value = serde_json::from_slice(&folder.read("out.json")).expect("JSON");
    assert_eq!(written["schema"], "fastphong.trace/1");
}
