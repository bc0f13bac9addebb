//! Weighted averages against closed forms.

use super::*;
use crate::mesh::MeshBuilder;
use crate::number::test_random::Random;
use core::f64::consts::{FRAC_PI_2, PI, TAU};

const WEIGHTS: [NormalWeight; 4] = [
    NormalWeight::Uniform,
    NormalWeight::Area,
    NormalWeight::Angle,
    NormalWeight::Max,
];

fn averaged_by(weight: NormalWeight) -> NormalRule {
    let source = NormalSource::Averaged;
    NormalRule { source, weight }
}

fn mesh_of(positions: &[DVec3], polygons: &[Vec<u32>]) -> PolygonMesh {
    let mut builder = MeshBuilder::new(positions.iter().map(|p| p.as_vec3()).collect());
    polygons.iter().for_each(|polygon| {
        builder.polygon(polygon);
    });
    builder.finish().expect("a mesh")
}

/// Cuts each quad `k` of `polygons` along its first diagonal if `is_first(k)`, else along the other
/// one.
fn cut(polygons: &[Vec<u32>], mut is_first: impl FnMut(usize) -> bool) -> Vec<Vec<u32>> {
    let mut triangles = Vec::new();
    for (k, polygon) in polygons.iter().enumerate() {
        match (&polygon[..], is_first(k)) {
            (&[a, b, c, d], true) => triangles.extend([vec![a, b, c], vec![a, c, d]]),
            (&[a, b, c, d], false) => triangles.extend([vec![b, c, d], vec![b, d, a]]),
            _ => triangles.push(polygon.clone()),
        }
    }
    triangles
}

fn at(normals: &VertexNormals, corner: usize) -> DVec3 {
    normals.values[normals.corners[corner] as usize].as_dvec3()
}

fn degrees_between(a: DVec3, b: DVec3) -> f64 {
    let half = libm::sqrt((a - b).length_squared()) / 2.0;
    2.0 * libm::asin(half.min(1.0)).to_degrees()
}

/// Returns the root mean square and the largest of the angles, in degrees, between the normals of
/// `mesh` and `truth`, over the positions `p` with `counts(p)`.
fn errors(
    mesh: &PolygonMesh,
    rule: NormalRule,
    truth: &[DVec3],
    counts: impl Fn(usize) -> bool,
) -> (f64, f64) {
    let normals = vertex_normals(mesh, rule);
    let mut of_position = vec![None; truth.len()];
    for (k, &position) in mesh.corners().iter().enumerate() {
        of_position[position as usize] =
            Some(degrees_between(at(&normals, k), truth[position as usize]));
    }
    let found: Vec<f64> = of_position
        .iter()
        .enumerate()
        .filter(|(p, _)| counts(*p))
        .filter_map(|(_, error)| *error)
        .collect();
    let squares: f64 = found.iter().map(|e| e * e).sum();
    let rms = libm::sqrt(squares / found.len() as f64);
    (rms, found.iter().copied().fold(0.0, f64::max))
}

fn rms(mesh: &PolygonMesh, weight: NormalWeight, truth: &[DVec3]) -> f64 {
    errors(mesh, averaged_by(weight), truth, |_| true).0
}

fn cube() -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let side = |bit: u32| f64::from(bit & 1) * 2.0 - 1.0;
    let positions = (0..8u32).map(|i| DVec3::new(side(i), side(i >> 1), side(i >> 2)));
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    (positions.collect(), faces.map(Vec::from).to_vec())
}

/// A bound on the rounding of a unit normal in `f32`, whose components are off by at most half an
/// ε.
const ROUNDED: f64 = f32::EPSILON as f64;

