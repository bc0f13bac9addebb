//! Checks the course in `report/course`. Its figures and findings exist, and each of its numbers is
//! measured or stands in a figure.

use crate::markdown::{files, quoted, read, root, rows};
use fastphong::shading::Variant;
use fastphong_cli::lectures::{Agreement, Figure, FigureBlock, FigureContent, Finding};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The chapters in order: an introduction, and the sections of the lecture.
const SECTIONS: [&str; 9] = ["0", "1", "2", "3", "4.1", "4.2", "4.3", "4.4", "5"];

/// The page for teachers, which follows the chapters.
const TEACHING: &str = "teaching.md";

/// The most bytes that all still pictures may have together.
const MOST_BYTES: u64 = 350_000;

/// Returns the path and the text of each chapter, in order.
fn chapters() -> Vec<(PathBuf, String)> {
    let all = files("report/course", "md").into_iter();
    let is_chapter = |path: &PathBuf| name(path).starts_with(|c: char| c.is_ascii_digit());
    let chapters = all.filter(is_chapter);
    chapters.map(|path| (path.clone(), read(path))).collect()
}

/// Returns the chapters that measure something: all except the introduction.
fn measuring() -> impl Iterator<Item = (PathBuf, String)> {
    chapters().into_iter().skip(1)
}

/// Returns the name of a file.
fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

/// Returns the page for teachers.
fn teaching() -> String {
    read(format!("report/course/{TEACHING}"))
}

/// Returns the contents of each comment of a kind, and the paragraph after the comment.
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

/// Returns the name of a chapter's figure.
fn figure_of(text: &str) -> &str {
    let (name, _) = named(text, "figure").next().expect("a figure");
    name
}

#[test]
fn every_section_has_a_chapter_that_leads_to_the_next() {
    let chapters = chapters();
    let source = read("report/files.rs");
    let title = |text: &str| text.lines().next().unwrap()[2..].to_string();
    assert_eq!(chapters.len(), SECTIONS.len());
    let teaching = (PathBuf::from(TEACHING), teaching());
    let parts = SECTIONS.into_iter().chain(["teaching"]);
    let all: Vec<_> = chapters.iter().chain([&teaching]).collect();
    for (i, ((path, text), part)) in all.iter().zip(parts).enumerate() {
        let file = name(path);
        let is_section = title(text).starts_with(&format!("{part} "));
        assert!(is_section || file == TEACHING, "{file}");
        let listed = format!("\"{part}\" in \"{file}\"");
        assert!(source.contains(&listed), "report/files.rs: {listed}");
        let link = |arrow: fn(String) -> String, to: Option<&&(PathBuf, String)>| {
            to.map(|(path, text)| format!("[{}]({})", arrow(title(text)), name(path)))
        };
        let before = i.checked_sub(1).and_then(|i| all.get(i));
        let before = link(|title| format!("← {title}"), before);
        let after = link(|title| format!("{title} →"), all.get(i + 1));
        let links: Vec<_> = before.into_iter().chain(after).collect();
        assert_eq!(
            text.lines().last().unwrap(),
            links.join(" · "),
            "{file}: links at its end"
        );
        let others = text.matches("](").count() - links.len();
        // The one other link leads to the picture, or for teachers to the page for students.
        assert_eq!(others, 1, "{file}: the page has other chapters only");
    }
}

#[test]
fn every_chapter_has_one_figure_with_its_still() {
    let mut bytes = 0;
    for (path, text) in chapters() {
        let path = path.display();
        let [(name, still)] = named(&text, "figure").collect::<Vec<_>>()[..] else {
            panic!("{path}: not one figure")
        };
        assert_eq!(text.matches("## See it").count(), 1, "{path}");
        let picture = format!("../../docs/images/course/{name}.png");
        let has_alt = still.starts_with("![") && !still.starts_with("![]");
        assert!(
            has_alt && still.contains(&format!("]({picture})\n")),
            "{path}"
        );
        assert!(Figure::named(name).is_some(), "{path}: no figure {name}");
        let file = root().join("report/course").join(&picture);
        let found = std::fs::metadata(&file).map(|file| file.len());
        bytes += found.unwrap_or_else(|error| panic!("{picture}: {error}"));
    }
    assert!(bytes <= MOST_BYTES, "the stills have {bytes} bytes");
}

