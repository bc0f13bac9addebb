use super::sentences::opening;
use super::summary::{Tally, overall};
use super::*;
use crate::compare::comparison::{
    Comparison, Document, Input, Options, RatioData, RowData, SpeedData, compare, triangulation,
};
use crate::compare::timing::{Machine, Ratio, Timing};
use crate::mesh::builtin::builtin;
use crate::scene::Scene;
use crate::shading::METHODS;
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::ToString;
use alloc::vec;

/// A small mesh drawn by all methods, without times.
fn compared(mesh: &str, name: &str) -> (Comparison, Section) {
    let mut scene = Scene::of_mesh(builtin(mesh).unwrap());
    (scene.width, scene.height) = (40, 30);
    let frame = scene.frame().unwrap();
    let variants: Vec<_> = METHODS.iter().map(|entry| entry.variant()).collect();
    let comparison = compare(
        &Input {
            name: name.into(),
            frame: &frame,
        },
        &variants,
        &Options {
            timing: None,
            ..Options::default()
        },
        &mut |_, _| {},
    );
    let triangles = triangulation(&frame, &comparison.reference);
    let caption = Caption {
        title: name.to_owned(),
        description: format!("What {name} tests."),
    };
    let section = Section::new(caption, &comparison, triangles.as_ref(), Detail::Full).unwrap();
    (comparison, section)
}

fn section(mesh: &str, name: &str) -> Section {
    compared(mesh, name).1
}

fn machine() -> Machine {
    Machine {
        profile: "release".into(),
        ..Machine::this()
    }
}

pub(super) fn report(sections: Vec<Section>) -> Report {
    let command_line = ["fastphong", "report", "a b"].map(String::from).to_vec();
    Report {
        sections,
        lecture: vec![],
        studies: Studies::default(),
        machine: machine(),
        command_line,
        date: Some("2000-02-29".into()),
    }
}

/// Gives each row a time, in ms, and ratios to naive Phong whose intervals reach `spread` to both sides.
fn timed(mut section: Section, times: &[(&str, f64)], spread: f64) -> Section {
    let of = |name: &str| {
        times
            .iter()
            .find(|(method, _)| *method == name)
            .map_or(4.0, |(_, ms)| *ms)
    };
    let naive = of("naive-phong");
    let give = |row: &mut RowData| {
        let ms = of(&row.variant);
        let median = naive / ms;
        let ratio = Ratio {
            median,
            low: median / spread,
            high: median * spread,
        };
        let ratio = Some(RatioData {
            ratio,
            tie: ratio.is_tie(),
        });
        row.speed = Some(SpeedData {
            timing: Timing::of(vec![1e6 * ms; 5], 1).unwrap(),
            ns_per_covered_pixel: Some(1.0),
            ratio_to_naive: ratio,
            ratio_to_barycentric: ratio,
        });
    };
    section
        .data
        .rows
        .iter_mut()
        .chain(&mut section.data.barycentric)
        .for_each(give);
    section
}

const SPHERE: &str = "sphere?rings=4&segments=8";

/// Fails unless every element is closed in the order of opening, and every attribute is quoted.
pub(super) fn assert_balanced(html: &str) {
    const VOID: [&str; 4] = ["meta", "link", "img", "br"];
    let mut open: Vec<String> = Vec::new();
    let mut rest = html;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        let (tag, after) = tag(rest);
        rest = after;
        let name: String = tag
            .trim_start_matches('/')
            .chars()
            .take_while(|c| c.is_ascii_alphanumeric())
            .collect();
        if tag.starts_with('!') || VOID.contains(&name.as_str()) || tag.ends_with('/') {
            continue;
        }
        assert!(!name.is_empty(), "`<{tag}>` names no element");
        if tag.starts_with('/') {
            assert_eq!(
                open.pop(),
                Some(name),
                "closed out of order: {}",
                &html[..html.len() - rest.len()].len()
            );
        } else {
            if ["style", "script"].contains(&name.as_str()) {
                rest = &rest[rest.find(&format!("</{name}")).unwrap()..];
            }
            open.push(name);
        }
    }
    assert!(open.is_empty(), "left open: {open:?}");
}

