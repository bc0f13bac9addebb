//! The weights of polygons in the average at a vertex, and weighted sums.

use super::super::PolygonMesh;
use super::super::fans::FanCorner;
use super::NO_NORMAL;
use super::arc::angle;
use crate::number::parallel::collect;
use alloc::vec::Vec;
use core::f64::consts::TAU;
use glam::{DVec3, Vec3};

/// The weight of a polygon's normal in the average at a vertex.
///
/// `θ` is the interior angle of the polygon at the vertex (over 180° at a reflex corner), and `e₁`
/// and `e₂` are its edges there. If a polygon is not flat, each of its corners counts with its own
/// normal, perpendicular to `e₁` and `e₂`; only the uniform weight uses the polygon's normal at all
/// corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NormalWeight {
    /// 1: every polygon counts equally, with Newell's normal (L21 3.1).
    #[default]
    Uniform,
    /// The area of the polygon.
    Area,
    /// `θ` (Thürmer and Wüthrich, *Computing vertex normals from polygonal facets*, 1998). Cutting
    /// a flat polygon into others does not change the average.
    Angle,
    /// `sin θ / (|e₁| |e₂|)` (Max, *Weights for computing vertex normals from facet normals*,
    /// 1999). It is exact on a sphere.
    Max,
}

impl NormalWeight {
    /// Returns how a sentence about averaged normals goes on: ` by area`.
    pub fn by_text(self) -> &'static str {
        match self {
            NormalWeight::Uniform => "",
            NormalWeight::Area => " by area",
            NormalWeight::Angle => " by angle",
            NormalWeight::Max => " by Max's weights",
        }
    }
}

/// The weights of corners of a mesh.
#[derive(Clone, Copy)]
pub(in crate::mesh) struct Weights<'a> {
    pub mesh: &'a PolygonMesh,
    /// Newell's normals; their length is twice the area.
    pub polygons: &'a [DVec3],
    /// Their unit vectors; zero for a polygon without a normal.
    pub normals: &'a [DVec3],
    /// The result of [`of_triangles`].
    pub triangles: &'a [[f64; 3]],
    pub weight: NormalWeight,
}

/// A corner's term in a sum.
#[derive(Clone, Copy)]
pub(in crate::mesh) struct Term {
    /// The unit normal of the polygon, which creases compare.
    pub polygon: DVec3,
    /// The unit normal of the corner times the weight, which the sum adds.
    pub vector: DVec3,
    pub weight: f64,
}

impl<'a> Weights<'a> {
    /// Returns these corners with uniform weights.
    pub fn uniform(self) -> Self {
        let weight = NormalWeight::Uniform;
        Weights { weight, ..self }
    }

    /// True if a polygon counts once at a vertex, however often it passes the vertex.
    #[inline(always)]
    pub fn is_by_polygon(&self) -> bool {
        matches!(self.weight, NormalWeight::Uniform | NormalWeight::Area)
    }

    /// Returns the term of a corner. `None` if its polygon has no normal, or if the corner repeats
    /// the position of the previous one, whose term then stands for both.
    #[inline(always)]
    pub fn term(&self, corner: &FanCorner) -> Option<Term> {
        let p = corner.polygon as usize;
        let normal = self.normals[p];
        if normal == DVec3::ZERO {
            return None;
        }
        let (vector, weight) = match self.weight {
            NormalWeight::Uniform => (normal, 1.0),
            _ => self.of_corner(corner, normal)?,
        };
        Some(Term {
            polygon: normal,
            vector,
            weight,
        })
    }

    /// Returns the weighted normal and the weight of a corner. All corners of a triangle have the
    /// triangle's normal. `None` if the corner repeats the position of the previous one.
    #[inline(always)]
    fn of_corner(&self, corner: &FanCorner, normal: DVec3) -> Option<(DVec3, f64)> {
        let p = corner.polygon as usize;
        let range = self.mesh.corner_range(p);
        if range.len() != 3 {
            return self.of_polygon(corner, normal);
        }
        let weight = self.triangles[p][corner.corner as usize - range.start];
        Some((normal * weight, weight))
    }

