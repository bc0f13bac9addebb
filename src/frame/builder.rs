//! A builder of frames, which checks everything once.

use super::guard::{self, Checked, FINITE, POSITION};
use super::painter_order::back_to_front;
use super::projection::{ClipSpace, Scratch};
use super::{
    ClipCorner, DepthRange, Frame, FrameError, FrameItem, FrameStats, Geometry, Mean, Polygon,
    ScreenVertex, Vertex,
};
use crate::picture::{Alpha, Encoding, Rgb};
use crate::scene::ranges::{COORDINATE, DISTANCE, NumberRange, PIXEL, STRENGTH};
use crate::scene::{Clipping, HiddenSurfaces, Interpolation, Lighting, Scene};
use crate::sync::Arc;
use alloc::vec::Vec;
use glam::DVec4;

/// A builder of a frame. It collects vertices and polygons and then checks them once, so code that
/// reads the frame need not check again.
///
/// `examples/own_triangles.rs` is a whole program. To make one frame after another, keep the
/// builder: [`FrameBuilder::frame`] lends its frame, and [`FrameBuilder::clear`] empties it. The
/// next frame reuses the memory of the last one. After the first frame of a given size, only
/// clipping and sorting allocate.
///
/// ```
/// use fastphong::frame::{FrameBuilder, Vertex};
/// use fastphong::glam::DVec3;
/// use fastphong::mesh::Material;
/// use fastphong::picture::Picture8;
/// use fastphong::raster::DrawOptions;
/// use fastphong::scene::{Light, Lighting};
/// use fastphong::shading::methods;
///
/// let mut builder = FrameBuilder::new(64, 64);
/// let light = Light::directional(DVec3::Z, [1.0; 3]);
/// let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[light], DVec3::Z));
/// let mut picture = Picture8::new(64, 64, [0; 4]);
/// for step in 0..3 {
///     builder.clear();
///     let corners = [[8, 8], [24, 56], [40, 8]].map(|[x, y]| {
///         let place = [f64::from(x + 8 * step), f64::from(y)];
///         builder.vertex(Vertex { material, ..Vertex::new(place, 0.5, [0.0, 0.0, 1.0]) })
///     });
///     builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
///     let frame = builder.frame()?;
///     methods::PHONG_RSQRT.variant().draw(frame, &mut picture, DrawOptions::default())?;
/// }
/// assert_eq!(picture.get(16, 16)[3], 0, "where the triangle was at first");
/// assert_eq!(picture.get(40, 16)[3], 255);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FrameBuilder {
    /// The caller's settings and materials, and the last frame. Its first vertices are the ones
    /// that were passed; behind them are the vertices that clipping added.
    frame: Frame,
    /// True for each vertex that has a position; empty if none has.
    has_position: Vec<bool>,
    /// The vertices that were passed in clip space, in ascending order, and their positions.
    in_clip_space: Vec<(u32, DVec4)>,
    /// Polygons, means, clip corners and counts as they were passed.
    polygons: Vec<Polygon>,
    means: Vec<(u32, Mean)>,
    clip_corners: Vec<ClipCorner>,
    stats: FrameStats,
}

impl FrameBuilder {
    /// Returns a builder of an empty frame of `width` × `height` samples. By default each sample is
    /// a pixel, the background is black, the depth buffer holds `f32`, and attributes are linear on
    /// the screen.
    pub fn new(width: u32, height: u32) -> Self {
        FrameBuilder {
            frame: Frame::empty(width, height),
            has_position: Vec::new(),
            in_clip_space: Vec::new(),
            polygons: Vec::new(),
            means: Vec::new(),
            clip_corners: Vec::new(),
            stats: FrameStats::default(),
        }
    }

    /// Removes all vertices and polygons, and keeps their memory. Settings and materials stay.
    pub fn clear(&mut self) -> &mut Self {
        let geometry = self.geometry();
        let Geometry {
            normals,
            materials,
            attributes,
            positions,
            corners,
            faces,
            ..
        } = geometry;
        normals.clear();
        materials.clear();
        attributes.clear();
        positions.clear();
        corners.clear();
        faces.clear();
        self.has_position.clear();
        self.in_clip_space.clear();
        self.polygons.clear();
        self.means.clear();
        self.clip_corners.clear();
        self.take_back();
        self.frame.polygons.clear();
        self
    }

