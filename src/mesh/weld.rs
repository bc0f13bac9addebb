//! Finds positions that coincide exactly: the seams of meshes whose files repeat them.

use alloc::vec;
use alloc::vec::Vec;
use glam::Vec3;

/// Returns for each position the number of its first equal among the different ones, and the number of different ones.
///
/// Positions are equal when their coordinates are, so that −0 is 0. Numbers go by first occurrence. Takes a hash table's
/// time, and `n log n` comparisons where positions were chosen to collide in it.
pub fn weld(positions: &[Vec3]) -> (Vec<u32>, usize) {
    number_distinct(positions.len(), |i| key(&positions[i]))
}

/// Returns bits that are equal exactly when the positions are: adding 0.0 turns −0.0 into 0.0.
fn key(p: &Vec3) -> [u32; 3] {
    [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())
}

/// Returns for each of `len` keys its number among the different ones, by first occurrence, and the number of different
/// ones; in the time that [`weld`] takes.
pub(crate) fn number_distinct(len: usize, key: impl Fn(usize) -> [u32; 3]) -> (Vec<u32>, usize) {
    match len {
        0..=FEW => by_comparing(len, &key),
        _ => by_hash(len, &key).unwrap_or_else(|| by_sorting(len, &key)),
    }
}

/// So few keys are compared each with all before it.
const FEW: usize = 16;

fn by_comparing(len: usize, key: &impl Fn(usize) -> [u32; 3]) -> (Vec<u32>, usize) {
    let mut number = vec![0; len];
    let mut count = 0;
    for i in 0..len {
        number[i] = match (0..i).find(|&before| key(before) == key(i)) {
            Some(equal) => number[equal],
            None => {
                count += 1;
                count as u32 - 1
            }
        };
    }
    (number, count)
}

/// Looks each key up in a table of those before it; `None` where that takes more than a few steps a key.
fn by_hash(len: usize, key: &impl Fn(usize) -> [u32; 3]) -> Option<(Vec<u32>, usize)> {
    const NONE: u32 = u32::MAX;
    // At most half full.
    let bits = (2 * len).next_power_of_two().trailing_zeros().max(1);
    let mask = (1usize << bits) - 1;
    // The first key of each kind.
    let mut table = vec![NONE; mask + 1];
    let mut number = vec![0; len];
    let (mut count, mut steps) = (0, 16 * len + 64);
    for i in 0..len {
        let own = key(i);
        let mut slot = (hash(own) >> (64 - bits)) as usize;
        number[i] = loop {
            steps = steps.checked_sub(1)?;
            let first = table[slot];
            if first == NONE {
                table[slot] = i as u32;
                count += 1;
                break count as u32 - 1;
            }
            if key(first as usize) == own {
                break number[first as usize];
            }
            slot = (slot + 1) & mask;
        };
    }
    Some((number, count))
}

/// Hashes three words: the highest bits depend on all bits of all of them.
fn hash([x, y, z]: [u32; 3]) -> u64 {
    const ODD: [u64; 2] = [0x9E37_79B9_7F4A_7C15, 0xD6E8_FEB8_6659_FD93];
    let first = ((u64::from(x) << 32) | u64::from(y)).wrapping_mul(ODD[0]);
    ((first ^ (first >> 32)).wrapping_add(u64::from(z))).wrapping_mul(ODD[1])
}

/// Numbers by sorting, 16 bytes a key.
fn by_sorting(len: usize, key: &impl Fn(usize) -> [u32; 3]) -> (Vec<u32>, usize) {
    let mut sorted: Vec<[u32; 4]> = Vec::with_capacity(len);
    sorted.extend((0..len).map(|i| {
        let [x, y, z] = key(i);
        [x, y, z, i as u32]
    }));
    sorted.sort_unstable();
    // First the lowest index among equals, then the numbers in order of those.
    let mut number = vec![0; len];
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
        let p = [
            Vec3::Z,
            Vec3::new(0.0, 1.0, -0.0),
            Vec3::Z,
            Vec3::X,
            Vec3::new(-0.0, 1.0, 0.0),
            Vec3::Z,
        ];
        assert_eq!(weld(&p), (vec![0, 1, 0, 2, 1, 0], 3));
        assert_eq!(weld(&[]), (Vec::new(), 0));
    }

    #[test]
    fn table_and_sorting_agree() {
        let mut random = crate::number::test_random::Random::new(5);
        for count in [1, 2, 10, 1000, 5000] {
            // Few different coordinates, of either sign, zero among them.
            let mut coordinate =
                || (random.signed() * 6.0) as i32 as f32 * random.signed().signum();
            let all: Vec<Vec3> = (0..count)
                .map(|_| Vec3::new(coordinate(), coordinate(), coordinate()))
                .collect();
            let key = |i: usize| key(&all[i]);
            let by_hash = by_hash(count, &key).expect("no collisions were sought");
            assert!(count < 1000 || by_hash.1 < count, "nothing to weld");
            assert_eq!(by_hash, by_sorting(count, &key));
            assert_eq!(by_hash, by_comparing(count, &key));
        }
    }

    #[test]
    fn positions_that_collide_are_sorted() {
        let mut random = crate::number::test_random::Random::new(6);
        let mut all = Vec::new();
        while all.len() < 200 {
            let position = Vec3::new(random.signed(), random.signed(), random.signed());
            // The first slot of the 512 that two hundred positions get.
            if hash(key(&position)) >> (64 - 9) == 0 {
                all.push(position);
            }
        }
        let key = |i: usize| key(&all[i]);
        assert_eq!(by_hash(all.len(), &key), None);
        assert_eq!(weld(&all), by_sorting(all.len(), &key));
    }
}
