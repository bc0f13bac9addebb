//! Strategies for meshes: built-in shapes with parameters, and OBJ files of random polygons.

use super::numbers::{any_size, colour, number, size, triple};
use fastphong::mesh::builtin::{BUILTINS, POLYGONS, ParameterKind, ShapeParameter};
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::fmt::Write;

/// The most cells along one direction of a built-in shape.
const MOST_CELLS: f64 = 12.0;

/// Returns names of built-in shapes with some of their parameters set,
/// `builtin:knot?p=3&radius=0.2`.
pub fn builtin_name() -> BoxedStrategy<String> {
    let most = BUILTINS.iter().map(|shape| shape.parameters.len()).max();
    let settings = prop::collection::vec(prop::option::of(0.0..=1.0), most.unwrap_or(0) + 1);
    (0..BUILTINS.len(), settings)
        .prop_map(|(shape, settings)| {
            let shape = &BUILTINS[shape];
            let mut name = format!("builtin:{}", shape.name);
            let parameters = shape.all_parameters().zip(settings);
            for (parameter, part) in parameters {
                if let Some(value) = parameter_value(parameter, part) {
                    let mark = if name.contains('?') { '&' } else { '?' };
                    let _ = write!(name, "{mark}{}={value}", parameter.name);
                }
            }
            name
        })
        .boxed()
}

/// Returns the text of a value at `part` of the parameter's range; `None` leaves the parameter out.
fn parameter_value(parameter: &ShapeParameter, part: Option<f64>) -> Option<String> {
    let ShapeParameter {
        kind,
        default,
        min,
        max,
        ..
    } = *parameter;
    // Cell counts are always set, and to small values, because a default shape may have thousands
    // of polygons. `polygons` cannot be set with them.
    let is_count = kind == ParameterKind::Integer && max > 100.0 && parameter.name != "seed";
    if parameter.name == POLYGONS || (part.is_none() && !is_count) {
        return None;
    }
    let part = part.unwrap_or(0.5);
    let within = |least: f64, most: f64| least + part * (most - least);
    Some(match kind {
        ParameterKind::Integer if is_count => {
            format!("{}", within(min, min + MOST_CELLS).round())
        }
        ParameterKind::Integer => format!("{}", within(min, max).round()),
        // Half of the values are near the default, which lies at the lower end of a wide range.
        ParameterKind::Real if part < 0.5 => {
            format!("{:?}", (4.0 * part * default.max(1.0)).clamp(min, max))
        }
        ParameterKind::Real => format!("{:?}", within(min, max)),
        ParameterKind::Bool => format!("{}", part < 0.5),
    })
}

/// A polygon of a random mesh.
#[derive(Clone, Debug)]
struct Face {
    /// Indices of positions, modulo their count.
    corners: Vec<u16>,
    /// Indices of normals, modulo their count. They are not used if the mesh has no normals.
    normal: u16,
    /// An index into [`MATERIALS`], or none.
    material: Option<u8>,
    smoothing: Option<u8>,
    /// A copy of the polygon that begins with this corner.
    again: Option<(u16, Again)>,
}

/// The way in which a polygon is repeated.
#[derive(Clone, Copy, Debug)]
enum Again {
    /// Whole, in the same direction.
    Same,
    /// Whole, in the other direction.
    Reversed,
    /// As the triangles of a fan.
    Fan,
}

/// The names of the materials in `world.mtl`.
const MATERIALS: [&str; 3] = ["dull", "red", "shiny"];

fn face(corners: std::ops::Range<usize>) -> BoxedStrategy<Face> {
    let how = prop_oneof![Just(Again::Same), Just(Again::Reversed), Just(Again::Fan)];
    let again = prop::option::weighted(0.2, (any::<u16>(), how));
    (
        prop::collection::vec(any::<u16>(), corners),
        any::<u16>(),
        prop::option::of(0..MATERIALS.len() as u8),
        prop::option::weighted(0.2, 0..3u8),
        again,
    )
        .prop_map(|(corners, normal, material, smoothing, again)| Face {
            corners,
            normal,
            material,
            smoothing,
            again,
        })
        .boxed()
}

/// Returns positions anywhere, of any size, on a grid, in a plane, or on a line. They are then
/// scaled and moved as a whole.
fn positions() -> BoxedStrategy<Vec<[f64; 3]>> {
    let flat = |point: [f64; 3]| [point[0], point[1], 0.5 * point[0] - 0.25 * point[1]];
    let coarse = |point: [f64; 3]| point.map(|c: f64| (2.0 * c).round() / 2.0);
    let line = |point: [f64; 3]| [point[0], 0.5 * point[0], 1.0 - point[0]];
    let several = |of: BoxedStrategy<[f64; 3]>| prop::collection::vec(of, 3..24);
    let around = || triple(number());
    let kinds = prop_oneof![
        5 => several(around()),
        2 => several(triple(any_size())),
        2 => several(around().prop_map(coarse).boxed()),
        2 => several(around().prop_map(flat).boxed()),
        1 => several(around().prop_map(line).boxed()),
    ];
    let scale = prop_oneof![4 => Just(1.0), 1 => size(-12.0..8.0)];
    let offset = prop_oneof![
        4 => Just([0.0; 3]),
        1 => triple((number(), size(0.0..7.0)).prop_map(|(n, size)| n * size).boxed()),
    ];
    (kinds, scale, offset)
        .prop_map(|(mut points, scale, offset)| {
            for point in &mut points {
                for (c, offset) in point.iter_mut().zip(offset) {
                    *c = scale * *c + offset;
                }
            }
            points
        })
        .boxed()
}