#[test]
fn the_diagonals_of_a_cube_do_not_move_normals_by_angle_or_by_max() {
    let (positions, faces) = cube();
    let truth: Vec<DVec3> = positions.iter().map(|p| p.normalize()).collect();
    let mut worst = [0.0f64; 4];
    for diagonals in 0..64 {
        let mesh = mesh_of(&positions, &cut(&faces, |face| diagonals >> face & 1 == 0));
        for (weight, worst) in WEIGHTS.into_iter().zip(&mut worst) {
            let (_, most) = errors(&mesh, averaged_by(weight), &truth, |_| true);
            *worst = worst.max(most);
        }
    }
    // At a corner, one face may have two triangles and the others one each: the sum is (2, 1, 1)
    // instead of (1, 1, 1).
    let expected = libm::acos(4.0 / libm::sqrt(18.0)).to_degrees();
    let bound = ROUNDED.to_degrees();
    assert!((worst[0] - expected).abs() < bound, "{worst:?}");
    assert!((worst[1] - expected).abs() < bound, "{worst:?}");
    assert!(worst[2] < bound && worst[3] < bound, "{worst:?}");
}

/// Returns all points with integer coordinates on a sphere around 0. They are exact in `f32`.
fn whole_points(square: i32) -> Vec<DVec3> {
    let most = libm::sqrt(f64::from(square)) as i32;
    let range = -most..=most;
    let mut points = Vec::new();
    for x in range.clone() {
        for y in range.clone() {
            for z in range.clone() {
                if x * x + y * y + z * z == square {
                    points.push(DVec3::new(x.into(), y.into(), z.into()));
                }
            }
        }
    }
    points
}

#[test]
fn max_is_exact_on_a_sphere_however_it_is_triangulated() {
    let points = whole_points(1454);
    assert!(points.len() > 200);
    let mut random = Random::new(45);
    let mut squares = [0.0; 4];
    for (i, &center) in points.iter().enumerate() {
        // One point in the middle and some others, in order around it.
        let near = |p: &DVec3| p.dot(center) > 1454.0 * 0.9 && *p != center;
        let mut around: Vec<DVec3> = points.iter().copied().filter(near).collect();
        around.retain(|_| random.signed() > -0.5);
        let (across, up) = center.normalize().any_orthonormal_pair();
        let turn = |p: &DVec3| libm::atan2(p.dot(up), p.dot(across));
        let up_is_left = across.cross(up).dot(center) > 0.0;
        around.sort_by(|a, b| turn(a).total_cmp(&turn(b)));
        if !up_is_left {
            around.reverse();
        }
        // Only the first point in each direction stays, and the fan must go around in steps below
        // half a turn.
        around.dedup_by(|a, b| (turn(a) - turn(b)).abs() < 1e-6);
        let count = around.len() as u32;
        let steps = (0..around.len()).map(|k| {
            let step = turn(&around[(k + 1) % around.len()]) - turn(&around[k]);
            (step * if up_is_left { 1.0 } else { -1.0 }).rem_euclid(TAU)
        });
        if count < 4 || steps.fold(0.0, f64::max) > 0.9 * PI {
            continue;
        }
        around.push(center);
        let fan: Vec<Vec<u32>> = (0..count)
            .map(|k| vec![count, k, (k + 1) % count])
            .collect();
        let mesh = mesh_of(&around, &fan);
        for (weight, squares) in WEIGHTS.into_iter().zip(&mut squares) {
            let normals = vertex_normals(&mesh, averaged_by(weight));
            let off = degrees_between(at(&normals, 0), center.normalize());
            *squares += off * off;
            if weight == NormalWeight::Max {
                assert!(off < ROUNDED.to_degrees(), "{i}: {off}");
            }
        }
    }
    let [uniform, area, angle, _] = squares;
    // For random fans, weights by angle come second after Max.
    assert!(
        1.0 < angle && 2.0 * angle < uniform.min(area),
        "{squares:?}"
    );
}

/// Returns a grid of quads over a surface that closes in both directions.
fn closed_grid(columns: u32, rows: u32) -> Vec<Vec<u32>> {
    let index = |u: u32, v: u32| u % columns * rows + v % rows;
    let quad = |u: u32, v: u32| {
        vec![
            index(u, v),
            index(u + 1, v),
            index(u + 1, v + 1),
            index(u, v + 1),
        ]
    };
    (0..columns)
        .flat_map(|u| (0..rows).map(move |v| quad(u, v)))
        .collect()
}

