//! Perspective in the formulas of L5: depth and interpolation.
//!
//! L5 looks along −z: visible points have a z below 0, from −near to −far. Its cube of normalised
//! device coordinates (NDC) reaches from −1 to 1 along all axes.
//! [`Camera::clip_matrix`](crate::scene::Camera::clip_matrix) is the same matrix, turned to where
//! the camera looks, with depths from 0 to 1.

#[cfg(test)]
use glam::{DMat4, DVec4};

/// A view frustum: its sides at the near plane, and the distances of both planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Left side, l.
    pub left: f64,
    /// Right side, r, over `left`.
    pub right: f64,
    /// Lower side, b.
    pub bottom: f64,
    /// Upper side, t, over `bottom`.
    pub top: f64,
    /// Distance of the near plane, n, over 0.
    pub near: f64,
    /// Distance of the far plane, f, over `near`.
    pub far: f64,
}

impl Frustum {
    /// Returns the perspective transform, from camera coordinates to the cube times w. Tests
    /// compare the camera's matrix with it:
    /// ```text
    /// [ 2n/(r−l)     0       (r+l)/(r−l)        0       ]
    /// [    0      2n/(t−b)   (t+b)/(t−b)        0       ]
    /// [    0         0      −(f+n)/(f−n)   −2fn/(f−n)   ]
    /// [    0         0           −1             0       ]      (L5, Recall Perspective Transform)
    /// ```
    #[cfg(test)]
    pub fn matrix(&self) -> DMat4 {
        let Frustum {
            left: l,
            right: r,
            bottom: b,
            top: t,
            near: n,
            far: f,
        } = *self;
        let rows = [
            DVec4::new(2.0 * n / (r - l), 0.0, (r + l) / (r - l), 0.0),
            DVec4::new(0.0, 2.0 * n / (t - b), (t + b) / (t - b), 0.0),
            DVec4::new(0.0, 0.0, -(f + n) / (f - n), -2.0 * f * n / (f - n)),
            -DVec4::Z,
        ];
        DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
    }

    /// Maps a depth z, −far..=−near, to NDC:
    /// ```text
    /// z ↦ (f + n) / (f − n) + (1 / z) 2 f n / (f − n)      (L5, Recall Z-value Computation)
    /// ```
    /// −near becomes −1, −far becomes 1, and the order stays. The value does not: the slide before
    /// says "z-value is preserved", which is true of the order only. Half of the range is used by
    /// the depths up to 2fn/(f + n).
    pub fn ndc_depth(&self, z: f64) -> f64 {
        let (n, f) = (self.near, self.far);
        (f + n) / (f - n) + (1.0 / z) * (2.0 * f * n / (f - n)) // z ↦
    }
}

/// Returns the weight in space of the end A of an edge, where its weight on the screen is `alpha`.
/// `z_a` and `z_b` are the depths of both ends, with the same sign, in any unit.
/// ```text
/// β = α z_B / (α z_B + (1 − α) z_A)
/// ```
/// L5 defines `y'_P = α y'_A + (1 − α) y'_B` on the screen and `y_P = β y_A + (1 − β) y_B` in
/// space, and then prints the weight of the other end: see [`printed_weight_in_space`].
pub fn weight_in_space(alpha: f64, z_a: f64, z_b: f64) -> f64 {
    alpha * z_b / (alpha * z_b + (1.0 - alpha) * z_a) // β = α z_B / (α z_B + (1 − α) z_A)
}

/// Returns β as L5 prints it, `(1 − α) z_A / (z_B + (1 − α)(z_A − z_B))`. This is the weight of B,
/// 1 − β, where the slide's definitions ask for the weight of A. At α = 1 the point is A and β
/// should be 1; this is 0. It exists to be shown, and nothing else calls it.
pub fn printed_weight_in_space(alpha: f64, z_a: f64, z_b: f64) -> f64 {
    (1.0 - alpha) * z_a / (z_b + (1.0 - alpha) * (z_a - z_b))
}

