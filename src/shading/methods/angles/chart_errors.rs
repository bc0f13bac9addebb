//! Charts of the sphere of normals in the frame of the eye, and how far the normals that they
//! interpolate are from Phong's.
//!
//! A chart maps the sphere to a plane. A method interpolates there and maps back. All bounds are
//! bounds of the angle between the method's normal n and Phong's, P/|P| with P = Σ b_i N_i, for any
//! weights b_i ≥ 0 of any count of corners. As in [`Extent`], |P| ≥ c for the least cosine c of the
//! N_i with their mean direction.

use crate::frame::{Frame, Polygon};
use crate::scene::Place;
use crate::shading::Approximation;
use crate::shading::bounds::polygon_ranges::{Extent, for_each_end, wide};
use alloc::vec::Vec;
use core::f64::consts::{FRAC_PI_2, PI};
use glam::DVec3;

/// The normals of a polygon in the frame of its eye.
pub(crate) struct FromEye {
    /// The unit normals of the corners, with z toward the eye. A corner that clipping made is
    /// replaced by the ends of the edge that was cut.
    normals: Vec<DVec3>,
    /// The least cosine of a normal with the mean direction of all: no mean of the normals is
    /// shorter.
    least_length: f64,
}

/// The charts of [`FromEye::angle`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Chart {
    /// Points u = (N_x, N_y)/(1 + N_z), interpolated.
    Stereographic,
    /// Unit vectors half-way between normal and eye, interpolated.
    HalfVectors,
}

impl FromEye {
    pub fn of(frame: &Frame, polygon: &Polygon) -> FromEye {
        let view = match frame.lightings()[polygon.material as usize].view {
            Place::Infinite(toward) => wide(toward),
            Place::Local(place) => wide(place) - wide(frame.mean(polygon).position),
        };
        let mut normals = Vec::new();
        for_each_end(frame, frame.corners(polygon), &mut |v| {
            normals.push(wide(frame.normal(v)));
        });
        FromEye::new(&normals, view, Extent::of(frame, polygon).cosine)
    }

    fn new(normals: &[DVec3], view: DVec3, least_length: f64) -> FromEye {
        let z = view.normalize_or(DVec3::Z);
        let (x, y) = z.any_orthonormal_pair();
        let turned = |n: &DVec3| DVec3::new(n.dot(x), n.dot(y), n.dot(z)).normalize_or_zero();
        FromEye {
            normals: normals.iter().map(turned).collect(),
            least_length,
        }
    }