    /// Removes all materials. Call it when lights change, then add the materials again.
    pub fn clear_lightings(&mut self) -> &mut Self {
        self.frame.lightings.clear();
        self
    }

    /// Sets the size of the frame in samples, as in [`FrameBuilder::new`].
    pub fn size(&mut self, width: u32, height: u32) -> &mut Self {
        (self.frame.width, self.frame.height) = (width, height);
        self
    }

    /// Sets how many samples a pixel has along each side: 1, 2, 4 or 8. The frame's width and
    /// height must be multiples of it.
    pub fn samples(&mut self, samples: u32) -> &mut Self {
        self.frame.samples = samples;
        self
    }

    /// Sets the linear colour of pixels that no polygon covers.
    pub fn background(&mut self, colour: Rgb) -> &mut Self {
        self.frame.background = colour;
        self
    }

    /// Sets how attributes are interpolated over the screen.
    pub fn interpolation(&mut self, interpolation: Interpolation) -> &mut Self {
        self.frame.interpolation = interpolation;
        self
    }

    /// Sets how hidden surfaces are removed.
    pub fn hidden_surfaces(&mut self, how: HiddenSurfaces) -> &mut Self {
        self.frame.hidden_surfaces = how;
        self
    }

    /// Sets the kind of clipping, which may test the depth of each sample.
    pub fn clipping(&mut self, clipping: Clipping) -> &mut Self {
        self.frame.clipping = clipping;
        self
    }

    /// Sets the distances from the eye at which depth is 0 and 1. By default they are 0 and 1,
    /// orthographic. A far distance of infinity, as in matrices without a far plane, stands for
    /// 10²⁰.
    pub fn depth_range(&mut self, range: DepthRange) -> &mut Self {
        self.frame.depth_range = range.bounded();
        self
    }

    /// Sets the encoding of colours in eight bits.
    pub fn encoding(&mut self, encoding: Encoding) -> &mut Self {
        self.frame.encoding = encoding;
        self
    }

    /// Sets what a colour means where polygons cover a pixel in part. It matters only with several
    /// samples per pixel.
    pub fn alpha(&mut self, alpha: Alpha) -> &mut Self {
        self.frame.alpha = alpha;
        self
    }

    /// Sets the initial statistics: how many of the scene's polygons were culled or left out.
    /// Clipping adds to them.
    pub fn stats(&mut self, stats: FrameStats) -> &mut Self {
        self.stats = stats;
        self
    }

    /// Adds a material with the light on it, and returns its index. Directions of any length become
    /// unit vectors.
    pub fn lighting(&mut self, mut lighting: Lighting) -> u32 {
        guard::make_unit(&mut lighting);
        self.frame.lightings.push(lighting);
        (self.frame.lightings.len() - 1) as u32
    }

    /// Sets the point in the world from which positions are measured. See [`Frame::origin`].
    pub fn origin(&mut self, point: [f64; 3]) -> &mut Self {
        self.frame.origin = point;
        self
    }

    /// Adds a vertex, and returns its index. A normal of any length becomes a unit vector.
    pub fn vertex(&mut self, vertex: Vertex) -> u32 {
        let Vertex {
            x,
            y,
            depth,
            inv_w,
            normal,
            material,
        } = vertex;
        self.add(ScreenVertex { x, y, depth, inv_w }, normal, material)
    }