/// Returns the positions and the normals of a torus of radii 1 and 0.4.
fn torus(columns: u32, rows: u32) -> (Vec<DVec3>, Vec<DVec3>) {
    let at = |u: u32, v: u32| {
        let (sin_u, cos_u) = libm::sincos(TAU * f64::from(u) / f64::from(columns));
        let (sin_v, cos_v) = libm::sincos(TAU * f64::from(v) / f64::from(rows));
        let normal = DVec3::new(cos_u * cos_v, sin_u * cos_v, sin_v);
        (DVec3::new(cos_u, sin_u, 0.0) + 0.4 * normal, normal)
    };
    (0..columns)
        .flat_map(|u| (0..rows).map(move |v| at(u, v)))
        .unzip()
}

#[test]
fn max_is_exact_on_the_grid_of_a_torus_and_others_depend_on_the_diagonals() {
    let (positions, truth) = torus(24, 24);
    let quads = closed_grid(24, 24);
    // A position is rounded by δ = √3 · 2⁻²⁵ · 1.4. An edge is at least 0.6 · 15° · 0.99 = 0.15
    // long, or 0.4 · 15° = 0.10. So the plane of two edges turns by at most 4δ / 0.1.
    let delta = libm::sqrt(3.0) / f64::from(1u32 << 25) * 1.4;
    let bound = (4.0 * delta / 0.1 + ROUNDED).to_degrees();
    let mut random = Random::new(3);
    let cuts = [
        quads.clone(),
        cut(&quads, |_| true),
        cut(&quads, |_| random.signed() > 0.0),
    ];
    let [kept, one, any] = cuts.map(|polygons| {
        let mesh = mesh_of(&positions, &polygons);
        let (_, most) = errors(&mesh, averaged_by(NormalWeight::Max), &truth, |_| true);
        assert!(most < bound, "{most}");
        WEIGHTS.map(|weight| rms(&mesh, weight, &truth))
    });
    // The quads are flat, so weights by angle do not depend on how they are cut.
    assert!((kept[2] - any[2]).abs() < bound && (kept[2] - one[2]).abs() < bound);
    // Uniform averages are right by symmetry for whole quads. For triangles they are the worse, the
    // less the diagonals agree.
    assert!(
        kept[0] < 0.1 && kept[0] < one[0] && one[0] < any[0],
        "{any:?}"
    );
    assert!(any[2] < 0.5 * any[0], "{any:?}");
    // Moving positions by 1 % of an edge does not change that.
    let noisy = |p: &DVec3| {
        let mut side = || f64::from(random.signed()) * 0.001;
        *p + DVec3::new(side(), side(), side())
    };
    let noisy: Vec<DVec3> = positions.iter().map(noisy).collect();
    let mut random = Random::new(3);
    let mesh = mesh_of(&noisy, &cut(&quads, |_| random.signed() > 0.0));
    let [uniform, _, angle, _] = WEIGHTS.map(|weight| rms(&mesh, weight, &truth));
    assert!(angle < uniform);
}

#[test]
fn on_a_squeezed_torus_cut_anyhow_angles_are_nearer_than_uniform_averages() {
    let (positions, normals) = torus(24, 24);
    let squeeze = DVec3::new(1.0, 0.6, 0.35);
    let positions: Vec<DVec3> = positions.iter().map(|p| *p * squeeze).collect();
    let truth: Vec<DVec3> = normals.iter().map(|n| (*n / squeeze).normalize()).collect();
    let mut random = Random::new(5);
    let polygons = cut(&closed_grid(24, 24), |_| random.signed() > 0.0);
    let mesh = mesh_of(&positions, &polygons);
    let [uniform, _, angle, _] = WEIGHTS.map(|weight| rms(&mesh, weight, &truth));
    assert!(angle < uniform, "{angle} {uniform}");
}

