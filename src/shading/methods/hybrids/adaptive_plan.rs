//! The plan of a polygon for adaptive shading: the cheapest kind of pixel loop whose error stays
//! within a limit in grey levels.
//!
//! N_i are the unit normals of the corners, m their mean, N = Σ b_i N_i with weights b_i ≥ 0 of sum
//! 1, and s = max |N_i − m|². All bounds hold for polygons with any count of corners, however they
//! are interpolated.
//!
//! (a) **Length.** The variance about the mean is the least about any point, so
//!
//! ```text
//! D = N·N = 1 − Σ_{i<j} b_i b_j |N_i − N_j|² = 1 − Σ b_i |N_i − N|² ≥ 1 − Σ b_i |N_i − m|² ≥ 1 − s
//! ```
//! Under perspective the interpolated vector is w N with w in [w_lo, w_hi], and its square D' in
//! [w_lo² (1 − s), w_hi²].
//!
//! (b) **Lights in front.** J = L·N is linear in N. If it is over 0 at all corners it is over 0 on
//! the whole polygon, and if it is below 0 at all corners it is below 0 on the whole polygon. A
//! light behind all corners is left out; one in front of all needs no clamp.
//!
//! (c) **Reach of highlights.** With the symmetric matrix M = (L Vᵀ + V Lᵀ)/2, the product of J =
//! L·N and K = V·N is a quadratic form with the least eigenvalue (L·V − 1)/2, so
//!
//! ```text
//! J K = Σ b_i J_i K_i − Σ_{i<j} b_i b_j (N_i − N_j)ᵀ M (N_i − N_j) ≤ max J_i K_i + s (1 − L·V)/2
//! R·V = 2 J K / D − L·V,      N·H = H·N / √D ≤ max H·N_i / √(1 − s)  where it is over 0
//! ```
//! A highlight that is nowhere brighter than a quarter of the levels, divided by the count of
//! lights, is left out.
//!
//! (d) **1/√D** on [D_lo, D_hi] as a polynomial of D, with middle μ, x = (D_hi − D_lo)/(D_hi +
//! D_lo) ≤ 1/2 and y = D/μ − 1; relative errors e:
//!
//! ```text
//! constant   2 / (√D_lo + √D_hi)                                         (√D_hi − √D_lo)/(√D_hi + √D_lo)
//! line       (1 + 3x²/16 − (1/2 + 15x²/64) y) / √μ                       (3/16) x² (1 + x + 2x²)
//! parabola   (1 − 35x⁴/1024 − (1/2 + 15x²/64) y + (3/8 + 35x²/128) y²) / √μ     (5/64) x³ (1 + x + 4x²)
//! ```
//! The constant is the best one. Line and parabola are the Taylor series 1/√(1 + y) = Σ c_k (−y)^k
//! = 1 − y/2 + 3y²/8 − 5y³/16 + 35y⁴/128 − 63y⁵/256 … up to y³ and y⁴, with the two highest powers
//! replaced by those of Chebyshev's polynomials T_k(t), t = y/x. Their absolute errors are
//!
//! ```text
//! line       −(3/16) x² T_2 + (5/64) x³ T_3 − Σ_{k≥4} c_k (−y)^k
//! parabola    (5/64) x³ T_3 − (35/1024) x⁴ T_4 − Σ_{k≥5} c_k (−y)^k
//! ```
//! and the relative ones are these times √(1 + y). |T_k| ≤ 1, and c_k falls with k. Let c_m y^m be
//! the first term of the sum. For y ≥ 0, where signs alternate, the sum is at most this term; for y
//! < 0 it is at most this term over 1 + y. For y ≥ 0 the root is at most 1 + x/2 − x²/8 + x³/16.
//! For y < 0 the root is at most 1 in the first two terms, and makes the last one c_m x^m/√(1 − x).
//! In units of the first term, then,
//!
//! ```text
//! line       y ≥ 0: (1 + x/2) (1 + 5x/12 + 35x²/24)                       y < 0: 1 + 5x/12 + (35x²/24)/√(1 − x)
//! parabola   y ≥ 0: (1 + x/2 − x²/8 + x³/16) (1 + 7x/16 + 63x²/20)         y < 0: 1 + 7x/16 + (63x²/20)/√(1 − x)
//! ```
//! which are at most 1 + x + 2x² and 1 + x + 4x²: multiply out, and use x² ≤ x/2 and x³ ≤ x²/2.
//!
//! (e) **Colour.** A relative error e of 1/√D changes the diffuse terms by
//! `Σ k_d min(1, max J_i/√D_lo) e`. R·V + L·V = 2 J K / D has twice the relative error and lies
//! between L·V and 1 + L·V where the highlight is; N·H has e itself. The power multiplies by n. As
//! (1 + y/n)ⁿ − 1 ≤ e^y − 1 ≤ t for y ≤ t/(1 + t), the gain (1 + t) n holds for all errors of a
//! highlight up to its share t:
//!
//! ```text
//! gain = k_s n (1 + t) · 2.1 max(1 + L·V, −L·V)   for R·V,      k_s n (1 + t)   for N·H
//! ```
//! (f) **Shares.** Three quarters of the levels are for (e) and (g), a quarter for highlights that
//! are left out. The clamp of the sum makes errors smaller.
//!
//! (g) **Roundings.** Each step rounds D, J and K. After k steps this moves cosines by up to k
//! 2⁻²³, as in `duff-phong`, where D is at its greatest, and by D_max/D times as much elsewhere.
//! Walks of the kinds [`CURVED`] and [`ROOT`] restart after [`STEPS`] pixels, from sums whose error
//! is that of [`SETUP`] steps. With a true root, a run whose D falls too low for that restarts at
//! each pixel: D, J and K are then those of the exact kind, with its roundings.
//!
//! (h) **One colour** where no light crosses J = 0 (there the highlight jumps). Normals are within
//! asin(√s/√(1 − s)) ≤ 1.1 √s of the mean for s ≤ 0.1. A diffuse term changes by at most its angle,
//! cosⁿ by at most √(n/e) < √n per radian, and R turns twice as fast as N.

