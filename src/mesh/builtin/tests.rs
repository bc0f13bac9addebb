//! Every built-in shape at several resolutions, wrong parameters, and requested polygon counts.

use super::*;
use crate::mesh::newell::{polygon_normal, unit_normal};
use crate::mesh::vertex_normals::{NormalSource, vertex_normals};
use crate::mesh::weld::weld;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use glam::{DVec3, Vec3};

/// Shapes without open edges.
const CLOSED: [&str; 8] = [
    "sphere",
    "bumpy",
    "superellipsoid",
    "torus",
    "knot",
    "cube",
    "prism",
    "gear",
];
/// Shapes that are entirely visible from their middle.
const STAR_CONVEX: [&str; 4] = ["sphere", "bumpy", "superellipsoid", "cube"];
/// Shapes with a curved surface and normals by formula.
const SMOOTH: [&str; 8] = [
    "sphere",
    "bumpy",
    "superellipsoid",
    "torus",
    "knot",
    "teapot",
    "corrugated",
    "terrain",
];

fn make(spec: &str) -> PolygonMesh {
    builtin(spec).unwrap_or_else(|error| panic!("{spec}: {error}"))
}

/// Returns specs for each shape: by default, coarse, fine, and triangulated if it can be.
fn specs() -> Vec<(&'static Builtin, String)> {
    let mut specs = Vec::new();
    for shape in BUILTINS {
        specs.push((shape, shape.name.to_string()));
        let mut extremes = String::new();
        for parameter in shape
            .parameters
            .iter()
            .filter(|p| p.kind == ParameterKind::Integer && p.min > 1.0)
        {
            extremes += &format!("{}={}&", parameter.name, parameter.min);
        }
        specs.push((shape, format!("{}?{extremes}", shape.name)));
        if shape.resolution.is_some() {
            specs.push((shape, format!("{}?polygons=4000", shape.name)));
            specs.push((
                shape,
                format!("{}?polygons=4001&triangles=true", shape.name),
            ));
        }
    }
    specs.push((
        &BUILTINS[0],
        "sphere?segments=3&rings=2&triangles=true".to_string(),
    ));
    specs
}

/// Counts the uses of each directed edge.
fn edges(mesh: &PolygonMesh) -> BTreeMap<(u32, u32), usize> {
    let mut edges = BTreeMap::new();
    for polygon in mesh.polygons() {
        for k in 0..polygon.len() {
            *edges
                .entry((polygon[k], polygon[(k + 1) % polygon.len()]))
                .or_insert(0) += 1;
        }
    }
    edges
}

#[test]
fn polygon_counts_are_as_computed_before() {
    for (shape, spec) in specs() {
        let values = parse(&spec).expect("a spec from the table");
        assert_eq!(
            make(&spec).polygon_count() as u64,
            (shape.polygon_count)(&values),
            "{spec}"
        );
    }
}

#[test]
fn each_edge_is_used_once_in_each_direction() {
    for (shape, spec) in specs() {
        let edges = edges(&make(&spec));
        for (&(a, b), &count) in &edges {
            assert_ne!(a, b, "{spec}");
            assert_eq!(count, 1, "{spec}: edge {a} {b}");
            if CLOSED.contains(&shape.name) {
                assert!(edges.contains_key(&(b, a)), "{spec}: edge {a} {b} is open");
            }
        }
    }
}

#[test]
fn closed_shapes_face_outward() {
    for (shape, spec) in specs()
        .iter()
        .filter(|(shape, _)| CLOSED.contains(&shape.name))
    {
        let mesh = make(spec);
        let at = |c: u32| mesh.positions()[c as usize].as_dvec3();
        // Six times the volume by the divergence theorem, with each polygon as a cone from the
        // origin.
        let normal = |p: usize| polygon_normal(&mesh, p);
        let volume: f64 = (0..mesh.polygon_count())
            .map(|p| at(mesh.polygon(p)[0]).dot(normal(p)))
            .sum();
        assert!(volume > 0.0, "{spec}: {volume}");
        if STAR_CONVEX.contains(&shape.name) {
            for p in 0..mesh.polygon_count() {
                assert!(
                    at(mesh.polygon(p)[0]).dot(normal(p)) > 0.0,
                    "{spec}: polygon {p}"
                );
            }
        }
    }
}

