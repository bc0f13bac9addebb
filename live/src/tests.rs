//! Tests of the module on the host, by the functions that the page calls.

use crate::studio::{Studio, View};
use serde_json::Value;
use std::path::Path;

/// The view in which a scene opens.
fn still(size: [u32; 2]) -> View {
    View {
        size,
        azimuth: 0.0,
        elevation: 0.0,
        zoom: 1.0,
        light: [0.0; 3],
        shininess: 0.0,
        samples: 0,
    }
}

/// Makes a studio that has these files, and loads an input.
fn load(input: &str, files: &[(&str, &str)]) -> Studio {
    let mut studio = Studio::default();
    for (name, content) in files {
        studio.text = format!("{name}\n{content}").into();
        studio.file();
    }
    studio.text = input.into();
    studio.load([0; 2]).expect("a scene");
    studio
}

/// Returns the lines of the notes about a studio's scene and about its frame in the first view.
fn notes(studio: &mut Studio) -> Vec<String> {
    let size = studio.loaded.as_ref().expect("a scene").size;
    studio.look(&still(size)).expect("a frame");
    studio.notes();
    studio.told().lines().map(str::to_owned).collect()
}

/// Each situation of `tests/doors.json` is told in the page, in one line, and without flags.
#[test]
fn every_situation_is_told() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/doors.json");
    let text = std::fs::read_to_string(&path).expect("the situations");
    let situations: Vec<Value> = serde_json::from_str(&text).expect("a list");
    assert!(!situations.is_empty());
    for situation in &situations {
        let word = |value: &Value| value.as_str().expect("a text").to_owned();
        let (name, input) = (word(&situation["name"]), word(&situation["input"]));
        // The module is built without glTF.
        if input.ends_with(".gltf") {
            continue;
        }
        let files = situation["files"].as_object().into_iter().flatten();
        let files: Vec<(&str, String)> = files.map(|(name, of)| (&**name, word(of))).collect();
        let files: Vec<(&str, &str)> = files.iter().map(|(name, of)| (*name, &**of)).collect();
        // The page has the text of a scene, and the name of a mesh.
        let text = files.iter().find(|(name, _)| *name == input);
        let text = text.filter(|_| input.ends_with(".toml"));
        let text = text.map_or(&*input, |(_, text)| text);
        let lines = notes(&mut load(text, &files));
        let expected = situation["notes"].as_array().expect("a list");
        let is_quiet = expected.is_empty();
        assert!(!is_quiet || lines.is_empty(), "{name}: {lines:?}");
        for note in expected {
            let says = word(&note["says"]);
            let told = lines.iter().filter(|line| line.contains(&says)).count();
            assert_eq!(told, 1, "{name}: {says}\n{}", lines.join("\n"));
        }
        let flags = lines.iter().filter(|line| line.contains("--"));
        assert_eq!(flags.count(), 0, "{name}: {}", lines.join("\n"));
    }
}

/// A mesh of two triangles that meet at over 40 degrees, and of one without area.
const BENT: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nv 2 0 0\nf 1 2 3\nf 1 3 4\nf 1 2 5\n";

#[test]
fn warnings_come_first_and_settings_are_keys() {
    let lines = notes(&mut load("own.obj", &[("own.obj", BENT)]));
    let first = |part: &str| lines.iter().position(|line| line.contains(part));
    let (warning, note) = (first("no area"), first("`object.crease = 40`"));
    assert!(warning < note && warning.is_some(), "{}", lines.join("\n"));
}

#[test]
fn notes_are_about_the_view_that_is_shown() {
    let scene = "cull = 'back'\n[[object]]\nmesh = 'own.obj'\n";
    let mut studio = load(scene, &[("own.obj", BENT)]);
    let nothing = |studio: &mut Studio, azimuth| {
        let view = View {
            azimuth,
            ..still([64, 48])
        };
        studio.look(&view).expect("a frame");
        studio.notes();
        studio.told().contains("nothing is drawn")
    };
    let seen = [0.0, std::f64::consts::PI].map(|azimuth| nothing(&mut studio, azimuth));
    assert_ne!(seen[0], seen[1]);
}

/// A mesh is shown as `render` shows it in the same size: lights, samples and encoding of the rig,
/// and a camera that fits the size. The scene file of a view states all of this.
#[test]
fn a_mesh_has_the_rig_for_its_size() {
    let mut studio = load("own.obj", &[("own.obj", BENT)]);
    studio.text = "own.obj".into();
    studio.load([300, 100]).expect("a scene");
    studio.look(&still([300, 100])).expect("a frame");
    studio.scene().expect("a scene file");
    let text = studio.told();
    for part in [
        "width = 300",
        "samples = 2",
        "encoding = \"srgb\"",
        "alpha = \"opaque\"",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert_eq!(text.matches("[[light]]").count(), 2, "{text}");
}

#[test]
fn the_reference_draws_by_every_model() {
    let mut studio = load("builtin:sphere", &[]);
    studio.look(&still([32, 24])).expect("a frame");
    let mut draw = |name: &str, is_exact| {
        studio.text = name.into();
        studio.draw(is_exact).map(|_| ())
    };
    draw("reference", true).expect("a picture");
    draw("reference:model=gouraud", false).expect("a picture");
    let unknown = draw("nosuch", false).expect_err("unknown");
    assert!(unknown.contains("nosuch"), "{unknown}");
    studio.compare();
    assert!(studio.errors.iter().any(|error| *error > 1.0));
}