    /// Returns a bound of the angle between the normal of a chart and Phong's, in radians; π where
    /// no bound is known.
    ///
    /// Let u_i = (x, y)/(1 + z) be the stereographic points of the corners, and g the map back.
    /// Both charts return n = g(a) with a = Σ b'_i u_i. For the stereographic chart b' = b. Half
    /// vectors are (u_i, 1) √κ_i with κ = 1/(1 + |u|²) = (1 + z)/2, so b'_i = b_i √κ_i / Σ. Turn
    /// the sphere so that n is at the eye. With d_i = u_i − a as complex numbers, N_i then has the
    /// point w_i = d_i/(1 + ā u_i), and its part across n is
    ///
    /// ```text
    /// 2 w/(1 + |w|²) = 2 κ_i (d_i + a |d_i|²/(1 + |a|²))
    /// ```
    ///
    /// The sum of these parts with weights b_i is |P| times the sine of the angle. In the first
    /// term, Σ b'_i d_i = 0 leaves the differences of κ_i (or √κ_i) from any constant, at most half
    /// of their range. In the second, 2 |a|/(1 + |a|²) ≤ σ, the sine of the largest angle between a
    /// normal and the eye. With all u_i within R of one point, the mean of |d_i|² is at most R²,
    /// and that of |d_i| at most R:
    ///
    /// ```text
    /// c sin ≤ (κ_max − κ_min) R + σ κ_max R²              stereographic
    /// c sin ≤ (√κ_max − √κ_min) √κ_max R + σ κ_max R²     half vectors
    /// ```
    ///
    /// The angle is below 90° where n·N_i = 1 − 2 |d_i|² κ_i κ(a) > 0 for all i: there |d_i| ≤ 2 R,
    /// and no κ exceeds the κ of the point nearest the eye.
    pub fn angle(&self, chart: Chart) -> f64 {
        let drawn = |n: &DVec3| n.truncate() / (1.0 + n.z);
        let points: Vec<_> = self.normals.iter().map(drawn).collect();
        let middle = points.iter().sum::<glam::DVec2>() / points.len() as f64;
        let most = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, f64::max);
        let radius = most(&mut points.iter().map(|u| u.distance(middle)));
        let nearest = f64::max(middle.length() - radius, 0.0);
        let furthest = most(&mut points.iter().map(|u| u.length()));
        let kappa = |u: f64| 1.0 / (1.0 + u * u);
        let least = kappa(furthest);
        let highest = self.normals.iter().map(|n| n.z).fold(-1.0, f64::max);
        let greatest = (1.0 + highest) / 2.0;
        // A normal opposite to the eye has no point.
        let is_small = middle.is_finite() && 8.0 * libm::pow(radius * kappa(nearest), 2.0) < 1.0;
        if !(is_small && self.least_length > 0.0) {
            return PI;
        }
        let tilt = if furthest < 1.0 {
            2.0 * furthest * least
        } else {
            1.0
        };
        let range = match chart {
            Chart::Stereographic => greatest - least,
            Chart::HalfVectors => (libm::sqrt(greatest) - libm::sqrt(least)) * libm::sqrt(greatest),
        };
        let sine = (range * radius + tilt * greatest * radius * radius) / self.least_length;
        libm::asin(sine.min(1.0))
    }

    /// Returns a bound of the angle between the normal of a map and Phong's, in radians. A map is
    /// an orthographic chart: it interpolates x and y, which equal those of P up to an error of
    /// `rounding`.
    ///
    /// Both normals lean from the eye in the same direction: Phong's by θ with sin θ = r/|P|, the
    /// map's by sin⁻¹ r = sin⁻¹(|P| sin θ). The difference grows with θ and with 1/|P|, so it is at
    /// most
    ///
    /// ```text
    /// Θ − sin⁻¹(c sin Θ),     cos Θ = min z_i, or min z_i / c where that is negative
    /// ```
    ///
    /// as P_z ≥ min z_i. Where r is near 1, a rounding e moves the map's normal by cos⁻¹(1 − e).
    pub fn angle_of_map(&self, rounding: f64) -> f64 {
        let c = self.least_length;
        let lowest = self.normals.iter().map(|n| n.z).fold(1.0, f64::min);
        let lowest = if lowest < 0.0 { lowest / c } else { lowest };
        if !(c > 0.0 && lowest > -1.0) {
            return PI;
        }
        let most = libm::acos(lowest);
        let sine = libm::sin(most);
        let leaning = libm::sin(most.min(FRAC_PI_2));
        let moved = if leaning + rounding < 1.0 {
            libm::asin(leaning + rounding) - libm::asin(leaning)
        } else {
            libm::acos(1.0 - rounding.min(1.0))
        };
        most - libm::asin(c * sine) + moved
    }
}

