//! Curves as SVG: the plots of the lecture's figures.

use super::charts::{LETTER, WIDTH, nice_step, open, power, superscript};
use super::html::escape;
use crate::lectures::{Plot, Scale, Series};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;

/// Height of the plot without its legend.
const HEIGHT: f64 = 300.0;
/// Height of a line of the legend.
const LINE: f64 = 18.0;
/// Curves of no more points than this show each of them.
const MARKED: usize = 20;
/// Ways to draw a curve: colours, dashes and marks differ, so that none of them alone tells curves apart.
const STYLES: usize = 6;

/// The plot, with a legend above it.
pub(super) fn plot(plot: &Plot) -> String {
    plot_with_fits(plot, &[])
}

/// The plot of measured points, each series with the line that explains it: points of a series that has a line of its own are
/// not joined. `fits` are in the order of the series.
pub(super) fn plot_with_fits(plot: &Plot, fits: &[Vec<(f64, f64)>]) -> String {
    let legend = Legend::of(&plot.series);
    let top = legend.height() + 8.0;
    let measured = || {
        plot.series
            .iter()
            .flat_map(|series| &series.points)
            .chain(fits.iter().flatten())
    };
    let points = || measured().filter(|(x, y)| x.is_finite() && y.is_finite());
    let x = Extent::over(points().map(|p| p.0), plot.x.1, [64.0, WIDTH - 22.0]);
    let y = Extent::over(points().map(|p| p.1), plot.y.1, [top + HEIGHT - 44.0, top]);
    let ([left, right], [bottom, top]) = (x.place, y.place);
    let mut svg = open("curves", &plot.title, bottom + 44.0);
    svg += &format!("<title>{}</title>", escape(&plot.title));
    svg += &grid(&x, &y);
    for mark in plot.marks.iter().filter(|mark| mark.is_finite()) {
        let at = x.at(*mark);
        svg += &format!(
            "<line class=\"one\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{top:.1}\" y2=\"{bottom:.1}\"/>"
        );
    }
    svg += &format!(
        "<text class=\"axis\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        (left + right) / 2.0,
        bottom + 36.0,
        escape(&plot.x.0)
    );
    svg += &format!(
        "<text class=\"axis\" transform=\"translate(14 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        (bottom + top) / 2.0,
        escape(&plot.y.0)
    );
    for (i, series) in plot.series.iter().enumerate() {
        let line = fits
            .get(i)
            .filter(|fit| !fit.is_empty())
            .unwrap_or(&series.points);
        svg += &curve(i, line, &x, &y);
        if series.points.len() <= MARKED {
            svg += &marks(i, &series.points, &x, &y);
        }
    }
    svg += &legend.svg();
    svg + "</svg>"
}

fn grid(x: &Extent, y: &Extent) -> String {
    let ([left, right], [bottom, top]) = (x.place, y.place);
    let mut svg = String::new();
    for (value, text) in x.ticks() {
        let at = x.at(value);
        svg += &format!(
            "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{top:.1}\" y2=\"{bottom:.1}\"/>"
        );
        svg += &format!(
            "<text class=\"tick\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
            bottom + 16.0
        );
    }
    for (value, text) in y.ticks() {
        let at = y.at(value);
        svg += &format!(
            "<line class=\"grid\" x1=\"{left:.1}\" x2=\"{right:.1}\" y1=\"{at:.1}\" y2=\"{at:.1}\"/>"
        );
        svg += &format!(
            "<text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
            left - 6.0,
            at + 4.5
        );
    }
    svg
}

/// A curve, broken where a value is not finite.
fn curve(i: usize, points: &[(f64, f64)], x: &Extent, y: &Extent) -> String {
    let mut path = String::new();
    let mut last = None;
    for &(at_x, at_y) in points {
        if !(at_x.is_finite() && at_y.is_finite()) {
            last = None;
            continue;
        }
        let place = (format!("{:.1}", x.at(at_x)), format!("{:.1}", y.at(at_y)));
        if last.as_ref() == Some(&place) {
            continue;
        }
        path += &format!(
            "{}{} {}",
            if last.is_none() { "M" } else { "L" },
            place.0,
            place.1
        );
        last = Some(place);
    }
    let style = i % STYLES;
    format!("<path class=\"curve s{style}\" fill=\"none\" d=\"{path}\"/>")
}

