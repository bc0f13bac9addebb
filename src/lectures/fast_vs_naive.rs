//! Fast Phong against naive Phong: the same picture for fewer operations (L21 4.2–4.4).

use super::stage::{stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Shown};
use crate::compare::metrics::{compare, difference_map};
use crate::frame::Frame;
use crate::mesh::builtin::builtin;
use crate::number::Counts;
use crate::scene::Scene;
use crate::shading::{METHODS, Variant};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

pub(super) static FIGURE: Figure = Figure {
    name: "fast-vs-naive",
    title: "Fast Phong against naive Phong: the picture and the price",
    lecture: "L21 4.1–4.4, 5",
    make,
};

/// What is drawn, coarse and fine, with and without flat parts.
const MESHES: [&str; 6] = [
    "sphere?rings=4&segments=8",
    "sphere",
    "torus?sides=12&segments=24",
    "teapot?res=4",
    "knot?segments=96&sides=8",
    "corrugated?segments=24&rows=4",
];
/// Grey levels at the yellow end of the difference maps.
const MAP_SCALE: f32 = 8.0;

fn frame_of(mesh: &str) -> Result<Frame, FigureError> {
    let mut scene = Scene::of_mesh(builtin(mesh)?);
    (scene.width, scene.height) = (200, 150);
    Ok(scene.frame()?)
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let worst = meshes(&mut content)?;
    pictures(&mut content, worst)?;
    operations(&mut content)?;
    Ok(content)
}

/// The mesh on which one step is worst: naive, one step, and their difference.
fn pictures(content: &mut Content, mesh: &str) -> Result<(), FigureError> {
    let frame = frame_of(mesh)?;
    let [naive, one] = ["naive-phong", "fast-phong:steps=1"].map(Variant::parse);
    let (naive, one) = (naive?.render_linear(&frame), one?.render_linear(&frame));
    let map = difference_map(&naive, &one, MAP_SCALE)?;
    let caption = format!(
        "their difference: purple to yellow is up to {MAP_SCALE} grey levels, black none, magenta more"
    );
    content.text(format!(
        "The mesh on which one step is farthest from naive Phong: {mesh}."
    ));
    content.pictures(
        3,
        Vec::from([
            Shown::new(
                "naive Phong",
                format!("{mesh} by naive Phong."),
                stored(&naive),
            ),
            Shown::new(
                "fast Phong, 1 step",
                "The same by fast Phong with one step of Newton's.",
                stored(&one),
            ),
            Shown::new(
                caption,
                "Most pixels differ by almost nothing, few where spans turn far by more.",
                map,
            ),
        ]),
    );
    Ok(())
}

/// The largest difference from naive Phong on every mesh, with the fewest steps that suffice on each span, which is the
/// default, and with one; the mesh on which one step is worst.
fn meshes(content: &mut Content) -> Result<&'static str, FigureError> {
    let [naive, fast, one] =
        ["naive-phong", "fast-phong", "fast-phong:steps=1"].map(Variant::parse);
    let (naive, fast, one) = (naive?, fast?, one?);
    let (mut rows, mut worst, mut coarse, mut worst_by_one) =
        (Vec::new(), 0.0f64, 0.0, (0.0, MESHES[0]));
    for mesh in MESHES {
        let frame = frame_of(mesh)?;
        let exact = naive.render_linear(&frame);
        let by = |variant: &Variant| compare(&exact, &variant.render_linear(&frame));
        let (by_default, by_one) = (by(&fast)?, by(&one)?);
        let texts = [by_default.max, by_default.rms, by_one.max, by_one.rms]
            .map(|error| written(255.0 * error));
        rows.push(
            [
                [mesh.to_string(), frame.polygons().len().to_string()].to_vec(),
                texts.to_vec(),
            ]
            .concat(),
        );
        worst = worst.max(255.0 * by_default.max);
        if mesh == MESHES[0] {
            coarse = 255.0 * by_one.max;
        }
        if 255.0 * by_one.max > worst_by_one.0 {
            worst_by_one = (255.0 * by_one.max, mesh);
        }
    }
    content.table(
        &[
            "difference from naive Phong, levels",
            "polygons",
            "fewest steps: max",
            "fewest steps: RMS",
            "1 step: max",
            "1 step: RMS",
        ],
        rows,
    );
    content.claim("default", "fast Phong with the fewest steps that suffice: largest difference from naive Phong over all meshes", (worst, "grey levels"), worst <= 1.0, ["No pixel differs by more than a grey level.", "There are pixels that differ."]);
    let enough = |levels: f64| match levels <= 1.0 {
        true => "One step is enough there.",
        false => "One step is not enough there.",
    };
    content.adds(
        "one-step-sphere",
        "fast Phong with 1 step: largest difference on the coarse sphere",
        (coarse, "grey levels"),
        enough(coarse),
    );
    let (levels, mesh) = worst_by_one;
    content.adds(
        "one-step",
        format!("fast Phong with 1 step: largest difference over all meshes, on {mesh}"),
        (levels, "grey levels"),
        enough(levels),
    );
    Ok(mesh)
}

