//! Pictures as small PNG files and data URIs.
//!
//! A page holds a hundred pictures, so that each is written in the way that makes it smallest: with a palette where 256
//! colours suffice, and, where a picture hardly differs from the reference, as what differs, to be laid over it.

use crate::picture::Picture8;
use crate::picture::image_file::EncodeError;
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};

/// A stored colour with its alpha.
type Texel = [u8; 4];

/// What stands in an overlay where the picture below shows.
const SEE_THROUGH: Texel = [0; 4];

/// The smallest PNG file of `picture`, which tells nothing of what is covered: all texels are opaque.
///
/// # Errors
/// If the picture has no pixels, or more than the format can count.
pub(super) fn opaque(picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    smallest(&picture.map(solid))
}

/// The smallest PNG file of `picture` as what is to be laid over `below`: texels that are the same are left out.
///
/// # Errors
/// As [`opaque`].
pub(super) fn overlay(below: &Picture8, picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    let mut over = picture.map(solid);
    for (texel, below) in over.texels_mut().iter_mut().zip(below.texels()) {
        if *texel == solid(*below) {
            *texel = SEE_THROUGH;
        }
    }
    smallest(&over)
}

/// The bytes of a PNG file as the address of an `<img>`.
pub(super) fn data_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

/// `picture` at a part of its size: every texel the mean of a square of `factor` × `factor`, cut off at the edges.
pub(super) fn shrunk(picture: &Picture8, factor: usize) -> Picture8 {
    let factor = factor.max(1);
    let (width, height) = (
        picture.width().div_ceil(factor),
        picture.height().div_ceil(factor),
    );
    let mut small = Picture8::new(width, height, SEE_THROUGH);
    for y in 0..height {
        let rows = y * factor..picture.height().min((y + 1) * factor);
        for (x, out) in small.row_mut(y).iter_mut().enumerate() {
            let columns = x * factor..picture.width().min((x + 1) * factor);
            let texels = rows
                .clone()
                .flat_map(|row| &picture.row(row)[columns.clone()]);
            let mut sum = [0usize; 4];
            for texel in texels {
                for (sum, channel) in sum.iter_mut().zip(solid(*texel)) {
                    *sum += usize::from(channel);
                }
            }
            let count = rows.len() * columns.len();
            *out = sum.map(|sum| ((sum + count / 2) / count) as u8);
        }
    }
    small
}

fn solid([r, g, b, _]: Texel) -> Texel {
    [r, g, b, 255]
}

fn smallest(picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    let is_opaque = picture.texels().iter().all(|texel| texel[3] == 255);
    let mut attempts = Vec::new();
    if let Some((palette, indices)) = with_palette(picture) {
        attempts.push(Attempt {
            texels: indices,
            kind: Kind::Palette(palette),
            filter: Filter::NoFilter,
        });
    }
    let kind = || if is_opaque { Kind::Rgb } else { Kind::Rgba };
    let channels = if is_opaque { 3 } else { 4 };
    let texels: Vec<u8> = picture
        .texels()
        .iter()
        .flat_map(|texel| &texel[..channels])
        .copied()
        .collect();
    // Smooth shading is best guessed from its neighbours, flat areas and repeated colours are not.
    for filter in [
        Filter::Adaptive,
        Filter::Paeth,
        Filter::Avg,
        Filter::NoFilter,
    ] {
        attempts.push(Attempt {
            texels: texels.clone(),
            kind: kind(),
            filter,
        });
    }
    let unfit = EncodeError {
        width: picture.width(),
        height: picture.height(),
    };
    let files = attempts.iter().map(|attempt| attempt.encode(picture));
    let files = files.collect::<Result<Vec<_>, _>>().map_err(|_| unfit)?;
    files.into_iter().min_by_key(Vec::len).ok_or(unfit)
}

/// The colours of `picture` and the place of each texel among them, if there are 256 at most.
fn with_palette(picture: &Picture8) -> Option<(Vec<Texel>, Vec<u8>)> {
    let mut places: BTreeMap<Texel, u8> = BTreeMap::new();
    let mut palette = Vec::new();
    let mut indices = Vec::with_capacity(picture.texels().len());
    for texel in picture.texels() {
        let place = match places.get(texel) {
            Some(place) => *place,
            None => {
                let place = u8::try_from(palette.len()).ok()?;
                palette.push(*texel);
                places.insert(*texel, place);
                place
            }
        };
        indices.push(place);
    }
    Some((palette, indices))
}

enum Kind {
    Palette(Vec<Texel>),
    Rgb,
    Rgba,
}

/// One way of writing a picture.
struct Attempt {
    texels: Vec<u8>,
    kind: Kind,
    filter: Filter,
}

