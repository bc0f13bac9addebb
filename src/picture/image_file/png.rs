//! PNG, by the crate `png`.

use std::borrow::ToOwned;
use std::format;
use std::io::{self, Cursor, Write};
use std::string::{String, ToString};
use std::vec;
use std::vec::Vec;

use png::{
    BitDepth, ColorType, Compression, Decoder, Encoder, EncodingError, Filter, Limits, Reader,
    ScaledFloat, SrgbRenderingIntent, Transformations, chunk,
};

use super::{DecodeError, EncodeError, FilePicture, FilePixels, checked_size, has_room, reserved};
use crate::picture::{Encoding, Picture, Picture8};

/// The first bytes of every PNG file (ISO/IEC 15948, 5.2).
pub(super) const SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];

/// The name of the format in messages.
const NAME: &str = "PNG";

/// The gamma of linear samples, as `gAMA` counts it: in units of 1/100000.
const LINEAR_GAMMA: u32 = 100_000;
/// The gamma that writers of sRGB state beside it, or instead: 1/2.2.
const SRGB_GAMMA: u32 = 45_455;
/// How far a stated gamma may be from those two: writers round 1/2.2 in several ways.
const GAMMA_ROUNDING: u32 = 50;

/// The facts about a picture that its file states beside the pixels.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stated {
    /// Linear becomes `gAMA` 1, sRGB `sRGB`; else no chunk is written.
    pub encoding: Option<Encoding>,
    /// The background, in grey levels, for `bKGD`.
    pub background: Option<[f64; 3]>,
    /// True if the file names this program as its software.
    pub software: bool,
}

/// Returns the bytes of a PNG file: 8 bits of red, green, blue, straight alpha, as they are stored. It states no encoding, so
/// that most programs show it as sRGB.
///
/// # Errors
/// If the picture has no pixels, or a side longer than 2³¹ − 1.
pub fn encode_png(picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (picture.width(), picture.height());
    EncodeError::check(width, height)?;
    let mut bytes = Vec::new();
    match write(picture, Stated::default(), &mut bytes) {
        Ok(()) => Ok(bytes),
        Err(_) => Err(EncodeError { width, height }),
    }
}

/// Bytes of compressed pixels in a chunk: a file is written as it is compressed, and is never in memory as a whole.
const PIECE: usize = 1 << 17;

/// Writes a PNG file with the chunks that state more about it.
///
/// # Errors
/// If the picture does not fit ([`EncodeError`], inside), and those of `out`.
pub(super) fn write(picture: &Picture8, stated: Stated, out: impl Write) -> io::Result<()> {
    let (width, height) = (picture.width(), picture.height());
    EncodeError::check(width, height).map_err(io::Error::other)?;
    let write = || -> Result<(), EncodingError> {
        let mut encoder = Encoder::new(out, width as u32, height as u32);
        encoder.set_color(ColorType::Rgba);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::Balanced);
        encoder.set_filter(Filter::Adaptive);
        match stated.encoding {
            Some(Encoding::Srgb) => encoder.set_source_srgb(SrgbRenderingIntent::Perceptual),
            Some(Encoding::Linear) => {
                encoder.set_source_gamma(ScaledFloat::from_scaled(LINEAR_GAMMA));
            }
            None => {}
        }
        if stated.software {
            encoder.add_text_chunk("Software".into(), env!("CARGO_PKG_NAME").into())?;
        }
        let mut writer = encoder.write_header()?;
        if let Some(background) = stated.background {
            // Three samples of two bytes, whatever the depth (11.3.4.1).
            let levels = background.map(|level| [0, (level + 0.5) as u8]);
            writer.write_chunk(chunk::bKGD, levels.as_flattened())?;
        }
        let mut pixels = writer.stream_writer_with_size(PIECE)?;
        pixels.write_all(picture.pixels().as_flattened())?;
        pixels.finish()?;
        writer.finish()
    };
    write().map_err(|error| match error {
        EncodingError::IoError(error) => error,
        _ => io::Error::other(EncodeError { width, height }),
    })
}

/// Reads the picture in a PNG file of any colour type and depth; of an animation the still picture that stands for it.
pub(super) fn decode(bytes: &[u8]) -> Result<FilePicture, DecodeError> {
    // The decoder is content once it has all pixels; a file without its end has been cut off all the same.
    if !has_end(bytes) {
        let problem = "it ends too early: expected an IEND chunk";
        return Err(DecodeError::malformed(NAME, problem));
    }
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_ignore_text_chunk(true);
    let header = decoder.read_header_info().map_err(broken)?;
    let [width, height] = checked_size(NAME, header.width.into(), header.height.into())?;
    // A few rows of four channels of 16 bits, and what profiles and other chunks may take.
    decoder.set_limits(Limits {
        bytes: 64 * width + (1 << 26),
    });
    // Palettes become colours, few bits 8, and a transparent colour becomes alpha.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(broken)?;
    let (colour, depth) = reader.output_color_type();
    let has_alpha = matches!(colour, ColorType::Rgba | ColorType::GrayscaleAlpha);
    let size = [width, height];
    let pixels = match depth {
        BitDepth::Sixteen => FilePixels::Deep {
            picture: pixels(&mut reader, size, |[high, low]| {
                u16::from_be_bytes([high, low])
            })?,
            maximum: u16::MAX,
        },
        _ => FilePixels::Stored(pixels(&mut reader, size, |[level]| level)?),
    };
    let mut picture = FilePicture {
        has_alpha,
        ..FilePicture::of_pixels(pixels)
    };
    state(&mut picture, &reader, has_gamma_of_zero(bytes));
    note_orientation(&mut picture, bytes);
    Ok(picture)
}

