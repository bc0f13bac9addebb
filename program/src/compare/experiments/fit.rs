//! Fits costs to times: non-negative least squares of relative errors.

use alloc::vec::Vec;

/// An observed total, and how often each cost occurs in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation<const N: usize> {
    /// The count of each cost.
    pub counts: [f64; N],
    /// The observed sum of all costs, in their unit.
    pub total: f64,
    /// The divisor of the error, over 0. The total itself makes errors relative.
    pub scale: f64,
}

impl<const N: usize> Observation<N> {
    /// Returns the total that `costs` predict.
    fn explained(&self, costs: &[f64; N]) -> f64 {
        dot(&self.counts, costs)
    }
}

/// The smallest part of a column, by length, that must be independent of the other columns. With
/// less, noise of one percent in the totals could be mistaken for a whole cost.
const LEAST_INDEPENDENT: f64 = 0.01;

/// Returns the costs c of 0 or more that minimise
///
/// ```text
/// Σᵢ ((totalᵢ − Σⱼ cⱼ countᵢⱼ) / scaleᵢ)²
/// ```
///
/// Returns `None` if the observations cannot tell the costs apart: there are fewer observations
/// than costs, a cost never occurs, or the counts of one are nearly a combination of the others.
/// Also returns `None` if a value is not finite or a scale is not over 0.
///
/// Solves ordinary least squares for every subset of the costs, with the others 0, and keeps the
/// best solution without negative costs. This is exact, but only fast for few costs (for many, see
/// Lawson & Hanson 1974, ch. 23).
pub fn fit<const N: usize>(observations: &[Observation<N>]) -> Option<[f64; N]> {
    let is_sound = |o: &Observation<N>| {
        let mut values = [o.scale, o.total].into_iter().chain(o.counts);
        o.scale > 0.0 && values.all(f64::is_finite)
    };
    let all = (1u32 << N) - 1;
    if observations.len() < N || !observations.iter().all(is_sound) {
        return None;
    }
    // Refuse costs that cannot be told apart, even if the best subset would not contain them all.
    solve(observations, all)?;
    let mut best = ([0.0; N], cost_of(observations, &[0.0; N]));
    for subset in 1..=all {
        let Some(costs) = solve(observations, subset) else {
            continue;
        };
        let left = cost_of(observations, &costs);
        if costs.iter().all(|cost| *cost >= 0.0) && left < best.1 {
            best = (costs, left);
        }
    }
    Some(best.0)
}

/// Returns the sum of squared errors that `costs` leave.
fn cost_of<const N: usize>(observations: &[Observation<N>], costs: &[f64; N]) -> f64 {
    let square = |o: &Observation<N>| {
        let error = (o.total - o.explained(costs)) / o.scale;
        error * error
    };
    observations.iter().map(square).sum()
}

/// Solves ordinary least squares for the costs whose bits are set in `subset`. The other costs
/// are 0.
fn solve<const N: usize>(observations: &[Observation<N>], subset: u32) -> Option<[f64; N]> {
    let chosen = || (0..N).filter(|j| subset >> j & 1 == 1);
    let scaled = |j: usize| observations.iter().map(move |o| o.counts[j] / o.scale);
    let column = |j| (scaled(j).map(|x| x * x).sum(), scaled(j).collect());
    let right: Vec<f64> = observations.iter().map(|o| o.total / o.scale).collect();
    let mut costs = [0.0; N];
    let factors = nearest(&chosen().map(column).collect::<Vec<_>>(), &right)?;
    chosen().zip(factors).for_each(|(j, cost)| costs[j] = cost);
    Some(costs)
}

