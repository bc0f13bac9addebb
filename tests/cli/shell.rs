//! `fastphong completions` and `fastphong man`.

use super::Folder;

#[test]
fn every_shell_has_completions() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = folder.run(&format!("completions {shell}")).done();
        for word in ["fastphong", "render", "shininess", "quiet"] {
            assert!(script.out.contains(word), "{shell} lacks {word}");
        }
    }
    folder
        .run("completions dash")
        .refused(&["bash, elvish, fish, powershell, zsh"]);
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = Folder::new();
    let page = folder.run("man").done().prints(".TH fastphong 1").out;
    assert!(page.contains("fastphong\\-render(1)"), "{page}");
    folder.run("man pages/man1").done();
    let pages = std::fs::read_dir(folder.path("pages/man1"))
        .unwrap()
        .count();
    let render = String::from_utf8(folder.read("pages/man1/fastphong-render.1")).unwrap();
    assert!(pages >= 12 && render.contains("shininess"), "{pages} pages");
    folder.write("file", "");
    folder
        .run("man file")
        .refused(&["file: cannot be written: "]);
}
