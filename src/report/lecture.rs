//! The lecture's figures on a page: their pictures, curves, tables and findings.

use super::encode::{data_uri, opaque};
use super::html::{POLICY, STYLE, command, escape, escape_script, table};
use super::plot::plot;
use crate::lectures::{Block, Content, Figure, Finding, Shown};
use crate::picture::image_file::EncodeError;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde::Serialize;

/// The schema of the data in a page of figures.
pub const FIGURES_SCHEMA: &str = "fastphong-figures/1";

/// A figure of the lecture that was made, with its pictures as files.
#[derive(Clone, Debug)]
pub struct LectureFigure {
    /// The figure.
    pub figure: &'static Figure,
    /// What it shows and what was measured.
    pub content: Content,
    /// PNG files, in the order of the pictures.
    files: Vec<Vec<u8>>,
}

impl LectureFigure {
    /// The figure as it goes onto a page.
    ///
    /// # Errors
    /// If a picture has no pixels, or more than its file format can count.
    pub fn new(figure: &'static Figure, content: Content) -> Result<LectureFigure, EncodeError> {
        let shown = content.blocks.iter().flat_map(|block| match block {
            Block::Pictures { shown, .. } => &shown[..],
            _ => &[],
        });
        let files = shown
            .map(|shown| opaque(&shown.picture))
            .collect::<Result<_, _>>()?;
        Ok(LectureFigure {
            figure,
            content,
            files,
        })
    }

    /// Its pictures as PNG files with their names, `NAME-1.png` and so on.
    pub fn files(&self) -> impl Iterator<Item = (String, &[u8])> {
        let name = |i: usize| format!("{}-{}.png", self.figure.name, i + 1);
        self.files
            .iter()
            .enumerate()
            .map(move |(i, png)| (name(i), &png[..]))
    }

    /// What the page calls its element.
    fn id(&self) -> String {
        format!("figure-{}", self.figure.name)
    }
}

/// A page of figures alone: one file that loads nothing. `command_line` is what was typed, program first.
pub fn figures_page(figures: &[LectureFigure], command_line: &[String]) -> String {
    let mut html =
        String::from("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    html += &format!("<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n");
    html += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    let title = match figures {
        [one] => one.figure.title,
        _ => TITLE,
    };
    html += &format!(
        "<title>fastphong: {}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n",
        escape(title)
    );
    html += STYLE;
    html += &format!(
        "</style>\n</head>\n<body id=\"top\">\n<main>\n{}</main>\n",
        section(figures, "h1")
    );
    let made_by = escape(&command(command_line));
    html += &format!("<footer><p class=\"facts\">made by <code>{made_by}</code></p></footer>\n");
    let data = Document {
        schema: FIGURES_SCHEMA,
        command_line,
        figures: data(figures),
    };
    let json = serde_json::to_string(&data).expect("numbers, texts and lists of them");
    html += &format!(
        "<script type=\"application/json\" id=\"fastphong-data\">{}</script>\n",
        escape_script(&json)
    );
    html + "</body>\n</html>\n"
}

/// What the part of the lecture is called.
pub(super) const TITLE: &str = "The lectures, made anew";

const OPENING: &str = "What the lectures draw and say, drawn by the engines of this program and measured. L21 is Lecture \
                       21: Shading, L5 Lecture 5: Shading, CS171 the notes to Caltech\u{2019}s second assignment. A \
                       finding confirms the lecture, contradicts it, or adds what it does not say; the words follow \
                       the numbers.";

/// The part of the lecture: its figures, with a list of them.
pub(super) fn section(figures: &[LectureFigure], heading: &str) -> String {
    let mut html = format!(
        "<section id=\"lecture\" aria-labelledby=\"lecture-title\"><{heading} id=\"lecture-title\">"
    );
    html += &format!("{TITLE}</{heading}><p>{OPENING}</p>");
    html += "<nav aria-label=\"Figures\"><ul>";
    for figure in figures {
        let title = escape(figure.figure.title);
        html += &format!("<li><a href=\"#{}\">{title}</a></li>", figure.id());
    }
    html += "</ul></nav>";
    html.extend(figures.iter().map(article));
    html + "</section>\n"
}

fn article(made: &LectureFigure) -> String {
    let (id, figure) = (made.id(), made.figure);
    let mut html =
        format!("<article id=\"{id}\" aria-labelledby=\"{id}-title\"><h2 id=\"{id}-title\">");
    html += &format!(
        "{} <code>{}</code></h2>",
        escape(figure.title),
        escape(figure.name)
    );
    html += &format!("<p class=\"facts\">{}</p>", escape(figure.lecture));
    let mut files = made.files.iter();
    for block in &made.content.blocks {
        html += &match block {
            Block::Text(text) => format!("<p>{}</p>", escape(text)),
            Block::Pictures { columns, shown } => pictures(*columns, shown, &mut files),
            Block::Plot(curves) => format!(
                "<div class=\"charts\"><figure>{}<figcaption>{}</figcaption></figure></div>",
                plot(curves),
                escape(&curves.caption)
            ),
            Block::Table { head, rows } => table(figure.title, head, rows),
        };
    }
    html += &findings(figure.title, &made.content.findings);
    html + "</article>"
}

/// Pictures in a grid, their pixels as squares.
fn pictures<'a>(
    columns: usize,
    shown: &[Shown],
    files: &mut impl Iterator<Item = &'a Vec<u8>>,
) -> String {
    let widest = shown.iter().map(|s| s.picture.width()).max().unwrap_or(1);
    // As many page pixels a pixel as there is room for, but whole ones: squares of one size.
    let columns = columns.max(1);
    let room = (720 / columns).max(300).min(1300 / columns);
    let scale = (room / widest.max(1)).max(1);
    let mut html = format!(
        "<div class=\"shown\" style=\"--columns:{columns};--widest:{}px\">",
        widest * scale
    );
    for (shown, png) in shown.iter().zip(files) {
        let (width, height) = (shown.picture.width(), shown.picture.height());
        html += &format!(
            "<figure><img src=\"{}\" width=\"{width}\" height=\"{height}\" alt=\"{}\" decoding=\"async\">\
             <figcaption>{}</figcaption></figure>",
            data_uri(png),
            escape(&shown.alt),
            escape(&shown.caption)
        );
    }
    html + "</div>"
}

