//! A frame: projected polygons and the light on them. The waist of the house.
//!
//! Left of it stand files, matrices and failure; right of it arithmetic that cannot fail and does not know where
//! polygons come from. The shading methods, the barycentric renderer and the `f64` reference all take the same frame,
//! so what differs between their pictures is shading and not geometry.

use crate::lighting::{Lighting, Rgb};
use crate::scene::{Encoding, Interpolation, Scene};
use alloc::vec::Vec;
use core::fmt;

/// A coordinate on the picture in pixels, snapped to 1/256: x to the right, y downward, (0, 0) the outer corner of the
/// first pixel, so that pixel centres lie at ½.
pub type SubPixel = fixed::types::I24F8;

/// A projected vertex: where it stands, and what the shading methods need to know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Column of the picture, at most [`Frame::GUARD`] pixels from 0.
    pub x: SubPixel,
    /// Row of the picture, downward, at most [`Frame::GUARD`] pixels from 0.
    pub y: SubPixel,
    /// z/w: linear on the screen, 0 at the near plane, 1 at the far plane.
    pub depth: f32,
    /// near/w under a perspective camera, 1 under an orthographic one: the weight of perspective interpolation.
    pub inv_w: f32,
    /// Unit vertex normal in world space (L21 3.1); ignored at a [`ClipCorner`].
    pub normal: [f32; 3],
    /// Its entry in [`Frame::lightings`].
    pub material: u32,
}

/// A vertex that clipping made: its attributes lie between those of two others and are never lit again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipCorner {
    /// The vertex that this describes.
    pub vertex: u32,
    /// Where `t` = 0; a smaller number than `vertex`. No polygon need use it, and then its place on the picture means
    /// nothing: it may lie behind the eye.
    pub a: u32,
    /// Where `t` = 1; likewise.
    pub b: u32,
    /// How far from `a` to `b`, 0..=1.
    pub t: f32,
    /// Unit normal of the polygon that was clipped.
    pub face: [f32; 3],
}

/// A projected polygon: three corners or more, of any shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polygon {
    /// Where its corners begin in the list of all corners.
    pub first: u32,
    /// How many corners it has.
    pub count: u32,
    /// Its entry in [`Frame::lightings`]; its vertices have the same.
    pub material: u32,
    /// Its number in the scene, counted over all objects (pieces of one clipped polygon share it).
    pub source: u32,
    /// Unit normal by Newell's formula in world space (L21 1.1).
    pub normal: [f32; 3],
}

/// What became of the scene's polygons on their way into the frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameStats {
    /// Polygons of the scene.
    pub polygons: usize,
    /// Left out because they are seen from the culled side.
    pub culled: usize,
    /// Left out because they have no area, in space or on the picture.
    pub zero_area: usize,
    /// Left out because they lie outside the view.
    pub outside: usize,
    /// Cut by the near plane, the far plane or the guard band.
    pub clipped: usize,
}

/// Projected polygons in drawing order, and the light on them.
#[derive(Clone, Debug)]
pub struct Frame {
    width: u32,
    height: u32,
    background: Rgb,
    interpolation: Interpolation,
    depth_test: bool,
    encoding: Encoding,
    vertices: Vec<Vertex>,
    clip_corners: Vec<ClipCorner>,
    corners: Vec<u32>,
    polygons: Vec<Polygon>,
    lightings: Vec<Lighting>,
    stats: FrameStats,
}

impl Frame {
    /// No coordinate of a vertex is farther than this from 0, in pixels: twice the largest picture, which leaves room
    /// for the exact products of the edge walk in 64 bits (2²⁴ · 2²⁴ · 2).
    pub const GUARD: i32 = 2 * Scene::MAX_SIDE as i32;

    /// Pixels a row.
    pub fn width(&self) -> usize {
        self.width as usize
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height as usize
    }

    /// Colour where nothing is drawn.
    pub fn background(&self) -> Rgb {
        self.background
    }

    /// How attributes vary over the screen.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Whether nearer polygons hide farther ones (strictly less depth wins); without it, later ones hide earlier ones.
    pub fn depth_test(&self) -> bool {
        self.depth_test
    }

