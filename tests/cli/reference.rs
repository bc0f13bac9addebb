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

/// A pair that passes has no map: the one of an earlier failure goes. Another picture of this name
/// stays, even if fastphong drew it.
#[test]
fn a_picture_that_passes_removes_the_map_of_an_earlier_failure() {
    let folder = Folder::new();
    let check = format!("render {SPHERE} --reference ref.png");
    for name in ["ref.png", "ref.diff.png"] {
        folder.run(&format!("render {SPHERE} -o {name}")).done();
    }
    folder.run(&check).done();
    assert_eq!(folder.read("ref.diff.png"), folder.read("ref.png"));
    folder.write("ref.diff.png", "mine");
    folder.run(&format!("{check} --force")).done();
    assert_eq!(folder.read("ref.diff.png"), b"mine");
    std::fs::remove_file(folder.path("ref.diff.png")).unwrap();
    for output in ["", "-o out/mine.png"] {
        std::fs::create_dir_all(folder.path("out")).unwrap();
        let ended = folder.run(&format!("{check} --kd 0 {output}")).differs();
        let map = if output.is_empty() {
            "ref.diff.png"
        } else {
            "out/ref.diff.png"
        };
        ended.prints(map);
        assert!(folder.path(map).exists());
        assert_eq!(picture(&folder.path(map)).width(), 64);
        folder.run(&format!("{check} {output}")).done();
        assert!(!folder.path(map).exists(), "{map}");
    }
    assert!(folder.path("ref.actual.png").exists());
}

/// A picture of the map's name may be the reference of another scene. `--force` replaces it.
#[test]
fn a_map_replaces_only_a_map() {
    let folder = Folder::new();
    for name in ["ref.png", "ref.diff.png"] {
        folder.run(&format!("render {SPHERE} -o {name}")).done();
    }
    let check = format!("render {SPHERE} --kd 0 --reference ref.png");
    let ended = folder.run(&check).differs();
    assert!(!ended.out.contains("ref.diff.png"), "{}", ended.out);
    ended.says("warning: ref.diff.png is another picture, not a map: no map is written");
    assert_eq!(folder.read("ref.diff.png"), folder.read("ref.png"));
    let forced = folder.run(&format!("{check} --force")).differs();
    forced.prints("ref.diff.png");
    let map = folder.read("ref.diff.png");
    let other = format!("{check} --ks 0 --ka 0");
    folder.run(&other).differs().prints("ref.diff.png");
    assert_ne!(folder.read("ref.diff.png"), map);
}

/// Folders stand where the extra pictures would be, so that these cannot be written.
#[test]
fn the_verdict_stands_if_the_extra_pictures_cannot_be_written() {
    let folder = Folder::new();
    folder.run(&format!("render {SPHERE} -o ref.png")).done();
    for name in ["ref.actual.png", "ref.diff.png", "new.actual.png"] {
        std::fs::create_dir(folder.path(name)).unwrap();
    }
    let check = format!("render {SPHERE} --reference");
    folder
        .run(&format!("{check} ref.png"))
        .done()
        .prints("equal within 1 grey levels");
    let ended = folder.run(&format!("{check} ref.png --kd 0")).differs();
    assert!(!ended.out.contains("cp "), "{}", ended.out);
    ended
        .prints("ref.png: differs by ")
        .prints("largest region: ")
        .says("warning: ref.actual.png: cannot be written")
        .says("warning: ref.diff.png: cannot be written");
    for missing in ["new.png", "gone/ref.png"] {
        let ended = folder.run(&format!("{check} {missing}")).differs();
        assert_eq!(ended.out, format!("no reference {missing} yet\n"));
        ended.says("actual.png: cannot be written");
    }
}

#[test]
fn a_reference_without_a_pixel_to_compare_is_an_error() {
    let folder = Folder::new();
    let empty = format!("render {SPHERE} --half-height 1 --eye 0,0,9 --target 0,9,0");
    folder.run(&format!("{empty} -o ref.png")).done();
    assert!(
        picture(&folder.path("ref.png"))
            .pixels()
            .iter()
            .all(|pixel| pixel[3] == 0)
    );
    folder.run(&format!("{empty} --reference ref.png")).done();
    let coloured = fastphong::picture::Picture8::new(64, 48, [200, 0, 0, 0]);
    write_picture(&folder.path("ref.png"), &FilePicture::stored(coloured)).unwrap();
    let check = format!("{empty} --reference ref.png --reference-threshold 255");
    folder
        .run(&check)
        .refused(&["nothing is compared: neither picture covers a pixel"]);
    folder
        .run(&format!(
            "render {SPHERE} --reference ref.png --region 0,0,1,1"
        ))
        .refused(&["nothing is compared"]);
}
