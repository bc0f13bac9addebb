//! Vertex normals by different weights: the diagonal of a square face moves the average (L21 3.1).

use super::prelude::*;
use crate::split_mix::SplitMix;
use core::f64::consts::{PI, TAU};
use fastphong::mesh::newell::newell;
use fastphong::mesh::vertex_normals::{NormalRule, NormalWeight, vertex_normals};
use fastphong::mesh::{GivenNormals, MeshBuilder, PolygonMesh};

pub(super) static FIGURE: Figure = Figure {
    name: "diagonal",
    title: "The diagonal moves the normal",
    lecture: "L21 3.1: the average of the polygons\u{2019} normals",
    parts: &[diagonals, bevels, surfaces],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "The normal at a vertex is the average of the normals of the polygons around it (L21 3.1). But a face that is cut in two counts twice at two of its corners.",
    handles: &[
        Handle::slider(
            ["turned", "faces with the other diagonal", ""],
            [0.0, 6.0],
            1.0,
            1.0,
        ),
        Handle::slider(
            [
                "weight",
                "weight (1 uniform, 2 by area, 3 by angle, 4 by Max)",
                "",
            ],
            [1.0, 4.0],
            1.0,
            1.0,
        ),
    ],
    make: |content, values| {
        let turned = (1 << values[0] as u32) - 1;
        let (weight, name) = WEIGHTS[values[1] as usize - 1];
        let cut = Cube::new(Some(turned))?;
        let whole = Cube::new(None)?;
        let panels = [
            (String::from("six squares"), stored(&whole.lit(weight)?)),
            (
                format!("twelve triangles, {name}"),
                stored(&cut.lit(weight)?),
            ),
        ];
        content.pictures(2, "A cube with averaged normals", panels);
        concludes(
            content,
            "turned",
            name,
            cut.off(weight),
            levels(&whole.lit(weight)?, &cut.lit(weight)?),
        );
        Ok(())
    },
};

/// The weights and their names.
const WEIGHTS: [(NormalWeight, &str); 4] = [
    (NormalWeight::Uniform, "uniform"),
    (NormalWeight::Area, "by area"),
    (NormalWeight::Angle, "by angle"),
    (NormalWeight::Max, "by Max\u{2019}s weights"),
];

/// The largest angle in degrees that counts as rounding: normals are stored in `f32`.
const ROUNDING: f64 = 1e-5;

/// A cube. By symmetry its normals lie along its diagonals.
struct Cube(PolygonMesh);

impl Cube {
    /// Makes a cube of squares, or with `turned` of triangles. Their diagonals join every second
    /// vertex of the cube, except on the faces whose bits are set in `turned`, which have the other
    /// diagonal.
    fn new(turned: Option<u32>) -> Result<Cube> {
        let side = |bit: u32| if bit & 1 == 0 { -1.0 } else { 1.0 };
        let positions = (0..8).map(|i| DVec3::new(side(i), side(i >> 1), side(i >> 2)));
        // The faces that the camera sees come first. The first corner of each has an even count of
        // bits, so that the diagonals from there join every second vertex.
        let faces = [
            [5, 1, 3, 7],
            [3, 2, 6, 7],
            [6, 4, 5, 7],
            [0, 4, 6, 2],
            [0, 1, 5, 4],
            [0, 2, 3, 1],
        ];
        let mut polygons: Vec<Vec<u32>> = Vec::new();
        for (face, [a, b, c, d]) in faces.into_iter().enumerate() {
            match turned.map(|bits| bits >> face & 1) {
                None => polygons.push(vec![a, b, c, d]),
                Some(0) => polygons.extend([vec![a, b, c], vec![a, c, d]]),
                Some(_) => polygons.extend([vec![b, c, d], vec![b, d, a]]),
            }
        }
        Ok(Cube(mesh(&positions.collect::<Vec<_>>(), None, &polygons)?))
    }

    /// Draws it by naive Phong.
    fn lit(&self, weight: NormalWeight) -> Result<LinearPicture> {
        lit(&self.0, averaged(weight))
    }

