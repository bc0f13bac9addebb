use super::expect::{check, error};
use super::{cubes, with_object};
use crate::scene::file::SceneFile;
use std::format;

#[test]
fn invalid_toml_and_unknown_keys() {
    check(
        "[«camra»]\nfit = 1\n",
        "unknown key `camra`",
        "expected one of `title`, `description`, `ambient`, `interpolation`, `viewer`, `specular`, `shininess_for`, \
         `specular_gate`, `colours`, `cull`, `visibility`, `depth_bits`, `depth`, `painter_key`, `clipping`, `two_sided`, `image`, \
         `camera`, `material`, `light`, `object`",
        Some("did you mean `camera`?"),
    );
    check(
        "[material]\nka = 0.1\n«shinines» = 3\n",
        "unknown key `shinines`",
        "expected one of `ka`, `kd`, `ks`, `shininess`",
        Some("did you mean `shininess`?"),
    );
    check(
        "[[light]]\ndirection = [0, 0, 1]\n«color» = 1\n",
        "unknown key `color`",
        "expected one of `direction`, `position`, `colour`, `intensity`, `attenuation`, `falloff`",
        Some("did you mean `colour`?"),
    );
    check(
        "[[object]]\nmesh = \"a.obj\"\nrotate = { axis = [0, 0, 1], «degrees» = 3 }\n",
        "unknown key `degrees`",
        "expected `axis` or `angle`",
        None,
    );
    check(
        "cull = «\"bakc\"»\n",
        "unknown word `bakc`",
        "expected one of `back`, `front`, `none`",
        Some("did you mean `back`?"),
    );
    check(
        "visibility = «\"zbuffer\"»\n",
        "unknown word `zbuffer`",
        "expected one of `z-buffer`, `painter`, `draw-order`",
        Some("did you mean `z-buffer`?"),
    );
    check(
        "depth = «\"w\"»\n",
        "unknown word `w`",
        "expected `interpolated` or `per-sample`",
        None,
    );
    check(
        "clipping = «\"cube\"»\n",
        "unknown word `cube`",
        "expected `planes` or `ndc-cube`",
        Some("did you mean `ndc-cube`?"),
    );
    check(
        "painter_key = «\"nearest\"»\n",
        "unknown word `nearest`",
        "expected `mean` or `farthest`",
        None,
    );
    check(
        "interpolation = «\"space\"»\n",
        "unknown word `space`",
        "expected `screen` or `perspective`",
        None,
    );
    check(
        "[image]\nencoding = «\"srbg\"»\n",
        "unknown word `srbg`",
        "expected `linear` or `srgb`",
        Some("did you mean `srgb`?"),
    );
    check(
        "[[object]]\nmesh = \"a.obj\"\nnormals = «\"average\"»\n",
        "unknown word `average`",
        "expected one of `averaged`, `auto`, `given`",
        Some("did you mean `averaged`?"),
    );
}

#[test]
fn values_of_the_wrong_type() {
    check(
        "two_sided = «\"yes\"»\n",
        "expected true or false",
        "found string \"yes\"",
        None,
    );
    check(
        "depth_bits = «\"many\"»\n",
        "expected a whole number",
        "found string \"many\"",
        None,
    );
    check(
        "[image]\nwidth = «640.5»\n",
        "expected a whole number",
        "found floating point `640.5`",
        None,
    );
    check(
        "[camera]\nfovy = «\"wide\"»\n",
        "expected a number",
        "found string \"wide\"",
        None,
    );
    check(
        "[camera]\neye = «[1, 2]»\n",
        "expected three numbers [x, y, z]",
        "found a list of 2",
        None,
    );
    check(
        "[camera]\neye = [1, 2, «true»]\n",
        "expected a number",
        "found boolean `true`",
        None,
    );
    check(
        "ambient = «[1]»\n",
        "expected one number or three in brackets",
        "found a list of one",
        None,
    );
    check(
        "[material]\nkd = «\"red\"»\n",
        "expected one number or three in brackets",
        "found string \"red\"",
        None,
    );
    check(
        "[[object]]\nmesh = «3»\n",
        "expected text in quotes",
        "found integer `3`",
        None,
    );
    check(
        "[[object]]\nmesh = \"a.obj\"\nmatrix = «[[1, 0, 0, 0], [0, 1, 0, 0]]»\n",
        "expected three rows of four numbers",
        "found a list of 2",
        None,
    );
    check(
        "[[object]]\nmesh = \"a.obj\"\nrotate = «90»\n",
        "expected { axis = [x, y, z], angle = degrees } or a list of those",
        "found integer `90`",
        None,
    );
    check(
        "«[[object]]»\nscale = 2\n",
        "the key `mesh` is missing",
        "in this table",
        None,
    );
}

/// Text that is not TOML gives an error with a place, and never a panic.
#[test]
fn broken_text() {
    for (text, line, column) in [
        ("[camera\n", 1, 8),
        ("[camera]\nfit = \n", 2, 7),
        ("fit", 1, 4),
        ("[camera]\nfit = 1\nfit = 2\n", 3, 1),
        ("title = \"ä\" x\n", 1, 13),
        ("title = \"no end\n", 1, 16),
        ("\u{feff}[camera\n", 1, 8),
        ("a = \u{1f600}\n", 1, 5),
    ] {
        let error = error(text);
        assert_eq!(
            error.line_and_column(),
            Some((line, column)),
            "{text:?}\n{error}"
        );
        assert!(
            error.render(false).starts_with("error: not valid TOML: "),
            "{error}"
        );
    }
    // Try every beginning of a scene, at every byte.
    let whole =
        with_object("title = 'ä'\n[camera]\neye = [0, 0, 5]\n[[light]]\ndirection = [1, 1, 1]");
    for end in (0..whole.len()).filter(|end| whole.is_char_boundary(*end)) {
        if let Err(error) =
            SceneFile::parse(&whole[..end], "scene.toml").and_then(|file| file.resolve(cubes))
        {
            assert!(error.render(false).starts_with("error: "), "{error}");
        }
    }
}

#[test]
fn files_that_cannot_be_read() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("latin1.toml");
    let missing = format!(
        "{}",
        SceneFile::load(folder.path().join("none.toml")).expect_err("no file")
    );
    std::fs::write(&path, b"a = 1\ntitle = \"\xe4\"\n").expect("a temporary file");
    let latin1 = format!("{}", SceneFile::load(&path).expect_err("not UTF-8"));
    assert!(
        missing.starts_with("cannot read the scene `") && missing.contains("none.toml`: "),
        "{missing}"
    );
    assert!(
        latin1.ends_with("latin1.toml`: line 2 is not text: expected UTF-8"),
        "{latin1}"
    );
}
