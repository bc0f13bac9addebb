//! `fastphong figure`.

use super::Folder;

#[test]
fn a_figure_becomes_a_page_and_pictures() {
    let folder = Folder::new();
    let ended = folder.run("figure exercises --pictures pictures");
    ended.done().prints(
        "report/figures/exercises.html\npictures/exercises-1.png\npictures/exercises-2.png\n",
    );
    let html = String::from_utf8(folder.read("report/figures/exercises.html")).unwrap();
    assert!(html.starts_with("<!doctype html>") && html.ends_with("</html>\n"));
    for text in [
        "id=\"lectures\"",
        "data:image/png",
        "\"key\":\"sine\"",
        "fastphong figure exercises",
    ] {
        assert!(html.contains(text), "{text}");
    }
    for loaded in ["src=\"http", "href=\"http", "url(http", "@import"] {
        assert!(!html.contains(loaded), "the page holds {loaded}");
    }
    assert!(
        folder
            .read("pictures/exercises-2.png")
            .starts_with(b"\x89PNG")
    );
}

#[test]
fn unknown_figures_are_rejected_before_anything_is_written() {
    let folder = Folder::new();
    folder
        .run("figure exrcises")
        .refused(&["unknown figure `exrcises`", "did you mean `exercises`?"]);
    folder
        .run("figure")
        .refused(&["which figure?", "fastphong list figures", "--all"]);
    folder
        .run("figure --all exercises")
        .refused(&["cannot be used with"]);
    folder
        .write("file", "old")
        .run("figure exercises -o file/page.html")
        .refused(&["file/page.html: cannot be written"]);
    folder
        .run("figure exercises --pictures file")
        .refused(&["file is a file: expected a folder"]);
    folder
        .run("report figure5 --figures sqare")
        .refused(&["unknown figure `sqare`"]);
    assert_eq!(folder.names(), ["file"], "no page is written");
}
