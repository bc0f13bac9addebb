//! The promise of `adaptive-phong`: apart from rounding, linear colours are within `levels` of
//! naive Phong's closed form in `f64`.

use crate::support::Random;
use crate::support::cases::cases;
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::reference::{self, Model};
use fastphong::scene::{Falloff, Interpolation, LightTerm, Lighting, Place, SpecularModel};
use fastphong::shading::Variant;
use glam::DVec3;
use std::slice::Iter;

/// The room for rounding, in grey levels.
const ROUNDINGS: f64 = 0.05;

fn adaptive(levels: f64) -> Variant {
    Variant::parse(&format!("adaptive-phong:levels={levels}")).expect("a method")
}

/// On every shipped scene the error is within the promise, and somewhere more than half of it.
#[test]
fn every_scene_is_within_the_promise() {
    for levels in [0.05, 0.5, 4.0] {
        let mut worst = (0.0, "");
        for scene in cases(None) {
            let variant = adaptive(levels);
            let (ours, truth) = (
                variant
                    .render_linear(&scene.frame)
                    .expect("a method for the frame"),
                scene.truth(Model::Phong),
            );
            let mut most = 0.0f64;
            for (i, (a, b)) in ours.pixels().iter().zip(truth.pixels()).enumerate() {
                if scene.seen().pixels()[i] == scene.visibility().polygons.pixels()[i] {
                    most = (0..3).fold(most, |most, c| most.max(f64::from((a[c] - b[c]).abs())));
                }
            }
            let error = 255.0 * most;
            println!("{} at {levels}: {error:.3}", scene.name);
            assert!(
                error <= levels + ROUNDINGS,
                "{} at {levels}: {error}",
                scene.name
            );
            if error > worst.0 {
                worst = (error, &scene.name);
            }
        }
        assert!(worst.0 > 0.5 * levels, "{worst:?} at {levels}");
    }
}

fn genes(random: &mut Random) -> Genes {
    [(); GENES].map(|()| random.share().into())
}

fn one_of<T: Copy>(share: f64, all: &[T]) -> T {
    all[(share * all.len() as f64) as usize]
}

/// Values in 0..1 from which a polygon and its material are made, either random or changed by a
/// search.
type Genes = [f64; GENES];
const GENES: usize = 96;

/// The settings that all polygons of a frame share.
#[derive(Clone, Copy)]
struct Setting {
    /// The side of the square cell of each polygon, in pixels.
    cell: u32,
    lights: usize,
    interpolation: Interpolation,
    levels: f64,
}

impl Setting {
    fn of(random: &mut Random) -> Self {
        let mut share = || f64::from(random.share());
        Setting {
            cell: one_of(share(), &[12, 20, 32, 64]),
            lights: one_of(share(), &[1, 1, 2, 3, 4]),
            interpolation: if share() < 0.3 {
                Interpolation::Perspective
            } else {
                Interpolation::Screen
            },
            levels: one_of(share(), &[0.05, 0.1, 0.5, 0.5, 1.0, 2.0, 4.0, 16.0]),
        }
    }
}

/// The count of polygons in a frame. Their cells stand in `COLUMNS` columns.
const COUNT: u32 = 64;
const COLUMNS: u32 = 8;

/// Reads a polygon's genes in order.
struct Reader<'a>(Iter<'a, f64>);

impl Reader<'_> {
    fn share(&mut self) -> f64 {
        *self.0.next().expect("enough genes")
    }
    fn vector(&mut self) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| 2.0 * self.share() - 1.0))
    }
    fn direction(&mut self) -> Place<[f32; 3]> {
        let v = self.vector() + DVec3::new(0.0, 0.0, 0.6);
        Place::Infinite(v.try_normalize().unwrap_or(DVec3::Z).as_vec3().to_array())
    }
    fn colour(&mut self, most: f64) -> [f32; 3] {
        [(); 3].map(|()| (most * self.share()) as f32)
    }

    fn lighting(&mut self, setting: Setting) -> Lighting {
        let strength = 1.2 / setting.lights as f64;
        let mut lighting = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
        lighting.ambient = self.colour(0.2);
        lighting.view = Place::Infinite(one_of(self.share(), &[[0.0, 0.0, 1.0], [0.0, 0.6, 0.8]]));
        lighting.shininess = one_of(
            self.share(),
            &[0.5, 1.0, 2.0, 5.0, 7.3, 10.0, 32.0, 33.0, 128.0],
        );
        lighting.specular = if self.share() < 0.3 {
            SpecularModel::Blinn
        } else {
            SpecularModel::Phong
        };
        lighting.lights = (0..setting.lights)
            .map(|_| LightTerm {
                place: self.direction(),
                diffuse: self.colour(strength),
                specular: self.colour(strength),
                falloff: Falloff::None,
            })
            .collect();
        lighting
    }

    /// Makes the vertices of a convex polygon of 3 to 6 corners in a cell.
    fn polygon(&mut self, setting: Setting, number: u32, material: u32) -> Vec<Vertex> {
        let middle = (self.vector() + DVec3::new(0.0, 0.0, 1.0)).normalize_or(DVec3::Z);
        let reach = 10f64.powf(self.share() * 3.0 - 2.6);
        let range = one_of(self.share(), &[0.01, 0.2, 0.7]);
        let corners = one_of(self.share(), &[3u32, 3, 4, 5, 6]);
        let turn = self.share();
        let side = f64::from(setting.cell);
        let at = |cell: u32, x: f64| SubPixel::from_num(side * (f64::from(cell) + 0.5 + 0.49 * x));
        let corner = |k| {
            let angle = core::f64::consts::TAU
                * (turn + (f64::from(k) + 0.4 * self.share()) / f64::from(corners));
            let (sin, cos) = angle.sin_cos();
            let normal = (middle + reach * self.vector()).normalize_or(middle);
            let weight = (1.0 - range * self.share()) as f32;
            Vertex {
                x: at(number % COLUMNS, cos),
                y: at(number / COLUMNS, sin),
                depth: 0.5,
                inv_w: match setting.interpolation {
                    Interpolation::Perspective => weight.into(),
                    Interpolation::Screen => 1.0,
                },
                normal: normal.as_vec3().to_array(),
                material,
            }
        };
        (0..corners).map(corner).collect()
    }
}

