//! Comparisons as text: a row a method, in aligned columns. A view of the data by [`Table`].

use super::{Comparison, Engine, RendererData, Row, Speed};
use crate::compare::metrics::Difference;
use crate::compare::table::Table;
use crate::compare::timing::Ratio;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// The columns of a table. All show error and speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableKind {
    /// Six columns that fit 100 characters: the essence of error and speed.
    Short,
    /// All of the error, and the essence of the speed.
    Compare,
    /// All of the speed, and the essence of the error.
    Bench,
}

/// A column: its head, and the cell of a row.
type Column = (&'static str, fn(&Row) -> String);

const METHOD: Column = ("method", method);
const MAX: Column = ("max", |row| levels(row.error.max));
const RMS: Column = ("RMS", |row| levels(row.error.rms));
const TIME: Column = ("time, ms", |row| speed(row, time));
const PER_PIXEL: Column = ("ns a pixel", |row| {
    speed(row, |s| optional(s.ns_per_covered_pixel, significant))
});
const NAIVE: Column = ("× naive-phong", |row| {
    speed(row, |s| optional(s.ratio_to_naive, |r| ratio(&r)))
});
const BARYCENTRIC: Column = ("× barycentric", |row| {
    speed(row, |s| optional(s.ratio_to_barycentric, |r| ratio(&r)))
});

const SHORT: &[Column] = &[METHOD, MAX, RMS, TIME, NAIVE, BARYCENTRIC];

const COMPARE: &[Column] = &[
    METHOD,
    MAX,
    RMS,
    ("PSNR, dB", |row| decibels(&row.error)),
    ("SSIM", |row| {
        optional(row.error.ssim, |s| format!("{s:.5}"))
    }),
    ("FLIP", |row| {
        optional(row.error.flip, |f| format!("{f:.5}"))
    }),
    ("brightness", |row| signed_levels(row.error.signed_mean)),
    ("own max", own),
    ("over 1 level", |row| row.error.over_one_level.to_string()),
    ("other polygon", |row| row.other_polygon.to_string()),
    TIME,
    PER_PIXEL,
    NAIVE,
    BARYCENTRIC,
];

const BENCH: &[Column] = &[
    METHOD,
    TIME,
    ("least, ms", |row| {
        speed(row, |s| milliseconds(s.timing.min_ns))
    }),
    ("rounds", |row| {
        speed(row, |s| s.timing.samples_ns.len().to_string())
    }),
    PER_PIXEL,
    NAIVE,
    ("95 %", |row| {
        speed(row, |s| optional(s.ratio_to_naive, interval))
    }),
    BARYCENTRIC,
    ("95 %", |row| {
        speed(row, |s| optional(s.ratio_to_barycentric, interval))
    }),
    MAX,
    RMS,
];

/// Writes a comparison as text: some lines on the frame, then a row a method.
pub fn table(comparison: &Comparison, kind: TableKind) -> String {
    let columns = match kind {
        TableKind::Short => SHORT,
        TableKind::Compare => COMPARE,
        TableKind::Bench => BENCH,
    };
    let heads: Vec<&str> = columns.iter().map(|(head, _)| *head).collect();
    let mut table = Table::new(&*comparison.name, &heads);
    let cells = |row| columns.iter().map(|(_, cell)| cell(row)).collect();
    table.rows.extend(comparison.all_rows().map(cells));
    let mut text = head(comparison) + &table.text();
    if comparison.all_rows().any(|row| !row.is_within_bound()) {
        text.push_str("! farther from its own closed form than rounding explains\n");
    }
    text
}

/// What is compared, on what, and how to read it.
fn head(c: &Comparison) -> String {
    let count = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let mut text = format!(
        "{}: {}×{}, {}",
        c.name,
        c.width,
        c.height,
        count(c.polygons, "polygon")
    );
    if c.triangles != c.polygons {
        text.push_str(&format!(" worth {}", count(c.triangles, "triangle")));
    }
    let share = 100.0 * c.covered_pixels as f64 / (c.width * c.height) as f64;
    text.push_str(&format!(
        ", {} ({share:.1} %) covered",
        count(c.covered_pixels, "pixel")
    ));
    if c.covered_pixels > 0 {
        text.push_str(&format!(
            " {:.2} times",
            c.fragments as f64 / c.covered_pixels as f64
        ));
    }
    text.push_str(&format!(", {}\n", count(c.lights, "light")));
    for (line, names) in drawn_by(c) {
        text.push_str(&format!("drawn by {line}{names}\n"));
    }
    if c.not_simple > 0 {
        let crossing = count(c.not_simple, "polygon");
        text.push_str(&format!(
            "{crossing} crossing themselves: not drawn by the barycentric renderer\n"
        ));
    }
    text.push_str("errors against the f64 Phong reference, in grey levels (1/255) of linear light before rounding\n");
    if c.all_rows().any(|row| row.speed.is_some()) {
        text.push_str(
            "time: from projected frame to stored picture, median ± half the interquartile range\n",
        );
        text.push_str("speed over 1: faster; =: a tie, the 95 % interval holds 1\n");
    }
    text.push('\n');
    text
}

/// Who drew what, and on what; all rows on one line if it was the same for all of them.
fn drawn_by(c: &Comparison) -> Vec<(String, String)> {
    let mut groups: Vec<(String, Vec<String>)> = Vec::new();
    for row in &c.rows {
        let line = RendererData::of_row(row).line();
        match groups.iter_mut().find(|(other, _)| *other == line) {
            Some((_, names)) => names.push(row.name()),
            None => groups.push((line, Vec::from([row.name()]))),
        }
    }
    let several = groups.len() > 1;
    let names = |names: Vec<String>| {
        if several {
            format!(": {}", names.join(", "))
        } else {
            String::new()
        }
    };
    groups
        .into_iter()
        .map(|(line, rows)| (line, names(rows)))
        .collect()
}

/// What stands where there is nothing to say.
const NONE: &str = "-";

fn method(row: &Row) -> String {
    match row.engine {
        Engine::Scanlines(_) => row.name(),
        Engine::Barycentric => format!("{}, barycentric", row.name()),
    }
}

fn optional<T>(value: Option<T>, text: impl Fn(T) -> String) -> String {
    value.map_or_else(|| NONE.to_string(), text)
}

fn speed(row: &Row, text: impl Fn(&Speed) -> String) -> String {
    optional(row.speed.as_ref(), text)
}

pub(crate) fn levels(error: f64) -> String {
    if error == 0.0 {
        "0".to_string()
    } else {
        significant(255.0 * error)
    }
}

pub(crate) fn signed_levels(error: f64) -> String {
    // What rounds to zero has no sign.
    let text = format!("{:+.3}", 255.0 * error);
    if text == "-0.000" {
        "+0.000".to_string()
    } else {
        text
    }
}

fn own(row: &Row) -> String {
    format!(
        "{}{}",
        if row.is_within_bound() { "" } else { "!" },
        levels(row.own.max)
    )
}

pub(crate) fn decibels(difference: &Difference) -> String {
    if difference.psnr.is_finite() {
        format!("{:.1}", difference.psnr)
    } else {
        "equal".to_string()
    }
}

fn time(speed: &Speed) -> String {
    let half_range = (speed.timing.p75_ns - speed.timing.p25_ns) / 2.0;
    let digits = decimals(speed.timing.median_ns / 1e6);
    format!(
        "{} ± {:.digits$}",
        milliseconds(speed.timing.median_ns),
        half_range / 1e6
    )
}

pub(crate) fn milliseconds(ns: f64) -> String {
    significant(ns / 1e6)
}

/// Three significant digits, but never in powers of ten, and at most six decimals.
pub(crate) fn significant(value: f64) -> String {
    format!("{value:.*}", decimals(value))
}

pub(crate) fn decimals(value: f64) -> usize {
    (0..6)
        .find(|&digits| value >= 100.0 / libm::pow(10.0, digits as f64))
        .unwrap_or(6)
}

fn ratio(ratio: &Ratio) -> String {
    // Every round the same as the baseline: it is the baseline.
    if ratio.low == 1.0 && ratio.high == 1.0 {
        return "1".to_string();
    }
    format!(
        "{}{:.2}",
        if ratio.is_tie() { "=" } else { "" },
        ratio.median
    )
}

fn interval(ratio: Ratio) -> String {
    if ratio.low == 1.0 && ratio.high == 1.0 {
        return NONE.to_string();
    }
    format!("{:.2} to {:.2}", ratio.low, ratio.high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let texts = [1234.4, 100.0, 99.96, 12.345, 1.0, 0.1234, 0.00012, 0.0].map(significant);
        assert_eq!(
            texts,
            [
                "1234", "100", "100.0", "12.3", "1.00", "0.123", "0.000120", "0.000000"
            ]
        );
    }

    #[test]
    fn no_sign_without_a_difference() {
        assert_eq!(
            [0.0, -1e-9, -0.01, 0.01].map(signed_levels),
            ["+0.000", "+0.000", "-2.550", "+2.550"]
        );
    }

    #[test]
    fn small_errors_are_not_rounded_away() {
        assert_eq!(
            [0.0, 1e-6, 0.01, 0.5].map(levels),
            ["0", "0.000255", "2.55", "128"]
        );
    }

    #[test]
    fn ties_are_marked() {
        assert_eq!(
            ratio(&Ratio {
                median: 1.5,
                low: 1.4,
                high: 1.6
            }),
            "1.50"
        );
        assert_eq!(
            ratio(&Ratio {
                median: 1.01,
                low: 0.99,
                high: 1.03
            }),
            "=1.01"
        );
        let itself = Ratio {
            median: 1.0,
            low: 1.0,
            high: 1.0,
        };
        assert_eq!([ratio(&itself), interval(itself)], ["1", "-"]);
    }
}
