//! The reference picture: slow, in `f64`, and easy to see right.
//!
//! It takes the same [`Frame`] as the shading methods and shares no arithmetic with them: coverage is decided in exact
//! integers, places on edges and spans come from exact fractions, and every pixel is computed from closed forms with no
//! memory of its neighbours.
//!
//! * `coverage`: the pixels of a polygon, and their coordinates in it
//! * `visibility`: the polygon seen at each pixel
//! * `attributes`: colours and normals at vertices, and between them
//! * `illumination`: L21 2.1
//! * `clamping`: the part of the picture whose light is over 1
//!
//! Unit vectors of the frame (normals, directions of light and view) are taken as they are given, in `f32`, and not
//! normalised again.

pub(crate) mod attributes;
mod clamping;
pub(crate) mod coverage;
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
pub use coverage::is_anything_covered;
pub use visibility::{Visibility, visibility};

use crate::frame::{Frame, Polygon};
use crate::picture::{Alpha, LinearPicture, Picture, Picture8};
use crate::scene::Power;
use attributes::VertexAttributes;
use coverage::Scanline;
use glam::DVec3;

/// A closed form of shading: the attributes that vary over a polygon, and their interpolation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// One colour per polygon, lit by its own normal (L21 2). Light and eye at positions are seen from the mean of its corners.
    Flat,
    /// One colour per polygon, lit by the normalised mean of its vertex normals (CS171 3, Algorithm 6).
    FlatAverage,
    /// Colours: each vertex is lit by its own normal and clamped to 0..=1; then colours are interpolated linearly
    /// (L21 3).
    Gouraud,
    /// Colours, not clamped at the vertices, but at each pixel: the closed form of diffuse and specular light that
    /// are interpolated apart and summed.
    GouraudSeparate,
    /// Normals, linearly and not normalised on the edges; normalised and lit at each pixel (L21 4.1). Where the
    /// interpolated normal vanishes it has no direction, and only ambient light is left.
    Phong,
    /// As [`Model::Phong`], with the vectors toward light and eye constant over each polygon, as the lecture assumes
    /// (L21 1): those of the mean of its corners. With light and eye at infinity it is the same.
    PhongConstant,
    /// Normals, along great circles: first along the two edges, then along the span between them (L21 4.4), triangles
    /// too; lit at each pixel, not normalised again; light and eye as in
    /// [`Model::PhongConstant`]. It does not know of depth:
    /// [`Interpolation::Perspective`](crate::scene::Interpolation::Perspective) changes nothing.
    ///
    /// Less than 1e-3 apart, normals are interpolated linearly; more than 179° apart they name no great circle, and the
    /// normal of the polygon stands in all along that edge or span.
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

    /// Returns its name on the command line and in data.
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
    /// The power function: [`Power::Squaring`] is tⁿ.
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
pub struct ReferencePicture {
    /// Linear red, green, blue in 0..=1; alpha is 1 where a polygon is seen. Elsewhere the background, with alpha 0. Of a
    /// frame with several samples per pixel each is seen and shaded on its own, and this is their mean, as [`Frame::alpha`]
    /// says.
    pub picture: Picture<[f64; 4]>,
    /// See [`Visibility::polygons`]; of each sample.
    pub polygons: Picture<u32>,
    /// See [`Visibility::depth`]; of each sample.
    pub depth: Picture<f64>,
    /// See [`Visibility::depth_gap`]; of each sample.
    pub depth_gap: Picture<f64>,
}

impl ReferencePicture {
    /// Returns the picture in single precision.
    pub fn to_linear(&self) -> LinearPicture {
        self.picture.map(|pixel| pixel.map(|c| c as f32))
    }

    /// Returns the picture in eight bits: round(255 c), with no transfer function.
    pub fn to_picture8(&self) -> Picture8 {
        self.picture
            .map(|pixel| pixel.map(|c| libm::round(255.0 * c) as u8))
    }
}

/// Returns the mean of each `side` × `side` samples: of the covered ones if alpha is straight, else of all. A pixel that
/// nothing covers has the background's colour; alpha is the mean over all samples.
fn filtered(samples: &Picture<[f64; 4]>, side: usize, alpha: Alpha) -> Picture<[f64; 4]> {
    let mut picture = Picture::new(samples.width() / side, samples.height() / side, [0.0; 4]);
    for y in 0..picture.height() {
        for (x, pixel) in picture.row_mut(y).iter_mut().enumerate() {
            let rows =
                (y * side..(y + 1) * side).map(|row| &samples.row(row)[x * side..(x + 1) * side]);
            let mut covered = [0.0; 4];
            for sample in rows.flatten() {
                *pixel = core::array::from_fn(|c| pixel[c] + sample[c]);
                // Alpha of a sample is 0 or 1.
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

/// Shades `frame` under a model, given its `visibility`, which several models share.
///
/// `visibility` must be that of `frame`; where it names what `frame` does not have, the background is left.
pub fn shade(
    frame: &Frame,
    visibility: &Visibility,
    form: impl Into<ClosedForm>,
) -> ReferencePicture {
    shade_and_count(frame, visibility, form.into()).0
}

/// Shades `frame` as [`shade`] does, and counts the samples whose light is clamped.
pub(crate) fn shade_and_count(
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

/// Calls `with` for each place of a grid over the samples of `frame`, every `step`-th of every `step`-th row, where `polygons` has
/// the number of one: with the place on the grid, the polygon, and its light before that is clamped.
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
        // Pixels of one polygon side by side share its scanline.
        let mut cut = Visibility::NONE;
        for (x, &number) in polygons.row(y).iter().enumerate() {
            let Some(polygon) = frame.polygons().get(number as usize) else {
                continue;
            };
            if number != cut {
                scanline.cut(frame.corners(polygon), y * step);
                cut = number;
            }
            if let Some(light) = attributes.light(polygon, &scanline, x * step) {
                with([x, y], polygon, light);
            }
        }
    }
}
