//! L and V constant along each polygon, as the lecture assumes, compared with L and V of each pixel
//! (L21 1; Duff 1979).

use super::prelude::*;
use alloc::string::ToString;
use fastphong::number::Counts;
use fastphong::shading::{OperationCounts, SpanBench};

pub(super) static FIGURE: Figure = Figure {
    name: "constant-vectors",
    title: "L and V constant along a polygon, and the error it makes",
    lecture: "L21 1, L21 4.3",
    parts: &[pictures, errors, products],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "L and V are constant along a polygon, so J = L·N and K = V·N cost additions only, and L·V nothing (L21 1; 4.3).",
    handles: &[
        Handle::slider(
            ["distance", "distance of the light, in radii", ""],
            [0.25, 16.0],
            0.25,
            0.25,
        ),
        Handle::slider(
            ["rings", "bands from pole to pole", ""],
            [6.0, 48.0],
            2.0,
            12.0,
        ),
    ],
    make: |content, values| {
        let (distance, rings) = (values[0], values[1] as u32);
        let frame = sphere(rings, distance)?.frame()?;
        compared(content, &frame)?;
        let fast = draw(&frame, "fast-phong")?;
        let rms = 255.0 * compare(&truth(&frame), &fast)?.rms;
        let label = format!(
            "RMS error of constant vectors, {} polygons, light {distance} radii away",
            2 * rings * rings
        );
        shows(content, &label, rms);
        Ok(())
    },
};

/// Adds the finding of an RMS error of constant vectors, in grey levels.
fn shows(content: &mut FigureContent, label: &str, rms: f64) {
    content.found(
        &format!("coarse | {label}"),
        (rms, "grey levels", true),
        Agreement::if_holds(rms <= 1.0),
        if rms <= 1.0 {
            "Nobody sees it: the polygons are small, or the light is far away."
        } else {
            "Every polygon shows: the assumption holds for lights at infinity."
        },
    );
}

/// How many bands the spheres have from pole to pole.
const RINGS: [u32; 5] = [6, 12, 24, 48, 96];
/// The distances of the light from the surface of the sphere, whose radius is 1.
const DISTANCES: [f64; 4] = [0.25, 1.0, 4.0, 16.0];
/// The direction from the middle of the sphere to the light; its length does not matter.
const TOWARD: DVec3 = DVec3::new(-0.4, 0.5, 0.77);

/// Makes a sphere seen from close by, with a light at `distance` from its surface.
fn sphere(rings: u32, distance: f64) -> Result<Scene> {
    let mesh = format!("sphere?rings={rings}&segments={}", 2 * rings);
    let material = grey(0.05, 0.5, 0.4, 24.0);
    let mut scene = scene(&mesh, material, DVec3::Z, 1.1, [96, 96])?;
    let position = TOWARD.normalize() * (1.0 + distance);
    scene.lights = vec![Light::positional(position, [1.0; 3])];
    scene.local_viewer = true;
    Ok(scene)
}

fn pictures(content: &mut FigureContent) -> Result {
    content.text(
        "Fast Phong shading treats L, V and the L·V of 4.6 as constants of the polygon. That is exact \
         if light and eye are at infinity. Otherwise the polygons must be small, or the light and the \
         eye far away.",
    );
    let near = sphere(RINGS[1], DISTANCES[0])?.frame()?;
    let duff = compared(content, &near)?;
    let difference = levels(&draw(&near, "naive-phong")?, &duff);
    content.adds(
        "duff-naive | Duff's six quadratics against vectors at each pixel, largest difference",
        (difference, "grey levels", difference < 0.5),
        "The pictures are the same: apart from rounding, Duff's products are exact.",
    );
    Ok(())
}

