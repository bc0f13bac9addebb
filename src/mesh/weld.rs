//! Finds positions that coincide, exactly or nearly, as along the seams of meshes whose files
//! repeat positions.

use super::PolygonMesh;
use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;
use glam::Vec3;

/// Returns for each position the index of its value among the distinct positions, and how many
/// distinct positions there are.
///
/// Two positions are equal if their coordinates are; −0 equals 0. Indices follow first occurrence.
/// A hash table does the work. If positions were chosen to collide in it, the fallback sorts them,
/// in `n log n` comparisons.
pub fn weld(positions: &[Vec3]) -> (Vec<u32>, usize) {
    number_distinct(positions.len(), |i| key(&positions[i]))
}

/// Returns the longest side of the box around the polygons of `mesh`; 0 without polygons.
pub(super) fn size(mesh: &PolygonMesh) -> f64 {
    mesh.bounds()
        .map_or(0.0, |(low, high)| (high - low).max_element())
}

#[cfg(feature = "io")]
impl PolygonMesh {
    /// Moves each position onto the first one that is nearer than `part` of the mesh's size, so
    /// that both become one vertex.
    pub fn weld(&mut self, part: f64) {
        let distance = part * size(self);
        let wide: Vec<DVec3> = self.positions.iter().map(|p| p.as_dvec3()).collect();
        let first = weld_near(&wide, distance);
        self.positions = first.iter().map(|&i| self.positions[i as usize]).collect();
    }
}

