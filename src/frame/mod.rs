//! A frame: projected polygons and the light on them, the interface between geometry and shading.
//!
//! `projection/` makes it from a scene, and may fail; so may [`FrameBuilder`]. Past it there is only arithmetic that cannot fail and
//! does not know where polygons come from. The engines and the `f64` reference all take the same frame, the barycentric renderer
//! after `triangulate.rs` cut it into triangles. So what differs between their pictures is shading and not geometry. `painter_order.rs`
//! sorts a frame for the painter's algorithm.

mod builder;
mod depth_range;
mod elements;
mod error;
mod geometry;
pub(crate) mod guard;
mod painter_order;
pub mod perspective;
mod projection;
pub(crate) mod row_tiles;
pub mod triangulate;

pub use builder::FrameBuilder;
pub use depth_range::DepthRange;
pub use elements::{ClipCorner, FrameStats, Mean, Polygon, ScreenVertex, Vertex};
pub use error::{FrameError, FrameItem};
pub(crate) use geometry::{Geometry, Models, PlacedModel};
pub use projection::PreparedScene;

use crate::picture::{Alpha, Encoding, Rgb};
use crate::scene::{Clipping, HiddenSurfaces, Interpolation, Lighting, Scene};
use crate::sync::Arc;
use alloc::vec::Vec;
use projection::Scratch;

/// A coordinate on the picture in pixels (of a supersampled frame: in samples), snapped to 1/256: x to the right, y
/// downward, (0, 0) the outer corner of the first pixel, so that pixel centres lie at ½.
///
/// Make it of a float by [`sub_pixel`]: the type's own `from_num` panics or wraps beyond ±2²³ pixels.
pub type SubPixel = fixed::types::I24F8;

/// Returns a coordinate of so many pixels, to the nearest 1/256, halves to even.
///
/// What is beyond the type's range becomes its end, and what is no number its upper end: [`FrameBuilder::finish`] refuses both, as
/// they lie beyond [`Frame::GUARD`].
pub fn sub_pixel(pixels: impl Into<f64>) -> SubPixel {
    let bits = libm::rint(pixels.into() * 256.0);
    match bits.is_nan() {
        true => SubPixel::MAX,
        // The conversion saturates.
        false => SubPixel::from_bits(bits as i32),
    }
}

/// Projected polygons in drawing order, and the light on them.
///
/// The frames of one [`PreparedScene`] share all that does not depend on the camera: normals, materials, corner lists. Each
/// frame owns screen coordinates and the polygons that are seen.
#[derive(Clone, Debug)]
pub struct Frame {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) samples: u32,
    pub(crate) background: Rgb,
    pub(crate) interpolation: Interpolation,
    pub(crate) hidden_surfaces: HiddenSurfaces,
    pub(crate) clipping: Clipping,
    pub(crate) depth_range: DepthRange,
    /// A power of two by which weights of perspective are multiplied: see [`Frame::weight`].
    pub(crate) weight_scale: f64,
    pub(crate) encoding: Encoding,
    pub(crate) alpha: Alpha,
    pub(crate) origin: [f64; 3],
    pub(crate) geometry: Arc<Geometry>,
    /// The vertices of the geometry, then those that clipping made.
    pub(crate) vertices: Vec<ScreenVertex>,
    /// Materials of the vertices that clipping made.
    pub(crate) cut_materials: Vec<u32>,
    /// Means of cut polygons, by the index of their first corner, in ascending order.
    pub(crate) means: Vec<(u32, Mean)>,
    pub(crate) clip_corners: Vec<ClipCorner>,
    /// Corner lists of cut polygons; their indices continue those of the geometry's lists.
    pub(crate) cut_corners: Vec<u32>,
    pub(crate) polygons: Vec<Polygon>,
    pub(crate) lightings: Vec<Lighting>,
    /// True if any of them is local: methods ask for each polygon, and there may be many materials.
    pub(crate) is_local: bool,
    pub(crate) stats: FrameStats,
    pub(crate) scratch: Scratch,
}

