//! `fastphong diff`: metrics, thresholds, maps.

use super::{Folder, picture};
use fastphong::compare::metrics::METRICS;
use fastphong::picture::Picture8;
use fastphong::picture::image_file::{FilePicture, write_picture};

/// Writes two pictures of 16 × 12 pixels that differ by 20 levels in one channel of one pixel.
fn pair() -> Folder {
    let folder = Folder::new();
    let mut picture = Picture8::new(16, 12, [100, 100, 100, 255]);
    write_picture(&folder.path("a.png"), &FilePicture::stored(picture.clone())).unwrap();
    picture.row_mut(7)[3] = [100, 120, 100, 255];
    write_picture(&folder.path("b.png"), &FilePicture::stored(picture)).unwrap();
    folder
}

#[test]
fn every_metric_is_printed() {
    let folder = pair();
    let ended = folder.run("diff a.png b.png").done();
    for metric in METRICS {
        assert!(
            ended.out.lines().any(|line| line.starts_with(metric.name)),
            "{}: {}",
            metric.name,
            ended.out
        );
    }
    ended
        .prints("max")
        .prints("20  levels")
        .prints("the largest difference is at column 3, row 7");
    folder
        .run("diff a.png a.png")
        .done()
        .prints("the pictures are equal")
        .prints("inf  dB");
}

#[test]
fn the_threshold_decides_the_exit_code() {
    let folder = pair();
    folder.run("diff a.png b.png --fail-above 20").done();
    folder
        .run("diff a.png b.png --fail-above 19.5")
        .differs()
        .says("differ by 20.0000 grey levels, more than 19.5");
    folder
        .run("diff a.png b.png --fail-above 0 --quiet")
        .differs();
    folder.run("diff a.png a.png --fail-above 0").done();
    for bad in ["-1", "nan", "lots"] {
        let ended = folder.run(&format!("diff a.png b.png --fail-above {bad}"));
        ended.refused(&["--fail-above", "expected grey levels: a number, 0 or more"]);
    }
}

#[test]
fn json_holds_every_metric() {
    let folder = pair();
    let json = folder
        .run("diff a.png b.png --json --fail-above 5")
        .differs()
        .json();
    assert_eq!(json["schema"], "fastphong.diff/1");
    assert_eq!((&json["width"], &json["height"]), (&16.into(), &12.into()));
    assert_eq!(
        (&json["equal"], &json["failed"]),
        (&false.into(), &true.into())
    );
    assert_eq!(json["worst"], serde_json::json!([3, 7]));
    assert_eq!(
        json["metrics"]["max"]
            .as_f64()
            .map(|max| (max * 1e9).round() / 1e9),
        Some(20.0)
    );
    assert_eq!(
        json["metrics"].as_object().map(serde_json::Map::len),
        Some(METRICS.len())
    );
    let json = folder.run("diff a.png a.png --json").done().json();
    assert_eq!(
        (&json["equal"], &json["metrics"]["psnr"]),
        (&true.into(), &serde_json::Value::Null)
    );
    assert_eq!(json["failed"], serde_json::Value::Null);
}

#[test]
fn maps_show_where() {
    let folder = pair();
    let lit = |name: &str| {
        let map = picture(&folder.path(name));
        let lit = map
            .pixels()
            .iter()
            .filter(|pixel| pixel[..3] != [0; 3])
            .count();
        assert_eq!((map.width(), map.height(), lit), (16, 12, 1), "{name}");
        map.get(3, 7)
    };
    folder.run("diff a.png b.png -o beyond.png").done();
    assert_eq!(
        lit("beyond.png"),
        fastphong::compare::metrics::BEYOND,
        "20 levels are beyond the default scale"
    );
    folder.run("diff a.png b.png -o map.png --scale 40").done();
    assert_ne!(lit("map.png"), fastphong::compare::metrics::BEYOND);
    folder
        .run("diff b.png a.png -o signed.ppm --signed --scale 4")
        .done();
    assert_eq!(
        lit("signed.ppm"),
        fastphong::compare::metrics::BEYOND_DARKER
    );
    folder.run("diff a.png b.png -o flip.png --flip").done();
    let map = picture(&folder.path("flip.png"));
    let level = |x, y| {
        map.get(x, y)[..3]
            .iter()
            .map(|c| u32::from(*c))
            .sum::<u32>()
    };
    assert!(
        level(3, 7) > level(5, 7) && level(5, 7) > level(15, 0),
        "it spreads"
    );
    assert_eq!(map.get(15, 0), [0, 0, 4, 255], "magma begins nearly black");
    folder
        .run("diff a.png b.png -o map.png --flip --scale 4")
        .refused(&["--scale <GREY_LEVELS>"]);
    let piped = folder
        .run("diff a.png b.png -o - --scale 40")
        .done()
        .says("levels");
    assert_eq!(piped.bytes, folder.read("map.png"));
    folder
        .run("diff a.png b.png -o map.png --scale 0")
        .refused(&["expected grey levels: a number over 0"]);
    folder
        .run("diff a.png b.png --signed")
        .refused(&["--output <FILE>"]);
    folder
        .run("diff a.png b.png -o gone/map.png")
        .refused(&["gone/map.png: cannot be written"]);
}

#[test]
fn pictures_that_cannot_be_compared_are_errors() {
    let folder = pair();
    folder
        .write("small.ppm", "P6 2 1 255\nabcdef")
        .write("cut.ppm", "P6 2 1 255\nabc")
        .write("text.png", "text");
    folder
        .run("diff a.png small.ppm")
        .refused(&["16×12", "2×1", "expected the same size"]);
    folder
        .run("diff a.png gone.png")
        .refused(&["gone.png: cannot be read"]);
    folder
        .run("diff cut.ppm a.png")
        .refused(&["cut.ppm: broken PPM file"]);
    folder
        .run("diff text.png a.png")
        .refused(&["text.png: not a picture that can be read"]);
    folder.run("diff a.png").refused(&["<ACTUAL>"]);
}

#[test]
fn flip_of_a_comparison_is_that_of_the_rendered_files() {
    let folder = Folder::new();
    let scene = "teapot --size 64x48";
    for (method, file) in [("reference", "r.png"), ("gouraud --simd scalar", "g.png")] {
        let command = format!("render {scene} --method {method} -o {file}");
        folder.run(&command).done();
    }
    let diff = folder.run("diff r.png g.png --json").done().json();
    let flip = diff["metrics"]["flip"].as_f64().unwrap();
    assert!(flip > 0.001, "Gouraud shading can be seen: {flip}");
    let compare = format!("compare {scene} --methods gouraud --time-budget 0");
    let json = folder.run(&format!("{compare} --json")).done().json();
    let rows = json["comparisons"][0]["rows"].as_array().unwrap();
    let row = rows.iter().find(|row| row["variant"] == "gouraud").unwrap();
    let compared = row["error"]["flip"].as_f64().unwrap();
    // The reference may round to another level in a pixel or two of 3072.
    assert!((flip - compared).abs() < 1e-4, "{flip}, {compared}");
    folder
        .run(&format!("{compare} --all-columns"))
        .done()
        .prints("FLIP");
}