#[test]
fn every_polygon_has_a_normal_and_the_given_ones_are_on_its_side() {
    for (shape, spec) in specs() {
        let mesh = make(&spec);
        let normals = vertex_normals(&mesh, NormalSource::Given);
        if let Some(given) = mesh.given_normals() {
            // Each coordinate is rounded by at most 2^-25 for numbers up to 1, the length by
            // √3 · 2^-25 < 1e-6.
            assert!(
                given
                    .values
                    .iter()
                    .all(|n| (n.as_dvec3().length() - 1.0).abs() < 1e-6),
                "{spec}"
            );
        }
        for p in 0..mesh.polygon_count() {
            let normal = unit_normal(polygon_normal(&mesh, p))
                .unwrap_or_else(|| panic!("{spec}: polygon {p}"));
            // Coarse meshes of curved shapes may turn by a right angle over one polygon.
            if !SMOOTH.contains(&shape.name) && shape.name != "figure5" {
                for k in mesh.corner_range(p) {
                    let given = normals.values[normals.corners[k] as usize].as_dvec3();
                    // Both are rounded to f32 at least once: 2^-24 per coordinate, squared in the
                    // cosine.
                    assert!(
                        given.dot(normal) > 1.0 - 1e-6,
                        "{spec}: polygon {p}: {given} {normal}"
                    );
                }
            }
        }
    }
}

#[test]
fn given_normals_are_those_of_the_surface() {
    // A polygon's normal is the mean of the surface's normals over it, up to the square of its
    // size. So it lies among those at its corners. At this resolution it is no farther from any
    // than the largest difference between two corners of one polygon. This is about twice the
    // distance of a correct normal, and unrelated to a wrong one. Along an edge the normals at its
    // ends lean to opposite sides by equal angles, up to the square of these.
    for name in SMOOTH {
        // The terrain's smallest hills are as small as its cells, so only the largest are tested.
        let octaves = if name == "terrain" { "&octaves=1" } else { "" };
        let mesh = make(&format!("{name}?polygons=60000{octaves}"));
        let normals = vertex_normals(&mesh, NormalSource::Given);
        let (mut spread, mut off, mut lean) = (0.0f64, 0.0f64, 0.0f64);
        for p in 0..mesh.polygon_count() {
            let own = unit_normal(polygon_normal(&mesh, p)).expect("a normal");
            let at = |k: usize| normals.values[normals.corners[k] as usize].as_dvec3();
            let range = mesh.corner_range(p);
            for k in range.clone() {
                let next = if k + 1 == range.end {
                    range.start
                } else {
                    k + 1
                };
                let place = |k: usize| mesh.positions()[mesh.corners()[k] as usize].as_dvec3();
                let along = (place(next) - place(k)).normalize();
                lean = lean.max((at(k) + at(next)).dot(along).abs());
                off = off.max(at(k).angle_between(own));
                mesh.corner_range(p)
                    .for_each(|j| spread = spread.max(at(k).angle_between(at(j))));
            }
        }
        assert!(off <= spread, "{name}: {off} {spread}");
        assert!(lean <= spread * spread, "{name}: {lean} {spread}");
        // The lip of the teapot's spout is the most curved.
        assert!(
            spread < 0.6,
            "{name}: too coarse for the question, {spread}"
        );
    }
}

#[test]
fn averaged_normals_of_a_sphere_are_close_to_its_own() {
    // With steps of δ in both directions, a quad in latitude φ has a normal of latitude
    // atan(cos(δ/2) tan φ): off by at most δ²/16. The mean of two that are δ apart in longitude
    // adds as much, and so do those north and south of a vertex: δ²/8 in all, up to fourth powers
    // of δ. At the poles the mean is exact by symmetry.
    let rings = 32;
    let mesh = make(&format!("sphere?rings={rings}&segments={}", 2 * rings));
    let averaged = vertex_normals(&mesh, NormalSource::Averaged);
    let step = core::f64::consts::PI / rings as f64;
    let mut most = 0.0f64;
    for (k, &c) in mesh.corners().iter().enumerate() {
        let own = mesh.positions()[c as usize].as_dvec3();
        most = most.max(
            averaged.values[averaged.corners[k] as usize]
                .as_dvec3()
                .angle_between(own),
        );
    }
    assert!(
        most < step * step / 8.0 * 1.01,
        "{most} {}",
        step * step / 8.0
    );
    assert_eq!(averaged.values.len(), mesh.positions().len());
}

