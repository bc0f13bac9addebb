//! A builder of frames, which checks them once.

use super::painter::back_to_front;
use super::projection::Scratch;
use super::{
    ClipCorner, DepthRange, Frame, FrameError, FrameStats, Geometry, Mean, Polygon, ScreenVertex,
    SubPixel, Vertex,
};
use crate::picture::{Alpha, Encoding, Rgb};
use crate::scene::{
    Clipping, Falloff, HiddenSurfaces, Interpolation, LightTerm, Lighting, Place, Scene,
};
use crate::sync::Arc;
use alloc::vec::Vec;

/// A builder of a frame: collects vertices and polygons, then checks them once, so no reader of the frame needs to.
///
/// `examples/own_triangles.rs` is a whole program.
#[derive(Clone, Debug)]
pub struct FrameBuilder {
    frame: Frame,
}

impl FrameBuilder {
    /// Starts an empty frame of `width` × `height` samples, each of them a pixel, black, with a depth buffer of floats, linear on
    /// the screen.
    pub fn new(width: u32, height: u32) -> Self {
        FrameBuilder {
            frame: Frame::empty(width, height),
        }
    }

    /// Sets the samples of a pixel along each side: 1, 2, 4 or 8. Width and height of the frame must be multiples of it.
    pub fn samples(&mut self, samples: u32) -> &mut Self {
        self.frame.samples = samples;
        self
    }

    /// Sets the colour of pixels that nothing covers.
    pub fn background(&mut self, colour: Rgb) -> &mut Self {
        self.frame.background = colour;
        self
    }

    /// Sets the interpolation of attributes over the screen.
    pub fn interpolation(&mut self, interpolation: Interpolation) -> &mut Self {
        self.frame.interpolation = interpolation;
        self
    }

    /// Sets the method of hidden surface removal.
    pub fn hidden_surfaces(&mut self, how: HiddenSurfaces) -> &mut Self {
        self.frame.hidden_surfaces = how;
        self
    }

    /// Sets the kind of clipping, which may test the depth of each sample.
    pub fn clipping(&mut self, clipping: Clipping) -> &mut Self {
        self.frame.clipping = clipping;
        self
    }

    /// Sets the distances from the eye at which depth is 0 and 1. Without it they are 0 and 1.
    pub fn depth_range(&mut self, range: DepthRange) -> &mut Self {
        self.frame.depth_range = range;
        self
    }

    /// Sets the encoding of colours in eight bits.
    pub fn encoding(&mut self, encoding: Encoding) -> &mut Self {
        self.frame.encoding = encoding;
        self
    }

    /// Sets the counts of the scene's polygons by their fate.
    pub fn stats(&mut self, stats: FrameStats) -> &mut Self {
        self.frame.stats = stats;
        self
    }

    /// Adds a material with the light on it; returns its number.
    pub fn lighting(&mut self, lighting: Lighting) -> u32 {
        self.frame.is_local |= lighting.is_local();
        self.frame.lightings.push(lighting);
        (self.frame.lightings.len() - 1) as u32
    }

    /// Sets the point in the world that positions count from. See [`Frame::origin`].
    pub fn origin(&mut self, point: [f64; 3]) -> &mut Self {
        self.frame.origin = point;
        self
    }

    /// Adds a vertex; returns its number.
    pub fn vertex(&mut self, vertex: Vertex) -> u32 {
        let Vertex {
            x,
            y,
            depth,
            inv_w,
            normal,
            material,
        } = vertex;
        self.frame
            .vertices
            .push(ScreenVertex { x, y, depth, inv_w });
        let geometry = self.geometry();
        geometry.normals.push(normal);
        geometry.materials.push(material);
        (self.frame.vertices.len() - 1) as u32
    }

    /// Returns the frame's geometry, which is shared with no other yet.
    fn geometry(&mut self) -> &mut Geometry {
        Arc::make_mut(&mut self.frame.geometry)
    }

    /// Sets the position of a vertex, needed if a light or the eye is at a position. See [`Frame::position`].
    ///
    /// # Panics
    /// When there is no such vertex.
    pub fn position(&mut self, vertex: u32, position: [f32; 3]) -> &mut Self {
        let geometry = self.geometry();
        geometry.positions.resize(geometry.normals.len(), [0.0; 3]);
        geometry.positions[vertex as usize] = position;
        self
    }

    /// Sets the colour of a vertex: its attributes are the colour and 1.
    ///
    /// # Panics
    /// When there is no such vertex.
    pub fn colour(&mut self, vertex: u32, [r, g, b]: [f32; 3]) -> &mut Self {
        self.attributes(vertex, [r, g, b, 1.0])
    }

    /// Sets the attributes of a vertex: four numbers for a method of your own. See [`Frame::attributes`].
    ///
    /// # Panics
    /// When there is no such vertex.
    pub fn attributes(&mut self, vertex: u32, attributes: [f32; 4]) -> &mut Self {
        let geometry = self.geometry();
        let count = geometry.normals.len();
        geometry.attributes.resize(count, Geometry::NO_ATTRIBUTES);
        geometry.attributes[vertex as usize] = attributes;
        self
    }

    /// Sets the mean for the next polygon to that of `corners`, at least one: the mean of a clipped piece is that of its whole
    /// polygon.
    ///
    /// # Panics
    /// When there is no such vertex.
    pub fn mean_of(&mut self, corners: &[u32]) -> &mut Self {
        let mean = self.frame.mean_of(corners);
        self.mean(mean)
    }

    /// Sets the mean of the corners of the next polygon.
    pub fn mean(&mut self, mean: Mean) -> &mut Self {
        self.frame
            .means
            .push((self.frame.geometry.corners.len() as u32, mean));
        self
    }

