//! How much the vectors toward lights and eye vary over the polygons of a frame: what bounds of rounding errors need.

use super::lighting::strength;
use crate::frame::{Frame, Polygon};
use crate::scene::{LightTerm, Lighting, Place};
use alloc::vec::Vec;
use glam::DVec3;

/// How unequal vectors toward places are.
///
/// A polygon, whatever of it is seen, lies in the smallest ball around the middle of its corners that holds them. From
/// points of a ball of radius ρ at the distance r a place is between r − ρ and r + ρ away, in directions within
/// sin⁻¹(ρ/r) of that from its middle. Nor is a place nearer than the least of its distances from the planes through the
/// corners that are parallel to the polygon, if all are on one side of it: a linear function has its least value at a
/// corner. So a light above the middle of a large polygon is as near as it is high.
pub(super) struct Spread {
    /// The longest over the shortest, the coordinates that they are differences of counted as long: 1 or more.
    pub vectors: f64,
    /// The largest weight of perspective over the smallest in one polygon.
    pub weights: f64,
    /// The lights as each material sees them.
    pub materials: Vec<Seen>,
}

/// The lights as the polygons of a material see them.
pub(super) struct Seen {
    /// The greatest strength of each light.
    pub strengths: Vec<f64>,
    /// The least |L + V| of unit vectors, over 0.
    pub half: f64,
}

impl Seen {
    /// Makes what directional lights look like, and positional ones before any polygon is there to see them.
    fn new(lighting: &Lighting) -> Seen {
        let strength = |light: &LightTerm| if light.place.is_local() { 0.0 } else { 1.0 };
        let mut half: f64 = 2.0;
        if let Place::Infinite(view) = lighting.view {
            for light in &lighting.lights {
                if let Place::Infinite(direction) = light.place {
                    half = half.min((wide(direction) + wide(view)).length());
                }
            }
        }
        Seen {
            strengths: lighting.lights.iter().map(strength).collect(),
            half,
        }
    }
}

impl Spread {
    pub fn of(frame: &Frame) -> Spread {
        let mut spread = Spread {
            vectors: 1.0,
            weights: 1.0,
            materials: frame.lightings().iter().map(Seen::new).collect(),
        };
        let is_local = frame.is_local();
        for polygon in frame.polygons() {
            let corners = frame.corners(polygon).iter();
            let weights = corners.map(|&v| f64::from(frame.vertices()[v as usize].inv_w));
            let (least, most) = range(weights);
            spread.weights = f64::max(spread.weights, most / least);
            if is_local {
                let lighting = &frame.lightings()[polygon.material as usize];
                spread.add(polygon, lighting, &Ball::around(frame, polygon));
            }
        }
        for seen in &mut spread.materials {
            // Below this the bound is over 1 whatever the light: no bound at all.
            seen.half = seen.half.max(1e-9);
        }
        spread
    }

    fn add(&mut self, polygon: &Polygon, lighting: &Lighting, ball: &Ball) {
        let seen = &mut self.materials[polygon.material as usize];
        let view = ball.sees(lighting.view);
        self.vectors = self.vectors.max(view.spread);
        for (light, greatest) in lighting.lights.iter().zip(&mut seen.strengths) {
            let sight = ball.sees(light.place);
            self.vectors = self.vectors.max(sight.spread);
            let square = (sight.nearest * sight.nearest) as f32;
            let strength = strength(light.place.is_local(), light.falloff, square, 1.0);
            *greatest = greatest.max(strength.map_or(1.0, f64::from));
            // |l + v| = 2 cos(θ/2) for unit vectors at the angle θ.
            let between = libm::acos(sight.direction.dot(view.direction).clamp(-1.0, 1.0))
                + sight.angle
                + view.angle;
            let half = 2.0 * libm::cos(between.min(core::f64::consts::PI) / 2.0);
            seen.half = seen.half.min(half);
        }
    }
}

/// Returns the least and the greatest number.
fn range(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// A ball that holds a polygon, and its corners.
struct Ball {
    corners: Vec<DVec3>,
    normal: DVec3,
    middle: DVec3,
    radius: f64,
    /// The largest distance of a corner from the origin: as long as what is subtracted.
    reach: f64,
}

/// A place as the points of a ball see it.
struct Sight {
    spread: f64,
    nearest: f64,
    /// From the middle of the ball.
    direction: DVec3,
    /// By how much directions from other points differ at most.
    angle: f64,
}

impl Ball {
    fn around(frame: &Frame, polygon: &Polygon) -> Ball {
        let mut ends: Vec<u32> = frame.corners(polygon).to_vec();
        // What clipping made lies between its ends, which lie between theirs.
        while let Some(i) = ends.iter().position(|&v| clip_corner(frame, v).is_some()) {
            if let Some((a, b)) = clip_corner(frame, ends[i]) {
                ends[i] = a;
                ends.push(b);
            }
        }
        let corners: Vec<DVec3> = ends.iter().map(|&v| wide(frame.position(v))).collect();
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let most = |of: &dyn Fn(DVec3) -> f64| corners.iter().map(|p| of(*p)).fold(0.0, f64::max);
        let (radius, reach) = (most(&|p| p.distance(middle)), most(&|p| p.length()));
        Ball {
            normal: wide(frame.polygon_normal(polygon)).normalize_or_zero(),
            middle,
            radius,
            reach,
            corners,
        }
    }

    fn sees(&self, place: Place<[f32; 3]>) -> Sight {
        let position = match place {
            Place::Infinite(direction) => {
                return Sight {
                    spread: 1.0,
                    nearest: f64::INFINITY,
                    direction: wide(direction),
                    angle: 0.0,
                };
            }
            Place::Local(position) => wide(position),
        };
        let toward = position - self.middle;
        let far = toward.length();
        // Inside the ball no bound is known: the smallest distance that the methods tell from 0.
        let corners = self.corners.iter();
        let (low, high) = range(corners.map(|p| (position - p).dot(self.normal)));
        let nearest = (far - self.radius).max(low).max(-high).max(1e-15);
        let longest = (far + self.radius).max(position.length() + self.reach);
        // From inside the ball it is seen in any direction.
        let angle = if far > self.radius {
            libm::asin(self.radius / far)
        } else {
            core::f64::consts::PI
        };
        Sight {
            spread: longest / nearest,
            nearest,
            direction: toward.normalize_or_zero(),
            angle,
        }
    }
}

/// The ends of the edge on which clipping made a vertex.
fn clip_corner(frame: &Frame, vertex: u32) -> Option<(u32, u32)> {
    let all = frame.clip_corners();
    let place = all
        .binary_search_by_key(&vertex, |corner| corner.vertex)
        .ok()?;
    Some((all[place].a, all[place].b))
}
