//! `fastphong diff FOLDER FOLDER`: pairs, page, JUnit XML, and approving.

use super::{Ended, Folder};
use fastphong::picture::image_file::{FilePicture, write_picture};
use fastphong::picture::{Encoding, Picture8};
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
        "missing  in/gone.png   no picture in/gone.png in now: expected one, or no reference: remove ref/in/gone.png",
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
        .refused(&["there is no gone: expected a folder of pictures"]);
    folder.run("diff gone now").refused(&[
        "there is no gone: expected a folder of references, which may be empty: `--approve` fills it",
    ]);
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
    let counts = json!({ "unreadable": 0, "differs": 1, "encoding": 0, "missing": 1, "new": 1, "within": 1, "equal": 2 });
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
}

/// A pair that cannot be judged keeps its reference, whatever the reason. Without its reference,
/// the picture is new.
#[test]
fn what_could_not_be_judged_is_not_approved() {
    let folder = Folder::new();
    for name in ["a.png", "b.png", "c.png"] {
        write(&folder, &format!("ref/{name}"), 0);
        write(&folder, &format!("now/{name}"), 9);
    }
    write_picture(
        &folder.path("small.png"),
        &FilePicture::stored(Picture8::new(3, 3, [255; 4])),
    )
    .unwrap();
    let before = all_files(&folder.path("ref"));
    for flags in ["--mask small.png", "--region 50,50,2,2"] {
        let command = format!("diff ref now --fail-above 2 {flags} --approve --junit j.xml");
        folder
            .run(&command)
            .differs()
            .prints("3 pictures: 3 unreadable\n")
            .says("not those that are unreadable or in another encoding");
        assert_eq!(all_files(&folder.path("ref")), before, "{flags}");
    }
    folder.write("ref/a.png", "text").write("now/b.png", "text");
    folder.write("now/new.png", "text");
    let approve = "diff ref now --fail-above 2 --approve --json";
    let ended = folder.run(approve).differs();
    assert_eq!(ended.json()["approved"], json!(["c.png"]));
    assert_eq!(folder.read("ref/a.png"), b"text");
    assert_eq!(folder.read("ref/b.png"), before[1].1);
    assert!(!folder.path("ref/new.png").exists());
    fs::remove_file(folder.path("ref/a.png")).unwrap();
    let ended = folder.run(approve).differs();
    assert_eq!(ended.json()["approved"], json!(["a.png"]));
}

/// A file that changes after it was compared does not become the reference: the bytes that were
/// compared do. The program waits for a reader of its XML, which leaves time to change the file.
#[cfg(unix)]
#[test]
fn the_bytes_that_were_compared_are_approved() {
    use std::time::{Duration, Instant};
    let folder = Folder::new();
    for name in ["ref", "now"] {
        fs::create_dir(folder.path(name)).unwrap();
    }
    let compared = [b"P6 40 40 255\n".as_slice(), &[7; 4800]].concat();
    folder.write("now/a.ppm", &compared);
    let pipe = folder.path("j.xml");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo runs").success());
    let mut child = folder
        .command("diff ref now --approve --junit j.xml")
        .spawn()
        .unwrap();
    // A program that copies only after it has written the XML never makes a draft here.
    let started = Instant::now();
    let has_draft = || fs::read_dir(folder.path("ref")).unwrap().next().is_some();
    while !has_draft() && started.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(1));
    }
    let file = fs::File::options()
        .write(true)
        .open(folder.path("now/a.ppm"));
    file.unwrap().set_len(400).unwrap();
    fs::read(&pipe).expect("what was written");
    assert!(child.wait().unwrap().success());
    assert_eq!(folder.read("ref/a.ppm"), compared);
}

