//! Pictures in files: PNG, PPM and PFM.
//!
//! | ending | holds | loses |
//! |---|---|---|
//! | `.png` | red, green, blue, alpha in 8 bits | fractions of a grey level |
//! | `.ppm` | red, green, blue in 8 bits (P6) | the same, and alpha: which pixels are covered |
//! | `.pfm` | red, green, blue as floats (PF) | alpha |
//!
//! Values are stored as they are: no file is given or read with a gamma of its own. Writing goes by the ending of the
//! path, reading by the first bytes of the file.
//!
//! ```no_run
//! use fastphong::compare::metrics::{compare, difference_map};
//! use fastphong::picture::image_file::{FilePicture, comparable, read_picture, write_picture};
//! use std::path::Path;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let reference = read_picture(Path::new("reference.pfm"))?;
//! let actual = read_picture(Path::new("actual.png"))?;
//! let [reference, actual] = comparable(&reference, &actual);
//! println!("{} grey levels", 255.0 * compare(&reference, &actual)?.max);
//! write_picture(Path::new("map.png"), &FilePicture::stored(difference_map(&reference, &actual, 16.0)?))?;
//! # Ok(())
//! # }
//! ```

use std::borrow::ToOwned;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use std::vec::Vec;

use super::encoding::quantise;
use super::{Levels, LinearPicture, Picture, Picture8, Pixel};

mod error;
mod netpbm;
mod png;
mod replace;

pub use error::{DecodeError, EncodeError, ImageFileError};
pub use netpbm::PpmWriter;
pub use png::encode_png;
pub use replace::{NoDrafts, end_of_links, remove_drafts, write_file, write_file_by};

/// Pixels of the largest picture that is read, 8192 × 8192: beyond that a file is more likely broken, or hostile, than meant.
pub const MAX_PIXELS: u64 = 1 << 26;

/// Bytes of the largest file that is read: the largest picture as floats, and as much again for headers, text and bad compression.
const MAX_BYTES: u64 = 2 * 12 * MAX_PIXELS;

/// A format of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Portable Network Graphics: 8 bits per channel, with alpha.
    Png,
    /// Portable pixmap, binary (P6): 8 bits per channel, no alpha.
    Ppm,
    /// Portable float map (PF): linear floats, no alpha.
    Pfm,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 3] = [Format::Png, Format::Ppm, Format::Pfm];

    /// Returns its ending, in lower case and without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Ppm => "ppm",
            Format::Pfm => "pfm",
        }
    }

    /// Returns the format that the ending of `path` names, in either case.
    ///
    /// # Errors
    /// If there is no ending, or one of no format.
    pub fn of_path(path: &Path) -> Result<Format, ImageFileError> {
        let ending = path.extension().unwrap_or_default();
        let is_named = |format: &Format| ending.eq_ignore_ascii_case(format.ending());
        let path = path.to_owned();
        let format = Format::ALL.into_iter().find(is_named);
        format.ok_or(ImageFileError::UnknownEnding { path })
    }
}

/// The pixels that a file holds.
#[derive(Clone, Debug, PartialEq)]
pub enum FilePixels {
    /// Grey levels, from PNG or PPM.
    Stored(Picture8),
    /// Floats, from PFM.
    Linear(LinearPicture),
}

/// The contents of a picture file.
#[derive(Clone, Debug, PartialEq)]
pub struct FilePicture {
    /// The pixels; alpha is full where the file has none.
    pub pixels: FilePixels,
    /// True if the file says which pixels are covered.
    pub has_alpha: bool,
}

impl FilePicture {
    /// Makes a picture of grey levels with alpha, as it goes into a PNG file.
    pub fn stored(picture: Picture8) -> FilePicture {
        FilePicture {
            pixels: FilePixels::Stored(picture),
            has_alpha: true,
        }
    }

    /// Makes a picture of floats with alpha, as it is before it goes into a file.
    pub fn linear(picture: LinearPicture) -> FilePicture {
        FilePicture {
            pixels: FilePixels::Linear(picture),
            has_alpha: true,
        }
    }

