//! Sums of those unit normals that are within an angle of a given one, among many.

use alloc::vec::Vec;
use glam::DVec3;

/// The most normals of a leaf: so few are compared one by one.
const LEAF: usize = 16;

/// The rounding of a dot product of a unit vector with a corner of a box around unit vectors: three products and two
/// additions of numbers up to 1, each off by at most 2⁻⁵³, stay below this.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// Unit normals in a tree of boxes, halved along their longest sides.
///
/// A query adds up the boxes that lie within the angle, leaves out those beyond it, and opens those that it cuts. On the
/// sphere the border of a cap cuts some √n of n boxes, and a handful where the normals lie along a curve, as around the tip
/// of a cone.
pub(super) struct CapSums {
    normals: Vec<DVec3>,
    nodes: Vec<Node>,
}

/// A box around some of the normals, and their sum.
struct Node {
    low: DVec3,
    high: DVec3,
    sum: DVec3,
    /// The range of normals.
    first: usize,
    end: usize,
    /// The second half; the first one is the next node. `None` for a leaf.
    second: Option<usize>,
}

impl CapSums {
    /// Sorts `normals` into a tree.
    pub fn new(normals: Vec<DVec3>) -> Self {
        let mut sums = CapSums {
            nodes: Vec::with_capacity(2 * normals.len() / LEAF + 1),
            normals,
        };
        sums.node(0, sums.normals.len());
        sums
    }

    fn node(&mut self, first: usize, end: usize) -> usize {
        let part = &mut self.normals[first..end];
        let (low, high) = part
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &n| {
                (low.min(n), high.max(n))
            });
        let sides = high - low;
        let is_leaf = part.len() <= LEAF || sides == DVec3::ZERO;
        if !is_leaf {
            let axis = sides.max_position();
            let half = part.len() / 2;
            part.select_nth_unstable_by(half, |a, b| a[axis].total_cmp(&b[axis]));
        }
        let number = self.nodes.len();
        self.nodes.push(Node {
            low,
            high,
            sum: part.iter().sum(),
            first,
            end,
            second: None,
        });
        if !is_leaf {
            let middle = first + (end - first) / 2;
            self.node(first, middle);
            self.nodes[number].second = Some(self.node(middle, end));
        }
        number
    }

    /// Returns the sum of all normals whose dot product with `own` is at least `least_cosine`, and their number.
    pub fn within(&self, own: DVec3, least_cosine: f64) -> (DVec3, u32) {
        let (mut sum, mut count) = (DVec3::ZERO, 0);
        let mut open: Vec<usize> = Vec::from([0]);
        while let Some(number) = open.pop() {
            let node = &self.nodes[number];
            let (a, b) = (own * node.low, own * node.high);
            let least = a.min(b).element_sum();
            let most = a.max(b).element_sum();
            if most < least_cosine - SLACK {
                continue;
            }
            if least >= least_cosine + SLACK {
                sum += node.sum;
                count += (node.end - node.first) as u32;
                continue;
            }
            if let Some(second) = node.second {
                open.extend([second, number + 1]);
                continue;
            }
            for normal in &self.normals[node.first..node.end] {
                if own.dot(*normal) >= least_cosine {
                    sum += normal;
                    count += 1;
                }
            }
        }
        (sum, count)
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
            let sums = CapSums::new(normals.clone());
            for degrees in [0.0f64, 10.0, 60.0, 90.0, 180.0] {
                let least = libm::cos(degrees.to_radians()) - 16.0 * f64::EPSILON;
                for own in directions(40)
                    .into_iter()
                    .chain(once.iter().copied().take(40))
                {
                    let near = normals.iter().filter(|n| own.dot(**n) >= least);
                    let expected: DVec3 = near.clone().sum();
                    let (sum, found) = sums.within(own, least);
                    assert_eq!(found as usize, near.count(), "{count} {degrees}");
                    // Two orders of up to 600 additions of unit vectors.
                    assert!((sum - expected).length() < 600.0 * 600.0 * f64::EPSILON);
                }
            }
        }
    }
}
