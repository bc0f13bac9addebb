//! Highlights from behind, and colours clamped at vertices or at pixels (CS171 2; L5; L21 3).

use super::prelude::*;

pub(super) static FIGURE: Figure = Figure {
    name: "gates",
    title: "Light from behind, and clamped colours",
    lecture: "CS171 2, Specular reflection; L5; L21 2.1, L21 3",
    parts: &[gates, clamping],
    live: None,
};

/// The direction to a light behind and above: it lights surfaces that turn away from the eye.
const BEHIND: DVec3 = DVec3::new(-0.55, 0.5, -0.67);
/// A grazing light makes long highlights with a small exponent.
const SHINY: Material = grey(0.08, 0.4, 0.8, 12.0);
const MATTE: Material = grey(0.08, 0.4, 0.0, 1.0);

/// Draws a torus in light from behind. Its highlights are N·H, as the lectures print them.
fn torus(material: Material, gate: SpecularGate) -> Result<LinearPicture> {
    let mesh = "torus?segments=96&sides=48";
    let mut scene = scene(mesh, material, BEHIND, 1.5, [112, 112])?;
    (scene.specular, scene.shininess_for) = (SpecularModel::Blinn, SpecularModel::Blinn);
    scene.gate = gate;
    draw(&scene.frame()?, "duff-phong")
}

/// Returns the largest step between covered neighbours in a row, less the step of the other picture
/// there, in grey levels. The subtraction removes edges of the surface, which both pictures have.
fn largest_step(picture: &LinearPicture, other: &LinearPicture) -> f64 {
    let mut largest: f64 = 0.0;
    for y in 0..picture.height() {
        for (pair, smooth) in picture.row(y).windows(2).zip(other.row(y).windows(2)) {
            if pair[0][3] > 0.0 && pair[1][3] > 0.0 {
                let step = |pair: &[[f32; 4]]| (pair[1][0] - pair[0][0]).abs();
                largest = largest.max(f64::from(255.0 * (step(pair) - step(smooth))));
            }
        }
    }
    largest
}

fn gates(content: &mut FigureContent) -> Result {
    content.text(
        "A torus lit from behind. The lectures raise a cosine to a power without asking whether the \
         light reaches the surface at all.",
    );
    let gated = torus(SHINY, SpecularGate::Gated)?;
    let ungated = torus(SHINY, SpecularGate::Ungated)?;
    let weighted = torus(SHINY, SpecularGate::Weighted)?;
    content.row(
        "A torus lit from behind, highlights",
        "none where L·N ≤ 0 (default) | as printed in CS171 and L5 | weighted by L·N",
        [&gated, &ungated, &weighted].map(stored),
    );
    // Where the matte surface has only ambient light, 0.08, it is turned away from the light.
    let matte = torus(MATTE, SpecularGate::Gated)?;
    let behind = |picture: &LinearPicture| {
        let pairs = || picture.pixels().iter().zip(matte.pixels());
        let is_away = |m: &[f32; 4]| m[3] > 0.0 && f64::from(m[0]) <= 0.08 + 1e-6;
        let shines = |(p, m): &(&[f32; 4], &[f32; 4])| is_away(m) && p[0] - m[0] > 2.0 / 255.0;
        let away = pairs().filter(|(_, m)| is_away(m)).count();
        percent(pairs().filter(shines).count(), away)
    };
    let from_behind = behind(&ungated);
    content.contradicts(
        "behind | share of the surface turned away from the light that shines, as printed",
        (from_behind, "%", from_behind > 1.0),
        "Light from behind shines through the surface.",
    );
    let none = behind(&gated).max(behind(&weighted));
    content.adds(
        "behind-gated | share of the surface turned away from the light that shines, with a gate or a weight",
        (none, "%", none == 0.0),
        "None.",
    );
    let line = largest_step(&gated, &weighted);
    let no_line = largest_step(&weighted, &gated);
    content.adds(
        "line | largest step between neighbouring pixels that the gate makes and the weight does \
         not",
        (line, "grey levels", line > 2.0 * no_line),
        "The gate ends highlights in a hard line; the weight does not.",
    );
    Ok(())
}

/// Draws a coarse sphere with more light than a picture can hold.
fn clamping(content: &mut FigureContent) -> Result {
    let light = DVec3::new(-0.4, 0.5, 0.8);
    let bright = grey(0.2, 1.0, 0.6, 10.0);
    let sphere = scene("sphere?rings=8&segments=16", bright, light, 1.1, [112, 112])?;
    let frame = sphere.frame()?;
    let truth = truth(&frame);
    let [clamped, separate] = draw_each(&frame, ["gouraud", "gouraud-separate"])?;
    content.text(
        "An overexposed sphere by Gouraud's method, clamped at the vertices or at the pixels, and lit at \
         every pixel.",
    );
    content.row(
        "An overexposed sphere",
        "clamped at the vertices | clamped at the pixels | lit at each pixel",
        [&clamped, &separate, &truth].map(stored),
    );
    let difference = levels(&clamped, &separate);
    content.adds(
        "clamped | clamped at vertices against clamped at pixels, largest difference",
        (difference, "grey levels", difference > 1.0),
        "Clamping before interpolating is not the same as clamping after it.",
    );
    let (first, last) = (compare(&truth, &clamped)?, compare(&truth, &separate)?);
    let ratio = (255.0 * first.rms) / (255.0 * last.rms);
    content.adds(
        "nearer | RMS error of clamping at vertices over that of clamping at pixels",
        (ratio, "", ratio > 1.0),
        "Clamping last comes closer to lighting every pixel.",
    );
    Ok(())
}
