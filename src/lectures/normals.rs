//! Averaged vertex normals against those of the surface, and the length of interpolated ones (L5; L21 3.1).

use super::lit::{drawn, grey, scene, shown};
use super::stage::written;
use super::{Content, Figure, FigureError, Plot, Scale, Series};
use crate::mesh::builtin::builtin;
use crate::mesh::vertex_normals::NormalSource;
use crate::number::vec3;
use crate::scene::Scene;
use crate::shading::Walk;
use crate::shading::increments::Quadratic;
use alloc::format;
use alloc::string::ToString;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "normals",
    title: "Vertex normals: where they come from, and how long they are in between",
    lecture: "L5, Defining per-vertex and per-pixel normal vectors; L21 3.1",
    make,
};

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    sources(&mut content)?;
    lengths(&mut content)?;
    Ok(content)
}

/// The largest and the mean angle between averaged and given normals, in degrees, over all corners.
fn angles(spec: &str) -> Result<(f64, f64, usize), FigureError> {
    let of = |source: NormalSource| -> Result<Vec<DVec3>, FigureError> {
        let mut scene = Scene::of_mesh(builtin(spec)?);
        scene.culling = crate::scene::Culling::None;
        scene
            .objects
            .iter_mut()
            .for_each(|object| object.normals = source);
        let frame = scene.frame()?;
        let normal = |v: &u32| DVec3::from_array(frame.normal(*v).map(f64::from));
        Ok(frame
            .polygons()
            .iter()
            .flat_map(|polygon| frame.corners(polygon))
            .map(normal)
            .collect())
    };
    let (averaged, given) = (of(NormalSource::Averaged)?, of(NormalSource::Given)?);
    let angle = |(a, b): (&DVec3, &DVec3)| {
        2.0 * libm::atan2((*a - *b).length(), (*a + *b).length()).to_degrees()
    };
    let all: Vec<f64> = averaged.iter().zip(&given).map(angle).collect();
    let most = all.iter().copied().fold(0.0, f64::max);
    Ok((
        most,
        all.iter().sum::<f64>() / all.len().max(1) as f64,
        Scene::of_mesh(builtin(spec)?).objects[0]
            .mesh
            .polygon_count(),
    ))
}

/// L5: "best to get vertex normals from the underlying geometry".
fn sources(content: &mut Content) -> Result<(), FigureError> {
    let families: [(&str, [&str; 3]); 3] = [
        (
            "sphere",
            [
                "sphere?rings=6&segments=12",
                "sphere?rings=12&segments=24",
                "sphere?rings=24&segments=48",
            ],
        ),
        (
            "torus",
            [
                "torus?segments=12&sides=8",
                "torus?segments=24&sides=16",
                "torus?segments=48&sides=32",
            ],
        ),
        ("teapot", ["teapot?res=2", "teapot?res=4", "teapot?res=8"]),
    ];
    let (mut rows, mut curves) = (Vec::new(), Vec::new());
    let mut means = Vec::new();
    for (name, specs) in families {
        let mut points = Vec::new();
        for spec in specs {
            let (most, mean, polygons) = angles(spec)?;
            rows.push(vec![
                name.to_string(),
                polygons.to_string(),
                written(most),
                written(mean),
            ]);
            points.push((polygons as f64, mean));
        }
        means.push(points.iter().map(|p| p.1).collect::<Vec<_>>());
        curves.push(Series::new(name, points));
    }
    content.text("The angle between a vertex normal averaged over the polygons around it (3.1) and the normal of the surface there.");
    content.table(
        &["surface", "polygons", "largest, degrees", "mean, degrees"],
        rows,
    );
    content.plot(Plot {
        title: "Averaged normals: mean angle from the normals of the surface".into(),
        x: ("polygons".into(), Scale::Log),
        y: ("degrees".into(), Scale::Log),
        series: curves,
        marks: Vec::new(),
        caption: "Finer meshes have better averages.".into(),
    });
    let falls = means
        .iter()
        .all(|of| of.windows(2).all(|pair| pair[1] < pair[0]));
    content.claim("averaged", "mean angle of averaged normals, teapot of fewest polygons", (means[2][0], "degrees"), means[2][0] > 1.0, ["Averages are not the normals of the surface, which are best taken where they are known.", "Averages are the normals of the surface."]);
    content.adds(
        "regular",
        "mean angle of averaged normals, torus of fewest polygons",
        (means[1][0], "degrees"),
        if means[1][0] < 1.0 {
            "Polygons that lie evenly around a vertex make good averages, however large they are."
        } else {
            "Even polygons that lie evenly around a vertex make bad averages."
        },
    );
    content.adds("finer", "mean angle of the coarsest teapot over that of the finest, which has cells of a quarter of the size", (means[2][0] / means[2][2], ""), if falls {
            "Of each surface the finer mesh has the better averages."
        } else {
            "Not every finer mesh has better averages."
        });
    Ok(())
}