impl Frame {
    /// No coordinate of a vertex is farther than this from 0, in pixels: twice the largest picture, which leaves room
    /// for the exact products of the edge walk in 64 bits (2²⁴ · 2²⁴ · 2).
    pub const GUARD: i32 = 2 * Scene::MAX_SIDE as i32;

    /// Returns the samples of a row: its pixels, unless each has several. All coordinates of the frame count samples.
    pub fn width(&self) -> usize {
        self.width as usize
    }

    /// Returns the number of rows of samples.
    pub fn height(&self) -> usize {
        self.height as usize
    }

    /// Returns the samples of a pixel along each side: 1, 2, 4 or 8.
    pub fn samples(&self) -> usize {
        self.samples as usize
    }

    /// Returns the pixels of a row of the picture.
    pub fn picture_width(&self) -> usize {
        (self.width / self.samples) as usize
    }

    /// Returns the number of rows of the picture.
    pub fn picture_height(&self) -> usize {
        (self.height / self.samples) as usize
    }

    /// Returns the colour of pixels that nothing covers.
    pub fn background(&self) -> Rgb {
        self.background
    }

    /// Returns the interpolation of attributes over the screen.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Returns the method of hidden surface removal.
    pub fn hidden_surfaces(&self) -> HiddenSurfaces {
        self.hidden_surfaces
    }

    /// Returns the kind of clipping. Under [`Clipping::NdcCube`] samples are drawn where their depth is in 0..=1.
    pub fn clipping(&self) -> Clipping {
        self.clipping
    }

    /// True if nearer polygons hide farther ones (strictly less depth wins); without it, later ones hide earlier ones.
    pub fn depth_test(&self) -> bool {
        matches!(self.hidden_surfaces, HiddenSurfaces::ZBuffer(_))
    }

    /// Returns the distances at which depth is 0 and 1, from which depth at each sample is computed.
    pub fn depth_range(&self) -> DepthRange {
        self.depth_range
    }

    /// Returns the encoding of colours in eight bits.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// Returns the meaning of colours where polygons cover a pixel in part: straight alpha unless [`Frame::set_alpha`] said
    /// otherwise.
    pub fn alpha(&self) -> Alpha {
        self.alpha
    }

    /// Sets the meaning of colours where polygons cover a pixel in part, for all pictures that are drawn from now on, also
    /// when [`PreparedScene::frame_into`] has filled the frame anew. Only frames with several samples per pixel have such pixels.
    pub fn set_alpha(&mut self, alpha: Alpha) {
        self.alpha = alpha;
    }

    /// Returns the point in the world that [`Frame::position`] and positions of lights and eye count from: the eye, or the
    /// middle of a scene that the eye is far from; 0 if none was given.
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// Returns all vertices in screen space. Not all of them need be corners of a polygon; those without pixel coordinates
    /// (behind the eye, far outside the view) stand at 0, 0.
    pub fn vertices(&self) -> &[ScreenVertex] {
        &self.vertices
    }

    /// Returns the unit normal of a vertex in world space (L21 3.1). At a clip corner it means nothing.
    #[inline(always)]
    pub fn normal(&self, vertex: u32) -> [f32; 3] {
        self.geometry.normal(vertex)
    }

    /// Returns the unit normals of all vertices as one slice; `None` with clip corners, second sides, or attributes that are
    /// not linear on the screen.
    pub(crate) fn normals_on_screen(&self) -> Option<&[[f32; 3]]> {
        let normals = &self.geometry.normals;
        (self.interpolation == Interpolation::Screen && normals.len() == self.vertices.len())
            .then_some(normals)
    }

    /// Returns the material of a vertex: its index in [`Frame::lightings`].
    #[inline(always)]
    pub fn material(&self, vertex: u32) -> u32 {
        match self.geometry.material(vertex) {
            Some(material) => material,
            None => self.cut_materials[vertex as usize - self.geometry.vertex_count()],
        }
    }

