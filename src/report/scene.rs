//! One scene on the page.

use super::charts::{Bar, Point, bars, scatter};
use super::encode::{data_uri, opaque};
use super::html::escape;
use super::section::{Figure, FigureKind, MAP_SCALE, Section, row_name};
use super::sentences::{facts, orientation};
use super::{Report, tables};
use crate::compare::comparison::table::levels;
use crate::compare::comparison::{DifferenceData, RowData};
use crate::compare::metrics::colour_bar;
use crate::shading::Entry;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// What keys and addresses call a figure that is no row.
const REFERENCE: &str = "reference";
const TRIANGLES: &str = "reference of triangles";

/// The section of a scene, whose element is called `id`.
pub(super) fn html(section: &Section, id: &str, report: &Report) -> String {
    let title = escape(&section.caption.title);
    let mut html = format!("<section class=\"scene\" id=\"{id}\" aria-labelledby=\"{id}-title\">");
    html += &format!(
        "<h2 id=\"{id}-title\">{title} <code>{}</code></h2>",
        escape(&section.data.name)
    );
    if !section.caption.description.is_empty() {
        html += &format!("<p>{}</p>", escape(&section.caption.description));
    }
    html += &format!("<p class=\"facts\">{}</p>", escape(&facts(section)));
    html += &scale();
    html += "<div class=\"pictures\">";
    for figure in &section.figures {
        html += &figure_html(figure, section);
    }
    html += "</div>";
    if let Some(sentence) = orientation(section) {
        html += &format!("<p>{}</p>", escape(&sentence));
    }
    html += &format!(
        "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"Errors and speed: {title}\">"
    );
    html += &format!("<table>{}</table></div>", tables::scene(section));
    html += &charts(section);
    if report.sections.len() > 1 {
        html += "<p class=\"up\"><a href=\"#top\">To the top</a></p>";
    }
    html + "</section>"
}

/// The rule that lays pictures, where they are stored as what differs, over the reference of their scene.
pub(super) fn style(section: &Section, id: &str) -> String {
    match section.figures.first() {
        Some(reference) => format!(
            "#{id} img.over{{background-image:url({})}}\n",
            data_uri(&reference.picture)
        ),
        None => String::new(),
    }
}

/// The one scale of all difference maps, with what its colours mean.
fn scale() -> String {
    let bar = opaque(&colour_bar(256, 1))
        .map(|png| data_uri(&png))
        .unwrap_or_default();
    format!(
        "<p class=\"scale\">Difference maps, all on one scale: <span class=\"bar\">0 <img src=\"{bar}\" width=\"256\" \
         height=\"12\" alt=\"from purple to yellow\"> {MAP_SCALE} grey levels</span> of linear light. Black: equal; \
         magenta: more than {MAP_SCALE}; white: covered in one picture only.</p>"
    )
}

fn figure_html(figure: &Figure, section: &Section) -> String {
    let (width, height) = (section.data.width, section.data.height);
    let scene = &section.caption.title;
    let name = figure_name(figure.kind, section);
    let (mut caption, picture_alt, map_alt) = texts(figure.kind, section, &name, scene);
    for &number in &figure.also {
        caption += &format!(
            "; {} is nowhere more than one grey level from it",
            section.data.rows[number].variant
        );
    }
    let class = if figure.is_overlay {
        " class=\"over\""
    } else {
        ""
    };
    let size = format!("width=\"{width}\" height=\"{height}\" decoding=\"async\"");
    let mut html = format!("<figure data-name=\"{}\">", escape(&name));
    html += &format!(
        "<span class=\"pane\"><img{class} src=\"{}\" {size} alt=\"{}\"></span>",
        data_uri(&figure.picture),
        escape(&picture_alt)
    );
    if let Some(map) = &figure.map {
        html += &format!(
            "<span class=\"pane\"><img src=\"{}\" {size} alt=\"{}\"></span>",
            data_uri(map),
            escape(&map_alt)
        );
    }
    html + &format!(
        "<figcaption><strong>{}</strong> <span>{}</span></figcaption></figure>",
        escape(&name),
        escape(&caption)
    )
}

