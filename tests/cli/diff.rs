//! `fastphong diff`: metrics, thresholds, maps.

use super::{Folder, SPHERE, picture};
use fastphong::compare::metrics::METRICS;
use fastphong::picture::Picture8;
use fastphong::picture::image_file::{FilePicture, write_picture};

/// The colour of a pixel beyond the map's scale.
const BEYOND: [u8; 4] = [255, 0, 255, 255];
/// The colour, on a signed map, of a pixel too dark by more than the scale.
const BEYOND_DARKER: [u8; 4] = [0, 255, 0, 255];

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
fn maps_show_where_pictures_differ() {
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
        BEYOND,
        "20 levels are beyond the default scale"
    );
    folder.run("diff a.png b.png -o map.png --scale 40").done();
    assert_ne!(lit("map.png"), BEYOND);
    folder
        .run("diff b.png a.png -o signed.ppm --signed --scale 4")
        .done();
    assert_eq!(lit("signed.ppm"), BEYOND_DARKER);
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
        .write("cut.ppm", "P6 2 1 255\nabc")
        .write("text.png", "text")
        .write("empty.png", "")
        .write("photo.png", b"\xff\xd8\xff\xe0\0\x10JFIF\0\x01")
        .write("bomb.ppm", "P6 65536 65536 255\nabc");
    folder
        .run("diff a.png empty.png")
        .refused(&["empty.png: the file is empty"]);
    folder.run("diff photo.png a.png").refused(&[
        "photo.png: it is a JPEG file, which is not read",
        "expected PNG",
    ]);
    folder
        .run("diff bomb.ppm a.png")
        .refused(&["bomb.ppm: 65536×65536 pixels are too many"]);
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
fn flip_of_a_comparison_equals_flip_of_the_rendered_files() {
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

/// Metrics of the common corner would say nothing about the pictures, so `diff` prints none. The
/// map still shows the upper left part that both pictures have.
#[test]
fn pictures_of_different_size_have_no_metrics_and_a_map_of_their_common_part() {
    let folder = pair();
    folder.write("small.ppm", [&b"P6 4 9 255\n"[..], &[100; 108]].concat());
    let sizes = "the sizes differ: the reference has 16x12 pixels, the picture 4x9";
    let ended = folder
        .run("diff a.png small.ppm")
        .differs()
        .says("the pictures differ in size")
        .prints(sizes);
    assert_eq!(
        ended.out.lines().count(),
        2,
        "sizes and encodings: {}",
        ended.out
    );
    // This holds even if the common corner is equal to the bit.
    folder
        .run("render builtin:cube --size 16x12 -o one.png")
        .done();
    folder
        .run("render builtin:cube --size 16x13 -o two.png")
        .done();
    let ended = folder.run("diff one.png two.png").differs();
    assert!(!ended.out.contains("max"), "{}", ended.out);
    folder
        .run("diff b.png small.ppm -o map.png --fail-above 255")
        .differs()
        .prints(&format!(
            "{sizes}; the map shows the upper left part that both have, 4x9"
        ));
    let map = picture(&folder.path("map.png"));
    assert_eq!((map.width(), map.height()), (4, 9));
    assert_ne!(map.get(3, 7)[..3], [0; 3]);
    let json = folder.run("diff a.png small.ppm --json").differs().json();
    assert_eq!(
        (&json["equal"], &json["failed"]),
        (&false.into(), &true.into())
    );
    let sizes = [&json["reference_size"], &json["actual_size"]];
    assert_eq!(
        sizes,
        [&serde_json::json!([16, 12]), &serde_json::json!([4, 9])]
    );
    assert_eq!((&json["width"], &json["height"]), (&4.into(), &9.into()));
    let metrics = json["metrics"].as_object().expect("metrics");
    assert!(metrics.len() > 5 && metrics.values().all(serde_json::Value::is_null));
    assert!(json["worst"].is_null());
}

/// PNG states its encoding, and PFM counts as linear, so a drawing is the same picture in both
/// formats.
#[test]
fn one_drawing_is_the_same_picture_in_several_formats() {
    let folder = Folder::new();
    // A mesh without a scene is sRGB and opaque; a scene is linear and has alpha. Supersampled rims
    // have straight alpha in PNG.
    for (scene, encoding) in [
        ("builtin:cube --size 64x48", "srgb"),
        (SPHERE, "linear"),
        (
            "builtin:gear --size 64x48 --alpha coverage --samples 1",
            "srgb",
        ),
    ] {
        for format in ["png", "ppm", "pfm"] {
            folder.run(&format!("render {scene} -o a.{format}")).done();
        }
        let diff = folder.run("diff a.png a.pfm").done();
        let stated =
            format!("encodings: a.png states {encoding}; a.pfm states none, linear is assumed");
        let json = folder.run("diff a.png a.pfm --json").done().json();
        // Half a level from the PNG, and from the floats 2⁻²⁴ of 255 on either side.
        let most = json["metrics"]["max"].as_f64().unwrap();
        assert!(
            0.1 < most && most <= 0.5 + 2.0 * 255.0 / f64::from(1 << 24),
            "{scene}: {most}"
        );
        assert_eq!(json["reference_encoding"], encoding);
        assert_eq!(
            (&json["actual_encoding"], &json["actual_encoding_assumed"]),
            (&"linear".into(), &true.into())
        );
        diff.prints(&stated);
        // A PPM file does not state its encoding. With the right one, the same bytes are the same
        // picture.
        let equal = format!("diff a.png a.ppm --assume {encoding} --fail-above 0");
        folder.run(&equal).done().prints("the pictures are equal");
        folder.run("diff a.ppm a.png --json").done();
    }
    // `diff` draws the rims of a picture with straight alpha over its background. Colour and alpha
    // were each rounded by up to 0.5 levels.
    let scene =
        "builtin:gear --size 64x48 --alpha coverage --samples 4 --encoding linear --background 0.5";
    for format in ["png", "pfm"] {
        folder.run(&format!("render {scene} -o a.{format}")).done();
    }
    let diff = folder.run("diff a.png a.pfm --fail-above 1.01").done();
    diff.says("warning: a.pfm has no alpha: a.png is drawn over the background that it states");
    let rims = picture(&folder.path("a.png"));
    assert!(
        rims.pixels()
            .iter()
            .any(|pixel| (1..255).contains(&pixel[3]))
    );
}

#[test]
fn a_flag_states_the_encoding_of_files_that_state_none() {
    let folder = Folder::new();
    folder.write("a.pgm", "P2 1 1 255 188").write(
        "b.pfm",
        [&b"Pf 1 1 -1\n"[..], &0.5f32.to_le_bytes()].concat(),
    );
    let most = |flags: &str| {
        let json = folder
            .run(&format!("diff a.pgm b.pfm --json {flags}"))
            .done()
            .json();
        (
            json["metrics"]["max"].as_f64().unwrap(),
            json["compared_encoding"].clone(),
        )
    };
    // sRGB of one half is 187.516.
    let (levels, encoding) = most("");
    assert!(
        (levels - 0.484).abs() < 1e-3 && encoding == "srgb",
        "{levels}"
    );
    for (assumed, expected) in [("linear", "linear"), ("srgb", "srgb")] {
        assert_eq!(
            most(&format!("--assume {assumed}")),
            (60.5, expected.into())
        );
    }
    let text = folder.run("diff a.pgm b.pfm").done();
    text.prints("encodings: a.pgm states none, srgb is assumed; b.pfm states none, linear is assumed; the linear picture was encoded");
    folder
        .run("diff a.pgm b.pfm --assume gamma")
        .refused(&["--assume", "expected linear or srgb"]);
}

#[test]
fn differences_below_a_level_are_seen_in_samples_of_16_bits() {
    let folder = Folder::new();
    folder
        .write("a.ppm", b"P6 1 1 65535 \x80\x00\x80\x00\x80\x00")
        .write("b.ppm", b"P6 1 1 65535 \x80\x55\x80\x00\x80\x00");
    folder.run("diff a.ppm b.ppm --fail-above 0.33").differs();
    folder.run("diff a.ppm b.ppm --fail-above 0.34").done();
    folder.run("diff a.ppm a.ppm --fail-above 0").done();
}

/// NaN equals NaN and an infinity equals itself. Against anything else, no threshold lets them
/// pass.
#[test]
fn values_that_are_not_finite_equal_only_themselves() {
    let folder = Folder::new();
    let float = |c: f32| [&b"Pf 2 1 -1\n"[..], &c.to_le_bytes(), &[0; 4]].concat();
    let kinds = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, -3.0];
    for (i, c) in kinds.into_iter().enumerate() {
        folder.write(&format!("{i}.pfm"), float(c));
    }
    for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
        let ended = folder.run(&format!("diff {i}.pfm {j}.pfm --fail-above 1e30"));
        if i == j {
            ended.done().prints("the pictures are equal");
        } else if i < 3 || j < 3 {
            ended
                .differs()
                .says("infinite or not a number in one of them, which no threshold allows");
        } else {
            ended.differs().says("grey levels, more than");
        }
    }
}