/// The marks of those points that have a place.
fn marks(i: usize, points: &[(f64, f64)], x: &Extent, y: &Extent) -> String {
    let finite = points
        .iter()
        .filter(|(at_x, at_y)| at_x.is_finite() && at_y.is_finite());
    finite
        .map(|&(at_x, at_y)| mark(i, x.at(at_x), y.at(at_y)))
        .collect()
}

/// The mark of a point, whose shape tells its curve.
fn mark(i: usize, x: f64, y: f64) -> String {
    let style = i % STYLES;
    let class = format!("class=\"mark s{style}\"");
    let path = |d: &str| format!("<path {class} d=\"M{x:.1} {y:.1}{d}\"/>");
    match style {
        0 => format!("<circle {class} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>"),
        1 => path("m-3 -3h6v6h-6z"),
        2 => path("m0 -4.5l4 7h-8z"),
        3 => path("m0 -4.5l4.5 4.5l-4.5 4.5l-4.5 -4.5z"),
        4 => path("m0 4.5l4 -7h-8z"),
        _ => path("m-3.5 -1h7v2h-7z"),
    }
}

/// What the curves are called, with a piece of each.
struct Legend<'a> {
    /// Number and name of each curve, and where it stands: from the left, and in which line.
    entries: Vec<(usize, &'a Series, f64, usize)>,
}

impl<'a> Legend<'a> {
    fn of(series: &'a [Series]) -> Legend<'a> {
        let (mut left, mut line) = (8.0, 0);
        let mut entries = Vec::new();
        for (i, series) in series.iter().enumerate() {
            let width = 44.0 + LETTER * series.label.chars().count() as f64 + 12.0;
            if left > 8.0 && left + width > WIDTH {
                (left, line) = (8.0, line + 1);
            }
            entries.push((i, series, left, line));
            left += width;
        }
        Legend { entries }
    }

    fn height(&self) -> f64 {
        self.entries
            .last()
            .map_or(0.0, |entry| LINE * (entry.3 + 1) as f64)
    }

    fn svg(&self) -> String {
        let mut svg = String::new();
        for &(i, series, left, line) in &self.entries {
            let middle = LINE * line as f64 + 10.0;
            svg += &format!(
                "<path class=\"curve s{}\" fill=\"none\" d=\"M{left:.1} {middle:.1}h36\"/>",
                i % STYLES
            );
            if series.points.len() <= MARKED {
                svg += &mark(i, left + 18.0, middle);
            }
            svg += &format!(
                "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                left + 42.0,
                middle + 4.5,
                escape(&series.label)
            );
        }
        svg
    }
}

/// An axis, linear or logarithmic.
struct Extent {
    scale: Scale,
    /// Its ends: values, or their decimal logarithms.
    from: f64,
    to: f64,
    /// Where they stand.
    place: [f64; 2],
}

impl Extent {
    /// An axis over `values`, with some room at both ends.
    fn over(values: impl Iterator<Item = f64>, scale: Scale, place: [f64; 2]) -> Extent {
        let measured = values
            .filter(|v| v.is_finite() && (scale == Scale::Linear || *v > 0.0))
            .map(|v| match scale {
                Scale::Linear => v,
                Scale::Log => libm::log10(v),
            });
        let (from, to) = measured.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(v), b.max(v))
        });
        if from > to {
            return Extent {
                scale,
                from: 0.0,
                to: 1.0,
                place,
            };
        }
        // Equal values stand in the middle, and not nowhere.
        let room = if to > from {
            0.04 * (to - from)
        } else {
            0.5 * to.abs().max(0.25)
        };
        Extent {
            scale,
            from: from - room,
            to: to + room,
            place,
        }
    }

    /// Where `value` stands; what has no logarithm stands at the lower end.
    fn at(&self, value: f64) -> f64 {
        let measured = match self.scale {
            Scale::Linear => value,
            Scale::Log if value > 0.0 => libm::log10(value),
            Scale::Log => self.from,
        };
        let part = (measured - self.from) / (self.to - self.from);
        self.place[0] + (self.place[1] - self.place[0]) * part.clamp(0.0, 1.0)
    }

    /// Where lines are, and what stands beside them.
    fn ticks(&self) -> Vec<(f64, String)> {
        let Extent {
            scale, from, to, ..
        } = *self;
        match scale {
            Scale::Linear => linear_ticks(from, to),
            Scale::Log => {
                let decades = to - from;
                let every = libm::ceil(decades / 8.0).max(1.0) as i32;
                let multiples: &[f64] = if decades < 2.5 {
                    &[1.0, 2.0, 5.0]
                } else {
                    &[1.0]
                };
                let range = libm::floor(from) as i32..=libm::ceil(to) as i32;
                let mut ticks = Vec::new();
                for decade in range.filter(|decade| decade.rem_euclid(every) == 0) {
                    let unit = libm::pow(10.0, f64::from(decade.abs()));
                    for multiple in multiples {
                        let value = if decade < 0 {
                            multiple / unit
                        } else {
                            multiple * unit
                        };
                        if (from..=to).contains(&libm::log10(value)) {
                            ticks.push((value, power(value)));
                        }
                    }
                }
                ticks
            }
        }
    }
}

