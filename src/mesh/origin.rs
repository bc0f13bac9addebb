//! The origin of a mesh that lies far from 0. It is subtracted before positions are rounded to
//! `f32`.

use glam::DVec3;

/// A mesh farther from 0 than this many times its extent gets its own origin. A nearer mesh loses
/// at most log₂ 16 + 1 of the 24 bits of an `f32`.
const FAR: f64 = 16.0;

/// Returns the origin for these positions: 0, unless the centre of their bounds is farther than
/// [`FAR`] extents from 0.
///
/// The origin is the centre, with each coordinate rounded to a multiple of the smallest power of
/// two above the extent. So it is within half of that power from the centre, and positions relative
/// to it are at most 1½ extents long in each coordinate. Along an axis where the mesh is far from
/// 0, a position and the origin are within a factor of two of each other, so their difference is
/// exact (Sterbenz 1974). Along the other axes the difference is off by at most 2⁻⁵³ extents.
pub(super) fn origin(positions: &[DVec3]) -> DVec3 {
    let Some(&first) = positions.first() else {
        return DVec3::ZERO;
    };
    let (low, high) = positions
        .iter()
        .fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
    let centre = 0.5 * low + 0.5 * high;
    let extent = (high - low).max_element();
    // The test is negated as a whole, so that it also holds if the extent is 0 or any value is a
    // NaN.
    if !(extent > 0.0 && centre.abs().max_element() > FAR * extent && extent.is_normal()) {
        return DVec3::ZERO;
    }
    // The bits of infinity mask the exponent. With the fraction cleared, the extent becomes the
    // power of two at or below it.
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
