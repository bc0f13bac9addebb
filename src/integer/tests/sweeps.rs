//! Fast Phong shading with other tables and more steps: how much a larger table gains.

use super::super::material::{SCALE, TOP};
use super::super::reciprocal::Reciprocal;
use super::super::reciprocal_root::{below_one, newton, unit_j, unit_k};
use super::super::*;
use super::closed_form::*;
use super::errors::{Case, cases};
use std::println;

/// How many entries the tables have: 1/√D for D from 0 to 1, L·N from 0 to 1, and highlights; and
/// how many steps of Newton's method follow.
#[derive(Clone, Copy)]
struct Sizes {
    roots: u32,
    steps: usize,
    diffuse: u32,
    highlights: i32,
}

/// The sizes of [`Material`] and of the table of roots.
const CHOSEN: Sizes = Sizes {
    roots: 2048,
    steps: 0,
    diffuse: 256,
    highlights: 512,
};

impl Sizes {
    /// Returns 1/√D from a table of this size, refined by steps of Newton's method.
    fn root(self, d: i32) -> i32 {
        let entry = (u64::from(below_one(d)) * u64::from(self.roots)) >> 32;
        let middle = 1.0 + 1.0 / 2048.0 - (entry as f64 + 0.5) / f64::from(self.roots);
        let mut r = ((32768.0 / middle.max(1e-9).sqrt()) as i32).min(65535);
        for _ in 0..self.steps {
            r = newton(r, (d + (1 << 14)) >> 15).min(65535);
        }
        r
    }

    /// Returns red in grey levels, from fields of 5 bits with a fraction of 4 bits.
    fn red(self, j: i32, below: i32) -> f64 {
        let level = |x: f64| (x * 496.0).round() / 496.0;
        if j < 0 {
            return 255.0 * level(AMBIENT);
        }
        let entry = ((i64::from(j) * i64::from(self.diffuse)) >> 31) as f64 + 0.5;
        let cosine = entry / f64::from(self.diffuse) * 256.0 / 255.0;
        let mut shift = 0;
        let power = |below: f64| {
            let cosine = (f64::from(TOP) - below) / f64::from(SCALE);
            cosine.clamp(0.0, 1.0).powi(SHININESS as i32)
        };
        while power(f64::from(self.highlights << shift)) > 1.0 / 512.0 {
            shift += 1;
        }
        let shine = if (0..self.highlights).contains(&(below >> shift)) {
            power((f64::from(below >> shift) + 0.5) * f64::from(1 << shift))
        } else {
            0.0
        };
        let sum = level(AMBIENT + DIFFUSE * cosine) + level(HIGHLIGHT * shine);
        255.0 * sum.min(1.0)
    }

    /// Returns the largest error over all spans of an angle.
    fn worst(self, angle: f64) -> f64 {
        let mut worst = 0.0f64;
        for Case {
            toward,
            eye,
            first,
            end,
            pixels,
        } in cases(angle)
        {
            let lights = [Light::new(vector(toward), vector(eye), &UNCUT)];
            let (span, n) = (
                Span::new(vector(first), vector(end)),
                Reciprocal::of(pixels),
            );
            let ([mut j], [mut k]) = span.products::<Uncut, Reflection, 1>(&lights, n);
            let mut d = span.square(n);
            for i in 0..pixels {
                let r = self.root(d.next());
                let (j, k) = (unit_j(j.next(), r), unit_k(k.next(), r));
                let red = self.red(j, Reflection::below(&lights[0], j >> 16, k));
                let n = normalized(between(first, end, i as f64 / pixels as f64));
                if dot(toward, n).abs() >= 1e-3 {
                    let exact = lit(n, &[(toward, eye)], Kind::Reflection);
                    worst = worst.max((red - exact).abs());
                }
            }
        }
        worst
    }
}

#[test]
fn larger_tables_and_steps_lower_the_error() {
    let mut all = std::vec::Vec::new();
    for (name, sizes) in [
        ("chosen", CHOSEN),
        (
            "256 roots",
            Sizes {
                roots: 256,
                ..CHOSEN
            },
        ),
        (
            "512 roots",
            Sizes {
                roots: 512,
                ..CHOSEN
            },
        ),
        (
            "1024 roots",
            Sizes {
                roots: 1024,
                ..CHOSEN
            },
        ),
        (
            "4096 roots",
            Sizes {
                roots: 4096,
                ..CHOSEN
            },
        ),
        (
            "8192 roots",
            Sizes {
                roots: 8192,
                ..CHOSEN
            },
        ),
        ("1 step", Sizes { steps: 1, ..CHOSEN }),
        (
            "256 roots, 1 step",
            Sizes {
                roots: 256,
                steps: 1,
                ..CHOSEN
            },
        ),
        (
            "64 roots, 1 step",
            Sizes {
                roots: 64,
                steps: 1,
                ..CHOSEN
            },
        ),
        (
            "64 roots, 2 steps",
            Sizes {
                roots: 64,
                steps: 2,
                ..CHOSEN
            },
        ),
        (
            "128 highlights",
            Sizes {
                highlights: 128,
                ..CHOSEN
            },
        ),
        (
            "256 highlights",
            Sizes {
                highlights: 256,
                ..CHOSEN
            },
        ),
        (
            "1024 highlights",
            Sizes {
                highlights: 1024,
                ..CHOSEN
            },
        ),
        (
            "64 diffuse",
            Sizes {
                diffuse: 64,
                ..CHOSEN
            },
        ),
        (
            "128 diffuse",
            Sizes {
                diffuse: 128,
                ..CHOSEN
            },
        ),
        (
            "512 diffuse",
            Sizes {
                diffuse: 512,
                ..CHOSEN
            },
        ),
        (
            "8192 roots, 2048 highlights",
            Sizes {
                roots: 8192,
                highlights: 2048,
                ..CHOSEN
            },
        ),
    ] {
        let [near, far] = [15.0, 60.0].map(|angle| sizes.worst(angle));
        println!("\nsweep | {name} | {near:.2} | {far:.2} |");
        all.push((name, near, far));
    }
    let of = |name: &str| all.iter().find(|row| row.0 == name).expect("it is swept");
    let chosen = of("chosen");
    // Halving the root's steps or the highlight's lowers the error.
    for name in ["4096 roots", "1 step", "1024 highlights"] {
        assert!(of(name).2 < chosen.2, "{name}");
    }
    for name in ["1024 roots", "256 highlights", "64 diffuse"] {
        assert!(of(name).2 > chosen.2, "{name}");
    }
    // The chosen sizes must have the errors of the loop that this sweep models.
    assert!(chosen.1 < 3.8 && chosen.2 < 3.8 && chosen.2 > 2.8);
}
