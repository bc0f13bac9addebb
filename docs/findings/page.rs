//! Makes the generated parts of `README.md`, `docs/findings.md` and `report/README.md` from the
//! measurements of `docs/findings/run`: tables, sentences, charts and a picture of the worst cases.
//!
//! `tests/documents/findings.rs` writes them into the pages, or checks that the pages have them.

use crate::markdown::read;
use fastphong::picture::Picture8;
use fastphong::picture::image_file::encode_png;
use fastphong::raster::Renderer;
use fastphong::reference::{self, Model};
use fastphong::shading::{Family, METHODS, MethodRow, Tier, Variant};
use fastphong_cli::compare::experiments::WorstCase;
use fastphong_cli::compare::timing::Ratio;
use fastphong_cli::lectures::{Figure, FigureBlock, FigureContent, Panel};
use fastphong_cli::report::{MethodError, Summary, parse, sentences};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Degrees between neighbouring normals of the meshes.
pub const DEGREES: [u32; 4] = [5, 15, 30, 60];
/// The largest error, in levels, of a picture that passes for Phong's.
const SAME: f64 = 0.5;

const NAIVE: &str = "naive-phong";

pub fn data(name: &str) -> Value {
    serde_json::from_str(&read(format!("docs/findings/{name}.json"))).expect("JSON")
}

pub fn list<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of[key].as_array().expect("a list")
}

fn number(of: &Value) -> f64 {
    of.as_f64().expect("a number")
}

pub fn text(of: &Value) -> &str {
    of.as_str().expect("a text")
}

/// Values by the name of a method, one for each mesh.
type ByMethod = BTreeMap<String, [f64; 4]>;

/// The files of `bench` that `docs/findings/run` leaves in `target/findings`.
const TIMES: [&str; 7] = [
    "scalar-1",
    "scalar-4",
    "simd-1",
    "simd-4",
    "halfway-1",
    "positions-1",
    "positions-4",
];

/// Reads a document that `docs/findings/run` left in `target/findings`.
fn document(name: &str) -> Value {
    let document = parse(&read(format!("target/findings/{name}.json"))).expect("a document");
    let too_busy = |scene: &&Value| scene["noise"]["trust"] == "too-busy";
    let found = list(&document, "comparisons").iter().find(too_busy);
    assert_eq!(found, None, "{name}: measure again on a quiet machine");
    document
}

/// Extracts from the files of [`TIMES`] what the page needs, which is stored in
/// `docs/findings/times.json`. For each mesh: times of frames as multiples of naive Phong's, the
/// ends of the intervals of their speeds, naive Phong's time in milliseconds, and the largest
/// errors of the frames in levels.
pub fn condensed() -> Value {
    let of_file = |name: &str| {
        let document = document(name);
        let comparisons = list(&document, "comparisons");
        assert_eq!(comparisons.len(), DEGREES.len());
        let [mut times, mut low, mut high, mut levels] =
            [(); 4].map(|()| BTreeMap::<&str, Vec<f64>>::new());
        let mut naive = Vec::new();
        for row in comparisons
            .iter()
            .flat_map(|comparison| list(comparison, "rows"))
        {
            let (name, speed) = (text(&row["variant"]), &row["speed"]);
            let ratio = &speed["ratio_to_naive"];
            for (all, value) in [
                (&mut times, 1.0 / number(&ratio["typical"])),
                (&mut low, number(&ratio["low"])),
                (&mut high, number(&ratio["high"])),
                (&mut levels, 255.0 * number(&row["error"]["max"])),
            ] {
                all.entry(name).or_default().push(value);
            }
            if name == NAIVE {
                naive.push(number(&speed["timing"]["typical_ns"]) / 1e6);
            }
        }
        serde_json::json!({
            "command_line": document["command_line"], "machine": document["machine"],
            "level": comparisons[0]["renderer"]["level"], "naive_ms": naive, "times": times,
            "low": low, "high": high, "levels": levels,
        })
    };
    TIMES
        .map(|name| (name.to_string(), of_file(name)))
        .into_iter()
        .collect()
}

/// Summarises the report that `docs/findings/run` leaves in `target/findings`, for
/// `report/quiet.json`.
pub fn condensed_report() -> Summary {
    Summary::of(&document("report"))
}

/// Returns times of frames as multiples of naive Phong's.
fn times(name: &str) -> ByMethod {
    measured(name, "times")
}

/// Returns the measurement `key` of the frames of the file `name`: "times", "low" and "high", or
/// "levels".
fn measured(name: &str, key: &str) -> ByMethod {
    let document = data("times");
    let all = document[name][key].as_object().expect("an object");
    let row = |(method, all): (&String, &Value)| {
        let all: Vec<f64> = all.as_array().expect("a list").iter().map(number).collect();
        (
            method.clone(),
            all.try_into().expect("a value for each mesh"),
        )
    };
    all.iter().map(row).collect()
}

/// Returns the times of naive Phong's frames in milliseconds, one for each mesh.
fn naive(name: &str) -> Vec<f64> {
    list(&data("times")[name], "naive_ms")
        .iter()
        .map(number)
        .collect()
}

