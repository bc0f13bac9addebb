//! What fast Phong gained when it was invented, and what is left of it: methods in four corners.

use super::html::escape;
use super::ratio_chart::{Group, ratio_bars};
use super::sentences::{enumeration, grouped};
use super::tables::{NONE, ratio, verdict};
use crate::compare::comparison::table::{decimals, significant};
use crate::compare::comparison::{BASELINE, RatioData};
use crate::compare::experiments::{
    Corner, MethodSpeedups, Speedup, Speedups, WHAT_A_FRAME_IS, Work,
};
use crate::compare::timing::Ratio;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// What the part is called.
pub(super) const TITLE: &str = "What fast Phong gained, and what is left of it";

/// Where naive Phong wins and where it does not, then what is left of the lecture's fast Phong; a sentence each.
pub(super) fn opening(speedups: &Speedups) -> Vec<String> {
    let (mut wins, mut unbeaten, mut others) = (Vec::new(), Vec::new(), Vec::new());
    for (i, corner) in speedups
        .corners
        .iter()
        .enumerate()
        .filter(|(_, corner)| corner.lights == 1)
    {
        let place = place(corner, speedups);
        let fast = fast(speedups, i).map(|ratio| format!("fast Phong {}", against(ratio)));
        let aside = fast
            .as_ref()
            .map_or_else(String::new, |fast| format!(" ({fast})"));
        match Verdict::of(speedups, i) {
            None => {}
            Some(Verdict::Wins) => wins.push(format!("{place}{aside}")),
            Some(Verdict::Level(best)) => unbeaten.push(match fast {
                Some(fast) if best != FAST => format!("{place} ({best} is level with it, {fast})"),
                _ => format!("{place} ({} is level with it)", title(best)),
            }),
            Some(Verdict::Loses(best, by)) => {
                let aside = if best == FAST { "" } else { &*aside };
                others.push(format!(
                    "In {place} {} is the fastest that does, {by:.2} times as fast{aside}.",
                    title(best)
                ));
            }
        }
    }
    let mut sentences = Vec::new();
    if !wins.is_empty() {
        let wins = enumeration(&wins);
        sentences.push(format!(
            "Naive Phong wins in {wins}: it is the fastest method there that draws its picture to one grey level."
        ));
    }
    if !unbeaten.is_empty() {
        let unbeaten = enumeration(&unbeaten);
        sentences.push(format!(
            "Naive Phong is not beaten in {unbeaten}: no method that draws its picture to one grey level is faster there for \
             sure."
        ));
    }
    if sentences.is_empty() && !others.is_empty() {
        let nowhere = "Naive Phong wins nowhere: it is in no corner the fastest method that draws its picture to one grey level.";
        sentences.push(nowhere.to_string());
    }
    sentences.extend(others);
    if !sentences.is_empty() {
        sentences.extend(left(speedups));
        let Speedups {
            mesh,
            size: [width, height],
            ..
        } = speedups;
        sentences.push(format!(
            "Frames are of {mesh} on {width} × {height} pixels; pictures are compared in that and in spans."
        ));
    }
    sentences
}

/// A method as sentences call it.
fn title(method: &str) -> &str {
    if method == FAST { "fast Phong" } else { method }
}

/// The lecture's fast method.
const FAST: &str = "fast-phong";

/// How naive Phong fares among the methods that draw its picture.
#[derive(Debug, PartialEq)]
enum Verdict<'a> {
    /// All others are slower for sure.
    Wins,
    /// None is faster for sure; of those that are not slower for sure, this one is the fastest.
    Level(&'a str),
    /// Of those that are faster for sure, this one is the fastest, by that factor.
    Loses(&'a str, f64),
}

impl Verdict<'_> {
    /// That of a corner; `None` if there is nobody to compare with.
    fn of(speedups: &Speedups, corner: usize) -> Option<Verdict<'_>> {
        let is_rival =
            |method: &&MethodSpeedups| method.is_same_picture() && method.method != BASELINE;
        let rivals = speedups.methods.iter().filter(is_rival);
        let rivals: Vec<(&str, Ratio)> = rivals
            .filter_map(|m| Some((&*m.method, m.corners.get(corner)?.ratio_to_naive?.ratio)))
            .collect();
        let fastest = |is_one: fn(&Ratio) -> bool| {
            let some = rivals.iter().filter(|(_, ratio)| is_one(ratio));
            some.max_by(|a, b| a.1.median.total_cmp(&b.1.median))
        };
        if let Some((best, ratio)) = fastest(|ratio| ratio.low > 1.0) {
            return Some(Verdict::Loses(best, ratio.median));
        }
        if let Some((best, _)) = fastest(Ratio::is_tie) {
            return Some(Verdict::Level(best));
        }
        (!rivals.is_empty()).then_some(Verdict::Wins)
    }
}

