//! PNG, by the crate `image`.

use std::format;
use std::io::Cursor;
use std::vec::Vec;

use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, Limits};

use super::{DecodeError, EncodeError, Format, MAX_PIXELS, checked_size};
use crate::picture::Picture8;

/// The first bytes of every PNG file (ISO/IEC 15948, 5.2).
pub(super) const SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];

/// Longest side that PNG can state (ISO/IEC 15948, 7.1).
const MAX_SIDE: usize = (1 << 31) - 1;

/// Returns the bytes of a PNG file: 8 bits of red, green, blue, alpha, as they are stored.
///
/// # Errors
/// If the picture has no pixels, or a side longer than 2³¹ − 1.
pub fn encode_png(picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (picture.width(), picture.height());
    let unfit = EncodeError { width, height };
    if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
        return Err(unfit);
    }
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Default, FilterType::Adaptive)
        .write_image(
            picture.texels().as_flattened(),
            width as u32,
            height as u32,
            ExtendedColorType::Rgba8,
        )
        .map_err(|_| unfit)?;
    Ok(bytes)
}

/// Reads the picture in a PNG file of any colour type, and whether the file has alpha.
pub(super) fn decode(bytes: &[u8]) -> Result<(Picture8, bool), DecodeError> {
    // The decoder is content once it has all pixels; a file without its end has been cut off all the same.
    if !has_end(bytes) {
        let problem = "it ends too early: expected an IEND chunk";
        return Err(DecodeError::malformed(Format::Png, problem));
    }
    let broken =
        |error: image::ImageError| DecodeError::malformed(Format::Png, &format!("{error}"));
    let mut limits = Limits::no_limits();
    // Four channels of 16 bits, and the same picture again in 8.
    limits.max_alloc = Some(12 * MAX_PIXELS);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let [width, height] = checked_size(Format::Png, width.into(), height.into())?;
    let has_alpha = decoder.color_type().has_alpha();
    let image = DynamicImage::from_decoder(decoder)
        .map_err(broken)?
        .into_rgba8();
    Picture8::from_texels(width, height, image.as_raw().as_chunks().0.to_vec())
        .map(|picture| (picture, has_alpha))
        .ok_or_else(|| {
            DecodeError::malformed(
                Format::Png,
                "the number of its pixels is not width × height",
            )
        })
}

/// True if the chunks lead to a complete IEND (ISO/IEC 15948, 5.3: length, type, data, CRC).
fn has_end(bytes: &[u8]) -> bool {
    let mut rest = &bytes[SIGNATURE.len()..];
    while let Some((&[a, b, c, d, ref kind @ ..], data)) = rest.split_first_chunk::<8>() {
        let Some(next) = data
            .get(u32::from_be_bytes([a, b, c, d]) as usize..)
            .and_then(|crc| crc.get(4..))
        else {
            return false;
        };
        if kind == b"IEND" {
            return true;
        }
        rest = next;
    }
    false
}