    /// Returns the weighted normal and the weight of a corner as `of_corner` does, for a polygon of
    /// any shape.
    #[inline(never)]
    fn of_polygon(&self, corner: &FanCorner, normal: DVec3) -> Option<(DVec3, f64)> {
        let p = corner.polygon as usize;
        let [next, last] = self.edges(corner)?;
        let lengths = libm::sqrt(next.length_squared() * last.length_squared());
        let cross = next.cross(last) / lengths;
        // At a reflex corner the edges turn against the polygon's own winding.
        let is_reflex = cross.dot(normal) < 0.0;
        let (sine, cosine) = (libm::sqrt(cross.length_squared()), next.dot(last) / lengths);
        let weight = match self.weight {
            NormalWeight::Area => self.polygons[p].dot(normal),
            NormalWeight::Angle if is_reflex => TAU - angle(sine, cosine),
            NormalWeight::Angle => angle(sine, cosine),
            NormalWeight::Uniform | NormalWeight::Max => sine / lengths,
        };
        let cross = if is_reflex { -cross } else { cross };
        Some((corner_normal(cross, sine, normal) * weight, weight))
    }

    /// Returns the edges from a corner to the next one and to the previous one. Next corners at
    /// this corner's own position are skipped. `None` if the previous corner is at this position.
    fn edges(&self, corner: &FanCorner) -> Option<[DVec3; 2]> {
        let range = self.mesh.corner_range(corner.polygon as usize);
        let (count, here) = (range.len(), corner.corner as usize - range.start);
        let edge = |k: usize| {
            let to = self.position(range.start + (here + k) % count);
            to - self.position(corner.corner as usize)
        };
        let last = edge(count - 1);
        let next = (1..count).map(edge).find(|edge| *edge != DVec3::ZERO);
        next.filter(|_| last != DVec3::ZERO)
            .map(|next| [next, last])
    }

    fn position(&self, corner: usize) -> DVec3 {
        self.mesh.positions()[self.mesh.corners()[corner] as usize].as_dvec3()
    }

    /// Returns the sum over the corners of `fan`. If all of them have weight 0, they count equally.
    pub fn sum(&self, fan: &[FanCorner]) -> Sum {
        // The weight is a constant in each of these inlined calls, so that each gets its own loop
        // without a choice inside.
        let sum = match self.weight {
            NormalWeight::Uniform => self.sum_by(NormalWeight::Uniform, fan),
            NormalWeight::Area => self.sum_by(NormalWeight::Area, fan),
            NormalWeight::Angle => self.sum_by(NormalWeight::Angle, fan),
            NormalWeight::Max => self.sum_by(NormalWeight::Max, fan),
        };
        match sum.is_without_weight() {
            true => self.sum_by(NormalWeight::Uniform, fan),
            false => sum,
        }
    }

    #[inline(always)]
    fn sum_by(&self, weight: NormalWeight, fan: &[FanCorner]) -> Sum {
        let (own, mut sum) = (Weights { weight, ..*self }, Sum::new(weight));
        fan.iter().for_each(|corner| sum.add(corner, &own));
        sum
    }
}

/// Returns the weights of each triangle's corners, and zeros for other polygons. The list is empty
/// under uniform weights.
pub(super) fn of_triangles(
    mesh: &PolygonMesh,
    polygons: &[DVec3],
    weight: NormalWeight,
) -> Vec<[f64; 3]> {
    let of = |p: usize| match <[u32; 3]>::try_from(mesh.polygon(p)) {
        Ok(corners) => {
            let corners = corners.map(|c| mesh.positions()[c as usize].as_dvec3());
            of_triangle(corners, polygons[p], weight)
        }
        Err(_) => [0.0; 3],
    };
    match weight {
        NormalWeight::Uniform => Vec::new(),
        _ => collect(mesh.polygon_count(), 4096, of),
    }
}

/// Returns the weights of a triangle's corners. `e₁ × e₂` is equal at all of them: Newell's normal.
#[inline(always)]
fn of_triangle([a, b, c]: [DVec3; 3], normal: DVec3, weight: NormalWeight) -> [f64; 3] {
    let edges = [b - a, c - b, a - c];
    let squares = edges.map(|edge| edge.length_squared());
    let product = libm::sqrt(normal.length_squared());
    [(0, 2), (1, 0), (2, 1)].map(|(next, last)| match weight {
        NormalWeight::Uniform | NormalWeight::Area => product,
        NormalWeight::Angle => angle(product, -edges[next].dot(edges[last])),
        NormalWeight::Max => product / (squares[next] * squares[last]),
    })
}