fn findings(title: &str, findings: &[Finding]) -> String {
    let mut html = format!(
        "<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"Findings: {}\"><table class=\"findings\">",
        escape(title)
    );
    html += "<thead><tr><th scope=\"col\">measured</th><th scope=\"col\">value</th><th scope=\"col\">the lecture</th>\
             <th scope=\"col\">in words</th></tr></thead><tbody>";
    for finding in findings {
        let word = finding.agreement.word();
        html += &format!(
            "<tr><th scope=\"row\">{}</th><td>{} {}</td><td class=\"{word}\">{word}</td><td>{}</td></tr>",
            escape(&finding.label),
            escape(&value(finding.value)),
            escape(finding.unit),
            escape(&finding.verdict)
        );
    }
    html + "</tbody></table></div>"
}

/// A measured value: six digits at most, so that 0.411504 stays itself.
fn value(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && size < 1e-3 {
        return crate::lectures::written(value);
    }
    let decimals = (0..6)
        .find(|&digits| size >= libm::pow(10.0, f64::from(3 - digits)))
        .unwrap_or(6);
    let text = format!("{value:.*}", decimals as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        text
    }
}

#[derive(Serialize)]
struct Document<'a> {
    schema: &'a str,
    command_line: &'a [String],
    figures: Vec<FigureData<'a>>,
}

/// A figure as data.
#[derive(Serialize)]
pub(super) struct FigureData<'a> {
    name: &'a str,
    title: &'a str,
    lecture: &'a str,
    findings: Vec<FindingData<'a>>,
}

#[derive(Serialize)]
struct FindingData<'a> {
    key: &'a str,
    label: &'a str,
    value: f64,
    unit: &'a str,
    agreement: &'a str,
    verdict: &'a str,
}

/// The findings of `figures`.
pub(super) fn data(figures: &[LectureFigure]) -> Vec<FigureData<'_>> {
    fn finding(finding: &Finding) -> FindingData<'_> {
        let Finding {
            key,
            label,
            value,
            unit,
            agreement,
            verdict,
        } = finding;
        FindingData {
            key,
            label,
            value: *value,
            unit,
            agreement: agreement.word(),
            verdict,
        }
    }
    figures
        .iter()
        .map(|made| FigureData {
            name: made.figure.name,
            title: made.figure.title,
            lecture: made.figure.lecture,
            findings: made.content.findings.iter().map(finding).collect(),
        })
        .collect()
}
