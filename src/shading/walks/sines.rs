//! Great circles between unit normals, by incremental sines and cosines (L21 4.7–4.12).

use super::Walk;
use crate::number::{Num, Real, Vec3, vec3};
use crate::shading::walks::values::{Values, each};

/// The weights of spherical linear interpolation, `sin((1−t)φ)` and `sin(tφ)`, stepped by the
/// addition theorems: four additions and eight multiplications per step.
///
/// ```text
/// sin((t + Δt)φ)     = sin(tφ) cos(Δtφ) + cos(tφ) sin(Δtφ)                 (L21 4.9)
/// sin((1 − t − Δt)φ) = sin((1−t)φ) cos(Δtφ) − cos((1−t)φ) sin(Δtφ)         (L21 4.10)
/// cos((t + Δt)φ)     = cos(tφ) cos(Δtφ) − sin(tφ) sin(Δtφ)                 (L21 4.11)
/// cos((1 − t − Δt)φ) = cos((1−t)φ) cos(Δtφ) + sin((1−t)φ) sin(Δtφ)         (L21 4.12)
/// ```
///
/// Each step multiplies by a rotation whose entries are rounded, so the amplitude drifts by at most
/// about 2⁻²³ per step.
#[derive(Clone, Copy, Debug)]
pub struct Sines<F> {
    /// sin tφ, cos tφ.
    pub t: (F, F),
    /// sin (1−t)φ, cos (1−t)φ.
    pub rest: (F, F),
    /// sin Δtφ, cos Δtφ.
    pub step: (F, F),
}

impl<R: Real> Sines<R> {
    /// Starts at `t0` and steps by `dt`, over the angle `phi` in radians.
    #[inline(always)]
    pub fn new(phi: R, t0: R, dt: R) -> Self {
        Sines {
            t: (t0 * phi).sin_cos(),
            rest: (phi - t0 * phi).sin_cos(),
            step: (dt * phi).sin_cos(),
        }
    }
}

impl<F: Num> Walk<F> for Sines<F> {
    /// (sin((1−t)φ), sin(tφ))
    type Pixel = (F, F);

    #[inline(always)]
    fn next(&mut self) -> (F, F) {
        let here = (self.rest.0, self.t.0);
        // All four lines below need the old values.
        let ((sin_t, cos_t), (sin_rest, cos_rest)) = (self.t, self.rest);
        let (sin_step, cos_step) = self.step;
        self.t.0 = sin_t * cos_step + cos_t * sin_step; // 4.9
        self.rest.0 = sin_rest * cos_step - cos_rest * sin_step; // 4.10
        self.t.1 = cos_t * cos_step - sin_t * sin_step; // 4.11
        self.rest.1 = cos_rest * cos_step + sin_rest * sin_step; // 4.12
        here
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        for (name, (sin, cos)) in [("t", self.t), ("rest", self.rest), ("step", self.step)] {
            see(name, sin);
            see(name, cos);
        }
    }
}

/// The great circle from one unit normal to another, at uniform speed. It can also follow values
/// that are linear in the normal, as its products with constant vectors.
///
/// ```text
/// N(t) = sin((1−t)φ) / sin φ · N_1 + sin(tφ) / sin φ · N_2,      cos φ = N_1 · N_2      (L21 4.7, 4.8)
/// ```
///
/// A method that starts it sets [`Needs::GREAT_CIRCLES`](crate::shading::Needs::GREAT_CIRCLES), so
/// that edges follow great circles too, and keeps the polygon's normal,
/// [`Corners::face`](crate::shading::Corners::face), as its constants.
#[derive(Clone, Copy, Debug)]
pub struct GreatCircle<F, V = Vec3<F>> {
    /// N_1 / sin φ.
    #[doc(hidden)]
    pub from: V,
    /// N_2 / sin φ.
    #[doc(hidden)]
    pub to: V,
    /// The weights of both.
    #[doc(hidden)]
    pub sines: Sines<F>,
}

/// The angle in radians below which the circle is replaced by its chord. The weights are then
/// computed for this angle, and differ from linear ones by less than φ²/16 = 6·10⁻⁸, about half a
/// unit in the last place of an `f32`.
const SMALLEST_ANGLE: f32 = 1e-3;
/// The angle (179°) beyond which the ends do not determine a great circle: the polygon's normal
/// replaces it.
pub(crate) const LARGEST_ANGLE: f32 = 179.0 * core::f32::consts::PI / 180.0;

