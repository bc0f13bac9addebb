//! The worst case of a method: the triangle and lights on which its picture is farthest from
//! Phong's, found by search.
//!
//! The search climbs a hill. It starts from a random triangle, moves one normal or one light by
//! less and less, and keeps a move if the largest error grows. There are many hills, so it is
//! restarted many times. Each restart has its own random numbers, so that the result is the same on
//! every machine, whatever the order of restarts.

use crate::split_mix::SplitMix;
use alloc::vec::Vec;
use fastphong::frame::{Frame, FrameBuilder, Vertex, sub_pixel};
use fastphong::mesh::Material;
use fastphong::reference::{self, Model};
use fastphong::scene::{Light, Lighting, SpecularModel};
use fastphong::shading::Variant;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The limits of a search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SearchSetting {
    /// The largest angle between the normals of two corners, in degrees.
    pub degrees: f64,
    /// The number of lights, which together are as bright as one.
    pub lights: usize,
}

/// A triangle and lights, with the error of a method's picture on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorstCase {
    /// The largest error, in grey levels of 255.
    pub levels: f64,
    /// True if highlights use N·H, because the method cannot draw R·V.
    pub halfway: bool,
    /// The unit normals of the corners at the upper left, upper right and lower left of the
    /// picture.
    pub normals: [[f64; 3]; 3],
    /// Unit vectors toward the lights.
    pub to_lights: Vec<[f64; 3]>,
}

/// The pixels along each leg of the triangle.
const SIDE: u32 = 24;
/// The number of steps of a climb.
const STEPS: u32 = 300;
/// The smallest |L·N| of pixels that count. At 0, a gated highlight ends with a jump, and the
/// smallest error moves the jump by a pixel. Without this limit, every search would end there.
const NEAR_TERMINATOR: f64 = 0.1;
/// The material of all cases.
const MATERIAL: Material = Material {
    ambient: [0.0; 3],
    diffuse: [0.6; 3],
    specular: [0.4; 3],
    shininess: 32.0,
};

/// The random numbers of a restart.
struct Random(SplitMix);

impl Random {
    /// Returns a random value in −1..1.
    fn signed(&mut self) -> f64 {
        (self.0.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Returns a random vector in the cube −1..1.
    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }
}

impl WorstCase {
    /// Returns the frame of the case.
    pub fn frame(&self) -> Frame {
        let share = 1.0 / self.to_lights.len().max(1) as f32;
        let lights = self.to_lights.iter();
        let lights: Vec<Light> = lights
            .map(|&to| Light::directional(DVec3::from(to), [share; 3]))
            .collect();
        let mut lighting = Lighting::new(&MATERIAL, [0.0; 3], &lights, DVec3::Z);
        if self.halfway {
            lighting.specular = SpecularModel::Blinn;
        }
        let mut builder = FrameBuilder::new(SIDE, SIDE);
        let material = builder.lighting(lighting);
        let places = [[0, 0], [SIDE, 0], [0, SIDE]];
        let corners = [0, 1, 2].map(|i| {
            let [x, y] = places[i].map(sub_pixel);
            builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: 1.0,
                normal: self.normals[i].map(|x| x as f32),
                material,
            })
        });
        let sum: DVec3 = self.normals.map(DVec3::from).iter().sum();
        let face = sum.normalize_or(DVec3::Z).as_vec3().to_array();
        builder.polygon(&corners, face, 0);
        builder.finish().expect("a triangle on the picture")
    }

    /// Returns the largest error of a method on the case, in grey levels, or `None` if the method
    /// cannot draw it.
    pub fn error(&self, variant: &Variant) -> Option<f64> {
        let frame = self.frame();
        let ours = variant.render_linear(&frame).ok()?;
        let truth = reference::render(&frame, Model::Phong).picture;
        let mut most = 0.0f64;
        for y in 0..SIDE as usize {
            for x in 0..SIDE as usize - y {
                let (ours, truth) = (ours.get(x, y), truth.get(x, y));
                if truth[3] == 0.0 || self.is_near_terminator(x, y) {
                    continue;
                }
                most = most.max((f64::from(ours[0]) - truth[0]).abs());
            }
        }
        Some(255.0 * most)
    }

    fn is_near_terminator(&self, x: usize, y: usize) -> bool {
        let [b, c] = [x, y].map(|at| (at as f64 + 0.5) / f64::from(SIDE));
        let [n1, n2, n3] = self.normals.map(DVec3::from);
        let n = n1 * (1.0 - b - c) + n2 * b + n3 * c;
        let mut all = self.to_lights.iter();
        all.any(|to| DVec3::from(*to).dot(n).abs() < NEAR_TERMINATOR * n.length())
    }

    /// True if the normals are within the angle of the setting and face the eye.
    fn is_within(&self, setting: SearchSetting) -> bool {
        let [a, b, c] = self.normals.map(DVec3::from);
        let most = setting.degrees.to_radians();
        [[a, b], [b, c], [c, a]]
            .iter()
            .all(|[a, b]| a.angle_between(*b) <= most)
            && [a, b, c].iter().all(|n| n.z > 0.05)
    }

    /// Returns a random case.
    fn random(random: &mut Random, setting: SearchSetting) -> WorstCase {
        // The angle of the normals from their middle in the widest triangle. Half of the cases
        // start narrower.
        let widest = 0.95 * setting.degrees.to_radians() / libm::sqrt(3.0);
        loop {
            let reach = widest * (1.0 - 0.8 * random.signed().max(0.0));
            let middle = (DVec3::Z + 0.8 * random.vector()).normalize();
            let across = middle.any_orthonormal_vector();
            let turn = 3.2 * random.signed();
            let normals = [0.0, 1.0, 2.0].map(|k| {
                let angle = turn + k * core::f64::consts::TAU / 3.0;
                let to = across * libm::cos(angle) + middle.cross(across) * libm::sin(angle);
                (middle + to * libm::tan(reach)).normalize().to_array()
            });
            let lights = (0..setting.lights).map(|_| {
                let to = middle + 1.2 * random.vector();
                to.try_normalize().unwrap_or(middle).to_array()
            });
            let case = WorstCase {
                levels: 0.0,
                halfway: false,
                normals,
                to_lights: lights.collect(),
            };
            if case.is_within(setting) {
                return case;
            }
        }
    }

    /// Returns the case with one normal or one light moved by about `by`.
    fn moved(&self, random: &mut Random, by: f64) -> WorstCase {
        let mut case = self.clone();
        let places = 3 + case.to_lights.len();
        let place = ((random.signed() + 1.0) / 2.0 * places as f64) as usize;
        let moved = match place {
            0..3 => &mut case.normals[place],
            _ => &mut case.to_lights[(place - 3).min(self.to_lights.len() - 1)],
        };
        let from = DVec3::from(*moved);
        let to = (from + by * random.vector()).try_normalize();
        *moved = to.unwrap_or(from).to_array();
        case
    }
}

