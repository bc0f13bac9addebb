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
        .refused(&["file is a file: expected a folder"]);
}

/// Returns what bash offers for the last of `words`.
#[cfg(unix)]
fn offered(folder: &Folder, words: &[&str]) -> Vec<String> {
    folder.write("script", folder.run("completions bash").done().out);
    let [.., before, last] = words else {
        panic!("a command and a word")
    };
    // A script is completed as bash would do it; `compopt` only works within bash's own call.
    let call = "compopt() { :; }; . ./script; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); \
                _fastphong fastphong \"$A\" \"$B\"; printf '%s\\n' \"${COMPREPLY[@]}\"";
    let mut bash = std::process::Command::new("bash");
    bash.args(["-c", call, "bash"]).args(words);
    let output = bash
        .env("A", last)
        .env("B", before)
        .current_dir(folder.path(""));
    let output = output.output().expect("bash runs");
    let lines = String::from_utf8(output.stdout).expect("text");
    lines.lines().map(str::to_owned).collect()
}

#[cfg(unix)]
#[test]
fn bash_completes_methods_and_paths_with_spaces() {
    let folder = Folder::new();
    folder.write("my picture.png", "").write("my other.png", "");
    let offered = |line: &str, last: &str| {
        let words = line.split(' ').chain([last]);
        offered(&folder, &words.collect::<Vec<_>>())
    };
    assert_eq!(offered("fastphong render --method", "refer"), ["reference"]);
    assert_eq!(offered("fastphong compare -m", "hybr"), ["hybrids"]);
    assert_eq!(offered("fastphong explain", "slerp-h"), ["slerp-half"]);
    assert_eq!(offered("fastphong diagnose --as", "naive"), ["naive-phong"]);
    assert_eq!(offered("fastphong render --engine", "cs"), ["cs171"]);
    assert_eq!(offered("fastphong figure", "newe"), ["newell"]);
    for flag in [
        "render --output",
        "render -o",
        "render --mask",
        "diff --html",
    ] {
        let mut files = offered(&format!("fastphong {flag}"), "my");
        files.sort();
        assert_eq!(files, ["my other.png", "my picture.png"], "{flag}");
    }
    // Numbers are no files.
    assert_eq!(offered("fastphong render --fovy", "m"), ["m"]);
}
