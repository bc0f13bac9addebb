//! `docs/flags.md` shows for each flag of `fastphong render` a picture without the flag and one
//! with it.
//!
//! `FASTPHONG_BLESS=1 cargo test --test documents flags` makes the page and its pictures from the
//! rows of `src/scene/file/schema.rs` and the tool's help. Look at each pair before you commit it.

use crate::markdown::{files, read, root};
use fastphong::picture::image_file::decode_picture;
use fastphong::scene::file::schema::KEYS;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::process::Command;

/// Flags that change the picture but set no key of a scene. Each row has the name, the default if
/// the help states none, and arguments of `render` without and with the flag.
#[rustfmt::skip]
const FLAGS: [[&str; 4]; 4] = [
    ["method", "", "coarse-sphere", "coarse-sphere --method gouraud"],
    ["engine", "", "two-lights", "two-lights --engine cs171:normals=as-printed"],
    ["aov", "off", "teapot", "teapot --aov normal"],
    ["square", "", "terrain --aov checkerboard", "terrain --aov checkerboard --square 0.25"],
];

/// Returns all flags that change the picture: those that set keys of scenes, and [`FLAGS`].
fn flags() -> impl Iterator<Item = [&'static str; 4]> {
    let keys = KEYS.iter().filter_map(|key| key.flag);
    let rows = keys.map(|flag| [flag.name, flag.default, flag.pictures[0], flag.pictures[1]]);
    rows.chain(FLAGS)
}

/// Flags that do not change the picture, except by rounding of single pixels.
#[rustfmt::skip]
const OTHERS: &[&str] = &[
    "output", "format", "input-format", "simd", "threads", "print-scene", "stats", "watch", "reference", "reference-threshold", "allow", "radius", "mask", "region", "force", "verbose", "quiet", "help",
];

const PAGE: &str = "docs/flags.md";
const PICTURES: &str = "docs/images/flags";
/// The most bytes that all pictures may have together.
const MOST_BYTES: usize = 410_000;

const HEAD: &str = "# Flags and what they do to the picture

Each flag of `fastphong render` with a picture without it and one with it. Under each picture is what follows `fastphong render`.
All are drawn with `--size 160x120 --method naive-phong --simd scalar` as well, unless the row says otherwise.

`FASTPHONG_BLESS=1 cargo test --test documents flags` makes this page; `cargo test --test documents flags` checks that it and its
pictures are up to date.

| flag | default | meaning | without | with |
|---|---|---|---|---|
";

fn run(arguments: &str) -> Vec<u8> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fastphong"));
    let output = command
        .args(arguments.split_whitespace())
        .output()
        .expect("the tool runs");
    let problem = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments}: {problem}");
    output.stdout
}

/// Draws a picture. Returns it as a PNG file.
fn draw(command: &str) -> Vec<u8> {
    let mut full = format!("render {command} --quiet -o -");
    for (flag, fixed) in [
        ("--resolution", "--resolution 160x120"),
        ("--aov --method", "--method naive-phong"),
        ("--aov --engine", "--simd scalar"),
    ] {
        if !flag.split(' ').any(|flag| command.contains(flag)) {
            full += &format!(" {fixed}");
        }
    }
    run(&full)
}

/// Returns, for each flag in the help of `render`, its first sentence and its default, which may be
/// empty.
fn help() -> BTreeMap<String, [String; 2]> {
    let text = String::from_utf8(run("render --help")).expect("text");
    let mut texts: BTreeMap<String, String> = BTreeMap::new();
    let mut name = String::new();
    for line in text.lines() {
        let trimmed = line.trim();
        let is_flag = trimmed.starts_with('-') && line.len() - trimmed.len() < 8;
        if let Some((_, flag)) = trimmed.split_once("--").filter(|_| is_flag) {
            let end = flag.find([' ', '=']).unwrap_or(flag.len());
            name = flag[..end].to_owned();
            texts.insert(name.clone(), String::new());
        } else if !line.is_empty() && !line.starts_with(' ') {
            // A heading of a group of flags ends the text of the flag before it.
            name.clear();
        } else if let Some(text) = texts.get_mut(&name) {
            *text += &format!(" {trimmed}");
        }
    }
    let parts = |text: String| {
        let (_, default) = text.split_once("[default: ").unwrap_or_default();
        let default = default.split(']').next().unwrap_or_default();
        let ends = [". ", "[", " Possible values:"].into_iter();
        let end = ends.filter_map(|end| text.find(end)).min();
        let sentence = &text[..end.unwrap_or(text.len())];
        [sentence, default].map(|part| part.trim().replace('|', "\\|"))
    };
    let texts = texts.into_iter();
    texts.map(|(name, text)| (name, parts(text))).collect()
}

