//! Charts as SVG, drawn by hand: text stays text, colours come from the page.

use super::html::escape;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// Width of every chart in its own units; a unit is a pixel where the page is wide enough.
pub(super) const WIDTH: f64 = 560.0;
/// Mean width of a letter at the charts' 13 units, for labels that must not overlap.
pub(super) const LETTER: f64 = 7.2;

/// A bar: a ratio with its interval.
pub(super) struct Bar {
    /// What it is called.
    pub label: String,
    /// How long it is.
    pub value: f64,
    /// The interval.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
    /// True if the interval holds 1.
    pub is_tie: bool,
    /// True if it stands for the renderer that others are measured against.
    pub is_barycentric: bool,
}

/// Ratios as bars from 0, with their intervals, and a line at 1.
pub(super) fn bars(title: &str, bars: &[Bar]) -> String {
    const LEFT: f64 = 180.0;
    const RIGHT: f64 = WIDTH - 54.0;
    const ROW: f64 = 24.0;
    let most = bars
        .iter()
        .map(|bar| bar.high.max(bar.value))
        .filter(|v| v.is_finite())
        .fold(1.0, f64::max);
    let x = |value: f64| LEFT + (RIGHT - LEFT) * (value / most).clamp(0.0, 1.0);
    let bottom = 8.0 + ROW * bars.len() as f64;
    let mut svg = open("bars", title, bottom + 24.0);
    let step = nice_step(most);
    for tick in (0..)
        .map(|i| f64::from(i) * step)
        .take_while(|tick| *tick <= most)
    {
        let at = x(tick);
        svg += &format!(
            "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"4\" y2=\"{bottom:.1}\"/>"
        );
        svg += &format!(
            "<text class=\"tick\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{tick}</text>",
            bottom + 16.0
        );
    }
    for (i, bar) in bars.iter().enumerate() {
        let top = 8.0 + ROW * i as f64;
        let (middle, end) = (top + ROW / 2.0 - 1.0, x(bar.value));
        let class = format!(
            "{}{}",
            if bar.is_barycentric {
                "bar barycentric"
            } else {
                "bar"
            },
            if bar.is_tie { " tie" } else { "" }
        );
        svg += &format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            LEFT - 8.0,
            middle + 4.5,
            label(&bar.label)
        );
        svg += &format!(
            "<rect class=\"{class}\" x=\"{LEFT:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
            top + 3.0,
            end - LEFT,
            ROW - 8.0
        );
        let (low, high) = (x(bar.low), x(bar.high));
        svg += &format!(
            "<path class=\"interval\" d=\"M{low:.1} {middle:.1}H{high:.1}M{low:.1} {:.1}v6M{high:.1} {:.1}v6\"/>",
            middle - 3.0,
            middle - 3.0
        );
        let value = format!("{}{:.2}", if bar.is_tie { "=" } else { "" }, bar.value);
        svg += &format!(
            "<text class=\"value\" x=\"{:.1}\" y=\"{:.1}\">{value}</text>",
            high.max(end) + 6.0,
            middle + 4.5
        );
    }
    let one = x(1.0);
    svg += &format!(
        "<line class=\"one\" x1=\"{one:.1}\" x2=\"{one:.1}\" y1=\"2\" y2=\"{bottom:.1}\"/></svg>"
    );
    svg
}

/// The label of a bar, as long as there is room for.
fn label(text: &str) -> String {
    const MOST: usize = 26;
    if text.chars().count() <= MOST {
        return escape(text);
    }
    let short: String = text.chars().take(MOST - 1).collect();
    format!("<title>{}</title>{}…", escape(text), escape(&short))
}

/// 1, 2 or 5 times a power of ten, so that `most` has about five steps of it.
pub(super) fn nice_step(most: f64) -> f64 {
    let decade = libm::pow(10.0, libm::floor(libm::log10(most / 5.0)));
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|n| n * decade)
        .find(|step| most / step <= 6.0)
        .unwrap_or(10.0 * decade)
}

/// A method: what it costs and how wrong it is.
pub(super) struct Point {
    /// What it is called.
    pub label: String,
    /// Time; over 0.
    pub time: f64,
    /// Error; 0 is drawn on the bottom line.
    pub error: f64,
    /// True if it stands for the renderer that others are measured against.
    pub is_barycentric: bool,
}

