//! The course: chapters of `docs/course`, from Markdown to parts of the page.
//!
//! A comment names the paragraph after it: `<!-- figure: NAME -->` is a still picture, and
//! `<!-- finding: NAME KEY -->` states a measured value. The page has empty places for both, which
//! `report/script/course.js` fills with what the document holds.

use super::document::{list, text};
use crate::compare::table::html_text;
use alloc::string::String;
use alloc::vec::Vec;
use alloc::{format, vec};
use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};
use serde_json::Value;

/// A chapter, on one section of the lecture.
struct Chapter {
    /// The number of the section.
    section: &'static str,
    /// The name of the file.
    file: &'static str,
    /// The text, in Markdown.
    text: &'static str,
}

/// Reads files of `docs/course`, whose names are section and topic.
macro_rules! chapters {
    ($($section:literal $topic:literal)*) => {
        &[$(Chapter {
            section: $section,
            file: concat!($section, "-", $topic, ".md"),
            text: include_str!(concat!("../../docs/course/", $section, "-", $topic, ".md")),
        }),*]
    };
}

/// All chapters, in order.
static CHAPTERS: &[Chapter] = chapters!(
    "1" "introduction"
    "2" "uniform-shading"
    "3" "gouraud-shading"
    "4.1" "naive-phong-shading"
    "4.2" "diffuse-reflection"
    "4.3" "specular-reflection"
    "4.4" "spherical-interpolation"
    "5" "summary"
);

/// Writes links to all chapters, and the chapters; nothing unless the document has all figures that
/// they name.
pub(super) fn html(data: &Value) -> String {
    let made = list(data, "/figures");
    let is_made = |name| made.iter().any(|figure| text(figure, "/name") == name);
    let comments = CHAPTERS.iter().flat_map(|chapter| chapter.text.lines());
    if !comments
        .filter_map(named)
        .all(|[figure, _]| is_made(figure))
    {
        return String::new();
    }
    let link = |chapter: &Chapter| {
        let (section, title) = (chapter.section, html_text(chapter.title()));
        format!("<a href=\"#course/{section}\"><span>{title}</span></a>")
    };
    let links: String = CHAPTERS.iter().map(link).collect();
    let articles: String = CHAPTERS.iter().map(Chapter::html).collect();
    format!("<nav class=\"list\" aria-label=\"Chapters\">{links}</nav>\n<div>\n{articles}</div>")
}

/// Returns figure and finding of a comment. Of a comment that names a figure alone the finding is
/// empty.
fn named(line: &str) -> Option<[&str; 2]> {
    let comment = line.trim_end().strip_prefix("<!-- ")?;
    let (kind, names) = comment.strip_suffix(" -->")?.split_once(": ")?;
    match kind {
        "figure" => Some([names, ""]),
        "finding" => names.split_once(' ').map(<[&str; 2]>::from),
        _ => None,
    }
}

/// Writes the place that the page fills with a figure or with a finding of it.
fn place([figure, finding]: [&str; 2]) -> String {
    match finding {
        "" => format!("<div class=\"live\" data-figure=\"{figure}\"></div>\n"),
        key => {
            format!("<div class=\"found\" data-figure=\"{figure}\" data-finding=\"{key}\"></div>\n")
        }
    }
}

impl Chapter {
    /// Returns the heading of the chapter.
    fn title(&self) -> &'static str {
        let heading = self.text.lines().next();
        heading.unwrap_or_default().trim_start_matches("# ")
    }

    /// Writes the chapter as an article.
    fn html(&self) -> String {
        let mut article = format!("<article data-part=\"{}\">\n", self.section);
        html::push_html(&mut article, self.events().into_iter());
        article + "</article>\n"
    }

    /// Parses the chapter: places stand for paragraphs that comments name, headings are a level
    /// lower, as the page has a title, and links lead to chapters of the page.
    fn events(&self) -> Vec<Event<'static>> {
        let mut events = vec![];
        // The place for the next paragraph, and whether that paragraph has begun.
        let (mut filled, mut is_inside) = (None, false);
        for event in Parser::new_ext(self.text, Options::ENABLE_SMART_PUNCTUATION) {
            match event {
                Event::Html(line) if line.starts_with("<!--") => filled = named(&line).map(place),
                Event::Start(Tag::Paragraph) if filled.is_some() => is_inside = true,
                Event::End(TagEnd::Paragraph) if is_inside => {
                    is_inside = false;
                    events.extend(filled.take().map(raw));
                }
                _ if is_inside => {}
                Event::Start(Tag::CodeBlock(_)) => events.push(raw("<pre tabindex=\"0\"><code>")),
                Event::End(TagEnd::CodeBlock) => events.push(raw("</code></pre>\n")),
                other => events.push(moved(other)),
            }
        }
        events
    }
}

