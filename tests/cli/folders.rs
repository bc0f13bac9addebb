//! `fastphong diff FOLDER FOLDER`: pairs, page, JUnit XML, and approving.

use super::{Ended, Folder};
use fastphong::picture::Picture8;
use fastphong::picture::image_file::{FilePicture, write_picture};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// Writes a grey picture of 8 × 6 pixels, one of which is off by `levels`.
fn write(folder: &Folder, name: &str, levels: u8) {
    let path = folder.path(name);
    fs::create_dir_all(path.parent().expect("a folder")).unwrap();
    let mut picture = Picture8::new(8, 6, [100, 100, 100, 255]);
    picture.row_mut(2)[3][1] += levels;
    write_picture(&path, &FilePicture::stored(picture)).unwrap();
}

/// Writes two folders with some pictures in subfolders. Two pictures are equal, one differs by a
/// level, one by 50, one is missing, and one is new.
fn folders() -> Folder {
    let folder = Folder::new();
    for (name, reference, actual) in [
        ("a.png", Some(0), Some(0)),
        ("b.png", Some(0), Some(1)),
        ("c.png", Some(0), Some(50)),
        ("in/d.ppm", Some(9), Some(9)),
        ("in/gone.png", Some(0), None),
        ("in/new/e.png", None, Some(0)),
    ] {
        if let Some(levels) = reference {
            write(&folder, &format!("ref/{name}"), levels);
        }
        if let Some(levels) = actual {
            write(&folder, &format!("now/{name}"), levels);
        }
    }
    folder
}

/// Returns the paths and bytes of all files in a folder, sorted.
fn all_files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let inner = all_files(&path).into_iter();
            files.extend(inner.map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else {
            files.push((name, fs::read(&path).unwrap()));
        }
    }
    files.sort();
    files
}

#[test]
fn pairs_are_compared_by_name_and_failures_are_listed_first() {
    let folder = folders();
    let ended = folder.run("diff ref now --fail-above 2").differs();
    let expected = [
        "differs  c.png         up to 50 grey levels; over 2 levels 1 of 48 compared pixels (2.08 %); largest region: 1 pixel within 1x1 at column 3, row 2, most at column 3, row 2: 50 grey levels",
        "missing  in/gone.png   no picture in/gone.png in now",
        "new      in/new/e.png  no reference ref/in/new/e.png yet",
        "within   b.png         up to 1 grey level; over 2 levels 0 of 48 compared pixels (0.00 %)",
        "6 pictures: 2 equal, 1 within what is allowed, 1 new, 1 missing, 1 differs",
    ];
    assert_eq!(ended.out.lines().collect::<Vec<_>>(), expected);
    ended.says("`--approve` copies pictures that differ or are new over the references");
    folder
        .run("diff ref now --fail-above 2 -v")
        .differs()
        .prints("equal    in/d.ppm");
    // Without a threshold, pictures must be equal.
    folder.run("diff ref now").differs().prints("2 differ");
    folder
        .run("diff ref now --allow 1")
        .differs()
        .prints("2 within what is allowed, 1 new, 1 missing\n");
    fs::remove_file(folder.path("ref/in/gone.png")).unwrap();
    fs::remove_dir_all(folder.path("now/in/new")).unwrap();
    folder
        .run("diff ref now --fail-above 50")
        .done()
        .prints("4 pictures: 2 equal, 2 within what is allowed");
    folder
        .run("diff ref now --fail-above 2 --radius 8")
        .differs();
    folder
        .run("diff ref now --region 0,0,3,6")
        .done()
        .prints("4 pictures: 4 equal");
}

