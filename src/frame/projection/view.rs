//! The view: from a position in the world to clip space, to the planes that it is beyond, and to
//! pixel coordinates.

use super::clip::Plane;
use crate::frame::{DepthRange, Frame, FrameError, ScreenVertex, SubPixel, guard, sub_pixel};
use crate::scene::{
    Clipping, DepthBuffer, DepthSource, HiddenSurfaces, Interpolation, Projection, Scene,
};
use glam::{DMat4, DVec4};

/// The planes that a position is beyond. There is one bit per side of the view (left, right,
/// bottom, top, near, far), and from [`BEYOND_PLANES`] on, one per plane of [`View::planes`].
pub(super) type Codes = u16;

/// The bits of the planes at which polygons are cut.
pub(super) const BEYOND_PLANES: Codes = 0xFF00;

/// A camera and a picture, and what is computed from them once.
pub(super) struct View<'a> {
    /// The settings; objects are ignored.
    pub scene: &'a Scene,
    /// How many samples a row has, and how many rows there are: the unit of coordinates.
    pub width: u32,
    pub height: u32,
    /// The matrix to clip space: see [`Camera::precise_clip_matrix`](crate::scene::Camera).
    pub clip_matrix: DMat4,
    /// The factor of z in the condition z · `z_scale` ≤ w. Under perspective this is the near
    /// plane, and the factor is the near distance; else it is the far plane, and the factor is 1.
    pub z_scale: f64,
    /// The near and the far plane, then the four sides of the guard band.
    pub planes: [Plane; 6],
    /// True if anything is interpolated with 1/w.
    pub needs_inv_w: bool,
}

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
            .precise_clip_matrix(f64::from(scene.width) / f64::from(scene.height));
        if !clip_matrix.is_finite() {
            return Err(guard::no_depth(scene.camera.far));
        }
        let (x, y) = (DVec4::X, DVec4::Y);
        let (w_x, w_y) = (DVec4::W * reach(width), DVec4::W * reach(height));
        let band = |normal| Plane {
            normal,
            in_front: true,
            w: None,
        };
        let [near, far] = scene.camera.planes();
        let (z_scale, [near, far]) = match scene.camera.projection {
            Projection::Orthographic { .. } => {
                let plane = |normal| Plane {
                    normal,
                    in_front: false,
                    w: None,
                };
                (1.0, [plane(DVec4::Z), band(DVec4::W - DVec4::Z)])
            }
            // z goes from 1 down to 0, so (f − w)/(f − n) n ≤ w is n ≤ w.
            Projection::Perspective { .. } => {
                let plane = |normal, in_front, w| Plane {
                    normal,
                    in_front,
                    w: Some(w),
                };
                let nearest = plane(DVec4::W - DVec4::Z * near, false, near);
                (near, [nearest, plane(DVec4::Z, true, far)])
            }
        };
        let planes = [
            near,
            far,
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
            z_scale,
            planes,
            needs_inv_w,
        })
    }

    /// Returns the planes that a position is beyond.
    pub fn codes(&self, clip: DVec4) -> Codes {
        if self.scene.clipping == Clipping::NdcCube {
            return self.codes_unclipped(clip);
        }
        let DVec4 { x, y, w, .. } = clip;
        let beyond_planes = self.planes.map(|plane| plane.normal.dot(clip) < 0.0);
        let [near, far, ..] = beyond_planes;
        bits(&[x < -w, x > w, y < -w, y > w, near, far]) | bits(&beyond_planes) << 8
    }

    /// True if clipping can compute with a position. Its coordinates must be finite, and so must
    /// distances from planes, which are up to 2¹⁵ times as large, and their squares.
    pub fn is_in_range(clip: DVec4) -> bool {
        const MOST: f64 = 1e140;
        clip.is_finite() && clip.abs().max_element() <= MOST
    }

    /// True if a position has pixel coordinates.
    pub fn is_on_picture(&self, clip: DVec4) -> bool {
        match self.scene.clipping {
            // Cuts are rounded, and may lie a little beyond the plane that made them.
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

    /// Returns a vertex without pixel coordinates: at the first corner of the picture, as far away
    /// as possible, and with the least positive weight.
    pub fn nowhere(&self) -> ScreenVertex {
        ScreenVertex {
            x: SubPixel::ZERO,
            y: SubPixel::ZERO,
            depth: DepthRange::from(&self.scene.camera).depths()[1],
            inv_w: f64::MIN_POSITIVE,
        }
    }

    /// Returns the vertex at a position. If the position has no pixel coordinates, only the
    /// vertex's attributes matter.
    pub fn vertex(&self, clip: DVec4) -> ScreenVertex {
        if !self.is_on_picture(clip) {
            return self.nowhere();
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
            depth: self.depth(clip),
            inv_w,
        }
    }

    /// True if a frame may hold all values of a vertex.
    pub fn is_valid(&self, v: &ScreenVertex) -> bool {
        let guard = SubPixel::from_num(Frame::GUARD);
        let inside = |c: SubPixel| -guard <= c && c <= guard;
        let weighs =
            v.inv_w.is_finite() && (v.inv_w > 0.0 || self.scene.clipping == Clipping::NdcCube);
        // Engines compare depth in `f32`. There 1/w must not vanish, however far away the vertex
        // is.
        let depth = v.depth as f32;
        let is_far = self.is_perspective() && !depth.is_normal();
        inside(v.x) && inside(v.y) && depth.is_finite() && !is_far && weighs
    }

    pub fn is_perspective(&self) -> bool {
        matches!(self.scene.camera.projection, Projection::Perspective { .. })
    }

    /// Returns the value that the depth test compares: see [`Vertex::depth`](crate::frame::Vertex).
    pub fn depth(&self, clip: DVec4) -> f64 {
        if self.is_perspective() {
            -1.0 / clip.w
        } else {
            clip.z / clip.w
        }
    }

    /// Returns 1/w, scaled to 1 at the near plane.
    fn weight(&self, w: f64) -> f64 {
        if self.is_perspective() {
            self.scene.camera.near / w
        } else {
            1.0
        }
    }

    /// Returns column and row, to the nearest 1/256 pixel.
    pub fn snap(&self, clip: DVec4) -> [SubPixel; 2] {
        let column = (clip.x / clip.w * 0.5 + 0.5) * f64::from(self.width);
        let row = (0.5 - clip.y / clip.w * 0.5) * f64::from(self.height);
        [sub_pixel(column), sub_pixel(row)]
    }
}

/// Returns how far the guard band reaches in x/w or y/w, along a side of the picture with `side`
/// samples. On the picture it reaches one longest possible side beyond the edges.
pub(super) fn reach(side: u32) -> f64 {
    1.0 + 2.0 * f64::from(Scene::MAX_SIDE) / f64::from(side)
}

/// Packs flags into bits, the first one lowest.
pub(super) fn bits(beyond: &[bool]) -> Codes {
    beyond
        .iter()
        .rev()
        .fold(0, |bits, &b| bits << 1 | Codes::from(b))
}
