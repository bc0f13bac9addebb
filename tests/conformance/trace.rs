//! Traces: their colours are the pictures' colours. Everything that they say about edges, spans and
//! pixels follows from the document itself: this test computes it again, in integers and in `f32`.

use super::support::{cases::cases, floats_on};
use fastphong::frame::Frame;
use fastphong::raster::{self, NO_POLYGON};
use fastphong::scene::HiddenSurfaces;
use fastphong::shading::Variant;
use serde_json::Value;

const SIZE: (i64, i64) = (64, 48);

/// The lines to trace: all of them, or three if the frame has many polygons, whose document would
/// be too large.
fn lines(frame: &Frame) -> Vec<Option<usize>> {
    match frame.polygons().len() {
        0..=10_000 => vec![None],
        _ => [20, 24, 31].map(Some).to_vec(),
    }
}

/// For every float method and scene, a trace has the bits of the picture, at the same pixels and of
/// the visible polygons.
#[test]
fn traced_colours_equal_the_pictures() {
    let mut compared = 0;
    for case in cases(Some(SIZE)) {
        let (frame, numbers) = (&case.frame, raster::polygon_indices(&case.frame));
        for entry in floats_on(frame) {
            let variant = entry.variant();
            let picture = variant.render_linear(frame).expect("a method for it");
            for only in lines(frame) {
                let trace = variant.trace(frame, only).expect("a method for it");
                for line in &trace.lines {
                    let mut seen = vec![NO_POLYGON; frame.width()];
                    for run in &line.runs {
                        let span = &line.spans[run.span];
                        let source = trace.polygons[span.polygon].source;
                        for (x, colour) in (run.x as usize..).zip(&run.colours) {
                            let at = format!("{}, {variant}: {x}, {}", case.name, line.y);
                            assert_eq!(seen[x], NO_POLYGON, "{at}: in two runs");
                            seen[x] = source;
                            let expected = picture.get(x, line.y);
                            let bits = |c: &[f32]| [c[0], c[1], c[2]].map(f32::to_bits);
                            assert_eq!(bits(colour), bits(&expected), "{at}: {colour:?}");
                            compared += 1;
                        }
                    }
                    let sources = numbers.row(line.y).iter().map(|number| match *number {
                        NO_POLYGON => NO_POLYGON,
                        number => frame.polygons()[number as usize].source,
                    });
                    assert!(sources.eq(seen), "{}, {}: what is seen", case.name, line.y);
                }
            }
        }
    }
    assert!(compared > 100_000, "{compared} pixels");
}

/// At least one walk of every float method has names for all its values.
#[test]
fn values_have_names() {
    for case in cases(Some(SIZE)).filter(|case| case.frame.polygons().len() < 200) {
        for entry in floats_on(&case.frame) {
            let variant = entry.variant();
            let trace = variant.trace(&case.frame, Some(24)).expect("for it");
            let named = |values: &[f32], names: &[String]| {
                let at = format!("{}, {variant}: {names:?}", case.name);
                assert!(!names.is_empty(), "{at}");
                assert_eq!(values.len(), names.len(), "{at}");
            };
            for run in trace.lines.iter().flat_map(|line| &line.runs) {
                let names = run.kind.as_ref().map_or(&trace.names.pixel, |k| &k.values);
                run.values.iter().for_each(|values| named(values, names));
                named(&run.at, &trace.names.varyings);
            }
        }
    }
}

/// The document of a trace, as a reader gets it.
struct Read(Value);

fn floats(value: &Value) -> Vec<f32> {
    let list = value.as_array().expect("a list");
    list.iter()
        .map(|v| v.as_f64().expect("a number") as f32)
        .collect()
}

fn whole(value: &Value) -> i128 {
    value.as_i64().expect("a whole number").into()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|v| v.to_bits()).collect()
}

/// Returns the value at `t0` between two values, and its growth in a step of `dt` (L21 3.5).
fn ramp(a: f32, b: f32, t0: f32, dt: f32) -> [f32; 2] {
    let difference = b - a;
    [a + difference * t0, difference * dt]
}

impl Read {
    fn of(frame: &Frame, method: &str) -> Read {
        let variant = Variant::parse(method).expect("a method");
        let trace = variant.trace(frame, None).expect("a method for it");
        let text = serde_json::to_string(&trace).expect("a document");
        Read(serde_json::from_str(&text).expect("JSON"))
    }