/// The inside of the tag that `html` starts with, and what comes after it; quotes may hold `>`.
fn tag(html: &str) -> (&str, &str) {
    let mut quoted = false;
    for (i, letter) in html.char_indices() {
        match letter {
            '"' => quoted = !quoted,
            '>' if !quoted => return (&html[1..i], &html[i + 1..]),
            '<' if i > 0 => assert!(quoted, "`<` in a tag: {}", &html[..i + 1]),
            _ => {}
        }
    }
    unreachable!("a tag without an end: {}", &html[..html.len().min(80)])
}

/// What stands between the tags of the element with this id.
pub(super) fn script_data(html: &str) -> &str {
    let start = html.find("id=\"fastphong-data\">").unwrap() + "id=\"fastphong-data\">".len();
    &html[start..start + html[start..].find("</script>").unwrap()]
}

#[test]
fn the_page_has_a_section_a_scene_and_a_row_and_a_figure_a_method() {
    let sections = vec![
        timed(section(SPHERE, "sphere"), &[("fast-phong", 2.0)], 1.1),
        section("triangle", "three"),
        section("prism", "three"),
    ];
    let html = report(sections).html();
    assert_balanced(&html);
    for id in ["scene-sphere", "scene-three", "scene-three-2"] {
        assert_eq!(
            html.matches(&format!("<section class=\"scene\" id=\"{id}\""))
                .count(),
            1,
            "{id}"
        );
        assert!(html.contains(&format!("href=\"#{id}\"")), "{id}");
    }
    for entry in METHODS {
        let name = entry.info.name;
        assert_eq!(
            html.matches(&format!(">{name}</th><td>")).count(),
            3,
            "a row of {name} a scene"
        );
        assert_eq!(
            html.matches(&format!("<figure data-name=\"{name}\">"))
                .count(),
            3,
            "a figure of {name} a scene"
        );
        let barycentric = html
            .matches(&format!(">{name}, barycentric</th><td>"))
            .count();
        assert_eq!(
            barycentric,
            if entry.info.barycentric { 3 } else { 0 },
            "{name}"
        );
    }
    assert_eq!(html.matches("<figure data-name=\"reference\">").count(), 3);
    // The triangle needs no cutting.
    assert_eq!(
        html.matches("<figure data-name=\"reference of triangles\">")
            .count(),
        2
    );
    assert_eq!(
        html.matches("<svg").count(),
        2,
        "the scene that was timed has charts"
    );
    assert!(html.contains("fastphong report &#39;a b&#39;") && html.contains("2000-02-29"));
    assert!(html.contains("What sphere tests."));
}

/// Fails unless all rows of each table of a text in Markdown have as many cells.
pub(super) fn assert_tables_are_even(markdown: &str) {
    let cells = |line: &str| {
        line.replace("\\\\", "")
            .replace("\\|", "")
            .matches('|')
            .count()
    };
    let tables: Vec<&str> = markdown
        .split("\n\n")
        .filter(|part| part.starts_with("| "))
        .collect();
    assert!(tables.len() >= 4);
    for table in tables {
        let columns: Vec<usize> = table.lines().map(cells).collect();
        assert!(columns.iter().all(|n| *n == columns[0]), "{table}");
    }
}

#[test]
fn hostile_names_are_text() {
    let hostile = "</script><script>alert(1)</script>\"><img src=http://evil.example/x onerror='alert(1)'>&amp;`|*_\u{0}";
    let mut hostile_section = timed(section(SPHERE, hostile), &[], 1.1);
    hostile_section.caption.description = hostile.to_owned();
    for row in hostile_section
        .data
        .rows
        .iter_mut()
        .chain(&mut hostile_section.data.barycentric)
    {
        row.variant = format!("{hostile}{}", row.variant);
    }
    let mut hostile_report = report(vec![hostile_section]);
    hostile_report.command_line = vec![hostile.to_owned()];
    hostile_report.machine.cpu = hostile.to_owned();
    let html = hostile_report.html();
    assert_balanced(&html);
    assert_eq!(
        html.matches("<script").count(),
        2,
        "the data and the one of the page"
    );
    assert!(!html.contains("<img src=http") && html.contains("&lt;img src=http"));
    let markdown = hostile_report.markdown("images");
    // What stands between backticks is shown as it is.
    let unescaped = markdown.text.replace("\\`", "");
    assert!(
        unescaped
            .split('`')
            .step_by(2)
            .all(|text| !text.contains("<script") && !text.contains("<img"))
    );
    assert_tables_are_even(&markdown.text);
    for image in &markdown.images {
        assert!(
            image
                .name
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "-.".contains(c)),
            "{}",
            image.name
        );
    }
}

