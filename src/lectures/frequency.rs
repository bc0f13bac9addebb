//! Shading frequency against mesh resolution: faces, vertices, pixels, on six spheres (L5).

use super::prelude::*;
use crate::compare::metrics::{Difference, compare_where};

pub(super) static FIGURE: Figure = Figure {
    name: "frequency",
    title: "Shading frequency and mesh resolution",
    lecture: "L5, Shading frequency: triangle, vertex or pixel",
    parts: &[spheres],
};

/// Bands from pole to pole of the spheres; twice as many cells around.
const RINGS: [u32; 6] = [4, 6, 10, 18, 34, 64];
const LAST: usize = RINGS.len() - 1;
/// Bands of the sphere that is the truth.
const FINEST: u32 = 200;
/// Width and height of the pictures.
const SIDE: u32 = 80;
/// The methods, with the element that each shades once.
const FREQUENCIES: [(&str, &str); 3] = [
    ("flat", "face"),
    ("gouraud", "vertex"),
    ("naive-phong", "pixel"),
];

/// Makes a sphere of so many rings, through one camera for all.
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
        "One sphere in six resolutions, shaded once per face, per vertex, and per pixel. Errors are \
         against the Phong reference on {} polygons, over pixels that both cover.",
        finest.polygons().len()
    ));
    let (mut panels, mut errors) = (Vec::new(), Vec::new());
    for (method, frequency) in FREQUENCIES {
        let mut row = Vec::new();
        for (frame, rings) in frames.iter().zip(RINGS) {
            let drawn = draw(frame, method)?;
            let caption = format!("{frequency}, {} polygons", 2 * rings * rings);
            panels.push((caption, stored(&drawn)));
            row.push(compare_where(&truth, &drawn, |x, y| {
                truth.get(x, y)[3] > 0.0 && drawn.get(x, y)[3] > 0.0
            })?);
        }
        errors.push(row);
    }
    content.pictures(RINGS.len(), "A sphere, shaded once a", panels);
    numbers(content, &errors);
    Ok(())
}

/// Shows the errors, a row a frequency.
fn numbers(content: &mut FigureContent, errors: &[Vec<Difference>]) {
    let polygons = RINGS.map(|rings| 2 * rings * rings);
    let rms = |i: usize, k: usize| 255.0 * errors[i][k].rms;
    let cells = |errors: &[Difference]| errors.iter().map(max_and_rms).collect::<String>();
    let rows = FREQUENCIES.iter().zip(errors);
    let rows = rows.map(|((_, frequency), errors)| format!("{frequency}{}", cells(errors)));
    let columns = polygons.map(|polygons| format!(" | {polygons}"));
    let head = format!("max / RMS in levels, by polygons{}", columns.concat());
    content.table(&head, rows);
    let curve = |i: usize| {
        let points = (0..RINGS.len()).map(|k| (f64::from(polygons[k]), rms(i, k)));
        Series::new(format!("once a {}", FREQUENCIES[i].1), points)
    };
    content.plot(Plot::new(
        "RMS error over the number of polygons",
        [log("polygons of the sphere"), log("RMS error, grey levels")],
        [0, 1, 2].map(curve),
        "Finer meshes help every shading frequency; on the finest they are hard to tell apart.",
    ));
    for (i, (_, frequency)) in FREQUENCIES.iter().enumerate() {
        for (end, k) in [("coarsest", 0), ("finest", LAST)] {
            let label = format!("once a {frequency}, {} polygons: RMS error", polygons[k]);
            let (head, here) = (format!("{frequency}-{end} | {label}"), rms(i, k));
            if i == 0 {
                content.adds(&head, (here, "grey levels", here > 1.0), "Visible facets.");
            } else {
                let is_less = here < rms(i - 1, k);
                let says = format!("Less than once a {}.", FREQUENCIES[i - 1].1);
                content.confirms(&head, (here, "grey levels", is_less), &says);
            }
        }
    }
    let (many, few) = (polygons[LAST], polygons[1]);
    let (fine_faces, coarse_pixels) = (errors[0][LAST].rms, errors[2][1].rms);
    content.adds(
        &format!("trade | faces of {many} polygons by pixels of {few}: ratio of RMS errors"),
        (fine_faces / coarse_pixels, "", fine_faces <= coarse_pixels),
        "Many faces make up for a low shading frequency.",
    );
}
