//! `mtllib`, `usemtl` and MTL files.

use super::*;
use crate::mesh::Material;
use crate::mesh::read::read_beside;
use std::cell::RefCell;
use std::path::Path;
use std::string::ToString;
use std::vec;

/// Loads five points and `obj` with the given libraries.
fn load(obj: &str, libraries: &[(&str, &str)]) -> LoadedMesh {
    parse_mesh("t.obj", format!("{POINTS}{obj}").as_bytes(), |name| {
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
        sentences(&loaded.notes),
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
    for (illum, specular) in [("0", 0.0), ("1", 0.0), ("2", 0.5)] {
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
fn lines_that_cannot_be_read_are_reported_and_ignored() {
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
        ("Kd", "`Kd` is ignored: expected one or three"),
        (
            "Kd 1 nan 1",
            "`Kd 1 nan 1` is ignored: expected one or three",
        ),
        ("Kd -0.1", "`Kd -0.1` is ignored: expected one or three"),
        (
            "Ns nan",
            "`Ns nan` is ignored: expected one finite number, 0 or more",
        ),
        ("Ns", "`Ns` is ignored: expected one finite"),
        ("Ns -3", "`Ns -3` is ignored: expected one finite"),
        (
            "illum 2.0",
            "`illum 2.0` is ignored: expected an illumination model, a whole number from 0 to 10",
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
    assert_eq!(warnings.len(), 1);
    assert!(
        warnings[0].starts_with("a.mtl:1: `Kd 1 0 0` before any `newmtl`"),
        "{warnings:?}"
    );
    // A file with other content must not fill the screen.
    let (_, warnings) = material(&("newmtl m\n".to_string() + &"Kd\n".repeat(1000)));
    assert_eq!(warnings.len(), 8 + 1, "{warnings:?}");
    assert_eq!(warnings[8], "a.mtl: 992 more lines are ignored");
}

#[test]
fn keywords_have_any_case() {
    let text = "NEWMTL m\nKA 0.1 0.2 0.3\nkd 0.4 0.5 0.6\nkS 0.7 0.8 0.9\nNS 96.5\nIllum 2\nD 1\n";
    let (found, warnings) = material(text);
    let found = found.unwrap();
    assert_eq!((found.diffuse, found.shininess), ([0.4, 0.5, 0.6], 96.5));
    assert_eq!((found.specular, warnings), ([0.7, 0.8, 0.9], vec![]));
}

#[test]
fn lines_end_by_cr_and_names_go_on_to_their_end() {
    for text in [
        "newmtl m\rKd 1 0 0 # a\rmap_Kd\r\nNs 5\r",
        "newmtl x\\\nnewmtl m\nKd 1 \\\n0 0\nNs 5",
        "newmtl x\nmap_Kd C:\\wood\\\nnewmtl m\nKd 1 0 0\nNs \\\r5",
    ] {
        let (found, warnings) = material(text);
        let found = found.unwrap();
        assert_eq!(
            (found.diffuse, found.shininess),
            ([1.0, 0.0, 0.0], 5.0),
            "{text:?}"
        );
        assert_eq!(warnings, Vec::<String>::new(), "{text:?}");
    }
}

#[test]
fn features_that_are_not_drawn_are_reported_once_per_kind() {
    for (lines, told) in [
        (
            "map_Bump -bm 1.0 a.png\nnorm b.png\nrefl c\nmap_Kd\nKd 1",
            "3: `map_Bump -bm 1.0 a.png`: textures are not drawn (3 times)",
        ),
        (
            "d 0.5\nTr 0.5",
            "3: `d 0.5`: transparency is not drawn, all surfaces are opaque",
        ),
        (
            "d -halo 0.25",
            "3: `d -halo 0.25`: transparency is not drawn, all surfaces are opaque",
        ),
        (
            "Tr 1",
            "3: `Tr 1`: transparency is not drawn, all surfaces are opaque",
        ),
        (
            "d 1\nTr 0.5",
            "4: `Tr 0.5`: transparency is not drawn, all surfaces are opaque",
        ),
        (
            "Tf 1 0.5 1",
            "3: `Tf 1 0.5 1`: transparency is not drawn, all surfaces are opaque",
        ),
        ("Ke 0 0.1 0", "3: `Ke 0 0.1 0`: emission is not drawn"),
        (
            "KE spectral a.rfl",
            "3: `KE spectral a.rfl`: emission is not drawn",
        ),
        (
            "Pr 0.5\nPm 0\naniso 0",
            "3: `Pr 0.5`: physically based keys are not read (3 times)",
        ),
        (
            "illum 3",
            "3: `illum 3`: reflection, refraction and cast shadows are not drawn",
        ),
        (
            "Ka 2\nKd 255 0 0",
            "3: `Ka 2`: a colour is not within 0 to 1: what is shown is clamped at each pixel (2 times)",
        ),
        (
            "colour red\nshine",
            "3: `colour red`: not an MTL statement, ignored (2 times)",
        ),
        (
            "newmtl m\nKd 0\nnewmtl m",
            "3: `newmtl m`: a name that is defined already: the first definition is used (2 times)",
        ),
    ] {
        let (found, warnings) = material(&format!("newmtl m\nNs 5\n{lines}\n"));
        assert_eq!(found.unwrap().shininess, 5.0);
        assert_eq!(warnings, [format!("a.mtl:{told}")], "{lines}");
    }
    let neutral = "d 1\nTr 1\nTf 0 0 0\nKe 0 0 0\nNi 1.5\nsharpness 60\nmap_aat on\nmap_d # none\n";
    assert_eq!(
        material(&format!("newmtl m\n{neutral}")).1,
        Vec::<String>::new()
    );
    assert_eq!(material("newmtl m\nTr 0\nTf 0.5\n").1, Vec::<String>::new());
}

#[test]
fn materials_that_no_face_uses_are_not_reported() {
    let (_, warnings) = material("newmtl m\nnewmtl n\nmap_Kd a.png\nd 0\nKd x\nnewmtl n\n");
    assert_eq!(warnings, Vec::<String>::new());
}

#[test]
fn a_texture_over_black_or_no_colour_is_drawn_grey() {
    for (lines, line) in [
        ("map_Kd wood.png\nKd 0 0 0", 2),
        ("Kd 0\nmap_Kd wood.png", 3),
        ("map_Kd wood.png", 2),
    ] {
        let (found, warnings) = material(&format!("newmtl m\n{lines}\n"));
        assert_eq!(found, Some(PLAIN), "{lines}");
        let told = format!(
            "a.mtl:{line}: `map_Kd wood.png`: a texture over a black or missing `Kd`: the default grey is drawn instead"
        );
        assert_eq!((warnings.len(), &warnings[1]), (2, &told), "{lines}");
    }
    assert_eq!(material("newmtl m\nKd 0\n").0.unwrap().diffuse, [0.0; 3]);
    assert_eq!(
        material("newmtl m\nKd 0 0.5 0\nmap_Kd a\n")
            .0
            .unwrap()
            .diffuse,
        [0.0, 0.5, 0.0]
    );
}

#[test]
fn a_library_that_is_not_mtl_text_is_named() {
    let utf16: Vec<u8> = "\u{feff}newmtl m\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    let files: [(&[u8], &str); 8] = [
        (&utf16, "is UTF-16 text (not UTF-8)"),
        (&utf16[2..], "is UTF-16 text (not UTF-8)"),
        (b"\x89PNG\r\n\x1a\n\0\0", "is a PNG picture"),
        (b"<!doctype html><title>404</title>", "is a page of HTML"),
        (b"\x7fELF\0", "holds binary data"),
        (b"", "is empty"),
        (b"404: Not Found\n", "has no `newmtl` line"),
        (b"# Blender MTL File: None\nKd 1\n", "has no `newmtl` line"),
    ];
    for (bytes, told) in files {
        let text = format!("{POINTS}mtllib a.mtl\nusemtl m\nf 1 2 3\n");
        let loaded = parse_mesh("t.obj", text.as_bytes(), |_| Ok(bytes.to_vec())).unwrap();
        let expected = "expected MTL text with `newmtl` lines";
        assert_eq!(
            warning(&loaded),
            format!("material library `a.mtl` (line 6) {told}: {expected}")
        );
    }
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
fn a_material_may_lack_a_name() {
    let obj = "mtllib a.mtl\nusemtl\nf 1 2 3\n";
    let loaded = load(obj, &[("a.mtl", "newmtl red\nKd 0\nnewmtl \nKd 1 0 0\n")]);
    let diffuse = [1.0, 0.0, 0.0];
    assert_eq!(loaded.mesh.materials(), [Material { diffuse, ..PLAIN }]);
    assert!(loaded.notes.is_empty(), "{}", loaded.notes);
    let said =
        "no material library defines a material without a name: the default material is used";
    assert_eq!(warning(&load("usemtl\nf 1 2 3\n", &[])), said);
    let loaded = load(obj, &[("a.mtl", "newmtl red\nKd 0\n")]);
    assert_eq!(warning(&loaded), said);
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
        assert_eq!(loaded.notes, Notes::default());
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
        assert_eq!(greys, [1.0, 0.25], "{lines}");
        let told =
            "b c.MTL:1: `newmtl m`: a name that is defined already: the first definition is used";
        assert_eq!(warning(&loaded), told, "{lines}");
    }
}

#[test]
fn missing_libraries_are_reported_once() {
    let asked = RefCell::new(Vec::new());
    let text = format!("{POINTS}mtllib no.mtl\nmtllib no.mtl\nusemtl m\nf 1 2 3\n");
    let loaded = parse_mesh("t.obj", text.as_bytes(), |name| {
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
        "no material library defines `a`, `b`, a material without a name: the default material is used"
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
    let loaded = parse_mesh("t.obj", &text, |name| {
        assert_eq!(name, "grün.mtl");
        Ok(b"newmtl gr\xfcn\nKd 0 1 0\n".to_vec())
    })
    .unwrap();
    assert_eq!(loaded.mesh.materials()[0].diffuse, [0.0, 1.0, 0.0]);
}

#[test]
fn paths_of_libraries() {
    let read = |folder: &Path, name: &str| {
        read_beside(
            folder,
            name,
            &mut |path| std::fs::read(path),
            &mut Notes::default(),
        )
    };
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

#[test]
fn a_nul_in_a_library_refuses_nothing() {
    let obj = format!("{POINTS}mtllib a.mtl\nusemtl red\nf 1 2 3\n");
    for mtl in [
        "newmtl red\nKd 1 0 0\n\0",
        "# made by\0 C\nnewmtl red\0\nKd 1 0 0\0\n",
        "\u{feff}newmtl red\n\u{feff}Kd 1 0 0\n",
        "newmtl red\nKd 1 \\\n\n0 0\n",
    ] {
        let loaded = parse_mesh("t.obj", obj.as_bytes(), |_| Ok(mtl.into())).unwrap();
        assert_eq!(loaded.notes, Notes::default(), "{mtl:?}");
        assert_eq!(
            loaded.mesh.materials()[0].diffuse,
            [1.0, 0.0, 0.0],
            "{mtl:?}"
        );
    }
    let loaded = parse_mesh("t.obj", obj.as_bytes(), |_| Ok(vec![1, 0, 0, 2, 0])).unwrap();
    assert!(
        loaded.notes.to_string().contains("holds binary data"),
        "{}",
        loaded.notes
    );
}

#[test]
fn one_library_by_two_names_is_read_once_and_several_paths_are_several_files() {
    let asked = RefCell::new(Vec::new());
    let ask = |lines: &str| {
        asked.borrow_mut().clear();
        let text = format!("{POINTS}{lines}\nusemtl m\nf 1 2 3\n");
        let loaded = parse_mesh("t.obj", text.as_bytes(), |name| {
            asked.borrow_mut().push(name.to_string());
            if name.ends_with("b.mtl") {
                Ok(b"Kd 9 9 9\nnewmtl n\n".to_vec())
            } else {
                Ok(b"Kd 9 9 9\nnewmtl m\nKd 1 0 0\n".to_vec())
            }
        });
        let told = loaded.unwrap().notes.iter().count();
        (asked.borrow().clone(), told)
    };
    let one = "mtllib a.mtl\nmtllib ./a.mtl\nmtllib .\\a.mtl\nmtllib c/../a.mtl\nmtllib .//a.mtl";
    assert_eq!(ask(one), (vec!["a.mtl".to_string()], 1));
    let several = ["./a.mtl", "c/b.mtl"].map(String::from).to_vec();
    assert_eq!(ask("mtllib ./a.mtl c/b.mtl"), (several, 2));
    let apart = ["/a.mtl", "a.mtl", "../a.mtl"].map(String::from).to_vec();
    assert_eq!(
        ask("mtllib /a.mtl\nmtllib a.mtl\nmtllib ../a.mtl"),
        (apart, 3)
    );
}

#[test]
fn repeating_an_equal_material_makes_no_warning() {
    for (mtl, told) in [
        ("newmtl m\nKd 1 0 0\nnewmtl m\nKd 1 0 0\n", 0),
        (
            "newmtl m\nKd 1 0 0\nnewmtl m\nKd 1.0 0.0 0 # the same\nKa 0.2\n",
            0,
        ),
        ("newmtl m\nKd 1 0 0\nnewmtl m\nKd 1 0 0.5\n", 1),
        (
            "newmtl m\nKd 1 0 0\nnewmtl n\nnewmtl m\nKd 1 0 0\nnewmtl m\n",
            1,
        ),
    ] {
        let loaded = load("usemtl m\nmtllib a.mtl\nf 1 2 3\n", &[("a.mtl", mtl)]);
        assert_eq!(
            loaded.notes.iter().count(),
            told,
            "{mtl}: {:?}",
            sentences(&loaded.notes)
        );
    }
}