use crate::number::{Num, Real, Vec3, vec3};
use crate::scene::{Place, SpecularGate, SpecularModel};
use crate::shading::light::{LightUniforms, magnitude};
use crate::shading::methods::quadratics::over_triangle::plain;
use crate::shading::{Corner, Corners, LightAt};

// The kinds of polygons, in the order of the method's `Kinds`.
/// The loop of `phong-rsqrt`.
pub(crate) const EXACT: u8 = 0;
/// The colour is linear in the normal.
pub(crate) const LINEAR: u8 = 1;
/// No highlight, and every light is in front or behind: the diffuse light is linear in the normal,
/// times a line in D for 1/√D.
pub(crate) const DULL: u8 = 2;
/// The cosines of the followed lights, times a line or a parabola in D for 1/√D.
pub(crate) const CURVED: u8 = 3;
/// The cosines of the followed lights, times a true 1/√D.
pub(crate) const ROOT: u8 = 4;

/// The terms of a light that a walk follows, beside the sum of all lights in front.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Followed {
    /// The index of the light.
    pub light: u16,
    /// True if the diffuse term is followed, because L·N changes its sign on the polygon.
    pub diffuse: bool,
    /// True if the highlight may be seen.
    pub highlight: bool,
}

/// The most lights that are followed on a polygon. More lights are rarely near one another, and
/// would need more registers than there are.
pub(crate) const MOST: usize = 2;

/// How many pixels lie between two restarts of a walk.
pub(crate) const STEPS: u32 = 32;
/// The steps that would have as many roundings as a restart: its sums have three terms, and
/// increments are rounded twice.
const SETUP: f32 = 8.0;
/// The roundings of a cosine in one step: 2⁻²³ (see the derivation of `duff-phong`).
const ROUNDING: f32 = 1.0 / (1u32 << 23) as f32;
/// The largest x of (d) for which lines and parabolas are used.
pub(crate) const WIDEST: f32 = 0.5;
/// The least count of pixels in a polygon's box for which planning pays.
const LEAST_BOX: f32 = 16.0;
/// The largest s for (h).
const FLATTEST: f32 = 0.1;