/// Climbs once, with the random numbers of the restart at index `restart`. Returns `None` if the
/// method cannot draw the start.
pub fn climb(variant: &Variant, setting: SearchSetting, restart: u32) -> Option<WorstCase> {
    // The seed has the restart in its upper half and the setting in its lower half.
    let bits = (setting.lights as u64) << 24 | (setting.degrees * 64.0) as u64;
    let mut random = Random(SplitMix(u64::from(restart) << 32 | bits));
    let start = WorstCase::random(&mut random, setting);
    let mut best = [false, true].into_iter().find_map(|halfway| {
        let case = WorstCase {
            halfway,
            ..start.clone()
        };
        let levels = case.error(variant)?;
        Some(WorstCase { levels, ..case })
    })?;
    for step in 0..STEPS {
        let left = 1.0 - f64::from(step) / f64::from(STEPS);
        let case = best.moved(&mut random, 0.01 + 0.4 * left * left);
        if !case.is_within(setting) {
            continue;
        }
        let Some(levels) = case.error(variant) else {
            continue;
        };
        if levels > best.levels {
            best = WorstCase { levels, ..case };
        }
    }
    Some(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SETTING: SearchSetting = SearchSetting {
        degrees: 15.0,
        lights: 1,
    };

    #[test]
    fn a_restart_finds_its_case_again_and_stays_within_its_setting() {
        for name in ["gouraud", "bishop-weimer", "difference-vector"] {
            let variant = Variant::parse(name).unwrap();
            let [one, two] = [(); 2].map(|()| climb(&variant, SETTING, 3).unwrap());
            assert_eq!(one, two, "{name}");
            assert!(one.is_within(SETTING));
            assert_eq!(one.error(&variant), Some(one.levels));
            assert_ne!(one, climb(&variant, SETTING, 4).unwrap(), "{name}");
        }
    }

    /// The search finds lost highlights, though not from every start. Methods that only round have
    /// nothing to find.
    #[test]
    fn a_climb_goes_up() {
        let variant = Variant::parse("gouraud").unwrap();
        let found = (0..8).map(|restart| climb(&variant, SETTING, restart).unwrap().levels);
        let found: Vec<f64> = found.collect();
        let best = found.iter().copied().fold(0.0, f64::max);
        // Gouraud loses a highlight between the corners. Some hills are low.
        assert!(
            best > 20.0 && found.iter().any(|levels| *levels < best),
            "{found:?}"
        );
        let exact = Variant::parse("naive-phong").unwrap();
        assert!(climb(&exact, SETTING, 0).unwrap().levels < 0.1);
    }
}