#[test]
fn a_picture_is_read_from_standard_input() {
    let folder = pair();
    let piped = |arguments: &str, file: &str| {
        let mut command = folder.command(arguments);
        command.stdin(std::fs::File::open(folder.path(file)).unwrap());
        super::Ended::new(arguments, command.output().unwrap())
    };
    piped("diff - b.png", "a.png").done().prints("20  levels");
    piped("diff a.png -", "a.png")
        .done()
        .prints("the pictures are equal");
    folder.write("text", "text");
    piped("diff - b.png", "text").refused(&["standard input: not a picture that can be read"]);
    folder
        .run("diff - b.png")
        .refused(&["standard input: the file is empty"]);
    folder
        .run("diff - -")
        .refused(&["standard input holds one picture"]);
}

#[test]
fn notes_about_a_file_are_warnings() {
    let folder = Folder::new();
    folder.write("two.ppm", "P6 1 1 255\nabcP6 1 1 255\nxyz");
    let ended = folder.run("diff two.ppm two.ppm").done();
    ended.says("warning: two.ppm: the file holds several pictures: this is the first");
}

/// Against a file without alpha, which is opaque, a picture with alpha 127 differs.
#[test]
fn a_picture_without_alpha_counts_as_opaque() {
    let folder = Folder::new();
    let pixel = |alpha| Picture8::new(2, 2, [10, 20, 30, alpha]);
    for (name, alpha) in [("half.png", 127), ("none.png", 0), ("full.png", 255)] {
        write_picture(&folder.path(name), &FilePicture::stored(pixel(alpha))).unwrap();
    }
    folder.write(
        "opaque.ppm",
        b"P6 2 2 255 \x0a\x14\x1e\x0a\x14\x1e\x0a\x14\x1e\x0a\x14\x1e",
    );
    for (name, code) in [("half.png", 1), ("none.png", 1), ("full.png", 0)] {
        let ended = folder.run(&format!("diff {name} opaque.ppm --fail-above 0"));
        assert_eq!(
            ended.code,
            Some(code),
            "{name}: {} {}",
            ended.out,
            ended.err
        );
    }
}

/// Values that would fill a line with digits are printed with an exponent.
#[test]
fn huge_differences_have_few_digits() {
    let folder = Folder::new();
    let pfm = |value: f32| [b"PF\n1 1\n-1\n".as_slice(), &value.to_le_bytes().repeat(3)].concat();
    folder.write("a.pfm", pfm(3e38));
    folder.write("b.pfm", pfm(-3e38));
    let ended = folder.run("diff a.pfm b.pfm --fail-above 1");
    assert!(ended.out.contains("1.5300e41"), "{}", ended.out);
    let ended = ended.says("by 1.5300e41 grey levels");
    let words = ended
        .out
        .split_whitespace()
        .chain(ended.err.split_whitespace());
    for word in words {
        let digits = word.bytes().filter(u8::is_ascii_digit).count();
        assert!(digits < 20, "{word}");
    }
}
