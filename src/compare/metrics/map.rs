//! Maps: the difference between two pictures as a picture.
//!
//! The caller sets the scale of a map in grey levels. It is never fitted to the pictures, because
//! maps of different methods can only be compared on the same scale. Equal pixels are black, and
//! any difference, however small, is not. Differences beyond the scale have a colour that the scale
//! does not contain.

use super::{PixelDifference, SizeMismatch, for_each_row};
use crate::picture::{LevelRows, Picture8};

/// The colour of equal pixels: black.
pub(crate) const EQUAL: [u8; 4] = [0, 0, 0, 255];
/// The colour of pixels whose error is beyond the scale, or that are finite in only one picture:
/// magenta. In the signed map, only pixels that are too bright.
pub(crate) const BEYOND: [u8; 4] = [255, 0, 255, 255];
/// The colour, in the signed map, of pixels that are too dark by more than the scale: green.
pub(crate) const BEYOND_DARKER: [u8; 4] = [0, 255, 0, 255];
/// The colour of pixels that only one picture covers, whatever their difference: white.
pub(crate) const COVERAGE: [u8; 4] = [255, 255, 255, 255];

/// The ends of the signed map's scale for pixels that are too bright: orange, from dark to light.
const BRIGHTER: [[f64; 3]; 2] = [[80.0, 32.0, 8.0], [255.0, 196.0, 120.0]];
/// The ends of its scale for pixels that are too dark: blue, which colour-blind eyes can tell from
/// orange.
const DARKER: [[f64; 3]; 2] = [[16.0, 40.0, 92.0], [136.0, 200.0, 255.0]];

/// Draws the absolute difference between two pictures in the colours of viridis. The difference of
/// a pixel is the largest one of its channels, including alpha.
///
/// Purple is the smallest difference, yellow a difference of `scale` grey levels. Equal pixels are
/// black. Pixels are magenta if they differ by more than `scale` or are finite in only one picture,
/// and white if only one picture covers them. If `scale` is zero, negative or NaN, every difference
/// is magenta.
///
/// # Errors
/// If the sizes differ.
pub fn difference_map(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    scale: f32,
) -> Result<Picture8, SizeMismatch> {
    paint(reference, actual, |difference| {
        absolute_colour(difference.largest(), f64::from(scale))
    })
}

/// Draws the signed difference of luminance between two pictures: orange where `actual` is too
/// bright, blue where it is too dark.
///
/// The darkest orange or blue is the smallest difference, the lightest a difference of `scale` grey
/// levels. Pixels of equal luminance are black. Pixels are magenta if they are too bright by more
/// than `scale` or are finite in only one picture, green if they are too dark by more than `scale`,
/// and white if only one picture covers them. If `scale` is zero, negative or NaN, every difference
/// is magenta or green.
///
/// # Errors
/// If the sizes differ.
pub fn signed_difference_map(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    scale: f32,
) -> Result<Picture8, SizeMismatch> {
    paint(reference, actual, |difference| {
        signed_colour(difference.luminance, f64::from(scale))
    })
}

/// Draws a map with the colour that `colour` returns for each difference.
fn paint(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    colour: impl Fn(&PixelDifference) -> [u8; 4],
) -> Result<Picture8, SizeMismatch> {
    SizeMismatch::check(reference.size(), actual.size())?;
    let [width, height] = reference.size();
    let mut map = Picture8::new(width, height, EQUAL);
    for_each_row(reference, actual, |y, r_row, a_row| {
        let pairs = r_row.iter().zip(a_row);
        for (out, (&r, &a)) in map.row_mut(y).iter_mut().zip(pairs) {
            *out = match PixelDifference::new(r, a) {
                None => EQUAL,
                Some(difference) if difference.is_mismatch => COVERAGE,
                Some(difference) if difference.is_not_finite_differing => BEYOND,
                Some(difference) => colour(&difference),
            };
        }
    });
    Ok(map)
}

/// Returns the colour of an absolute error on the scale, both in grey levels.
pub(super) fn absolute_colour(error: f64, scale: f64) -> [u8; 4] {
    if error == 0.0 {
        return EQUAL;
    }
    // Comparisons with NaN are false, so an error or a scale of NaN ends in the other branch.
    if error <= scale {
        let [_, r, g, b] = VIRIDIS[(255.0 * (error / scale) + 0.5) as usize].to_be_bytes();
        [r, g, b, 255]
    } else {
        BEYOND
    }
}

/// Returns the colour of a signed error on the scale, both in grey levels.
fn signed_colour(error: f64, scale: f64) -> [u8; 4] {
    if error == 0.0 {
        return EQUAL;
    }
    let ([from, to], beyond) = if error > 0.0 {
        (BRIGHTER, BEYOND)
    } else {
        (DARKER, BEYOND_DARKER)
    };
    if error.abs() <= scale {
        let share = error.abs() / scale;
        let [r, g, b] = core::array::from_fn(|i| (from[i] + share * (to[i] - from[i]) + 0.5) as u8);
        [r, g, b, 255]
    } else {
        beyond
    }
}

