//! Finds positions that coincide, exactly or nearly: the seams of meshes whose files repeat them.

use super::PolygonMesh;
use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec3, Vec3};

/// Returns for each position the number of its first equal among the different ones, and the number of different ones.
///
/// Positions are equal when their coordinates are, so that −0 is 0. Numbers go by first occurrence. Takes a hash table's
/// time, and `n log n` comparisons where positions were chosen to collide in it.
pub fn weld(positions: &[Vec3]) -> (Vec<u32>, usize) {
    number_distinct(positions.len(), |i| key(&positions[i]))
}

/// Returns the longest side of the box around the polygons of `mesh`; 0 without polygons.
pub(super) fn size(mesh: &PolygonMesh) -> f64 {
    mesh.bounds()
        .map_or(0.0, |(low, high)| (high - low).max_element())
}

impl PolygonMesh {
    /// Moves each position to the first one that is nearer than `part` of the size of the mesh, so that both are one vertex.
    #[doc(hidden)]
    pub fn weld(&mut self, part: f64) {
        let distance = part * size(self);
        let wide: Vec<DVec3> = self.positions.iter().map(|p| p.as_dvec3()).collect();
        let first = weld_near(&wide, distance);
        self.positions = first.iter().map(|&i| self.positions[i as usize]).collect();
    }
}

/// Returns for each position the index of the first one that is at most `distance` away and is not moved itself: itself, if there
/// is none before it.
pub(super) fn weld_near(positions: &[DVec3], distance: f64) -> Vec<u32> {
    if distance <= 0.0 || positions.is_empty() {
        return (0..positions.len() as u32).collect();
    }
    // Positions that stay lie farther apart than the distance, so that a cell of this side holds few of them.
    let side = 2.0 * distance;
    let low = positions.iter().fold(positions[0], |low, &p| low.min(p));
    let cell = |at: f64, axis: usize| libm::floor((at - low[axis]) / side) as i64;
    let mut cells: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    let mut first = Vec::with_capacity(positions.len());
    for (i, &p) in positions.iter().enumerate() {
        let range = |axis: usize| cell(p[axis] - distance, axis)..=cell(p[axis] + distance, axis);
        let mut found = i as u32;
        for x in range(0) {
            for y in range(1) {
                for z in range(2) {
                    for &other in cells.get(&[x, y, z]).into_iter().flatten() {
                        if (positions[other as usize] - p).length() <= distance {
                            found = found.min(other);
                        }
                    }
                }
            }
        }
        first.push(found);
        if found == i as u32 {
            let own = [0, 1, 2].map(|axis| cell(p[axis], axis));
            cells.entry(own).or_default().push(found);
        }
    }
    first
}

/// Returns bits that are equal exactly when the positions are: adding 0.0 turns −0.0 into 0.0.
fn key(p: &Vec3) -> [u32; 3] {
    [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())
}

/// Returns for each of `len` keys its number among the different ones, by first occurrence, and the number of different
/// ones; in the time that [`weld`] takes.
pub(crate) fn number_distinct(len: usize, key: impl Fn(usize) -> [u32; 3]) -> (Vec<u32>, usize) {
    by_hash(len, &key).unwrap_or_else(|| by_sorting(len, &key))
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

/// Returns what [`weld`] does, sooner where most positions are repeated: its table holds the different ones alone, and grows with them.
#[cfg(feature = "io")]
pub(super) fn weld_repeated(positions: &[Vec3]) -> (Vec<u32>, usize) {
    repeated(positions).unwrap_or_else(|| weld(positions))
}

/// Numbers positions by a table that grows; `None` where that takes more than a few steps a position.
#[cfg(feature = "io")]
fn repeated(positions: &[Vec3]) -> Option<(Vec<u32>, usize)> {
    const NONE: u32 = u32::MAX;
    let mut steps = 16 * positions.len() + 64;
    // A vertex of a closed surface is in six triangles on average.
    let mut bits = (positions.len() / 4)
        .next_power_of_two()
        .trailing_zeros()
        .max(10);
    let mut table = vec![NONE; 1 << bits];
    let mut keys: Vec<[u32; 3]> = Vec::new();
    let mut numbers = Vec::with_capacity(positions.len());
    for position in positions {
        let own = key(position);
        let mut slot = (hash(own) >> (64 - bits)) as usize;
        loop {
            steps = steps.checked_sub(1)?;
            let number = table[slot];
            if number == NONE {
                table[slot] = keys.len() as u32;
                numbers.push(keys.len() as u32);
                keys.push(own);
                break;
            }
            if keys[number as usize] == own {
                numbers.push(number);
                break;
            }
            slot = (slot + 1) & (table.len() - 1);
        }
        // At most half full.
        if 2 * keys.len() > table.len() {
            bits += 1;
            table = vec![NONE; 1 << bits];
            for (number, key) in keys.iter().enumerate() {
                let mut slot = (hash(*key) >> (64 - bits)) as usize;
                while table[slot] != NONE {
                    steps = steps.checked_sub(1)?;
                    slot = (slot + 1) & (table.len() - 1);
                }
                table[slot] = number as u32;
            }
        }
    }
    let count = keys.len();
    Some((numbers, count))
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
    fn near_positions_move_to_the_first_one_and_never_along_a_chain() {
        let at = |x: f64| DVec3::new(x, 1.0, -2.0);
        let chain = [0.0, 0.9, 1.8, 2.7, 10.0, 9.5, 0.0].map(at);
        assert_eq!(weld_near(&chain, 1.0), [0, 0, 2, 2, 4, 4, 0]);
        assert_eq!(weld_near(&chain, 0.0), [0, 1, 2, 3, 4, 5, 6]);
        assert!(weld_near(&[], 1.0).is_empty());
        // As comparing each with all before it finds, wherever cells begin.
        let mut random = crate::number::test_random::Random::new(9);
        let mut coordinate = || f64::from(random.signed()) * 4.0;
        let all: Vec<DVec3> = (0..2000)
            .map(|_| DVec3::new(coordinate(), coordinate(), coordinate()))
            .collect();
        let found = weld_near(&all, 0.5);
        for (i, p) in all.iter().enumerate() {
            let stays = |other: &usize| found[*other] as usize == *other;
            let near = |other: &usize| (all[*other] - *p).length() <= 0.5;
            let first = (0..i).filter(stays).find(near).unwrap_or(i);
            assert_eq!(found[i] as usize, first);
        }
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
            let mut distinct = Vec::new();
            let mut number = |i: usize| {
                let known = distinct.iter().position(|&known| known == key(i));
                known.unwrap_or_else(|| {
                    distinct.push(key(i));
                    distinct.len() - 1
                }) as u32
            };
            let by_comparing: Vec<u32> = (0..count).map(&mut number).collect();
            assert_eq!(by_hash, (by_comparing, distinct.len()));
            #[cfg(feature = "io")]
            assert_eq!(repeated(&all), Some(by_hash));
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
        #[cfg(feature = "io")]
        assert_eq!((repeated(&all), weld_repeated(&all)), (None, weld(&all)));
    }
}
