//! The report: every method on every scene, in pictures and numbers, as one page that needs nothing else.
//!
//! A [`Report`] is one [`Document`] and pictures. The page, Markdown, CSV and JSON are views of it: Rust writes data, the page
//! (`report/template.html`, `app.css`, `app.js`) draws it. Sentences choose their words by what was measured.
//!
//! ```
//! use fastphong::compare::comparison::{Input, Options, compare, triangulation};
//! use fastphong::compare::timing::Machine;
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::report::{Document, Report, SceneData, ScenePictures};
//! use fastphong::scene::Scene;
//! use fastphong::shading::METHODS;
//!
//! let mut scene = Scene::of_mesh(builtin("sphere?rings=8&segments=16")?);
//! (scene.width, scene.height) = (48, 36);
//! let frame = scene.frame()?;
//! let variants: Vec<_> = METHODS.iter().map(|entry| entry.variant()).collect();
//! let input = Input { name: "sphere".into(), frame: &frame };
//! let comparison = compare(&input, &variants, &Options { timing: None, ..Options::default() }, &mut |_, _| {});
//! let triangles = triangulation(&frame, &comparison.reference);
//!
//! let command_line = vec!["fastphong".into(), "report".into()];
//! let mut report = Report::new(Document::new(Machine::this(), command_line));
//! let data = SceneData::new("Sphere".into(), "Eight rings.".into(), &comparison, triangles.as_ref());
//! report.add_scene(data, ScenePictures::new(&comparison)?);
//! report.data.describe_methods();
//! assert!(report.html().starts_with("<!doctype html>"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answer;
mod date;
mod document;
mod markdown;
mod page;
mod pictures;
mod tables;
#[cfg(test)]
mod tests;

pub use date::utc_date;
pub use document::{
    Document, FigureData, MethodData, OperationsData, SceneData, TriangulationData, label,
};
pub use markdown::Markdown;
pub use pictures::{LEAST_ERROR, STEPS_AN_OCTAVE};

use crate::compare::comparison::Comparison;
use crate::lectures::{Figure, FigureBlock, FigureContent};
use crate::picture::encoding::store;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use pictures::{Pictures, halved, png};

/// Methods whose small pictures stand in Markdown: those that the lecture's Programming Project compares.
const PROJECT: [&str; 4] = ["gouraud", "naive-phong", "fast-phong", "slerp-phong"];

/// A document, and the pictures that belong to it.
#[derive(Clone, Debug)]
pub struct Report {
    /// All numbers and texts.
    pub data: Document,
    /// Documents of other machines or commits, to be laid beside it.
    pub beside: Vec<Document>,
    /// Pictures of the scenes, in the order of the document; none where it was read from a file.
    pictures: Vec<ScenePictures>,
    /// PNG files of the figures' pictures, a list a figure.
    figures: Vec<Vec<Vec<u8>>>,
}

/// The pictures of one scene.
#[derive(Clone, Debug)]
pub struct ScenePictures {
    /// The scene's name.
    name: String,
    /// The packed pictures that the page unpacks, as JSON.
    packed: String,
    /// PNG files at half the size: the reference, and those of [`PROJECT`].
    small: Vec<(String, Vec<u8>)>,
}

impl ScenePictures {
    /// Packs the pictures of a comparison, which may be dropped then.
    ///
    /// # Errors
    /// If the pictures have no pixels, or more than PNG can count.
    pub fn new(comparison: &Comparison) -> std::io::Result<ScenePictures> {
        let reference = store(&comparison.reference, comparison.encoding);
        let mut small = Vec::from([("reference".to_string(), png(&halved(&reference))?)]);
        for row in &comparison.rows {
            if PROJECT.contains(&&*row.name()) {
                small.push((row.name(), png(&halved(&row.picture))?));
            }
        }
        Ok(ScenePictures {
            name: comparison.name.clone(),
            packed: Pictures::new(comparison).json(),
            small,
        })
    }
}

impl Report {
    /// Makes a report of `data` without pictures.
    pub fn new(data: Document) -> Report {
        Report {
            data,
            beside: Vec::new(),
            pictures: Vec::new(),
            figures: Vec::new(),
        }
    }

    /// Adds a scene with its pictures.
    pub fn add_scene(&mut self, data: SceneData, pictures: ScenePictures) {
        self.pictures.push(pictures);
        self.data.comparisons.push(data);
    }

    /// Adds a figure of the lectures.
    ///
    /// # Errors
    /// If a picture has no pixels, or more than its file format can count.
    pub fn add_figure(&mut self, figure: &Figure, content: FigureContent) -> std::io::Result<()> {
        let shown = content.blocks.iter().flat_map(|block| match block {
            FigureBlock::Pictures { shown, .. } => &shown[..],
            _ => &[],
        });
        let files = shown.map(|shown| png(&shown.picture));
        self.figures.push(files.collect::<Result<_, _>>()?);
        self.data.figures.push(FigureData::new(figure, content));
        Ok(())
    }

    /// Returns the pictures of the figures as PNG files with their names, `NAME-1.png` and so on.
    pub fn figure_files(&self) -> impl Iterator<Item = (String, &[u8])> {
        let figures = self.data.figures.iter().zip(&self.figures);
        figures.flat_map(|(figure, files)| {
            let named = files.iter().enumerate();
            named.map(|(i, png)| (alloc::format!("{}-{}.png", figure.name, i + 1), &png[..]))
        })
    }

    /// Writes the page: one file that loads nothing, from the network or elsewhere.
    pub fn html(&self) -> String {
        page::page(self)
    }

    /// Writes the report in short for the front page of a repository: text, and picture files that stand in the folder
    /// `images` beside it.
    pub fn markdown(&self, images: &str) -> Markdown {
        markdown::markdown(self, images)
    }

    /// Writes every table as comma-separated values, each behind its caption.
    pub fn csv(&self) -> String {
        let tables = tables::all(&self.data);
        let all = tables.iter().map(|table| {
            let caption = table.caption.replace('"', "\"\"");
            alloc::format!("\"{caption}\"\r\n{}\r\n", table.csv())
        });
        all.collect()
    }
}
