//! The answer: which method to use here, and what it gains, in one sentence made from data.

use super::document::{Document, SceneData, label};
use crate::compare::comparison::table::significant;
use crate::compare::comparison::{BASELINE, RowData};
use crate::compare::experiments::{Corner, Work};
use crate::compare::table::{html_text, markdown_text};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// The lecture's own fast method, which every answer mentions.
const FAST: &str = "fast-phong";

/// Largest error, in grey levels, of a picture that passes for the reference.
const SAME: f64 = 1.0;

/// Part of a sentence.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    /// Plain words.
    Text(String),
    /// A number that matters.
    Strong(String),
    /// A method, by its variant's name.
    Method(String),
}

/// A method over all scenes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Overall<'a> {
    /// The variant.
    pub name: &'a str,
    /// Largest error in any scene, in grey levels.
    pub worst: f64,
    /// The scene of that.
    pub at: &'a str,
    /// Geometric mean of its speeds as a multiple of the baseline's; `None` without times in all scenes.
    pub speed: Option<f64>,
}

/// Sums up every variant that was drawn by scanlines in all scenes.
pub(super) fn overall(scenes: &[SceneData]) -> Vec<Overall<'_>> {
    let first = scenes.first().map_or(&[][..], |s| &s.comparison.rows);
    first
        .iter()
        .filter_map(|row| of_all_scenes(&row.variant, scenes))
        .collect()
}

fn of_all_scenes<'a>(name: &'a str, scenes: &'a [SceneData]) -> Option<Overall<'a>> {
    let rows = scenes.iter().map(|scene| Some((scene, scene.row(name)?)));
    let rows: Vec<(&SceneData, &RowData)> = rows.collect::<Option<_>>()?;
    let (scene, worst) = rows
        .iter()
        .max_by(|a, b| f64::total_cmp(&a.1.error.max, &b.1.error.max))?;
    let logarithm = |row: &RowData| {
        let ratio = row.speed.as_ref()?.ratio_to_naive?;
        Some(libm::log(ratio.median))
    };
    let sum = rows
        .iter()
        .map(|(_, row)| logarithm(row))
        .sum::<Option<f64>>();
    Some(Overall {
        name,
        worst: 255.0 * worst.error.max,
        at: scene.title(),
        speed: sum.map(|sum| libm::exp(sum / rows.len() as f64)),
    })
}

/// Says which method to use, and what it gains.
pub(super) fn answer(data: &Document) -> Vec<Part> {
    let text = |text: &str| Part::Text(text.to_string());
    let all = overall(&data.comparisons);
    if data.comparisons.is_empty() {
        return Vec::from([text(&figures(data))]);
    }
    let Some(best) = fastest(&all) else {
        return Vec::from([text(&untimed(&all))]);
    };
    let release = data.machine.profile == "release";
    let scene_count = data.comparisons.len();
    let level = data.comparisons[0].comparison.renderer.level.clone();
    let mut parts = Vec::new();
    if !release {
        parts.push(text("Built without optimisation, its times say nothing: "));
    }
    parts.push(text(
        "For naive Phong’s picture at the least time on this machine, use ",
    ));
    let worst = match best.worst {
        w if w < 0.01 => "nowhere off by 0.01 grey levels".to_string(),
        w if w < 1.0 => format!("never off by more than {w:.2} grey levels"),
        w => format!("off by up to {} grey levels", significant(w)),
    };
    parts.extend([
        Part::Method(best.name.into()),
        text(&format!(" {} (", on(&level))),
        Part::Strong(times(best.speed)),
        text(&format!(
            " naive Phong in {}, {worst})",
            if scene_count == 1 {
                "this scene".to_string()
            } else {
                format!("{scene_count} scenes")
            }
        )),
    ]);
    let wide = wide_frames(data);
    if let Some((corner, name, ratio)) = &wide {
        let level = &data
            .speedups
            .as_ref()
            .map_or("", |s| &s.corners[*corner].level);
        parts.extend([
            text(" and "),
            Part::Method(name.clone()),
            text(&format!(" {} (", on(level))),
            Part::Strong(times(Some(*ratio))),
            text(")"),
        ]);
    }
    let fast = all.iter().find(|o| o.name == FAST && best.name != FAST);
    if let Some(Overall {
        speed: Some(speed), ..
    }) = fast
    {
        parts.extend([
            text("; the lecture’s "),
            Part::Method(FAST.into()),
            text(" reaches "),
            Part::Strong(times(Some(*speed))),
        ]);
        if let Some(ratio) = wide.and_then(|(corner, ..)| in_corner(data, corner, FAST)) {
            parts.extend([text(" and "), Part::Strong(times(Some(ratio)))]);
        }
    }
    parts.push(text("."));
    parts
}