/// The chosen way to shade a polygon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    pub kind: u8,
    /// True if the whole polygon has the colour of its mean normal.
    pub is_one_colour: bool,
    /// The lights in front of the whole polygon, one bit each. Their diffuse terms are linear in
    /// the normal, and summed once.
    pub in_front: u64,
    /// The lights that are followed one by one.
    pub followed: [Followed; MOST],
    /// For [`LINEAR`] the constant in place of 1/√D; for the kinds with polynomials their
    /// coefficients; for [`ROOT`] the least share of its greatest value that D may fall to along a
    /// run that restarts only after [`STEPS`] pixels.
    pub factors: [f32; 3],
}

impl Plan {
    /// The plan without an approximation.
    pub const EXACT: Plan = Plan {
        kind: EXACT,
        is_one_colour: false,
        in_front: 0,
        followed: [Followed {
            light: 0,
            diffuse: false,
            highlight: false,
        }; MOST],
        factors: [0.0; 3],
    };
}

/// Returns s of unit normals: see (a).
pub(crate) fn spread(normals: impl ExactSizeIterator<Item = Vec3<f32>> + Clone) -> f32 {
    let share = 1.0 / normals.len() as f32;
    let mean = normals.clone().fold(vec3([0.0; 3]), |sum, n| sum + n) * share;
    let apart = normals.map(|n| (n - mean).dot(n - mean));
    apart.fold(0.0, f32::max)
}

/// Returns s, increased by the roundings of [`spread`] and of the normals.
pub(crate) fn rounded_up(s: f32) -> f32 {
    1.000_01 * s + 2e-6
}

/// Returns the least and the greatest square of the interpolated vector, from s and the least and
/// greatest weights: see (a).
pub(crate) fn squares(s: f32, [light, heavy]: [f32; 2]) -> [f32; 2] {
    [
        f32::max(1.0 - s, 0.0) * light * light,
        heavy * heavy * 1.000_001,
    ]
}

/// Returns the coefficients of a line for 1/√D on [`low`, `high`], and its relative error: see (d).
pub(crate) fn line([low, high]: [f32; 2]) -> ([f32; 3], f32) {
    let (middle, x) = (0.5 * (low + high), (high - low) / (high + low));
    let (xx, scale) = (x * x, 1.0 / Num::sqrt(middle));
    // A line in u = D/middle − 1; `factors` are for D itself.
    let (at, slope) = (1.0 + 0.1875 * xx, -0.5 - 0.234_375 * xx);
    let factors = [scale * (at - slope), scale * slope / middle, 0.0];
    (factors, 0.1875 * xx * (1.0 + x + 2.0 * xx))
}

/// Returns the coefficients of a parabola for 1/√D on [`low`, `high`], and its relative error: see
/// (d).
pub(crate) fn parabola([low, high]: [f32; 2]) -> ([f32; 3], f32) {
    let (middle, x) = (0.5 * (low + high), (high - low) / (high + low));
    let (xx, scale) = (x * x, 1.0 / Num::sqrt(middle));
    let at = 1.0 - 0.034_179_7 * xx * xx;
    // A parabola in u = D/middle − 1; `factors` are for D itself.
    let (slope, curve) = (-0.5 - 0.234_375 * xx, 0.375 + 0.273_437_5 * xx);
    let factors = [
        scale * (at - slope + curve),
        scale * (slope - 2.0 * curve) / middle,
        scale * curve / (middle * middle),
    ];
    (factors, 0.078_125 * xx * x * (1.0 + x + 4.0 * xx))
}

/// The cosines at the corners of a polygon, for one light.
struct Seen {
    /// The least and the greatest L·N.
    low: f32,
    high: f32,
    /// The greatest product (L·N)(V·N), and the greatest sum of both.
    product: f32,
    sum: f32,
}

