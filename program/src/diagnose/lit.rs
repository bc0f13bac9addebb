//! Lights the points that a shading is computed at: pixels, vertices or polygons.

use super::hits::Hits;
use super::light::{Illumination, Point, Ray};
use super::mixing::{Matter, Mixer};
use super::recipe::{Facing, MaterialUse, Normals, Rate, Shading, ViewRate};
use super::surface::Surface;
use alloc::vec::Vec;
use core::ops::Range;
use fastphong::mesh::Material;
use glam::DVec3;
use std::collections::HashMap;

/// A shading at some pixels: the rays at its points, and the weights of points at each pixel.
pub struct Lit {
    lights: usize,
    /// A ray for each light at each point.
    rays: Vec<Ray>,
    matters: Vec<OwnMatter>,
    /// The end of each pixel's weights. Pixels that nothing covers have none.
    ends: Vec<u32>,
    weights: Vec<(u32, f64)>,
    /// The material of each pixel, as in [`Hits`].
    materials: Vec<u32>,
}

struct OwnMatter {
    material: u32,
    exponent: f64,
    colour: Option<DVec3>,
}

/// The light terms of a pixel before they are multiplied by materials and light colours.
pub struct Terms<'a> {
    /// The material of the scene there.
    pub material: u32,
    /// The rays, summed by the weights of points.
    pub rays: &'a [Ray],
    /// The vertex colour, or white.
    pub colour: DVec3,
    /// The exponent of the highlights.
    pub exponent: f64,
}

/// Everything that lights hits.
pub struct Shader<'a> {
    pub surface: &'a Surface<'a>,
    pub materials: &'a [Material],
    pub hits: &'a Hits,
    pub normals: &'a [DVec3],
    pub shading: Shading,
    pub illumination: &'a Illumination,
}

impl Lit {
    /// Returns about how many bytes it takes.
    pub fn bytes(&self) -> usize {
        24 * self.rays.len()
            + 48 * self.matters.len()
            + 16 * self.weights.len()
            + 8 * self.ends.len()
    }

    fn range(&self, i: usize) -> Range<usize> {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        start as usize..self.ends[i] as usize
    }

    fn rays(&self, point: u32) -> &[Ray] {
        let first = point as usize * self.lights;
        &self.rays[first..first + self.lights]
    }

    /// Returns the linear colour at each pixel, not clamped, and 0 where nothing is visible.
    /// `materials` are the scene's. With `clamps_points` colours are clamped before they are
    /// interpolated.
    pub fn colours(
        &self,
        mixer: &Mixer,
        materials: &[Material],
        clamps_points: bool,
    ) -> Vec<DVec3> {
        let of_point = |(point, own): (usize, &OwnMatter)| {
            let default = Material::default();
            let matter = Matter {
                material: materials.get(own.material as usize).unwrap_or(&default),
                exponent: own.exponent,
                colour: own.colour,
            };
            let colour = mixer.colour(&matter, self.rays(point as u32));
            if clamps_points {
                colour.clamp(DVec3::ZERO, DVec3::ONE)
            } else {
                colour
            }
        };
        let colours: Vec<DVec3> = self.matters.iter().enumerate().map(of_point).collect();
        let at_pixel = |i: usize| {
            let weights = self.weights[self.range(i)].iter();
            weights
                .map(|&(point, weight)| colours[point as usize] * weight)
                .sum()
        };
        (0..self.ends.len()).map(at_pixel).collect()
    }

