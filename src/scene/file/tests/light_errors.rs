//! Errors about lights, the viewer and highlights.

use super::expect::check;
use super::{cubes, with_object};
use crate::scene::file::SceneFile;
use crate::scene::file::diagnostics::Origin;
use crate::scene::file::schema::SCENE;
use crate::scene::file::value::{Data, SceneTable};
use std::format;
use std::vec;
use std::vec::Vec;

const AT: &str = "[[light]]\nposition = [0, 3, 3]\n";
const TOWARD: &str = "[[light]]\ndirection = [0, 3, 3]\n";

#[test]
fn positions_and_attenuations_out_of_range() {
    let coordinates = "expected numbers between -1e15 and 1e15";
    check(
        "[[light]]\nposition = «[0, nan, 0]»\n",
        "`light.position` has y = NaN",
        coordinates,
        None,
    );
    check(
        "[[light]]\nposition = «[0, 0, inf]»\n",
        "`light.position` has z = inf",
        coordinates,
        None,
    );
    check(
        "[[light]]\nposition = «[2e15, 0, 0]»\n",
        "`light.position` has x = 2000000000000000",
        coordinates,
        None,
    );
    let at_least_0 = "expected 0 or more, up to 3.4e38";
    check(
        &format!("{AT}attenuation = «-0.5»\n"),
        "`light.attenuation` is -0.5",
        at_least_0,
        None,
    );
    check(
        &format!("{AT}attenuation = «nan»\n"),
        "`light.attenuation` is NaN",
        at_least_0,
        None,
    );
    check(
        &format!("{AT}attenuation = «inf»\n"),
        "`light.attenuation` is inf",
        at_least_0,
        None,
    );
    let three = "expected three numbers [x, y, z]";
    check(
        "[[light]]\nposition = «[0, 3]»\n",
        three,
        "found a list of 2",
        None,
    );
    check(
        "[[light]]\nposition = «\"up\"»\n",
        three,
        "found string \"up\"",
        None,
    );
}

/// A light is either directional or positional. Only a positional one has a distance.
#[test]
fn a_light_is_in_one_place() {
    let message = "`light.position` and `light.direction` exclude each other";
    let expected = "expected one of them: a light is at infinity or at a place";
    check(
        &format!("{TOWARD}position = «[1, 2, 3]»\n"),
        message,
        expected,
        None,
    );
    check(
        "[[light]]\nposition = «[1, 2, 3]»\ndirection = [0, 0, 1]\n",
        message,
        expected,
        None,
    );
    let expected = "expected it beside `position`: a light at infinity has no distance";
    let key = |key: &str| format!("`light.{key}` is set for a light with a `direction`");
    check(
        &format!("{TOWARD}attenuation = «0.5»\n"),
        &key("attenuation"),
        expected,
        None,
    );
    check(
        &format!("{TOWARD}falloff = «\"inverse\"»\n"),
        &key("falloff"),
        expected,
        None,
    );
    check(
        &format!("{AT}falloff = \"inverse\"\nattenuation = «0.5»\n"),
        "`light.attenuation` and `light.falloff` exclude each other",
        "expected one of them: `attenuation` is a falloff too",
        None,
    );
}

/// The error for a light without direction and position points at the start of its table.
#[test]
fn a_light_is_somewhere() {
    let expected = "expected one of them in every [[light]]";
    let number = |n: usize| format!("light number {n} has neither `direction` nor `position`");
    check("«[[light]]»\n", &number(1), expected, None);
    for key in [
        "colour = [1, 0.5, 0]",
        "intensity = 2",
        "attenuation = 0.5",
        "falloff = \"inverse\"",
    ] {
        check(
            &format!("{AT}{TOWARD}«[[light]]»\n{key}\n"),
            &number(3),
            expected,
            None,
        );
    }
    check(
        "light = [{ direction = [0, 0, 1] }, «{ colour = 1 }»]\n",
        &number(2),
        expected,
        None,
    );
    let mut by_program = SceneFile::default();
    let lights = Data::Tables(vec![SceneTable::default()]);
    by_program.table.set("light", lights, Origin::Program);
    let error = by_program
        .resolve(cubes)
        .expect_err("a light without a place");
    assert!(format!("{error}").starts_with(&number(1)), "{error}");
}

