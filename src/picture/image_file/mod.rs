//! Picture files: PNG, portable pixmaps and PFM.
//!
//! | ending | written | lost |
//! |---|---|---|
//! | `.png` | red, green, blue, straight alpha in 8 bits; the encoding, if the picture states it; the name of this program | fractions of a grey level |
//! | `.ppm` | red, green, blue in 8 bits (P6) | fractions of a grey level, alpha, and the encoding |
//! | `.pfm` | red, green, blue as linear floats (PF) | alpha |
//!
//! Formats without alpha hold the picture over the background that it states.
//!
//! [`read_picture`] reads PNG of all colour types and depths, PBM, PGM and PPM (P1 to P6), PAM (P7)
//! and PFM as they are stored, in 8 bits, 16 bits or floats. It also reads BMP and Targa in 8 bits.
//! The ending of the path decides which format is written; the first bytes of a file decide which
//! one is read. Targa has no signature and is recognised by the ending `.tga`. [`Pair`] makes two
//! pictures comparable.
//!
//! ```no_run
//! use fastphong::compare::metrics::{compare, difference_map};
//! use fastphong::picture::image_file::{FilePicture, Pair, read_picture, write_picture};
//! use std::path::Path;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let reference = read_picture(Path::new("reference.pfm"))?;
//! let actual = read_picture(Path::new("actual.png"))?;
//! let [reference, actual] = Pair::new(&reference, &actual, None).compared();
//! println!("{} grey levels", 255.0 * compare(&reference, &actual)?.max);
//! write_picture(Path::new("map.png"), &FilePicture::stored(difference_map(&reference, &actual, 16.0)?))?;
//! # Ok(())
//! # }
//! ```

use std::borrow::ToOwned;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;
use std::string::String;
use std::vec;
use std::vec::Vec;

use super::encoding::quantise;
use super::{Encoding, Levels, LinearPicture, Picture, Picture8, Pixel};

mod bitmap;
mod error;
mod netpbm;
mod pair;
mod png;
mod replace;

use bitmap::Bitmap;
pub use error::{DecodeError, EncodeError, ImageFileError};
pub use netpbm::PpmWriter;
pub use pair::{AlphaUse, Pair, UsedEncoding};
pub use png::encode_png;
#[doc(hidden)]
pub use replace::{Replacements, place, remove_drafts, write_file, write_file_by};

/// How many pixels the largest readable picture has: 16384 × 16384, the largest that is drawn. A
/// larger file is more likely broken or hostile than intended.
pub(crate) const MAX_PIXELS: u64 = 1 << 28;

/// The longest side of a readable picture, in pixels.
pub(crate) const MAX_READ_SIDE: u64 = 1 << 20;

/// The size of the largest readable file: the largest picture as floats, and as much again for
/// headers, text and bad compression.
const MAX_BYTES: u64 = 2 * 12 * MAX_PIXELS;

/// A format of picture files that can be written.
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

    /// Returns the ending, in lower case and without the dot.
    pub fn ending(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Ppm => "ppm",
            Format::Pfm => "pfm",
        }
    }

    /// Returns the format that the ending of `path` names. Case is ignored.
    ///
    /// # Errors
    /// If there is no ending, or it names no format.
    pub fn of_path(path: &Path) -> Result<Format, ImageFileError> {
        let ending = path.extension().unwrap_or_default();
        let is_named = |format: &Format| ending.eq_ignore_ascii_case(format.ending());
        let path = path.to_owned();
        let format = Format::ALL.into_iter().find(is_named);
        format.ok_or(ImageFileError::UnknownEnding { path })
    }
}

/// The pixels of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum FilePixels {
    /// Grey levels.
    Stored(Picture8),
    /// Samples with more than 8 bits, or with another range than 0..=255.
    Deep {
        /// Red, green, blue, alpha.
        picture: Picture<[u16; 4]>,
        /// The sample that stands for full intensity, 1 to 65535.
        maximum: u16,
    },
    /// Floats, from PFM.
    Linear(LinearPicture),
}

