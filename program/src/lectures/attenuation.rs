//! How lights weaken with distance, and the floors that they light (CS171 2, Attenuation; L5, Light
//! falloff).

use super::prelude::*;

pub(super) static FIGURE: Figure = Figure {
    name: "attenuation",
    title: "Lights that grow weaker",
    lecture: "CS171 2, Attenuation; L5, Light falloff",
    parts: &[curves, floors],
    live: None,
};

/// The falloffs and their names.
const FALLOFFS: [(&str, Falloff); 6] = [
    ("no falloff", Falloff::None),
    ("1/(1 + 0.1 d²)", Falloff::Attenuation(0.1)),
    ("1/(1 + d²)", Falloff::Attenuation(1.0)),
    ("1/(1 + 10 d²)", Falloff::Attenuation(10.0)),
    ("1/r", Falloff::Inverse),
    ("1/r²", Falloff::InverseSquare),
];
/// Indices into [`FALLOFFS`]: 1/r² of Lecture 5, and 1/(1 + d²) of CS171's notes.
const OF_LECTURE: usize = 5;
const OF_NOTES: usize = 2;

/// The height of the light above a floor that reaches from −2 to 2.
const HEIGHT: f64 = 0.3;

fn strength(falloff: Falloff, r: f64) -> f64 {
    match falloff {
        Falloff::None => 1.0,
        Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * r * r),
        Falloff::InverseSquare => 1.0 / (r * r),
        Falloff::Inverse => 1.0 / r,
    }
}

/// Draws a white floor under one light close to it. The camera looks straight down.
fn floor(falloff: Falloff, intensity: f32) -> Result<LinearPicture> {
    let sheet = "corrugated?waves=0&amplitude=0&segments=8&rows=8";
    let mut scene = scene(sheet, DULL, DVec3::Z, 2.0, [96, 96])?;
    scene.objects[0].transform = DAffine3::from_scale(DVec3::new(2.5, 2.5, 1.0));
    let position = DVec3::new(0.0, 0.0, HEIGHT);
    scene.lights = vec![Light::positional(position, [intensity; 3]).with_falloff(falloff)];
    draw(&scene.frame()?, "duff-phong")
}

/// Returns how many per cent of a picture are darker than `levels` grey levels.
fn below(levels: f32, picture: &LinearPicture) -> f64 {
    100.0 * share(picture, |pixel| pixel[0] < levels / 255.0)
}

fn curves(content: &mut FigureContent) -> Result {
    let distances = || (0..=60).map(|i| libm::pow(10.0, -1.5 + 2.5 * f64::from(i) / 60.0));
    content.plot(Plot::new(
        "The strength of a light over the distance",
        [log("distance"), log("strength")],
        FALLOFFS[1..]
            .iter()
            .map(|&(label, falloff)| Series::sampled(label, distances(), |r| strength(falloff, r))),
        "Far from the light, all but 1/r fall alike. Close to it, only those with 1 + never exceed 1.",
    ));
    Ok(())
}

fn floors(content: &mut FigureContent) -> Result {
    content.text(format!(
        "A white floor of 4 by 4, lit by a light of strength 1 at height {HEIGHT}. Toward the rim the \
         light falls at a flatter angle, so that the cosine darkens it as well."
    ));
    let (mut panels, mut rows, mut clipped) = (Vec::new(), Vec::new(), Vec::new());
    for (label, falloff) in FALLOFFS {
        let picture = floor(falloff, 1.0)?;
        let white = 100.0 * share(&picture, |pixel| pixel[0] >= 1.0);
        let cells = [white, below(1.0, &picture), below(10.0, &picture)]
            .map(|share| format!("{} %", written(share)));
        rows.push(format!("{label} | {}", cells.join(" | ")));
        clipped.push(white);
        panels.push((label, stored(&picture)));
    }
    let subject = "A floor seen from above, a light close above its middle";
    content.pictures(3, subject, panels);
    content.table(
        "falloff | clipped to white | under one level | under ten levels",
        rows,
    );
    content.confirms(
        "clipped | share of the floor that 1/r² clips to white",
        (clipped[OF_LECTURE], "%", clipped[OF_LECTURE] > 1.0),
        "\"Tends to look bad\": near the light the floor is brighter than a picture can hold.",
    );
    content.confirms(
        "clipped-notes | share of the floor that 1/(1 + d²) clips to white",
        (clipped[OF_NOTES], "%", clipped[OF_NOTES] == 0.0),
        "None: this falloff never exceeds 1.",
    );
    // At the point below the light r is HEIGHT, so that this intensity reaches exactly 1 there.
    let dim = floor(Falloff::InverseSquare, (HEIGHT * HEIGHT) as f32)?;
    let dark = below(1.0, &dim);
    let unattenuated = below(1.0, &floor(Falloff::None, 1.0)?);
    content.confirms(
        "dark | share of the floor under one level, by 1/r² and a light too dim to clip anything",
        (dark, "%", dark > 20.0 && dark > unattenuated),
        "Much of the floor is black: local shading has no light from other surfaces.",
    );
    Ok(())
}
