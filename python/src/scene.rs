//! A scene that is prepared once and drawn many times.

use crate::errors::{input_error, memory_error, value_error};
use crate::inputs::Input;
use crate::mesh::Mesh;
use crate::pool::{locked, run};
use crate::settings::{look_named, overlay, texts};
use fastphong::drawing::{Drawing, stored_background};
use fastphong::frame::{Frame, PreparedScene};
use fastphong::glam::DVec3;
use fastphong::memory::{bytes, check_frame, check_free, check_stored};
use fastphong::note::{Level, Notes};
use fastphong::notes::{Cost, of_frame, of_meshes};
use fastphong::picture::{Alpha, Encoding};
use fastphong::raster::Renderer;
use fastphong::scene::Camera;
use fastphong::scene::file::{SceneFile, View};
use fastphong::scene::input::{load_by, load_file_by};
use fastphong::scene::open::{Opened, Overlay, open_by};
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock};

/// Bytes of memory per polygon while the scene of a mesh is made: for its edges, its frame, and the
/// order of its vertices. Separate triangles take 370, and a connected mesh 140.
const SCENE_POLYGON: u64 = 400;

/// A scene: meshes, lights and a camera.
#[pyclass(frozen, module = "fastphong._fastphong")]
pub struct Scene {
    shown: Arc<Shown>,
    /// All notes, once somebody has asked for them.
    notes: OnceLock<Notes>,
    /// The memory of pictures that are complete, for the next ones. There is one for each thread
    /// that has drawn at the same time as others.
    idle: Mutex<Vec<Kept>>,
}

/// A scene that was opened. It never changes.
struct Shown {
    opened: Opened,
    /// The positions around which cameras are fitted.
    points: Vec<DVec3>,
    view: View,
}

/// The memory of one picture at a time.
struct Kept {
    prepared: PreparedScene,
    frame: Option<Frame>,
}

impl Kept {
    fn new(scene: &fastphong::scene::Scene) -> PyResult<Kept> {
        check_frame(scene).map_err(memory_error)?;
        Ok(Kept {
            prepared: scene.prepare().map_err(value_error)?,
            frame: None,
        })
    }

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

/// A picture that was drawn.
struct Drawn {
    pixels: Vec<[u8; 4]>,
    size: (usize, usize),
    encoding: Encoding,
    /// The background in stored levels, unless the picture is opaque.
    background: Option<[f64; 3]>,
}

/// Draws `frame`.
fn draw(frame: &mut Frame, drawing: &Drawing, is_opaque: bool) -> PyResult<Drawn> {
    let size = (frame.picture_width(), frame.picture_height());
    // Python gets a copy of the pixels.
    check_stored(frame, drawing, 4).map_err(memory_error)?;
    let mut pixels = vec![[0; 4]; size.0 * size.1];
    frame.set_alpha(if is_opaque {
        Alpha::Flattened
    } else {
        Alpha::Straight
    });
    let drawn = drawing.render_into(frame, Renderer::fastest(), &mut pixels);
    drawn.map_err(value_error)?;
    if is_opaque {
        pixels.iter_mut().for_each(|pixel| pixel[3] = 255);
    }
    Ok(Drawn {
        pixels,
        size,
        encoding: frame.encoding(),
        background: (!is_opaque).then(|| stored_background(frame)),
    })
}

impl Shown {
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
}

impl Scene {
    /// Prepares a scene that was opened.
    fn new(opened: Opened) -> PyResult<Scene> {
        let points = opened.scene.world_points();
        let view = opened.views.view(&Overlay::default(), &points);
        let kept = Kept::new(&opened.scene)?;
        let shown = Shown {
            view: view.map_err(value_error)?,
            points,
            opened,
        };
        Ok(Scene {
            shown: Arc::new(shown),
            notes: OnceLock::new(),
            idle: Mutex::new(vec![kept]),
        })
    }