/// The colour map viridis, 0xRRGGBB. Equal steps look equal, even in grey and to colour-blind eyes,
/// and its dark end is not black.
///
/// By Nathaniel J. Smith, Stéfan van der Walt and Eric Firing, dedicated to the public domain
/// (CC0); 8-bit values as in Matplotlib 3.11.
#[rustfmt::skip]
static VIRIDIS: [u32; 256] = [
    0x440154, 0x440256, 0x450457, 0x450559, 0x46075a, 0x46085c, 0x460a5d, 0x460b5e, 0x470d60, 0x470e61, 0x471063,
    0x471164, 0x471365, 0x481467, 0x481668, 0x481769, 0x48186a, 0x481a6c, 0x481b6d, 0x481c6e, 0x481d6f, 0x481f70,
    0x482071, 0x482173, 0x482374, 0x482475, 0x482576, 0x482677, 0x482878, 0x482979, 0x472a7a, 0x472c7a, 0x472d7b,
    0x472e7c, 0x472f7d, 0x46307e, 0x46327e, 0x46337f, 0x463480, 0x453581, 0x453781, 0x453882, 0x443983, 0x443a83,
    0x443b84, 0x433d84, 0x433e85, 0x423f85, 0x424086, 0x424186, 0x414287, 0x414487, 0x404588, 0x404688, 0x3f4788,
    0x3f4889, 0x3e4989, 0x3e4a89, 0x3e4c8a, 0x3d4d8a, 0x3d4e8a, 0x3c4f8a, 0x3c508b, 0x3b518b, 0x3b528b, 0x3a538b,
    0x3a548c, 0x39558c, 0x39568c, 0x38588c, 0x38598c, 0x375a8c, 0x375b8d, 0x365c8d, 0x365d8d, 0x355e8d, 0x355f8d,
    0x34608d, 0x34618d, 0x33628d, 0x33638d, 0x32648e, 0x32658e, 0x31668e, 0x31678e, 0x31688e, 0x30698e, 0x306a8e,
    0x2f6b8e, 0x2f6c8e, 0x2e6d8e, 0x2e6e8e, 0x2e6f8e, 0x2d708e, 0x2d718e, 0x2c718e, 0x2c728e, 0x2c738e, 0x2b748e,
    0x2b758e, 0x2a768e, 0x2a778e, 0x2a788e, 0x29798e, 0x297a8e, 0x297b8e, 0x287c8e, 0x287d8e, 0x277e8e, 0x277f8e,
    0x27808e, 0x26818e, 0x26828e, 0x26828e, 0x25838e, 0x25848e, 0x25858e, 0x24868e, 0x24878e, 0x23888e, 0x23898e,
    0x238a8d, 0x228b8d, 0x228c8d, 0x228d8d, 0x218e8d, 0x218f8d, 0x21908d, 0x21918c, 0x20928c, 0x20928c, 0x20938c,
    0x1f948c, 0x1f958b, 0x1f968b, 0x1f978b, 0x1f988b, 0x1f998a, 0x1f9a8a, 0x1e9b8a, 0x1e9c89, 0x1e9d89, 0x1f9e89,
    0x1f9f88, 0x1fa088, 0x1fa188, 0x1fa187, 0x1fa287, 0x20a386, 0x20a486, 0x21a585, 0x21a685, 0x22a785, 0x22a884,
    0x23a983, 0x24aa83, 0x25ab82, 0x25ac82, 0x26ad81, 0x27ad81, 0x28ae80, 0x29af7f, 0x2ab07f, 0x2cb17e, 0x2db27d,
    0x2eb37c, 0x2fb47c, 0x31b57b, 0x32b67a, 0x34b679, 0x35b779, 0x37b878, 0x38b977, 0x3aba76, 0x3bbb75, 0x3dbc74,
    0x3fbc73, 0x40bd72, 0x42be71, 0x44bf70, 0x46c06f, 0x48c16e, 0x4ac16d, 0x4cc26c, 0x4ec36b, 0x50c46a, 0x52c569,
    0x54c568, 0x56c667, 0x58c765, 0x5ac864, 0x5cc863, 0x5ec962, 0x60ca60, 0x63cb5f, 0x65cb5e, 0x67cc5c, 0x69cd5b,
    0x6ccd5a, 0x6ece58, 0x70cf57, 0x73d056, 0x75d054, 0x77d153, 0x7ad151, 0x7cd250, 0x7fd34e, 0x81d34d, 0x84d44b,
    0x86d549, 0x89d548, 0x8bd646, 0x8ed645, 0x90d743, 0x93d741, 0x95d840, 0x98d83e, 0x9bd93c, 0x9dd93b, 0xa0da39,
    0xa2da37, 0xa5db36, 0xa8db34, 0xaadc32, 0xaddc30, 0xb0dd2f, 0xb2dd2d, 0xb5de2b, 0xb8de29, 0xbade28, 0xbddf26,
    0xc0df25, 0xc2df23, 0xc5e021, 0xc8e020, 0xcae11f, 0xcde11d, 0xd0e11c, 0xd2e21b, 0xd5e21a, 0xd8e219, 0xdae319,
    0xdde318, 0xdfe318, 0xe2e418, 0xe5e419, 0xe7e419, 0xeae51a, 0xece51b, 0xefe51c, 0xf1e51d, 0xf4e61e, 0xf6e620,
    0xf8e621, 0xfbe723, 0xfde725,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;

    fn grey(level: u8) -> Picture8 {
        Picture8::new(1, 1, [level, level, level, 255])
    }

    fn absolute(reference: u8, actual: u8, scale: f32) -> [u8; 4] {
        difference_map(&grey(reference), &grey(actual), scale)
            .unwrap()
            .get(0, 0)
    }

    fn signed(reference: u8, actual: u8, scale: f32) -> [u8; 4] {
        signed_difference_map(&grey(reference), &grey(actual), scale)
            .unwrap()
            .get(0, 0)
    }

    #[test]
    fn absolute_map_has_its_colours_where_the_scale_says() {
        assert_eq!(absolute(100, 100, 16.0), EQUAL);
        assert_eq!(
            absolute(100, 116, 16.0),
            [0xfd, 0xe7, 0x25, 255],
            "viridis ends in yellow, at the scale itself"
        );
        assert_eq!(
            absolute(116, 100, 16.0),
            [0xfd, 0xe7, 0x25, 255],
            "whatever the sign"
        );
        assert_eq!(absolute(100, 117, 16.0), BEYOND);
        // 8/16 of the way: entry 128 of 0..=255, teal.
        assert_eq!(absolute(100, 108, 16.0), [0x21, 0x91, 0x8c, 255]);
    }

    #[test]
    fn the_smallest_difference_is_not_black() {
        let reference = Picture::new(1, 1, [0.5f32, 0.5, 0.5, 1.0]);
        let actual = Picture::new(1, 1, [0.5f32, 0.5, 0.5 + 6e-8, 1.0]);
        assert_eq!(
            difference_map(&reference, &actual, 255.0)
                .unwrap()
                .get(0, 0),
            [0x44, 0x01, 0x54, 255]
        );
        assert_eq!(
            signed_difference_map(&reference, &actual, 255.0)
                .unwrap()
                .get(0, 0),
            [80, 32, 8, 255]
        );
    }

    #[test]
    fn signed_map_tells_bright_from_dark() {
        assert_eq!(signed(100, 100, 4.0), EQUAL);
        assert_eq!(signed(100, 105, 4.0), BEYOND);
        assert_eq!(signed(105, 100, 4.0), BEYOND_DARKER);
        let (bright, dark) = (signed(100, 103, 4.0), signed(103, 100, 4.0));
        assert!(
            bright[0] > bright[2] && dark[2] > dark[0],
            "{bright:?} is orange, {dark:?} is blue"
        );
    }

    #[test]
    fn signed_map_runs_from_dark_to_light_as_the_scale_says() {
        for ([from, to], sign) in [(BRIGHTER, 1.0), (DARKER, -1.0)] {
            for (share, between) in [(0.25, [3.0, 1.0]), (0.75, [1.0, 3.0]), (1.0, [0.0, 4.0])] {
                let mix = |i: usize| (between[0] * from[i] + between[1] * to[i]) / 4.0;
                let [r, g, b] = [0, 1, 2].map(|i| mix(i).round() as u8);
                assert_eq!(signed_colour(sign * share * 16.0, 16.0), [r, g, b, 255]);
            }
        }
    }

    #[test]
    fn coverage_and_nonsense_are_shown() {
        let covered = Picture::new(1, 1, [0.5f32, 0.5, 0.5, 1.0]);
        let uncovered = Picture::new(1, 1, [0.5f32, 0.5, 0.5, 0.0]);
        let lost = Picture::new(1, 1, [0.5, f32::NAN, 0.5, 1.0]);
        for map in [difference_map, signed_difference_map] {
            assert_eq!(map(&covered, &uncovered, 1.0).unwrap().get(0, 0), COVERAGE);
            assert_eq!(map(&covered, &lost, 255.0).unwrap().get(0, 0), BEYOND);
        }
        for scale in [0.0, -1.0, f32::NAN] {
            assert_eq!(
                [absolute(1, 1, scale), absolute(1, 2, scale)],
                [EQUAL, BEYOND]
            );
            assert_eq!(
                [signed(1, 1, scale), signed(2, 1, scale)],
                [EQUAL, BEYOND_DARKER]
            );
        }
        assert!(difference_map(&covered, &Picture::new(2, 1, [0.0f32; 4]), 1.0).is_err());
    }

    #[test]
    fn no_colour_of_the_scale_is_one_with_another_meaning() {
        for level in 1..=1000 {
            let at = f64::from(level) / 1000.0;
            for colour in [
                absolute_colour(at, 1.0),
                signed_colour(at, 1.0),
                signed_colour(-at, 1.0),
            ] {
                assert!(
                    ![EQUAL, BEYOND, BEYOND_DARKER, COVERAGE].contains(&colour),
                    "{colour:?} at {at}"
                );
            }
        }
    }
}
