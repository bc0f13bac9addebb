//! Tests of all formats but OBJ, whose tests stand beside its reader.

mod files;
#[cfg(feature = "gltf")]
mod gltf;
mod mutants;
mod off;
mod ply;
mod stl;

use super::{LoadedMesh, ReadError, parse_mesh};
use crate::note::Notes;
use std::io::ErrorKind;
use std::string::{String, ToString};
use std::vec::Vec;

/// Reads a file whose name does not tell its format, with no files beside it.
fn parse(bytes: impl AsRef<[u8]>) -> Result<LoadedMesh, ReadError> {
    parse_mesh("t", bytes.as_ref(), |_| Err(ErrorKind::NotFound.into()))
}

/// Returns the notes as sentences.
pub(super) fn sentences(notes: &Notes) -> Vec<String> {
    notes.iter().map(ToString::to_string).collect()
}

/// Returns the polygons of a valid file.
#[track_caller]
fn polygons(bytes: impl AsRef<[u8]>) -> Vec<Vec<u32>> {
    let loaded = parse(bytes).expect("a mesh");
    loaded.mesh.polygons().map(<[u32]>::to_vec).collect()
}

/// Checks the error message of a file that is refused.
#[track_caller]
fn assert_refused(bytes: impl AsRef<[u8]>, message: &str) {
    let error = parse(bytes).expect_err("no mesh");
    assert_eq!(error.to_string(), message);
}
