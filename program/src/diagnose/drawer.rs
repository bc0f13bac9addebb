//! The drawer draws recipes at sampled pixels, and stores everything that several recipes share.

use super::amounts::Amounts;
use super::geometry::DrawnFrame;
use super::hits::{Hits, LookedAt};
use super::levels::Levels;
use super::light::Illumination;
use super::lit::{Lit, Shader};
use super::mixing::Mixer;
use super::recipe::{Geometry, Place, Rate, Recipe, Shading, Storage, Turn};
use super::residual::{Drawn, Target};
use super::stage::Stage;
use alloc::rc::Rc;
use alloc::vec::Vec;
use fastphong::frame::Frame;
use fastphong::picture::LinearPicture;
use fastphong::raster::Renderer;
use fastphong::scene;
use fastphong::shading::{METHODS, Variant};
use glam::DVec3;
use std::collections::HashMap;

/// The linear light of each sampled pixel.
type Light = Rc<Vec<DVec3>>;

/// A recipe with fitted amounts at the sampled pixels.
pub struct FittedPicture {
    pub amounts: Amounts,
    pub drawn: Drawn,
}

/// Lights and exponents that were fitted to a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// The direction or position of each light, in the world.
    pub lights: Vec<scene::Place<DVec3>>,
    /// The factor of all exponents.
    pub exponent: f64,
    /// The density k of fog, through which e^(−k d) of the light passes at the distance d.
    pub fog: Option<f64>,
}

/// Draws recipes of a scene at the sampled pixels of someone's picture.
pub struct Drawer<'a> {
    stage: &'a Stage<'a>,
    /// The sampled pixels: column, row.
    pub pixels: Vec<[usize; 2]>,
    /// The levels of pixels that nothing covers.
    pub background: [f32; 3],
    /// The levels of the diagnosed picture at the sampled pixels, from which the drawer finds out
    /// how far colours are stretched. Empty if there is no picture.
    pub target: Vec<[f32; 3]>,
    finds_edges: bool,
    looked_at: HashMap<(Place, bool), Rc<LookedAt>>,
    hits: HashMap<(Geometry, Place), Option<Rc<Hits>>>,
    lit: HashMap<(Geometry, Place, Shading), Option<Rc<Lit>>>,
    lit_bytes: usize,
    by_method: HashMap<(Geometry, Place, u8), Option<Light>>,
}

/// Pictures with more pixels are not drawn by methods, which draw whole pictures.
const MOST_OF_METHODS: usize = 1 << 22;

/// How many bytes of lit points are stored.
const MOST_LIT: usize = 48 << 20;