/// Starts an approval while another one holds the folder, and lets the other one finish first:
/// `meanwhile` writes what it writes.
#[cfg(unix)]
fn approve_after(folder: &Folder, meanwhile: impl FnOnce()) -> Ended {
    let lock = fs::File::open(folder.path("ref")).unwrap();
    lock.lock().unwrap();
    let mut command = folder.command("diff ref now --approve --json");
    command.stdout(std::process::Stdio::piped());
    command.stderr(std::process::Stdio::piped());
    let child = command.spawn().unwrap();
    let started = std::time::Instant::now();
    let names = |name: &str| {
        let entries = fs::read_dir(folder.path(name)).unwrap();
        let entries = entries.map(|entry| entry.unwrap().file_name());
        entries.filter(|name| name.as_encoded_bytes().starts_with(b".tmp"))
    };
    // The last draft is that of the new picture.
    while !folder.path("ref/in/new").exists() || names("ref/in/new").count() == 0 {
        assert!(started.elapsed().as_secs() < 120);
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    meanwhile();
    lock.unlock().unwrap();
    Ended::new("approve", child.wait_with_output().unwrap())
}

/// An approval that waited for another one judged references that are not there any more.
#[cfg(unix)]
#[test]
fn references_that_changed_since_they_were_judged_are_not_replaced() {
    for (name, is_there) in [("c.png", true), ("in/new/e.png", false)] {
        let folder = folders();
        let name = format!("ref/{name}");
        assert_eq!(folder.path(&name).exists(), is_there);
        let before = all_files(&folder.path("ref"));
        let ended = approve_after(&folder, || {
            folder.write(&name, "the other approval's");
        });
        ended.refused(&[&format!(
            "{name} is not as it was when the folder was listed"
        )]);
        assert_eq!(folder.read(&name), b"the other approval's");
        let mut after = all_files(&folder.path("ref"));
        after.retain(|(left, _)| format!("ref/{left}") != name);
        let mut before = before;
        before.retain(|(left, _)| format!("ref/{left}") != name);
        assert_eq!(after, before, "nothing else has changed");
    }
    // What was not to be replaced may change.
    let folder = folders();
    let ended = approve_after(&folder, || write(&folder, "ref/a.png", 3));
    let approved = json!(["b.png", "c.png", "in/new/e.png"]);
    assert_eq!(ended.differs().json()["approved"], approved);
}

/// The page and the XML would replace what was just approved.
#[cfg(unix)]
#[test]
fn a_page_is_not_written_over_a_new_reference_behind_a_link() {
    let folder = folders();
    for (flag, name) in [("--html", "p.html"), ("--junit", "j.xml")] {
        let link = folder.path(name);
        std::os::unix::fs::symlink("ref/in/new/e.png", link).unwrap();
        let before = all_files(&folder.path("ref"));
        folder
            .run(&format!("diff ref now --approve {flag} {name}"))
            .refused(&[&format!("`{flag}` is a reference itself, ref/in/new/e.png")]);
        assert_eq!(all_files(&folder.path("ref")), before);
    }
}

/// The same stored values, but only one file states that they are linear: the commonest false
/// alarm.
#[test]
fn a_pair_that_lacks_its_encoding_says_so_and_is_not_approved() {
    let folder = Folder::new();
    let picture = || FilePicture::stored(Picture8::new(8, 6, [100, 50, 10, 255]));
    let stated = |encoding| picture().encoded(encoding);
    for (name, reference, actual) in [
        ("one.png", stated(Encoding::Linear), picture()),
        ("other.png", picture(), stated(Encoding::Linear)),
        ("both.png", stated(Encoding::Linear), stated(Encoding::Srgb)),
    ] {
        for (place, picture) in [("ref", reference), ("now", actual)] {
            fs::create_dir_all(folder.path(place)).unwrap();
            write_picture(&folder.path(place).join(name), &picture).unwrap();
        }
    }
    let before = all_files(&folder.path("ref"));
    let agree = "only the encodings differ, and the stored values agree";
    for flags in ["", "--fail-above 2 --approve"] {
        folder
            .run(&format!("diff ref now {flags} --html p.html"))
            .differs()
            .prints(&format!("encoding  one.png    {agree}: the reference states linear, the picture counts as srgb: expected `--assume linear`\n"))
            .prints("the reference counts as srgb, the picture states linear: expected `--assume linear`\n")
            .prints("the reference states linear, the picture states srgb: expected files that state one encoding\n")
            .prints("3 pictures: 3 in another encoding\n");
    }
    assert_eq!(all_files(&folder.path("ref")), before);
    folder
        .run("diff ref now --assume linear")
        .differs()
        .prints("3 pictures: 2 equal, 1 in another encoding\n");
    // Two files say the same.
    folder
        .run("diff ref/one.png now/one.png --fail-above 2")
        .differs()
        .says(agree)
        .says("expected `--assume linear`");
    // With other values, it is a difference like any other.
    write(&folder, "now/one.png", 0);
    folder
        .run("diff ref now")
        .differs()
        .prints("differs   one.png");
}

#[test]
fn nothing_that_is_compared_is_not_equal() {
    let folder = Folder::new();
    let write = |name: &str, colour: u8, alpha: u8| {
        let mut picture = Picture8::new(8, 6, [colour, 1, 1, 0]);
        picture.row_mut(2)[3] = [colour, 9, 9, alpha];
        fs::create_dir_all(folder.path(name).parent().unwrap()).unwrap();
        write_picture(&folder.path(name), &FilePicture::stored(picture)).unwrap();
    };
    for (name, colours, alpha) in [("a.png", [1, 200], 0), ("b.png", [3, 3], 0)] {
        write(&format!("ref/{name}"), colours[0], alpha);
        write(&format!("now/{name}"), colours[1], alpha);
    }
    let nothing = "nothing is compared: neither picture covers a pixel";
    for flags in ["", "--fail-above 1", "--fail-above 255 --allow 100%"] {
        let command = format!("diff ref/a.png now/a.png -o map.png {flags}");
        folder.run(&command).refused(&[nothing]);
    }
    assert!(!folder.path("map.png").exists());
    // The same values everywhere are equal.
    folder
        .run("diff ref/b.png now/b.png --fail-above 0")
        .done()
        .prints("the pictures are equal");
    folder
        .run("diff ref now")
        .differs()
        .prints(&format!("unreadable  a.png  {nothing}"))
        .prints("2 pictures: 1 equal, 1 unreadable\n");
    // A mask or a region may leave only pixels that neither picture covers.
    write("ref/a.png", 1, 255);
    write("now/a.png", 200, 255);
    let mut mask = Picture8::new(8, 6, [255; 4]);
    mask.row_mut(2)[3] = [0; 4];
    write_picture(&folder.path("mask.png"), &FilePicture::stored(mask)).unwrap();
    for flags in ["--mask mask.png", "--region 0,0,3,6"] {
        let command = format!("diff ref/a.png now/a.png --fail-above 1 {flags}");
        folder
            .run(&command)
            .refused(&[nothing, "of those that are not left out"]);
    }
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
        ("../now/b.png", "leads to the file of a picture, now/b.png"),
        // This reference is equal to its picture, and would not be approved.
        ("a.png", "leads to the file of a reference, ref/a.png"),
        ("b.png", "leads to the file of a reference, ref/"),
    ] {
        fs::remove_file(&read_only).unwrap();
        std::os::unix::fs::symlink(target, &read_only).unwrap();
        let before = all_files(&folder.path("ref"));
        folder
            .run("diff ref now --approve")
            .refused(&["ref/c.png", problem]);
        assert_eq!(all_files(&folder.path("ref")), before);
    }
    // A link to a folder hides references, which are not replaced unseen.
    fs::remove_file(&read_only).unwrap();
    write(&folder, "store/f.png", 7);
    write(&folder, "now/hidden/f.png", 9);
    std::os::unix::fs::symlink("../store", folder.path("ref/hidden")).unwrap();
    let before = folder.read("store/f.png");
    folder
        .run("diff ref now --approve")
        .differs()
        .prints("unreadable  hidden/f.png  ref/hidden/f.png is there, but was not listed")
        .says("1 file is left out");
    assert_eq!(folder.read("store/f.png"), before);
    fs::remove_file(folder.path("ref/hidden")).unwrap();
    fs::remove_dir_all(folder.path("now/hidden")).unwrap();
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
        .prints("8 pictures: ")
        // The link to the folder, and the device.
        .says("2 files are left out");
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
    assert!(xml.contains("in now: expected one, or no reference: remove ref/in/gone.png"));
    let piped = folder
        .run("diff ref now --fail-above 2 --junit -")
        .differs();
    assert!(piped.out.starts_with("<?xml ") && piped.err.contains("6 pictures: "));
}