/// Errors over times on logarithmic axes. A dashed line joins the methods that no other one beats in both.
pub(super) fn scatter(title: &str, [x_name, y_name]: [&str; 2], points: &[Point]) -> String {
    const HEIGHT: f64 = 330.0;
    let plot = Plot {
        x: Axis::over(points.iter().map(|p| p.time), [64.0, WIDTH - 16.0]),
        y: Axis::over(points.iter().map(|p| p.error), [HEIGHT - 44.0, 14.0]),
    };
    let mut svg = open("scatter", title, HEIGHT);
    svg += &plot.grid();
    let [left, right] = plot.x.place;
    let [bottom, top] = plot.y.place;
    svg += &format!(
        "<text class=\"axis\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
        (left + right) / 2.0,
        HEIGHT - 8.0,
        escape(x_name)
    );
    svg += &format!(
        "<text class=\"axis\" transform=\"translate(14 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        (bottom + top) / 2.0,
        escape(y_name)
    );
    let places: Vec<[f64; 2]> = points
        .iter()
        .map(|p| [plot.x.at(p.time), plot.y.at(p.error)])
        .collect();
    let front = front(points);
    if front.len() > 1 {
        let line: Vec<String> = front
            .iter()
            .map(|&i| format!("{:.1},{:.1}", places[i][0], places[i][1]))
            .collect();
        svg += &format!("<polyline class=\"front\" points=\"{}\"/>", line.join(" "));
    }
    let mut taken: Vec<Rectangle> = places
        .iter()
        .map(|&[x, y]| Rectangle::around(x, y, 6.0))
        .collect();
    for (i, point) in points.iter().enumerate() {
        let [x, y] = places[i];
        let class = if point.is_barycentric {
            "point barycentric"
        } else {
            "point"
        };
        svg += &format!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\"/>");
        let room = Rectangle {
            left: left + 2.0,
            right: WIDTH - 2.0,
            top: 2.0,
            bottom: bottom - 2.0,
        };
        let text = if point.error > 0.0 {
            point.label.clone()
        } else {
            format!("{} (0)", point.label)
        };
        let label = placed([x, y], LETTER * text.chars().count() as f64, &room, &taken);
        // A label that found no room beside its point is tied to it.
        let [near_x, near_y] = [
            x.clamp(label.left, label.right),
            y.clamp(label.top, label.bottom),
        ];
        if (near_x - x).abs().max((near_y - y).abs()) > 10.0 {
            svg += &format!("<path class=\"lead\" d=\"M{x:.1} {y:.1}L{near_x:.1} {near_y:.1}\"/>");
        }
        svg += &format!(
            "<text class=\"name\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            (label.left + label.right) / 2.0,
            label.bottom - 3.5,
            escape(&text)
        );
        taken.push(label);
    }
    svg + "</svg>"
}

/// The points that no other one beats in both time and error, fastest first.
fn front(points: &[Point]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let by_time = points[a].time.total_cmp(&points[b].time);
        by_time.then(points[a].error.total_cmp(&points[b].error))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let is_better = points[i].error < least;
        least = least.min(points[i].error);
        is_better
    });
    order
}

pub(super) fn open(class: &str, title: &str, height: f64) -> String {
    format!(
        "<svg class=\"chart {class}\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{}\">",
        escape(title)
    )
}

struct Plot {
    x: Axis,
    y: Axis,
}

impl Plot {
    fn grid(&self) -> String {
        let ([left, right], [bottom, top]) = (self.x.place, self.y.place);
        let mut svg = String::new();
        for value in self.x.ticks() {
            let at = self.x.at(value);
            svg += &format!(
                "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{top:.1}\" y2=\"{bottom:.1}\"/>"
            );
            svg += &format!(
                "<text class=\"tick\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{value}</text>",
                bottom + 16.0
            );
        }
        for value in self.y.ticks() {
            let at = self.y.at(value);
            svg += &format!(
                "<line class=\"grid\" x1=\"{left:.1}\" x2=\"{right:.1}\" y1=\"{at:.1}\" y2=\"{at:.1}\"/>"
            );
            svg += &format!(
                "<text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                left - 6.0,
                at + 4.5,
                power(value)
            );
        }
        svg
    }
}

