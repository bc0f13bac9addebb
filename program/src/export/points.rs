//! Ten pixels, with everything that the light at them is computed from, as CSV.

use super::Export;
use super::document::view;
use super::mesh::{Mesh, position};
use super::terms::{LightAt, Terms, unit};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use fastphong::frame::{Frame, Geometry, Polygon};
use fastphong::picture::Picture;
use fastphong::picture::encoding::store_f64;
use fastphong::reference::ReferencePicture;
use fastphong::reference::coverage::{Scanline, VertexWeights};
use fastphong::scene::{Interpolation, SpecularModel};
use glam::DVec3;
use std::collections::HashMap;

/// The beginning of the first line, by which a file is recognised.
pub const HEAD: &str = "column,row,face,material,light,P_x,P_y,P_z,P_view_x";

/// How many pixels there are.
const POINTS: usize = 10;
/// How many cells the picture has along its longer side, and how many pixels of a cell are looked
/// at along each of its sides.
const CELLS: usize = 64;
const LOOKED_AT: usize = 16;
/// The least channel of a highlight that counts as one: 13 levels.
const HIGHLIGHT: f64 = 0.05;

/// A pixel that may be chosen.
struct Candidate {
    pixel: [usize; 2],
    polygon: Polygon,
    /// How many of the eight neighbours show its polygon, and how many any polygon.
    around: [usize; 2],
    material: usize,
    position: DVec3,
    normal: DVec3,
    terms: Terms,
}

/// Returns the table: a row for each pixel and light. Without lights it has a row for each pixel.
pub fn csv(export: &Export, mesh: &Mesh, drawn: &ReferencePicture) -> String {
    let levels = store_f64(&drawn.picture, export.scene.encoding);
    let mut text = head(export);
    for candidate in chosen(candidates(export, mesh, drawn)) {
        let [x, y] = candidate.pixel;
        let [r, g, b, _] = levels.get(x, y);
        let lights = &candidate.terms.lights;
        if lights.is_empty() {
            text += &candidate.row(export, mesh, None, [r, g, b]);
        }
        for at in lights.iter().enumerate() {
            text += &candidate.row(export, mesh, Some(at), [r, g, b]);
        }
    }
    text
}

fn head(export: &Export) -> String {
    let (r, cosine) = match export.scene.specular {
        SpecularModel::Phong => ("R", "R.V"),
        SpecularModel::Blinn => ("H", "N.H"),
    };
    let vector = |name: &str| format!("{name}_x,{name}_y,{name}_z");
    let colour = |name: &str| format!("{name}_r,{name}_g,{name}_b");
    let vectors = [
        "P", "P_view", "N", "N_view", "L", "L_view", "V", "V_view", r,
    ]
    .map(vector);
    let colours = ["ambient", "diffuse", "specular", "sum", "level"].map(colour);
    let head = format!(
        "column,row,face,material,light,{},L.N,{cosine},{}\n",
        vectors.join(","),
        colours.join(",")
    );
    debug_assert!(head.starts_with(HEAD), "the mark of the file");
    head
}

impl Candidate {
    fn row(
        &self,
        export: &Export,
        mesh: &Mesh,
        light: Option<(usize, &LightAt)>,
        level: [u8; 3],
    ) -> String {
        let to_view = view(&export.scene);
        let three = |v: DVec3| v.to_array().map(digits).join(",");
        let point = |v: DVec3| v.to_array().map(coordinate).join(",");
        let turned = |v: DVec3| three(to_view.transform_vector3(v));
        let ([x, y], terms) = (self.pixel, &self.terms);
        let face = mesh
            .faces
            .partition_point(|face| *face < self.polygon.source);
        let name = &mesh.materials[self.material].name;
        let or_none = |of: &dyn Fn(&LightAt) -> String, none: &str| {
            light.map_or_else(|| none.into(), |(_, at)| of(at))
        };
        let cells = [
            format!("{x},{y},{face},{name}"),
            light.map_or_else(String::new, |(index, _)| format!("{index}")),
            point(self.position),
            point(to_view.transform_point3(self.position)),
            three(self.normal),
            turned(self.normal),
            or_none(&|at| three(at.l), ",,"),
            or_none(&|at| turned(at.l), ",,"),
            three(terms.v),
            turned(terms.v),
            or_none(&|at| three(at.r), ",,"),
            or_none(&|at| digits(at.l_n), ""),
            or_none(&|at| digits(at.cosine), ""),
            three(terms.ambient),
            or_none(&|at| three(at.diffuse), "0,0,0"),
            or_none(&|at| three(at.specular), "0,0,0"),
            three(terms.sum),
            level.map(|level| format!("{level}")).join(","),
        ];
        cells.join(",") + "\n"
    }

