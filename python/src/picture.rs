//! Compares pictures, and reads and writes picture files.

use crate::errors::{input_error, memory_error, os_error, value_error};
use crate::pool::run;
use crate::scene::Pixels;
use fastphong::compare::metrics::difference_map as map;
use fastphong::compare::metrics::{SizeMismatch, compare, ssim};
use fastphong::memory::{check_size, pixels};
use fastphong::picture::image_file::{
    self, FilePicture, FilePixels, Format, ImageFileError, Pair, UsedEncoding,
};
use fastphong::picture::{Encoding, LevelRows, Levels, Picture8};
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyBytes, PyDict};
use std::path::PathBuf;
use std::sync::Arc;

/// Returns the encoding called `name`.
fn encoding(name: &str) -> PyResult<Encoding> {
    let known = Encoding::ALL.into_iter().find(|known| known.name() == name);
    known.ok_or_else(|| value_error(format!("`{name}` is no encoding: expected linear or srgb")))
}

/// The contents of a picture file, or of an array.
#[pyclass(frozen, module = "fastphong._fastphong")]
pub struct Image {
    picture: Arc<FilePicture>,
}

#[pymethods]
impl Image {
    /// Makes a picture of pixels, four bytes each.
    #[new]
    fn new(
        pixels: &[u8],
        size: (usize, usize),
        encoding: Option<&str>,
        background: Option<[f64; 3]>,
        has_alpha: bool,
    ) -> PyResult<Image> {
        let pixels = pixels.as_chunks().0.to_vec();
        let stored = Picture8::from_pixels(size.0, size.1, pixels);
        let stored = stored.ok_or_else(|| value_error("expected four bytes for each pixel"))?;
        let mut picture = FilePicture::stored(stored);
        picture.encoding = encoding.map(self::encoding).transpose()?;
        picture.background = background;
        picture.has_alpha = has_alpha;
        let picture = Arc::new(picture);
        Ok(Image { picture })
    }

    /// Reads a picture file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Image> {
        let picture = run(py, move || {
            let read = image_file::read_picture(&path);
            read.map_err(|error| input_error(error, &path))
        })??;
        let picture = Arc::new(picture);
        Ok(Image { picture })
    }

    /// Returns the picture in 8 bits.
    fn pixels<'py>(&self, py: Python<'py>) -> PyResult<Pixels<'py>> {
        let picture = self.picture.clone();
        let stored = run(py, move || picture.to_stored())?;
        let own = &self.picture;
        Ok((
            PyByteArray::new(py, stored.pixels().as_flattened()),
            stored.width(),
            stored.height(),
            own.encoding.map(Encoding::name),
            own.background,
        ))
    }

    /// Returns what a reader should know about the file.
    #[getter]
    fn notes(&self) -> Vec<String> {
        let mut notes = self.picture.notes.clone();
        if let FilePixels::Linear(picture) = &self.picture.pixels {
            let channels = picture.pixels().as_flattened().iter();
            let lost = channels.filter(|c| !(0.0..=1.0).contains(*c)).count();
            if lost > 0 {
                let beyond = "channels are below 0, over 1 or not a number";
                notes.push(format!("{lost} {beyond}: they are clamped in 8 bits"));
            }
        }
        notes
    }

    /// Returns the remarks of the file alone.
    #[getter]
    fn file_notes(&self) -> Vec<String> {
        self.picture.notes.clone()
    }

    /// Returns the name of the encoding, if the picture states one.
    #[getter]
    fn encoding(&self) -> Option<&'static str> {
        self.picture.encoding.map(Encoding::name)
    }

    /// Returns width and height.
    #[getter]
    fn size(&self) -> [usize; 2] {
        self.picture.size()
    }

    /// Returns the picture as the bytes of a PNG file.
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let picture = self.picture.clone();
        let encoded = run(py, move || picture.encode(Format::Png))?;
        Ok(PyBytes::new(py, &encoded.map_err(value_error)?))
    }

    /// Writes a picture file in the format that the ending of `path` names.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let mut picture = FilePicture::clone(&self.picture);
        run(py, move || {
            if Format::of_path(&path).is_ok_and(|format| format != Format::Png) {
                // Pixels that nothing covers are black, as nothing else is known about them.
                picture.background.get_or_insert_default();
            }
            image_file::write_picture(&path, &picture).map_err(|error| match &error {
                ImageFileError::Write { cause, .. } => os_error(cause, error.to_string(), &path),
                _ => value_error(error),
            })
        })?
    }
}

