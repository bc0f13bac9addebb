//! What `diff` and `render --reference` let pass: counts, radii, masks and regions. And how they
//! describe differences: by their spread and the largest region.

use super::{Folder, SPHERE, picture};
use fastphong::picture::Picture8;
use fastphong::picture::image_file::{FilePicture, write_picture};
use serde_json::{Value, json};

const GREY: [u8; 4] = [100, 100, 100, 255];
/// The colour of pixels that are left out, on a map.
const LEFT_OUT: [u8; 4] = [48, 48, 48, 255];
/// The colour of the frame around a region.
const FRAME: [u8; 4] = [0, 255, 255, 255];

fn write(folder: &Folder, name: &str, picture: &Picture8) {
    write_picture(&folder.path(name), &FilePicture::stored(picture.clone())).unwrap();
}

/// Writes two pictures of 16 × 12 grey pixels, `a.png` and `b.png`. In `b.png` a block of 3 × 2
/// pixels differs by 20 levels, one of them by 40, and one pixel far away differs by 10.
fn pair() -> Folder {
    let folder = Folder::new();
    let mut picture = Picture8::new(16, 12, GREY);
    write(&folder, "a.png", &picture);
    for (x, y) in [(3, 6), (4, 6), (5, 6), (3, 7), (4, 7), (5, 7)] {
        picture.row_mut(y)[x] = [100, 120, 100, 255];
    }
    picture.row_mut(7)[4] = [100, 60, 100, 255];
    picture.row_mut(1)[14] = [100, 100, 110, 255];
    write(&folder, "b.png", &picture);
    folder
}

#[test]
fn a_count_of_pixels_may_be_over_the_threshold() {
    let folder = pair();
    let diff = |flags: &str| folder.run(&format!("diff a.png b.png {flags}"));
    let count = "over 15 grey levels: 6 of 192 compared pixels (3.12 %)";
    diff("--fail-above 15")
        .differs()
        .prints(count)
        .says("by 40.0000 grey levels, more than 15, in 6 of 192 compared pixels (3.12 %)\n");
    diff("--fail-above 15 --allow 6")
        .done()
        .prints(&format!("{count}, 6 allowed\n"));
    diff("--fail-above 15 --allow 5")
        .differs()
        .prints(&format!("{count}, 5 allowed\n"))
        .says("in 6 of 192 compared pixels (3.12 %), 5 allowed");
    // 6 of 192 are 3.125 %.
    diff("--fail-above 15 --allow 3.125%").done();
    diff("--fail-above 15 --allow 3.124%").differs();
    diff("--fail-above 5 --allow 6").differs();
    diff("--fail-above 5 --allow 7").done();
    diff("--fail-above 40")
        .done()
        .prints("over 40 grey levels: 0 of 192");
    diff("--allow 6").refused(&[
        "`--allow` counts pixels over a threshold, but there is none",
        "expected `--fail-above GREY_LEVELS` too",
    ]);
    for bad in ["-1", "1.5", "101%", "99999999999999999999", "many"] {
        diff(&format!("--fail-above 1 --allow {bad}")).refused(&[
            "--allow",
            "expected a number of pixels, or a percentage from 0% to 100%",
        ]);
    }
}

#[test]
fn the_spread_of_differences_and_the_largest_region_are_printed() {
    let folder = pair();
    let ended = folder.run("diff a.png b.png").done();
    ended
        .prints("192 compared pixels:\n")
        .prints("equal                 185  96.35 %")
        .prints("over 8 to 16 levels     1   0.52 %")
        .prints("over 16 to 32 levels    5   2.60 %")
        .prints("over 32 to 64 levels    1   0.52 %")
        .prints(
            "largest region: 6 pixels within 3x2 at column 3, row 6, most at column 4, row 7: 40 grey levels",
        );
    let json = |flags: &str| {
        folder
            .run(&format!("diff a.png b.png --json {flags}"))
            .json()
    };
    let found = json("--fail-above 5 --allow 1%");
    let pixels = |found: &Value| -> Vec<u64> {
        let bins = found["histogram"].as_array().expect("bins");
        bins.iter()
            .map(|bin| bin["pixels"].as_u64().unwrap())
            .collect()
    };
    assert_eq!(pixels(&found), [185, 0, 0, 0, 0, 0, 1, 5, 1, 0, 0]);
    assert_eq!(
        found["histogram"][6],
        json!({ "over": 8.0, "up_to": 16.0, "pixels": 1 })
    );
    assert_eq!(
        (&found["over"], &found["compared"]),
        (&json!(7), &json!(192))
    );
    assert_eq!(
        (&found["allow"], &found["failed"]),
        (&json!("1%"), &json!(true))
    );
    assert_eq!(found["largest"], json!({ "levels": 40.0, "at": [4, 7] }));
    let region =
        json!({ "pixels": 6, "corner": [3, 6], "size": [3, 2], "worst": [4, 7], "levels": 40.0 });
    assert_eq!(found["largest_region"], region);
    // With a threshold, the region holds only pixels over it.
    assert_eq!(
        json("--fail-above 30")["largest_region"]["size"],
        json!([1, 1])
    );
    assert_eq!(json("--fail-above 50")["largest_region"], Value::Null);
    let none = json("");
    assert_eq!(
        (&none["over"], &none["allow"], &none["radius"]),
        (&Value::Null, &Value::Null, &json!(0))
    );
    let equal = folder.run("diff a.png a.png").done();
    assert!(!equal.out.contains("compared pixels"), "{}", equal.out);
}

