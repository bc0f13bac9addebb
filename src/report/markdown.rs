//! The report in short, for the front page of a repository.

use super::html::command;
use super::html::identifier;
use super::page::paragraphs;
use super::section::{Figure, FigureKind, Section};
use super::sentences::{facts, grouped, orientation};
use super::summary::{PROJECT, Tally};
use super::{Report, operations, scaling, speedups, tables};
use crate::compare::comparison::table::levels;
use crate::compare::comparison::{BASELINE, WHAT_IS_COMPARED, WHAT_IS_TIMED};
use crate::shading::METHODS;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// A text in Markdown, and the pictures that it shows.
#[derive(Clone, Debug)]
pub struct Markdown {
    /// The text.
    pub text: String,
    /// The pictures.
    pub images: Vec<Image>,
}

/// A picture file.
#[derive(Clone, Debug)]
pub struct Image {
    /// Its name, with the ending.
    pub name: String,
    /// The PNG file.
    pub png: Vec<u8>,
}

pub(super) fn markdown(report: &Report, folder: &str) -> Markdown {
    let mut images = Vec::new();
    let mut text = String::from("# Shading methods compared\n\n");
    for paragraph in paragraphs(report) {
        text += &format!("{}\n\n", escape(&paragraph));
    }
    let is_unfit = |c: char| c == '`' || c.is_control();
    text += &format!(
        "Made by `{}`",
        command(&report.command_line).replace(is_unfit, "\u{FFFD}")
    );
    if let Some(date) = &report.date {
        text += &format!(" on {date}");
    }
    text += &format!(
        ", on {}. Drawn by {}. A time is {WHAT_IS_TIMED}. An error is of {WHAT_IS_COMPARED}; a level is 1/255.\n\n",
        escape(&report.machine.line()),
        report
            .sections
            .first()
            .map(|section| section.data.renderer.clone())
            .unwrap_or_default()
            .line()
    );
    text += &four_corners(report);
    text += &project(&report.sections);
    text += &growth(report);
    for (number, section) in report.sections.iter().enumerate() {
        text += &scene(section, number, folder, &mut images);
    }
    text += &operation_counts();
    Markdown { text, images }
}

/// `text` as it may stand in a table of Markdown, where it means itself.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '<' => out.push_str("&lt;"),
            '&' => out.push_str("&amp;"),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' | '!' => {
                out.push('\\');
                out.push(letter);
            }
            _ if letter.is_control() => out.push(' '),
            _ => out.push(letter),
        }
    }
    out
}

fn head(text: &mut String, columns: &[&str]) {
    *text += &format!(
        "| {} |\n|---|{}\n",
        columns.join(" | "),
        "---:|".repeat(columns.len() - 1)
    );
}