    /// Adds a vertex by its position in clip space, `[x, y, z, w]`, and returns its index. A normal
    /// of any length becomes a unit vector.
    ///
    /// Polygons of such vertices are clipped as a scene's polygons are: each whole polygon in clip
    /// space, at the planes of the view and at the guard band. A vertex behind the eye, whose w is
    /// 0 or less, is allowed.
    ///
    /// Clip space is the one of [`Camera::clip_matrix`](crate::scene::Camera::clip_matrix): x and y
    /// go from −w to w, from left to right and from bottom to top. The rest depends on
    /// [`FrameBuilder::depth_range`]:
    ///
    /// - perspective: w is the distance from the eye along the line of sight, and is clipped at the
    ///   near and the far distance. z is not read. So matrices with depths from −1 to 1, reversed
    ///   ones and those without a far plane all work;
    /// - orthographic, or no range set: w is 1, and z is clipped at 0, the near plane, and at 1.
    ///
    /// A frame may have vertices on the screen and in clip space. A polygon that mixes both must
    /// not need clipping. A polygon outside the view is left out, and so is one without an area:
    /// see [`Frame::stats`]. No side is culled.
    ///
    /// ```
    /// use fastphong::frame::{DepthRange, FrameBuilder};
    /// use fastphong::glam::{DMat4, DVec3};
    /// use fastphong::mesh::Material;
    /// use fastphong::scene::{Interpolation, Light, Lighting};
    ///
    /// let mut builder = FrameBuilder::new(64, 48);
    /// let light = Light::directional(DVec3::Y, [1.0; 3]);
    /// let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[light], DVec3::Z));
    /// builder.depth_range(DepthRange::Perspective { near: 0.1, far: 100.0 });
    /// builder.interpolation(Interpolation::Perspective);
    /// // A floor that reaches from far in front of the eye to far behind it.
    /// let projection = DMat4::from_cols_array(&[
    ///     0.75, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0, -0.1, 0.0,
    /// ]);
    /// let corners = [[-9.0, -50.0], [-9.0, 50.0], [9.0, 50.0], [9.0, -50.0]].map(|[x, z]| {
    ///     let position = projection * DVec3::new(x, -1.0, z).extend(1.0);
    ///     builder.vertex_from_clip(position.to_array(), [0.0, 1.0, 0.0], material)
    /// });
    /// builder.polygon(&corners, [0.0, 1.0, 0.0], 0);
    /// let frame = builder.finish()?;
    /// assert_eq!((frame.stats().clipped, frame.polygons().len()), (1, 1));
    /// # Ok::<(), fastphong::frame::FrameError>(())
    /// ```
    pub fn vertex_from_clip(&mut self, position: [f64; 4], normal: [f32; 3], material: u32) -> u32 {
        let vertex = self.add(ScreenVertex::default(), normal, material);
        let position = DVec4::from_array(position);
        self.in_clip_space.push((vertex, position));
        vertex
    }

    fn add(&mut self, vertex: ScreenVertex, normal: [f32; 3], material: u32) -> u32 {
        self.take_back();
        let geometry = self.geometry();
        geometry.normals.push(guard::unit(normal));
        geometry.materials.push(material);
        self.frame.vertices.push(vertex);
        (self.frame.vertices.len() - 1) as u32
    }

    /// Removes everything that the last frame added.
    fn take_back(&mut self) {
        let frame = &mut self.frame;
        frame.vertices.truncate(frame.geometry.normals.len());
        frame.cut_materials.clear();
        frame.cut_corners.clear();
        frame.clip_corners.clear();
        frame.means.clear();
    }

    /// Returns the frame's geometry, unshared. Copies it if a clone of the frame still uses it.
    fn geometry(&mut self) -> &mut Geometry {
        Arc::make_mut(&mut self.frame.geometry)
    }

