use super::*;
use crate::compare::timing::Ratio;
use crate::report::tables;
use serde_json::json;

/// A method: its variant, the low end, the typical value and the high end of its speed, and its
/// error in levels.
type Row = (&'static str, [f64; 3], f64);

const NAIVE: Row = ("naive-phong", [1.0; 3], 0.0);

fn ratio([low, typical, high]: [f64; 3]) -> Value {
    json!(Ratio::new(low, typical, high))
}

fn noise(trust: &str, interrupted: f64) -> Value {
    let sentence =
        "too busy to tell: ± 12 %. Run again with --time-budget 10, or on an idle machine";
    json!({ "trust": trust, "clock": "thread", "interrupted": interrupted, "sentence": sentence })
}

fn scene(title: &str, level: &str, rows: &[Row]) -> Value {
    let row = |(variant, speed, levels): &Row| {
        json!({
            "variant": variant, "engine": "span", "error": { "max": levels / 255.0 },
            "speed": { "timing": { "typical_ns": 2e6 }, "ratio_to_naive": ratio(*speed) }
        })
    };
    let rows: Vec<Value> = rows.iter().map(row).collect();
    json!({ "title": title, "renderer": { "level": level }, "rows": rows, "noise": noise("busy", 0.4) })
}

/// Makes a document of scenes, timed by an optimised build.
fn document(scenes: &[Value]) -> Value {
    json!({
        "command_line": ["fastphong", "report"], "date": "2026-11-28", "comparisons": scenes,
        "machine": { "cpu": "Slow & Noisy", "profile": "release" }
    })
}

/// Makes the experiment `speedups` with one corner, whole frames with AVX2.
fn study(rows: &[Row]) -> Value {
    let method = |(variant, speed, levels): &Row| json!({ "method": variant, "levels_off": levels, "corners": [{ "ratio_to_naive": ratio(*speed) }] });
    let methods: Vec<Value> = rows.iter().map(method).collect();
    let corner = json!({ "work": "frame", "scalar": false, "level": "avx2", "lights": 1 });
    json!({ "corners": [corner], "methods": methods, "noise": noise("quiet", 0.0) })
}

/// Returns the sentences under a heading, with no-break spaces as spaces.
#[track_caller]
fn said(data: &Value, head: &str) -> String {
    let all = sentences(&Summary::of(data));
    let found = all.iter().find(|(of, _)| of == head);
    found.expect(head).1.replace('\u{A0}', " ")
}

/// Returns what one scene with these methods says of scalar code.
#[track_caller]
fn scalar(rows: &[Row]) -> String {
    let rows = [&[NAIVE], rows].concat();
    said(&document(&[scene("A", SCALAR, &rows)]), "Scalar code")
}

#[test]
fn the_fastest_method_with_the_picture_is_named_with_its_interval() {
    let rows = [
        ("gouraud", [4.9, 5.0, 5.1], 90.0),
        ("fast-phong", [0.88, 0.9, 0.92], 0.1),
        ("phong-rsqrt", [1.05, 1.08, 1.11], 0.1),
        ("duff-phong", [1.22, 1.25, 1.28], 0.2),
    ];
    assert_eq!(
        scalar(&rows),
        "For naive Phong’s picture in the least time, use `duff-phong`. It is 1.25 × (1.22 to 1.28) as fast as naive Phong in this scene. \
         The lecture’s `fast-phong` is slower than naive Phong: 0.90 × (0.88 to 0.92)."
    );
}

#[test]
fn two_methods_that_intervals_do_not_separate_are_a_tie() {
    let text = scalar(&[
        ("phong-rsqrt", [1.05, 1.10, 1.15], 0.1),
        ("duff-phong", [1.12, 1.25, 1.38], 0.2),
    ]);
    let expected = "use `duff-phong` or `phong-rsqrt`, which are tied. `duff-phong` is about 1.2 × (1.12 to 1.38) as fast";
    assert!(text.contains(expected), "{text}");
}

#[test]
fn of_four_tied_methods_two_are_named() {
    let text = scalar(&[
        ("phong-rsqrt", [1.05, 1.10, 1.30], 0.1),
        ("series-phong", [1.10, 1.22, 1.30], 0.1),
        ("adaptive-phong", [1.10, 1.21, 1.30], 0.1),
        ("duff-phong", [1.12, 1.25, 1.38], 0.2),
        ("eye-frame-phong", [1.01, 1.03, 1.05], 0.2),
    ]);
    let expected = "use `duff-phong`, `series-phong` or 2 more, which are tied. `duff-phong` is";
    assert!(text.contains(expected), "{text}");
}

#[test]
fn nothing_is_called_faster_whose_interval_contains_one() {
    let text = scalar(&[
        ("duff-phong", [0.96, 1.25, 1.6], 0.2),
        ("fast-phong", [0.8, 0.99, 1.2], 0.2),
    ]);
    assert_eq!(
        text,
        "For naive Phong’s picture, nothing is faster than `naive-phong` beyond doubt in this scene. \
         The lecture’s `fast-phong` ties with naive Phong: about 1.0 × (0.80 to 1.20)."
    );
    // A method that might be slower than naive Phong is not the best, but may be the fastest.
    let text = scalar(&[
        ("duff-phong", [0.96, 1.25, 1.6], 0.2),
        ("phong-rsqrt", [1.08, 1.1, 1.12], 0.2),
    ]);
    let expected = "use `phong-rsqrt` or `duff-phong`, which are tied. `phong-rsqrt` is 1.10 ×";
    assert!(text.contains(expected), "{text}");
    // The interval for `tie` is wider than the one that is shown.
    let text = scalar(&[("duff-phong", [1.01, 1.1, 1.2], 0.2)]);
    assert!(text.contains("nothing is faster"), "{text}");
}

#[test]
fn speeds_over_scenes_are_geometric_means_of_values_and_intervals() {
    let scenes = [
        scene("A", SCALAR, &[("duff-phong", [1.9, 2.0, 2.1], 0.5)]),
        scene("B", SCALAR, &[("duff-phong", [7.6, 8.0, 8.4], 0.25)]),
    ];
    let summary = Summary::of(&document(&scenes));
    let error = &summary.methods[0];
    assert_eq!((error.levels, &*error.scene, error.place), (0.5, "A", 0));
    let speeds = summary.scalar.expect("scalar code");
    assert_eq!(speeds.frames, "over 2 scenes");
    let Ratio {
        low, typical, high, ..
    } = speeds.methods[0].speed;
    for (mean, of) in [(low, 1.9 * 7.6), (typical, 2.0 * 8.0), (high, 2.1 * 8.4)] {
        assert!((mean * mean - of).abs() < 1e-9, "{mean}");
    }
    // Scenes with opposite results are no gain.
    let scenes = [
        scene("A", SCALAR, &[("duff-phong", [1.1, 1.2, 1.3], 0.5)]),
        scene("B", SCALAR, &[("duff-phong", [0.7, 0.8, 0.9], 0.5)]),
    ];
    let text = said(&document(&scenes), "Scalar code");
    assert!(
        text.contains("nothing is faster than `naive-phong` beyond doubt over 2"),
        "{text}"
    );
}

#[test]
fn pictures_are_told_with_the_worst_scene_of_each_method() {
    let rows = |fast| {
        [
            NAIVE,
            ("gouraud", [4.9, 5.0, 5.1], 90.0),
            ("fast-phong", [0.8, 0.9, 1.0], fast),
            ("six-point", [0.8, 0.9, 1.0], 2.5),
            ("duff-phong", [1.2, 1.25, 1.3], 0.2),
            ("phong-rsqrt", [1.2, 1.25, 1.3], 0.1),
        ]
    };
    let data = document(&[
        scene("A", SCALAR, &rows(3.0)),
        scene("B", SCALAR, &rows(106.0)),
    ]);
    assert_eq!(
        said(&data, "The picture"),
        "`duff-phong` and `phong-rsqrt` draw naive Phong’s picture within 1 grey level in all 2 scenes. The lecture’s `fast-phong` is \
         off by up to 106 levels in B. Others are off by 2.50 (`six-point` in B) to 90.0 levels (`gouraud` in B)."
    );
    let html = html(&data, &quiet());
    let link = "<a data-scene=\"1\" data-of=\"fast-phong\">B</a>";
    assert!(html.contains(link), "{html}");
    let data = document(&[scene("A", SCALAR, &[NAIVE, ("flat", [2.0; 3], 254.0)])]);
    assert_eq!(
        said(&data, "The picture"),
        "No other method draws naive Phong’s picture within 1 grey level in this scene. `flat` is off by up to 254 levels."
    );
    let text = said(&data, "Scalar code");
    assert_eq!(
        text,
        "No other method that was timed draws naive Phong’s picture in this scene."
    );
}

#[test]
fn pictures_of_all_scenes_decide_for_simd_too() {
    let rows = [
        NAIVE,
        ("fast-phong", [1.04, 1.05, 1.06], 3.0),
        ("phong-rsqrt", [1.1, 1.15, 1.2], 0.1),
    ];
    let mut data = document(&[scene("A", SCALAR, &rows)]);
    assert_eq!(Summary::of(&data).simd, None);
    assert_eq!(cards(&Summary::of(&data), None).len(), 2, "no card of SIMD");
    data["speedups"] = study(&[
        NAIVE,
        ("fast-phong", [1.75, 1.8, 1.85], 1.0),
        ("phong-rsqrt", [1.44, 1.5, 1.56], 1.0),
        ("gouraud", [8.0, 9.0, 10.0], 80.0),
    ]);
    let text = said(&data, "SIMD, AVX2");
    assert!(
        text.contains(
            "use `phong-rsqrt`. It is 1.5 × (1.44 to 1.56) as fast as naive Phong on one sphere."
        ),
        "{text}"
    );
    assert!(
        text.contains("`fast-phong` is faster than naive Phong: 1.8 ×"),
        "{text}"
    );
    // Scenes that were drawn with SIMD say more than one sphere.
    data["comparisons"][0] = scene("A", "avx512", &rows);
    let text = said(&data, "SIMD, AVX-512");
    let expected =
        "use `phong-rsqrt`. It is 1.15 × (1.10 to 1.20) as fast as naive Phong in this scene";
    assert!(text.contains(expected), "{text}");
    assert_eq!(Summary::of(&data).scalar, None);
}

#[test]
fn on_a_machine_that_was_too_busy_speeds_are_withheld_and_errors_told() {
    let rows = [NAIVE, ("duff-phong", [1.22, 1.25, 1.28], 0.2)];
    let mut data = document(&["A", "B", "C"].map(|name| scene(name, SCALAR, &rows)));
    data["comparisons"][1]["noise"] = noise("too-busy", 0.64);
    let text = said(&data, "Scalar code");
    let rest = "It is 1.25 × (1.22 to 1.28) as fast as naive Phong over 2 of 3 scenes.";
    assert!(text.contains(rest), "{text}");
    data["comparisons"][2]["noise"] = noise("too-busy", 0.1);
    let text = said(&data, "Scalar code");
    assert!(
        text.starts_with("Too busy to tell: ± 12 %. Run again"),
        "{text}"
    );
    let text = said(&data, "The picture");
    assert!(
        text.starts_with("`duff-phong` draws naive Phong’s picture"),
        "{text}"
    );
    // The other scene keeps its speeds.
    let tables = tables::all(&data);
    let speeds = |table: usize| {
        tables[table]
            .table
            .rows
            .iter()
            .map(|row| &**row.last().unwrap())
    };
    assert!(speeds(0).chain(speeds(2)).all(|cell| cell == "–"));
    assert_eq!(speeds(1).collect::<Vec<_>>(), ["1.00", "1.25 (1.22–1.28)"]);
    assert!(
        tables[2].noise.starts_with("too busy to tell: "),
        "{}",
        tables[2].noise
    );
    let html = html(&data, &quiet());
    assert!(
        html.contains("Too busy to tell") && html.contains(">A quiet "),
        "{html}"
    );
    assert!(!html.contains(">This run"), "{html}");
    // The experiment has its own noise.
    data["speedups"] = study(&rows);
    assert!(said(&data, "SIMD, AVX2").contains("use `duff-phong`"));
    data["speedups"]["noise"] = noise("too-busy", 0.5);
    assert!(said(&data, "SIMD, AVX2").starts_with("Too busy to tell: "));
}

#[test]
fn gaps_are_told() {
    let rows = [NAIVE, ("duff-phong", [1.22, 1.25, 1.28], 0.2)];
    let mut data = document(&[scene("A", SCALAR, &rows)]);
    data["machine"]["profile"] = "debug".into();
    let text = said(&data, "Scalar code");
    let debug = "Built without optimisation, so these times say nothing. For naive";
    assert!(text.starts_with(debug), "{text}");
    for row in data["comparisons"][0]["rows"].as_array_mut().unwrap() {
        row["speed"] = Value::Null;
    }
    assert_eq!(said(&data, "Scalar code"), "No times were taken.");
    data["comparisons"] = json!([]);
    assert_eq!(
        html(&data, &quiet()),
        "<p class=\"answer\">Nothing was compared.</p>"
    );
    let points = markdown(&data, &quiet());
    assert_eq!(
        points,
        [("Answer".to_string(), "Nothing was compared.".to_string())]
    );
}

#[test]
fn the_quiet_run_stands_beside_this_one() {
    let mut beside = document(&[scene(
        "A",
        SCALAR,
        &[NAIVE, ("phong-rsqrt", [1.3, 1.33, 1.36], 0.1)],
    )]);
    beside["machine"]["cpu"] = "Calm <CPU>".into();
    beside["date"] = "2026-12-01".into();
    beside["speedups"] = study(&[NAIVE, ("phong-rsqrt", [1.4, 1.5, 1.6], 0.0)]);
    let beside = Summary::of(&beside);
    let own = document(&[scene(
        "A",
        SCALAR,
        &[NAIVE, ("duff-phong", [1.22, 1.25, 1.28], 0.2)],
    )]);
    let html = html(&own, &beside);
    for text in [
        "<small>This run in this scene</small>",
        "<small>A quiet Calm &lt;CPU&gt;, 2026-12-01, in this scene</small>",
        "<span>1.25\u{A0}× (1.22–1.28) <b class=\"good\">faster</b></span>",
        "<span>1.33\u{A0}× (1.30–1.36) <b class=\"good\">faster</b></span>",
        // No study here, so only the quiet run speaks of SIMD.
        "<h2>SIMD</h2><div class=\"gains\"><small>A quiet Calm &lt;CPU&gt; with AVX2, 2026-12-01, on one sphere</small>",
    ] {
        assert!(html.contains(text), "{text}: {html}");
    }
    let answer = "<div class=\"answer\"><p>For naive Phong’s picture in the least time, use <a class=\"m\" data-m=\"duff-phong\"";
    assert!(html.contains(answer), "{html}");
    let points = markdown(&own, &beside);
    let scalar = &points[1].1;
    let quiet = "On a quiet Calm &lt;CPU>, 2026-12-01: For naive Phong’s picture in the least time, use Phong rsqrt. It is ";
    assert!(scalar.contains(quiet), "{scalar}");
    assert!(
        points[2].1.starts_with("On a quiet Calm"),
        "{}",
        points[2].1
    );
}

#[test]
fn a_bar_that_leaves_the_scale_ends_in_an_arrow() {
    let speed = |low, high| Ratio {
        typical: (low + high) / 2.0,
        low,
        high,
        tie: false,
    };
    for (low, high, drawn) in [
        (1.0, 2.0, "<i style=\"left:50.0%;width:50.0%\"></i>"),
        (1.0, 1.001, "<i style=\"left:50.0%;width:2.0%\"></i>"),
        (0.3, 1.0, "<s>◂</s><i style=\"left:0.0%;width:50.0%\"></i>"),
        (
            1.999,
            4.0,
            "<i style=\"left:98.0%;width:2.0%\"></i><u>▸</u>",
        ),
        (5.0, 6.0, "<u>▸</u>"),
        (0.1, 0.2, "<s>◂</s>"),
    ] {
        assert_eq!(bar(&speed(low, high)), drawn, "{low} to {high}");
    }
}

/// The stored summary is of an optimised build on a quiet machine, and is small.
#[test]
fn the_quiet_run_is_quiet() {
    let quiet = quiet();
    assert!(quiet.is_optimised() && quiet.date.is_some() && quiet.scenes > 20);
    for speeds in [quiet.scalar, quiet.simd] {
        let speeds = speeds.expect("measured");
        assert!(speeds.too_busy.is_none() && speeds.methods.iter().any(|m| m.variant == FAST));
    }
    assert!(fastphong_report::QUIET.len() < 10_000);
}
