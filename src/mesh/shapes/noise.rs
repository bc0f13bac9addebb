//! Gradient noise with its derivatives. Its values are equal on every platform.

use crate::number::split_mix::SplitMix;
use glam::DVec2;

/// Returns the value of Perlin's gradient noise at `p`, between −1 and 1, and its gradient, which
/// is continuous and differentiable.
///
/// It follows K. Perlin, *Improving noise*, SIGGRAPH 2002 (the fifth-degree fade). Gradients come
/// from [`SplitMix`] instead of a table.
pub(super) fn gradient_noise(p: DVec2, seed: u64) -> (f64, DVec2) {
    let cell = DVec2::new(libm::floor(p.x), libm::floor(p.y));
    let f = p - cell;
    let corner = |i: f64, j: f64| {
        let gradient = lattice_gradient(cell.x + i, cell.y + j, seed);
        (gradient.dot(f - DVec2::new(i, j)), gradient)
    };
    let [(a, ga), (b, gb), (c, gc), (d, gd)] = [
        corner(0.0, 0.0),
        corner(1.0, 0.0),
        corner(0.0, 1.0),
        corner(1.0, 1.0),
    ];
    // 6t⁵ − 15t⁴ + 10t³ and its derivative. The first two derivatives vanish at 0 and 1, so that
    // cells join smoothly.
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let slope = |t: f64| 30.0 * t * t * (t - 1.0) * (t - 1.0);
    let (u, v) = (fade(f.x), fade(f.y));
    let twist = a - b - c + d;
    let value = a + u * (b - a) + v * (c - a) + u * v * twist;
    let gradient = ga
        + u * (gb - ga)
        + v * (gc - ga)
        + u * v * (ga - gb - gc + gd)
        + DVec2::new(
            slope(f.x) * (b - a + v * twist),
            slope(f.y) * (c - a + u * twist),
        );
    (value, gradient)
}

/// Returns the sum of `octaves` octaves of [`gradient_noise`]. Each has twice the frequency and
/// half the height of the previous one.
pub(super) fn fractal_noise(p: DVec2, octaves: usize, seed: u64) -> (f64, DVec2) {
    let (mut value, mut gradient) = (0.0, DVec2::ZERO);
    let (mut frequency, mut height) = (1.0, 1.0);
    for octave in 0..octaves {
        let (v, g) = gradient_noise(p * frequency, seed.wrapping_add((octave as u64) << 32));
        value += height * v;
        gradient += height * frequency * g;
        frequency *= 2.0;
        height *= 0.5;
    }
    (value, gradient)
}

/// Returns the gradient at a lattice point, with components in −1..1.
fn lattice_gradient(i: f64, j: f64, seed: u64) -> DVec2 {
    let hash = |seed| SplitMix(seed).next();
    let bits = hash(hash(hash(seed) ^ i as i64 as u64) ^ j as i64 as u64);
    let component = |bits: u64| bits as u32 as f64 / (1u64 << 31) as f64 - 1.0;
    DVec2::new(component(bits), component(bits >> 32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_is_the_derivative() {
        // A central difference at h is off by h²/6 times the third derivative, plus rounding ε/h.
        // The third derivative is below 2e3 at the highest octave's 8 per unit, where the fade's is
        // 60 · 8³ · 2⁻³. At h = 1e-5 both together stay below 1e-6.
        let h = 1e-5;
        for k in 0..200 {
            let p = DVec2::new(0.37 * k as f64 - 31.0, 0.23 * k as f64 - 11.0);
            let (_, gradient) = fractal_noise(p, 4, 7);
            let difference = |d: DVec2| {
                (fractal_noise(p + d, 4, 7).0 - fractal_noise(p - d, 4, 7).0) / (2.0 * h)
            };
            let numeric = DVec2::new(difference(DVec2::X * h), difference(DVec2::Y * h));
            assert!(
                (numeric - gradient).length() < 1e-6,
                "{p}: {numeric} {gradient}"
            );
        }
    }

    #[test]
    fn seeds_differ_and_values_stay_inside() {
        let p = DVec2::new(0.3, 0.6);
        assert_ne!(gradient_noise(p, 1).0, gradient_noise(p, 2).0);
        for k in 0..1000 {
            assert!(
                gradient_noise(DVec2::new(0.171 * k as f64, 0.059 * k as f64), 3)
                    .0
                    .abs()
                    < 1.0
            );
        }
        // Gradient noise is zero at the lattice points.
        assert_eq!(gradient_noise(DVec2::new(-3.0, 5.0), 9).0, 0.0);
    }
}
