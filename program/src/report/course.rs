//! The course: turns the chapters of `report/course` from Markdown into parts of the page.
//!
//! A comment in the Markdown says what the page does with the paragraph after it:
//!
//! | comment | in the page |
//! |---|---|
//! | `figure: NAME` | a figure, with its handles if it has any |
//! | `finding: FIGURE KEY` | a measured value |
//! | `question: FIGURE slider KEY LOW HIGH STEP UNIT` | a question, answered with a slider |
//! | `question: FIGURE largest KEY KEY..` | a question, answered by a choice from the list after it |
//! | `toy: FIGURE RULE KEY [HANDLE] [times N UNIT]` | a goal for the handles of a figure |
//! | `learnt` | shown once the goal is reached |
//! | `stop: QUERY` | a link to a state of the figure `stop` |
//! | `hands: NAME` | an exercise to program |
//! | `cost: METHOD` | the operations that a picture takes |
//!
//! The page gets places, which contain the paragraphs of the text or values of the document. A
//! reader without scripts sees these. `report/script/course.js` replaces them.

use super::document::{list, number, text};
use crate::compare::comparison::table::significant;
use crate::compare::table::html_text;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;
use alloc::{format, vec};
use pulldown_cmark::{CowStr, Event, HeadingLevel, Options, Parser, Tag, TagEnd, html};
use serde_json::Value;

/// A chapter of the course.
struct Chapter {
    /// The section of the lecture, or a name. It is a part of the chapter's address.
    part: &'static str,
    /// The name of the file.
    file: &'static str,
    /// The text, in Markdown.
    text: &'static str,
}

/// Returns all chapters, in order.
fn chapters() -> impl Iterator<Item = Chapter> {
    let chapters = fastphong_report::CHAPTERS.iter();
    chapters.map(|&(part, file, text)| Chapter { part, file, text })
}

/// The heading of findings, which the page folds until the reader has answered the question before
/// them.
const MEASURED: &str = "\n## Measured\n";

/// The element around a table, which may be wider than the page.
const SCROLLING: &str =
    "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Table\">\n";

/// Writes links to all chapters, then the chapters. Returns an empty text unless the document has
/// all figures that they name.
pub(super) fn html(data: &Value) -> String {
    let made = list(data, "/figures");
    let is_made = |name| made.iter().any(|figure| text(figure, "/name") == name);
    let mut lines = chapters().flat_map(|chapter| chapter.text.lines());
    if !lines.all(|line| figure_of(line).is_none_or(is_made)) {
        return String::new();
    }
    let link = |chapter: Chapter| {
        let (part, title) = (chapter.part, html_text(chapter.title()));
        format!("<a href=\"#course/{part}\"><span>{title}</span></a>")
    };
    let links: String = chapters().map(link).collect();
    let articles: String = chapters().map(|chapter| chapter.html(data)).collect();
    format!("<nav class=\"list\" aria-label=\"Chapters\">{links}</nav>\n<div>\n{articles}</div>")
}

/// Returns the kind and the words of a comment, or `None` if the line is not a comment.
fn comment(line: &str) -> Option<(&str, &str)> {
    let inside = line
        .trim_end()
        .strip_prefix("<!-- ")?
        .strip_suffix(" -->")?;
    Some(inside.split_once(": ").unwrap_or((inside, "")))
}

/// Returns the figure that a comment names.
fn figure_of(line: &str) -> Option<&str> {
    match comment(line)? {
        ("figure" | "finding" | "question" | "toy", words) => words.split(' ').next(),
        _ => None,
    }
}

/// An element of the page around the paragraph after a comment.
struct Place {
    /// The HTML before the paragraph.
    open: String,
    /// The HTML after it.
    close: &'static str,
    /// True if the place contains the paragraph, false if it replaces it.
    keeps: bool,
    /// True if the list after the paragraph belongs to the place.
    has_list: bool,
}

impl Place {
    /// Makes the place that a comment asks for, if it asks for one.
    fn of(line: &str, data: &Value) -> Option<Place> {
        let (kind, words) = comment(line)?;
        let block = |class: &str, attributes: String| Place {
            open: format!("<div class=\"{class}\"{attributes}>\n"),
            close: "</div>\n",
            keeps: true,
            has_list: false,
        };
        let named = |attribute: &str| format!(" data-{attribute}=\"{}\"", html_text(words));
        let place = match kind {
            "figure" => block("live", named("figure")),
            "finding" => {
                let (figure, key) = words.split_once(' ')?;
                let mut place = block(
                    "found",
                    format!(" data-figure=\"{figure}\" data-finding=\"{key}\""),
                );
                place.open += &finding(data, figure, key);
                place.keeps = false;
                place
            }
            "question" => Place {
                has_list: words.contains(" largest "),
                ..block("ask", named("question"))
            },
            "toy" => block("toy", named("toy")),
            "learnt" => block("learnt", String::new()),
            "hands" => block("hands", named("hands")),
            "cost" => block("cost", named("cost")),
            "stop" => Place {
                open: format!(
                    "<a class=\"go-stop\" href=\"#course/stop?{}\">\n",
                    html_text(words)
                ),
                close: "</a>\n",
                keeps: true,
                has_list: false,
            },
            _ => return None,
        };
        Some(place)
    }
}

