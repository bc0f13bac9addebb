//! PPM and PFM: a short header in text, then the samples.

use std::format;
use std::str;
use std::vec::Vec;

use super::{DecodeError, EncodeError, Format, checked_size};
use crate::picture::{LinearPicture, Picture, Picture8};

/// Longest side that is written; readers are not bound to accept more.
const MAX_SIDE: usize = (1 << 31) - 1;

/// The bytes of a binary PPM file (P6, 255 levels): red, green, blue as they are stored; alpha is dropped.
///
/// # Errors
/// If the picture has no pixels, or a side longer than 2³¹ − 1.
pub fn encode_ppm(picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    let [width, height] = size(picture)?;
    let mut bytes = format!("P6\n{width} {height}\n255\n").into_bytes();
    bytes.reserve_exact(3 * picture.texels().len());
    bytes.extend(picture.texels().iter().flat_map(|&[r, g, b, _]| [r, g, b]));
    Ok(bytes)
}

/// The bytes of a PFM file: red, green, blue as little-endian floats, the bottom row first; alpha is dropped.
///
/// # Errors
/// If the picture has no pixels, or a side longer than 2³¹ − 1.
pub fn encode_pfm(picture: &LinearPicture) -> Result<Vec<u8>, EncodeError> {
    let [width, height] = size(picture)?;
    // The sign of the scale tells the order of bytes: negative is little-endian.
    let mut bytes = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    bytes.reserve_exact(12 * picture.texels().len());
    for y in (0..height).rev() {
        for &[r, g, b, _] in picture.row(y) {
            bytes.extend([r, g, b].iter().flat_map(|sample| sample.to_le_bytes()));
        }
    }
    Ok(bytes)
}

fn size<T: Copy>(picture: &Picture<T>) -> Result<[usize; 2], EncodeError> {
    let (width, height) = (picture.width(), picture.height());
    let fits = |side| (1..=MAX_SIDE).contains(&side);
    if fits(width) && fits(height) { Ok([width, height]) } else { Err(EncodeError { width, height }) }
}

/// The picture in a binary PPM file (P6); samples of another range than 255 are scaled to it and rounded.
pub(super) fn decode_ppm(bytes: &[u8]) -> Result<Picture8, DecodeError> {
    let mut header = Header { format: Format::Ppm, rest: &bytes[2..] };
    let [width, height] = header.size()?;
    let range: u32 = header.number("the largest sample")?;
    if !(1..=65_535).contains(&range) {
        return Err(header.broken(&format!("the largest sample is {range}: expected 1 to 65535")));
    }
    let sample_bytes = if range < 256 { 1 } else { 2 };
    let samples = header.samples(width * height * 3 * sample_bytes)?;
    let level = |sample: &[u8]| {
        let value = sample.iter().fold(0, |value, &byte| value << 8 | u32::from(byte));
        if value > range {
            return Err(header.broken(&format!("a sample is {value}: expected at most {range}, as its header says")));
        }
        Ok(((510 * value + range) / (2 * range)) as u8)
    };
    let mut picture = Picture8::new(width, height, [255; 4]);
    for (texel, samples) in picture.texels_mut().iter_mut().zip(samples.chunks_exact(3 * sample_bytes)) {
        for (channel, sample) in texel.iter_mut().zip(samples.chunks_exact(sample_bytes)) {
            *channel = level(sample)?;
        }
    }
    Ok(picture)
}

/// The picture in a PFM file, colour (PF) or grey (Pf), of either order of bytes.
///
/// The size of the scale is a unit that nobody agrees on, and is passed over.
pub(super) fn decode_pfm(bytes: &[u8]) -> Result<LinearPicture, DecodeError> {
    let channels = if bytes[1] == b'F' { 3 } else { 1 };
    let mut header = Header { format: Format::Pfm, rest: &bytes[2..] };
    let [width, height] = header.size()?;
    let scale: f32 = header.number("the scale")?;
    if scale == 0.0 || !scale.is_finite() {
        return Err(header.broken("the scale tells no order of bytes: expected a negative or a positive number"));
    }
    let from_bytes = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let samples = header.samples(width * height * channels * 4)?;
    let (samples, _) = samples.as_chunks::<4>();
    let mut picture = LinearPicture::new(width, height, [1.0; 4]);
    for (row, samples) in samples.chunks_exact(width * channels).rev().enumerate() {
        for (texel, samples) in picture.row_mut(row).iter_mut().zip(samples.chunks_exact(channels)) {
            for (i, channel) in texel[..3].iter_mut().enumerate() {
                *channel = from_bytes(samples[i % channels]);
            }
        }
    }
    Ok(picture)
}

/// The rest of a header: words apart by white space, with comments from `#` to the end of a line.
struct Header<'a> {
    format: Format,
    rest: &'a [u8],
}

impl<'a> Header<'a> {
    fn size(&mut self) -> Result<[usize; 2], DecodeError> {
        let width = self.number("the width")?;
        let height = self.number("the height")?;
        checked_size(self.format, width, height)
    }

    fn number<N: str::FromStr>(&mut self, what: &str) -> Result<N, DecodeError> {
        let word = self.word();
        let number = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        number.ok_or_else(|| {
            // Only the start of it: what is not a header can be a word of any length.
            let found = word[..word.len().min(20)].escape_ascii();
            self.broken(&format!("{what} is \"{found}\": expected a number"))
        })
    }

    fn word(&mut self) -> &'a [u8] {
        loop {
            self.rest = self.rest.trim_ascii_start();
            if self.rest.first() != Some(&b'#') {
                break;
            }
            let end = self.rest.iter().position(|&byte| byte == b'\n').unwrap_or(self.rest.len());
            self.rest = &self.rest[end..];
        }
        let end = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    /// All that follows the single white space after the header, which must be `expected` bytes.
    fn samples(&self, expected: usize) -> Result<&'a [u8], DecodeError> {
        let samples = self.rest.get(1..).unwrap_or_default();
        match samples.len() {
            found if found == expected => Ok(samples),
            found => {
                let problem = if found < expected { "it ends too early" } else { "it goes on after its last pixel" };
                Err(self.broken(&format!("{problem}: expected {expected} bytes of samples, found {found}")))
            }
        }
    }

    fn broken(&self, problem: &str) -> DecodeError {
        DecodeError::malformed(self.format, problem)
    }
}
