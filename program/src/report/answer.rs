//! The answer: which methods draw naive Phong's picture, and which of them in the least time, in
//! scalar code and with SIMD.
//!
//! It names a method only where intervals separate it from the others.

use super::document::{Document, label, list, parse};
use super::summary::{MethodError, MethodSpeed, SCALAR, Speeds, Summary};
use crate::compare::comparison::BASELINE;
use crate::compare::comparison::table::significant;
use crate::compare::table::{html_text, markdown_text};
use crate::compare::timing::Ratio;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::cmp::Ordering;
use serde_json::Value;

/// The lecture's own fast method, which every answer mentions.
const FAST: &str = "fast-phong";

/// The largest error in grey levels with which a picture passes for the reference.
const SAME: f64 = 1.0;

/// How many methods a sentence on pictures names.
const NAMED: usize = 3;

/// A part of a sentence.
#[derive(Clone, Debug, PartialEq)]
enum Part {
    /// Plain words.
    Text(String),
    /// A number that matters, in bold.
    Strong(String),
    /// A method, by its variant's name.
    Method(String),
    /// A link to a scene: its index, its title, and the method whose picture it shows.
    Scene(usize, String, String),
}

/// A part of the answer: what this run says, and what the run on a quiet machine says.
#[derive(Clone, Debug, PartialEq)]
struct Card {
    head: &'static str,
    own: Option<Said>,
    quiet: Option<Said>,
}

/// What one run says.
#[derive(Clone, Debug, Default, PartialEq)]
struct Said {
    /// The name of the instruction set, empty for scalar code and for pictures.
    level: String,
    /// The frames that were timed: see [`Speeds::frames`].
    frames: String,
    sentences: Vec<Part>,
    /// The speeds in words, for places without bars.
    speeds: Vec<Part>,
    /// Methods with their speeds, for lines with bars.
    bars: Vec<(Vec<Part>, Ratio)>,
}

/// The heading of the card of pictures.
const PICTURE: &str = "The picture";

/// Returns the summary of the run on a quiet machine.
pub(super) fn quiet() -> Summary {
    serde_json::from_str(fastphong_report::QUIET).expect("a test reads it")
}

/// Answers for pictures, scalar code and SIMD. Speeds of a quiet run stand beside the run's own.
fn cards(own: &Summary, quiet: Option<&Summary>) -> Vec<Card> {
    let card = |head, speeds: fn(&Summary) -> Option<&Speeds>| {
        let said = |of: &Summary| Some(of_speeds(speeds(of)?, of.is_optimised()));
        Card {
            head,
            own: said(own),
            quiet: quiet.and_then(said),
        }
    };
    let pictures = Said {
        sentences: of_pictures(own),
        ..Said::default()
    };
    let cards = [
        Card {
            head: PICTURE,
            own: Some(pictures),
            quiet: None,
        },
        card("Scalar code", |of| of.scalar.as_ref()),
        card("SIMD", |of| of.simd.as_ref()),
    ];
    let is_said = |card: &Card| card.own.is_some() || card.quiet.is_some();
    cards.into_iter().filter(is_said).collect()
}

fn plain(text: &str) -> Part {
    Part::Text(text.to_string())
}

/// Says which methods draw naive Phong's picture, and how far off others are.
fn of_pictures(summary: &Summary) -> Vec<Part> {
    let frames = match summary.scenes {
        1 => "in this scene".to_string(),
        scenes => format!("in all {scenes} scenes"),
    };
    let others = || summary.methods.iter().filter(|m| m.variant != BASELINE);
    if others().next().is_none() {
        return Vec::from([plain("No other method than naive Phong was drawn.")]);
    }
    let same: Vec<&MethodError> = others().filter(|m| m.levels <= SAME).collect();
    let mut parts = named(same.iter().map(|m| &*m.variant), NAMED, "and");
    parts.push(Part::Text(match same.len() {
        0 => format!("No other method draws naive Phong’s picture within 1 grey level {frames}."),
        1 => format!(" draws naive Phong’s picture within 1 grey level {frames}."),
        _ => format!(" draw naive Phong’s picture within 1 grey level {frames}."),
    }));
    let place = |m: &MethodError| match summary.scenes {
        1 => Vec::new(),
        _ => {
            let scene = Part::Scene(m.place, m.scene.clone(), m.variant.clone());
            Vec::from([plain(" in "), scene])
        }
    };
    let method = |m: &MethodError| Part::Method(m.variant.clone());
    let levels = |m: &MethodError| Part::Strong(significant(m.levels));
    let one = |of: &str, m: &MethodError| {
        let mut parts = Vec::from([plain(of), method(m), plain(" is off by up to ")]);
        parts.extend([levels(m), plain(" levels")]);
        parts.extend(place(m));
        parts.push(plain("."));
        parts
    };
    let (fast, mut off): (Vec<&MethodError>, Vec<&MethodError>) = others()
        .filter(|m| m.levels > SAME)
        .partition(|m| m.variant == FAST);
    parts.extend(fast.iter().flat_map(|fast| one(" The lecture’s ", fast)));
    off.sort_by(|a, b| a.levels.total_cmp(&b.levels));
    match off[..] {
        [] => {}
        [other] => parts.extend(one(" ", other)),
        [nearest, .., farthest] => {
            parts.extend([plain(" Others are off by "), levels(nearest)]);
            parts.extend([plain(" ("), method(nearest)]);
            parts.extend(place(nearest));
            parts.extend([plain(") to "), levels(farthest), plain(" levels (")]);
            parts.push(method(farthest));
            parts.extend(place(farthest));
            parts.push(plain(")."));
        }
    }
    parts
}

