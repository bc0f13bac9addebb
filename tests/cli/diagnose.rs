//! `fastphong diagnose`: the answer, its evidence, its exit codes.

use super::{Folder, picture};
use fastphong::picture::Picture8;
use fastphong::picture::image_file::{FilePicture, write_picture};

/// Writes a picture of `teapot` drawn with `flags`.
fn drawn(flags: &str) -> Folder {
    let folder = Folder::new();
    folder
        .run(&format!(
            "render teapot --size 160x120 {flags} -o yours.png -q"
        ))
        .done();
    folder
}

#[test]
fn a_right_picture_is_reported_as_right() {
    drawn("")
        .run("diagnose yours.png teapot")
        .done()
        .prints("agrees with teapot: it is 0.00 grey levels off");
    // Supersampled edges count as those of another rasterizer, which is no mistake.
    drawn("--samples 4").run("diagnose yours.png teapot").done();
}

#[test]
fn mistakes_are_named_with_evidence_and_advice() {
    let folder = drawn("-m gouraud");
    let ended = folder
        .run("diagnose yours.png teapot -o strip.png")
        .differs()
        .prints("one mistake explains it")
        .prints("Gouraud shading");
    ended
        .prints("0.00 are left")
        .prints("what to do")
        .prints("report/course/3-gouraud-shading.md");
    let strip = picture(&folder.path("strip.png"));
    // Captions stand above the pictures.
    assert_eq!([strip.width(), strip.height()], [3 * 160 + 2 * 8, 12 + 120]);
    // The third picture equals the first: the mistake explains every difference.
    for y in 12..132 {
        let row = strip.row(y);
        let differ = row[..160]
            .iter()
            .zip(&row[2 * 168..])
            .filter(|(a, b)| a != b)
            .count();
        assert!(differ == 0, "row {y}: {differ} pixels");
    }
    folder.run("diagnose yours.png teapot --as gouraud").done();
    let two = drawn("--encoding srgb --shininess 64")
        .run("diagnose yours.png teapot")
        .differs();
    two.prints("two mistakes together")
        .prints("encoded as sRGB")
        .prints("The exponent is twice as large.");
    let amounts = drawn("--ambient 0.5")
        .run("diagnose yours.png teapot")
        .differs();
    amounts.prints("amounts of light").prints("ambient × 0.50");
}

#[test]
fn numbers_that_no_name_says_are_found() {
    // One wrong digit in the light's direction (0.4, 0.7, 0.9) is the commonest mistake of all.
    drawn("--light 0.4,0.1,0.9")
        .run("diagnose yours.png teapot")
        .differs()
        .prints("the places of lights differ")
        .prints("yours comes from (0.40, 0.10, 0.91)")
        .prints("y is 0.1, not 0.700");
    drawn("--light 0.4,0.1,0.9 --shininess 5 --ambient 0.5")
        .run("diagnose yours.png teapot")
        .differs()
        .prints("y is 0.1, not 0.700")
        .prints("ambient × 0.50, exponent × 0.16");
}

#[test]
fn a_picture_that_no_mistake_explains_is_reported_as_unexplained() {
    let folder = Folder::new();
    folder
        .run("render vase --size 160x120 -o vase.png -q")
        .done();
    let ended = folder.run("diagnose vase.png teapot").differs();
    ended
        .prints("none of the")
        .prints("nearest")
        .prints("worst");
    let black = Picture8::new(160, 120, [0, 0, 0, 255]);
    write_picture(&folder.path("black.png"), &FilePicture::stored(black)).unwrap();
    folder
        .run("diagnose black.png teapot")
        .differs()
        .prints("shows nothing of teapot");
}

#[test]
fn json_lists_the_causes_and_every_mistake_that_was_tried() {
    let found = drawn("-m gouraud")
        .run("diagnose yours.png teapot --json")
        .differs()
        .json();
    assert_eq!(found["schema"], "fastphong.diagnose/2");
    assert_eq!(found["verdict"], "one");
    assert_eq!(found["causes"][0]["ids"][0], "per-vertex");
    assert_eq!(found["correct"], false);
    assert!(found["singles"].as_array().unwrap().len() > 100);
    assert!(
        found["cannot_show"]
            .as_array()
            .unwrap()
            .iter()
            .any(|m| m["id"] == "falloff-missing")
    );
    let list = Folder::new().run("list mistakes --json").done().json();
    assert!(
        list.as_array()
            .unwrap()
            .iter()
            .any(|m| m["id"] == "per-vertex")
    );
}

/// Returns the picture with columns and rows exchanged.
fn transposed(from: &Picture8) -> Picture8 {
    let mut to = Picture8::new(from.height(), from.width(), [0; 4]);
    for y in 0..to.height() {
        for x in 0..to.width() {
            to.row_mut(y)[x] = from.get(y, x);
        }
    }
    to
}

#[test]
fn size_and_background_are_checked_first() {
    let folder = drawn("");
    let right = picture(&folder.path("yours.png"));
    let turned = FilePicture::stored(transposed(&right));
    write_picture(&folder.path("turned.png"), &turned).unwrap();
    let ended = folder
        .run("diagnose turned.png teapot --size 160x120")
        .differs();
    ended
        .prints("width and height are exchanged")
        .prints("agrees with teapot apart from that");
    // The scene is drawn at the size of the picture, whatever it is.
    folder
        .run("render teapot --size 90x200 -o tall.png -q")
        .done();
    folder.run("diagnose tall.png teapot").done();
    folder
        .run("diagnose tall.png teapot --size 160x120")
        .refused(&["tall.png: has 90x200 pixels: expected 160x120, as --resolution says"]);
    let other = right.map(|pixel| {
        if pixel[3] == 0 {
            [0, 0, 90, 255]
        } else {
            pixel
        }
    });
    write_picture(&folder.path("blue.png"), &FilePicture::stored(other)).unwrap();
    let ended = folder.run("diagnose blue.png teapot").differs();
    ended
        .prints("the background is 0 0 90, but the scene says 0 0 0")
        .prints("agrees with teapot apart from that");
}

