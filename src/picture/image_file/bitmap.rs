//! BMP and Targa, read by the crate `image`. Authors of rasterizers write these formats, because
//! writing them needs no library.

use std::io::Cursor;
use std::string::ToString;

use image::codecs::bmp::BmpDecoder;
use image::codecs::tga::TgaDecoder;
use image::{DynamicImage, ImageDecoder, ImageResult, Limits};

use super::{DecodeError, FilePicture, FilePixels, MAX_PIXELS, checked_size, has_room};
use crate::picture::Picture8;

/// A format that this module reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bitmap {
    /// Windows bitmap. Its files begin with `BM`.
    Bmp,
    /// Truevision Targa. Its files have no signature, so that only the ending of the name
    /// identifies them.
    Targa,
}

impl Bitmap {
    /// The first bytes of every BMP file.
    pub const BMP_SIGNATURE: [u8; 2] = *b"BM";

    fn name(self) -> &'static str {
        match self {
            Bitmap::Bmp => "BMP",
            Bitmap::Targa => "Targa",
        }
    }

    /// Decodes the bytes of a file. All of these files have 8 bits per channel.
    pub fn decode(self, bytes: &[u8]) -> Result<FilePicture, DecodeError> {
        match self {
            Bitmap::Bmp => self.picture(BmpDecoder::new(Cursor::new(bytes))),
            Bitmap::Targa => self.picture(TgaDecoder::new(Cursor::new(bytes))),
        }
    }

    fn picture(self, opened: ImageResult<impl ImageDecoder>) -> Result<FilePicture, DecodeError> {
        let broken =
            |error: image::ImageError| DecodeError::malformed(self.name(), error.to_string());
        let mut decoder = opened.map_err(broken)?;
        let (width, height) = decoder.dimensions();
        let [width, height] = checked_size(self.name(), width.into(), height.into())?;
        let mut limits = Limits::no_limits();
        // Four bytes per pixel as the file stores them, and four more when they are sorted.
        limits.max_alloc = Some(8 * MAX_PIXELS);
        decoder.set_limits(limits).map_err(broken)?;
        let has_alpha = decoder.color_type().has_alpha();
        // Three copies exist at a time: as stored, sorted, and as returned. Ask for the memory
        // first, because the crate would abort the program.
        if !has_room::<[[u8; 4]; 3]>(width * height) {
            return Err(DecodeError::NoMemory { width, height });
        }
        let image = DynamicImage::from_decoder(decoder).map_err(broken)?;
        let pixels = image.into_rgba8().as_raw().as_chunks().0.to_vec();
        let picture = Picture8::from_pixels(width, height, pixels);
        let wrong_count = || {
            let problem = "its pixels are not width × height";
            DecodeError::malformed(self.name(), problem)
        };
        Ok(FilePicture {
            has_alpha,
            ..FilePicture::of_pixels(FilePixels::Stored(picture.ok_or_else(wrong_count)?))
        })
    }
}
