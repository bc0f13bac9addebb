//! Why a picture file could not be read or written.

use std::io;
use std::path::PathBuf;
use std::string::String;

use super::{Format, MAX_PIXELS};

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
    /// The first bytes are those of no format.
    #[error("not a picture that can be read: expected PNG, PPM (P6) or PFM")]
    NotAPicture,
    /// There are more than [`MAX_PIXELS`] pixels.
    #[error("{width}×{height} pixels are too many: expected at most {MAX_PIXELS}")]
    TooLarge {
        /// Width that the file states, in pixels.
        width: u64,
        /// Height that the file states, in pixels.
        height: u64,
    },
    /// The file is broken or cut off.
    #[error("broken {} file: {problem}", format.ending().to_uppercase())]
    Malformed {
        /// The format that the first bytes announce.
        format: Format,
        /// The finding, and what was expected.
        problem: String,
    },
}

impl DecodeError {
    /// Makes the error for a broken file.
    pub(super) fn malformed(format: Format, problem: impl Into<String>) -> DecodeError {
        let problem = problem.into();
        DecodeError::Malformed { format, problem }
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