/// Returns the largest errors that the search found with this many lights, in levels.
fn errors(lights: u64) -> ByMethod {
    let document = data("search");
    let mut all = ByMethod::new();
    for case in list(&document, "cases") {
        let place = DEGREES
            .iter()
            .position(|d| f64::from(*d) == number(&case["degrees"]));
        if let (Some(place), true) = (place, case["lights"] == lights) {
            all.entry(text(&case["method"]).into()).or_insert([0.0; 4])[place] =
                number(&case["levels"]);
        }
    }
    // Normals are *up to* this many degrees apart, so a case that was found for a smaller angle
    // counts for the larger ones too.
    for errors in all.values_mut() {
        for i in 1..errors.len() {
            errors[i] = errors[i].max(errors[i - 1]);
        }
    }
    all
}

/// Returns, for each mesh, the speed of the fastest method that shades nothing at a pixel.
fn cheapest(speeds: &Speeds) -> [Ratio; 4] {
    let infos = METHODS.iter().map(|entry| entry.info);
    let colours = infos.filter(|info| info.family == Family::Colours);
    let all: Vec<_> = colours.filter_map(|info| speeds.get(info.name)).collect();
    [0, 1, 2, 3].map(|mesh| {
        let speeds = all.iter().map(|speeds| speeds[mesh]);
        let fastest = speeds.max_by(|a, b| a.typical.total_cmp(&b.typical));
        fastest.expect("some method")
    })
}

fn mean(ratios: impl Iterator<Item = f64>) -> f64 {
    let logarithms: Vec<f64> = ratios.map(f64::ln).collect();
    (logarithms.iter().sum::<f64>() / logarithms.len() as f64).exp()
}

/// Speeds as multiples of naive Phong's by the name of a method, one for each mesh.
type Speeds = BTreeMap<String, [Ratio; 4]>;

/// Returns the speeds of frames.
fn speeds(name: &str) -> Speeds {
    let [times, low, high] = ["times", "low", "high"].map(|key| measured(name, key));
    let of_mesh = |method: &str, mesh: usize| Ratio {
        typical: 1.0 / times[method][mesh],
        low: low[method][mesh],
        high: high[method][mesh],
        tie: false,
    };
    let methods = times.keys();
    methods
        .map(|method| {
            (
                method.clone(),
                [0, 1, 2, 3].map(|mesh| of_mesh(method, mesh)),
            )
        })
        .collect()
}

/// Returns how many times as fast a method is as the method `over`.
///
/// Relative deviations of independent factors add up as squares. These factors share naive Phong's
/// times, so that the interval is rather too wide.
fn quotient(method: Ratio, over: Ratio) -> Ratio {
    let typical = method.typical / over.typical;
    let wider = |one: f64, other: f64| one.ln().hypot(other.ln()).exp();
    Ratio {
        typical,
        low: typical / wider(method.typical / method.low, over.high / over.typical),
        high: typical * wider(method.high / method.typical, over.typical / over.low),
        tie: false,
    }
}

/// Returns how many times as fast a method is as the method `over`: the geometric mean over the
/// four meshes.
fn speed(speeds: &Speeds, method: &str, over: &str) -> Ratio {
    let quotients = [0, 1, 2, 3].map(|mesh| quotient(speeds[method][mesh], speeds[over][mesh]));
    Ratio::mean(&quotients)
}

/// Writes a speed with the digits that its interval separates, for a table.
fn known(speed: Ratio) -> String {
    speed.known().unwrap_or_else(|| "–".into())
}

/// Writes how many times as fast a method is as naive Phong, for a table.
fn gain(speeds: &Speeds, method: &str) -> String {
    known(speed(speeds, method, NAIVE))
}

/// True if the method is meant for use, not only as an exhibit.
fn is_for_use(name: &str) -> bool {
    MethodRow::named(name).is_some_and(|entry| entry.info.tier != Tier::Exhibit)
}

/// Returns the methods for use that no other beats in both time and error on a mesh, the fastest
/// first.
fn front(times: &ByMethod, errors: &ByMethod, mesh: usize) -> Vec<String> {
    let points = times
        .keys()
        .filter(|m| is_for_use(m))
        .filter_map(|m| Some((m.clone(), times[m][mesh], errors.get(m)?[mesh])));
    let mut points: Vec<_> = points.collect();
    points.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut least = f64::INFINITY;
    points.retain(|(_, _, error)| {
        // A hundredth of a level is no difference.
        let is_better = *error < 0.9 * least && least > 0.01;
        if is_better {
            least = *error;
        }
        is_better
    });
    points.into_iter().map(|(name, ..)| name).collect()
}

/// Formats a value for a table: two decimals below 10, none above.
fn short(x: f64) -> String {
    match x {
        x if x < 0.01 => "< 0.01".into(),
        x if x < 10.0 => format!("{x:.2}"),
        x => format!("{x:.0}"),
    }
}

/// Returns times and worst errors of the methods in integers. Times are cycles per pixel on a
/// Cortex-M0+, in spans of 32 pixels, as multiples of naive Phong's in the same integers.
fn small() -> [ByMethod; 2] {
    let document: Value = serde_json::from_str(&read("report/small.json")).expect("JSON");
    let spans = list(&document, "spans");
    let cycles = |span: &Value| number(&span["m0p_cycles"][1]);
    let naive = spans
        .iter()
        .find(|span| span["method"] == "naive")
        .map(cycles);
    let naive = naive.expect("naive Phong is measured");
    let [mut times, mut errors] = [ByMethod::new(), ByMethod::new()];
    for span in spans {
        let name = format!("integer-{}", text(&span["method"])).replace("-as-printed", "-printed");
        let worst: Vec<f64> = list(span, "worst_error").iter().map(number).collect();
        if let (Some(_), Ok(worst)) = (MethodRow::named(&name), worst.try_into()) {
            times.insert(name.clone(), [cycles(span) / naive; 4]);
            errors.insert(name, worst);
        }
    }
    [times, errors]
}

