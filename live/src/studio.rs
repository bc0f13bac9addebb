//! A scene, a frame of it, and two pictures of the frame: one by a method, and the exact one.

use fastphong::drawing::Drawing;
use fastphong::frame::{Frame, PreparedScene};
use fastphong::note::Notes;
use fastphong::notes::of_meshes;
use fastphong::picture::encoding::store;
use fastphong::picture::{Alpha, LinearPicture, Picture, Picture8};
use fastphong::raster::{DrawError, Renderer, polygon_indices};
use fastphong::reference;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::file::{SceneError, SceneFile};
use fastphong::scene::open::{Look, Opened, Overlay, open_by};
use fastphong::scene::orbit::{Orbit, Start};
use fastphong::scene::{Camera, Light, Scene};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A view that the page asks for. See [`crate::frame`] for its fields.
pub struct View {
    pub size: [u32; 2],
    pub azimuth: f64,
    pub elevation: f64,
    pub zoom: f64,
    pub light: [f64; 3],
    pub shininess: f32,
    pub samples: u32,
}

/// A scene that can be seen from any direction.
pub struct Loaded {
    pub file: SceneFile,
    /// The scene in its own view.
    scene: Scene,
    /// What to know about the scene and its meshes.
    pub notes: Notes,
    prepared: PreparedScene,
    start: Start,
    /// The lights of the current frame, turned as its view asks.
    pub shown_lights: Vec<Light>,
    exponents: Vec<f32>,
    /// The size and the exponent of the last view. An exponent of 0 keeps the materials' own.
    pub size: [u32; 2],
    pub exponent: f32,
}

/// The state of one instance of the module.
pub struct Studio {
    /// The text that the page wrote, or that a function left for the page.
    pub text: Vec<u8>,
    files: BTreeMap<PathBuf, Vec<u8>>,
    pub loaded: Option<Loaded>,
    pub frame: Option<Frame>,
    picture: LinearPicture,
    exact: LinearPicture,
    bytes: Picture8,
    /// True at pixels where the reference shows a different polygon than the engine. Such pixels
    /// differ in depth, not in shading.
    others: Vec<bool>,
    /// The error of each pixel in grey levels, 0 where pixels are not compared.
    pub errors: Vec<f32>,
    pub turned: [f64; 2],
    values: Vec<f64>,
    /// The pictures of the figure, and width, height and address of the one that the page asked for
    /// last.
    pub panels: Vec<Picture8>,
    pub panel: [u32; 3],
}

impl Default for Studio {
    fn default() -> Self {
        Studio {
            text: Vec::new(),
            files: BTreeMap::new(),
            loaded: None,
            frame: None,
            picture: LinearPicture::new(0, 0, [0.0; 4]),
            exact: LinearPicture::new(0, 0, [0.0; 4]),
            bytes: Picture8::new(0, 0, [0; 4]),
            others: Vec::new(),
            errors: Vec::new(),
            turned: [0.0; 2],
            values: Vec::new(),
            panels: Vec::new(),
            panel: [0; 3],
        }
    }
}

impl Studio {
    /// Writes `message` into the text, and returns its length.
    pub fn say(&mut self, message: String) -> usize {
        self.text = message.into_bytes();
        self.text.len()
    }

    /// Returns the text and clears it.
    pub fn told(&mut self) -> String {
        String::from_utf8_lossy(&std::mem::take(&mut self.text)).into_owned()
    }

    /// Returns the value that `ask` returns, or minus the length of its error message, which it
    /// leaves in the text.
    pub fn answer(&mut self, ask: impl FnOnce(&mut Studio) -> Result<usize, String>) -> isize {
        match ask(self) {
            Ok(value) => value as isize,
            Err(message) => -(self.say(message) as isize),
        }
    }

    pub fn file(&mut self) {
        let text = std::mem::take(&mut self.text);
        let end = text
            .iter()
            .position(|byte| *byte == b'\n')
            .unwrap_or(text.len());
        let name = PathBuf::from(&*String::from_utf8_lossy(&text[..end]));
        self.files
            .insert(name, text.get(end + 1..).unwrap_or_default().to_vec());
    }

