//! Ranges of light over a polygon: how much the vectors toward lights and eye vary. Error bounds
//! need them.

use crate::frame::{Frame, Polygon};
use crate::scene::{Lighting, Place};
use crate::shading::bounds::polygon_ranges::{for_each_end, range, wide};
use crate::shading::light::strength;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// The spread of the vectors toward lights and eye on all polygons of a frame.
///
/// A polygon, clipped or not, lies in the smallest ball around the middle of its corners that holds
/// them. Seen from points of a ball of radius ρ at the distance r, a place is between r − ρ and r +
/// ρ away, in directions within sin⁻¹(ρ/r) of the direction from the ball's middle. The place is
/// also no nearer than the least of its distances from the planes through the corners that are
/// parallel to the polygon, if all of them are on one side of it, because a linear function has its
/// least value at a corner. So a light above the middle of a large polygon is as near as it is
/// high.
pub(crate) struct Spread {
    /// The spread on each polygon; empty if all lights and the eye are at infinity.
    polygons: Vec<PolygonSpread>,
    /// The lights as seen from each material.
    pub materials: Vec<SeenLights>,
}

/// The spread of the vectors toward lights and eye on one polygon.
#[derive(Clone, Copy)]
pub(crate) struct PolygonSpread {
    /// The longest vector over the shortest, 1 or more. Coordinates from which a vector is computed
    /// count as long vectors.
    pub vectors: f64,
    /// The largest distance between two points of the polygon over the longest vector.
    pub apart: f64,
}

impl PolygonSpread {
    const NONE: PolygonSpread = PolygonSpread {
        vectors: 1.0,
        apart: 0.0,
    };

    fn add(&mut self, place: &SeenPlace) {
        self.vectors = self.vectors.max(place.spread);
        self.apart = self.apart.max(place.apart);
    }
}

/// The lights as seen from the polygons of a material.
pub(crate) struct SeenLights {
    /// The greatest strength of each light.
    pub strengths: Vec<f64>,
    /// The least |L + V| of unit vectors, greater than 0.
    pub half: f64,
}

impl Spread {
    pub fn of(frame: &Frame) -> Spread {
        let unseen = |lighting: &Lighting| SeenLights {
            strengths: vec![0.0; lighting.lights.len()],
            // The greatest |L + V|, which `add` lowers.
            half: 2.0,
        };
        let mut spread = Spread {
            polygons: Vec::new(),
            materials: frame.lightings().iter().map(unseen).collect(),
        };
        if frame.is_local() {
            for polygon in frame.polygons() {
                let here = spread.add(frame, polygon.material, &Ball::around(frame, polygon));
                spread.polygons.push(here);
            }
        } else {
            // All points see lights and eye in the same directions.
            for material in 0..frame.lightings().len() as u32 {
                spread.add(frame, material, &Ball::default());
            }
        }
        spread
    }

    /// Returns the spread on the polygon with this index.
    pub fn on(&self, polygon: usize) -> PolygonSpread {
        let all = self.polygons.get(polygon);
        all.copied().unwrap_or(PolygonSpread::NONE)
    }

    /// Extends a material's lights to those seen from the points of a ball. Returns the spread
    /// there.
    fn add(&mut self, frame: &Frame, material: u32, ball: &Ball) -> PolygonSpread {
        let lighting = &frame.lightings()[material as usize];
        let seen = &mut self.materials[material as usize];
        let view = ball.sees(lighting.view);
        let mut here = PolygonSpread::NONE;
        here.add(&view);
        for (light, greatest) in lighting.lights.iter().zip(&mut seen.strengths) {
            let to = ball.sees(light.place);
            here.add(&to);
            let square = (to.nearest * to.nearest) as f32;
            let strength = match light.place {
                Place::Local(_) => strength(light.falloff, square, 1.0),
                Place::Infinite(_) => None,
            };
            *greatest = greatest.max(strength.map_or(1.0, f64::from));
            // |l + v| = 2 cos(θ/2) for unit vectors at the angle θ.
            let angle = libm::acos(to.direction.dot(view.direction).clamp(-1.0, 1.0));
            let widest = (angle + to.angle + view.angle).min(core::f64::consts::PI);
            // Below 1e-9 the bound exceeds 1 with any light, so it says nothing.
            seen.half = seen.half.min(2.0 * libm::cos(widest / 2.0)).max(1e-9);
        }
        here
    }
}

/// A ball that contains a polygon, and the polygon's corners.
#[derive(Default)]
struct Ball {
    corners: Vec<DVec3>,
    normal: DVec3,
    middle: DVec3,
    radius: f64,
    /// The largest distance of a corner from the origin, because errors grow with coordinates that
    /// are subtracted.
    reach: f64,
}

/// A place as seen from the points of a ball.
struct SeenPlace {
    spread: f64,
    apart: f64,
    nearest: f64,
    /// The direction from the middle of the ball.
    direction: DVec3,
    /// The largest angle between that direction and the direction from another point of the ball.
    angle: f64,
}

impl Ball {
    fn around(frame: &Frame, polygon: &Polygon) -> Ball {
        let mut corners: Vec<DVec3> = Vec::new();
        for_each_end(frame, frame.corners(polygon), &mut |v| {
            corners.push(wide(frame.position(v)))
        });
        // Methods that light a polygon as seen from one point use the mean of the whole polygon, of
        // which this may be a piece.
        corners.push(wide(frame.mean(polygon).position));
        let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let most = |of: &dyn Fn(DVec3) -> f64| corners.iter().map(|p| of(*p)).fold(0.0, f64::max);
        Ball {
            normal: wide(frame.polygon_normal(polygon)).normalize_or_zero(),
            middle,
            radius: most(&|p| p.distance(middle)),
            reach: most(&|p| p.length()),
            corners,
        }
    }

    fn sees(&self, place: Place<[f32; 3]>) -> SeenPlace {
        let position = match place {
            Place::Infinite(direction) => {
                return SeenPlace {
                    spread: 1.0,
                    apart: 0.0,
                    nearest: f64::INFINITY,
                    direction: wide(direction),
                    angle: 0.0,
                };
            }
            Place::Local(position) => wide(position),
        };
        let toward = position - self.middle;
        let far = toward.length();
        // A place before or behind all corners is at least as far as its distance along the normal.
        let corners = self.corners.iter();
        let (low, high) = range(corners.map(|p| (position - p).dot(self.normal)));
        // Otherwise no bound is known inside the ball. Use the smallest distance that methods
        // distinguish from 0.
        let nearest = (far - self.radius).max(low).max(-high).max(1e-15);
        let longest = (far + self.radius).max(position.length() + self.reach);
        SeenPlace {
            spread: longest / nearest,
            apart: 2.0 * self.radius / longest,
            nearest,
            direction: toward.normalize_or_zero(),
            // From inside the ball the place is seen in any direction.
            angle: if far > self.radius {
                libm::asin(self.radius / far)
            } else {
                core::f64::consts::PI
            },
        }
    }
}
