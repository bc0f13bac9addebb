//! Broken files: a fixed series of random changes to good ones. Each must give a mesh or an error
//! of one line, and reading it again must give an equal result.

use super::*;
use crate::number::test_random::Random;
use std::format;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::string::ToString;

/// Words that confuse readers. They are inserted besides single bytes.
const TOKENS: [&str; 16] = [
    "\n",
    "\r",
    " ",
    "0",
    "-1",
    "9",
    "nan",
    "1e999",
    "4294967295",
    "99999999999999999999",
    "#",
    "solid ",
    "facet ",
    "OFF",
    "list ",
    "\0",
];

/// Makes one change to `bytes`.
fn change(random: &mut Random, bytes: &mut Vec<u8>) {
    let mut below = |n: usize| random.below(n.max(1) as u64) as usize;
    let at = below(bytes.len());
    match below(6) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << below(8),
        1 => bytes.truncate(at),
        2 if !bytes.is_empty() => drop(bytes.remove(at)),
        3 => drop(bytes.splice(at..at, TOKENS[below(TOKENS.len())].bytes())),
        4 if !bytes.is_empty() => bytes[at] = 255,
        _ => {
            let end = at + below((bytes.len() - at).min(40));
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
    }
}

/// Reads 3000 changed copies of `files`, under names that end in `ending`.
pub(super) fn try_mutants(ending: &str, files: &[Vec<u8>]) {
    let mut random = Random::new(45);
    let (mut meshes, mut errors) = (0, 0);
    let name = format!("t.{ending}");
    for round in 0..3000 {
        let mut bytes = files[round % files.len()].clone();
        for _ in 0..=random.below(3) {
            change(&mut random, &mut bytes);
        }
        let read = || {
            let read = || parse_mesh(&name, &bytes, |_| Err(ErrorKind::NotFound.into()));
            let read = catch_unwind(AssertUnwindSafe(read));
            read.unwrap_or_else(|_| panic!("panic at {bytes:?}"))
        };
        match (read(), read()) {
            (Ok(first), Ok(second)) => {
                meshes += 1;
                assert_eq!(first.mesh, second.mesh);
                assert_eq!(first.notes, second.notes);
            }
            (Err(first), Err(second)) => {
                errors += 1;
                assert_eq!(first, second);
                let text = first.to_string();
                assert!(!text.contains(['\n', '\r']), "{text}");
            }
            _ => panic!("read and refused: {bytes:?}"),
        }
    }
    // Both outcomes must be frequent, or the changes are too mild or too wild to find anything.
    assert!(
        meshes > 100 && errors > 100,
        "{meshes} meshes, {errors} errors"
    );
}

#[test]
fn stl() {
    let text = "solid a\nfacet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1e0 0 0\n vertex 0 1.5 0\n endloop\nendfacet\nendsolid\n";
    let triangle = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let binary = super::stl::binary(b"solid", 2, &[triangle; 2]);
    try_mutants("stl", &[text.into(), binary]);
}

#[test]
fn ply() {
    let codings = ["ascii", "binary_little_endian", "binary_big_endian"];
    let mut files = codings.map(super::ply::square).to_vec();
    files.push([b"\n", &files[1][..]].concat());
    try_mutants("ply", &files);
}

#[test]
fn off() {
    let text =
        "COFF\n3 2 0\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n0 1 0 0 0 1 1\n3 0 1 2 255 0 0\n3 2 1 0\n";
    let free = "OFF 4 2 0 0 0 0 1 0 0\n1 1 0 0 1\n0 3 0 1 2 3\n0 2 3";
    let behind = "OFF\n3 1 0\n0 0 0 0.5 1 0\n1 0 0 1 0 0\n0 1 0 0 1.0 0\n3 0 1 2 1 0 0\n";
    try_mutants("off", &[text, free, behind].map(Vec::from));
}

#[cfg(feature = "gltf")]
#[test]
fn gltf() {
    let (json, glb) = super::gltf::files();
    try_mutants("gltf", &[json.into_bytes(), glb]);
}
