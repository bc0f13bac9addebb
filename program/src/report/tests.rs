use super::document::{OLDER, SCHEMA, list, title, without_typical};
use super::*;
use crate::compare::comparison::{
    Input, MethodRow, Speed, WHAT_IS_COMPARED, WHAT_IS_TIMED, compare,
};
use crate::compare::experiments::{MethodSpeedups, SpeedCorner, Speedup, Speedups, Work};
use crate::compare::timing::{Noise, Ratio, Timing, Trust};
use crate::lectures::{FIGURES, FigureContent, Plot, Scale, Series};
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::vec;
use fastphong::mesh::builtin::builtin;
use fastphong::picture::Picture8;
use fastphong::raster::Renderer;
use fastphong::scene::Scene;
use fastphong::shading::{METHODS, Variant};

/// Draws a small mesh by all methods, without times.
fn scene(mesh: &str, name: &str) -> Comparison {
    let mut scene = Scene::of_mesh(builtin(mesh).unwrap());
    (scene.width, scene.height) = (40, 30);
    let frame = scene.frame().unwrap();
    let variants: Vec<_> = METHODS.iter().map(|entry| entry.variant()).collect();
    let input = Input {
        name: name.into(),
        frame: &frame,
    };
    let mut comparison = compare(&input, &variants, Renderer::LECTURE, None, &mut |_, _| {});
    comparison.title = name.to_owned();
    comparison.description = format!("What {name} tests.");
    comparison
}

const SPHERE: &str = "sphere?rings=4&segments=8";

fn document(scenes: &[(&str, &str)]) -> Document {
    let command = ["fastphong", "report", "a b"].map(String::from).to_vec();
    let scenes = scenes.iter().map(|(mesh, name)| scene(mesh, name));
    let mut document = Document::new(command, scenes.collect());
    document.machine.profile = "release".into();
    document
}

fn report(document: &Document) -> Report {
    let pictures = document.comparisons.iter().map(ScenePictures::new);
    Report::new(document, pictures.collect::<Result<_, _>>().unwrap()).unwrap()
}

fn ratio(median: f64, spread: f64) -> Ratio {
    Ratio::new(median / spread, median, median * spread)
}

/// Sets the speed and the error of a row in grey levels.
fn given(row: &mut MethodRow, of: &[(&str, f64, f64)]) {
    let known = of.iter().find(|(name, ..)| *name == row.name());
    let (_, speed, levels) = *known.unwrap_or(&("", 0.5, 40.0));
    row.error.max = levels / 255.0;
    row.speed = Some(Speed {
        timing: Timing::of(vec![4e6 / speed; 5], 1).unwrap(),
        ns_per_covered_pixel: Some(1.0),
        ratio_to_naive: Some(ratio(speed, 1.1)),
        ratio_to_barycentric: None,
        work_to_naive: None,
    });
}