/// Returns OBJ files of polygons that share corners, cross themselves and each other, repeat, or
/// have no area.
fn soup() -> BoxedStrategy<String> {
    let faces = prop_oneof![
        4 => prop::collection::vec(face(3..6), 1..24),
        2 => prop::collection::vec(face(3..12), 1..12),
        1 => prop::collection::vec(face(3..80), 1..4),
    ];
    let normals = prop_oneof![
        2 => Just(Vec::new()),
        1 => prop::collection::vec(triple(any_size()), 1..8),
    ];
    let colours = prop::option::weighted(0.2, prop::collection::vec(colour(), 24));
    (positions(), faces, normals, colours)
        .prop_map(|(positions, faces, normals, colours)| {
            write_obj(&positions, &faces, &normals, colours.as_deref())
        })
        .boxed()
}

/// Returns OBJ files of one polygon that does not cross itself: a star around a point, with any
/// radii.
fn star() -> BoxedStrategy<String> {
    let radii = prop::collection::vec(prop_oneof![Just(1.0), 0.05..2.0], 3..30);
    (radii, triple(number()))
        .prop_map(|(radii, tilt)| {
            let count = radii.len();
            let around = radii.iter().enumerate().map(|(i, radius)| {
                let (sin, cos) = (TAU * i as f64 / count as f64).sin_cos();
                let (x, y) = (radius * cos, radius * sin);
                [x, y, 0.5 * (tilt[0] * x + tilt[1] * y)]
            });
            let face = Face {
                corners: (0..count as u16).collect(),
                normal: 0,
                material: None,
                smoothing: None,
                again: None,
            };
            write_obj(&around.collect::<Vec<_>>(), &[face], &[], None)
        })
        .boxed()
}

/// Returns OBJ files.
pub fn obj() -> BoxedStrategy<String> {
    prop_oneof![5 => soup(), 1 => star()].boxed()
}

fn write_obj(
    positions: &[[f64; 3]],
    faces: &[Face],
    normals: &[[f64; 3]],
    colours: Option<&[[f64; 3]]>,
) -> String {
    let mut text = String::new();
    if faces.iter().any(|face| face.material.is_some()) {
        text.push_str("mtllib world.mtl\n");
    }
    for (index, [x, y, z]) in positions.iter().enumerate() {
        let _ = write!(text, "v {x:?} {y:?} {z:?}");
        if let Some([r, g, b]) = colours.and_then(|colours| colours.get(index)) {
            let _ = write!(text, " {r:?} {g:?} {b:?}");
        }
        text.push('\n');
    }
    for [x, y, z] in normals {
        let _ = writeln!(text, "vn {x:?} {y:?} {z:?}");
    }
    for face in faces {
        if let Some(material) = face.material {
            let _ = writeln!(text, "usemtl {}", MATERIALS[usize::from(material)]);
        }
        if let Some(group) = face.smoothing {
            let _ = writeln!(text, "s {group}");
        }
        write_face(&mut text, face, &face.corners, positions, normals);
        if let Some((start, how)) = face.again {
            let mut corners = face.corners.clone();
            corners.rotate_left(usize::from(start) % face.corners.len());
            if let Again::Reversed = how {
                corners.reverse();
            }
            let fan = 1..corners.len() - 1;
            let pieces = match how {
                Again::Same | Again::Reversed => vec![corners],
                Again::Fan => fan
                    .map(|i| vec![corners[0], corners[i], corners[i + 1]])
                    .collect(),
            };
            for piece in pieces {
                write_face(&mut text, face, &piece, positions, normals);
            }
        }
    }
    text
}

fn write_face(
    text: &mut String,
    face: &Face,
    corners: &[u16],
    positions: &[[f64; 3]],
    normals: &[[f64; 3]],
) {
    text.push('f');
    for corner in corners {
        let _ = write!(text, " {}", usize::from(*corner) % positions.len() + 1);
        if !normals.is_empty() {
            let normal = usize::from(face.normal ^ corner) % normals.len();
            let _ = write!(text, "//{}", normal + 1);
        }
    }
    text.push('\n');
}

/// Returns material libraries that define all materials a mesh may name.
pub fn mtl() -> BoxedStrategy<String> {
    let material = || (colour(), colour(), colour(), super::scene::shininess());
    [material(), material(), material()]
        .prop_map(|materials| {
            let mut text = String::new();
            for (name, (ka, kd, ks, ns)) in MATERIALS.iter().zip(materials) {
                let three = |[r, g, b]: [f64; 3]| format!("{r:?} {g:?} {b:?}");
                let (ka, kd, ks) = (three(ka), three(kd), three(ks));
                let _ = writeln!(text, "newmtl {name}\nKa {ka}\nKd {kd}\nKs {ks}\nNs {ns:?}");
            }
            text
        })
        .boxed()
}

/// Returns the materials of a library that the mesh uses.
pub fn used_materials(library: &str, mesh: &str) -> String {
    let used = library.split("newmtl ").filter(|part| {
        let name = part.lines().next().unwrap_or_default();
        !name.is_empty() && mesh.contains(&format!("usemtl {name}\n"))
    });
    used.map(|material| format!("newmtl {material}")).collect()
}