    /// Calls `visit` with the terms at each pixel that something covers.
    pub fn for_each_pixel(&self, mut visit: impl FnMut(usize, &Terms<'_>)) {
        let mut sum = Vec::new();
        for i in 0..self.ends.len() {
            let weights = &self.weights[self.range(i)];
            if weights.is_empty() {
                continue;
            }
            sum.clear();
            sum.resize(self.lights, Ray::default());
            let mut colour = DVec3::ZERO;
            let exponent = self.matters[weights[0].0 as usize].exponent;
            for &(point, weight) in weights {
                for (sum, ray) in sum.iter_mut().zip(self.rays(point)) {
                    sum.diffuse += ray.diffuse * weight;
                    sum.highlight += ray.highlight * weight;
                    sum.strength += ray.strength * weight;
                }
                let own = self.matters[point as usize].colour;
                colour += own.unwrap_or(DVec3::ONE) * weight;
            }
            visit(
                i,
                &Terms {
                    material: self.materials[i],
                    rays: &sum,
                    colour,
                    exponent,
                },
            );
        }
    }

    fn add(&mut self, shader: &Shader<'_>, i: usize, point: &Lightable) -> u32 {
        let index = self.matters.len() as u32;
        let own = shader.hits.materials[i];
        let material = match shader.shading.materials {
            MaterialUse::Own => own,
            MaterialUse::First => 0,
            MaterialUse::Default => u32::MAX,
        };
        let default = Material::default();
        let used = shader.materials.get(material as usize).unwrap_or(&default);
        shader.illumination.rays(used, &point.point, &mut self.rays);
        self.matters.push(OwnMatter {
            material,
            exponent: shader.illumination.exponent(used),
            // Weights add up to 1 only up to rounding: multiplying by white would change a level.
            colour: shader.surface.is_coloured(own).then_some(point.colour),
        });
        index
    }
}

/// A point with its vertex colour.
#[derive(Clone, Copy, Default)]
struct Lightable {
    point: Point,
    colour: DVec3,
}

impl Shader<'_> {
    /// Lights all hits.
    pub fn lit(&self) -> Lit {
        let count = self.hits.len();
        let mut lit = Lit {
            lights: self.illumination.len(),
            rays: Vec::new(),
            matters: Vec::new(),
            ends: Vec::with_capacity(count),
            weights: Vec::new(),
            materials: self.hits.materials.clone(),
        };
        let is_at_vertices = matches!(self.shading.rate, Rate::Vertex | Rate::VertexUnclamped);
        // A vertex is lit once, or once for each of its polygons if polygons have their own
        // normals.
        let is_by_polygon = matches!(self.shading.normals, Normals::OfFaces | Normals::OfFacesRaw);
        let mut known = HashMap::new();
        for i in 0..count {
            if self.hits.is_covered(i) && is_at_vertices {
                for &(vertex, weight) in self.hits.weights(i) {
                    let polygon = if is_by_polygon {
                        self.hits.polygons[i]
                    } else {
                        0
                    };
                    let own = (
                        vertex,
                        polygon,
                        self.hits.materials[i],
                        self.hits.flipped[i],
                    );
                    let point = *known.entry(own).or_insert_with(|| {
                        let n = self.vertex_normal(i, vertex);
                        lit.add(self, i, &self.at_vertex(n, vertex))
                    });
                    lit.weights.push((point, weight));
                }
            } else if self.hits.is_covered(i) {
                let point = lit.add(self, i, &self.point(i));
                lit.weights.push((point, 1.0));
            }
            lit.ends.push(lit.weights.len() as u32);
        }
        lit
    }

    /// Returns the point that is lit for pixel `i`.
    fn point(&self, i: usize) -> Lightable {
        let polygon = self.hits.polygons[i];
        let surface = self.surface;
        let position = |v: u32| surface.positions[v as usize];
        let piece = self.hits.pieces[i];
        let corners = piece
            .as_ref()
            .map_or(surface.corners(polygon), |piece| &piece[..]);
        let middle = || {
            let sum: DVec3 = corners.iter().map(|&v| position(v)).sum();
            sum / corners.len() as f64
        };
        let whole = |normal: DVec3| {
            let sum: DVec3 = corners.iter().map(|&v| surface.colour(v)).sum();
            let position = middle();
            Lightable {
                point: Point {
                    normal,
                    position,
                    at: position,
                    view: None,
                },
                colour: sum / corners.len() as f64,
            }
        };
        match self.shading.rate {
            Rate::ConstantVectors => {
                let mut interpolated = self.interpolated(i);
                interpolated.point.at = middle();
                interpolated
            }
            Rate::Face => whole(self.face(i)),
            Rate::FaceMean => {
                let normals = corners.iter().map(|&v| self.vertex_normal(i, v));
                let n: DVec3 = normals.sum();
                whole(n.normalize_or_zero())
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
                self.at_vertex(self.vertex_normal(i, first), first)
            }
            Rate::Pixel | Rate::Method(_) | Rate::Vertex | Rate::VertexUnclamped => {
                self.interpolated(i)
            }
        }
    }

    /// Returns the point at a pixel, with an interpolated normal.
    fn interpolated(&self, i: usize) -> Lightable {
        let mut sum = Lightable::default();
        let mut view = DVec3::ZERO;
        for &(v, weight) in self.hits.weights(i) {
            let own = self.at_vertex(self.vertex_normal(i, v), v);
            sum.point.normal += own.point.normal * weight;
            sum.point.position += own.point.position * weight;
            sum.colour += own.colour * weight;
            if self.shading.view_rate == ViewRate::Vertex {
                view += self.illumination.view_of_vertex(own.point.position) * weight;
            }
        }
        sum.point.at = sum.point.position;
        sum.point.view = (self.shading.view_rate == ViewRate::Vertex).then_some(view);
        sum
    }

    fn at_vertex(&self, normal: DVec3, vertex: u32) -> Lightable {
        let position = self.surface.positions[vertex as usize];
        Lightable {
            point: Point {
                normal,
                position,
                at: position,
                view: None,
            },
            colour: self.surface.colour(vertex),
        }
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