/// Returns the names of the methods, the fastest first.
fn fastest(times: &ByMethod) -> Vec<&str> {
    let mut names: Vec<_> = times.keys().map(String::as_str).collect();
    names.sort_by(|a, b| mean(times[*a].into_iter()).total_cmp(&mean(times[*b].into_iter())));
    names
}

/// Returns a table of a head and rows.
fn rows(head: &str, rows: impl IntoIterator<Item = String>) -> String {
    let rows = rows.into_iter().map(|row| format!("| {row} |\n"));
    format!("{head}\n{}", rows.collect::<String>())
}

fn cells(errors: [f64; 4]) -> String {
    errors.map(short).join(" | ")
}

/// Returns the table of methods in integers.
fn small_table() -> String {
    let [times, errors] = small();
    let row = |name| {
        let (cells, speed) = (cells(errors[name]), 1.0 / times[name][0]);
        format!("`{name}` | {cells} | {speed:.2}")
    };
    rows(
        "| method | error at 5° | 15° | 30° | 60° | speed, × naive in integers |\n|---|---:|---:|---:|---:|---:|",
        fastest(&times).into_iter().map(row),
    )
}

/// Reads the summary of the report that was measured on a quiet machine.
fn quiet() -> Summary {
    serde_json::from_str(&read("report/quiet.json")).expect("a summary")
}

/// Returns the three answers at the top of the page, and where the first two were measured.
fn answer() -> String {
    let quiet = quiet();
    let sentences = sentences(&quiet);
    let point = |start: &str| {
        let mut all = sentences.iter();
        let (head, words) = all.find(|(head, _)| head.starts_with(start)).expect(start);
        // The file has no no-break spaces, which nobody sees.
        format!("- **{head}:** {}\n", words.replace('\u{A0}', " "))
    };
    let small: Value = serde_json::from_str(&read("report/small.json")).expect("JSON");
    let cycles = |name: &str| {
        let mut spans = list(&small, "spans").iter();
        let span = spans.find(|span| span["method"] == name).expect("a method");
        number(&span["m0p_cycles"][1])
    };
    let (fast, naive, soft) = (cycles("fast"), cycles("naive"), cycles("soft-naive"));
    format!(
        "{}{}- **No floating-point unit:** use `integer::Span::fast`, the lecture’s method with tables: {fast:.0} cycles a pixel on a \
         Cortex-M0+, {:.1} times as fast as naive Phong in the same integers and {:.0} times as fast as in emulated floats.\n\n\
         Speeds are of whole frames, with their 95 % intervals, on a quiet {}, {}.\n",
        point("SIMD"),
        point("Scalar"),
        naive / fast,
        soft / fast,
        quiet.machine.cpu,
        quiet.date.expect("a date"),
    )
}

/// Returns the table of methods: worst errors, then speeds with one light and with four, with SIMD
/// and in scalar code. The fastest in scalar code come first.
fn methods() -> String {
    let errors = errors(1);
    let [simd, simd4, scalar, scalar4] = ["simd-1", "simd-4", "scalar-1", "scalar-4"].map(speeds);
    let front_of = |name| -> BTreeSet<String> {
        (0..DEGREES.len())
            .flat_map(|mesh| front(&times(name), &errors, mesh))
            .collect()
    };
    let (simd_front, scalar_front) = (front_of("simd-1"), front_of("scalar-1"));
    let row = |name: &&str| {
        let speed = |speeds: &Speeds| gain(speeds, name);
        let mark = |front: &BTreeSet<String>| if front.contains(*name) { " ●" } else { "" };
        let is_scalar = MethodRow::named(name).is_some_and(|entry| entry.scalar_only().is_some());
        let with_simd = if is_scalar {
            "– | –".to_owned()
        } else {
            format!("{}{} | {}", speed(&simd), mark(&simd_front), speed(&simd4))
        };
        let mark = mark(&scalar_front);
        let (one, four, cells) = (speed(&scalar), speed(&scalar4), cells(errors[*name]));
        format!("`{name}` | {cells} | {with_simd} | {one}{mark} | {four}")
    };
    let times = times("scalar-1");
    let names = fastest(&times);
    rows(
        "| method | error at 5° | 15° | 30° | 60° | SIMD, 1 light | 4 lights | scalar, 1 light | 4 lights |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|",
        names
            .iter()
            .filter(|name| errors.contains_key(**name))
            .map(row),
    )
}

/// Returns the table of methods on frames with N·H highlights.
fn halfway_table() -> String {
    let (speeds, errors) = (speeds("halfway-1"), errors(1));
    let row = |name| {
        let (cells, speed) = (cells(errors[name]), gain(&speeds, name));
        format!("`{name}` | {cells} | {speed}")
    };
    rows(
        "| method | error at 5° | 15° | 30° | 60° | speed |\n|---|---:|---:|---:|---:|---:|",
        fastest(&times("halfway-1")).into_iter().map(row),
    )
}