#[test]
fn edges_may_move_within_a_radius_but_lines_may_not_vanish() {
    let folder = Folder::new();
    let edge = |x: usize| {
        let mut picture = Picture8::new(16, 12, GREY);
        (0..12).for_each(|y| picture.row_mut(y)[x..].fill([200; 4]));
        picture
    };
    write(&folder, "a.png", &edge(8));
    write(&folder, "b.png", &edge(9));
    let diff = |flags: &str| folder.run(&format!("diff a.png b.png --fail-above 2 {flags}"));
    diff("")
        .differs()
        .says("in 12 of 192 compared pixels (6.25 %)");
    diff("--radius 0").differs();
    diff("--radius 1")
        .done()
        .prints("192 compared pixels, within a radius of 1 pixel:")
        .prints("equal  192  100.00 %");
    let mut line = edge(16);
    (0..12).for_each(|y| line.row_mut(y)[4] = [255; 4]);
    write(&folder, "line.png", &line);
    write(&folder, "none.png", &edge(16));
    for pictures in ["line.png none.png", "none.png line.png"] {
        let flags = "--fail-above 2 --radius 8 -o map.png";
        let ended = folder.run(&format!("diff {pictures} {flags}")).differs();
        ended.says("in 12 of 192 compared pixels (6.25 %), within a radius of 8 pixels");
        let map = picture(&folder.path("map.png"));
        assert!(map.get(4, 3)[..3] != [0; 3] && map.get(3, 3)[..3] == [0; 3]);
    }
    diff("--radius 1 -o map.png").done();
    let map = picture(&folder.path("map.png"));
    assert!(map.pixels().iter().all(|pixel| pixel[..3] == [0; 3]));
    for other in ["--signed", "--flip"] {
        let ended = diff(&format!("--radius 1 -o map.png {other}"));
        ended.refused(&[other, "expected no `--radius`"]);
    }
    for bad in ["-1", "9", "0.5"] {
        diff(&format!("--radius {bad}")).refused(&["--radius", "expected whole pixels, 0 to 8"]);
    }
}

#[test]
fn pixels_outside_of_a_region_or_black_in_a_mask_are_left_out() {
    let folder = pair();
    let diff = |flags: &str| folder.run(&format!("diff a.png b.png --fail-above 5 {flags}"));
    diff("--region 0,0,16,6")
        .differs()
        .says("in 1 of 96 compared pixels");
    diff("--region 0,0,14,6")
        .done()
        .prints("84 compared pixels, 108 left out:");
    diff("--region 3,6,3,2")
        .differs()
        .says("in 6 of 6 compared pixels (100.00 %)");
    for beyond in [
        "0,0,17,1",
        "15,11,1,2",
        "16,0,1,1",
        "0,0,18446744073709551615,1",
    ] {
        diff(&format!("--region {beyond}")).refused(&[
            "`--region` reaches beyond the picture of 16x12 pixels",
            "expected a part of it",
        ]);
    }
    for bad in ["0,0,0,4", "1,2,3", "1,2,3,4,5", "-1,0,2,2", "a"] {
        diff(&format!("--region {bad}"))
            .refused(&["expected column, row, width and height, such as 0,0,64,48"]);
    }
    let mut mask = Picture8::new(16, 12, [255; 4]);
    for y in 6..8 {
        mask.row_mut(y)[3..6].fill([0, 0, 0, 255]);
    }
    mask.row_mut(1)[14] = [9, 9, 9, 0];
    write(&folder, "mask.png", &mask);
    diff("--mask mask.png")
        .done()
        .prints("185 compared pixels, 7 left out:");
    // Almost black is not black.
    mask.row_mut(1)[14] = [0, 0, 1, 255];
    write(&folder, "mask.png", &mask);
    let ended = diff("--mask mask.png -o map.png --json").differs();
    assert_eq!(
        (&ended.json()["left_out"], &ended.json()["mask"]),
        (&json!(6), &json!("mask.png"))
    );
    let metrics = &ended.json()["metrics"];
    assert_eq!(
        metrics["differing"],
        json!(1.0),
        "metrics leave them out, too"
    );
    let map = picture(&folder.path("map.png"));
    assert_eq!((map.get(4, 7), map.get(0, 0)), (LEFT_OUT, [0, 0, 0, 255]));
    // Metrics of neighbourhoods treat left-out pixels as equal.
    mask.row_mut(1)[14] = [0, 0, 0, 255];
    write(&folder, "mask.png", &mask);
    let json = diff("--mask mask.png --json").done().json();
    assert_eq!(
        (&json["metrics"]["ssim"], &json["metrics"]["flip"]),
        (&json!(1.0), &json!(0.0))
    );
    write(&folder, "black.png", &Picture8::new(16, 12, [0, 0, 0, 255]));
    diff("--mask black.png")
        .refused(&["the mask leaves out every pixel, so that nothing is compared"]);
    write(&folder, "small.png", &Picture8::new(12, 16, [255; 4]));
    diff("--mask small.png").refused(&[
        "the mask small.png has 12x16 pixels, the pictures 16x12",
        "expected the same size",
    ]);
    diff("--mask gone.png").refused(&["gone.png: cannot be read"]);
    diff("--mask mask.png -o mask.png").refused(&["`--output` is the mask itself"]);
}

