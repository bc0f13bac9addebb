//! From a scene to a frame: transforms, projects, culls, clips and snaps polygons.
//!
//! This takes two steps. [`Scene::prepare`] does once what does not depend on the camera: it
//! computes vertex normals, distinct vertices and normals of polygons.
//! [`PreparedScene::frame_into`] does the rest for each picture. It takes all vertices through the
//! camera in blocks, then finds one bit per polygon that is seen, and then writes the polygons of
//! those bits, in the order of the scene. Bits come first, because they say where each polygon of
//! the frame belongs, and so several threads can write parts of the list.
//!
//! `moving.rs` moves an object of a prepared scene. `clip_space.rs` places and clips the vertices
//! that a frame builder received in clip space, by the same planes.

mod clip;
mod clip_space;
mod cut;
mod light;
mod moving;
mod ndc_cube;
mod polygons;
mod prepare;
mod side;
#[cfg(all(test, feature = "io"))]
mod tests;
mod vertices;
mod view;
mod winding;

use super::{DepthRange, Frame, FrameError, FrameStats, Geometry, Polygon, guard};
use crate::mesh::Material;
use crate::scene::{Camera, Light, Lighting, Scene};
use crate::sync::Arc;
use alloc::vec::Vec;
pub(super) use clip_space::ClipSpace;
use cut::Cutting;
use glam::DVec3;
use moving::Moving;
use polygons::{Chunk, Filling, Piece, PolygonTable, Sight, add_up, for_each_cut};
use prepare::Preparation;
use vertices::Placed;
use view::{Codes, View};

impl Scene {
    /// Projects the scene. Returns its polygons as the camera sees them, and the light on them.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    ///
    /// let scene = Scene::of_mesh(builtin("sphere?rings=16&segments=32").unwrap());
    /// let frame = scene.frame().unwrap();
    /// assert!(frame.polygons().len() > 100 && frame.stats().culled > 100);
    /// ```
    ///
    /// # Errors
    /// [`FrameError`] if the picture's size, the count of lights, or a value of the camera, a
    /// light, a material or an object is outside its range, or if a direction has none. It refuses
    /// what scene files and flags refuse.
    pub fn frame(&self) -> Result<Frame, FrameError> {
        self.prepare()?.frame()
    }

    /// Does once what does not depend on the camera. Use it to draw the scene more than once.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    /// use glam::DVec3;
    ///
    /// let mut scene = Scene::of_mesh(builtin("teapot?res=4").unwrap());
    /// let mut prepared = scene.prepare().unwrap();
    /// let mut frame = prepared.frame().unwrap();
    /// for _ in 0..3 {
    ///     scene.camera.eye += DVec3::X;
    ///     prepared.set_camera(scene.camera);
    ///     prepared.frame_into(&mut frame).unwrap();
    /// }
    /// assert_eq!(frame.polygons(), scene.frame().unwrap().polygons());
    /// ```
    ///
    /// # Errors
    /// [`FrameError`] as for [`Scene::frame`], with the scene's own camera.
    pub fn prepare(&self) -> Result<PreparedScene, FrameError> {
        View::new(self)?;
        guard::lights(self)?;
        let mut objects = self.objects.iter().enumerate();
        objects.try_for_each(|(index, object)| guard::object(index, object))?;
        let Preparation {
            geometry,
            table,
            materials,
            coloured,
        } = Preparation::new(self)?;
        guard::materials(&materials)?;
        if self.colours {
            let objects = self.objects.iter().enumerate();

            objects
                .filter(|(_, object)| object.mesh.has_lit_colours())
                .try_for_each(|(index, object)| guard::colours(index, object))?;
        }
        let objects = self.objects.iter().zip(&geometry.models.objects);
        for (index, (object, model)) in objects.enumerate() {
            guard::positions(index, object, model)?;
        }
        guard::lights_off_vertices(self, &self.objects)?;
        // The objects are in the geometry now; only the settings of the scene are kept.
        let settings = Scene {
            objects: Vec::new(),
            lights: self.lights.clone(),
            ..*self
        };
        Ok(PreparedScene {
            settings,
            geometry: Arc::new(geometry),
            table,
            materials,
            coloured,
            moving: Moving::new(self.objects.clone()),
        })
    }
}

