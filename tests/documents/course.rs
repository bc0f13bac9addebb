//! Checks the course in `docs/course`: its figures and findings exist, and every number that it states
//! is measured or stands in a figure.
#![cfg(feature = "cli")]

use crate::markdown::{files, read, root};
use fastphong::lectures::{Figure, FigureBlock, FigureContent, Finding};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The sections of the lecture that have a chapter, in order.
const SECTIONS: [&str; 8] = ["1", "2", "3", "4.1", "4.2", "4.3", "4.4", "5"];

/// The most bytes of all still pictures.
const MOST_BYTES: u64 = 300_000;

/// Returns path and text of all chapters, in order.
fn chapters() -> Vec<(PathBuf, String)> {
    let all = files("docs/course", "md").into_iter();
    let chapters = all.filter(|path| !path.ends_with("check-your-own.md"));
    chapters.map(|path| (path.clone(), read(path))).collect()
}

/// Returns what comments of this kind say, each with the paragraph after it.
fn named<'a>(text: &'a str, kind: &'a str) -> impl Iterator<Item = (&'a str, &'a str)> {
    let comments = text.split("<!-- ").skip(1).filter_map(move |rest| {
        let (names, after) = rest
            .strip_prefix(kind)?
            .strip_prefix(": ")?
            .split_once(" -->\n")?;
        Some((names, after.split("\n\n").next().unwrap_or_default()))
    });
    comments.inspect(|(names, paragraph)| {
        assert!(
            !paragraph.trim().is_empty(),
            "no paragraph directly after {names}"
        );
    })
}

/// Returns the name of the figure of a chapter.
fn figure_of(text: &str) -> &str {
    let (name, _) = named(text, "figure").next().expect("a figure");
    name
}

#[test]
fn every_section_has_a_chapter_that_leads_to_the_next() {
    let chapters = chapters();
    let source = read("src/report/course.rs");
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    let title = |text: &str| text.lines().next().unwrap()[2..].to_string();
    assert_eq!(chapters.len(), SECTIONS.len());
    for (i, ((path, text), section)) in chapters.iter().zip(SECTIONS).enumerate() {
        let file = name(path);
        assert!(title(text).starts_with(&format!("{section} ")), "{file}");
        let (_, topic) = file.trim_end_matches(".md").split_once('-').unwrap();
        let listed = format!("\"{section}\" \"{topic}\"");
        assert!(source.contains(&listed), "src/report/course.rs: {listed}");
        let link = |arrow: fn(String) -> String, to: Option<&(PathBuf, String)>| {
            to.map(|(path, text)| format!("[{}]({})", arrow(title(text)), name(path)))
        };
        let before = i.checked_sub(1).and_then(|i| chapters.get(i));
        let before = link(|title| format!("← {title}"), before);
        let after = link(|title| format!("{title} →"), chapters.get(i + 1));
        let links: Vec<_> = before.into_iter().chain(after).collect();
        assert_eq!(
            text.lines().last().unwrap(),
            links.join(" · "),
            "{file}: links at its end"
        );
        assert_eq!(
            text.matches("](").count() - 1,
            links.len(),
            "{file}: the page has other chapters alone"
        );
    }
}

#[test]
fn every_chapter_has_one_figure_with_its_still_and_one_question() {
    let mut bytes = 0;
    for (path, text) in chapters() {
        let path = path.display();
        let [(name, still)] = named(&text, "figure").collect::<Vec<_>>()[..] else {
            panic!("{path}: not one figure")
        };
        assert!(Figure::named(name).is_some(), "{path}: no figure {name}");
        let picture = format!("../images/course/{name}.png");
        let has_alt = still.starts_with("![") && !still.starts_with("![]");
        assert!(
            has_alt && still.contains(&format!("]({picture})\n")),
            "{path}"
        );
        let file = root().join("docs/course").join(&picture);
        let found = std::fs::metadata(&file).map(|file| file.len());
        bytes += found.unwrap_or_else(|error| panic!("{picture}: {error}"));
        for part in ["## See it", "## Measured", "## A question", "</details>"] {
            assert_eq!(text.matches(part).count(), 1, "{path}: {part}");
        }
        let (_, answer) = text.split_once("<summary>Answer</summary>").unwrap();
        let (answer, _) = answer.split_once("</details>").unwrap();
        let prose = answer.lines().filter(|line| !line.starts_with("<!--"));
        let sentences = prose.collect::<Vec<_>>().join(" ");
        let sentences = sentences.matches(". ").count();
        assert!(
            (1..=3).contains(&sentences),
            "{path}: {sentences} sentences"
        );
    }
    assert!(bytes <= MOST_BYTES, "the stills have {bytes} bytes");
}

/// A number as it is written: its value, and half a unit of its last digit.
#[derive(Debug)]
struct Written(f64, f64);

impl Written {
    /// True if a value is written like this.
    fn is(&self, value: f64) -> bool {
        let Written(written, half) = *self;
        (value - written).abs() <= half * (1.0 + 1e-9)
    }
}