/// Returns the figure that a comment's words name, and the findings with the keys that `keys` picks
/// from the words.
fn findings_of<'a>(words: &'a str, keys: impl Fn(&[&'a str]) -> Vec<&'a str>) -> Vec<Finding> {
    let words: Vec<_> = words.split(' ').collect();
    let figure = Figure::named(words[0]).unwrap_or_else(|| panic!("no figure {}", words[0]));
    let content = figure.make().expect("a figure");
    let finding = |key| content.finding(key).cloned();
    let keys = keys(&words).into_iter();
    let found = keys.map(|key| finding(key).unwrap_or_else(|| panic!("{words:?}: no {key}")));
    found.collect()
}

#[test]
fn every_chapter_asks_before_it_states_measurements() {
    for (path, text) in measuring() {
        let path = path.display();
        for part in ["\n## A question\n", "\n## Measured\n"] {
            assert_eq!(text.matches(part).count(), 1, "{path}: {part}");
        }
        let (before, after) = text.split_once("\n## Measured\n").unwrap();
        let question = before
            .split_once("\n## A question\n")
            .expect("a question")
            .1;
        let [(words, paragraph)] = named(question, "question").collect::<Vec<_>>()[..] else {
            panic!("{path}: not one question")
        };
        assert!(paragraph.contains('?'), "{path}: {paragraph}");
        assert_eq!(named(&text, "question").count(), 1, "{path}");
        assert_eq!(named(before, "finding").count(), 0, "{path}: too early");
        let (first, _) = named(after, "finding").next().expect("a finding");
        let figure = words.split(' ').next().unwrap();
        let decides = answer(words, question);
        assert_eq!(first, format!("{figure} {decides}"), "{path}: its answer");
    }
}

/// Checks a question. Returns the key of the finding that decides its answer.
fn answer(words: &str, question: &str) -> String {
    let kind = words.split(' ').nth(1).expect("a kind of question");
    if kind == "largest" {
        let found = findings_of(words, |words| words[2..].to_vec());
        let choices = question.lines().filter(|line| line.starts_with("- "));
        assert_eq!(choices.count(), found.len(), "{words}: a line for each");
        let mut values: Vec<_> = found.iter().collect();
        values.sort_by(|a, b| b.value.total_cmp(&a.value));
        let clear = values[0].value > 1.5 * values[1].value;
        assert!(clear, "{words}: the largest is hardly larger");
        return values[0].key.to_string();
    }
    assert_eq!(kind, "slider", "{words}");
    let found = findings_of(words, |words| vec![words[2]]);
    let numbers: Vec<f64> = words
        .split(' ')
        .skip(3)
        .map_while(|word| word.parse().ok())
        .collect();
    let [low, high, step] = numbers[..] else {
        panic!("{words}: not low, high and step")
    };
    let Finding { key, value, .. } = &found[0];
    assert!((low..=high).contains(value), "{words}: {value}");
    // The slider starts in the middle, which must not be the answer.
    let middle = low + step * ((high - low) / step / 2.0).round();
    assert!(
        (value - middle).abs() > step,
        "{words}: right from the start"
    );
    let unit = words.splitn(7, ' ').nth(6).expect("a unit");
    let is_unit = *unit == *found[0].unit || (found[0].unit.is_empty() && unit == "times");
    assert!(is_unit, "{words}: {}", found[0].unit);
    key.to_string()
}

#[test]
fn goals_name_existing_findings_and_handles_and_are_not_met_at_the_start() {
    let mut count = 0;
    for (path, text) in chapters() {
        let path = path.display();
        for (words, _) in named(&text, "toy") {
            let words: Vec<_> = words.split(' ').collect();
            let [figure, rule, key, ref rest @ ..] = words[..] else {
                panic!("{path}: {words:?}")
            };
            let figure = Figure::named(figure).expect("a figure");
            let live = figure.live.expect("handles");
            let content = live.make(&[]).expect("a figure");
            let found = content
                .finding(key)
                .unwrap_or_else(|| panic!("{path}: no {key} at the start"));
            match rule {
                "first" => {
                    let is_handle = live.handles.iter().any(|handle| handle.name == rest[0]);
                    assert!(is_handle, "{path}: no handle {}", rest[0]);
                    assert_ne!(
                        found.agreement,
                        Agreement::Contradicts,
                        "{path}: done at once"
                    );
                }
                "most" => {
                    let stored = figure.make().expect("a figure");
                    let most = stored.finding(key).expect("a stored finding").value;
                    assert!(found.value < 0.9 * most, "{path}: done at once");
                }
                _ => panic!("{path}: no rule {rule}"),
            }
            assert_eq!(text.matches("\n\n<!-- learnt -->\n").count(), 1, "{path}");
            count += 1;
        }
    }
    assert_eq!(count, 2);
}

#[test]
fn every_chapter_leads_into_the_figure_that_stops() {
    for (path, text) in chapters() {
        let links: Vec<_> = named(&text, "stop").collect();
        assert!(!links.is_empty(), "{}: no link", path.display());
        for (query, _) in links {
            is_state(query);
        }
    }
}

/// Checks that a query names a state of the figure.
fn is_state(query: &str) {
    for part in query.split('&') {
        let (key, value) = part.split_once('=').unwrap_or((part, ""));
        let is_number = value.parse::<u32>().is_ok();
        let is_known = match key {
            "method" => Variant::parse(value).is_ok(),
            "event" => [
                "bucket", "empty", "retire", "step", "enter", "sort", "span", "depth", "run",
                "pixel", "end",
            ]
            .contains(&value),
            "ask" => ["edges", "shared", "next"].contains(&value),
            "try" => ["highlight", "newton", "edge", "depth"].contains(&value),
            "steps" | "line" | "x" | "polygon" => is_number,
            "bare" => value.is_empty(),
            _ => false,
        };
        assert!(is_known, "{query}: {part}");
    }
}

#[test]
fn links_for_teachers_lead_to_existing_pages() {
    let text = teaching();
    let mut count = 0;
    for quoted in quoted(&text) {
        let Some((_, address)) = quoted.split_once("#course") else {
            continue;
        };
        count += 1;
        let (part, query) = address.split_once('?').unwrap_or((address, ""));
        match part {
            "" => {}
            "/stop" => is_state(query),
            part => assert!(SECTIONS.contains(&&part[1..]), "{quoted}"),
        }
    }
    assert!(count > 8, "only {count} addresses");
    for section in SECTIONS {
        let shown = text.contains(&format!("- **{section} "));
        assert!(shown, "no misconception of chapter {section}");
    }
    assert_eq!(text.matches("*Misconception:*").count(), SECTIONS.len());
    let rows = rows(&text).into_iter();
    let minutes: u32 = rows.filter_map(|row| row[0].parse::<u32>().ok()).sum();
    assert_eq!(minutes, 50);
}

/// A number as it is written: its value, and half a unit of its last digit.
#[derive(Debug)]
struct Written(f64, f64);

impl Written {
    /// True if `value` would be written like this.
    fn is(&self, value: f64) -> bool {
        let Written(written, half) = *self;
        (value - written).abs() <= half * (1.0 + 1e-9)
    }
}

/// Returns the numbers in a text, without those of equations, sections, chapters and figures. A
/// power of ten belongs to its number.
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

/// Returns all texts of a figure: paragraphs, captions, titles, cells, and the labels and sentences
/// of findings.
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
            FigureBlock::Trace { .. } => {}
        }
    }
    let findings = content.findings.iter();
    texts.extend(findings.flat_map(|x| [&*x.label, &*x.verdict]));
    texts
}

