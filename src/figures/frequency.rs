//! How often light is computed against how fine the mesh is: face, vertex and pixel over six spheres (L5).

use super::stage::{stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Plot, Scale, Series, Shown};
use crate::lighting::Material;
use crate::mesh::builtin::builtin;
use crate::mesh::vertex_normals::NormalSource;
use crate::metrics::compare_where;
use crate::picture::LinearPicture;
use crate::reference::{self, Model};
use crate::scene::Scene;
use crate::shader::Variant;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

pub(super) static FIGURE: Figure = Figure {
    name: "frequency",
    title: "Shading frequency against mesh resolution: face, vertex, pixel",
    lecture: "L5, Shading Frequency; L21 3-4",
    make,
};

/// The frequencies of L5, and the methods that have them.
const FREQUENCIES: [(&str, &str); 3] = [("face", "flat"), ("vertex", "gouraud"), ("pixel", "naive-phong")];
/// Rings of the spheres; segments are twice as many.
const RINGS: [u32; 6] = [3, 4, 6, 10, 18, 34];
/// Rings of the sphere that stands for the smooth one: its polygons are smaller than a pixel.
const FINEST: u32 = 120;
/// Width and height of each picture.
const SIDE: u32 = 88;

/// A sphere with its own normals; all are as large on the picture.
fn scene(rings: u32) -> Result<Scene, FigureError> {
    let mut scene = Scene::of_mesh(builtin(&format!("sphere?rings={rings}&segments={}", 2 * rings))?);
    (scene.width, scene.height) = (SIDE, SIDE);
    let material = Material { specular: [0.4; 3], shininess: 24.0, ..Material::default() };
    for object in &mut scene.objects {
        (object.normals, object.material) = (NormalSource::Given, Some(material));
    }
    Ok(scene)
}

/// One sphere: polygons drawn, and picture and RMS error at each frequency.
struct Row {
    polygons: usize,
    pictures: Vec<LinearPicture>,
    rms: Vec<f64>,
}

fn rows(truth: &LinearPicture) -> Result<Vec<Row>, FigureError> {
    let mut rows = Vec::new();
    for rings in RINGS {
        let frame = scene(rings)?.frame()?;
        let mut row = Row { polygons: frame.polygons().len(), pictures: Vec::new(), rms: Vec::new() };
        for (_, method) in FREQUENCIES {
            let picture = Variant::parse(method)?.render_linear(&frame);
            let both = |x, y| picture.get(x, y)[3] > 0.0 && truth.get(x, y)[3] > 0.0;
            let difference = compare_where(truth, &picture, both).expect("pictures of one size");
            row.rms.push(255.0 * difference.rms);
            row.pictures.push(picture);
        }
        rows.push(row);
    }
    Ok(rows)
}

/// The brightest green of a picture, which no part of it reaches by diffuse light.
fn peak(picture: &LinearPicture) -> f64 {
    picture.texels().iter().map(|texel| f64::from(texel[1])).fold(0.0, f64::max)
}

fn make() -> Result<Content, FigureError> {
    let truth = reference::render(&scene(FINEST)?.frame()?, Model::Phong).to_linear();
    let rows = rows(&truth)?;
    let mut content = Content::default();
    content.text(format!(
        "Six spheres with the normals of the true sphere, shaded once a face, once a vertex and once a pixel. Errors are \
         root mean squares in grey levels against a sphere of {FINEST} rings shaded in double precision at each pixel, where \
         both are seen."
    ));
    let mut shown = Vec::new();
    for (f, (frequency, method)) in FREQUENCIES.into_iter().enumerate() {
        for row in &rows {
            let caption = format!("{frequency}, {}: {}", row.polygons, written(row.rms[f]));
            let alt = format!("A sphere of which {} polygons are seen, by {method} shading.", row.polygons);
            shown.push(Shown::new(caption, alt, stored(&row.pictures[f])));
        }
    }
    content.pictures(RINGS.len(), shown);
    content.plot(plot(&rows));
    let cells = |row: &Row| {
        let errors = row.rms.iter().map(|rms| written(*rms));
        core::iter::once(row.polygons.to_string()).chain(errors).collect::<Vec<String>>()
    };
    content.table(&["polygons seen", "face", "vertex", "pixel"], rows.iter().map(cells).collect());
    findings(&mut content, &rows, peak(&truth));
    Ok(content)
}

fn plot(rows: &[Row]) -> Plot {
    let series = FREQUENCIES
        .iter()
        .enumerate()
        .map(|(f, (name, _))| Series::new(*name, rows.iter().map(|row| (row.polygons as f64, row.rms[f]))));
    Plot {
        title: "RMS error against the number of polygons".into(),
        x: ("polygons seen".into(), Scale::Log),
        y: ("RMS error, grey levels".into(), Scale::Log),
        series: series.collect(),
        marks: Vec::new(),
        caption: "The finer the mesh, the less it matters how often light is computed.".into(),
    }
}

fn findings(content: &mut Content, rows: &[Row], peak_of_truth: f64) {
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let gain = first.rms[0] / first.rms[2];
    let orders = |row: &Row| row.rms[0] > row.rms[1] && row.rms[1] > row.rms[2];
    let ordered = rows.iter().filter(|row| orders(row)).count();
    content.found(Finding::new(
        "ordered",
        "spheres on which pixel is better than vertex is better than face",
        (ordered as f64, "of 6"),
        Agreement::if_holds(ordered == rows.len()),
        if ordered == rows.len() {
            "The more often light is computed, the better the picture, at every resolution."
        } else {
            "Not at every resolution is the picture better where light is computed more often."
        },
    ));
    content.found(Finding::new(
        "coarsest",
        "error of face over error of pixel on the coarsest sphere",
        (gain, ""),
        Agreement::Adds,
        format!("On {} polygons it matters most.", first.polygons),
    ));
    let finest = last.rms[1];
    content.found(Finding::new(
        "finest",
        "RMS error of vertex on the finest sphere",
        (finest, "grey levels"),
        Agreement::if_holds(finest < first.rms[2]),
        if finest < first.rms[2] {
            "A fine mesh lit at its vertices is better than a coarse one lit at every pixel."
        } else {
            "Even on the finest mesh, light at vertices is worse than light at each pixel of the coarsest."
        },
    ));
    let kept = |f: usize| peak(&first.pictures[f]) / peak_of_truth;
    let blurs = kept(1) < 0.9 && kept(2) > 0.95;
    content.found(Finding::new(
        "highlight-vertex",
        "brightest pixel of Gouraud on the coarsest sphere over that of the true one",
        (kept(1), ""),
        Agreement::if_holds(blurs),
        if blurs { "Gouraud shading loses the highlight (L21 4)." } else { "Gouraud shading keeps the highlight." },
    ));
    content.found(Finding::new(
        "highlight-pixel",
        "the same for Phong",
        (kept(2), ""),
        Agreement::if_holds(kept(2) > 0.95),
        if kept(2) > 0.95 { "Phong shading keeps it (L21 4)." } else { "Phong shading loses it too." },
    ));
}
