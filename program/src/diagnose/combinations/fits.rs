//! Fits: lights, exponents, fog and amounts that explain a picture where no named mistake does.
//!
//! Amounts are found by least squares ([`Amounts`]). Directions and positions of lights, exponents
//! and the density of fog are searched for by the downhill simplex method (Nelder and Mead, *A
//! Simplex Method for Function Minimization*, 1965) on what free amounts leave.

use super::{Combinations, Set, shape_of};
use crate::diagnose::amounts::Amounts;
use crate::diagnose::drawer::Fitted;
use crate::diagnose::residual::MOST;
use alloc::vec;
use alloc::vec::Vec;
use fastphong::scene::Place;
use glam::DVec3;

/// The numbers that explain a picture.
pub struct Fit {
    /// The mistakes besides.
    pub mistakes: Set,
    pub fitted: Fitted,
}

/// What a mistake must take away besides fitted numbers, in levels.
const FIT_WORTH_NAMING: f64 = 0.05;

/// How many shapes are tried.
const SHAPES: usize = 3;

/// The most lights whose places are fitted.
const MOST_LIGHTS: usize = 3;

/// How often the picture is drawn for each number that is fitted.
const STEPS: usize = 60;

/// The numbers of a fit: two angles or three coordinates for each light, and the logarithm of the
/// exponents' factor.
struct Numbers<'s> {
    stated: &'s [Place<DVec3>],
}

impl Numbers<'_> {
    fn start(&self) -> Vec<f64> {
        let mut all = Vec::new();
        for place in self.stated {
            match *place {
                Place::Infinite(direction) => all.extend(angles(direction)),
                Place::Local(position) => all.extend(position.to_array()),
            }
        }
        all.push(0.0);
        all
    }

    fn fitted(&self, numbers: &[f64]) -> Fitted {
        let mut rest = numbers;
        let mut lights = Vec::with_capacity(self.stated.len());
        for place in self.stated {
            let count = if place.is_local() { 3 } else { 2 };
            let (own, others) = rest.split_at(count);
            rest = others;
            lights.push(match *own {
                [azimuth, height] => Place::Infinite(direction(azimuth, height)),
                [x, y, z] => Place::Local(DVec3::new(x, y, z)),
                _ => *place,
            });
        }
        Fitted {
            lights,
            exponent: libm::exp(rest.first().copied().unwrap_or(0.0)),
            fog: None,
        }
    }
}

/// Returns the angle around y and the angle over the plane of x and z.
fn angles(direction: DVec3) -> [f64; 2] {
    let unit = direction.normalize_or_zero();
    [
        libm::atan2(unit.x, unit.z),
        libm::asin(unit.y.clamp(-1.0, 1.0)),
    ]
}

fn direction(azimuth: f64, height: f64) -> DVec3 {
    let (across, up) = (libm::cos(height), libm::sin(height));
    DVec3::new(across * libm::sin(azimuth), up, across * libm::cos(azimuth))
}

impl Combinations<'_, '_> {
    /// Returns fits that come nearest to the picture, the simplest first: amounts alone, exponents,
    /// fog, and places of lights.
    pub fn fits(&mut self) -> Vec<Fit> {
        let shapes: Vec<Set> = self.first_shapes(2 * SHAPES);
        let stated = self.stated_lights();
        let plain = Fitted {
            lights: stated.clone(),
            exponent: 1.0,
            fog: None,
        };
        let mut fits = Vec::new();
        for shape in &shapes {
            fits.push(self.fit_of(shape, &plain));
        }
        for shape in shapes.iter().take(SHAPES) {
            let exponent = |this: &mut Self, factor: &[f64]| {
                let fitted = Fitted {
                    exponent: libm::exp(factor[0]),
                    ..plain.clone()
                };
                this.with(shape, &fitted)
            };
            let (factor, _) = simplex(&[0.0], 0.3, STEPS, &mut |x| exponent(self, x));
            let fitted = Fitted {
                exponent: libm::exp(factor[0]),
                ..plain.clone()
            };
            fits.push(self.fit_of(shape, &fitted));
        }
        if let Some(shape) = shapes.first() {
            fits.extend(self.fog(shape, &plain));
        }
        for shape in shapes.iter().take(SHAPES) {
            if (1..=MOST_LIGHTS).contains(&stated.len()) {
                fits.extend(self.lights(shape, &stated));
            }
        }
        fits
    }

