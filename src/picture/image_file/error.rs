use std::borrow::ToOwned;
use std::error::Error;
use std::fmt;
use std::io;
use std::path::PathBuf;
use std::string::String;

use super::{Format, MAX_PIXELS};

/// Why a picture file could not be read or written.
#[derive(Debug)]
pub enum ImageFileError {
    /// The path ends in none of the formats.
    UnknownEnding {
        /// The path.
        path: PathBuf,
    },
    /// The file system refused to give the file.
    Read {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: io::Error,
    },
    /// The file is not a picture that can be read.
    Decode {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: DecodeError,
    },
    /// The picture does not fit the format.
    Encode {
        /// The file that was to be written.
        path: PathBuf,
        /// Why not.
        source: EncodeError,
    },
    /// The file system refused to take the file; what was there before is untouched.
    Write {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: io::Error,
    },
}

impl fmt::Display for ImageFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ImageFileError::UnknownEnding { path } => {
                write!(
                    f,
                    "{}: no picture format has this ending: expected .png, .ppm or .pfm",
                    path.display()
                )
            }
            ImageFileError::Read { path, source } => {
                write!(f, "{}: cannot be read: {source}", path.display())
            }
            ImageFileError::Decode { path, source } => write!(f, "{}: {source}", path.display()),
            ImageFileError::Encode { path, source } => write!(f, "{}: {source}", path.display()),
            ImageFileError::Write { path, source } => {
                write!(f, "{}: cannot be written: {source}", path.display())
            }
        }
    }
}

// The text of the cause is part of the message, so it is not given as a source: a chain would say it twice.
impl Error for ImageFileError {}

/// What is wrong with the bytes of a picture file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DecodeError {
    /// The first bytes are those of no format.
    NotAPicture,
    /// The first bytes are not those of PNG, which alone was asked for.
    NotPng,
    /// There are more than [`MAX_PIXELS`] pixels.
    TooLarge {
        /// Width that the file states, in pixels.
        width: u64,
        /// Height that the file states, in pixels.
        height: u64,
    },
    /// The file is broken or cut off.
    Malformed {
        /// The format that the first bytes announce.
        format: Format,
        /// What was found and what was expected.
        problem: String,
    },
}

impl DecodeError {
    pub(super) fn malformed(format: Format, problem: &str) -> DecodeError {
        DecodeError::Malformed {
            format,
            problem: problem.to_owned(),
        }
    }
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DecodeError::NotAPicture => write!(
                f,
                "not a picture that can be read: expected PNG, PPM (P6) or PFM"
            ),
            DecodeError::NotPng => write!(
                f,
                "not a PNG file: expected the PNG signature in its first 8 bytes"
            ),
            DecodeError::TooLarge { width, height } => {
                write!(
                    f,
                    "{width}×{height} pixels are too many: expected at most {MAX_PIXELS}"
                )
            }
            DecodeError::Malformed { format, problem } => {
                write!(
                    f,
                    "broken {} file: {problem}",
                    format.ending().to_uppercase()
                )
            }
        }
    }
}

impl Error for DecodeError {}

/// A picture that does not fit into a file: it has no pixels, or more than the format can count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EncodeError {
    /// Its width in pixels.
    pub width: usize,
    /// Its height in pixels.
    pub height: usize,
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let EncodeError { width, height } = self;
        write!(
            f,
            "a picture of {width}×{height} pixels does not fit: expected 1 to 2147483647 pixels a side"
        )
    }
}

impl Error for EncodeError {}