/// Makes an event of HTML.
fn raw(html: impl Into<CowStr<'static>>) -> Event<'static> {
    Event::Html(html.into())
}

/// Lowers a heading by a level, and leads a link to a chapter to its place in the page.
fn moved(event: Event<'static>) -> Event<'static> {
    let lower = |level| HeadingLevel::try_from(level as usize + 1).unwrap_or(level);
    match event {
        Event::Start(Tag::Heading {
            level,
            id,
            classes,
            attrs,
        }) => Event::Start(Tag::Heading {
            level: lower(level),
            id,
            classes,
            attrs,
        }),
        Event::End(TagEnd::Heading(level)) => Event::End(TagEnd::Heading(lower(level))),
        Event::Start(Tag::Link {
            link_type,
            dest_url,
            title,
            id,
        }) => {
            let chapter = CHAPTERS.iter().find(|chapter| *chapter.file == *dest_url);
            let in_page = chapter.map(|chapter| format!("#course/{}", chapter.section).into());
            Event::Start(Tag::Link {
                link_type,
                dest_url: in_page.unwrap_or(dest_url),
                title,
                id,
            })
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lectures::FIGURES;
    use alloc::string::ToString;

    /// Returns a document with all figures but `without`.
    fn document(without: &str) -> Value {
        let names = FIGURES.iter().map(|figure| figure.name);
        let made = names.filter(|name| *name != without);
        serde_json::json!({ "figures": made.map(|name| serde_json::json!({ "name": name })).collect::<Vec<_>>() })
    }

    #[test]
    fn every_chapter_has_its_figure_and_its_findings_in_place_of_paragraphs() {
        let page = html(&document(""));
        for chapter in CHAPTERS {
            let html = chapter.html();
            assert!(page.contains(&html), "{}", chapter.file);
            let comments: Vec<_> = chapter.text.lines().filter_map(named).collect();
            let places = |kind: &str| html.matches(&format!("class=\"{kind}\"")).count();
            assert_eq!(places("live"), 1, "{}", chapter.file);
            assert_eq!(places("found"), comments.len() - 1, "{}", chapter.file);
            // Neither comments nor pictures nor paragraphs of values are left, and links stay in the page.
            for gone in [
                "<!--", "<img", "href=\"1", "href=\"2", "href=\"3", "href=\"4", "href=\"5",
            ] {
                assert!(!html.contains(gone), "{}: {gone}", chapter.file);
            }
        }
        let links = CHAPTERS
            .iter()
            .map(|c| format!("href=\"#course/{}\"", c.section));
        for link in links {
            // In the list, and in the chapter before or after.
            assert!(page.matches(&link).count() >= 2, "{link}");
        }
    }

    #[test]
    fn a_value_is_taken_from_the_document_and_not_from_the_text() {
        let chapter = Chapter {
            section: "9",
            file: "9-test.md",
            text: "# 9 Test\n\n<!-- finding: square turned -->\nIt changes by 7 levels.\n\nText stays.\n",
        };
        assert_eq!(
            chapter.html(),
            "<article data-part=\"9\">\n<h2>9 Test</h2>\n<div class=\"found\" data-figure=\"square\" \
             data-finding=\"turned\"></div>\n<p>Text stays.</p>\n</article>\n"
                .to_string()
        );
    }

    #[test]
    fn without_its_figures_there_is_no_course() {
        assert!(html(&document("slerp")).is_empty());
    }
}
