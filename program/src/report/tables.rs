//! The tables for Markdown, for CSV, and for readers of the page without JavaScript.

use super::document::{OPERATIONS, RATES, label, list, number, text, title};
use super::summary::{Summary, is_too_busy, of_scenes, ratio_of};
use crate::compare::comparison::NOTABLE_CLAMPING;
use crate::compare::comparison::table::{levels, significant};
use crate::compare::table::Table;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde_json::Value;

/// A cell without a value.
const NONE: &str = "–";

/// A table, and a sentence on how far to trust its times, which stands under it. The sentence is
/// empty if there are no times, or the document does not say.
pub(super) struct Trusted {
    pub table: Table,
    pub noise: String,
}

/// Returns all tables of a document: all scenes, each scene, speeds in four corners, growth,
/// processors without a floating-point unit, operations, and findings.
pub(super) fn all(data: &Value) -> Vec<Trusted> {
    let scenes = list(data, "/comparisons");
    let mut tables = Vec::new();
    let mut add = |table, noise: &Value| {
        let noise = text(noise, "/sentence").to_string();
        tables.push(Trusted { table, noise });
    };
    if scenes.len() > 1 {
        add(summary(data), &Value::Null);
    }
    for of in scenes {
        add(scene(of), &of["noise"]);
    }
    if data["speedups"].is_object() {
        add(corners(&data["speedups"]), &data["speedups"]["noise"]);
    }
    if data["scaling"].is_object() {
        let points = list(&data["scaling"], "/points").iter();
        let doubt = |noise: &Value| number(noise, "/doubt").unwrap_or(0.0);
        // Points without a time say so by their dashes.
        let told = points
            .map(|point| &point["noise"])
            .filter(|noise| !is_too_busy(noise));
        let worst = told.max_by(|a, b| doubt(a).total_cmp(&doubt(b)));
        add(growth(&data["scaling"]), worst.unwrap_or(&Value::Null));
    }
    if data["small"].is_object() {
        add(small(&data["small"]), &Value::Null);
    }
    if !list(data, "/methods").is_empty() {
        add(operations(data), &Value::Null);
    }
    if !list(data, "/figures").is_empty() {
        add(findings(data), &Value::Null);
    }
    tables
}

/// Writes the number at a JSON pointer, or [`NONE`] if there is none.
fn cell(value: &Value, pointer: &str, write: impl Fn(f64) -> String) -> String {
    number(value, pointer).map_or_else(|| NONE.into(), write)
}

/// Summarises every method over all scenes.
fn summary(data: &Value) -> Table {
    let scenes: Vec<&Value> = list(data, "/comparisons").iter().collect();
    let head = ["method", "max error, levels", "in", "speed, × naive Phong"];
    let mut table = Table::new(
        format!(
            "All methods in {} scenes: largest error anywhere, geometric mean of speeds",
            scenes.len()
        ),
        &head,
    );
    let methods = Summary::of(data).methods;
    let speeds = of_scenes(&scenes, "", &methods);
    for method in methods {
        let mut speeds = speeds.methods.iter().filter(|_| speeds.too_busy.is_none());
        let speed = speeds.find(|timed| timed.variant == method.variant);
        let speed = speed.map_or_else(|| NONE.into(), |timed| timed.speed.cell());
        let (name, worst) = (label(&method.variant), significant(method.levels));
        table.rows.push([name, worst, method.scene, speed].into());
    }
    table
}

/// Lists the costs of pixels in integers, and their errors.
fn small(data: &Value) -> Table {
    let title = "Without a floating-point unit: a pixel of a span of 32 pixels, 15° between its normals, in integers on emulated processors";
    let head = [
        "loop",
        "Cortex-M0+ cycles, modelled",
        "Cortex-M0 instructions",
        "RV32IMC instructions",
        "worst error at 5, 15, 30, 60°, levels",
    ];
    let mut table = Table::new(title.to_string(), &head);
    for span in list(data, "/spans") {
        let at = |i: usize| {
            let pointer = format!("/at_32_pixels_15_degrees/{i}");
            cell(span, &pointer, |x| format!("{x:.1}"))
        };
        let errors: Vec<String> = list(span, "/worst_error")
            .iter()
            .filter_map(Value::as_f64)
            .map(|error| format!("{error:.1}"))
            .collect();
        let name = text(span, "/method").to_string();
        let row = [name, at(1), at(0), at(2), errors.join(", ")];
        table.rows.push(row.into());
    }
    table
}

/// Lists errors and speeds of all methods in one scene.
pub(super) fn scene(scene: &Value) -> Table {
    let is_clamped = clamped_share(scene) > NOTABLE_CLAMPING;
    let mut head = Vec::from([
        "method",
        "max, levels",
        "RMS, levels",
        "other polygon, pixels",
        "time, ms",
        "speed, × naive Phong",
    ]);
    if is_clamped {
        head.insert(4, "clamped, pixels");
    }
    let mut table = Table::new(title(scene), &head);
    for row in list(scene, "/rows")
        .iter()
        .chain(list(scene, "/barycentric"))
    {
        let by = match text(row, "/engine") {
            "barycentric" => ", barycentric",
            _ => "",
        };
        let mut cells = Vec::from([
            label(text(row, "/variant")) + by,
            cell(row, "/error/max", levels),
            cell(row, "/error/rms", levels),
            cell(row, "/other_polygon", |n| n.to_string()),
            time(row, "/speed/timing/typical_ns", &scene["noise"]),
            ratio(&row["speed"]["ratio_to_naive"], &scene["noise"]),
        ]);
        if is_clamped {
            cells.insert(4, cell(row, "/clamped", |n| n.to_string()));
        }
        table.rows.push(cells);
    }
    table
}

