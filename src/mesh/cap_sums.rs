//! Weighted sums over many unit normals, restricted to those within an angle of one direction.

use super::vertex_normals::weight::{Sum, Term};
use alloc::vec::Vec;
use glam::DVec3;

/// The most normals in a leaf. A query compares them one by one.
const LEAF: usize = 16;

/// A bound on the rounding error of a dot product between a unit vector and a corner of a box
/// around unit vectors. The three products and two additions work on values up to 1, and each is
/// off by at most 2⁻⁵³.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// A tree of boxes over unit normals, each box split in half along its longest side.
///
/// A query asks for all normals in a cap of the unit sphere: those within an angle of one
/// direction. It adds the stored sum of each box inside the cap, skips each box outside of it, and
/// opens only the boxes that the border of the cap cuts. On the whole sphere the border cuts about
/// √n of n boxes. If the normals lie along a curve, as around the tip of a cone, it cuts a handful.
pub(super) struct CapSums {
    terms: Vec<Term>,
    /// An empty sum, which carries the kind of weight.
    none: Sum,
    nodes: Vec<Node>,
}

/// A box around some of the normals, and the sum of their terms.
struct Node {
    low: DVec3,
    high: DVec3,
    sum: Sum,
    /// The range of its terms.
    first: usize,
    end: usize,
    /// The node of the second half; `None` for a leaf. The first half is the node right after this
    /// one.
    second: Option<usize>,
}

impl CapSums {
    /// Builds the tree over `terms`, by the normals of their polygons. `none` is the empty sum that
    /// every sum starts from.
    pub fn new(terms: Vec<Term>, none: Sum) -> Self {
        let mut sums = CapSums {
            nodes: Vec::with_capacity(2 * terms.len() / LEAF + 1),
            terms,
            none,
        };
        sums.node(0, sums.terms.len());
        sums
    }

    /// Adds the node for a range of terms and those below it. Returns its index.
    fn node(&mut self, first: usize, end: usize) -> usize {
        let part = &mut self.terms[first..end];
        let (low, high) = part
            .iter()
            .map(|term| term.polygon)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), n| {
                (low.min(n), high.max(n))
            });
        let sides = high - low;
        // Equal normals cannot be split, however many there are.
        let is_leaf = part.len() <= LEAF || sides == DVec3::ZERO;
        if !is_leaf {
            let axis = sides.max_position();
            let half = part.len() / 2;
            part.select_nth_unstable_by(half, |a, b| a.polygon[axis].total_cmp(&b.polygon[axis]));
        }
        let mut sum = self.none;
        part.iter().for_each(|term| sum.add_term(term));
        let index = self.nodes.len();
        self.nodes.push(Node {
            low,
            high,
            sum,
            first,
            end,
            second: None,
        });
        if !is_leaf {
            let middle = first + (end - first) / 2;
            self.node(first, middle);
            self.nodes[index].second = Some(self.node(middle, end));
        }
        index
    }

    /// Returns the sum over all polygons whose normal has a dot product of at least `least_cosine`
    /// with `own`.
    pub fn within(&self, own: DVec3, least_cosine: f64) -> Sum {
        let mut sum = self.none;
        let mut open: Vec<usize> = Vec::from([0]);
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            // Interval arithmetic: per axis one face of the box gives the smallest product and the
            // other one the largest.
            let (a, b) = (own * node.low, own * node.high);
            let least = a.min(b).element_sum();
            let most = a.max(b).element_sum();
            // SLACK keeps both tests on the safe side: a box is skipped or added whole only if
            // every single comparison would agree.
            if most < least_cosine - SLACK {
                continue;
            }
            if least >= least_cosine + SLACK {
                sum.add_sum(&node.sum);
                continue;
            }
            if let Some(second) = node.second {
                open.extend([second, index + 1]);
                continue;
            }
            for term in &self.terms[node.first..node.end] {
                if own.dot(term.polygon) >= least_cosine {
                    sum.add_term(term);
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    fn directions(count: usize) -> Vec<DVec3> {
        let mut random = Random::new(8);
        let mut side = || f64::from(random.signed());
        (0..count)
            .map(|_| DVec3::new(side(), side(), side()).normalize())
            .collect()
    }

    #[test]
    fn sums_are_those_of_all_comparisons() {
        for (count, repeats) in [(0, 1), (1, 1), (16, 1), (17, 3), (500, 1), (3, 200)] {
            let once = directions(count);
            let normals = once.repeat(repeats);
            // Weights in an order unrelated to the normals, 1 on average.
            let weights: Vec<f64> = (0..normals.len())
                .map(|i| 0.5 + (7 * i % 11) as f64 / 10.0)
                .collect();
            let terms = normals
                .iter()
                .zip(&weights)
                .map(|(&polygon, &weight)| Term {
                    polygon,
                    vector: polygon * weight,
                    weight,
                });
            let sums = CapSums::new(terms.collect(), Sum::default());
            for degrees in [0.0f64, 10.0, 60.0, 90.0, 180.0] {
                let least = libm::cos(degrees.to_radians()) - 16.0 * f64::EPSILON;
                for own in directions(40)
                    .into_iter()
                    .chain(once.iter().copied().take(40))
                {
                    let near = normals
                        .iter()
                        .zip(&weights)
                        .filter(|(n, _)| own.dot(**n) >= least);
                    let expected: DVec3 = near.clone().map(|(n, w)| *n * *w).sum();
                    let total: f64 = near.clone().map(|(_, w)| w).sum();
                    let sum = sums.within(own, least);
                    assert_eq!(sum.count as usize, near.count(), "{count} {degrees}");
                    // Two orders of up to 600 additions of vectors whose lengths add up to at
                    // most 900.
                    let bound = 600.0 * 900.0 * f64::EPSILON;
                    assert!((sum.vector - expected).length() < bound);
                    assert!((sum.weight - total).abs() < bound);
                }
            }
        }
    }
}