/// Lists methods with `last` before the last one: at most `most`, then how many more there are.
fn named<'a>(names: impl Iterator<Item = &'a str>, most: usize, last: &str) -> Vec<Part> {
    let names: Vec<&str> = names.collect();
    let (shown, rest) = names.split_at(names.len().min(most));
    let mut parts: Vec<Part> = Vec::new();
    for (i, name) in shown.iter().enumerate() {
        if i > 0 {
            let is_last = i + 1 == names.len();
            let between = if is_last {
                format!(" {last} ")
            } else {
                ", ".into()
            };
            parts.push(Part::Text(between));
        }
        parts.push(Part::Method((*name).to_string()));
    }
    if !rest.is_empty() {
        parts.push(Part::Text(format!(" {last} {} more", rest.len())));
    }
    parts
}

/// Returns the methods that draw naive Phong's picture in the least time: the fastest of those that
/// are faster than naive Phong beyond doubt, then all whose intervals reach its own. Returns none
/// if nothing is faster beyond doubt.
fn fastest(speeds: &Speeds) -> Vec<&MethodSpeed> {
    let faster = same(speeds).filter(|m| m.speed.word() == "faster");
    let Some(best) = faster.max_by(by_speed) else {
        return Vec::new();
    };
    let is_other = |m: &&MethodSpeed| m.variant != best.variant;
    let reaches = |m: &&MethodSpeed| m.speed.high >= best.speed.low;
    let mut others: Vec<&MethodSpeed> = same(speeds).filter(is_other).filter(reaches).collect();
    others.sort_by(|a, b| by_speed(b, a));
    [best].into_iter().chain(others).collect()
}

/// Returns the methods that draw naive Phong's picture, without naive Phong.
fn same(speeds: &Speeds) -> impl Iterator<Item = &MethodSpeed> {
    let methods = speeds.methods.iter();
    methods.filter(|m| m.variant != BASELINE && m.levels <= SAME)
}

fn by_speed(a: &&MethodSpeed, b: &&MethodSpeed) -> Ordering {
    a.speed.typical.total_cmp(&b.speed.typical)
}

/// Says which method to use in one kind of code, how much it gains, and how much the lecture's
/// does.
fn of_speeds(speeds: &Speeds, is_optimised: bool) -> Said {
    let mut said = Said {
        level: match &*speeds.level {
            SCALAR => String::new(),
            "avx512" => "AVX-512".into(),
            level => level.to_uppercase(),
        },
        frames: speeds.frames.clone(),
        ..Said::default()
    };
    if let Some(why) = &speeds.too_busy {
        said.sentences.push(plain(why));
        return said;
    }
    if speeds.methods.is_empty() {
        said.sentences.push(plain("No times were taken."));
        return said;
    }
    if speeds.methods.iter().all(|m| m.variant == BASELINE) {
        said.sentences.push(plain("No other method was timed."));
        return said;
    }
    if !is_optimised {
        let debug = "Built without optimisation, so these times say nothing. ";
        said.sentences.push(plain(debug));
    }
    let fastest = fastest(speeds);
    let highest = same(speeds).max_by(by_speed);
    let best = fastest.first().copied().or(highest);
    let frames = &speeds.frames;
    if let [best, others @ ..] = &fastest[..] {
        let names = named(fastest.iter().map(|m| &*m.variant), 2, "or");
        let text = "For naive Phong’s picture in the least time, use ";
        said.sentences.push(plain(text));
        said.sentences.extend(names.clone());
        if others.is_empty() {
            said.sentences.push(plain("."));
            said.speeds.push(plain(" It is "));
        } else {
            said.sentences.push(plain(", which are tied."));
            let name = Part::Method(best.variant.clone());
            said.speeds.extend([plain(" "), name, plain(" is ")]);
        }
        said.speeds.extend(times(&best.speed));
        let text = format!(" as fast as naive Phong {frames}.");
        said.speeds.push(Part::Text(text));
        said.bars.push((names, best.speed));
    } else if let Some(best) = best {
        let nothing = plain("For naive Phong’s picture, nothing is faster than ");
        let doubt = Part::Text(format!(" beyond doubt {frames}."));
        let naive = Part::Method(BASELINE.into());
        said.sentences.extend([nothing, naive, doubt]);
        let name = Part::Method(best.variant.clone());
        said.bars.push(([name].into(), best.speed));
    } else {
        let text = format!("No other method that was timed draws naive Phong’s picture {frames}.");
        said.sentences.push(Part::Text(text));
    }
    let mut methods = speeds.methods.iter();
    let fast = methods.find(|m| m.variant == FAST);
    let is_best = best.is_some_and(|best| best.variant == FAST);
    if let Some(fast) = fast.filter(|_| !is_best) {
        let name = Part::Method(FAST.into());
        let is = match fast.speed.word() {
            "tie" => " ties with naive Phong: ".to_string(),
            word => format!(" is {word} than naive Phong: "),
        };
        let lecture = plain(" The lecture’s ");
        said.speeds.extend([lecture, name.clone(), Part::Text(is)]);
        said.speeds.extend(times(&fast.speed));
        said.speeds.push(plain("."));
        said.bars.push(([name].into(), fast.speed));
    }
    said
}

