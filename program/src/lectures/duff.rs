//! Duff's surprise: two polygons whose joint has a stronger Mach band under Phong shading than
//! under Gouraud shading.
//!
//! T. Duff, *Smoothly shaded renderings of polyhedral objects on raster displays*, SIGGRAPH 1979,
//! says that there are surfaces like this. The example and its closed form are derived here.

use super::prelude::*;

pub(super) static FIGURE: Figure = Figure {
    name: "duff",
    title: "Duff\u{2019}s surprise: where Phong shading bends more than Gouraud shading",
    lecture: "L21 4; Duff 1979",
    parts: &[curves, jumps, sweep],
    live: None,
};

/// Pixels per degree: each facet is as wide as its arc.
const PIXELS: f64 = 2.0;
/// Width and height of the pictures.
const SIZE: [u32; 2] = [240, 24];
/// The row whose intensities are compared.
const MIDDLE: usize = 12;
/// The column where both facets meet.
const JOINT: f64 = 190.0;
/// The angles of the left and of the right facet, in degrees.
const ANGLES: [f64; 2] = [90.0, 20.0];
/// The angle from the normal at the joint to the light, in degrees.
const LIGHT: f64 = 40.0;
const METHODS: [&str; 3] = ["gouraud", "naive-phong", "slerp-phong"];
/// The methods' names in sentences.
const NAMES: [&str; 3] = ["Gouraud", "naive Phong", "slerp Phong"];

/// Draws two facets of one circle by each method. They meet where the normal faces the eye, and
/// each is as wide as its arc.
fn circle([left, right]: [f64; 2]) -> Result<[LinearPicture; 3]> {
    let facet = |angles: [f64; 2]| {
        let columns = angles.map(|degrees| JOINT + PIXELS * degrees);
        ScreenPolygon::strip(columns, f64::from(SIZE[1]), angles.map(toward))
    };
    let facets = [facet([-left, 0.0]), facet([0.0, right])];
    draw_each(&frame(SIZE, DULL, toward(LIGHT), &facets)?, METHODS)
}

/// Returns how far the slope of naive Phong shading jumps at the joint, in grey levels per pixel.
/// Linear normals turn at the rate sin φ / length at both ends of a facet, and the intensity is the
/// cosine of the angle to the light:
///
/// ```text
/// 255 sin θ (sin φ₂ / l₂ − sin φ₁ / l₁)
/// ```
fn closed_form([left, right]: [f64; 2]) -> f64 {
    let rate = |degrees: f64| libm::sin(degrees.to_radians()) / (PIXELS * degrees);
    255.0 * libm::sin(LIGHT.to_radians()) * (rate(right) - rate(left))
}

/// Returns the jump of the slope at the joint for each method, in grey levels per pixel.
fn slope_jumps(angles: [f64; 2]) -> Result<[f64; 3]> {
    Ok(circle(angles)?.map(|picture| jump(&profile(&picture, MIDDLE), JOINT).slope))
}

fn curves(content: &mut FigureContent) -> Result {
    let [left, right] = ANGLES;
    content.text(format!(
        "Two facets of one circle, of {left}° and {right}°, each as wide as its arc. Along the circle \
         itself the intensity does not bend at the joint, which is {LIGHT}° from the light. Linear \
         normals turn more slowly at the ends of a facet, and the larger its angle, the slower. So \
         the two facets turn at different rates where they meet.",
    ));
    let pictures = circle(ANGLES)?;
    let panels = NAMES.into_iter().zip(pictures.each_ref().map(stored));
    content.pictures(2, "Two facets", panels);
    let seen = (JOINT - PIXELS * left) as usize..(JOINT + PIXELS * right) as usize;
    let curve = |(name, picture): (&str, &LinearPicture)| {
        let line = profile(picture, MIDDLE);
        Series::new(name, seen.clone().map(|i| (i as f64 + 0.5, line[i])))
    };
    let plot = Plot::new(
        "Intensity over two facets of one circle",
        [linear("column, pixels"), linear("intensity, grey levels")],
        NAMES.into_iter().zip(&pictures).map(curve),
        "Slerp Phong follows the circle itself, because its normal turns at the same rate on both sides.",
    );
    content.plot(plot.marked([JOINT]));
    Ok(())
}

fn jumps(content: &mut FigureContent) -> Result {
    let [gouraud, naive, slerp] = slope_jumps(ANGLES)?;
    let times = written(naive.abs() / gouraud.abs());
    content.contradicts(
        "naive-phong | naive Phong: jump of the slope at the joint",
        (naive, "grey levels per pixel", naive.abs() > gouraud.abs()),
        &format!("Phong shading is worse here: its jump is {times} times as large as Gouraud's."),
    );
    content.adds(
        "gouraud | Gouraud: jump of the slope at the joint",
        (gouraud, "grey levels per pixel", true),
        "Both chords are about equally steep, because the left facet reaches past the terminator.",
    );
    let has_none = slerp.abs() < 0.01 * naive.abs();
    content.adds(
        "slerp-phong | slerp Phong: jump of the slope at the joint",
        (slerp, "grey levels per pixel", has_none),
        "None: at uniform speed the normal follows the circle.",
    );
    let expected = closed_form(ANGLES);
    let is_near = (naive - expected).abs() < 0.02 * expected.abs();
    content.adds(
        "closed-form | naive Phong: the jump by the formula 255 sin θ (sin φ₂ / l₂ − sin φ₁ / l₁)",
        (expected, "grey levels per pixel", is_near),
        "The engine draws what the formula says.",
    );
    Ok(())
}

/// Measures the jumps for other angles of the left facet.
fn sweep(content: &mut FigureContent) -> Result {
    let right = ANGLES[1];
    let angles = || (1..=9).map(|i| 10.0 * f64::from(i));
    let mut curves = NAMES.map(|name| Series::new(name, []));
    for left in angles() {
        for (curve, jump) in curves.iter_mut().zip(slope_jumps([left, right])?) {
            curve.points.push((left, jump));
        }
    }
    let formula = |left| closed_form([left, right]);
    let formula = Series::sampled("closed form of naive Phong", angles(), formula);
    let angle = format!("angle of the left facet, degrees (the right one: {right}°)");
    content.plot(Plot::new(
        "Jump of the slope, by the angle of the left facet",
        [linear(angle), linear("jump of the slope, levels per pixel")],
        curves.into_iter().chain([formula]),
        "Where both angles are equal, naive Phong has no jump. Gouraud's jump comes from its chords, \
         and happens to vanish where the left facet reaches far past the terminator.",
    ));
    Ok(())
}
