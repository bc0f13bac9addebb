//! The origin of a mesh far from 0: taken off before positions are rounded to `f32`.

use glam::DVec3;

/// The distance of a mesh from 0, in extents of it, from which on it gets an origin of its own. Nearer ones lose at most
/// log₂ 16 + 1 of the 24 bits of an `f32`.
const FAR: f64 = 16.0;

/// Returns the point that positions are best counted from: 0, unless the centre of their bounds is farther than [`FAR`]
/// extents from it.
///
/// Each coordinate is a multiple of a power of two, the least over the extent. So the origin is within half of that from the
/// centre, and what is left is at most 1½ extents. Along an axis where the mesh is far from 0, a
/// position and the origin are within a factor of two of one another, and their difference is exact (Sterbenz 1974); along
/// others it is off by at most 2⁻⁵³ extents.
pub(super) fn origin(positions: &[DVec3]) -> DVec3 {
    let Some(&first) = positions.first() else {
        return DVec3::ZERO;
    };
    let (low, high) = positions
        .iter()
        .fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
    let centre = 0.5 * low + 0.5 * high;
    let extent = (high - low).max_element();
    // Written so that without an extent, or with one that is not finite, nothing is taken off.
    if !(extent > 0.0 && centre.abs().max_element() > FAR * extent && extent.is_normal()) {
        return DVec3::ZERO;
    }
    // With the fraction cleared, the power of two that is no larger than the extent.
    let step = 2.0 * f64::from_bits(extent.to_bits() & f64::INFINITY.to_bits());
    (centre / step).round() * step
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    fn cloud(at: DVec3, extent: f64) -> Vec<DVec3> {
        let mut random = crate::number::test_random::Random::new(3);
        let mut side = || 0.5 * extent * f64::from(random.signed());
        let mut all: Vec<DVec3> = (0..100)
            .map(|_| at + DVec3::new(side(), side(), side()))
            .collect();
        all.extend([at - 0.5 * extent, at + 0.5 * extent]);
        all
    }

    #[test]
    fn meshes_near_zero_keep_it_as_their_origin() {
        for at in [
            DVec3::ZERO,
            DVec3::new(3.0, -15.9, 7.0),
            DVec3::new(0.0, 0.0, 15.9),
        ] {
            assert_eq!(origin(&cloud(at, 1.0)), DVec3::ZERO, "{at}");
        }
        assert_eq!(origin(&[]), DVec3::ZERO);
        assert_eq!(origin(&[DVec3::new(1e9, 0.0, 0.0)]), DVec3::ZERO);
    }

    #[test]
    fn far_ones_are_near_their_origin_and_no_bit_is_lost() {
        for (at, extent) in [
            (DVec3::new(0.0, 16.1, 0.0), 1.0),
            (DVec3::new(500_123.0, 200.0, -5_412_345.0), 12.0),
            (DVec3::new(4_027_894.0, 307_046.0, 4_919_499.0), 300.0),
            (DVec3::new(1.0, 1.0, 1.0), 1e-7),
            (DVec3::new(-1e9, 1e9, 3.0), 0.5),
            (DVec3::new(1e15, 0.0, 0.0), 1e3),
        ] {
            let all = cloud(at, extent);
            let origin = origin(&all);
            assert!((origin - at).abs().max_element() <= extent, "{at} {origin}");
            for &p in &all {
                let left = p - origin;
                assert!(left.abs().max_element() <= 1.5 * extent, "{at} {p}");
                for axis in 0..3 {
                    let is_far = at[axis].abs() > FAR * extent;
                    assert!(!is_far || origin[axis] + left[axis] == p[axis]);
                }
            }
        }
    }
}
