//! The plan of a polygon for adaptive shading: the cheapest kind of pixel loop whose error stays within a limit in grey levels.
//!
//! N_i are the unit normals of the corners, m their mean, N = Σ b_i N_i with weights b_i ≥ 0 of sum 1, and s = max |N_i − m|². All bounds
//! hold for polygons of any number of corners, in whatever way they are interpolated.
//!
//! (a) **Length.** The variance about the mean is the least about any point:
//!
//! ```text
//! D = N·N = 1 − Σ_{i<j} b_i b_j |N_i − N_j|² = 1 − Σ b_i |N_i − N|² ≥ 1 − Σ b_i |N_i − m|² ≥ 1 − s
//! ```
//! Under perspective the interpolated vector is w N with w in [w_lo, w_hi], and its square D' in [w_lo² (1 − s), w_hi²].
//!
//! (b) **Lights in front.** J = L·N is linear in N: it is over 0 on the whole polygon if it is at all corners, and below 0 likewise. A
//! light behind all corners is left out, one in front of all needs no clamp.
//!
//! (c) **Reach of highlights.** With the symmetric matrix M = (L Vᵀ + V Lᵀ)/2 the product of J = L·N and K = V·N is a quadratic form,
//! whose least eigenvalue is (L·V − 1)/2, so that
//!
//! ```text
//! J K = Σ b_i J_i K_i − Σ_{i<j} b_i b_j (N_i − N_j)ᵀ M (N_i − N_j) ≤ max J_i K_i + s (1 − L·V)/2
//! R·V = 2 J K / D − L·V,      N·H = H·N / √D ≤ max H·N_i / √(1 − s)  where it is over 0
//! ```
//! A highlight that is nowhere brighter than a quarter of the levels, shared by the lights, is left out.
//!
//! (d) **1/√D** on [D_lo, D_hi] with middle μ, x = (D_hi − D_lo)/(D_hi + D_lo) ≤ 1/2 and y = D/μ − 1 as a polynomial of D; relative errors e:
//!
//! ```text
//! constant   2 / (√D_lo + √D_hi)                                         (√D_hi − √D_lo)/(√D_hi + √D_lo)
//! line       (1 + 3x²/16 − (1/2 + 15x²/64) y) / √μ                       (3/16) x² (1 + x + 2x²)
//! parabola   (1 − 35x⁴/1024 − (1/2 + 15x²/64) y + (3/8 + 35x²/128) y²) / √μ     (5/64) x³ (1 + x + 4x²)
//! ```
//! The constant is the best one. Line and parabola are the Taylor series 1/√(1 + y) = Σ c_k (−y)^k = 1 − y/2 + 3y²/8 − 5y³/16 + 35y⁴/128 − 63y⁵/256 …
//! up to y³ and y⁴, in which the two highest powers are replaced by those of Chebyshev's polynomials T_k(t), t = y/x. Their absolute errors are
//!
//! ```text
//! line       −(3/16) x² T_2 + (5/64) x³ T_3 − Σ_{k≥4} c_k (−y)^k
//! parabola    (5/64) x³ T_3 − (35/1024) x⁴ T_4 − Σ_{k≥5} c_k (−y)^k
//! ```
//! and the relative ones these times √(1 + y). |T_k| ≤ 1, and c_k falls with k: of the first term c_m y^m of the sum, the sum is no more than itself
//! for y ≥ 0, where signs alternate, and itself over 1 + y for y < 0. For y ≥ 0 the root is at most 1 + x/2 − x²/8 + x³/16; for y < 0 it is at most 1 in the
//! first two terms, and makes the last one c_m x^m/√(1 − x). In units of the first term, then,
//!
//! ```text
//! line       y ≥ 0: (1 + x/2) (1 + 5x/12 + 35x²/24)                       y < 0: 1 + 5x/12 + (35x²/24)/√(1 − x)
//! parabola   y ≥ 0: (1 + x/2 − x²/8 + x³/16) (1 + 7x/16 + 63x²/20)         y < 0: 1 + 7x/16 + (63x²/20)/√(1 − x)
//! ```
//! which are at most 1 + x + 2x² and 1 + x + 4x²: multiplied out, as x² ≤ x/2 and x³ ≤ x²/2.
//!
//! (e) **Colour.** A relative error e of 1/√D changes the diffuse terms by `Σ k_d min(1, max J_i/√D_lo) e`. R·V + L·V = 2 J K / D has twice
//! the relative error and lies between L·V and 1 + L·V where the highlight is; N·H has e itself. The power multiplies by n, and as
//! (1 + y/n)ⁿ − 1 ≤ e^y − 1 ≤ t for y ≤ t/(1 + t), the gain (1 + t) n holds for all errors of a highlight up to its share t:
//!
//! ```text
//! gain = k_s n (1 + t) · 2.1 max(1 + L·V, −L·V)   for R·V,      k_s n (1 + t)   for N·H
//! ```
//! (f) Three quarters of the levels are for (e) and (g), a quarter for highlights left out. The clamp of the sum makes errors smaller.
//!
//! (g) **Roundings.** Of D, J and K each step is rounded, which after k steps moves cosines by up to k 2⁻²³ as in `duff-phong`, where D is at its
//! greatest, and by D_max/D times that elsewhere; walks of kinds [`CURVED`] and [`ROOT`] start anew
//! after [`STEPS`] pixels, from sums that are off by as much as [`SETUP`] steps. With a true root
//! a run whose D falls too low for that starts anew at each pixel: then D, J and K are those of the exact kind, and so are their roundings.
//!
//! (h) **One colour** where no light crosses J = 0 (there the highlight jumps). Normals are within asin(√s/√(1 − s)) ≤ 1.1 √s of the mean
//! for s ≤ 0.1, a diffuse term changes by its angle at most, cosⁿ by at most √(n/e) < √n a radian, and R turns twice as fast as N.