#[test]
fn a_frame_shows_the_largest_region_on_the_map() {
    let folder = pair();
    let framed = |flags: &str| {
        folder
            .run(&format!("diff a.png b.png -o map.png {flags}"))
            .done();
        let map = picture(&folder.path("map.png"));
        let is_frame = |pixel: &&[u8; 4]| **pixel == FRAME;
        (map.pixels().iter().filter(is_frame).count(), map.get(2, 5))
    };
    assert_eq!(framed("").0, 0);
    // The frame around a rectangle of 3 × 2 is 5 × 4 pixels without the middle.
    for flags in ["--frame", "--frame --signed", "--frame --flip"] {
        assert_eq!(framed(flags), (14, FRAME), "{flags}");
    }
    folder
        .run("diff a.png b.png --frame")
        .refused(&["--output <FILE>"]);
}

#[test]
fn a_rendered_picture_is_judged_by_the_same_flags() {
    let folder = Folder::new();
    folder.run(&format!("render {SPHERE} -o ref.png")).done();
    let mut changed = picture(&folder.path("ref.png"));
    let pixel = changed.get(32, 24);
    changed.row_mut(24)[32] = [pixel[0] - 9, pixel[1], pixel[2], 255];
    write(&folder, "ref.png", &changed);
    let check = |flags: &str| folder.run(&format!("render {SPHERE} --reference ref.png {flags}"));
    check("")
        .differs()
        .prints("differs by 9.0000 grey levels, more than 1, in 1 of ")
        .prints("\nover 8 to 16 levels")
        .prints("largest region: 1 pixel within 1x1 at column 32, row 24");
    check("--allow 1")
        .done()
        .prints("ref.png: accepted: 1 of ")
        .prints("are over 1 grey levels, 1 allowed: largest difference 9 grey levels");
    check("--reference-threshold 9")
        .done()
        .prints("equal within 9 grey levels: largest difference 9; 0 of ");
    check("--allow 0.1%").done();
    check("--allow 0").differs().prints(", 0 allowed");
    check("--region 0,0,64,24").done();
    check("--region 32,24,1,1")
        .differs()
        .prints("in 1 of 1 compared pixel (100.00 %)");
    let mut mask = Picture8::new(64, 48, [255; 4]);
    mask.row_mut(24)[32] = [0; 4];
    write(&folder, "mask.png", &mask);
    check("--mask mask.png").done();
    // The pixels around it differ by less than 4 levels.
    check("--radius 1 --reference-threshold 8.9")
        .done()
        .prints(", within a radius of 1 pixel");
    check("--region 0,0,65,1").refused(&["`--region` reaches beyond the picture of 64x48 pixels"]);
    check("-o mask.png --mask mask.png").refused(&["`--output` is the mask itself"]);
    for flag in [
        "--allow 1",
        "--radius 1",
        "--mask mask.png",
        "--region 0,0,1,1",
    ] {
        let name = flag.split(' ').next().unwrap();
        folder
            .run(&format!("render {SPHERE} -o new.png {flag}"))
            .refused(&[
                &format!("`{name}` is for a comparison, but there is none"),
                "expected `--reference FILE` too",
            ]);
    }
    assert!(!folder.path("new.png").exists());
}

#[test]
fn pictures_of_different_size_are_not_judged() {
    let folder = pair();
    write(&folder, "small.png", &Picture8::new(8, 8, GREY));
    // Whatever the flags allow, the sizes must be equal.
    let flags = "--fail-above 255 --allow 100% --radius 1 --region 0,0,16,12";
    let ended = folder
        .run(&format!("diff a.png small.png {flags} --json"))
        .differs();
    assert_eq!(
        (&ended.json()["failed"], &ended.json()["histogram"]),
        (&json!(true), &Value::Null)
    );
    folder
        .run(&format!("diff a.png small.png {flags} -o map.png"))
        .differs();
    assert_eq!(picture(&folder.path("map.png")).width(), 8);
}