#[test]
fn a_pair_that_cannot_be_compared_is_one_line_and_the_others_go_on() {
    let folder = folders();
    folder
        .write("now/c.png", "no picture")
        .write("ref/in/gone.png", "")
        .write("now/in/gone.png", "P6 2 2 255 short")
        .write("now/notes.txt", "")
        .write("now/.hidden.png", "");
    folder.write("now/a.png", folder.read("now/in/d.ppm"));
    folder.write("now/b.png", b"P6 1 1 255 abc");
    let ended = folder.run("diff ref now").differs();
    ended
        .prints("unreadable  c.png         now/c.png: not a picture that can be read")
        .prints("unreadable  in/gone.png   ref/in/gone.png: the file is empty: expected ")
        .prints("now/in/gone.png: broken PPM file: ")
        // PPM data under the name of a PNG file is still a picture.
        .prints("differs     a.png         up to 9 grey levels")
        .prints(
            "differs     b.png         the sizes differ: 8x6 in the reference, 1x1 in the picture",
        )
        .prints("6 pictures: 1 equal, 1 new, 2 differ, 2 unreadable")
        .says("1 file is left out: expected plain files with the ending of a picture");
    write(&folder, "mask.png", 0);
    let ended = folder.run("diff ref now --mask mask.png").differs();
    ended.prints("differs     b.png         the sizes differ");
    folder.write("small.ppm", b"P6 1 1 255 abc");
    let ended = folder.run("diff ref now --mask small.ppm").differs();
    ended.prints("the mask small.ppm has 1x1 pixels, the pictures 8x6: expected the same size");
}

#[test]
fn folders_that_cannot_be_compared_are_refused() {
    let folder = folders();
    fs::create_dir_all(folder.path("empty/inner")).unwrap();
    for two in ["ref ref", "ref ./ref", "ref now/../ref"] {
        folder
            .run(&format!("diff {two}"))
            .refused(&["are one folder: expected two"]);
    }
    folder
        .run("diff ref ref/in")
        .refused(&["ref/in lies in ref", "none within the other"]);
    folder
        .run("diff ref/in ref")
        .refused(&["ref/in lies in ref: expected two folders"]);
    folder.run("diff empty empty/inner").refused(&["lies in"]);
    fs::create_dir(folder.path("empty2")).unwrap();
    folder
        .run("diff empty empty2")
        .refused(&["no pictures in empty and empty2: expected files"]);
    folder
        .run("diff ref gone")
        .refused(&["ref is a folder, but gone is not"]);
    folder
        .run("diff - ref")
        .refused(&["ref is a folder, but - is not"]);
    folder
        .run("diff ref/a.png now")
        .refused(&["now is a folder, but ref/a.png is not"]);
    folder
        .run("diff ref now -o map.png")
        .refused(&["`--output` is for the map of two files"]);
    for flag in ["--html a.html", "--junit a.xml", "--approve"] {
        let name = flag.split(' ').next().unwrap();
        let ended = folder.run(&format!("diff ref/a.png now/a.png {flag}"));
        ended.refused(&[&format!("`{name}` is for two folders")]);
    }
    folder
        .run("diff ref now --html a.png")
        .refused(&["a.png: `--html` writes a page in HTML"]);
    folder
        .run("diff ref now --junit a.txt")
        .refused(&["a.txt: `--junit` writes XML"]);
    folder
        .run("diff ref now --html a --junit a")
        .refused(&["name one file"]);
    folder
        .run("diff ref now --html - --junit -")
        .refused(&["name standard output"]);
}

#[test]
fn json_has_every_pair() {
    let folder = folders();
    let json = folder
        .run("diff ref now --fail-above 2 --json")
        .differs()
        .json();
    assert_eq!(json["schema"], "fastphong.diff-folders/1");
    let counts =
        json!({ "unreadable": 0, "differs": 1, "missing": 1, "new": 1, "within": 1, "equal": 2 });
    assert_eq!((&json["counts"], &json["failed"]), (&counts, &json!(true)));
    assert_eq!(
        (&json["fail_above"], &json["approved"]),
        (&json!(2.0), &json!([]))
    );
    let pairs = json["pairs"].as_array().expect("pairs");
    let names: Vec<&str> = pairs
        .iter()
        .filter_map(|pair| pair["name"].as_str())
        .collect();
    let expected = [
        "a.png",
        "b.png",
        "c.png",
        "in/d.ppm",
        "in/gone.png",
        "in/new/e.png",
    ];
    assert_eq!(names, expected);
    let c = &pairs[2];
    assert_eq!(
        (&c["status"], &c["over"], &c["failed"]),
        (&json!("differs"), &json!(1), &json!(true))
    );
    assert_eq!(c["metrics"]["max"].as_f64(), Some(50.0));
    assert_eq!(c["largest_region"]["corner"], json!([3, 2]));
    assert_eq!(pairs[4]["metrics"], Value::Null);
}