    /// Fits the density of fog.
    fn fog(&mut self, shape: &Set, plain: &Fitted) -> Option<Fit> {
        let with = |density: f64| Fitted {
            fog: Some(density),
            ..plain.clone()
        };
        let unit = 1.0 / self.distance_of_target();
        let starts = [0.1, 0.2, 0.4, 0.8, 1.6].map(|factor| libm::log(factor * unit));
        let lefts = starts.map(|start| (self.with(shape, &with(libm::exp(start))), start));
        let (_, start) = lefts.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        let (density, _) = simplex(&[start], 0.3, STEPS, &mut |x| {
            self.with(shape, &with(libm::exp(x[0])))
        });
        Some(self.fit_of(shape, &with(libm::exp(density[0]))))
    }

    /// Fits the places of all lights, and exponents.
    fn lights(&mut self, shape: &Set, stated: &[Place<DVec3>]) -> Option<Fit> {
        let numbers = Numbers { stated };
        let mut starts = vec![numbers.start()];
        // One light may be anywhere.
        if let [Place::Infinite(_)] = stated {
            let around = (0..27).map(|k| {
                let [x, y, z] = [k % 3, k / 3 % 3, k / 9].map(|c: i32| f64::from(c - 1));
                DVec3::new(x, y, z)
            });
            let all = around.filter(|v| *v != DVec3::ZERO).map(|v| {
                let [azimuth, height] = angles(v);
                let start = vec![azimuth, height, 0.0];
                (self.with(shape, &numbers.fitted(&start)), start)
            });
            let best = all.min_by(|a, b| a.0.total_cmp(&b.0));
            starts.extend(best.map(|(_, start)| start));
        }
        let steps = STEPS * starts[0].len();
        let found = starts.iter().map(|start| {
            simplex(start, 0.2, steps, &mut |x| {
                self.with(shape, &numbers.fitted(x))
            })
        });
        let (best, _) = found.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(self.fit_of(shape, &numbers.fitted(&best)))
    }

    fn with(&mut self, shape: &Set, fitted: &Fitted) -> f64 {
        self.amounts_of(shape, fitted)
            .map_or(MOST, |(_, left)| left)
    }

    fn fit_of(&mut self, shape: &Set, fitted: &Fitted) -> Fit {
        Fit {
            mistakes: self.pruned_fit(shape, fitted),
            fitted: fitted.clone(),
        }
    }

    /// Fits the amounts of a set of mistakes with fitted lights, exponents and fog.
    fn amounts_of(&mut self, set: &[usize], fitted: &Fitted) -> Option<(Amounts, f64)> {
        let shape = shape_of(&self.recipe(set)?);
        self.fit(&shape, Some(fitted))
    }

    /// Leaves out mistakes that take nothing away from what fitted lights and amounts leave.
    fn pruned_fit(&mut self, set: &Set, fitted: &Fitted) -> Set {
        let mut set = set.clone();
        let left_of = |this: &mut Self, set: &[usize]| {
            this.amounts_of(set, fitted).map_or(MOST, |(_, left)| left)
        };
        let mut left = left_of(self, &set);
        loop {
            let mut best: Option<(Set, f64)> = None;
            for k in 0..set.len() {
                let mut rest = set.clone();
                rest.remove(k);
                let is_other = self.is_camera(set[k]) && self.changes_outline(&set, &rest);
                let value = left_of(self, &rest);
                if !is_other && best.as_ref().is_none_or(|(_, best)| value < *best) {
                    best = Some((rest, value));
                }
            }
            match best {
                Some((rest, value)) if value <= left + FIT_WORTH_NAMING.max(0.3 * left) => {
                    (set, left) = (rest, value.min(left));
                }
                _ => return set,
            }
        }
    }

