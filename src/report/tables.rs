//! Numbers of rows, as cells.

use super::html::escape;
use super::section::{Section, row_name};
use super::sentences::grouped;
use super::summary::{PROJECT, Tally};
use crate::compare::comparison::table::{
    decibels, levels, milliseconds, signed_levels, significant,
};
use crate::compare::comparison::{BASELINE, DifferenceData, RatioData, RowData, SpeedData};
use crate::shading::Entry;
use alloc::format;
use alloc::string::{String, ToString};

/// What stands where there is nothing to say.
pub(super) const NONE: &str = "–";

/// A column of the table of one scene.
struct Column {
    head: &'static str,
    unit: &'static str,
    /// What it means, for who points at its head.
    meaning: &'static str,
    cell: fn(&RowData) -> String,
}

const fn column(
    head: &'static str,
    unit: &'static str,
    meaning: &'static str,
    cell: fn(&RowData) -> String,
) -> Column {
    Column {
        head,
        unit,
        meaning,
        cell,
    }
}

const COLUMNS: &[Column] = &[
    column(
        "max",
        "levels",
        "largest error of a channel in any pixel, against the f64 Phong reference",
        |r| levels(r.error.difference.max),
    ),
    column(
        "RMS",
        "levels",
        "root of the mean squared error over the covered pixels",
        |r| levels(r.error.difference.rms),
    ),
    column(
        "PSNR",
        "dB",
        "peak signal-to-noise ratio over the whole frame",
        |r| psnr(&r.error),
    ),
    column(
        "SSIM",
        "",
        "mean structural similarity of luminance over the whole frame",
        |r| {
            r.error
                .difference
                .ssim
                .map_or_else(|| NONE.to_string(), |s| format!("{s:.5}"))
        },
    ),
    column(
        "brightness",
        "levels",
        "mean luminance minus that of the reference",
        |r| signed_levels(r.error.difference.signed_mean),
    ),
    column(
        "own max",
        "levels",
        "largest error against the method's own closed form; ! if rounding does not explain it",
        |r| {
            format!(
                "{}{}",
                if r.within_bound { "" } else { "!" },
                levels(r.own.difference.max)
            )
        },
    ),
    column(
        "off by > 1",
        "pixels",
        "pixels with an error of more than one grey level",
        |r| grouped(r.error.difference.over_one_level),
    ),
    column(
        "other polygon",
        "pixels",
        "pixels that show another polygon than the reference; not in the errors",
        |r| grouped(r.other_polygon),
    ),
    column(
        "time",
        "ms",
        "median ± half the interquartile range",
        |r| speed(r, time),
    ),
    column(
        "per pixel",
        "ns",
        "median time divided by the covered pixels",
        |r| {
            speed(r, |s| {
                s.ns_per_covered_pixel
                    .map_or_else(|| NONE.to_string(), significant)
            })
        },
    ),
    column(
        "speed to naive Phong",
        "ratio, 95 %",
        "over 1: faster; =: a tie, the interval holds 1",
        |r| {
            if !r.is_barycentric() && r.variant == BASELINE {
                "1".to_string()
            } else {
                speed(r, |s| ratio(s.ratio_to_naive))
            }
        },
    ),
    column(
        "speed to barycentric",
        "ratio, 95 %",
        "over 1: faster than the barycentric renderer with the same method, or naive Phong where it lacks it",
        |r| speed(r, |s| ratio(s.ratio_to_barycentric)),
    ),
];

/// The table of one scene: a row a method.
pub(super) fn scene(section: &Section) -> String {
    let mut html = String::from("<thead><tr><th scope=\"col\">method</th>");
    for Column {
        head,
        unit,
        meaning,
        ..
    } in COLUMNS
    {
        html += &format!(
            "<th scope=\"col\" title=\"{}\">{}<small>{}</small></th>",
            escape(meaning),
            escape(head),
            escape(unit)
        );
    }
    html += "</tr></thead><tbody>";
    for row in section.all_rows() {
        html += &format!(
            "<tr><th scope=\"row\"{}>{}</th>",
            described(row),
            escape(&row_name(row))
        );
        for column in COLUMNS {
            html += &format!("<td>{}</td>", escape(&(column.cell)(row)));
        }
        html += "</tr>";
    }
    html + "</tbody>"
}