    /// How values are stored in eight bits.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// All vertices.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// The vertices that clipping made, in ascending order of their number.
    pub fn clip_corners(&self) -> &[ClipCorner] {
        &self.clip_corners
    }

    /// All polygons, in drawing order.
    pub fn polygons(&self) -> &[Polygon] {
        &self.polygons
    }

    /// The vertex numbers of a polygon's corners, in order.
    pub fn corners(&self, polygon: &Polygon) -> &[u32] {
        &self.corners[polygon.first as usize..][..polygon.count as usize]
    }

    /// The light on each material; all have the same number of lights.
    pub fn lightings(&self) -> &[Lighting] {
        &self.lightings
    }

    /// How many lights there are.
    pub fn light_count(&self) -> usize {
        self.lightings.first().map_or(0, |l| l.lights.len())
    }

    /// What became of the scene's polygons on their way here.
    pub fn stats(&self) -> FrameStats {
        self.stats
    }

    /// The same frame with other polygons over the same vertices: `pieces` gives the corner lists that replace each
    /// polygon.
    pub(crate) fn with_pieces(&self, mut pieces: impl FnMut(&Polygon, &mut dyn FnMut(&[u32]))) -> Frame {
        let mut corners = Vec::new();
        let mut polygons = Vec::new();
        for polygon in &self.polygons {
            pieces(polygon, &mut |piece| {
                polygons.push(Polygon { first: corners.len() as u32, count: piece.len() as u32, ..*polygon });
                corners.extend_from_slice(piece);
            });
        }
        Frame { corners, polygons, ..self.clone() }
    }
}

/// Why a frame could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// A side of the picture is 0 or over [`Scene::MAX_SIDE`].
    Size {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// More lights than [`Scene::MAX_LIGHTS`], or not as many on every material.
    Lights {
        /// How many.
        found: usize,
    },
    /// More corners or vertices than 32-bit numbers can name.
    TooLarge,
    /// A camera that gives no finite picture: eye at the target, up along the view, planes in the wrong order.
    Camera,
    /// A vertex is outside the guard band, or a number of it is not finite, or its weight is not positive.
    Vertex {
        /// Its number.
        index: usize,
    },
    /// A polygon or clip corner names something that does not exist, or a polygon has fewer than three corners.
    Polygon {
        /// Its number.
        index: usize,
    },
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            FrameError::Size { width, height } => {
                write!(f, "the picture size {width}x{height} is outside 1x1 to {0}x{0}", Scene::MAX_SIDE)
            }
            FrameError::Lights { found } => write!(
                f,
                "{found} lights, where at most {} are possible, the same on every material",
                Scene::MAX_LIGHTS
            ),
            FrameError::TooLarge => write!(f, "the scene has more corners than 32-bit numbers can name"),
            FrameError::Camera => write!(
                f,
                "the camera gives no picture: the eye must differ from the target, up must not be along the view, and \
                 near must be less than far (and over 0 under perspective)"
            ),
            FrameError::Vertex { index } => {
                write!(f, "vertex {index} is outside the guard band of {} pixels or not finite", Frame::GUARD)
            }
            FrameError::Polygon { index } => {
                write!(f, "polygon {index} has fewer than three corners or names something that does not exist")
            }
        }
    }
}

impl core::error::Error for FrameError {}

/// Collects vertices and polygons, then checks them once, so that what reads a frame need not.
#[derive(Clone, Debug)]
pub struct FrameBuilder {
    frame: Frame,
}

impl FrameBuilder {
    /// An empty frame of `width` × `height` pixels, black, with depth test, linear on the screen.
    pub fn new(width: u32, height: u32) -> Self {
        FrameBuilder {
            frame: Frame {
                width,
                height,
                background: [0.0; 3],
                interpolation: Interpolation::Screen,
                depth_test: true,
                encoding: Encoding::Linear,
                vertices: Vec::new(),
                clip_corners: Vec::new(),
                corners: Vec::new(),
                polygons: Vec::new(),
                lightings: Vec::new(),
                stats: FrameStats::default(),
            },
        }
    }

    /// Sets the colour where nothing is drawn.
    pub fn background(&mut self, colour: Rgb) -> &mut Self {
        self.frame.background = colour;
        self
    }

