//! `docs/flags.md` has a row for each key of a scene file and each flag of `fastphong render`, with
//! a picture without the flag and one with it.
//!
//! `FASTPHONG_BLESS=1 cargo test --test documents flags` makes the page and its pictures from the
//! rows of `src/scene/file/schema.rs` and the tool's help. Look at each pair before you commit it.

use crate::markdown::{files, read, root};
use fastphong::picture::image_file::decode_picture;
use fastphong::scene::file::schema::{KEYS, Key, ValueKind};
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

/// Keys without a flag of their own: path, default, and what the key does.
#[rustfmt::skip]
const WITHOUT_FLAG: &[[&str; 3]] = &[
    ["title", "none", "Title for captions"],
    ["description", "none", "What the scene shows"],
    ["image.height", "480", "Height of the picture; `--resolution` sets it with the width"],
    ["camera.elevation", "from `direction`", "Degrees above the horizon; `--view` sets it with the azimuth"],
    ["camera.direction", "`[0.5, 0.3, 1]`", "Toward the eye, in place of `azimuth` and `elevation`"],
    ["light.colour", "1", "Colour of the light"],
    ["light.intensity", "1", "Factor on the colour"],
    ["object.mesh", "needed", "A mesh file relative to the scene file, `builtin:NAME?key=value&key=value`, or `-` for standard input"],
    ["object.crease", "none", "In place of `normals`: the largest angle in degrees between polygons that are averaged, regardless of smoothing groups"],
    ["object.scale", "1", "Scale the object, before it is rotated; negative mirrors"],
    ["object.rotate", "none", "Rotate it: `{ axis = [x, y, z], angle = degrees }` or a list, the first one first"],
    ["object.translate", "0", "Move it, last"],
    ["object.matrix", "none", "Three rows of four numbers, in place of `scale`, `rotate` and `translate`"],
    ["object.material", "none", "A table like `material`, which replaces the materials of the mesh; missing keys come from `material`"],
];

/// Flags that do not change the picture, except by rounding of single pixels.
#[rustfmt::skip]
const OTHERS: &[&str] = &[
    "output", "format", "input-format", "simd", "threads", "print-scene", "stats", "watch", "reference", "reference-threshold", "allow", "radius", "mask", "region", "force", "verbose", "quiet", "help",
];

const PAGE: &str = "docs/flags.md";
const PICTURES: &str = "docs/images/flags";
/// The most bytes that all pictures may have together.
const MOST_BYTES: usize = 410_000;

const HEAD: &str = "# Keys, flags and Python arguments

Each setting of a picture, with its key in a [scene file](../scenes/README.md), its flag of `fastphong render`, and its argument
in [Python](python.md). A key without an argument goes into `scene`, as in `fp.render(mesh, scene={\"specular\": \"blinn\"})`;
not so keys of `object`, because the mesh is the object.
The pictures are without the flag and with it; below them is what follows `fastphong render`. All are drawn with
`--size 160x120 --method naive-phong --simd scalar` as well, unless the row says otherwise.

`FASTPHONG_BLESS=1 cargo test --test documents flags` makes this page; `cargo test --test documents flags` checks that it and its
pictures are up to date.

| key | flag | Python | value | default | what it does | without, with |
|---|---|---|---|---|---|---|
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

/// Returns the arguments of Python that set keys: pairs of a key and its argument.
fn arguments() -> BTreeMap<String, String> {
    let source = read("python/src/settings.rs");
    let (_, list) = source.split_once("const ARGUMENTS").expect("the list");
    let (list, _) = list.split_once("];").expect("its end");
    let words: Vec<&str> = list.split('"').skip(1).step_by(2).collect();
    let pairs = words.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
    pairs.map(|pair| pair.map(str::to_owned).into()).collect()
}

/// Returns the argument of Python that sets a key, or nothing if it goes into `scene`. A key that
/// `arguments` lacks has one if its first name is an argument of `settings`.
fn argument(arguments: &BTreeMap<String, String>, key: &str) -> String {
    let first = key.split('.').next().unwrap_or_default();
    let keys = read("python/fastphong/_keys.py");
    let (_, settings) = keys.split_once("\ndef settings(").expect("a function");
    let (settings, _) = settings.split_once(") -> str").expect("its end");
    let is_argument = settings.contains(&format!("\n    {first}: "));
    let found = arguments.get(key).map(String::as_str);
    let found = found.or(is_argument.then_some(first));
    found.map_or(String::new(), |name| format!("`{name}`"))
}