/// Returns for each position the index of the first earlier one that is at most `distance` away and
/// has not moved itself; the position's own index if there is none.
pub(super) fn weld_near(positions: &[DVec3], distance: f64) -> Vec<u32> {
    if distance <= 0.0 || positions.is_empty() {
        return (0..positions.len() as u32).collect();
    }
    // Only positions that stay are stored. They are farther than `distance` apart, so a cell of
    // this side holds few of them, and a search looks at no more than two cells per axis.
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

/// Returns bits that are equal exactly if the positions are. Adding 0.0 turns −0.0 into 0.0 and
/// changes nothing else.
fn key(p: &Vec3) -> [u32; 3] {
    [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())
}

/// Returns for each of `len` keys its index among the distinct keys, by first occurrence, and how
/// many distinct keys there are. It is as fast as [`weld`].
pub fn number_distinct(len: usize, key: impl Fn(usize) -> [u32; 3]) -> (Vec<u32>, usize) {
    by_hash(len, &key).unwrap_or_else(|| by_sorting(len, &key))
}

/// Looks up each key in a hash table of the keys before it, with linear probing. Returns `None` if
/// that takes more than a few steps per key: the keys may have been chosen to collide.
fn by_hash(len: usize, key: &impl Fn(usize) -> [u32; 3]) -> Option<(Vec<u32>, usize)> {
    const NONE: u32 = u32::MAX;
    // The table is at most half full, so a probe always finds an empty slot.
    let bits = (2 * len).next_power_of_two().trailing_zeros().max(1);
    let mask = (1usize << bits) - 1;
    // A slot holds where its key occurs first.
    let mut table = vec![NONE; mask + 1];
    let mut indices = vec![0; len];
    let (mut count, mut steps) = (0, 16 * len + 64);
    for i in 0..len {
        let own = key(i);
        // The high bits of the hash are the best mixed ones.
        let mut slot = (hash(own) >> (64 - bits)) as usize;
        indices[i] = loop {
            steps = steps.checked_sub(1)?;
            let first = table[slot];
            if first == NONE {
                table[slot] = i as u32;
                count += 1;
                break count as u32 - 1;
            }
            if key(first as usize) == own {
                break indices[first as usize];
            }
            slot = (slot + 1) & mask;
        };
    }
    Some((indices, count))
}

/// Returns what [`weld`] returns, but faster if most positions are repeated. Its table holds only
/// the distinct positions and grows with them.
#[cfg(feature = "io")]
pub(super) fn weld_repeated(positions: &[Vec3]) -> (Vec<u32>, usize) {
    repeated(positions).unwrap_or_else(|| weld(positions))
}

/// Indexes positions by a table that grows. Returns `None` if that takes more than a few steps per
/// position.
#[cfg(feature = "io")]
fn repeated(positions: &[Vec3]) -> Option<(Vec<u32>, usize)> {
    const NONE: u32 = u32::MAX;
    let mut steps = 16 * positions.len() + 64;
    // In a closed triangle mesh six triangles meet at a vertex on average, so there are about a
    // sixth as many distinct positions.
    let mut bits = (positions.len() / 4)
        .next_power_of_two()
        .trailing_zeros()
        .max(10);
    let mut table = vec![NONE; 1 << bits];
    let mut keys: Vec<[u32; 3]> = Vec::new();
    let mut indices = Vec::with_capacity(positions.len());
    for position in positions {
        let own = key(position);
        let mut slot = (hash(own) >> (64 - bits)) as usize;
        loop {
            steps = steps.checked_sub(1)?;
            let index = table[slot];
            if index == NONE {
                table[slot] = keys.len() as u32;
                indices.push(keys.len() as u32);
                keys.push(own);
                break;
            }
            if keys[index as usize] == own {
                indices.push(index);
                break;
            }
            slot = (slot + 1) & (table.len() - 1);
        }
        // Past half full the table doubles, and all keys find their slots again.
        if 2 * keys.len() > table.len() {
            bits += 1;
            table = vec![NONE; 1 << bits];
            for (index, key) in keys.iter().enumerate() {
                let mut slot = (hash(*key) >> (64 - bits)) as usize;
                while table[slot] != NONE {
                    steps = steps.checked_sub(1)?;
                    slot = (slot + 1) & (table.len() - 1);
                }
                table[slot] = index as u32;
            }
        }
    }
    let count = keys.len();
    Some((indices, count))
}

/// Hashes three words. The highest bits of the result depend on every bit of all three.
fn hash([x, y, z]: [u32; 3]) -> u64 {
    const ODD: [u64; 2] = [0x9E37_79B9_7F4A_7C15, 0xD6E8_FEB8_6659_FD93];
    let first = ((u64::from(x) << 32) | u64::from(y)).wrapping_mul(ODD[0]);
    ((first ^ (first >> 32)).wrapping_add(u64::from(z))).wrapping_mul(ODD[1])
}

/// Indexes keys by sorting them, at 16 bytes per key.
fn by_sorting(len: usize, key: &impl Fn(usize) -> [u32; 3]) -> (Vec<u32>, usize) {
    let mut sorted: Vec<[u32; 4]> = Vec::with_capacity(len);
    sorted.extend((0..len).map(|i| {
        let [x, y, z] = key(i);
        [x, y, z, i as u32]
    }));
    sorted.sort_unstable();
    // Two passes: the first gives each key the place of its first equal. The second replaces places
    // by indices in ascending order; a key whose place is its own is a new one, and the index of
    // any other was set before.
    let mut indices = vec![0; len];
    let mut first = 0;
    for (k, key) in sorted.iter().enumerate() {
        if key[..3] != sorted[first][..3] {
            first = k;
        }
        indices[key[3] as usize] = sorted[first][3];
    }
    drop(sorted);
    let mut count = 0;
    for i in 0..indices.len() {
        indices[i] = if indices[i] as usize == i {
            count += 1;
            count as u32 - 1
        } else {
            indices[indices[i] as usize]
        };
    }
    (indices, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_share_an_index_in_order_of_first_occurrence() {
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
        // Comparing each position with all earlier ones must find the same result, wherever cells
        // begin.
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
            // Few distinct coordinates of either sign, zero among them.
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
            let mut index_of = |i: usize| {
                let known = distinct.iter().position(|&known| known == key(i));
                known.unwrap_or_else(|| {
                    distinct.push(key(i));
                    distinct.len() - 1
                }) as u32
            };
            let by_comparing: Vec<u32> = (0..count).map(&mut index_of).collect();
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
            // Only keys of the first slot, of the 512 that two hundred positions get.
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