/// Returns the factors that make the sum of `columns` nearest to `right`, or `None` if the columns
/// are not independent. Each column comes with the square of its original length.
///
/// Projects the first column out of everything, solves for the other columns, then for the first
/// one (Gram–Schmidt).
fn nearest(columns: &[(f64, Vec<f64>)], right: &[f64]) -> Option<Vec<f64>> {
    let Some(((whole, first), later)) = columns.split_first() else {
        return Some(Vec::new());
    };
    let square = dot(first, first);
    // This also refuses a column of zeros, and one whose square overflows: infinity is not over
    // infinity.
    let is_independent = square > LEAST_INDEPENDENT * LEAST_INDEPENDENT * whole;
    if !is_independent {
        return None;
    }
    let rest = |column: &[f64]| -> Vec<f64> {
        let part = dot(first, column) / square;
        let pairs = column.iter().zip(first);
        pairs.map(|(x, f)| x - part * f).collect()
    };
    let others: Vec<_> = later.iter().map(|(whole, c)| (*whole, rest(c))).collect();
    let mut factors = nearest(&others, &rest(right))?;
    let explained = |(factor, (_, column)): (&f64, &(f64, Vec<f64>))| factor * dot(first, column);
    let explained: f64 = factors.iter().zip(later).map(explained).sum();
    factors.insert(0, (dot(first, right) - explained) / square);
    Some(factors)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Returns counts like those of a mesh of `triangles` on a picture of `side`² pixels. Spans
    /// grow with the root of the triangles.
    fn counts(triangles: f64, side: f64) -> [f64; 4] {
        let spans = 2.0 * libm::sqrt(triangles) * side;
        [
            triangles,
            spans.min(0.3 * side * side),
            0.3 * side * side,
            side * side * if triangles > 3e4 { 1.0 } else { 2.0 },
        ]
    }

    fn made_up(costs: [f64; 4], noise: impl Fn(usize) -> f64) -> Vec<Observation<4>> {
        let places = [
            (1e3, 1e3),
            (4e3, 1e3),
            (16e3, 1e3),
            (64e3, 1e3),
            (256e3, 1e3),
            (4e3, 150.0),
            (4e3, 500.0),
            (4e3, 3e3),
        ];
        let observation = |(i, (triangles, side)): (usize, (f64, f64))| {
            let counts = counts(triangles, side);
            let exact: f64 = counts.iter().zip(costs).map(|(n, c)| n * c).sum();
            let total = exact * (1.0 + noise(i));
            Observation {
                counts,
                total,
                scale: total,
            }
        };
        places.into_iter().enumerate().map(observation).collect()
    }

    /// Sums of eight products lose less than 2⁻⁴⁰ of themselves. At least a hundredth of each
    /// column is independent. Solving for four columns may lose the fourth power of that at worst:
    /// 10⁸ · 2⁻⁵⁰ < 10⁻⁶.
    #[test]
    fn known_costs_are_found_again() {
        let costs = [70.0, 20.0, 4.0, 0.5];
        let found = fit(&made_up(costs, |_| 0.0)).unwrap();
        for (found, cost) in found.iter().zip(costs) {
            assert!((found / cost - 1.0).abs() < 1e-6, "{found} for {cost}");
        }
    }

    /// The fitted costs explain the noisy totals at least as well as the true costs, because the
    /// fit minimises the error. The true costs are off by the noise: 5 %, at most 5/95 of the
    /// measured total, in each of the eight.
    #[test]
    fn with_noise_no_total_is_missed_by_much_more_than_it() {
        let (costs, noise) = ([70.0, 20.0, 4.0, 0.5], 0.05);
        let observations = made_up(costs, |i| if i % 2 == 0 { noise } else { -noise });
        let found = fit(&observations).unwrap();
        let left = cost_of(&observations, &found);
        assert!(left <= cost_of(&observations, &costs) && found.iter().all(|cost| *cost >= 0.0));
        assert!(
            left <= 8.0 * (noise / (1.0 - noise)) * (noise / (1.0 - noise)),
            "{left}"
        );
    }

    /// Each cost occurs on its own in two observations, one 5 % too large and one 5 % too small.
    /// The fit lies between them.
    #[test]
    fn noise_moves_a_cost_by_no_more_than_itself() {
        let seen = |counts: [f64; 2], total| Observation {
            counts,
            total,
            scale: total,
        };
        let observations = [
            seen([10.0, 0.0], 1.05 * 700.0),
            seen([90.0, 0.0], 0.95 * 6300.0),
            seen([0.0, 3.0], 0.95 * 1.5),
            seen([0.0, 8.0], 1.05 * 4.0),
        ];
        let found = fit(&observations).unwrap();
        assert!(
            (found[0] / 70.0 - 1.0).abs() < 0.05 && (found[1] / 0.5 - 1.0).abs() < 0.05,
            "{found:?}"
        );
    }

    #[test]
    fn no_cost_is_below_zero_and_the_others_are_then_the_best_without_it() {
        // By ordinary least squares the second cost is negative: totals fall while its counts grow.
        let seen = |counts, total| Observation {
            counts,
            total,
            scale: 1.0,
        };
        let observations = [
            seen([1.0, 0.0], 10.0),
            seen([1.0, 1.0], 8.0),
            seen([1.0, 2.0], 6.0),
        ];
        let plain = solve(&observations, 0b11).unwrap();
        assert!(
            (plain[0] - 10.0).abs() < 1e-12 && (plain[1] + 2.0).abs() < 1e-12,
            "{plain:?}"
        );
        let found = fit(&observations).unwrap();
        assert!(
            (found[0] - 8.0).abs() < 1e-12 && found[1] == 0.0,
            "the mean: {found:?}"
        );
    }

    #[test]
    fn two_costs_are_found_from_three_totals() {
        let seen = |counts, total| Observation {
            counts,
            total,
            scale: total,
        };
        let observations = [
            seen([1.0, 10.0], 23.0),
            seen([4.0, 10.0], 32.0),
            seen([9.0, 20.0], 67.0),
        ];
        let costs = fit(&observations).expect("two unknowns");
        assert!((costs[0] - 3.0).abs() < 1e-12 && (costs[1] - 2.0).abs() < 1e-12);
    }

    #[test]
    fn errors_count_relative_to_their_scale() {
        let seen = |total: f64| Observation {
            counts: [total],
            total: 2.0 * total,
            scale: 2.0 * total,
        };
        // A total that is a thousand times larger and off by half weighs as much as a small one off
        // by half.
        let mut observations = [seen(1.0), seen(1.0), seen(1000.0)];
        observations[2].total *= 1.5;
        let found = fit(&observations).unwrap()[0];
        // Three columns of 1/2 against right-hand sides of 1, 1 and 1.5.
        assert!((found - 2.0 * 3.5 / 3.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn what_cannot_be_told_apart_is_refused() {
        let seen = |counts: [f64; 2]| Observation {
            counts,
            total: counts[0] + 1.0,
            scale: 1.0,
        };
        assert_eq!(fit(&[seen([1.0, 2.0])]), None, "one observation");
        assert_eq!(
            fit(&[seen([1.0, 2.0]), seen([2.0, 4.0]), seen([3.0, 6.0])]),
            None,
            "twice as many vertices"
        );
        assert_eq!(
            fit(&[seen([1.0, 2.0]), seen([2.0, 4.001]), seen([3.0, 6.0])]),
            None,
            "nearly"
        );
        assert_eq!(fit(&[seen([1.0, 0.0]), seen([2.0, 0.0])]), None, "never");
        assert!(fit(&[seen([1.0, 2.0]), seen([2.0, 1.0])]).is_some());
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(fit(&[seen([1.0, 2.0]), seen([2.0, bad])]), None);
        }
        let without_scale = Observation {
            counts: [1.0],
            total: 1.0,
            scale: 0.0,
        };
        assert_eq!(fit(&[without_scale]), None);
    }
}
