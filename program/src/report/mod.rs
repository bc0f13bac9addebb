//! The report: every method on every scene, in pictures and figures, as one page that needs nothing
//! else.
//!
//! A [`Report`] holds one `Document` as JSON, and pictures. The page, Markdown and CSV are views of
//! it. Rust writes the data, and the page draws it (`report/template.html`, `app.css`, and
//! `script/` with a file for each view). Start reading in `document.rs`, then `tables.rs`.
//!
//! Only [`Report`] is public, for the fuzzer, and the [`Summary`] of a document with its answer,
//! for the documents that state it. Everything else serves the program.

mod answer;
mod course;
mod date;
mod document;
mod live;
mod markdown;
mod modules;
mod page;
pub(crate) mod pairs_page;
mod pictures;
mod shard;
mod summary;
mod tables;
#[cfg(test)]
mod tests;

pub use answer::sentences;
pub use document::parse;
pub use summary::{MethodError, Summary};

pub(crate) use answer::text_of;
pub(crate) use date::utc_date;
pub(crate) use document::{Document, FigureData, OPERATIONS, RATES, small};
pub(crate) use live::{MOST_BYTES, MOST_POLYGONS, live_scene};
pub(crate) use page::shell_word;
pub(crate) use shard::{PartOf, Shard, check_whole};

use crate::compare::comparison::Comparison;
use crate::lectures::{FigureBlock, FigureContent};
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use document::{DocumentError, OLDER, older};
use fastphong::picture::encoding::store;
use markdown::Markdown;
use pictures::{Pictures, halved, png};
use serde_json::{Value, json};

/// The methods whose small pictures stand in Markdown, which are the ones in the lecture's
/// Programming Project.
const PROJECT: [&str; 4] = ["gouraud", "naive-phong", "fast-phong", "slerp-phong"];

/// Packs the traces of all figures into one JSON object with a trace for each method.
fn packed_traces(document: &Document) -> String {
    let blocks = document.figures.iter().flat_map(|f| &f.content.blocks);
    let traces: BTreeMap<&str, _> = blocks
        .filter_map(|block| match block {
            FigureBlock::Trace { method, trace } => Some((&**method, &**trace)),
            _ => None,
        })
        .collect();
    if traces.is_empty() {
        String::new()
    } else {
        // Not through a `Value`: its floats have 64 bits and would be written with digits that the
        // engine's 32 do not have.
        live::packed(&serde_json::to_vec(&traces).expect("numbers and texts"))
    }
}

/// A document, and its pictures.
#[derive(Clone, Debug)]
pub struct Report {
    /// The document's text, unchanged.
    pub(crate) text: String,
    /// The document's data, which views read.
    data: Value,
    /// Documents of other machines or commits, to compare with.
    beside: Vec<Value>,
    /// The pictures of the scenes, in the order of the document. Empty if the document was read
    /// from a file.
    pictures: Vec<ScenePictures>,
    /// The figures' pictures as PNG files, a list for each figure.
    figures: Vec<Vec<Vec<u8>>>,
    /// The packed traces of the figures, which the page unpacks. Empty if there are none.
    traces: String,
}

/// The pictures of one scene.
#[derive(Clone, Debug)]
pub(crate) struct ScenePictures {
    /// The scene's name.
    name: String,
    /// The packed pictures, which the page unpacks, as JSON.
    packed: String,
    /// The scene itself from [`live_scene`], if the page can draw it.
    live: Option<String>,
    /// PNG files of half the size: the reference, and the methods of [`PROJECT`].
    small: Vec<(String, Vec<u8>)>,
}

