//! ꟻLIP: the difference that a viewer sees when two pictures alternate on a screen.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: *FLIP: A Difference Evaluator
//! for Alternating Images*, Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020, in the version for
//! low dynamic range. Names and constants are those of the paper.
//!
//! [`Perceived`] holds a picture as an observer perceives it: its colours, blurred as the eye blurs
//! them, and the strength of edges and points. Two of these yield a map of errors in 0..=1. All
//! filters are Gaussians or derivatives of Gaussians, so they are separable: rows are filtered
//! first, then columns.

use super::SizeMismatch;
use super::rows::Part;
use super::ssim::weigh;
use crate::number::vectorized;
use crate::picture::encoding::srgb_decode;
use crate::picture::{LevelRows, Levels, Picture, Picture8};
use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::PI;
use glam::{DMat3, Mat3, Vec3};

/// The number of pixels per degree of visual angle, on a screen 0.7 m wide with 3840 pixels, seen
/// from 0.7 m.
const PIXELS_PER_DEGREE: f64 = 3840.0 * PI / 180.0;
/// The exponent of the difference in colour.
const QC: f32 = 0.7;
/// The fraction of the largest difference in colour that is mapped to the error [`PT`].
const PC: f32 = 0.4;
/// The error that a difference in colour of [`PC`] times the largest one is mapped to.
const PT: f32 = 0.95;
/// The width of the edge detector of human vision, in degrees.
const W: f64 = 0.082;
/// The width b of the Gaussian for the contrast sensitivity to Y (achromatic).
const CSF_Y: f64 = 0.0047;
/// The width b for Cx (red and green).
const CSF_CX: f64 = 0.0053;
/// The amplitude a and width b of the two Gaussians for Cz (blue and yellow), the wider one first.
const CSF_CZ: [[f64; 2]; 2] = [[34.1, 0.04], [13.5, 0.025]];

/// The matrix from linear sRGB to XYZ relative to the white point D65: white is (1, 1, 1).
#[rustfmt::skip]
const RGB_TO_XYZ: DMat3 = DMat3::from_cols_array(&[
    10_135_552.0 / 23_359_437.0, 2_613_072.0 / 12_288_897.0, 1_425_312.0 / 80_288_307.0,
    8_788_810.0 / 23_359_437.0, 8_788_810.0 / 12_288_897.0, 8_788_810.0 / 80_288_307.0,
    4_435_075.0 / 23_359_437.0, 887_015.0 / 12_288_897.0, 70_074_185.0 / 80_288_307.0,
]);

/// A picture as an observer perceives it, ready to be compared with others.
#[derive(Clone, Debug)]
pub struct Perceived(Picture<Percept>);

/// A pixel of a [`Perceived`] picture.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Percept {
    /// L\*a\*b\* with Hunt's adjustment.
    lab: Vec3,
    edge: f32,
    point: f32,
}

