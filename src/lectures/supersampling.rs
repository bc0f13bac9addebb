//! Supersampling with a depth buffer: occlusion at each sample, and the edge that its filter gives (L5).

use super::stage::{Corner, Facet, Grey, shipped, written};
use super::{Content, Figure, FigureError, Plot, Scale, Series, Shown};
use crate::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use crate::mesh::Material;
use crate::picture::{Encoding, LinearPicture};
use crate::scene::{Lighting, Scene};
use crate::shading::Variant;
use alloc::format;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "supersampling",
    title: "Supersampling with a depth buffer: the filtered edge",
    lecture: "L5, Z-buffer and Supersampling",
    make,
};

/// Samples a pixel along each side.
const SAMPLES: [u32; 4] = [1, 2, 4, 8];
/// Width and height of the small pictures, whose pixels are to be seen.
const SIZE: [u32; 2] = [24, 18];
/// A green triangle in front of a yellow polygon, in pixels.
const TRIANGLE: [[f64; 2]; 3] = [[3.2, 1.3], [21.7, 8.1], [6.4, 16.6]];

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.text(
        "A green triangle before a yellow plane, with n × n samples a pixel. What is hidden is decided, and light is \
         computed, at each sample; the mean of a pixel's samples is taken in linear light.",
    );
    let mut shown = Vec::new();
    let mut points = Vec::new();
    for samples in SAMPLES {
        let picture = Variant::parse("flat")?.render_linear(&edge(samples)?);
        let error = share_error(&picture);
        points.push((f64::from(samples), error));
        let caption = format!("{samples} × {samples}: {}", written(error));
        let alt =
            format!("The edge of a green triangle with {samples} by {samples} samples a pixel.");
        shown.push(Shown::new(
            caption,
            alt,
            crate::picture::encoding::store(&picture, Encoding::Srgb),
        ));
    }
    content.pictures(SAMPLES.len(), shown);
    let falls = points.windows(2).all(|pair| pair[1].1 < pair[0].1);
    let gain = points[0].1 / points[3].1;
    content.plot(Plot {
        title: "RMS error of the triangle's share of a pixel".into(),
        x: ("samples along a side".into(), Scale::Log),
        y: ("RMS error of shares".into(), Scale::Log),
        series: [Series::new("measured", points.iter().copied())].into(),
        marks: Vec::new(),
        caption: "Against the exact area of the triangle in each pixel that its edges cross."
            .into(),
    });
    content.claim(
        "share",
        "error with one sample over error with 8 × 8",
        (gain, ""),
        falls,
        [
            "More samples, better edges: the depth test works for each sample.",
            "More samples do not help.",
        ],
    );
    filtering(&mut content)?;
    inside(&mut content)?;
    Ok(content)
}

/// The triangle before a plane that fills the picture, projected for so many samples.
fn edge(samples: u32) -> Result<Frame, FigureError> {
    let [width, height] = SIZE.map(|side| side * samples);
    let mut builder = FrameBuilder::new(width, height);
    builder.samples(samples);
    let whole = [[-1.0, -1.0], [25.0, -1.0], [25.0, 19.0], [-1.0, 19.0]];
    for (number, (colour, depth, corners)) in [
        ([1.0, 1.0, 0.0], 0.8, &whole[..]),
        ([0.0, 1.0, 0.0], 0.2, &TRIANGLE[..]),
    ]
    .into_iter()
    .enumerate()
    {
        let material = Material {
            ambient: colour,
            diffuse: [0.0; 3],
            specular: [0.0; 3],
            shininess: 1.0,
        };
        let material = builder.lighting(Lighting::new(&material, [1.0; 3], &[], DVec3::Z));
        let place = |c: f64| SubPixel::from_num(c * f64::from(samples));
        let vertices: Vec<u32> = corners
            .iter()
            .map(|&[x, y]| {
                let normal = [0.0, 0.0, 1.0];
                builder.vertex(Vertex {
                    x: place(x),
                    y: place(y),
                    depth,
                    inv_w: 1.0,
                    normal,
                    material,
                })
            })
            .collect();
        builder.polygon(&vertices, [0.0, 0.0, 1.0], number as u32);
    }
    Ok(builder.finish()?)
}