    /// Returns width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        match &self.pixels {
            FilePixels::Stored(picture) => [picture.width(), picture.height()],
            FilePixels::Linear(picture) => [picture.width(), picture.height()],
        }
    }

    /// Returns the picture in 8 bits per channel; floats are rounded by [`quantise`].
    pub fn to_stored(&self) -> Picture8 {
        match &self.pixels {
            FilePixels::Stored(picture) => picture.clone(),
            FilePixels::Linear(picture) => picture.map(|pixel| pixel.map(quantise)),
        }
    }

    /// Returns the picture in floats; a grey level is 1/255.
    pub fn to_linear(&self) -> LinearPicture {
        match &self.pixels {
            FilePixels::Stored(picture) => {
                picture.map(|pixel| pixel.map(|level| f32::from(level) / 255.0))
            }
            FilePixels::Linear(picture) => picture.clone(),
        }
    }

    /// Returns the bytes of a file of this picture.
    ///
    /// # Errors
    /// If the picture has no pixels, or more than the format can count: [`EncodeError`], inside.
    pub fn encode(&self, format: Format) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.write_to(format, &mut bytes)?;
        Ok(bytes)
    }

    /// Writes a file of this picture to `out`, which needs no buffer.
    ///
    /// # Errors
    /// As [`FilePicture::encode`], and those of `out`.
    pub fn write_to(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        match (format, &self.pixels) {
            (Format::Png, FilePixels::Stored(picture)) => {
                out.write_all(&encode_png(picture).map_err(io::Error::other)?)
            }
            (Format::Ppm, FilePixels::Stored(picture)) => netpbm::write_ppm(picture, out),
            (Format::Pfm, FilePixels::Linear(picture)) => netpbm::write_pfm(picture, out),
            (Format::Pfm, FilePixels::Stored(_)) => netpbm::write_pfm(&self.to_linear(), out),
            (Format::Png | Format::Ppm, FilePixels::Linear(_)) => {
                FilePicture::stored(self.to_stored()).write_to(format, out)
            }
        }
    }

    fn levels(&self, with_alpha: bool) -> Picture<Levels> {
        let levels = match &self.pixels {
            FilePixels::Stored(picture) => picture.map(Pixel::levels),
            FilePixels::Linear(picture) => picture.map(Pixel::levels),
        };
        match with_alpha {
            true => levels,
            false => levels.map(|Levels([r, g, b, _])| Levels([r, g, b, 255.0])),
        }
    }
}

/// Returns both pictures in grey levels, ready for [`compare`](crate::compare::metrics::compare) and the maps.
///
/// If one of the files has no alpha, the other's is dropped: all pixels count as covered, and none as a mismatch.
pub fn comparable(reference: &FilePicture, actual: &FilePicture) -> [Picture<Levels>; 2] {
    let with_alpha = reference.has_alpha && actual.has_alpha;
    [reference.levels(with_alpha), actual.levels(with_alpha)]
}

/// Writes a picture in the format that the ending of `path` names; see [`write_file`] for what happens to a file already there.
///
/// # Errors
/// If the ending names no format, the format cannot hold the picture, or the file cannot be written.
pub fn write_picture(path: &Path, picture: &FilePicture) -> Result<(), ImageFileError> {
    let format = Format::of_path(path)?;
    write_file_by(path, |file| picture.write_to(format, file))
}

/// Reads a picture of any of the formats, whatever the path ends in.
///
/// # Errors
/// If the file cannot be read, is none of the formats, is broken or cut off, or has more than [`MAX_PIXELS`] pixels.
pub fn read_picture(path: &Path) -> Result<FilePicture, ImageFileError> {
    let (path, bytes) = (path.to_owned(), read_file(path)?);
    decode_picture(&bytes).map_err(|cause| ImageFileError::Decode { path, cause })
}

/// Reads the picture that the bytes of a file of any of the formats hold.
///
/// # Errors
/// If the bytes are none of the formats, are broken or cut off, or hold more than [`MAX_PIXELS`] pixels.
pub fn decode_picture(bytes: &[u8]) -> Result<FilePicture, DecodeError> {
    let (pixels, has_alpha) = match announced(bytes).ok_or(DecodeError::NotAPicture)? {
        Format::Png => {
            let (picture, has_alpha) = png::decode(bytes)?;
            (FilePixels::Stored(picture), has_alpha)
        }
        Format::Ppm => (FilePixels::Stored(netpbm::decode_ppm(bytes)?), false),
        Format::Pfm => (FilePixels::Linear(netpbm::decode_pfm(bytes)?), false),
    };
    Ok(FilePicture { pixels, has_alpha })
}

/// Returns the format that the first bytes of a file announce.
fn announced(bytes: &[u8]) -> Option<Format> {
    match bytes {
        _ if bytes.starts_with(&png::SIGNATURE) => Some(Format::Png),
        [b'P', b'6', ..] => Some(Format::Ppm),
        [b'P', b'F' | b'f', ..] => Some(Format::Pfm),
        _ => None,
    }
}

/// Reads a file, unless it does not begin like a picture or is too large.
fn read_file(path: &Path) -> Result<Vec<u8>, ImageFileError> {
    let read = || {
        let mut bytes = Vec::new();
        // One byte more than is allowed, to see that there is more: some files, such as devices, never end.
        let mut file = File::open(path)?.take(MAX_BYTES + 1);
        file.by_ref()
            .take(png::SIGNATURE.len() as u64)
            .read_to_end(&mut bytes)?;
        // The beginning of a file tells that it is no picture: the rest need not be read.
        if announced(&bytes).is_some() {
            file.read_to_end(&mut bytes)?;
        }
        if bytes.len() as u64 > MAX_BYTES {
            let problem = "the file is too large for a picture";
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, problem));
        }
        Ok(bytes)
    };
    let path = path.to_owned();
    read().map_err(|cause| ImageFileError::Read { path, cause })
}

/// Returns width and height as `usize`, if a picture of that size may be read.
fn checked_size(format: Format, width: u64, height: u64) -> Result<[usize; 2], DecodeError> {
    if width == 0 || height == 0 {
        return Err(DecodeError::malformed(
            format,
            "it has no pixels: expected a width and a height of at least 1",
        ));
    }
    match width.checked_mul(height) {
        Some(pixels) if pixels <= MAX_PIXELS => Ok([width as usize, height as usize]),
        _ => Err(DecodeError::TooLarge { width, height }),
    }
}

#[cfg(test)]
mod tests;