/// Writes a speed with its interval in words.
fn times(speed: &Ratio) -> Vec<Part> {
    let interval = format!("{:.2} to {:.2}", speed.low, speed.high);
    match speed.known() {
        Some(known) => {
            let known = Part::Strong(format!("{known} ×").replace(' ', "\u{A0}"));
            Vec::from([known, Part::Text(format!(" ({interval})"))])
        }
        None => Vec::from([Part::Strong(format!("{interval}\u{A0}×"))]),
    }
}

/// Returns the answer of a report without scenes, which counts the findings of its figures.
fn of_figures(data: &Value) -> String {
    let found = || {
        list(data, "/figures")
            .iter()
            .flat_map(|f| list(f, "/findings"))
    };
    let count = |word: &str| found().filter(|f| f["agreement"] == word).count();
    let [confirms, contradicts, adds] = ["confirms", "contradicts", "adds"].map(count);
    match found().count() {
        0 => "Nothing was compared.".into(),
        all => format!(
            "Of {all} statements measured, {confirms} are as printed, {contradicts} wrong or true only under conditions, \
             {adds} new."
        ),
    }
}

/// Names the machine and the day of the quiet run.
fn place(quiet: &Summary, said: &Said) -> String {
    let level = match &*said.level {
        "" => String::new(),
        level => format!(" with {level}"),
    };
    let date = match &quiet.date {
        None => String::new(),
        Some(date) => format!(", {date}"),
    };
    format!("quiet {}{level}{date}", quiet.machine.cpu)
}

/// Writes the answer as HTML, in cards side by side. Methods and scenes are links.
pub(super) fn html(data: &Value, quiet: &Summary) -> String {
    let own = Summary::of(data);
    if own.scenes == 0 {
        let text = html_text(&of_figures(data));
        return format!("<p class=\"answer\">{text}</p>");
    }
    let cards = cards(&own, Some(quiet)).into_iter().map(|card| {
        let mut html = format!("<h2>{}</h2>", card.head);
        if let Some(said) = &card.own {
            let own = format!("<p>{}</p>", html_parts(&said.sentences, true));
            // The script marks the methods that an answer on speeds names.
            html += &if card.head == PICTURE {
                own
            } else {
                let level = if said.level.is_empty() { "" } else { ", " };
                let by = format!("This run {}{level}{}", said.frames, said.level);
                let lines = html_lines(&by, said, true);
                format!("<div class=\"answer\">{own}{lines}</div>")
            };
        }
        if let Some(said) = &card.quiet {
            let by = format!("A {}, {}", place(quiet, said), said.frames);
            html += &html_lines(&by, said, false);
        }
        format!("<article class=\"card\">{html}</article>")
    });
    format!("<div class=\"cards\">{}</div>", cards.collect::<String>())
}

