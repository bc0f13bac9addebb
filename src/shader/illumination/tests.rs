use super::Illumination;
use crate::lighting::{Falloff, Light, Lighting, Material, SpecularGate, SpecularModel};
use crate::number::Num;
use alloc::vec::Vec;
use core::ops::{Add, Div, Mul, Neg, Sub};
use glam::DVec3;

/// A group of two numbers whose products and powers must not be subnormal.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Normal([f32; 2]);

impl Normal {
    fn checked(numbers: [f32; 2]) -> Normal {
        assert!(
            numbers.iter().all(|x| !x.is_subnormal()),
            "{numbers:?} is subnormal"
        );
        Normal(numbers)
    }

    fn map(self, of: impl Fn(f32) -> f32) -> Normal {
        Normal(self.0.map(of))
    }

    fn with(self, other: Normal, of: impl Fn(f32, f32) -> f32) -> [f32; 2] {
        [of(self.0[0], other.0[0]), of(self.0[1], other.0[1])]
    }
}

impl Add for Normal {
    type Output = Normal;
    fn add(self, other: Normal) -> Normal {
        Normal(self.with(other, |a, b| a + b))
    }
}

impl Sub for Normal {
    type Output = Normal;
    fn sub(self, other: Normal) -> Normal {
        Normal(self.with(other, |a, b| a - b))
    }
}

impl Mul for Normal {
    type Output = Normal;
    fn mul(self, other: Normal) -> Normal {
        Normal::checked(self.with(other, |a, b| a * b))
    }
}

impl Div for Normal {
    type Output = Normal;
    fn div(self, other: Normal) -> Normal {
        Normal(self.with(other, |a, b| a / b))
    }
}

impl Neg for Normal {
    type Output = Normal;
    fn neg(self) -> Normal {
        self.map(|x| -x)
    }
}

impl Num for Normal {
    fn sqrt(self) -> Normal {
        self.map(Num::sqrt)
    }
    fn over_sqrt(self) -> Normal {
        self.map(Num::over_sqrt)
    }
    fn max(self, other: Normal) -> Normal {
        Normal(self.with(other, Num::max))
    }
    fn min(self, other: Normal) -> Normal {
        Normal(self.with(other, Num::min))
    }
    fn gate(self, condition: Normal) -> Normal {
        Normal(self.with(condition, Num::gate))
    }
    fn is_over(self, least: Normal) -> bool {
        self.0[0] > least.0[0] || self.0[1] > least.0[1]
    }
    fn powf(self, exponent: f32) -> Normal {
        Normal::checked(self.0.map(|x| Num::powf(x, exponent)))
    }
}

const EXPONENTS: [f32; 14] = [
    0.25, 0.5, 1.0, 1.5, 2.0, 7.5, 10.0, 32.0, 63.9, 100.0, 128.0, 1000.0, 1024.0, 65_536.0,
];

/// One light along z, seen from there, whose highlight has this colour in every channel; nothing else shines.
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

/// Cosines of 0..=1, nearly 1 many of them, and those around the one at which highlights begin.
fn cosines(model: &Illumination<f32, 1>) -> Vec<f32> {
    let near_one = (0..2000).map(|i| 1.0 - f32::powf(2.0, -12.0 * i as f32 / 1000.0));
    let even = (0..=4000).map(|i| i as f32 / 4000.0);
    let t = model.faint;
    let around = [t.next_down(), t, t.next_up(), 0.999 * t, 1.001 * t];
    let around = around.into_iter().map(|x| x.clamp(0.0, 1.0));
    near_one.chain(even).chain(around).collect()
}

/// The colours of two pixels, whose highlights have these cosines.
fn lit<N: Num>(model: &Illumination<N, 1>, highlight: N) -> N {
    model.sum([model.one], [highlight], |_| None)[0]
}

/// Whatever the exponent and the light, a pixel beside one with a highlight included: with powers of faint highlights this
/// fails at once, as 0.25¹⁰⁰ is subnormal.
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
            ] {
                let lighting = Lighting {
                    gate,
                    ..shining(colour, shininess, falloff)
                };
                let plain = Illumination::<f32, 1>::new(&lighting, &|x| x);
                let model = Illumination::new(&lighting, &|x| Normal([x; 2]));
                let usual = model.usual(model.one);
                for cosine in cosines(&plain) {
                    for beside in [0.0, 1.0] {
                        let group = Normal([cosine, beside]);
                        let colour = lit(&model, group);
                        assert_eq!(colour.0[0], lit(&plain, cosine), "{cosine}^{shininess}");
                        if let Some(usual) = &usual {
                            assert_eq!(usual.usual_sum(|_| model.one, |_| group)[0], colour);
                        }
                    }
                }
            }
        }
    }
}

/// What is left out of a highlight is at most 2⁻²⁴; what is over that is not left out. Both but for rounding: of 1/n by
/// 2⁻²⁴ of its value, which the power multiplies by ln(k / 2⁻²⁴), below 86 here; of t by 2⁻²³, and its power by n times as
/// much.
#[test]
fn faint_highlights_are_left_out_and_no_others() {
    for shininess in EXPONENTS {
        for (colour, falloff) in [
            (1e-9, Falloff::None),
            (0.4, Falloff::None),
            (20.0, Falloff::None),
            (0.5, Falloff::InverseSquare),
        ] {
            let lighting = shining(colour, shininess, falloff);
            let model = Illumination::<f32, 1>::new(&lighting, &|x| x);
            let strength = match falloff {
                Falloff::InverseSquare => 1e30,
                _ => 1.0,
            };
            let limit = f64::powi(2.0, -24);
            let rounding = 1.0 + (43.0 + f64::from(shininess)) * f64::powi(2.0, -23);
            let (mut faint, mut seen) = (0, 0);
            for cosine in cosines(&model) {
                let exact = strength
                    * f64::from(colour)
                    * f64::powf(f64::from(cosine), f64::from(shininess));
                let found = lit(&model, cosine);
                if found == 0.0 {
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

/// Anything to the power 0 is 1, where the light is in front of the surface.
#[test]
fn no_highlight_of_power_zero_is_faint() {
    let model = |gate| {
        let lighting = Lighting {
            gate,
            ..shining(0.5, 0.0, Falloff::None)
        };
        Illumination::<f32, 1>::new(&lighting, &|x| x)
    };
    let colour = |gate, cosine, highlight| model(gate).sum([cosine], [highlight], |_| None)[0];
    for highlight in [0.0, 1e-30, 0.5, 1.0] {
        assert_eq!(colour(SpecularGate::Gated, 0.25, highlight), 0.5);
        assert_eq!(colour(SpecularGate::Gated, 0.0, highlight), 0.0);
        assert_eq!(colour(SpecularGate::Ungated, 0.0, highlight), 0.5);
        assert_eq!(colour(SpecularGate::Weighted, 0.25, highlight), 0.125);
    }
}

/// Highlights of N·H follow the same rule.
#[test]
fn faint_highlights_by_the_halfway_vector_are_left_out() {
    let lighting = Lighting {
        specular: SpecularModel::Blinn,
        ..shining(1.0, 32.0, Falloff::None)
    };
    let model = Illumination::<f32, 1>::new(&lighting, &|x| x);
    let colour = |n_h: f32| model.colour(|_| 1.0, |_| 1.0, |_| n_h, |_| None)[0];
    // 2^(-24/32) is 0.5946.
    assert_eq!((colour(0.594), colour(1.0)), (0.0, 1.0));
    assert!(colour(0.595) > 0.0);
}