/// How fast the lecture's fast method is.
fn fast(speedups: &Speedups, corner: usize) -> Option<RatioData> {
    speedups
        .methods
        .iter()
        .find(|method| method.method == FAST)?
        .corners
        .get(corner)?
        .ratio_to_naive
}

/// `takes 1.40 times as long`, after a name.
fn against(ratio: RatioData) -> String {
    match ratio {
        _ if ratio.tie => "is level with it".to_string(),
        _ if ratio.ratio.median < 1.0 => {
            format!("takes {:.2} times as long", 1.0 / ratio.ratio.median)
        }
        _ => format!("is {:.2} times as fast", ratio.ratio.median),
    }
}

/// What the lecture's fast method gains in the terms of its time, and in those of today.
fn left(speedups: &Speedups) -> Option<String> {
    let corner = |work, scalar| {
        speedups
            .corners
            .iter()
            .position(|c| (c.work, c.scalar, c.lights) == (work, scalar, 1))
    };
    let (then, now) = (corner(Work::Kernel, true)?, corner(Work::Frame, false)?);
    let gain = |ratio: RatioData| match ratio {
        _ if ratio.tie => "nothing that can be measured".to_string(),
        _ if ratio.ratio.median < 1.0 => format!("nothing (it {})", against(ratio)),
        _ => format!("a factor of {:.2}", ratio.ratio.median),
    };
    Some(format!(
        "So fast Phong shading as the lecture prints it gains {} in the terms in which it was invented, arithmetic one pixel \
         at a time, and {} in {} today.",
        gain(fast(speedups, then)?),
        gain(fast(speedups, now)?),
        place(&speedups.corners[now], speedups)
    ))
}

/// A corner in words, after *in*.
fn place(corner: &Corner, speedups: &Speedups) -> String {
    let what = match corner.work {
        Work::Kernel => format!("spans of {} pixels", grouped(speedups.span)),
        Work::Frame => "whole frames".to_string(),
    };
    match corner {
        Corner { scalar: true, .. } => format!("{what} in scalar code"),
        Corner { level, .. } if level == "scalar" => format!("{what} by the fastest engine"),
        Corner { level, .. } => format!("{what} on {}", level.to_uppercase()),
    }
}

/// A corner as the head of a column, and what its cells hold.
fn head(corner: &Corner) -> [String; 2] {
    let (what, unit) = match corner.work {
        Work::Kernel => ("kernel", "ns a pixel"),
        Work::Frame => ("frame", "ms"),
    };
    let on = match corner {
        Corner { scalar: true, .. } => "scalar".to_string(),
        Corner { level, .. } if level == "scalar" => "fastest".to_string(),
        Corner { level, .. } => level.to_uppercase(),
    };
    let lights = if corner.lights > 1 {
        format!(", {} lights", corner.lights)
    } else {
        String::new()
    };
    [format!("{what}, {on}{lights}"), format!("{unit}; ratio")]
}

/// `1.65 ± 0.02`: nanoseconds a pixel of a kernel, milliseconds of a frame.
fn time(speedup: &Speedup, corner: &Corner, span: usize) -> String {
    let unit = match corner.work {
        Work::Kernel => span.max(1) as f64,
        Work::Frame => 1e6,
    };
    let timing = &speedup.timing;
    let digits = decimals(timing.median_ns / unit);
    format!(
        "{} ± {:.digits$}",
        significant(timing.median_ns / unit),
        (timing.p75_ns - timing.p25_ns) / 2.0 / unit
    )
}

/// What is timed, and how to read it.
fn legend(speedups: &Speedups) -> String {
    let Speedups {
        mesh,
        size: [width, height],
        span,
        ..
    } = speedups;
    format!(
        "Kernel: a span of {} pixels shaded by the method alone, set-up included. Frame: {mesh} on {width} × {height} pixels, \
         {WHAT_A_FRAME_IS}. Scalar is the lecture\u{2019}s own form, one pixel at a time; the other is the widest arithmetic \
         and the fastest engine of this machine. One light, if nothing else is said. Times are medians ± half the \
         interquartile range; ratios are speeds as multiples of that of naive Phong in the same corner, all taken in one \
         interleaved run: over 1 is faster, = is a tie.",
        grouped(*span)
    )
}