/// Returns the fastest method whose pictures pass for the reference; with none, the one of least error.
fn fastest<'a>(all: &'a [Overall<'a>]) -> Option<&'a Overall<'a>> {
    let timed = || all.iter().filter_map(|o| Some((o.speed?, o)));
    let same = timed().filter(|(_, o)| o.worst <= SAME);
    let near = timed().min_by(|a, b| a.1.worst.total_cmp(&b.1.worst));
    same.max_by(|a, b| a.0.total_cmp(&b.0))
        .or(near)
        .map(|(_, o)| o)
}

/// Returns the corner of whole frames by SIMD, the fastest method there that draws naive Phong's picture, and its speed.
fn wide_frames(data: &Document) -> Option<(usize, String, f64)> {
    let study = data.speedups.as_ref()?;
    let is_it = |c: &Corner| c.work == Work::Frame && !c.scalar && c.level != "scalar";
    let corner = study.corners.iter().position(is_it)?;
    let same = study.methods.iter().filter(|m| m.is_same_picture());
    let (method, ratio) = same
        .filter_map(|m| Some((m, m.corners.get(corner)?.ratio_to_naive?.median)))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((corner, method.method.clone(), ratio))
}

fn in_corner(data: &Document, corner: usize, method: &str) -> Option<f64> {
    let methods = &data.speedups.as_ref()?.methods;
    let found = methods.iter().find(|m| m.method == method)?;
    Some(found.corners.get(corner)?.ratio_to_naive?.median)
}

fn times(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "–".into(), |ratio| format!("{ratio:.2}\u{A0}×"))
}

/// Says how pixels were drawn: `one pixel at a time`, `on AVX2`.
fn on(level: &str) -> String {
    match level {
        "scalar" => "one pixel at a time".into(),
        level => format!("on {}", level.to_uppercase()),
    }
}

/// Says what is known without times.
fn untimed(all: &[Overall<'_>]) -> String {
    let others = all.iter().filter(|o| o.name != BASELINE);
    let worst = others.max_by(|a, b| a.worst.total_cmp(&b.worst));
    worst.map_or_else(
        || "No times were taken.".to_string(),
        |worst| {
            format!(
                "No times were taken. The largest error is that of {}: {} grey levels in {}.",
                label(worst.name),
                significant(worst.worst),
                worst.at
            )
        },
    )
}

/// Says what the figures found, in a report without scenes.
fn figures(data: &Document) -> String {
    let found = || data.figures.iter().flat_map(|f| &f.content.findings);
    let count = |word: &str| found().filter(|f| f.agreement.word() == word).count();
    match found().count() {
        0 => "Nothing was compared.".into(),
        all => format!(
            "Of {all} statements measured, {} are as printed, {} wrong or true only under conditions, {} new.",
            count("confirms"),
            count("contradicts"),
            count("adds")
        ),
    }
}

/// Writes a sentence as HTML whose methods are links.
pub(super) fn html(parts: &[Part]) -> String {
    let part = |part: &Part| match part {
        Part::Text(text) => html_text(text),
        Part::Strong(text) => format!("<b>{}</b>", html_text(text)),
        Part::Method(name) => {
            let (name, label) = (html_text(name), html_text(&label(name)));
            format!("<a class=\"m\" data-m=\"{name}\" href=\"#methods/{name}\">{label}</a>")
        }
    };
    parts.iter().map(part).collect()
}

/// Writes a sentence in Markdown.
pub(super) fn markdown(parts: &[Part]) -> String {
    let part = |part: &Part| match part {
        Part::Text(text) | Part::Strong(text) => markdown_text(text),
        Part::Method(name) => markdown_text(&label(name)),
    };
    parts.iter().map(part).collect()
}
