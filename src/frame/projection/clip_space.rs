//! Vertices that a frame builder received in clip space. They are placed on the picture and clipped
//! as a scene's vertices are.

use super::clip::HomogeneousCorner;
use super::cut::{Cutter, EdgeOf};
use super::view::{BEYOND_PLANES, Codes, View};
use crate::frame::guard::{self, Checked};
use crate::frame::{DepthRange, Frame, FrameError, FrameItem, Polygon};
use crate::scene::ranges::NumberRange;
use crate::scene::{Camera, Clipping, Culling, Projection, Scene};
use alloc::vec::Vec;
use glam::{DVec3, DVec4};

/// The range of coordinates with which clipping can compute: see [`View::is_in_range`].
const CLIP: NumberRange = NumberRange::new(-1e140, 1e140, "a number from -1e140 to 1e140");
/// The range of w in a frame without perspective.
const ONE: NumberRange =
    NumberRange::new(1.0, 1.0, "1, as the frame's depth range is orthographic");

const NAMES: [&str; 4] = [
    "x of its position in clip space",
    "y of its position in clip space",
    "z of its position in clip space",
    "w of its position in clip space",
];

/// Vertices in clip space, and the settings of their frame.
pub(in crate::frame) struct ClipSpace<'a> {
    /// The vertices, in ascending order, and their positions.
    vertices: &'a [(u32, DVec4)],
    /// The frame's settings in the form of a scene. Where its camera stands does not matter.
    settings: Scene,
}

impl<'a> ClipSpace<'a> {
    pub fn new(frame: &Frame, vertices: &'a [(u32, DVec4)]) -> Self {
        let (near, far) = frame.depth_range.ends();
        let projection = match frame.depth_range {
            DepthRange::Orthographic { .. } => Projection::Orthographic { half_height: 1.0 },
            DepthRange::Perspective { .. } => Projection::Perspective { fovy: 90.0 },
        };
        let camera = Camera {
            eye: DVec3::ZERO,
            target: -DVec3::Z,
            up: DVec3::Y,
            projection,
            near,
            far,
        };
        let settings = Scene {
            width: frame.width / frame.samples.max(1),
            height: frame.height / frame.samples.max(1),
            samples: frame.samples,
            interpolation: frame.interpolation,
            hidden_surfaces: frame.hidden_surfaces,
            clipping: frame.clipping,
            culling: Culling::None,
            ..Scene::new(camera)
        };
        ClipSpace { vertices, settings }
    }

    /// Places all vertices on the picture. A vertex beyond a plane gets no place, as in scenes.
    ///
    /// # Errors
    /// [`FrameError::Value`] for the first coordinate outside its range, and [`FrameError::Vertex`]
    /// for a vertex whose place does not fit in a frame.
    pub fn place(&self, frame: &mut Frame) -> Checked {
        if self.vertices.is_empty() {
            return Ok(());
        }
        let view = View::new(&self.settings)?;
        for &(vertex, position) in self.vertices {
            let item = FrameItem::Vertex(vertex as usize);
            guard::check_all(item, NAMES, position.to_array(), &CLIP)?;
            if !view.is_perspective() {
                guard::check(item, NAMES[3], position.w, &ONE)?;
            }
            let position = self.position(position);
            let placed = match view.codes(position) & BEYOND_PLANES {
                0 => view.vertex(position),
                _ => view.nowhere(),
            };
            if !view.is_valid(&placed) {
                let index = vertex as usize;
                return Err(FrameError::Vertex { index });
            }
            frame.vertices[vertex as usize] = placed;
        }
        Ok(())
    }

    /// Returns a position in the form that scenes are clipped in: see
    /// [`Camera::precise_clip_matrix`](crate::scene::Camera).
    fn position(&self, position: DVec4) -> DVec4 {
        let Camera { near, far, .. } = self.settings.camera;
        match self.settings.camera.projection {
            Projection::Orthographic { .. } => position,
            Projection::Perspective { .. } => DVec4 {
                z: (far - position.w) / (far - near),
                ..position
            },
        }
    }

    /// Makes the frame's polygons from `polygons`. Polygons outside the view are left out, and
    /// pieces replace the polygons that are cut.
    ///
    /// # Errors
    /// [`FrameError::Polygon`] for a polygon that must be cut but has vertices that are only on the
    /// screen.
    pub fn clip(&self, frame: &mut Frame, polygons: &[Polygon]) -> Checked {
        if self.vertices.is_empty() {
            return Ok(());
        }
        let view = View::new(&self.settings)?;
        let mut codes = core::mem::take(&mut frame.scratch.codes);
        codes.clear();
        codes.resize(frame.vertices.len(), 0);
        for &(vertex, position) in self.vertices {
            codes[vertex as usize] = view.codes(self.position(position));
        }
        let mut seen = core::mem::take(&mut frame.polygons);
        seen.clear();
        let clipped = polygons
            .iter()
            .enumerate()
            .try_for_each(|(index, polygon)| {
                let corners = frame.corners(polygon).iter().map(|&v| codes[v as usize]);
                let (all, any) = corners.fold((Codes::MAX, 0), |(all, any), c| (all & c, any | c));
                // The planes that all corners are beyond, and the planes that any corner is beyond.
                match any & BEYOND_PLANES {
                    _ if all & !BEYOND_PLANES != 0 => frame.stats.outside += 1,
                    0 => seen.push(*polygon),
                    _ if self.settings.clipping == Clipping::NdcCube => {
                        frame.stats.unprojected += 1
                    }
                    _ => self.cut(&view, frame, index, polygon, &mut seen)?,
                }
                Ok(())
            });
        frame.polygons = seen;
        frame.scratch.codes = codes;
        clipped
    }

    /// Cuts a polygon, and adds to `to` its pieces inside all planes.
    fn cut(
        &self,
        view: &View<'_>,
        frame: &mut Frame,
        index: usize,
        polygon: &Polygon,
        to: &mut Vec<Polygon>,
    ) -> Checked {
        let corners = frame
            .corners(polygon)
            .iter()
            .map(|&v| self.corner(v))
            .collect::<Option<Vec<HomogeneousCorner>>>()
            .ok_or(FrameError::Polygon { index })?;
        let edge = EdgeOf {
            material: polygon.material,
            face: frame.polygon_normal(polygon),
        };
        let mean = frame.mean(polygon);
        let pieces = Cutter { view, frame }.pieces(corners, mean, &edge);
        to.extend(pieces.into_iter().map(|(first, count)| Polygon {
            first,
            count,
            ..*polygon
        }));
        Ok(())
    }

    /// Returns a vertex as clipping reads it; `None` for a vertex that is only on the screen.
    fn corner(&self, vertex: u32) -> Option<HomogeneousCorner> {
        let place = self.vertices.binary_search_by_key(&vertex, |&(v, _)| v);
        let (_, position) = self.vertices[place.ok()?];
        Some(HomogeneousCorner {
            position: self.position(position),
            vertex,
        })
    }
}
