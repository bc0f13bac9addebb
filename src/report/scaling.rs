//! How the time of a frame grows with triangles and pixels, and what each of them costs.

use super::html::{escape, table};
use super::plot::plot_with_fits;
use super::sentences::{count, grouped};
use super::tables::NONE;
use crate::compare::comparison::table::{milliseconds, significant};
use crate::compare::experiments::{Axis, Costs, Curve, Point, Scaling, WHAT_A_FRAME_IS};
use crate::lectures::{Plot, Scale, Series};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// What the part is called.
pub(super) const TITLE: &str = "How cost grows";

/// What the costs are, for the captions of both tables.
const COSTS: &str =
    "Nanoseconds of one of each, and how far the worst least time is from what they add up to.";
const TIMES: &str = "How often each cost arises, and least times of whole frames in ms.";

/// The largest error of the fitted lines up to which cost grows linearly, and nearly so.
const LINEAR: f64 = 0.1;
const NEARLY: f64 = 0.35;

/// True if cost grows linearly: words by how far the worst time is from its fitted line.
pub(super) fn growth(scaling: &Scaling) -> String {
    let costs = scaling
        .curves
        .iter()
        .filter_map(|curve| Some((curve, curve.costs?)));
    let worst = costs.max_by(|a, b| a.1.worst.abs().total_cmp(&b.1.worst.abs()));
    let Some((curve, costs)) = worst else {
        return "There are too few points to tell what a triangle, a span and a pixel cost."
            .to_string();
    };
    let verdict = match costs.worst.abs() {
        worst if worst <= LINEAR => "Cost grows linearly",
        worst if worst <= NEARLY => "Cost grows nearly linearly",
        _ => "Cost does not grow linearly throughout",
    };
    let off = &scaling.points[costs.worst_point];
    format!(
        "{verdict} in vertices, triangles, spans and pixels{}: the time farthest from what fitted costs add up to is {} of it \
         ({}, {}).",
        range(scaling),
        percent(1.0 + costs.worst),
        name(curve),
        view(off)
    )
}

/// From where to where the points reach.
fn range(scaling: &Scaling) -> String {
    let ends = |axis| {
        let numbers = scaling.along(axis);
        Some([*numbers.first()?, *numbers.last()?].map(|i| &scaling.points[i]))
    };
    let Some(([few, many], [small, large])) = ends(Axis::Triangles).zip(ends(Axis::Pixels)) else {
        return String::new();
    };
    format!(
        ", from {} to {} and from {} × {} to {} × {} pixels",
        grouped(few.triangles),
        count(many.triangles, "triangle"),
        small.size[0],
        small.size[1],
        large.size[0],
        large.size[1]
    )
}

fn percent(part: f64) -> String {
    format!("{:.0} %", 100.0 * part)
}

/// A curve in words: who draws is said where it is the lecture's form, and in the table.
fn name(curve: &Curve) -> String {
    if is_lectures_own(curve) {
        format!("{}, the lecture\u{2019}s own form", curve.method)
    } else {
        curve.method.clone()
    }
}

fn is_lectures_own(curve: &Curve) -> bool {
    (&*curve.engine, &*curve.level) == ("span", "scalar")
}

/// What a point shows.
fn view(point: &Point) -> String {
    let [width, height] = point.size;
    format!(
        "{}{}, {width} × {height}",
        count(point.triangles, "triangle"),
        if point.away { " from afar" } else { "" }
    )
}

/// How it was measured, and how costs are told apart.
fn legend(scaling: &Scaling) -> [String; 2] {
    let Scaling {
        mesh,
        at: [width, height],
        of,
        ..
    } = scaling;
    let measured = format!(
        "Frames of {mesh}, N from row to row, on {width} × {height} pixels, and of about {} triangles in other sizes: \
         {WHAT_A_FRAME_IS}. Times are the least of their rounds: points cannot be timed in turns with one another, and what \
         disturbs a machine only adds.",
        grouped(*of)
    );
    let told_apart = "Spans are the runs of pixels that a triangle covers on a scanline, counted with their pixels from the \
                      coverage of each frame. A sphere has two triangles a vertex whatever its size, so that no fit of \
                      frames could tell one from the other: a vertex costs what projecting, timed by itself, takes for \
                      each, culling included. The other costs explain the rest of all frames with the least squares of \
                      relative errors and none below 0; the lighting of vertices is in that of triangles. Frames that show \
                      the sphere from four times as far tell pixels of spans from pixels of the picture, which are cleared \
                      and stored whether covered or not. A cost of 0 says that the others explain the times better without \
                      it.";
    [measured, told_apart.to_string()]
}

/// The part of the page.
pub(super) fn section(scaling: &Scaling) -> String {
    let mut html = format!(
        "<section id=\"scaling\"><h2>{TITLE}</h2><p>{}</p>",
        escape(&growth(scaling))
    );
    for paragraph in legend(scaling) {
        html += &format!("<p>{}</p>", escape(&paragraph));
    }
    html += "<div class=\"charts\">";
    for axis in [Axis::Triangles, Axis::Pixels] {
        html += &chart(scaling, axis);
    }
    html += "</div>";
    for (caption, (head, rows)) in [(COSTS, costs_grid(scaling)), (TIMES, times_grid(scaling))] {
        html += &format!(
            "<p class=\"facts\">{}</p>{}",
            escape(caption),
            table(caption, &head, &rows)
        );
    }
    html + "</section>\n"
}