fn figure_name(kind: FigureKind, section: &Section) -> String {
    match kind {
        FigureKind::Reference => REFERENCE.to_string(),
        FigureKind::Row(number) => section.data.rows[number].variant.clone(),
        FigureKind::Triangles => TRIANGLES.to_string(),
    }
}

/// Caption, and the texts that stand for picture and map where they cannot be seen.
fn texts(kind: FigureKind, section: &Section, name: &str, scene: &str) -> (String, String, String) {
    let map_alt = |error: &DifferenceData| match error.equal {
        true => format!("No difference of {name} from the reference."),
        false => format!(
            "Difference map of {name}: at most {} grey levels, {} RMS.",
            levels(error.difference.max),
            levels(error.difference.rms)
        ),
    };
    match kind {
        FigureKind::Reference => {
            let caption = "f64, normals interpolated and lit at every pixel (L21 4.1): what all others are measured against";
            (
                caption.to_string(),
                format!("{scene}: the Phong reference."),
                String::new(),
            )
        }
        FigureKind::Row(number) => {
            let row = &section.data.rows[number];
            (
                row_caption(row),
                format!("{scene} shaded by {name}."),
                map_alt(&row.error),
            )
        }
        FigureKind::Triangles => {
            let error = section.triangulation.map(|t| t.difference);
            let caption = format!(
                "polygons cut into triangles; {}",
                error.as_ref().map(error_caption).unwrap_or_default()
            );
            let alt = format!("{scene}: the Phong reference of its polygons cut into triangles.");
            (
                caption,
                alt,
                error.as_ref().map(map_alt).unwrap_or_default(),
            )
        }
    }
}

fn row_caption(row: &RowData) -> String {
    let title = Entry::named(&row.method).map_or("", |entry| entry.info.title);
    let speed = row
        .speed
        .as_ref()
        .map(|speed| format!("; {} ms", tables::time(speed)))
        .unwrap_or_default();
    format!("{title}; {}{speed}", error_caption(&row.error))
}

fn error_caption(error: &DifferenceData) -> String {
    if error.equal {
        return "equal to the reference".to_string();
    }
    format!(
        "off by up to {} levels, {} RMS",
        levels(error.difference.max),
        levels(error.difference.rms)
    )
}

/// The two charts of a scene; empty if no times were taken.
fn charts(section: &Section) -> String {
    let timed = || {
        section
            .all_rows()
            .filter_map(|row| Some((row, row.speed.as_ref()?)))
    };
    let ratios: Vec<Bar> = timed()
        .filter_map(|(row, speed)| {
            let ratio = speed.ratio_to_naive?;
            Some(Bar {
                label: row_name(row),
                value: ratio.ratio.median,
                low: ratio.ratio.low,
                high: ratio.ratio.high,
                // Not with itself.
                is_tie: ratio.tie && (ratio.ratio.low, ratio.ratio.high) != (1.0, 1.0),
                is_barycentric: row.is_barycentric(),
            })
        })
        .collect();
    let points: Vec<Point> = timed()
        .map(|(row, speed)| Point {
            label: row_name(row),
            time: speed.timing.median_ns / 1e6,
            error: 255.0 * row.error.difference.rms,
            is_barycentric: row.is_barycentric(),
        })
        .collect();
    if points.is_empty() {
        return String::new();
    }
    let title = &section.caption.title;
    let bars = bars(
        &format!("{title}: speed as a multiple of that of naive Phong"),
        &ratios,
    );
    let scatter = scatter(
        &format!("{title}: error over time"),
        ["time, ms", "RMS error, grey levels"],
        &points,
    );
    format!(
        "<div class=\"charts\"><figure>{bars}<figcaption>Speed as a multiple of that of naive Phong, with its 95 % interval: \
         longer is faster.</figcaption></figure><figure>{scatter}<figcaption>Error over time, both on logarithmic axes: \
         lower left is better. The dashed line joins the methods that no other one beats in both.</figcaption></figure></div>"
    )
}