/// Every vertex of every shape has one surface around it, so that its average includes all polygons
/// there. The only exception is the point where the teapot's handle touches its belly: both share a
/// vertex there, but no edge.
#[test]
fn averages_go_over_all_polygons_around_a_vertex() {
    for shape in BUILTINS {
        let mesh = make(shape.name);
        let (vertex, count) = weld(mesh.positions());
        let mut sums = vec![(DVec3::ZERO, usize::MAX); count];
        for p in 0..mesh.polygon_count() {
            let Some(normal) = unit_normal(polygon_normal(&mesh, p)) else {
                continue;
            };
            for &corner in mesh.polygon(p) {
                let (sum, last) = &mut sums[vertex[corner as usize] as usize];
                if core::mem::replace(last, p) != p {
                    *sum += normal;
                }
            }
        }
        let normals = vertex_normals(&mesh, NormalSource::Averaged);
        let mut different = BTreeMap::new();
        for (k, &corner) in mesh.corners().iter().enumerate() {
            let (sum, _) = sums[vertex[corner as usize] as usize];
            let expected = unit_normal(sum).unwrap_or(DVec3::Z).as_vec3();
            let found = normals.values[normals.corners[k] as usize];
            if found != expected {
                different.insert(vertex[corner as usize], mesh.positions()[corner as usize]);
            }
        }
        let expected: &[Vec3] = match shape.name {
            "teapot" => &[Vec3::new(-1.0, -0.3375, 0.0)],
            _ => &[],
        };
        let different: Vec<Vec3> = different.into_values().collect();
        assert_eq!(different, expected, "{}", shape.name);
    }
}

#[test]
fn sizes_are_right() {
    // The volume of the sphere is approached from below: each direction loses at most δ²/8 · 2 of
    // it.
    let volume = |spec: &str| {
        let mesh = make(spec);
        let cone = |p: usize| {
            mesh.positions()[mesh.polygon(p)[0] as usize]
                .as_dvec3()
                .dot(polygon_normal(&mesh, p))
        };
        (0..mesh.polygon_count()).map(cone).sum::<f64>() / 6.0
    };
    let pi = core::f64::consts::PI;
    for (spec, exact) in [
        ("sphere?polygons=20000", 4.0 / 3.0 * pi),
        ("torus?polygons=40000", 2.0 * pi * pi * 0.4 * 0.4),
        ("superellipsoid?e1=1&e2=1&polygons=20000", 4.0 / 3.0 * pi),
    ] {
        let step = 2.0 * pi / 200.0;
        let found = volume(spec);
        assert!(
            found < exact && found > exact * (1.0 - step * step / 2.0),
            "{spec}: {found} {exact}"
        );
    }
    // Coordinates in eighths are exact.
    assert_eq!(volume("cube?res=8"), 8.0);
    let area = |spec: &str| {
        let mesh = make(spec);
        (0..mesh.polygon_count())
            .map(|p| polygon_normal(&mesh, p).z / 2.0)
            .sum::<f64>()
    };
    // In squares of 0.1 × 0.1: S 11, H 11, I 9, N 14 and E 11. Rounding to f32 is far below 1e-6 of
    // them.
    let squares = 11.0 + 11.0 + 9.0 + 14.0 + 11.0;
    assert!(
        (area("letters") - squares / 100.0).abs() < 1e-6,
        "{}",
        area("letters") * 100.0
    );
    assert!((area("polygon?sides=4") - 2.0).abs() < 1e-6);
    // A comb of 8 teeth fills 15 · 1 + 8 · 3 of 15 · 4 cells, on a rectangle of 2 × 1.
    assert!((area("comb") - 2.0 * 39.0 / 60.0).abs() < 1e-6);
}

#[test]
fn a_knot_closes_without_a_jump() {
    // Each line of positions along the tube continues smoothly over the seam: no step is over twice
    // the mean step.
    let (segments, sides) = (600, 12);
    let mesh = make(&format!("knot?segments={segments}&sides={sides}"));
    for side in 0..sides {
        let at = |k: usize| mesh.positions()[side * segments + k % segments];
        let steps: Vec<f32> = (0..segments).map(|k| at(k).distance(at(k + 1))).collect();
        let mean = steps.iter().sum::<f32>() / segments as f32;
        assert!(steps.iter().all(|&s| s < 2.0 * mean), "side {side}");
    }
}