    /// Returns the largest angle between a normal and its diagonal, in degrees.
    fn off(&self, weight: NormalWeight) -> f64 {
        let normals = vertex_normals(&self.0, averaged(weight));
        let corners = self.0.corners().iter().zip(&normals.corners);
        largest(corners.map(|(&corner, &normal)| {
            let diagonal = self.0.positions()[corner as usize].as_dvec3().normalize();
            angle(
                normals.values[normal as usize].as_dvec3().normalize(),
                diagonal,
            )
        }))
    }
}

/// Averages normals with this weight.
fn averaged(weight: NormalWeight) -> NormalRule {
    let source = NormalSource::Averaged;
    NormalRule { source, weight }
}

/// Makes a mesh, with a normal for each position if there are `normals`.
fn mesh(
    positions: &[DVec3],
    normals: Option<&[DVec3]>,
    polygons: &[Vec<u32>],
) -> Result<PolygonMesh> {
    let mut builder = MeshBuilder::new(positions.iter().map(|p| p.as_vec3()).collect());
    polygons.iter().for_each(|polygon| {
        builder.polygon(polygon);
    });
    if let Some(normals) = normals {
        builder.normals(GivenNormals {
            values: normals.iter().map(|n| n.as_vec3()).collect(),
            corners: None,
        });
    }
    Ok(builder.finish()?)
}

/// Draws a mesh in grey by naive Phong, through a camera that fits it.
fn lit(mesh: &PolygonMesh, normals: NormalRule) -> Result<LinearPicture> {
    let mut scene = Scene::of_mesh(mesh.clone());
    (scene.width, scene.height) = (112, 112);
    scene.objects[0].normals = normals;
    scene.objects[0].material = Some(grey(0.1, 0.6, 0.3, 32.0));
    draw(&scene.frame()?, "naive-phong")
}

/// Adds the findings of a weight: the largest angle, in degrees, and the largest difference, in
/// grey levels, that diagonals make.
fn concludes(content: &mut FigureContent, key: &str, name: &str, off: f64, levels: f64) {
    let moves = off > ROUNDING;
    content.adds(
        &format!("{key} | normals of a cube that is cut, {name}: largest angle from its diagonals"),
        (off, "degrees", true),
        if moves {
            "The diagonals move the normals: the same solid is lit differently."
        } else {
            "Here the diagonals do not matter."
        },
    );
    content.adds(
        &format!("{key}-levels | picture of a cube that is cut, {name}: largest difference from six squares"),
        (levels, "levels", true),
        if levels > 0.5 { "You can see it." } else { "You cannot see it." },
    );
}

/// Shows a cube whole and cut, and tries all 64 ways to cut it.
fn diagonals(content: &mut FigureContent) -> Result {
    content.text(
        "Each corner of a cube has three squares around it, and by symmetry its normal lies along the cube\u{2019}s diagonal. When \
         the squares are cut into triangles, a square counts once or twice at a corner, depending on its own diagonal. Weights by \
         angle always count the square\u{2019}s right angle, however it is cut.",
    );
    let whole = Cube::new(None)?;
    let one = Cube::new(Some(1))?;
    let mut panels = vec![(
        String::from("six squares, any weight"),
        stored(&whole.lit(NormalWeight::Uniform)?),
    )];
    let mut rows = Vec::new();
    for (weight, name) in WEIGHTS {
        let (of_whole, picture) = (whole.lit(weight)?, one.lit(weight)?);
        let all = (0..64)
            .map(|turned| Ok(Cube::new(Some(turned))?.off(weight)))
            .collect::<Result<Vec<f64>>>()?;
        let worst = largest(all.iter().copied());
        let exact = all.iter().filter(|off| **off < ROUNDING).count();
        let seen = levels(&of_whole, &picture);
        let cells = [written(worst), format!("{exact}"), written(seen)].join(" | ");
        rows.push(format!("{name} | {cells}"));
        panels.push((format!("cut, {name}"), stored(&picture)));
        let key = ["uniform", "area", "angle", "max"][weight as usize];
        concludes(content, key, name, worst, seen);
    }
    content.pictures(
        5,
        "A cube with averaged normals, one face cut along its other diagonal",
        panels,
    );
    content.table(
        "weight | largest angle over all 64 ways to cut, degrees | ways without an error | one face cut the other way: levels, at most",
        rows,
    );
    Ok(())
}

