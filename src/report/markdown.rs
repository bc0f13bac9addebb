//! The report in short, for the front page of a repository.

use super::document::{Document, SceneData};
use super::page::command;
use super::{Report, ScenePictures, answer, tables};
use crate::compare::comparison::{WHAT_IS_COMPARED, WHAT_IS_TIMED};
use crate::compare::table::markdown_text;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// A text in Markdown, and the pictures that it shows.
#[derive(Clone, Debug)]
pub struct Markdown {
    /// The text.
    pub text: String,
    /// The pictures: their names with endings, and the PNG files.
    pub images: Vec<(String, Vec<u8>)>,
}

/// Writes the answer, every table, and small pictures of each scene.
pub(super) fn markdown(report: &Report, folder: &str) -> Markdown {
    let data = &report.data;
    let mut images = Vec::new();
    let answer = answer::markdown(&answer::answer(data));
    let mut text = format!(
        "# Shading methods compared\n\n{answer}\n\n{}\n\n",
        made(data)
    );
    for table in tables::all(data) {
        let scene = data
            .comparisons
            .iter()
            .position(|s| s.title() == table.caption);
        text += &format!("## {}\n\n", markdown_text(&table.caption));
        if let Some(number) = scene {
            text += &about(&data.comparisons[number]);
            if let Some(pictures) = report.pictures.get(number) {
                text += &row_of_pictures(number, pictures, folder, &mut images);
            }
        }
        text += &format!("{}\n", table.markdown());
    }
    Markdown { text, images }
}

/// Says how and on what the report was made.
fn made(data: &Document) -> String {
    let is_unfit = |c: char| c == '`' || c.is_control();
    let command = command(&data.command_line).replace(is_unfit, "\u{FFFD}");
    let date = data
        .date
        .as_ref()
        .map_or_else(String::new, |d| format!(" on {d}"));
    let machine = markdown_text(&data.machine.line());
    format!(
        "Made by `{command}`{date}, on {machine}. A time is {WHAT_IS_TIMED}. An error is of {WHAT_IS_COMPARED}; a level \
         is 1/255. Speeds stand with their 95 % interval; = is a tie."
    )
}

fn about(scene: &SceneData) -> String {
    let c = &scene.comparison;
    let facts = format!(
        "{} × {} pixels, {} polygons, {} lights, {} pixels covered.\n\n",
        c.width, c.height, c.polygons, c.lights, c.covered_pixels
    );
    match &*scene.description {
        "" => facts,
        description => format!("{}\n\n{facts}", markdown_text(description)),
    }
}

/// Adds the small pictures of a scene to `images`; returns the table that shows them.
fn row_of_pictures(
    number: usize,
    pictures: &ScenePictures,
    folder: &str,
    images: &mut Vec<(String, Vec<u8>)>,
) -> String {
    let (mut heads, mut cells) = (Vec::new(), Vec::new());
    for (name, png) in &pictures.small {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        let file: String = format!("{} {name}", pictures.name)
            .chars()
            .map(plain)
            .collect();
        let file = format!("{:02}-{file}.png", number + 1);
        heads.push(markdown_text(name));
        cells.push(format!("![{}]({folder}/{file})", markdown_text(name)));
        images.push((file, png.clone()));
    }
    format!(
        "| {} |\n|{}\n| {} |\n\n",
        heads.join(" | "),
        ":---:|".repeat(heads.len()),
        cells.join(" | ")
    )
}
