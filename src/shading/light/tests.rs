//! The light model: powers, faint highlights, and the fast path compared with the general one.

use super::*;
use crate::mesh::Material;
use crate::number::test_random::Random;
use crate::scene::Light;
use crate::scene::Power;
use core::ops::{Add, Div, Mul, Neg, Sub};
use glam::DVec3;

/// Whole powers are products. Each multiplication rounds the factor once, so n of them in any order
/// are off by at most n · 2⁻²⁴ of the value. A factor 1.1 covers the products of roundings.
#[test]
fn whole_powers_are_products() {
    for n in (0..=70).chain([96, 127, 128, 129, 255, 256, 300, 512, 1000, 4096, 65_536]) {
        let base = 1.0 - 1.0 / (n as f32 + 3.0);
        let truth = f64::from(base).powi(n);
        let exponent = Exponent::new(Power::default(), n as f32, 0.0);
        let found = exponent.of(base);
        let bound = 1.1 * f64::from(n) * f64::powi(2.0, -24) * truth;
        assert!(
            (f64::from(found) - truth).abs() <= bound,
            "{exponent:?}: {found}, expected {truth}"
        );
    }
    assert_eq!(
        Exponent::new(Power::default(), 32.0, 0.0),
        Exponent::Squarings(5)
    );
    assert_eq!(
        Exponent::new(Power::default(), 24.0, 0.0),
        Exponent::Whole(24)
    );
    assert_eq!(
        Exponent::new(Power::default(), 0.5, 0.0),
        Exponent::Fractional(0.5)
    );
}

/// A light behind a point, nearly opposite to the eye, makes no highlight: L·V is rounded to −1,
/// and 1 / |L + V| to infinity.
#[test]
fn opposite_light_and_eye_have_no_highlight() {
    let material = Material {
        ambient: [0.25; 3],
        diffuse: [0.0; 3],
        specular: [1.0; 3],
        shininess: 8.0,
    };
    let light = Light::positional(DVec3::new(0.0, 0.0, -5.0), [1.0; 3]);
    let lighting = Lighting {
        view: Place::Local([0.0; 3]),
        specular: SpecularModel::Blinn,
        gate: SpecularGate::Ungated,
        ..Lighting::new(&material, [1.0; 3], &[light], DVec3::Z)
    };
    let uniforms = Uniforms::new(&lighting, Power::default(), 1.0);
    for i in 0..1000 {
        // At (x, 0.3 x, −2) the light is x/3 off the axis and the eye x/2: |L + V| is below
        // 1.05 · 5/6 x, which is below 2⁻¹⁰.
        let x = i as f32 * 1e-6;
        let n = vec3([-0.6, 0.0, 0.8]); // on the side of L + V
        let point = [x, 0.3 * x, -2.0];
        let lit = LightAt::new(uniforms.stored(), 0.0, true).at(vec3(point));
        assert_eq!(lit.shade(n), vec3([0.25; 3]), "{x}");
        let light = lit.lights().next().expect("one light");
        let highlight = lit.highlight(&light, n.dot(light.to), n.dot(lit.view()));
        assert_eq!(
            lit.add(lit.ambient(), &light, 0.0, highlight),
            vec3([0.25; 3]),
            "{x}"
        );
    }
}

/// A block of two values that asserts that products and powers are not subnormal.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Normal([f32; 2]);

impl Normal {
    fn checked(self) -> Normal {
        let is_normal = self.0.iter().all(|x| !x.is_subnormal());
        assert!(is_normal, "{self:?} is subnormal");
        self
    }

    fn with(self, other: impl Into<Normal>, of: impl Fn(f32, f32) -> f32) -> Normal {
        let ([a, b], [c, d]) = (self.0, other.into().0);
        Normal([of(a, c), of(b, d)])
    }
}

impl From<f32> for Normal {
    fn from(x: f32) -> Normal {
        Normal([x; 2])
    }
}