#[test]
fn nothing_is_loaded() {
    let html = report(vec![timed(section(SPHERE, "sphere"), &[], 1.1)]).html();
    let mut rest = html.as_str();
    for attribute in ["src=\"", "href=\"", "url("] {
        while let Some(at) = rest.find(attribute) {
            rest = &rest[at + attribute.len()..];
            assert!(
                rest.starts_with("data:") || rest.starts_with('#'),
                "{attribute}{}",
                &rest[..40]
            );
        }
        rest = &html;
    }
    for loader in [
        "@import",
        "<iframe",
        "<object",
        "<embed",
        "<base",
        "fetch(",
        "XMLHttpRequest",
        "import(",
        "srcset",
    ] {
        assert!(!html.contains(loader), "{loader}");
    }
    assert!(!html.contains("http://") && !html.contains("https://"));
    assert!(html.contains("default-src 'none'"));
}

#[test]
fn the_data_in_the_page_are_a_benchmark_document() {
    let first = timed(section(SPHERE, "a < b"), &[("gouraud", 1.0)], 1.1);
    let page = report(vec![first.clone(), section("triangle", "three")]);
    let html = page.html();
    let data = script_data(&html);
    let document = Document::parse(data).unwrap();
    assert_eq!(document.comparisons[0], first.data);
    assert_eq!(
        (
            document.comparisons.len(),
            document.machine,
            document.command_line.len()
        ),
        (2, machine(), 3)
    );
    let value: serde_json::Value = serde_json::from_str(data).unwrap();
    assert_eq!(value["comparisons"][0]["title"], "a < b");
    assert!(
        value["comparisons"][0]["triangulation"]["difference"]["max"]
            .as_f64()
            .unwrap()
            > 0.0
    );
    assert!(value["comparisons"][1]["triangulation"].is_null());
}

#[test]
fn numbers_of_charts_are_finite_whatever_was_measured() {
    let mut odd = timed(
        section(SPHERE, "odd"),
        &[("flat", 1e-9), ("gouraud", 1e9), ("fast-phong", 4.0)],
        1.0,
    );
    for (i, row) in odd.data.rows.iter_mut().enumerate() {
        row.error.difference.rms = if i % 2 == 0 { 0.0 } else { 1e-12 };
    }
    let html = report(vec![
        odd.clone(),
        timed(section("triangle", "one"), &[], 1.0),
    ])
    .html();
    assert_eq!(html.matches("<svg").count(), 5);
    for svg in html
        .split("<svg")
        .skip(1)
        .map(|rest| &rest[..rest.find("</svg>").unwrap()])
    {
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        let numbers = svg
            .split([' ', '"', ',', '(', ')', 'M', 'H', 'v'])
            .filter_map(|word| word.parse::<f64>().ok());
        let mut count = 0;
        for number in numbers {
            assert!(
                (-400.0..=1000.0).contains(&number) || svg.contains(&format!(">{number}<")),
                "{number} in {svg}"
            );
            count += 1;
        }
        assert!(count > 20);
    }
}

#[test]
fn a_small_report_is_small() {
    // Thirteen pictures of 40 × 30 texels of 4 bytes, in base64, are 83 kB before compression; the rest is text.
    let sphere = timed(section(SPHERE, "sphere"), &[], 1.1);
    let one = report(vec![sphere.clone()]).html().len();
    let two = report(vec![sphere.clone(), sphere]).html().len();
    assert!(two - one < 83_000, "{} bytes a scene", two - one);
    assert!(one < 160_000, "{one} bytes");
}

fn said(sections: &[Section]) -> String {
    opening(sections, &machine()).join(" ")
}