/// A table, all of which is text.
fn table(columns: &[String], rows: &[Vec<String>]) -> String {
    let mut text = String::new();
    let columns: Vec<String> = columns.iter().map(|column| escape(column)).collect();
    head(
        &mut text,
        &columns.iter().map(String::as_str).collect::<Vec<_>>(),
    );
    for row in rows {
        let cells: Vec<String> = row.iter().map(|cell| escape(cell)).collect();
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text + "\n"
}

fn four_corners(report: &Report) -> String {
    let Some(speedups) = &report.studies.speedups else {
        return String::new();
    };
    let (before, columns, rows, after) = speedups::grid(speedups);
    let mut text = format!(
        "## {}\n\n{}\n\n{}",
        speedups::TITLE,
        escape(&before),
        table(&columns, &rows)
    );
    if !after.is_empty() {
        text += &format!("{}\n\n", escape(after));
    }
    text
}

fn growth(report: &Report) -> String {
    let Some(scaling) = &report.studies.scaling else {
        return String::new();
    };
    let (paragraphs, tables) = scaling::grids(scaling);
    let mut text = format!("## {}\n\n", scaling::TITLE);
    for paragraph in paragraphs {
        text += &format!("{}\n\n", escape(&paragraph));
    }
    for (caption, (columns, rows)) in tables {
        text += &format!("{}\n\n{}", escape(caption), table(&columns, &rows));
    }
    text
}

fn project(sections: &[Section]) -> String {
    let mut text = String::from(
        "## The Programming Project of the lecture\n\nTimes in ms; speeds as multiples of that of \
                                 naive Phong with their 95 % interval: over 1 is faster, = is a tie.\n\n",
    );
    let names = PROJECT.map(|(_, name)| name);
    head(
        &mut text,
        &["scene", "polygons", names[0], names[1], names[2], names[3]],
    );
    for section in sections {
        text += &format!(
            "| {} | {} |",
            escape(&section.caption.title),
            grouped(section.data.polygons)
        );
        for (method, _) in PROJECT {
            text += &match section.row(method).and_then(|row| row.speed.as_ref()) {
                None => format!(" {} |", tables::NONE),
                Some(speed) if method == BASELINE => format!(" {} |", tables::time(speed)),
                Some(speed) => format!(
                    " {}; {} |",
                    tables::time(speed),
                    tables::ratio(speed.ratio_to_naive)
                ),
            };
        }
        text.push('\n');
    }
    if sections.len() > 1 {
        text += "| geometric mean | |";
        for (method, _) in PROJECT {
            let mean = Tally::of(method, sections)
                .map_or_else(|| tables::NONE.to_string(), |t| format!("{:.2}", t.mean));
            text += &format!(" {} |", if method == BASELINE { "1" } else { &mean });
        }
        text.push('\n');
    }
    text + "\n"
}

/// The reference and the methods of the Programming Project side by side, and their errors.
fn scene(section: &Section, number: usize, folder: &str, images: &mut Vec<Image>) -> String {
    let mut text = format!("## {}\n\n", escape(&section.caption.title));
    if !section.caption.description.is_empty() {
        text += &format!("{}\n\n", escape(&section.caption.description));
    }
    text += &format!("{}\n\n", escape(&facts(section)));
    let shown: Vec<(String, &Figure)> = section
        .figures
        .iter()
        .filter_map(|f| Some((shown_name(f, section)?, f)))
        .collect();
    let mut pictures = Vec::new();
    for (name, figure) in &shown {
        let file = format!(
            "{:02}-{}-{}.png",
            number + 1,
            identifier(&section.data.name),
            identifier(name)
        );
        pictures.push(format!(
            "![{}]({folder}/{file})",
            escape(&format!("{}: {name}", section.caption.title))
        ));
        images.push(Image {
            name: file,
            png: figure.small.clone(),
        });
    }
    let names: Vec<String> = shown.iter().map(|(name, _)| escape(name)).collect();
    text += &format!(
        "| {} |\n|{}\n| {} |\n\n",
        names.join(" | "),
        ":---:|".repeat(names.len()),
        pictures.join(" | ")
    );
    head(
        &mut text,
        &[
            "method",
            "max, levels",
            "RMS, levels",
            "other polygon, pixels",
            "time, ms",
            "speed to naive Phong",
        ],
    );
    for row in section.all_rows() {
        let (time, ratio) = match &row.speed {
            Some(speed) => (tables::time(speed), tables::ratio(speed.ratio_to_naive)),
            None => (tables::NONE.to_string(), tables::NONE.to_string()),
        };
        let errors = [row.error.difference.max, row.error.difference.rms].map(levels);
        let name = escape(&super::section::row_name(row));
        text += &format!(
            "| {name} | {} | {} | {} | {time} | {ratio} |\n",
            errors[0],
            errors[1],
            grouped(row.other_polygon)
        );
    }
    text.push('\n');
    if let Some(sentence) = orientation(section) {
        text += &format!("{}\n\n", escape(&sentence));
    }
    text
}

/// What a figure is called if it is shown here: the reference, and the methods of the Programming Project.
fn shown_name(figure: &Figure, section: &Section) -> Option<String> {
    match figure.kind {
        FigureKind::Reference => Some("reference".to_string()),
        FigureKind::Row(number) => {
            let name = &section.data.rows[number].variant;
            PROJECT
                .iter()
                .any(|(method, _)| method == name)
                .then(|| name.clone())
        }
        FigureKind::Triangles => None,
    }
}

fn operation_counts() -> String {
    let mut text = format!("## Operations\n\n{}\n\n", escape(operations::LEGEND));
    let mut columns = Vec::from(["method", "lights"]);
    columns.extend(operations::RATES.map(|(rate, _)| rate));
    head(&mut text, &columns);
    for entry in METHODS {
        for lights in operations::LIGHTS {
            let counts = entry.variant().operations(lights);
            let cells = operations::RATES.map(|(_, of)| escape(&operations::cell(&of(&counts))));
            text += &format!(
                "| {} | {lights} | {} |\n",
                entry.info.name,
                cells.join(" | ")
            );
        }
    }
    text
}