/// Reads all rows; `sample` makes a sample of its bytes.
fn pixels<const BYTES: usize, S: Copy + Default>(
    reader: &mut Reader<Cursor<&[u8]>>,
    [width, height]: [usize; 2],
    sample: impl Fn([u8; BYTES]) -> S,
) -> Result<Picture<[S; 4]>, DecodeError> {
    let channels = reader.output_color_type().0.samples();
    let full = sample([0xff; BYTES]);
    let mut pixels = reserved(width, height)?;
    let mut add = |row: &[u8]| {
        let samples = row.as_chunks().0;
        pixels.extend(samples.chunks_exact(channels).map(|samples| {
            let at = |channel: usize| sample(samples[channel]);
            match channels {
                1 => [at(0), at(0), at(0), full],
                2 => [at(0), at(0), at(0), at(1)],
                3 => [at(0), at(1), at(2), full],
                _ => [at(0), at(1), at(2), at(3)],
            }
        }));
    };
    match reader.info().interlaced {
        true => {
            // Rows come in seven passes, so that all are there only at the end.
            let size = width * height * channels * BYTES;
            if !has_room::<u8>(size) {
                return Err(DecodeError::NoMemory { width, height });
            }
            // Zeroed memory is untouched until rows are written to it: a file that is cut off costs nothing.
            let mut rows = vec![0; size];
            reader.next_frame(&mut rows).map_err(broken)?;
            add(&rows);
        }
        false => {
            let mut row = vec![0; width * channels * BYTES];
            // The call after the last row checks the end of the data.
            while reader.read_row(&mut row).map_err(broken)?.is_some() {
                add(&row);
            }
        }
    }
    let picture = Picture::from_pixels(width, height, pixels);
    let problem = "the number of its pixels is not width × height";
    picture.ok_or_else(|| DecodeError::malformed(NAME, problem))
}

/// Sets what the chunks say beside the pixels, and notes what of it is not understood. The order is that of the
/// specification (PNG, third edition, 4.3): `cICP`, `iCCP`, `sRGB`, `gAMA`.
fn state(picture: &mut FilePicture, reader: &Reader<Cursor<&[u8]>>, has_gamma_of_zero: bool) {
    let info = reader.info();
    if info.animation_control.is_some() {
        let note = "the file is an animation: this is its still picture";
        picture.notes.push(note.to_owned());
    }
    let gamma = info.gama_chunk.map(ScaledFloat::into_scaled);
    let gamma = gamma.or(has_gamma_of_zero.then_some(0));
    let by_gamma = gamma.and_then(|gamma| match gamma {
        _ if gamma.abs_diff(LINEAR_GAMMA) <= GAMMA_ROUNDING => Some(Encoding::Linear),
        _ if gamma.abs_diff(SRGB_GAMMA) <= GAMMA_ROUNDING => Some(Encoding::Srgb),
        _ => None,
    });
    let mut not_understood = None;
    picture.encoding = if let Some(points) = info.coding_independent_code_points {
        let by_points = match points.transfer_function {
            // ITU-T H.273, table 3.
            8 => Some(Encoding::Linear),
            13 => Some(Encoding::Srgb),
            _ => None,
        };
        if by_points.is_none() || points.color_primaries != 1 || !points.is_video_full_range_image {
            let [primaries, transfer] = [points.color_primaries, points.transfer_function];
            let found = format!("colour space cICP {primaries}-{transfer}");
            not_understood = Some(found);
        }
        by_points
    } else if info.icc_profile.is_some() {
        not_understood = Some("colour profile (iCCP)".to_owned());
        by_gamma
    } else if info.srgb.is_some() {
        Some(Encoding::Srgb)
    } else {
        if let (Some(gamma), None) = (gamma, by_gamma) {
            let gamma = f64::from(gamma) / f64::from(LINEAR_GAMMA);
            not_understood = Some(format!("gamma of {gamma} (gAMA)"));
        }
        by_gamma
    };
    if let Some(found) = not_understood {
        let counts = match picture.encoding {
            Some(encoding) => format!("its samples count as {}", encoding.name()),
            None => "it is passed over".to_owned(),
        };
        let note = format!("its {found} is not understood: {counts}");
        picture.notes.push(note);
    }
    picture.background = info
        .bkgd
        .as_ref()
        .and_then(|samples| background(samples, reader));
}

