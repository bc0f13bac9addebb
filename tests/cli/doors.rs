//! Every warning and note reaches every command: `tests/doors.json` lists situations, and the notes
//! that each must give. The Python package and the page's module are tested with the same file.

use super::Folder;
use fastphong::note::{Door, Notes, Setting};
use fastphong::notes::{Cost, of_frame, of_meshes};
use fastphong::scene::open::{Look, Overlay, open};
use std::collections::BTreeMap;

/// A row of the file.
#[derive(serde::Deserialize)]
struct Situation {
    name: String,
    /// The scene or mesh file that is opened.
    input: String,
    /// The files by their names.
    files: BTreeMap<String, String>,
    /// All notes that the situation gives, at least.
    notes: Vec<Expected>,
}

#[derive(serde::Deserialize)]
struct Expected {
    kind: String,
    /// A part of the sentence that no door changes.
    says: String,
}

fn situations() -> Vec<Situation> {
    serde_json::from_str(include_str!("../doors.json")).expect("situations")
}

/// Leaves a gap where a door writes a setting.
struct Gaps;

impl Door for Gaps {
    fn setting(&self, _: &Setting) -> String {
        "\0".into()
    }
}

/// Returns the notes of a situation, as the library gives them.
fn notes(folder: &Folder, input: &str) -> Notes {
    let path = folder.path(input);
    let path = path.to_str().expect("a path of text");
    let opened = open(path, &Overlay::default(), Look::Shown).expect("a scene");
    let frame = opened.scene.frame().expect("a frame");
    let mut notes = opened.notes;
    notes.append(of_meshes(&opened.scene));
    let about_frame = of_frame(&opened.scene, &frame, Cost::Samples);
    notes.append(about_frame.without_stated(|key| opened.file.states(key)));
    notes
}

#[test]
fn every_note_reaches_every_command() {
    let mut kinds = Vec::new();
    for Situation {
        name,
        input,
        files,
        notes: expected,
    } in situations()
    {
        let folder = Folder::new();
        for (file, text) in &files {
            folder.write(file, text);
        }
        let notes = notes(&folder, &input);
        for Expected { kind, says } in &expected {
            let of_kind = notes.iter().filter(|note| note.kind == kind);
            let count = of_kind
                .filter(|note| note.to_string().contains(says))
                .count();
            assert_eq!(count, 1, "{name}: {kind}: {says}\n{notes}");
            kinds.push(kind.clone());
        }
        if expected.is_empty() {
            assert!(notes.is_empty(), "{name}: {notes}");
        }
        let size = if input.ends_with("toml") {
            ""
        } else {
            "--size 32x24"
        };
        folder
            .run(&format!("render {input} -o picture.png {size}"))
            .done();
        for command in [
            format!("render {input} -o again.png {size}"),
            format!("info {input} {size}"),
            format!("compare {input} --methods gouraud --time-budget 0 {size}"),
            format!("trace {input} --line 0 -o trace.json {size}"),
            format!("diagnose picture.png {input}"),
            format!("export {input} -o out {size}"),
        ] {
            let ended = folder.run(&command);
            let told = ended.err + &ended.out;
            for note in &notes {
                // `compare` looks at the mesh in another light, which may change what is clamped.
                let is_lit = note.kind.starts_with("light/") && !size.is_empty();
                // `info` leaves out the name of a mesh that it describes.
                let text = note.text(&Gaps);
                let text = text.rsplit_once(": ").map_or(&*text, |(_, text)| text);
                let has_all = text.split('\0').all(|part| told.contains(part));
                assert!(
                    has_all || is_lit,
                    "{name}: `{command}` lacks\n{text}\n{told}"
                );
            }
        }
    }
    // A kind that no situation shows might be lost at a door without anybody noticing.
    let is_shown = |kind: &&str| kinds.iter().any(|shown| shown == kind);
    let left: Vec<&str> = OF_SCENES
        .iter()
        .copied()
        .filter(|kind| !is_shown(kind))
        .collect();
    assert!(left.is_empty(), "no situation shows {left:?}");
}

/// The kinds that are about scenes and frames. Readers of mesh files have tests of their own.
const OF_SCENES: &[&str] = &[
    "behind-eye",
    "colours-unused",
    "depth/doubled",
    "depth/painter",
    "depth/ties",
    "eye-beyond",
    "inside-out",
    "interpolation",
    "left-out/all",
    "left-out/cancelling",
    "left-out/no-area",
    "left-out/unprojected",
    "light/clamped",
    "light/endless-highlight",
    "light/inside",
    "light/none",
    "material/over-one",
    "mesh/seams",
    "mesh/sharp",
    "mesh/up",
    "mesh/weld",
    "no-effect",
    "normals-missing",
    "normals-unused",
    "view-left-out",
    "view-of-file",
    "winding",
];

/// Returns the flags with their values that a sentence of the program suggests.
fn suggested(line: &str) -> Vec<String> {
    let words: Vec<&str> = line.split(' ').collect();
    let end = |word: &str| word.trim_end_matches([')', ',', ';', ':', '.']).to_string();
    let pairs = words.windows(3).filter_map(|three| {
        let flag = three[1].trim_start_matches('(');
        // "but --viewer local computes", "or leave out --viewer local" speak of a flag that is set.
        let is_advice = flag.starts_with("--") && !matches!(three[0], "but" | "out");
        is_advice.then(|| {
            // A flag without a value ends its part of the sentence.
            if end(flag) == flag {
                format!("{flag} {}", end(three[2]))
            } else {
                end(flag)
            }
        })
    });
    pairs.collect()
}

#[test]
fn what_a_note_suggests_changes_the_picture_or_ends_the_note() {
    let mut tried = 0;
    for Situation { input, files, .. } in situations() {
        let folder = Folder::new();
        for (file, text) in &files {
            folder.write(file, text);
        }
        let draw = |name: &str, more: &str| {
            let size = "--size 32x24 --method gouraud";
            let told = folder.run(&format!("render {input} -o {name} {size} {more}"));
            told.done().err
        };
        let told = draw("as-it-is.png", "");
        for line in told.lines() {
            for flag in suggested(line) {
                let told = draw("as-suggested.png", &flag);
                let is_same = folder.read("as-it-is.png") == folder.read("as-suggested.png");
                assert!(!is_same || !told.contains(line), "{line}: {flag}\n{told}");
                tried += 1;
            }
        }
    }
    assert!(tried > 10, "{tried}");
}