/// The contents of a picture file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FilePicture {
    /// The pixels. Alpha is full if the file has none.
    pub pixels: FilePixels,
    /// True if the file says which pixels are covered.
    pub has_alpha: bool,
    /// The encoding, if the file states it.
    pub encoding: Option<Encoding>,
    /// The background colour, in stored grey levels, if the file states it (PNG: `bKGD`).
    pub background: Option<[f64; 3]>,
    /// Remarks that a reader should know, such as that the file holds several pictures. Each is a
    /// clause.
    pub notes: Vec<String>,
}

impl FilePicture {
    /// Makes a picture with alpha and without any other statement.
    fn of_pixels(pixels: FilePixels) -> FilePicture {
        FilePicture {
            pixels,
            has_alpha: true,
            encoding: None,
            background: None,
            notes: Vec::new(),
        }
    }

    /// Makes a picture of grey levels with alpha, as for a PNG file. It states no encoding.
    pub fn stored(picture: Picture8) -> FilePicture {
        FilePicture::of_pixels(FilePixels::Stored(picture))
    }

    /// Makes a picture of linear floats with alpha.
    pub fn linear(picture: LinearPicture) -> FilePicture {
        FilePicture {
            encoding: Some(Encoding::Linear),
            ..FilePicture::of_pixels(FilePixels::Linear(picture))
        }
    }

    /// Returns the picture, now stating this encoding.
    pub fn encoded(self, encoding: Encoding) -> FilePicture {
        FilePicture {
            encoding: Some(encoding),
            ..self
        }
    }