/// A surface whose normals are known: points on it, their normals, and quads between them.
struct Surface {
    positions: Vec<DVec3>,
    normals: Vec<DVec3>,
    polygons: Vec<Vec<u32>>,
}

impl Surface {
    /// Makes a torus with radii 1 and 0.4 of `count` by `count` quads. The smaller radius swells
    /// and shrinks by `wave`. Each point moves along the surface by up to `moved` cells at random.
    fn torus(count: u32, wave: f64, moved: f64) -> Surface {
        let mut random = SplitMix(21);
        let mut off = || moved * (2.0 * (random.next() >> 11) as f64 / (1u64 << 53) as f64 - 1.0);
        // Returns a point and its normal, the cross product of the derivatives by u and v.
        let at = |i: u32| {
            let [u, v] =
                [i / count, i % count].map(|k| TAU * (f64::from(k) + off()) / f64::from(count));
            let ((sin_u, cos_u), (sin_v, cos_v)) = (libm::sincos(u), libm::sincos(v));
            let (wave_sin, wave_cos) = libm::sincos(3.0 * u);
            let (radius, slope) = (0.4 + wave * wave_sin, 3.0 * wave * wave_cos);
            let (out, along) = (
                DVec3::new(cos_u, sin_u, 0.0),
                DVec3::new(-sin_u, cos_u, 0.0),
            );
            let tube = cos_v * out + sin_v * DVec3::Z;
            let by_u = along * (1.0 + radius * cos_v) + slope * tube;
            let by_v = radius * (cos_v * DVec3::Z - sin_v * out);
            (out + radius * tube, by_u.cross(by_v).normalize())
        };
        let (positions, normals) = (0..count * count).map(at).unzip();
        let index = |u: u32, v: u32| u % count * count + v % count;
        let quads = (0..count * count).map(|i| {
            let (u, v) = (i / count, i % count);
            vec![
                index(u, v),
                index(u + 1, v),
                index(u + 1, v + 1),
                index(u, v + 1),
            ]
        });
        Surface {
            positions,
            normals,
            polygons: quads.collect(),
        }
    }

    /// Makes a unit sphere with `count` meridians, whose caps are triangles.
    fn sphere(count: u32) -> Surface {
        let rings = count / 2;
        let at = |i: u32| {
            let (sin, cos) = libm::sincos(PI * f64::from(i / count + 1) / f64::from(rings));
            let (sin_u, cos_u) = libm::sincos(TAU * f64::from(i % count) / f64::from(count));
            DVec3::new(sin * cos_u, cos, -sin * sin_u)
        };
        let grid = (rings - 1) * count;
        let mut positions: Vec<DVec3> = (0..grid).map(at).collect();
        positions.extend([DVec3::Y, -DVec3::Y]);
        let quads = (0..grid - count).map(|i| {
            let (row, u) = (i / count * count, i % count);
            let next = (u + 1) % count;
            [u, u + count, next + count, next].map(|k| row + k).to_vec()
        });
        let caps = (0..count).flat_map(|u| {
            let (next, last) = ((u + 1) % count, grid - count);
            [vec![grid, u, next], vec![grid + 1, last + next, last + u]]
        });
        let polygons = quads.chain(caps).collect();
        let normals = positions.clone();
        Surface {
            positions,
            normals,
            polygons,
        }
    }