#[test]
fn junit_has_no_failure_after_all_were_approved() {
    let folder = folders();
    fs::remove_file(folder.path("ref/in/gone.png")).unwrap();
    let approve = "diff ref now --fail-above 2 --approve --junit j.xml --html p.html --json";
    let ended = folder.run(approve).done();
    let pairs = ended.json()["pairs"].clone();
    assert!(
        pairs
            .as_array()
            .unwrap()
            .iter()
            .all(|pair| pair["failed"] == false)
    );
    let xml = String::from_utf8(folder.read("j.xml")).unwrap();
    assert_eq!(xml.matches("failures=\"0\" errors=\"0\"").count(), 2);
    assert!(
        !xml.contains("<failure") && !xml.contains("<error"),
        "{xml}"
    );
    let page = String::from_utf8(folder.read("p.html")).unwrap();
    assert!(!page.contains("data-fails=\"true\""));
}

/// References stay if one of them cannot be written, and the XML says what was found.
#[test]
fn junit_has_the_failures_if_nothing_could_be_approved() {
    let folder = folders();
    fs::create_dir_all(folder.path("ref/in/new/e.png")).unwrap();
    folder
        .run("diff ref now --approve --junit j.xml")
        .refused(&["ref/in/new/e.png: cannot be written"]);
    let xml = String::from_utf8(folder.read("j.xml")).unwrap();
    assert!(xml.contains("failures=\"4\" errors=\"0\""), "{xml}");
}