/// A scene ready to be drawn by any camera: its objects as distinct vertices and corner lists.
///
/// [`Scene::prepare`] makes it, with the objects of that moment. Camera, size, lights, materials
/// and the objects' transforms may change from frame to frame.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    /// The scene without its objects.
    settings: Scene,
    geometry: Arc<Geometry>,
    table: PolygonTable,
    materials: Vec<Material>,
    /// True for the materials of meshes with vertex colours.
    coloured: Vec<bool>,
    moving: Moving,
}

/// Memory that one frame needs and the next one reuses.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    codes: Vec<Codes>,
    chunks: Vec<Chunk>,
    pieces: Vec<Piece>,
}

impl Clone for Scratch {
    /// Returns empty memory, as no content is ever reused.
    fn clone(&self) -> Self {
        Scratch::default()
    }
}

impl PreparedScene {
    /// Returns the camera of the next frame.
    pub fn camera(&self) -> &Camera {
        &self.settings.camera
    }

    /// Sets the camera of the next frame.
    pub fn set_camera(&mut self, camera: Camera) {
        self.settings.camera = camera;
    }

    /// Sets the size of the picture in pixels.
    pub fn set_size(&mut self, width: u32, height: u32) {
        (self.settings.width, self.settings.height) = (width, height);
    }

    /// Sets how many samples a pixel has along each side, as [`Scene::samples`] does.
    pub fn set_samples(&mut self, samples: u32) {
        self.settings.samples = samples;
    }

    /// Sets the lights. It is not checked again that none of them stands at a vertex, where the
    /// direction toward it is undefined.
    pub fn set_lights(&mut self, lights: Vec<Light>) {
        self.settings.lights = lights;
    }

    /// True if vertex colours multiply a material.
    pub fn is_coloured(&self, material: u32) -> bool {
        self.settings.colours && self.coloured[material as usize]
    }

    /// Returns the materials of all objects, so that you can change them.
    pub fn materials_mut(&mut self) -> &mut [Material] {
        &mut self.materials
    }

    /// Returns a new frame: the scene as its camera sees it.
    ///
    /// # Errors
    /// [`FrameError`] as for [`Scene::frame`].
    pub fn frame(&self) -> Result<Frame, FrameError> {
        let mut frame = Frame::empty(1, 1);
        self.frame_into(&mut frame)?;
        Ok(frame)
    }

    /// Replaces `frame` by the scene as its camera sees it, in the memory that `frame` has. From
    /// the second frame on, nothing is allocated that grows with the scene, except for clipping and
    /// sorting.
    ///
    /// # Errors
    /// [`FrameError`] as for [`Scene::frame`]; `frame` is then empty.
    pub fn frame_into(&self, frame: &mut Frame) -> Result<(), FrameError> {
        let mut scratch = core::mem::take(&mut frame.scratch);
        let done = self.fill(frame, &mut scratch);
        frame.scratch = scratch;
        if done.is_err() {
            *frame = Frame::empty(1, 1);
        }
        done
    }

    fn fill(&self, frame: &mut Frame, scratch: &mut Scratch) -> Result<(), FrameError> {
        let view = View::new(&self.settings)?;
        self.settings(frame, &view);
        let origin = DVec3::from_array(frame.origin);
        guard::lights(&self.settings)?;
        guard::materials(&self.materials)?;
        self.settings
            .light(&self.materials, origin, &mut frame.lightings);
        for (material, lighting) in (0..).zip(&mut frame.lightings) {
            lighting.vertex_colours = self.is_coloured(material);
        }
        frame.is_local = frame.lightings.iter().any(Lighting::is_local);
        frame.check_settings()?;
        frame.check_lightings()?;
        let Placed {
            is_any_beyond,
            weights: [mut least, mut largest],
        } = self.vertices(frame, &view, &mut scratch.codes)?;
        let Scratch {
            codes,
            chunks,
            pieces,
        } = scratch;
        let half = self.geometry.corners.len() / if self.settings.two_sided { 2 } else { 1 };
        let sight = Sight {
            scene: &self.settings,
            table: &self.table,
            corners: &self.geometry.corners[..half],
            vertices: &frame.vertices,
            codes: is_any_beyond.then_some(&codes[..]),
        };
        sight.find(chunks);
        frame.stats = FrameStats::default();
        pieces.clear();
        if is_any_beyond {
            let mut cutting = Cutting {
                view: &view,
                table: &self.table,
                frame,
                pieces,
            };
            for_each_cut(chunks, |polygon| cutting.polygon(polygon));
            let cuts = frame.vertices[self.geometry.vertex_count()..].iter();
            // A vertex without a place on the picture has the least positive weight, which must not
            // count.
            for weight in cuts.map(|v| v.inv_w).filter(|w| *w > f64::MIN_POSITIVE) {
                (least, largest) = (least.min(weight), largest.max(weight));
            }
        }
        frame.scale_weights(least, largest)?;
        let count = add_up(chunks, pieces, &mut frame.stats);
        frame.polygons.resize(count, Polygon::default());
        let filling = Filling {
            table: &self.table,
            corner_count: half as u32,
            pieces,
        };
        filling.fill(0, chunks, &mut frame.polygons);
        frame.sort();
        Ok(())
    }