macro_rules! operator {
    ($operator:ident $name:ident $other:ty) => {
        impl $operator<$other> for Normal {
            type Output = Normal;
            fn $name(self, other: $other) -> Normal {
                self.with(other, $operator::$name).checked()
            }
        }
    };
}
operator!(Add add Normal);
operator!(Add add f32);
operator!(Sub sub Normal);
operator!(Sub sub f32);
operator!(Mul mul Normal);
operator!(Mul mul f32);
operator!(Div div Normal);

impl Neg for Normal {
    type Output = Normal;
    fn neg(self) -> Normal {
        self * -1.0
    }
}

impl crate::number::MulAdd for Normal {
    fn mul_add(self, factor: Normal, summand: Normal) -> Normal {
        self * factor + summand
    }
}

impl Num for Normal {
    const WIDTH: usize = 2;
    type One = f32;

    fn one(self, x: f32) -> f32 {
        x
    }
    fn of_each(self, mut of: impl FnMut(usize) -> f32) -> Normal {
        Normal([of(0), of(1)])
    }

    fn broadcast(self, x: f32) -> Normal {
        x.into()
    }
    fn sqrt(self) -> Normal {
        self.with(0.0, |x, _| Num::sqrt(x))
    }
    fn powf(self, exponent: f32) -> Normal {
        self.with(exponent, Num::powf).checked()
    }
    fn exp2(self) -> Normal {
        self.with(0.0, |x, _| Num::exp2(x))
    }
    fn lookup(self, table: &[f32]) -> Normal {
        self.with(0.0, |x, _| Num::lookup(x, table))
    }
    fn max(self, least: f32) -> Normal {
        self.with(least, Num::max)
    }
    fn gate(self, condition: Normal, least: f32) -> Normal {
        self.with(condition, |x, condition| x.gate(condition, least))
    }
    fn any_over(self, least: f32) -> bool {
        self.0[0] > least || self.0[1] > least
    }
}

const EXPONENTS: [f32; 14] = [
    0.25, 0.5, 1.0, 1.5, 2.0, 7.5, 10.0, 32.0, 63.9, 100.0, 128.0, 1000.0, 1024.0, 65_536.0,
];

/// Returns one light along the line of sight, z, with a highlight of `colour` in every channel and
/// nothing else.
fn shining(colour: f32, shininess: f32, falloff: Falloff) -> Lighting {
    let material = Material {
        ambient: [0.0; 3],
        diffuse: [0.0; 3],
        specular: [1.0; 3],
        shininess,
    };
    let light = match falloff {
        Falloff::None => Light::directional(DVec3::Z, [colour; 3]),
        _ => Light {
            falloff,
            ..Light::positional(DVec3::Z, [colour; 3])
        },
    };
    Lighting::new(&material, [0.0; 3], &[light], DVec3::Z)
}

/// Returns cosines in 0..=1: evenly spread, many near 1, and around the one at which highlights
/// begin.
fn cosines(model: &LightModel) -> Vec<f32> {
    let near_one = (0..2000).map(|i| 1.0 - f32::powf(2.0, -12.0 * i as f32 / 1000.0));
    let even = (0..=4000).map(|i| i as f32 / 4000.0);
    let t = model.faint;
    let around = [t.next_down(), t, t.next_up(), 0.999 * t, 1.001 * t]
        .into_iter()
        .map(|x| x.clamp(0.0, 1.0));
    near_one.chain(even).chain(around).collect()
}

/// Returns the colour of a point at distance 1 from the light, where L·N is `cosine` and R·V or N·H
/// is `highlight`.
fn lit<F: Num>(uniforms: &Uniforms, cosine: F, highlight: F, general: bool) -> F {
    let nowhere = vec3([cosine.broadcast(0.0); 3]);
    let lit = LightAt::new(uniforms.stored(), nowhere.x, general).at(nowhere);
    let light = lit.lights().next().expect("one light");
    lit.add(lit.ambient(), &light, cosine, highlight).x
}