#[test]
fn a_corner_of_a_polygon_that_is_not_flat_counts_with_its_own_normal() {
    // z = sin x sin y over two periods, with 15° between normals. The rim does not count.
    const SIDE: u32 = 25;
    let of = |k: u32| TAU * f64::from(k) / f64::from(SIDE - 1);
    let point = |i: u32| {
        let ((sin_x, cos_x), (sin_y, cos_y)) =
            (libm::sincos(of(i / SIDE)), libm::sincos(of(i % SIDE)));
        let position = DVec3::new(of(i / SIDE), of(i % SIDE), sin_x * sin_y);
        (
            position,
            DVec3::new(-cos_x * sin_y, -sin_x * cos_y, 1.0).normalize(),
        )
    };
    let (positions, truth): (Vec<DVec3>, Vec<DVec3>) = (0..SIDE * SIDE).map(point).unzip();
    let quads: Vec<Vec<u32>> = (0..SIDE - 1)
        .flat_map(|x| (0..SIDE - 1).map(move |y| x * SIDE + y))
        .map(|k| vec![k, k + SIDE, k + SIDE + 1, k + 1])
        .collect();
    let mesh = mesh_of(&positions, &quads);
    let is_inside = |i: usize| {
        [i as u32 / SIDE, i as u32 % SIDE]
            .iter()
            .all(|k| (1..SIDE - 1).contains(k))
    };
    let (inside, _) = errors(&mesh, averaged_by(NormalWeight::Angle), &truth, is_inside);
    let (rim, _) = errors(&mesh, averaged_by(NormalWeight::Angle), &truth, |i| {
        !is_inside(i)
    });
    // For comparison, averages of the whole quads' Newell normals.
    let mut sums = vec![DVec3::ZERO; truth.len()];
    for (p, quad) in quads.iter().enumerate() {
        let normal = unit_normal(crate::mesh::newell::polygon_normal(&mesh, p)).expect("a quad");
        for k in 0..4 {
            let corner = |k: usize| positions[quad[k % 4] as usize];
            let (next, last) = (corner(k + 1) - corner(k), corner(k + 3) - corner(k));
            sums[quad[k] as usize] += normal * next.angle_between(last);
        }
    }
    let of_newell = |counts: &dyn Fn(usize) -> bool| {
        let all = (0..truth.len()).filter(|i| counts(*i));
        let squares = all
            .clone()
            .map(|i| degrees_between(sums[i].normalize(), truth[i]));
        libm::sqrt(squares.map(|e| e * e).sum::<f64>() / all.count() as f64)
    };
    assert!(
        inside < 0.7 * of_newell(&is_inside),
        "{inside} {}",
        of_newell(&is_inside)
    );
    assert!(rim < 0.3 * of_newell(&|i| !is_inside(i)), "{rim}");
}

/// Returns a cube with bevelled edges. Around each vertex lie a face, two strips along edges and
/// the triangle of the corner. The strips are `bevel` wide, and the faces 2.
fn bevelled(bevel: f64) -> (PolygonMesh, DVec3) {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    let inner = 1.0 - bevel;
    let corner = |n: DVec3| (x + y + z) * inner + n * bevel;
    // The three vertices of the corner at (1, 1, 1), and their neighbours on faces and strips.
    let [a, b, c] = [x, y, z].map(corner);
    let back = 2.0 * inner;
    let positions = [
        a,
        b,
        c,
        a - back * y,
        a - back * z,
        a - back * (y + z),
        b - back * z,
        c - back * y,
    ];
    let mut polygons = vec![
        vec![0, 4, 5, 3],
        vec![0, 1, 6, 4],
        vec![0, 3, 7, 2],
        vec![0, 2, 1],
    ];
    // Counter-clockwise seen from outside.
    for polygon in &mut polygons {
        let at = |k: usize| positions[polygon[k] as usize];
        if (at(1) - at(0)).cross(at(2) - at(0)).dot(at(0)) < 0.0 {
            polygon.reverse();
        }
    }
    (mesh_of(&positions, &polygons), a)
}