    /// Copies all settings into the frame, and empties the lists that are filled polygon by
    /// polygon.
    fn settings(&self, frame: &mut Frame, view: &View<'_>) {
        let scene = &self.settings;
        (frame.width, frame.height, frame.samples) = (view.width, view.height, scene.samples);
        frame.background = scene.background;
        frame.interpolation = scene.interpolation;
        frame.hidden_surfaces = scene.hidden_surfaces;
        frame.clipping = scene.clipping;
        frame.depth_range = DepthRange::from(&scene.camera);
        frame.encoding = scene.encoding;
        frame.origin = self.origin().to_array();
        frame.geometry = self.geometry.clone();
        frame.cut_materials.clear();
        frame.means.clear();
        frame.clip_corners.clear();
        frame.cut_corners.clear();
    }

    /// Projects all vertices.
    fn vertices(
        &self,
        frame: &mut Frame,
        view: &View<'_>,
        codes: &mut Vec<Codes>,
    ) -> Result<Placed, FrameError> {
        let count = self.geometry.models.count();
        frame
            .vertices
            .resize(self.geometry.vertex_count(), Default::default());
        codes.resize(count, 0);
        let (front, back) = frame.vertices.split_at_mut(count);
        let placed = vertices::place(view, &self.geometry.models, front, codes)?;
        if self.settings.two_sided {
            back.copy_from_slice(front);
        }
        Ok(placed)
    }

    /// Returns the point from which positions are measured. With a local light or viewer, `f32`
    /// must be precise where it matters. So it is the eye, if the eye is among the objects or not
    /// far from them, else the middle of the objects.
    fn origin(&self) -> DVec3 {
        // How far a mesh may be from 0, in sizes of the scene, until it gets its own origin.
        const FAR: f64 = 16.0;
        let eye = self.settings.camera.eye;
        let boxes = self.geometry.models.objects.iter().map(|object| {
            let (middle, reach) = (object.transform.translation, object.reach());
            (middle - reach, middle + reach)
        });
        let all = boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let Some((low, high)) = all else {
            return eye;
        };
        let middle = 0.5 * low + 0.5 * high;
        let is_far = (eye - middle).abs().max_element() > FAR * (high - low).max_element();
        if is_far { middle } else { eye }
    }
}

/// Access for `diagnose`, which looks at more than frames.
impl PreparedScene {
    /// Returns the settings of the next frame, so that they can be changed, except
    /// [`Scene::two_sided`]. Objects are not among them.
    #[doc(hidden)]
    pub fn settings_mut(&mut self) -> &mut Scene {
        &mut self.settings
    }

    /// Returns the vertices, corner lists and normals of the whole scene, independent of the
    /// camera.
    #[doc(hidden)]
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Returns the materials, indexed by [`Polygon::material`].
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Returns how many polygons the scene has.
    pub fn polygon_count(&self) -> usize {
        self.table.count
    }

    /// Returns the vertices at the corners of a polygon of the scene, independent of the camera.
    pub fn corners(&self, polygon: usize) -> &[u32] {
        let (first, count) = self.table.corners(polygon);
        &self.geometry.corners[first as usize..][..count as usize]
    }
}