/// No power is subnormal for any exponent and light, even if another pixel of the block has a
/// highlight. With faint highlights this fails at once, because 0.25¹⁰⁰ is subnormal.
#[test]
fn no_power_is_subnormal() {
    for gate in [
        SpecularGate::Gated,
        SpecularGate::Ungated,
        SpecularGate::Weighted,
    ] {
        for shininess in EXPONENTS {
            for (colour, falloff) in [
                (1e-9, Falloff::None),
                (0.4, Falloff::None),
                (20.0, Falloff::None),
                (1.0, Falloff::Attenuation(2.0)),
                (1.0, Falloff::Inverse),
                (1.0, Falloff::InverseSquare),
                (20.0, Falloff::InverseSquare),
            ] {
                let lighting = Lighting {
                    gate,
                    ..shining(colour, shininess, falloff)
                };
                let uniforms = Uniforms::new(&lighting, Power::default(), 1.0);
                for cosine in cosines(&uniforms.model) {
                    let alone = lit(&uniforms, 1.0, cosine, true);
                    for beside in [0.0, 1.0] {
                        for general in [true, !uniforms.model.is_fast] {
                            let both = Normal([cosine, beside]);
                            let found = lit(&uniforms, Normal([1.0; 2]), both, general);
                            assert_eq!(found.0[0], alone, "{cosine}^{shininess} beside {beside}");
                        }
                    }
                }
            }
        }
    }
}

/// Highlights of at most 2⁻²⁴ are left out and stronger ones are not, within rounding. 1/n is
/// rounded by 2⁻²⁴ of its value, which the power multiplies by ln(k / 2⁻²⁴), below 86 here. t is
/// rounded by 2⁻²³, which the power multiplies by n.
#[test]
fn faint_highlights_are_left_out_and_no_others() {
    for shininess in EXPONENTS {
        for (colour, falloff, strongest) in [
            (1e-9, Falloff::None, 1.0),
            (0.4, Falloff::None, 1.0),
            (20.0, Falloff::None, 1.0),
            (0.5, Falloff::InverseSquare, 1e30),
        ] {
            let uniforms =
                Uniforms::new(&shining(colour, shininess, falloff), Power::default(), 1.0);
            let limit = f64::powi(2.0, -24);
            let rounding = 1.0 + (43.0 + f64::from(shininess)) * f64::powi(2.0, -23);
            let (mut faint, mut seen) = (0, 0);
            for cosine in cosines(&uniforms.model) {
                let power = f64::powf(f64::from(cosine), f64::from(shininess));
                let exact = strongest * f64::from(colour) * power;
                if lit(&uniforms, 1.0, cosine, true) == 0.0 {
                    assert!(exact <= limit * rounding, "{cosine}^{shininess}: {exact}");
                    faint += 1;
                } else {
                    assert!(exact >= limit / rounding, "{cosine}^{shininess}: {exact}");
                    seen += 1;
                }
            }
            assert!(faint > 0, "{colour} {shininess}: some are faint");
            assert_eq!(seen > 0, colour > 1e-7, "{colour} {shininess}: {seen}");
        }
    }
}

/// Any base to the power 0 is 1 if the light is in front of the surface.
#[test]
fn no_highlight_of_power_zero_is_faint() {
    let colour = |gate, cosine: f32, highlight| {
        let lighting = Lighting {
            gate,
            ..shining(0.5, 0.0, Falloff::None)
        };
        let uniforms = Uniforms::new(&lighting, Power::default(), 1.0);
        let [cosines, highlights] = [cosine, highlight].map(|x| Normal([x, 1.0]));
        let both = lit(&uniforms, cosines, highlights, true);
        let one = lit(&uniforms, cosine, highlight, true);
        assert_eq!(both.0[0], one);
        one
    };
    for highlight in [0.0, 1e-30, 0.5, 1.0] {
        assert_eq!(colour(SpecularGate::Gated, 0.25, highlight), 0.5);
        assert_eq!(colour(SpecularGate::Gated, 0.0, highlight), 0.0);
        assert_eq!(colour(SpecularGate::Ungated, 0.0, highlight), 0.5);
        assert_eq!(colour(SpecularGate::Weighted, 0.25, highlight), 0.125);
    }
}