    /// Sets the position of a vertex, as in [`Frame::position`]. If a light or the eye is at a
    /// position, every vertex needs one, except clip corners; else set it for all or for none.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn position(&mut self, vertex: u32, position: [f32; 3]) -> &mut Self {
        let geometry = self.geometry();
        let count = geometry.normals.len();
        geometry.positions.resize(count, [0.0; 3]);
        geometry.positions[vertex as usize] = position;
        self.has_position.resize(count, false);
        self.has_position[vertex as usize] = true;
        self
    }

    /// Sets the colour of a vertex: its attributes become the colour and 1.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn colour(&mut self, vertex: u32, [r, g, b]: [f32; 3]) -> &mut Self {
        self.attributes(vertex, [r, g, b, 1.0])
    }

    /// Sets the attributes of a vertex: four values for your own method. See [`Frame::attributes`].
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn attributes(&mut self, vertex: u32, attributes: [f32; 4]) -> &mut Self {
        let geometry = self.geometry();
        let count = geometry.normals.len();
        geometry.attributes.resize(count, Geometry::NO_ATTRIBUTES);
        geometry.attributes[vertex as usize] = attributes;
        self
    }

    /// Sets the mean of the next polygon to the mean of `corners`, of which there must be at least
    /// one. Use it for the pieces of a clipped polygon, whose mean is the whole polygon's.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn mean_of(&mut self, corners: &[u32]) -> &mut Self {
        let mean = self.frame.mean_of(corners);
        self.mean(mean)
    }

    /// Sets the mean of the next polygon's corners. A mean of unit vectors is never longer than 1,
    /// so a longer normal becomes a unit vector.
    pub fn mean(&mut self, mut mean: Mean) -> &mut Self {
        let square: f32 = mean.normal.iter().map(|n| n * n).sum();
        if square > 1.0 {
            mean.normal = guard::unit(mean.normal);
        }
        let next = self.frame.geometry.corners.len() as u32;
        self.means.push((next, mean));
        self
    }

    /// Declares that a vertex lies on the edge between two others. Declare vertices in ascending
    /// order.
    pub fn clip_corner(&mut self, corner: ClipCorner) -> &mut Self {
        let face = guard::unit(corner.face);
        self.clip_corners.push(ClipCorner { face, ..corner });
        self
    }

    /// Adds a polygon, in drawing order. `corners` are vertex indices in either winding. `normal`
    /// is for flat shading, and becomes a unit vector. `source` is an id of your choice
    /// ([`Polygon::source`]). The polygon has the material of its first corner.
    pub fn polygon(&mut self, corners: &[u32], normal: [f32; 3], source: u32) -> &mut Self {
        let geometry = self.geometry();
        let material = corners
            .first()
            .and_then(|&v| geometry.materials.get(v as usize))
            .map_or(u32::MAX, |m| *m);
        let (first, count, face) = (
            geometry.corners.len() as u32,
            corners.len() as u32,
            geometry.faces.len() as u32,
        );
        geometry.faces.push(guard::unit(normal));
        geometry.corners.extend_from_slice(corners);
        self.polygons.push(Polygon {
            first,
            count,
            material,
            source,
            face,
        });
        self
    }

    /// Checks and returns the frame. Under the painter's algorithm its polygons are sorted from
    /// back to front.
    ///
    /// # Errors
    /// [`FrameError`] for the first size, count, value or index that is outside its range, a normal
    /// or a direction that is not finite or has length 0, or a vertex that lacks a needed position.
    /// It names the item and the value.
    pub fn finish(mut self) -> Result<Frame, FrameError> {
        self.make()?;
        Ok(self.frame)
    }

    /// Checks and lends the frame that [`FrameBuilder::finish`] would return. The builder keeps
    /// everything that it was passed, and you can add more.
    ///
    /// A clone of the frame keeps its geometry; the builder then copies the geometry when it
    /// changes.
    ///
    /// # Errors
    /// [`FrameError`] as for [`FrameBuilder::finish`].
    pub fn frame(&mut self) -> Result<&Frame, FrameError> {
        self.make()?;
        Ok(&self.frame)
    }

    /// Makes the frame from what was passed.
    fn make(&mut self) -> Result<(), FrameError> {
        self.take_back();
        let frame = &mut self.frame;
        frame.polygons.clear();
        frame.polygons.extend_from_slice(&self.polygons);
        frame.clip_corners.extend_from_slice(&self.clip_corners);
        frame.means.extend_from_slice(&self.means);
        frame.stats = self.stats;
        frame.is_local = frame.lightings.iter().any(Lighting::is_local);
        frame.check_settings()?;
        if frame.geometry.corners.len() > u32::MAX as usize
            || frame.vertices.len() > u32::MAX as usize
            || frame.polygons.len() > Polygon::FLIPPED as usize
        {
            return Err(FrameError::TooLarge);
        }
        frame.check_lightings()?;
        frame.check_clip_corners()?;
        let clip_space = ClipSpace::new(frame, &self.in_clip_space);
        clip_space.place(frame)?;
        for index in 0..frame.vertices.len() {
            frame.check_vertex(index)?;
        }
        check_positions(frame, &self.has_position)?;
        for (index, polygon) in frame.polygons.iter().enumerate() {
            frame.check_polygon(index, polygon)?;
        }
        frame.check_means()?;
        clip_space.clip(frame, &self.polygons)?;
        // A vertex without a place on the picture has the least positive weight, which must not
        // count.
        let weights = frame
            .vertices
            .iter()
            .map(|v| v.inv_w)
            .filter(|w| *w > f64::MIN_POSITIVE);
        let [least, largest] = [
            weights.clone().fold(f64::INFINITY, f64::min),
            weights.fold(0.0, f64::max),
        ];
        frame.scale_weights(least, largest)?;
        frame.sort();
        Ok(())
    }
}