fn seen<R: Real>(corners: &[Vec3<R>], to: Vec3<f32>, view: Vec3<f32>) -> Seen {
    let most = f32::NEG_INFINITY;
    let mut seen = Seen {
        low: f32::INFINITY,
        high: most,
        product: most,
        sum: most,
    };
    for n in corners {
        let n = plain(*n);
        let (j, k) = (n.dot(to), n.dot(view));
        seen.low = f32::min(seen.low, j);
        seen.high = f32::max(seen.high, j);
        seen.product = f32::max(seen.product, j * k);
        seen.sum = f32::max(seen.sum, j + k);
    }
    seen
}

/// The share of the levels for approximations and roundings. Highlights that are left out have the
/// rest: see (f).
const SHARE: f32 = 0.75;

/// Plans a polygon for an error of `levels` grey levels of 255. If there is at most one light
/// (`is_one`), walks follow its diffuse term too.
pub(crate) fn plan<R: Real>(
    levels: f32,
    is_one: bool,
    lit: &LightAt<'_, R>,
    polygon: &Corners<'_, R>,
) -> Plan {
    let outline = Outline::of(polygon.all);
    if !outline.is_worth_planning() {
        return Plan::EXACT;
    }
    let spread = spread(polygon.whole.iter().map(|n| plain(*n)));
    let s = rounded_up(spread);
    // Written so that NaN is refused, too.
    if !(s < 5.0 && outline.weights[0] > 0.0) {
        return Plan::EXACT;
    }
    let Some(light) = Illumination::of(levels, lit, polygon.whole, s) else {
        return Plan::EXACT;
    };
    let plan = Plan {
        in_front: light.in_front,
        followed: light.followed,
        ..Plan::EXACT
    };
    let turn = 1.1 * Num::sqrt(spread); // see (h)
    if light.is_one_colour(turn, levels) && s <= FLATTEST {
        return Plan {
            is_one_colour: true,
            kind: LINEAR,
            ..plan
        };
    }
    let (range, room) = (squares(s, outline.weights), SHARE * levels);
    let dull = (light.count == 0).then(|| dull(range, outline.width, light.diffuse, room));
    if let Some((kind, factors)) = dull.flatten() {
        return Plan {
            kind,
            factors,
            ..plan
        };
    }
    if light.count > MOST {
        return Plan::EXACT;
    }
    let Some((kind, factors)) = shining(range, outline.width, light.diffuse + light.gain, room)
    else {
        return Plan::EXACT;
    };
    let mut plan = Plan {
        kind,
        factors,
        ..plan
    };
    if is_one {
        plan.followed[0].diffuse = !lit.stored.is_empty();
        plan.in_front = 0;
    }
    plan
}

/// The box of a polygon in the picture, in pixels, and the least and greatest weights of its
/// corners.
struct Outline {
    width: f32,
    height: f32,
    weights: [f32; 2],
}

impl Outline {
    fn of<R: Real>(corners: &[Corner<R>]) -> Outline {
        let mut ranges = [[f32::INFINITY, f32::NEG_INFINITY]; 3];
        for corner in corners {
            let [x, y] = corner.place;
            for ([low, high], value) in ranges.iter_mut().zip([x, y, corner.weight]) {
                *low = f32::min(*low, value.value());
                *high = f32::max(*high, value.value());
            }
        }
        let [x, y, weights] = ranges;
        Outline {
            width: x[1] - x[0],
            height: y[1] - y[0],
            weights,
        }
    }

    fn is_worth_planning(&self) -> bool {
        self.width * self.height >= LEAST_BOX
    }
}

/// The light on a polygon: which terms its plan must follow, and by how much they multiply errors.
struct Illumination {
    /// The lights in front of the whole polygon: see [`Plan::in_front`].
    in_front: u64,
    /// The lights that are followed one by one: the first [`MOST`] of `count` lights.
    followed: [Followed; MOST],
    count: usize,
    /// True if J of a light crosses or touches 0.
    is_crossed: bool,
    /// The grey levels by which a relative error of 1/√D is multiplied: in diffuse terms, and in
    /// highlights.
    diffuse: f32,
    gain: f32,
    /// How many grey levels a radian's turn of the normal changes.
    steep: f32,
    /// The exponent.
    shininess: f32,
}

