//! Supersampling with a depth buffer: occlusion at each sample, and the filtered edge (L5).

use super::prelude::*;
use fastphong::frame::FrameBuilder;
use fastphong::picture::encoding::{srgb_encode, store};
use fastphong::picture::{Alpha, Encoding, Picture8};

pub(super) static FIGURE: Figure = Figure {
    name: "supersampling",
    title: "Supersampling with a depth buffer: the filtered edge",
    lecture: "L5, Z-buffer and Supersampling",
    parts: &[edge, filtering, cutting],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "Compute visibility and light at n × n samples per pixel, then their mean: a pixel on the edge shows how much of it the polygon covers (L5).",
    handles: &[Handle::slider(
        ["doublings", "doublings of the samples along a side", ""],
        [1.0, 3.0],
        1.0,
        2.0,
    )],
    make: |content, values| {
        let n = 1 << values[0] as u32;
        let (one, one_error) = green(1)?;
        let (many, error) = green(n)?;
        let caption = |n, error| format!("{n} × {n} samples: {}", written(error));
        content.pictures(
            2,
            "The edge of a green triangle",
            [(caption(1, one_error), one), (caption(n, error), many)],
        );
        content.confirms(
            &format!("share | error with one sample over error with {n} × {n}"),
            (one_error / error, "", error < one_error),
            MORE,
        );
        Ok(())
    },
};

const MORE: &str = "More samples, better edges: the depth test works for each sample.";

/// Samples per pixel along each side.
const SAMPLES: [u32; 4] = [1, 2, 4, 8];
/// Width and height of the pictures, so small that readers see their pixels.
const SIZE: [u32; 2] = [24, 18];
/// A green triangle, and the yellow polygon behind it, in pixels.
const TRIANGLE: [[f64; 2]; 3] = [[3.2, 1.3], [21.7, 8.1], [6.4, 16.6]];
const PLANE: [[f64; 2]; 4] = [[-1.0, -1.0], [25.0, -1.0], [25.0, 19.0], [-1.0, 19.0]];

/// A polygon: its colour, its depth, and its corners in pixels.
type Coloured<'a> = ([f32; 3], f64, &'a [[f64; 2]]);

