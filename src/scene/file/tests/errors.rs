use super::expect::{check, error};
use super::{cubes, with_object};
use crate::note::Note;
use crate::scene::Scene;
use crate::scene::file::diagnostics::Origin;
use crate::scene::file::value::Data;
use crate::scene::file::{SceneFile, SceneTable, UnusableMesh};
use std::format;
use std::string::String;
use std::vec;

#[test]
fn numbers_out_of_range() {
    let size = "expected 1 to 16384";
    check("[image]\nwidth = «0»\n", "`image.width` is 0", size, None);
    check(
        "[image]\nheight = «16385»\n",
        "`image.height` is 16385",
        size,
        None,
    );
    check(
        "[image]\nheight = «-3»\n",
        "`image.height` is -3",
        size,
        None,
    );
    check(
        "[image]\nbackground = «1.5»\n",
        "`image.background` is 1.5",
        "expected 0 to 1",
        None,
    );
    check(
        "[image]\nbackground = «[0, -1, 0]»\n",
        "`image.background` has green = -1",
        "expected 0 to 1",
        None,
    );
    check(
        "[image]\nsamples = «3»\n",
        "`image.samples` is 3",
        "expected 1, 2, 4 or 8",
        None,
    );
    check(
        "[image]\nsamples = «-2»\n",
        "`image.samples` is -2",
        "expected 1, 2, 4 or 8",
        None,
    );
    check(
        "[image]\nwidth = 4097\nsamples = «4»\n",
        "`image.samples` is 4",
        "expected at most 16384 samples per side, and there are 4097 pixels",
        None,
    );
    check(
        "clipping = «\"ndc-cube\"»\ninterpolation = \"perspective\"\n",
        "`clipping` and `interpolation` exclude each other",
        "expected interpolation = \"screen\" with \"ndc-cube\": corners behind the eye have no weight",
        None,
    );
    check(
        "depth_bits = «20»\n",
        "`depth_bits` is 20",
        "expected 16, 24 or 32",
        None,
    );
    check(
        "depth_bits = «-16»\n",
        "`depth_bits` is -16",
        "expected 16, 24 or 32",
        None,
    );
    check(
        "ambient = «-1»\n",
        "`ambient` is -1",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    check(
        "ambient = «nan»\n",
        "`ambient` is NaN",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    for key in ["ka", "kd", "ks"] {
        let (message, scene) = (
            format!("`material.{key}` has blue = -0.1"),
            format!("[material]\n{key} = «[1, 1, -0.1]»\n"),
        );
        check(&scene, &message, "expected 0 or more, up to 3.4e38", None);
    }
    check(
        "[material]\nks = «inf»\n",
        "`material.ks` is inf",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    // The value is finite in 64 bits, but not in 32.
    check(
        "[material]\nks = «1e39»\n",
        "`material.ks` is 1e39",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    check(
        "[material]\nshininess = «-1»\n",
        "`material.shininess` is -1",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    check(
        "[material]\nshininess = «nan»\n",
        "`material.shininess` is NaN",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    check(
        "[[object]]\nmesh = \"a.obj\"\nmaterial = { shininess = «-2» }\n",
        "`object.material.shininess` is -2",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    check(
        "[[light]]\ndirection = «[0, 0, 0]»\n",
        "`light.direction` has no length",
        "expected a direction: not all numbers 0",
        None,
    );
    check(
        "[[light]]\ndirection = «[0, inf, 0]»\n",
        "`light.direction` is not finite",
        "expected three finite numbers",
        None,
    );
    let light = "[[light]]\ndirection = [0, 0, 1]\n";
    check(
        &format!("{light}colour = «[1, 0, -1]»\n"),
        "`light.colour` has blue = -1",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    check(
        &format!("{light}intensity = «-1»\n"),
        "`light.intensity` is -1",
        "expected 0 or more, up to 3.4e38",
        None,
    );
    check(
        &format!("{light}colour = 1e30\nintensity = «1e30»\n"),
        "`light.intensity` is 1e30",
        "expected a product with the colour of up to 3.4e38",
        None,
    );
}

#[test]
fn cameras_that_cannot_be() {
    let fovy = "expected degrees over 0 and under 180 (0.001 to 179.999)";
    check(
        "[camera]\nfovy = «180»\n",
        "`camera.fovy` is 180",
        fovy,
        None,
    );
    check("[camera]\nfovy = «0»\n", "`camera.fovy` is 0", fovy, None);
    check(
        "[camera]\nfovy = «nan»\n",
        "`camera.fovy` is NaN",
        fovy,
        None,
    );
    check(
        "[camera]\nhalf_height = «0»\n",
        "`camera.half_height` is 0",
        "expected a number over 0 (1e-100 to 1e100)",
        None,
    );
    check(
        "[camera]\nfit = «0»\n",
        "`camera.fit` is 0",
        "expected a fraction of the picture, 0.001 to 100",
        None,
    );
    let eye = "eye = [0, 0, 5]\nhalf_height = 1\n";
    check(
        "[camera]\neye = «[1, 2, 3]»\ntarget = [1, 2, 3]\n",
        "`camera.eye` is the point that the camera looks at",
        "expected two different points",
        None,
    );
    check(
        "[camera]\neye = «[0, 0, 0]»\n",
        "`camera.eye` is the point that the camera looks at",
        "expected two different points",
        Some("`target` is the origin by default: set it, too"),
    );
    check(
        "[camera]\neye = «[0, nan, 0]»\n",
        "`camera.eye` has y = NaN",
        "expected numbers between -1e15 and 1e15",
        None,
    );
    check(
        &format!("[camera]\n{eye}up = «[0, 0, 3]»\n"),
        "`camera.up` is parallel to the line of sight",
        "expected a direction across it",
        None,
    );
    check(
        &format!("[camera]\n{eye}up = «[0, 0, 0]»\n"),
        "`camera.up` has no length",
        "expected a direction: not all numbers 0",
        None,
    );
    check(
        "[camera]\nfovy = 30\nnear = «0»\n",
        "`camera.near` is 0",
        "expected a number over 0 (up to 1e20), as the camera is a perspective one",
        None,
    );
    check(
        &format!("[camera]\n{eye}near = 3\nfar = «3»\n"),
        "`camera.far` is 3",
        "expected more than near = 3",
        None,
    );
    // The cube extends from 4 to 6 along the line of sight, and 5 % of 2 is added.
    check(
        &with_object(&format!("[camera]\n{eye}near = «7»\n")),
        "`camera.near` leaves nothing between near = 7 and far = 6.1",
        "expected near below far",
        None,
    );
    check(
        &with_object(&format!("[camera]\n{eye}far = «3.5»\n")),
        "`camera.far` leaves nothing between near = 3.9 and far = 3.5",
        "expected near below far",
        None,
    );
    check(
        "[camera]\nelevation = «91»\n",
        "`camera.elevation` is 91",
        "expected degrees between -90 and 90",
        None,
    );
    check(
        "[camera]\nazimuth = «inf»\n",
        "`camera.azimuth` is inf",
        "expected degrees between -36000 and 36000",
        None,
    );
    check(
        "[camera]\ntarget = «[0, 0, 0]»\n",
        "`camera.target` needs `eye`",
        "a fitted camera looks at the middle of the objects",
        None,
    );
}

#[test]
fn keys_that_exclude_each_other() {
    check(
        "[camera]\nhalf_height = 1\nfovy = «30»\n",
        "`camera.fovy` and `camera.half_height` exclude each other",
        "expected one of them: `half_height` is orthographic, `fovy` is perspective",
        None,
    );
    check(
        "[camera]\nhalf_height = 1\nfit = «1»\n",
        "`camera.fit` and `camera.half_height` exclude each other",
        "expected one of them: `fit` finds the half height",
        None,
    );
    check(
        "[camera]\neye = [0, 0, 5]\nazimuth = «1»\n",
        "`camera.azimuth` and `camera.eye` exclude each other",
        "expected a place (`eye`, `target`) or a direction, not both",
        None,
    );
    check(
        "[camera]\ndirection = [0, 0, 5]\nelevation = «1»\n",
        "`camera.elevation` and `camera.direction` exclude each other",
        "expected `direction`, or `azimuth` and `elevation`",
        None,
    );
    check(
        "[[object]]\nmesh = \"a.obj\"\nnormals = \"given\"\ncrease = «30»\n",
        "`object.crease` and `object.normals` exclude each other",
        "expected one of them: `crease` averages up to an angle",
        None,
    );
    let matrix =
        "[[object]]\nmesh = \"a.obj\"\nmatrix = «[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]»\n";
    for (key, value) in [
        ("scale", "2"),
        ("rotate", "{ axis = [1, 0, 0], angle = 2 }"),
        ("translate", "[0, 0, 1]"),
    ] {
        let message = format!("`object.matrix` and `object.{key}` exclude each other");
        check(
            &format!("{matrix}{key} = {value}\n"),
            &message,
            "expected `matrix`, or `scale`, `rotate` and `translate`",
            None,
        );
    }
}

#[test]
fn transforms_that_flatten() {
    let object = "[[object]]\nmesh = \"a.obj\"\n";
    let factors = "expected factors that are not 0, their sizes between 1e-15 and 1e15";
    check(
        &format!("{object}scale = «0»\n"),
        "`object.scale` has the factor 0",
        factors,
        None,
    );
    check(
        &format!("{object}scale = «[1, nan, 1]»\n"),
        "`object.scale` has the factor NaN",
        factors,
        None,
    );
    check(
        &format!("{object}matrix = «[[1, 2, 3, 0], [4, 5, 6, 0], [7, 8, 9, 0]]»\n"),
        "`object.matrix` flattens the object",
        "expected a matrix that can be inverted: columns not in one plane",
        None,
    );
    check(
        &format!("{object}matrix = «[[1, 0, 0, 0], [0, 1, 0, inf], [0, 0, 1, 0]]»\n"),
        "`object.matrix` has the entry inf",
        "expected numbers between -1e15 and 1e15",
        None,
    );
    check(
        &format!("{object}rotate = {{ axis = «[0, 0, 0]», angle = 3 }}\n"),
        "`object.rotate.axis` has no length",
        "expected a direction: not all numbers 0",
        None,
    );
    check(
        &format!("{object}rotate = [{{ axis = [0, 0, 1], angle = «nan» }}]\n"),
        "`object.rotate.angle` is NaN",
        "expected degrees between -36000 and 36000",
        None,
    );
    check(
        &format!("{object}translate = «[0, 1e16, 0]»\n"),
        "`object.translate` has y = 1e16",
        "expected numbers between -1e15 and 1e15",
        None,
    );
    check(
        "[[object]]\nmesh = «\"a.obj\"»\nscale = 1e15\ntranslate = [1e15, 0, 0]\n",
        "`object.mesh` `a.obj` reaches too far",
        "expected coordinates between -1e15 and 1e15 after the transform",
        None,
    );
    check(
        &format!("{object}crease = «181»\n"),
        "`object.crease` is 181",
        "expected degrees between 0 and 180",
        None,
    );
}

#[test]
fn scenes_as_a_whole() {
    let error = error("title = \"nothing\"\n");
    assert_eq!(error.line_and_column(), None);
    assert_eq!(
        error.render(false),
        "error: the scene has no objects: expected at least one [[object]]\n--> scene.toml\n = help: for example: [[object]] with mesh = \"builtin:sphere\""
    );
    let light = |i: usize| {
        if i == Scene::MAX_LIGHTS {
            "«[[light]]»\ndirection = [0, 0, 1]\n"
        } else {
            "[[light]]\ndirection = [0, 0, 1]\n"
        }
    };
    let lights: String = (0..=Scene::MAX_LIGHTS).map(light).collect();
    check(
        &lights,
        "light number 65 is one too many",
        "expected 64 lights at most",
        None,
    );
}

/// The error points at a mesh that cannot be loaded. Earlier warnings follow below.
#[test]
fn meshes_that_cannot_be_loaded() {
    let file = SceneFile::parse("[[object]]\nmesh = \"vase.obj\"\n", "scene.toml").expect("valid");
    let head = r#"error: `object.mesh` `vase.obj` cannot be used
 --> scene.toml:2:8
  |
2 | mesh = "vase.obj"
  |        ^^^^^^^^^^ "#;
    for (reason, warnings, rest) in [
        ("no such file", &[][..], "no such file"),
        (
            "line 3: no number",
            &["`x` is odd", "`y` is odd"],
            "line 3: no number\n  |\n  = note: `x` is odd\n          `y` is odd",
        ),
    ] {
        let error = file
            .resolve(|_, _| {
                Err(UnusableMesh {
                    notes: warnings
                        .iter()
                        .map(|text| Note::warning("odd", *text))
                        .collect(),
                    ..UnusableMesh::new(reason)
                })
            })
            .expect_err("no mesh");
        assert_eq!(error.render(false), format!("{head}{rest}"));
    }
}

/// The full text of an error has two places, a hint, and colour only on request.
#[test]
fn the_text_of_an_error() {
    let conflict = error("[camera]\nhalf_height = 1\nfovy = 30\n");
    assert_eq!(
        conflict.render(false),
        "\
error: `camera.fovy` and `camera.half_height` exclude each other
 --> scene.toml:3:8
  |
2 | half_height = 1
  |               - the other one is here
3 | fovy = 30
  |        ^^ expected one of them: `half_height` is orthographic, `fovy` is perspective"
    );
    let misspelt = error("cull = \"bakc\"\r\n");
    assert_eq!(
        misspelt.render(false),
        "\
error: unknown word `bakc`
 --> scene.toml:1:8
  |
1 | cull = \"bakc\"
  |        ^^^^^^ expected one of `back`, `front`, `none`
  |
  = help: did you mean `back`?"
    );
    assert!(!misspelt.render(false).contains('\u{1b}'));
    assert!(misspelt.render(true).contains('\u{1b}'));
}

/// Values from flags pass the same checks as those from files. The error names the flag and shows
/// no file.
#[test]
fn values_from_flags() {
    let file =
        SceneFile::parse(&with_object("[camera]\nhalf_height = 2\n"), "scene.toml").expect("valid");
    let flag = |name: &str| Origin::Flag(name.into());
    let mut over = SceneTable::default();
    let camera = over.table_mut("camera");
    camera.set("half_height", Data::Number(-1.0), flag("--half-height"));
    let mut flagged = file.clone();
    flagged.overlay(over);
    let error = flagged.resolve(cubes).expect_err("negative");
    assert_eq!(
        error.render(false),
        "error: `--half-height` is -1: expected a number over 0 (1e-100 to 1e100)"
    );
    assert_eq!(error.line_and_column(), None);
    let mut light = SceneTable::default();
    light.set("direction", Data::Triple([0.0; 3]), flag("--light"));
    let mut over = SceneTable::default();
    over.set("light", Data::Tables(vec![light]), Origin::Program);
    let mut flagged = file.clone();
    flagged.overlay(over);
    let error = flagged.resolve(cubes).expect_err("no length");
    assert_eq!(
        error.render(false),
        "error: `--light` has no length: expected a direction: not all numbers 0"
    );
    // Set the value directly, because `overlay` would replace `half_height` by `fit`.
    let mut flagged = file;
    let camera = flagged.table.table_mut("camera");
    camera.set("fit", Data::Number(0.5), flag("--fit"));
    let error = flagged.resolve(cubes).expect_err("both");
    assert!(
        error
            .render(false)
            .starts_with("error: `--fit` and `camera.half_height` exclude each other"),
        "{error}"
    );
}
