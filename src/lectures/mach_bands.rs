//! Mach bands: jumps of the intensity and of its slope at the edges of polygons (L21 2–4).

use super::prelude::*;

pub(super) static FIGURE: Figure = Figure {
    name: "mach-bands",
    title: "Mach bands: jumps at the edges of polygons",
    lecture: "L21 2, 3, 4: \"this blurring eliminates Mach bands\"",
    parts: &[bands],
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [240, 32];
/// Radius of the cylinder, in pixels.
const RADIUS: f64 = 118.0;
/// Angles of the edges of the cylinder's facets from the middle, in degrees.
const FACETS: [f64; 6] = [-75.0, -45.0, -15.0, 15.0, 45.0, 75.0];
const METHODS: [&str; 4] = ["flat", "gouraud", "naive-phong", "slerp-phong"];

fn column(degrees: f64) -> f64 {
    f64::from(SIZE[0]) / 2.0 + RADIUS * libm::sin(degrees.to_radians())
}

/// Makes an upright cylinder seen from the side, whose facets meet at these angles, with its own
/// normals at the edges.
fn cylinder(angles: &[f64]) -> Result<Frame> {
    let facet = |pair: &[f64]| {
        let sides = [pair[0], pair[1]];
        let strip = ScreenPolygon::strip(sides.map(column), SIZE[1].into(), sides.map(toward));
        ScreenPolygon {
            normal: toward((pair[0] + pair[1]) / 2.0),
            ..strip
        }
    };
    let facets: Vec<_> = angles.windows(2).map(facet).collect();
    // No part of the cylinder is dark: a terminator would bend the profile of its own.
    let light = DVec3::new(0.2, 0.0, 0.98);
    frame(SIZE, grey(0.1, 0.6, 0.3, 12.0), light, &facets)
}

fn bands(content: &mut FigureContent) -> Result {
    let fine: Vec<f64> = (0..=300).map(|i| -75.0 + 0.5 * f64::from(i)).collect();
    let smooth = truth(&cylinder(&fine)?);
    let drawn = draw_each(&cylinder(&FACETS)?, METHODS)?;
    let drawn = METHODS.into_iter().zip(drawn);
    let pictures: Vec<_> = drawn.chain([("the cylinder", smooth)]).collect();
    content.text(
        "A cylinder of five facets of 30°, and its intensities along a scan line; the reference is \
         drawn on 300 facets. The eye exaggerates jumps of intensity and, less, of its slope: it \
         sees bands there although no intensity jumps (Mach; Phong 1975).",
    );
    let panels = pictures.iter().map(|(name, drawn)| (*name, stored(drawn)));
    content.pictures(2, "A cylinder of five facets", panels);
    let line = |(name, drawn)| (name, profile(&drawn, SIZE[1] as usize / 2));
    let profiles: Vec<(&str, Vec<f64>)> = pictures.into_iter().map(line).collect();
    curves(content, &profiles);
    numbers(content, &profiles);
    Ok(())
}

fn curves(content: &mut FigureContent, profiles: &[(&str, Vec<f64>)]) {
    // The background beside the cylinder is no part of it.
    let seen = libm::ceil(column(FACETS[0])) as usize..libm::floor(column(FACETS[5])) as usize;
    let inner = seen.start + 1..seen.end - 1;
    let marks = [1, 2, 3, 4].map(|i| column(FACETS[i]));
    let line = |(name, profile): &(&str, Vec<f64>)| {
        Series::new(*name, seen.clone().map(|i| (i as f64 + 0.5, profile[i])))
    };
    let intensity = Plot::new(
        "Intensity along a scan line",
        [linear("column, pixels"), linear("intensity, grey levels")],
        profiles.iter().map(line),
        "Flat shading jumps where facets meet; the others only bend.",
    );
    content.plot(intensity.marked(marks));
    let bend = |(name, profile): &(&str, Vec<f64>)| {
        let second = |i: usize| profile[i - 1] - 2.0 * profile[i] + profile[i + 1];
        Series::new(*name, inner.clone().map(|i| (i as f64 + 0.5, second(i))))
    };
    let bends = Plot::new(
        "Second difference along a scan line",
        ["column, pixels", "second difference, grey levels"].map(linear),
        profiles[1..].iter().map(bend),
        "The spikes at the edges are jumps of the slope. The cylinder itself has none.",
    );
    content.plot(bends.marked(marks));
}

/// Measures the largest jumps over the edges between facets.
fn numbers(content: &mut FigureContent, profiles: &[(&str, Vec<f64>)]) {
    let jumps = |profile: &[f64]| {
        let jumps = [1, 2, 3, 4].map(|i| jump(profile, column(FACETS[i])));
        let value = largest(jumps.map(|jump| jump.value.abs()));
        (value, largest(jumps.map(|jump| jump.slope.abs())))
    };
    let [methods @ .., (_, smooth)] = profiles else {
        return;
    };
    let (_, control) = jumps(smooth);
    content.adds(
        "slope-cylinder | the cylinder itself: largest jump of the slope",
        (control, "grey levels per pixel", true),
        "The measurement gives this much where nothing bends.",
    );
    let mut rows = Vec::new();
    for (name, profile) in methods {
        let (value, slope) = jumps(profile);
        rows.push(format!("{name} | {} | {}", written(value), written(slope)));
        let is_flat = *name == "flat";
        content.confirms(
            &format!("value-{name} | {name}: largest jump of the intensity"),
            (value, "grey levels", (value < 0.5) != is_flat),
            match is_flat {
                true => "The intensity jumps at edges.",
                false => "Intensities agree along common edges.",
            },
        );
        let is_smooth = slope < 4.0 * control;
        content.found(
            &format!("slope-{name} | {name}: largest jump of the slope"),
            (slope, "grey levels per pixel", true),
            match is_flat {
                true => Agreement::Adds,
                false => Agreement::if_holds(is_smooth),
            },
            match is_smooth {
                true => "No more than the cylinder itself has.",
                false => "The slope jumps at edges: Mach bands are weakened, not eliminated.",
            },
        );
    }
    content.table(
        "at the edges of facets | jump of intensity, levels | jump of slope, levels per pixel",
        rows,
    );
}