impl Illumination {
    /// Returns the light on a polygon whose normals have the spread `s`; `None` if plans do not
    /// support it.
    fn of<R: Real>(
        levels: f32,
        lit: &LightAt<'_, R>,
        corners: &[Vec3<R>],
        s: f32,
    ) -> Option<Illumination> {
        let (model, lights) = (lit.model, lit.stored);
        if model.gate != SpecularGate::Gated || !model.exponent.is_power() {
            return None;
        }
        let view = direction(model.eye)?;
        let (to_levels, room) = (255.0 / model.scale, SHARE * levels);
        let over_low = 1.0 / Num::sqrt(f32::max(1.0 - s, 0.0)); // infinite where normals may cancel
        let n = model.shininess;
        let is_halfway = model.specular == SpecularModel::Blinn;
        let mut all = Illumination {
            in_front: 0,
            followed: Plan::EXACT.followed,
            count: 0,
            is_crossed: false,
            diffuse: 0.0,
            gain: 0.0,
            steep: 0.0,
            shininess: n,
        };
        for (i, light) in lights.iter().enumerate() {
            let seen = seen(corners, direction(light.place)?, view);
            if seen.high <= 0.0 {
                continue;
            }
            let is_crossing = seen.low < 0.0;
            all.is_crossed |= is_crossing || seen.low == 0.0;
            let k_d = magnitude(light.diffuse) * to_levels;
            let k_s = magnitude(light.specular) * to_levels;
            // See (e).
            all.diffuse += k_d * f32::min(1.0, seen.high * over_low);
            let turns = if is_halfway { 1.0 } else { 2.0 };
            all.steep += k_d + k_s * turns * Num::sqrt(n);
            // A quarter of the levels, divided by the count of lights: see (c).
            let shines = k_s > 0.0 && {
                let reach = reach(light, &seen, s, is_halfway).clamp(0.0, 1.0);
                k_s * model.exponent.of(reach) * lights.len() as f32 > 0.25 * levels
            };
            if shines {
                let l_v = light.l_v;
                let of_cosine = if is_halfway {
                    1.0
                } else {
                    2.1 * f32::max(1.0 + l_v, -l_v)
                };
                all.gain += if n >= 1.0 {
                    k_s * n * (1.0 + room / k_s) * of_cosine
                } else {
                    f32::INFINITY // infinitely steep at 0
                };
            }
            // A material has at most 64 lights, so each has its bit.
            all.in_front |= u64::from(!is_crossing) << i;
            if is_crossing || shines {
                if let Some(place) = all.followed.get_mut(all.count) {
                    *place = Followed {
                        light: i as u16,
                        diffuse: is_crossing,
                        highlight: shines,
                    };
                }
                all.count += 1;
            }
        }
        Some(all)
    }

    /// True if colours differ by at most `levels` from the colour of the mean normal, where normals
    /// are within `turn` radians of it: see (h).
    fn is_one_colour(&self, turn: f32, levels: f32) -> bool {
        let is_steady = turn == 0.0 || self.shininess >= 1.0 && turn * self.steep <= levels;
        !self.is_crossed && is_steady
    }
}

/// Chooses the kind and factors of a polygon without highlights; `None` if the error of each kind
/// exceeds `room` levels. D lies in `range`; `gain` multiplies a relative error of 1/√D.
fn dull(range: [f32; 2], width: f32, gain: f32, room: f32) -> Option<(u8, [f32; 3])> {
    let [low, high] = range.map(Num::sqrt);
    let error = (high - low) / (high + low) + ROUNDING * width;
    if gain * error <= room {
        return Some((LINEAR, [2.0 / (low + high), 0.0, 0.0]));
    }
    let [low, high] = range;
    let (factors, error) = line(range);
    // The line's own steps are rounded too; its value is at most 1/√low.
    let error = error + 2.0 * ROUNDING * width * high / low;
    (is_narrow(range) && gain * error <= room).then_some((DULL, factors))
}