impl Perceived {
    /// Filters a picture. Its levels are sRGB in 0..=255, as a screen shows them. Alpha is ignored.
    pub fn new(picture: &dyn LevelRows) -> Perceived {
        let of_whole: [f32; 256] = core::array::from_fn(|k| srgb_decode(k as f64 / 255.0) as f32);
        let linear = |level: f64| match level as u8 {
            byte if f64::from(byte) == level => of_whole[usize::from(byte)],
            _ if !level.is_finite() => 0.0,
            _ => srgb_decode(level / 255.0) as f32,
        };
        let (to_xyz, to_rgb) = (RGB_TO_XYZ.as_mat3(), RGB_TO_XYZ.inverse().as_mat3());
        let [width, height] = picture.size();
        let mut xyz = Picture::new(width, height, Vec3::ZERO);
        let mut levels = vec![Levels([0.0; 4]); width];
        for y in 0..height {
            picture.level_row(y, &mut levels);
            for (xyz, pixel) in xyz.row_mut(y).iter_mut().zip(&levels) {
                *xyz = to_xyz * Vec3::from(pixel.rgb().map(linear));
            }
        }

        // YCxCz without its scale and offset, which filters whose weights sum to 1 do not change.
        let y = xyz.map(|c| c.y);
        let radius = colour_radius();
        let gaussian = |b| kernel(deviation(b), radius, |_| 1.0);
        let blurred_y = both_ways(&y, &gaussian(CSF_Y));
        let blurred_cx = both_ways(&xyz.map(|c| c.x - c.y), &gaussian(CSF_CX));
        let cz = xyz.map(|c| c.y - c.z);
        let [wide, narrow] = CSF_CZ.map(|[a, b]| {
            let weights = gaussian(b);
            // Before normalisation the middle weight was 1, so 1 over the normalised one is the sum
            // of all weights.
            let sum = 1.0 / f64::from(weights[radius as usize]);
            (a / libm::sqrt(b) * sum * sum, both_ways(&cz, &weights))
        });
        let share = (wide.0 / (wide.0 + narrow.0)) as f32;

        let deviation = FEATURE_DEVIATION;
        let detector = |shape: &dyn Fn(f64) -> f64| kernel(deviation, feature_radius(), shape);
        let smooth = detector(&|_| 1.0);
        let smooth_rows = rows(&y, &smooth);
        let strength = |weights: &[f32]| {
            let across = columns(&rows(&y, weights), &smooth);
            let down = columns(&smooth_rows, weights);
            let pairs = across.pixels().iter().zip(down.pixels());
            let lengths = pairs.map(|(x, y)| libm::sqrtf(x * x + y * y));
            lengths.collect::<Vec<f32>>()
        };
        let edges = strength(&detector(&|x| -x));
        let points = strength(&detector(&|x| x * x / (deviation * deviation) - 1.0));

        // Remember the last colour, so that runs of equal pixels, such as the background, are
        // converted once.
        let mut last = ([f32::NAN; 4], Vec3::ZERO);
        let percept = |i: usize| {
            let planes = [&blurred_y, &blurred_cx, &wide.1, &narrow.1].map(|p| p.pixels()[i]);
            if planes != last.0 {
                let [y, cx, wide, narrow] = planes;
                let cz = share * wide + (1.0 - share) * narrow;
                let rgb = to_rgb * Vec3::new(y + cx, y, y - cz);
                last = (planes, hunt_lab(to_xyz * rgb.clamp(Vec3::ZERO, Vec3::ONE)));
            }
            Percept {
                lab: last.1,
                edge: edges[i],
                point: points[i],
            }
        };
        let percepts = (0..edges.len()).map(percept).collect();
        let picture = Picture::from_pixels(width, height, percepts);
        Perceived(picture.expect("a percept for each pixel"))
    }

    /// Returns the error of each pixel of `actual`, from 0 for no visible difference up to 1.
    ///
    /// # Errors
    /// If the sizes differ.
    pub fn flip(&self, actual: &Perceived) -> Result<Picture<f32>, SizeMismatch> {
        let size = |perceived: &Perceived| [perceived.0.width(), perceived.0.height()];
        SizeMismatch::check(size(self), size(actual))?;
        let to_xyz: Mat3 = RGB_TO_XYZ.as_mat3();
        let [green, blue] = [Vec3::Y, Vec3::Z].map(|rgb| hunt_lab(to_xyz * rgb));
        let most = libm::powf(hyab(green, blue), QC);
        let pairs = self.0.pixels().iter().zip(actual.0.pixels());
        let errors = pairs.map(|(r, a)| error(r, a, most)).collect();
        let map = Picture::from_pixels(self.0.width(), self.0.height(), errors);
        Ok(map.expect("an error for each pixel"))
    }
}

/// How many pixels are filtered at a time. The filters need 100 bytes for each.
const PART: usize = 1 << 20;

