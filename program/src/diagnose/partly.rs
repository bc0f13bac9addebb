//! Which mistakes are certain though something else is wrong.

use super::combinations::{Combinations, Set, is_of_a_space};
use super::outline::OTHER_OUTLINE;
use alloc::vec::Vec;

/// What the right shape of light may leave with free amounts where something else is wrong, in
/// levels.
const NEARLY_RIGHT: f64 = 0.4;

/// The sets of mistakes that come nearest to a picture, none of which explains it.
pub struct Near<'s> {
    /// The sets, and what they leave in levels, the best first.
    pub found: Vec<(&'s Set, f64)>,
    /// The distance of the picture from the right one.
    pub before: f64,
}

impl Near<'_> {
    /// True if mistakes that leave `left` are part of what is wrong.
    pub fn is_part(&self, left: f64) -> bool {
        let is_near = self
            .found
            .first()
            .is_some_and(|(_, best)| *best < 0.5 * self.before);
        is_near && left < 0.75 * self.before
    }

    /// Returns those mistakes of the nearest set that all near ones share, and that take much away.
    /// Amounts are left out: factors of light can be wrong in many ways.
    pub fn certain(&self, combinations: &mut Combinations<'_, '_>) -> Set {
        let Some((own, best)) = self.found.first() else {
            return Set::new();
        };
        let Some((shape, left)) = combinations.shapes.first().cloned() else {
            return Set::new();
        };
        let near = |(_, left): &&(&Set, f64)| *left <= 1.25 * best + 0.02;
        let near: Vec<&Set> = self
            .found
            .iter()
            .filter(near)
            .map(|(set, _)| *set)
            .collect();
        let camera = own.iter().copied().filter(|&m| combinations.is_camera(m));
        let camera: Set = camera.collect();
        let error = combinations.outline_error(&camera).unwrap_or(1.0);
        let is_shape_right = left <= NEARLY_RIGHT && error <= OTHER_OUTLINE;
        let shapes = combinations.shapes.iter();
        let shapes = shapes.take_while(|(_, other)| *other <= 1.25 * left + 0.05);
        let shapes: Vec<Set> = shapes.map(|(set, _)| set.clone()).collect();
        let is_in_all = |m: usize| {
            near.iter().all(|other| other.contains(&m))
                && shapes.iter().all(|other| other.contains(&m))
        };
        let exact = combinations.left(own);
        let mut certain = Set::new();
        for &m in own.iter() {
            let without = |set: &Set| -> Set { set.iter().copied().filter(|k| *k != m).collect() };
            let is_certain = if combinations.is_camera(m) {
                let other = combinations.outline_error(&without(&camera)).unwrap_or(0.0);
                let takes_half = combinations.left(&without(own)) - exact >= 0.5 * self.before;
                let is_seen_inside = is_in_all(m) && (is_shape_right || takes_half);
                let is_in_near = near.iter().all(|other| other.contains(&m));
                is_in_near && other > 2.0 * error + 1e-3 || is_seen_inside
            } else {
                let may_be_told = !combinations.is_amount(m) && !is_of_a_space(m);
                may_be_told && is_shape_right && is_in_all(m) && {
                    let other = combinations.left_with_free_amounts(&without(&shape));
                    other - left >= 0.3 * other
                }
            };
            if is_certain {
                certain.push(m);
            }
        }
        certain
    }
}
