//! Meshes by formula: any resolution, shared positions, outward counter-clockwise polygons, unit normals.
//!
//! Computed in `f64` and rounded once, with `libm`, so that every platform makes the same mesh bit for bit. Closed shapes
//! share their positions across seams and at poles. Resolutions below the least that makes sense are raised to it.
//! Every function fails only with [`MeshError::TooLarge`](super::MeshError::TooLarge), before memory is taken, or
//! with [`MeshError::NotFinite`](super::MeshError::NotFinite) when a size is no finite number in `f32`.

mod flat;
mod grid;
mod noise;
mod sheet;
mod solid;
mod sphere;
mod superellipsoid;
mod teapot;
pub(in crate::mesh) mod teapot_data;
mod torus;

pub use flat::{comb, figure5, letters, polygon, star, triangle};
pub use grid::{ParameterGrid, Topology};
pub use sheet::{Terrain, corrugated, terrain};
pub use solid::{cube, gear, prism};
pub use sphere::{bumpy, sphere};
pub use superellipsoid::superellipsoid;
pub use teapot::{teapot, teapot_polygons};
pub use torus::{knot, torus};

use alloc::vec::Vec;
use core::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// Returns sine and cosine of `k / n` of a full turn, exact at quarter turns and symmetric between them.
fn turn(k: usize, n: usize) -> (f64, f64) {
    // 4k/n quarter turns: the whole ones, and the rest in n-ths of a quarter.
    let quarters = 4 * (k % n) as u64;
    let n = n as u64;
    let (quarter, rest) = (quarters / n, quarters % n);
    let angle = |rest: u64| rest as f64 / n as f64 * FRAC_PI_2;
    // Above the eighth turn by the complement, so that both sides of it have the same bits.
    let (sin, cos) = if 2 * rest == n {
        (FRAC_1_SQRT_2, FRAC_1_SQRT_2)
    } else if 2 * rest < n {
        (libm::sin(angle(rest)), libm::cos(angle(rest)))
    } else {
        (libm::cos(angle(n - rest)), libm::sin(angle(n - rest)))
    };
    match quarter {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Returns all `n` of [`turn`].
fn turns(n: usize) -> Vec<(f64, f64)> {
    (0..n).map(|k| turn(k, n)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_exact_at_quarters_and_close_between() {
        assert_eq!(turns(4), [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]);
        for n in 1..60 {
            for (k, (sin, cos)) in turns(n).into_iter().enumerate() {
                let angle = k as f64 / n as f64 * 4.0 * FRAC_PI_2;
                // The angle is rounded at most 3 times at up to 2π, sine and cosine once more: 2π · 4 · ε/2.
                assert!(
                    (sin - libm::sin(angle)).abs() < 13.0 * f64::EPSILON,
                    "sin {k}/{n}"
                );
                assert!(
                    (cos - libm::cos(angle)).abs() < 13.0 * f64::EPSILON,
                    "cos {k}/{n}"
                );
                let (mirrored, _) = turn(n - k, n);
                assert_eq!(mirrored, -sin, "{k}/{n}");
            }
        }
    }
}