use crate::number::{Num, Real, Vec3, vec3};
use crate::scene::{Place, SpecularGate, SpecularModel};
use crate::shading::light::{LightUniforms, magnitude};
use crate::shading::methods::quadratics::over_triangle::plain;
use crate::shading::{Corner, Corners, Lit};

// The kinds of polygons, in the order of the method's `Kinds`.
/// The loop of `phong-rsqrt`.
pub(crate) const EXACT: u8 = 0;
/// The colour is linear in the normal.
pub(crate) const LINEAR: u8 = 1;
/// No highlight, and all lights in front or behind: their diffuse light, linear in the normal, times a line of D for 1/√D.
pub(crate) const DULL: u8 = 2;
/// Cosines of the lights times 1/√D, which is a line or a parabola of D.
pub(crate) const CURVED: u8 = 3;
/// Cosines of the lights times a true 1/√D.
pub(crate) const ROOT: u8 = 4;

/// What a walk follows of a light beside the sum of all lights in front.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Followed {
    /// The index of the light.
    pub light: u16,
    /// True if its diffuse term is followed, as L·N changes its sign on the polygon.
    pub diffuse: bool,
    /// True if its highlight may be seen.
    pub highlight: bool,
}

/// The most lights that are followed on a polygon. More are rarely near one another, and need more registers than there are.
pub(crate) const MOST: usize = 2;

/// The pixels after which a walk starts anew.
pub(crate) const STEPS: u32 = 32;
/// The steps whose roundings a new start has: its sums are of three terms, and increments are rounded twice.
const SETUP: f32 = 8.0;
/// The roundings of a cosine in one step: 2⁻²³ (see the derivation of `duff-phong`).
const ROUNDING: f32 = 1.0 / (1u32 << 23) as f32;
/// The largest x of (d) for which lines and parabolas are taken.
pub(crate) const WIDEST: f32 = 0.5;
/// Polygons whose box has fewer pixels are not planned: it takes longer than it saves.
const LEAST_BOX: f32 = 16.0;
/// The largest s for (h).
const FLATTEST: f32 = 0.1;

/// The way to shade a polygon.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    pub kind: u8,
    /// True if the polygon has one colour: that of its mean normal.
    pub is_one_colour: bool,
    /// The lights in front of the whole polygon, a bit each: their diffuse terms are linear in the normal, and summed once.
    pub in_front: u64,
    /// The lights that are followed one by one.
    pub followed: [Followed; MOST],
    /// Of kind [`LINEAR`] the constant for 1/√D; of the polynomial kinds its coefficients; of [`ROOT`] the least share of its
    /// greatest value that D may fall to along a run whose walk starts anew only after [`STEPS`] pixels.
    pub factors: [f32; 3],
}

impl Plan {
    /// The plan that promises nothing.
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

/// Returns s of some unit normals: see (a).
pub(crate) fn spread(normals: impl ExactSizeIterator<Item = Vec3<f32>> + Clone) -> f32 {
    let share = 1.0 / normals.len() as f32;
    let mean = normals.clone().fold(vec3([0.0; 3]), |sum, n| sum + n) * share;
    let apart = normals.map(|n| (n - mean).dot(n - mean));
    apart.fold(0.0, f32::max)
}

/// Returns s with the roundings of [`spread`] and of the normals.
pub(crate) fn rounded_up(s: f32) -> f32 {
    1.000_01 * s + 2e-6
}

/// Returns the least and the greatest square of the interpolated vector, from s and the least and the greatest weight: see (a).
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
    let (at, slope) = (1.0 + 0.1875 * xx, -0.5 - 0.234_375 * xx);
    let factors = [scale * (at - slope), scale * slope / middle, 0.0];
    (factors, 0.1875 * xx * (1.0 + x + 2.0 * xx))
}

