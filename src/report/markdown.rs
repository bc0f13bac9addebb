//! The report in short, for the front page of a repository.

use super::document::{list, text, title};
use super::page::{command, machine};
use super::{Report, ScenePictures, answer, tables};
use crate::compare::comparison::{WHAT_IS_COMPARED, WHAT_IS_TIMED};
use crate::compare::table::markdown_text;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use serde_json::Value;

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
    let (answer, made) = (answer::markdown(&answer::answer(data)), made(data));
    let mut text = format!("# Shading methods compared\n\n{answer}\n\n{made}\n\n");
    let scenes = list(data, "/comparisons");
    for table in tables::all(data) {
        text += &format!("## {}\n\n", markdown_text(&table.caption));
        if let Some(number) = scenes.iter().position(|s| title(s) == table.caption) {
            text += &about(&scenes[number]);
            if let Some(pictures) = report.pictures.get(number) {
                text += &row_of_pictures(number, pictures, folder, &mut images);
            }
        }
        text += &format!("{}\n", table.markdown());
    }
    Markdown { text, images }
}

/// Says how and on which machine the report was made.
fn made(data: &Value) -> String {
    let is_unfit = |c: char| c == '`' || c.is_control();
    let command = command(data).replace(is_unfit, "\u{FFFD}");
    let date = match text(data, "/date") {
        "" => String::new(),
        date => format!(" on {date}"),
    };
    let machine = markdown_text(&machine(data));
    format!(
        "Made by `{command}`{date}, on {machine}. A time is {WHAT_IS_TIMED}. An error is of {WHAT_IS_COMPARED}; a level \
         is 1/255. Speeds stand with their 95 % interval; = is a tie."
    )
}

/// Describes a scene in a few words and numbers.
fn about(scene: &Value) -> String {
    let fields = ["width", "height", "polygons", "lights", "covered_pixels"];
    let [width, height, polygons, lights, covered] = fields.map(|field| &scene[field]);
    let facts = format!(
        "{width} × {height} pixels, {polygons} polygons, {lights} lights, {covered} pixels covered.\n\n"
    );
    match text(scene, "/description") {
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
