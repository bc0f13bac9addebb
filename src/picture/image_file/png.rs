//! PNG, by the crate `image`.

use std::io::Cursor;
use std::string::ToString;
use std::vec::Vec;

use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, ImageError, Limits};

use super::{DecodeError, EncodeError, Format, MAX_PIXELS, checked_size};
use crate::picture::Picture8;

/// The first bytes of every PNG file (ISO/IEC 15948, 5.2).
pub(super) const SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];

/// Returns the bytes of a PNG file: 8 bits of red, green, blue, alpha, as they are stored.
///
/// # Errors
/// If the picture has no pixels, or a side longer than 2³¹ − 1.
pub fn encode_png(picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (picture.width(), picture.height());
    EncodeError::check(width, height)?;
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Default, FilterType::Adaptive)
        .write_image(
            picture.pixels().as_flattened(),
            width as u32,
            height as u32,
            ExtendedColorType::Rgba8,
        )
        .map_err(|_| EncodeError { width, height })?;
    Ok(bytes)
}

/// Reads the picture in a PNG file of any colour type; returns true beside it if the file has alpha.
pub(super) fn decode(bytes: &[u8]) -> Result<(Picture8, bool), DecodeError> {
    let malformed = |problem| DecodeError::malformed(Format::Png, problem);
    // The decoder is content once it has all pixels; a file without its end has been cut off all the same.
    if !has_end(bytes) {
        return Err(malformed("it ends too early: expected an IEND chunk"));
    }
    let broken = |error: ImageError| DecodeError::malformed(Format::Png, error.to_string());
    let mut limits = Limits::no_limits();
    // Four channels of 16 bits, and the same picture again in 8.
    limits.max_alloc = Some(12 * MAX_PIXELS);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let [width, height] = checked_size(Format::Png, width.into(), height.into())?;
    let has_alpha = decoder.color_type().has_alpha();
    let image = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let pixels = image.into_rgba8().as_raw().as_chunks().0.to_vec();
    let picture = Picture8::from_pixels(width, height, pixels);
    let picture =
        picture.ok_or_else(|| malformed("the number of its pixels is not width × height"))?;
    Ok((picture, has_alpha))
}

/// True if the chunks lead to a complete IEND (ISO/IEC 15948, 5.3: length, type, data, CRC).
fn has_end(bytes: &[u8]) -> bool {
    let mut rest = &bytes[SIGNATURE.len()..];
    while let Some((&[a, b, c, d, ref kind @ ..], data)) = rest.split_first_chunk::<8>() {
        let length = u32::from_be_bytes([a, b, c, d]) as usize;
        match data.get(length..).and_then(|crc| crc.get(4..)) {
            Some(_) if kind == b"IEND" => return true,
            Some(next) => rest = next,
            None => return false,
        }
    }
    false
}
