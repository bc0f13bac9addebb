//! The report: every method on every scene, in pictures and numbers, as one page that needs nothing else.
//!
//! A [`Report`] is one [`Document`], as JSON, and pictures. The page, Markdown and CSV are views of it: Rust writes data, the
//! page (`report/template.html`, `app.css`, and `script/`, a file a view) draws it. Start reading in `document.rs`, then `tables.rs`.
//!
//! ```
//! use fastphong::compare::comparison::{Input, compare};
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::raster::Renderer;
//! use fastphong::report::{Document, Report, ScenePictures};
//! use fastphong::scene::Scene;
//! use fastphong::shading::METHODS;
//!
//! let mut scene = Scene::of_mesh(builtin("sphere?rings=8&segments=16")?);
//! (scene.width, scene.height) = (48, 36);
//! let frame = scene.frame()?;
//! let variants: Vec<_> = METHODS.iter().map(|entry| entry.variant()).collect();
//! let input = Input { name: "sphere".into(), frame: &frame };
//! let comparison = compare(&input, &variants, Renderer::LECTURE, None, &mut |_, _| {});
//!
//! let pictures = vec![ScenePictures::new(&comparison)?];
//! let document = Document::new(vec!["fastphong".into(), "report".into()], vec![comparison]);
//! assert!(Report::new(&document, pictures)?.html().starts_with("<!doctype html>"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answer;
mod course;
mod date;
mod document;
mod live;
mod markdown;
mod page;
#[doc(hidden)]
pub mod pairs_page;
mod pictures;
mod shard;
mod tables;
#[cfg(test)]
mod tests;

pub use date::utc_date;
pub use document::{
    Document, DocumentError, FigureData, MethodData, OPERATIONS, Operation, RATES, Rate, SCHEMA,
    label, parse, small,
};
pub use live::{MOST_BYTES, MOST_POLYGONS, live_scene};
pub use markdown::Markdown;
pub use page::shell_word;
pub use shard::{PartOf, Shard, check_whole};

use crate::compare::comparison::Comparison;
use crate::lectures::{FigureBlock, FigureContent};
use crate::picture::encoding::store;
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use document::{NOT_COMPARABLE, OLDER};
use pictures::{Pictures, halved, png};
use serde_json::{Value, json};

/// Methods whose small pictures stand in Markdown: those that the lecture's Programming Project compares.
const PROJECT: [&str; 4] = ["gouraud", "naive-phong", "fast-phong", "slerp-phong"];

/// Packs the traces of all figures: one object in JSON, a trace by each method.
fn packed_traces(document: &Document) -> String {
    let blocks = document.figures.iter().flat_map(|f| &f.content.blocks);
    let traces = blocks.filter_map(|block| match block {
        FigureBlock::Trace { method, trace } => Some((&**method, &**trace)),
        _ => None,
    });
    let traces: BTreeMap<&str, _> = traces.collect();
    match traces.is_empty() {
        true => String::new(),
        // Not by way of a `Value`, whose floats are wider and would be written with digits that the engine's have not.
        false => live::packed(&serde_json::to_vec(&traces).expect("numbers and texts")),
    }
}

/// A document, and the pictures that belong to it.
#[derive(Clone, Debug)]
pub struct Report {
    /// The document as it was written.
    pub text: String,
    /// The document as views read it.
    data: Value,
    /// Documents of other machines or commits, to be laid beside it.
    beside: Vec<Value>,
    /// Pictures of the scenes, in the order of the document; none where it was read from a file.
    pictures: Vec<ScenePictures>,
    /// PNG files of the figures' pictures, a list per figure.
    figures: Vec<Vec<Vec<u8>>>,
    /// The traces of the figures, by their methods, as the page unpacks them; empty if there are none.
    traces: String,
}

/// The pictures of one scene.
#[derive(Clone, Debug)]
pub struct ScenePictures {
    /// The scene's name.
    name: String,
    /// The packed pictures that the page unpacks, as JSON.
    packed: String,
    /// The scene itself, if the page can draw it: [`live_scene`].
    live: Option<String>,
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
            live: None,
            small,
        })
    }

    /// Adds the scene itself, so that the page can draw it from elsewhere: what [`live_scene`] returned.
    pub fn with_live(self, live: Option<String>) -> ScenePictures {
        ScenePictures { live, ..self }
    }
}

