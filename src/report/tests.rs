use super::answer::{answer, html, overall};
use super::*;
use crate::compare::comparison::{Input, Options, RowData, Speed, compare, parse, triangulation};
use crate::compare::experiments::{Corner, MethodSpeedups, Speedup, Speedups, Work};
use crate::compare::timing::{Machine, Ratio, Timing};
use crate::lectures::{FigureContent, Plot, Scale, Series};
use crate::mesh::builtin::builtin;
use crate::picture::Picture8;
use crate::scene::Scene;
use crate::shading::METHODS;
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::vec;

/// Draws a small mesh by all methods, without times.
fn scene(mesh: &str, name: &str) -> (SceneData, ScenePictures) {
    let mut scene = Scene::of_mesh(builtin(mesh).unwrap());
    (scene.width, scene.height) = (40, 30);
    let frame = scene.frame().unwrap();
    let variants: Vec<_> = METHODS.iter().map(|entry| entry.variant()).collect();
    let input = Input {
        name: name.into(),
        frame: &frame,
    };
    let options = Options {
        timing: None,
        ..Options::default()
    };
    let comparison = compare(&input, &variants, &options, &mut |_, _| {});
    let triangles = triangulation(&frame, &comparison.reference);
    let about = format!("What {name} tests.");
    (
        SceneData::new(name.to_owned(), about, &comparison, triangles.as_ref()),
        ScenePictures::new(&comparison).unwrap(),
    )
}

const SPHERE: &str = "sphere?rings=4&segments=8";

fn empty() -> Report {
    let machine = Machine {
        profile: "release".into(),
        ..Machine::this()
    };
    let command = ["fastphong", "report", "a b"].map(String::from).to_vec();
    Report::new(Document::new(machine, command))
}

fn report(scenes: &[(&str, &str)]) -> Report {
    let mut report = empty();
    for (mesh, name) in scenes {
        let (data, pictures) = scene(mesh, name);
        report.add_scene(data, pictures);
    }
    report.data.describe_methods();
    report
}

fn ratio(median: f64, spread: f64) -> Ratio {
    Ratio {
        median,
        low: median / spread,
        high: median * spread,
    }
}

/// Gives each row a speed and an error in grey levels.
fn given(row: &mut RowData, of: &[(&str, f64, f64)]) {
    let known = of.iter().find(|(name, ..)| *name == row.variant);
    let (_, speed, levels) = *known.unwrap_or(&("", 0.5, 40.0));
    row.error.max = levels / 255.0;
    row.speed = Some(Speed {
        timing: Timing::of(vec![4e6 / speed; 5], 1).unwrap(),
        ns_per_covered_pixel: Some(1.0),
        ratio_to_naive: Some(ratio(speed, 1.1)),
        ratio_to_barycentric: None,
    });
}

/// Says the answer of one scene with made-up numbers.
fn said(of: &[(&str, f64, f64)], study: Option<Speedups>) -> String {
    let mut report = report(&[(SPHERE, "sphere")]);
    let rows = &mut report.data.comparisons[0].comparison.rows;
    rows.iter_mut().for_each(|row| given(row, of));
    report.data.speedups = study;
    answer::markdown(&answer(&report.data))
}

fn study(of: &[(&str, u8, f64)]) -> Speedups {
    let corner = Corner {
        work: Work::Frame,
        scalar: false,
        level: "avx2".into(),
        lights: 1,
    };
    let method = |(name, levels_off, speed): &(&str, u8, f64)| MethodSpeedups {
        method: (*name).to_owned(),
        levels_off: *levels_off,
        corners: vec![Speedup {
            timing: Timing::of(vec![1e6; 5], 1).unwrap(),
            ratio_to_naive: Some(ratio(*speed, 1.02)),
        }],
    };
    Speedups {
        mesh: "builtin:<sphere>".into(),
        size: [64, 48],
        span: 64,
        corners: vec![corner],
        methods: of.iter().map(method).collect(),
    }
}

/// Returns the text of the element with this id.
fn element<'a>(html: &'a str, id: &str) -> &'a str {
    let start = format!("id=\"{id}\">");
    let text = &html[html.find(&start).unwrap() + start.len()..];
    &text[..text.find("</script>").unwrap()]
}