    /// True if all light comes from behind.
    fn is_dark(&self) -> bool {
        let mut lights = self.terms.lights.iter();
        !self.terms.lights.is_empty() && lights.all(|at| at.l_n <= 0.0)
    }

    fn highlight(&self) -> f64 {
        let lights = self.terms.lights.iter();
        let all: DVec3 = lights.map(|at| at.specular).sum();
        all.max_element()
    }

    /// Returns the square of the distance to the nearest of `others`, in pixels.
    fn distance(&self, others: &[Candidate]) -> usize {
        let square = |other: &Candidate| {
            let of_axis = |i: usize| self.pixel[i].abs_diff(other.pixel[i]).pow(2);
            of_axis(0) + of_axis(1)
        };
        others.iter().map(square).min().unwrap_or(usize::MAX)
    }
}

/// Writes a number with seven digits, which show the decimals of the scene's `f32`.
fn digits(number: f64) -> String {
    rounded(&format!("{number:.6e}"))
}

/// Writes a coordinate with ten digits, because a scene may be far from the origin.
fn coordinate(number: f64) -> String {
    rounded(&format!("{number:.9e}"))
}

/// Writes a number without an exponent, unless it is tiny.
fn rounded(number: &str) -> String {
    // A zero has no sign.
    let number = number.parse().unwrap_or(0.0_f64) + 0.0;
    if number != 0.0 && number.abs() < 1e-6 {
        format!("{number:e}")
    } else {
        format!("{number}")
    }
}

/// Returns the pixels of a coarse grid that polygons cover, each the one of its cell that is
/// farthest inside a polygon.
fn candidates(export: &Export, mesh: &Mesh, drawn: &ReferencePicture) -> Vec<Candidate> {
    let polygons = &drawn.polygons;
    let (width, height) = (polygons.width(), polygons.height());
    let step = width.max(height).div_ceil(CELLS);
    let stride = step.div_ceil(LOOKED_AT);
    let surface = Surface::new(export);
    let mut found = Vec::new();
    for top in (0..height).step_by(step) {
        for left in (0..width).step_by(step) {
            let columns = (left..(left + step).min(width)).step_by(stride);
            let rows = (top..(top + step).min(height)).step_by(stride);
            let pixels = rows.flat_map(|y| columns.clone().map(move |x| [x, y]));
            let covered = pixels.filter_map(|pixel| {
                let index = polygons.get(pixel[0], pixel[1]);
                let polygon = export.frame.polygons().get(index as usize)?;
                Some((around(polygons, pixel), pixel, *polygon))
            });
            let best = covered.reduce(|best, next| if next.0 > best.0 { next } else { best });
            let best = best.and_then(|(around, pixel, polygon)| {
                let (position, normal, colour) = surface.at(&polygon, pixel)?;
                let materials = export.prepared.materials();
                let material = &materials[polygon.material as usize];
                Some(Candidate {
                    pixel,
                    polygon,
                    around,
                    material: mesh.material(&export.prepared, polygon.source),
                    position,
                    normal,
                    terms: Terms::new(&export.scene, material, position, normal, colour),
                })
            });
            found.extend(best);
        }
    }
    found
}

/// Returns how many of a pixel's eight neighbours show its polygon, and how many any polygon.
fn around(polygons: &Picture<u32>, [x, y]: [usize; 2]) -> [usize; 2] {
    let own = polygons.get(x, y);
    let rows = y.saturating_sub(1)..(y + 2).min(polygons.height());
    let columns = x.saturating_sub(1)..(x + 2).min(polygons.width());
    let all = rows.flat_map(|y| columns.clone().map(move |x| polygons.get(x, y)));
    all.fold([0, 0], |[same, any], polygon| {
        [
            same + usize::from(polygon == own),
            any + usize::from(polygon != fastphong::reference::Visibility::NONE),
        ]
    })
}

