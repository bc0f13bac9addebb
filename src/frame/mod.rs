//! Projected polygons and the light on them, ready to draw.
//!
//! A [`Frame`] is the interface between geometry and shading. Making a frame may fail; drawing it
//! cannot, unless the method refuses it. There are two ways to make one:
//!
//! | you have | hold from frame to frame | next frame |
//! |---|---|---|
//! | a [`Scene`] | a [`PreparedScene`] and a [`Frame`] | [`PreparedScene::frame_into`] |
//! | your own vertices, on the screen or in clip space | a [`FrameBuilder`] | [`FrameBuilder::clear`], your vertices and polygons, [`FrameBuilder::frame`] |
//!
//! Both reuse their memory. From the second frame of a size on, only clipping and sorting allocate
//! memory that grows with the scene. For a single picture, [`Scene::frame`] and
//! [`FrameBuilder::finish`] are shorter.
//!
//! ```
//! use fastphong::glam::{DAffine3, DVec3};
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::picture::Picture8;
//! use fastphong::raster::DrawOptions;
//! use fastphong::scene::Scene;
//! use fastphong::shading::methods;
//!
//! let mut scene = Scene::of_mesh(builtin("torus")?);
//! (scene.width, scene.height) = (64, 48);
//! // Once: vertex normals, distinct vertices, normals of polygons.
//! let mut prepared = scene.prepare()?;
//! let mut frame = prepared.frame()?;
//! let mut picture = Picture8::new(64, 48, [0; 4]);
//! let method = methods::PHONG_RSQRT.variant();
//! for step in 0..3 {
//!     // Each time: move the object, project, and draw.
//!     prepared.set_transform(0, DAffine3::from_rotation_y(0.1 * f64::from(step)))?;
//!     prepared.frame_into(&mut frame)?;
//!     method.draw(&frame, &mut picture, DrawOptions::default())?;
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Inside
//!
//! All engines and the `f64` reference read the same frame; the barycentric renderer reads it after
//! `triangulate.rs` cut it into triangles. So their pictures differ by shading and not by geometry.
//! `projection/` makes a frame from a scene, and `painter_order.rs` sorts a frame for the painter's
//! algorithm.

mod builder;
mod depth_range;
mod elements;
mod error;
mod geometry;
pub(crate) mod guard;
mod painter_order;
#[doc(hidden)]
pub mod perspective;
mod projection;
pub(crate) mod row_tiles;
pub mod triangulate;

pub use builder::FrameBuilder;
pub use depth_range::DepthRange;
pub use elements::{ClipCorner, FrameStats, Mean, Polygon, ScreenVertex, Vertex};
pub use error::{FrameError, FrameItem};
pub use geometry::{Geometry, Models, PlacedModel};
pub use projection::PreparedScene;

use crate::picture::{Alpha, Encoding, Rgb};
use crate::scene::{Clipping, HiddenSurfaces, Interpolation, Lighting, Scene};
use crate::sync::Arc;
use alloc::vec::Vec;
use projection::Scratch;

/// A coordinate on the picture in pixels (in samples, if a pixel has several), snapped to 1/256. x
/// goes to the right, y downward. (0, 0) is the outer corner of the first pixel, so pixel centres
/// lie at ½.
///
/// Make it from a float with [`sub_pixel`]: the type's own `from_num` panics or wraps beyond ±2²³
/// pixels.
pub type SubPixel = fixed::types::I24F8;

/// Returns a coordinate in pixels, rounded to the nearest 1/256, halves to even.
///
/// A value beyond the type's range saturates, and NaN becomes the upper end of the range.
/// [`FrameBuilder::finish`] refuses both, as they lie beyond [`Frame::GUARD`].
pub fn sub_pixel(pixels: impl Into<f64>) -> SubPixel {
    let bits = libm::rint(pixels.into() * 256.0);
    if bits.is_nan() {
        SubPixel::MAX
    } else {
        // The conversion saturates.
        SubPixel::from_bits(bits as i32)
    }
}

