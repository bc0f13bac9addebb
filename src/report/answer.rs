//! The answer: which method to use here, and what it gains, in one sentence made from data.

use super::document::{label, list, number, text, title};
use crate::compare::comparison::BASELINE;
use crate::compare::comparison::table::significant;
use crate::compare::table::{html_text, markdown_text};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde_json::Value;

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
pub(super) fn overall(data: &Value) -> Vec<Overall<'_>> {
    let scenes = list(data, "/comparisons");
    let rows = scenes.first().map_or(&[][..], |scene| list(scene, "/rows"));
    let sums = rows
        .iter()
        .map(|row| in_all_scenes(text(row, "/variant"), scenes));
    sums.flatten().collect()
}

fn in_all_scenes<'a>(name: &'a str, scenes: &'a [Value]) -> Option<Overall<'a>> {
    let (mut worst, mut at, mut logarithms) = (0.0, "", Some(0.0));
    for scene in scenes {
        let mut rows = list(scene, "/rows").iter();
        let row = rows.find(|row| text(row, "/variant") == name)?;
        let error = 255.0 * number(row, "/error/max")?;
        if error >= worst {
            (worst, at) = (error, title(scene));
        }
        let speed = number(row, "/speed/ratio_to_naive/median");
        logarithms = logarithms.zip(speed).map(|(sum, s)| sum + libm::log(s));
    }
    Some(Overall {
        name,
        worst,
        at,
        speed: logarithms.map(|sum: f64| libm::exp(sum / scenes.len() as f64)),
    })
}

/// Says which method to use, and what it gains.
pub(super) fn answer(data: &Value) -> Vec<Part> {
    let plain = |text: &str| Part::Text(text.to_string());
    let (all, scenes) = (overall(data), list(data, "/comparisons"));
    if scenes.is_empty() {
        return Vec::from([plain(&figures(data))]);
    }
    let Some(best) = fastest(&all) else {
        return Vec::from([plain(&untimed(&all))]);
    };
    let mut parts = Vec::new();
    if text(data, "/machine/profile") != "release" {
        parts.push(plain("Built without optimisation, its times say nothing: "));
    }
    let worst = match best.worst {
        w if w < 0.01 => "nowhere off by 0.01 grey levels".to_string(),
        w if w < 1.0 => format!("never off by more than {w:.2} grey levels"),
        w => format!("off by up to {} grey levels", significant(w)),
    };
    let scenes = match scenes.len() {
        1 => "this scene".to_string(),
        scenes => format!("{scenes} scenes"),
    };
    let level = text(data, "/comparisons/0/renderer/level");
    parts.extend([
        plain("For naive Phong’s picture at the least time on this machine, use "),
        Part::Method(best.name.into()),
        plain(&format!(" {} (", on(level))),
        Part::Strong(times(best.speed)),
        plain(&format!(" naive Phong in {scenes}, {worst})")),
    ]);
    let wide = wide_frames(&data["speedups"]);
    if let Some((corner, name, ratio)) = wide {
        let level = text(&data["speedups"]["corners"][corner], "/level");
        parts.extend([
            plain(" and "),
            Part::Method(name.to_string()),
            plain(&format!(" {} (", on(level))),
            Part::Strong(times(Some(ratio))),
            plain(" on one sphere)"),
        ]);
    }
    let mut fast = all.iter().filter(|o| o.name == FAST && best.name != FAST);
    if let Some(speed) = fast.next().and_then(|fast| fast.speed) {
        parts.extend([
            plain("; the lecture’s "),
            Part::Method(FAST.into()),
            plain(" reaches "),
            Part::Strong(times(Some(speed))),
        ]);
        let mut methods = list(data, "/speedups/methods").iter();
        let method = methods.find(|method| text(method, "/method") == FAST);
        if let Some(ratio) = wide.and_then(|(corner, ..)| in_corner(method?, corner)) {
            parts.extend([plain(" and "), Part::Strong(times(Some(ratio)))]);
        }
    }
    parts.push(plain("."));
    parts
}

/// Returns the fastest method whose pictures pass for the reference; with none, the one of least error.
fn fastest<'a>(all: &'a [Overall<'a>]) -> Option<&'a Overall<'a>> {
    let timed = || all.iter().filter(|o| o.speed.is_some());
    let same = timed().filter(|o| o.worst <= SAME);
    let near = timed().min_by(|a, b| a.worst.total_cmp(&b.worst));
    let fastest =
        same.max_by(|a, b| f64::total_cmp(&a.speed.unwrap_or(0.0), &b.speed.unwrap_or(0.0)));
    fastest.or(near)
}

/// Returns the corner of whole frames by SIMD, the fastest method there that draws naive Phong's picture, and its speed.
fn wide_frames(speedups: &Value) -> Option<(usize, &str, f64)> {
    let is_it =
        |c: &Value| c["work"] == "frame" && c["scalar"] == false && text(c, "/level") != "scalar";
    let corner = list(speedups, "/corners").iter().position(is_it)?;
    let methods = list(speedups, "/methods").iter();
    let same = methods.filter(|m| number(m, "/levels_off").is_some_and(|off| off <= 1.0));
    let timed = same.filter_map(|m| Some((corner, text(m, "/method"), in_corner(m, corner)?)));
    timed.max_by(|a, b| a.2.total_cmp(&b.2))
}

/// Returns the speed of a method in a corner.
fn in_corner(method: &Value, corner: usize) -> Option<f64> {
    number(&method["corners"][corner], "/ratio_to_naive/median")
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

/// Returns the answer without times.
fn untimed(all: &[Overall<'_>]) -> String {
    let others = all.iter().filter(|o| o.name != BASELINE);
    let Some(worst) = others.max_by(|a, b| a.worst.total_cmp(&b.worst)) else {
        return "No times were taken.".to_string();
    };
    format!(
        "No times were taken. The largest error is that of {}: {} grey levels in {}.",
        label(worst.name),
        significant(worst.worst),
        worst.at
    )
}

/// Returns the answer of a report without scenes: the findings of its figures.
fn figures(data: &Value) -> String {
    let found = || {
        list(data, "/figures")
            .iter()
            .flat_map(|f| list(f, "/findings"))
    };
    let count = |word: &str| found().filter(|f| f["agreement"] == word).count();
    let [confirms, contradicts, adds] = ["confirms", "contradicts", "adds"].map(count);
    match found().count() {
        0 => "Nothing was compared.".into(),
        all => format!(
            "Of {all} statements measured, {confirms} are as printed, {contradicts} wrong or true only under conditions, \
             {adds} new."
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