    /// Opens the scene that the text states, or the mesh file that it names, for pictures of
    /// `size`, as the program does with `--size`. A width or a height of 0 keeps the scene's size.
    pub fn load(&mut self, size: [u32; 2]) -> Result<usize, String> {
        let said = |error: SceneError| error.to_string();
        let text = self.told();
        let file = if text.contains('\n') {
            SceneFile::parse(&text, "scene.toml").map_err(said)?
        } else {
            SceneFile::for_mesh(text)
        };
        let files = &self.files;
        let mut read = |path: &Path| {
            // A scene asks for material libraries in the folder of their mesh. The page has no
            // folders, so the name decides.
            let known = files
                .get(path)
                .or_else(|| files.get(Path::new(path.file_name()?)));
            known.cloned().ok_or_else(|| ErrorKind::NotFound.into())
        };
        let opened = open_by(file, &of_size(size), Look::Shown, &mut read).map_err(said)?;
        let objects = opened.scene.objects.iter();
        let polygons = objects.map(|object| object.mesh.polygon_count()).sum();
        self.loaded = Some(Loaded::new(opened)?);
        self.frame = None;
        Ok(polygons)
    }

    pub fn light(&mut self) -> *const f64 {
        let toward = self
            .loaded
            .as_ref()
            .and_then(|loaded| loaded.start.toward_light(&loaded.scene.lights));
        self.values = toward.unwrap_or_default().to_vec();
        self.values.as_ptr()
    }

    pub fn look(&mut self, view: &View) -> Result<usize, String> {
        let Some(loaded) = &mut self.loaded else {
            return Err("no scene".into());
        };
        let [width, height] = view.size;
        if !(1..=Scene::MAX_SIDE).contains(&width) || !(1..=Scene::MAX_SIDE).contains(&height) {
            return Err(format!("no picture has {width} x {height} pixels"));
        }
        let mut orbit = Orbit::default();
        orbit.turn(&loaded.start, view.azimuth, view.elevation);
        orbit.zoom(view.zoom);
        self.turned = orbit.angles();
        let scene = &mut loaded.prepared;
        scene.set_size(width, height);
        scene.set_samples(if view.samples > 0 {
            view.samples
        } else {
            loaded.scene.samples
        });
        scene.set_camera(orbit.camera(&loaded.start, f64::from(width) / f64::from(height)));
        let is_lit_anew = view.light != [0.0; 3];
        loaded.shown_lights = match (is_lit_anew, orbit == Orbit::default()) {
            // Turning by 0 would round: an unturned view keeps the scene's lights to the bit.
            (false, true) => loaded.scene.lights.clone(),
            (false, false) => orbit.carry(&loaded.start, &loaded.scene.lights),
            (true, _) => orbit.carry_toward(&loaded.start, &loaded.scene.lights, view.light),
        };
        scene.set_lights(loaded.shown_lights.clone());
        loaded.size = view.size;
        loaded.exponent = view.shininess;
        for (material, own) in scene.materials_mut().iter_mut().zip(&loaded.exponents) {
            material.shininess = if view.shininess > 0.0 {
                view.shininess
            } else {
                *own
            };
        }
        let mut frame = match self.frame.take() {
            Some(mut frame) => scene.frame_into(&mut frame).map(|()| frame),
            None => scene.frame(),
        }
        .map_err(|error| error.to_string())?;
        // The page shows pictures over the background, as files without alpha do.
        frame.set_alpha(Alpha::Flattened);
        Ok(self.frame.insert(frame).polygons().len())
    }

    pub fn draw(&mut self, is_exact: bool) -> Result<usize, String> {
        let drawing = Drawing::from_str(&self.told()).map_err(|error| error.to_string())?;
        let Some(frame) = &self.frame else {
            return Err("no frame".into());
        };
        if is_exact {
            self.others.clear();
        }
        let drawn = if let Drawing::Reference(model) = drawing {
            let exact = reference::render(frame, model);
            if is_exact {
                self.others = other_polygons(frame, &exact.polygons);
            }
            exact.to_linear()
        } else {
            let drawn = drawing.render_linear(frame, Renderer::LECTURE);
            drawn.map_err(|error| match error {
                DrawError::Refused(why) => why.to_string(),
                other => other.to_string(),
            })?
        };
        *if is_exact {
            &mut self.exact
        } else {
            &mut self.picture
        } = drawn;
        Ok(0)
    }