#[test]
fn the_page_holds_its_data_and_its_pictures() {
    let report = report(&[(SPHERE, "sphere"), ("triangle", "three")]);
    let page = report.html();
    assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
    let data: Document = parse(element(&page, "fastphong-data")).unwrap();
    assert_eq!(data.methods, report.data.methods);
    assert_eq!(data.methods.len(), METHODS.len());
    assert_eq!(data.comparisons.len(), 2);
    for number in 0..2 {
        let pictures: serde_json::Value =
            serde_json::from_str(element(&page, &format!("pictures-{number}"))).unwrap();
        let rows = pictures["rows"].as_object().unwrap();
        assert_eq!(rows.len(), METHODS.len(), "a picture a method");
    }
    for view in [
        "overview", "scenes", "methods", "speed", "lectures", "measured",
    ] {
        assert!(page.contains(&format!("<section class=\"view\" id=\"{view}\"")));
    }
}

#[test]
fn a_document_comes_back_from_its_text() {
    let mut report = report(&[(SPHERE, "sphere")]);
    report.data.speedups = Some(study(&[("naive-phong", 0, 1.0)]));
    let back: Document = parse(&report.data.to_text()).unwrap();
    assert_eq!(back, report.data);
}

#[test]
fn hostile_names_are_text() {
    let name = "</script><script>alert(1)</script>{{data}}";
    let mut report = report(&[(SPHERE, name)]);
    report.data.command_line.push(name.into());
    report.data.machine.cpu = "<img src=x onerror=alert(1)>".into();
    let page = report.html();
    assert!(!page.contains("<script>alert") && !page.contains("<img src=x"));
    let data: Document = parse(element(&page, "fastphong-data")).unwrap();
    assert_eq!(data.comparisons[0].title(), name);
    let markdown = report.markdown("images").text;
    assert!(markdown.contains("## &lt;/script>&lt;script>alert"));
}

#[test]
fn nothing_is_loaded() {
    let page = report(&[("triangle", "three")]).html();
    assert!(page.contains("default-src 'none'"));
    for loads in ["src=\"http", "href=\"http", "url(http", "@import", "fetch("] {
        assert!(!page.contains(loads), "the page holds {loads}");
    }
}

#[test]
fn the_page_is_readable_without_javascript() {
    let mut report = report(&[(SPHERE, "sphere"), ("triangle", "three")]);
    report.add_figure(METHOD_FIGURE, figure()).unwrap();
    let page = report.html();
    let inside = page.split("<noscript>").nth(1).unwrap();
    let inside = inside.split("</noscript>").next().unwrap();
    assert!(inside.contains("<img src=\"data:image/png;base64,"));
    for text in [
        "fast Phong rsqrt",
        "three</summary>",
        "Exactly &lt;right&gt;.",
    ] {
        assert!(inside.contains(text), "{text}");
    }
    assert!(!inside.contains("<script"));
}

static METHOD_FIGURE: &crate::lectures::Figure = crate::lectures::FIGURES[0];

fn figure() -> FigureContent {
    let mut content = FigureContent::default();
    content.text("A <text>.");
    let picture = Picture8::new(4, 3, [9, 9, 9, 255]);
    content.pictures(2, "subject", [("caption", picture)]);
    let axes = [("x".into(), Scale::Linear), ("y".into(), Scale::Log)];
    let series = [Series::new("s", [(0.0, 1.0 / 3.0), (1.0, f64::NAN)])];
    content.plot(Plot::new("plot", axes, series, "caption").marked([0.5]));
    content.confirms(
        "key",
        "label",
        (0.411504, "levels", true),
        "Exactly <right>.",
    );
    content
}

