//! `fastphong compare` and `fastphong bench`: the engines that are timed, and the data.

use super::{Folder, SPHERE};
use fastphong::number::SimdLevel;
use fastphong::shading::{METHODS, MethodRow, Tier};
use serde_json::{Value, json};

/// Returns the engine, the instruction set and the threads of a renderer or of a row.
fn drawn_by(value: &Value) -> (&str, &str, u64) {
    let text = |key: &str| value[key].as_str().unwrap();
    (
        text("engine"),
        text("level"),
        value["threads"].as_u64().unwrap(),
    )
}

fn rows(comparison: &Value) -> &Vec<Value> {
    comparison["rows"].as_array().unwrap()
}

/// Two methods, and as few rounds as possible.
const QUICK: &str = "--time-budget 0 --methods fast-phong,duff-phong";

/// A scene with a positional light. Fast Phong keeps L and V constant over a polygon, and Duff's
/// method interpolates them. Neither uses plane equations.
const NEAR: &str = "builtin:sphere?rings=6&segments=8 --size 64x48 --light-at 2,3,4";

/// `compare` draws with the scalar span engine unless another engine is asked for, and reports the
/// renderer.
#[test]
fn comparisons_name_the_renderer_of_each_row() {
    let folder = Folder::new();
    let best = SimdLevel::best().name();
    let compared = |flags: &str| {
        let ended = folder
            .run(&format!("compare {NEAR} {QUICK} {flags} --json"))
            .done();
        ended.json()["comparisons"][0].clone()
    };
    let is_simd = SimdLevel::best() != SimdLevel::Scalar;
    if !is_simd {
        return;
    }
    let wide = "--engine row --simd auto --threads 2";
    for (flags, asked, rows) in [
        ("", ("span", "scalar", 1), [("span", "scalar", 1); 3]),
        (
            "--threads 2",
            ("span", "scalar", 1),
            [("span", "scalar", 1); 3],
        ),
        (wide, ("row", best, 2), [("row", best, 2); 3]),
        (
            "--engine auto --threads 3",
            ("row", best, 3),
            [("row", best, 3); 3],
        ),
        (
            "--engine row --threads 3",
            ("row", best, 3),
            [("row", best, 3); 3],
        ),
        (
            "--engine span",
            ("span", "scalar", 1),
            [("span", "scalar", 1); 3],
        ),
        (
            "--simd scalar",
            ("span", "scalar", 1),
            [("span", "scalar", 1); 3],
        ),
    ] {
        let comparison = compared(flags);
        assert_eq!(drawn_by(&comparison["renderer"]), asked, "{flags}");
        let drawn: Vec<_> = self::rows(&comparison).iter().map(drawn_by).collect();
        assert_eq!(drawn, rows, "{flags}");
        let other: Vec<_> = comparison["barycentric"]
            .as_array()
            .unwrap()
            .iter()
            .map(drawn_by)
            .collect();
        assert_eq!(other, [("barycentric", "scalar", 1)], "{flags}");
        let timed = |row: &Value| row["speed"].is_object();
        assert!(self::rows(&comparison).iter().all(timed), "{flags}");
    }
    let text = folder.run(&format!("compare {NEAR} {QUICK}")).done();
    text.prints("\ndrawn by the span engine, scalar, 1 thread\n")
        .prints("\n\nThe picture: `duff-phong` draws naive Phong’s picture within 1 grey level in this scene. ")
        .prints("\nScalar code: ");
    let text = folder.run(&format!("compare {NEAR} {QUICK} {wide}")).done();
    text.prints(&format!("\ndrawn by the row engine, {best}, 2 threads\n"));
}

/// Errors are measured on the pictures of the engine that was asked for.
#[test]
fn errors_come_from_the_requested_engine() {
    let folder = Folder::new();
    let errors = |flags: &str| {
        let ended = folder
            .run(&format!(
                "compare teapot --size 160x120 --time-budget 0 {flags} --json"
            ))
            .done();
        let json = ended.json();
        let rms = |row: &Value| row["error"]["rms"].as_f64().unwrap();
        rows(&json["comparisons"][0])
            .iter()
            .map(rms)
            .collect::<Vec<f64>>()
    };
    let lecture = errors("--engine span --simd scalar");
    assert_eq!(errors(""), lecture);
    for level in SimdLevel::available().filter(|level| *level != SimdLevel::Scalar) {
        // Blocks of eight restart their increments, so some bits of the errors must change.
        assert_ne!(errors(&format!("--simd {level}")), lecture, "{level}");
    }
}