    pub fn stored(&mut self) -> *const u8 {
        let encoding = self.frame.as_ref().map(Frame::encoding).unwrap_or_default();
        self.bytes = store(&self.picture, encoding);
        let pixels = self.bytes.pixels_mut().iter_mut();
        pixels.for_each(|pixel| pixel[3] = 255);
        self.bytes.pixels().as_ptr().cast()
    }

    pub fn compare(&mut self) -> *const f64 {
        let (mut most, mut place, mut squares) = (0.0f32, 0, 0.0f64);
        let pairs = self.picture.pixels().iter().zip(self.exact.pixels());
        self.errors.clear();
        for (i, (p, q)) in pairs.enumerate() {
            let apart = [0, 1, 2].map(|c| 255.0 * (p[c] - q[c]).abs());
            let is_other = self.others.get(i).is_some_and(|is_other| *is_other);
            let apart = if is_other { [0.0; 3] } else { apart };
            let error = apart[0].max(apart[1]).max(apart[2]);
            self.errors.push(error);
            squares += f64::from(apart.iter().map(|e| e * e).sum::<f32>());
            if error > most {
                (most, place) = (error, i);
            }
        }
        let (count, width) = (self.errors.len().max(1), self.picture.width().max(1));
        let root = (squares / (3 * count) as f64).sqrt();
        let [column, row] = [place % width, place / width].map(|v| v as f64);
        self.values = vec![f64::from(most), column, row, root, count as f64];
        self.values.as_ptr()
    }
}

/// Returns true at the pixels where the engine shows other polygons than `seen`, which holds the
/// index of a polygon for each sample.
fn other_polygons(frame: &Frame, seen: &Picture<u32>) -> Vec<bool> {
    let (drawn, samples) = (polygon_indices(frame), frame.samples());
    let mut others = vec![false; frame.picture_width() * frame.picture_height()];
    for y in 0..frame.height() {
        for (x, (a, b)) in drawn.row(y).iter().zip(seen.row(y)).enumerate() {
            others[y / samples * frame.picture_width() + x / samples] |= a != b;
        }
    }
    others
}

/// Returns what is laid over a scene for pictures of `size`, which is nothing if a side is 0.
fn of_size(size: [u32; 2]) -> Overlay {
    let mut over = SceneTable::default();
    if !size.contains(&0) {
        let image = over.table_mut("image");
        for (key, side) in ["width", "height"].into_iter().zip(size) {
            image.set(key, Data::Whole(side.into()), Origin::Program);
        }
    }
    Overlay::new(over, SceneTable::default())
}

impl Loaded {
    fn new(opened: Opened) -> Result<Loaded, String> {
        let (file, scene, mut notes) = (opened.file, opened.scene, opened.notes);
        notes.append(of_meshes(&scene));
        let mut prepared = scene.prepare().map_err(|error| error.to_string())?;
        let exponents = prepared
            .materials_mut()
            .iter()
            .map(|material| material.shininess)
            .collect();
        let camera = file.table().table("camera");
        let given =
            ["near", "far"].map(|key| camera.is_some_and(|camera| camera.get(key).is_some()));
        Ok(Loaded {
            start: Start::new(&scene, given),
            shown_lights: scene.lights.clone(),
            exponents,
            size: [scene.width, scene.height],
            exponent: 0.0,
            prepared,
            notes,
            scene,
            file,
        })
    }

    /// Returns the camera of the frame.
    pub fn camera(&self) -> Camera {
        *self.prepared.camera()
    }

    /// Returns the scene in the view of the frame.
    pub fn shown(&self) -> Scene {
        let mut scene = self.scene.clone();
        scene.camera = self.camera();
        scene.lights.clone_from(&self.shown_lights);
        scene
    }
}
