//! The reference picture: slow, in `f64`, and easy to verify.
//!
//! [`render`] draws a [`Frame`] under a [`Model`], and shares no arithmetic with the shading
//! methods. Exact integers decide coverage, positions on edges and spans are exact fractions, and
//! every pixel is computed from a closed form without memory of its neighbours.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::reference::{self, Model};
//! use fastphong::scene::Scene;
//!
//! let mut scene = Scene::of_mesh(builtin("sphere?rings=6")?);
//! (scene.width, scene.height) = (40, 30);
//! let picture = reference::render(&scene.frame()?, Model::Phong).to_picture8();
//! assert_eq!(picture.get(20, 15)[3], 255, "the sphere covers the middle");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Unit vectors of the frame (normals, directions of light and view) are used as they are, in
//! `f32`, and not normalised again.
//!
//! `fastphong::reference::cs171` has the renderer of the second lecture, CS171, as it is printed.
//! It is hidden from this documentation, because only tests and the lectures' figures use it.

pub(crate) mod attributes;
mod clamping;
#[doc(hidden)]
pub mod coverage;
#[doc(hidden)]
pub mod cs171;
pub(crate) mod illumination;
mod power;
mod visibility;

#[cfg(test)]
pub(crate) mod fixtures;
#[cfg(test)]
mod tests;

#[doc(hidden)]
pub use clamping::{Clamping, clamping};
pub(crate) use coverage::is_anything_covered;
pub use visibility::{Visibility, visibility};

use crate::frame::{Frame, Polygon};
use crate::picture::encoding::store_f64;
use crate::picture::{Alpha, Encoding, LinearPicture, Picture, Picture8};
use crate::scene::Power;
use attributes::VertexAttributes;
use coverage::Scanline;
use glam::DVec3;

/// A closed form of shading: which attributes vary over a polygon, and how they are interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// One colour per polygon, lit by the polygon's normal (L21 2). Light and eye at positions are
    /// seen from the mean of its corners.
    Flat,
    /// One colour per polygon, lit by the normalised mean of the vertex normals (CS171 3, Algorithm
    /// 6).
    FlatAverage,
    /// Colours are interpolated linearly. Each vertex is first lit by its own normal and clamped to
    /// 0..=1 (L21 3).
    Gouraud,
    /// Colours are interpolated linearly and clamped at each pixel, not at the vertices. This is
    /// the closed form of diffuse and specular light that are interpolated separately and then
    /// added.
    GouraudSeparate,
    /// Normals are interpolated linearly, without normalising on the edges, then normalised and lit
    /// at each pixel (L21 4.1). Where the interpolated normal vanishes, it has no direction, and
    /// only ambient light is left.
    Phong,
    /// As [`Model::Phong`], with vectors toward light and eye that are constant over each polygon,
    /// as the lecture assumes (L21 1). They are those of the mean of its corners. With light and
    /// eye at infinity both models are equal.
    PhongConstant,
    /// Normals are interpolated along great circles: first along the two edges, then along the span
    /// between them (L21 4.4), also in triangles. They are lit at each pixel and not normalised
    /// again. Light and eye are as in [`Model::PhongConstant`]. The model ignores depth:
    /// [`Interpolation::Perspective`](crate::scene::Interpolation::Perspective) changes nothing.
    ///
    /// Normals less than 1e-3 apart are interpolated linearly. Normals more than 179° apart do not
    /// determine a great circle, and the normal of the polygon replaces them along the whole edge
    /// or span.
    Slerp,
}

impl Model {
    /// All models, in the order of the lecture.
    pub const ALL: [Model; 7] = [
        Model::Flat,
        Model::FlatAverage,
        Model::Gouraud,
        Model::GouraudSeparate,
        Model::Phong,
        Model::PhongConstant,
        Model::Slerp,
    ];

    /// Returns the name on the command line and in data.
    pub fn name(self) -> &'static str {
        match self {
            Model::Flat => "flat",
            Model::FlatAverage => "flat-average",
            Model::Gouraud => "gouraud",
            Model::GouraudSeparate => "gouraud-separate",
            Model::Phong => "phong",
            Model::PhongConstant => "phong-constant",
            Model::Slerp => "slerp",
        }
    }
}

/// The closed form of a variant: a model, and the power function of its highlights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClosedForm {
    /// The model.
    pub model: Model,
    /// The power function. [`Power::Squaring`] is tⁿ.
    pub power: Power,
}

impl From<Model> for ClosedForm {
    fn from(model: Model) -> Self {
        ClosedForm {
            model,
            power: Power::Squaring,
        }
    }
}

/// A picture of the reference, with polygon and depth of each sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReferencePicture {
    /// Linear red, green, blue in 0..=1. Alpha is 1 where a polygon is seen; elsewhere the pixel
    /// has the background's colour and alpha 0. If a frame has several samples per pixel, each is
    /// seen and shaded separately, and the pixel is their mean, as [`Frame::alpha`] says.
    pub picture: Picture<[f64; 4]>,
    /// [`Visibility::polygons`] of each sample.
    pub polygons: Picture<u32>,
    /// [`Visibility::depth`] of each sample.
    pub depth: Picture<f64>,
    /// [`Visibility::depth_gap`] of each sample.
    pub depth_gap: Picture<f64>,
}

