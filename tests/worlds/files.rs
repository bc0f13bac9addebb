//! Mesh files drawn on their own: neither winding nor stray bytes change the picture.

use super::mesh::obj;
use super::{WORLDS, assert_none, setting, try_all};
use fastphong::mesh::read::{LoadedMesh, ReadError, parse_mesh};
use fastphong::picture::Picture8;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::SceneTable;
use fastphong::shading::Variant;
use proptest::prelude::*;
use std::cell::Cell;
use std::fmt::Write;
use std::io::ErrorKind;
use std::sync::Arc;

/// A sheet of quads over a grid, and the direction that it is seen from.
#[derive(Clone, Debug)]
struct Sheet {
    side: usize,
    heights: Vec<f64>,
    /// True for each quad that is wound the other way.
    reversed: Vec<bool>,
    /// 1 or -1 if the file has normals that point up or down; `None` if it has no normals.
    normals: Option<i32>,
    view: [f64; 2],
}

const MOST_SIDE: usize = 7;

fn sheets() -> BoxedStrategy<Sheet> {
    let corners = (MOST_SIDE + 1) * (MOST_SIDE + 1);
    (
        1..=MOST_SIDE,
        prop::collection::vec(-0.6..0.6, corners),
        prop::collection::vec(any::<bool>(), MOST_SIDE * MOST_SIDE),
        prop::option::of(prop_oneof![Just(1), Just(-1)]),
        [-180.0..180.0, -89.0..89.0],
    )
        .prop_map(|(side, heights, reversed, normals, view)| Sheet {
            side,
            heights,
            reversed,
            normals,
            view,
        })
        .boxed()
}

impl Sheet {
    /// Writes the sheet as an OBJ file, unchanged or with all quads wound upward.
    fn obj(&self, is_reversed: bool) -> String {
        let (mut text, row) = (String::new(), self.side + 1);
        for k in 0..row * row {
            let (x, z, y) = (k % row, k / row, self.heights[k]);
            let _ = writeln!(text, "v {x} {y:?} {z}");
        }
        if let Some(sign) = self.normals {
            let _ = writeln!(text, "vn 0 {sign} 0");
        }
        let normal = self.normals.map_or("", |_| "//1");
        for k in 0..self.side * self.side {
            let first = k / self.side * row + k % self.side + 1;
            let mut quad = [first, first + row, first + row + 1, first + 1];
            if is_reversed && self.reversed[k] {
                quad.reverse();
            }
            let corners = quad.map(|corner| format!(" {corner}{normal}"));
            let _ = writeln!(text, "f{}", corners.concat());
        }
        text
    }

    /// Draws a file of the sheet.
    fn draw(&self, obj: &str) -> Result<Picture8, String> {
        let mut file = SceneFile::for_mesh("sheet.obj");
        let [azimuth, elevation] = self.view;
        let over = format!(
            "image = {{ width = 40, height = 30 }}\ncamera = {{ azimuth = {azimuth:?}, elevation = {elevation:?} }}\n"
        );
        file.overlay(SceneTable::parse(&over).map_err(|error| error.render(false))?);
        let loaded = parse(obj).map_err(|error| error.to_string())?;
        let mesh = Arc::new(loaded.mesh);
        let resolved = file.resolve(|_, _| Ok((mesh.clone(), Default::default())));
        let scene = resolved.map_err(|error| error.render(false))?.scene;
        let frame = scene.frame().map_err(|error| error.to_string())?;
        // An average would stop at an edge between quads that are wound differently.
        let method = self.normals.map_or("flat", |_| "naive-phong");
        let variant = Variant::parse(method).map_err(|error| error.to_string())?;
        variant.render(&frame).map_err(|error| error.to_string())
    }
}

fn parse(obj: &str) -> Result<LoadedMesh, ReadError> {
    parse_mesh("sheet.obj", obj.as_bytes(), |_| {
        Err(ErrorKind::NotFound.into())
    })
}

#[test]
fn an_open_mesh_alone_looks_the_same_however_its_polygons_are_wound() {
    let worlds = setting("FASTPHONG_WORLDS", WORLDS);
    let covered = Cell::new(0);
    let failures = try_all(&sheets(), worlds, |sheet| {
        let [right, wrong] = [false, true].map(|is_reversed| sheet.draw(&sheet.obj(is_reversed)));
        let (right, wrong) = (right?, wrong?);
        for (p, q) in right.pixels().iter().zip(wrong.pixels()) {
            // Newell's sum starts from another corner, so a colour may round the other way.
            if (0..4).any(|c| p[c].abs_diff(q[c]) > 1) {
                return Err(format!("{p:?} or {q:?}\n{}", sheet.obj(true)));
            }
            covered.set(covered.get() + usize::from(p[3] == 255));
        }
        Ok(())
    });
    assert_none(&failures);
    assert!(covered.get() > 100 * worlds as usize, "{}", covered.get());
}

/// Returns a file with stray bytes between or around its lines. `kinds` selects the bytes for each
/// line.
fn with_stray_bytes(obj: &str, kinds: &[u8]) -> String {
    let mut text = String::new();
    for (line, kind) in obj.lines().zip(kinds.iter().cycle()) {
        let _ = match kind {
            0 => writeln!(text, "{line}\0"),
            1 => writeln!(text, "\u{feff}{line}"),
            2 => writeln!(text, "# a\0b\n\n{line} # c\0"),
            3 => writeln!(text, "\0{line}\x1a\r"),
            4 => match (line.starts_with(['v', 'f']), line.rsplit_once(' ')) {
                (true, Some((start, end))) => writeln!(text, "{start} \\\n\n# \0\n  {end}"),
                _ => writeln!(text, "{line}"),
            },
            5 if line.starts_with(['v', 'f', 's']) => writeln!(text, "{line} \\\n"),
            6 => writeln!(text, "g a\0b\n{line}"),
            _ => writeln!(text, "{line}"),
        };
    }
    text + "\0\x1a\0"
}

#[test]
fn stray_bytes_change_no_mesh() {
    let worlds = setting("FASTPHONG_WORLDS", WORLDS);
    let read = Cell::new(0);
    let inputs = (obj(), prop::collection::vec(0..9u8, 1..40));
    let failures = try_all(&inputs, worlds, |(obj, kinds)| {
        let stray = with_stray_bytes(&obj, &kinds);
        match (parse(&obj), parse(&stray)) {
            (Ok(one), Ok(other)) if one.mesh == other.mesh => {
                read.set(read.get() + 1);
                Ok(())
            }
            (Err(one), Err(other)) if one.problem == other.problem => Ok(()),
            (one, other) => Err(format!("{stray:?}: {one:?} or {other:?}")),
        }
    });
    assert_none(&failures);
    assert!(read.get() * 2 > worlds, "{}", read.get());
}