#[test]
fn bevels_pull_normals_as_their_weights_say() {
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    let (bevel, width) = (0.25, 1.5);
    // The normals, areas, angles and edges of a face, a strip along an edge, and the triangle.
    let step = bevel * libm::sqrt(2.0);
    let face = (x, width * width, FRAC_PI_2, [width, width]);
    let strips = [y, z].map(|side| {
        (
            (x + side).normalize(),
            width * step,
            FRAC_PI_2,
            [width, step],
        )
    });
    let triangle = (
        (x + y + z).normalize(),
        step * step * libm::sqrt(3.0) / 4.0,
        PI / 3.0,
        [step; 2],
    );
    let (mesh, vertex) = bevelled(bevel);
    for weight in WEIGHTS {
        let of = |(normal, area, angle, [a, b]): (DVec3, f64, f64, [f64; 2])| match weight {
            NormalWeight::Uniform => normal,
            NormalWeight::Area => normal * area,
            NormalWeight::Angle => normal * angle,
            NormalWeight::Max => normal * libm::sin(angle) / (a * b),
        };
        let expected: DVec3 = [face, strips[0], strips[1], triangle].map(of).iter().sum();
        let corner = mesh
            .corners()
            .iter()
            .position(|&c| mesh.positions()[c as usize].as_dvec3() == vertex);
        let found = at(
            &vertex_normals(&mesh, averaged_by(weight)),
            corner.expect("a vertex"),
        );
        // All positions are exact.
        let off = degrees_between(found, expected.normalize());
        assert!(off < ROUNDED.to_degrees(), "{weight:?} {off}");
    }
}

/// Returns a prism over an L with the inner corner at 0. The L is whole or cut into quads.
fn prism(is_cut: bool) -> PolygonMesh {
    let outline = [[0, 0], [0, 2], [-2, 2], [-2, -2], [2, -2], [2, 0]];
    let ring = |z: f64| outline.map(|[x, y]| DVec3::new(x.into(), y.into(), z));
    let positions = [ring(0.0), ring(-1.0)].concat();
    let mut polygons: Vec<Vec<u32>> = (0..6)
        .map(|k| vec![k, 6 + k, 6 + (k + 1) % 6, (k + 1) % 6])
        .collect();
    if is_cut {
        polygons.extend([
            vec![0, 1, 2, 3],
            vec![0, 3, 4, 5],
            vec![9, 8, 7, 6],
            vec![11, 10, 9, 6],
        ]);
    } else {
        polygons.extend([vec![0, 1, 2, 3, 4, 5], vec![11, 10, 9, 8, 7, 6]]);
    }
    mesh_of(&positions, &polygons)
}

#[test]
fn a_reflex_corner_counts_with_its_inner_angle_and_looks_outward() {
    let whole = prism(false);
    let corner = whole.corner_range(6).start;
    let found = |mesh: &PolygonMesh, weight| vertex_normals(mesh, averaged_by(weight));
    // The L has 270° at the inner corner, and both walls have 90° each. The edges there are 2, 2
    // and 1 long.
    let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
    for (weight, expected) in [
        (NormalWeight::Uniform, x + y + z),
        (NormalWeight::Area, 2.0 * (x + y) + 12.0 * z),
        (NormalWeight::Angle, x + y + 3.0 * z),
        (NormalWeight::Max, 0.5 * (x + y) + 0.25 * z),
    ] {
        let off = degrees_between(at(&found(&whole, weight), corner), expected.normalize());
        assert!(off < ROUNDED.to_degrees(), "{weight:?} {off}");
    }
    // The angles of the parts add up to the angle of the whole.
    let (whole_normals, cut_normals) = (
        found(&whole, NormalWeight::Angle),
        found(&prism(true), NormalWeight::Angle),
    );
    let off = degrees_between(at(&whole_normals, corner), at(&cut_normals, corner));
    assert!(off < ROUNDED.to_degrees(), "{off}");
}