/// Chooses the kind and factors of a polygon with followed lights, as [`dull`] does.
fn shining(range: [f32; 2], width: f32, gain: f32, room: f32) -> Option<(u8, [f32; 3])> {
    let [low, high] = range;
    let steps = f32::min(width, STEPS as f32) + SETUP;
    let rounding = ROUNDING * steps * high;
    if is_narrow(range) {
        for (factors, error) in [line(range), parabola(range)] {
            if gain * (error + rounding / low) <= room {
                return Some((CURVED, factors));
            }
        }
    }
    // If `share` is NaN, the comparison is false.
    let share = ROUNDING * steps * gain / room;
    (share < 0.5).then_some((ROOT, [share, 0.0, 0.0]))
}

/// True if lines and parabolas may replace 1/√D on a range: see (d).
fn is_narrow([low, high]: [f32; 2]) -> bool {
    high - low <= WIDEST * (high + low)
}

/// Returns the greatest cosine of a light's highlight on a polygon, or a value over 1 where no
/// bound is known: see (c).
fn reach(light: &LightUniforms, seen: &Seen, s: f32, is_halfway: bool) -> f32 {
    const ROUNDINGS: f32 = 2e-6;
    let low = f32::max(1.0 - s, f32::MIN_POSITIVE);
    if is_halfway {
        return ROUNDINGS + seen.sum * light.half / Num::sqrt(low);
    }
    let most = 2.0 * seen.product + (1.0 - light.l_v) * s;
    let over = if most > 0.0 { most / low } else { most };
    ROUNDINGS + over - light.l_v
}

/// Returns a direction; `None` for a position.
fn direction(place: Place<Vec3<f32>>) -> Option<Vec3<f32>> {
    match place {
        Place::Infinite(v) => Some(v),
        Place::Local(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the largest relative error of a polynomial for 1/√D on a range: at its ends, or
    /// where the derivative of p √D is 0, which is where k_0 + 3 k_1 D + 5 k_2 D² = 0.
    fn largest_error(factors: [f32; 3], range: [f32; 2]) -> f64 {
        let [k_0, k_1, k_2] = factors.map(f64::from);
        let [low, high] = range.map(f64::from);
        let extremes = match k_2 {
            0.0 => [-k_0 / (3.0 * k_1); 2],
            _ => {
                let root = (9.0 * k_1 * k_1 - 20.0 * k_0 * k_2).sqrt();
                [-1.0, 1.0].map(|sign| (sign * root - 3.0 * k_1) / (10.0 * k_2))
            }
        };
        let inside = extremes.into_iter().filter(|d| (low..high).contains(d));
        let error = |d: f64| ((k_0 + d * (k_1 + d * k_2)) * d.sqrt() - 1.0).abs();
        inside.chain([low, high]).map(error).fold(0.0, f64::max)
    }

    /// Lines and parabolas for 1/√D keep within their stated errors on every range for which they
    /// are used, and come near them somewhere.
    #[test]
    fn polynomials_are_within_their_errors() {
        for step in 1..=1000 {
            let x = f64::from(WIDEST) * f64::from(step) / 1000.0;
            let range = [1.0 - x, 1.0 + x].map(|d| 0.7 * d as f32);
            for (name, (factors, stated)) in [("line", line(range)), ("parabola", parabola(range))]
            {
                let (most, stated) = (largest_error(factors, range), f64::from(stated));
                // Coefficients of at most 4 are rounded to 2⁻²³ each.
                let roundings = 1e-6;
                assert!(
                    most <= stated + roundings,
                    "{name}, x = {x}: {most} over {stated}"
                );
                assert!(
                    most >= 0.6 * stated - roundings,
                    "{name}, x = {x}: {most} of {stated}"
                );
            }
        }
    }
}