#[test]
fn the_opening_says_what_was_measured() {
    let sphere = section(SPHERE, "sphere");
    let both = |fast, slerp, spread| {
        timed(
            sphere.clone(),
            &[("fast-phong", fast), ("slerp-phong", slerp)],
            spread,
        )
    };
    let wins = said(&[both(2.0, 8.0, 1.1), both(2.5, 7.0, 1.1)]);
    assert!(
        wins.contains(
            "Fast Phong shading beats naive Phong shading here: it is faster in all 2 scenes"
        ),
        "{wins}"
    );
    assert!(
        wins.contains(
            "1.79 times as fast by the geometric mean, from 1.60 (sphere) to 2.00 (sphere)"
        ),
        "{wins}"
    );
    assert!(
        wins.contains(
            "Slerp Phong shading does not beat naive Phong shading here: it is slower in all 2"
        ),
        "{wins}"
    );
    let swapped = said(&[both(8.0, 2.0, 1.1), both(7.0, 2.5, 1.1)]);
    assert!(
        swapped.contains("Fast Phong shading does not beat"),
        "{swapped}"
    );
    assert!(swapped.contains("Slerp Phong shading beats"), "{swapped}");
    let ties = said(&[both(4.1, 3.9, 1.1), both(4.1, 4.0, 1.1)]);
    assert!(
        ties.contains(
            "Fast Phong shading cannot be told from naive Phong shading by its speed here"
        ),
        "{ties}"
    );
    let mixed = said(&[
        both(2.0, 4.0, 1.1),
        both(8.0, 4.0, 1.1),
        both(4.0, 4.0, 1.1),
    ]);
    assert!(
        mixed.contains("neither clearly beats naive Phong shading here nor clearly loses to it"),
        "{mixed}"
    );
    assert!(
        mixed.contains("of 3 scenes it is faster in 1, slower in 1 and level in 1"),
        "{mixed}"
    );
    let alone = said(&[both(2.0, 4.0, 1.1)]);
    assert!(
        alone.contains("it is faster in the one scene compared, 2.00 times as fast."),
        "{alone}"
    );
    let untimed = said(core::slice::from_ref(&sphere));
    assert_eq!(
        untimed,
        "No times were taken: this report tells of errors only."
    );
    let debug = Machine {
        profile: "debug".into(),
        ..machine()
    };
    assert!(
        opening(&[both(2.0, 2.0, 1.1)], &debug)
            .last()
            .unwrap()
            .contains("without optimisation")
    );
}

#[test]
fn tallies_count_and_average() {
    let sphere = section(SPHERE, "sphere");
    let of = |ms, spread| timed(sphere.clone(), &[("fast-phong", ms)], spread);
    let sections = [of(1.0, 1.1), of(8.0, 1.1), of(8.0, 3.0)];
    let tally = Tally::of("fast-phong", &sections).unwrap();
    assert_eq!(
        (tally.faster, tally.slower, tally.ties, tally.scenes()),
        (1, 1, 1, 3)
    );
    // Ratios of 4, 1/2 and 1/2: their product is 1.
    assert!((tally.mean - 1.0).abs() < 1e-12 && tally.best.0 == 4.0 && tally.worst.0 == 0.5);
    assert!(Tally::of("no-such-method", &sections).is_none());
    let all = overall(&sections);
    assert_eq!(
        all.len(),
        sphere.data.rows.len() + sphere.data.barycentric.len()
    );
    let fast = all.iter().find(|o| o.name == "fast-phong").unwrap();
    assert!((fast.time - 1.0).abs() < 1e-12);
    assert!(
        (fast.rms - sphere.row("fast-phong").unwrap().error.difference.rms).abs() < 1e-15,
        "equal errors"
    );
    assert!(
        overall(&[of(1.0, 1.1), sphere]).is_empty(),
        "one scene was not timed"
    );
}

#[test]
fn figures_belong_to_their_rows() {
    let (comparison, section) = compared(SPHERE, "sphere");
    for (row, figure) in comparison.rows.iter().zip(&section.figures[1..]) {
        let png = if figure.is_overlay {
            let below = crate::picture::encoding::store(&comparison.reference, comparison.encoding);
            encode::overlay(&below, &row.picture)
        } else {
            encode::opaque(&row.picture)
        };
        assert_eq!(figure.picture, png.unwrap(), "{}", row.name());
        assert!(figure.map.is_some());
    }
    assert_eq!(
        section.figures.len(),
        comparison.rows.len() + 2,
        "the reference and the triangles"
    );
    let naive = METHODS
        .iter()
        .position(|entry| entry.info.name == "naive-phong")
        .unwrap();
    assert!(
        section.figures[1 + naive].is_overlay,
        "it hardly differs from the reference"
    );
}