impl ScenePictures {
    /// Packs the pictures of a comparison. The comparison's own pictures are not needed after that.
    ///
    /// # Errors
    /// If the pictures have no pixels, or more than PNG can count.
    pub(crate) fn new(comparison: &Comparison) -> std::io::Result<ScenePictures> {
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

    /// Adds the scene itself, as [`live_scene`] returned it, so that readers can turn it on the
    /// page.
    pub(crate) fn with_live(self, live: Option<String>) -> ScenePictures {
        ScenePictures { live, ..self }
    }
}

impl Report {
    /// Makes the report of a document and the pictures of its scenes.
    ///
    /// # Errors
    /// If a picture of a figure has no pixels, or more than PNG can count.
    pub(crate) fn new(
        document: &Document,
        pictures: Vec<ScenePictures>,
    ) -> std::io::Result<Report> {
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

    /// Reads a document from a file. The report then has no pictures, and no figures, which consist
    /// of pictures.
    ///
    /// # Errors
    /// An error if the text is not JSON, has another schema, or lacks a field.
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

    /// Says which values of a document that was [read](Self::read) cannot be compared with today's.
    /// Returns `None` if its schema is today's.
    pub(crate) fn not_comparable(&self) -> Option<String> {
        let (schema, differs) = older(&self.data)?;
        Some(alloc::format!("schema {schema}: {differs}"))
    }

    /// Says which values of this document and of the documents beside it cannot be compared. Empty
    /// if all can.
    fn limits(&self) -> String {
        let all = || [&self.data].into_iter().chain(&self.beside);
        let there = OLDER
            .iter()
            .filter(|(schema, _)| all().any(|of| of["schema"] == *schema));
        let sentences: Vec<String> = there
            .map(|(schema, differs)| alloc::format!("Of documents of schema {schema}: {differs}."))
            .collect();
        sentences.join(" ")
    }

    /// Returns the run and the part of it that a document holds which was [read](Self::read).
    /// Returns `None` if it holds a whole run.
    pub(crate) fn part(&self) -> Option<(&str, Shard)> {
        let shard = &self.data["shard"];
        let number = |name: &str| shard[name].as_u64()?.try_into().ok();
        let shard = Shard {
            number: number("number")?,
            of: number("of")?,
        };
        Some((document::text(&self.data, "/run"), shard))
    }

    /// Joins the documents of all parts of one run. Scenes are in the order of the run, and
    /// everything else comes from the first part.
    ///
    /// # Panics
    /// If a part is missing. Call [`check_whole`] first.
    pub(crate) fn joined(mut parts: Vec<Report>) -> Report {
        parts.sort_by_key(|part| part.part().map(|(_, shard)| shard.number));
        let scenes: Vec<_> = parts
            .iter()
            .map(|part| document::list(&part.data, "/comparisons"))
            .collect();
        let most = scenes.iter().map(|scenes| scenes.len()).max();
        // Parts take scenes in turn: part 1 has the first, part 2 the second, and so on.
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

    /// Shows the values of another report beside this one's.
    pub fn lay_beside(&mut self, other: Report) {
        self.beside.push(other.data);
    }

    /// Returns the pictures of the figures as PNG files with their names, `NAME-1.png` and so on.
    pub(crate) fn figure_files(&self) -> impl Iterator<Item = (String, &[u8])> {
        let figures = document::list(&self.data, "/figures").iter();
        figures.zip(&self.figures).flat_map(|(figure, files)| {
            let name = document::text(figure, "/name");
            let named = (1..).zip(files);
            named.map(move |(i, png)| (alloc::format!("{name}-{i}.png"), &png[..]))
        })
    }

    /// Writes the page: one file that loads nothing, neither from the network nor from other files.
    pub fn html(&self) -> String {
        page::page(self)
    }

    /// Writes a short report for the front page of a repository: a text, and picture files for the
    /// folder `images` beside it.
    pub fn markdown(&self, images: &str) -> Markdown {
        markdown::markdown(self, images)
    }

    /// Writes every table as comma-separated values, after a line with its caption.
    pub fn csv(&self) -> String {
        let tables = tables::all(&self.data);
        let all = tables.iter().map(|tables::Trusted { table, .. }| {
            let caption = table.caption.replace('"', "\"\"");
            alloc::format!("\"{caption}\"\r\n{}\r\n", table.csv())
        });
        all.collect()
    }
}
