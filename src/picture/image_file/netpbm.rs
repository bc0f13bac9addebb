//! Portable pixmaps: a short header in text, then the samples. This module writes PPM and PFM;
//! `read` reads the whole family.

use std::format;
use std::io::{self, Write};
use std::vec::Vec;

use super::EncodeError;
use crate::picture::{LinearPicture, Picture8};

mod read;
pub(super) use read::{Kind, read};

/// How many pixels are converted at a time.
const RUN: usize = 1 << 10;

/// How many bytes are written at a time: enough to hide the cost of a call, few enough to stay in a
/// cache, and whole pages of the file.
const PIECE: usize = 1 << 17;

/// Writes a binary PPM file (P6, 255 levels): red, green, blue as they are stored. Alpha is
/// dropped.
pub(super) fn write_ppm(picture: &Picture8, out: impl Write) -> io::Result<()> {
    let (width, height) = (picture.width(), picture.height());
    let mut file = PpmWriter::new(out, width, height).map_err(io::Error::other)?;
    file.pixels(picture.pixels())?;
    file.finish()
}

/// A writer of a binary PPM file. It takes the pixels from the top, so that the whole picture need
/// not be in memory.
#[derive(Debug)]
pub struct PpmWriter<W> {
    pieces: Pieces<W>,
    /// How many pixels are still missing.
    missing: usize,
}

impl<W: Write> PpmWriter<W> {
    /// Starts a file of `width` × `height` pixels in `out`. `out` need not be buffered.
    ///
    /// # Errors
    /// If there are no pixels, or a side is longer than 2³¹ − 1.
    pub fn new(out: W, width: usize, height: usize) -> Result<Self, EncodeError> {
        Ok(PpmWriter {
            pieces: Pieces::new(out, "P6", [width, height], "255")?,
            missing: width * height,
        })
    }

    /// Writes the next pixels, row by row. Alpha is dropped.
    ///
    /// # Errors
    /// If they cannot be written, or are more than the file has left.
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

    /// Writes the rest of the buffer.
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

/// Writes a PFM file: red, green, blue as little-endian floats, the bottom row first. Alpha is
/// dropped.
pub(super) fn write_pfm(picture: &LinearPicture, out: impl Write) -> io::Result<()> {
    let (width, height) = (picture.width(), picture.height());
    // The sign of the scale states the byte order: negative is little-endian.
    let mut pieces = Pieces::new(out, "PF", [width, height], "-1.0").map_err(io::Error::other)?;
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

/// The bytes of a file that were not written yet.
#[derive(Debug)]
struct Pieces<W> {
    out: W,
    bytes: Vec<u8>,
}

impl<W: Write> Pieces<W> {
    /// Starts with the header: the format's first word, the size and the range of the samples.
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
    // Four pixels fill three 32-bit words: shifts and ORs instead of twelve bytes one by one.
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
