//! `fastphong report`.

use super::Folder;

/// Full errors and pictures, with few pixels and as few rounds as possible.
const QUICK: &str = "--size 48x36 --time-budget 0";

/// Reads a page.
fn page(folder: &Folder, path: &str) -> String {
    String::from_utf8(folder.read(path)).unwrap()
}

/// Returns the document embedded in a page.
fn data(html: &str) -> serde_json::Value {
    let start = "id=\"fastphong-data\">";
    let text = &html[html.find(start).unwrap() + start.len()..];
    serde_json::from_str(&text[..text.find("</script>").unwrap()]).unwrap()
}

#[test]
fn the_page_is_written_and_its_path_printed() {
    let folder = Folder::new();
    let ended = folder.run(&format!(
        "report coarse-sphere builtin:prism {QUICK} --methods fast-phong:steps=1,flat"
    ));
    ended.done().prints("report/index.html\n");
    let html = page(&folder, "report/index.html");
    assert!(html.starts_with("<!doctype html>") && html.ends_with("</html>\n"));
    let data = data(&html);
    let titles: Vec<_> = data["comparisons"].as_array().unwrap().iter().collect();
    assert_eq!(titles[0]["title"], "Coarse sphere");
    assert_eq!(titles[1]["name"], "builtin:prism");
    let rows = titles[0]["rows"].as_array().unwrap();
    let drawn: Vec<_> = rows
        .iter()
        .filter_map(|row| row["variant"].as_str())
        .collect();
    assert_eq!(
        drawn,
        ["naive-phong", "fast-phong:steps=1", "flat"],
        "as asked for"
    );
    let command = format!(
        "fastphong report coarse-sphere builtin:prism {QUICK} --methods fast-phong:steps=1,flat"
    );
    assert!(
        html.contains(&format!("Made by {command}")),
        "the page says how it was made"
    );
    assert_eq!(folder.names(), ["report"], "nothing is written elsewhere");
}

#[test]
fn figures_of_the_lectures_stand_in_the_page_on_request() {
    let folder = Folder::new();
    folder
        .run(&format!(
            "report figure5 {QUICK} --methods flat --figures exercises,exercises"
        ))
        .done();
    let made = data(&page(&folder, "report/index.html"));
    let figures = made["figures"].as_array().unwrap();
    assert_eq!(figures.len(), 1);
    assert_eq!(figures[0]["name"], "exercises");
    assert_eq!(figures[0]["findings"][0]["key"], "sine");
    folder
        .run(&format!("report figure5 {QUICK} --methods flat"))
        .done();
    let without = data(&page(&folder, "report/index.html"));
    assert_eq!(
        without["figures"],
        serde_json::json!([]),
        "with INPUT: none"
    );
}

/// Experiments stand in the page on request. Only one method runs besides naive Phong, because
/// frames of 1920 × 1080 are slow in test builds.
#[test]
fn experiments_stand_in_the_page_on_request() {
    let folder = Folder::new();
    folder
        .run(&format!(
            "report figure5 {QUICK} --methods fast-phong --studies speedups --markdown -o p.html"
        ))
        .done();
    let html = page(&folder, "p.html");
    let made = data(&html);
    assert!(made["speedups"]["corners"].is_array() && made["scaling"].is_null());
    assert!(html.contains("<h2>The picture</h2><p>"));
    assert!(html.contains("<h2>Scalar code</h2><div class=\"answer\"><p>"));
    let text = page(&folder, "README.md");
    assert!(text.contains("frame, scalar, 1 light"), "{text}");
    folder
        .run(&format!("report figure5 {QUICK} --methods flat"))
        .done();
    let without = data(&page(&folder, "report/index.html"));
    assert!(without["speedups"].is_null() && without["scaling"].is_null());
    folder
        .run("report figure5 --studies scalling")
        .refused(&["did you mean `scaling`?"]);
    folder
        .run("report figure5 --studies speedups,x")
        .refused(&["expected `speedups` or `scaling`"]);
}

#[test]
fn the_markdown_and_its_pictures_stand_beside_the_page() {
    let folder = Folder::new();
    let ended = folder.run(&format!(
        "report football {QUICK} --markdown -o out/page.html"
    ));
    ended.done().prints("out/page.html\nout/README.md\n");
    let text = String::from_utf8(folder.read("out/README.md")).unwrap();
    assert!(text.contains("(images/01-football-reference.png)"));
    assert!(
        folder
            .read("out/images/01-football-fast-phong.png")
            .starts_with(b"\x89PNG")
    );
}

