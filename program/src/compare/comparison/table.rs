//! Comparisons as text for terminals, with a row for each method.

use super::{Comparison, DrawnBy, MethodRow, Speed};
use crate::compare::table::Table;
use crate::compare::timing::Ratio;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use fastphong::compare::metrics::Difference;
use fastphong::reference::Clamping;

/// The columns of a table. All kinds show error and speed. They also count the pixels that show a
/// different polygon from the reference, if there are any, and the clamped pixels, if there are
/// many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableKind {
    /// The most important columns of error and speed, which fit in 100 characters.
    Short,
    /// All columns of the error, and the most important ones of the speed.
    Compare,
    /// All columns of the speed, and the most important ones of the error.
    Bench,
}

/// A column: its heading, and a function that returns the cell of a row, or `None` for a dash.
type Column = (&'static str, fn(&MethodRow) -> Option<String>);

const METHOD: Column = ("method", |row| {
    let is_scanlines = row.drawn_by != DrawnBy::BARYCENTRIC;
    let by = if is_scanlines { "" } else { ", barycentric" };
    Some(row.name() + by)
});
/// The method, with a mark if it misses its own closed form. For tables without the column
/// `own max`.
const MARKED_METHOD: Column = ("method", |row| {
    let mark = if row.within_bound { "" } else { " !" };
    Some((METHOD.1)(row)? + mark)
});
const OTHER_POLYGON: Column = ("other", |row| Some(row.other_polygon.to_string()));
const CLAMPED: Column = ("clamped", |row| Some(row.clamped.to_string()));
const MAX: Column = ("max", |row| Some(levels(row.error.max)));
const RMS: Column = ("RMS", |row| Some(levels(row.error.rms)));
const TIME: Column = ("time, ms", |row| row.speed.as_ref().map(time));
const PER_PIXEL: Column = ("ns per pixel", |row| {
    Some(significant(row.speed.as_ref()?.ns_per_covered_pixel?))
});
const NAIVE: Column = ("× naive-phong", |row| {
    ratio(&row.speed.as_ref()?.ratio_to_naive?)
});
const BARYCENTRIC: Column = ("× barycentric", |row| {
    ratio(&row.speed.as_ref()?.ratio_to_barycentric?)
});
const INTERVAL: &str = "95 %";
/// The columns that say nothing where the machine was too busy.
const SPEED: [&str; 5] = [TIME.0, PER_PIXEL.0, NAIVE.0, BARYCENTRIC.0, INTERVAL];
/// The ratio of the work of all threads, where the machine was too busy to tell speeds.
const WORK: Column = ("× naive by work", |row| {
    ratio(&row.speed.as_ref()?.work_to_naive?)
});

const SHORT: &[Column] = &[
    MARKED_METHOD,
    MAX,
    RMS,
    OTHER_POLYGON,
    CLAMPED,
    TIME,
    NAIVE,
    BARYCENTRIC,
    WORK,
];

const COMPARE: &[Column] = &[
    METHOD,
    MAX,
    RMS,
    ("PSNR, dB", |row| Some(decibels(&row.error))),
    ("SSIM", |row| Some(format!("{:.5}", row.error.ssim?))),
    ("FLIP", |row| Some(format!("{:.5}", row.error.flip?))),
    ("brightness", |row| {
        Some(signed_levels(row.error.signed_mean))
    }),
    ("own max", |row| {
        let mark = if row.within_bound { "" } else { "!" };
        Some(format!("{mark}{}", levels(row.own.max)))
    }),
    ("over 1 level", |row| {
        Some(row.error.over_one_level.to_string())
    }),
    OTHER_POLYGON,
    CLAMPED,
    TIME,
    PER_PIXEL,
    NAIVE,
    BARYCENTRIC,
    WORK,
];

const BENCH: &[Column] = &[
    MARKED_METHOD,
    TIME,
    PER_PIXEL,
    NAIVE,
    (INTERVAL, |row| {
        interval(row.speed.as_ref()?.ratio_to_naive?)
    }),
    BARYCENTRIC,
    (INTERVAL, |row| {
        interval(row.speed.as_ref()?.ratio_to_barycentric?)
    }),
    WORK,
    MAX,
    RMS,
    OTHER_POLYGON,
    CLAMPED,
];

/// The share of covered pixels that show a different polygon from which on the table warns, in
/// percent.
const OTHERS: f64 = 0.1;

/// Returns the row with the most pixels of other polygons, and their share of the covered pixels in
/// percent, if it is over [`OTHERS`].
fn most_others(comparison: &Comparison) -> Option<(&MethodRow, f64)> {
    let row = comparison.all_rows().max_by_key(|row| row.other_polygon)?;
    let share = 100.0 * row.other_polygon as f64 / comparison.covered_pixels.max(1) as f64;
    (share > OTHERS).then_some((row, share))
}

/// Returns a comparison as text: some lines on the frame, a row for each method, then notes.
pub fn table(comparison: &Comparison, kind: TableKind) -> String {
    let columns = match kind {
        TableKind::Short => SHORT,
        TableKind::Compare => COMPARE,
        TableKind::Bench => BENCH,
    };
    // Such pixels are rare, so short tables have the column only if there are any.
    let has_others = comparison.all_rows().any(|row| row.other_polygon > 0);
    let shows_others = has_others || kind == TableKind::Compare;
    let shows_clamped = comparison.clamping.is_notable() || kind == TableKind::Compare;
    // Times that say nothing are not shown. What several threads worked says something.
    let is_too_busy = comparison.is_too_busy();
    let has_work = |row: &MethodRow| {
        row.speed
            .as_ref()
            .is_some_and(|s| s.work_to_naive.is_some())
    };
    let shows_work = is_too_busy && comparison.rows.iter().any(has_work);
    let is_shown = |column: &&Column| match column.0 {
        name if name == OTHER_POLYGON.0 => shows_others,
        name if name == CLAMPED.0 => shows_clamped,
        name if SPEED.contains(&name) => !is_too_busy,
        name if name == WORK.0 => shows_work,
        _ => true,
    };
    let columns: Vec<&Column> = columns.iter().filter(is_shown).collect();
    let heads: Vec<&str> = columns.iter().map(|(head, _)| *head).collect();
    let mut table = Table::new(&*comparison.name, &heads);
    let cell = |row, (_, cell): &&Column| cell(row).unwrap_or_else(|| "-".to_string());
    let cells = |row| columns.iter().map(|column| cell(row, column)).collect();
    table.rows.extend(comparison.all_rows().map(cells));
    let mut text = head(comparison) + &table.text();
    if let Some(noise) = &comparison.noise {
        text += &format!("{} ({} rounds)\n", noise.sentence, noise.rounds);
    }
    if comparison.all_rows().any(|row| !row.within_bound) {
        text += "! farther from its own closed form than rounding explains\n";
    }
    for row in comparison.rows.iter().filter(|row| !row.kinds.is_empty()) {
        let kinds: Vec<String> = row
            .kinds
            .iter()
            .map(|kind| format!("{} {}", kind.polygons, kind.name))
            .collect();
        text += &format!("{}: polygons by kind: {}\n", row.name(), kinds.join(", "));
    }
    for left_out in &comparison.left_out {
        text += &format!("{} is left out: {}\n", left_out.variant, left_out.reason);
    }
    if let Some((row, share)) = most_others(comparison) {
        text += &format!(
            "! {} shows a different polygon from the reference at {share:.2} % of the covered pixels: the depths there are equal up to \
             rounding, and the errors do not include these pixels\n",
            cell(row, &&METHOD)
        );
    }
    if shows_clamped {
        text += "clamped: covered pixels with a channel at 1, where light is cut off\n";
    }
    if shows_others {
        text += "other: pixels that show a different polygon from the reference; they are not compared\n";
    }
    if let Some(note) = clamping_note(&comparison.clamping) {
        text += &format!("warning: {note}\n");
    }
    text
}

/// Returns a warning that errors mean less if much of the light is clamped, or `None` if little is.
pub(crate) fn clamping_note(clamping: &Clamping) -> Option<String> {
    clamping.is_notable().then(|| {
        let share = 100.0 * clamping.share();
        format!(
            "the light is over 1 in {share:.1} % of the covered picture and is clamped: all methods draw the same colour there, \
             so that errors vanish"
        )
    })
}

/// Returns the lines above the table: the frame, the engines, and how to read the columns.
fn head(c: &Comparison) -> String {
    let count = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let polygons = if c.polygons < c.stats.polygons {
        format!("{} of {}", c.polygons, count(c.stats.polygons, "polygon"))
    } else {
        count(c.polygons, "polygon")
    };
    let mut text = format!("{}: {}×{}, {polygons}", c.name, c.width, c.height);
    if c.triangles != c.polygons {
        text += &format!(" ({})", count(c.triangles, "triangle"));
    }
    let share = 100.0 * c.covered_pixels as f64 / (c.width * c.height) as f64;
    let covered = count(c.covered_pixels, "pixel");
    text += &format!(", {covered} ({share:.1} %) covered");
    if c.covered_pixels > 0 {
        let times = c.fragments as f64 / c.covered_pixels as f64;
        text += &format!(" {times:.2} times");
    }
    text += &format!(", {}\n", count(c.lights, "light"));
    for line in drawn_by(c) {
        text += &format!("drawn by {line}\n");
    }
    if c.not_simple > 0 {
        let crossing = count(c.not_simple, "self-crossing polygon");
        text += &format!("{crossing} not drawn by the barycentric renderer\n");
    }
    text += "errors against the f64 Phong reference, in grey levels (1/255) of linear light before rounding\n";
    if c.all_rows().any(|row| row.speed.is_some()) && !c.is_too_busy() {
        text += "time: from projected frame to stored picture, ± half the 95 % interval\n";
        text += "× columns: speed-up, above 1 is faster; = is a tie, where the samples do not show which is\n";
    }
    text + "\n"
}

/// Returns lines on which engine drew which rows. One line without names if it was the same for all
/// rows.
fn drawn_by(c: &Comparison) -> Vec<String> {
    let mut groups: Vec<(DrawnBy, Vec<String>)> = Vec::new();
    for row in &c.rows {
        match groups.iter_mut().find(|(by, _)| *by == row.drawn_by) {
            Some((_, names)) => names.push(row.name()),
            None => groups.push((row.drawn_by, Vec::from([row.name()]))),
        }
    }
    match &groups[..] {
        [(by, _)] => Vec::from([by.to_string()]),
        groups => {
            let line = |(by, names): &(DrawnBy, Vec<String>)| format!("{by}: {}", names.join(", "));
            groups.iter().map(line).collect()
        }
    }
}

/// Writes an error in grey levels.
pub(crate) fn levels(error: f64) -> String {
    match error {
        0.0 => "0".to_string(),
        _ => significant(255.0 * error),
    }
}

/// Writes a difference in grey levels with its sign. A value that rounds to zero is `+0.000`.
fn signed_levels(error: f64) -> String {
    format!("{:+.3}", 255.0 * error).replace("-0.000", "+0.000")
}

fn decibels(difference: &Difference) -> String {
    if difference.psnr.is_finite() {
        format!("{:.1}", difference.psnr)
    } else {
        "equal".to_string()
    }
}

fn time(speed: &Speed) -> String {
    let timing = &speed.timing;
    let half = (timing.high_ns - timing.low_ns) / 2e6;
    // No more digits than are known.
    let digits = (0..6).find(|digits| half >= 0.95 * libm::pow(0.1, f64::from(*digits)));
    let digits = digits.unwrap_or(6) as usize;
    format!("{:.digits$} ± {half:.digits$}", timing.typical_ns / 1e6)
}

/// Writes a value with three significant digits, without an exponent and with at most six decimals.
pub(crate) fn significant(value: f64) -> String {
    format!("{value:.*}", decimals(value))
}

fn decimals(value: f64) -> usize {
    let is_enough = |digits: &usize| value >= 100.0 / libm::pow(10.0, *digits as f64);
    (0..6).find(is_enough).unwrap_or(6)
}

/// Writes a ratio with the digits that are known, and `=` in front if it is a tie. The baseline
/// itself has exactly the ratio 1.
fn ratio(ratio: &Ratio) -> Option<String> {
    let tie = if ratio.tie { "=" } else { "" };
    match (ratio.low, ratio.high) {
        (1.0, 1.0) => Some("1".to_string()),
        _ => Some(format!("{tie}{}", ratio.known()?)),
    }
}

fn interval(ratio: Ratio) -> Option<String> {
    let is_baseline = (ratio.low, ratio.high) == (1.0, 1.0);
    (!is_baseline).then(|| format!("{:.2} to {:.2}", ratio.low, ratio.high))
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
        let text = |low, median, high| ratio(&Ratio::new(low, median, high));
        assert_eq!(text(1.44, 1.5, 1.56).as_deref(), Some("1.5"));
        assert_eq!(text(0.99, 1.01, 1.03).as_deref(), Some("=1.01"));
        assert_eq!(text(1.0, 1.0, 1.0).as_deref(), Some("1"));
        assert_eq!(text(0.5, 1.0, 2.0), None, "not one digit is known");
        assert_eq!(interval(Ratio::new(1.0, 1.0, 1.0)), None);
    }
}