impl ReferencePicture {
    /// Returns the picture in single precision.
    pub fn to_linear(&self) -> LinearPicture {
        self.picture.map(|pixel| pixel.map(|c| c as f32))
    }

    /// Returns the picture in eight bits: round(255 c), without a transfer function.
    pub fn to_picture8(&self) -> Picture8 {
        store_f64(&self.picture, Encoding::Linear)
    }
}

/// Returns the mean of each `side` × `side` samples: of the covered ones if alpha is straight,
/// otherwise of all. An uncovered pixel has the background's colour. Alpha is the mean over all
/// samples.
fn filtered(samples: &Picture<[f64; 4]>, side: usize, alpha: Alpha) -> Picture<[f64; 4]> {
    let mut picture = Picture::new(samples.width() / side, samples.height() / side, [0.0; 4]);
    for y in 0..picture.height() {
        for (x, pixel) in picture.row_mut(y).iter_mut().enumerate() {
            let rows =
                (y * side..(y + 1) * side).map(|row| &samples.row(row)[x * side..(x + 1) * side]);
            let mut covered = [0.0; 4];
            for sample in rows.flatten() {
                *pixel = core::array::from_fn(|c| pixel[c] + sample[c]);
                // The alpha of a sample is 0 or 1, so that this adds only covered samples, and
                // counts them in the last channel.
                covered = core::array::from_fn(|c| covered[c] + sample[3] * sample[c]);
            }
            *pixel = pixel.map(|sum| sum / (side * side) as f64);
            if alpha == Alpha::Straight && covered[3] > 0.0 {
                let [r, g, b, count] = covered;
                *pixel = [r / count, g / count, b / count, pixel[3]];
            }
        }
    }
    picture
}

/// Renders `frame` under a model.
pub fn render(frame: &Frame, form: impl Into<ClosedForm>) -> ReferencePicture {
    shade(frame, &visibility(frame), form)
}

/// Shades `frame` under a model. Several models can share its `visibility`.
///
/// `visibility` must be [`visibility()`] of `frame`. Where it names a polygon that `frame` does not
/// have, the background is left.
pub fn shade(
    frame: &Frame,
    visibility: &Visibility,
    form: impl Into<ClosedForm>,
) -> ReferencePicture {
    shade_and_count(frame, visibility, form.into()).0
}

/// Shades `frame` as [`shade`] does, and counts the samples whose light is clamped.
#[doc(hidden)]
pub fn shade_and_count(
    frame: &Frame,
    visibility: &Visibility,
    form: ClosedForm,
) -> (ReferencePicture, Clamping) {
    let (width, height) = (visibility.polygons.width(), visibility.polygons.height());
    let [r, g, b] = frame.background().map(f64::from);
    let mut picture = Picture::new(width, height, [r, g, b, 0.0]);
    let mut clamping = Clamping::new(frame);
    for_each_light(
        frame,
        &visibility.polygons,
        1,
        form,
        |[x, y], polygon, light| {
            clamping.add(polygon, light);
            let colour = light.clamp(DVec3::ZERO, DVec3::ONE);
            picture.row_mut(y)[x] = [colour.x, colour.y, colour.z, 1.0];
        },
    );
    let shaded = ReferencePicture {
        picture: if frame.samples() == 1 {
            picture
        } else {
            filtered(&picture, frame.samples(), frame.alpha())
        },
        polygons: visibility.polygons.clone(),
        depth: visibility.depth.clone(),
        depth_gap: visibility.depth_gap.clone(),
    };
    (shaded, clamping)
}

/// Calls `with` for each sample of a grid, every `step`-th of every `step`-th row of `frame`, at
/// which `polygons` has the index of a polygon. The arguments are the position on the grid, the
/// polygon, and its light before clamping.
fn for_each_light(
    frame: &Frame,
    polygons: &Picture<u32>,
    step: usize,
    form: ClosedForm,
    mut with: impl FnMut([usize; 2], &Polygon, DVec3),
) {
    let attributes = VertexAttributes::new(frame, form);
    let mut scanline = Scanline::new(frame);
    for y in 0..polygons.height() {
        // Neighbouring pixels of one polygon share its scanline.
        let mut cut = Visibility::NONE;
        for (x, &index) in polygons.row(y).iter().enumerate() {
            let Some(polygon) = frame.polygons().get(index as usize) else {
                continue;
            };
            if index != cut {
                scanline.cut(frame.corners(polygon), y * step);
                cut = index;
            }
            if let Some(light) = attributes.light(polygon, &scanline, x * step) {
                with([x, y], polygon, light);
            }
        }
    }
}