/// The parts of the Markdown: sentences, then each table with what it holds.
pub(super) fn grids(scaling: &Scaling) -> ([String; 3], [(&'static str, Grid); 2]) {
    let [measured, told_apart] = legend(scaling);
    (
        [growth(scaling), measured, told_apart],
        [(COSTS, costs_grid(scaling)), (TIMES, times_grid(scaling))],
    )
}

/// The head of a table and its rows.
pub(super) type Grid = (Vec<String>, Vec<Vec<String>>);

/// Least times along an axis as marks, and what the fitted costs add up to as lines.
fn chart(scaling: &Scaling, axis: Axis) -> String {
    let numbers = scaling.along(axis);
    let place = |point: &Point| match axis {
        Axis::Triangles => point.triangles as f64,
        Axis::Pixels => point.picture_pixels(),
    };
    let measured = |curve: &Curve| {
        let time = |i: &usize| {
            Some((
                place(&scaling.points[*i]),
                curve.times.get(*i)?.as_ref()?.min_ns / 1e6,
            ))
        };
        Series::new(name(curve), numbers.iter().filter_map(time))
    };
    let fitted = |curve: &Curve| match curve.costs {
        Some(costs) => {
            let timed = numbers
                .iter()
                .filter(|i| curve.times.get(**i).is_some_and(Option::is_some));
            timed
                .map(|i| {
                    (
                        place(&scaling.points[*i]),
                        costs.explain(&scaling.points[*i]) / 1e6,
                    )
                })
                .collect()
        }
        None => Vec::new(),
    };
    let [width, height] = scaling.at;
    let (x, of) = match axis {
        Axis::Triangles => (
            "triangles of the mesh",
            format!("on {width} × {height} pixels"),
        ),
        Axis::Pixels => (
            "pixels of the picture",
            format!("of a sphere of about {} triangles", grouped(scaling.of)),
        ),
    };
    let plot = Plot {
        title: format!("Time of a frame against {x}"),
        x: (x.to_string(), Scale::Log),
        y: ("ms".to_string(), Scale::Log),
        series: scaling.curves.iter().map(measured).collect(),
        marks: Vec::new(),
        caption: format!(
            "Frames {of}: marks are least times, lines what the fitted costs add up to; both axes are logarithmic."
        ),
    };
    let fits: Vec<Vec<(f64, f64)>> = scaling.curves.iter().map(fitted).collect();
    format!(
        "<figure>{}<figcaption>{}</figcaption></figure>",
        plot_with_fits(&plot, &fits),
        escape(&plot.caption)
    )
}

/// A row a curve: what one of each costs.
fn costs_grid(scaling: &Scaling) -> Grid {
    let head = [
        "method",
        "drawn by",
        "vertex",
        "triangle",
        "span",
        "pixel of a span",
        "pixel of the picture",
        "worst error",
    ];
    let row = |curve: &Curve| {
        let mut cells = Vec::from([
            name(curve),
            format!("{} engine, {}", curve.engine, curve.level),
        ]);
        match curve.costs {
            None => cells.extend([(); 6].map(|()| NONE.to_string())),
            Some(costs) => {
                let Costs {
                    vertex_ns,
                    triangle_ns,
                    span_ns,
                    pixel_ns,
                    background_ns,
                    worst,
                    worst_point,
                } = costs;
                cells.extend(
                    [vertex_ns, triangle_ns, span_ns, pixel_ns, background_ns].map(nanoseconds),
                );
                let sign = if worst < 0.0 { "−" } else { "+" };
                cells.push(format!(
                    "{sign}{} ({})",
                    percent(worst.abs()),
                    view(&scaling.points[worst_point])
                ));
            }
        }
        cells
    };
    (
        head.map(String::from).to_vec(),
        scaling.curves.iter().map(row).collect(),
    )
}

fn nanoseconds(ns: f64) -> String {
    if ns == 0.0 {
        "0".to_string()
    } else {
        significant(ns)
    }
}

/// A row a point: its counts and times.
fn times_grid(scaling: &Scaling) -> Grid {
    let mut head: Vec<String> = [
        "triangles",
        "picture",
        "vertices",
        "drawn",
        "spans",
        "pixels of spans",
        "projection",
    ]
    .map(String::from)
    .to_vec();
    head.extend(scaling.curves.iter().map(name));
    let row = |(i, point): (usize, &Point)| {
        let [width, height] = point.size;
        let afar = if point.away { ", from afar" } else { "" };
        let mut cells = Vec::from([
            grouped(point.triangles),
            format!("{width} × {height}{afar}"),
        ]);
        cells.extend([point.vertices, point.drawn, point.spans, point.pixels].map(grouped));
        cells.push(milliseconds(point.projection.min_ns));
        cells.extend(scaling.curves.iter().map(|curve| match curve.times.get(i) {
            Some(Some(timing)) => milliseconds(timing.min_ns),
            _ => NONE.to_string(),
        }));
        cells
    };
    (head, scaling.points.iter().enumerate().map(row).collect())
}