/// Returns the error of cosines of unit vectors that are at most this angle apart, in radians.
pub(crate) fn of_angle(angle: f64) -> Approximation {
    Approximation {
        cosine: 2.0 * libm::sin(angle.min(PI) / 2.0),
        ..Approximation::NONE
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    /// Returns the normal that a chart interpolates between normals with weights, z toward the eye.
    fn through(chart: Option<Chart>, normals: &[DVec3], weights: &[f64]) -> DVec3 {
        let sum = |of: &dyn Fn(&DVec3) -> DVec3| -> DVec3 {
            let terms = normals.iter().zip(weights);
            terms.map(|(n, weight)| *weight * of(n)).sum()
        };
        let reflected = |m: DVec3| 2.0 * m.z * m / m.length_squared() - DVec3::Z;
        match chart {
            None => {
                let p = sum(&|n| *n).truncate();
                p.extend((1.0 - p.length_squared()).max(0.0).sqrt())
            }
            Some(Chart::Stereographic) => reflected(sum(&|n| (*n + DVec3::Z) / (1.0 + n.z))),
            Some(Chart::HalfVectors) => reflected(sum(&|n| (*n + DVec3::Z).normalize())),
        }
    }

    /// Random polygons of normals, near the eye and far from it, with random weights: no normal is
    /// farther from Phong's than stated, and some are nearly as far.
    #[test]
    fn no_normal_is_farther_from_phongs_than_stated() {
        let charts = [None, Some(Chart::Stereographic), Some(Chart::HalfVectors)];
        for chart in charts {
            let mut random = Random::new(15);
            let (mut nearest, mut known) = (0.0f64, 0);
            for _ in 0..4000 {
                let mut value = || f64::from(random.signed());
                let count = 2 + (value().abs() * 5.0) as usize;
                let reach = value().abs() * 1.2;
                let lean = 2.0 * value().abs();
                let view = DVec3::Z;
                let middle = DVec3::new(libm::sin(lean), 0.0, libm::cos(lean));
                let normals: Vec<DVec3> = (0..count)
                    .map(|_| (middle + reach * DVec3::new(value(), value(), value())).normalize())
                    .collect();
                let mean = normals.iter().sum::<DVec3>().normalize();
                let c = normals.iter().map(|n| n.dot(mean)).fold(1.0, f64::min);
                let seen = FromEye::new(&normals, view, c);
                let bound = match chart {
                    Some(chart) => seen.angle(chart),
                    None => seen.angle_of_map(0.0),
                };
                if bound >= PI {
                    continue;
                }
                known += 1;
                for _ in 0..20 {
                    let mut weights: Vec<f64> = (0..count).map(|_| value().abs()).collect();
                    let sum: f64 = weights.iter().sum();
                    weights.iter_mut().for_each(|weight| *weight /= sum);
                    let all = normals.iter().zip(&weights);
                    let phong = all
                        .map(|(n, weight)| *weight * *n)
                        .sum::<DVec3>()
                        .normalize();
                    let found = through(chart, &normals, &weights);
                    assert!(
                        (found.length() - 1.0).abs() < 1e-12,
                        "{found} is no unit vector"
                    );
                    let angle = 2.0 * libm::asin((found.distance(phong) / 2.0).min(1.0));
                    assert!(
                        angle <= bound + 1e-7,
                        "{chart:?}, {normals:?} {weights:?}: {angle} {bound}"
                    );
                    if bound > 1e-3 {
                        nearest = nearest.max(angle / bound);
                    }
                }
            }
            std::println!("{chart:?}: {nearest:.2} of the bound, {known} polygons");
            assert!(
                nearest > 0.2 && known > 1000,
                "{chart:?}: {nearest} {known}"
            );
        }
    }

    /// Where nothing is known, the bound is π and not NaN.
    #[test]
    fn a_normal_behind_the_back_of_the_eye_has_no_bound() {
        let normals = [DVec3::Z, DVec3::NEG_Z, DVec3::X];
        for c in [-1.0, 0.0, 0.3] {
            let seen = FromEye::new(&normals, DVec3::Z, c);
            assert_eq!(seen.angle(Chart::Stereographic), PI);
            assert_eq!(seen.angle(Chart::HalfVectors), PI);
            assert_eq!(seen.angle_of_map(1e-6), PI);
            assert_eq!(of_angle(PI).cosine, 2.0);
        }
    }
}
