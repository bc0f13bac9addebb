//! Errors of reading and writing picture files.

use std::io;
use std::path::PathBuf;
use std::string::String;

use super::{MAX_PIXELS, MAX_READ_SIDE};

/// Why a picture file could not be read or written.
// The message contains the text of the cause. The cause is no `source`, because an error chain
// would then print it twice.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ImageFileError {
    /// The path has none of the known endings.
    #[error("{}: no picture format has this ending: expected .png, .ppm or .pfm", path.display())]
    UnknownEnding {
        /// The path.
        path: PathBuf,
    },
    /// The operating system could not read the file.
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
    /// The operating system could not write the file. A file that was there before is unchanged.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        cause: io::Error,
    },
}

/// What is wrong with the bytes of a picture file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DecodeError {
    /// The file has no bytes.
    #[error("the file is empty: expected {EXPECTED}")]
    Empty,
    /// The first bytes are those of another format.
    #[error("it is {found}, which is not read: expected {EXPECTED}")]
    OtherFormat {
        /// The format, with its article: "a JPEG file".
        found: &'static str,
    },
    /// The first bytes match no known format.
    #[error("not a picture that can be read: expected {EXPECTED}")]
    NotAPicture,
    /// There are more than 2²⁸ pixels, or a side is longer than 2²⁰.
    #[error(
        "{width}×{height} pixels are too many: expected at most {MAX_PIXELS}, and {MAX_READ_SIDE} a side"
    )]
    TooLarge {
        /// The width that the file states, in pixels.
        width: u64,
        /// The height that the file states, in pixels.
        height: u64,
    },
    /// There is not enough memory for the pixels.
    #[error("there is not enough memory for {width}×{height} pixels")]
    NoMemory {
        /// The width that the file states, in pixels.
        width: usize,
        /// The height that the file states, in pixels.
        height: usize,
    },
    /// The file is broken or cut off.
    #[error("broken {format} file: {problem}")]
    Malformed {
        /// The name of the format that the first bytes announce.
        format: &'static str,
        /// What is wrong, and what was expected.
        problem: String,
    },
}

/// The formats that are read.
const EXPECTED: &str = "PNG, PBM, PGM, PPM (P1 to P6), PAM, PFM, BMP or Targa (.tga)";

/// Other formats, identified by their first bytes.
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

    /// Makes the error for a file whose first bytes match no format that is read.
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

/// A picture that does not fit into a file, because it has no pixels or a side is longer than the
/// formats allow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a picture of {width}×{height} pixels does not fit: expected 1 to {MAX_SIDE} pixels a side"
)]
#[non_exhaustive]
pub struct EncodeError {
    /// The width in pixels.
    pub width: usize,
    /// The height in pixels.
    pub height: usize,
}

/// The longest side that is written. PNG allows no longer ones (ISO/IEC 15948, 7.1), and readers of
/// the other formats need not accept them.
const MAX_SIDE: usize = (1 << 31) - 1;

impl EncodeError {
    /// Returns an error if no file can hold a picture of this size.
    pub(super) fn check(width: usize, height: usize) -> Result<(), EncodeError> {
        let fits = |side| (1..=MAX_SIDE).contains(&side);
        if fits(width) && fits(height) {
            Ok(())
        } else {
            Err(EncodeError { width, height })
        }
    }
}