/// Returns a bent strip of triangles, quads that are not flat, and a pentagon. Its coordinates are
/// multiples of 2⁻²⁰.
fn odd_mesh(scale: f32) -> PolygonMesh {
    let mut random = Random::new(9);
    let mut side = |_| {
        let value = libm::round(f64::from(random.signed()) * f64::from(1u32 << 20));
        (value / f64::from(1u32 << 20)) as f32 * scale
    };
    let positions = (0..60).map(|_| Vec3::from_array([0, 1, 2].map(&mut side)));
    let mut builder = MeshBuilder::new(positions.collect());
    for k in 0..18 {
        builder
            .polygon(&[3 * k, 3 * k + 1, 3 * k + 4, 3 * k + 3])
            .polygon(&[3 * k + 1, 3 * k + 2, 3 * k + 4])
            .polygon(&[3 * k + 2, 3 * k + 5, 3 * k + 4]);
    }
    builder.polygon(&[59, 58, 57, 55, 56]);
    builder.finish().expect("a mesh")
}

#[test]
fn normals_do_not_depend_on_the_scale() {
    for source in [NormalSource::Averaged, NormalSource::Crease(80.0)] {
        for weight in WEIGHTS {
            let rule = NormalRule { source, weight };
            let expected = vertex_normals(&odd_mesh(1.0), rule);
            for exponent in [-100, -63, -1, 1, 40, 126] {
                let scaled = vertex_normals(&odd_mesh(libm::exp2(exponent.into()) as f32), rule);
                assert_eq!(scaled, expected, "{rule:?} {exponent}");
            }
        }
    }
}

#[test]
fn a_tiny_fine_sphere_keeps_its_normals() {
    // A sphere of a micron, measured in kilometres, with 100 rings. Its areas are 1e-21, and
    // products of squared edges are 1e-42.
    let (rings, columns) = (100, 200u32);
    let point = |i: u32| {
        let (sin, cos) = libm::sincos(PI * f64::from(i / columns + 1) / f64::from(rings));
        let (sin_u, cos_u) = libm::sincos(TAU * f64::from(i % columns) / f64::from(columns));
        DVec3::new(sin * cos_u, sin * sin_u, cos)
    };
    let truth: Vec<DVec3> = (0..(rings - 1) * columns).map(point).collect();
    let positions: Vec<DVec3> = truth.iter().map(|p| *p * 1e-9).collect();
    let quads: Vec<Vec<u32>> = (0..rings - 2)
        .flat_map(|v| (0..columns).map(move |u| (v * columns, u)))
        .map(|(row, u)| {
            [
                u,
                columns + u,
                columns + (u + 1) % columns,
                (u + 1) % columns,
            ]
            .map(|k| row + k)
            .to_vec()
        })
        .collect();
    let mesh = mesh_of(&positions, &cut(&quads, |_| true));
    let is_inside = |i: usize| (columns as usize..truth.len() - columns as usize).contains(&i);
    for weight in WEIGHTS {
        let (_, most) = errors(&mesh, averaged_by(weight), &truth, is_inside);
        // Polygons around a vertex turn by 1.8° at most, and so does any average of them.
        assert!(most < 1.8, "{weight:?} {most}");
    }
}

