//! The elements of a frame: vertices, polygons, and counts of the scene's polygons that did not get here.

#[allow(unused_imports)] // named by the documentation
use super::Frame;
use super::SubPixel;
#[allow(unused_imports)] // named by the documentation
use crate::scene::Clipping;
use core::cmp::Ordering;

/// A vertex to be added to a frame: its screen coordinates, depth and vertex attributes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Column of the picture, at most [`Frame::GUARD`] pixels from 0.
    pub x: SubPixel,
    /// Row of the picture, downward, at most [`Frame::GUARD`] pixels from 0.
    pub y: SubPixel,
    /// What the depth test compares: less is nearer. It is linear on the screen. The frame's
    /// [`DepthRange`](super::DepthRange) says which number it is:
    ///
    /// - orthographic, and without a range: 0 at the near plane, 1 at the far plane;
    /// - perspective: −1/w, from −1/near to −1/far. A float holds it with the same relative
    ///   precision at every distance w, where z/w crowds all that is far away below 1.
    ///
    /// Values outside these ends are for [`Clipping::NdcCube`] only.
    pub depth: f64,
    /// near/w under a perspective camera, 1 under an orthographic one: the weight of perspective
    /// interpolation, and the source of depth at each sample
    /// ([`DepthSource::PerSample`](crate::scene::DepthSource)). Greater than 0; under
    /// [`Clipping::NdcCube`] less than 0 behind the eye.
    pub inv_w: f64,
    /// Unit vertex normal in world space (L21 3.1); ignored at a [`ClipCorner`].
    pub normal: [f32; 3],
    /// The index of its material in [`Frame::lightings`].
    pub material: u32,
}

/// A vertex in screen space, as rasterization reads it, in 24 bytes. Engines round depth and weight
/// to `f32`; the reference reads them as they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScreenVertex {
    /// Column of the picture, at most [`Frame::GUARD`] pixels from 0.
    pub x: SubPixel,
    /// Row of the picture, downward, at most [`Frame::GUARD`] pixels from 0.
    pub y: SubPixel,
    /// What the depth test compares: see [`Vertex::depth`].
    pub depth: f64,
    /// near/w: see [`Vertex::inv_w`].
    pub inv_w: f64,
}

impl ScreenVertex {
    /// Orders vertices by row, column, depth and 1/w. Who adds up depth over a polygon's corners goes by this order, so that the
    /// sum does not depend on the corner that the polygon begins with, nor on the way in which it runs.
    pub(crate) fn compare(&self, other: &ScreenVertex) -> Ordering {
        let places = (self.y, self.x).cmp(&(other.y, other.x));
        places
            .then(self.depth.total_cmp(&other.depth))
            .then(self.inv_w.total_cmp(&other.inv_w))
    }

    /// Packs column and row into one number, to be read and written at once: the bits of the column below those of the row.
    #[inline(always)]
    pub(crate) fn packed(&self) -> u64 {
        u64::from(self.x.to_bits() as u32) | u64::from(self.y.to_bits() as u32) << 32
    }
}

/// A vertex that clipping made: its attributes lie between those of two others and are never lit again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipCorner {
    /// The vertex that this describes.
    pub vertex: u32,
    /// The vertex at `t` = 0; a smaller number than `vertex`. If no polygon uses it, its pixel coordinates mean nothing: it
    /// may lie behind the eye.
    pub a: u32,
    /// The vertex at `t` = 1, of the same kind.
    pub b: u32,
    /// The parameter from `a` to `b`, 0..=1.
    pub t: f32,
    /// Unit normal of the polygon that was clipped.
    pub face: [f32; 3],
}

/// A projected polygon: three corners or more, of any shape.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Polygon {
    /// The index of its first corner in the list of all corners.
    pub first: u32,
    /// The number of its corners.
    pub count: u32,
    /// The index of its material in [`Frame::lightings`]; its vertices have the same one.
    pub material: u32,
    /// The number of its polygon in the scene, counted over all objects; pieces of one clipped polygon share it. A builder may
    /// give any number: pictures of AOVs show it, nothing else reads it.
    pub source: u32,
    /// The number of its normal in the frame's geometry, and [`Polygon::FLIPPED`] where it is negated: see
    /// [`Frame::polygon_normal`].
    pub(crate) face: u32,
}

impl Polygon {
    /// Added to the number of a normal that is negated: the polygon is lit from behind.
    pub(crate) const FLIPPED: u32 = 1 << 31;
}

/// Counts of the scene's polygons, by their fate on the way into the frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
pub struct FrameStats {
    /// Polygons of the scene.
    pub polygons: usize,
    /// Left out because they are seen from the culled side.
    pub culled: usize,
    /// Left out because they have no area in space: their corners lie on one line, or at one point.
    pub no_area: usize,
    /// Left out because they cross themselves and the areas of their lobes cancel: they have no normal (L21 1.1).
    pub cancelling: usize,
    /// Left out because they have no area on the picture: seen edge-on, or smaller than its 1/256 pixels.
    pub edge_on: usize,
    /// Left out because they lie outside the view.
    pub outside: usize,
    /// Cut by the near plane, the far plane or the guard band.
    pub clipped: usize,
    /// Left out because a corner has no place on the picture: under [`Clipping::NdcCube`], or where a polygon reaches so far that
    /// a cut is rounded to beyond its plane, or its 1/w is no `f32`.
    pub unprojected: usize,
}

/// The mean of a polygon's corners: the point at which methods evaluate light and eye that light a whole polygon at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean of the corners' positions.
    pub position: [f32; 3],
    /// The mean of the corners' normals; not a unit vector.
    pub normal: [f32; 3],
    /// The mean of the corners' colours: [`Frame::colour`].
    pub colour: [f32; 3],
}