/// Describes the values of a key.
fn values(kind: ValueKind) -> String {
    match kind {
        ValueKind::Text => "text".into(),
        ValueKind::Switch => "`true`, `false`".into(),
        ValueKind::Whole => "whole number".into(),
        ValueKind::Number => "number".into(),
        ValueKind::Triple => "`[x, y, z]`".into(),
        ValueKind::OneOrThree => "number or `[r, g, b]`".into(),
        ValueKind::Axis => "`[x, y, z]` or an axis".into(),
        ValueKind::Matrix => "3 × 4 numbers".into(),
        ValueKind::Word(words) => {
            let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
            words.join(", ")
        }
        ValueKind::Table(_) => "table".into(),
        ValueKind::Tables(_) => "tables".into(),
        ValueKind::Turns => "table or list".into(),
    }
}

/// Returns the pictures of a row, with the commands that draw them. The first command is left out
/// if the second begins with it.
fn pictures([without, with]: [&str; 2]) -> String {
    let picture =
        |text: &str, command| format!("![{text}]({})", file(command).replace("docs/", ""));
    let before = if with.starts_with(without) {
        String::new()
    } else {
        format!("`{without}`, ")
    };
    let (a, b) = (picture("without", without), picture("with", with));
    format!("{a} {b}<br>{before}`{with}`")
}

fn page(help: &BTreeMap<String, [String; 2]>) -> String {
    let mut page = HEAD.to_owned();
    let arguments = arguments();
    let default = |flag: &str, default: &'static str| {
        let in_help = help[flag][1].clone();
        if in_help.is_empty() {
            default.to_owned()
        } else {
            in_help
        }
    };
    for Key {
        path, kind, flag, ..
    } in KEYS
    {
        let python = argument(&arguments, path);
        let own = WITHOUT_FLAG.iter().find(|[key, ..]| key == path);
        let cells = match (flag, own) {
            (Some(flag), _) => {
                let (default, meaning) = (default(flag.name, flag.default), &help[flag.name][0]);
                let pictures = pictures(flag.pictures);
                format!(
                    "`--{}` | {python} | {} | {default} | {meaning} | {pictures}",
                    flag.name,
                    values(*kind)
                )
            }
            (None, Some([_, default, meaning])) => {
                format!("| {python} | {} | {default} | {meaning} |", values(*kind))
            }
            // Tables hold other keys, and an axis and an angle stand in a rotation.
            (None, None) => continue,
        };
        page += &format!("| `{path}` | {cells} |\n");
    }
    for [flag, in_row, without, with] in FLAGS {
        let python = if flag == "method" { "`method`" } else { "" };
        let (default, meaning) = (default(flag, in_row), &help[flag][0]);
        let pictures = pictures([without, with]);
        page += &format!("| | `--{flag}` | {python} | | {default} | {meaning} | {pictures} |\n");
    }
    let others: Vec<String> = OTHERS.iter().map(|flag| format!("`--{flag}`")).collect();
    page + &format!(
        "\nThese flags leave the picture as it is, and `fastphong render --help` says what they do: {}.\n",
        others.join(", ")
    )
}

/// Every key has a row, except tables, whose keys have rows.
#[test]
fn every_key_has_a_row() {
    let is_table = |kind| matches!(kind, ValueKind::Table(_) | ValueKind::Tables(_));
    for key in KEYS.iter().filter(|key| !key.path.starts_with("turn.")) {
        let own = WITHOUT_FLAG.iter().any(|[path, ..]| *path == key.path);
        let is_shown = key.flag.is_some() != own;
        assert!(is_shown || is_table(key.kind), "{}", key.path);
    }
    let known = |path: &str| KEYS.iter().any(|key| key.path == path);
    for [path, ..] in WITHOUT_FLAG {
        assert!(known(path), "there is no key `{path}`");
    }
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
