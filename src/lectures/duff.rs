//! Duff's surprise: a joint of two polygons where Phong shading has a stronger Mach band than Gouraud shading.
//!
//! T. Duff, *Smoothly shaded renderings of polyhedral objects on raster displays*, SIGGRAPH 1979, says that there are
//! surfaces for which this is so. The example and its closed form are derived here.

use super::profile::{jump, profile};
use super::stage::{Corner, Facet, Grey, frame, stored, written};
use super::{Content, Figure, FigureError, Plot, Scale, Series, Shown};
use crate::frame::Frame;
use crate::picture::LinearPicture;
use crate::shading::Variant;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "duff",
    title: "Duff\u{2019}s surprise: where Phong shading bends more than Gouraud shading",
    lecture: "L21 4; Duff 1979",
    make,
};

/// Pixels a degree: each facet is as wide as its arc.
const PIXELS: f64 = 2.0;
/// Width of the pictures.
const WIDTH: u32 = 240;
/// The column where both facets meet.
const JOINT: f64 = 190.0;
/// The angles of the left and of the right facet, in degrees.
const ANGLES: [f64; 2] = [90.0, 20.0];
/// From the normal at the joint to the light, in degrees.
const LIGHT: f64 = 40.0;
/// The methods, and what they are called here.
const METHODS: [(&str, &str); 3] = [
    ("gouraud", "Gouraud"),
    ("naive-phong", "naive Phong"),
    ("slerp-phong", "slerp Phong"),
];

/// Two facets of one circle that meet at an angle of 0, left and right of it, each as wide as its arc.
fn circle([left, right]: [f64; 2]) -> Result<Frame, FigureError> {
    let corner = |degrees: f64, y: f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        Corner::new([JOINT + PIXELS * degrees, y], DVec3::new(sin, 0.0, cos))
    };
    let facet = |from: f64, to: f64| {
        Facet::new([
            corner(from, 0.0),
            corner(to, 0.0),
            corner(to, 24.0),
            corner(from, 24.0),
        ])
    };
    let (sin, cos) = libm::sincos(LIGHT.to_radians());
    frame(
        [WIDTH, 24],
        &Grey::dull(DVec3::new(sin, 0.0, cos)),
        &[facet(-left, 0.0), facet(0.0, right)],
    )
}

/// The jump of the slope of naive Phong shading at the joint in grey levels a pixel. Linear normals turn at the rate
/// sin φ / length at both ends of a facet, and the intensity is the cosine of the angle to the light:
///
/// ```text
/// 255 sin θ (sin φ₂ / l₂ − sin φ₁ / l₁)
/// ```
fn closed_form([left, right]: [f64; 2]) -> f64 {
    let rate = |degrees: f64| libm::sin(degrees.to_radians()) / (PIXELS * degrees);
    255.0 * libm::sin(LIGHT.to_radians()) * (rate(right) - rate(left))
}

fn picture(method: &str, angles: [f64; 2]) -> Result<LinearPicture, FigureError> {
    Ok(Variant::parse(method)?.render_linear(&circle(angles)?))
}

fn slope_jump(method: &str, angles: [f64; 2]) -> Result<f64, FigureError> {
    Ok(jump(&profile(&picture(method, angles)?, 12), JOINT).slope)
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let [left, right] = ANGLES;
    content.text(format!(
        "Two facets of one circle, of {left}° and {right}°, each as wide on the screen as its arc, so that the intensity \
         of the circle itself does not bend where they meet. The light stands {LIGHT}° from the normal there. Linear \
         normals of a facet turn slower at its ends than in its middle, the more so the larger its angle: at the joint \
         the rates differ, and the intensity bends.",
    ));
    let mut shown = Vec::new();
    let mut series = Vec::new();
    let seen = (JOINT - PIXELS * left) as usize..(JOINT + PIXELS * right) as usize;
    for (method, name) in METHODS {
        let drawn = picture(method, ANGLES)?;
        let line = profile(&drawn, 12);
        series.push(Series::new(
            name,
            seen.clone().map(|i| (i as f64 + 0.5, line[i])),
        ));
        shown.push(Shown::new(
            name,
            format!("The two facets shaded by {name}."),
            stored(&drawn),
        ));
    }
    content.pictures(2, shown);
    content.plot(Plot {
        title: "Intensity over two facets of one circle".into(),
        x: ("column, pixels".into(), Scale::Linear),
        y: ("intensity, grey levels".into(), Scale::Linear),
        series,
        marks: [JOINT].into(),
        caption: "Slerp Phong follows the circle itself: it turns at a uniform rate on both sides."
            .into(),
    });
    jumps(&mut content)?;
    sweep(&mut content)?;
    Ok(content)
}

fn jumps(content: &mut Content) -> Result<(), FigureError> {
    let jumps = METHODS.map(|(method, _)| slope_jump(method, ANGLES));
    let [gouraud, naive, slerp] = jumps;
    let (gouraud, naive, slerp, expected) = (gouraud?, naive?, slerp?, closed_form(ANGLES));
    let unit = "grey levels a pixel";
    let is_surprise = naive.abs() > gouraud.abs();
    content.claim(
        "naive-phong",
        "naive Phong: jump of the slope at the joint",
        (naive, unit),
        !is_surprise,
        [
            String::from("Less than that of Gouraud shading."),
            format!(
                "{} times that of Gouraud shading: here Phong shading is the worse one.",
                written(naive.abs() / gouraud.abs())
            ),
        ],
    );
    content.adds("gouraud", "Gouraud: jump of the slope at the joint", (gouraud, unit), "The left facet reaches beyond the terminator, and its chord is about as steep as that of the right one.");
    content.adds(
        "slerp-phong",
        "slerp Phong: jump of the slope at the joint",
        (slerp, unit),
        if slerp.abs() < 0.01 * naive.abs() {
            "None: uniform speed follows the circle."
        } else {
            "There is one."
        },
    );
    let is_near = (naive - expected).abs() < 0.02 * expected.abs();
    content.adds(
        "closed-form",
        "naive Phong: the same by 255 sin θ (sin φ₂ / l₂ − sin φ₁ / l₁)",
        (expected, unit),
        if is_near {
            "The engine draws what the formula says."
        } else {
            "The engine draws something else."
        },
    );
    Ok(())
}

/// The same for other angles of the left facet.
fn sweep(content: &mut Content) -> Result<(), FigureError> {
    let angles: Vec<f64> = (1..=9).map(|i| 10.0 * f64::from(i)).collect();
    let mut series = Vec::new();
    for (method, name) in METHODS {
        let points = angles
            .iter()
            .map(|&left| Ok((left, slope_jump(method, [left, ANGLES[1]])?)));
        series.push(Series::new(
            name,
            points.collect::<Result<Vec<_>, FigureError>>()?,
        ));
    }
    let formula = angles
        .iter()
        .map(|&left| (left, closed_form([left, ANGLES[1]])));
    series.push(Series::new("closed form of naive Phong", formula));
    content.plot(Plot {
        title: "Jump of the slope over the angle of the left facet".into(),
        x: (format!("angle of the left facet, degrees (the right one: {}°)", ANGLES[1]), Scale::Linear),
        y: ("jump of the slope, levels a pixel".into(), Scale::Linear),
        series,
        marks: Vec::new(),
        caption:
            "Equal angles: no jump for naive Phong. The jump of Gouraud shading comes from its chords, which cut off \
                  the circle; where the left facet reaches far beyond the terminator it happens to vanish."
                .into(),
    });
    Ok(())
}