/// Returns the table of methods on frames with lights and eye at positions: errors of these frames,
/// and speeds mesh by mesh.
fn positions_table() -> String {
    let [one, four] = ["positions-1", "positions-4"].map(speeds);
    let levels = measured("positions-1", "levels");
    let row = |name| {
        let (errors, speeds) = (cells(levels[name]), one[name].map(known).join(" | "));
        format!("`{name}` | {errors} | {speeds} | {}", gain(&four, name))
    };
    rows(
        "| method | error at 5° | 15° | 30° | 60° | speed at 5° | 15° | 30° | 60° | 4 lights |\n\
         |---|---:|---:|---:|---:|---:|---:|---:|---:|---:|",
        fastest(&times("positions-1")).into_iter().map(row),
    )
}

/// Returns the table of break-even lengths: from how many pixels on each method of the scalar front
/// is faster than each other one, with this many lights.
fn break_even(lights: u64) -> String {
    let (times, errors) = (times(&format!("scalar-{lights}")), errors(lights));
    let document = data("spans");
    let lengths: Vec<f64> = list(&document, "lengths").iter().map(number).collect();
    let mut names = front(&times, &errors, 1);
    for name in [
        "naive-phong",
        "phong-rsqrt",
        "fast-phong",
        "duff-phong",
        "slerp-phong",
    ] {
        if !names.iter().any(|n| n == name) {
            names.push(name.into());
        }
    }
    let ns = |name: &str| -> Vec<f64> {
        let mut spans = list(&document, "spans").iter();
        let span = spans.find(|s| s["method"] == name && s["lights"] == lights);
        list(span.expect("a method"), "ns")
            .iter()
            .map(number)
            .collect()
    };
    let mut text = format!("| faster than | `{}` |\n|---|", names.join("` | `"));
    text += &"---:|".repeat(names.len());
    for row in &names {
        let cells = names.iter().map(|column| {
            let pairs: Vec<(f64, f64)> = ns(row).into_iter().zip(ns(column)).collect();
            // Break-even comes after the last measured length at which the row's method is slower.
            match pairs.iter().rposition(|(own, other)| own >= other) {
                _ if row == column => String::new(),
                None => "always".into(),
                Some(last) if last + 1 == lengths.len() => "never".into(),
                Some(last) => {
                    // The difference of the times is taken as linear between two measured lengths:
                    // this is where it vanishes.
                    let [(a0, b0), (a1, b1)] = [pairs[last], pairs[last + 1]];
                    let [before, after] = [a0 - b0, b1 - a1];
                    let t = before / (before + after);
                    let length = lengths[last] + t * (lengths[last + 1] - lengths[last]);
                    format!("{:.0}", length.ceil())
                }
            }
        });
        write!(
            text,
            "\n| `{row}` | {} |",
            cells.collect::<Vec<_>>().join(" | ")
        )
        .expect("a text");
    }
    text + "\n"
}

/// Returns the table of what a frame costs without shading, and what a method can gain at most.
fn floor() -> String {
    let machines = [("SIMD", "simd-1"), ("scalar", "scalar-1")].map(|(machine, file)| {
        let (speeds, naive) = (speeds(file), naive(file));
        let row = |mesh: usize| {
            let (floor, rsqrt) = (cheapest(&speeds)[mesh], speeds["phong-rsqrt"][mesh]);
            // Two digits are known.
            let ms = [floor.typical, 1.0, rsqrt.typical].map(|speed| match naive[mesh] / speed {
                ms if ms < 1.0 => format!("{ms:.2}"),
                ms => format!("{ms:.1}"),
            });
            let [most, over] = [floor, quotient(floor, rsqrt)].map(known);
            format!(
                "{machine} | {}° | {} | {most} | {over}",
                DEGREES[mesh],
                ms.join(" | ")
            )
        };
        [0, 1, 2, 3].map(row)
    });
    rows(
        "| machine | mesh | nothing at pixels, ms | naive Phong, ms | `phong-rsqrt`, ms | most over naive Phong | most over `phong-rsqrt` |\n|---|---:|---:|---:|---:|---:|---:|",
        machines.into_iter().flatten(),
    )
}

/// Makes the figure *the diagonal moves the normal*, which measures vertex normals by weight.
fn diagonal() -> FigureContent {
    let figure = Figure::named("diagonal").expect("a figure");
    figure.make().expect("the figure can be drawn")
}

/// Returns the value of a figure's finding.
fn finding(content: &FigureContent, key: &str) -> f64 {
    content.finding(key).expect("a finding").value
}

/// Returns the table of vertex normals by weight, and a paragraph on what it shows.
fn normals_table() -> String {
    let content = diagonal();
    let mut tables = content.blocks.iter().filter_map(|block| match block {
        FigureBlock::Table { head, rows } if head.len() == 6 => Some((head, rows)),
        _ => None,
    });
    let (head, rows) = tables.next_back().expect("the table of surfaces");
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
    let mut text = line(head) + "|---:|---|---:|---:|---:|---:|\n";
    // The figure has the rows for other angles.
    let shown = |row: &&Vec<String>| ["15", "90"].contains(&&*row[0]);
    let shown = rows.iter().filter(shown);
    shown.for_each(|row| text += &line(row));
    let [uniform, angle] = ["smooth", "smooth-angle"].map(|key| finding(&content, key));
    text += &format!(
        "\nA cube can be cut into triangles in 64 ways. Over all of them, uniform averages and averages by area are up to {:.1}° off, which is {:.0} levels with the \
         diagonal of one face turned; averages by angle and by Max's weights are exact. Pictures of the nine smooth surfaces at 15° are {uniform:.2} levels off \
         on average with uniform weights (RMS), and {angle:.2} by angle.\n",
        finding(&content, "uniform"),
        finding(&content, "uniform-levels"),
    );
    text
}