impl<'a> Drawer<'a> {
    /// Makes a drawer of `pixels`.
    pub fn new(stage: &'a Stage<'a>, pixels: Vec<[usize; 2]>, finds_edges: bool) -> Drawer<'a> {
        Drawer {
            stage,
            pixels,
            background: [0.0; 3],
            target: Vec::new(),
            finds_edges,
            looked_at: HashMap::new(),
            hits: HashMap::new(),
            lit: HashMap::new(),
            lit_bytes: 0,
            by_method: HashMap::new(),
        }
    }

    /// Draws a recipe, or returns `None` if it cannot be drawn.
    pub fn draw(&mut self, recipe: &Recipe) -> Option<Drawn> {
        let hits = self.hits(recipe.geometry, recipe.place)?;
        let light = self.light(recipe)?;
        let levels = self.levels(recipe.storage, &hits, &light);
        Some(Drawn { levels, hits })
    }

    /// Returns the levels of linear light, and the background's where nothing is visible.
    pub fn levels(&self, storage: Storage, hits: &Hits, light: &[DVec3]) -> Vec<[f32; 3]> {
        let mut levels = Levels::new(storage, self.stage.scene.encoding);
        if levels.is_stretched() {
            levels.scale = self.stretched(&levels, light, hits);
        }
        let all = light.iter().enumerate();
        let of = |(i, colour): (usize, &DVec3)| {
            if hits.is_covered(i) {
                levels.of(*colour)
            } else {
                self.background
            }
        };
        all.map(of).collect()
    }

    /// Returns the factor by which colours are stretched. It is the factor that comes closest to
    /// the picture, because the picture's brightest pixel need not be among the samples.
    fn stretched(&self, levels: &Levels, light: &[DVec3], hits: &Hits) -> f64 {
        let (mut both, mut own) = (0.0, 0.0);
        for (i, stored) in self.target.iter().enumerate() {
            if hits.is_covered(i) && !hits.edges[i] {
                let decoded = stored.map(|level| levels.decoded(level.into()));
                both += light[i].dot(DVec3::from_array(decoded));
                own += light[i].length_squared();
            }
        }
        let most = light.iter().map(|c| c.max_element()).fold(0.0, f64::max);
        if most <= 0.0 {
            return 1.0;
        }
        if own <= 0.0 {
            return 1.0 / most;
        }
        // The picture's brightest pixel is brighter than the brightest sample, but not twice as
        // bright.
        let scale = (both / own).clamp(0.5 / most, 1.02 / most);
        // Other roundings change as little.
        if (scale - 1.0).abs() < 0.01 {
            1.0
        } else {
            scale
        }
    }

    /// Returns the hits at the sampled pixels.
    pub fn hits(&mut self, geometry: Geometry, place: Place) -> Option<Rc<Hits>> {
        if let Some(hits) = self.hits.get(&(geometry, place)) {
            return hits.clone();
        }
        let hits = self.stage.frame(geometry).map(|drawn| {
            let looked_at = self.looked_at(place, &drawn);
            let surface = self.stage.surface;
            Rc::new(Hits::new(&drawn.frame, surface, &looked_at, &geometry))
        });
        self.hits.insert((geometry, place), hits.clone());
        hits
    }

    fn looked_at(&mut self, place: Place, drawn: &DrawnFrame) -> Rc<LookedAt> {
        let key = (place, drawn.is_turned);
        if let Some(known) = self.looked_at.get(&key) {
            return known.clone();
        }
        let size = [drawn.frame.width(), drawn.frame.height()];
        let places = self.places(place, drawn);
        let looked_at = Rc::new(LookedAt::new(places, size, self.finds_edges));
        self.looked_at.insert(key, looked_at.clone());
        looked_at
    }

    /// Returns the pixels of the frame that the sampled pixels of the file show.
    fn places(&self, place: Place, drawn: &DrawnFrame) -> Vec<Option<[usize; 2]>> {
        let size = [drawn.frame.width(), drawn.frame.height()];
        let of = |&pixel: &[usize; 2]| place.pixel(pixel, size, drawn.is_turned);
        self.pixels.iter().map(of).collect()
    }

    /// Returns the linear light at each sampled pixel, not clamped, and 0 where nothing is visible.
    pub fn light(&mut self, recipe: &Recipe) -> Option<Light> {
        let (geometry, place, shading) = (recipe.geometry, recipe.place, recipe.shading);
        if let Rate::Method(method) = shading.rate {
            return self.by_method(geometry, place, method);
        }
        let lit = self.lit(geometry, place, shading)?;
        let mixer = Mixer::new(self.stage.scene, recipe.mixing);
        let materials = self.stage.prepared.materials();
        let is_clamped = shading.rate == Rate::Vertex;
        Some(Rc::new(lit.colours(&mixer, materials, is_clamped)))
    }

    /// Returns the lit points of a shading.
    pub fn lit(
        &mut self,
        geometry: Geometry,
        place: Place,
        mut shading: Shading,
    ) -> Option<Rc<Lit>> {
        if shading.rate == Rate::Vertex {
            shading.rate = Rate::VertexUnclamped; // the same points
        }
        let key = (geometry, place, shading);
        if let Some(known) = self.lit.get(&key) {
            return known.clone();
        }
        let hits = self.hits(geometry, place)?;
        let lit = Rc::new(self.lit_by(&hits, shading, None));
        if self.lit_bytes > MOST_LIT {
            self.lit.clear();
            self.lit_bytes = 0;
        }
        self.lit_bytes += lit.bytes();
        self.lit.insert(key, Some(lit.clone()));
        Some(lit)
    }

    /// Lights hits, by fitted lights if there are any.
    pub fn lit_by(&self, hits: &Hits, shading: Shading, fitted: Option<&Fitted>) -> Lit {
        let stage = self.stage;
        let origin = stage.surface.origin;
        let mut illumination = Illumination::new(stage.scene, stage.light_lengths, origin, shading);
        if let Some(fitted) = fitted {
            illumination = illumination.fitted(&fitted.lights, fitted.exponent);
        }
        let shader = Shader {
            surface: stage.surface,
            materials: stage.prepared.materials(),
            hits,
            normals: &stage.normals(shading.normals),
            shading,
            illumination: &illumination,
        };
        shader.lit()
    }

    /// Fits the amounts of a recipe to a picture, with fitted lights if there are any.
    pub fn fit(
        &mut self,
        recipe: &Recipe,
        fitted: Option<&Fitted>,
        target: &Target,
    ) -> Option<FittedPicture> {
        let hits = self.hits(recipe.geometry, recipe.place)?;
        let lit = match fitted {
            None => self.lit(recipe.geometry, recipe.place, recipe.shading)?,
            Some(_) => Rc::new(self.lit_by(&hits, recipe.shading, fitted)),
        };
        let density = fitted.and_then(|fitted| fitted.fog);
        let clearness = density.map(|density| self.clearness(&hits, density));
        let mut amounts = Amounts::new(
            &lit,
            &hits,
            target,
            recipe.storage,
            self.stage.scene.encoding,
            self.background,
            clearness.as_deref(),
        );
        let levels = core::mem::take(&mut amounts.levels);
        let drawn = Drawn { levels, hits };
        Some(FittedPicture { amounts, drawn })
    }

    /// Returns the share of light at each pixel that passes fog of a density.
    pub fn clearness(&self, hits: &Hits, density: f64) -> Vec<f64> {
        let surface = self.stage.surface;
        let eye = self.stage.scene.camera.eye - surface.origin;
        let at = |i: usize| {
            let weights = hits.weights(i).iter();
            let p: DVec3 = weights
                .map(|&(v, weight)| surface.positions[v as usize] * weight)
                .sum();
            libm::exp(-density * (p - eye).length())
        };
        (0..hits.len()).map(at).collect()
    }

    fn by_method(&mut self, geometry: Geometry, place: Place, method: u8) -> Option<Light> {
        let key = (geometry, place, method);
        if let Some(known) = self.by_method.get(&key) {
            return known.clone();
        }
        let colours = self.drawn_by_method(geometry, place, method).map(Rc::new);
        self.by_method.insert(key, colours.clone());
        colours
    }

    fn drawn_by_method(&self, geometry: Geometry, place: Place, method: u8) -> Option<Vec<DVec3>> {
        let drawn = self.stage.frame(geometry)?;
        let method = METHODS.get(usize::from(method))?.variant();
        let picture = drawn_by(&drawn.frame, &method)?;
        let colour = |[x, y]: [usize; 2]| {
            let [r, g, b, _] = picture.get(x, y).map(f64::from);
            DVec3::new(r, g, b)
        };
        let all = self.places(place, &drawn).into_iter();
        Some(all.map(|pixel| pixel.map_or(DVec3::ZERO, colour)).collect())
    }
}

