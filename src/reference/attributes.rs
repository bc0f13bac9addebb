//! Colours and normals at the vertices, and their interpolation.

use super::coverage::{Crossing, Scanline, SpanPlace, VertexWeights};
use super::illumination::{Point, sum, wide};
use super::{ClosedForm, Model};
use crate::frame::{ClipCorner, Frame, Polygon};
use crate::scene::{Interpolation, Power};
use alloc::vec::Vec;
use glam::DVec3;

/// Below this angle a chord replaces the arc. They differ by at most φ²/8 = 1.3e-7, and sin φ is
/// then never a divisor of 0.
const STRAIGHT: f64 = 1e-3;

/// Above this angle, 179°, two normals do not determine a great circle.
const OPPOSITE: f64 = 179.0 / 180.0 * core::f64::consts::PI;

/// Interpolates linearly from `a` to `b`.
fn lerp(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    (1.0 - t) * a + t * b
}

/// Interpolates from `a` to `b`, both unit vectors, along the great circle:
/// ```text
/// slerp(N₁, N₂, t) = sin((1−t)φ)/sin(φ) N₁ + sin(tφ)/sin(φ) N₂      (L21 4.7)
/// ```
/// The angle φ is computed as 2 atan2(|N₁−N₂|, |N₁+N₂|), because the inverse cosine of L21 loses
/// half of the digits of a small angle. Close vectors are interpolated linearly. Between opposite
/// vectors the result is `face`.
fn slerp(a: DVec3, b: DVec3, t: f64, face: DVec3) -> DVec3 {
    let phi = 2.0 * libm::atan2((a - b).length(), (a + b).length()); // φ
    if phi < STRAIGHT {
        lerp(a, b, t)
    } else if phi > OPPOSITE {
        face
    } else {
        (libm::sin((1.0 - t) * phi) * a + libm::sin(t * phi) * b) / libm::sin(phi) // 4.7
    }
}

/// Returns the unit vector along `n`, or zero if `n` is zero.
fn unit(n: DVec3) -> DVec3 {
    let length = n.length();
    if length > 0.0 {
        n / length
    } else {
        DVec3::ZERO
    }
}

/// The attributes that a model interpolates, at every vertex of a frame.
pub(crate) struct VertexAttributes<'a> {
    frame: &'a Frame,
    model: Model,
    power: Power,
    /// Colours (Gouraud) or normals (Phong, slerp). Empty for flat shading.
    values: Vec<DVec3>,
    /// True if a light or the eye is at a position.
    is_local: bool,
    /// Positions, if each pixel sees light and eye from its own position. Otherwise empty.
    positions: Vec<DVec3>,
    /// Vertex colours, if pixels are lit and a material is multiplied by them. Otherwise empty.
    colours: Vec<DVec3>,
}

impl<'a> VertexAttributes<'a> {
    /// Computes colours or normals at the vertices of `frame`, as `model` requires.
    ///
    /// A vertex that clipping made lies between two others, which clipping may have made, too. Its
    /// value is interpolated from theirs as the model interpolates. It is not lit by a normal of
    /// its own.
    pub fn new(frame: &'a Frame, ClosedForm { model, power }: ClosedForm) -> Self {
        let position = |vertex: u32| wide(frame.position(vertex));
        let normal = |vertex: u32| wide(frame.normal(vertex));
        let unclamped = |vertex: u32| {
            sum(
                &frame.lightings()[frame.material(vertex) as usize],
                power,
                Point {
                    normal: normal(vertex),
                    position: position(vertex),
                    colour: wide(frame.colour(vertex)),
                },
            )
        };
        let colour = |vertex: u32| unclamped(vertex).clamp(DVec3::ZERO, DVec3::ONE);
        let all = |of: &dyn Fn(u32) -> DVec3| -> Vec<DVec3> {
            (0..frame.vertices().len() as u32).map(of).collect()
        };
        let mut values: Vec<DVec3> = match model {
            Model::Flat | Model::FlatAverage => Vec::new(),
            Model::Gouraud => all(&colour),
            Model::GouraudSeparate => all(&unclamped),
            Model::Phong | Model::PhongConstant | Model::Slerp => all(&normal),
        };
        let is_local = frame.is_local();
        let is_followed = model == Model::Phong && is_local;
        let mut positions = if is_followed {
            all(&position)
        } else {
            Vec::new()
        };
        let is_lit_at_pixels = matches!(model, Model::Phong | Model::PhongConstant | Model::Slerp);
        let is_coloured =
            is_lit_at_pixels && (frame.lightings().iter()).any(|lighting| lighting.vertex_colours);
        let mut colours = if is_coloured {
            all(&|vertex| wide(frame.colour(vertex)))
        } else {
            Vec::new()
        };
        for &ClipCorner {
            vertex,
            a,
            b,
            t,
            face,
        } in frame.clip_corners()
        {
            let (to, a, b, t) = (vertex as usize, a as usize, b as usize, f64::from(t));
            if !values.is_empty() {
                let (a, b) = (values[a], values[b]);
                values[to] = if model == Model::Slerp {
                    slerp(a, b, t, wide(face))
                } else {
                    lerp(a, b, t)
                };
            }
            if is_followed {
                positions[to] = lerp(positions[a], positions[b], t);
            }
            if is_coloured {
                colours[to] = lerp(colours[a], colours[b], t);
            }
        }
        VertexAttributes {
            frame,
            model,
            power,
            values,
            is_local,
            positions,
            colours,
        }
    }