/// Multiples of a round step between the ends of an axis.
fn linear_ticks(from: f64, to: f64) -> Vec<(f64, String)> {
    let step = nice_step(to - from);
    if !(step.is_finite() && step > 0.0) {
        return vec![(from, from.to_string())];
    }
    // The tiny part keeps a step of 0.001 in its decade.
    let exponent = libm::floor(libm::log10(step) + 1e-9) as i32;
    let unit = libm::pow(10.0, f64::from(exponent.abs()));
    let text = |value: f64| match exponent {
        0.. => format!("{value:.0}"),
        -3..0 => format!("{value:.*}", exponent.unsigned_abs() as usize),
        _ if value == 0.0 => "0".into(),
        _ => {
            let digits: String = exponent
                .unsigned_abs()
                .to_string()
                .chars()
                .map(superscript)
                .collect();
            format!("{:.0}·10⁻{digits}", value * unit)
        }
    };
    let count = libm::ceil(from / step) as i64..=libm::floor(to / step) as i64;
    // A minus as long as the plus, and none before zero.
    count
        .map(|n| {
            (
                n as f64 * step,
                text(n as f64 * step + 0.0).replace('-', "−"),
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(from: f64, to: f64, scale: Scale) -> Vec<String> {
        let extent = Extent {
            scale,
            from,
            to,
            place: [0.0, 1.0],
        };
        extent.ticks().into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn ticks_are_round_numbers_however_small() {
        assert_eq!(
            texts(-1.0, 1.0, Scale::Linear),
            ["−1.0", "−0.5", "0.0", "0.5", "1.0"]
        );
        assert_eq!(texts(0.0, 640.0, Scale::Linear), ["0", "200", "400", "600"]);
        assert_eq!(
            texts(-2.6e-6, 2.5e-6, Scale::Linear),
            ["−2·10⁻⁶", "−1·10⁻⁶", "0", "1·10⁻⁶", "2·10⁻⁶"]
        );
        assert_eq!(
            texts(-5.2, -0.9, Scale::Log),
            ["10⁻⁵", "10⁻⁴", "0.001", "0.01", "0.1"]
        );
        assert_eq!(texts(0.5, 0.5, Scale::Linear), ["0.5"]);
    }

    #[test]
    fn values_stand_between_the_ends_of_their_axis() {
        let linear = Extent::over(
            [2.0, 12.0, f64::NAN].into_iter(),
            Scale::Linear,
            [0.0, 108.0],
        );
        assert!((linear.at(2.0) - 4.0).abs() < 1e-9 && (linear.at(12.0) - 104.0).abs() < 1e-9);
        let log = Extent::over([0.0, 0.01, 1.0].into_iter(), Scale::Log, [108.0, 0.0]);
        assert!((log.at(0.1) - 54.0).abs() < 1e-9, "upward");
        assert_eq!(
            (log.at(0.0), log.at(1e9)),
            (108.0, 0.0),
            "beyond the ends is at them"
        );
        let one = Extent::over([7.0].into_iter(), Scale::Linear, [0.0, 10.0]);
        assert!((one.at(7.0) - 5.0).abs() < 1e-9);
        let none = Extent::over(core::iter::empty(), Scale::Log, [0.0, 10.0]);
        assert!(none.at(0.0).is_finite());
    }

    /// Points stand where they were measured and are not joined: the line is that of the fit, and the axes reach over both.
    #[test]
    fn points_with_a_fitted_line_are_marked_and_not_joined() {
        let series = vec![
            Series::new("a", [(1.0, 1.0), (10.0, 30.0), (100.0, 100.0)]),
            Series::new("b", [(1.0, 2.0)]),
        ];
        let axis = || ("n".to_string(), Scale::Log);
        let whole = Plot {
            title: "t".into(),
            x: axis(),
            y: axis(),
            series,
            marks: vec![],
            caption: String::new(),
        };
        let drawn = plot_with_fits(&whole, &[vec![(1.0, 1.0), (100.0, 1000.0)], vec![]]);
        let line = drawn
            .split("<path class=\"curve s0\" fill=\"none\" d=\"M")
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap();
        let ends: Vec<f64> = line.split(['L', ' ']).map(|n| n.parse().unwrap()).collect();
        let [left, low, right, high] = ends[..] else {
            panic!("a line of two points: {line}")
        };
        // The middle one of three points is halfway along the axis of x and, on one of three decades, log 30 of three up.
        let middle = (
            0.5 * (left + right),
            low + (high - low) * libm::log10(30.0) / 3.0,
        );
        let circles: Vec<(f64, f64)> = drawn
            .split("<circle class=\"mark s0\" cx=\"")
            .skip(1)
            .map(|text| text.split_once("\" cy=\"").unwrap())
            .map(|(x, rest)| {
                (
                    x.parse().unwrap(),
                    rest.split('"').next().unwrap().parse().unwrap(),
                )
            })
            .collect();
        assert_eq!(circles.len(), 4, "three points, and one in the legend");
        let near = circles
            .iter()
            .filter(|(x, y)| (x - middle.0).abs() < 0.11 && (y - middle.1).abs() < 0.11);
        assert_eq!(near.count(), 1, "{circles:?} {middle:?}");
    }

    #[test]
    fn curves_break_where_there_is_no_value_and_names_are_escaped() {
        let drawn = plot(&Plot {
            title: "<t>".into(),
            x: ("x & y".into(), Scale::Linear),
            y: ("y".into(), Scale::Linear),
            series: vec![Series::new(
                "a<b",
                [(0.0, 0.0), (1.0, f64::NAN), (2.0, 1.0), (3.0, 2.0)],
            )],
            marks: vec![1.5],
            caption: String::new(),
        });
        let path = drawn
            .split("<path class=\"curve s0\" fill=\"none\" d=\"")
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap();
        assert_eq!(
            (path.matches('M').count(), path.matches('L').count()),
            (2, 1),
            "{path}"
        );
        assert!(
            drawn.contains("<title>&lt;t&gt;</title>")
                && drawn.contains("a&lt;b")
                && drawn.contains("x &amp; y")
        );
        assert_eq!(drawn.matches("class=\"one\"").count(), 1);
    }
}