/// Writes a finding of the document, or nothing if the document does not have it.
fn finding(data: &Value, figure: &str, key: &str) -> String {
    let mut figures = list(data, "/figures").iter();
    let figure = figures.find(|made| text(made, "/name") == figure);
    let findings = figure.map_or(&[][..], |figure| list(figure, "/findings"));
    let Some(found) = findings.iter().find(|found| text(found, "/key") == key) else {
        return String::new();
    };
    let value = number(found, "/value").map_or_else(String::new, significant);
    let measured = [&*value, text(found, "/unit")].join(" ");
    let words = ["/label", "/verdict"].map(|at| html_text(text(found, at)));
    let [label, verdict] = words;
    format!("<p>{label}: <b>{}</b>. {verdict}</p>\n", measured.trim())
}

impl Chapter {
    /// Returns the heading of the chapter.
    fn title(&self) -> &'static str {
        let heading = self.text.lines().next();
        heading.unwrap_or_default().trim_start_matches("# ")
    }

    /// Writes the chapter as an article. Everything after the heading of findings becomes a
    /// section, except the last paragraph, which links to other chapters.
    fn html(&self, data: &Value) -> String {
        let part = self.part;
        let mut article = format!("<article id=\"course/{part}\" data-part=\"{part}\">\n");
        let write = |text: &'static str, article: &mut String| {
            html::push_html(article, events(text, data).into_iter());
        };
        match self.text.split_once(MEASURED) {
            None => write(self.text, &mut article),
            Some((before, after)) => {
                let end = after.trim_end().rfind("\n\n").unwrap_or(after.len());
                let (measured, links) = after.split_at(end);
                write(before, &mut article);
                article += "<section class=\"measured\">\n<h3>Measured</h3>\n";
                write(measured, &mut article);
                article += "</section>\n";
                write(links, &mut article);
            }
        }
        article + "</article>\n"
    }
}

