//! A frame: projected polygons and the light on them. The waist of the house.
//!
//! Left of it stand files, matrices and failure; right of it arithmetic that cannot fail and does not know where
//! polygons come from. The shading methods, the barycentric renderer and the `f64` reference all take the same frame,
//! so what differs between their pictures is shading and not geometry.

mod builder;
mod depth_range;
mod error;

pub use builder::FrameBuilder;
pub use depth_range::DepthRange;
pub use error::FrameError;

use crate::lighting::{Lighting, Rgb};
use crate::scene::{Clipping, Encoding, HiddenSurfaces, Interpolation, Scene};
use alloc::vec::Vec;

/// A coordinate on the picture in pixels (of a supersampled frame: in samples), snapped to 1/256: x to the right, y
/// downward, (0, 0) the outer corner of the first pixel, so that pixel centres lie at ½.
pub type SubPixel = fixed::types::I24F8;

/// A projected vertex: where it stands, and what the shading methods need to know of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Column of the picture, at most [`Frame::GUARD`] pixels from 0.
    pub x: SubPixel,
    /// Row of the picture, downward, at most [`Frame::GUARD`] pixels from 0.
    pub y: SubPixel,
    /// z/w: linear on the screen, 0 at the near plane, 1 at the far plane; outside that under [`Clipping::NdcCube`] only.
    pub depth: f32,
    /// near/w under a perspective camera, 1 under an orthographic one: the weight of perspective interpolation, and what
    /// depth is computed from at each sample ([`DepthSource::PerSample`](crate::scene::DepthSource)). Over 0, but under
    /// [`Clipping::NdcCube`], where it is below 0 behind the eye.
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
    /// Left out because a corner has no place on the picture: under [`Clipping::NdcCube`] only.
    pub unprojected: usize,
}

/// The mean of a polygon's corners: where a method that lights a whole polygon at once takes light and viewer from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean of the corners' positions.
    pub position: [f32; 3],
    /// The mean of the corners' normals; not a unit vector.
    pub normal: [f32; 3],
}

/// Projected polygons in drawing order, and the light on them.
#[derive(Clone, Debug)]
pub struct Frame {
    width: u32,
    height: u32,
    samples: u32,
    background: Rgb,
    interpolation: Interpolation,
    hidden_surfaces: HiddenSurfaces,
    clipping: Clipping,
    depth_range: DepthRange,
    encoding: Encoding,
    eye: [f64; 3],
    vertices: Vec<Vertex>,
    /// One a vertex, or none at all; likewise colours.
    positions: Vec<[f32; 3]>,
    colours: Vec<[f32; 3]>,
    /// Of polygons whose corners are not those of the scene's polygon, in ascending order of their number.
    means: Vec<(u32, Mean)>,
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

    /// Samples a row: pixels a row, but where each has several. All coordinates of the frame count samples.
    pub fn width(&self) -> usize {
        self.width as usize
    }

    /// Rows of samples.
    pub fn height(&self) -> usize {
        self.height as usize
    }

    /// Samples a pixel along each side, 1, 2, 4 or 8.
    pub fn samples(&self) -> usize {
        self.samples as usize
    }

    /// Pixels a row of the picture.
    pub fn picture_width(&self) -> usize {
        (self.width / self.samples) as usize
    }

    /// Rows of the picture.
    pub fn picture_height(&self) -> usize {
        (self.height / self.samples) as usize
    }

    /// Colour where nothing is drawn.
    pub fn background(&self) -> Rgb {
        self.background
    }

    /// How attributes vary over the screen.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// How hidden surfaces are found.
    pub fn hidden_surfaces(&self) -> HiddenSurfaces {
        self.hidden_surfaces
    }

    /// What keeps polygons within the view: under [`Clipping::NdcCube`] samples are drawn where their depth is in 0..=1.
    pub fn clipping(&self) -> Clipping {
        self.clipping
    }

    /// Whether nearer polygons hide farther ones (strictly less depth wins); without it, later ones hide earlier ones.
    pub fn depth_test(&self) -> bool {
        matches!(self.hidden_surfaces, HiddenSurfaces::ZBuffer(_))
    }

