//! The page around the scenes.

use super::charts::{Point, scatter};
use super::html::{POLICY, STYLE, command, escape, escape_script, identifier};
use super::sentences::{count, opening};
use super::summary::overall;
use super::{Report, Section, lecture, operations, scaling, scene, speedups, tables};
use crate::compare::comparison::{WHAT_IS_COMPARED, WHAT_IS_TIMED};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

const SCRIPT: &str = include_str!("page/page.js");

pub(super) fn page(report: &Report) -> String {
    let ids = ids(&report.sections);
    let scenes = || report.sections.iter().zip(&ids);
    let mut html =
        String::from("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    html += &format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n");
    html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    html += "<title>fastphong: shading methods compared</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n";
    html += STYLE;
    html.extend(scenes().map(|(section, id)| scene::style(section, id)));
    html += "</style>\n</head>\n<body id=\"top\">\n<header>\n<h1>Shading methods compared</h1>\n";
    for paragraph in paragraphs(report) {
        html += &format!("<p class=\"opening\">{}</p>\n", escape(&paragraph));
    }
    html += &navigation(report, &ids);
    html += "</header>\n<main>\n";
    html += &report
        .studies
        .speedups
        .as_ref()
        .map(speedups::section)
        .unwrap_or_default();
    html += &project(report, &ids);
    html += &report
        .studies
        .scaling
        .as_ref()
        .map(scaling::section)
        .unwrap_or_default();
    html += &operation_counts();
    html += &measurement(report);
    if !report.lecture.is_empty() {
        html += &lecture::section(&report.lecture, "h2");
    }
    for (section, id) in scenes() {
        html += &scene::html(section, id, report);
        html.push('\n');
    }
    html += "</main>\n";
    html += &format!(
        "<script type=\"application/json\" id=\"fastphong-data\">{}</script>\n",
        escape_script(&report.json())
    );
    html + &format!("<script>\n{SCRIPT}</script>\n</body>\n</html>\n")
}

/// What stands before all else: where naive Phong wins, then what was found in the scenes.
pub(super) fn paragraphs(report: &Report) -> Vec<String> {
    let corners = report
        .studies
        .speedups
        .as_ref()
        .map(speedups::opening)
        .unwrap_or_default();
    let all = [corners, opening(&report.sections, &report.machine)];
    all.iter()
        .filter(|sentences| !sentences.is_empty())
        .map(|sentences| sentences.join(" "))
        .collect()
}

/// The names of the sections' elements, each once.
fn ids(sections: &[Section]) -> Vec<String> {
    let mut ids: Vec<String> = Vec::new();
    for section in sections {
        let name = format!("scene-{}", identifier(&section.data.name));
        let others = (2..).map(|n| format!("{name}-{n}"));
        let free = core::iter::once(name.clone())
            .chain(others)
            .find(|id| !ids.contains(id));
        ids.extend(free);
    }
    ids
}

fn navigation(report: &Report, ids: &[String]) -> String {
    let mut html = String::from("<nav aria-label=\"Sections\"><ul>");
    if report.studies.speedups.is_some() {
        html += &format!("<li><a href=\"#speedups\">{}</a></li>", speedups::TITLE);
    }
    if report.studies.scaling.is_some() {
        html += &format!("<li><a href=\"#scaling\">{}</a></li>", scaling::TITLE);
    }
    if !report.lecture.is_empty() {
        html += &format!("<li><a href=\"#lecture\">{}</a></li>", lecture::TITLE);
    }
    for (section, id) in report.sections.iter().zip(ids) {
        html += &format!(
            "<li><a href=\"#{id}\">{}</a></li>",
            escape(&section.caption.title)
        );
    }
    html + "</ul></nav>\n"
}

/// The lecture's Programming Project, and the chart over all scenes.
fn project(report: &Report, ids: &[String]) -> String {
    let mut html =
        String::from("<section id=\"project\"><h2>The Programming Project of the lecture</h2>");
    html += "<p>Lecture 21 asks to compare the speeds of Gouraud, naive Phong, fast Phong and slerp Phong shading on several \
             large models. Times are medians of whole pictures ± half the interquartile range. Ratios are speeds as \
             multiples of that of naive Phong, round by round, with their 95 % interval: over 1 is faster; = is a tie, the \
             interval holds 1.</p>";
    html += "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"The Programming Project\">";
    html += &format!(
        "<table>{}</table></div>",
        tables::project(&report.sections, |i| ids[i].clone())
    );
    let points: Vec<Point> = overall(&report.sections)
        .into_iter()
        .map(|o| Point {
            label: o.name,
            time: o.time,
            error: 255.0 * o.rms,
            is_barycentric: o.is_barycentric,
        })
        .collect();
    if !points.is_empty() {
        let axes = ["time, naive Phong = 1", "RMS error, grey levels"];
        html += &format!(
            "<div class=\"charts\"><figure>{}<figcaption>Error over time in {}: geometric mean of the times against naive \
             Phong, quadratic mean of the RMS errors, both on logarithmic axes; lower left is better. The dashed line \
             joins the methods that no other one beats in both.</figcaption></figure></div>",
            scatter("Error over time in all scenes", axes, &points),
            if points.is_empty() {
                String::new()
            } else {
                count(report.sections.len(), "scene")
            }
        );
    }
    html + "</section>\n"
}

fn operation_counts() -> String {
    format!(
        "<section id=\"operations\"><h2>Operations</h2><p>{}</p><div class=\"wide\" role=\"region\" tabindex=\"0\" \
         aria-label=\"Operations\"><table class=\"operations\">{}</table></div></section>\n",
        escape(operations::LEGEND),
        operations::html()
    )
}

/// What was measured, on what, and how to do it again.
fn measurement(report: &Report) -> String {
    let m = &report.machine;
    let renderer = report
        .sections
        .first()
        .map(|section| section.data.renderer.clone())
        .unwrap_or_default();
    let cores = format!(
        "{}; {}",
        count(m.cores, "logical processor"),
        count(renderer.threads, "thread")
    );
    let rows = [
        ("processor", m.cpu.clone()),
        ("", cores),
        ("system", format!("{} {}", m.os, m.arch)),
        (
            "compiled by",
            format!("{}, {}, opt-level {}", m.rustc, m.profile, m.opt_level),
        ),
        (
            "for",
            if m.target_features.is_empty() {
                String::new()
            } else {
                m.target_features.join(", ")
            },
        ),
        (
            "fastphong",
            m.version.clone()
                + &m.commit
                    .as_ref()
                    .map(|c| format!(", commit {c}"))
                    .unwrap_or_default(),
        ),
        ("date", report.date.clone().unwrap_or_default()),
        ("drawn by", renderer.line()),
        ("a time", WHAT_IS_TIMED.to_string()),
        ("an error", WHAT_IS_COMPARED.to_string()),
    ];
    let mut html = String::from("<section id=\"measurement\"><h2>Measurement</h2><dl>");
    for (term, text) in rows.iter().filter(|(_, text)| !text.is_empty()) {
        html += &if term.is_empty() {
            format!("<dd>{}</dd>", escape(text))
        } else {
            format!("<dt>{term}</dt><dd>{}</dd>", escape(text))
        };
    }
    html += &format!(
        "<dt>made by</dt><dd><code>{}</code></dd></dl>",
        escape(&command(&report.command_line))
    );
    html + "<p>All numbers, with every sample, are in this file: the JSON in its element <code>fastphong-data</code>.</p></section>\n"
}