#[test]
fn the_square_of_figure_5() {
    let corner_normals = [Vec3::Z, Vec3::Z, -Vec3::Y, Vec3::Z];
    let upright = make("figure5");
    assert_eq!(upright.polygon(0).len(), 4);
    assert_eq!(
        upright.given_normals().map(|n| n.values.clone()),
        Some(corner_normals.to_vec())
    );
    // Every scanline of the upper half runs between white edges.
    let white: Vec<f32> = (0..4)
        .filter(|&k| corner_normals[k] == Vec3::Z)
        .map(|k| upright.positions()[k].y)
        .collect();
    assert_eq!(white, vec![1.0, 0.0, 0.0]);
    let turned = make("figure5?angle=90");
    assert_eq!(
        turned.positions()[2],
        Vec3::X,
        "the black corner is at the right"
    );
    assert_eq!(turned.given_normals().map(|n| n.values[2]), Some(Vec3::X));
    // Turn by a full circle, and by an angle that is not a whole number.
    assert_eq!(make("figure5?angle=360").positions(), upright.positions());
    let near = make("figure5?angle=89.9999999");
    assert!(
        near.positions()
            .iter()
            .zip(turned.positions())
            .all(|(a, b)| a.distance(*b) < 1e-6)
    );
}

#[test]
fn the_teapot() {
    use crate::mesh::shapes::teapot_data::{PATCHES, POINTS};
    assert_eq!(POINTS[..2], [[1.4, 0.0, 2.4], [1.4, -0.784, 2.4]]);
    assert_eq!((POINTS.len(), PATCHES.len()), (290, 32));
    for point in 0..290 {
        assert!(PATCHES.as_flattened().contains(&point));
    }
    // The body is symmetric to both vertical planes, the whole teapot to the one through spout and
    // handle.
    for point in POINTS {
        let mirrored = [point[0], -point[1], point[2]];
        assert!(POINTS.contains(&mirrored), "{point:?}");
    }
    let mesh = make("teapot?res=6");
    // Handle and spout are two patches around: the normals point away from the middle of each ring.
    let patch = |k: usize| k * 36..(k + 1) * 36;
    // At the spout's tip, the last rows, they turn up and inward around its lip.
    for (first, rows) in [(12, 6), (14, 6), (16, 6), (18, 3)] {
        for row in 0..rows {
            let ring: Vec<usize> = [first, first + 1]
                .iter()
                .flat_map(|&k| patch(k).skip(6 * row).take(6))
                .collect();
            let centre_of = |p: usize| {
                let corners = mesh.polygon(p);
                corners
                    .iter()
                    .map(|&c| mesh.positions()[c as usize].as_dvec3())
                    .sum::<DVec3>()
                    / corners.len() as f64
            };
            let middle = ring.iter().map(|&p| centre_of(p)).sum::<DVec3>() / 12.0;
            for p in ring {
                assert!(
                    (centre_of(p) - middle).dot(polygon_normal(&mesh, p)) > 0.0,
                    "polygon {p}"
                );
            }
        }
    }
    // Normals point up at the top of the knob, down in the middle of the bottom, and away from the
    // axis at the belly.
    assert!(polygon_normal(&mesh, patch(20).start).y > 0.0);
    assert!(polygon_normal(&mesh, patch(28).start).y < 0.0);
    let belly = mesh.positions()[mesh.polygon(patch(4).end - 1)[0] as usize].as_dvec3();
    assert!(polygon_normal(&mesh, patch(4).end - 1).dot(belly * DVec3::new(1.0, 0.0, 1.0)) > 0.0);
    // Only rim, lid, spout and both ends of the handle are open. Patches share all other edges.
    let edges = edges(&mesh);
    let open = edges
        .keys()
        .filter(|&&(a, b)| !edges.contains_key(&(b, a)))
        .count();
    let (round, tube) = (4 * 6, 2 * 6);
    assert_eq!(open, 2 * round + 4 * tube);
    let (low, high) = mesh.bounds().expect("polygons");
    assert_eq!((low.y as f32, high.y as f32), (-0.7875, 0.7875));
}

#[test]
fn the_number_of_polygons_asked_for_is_nearly_made() {
    for shape in BUILTINS.iter().filter(|b| b.resolution.is_some()) {
        for target in [1_000u64, 20_000, 100_000] {
            for triangles in [false, true] {
                let spec = format!("{}?polygons={target}&triangles={triangles}", shape.name);
                let found = parse(&spec).expect("a spec").polygon_count();
                // One resolution n gives c n² polygons, so the nearest is off by at most c
                // n = √(c · target), and c is at most 64. With rows and columns a row or a column
                // can be left out or added: half of √(16 target).
                let most = match shape.resolution {
                    Some(Resolution { columns: None, .. }) => libm::sqrt(64.0 * target as f64),
                    _ => 0.5 * libm::sqrt(16.0 * target as f64),
                };
                assert!(found.abs_diff(target) as f64 <= most, "{spec}: {found}");
            }
        }
    }
    // 223 or 224 rings alone would miss by 96, so other ratios are tried too.
    assert!(
        parse("sphere?polygons=100_000")
            .expect("a spec")
            .polygon_count()
            .abs_diff(100_000)
            < 10
    );
    assert_eq!(
        parse("sphere?polygons=20_000")
            .expect("a spec")
            .polygon_count(),
        100 * 200
    );
    assert!(
        parse("sphere?polygons=16777216")
            .expect("a spec")
            .polygon_count()
            <= 1 << 24
    );
    assert!(parse("cube?polygons=1").expect("a spec").polygon_count() == 6);
}

