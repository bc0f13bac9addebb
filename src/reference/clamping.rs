//! Clamping: which part of a picture has light above 1, which is cut off.
//!
//! Where light is cut off, all methods draw the same colour, whatever they compute, and differences
//! between them vanish.

use super::visibility::visibility_on_grid;
use super::{ClosedForm, Model, for_each_light};
use crate::frame::{Frame, Polygon};
use crate::scene::{Falloff, Lighting};
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// How far light may be above 1 without being counted: half a grey level. Eight bits lose no more
/// than that anyway. The rounding of unit vectors to `f32` stays far below it, so that a white
/// plane that faces its light is not counted.
const HALF_LEVEL: f64 = 0.5 / 255.0;

/// Samples along the longer side of the grid with which [`clamping`] starts.
const GRID: usize = 128;
/// With this many covered samples the share is known to some tenths of a percent.
const ENOUGH: usize = 2000;
/// Samples along the longer side of the finest grid. Each sample takes 20 bytes.
const FINEST: usize = 2048;

/// Counts of covered samples whose light exceeds 1 in a channel by more than half a grey level,
/// before it is clamped.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
pub struct Clamping {
    /// How many samples polygons cover. A pixel is one sample, unless the frame has several per
    /// pixel.
    pub covered: usize,
    /// How many of these exceed 1 in any channel.
    pub clamped: usize,
    /// How many exceed 1 in red, in green, and in blue.
    pub channels: [usize; 3],
    /// The covered and the clamped samples per material, by its index in [`Frame::lightings`].
    #[cfg_attr(feature = "io", serde(skip))]
    pub of_materials: Vec<[usize; 2]>,
}

impl Clamping {
    /// The share of covered samples above which clamping is reported: 2 %. Highlights are often
    /// smaller, and intended.
    pub const NOTABLE: f64 = 0.02;

    /// Starts counting samples of `frame`.
    pub(super) fn new(frame: &Frame) -> Clamping {
        Clamping {
            of_materials: vec![[0; 2]; frame.lightings().len()],
            ..Clamping::default()
        }
    }

    /// Counts a sample that shows `polygon` in this light.
    pub(super) fn add(&mut self, polygon: &Polygon, light: DVec3) {
        let over = light.to_array().map(|channel| channel > 1.0 + HALF_LEVEL);
        let any = usize::from(over.contains(&true));
        self.covered += 1;
        self.clamped += any;
        for (count, over) in self.channels.iter_mut().zip(over) {
            *count += usize::from(over);
        }
        let [covered, clamped] = &mut self.of_materials[polygon.material as usize];
        *covered += 1;
        *clamped += any;
    }

    /// Returns the clamped share of the covered samples, or 0 if there are none.
    pub fn share(&self) -> f64 {
        self.clamped as f64 / self.covered.max(1) as f64
    }

    /// True if the clamped share exceeds [`Clamping::NOTABLE`].
    pub fn is_notable(&self) -> bool {
        self.share() > Clamping::NOTABLE
    }
}

/// Counts clamped samples of `frame` under Phong's model. It looks at a grid over the picture, as
/// sparse as leaves `ENOUGH` covered samples. Small pictures are counted completely. If no light is
/// bright enough, nothing is counted.
pub fn clamping(frame: &Frame) -> Clamping {
    if frame
        .lightings()
        .iter()
        .all(|lighting| most(lighting) <= 1.0 + HALF_LEVEL)
    {
        return Clamping::default();
    }
    let side = frame.width().max(frame.height());
    let least = side.div_ceil(FINEST);
    let mut step = side.div_ceil(GRID).max(least);
    loop {
        let counted = on_grid(frame, step);
        if counted.covered >= ENOUGH || step <= least {
            return counted;
        }
        step = step.div_ceil(2).max(least);
    }
}

/// Counts the samples of a grid with this step.
fn on_grid(frame: &Frame, step: usize) -> Clamping {
    let seen = visibility_on_grid(frame, step).polygons;
    let mut clamping = Clamping::new(frame);
    let form = ClosedForm::from(Model::Phong);
    for_each_light(frame, &seen, step, form, |_, polygon, light| {
        clamping.add(polygon, light);
    });
    clamping
}