/// Returns the table of claims from the literature, each with what was measured and a verdict.
fn claims() -> String {
    let scalar = speeds("scalar-1");
    let over = |method: &str, other: &str| speed(&scalar, method, other);
    let errors = errors(1);
    let verdict = |holds: bool| if holds { "holds" } else { "does not hold" };
    // Where the interval contains a limit, the samples do not show on which side the speed is.
    let within = |speed: Ratio, [from, to]: [f64; 2]| {
        if speed.low > from && speed.high < to {
            "holds"
        } else if speed.high < from || speed.low > to {
            "does not hold"
        } else {
            "not shown"
        }
    };
    let is_over = |speed: Ratio, limit: f64| match speed {
        Ratio { tie: true, .. } if limit == 1.0 => "a tie",
        speed => within(speed, [limit, f64::INFINITY]),
    };
    let times_of = |speed: Ratio| format!("{} times", known(speed));
    let mut found: Vec<[String; 4]> = Vec::new();
    let mut row = |claim: &str, source: &str, measured: String, verdict: &str| {
        found.push([claim.into(), source.into(), measured, verdict.into()]);
    };
    let gain = over("fast-phong", NAIVE);
    row(
        "fast Phong is faster than naive Phong",
        "L21 4.2, 4.3",
        format!("{} as fast, scalar", times_of(gain)),
        is_over(gain, 1.0),
    );
    for (lights, speeds) in [("one light", &scalar), ("four lights", &speeds("scalar-4"))] {
        let slerp = speed(speeds, "slerp-phong", "fast-phong");
        row(
            &format!("slerp Phong is faster still, with {lights}"),
            "L21 4.4",
            format!("{} as fast as fast Phong, scalar", times_of(slerp)),
            is_over(slerp, 1.0),
        );
    }
    let phong = over("gouraud", NAIVE);
    row(
        "Phong shading is considerably slower than Gouraud",
        "L21 4.1",
        format!("Gouraud {} as fast, scalar", times_of(phong)),
        is_over(phong, 1.5),
    );
    let worst = errors["duff-phong"][2];
    row(
        "forward differences give naive Phong's picture",
        "Duff 1979",
        format!("{} levels off at 30°", short(worst)),
        verdict(worst < 0.1),
    );
    let bishop = over("bishop-weimer", "gouraud");
    row(
        "Taylor's quadratics: five additions a pixel, about half of Gouraud's speed",
        "Bishop, Weimer 1986; Hearn, Baker",
        format!("{} as fast as Gouraud, scalar", times_of(bishop)),
        within(bishop, [0.4, 0.6]),
    );
    let seams = errors["bishop-weimer"][1];
    row(
        "the error of these quadratics is not seen",
        "Bishop, Weimer 1986",
        format!("{} levels at 15°", short(seams)),
        verdict(seams < 1.0),
    );
    let (bw, six) = (errors["bishop-weimer"][1], errors["six-point"][1]);
    row(
        "quadratics through six points are nearer than Taylor's",
        "Seiler 1998",
        format!("{} levels against {} at 15°", short(six), short(bw)),
        verdict(six < bw),
    );
    let polygon = |name: &str| {
        let counts = Variant::parse(name)
            .expect("a method")
            .operations(1)
            .polygon;
        counts.roots
    };
    row(
        "midpoints without roots make their set-up cheap",
        "Barrera, Hast, Bengtsson 2006",
        format!(
            "{} roots per triangle in place of {}",
            polygon("six-point:midpoints=barrera"),
            polygon("six-point")
        ),
        verdict(polygon("six-point:midpoints=barrera") < polygon("six-point")),
    );
    let chebyshev = over("slerp-chebyshev", "gouraud");
    row(
        "equal angles by Chebyshev's recurrence come close to Gouraud",
        "Barrera, Hast, Bengtsson 2004",
        format!("{} of Gouraud's speed, scalar", known(chebyshev)),
        is_over(chebyshev, 0.8),
    );
    let series = errors["series-phong"];
    row(
        "a series of N·N can replace its root",
        "US patent 5,369,737",
        format!(
            "second order: {} levels at 15°, {} at 30°",
            short(series[1]),
            short(series[2])
        ),
        verdict(series[1] < 1.0),
    );
    let lyon = errors["difference-vector"][1];
    row(
        "highlights by difference vectors need no unit normals",
        "Lyon 1993",
        format!(
            "{} levels at 5°, {} at 15°",
            short(errors["difference-vector"][0]),
            short(lyon)
        ),
        verdict(lyon < 1.0),
    );
    let h_test = over("h-test", NAIVE);
    row(
        "it is cheaper to compute highlights only where there are some",
        "Harrison, Mitchell, Watt 1988",
        format!("{} as fast as naive Phong, scalar", times_of(h_test)),
        is_over(h_test, 1.0),
    );
    let at_pixels = |name: &str| {
        let all = Variant::parse(name).expect("a method").operations(1);
        (all.walk, all.shade)
    };
    let (walk, _) = at_pixels("naive-phong");
    row(
        "three additions a pixel step the normal",
        "L21 4.1",
        format!(
            "{} additions, {} multiplications",
            walk.additions, walk.multiplications
        ),
        verdict((walk.additions, walk.multiplications) == (3, 0)),
    );
    let (walk, _) = at_pixels("slerp-phong");
    row(
        "four additions and eight multiplications a pixel step the sines",
        "L21 4.9-4.12",
        format!(
            "{} and {}, including 2 and 4 for J and K",
            walk.additions, walk.multiplications
        ),
        verdict((walk.additions, walk.multiplications) == (4 + 2, 8 + 4)),
    );
    let (walk, shade) = at_pixels("duff-phong");
    row(
        "three additions, a division and a root a pixel for diffuse light",
        "Duff 1979, after Bishop, Weimer 1986",
        format!(
            "{} additions with K of the highlight, {} division, {} root",
            walk.additions, shade.divisions, shade.roots
        ),
        verdict((walk.additions, shade.divisions, shade.roots) == (4, 1, 1)),
    );
    let (walk, shade) = at_pixels("bishop-weimer");
    row(
        "two additions a pixel for L.N, two for the highlight's cosine, a fifth that sums them, and a table's entry",
        "Bishop, Weimer 1986",
        format!(
            "{} additions for both cosines; without a table the sums, clamps, power and three channels take {} additions and {} multiplications",
            walk.additions, shade.additions, shade.multiplications
        ),
        verdict(walk.additions == 4),
    );
    let (walk, shade) = at_pixels("kuijk-blake");
    row(
        "two additions a pixel, for angles",
        "Kuijk, Blake 1989",
        format!(
            "{} additions; parabolas and three channels take {} read from a table, {} additions and {} multiplications",
            walk.additions, shade.lookups, shade.additions, shade.multiplications
        ),
        verdict((walk.additions, walk.multiplications) == (2, 0)),
    );
    let slower = over("gouraud", NAIVE);
    row(
        "Phong shading takes six to seven times as long as Gouraud",
        "Hearn, Baker",
        format!("{} as long, whole frames, scalar", times_of(slower)),
        within(slower, [6.0, 7.0]),
    );
    for (method, claim, source) in [
        (
            "quadratic-normals",
            "quadratics make normalisation unnecessary",
            "Hast, Barrera, Bengtsson 2002",
        ),
        (
            "half-reflection",
            "reflection at a vector of any length gives unit normals",
            "Hast, Barrera, Bengtsson 2001",
        ),
    ] {
        let (walk, shade) = at_pixels(method);
        let error = errors[method];
        row(
            claim,
            source,
            format!(
                "{} roots per pixel; {} levels at 15°, {} at 30°",
                walk.roots + shade.roots,
                short(error[1]),
                short(error[2])
            ),
            verdict(error[1] < 1.0),
        );
    }
    let cut = diagonal();
    let moved = finding(&cut, "angle");
    row(
        "weights by angle do not depend on how a surface is cut into polygons",
        "Thürmer, Wüthrich 1998",
        format!(
            "{moved:.1}° off on a cube cut in 64 ways; uniform weights {:.1}°",
            finding(&cut, "uniform")
        ),
        verdict(moved < 1e-4),
    );
    let spheres = finding(&cut, "spheres");
    row(
        "weights of the sine over both edges are exact on spheres",
        "Max 1999",
        format!("{spheres:.2}° off on spheres, however cut"),
        verdict(spheres < 1e-3),
    );
    let adaptive = over("adaptive-phong", "phong-rsqrt");
    row(
        "an order chosen for each polygon is cheaper than a root at each pixel",
        "US patent 5,253,339; Cho, Neumann, Woo 1996",
        format!(
            "{} as fast as `phong-rsqrt`, within {} levels",
            times_of(adaptive),
            short(errors["adaptive-phong"][3])
        ),
        is_over(adaptive, 1.0),
    );
    rows(
        "| claim | source | measured | verdict |\n|---|---|---|---|",
        found.iter().map(|row| row.join(" | ")),
    )
}

