//! Lossless packing of pictures, which the page unpacks.
//!
//! A picture is stored as its difference, modulo 256, from the picture that is most like it. So
//! methods that draw the same picture cost a few bytes. Planes are green, red − green and blue −
//! green. Of each byte the previous one is subtracted, then all are deflated, which browsers can
//! undo without a library. `docs/performance.md` compares this with lossless WebP and with the
//! filters of PNG.

use super::live::packed;
use crate::compare::comparison::Comparison;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use fastphong::picture::Picture8;
use fastphong::picture::encoding::store;
use fastphong::picture::image_file::{FilePicture, Format};
use rayon::prelude::*;
use serde::Serialize;

/// The packed pictures of one scene.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Pictures {
    /// The packed reference.
    reference: String,
    /// A picture per variant.
    rows: BTreeMap<String, PackedPicture>,
}

/// A picture as a difference from another one.
#[derive(Clone, Debug, Default, Serialize)]
struct PackedPicture {
    /// The variant whose picture is the base, or `None` for the reference.
    #[serde(skip_serializing_if = "Option::is_none")]
    on: Option<String>,
    /// The packed difference from the base, or `None` if the pictures are equal.
    #[serde(skip_serializing_if = "Option::is_none")]
    add: Option<String>,
}

impl Pictures {
    /// Packs the reference and each scanline picture.
    pub fn new(comparison: &Comparison) -> Pictures {
        let reference = planes(&store(&comparison.reference, comparison.encoding));
        let rows = &comparison.rows;
        let drawn: Vec<_> = rows.par_iter().map(|row| planes(&row.picture)).collect();
        let packed = |at: usize| {
            let near = nearest(&drawn[at], &reference, &drawn[..at]);
            let base = near.map_or(&reference, |i| &drawn[i]);
            let add = (base != &drawn[at]).then(|| pack(&added(base, &drawn[at])));
            let on = near.map(|i| rows[i].name());
            (rows[at].name(), PackedPicture { on, add })
        };
        Pictures {
            reference: pack(&reference),
            rows: (0..rows.len()).into_par_iter().map(packed).collect(),
        }
    }

    /// Writes them as JSON for the page.
    pub fn json(&self) -> String {
        serde_json::to_string(self).expect("texts and lists of them")
    }
}

/// Returns the index of the picture that is most like `picture`, or `None` if `base` is.
fn nearest(picture: &[Vec<u8>], base: &[Vec<u8>], others: &[Vec<Vec<u8>>]) -> Option<usize> {
    let differing = |other: &[Vec<u8>]| {
        let pairs = picture.iter().zip(other);
        pairs
            .map(|(a, b)| a.iter().zip(b).filter(|(a, b)| a != b).count())
            .sum::<usize>()
    };
    let mut best = (differing(base), None);
    for (index, other) in others.iter().enumerate() {
        let count = differing(other);
        if count < best.0 {
            best = (count, Some(index));
        }
    }
    best.1
}

/// Returns `picture` minus `base`, modulo 256.
fn added(base: &[Vec<u8>], picture: &[Vec<u8>]) -> Vec<Vec<u8>> {
    let plane = |(a, b): (&Vec<u8>, &Vec<u8>)| {
        let pairs = a.iter().zip(b);
        pairs.map(|(a, b)| b.wrapping_sub(*a)).collect()
    };
    base.iter().zip(picture).map(plane).collect()
}

/// Splits a picture into green, red − green and blue − green. It drops coverage.
fn planes(picture: &Picture8) -> Vec<Vec<u8>> {
    let plane = |of: fn(&[u8; 4]) -> u8| picture.pixels().iter().map(of).collect();
    Vec::from([
        plane(|[_, g, _, _]| *g),
        plane(|[r, g, _, _]| r.wrapping_sub(*g)),
        plane(|[_, g, b, _]| b.wrapping_sub(*g)),
    ])
}

/// Subtracts from each byte of a plane the previous one, modulo 256, deflates the result, and
/// writes it in base 64.
fn pack(planes: &[Vec<u8>]) -> String {
    let mut steps = Vec::new();
    for plane in planes {
        let mut before = 0;
        for &value in plane {
            steps.push(value.wrapping_sub(before));
            before = value;
        }
    }
    packed(&steps)
}