#[test]
fn corners_without_an_angle_or_an_edge_do_no_harm() {
    let (positions, mut faces) = cube();
    let expected =
        WEIGHTS.map(|weight| vertex_normals(&mesh_of(&positions, &faces), averaged_by(weight)));
    // Corners that are repeated once or twice: at the beginning, in the middle, and around the end.
    faces[0] = vec![0, 0, 4, 6, 6, 6, 2, 2];
    faces[3] = vec![3, 2, 6, 7, 3];
    let mesh = mesh_of(&positions, &faces);
    for (weight, expected) in WEIGHTS.into_iter().zip(&expected) {
        let normals = vertex_normals(&mesh, averaged_by(weight));
        for (k, &position) in mesh.corners().iter().enumerate() {
            let same = mesh_of(&positions, &cube().1)
                .corners()
                .iter()
                .position(|&p| p == position);
            let off = degrees_between(at(&normals, k), at(expected, same.expect("a corner")));
            assert!(off < ROUNDED.to_degrees(), "{weight:?} {k} {off}");
        }
    }
    // A position on the common edge of two faces, where both are straight and Max's weights vanish;
    // a spike; a path that goes out and back; and a sliver without area.
    let mut positions = positions;
    positions.extend([DVec3::new(1.0, 0.0, 1.0), DVec3::new(3.0, 1.0, 1.0)]);
    let (_, mut faces) = cube();
    faces[1] = vec![1, 3, 7, 8, 5];
    faces[5] = vec![4, 5, 8, 7, 9, 7, 6];
    faces.push(vec![0, 2, 0, 4, 0]);
    faces.push(vec![0, 1, 1]);
    let mesh = mesh_of(&positions, &faces);
    for source in [NormalSource::Averaged, NormalSource::Crease(120.0)] {
        for weight in WEIGHTS {
            let normals = vertex_normals(&mesh, NormalRule { source, weight });
            let of_edge = mesh
                .corners()
                .iter()
                .position(|&p| p == 8)
                .expect("a corner");
            let off = degrees_between(at(&normals, of_edge), DVec3::new(1.0, 0.0, 1.0).normalize());
            assert!(off < ROUNDED.to_degrees(), "{source:?} {weight:?} {off}");
            for normal in &normals.values {
                let length = normal.as_dvec3().length();
                assert!(
                    (length - 1.0).abs() < ROUNDED,
                    "{source:?} {weight:?} {normal}"
                );
            }
        }
    }
}

#[test]
fn a_crease_weighs_only_polygons_within_its_angle() {
    let (positions, faces) = cube();
    let truth: Vec<DVec3> = positions.iter().map(|p| p.normalize()).collect();
    for diagonals in [0, 21, 63] {
        let mesh = mesh_of(&positions, &cut(&faces, |face| diagonals >> face & 1 == 0));
        for weight in [NormalWeight::Angle, NormalWeight::Max] {
            let source = NormalSource::Crease(90.0);
            let (_, most) = errors(&mesh, NormalRule { source, weight }, &truth, |_| true);
            assert!(most < ROUNDED.to_degrees());
            let source = NormalSource::Crease(89.0);
            let sharp = vertex_normals(&mesh, NormalRule { source, weight });
            assert_eq!(sharp.values.len(), 24);
        }
    }
}

#[test]
fn a_sum_that_vanishes_but_for_rounding_has_no_direction() {
    use super::weight::Sum;
    let mut random = Random::new(17);
    let mut side = || f64::from(random.signed());
    for count in [2usize, 10, 1000] {
        let mut terms: Vec<Term> = Vec::new();
        for _ in 0..count / 2 {
            let polygon = DVec3::new(side(), side(), side()).normalize();
            let weight = side().abs() * 1e-30;
            // Both terms are off by some ε.
            for off in [1.0, -1.0 - 8.0 * f64::EPSILON] {
                terms.push(Term {
                    polygon,
                    vector: polygon * (weight * off),
                    weight,
                });
            }
        }
        terms.sort_by(|a, b| a.vector.x.total_cmp(&b.vector.x));
        let sum = |kind, terms: &[Term]| {
            let mut sum = Sum::new(kind);
            terms.iter().for_each(|term| sum.add_term(term));
            sum.direction()
        };
        assert_eq!(sum(NormalWeight::Angle, &terms), None, "{count}");
        // A remainder above the bound does not count as rounding.
        let rest = terms.iter().map(|term| term.weight).sum::<f64>() * 1e-12;
        let (vector, polygon) = (DVec3::Y * rest, DVec3::Y);
        terms.push(Term {
            polygon,
            vector,
            weight: rest,
        });
        let found = sum(NormalWeight::Angle, &terms).expect("a direction");
        assert!(found.y > 0.5, "{count} {found}");
    }
}