/// Returns the unit normal of a corner. `cross` is the cross product of the unit vectors along its
/// edges, with length `sine`, and `polygon` is the unit normal of its polygon.
///
/// From 30° to 150° the result is the direction of `cross`. The sharper or flatter the corner, the
/// more of that direction is due to rounding, so the polygon's normal is mixed in; on a straight
/// line the result is the polygon's normal. The two are at most 90° apart, so their mixture is at
/// least 0.7 long.
fn corner_normal(cross: DVec3, sine: f64, polygon: DVec3) -> DVec3 {
    let part = 2.0 * sine;
    let mixed = match part < 1.0 {
        true => 2.0 * cross + (1.0 - part) * polygon,
        false => cross,
    };
    mixed / libm::sqrt(mixed.length_squared())
}

/// A weighted sum of normals over some corners at a vertex (L21 3.1, if the weights are 1).
#[derive(Clone, Copy, Default)]
pub(in crate::mesh) struct Sum {
    kind: NormalWeight,
    pub vector: DVec3,
    /// The sum of the weights.
    pub weight: f64,
    pub count: u32,
    /// The polygon that was added last, counted from 1, so that a polygon that passes twice counts
    /// once. The corners of one polygon stand next to each other.
    latest: u32,
}

impl Sum {
    pub fn new(kind: NormalWeight) -> Self {
        Sum {
            kind,
            ..Sum::default()
        }
    }

    #[inline(always)]
    pub fn add(&mut self, corner: &FanCorner, weights: &Weights) {
        let latest = corner.polygon + 1;
        if let Some(term) = weights.term(corner)
            && !(weights.is_by_polygon() && self.latest == latest)
        {
            self.latest = latest;
            self.add_term(&term);
        }
    }

    #[inline(always)]
    pub fn add_term(&mut self, term: &Term) {
        self.vector += term.vector; // 3.1
        self.weight += term.weight;
        self.count += 1;
    }

    pub fn add_sum(&mut self, other: &Sum) {
        self.vector += other.vector;
        self.weight += other.weight;
        self.count += other.count;
    }

    /// True if corners were added and all of them have weight 0.
    pub fn is_without_weight(&self) -> bool {
        self.count > 0 && self.weight == 0.0
    }

    /// Returns the direction of the sum, or [`NO_NORMAL`] if nothing was added. `None` if the sum
    /// vanishes.
    pub fn average(&self) -> Option<Vec3> {
        let average = match self.count {
            0 => Some(NO_NORMAL),
            _ => self.direction(),
        };
        average.map(|normal| normal.as_vec3())
    }

    /// Returns the direction of the sum; `None` if the sum vanishes.
    ///
    /// A sum vanishes if it is no longer than its rounding error can be. The bound has these parts:
    ///
    /// - A unit normal is off by at most 4ε: two roundings of its components, the root and the
    ///   division.
    /// - A weight is off by less than 8ε of itself. An area is off by 2 + 4 (a cross product times
    ///   the unit normal). An angle is off by 5: `|e₁ × e₂|` and `e₁ · e₂` are off by 2ε and 1.5ε
    ///   of `|e₁| |e₂|`, which turns the angle by 2.5ε. From half a radian on that is at most 5ε of
    ///   the angle; below, the sine decides, with 2, and the arc tangent adds 2. Max's weight is
    ///   off by 6: two squares of lengths, 1.5 each, and half of that through their root; the sine
    ///   2, divisions 1.
    /// - The mixture of [`corner_normal`] is off by 3 and at least 0.7 long, so by less than 5, and
    ///   its own root and division add 1.
    /// - In a triangle the length of the normal replaces the length of `e₁ × e₂` at all corners;
    ///   its squares and root add 1.25.
    /// - The product of weight and normal adds 1/2.
    ///
    /// So a term is off by less than 4ε of its weight `w = 1` if weights are uniform, and by less
    /// than 16ε of any other weight. Each addition is off by at most ε times the partial sum, which
    /// is no longer than the sum `W` of all weights. A sum of n terms that is zero in exact
    /// arithmetic therefore stays below `W · (4 + n) · ε`, or `W · (16 + n) · ε`. Slivers may be
    /// off by more: their edges are nearly parallel, so the cross product cancels.
    pub fn direction(&self) -> Option<DVec3> {
        let of_term = match self.kind {
            NormalWeight::Uniform => 4.0,
            NormalWeight::Area | NormalWeight::Angle | NormalWeight::Max => 16.0,
        };
        let length = libm::sqrt(self.vector.length_squared());
        let bound = self.weight * (of_term + f64::from(self.count)) * f64::EPSILON;
        (length > bound).then(|| self.vector / length)
    }
}