/// Returns the most light that any channel of a material can have, whatever its normals are.
fn most(lighting: &Lighting) -> f64 {
    let channel = |i: usize| {
        let of_lights = lighting.lights.iter().map(|light| {
            let is_unbounded = matches!(light.falloff, Falloff::InverseSquare | Falloff::Inverse);
            if light.place.is_local() && is_unbounded {
                f64::INFINITY
            } else {
                f64::from(light.diffuse[i]) + f64::from(light.specular[i])
            }
        });
        f64::from(lighting.ambient[i]) + of_lights.sum::<f64>()
    };
    (0..3).map(channel).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Material;
    use crate::mesh::builtin::builtin;
    use crate::reference::{shade_and_count, visibility};
    use crate::scene::{Light, Scene};

    /// A sphere of one material, seen along its only light.
    fn sphere(material: Material, [width, height]: [u32; 2], samples: u32) -> Frame {
        let mut scene = Scene::of_mesh(builtin("sphere").expect("a shape"));
        scene.objects[0].material = Some(material);
        scene.lights = vec![Light::directional(scene.camera.view(), [1.0; 3])];
        (scene.width, scene.height, scene.samples) = (width, height, samples);
        scene.frame().expect("a frame")
    }

    fn grey(ambient: f32, diffuse: f32, specular: f32, shininess: f32) -> Material {
        Material {
            ambient: [ambient; 3],
            diffuse: [diffuse, diffuse, 0.0],
            specular: [specular; 3],
            shininess,
        }
    }

    fn counted(frame: &Frame) -> Clamping {
        let form = ClosedForm::from(Model::Phong);
        shade_and_count(frame, &visibility(frame), form).1
    }

    #[test]
    fn all_that_a_flat_highlight_lights_is_clamped_and_blue_only_where_it_is_over_one() {
        // A highlight with exponent 0 is 1 wherever the light falls, which is all of the sphere
        // that is seen.
        let found = counted(&sphere(grey(0.0, 0.5, 1.0, 0.0), [64, 48], 1));
        let [red, green, blue] = found.channels;
        assert!(found.share() > 0.95 && found.is_notable(), "{found:?}");
        assert_eq!((red, green, blue), (found.clamped, found.clamped, 0));
        assert_eq!(found.of_materials[0], [found.covered, found.clamped]);
    }

    #[test]
    fn a_white_surface_that_faces_its_light_is_not_clamped() {
        for material in [grey(0.0, 1.0, 0.0, 1.0), grey(0.0, 0.0, 1.0, 1.0)] {
            let frame = sphere(material, [64, 48], 1);
            assert_eq!(counted(&frame).clamped, 0);
            assert_eq!(clamping(&frame), Clamping::default(), "not even looked at");
        }
    }

    #[test]
    fn a_grid_finds_the_share_of_all_samples() {
        // 1.3 cos a > 1 up to 39.7 degrees: sin² of that, 0.41, of the disc.
        for (size, samples) in [([640, 480], 1), ([1280, 960], 1), ([320, 240], 4)] {
            let frame = sphere(grey(0.0, 1.3, 0.0, 1.0), size, samples);
            let [all, some] = [counted(&frame), clamping(&frame)];
            assert!(some.covered < all.covered / 4, "{some:?}");
            // A grid of n × n on a disc misses some cells along two circles: below 4π/n, with n of
            // 50 and more.
            let off = (all.share() - some.share()).abs();
            assert!(
                off < 0.02 && (0.38..0.44).contains(&all.share()),
                "{off} {all:?}"
            );
        }
    }

    #[test]
    fn a_small_thing_in_a_large_picture_is_looked_at_closely() {
        let mut scene = Scene::of_mesh(builtin("sphere").expect("a shape"));
        scene.objects[0].material = Some(grey(0.0, 0.5, 1.0, 0.0));
        if let crate::scene::Projection::Orthographic { half_height } = &mut scene.camera.projection
        {
            *half_height *= 40.0;
        }
        (scene.width, scene.height) = (1000, 1000);
        let frame = scene.frame().expect("a frame");
        let found = clamping(&frame);
        assert!(found.covered > 100 && found.is_notable(), "{found:?}");
    }
}