/// Shows the picture by constant vectors beside the picture by vectors at each pixel, and returns
/// the latter.
fn compared(content: &mut FigureContent, frame: &Frame) -> Result<LinearPicture> {
    let [fast, duff] = draw_each(frame, ["fast-phong", "duff-phong"])?;
    let [fast_8, duff_8] = [&fast, &duff].map(stored);
    let map = difference_map(&duff_8, &fast_8, 64.0)?;
    content.row(
        "A sphere with a light close to it, vectors",
        "constant along each polygon (fast-phong) | at each pixel (duff-phong) | their difference, \
         up to 64 levels",
        [fast_8, duff_8, map],
    );
    Ok(duff)
}

/// Measures fast Phong shading over resolutions and distances.
fn errors(content: &mut FigureContent) -> Result {
    let fast = Variant::parse("fast-phong")?;
    let polygons = RINGS.map(|rings| 2 * rings * rings);
    let (mut rows, mut curves) = (Vec::new(), Vec::new());
    for distance in DISTANCES {
        let (mut row, mut curve) = (distance.to_string(), Vec::new());
        for (rings, polygons) in RINGS.into_iter().zip(polygons) {
            let frame = sphere(rings, distance)?.frame()?;
            let truth = truth(&frame);
            let difference = compare(&truth, &fast.render_linear(&frame)?)?;
            row += &max_and_rms(&difference);
            curve.push((f64::from(polygons), 255.0 * difference.rms));
        }
        rows.push(row);
        curves.push(Series::new(format!("light at {distance}"), curve));
    }
    let head = polygons.map(|polygons| format!(" | {polygons} polygons"));
    let head = format!(
        "distance of the light: max / RMS in levels{}",
        head.concat()
    );
    content.table(&head, rows);
    let [coarse, .., fine] = curves[0].points[..] else {
        return Ok(());
    };
    content.plot(Plot::new(
        "The error of constant vectors, by the number of polygons",
        [log("polygons of the sphere"), log("RMS error, grey levels")],
        curves,
        "Distances are in radii. The eye stays five radii from the middle: its error is left when the \
         light is far away.",
    ));
    let label = "RMS error of constant vectors, coarsest sphere and nearest light";
    shows(content, label, coarse.1);
    let finer = f64::from(RINGS[RINGS.len() - 1]) / f64::from(RINGS[0]);
    let order = libm::log(coarse.1 / fine.1) / libm::log(finer);
    content.adds(
        "order | power of the polygons' size with which the error falls, nearest light",
        (order, "", order > 0.5),
        "Smaller polygons make up for a near light.",
    );
    Ok(())
}

/// Counts the operations of Duff's six products, which replace vectors at each pixel by additions.
fn products(content: &mut FigureContent) -> Result {
    let counts = |method: &str, lights| -> Result<OperationCounts> {
        let bench = SpanBench::local(20.0, lights, Falloff::None, Interpolation::Screen);
        Ok(Variant::parse(method)?.operations_on(&bench))
    };
    let mut rows = Vec::new();
    for method in ["naive-phong", "duff-phong"] {
        let mut row = method.to_string();
        for lights in [1, 2] {
            let OperationCounts { walk, shade, .. } = counts(method, lights)?;
            let sum = |of: fn(&Counts) -> u32| of(&walk) + of(&shade);
            let [additions, multiplications] = [sum(|c| c.additions), sum(|c| c.multiplications)];
            let others = sum(|c| c.divisions + c.roots);
            row += &format!(" | {additions} | {multiplications} | {others}");
        }
        rows.push(row);
    }
    content.table(
        "operations per pixel | + (1 light) | × | ÷ and √ | + (2 lights) | × | ÷ and √",
        rows,
    );
    let one = counts("duff-phong", 1)?.walk.additions;
    let more = counts("duff-phong", 2)?.walk.additions - one;
    content.adds(
        "additions | additions per pixel that step the six products of one light, and 1/w²",
        (one, "", true),
        &format!("Two for each. A second light takes {more} more. 1/w² is for the falloff."),
    );
    Ok(())
}