#[test]
fn approving_copies_changed_and_new_pictures_and_removes_nothing() {
    let folder = folders();
    let before = all_files(&folder.path("ref"));
    let ended = folder
        .run("diff ref now --fail-above 2 --approve")
        .differs();
    ended.prints("approved 2 of 6 pictures:\n  c.png\n  in/new/e.png\n");
    let after = all_files(&folder.path("ref"));
    let names: Vec<&str> = after.iter().map(|(name, _)| &**name).collect();
    let expected = [
        "a.png",
        "b.png",
        "c.png",
        "in/d.ppm",
        "in/gone.png",
        "in/new/e.png",
    ];
    assert_eq!(names, expected, "no draft is left");
    for (name, bytes) in &after {
        let is_approved = ["c.png", "in/new/e.png"].contains(&&**name);
        let expected = if is_approved {
            folder.read(&format!("now/{name}"))
        } else {
            // Pictures within the threshold stay, so that references do not drift.
            before
                .iter()
                .find(|(old, _)| old == name)
                .expect(name)
                .1
                .clone()
        };
        assert_eq!(*bytes, expected, "{name}");
    }
    fs::remove_file(folder.path("ref/in/gone.png")).unwrap();
    folder.run("diff ref now --fail-above 2").done();
    let ended = folder.run("diff ref now --fail-above 2 --approve").done();
    assert!(!ended.out.contains("approved"), "{}", ended.out);
    // An unreadable picture is not approved, but a picture with an unreadable reference is.
    folder.write("now/c.png", "text").write("ref/a.png", "text");
    let ended = folder
        .run("diff ref now --fail-above 2 --approve --json")
        .differs();
    assert_eq!(ended.json()["approved"], json!(["a.png"]));
    assert_eq!(folder.read("ref/a.png"), folder.read("now/a.png"));
    assert_ne!(folder.read("ref/c.png"), folder.read("now/c.png"));
}

#[cfg(unix)]
#[test]
fn approving_changes_nothing_if_one_reference_cannot_be_replaced() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folders();
    let read_only = folder.path("ref/c.png");
    fs::set_permissions(&read_only, fs::Permissions::from_mode(0o444)).unwrap();
    let before = all_files(&folder.path("ref"));
    let ended = folder.run("diff ref now --approve");
    ended.refused(&["ref/c.png: cannot be written: the file there is read-only"]);
    assert_eq!(all_files(&folder.path("ref")), before);
    assert!(
        !folder.path("ref/in/new").exists(),
        "folders that were made are removed"
    );
    // The reference links to a picture of the other folder, or to another reference.
    for (target, problem) in [
        ("../now/b.png", "leads to a picture that is to be approved"),
        ("b.png", "leads to the same file as another reference"),
    ] {
        fs::remove_file(&read_only).unwrap();
        std::os::unix::fs::symlink(target, &read_only).unwrap();
        let before = all_files(&folder.path("ref"));
        folder
            .run("diff ref now --approve")
            .refused(&["ref/c.png", problem]);
        assert_eq!(all_files(&folder.path("ref")), before);
    }
    // The tool follows a link to a file elsewhere.
    fs::remove_file(&read_only).unwrap();
    write(&folder, "store/c.png", 7);
    std::os::unix::fs::symlink("../store/c.png", &read_only).unwrap();
    folder.run("diff ref now --approve").differs();
    assert!(read_only.is_symlink());
    assert_eq!(folder.read("store/c.png"), folder.read("now/c.png"));
}