    /// Makes a cube whose edges are cut off by strips. Its normals belong to a rounded cube whose
    /// faces are flat up to the strips.
    fn bevelled() -> Surface {
        const INNER: f64 = 0.85;
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let sign = |bit: usize| if bit & 1 == 0 { -1.0 } else { 1.0 };
        // Each corner of the cube becomes three vertices: vertex 3i + k of corner i lies on the
        // face across axis k.
        let corner = |i: usize| DVec3::new(sign(i), sign(i >> 1), sign(i >> 2));
        let normals: Vec<DVec3> = (0..24).map(|n| corner(n / 3) * axes[n % 3]).collect();
        let positions: Vec<DVec3> = (0..24)
            .map(|n| INNER * corner(n / 3) + (1.0 - INNER) * normals[n])
            .collect();
        let mut polygons: Vec<Vec<u32>> =
            (0..8).map(|i| vec![3 * i, 3 * i + 1, 3 * i + 2]).collect();
        for k in 0..3 {
            let [u, w] = [(k + 1) % 3, (k + 2) % 3].map(|axis| 1 << axis);
            for side in [0, 1 << k] {
                polygons.push(
                    [0, u, u | w, w]
                        .map(|i| (3 * (side | i) + k) as u32)
                        .to_vec(),
                );
            }
            // Strips along axis k, between the faces across the two other axes.
            for i in [0, u, w, u | w] {
                let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                let far = i | 1 << k;
                polygons.push(
                    [3 * i + a, 3 * far + a, 3 * far + b, 3 * i + b]
                        .map(|n| n as u32)
                        .to_vec(),
                );
            }
        }
        // All polygons shall face outward.
        for polygon in &mut polygons {
            let at = polygon.iter().map(|&i| positions[i as usize]);
            if newell(at).dot(positions[polygon[0] as usize]) < 0.0 {
                polygon.reverse();
            }
        }
        Surface {
            positions,
            normals,
            polygons,
        }
    }

    /// Cuts its quads into triangles, all along the same diagonal or each along one chosen at
    /// random.
    fn cut(mut self, at_random: bool) -> Surface {
        let mut random = SplitMix(45);
        let mut triangles = Vec::new();
        for polygon in self.polygons {
            match polygon[..] {
                [a, b, c, d] if at_random && random.next() >> 63 == 1 => {
                    triangles.extend([vec![b, c, d], vec![b, d, a]]);
                }
                [a, b, c, d] => triangles.extend([vec![a, b, c], vec![a, c, d]]),
                _ => triangles.push(polygon),
            }
        }
        self.polygons = triangles;
        self
    }

    /// Returns three errors for each weight: the RMS error of normals in degrees, and the RMS and
    /// the largest error of the picture in grey levels.
    fn errors(&self) -> Result<[[f64; 3]; 4]> {
        let mesh = mesh(&self.positions, Some(&self.normals), &self.polygons)?;
        let truth = lit(&mesh, NormalSource::Given.into())?;
        let mut errors = [[0.0; 3]; 4];
        for ((weight, _), errors) in WEIGHTS.into_iter().zip(&mut errors) {
            let normals = vertex_normals(&mesh, averaged(weight));
            let corners = mesh.corners().iter().zip(&normals.corners);
            let squares = corners.map(|(&corner, &normal)| {
                let found = normals.values[normal as usize].as_dvec3().normalize();
                let off = angle(found, self.normals[corner as usize]);
                off * off
            });
            let mean = squares.sum::<f64>() / mesh.corners().len().max(1) as f64;
            let difference = compare(&truth, &lit(&mesh, averaged(weight))?)?;
            *errors = [
                libm::sqrt(mean),
                255.0 * difference.rms,
                255.0 * difference.max,
            ];
        }
        Ok(errors)
    }
}

/// Shows how short edges pull normals.
fn bevels(content: &mut FigureContent) -> Result {
    let surface = Surface::bevelled();
    let mesh = mesh(
        &surface.positions,
        Some(&surface.normals),
        &surface.polygons,
    )?;
    let own = stored(&lit(&mesh, NormalSource::Given.into())?);
    let mut panels = vec![(String::from("normals of the faces"), own)];
    for (weight, name) in WEIGHTS {
        let picture = stored(&lit(&mesh, averaged(weight))?);
        panels.push((String::from(name), picture));
    }
    content.pictures(5, "A cube whose edges are cut off", panels);
    let [_, [area, _, _], [angle, _, _], [max, _, _]] = surface.errors()?;
    content.adds(
        "bevelled | cube with edges cut off: RMS error of normals by angle",
        (angle, "degrees", area < angle && angle < max),
        "Weights by area keep its large faces flatter. Max\u{2019}s weights bend them more, because short edges pull the normals.",
    );
    Ok(())
}

/// How far points move at random, in cells. Quads stay convex up to a quarter.
const MOVED: f64 = 0.2;

