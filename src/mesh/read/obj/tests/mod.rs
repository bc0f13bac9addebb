//! Legal and illegal files that the parser, `tobj` 4.0.5, handles wrongly, with a test for each
//! case.

mod errors;
mod fuzz;
mod geometry;
mod materials;

use crate::mesh::read::tests::sentences;
use crate::mesh::read::{LoadedMesh, ReadError, parse_mesh};
use crate::note::Notes;
use std::string::String;
use std::vec::Vec;
use std::{format, io};

/// Five positions: a unit square and a point above its first corner.
const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";

fn parse(text: impl AsRef<[u8]>) -> Result<LoadedMesh, ReadError> {
    parse_mesh("t.obj", text.as_ref(), |_| {
        Err(io::ErrorKind::NotFound.into())
    })
}

/// Loads five points, then `text`.
fn after_points(text: &str) -> LoadedMesh {
    parse(format!("{POINTS}{text}")).unwrap()
}

fn polygons(loaded: &LoadedMesh) -> Vec<Vec<u32>> {
    loaded.mesh.polygons().map(<[u32]>::to_vec).collect()
}

/// Returns the only note.
fn warning(loaded: &LoadedMesh) -> String {
    let mut notes = sentences(&loaded.notes);
    assert_eq!(notes.len(), 1, "{notes:?}");
    notes.remove(0)
}
