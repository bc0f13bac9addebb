//! PNG, read and written by the crate `png`.

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

/// The gamma of linear samples, in the units of `gAMA`: 1/100000.
const LINEAR_GAMMA: u32 = 100_000;
/// The gamma 1/2.2, which writers of sRGB state beside or instead of `sRGB`.
const SRGB_GAMMA: u32 = 45_455;
/// How far a stated gamma may be from these two. Writers round 1/2.2 in several ways.
const GAMMA_ROUNDING: u32 = 50;

/// What the file states beside the pixels.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stated {
    /// Linear is written as a `gAMA` of 1, sRGB as `sRGB`. `None` writes no chunk.
    pub encoding: Option<Encoding>,
    /// The background in grey levels, written as `bKGD`.
    pub background: Option<[f64; 3]>,
    /// True if the file names this program as its software.
    pub software: bool,
}

/// Encodes a picture as the bytes of a PNG file: 8 bits of red, green, blue and straight alpha, as
/// they are stored. The file states no encoding, and most programs then show it as sRGB.
///
/// # Errors
/// If the picture has no pixels, or a side is longer than 2³¹ − 1.
pub fn encode_png(picture: &Picture8) -> Result<Vec<u8>, EncodeError> {
    let (width, height) = (picture.width(), picture.height());
    EncodeError::check(width, height)?;
    let mut bytes = Vec::new();
    match write(picture, Stated::default(), &mut bytes) {
        Ok(()) => Ok(bytes),
        Err(_) => Err(EncodeError { width, height }),
    }
}

/// How many bytes of compressed pixels a chunk has. The file is written while it is compressed, and
/// is never in memory as a whole.
const PIECE: usize = 1 << 17;

/// Writes a PNG file with the chunks that `stated` asks for.
///
/// # Errors
/// If the picture does not fit (the error holds an [`EncodeError`]), and any error of `out`.
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
            // Three samples of two bytes each, whatever the depth (11.3.4.1).
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

/// Decodes a PNG file of any colour type and depth. Of an animation, decodes the still picture.
pub(super) fn decode(bytes: &[u8]) -> Result<FilePicture, DecodeError> {
    // The decoder stops at the last pixel. A file without its end was cut off nevertheless.
    let Some(behind) = behind_end(bytes) else {
        let problem = "it ends too early: expected an IEND chunk";
        return Err(DecodeError::malformed(NAME, problem));
    };
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_ignore_text_chunk(true);
    let header = decoder.read_header_info().map_err(broken)?;
    let [width, height] = checked_size(NAME, header.width.into(), header.height.into())?;
    // Allow a few rows of four 16-bit channels, and room for profiles and other chunks.
    decoder.set_limits(Limits {
        bytes: 64 * width + (1 << 26),
    });
    // Palettes become colours, fewer than 8 bits become 8, and a transparent colour becomes alpha.
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
    if !behind.is_empty() {
        let note = format!("{} bytes behind its end are not read", behind.len());
        picture.notes.push(note);
    }
    Ok(picture)
}

/// Reads all rows. `sample` makes a sample from its bytes.
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
    if reader.info().interlaced {
        // Interlaced rows come in seven passes, so that all of them are complete only at the
        // end.
        let size = width * height * channels * BYTES;
        if !has_room::<u8>(size) {
            return Err(DecodeError::NoMemory { width, height });
        }
        // Zeroed memory costs nothing until a row is written to it, so a truncated file costs
        // little.
        let mut rows = vec![0; size];
        reader.next_frame(&mut rows).map_err(broken)?;
        add(&rows);
    } else {
        let mut row = vec![0; width * channels * BYTES];
        // The call after the last row checks the end of the data.
        while reader.read_row(&mut row).map_err(broken)?.is_some() {
            add(&row);
        }
    }
    let picture = Picture::from_pixels(width, height, pixels);
    let problem = "its pixels are not width × height";
    picture.ok_or_else(|| DecodeError::malformed(NAME, problem))
}