/// Moves labels apart vertically, so that none covers another and none lies below `bottom`. Takes
/// pairs of a height and a label's index, and returns the new height of each label.
fn apart(mut places: Vec<(f64, usize)>, bottom: f64) -> BTreeMap<usize, f64> {
    const LEAST: f64 = 10.0;
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    for i in 1..places.len() {
        places[i].0 = places[i].0.max(places[i - 1].0 + LEAST);
    }
    let mut limit = bottom;
    for (place, _) in places.iter_mut().rev() {
        *place = place.min(limit);
        limit = *place - LEAST;
    }
    places
        .into_iter()
        .map(|(place, index)| (index, place))
        .collect()
}

/// Draws error against time on the four meshes, with the front, as SVG.
fn chart(title: &str, baseline: &str, times: &ByMethod, errors: &ByMethod) -> String {
    const PANEL: [f64; 2] = [330.0, 320.0];
    const INNER: [f64; 4] = [44.0, 36.0, 318.0, 284.0]; // left, top, right, bottom
    let named = [
        "flat",
        "gouraud",
        "naive-phong",
        "fast-phong",
        "slerp-phong",
        "phong-rsqrt",
        "duff-phong",
    ];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"10\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"8\" y=\"14\" font-size=\"12\" font-weight=\"bold\">{title}</text>\n",
        4.0 * PANEL[0],
        PANEL[1]
    );
    let level = |error: f64| error.clamp(0.005, 255.0).log10();
    let (low, high) = (0.005f64.log10(), 255f64.log10());
    for (mesh, degrees) in DEGREES.iter().enumerate() {
        let left = mesh as f64 * PANEL[0];
        let naive = times[baseline][mesh];
        let all: Vec<(&String, f64, f64)> = times
            .iter()
            .filter(|(m, _)| is_for_use(m))
            .filter_map(|(m, t)| Some((m, t[mesh] / naive, errors.get(m)?[mesh])))
            .collect();
        let most = all.iter().map(|(_, t, _)| *t).fold(1.0, f64::max).min(1.6);
        let x = |t: f64| left + INNER[0] + (INNER[2] - INNER[0]) * (t / most).min(1.0);
        let y = |e: f64| INNER[3] - (INNER[3] - INNER[1]) * (level(e) - low) / (high - low);
        writeln!(
            svg,
            "<text x=\"{}\" y=\"30\">{degrees}° between normals</text>",
            left + INNER[0]
        )
        .expect("a text");
        for error in [0.01, 0.1, 0.5, 1.0, 10.0, 100.0] {
            let (at, dash) = (y(error), if error == SAME { "4 3" } else { "0" });
            let colour = if error == SAME { "#b00" } else { "#ddd" };
            writeln!(
                svg,
                "<path d=\"M{} {at:.1}H{}\" stroke=\"{colour}\" stroke-dasharray=\"{dash}\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#555\">{error}</text>",
                left + INNER[0],
                left + INNER[2],
                left + INNER[0] - 4.0,
                at + 3.0
            )
            .expect("a text");
        }
        for part in [0.0, 0.5, 1.0, 1.5] {
            if part <= most {
                writeln!(
                    svg,
                    "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\" fill=\"#555\">{part}</text>",
                    x(part),
                    INNER[3] + 14.0
                )
                .expect("a text");
            }
        }
        let front = front(times, errors, mesh);
        let on_front = |m: &str| front.iter().any(|f| f == m);
        let line: Vec<String> = front
            .iter()
            .map(|m| format!("{:.1} {:.1}", x(times[m][mesh] / naive), y(errors[m][mesh])))
            .collect();
        writeln!(
            svg,
            "<path d=\"M{}\" fill=\"none\" stroke=\"#06c\" stroke-width=\"1.5\"/>",
            line.join("L")
        )
        .expect("a text");
        let labelled: Vec<usize> = (0..all.len())
            .filter(|&i| {
                on_front(all[i].0)
                    || named.contains(&all[i].0.as_str())
                    || all[i].0.starts_with("integer")
            })
            .collect();
        let places = apart(
            labelled.iter().map(|&i| (y(all[i].2), i)).collect(),
            INNER[3] - 3.0,
        );
        for (i, (name, time, error)) in all.iter().enumerate() {
            let (fill, radius) = if on_front(name) {
                ("#06c", 4.0)
            } else {
                ("#999", 3.0)
            };
            let (cx, cy) = (x(*time), y(*error));
            writeln!(svg, "<circle cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"{radius}\" fill=\"{fill}\"><title>{name}: {} of naive Phong, {} levels</title></circle>", short(*time), short(*error).replace('<', "&lt;")).expect("a text");
            if let Some(at) = places.get(&i) {
                let (anchor, dx) = if cx > left + 230.0 {
                    ("end", -6.0)
                } else {
                    ("start", 6.0)
                };
                writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" fill=\"{fill}\">{name}</text>", cx + dx, at + 3.0).expect("a text");
            }
        }
    }
    writeln!(svg, "<text x=\"{}\" y=\"315\" fill=\"#555\">across: time as a multiple of naive Phong's, left is faster, slower methods than shown are at the right edge; upward: largest error found, in grey levels (dashed: half a level); blue: the front, where no method is both faster and nearer</text>\n</svg>", INNER[0]).expect("a text");
    svg
}