/// Builds a frame of polygons, each with its own material. `change` changes the lightings.
fn frame(setting: Setting, all: &[Genes], change: impl Fn(&mut Lighting)) -> Frame {
    let rows = u32::div_ceil(all.len() as u32, COLUMNS);
    let mut builder = FrameBuilder::new(setting.cell * COLUMNS, setting.cell * rows);
    builder.interpolation(setting.interpolation);
    for (number, genes) in (0..).zip(all) {
        let mut reader = Reader(genes.iter());
        let mut lighting = reader.lighting(setting);
        change(&mut lighting);
        let material = builder.lighting(lighting);
        let vertices = reader.polygon(setting, number, material);
        let corners: Vec<u32> = vertices.into_iter().map(|v| builder.vertex(v)).collect();
        builder.polygon(&corners, [0.0, 0.0, 1.0], number);
    }
    builder.finish().expect("all corners are on the picture")
}

/// Returns |L·N| of one light at each pixel, from a picture lit only by this light and its
/// opposite.
fn cosines(setting: Setting, all: &[Genes], light: usize) -> Vec<f64> {
    let frame = frame(setting, all, |lighting| {
        let Place::Infinite(to) = lighting.lights[light].place else {
            unreachable!("directions")
        };
        let alone = |to| LightTerm {
            place: Place::Infinite(to),
            diffuse: [1.0; 3],
            specular: [0.0; 3],
            falloff: Falloff::None,
        };
        lighting.ambient = [0.0; 3];
        lighting.lights = vec![alone(to), alone(to.map(|c| -c))];
    });
    let picture = reference::render(&frame, Model::Phong).picture;
    picture.pixels().iter().map(|pixel| pixel[0]).collect()
}

/// The measurements on a frame.
struct Measured {
    /// The largest error on each polygon, in grey levels.
    errors: Vec<f64>,
    pixels: usize,
    /// The pixels that are left out. A highlight jumps where L·N = 0, and rounding decides. For
    /// exponents below 1 its slope has no limit where it ends, so only the bound of its rounding
    /// holds.
    apart: usize,
    kinds: [usize; 5],
}

fn measure(setting: Setting, all: &[Genes]) -> Measured {
    let (frame, variant) = (frame(setting, all, |_| ()), adaptive(setting.levels));
    let mut measured = Measured {
        errors: vec![0.0; all.len()],
        pixels: 0,
        apart: 0,
        kinds: [0; 5],
    };
    for (sum, kind) in measured.kinds.iter_mut().zip(variant.polygon_kinds(&frame)) {
        *sum = kind.polygons;
    }
    let (ours, truth) = (
        variant
            .render_linear(&frame)
            .expect("a method for the frame"),
        reference::render(&frame, Model::Phong),
    );
    let mut gates = None;
    for (i, (a, b)) in ours.pixels().iter().zip(truth.picture.pixels()).enumerate() {
        let Some(most) = measured.errors.get_mut(truth.polygons.pixels()[i] as usize) else {
            continue;
        };
        measured.pixels += 1;
        let error = (0..3)
            .map(|c| 255.0 * (f64::from(a[c]) - b[c]).abs())
            .fold(0.0, f64::max);
        if error > setting.levels + ROUNDINGS {
            let lights = 0..setting.lights;
            let gates: &Vec<Vec<f64>> =
                gates.get_or_insert_with(|| lights.map(|l| cosines(setting, all, l)).collect());
            let polygon = truth.polygons.pixels()[i] as usize;
            let is_steep = frame.lightings()[polygon].shininess < 1.0;
            let bound = || 255.0 * variant.polygon_bounds(&frame).nth(polygon).unwrap_or(0.0);
            if gates.iter().any(|light| light[i] < 1e-5) || is_steep && error <= bound() {
                measured.apart += 1;
                continue;
            }
        }
        *most = f64::max(*most, error);
    }
    measured
}