/// Returns the path of the picture that a command draws.
fn file(command: &str) -> String {
    let words: Vec<&str> = command
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .collect();
    format!("{PICTURES}/{}.png", words.join("-"))
}

fn page(help: &BTreeMap<String, [String; 2]>) -> String {
    let mut page = HEAD.to_owned();
    for [flag, default, without, with] in flags() {
        let [sentence, in_help] = &help[flag];
        let default = if in_help.is_empty() {
            default
        } else {
            in_help.as_str()
        };
        let picture = |command| {
            let file = file(command).replace("docs/", "");
            format!("![{command}]({file})<br>`{command}`")
        };
        let (without, with) = (picture(without), picture(with));
        page += &format!("| `--{flag}` | {default} | {sentence} | {without} | {with} |\n");
    }
    page += "\n## Flags that leave the picture as it is\n\n";
    for flag in OTHERS {
        page += &format!("- `--{flag}`: {}\n", help[*flag][0]);
    }
    page
}

#[test]
fn flags_of_render_are_in_the_page() {
    let shown = flags().map(|row| row[0]);
    let known: BTreeSet<&str> = shown.chain(OTHERS.iter().copied()).collect();
    let help = help();
    let in_help: BTreeSet<&str> = help.keys().map(String::as_str).collect();
    assert_eq!(
        in_help, known,
        "flags of `render --help`, and those of this file"
    );
    let page = page(&help);
    if std::env::var_os("FASTPHONG_BLESS").is_some() {
        std::fs::write(root().join(PAGE), &page).expect(PAGE);
    }
    assert!(read(PAGE) == page, "{PAGE} is not what the tool makes");
}

#[test]
fn flags_have_the_pictures_that_the_tool_draws() {
    let commands: BTreeSet<&str> = flags().flat_map(|row| [row[2], row[3]]).collect();
    let drawn: BTreeMap<&str, Vec<u8>> = commands.into_iter().map(|c| (c, draw(c))).collect();
    let picture = |bytes: &[u8]| decode_picture(bytes).expect("a picture").to_stored();
    if std::env::var_os("FASTPHONG_BLESS").is_some() {
        let _ = std::fs::remove_dir_all(root().join(PICTURES));
        std::fs::create_dir_all(root().join(PICTURES)).expect(PICTURES);
        for (command, bytes) in &drawn {
            std::fs::write(root().join(file(command)), bytes).expect("a written picture");
        }
    }
    let mut bytes = 0;
    for (command, drawn) in &drawn {
        let file = file(command);
        let stored = std::fs::read(root().join(&file)).expect(&file);
        assert!(
            picture(&stored) == picture(drawn),
            "{file} is not what `{command}` draws"
        );
        bytes += stored.len();
    }
    assert!(bytes < MOST_BYTES, "{bytes} bytes of pictures");
    let named: BTreeSet<PathBuf> = drawn.keys().map(|c| PathBuf::from(file(c))).collect();
    let stored: BTreeSet<PathBuf> = files(PICTURES, "png").into_iter().collect();
    assert_eq!(stored, named, "a picture for each command and no other");
    for [flag, _, without, with] in flags() {
        let [without, with] = [without, with].map(|command| picture(&drawn[command]));
        assert!(without != with, "--{flag} makes no difference");
    }
}
