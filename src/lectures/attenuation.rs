//! Falloffs over the distance, and floors that they light (CS171 2, Attenuation; L5, Light falloff).

use super::lit::{drawn, grey, scene, share, shown};
use super::stage::written;
use super::{Agreement, Content, Figure, FigureError, Finding, Plot, Scale, Series};
use crate::mesh::builtin::builtin;
use crate::picture::LinearPicture;
use crate::scene::{Falloff, Light};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use glam::{DAffine3, DVec3};

pub(super) static FIGURE: Figure = Figure {
    name: "attenuation",
    title: "Lights that grow weaker",
    lecture: "CS171 2, Attenuation; L5, Light falloff",
    make,
};

/// What is compared, and what it is called.
const FALLOFFS: [(&str, Falloff); 6] = [
    ("no falloff", Falloff::None),
    ("1/(1 + 0.1 d²)", Falloff::Attenuation(0.1)),
    ("1/(1 + d²)", Falloff::Attenuation(1.0)),
    ("1/(1 + 10 d²)", Falloff::Attenuation(10.0)),
    ("1/r", Falloff::Inverse),
    ("1/r²", Falloff::InverseSquare),
];
const OF_LECTURE: usize = 5;
const OF_NOTES: usize = 2;

/// How high the light stands above a floor that reaches from −2 to 2.
const HEIGHT: f64 = 0.3;

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.plot(Plot {
        title: "What is left of a light of strength 1".into(),
        x: ("distance".into(), Scale::Log),
        y: ("strength".into(), Scale::Log),
        series: FALLOFFS[1..].iter().map(|&(label, falloff)| curve(label, falloff)).collect(),
        marks: Vec::new(),
        caption: "Far away all but 1/r fall alike; near the light only those with 1 + stay at 1 or below.".into(),
    });
    floors(&mut content)?;
    Ok(content)
}

fn strength(falloff: Falloff, r: f64) -> f64 {
    match falloff {
        Falloff::None => 1.0,
        Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * r * r),
        Falloff::InverseSquare => 1.0 / (r * r),
        Falloff::Inverse => 1.0 / r,
    }
}

fn curve(label: &str, falloff: Falloff) -> Series {
    let distance = |i: i32| libm::pow(10.0, -1.5 + 2.5 * f64::from(i) / 60.0);
    Series::new(
        label,
        (0..=60).map(|i| (distance(i), strength(falloff, distance(i)))),
    )
}

/// A white floor under one light close to it, seen from straight above.
fn floor(falloff: Falloff, intensity: f32) -> Result<LinearPicture, FigureError> {
    let sheet = builtin("corrugated?waves=0&amplitude=0&segments=8&rows=8")?;
    let mut scene = scene(sheet, grey(0.0, 1.0, 0.0, 1.0), DVec3::Z, 2.0, [96, 96]);
    for object in &mut scene.objects {
        object.transform = DAffine3::from_scale(DVec3::new(2.5, 2.5, 1.0));
    }
    let position = DVec3::new(0.0, 0.0, HEIGHT);
    scene.lights = [Light {
        falloff,
        ..Light::positional(position, [intensity; 3])
    }]
    .into();
    drawn(&scene, "duff-phong")
}

fn floors(content: &mut Content) -> Result<(), FigureError> {
    let (mut pictures, mut shares) = (Vec::new(), Vec::new());
    for (label, falloff) in FALLOFFS {
        let picture = floor(falloff, 1.0)?;
        let clipped = share(&picture, |texel| texel[0] >= 1.0);
        let black = share(&picture, |texel| texel[0] < 1.0 / 255.0);
        let dark = share(&picture, |texel| texel[0] < 10.0 / 255.0);
        pictures.push(shown(
            "A floor seen from above, a light close above its middle",
            label,
            &picture,
        ));
        shares.push((clipped, black, dark));
    }
    content.text(format!(
        "A white floor of 4 by 4, and a light of strength 1 at the height {HEIGHT}. The cosine makes the rim dark under \
         every falloff."
    ));
    content.pictures(3, pictures);
    let percent = |share: f64| format!("{} %", written(100.0 * share));
    let row = |i: usize| {
        let (clipped, black, dark) = shares[i];
        [
            FALLOFFS[i].0.to_string(),
            percent(clipped),
            percent(black),
            percent(dark),
        ]
        .into()
    };
    content.table(
        &[
            "falloff",
            "clipped to white",
            "under one level",
            "under ten levels",
        ],
        (0..6).map(row).collect(),
    );
    let of = |i: usize| shares[i];
    let looks_bad = of(OF_LECTURE).0 > 0.01;
    content.claim(
        "clipped",
        "share of the floor that 1/r² clips to white",
        (100.0 * of(OF_LECTURE).0, "%"),
        looks_bad,
        [
            "\"Tends to look bad\": near the light there is more of it than a picture can hold.",
            "Nothing worth mention is clipped.",
        ],
    );
    content.found(Finding::new(
        "clipped-notes",
        "share of the floor that 1/(1 + d²) clips to white",
        (100.0 * of(OF_NOTES).0, "%"),
        Agreement::if_holds(of(OF_NOTES).0 == 0.0),
        String::from(if of(OF_NOTES).0 == 0.0 {
            "None: it is at most 1."
        } else {
            "Some, though it is at most 1."
        }),
    ));
    dimmed(content)
}

/// 1/r² with a light so dim that nothing is clipped.
fn dimmed(content: &mut Content) -> Result<(), FigureError> {
    let picture = floor(Falloff::InverseSquare, (HEIGHT * HEIGHT) as f32)?;
    let dark = share(&picture, |texel| texel[0] < 1.0 / 255.0);
    let plain = share(&floor(Falloff::None, 1.0)?, |texel| texel[0] < 1.0 / 255.0);
    let is_dark = dark > 0.2 && dark > plain;
    content.claim("dark", "share of the floor under one level, 1/r² with a light too dim to clip anything", (100.0 * dark, "%"), is_dark, ["Dimmed until nothing is clipped, 1/r² leaves much of the floor black: local shading has no light from elsewhere.", "Dimmed, 1/r² leaves the floor visible."]);
    Ok(())
}
