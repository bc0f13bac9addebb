//! A scene that is prepared once and drawn many times.

use crate::errors::{input_error, value_error};
use crate::mesh::Mesh;
use crate::pool::install;
use crate::settings::{look_named, overlay, texts};
use fastphong::drawing::Drawing;
use fastphong::frame::{Frame, PreparedScene};
use fastphong::glam::DVec3;
use fastphong::note::{Level, Notes};
use fastphong::notes::{Cost, of_frame, of_meshes};
use fastphong::picture::Alpha;
use fastphong::raster::Renderer;
use fastphong::scene::file::{SceneFile, View};
use fastphong::scene::open::{Opened, Overlay, open_by};
use fastphong::scene::{Camera, input};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use std::path::Path;
use std::sync::{Mutex, OnceLock, PoisonError};

/// The most samples that the reference draws. It needs 80 bytes for each, 5 GB in all.
const MOST_REFERENCE: usize = 1 << 26;

/// A scene: meshes, lights and a camera.
#[pyclass(frozen, module = "fastphong._fastphong")]
pub struct Scene {
    opened: Opened,
    /// The positions around which cameras are fitted.
    points: Vec<DVec3>,
    view: View,
    /// All notes, once somebody has asked for them.
    notes: OnceLock<Notes>,
    kept: Mutex<Kept>,
}

/// The memory that all pictures of a scene share, so only one picture is drawn at a time.
struct Kept {
    prepared: PreparedScene,
    frame: Option<Frame>,
}

impl Kept {
    /// Returns the frame of `view`.
    fn frame(&mut self, view: &View) -> PyResult<&mut Frame> {
        self.prepared.set_camera(view.camera);
        self.prepared.set_lights(view.lights.clone());
        self.prepared.set_size(view.width, view.height);
        self.prepared.set_samples(view.samples);
        match &mut self.frame {
            Some(frame) => self.prepared.frame_into(frame).map_err(value_error)?,
            none => *none = Some(self.prepared.frame().map_err(value_error)?),
        }
        // The match has just made a frame, so this error never occurs.
        self.frame.as_mut().ok_or_else(|| value_error("no frame"))
    }
}

/// Draws `frame` into `pixels`.
fn draw(
    frame: &mut Frame,
    drawing: &Drawing,
    is_opaque: bool,
    pixels: &mut [[u8; 4]],
) -> PyResult<()> {
    frame.set_alpha(if is_opaque {
        Alpha::Flattened
    } else {
        Alpha::Straight
    });
    let drawn = drawing.render_into(frame, Renderer::fastest(), pixels);
    drawn.map_err(value_error)?;
    if is_opaque {
        pixels.iter_mut().for_each(|pixel| pixel[3] = 255);
    }
    Ok(())
}

impl Scene {
    /// Prepares a scene that was opened.
    fn new(opened: Opened) -> PyResult<Scene> {
        let points = opened.scene.world_points();
        let view = opened.views.view(&Overlay::default(), &points);
        let prepared = opened.scene.prepare().map_err(value_error)?;
        Ok(Scene {
            view: view.map_err(value_error)?,
            points,
            notes: OnceLock::new(),
            kept: Mutex::new(Kept {
                prepared,
                frame: None,
            }),
            opened,
        })
    }

    /// Returns the view with other settings. With `keeps_scale` the camera turns around the point
    /// that it looked at.
    fn view(&self, over: &Overlay, keeps_scale: bool) -> PyResult<View> {
        let view = self.opened.views.view(over, &self.points);
        let mut view = view.map_err(value_error)?;
        if keeps_scale {
            view.camera = turned(&self.view.camera, &view.camera, &self.points);
        }
        Ok(view)
    }

    /// Runs `work` on the pool, with the memory that pictures share.
    fn with_kept<R: Send>(&self, work: impl FnOnce(&mut Kept) -> R + Send) -> PyResult<R> {
        // Lock here, not on a thread of the pool. A pool thread that waits for others takes up
        // other pictures, and would wait for its own lock.
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = &mut *kept;
        install(|| work(kept))
    }