#[test]
fn write_errors_are_reported_and_old_files_kept() {
    let folder = Folder::new();
    folder.write("file", "old").write("page.html", "old");
    std::fs::create_dir(folder.path("folder")).unwrap();
    folder
        .run(&format!("report figure5 {QUICK} -o folder"))
        .refused(&["folder: cannot be written: it is a folder"]);
    folder
        .run(&format!("report figure5 {QUICK} -o file/page.html"))
        .refused(&["file/page.html: cannot be written"]);
    folder
        .run(&format!("report figure5 no-such {QUICK} -o page.html"))
        .refused(&["`no-such` is neither a file"]);
    folder
        .run(&format!(
            "report figure5 {QUICK} -o page.html --methods fats-phong"
        ))
        .refused(&["fast-phong"]);
    folder
        .run("report figure5 --time-budget soon -o page.html")
        .refused(&["expected seconds"]);
    assert_eq!(
        (folder.read("file"), folder.read("page.html")),
        (b"old".to_vec(), b"old".to_vec())
    );
    assert_eq!(
        folder.names(),
        ["file", "folder", "page.html"],
        "no draft is left"
    );
}

#[test]
fn scenes_are_drawn_at_the_size_at_which_the_page_shows_them() {
    let folder = Folder::new();
    folder
        .run("report figure5 --time-budget 0 --methods flat")
        .done();
    let made = data(&page(&folder, "report/index.html"));
    let scene = &made["comparisons"][0];
    let (width, height) = (
        scene["width"].as_u64().unwrap(),
        scene["height"].as_u64().unwrap(),
    );
    assert!(width <= 480 && height <= 360, "{width}x{height}");
}

#[test]
fn documents_are_shown_side_by_side_without_drawing() {
    let folder = Folder::new();
    folder
        .run(&format!(
            "report figure5 {QUICK} --methods flat --json a.json --csv a.csv -o a.html"
        ))
        .done()
        .prints("a.html\na.json\na.csv\n");
    assert!(page(&folder, "a.csv").contains("method,\"max, levels\""));
    // `--from` also accepts JSON of benchmarks and shows it beside the report.
    let bench = folder.run(&format!("compare figure5 {QUICK} --methods flat --json"));
    folder.write("b.json", bench.done().json().to_string());
    folder.run("report --from a.json b.json -o c.html").done();
    let made = data(&page(&folder, "c.html"));
    assert_eq!(made["beside"].as_array().unwrap().len(), 1);
    assert_eq!(made["beside"][0]["machine"], made["machine"]);
    assert!(!page(&folder, "c.html").contains("id=\"pictures-0\""));
    folder
        .write("bad.json", "{}")
        .run("report --from bad.json -o new/c.html")
        .refused(&["bad.json: no `schema`"]);
    assert!(!folder.path("new").exists(), "no folder is left");
    folder
        .run("report figure5 --from a.json")
        .refused(&["cannot be used with"]);
}

#[test]
fn a_mesh_called_script_is_shown_and_does_not_run() {
    let folder = Folder::new();
    let name = "<script>alert(1)<!--.obj";
    folder.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let mut command = folder.command("report --size 48x36 --time-budget 0");
    assert!(command.arg(name).output().unwrap().status.success());
    let html = page(&folder, "report/index.html");
    assert!(!html.contains("<script>alert"));
    assert_eq!(data(&html)["comparisons"][0]["name"], name);
}

/// A document that is cut off, has another schema, or is not text or not JSON is one error with its
/// place, and nothing is written.
#[test]
fn files_that_are_not_documents_are_refused_with_their_place() {
    let folder = Folder::new();
    let compared = folder.run(&format!("compare figure5 {QUICK} --methods flat --json"));
    let text = compared.done().out;
    let utf16: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let last = text.lines().count() - 1;
    folder
        .write("good.json", &text)
        .write("cut.json", &text[..text.len() - 3])
        .write("empty.json", "")
        .write("utf16.json", utf16)
        .write("newer.json", text.replace("bench/3", "bench/4"))
        .write(
            "nan.json",
            text.replacen("\"max\": ", "\"max\": NaN, \"x\": ", 1),
        )
        .write(
            "text.json",
            text.replacen("\"width\": 48", "\"width\": \"48\"", 1),
        );
    std::fs::create_dir(folder.path("folder.json")).expect("a folder");
    let end = format!("cut.json: EOF while parsing an object at line {last}");
    for (file, message) in [
        ("cut.json", &*end),
        (
            "empty.json",
            "empty.json: EOF while parsing a value at line 1",
        ),
        (
            "utf16.json",
            "utf16.json: cannot be read: it is not text in UTF-8",
        ),
        (
            "newer.json",
            "newer.json: schema `fastphong.bench/4`: expected `fastphong.bench/3`",
        ),
        ("nan.json", "nan.json: expected value at line "),
        (
            "text.json",
            "text.json: the document, comparisons 0, width: expected a number",
        ),
        ("folder.json", "folder.json: cannot be read: "),
        ("none.json", "none.json: cannot be read: "),
    ] {
        folder
            .run(&format!("report --from good.json {file} -o new/page.html"))
            .refused(&[message]);
        assert!(!folder.path("new").exists(), "{file}");
    }
}