impl Attempt {
    fn encode(&self, picture: &Picture8) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        // A side that is too long becomes 0, which is refused as well.
        let side = |side: usize| u32::try_from(side).unwrap_or(0);
        let mut encoder = Encoder::new(&mut bytes, side(picture.width()), side(picture.height()));
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::High);
        encoder.set_filter(self.filter);
        match &self.kind {
            Kind::Palette(palette) => {
                encoder.set_color(ColorType::Indexed);
                encoder.set_palette(
                    palette
                        .iter()
                        .flat_map(|texel| &texel[..3])
                        .copied()
                        .collect::<Vec<u8>>(),
                );
                if palette.iter().any(|texel| texel[3] < 255) {
                    encoder.set_trns(palette.iter().map(|texel| texel[3]).collect::<Vec<u8>>());
                }
            }
            Kind::Rgb => encoder.set_color(ColorType::Rgb),
            Kind::Rgba => encoder.set_color(ColorType::Rgba),
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.texels)?;
        writer.finish()?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::image_file::{FileTexels, decode_picture};

    fn decoded(png: &[u8]) -> Picture8 {
        match decode_picture(png).unwrap().texels {
            FileTexels::Stored(picture) => picture,
            FileTexels::Linear(_) => unreachable!("PNG holds grey levels"),
        }
    }

    /// `colours` different colours, in no order that a filter could guess.
    fn colourful(colours: usize) -> Picture8 {
        // Two channels tell colours apart, the third is scattered by a multiplier of Knuth's (2³² divided by the golden
        // ratio).
        let texel = |i: usize| {
            let colour = i % colours;
            let scattered = (colour as u32).wrapping_mul(2_654_435_769) >> 24;
            [colour as u8, (colour >> 8) as u8, scattered as u8, 255]
        };
        Picture8::from_texels(40, 30, (0..1200).map(texel).collect()).unwrap()
    }

    #[test]
    fn pictures_come_back_whatever_the_way_of_writing_them() {
        for colours in [1, 2, 255, 256, 257, 1200] {
            let picture = colourful(colours);
            assert_eq!(
                decoded(&opaque(&picture).unwrap()),
                picture,
                "{colours} colours"
            );
        }
        assert!(with_palette(&colourful(256)).is_some() && with_palette(&colourful(257)).is_none());
    }

    #[test]
    fn coverage_is_not_kept_and_colours_are() {
        let transparent = Picture8::new(3, 2, [9, 8, 7, 0]);
        assert_eq!(
            decoded(&opaque(&transparent).unwrap()),
            Picture8::new(3, 2, [9, 8, 7, 255])
        );
    }

    #[test]
    fn an_overlay_laid_over_the_reference_is_the_picture() {
        for colours in [100, 1000] {
            let below = colourful(colours);
            let mut picture = below.clone();
            for (i, texel) in picture
                .texels_mut()
                .iter_mut()
                .enumerate()
                .filter(|(i, _)| i % 5 == 0)
            {
                *texel = [(i % 251) as u8, 200, (i / 251) as u8, 255];
            }
            let over = decoded(&overlay(&below, &picture).unwrap());
            let laid = over
                .texels()
                .iter()
                .zip(below.texels())
                .map(|(o, b)| if o[3] == 255 { *o } else { *b });
            assert_eq!(
                Picture8::from_texels(40, 30, laid.collect()).unwrap(),
                picture
            );
            assert!(over.texels().iter().filter(|texel| texel[3] == 0).count() >= 1200 * 4 / 5);
        }
    }

    #[test]
    fn what_hardly_differs_is_smaller_as_an_overlay() {
        let below = colourful(1000);
        let mut picture = below.clone();
        picture.row_mut(3)[3] = [1, 2, 3, 255];
        assert!(2 * overlay(&below, &picture).unwrap().len() < opaque(&picture).unwrap().len());
    }

    #[test]
    fn pictures_without_pixels_are_errors() {
        let empty = Picture8::new(0, 5, [0; 4]);
        assert_eq!(
            opaque(&empty),
            Err(EncodeError {
                width: 0,
                height: 5
            })
        );
    }

    #[test]
    fn shrinking_takes_means() {
        let texels = [
            [0, 10, 100, 255],
            [2, 10, 101, 255],
            [4, 10, 9, 0],
            [6, 10, 0, 255],
            [8, 10, 0, 255],
            [9, 11, 12, 9],
        ];
        let picture = Picture8::from_texels(3, 2, texels.into()).unwrap();
        // (0 + 2 + 6 + 8) / 4, (100 + 101) / 4 = 50.25; and the column that is left over.
        let small = [[4, 10, 50, 255], [7, 11, 11, 255]];
        assert_eq!(
            shrunk(&picture, 2),
            Picture8::from_texels(2, 1, small.into()).unwrap()
        );
        assert_eq!(shrunk(&picture, 1), picture.map(solid));
        assert_eq!(shrunk(&picture, 9).texels().len(), 1);
    }

    #[test]
    fn addresses_hold_the_file() {
        assert_eq!(data_uri(&[0xFB, 0xFF, 0x00]), "data:image/png;base64,+/8A");
    }
}
