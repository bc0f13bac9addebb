//! Barycentric coordinates of a triangle, by every formula of the lectures.
//!
//! All formulas are quotients of signed areas, and agree. Each stands here as it is printed (CS171
//! 1; L5, Barycentric Coordinates), with the printed mistakes beside the right forms. Points are in
//! any unit. On integers, or whole multiples of 1/256 pixel as in a frame, up to 2²⁴, every sum
//! here is below 2⁵³ and exact. Only the quotient rounds, once, and the signs are right.
//!
//! A triangle without area has no coordinates: the quotients are not finite.

use glam::DVec2;

/// The three weights α, β, γ of the point α a + β b + γ c.
pub type Weights = [f64; 3];

/// Returns a value that is zero on the line through i and j and proportional to the distance from
/// it:
/// ```text
/// f_ij(x, y) = (y_i − y_j) x + (x_j − x_i) y + x_i y_j − x_j y_i      (CS171 1)
/// ```
/// It is twice the signed area of the triangle i, j, p, and positive if that runs counter-clockwise
/// with y upward.
pub fn f(i: DVec2, j: DVec2, p: DVec2) -> f64 {
    (i.y - j.y) * p.x + (j.x - i.x) * p.y + i.x * j.y - j.x * i.y // f_ij
}

/// Returns the weights by calls of [`f`]:
/// ```text
/// α = f_bc(p) / f_bc(a)      β = f_ac(p) / f_ac(b)      γ = f_ab(p) / f_ab(c)      (CS171 1)
/// ```
/// The text divides the last one by `f_ac(p)`, which is a slip of the pen: see [`printed_gamma`].
pub fn weights([a, b, c]: [DVec2; 3], p: DVec2) -> Weights {
    [
        f(b, c, p) / f(b, c, a), // α = f_bc(p) / f_bc(a)
        f(a, c, p) / f(a, c, b),
        f(a, b, p) / f(a, b, c), // not f_ac(p)
    ]
}

/// Returns γ as CS171 prints it, `f_ab(p) / f_ac(p)`. It is the quotient of two distances from p,
/// and no weight. As f_ac(b) is −f_ab(c), it equals −γ/β, which is negative everywhere inside, so
/// that only the edge ab would be filled. At c, where γ is 1, it divides by zero. Only the figure
/// about barycentric weights draws it.
pub fn printed_gamma([a, b, c]: [DVec2; 3], p: DVec2) -> f64 {
    f(a, b, p) / f(a, c, p)
}

/// Returns the weights as the solution of the system of two equations that defines them, by
/// Cramer's rule:
/// ```text
/// [ x_b − x_a   x_c − x_a ] [ β ]   [ x_p − x_a ]
/// [ y_b − y_a   y_c − y_a ] [ γ ] = [ y_p − y_a ],      α = 1 − β − γ      (CS171 1)
/// ```
/// L5 has the system relative to C, with the unknowns α and β.
pub fn weights_of_system([a, b, c]: [DVec2; 3], p: DVec2) -> Weights {
    let (column_b, column_c, right) = (b - a, c - a, p - a);
    let determinant = column_b.perp_dot(column_c);
    let beta = right.perp_dot(column_c) / determinant;
    let gamma = column_b.perp_dot(right) / determinant;
    [1.0 - beta - gamma, beta, gamma] // α = 1 − β − γ
}

/// Evaluates the line equation of L5, which is proportional to the signed distance from the line
/// through `from` and `to`:
/// ```text
/// L_PQ(x, y) = −(x − x_P)(y_Q − y_P) + (y − y_P)(x_Q − x_P)      (L5, Computing Barycentric Coordinates)
/// ```
/// It equals [`f`], written relative to the first point.
pub fn line(from: DVec2, to: DVec2, p: DVec2) -> f64 {
    -(p.x - from.x) * (to.y - from.y) + (p.y - from.y) * (to.x - from.x) // L_PQ
}

