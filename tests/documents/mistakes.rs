//! Writes the table of how much each mistake changes each shipped scene, or checks that it is
//! current.
//!
//! `FASTPHONG_BLESS=1 cargo test --test documents mistakes` draws every mistake that
//! `fastphong diagnose` knows on every shipped scene except `million`. It writes
//! `program/src/diagnose/shown_by_table.rs` and `docs/mistakes.md`. The document is made from the
//! compiled table, so bless twice.

use crate::markdown::{read, root};
use fastphong::scene::input::{SCENES, ShippedScene, resolve};
use fastphong_cli::diagnose::{MISTAKES, Part, scenes_that_show, shown};
use std::fmt::Write;
use std::thread;

const TABLE: &str = "program/src/diagnose/shown_by_table.rs";
const DOCUMENT: &str = "docs/mistakes.md";

/// Returns, for each mistake, by how many hundredths of a grey level it changes a scene's picture.
fn levels(shipped: &ShippedScene) -> Vec<u16> {
    let file = shipped.load().expect("a shipped scene");
    let mut scene = resolve(&file).expect("a shipped scene").scene;
    (scene.width, scene.height, scene.samples) = (320, 240, 1);
    let shown = shown(&scene).expect("a scene that can be drawn");
    let rounded = |levels: f64| (levels * 100.0).round() as u16;
    shown
        .into_iter()
        .map(|levels| levels.map_or(0, rounded))
        .collect()
}

/// Returns the table as code.
fn table() -> String {
    let scenes: Vec<&ShippedScene> = SCENES
        .iter()
        .filter(|scene| scene.name != "million")
        .collect();
    let columns: Vec<Vec<u16>> = thread::scope(|scope| {
        let work: Vec<_> = scenes
            .iter()
            .map(|scene| scope.spawn(|| levels(scene)))
            .collect();
        work.into_iter()
            .map(|column| column.join().expect("levels of a scene"))
            .collect()
    });
    let mut text = String::from(
        "//! How far each mistake changes each shipped scene: written by\n//! `FASTPHONG_BLESS=1 cargo test --test documents mistakes`.\n\n/// The scenes, in the order of columns.\n#[rustfmt::skip]\npub const SHOWING: &[&str] = &[",
    );
    scenes
        .iter()
        .for_each(|scene| write!(text, "\"{}\", ", scene.name).unwrap());
    text += "];\n\n/// The grey levels, times 100, by which each mistake changes the picture of each scene.\n#[rustfmt::skip]\npub const SHOWN: &[(&str, &[u16])] = &[\n";
    for (i, mistake) in MISTAKES.iter().enumerate() {
        let row: Vec<String> = columns.iter().map(|column| column[i].to_string()).collect();
        writeln!(text, "    (\"{}\", &[{}]),", mistake.id, row.join(", ")).unwrap();
    }
    text + "];\n"
}

/// Returns the document of all mistakes.
fn document() -> String {
    let mut text = read(DOCUMENT);
    let end = text
        .find("<!-- generated -->")
        .expect("the place of the tables");
    text.truncate(end);
    text += "<!-- generated -->\n";
    let parts = [
        (Part::Light, "Light"),
        (Part::Rate, "Rate and interpolation"),
        (Part::Normals, "Normals"),
        (Part::Camera, "Camera and place"),
        (Part::Geometry, "Polygons and what hides them"),
        (Part::Picture, "The picture"),
    ];
    for (part, title) in parts {
        write!(text, "\n## {title}\n\n| id | mistake | what to do | read on | shown by (grey levels) |\n|---|---|---|---|---|\n").unwrap();
        for mistake in MISTAKES.iter().filter(|mistake| mistake.part == part) {
            let shown = scenes_that_show(&mistake.id);
            let shown: Vec<String> = shown
                .iter()
                .take(3)
                .map(|(scene, levels)| format!("{scene} {levels:.1}"))
                .collect();
            let shown = if shown.is_empty() {
                "none".to_owned()
            } else {
                shown.join(", ")
            };
            let cells = [&*mistake.text, &*mistake.fix, &mistake.read_on(), &shown]
                .map(|cell| cell.replace('|', "\\|"));
            writeln!(text, "| `{}` | {} |", mistake.id, cells.join(" | ")).unwrap();
        }
    }
    text
}

#[test]
fn scenes_show_mistakes_as_the_table_says() {
    let (table, document) = (table(), document());
    if std::env::var_os("FASTPHONG_BLESS").is_some() {
        std::fs::write(root().join(TABLE), table).unwrap();
        std::fs::write(root().join(DOCUMENT), document).unwrap();
        return;
    }
    let bless = "FASTPHONG_BLESS=1 cargo test --test documents mistakes";
    let same = |old: &str, new: &str| {
        old.lines()
            .zip(new.lines())
            .find(|(a, b)| a != b)
            .map(|(a, b)| format!("{a}\n{b}"))
    };
    assert_eq!(same(&read(TABLE), &table), None, "{TABLE}: {bless}");
    assert_eq!(
        same(&read(DOCUMENT), &document),
        None,
        "{DOCUMENT}: {bless}"
    );
    let count = format!("{} mistakes", MISTAKES.len());
    assert!(
        read("README.md").contains(&count),
        "README.md does not say {count}"
    );
    // `diagnose` cannot name a mistake that no scene shows, unless the user's own scene shows it.
    let unseen = MISTAKES
        .iter()
        .filter(|mistake| scenes_that_show(&mistake.id).is_empty());
    let unseen: Vec<&str> = unseen.map(|mistake| &*mistake.id).collect();
    assert_eq!(unseen, UNSEEN, "mistakes that no shipped scene shows");
}

/// Mistakes that no shipped scene shows. In these scenes no single light is over 1, and Phong
/// shading is right by default. No scene is two-sided, square, or shows a back face or a polygon in
/// front of the near plane, and few pixels tie.
const UNSEEN: &[&str] = &[
    "clamped-per-light",
    "per-pixel",
    "one-sided",
    "transposed",
    "cull-back",
    "near-left-out",
    "depth-ties-to-last",
];