    /// Returns both ends of an edge in sub-pixels, the upper end first.
    fn ends(&self, edge: &Value) -> [[i128; 2]; 2] {
        ["top", "bottom"].map(|end| {
            let vertex = &self.0["vertices"][whole(&edge[end]) as usize];
            [0, 1].map(|i| whole(&vertex["at"][i]))
        })
    }

    fn edge(&self, number: &Value) -> &Value {
        &self.0["edges"][whole(number) as usize]
    }

    /// Checks the edges of a line, which follow from the corners: their lower ends are below the
    /// line's centre, and their upper ends are not.
    fn check_edges(&self, line: &Value) {
        let y = whole(&line["y"]);
        let centre = 256 * y + 128;
        let mut crossing: Vec<i128> = Vec::new();
        for (number, edge) in list(&self.0["edges"]).iter().enumerate() {
            let [[_, top], [_, bottom]] = self.ends(edge);
            if top <= centre && centre < bottom {
                crossing.push(number as i128);
            }
            let is_first = top <= centre && (y == 0 || top > centre - 256) && centre < bottom;
            let bucket = list(&self.0["buckets"][y as usize]);
            let stands = bucket.iter().any(|e| whole(e) == number as i128);
            assert_eq!(stands, is_first, "edge {number} in the bucket of line {y}");
        }
        let mut active: Vec<i128> = list(&line["active"])
            .iter()
            .map(|a| whole(&a["edge"]))
            .collect();
        active.sort_unstable();
        assert_eq!(active, crossing, "line {y}");
        let mut entered: Vec<i128> = list(&line["entered"])
            .iter()
            .map(|e| whole(&e["edge"]))
            .collect();
        entered.extend(list(&line["stepped"]).iter().map(whole));
        entered.sort_unstable();
        assert_eq!(active, entered, "line {y}: each edge steps or enters");
    }

    /// Checks crossings, exactly, and their order.
    fn check_crossings(&self, line: &Value) {
        let centre = 256 * whole(&line["y"]) + 128;
        let mut before: Option<(i128, [i128; 2])> = None;
        for active in list(&line["active"]) {
            let edge = self.edge(&active["edge"]);
            let [[x0, y0], [x1, y1]] = self.ends(edge);
            let (pixel, rest, of) = (
                whole(&active["pixel"]),
                whole(&active["rest"][0]),
                whole(&active["rest"][1]),
            );
            // X = X0 + (Yc − Y0) dX / dY, and pixel + ½ − rest/of is X in pixels. Both are compared
            // times 256 dY of.
            let x = [x0 * (y1 - y0) + (centre - y0) * (x1 - x0), y1 - y0];
            let said = (2 * pixel + 1) * of - 2 * rest;
            assert_eq!(x[0] * 2 * of, said * 256 * x[1], "{active}");
            assert!((0..of).contains(&rest), "{active}");
            let step = whole(&active["step"][0]) * of + whole(&active["step"][1]);
            assert_eq!(step * (y1 - y0), (x1 - x0) * of, "{active}");
            let polygon = whole(&edge["polygon"]);
            if let Some((other, b)) = before {
                let is_after = b[0] * x[1] <= x[0] * b[1];
                assert!(other < polygon || other == polygon && is_after, "{active}");
            }
            before = Some((polygon, x));
        }
    }

    /// Checks the values that edges carry: from their ends at the first line, then by one addition
    /// per line.
    fn check_varyings(&self, line: &Value, before: Option<&Value>) {
        let of = |line: &Value, edge: &Value| {
            let found = list(&line["active"]).iter().find(|a| a["edge"] == *edge);
            found.expect("an active edge").clone()
        };
        for entry in list(&line["entered"]) {
            let [[_, y0], [_, y1]] = self.ends(self.edge(&entry["edge"]));
            let height = (y1 - y0) as f32;
            let t0 = (256 * whole(&line["y"]) + 128 - y0) as f32 / height;
            let dt = 256.0 / height;
            assert_eq!(
                bits(&[t0, dt]),
                bits(&floats(&serde_json::json!([entry["t0"], entry["dt"]])))
            );
            let active = of(line, &entry["edge"]);
            let ends = floats(&entry["from"]).into_iter().zip(floats(&entry["to"]));
            if active.get("circle").is_none() {
                let (at, by): (Vec<f32>, Vec<f32>) = ends
                    .map(|(a, b)| ramp(a, b, t0, dt))
                    .map(|[at, by]| (at, by))
                    .unzip();
                assert_eq!(bits(&at), bits(&floats(&active["at"])), "{active}");
                assert_eq!(bits(&by), bits(&floats(&active["by"])), "{active}");
            }
        }
        for edge in list(&line["stepped"]) {
            let (here, above) = (of(line, edge), of(before.expect("a line above"), edge));
            for (at, by) in [("at", "by"), ("depth", "depth")] {
                let (mut at_above, by_above) = (floats(&above[at]), floats(&above[by]));
                if at == "depth" {
                    at_above.truncate(1);
                }
                let by_above = if at == "depth" {
                    &by_above[1..]
                } else {
                    &by_above[..]
                };
                let next: Vec<f32> = at_above.iter().zip(by_above).map(|(a, b)| a + b).collect();
                let found = floats(&here[at]);
                if !by_above.is_empty() {
                    assert_eq!(bits(&next), bits(&found[..next.len()]), "{here}");
                }
            }
        }
    }