/// A light must not be at a vertex, or nearer than `f32` can resolve. The corners of the cube are
/// at ±1.
#[test]
fn a_light_at_a_vertex() {
    let expected =
        "expected a place off the vertices: there the direction toward the light is undefined";
    let message = "`light.position` is at a vertex, (1, -1, 1)";
    check(
        &with_object("[[light]]\nposition = «[1, -1, 1]»\n"),
        message,
        expected,
        None,
    );
    check(
        &with_object("[[light]]\nposition = «[1, -1, 1.0000001]»\n"),
        message,
        expected,
        None,
    );
    let moved = "translate = [0, 10, 0]\n";
    let text = format!(
        "{}{moved}",
        with_object("[[light]]\nposition = «[1, 9, 1]»\n")
    );
    check(
        &text,
        "`light.position` is at a vertex, (1, 9, 1)",
        expected,
        None,
    );
    // Faces, edges and the inside of the cube have no vertex there.
    for place in ["[1, 0, 0]", "[1, 1, 0]", "[0, 0, 0]", "[1, -1, 1.00001]"] {
        let file = SceneFile::parse(
            &with_object(&format!("[[light]]\nposition = {place}\n")),
            "scene.toml",
        );
        assert!(file.expect("valid").resolve(cubes).is_ok(), "{place}");
    }
}

#[test]
fn words_that_do_not_exist() {
    for (text, word, expected, hint) in [
        (
            "viewer = «\"lokal\"»\n",
            "lokal",
            "expected `infinite` or `local`",
            Some("did you mean `local`?"),
        ),
        (
            "viewer = «\"here\"»\n",
            "here",
            "expected `infinite` or `local`",
            None,
        ),
        (
            "specular = «\"blin\"»\n",
            "blin",
            "expected `phong` or `blinn`",
            Some("did you mean `blinn`?"),
        ),
        (
            "shininess_for = «\"pong\"»\n",
            "pong",
            "expected `phong` or `blinn`",
            Some("did you mean `phong`?"),
        ),
        (
            "specular_gate = «\"ungatet\"»\n",
            "ungatet",
            "expected one of `gated`, `ungated`, `weighted`",
            Some("did you mean `ungated`?"),
        ),
        (
            "[[light]]\nposition = [0, 3, 3]\nfalloff = «\"inverse-sqare\"»\n",
            "inverse-sqare",
            "expected one of `none`, `inverse-square`, `inverse`",
            Some("did you mean `inverse-square`?"),
        ),
    ] {
        check(text, &format!("unknown word `{word}`"), expected, hint);
    }
    let keys: Vec<_> = SCENE
        .keys()
        .map(|key| format!("`{}`", key.name()))
        .collect();
    check(
        "«speclar» = \"blinn\"\n",
        "unknown key `speclar`",
        &format!("expected one of {}", keys.join(", ")),
        Some("did you mean `specular`?"),
    );
}

#[test]
fn lights_from_flags() {
    let refused = |keys: &[(&'static str, Data, &str)]| {
        let mut light = SceneTable::default();
        for (key, data, flag) in keys {
            light.set(key, data.clone(), Origin::Flag((*flag).into()));
        }
        let mut file = SceneFile::parse(&with_object(""), "scene.toml").expect("valid");
        let lights = Data::Tables(vec![light]);
        file.table.set("light", lights, Origin::Program);
        let error = file.resolve(cubes).expect_err("refused");
        assert_eq!(error.line_and_column(), None);
        error.render(false)
    };
    let at = |place: [f64; 3]| ("position", Data::Triple(place), "--light-at");
    assert!(
        refused(&[at([1.0, 1.0, 1.0])])
            .starts_with("error: `--light-at` is at a vertex, (1, 1, 1): expected a place off")
    );
    assert_eq!(
        refused(&[at([f64::NAN, 0.0, 0.0])]),
        "error: `--light-at` has x = NaN: expected numbers between -1e15 and 1e15"
    );
    let attenuation = ("attenuation", Data::Number(-1.0), "--attenuation");
    assert_eq!(
        refused(&[at([5.0; 3]), attenuation.clone()]),
        "error: `--attenuation` is -1: expected 0 or more, up to 3.4e38"
    );
    let toward = ("direction", Data::Triple([1.0; 3]), "--light");
    assert!(
        refused(&[toward, attenuation])
            .starts_with("error: `--attenuation` is set for a light with")
    );
}
