//! `render --reference`: a missing reference, an equal one, and one that differs.

use super::{Folder, SPHERE, picture};
use fastphong::picture::image_file::{FilePicture, write_picture};

#[test]
fn a_missing_reference_keeps_the_candidate_and_suggests_a_command() {
    let folder = Folder::new();
    let ended = folder
        .run(&format!("render {SPHERE} --reference ref.png"))
        .differs();
    ended
        .prints("no reference ref.png yet: the picture is in ref.actual.png")
        .prints("to accept it: cp ref.actual.png ref.png");
    assert_eq!(
        folder.names(),
        ["ref.actual.png"],
        "nothing is accepted unasked"
    );

    let ended = folder
        .run(&format!("render {SPHERE} --reference ref.png -o mine.png"))
        .differs();
    ended.prints("to accept it: cp mine.png ref.png");
    // The suggested command works: the next run agrees.
    std::fs::copy(folder.path("mine.png"), folder.path("ref.png")).unwrap();
    let ended = folder
        .run(&format!("render {SPHERE} --reference ref.png"))
        .done();
    ended.prints("ref.png: equal within 1 grey levels: largest difference 0");
}

#[test]
fn a_candidate_has_the_format_of_its_reference() {
    let folder = Folder::new();
    let ended = folder
        .run(&format!("render {SPHERE} --reference ref.pfm -o mine.png"))
        .differs();
    ended.prints("to accept it: cp ref.actual.pfm ref.pfm");
    std::fs::copy(folder.path("ref.actual.pfm"), folder.path("ref.pfm")).unwrap();
    folder
        .run(&format!(
            "render {SPHERE} --reference ref.pfm --reference-threshold 0"
        ))
        .done()
        .prints("difference 0");
}

#[test]
fn a_difference_leaves_both_pictures_and_a_map() {
    let folder = Folder::new();
    folder.run(&format!("render {SPHERE} -o ref.png")).done();
    let mut changed = picture(&folder.path("ref.png"));
    let pixel = changed.get(32, 24);
    changed.row_mut(24)[32] = [pixel[0] - 3, pixel[1], pixel[2], 255];
    write_picture(&folder.path("ref.png"), &FilePicture::stored(changed)).unwrap();

    let check = format!("render {SPHERE} --reference ref.png");
    folder
        .run(&format!("{check} --reference-threshold 3"))
        .done()
        .prints("equal within 3 grey levels");
    assert_eq!(folder.names(), ["ref.png"]);
    let ended = folder
        .run(&format!("{check} --reference-threshold 2.5"))
        .differs();
    ended
        .prints("ref.png: differs by 3.0000 grey levels, more than 2.5")
        .prints("1 pixel differs, most at column 32, row 24")
        .prints("actual: ref.actual.png")
        .prints("ref.diff.png")
        .prints("to accept it: cp ref.actual.png ref.png");
    assert_eq!(
        folder.names(),
        ["ref.actual.png", "ref.diff.png", "ref.png"]
    );
    let map = picture(&folder.path("ref.diff.png"));
    let lit = map
        .pixels()
        .iter()
        .filter(|pixel| pixel[..3] != [0; 3])
        .count();
    assert!(lit == 1 && map.get(32, 24)[..3] != [0; 3], "{lit}");

    std::fs::create_dir(folder.path("out")).unwrap();
    folder
        .run(&format!("{check} -o out/mine.png"))
        .differs()
        .prints("actual: out/mine.png")
        .prints("out/ref.diff.png");
    assert!(folder.path("out/mine.png").exists() && folder.path("out/ref.diff.png").exists());
    // With the picture on standard output, messages go to standard error.
    let piped = folder
        .run(&format!("{check} -o -"))
        .differs()
        .says("differs by 3.0000");
    assert_eq!(piped.bytes, folder.read("ref.actual.png"));
}