/// Returns the weights in space of a triangle's corners, where `weights` are their weights on the
/// screen and `inv_w` the reciprocals of their depths, in any unit. Each weight is multiplied by
/// its reciprocal and divided by the sum of the products.
///
/// With two corners it is [`weight_in_space`]. If all depths are equal, the weights are returned
/// unchanged, to the bit.
pub fn weights_in_space(weights: [f64; 3], inv_w: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = inv_w;
    if a == b && b == c {
        return weights;
    }
    let sum = weights[0] * a + weights[1] * b + weights[2] * c;
    [
        weights[0] * a / sum,
        weights[1] * b / sum,
        weights[2] * c / sum,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;
    use crate::scene::{Camera, Projection};
    use alloc::vec::Vec;
    use glam::DVec3;

    /// Half a unit in the last place of 1.
    const HALF: f64 = f64::EPSILON / 2.0;

    #[test]
    fn the_weight_in_space_is_that_of_the_point_that_is_seen() {
        let mut random = Random::new(1);
        for _ in 0..1000 {
            let mut value = || f64::from(random.signed());
            // Two points in front of an eye that looks along −z, and one between them in space.
            let (a, b) = ((value(), -1.5 + value()), (value(), -3.5 + value()));
            let beta = 0.5 + 0.5 * value();
            let p = (
                beta * a.0 + (1.0 - beta) * b.0,
                beta * a.1 + (1.0 - beta) * b.1,
            );
            // On the screen, at distance 1, y' = y / −z. α follows from y'_P = α y'_A + (1 − α)
            // y'_B.
            let on_screen = |(y, z): (f64, f64)| y / -z;
            let (y_a, y_b, y_p) = (on_screen(a), on_screen(b), on_screen(p));
            if (y_a - y_b).abs() < 0.1 {
                continue;
            }
            let alpha = (y_p - y_b) / (y_a - y_b);
            // α is a quotient of differences of values up to 2. The differences are off by 8
            // half-ulps of 2, and the divisor is at least 0.1. β grows by z_A / z_B or its inverse
            // times that, 9 at most; the formula itself rounds six times.
            let off = 9.0 * (2.0 * 8.0 * 2.0 / 0.1) * HALF + 6.0 * HALF;
            let found = weight_in_space(alpha, a.1, b.1);
            assert!((found - beta).abs() <= off, "{found} is not {beta}");
            let printed = printed_weight_in_space(alpha, a.1, b.1);
            assert!(
                (printed - (1.0 - beta)).abs() <= 2.0 * off,
                "it is the weight of B: {printed}, {beta}"
            );
            let of_three = weights_in_space([alpha, 1.0 - alpha, 0.0], [1.0 / a.1, 1.0 / b.1, 7.0]);
            assert!((of_three[0] - beta).abs() <= 2.0 * off && of_three[2] == 0.0);
        }
    }

    #[test]
    fn at_its_end_a_point_has_the_whole_weight_and_as_printed_none() {
        for (z_a, z_b) in [(-1.0, -4.0), (-4.0, -1.0), (2.0, 3.0)] {
            assert_eq!(
                [1.0, 0.0].map(|alpha| weight_in_space(alpha, z_a, z_b)),
                [1.0, 0.0]
            );
            assert_eq!(
                [1.0, 0.0].map(|alpha| printed_weight_in_space(alpha, z_a, z_b)),
                [0.0, 1.0]
            );
        }
        // In the middle of the picture of an edge from depth 1 to depth 4, the point is a fifth of
        // the way in space.
        assert_eq!(weight_in_space(0.5, -1.0, -4.0), 0.8);
        assert_eq!(
            weights_in_space([0.25, 0.5, 0.25], [3.0; 3]),
            [0.25, 0.5, 0.25]
        );
    }

    #[test]
    fn depth_keeps_its_order_and_not_its_value() {
        let frustum = Frustum {
            left: -1.0,
            right: 1.0,
            bottom: -1.0,
            top: 1.0,
            near: 0.5,
            far: 8.0,
        };
        let depths: Vec<f64> = (0..=60).map(|k| -0.5 - 7.5 * f64::from(k) / 60.0).collect();
        let mapped: Vec<f64> = depths.iter().map(|&z| frustum.ndc_depth(z)).collect();
        assert!(
            mapped.windows(2).all(|pair| pair[0] < pair[1]),
            "farther stays farther"
        );
        // Sums of two values up to 2.2, rounded thrice each.
        assert!(
            (mapped[0] + 1.0).abs() <= 8.0 * HALF * 2.2
                && (mapped[60] - 1.0).abs() <= 8.0 * HALF * 2.2
        );
        // If values were preserved up to scale, the middle of the depths would be in the middle. It
        // is at 17/15 − 16/15 · 4/17 = 15/17.
        assert!((frustum.ndc_depth(-4.25) - 15.0 / 17.0).abs() <= 8.0 * HALF * 2.2);
        // Half of the cube is nearer than 2fn/(f + n) = 0.94.
        assert!(frustum.ndc_depth(-8.0 / 8.5).abs() <= 8.0 * HALF * 2.2);
    }

    #[test]
    fn the_matrix_maps_depth_as_the_formula() {
        let frustum = Frustum {
            left: -0.3,
            right: 0.5,
            bottom: -0.2,
            top: 0.6,
            near: 0.25,
            far: 40.0,
        };
        let matrix = frustum.matrix();
        for z in [-0.25, -1.0, -7.5, -40.0] {
            let clip = matrix * DVec4::new(0.3, -0.7, z, 1.0);
            assert_eq!(clip.w, -z);
            // Numerators up to 41 over w ≥ 0.25, four roundings each.
            assert!((clip.z / clip.w - frustum.ndc_depth(z)).abs() <= 8.0 * HALF * 41.0 / 0.25);
        }
        // The corners of the near plane are corners of the cube.
        let corner = matrix * DVec4::new(0.5, -0.2, -0.25, 1.0);
        let ndc = corner.truncate() / corner.w;
        assert!((ndc - DVec3::new(1.0, -1.0, -1.0)).abs().max_element() <= 16.0 * HALF);
    }

    /// The camera's matrix is L5's matrix after the camera's own axes, with depths in 0..=1 in
    /// place of −1..=1.
    #[test]
    fn the_camera_has_this_matrix() {
        let (fovy, aspect, near, far) = (50.0f64, 1.5, 0.3, 70.0);
        let camera = Camera {
            eye: DVec3::new(1.0, -2.0, 3.0),
            target: DVec3::new(-2.0, 0.5, -1.0),
            up: DVec3::Y,
            projection: Projection::Perspective { fovy },
            near,
            far,
        };
        let top = near * libm::tan(fovy.to_radians() / 2.0);
        let frustum = Frustum {
            left: -top * aspect,
            right: top * aspect,
            bottom: -top,
            top,
            near,
            far,
        };
        let [right, up, forward] = camera.axes();
        let mut random = Random::new(2);
        for _ in 0..200 {
            let p = DVec3::from_array([(); 3].map(|()| 10.0 * f64::from(random.signed())));
            let seen = p - camera.eye;
            let in_camera = DVec4::new(seen.dot(right), seen.dot(up), -seen.dot(forward), 1.0);
            let (theirs, ours) = (
                frustum.matrix() * in_camera,
                camera.clip_matrix(aspect) * p.extend(1.0),
            );
            let expected = DVec4::new(theirs.x, theirs.y, 0.5 * (theirs.z + theirs.w), theirs.w);
            // Coordinates up to 20, times up to 2.2, some ten roundings: 20 · 2.2 · 10 half-ulps on
            // each side.
            assert!(
                (ours - expected).abs().max_element() <= 2.0 * 440.0 * HALF,
                "{ours} is not {expected}"
            );
        }
    }
}