    /// Checks spans, the depth test, and the runs that are left.
    fn check_spans(&self, line: &Value, has_depth_test: bool) {
        let width = whole(&self.0["size"][0]);
        let active = list(&line["active"]);
        let mut stored = vec![(f32::INFINITY, NO_POLYGON as usize); width as usize];
        for (number, span) in list(&line["spans"]).iter().enumerate() {
            let left = active
                .iter()
                .position(|a| a["edge"] == span["left"])
                .expect("active");
            let [left, right] = [&active[left], &active[left + 1]];
            assert_eq!(right["edge"], span["right"], "the next edge of the polygon");
            let (from, to) = (whole(&left["pixel"]), whole(&right["pixel"]));
            assert_eq!(
                [whole(&span["start"]), whole(&span["end"])],
                [from.max(0), to.min(width)]
            );
            let offset = |a: &Value| whole(&a["rest"][0]) as f64 / whole(&a["rest"][1]) as f64;
            let dt = 1.0 / ((to - from) as f64 + (offset(left) - offset(right)));
            let t0 = (((from.max(0) - from) as f64 + offset(left)) * dt) as f32;
            let found = floats(&serde_json::json!([span["t0"], span["dt"]]));
            assert_eq!(bits(&[t0, dt as f32]), bits(&found), "{span}");
            let mut seen = vec![false; width as usize];
            for pair in list(&span["seen"]) {
                seen[whole(&pair[0]) as usize..whole(&pair[1]) as usize].fill(true);
            }
            for (x, depth) in (from.max(0) as usize..).zip(floats(&span["depths"])) {
                let is_seen = !has_depth_test || depth < stored[x].0;
                assert_eq!(
                    seen[x], is_seen,
                    "line {}, span {number}, pixel {x}",
                    line["y"]
                );
                if is_seen {
                    stored[x] = (depth, number);
                }
            }
        }
        let mut shown = vec![NO_POLYGON as usize; width as usize];
        for run in list(&line["runs"]) {
            let (x, count) = (whole(&run["x"]) as usize, whole(&run["pixels"]) as usize);
            shown[x..x + count].fill(whole(&run["span"]) as usize);
        }
        assert!(stored.iter().map(|s| s.1).eq(shown), "line {}", line["y"]);
    }

    /// Checks runs: they start between their edges and continue by additions, and Newton's guesses
    /// follow one another.
    fn check_runs(&self, line: &Value) -> usize {
        let (mut pixels, active) = (0, list(&line["active"]));
        let at = |edge: &Value| {
            let found = active.iter().find(|a| a["edge"] == *edge);
            floats(&found.expect("active")["at"])
        };
        for run in list(&line["runs"]) {
            let span = &line["spans"][whole(&run["span"]) as usize];
            let (x, dt) = (whole(&run["x"]), floats(&serde_json::json!([run["dt"]]))[0]);
            let start = floats(&serde_json::json!([span["t0"]]))[0];
            let t0 = start + (x - whole(&span["start"])) as f32 * dt;
            let ends = at(&span["left"]).into_iter().zip(at(&span["right"]));
            let mut here: Vec<[f32; 2]> = ends.map(|(a, b)| ramp(a, b, t0, dt)).collect();
            let (starts, steps): (Vec<f32>, Vec<f32>) =
                here.iter().map(|[at, by]| (at, by)).unzip();
            assert_eq!(bits(&starts), bits(&floats(&run["at"])), "{run}");
            assert_eq!(bits(&steps), bits(&floats(&run["by"])), "{run}");
            let guesses = run["inside"].get("guess").map(list);
            let mut length = None;
            for (i, values) in list(&run["values"]).iter().enumerate() {
                let values = floats(values);
                // J and K, or N, or a colour: all values that are carried and shown.
                let same = values
                    .len()
                    .min(here.len())
                    .min(if guesses.is_some() { 2 } else { 3 });
                let stepped: Vec<f32> = here.iter().map(|[at, _]| *at).collect();
                assert_eq!(bits(&stepped[..same]), bits(&values[..same]), "{run}");
                if let Some(guesses) = guesses {
                    let [_, _, d, square] = values[..] else {
                        panic!("J, K, d, D: {values:?}")
                    };
                    let [_, _, [x, _], [y, _], [z, _]] = here[..] else {
                        panic!("{here:?}")
                    };
                    assert!(
                        (square - (x * x + y * y + z * z)).abs() <= 4.0 * f32::EPSILON * square
                    );
                    let guesses = floats(&guesses[i]);
                    let expected = length.unwrap_or(square.sqrt());
                    assert_eq!(
                        guesses[0].to_bits(),
                        f32::to_bits(expected),
                        "x₀ is the d before"
                    );
                    for pair in guesses.windows(2) {
                        let [x, next] = [pair[0], pair[1]];
                        let step = x - (x * x - square) / (x + x);
                        assert_eq!(step.to_bits(), next.to_bits(), "a step of Newton's method");
                    }
                    assert_eq!(guesses.last().map(|g| g.to_bits()), Some(d.to_bits()));
                    length = Some(d);
                }
                here.iter_mut().for_each(|[at, by]| *at += *by);
                pixels += 1;
            }
        }
        pixels
    }
}