/// Returns the share of the covered pixels whose light is clamped, or 0 if the document does not
/// say.
pub(super) fn clamped_share(scene: &Value) -> f64 {
    let count = |field: &str| number(scene, &format!("/clamping/{field}")).unwrap_or(0.0);
    count("clamped") / count("covered").max(1.0)
}

/// Writes a time in milliseconds, or [`NONE`] if the machine was too busy.
fn time(value: &Value, pointer: &str, noise: &Value) -> String {
    if is_too_busy(noise) {
        NONE.into()
    } else {
        cell(value, pointer, |ns| significant(ns / 1e6))
    }
}

/// Writes a ratio with its interval, or [`NONE`] if the machine was too busy. A `=` before it says
/// that it is a tie.
fn ratio(ratio: &Value, noise: &Value) -> String {
    let speed = ratio_of(ratio).filter(|_| !is_too_busy(noise));
    speed.map_or_else(|| NONE.into(), |speed| speed.cell())
}

/// Lists the speeds of all methods in kernels and frames, scalar and SIMD.
fn corners(speedups: &Value) -> Table {
    let caption = format!(
        "Speed as a multiple of naive Phong’s: spans of {} pixels, and {} on {} × {} pixels",
        speedups["span"],
        text(speedups, "/mesh"),
        speedups["size"][0],
        speedups["size"][1]
    );
    let mut table = Table::new(caption, &["method", "off by, levels"]);
    for corner in list(speedups, "/corners") {
        let s = if corner["lights"] == 1 { "" } else { "s" };
        let (work, level) = (text(corner, "/work"), text(corner, "/level"));
        let head = format!("{work}, {level}, {} light{s}", corner["lights"]);
        table.head.push(head);
    }
    for method in list(speedups, "/methods") {
        let off = method["levels_off"].to_string();
        let mut row = Vec::from([label(text(method, "/method")), off]);
        let speeds = list(method, "/corners").iter();
        row.extend(speeds.map(|speed| ratio(&speed["ratio_to_naive"], &speedups["noise"])));
        table.rows.push(row);
    }
    table
}

/// Lists the measured points of growth: a row for each frame, a column for each method.
fn growth(scaling: &Value) -> Table {
    let caption = format!(
        "Growth: times in ms of frames of {}",
        text(scaling, "/mesh")
    );
    let head = ["size", "triangles", "covered pixels", "projection only"];
    let mut table = Table::new(caption, &head);
    let curves = list(scaling, "/curves");
    table.head.extend(curves.iter().map(|curve| {
        let [engine, level] = ["/engine", "/level"].map(|of| text(curve, of));
        format!("{}, {engine}, {level}", label(text(curve, "/method")))
    }));
    for (i, point) in list(scaling, "/points").iter().enumerate() {
        let mut row = Vec::from([
            format!("{} × {}", point["size"][0], point["size"][1]),
            point["triangles"].to_string(),
            point["pixels"].to_string(),
            time(point, "/projection/typical_ns", &point["noise"]),
        ]);
        let at = format!("/times/{i}/typical_ns");
        row.extend(curves.iter().map(|curve| time(curve, &at, &point["noise"])));
        table.rows.push(row);
    }
    table
}

/// Lists the operations of each method, for one light and for four.
fn operations(data: &Value) -> Table {
    let caption = "Operations: + additions, × multiplications, < comparisons, ÷ divisions, √ roots, ∿ sines, ^ powers, ▤ reads of tables; \
                   counted by running each method with numbers that count, at shininess 32; for methods in integers, spans and pixels are \
                   counted in the source of their loops";
    let mut table = Table::new(caption, &["method, lights"]);
    table
        .head
        .extend(RATES.map(|(_, head, _)| head.to_string()));
    for method in list(data, "/methods") {
        for of in list(method, "/operations") {
            let name = format!("{}, {}", text(method, "/label"), of["lights"]);
            let counts = RATES.map(|(rate, ..)| counts(&of[rate]));
            table.rows.push([name].into_iter().chain(counts).collect());
        }
    }
    table
}

/// Writes counts as `14 + 9 ×`.
fn counts(counts: &Value) -> String {
    let signs = list(counts, "").iter().zip(OPERATIONS);
    // A no-break space keeps a number with its sign.
    let some = signs.filter(|(n, _)| **n != 0);
    let cells: Vec<String> = some
        .map(|(n, (_, sign, _))| format!("{n}\u{A0}{sign}"))
        .collect();
    match &cells[..] {
        [] => NONE.into(),
        cells => cells.join(" "),
    }
}

/// Lists all findings of the lectures' figures.
fn findings(data: &Value) -> Table {
    let head = ["measured", "figure", "value", "the lecture", "in words"];
    let mut table = Table::new("What the lectures say, measured", &head);
    for figure in list(data, "/figures") {
        for finding in list(figure, "/findings") {
            let value = cell(finding, "/value", significant) + " " + text(finding, "/unit");
            let texts = ["/label", "/agreement", "/verdict"].map(|at| text(finding, at));
            let [label, word, verdict] = texts.map(str::to_string);
            let title = text(figure, "/title").to_string();
            let value = value.trim().to_string();
            let row = [label, title, value, word, verdict];
            table.rows.push(row.into());
        }
    }
    table
}