    /// Declares that a vertex lies between two others; vertices must be named in ascending order.
    pub fn clip_corner(&mut self, corner: ClipCorner) -> &mut Self {
        self.frame.clip_corners.push(corner);
        self
    }

    /// Adds a polygon in drawing order: the vertex numbers of its corners in either winding, its unit normal for flat shading,
    /// and any number to tell it by ([`Polygon::source`]). It has the material of its first corner.
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
        geometry.faces.push(normal);
        geometry.corners.extend_from_slice(corners);
        self.frame.polygons.push(Polygon {
            first,
            count,
            material,
            source,
            face,
        });
        self
    }

    /// Checks and returns the frame; under the painter's algorithm its polygons are sorted from back to front.
    ///
    /// # Errors
    /// [`FrameError`] when a size, a number of lights, a coordinate or an index is outside its range.
    pub fn finish(self) -> Result<Frame, FrameError> {
        let mut frame = self.frame;
        frame.check_settings()?;
        let geometry = &frame.geometry;
        if geometry.corners.len() > u32::MAX as usize
            || frame.vertices.len() > u32::MAX as usize
            || frame.polygons.len() > Polygon::FLIPPED as usize
        {
            return Err(FrameError::TooLarge);
        }
        frame.check_lightings()?;
        fn not_finite<const N: usize>(all: &[[f32; N]]) -> Option<usize> {
            all.iter().position(|v| !v.iter().all(|c| c.is_finite()))
        }
        let attributes = || not_finite(&geometry.attributes);
        if let Some(index) = not_finite(&geometry.positions).or_else(attributes) {
            return Err(FrameError::Vertex { index });
        }
        if let Some(index) = (0..frame.vertices.len()).find(|&v| !frame.vertex_is_valid(v)) {
            return Err(FrameError::Vertex { index });
        }
        if let Some(index) = frame
            .polygons
            .iter()
            .position(|p| !frame.polygon_is_valid(p))
        {
            return Err(FrameError::Polygon { index });
        }
        let mut previous = None;
        for (index, corner) in frame.clip_corners.iter().enumerate() {
            let valid = corner.a < corner.vertex
                && corner.b < corner.vertex
                && (corner.vertex as usize) < frame.vertices.len()
                && previous.is_none_or(|p| p < corner.vertex)
                && (0.0..=1.0).contains(&corner.t);
            if !valid {
                return Err(FrameError::Polygon { index });
            }
            previous = Some(corner.vertex);
        }
        let weights = || frame.vertices.iter().map(|v| v.inv_w).filter(|w| *w > 0.0);
        let [least, largest] = [
            weights().fold(f64::INFINITY, f64::min),
            weights().fold(0.0, f64::max),
        ];
        frame.scale_weights(least, largest)?;
        frame.sort();
        Ok(frame)
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

    /// True if size, samples, origin and depth make sense together.
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
        if !self.depth_range.is_valid() || !self.origin.iter().all(|c| c.is_finite()) {
            return Err(FrameError::Camera);
        }
        Ok(())
    }

    /// True if every material has the same number of lights, and all numbers of them make sense.
    pub(crate) fn check_lightings(&self) -> Result<(), FrameError> {
        let lights = self.light_count();
        for lighting in &self.lightings {
            if lighting.lights.len() != lights || lights > Scene::MAX_LIGHTS {
                return Err(FrameError::Lights {
                    found: lighting.lights.len(),
                });
            }
        }
        match self
            .lightings
            .iter()
            .position(|lighting| !is_valid(lighting))
        {
            Some(index) => Err(FrameError::Lighting { index }),
            None => Ok(()),
        }
    }

    /// Sorts the polygons from back to front, under the painter's algorithm.
    pub(crate) fn sort(&mut self) {
        if let HiddenSurfaces::Painter(key) = self.hidden_surfaces {
            let order = back_to_front(self, key);
            self.reorder(&order);
        }
    }

    fn vertex_is_valid(&self, vertex: usize) -> bool {
        let guard = SubPixel::from_num(Frame::GUARD);
        let inside = |c: SubPixel| -guard <= c && c <= guard;
        let v = self.vertex(vertex as u32);
        inside(v.x)
            && inside(v.y)
            && v.depth.is_finite()
            && v.inv_w.is_finite()
            && (v.inv_w > 0.0 || self.clipping == Clipping::NdcCube)
            && v.normal.iter().all(|n| n.is_finite())
            && (v.material as usize) < self.lightings.len()
    }

    fn polygon_is_valid(&self, polygon: &Polygon) -> bool {
        polygon.count >= 3
            && (polygon.material as usize) < self.lightings.len()
            && self.polygon_normal(polygon).iter().all(|n| n.is_finite())
            && self.corners(polygon).iter().all(|&v| {
                (v as usize) < self.vertices.len() && self.material(v) == polygon.material
            })
    }
}

/// True if all numbers of the light on a material are finite, and none negative that must not be.
fn is_valid(lighting: &Lighting) -> bool {
    let finite = |v: [f32; 3]| v.iter().all(|c| c.is_finite());
    let vector = |place: Place<[f32; 3]>| match place {
        Place::Infinite(v) | Place::Local(v) => v,
    };
    let is_light = |light: &LightTerm| {
        let falls =
            !matches!(light.falloff, Falloff::Attenuation(k) if !(k.is_finite() && k >= 0.0));
        finite(vector(light.place)) && finite(light.diffuse) && finite(light.specular) && falls
    };
    finite(lighting.ambient)
        && finite(vector(lighting.view))
        && lighting.shininess.is_finite()
        && lighting.shininess >= 0.0
        && lighting.lights.iter().all(is_light)
}