/// Reads the worst case of a method with one light, or returns `None` if the search found none.
fn case(method: &str, degrees: u32) -> Option<WorstCase> {
    let document = data("search");
    let mut cases = list(&document, "cases").iter();
    let found = cases.find(|case| {
        case["method"] == method
            && number(&case["degrees"]) == f64::from(degrees)
            && case["lights"] == 1
    });
    Some(serde_json::from_value(found?.clone()).expect("a case"))
}

/// Returns the methods whose worst cases are shown: those that are over half a level off at 30
/// degrees.
fn shown() -> Vec<&'static str> {
    let names = METHODS.iter().filter(|entry| !entry.is_integer);
    let names = names.map(|entry| entry.info.name);
    names
        .filter(|name| case(name, 30).is_some_and(|case| case.levels > SAME))
        .collect()
}

/// Draws the worst cases at 30 degrees as PNG: the reference above, the method below, six pairs to
/// a row.
fn pictures() -> Vec<u8> {
    const SCALE: usize = 5;
    const CELL: usize = 24 * SCALE + 8;
    let names = shown();
    let rows = names.len().div_ceil(6);
    let mut sheet = Picture8::new(6 * CELL, rows * 2 * CELL, [255; 4]);
    for (index, name) in names.iter().enumerate() {
        let case = case(name, 30).expect("a shown method has a case");
        let frame = case.frame();
        let truth = reference::render(&frame, Model::Phong).to_picture8();
        let ours = Variant::parse(name)
            .expect("a method")
            .render_with(&frame, Renderer::LECTURE)
            .expect("a method for the frame");
        for (row, picture) in [truth, ours].iter().enumerate() {
            let (left, top) = (index % 6 * CELL, (index / 6 * 2 + row) * CELL);
            for y in 0..24 * SCALE {
                for x in 0..24 * SCALE {
                    let pixel = picture.get(x / SCALE, y / SCALE);
                    if pixel[3] > 0 {
                        sheet.row_mut(top + y)[left + x] = pixel;
                    }
                }
            }
        }
    }
    encode_png(&sheet).expect("a picture")
}

