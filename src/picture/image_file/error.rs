//! Why a picture file could not be read or written.

use std::io;
use std::path::PathBuf;
use std::string::String;

use super::{MAX_PIXELS, MAX_READ_SIDE};

/// Why a picture file could not be read or written.
// The text of a cause is part of the message, so it is not given as a source: a chain would say it twice.
#[derive(Debug, thiserror::Error)]
pub enum ImageFileError {
    /// The path ends in none of the formats.
    #[error("{}: no picture format has this ending: expected .png, .ppm or .pfm", path.display())]
    UnknownEnding {
        /// The path.
        path: PathBuf,
    },
    /// The file system refused to give the file.
    #[error("{}: cannot be read: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        cause: io::Error,
    },
    /// The file is not a picture that can be read.
    #[error("{}: {cause}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// The reason.
        cause: DecodeError,
    },
    /// The file system refused to take the file; the one that was there before is untouched.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        cause: io::Error,
    },
}

/// A problem with the bytes of a picture file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DecodeError {
    /// The file has no bytes.
    #[error("the file is empty: expected {EXPECTED}")]
    Empty,
    /// The first bytes are those of another format.
    #[error("it is {found}, which is not read: expected {EXPECTED}")]
    OtherFormat {
        /// The format, with its article.
        found: &'static str,
    },
    /// The first bytes are those of no format that is known.
    #[error("not a picture that can be read: expected {EXPECTED}")]
    NotAPicture,
    /// There are more than [`MAX_PIXELS`] pixels, or a side is longer than [`MAX_READ_SIDE`].
    #[error(
        "{width}×{height} pixels are too many: expected at most {MAX_PIXELS}, and {MAX_READ_SIDE} a side"
    )]
    TooLarge {
        /// Width that the file states, in pixels.
        width: u64,
        /// Height that the file states, in pixels.
        height: u64,
    },
    /// The system gives no memory for the pixels.
    #[error("there is not enough memory for {width}×{height} pixels")]
    NoMemory {
        /// Width that the file states, in pixels.
        width: usize,
        /// Height that the file states, in pixels.
        height: usize,
    },
    /// The file is broken or cut off.
    #[error("broken {format} file: {problem}")]
    Malformed {
        /// The name of the format that the first bytes announce.
        format: &'static str,
        /// The finding, and what was expected.
        problem: String,
    },
}

/// The formats that are read.
const EXPECTED: &str = "PNG, PBM, PGM, PPM (P1 to P6), PAM, PFM, BMP or Targa (.tga)";

/// Other formats by their first bytes.
const OTHERS: [(&[u8], &str); 13] = [
    (b"\xff\xd8\xff", "a JPEG file"),
    (b"GIF8", "a GIF file"),
    (b"RIFF", "a WebP or another RIFF file"),
    (b"II*\0", "a TIFF file"),
    (b"MM\0*", "a TIFF file"),
    (b"\x76\x2f\x31\x01", "an OpenEXR file"),
    (b"#?R", "a Radiance HDR file"),
    (b"8BPS", "a Photoshop file"),
    (b"qoif", "a QOI file"),
    (b"farbfeld", "a farbfeld file"),
    (b"DDS ", "a DDS file"),
    (b"<svg", "an SVG file"),
    (b"%PDF", "a PDF file"),
];

impl DecodeError {
    /// Makes the error for a broken file.
    pub(super) fn malformed(format: &'static str, problem: impl Into<String>) -> DecodeError {
        let problem = problem.into();
        DecodeError::Malformed { format, problem }
    }

    /// Makes the error for a file that begins like no picture that can be read.
    pub(super) fn not_a_picture(beginning: &[u8]) -> DecodeError {
        let other = OTHERS
            .iter()
            .find(|(first, _)| beginning.starts_with(first));
        match other {
            _ if beginning.is_empty() => DecodeError::Empty,
            Some((_, found)) => DecodeError::OtherFormat { found },
            None => DecodeError::NotAPicture,
        }
    }
}

/// A picture that does not fit into a file: it has no pixels, or a side longer than the formats can state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a picture of {width}×{height} pixels does not fit: expected 1 to {MAX_SIDE} pixels a side"
)]
pub struct EncodeError {
    /// The width in pixels.
    pub width: usize,
    /// The height in pixels.
    pub height: usize,
}

/// Longest side that is written: PNG states no longer ones (ISO/IEC 15948, 7.1), readers of the others are not bound to.
const MAX_SIDE: usize = (1 << 31) - 1;

impl EncodeError {
    /// Returns the error about a picture of this size, if there is one.
    pub(super) fn check(width: usize, height: usize) -> Result<(), EncodeError> {
        let fits = |side| (1..=MAX_SIDE).contains(&side);
        match fits(width) && fits(height) {
            true => Ok(()),
            false => Err(EncodeError { width, height }),
        }
    }
}
