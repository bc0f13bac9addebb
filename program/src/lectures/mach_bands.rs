//! Mach bands: jumps of the intensity and of its slope at the edges of polygons (L21 2–4).

use super::prelude::*;
use core::ops::Range;

pub(super) static FIGURE: Figure = Figure {
    name: "mach-bands",
    title: "Mach bands: jumps at the edges of polygons",
    lecture: "L21 2, 3, 4: \"this blurring eliminates Mach bands\"",
    parts: &[bands],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "\u{201c}This blurring eliminates Mach bands\u{201d} (L21 3): each pixel is the previous one plus ΔI (3.6), so nothing jumps where facets meet.",
    handles: &[Handle::slider(
        ["facets", "facets of the cylinder", ""],
        [2.0, 15.0],
        1.0,
        5.0,
    )],
    make: |content, values| shown(content, &facets(values[0] as usize)),
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [240, 32];
/// The radius of the cylinder, in pixels.
const RADIUS: f64 = 118.0;
/// How many facets the cylinder has.
const FACETS: usize = 5;
const METHODS: [&str; 4] = ["flat", "gouraud", "naive-phong", "slerp-phong"];

/// Returns the angles of the edges of `count` facets, in degrees from the middle.
fn facets(count: usize) -> Vec<f64> {
    let part = |i| i as f64 / count as f64;
    (0..=count).map(|i| 150.0 * part(i) - 75.0).collect()
}

/// Returns the column of an angle on the cylinder, in pixels.
fn column(degrees: f64) -> f64 {
    f64::from(SIZE[0]) / 2.0 + RADIUS * libm::sin(degrees.to_radians())
}

/// Makes an upright cylinder seen from the side. Its facets meet at these angles, with the
/// cylinder's normals there.
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
    // Light reaches the whole cylinder: a terminator would bend the profile as well.
    let light = DVec3::new(0.2, 0.0, 0.98);
    frame(SIZE, grey(0.1, 0.6, 0.3, 12.0), light, &facets)
}

fn bands(content: &mut FigureContent) -> Result {
    content.text(
        "A cylinder of five facets of 30°, and its intensities along a scan line. The reference is drawn \
         on 300 facets. The eye exaggerates jumps of intensity and, less strongly, jumps of its slope. \
         So it sees bands even where no intensity jumps (Mach; Phong 1975).",
    );
    shown(content, &facets(FACETS))
}

/// Shows a cylinder whose facets meet at these angles, and measures the jumps there.
fn shown(content: &mut FigureContent, angles: &[f64]) -> Result {
    let fine: Vec<f64> = (0..=300).map(|i| -75.0 + 0.5 * f64::from(i)).collect();
    let smooth = truth(&cylinder(&fine)?);
    let drawn = draw_each(&cylinder(angles)?, METHODS)?;
    let drawn = METHODS.into_iter().zip(drawn);
    let pictures: Vec<_> = drawn.chain([("the cylinder", smooth)]).collect();
    let panels = pictures.iter().map(|(name, drawn)| (*name, stored(drawn)));
    content.pictures(2, "A cylinder of facets", panels);
    let line = |(name, drawn)| (name, profile(&drawn, SIZE[1] as usize / 2));
    let profiles: Vec<(&str, Vec<f64>)> = pictures.into_iter().map(line).collect();
    // Leave out the background beside the cylinder.
    let seen = libm::ceil(column(-75.0)) as usize..libm::floor(column(75.0)) as usize;
    let edges: Vec<f64> = angles[1..angles.len() - 1]
        .iter()
        .map(|a| column(*a))
        .collect();
    curves(content, &profiles, &edges, seen);
    measure_jumps(content, &profiles, &edges);
    Ok(())
}

fn curves(
    content: &mut FigureContent,
    profiles: &[(&str, Vec<f64>)],
    edges: &[f64],
    seen: Range<usize>,
) {
    let inner = seen.start + 1..seen.end - 1;
    let line = |(name, profile): &(&str, Vec<f64>)| {
        Series::new(*name, seen.clone().map(|i| (i as f64 + 0.5, profile[i])))
    };
    let intensity = Plot::new(
        "Intensity along a scan line",
        [linear("column, pixels"), linear("intensity, grey levels")],
        profiles.iter().map(line),
        "Flat shading jumps where facets meet. The others only bend.",
    );
    content.plot(intensity.marked(edges));
    let bend = |(name, profile): &(&str, Vec<f64>)| {
        let second = |i: usize| profile[i - 1] - 2.0 * profile[i] + profile[i + 1];
        Series::new(*name, inner.clone().map(|i| (i as f64 + 0.5, second(i))))
    };
    let bends = Plot::new(
        "Second difference along a scan line",
        ["column, pixels", "second difference, grey levels"].map(linear),
        profiles[1..].iter().map(bend),
        "Each spike at an edge is a jump of the slope. The cylinder itself has none.",
    );
    content.plot(bends.marked(edges));
}

/// Measures the largest jumps at the edges between facets.
fn measure_jumps(content: &mut FigureContent, profiles: &[(&str, Vec<f64>)], edges: &[f64]) {
    let jumps = |profile: &[f64]| {
        let jumps = || edges.iter().map(|edge| jump(profile, *edge));
        let value = largest(jumps().map(|jump| jump.value.abs()));
        (value, largest(jumps().map(|jump| jump.slope.abs())))
    };
    let [methods @ .., (_, smooth)] = profiles else {
        return;
    };
    let (_, control) = jumps(smooth);
    content.adds(
        "slope-cylinder | the cylinder itself: largest jump of the slope",
        (control, "grey levels per pixel", true),
        "This is what the measurement returns where nothing bends.",
    );
    let mut rows = Vec::new();
    for (name, profile) in methods {
        let (value, slope) = jumps(profile);
        rows.push(format!("{name} | {} | {}", written(value), written(slope)));
        let is_flat = *name == "flat";
        content.confirms(
            &format!("value-{name} | {name}: largest jump of the intensity"),
            (value, "grey levels", (value < 0.5) != is_flat),
            if is_flat {
                "The intensity jumps at edges."
            } else {
                "Along common edges the intensities agree."
            },
        );
        let is_smooth = slope < 4.0 * control;
        content.found(
            &format!("slope-{name} | {name}: largest jump of the slope"),
            (slope, "grey levels per pixel", true),
            if is_flat {
                Agreement::Adds
            } else {
                Agreement::if_holds(is_smooth)
            },
            if is_smooth {
                "It is no larger than on the cylinder itself."
            } else {
                "The slope jumps at edges: Mach bands are weakened, not eliminated."
            },
        );
    }
    content.table(
        "at the edges of facets | jump of intensity, levels | jump of slope, levels per pixel",
        rows,
    );
}