impl Frame {
    /// Returns a frame without vertices and polygons.
    pub(crate) fn empty(width: u32, height: u32) -> Frame {
        Frame {
            width,
            height,
            samples: 1,
            background: [0.0; 3],
            interpolation: Interpolation::Screen,
            hidden_surfaces: HiddenSurfaces::default(),
            clipping: Clipping::Planes,
            depth_range: DepthRange::default(),
            weight_scale: 1.0,
            encoding: Encoding::Linear,
            alpha: Alpha::Straight,
            origin: [0.0; 3],
            geometry: Arc::new(Geometry::default()),
            vertices: Vec::new(),
            cut_materials: Vec::new(),
            means: Vec::new(),
            clip_corners: Vec::new(),
            cut_corners: Vec::new(),
            polygons: Vec::new(),
            lightings: Vec::new(),
            is_local: false,
            stats: FrameStats::default(),
            scratch: Scratch::default(),
        }
    }

    /// Checks that size, samples, clipping, background, depth range and origin are in their ranges
    /// and fit together.
    pub(crate) fn check_settings(&self) -> Result<(), FrameError> {
        let side = 1..=Scene::MAX_SIDE;
        let &Frame {
            width,
            height,
            samples,
            ..
        } = self;
        if !side.contains(&width) || !side.contains(&height) {
            return Err(FrameError::Size { width, height });
        }
        if ![1, 2, 4, 8].contains(&samples)
            || ![width, height]
                .iter()
                .all(|side| side.is_multiple_of(samples))
        {
            return Err(FrameError::Samples { samples });
        }
        if self.clipping == Clipping::NdcCube && self.interpolation == Interpolation::Perspective {
            return Err(FrameError::Unclipped);
        }
        let names = [
            "red of the background",
            "green of the background",
            "blue of the background",
        ];
        guard::check_all(FrameItem::Picture, names, self.background, &PIXEL)?;
        self.depth_range.check()?;
        let names = ["x of the origin", "y of the origin", "z of the origin"];
        guard::check_all(FrameItem::Scene, names, self.origin, &COORDINATE)
    }

    /// Checks that every material has the same count of lights, and that all values are in their
    /// ranges.
    pub(crate) fn check_lightings(&self) -> Result<(), FrameError> {
        let lights = self.light_count();
        for lighting in &self.lightings {
            if lighting.lights.len() != lights || lights > Scene::MAX_LIGHTS {
                return Err(FrameError::Lights {
                    found: lighting.lights.len(),
                });
            }
        }
        let mut all = self.lightings.iter().enumerate();
        all.try_for_each(|(material, lighting)| guard::lighting(material, lighting))
    }

    /// Sorts the polygons from back to front, if the frame uses the painter's algorithm.
    pub(crate) fn sort(&mut self) {
        if let HiddenSurfaces::Painter(key) = self.hidden_surfaces {
            let order = back_to_front(self, key);
            self.reorder(&order);
        }
    }

    fn check_clip_corners(&self) -> Checked {
        let mut previous = None;
        for (index, corner) in self.clip_corners.iter().enumerate() {
            let is_valid = corner.a < corner.vertex
                && corner.b < corner.vertex
                && (corner.vertex as usize) < self.vertices.len()
                && previous.is_none_or(|p| p < corner.vertex);
            if !is_valid {
                return Err(FrameError::ClipCorner { index });
            }
            previous = Some(corner.vertex);
            let item = FrameItem::ClipCorner(index);
            guard::check(item, "its parameter", corner.t, &PIXEL)?;
            guard::direction(item, NORMAL, corner.face)?;
        }
        Ok(())
    }

