//! A scene that is prepared once and drawn many times.

use crate::errors::{input_error, value_error};
use crate::mesh::Mesh;
use crate::method::Method;
use crate::pool::install;
use crate::proxy::Proxy;
use crate::settings::Settings;
use fastphong::frame::{Frame, PreparedScene};
use fastphong::picture::encoding::store;
use fastphong::picture::{Alpha, Encoding, PictureMut};
use fastphong::raster::{DrawOptions, Renderer};
use fastphong::reference;
use fastphong::scene::file::Resolved;
use fastphong::scene::file::SceneFile;
use fastphong::scene::{Camera, Light, Object, input};
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// The most samples that the reference draws. It needs 80 bytes for each, 5 GB in all.
const MOST_REFERENCE: usize = 1 << 26;

/// A scene: meshes, lights and a camera.
#[pyclass(frozen, module = "fastphong._fastphong")]
pub struct Scene {
    proxy: Proxy,
    view: View,
    is_opaque: bool,
    warnings: Vec<String>,
    notes: Vec<String>,
    kept: Mutex<Kept>,
}

/// The part of a scene that may change from picture to picture.
#[derive(Clone)]
struct View {
    camera: Camera,
    lights: Vec<Light>,
    width: u32,
    height: u32,
    samples: u32,
}

/// The memory that all pictures of a scene share, so only one picture is drawn at a time.
struct Kept {
    prepared: PreparedScene,
    frame: Option<Frame>,
}

impl View {
    fn of(resolved: Resolved) -> View {
        let scene = resolved.scene;
        View {
            camera: scene.camera,
            lights: scene.lights,
            width: scene.width,
            height: scene.height,
            samples: scene.samples,
        }
    }
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
    method: &Method,
    is_opaque: bool,
    pixels: &mut [[u8; 4]],
) -> PyResult<()> {
    frame.set_alpha(match is_opaque {
        true => Alpha::Flattened,
        false => Alpha::Straight,
    });
    match (method.variant(frame), method) {
        (Some(variant), _) => {
            let (width, height) = (frame.picture_width(), frame.picture_height());
            let picture = PictureMut::rgba8(pixels, width, height);
            let options = DrawOptions::by(Renderer::fastest());
            variant.draw(frame, picture, options).map_err(value_error)?;
        }
        (None, Method::Reference(model)) => {
            let drawn = reference::render(frame, *model);
            let stored = match frame.encoding() {
                Encoding::Linear => drawn.to_picture8(),
                encoding => store(&drawn.to_linear(), encoding),
            };
            pixels.copy_from_slice(stored.pixels());
        }
        (None, _) => {}
    }
    if is_opaque {
        pixels.iter_mut().for_each(|pixel| pixel[3] = 255);
    }
    Ok(())
}

impl Scene {
    /// Makes a scene from a file and the scene that it resolves to.
    fn new(file: SceneFile, resolved: Resolved) -> PyResult<Scene> {
        let Resolved {
            scene,
            warnings,
            notes,
            ..
        } = &resolved;
        let image = file.table().table("image");
        let is_opaque = image.and_then(|image| image.text("alpha")) == Some("opaque");
        let prepared = scene.prepare().map_err(value_error)?;
        Ok(Scene {
            proxy: Proxy::new(file, scene).map_err(value_error)?,
            is_opaque,
            warnings: warnings.clone(),
            notes: notes.clone(),
            kept: Mutex::new(Kept {
                prepared,
                frame: None,
            }),
            view: View::of(resolved),
        })
    }

    /// Returns the view with other settings. With `keeps_scale` the camera turns around the point
    /// that it looked at.
    fn view(&self, settings: Settings, keeps_scale: bool) -> PyResult<View> {
        let mut file = self.proxy.file.clone();
        settings.lay_over(&mut file);
        let mut resolved = self.proxy.resolve(&file).map_err(value_error)?;
        if keeps_scale {
            let scene = &mut resolved.scene;
            scene.camera = turned(&self.view.camera, &scene.camera, &scene.objects);
        }
        Ok(View::of(resolved))
    }
}

/// Returns `own`, turned around its target toward the direction of `other`. Nothing grows or
/// shrinks. The near and the far plane keep the vertices of `clouds` between them.
fn turned(own: &Camera, other: &Camera, clouds: &[Object]) -> Camera {
    let distance = (own.eye - own.target).length();
    let mut camera = *own;
    camera.eye = own.target + distance * other.view();
    camera.up = other.up;
    let vertices = clouds.iter().flat_map(|object| {
        let to_world = object.positions_to_world();
        let vertices = object.mesh.positions().iter();
        vertices.map(move |vertex| to_world.transform_point3(vertex.as_dvec3()))
    });
    if let Some(range) = camera.depth_range(vertices) {
        (camera.near, camera.far) = range;
    }
    camera
}

#[pymethods]
impl Scene {
    /// Makes a scene of one mesh.
    #[staticmethod]
    fn of_mesh(py: Python<'_>, mesh: &Mesh, settings: &str) -> PyResult<Scene> {
        let settings = Settings::parse(settings)?;
        let made = || {
            let mut file = SceneFile::for_mesh(mesh.name.clone());
            settings.lay_over(&mut file);
            let resolved = file.resolve(|_, _| Ok((mesh.mesh.clone(), Vec::new())));
            Scene::new(file, resolved.map_err(value_error)?)
        };
        py.detach(|| install(made))?
    }

    /// Makes a scene from an input: a scene file, a mesh file, a built-in mesh or a shipped scene.
    #[staticmethod]
    fn load(py: Python<'_>, name: &str, settings: &str) -> PyResult<Scene> {
        let settings = Settings::parse(settings)?;
        let made = || {
            let path = Path::new(name);
            let mut file = input::load(name).map_err(|error| input_error(error, path))?;
            settings.lay_over(&mut file);
            let resolved = input::resolve(&file).map_err(value_error)?;
            Scene::new(file, resolved)
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
        let method = Method::parse(method)?;
        let settings = Settings::parse(settings)?;
        let view = match settings.is_empty() {
            true => self.view.clone(),
            false => py.detach(|| install(|| self.view(settings, keeps_scale)))??,
        };
        let (width, height) = (view.width as usize, view.height as usize);
        let samples = width * height * (view.samples * view.samples) as usize;
        if matches!(method, Method::Reference(_)) && samples > MOST_REFERENCE {
            let problem =
                format!("the reference would take 80 bytes for each of {samples} samples");
            let expected = format!("expected at most {MOST_REFERENCE} samples");
            return Err(PyMemoryError::new_err(format!("{problem}: {expected}")));
        }
        let pixels = PyByteArray::new_with(py, 4 * width * height, |bytes| {
            py.detach(|| {
                // Lock here, not on a thread of the pool. A pool thread that waits for others takes
                // up other pictures, and would wait for its own lock.
                let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
                let kept = &mut *kept;
                install(|| {
                    let frame = kept.frame(&view)?;
                    draw(frame, &method, self.is_opaque, bytes.as_chunks_mut().0)
                })?
            })
        })?;
        Ok((pixels, width, height))
    }

    /// Returns the warnings to read before trusting a picture.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// Returns notes on what the scene leaves unused and on what it chose automatically.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    /// Returns the width and the height of the scene's pictures.
    #[getter]
    fn size(&self) -> (u32, u32) {
        (self.view.width, self.view.height)
    }
}
