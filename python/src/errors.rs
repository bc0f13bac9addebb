//! Turns the crate's errors into Python's.

use fastphong::memory::TooLittleMemory;
use pyo3::PyErr;
use pyo3::exceptions::{
    PyFileNotFoundError, PyIsADirectoryError, PyMemoryError, PyOSError, PyPermissionError,
    PyValueError,
};
use std::fmt::Display;
use std::io::ErrorKind;
use std::path::Path;

/// Returns a `ValueError` with the crate's message.
pub fn value_error(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Returns a `MemoryError` that says how much memory is needed.
pub fn memory_error(error: TooLittleMemory) -> PyErr {
    PyMemoryError::new_err(error.to_string())
}

/// Returns an error about the input `path` with the crate's message: an `OSError` if the system
/// cannot open the file, else a `ValueError`.
pub fn input_error(error: impl Display, path: &Path) -> PyErr {
    if path.to_string_lossy().starts_with("builtin:") {
        return value_error(error);
    }
    match std::fs::File::open(path) {
        Err(cause) if cause.raw_os_error().is_some() => os_error(&cause, error.to_string(), path),
        Err(_) => value_error(error),
        Ok(_) if path.is_dir() => {
            // EISDIR: no system error is behind this one.
            PyIsADirectoryError::new_err((21, error.to_string()))
        }
        Ok(_) => value_error(error),
    }
}

/// Returns an `OSError` of the kind of `cause`, with the crate's message.
pub fn os_error(cause: &std::io::Error, message: String, path: &Path) -> PyErr {
    // The crate's own errors have a kind but no code of the system.
    let code = cause.raw_os_error().unwrap_or(match cause.kind() {
        ErrorKind::NotFound => 2,
        ErrorKind::PermissionDenied => 13,
        _ => 5,
    });
    let path = path.to_string_lossy().into_owned();
    match cause.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            PyFileNotFoundError::new_err((code, message, path))
        }
        ErrorKind::PermissionDenied => PyPermissionError::new_err((code, message, path)),
        _ => PyOSError::new_err((code, message, path)),
    }
}
