//! The elements of a frame: vertices, polygons, and counts of the scene's polygons that were left
//! out.

#[allow(unused_imports)] // named by the documentation
use super::Frame;
use super::{SubPixel, sub_pixel};
#[allow(unused_imports)] // named by the documentation
use crate::scene::Clipping;
use core::cmp::Ordering;

/// A vertex to add to a frame: its screen coordinates, depth and vertex attributes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// The column on the picture, at most [`Frame::GUARD`] pixels from 0.
    pub x: SubPixel,
    /// The row on the picture, downward, at most [`Frame::GUARD`] pixels from 0.
    pub y: SubPixel,
    /// The value that the depth test compares: less is nearer. It must be linear on the screen.
    /// What it is depends on the frame's [`DepthRange`](super::DepthRange):
    ///
    /// - orthographic, or no range set: 0 at the near plane, 1 at the far plane;
    /// - perspective: −1/w, from −1/near to −1/far. A float holds −1/w with the same relative
    ///   precision at every distance w, while z/w crowds everything far away just below 1.
    ///
    /// Only [`Clipping::NdcCube`] allows values outside these ends.
    pub depth: f64,
    /// near/w under a perspective camera, 1 under an orthographic one. It is the weight of
    /// perspective interpolation, and the source of depth at each sample
    /// ([`DepthSource::PerSample`](crate::scene::DepthSource)). It must be over 0; under
    /// [`Clipping::NdcCube`] it is below 0 behind the eye.
    pub inv_w: f64,
    /// The unit vertex normal in world space (L21 3.1). Ignored at a [`ClipCorner`].
    pub normal: [f32; 3],
    /// The material, an index into [`Frame::lightings`].
    pub material: u32,
}

impl Vertex {
    /// Makes a vertex at the pixel coordinates `x` and `y`, which are rounded to 1/256, of the
    /// first material. `inv_w` is 1: set it under perspective.
    pub fn new([x, y]: [f64; 2], depth: f64, normal: [f32; 3]) -> Self {
        Vertex {
            x: sub_pixel(x),
            y: sub_pixel(y),
            depth,
            inv_w: 1.0,
            normal,
            material: 0,
        }
    }
}

/// A vertex in screen space as rasterization reads it, in 24 bytes. Engines round depth and weight
/// to `f32`; the reference uses all bits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScreenVertex {
    /// The column on the picture, at most [`Frame::GUARD`] pixels from 0.
    pub x: SubPixel,
    /// The row on the picture, downward, at most [`Frame::GUARD`] pixels from 0.
    pub y: SubPixel,
    /// The value that the depth test compares: see [`Vertex::depth`].
    pub depth: f64,
    /// near/w: see [`Vertex::inv_w`].
    pub inv_w: f64,
}

impl ScreenVertex {
    /// Orders vertices by row, column, depth and 1/w. Code that adds up depth over a polygon's
    /// corners uses this order, so the sum depends neither on the corner that the polygon begins
    /// with nor on the way it runs.
    pub(crate) fn compare(&self, other: &ScreenVertex) -> Ordering {
        let places = (self.y, self.x).cmp(&(other.y, other.x));
        places
            .then(self.depth.total_cmp(&other.depth))
            .then(self.inv_w.total_cmp(&other.inv_w))
    }

    /// Packs column and row into one integer, which is read and written at once. The column is in
    /// the lower half.
    #[inline(always)]
    pub(crate) fn packed(&self) -> u64 {
        u64::from(self.x.to_bits() as u32) | u64::from(self.y.to_bits() as u32) << 32
    }
}

/// A vertex that clipping made. Its attributes lie between the attributes of two other vertices,
/// and it is never lit itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipCorner {
    /// The vertex.
    pub vertex: u32,
    /// The vertex at `t` = 0, whose index is less than `vertex`. If no polygon uses it, its pixel
    /// coordinates mean nothing, as it may lie behind the eye.
    pub a: u32,
    /// The vertex at `t` = 1, with the same conditions.
    pub b: u32,
    /// The parameter from `a` to `b`, 0..=1.
    pub t: f32,
    /// The unit normal of the clipped polygon.
    pub face: [f32; 3],
}

/// A projected polygon: three corners or more, of any shape.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Polygon {
    /// The index of its first corner in the list of all corners.
    pub first: u32,
    /// How many corners it has.
    pub count: u32,
    /// Its material, an index into [`Frame::lightings`]. All its vertices have this material.
    pub material: u32,
    /// The index of its polygon in the scene, counted over all objects. Pieces of one clipped
    /// polygon share it. A builder may set any value: only pictures of AOVs show it.
    pub source: u32,
    /// The index of its normal in the frame's geometry, plus [`Polygon::FLIPPED`] if the normal is
    /// negated: see [`Frame::polygon_normal`].
    pub(crate) face: u32,
}

impl Polygon {
    /// Marks the index of a normal that is negated, because the polygon is lit from behind.
    pub(crate) const FLIPPED: u32 = 1 << 31;

    /// True if the polygon is lit from behind, so that its normal is negated.
    pub fn is_flipped(&self) -> bool {
        self.face & Polygon::FLIPPED != 0
    }
}

/// Counts of the scene's polygons, by what became of them on the way into the frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[non_exhaustive]
pub struct FrameStats {
    /// All polygons of the scene.
    pub polygons: usize,
    /// Left out because they are seen from the culled side.
    pub culled: usize,
    /// Left out because they have no area in space: their corners lie on one line or at one point.
    pub no_area: usize,
    /// Left out because they cross themselves and the areas of their lobes cancel: they have no
    /// normal (L21 1.1).
    pub cancelling: usize,
    /// Left out because they have no area on the picture: they are seen edge-on, or are smaller
    /// than 1/256 pixel.
    pub edge_on: usize,
    /// Left out because they lie outside the view.
    pub outside: usize,
    /// Cut at the near plane, the far plane or the guard band.
    pub clipped: usize,
    /// Left out because a corner has no place on the picture. That happens under
    /// [`Clipping::NdcCube`], or if a polygon reaches so far that rounding puts a cut beyond its
    /// plane, or that 1/w is no `f32`.
    pub unprojected: usize,
}

/// The mean of a polygon's corners. Methods that light a whole polygon at once evaluate light and
/// eye at this point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean of the corners' positions.
    pub position: [f32; 3],
    /// The mean of the corners' normals; not a unit vector.
    pub normal: [f32; 3],
    /// The mean of the corners' colours: [`Frame::colour`].
    pub colour: [f32; 3],
}
