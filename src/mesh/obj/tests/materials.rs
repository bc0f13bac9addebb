//! `mtllib`, `usemtl` and MTL files.

use super::*;
use crate::mesh::Material;
use crate::mesh::obj::read_library;
use std::cell::RefCell;
use std::path::Path;
use std::string::ToString;
use std::vec;

/// Loads five points and `obj` with the given libraries.
fn load(obj: &str, libraries: &[(&str, &str)]) -> LoadedObj {
    parse_obj("t.obj", format!("{POINTS}{obj}").as_bytes(), |name| {
        let found = libraries.iter().find(|(file, _)| *file == name);
        found
            .map(|(_, text)| text.as_bytes().to_vec())
            .ok_or_else(|| io::ErrorKind::NotFound.into())
    })
    .unwrap()
}

/// Returns the material of one triangle with `usemtl m` and library `mtl`, and the warnings.
fn material(mtl: &str) -> (Option<Material>, Vec<String>) {
    let loaded = load("mtllib a.mtl\nusemtl m\nf 1 2 3\n", &[("a.mtl", mtl)]);
    (
        loaded
            .mesh
            .polygon_material(0)
            .map(|m| loaded.mesh.materials()[m]),
        loaded.warnings,
    )
}

const PLAIN: Material = Material {
    ambient: [0.2; 3],
    diffuse: [0.8; 3],
    specular: [0.0; 3],
    shininess: 32.0,
};

#[test]
fn properties_of_materials() {
    let text = "newmtl m\nKa 0.1 0.2 0.3\nKd 0.4 0.5 0.6\nKs 0.7 0.8 0.9\nNs 96.5\nillum 2\nd 1\nmap_Kd\nTf 1 1 1\n";
    let expected = Material {
        ambient: [0.1, 0.2, 0.3],
        diffuse: [0.4, 0.5, 0.6],
        specular: [0.7, 0.8, 0.9],
        shininess: 96.5,
    };
    assert_eq!(material(text), (Some(expected), vec![]));
    assert_eq!(
        material(&format!("\u{feff}{}", text.replace('\n', " # said\r\n"))),
        (Some(expected), vec![])
    );
}

#[test]
fn defaults_of_materials() {
    assert_eq!(material("newmtl m"), (Some(PLAIN), vec![]));
    // Illumination models 0 and 1 have no highlight.
    for (illum, specular) in [("0", 0.0), ("1", 0.0), ("2", 0.5), ("3", 0.5)] {
        let (found, warnings) = material(&format!("newmtl m\nKs 0.5 0.5 0.5\nillum {illum}\n"));
        assert_eq!(
            (found.unwrap().specular, warnings),
            ([specular; 3], vec![]),
            "illum {illum}"
        );
    }
}

#[test]
fn one_number_is_grey() {
    // This is legal, but makes the parser panic.
    assert_eq!(
        material("newmtl m\nKd 0.5 # grey\n"),
        (
            Some(Material {
                diffuse: [0.5; 3],
                ..PLAIN
            }),
            vec![]
        )
    );
}

#[test]
fn lines_that_cannot_be_read_are_told_and_ignored() {
    for (line, told) in [
        (
            "Kd spectral a.rfl 1",
            "`Kd spectral a.rfl 1` is ignored: expected red, green and blue",
        ),
        (
            "Ks xyz 1 1 1",
            "`Ks xyz 1 1 1` is ignored: expected red, green and blue",
        ),
        (
            "Ka 1 1",
            "`Ka 1 1` is ignored: expected one or three finite numbers, 0 or more",
        ),
        (
            "Kd 1 1 1 1",
            "`Kd 1 1 1 1` is ignored: expected one or three",
        ),
        ("Kd", "`Kd ` is ignored: expected one or three"),
        (
            "Kd 1 nan 1",
            "`Kd 1 nan 1` is ignored: expected one or three",
        ),
        ("Kd -0.1", "`Kd -0.1` is ignored: expected one or three"),
        (
            "Ns nan",
            "`Ns nan` is ignored: expected one finite number, 0 or more",
        ),
        ("Ns", "`Ns ` is ignored: expected one finite"),
        ("Ns -3", "`Ns -3` is ignored: expected one finite"),
        (
            "illum 2.0",
            "`illum 2.0` is ignored: expected the number of an illumination model",
        ),
    ] {
        let (found, warnings) = material(&format!("newmtl m\n\n{line}\n"));
        assert_eq!((found, warnings.len()), (Some(PLAIN), 1), "{line}");
        assert!(
            warnings[0].starts_with(&format!("a.mtl:3: {told}")),
            "{}",
            warnings[0]
        );
    }
    let (found, warnings) = material("Kd 1 0 0\nnewmtl m\nnewmtl\nKd 1 0 0\n");
    assert_eq!(found, Some(PLAIN));
    assert_eq!(warnings.len(), 3);
    assert!(
        warnings[0].starts_with("a.mtl:1: `Kd` before any `newmtl`"),
        "{warnings:?}"
    );
    assert!(
        warnings[1].starts_with("a.mtl:3: `newmtl ` is ignored: expected a name"),
        "{warnings:?}"
    );
    // A file with other content must not fill the screen.
    let (_, warnings) = material(&"Kd\n".repeat(1000));
    assert_eq!(warnings.len(), 8 + 2, "{warnings:?}");
    assert_eq!(warnings[8], "a.mtl: 992 more lines are ignored");
}

