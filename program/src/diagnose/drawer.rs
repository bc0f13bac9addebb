//! The drawer draws recipes at sampled pixels, and stores everything that several recipes share.

use super::geometry::DrawnFrame;
use super::hits::{Hits, LookedAt};
use super::levels::Levels;
use super::light::{Illumination, Terms};
use super::recipe::{
    Cut, Facing, Geometry, MaterialUse, Normals, Place, Rate, Recipe, Shading, Storage,
};
use super::surface::Surface;
use alloc::rc::Rc;
use alloc::vec::Vec;
use fastphong::frame::{Frame, PreparedScene};
use fastphong::mesh::Material;
use fastphong::picture::LinearPicture;
use fastphong::raster::Renderer;
use fastphong::scene::Scene;
use fastphong::shading::{METHODS, Variant};
use glam::DVec3;
use std::collections::HashMap;

/// The linear light of each sampled pixel.
type Light = Rc<Vec<DVec3>>;

/// A recipe at the sampled pixels.
pub struct Drawn {
    /// The levels, 0..=255.
    pub levels: Vec<[f32; 3]>,
    pub hits: Rc<Hits>,
}

/// Draws recipes of a scene at the sampled pixels of someone's picture.
pub struct Drawer<'a> {
    scene: &'a Scene,
    prepared: &'a PreparedScene,
    surface: &'a Surface<'a>,
    /// The sampled pixels: column, row.
    pub pixels: Vec<[usize; 2]>,
    /// The levels of pixels that nothing covers.
    pub background: [f32; 3],
    /// The levels of the diagnosed picture at the sampled pixels, from which the drawer finds out
    /// how far colours are stretched. Empty if there is no picture.
    pub target: Vec<[f32; 3]>,
    /// The lengths of light directions in the scene file; 1 for lights without an entry.
    pub light_lengths: Vec<f64>,
    finds_edges: bool,
    frames: HashMap<Cut, Option<Rc<DrawnFrame>>>,
    looked_at: HashMap<(Place, bool), Rc<LookedAt>>,
    hits: HashMap<(Geometry, Place), Option<Rc<Hits>>>,
    normals: HashMap<Normals, Rc<Vec<DVec3>>>,
    lights: HashMap<(Geometry, Place, Shading), Option<Light>>,
    kept: HashMap<(Geometry, Place, Shading), Option<Light>>,
    methods: HashMap<(Geometry, u8), Option<Rc<LinearPicture>>>,
}

/// Pictures with more pixels are not drawn by methods, because a method's picture is stored as a
/// whole.
const MOST_OF_METHODS: usize = 1 << 22;