    /// Runs `work` on the pool with the memory of a picture. If all memory is in use, or the thread
    /// that used it is gone, the scene is prepared once more: nobody waits.
    fn with_kept<R: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Shown, &mut Kept) -> R + Send + 'static,
    ) -> PyResult<R> {
        let (idle, shown) = (locked(&self.idle).pop(), self.shown.clone());
        let (kept, result) = run(py, move || {
            let mut kept = match idle {
                Some(kept) => kept,
                None => Kept::new(&shown.opened.scene)?,
            };
            let result = work(&shown, &mut kept);
            Ok::<_, PyErr>((kept, result))
        })??;
        locked(&self.idle).push(kept);
        Ok(result)
    }

    /// Returns all notes about the scene, its meshes and its own view. The first call computes
    /// them, which takes as long as a picture of the reference.
    fn all_notes(&self, py: Python<'_>) -> PyResult<&Notes> {
        if let Some(notes) = self.notes.get() {
            return Ok(notes);
        }
        let found = self.with_kept(py, |shown, kept| {
            let opened = &shown.opened;
            let mut notes = opened.notes.clone();
            notes.append(of_meshes(&opened.scene));
            // A frame that cannot be made is an error of the picture.
            if let Ok(frame) = kept.frame(&shown.view) {
                let of_frame = of_frame(&opened.scene, frame, Cost::Samples);
                notes.append(of_frame.without_stated(|key| opened.file.states(key)));
            }
            notes
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

/// Pixels, four bytes each, width, height, the name of the encoding, and the background in stored
/// levels, if the picture may be put over one.
pub type Pixels<'py> = (
    Bound<'py, PyByteArray>,
    usize,
    usize,
    Option<&'static str>,
    Option<[f64; 3]>,
);

#[pymethods]
impl Scene {
    /// Makes a scene of one mesh.
    #[staticmethod]
    fn of_mesh(py: Python<'_>, mesh: &Mesh, settings: &str, look: &str) -> PyResult<Scene> {
        let (over, look) = (overlay(settings)?, look_named(look)?);
        let (own, name, notes) = (mesh.mesh.clone(), mesh.name.clone(), mesh.notes.clone());
        run(py, move || {
            let needed = SCENE_POLYGON * own.polygon_count() as u64;
            let needs = format!("{name}: its scene needs about {}", bytes(needed));
            check_free(needed, &needs, "fewer polygons").map_err(memory_error)?;
            let loaded = |_: &str, _: &Path| Ok((own.clone(), notes.clone()));
            let opened = SceneFile::for_mesh(name).open(&over, look, loaded);
            Scene::new(opened.map_err(value_error)?)
        })?
    }

    /// Makes a scene from an input: a scene file, a mesh file, a built-in mesh or a shipped scene.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, settings: &str, look: &str) -> PyResult<Scene> {
        let (over, look) = (overlay(settings)?, look_named(look)?);
        let input = Input::new(path);
        run(py, move || {
            let mut read = |path: &Path| input.read(path);
            let file = if input.path.to_str().is_some() {
                load_by(&input.name, &mut read)
            } else {
                load_file_by(&input.name, &input.path, &mut read)
            };
            let file = file.map_err(|error| input_error(error, &input.path))?;
            let folder = file.path().and_then(Path::parent).unwrap_or(Path::new(""));
            input.check_meshes(file.meshes(), folder)?;
            let opened = open_by(file, &over, look, &mut read);
            Scene::new(opened.map_err(value_error)?)
        })?
    }

    /// Draws the scene.
    fn render<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        settings: &str,
        keeps_scale: bool,
    ) -> PyResult<Pixels<'py>> {
        let drawing: Drawing = method.parse().map_err(value_error)?;
        let over = overlay(settings)?;
        let drawn = self.with_kept(py, move |shown, kept| {
            let view = if over.is_empty() {
                shown.view.clone()
            } else {
                shown.view(&over, keeps_scale)?
            };
            draw(kept.frame(&view)?, &drawing, shown.opened.file.is_opaque())
        })??;
        let pixels = drawn.pixels.as_flattened();
        let copied = PyByteArray::new_with(py, pixels.len(), |copy| {
            copy.copy_from_slice(pixels);
            Ok(())
        })?;
        let encoding = Some(drawn.encoding.name());
        Ok((
            copied,
            drawn.size.0,
            drawn.size.1,
            encoding,
            drawn.background,
        ))
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
        (self.shown.view.width, self.shown.view.height)
    }
}
