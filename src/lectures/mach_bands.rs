//! Mach bands: what is left of them at the edges of polygons (L21 2–4).

use super::profile::{Jump, jump, profile};
use super::stage::{Corner, Facet, Grey, frame, stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Plot, Scale, Series, Shown};
use crate::frame::Frame;
use crate::picture::LinearPicture;
use crate::reference::{self, Model};
use crate::shading::Variant;
use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "mach-bands",
    title: "Mach bands: what is left of them at the edges",
    lecture: "L21 2, 3, 4: \"this blurring eliminates Mach bands\"",
    make,
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [240, 32];
/// Radius of the cylinder, in pixels.
const RADIUS: f64 = 118.0;
/// The edges of the cylinder's facets stand at these angles from the middle, in degrees.
const FACETS: [f64; 6] = [-75.0, -45.0, -15.0, 15.0, 45.0, 75.0];
/// The methods whose profiles are compared.
const METHODS: [&str; 4] = ["flat", "gouraud", "naive-phong", "slerp-phong"];

fn column(degrees: f64) -> f64 {
    f64::from(SIZE[0]) / 2.0 + RADIUS * libm::sin(degrees.to_radians())
}

/// An upright cylinder seen from the side, whose facets meet at these angles, with its own normals at the edges.
fn cylinder(angles: &[f64]) -> Result<Frame, FigureError> {
    let normal = |degrees: f64| {
        let (sin, cos) = libm::sincos(degrees.to_radians());
        DVec3::new(sin, 0.0, cos)
    };
    let facets: Vec<Facet> = angles
        .windows(2)
        .map(|pair| {
            let corner = |degrees: f64, y: f64| Corner::new([column(degrees), y], normal(degrees));
            let bottom = f64::from(SIZE[1]);
            let [left, right] = [pair[0], pair[1]];
            let corners = [
                corner(left, 0.0),
                corner(right, 0.0),
                corner(right, bottom),
                corner(left, bottom),
            ];
            Facet {
                normal: normal((left + right) / 2.0),
                ..Facet::new(corners)
            }
        })
        .collect();
    // No part of the cylinder is dark: a terminator would bend the profile of its own.
    let light = DVec3::new(0.2, 0.0, 0.98);
    frame(
        SIZE,
        &Grey {
            light,
            ambient: 0.1,
            diffuse: 0.6,
            specular: 0.3,
            shininess: 12.0,
        },
        &facets,
    )
}

/// The largest jump of value, and of slope, over the edges between facets.
fn largest(profile: &[f64]) -> Jump {
    let mut most = Jump {
        value: 0.0,
        slope: 0.0,
    };
    for degrees in &FACETS[1..FACETS.len() - 1] {
        let here = jump(profile, column(*degrees));
        most = Jump {
            value: most.value.max(here.value.abs()),
            slope: most.slope.max(here.slope.abs()),
        };
    }
    most
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    let coarse = cylinder(&FACETS)?;
    let fine: Vec<f64> = (0..=300).map(|i| -75.0 + 0.5 * f64::from(i)).collect();
    let smooth = reference::render(&cylinder(&fine)?, Model::Phong).to_linear();
    let mut pictures: Vec<(&str, LinearPicture)> = Vec::new();
    for method in METHODS {
        pictures.push((method, Variant::parse(method)?.render_linear(&coarse)));
    }
    pictures.push(("the cylinder", smooth));

    content.text(
        "A cylinder of five facets of 30°, and its intensities along a scan line; the cylinder itself is the reference on \
         300 facets. Lines stand where facets meet. The eye exaggerates jumps of intensity, and also, less, jumps of its \
         slope: bands are seen there although no intensity jumps (Mach; Phong 1975).",
    );
    let shown = pictures.iter().map(|(name, picture)| {
        Shown::new(
            *name,
            format!("A cylinder of five facets: {name}."),
            stored(picture),
        )
    });
    content.pictures(2, shown.collect());
    let profiles: Vec<(&str, Vec<f64>)> = pictures
        .iter()
        .map(|(name, picture)| (*name, profile(picture, SIZE[1] as usize / 2)))
        .collect();
    curves(&mut content, &profiles);
    numbers(&mut content, &profiles);
    Ok(content)
}

fn curves(content: &mut Content, profiles: &[(&str, Vec<f64>)]) {
    // The background beside the cylinder is no part of it.
    let seen = libm::ceil(column(FACETS[0])) as usize..libm::floor(column(FACETS[5])) as usize;
    let marks: Vec<f64> = FACETS[1..5]
        .iter()
        .map(|degrees| column(*degrees))
        .collect();
    let line = |(name, profile): &(&str, Vec<f64>)| {
        Series::new(*name, seen.clone().map(|i| (i as f64 + 0.5, profile[i])))
    };
    content.plot(Plot {
        title: "Intensity along a scan line".into(),
        x: ("column, pixels".into(), Scale::Linear),
        y: ("intensity, grey levels".into(), Scale::Linear),
        series: profiles.iter().map(line).collect(),
        marks: marks.clone(),
        caption: "Flat shading jumps where facets meet; the others only bend.".to_string(),
    });
    let bend = |(name, profile): &(&str, Vec<f64>)| {
        let second = |i: usize| profile[i - 1] - 2.0 * profile[i] + profile[i + 1];
        Series::new(
            *name,
            (seen.start + 1..seen.end - 1).map(|i| (i as f64 + 0.5, second(i))),
        )
    };
    content.plot(Plot {
        title: "Second difference along a scan line".into(),
        x: ("column, pixels".into(), Scale::Linear),
        y: ("second difference, grey levels".into(), Scale::Linear),
        series: profiles[1..].iter().map(bend).collect(),
        marks,
        caption: "The spikes at the edges are jumps of the slope. The cylinder itself has none."
            .to_string(),
    });
}

fn numbers(content: &mut Content, profiles: &[(&str, Vec<f64>)]) {
    let [methods @ .., (_, smooth)] = profiles else {
        return;
    };
    // What the measurement itself makes of a curve that does not bend.
    let control = largest(smooth);
    content.adds(
        "slope-cylinder",
        "the cylinder itself: largest jump of the slope",
        (control.slope, "grey levels a pixel"),
        "What the measurement gives where nothing bends.",
    );
    let mut rows = Vec::new();
    for (name, profile) in methods {
        let found = largest(profile);
        rows.push(Vec::from([
            name.to_string(),
            written(found.value),
            written(found.slope),
        ]));
        let is_continuous = found.value < 0.5;
        content.found(Finding::new(
            format!("value-{name}"),
            format!("{name}: largest jump of the intensity"),
            (found.value, "grey levels"),
            Agreement::if_holds(is_continuous == (*name != "flat")),
            if is_continuous {
                "Intensities agree along common edges."
            } else {
                "The intensity jumps at edges."
            },
        ));
        let is_smooth = found.slope < 4.0 * control.slope;
        content.found(Finding::new(
            format!("slope-{name}"),
            format!("{name}: largest jump of the slope"),
            (found.slope, "grey levels a pixel"),
            if *name == "flat" {
                Agreement::Adds
            } else {
                Agreement::if_holds(is_smooth)
            },
            if is_smooth {
                "No more than the cylinder itself has."
            } else {
                "The slope jumps at edges: what makes a Mach band is weakened, not eliminated."
            },
        ));
    }
    content.table(
        &[
            "at the edges of facets",
            "jump of intensity, levels",
            "jump of slope, levels a pixel",
        ],
        rows,
    );
}
