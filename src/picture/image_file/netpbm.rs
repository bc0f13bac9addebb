//! PPM and PFM: a short header in text, then the samples.

use std::cmp::Ordering;
use std::io::{self, Write};
use std::string::String;
use std::vec::Vec;
use std::{format, str};

use super::{DecodeError, EncodeError, Format, checked_size};
use crate::picture::{LinearPicture, Picture8};

/// Pixels that are converted at a time.
const RUN: usize = 1 << 10;

/// Bytes that are written at a time: enough for the cost of a call not to show, few enough to stay in a cache, and whole
/// pages of the file.
const PIECE: usize = 1 << 17;

/// Writes a binary PPM file (P6, 255 levels): red, green, blue as they are stored; alpha is dropped.
pub(super) fn write_ppm(picture: &Picture8, out: impl Write) -> io::Result<()> {
    let (width, height) = (picture.width(), picture.height());
    let mut file = PpmWriter::new(out, width, height).map_err(io::Error::other)?;
    file.pixels(picture.pixels())?;
    file.finish()
}

/// Writes a binary PPM file from the top, of a picture that need not be in memory as a whole.
#[derive(Debug)]
pub struct PpmWriter<W> {
    pieces: Pieces<W>,
    /// Pixels that are still to come.
    missing: usize,
}

impl<W: Write> PpmWriter<W> {
    /// Begins a file of `width` × `height` pixels into `out`, which needs no buffer.
    ///
    /// # Errors
    /// If there are no pixels, or a side is longer than 2³¹ − 1.
    pub fn new(out: W, width: usize, height: usize) -> Result<Self, EncodeError> {
        Ok(PpmWriter {
            pieces: Pieces::new(out, "P6", [width, height], "255")?,
            missing: width * height,
        })
    }

    /// Writes the next pixels, row by row; alpha is dropped.
    ///
    /// # Errors
    /// If they cannot be written, or are more than the file has pixels.
    pub fn pixels(&mut self, pixels: &[[u8; 4]]) -> io::Result<()> {
        let Some(missing) = self.missing.checked_sub(pixels.len()) else {
            let (missing, found) = (self.missing, pixels.len());
            let problem = format!("expected at most {missing} more pixels, found {found}");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
        };
        self.missing = missing;
        let mut bytes = [0; 3 * RUN];
        for pixels in pixels.chunks(RUN) {
            let bytes = &mut bytes[..3 * pixels.len()];
            without_alpha(pixels, bytes);
            self.pieces.write(bytes)?;
        }
        Ok(())
    }

    /// Writes what is left.
    ///
    /// # Errors
    /// If it cannot be written, or pixels are missing.
    pub fn finish(self) -> io::Result<()> {
        match self.missing {
            0 => self.pieces.finish(),
            n => Err(io::Error::new(
                io::ErrorKind::UnexpectedEof,
                format!("{n} pixels of the picture are missing"),
            )),
        }
    }
}

/// Writes a PFM file: red, green, blue as little-endian floats, the bottom row first; alpha is dropped.
pub(super) fn write_pfm(picture: &LinearPicture, out: impl Write) -> io::Result<()> {
    let (width, height) = (picture.width(), picture.height());
    // The sign of the scale tells the order of bytes: negative is little-endian.
    let pieces = Pieces::new(out, "PF", [width, height], "-1.0");
    let mut pieces = pieces.map_err(io::Error::other)?;
    let mut bytes = [[[0; 4]; 3]; RUN];
    for y in (0..height).rev() {
        for pixels in picture.row(y).chunks(RUN) {
            for (bytes, &[r, g, b, _]) in bytes.iter_mut().zip(pixels) {
                *bytes = [r, g, b].map(f32::to_le_bytes);
            }
            let samples = bytes[..pixels.len()].as_flattened().as_flattened();
            pieces.write(samples)?;
        }
    }
    pieces.finish()
}

/// The bytes of a file on their way out.
#[derive(Debug)]
struct Pieces<W> {
    out: W,
    bytes: Vec<u8>,
}

impl<W: Write> Pieces<W> {
    /// Begins with a header: the format's first word, the size and the range of the samples.
    fn new(out: W, word: &str, size: [usize; 2], range: &str) -> Result<Self, EncodeError> {
        let [width, height] = size;
        EncodeError::check(width, height)?;
        let bytes = format!("{word}\n{width} {height}\n{range}\n").into();
        Ok(Pieces { out, bytes })
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.bytes.extend_from_slice(bytes);
        if self.bytes.len() >= PIECE {
            self.out.write_all(&self.bytes[..PIECE])?;
            self.bytes.drain(..PIECE);
        }
        Ok(())
    }

    fn finish(mut self) -> io::Result<()> {
        self.out.write_all(&self.bytes)
    }
}