impl<'a> Drawer<'a> {
    /// Makes a drawer of `pixels` of a scene with one sample per pixel.
    pub fn new(
        scene: &'a Scene,
        prepared: &'a PreparedScene,
        surface: &'a Surface<'a>,
        pixels: Vec<[usize; 2]>,
        finds_edges: bool,
    ) -> Drawer<'a> {
        Drawer {
            scene,
            prepared,
            surface,
            pixels,
            background: [0.0; 3],
            target: Vec::new(),
            light_lengths: Vec::new(),
            finds_edges,
            frames: HashMap::new(),
            looked_at: HashMap::new(),
            hits: HashMap::new(),
            normals: HashMap::new(),
            lights: HashMap::new(),
            kept: HashMap::new(),
            methods: HashMap::new(),
        }
    }

    /// Draws a recipe, or returns `None` if it cannot be drawn.
    pub fn draw(&mut self, recipe: &Recipe) -> Option<Drawn> {
        let hits = self.hits(recipe.geometry, recipe.place)?;
        let light = self.light(recipe.geometry, recipe.place, recipe.shading)?;
        let levels = self.levels(recipe.storage, &hits, &light);
        Some(Drawn { levels, hits })
    }

    /// Returns the levels of linear light, and the background's where nothing is visible.
    pub fn levels(&self, storage: Storage, hits: &Hits, light: &[DVec3]) -> Vec<[f32; 3]> {
        let mut levels = Levels::new(storage, self.scene.encoding);
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
            1.0
        } else if own > 0.0 {
            // The picture's brightest pixel is brighter than the brightest sample, but not twice as
            // bright.
            (both / own).clamp(0.5 / most, 1.02 / most)
        } else {
            1.0 / most
        }
    }

    /// Returns the frame of a geometry. Frames that differ only in the cut of polygons serve many
    /// recipes, and are stored.
    fn frame(&mut self, geometry: Geometry) -> Option<Rc<DrawnFrame>> {
        let plain = Geometry {
            cut: geometry.cut,
            ..Geometry::default()
        };
        if geometry != plain {
            return geometry.frame(self.prepared).map(Rc::new);
        }
        let prepared = self.prepared;
        let frame = self.frames.entry(geometry.cut);
        frame
            .or_insert_with(|| geometry.frame(prepared).map(Rc::new))
            .clone()
    }

    /// Returns the hits at the sampled pixels.
    pub fn hits(&mut self, geometry: Geometry, place: Place) -> Option<Rc<Hits>> {
        if let Some(hits) = self.hits.get(&(geometry, place)) {
            return hits.clone();
        }
        let hits = self.frame(geometry).map(|drawn| {
            let looked_at = self.looked_at(place, &drawn);
            Rc::new(Hits::new(&drawn.frame, self.surface, &looked_at, &geometry))
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
        let size = [drawn.frame.width(), drawn.frame.height()].map(|side| side as i64);
        let of = |&[x, y]: &[usize; 2]| {
            let [mut x, mut y] = [x as i64, y as i64];
            let (mut mirrors_x, mut mirrors_y) = (drawn.is_turned, drawn.is_turned);
            match place {
                Place::Stated => {}
                Place::MirroredX => mirrors_x = !mirrors_x,
                Place::MirroredY => mirrors_y = !mirrors_y,
                Place::Turned => (mirrors_x, mirrors_y) = (!mirrors_x, !mirrors_y),
                Place::Transposed => (x, y) = (y, x),
                Place::Columns => {
                    let index = y * size[0] + x;
                    (x, y) = (index / size[1], index % size[1]);
                }
                Place::Moved([dx, dy]) => (x, y) = (x - i64::from(dx), y - i64::from(dy)),
            }
            x = if mirrors_x { size[0] - 1 - x } else { x };
            y = if mirrors_y { size[1] - 1 - y } else { y };
            let is_inside = (0..size[0]).contains(&x) && (0..size[1]).contains(&y);
            is_inside.then_some([x as usize, y as usize])
        };
        self.pixels.iter().map(of).collect()
    }

    /// Returns the linear light at each sampled pixel, not clamped, and 0 where nothing is visible.
    pub fn light(&mut self, geometry: Geometry, place: Place, shading: Shading) -> Option<Light> {
        let key = (geometry, place, shading);
        if let Some(light) = self.kept.get(&key).or_else(|| self.lights.get(&key)) {
            return light.clone();
        }
        let light = match shading.rate {
            Rate::Method(method) => self.by_method(geometry, place, method),
            _ => self.hits(geometry, place).map(|hits| {
                let illumination = self.illumination(shading);
                let normals = self.normals(shading.normals);
                self.shader(&hits, &normals, shading, &illumination).all()
            }),
        };
        let light = light.map(Rc::new);
        self.lights.insert(key, light.clone());
        light
    }

    /// Returns the terms of each pixel's colour (ambient, diffuse, specular). Exponents are
    /// multiplied by `factor`.
    pub fn terms(&mut self, recipe: &Recipe, factor: f64) -> Option<Vec<Terms>> {
        let hits = self.hits(recipe.geometry, recipe.place)?;
        let shading = recipe.shading;
        let illumination = self.illumination(shading).with_exponents(factor);
        let normals = self.normals(shading.normals);
        let shader = self.shader(&hits, &normals, shading, &illumination);
        Some((0..hits.len()).map(|i| shader.terms(i)).collect())
    }

    fn illumination(&self, shading: Shading) -> Illumination {
        Illumination::new(
            self.scene,
            &self.light_lengths,
            self.surface.origin,
            shading,
        )
    }

    fn shader<'s>(
        &'s self,
        hits: &'s Hits,
        normals: &'s [DVec3],
        shading: Shading,
        illumination: &'s Illumination,
    ) -> Shader<'s> {
        Shader {
            surface: self.surface,
            materials: self.prepared.materials(),
            hits,
            normals,
            shading,
            illumination,
        }
    }

    fn normals(&mut self, normals: Normals) -> Rc<Vec<DVec3>> {
        let surface = self.surface;
        let known = self.normals.entry(normals);
        known
            .or_insert_with(|| Rc::new(surface.normals(normals)))
            .clone()
    }

    fn by_method(&mut self, geometry: Geometry, place: Place, method: u8) -> Option<Vec<DVec3>> {
        let drawn = self.frame(geometry)?;
        let pixels = self.places(place, &drawn);
        let known = self.methods.entry((geometry, method));
        let picture = known
            .or_insert_with(|| {
                let method = METHODS.get(usize::from(method))?.variant();
                drawn_by(&drawn.frame, &method).map(Rc::new)
            })
            .clone()?;
        let colour = |[x, y]: [usize; 2]| {
            let [r, g, b, _] = picture.get(x, y).map(f64::from);
            DVec3::new(r, g, b)
        };
        let all = pixels.into_iter();
        Some(all.map(|pixel| pixel.map_or(DVec3::ZERO, colour)).collect())
    }

    /// Stores the light of all recipes drawn so far, because pairs of mistakes are drawn from it.
    pub fn keep_light(&mut self) {
        self.kept.extend(self.lights.drain());
    }

    /// Forgets the light of all recipes drawn since: for all pairs of mistakes it would fill the
    /// memory.
    pub fn forget_light(&mut self) {
        self.lights.clear();
    }
}