/// Two pictures that are compared.
#[pyclass(frozen, module = "fastphong._fastphong")]
pub struct Comparison {
    pictures: [Arc<FilePicture>; 2],
    assumed: Option<Encoding>,
}

/// Runs `work` on a pair of pictures.
fn with_pair<R: Send + 'static>(
    py: Python<'_>,
    own: &Comparison,
    work: impl FnOnce(&Pair<'_>) -> R + Send + 'static,
) -> PyResult<R> {
    let (pictures, assumed) = (own.pictures.clone(), own.assumed);
    run(py, move || {
        work(&Pair::new(&pictures[0], &pictures[1], assumed))
    })
}

#[pymethods]
impl Comparison {
    /// Pairs two pictures. `assumed` is the encoding of pictures that state none.
    #[new]
    fn new(reference: &Image, actual: &Image, assumed: Option<&str>) -> PyResult<Comparison> {
        Ok(Comparison {
            pictures: [reference, actual].map(|image| image.picture.clone()),
            assumed: assumed.map(encoding).transpose()?,
        })
    }

    /// Returns the difference, in grey levels.
    fn difference<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = with_pair(py, self, |pair| {
            let [reference, actual] = pair.compared();
            let mut found = compare(&reference, &actual)?;
            if !found.equal || pair.has_two_encodings() {
                let [reference, actual] = pair.displayed();
                found.ssim = ssim(&reference, &actual)?;
            }
            Ok((found, pair.compared_encoding()))
        })?;
        let (found, encoding) = found.map_err(|error: SizeMismatch| value_error(error))?;
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
        dict.set_item("not_finite", found.not_finite_differing)?;
        dict.set_item("worst", found.worst)?;
        dict.set_item("encoding", encoding.name())?;
        Ok(dict)
    }

    /// Returns what the caller should know about the comparison. `names` are those of the pictures.
    fn notes(&self, py: Python<'_>, names: [String; 2]) -> PyResult<Vec<String>> {
        with_pair(py, self, move |pair| {
            let both = || names.each_ref().map(String::as_str);
            let alpha = pair.alpha_text(both());
            // Everyone takes floats as linear. For bytes, sRGB is a guess.
            let is_guess = |used: &UsedEncoding| !used.is_stated && used.encoding == Encoding::Srgb;
            let is_assumed = pair.encodings().iter().any(is_guess);
            let text = || pair.encodings_text(both()).trim_end().to_owned();
            let encodings = (is_assumed && pair.has_two_encodings()).then(text);
            alpha.into_iter().chain(encodings).collect()
        })
    }

    /// Returns the levels of a pixel in both pictures, as they are compared.
    fn at(&self, py: Python<'_>, x: usize, y: usize) -> PyResult<[[f64; 4]; 2]> {
        with_pair(py, self, move |pair| {
            let mut row = vec![Levels([0.0; 4]); pair.common_size()[0]];
            pair.compared().map(|picture| {
                picture.level_row(y, &mut row);
                row[x].0
            })
        })
    }

    /// Returns a map of the difference. A pixel is yellow at `scale` grey levels, magenta beyond,
    /// and white where only one picture covers it.
    fn map<'py>(&self, py: Python<'py>, scale: f32) -> PyResult<Pixels<'py>> {
        let drawn = with_pair(py, self, move |pair| {
            let size = pair.common_size();
            check_size(size, "the map", 4 * pixels(size)).map_err(memory_error)?;
            let [reference, actual] = pair.compared();
            map(&reference, &actual, scale).map_err(value_error)
        })??;
        Ok((
            PyByteArray::new(py, drawn.pixels().as_flattened()),
            drawn.width(),
            drawn.height(),
            Some(Encoding::Srgb.name()),
            None,
        ))
    }
}
