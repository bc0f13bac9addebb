//! The weights of spherical linear interpolation, by incremental sines and cosines.

use super::Walk;
use crate::number::{Machine, Num, Real};

/// `sin((1−t)φ)` and `sin(tφ)`, stepped by the addition theorems: four additions and eight multiplications a step.
///
/// ```text
/// sin((t + Δt)φ)     = sin(tφ) cos(Δtφ) + cos(tφ) sin(Δtφ)                 (L21 4.9)
/// sin((1 − t − Δt)φ) = sin((1−t)φ) cos(Δtφ) − cos((1−t)φ) sin(Δtφ)         (L21 4.10)
/// cos((t + Δt)φ)     = cos(tφ) cos(Δtφ) − sin(tφ) sin(Δtφ)                 (L21 4.11)
/// cos((1 − t − Δt)φ) = cos((1−t)φ) cos(Δtφ) + sin((1−t)φ) sin(Δtφ)         (L21 4.12)
/// ```
///
/// Each step multiplies by a rotation whose entries are rounded: the amplitude drifts by at most about 2⁻²³ a step.
#[derive(Clone, Copy, Debug)]
pub struct Sines<F> {
    sin_t: F,
    cos_t: F,
    sin_rest: F,
    cos_rest: F,
    sin_step: F,
    cos_step: F,
}

impl<F: Num> Sines<F> {
    /// Starts at `t0` on the first pixel and goes on by `dt` a pixel, over the angle `phi` in radians.
    #[inline(always)]
    pub fn new<M: Machine<F = F>>(m: M, phi: M::One, t0: M::One, dt: M::One) -> Self {
        let (sin_t, cos_t) = (t0 * phi).sin_cos();
        let (sin_rest, cos_rest) = (phi - t0 * phi).sin_cos();
        let (sin_step, cos_step) = (dt * phi).sin_cos();
        if M::WIDTH == 1 {
            let s = |x| m.splat(x);
            return Sines {
                sin_t: s(sin_t),
                cos_t: s(cos_t),
                sin_rest: s(sin_rest),
                cos_rest: s(cos_rest),
                sin_step: s(sin_step),
                cos_step: s(cos_step),
            };
        }
        // The pixels of a group start from the recurrence itself: one sine a span instead of one a pixel.
        let start = Sines {
            sin_t,
            cos_t,
            sin_rest,
            cos_rest,
            sin_step,
            cos_step,
        };
        let lanes = |value: fn(&Sines<M::One>) -> M::One| {
            let mut walk = start;
            m.take(|| {
                let here = value(&walk);
                walk.step();
                here
            })
        };
        let (sin_group, cos_group) = (m.one(M::WIDTH as f32) * dt * phi).sin_cos();
        Sines {
            sin_t: lanes(|s| s.sin_t),
            cos_t: lanes(|s| s.cos_t),
            sin_rest: lanes(|s| s.sin_rest),
            cos_rest: lanes(|s| s.cos_rest),
            sin_step: m.splat(sin_group),
            cos_step: m.splat(cos_group),
        }
    }

    /// (sin((1−t)φ), sin(tφ)) here.
    #[inline(always)]
    pub fn weights(&self) -> (F, F) {
        (self.sin_rest, self.sin_t)
    }

    /// From t to t + Δt.
    #[inline(always)]
    pub fn step(&mut self) {
        let Sines {
            sin_t,
            cos_t,
            sin_rest,
            cos_rest,
            sin_step,
            cos_step,
        } = *self;
        self.sin_t = sin_t * cos_step + cos_t * sin_step; // 4.9
        self.sin_rest = sin_rest * cos_step - cos_rest * sin_step; // 4.10
        self.cos_t = cos_t * cos_step - sin_t * sin_step; // 4.11
        self.cos_rest = cos_rest * cos_step + sin_rest * sin_step; // 4.12
    }
}

impl<F: Num> Walk for Sines<F> {
    /// (sin((1−t)φ), sin(tφ))
    type Out = (F, F);

    #[inline(always)]
    fn next(&mut self) -> (F, F) {
        let here = self.weights();
        self.step();
        here
    }
}