/// Writes the speeds of a run: for each method its bar, value and word, then the scale. Returns
/// nothing without speeds. Methods are links if `is_here`: the page has them.
fn html_lines(by: &str, said: &Said, is_here: bool) -> String {
    if said.bars.is_empty() {
        return String::new();
    }
    let line = |(name, speed): &(Vec<Part>, Ratio)| {
        let (name, word, bar) = (html_parts(name, is_here), speed.word(), bar(speed));
        let tone = match word {
            "faster" => "good",
            "slower" => "bad",
            _ => "",
        };
        let (known, low, high) = (speed.known(), speed.low, speed.high);
        let known = known.map_or_else(|| "–".into(), |known| format!("{known}\u{A0}×"));
        format!(
            "<span>{name}</span><span>{known} ({low:.2}–{high:.2}) <b class=\"{tone}\">{word}</b></span>\
             <span class=\"gain {tone}\" aria-hidden=\"true\">{bar}</span>"
        )
    };
    let lines: String = said.bars.iter().map(line).collect();
    let scale = "<span class=\"ends\" aria-hidden=\"true\"><i>0.5</i><i>1</i><i>2 ×</i></span>";
    let by = html_text(by);
    format!("<div class=\"gains\"><small>{by}</small>{lines}{scale}</div>")
}

/// Draws an interval on a logarithmic scale from 0.5 to 2. Arrows say that it goes on.
fn bar(speed: &Ratio) -> String {
    let Ratio { low, high, .. } = *speed;
    let place = |speed: f64| 50.0 + 50.0 * libm::log2(speed).clamp(-1.0, 1.0);
    // 2 % are seen where the interval is narrower.
    let from = place(low).min(98.0);
    let width = (place(high) - from).max(2.0);
    let line = if low < 2.0 && high > 0.5 {
        format!("<i style=\"left:{from:.1}%;width:{width:.1}%\"></i>")
    } else {
        String::new()
    };
    let left = if low < 0.5 { "<s>◂</s>" } else { "" };
    let right = if high > 2.0 { "<u>▸</u>" } else { "" };
    [left, &line, right].concat()
}

/// Writes a sentence as HTML. Scenes are links, and methods are if `is_here`.
fn html_parts(parts: &[Part], is_here: bool) -> String {
    let part = |part: &Part| match part {
        Part::Text(text) => html_text(text),
        Part::Strong(text) => format!("<b>{}</b>", html_text(text)),
        Part::Method(name) if !is_here => html_text(&label(name)),
        Part::Method(name) => {
            let (name, label) = (html_text(name), html_text(&label(name)));
            format!("<a class=\"m\" data-m=\"{name}\" href=\"#methods/{name}\">{label}</a>")
        }
        Part::Scene(place, title, of) => {
            let (title, of) = (html_text(title), html_text(of));
            format!("<a data-scene=\"{place}\" data-of=\"{of}\">{title}</a>")
        }
    };
    parts.iter().map(part).collect()
}

/// Writes the answer in Markdown, as headings with their sentences.
pub(super) fn markdown(data: &Value, quiet: &Summary) -> Vec<(String, String)> {
    let own = Summary::of(data);
    if own.scenes == 0 {
        let text = markdown_text(&of_figures(data));
        return Vec::from([("Answer".into(), text)]);
    }
    let words = |said: &Said| words(said, markdown_text, |name| markdown_text(&label(name)));
    let point = |card: &Card| {
        let own = card.own.iter().map(words);
        let beside = card.quiet.iter().map(|said| {
            let by = markdown_text(&place(quiet, said));
            format!("On a {by}: {}", words(said))
        });
        let sentences: Vec<String> = own.chain(beside).collect();
        (head(card), sentences.join(" "))
    };
    cards(&own, Some(quiet)).iter().map(point).collect()
}

/// Returns the answer of a run as plain text: headings with their sentences. Methods have their
/// names of the command line.
pub fn sentences(summary: &Summary) -> Vec<(String, String)> {
    let words = |said: &Said| words(said, str::to_string, |name| format!("`{name}`"));
    let cards = cards(summary, None).into_iter();
    cards
        .filter_map(|card| Some((head(&card), words(card.own.as_ref()?))))
        .collect()
}

/// Returns the answer of a document as lines for a terminal.
///
/// # Panics
/// If the document is not one that this program makes.
pub fn text_of(document: &Document) -> String {
    let data = parse(&document.to_text()).expect("a document of this program");
    let sentences = sentences(&Summary::of(&data)).into_iter();
    let line = |(head, words)| format!("{head}: {words}\n");
    sentences.map(line).collect()
}

/// Returns the heading of a card, with the instruction set.
fn head(card: &Card) -> String {
    match card.own.as_ref().map(|said| &*said.level) {
        None | Some("") => card.head.to_string(),
        Some(level) => format!("{}, {level}", card.head),
    }
}

/// Joins the parts of sentences.
fn words(said: &Said, text: fn(&str) -> String, method: fn(&str) -> String) -> String {
    let part = |part: &Part| match part {
        Part::Text(words) | Part::Strong(words) | Part::Scene(_, words, _) => text(words),
        Part::Method(name) => method(name),
    };
    let parts = said.sentences.iter().chain(&said.speeds);
    parts.map(part).collect()
}

#[cfg(test)]
mod tests;