/// The report reads documents of the previous schema. It leaves out values whose meaning has
/// changed since, and says so.
#[test]
fn values_that_cannot_be_compared_in_older_documents_are_named() {
    let folder = Folder::new();
    let compared = folder.run(&format!("compare figure5 {QUICK} --methods flat --json"));
    let text = compared.done().out;
    let said = "schema fastphong.bench/1: errors of the row engine, bounds, SSIM and FLIP cannot be compared";
    let old = text
        .replace("bench/3", "bench/1")
        .replace("\"typical\"", "\"median\"");
    folder.write("new.json", &text).write("old.json", old);
    let ended = folder
        .run("report --from new.json old.json -o both.html")
        .done();
    assert!(
        !ended.err.contains("new.json") && ended.err.contains(&format!("old.json: {said}")),
        "{}",
        ended.err
    );
    let html = page(&folder, "both.html");
    assert!(html.contains("Of documents of schema fastphong.bench/1: errors of the row engine"));
    let both = data(&html);
    let row = |document: &serde_json::Value| document["comparisons"][0]["rows"][0].clone();
    assert!(row(&both)["error"]["ssim"].is_f64() && row(&both)["bound"].is_f64());
    let old = row(&both["beside"][0]);
    assert!(
        old["error"]["ssim"].is_null() && old["bound"].is_null(),
        "{old}"
    );
    assert_eq!(old["error"]["max"], row(&both)["error"]["max"]);
    let ended = folder.run("report --from new.json -o one.html").done();
    assert_eq!(ended.err, "");
    assert!(!page(&folder, "one.html").contains("Of documents of schema"));
}

/// Several machines may each draw some scenes of a run. The joined parts equal the report that one
/// machine writes.
#[test]
fn four_parts_are_one_report() {
    let folder = Folder::new();
    let scenes = "report figure5 polygons coarse-sphere builtin:prism two-lights --size 48x36 -m kuijk-blake,gouraud";
    for part in 1..=4 {
        let own = format!("-q --threads {part} --shard {part}/4 --json {part}.json -o{part}.html");
        folder.run(&format!("{scenes} {own}")).done();
    }
    folder
        .run(&format!("{scenes} --shard=1/1 --json=whole.json"))
        .done();
    folder
        .run("report --from 3.json 1.json 4.json 2.json --json all.json --csv all.csv -o all.html")
        .done();
    let [mut all, mut whole, first] = ["all.json", "whole.json", "1.json"]
        .map(|name| serde_json::from_slice::<serde_json::Value>(&folder.read(name)).unwrap());
    let names = |data: &serde_json::Value| {
        let scenes = data["comparisons"].as_array().unwrap().iter();
        scenes.map(|s| s["name"].to_string()).collect::<Vec<_>>()
    };
    assert_eq!(names(&first), [r#""figure5""#, r#""two-lights""#]);
    assert_eq!(names(&all).len(), 5);
    for document in [&mut all, &mut whole] {
        for own in ["command_line", "date", "seconds"] {
            document.as_object_mut().unwrap().remove(own);
        }
    }
    assert_eq!(all, whole, "{:?}", names(&all));
    let described = include_str!("../../docs/bench-json.md");
    assert!(described.contains("`run`, `shard`"));
    // The joined report can also be shown beside another run.
    folder
        .run("report --from 3.json whole.json 1.json 4.json 2.json -o both.html")
        .done();
    let titles = page(&folder, "both.html")
        .matches("<!doctype html>")
        .count();
    assert_eq!(titles, 1);
}

#[test]
fn parts_that_do_not_make_a_report_are_refused() {
    let folder = Folder::new();
    let scenes = "report figure5 builtin:prism --size 48x36 -m gouraud";
    for part in 1..=2 {
        folder
            .run(&format!("{scenes} --shard {part}/2 --json {part}.json"))
            .done();
    }
    for (flags, said) in [
        (
            "--from 2.json",
            "2.json: of 2 parts of this run are missing: 1",
        ),
        (
            "--from 1.json 2.json 1.json",
            "1.json: part 1 of 2 is there twice",
        ),
        (
            "figure5 --shard 1/2",
            "there are fewer scenes than parts: expected at most 1",
        ),
        ("--shard 3/2", "expected a part of a whole"),
        ("--shard 1/2 --studies all", "cannot be used with"),
        ("--from 1.json 2.json --shard 1/2", "cannot be used with"),
    ] {
        folder.run(&format!("report {flags}")).refused(&[said]);
    }
    let other = String::from_utf8(folder.read("2.json"))
        .unwrap()
        .replace(r#""number": 2,"#, r#""number": 7,"#);
    folder.write("7.json", &other);
    folder
        .run("report --from 1.json 7.json")
        .refused(&["7.json: it says it is part 7 of 2"]);
}