/// In scenes of few polygons, everything in the document follows from its vertices.
#[test]
fn a_document_can_be_recomputed() {
    let mut pixels = 0;
    for case in cases(Some(SIZE)).filter(|case| case.frame.polygons().len() < 600) {
        let frame = &case.frame;
        let has_depth_test = matches!(frame.hidden_surfaces(), HiddenSurfaces::ZBuffer(_));
        for method in [
            "gouraud",
            "naive-phong",
            "fast-phong:steps=1",
            "fast-phong:steps=3",
        ] {
            let variant = Variant::parse(method).expect("a method");
            let is_plain = frame.light_count() == 1 && !frame.is_local();
            if variant
                .plan(frame, raster::Renderer::LECTURE)
                .renderer()
                .is_none()
                || !is_plain
            {
                continue;
            }
            let read = Read::of(frame, method);
            let mut before = None;
            for line in list(&read.0["lines"]) {
                read.check_edges(line);
                read.check_crossings(line);
                read.check_varyings(line, before);
                read.check_spans(line, has_depth_test);
                pixels += read.check_runs(line);
                before = Some(line);
            }
        }
    }
    assert!(pixels > 10_000, "{pixels} pixels");
}

/// The addition theorems turn great circles, along edges and along spans.
#[test]
fn great_circles_turn_by_their_step() {
    let mut turned = 0;
    for case in cases(Some(SIZE)).filter(|case| case.frame.polygons().len() < 100) {
        let slerp = Variant::parse("slerp-phong").expect("a method");
        if slerp
            .plan(&case.frame, raster::Renderer::LECTURE)
            .renderer()
            .is_none()
        {
            continue;
        }
        let trace = slerp.trace(&case.frame, None).expect("a method for it");
        // L21 4.9 to 4.12.
        let turn = |[sin, cos]: [f32; 2], [s, c]: [f32; 2]| [sin * c + cos * s, cos * c - sin * s];
        let back = |[sin, cos]: [f32; 2], [s, c]: [f32; 2]| [sin * c - cos * s, cos * c + sin * s];
        for pair in trace.lines.windows(2) {
            for below in &pair[1].active {
                let above = pair[0].active.iter().find(|a| a.edge == below.edge);
                let circles =
                    above.and_then(|a| Some((a.circle.as_ref()?, below.circle.as_ref()?)));
                if let Some((a, b)) = circles {
                    assert_eq!(turn(a.t, a.step), b.t, "{}", case.name);
                    assert_eq!(back(a.rest, a.step), b.rest, "{}", case.name);
                    turned += 1;
                }
            }
        }
        for run in trace.lines.iter().flat_map(|line| &line.runs) {
            let two = |name, i: usize| [run.inside[name][i][0], run.inside[name][i][1]];
            for i in 1..run.pixels {
                assert_eq!(turn(two("t", i - 1), two("step", i - 1)), two("t", i));
                assert_eq!(back(two("rest", i - 1), two("step", i - 1)), two("rest", i));
                turned += 1;
            }
        }
    }
    assert!(turned > 1000, "{turned}");
}