/// Walks along the chunks of a file: kind and data, which end where the file does (ISO/IEC 15948, 5.3: length, kind, data, CRC).
fn chunks(bytes: &[u8]) -> impl Iterator<Item = (&[u8; 4], &[u8])> {
    let mut rest = bytes.get(SIGNATURE.len()..).unwrap_or_default();
    core::iter::from_fn(move || {
        let (length, after) = rest.split_first_chunk::<4>()?;
        let (kind, data) = after.split_first_chunk::<4>()?;
        let length = u32::from_be_bytes(*length) as usize;
        rest = data.get(length.saturating_add(4)..).unwrap_or_default();
        Some((kind, data.get(..length).unwrap_or(data)))
    })
}

/// True if the first `gAMA` is 0, which means nothing (PNG, third edition, 11.3.2.2). The decoder drops it.
fn has_gamma_of_zero(bytes: &[u8]) -> bool {
    let mut before = chunks(bytes).take_while(|(kind, _)| *kind != b"IDAT");
    let gamma = before.find(|(kind, _)| *kind == b"gAMA");
    gamma.is_some_and(|(_, data)| data.starts_with(&[0; 4]))
}

/// Notes an orientation that Exif states (`eXIf`, PNG, third edition, 11.3.4.9): viewers turn the picture by it, and comparisons do
/// not.
fn note_orientation(picture: &mut FilePicture, bytes: &[u8]) {
    let stated = chunks(bytes).filter(|(kind, _)| *kind == b"eXIf");
    let Some(orientation) = stated.filter_map(|(_, data)| exif_orientation(data)).next() else {
        return;
    };
    let meaning = match orientation {
        2 => "mirrored left to right",
        3 => "turned by 180 degrees",
        4 => "mirrored top to bottom",
        5 => "mirrored left to right and turned anticlockwise by 90 degrees",
        6 => "turned clockwise by 90 degrees",
        7 => "mirrored left to right and turned clockwise by 90 degrees",
        8 => "turned anticlockwise by 90 degrees",
        // 1 is as stored, and others mean nothing.
        _ => return,
    };
    let stated = format!("its Exif orientation {orientation} (to be shown {meaning})");
    let note = format!("{stated} is passed over: pixels count as they are stored");
    picture.notes.push(note);
}

/// Returns the orientation that Exif data state: a TIFF header and a directory of entries of 12 bytes (TIFF 6.0, 2; Exif 2.32, 4.6.4).
fn exif_orientation(data: &[u8]) -> Option<u32> {
    // Some writers leave the mark of JPEG before it.
    let data = data.strip_prefix(b"Exif\0\0").unwrap_or(data);
    let is_little = match data.get(..4)? {
        b"II*\0" => true,
        b"MM\0*" => false,
        _ => return None,
    };
    let number = |at: usize, size: usize| {
        let bytes = data.get(at..at.checked_add(size)?)?;
        let append = |number: u32, byte: &u8| number << 8 | u32::from(*byte);
        Some(match is_little {
            true => bytes.iter().rev().fold(0, append),
            false => bytes.iter().fold(0, append),
        })
    };
    let directory = number(4, 4)? as usize;
    let count = number(directory, 2)? as usize;
    let entries = (0..count).map(|entry| directory.saturating_add(2 + 12 * entry));
    let mut entries = entries.take_while(|entry| *entry < data.len());
    let entry = entries.find(|entry| number(*entry, 2) == Some(ORIENTATION))?;
    // A SHORT, or from some writers a LONG: either begins where a value of 4 bytes does.
    match number(entry + 2, 2)? {
        3 => number(entry + 8, 2),
        4 => number(entry + 8, 4),
        _ => None,
    }
}

/// The tag of the orientation.
const ORIENTATION: u32 = 0x0112;

/// Returns the background that `bKGD` states, in grey levels.
fn background(samples: &[u8], reader: &Reader<Cursor<&[u8]>>) -> Option<[f64; 3]> {
    let info = reader.info();
    if let (ColorType::Indexed, &[index]) = (info.color_type, samples) {
        let colour = info
            .palette
            .as_ref()?
            .as_chunks::<3>()
            .0
            .get(usize::from(index))?;
        return Some(colour.map(f64::from));
    }
    let maximum = f64::from((1u32 << info.bit_depth as u32) - 1);
    let level = |pair: &[u8; 2]| 255.0 * f64::from(u16::from_be_bytes(*pair)) / maximum;
    match samples.as_chunks().0 {
        [grey] => Some([level(grey); 3]),
        [r, g, b] => Some([level(r), level(g), level(b)]),
        _ => None,
    }
}

fn broken(error: png::DecodingError) -> DecodeError {
    let problem: String = match error {
        png::DecodingError::LimitsExceeded => {
            "it needs more memory than its size explains: expected smaller chunks".into()
        }
        error => error.to_string(),
    };
    // The decoder says this in its own types.
    let problem = match problem.strip_prefix("CRC error: ") {
        Some(found) => {
            let named = found.split_once("type: ").unwrap_or_default().1;
            let chunk = named.split(',').next().unwrap_or_default();
            format!("it is damaged: the checksum of its chunk {chunk} is wrong")
        }
        None => problem,
    };
    DecodeError::malformed(NAME, problem)
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