#[cfg(unix)]
#[test]
fn different_names_are_different_cases() {
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    let names: [&[u8]; 8] = [
        b"a.b/n.png",
        b"a/b/n.png",
        b"\n.png",
        b"\\x0A.png",
        b"\xC2\x85.png",
        b"\x85.png",
        "\u{fffe}.png".as_bytes(),
        "\u{ffff}.png".as_bytes(),
    ];
    write(&folder, "x.png", 0);
    for name in names {
        let path = folder.path("ref").join(std::ffi::OsStr::from_bytes(name));
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::copy(folder.path("x.png"), path).unwrap();
    }
    fs::create_dir(folder.path("now")).unwrap();
    let ended = folder.run("diff ref now --junit j.xml --json").differs();
    let xml = String::from_utf8(folder.read("j.xml")).unwrap();
    let cases = xml.split("<testcase ").skip(1);
    let cases = cases.filter_map(|case| case.split(" time=").next());
    let cases: std::collections::BTreeSet<&str> = cases.collect();
    assert_eq!(cases.len(), names.len(), "{cases:?}");
    let pairs = ended.json()["pairs"].clone();
    let listed = pairs.as_array().unwrap().iter().map(|pair| &pair["name"]);
    let listed: std::collections::BTreeSet<String> = listed.map(Value::to_string).collect();
    assert_eq!(listed.len(), names.len(), "{listed:?}");
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

#[test]
fn new_pictures_that_the_mask_or_the_region_does_not_fit_are_not_approved() {
    let folder = Folder::new();
    fs::create_dir(folder.path("r")).expect("a folder");
    write(&folder, "n/new.png", 1);
    let mask = FilePicture::stored(Picture8::new(1, 1, [255; 4]));
    write_picture(&folder.path("mask.png"), &mask).expect("a mask");
    for flag in ["--mask mask.png", "--region 100,100,5,5"] {
        let ended = folder.run(&format!("diff r n {flag} --approve"));
        ended.differs().prints("unreadable  new.png");
        assert!(!folder.path("r/new.png").exists(), "{flag}");
    }
}

#[cfg(unix)]
#[test]
fn new_pictures_behind_a_link_to_a_folder_are_not_approved() {
    let folder = Folder::new();
    for name in ["outside", "r"] {
        fs::create_dir(folder.path(name)).expect("a folder");
    }
    write(&folder, "n/sub/new.png", 1);
    std::os::unix::fs::symlink("../outside", folder.path("r/sub")).expect("a link");
    let ended = folder.run("diff r n --approve");
    ended.differs().prints("r/sub is a link: expected a folder");
    assert!(!folder.path("outside/new.png").exists());
}