    /// Returns the places of the scene's lights.
    fn stated_lights(&self) -> Vec<Place<DVec3>> {
        self.stage
            .scene
            .lights
            .iter()
            .map(|light| light.place)
            .collect()
    }

    /// Returns the distance from the eye to the target.
    fn distance_of_target(&self) -> f64 {
        let camera = &self.stage.scene.camera;
        (camera.target - camera.eye).length().max(1e-6)
    }

    /// Returns the best set of camera mistakes alone, and the first few sets with free amounts that
    /// have different light.
    fn first_shapes(&self, count: usize) -> Vec<Set> {
        let is_bare = |(set, _): &&(Set, f64)| set.iter().all(|m| self.is_camera(*m));
        let bare = self.shapes.iter().find(is_bare);
        let mut all: Vec<(Set, f64)> = bare.into_iter().chain(&self.shapes).cloned().collect();
        all.dedup_by(|a, b| (a.1 - b.1).abs() < 1e-5);
        all.into_iter().take(count).map(|(set, _)| set).collect()
    }
}

/// Finds numbers near `start` for which `value` is least, by at most `steps` calls. Returns them
/// and the value.
fn simplex(
    start: &[f64],
    size: f64,
    steps: usize,
    value: &mut dyn FnMut(&[f64]) -> f64,
) -> (Vec<f64>, f64) {
    let n = start.len();
    let mut corners: Vec<(Vec<f64>, f64)> = Vec::with_capacity(n + 1);
    for k in 0..=n {
        let mut corner = start.to_vec();
        if k > 0 {
            corner[k - 1] += size;
        }
        let found = value(&corner);
        corners.push((corner, found));
    }
    let mut left = steps.saturating_sub(n + 1);
    while left > 0 {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        if corners[n].1 - corners[0].1 < 1e-6 {
            break;
        }
        let mut middle = vec![0.0; n];
        for (corner, _) in &corners[..n] {
            for (sum, x) in middle.iter_mut().zip(corner) {
                *sum += x / n as f64;
            }
        }
        // The worst corner is moved along the line through the middle of all others.
        let along = |by: f64| -> Vec<f64> {
            let line = middle.iter().zip(&corners[n].0);
            line.map(|(m, worst)| m + by * (m - worst)).collect()
        };
        let reflected = along(1.0);
        let at_reflected = value(&reflected);
        left -= 1;
        let second_worst = corners[n - 1].1;
        if at_reflected < corners[0].1 {
            let expanded = along(2.0);
            let at_expanded = value(&expanded);
            left = left.saturating_sub(1);
            corners[n] = if at_expanded < at_reflected {
                (expanded, at_expanded)
            } else {
                (reflected, at_reflected)
            };
        } else if at_reflected < second_worst {
            corners[n] = (reflected, at_reflected);
        } else {
            let by = if at_reflected < corners[n].1 {
                0.5
            } else {
                -0.5
            };
            let contracted = along(by);
            let at_contracted = value(&contracted);
            left = left.saturating_sub(1);
            if at_contracted < corners[n].1.min(at_reflected) {
                corners[n] = (contracted, at_contracted);
            } else {
                let best = corners[0].0.clone();
                for (corner, found) in &mut corners[1..] {
                    for (x, best) in corner.iter_mut().zip(&best) {
                        *x = 0.5 * (*x + best);
                    }
                    *found = value(corner);
                }
                left = left.saturating_sub(n);
            }
        }
    }
    corners.sort_by(|a, b| a.1.total_cmp(&b.1));
    corners.swap_remove(0)
}

#[cfg(test)]
mod tests {
    use super::simplex;

    /// The valley of Rosenbrock, whose least value 0 is at (1, 1).
    #[test]
    fn the_simplex_finds_the_end_of_a_valley() {
        let (found, value) = simplex(&[-1.2, 1.0], 0.5, 400, &mut |x| {
            (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2)
        });
        assert!(value < 1e-6, "{value}");
        assert!((found[0] - 1.0).abs() < 0.01 && (found[1] - 1.0).abs() < 0.02);
    }
}