    /// Returns width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        match &self.pixels {
            FilePixels::Stored(picture) => [picture.width(), picture.height()],
            FilePixels::Deep { picture, .. } => [picture.width(), picture.height()],
            FilePixels::Linear(picture) => [picture.width(), picture.height()],
        }
    }

    /// Returns the picture in 8 bits per channel, in its encoding. Floats are rounded by
    /// [`quantise`].
    pub fn to_stored(&self) -> Picture8 {
        match &self.pixels {
            FilePixels::Stored(picture) => picture.clone(),
            FilePixels::Deep { picture, maximum } => {
                let maximum = u32::from(*maximum);
                // Rounds 255 · sample / maximum to the nearest integer, halves up.
                let level = |sample| ((510 * u32::from(sample) + maximum) / (2 * maximum)) as u8;
                picture.map(|pixel| pixel.map(level))
            }
            FilePixels::Linear(picture) => picture.map(|pixel| pixel.map(quantise)),
        }
    }

    /// Returns the stored values as floats, without a transfer function: a grey level is 1/255.
    pub fn to_linear(&self) -> LinearPicture {
        match &self.pixels {
            FilePixels::Stored(picture) => {
                picture.map(|pixel| pixel.map(|level| f32::from(level) / 255.0))
            }
            FilePixels::Deep { picture, maximum } => {
                let maximum = f32::from(*maximum);
                picture.map(|pixel| pixel.map(|sample| f32::from(sample) / maximum))
            }
            FilePixels::Linear(picture) => picture.clone(),
        }
    }

    /// Encodes the picture as the bytes of a file.
    ///
    /// # Errors
    /// If the picture has no pixels, or more than the format can count. The error holds an
    /// [`EncodeError`].
    pub fn encode(&self, format: Format) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.write_to(format, &mut bytes)?;
        Ok(bytes)
    }

    /// Writes the picture as a file to `out`. `out` need not be buffered.
    ///
    /// # Errors
    /// As for [`FilePicture::encode`], and any error of `out`.
    pub fn write_to(&self, format: Format, out: &mut dyn Write) -> io::Result<()> {
        let without_alpha = match format {
            Format::Png => None,
            Format::Ppm | Format::Pfm => self.flattened(),
        };
        let picture = without_alpha.as_ref().unwrap_or(self);
        match (format, &picture.pixels) {
            (Format::Png, FilePixels::Stored(pixels)) => {
                let stated = png::Stated {
                    encoding: self.encoding,
                    background: self.background,
                    software: true,
                };
                png::write(pixels, stated, out)
            }
            (Format::Ppm, FilePixels::Stored(pixels)) => netpbm::write_ppm(pixels, out),
            (Format::Pfm, _) if picture.encoding == Some(Encoding::Srgb) => {
                let linear = |level: f64| Encoding::Srgb.decode(level / 255.0) as f32;
                netpbm::write_pfm(&picture.map_levels(|pixel| pixel.rgb().map(linear)), out)
            }
            (Format::Pfm, FilePixels::Linear(pixels)) => netpbm::write_pfm(pixels, out),
            (Format::Pfm, _) => netpbm::write_pfm(&picture.to_linear(), out),
            (Format::Png | Format::Ppm, _) => {
                let pixels = FilePixels::Stored(picture.to_stored());
                let notes = Vec::new();
                let picture = FilePicture {
                    pixels,
                    notes,
                    ..*picture
                };
                picture.write_to(format, out)
            }
        }
    }

    /// Returns the picture over its background, for formats without alpha. Returns `None` if it
    /// states no background, or every pixel is fully covered.
    fn flattened(&self) -> Option<FilePicture> {
        let background = self.background?;
        if !self.has_alpha || pair::is_opaque(self) {
            return None;
        }
        let encoding = pair::UsedEncoding::of(self, None).encoding;
        let linear = self.map_levels(|pixel| {
            let colour = pair::flattened(pixel, background, encoding);
            colour.map(|level| (level / 255.0) as f32)
        });
        Some(FilePicture {
            encoding: self.encoding,
            has_alpha: false,
            ..FilePicture::linear(linear)
        })
    }

    /// Returns the opaque picture that `of` makes of the stored values.
    fn map_levels(&self, of: impl Fn(Levels) -> [f32; 3]) -> LinearPicture {
        let [width, height] = self.size();
        let mut picture = LinearPicture::new(width, height, [1.0; 4]);
        let mut levels = vec![Levels([0.0; 4]); width];
        for y in 0..height {
            self.stored_levels(y, &mut levels);
            for (pixel, levels) in picture.row_mut(y).iter_mut().zip(&levels) {
                let [r, g, b] = of(*levels);
                *pixel = [r, g, b, 1.0];
            }
        }
        picture
    }

    /// Writes the stored values of row `y` into `levels`.
    fn stored_levels(&self, y: usize, levels: &mut [Levels]) {
        fn fill<P: Pixel>(row: &[P], levels: &mut [Levels]) {
            for (levels, pixel) in levels.iter_mut().zip(row) {
                *levels = pixel.levels();
            }
        }
        match &self.pixels {
            FilePixels::Stored(picture) => fill(picture.row(y), levels),
            FilePixels::Linear(picture) => fill(picture.row(y), levels),
            FilePixels::Deep { picture, maximum } => {
                // The product is exact, so that a sample which stands for a whole level becomes
                // exactly that level.
                let level = |sample| 255.0 * f64::from(sample) / f64::from(*maximum);
                for (levels, pixel) in levels.iter_mut().zip(picture.row(y)) {
                    *levels = Levels(pixel.map(level));
                }
            }
        }
    }
}

/// Writes a picture in the format that the ending of `path` names. An existing file is replaced
/// only once the new one is complete.
///
/// # Errors
/// If the ending names no format, the format cannot hold the picture, or the file cannot be
/// written.
pub fn write_picture(path: &Path, picture: &FilePicture) -> Result<(), ImageFileError> {
    let format = Format::of_path(path)?;
    write_file_by(path, |file| picture.write_to(format, file))
}

/// Reads a picture in any of the formats. The ending of the path does not matter, except for Targa.
///
/// # Errors
/// If the file cannot be read, is none of the formats, is broken or cut off, or has more than 2²⁸
/// pixels.
pub fn read_picture(path: &Path) -> Result<FilePicture, ImageFileError> {
    let failed = |cause| ImageFileError::Read {
        path: path.to_owned(),
        cause,
    };
    read_picture_from(File::open(path).map_err(failed)?, path)
}

/// Reads a picture from `input`, which need not be buffered. Errors call it `path`.
///
/// # Errors
/// As for [`read_picture`].
pub fn read_picture_from(input: impl Read, path: &Path) -> Result<FilePicture, ImageFileError> {
    let ending = path.extension().unwrap_or_default();
    let is_targa = ending.eq_ignore_ascii_case("tga");
    let path = path.to_owned();
    // One byte more than is allowed reveals a file that is too long. Some files, such as devices,
    // never end.
    let mut input = BufReader::new(input.take(MAX_BYTES + 1));
    decode(&mut input, is_targa).map_err(|problem| match problem {
        ReadProblem::Io(cause) => ImageFileError::Read { path, cause },
        ReadProblem::Decode(cause) => ImageFileError::Decode { path, cause },
    })
}

