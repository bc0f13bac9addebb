//! The answer: which method to use on this machine, and how much it gains, in one sentence made
//! from data.

use super::document::{label, list, number, text, title};
use crate::compare::comparison::BASELINE;
use crate::compare::comparison::table::significant;
use crate::compare::table::{html_text, markdown_text};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde_json::Value;

/// The lecture's own fast method, which every answer mentions.
pub(super) const FAST: &str = "fast-phong";

/// The largest error in grey levels with which a picture passes for the reference.
pub(super) const SAME: f64 = 1.0;

/// A part of a sentence.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    /// Plain words.
    Text(String),
    /// A number that matters, in bold.
    Strong(String),
    /// A method, by its variant's name.
    Method(String),
    /// A link to a scene: its index, its title, and the method whose picture it shows.
    Scene(usize, String, String),
}

/// The results of a method in all scenes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Overall<'a> {
    /// The variant.
    pub name: &'a str,
    /// The largest error in any scene, in grey levels.
    pub worst: f64,
    /// The title of the scene with the largest error.
    pub at: &'a str,
    /// The index of that scene.
    pub scene: usize,
    /// In how many scenes it is faster than the baseline, beyond chance.
    pub faster: usize,
    /// In how many scenes it is slower, beyond chance.
    pub slower: usize,
    /// The geometric mean of its speeds, as multiples of the baseline's. `None` unless all scenes
    /// were timed.
    pub speed: Option<f64>,
}

/// Summarises every variant that was drawn by scanlines in all scenes.
pub(super) fn overall(data: &Value) -> Vec<Overall<'_>> {
    let scenes = list(data, "/comparisons");
    let rows = scenes.first().map_or(&[][..], |scene| list(scene, "/rows"));
    let sums = rows
        .iter()
        .map(|row| in_all_scenes(text(row, "/variant"), scenes));
    sums.flatten().collect()
}

fn in_all_scenes<'a>(name: &'a str, scenes: &'a [Value]) -> Option<Overall<'a>> {
    let (mut worst, mut at, mut place) = (0.0, "", 0);
    let (mut faster, mut slower) = (0, 0);
    let mut logarithms = Some(0.0);
    for (i, scene) in scenes.iter().enumerate() {
        let mut rows = list(scene, "/rows").iter();
        let row = rows.find(|row| text(row, "/variant") == name)?;
        let error = 255.0 * number(row, "/error/max")?;
        if error >= worst {
            (worst, at, place) = (error, title(scene), i);
        }
        let speed = number(row, "/speed/ratio_to_naive/median");
        let is_tie = row["speed"]["ratio_to_naive"]["tie"] == true;
        faster += usize::from(!is_tie && speed > Some(1.0));
        slower += usize::from(!is_tie && speed.is_some_and(|speed| speed < 1.0));
        logarithms = logarithms.zip(speed).map(|(sum, s)| sum + libm::log(s));
    }
    Some(Overall {
        name,
        worst,
        at,
        scene: place,
        faster,
        slower,
        speed: logarithms.map(|sum: f64| libm::exp(sum / scenes.len() as f64)),
    })
}

/// Says which method to use, and how much it gains.
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
        1 => "in this scene".to_string(),
        scenes => format!("over {scenes} scenes"),
    };
    let level = text(data, "/comparisons/0/renderer/level");
    parts.extend([
        plain("For naive Phong’s picture in the least time on this machine, use "),
        Part::Method(best.name.into()),
        plain(&format!(" {} (", on(level))),
        Part::Strong(times(best.speed)),
        plain(&format!(" as fast as naive Phong {scenes}, {worst})")),
    ]);
    let wide = wide_frames(&data["speedups"], &all);
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

/// Returns the fastest method whose pictures pass for the reference, or the method with the
/// smallest error if there is none.
fn fastest<'a>(all: &'a [Overall<'a>]) -> Option<&'a Overall<'a>> {
    let timed = || all.iter().filter(|o| o.speed.is_some());
    let same = timed().filter(|o| o.worst <= SAME);
    let near = timed().min_by(|a, b| a.worst.total_cmp(&b.worst));
    let fastest =
        same.max_by(|a, b| f64::total_cmp(&a.speed.unwrap_or(0.0), &b.speed.unwrap_or(0.0)));
    fastest.or(near)
}