impl<R: Real> GreatCircle<R> {
    /// Starts at `t0` between the unit normals `a` (t = 0) and `b` (t = 1), and steps by `dt`.
    /// `face` is the polygon's unit normal.
    #[inline(always)]
    pub fn new(face: Vec3<R>, [a, b]: [Vec3<R>; 2], t0: R, dt: R) -> Self {
        let (sum, difference) = (a + b, b - a);
        let (cos_half, sin_half) = (sum.dot(sum).sqrt(), difference.dot(difference).sqrt());
        // φ = cos⁻¹(N_1 · N_2) as printed loses half of its digits near 0 and near π; the
        // half-angle form does not.
        let half = sin_half.atan2(cos_half);
        let phi = half + half; // φ
        let (a, b, phi, sin_phi) = if phi.value() > LARGEST_ANGLE {
            // Nearly opposite ends: the span has the polygon's normal everywhere.
            let phi = phi.broadcast(SMALLEST_ANGLE);
            (face, face, phi, phi)
        } else if phi.value() < SMALLEST_ANGLE {
            let phi = phi.broadcast(SMALLEST_ANGLE);
            (a, b, phi, phi)
        } else {
            // sin φ = 2 sin(φ/2) cos(φ/2), and |b − a| = 2 sin(φ/2), |a + b| = 2 cos(φ/2) for unit
            // vectors.
            (a, b, phi, sin_half * 0.5 * cos_half) // sin φ
        };
        let scale = phi.broadcast(1.0) / sin_phi;
        let sines = Sines::new(phi, t0, dt);
        GreatCircle {
            from: a * scale, // 4.7
            to: b * scale,
            sines,
        }
    }
}

/// The largest width of a block.
const MOST: usize = 16;

impl<F: Num> GreatCircle<F> {
    /// Starts like [`GreatCircle::new`], but at each pixel of a block, and with steps a block long.
    /// In [`Shader::walk`](crate::shading::Shader::walk) `ends` are
    /// [`Span::ends`](crate::shading::Span::ends), the next argument is
    /// [`Span::parameter`](crate::shading::Span::parameter), and `like` is
    /// [`LightAt::zero`](crate::shading::LightAt::zero). The recurrence itself computes the other
    /// lanes, because a sine per run is cheaper than one per pixel.
    #[inline(always)]
    pub fn start(
        face: Vec3<F::One>,
        ends: [Vec3<F::One>; 2],
        [t0, dt]: [F::One; 2],
        like: F,
    ) -> Self {
        let GreatCircle {
            from,
            to,
            mut sines,
        } = GreatCircle::new(face, ends, t0, dt);
        let (mut sin, mut cos) = sines.step;
        let mut lanes = [sines; MOST];
        for lane in &mut lanes[1..F::WIDTH] {
            sines.next();
            *lane = sines;
        }
        // The step of a block: the step of a pixel, doubled log₂ `WIDTH` times by the formulas for
        // double angles.
        for _ in 0..F::WIDTH.trailing_zeros() {
            (sin, cos) = (sin * cos * 2.0, cos * cos - sin * sin);
        }
        GreatCircle {
            from: splat(from, like),
            to: splat(to, like),
            sines: Sines {
                t: (
                    like.of_each(|k| lanes[k].t.0),
                    like.of_each(|k| lanes[k].t.1),
                ),
                rest: (
                    like.of_each(|k| lanes[k].rest.0),
                    like.of_each(|k| lanes[k].rest.1),
                ),
                step: (like.of_each(|_| sin), like.of_each(|_| cos)),
            },
        }
    }
}

impl<F: Num> GreatCircle<F> {
    /// Follows `of(N)` in place of the normal N. `of` must be linear.
    #[inline(always)]
    pub fn map<V>(self, of: impl Fn(Vec3<F>) -> V) -> GreatCircle<F, V> {
        GreatCircle {
            from: of(self.from),
            to: of(self.to),
            sines: self.sines,
        }
    }
}

/// Returns a vector in all lanes of a block.
#[inline(always)]
fn splat<F: Num>(v: Vec3<F::One>, like: F) -> Vec3<F> {
    vec3([
        like.of_each(|_| v.x),
        like.of_each(|_| v.y),
        like.of_each(|_| v.z),
    ])
}

impl<F: Num, V: Values<F>> GreatCircle<F, V> {
    /// Returns the current unit normal, or the value that is linear in it.
    #[inline(always)]
    pub fn normal(&self) -> V {
        let (from, to) = (self.sines.rest.0, self.sines.t.0);
        let mut normal = self.from;
        normal.zip(self.to, |a, b| a * from + b * to); // 4.8
        normal
    }
}

impl<F: Num, V: Values<F>> Walk<F> for GreatCircle<F, V> {
    type Pixel = V;

    #[inline(always)]
    fn next(&mut self) -> V {
        let normal = self.normal();
        self.sines.next(); // 4.9–4.12
        normal
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        each(self.from, |_, value| see("from", *value));
        each(self.to, |_, value| see("to", *value));
        self.sines.inside(see);
    }
}
