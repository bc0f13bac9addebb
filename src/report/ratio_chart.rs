//! Ratios in groups of bars, to both sides of 1.

use super::charts::{Axis, LETTER, WIDTH, open};
use super::html::escape;
use crate::compare::comparison::RatioData;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// Bars side by side, as many as there are series.
pub(super) struct Group {
    /// What they are called.
    pub label: String,
    /// Ratios of over 0; `None` leaves a gap.
    pub ratios: Vec<Option<RatioData>>,
}

const LEFT: f64 = 150.0;
const RIGHT: f64 = WIDTH - 40.0;
/// Height of a bar with the gap below it, and of the gap between groups.
const BAR: f64 = 13.0;
const GAP: f64 = 10.0;
/// Height of a line of the legend, and the width of an entry: two stand in a line.
const LINE: f64 = 18.0;
const ENTRY: f64 = WIDTH / 2.0;

/// Groups of ratios on a logarithmic axis: bars from 1 to the right for what is faster, to the left for what is slower, with
/// their intervals. The looks of four series differ.
pub(super) fn ratio_bars(title: &str, series: &[String], groups: &[Group]) -> String {
    let top = LINE * series.len().div_ceil(2) as f64 + 10.0;
    let group = BAR * series.len() as f64 + GAP;
    let bottom = top + group * groups.len() as f64;
    let ends = |ratio: &RatioData| [ratio.ratio.low, ratio.ratio.median, ratio.ratio.high];
    let shown = groups.iter().flat_map(|group| &group.ratios).flatten();
    let axis = Axis::over(shown.flat_map(ends).chain([1.0]), [LEFT, RIGHT]);
    let mut svg = open("ratios", title, bottom + 24.0);
    for (i, name) in series.iter().enumerate() {
        let (left, line) = (8.0 + ENTRY * (i % 2) as f64, LINE * (i / 2) as f64);
        svg += &format!(
            "<rect class=\"ratio r{i}\" x=\"{left:.1}\" y=\"{:.1}\" width=\"24\" height=\"10\"/>",
            line + 4.0
        );
        svg += &format!(
            "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            left + 30.0,
            line + 13.5,
            escape(name)
        );
    }
    for tick in axis.ticks() {
        let at = axis.at(tick);
        svg += &format!(
            "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{top:.1}\" y2=\"{bottom:.1}\"/>"
        );
        let low = bottom + 16.0;
        svg += &format!(
            "<text class=\"tick\" x=\"{at:.1}\" y=\"{low:.1}\" text-anchor=\"middle\">{tick}</text>"
        );
    }
    for (i, one) in groups.iter().enumerate() {
        let top = top + group * i as f64 + GAP / 2.0;
        let middle = top + BAR * series.len() as f64 / 2.0 + 4.0;
        let end = LEFT - 8.0;
        let label = label(&one.label);
        svg +=
            &format!("<text x=\"{end:.1}\" y=\"{middle:.1}\" text-anchor=\"end\">{label}</text>");
        for (j, ratio) in one.ratios.iter().enumerate() {
            if let Some(ratio) = ratio {
                svg += &bar(&axis, j, top + BAR * j as f64, ratio);
            }
        }
    }
    let one = axis.at(1.0);
    svg + &format!(
        "<line class=\"one\" x1=\"{one:.1}\" x2=\"{one:.1}\" y1=\"{top:.1}\" y2=\"{bottom:.1}\"/></svg>"
    )
}

fn bar(axis: &Axis, series: usize, top: f64, RatioData { ratio, tie }: &RatioData) -> String {
    let [one, low, median, high] =
        [1.0, ratio.low, ratio.median, ratio.high].map(|value| axis.at(value));
    let (left, right) = (one.min(median), one.max(median));
    let middle = top + (BAR - 2.0) / 2.0;
    let mut svg = format!(
        "<rect class=\"ratio r{series}\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
        right - left,
        BAR - 2.0
    );
    svg += &format!(
        "<path class=\"interval\" d=\"M{low:.1} {middle:.1}H{high:.1}M{low:.1} {:.1}v4M{high:.1} {:.1}v4\"/>",
        middle - 2.0,
        middle - 2.0
    );
    let text = format!("{}{:.2}", if *tie { "=" } else { "" }, ratio.median);
    svg + &format!(
        "<text class=\"value small\" x=\"{:.1}\" y=\"{:.1}\">{text}</text>",
        high.max(one) + 5.0,
        middle + 4.0
    )
}

/// The label of a group, as long as there is room for.
fn label(text: &str) -> String {
    let most = ((LEFT - 10.0) / LETTER) as usize;
    if text.chars().count() <= most {
        return escape(text);
    }
    let short: String = text.chars().take(most - 1).collect();
    format!("<title>{}</title>{}…", escape(text), escape(&short)).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::timing::Ratio;
    use alloc::vec;

    fn ratio(median: f64) -> Option<RatioData> {
        Some(RatioData::from(Ratio {
            median,
            low: 0.9 * median,
            high: 1.1 * median,
        }))
    }

    fn number(text: &str, key: &str) -> f64 {
        let from = text.find(key).unwrap() + key.len();
        text[from..].split('"').next().unwrap().parse().unwrap()
    }

    #[test]
    fn bars_reach_from_one_to_their_ratio() {
        let series = ["a", "b"].map(String::from);
        let groups = [Group {
            label: "x<y".into(),
            ratios: vec![ratio(2.0), ratio(0.5)],
        }];
        let svg = ratio_bars("t", &series, &groups);
        let bars: Vec<(f64, f64)> = svg
            .split("<rect class=\"ratio ")
            .skip(1 + series.len())
            .map(|bar| (number(bar, " x=\""), number(bar, " width=\"")))
            .collect();
        let one = number(svg.split("<line class=\"one\"").nth(1).unwrap(), " x1=\"");
        // Twice and half as fast are equally long on a logarithmic axis; coordinates have one decimal each.
        assert!(
            (bars[0].0 - one).abs() < 0.11 && (bars[1].0 + bars[1].1 - one).abs() < 0.21,
            "{bars:?} {one}"
        );
        assert!(
            (bars[0].1 - bars[1].1).abs() < 0.21 && bars[0].1 > 50.0,
            "{bars:?}"
        );
        assert!(svg.contains("x&lt;y") && svg.contains(">2.00<") && svg.contains(">0.50<"));
    }

    #[test]
    fn gaps_ties_and_nothing_at_all_are_drawn() {
        let groups = [
            Group {
                label: "a method with a very long name".into(),
                ratios: vec![None, ratio(1.02)],
            },
            Group {
                label: "b".into(),
                ratios: vec![None, None],
            },
        ];
        let svg = ratio_bars("t", &["one".into(), "two".into()], &groups);
        assert!(
            svg.contains(">=1.02<") && svg.matches("class=\"interval\"").count() == 1,
            "{svg}"
        );
        for svg in [svg, ratio_bars("t", &[], &[])] {
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}