/// Small and large numbers as powers of ten, so that an axis has room for them.
pub(super) fn power(value: f64) -> String {
    if (0.001..1e5).contains(&value) {
        return value.to_string();
    }
    // The tiny part keeps 0.0001, whose logarithm may come out as -4.000…1, in its decade.
    let exponent = libm::floor(libm::log10(value) + 1e-9) as i32;
    let digits: String = exponent
        .unsigned_abs()
        .to_string()
        .chars()
        .map(superscript)
        .collect();
    let sign = if exponent < 0 { "⁻" } else { "" };
    match libm::round(value / libm::pow(10.0, f64::from(exponent))) {
        1.0 => format!("10{sign}{digits}"),
        multiple => format!("{multiple}·10{sign}{digits}"),
    }
}

pub(super) fn superscript(digit: char) -> char {
    ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit.to_digit(10).unwrap_or(0) as usize]
}

/// A logarithmic axis.
pub(super) struct Axis {
    /// Decimal logarithms of its ends.
    from: f64,
    to: f64,
    /// Where they stand.
    place: [f64; 2],
}

impl Axis {
    /// An axis over the values that have a logarithm, with some room at both ends.
    pub(super) fn over(values: impl Iterator<Item = f64>, place: [f64; 2]) -> Axis {
        const ROOM: f64 = 0.15;
        let logarithms = values
            .filter(|v| *v > 0.0 && v.is_finite())
            .map(libm::log10);
        let (from, to) = logarithms.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(v), b.max(v))
        });
        if from > to {
            return Axis {
                from: -1.0,
                to: 1.0,
                place,
            };
        }
        // An eighth of a decade at least, so that equal values stand in the middle and not nowhere.
        let room = ((to - from) * ROOM).max(0.125);
        Axis {
            from: from - room,
            to: to + room,
            place,
        }
    }

    /// Where `value` stands; what has no logarithm stands at the lower end.
    pub(super) fn at(&self, value: f64) -> f64 {
        let part = if value > 0.0 {
            (libm::log10(value) - self.from) / (self.to - self.from)
        } else {
            0.0
        };
        self.place[0] + (self.place[1] - self.place[0]) * part.clamp(0.0, 1.0)
    }

    /// Where lines are: powers of ten, and twice and five times them if there is room.
    pub(super) fn ticks(&self) -> Vec<f64> {
        let decades = self.to - self.from;
        let every = libm::ceil(decades / 8.0).max(1.0) as i32;
        let multiples: &[f64] = if decades < 3.0 {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0]
        };
        let range = libm::floor(self.from) as i32..=libm::ceil(self.to) as i32;
        let all = range.filter(|decade| decade.rem_euclid(every) == 0);
        // Quotients for negative exponents: 1/10 is the number nearest to a tenth, and is written as 0.1.
        let multiple = |m: f64, decade: i32| {
            let power = libm::pow(10.0, f64::from(decade.abs()));
            if decade < 0 { m / power } else { m * power }
        };
        let values = all.flat_map(|decade| multiples.iter().map(move |m| multiple(*m, decade)));
        values
            .filter(|v| (self.from..=self.to).contains(&libm::log10(*v)))
            .collect()
    }
}

#[derive(Clone, Copy, Debug)]
struct Rectangle {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Rectangle {
    fn around(x: f64, y: f64, radius: f64) -> Self {
        Rectangle {
            left: x - radius,
            right: x + radius,
            top: y - radius,
            bottom: y + radius,
        }
    }

    fn overlaps(&self, other: &Rectangle) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn contains(&self, other: &Rectangle) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }
}

