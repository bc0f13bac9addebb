//! The view: from a position in the world to clip space, to the planes that it is beyond, to pixel coordinates.

use super::clip::Plane;
use crate::frame::{Frame, FrameError, ScreenVertex, SubPixel, guard};
use crate::scene::{
    Clipping, DepthBuffer, DepthSource, HiddenSurfaces, Interpolation, Projection, Scene,
};
use glam::{DMat4, DVec4};

/// The planes that a position is beyond: one bit per side of the view (left, right, bottom, top, near, far), and from
/// [`BEYOND_PLANES`] on one a plane of [`View::planes`].
pub(super) type Codes = u16;

/// The bits of the planes at which polygons are cut.
pub(super) const BEYOND_PLANES: Codes = 0xFF00;

/// A camera and a picture, and the numbers that follow from them.
pub(super) struct View<'a> {
    /// The settings; objects are ignored.
    pub scene: &'a Scene,
    /// Samples a row, and rows of them: what coordinates count.
    pub width: u32,
    pub height: u32,
    pub clip_matrix: DMat4,
    /// Near and far, then the four sides of the guard band.
    pub planes: [Plane; 6],
    /// True if anything is to be interpolated with 1/w.
    pub needs_inv_w: bool,
}

/// A vertex without a place on the picture stands in its first corner.
const NOWHERE: ScreenVertex = ScreenVertex {
    x: SubPixel::ZERO,
    y: SubPixel::ZERO,
    depth: 0.0,
    inv_w: 1.0,
};

impl<'a> View<'a> {
    pub fn new(scene: &'a Scene) -> Result<Self, FrameError> {
        let sides = 1..=Scene::MAX_SIDE;
        if !sides.contains(&scene.width) || !sides.contains(&scene.height) {
            return Err(FrameError::Size {
                width: scene.width,
                height: scene.height,
            });
        }
        let samples = scene.samples;
        let [width, height] = [scene.width, scene.height].map(|side| side.saturating_mul(samples));
        if ![1, 2, 4, 8].contains(&samples) || !sides.contains(&width) || !sides.contains(&height) {
            return Err(FrameError::Samples { samples });
        }
        guard::camera(&scene.camera)?;
        let clip_matrix = scene
            .camera
            .clip_matrix(f64::from(scene.width) / f64::from(scene.height));
        if !clip_matrix.is_finite() {
            return Err(guard::no_depth(scene.camera.far));
        }
        let (x, y) = (DVec4::X, DVec4::Y);
        let (w_x, w_y) = (DVec4::W * reach(width), DVec4::W * reach(height));
        let band = |normal| Plane {
            normal,
            in_front: true,
        };
        let planes = [
            Plane {
                normal: DVec4::Z,
                in_front: false,
            },
            band(DVec4::W - DVec4::Z),
            band(w_x + x),
            band(w_x - x),
            band(w_y + y),
            band(w_y - y),
        ];
        let per_sample = |buffer: DepthBuffer| buffer.source == DepthSource::PerSample;
        let needs_inv_w = scene.interpolation == Interpolation::Perspective
            || matches!(scene.hidden_surfaces, HiddenSurfaces::ZBuffer(buffer) if per_sample(buffer));
        Ok(View {
            scene,
            width,
            height,
            clip_matrix,
            planes,
            needs_inv_w,
        })
    }

    /// Returns the planes that a position is beyond.
    pub fn codes(&self, clip: DVec4) -> Codes {
        if self.scene.clipping == Clipping::NdcCube {
            return self.codes_unclipped(clip);
        }
        let DVec4 { x, y, z, w } = clip;
        let beyond_planes = self.planes.map(|plane| plane.normal.dot(clip) < 0.0);
        bits(&[x < -w, x > w, y < -w, y > w, z < 0.0, z > w]) | bits(&beyond_planes) << 8
    }

    /// True if clipping can compute with a position: its coordinates are finite, and stay so in distances from planes, up to
    /// 2¹⁵ times as large, and in their squares.
    pub fn is_in_range(clip: DVec4) -> bool {
        const MOST: f64 = 1e140;
        clip.is_finite() && clip.abs().max_element() <= MOST
    }

    /// True if a position has pixel coordinates.
    pub fn is_on_picture(&self, clip: DVec4) -> bool {
        match self.scene.clipping {
            // Cuts are rounded, and may lie beyond the plane that made them.
            Clipping::Planes => {
                let least = -1e-9 * clip.abs().max_element();
                self.planes
                    .iter()
                    .all(|plane| plane.normal.dot(clip) >= least)
                    && clip.w > 0.0
            }
            Clipping::NdcCube => self.codes_unclipped(clip) & BEYOND_PLANES == 0,
        }
    }

    /// Returns the vertex at a position. If it has no pixel coordinates, only its attributes matter.
    pub fn vertex(&self, clip: DVec4) -> ScreenVertex {
        if !self.is_on_picture(clip) {
            return NOWHERE;
        }
        let [x, y] = self.snap(clip);
        let inv_w = if self.needs_inv_w {
            self.weight(clip.w)
        } else {
            1.0
        };
        ScreenVertex {
            x,
            y,
            depth: (clip.z / clip.w) as f32,
            inv_w,
        }
    }

    /// True if all numbers of a vertex are such as a frame may have.
    pub fn is_valid(&self, v: &ScreenVertex) -> bool {
        let guard = SubPixel::from_num(Frame::GUARD);
        let inside = |c: SubPixel| -guard <= c && c <= guard;
        let weighs =
            v.inv_w.is_finite() && (v.inv_w > 0.0 || self.scene.clipping == Clipping::NdcCube);
        inside(v.x) && inside(v.y) && v.depth.is_finite() && weighs
    }

    /// Returns 1/w, scaled to 1 at the near plane.
    fn weight(&self, w: f64) -> f32 {
        match self.scene.camera.projection {
            Projection::Orthographic { .. } => 1.0,
            Projection::Perspective { .. } => (self.scene.camera.near / w) as f32,
        }
    }

    /// Returns column and row, to the nearest 1/256 pixel.
    pub fn snap(&self, clip: DVec4) -> [SubPixel; 2] {
        let column = (clip.x / clip.w * 0.5 + 0.5) * f64::from(self.width);
        let row = (0.5 - clip.y / clip.w * 0.5) * f64::from(self.height);
        // To the nearest, halves to even; positions inside the guard band are far from the ends of the type.
        let nearest = |pixels: f64| SubPixel::from_bits(libm::rint(pixels * 256.0) as i32);
        [nearest(column), nearest(row)]
    }
}

/// Returns the reach of the guard band in x/w or y/w, along a side of the picture of `side` samples: on the picture one
/// longest side beyond its edges.
pub(super) fn reach(side: u32) -> f64 {
    1.0 + 2.0 * f64::from(Scene::MAX_SIDE) / f64::from(side)
}

/// Packs flags into bits, the first the lowest.
pub(super) fn bits(beyond: &[bool]) -> Codes {
    beyond
        .iter()
        .rev()
        .fold(0, |bits, &b| bits << 1 | Codes::from(b))
}