/// Encodes a picture as an opaque PNG file.
///
/// # Errors
/// If the picture has no pixels, or more than the format can count.
pub(super) fn png(picture: &Picture8) -> std::io::Result<Vec<u8>> {
    FilePicture::stored(picture.map(|[r, g, b, _]| [r, g, b, 255])).encode(Format::Png)
}

/// Returns a PNG file as the address of an `<img>`.
pub(super) fn data_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// Halves the sides of a picture. Every pixel is the mean of a square of four, or of fewer at the
/// right and lower edge.
pub(super) fn halved(picture: &Picture8) -> Picture8 {
    let (width, height) = (picture.width().div_ceil(2), picture.height().div_ceil(2));
    let mut small = Picture8::new(width, height, [0; 4]);
    for y in 0..height {
        for (x, out) in small.row_mut(y).iter_mut().enumerate() {
            let rows = 2 * y..picture.height().min(2 * y + 2);
            let columns = 2 * x..picture.width().min(2 * x + 2);
            let count = (rows.len() * columns.len()) as u32;
            let square = rows.flat_map(|row| &picture.row(row)[columns.clone()]);
            let sum = square.fold([0u32; 4], |sum, [r, g, b, _]| {
                let [sr, sg, sb, _] = sum;
                let [r, g, b] = [*r, *g, *b].map(u32::from);
                [sr + r, sg + g, sb + b, 255 * count]
            });
            *out = sum.map(|sum| ((sum + count / 2) / count) as u8);
        }
    }
    small
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::ZlibDecoder;
    use std::io::Read;

    /// Undoes [`pack`], as the page does.
    fn unpacked(text: &str, planes: usize) -> Vec<Vec<u8>> {
        let packed = STANDARD.decode(text).unwrap();
        let mut bytes = Vec::new();
        ZlibDecoder::new(&packed[..])
            .read_to_end(&mut bytes)
            .unwrap();
        let sums = |plane: &[u8]| {
            let sum = |sum: &mut u8, step: &u8| {
                *sum = sum.wrapping_add(*step);
                Some(*sum)
            };
            plane.iter().scan(0, sum).collect()
        };
        bytes.chunks(bytes.len() / planes).map(sums).collect()
    }

    #[test]
    fn planes_come_back() {
        // Knuth's multiplier scatters one plane. The others are a ramp and a constant.
        let scattered: Vec<u8> = (0..1200u32)
            .map(|i| (i.wrapping_mul(2_654_435_769) >> 24) as u8)
            .collect();
        let ramp: Vec<u8> = (0..1200u32).map(|i| (i % 40 + i / 40) as u8).collect();
        let all = Vec::from([scattered, ramp, alloc::vec![9; 1200]]);
        assert_eq!(unpacked(&pack(&all), 3), all);
        assert!(pack(&all[1..]).len() < 400);
    }

    #[test]
    fn what_is_added_to_the_nearest_is_the_picture() {
        let base = Vec::from([Vec::from([1, 2, 250])]);
        let picture = Vec::from([Vec::from([1, 3, 4])]);
        assert_eq!(added(&base, &picture), [[0, 1, 10]]);
        let others = [Vec::from([Vec::from([1, 3, 9])]), picture.clone()];
        assert_eq!(nearest(&picture, &base, &others), Some(1));
        assert_eq!(nearest(&base, &base, &others), None);
    }

    #[test]
    fn halving_takes_means() {
        let pixels = [[0, 10, 100, 255], [2, 10, 101, 255], [8, 11, 12, 9]];
        let picture = Picture8::from_pixels(3, 1, pixels.into()).unwrap();
        let small = [[1, 10, 101, 255], [8, 11, 12, 255]];
        assert_eq!(
            halved(&picture),
            Picture8::from_pixels(2, 1, small.into()).unwrap()
        );
    }

    #[test]
    fn addresses_hold_the_file() {
        assert_eq!(data_uri(&[0xFB, 0xFF, 0x00]), "data:image/png;base64,+/8A");
    }
}