/// Decodes the bytes of a picture file in any of the formats except Targa, which only a file name
/// identifies.
///
/// # Errors
/// If the bytes are none of the formats, are broken or cut off, or hold more than 2²⁸ pixels.
pub fn decode_picture(bytes: &[u8]) -> Result<FilePicture, DecodeError> {
    let mut input = bytes;
    decode(&mut input, false).map_err(|problem| match problem {
        ReadProblem::Io(error) => unreachable!("bytes in memory can be read: {error}"),
        ReadProblem::Decode(error) => error,
    })
}

/// Why a picture could not be read. The path is added later.
#[derive(Debug)]
enum ReadProblem {
    Io(io::Error),
    Decode(DecodeError),
}

impl From<io::Error> for ReadProblem {
    fn from(error: io::Error) -> Self {
        ReadProblem::Io(error)
    }
}

impl From<DecodeError> for ReadProblem {
    fn from(error: DecodeError) -> Self {
        ReadProblem::Decode(error)
    }
}

/// Reads a picture. The first bytes decide the format; if they match none, the name may say that it
/// is Targa.
fn decode(input: &mut dyn BufRead, is_targa: bool) -> Result<FilePicture, ReadProblem> {
    // The first bytes show whether the file is a picture at all. If not, the rest need not be read.
    let mut beginning = Vec::new();
    let mut first = (&mut *input).take(BEGINNING);
    first.read_to_end(&mut beginning)?;
    let mut whole = beginning.as_slice().chain(input);
    if beginning.starts_with(&png::SIGNATURE) {
        return Ok(png::decode(&all_bytes(&mut whole)?)?);
    }
    if let Some(kind) = netpbm::Kind::announced(&beginning) {
        return netpbm::read(kind, &mut whole);
    }
    if beginning.starts_with(&Bitmap::BMP_SIGNATURE) {
        return Ok(Bitmap::Bmp.decode(&all_bytes(&mut whole)?)?);
    }
    match DecodeError::not_a_picture(&beginning) {
        DecodeError::NotAPicture if is_targa => Ok(Bitmap::Targa.decode(&all_bytes(&mut whole)?)?),
        error => Err(error.into()),
    }
}

/// Reads a file to its end, unless it is too long.
fn all_bytes(input: &mut dyn Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_BYTES {
        let problem = "the file is too large for a picture";
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, problem));
    }
    Ok(bytes)
}

/// How many first bytes identify a format.
const BEGINNING: u64 = 16;

/// Returns width and height as `usize` if a picture of that size may be read.
fn checked_size(format: &'static str, width: u64, height: u64) -> Result<[usize; 2], DecodeError> {
    if width == 0 || height == 0 {
        return Err(DecodeError::malformed(
            format,
            "it has no pixels: expected a width and a height of at least 1",
        ));
    }
    if width.max(height) > MAX_READ_SIDE || width * height > MAX_PIXELS {
        return Err(DecodeError::TooLarge { width, height });
    }
    Ok([width as usize, height as usize])
}

/// Returns an empty list with room for the pixels of a picture. Rows are added as they are read, so
/// that a truncated file does not cost the memory that its header promises.
///
/// # Errors
/// If there is not enough memory.
fn reserved<P>(width: usize, height: usize) -> Result<Vec<P>, DecodeError> {
    let mut pixels = Vec::new();
    match pixels.try_reserve_exact(width * height) {
        Ok(()) => Ok(pixels),
        Err(_) => Err(DecodeError::NoMemory { width, height }),
    }
}

/// True if there is memory for `count` values at once.
fn has_room<T>(count: usize) -> bool {
    let mut values = Vec::<T>::new();
    let is_there = values.try_reserve_exact(count).is_ok();
    // Without this the compiler would remove the unused allocation.
    core::hint::black_box(&mut values);
    is_there
}

#[cfg(test)]
mod tests;