#[cfg(unix)]
#[test]
fn links_to_folders_are_not_followed_and_names_may_hold_any_bytes() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folders();
    std::os::unix::fs::symlink("..", folder.path("now/in/up")).unwrap();
    std::os::unix::fs::symlink("nowhere.png", folder.path("now/broken.png")).unwrap();
    // The tool must not read a device that never ends.
    std::os::unix::fs::symlink("/dev/zero", folder.path("now/zero.png")).unwrap();
    let odd = std::ffi::OsStr::from_bytes(b"caf\xe9 <&\">\x01.png");
    write(&folder, "now/x.png", 30);
    fs::rename(folder.path("now/x.png"), folder.path("now").join(odd)).unwrap();
    let ended = folder
        .run("diff ref now --fail-above 2 --junit out/j.xml --html p.html")
        .differs();
    ended
        .prints("new         caf\\xE9 <&\">\\x01.png")
        .prints("unreadable  broken.png")
        .prints("8 pictures: ");
    let xml = String::from_utf8(folder.read("out/j.xml")).unwrap();
    // XML cannot hold the control character of the path. The message shows it unchanged.
    for part in [
        "name=\"caf\\xE9 &lt;&amp;&quot;&gt;\\x01.png\"",
        "&quot;&gt;\u{fffd}.png yet",
    ] {
        assert!(xml.contains(part), "{xml}");
    }
    let page = String::from_utf8(folder.read("p.html")).unwrap();
    assert!(page.contains("caf\\xE9 &lt;&amp;&quot;&gt;\\x01.png"));
}

#[test]
fn junit_has_a_case_for_each_pair() {
    let folder = folders();
    folder.write("now/a.png", "no picture");
    folder
        .run("diff ref now --fail-above 2 --junit j.xml")
        .differs();
    let xml = String::from_utf8(folder.read("j.xml")).unwrap();
    let count = |part: &str| xml.matches(part).count();
    assert_eq!(count("<testcase "), 6);
    assert_eq!(
        count("tests=\"6\" failures=\"3\" errors=\"1\" skipped=\"0\""),
        2
    );
    assert_eq!(
        (count("<failure "), count("<error "), count("/>\n")),
        (3, 1, 2)
    );
    assert!(
        xml.contains("classname=\"pictures.in.new\" name=\"e.png\""),
        "{xml}"
    );
    assert!(
        xml.contains("type=\"differs\" message=\"up to 50 grey levels; "),
        "{xml}"
    );
    let piped = folder
        .run("diff ref now --fail-above 2 --junit -")
        .differs();
    assert!(piped.out.starts_with("<?xml ") && piped.err.contains("6 pictures: "));
}

#[test]
fn the_page_lists_all_pairs_and_shows_the_pictures_that_differ() {
    let folder = folders();
    folder
        .run("diff ref now --fail-above 2 --html out/page.html")
        .differs();
    let page = String::from_utf8(folder.read("out/page.html")).unwrap();
    let statuses: Vec<&str> = page
        .split("data-status=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .filter(|status| status.len() < 12)
        .collect();
    assert_eq!(
        statuses,
        ["differs", "missing", "new", "within", "equal", "equal"]
    );
    // A pair that differs shows three pictures, every other pair one.
    assert_eq!(page.matches("<img ").count(), 2 * 3 + 4);
    assert_eq!(page.matches("<i class=\"frame\"").count(), 1);
    assert!(page.contains("<title>fastphong: 6 pictures: 2 equal, "));
    assert!(
        !page.contains("http:") && !page.contains("https:"),
        "nothing is loaded"
    );
}

/// This run fails after drafts are written and before they get their names. `signals.rs` stops the
/// program at other moments.
#[test]
fn a_folder_in_place_of_a_reference_stops_approving_without_a_change() {
    let folder = folders();
    fs::create_dir_all(folder.path("ref/in/new/e.png")).unwrap();
    let before = all_files(&folder.path("ref"));
    let ended: Ended = folder.run("diff ref now --approve");
    ended.refused(&["ref/in/new/e.png: cannot be written"]);
    assert_eq!(all_files(&folder.path("ref")), before);
}