fn described(row: &RowData) -> String {
    Entry::named(&row.method).map_or_else(String::new, |entry| {
        format!(" title=\"{}\"", escape(entry.info.title))
    })
}

/// The answer to the Programming Project: times of its four methods in every scene, and ratios to naive Phong.
pub(super) fn project(sections: &[Section], link: impl Fn(usize) -> String) -> String {
    let mut html =
        String::from("<thead><tr><th scope=\"col\">scene</th><th scope=\"col\">polygons</th>");
    html += "<th scope=\"col\">covered<small>pixels</small></th>";
    for (_, name) in PROJECT {
        html += &format!("<th scope=\"col\">{name}<small>ms; ratio</small></th>");
    }
    html += "</tr></thead><tbody>";
    for (i, section) in sections.iter().enumerate() {
        html += &format!(
            "<tr><th scope=\"row\"><a href=\"#{}\">{}</a></th>",
            link(i),
            escape(&section.caption.title)
        );
        html += &format!(
            "<td>{}</td><td>{}</td>",
            grouped(section.data.polygons),
            grouped(section.data.covered_pixels)
        );
        for (method, _) in PROJECT {
            html += &match section.row(method).and_then(|row| row.speed.as_ref()) {
                None => format!("<td>{NONE}</td>"),
                Some(s) if method == BASELINE => format!("<td>{}</td>", time(s)),
                Some(s) => format!(
                    "<td>{}<small class=\"{}\">{}</small></td>",
                    time(s),
                    verdict(s.ratio_to_naive),
                    ratio(s.ratio_to_naive)
                ),
            };
        }
        html += "</tr>";
    }
    html += "</tbody>";
    if sections.len() > 1 {
        html += "<tfoot><tr><th scope=\"row\">geometric mean</th><td></td><td></td>";
        for (method, _) in PROJECT {
            let mean = Tally::of(method, sections)
                .map_or_else(|| NONE.to_string(), |tally| format!("{:.2}", tally.mean));
            html += &format!("<td>{}</td>", if method == BASELINE { "1" } else { &mean });
        }
        html += "</tr></tfoot>";
    }
    html
}

/// The class of a ratio: `faster`, `slower` or `tie`.
pub(super) fn verdict(ratio: Option<RatioData>) -> &'static str {
    match ratio {
        Some(r) if !r.tie && r.ratio.median > 1.0 => "faster",
        Some(r) if !r.tie => "slower",
        _ => "tie",
    }
}

fn speed(row: &RowData, cell: impl Fn(&SpeedData) -> String) -> String {
    row.speed.as_ref().map_or_else(|| NONE.to_string(), cell)
}

/// `12.3 ± 0.4`, in ms.
pub(super) fn time(speed: &SpeedData) -> String {
    let timing = &speed.timing;
    let digits = crate::compare::comparison::table::decimals(timing.median_ns / 1e6);
    format!(
        "{} ± {:.digits$}",
        milliseconds(timing.median_ns),
        (timing.p75_ns - timing.p25_ns) / 2e6
    )
}

/// `1.32 (1.30–1.35)`, with `=` in front of a tie.
pub(super) fn ratio(ratio: Option<RatioData>) -> String {
    let Some(RatioData { ratio, tie }) = ratio else {
        return NONE.to_string();
    };
    // Every round the same as the baseline: it is the baseline.
    if ratio.low == 1.0 && ratio.high == 1.0 {
        return "1".to_string();
    }
    format!(
        "{}{:.2} ({:.2}–{:.2})",
        if tie { "=" } else { "" },
        ratio.median,
        ratio.low,
        ratio.high
    )
}

fn psnr(error: &DifferenceData) -> String {
    decibels(&error.difference)
}
