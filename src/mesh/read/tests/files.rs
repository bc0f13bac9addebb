//! Behaviour that all formats share: recognition by bytes, gzip, names.

use super::*;
use crate::mesh::read::{load_mesh, mesh_endings};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::fs;
use std::io::Write;
use std::string::ToString;

const OFF: &[u8] = b"OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

#[test]
fn bytes_decide_before_endings_with_a_warning() {
    let none = |_: &str| Err(ErrorKind::NotFound.into());
    for name in ["a", "a.off", "a.xyz"] {
        let loaded = parse_mesh(name, OFF, none).expect("a mesh");
        assert!(loaded.notes.is_empty(), "{}", loaded.notes);
    }
    let loaded = parse_mesh("a.STL", OFF, none).expect("a mesh");
    let said = "is an OFF file, whatever its ending says, and read as one";
    assert_eq!(sentences(&loaded.notes), [said]);
    // Without a keyword the ending decides.
    let error = parse_mesh("a.off", &OFF[4..], none).expect_err("no keyword");
    assert!(error.to_string().starts_with("a.off:1: `3`: expected OFF"));
}

#[test]
fn packed_files_of_every_format_are_read() {
    let ply = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\n\
        element face 1\nproperty list int int vertex_index\nend_header\n0 0 0 1 0 0 0 1 0 3 0 1 2";
    let stl = b"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for bytes in [OFF, ply, stl, obj] {
        let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
        packed.write_all(bytes).expect("memory");
        let packed = packed.finish().expect("memory");
        assert_eq!(polygons(&packed), [[0, 1, 2]]);
    }
}

#[test]
fn other_formats_are_named_with_a_converter() {
    let expected = "expected a mesh file (OBJ, STL, PLY, OFF or glTF)";
    for (bytes, what) in [
        (&b"; FBX 7.3.0 project file\n"[..], "a text FBX file"),
        (b"<COLLADA xmlns=\"\">", "a COLLADA file"),
        (b"PK\x03\x04 3D/3dmodel.model", "a 3MF file"),
        (b"# vtk DataFile Version 3.0\n", "a VTK file"),
        (b"ISO-10303-21;\n", "a STEP file"),
    ] {
        let text = parse(bytes).expect_err("no mesh").to_string();
        let start = std::format!("t: is {what}: {expected}; ");
        assert!(text.starts_with(&start) && text.ends_with(" it"), "{text}");
    }
    assert_refused(b"\x89PNG", &std::format!("t: is a PNG picture: {expected}"));
}

#[test]
fn endings_are_those_of_the_formats() {
    let endings: Vec<&str> = mesh_endings().collect();
    for ending in ["obj", "stl", "ply", "off"] {
        assert!(endings.contains(&ending), "{ending}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.off");
    fs::write(&path, OFF).expect("a file");
    assert_eq!(load_mesh(&path).expect("a mesh").mesh.polygon_count(), 1);
}
