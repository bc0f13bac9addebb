//! Shading frequency and mesh resolution: light per face, vertex or pixel on six spheres (L5).

use super::prelude::*;
use fastphong::compare::metrics::{Difference, compare_where};

pub(super) static FIGURE: Figure = Figure {
    name: "frequency",
    title: "Shading frequency and mesh resolution",
    lecture: "L5, Shading frequency: triangle, vertex or pixel",
    parts: &[spheres],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "Shade once per face, once per vertex or once per pixel: on finer meshes the cheaper ways are enough (L5).",
    handles: &[Handle::slider(
        ["rings", "bands from pole to pole", ""],
        [4.0, 64.0],
        2.0,
        6.0,
    )],
    make: |content, values| {
        let rings = values[0] as u32;
        let (frame, truth) = (sphere(rings)?, truth(&sphere(FINEST)?));
        let (mut panels, mut before) = (Vec::new(), None);
        for (method, frequency) in FREQUENCIES {
            let (picture, difference) = drawn(&frame, &truth, method)?;
            panels.push((format!("once per {frequency}"), stored(&picture)));
            let rms = 255.0 * difference.rms;
            let label = format!(
                "once per {frequency}, {} polygons: RMS error",
                2 * rings * rings
            );
            conclude(content, &format!("{frequency} | {label}"), rms, before);
            before = Some((frequency, rms));
        }
        content.pictures(3, "A sphere, shaded", panels);
        Ok(())
    },
};

/// How many bands the spheres have from pole to pole, and twice as many cells around.
const RINGS: [u32; 6] = [4, 6, 10, 18, 34, 64];
const LAST: usize = RINGS.len() - 1;
/// How many bands the sphere has that serves as the truth.
const FINEST: u32 = 200;
/// Width and height of the pictures.
const SIDE: u32 = 80;
/// The methods, and the element that each lights once.
const FREQUENCIES: [(&str, &str); 3] = [
    ("flat", "face"),
    ("gouraud", "vertex"),
    ("naive-phong", "pixel"),
];

/// Makes a sphere of `rings` bands. All spheres share one camera.
fn sphere(rings: u32) -> Result<Frame> {
    let sphere = |rings| {
        let mesh = format!("sphere?rings={rings}&segments={}", 2 * rings);
        fitted(&mesh, [SIDE; 2])
    };
    let mut scene = sphere(FINEST)?;
    scene.objects = sphere(rings)?.objects;
    Ok(scene.frame()?)
}

fn spheres(content: &mut FigureContent) -> Result {
    let finest = sphere(FINEST)?;
    let truth = truth(&finest);
    let frames: Vec<Frame> = RINGS.into_iter().map(sphere).collect::<Result<_>>()?;
    content.text(format!(
        "One sphere in six resolutions, shaded once per face, per vertex and per pixel. Each picture is \
         compared with the Phong reference on {} polygons, where both cover a pixel.",
        finest.polygons().len()
    ));
    let (mut panels, mut errors) = (Vec::new(), Vec::new());
    for (method, frequency) in FREQUENCIES {
        let mut row = Vec::new();
        for (frame, rings) in frames.iter().zip(RINGS) {
            let (picture, difference) = drawn(frame, &truth, method)?;
            let caption = format!("{frequency}, {} polygons", 2 * rings * rings);
            panels.push((caption, stored(&picture)));
            row.push(difference);
        }
        errors.push(row);
    }
    content.pictures(RINGS.len(), "A sphere, shaded once per", panels);
    compare_errors(content, &errors);
    Ok(())
}

/// Draws a sphere. Also returns its difference from the truth, over the pixels that both cover.
fn drawn(
    frame: &Frame,
    truth: &LinearPicture,
    method: &str,
) -> Result<(LinearPicture, Difference)> {
    let drawn = draw(frame, method)?;
    let difference = compare_where(truth, &drawn, |x, y| {
        truth.get(x, y)[3] > 0.0 && drawn.get(x, y)[3] > 0.0
    })?;
    Ok((drawn, difference))
}

/// Adds the finding of a frequency's RMS error. `before` is the next lower frequency with its
/// error.
fn conclude(content: &mut FigureContent, head: &str, rms: f64, before: Option<(&str, f64)>) {
    match before {
        None => content.adds(
            head,
            (rms, "grey levels", rms > 1.0),
            "The facets are visible.",
        ),
        Some((frequency, more)) => {
            let says = format!("Less than once per {frequency}.");
            content.confirms(head, (rms, "grey levels", rms < more), &says);
        }
    }
}

/// Shows the errors, with a row for each frequency.
fn compare_errors(content: &mut FigureContent, errors: &[Vec<Difference>]) {
    let polygons = RINGS.map(|rings| 2 * rings * rings);
    let rms = |i: usize, k: usize| 255.0 * errors[i][k].rms;
    let cells = |errors: &[Difference]| errors.iter().map(max_and_rms).collect::<String>();
    let rows = FREQUENCIES
        .iter()
        .zip(errors)
        .map(|((_, frequency), errors)| format!("{frequency}{}", cells(errors)));
    let columns = polygons.map(|polygons| format!(" | {polygons}"));
    let head = format!("max / RMS in levels, by polygons{}", columns.concat());
    content.table(&head, rows);
    let curve = |i: usize| {
        let points = (0..RINGS.len()).map(|k| (f64::from(polygons[k]), rms(i, k)));
        Series::new(format!("once per {}", FREQUENCIES[i].1), points)
    };
    content.plot(Plot::new(
        "RMS error, by the number of polygons",
        [log("polygons of the sphere"), log("RMS error, grey levels")],
        [0, 1, 2].map(curve),
        "Finer meshes help every shading frequency; on the finest they are hard to tell apart.",
    ));
    for (i, (_, frequency)) in FREQUENCIES.iter().enumerate() {
        for (end, k) in [("coarsest", 0), ("finest", LAST)] {
            let label = format!("once per {frequency}, {} polygons: RMS error", polygons[k]);
            let head = format!("{frequency}-{end} | {label}");
            let before = i.checked_sub(1).map(|j| (FREQUENCIES[j].1, rms(j, k)));
            conclude(content, &head, rms(i, k), before);
        }
    }
    let (many, few) = (polygons[LAST], polygons[1]);
    let (fine_faces, coarse_pixels) = (errors[0][LAST].rms, errors[2][1].rms);
    content.adds(
        &format!(
            "trade | RMS error once per face on {many} polygons, over once per pixel on {few}"
        ),
        (fine_faces / coarse_pixels, "", fine_faces <= coarse_pixels),
        "Many faces make up for a low shading frequency.",
    );
}