/// Draws a method on a frame, if the method can draw it and the picture is not too large.
pub fn drawn_by(frame: &Frame, method: &Variant) -> Option<LinearPicture> {
    let is_small = frame.width() * frame.height() <= MOST_OF_METHODS;
    let picture = is_small.then(|| method.render_linear_with(frame, Renderer::fastest()))?;
    picture.ok()
}

/// A point of the surface, ready to be lit.
#[derive(Clone, Copy, Default)]
struct Point {
    normal: DVec3,
    position: DVec3,
    /// The vertex colour, by which some materials are multiplied.
    colour: DVec3,
}

/// The shader of a recipe, which lights hits.
struct Shader<'a> {
    surface: &'a Surface<'a>,
    materials: &'a [Material],
    hits: &'a Hits,
    normals: &'a [DVec3],
    shading: Shading,
    illumination: &'a Illumination,
}

impl Shader<'_> {
    /// Returns the light at each pixel.
    fn all(&self) -> Vec<DVec3> {
        let is_at_vertices = matches!(self.shading.rate, Rate::Vertex | Rate::VertexUnclamped);
        if !is_at_vertices {
            let sum = |i| self.terms(i).iter().sum();
            return (0..self.hits.len()).map(sum).collect();
        }
        // A vertex is lit once, or once for each of its polygons if polygons have their own
        // normals.
        let is_by_polygon = matches!(self.shading.normals, Normals::OfFaces | Normals::OfFacesRaw);
        let mut lit = HashMap::new();
        let mut colour = |i: usize, vertex: u32| {
            let polygon = if is_by_polygon {
                self.hits.polygons[i]
            } else {
                0
            };
            let key = (
                vertex,
                polygon,
                self.hits.materials[i],
                self.hits.flipped[i],
            );
            *lit.entry(key).or_insert_with(|| {
                let n = self.vertex_normal(i, vertex);
                let terms = self.lit(i, self.at_vertex(n, vertex), None);
                let sum: DVec3 = terms.iter().sum();
                match self.shading.rate {
                    Rate::Vertex => sum.clamp(DVec3::ZERO, DVec3::ONE),
                    _ => sum,
                }
            })
        };
        let at_pixel = |i: usize| {
            let weights = self.hits.weights(i).iter();
            weights.map(|&(v, weight)| colour(i, v) * weight).sum()
        };
        (0..self.hits.len()).map(at_pixel).collect()
    }

    /// Returns the terms of the colour at pixel `i`, or 0 where nothing is visible.
    fn terms(&self, i: usize) -> Terms {
        if !self.hits.is_covered(i) {
            return [DVec3::ZERO; 3];
        }
        let polygon = self.hits.polygons[i];
        let surface = self.surface;
        let weights = self.hits.weights(i).iter();
        let position = |v: u32| surface.positions[v as usize];
        let piece = self.hits.pieces[i];
        let corners = piece
            .as_ref()
            .map_or(surface.corners(polygon), |piece| &piece[..]);
        let middle = || {
            let sum: DVec3 = corners.iter().map(|&v| position(v)).sum();
            sum / corners.len() as f64
        };
        let interpolated = || {
            weights.fold(Point::default(), |sum, &(v, weight)| {
                let own = self.at_vertex(self.vertex_normal(i, v), v);
                Point {
                    normal: sum.normal + own.normal * weight,
                    position: sum.position + own.position * weight,
                    colour: sum.colour + own.colour * weight,
                }
            })
        };
        let whole = |normal: DVec3| {
            let sum: DVec3 = corners.iter().map(|&v| surface.colour(v)).sum();
            Point {
                normal,
                position: middle(),
                colour: sum / corners.len() as f64,
            }
        };
        match self.shading.rate {
            Rate::Pixel | Rate::Method(_) => self.lit(i, interpolated(), None),
            Rate::ConstantVectors => self.lit(i, interpolated(), Some(middle())),
            Rate::Face => self.lit(i, whole(self.face(i)), None),
            Rate::FaceMean => {
                let normals = corners.iter().map(|&v| self.vertex_normal(i, v));
                let n: DVec3 = normals.sum();
                self.lit(i, whole(n.normalize_or_zero()), None)
            }
            Rate::FirstVertex => {
                // Polygons of mirrored objects have their corners in reverse order. Pieces begin
                // with the same corner as in the file.
                let is_reversed = piece.is_none() && surface.is_mirrored(corners[0]);
                let first = if is_reversed {
                    corners[corners.len() - 1]
                } else {
                    corners[0]
                };
                let first = self.front(first);
                self.lit(i, self.at_vertex(self.vertex_normal(i, first), first), None)
            }
            // Terms are read to find amounts. They are linear in vertex colours, too, so that these
            // can be interpolated term by term.
            Rate::Vertex | Rate::VertexUnclamped => {
                let mut sum = [DVec3::ZERO; 3];
                for &(v, weight) in self.hits.weights(i) {
                    let terms = self.lit(i, self.at_vertex(self.vertex_normal(i, v), v), None);
                    for (sum, term) in sum.iter_mut().zip(terms) {
                        *sum += term * weight;
                    }
                }
                sum
            }
        }
    }

    fn at_vertex(&self, normal: DVec3, vertex: u32) -> Point {
        Point {
            normal,
            position: self.surface.positions[vertex as usize],
            colour: self.surface.colour(vertex),
        }
    }

    fn lit(&self, i: usize, point: Point, at: Option<DVec3>) -> Terms {
        let material = match self.shading.materials {
            MaterialUse::Own => self.materials[self.hits.materials[i] as usize],
            MaterialUse::First => self.materials[0],
            MaterialUse::Default => Material::default(),
        };
        let (n, p) = (point.normal, point.position);
        let terms = self.illumination.terms(&material, n, p, at.unwrap_or(p));
        // Weights add up to 1 only up to rounding: multiplying by white would change a level.
        if !self.surface.is_coloured(self.hits.materials[i]) {
            return terms;
        }
        let [ambient, diffuse, specular] = terms;
        [ambient * point.colour, diffuse * point.colour, specular]
    }

    fn front(&self, vertex: u32) -> u32 {
        vertex % self.surface.len().max(1) as u32
    }

    fn vertex_normal(&self, i: usize, vertex: u32) -> DVec3 {
        match self.shading.normals {
            Normals::OfFaces => self.face(i),
            Normals::OfFacesRaw => self.face(i) * self.twice_area(i),
            _ => self.turned(i, self.normals[self.front(vertex) as usize]),
        }
    }

    /// Returns twice the area of the polygon at pixel `i`, or of the triangle that it is cut into.
    fn twice_area(&self, i: usize) -> f64 {
        let piece = self.hits.pieces[i];
        let whole = self.surface.corners(self.hits.polygons[i]);
        let corners = piece.as_ref().map_or(whole, |piece| &piece[..]);
        let at = |k: usize| self.surface.positions[corners[k % corners.len()] as usize];
        // Measured from the first corner, which keeps products small.
        let cross = |k: usize| (at(k) - at(0)).cross(at(k + 1) - at(0));
        (1..corners.len() - 1).map(cross).sum::<DVec3>().length()
    }

    /// Returns the normal of the polygon at pixel `i`, or of the triangle that it is cut into.
    fn face(&self, i: usize) -> DVec3 {
        let whole = self.surface.face(self.hits.polygons[i]);
        let own = self.hits.pieces[i].map(|corners| {
            let [a, b, c] = corners.map(|v| self.surface.positions[v as usize]);
            let n = (b - a).cross(c - a).normalize_or(whole);
            n * n.dot(whole).signum()
        });
        self.turned(i, own.unwrap_or(whole))
    }

    /// Turns a normal to the visible side of the polygon at pixel `i`.
    fn turned(&self, i: usize, n: DVec3) -> DVec3 {
        let is_one_sided = self.shading.facing == Facing::OneSided;
        if self.hits.flipped[i] && !is_one_sided {
            -n
        } else {
            n
        }
    }
}
