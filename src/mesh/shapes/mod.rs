//! Meshes by formula, at any resolution, with polygons that are counter-clockwise seen from outside
//! and with unit normals.
//!
//! Coordinates are computed in `f64` with `libm` and rounded once, so that every platform makes the
//! same mesh bit for bit. Closed shapes share their positions across seams and at poles. A
//! resolution that is too low is raised to the lowest that makes sense. The only errors are
//! [`MeshError::TooLarge`](super::MeshError::TooLarge), before any memory is allocated, and
//! [`MeshError::NotFinite`](super::MeshError::NotFinite) if a size is not finite in `f32`.

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

/// Returns the sine and cosine of `k / n` of a full turn. They are exact at quarter turns and
/// symmetric between them.
fn turn(k: usize, n: usize) -> (f64, f64) {
    // 4k/n quarter turns are `quarter` whole ones and `rest` n-ths of another one.
    let quarters = 4 * (k % n) as u64;
    let n = n as u64;
    let (quarter, rest) = (quarters / n, quarters % n);
    let angle = |rest: u64| rest as f64 / n as f64 * FRAC_PI_2;
    // Above an eighth of a turn the complementary angle is used, so that both sides of the eighth
    // have equal bits.
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

/// Returns [`turn`] for all `k` below `n`.
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
                // The angle, up to 2π, is rounded at most 3 times, and sine and cosine once more:
                // 2π · 4 · ε/2.
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
