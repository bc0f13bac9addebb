//! Colours as bytes, against the scalar machine.

use super::tests::wide;
use crate::number::{Lanes, LanesJob, Level, Scalar, on_level};
use crate::test_random::Random;
use std::vec;
use std::vec::Vec;

/// Colours as bytes: of every pixel whether it is covered.
struct Packed<'a> {
    channels: [&'a [f32]; 3],
    are_levels: bool,
    covered: &'a [f32],
}

const BACKGROUND: [u8; 4] = [10, 200, 255, 0];

impl LanesJob for Packed<'_> {
    type Out = Vec<[u8; 4]>;

    fn run<M: Lanes>(self, m: M) -> Vec<[u8; 4]> {
        let mut to = vec![[1, 2, 3, 4]; self.covered.len() + 5];
        for x in (0..self.covered.len()).step_by(M::WIDTH) {
            let covered = m.less(m.load(&self.covered[x..]), m.splat(0.0));
            let rgb = self.channels.map(|channel| m.load(&channel[x..]));
            if self.are_levels {
                m.pack_levels(rgb, covered, BACKGROUND, &mut to[x..]);
            } else {
                m.pack(rgb, covered, BACKGROUND, &mut to[x..]);
            }
        }
        to
    }
}

/// Every level's own value, both borders and their neighbours, values outside of 0..=1 and no numbers, in each channel; and 255 times
/// that, where magnitudes of 2³¹ and more are not asked for.
#[test]
fn colours_are_stored_as_one_by_one() {
    let mut values: Vec<f32> = vec![
        f32::NAN,
        -f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        -1.0,
        2.0,
        -0.0,
        1e-40,
        -1e-40,
    ];
    for level in 0..=255u16 {
        let border = ((f64::from(level) + 0.5) / 255.0) as f32;
        values.extend([
            f32::from(level) / 255.0,
            border,
            border.next_up(),
            border.next_down(),
        ]);
    }
    values.resize(values.len().next_multiple_of(8), 0.25);
    let mut levels: Vec<f32> = values
        .iter()
        .map(|c| {
            if c.is_infinite() {
                8e6f32.copysign(*c)
            } else {
                *c
            }
        })
        .collect();
    levels.iter_mut().for_each(|c| *c *= 255.0);
    for (values, are_levels) in [(values, false), (levels, true)] {
        let turned = |by: usize| -> Vec<f32> {
            values
                .iter()
                .cycle()
                .skip(by)
                .take(values.len())
                .copied()
                .collect()
        };
        let (green, blue) = (turned(331), turned(77));
        let mut random = Random::new(9);
        let covered: Vec<f32> = values.iter().map(|_| random.signed() + 0.5).collect();
        let channels = [&values[..], &green, &blue];
        let packed = |level| {
            on_level(
                level,
                Packed {
                    channels,
                    are_levels,
                    covered: &covered,
                },
            )
        };
        let expected = packed(Level::Scalar);
        assert!(expected.contains(&BACKGROUND) && expected.iter().any(|t| t[3] == 255));
        for level in wide() {
            for (i, (found, expected)) in packed(level).iter().zip(&expected).enumerate() {
                let rgb = channels.map(|channel| channel.get(i));
                assert_eq!(found, expected, "{level} at {i}: {rgb:?}");
            }
        }
    }
    let [nan, infinite] = [f32::NAN, f32::INFINITY].map(|c| {
        let mut to = [[0; 4]];
        Scalar.pack([c; 3], true, BACKGROUND, &mut to);
        to[0]
    });
    assert_eq!((nan, infinite), ([0, 0, 0, 255], [255; 4]));
}