    fn check_vertex(&self, index: usize) -> Checked {
        let item = FrameItem::Vertex(index);
        let vertex = self.vertex(index as u32);
        guard::check(item, "its column", vertex.x, &GUARD)?;
        guard::check(item, "its row", vertex.y, &GUARD)?;
        let (depth, weight) = match self.clipping {
            Clipping::Planes => (&depths(self.depth_range), &WEIGHT),
            Clipping::NdcCube => (&FINITE, &FINITE),
        };
        guard::check(item, "its depth", vertex.depth, depth)?;
        guard::check(item, "its near/w", vertex.inv_w, weight)?;
        if self.clip_corner(index as u32).is_none() {
            guard::direction(item, NORMAL, vertex.normal)?;
        }
        let geometry = &self.geometry;
        if let Some(position) = geometry.positions.get(index) {
            guard::check_all(item, POSITION, *position, &DISTANCE)?;
        }
        if let Some(attributes) = geometry.attributes.get(index) {
            guard::check_all(item, ["an attribute"; 4], *attributes, &FINITE)?;
            let material = self.lightings.get(vertex.material as usize);
            if material.is_some_and(|lighting| lighting.vertex_colours) {
                let [r, g, b, _] = *attributes;
                guard::check_all(item, guard::COLOUR, [r, g, b], &STRENGTH)?;
            }
        }
        let materials = NumberRange::new(
            0.0,
            self.lightings.len() as f64 - 1.0,
            "the index of a material that was added",
        );
        guard::check(item, "its material", vertex.material, &materials)
    }

    fn check_polygon(&self, index: usize, polygon: &Polygon) -> Checked {
        let is_valid = polygon.count >= 3
            && (polygon.material as usize) < self.lightings.len()
            && self.corners(polygon).iter().all(|&v| {
                (v as usize) < self.vertices.len() && self.material(v) == polygon.material
            });
        if !is_valid {
            return Err(FrameError::Polygon { index });
        }
        let item = FrameItem::Polygon(index);
        guard::direction(item, NORMAL, self.polygon_normal(polygon))
    }

    fn check_means(&self) -> Checked {
        let names = ["x of its mean", "y of its mean", "z of its mean"];
        for (first, mean) in &self.means {
            let index = self.polygons.partition_point(|p| p.first < *first);
            let item = FrameItem::Polygon(index);
            guard::check_all(item, names, mean.position, &DISTANCE)?;
            guard::check_all(item, NORMAL_MEAN, mean.normal, &FINITE)?;
            let material = self.polygons.get(index).map(|p| p.material as usize);
            let lighting = material.and_then(|material| self.lightings.get(material));
            let colours = match lighting {
                Some(lighting) if lighting.vertex_colours => &STRENGTH,
                _ => &FINITE,
            };
            guard::check_all(item, guard::COLOUR, mean.colour, colours)?;
        }
        Ok(())
    }
}

const NORMAL: [&str; 4] = [
    "x of its normal",
    "y of its normal",
    "z of its normal",
    "the length of its normal",
];
const NORMAL_MEAN: [&str; 3] = [
    "x of its mean normal",
    "y of its mean normal",
    "z of its mean normal",
];

/// The pixel coordinates that a vertex may have.
const GUARD: NumberRange = NumberRange::new(
    -(Frame::GUARD as f64),
    Frame::GUARD as f64,
    "pixels from -32768 to 32768",
);
const _: () = assert!(Frame::GUARD == 32_768);

/// How far rounding may move a vertex beyond the near or the far plane. A cut may lie beyond its
/// plane by up to 10⁻⁹ of its largest coordinate (`View::is_on_picture`), which in the guard band
/// is up to 2¹⁵ + 1 times w.
const BEYOND: f64 = 1.0 / (1 << 14) as f64;
const WEIGHT: NumberRange =
    NumberRange::new(f64::from_bits(1), 1.0 + BEYOND, "a number over 0, up to 1");

/// Returns the range of depths between the near and the far plane.
fn depths(range: DepthRange) -> NumberRange {
    let [near, far] = range.depths();
    match range {
        DepthRange::Orthographic { .. } => NumberRange::new(near - BEYOND, far + BEYOND, "0 to 1"),
        DepthRange::Perspective { .. } => NumberRange::new(
            near * (1.0 + BEYOND),
            far * (1.0 - BEYOND),
            "−1/w, from −1/near to −1/far",
        ),
    }
}

/// Checks that no vertex lacks a position if other vertices have theirs, or if a light or the eye
/// is at a position.
fn check_positions(frame: &Frame, has_position: &[bool]) -> Checked {
    if !frame.is_local() && has_position.is_empty() {
        return Ok(());
    }
    let lacks = |&index: &usize| {
        let is_given = has_position.get(index) == Some(&true);
        !is_given && frame.clip_corner(index as u32).is_none()
    };
    match (0..frame.vertices.len()).find(lacks) {
        Some(index) => Err(FrameError::Position { index }),
        None => Ok(()),
    }
}