    /// Returns a vertex without its position and colour, as [`FrameBuilder::vertex`] takes it.
    ///
    /// # Panics
    /// When there is no such vertex.
    pub fn vertex(&self, vertex: u32) -> Vertex {
        let ScreenVertex { x, y, depth, inv_w } = self.vertices[vertex as usize];
        Vertex {
            x,
            y,
            depth,
            inv_w,
            normal: self.normal(vertex),
            material: self.material(vertex),
        }
    }

    /// Returns the weight by which what a vertex carries is interpolated: 1/w under perspective
    /// interpolation, in a unit in which the frame's nearest vertex has about 1; else 1.
    ///
    /// Only ratios of weights matter. near/w itself may be so small that its square is 0 in `f32`.
    #[inline(always)]
    pub(crate) fn weight(&self, vertex: u32) -> f32 {
        match self.interpolation {
            Interpolation::Screen => 1.0,
            Interpolation::Perspective => self.scaled_weight(&self.vertices[vertex as usize]),
        }
    }

    /// Returns near/w of a vertex in that unit.
    #[inline(always)]
    pub(crate) fn scaled_weight(&self, vertex: &ScreenVertex) -> f32 {
        (vertex.inv_w * self.weight_scale) as f32
    }

    /// Chooses the unit of weights, where near/w goes from `least` to `largest`, or is rounded down to powers of two.
    ///
    /// # Errors
    /// [`FrameError::Weights`] if perspective interpolation needs weights that methods cannot square in `f32`: measured, pictures
    /// are right up to a ratio of 10¹⁸ and wrong from 10²⁰ on.
    pub(crate) fn scale_weights(&mut self, least: f64, largest: f64) -> Result<(), FrameError> {
        const MOST: f64 = (1u64 << 60) as f64;
        if !(largest > 0.0 && largest.is_finite()) {
            self.weight_scale = 1.0;
            return Ok(());
        }
        // A power of two changes no bit of a ratio.
        self.weight_scale = libm::scalbn(1.0, -libm::frexp(largest).1);
        let is_used = self.interpolation == Interpolation::Perspective;
        match is_used && least < largest / MOST {
            true => Err(FrameError::Weights),
            false => Ok(()),
        }
    }

    /// Returns the position of a vertex relative to [`Frame::origin`], in world units along the axes of the world: points near
    /// the eye, where precision matters, have small coordinates. 0 if the frame was given no positions. At a clip corner it
    /// means nothing, like the normal.
    #[inline(always)]
    pub fn position(&self, vertex: u32) -> [f32; 3] {
        self.geometry.position(vertex, self.origin)
    }

    /// Returns the attributes of a vertex, which a method may read ([`Lit::attributes`](crate::shading::Lit::attributes)): four numbers of
    /// [`FrameBuilder::attributes`] or of [`MeshBuilder::attributes`](crate::mesh::MeshBuilder::attributes), else its colour and 1. At a clip
    /// corner they mean nothing.
    pub fn attributes(&self, vertex: u32) -> [f32; 4] {
        self.geometry.attributes(vertex)
    }

    /// Returns the colour of a vertex, linear: the first three of its attributes; white if the frame was given none. At a
    /// clip corner it means nothing.
    #[inline(always)]
    pub fn colour(&self, vertex: u32) -> [f32; 3] {
        let [r, g, b, _] = self.geometry.attributes(vertex);
        [r, g, b]
    }

    /// Returns the mean of a polygon's corners as they were before it was clipped or cut into triangles.
    pub fn mean(&self, polygon: &Polygon) -> Mean {
        let stated = self.stated_mean(polygon);
        stated.unwrap_or_else(|| self.mean_of(self.corners(polygon)))
    }

    /// Returns the mean that was stated for a polygon, as for pieces of others; `None` if it is that of its own corners.
    pub(crate) fn stated_mean(&self, polygon: &Polygon) -> Option<Mean> {
        // Corner lists do not overlap, so the first corner tells polygons apart.
        let place = self
            .means
            .binary_search_by_key(&polygon.first, |&(first, _)| first);
        Some(self.means[place.ok()?].1)
    }