    /// Sets how attributes vary over the screen.
    pub fn interpolation(&mut self, interpolation: Interpolation) -> &mut Self {
        self.frame.interpolation = interpolation;
        self
    }

    /// Sets whether nearer polygons hide farther ones.
    pub fn depth_test(&mut self, on: bool) -> &mut Self {
        self.frame.depth_test = on;
        self
    }

    /// Sets how values are stored in eight bits.
    pub fn encoding(&mut self, encoding: Encoding) -> &mut Self {
        self.frame.encoding = encoding;
        self
    }

    /// Sets what became of the scene's polygons.
    pub fn stats(&mut self, stats: FrameStats) -> &mut Self {
        self.frame.stats = stats;
        self
    }

    /// Adds a material with the light on it; returns its number.
    pub fn lighting(&mut self, lighting: Lighting) -> u32 {
        self.frame.lightings.push(lighting);
        (self.frame.lightings.len() - 1) as u32
    }

    /// Adds a vertex; returns its number.
    pub fn vertex(&mut self, vertex: Vertex) -> u32 {
        self.frame.vertices.push(vertex);
        (self.frame.vertices.len() - 1) as u32
    }

    /// The vertex of a number that [`FrameBuilder::vertex`] returned.
    pub fn vertex_at(&self, index: u32) -> &Vertex {
        &self.frame.vertices[index as usize]
    }

    /// Says that a vertex lies between two others; vertices must be named in ascending order.
    pub fn clip_corner(&mut self, corner: ClipCorner) -> &mut Self {
        self.frame.clip_corners.push(corner);
        self
    }

    /// Adds a polygon: vertex numbers of its corners, its unit normal, its number in the scene. It has the material of
    /// its first corner.
    pub fn polygon(&mut self, corners: &[u32], normal: [f32; 3], source: u32) -> &mut Self {
        let frame = &mut self.frame;
        let material = corners.first().and_then(|&v| frame.vertices.get(v as usize)).map_or(u32::MAX, |v| v.material);
        let (first, count) = (frame.corners.len() as u32, corners.len() as u32);
        frame.polygons.push(Polygon { first, count, material, source, normal });
        frame.corners.extend_from_slice(corners);
        self
    }

    /// The frame.
    ///
    /// # Errors
    /// [`FrameError`] when a size, a number of lights, a coordinate or an index is outside its range.
    pub fn finish(self) -> Result<Frame, FrameError> {
        let frame = self.frame;
        let side = 1..=Scene::MAX_SIDE;
        if !side.contains(&frame.width) || !side.contains(&frame.height) {
            return Err(FrameError::Size { width: frame.width, height: frame.height });
        }
        if frame.corners.len() > u32::MAX as usize || frame.vertices.len() > u32::MAX as usize {
            return Err(FrameError::TooLarge);
        }
        let lights = frame.light_count();
        for lighting in &frame.lightings {
            if lighting.lights.len() != lights || lights > Scene::MAX_LIGHTS {
                return Err(FrameError::Lights { found: lighting.lights.len() });
            }
        }
        if let Some(index) = frame.vertices.iter().position(|v| !frame.vertex_is_valid(v)) {
            return Err(FrameError::Vertex { index });
        }
        if let Some(index) = frame.polygons.iter().position(|p| !frame.polygon_is_valid(p)) {
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
        Ok(frame)
    }
}

impl Frame {
    fn vertex_is_valid(&self, v: &Vertex) -> bool {
        let guard = SubPixel::from_num(Frame::GUARD);
        let inside = |c: SubPixel| -guard <= c && c <= guard;
        inside(v.x)
            && inside(v.y)
            && v.depth.is_finite()
            && v.inv_w.is_finite()
            && v.inv_w > 0.0
            && v.normal.iter().all(|n| n.is_finite())
            && (v.material as usize) < self.lightings.len()
    }

    fn polygon_is_valid(&self, polygon: &Polygon) -> bool {
        polygon.count >= 3
            && (polygon.material as usize) < self.lightings.len()
            && polygon.normal.iter().all(|n| n.is_finite())
            && self
                .corners(polygon)
                .iter()
                .all(|&v| self.vertices.get(v as usize).is_some_and(|vertex| vertex.material == polygon.material))
    }
}