/// Parses a text for the page. Paragraphs after comments become places. Pictures become their
/// alternative texts. Headings move down a level, because the page has its own title. Links lead to
/// chapters of the page.
fn events(text: &'static str, data: &Value) -> Vec<Event<'static>> {
    let mut events = vec![];
    // The place for the next paragraph; then a flag if the paragraph is left out, and the place's
    // end.
    let mut place: Option<Place> = None;
    let (mut is_dropped, mut close) = (false, None);
    let mut is_link = false;
    let options = Options::ENABLE_SMART_PUNCTUATION | Options::ENABLE_TABLES;
    for event in Parser::new_ext(text, options) {
        match event {
            Event::Html(line) if line.starts_with("<!--") => place = Place::of(&line, data),
            Event::Start(Tag::Paragraph) if place.is_some() => {
                let made = place.take();
                is_dropped = made.as_ref().is_some_and(|place| !place.keeps);
                close = made.as_ref().map(|place| (place.close, place.has_list));
                events.extend(made.map(|place| raw(place.open)));
                events.extend((!is_dropped).then_some(Event::Start(Tag::Paragraph)));
            }
            Event::End(TagEnd::Paragraph) if is_dropped => {
                is_dropped = false;
                events.extend(close.take().map(|(text, _)| raw(text)));
            }
            _ if is_dropped => {}
            Event::End(end @ (TagEnd::Paragraph | TagEnd::List(_))) => {
                events.push(Event::End(end));
                let waits = end == TagEnd::Paragraph && close.is_some_and(|(_, has_list)| has_list);
                events.extend(close.take_if(|_| !waits).map(|(text, _)| raw(text)));
            }
            Event::Start(Tag::Image { .. }) | Event::End(TagEnd::Image) => {}
            Event::Start(Tag::Table(_)) => events.extend([raw(SCROLLING), event]),
            Event::End(TagEnd::Table) => events.extend([event, raw("</div>\n")]),
            Event::Start(Tag::CodeBlock(_)) => events.push(raw("<pre tabindex=\"0\"><code>")),
            Event::End(TagEnd::CodeBlock) => events.push(raw("</code></pre>\n")),
            Event::Code(code) if code.starts_with('#') => events.push(address(&code)),
            Event::Start(Tag::Link { dest_url, .. }) => {
                let link =
                    in_page(&dest_url).map(|to| raw(format!("<a href=\"{}\">", html_text(&to))));
                is_link = link.is_some();
                events.extend(link);
            }
            Event::End(TagEnd::Link) => events.extend(is_link.then(|| raw("</a>"))),
            other => events.push(lowered(other)),
        }
    }
    events
}

/// Makes an event that writes this HTML.
fn raw(html: impl Into<CowStr<'static>>) -> Event<'static> {
    Event::InlineHtml(html.into())
}

/// Writes an address of the page as a link.
fn address(code: &str) -> Event<'static> {
    let to = html_text(code);
    raw(format!("<a href=\"{to}\"><code>{to}</code></a>"))
}

/// Returns the address in the page for a link of a chapter, if it leads to another chapter or to a
/// website. Other files of the repository are not in the page.
fn in_page(to: &str) -> Option<String> {
    let chapter = chapters()
        .find(|chapter| chapter.file == to)
        .map(|chapter| format!("#course/{}", chapter.part));
    chapter.or_else(|| to.starts_with("https://").then(|| to.to_owned()))
}

/// Lowers a heading by one level.
fn lowered(event: Event<'static>) -> Event<'static> {
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
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lectures::FIGURES;

    /// Returns a document with all figures except `without`.
    fn document(without: &str) -> Value {
        let names = FIGURES.iter().map(|figure| figure.name);
        let made = names.filter(|name| *name != without);
        serde_json::json!({ "figures": made.map(|name| serde_json::json!({ "name": name })).collect::<Vec<_>>() })
    }

    /// Counts the comments of a kind in a text.
    fn count(text: &str, kind: &str) -> usize {
        let comments = text.lines().filter_map(comment);
        comments.filter(|(found, _)| *found == kind).count()
    }

    #[test]
    fn comments_become_places_and_links_stay_in_the_page() {
        let page = html(&document(""));
        for chapter in chapters() {
            let html = chapter.html(&document(""));
            assert!(page.contains(&html), "{}", chapter.file);
            let classes = [
                ("figure", "live"),
                ("finding", "found"),
                ("question", "ask"),
                ("toy", "toy"),
                ("learnt", "learnt"),
                ("hands", "hands"),
                ("cost", "cost"),
                ("stop", "go-stop"),
            ];
            for (kind, class) in classes {
                let places = html.matches(&format!("class=\"{class}\"")).count();
                assert_eq!(
                    places,
                    count(chapter.text, kind),
                    "{}: {kind}",
                    chapter.file
                );
            }
            let folded = html.matches("<section class=\"measured\">").count();
            assert_eq!(folded, count(chapter.text, "question"), "{}", chapter.file);
            // No comments, pictures or links to files are left.
            for gone in ["<!--", "<img", ".md\""] {
                assert!(!html.contains(gone), "{}: {gone}", chapter.file);
            }
            let opened = html.matches("<div").count();
            assert_eq!(opened, html.matches("</div>").count(), "{}", chapter.file);
        }
        for chapter in chapters() {
            // A link stands in the list, and in the previous or the next chapter.
            let link = format!("href=\"#course/{}\"", chapter.part);
            assert!(page.matches(&link).count() >= 2, "{link}");
        }
    }

    /// Writes a chapter of this text, with a document that has one finding.
    fn written(text: &'static str) -> String {
        let chapter = Chapter {
            part: "9",
            file: "9-test.md",
            text,
        };
        let found = serde_json::json!({
            "key": "turned", "label": "turned", "value": 12.25, "unit": "levels", "verdict": "So it is.",
        });
        let figure = serde_json::json!({ "name": "square", "findings": [found] });
        chapter.html(&serde_json::json!({ "figures": [figure] }))
    }

    #[test]
    fn a_value_is_taken_from_the_document_and_not_from_the_text() {
        assert_eq!(
            written(
                "# 9 Test\n\n<!-- finding: square turned -->\nIt changes by 7 levels.\n\nText stays.\n"
            ),
            "<article id=\"course/9\" data-part=\"9\">\n<h2>9 Test</h2>\n<div class=\"found\" \
             data-figure=\"square\" data-finding=\"turned\">\n<p>turned: <b>12.2 levels</b>. \
             So it is.</p>\n</div>\n<p>Text stays.</p>\n</article>\n"
        );
    }

    #[test]
    fn a_question_has_its_list_and_what_was_measured_is_a_section() {
        let html = written(
            "# 9 Test\n\n<!-- question: square largest a b -->\nWhich?\n\n- one\n- two\n\n\
             After.\n\n## Measured\n\nThis.\n\n[← 5](5-summary.md)\n",
        );
        let question = "<div class=\"ask\" data-question=\"square largest a b\">\n<p>Which?</p>\n\
                        <ul>\n<li>one</li>\n<li>two</li>\n</ul>\n</div>\n<p>After.</p>";
        assert!(html.contains(question), "{html}");
        let measured = "<section class=\"measured\">\n<h3>Measured</h3>\n<p>This.</p>\n</section>\n\
                        <p><a href=\"#course/5\">← 5</a></p>";
        assert!(html.contains(measured), "{html}");
    }

    #[test]
    fn links_lead_into_the_figure_and_addresses_are_links() {
        let html = written(
            "# 9 Test\n\n<!-- stop: method=gouraud&line=6 -->\n**Stop** there.\n\nOpen `#course/3`, \
             not [a file](../meshes.md).\n",
        );
        let link = "<a class=\"go-stop\" href=\"#course/stop?method=gouraud&amp;line=6\">\n<p>\
                    <strong>Stop</strong> there.</p>\n</a>";
        assert!(html.contains(link), "{html}");
        let open = "<p>Open <a href=\"#course/3\"><code>#course/3</code></a>, not a file.</p>";
        assert!(html.contains(open), "{html}");
    }

    #[test]
    fn without_its_figures_there_is_no_course() {
        assert!(html(&document("slerp")).is_empty());
    }
}