#[test]
fn the_documentation_lists_every_shape_with_its_parameters() {
    let page = include_str!("../builtin.rs");
    for shape in BUILTINS {
        let start = format!("//! | `{}`", shape.name);
        let line = page
            .lines()
            .find(|line| line.starts_with(&start))
            .unwrap_or_else(|| panic!("{} is missing", shape.name));
        for parameter in shape.parameters {
            let is_listed = line.contains(&format!("`{}`", parameter.name));
            assert!(
                is_listed || parameter.name == "triangles",
                "{}: {}",
                shape.name,
                parameter.name
            );
        }
    }
}

#[test]
fn the_table_is_sound() {
    for (i, shape) in BUILTINS.iter().enumerate() {
        assert!(!BUILTINS[..i].iter().any(|other| other.name == shape.name));
        for parameter in shape.parameters {
            assert!(
                (parameter.min..=parameter.max).contains(&parameter.default),
                "{} {}",
                shape.name,
                parameter.name
            );
            // The default as text is parsed as the default.
            let text = match parameter.kind {
                ParameterKind::Bool => (parameter.default != 0.0).to_string(),
                _ => parameter.default.to_string(),
            };
            assert_eq!(parameter.parse(&text), Ok(parameter.default));
        }
        for name in shape.resolution.iter().flat_map(Resolution::parameters) {
            assert!(
                shape.parameters.iter().any(|p| p.name == name),
                "{} {name}",
                shape.name
            );
        }
    }
}

#[test]
fn errors_say_what_is_wrong() {
    for (spec, message) in [
        (
            "sphre",
            "no built-in mesh is named `sphre`; did you mean `sphere`? (there are sphere, bumpy,",
        ),
        (
            "bunny",
            "no built-in mesh is named `bunny` (there are sphere,",
        ),
        ("", "no built-in mesh is named `` (there are"),
        (
            "sphere?ring=3",
            "`sphere` has no parameter `ring`; did you mean `rings`? (it has segments, rings, triangles, polygons)",
        ),
        (
            "triangle?polygons=3",
            "`triangle` has no parameter `polygons` (it has none)",
        ),
        ("sphere?rings", "`rings` should be written as key=value"),
        ("sphere?rings=3&rings=4", "`rings` is set twice"),
        ("sphere?rings=many", "`rings` is a whole number, not `many`"),
        ("sphere?rings=2.5", "`rings` is a whole number, not `2.5`"),
        ("sphere?rings=", "`rings` is a whole number, not ``"),
        ("torus?minor=NaN", "`minor` is a number, not `NaN`"),
        ("torus?minor=inf", "`minor` is inf: expected 0.001 to 10"),
        (
            "sphere?triangles=yes",
            "`triangles` is true or false, not `yes`",
        ),
        ("sphere?rings=1", "`rings` is 1: expected 2 to 1048576"),
        ("sphere?rings=-1", "`rings` is -1: expected 2 to 1048576"),
        (
            "sphere?polygons=0",
            "`polygons` is 0: expected 1 to 16777216",
        ),
        (
            "sphere?polygons=9&rings=3",
            "`polygons` chooses `rings` itself: set one or the other",
        ),
        (
            "knot?p=4&q=6",
            "`p` and `q` of the knot have the common factor 2: expected two numbers without one",
        ),
        (
            "sphere?rings=1048576&segments=1048576",
            "the mesh would have 1099511627776 polygons, over the limit of 16777216",
        ),
    ] {
        let error = builtin(spec).expect_err(spec).to_string();
        assert!(error.starts_with(message), "{spec}: {error}");
    }
    let huge = format!("sphere?rings={}", "9".repeat(60));
    let error = builtin(&huge).expect_err(&huge).to_string();
    assert!(error.starts_with("`rings` "), "{error}");
}
