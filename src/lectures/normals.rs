//! Averaged vertex normals against those of the surface, and the length of interpolated ones (L5;
//! L21 3.1).

use super::prelude::*;
use crate::mesh::builtin::builtin;
use crate::scene::Culling;
use crate::shading::walks::Quadratic;

pub(super) static FIGURE: Figure = Figure {
    name: "normals",
    title: "Vertex normals: where they come from, and how long they are in between",
    lecture: "L5, Defining per-vertex and per-pixel normal vectors; L21 3.1",
    parts: &[sources, lengths, darkened],
    live: None,
};

/// Returns the number of polygons of a mesh, and the angles between its averaged and its given
/// normals, in degrees, over all corners.
fn angles(spec: &str) -> Result<(usize, Vec<f64>)> {
    let by = |source: NormalSource| -> Result<Frame> {
        let mut scene = Scene::of_mesh(builtin(spec)?);
        scene.culling = Culling::None;
        scene.objects[0].normals = source.into();
        Ok(scene.frame()?)
    };
    let (averaged, given) = (by(NormalSource::Averaged)?, by(NormalSource::Given)?);
    let normal = |frame: &Frame, v: u32| DVec3::from_array(frame.normal(v).map(f64::from));
    let corners = |frame| Frame::polygons(frame).iter().flat_map(|p| frame.corners(p));
    let pairs = corners(&averaged).zip(corners(&given));
    let angles = pairs.map(|(a, b)| angle(normal(&averaged, *a), normal(&given, *b)));
    Ok((builtin(spec)?.polygon_count(), angles.collect()))
}

/// Compares averaged normals with given ones (L5: "best to get vertex normals from the underlying
/// geometry").
fn sources(content: &mut FigureContent) -> Result {
    let (mut rows, mut curves, mut means) = (Vec::new(), Vec::new(), Vec::new());
    let spheres = [6, 12, 24].map(|n| format!("sphere?rings={n}&segments={}", 2 * n));
    let tori = [4, 8, 16].map(|n| format!("torus?segments={}&sides={}", 3 * n, 2 * n));
    let teapots = [2, 4, 8].map(|n| format!("teapot?res={n}"));
    for (name, specs) in [("sphere", spheres), ("torus", tori), ("teapot", teapots)] {
        let mut points = Vec::new();
        for spec in specs {
            let (polygons, angles) = angles(&spec)?;
            let mean = angles.iter().sum::<f64>() / angles.len().max(1) as f64;
            points.push((polygons as f64, mean));
            let [most, mean] = [largest(angles), mean].map(written);
            rows.push(format!("{name} | {polygons} | {most} | {mean}"));
        }
        means.push([0, 1, 2].map(|i| points[i].1));
        curves.push(Series::new(name, points));
    }
    content.text(
        "The angle between an averaged vertex normal (3.1) and the normal of the surface there.",
    );
    content.table(
        "surface | polygons | largest, degrees | mean, degrees",
        rows,
    );
    content.plot(Plot::new(
        "Averaged normals: mean angle from the normals of the surface",
        [log("polygons"), log("degrees")],
        curves,
        "Finer meshes have better averages.",
    ));
    let [_, [torus, ..], [coarse, _, fine]] = means[..] else {
        return Ok(());
    };
    content.confirms(
        "averaged | mean angle of averaged normals, teapot of fewest polygons",
        (coarse, "degrees", coarse > 1.0),
        "Averages are not the normals of the surface: take those where they are known.",
    );
    content.adds(
        "regular | mean angle of averaged normals, torus of fewest polygons",
        (torus, "degrees", torus < 1.0),
        "Polygons that lie evenly around a vertex make good averages, however large they are.",
    );
    let falls = means.iter().all(|means| means.is_sorted_by(|a, b| a > b));
    content.adds(
        "finer | mean angle of the coarsest teapot over that of the finest, with cells a quarter \
         the size",
        (coarse / fine, "", falls),
        "Of each surface the finer mesh has the better averages.",
    );
    Ok(())
}

/// Measures the length of interpolated normals (L5: "Problem: length of vectors?"), as Duff's
/// forward differences step it.
fn lengths(content: &mut FigureContent) -> Result {
    const PIXELS: usize = 64;
    let mut worst: f64 = 0.0;
    let curves = [30.0, 60.0, 90.0, 120.0].map(|degrees: f64| {
        let [from, to] = ends(degrees).map(|n| n.as_vec3().to_array());
        let step = [0, 1, 2].map(|i: usize| (to[i] - from[i]) / PIXELS as f32);
        let mut walk = Quadratic::square(vec3(from), vec3(step));
        let lengths: Vec<f64> = (0..=PIXELS)
            .map(|_| libm::sqrt(walk.next().into()))
            .collect();
        worst = worst.max((lengths[PIXELS / 2] - libm::cos(degrees.to_radians() / 2.0)).abs());
        let shown = (0..=PIXELS).step_by(2);
        let points = shown.map(|k| (k as f64 / PIXELS as f64, lengths[k]));
        Series::new(format!("{degrees}° between the ends"), points)
    });
    let plot = Plot::new(
        "Length of the interpolated normal along a span",
        [linear("part of the span"), linear("length")],
        curves,
        "The sum of two unit vectors is shortest in the middle: cos(φ/2).",
    );
    content.plot(plot.marked([0.5]));
    // 32 steps of D by three half units of 2⁻²⁴ each, and a root of at least a half: see
    // `Quadratic`.
    content.adds(
        "half-way | length half-way between two normals, largest distance from cos(φ/2)",
        (worst, "", worst < 1e-5),
        "cos(φ/2), to rounding: between normals 120° apart half of the length is left.",
    );
    Ok(())
}

/// Shades by normals that are not normalised: by Gouraud's method on a dull surface, as L·N is
/// linear in N.
fn darkened(content: &mut FigureContent) -> Result {
    let light = DVec3::new(-0.3, 0.4, 0.9);
    let dull = scene("sphere?rings=6&segments=8", DULL, light, 1.1, [112, 112])?;
    let [shortened, unit] = draw_each(&dull.frame()?, ["gouraud", "naive-phong"])?;
    content.text(
        "Gouraud's method on a dull surface shows normals that are not normalised, as L·N is \
         linear in N.",
    );
    content.row(
        "A coarse sphere, interpolated normals",
        "as they are | normalised",
        [&shortened, &unit].map(stored),
    );
    // Where the light is in front of all corners of a polygon no clamp interferes; elsewhere
    // Gouraud's clamp brightens.
    let lit = covered_by_both(&shortened, &unit).filter(|(_, unit)| unit[0] > 0.5);
    let lost = largest(lit.map(|(shortened, unit)| f64::from(1.0 - shortened[0] / unit[0])));
    content.confirms(
        "darkened | largest part of the light that is lost without normalising",
        (100.0 * lost, "%", lost > 0.01),
        "The length of vectors is a problem: the middle of each polygon is dark.",
    );
    Ok(())
}