/// Returns ꟻLIP: for each pixel, the error that a viewer sees when the pictures alternate, from 0
/// for no visible difference up to 1.
///
/// Levels are sRGB, as a screen shows them, and alpha is ignored. Some rows are filtered at a time,
/// so that large pictures need little memory beside the map.
///
/// ```
/// use fastphong::compare::metrics::{flip_colours, flip_map, mean_flip};
/// use fastphong::picture::Picture8;
///
/// let reference = Picture8::new(32, 32, [120, 120, 120, 255]);
/// let darker = Picture8::new(32, 32, [110, 110, 110, 255]);
/// let map = flip_map(&reference, &darker)?;
/// assert!(mean_flip(&map) > 0.05);
/// let picture = flip_colours(&map); // in the colours of magma
/// # assert_eq!(picture.width(), 32);
/// # Ok::<(), fastphong::compare::metrics::SizeMismatch>(())
/// ```
///
/// # Errors
/// If the sizes differ.
pub fn flip_map(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
) -> Result<Picture<f32>, SizeMismatch> {
    SizeMismatch::check(reference.size(), actual.size())?;
    let [width, height] = reference.size();
    let mut map = Picture::new(width, height, 0.0);
    // The filters read this many rows above and below a pixel, so parts overlap by that.
    let reach = colour_radius().max(feature_radius()) as usize;
    let step = (PART / width.max(1)).max(reach);
    for first in (0..height).step_by(step) {
        let rows = first..height.min(first + step);
        let above = first.saturating_sub(reach);
        let part = |picture| Part {
            picture,
            first: above,
            height: height.min(rows.end + reach) - above,
        };
        let part = Perceived::new(&part(reference)).flip(&Perceived::new(&part(actual)))?;
        for y in rows {
            map.row_mut(y).copy_from_slice(part.row(y - above));
        }
    }
    Ok(map)
}

/// Returns the radius of the colour filters in pixels.
fn colour_radius() -> i32 {
    libm::ceil(3.0 * deviation(CSF_CZ[0][1])) as i32
}

/// The standard deviation of the detectors of edges and points, in pixels.
const FEATURE_DEVIATION: f64 = 0.5 * W * PIXELS_PER_DEGREE;

/// Returns the radius of the detectors in pixels.
fn feature_radius() -> i32 {
    libm::ceil(3.0 * FEATURE_DEVIATION) as i32
}

/// Returns the mean of a map of [`flip_map`], or 0 if it is empty.
pub fn mean_flip(map: &Picture<f32>) -> f64 {
    let sum: f64 = map.pixels().iter().copied().map(f64::from).sum();
    sum / map.pixels().len().max(1) as f64
}

/// Draws a map of [`flip_map`] in the colours of magma, as the authors' tool does: black for 0,
/// light yellow for 1.
pub fn flip_colours(map: &Picture<f32>) -> Picture8 {
    map.map(|error| {
        let [_, r, g, b] = MAGMA[usize::from((255.0 * error + 0.5) as u8)].to_be_bytes();
        [r, g, b, 255]
    })
}

/// Returns the standard deviation, in pixels, of a contrast sensitivity of width `b`: exp(−π²
/// x²/b), x in degrees.
fn deviation(b: f64) -> f64 {
    libm::sqrt(b / 2.0) / PI * PIXELS_PER_DEGREE
}

/// Returns the weights of a Gaussian times `shape`, scaled so that the positive ones sum to 1 and
/// the negative ones to −1.
fn kernel(deviation: f64, radius: i32, shape: impl Fn(f64) -> f64) -> Vec<f32> {
    let weight = |x: i32| {
        let (x, t) = (f64::from(x), f64::from(x) / deviation);
        shape(x) * libm::exp(-0.5 * t * t)
    };
    let weights: Vec<f64> = (-radius..=radius).map(weight).collect();
    let sum_of = |sign: f64| -> f64 { weights.iter().map(|w| (sign * w).max(0.0)).sum() };
    let (positive, negative) = (sum_of(1.0), sum_of(-1.0));
    let normalised = |w: &f64| (w / if *w > 0.0 { positive } else { negative }) as f32;
    weights.iter().map(normalised).collect()
}

/// Filters rows. Beyond the picture, its outermost pixels are repeated.
fn rows(plane: &Picture<f32>, weights: &[f32]) -> Picture<f32> {
    let (width, radius) = (plane.width(), weights.len() / 2);
    let mut filtered = plane.clone();
    let mut padded = vec![0.0; width + 2 * radius];
    vectorized(
        #[inline(always)]
        || {
            for y in 0..plane.height() {
                if let [first, .., last] | [first @ last] = plane.row(y) {
                    padded[..radius].fill(*first);
                    padded[radius..][..width].copy_from_slice(plane.row(y));
                    padded[radius + width..].fill(*last);
                }
                weigh(
                    weights,
                    #[inline(always)]
                    |k| &padded[k..],
                    filtered.row_mut(y),
                );
            }
        },
    );
    filtered
}

