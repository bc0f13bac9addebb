//! Shading frequency against mesh resolution: faces, vertices, pixels, on six spheres (L5).

use super::stage::{stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Plot, Scale, Series, Shown};
use crate::compare::metrics::{Difference, compare_where};
use crate::frame::Frame;
use crate::mesh::builtin::builtin;
use crate::picture::LinearPicture;
use crate::reference::{self, Model};
use crate::scene::Scene;
use crate::shading::Variant;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

pub(super) static FIGURE: Figure = Figure {
    name: "frequency",
    title: "Shading frequency and mesh resolution",
    lecture: "L5, Shading frequency: triangle, vertex or pixel",
    make,
};

/// Bands from pole to pole of the spheres; twice as many cells around.
const RINGS: [u32; 6] = [4, 6, 10, 18, 34, 64];
/// Of the sphere that is the truth.
const FINEST: u32 = 200;
/// Width and height of the pictures.
const SIDE: u32 = 80;
/// What is shaded once, by which method, and what its shading is called.
const FREQUENCIES: [(&str, &str); 3] = [
    ("flat", "face"),
    ("gouraud", "vertex"),
    ("naive-phong", "pixel"),
];

/// A sphere of so many rings, through one camera for all.
fn sphere(rings: u32) -> Result<Frame, FigureError> {
    let mesh = |rings: u32| builtin(&format!("sphere?rings={rings}&segments={}", 2 * rings));
    let mut scene = Scene::of_mesh(mesh(FINEST)?);
    (scene.width, scene.height) = (SIDE, SIDE);
    if rings != FINEST {
        scene.objects = Scene::of_mesh(mesh(rings)?).objects;
    }
    Ok(scene.frame()?)
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let truth = reference::render(&sphere(FINEST)?, Model::Phong).to_linear();
    let frames = RINGS
        .iter()
        .map(|&rings| sphere(rings))
        .collect::<Result<Vec<_>, _>>()?;
    content.text(format!(
        "One sphere in six resolutions, shaded once a face, a vertex, and a pixel. Errors are against the Phong reference \
         on {} polygons, over the pixels that both spheres cover.",
        sphere(FINEST)?.polygons().len()
    ));
    let (mut shown, mut errors) = (Vec::new(), Vec::new());
    for (method, frequency) in FREQUENCIES {
        let variant = Variant::parse(method)?;
        for (frame, rings) in frames.iter().zip(RINGS) {
            let drawn = variant.render_linear(frame);
            let polygons = 2 * rings * rings;
            let alt = format!("A sphere of {polygons} polygons shaded once a {frequency}.");
            shown.push(Shown::new(
                format!("{frequency}, {polygons} polygons"),
                alt,
                stored(&drawn),
            ));
            errors.push(inside(&truth, &drawn)?);
        }
    }
    content.pictures(RINGS.len(), shown);
    numbers(&mut content, &errors);
    Ok(content)
}

/// The difference over the pixels that both pictures cover.
fn inside(truth: &LinearPicture, drawn: &LinearPicture) -> Result<Difference, FigureError> {
    Ok(compare_where(truth, drawn, |x, y| {
        truth.get(x, y)[3] > 0.0 && drawn.get(x, y)[3] > 0.0
    })?)
}

fn numbers(content: &mut Content, errors: &[Difference]) {
    let of = |i: usize| &errors[i * RINGS.len()..][..RINGS.len()];
    let polygons = RINGS.map(|rings| 2 * rings * rings);
    let rows = FREQUENCIES.iter().enumerate().map(|(i, (_, frequency))| {
        let cells = of(i)
            .iter()
            .map(|d| format!("{} / {}", written(255.0 * d.max), written(255.0 * d.rms)));
        [frequency.to_string()].into_iter().chain(cells).collect()
    });
    let rows = rows.collect();
    let heads = polygons.map(|n| n.to_string());
    let mut head = Vec::from(["max / RMS in levels, by polygons"]);
    head.extend(heads.iter().map(|text| &text[..]));
    content.table(&head, rows);
    let curve = |i: usize| {
        let points = polygons
            .iter()
            .zip(of(i))
            .map(|(n, d)| (f64::from(*n), 255.0 * d.rms));
        Series::new(format!("once a {}", FREQUENCIES[i].1), points)
    };
    content.plot(Plot {
        title: "RMS error over the number of polygons".into(),
        x: ("polygons of the sphere".into(), Scale::Log),
        y: ("RMS error, grey levels".into(), Scale::Log),
        series: (0..FREQUENCIES.len()).map(curve).collect(),
        marks: Vec::new(),
        caption:
            "Finer meshes help every shading frequency; on the finest they are hard to tell apart."
                .to_string(),
    });
    for (i, (_, frequency)) in FREQUENCIES.iter().enumerate() {
        for (end, place) in [("coarsest", 0), ("finest", RINGS.len() - 1)] {
            let rms = 255.0 * of(i)[place].rms;
            let before = (i > 0).then(|| 255.0 * of(i - 1)[place].rms);
            let is_better = before.is_none_or(|before| rms < before);
            content.found(Finding::new(
                format!("{frequency}-{end}"),
                format!(
                    "once a {frequency}, {} polygons: RMS error",
                    polygons[place]
                ),
                (rms, "grey levels"),
                if before.is_none() {
                    Agreement::Adds
                } else {
                    Agreement::if_holds(is_better)
                },
                match before {
                    None => String::from(if rms > 1.0 {
                        "Visible facets."
                    } else {
                        "Facets can hardly be seen."
                    }),
                    Some(_) if is_better => format!("Less than once a {}.", FREQUENCIES[i - 1].1),
                    Some(_) => format!("More than once a {}.", FREQUENCIES[i - 1].1),
                },
            ));
        }
    }
    let (fine_faces, coarse_pixels) = (of(0)[RINGS.len() - 1].rms, of(2)[1].rms);
    content.adds(
        "trade",
        format!(
            "faces of {} polygons by pixels of {}: ratio of RMS errors",
            polygons[RINGS.len() - 1],
            polygons[1]
        ),
        (fine_faces / coarse_pixels, ""),
        if fine_faces > coarse_pixels {
            "Even many faces, one colour each, are worse than few with interpolated normals."
        } else {
            "Many faces make up for a low shading frequency."
        },
    );
}