/// Projected polygons in drawing order, and the light on them.
///
/// All frames of one [`PreparedScene`] share what does not depend on the camera: normals,
/// materials, corner lists. Each frame owns its screen coordinates and the list of its visible
/// polygons.
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
    /// A power of two that multiplies weights of perspective: see [`Frame::weight`].
    pub(crate) weight_scale: f64,
    pub(crate) encoding: Encoding,
    pub(crate) alpha: Alpha,
    pub(crate) origin: [f64; 3],
    pub(crate) geometry: Arc<Geometry>,
    /// The vertices of the geometry, and behind them the vertices that clipping made.
    pub(crate) vertices: Vec<ScreenVertex>,
    /// The materials of the vertices that clipping made.
    pub(crate) cut_materials: Vec<u32>,
    /// The means of cut polygons, by the index of their first corner, in ascending order.
    pub(crate) means: Vec<(u32, Mean)>,
    pub(crate) clip_corners: Vec<ClipCorner>,
    /// The corner lists of cut polygons. Their indices continue the indices of the geometry's
    /// lists.
    pub(crate) cut_corners: Vec<u32>,
    pub(crate) polygons: Vec<Polygon>,
    pub(crate) lightings: Vec<Lighting>,
    /// True if any lighting is local. Stored, because methods ask for each polygon and there may be
    /// many materials.
    pub(crate) is_local: bool,
    pub(crate) stats: FrameStats,
    pub(crate) scratch: Scratch,
}

impl Frame {
    /// The largest distance of a vertex from 0 along an axis, in pixels: twice the largest picture.
    /// It leaves room for the exact products of the edge walk in 64 bits (2²⁴ · 2²⁴ · 2).
    pub const GUARD: i32 = 2 * Scene::MAX_SIDE as i32;

    /// Returns how many samples a row has: its pixels, unless a pixel has several samples. All
    /// coordinates of the frame are in samples.
    pub fn width(&self) -> usize {
        self.width as usize
    }

    /// Returns how many rows of samples there are.
    pub fn height(&self) -> usize {
        self.height as usize
    }

    /// Returns how many samples a pixel has along each side: 1, 2, 4 or 8.
    pub fn samples(&self) -> usize {
        self.samples as usize
    }

    /// Returns how many pixels a row of the picture has.
    pub fn picture_width(&self) -> usize {
        (self.width / self.samples) as usize
    }

    /// Returns how many rows the picture has.
    pub fn picture_height(&self) -> usize {
        (self.height / self.samples) as usize
    }

    /// Returns the linear colour of pixels that no polygon covers.
    pub fn background(&self) -> Rgb {
        self.background
    }

    /// Returns how attributes are interpolated over the screen.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Returns how hidden surfaces are removed.
    pub fn hidden_surfaces(&self) -> HiddenSurfaces {
        self.hidden_surfaces
    }

    /// Returns the kind of clipping. Under [`Clipping::NdcCube`] a sample is drawn if its depth is
    /// in 0..=1.
    pub fn clipping(&self) -> Clipping {
        self.clipping
    }

    /// True if nearer polygons hide farther ones (a strictly smaller depth wins). If false, later
    /// polygons hide earlier ones.
    pub fn depth_test(&self) -> bool {
        matches!(self.hidden_surfaces, HiddenSurfaces::ZBuffer(_))
    }

    /// Returns the distances at which depth is 0 and 1.
    pub fn depth_range(&self) -> DepthRange {
        self.depth_range
    }

    /// Returns the encoding of colours in eight bits.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// Returns what a colour means where polygons cover a pixel in part: straight alpha, unless
    /// [`FrameBuilder::alpha`] or [`Frame::set_alpha`] set something else.
    pub fn alpha(&self) -> Alpha {
        self.alpha
    }

    /// Sets what a colour means where polygons cover a pixel in part. The setting stays when
    /// [`PreparedScene::frame_into`] fills the frame anew. It only matters for frames with several
    /// samples per pixel.
    pub fn set_alpha(&mut self, alpha: Alpha) {
        self.alpha = alpha;
    }