/// Returns the coefficients of a parabola for 1/√D on [`low`, `high`], and its relative error: see (d).
pub(crate) fn parabola([low, high]: [f32; 2]) -> ([f32; 3], f32) {
    let (middle, x) = (0.5 * (low + high), (high - low) / (high + low));
    let (xx, scale) = (x * x, 1.0 / Num::sqrt(middle));
    let at = 1.0 - 0.034_179_7 * xx * xx;
    let (slope, curve) = (-0.5 - 0.234_375 * xx, 0.375 + 0.273_437_5 * xx);
    let factors = [
        scale * (at - slope + curve),
        scale * (slope - 2.0 * curve) / middle,
        scale * curve / (middle * middle),
    ];
    (factors, 0.078_125 * xx * x * (1.0 + x + 4.0 * xx))
}

/// The corners of a polygon as a light sees them.
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

/// The share of the levels for approximations and roundings; highlights that are left out take the rest: see (f).
const SHARE: f32 = 0.75;

/// Plans a polygon for an error of `levels` grey levels of 255. With one light at most (`is_one`), walks follow its diffuse term, too.
pub(crate) fn plan<R: Real>(
    levels: f32,
    is_one: bool,
    lit: &Lit<'_, R>,
    polygon: &Corners<'_, R>,
) -> Plan {
    let outline = Outline::of(polygon.all);
    if !outline.is_worth_planning() {
        return Plan::EXACT;
    }
    let spread = spread(polygon.whole.iter().map(|n| plain(*n)));
    let s = rounded_up(spread);
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

/// The box of a polygon on the picture, in pixels, and the least and greatest weight of its corners.
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

/// The light on a polygon: what its plan has to follow, and by how much errors grow.
struct Illumination {
    /// The lights in front of the whole polygon: see [`Plan::in_front`].
    in_front: u64,
    /// The lights that are followed one by one: the first [`MOST`] of `count`.
    followed: [Followed; MOST],
    count: usize,
    /// True if a light crosses or touches J = 0.
    is_crossed: bool,
    /// The grey levels that a relative error of 1/√D is multiplied by: in diffuse terms, and in highlights.
    diffuse: f32,
    gain: f32,
    /// The grey levels per radian that the normal turns.
    steep: f32,
    /// The exponent.
    shininess: f32,
}

impl Illumination {
    /// Returns the light on a polygon whose normals have the spread `s`; `None` where light is not planned for.
    fn of<R: Real>(
        levels: f32,
        lit: &Lit<'_, R>,
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
            all.diffuse += k_d * f32::min(1.0, seen.high * over_low);
            let turns = if is_halfway { 1.0 } else { 2.0 };
            all.steep += k_d + k_s * turns * Num::sqrt(n);
            let shines = k_s > 0.0 && {
                let reach = reach(light, &seen, s, is_halfway).clamp(0.0, 1.0);
                k_s * model.exponent.of(reach) * lights.len() as f32 > 0.25 * levels
            };
            if shines {
                let l_v = light.l_v;
                let of_cosine = match is_halfway {
                    true => 1.0,
                    false => 2.1 * f32::max(1.0 + l_v, -l_v),
                };
                all.gain += match n >= 1.0 {
                    true => k_s * n * (1.0 + room / k_s) * of_cosine,
                    false => f32::INFINITY, // infinitely steep at 0
                };
            }
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

    /// True if colours differ by at most `levels` from that of the mean normal, from which normals turn by at most `turn`: see (h).
    fn is_one_colour(&self, turn: f32, levels: f32) -> bool {
        let is_steady = turn == 0.0 || self.shininess >= 1.0 && turn * self.steep <= levels;
        !self.is_crossed && is_steady
    }
}

/// Chooses the kind of a polygon without highlights and its factors, if an error of `room` levels has room for one of these kinds.
/// D lies in `range`; `gain` is what a relative error of 1/√D is multiplied by.
fn dull(range: [f32; 2], width: f32, gain: f32, room: f32) -> Option<(u8, [f32; 3])> {
    let [low, high] = range.map(Num::sqrt);
    let error = (high - low) / (high + low) + ROUNDING * width;
    if gain * error <= room {
        return Some((LINEAR, [2.0 / (low + high), 0.0, 0.0]));
    }
    let [low, high] = range;
    let (factors, error) = line(range);
    // The line's own steps are rounded, too; its value is at most 1/√low.
    let error = error + 2.0 * ROUNDING * width * high / low;
    (is_narrow(range) && gain * error <= room).then_some((DULL, factors))
}

/// Chooses the kind of a polygon with lights that are followed, and its factors, as [`dull`] does.
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
    // A share that is NaN fails the comparison.
    let share = ROUNDING * steps * gain / room;
    (share < 0.5).then_some((ROOT, [share, 0.0, 0.0]))
}

/// True if lines and parabolas may be taken for 1/√D on a range: see (d).
fn is_narrow([low, high]: [f32; 2]) -> bool {
    high - low <= WIDEST * (high + low)
}

/// Returns the greatest cosine of a light's highlight on a polygon, or a value over 1 where it is unknown: see (c).
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

    /// Returns the largest relative error of a polynomial for 1/√D on a range: at its ends, or where the derivative of p √D is 0, which is where
    /// k_0 + 3 k_1 D + 5 k_2 D² is.
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

    /// Lines and parabolas for 1/√D are as near as stated on every range that they are taken for, and nearly as far somewhere.
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