/// Returns the weights as proportional distances:
/// ```text
/// α = L_BC(x, y) / L_BC(x_A, y_A),   β = L_CA(x, y) / L_CA(x_B, y_B),   γ = 1 − α − β      (L5)
/// ```
pub fn weights_of_distances([a, b, c]: [DVec2; 3], p: DVec2) -> Weights {
    let alpha = line(b, c, p) / line(b, c, a); // α = L_BC(p) / L_BC(a)
    let beta = line(c, a, p) / line(c, a, b);
    [alpha, beta, 1.0 - alpha - beta]
}

/// Returns the signed area of a triangle, half of a cross product. It is positive if the triangle
/// runs counter-clockwise with y upward.
/// ```text
/// A_abc = ½ (x_a y_b + x_b y_c + x_c y_a − x_a y_c − x_b y_a − x_c y_b)      (CS171 1)
/// ```
pub fn signed_area([a, b, c]: [DVec2; 3]) -> f64 {
    0.5 * (b - a).perp_dot(c - a) // A_abc
}

/// Returns the weights as proportional areas, A_a / A and so on. A_a is the area of the triangle
/// with p in place of a (CS171 1, Figure 3). The areas are signed, so that the weights also hold
/// outside the triangle.
pub fn weights_of_areas([a, b, c]: [DVec2; 3], p: DVec2) -> Weights {
    let whole = signed_area([a, b, c]);
    [
        signed_area([p, b, c]) / whole,
        signed_area([a, p, c]) / whole,
        signed_area([a, b, p]) / whole,
    ]
}

/// Returns the "weights" as L5 prints them, from areas without a sign:
/// ```text
/// α = A_A / (A_A + A_B + A_C),      A_A = ½ ‖PB × PC‖      (L5, Proportional Areas)
/// ```
/// Inside the triangle they are the weights. Outside they are wrong and still lie in 0..=1, so that
/// a test by them calls every point inside. Only the figure about barycentric weights draws them.
pub fn unsigned_weights([a, b, c]: [DVec2; 3], p: DVec2) -> Weights {
    let areas = [[p, b, c], [a, p, c], [a, b, p]].map(|triangle| signed_area(triangle).abs());
    areas.map(|area| area / (areas[0] + areas[1] + areas[2]))
}

/// Returns the two weights on a line. The weight of each end is the distance from the *other* end.
/// ```text
/// v = (x_2 − x) / (x_2 − x_1) v_1 + (x − x_1) / (x_2 − x_1) v_2      (CS171 1, Figure 2)
/// ```
pub fn weights_on_line(x1: f64, x2: f64, x: f64) -> [f64; 2] {
    [(x2 - x) / (x2 - x1), (x - x1) / (x2 - x1)]
}