/// How many quads go around, and the degrees between their neighbouring normals.
const TURNS: [(u32, f64); 3] = [(72, 5.0), (24, 15.0), (12, 30.0)];

/// Measures normals and pictures of surfaces whose normals are known.
fn surfaces(content: &mut FigureContent) -> Result {
    type Case = (&'static str, fn(u32) -> Surface);
    let cases: [Case; 9] = [
        ("sphere, quads", Surface::sphere),
        ("sphere, cut alike", |n| Surface::sphere(n).cut(false)),
        ("sphere, cut at random", |n| Surface::sphere(n).cut(true)),
        ("torus, quads", |n| Surface::torus(n, 0.0, 0.0)),
        ("torus, cut at random", |n| {
            Surface::torus(n, 0.0, 0.0).cut(true)
        }),
        ("torus, points and cuts at random", |n| {
            Surface::torus(n, 0.0, MOVED).cut(true)
        }),
        ("wavy torus, quads that are not flat", |n| {
            Surface::torus(n, 0.1, 0.0)
        }),
        ("wavy torus, cut at random", |n| {
            Surface::torus(n, 0.1, 0.0).cut(true)
        }),
        ("wavy torus, points and cuts at random", |n| {
            Surface::torus(n, 0.1, MOVED).cut(true)
        }),
    ];
    let mut rows = Vec::new();
    let mut means = [[0.0; 4]; TURNS.len()];
    let mut of_spheres: f64 = 0.0;
    for ((count, degrees), means) in TURNS.into_iter().zip(&mut means) {
        for (name, surface) in cases {
            let errors = surface(count).errors()?;
            if name.starts_with("sphere") {
                of_spheres = of_spheres.max(errors[3][0]);
            }
            for (mean, [_, rms, _]) in means.iter_mut().zip(errors) {
                *mean += rms / cases.len() as f64;
            }
            rows.push(format!("{degrees} | {name} | {}", cells(errors)));
        }
    }
    let bevelled = cells(Surface::bevelled().errors()?);
    rows.push(format!("90 | cube with edges cut off | {bevelled}"));
    content.text(
        "The exact normals of these surfaces are known, so that averaged normals and their pictures can be compared with exact ones. \
         Each cell has the RMS error of the normals in degrees, then the RMS error of the picture in levels, and the largest in \
         brackets. Cut alike means that all quads are cut along the same diagonal. The faces of the cube are flat up to strips, whose \
         width is 15 % of the cube\u{2019}s.",
    );
    content.table(
        "degrees | surface | uniform | by area | by angle | by Max\u{2019}s weights",
        rows,
    );
    let curves = WEIGHTS.iter().enumerate().map(|(i, (_, name))| {
        Series::new(
            *name,
            TURNS
                .iter()
                .zip(&means)
                .map(|((_, degrees), mean)| (*degrees, mean[i])),
        )
    });
    content.plot(Plot::new(
        "Mean error of pictures by the weight of normals",
        [
            log("degrees between neighbouring normals"),
            log("levels, RMS"),
        ],
        curves,
        "The mean over the nine smooth surfaces of the table.",
    ));
    content.adds(
        "spheres | normals of spheres, cut in any way, by Max\u{2019}s weights: largest RMS error",
        (of_spheres, "degrees", of_spheres < 1e-3),
        "They are exact, apart from the rounding of positions.",
    );
    let [_, [uniform, _, by_angle, max], _] = means;
    content.adds(
        "smooth | smooth surfaces at 15°: mean RMS error of pictures with uniform weights",
        (uniform, "levels", by_angle < uniform),
        "Weights by angle are closer, because diagonals do not change them.",
    );
    content.adds(
        "smooth-angle | smooth surfaces at 15°: mean RMS error of pictures with weights by angle",
        (by_angle, "levels", max < by_angle),
        "Closer than uniform weights at 15°. Max\u{2019}s weights are closer still on surfaces this smooth.",
    );
    Ok(())
}

/// Writes the errors of the weights as the cells of a row.
fn cells(errors: [[f64; 3]; 4]) -> String {
    let cell = |[degrees, rms, most]: [f64; 3]| format!("{degrees:.2}° · {rms:.2} ({most:.0})");
    errors.map(cell).join(" | ")
}