    /// The distances at which depth is 0 and 1: what depth computed at each sample needs to know.
    pub fn depth_range(&self) -> DepthRange {
        self.depth_range
    }

    /// How values are stored in eight bits.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The position of the eye in the world: where [`Frame::position`] counts from. 0 where the frame was not told.
    pub fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// All vertices.
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// Where a vertex is, in world units along the axes of the world, from the eye: so that what is near the eye, where
    /// precision matters, has small coordinates. 0 where the frame was given no positions. At a clip corner it means
    /// nothing, like the normal.
    #[inline(always)]
    pub fn position(&self, vertex: u32) -> [f32; 3] {
        self.positions.get(vertex as usize).copied().unwrap_or([0.0; 3])
    }

    /// The colour of a vertex, linear; white where the frame was given no colours. At a clip corner it means nothing.
    #[inline(always)]
    pub fn colour(&self, vertex: u32) -> [f32; 3] {
        self.colours.get(vertex as usize).copied().unwrap_or([1.0; 3])
    }

    /// The mean of a polygon's corners, as they were before it was clipped or cut into triangles.
    pub fn mean(&self, polygon: &Polygon) -> Mean {
        // Corner lists follow one another, so the first corner tells polygons apart.
        let place = self.means.binary_search_by_key(&polygon.first, |&(first, _)| first);
        match place {
            Ok(place) => self.means[place].1,
            Err(_) => self.mean_of(self.corners(polygon)),
        }
    }

    fn mean_of(&self, corners: &[u32]) -> Mean {
        let share = 1.0 / corners.len() as f64;
        let mut sum = [[0.0f64; 3]; 2];
        for &corner in corners {
            for (sum, v) in sum.iter_mut().zip([self.position(corner), self.vertices[corner as usize].normal]) {
                for (sum, c) in sum.iter_mut().zip(v) {
                    *sum += share * f64::from(c);
                }
            }
        }
        let [position, normal] = sum.map(|v| v.map(|c| c as f32));
        Mean { position, normal }
    }

    /// Whether the vectors toward a light or toward the eye differ from point to point.
    pub fn is_local(&self) -> bool {
        self.lightings.iter().any(Lighting::is_local)
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

    /// The same frame with its polygons in another order: `order` has the number of each once.
    pub(crate) fn in_order(self, order: &[u32]) -> Frame {
        // The corners move with their polygons, so that polygons take theirs one after the other.
        let mut corners = Vec::with_capacity(self.corners.len());
        let mut means = Vec::with_capacity(self.means.len());
        let polygons = order.iter().map(|&number| {
            let polygon = &self.polygons[number as usize];
            let first = corners.len() as u32;
            if let Ok(place) = self.means.binary_search_by_key(&polygon.first, |&(first, _)| first) {
                means.push((first, self.means[place].1));
            }
            corners.extend_from_slice(self.corners(polygon));
            Polygon { first, ..*polygon }
        });
        let polygons = polygons.collect();
        Frame { corners, polygons, means, ..self }
    }

    /// The same frame with other polygons over the same vertices: `pieces` gives the corner lists that replace each
    /// polygon.
    pub(crate) fn with_pieces(&self, mut pieces: impl FnMut(&Polygon, &mut dyn FnMut(&[u32]))) -> Frame {
        let mut corners = Vec::new();
        let mut polygons = Vec::new();
        let mut means = Vec::new();
        for polygon in &self.polygons {
            let mean = self.mean(polygon);
            let is_whole = self.means.binary_search_by_key(&polygon.first, |&(first, _)| first).is_err();
            pieces(polygon, &mut |piece| {
                if !is_whole || piece.len() != polygon.count as usize {
                    means.push((corners.len() as u32, mean));
                }
                polygons.push(Polygon { first: corners.len() as u32, count: piece.len() as u32, ..*polygon });
                corners.extend_from_slice(piece);
            });
        }
        Frame { corners, polygons, means, ..self.clone() }
    }
}