/// Returns the point where all weights are ⅓ (L5, Center of mass).
pub fn centre_of_mass([a, b, c]: [DVec2; 3]) -> DVec2 {
    (a + b + c) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    /// A point on the grid of 1/256 pixel.
    fn place(random: &mut Random, reach: u64) -> DVec2 {
        let mut coordinate = || (random.below(2 * reach) as f64 - reach as f64) / 256.0;
        DVec2::new(coordinate(), coordinate())
    }

    /// Triangles with an area, small ones and ones that fill the guard band, and points around
    /// them.
    fn triangles(seed: u64, mut visit: impl FnMut([DVec2; 3], DVec2)) {
        let mut random = Random::new(seed);
        for round in 0..6000 {
            let reach = [1 << 5, 1 << 12, 1 << 23][round % 3];
            let triangle = [(); 3].map(|()| place(&mut random, reach));
            if signed_area(triangle) != 0.0 {
                visit(triangle, place(&mut random, reach));
            }
        }
    }

    /// True if two formulas agree. Each is one rounded quotient of exact values and at most two
    /// sums, whose sizes are at most those of the weights: four half-ulps of the largest, for each
    /// of the two.
    #[track_caller]
    fn agree(found: Weights, expected: Weights) {
        let largest = expected.iter().fold(1.0f64, |m, w| m.max(w.abs()));
        for (a, b) in found.iter().zip(expected) {
            assert!(
                (a - b).abs() <= 4.0 * f64::EPSILON * largest,
                "{found:?} is not {expected:?}"
            );
        }
    }

    #[test]
    fn all_formulas_give_the_same_weights() {
        let mut count = 0;
        triangles(1, |t, p| {
            let w = weights(t, p);
            agree(weights_of_system(t, p), w);
            agree(weights_of_distances(t, p), w);
            agree(weights_of_areas(t, p), w);
            count += 1;
        });
        assert!(count > 5000);
    }

    #[test]
    fn the_line_equation_is_f_exactly() {
        triangles(2, |[a, b, _], p| assert_eq!(line(a, b, p), f(a, b, p)));
        // L is also proportional to the distance: 5 times the distance from the line through (0, 0)
        // and (4, 3), whose length is 5.
        let (from, to) = (DVec2::ZERO, DVec2::new(4.0, 3.0));
        for distance in [-2.0, 0.0, 1.0, 7.0] {
            let p = 2.0 * to + DVec2::new(-3.0, 4.0) * distance;
            assert_eq!(line(from, to, p), 5.0 * 5.0 * distance);
        }
    }

    #[test]
    fn weights_sum_to_one_and_give_the_point() {
        triangles(3, |t, p| {
            let [alpha, beta, gamma] = weights(t, p);
            let largest = alpha.abs().max(beta.abs()).max(gamma.abs()).max(1.0);
            // Each weight is off by half an ulp of itself, and the sums of three add two more.
            assert!((alpha + beta + gamma - 1.0).abs() <= 2.5 * f64::EPSILON * largest);
            let back = alpha * t[0] + beta * t[1] + gamma * t[2];
            let size = t.iter().fold(0.0f64, |m, v| m.max(v.abs().max_element()));
            // Three products of an inexact weight, rounded once each, and two sums: (3 · 2 + 2)
            // half-ulps of the largest.
            assert!((back - p).abs().max_element() <= 4.0 * f64::EPSILON * 3.0 * largest * size);
        });
    }

    #[test]
    fn the_printed_gamma_is_no_weight_and_the_corrected_one_is() {
        let right = [
            DVec2::new(0.0, 0.0),
            DVec2::new(8.0, 0.0),
            DVec2::new(0.0, 4.0),
        ];
        // (2, 1) is a quarter of b − a and a quarter of c − a from a: (½, ¼, ¼).
        assert_eq!(weights(right, DVec2::new(2.0, 1.0)), [0.5, 0.25, 0.25]);
        assert_eq!(weights(right, right[2]), [0.0, 0.0, 1.0]);
        // As printed: 8 · 1 / (−4 · 2), and at c a division by zero.
        assert_eq!(printed_gamma(right, DVec2::new(2.0, 1.0)), -1.0);
        assert!(!printed_gamma(right, right[2]).is_finite());
        let (mut sums_to_one, mut all) = (0, 0);
        triangles(4, |t, p| {
            let [alpha, beta, gamma] = weights(t, p);
            if beta != 0.0 {
                // Three rounded quotients and a product, of exact values.
                let expected = -gamma / beta;
                assert!(
                    (printed_gamma(t, p) - expected).abs() <= 2.0 * f64::EPSILON * expected.abs()
                );
            }
            let is_one = |gamma: f64| {
                (alpha + beta + gamma - 1.0).abs() < 1e-9 * alpha.abs().max(beta.abs()).max(1.0)
            };
            assert!(is_one(gamma));
            sums_to_one += usize::from(is_one(printed_gamma(t, p)));
            all += 1;
        });
        // Only by chance: where f_ac(p) happens to equal f_ab(c), on the grid of small triangles.
        assert!(sums_to_one * 20 < all, "{sums_to_one} of {all}");
    }

    #[test]
    fn weights_tell_inside_edge_and_corner() {
        triangles(5, |t, _| {
            let [a, b, c] = t;
            assert_eq!(weights(t, a), [1.0, 0.0, 0.0]);
            assert_eq!(weights(t, b), [0.0, 1.0, 0.0]);
            assert_eq!(weights(t, c), [0.0, 0.0, 1.0]);
            // Halves of sums are exact on the grid of 1/512.
            let on_edge = weights(t, (a + b) / 2.0);
            assert_eq!(
                on_edge,
                [0.5, 0.5, 0.0],
                "the weight of the corner across from an edge is 0 on it"
            );
            let inside = weights(t, (2.0 * a + b + c) / 4.0);
            assert_eq!(inside, [0.5, 0.25, 0.25]);
            // Beyond the edge opposite a: the mirror image of a in the middle of b and c.
            assert_eq!(weights(t, b + c - a), [-1.0, 1.0, 1.0]);
        });
    }

    #[test]
    fn all_weights_in_zero_to_one_is_the_same_side_of_all_edges() {
        let (mut inside, mut outside) = (0, 0);
        triangles(6, |t, p| {
            let is_weighted_in = weights(t, p).iter().all(|w| (0.0..=1.0).contains(w));
            // In exact integers, edge by edge.
            let whole = |v: DVec2| ((v.x * 256.0) as i128, (v.y * 256.0) as i128);
            let turn = |a: DVec2, b: DVec2, c: DVec2| {
                let (a, b, c) = (whole(a), whole(b), whole(c));
                (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
            };
            let sides = [
                turn(t[0], t[1], p),
                turn(t[1], t[2], p),
                turn(t[2], t[0], p),
            ];
            let is_in = sides.iter().all(|&s| s >= 0) || sides.iter().all(|&s| s <= 0);
            assert_eq!(is_weighted_in, is_in, "{t:?} at {p}");
            *(if is_in { &mut inside } else { &mut outside }) += 1;
        });
        assert!(inside > 200 && outside > 2000, "{inside} {outside}");
    }

    #[test]
    fn areas_without_signs_call_outside_points_inside() {
        let mut misled = 0;
        triangles(7, |t, p| {
            let (right, unsigned) = (weights(t, p), unsigned_weights(t, p));
            assert!(
                unsigned.iter().all(|w| (0.0..=1.0).contains(w)),
                "always, wherever p is"
            );
            if right.iter().all(|w| (0.0..=1.0).contains(w)) {
                agree(unsigned, right);
            } else {
                misled += 1;
            }
        });
        assert!(misled > 2000, "{misled} points outside were called inside");
    }

    #[test]
    fn the_centre_of_mass_weighs_all_corners_alike() {
        let t = [
            DVec2::new(0.0, 0.0),
            DVec2::new(6.0, 0.0),
            DVec2::new(1.5, 4.5),
        ];
        assert_eq!(centre_of_mass(t), DVec2::new(2.5, 1.5));
        assert_eq!(weights(t, centre_of_mass(t)), [1.0 / 3.0; 3]);
    }

    #[test]
    fn the_closer_end_of_a_line_weighs_more() {
        assert_eq!(weights_on_line(2.0, 10.0, 4.0), [0.75, 0.25]);
        assert_eq!(weights_on_line(2.0, 10.0, 2.0), [1.0, 0.0]);
        assert_eq!(weights_on_line(10.0, 2.0, 2.0), [0.0, 1.0]);
        // On an edge of a triangle they are its weights: distances along the edge behave as on the
        // line.
        let t = [
            DVec2::new(2.0, 1.0),
            DVec2::new(10.0, 1.0),
            DVec2::new(3.0, 7.0),
        ];
        let [w_a, w_b] = weights_on_line(2.0, 10.0, 7.0);
        assert_eq!(weights(t, DVec2::new(7.0, 1.0)), [w_a, w_b, 0.0]);
    }
}
