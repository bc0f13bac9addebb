//! The short report, for the front page of a repository.

use super::document::{list, text, title};
use super::page::{command, machine};
use super::{Report, ScenePictures, answer, tables};
use crate::compare::comparison::{NOTABLE_CLAMPING, WHAT_IS_COMPARED, WHAT_IS_TIMED};
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
    /// The pictures: file names and PNG files.
    pub images: Vec<(String, Vec<u8>)>,
}

/// Writes the answer, every table, and small pictures of each scene.
pub(super) fn markdown(report: &Report, folder: &str) -> Markdown {
    let data = &report.data;
    let mut images = Vec::new();
    let mut text = format!("# Shading methods compared\n\n{}", opening(report));
    let scenes = list(data, "/comparisons");
    for tables::Trusted { table, noise } in tables::all(data) {
        text += &format!("## {}\n\n", markdown_text(&table.caption));
        if let Some(index) = scenes.iter().position(|s| title(s) == table.caption) {
            text += &about(&scenes[index]);
            if let Some(pictures) = report.pictures.get(index) {
                text += &row_of_pictures(index, pictures, folder, &mut images);
            }
        }
        text += &format!("{}\n", table.markdown());
        if !noise.is_empty() {
            text += &format!("{}\n\n", markdown_text(&noise));
        }
    }
    Markdown { text, images }
}

/// States the answer, the machine and the command in a few points, and says how to read the tables.
fn opening(report: &Report) -> String {
    let data = &report.data;
    let mut points = answer::markdown(data, &answer::quiet());
    let mut add = |head: &str, text: String| points.push((head.into(), text));
    add("Limits", markdown_text(&report.limits()));
    let is_unfit = |c: char| c == '`' || c.is_control();
    let command = command(data).replace(is_unfit, "\u{FFFD}");
    let date = match text(data, "/date") {
        "" => String::new(),
        date => format!(" on {date}"),
    };
    add("Machine", format!("{}.", markdown_text(&machine(data))));
    add("Command", format!("Made by `{command}`{date}."));
    add("Times", format!("A time is {WHAT_IS_TIMED}."));
    let errors = format!("An error is of {WHAT_IS_COMPARED}; a level is 1/255.");
    add("Errors", errors);
    let tables = "One table summarises all scenes, then each scene has its own. Costs, operations and findings follow. Speeds are \
                  multiples of naive Phong’s with their 95 % interval: more is faster, and = is a tie.";
    add("Tables", tables.into());
    let points = points.iter().filter(|(_, text)| !text.is_empty());
    let lines = points.map(|(head, text)| format!("- **{head}:** {}\n", text.trim()));
    lines.collect::<String>() + "\n"
}

/// Describes a scene: its text, its size, and its counts.
fn about(scene: &Value) -> String {
    let plural = |field: &str, one: &str| {
        let s = if scene[field] == 1 { "" } else { "s" };
        format!("{} {one}{s}", scene[field])
    };
    let clamped = match tables::clamped_share(scene) {
        share if share > NOTABLE_CLAMPING => format!(
            " In {:.0} % of them the light is over 1 and is clamped, where errors vanish.",
            100.0 * share
        ),
        _ => String::new(),
    };
    let facts = format!(
        "{} × {} pixels, {} in view, {}, {} covered.{clamped}\n\n",
        scene["width"],
        scene["height"],
        plural("polygons", "polygon"),
        plural("lights", "light"),
        plural("covered_pixels", "pixel")
    );
    let facts = facts + &others(scene);
    match text(scene, "/description") {
        "" => facts,
        description => format!("{}\n\n{facts}", markdown_text(description)),
    }
}

/// Warns of pixels that show another polygon than the reference, if a method has more than a
/// thousandth of the covered ones.
fn others(scene: &Value) -> String {
    let rows = list(scene, "/rows")
        .iter()
        .chain(list(scene, "/barycentric"));
    let most = rows
        .filter_map(|row| row["other_polygon"].as_f64())
        .fold(0.0, f64::max);
    let share = 100.0 * most / scene["covered_pixels"].as_f64().unwrap_or(0.0).max(1.0);
    if share > 0.1 {
        format!(
            "At up to {share:.2} % of the covered pixels a method shows another polygon than the reference, because both have the \
             same depth up to rounding. The errors leave out these pixels.\n\n"
        )
    } else {
        String::new()
    }
}

/// Adds the small pictures of the scene at `index` to `images`. Returns the table that shows them.
fn row_of_pictures(
    index: usize,
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
        let file = format!("{:02}-{file}.png", index + 1);
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