    /// Returns the point in the world from which [`Frame::position`] and the positions of lights
    /// and eye are measured. It is the eye, or the middle of a scene that is far from the eye; 0 if
    /// none was set.
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// Returns all vertices in screen space. Some may be the corner of no polygon. Vertices without
    /// pixel coordinates (behind the eye, far outside the view) are at 0, 0.
    pub fn vertices(&self) -> &[ScreenVertex] {
        &self.vertices
    }

    /// Returns the unit normal of a vertex in world space (L21 3.1). It means nothing at a clip
    /// corner.
    #[inline(always)]
    pub fn normal(&self, vertex: u32) -> [f32; 3] {
        self.geometry.normal(vertex)
    }

    /// Returns the unit normals of all vertices as one slice. `None` if the frame has clip corners
    /// or second sides, or if attributes are not linear on the screen.
    pub(crate) fn normals_on_screen(&self) -> Option<&[[f32; 3]]> {
        let normals = &self.geometry.normals;
        (self.interpolation == Interpolation::Screen && normals.len() == self.vertices.len())
            .then_some(normals)
    }

    /// Returns the material of a vertex, an index into [`Frame::lightings`].
    #[inline(always)]
    pub fn material(&self, vertex: u32) -> u32 {
        match self.geometry.material(vertex) {
            Some(material) => material,
            None => self.cut_materials[vertex as usize - self.geometry.vertex_count()],
        }
    }

    /// Returns a vertex as [`FrameBuilder::vertex`] accepts it, without position and colour.
    ///
    /// # Panics
    /// If there is no such vertex.
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

    /// Returns the weight by which a vertex's varyings are interpolated. Under perspective
    /// interpolation it is 1/w, in a unit in which the nearest vertex of the frame has about 1.
    /// Else it is 1.
    ///
    /// Only ratios of weights matter, so the unit is free. near/w itself may be so small that its
    /// square is 0 in `f32`.
    #[inline(always)]
    pub(crate) fn weight(&self, vertex: u32) -> f32 {
        match self.interpolation {
            Interpolation::Screen => 1.0,
            Interpolation::Perspective => self.scaled_weight(&self.vertices[vertex as usize]),
        }
    }

    /// Returns near/w of a vertex in this unit.
    #[inline(always)]
    pub(crate) fn scaled_weight(&self, vertex: &ScreenVertex) -> f32 {
        (vertex.inv_w * self.weight_scale) as f32
    }

    /// Chooses the unit of weights. near/w goes from `least` to `largest`; both may be rounded down
    /// to powers of two.
    ///
    /// # Errors
    /// [`FrameError::Weights`] if perspective interpolation would need weights whose squares
    /// methods cannot compute in `f32`. Measured: pictures are right up to a ratio of 10¹⁸ and
    /// wrong from 10²⁰ on.
    pub(crate) fn scale_weights(&mut self, least: f64, largest: f64) -> Result<(), FrameError> {
        const MOST: f64 = (1u64 << 60) as f64;
        if !(largest > 0.0 && largest.is_finite()) {
            self.weight_scale = 1.0;
            return Ok(());
        }
        // A power of two changes no bit of a ratio's mantissa.
        self.weight_scale = libm::scalbn(1.0, -libm::frexp(largest).1);
        let is_used = self.interpolation == Interpolation::Perspective;
        if is_used && least < largest / MOST {
            Err(FrameError::Weights)
        } else {
            Ok(())
        }
    }

    /// Returns the position of a vertex relative to [`Frame::origin`], in world units along the
    /// world's axes. Points near the eye, where precision matters, have small coordinates. It is 0
    /// if the frame has no positions, and means nothing at a clip corner.
    #[inline(always)]
    pub fn position(&self, vertex: u32) -> [f32; 3] {
        self.geometry.position(vertex, self.origin)
    }