/// Where a label of that width goes beside a point: the first place that is free, nearest first; if none is, the one that
/// covers the least of what is there.
fn placed([x, y]: [f64; 2], width: f64, room: &Rectangle, taken: &[Rectangle]) -> Rectangle {
    const HEIGHT: f64 = 15.0;
    let around = |x: f64, y: f64| Rectangle {
        left: x - width / 2.0,
        right: x + width / 2.0,
        top: y - HEIGHT / 2.0,
        bottom: y + HEIGHT / 2.0,
    };
    let aside = 9.0 + width / 2.0;
    let mut places = Vec::new();
    for distance in 0..6 {
        let away = f64::from(distance) * HEIGHT;
        for middle in [y - away, y + away] {
            places.extend([around(x + aside, middle), around(x - aside, middle)]);
        }
        places.extend([around(x, y - away - HEIGHT), around(x, y + away + HEIGHT)]);
    }
    let overlaps = |place: &Rectangle| taken.iter().filter(|other| other.overlaps(place)).count();
    let inside = places.iter().filter(|place| room.contains(place));
    *inside
        .min_by_key(|place| overlaps(place))
        .unwrap_or(&places[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(label: &str, time: f64, error: f64) -> Point {
        Point {
            label: label.to_string(),
            time,
            error,
            is_barycentric: false,
        }
    }

    #[test]
    fn the_front_is_what_no_other_beats() {
        let points = [
            point("slow and exact", 9.0, 0.0),
            point("beaten", 5.0, 3.0),
            point("fast and wrong", 1.0, 40.0),
            point("middle", 4.0, 2.0),
            point("as middle, slower", 4.5, 2.0),
        ];
        assert_eq!(front(&points), [2, 3, 0]);
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn axes_reach_from_end_to_end_whatever_they_show() {
        let axis = Axis::over([1.0, 100.0, 0.0, f64::NAN].into_iter(), [0.0, 130.0]);
        assert!(
            (axis.at(1.0) - 15.0).abs() < 1e-9 && (axis.at(100.0) - 115.0).abs() < 1e-9,
            "a room of 0.3 of 2.6 decades"
        );
        assert_eq!(
            (axis.at(0.0), axis.at(1e-300), axis.at(1e300)),
            (0.0, 0.0, 130.0)
        );
        let one = Axis::over([7.0].into_iter(), [0.0, 10.0]);
        assert!((one.at(7.0) - 5.0).abs() < 1e-9);
        let none = Axis::over(core::iter::empty(), [0.0, 10.0]);
        assert!(none.at(1.0) == 5.0 && !none.ticks().is_empty());
        let values: Vec<f64> = Axis::over([0.03, 4.0].into_iter(), [0.0, 1.0]).ticks();
        assert_eq!(values, [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0]);
        let many = Axis::over([1e-9, 1e9].into_iter(), [0.0, 1.0])
            .ticks()
            .len();
        assert!((4..=9).contains(&many), "{many} ticks");
    }

    #[test]
    fn labels_do_not_overlap() {
        let points: Vec<Point> = (0..6)
            .map(|i| point("slerp-phong-vector", 1.0 + 0.001 * f64::from(i), 0.5))
            .collect();
        let svg = scatter("t", ["ms", "levels"], &points);
        let number = |text: &str, key: &str| -> f64 {
            let from = text.find(key).unwrap() + key.len();
            text[from..].split('"').next().unwrap().parse().unwrap()
        };
        let labels: Vec<Rectangle> = svg
            .split("<text class=\"name\"")
            .skip(1)
            .map(|text| {
                let (x, y) = (number(text, " x=\""), number(text, " y=\""));
                Rectangle {
                    left: x - 9.0 * LETTER,
                    right: x + 9.0 * LETTER,
                    top: y - 11.0,
                    bottom: y + 3.0,
                }
            })
            .collect();
        assert_eq!(labels.len(), 6);
        for (i, a) in labels.iter().enumerate() {
            assert!(labels[..i].iter().all(|b| !a.overlaps(b)), "{labels:?}");
        }
    }

    #[test]
    fn steps_are_round() {
        assert_eq!(
            [1.0, 1.3, 4.0, 9.9, 60.0].map(nice_step),
            [0.2, 0.5, 1.0, 2.0, 10.0]
        );
    }

    #[test]
    fn small_and_large_numbers_are_powers() {
        assert_eq!(
            [0.001, 1e-4, 5e-5, 1e-12].map(power),
            ["0.001", "10⁻⁴", "5·10⁻⁵", "10⁻¹²"]
        );
        assert_eq!([5e4, 1e5, 2e6].map(power), ["50000", "10⁵", "2·10⁶"]);
    }
}