/// Makes a frame of polygons with `samples` samples per pixel along each side.
fn frame(size: [u32; 2], samples: u32, polygons: &[Coloured<'_>]) -> Result<Frame> {
    let [width, height] = size.map(|side| side * samples);
    let mut builder = FrameBuilder::new(width, height);
    builder.samples(samples);
    for (index, (colour, depth, corners)) in polygons.iter().enumerate() {
        let material = Material {
            ambient: *colour,
            ..DULL
        };
        let material = builder.lighting(Lighting::new(&material, [1.0; 3], &[], DVec3::Z));
        let corner = |corner: &[f64; 2]| ScreenCorner {
            depth: *depth,
            ..ScreenCorner::new(corner.map(|c| c * f64::from(samples)), DVec3::Z)
        };
        let polygon = ScreenPolygon::new(corners.iter().map(corner).collect::<Vec<_>>());
        polygon.add(&mut builder, material, index);
    }
    let mut frame = builder.finish()?;
    frame.set_alpha(Alpha::Flattened);
    Ok(frame)
}

/// Draws the green triangle. Also returns the RMS error of its shares of the pixels.
fn green(samples: u32) -> Result<(Picture8, f64)> {
    let plane = ([1.0, 1.0, 0.0], 0.8, &PLANE[..]);
    let triangle = ([0.0, 1.0, 0.0], 0.2, &TRIANGLE[..]);
    let picture = draw(&frame(SIZE, samples, &[plane, triangle])?, "flat")?;
    let error = share_error(&picture);
    Ok((store(&picture, Encoding::Srgb), error))
}

fn edge(content: &mut FigureContent) -> Result {
    content.text(
        "A green triangle in front of a yellow plane, with n × n samples per pixel. Visibility and light \
         are computed at each sample, then averaged in linear light.",
    );
    let (mut panels, mut points) = (Vec::new(), Vec::new());
    for samples in SAMPLES {
        let (picture, error) = green(samples)?;
        points.push((f64::from(samples), error));
        let caption = format!("{samples} × {samples} samples: {}", written(error));
        panels.push((caption, picture));
    }
    content.pictures(SAMPLES.len(), "The edge of a green triangle", panels);
    let falls = points.is_sorted_by(|a, b| a.1 > b.1);
    content.confirms(
        "share | error with one sample over error with 8 × 8",
        (points[0].1 / points[3].1, "", falls),
        MORE,
    );
    content.plot(Plot::new(
        "RMS error of the triangle's share of a pixel",
        [log("samples along a side"), log("RMS error of shares")],
        [Series::new("measured", points)],
        "Compared with the exact area of the triangle in each pixel that its edges cross.",
    ));
    Ok(())
}

/// Draws a pixel that is half white and half black: it stores the mean of the light, not the mean
/// of stored levels.
fn filtering(content: &mut FigureContent) -> Result {
    let half = [[0.0, 0.0], [1.5, 0.0], [1.5, 2.0], [0.0, 2.0]];
    let picture = draw(&frame([2, 2], 2, &[([1.0; 3], 0.5, &half)])?, "flat")?;
    let level = f64::from(store(&picture, Encoding::Srgb).get(1, 0)[0]);
    let exact = f64::from(srgb_encode(0.5)) * 255.0;
    content.adds(
        "linear | stored level of a pixel that is half white and half black, sRGB",
        (level, "of 255", (level - exact).abs() <= 0.5),
        &format!("The mean is computed before encoding: half of the light is level {exact:.0}."),
    );
    Ok(())
}

/// Draws polygons that cut each other: the line where they meet is filtered like an edge.
fn cutting(content: &mut FigureContent) -> Result {
    let mut scene = shipped("interpenetration", [120, 90])?;
    let mut panels = Vec::new();
    for samples in [1, 4] {
        scene.samples = samples;
        let mut frame = scene.frame()?;
        frame.set_alpha(Alpha::Flattened);
        let picture = store(&draw(&frame, "flat")?, scene.encoding);
        panels.push((format!("{samples} × {samples} samples"), picture));
    }
    content.pictures(2, "Polygons that cut each other", panels);
    Ok(())
}

/// Returns which part of the unit square at `corner` lies in the triangle: the edges cut the
/// square, and the shoelace formula measures the rest.
fn share(corner: DVec2) -> f64 {
    let mut shape = Vec::from([DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|c| corner + c));
    for i in 0..3 {
        let [a, b] = [TRIANGLE[i], TRIANGLE[(i + 1) % 3]].map(DVec2::from);
        let side = |p: DVec2| (b - a).perp_dot(p - a);
        let mut cut = Vec::new();
        for j in 0..shape.len() {
            let (p, q) = (shape[j], shape[(j + 1) % shape.len()]);
            let (at_p, at_q) = (side(p), side(q));
            if at_p >= 0.0 {
                cut.push(p);
            }
            if (at_p >= 0.0) != (at_q >= 0.0) {
                cut.push(p + at_p / (at_p - at_q) * (q - p));
            }
        }
        shape = cut;
    }
    0.5 * twice_the_area(&shape)
}

/// Returns the RMS error of the triangle's share of the pixels that its edges cross. The share is 1
/// minus red, because the plane is yellow and the triangle green.
fn share_error(picture: &LinearPicture) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for y in 0..picture.height() {
        for x in 0..picture.width() {
            let exact = share(DVec2::new(x as f64, y as f64));
            if exact > 0.0 && exact < 1.0 {
                let found = 1.0 - f64::from(picture.get(x, y)[0]);
                (sum, count) = (sum + (found - exact) * (found - exact), count + 1.0);
            }
        }
    }
    libm::sqrt(sum / count)
}