impl Place {
    /// Returns the pixel of a frame of `size` that a pixel of the file shows, or `None` if it lies
    /// outside. With `is_turned` the frame is turned by half a circle.
    pub fn pixel(
        self,
        [x, y]: [usize; 2],
        size: [usize; 2],
        is_turned: bool,
    ) -> Option<[usize; 2]> {
        let size = size.map(|side| side as i64);
        let [dx, dy] = self.moved.map(i64::from);
        let [mut x, mut y] = [x as i64 - dx, y as i64 - dy];
        let is_inside = |x: i64, y: i64| (0..size[0]).contains(&x) && (0..size[1]).contains(&y);
        if !is_inside(x, y) {
            return None;
        }
        let (mut mirrors_x, mut mirrors_y) = (is_turned, is_turned);
        match self.turn {
            Turn::Stated => {}
            Turn::MirroredX => mirrors_x = !mirrors_x,
            Turn::MirroredY => mirrors_y = !mirrors_y,
            Turn::Half => (mirrors_x, mirrors_y) = (!mirrors_x, !mirrors_y),
            Turn::Transposed => (x, y) = (y, x),
            Turn::Columns => {
                let index = y * size[0] + x;
                (x, y) = (index / size[1], index % size[1]);
            }
        }
        x = if mirrors_x { size[0] - 1 - x } else { x };
        y = if mirrors_y { size[1] - 1 - y } else { y };
        is_inside(x, y).then_some([x as usize, y as usize])
    }
}

/// Draws a method on a frame, if the method can draw it and the picture is not too large.
pub fn drawn_by(frame: &Frame, method: &Variant) -> Option<LinearPicture> {
    let is_small = frame.width() * frame.height() <= MOST_OF_METHODS;
    let picture = is_small.then(|| method.render_linear_with(frame, Renderer::fastest()))?;
    picture.ok()
}