impl Report {
    /// Makes the report of a document and the pictures of its scenes.
    ///
    /// # Errors
    /// If a picture of a figure has no pixels, or more than its file format can count.
    pub fn new(document: &Document, pictures: Vec<ScenePictures>) -> std::io::Result<Report> {
        let files = |content: &FigureContent| {
            let shown = content.blocks.iter().flat_map(|block| match block {
                FigureBlock::Pictures { shown, .. } => &shown[..],
                _ => &[],
            });
            shown.map(|shown| png(&shown.picture)).collect()
        };
        let figures = document.figures.iter().map(|f| files(&f.content));
        let text = document.to_text();
        Ok(Report {
            data: parse(&text).map_err(std::io::Error::other)?,
            text,
            beside: Vec::new(),
            pictures,
            figures: figures.collect::<Result<_, _>>()?,
            traces: packed_traces(document),
        })
    }

    /// Reads a document that was written before; its pictures, and figures, which are pictures, are not in it.
    ///
    /// # Errors
    /// As [`parse`].
    pub fn read(text: String) -> Result<Report, DocumentError> {
        let mut data = parse(&text)?;
        data["figures"] = json!([]);
        Ok(Report {
            text,
            data,
            beside: Vec::new(),
            pictures: Vec::new(),
            figures: Vec::new(),
            traces: String::new(),
        })
    }

    /// Says which numbers of a document that was [read](Self::read) cannot be compared with those of today: it is of an older schema.
    pub fn not_comparable(&self) -> Option<String> {
        let is_older = document::is_older(&self.data);
        is_older.then(|| alloc::format!("schema {OLDER}: {NOT_COMPARABLE}"))
    }

    /// Says of this document and those beside it which numbers cannot be compared, if any.
    fn limits(&self) -> String {
        let mut all = [&self.data].into_iter().chain(&self.beside);
        match all.any(document::is_older) {
            true => alloc::format!(" Of documents of schema {OLDER}: {NOT_COMPARABLE}."),
            false => String::new(),
        }
    }

    /// Returns the run that a document which was [read](Self::read) is a part of, and the part; `None` if it is whole.
    pub fn part(&self) -> Option<(&str, Shard)> {
        let shard = &self.data["shard"];
        let number = |name: &str| shard[name].as_u64()?.try_into().ok();
        let shard = Shard {
            number: number("number")?,
            of: number("of")?,
        };
        Some((document::text(&self.data, "/run"), shard))
    }

    /// Joins the documents of all parts of one run: scenes in the order of the run, all else as in the first part.
    ///
    /// # Panics
    /// If a part is missing: see [`check_whole`].
    pub fn joined(mut parts: Vec<Report>) -> Report {
        parts.sort_by_key(|part| part.part().map(|(_, shard)| shard.number));
        let scenes = parts
            .iter()
            .map(|part| document::list(&part.data, "/comparisons"));
        let scenes: Vec<_> = scenes.collect();
        let most = scenes.iter().map(|scenes| scenes.len()).max();
        // One scene of each part in turn.
        let comparisons = (0..most.unwrap_or(0))
            .flat_map(|i| scenes.iter().filter_map(move |scenes| scenes.get(i)))
            .cloned()
            .collect();
        let methods = parts
            .iter()
            .flat_map(|part| document::list(&part.data, "/methods"));
        let names = methods.map(|method| document::text(method, "/name").to_string());
        let methods = document::described(&mut names.into_iter());
        let mut data = parts.swap_remove(0).data;
        data["comparisons"] = Value::Array(comparisons);
        data["methods"] = json!(methods);
        data["shard"] = json!(Shard::WHOLE);
        Report {
            text: document::indented(&data),
            data,
            beside: Vec::new(),
            pictures: Vec::new(),
            figures: Vec::new(),
            traces: String::new(),
        }
    }

    /// Lays the numbers of another report beside these.
    pub fn lay_beside(&mut self, other: Report) {
        self.beside.push(other.data);
    }

    /// Returns the pictures of the figures as PNG files with their names, `NAME-1.png` and so on.
    pub fn figure_files(&self) -> impl Iterator<Item = (String, &[u8])> {
        let figures = document::list(&self.data, "/figures").iter();
        figures.zip(&self.figures).flat_map(|(figure, files)| {
            let name = document::text(figure, "/name");
            let named = (1..).zip(files);
            named.map(move |(i, png)| (alloc::format!("{name}-{i}.png"), &png[..]))
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