/// Per pixel, for one light: walk and shade together.
fn operations(content: &mut Content) -> Result<(), FigureError> {
    let mut rows = Vec::new();
    for entry in METHODS {
        let counts = entry.variant().operations(1);
        rows.push(
            [
                [entry.info.name.to_string()].to_vec(),
                cells(&counts.walk),
                cells(&counts.shade),
            ]
            .concat(),
        );
    }
    content.text(
        "Operations a pixel for one light and shininess 32, counted by running each method on numbers that count: to step \
         from the previous pixel (walk), and for the colour (shade). The power costs five multiplications in every method \
         but flat and Gouraud shading.",
    );
    content.table(
        &[
            "method",
            "walk: + −",
            "walk: ×",
            "walk: ÷",
            "walk: √",
            "shade: + −",
            "shade: ×",
            "shade: ÷",
            "shade: √",
        ],
        rows,
    );
    let naive = Variant::parse("naive-phong")?.operations(1);
    let fast = Variant::parse("fast-phong")?.operations(1);
    let roots = |counts: &Counts| f64::from(counts.roots);
    let (naive_roots, fast_roots) = (
        roots(&naive.walk) + roots(&naive.shade),
        roots(&fast.walk) + roots(&fast.shade),
    );
    content.found(Finding::new(
        "roots-naive",
        "naive Phong: square roots a pixel",
        (naive_roots, ""),
        Agreement::if_holds(naive_roots == 1.0),
        "To normalise the interpolated normal.",
    ));
    content.claim(
        "roots-fast",
        "fast Phong: square roots a pixel",
        (fast_roots, ""),
        fast_roots == 0.0,
        [
            "None: Newton\u{2019}s steps take their place.",
            "There are still roots.",
        ],
    );
    let additions = naive.walk.additions;
    content.claim(
        "walk-naive",
        "naive Phong: additions to step the normal (4.2)",
        (f64::from(additions), ""),
        additions == 3,
        ["Three additions a pixel.", "Not three additions a pixel."],
    );
    let gouraud = Variant::parse("gouraud")?.operations(1).walk.additions;
    content.claim(
        "walk-gouraud",
        "Gouraud: additions a pixel, for three channels (3.6)",
        (f64::from(gouraud), ""),
        gouraud == 3,
        ["One addition a channel.", "Not one addition a channel."],
    );
    let slerp = Variant::parse("slerp-phong")?.operations(1).walk;
    let (additions, multiplications) = (slerp.additions, slerp.multiplications);
    content.found(Finding::new(
        "walk-slerp",
        "slerp Phong: additions and multiplications to step J and K (4.8)–(4.12)",
        (f64::from(additions + multiplications), ""),
        // One addition and two multiplications each make J and K of the sines (4.8).
        Agreement::if_holds((additions, multiplications) == (4 + 2, 8 + 4)),
        format!(
            "{additions} additions and {multiplications} multiplications: the lecture counts 4 and 8 for the sines and \
             cosines, and J and K take 1 and 2 more each."
        ),
    ));
    Ok(())
}

fn cells(counts: &Counts) -> Vec<String> {
    [
        counts.additions,
        counts.multiplications,
        counts.divisions,
        counts.roots,
    ]
    .map(|n| n.to_string())
    .into()
}