/// The part of the unit square at (`x`, `y`) that lies in the triangle: cut by its three edges, then measured.
fn share([x, y]: [f64; 2]) -> f64 {
    let mut shape: Vec<[f64; 2]> = [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]].into();
    for i in 0..3 {
        let ([ax, ay], [bx, by]) = (TRIANGLE[i], TRIANGLE[(i + 1) % 3]);
        let side = |[px, py]: [f64; 2]| (bx - ax) * (py - ay) - (by - ay) * (px - ax);
        let mut cut = Vec::new();
        for j in 0..shape.len() {
            let (p, q) = (shape[j], shape[(j + 1) % shape.len()]);
            let (at_p, at_q) = (side(p), side(q));
            if at_p >= 0.0 {
                cut.push(p);
            }
            if (at_p >= 0.0) != (at_q >= 0.0) {
                let t = at_p / (at_p - at_q);
                cut.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
            }
        }
        shape = cut;
    }
    let following = shape.iter().cycle().skip(1);
    0.5 * shape
        .iter()
        .zip(following)
        .map(|(p, q)| p[0] * q[1] - q[0] * p[1])
        .sum::<f64>()
}

/// The root mean square error of the triangle's share of the pixels that its edges cross: 1 less red is the share of green.
fn share_error(picture: &LinearPicture) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for y in 0..picture.height() {
        for x in 0..picture.width() {
            let exact = share([x as f64, y as f64]);
            if exact > 0.0 && exact < 1.0 {
                let found = 1.0 - f64::from(picture.get(x, y)[0]);
                (sum, count) = (sum + (found - exact) * (found - exact), count + 1.0);
            }
        }
    }
    libm::sqrt(sum / count)
}

/// Half of black and half of white: in linear light, and as stored values would be averaged.
fn filtering(content: &mut Content) -> Result<(), FigureError> {
    let grey = Grey {
        ambient: 1.0,
        diffuse: 0.0,
        ..Grey::dull(DVec3::Z)
    };
    let half = [[0.0, 0.0], [1.5, 0.0], [1.5, 2.0], [0.0, 2.0]]
        .map(|place| Corner::new(place.map(|c| 2.0 * c), DVec3::Z));
    let mut builder = FrameBuilder::new(4, 4);
    builder.samples(2);
    let material = builder.lighting(grey.lighting());
    let facet = Facet::new(half);
    let vertices: Vec<u32> = facet
        .corners
        .iter()
        .map(|c| {
            let [x, y] = c.place.map(SubPixel::from_num);
            builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: 1.0,
                normal: [0.0, 0.0, 1.0],
                material,
            })
        })
        .collect();
    builder.polygon(&vertices, [0.0, 0.0, 1.0], 0);
    builder.encoding(Encoding::Srgb);
    let stored = Variant::parse("flat")?.render(&builder.finish()?);
    let level = f64::from(stored.get(1, 0)[0]);
    let exact = f64::from(crate::picture::encoding::srgb_encode(0.5)) * 255.0;
    let is_linear = (level - exact).abs() <= 0.5;
    content.adds("linear", "stored level of a pixel that is half white and half black, sRGB", (level, "of 255"), if is_linear {
            format!("The mean is taken before encoding: half of the light is level {exact:.0}, not the mean of levels.")
        } else {
            format!("The mean is not that of light, which is level {exact:.0}.")
        });
    Ok(())
}

/// The line where two polygons cut each other is filtered like an edge.
fn inside(content: &mut Content) -> Result<(), FigureError> {
    let scene = shipped("interpenetration", [120, 90])?;
    let mut shown = Vec::new();
    for samples in [1, 4] {
        let scene = Scene {
            samples,
            ..scene.clone()
        };
        let picture = Variant::parse("flat")?.render(&scene.frame()?);
        let caption = format!("{samples} × {samples}, polygons that cut each other");
        shown.push(Shown::new(caption.clone(), format!("{caption}."), picture));
    }
    content.pictures(2, shown);
    Ok(())
}