/// Filters columns. Beyond the picture, its outermost pixels are repeated.
fn columns(plane: &Picture<f32>, weights: &[f32]) -> Picture<f32> {
    let (last, radius) = (plane.height().saturating_sub(1), weights.len() / 2);
    let mut filtered = plane.clone();
    vectorized(
        #[inline(always)]
        || {
            for y in 0..plane.height() {
                weigh(
                    weights,
                    #[inline(always)]
                    |k| plane.row((y + k).saturating_sub(radius).min(last)),
                    filtered.row_mut(y),
                );
            }
        },
    );
    filtered
}

/// Filters rows, then columns.
fn both_ways(plane: &Picture<f32>, weights: &[f32]) -> Picture<f32> {
    columns(&rows(plane, weights), weights)
}

/// Returns the L\*a\*b\* of a colour in XYZ, with Hunt's adjustment: a\* and b\* are smaller in the
/// dark.
fn hunt_lab(xyz: Vec3) -> Vec3 {
    const DELTA: f32 = 6.0 / 29.0;
    let [x, y, z] = xyz.to_array().map(|t| {
        if t > DELTA * DELTA * DELTA {
            libm::cbrtf(t)
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * y - 16.0;
    let [a, b] = [500.0 * (x - y), 200.0 * (y - z)].map(|c| 0.01 * lightness * c);
    Vec3::new(lightness, a, b)
}

/// Returns the HyAB distance of two colours: the distance in lightness plus the distance in chroma.
fn hyab(p: Vec3, q: Vec3) -> f32 {
    let d = p - q;
    d.x.abs() + libm::sqrtf(d.y * d.y + d.z * d.z)
}

/// Returns the error between two pixels. `most` is the largest difference in colour, raised to
/// [`QC`].
fn error(r: &Percept, a: &Percept, most: f32) -> f32 {
    if r == a {
        return 0.0;
    }
    // The result is colour^(1 − feature). Working with logarithms needs fewer of them than two
    // powers would. A colour difference of 0 has the logarithm −∞, which ends as 0.
    let power = QC * libm::log2f(hyab(r.lab, a.lab));
    let limit = PC * most;
    let colour = if power < libm::log2f(limit) {
        power + libm::log2f(PT / limit)
    } else {
        libm::log2f(PT + (libm::exp2f(power) - limit) / (most - limit) * (1.0 - PT))
    };
    let feature = (r.edge - a.edge).abs().max((r.point - a.point).abs());
    let feature = libm::sqrtf(feature / core::f32::consts::SQRT_2);
    libm::exp2f((1.0 - feature) * colour)
}

/// The colour map magma, 0xRRGGBB. Equal steps look equal, from black to light yellow.
///
/// By Nathaniel J. Smith and Stéfan van der Walt, dedicated to the public domain (CC0).
#[rustfmt::skip]
static MAGMA: [u32; 256] = [
    0x000004, 0x010005, 0x010106, 0x010108, 0x020109, 0x02020b, 0x02020d, 0x03030f, 0x030312, 0x040414, 0x050416,
    0x060518, 0x06051a, 0x07061c, 0x08071e, 0x090720, 0x0a0822, 0x0b0924, 0x0c0926, 0x0d0a29, 0x0e0b2b, 0x100b2d,
    0x110c2f, 0x120d31, 0x130d34, 0x140e36, 0x150e38, 0x160f3b, 0x180f3d, 0x19103f, 0x1a1042, 0x1c1044, 0x1d1147,
    0x1e1149, 0x20114b, 0x21114e, 0x221150, 0x241253, 0x251255, 0x271258, 0x29115a, 0x2a115c, 0x2c115f, 0x2d1161,
    0x2f1163, 0x311165, 0x331067, 0x341069, 0x36106b, 0x38106c, 0x390f6e, 0x3b0f70, 0x3d0f71, 0x3f0f72, 0x400f74,
    0x420f75, 0x440f76, 0x451077, 0x471078, 0x491078, 0x4a1079, 0x4c117a, 0x4e117b, 0x4f127b, 0x51127c, 0x52137c,
    0x54137d, 0x56147d, 0x57157e, 0x59157e, 0x5a167e, 0x5c167f, 0x5d177f, 0x5f187f, 0x601880, 0x621980, 0x641a80,
    0x651a80, 0x671b80, 0x681c81, 0x6a1c81, 0x6b1d81, 0x6d1d81, 0x6e1e81, 0x701f81, 0x721f81, 0x732081, 0x752181,
    0x762181, 0x782281, 0x792282, 0x7b2382, 0x7c2382, 0x7e2482, 0x802582, 0x812581, 0x832681, 0x842681, 0x862781,
    0x882781, 0x892881, 0x8b2981, 0x8c2981, 0x8e2a81, 0x902a81, 0x912b81, 0x932b80, 0x942c80, 0x962c80, 0x982d80,
    0x992d80, 0x9b2e7f, 0x9c2e7f, 0x9e2f7f, 0xa02f7f, 0xa1307e, 0xa3307e, 0xa5317e, 0xa6317d, 0xa8327d, 0xaa337d,
    0xab337c, 0xad347c, 0xae347b, 0xb0357b, 0xb2357b, 0xb3367a, 0xb5367a, 0xb73779, 0xb83779, 0xba3878, 0xbc3978,
    0xbd3977, 0xbf3a77, 0xc03a76, 0xc23b75, 0xc43c75, 0xc53c74, 0xc73d73, 0xc83e73, 0xca3e72, 0xcc3f71, 0xcd4071,
    0xcf4070, 0xd0416f, 0xd2426f, 0xd3436e, 0xd5446d, 0xd6456c, 0xd8456c, 0xd9466b, 0xdb476a, 0xdc4869, 0xde4968,
    0xdf4a68, 0xe04c67, 0xe24d66, 0xe34e65, 0xe44f64, 0xe55064, 0xe75263, 0xe85362, 0xe95462, 0xea5661, 0xeb5760,
    0xec5860, 0xed5a5f, 0xee5b5e, 0xef5d5e, 0xf05f5e, 0xf1605d, 0xf2625d, 0xf2645c, 0xf3655c, 0xf4675c, 0xf4695c,
    0xf56b5c, 0xf66c5c, 0xf66e5c, 0xf7705c, 0xf7725c, 0xf8745c, 0xf8765c, 0xf9785d, 0xf9795d, 0xf97b5d, 0xfa7d5e,
    0xfa7f5e, 0xfa815f, 0xfb835f, 0xfb8560, 0xfb8761, 0xfc8961, 0xfc8a62, 0xfc8c63, 0xfc8e64, 0xfc9065, 0xfd9266,
    0xfd9467, 0xfd9668, 0xfd9869, 0xfd9a6a, 0xfd9b6b, 0xfe9d6c, 0xfe9f6d, 0xfea16e, 0xfea36f, 0xfea571, 0xfea772,
    0xfea973, 0xfeaa74, 0xfeac76, 0xfeae77, 0xfeb078, 0xfeb27a, 0xfeb47b, 0xfeb67c, 0xfeb77e, 0xfeb97f, 0xfebb81,
    0xfebd82, 0xfebf84, 0xfec185, 0xfec287, 0xfec488, 0xfec68a, 0xfec88c, 0xfeca8d, 0xfecc8f, 0xfecd90, 0xfecf92,
    0xfed194, 0xfed395, 0xfed597, 0xfed799, 0xfed89a, 0xfdda9c, 0xfddc9e, 0xfddea0, 0xfde0a1, 0xfde2a3, 0xfde3a5,
    0xfde5a7, 0xfde7a9, 0xfde9aa, 0xfdebac, 0xfcecae, 0xfceeb0, 0xfcf0b2, 0xfcf2b4, 0xfcf4b6, 0xfcf6b8, 0xfcf7b9,
    0xfcf9bb, 0xfcfbbd, 0xfcfdbf,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The expected values are from the authors' implementation, `flip_evaluator` 1.7 of the Python
    /// package index: `flip_evaluator.evaluate(reference, actual, "LDR", applyMagma=False)` of
    /// pictures of levels / 255.
    ///
    /// Both compute in f32. The square root of the difference in features turns an error of 1e-8
    /// into one of 1e-4.
    const TOLERANCE: f32 = 1e-4;

    fn flip(reference: &Picture8, actual: &Picture8) -> Picture<f32> {
        let map = Perceived::new(reference).flip(&Perceived::new(actual));
        map.expect("one size")
    }

    fn flat(size: usize, [r, g, b]: [u8; 3]) -> Picture8 {
        Picture8::new(size, size, [r, g, b, 255])
    }

    fn near(got: f32, expected: f32) {
        assert!((got - expected).abs() <= TOLERANCE, "{got}, not {expected}");
    }

    #[test]
    fn plain_colours_have_the_published_errors() {
        for (reference, actual, expected) in [
            ([0, 255, 0], [0, 0, 255], 1.0),
            ([0; 3], [255; 3], 0.967_388_33),
            ([255, 0, 0], [0, 255, 255], 0.979_910_6),
            ([255, 0, 0], [0, 255, 0], 0.986_664_95),
            ([120; 3], [110; 3], 0.151_774_5),
            ([128; 3], [128, 128, 136], 0.115_843),
            ([10; 3], [10, 10, 11], 0.005_136_544),
        ] {
            for size in [1, 24] {
                let map = flip(&flat(size, reference), &flat(size, actual));
                map.pixels().iter().for_each(|error| near(*error, expected));
            }
        }
    }

    #[test]
    fn dots_and_edges_have_the_published_errors() {
        let black = flat(21, [0; 3]);
        let (mut dot, mut edge) = (black.clone(), black.clone());
        dot.row_mut(10)[10] = [255; 4];
        (0..21).for_each(|y| edge.row_mut(y)[11..].fill([255; 4]));
        let map = flip(&black, &dot);
        for (x, y, expected) in [
            (10, 10, 0.864_906_5),
            (11, 10, 0.763_490_7),
            (9, 9, 0.665_324_45),
            (0, 0, 0.0),
        ] {
            near(map.get(x, y), expected);
        }
        near(mean_flip(&map) as f32, 0.032_447_35);
        let map = flip(&black, &edge);
        near(map.get(10, 10), 0.992_380_74);
        near(map.get(11, 10), 0.993_943_63);
        near(mean_flip(&map) as f32, 0.596_171_1);
    }

    #[test]
    fn equal_pictures_have_no_error_and_order_plays_no_part() {
        let mut picture = flat(12, [90, 60, 30]);
        picture.row_mut(3)[4..8].fill([200, 10, 60, 0]);
        assert_eq!(mean_flip(&flip(&picture, &picture)), 0.0);
        let other = flat(12, [80, 70, 30]);
        assert_eq!(flip(&picture, &other), flip(&other, &picture));
        let opaque = picture.map(|[r, g, b, _]| [r, g, b, 255]);
        assert_eq!(mean_flip(&flip(&picture, &opaque)), 0.0);
    }

    #[test]
    fn any_size_has_a_map_and_sizes_must_agree() {
        for (width, height) in [(0, 0), (0, 3), (3, 0), (1, 40), (40, 1)] {
            let [one, two] = [0, 255].map(|c| Picture8::new(width, height, [c; 4]));
            let mean = mean_flip(&flip(&one, &two));
            assert_eq!(mean > 0.9, width * height > 0, "{width}×{height}: {mean}");
        }
        let [one, two] = [1, 2].map(|size| Perceived::new(&flat(size, [0; 3])));
        assert!(one.flip(&two).is_err());
    }

    #[test]
    fn colours_go_from_black_to_yellow() {
        let map = Picture::from_pixels(3, 1, [0.0, 0.5, 1.0].into()).expect("three");
        let colours = [[0, 0, 4, 255], [183, 55, 121, 255], [252, 253, 191, 255]];
        assert_eq!(flip_colours(&map).pixels(), colours);
    }
}