/// Highlights by N·H follow the rule for faint highlights too.
#[test]
fn faint_highlights_by_the_halfway_vector_are_left_out() {
    let lighting = Lighting {
        specular: SpecularModel::Blinn,
        ..shining(1.0, 32.0, Falloff::None)
    };
    let uniforms = Uniforms::new(&lighting, Power::default(), 1.0);
    let colour = |n_h: f32| lit(&uniforms, 1.0, n_h, true);
    // 2^(-24/32) is 0.5946.
    assert_eq!((colour(0.594), colour(1.0)), (0.0, 1.0));
    assert!(colour(0.595) > 0.0);
}

/// Returns four lights from all sides on a surface of this shininess, seen along z.
fn four_lights(random: &mut Random, shininess: f32) -> Lighting {
    let lights: Vec<Light> = (0..4)
        .map(|i| {
            let direction = DVec3::from(random.unit().map(f64::from)).normalize();
            Light::directional(direction, [0.9, 0.2, 0.1 * i as f32])
        })
        .collect();
    let material = Material {
        shininess,
        ..Material::default()
    };
    Lighting::new(&material, [1.0; 3], &lights, DVec3::Z)
}

/// Returns the colours at unit normals.
fn at<F: Num>(uniforms: &Uniforms, n: Vec3<F>, general: bool) -> Vec3<F> {
    LightAt::new(uniforms.stored(), n.x, general).at(n).shade(n)
}

/// The fast path returns the colours of the general one to the last bit.
#[test]
fn the_fast_path_has_the_same_colours() {
    let mut random = Random::new(21);
    for shininess in (0..8).map(|k| (1 << k) as f32) {
        for _ in 0..20 {
            let uniforms =
                Uniforms::new(&four_lights(&mut random, shininess), Power::default(), 1.0);
            assert!(uniforms.model.is_fast, "what most scenes ask for");
            for _ in 0..200 {
                let n = vec3(random.unit());
                let general = at(&uniforms, n, true);
                assert_eq!(at(&uniforms, n, false), general, "{shininess}, {n:?}");
                let both = vec3(n.array().map(Normal::from));
                let found = at(&uniforms, both, false).array().map(|c| c.0[1]);
                assert_eq!(found, general.array(), "{shininess}, {n:?}");
            }
        }
    }
}

/// A power of two scales colours without rounding.
#[test]
fn colours_are_scaled() {
    let lighting = four_lights(&mut Random::new(2), 32.0);
    let [one, four] = [1.0, 4.0].map(|scale| Uniforms::new(&lighting, Power::default(), scale));
    let n = vec3([0.6, 0.0, 0.8]);
    assert_eq!(at(&four, n, false), at(&one, n, false) * 4.0);
}

#[test]
fn other_models_do_not_take_the_fast_path() {
    let lighting = four_lights(&mut Random::new(1), 32.0);
    let is_fast = |change: &dyn Fn(&mut Lighting)| {
        let mut lighting = lighting.clone();
        change(&mut lighting);
        Uniforms::new(&lighting, Power::default(), 255.0)
            .model
            .is_fast
    };
    assert!(is_fast(&|_| ()));
    assert!(is_fast(&|l| l.shininess = 1.0));
    for shininess in [0.0, 0.5, 3.0, 24.0, 32.5, 256.0] {
        assert!(!is_fast(&|l| l.shininess = shininess), "{shininess}");
    }
    assert!(!is_fast(&|l| l.specular = SpecularModel::Blinn));
    assert!(!is_fast(&|l| l.gate = SpecularGate::Ungated));
    assert!(!is_fast(&|l| l.gate = SpecularGate::Weighted));
    assert!(!is_fast(&|l| l.view = Place::Local([0.0; 3])));
    assert!(!is_fast(&|l| l.lights[2].place = Place::Local([0.0; 3])));
    // 255 times this overflows 32 bits.
    assert!(!is_fast(&|l| l.ambient[1] = 1e7));
    assert!(!is_fast(&|l| l.lights[3].specular[2] = 1e7));
    assert!(!is_fast(&|l| l.lights[0].diffuse[0] = f32::INFINITY));
}