#[test]
fn a_scene_is_found_inside_a_screenshot_and_in_a_crop() {
    let folder = drawn("-m gouraud");
    let own = picture(&folder.path("yours.png"));
    let mut shot = Picture8::new(230, 190, [70, 100, 130, 255]);
    for y in 0..120 {
        shot.row_mut(y + 28)[13..173].copy_from_slice(own.row(y));
    }
    write_picture(&folder.path("shot.png"), &FilePicture::stored(shot.clone())).unwrap();
    let ended = folder
        .run("diagnose shot.png teapot --size 160x120 -o strip.png")
        .differs();
    ended
        .prints("your picture is inside this one, at column 13, row 28")
        .prints("Gouraud shading");
    let strip = picture(&folder.path("strip.png"));
    assert_eq!([strip.width(), strip.height()], [3 * 160 + 2 * 8, 12 + 120]);
    let opaque: Vec<[u8; 4]> = own
        .row(60)
        .iter()
        .map(|&[r, g, b, _]| [r, g, b, 255])
        .collect();
    assert_eq!(strip.row(12 + 60)[..160], opaque[..]);
    let found = folder
        .run("diagnose shot.png teapot --size 160x120 --json")
        .differs()
        .json();
    assert_eq!(found["window"]["in_picture"], serde_json::json!([13, 28]));
    // The pixel to look at is one of the screenshot.
    let spot = &found["look_at"];
    let [x, y] = ["x", "y"].map(|key| spot[key].as_u64().unwrap() as usize);
    let levels = shot.get(x, y);
    for channel in 0..3 {
        assert_eq!(
            spot["yours"][channel].as_f64(),
            Some(levels[channel].into())
        );
    }
    let mut crop = Picture8::new(130, 90, [0; 4]);
    for y in 0..90 {
        crop.row_mut(y).copy_from_slice(&own.row(y + 16)[12..142]);
    }
    write_picture(&folder.path("crop.png"), &FilePicture::stored(crop)).unwrap();
    folder
        .run("diagnose crop.png teapot --size 160x120")
        .differs()
        .prints("it shows columns 12 to 141, rows 16 to 105 of the scene's")
        .prints("Gouraud shading");
}

#[test]
fn rows_of_another_length_are_put_right() {
    let folder = drawn("-m gouraud");
    let own = picture(&folder.path("yours.png"));
    // Rows as in a BMP, from below and blue first, two bytes too long.
    let mut bytes = Vec::new();
    for y in (0..120).rev() {
        for [r, g, b, _] in own.row(y) {
            bytes.extend([*b, *g, *r]);
        }
        bytes.extend([0; 2]);
    }
    let mut leaning = Picture8::new(160, 120, [0, 0, 0, 255]);
    for y in 0..120 {
        let row = leaning.row_mut(119 - y);
        for (pixel, bgr) in row.iter_mut().zip(bytes[480 * y..].chunks(3)) {
            *pixel = [bgr[2], bgr[1], bgr[0], 255];
        }
    }
    let leaning = FilePicture::stored(leaning);
    write_picture(&folder.path("leaning.ppm"), &leaning).unwrap();
    folder
        .run("diagnose leaning.ppm teapot")
        .differs()
        .prints("rows of the file are 2 bytes longer than they were read")
        .prints("Gouraud shading");
}

#[test]
fn cracks_are_named_and_do_not_count() {
    for (flags, rest) in [
        ("", "agrees with teapot"),
        ("-m gouraud", "Gouraud shading"),
    ] {
        let folder = drawn(flags);
        let mut cracked = picture(&folder.path("yours.png"));
        for y in 0..120 {
            for (x, pixel) in cracked.row_mut(y).iter_mut().enumerate() {
                if (2 * x + y) % 11 == 0 {
                    *pixel = [0; 4];
                }
            }
        }
        write_picture(&folder.path("cracked.png"), &FilePicture::stored(cracked)).unwrap();
        folder
            .run("diagnose cracked.png teapot")
            .differs()
            .prints("9 % of the covered pixels have the background's colour: cracks between")
            .prints(rest);
    }
}

#[test]
fn pictures_that_cannot_be_diagnosed_are_refused() {
    let folder = drawn("");
    folder.write("no.png", "nothing");
    folder.run("diagnose no.png teapot").refused(&["no.png"]);
    folder
        .run("diagnose missing.png teapot")
        .refused(&["missing.png"]);
    folder
        .run("diagnose yours.png taepot")
        .refused(&["did you mean `teapot`?"]);
    folder
        .run("diagnose yours.png teapot -o yours.png")
        .refused(&["`--output` is the picture itself"]);
    folder
        .run("diagnose yours.png local-lights --as integer-fast")
        .refused(&["--as integer-fast: integer methods need lights and an eye at infinity"]);
    folder
        .run("diagnose yours.png teapot --as nothing")
        .refused(&["unknown method"]);
    let small = Picture8::new(1, 1, [0, 0, 0, 255]);
    write_picture(&folder.path("small.png"), &FilePicture::stored(small)).unwrap();
    folder
        .run("diagnose small.png teapot")
        .refused(&["too little of it is visible"]);
    let mut ppm = b"P5 20000 1 255\n".to_vec();
    ppm.resize(ppm.len() + 20000, 0);
    folder.write("wide.pgm", ppm);
    folder
        .run("diagnose wide.pgm teapot")
        .refused(&["20000x1 pixels: expected at most 16384 a side"]);
}