/// Returns the first number in a text that is neither `value` nor in a text of the figure, if there
/// is one.
fn unfounded(text: &str, value: Option<f64>, content: &FigureContent) -> Option<Written> {
    let known: Vec<Written> = says(content).into_iter().flat_map(numbers).collect();
    numbers(text).into_iter().find(|number| {
        let is_value = value.is_some_and(|value| number.is(value));
        !is_value && !known.iter().any(|known| number.is(known.0))
    })
}

/// Returns a chapter's text without findings, questions, exercises, code, headings and links.
fn prose(text: &str) -> String {
    let mut in_code = false;
    let mut in_finding = false;
    let mut kept = String::new();
    for line in text.lines() {
        let is_fence = line.starts_with("```");
        in_code ^= is_fence;
        let is_other = ["finding", "question", "hands"]
            .iter()
            .any(|kind| line.starts_with(&format!("<!-- {kind}")));
        in_finding = (in_finding || is_other) && !line.is_empty();
        let is_other = ["[", "#", "<!--"]
            .iter()
            .any(|start| line.starts_with(start));
        if !(in_code || is_fence || in_finding || is_other) {
            kept.extend(line.split('`').step_by(2).chain(["\n"]));
        }
    }
    kept
}

#[test]
fn every_number_is_measured_or_stands_in_a_figure() {
    let [introduction, ..] = &chapters()[..] else {
        panic!("no chapters")
    };
    assert!(numbers(&prose(&introduction.1)).is_empty());
    let chapters: Vec<_> = measuring().collect();
    let findings = |text| {
        named(text, "finding").map(|(names, paragraph)| {
            let (figure, key) = names.split_once(' ').expect("a figure and a key");
            (figure, key, paragraph)
        })
    };
    let mut made: BTreeMap<&str, FigureContent> = BTreeMap::new();
    for (path, text) in &chapters {
        let all = findings(text).map(|(figure, ..)| figure);
        let asked = named(text, "question").filter_map(|(words, _)| words.split(' ').next());
        for name in all.chain(asked).chain([figure_of(text)]) {
            let figure = Figure::named(name)
                .unwrap_or_else(|| panic!("{}: no figure {name}", path.display()));
            made.entry(name)
                .or_insert_with(|| figure.make().expect("a figure"));
        }
    }
    let mut count = 0;
    for (path, text) in &chapters {
        let path = path.display();
        for (figure, key, paragraph) in findings(text) {
            let content = &made[figure];
            let finding: &Finding = content
                .finding(key)
                .unwrap_or_else(|| panic!("{path}: {figure} has no {key}"));
            let value = finding.value;
            let is_stated = numbers(paragraph).iter().any(|number| number.is(value));
            assert!(is_stated, "{path}: {figure} {key} is {value}: {paragraph}");
            let wrong = unfounded(paragraph, Some(value), content);
            assert!(wrong.is_none(), "{path}: {figure} {key}: {wrong:?}");
            count += 1;
        }
        for (words, paragraph) in named(text, "question") {
            let content = &made[words.split(' ').next().expect("a figure")];
            let known = &content.findings;
            let is_measured = |number: &Written| known.iter().any(|found| number.is(found.value));
            let others = numbers(paragraph).into_iter().filter(|n| !is_measured(n));
            let known: Vec<_> = says(content).into_iter().flat_map(numbers).collect();
            let wrong = others
                .into_iter()
                .find(|n| !known.iter().any(|k| n.is(k.0)));
            assert!(wrong.is_none(), "{path}: a question has {wrong:?}");
        }
        let wrong = unfounded(&prose(text), None, &made[figure_of(text)]);
        assert!(wrong.is_none(), "{path}: {wrong:?} stands nowhere");
    }
    assert!(count >= 2 * SECTIONS.len(), "only {count} findings");
}

#[test]
fn numbers_are_read_with_half_a_unit_of_their_last_digit() {
    let text = "Section 4.1 and (4.12): 90° over 16 pixels, 4.2·10⁻⁴ or 12.5.";
    let [right, pixels, small, last] = &numbers(text)[..] else {
        panic!("{:?}", numbers(text))
    };
    assert!(right.is(90.4) && !right.is(90.6) && pixels.is(16.0));
    assert!(small.is(4.249e-4) && !small.is(4.26e-4) && !small.is(4.2));
    assert!(last.is(12.45) && !last.is(12.6));
}