    pub(crate) fn mean_of(&self, corners: &[u32]) -> Mean {
        let share = 1.0 / corners.len() as f64;
        let mut sum = [[0.0f64; 3]; 3];
        for &corner in corners {
            let vectors = [
                self.position(corner),
                self.normal(corner),
                self.colour(corner),
            ];
            for (sum, v) in sum.iter_mut().zip(vectors) {
                for (sum, c) in sum.iter_mut().zip(v) {
                    *sum += share * f64::from(c);
                }
            }
        }
        let [position, normal, colour] = sum.map(|v| v.map(|c| c as f32));
        Mean {
            position,
            normal,
            colour,
        }
    }

    /// True if a material is multiplied by vertex colours.
    pub(crate) fn is_coloured(&self) -> bool {
        self.lightings
            .iter()
            .any(|lighting| lighting.vertex_colours)
    }

    /// True if the vectors toward a light or toward the eye differ from point to point.
    pub fn is_local(&self) -> bool {
        self.is_local
    }

    /// Returns the vertices that clipping made, in ascending order of their number.
    pub fn clip_corners(&self) -> &[ClipCorner] {
        &self.clip_corners
    }

    /// Returns the edge on which clipping made a vertex; `None` for the scene's own vertices.
    pub fn clip_corner(&self, vertex: u32) -> Option<ClipCorner> {
        let place = self
            .clip_corners
            .binary_search_by_key(&vertex, |c| c.vertex);
        Some(self.clip_corners[place.ok()?])
    }

    /// Returns all polygons, in drawing order.
    pub fn polygons(&self) -> &[Polygon] {
        &self.polygons
    }

    /// Returns the vertex numbers of a polygon's corners, in order.
    #[inline]
    pub fn corners(&self, polygon: &Polygon) -> &[u32] {
        let (first, count) = (polygon.first as usize, polygon.count as usize);
        let shared = &self.geometry.corners;
        if first < shared.len() {
            &shared[first..][..count]
        } else {
            &self.cut_corners[first - shared.len()..][..count]
        }
    }

    /// Returns the unit normal of a polygon by Newell's formula, in world space (L21 1.1).
    #[inline(always)]
    pub fn polygon_normal(&self, polygon: &Polygon) -> [f32; 3] {
        self.geometry.face(polygon.face)
    }

    /// Returns the light on each material; all have the same number of lights.
    pub fn lightings(&self) -> &[Lighting] {
        &self.lightings
    }

    /// Returns the number of lights.
    pub fn light_count(&self) -> usize {
        self.lightings.first().map_or(0, |l| l.lights.len())
    }

    /// Returns counts of the scene's polygons by their fate.
    pub fn stats(&self) -> FrameStats {
        self.stats
    }

    /// Puts the polygons into another order: `order` has the number of each once.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        self.polygons = order
            .iter()
            .map(|&number| self.polygons[number as usize])
            .collect();
    }

    /// Returns a copy with other polygons over the same vertices: `pieces` gives the corner lists that replace each
    /// polygon.
    pub(crate) fn with_pieces(
        &self,
        mut pieces: impl FnMut(&Polygon, &mut dyn FnMut(&[u32])),
    ) -> Frame {
        let shared = self.geometry.corners.len();
        let mut cut_corners = Vec::new();
        let mut polygons = Vec::new();
        let mut means = Vec::new();
        for polygon in &self.polygons {
            let mean = self.mean(polygon);
            let is_whole = self
                .means
                .binary_search_by_key(&polygon.first, |&(first, _)| first)
                .is_err();
            pieces(polygon, &mut |piece| {
                let first = (shared + cut_corners.len()) as u32;
                if !is_whole || piece.len() != polygon.count as usize {
                    means.push((first, mean));
                }
                polygons.push(Polygon {
                    first,
                    count: piece.len() as u32,
                    ..*polygon
                });
                cut_corners.extend_from_slice(piece);
            });
        }
        Frame {
            cut_corners,
            polygons,
            means,
            ..self.clone()
        }
    }
}