#[test]
fn the_markdown_shows_the_methods_of_the_project_and_names_its_pictures() {
    let sections = vec![
        timed(section(SPHERE, "my scene"), &[("fast-phong", 2.0)], 1.1),
        section("triangle", "three"),
    ];
    let markdown = report(sections).markdown("pictures");
    assert_eq!(
        markdown.images.len(),
        2 * 5,
        "the reference and four methods"
    );
    for image in &markdown.images {
        assert!(
            markdown
                .text
                .contains(&format!("(pictures/{})", image.name)),
            "{}",
            image.name
        );
        assert!(image.png.starts_with(b"\x89PNG"));
    }
    assert!(
        markdown.text.contains("2.00 (1.82–2.20)"),
        "{}",
        markdown.text
    );
    for entry in METHODS {
        assert!(
            markdown.text.contains(&format!("| {} | ", entry.info.name)),
            "{}",
            entry.info.name
        );
    }
    assert_tables_are_even(&markdown.text);
}

#[test]
fn a_report_of_nothing_and_of_an_empty_frame_is_a_page() {
    assert_balanced(&report(vec![]).html());
    let frame = crate::frame::FrameBuilder::new(16, 16).finish().unwrap();
    let comparison = compare(
        &Input {
            name: "empty".into(),
            frame: &frame,
        },
        &[METHODS[0].variant()],
        &Options {
            timing: None,
            ..Options::default()
        },
        &mut |_, _| {},
    );
    let section = Section::new(Caption::default(), &comparison, None, Detail::Full).unwrap();
    let html = report(vec![section.clone()]).html();
    assert_balanced(&html);
    assert!(html.contains("equal to the reference"));
    assert!(
        report(vec![timed(section, &[], 1.0)])
            .html()
            .contains("0 pixels (0.0 %) covered")
    );
}

#[test]
fn commands_can_be_typed_again() {
    let words = ["fastphong", "it's", "", "a=b:c,d"].map(String::from);
    assert_eq!(html::command(&words), r"fastphong 'it'\''s' '' a=b:c,d");
    assert_eq!(
        [1, 2, 1_234_567].map(|n| sentences::count(n, "pixel").to_string()),
        ["1 pixel", "2 pixels", "1,234,567 pixels"]
    );
}

/// A figure of which every text is `text`, with one picture.
fn lecture_figure(text: &str) -> LectureFigure {
    use crate::lectures::{Agreement, Content, FIGURES, Finding, Plot, Scale, Series, Shown};
    let mut content = Content::default();
    content.text(text);
    content.pictures(
        2,
        vec![Shown::new(
            text,
            text,
            crate::picture::Picture8::new(4, 3, [9; 4]),
        )],
    );
    let axis = || (text.to_owned(), Scale::Linear);
    let series = vec![Series::new(text, [(0.0, 1.0), (1.0, 2.0)])];
    let plot = Plot {
        title: text.into(),
        x: axis(),
        y: axis(),
        series,
        marks: vec![],
        caption: text.into(),
    };
    content.plot(plot);
    content.table(&[text], vec![vec![text.to_owned()]]);
    content.found(Finding::new(
        text,
        text,
        (0.5, "levels"),
        Agreement::Contradicts,
        text,
    ));
    LectureFigure::new(FIGURES[0], content).expect("a picture of twelve pixels")
}

#[test]
fn figures_of_the_lecture_are_text_pictures_and_data() {
    let hostile = "</script><script>alert(1)</script>\"><img src=http://evil.example/x onerror='alert(1)'>&amp;";
    let figure = lecture_figure(hostile);
    let name = figure.figure.name;
    let alone = figures_page(core::slice::from_ref(&figure), &[hostile.to_owned()]);
    let mut whole = report(vec![section(SPHERE, "sphere")]);
    whole.lecture = vec![figure];
    let whole = whole.html();
    for html in [&alone, &whole] {
        assert_balanced(html);
        assert!(!html.contains("<img src=http") && html.contains("&lt;img src=http"));
        assert_eq!(
            html.matches(&format!("<article id=\"figure-{name}\""))
                .count(),
            1
        );
        let data: serde_json::Value = serde_json::from_str(script_data(html)).expect("JSON");
        let finding = &data["figures"][0]["findings"][0];
        assert_eq!(
            (finding["key"].as_str(), finding["value"].as_f64()),
            (Some(hostile), Some(0.5))
        );
        assert_eq!(finding["agreement"], "contradicts");
        assert!(html.contains("<td class=\"contradicts\">contradicts</td>"));
    }
    assert_eq!(
        (
            alone.matches("<script").count(),
            whole.matches("<script").count()
        ),
        (1, 2)
    );
    assert!(whole.contains("<a href=\"#lecture\">"));
    // Pages without figures do not speak of them.
    assert!(!report(vec![]).html().contains("lecture-title"));
}