fn study(of: &[(&str, u8, f64)]) -> Speedups {
    let corner = SpeedCorner {
        work: Work::Frame,
        scalar: false,
        level: "avx2",
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
        noise: Noise {
            trust: Trust::Quiet,
            clock: "thread",
            interrupted: 0.0,
            rounds: 5,
            cost_ns: 0.0,
            doubt: 0.02,
            sentence: "quiet".to_owned(),
        },
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
    let report = report(&document(&[(SPHERE, "sphere"), ("triangle", "three")]));
    let page = report.html();
    assert!(page.starts_with("<!doctype html>") && page.ends_with("</html>\n"));
    let data = parse(element(&page, "fastphong-data")).unwrap();
    assert_eq!(data["methods"], report.data["methods"]);
    let left_out = list(&data, "/comparisons/0/left_out").len();
    let drawn = METHODS.len() - left_out;
    assert_eq!(list(&data, "/methods").len(), drawn);
    assert_eq!(list(&data, "/comparisons").len(), 2);
    for index in 0..2 {
        let pictures: serde_json::Value =
            serde_json::from_str(element(&page, &format!("pictures-{index}"))).unwrap();
        let rows = pictures["rows"].as_object().unwrap();
        assert_eq!(rows.len(), drawn, "a picture a method");
    }
    for view in [
        "overview", "scenes", "methods", "speed", "lectures", "measured",
    ] {
        assert!(page.contains(&format!("<section class=\"view\" id=\"{view}\"")));
    }
}

#[test]
fn hostile_names_are_text() {
    let name = "</script><script>alert(1)</script>{{data}}";
    let mut document = document(&[(SPHERE, name)]);
    document.command_line.push(name.into());
    document.machine.cpu = "<img src=x onerror=alert(1)>".into();
    let report = report(&document);
    let page = report.html();
    assert!(!page.contains("<script>alert") && !page.contains("<img src=x"));
    let data = parse(element(&page, "fastphong-data")).unwrap();
    assert_eq!(title(&data["comparisons"][0]), name);
    let markdown = report.markdown("images").text;
    assert!(markdown.contains("## &lt;/script>&lt;script>alert"));
}

#[test]
fn nothing_is_loaded() {
    let page = report(&document(&[("triangle", "three")])).html();
    assert!(page.contains("default-src 'none'"));
    for loads in ["src=\"http", "href=\"http", "url(http", "@import", "fetch("] {
        assert!(!page.contains(loads), "the page holds {loads}");
    }
}

#[test]
fn the_page_is_readable_without_javascript() {
    let mut document = document(&[(SPHERE, "sphere"), ("triangle", "three")]);
    document.figures.push(figure());
    let page = report(&document).html();
    let inside = page
        .split("<noscript>")
        .nth(1)
        .unwrap()
        .split("</noscript>")
        .next()
        .unwrap();
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

/// Every figure takes less than 200,000 bytes of the page.
#[test]
fn figures_take_little_of_the_page() {
    let mut document = document(&[]);
    let size = |document: &Document| {
        let page = report(document).html();
        // All live figures share one module, which does not count.
        let module = page.split("id=\"live-module\">").nth(1);
        page.len() - module.map_or(0, |rest| rest.find('<').expect("it ends"))
    };
    let bare = size(&document);
    for figure in FIGURES {
        let content = figure.make().expect("a figure");
        document.figures.push(FigureData { figure, content });
        let bytes = size(&document) - bare;
        assert!(bytes < 200_000, "{} takes {bytes} bytes", figure.name);
        document.figures.clear();
    }
}

fn figure() -> FigureData {
    let mut content = FigureContent::default();
    content.text("A <text>.");
    let picture = Picture8::new(4, 3, [9, 9, 9, 255]);
    content.pictures(2, "subject", [("caption", picture)]);
    let axes = [("x".into(), Scale::Linear), ("y".into(), Scale::Log)];
    let series = [Series::new("s", [(0.0, 1.0 / 3.0), (1.0, f64::NAN)])];
    content.plot(Plot::new("plot", axes, series, "caption").marked([0.5]));
    content.confirms(
        "key | label",
        (0.411504, "levels", true),
        "Exactly <right>.",
    );
    FigureData {
        figure: FIGURES[0],
        content,
    }
}

#[test]
fn figures_are_data_and_pictures() {
    let mut document = document(&[]);
    document.figures.push(figure());
    let report = report(&document);
    let page = report.html();
    let data: Value = serde_json::from_str(element(&page, "fastphong-data")).unwrap();
    let stored = &data["figures"][0];
    let expected = serde_json::to_value(figure().content).unwrap();
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
    let name = format!("{}-1.png", FIGURES[0].name);
    assert_eq!(report.figure_files().next().unwrap().0, name);
    assert!(page.contains("<p class=\"answer\">Of 1 statements measured, 1 are as printed"));
}

#[test]
fn markdown_and_csv_hold_every_table() {
    let mut document = document(&[(SPHERE, "a|b")]);
    document.speedups = Some(study(&[("naive-phong", 0, 1.0)]));
    let report = report(&document);
    let markdown = report.markdown("images");
    for text in [
        "# Shading methods compared\n\n- **The picture:** ",
        "- **Scalar code:** No times were taken. On a quiet ",
        "40 × 30 pixels, ",
        " in view, 1 light, ",
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

fn timed(comparison: &mut Comparison) {
    for row in &mut comparison.rows {
        given(row, &[]);
        row.speed.as_mut().unwrap().ratio_to_barycentric = Some(ratio(2.0, 1.1));
    }
}

/// Returns a timed document with an experiment and a figure as JSON.
fn whole() -> Value {
    let mut document = document(&[(SPHERE, "sphere")]);
    timed(&mut document.comparisons[0]);
    document.speedups = Some(study(&[("naive-phong", 0, 1.0)]));
    document.comparisons[0].noise = document.speedups.as_ref().map(|of| of.noise.clone());
    document.figures.push(figure());
    serde_json::from_str(&document.to_text()).unwrap()
}

/// Returns the same document as JSON of an older schema.
fn older(schema: &str) -> Value {
    let mut older = whole();
    without_typical(&mut older);
    older["schema"] = schema.into();
    older
}

#[test]
fn documents_come_back_as_they_went() {
    let mut document = document(&[("prism", "a \"prism\"\n")]);
    timed(&mut document.comparisons[0]);
    document.speedups = Some(study(&[("naive-phong", 0, 1.0)]));
    let text = document.to_text();
    assert!(text.starts_with("{\n  \"schema\": \"fastphong.bench/3\",\n"));
    let read = Report::read(text.clone()).unwrap();
    assert_eq!((&read.text, &read.data), (&text, &report(&document).data));
    let rows = list(&read.data, "/comparisons/0/rows");
    let named = |name: &str| rows.iter().find(|row| row["variant"] == name).unwrap();
    let row = named("fast-phong");
    assert_eq!(
        (&row["parameters"]["steps"], &row["model"], &row["engine"]),
        (&json!("auto"), &json!("phong-constant"), &json!("span"))
    );
    assert_eq!(
        (&row["method"], &row["threads"]),
        (&json!("fast-phong"), &json!(1))
    );
    assert!(row["speed"]["ratio_to_naive"]["tie"].is_boolean());
    assert!(row["error"]["psnr"].is_f64() && row["error"]["equal"] == false);
    assert_eq!(list(row, "/speed/timing/samples_ns").len(), 5);
}

#[test]
fn parameters_are_numbers_or_auto() {
    let steps = |text: &str| {
        let variant = Variant::parse(text).unwrap();
        let row = MethodRow {
            variant,
            ..scene("triangle", "t").rows.remove(0)
        };
        let json = serde_json::to_value(row).unwrap();
        (json["variant"].clone(), json["parameters"]["steps"].clone())
    };
    assert_eq!(
        steps("fast-phong:steps=3"),
        ("fast-phong:steps=3".into(), 3.into())
    );
    assert_eq!(
        steps("fast-phong:steps=auto"),
        ("fast-phong".into(), "auto".into())
    );
}

#[test]
fn the_description_names_every_field() {
    let description = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/bench-json.md");
    let description = std::fs::read_to_string(description).expect("the page");
    let document = whole();
    let mut left = vec![&document];
    let mut fields = 0;
    while let Some(value) = left.pop() {
        for (field, value) in value.as_object().into_iter().flatten() {
            let is_named = [
                "`",
                "`timing.",
                "[].",
                "`findings[].",
                "`triangulation.",
                "`clamping.",
            ]
            .iter()
            .any(|before| description.contains(&format!("{before}{field}`")));
            // One sentence describes the blocks of figures. Methods name their parameters.
            assert!(is_named || field == "timing", "`{field}` is not described");
            fields += 1;
            if !["blocks", "parameters"].contains(&&**field) {
                left.push(value);
            }
        }
        left.extend(value.as_array().into_iter().flatten());
    }
    assert!(fields > 80, "all levels were visited: {fields}");
    for text in [WHAT_IS_TIMED, WHAT_IS_COMPARED] {
        let last = text.rsplit([',', ';']).next().unwrap();
        assert!(description.contains(last.trim()), "{text}");
    }
}

/// The reader requires every field that views need, with its type.
#[test]
fn every_field_that_is_read_is_needed_unless_marked() {
    let whole = whole();
    let message = |data: &Value| parse(&data.to_string()).unwrap_err().to_string();
    for (pointer, field) in [
        ("", "machine"),
        ("/machine", "cpu"),
        ("/comparisons/0", "rows"),
        ("/comparisons/0/rows/0/error", "max"),
        ("/comparisons/0/rows/0/speed/timing", "typical_ns"),
        ("/comparisons/0/rows/0/speed/ratio_to_naive", "typical"),
        ("/comparisons/0/noise", "trust"),
        ("/speedups/noise", "sentence"),
    ] {
        let mut lacks = whole.clone();
        let parent = lacks.pointer_mut(pointer).unwrap();
        parent.as_object_mut().unwrap().remove(field).unwrap();
        let missing = format!("missing field `{field}`: expected a document of schema");
        assert!(message(&lacks).contains(&missing), "{}", message(&lacks));
        let mut other = whole.clone();
        other.pointer_mut(pointer).unwrap()[field] = json!(true);
        assert!(message(&other).contains(&format!("{field}: expected a")));
    }
    let mut without = whole.clone();
    without["comparisons"][0]["rows"][0]["speed"] = Value::Null;
    without["comparisons"][0]["noise"] = Value::Null;
    assert!(parse(&without.to_string()).is_ok(), "no times were taken");
    // Older documents are checked for their own fields.
    let mut older = older(OLDER[0].0);
    assert!(parse(&older.to_string()).is_ok());
    let ratio = &mut older["comparisons"][0]["rows"][0]["speed"]["ratio_to_naive"];
    *ratio = json!({ "typical": 1.0, "low": 1.0, "high": 1.0, "tie": true });
    assert!(message(&older).contains("ratio_to_naive: missing field `median`"));
}

#[test]
fn texts_that_are_no_documents_are_refused() {
    let message = |text: &str| parse(text).unwrap_err().to_string();
    assert_eq!(message("{}"), "no `schema`: expected `fastphong.bench/3`");
    assert_eq!(message("[]"), "no `schema`: expected `fastphong.bench/3`");
    for other in [
        "fastphong.bench/4",
        "fastphong.bench/0",
        "fastphong.frame-times/2",
    ] {
        assert_eq!(
            message(&format!("{{\"schema\": \"{other}\"}}")),
            format!(
                "schema `{other}`: expected `fastphong.bench/3`, or the older `fastphong.bench/2` or `fastphong.bench/1`"
            )
        );
    }
    for schema in [SCHEMA, OLDER[0].0, OLDER[1].0] {
        assert!(message(&format!("{{\"schema\": \"{schema}\"}}")).contains("missing field"));
    }
    assert!(message("{\n]").contains("line 2 column 1"));
    assert!(message("").contains("fastphong.bench/3"));
    // Lists deeper than in any document, and numbers that JSON does not have.
    assert!(message(&"[".repeat(100_000)).contains("recursion limit exceeded at line 1"));
    assert!(message("{\"seconds\": NaN}").contains("expected value at line 1 column"));
    assert!(message("{\"seconds\": 1e999}").contains("number out of range at line 1 column"));
}

/// A field with another kind of value, or with a number out of range, is reported with its place.
#[test]
fn values_of_another_kind_are_told_with_their_place() {
    let whole = whole();
    for (pointer, value, told) in [
        (
            "/comparisons",
            json!({}),
            "the document, comparisons: expected a list",
        ),
        (
            "/comparisons/0",
            json!("x"),
            "the document, comparisons 0: expected an object",
        ),
        (
            "/comparisons/0/name",
            json!(7),
            "comparisons 0, name: expected a text",
        ),
        (
            "/comparisons/0/width",
            json!("48"),
            "comparisons 0, width: expected a number",
        ),
        (
            "/comparisons/0/width",
            json!(-48),
            "comparisons 0, width: expected a whole number from 0",
        ),
        (
            "/comparisons/0/height",
            json!(3.5),
            "comparisons 0, height: expected a whole number from 0",
        ),
        (
            "/comparisons/0/rows/1/error/rms",
            json!("NaN"),
            "rows 1, error, rms: expected a number",
        ),
        (
            "/comparisons/0/rows/1/error/max",
            json!(-1.0),
            "rows 1, error, max: expected a number from 0",
        ),
        (
            "/comparisons/0/rows/0/within_bound",
            json!(1),
            "within_bound: expected true or false",
        ),
        (
            "/comparisons/0/rows/0/speed/timing/samples_ns/2",
            json!(null),
            "samples_ns 2: expected a number",
        ),
        (
            "/methods/0/operations/0/walk",
            json!("none"),
            "operations 0, walk: expected a list",
        ),
        (
            "/speedups/methods/0/corners/0",
            json!([]),
            "methods 0, corners 0: expected an object",
        ),
    ] {
        let mut other = whole.clone();
        *other.pointer_mut(pointer).expect(pointer) = value;
        let message = parse(&other.to_string()).unwrap_err().to_string();
        assert!(message.contains(told), "{message}");
        assert!(message.ends_with(": expected a document of schema `fastphong.bench/3`"));
    }
    assert!(
        parse(&format!("\u{FEFF}{whole}")).is_ok(),
        "a mark of the encoding"
    );
}

/// Values of the oldest documents that mean something else today are removed, and the report says
/// so. All others stay.
#[test]
fn older_documents_lose_the_numbers_that_changed_their_meaning() {
    let newer = Report::read(whole().to_string()).unwrap();
    let mut older = Report::read(older(OLDER[1].0).to_string()).unwrap();
    assert_eq!(newer.not_comparable(), None);
    let said = older.not_comparable().expect("an older document");
    assert!(
        said.starts_with(
            "schema fastphong.bench/1: errors of the row engine, bounds, SSIM and FLIP cannot"
        ),
        "{said}"
    );
    for field in ["bound", "within_bound", "error/ssim", "error/flip"] {
        let at = format!("/comparisons/0/rows/0/{field}");
        assert!(
            older.data.pointer(&at).is_some_and(Value::is_null),
            "{field}"
        );
    }
    for field in ["error/max", "error/psnr", "other_polygon"] {
        let at = format!("/comparisons/0/rows/1/{field}");
        assert_eq!(older.data.pointer(&at), newer.data.pointer(&at), "{field}");
    }
    let remark = "Of documents of schema fastphong.bench/1: errors of the row engine";
    for text in [older.html(), older.markdown("images").text] {
        assert!(text.contains(remark), "{text}");
    }
    assert!(!newer.html().contains(remark));
    let mut both = newer.clone();
    both.lay_beside(older.clone());
    assert!(both.html().contains(remark), "also where it lies beside");
    older.lay_beside(newer);
    assert!(older.html().contains(remark));
}

/// Speeds of documents that state no noise are shown, with a note on what they are.
#[test]
fn speeds_of_documents_with_medians_are_shown_with_a_note() {
    let timing = json!({ "median_ns": 4e6, "min_ns": 2e6, "p25_ns": 3e6, "p75_ns": 5e6 });
    let median = json!({ "median": 1.25, "low": 1.23, "high": 1.27, "tie": false });
    let mut data = older("fastphong.bench/2");
    data["comparisons"][0]["noise"] = Value::Null;
    for row in data["comparisons"][0]["rows"].as_array_mut().unwrap() {
        row["error"]["max"] = json!(if row["variant"] == "duff-phong" {
            0.0
        } else {
            0.5
        });
        row["speed"] = json!({ "timing": timing, "ratio_to_naive": median });
    }
    let read = Report::read(data.to_string()).unwrap();
    let speed = &read.data["comparisons"][0]["rows"][0]["speed"];
    for (field, value) in [("typical_ns", 4e6), ("low_ns", 3e6), ("high_ns", 5e6)] {
        assert_eq!(speed["timing"][field], value, "{field}");
    }
    assert_eq!(speed["ratio_to_naive"]["typical"], 1.25);
    let told = "schema fastphong.bench/2: speeds are medians of time passed, which a busy machine spoils; errors can be compared";
    assert_eq!(read.not_comparable().as_deref(), Some(told));
    let markdown = read.markdown("images").text.replace('\u{A0}', " ");
    for text in ["use Duff Phong. It is 1.25 × (1.23 to 1.27)", told] {
        assert!(markdown.contains(text), "{text}: {markdown}");
    }
    let html = read.html();
    let note = format!("<p class=\"remarks\">Of documents of {told}.</p>");
    assert!(html.contains(&note));
    // The page's data can be read again.
    let page = parse(element(&html, "fastphong-data")).unwrap();
    assert_eq!(
        page["comparisons"][0]["rows"][0]["speed"]["ratio_to_naive"]["typical"],
        1.25
    );
}