/// Stores what the chunks state beside the pixels, and adds notes about statements that are not
/// understood. The chunks take precedence in this order (PNG, third edition, 4.3): `cICP`, `iCCP`,
/// `sRGB`, `gAMA`.
fn state(picture: &mut FilePicture, reader: &Reader<Cursor<&[u8]>>, has_gamma_of_zero: bool) {
    let info = reader.info();
    if info.animation_control.is_some() {
        let note = "the file is an animation: this is its still picture";
        picture.notes.push(note.to_owned());
    }
    let gamma = info
        .gama_chunk
        .map(ScaledFloat::into_scaled)
        .or(has_gamma_of_zero.then_some(0));
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

/// Iterates over the chunks of a file, as kind and data. The last one may be cut off (ISO/IEC
/// 15948, 5.3: length, kind, data, CRC).
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

/// True if the first `gAMA` is 0, which has no meaning (PNG, third edition, 11.3.2.2). The decoder
/// drops it.
fn has_gamma_of_zero(bytes: &[u8]) -> bool {
    let mut before = chunks(bytes).take_while(|(kind, _)| *kind != b"IDAT");
    let gamma = before.find(|(kind, _)| *kind == b"gAMA");
    gamma.is_some_and(|(_, data)| data.starts_with(&[0; 4]))
}

/// Notes an orientation that Exif states (`eXIf`, PNG, third edition, 11.3.4.9). Viewers turn the
/// picture by it; comparisons do not.
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
        // 1 means as stored; other values have no meaning.
        _ => return,
    };
    let stated = format!("its Exif orientation {orientation} (to be shown {meaning})");
    let note = format!("{stated} is passed over: pixels count as they are stored");
    picture.notes.push(note);
}

/// Returns the orientation in Exif data: a TIFF header and a directory of 12-byte entries (TIFF
/// 6.0, 2; Exif 2.32, 4.6.4).
fn exif_orientation(data: &[u8]) -> Option<u32> {
    // Some writers leave JPEG's marker in front.
    let data = data.strip_prefix(b"Exif\0\0").unwrap_or(data);
    let is_little = match data.get(..4)? {
        b"II*\0" => true,
        b"MM\0*" => false,
        _ => return None,
    };
    let integer = |at: usize, size: usize| {
        let bytes = data.get(at..at.checked_add(size)?)?;
        let append = |value: u32, byte: &u8| value << 8 | u32::from(*byte);
        Some(if is_little {
            bytes.iter().rev().fold(0, append)
        } else {
            bytes.iter().fold(0, append)
        })
    };
    let directory = integer(4, 4)? as usize;
    let count = integer(directory, 2)? as usize;
    let mut entries = (0..count)
        .map(|entry| directory.saturating_add(2 + 12 * entry))
        .take_while(|entry| *entry < data.len());
    let entry = entries.find(|entry| integer(*entry, 2) == Some(ORIENTATION))?;
    // The value is a SHORT, or a LONG from some writers. Either begins where a 4-byte value does.
    match integer(entry + 2, 2)? {
        3 => integer(entry + 8, 2),
        4 => integer(entry + 8, 4),
        _ => None,
    }
}

/// The tag of the orientation in Exif.
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
    // The decoder words this in its own types.
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

/// Returns the bytes behind a complete IEND, if the chunks lead to one (ISO/IEC 15948, 5.3: length,
/// type, data, CRC).
fn behind_end(bytes: &[u8]) -> Option<&[u8]> {
    let mut rest = &bytes[SIGNATURE.len()..];
    while let Some((&[a, b, c, d, ref kind @ ..], data)) = rest.split_first_chunk::<8>() {
        let length = u32::from_be_bytes([a, b, c, d]) as usize;
        match data.get(length..).and_then(|crc| crc.get(4..)) {
            Some(behind) if kind == b"IEND" => return Some(behind),
            Some(next) => rest = next,
            None => return None,
        }
    }
    None
}