/// Writes the colours of `pixels`, three bytes each, into `bytes`.
fn without_alpha(pixels: &[[u8; 4]], bytes: &mut [u8]) {
    // Four pixels fill three words.
    let (fours, last_pixels) = pixels.as_chunks::<4>();
    let (words, last_bytes) = bytes.split_at_mut(12 * fours.len());
    let words = words.as_chunks_mut::<4>().0.as_chunks_mut::<3>().0;
    for (words, &four) in words.iter_mut().zip(fours) {
        let [a, b, c, d] = four.map(|[r, g, b, _]| u32::from_le_bytes([r, g, b, 0]));
        *words = [a | b << 24, b >> 8 | c << 16, c >> 16 | d << 8].map(u32::to_le_bytes);
    }
    for (bytes, pixel) in last_bytes.chunks_exact_mut(3).zip(last_pixels) {
        bytes.copy_from_slice(&pixel[..3]);
    }
}

/// Reads the picture in a binary PPM file (P6); samples of another range than 255 are scaled to it and rounded.
pub(super) fn decode_ppm(bytes: &[u8]) -> Result<Picture8, DecodeError> {
    let mut header = Header {
        format: Format::Ppm,
        rest: &bytes[2..],
    };
    let [width, height] = header.size()?;
    let range: u32 = header.number("the largest sample")?;
    if !(1..=65_535).contains(&range) {
        let problem = format!("the largest sample is {range}: expected 1 to 65535");
        return Err(header.broken(problem));
    }
    let sample_bytes = if range < 256 { 1 } else { 2 };
    let samples = header.samples(width * height * 3 * sample_bytes)?;
    let mut samples = samples.chunks_exact(sample_bytes).map(|sample| {
        let value = |value, &byte| value << 8 | u32::from(byte);
        sample.iter().fold(0, value)
    });
    if let Some(value) = samples.clone().find(|value| *value > range) {
        return Err(header.broken(format!(
            "a sample is {value}: expected at most {range}, as its header says"
        )));
    }
    let level = |value: u32| ((510 * value + range) / (2 * range)) as u8;
    let mut picture = Picture8::new(width, height, [255; 4]);
    for pixel in picture.pixels_mut() {
        for (channel, value) in pixel[..3].iter_mut().zip(&mut samples) {
            *channel = level(value);
        }
    }
    Ok(picture)
}

/// Reads the picture in a PFM file, colour (PF) or grey (Pf), of either order of bytes.
///
/// The size of the scale is a unit that nobody agrees on, and is passed over.
pub(super) fn decode_pfm(bytes: &[u8]) -> Result<LinearPicture, DecodeError> {
    let channels = if bytes[1] == b'F' { 3 } else { 1 };
    let mut header = Header {
        format: Format::Pfm,
        rest: &bytes[2..],
    };
    let [width, height] = header.size()?;
    let scale: f32 = header.number("the scale")?;
    if scale == 0.0 || !scale.is_finite() {
        let problem = "the scale tells no order of bytes: expected a negative or a positive number";
        return Err(header.broken(problem));
    }
    let from_bytes = match scale < 0.0 {
        true => f32::from_le_bytes,
        false => f32::from_be_bytes,
    };
    let samples = header.samples(width * height * channels * 4)?;
    let (samples, _) = samples.as_chunks::<4>();
    let mut picture = LinearPicture::new(width, height, [1.0; 4]);
    for (row, samples) in samples.chunks_exact(width * channels).rev().enumerate() {
        let samples = samples.chunks_exact(channels);
        for (pixel, samples) in picture.row_mut(row).iter_mut().zip(samples) {
            for (i, channel) in pixel[..3].iter_mut().enumerate() {
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
            self.broken(format!("{what} is \"{found}\": expected a number"))
        })
    }

    /// Returns the next word of the header.
    fn word(&mut self) -> &'a [u8] {
        loop {
            self.rest = self.rest.trim_ascii_start();
            if self.rest.first() != Some(&b'#') {
                break;
            }
            let end = self.rest.iter().position(|&byte| byte == b'\n');
            self.rest = &self.rest[end.unwrap_or(self.rest.len())..];
        }
        let end = self.rest.iter().position(u8::is_ascii_whitespace);
        let end = end.unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word
    }

    /// Returns all that follows the single white space after the header, which must be `expected` bytes.
    fn samples(&self, expected: usize) -> Result<&'a [u8], DecodeError> {
        let samples = self.rest.get(1..).unwrap_or_default();
        let found = samples.len();
        let problem = match found.cmp(&expected) {
            Ordering::Equal => return Ok(samples),
            Ordering::Less => "it ends too early",
            Ordering::Greater => "it goes on after its last pixel",
        };
        let problem = format!("{problem}: expected {expected} bytes of samples, found {found}");
        Err(self.broken(problem))
    }

    fn broken(&self, problem: impl Into<String>) -> DecodeError {
        DecodeError::malformed(self.format, problem)
    }
}