    /// Returns the light at pixel `x` on a scanline of `polygon`, not clamped to 0..=1 yet. Returns
    /// `None` if the polygon does not cover the pixel.
    pub fn light(&self, polygon: &Polygon, scanline: &Scanline, x: usize) -> Option<DVec3> {
        let lighting = &self.frame.lightings()[polygon.material as usize];
        let mean = || self.frame.mean(polygon);
        // With all lights and the eye at infinity the position does not matter.
        let place = || {
            if self.is_local {
                wide(mean().position)
            } else {
                DVec3::ZERO
            }
        };
        let at_mean = |normal: DVec3, colour: DVec3| {
            let point = Point {
                normal,
                position: place(),
                colour,
            };
            sum(lighting, self.power, point)
        };
        Some(match self.model {
            Model::Flat => {
                scanline.edges(x)?;
                at_mean(
                    wide(self.frame.polygon_normal(polygon)),
                    wide(mean().colour),
                )
            }
            Model::FlatAverage => {
                scanline.edges(x)?;
                at_mean(unit(wide(mean().normal)), wide(mean().colour))
            }
            // Gouraud's values were clamped at the vertices.
            Model::Gouraud | Model::GouraudSeparate => {
                self.interpolated(&self.values, &scanline.weights(x)?)
            }
            Model::Phong => {
                let weights = scanline.weights(x)?;
                let position = if self.positions.is_empty() {
                    DVec3::ZERO
                } else {
                    self.interpolated(&self.positions, &weights)
                };
                let point = Point {
                    normal: unit(self.interpolated(&self.values, &weights)),
                    position,
                    colour: self.colour(&weights),
                };
                sum(lighting, self.power, point)
            }
            Model::PhongConstant => {
                let weights = scanline.weights(x)?;
                let normal = unit(self.interpolated(&self.values, &weights));
                at_mean(normal, self.colour(&weights))
            }
            Model::Slerp => {
                let place = scanline.place(x)?;
                let normal = self.slerped(&place, wide(self.frame.polygon_normal(polygon)));
                // Slerp ignores depth, so colours are linear on the screen, too.
                let colour = if self.colours.is_empty() {
                    DVec3::ONE
                } else {
                    scanline.weights(x)?.sum(|v| self.colours[v])
                };
                at_mean(normal, colour)
            }
        })
    }

    /// Returns the vertex colour between the corners, or white if no material reads it.
    fn colour(&self, weights: &VertexWeights) -> DVec3 {
        if self.colours.is_empty() {
            DVec3::ONE
        } else {
            self.interpolated(&self.colours, weights)
        }
    }

    /// Blends the corners' values linearly on the screen, or linearly in space. In perspective
    /// interpolation, value/w and 1/w are linear on the screen.
    fn interpolated(&self, values: &[DVec3], weights: &VertexWeights) -> DVec3 {
        match self.frame.interpolation() {
            Interpolation::Screen => weights.sum(|v| values[v]),
            Interpolation::Perspective => {
                let inv_w = |v: usize| self.frame.vertices()[v].inv_w;
                weights.sum(|v| values[v] * inv_w(v)) / weights.sum(inv_w)
            }
        }
    }

    /// Interpolates by slerp along both edges, then along the span between them (L21 4.4).
    fn slerped(&self, place: &SpanPlace, face: DVec3) -> DVec3 {
        let on_edge = |edge: &Crossing| {
            slerp(
                self.values[edge.top as usize],
                self.values[edge.bottom as usize],
                edge.t(),
                face,
            )
        };
        slerp(on_edge(&place.left), on_edge(&place.right), place.u, face)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slerp_turns_at_a_uniform_rate() {
        for k in 0..=18 {
            let angle = f64::from(k) * 5.0f64.to_radians();
            let n = slerp(DVec3::X, DVec3::Y, f64::from(k) / 18.0, DVec3::Z);
            // φ = π/2 and each sine are rounded a few times, and all values are at most 1. So 4 ε
            // is ample, and 1° is 8e13 times more.
            assert!(
                (n - DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)).length()
                    < 4.0 * f64::EPSILON,
                "{k}: {n}"
            );
        }
    }

    #[test]
    fn slerp_of_close_vectors_is_the_chord() {
        let near = DVec3::new(0.0, libm::sin(9e-4), libm::cos(9e-4));
        assert_eq!(
            slerp(DVec3::Z, near, 0.25, DVec3::X),
            lerp(DVec3::Z, near, 0.25)
        );
        assert_eq!(
            slerp(DVec3::Z, DVec3::Z, 0.7, DVec3::X),
            lerp(DVec3::Z, DVec3::Z, 0.7)
        );
        let apart = DVec3::new(0.0, libm::sin(1.1e-3), libm::cos(1.1e-3));
        assert_ne!(
            slerp(DVec3::Z, apart, 0.25, DVec3::X),
            lerp(DVec3::Z, apart, 0.25)
        );
    }

    #[test]
    fn slerp_of_opposite_vectors_is_the_face_normal() {
        let at = |degrees: f64| {
            DVec3::new(
                libm::sin(degrees.to_radians()),
                0.0,
                libm::cos(degrees.to_radians()),
            )
        };
        for t in [0.0, 0.3, 1.0] {
            assert_eq!(slerp(DVec3::Z, at(180.0), t, DVec3::Y), DVec3::Y);
            assert_eq!(slerp(DVec3::Z, at(179.1), t, DVec3::Y), DVec3::Y);
        }
        // sin 178.9° = 0.019 divides errors of a few ε.
        assert!((slerp(DVec3::Z, at(178.9), 0.5, DVec3::Y) - at(89.45)).length() < 1e-13);
    }

    #[test]
    fn the_zero_vector_has_no_direction() {
        assert_eq!(unit(DVec3::ZERO), DVec3::ZERO);
        assert_eq!(unit(DVec3::new(0.0, 3.0, 4.0)), DVec3::new(0.0, 0.6, 0.8));
    }
}