/// Reads a count from the environment, so that a test can run longer than `cargo test` has time
/// for.
pub fn asked(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |number| number.parse().expect("a number"))
}

/// Ten thousand random polygons keep the promise. A million take some minutes:
///
/// ```text
/// FASTPHONG_POLYGONS=1000000 cargo test --release --test conformance -- random_polygons --nocapture
/// ```
#[test]
fn random_polygons_are_within_the_promise() {
    let count = asked("FASTPHONG_POLYGONS", 10_000);
    let (mut worst, mut kinds, mut apart, mut pixels) = ((0.0f64, 0, 0.0), [0usize; 5], 0, 0);
    let mut failures = Vec::new();
    let first = asked("FASTPHONG_POLYGONS_SEED", 1);
    for seed in first..first + u64::div_ceil(count, COUNT.into()) {
        let mut random = Random::new(seed);
        let setting = Setting::of(&mut random);
        let all: Vec<Genes> = (0..COUNT).map(|_| genes(&mut random)).collect();
        let (measured, levels) = (measure(setting, &all), setting.levels);
        for (sum, kind) in kinds.iter_mut().zip(measured.kinds) {
            *sum += kind;
        }
        pixels += measured.pixels;
        apart += measured.apart;
        for (polygon, error) in measured.errors.into_iter().enumerate() {
            if error > levels + ROUNDINGS {
                failures.push(format!(
                    "seed {seed}, polygon {polygon}, levels {levels}: {error}"
                ));
            }
            if error / levels > worst.0 && levels >= 0.5 {
                worst = (error / levels, seed, levels);
            }
        }
    }
    println!(
        "{pixels} pixels, {apart} apart; worst (share, seed, levels): {worst:?}; kinds {kinds:?}"
    );
    assert!(
        failures.is_empty(),
        "{}: {:#?}",
        failures.len(),
        &failures[..failures.len().min(10)]
    );
    assert!(
        apart * 100_000 <= pixels,
        "{apart} of {pixels} pixels apart"
    );
    assert!(worst.0 > 0.5, "{worst:?}");
    let polygons: usize = kinds.iter().sum();
    assert!(kinds.iter().all(|kind| kind * 50 > polygons), "{kinds:?}");
}

/// Searches for the polygon with the largest share of the promise. It tries 64 random ones, then
/// changes the best one 64 times, again and again: a few genes, by up to a half or by a thousandth
/// of that. Returns the share of the best random one, and of the best of all.
fn search(random: &mut Random) -> (Setting, [f64; 2]) {
    const GENERATIONS: u32 = 80;
    let setting = Setting {
        cell: 16,
        levels: one_of(random.share().into(), &[0.5, 1.0, 4.0]),
        ..Setting::of(random)
    };
    let (mut best, mut first) = ((0.0, genes(random)), 0.0);
    for generation in 0..GENERATIONS {
        let all: Vec<Genes> = (0..COUNT)
            .map(|_| {
                if generation == 0 {
                    return genes(random);
                }
                let reach = 0.5 * f64::powf(0.001, random.share().into());
                best.1.map(|gene: f64| {
                    if random.share() < 0.04 {
                        (gene + reach * (2.0 * f64::from(random.share()) - 1.0))
                            .clamp(0.0, 0.999_999)
                    } else {
                        gene
                    }
                })
            })
            .collect();
        for (error, genes) in measure(setting, &all).errors.into_iter().zip(&all) {
            if error / setting.levels > best.0 {
                best = (error / setting.levels, *genes);
            }
        }
        if generation == 0 {
            first = best.0;
        }
    }
    (setting, [first, best.0])
}

/// The worst polygons that a search finds keep the promise, and are worse than random ones. To run
/// more restarts:
///
/// ```text
/// FASTPHONG_RESTARTS=200 cargo test --release --test conformance -- worst_polygons --nocapture
/// ```
#[test]
fn the_worst_polygons_that_a_search_finds_are_within_the_promise() {
    let mut worst = 0.0f64;
    for restart in 1..=asked("FASTPHONG_RESTARTS", 12) {
        let (setting, [first, last]) = search(&mut Random::new(1000 + restart));
        let Setting { lights, levels, .. } = setting;
        println!(
            "restart {restart}, {lights} lights, levels {levels}: {first:.3} to {last:.3} of the promise"
        );
        assert!(
            last <= 1.0 + ROUNDINGS / levels,
            "restart {restart}: {last}"
        );
        worst = worst.max(last);
    }
    println!("worst share: {worst:.3}");
    assert!(worst > 0.7, "{worst}");
}
