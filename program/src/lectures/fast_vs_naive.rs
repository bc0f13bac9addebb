//! Fast Phong against naive Phong: the same picture for fewer operations (L21 4.2–4.4).

use super::prelude::*;
use fastphong::shading::{METHODS, OperationCounts};

pub(super) static FIGURE: Figure = Figure {
    name: "fast-vs-naive",
    title: "Fast Phong against naive Phong: the picture and the price",
    lecture: "L21 4.1–4.4, 5",
    parts: &[meshes, operations],
    live: None,
};

/// The meshes, coarse and fine, with and without flat parts.
const MESHES: [&str; 6] = [
    "sphere?rings=4&segments=8",
    "sphere",
    "torus?sides=12&segments=24",
    "teapot?res=4",
    "knot?segments=96&sides=8",
    "corrugated?segments=24&rows=4",
];
/// Grey levels at the yellow end of the difference map.
const MAP_SCALE: f32 = 8.0;

/// Compares fast Phong with naive Phong on every mesh: with one step, and with the fewest steps
/// that suffice on each span, which is the default.
fn meshes(content: &mut FigureContent) -> Result {
    let (mut rows, mut fewest, mut by_one) = (Vec::new(), 0.0f64, Vec::new());
    for mesh in MESHES {
        let frame = fitted(mesh, [200, 150])?.frame()?;
        let [naive, fast, one] =
            draw_each(&frame, ["naive-phong", "fast-phong", "fast-phong:steps=1"])?;
        let (by_default, with_one) = (compare(&naive, &fast)?, compare(&naive, &one)?);
        let errors = [by_default.max, by_default.rms, with_one.max, with_one.rms];
        let cells = errors.map(|error| written(255.0 * error)).join(" | ");
        rows.push(format!("{mesh} | {} | {cells}", frame.polygons().len()));
        fewest = fewest.max(255.0 * by_default.max);
        by_one.push((255.0 * with_one.max, mesh, [naive, one]));
    }
    content.table(
        "difference from naive Phong, levels | polygons | fewest steps: max | fewest steps: RMS \
         | 1 step: max | 1 step: RMS",
        rows,
    );
    content.confirms(
        "default | fast Phong with the fewest sufficient steps: largest difference from naive \
         Phong",
        (fewest, "grey levels", fewest <= 1.0),
        "No pixel differs by more than a grey level.",
    );
    let verdict = |error: f64| {
        if error <= 1.0 {
            "One step is enough on this mesh."
        } else {
            "One step is not enough on this mesh."
        }
    };
    let coarse = by_one[0].0;
    content.adds(
        "one-step-sphere | fast Phong with 1 step: largest difference on the coarse sphere",
        (coarse, "grey levels", true),
        verdict(coarse),
    );
    by_one.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    let (error, mesh, pictures) = &by_one[0];
    let head = "one-step | fast Phong with 1 step: largest difference over all meshes, on";
    content.adds(
        &format!("{head} {mesh}"),
        (*error, "grey levels", true),
        verdict(*error),
    );
    content.text(format!(
        "On this mesh one step is farthest from naive Phong: {mesh}."
    ));
    let captions = "naive Phong | fast Phong, 1 step";
    content.compared(mesh, captions, pictures, MAP_SCALE)
}

/// Counts the operations of walk and shade, per pixel and for one light.
fn operations(content: &mut FigureContent) -> Result {
    content.text(
        "Operations per pixel for one light and shininess 32. They are counted by running each method \
         with numbers that count. Walk steps from the previous pixel, and shade computes the colour. \
         The power takes five multiplications in every method except flat and Gouraud shading.",
    );
    let rows = METHODS.iter().map(|entry| {
        let OperationCounts { walk, shade, .. } = entry.variant().operations(1);
        let cells = [walk, shade].map(|c| {
            let counts = [c.additions, c.multiplications, c.divisions, c.roots];
            counts.map(|count| format!(" | {count}")).concat()
        });
        format!("{}{}", entry.info.name, cells.concat())
    });
    content.table(
        "method | walk: + − | walk: × | walk: ÷ | walk: √ | shade: + − | shade: × | shade: ÷ \
         | shade: √",
        rows,
    );
    let count = |method| Ok::<_, FigureError>(Variant::parse(method)?.operations(1));
    let (naive, fast) = (count("naive-phong")?, count("fast-phong")?);
    let roots = |counts: &OperationCounts| counts.walk.roots + counts.shade.roots;
    content.confirms(
        "roots-naive | naive Phong: square roots per pixel",
        (roots(&naive), "", roots(&naive) == 1),
        "One, which normalises the interpolated normal.",
    );
    content.confirms(
        "roots-fast | fast Phong: square roots per pixel",
        (roots(&fast), "", roots(&fast) == 0),
        "None: Newton\u{2019}s steps take their place.",
    );
    content.confirms(
        "walk-naive | naive Phong: additions to step the normal (4.2)",
        (naive.walk.additions, "", naive.walk.additions == 3),
        "Three additions per pixel.",
    );
    let gouraud = count("gouraud")?.walk.additions;
    content.confirms(
        "walk-gouraud | Gouraud: additions per pixel, for three channels (3.6)",
        (gouraud, "", gouraud == 3),
        "One addition per channel.",
    );
    let slerp = count("slerp-phong")?.walk;
    // J and K each take one addition and two multiplications from the sines (4.8).
    let is_as_said = (slerp.additions, slerp.multiplications) == (4 + 2, 8 + 4);
    content.confirms(
        "walk-slerp | slerp Phong: additions and multiplications to step J and K (4.8)–(4.12)",
        (slerp.additions + slerp.multiplications, "", is_as_said),
        "6 additions and 12 multiplications: 4 and 8 for the sines, as the lecture counts, and 1 and 2 \
         for each of J and K.",
    );
    Ok(())
}