#[test]
fn pictures_of_other_size_or_coverage_differ() {
    let folder = Folder::new();
    folder.run(&format!("render {SPHERE} -o ref.png")).done();
    let ended = folder
        .run("render builtin:cube --size 32x24 --reference ref.png")
        .differs();
    ended
        .prints("the sizes differ: the reference has 64x48 pixels, the picture 32x24")
        .prints("ref.actual.png")
        .prints("; the map shows the upper left part that both have, 32x24");
    let map = picture(&folder.path("ref.diff.png"));
    assert_eq!((map.width(), map.height()), (32, 24));
    // Black on black: the colours agree, but the coverage differs.
    let black = "--ka 0 --kd 0 --ks 0";
    folder
        .run(&format!("render {SPHERE} {black} --fit 0.5 -o black.png"))
        .done();
    let check = "--reference black.png --reference-threshold 254";
    folder
        .run(&format!("render {SPHERE} {black} --fit 0.5 {check}"))
        .done();
    let ended = folder
        .run(&format!("render {SPHERE} {black} --fit 0.6 {check}"))
        .differs();
    ended.prints("pixels are covered in one picture only");
}

#[test]
fn references_that_cannot_be_read_are_errors() {
    let folder = Folder::new();
    folder.write("ref.png", "no picture");
    folder
        .run(&format!("render {SPHERE} --reference ref.png"))
        .refused(&["ref.png: not a picture that can be read"]);
    folder
        .run(&format!("render {SPHERE} --reference ref.gif"))
        .refused(&["ref.gif: no picture format has this ending"]);
    folder
        .run(&format!(
            "render {SPHERE} --reference ref.png --reference-threshold x"
        ))
        .refused(&["grey levels"]);
    folder
        .run(&format!("render {SPHERE} --reference-threshold 1 -o a.png"))
        .refused(&["--reference <FILE>"]);
    folder
        .run(&format!("render {SPHERE} --reference gone/ref.png"))
        .refused(&["gone/ref.actual.png: cannot be written"]);
    for same in ["ref.png", "./ref.png"] {
        let refused = folder.run(&format!("render {SPHERE} --reference ref.png -o {same}"));
        refused.refused(&["`--output` is the reference itself"]);
    }
    assert_eq!(
        (folder.names(), folder.read("ref.png")),
        (vec!["ref.png".to_owned()], b"no picture".to_vec())
    );
}

#[test]
fn paths_are_quoted_for_the_shell() {
    let folder = Folder::new();
    let mut command = folder.command(&format!("render {SPHERE} --reference"));
    let output = command.arg("it's mine.png").output().unwrap();
    let ended = super::Ended::new("quoted", output).differs();
    ended.prints(r"cp 'it'\''s mine.actual.png' 'it'\''s mine.png'");
}

/// A reference that does not state its encoding is compared as stored. If it states another one
/// than the picture has, the linear one of the two is encoded first.
#[test]
fn a_reference_counts_in_the_encoding_that_it_states() {
    let folder = Folder::new();
    let linear = format!("render {SPHERE}");
    folder.run(&format!("{linear} -o ref.png")).done();
    let stored = FilePicture::stored(picture(&folder.path("ref.png")));
    write_picture(&folder.path("old.png"), &stored).unwrap();
    for reference in ["ref.png", "old.png"] {
        let check = format!("{linear} --reference {reference} --reference-threshold 0");
        folder.run(&check).done();
    }
    let srgb = "--encoding srgb --reference-threshold 0";
    folder
        .run(&format!("{linear} --reference old.png {srgb}"))
        .differs();
    // The linear picture was rounded to levels and then encoded. In the dark, one linear level is
    // up to 12.92 levels of sRGB, and half of that lies on either side; the encoded picture adds
    // half a level.
    let near = "--encoding srgb --reference-threshold 7";
    folder
        .run(&format!("{linear} --reference ref.png {near}"))
        .done()
        .prints("encodings: ref.png states linear; the picture states srgb; the linear picture was encoded");
}

/// Depth is infinite where nothing is visible. The depth picture still equals itself, and no other.
#[test]
fn a_reference_that_is_not_finite_equals_only_itself() {
    let folder = Folder::new();
    let depth = format!("render {SPHERE} --aov depth");
    folder.run(&format!("{depth} -o ref.pfm")).done();
    let check = "--reference ref.pfm --reference-threshold";
    folder.run(&format!("{depth} {check} 0")).done();
    folder
        .run(&format!("{depth} --fit 0.5 {check} 1e9"))
        .differs()
        .prints("infinite or not a number in one of them, which no threshold allows");
}