/// Chooses pixels: of each material its brightest highlight, then two on the dark side, then the
/// ones that are farthest from those. Sorts them by row and column.
fn chosen(mut all: Vec<Candidate>) -> Vec<Candidate> {
    // Well inside a polygon, or else inside the covered part, if there are enough of these.
    let inside: [fn(&Candidate) -> bool; 2] = [|c| c.around[0] == 9, |c| c.around[1] == 9];
    if let Some(inside) = inside
        .iter()
        .find(|inside| all.iter().filter(|c| inside(c)).count() >= POINTS)
    {
        all.retain(inside);
    }
    let mut points: Vec<Candidate> = Vec::new();
    let materials = all.iter().map(|c| c.material).max().map_or(0, |m| m + 1);
    for material in 0..materials.min(POINTS / 2) {
        let shiny = (0..all.len())
            .filter(|&i| all[i].material == material && all[i].highlight() >= HIGHLIGHT);
        let brightest = shiny.max_by(|&a, &b| all[a].highlight().total_cmp(&all[b].highlight()));
        points.extend(brightest.map(|i| all.swap_remove(i)));
    }
    for _ in 0..2 {
        let dark = (0..all.len()).filter(|&i| all[i].is_dark());
        let farthest = dark.max_by_key(|&i| all[i].distance(&points));
        points.extend(farthest.map(|i| all.swap_remove(i)));
    }
    while points.len() < POINTS {
        let is_new = |c: &Candidate| points.iter().all(|point| point.material != c.material);
        let farthest = (0..all.len()).max_by_key(|&i| (is_new(&all[i]), all[i].distance(&points)));
        let Some(farthest) = farthest else { break };
        points.push(all.swap_remove(farthest));
    }
    points.sort_by_key(|point| [point.pixel[1], point.pixel[0]]);
    points
}

/// The surface that is seen at a pixel, from the numbers that are written.
struct Surface<'a> {
    frame: &'a Frame,
    geometry: &'a Geometry,
    is_coloured: Vec<bool>,
    /// Position, normal and colour of vertices that clipping made.
    cut: HashMap<u32, [DVec3; 3]>,
}

impl<'a> Surface<'a> {
    fn new(export: &'a Export) -> Surface<'a> {
        let materials = 0..export.prepared.materials().len() as u32;
        let mut surface = Surface {
            frame: &export.frame,
            geometry: export.prepared.geometry(),
            is_coloured: materials.map(|m| export.prepared.is_coloured(m)).collect(),
            cut: HashMap::new(),
        };
        for corner in export.frame.clip_corners() {
            let (a, b) = (surface.vertex(corner.a), surface.vertex(corner.b));
            let t = f64::from(corner.t);
            let between = [0, 1, 2].map(|i| a[i].lerp(b[i], t));
            surface.cut.insert(corner.vertex, between);
        }
        surface
    }

    /// Returns position, normal and colour of a vertex.
    fn vertex(&self, vertex: u32) -> [DVec3; 3] {
        if let Some(cut) = self.cut.get(&vertex) {
            return *cut;
        }
        let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        // Vertices of the second side follow those of the first.
        let front = vertex as usize % self.geometry.normals.len();
        [
            position(self.geometry, front),
            wide(self.frame.normal(vertex)),
            wide(self.frame.colour(vertex)),
        ]
    }

    /// Returns position, unit normal and colour at a pixel of a polygon.
    fn at(&self, polygon: &Polygon, [x, y]: [usize; 2]) -> Option<(DVec3, DVec3, DVec3)> {
        let mut scanline = Scanline::new(self.frame);
        scanline.cut(self.frame.corners(polygon), y);
        let weights: VertexWeights = scanline.weights(x)?;
        let is_screen = self.frame.interpolation() == Interpolation::Screen;
        let (mut sums, mut whole) = ([DVec3::ZERO; 3], 0.0);
        for (vertex, weight) in weights.all() {
            let inv_w = self.frame.vertices()[vertex as usize].inv_w;
            let weight = weight * if is_screen { 1.0 } else { inv_w };
            let values = self.vertex(vertex);
            whole += weight;
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * value;
            }
        }
        let [position, normal, colour] = sums.map(|sum| sum / whole);
        let is_coloured = self.is_coloured[polygon.material as usize];
        let colour = if is_coloured { colour } else { DVec3::ONE };
        Some((position, unit(normal), colour))
    }
}