/// Returns the corner of whole frames with SIMD, the fastest method there that draws naive Phong's
/// picture, and its speed.
///
/// The pictures of all scenes decide if it does. For a method that was not drawn there, the
/// experiment's sphere decides.
fn wide_frames<'a>(speedups: &'a Value, all: &[Overall<'_>]) -> Option<(usize, &'a str, f64)> {
    let is_it =
        |c: &Value| c["work"] == "frame" && c["scalar"] == false && text(c, "/level") != "scalar";
    let corner = list(speedups, "/corners").iter().position(is_it)?;
    let methods = list(speedups, "/methods").iter();
    let drawn = |m: &Value| all.iter().find(|o| o.name == text(m, "/method"));
    let off = |m: &Value| drawn(m).map_or(number(m, "/levels_off"), |o| Some(o.worst));
    let same = methods.filter(|m| off(m).is_some_and(|off| off <= SAME));
    let timed = same.filter_map(|m| Some((corner, text(m, "/method"), in_corner(m, corner)?)));
    timed.max_by(|a, b| a.2.total_cmp(&b.2))
}

/// Returns the speed of a method in a corner, as a multiple of naive Phong's.
fn in_corner(method: &Value, corner: usize) -> Option<f64> {
    number(&method["corners"][corner], "/ratio_to_naive/median")
}

fn times(ratio: Option<f64>) -> String {
    ratio.map_or_else(|| "–".into(), |ratio| format!("{ratio:.2}\u{A0}×"))
}

/// Says which instruction set drew pixels: `in scalar code`, `in AVX2 code`.
fn on(level: &str) -> String {
    match level {
        "scalar" => "in scalar code".into(),
        "avx512" => "in AVX-512 code".into(),
        level => format!("in {} code", level.to_uppercase()),
    }
}

/// Says where the method of the answer gains nothing and where its error is largest, and why faster
/// methods are left out.
pub(super) fn remarks(data: &Value) -> Vec<Part> {
    let (all, scenes) = (overall(data), list(data, "/comparisons").len());
    let Some(best) = fastest(&all) else {
        return Vec::new();
    };
    let (name, mut parts) = (label(best.name), Vec::new());
    if scenes > 1 {
        let scene = Part::Scene(best.scene, best.at.into(), best.name.into());
        let gains = format!(
            "{name} is faster in {} of {scenes} scenes, slower in {}; worst in ",
            best.faster, best.slower
        );
        parts.extend([Part::Text(gains), scene, Part::Text(". ".into())]);
    }
    let limit = best.worst.max(SAME);
    let others = || {
        all.iter()
            .filter(|o| o.speed > best.speed && o.worst > limit)
    };
    if let Some(nearest) = others().min_by(|a, b| a.worst.total_cmp(&b.worst)) {
        // The most exact methods are at the end of the list.
        let names: Vec<_> = others().rev().take(1).map(|o| label(o.name)).collect();
        let rest = match others().count() - names.len() {
            0 => String::new(),
            rest => format!(" and {rest} more"),
        };
        let who = match others().count() {
            1 => "Another is",
            _ => "Others are",
        };
        parts.push(Part::Text(format!(
            "{who} faster, but off by {} grey levels or more: {}{rest}. ",
            significant(nearest.worst),
            names.join(", ")
        )));
    }
    parts.push(Part::Text("Scalar: one pixel per instruction.".into()));
    parts
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

/// Returns the answer of a report without scenes, which counts the findings of its figures.
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

/// Writes a sentence as HTML. Methods and scenes are links.
pub(super) fn html(parts: &[Part]) -> String {
    let part = |part: &Part| match part {
        Part::Text(text) => html_text(text),
        Part::Strong(text) => format!("<b>{}</b>", html_text(text)),
        Part::Method(name) => {
            let (name, label) = (html_text(name), html_text(&label(name)));
            format!("<a class=\"m\" data-m=\"{name}\" href=\"#methods/{name}\">{label}</a>")
        }
        Part::Scene(place, title, of) => {
            let (title, of) = (html_text(title), html_text(of));
            format!("<a data-scene=\"{place}\" data-of=\"{of}\">{title}</a>")
        }
    };
    parts.iter().map(part).collect()
}

/// Writes a sentence in Markdown.
pub(super) fn markdown(parts: &[Part]) -> String {
    let part = |part: &Part| match part {
        Part::Text(text) | Part::Strong(text) | Part::Scene(_, text, _) => markdown_text(text),
        Part::Method(name) => markdown_text(&label(name)),
    };
    parts.iter().map(part).collect()
}