    /// Returns the attributes of a vertex, which a method may read
    /// ([`LightAt::attributes`](crate::shading::LightAt::attributes)). They are four values of
    /// [`FrameBuilder::attributes`] or of
    /// [`MeshBuilder::attributes`](crate::mesh::MeshBuilder::attributes), else the vertex's colour
    /// and 1. They mean nothing at a clip corner.
    pub fn attributes(&self, vertex: u32) -> [f32; 4] {
        self.geometry.attributes(vertex)
    }

    /// Returns the linear colour of a vertex, which is the first three of its attributes; white if
    /// the frame has none. It means nothing at a clip corner.
    #[inline(always)]
    pub fn colour(&self, vertex: u32) -> [f32; 3] {
        let [r, g, b, _] = self.geometry.attributes(vertex);
        [r, g, b]
    }

    /// Returns the mean of a polygon's corners before the polygon was clipped or cut into
    /// triangles.
    pub fn mean(&self, polygon: &Polygon) -> Mean {
        let stated = self.stated_mean(polygon);
        stated.unwrap_or_else(|| self.mean_of(self.corners(polygon)))
    }

    /// Returns the mean that was stored for a polygon, as it is for pieces of other polygons.
    /// `None` if the polygon's own corners have it.
    pub(crate) fn stated_mean(&self, polygon: &Polygon) -> Option<Mean> {
        // Corner lists do not overlap, so a polygon is known by its first corner.
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

    /// True if any material is multiplied by vertex colours.
    pub(crate) fn is_coloured(&self) -> bool {
        self.lightings
            .iter()
            .any(|lighting| lighting.vertex_colours)
    }

    /// True if the vectors toward a light or toward the eye differ from point to point.
    pub fn is_local(&self) -> bool {
        self.is_local
    }

    /// Returns the vertices that clipping made, by ascending index.
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

    /// Returns the vertices at a polygon's corners, in order.
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

    /// Returns the light on each material. All materials have the same count of lights.
    pub fn lightings(&self) -> &[Lighting] {
        &self.lightings
    }

    /// Returns how many lights there are.
    pub fn light_count(&self) -> usize {
        self.lightings.first().map_or(0, |l| l.lights.len())
    }

    /// True if a polygon belongs to an object that its transform mirrors.
    pub fn is_mirrored(&self, polygon: &Polygon) -> bool {
        let (geometry, corners) = (&self.geometry, self.corners(polygon));
        // Vertices of the second side follow the vertices of the first. Vertices from clipping come
        // last.
        let first_cut = geometry.vertex_count();
        let own = corners.iter().map(|corner| *corner as usize);
        let Some(own) = own.into_iter().find(|corner| *corner < first_cut) else {
            return false;
        };
        let models = &geometry.models;
        let object = models.object_of(own % geometry.normals.len());
        let object = models.objects.get(object);
        object.is_some_and(|object| object.transform.matrix3.determinant() < 0.0)
    }

    /// Returns what became of the scene's polygons, as counts.
    pub fn stats(&self) -> FrameStats {
        self.stats
    }

    /// Puts the polygons into another order. `order` holds the index of each polygon once.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        self.polygons = order
            .iter()
            .map(|&index| self.polygons[index as usize])
            .collect();
    }

    /// Returns all vertices, so that they can be moved. Nothing is checked again.
    #[doc(hidden)]
    pub fn vertices_mut(&mut self) -> &mut [ScreenVertex] {
        &mut self.vertices
    }

    /// Returns all polygons, so that they can be sorted. Nothing is checked again.
    #[doc(hidden)]
    pub fn polygons_mut(&mut self) -> &mut [Polygon] {
        &mut self.polygons
    }

    /// Returns a copy with other polygons over the same vertices. `pieces` calls its second
    /// argument with each corner list that replaces a polygon.
    #[doc(hidden)]
    pub fn with_pieces(&self, mut pieces: impl FnMut(&Polygon, &mut dyn FnMut(&[u32]))) -> Frame {
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