    /// Returns all notes about the scene, its meshes and its own view. The first call computes
    /// them, which takes as long as a picture of the reference.
    fn all_notes(&self, py: Python<'_>) -> PyResult<&Notes> {
        if let Some(notes) = self.notes.get() {
            return Ok(notes);
        }
        let scene = &self.opened.scene;
        let found = py.detach(|| {
            self.with_kept(|kept| {
                let mut notes = self.opened.notes.clone();
                notes.append(of_meshes(scene));
                // A frame that cannot be made is an error of the picture.
                if let Ok(frame) = kept.frame(&self.view) {
                    let of_frame = of_frame(scene, frame, Cost::Samples);
                    notes.append(of_frame.without_stated(|key| self.opened.file.states(key)));
                }
                notes
            })
        })?;
        Ok(self.notes.get_or_init(|| found))
    }
}

/// Returns `own`, turned around its target toward the direction of `other`. Nothing grows or
/// shrinks. The near and the far plane keep `points` between them.
fn turned(own: &Camera, other: &Camera, points: &[DVec3]) -> Camera {
    let distance = (own.eye - own.target).length();
    let mut camera = *own;
    camera.eye = own.target + distance * other.view();
    camera.up = other.up;
    if let Some(range) = camera.depth_range(points.iter().copied()) {
        (camera.near, camera.far) = range;
    }
    camera
}

#[pymethods]
impl Scene {
    /// Makes a scene of one mesh.
    #[staticmethod]
    fn of_mesh(py: Python<'_>, mesh: &Mesh, settings: &str, look: &str) -> PyResult<Scene> {
        let (over, look) = (overlay(settings)?, look_named(look)?);
        let made = || {
            let file = SceneFile::for_mesh(mesh.name.clone());
            let loaded = |_: &str, _: &Path| Ok((mesh.mesh.clone(), mesh.notes.clone()));
            Scene::new(file.open(&over, look, loaded).map_err(value_error)?)
        };
        py.detach(|| install(made))?
    }

    /// Makes a scene from an input: a scene file, a mesh file, a built-in mesh or a shipped scene.
    #[staticmethod]
    fn load(py: Python<'_>, name: &str, settings: &str, look: &str) -> PyResult<Scene> {
        let (over, look) = (overlay(settings)?, look_named(look)?);
        let made = || {
            let path = Path::new(name);
            let file = input::load(name).map_err(|error| input_error(error, path))?;
            let opened = open_by(file, &over, look, &mut input::read_input);
            Scene::new(opened.map_err(value_error)?)
        };
        py.detach(|| install(made))?
    }

    /// Draws the scene. Returns the pixels, four bytes each, and width and height.
    fn render<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        settings: &str,
        keeps_scale: bool,
    ) -> PyResult<(Bound<'py, PyByteArray>, usize, usize)> {
        let drawing: Drawing = method.parse().map_err(value_error)?;
        let over = overlay(settings)?;
        let view = if over.is_empty() {
            self.view.clone()
        } else {
            py.detach(|| install(|| self.view(&over, keeps_scale)))??
        };
        let (width, height) = (view.width as usize, view.height as usize);
        let samples = width * height * (view.samples * view.samples) as usize;
        if matches!(drawing, Drawing::Reference(_)) && samples > MOST_REFERENCE {
            let problem =
                format!("the reference would take 80 bytes for each of {samples} samples");
            let expected = format!("expected at most {MOST_REFERENCE} samples");
            return Err(PyMemoryError::new_err(format!("{problem}: {expected}")));
        }
        let is_opaque = self.opened.file.is_opaque();
        let pixels = PyByteArray::new_with(py, 4 * width * height, |bytes| {
            py.detach(|| {
                self.with_kept(|kept| {
                    let frame = kept.frame(&view)?;
                    draw(frame, &drawing, is_opaque, bytes.as_chunks_mut().0)
                })?
            })
        })?;
        Ok((pixels, width, height))
    }

    /// Returns the warnings to read before trusting a picture.
    #[getter]
    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(texts(self.all_notes(py)?, Level::Warning))
    }

    /// Returns notes on what the scene leaves unused and on what it chose automatically.
    #[getter]
    fn notes(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(texts(self.all_notes(py)?, Level::Remark))
    }

    /// Returns the width and the height of the scene's pictures.
    #[getter]
    fn size(&self) -> (u32, u32) {
        (self.view.width, self.view.height)
    }
}