/// The squared length of the normal between two that enclose `degrees`, as Duff's forward differences step it.
fn squares(degrees: f64, pixels: usize) -> Vec<f64> {
    let (sin, cos) = libm::sincos(degrees.to_radians() / 2.0);
    let (from, to) = (
        [-sin as f32, 0.0, cos as f32],
        [sin as f32, 0.0, cos as f32],
    );
    let step = [0, 1, 2].map(|i: usize| (to[i] - from[i]) / pixels as f32);
    let mut walk = Quadratic::square(vec3(from), vec3(step));
    (0..=pixels).map(|_| f64::from(walk.next())).collect()
}

/// L5: "Problem: length of vectors?"
fn lengths(content: &mut Content) -> Result<(), FigureError> {
    const PIXELS: usize = 64;
    let angles = [30.0, 60.0, 90.0, 120.0];
    let mut worst: f64 = 0.0;
    let curves = angles.map(|degrees| {
        let lengths: Vec<f64> = squares(degrees, PIXELS)
            .into_iter()
            .map(libm::sqrt)
            .collect();
        worst = worst.max((lengths[PIXELS / 2] - libm::cos(degrees.to_radians() / 2.0)).abs());
        let points = lengths
            .iter()
            .enumerate()
            .step_by(2)
            .map(|(k, l)| (k as f64 / PIXELS as f64, *l));
        Series::new(format!("{degrees}° between the ends"), points)
    });
    content.plot(Plot {
        title: "Length of the interpolated normal along a span".into(),
        x: ("part of the span".into(), Scale::Linear),
        y: ("length".into(), Scale::Linear),
        series: curves.into(),
        marks: vec![0.5],
        caption: "The sum of two unit vectors is shortest in the middle: cos(φ/2).".into(),
    });
    // 32 steps of D by three half units of 2⁻²⁴ each, and a root of at least a half: see `Quadratic`.
    let holds = worst < 1e-5;
    content.adds(
        "half-way",
        "length half-way between two normals, largest distance from cos(φ/2)",
        (worst, ""),
        if holds {
            "cos(φ/2), to rounding: between normals 120° apart half of the length is left."
        } else {
            "Not cos(φ/2)."
        },
    );
    darkened(content)
}

/// Gouraud's method on a dull surface is the light of normals that are not normalised: L·N is linear in N.
fn darkened(content: &mut Content) -> Result<(), FigureError> {
    let mesh = builtin("sphere?rings=6&segments=8")?;
    let dull = scene(
        mesh,
        grey(0.0, 1.0, 0.0, 1.0),
        DVec3::new(-0.3, 0.4, 0.9),
        1.1,
        [112, 112],
    );
    let (shortened, unit) = (drawn(&dull, "gouraud")?, drawn(&dull, "naive-phong")?);
    content.text("On a dull surface Gouraud's method shows what normals do that are not normalised: L·N is linear in N, so that interpolating it is interpolating N and leaving its length.");
    let what = "A coarse sphere, interpolated normals";
    content.pictures(
        2,
        [
            shown(what, "as they are", &shortened),
            shown(what, "normalised", &unit),
        ]
        .into(),
    );
    // Where the light is in front of all corners of a polygon no clamp interferes; elsewhere Gouraud's clamp brightens.
    let lit = shortened
        .texels()
        .iter()
        .zip(unit.texels())
        .filter(|(a, b)| a[3] > 0.0 && b[0] > 0.5);
    let largest = lit
        .map(|(a, b)| f64::from(1.0 - a[0] / b[0]))
        .fold(0.0, f64::max);
    let visible = largest > 0.01;
    content.claim(
        "darkened",
        "largest part of the light that is lost without normalising",
        (100.0 * largest, "%"),
        visible,
        [
            "The length of vectors is a problem: the middle of each polygon is dark.",
            "The length of vectors is no problem here.",
        ],
    );
    Ok(())
}