/// What a star behind a name means, if there is one.
fn footnote(speedups: &Speedups) -> Option<&'static str> {
    let is_other = |method: &MethodSpeedups| !method.is_same_picture();
    speedups.methods.iter().any(is_other).then_some(
        "* draws another picture: in the frame or in the span a channel is more than one grey level (1/255) from that of naive Phong.",
    )
}

/// Its name, with a star if its picture is another one.
fn name(method: &MethodSpeedups) -> String {
    format!(
        "{}{}",
        method.method,
        if method.is_same_picture() { "" } else { " *" }
    )
}

/// The part of the page.
pub(super) fn section(speedups: &Speedups) -> String {
    let mut html = format!(
        "<section id=\"speedups\"><h2>{TITLE}</h2><p>{}</p>",
        escape(&legend(speedups))
    );
    html += &format!(
        "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"{TITLE}\"><table>"
    );
    html += "<thead><tr><th scope=\"col\">method</th>";
    html += "<th scope=\"col\">off naive<small>levels</small></th>";
    for [what, unit] in speedups.corners.iter().map(head) {
        html += &format!(
            "<th scope=\"col\">{}<small>{}</small></th>",
            escape(&what),
            escape(&unit)
        );
    }
    html += "</tr></thead><tbody>";
    for method in &speedups.methods {
        html += &format!(
            "<tr><th scope=\"row\">{}</th><td>{}</td>",
            escape(&name(method)),
            method.levels_off
        );
        for (speedup, corner) in method.corners.iter().zip(&speedups.corners) {
            let time = time(speedup, corner, speedups.span);
            html += &if method.method == BASELINE {
                format!("<td>{time}</td>")
            } else {
                let (class, ratio) = (
                    verdict(speedup.ratio_to_naive),
                    ratio(speedup.ratio_to_naive),
                );
                format!("<td>{time}<small class=\"{class}\">{ratio}</small></td>")
            };
        }
        html += "</tr>";
    }
    html += "</tbody></table></div>";
    if let Some(footnote) = footnote(speedups) {
        html += &format!("<p class=\"facts\">{footnote}</p>");
    }
    html + &chart(speedups) + "</section>\n"
}

/// The corners with one light, as bars.
fn chart(speedups: &Speedups) -> String {
    let corners: Vec<usize> = (0..speedups.corners.len())
        .filter(|i| speedups.corners[*i].lights == 1)
        .collect();
    let series: Vec<String> = corners
        .iter()
        .map(|i| place(&speedups.corners[*i], speedups))
        .collect();
    let others = speedups
        .methods
        .iter()
        .filter(|method| method.method != BASELINE);
    let group = |method: &MethodSpeedups| Group {
        label: name(method),
        ratios: corners
            .iter()
            .map(|i| method.corners.get(*i)?.ratio_to_naive)
            .collect(),
    };
    let groups: Vec<Group> = others.map(group).collect();
    if groups.is_empty() {
        return String::new();
    }
    format!(
        "<div class=\"charts\"><figure>{}<figcaption>Speed as a multiple of that of naive Phong in each corner, with 95 % \
         intervals, on a logarithmic axis: bars to the right are faster, to the left slower.</figcaption></figure></div>",
        ratio_bars(
            "Speed against naive Phong in four corners",
            &series,
            &groups
        )
    )
}

/// The part of the Markdown: what it says before its table, the head and the rows of that, and what it says after it.
pub(super) fn grid(speedups: &Speedups) -> (String, Vec<String>, Vec<Vec<String>>, &'static str) {
    let mut columns = Vec::from(["method".to_string(), "off naive Phong, levels".to_string()]);
    columns.extend(
        speedups
            .corners
            .iter()
            .map(|corner| head(corner).join(", ")),
    );
    let row = |method: &MethodSpeedups| {
        let mut cells = Vec::from([name(method), method.levels_off.to_string()]);
        cells.extend(
            method
                .corners
                .iter()
                .zip(&speedups.corners)
                .map(|(speedup, corner)| {
                    let time = time(speedup, corner, speedups.span);
                    match speedup.ratio_to_naive {
                        _ if method.method == BASELINE => time,
                        Some(_) => format!("{time}; {}", ratio(speedup.ratio_to_naive)),
                        None => format!("{time}; {NONE}"),
                    }
                }),
        );
        cells
    };
    (
        legend(speedups),
        columns,
        speedups.methods.iter().map(row).collect(),
        footnote(speedups).unwrap_or_default(),
    )
}