#[test]
fn each_polygon_has_its_material() {
    let obj = "f 1 2 3\nmtllib a.mtl\nusemtl red\nf 1 3 4\ng other\nf 1 2 5\nusemtl none\nf 2 3 5\nusemtl blue\nusemtl red\nf 3 4 5\n";
    let loaded = load(obj, &[("a.mtl", "newmtl blue\nnewmtl red\nKd 1 0 0\n")]);
    let of_polygons: Vec<_> = (0..5).map(|p| loaded.mesh.polygon_material(p)).collect();
    assert_eq!(of_polygons, [None, Some(0), Some(0), None, Some(0)]);
    // Only used materials are kept.
    assert_eq!(
        loaded.mesh.materials(),
        [Material {
            diffuse: [1.0, 0.0, 0.0],
            ..PLAIN
        }]
    );
    assert_eq!(loaded.mesh.positions().len(), 5);
    assert_eq!(
        warning(&loaded),
        "no material library defines `none`: the default material is used"
    );
}

#[test]
fn names_with_spaces_and_number_signs() {
    let library = [(
        "my  set #1.mtl",
        "newmtl Material #25\nKd 1\nnewmtl dark red # wine\nKd 0.5\nnewmtl Material\nKd 0\n",
    )];
    for (name, grey) in [
        ("Material #25", 1.0),
        ("dark red", 0.5),
        ("dark red # the lid", 0.5),
        ("Material # x", 0.0),
    ] {
        let loaded = load(
            &format!("mtllib my  set #1.mtl\nusemtl\t{name} \r\nf 1 2 3\n"),
            &library,
        );
        assert_eq!(
            loaded.mesh.materials().first().map(|m| m.diffuse),
            Some([grey; 3]),
            "{name}"
        );
        assert_eq!(loaded.warnings, Vec::<String>::new());
    }
}

#[test]
fn several_libraries() {
    let files = [
        ("a.mtl", "newmtl m\nKd 1\n"),
        ("b c.MTL", "newmtl m\nKd 0.5\nnewmtl n\nKd 0.25\n"),
    ];
    for lines in [
        "mtllib a.mtl b c.MTL # both",
        "mtllib a.mtl\nmtllib b c.MTL",
        "mtllib \"a.mtl\" \"b c.MTL\"",
    ] {
        // The library named first wins. A library may come after its use.
        let loaded = load(
            &format!("usemtl m\nf 1 2 3\nusemtl n\nf 1 3 4\n{lines}\nmtllib a.mtl\n"),
            &files,
        );
        let greys: Vec<_> = loaded
            .mesh
            .materials()
            .iter()
            .map(|m| m.diffuse[0])
            .collect();
        assert_eq!(
            (greys, loaded.warnings),
            (vec![1.0, 0.25], vec![]),
            "{lines}"
        );
    }
}

#[test]
fn missing_libraries_are_told_once() {
    let asked = RefCell::new(Vec::new());
    let text = format!("{POINTS}mtllib no.mtl\nmtllib no.mtl\nusemtl m\nf 1 2 3\n");
    let loaded = parse_obj("t.obj", text.as_bytes(), |name| {
        asked.borrow_mut().push(name.to_string());
        Err(io::Error::other("gone"))
    })
    .unwrap();
    assert_eq!(loaded.mesh.polygon_material(0), None);
    assert_eq!(
        warning(&loaded),
        "material library `no.mtl` (line 6) cannot be read: gone"
    );
    assert_eq!(*asked.borrow(), ["no.mtl"]);
}

#[test]
fn no_library_and_no_name() {
    let loaded = load(
        "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl\nf 1 2 3\n",
        &[],
    );
    assert!(loaded.mesh.materials().is_empty());
    assert_eq!(
        warning(&loaded),
        "no material library defines `a`, `b`: the default material is used"
    );
    let many: String = (0..9).map(|i| format!("usemtl m{i}\nf 1 2 3\n")).collect();
    assert!(warning(&load(&many, &[])).contains("`m4` and 4 more"));
}

#[test]
fn a_library_in_latin_1() {
    let text = [
        POINTS.as_bytes(),
        b"mtllib gr\xfcn.mtl\nusemtl gr\xfcn\nf 1 2 3\n",
    ]
    .concat();
    let loaded = parse_obj("t.obj", &text, |name| {
        assert_eq!(name, "grün.mtl");
        Ok(b"newmtl gr\xfcn\nKd 0 1 0\n".to_vec())
    })
    .unwrap();
    assert_eq!(loaded.mesh.materials()[0].diffuse, [0.0, 1.0, 0.0]);
}

#[test]
fn paths_of_libraries() {
    let read =
        |folder: &Path, name: &str| read_library(folder, name, &mut |path| std::fs::read(path));
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // Paths have either separator. The bare name is tried if the path leads nowhere.
    for name in [
        "scenes/vase.mtl",
        "scenes\\vase.mtl",
        "src\\..\\scenes\\vase.mtl",
    ] {
        assert!(read(root, name).is_ok(), "{name}");
    }
    assert!(read(&root.join("scenes"), "C:\\models\\vase.mtl").is_ok());
    // Reject directories, and devices that never end where they exist.
    for name in ["src", "/dev/zero", "", "..", "no.mtl"] {
        assert!(read(root, name).is_err(), "{name}");
    }
}
