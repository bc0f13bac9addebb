//! The tables that stand in Markdown, in CSV, and on the page for readers without JavaScript.

use super::answer::overall;
use super::document::{Document, OperationsData, SceneData, label};
use crate::compare::comparison::table::{levels, significant};
use crate::compare::comparison::{RowData, Speed};
use crate::compare::table::Table;
use crate::compare::timing::Ratio;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// A cell without a value.
const NONE: &str = "–";

/// Returns all tables of a document: all scenes, each scene, four corners, growth, operations, findings.
pub(super) fn all(data: &Document) -> Vec<Table> {
    let mut tables = Vec::new();
    if data.comparisons.len() > 1 {
        tables.push(summary(data));
    }
    tables.extend(data.comparisons.iter().map(scene));
    tables.extend(corners(data));
    tables.extend(growth(data));
    if !data.methods.is_empty() {
        tables.push(operations(data));
    }
    if !data.figures.is_empty() {
        tables.push(findings(data));
    }
    tables
}

/// Sums up every method over all scenes.
pub(super) fn summary(data: &Document) -> Table {
    let caption = format!(
        "All methods in {} scenes: largest error anywhere, geometric mean of speeds",
        data.comparisons.len()
    );
    let mut table = Table::new(
        caption,
        &["method", "max error, levels", "in", "speed, × naive Phong"],
    );
    table
        .rows
        .extend(overall(&data.comparisons).iter().map(|o| {
            let speed = o.speed.map_or_else(|| NONE.into(), |s| format!("{s:.2}"));
            Vec::from([label(o.name), significant(o.worst), o.at.to_string(), speed])
        }));
    table
}

/// Lists errors and speeds of all methods in one scene.
pub(super) fn scene(scene: &SceneData) -> Table {
    let mut table = Table::new(
        scene.title(),
        &[
            "method",
            "max, levels",
            "RMS, levels",
            "other polygon, pixels",
            "time, ms",
            "speed, × naive Phong",
        ],
    );
    let row = |row: &RowData| {
        let speed = |of: fn(&Speed) -> String| row.speed.as_ref().map_or(NONE.into(), of);
        let error = &row.error;
        let name = label(&row.variant);
        let name = match row.is_barycentric() {
            true => format!("{name}, barycentric"),
            false => name,
        };
        Vec::from([
            name,
            levels(error.max),
            levels(error.rms),
            row.other_polygon.to_string(),
            speed(|s| significant(s.timing.median_ns / 1e6)),
            speed(|s| ratio(s.ratio_to_naive)),
        ])
    };
    table.rows.extend(scene.all_rows().map(row));
    table
}

/// Writes a ratio with its interval; `=` before it says that the interval holds 1.
fn ratio(ratio: Option<Ratio>) -> String {
    ratio.map_or_else(
        || NONE.into(),
        |r| {
            let tie = if r.is_tie() { "= " } else { "" };
            let [low, median, high] = [r.low, r.median, r.high].map(|v| format!("{v:.2}"));
            format!("{tie}{median} ({low}–{high})")
        },
    )
}

/// Lists the speeds of all methods in kernels and frames, scalar and SIMD.
fn corners(data: &Document) -> Option<Table> {
    let study = data.speedups.as_ref()?;
    let caption = format!(
        "Speed as a multiple of naive Phong’s: spans of {} pixels, and {} on {} × {} pixels",
        study.span, study.mesh, study.size[0], study.size[1]
    );
    let mut table = Table::new(caption, &["method", "off by, levels"]);
    table.head.extend(study.corners.iter().map(|c| {
        let lights = if c.lights == 1 {
            "1 light".into()
        } else {
            format!("{} lights", c.lights)
        };
        format!("{}, {}, {lights}", c.work.word(), c.level)
    }));
    table.rows.extend(study.methods.iter().map(|m| {
        let mut row = Vec::from([label(&m.method), m.levels_off.to_string()]);
        row.extend(m.corners.iter().map(|c| ratio(c.ratio_to_naive)));
        row
    }));
    Some(table)
}

/// Lists what a vertex, a triangle, a span and a pixel cost.
fn growth(data: &Document) -> Option<Table> {
    let study = data.scaling.as_ref()?;
    let mut table = Table::new(
        format!(
            "What one of each costs in frames of {}, in nanoseconds",
            study.mesh
        ),
        &[
            "method",
            "engine",
            "vertex",
            "triangle",
            "span",
            "pixel of a span",
            "pixel of the picture",
        ],
    );
    table.rows.extend(study.curves.iter().map(|curve| {
        let mut row = Vec::from([
            label(&curve.method),
            format!("{}, {}", curve.engine, curve.level),
        ]);
        match &curve.costs {
            None => row.resize(7, NONE.into()),
            Some(c) => row.extend(
                [
                    c.vertex_ns,
                    c.triangle_ns,
                    c.span_ns,
                    c.pixel_ns,
                    c.background_ns,
                ]
                .map(significant),
            ),
        }
        row
    }));
    Some(table)
}

/// Lists the operations of each method, for one light and for four.
fn operations(data: &Document) -> Table {
    let mut table = Table::new(
        "Operations: + additions, × multiplications, < comparisons, ÷ divisions, √ roots, ∿ sines, ^ powers; \
         counted by running each method on numbers that count, for shininess 32",
        &[
            "method, lights",
            "vertex",
            "polygon",
            "edge",
            "edge, scanline",
            "span",
            "pixel: walk",
            "pixel: shade",
        ],
    );
    for method in &data.methods {
        table.rows.extend(method.operations.iter().map(|of| {
            let OperationsData {
                lights,
                vertex,
                polygon,
                edge,
                edge_step,
                span,
                walk,
                shade,
            } = of;
            let mut row = Vec::from([format!("{}, {lights}", method.label)]);
            row.extend([vertex, polygon, edge, edge_step, span, walk, shade].map(counts));
            row
        }));
    }
    table
}

/// Writes counts as `14 + 9 ×`.
fn counts(counts: &[u32; 7]) -> String {
    let signs = counts.iter().zip(['+', '×', '<', '÷', '√', '∿', '^']);
    // A space that does not break keeps a number with its sign.
    let some = signs.filter(|(n, _)| **n > 0);
    let cells: Vec<String> = some.map(|(n, sign)| format!("{n}\u{A0}{sign}")).collect();
    if cells.is_empty() {
        NONE.into()
    } else {
        cells.join(" ")
    }
}

/// Lists everything that the figures of the lectures found.
pub(super) fn findings(data: &Document) -> Table {
    let mut table = Table::new(
        "What the lectures say, measured",
        &["measured", "figure", "value", "the lecture", "in words"],
    );
    for figure in &data.figures {
        table.rows.extend(figure.content.findings.iter().map(|f| {
            let value = format!("{} {}", significant(f.value), f.unit);
            let word = f.agreement.word().to_string();
            let (title, value) = (figure.title.clone(), value.trim().to_string());
            Vec::from([f.label.clone(), title, value, word, f.verdict.clone()])
        }));
    }
    table
}