/// Draws the pictures of the figure of vertex normals side by side, as PNG. The upper row is a cube
/// by its polygons and by each weight, the lower row a cube whose edges are cut off.
fn pictures_of_normals() -> Vec<u8> {
    let content = diagonal();
    let rows: Vec<&Vec<Panel>> = content
        .blocks
        .iter()
        .filter_map(|block| match block {
            FigureBlock::Pictures { shown, .. } => Some(shown),
            _ => None,
        })
        .collect();
    let first = &rows[0][0].picture;
    let (width, height) = (first.width(), first.height());
    let [cell, line] = [width + 8, height + 8];
    let mut sheet = Picture8::new(rows[0].len() * cell, rows.len() * line, [255; 4]);
    for (row, panels) in rows.iter().enumerate() {
        for (column, panel) in panels.iter().enumerate() {
            for y in 0..height {
                let target = &mut sheet.row_mut(row * line + y)[column * cell..][..width];
                target.copy_from_slice(panel.picture.row(y));
            }
        }
    }
    encode_png(&sheet).expect("a picture")
}

/// Returns the caption of the picture of the worst cases.
fn worst() -> String {
    let shown = shown().join("`, `");
    format!(
        "The picture below shows the worst triangles at 30° with one light, the reference above and the method below, in this order: `{shown}`.\n"
    )
}

/// Returns the table of all scenes, and where, when and how it was measured.
fn scenes() -> String {
    let quiet = quiet();
    let speeds = quiet.scalar.expect("scenes in scalar code").methods;
    let row = |method: &MethodError| {
        let (name, levels, scene) = (&method.variant, short(method.levels), &method.scene);
        let timed = speeds.iter().find(|timed| timed.variant == *name);
        let speed = timed.map_or_else(|| "–".into(), |timed| timed.speed.cell());
        format!("`{name}` | {levels} | {scene} | {speed}")
    };
    let table = rows(
        "| method | largest error, levels | in | speed, × naive Phong |\n|---|---:|---|---:|",
        quiet.methods.iter().map(row),
    );
    let machine = quiet.machine;
    format!(
        "{table}\nLargest error in {} scenes, in grey levels of 255; geometric mean of speeds with its 95 % interval, from the projected \
         frame to the stored picture; = is a tie. Measured by `{}` on {} ({} {}), {}, on {}.\n",
        quiet.scenes,
        quiet.command_line.join(" "),
        machine.cpu,
        machine.os,
        machine.arch,
        machine.rustc,
        quiet.date.expect("a date"),
    )
}

/// Returns the sentences that say where and how everything was measured.
fn machine() -> String {
    let document = data("times");
    let machine = &document["scalar-1"]["machine"];
    let level = &document["simd-1"]["level"];
    format!(
        "Measured by `docs/findings/run` on {} ({} in SIMD), {}. Frames are spheres at 640 × 480 pixels on one thread, timed from the projected frame to the \
         stored picture, in the thread’s own processor time. Speeds have the digits that their 95 % intervals separate. Errors are by \
         `fastphong search` with {} restarts.\n",
        text(&machine["cpu"]),
        text(level),
        text(&machine["rustc"]),
        data("search")["restarts"]
    )
}

/// Returns a page with everything between its `<!-- made: NAME -->` and `<!-- end -->` made anew.
pub fn page(mut page: String) -> String {
    let blocks: [(&str, &dyn Fn() -> String); 13] = [
        ("answer", &answer),
        ("machine", &machine),
        ("methods", &methods),
        ("halfway", &halfway_table),
        ("positions", &positions_table),
        ("break-even", &|| break_even(1)),
        ("break-even-4", &|| break_even(4)),
        ("small", &small_table),
        ("floor", &floor),
        ("worst", &worst),
        ("claims", &claims),
        ("normals", &normals_table),
        ("scenes", &scenes),
    ];
    let marks = page.matches("<!-- made: ").count();
    let mut made = 0;
    for (name, make) in blocks {
        let mark = format!("<!-- made: {name} -->\n");
        let Some(place) = page.find(&mark) else {
            continue;
        };
        let from = place + mark.len();
        made += 1;
        let length = page[from..].find("<!-- end -->").expect("an end");
        page.replace_range(from..from + length, &format!("\n{}\n", make()));
    }
    assert_eq!(made, marks, "a name that nothing makes");
    page
}

/// Returns the charts and the pictures with the names of their files.
pub fn images() -> Vec<(String, Vec<u8>)> {
    let mut images = Vec::new();
    for (machine, lights, title) in [
        ("simd", 1, "SIMD, one light"),
        ("simd", 4, "SIMD, four lights"),
        ("scalar", 1, "scalar, one light"),
        ("scalar", 4, "scalar, four lights"),
    ] {
        let name = format!("{machine}-{lights}");
        let chart = chart(title, "naive-phong", &times(&name), &errors(lights));
        images.push((format!("{name}.svg"), chart.into_bytes()));
    }
    let [times, errors] = small();
    let title = "Cortex-M0+, integers, one light";
    let chart = chart(title, "integer-naive", &times, &errors);
    images.push(("small.svg".into(), chart.into_bytes()));
    images.push(("worst.png".into(), pictures()));
    images.push(("normals.png".into(), pictures_of_normals()));
    images
}
