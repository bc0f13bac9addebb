//! Finds positions that coincide exactly: the seams of meshes whose files repeat them.

use alloc::vec;
use alloc::vec::Vec;
use glam::Vec3;

/// For each position the number of its first equal among the different ones, and how many different ones there are.
///
/// Positions are equal when their coordinates are, so that −0 is 0. Numbers go by first occurrence. Takes `n log n`
/// comparisons whatever the positions are, and 16 bytes a position while it runs.
pub fn weld(positions: &[Vec3]) -> (Vec<u32>, usize) {
    // Adding 0.0 turns −0.0 into 0.0; the bits then are equal exactly when the numbers are.
    let bits = |x: f32| (x + 0.0).to_bits();
    let mut sorted: Vec<[u32; 4]> = Vec::with_capacity(positions.len());
    sorted.extend(positions.iter().enumerate().map(|(i, p)| [bits(p.x), bits(p.y), bits(p.z), i as u32]));
    sorted.sort_unstable();
    // First the lowest index among equals, then the numbers in order of those.
    let mut number = vec![0; positions.len()];
    let mut first = 0;
    for (k, key) in sorted.iter().enumerate() {
        if key[..3] != sorted[first][..3] {
            first = k;
        }
        number[key[3] as usize] = sorted[first][3];
    }
    drop(sorted);
    let mut count = 0;
    for i in 0..number.len() {
        number[i] = if number[i] as usize == i {
            count += 1;
            count as u32 - 1
        } else {
            number[number[i] as usize]
        };
    }
    (number, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_share_a_number_in_order_of_first_occurrence() {
        let p = [Vec3::Z, Vec3::new(0.0, 1.0, -0.0), Vec3::Z, Vec3::X, Vec3::new(-0.0, 1.0, 0.0), Vec3::Z];
        assert_eq!(weld(&p), (vec![0, 1, 0, 2, 1, 0], 3));
        assert_eq!(weld(&[]), (Vec::new(), 0));
    }
}
