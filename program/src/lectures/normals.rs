//! Averaged vertex normals compared with the surface's own, and the length of interpolated normals
//! (L5; L21 3.1).

use super::prelude::*;
use fastphong::mesh::builtin::builtin;
use fastphong::scene::Culling;
use fastphong::shading::walks::Quadratic;

pub(super) static FIGURE: Figure = Figure {
    name: "normals",
    title: "Vertex normals: where they come from, and how long they are in between",
    lecture: "L5, Defining per-vertex and per-pixel normal vectors; L21 3.1",
    parts: &[sources, lengths, darkened],
    live: None,
};

/// Returns how many polygons a mesh has, and the angle in degrees between the averaged and the
/// given normal at each of their corners.
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
        "The angle between an averaged vertex normal (3.1) and the surface's normal at the same point.",
    );
    content.table(
        "surface | polygons | largest, degrees | mean, degrees",
        rows,
    );
    content.plot(Plot::new(
        "Averaged normals: mean angle from the normals of the surface",
        [log("polygons"), log("degrees")],
        curves,
        "On finer meshes the averages are better.",
    ));
    let [_, [torus, ..], [coarse, _, fine]] = means[..] else {
        return Ok(());
    };
    content.confirms(
        "averaged | mean angle of averaged normals, coarsest teapot",
        (coarse, "degrees", coarse > 1.0),
        "Averages are not the normals of the surface. Use the surface's own where they are known.",
    );
    content.adds(
        "regular | mean angle of averaged normals, coarsest torus",
        (torus, "degrees", torus < 1.0),
        "Where polygons lie evenly around a vertex the average is good, however large they are.",
    );
    let falls = means.iter().all(|means| means.is_sorted_by(|a, b| a > b));
    content.adds(
        "finer | mean angle of averaged normals, coarsest teapot over the finest, whose cells are a \
         quarter the size",
        (coarse / fine, "", falls),
        "On each of the three surfaces the finer mesh has the better averages.",
    );
    Ok(())
}

/// Measures the length of interpolated normals (L5: "Problem: length of vectors?") with Duff's
/// forward differences.
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
        "An interpolated normal is shortest in the middle, where its length is cos(φ/2).",
    );
    content.plot(plot.marked([0.5]));
    // Each of the 32 steps of D adds three half units of 2⁻²⁴, and the root is at least a half: see
    // `Quadratic`.
    content.adds(
        "half-way | length half-way between two normals, largest difference from cos(φ/2)",
        (worst, "", worst < 1e-5),
        "It is cos(φ/2), apart from rounding: half-way between normals 120° apart, half of the length is \
         left.",
    );
    Ok(())
}

/// Shades with normals that are not normalised. Gouraud's method does this on a dull surface,
/// because L·N is linear in N.
fn darkened(content: &mut FigureContent) -> Result {
    let light = DVec3::new(-0.3, 0.4, 0.9);
    let dull = scene("sphere?rings=6&segments=8", DULL, light, 1.1, [112, 112])?;
    let [shortened, unit] = draw_each(&dull.frame()?, ["gouraud", "naive-phong"])?;
    content.text(
        "On a dull surface, Gouraud's method draws the same picture as normals that nobody normalises, \
         because L·N is linear in N.",
    );
    content.row(
        "A coarse sphere, interpolated normals",
        "not normalised | normalised",
        [&shortened, &unit].map(stored),
    );
    // Compare only where the light is in front of all corners of a polygon. Elsewhere Gouraud
    // clamps dark corners, which brightens the polygon.
    let lit = covered_by_both(&shortened, &unit).filter(|(_, unit)| unit[0] > 0.5);
    let lost = largest(lit.map(|(shortened, unit)| f64::from(1.0 - shortened[0] / unit[0])));
    content.confirms(
        "darkened | largest part of the light lost without normalising",
        (100.0 * lost, "%", lost > 0.01),
        "The length of vectors is a problem indeed: the middle of each polygon is darker.",
    );
    Ok(())
}
