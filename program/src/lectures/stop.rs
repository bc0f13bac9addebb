//! The rasterizer that one can stop: 24 × 16 pixels, with the engine's own values at each step (L21
//! 3 and 4).

use super::prelude::*;
use fastphong::frame::{FrameBuilder, Vertex, sub_pixel};
use fastphong::raster::trace::Trace;

pub(super) static FIGURE: Figure = Figure {
    name: "stop",
    title: "The rasterizer you can stop",
    lecture: "L21 3, 4: (3.3)\u{2013}(3.6), (4.1)\u{2013}(4.12)",
    parts: &[steps],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "Every value at a corner travels down the edges and along the spans by one addition per step (L21 3.3, 3.6, 4.2).",
    handles: &[
        column(["x1", "corner P₁, column"], 2.75),
        line(["y1", "corner P₁, line"], 3.25),
        column(["x2", "corner P₂, column"], 13.25),
        line(["y2", "corner P₂, line"], 1.25),
        column(["x3", "corner P₃, column"], 14.5),
        line(["y3", "corner P₃, line"], 12.5),
        column(["x4", "corner P₄, column"], 4.25),
        line(["y4", "corner P₄, line"], 14.5),
        column(["x5", "corner P₅, column"], 21.5),
        line(["y5", "corner P₅, line"], 5.5),
        column(["x6", "corner P₆, column"], 20.25),
        line(["y6", "corner P₆, line"], 15.0),
        column(["x7", "corner Q₁, column"], 4.5),
        line(["y7", "corner Q₁, line"], 8.25),
        column(["x8", "corner Q₂, column"], 13.0),
        line(["y8", "corner Q₂, line"], 9.75),
        column(["x9", "corner Q₃, column"], 7.0),
        line(["y9", "corner Q₃, line"], 13.75),
    ],
    make: |content, values| measured(content, &frame(values)?),
};

/// Width and height of the picture.
const SIZE: [u32; 2] = [24, 16];

const fn column(name: [&'static str; 2], start: f64) -> Handle {
    Handle::coordinate(name, 'x', [0.0, SIZE[0] as f64], start)
}

const fn line(name: [&'static str; 2], start: f64) -> Handle {
    Handle::coordinate(name, 'y', [0.0, SIZE[1] as f64], start)
}

/// The polygons: a quadrilateral and two triangles that share edges, and a loose triangle. One
/// shared edge runs through pixel centres.
const POLYGONS: [&[u32]; 4] = [&[0, 1, 2, 3], &[1, 4, 2], &[4, 5, 2], &[6, 7, 8]];

/// Returns depths and normals of the corners, with x to the right and y down the picture. The
/// normals of P₁ to P₆ bulge, so that the highlight falls inside the quadrilateral. The loose
/// triangle pierces it, and two of its normals nearly oppose each other.
fn corners() -> [(f64, DVec3); 9] {
    let bulge = |i: usize| {
        let at = |k: usize| LIVE.handles[2 * i + k].start;
        DVec3::new((at(0) - 12.5) / 9.5, (at(1) - 7.25) / 9.5, 0.72)
    };
    [
        (0.52, bulge(0)),
        (0.48, bulge(1)),
        (0.48, bulge(2)),
        (0.54, bulge(3)),
        (0.5, bulge(4)),
        (0.55, bulge(5)),
        (0.3, DVec3::new(-0.93, -0.25, 0.34)),
        (0.535, DVec3::new(0.95, 0.05, 0.3)),
        (0.46, DVec3::new(-0.3, 0.5, 0.8)),
    ]
}

/// Makes the frame, with the corners at these columns and lines.
fn frame(at: &[f64]) -> Result<Frame> {
    let mut builder = FrameBuilder::new(SIZE[0], SIZE[1]);
    let light = Light::directional(DVec3::new(-0.5, -0.5, 0.72).normalize(), [1.0; 3]);
    let surface = grey(0.07, 0.55, 0.5, 16.0);
    let material = builder.lighting(Lighting::new(&surface, [1.0; 3], &[light], DVec3::Z));
    for ((depth, normal), at) in corners().into_iter().zip(at.chunks_exact(2)) {
        builder.vertex(Vertex {
            x: sub_pixel(at[0]),
            y: sub_pixel(at[1]),
            depth,
            inv_w: 1.0,
            normal: normal.normalize().as_vec3().to_array(),
            material,
        });
    }
    for (index, corners) in (0..).zip(POLYGONS) {
        builder.polygon(corners, [0.0, 0.0, 1.0], index);
    }
    Ok(builder.finish()?)
}

/// The methods that the figure steps through.
const METHODS: [&str; 7] = [
    "gouraud",
    "naive-phong",
    "fast-phong:steps=1",
    "fast-phong:steps=2",
    "fast-phong:steps=3",
    "fast-phong",
    "slerp-phong",
];

/// Traces a method on the figure's mesh, with the corners at the columns and lines in `given`.
/// Missing coordinates are where they start.
///
/// # Errors
/// If no method matches `method`, or the method cannot draw the frame.
pub fn trace_of_stop(method: &str, given: &[f64]) -> Result<Trace> {
    let frame = frame(&LIVE.values(given))?;
    Ok(Variant::parse(method)?.trace(&frame, None)?)
}

/// Shows the pictures, and adds the traces that the page steps through.
fn steps(content: &mut FigureContent) -> Result {
    content.text(
        "Four polygons on 24 × 16 pixels. B and C share an edge that runs through pixel centres. D pierces A. The normals of A \
         bulge, so that its highlight falls inside.",
    );
    measured(content, &frame(&LIVE.values(&[]))?)?;
    for method in METHODS {
        content.trace(trace_of_stop(method, &[])?);
    }
    Ok(())
}

/// Draws the frame by each method. Measures how much light Gouraud loses, and the error that
/// Newton's steps leave.
fn measured(content: &mut FigureContent, frame: &Frame) -> Result {
    let names = ["gouraud", "naive-phong", METHODS[2], METHODS[3], METHODS[6]];
    let [gouraud, naive, one, two, slerp] = draw_each(frame, names)?;
    content.row(
        "Four polygons on 24 by 16 pixels",
        "Gouraud | naive Phong | fast Phong, one step of Newton's method per pixel | slerp",
        [&gouraud, &naive, &one, &slerp].map(stored),
    );
    let lost = levels(&gouraud, &naive);
    let (agreement, says) = if lost > 1.0 {
        (
            Agreement::Confirms,
            "No corner sees the highlight, so nothing between the corners can.",
        )
    } else {
        (
            Agreement::Adds,
            "Here Gouraud's picture is as good as Phong's.",
        )
    };
    content.found(
        "gouraud | Gouraud against naive Phong: largest difference",
        (lost, "grey levels", true),
        agreement,
        says,
    );
    for (key, steps, picture) in [("one", "one step", one), ("two", "two steps", two)] {
        let off = levels(&picture, &naive);
        let (agreement, says) = if off > 0.5 {
            (
                Agreement::Contradicts,
                "|N| changes too fast here for one Newton step.",
            )
        } else {
            (Agreement::Confirms, "Nobody can see it.")
        };
        content.found(
            &format!("{key} | fast Phong with {steps} of Newton\u{2019}s method against naive Phong: largest difference"),
            (off, "grey levels", true),
            agreement,
            says,
        );
    }
    Ok(())
}