#[test]
fn figures_are_data_and_pictures() {
    let mut report = empty();
    report.add_figure(METHOD_FIGURE, figure()).unwrap();
    let page = report.html();
    let data: serde_json::Value = serde_json::from_str(element(&page, "fastphong-data")).unwrap();
    let stored = &data["figures"][0];
    let expected = serde_json::to_value(figure()).unwrap();
    assert!(
        expected["findings"]
            .as_array()
            .is_some_and(|all| !all.is_empty())
    );
    assert_eq!(stored["findings"], expected["findings"]);
    let points = &stored["blocks"][2]["plot"]["series"][0]["points"];
    assert_eq!(points[0], serde_json::json!([0.0, 0.33333]), "five digits");
    let pictures = element(&page, "figure-pictures");
    assert!(pictures.contains("data:image/png;base64,"));
    let name = format!("{}-1.png", METHOD_FIGURE.name);
    assert_eq!(report.figure_files().next().unwrap().0, name);
    assert!(html(&answer(&report.data)).contains("1 are as printed"));
}

#[test]
fn the_answer_names_the_fastest_of_those_that_draw_the_picture() {
    let of = [
        ("naive-phong", 1.0, 0.1),
        ("gouraud", 5.0, 90.0),
        ("duff-phong", 1.25, 0.2),
        ("fast-phong", 1.1, 3.0),
        ("phong-rsqrt", 1.2, 0.1),
    ];
    assert_eq!(
        said(&of, None),
        "For naive Phong’s picture at the least time on this machine, use Duff Phong one pixel at a time (1.25\u{A0}× \
         naive Phong in this scene, never off by more than 0.20 grey levels); the lecture’s fast Phong reaches 1.10\u{A0}×."
    );
    let wide = study(&[
        ("phong-rsqrt", 1, 1.5),
        ("gouraud", 80, 9.0),
        ("fast-phong", 1, 0.8),
    ]);
    let text = said(&of, Some(wide));
    assert!(
        text.contains("and Phong rsqrt on AVX2 (1.50\u{A0}×);"),
        "{text}"
    );
    assert!(
        text.ends_with("reaches 1.10\u{A0}× and 0.80\u{A0}×."),
        "{text}"
    );
}

#[test]
fn the_answer_says_what_is_not_known() {
    let mut report = report(&[(SPHERE, "sphere")]);
    let text = answer::markdown(&answer(&report.data));
    assert!(
        text.starts_with("No times were taken. The largest error"),
        "{text}"
    );
    report.data.comparisons.clear();
    let text = answer::markdown(&answer(&report.data));
    assert_eq!(text, "Nothing was compared.");
    assert!(report.html().contains("Nothing was compared."));
}

#[test]
fn a_method_over_all_scenes_is_its_worst_error_and_mean_speed() {
    let mut report = report(&[(SPHERE, "sphere"), ("prism", "prism")]);
    let speeds = [(2.0, 0.5), (8.0, 0.25)];
    for (scene, (speed, levels)) in report.data.comparisons.iter_mut().zip(speeds) {
        let rows = &mut scene.comparison.rows;
        rows.iter_mut()
            .for_each(|row| given(row, &[("duff-phong", speed, levels)]));
    }
    let all = overall(&report.data.comparisons);
    let duff = all.iter().find(|o| o.name == "duff-phong").unwrap();
    assert_eq!((duff.worst, duff.at), (0.5, "sphere"));
    assert!((duff.speed.unwrap() - 4.0).abs() < 1e-12, "√(2 · 8)");
}

#[test]
fn markdown_and_csv_hold_every_table() {
    let mut report = report(&[(SPHERE, "a|b")]);
    report.data.speedups = Some(study(&[("naive-phong", 0, 1.0)]));
    let markdown = report.markdown("images");
    for text in [
        "# Shading methods compared\n",
        "Made by `fastphong report 'a b'`",
        "## a\\|b\n",
        "(images/01-a-b-reference.png)",
        "| fast Phong rsqrt |",
        "frame, avx2, 1 light",
        "## Operations",
    ] {
        assert!(markdown.text.contains(text), "{text}\n{}", markdown.text);
    }
    assert_eq!(markdown.images.len(), 1 + PROJECT.len());
    assert!(markdown.images[0].1.starts_with(b"\x89PNG"));
    assert!(report.csv().contains("\"a|b\"\r\nmethod,\"max, levels\""));
}