/// A pixel's neighbours decide which operations run, but not its result, because tiles are drawn
/// into used memory.
#[cfg(feature = "simd")]
#[test]
fn pixels_do_not_depend_on_their_neighbours() {
    use crate::number::simd::{Token, tests::on_each_level};
    use fearless_simd::{SimdBase, f32x8};

    fn of<S: Token>() {
        let mut random = Random::new(4);
        for (shininess, general) in [(8.0, false), (8.0, true), (24.0, true), (7.5, true)] {
            let uniforms =
                Uniforms::new(&four_lights(&mut random, shininess), Power::default(), 1.0);
            let colours = |normals: [[f32; 3]; 8]| {
                let lanes = |i: usize| f32x8::from_slice(S::get(), &normals.map(|n| n[i]));
                let colour = at(&uniforms, vec3([lanes(0), lanes(1), lanes(2)]), general);
                colour.array().map(|lanes| lanes.as_slice().to_vec())
            };
            for _ in 0..100 {
                let normals = [(); 8].map(|()| random.unit());
                let together = colours(normals);
                for (k, normal) in normals.into_iter().enumerate() {
                    let alone = colours([normal; 8]);
                    let same = |i: usize| alone[i][k].to_bits() == together[i][k].to_bits();
                    assert!((0..3).all(same), "{shininess}, {normal:?} in {normals:?}");
                }
            }
        }
    }
    on_each_level!(of);
}

/// A cosine of 1 with an error of 4 e makes a highlight whose error is within the bound, also where
/// the cosine exceeds 1.
#[test]
fn highlights_over_1_are_within_their_bound() {
    let material = Material {
        specular: [1.0; 3],
        ..Material::default()
    };
    let light = Light::directional(DVec3::Z, [1.0; 3]);
    for power in Power::ALL {
        for n in [1.0f32, 8.0, 32.0, 200.0] {
            let mut lighting = Lighting::new(&material, [0.0; 3], &[light], DVec3::Z);
            lighting.shininess = n;
            let uniforms = Uniforms::new(&lighting, power, 1.0);
            let stored = uniforms.stored();
            for e in [0.0f32, 1e-6, 1e-4, 1e-3, 5e-3, 2e-2] {
                let at = |cosine| power_by_call(stored.model.exponent, cosine, stored.powers);
                let off = f64::from(at(1.0 + 4.0 * e) - at(1.0));
                let bound = highlight_error(&lighting, power, 2.0, e.into());
                // The sum 1 + 4 e is rounded by 2⁻²⁴, which n multiplies, and so is the power
                // itself.
                let rounding = f64::from(2.0 * (n + 1.0) * FAINT) * (1.0 + off.abs());
                assert!(
                    off <= bound + rounding,
                    "{power:?}, n {n}, e {e}: {off} over {bound}"
                );
            }
        }
    }
}

/// A table of a thousand entries for each of a million polygons would take 4 GB.
#[test]
fn polygons_that_see_light_from_their_own_places_share_a_table_of_powers() {
    let lighting = shining(0.5, 20.0, Falloff::InverseSquare);
    let uniforms = Uniforms::new(&lighting, Power::Table { size: 1024 }, 1.0);
    let seen = uniforms.seen_from([1.0, 2.0, 3.0]);
    let [own, shared] = [&uniforms, &seen].map(|uniforms| uniforms.stored().powers);
    assert_eq!(own.len(), 1025, "entries");
    assert!(core::ptr::eq(own, shared), "one table");
}

/// A method whose pixels have no position cannot ask for one.
#[cfg(debug_assertions)]
#[test]
#[should_panic(expected = "a walk has no point")]
fn a_pixel_without_a_point_has_none() {
    let uniforms = Uniforms::new(&shining(0.5, 20.0, Falloff::None), Power::default(), 1.0);
    let lit = LightAt::new(uniforms.stored(), 0.0f32, true);
    lit.at_pixel(vec3([1.0; 3]), false).point();
}