#[test]
fn every_instruction_set_is_timed_separately() {
    let folder = Folder::new();
    let ended = folder
        .run(&format!(
            "bench {SPHERE} {QUICK} --simd all --json times.json"
        ))
        .done();
    let document: Value = serde_json::from_slice(&folder.read("times.json")).unwrap();
    let comparisons = document["comparisons"].as_array().unwrap();
    let levels: Vec<&str> = comparisons
        .iter()
        .map(|c| drawn_by(&c["renderer"]).1)
        .collect();
    assert_eq!(
        levels,
        SimdLevel::available()
            .map(SimdLevel::name)
            .collect::<Vec<_>>()
    );
    for comparison in comparisons {
        let (engine, level, threads) = drawn_by(&comparison["renderer"]);
        assert!(rows(comparison).iter().all(|row| row["level"] == level));
        let line = format!("drawn by the {engine} engine, {level}, {threads} thread");
        assert!(ended.out.contains(&line), "{}", ended.out);
    }
    let twice = folder
        .run(&format!(
            "bench {SPHERE} {QUICK} --simd scalar,auto,scalar --json -"
        ))
        .done();
    let expected = if SimdLevel::best() == SimdLevel::Scalar {
        1
    } else {
        2
    };
    assert_eq!(
        twice.json()["comparisons"].as_array().unwrap().len(),
        expected
    );
    // With one engine, `all` stands for the instruction sets of that engine.
    let renderers = |flags: &str| {
        let ended = folder
            .run(&format!("bench {SPHERE} {QUICK} {flags} --json -"))
            .done();
        let comparisons = ended.json()["comparisons"].clone();
        let levels = comparisons.as_array().unwrap().iter();
        levels
            .map(|c| c["renderer"]["level"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(renderers("--engine span --simd all"), ["scalar"]);
    if SimdLevel::best() != SimdLevel::Scalar {
        assert_eq!(renderers("--engine row --simd all"), levels[1..]);
        folder
            .run(&format!("bench {SPHERE} --engine row --simd scalar,auto"))
            .refused(&["the row engine runs on SIMD"]);
    }
    folder
        .run(&format!("bench {SPHERE} --simd scalar,axv2"))
        .refused(&["did you mean `avx2`?"]);
}

/// `--frame-times` prints one line per method, and its JSON has the same values.
#[test]
fn frame_times_are_one_line_per_method() {
    let folder = Folder::new();
    let flags = "--frame-times --frames 3 --warmup 1 --threads 2 --json times.json";
    let ended = folder
        .run(&format!("bench {SPHERE} builtin:cube --size 64x48 {flags}"))
        .done();
    let text = String::from_utf8(folder.read("times.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["schema"], "fastphong.frame-times/2");
    let times = json["frame_times"].as_array().unwrap();
    // Without `--methods` the default methods are timed.
    let expected = METHODS
        .iter()
        .filter(|method| method.info.tier == Tier::Default);
    assert_eq!(times.len(), 2 * expected.clone().count());
    assert_eq!(ended.out.lines().count(), times.len());
    for (line, time) in ended.out.lines().zip(times) {
        let words: Vec<&str> = line.split(' ').collect();
        let after = |key: &str| words[words.iter().position(|word| *word == key).unwrap() + 1];
        assert_eq!(
            (words[0], words[1]),
            (time["input"].as_str().unwrap(), "64x48")
        );
        assert_eq!(words[2], time["method"]);
        assert_eq!(
            (after("engine"), after("level")),
            (
                time["engine"].as_str().unwrap(),
                time["level"].as_str().unwrap()
            )
        );
        for key in ["threads", "frames"] {
            assert_eq!(after(key).parse::<u64>().ok(), time[key].as_u64(), "{line}");
        }
        assert_eq!(
            (&time["frames"], &time["warmup"], &time["threads"]),
            (&3.into(), &1.into(), &2.into())
        );
        let number = |key: &str| time[key].as_f64().unwrap();
        assert!(
            0.0 < number("ms_min")
                && number("ms_min") <= number("ms_typical")
                && number("ms_typical") <= number("ms_median"),
            "{time}"
        );
        // Two threads have no time of their own.
        assert_eq!(time["clock"], "passed");
        assert!(number("interrupted") <= 3.0);
        for key in ["ms_typical", "ms_median", "ms_min", "interrupted"] {
            // The line shows four decimals.
            assert!(
                (after(key).parse::<f64>().unwrap() - number(key)).abs() <= 0.5e-4 + 1e-12,
                "{line}: {time}"
            );
        }
        let alone = text
            .lines()
            .filter(|line| line.contains(&format!("\"ms_median\":{}", time["ms_median"])));
        assert!(
            alone.count() >= 1,
            "{time} does not stand on a line of its own"
        );
        let method = MethodRow::named(time["method"].as_str().unwrap()).unwrap();
        let level = match method.scalar_only() {
            Some(_) => SimdLevel::Scalar,
            None => SimdLevel::best(),
        };
        assert_eq!(
            (&time["level"], &time["reason"]),
            (&level.name().into(), &json!(method.scalar_only()))
        );
    }
    let methods: Vec<&str> = times
        .iter()
        .map(|time| time["method"].as_str().unwrap())
        .collect();
    let expected = expected.map(|entry| entry.info.name);
    assert!(
        methods.iter().copied().eq(expected.clone().chain(expected)),
        "{methods:?}"
    );
}

#[test]
fn frame_times_accept_engines_instruction_sets_and_frame_counts() {
    let folder = Folder::new();
    let quick = "--frame-times --frames 1 --warmup 0 --methods fast-phong";
    let lines = |flags: &str| {
        folder
            .run(&format!("bench {SPHERE} {quick} {flags}"))
            .done()
            .out
    };
    assert!(
        lines("--engine span --simd scalar")
            .contains(" engine span level scalar threads 1 frames 1 interrupted ")
    );
    assert_eq!(
        lines("--simd all").lines().count(),
        SimdLevel::available().count()
    );
    if SimdLevel::best() != SimdLevel::Scalar {
        let duff = "--frame-times --frames 1 --methods duff-phong --engine row";
        folder
            .run(&format!("bench {NEAR} {duff}"))
            .done()
            .prints(&format!(
                " duff-phong engine row level {} ",
                SimdLevel::best()
            ));
        folder
            .run(&format!("bench {NEAR} {duff} --depth per-sample"))
            .done()
            .prints(" duff-phong engine span level scalar ")
            .says(
                "duff-phong is drawn by the span engine, scalar: the row engine interpolates depth",
            );
    }
    for (flags, part) in [
        (
            "--frame-times --frames 0",
            "expected a number of frames from 1 to 1000000",
        ),
        (
            "--frame-times --frames many",
            "expected a number of frames from 1 to 1000000",
        ),
        (
            "--frame-times --warmup -1",
            "expected a number of frames from 0 to 1000000",
        ),
        ("--frame-times --time-budget 1", "cannot be used with"),
        ("--frames 3", "--frame-times"),
        ("--warmup 3", "--frame-times"),
    ] {
        folder
            .run(&format!("bench {SPHERE} {flags}"))
            .refused(&[part]);
    }
    folder
        .run("bench taepot --frame-times")
        .refused(&["did you mean `teapot`?"]);
}

/// Writes triangles of two colours in one plane, seen from in front. Their depths are equal up to
/// rounding.
fn coplanar(folder: &Folder) {
    let (mut vertices, mut faces) = (String::from("mtllib plane.mtl\n"), String::new());
    // Corners within −1..1, by a linear congruence.
    let mut state = 7_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 23) - 1.0
    };
    for number in 0..14 {
        for _ in 0..3 {
            let [x, y] = [random(), random()];
            vertices += &format!("v {x:.7} {y:.7} {:.7}\n", 0.37 * x + 0.71 * y);
        }
        let material = if number < 7 { "red" } else { "blue" };
        let first = 3 * number + 1;
        faces += &format!("usemtl {material}\nf {first} {} {}\n", first + 1, first + 2);
    }
    folder
        .write("plane.obj", vertices + &faces)
        .write("plane.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
}

/// Where depths are equal up to rounding, engines and instruction sets show different polygons.
/// Each row's error counts only pixels that show the reference's polygon. Elsewhere a shade of red
/// would be compared with a shade of blue.
#[test]
fn each_engine_is_compared_where_it_shows_the_polygon_of_the_reference() {
    let folder = Folder::new();
    coplanar(&folder);
    let methods = "naive-phong,flat,slerp-phong,fast-phong:steps=2";
    let scene = "plane.obj --size 120x90 --cull none --normals crease=10";
    for flags in [
        "",
        "--samples 2",
        "--depth-bits 16",
        "--visibility painter",
        "--light-at 1,2,9",
    ] {
        let mut others = 0;
        for level in SimdLevel::available() {
            let arguments = format!(
                "compare {scene} {flags} --simd {} -m {methods} --time-budget 0 --json",
                level.name()
            );
            let compared = folder.run(&arguments).done().json()["comparisons"][0].clone();
            let barycentric = compared["barycentric"].as_array().expect("a list");
            for row in rows(&compared).iter().chain(barycentric) {
                assert_eq!(row["within_bound"], true, "{arguments}: {row}");
                let count = row["other_polygon"].as_u64().expect("a number");
                assert_eq!(row["error"]["excluded"], count, "{arguments}: {row}");
                others += count;
            }
        }
        // The painter draws in the same order everywhere.
        let is_painted = flags.contains("painter");
        assert_eq!(others > 0, !is_painted, "{flags}: {others}");
    }
}

/// A table explains the mark of rows that miss their closed form only if one of its rows has the
/// mark.
#[test]
fn the_legend_of_the_mark_stands_only_under_tables_with_marked_rows() {
    let folder = Folder::new();
    coplanar(&folder);
    // One step is too few for edges of large angles.
    let missed = "builtin:sphere?rings=4&segments=5 -m fast-phong:steps=1";
    for (scene, is_marked) in [("plane.obj -m naive-phong,flat", false), (missed, true)] {
        for command in ["compare", "compare --all-columns", "bench"] {
            let arguments = format!("{command} {scene} --size 60x40 --time-budget 0");
            let text = folder.run(&arguments).done().out;
            let lines = || text.lines();
            let has_legend = lines().any(|line| line.starts_with("! farther"));
            let has_mark = lines().any(|line| line.contains('!') && !line.starts_with('!'));
            assert_eq!((has_legend, has_mark), (is_marked, is_marked), "{text}");
        }
    }
}

/// Returns how many gigabytes of memory and swap are free.
#[cfg(target_os = "linux")]
fn free_gigabytes() -> u64 {
    let memory = std::fs::read_to_string("/proc/meminfo").expect("Linux tells");
    let gigabytes = |key: &str| {
        let kilobytes = memory
            .lines()
            .find_map(|line| line.strip_prefix(key))
            .and_then(|text| text.split_whitespace().next());
        kilobytes.map_or(0, |text| text.parse::<u64>().expect("a number") / 1_000_000)
    };
    gigabytes("MemAvailable:") + gigabytes("SwapFree:")
}

/// The reference keeps more than eighty bytes per pixel.
#[cfg(target_os = "linux")]
#[test]
fn a_reference_that_does_not_fit_into_memory_is_not_begun() {
    if free_gigabytes() > 20 {
        return; // this machine has the memory and would draw it
    }
    let folder = Folder::new();
    folder
        .run("render builtin:cube --size 16384x16384 -m reference -o out.png")
        .refused(&["16384x16384: reference needs about 21.5 GB of memory, but "]);
    assert!(folder.names().is_empty());
}

/// If a picture fits into memory but its comparison does not, the tool says so before it draws
/// anything, and the system never has to kill it.
#[cfg(target_os = "linux")]
#[test]
fn comparisons_check_and_report_the_memory_that_they_need() {
    if free_gigabytes() > 90 {
        return; // this machine has the memory and would draw it
    }
    let folder = Folder::new();
    for command in ["compare", "bench", "report --full"] {
        folder
            .run(&format!("{command} builtin:cube --size 16384x16384"))
            .refused(&[
                "16384x16384: comparing needs about ",
                " GB of memory, but ",
                " GB are free: expected fewer pixels or samples, or fewer methods",
            ]);
    }
}

/// `--spans` times every method at every length, with one light and with four.
#[test]
fn spans_are_timed_at_every_length() {
    let folder = Folder::new();
    let ended = folder.run("bench --spans -m gouraud,naive-phong --json spans.json");
    let text = ended.done().out;
    let json: Value = serde_json::from_slice(&folder.read("spans.json")).unwrap();
    assert_eq!(json["schema"], "fastphong.spans/2");
    let (lengths, spans) = (json["lengths"].as_array(), json["spans"].as_array());
    let (lengths, spans) = (lengths.unwrap(), spans.unwrap());
    assert_eq!((lengths.len(), spans.len()), (11, 4));
    for span in spans {
        let ns: Vec<f64> = span["ns"]
            .as_array()
            .unwrap()
            .iter()
            .map(|ns| ns.as_f64().unwrap())
            .collect();
        assert_eq!(ns.len(), lengths.len());
        assert!(ns[10] > ns[0] && ns[0] > 0.0, "{ns:?}");
    }
    assert_eq!(text.lines().count(), 1 + spans.len() + 1);
    let sentence = json["noise"]["sentence"].as_str().unwrap();
    assert_eq!(text.lines().last(), Some(sentence));
    folder
        .run("bench teapot --spans")
        .refused(&["cannot be used with"]);
}