/// Returns the numbers of a text, but those of equations, sections, chapters and figures. A power of
/// ten is a part of its number.
fn numbers(text: &str) -> Vec<Written> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(from) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, number) = rest.split_at(from);
        let end = number.find(|c: char| !c.is_ascii_digit() && c != '.');
        let digits = number[..end.unwrap_or(number.len())].trim_end_matches('.');
        rest = &number[digits.len()..];
        let mut scale = 1.0;
        if let Some(power) = rest.strip_prefix("·10") {
            let sign = if power.starts_with('⁻') { -1 } else { 1 };
            let raised = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|digit| digit == c);
            let digits = power.trim_start_matches('⁻').chars().map_while(raised);
            let exponent = digits.fold(0, |all, digit| 10 * all + digit as i32);
            scale = 10f64.powi(sign * exponent);
            rest = power;
        }
        let decimals = digits
            .split_once('.')
            .map_or(0, |(_, decimals)| decimals.len());
        let is_place = ["(", "section ", "Section ", "chapter ", "Figure "]
            .iter()
            .any(|place| before.ends_with(place));
        if !is_place {
            let value: f64 = digits.parse().expect("digits");
            let half = 0.5 * 10f64.powi(-(decimals as i32));
            found.push(Written(value * scale, half * scale));
        }
    }
    found
}

/// Returns what a figure says: texts, captions, titles, cells, and labels and sentences of findings.
fn says(content: &FigureContent) -> Vec<&str> {
    let mut texts = Vec::new();
    for block in &content.blocks {
        match block {
            FigureBlock::Text(text) => texts.push(&**text),
            FigureBlock::Pictures { shown, .. } => {
                texts.extend(shown.iter().map(|panel| &*panel.caption));
            }
            FigureBlock::Plot(plot) => texts.extend([&*plot.title, &*plot.caption]),
            FigureBlock::Table { head, rows } => {
                texts.extend(head.iter().chain(rows.iter().flatten()).map(|cell| &**cell));
            }
        }
    }
    let findings = content.findings.iter();
    texts.extend(findings.flat_map(|x| [&*x.label, &*x.verdict]));
    texts
}

/// Finds the first number of a text that neither is the value nor stands in what a figure says.
fn unfounded(text: &str, value: Option<f64>, content: &FigureContent) -> Option<Written> {
    let known: Vec<Written> = says(content).into_iter().flat_map(numbers).collect();
    numbers(text).into_iter().find(|number| {
        let is_value = value.is_some_and(|value| number.is(value));
        !is_value && !known.iter().any(|known| number.is(known.0))
    })
}

/// Returns a chapter without findings, code, headings and links.
fn prose(text: &str) -> String {
    let mut in_code = false;
    let mut in_finding = false;
    let mut kept = String::new();
    for line in text.lines() {
        let is_fence = line.starts_with("```");
        in_code ^= is_fence;
        in_finding = (in_finding || line.starts_with("<!-- finding")) && !line.is_empty();
        let is_link = line.starts_with('[');
        if !(in_code || is_fence || in_finding || is_link || line.starts_with('#')) {
            kept.extend(line.split('`').step_by(2).chain(["\n"]));
        }
    }
    kept
}

#[test]
fn every_number_is_measured_or_stands_in_a_figure() {
    let chapters = chapters();
    let findings = |text| {
        named(text, "finding").map(|(names, paragraph)| {
            let (figure, key) = names.split_once(' ').expect("a figure and a key");
            (figure, key, paragraph)
        })
    };
    let mut made: BTreeMap<&str, FigureContent> = BTreeMap::new();
    for (path, text) in &chapters {
        let all = findings(text).map(|(figure, ..)| figure);
        for name in all.chain([figure_of(text)]) {
            let figure = Figure::named(name);
            let figure = figure.unwrap_or_else(|| panic!("{}: no figure {name}", path.display()));
            made.entry(name)
                .or_insert_with(|| figure.make().expect("a figure"));
        }
    }
    let mut count = 0;
    for (path, text) in &chapters {
        let path = path.display();
        for (figure, key, paragraph) in findings(text) {
            let content = &made[figure];
            let finding: Option<&Finding> = content.finding(key);
            let finding = finding.unwrap_or_else(|| panic!("{path}: {figure} has no {key}"));
            let value = finding.value;
            let is_stated = numbers(paragraph).iter().any(|number| number.is(value));
            assert!(is_stated, "{path}: {figure} {key} is {value}: {paragraph}");
            let wrong = unfounded(paragraph, Some(value), content);
            assert!(wrong.is_none(), "{path}: {figure} {key}: {wrong:?}");
            count += 1;
        }
        let wrong = unfounded(&prose(text), None, &made[figure_of(text)]);
        assert!(wrong.is_none(), "{path}: {wrong:?} stands nowhere");
    }
    assert!(count >= 2 * SECTIONS.len(), "only {count} findings");
}

#[test]
fn numbers_are_read_as_they_are_written() {
    let text = "Section 4.1 and (4.12): 90° over 16 pixels, 4.2·10⁻⁴ or 12.5.";
    let [right, pixels, small, last] = &numbers(text)[..] else {
        panic!("{:?}", numbers(text))
    };
    assert!(right.is(90.4) && !right.is(90.6) && pixels.is(16.0));
    assert!(small.is(4.249e-4) && !small.is(4.26e-4) && !small.is(4.2));
    assert!(last.is(12.45) && !last.is(12.6));
}
