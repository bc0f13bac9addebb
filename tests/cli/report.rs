//! `fastphong report`.

use super::Folder;

/// Errors and pictures as ever, of few pixels, and no more rounds than need be.
const QUICK: &str = "--size 48x36 --time-budget 0";

#[test]
fn the_page_is_written_and_its_path_printed() {
    let folder = Folder::new();
    let ended = folder.run(&format!(
        "report coarse-sphere builtin:prism {QUICK} --methods fast-phong:steps=1,flat"
    ));
    ended.done().prints("report/index.html\n");
    let html = String::from_utf8(folder.read("report/index.html")).unwrap();
    assert!(html.starts_with("<!DOCTYPE html>") && html.ends_with("</html>\n"));
    for text in [
        "Coarse sphere",
        "builtin:prism",
        ">naive-phong</th>",
        ">fast-phong:steps=1</th>",
        ">flat</th>",
    ] {
        assert!(html.contains(text), "{text}");
    }
    assert!(
        !html.contains(">slerp-phong</th><td>"),
        "it was not asked for"
    );
    let command = format!(
        "fastphong report coarse-sphere builtin:prism {QUICK} --methods fast-phong:steps=1,flat"
    );
    assert!(
        html.contains(&format!("<code>{command}</code>")),
        "the page says how it was made"
    );
    assert_eq!(folder.names(), ["report"], "nothing is written elsewhere");
}

#[test]
fn figures_of_the_lectures_stand_in_the_page_on_demand() {
    let folder = Folder::new();
    folder
        .run(&format!(
            "report figure5 {QUICK} --methods flat --figures exercises,exercises"
        ))
        .done();
    let html = String::from_utf8(folder.read("report/index.html")).unwrap();
    assert_eq!(html.matches("<article id=\"figure-exercises\"").count(), 1);
    assert!(html.contains("<a href=\"#lecture\">") && html.contains("\"key\":\"sine\""));
    folder
        .run(&format!("report figure5 {QUICK} --methods flat"))
        .done();
    assert!(
        !String::from_utf8(folder.read("report/index.html"))
            .unwrap()
            .contains("id=\"lecture\""),
        "with INPUT: none"
    );
}

/// One method besides naive Phong: frames of 1920 × 1080 pixels are slow in a build for tests.
#[test]
fn studies_stand_in_the_page_on_demand() {
    let folder = Folder::new();
    folder
        .run(&format!(
            "report figure5 {QUICK} --methods fast-phong --studies speedups --markdown -o p.html"
        ))
        .done();
    let html = String::from_utf8(folder.read("p.html")).unwrap();
    assert!(html.contains("<section id=\"speedups\">") && html.contains("\"scaling\":null"));
    let first = html
        .split("<p class=\"opening\">")
        .nth(1)
        .and_then(|rest| rest.split("</p>").next())
        .unwrap();
    assert!(
        first.starts_with("Naive Phong ") && first.contains("whole frames"),
        "{first}"
    );
    let text = String::from_utf8(folder.read("README.md")).unwrap();
    assert!(
        text.starts_with("# Shading methods compared\n\nNaive Phong "),
        "{text}"
    );
    folder
        .run(&format!("report figure5 {QUICK} --methods flat"))
        .done();
    let without = String::from_utf8(folder.read("report/index.html")).unwrap();
    assert!(
        without.contains("\"speedups\":null") && !without.contains("id=\"scaling\""),
        "with INPUT: none"
    );
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
fn what_cannot_be_written_is_said_and_what_was_there_is_kept() {
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
        .refused(&["`no-such` is neither a file nor"]);
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
