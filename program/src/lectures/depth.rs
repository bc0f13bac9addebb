//! Depth buffers: two ways to compute depth, and how far 16, 24 and 32 bits reach (L5).

use super::prelude::*;
use fastphong::raster::depth;
use fastphong::scene::{DepthBits, DepthBuffer, DepthSource, HiddenSurfaces};

pub(super) static FIGURE: Figure = Figure {
    name: "depth",
    title: "Depth: two ways to compute it, and 16, 24 or 32 bits to store it",
    lecture: "L5, Z-buffer, Z-value Computation",
    parts: &[fighting, ways, curve],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "Depth is stored in 16 to 32 bits, z ↦ (f + n)/(f − n) + (1/z) 2fn/(f − n). The closer the near plane, the fewer levels are left for distant surfaces (L5).",
    handles: &[
        Handle::slider(["bits", "bits of depth", ""], [16.0, 32.0], 8.0, 16.0),
        Handle::slider(
            [
                "near",
                "near plane, as a multiple of its distance in the figure",
                "",
            ],
            [1.0, 25.0],
            1.0,
            1.0,
        ),
    ],
    make: |content, values| {
        let (count, bits) = BITS[((values[0] - 16.0) / 8.0) as usize];
        let drawn = |bits| {
            draw(
                &far_away(bits, DepthSource::Interpolated, values[1])?,
                "flat",
            )
        };
        let (picture, full) = (drawn(bits)?, drawn(DepthBits::ThirtyTwo)?);
        let wrong = differing(&picture, &full);
        content.pictures(
            2,
            "A star above a floor, depth",
            [
                (format!("{count} bits"), stored(&picture)),
                ("32 bits".into(), stored(&full)),
            ],
        );
        content.plot(over_distance(&[1.0, values[1]])?);
        fights(content, count, wrong);
        Ok(())
    },
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [160, 120];

/// The widths of L5, "16 to 32 bits".
const BITS: [(u32, DepthBits); 3] = [
    (16, DepthBits::Sixteen),
    (24, DepthBits::TwentyFour),
    (32, DepthBits::ThirtyTwo),
];

/// Makes a frame of a star a little above a floor, far from the eye. The near plane is `near` times
/// as far away as in the scene.
fn far_away(bits: DepthBits, source: DepthSource, near: f64) -> Result<Frame> {
    let mut scene = shipped("z-fighting", SIZE)?;
    scene.camera.near *= near;
    scene.hidden_surfaces = HiddenSurfaces::ZBuffer(DepthBuffer { bits, source });
    Ok(scene.frame()?)
}

/// Draws a star a little above a floor. With too few bits both have the same depth.
fn fighting(content: &mut FigureContent) -> Result {
    content.text(
        "A star a little above a floor, far from the eye. Where few bits round both depths to the same \
         value, the floor shows through: z-fighting.",
    );
    let (mut pictures, mut panels) = (Vec::new(), Vec::new());
    for (count, bits) in BITS {
        let picture = draw(&far_away(bits, DepthSource::Interpolated, 1.0)?, "flat")?;
        panels.push((format!("{count} bits"), stored(&picture)));
        pictures.push(picture);
    }
    content.pictures(3, "A star above a floor, depth", panels);
    for ((bits, _), picture) in BITS.iter().zip(&pictures[..2]) {
        let wrong = differing(picture, &pictures[2]);
        fights(content, *bits, wrong);
    }
    Ok(())
}

/// Adds the finding that `bits` bits show `wrong` pixels differently than 32 bits.
fn fights(content: &mut FigureContent, bits: u32, wrong: usize) {
    let enough = if wrong > 0 { "too few" } else { "enough" };
    content.adds(
        &format!("fighting-{bits} | pixels that {bits} bits show differently than 32"),
        (wrong as f64, "pixels", true),
        &format!("{bits} bits are {enough} here."),
    );
}

/// Compares depth interpolated between corners with depth computed at each sample.
fn ways(content: &mut FigureContent) -> Result {
    let by = |source| far_away(DepthBits::ThirtyTwo, source, 1.0).map(|frame| depth(&frame));
    let (corners, samples) = (by(DepthSource::Interpolated)?, by(DepthSource::PerSample)?);
    let both = corners
        .pixels()
        .iter()
        .zip(samples.pixels())
        .filter(|(a, b)| a.is_finite() && b.is_finite());
    let difference = largest(both.map(|(a, b)| f64::from((a - b).abs())));
    // Either way rounds depths of up to 1 by 2⁻²⁵ at the corners and at each step along an edge and
    // a span. The second way scales 1/w by f/(f − n), which is close to 1.
    let bound = 4.0 * (f64::from(SIZE[0] + SIZE[1]) + 4.0) / f64::from(1 << 25);
    content.confirms(
        "ways | largest difference between the depths computed in both ways",
        (difference, "", difference <= bound),
        "Apart from rounding both ways agree, because 1/z is linear on the screen.",
    );
    Ok(())
}

/// Returns depth over distance: `z ↦ (f + n)/(f − n) + (1/z) 2fn/(f − n)`, from −1 to 1 (L5, z
/// negative).
fn lecture_depth(distance: f64, near: f64, far: f64) -> f64 {
    let z = -distance;
    (far + near) / (far - near) + 2.0 * far * near / (far - near) / z
}

/// Plots depth over distance, for near planes that are `times` as far away as in the scene.
fn over_distance(times: &[f64]) -> Result<Plot> {
    let Camera { near, far, .. } = shipped("z-fighting", SIZE)?.camera;
    let reach = written(far);
    let curve = |near: f64| {
        let distances = (0..=60).map(|i| near * libm::pow(far / near, f64::from(i) / 60.0));
        let depth = |distance| 0.5 + 0.5 * lecture_depth(distance, near, far);
        Series::sampled(format!("near = {}", written(near)), distances, depth)
    };
    let distance = log("distance from the eye");
    Ok(Plot::new(
        "Depth over distance",
        [distance, linear("depth, 0 near to 1 far")],
        times.iter().map(|times| curve(times * near)),
        format!(
            "L5's formula, mapped to 0..1, for a far plane at {reach}. Only the order of z is \
             \"preserved after projection\". A closer near plane leaves fewer levels for distant \
             surfaces."
        ),
    ))
}

fn curve(content: &mut FigureContent) -> Result {
    content.plot(over_distance(&[1.0, 5.0, 25.0])?);
    let Camera { near, far, .. } = shipped("z-fighting", SIZE)?.camera;
    let reach = written(far);
    let half = 0.5 + 0.5 * lecture_depth(2.0 * near, near, far);
    let (twice, share) = (written(2.0 * near), 100.0 * half);
    content.adds(
        "half | part of the depth range used up at twice the near distance",
        (half, "", true),
        &format!(
            "Of all distances up to {reach}, those below {twice} use {share:.0} % of the levels."
        ),
    );
    let at = |i: u32| lecture_depth(near + (far - near) * f64::from(i) / 1000.0, near, far);
    let is_ordered = (1..1000).all(|i| at(i) < at(i + 1));
    let middle = lecture_depth(0.5 * far, near, far);
    let moved = (middle - (0.5 * far - near) / (far - near) * 2.0 + 1.0).abs();
    content.found(
        "preserved | depth half-way to the far plane: how far from the middle of the range, which is 2 long",
        (moved, "", true),
        Agreement::if_holds(moved < 1e-3),
        if moved < 1e-3 {
            "Depth is preserved."
        } else if is_ordered {
            "Depth preserves the order of distances and nothing else (\"preserved\", L5)."
        } else {
            "Depth does not even preserve the order."
        },
    );
    Ok(())
}
