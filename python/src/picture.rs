//! Compares pictures, and reads and writes picture files.

use crate::errors::{input_error, os_error, value_error};
use crate::pool::install;
use fastphong::compare::metrics::compare;
use fastphong::compare::metrics::difference_map as map;
use fastphong::picture::Picture8;
use fastphong::picture::image_file::{self, FilePicture, Format, ImageFileError};
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyBytes, PyDict};
use std::path::{Path, PathBuf};

/// Returns the picture that `bytes` hold, four per pixel.
fn picture(bytes: &[u8], (width, height): (usize, usize)) -> PyResult<Picture8> {
    let pixels = bytes.as_chunks().0.to_vec();
    let found = Picture8::from_pixels(width, height, pixels);
    found.ok_or_else(|| value_error(format!("expected {width}x{height} pixels of four bytes")))
}

/// Returns the difference of `actual` from `reference`, in grey levels.
#[pyfunction]
pub fn difference<'py>(
    py: Python<'py>,
    reference: &[u8],
    actual: &[u8],
    size: (usize, usize),
) -> PyResult<Bound<'py, PyDict>> {
    let pictures = [picture(reference, size)?, picture(actual, size)?];
    let compared = py.detach(|| install(|| compare(&pictures[0], &pictures[1])))?;
    let found = compared.map_err(value_error)?;
    let dict = PyDict::new(py);
    dict.set_item("equal", found.equal)?;
    dict.set_item("max", 255.0 * found.max)?;
    dict.set_item("rms", 255.0 * found.rms)?;
    dict.set_item("mean", 255.0 * found.mae)?;
    dict.set_item("p99", 255.0 * found.p99)?;
    dict.set_item("psnr", found.psnr)?;
    dict.set_item("ssim", found.ssim)?;
    dict.set_item("differing", found.differing)?;
    dict.set_item("compared", found.compared)?;
    dict.set_item("coverage_mismatches", found.coverage_mismatches)?;
    dict.set_item("worst", found.worst)?;
    Ok(dict)
}

/// Returns a map of the difference. A pixel is yellow at `scale` grey levels, magenta beyond, and
/// white where only one picture covers it.
#[pyfunction]
pub fn difference_map<'py>(
    py: Python<'py>,
    reference: &[u8],
    actual: &[u8],
    size: (usize, usize),
    scale: f32,
) -> PyResult<Bound<'py, PyByteArray>> {
    let pictures = [picture(reference, size)?, picture(actual, size)?];
    let drawn = py.detach(|| map(&pictures[0], &pictures[1], scale));
    let drawn = drawn.map_err(value_error)?;
    Ok(PyByteArray::new(py, drawn.pixels().as_flattened()))
}

/// Returns a picture as the bytes of a PNG file.
#[pyfunction]
pub fn encode_png<'py>(
    py: Python<'py>,
    pixels: &[u8],
    size: (usize, usize),
) -> PyResult<Bound<'py, PyBytes>> {
    let stored = picture(pixels, size)?;
    let encoded = py.detach(|| FilePicture::stored(stored).encode(Format::Png));
    Ok(PyBytes::new(py, &encoded.map_err(value_error)?))
}

/// Writes a picture file in the format that the ending of `path` names.
#[pyfunction]
pub fn write_picture(
    py: Python<'_>,
    path: PathBuf,
    pixels: &[u8],
    size: (usize, usize),
) -> PyResult<()> {
    let picture = FilePicture::stored(picture(pixels, size)?);
    py.detach(|| image_file::write_picture(&path, &picture))
        .map_err(|error| match &error {
            ImageFileError::Write { cause, .. } => os_error(cause, error.to_string(), &path),
            _ => value_error(error),
        })
}

/// Reads a picture file. Returns the pixels, four bytes each, and width and height.
#[pyfunction]
pub fn read_picture<'py>(
    py: Python<'py>,
    path: PathBuf,
) -> PyResult<(Bound<'py, PyByteArray>, usize, usize)> {
    let read = py.detach(|| image_file::read_picture(&path));
    let stored = read
        .map_err(|error| input_error(error, Path::new(&path)))?
        .to_stored();
    let pixels = PyByteArray::new(py, stored.pixels().as_flattened());
    Ok((pixels, stored.width(), stored.height()))
}
