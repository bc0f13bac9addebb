use std::format;
use std::string::{String, ToString};
use std::vec;

use super::*;
use crate::compare::metrics::compare;
use crate::picture::LevelRows;

/// Returns a picture with every byte value, and with uncovered pixels.
fn stored() -> Picture8 {
    let pixel = |i: usize| {
        [
            i as u8,
            (i * 7) as u8,
            (255 - i) as u8,
            if i.is_multiple_of(5) { 0 } else { 255 },
        ]
    };
    Picture8::from_pixels(32, 8, (0..256).map(pixel).collect()).unwrap()
}

/// Returns a picture with values that need all bits of a float.
fn linear() -> LinearPicture {
    let pixel = |i: usize| {
        [
            i as f32 / 7.0,
            -1.0e-30 * i as f32,
            f32::MAX / (1.0 + i as f32),
            1.0,
        ]
    };
    LinearPicture::from_pixels(5, 3, (0..15).map(pixel).collect()).unwrap()
}

fn encode_ppm(picture: &Picture8) -> io::Result<Vec<u8>> {
    FilePicture::stored(picture.clone()).encode(Format::Ppm)
}

fn encode_pfm(picture: &LinearPicture) -> io::Result<Vec<u8>> {
    FilePicture::linear(picture.clone()).encode(Format::Pfm)
}

fn opaque(picture: &Picture8) -> Picture8 {
    picture.map(|[r, g, b, _]| [r, g, b, 255])
}

fn message(bytes: &[u8]) -> String {
    decode_picture(bytes).unwrap_err().to_string()
}

#[test]
fn the_ending_names_the_format() {
    for (path, format) in [
        ("a.png", Format::Png),
        ("dir.x/b.PPM", Format::Ppm),
        ("c.d.Pfm", Format::Pfm),
    ] {
        assert_eq!(Format::of_path(Path::new(path)).unwrap(), format);
    }
    for path in ["picture", "picture.jpg", "png", ".png"] {
        let expected =
            format!("{path}: no picture format has this ending: expected .png, .ppm or .pfm");
        assert_eq!(
            Format::of_path(Path::new(path)).unwrap_err().to_string(),
            expected
        );
    }
}

#[test]
fn every_format_reads_back_its_pictures() {
    let back = decode_picture(&encode_png(&stored()).unwrap()).unwrap();
    assert_eq!(back, FilePicture::stored(stored()));
    let back = decode_picture(&encode_ppm(&stored()).unwrap()).unwrap();
    assert_eq!(
        back,
        FilePicture {
            has_alpha: false,
            ..FilePicture::stored(opaque(&stored()))
        }
    );
    let back = decode_picture(&encode_pfm(&linear()).unwrap()).unwrap();
    assert_eq!(
        back,
        FilePicture {
            has_alpha: false,
            encoding: None,
            ..FilePicture::linear(linear())
        }
    );
}

#[test]
fn bytes_follow_the_formats() {
    let picture = Picture8::from_pixels(1, 2, vec![[1, 2, 3, 255], [4, 5, 6, 0]]).unwrap();
    assert_eq!(
        encode_ppm(&picture).unwrap(),
        b"P6\n1 2\n255\n\x01\x02\x03\x04\x05\x06"
    );
    let picture =
        LinearPicture::from_pixels(1, 2, vec![[1.0, 0.5, 0.0, 1.0], [-2.0, 0.0, 0.0, 0.0]])
            .unwrap();
    let bytes = encode_pfm(&picture).unwrap();
    let (head, samples) = bytes.split_at(b"PF\n1 2\n-1.0\n".len());
    assert_eq!(head, b"PF\n1 2\n-1.0\n");
    // The bottom row comes first. 1.0 is 3f800000, 0.5 is 3f000000, −2.0 is c0000000, each with its
    // last byte first.
    assert_eq!(samples[..4], [0, 0, 0, 0xc0]);
    assert_eq!(samples[12..20], [0, 0, 0x80, 0x3f, 0, 0, 0, 0x3f]);
}

/// Sizes around the ends of the chunks in which pixels are converted and written.
const SIZES: [[usize; 2]; 8] = [
    [1, 1],
    [3, 1],
    [1, 5],
    [4, 4],
    [1023, 3],
    [1025, 2],
    [90_001, 1],
    [301, 300],
];

#[test]
fn large_pictures_are_written_as_small_ones() {
    for [width, height] in SIZES {
        let pixel = |i: usize| {
            [
                i as u8,
                (i >> 8) as u8,
                (i >> 16) as u8 ^ 0xa5,
                (i * 3) as u8,
            ]
        };
        let picture =
            Picture8::from_pixels(width, height, (0..width * height).map(pixel).collect()).unwrap();
        let mut expected = format!("P6\n{width} {height}\n255\n").into_bytes();
        expected.extend(picture.pixels().iter().flat_map(|&[r, g, b, _]| [r, g, b]));
        assert!(
            encode_ppm(&picture).unwrap() == expected,
            "{width}x{height}"
        );

        // Calls may split the pixels anywhere.
        let mut bytes = Vec::new();
        let mut file = PpmWriter::new(&mut bytes, width, height).unwrap();
        for pixels in picture.pixels().chunks(1 + width * height / 7) {
            file.pixels(pixels).unwrap();
        }
        file.finish().unwrap();
        assert!(bytes == expected, "{width}x{height} in parts");

        let pixel = |i: usize| [i as f32, -(i as f32), 1.0 / (i as f32), 0.5];
        let picture =
            LinearPicture::from_pixels(width, height, (0..width * height).map(pixel).collect())
                .unwrap();
        let mut expected = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
        for y in (0..height).rev() {
            expected.extend(
                picture
                    .row(y)
                    .iter()
                    .flat_map(|pixel| pixel[..3].iter().flat_map(|c| c.to_le_bytes())),
            );
        }
        assert!(
            encode_pfm(&picture).unwrap() == expected,
            "{width}x{height}"
        );
    }
}

/// A writer that records how many bytes it receives at a time.
#[derive(Default)]
struct Sizes(Vec<usize>);

impl io::Write for Sizes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.push(bytes.len());
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn files_are_written_in_whole_pages() {
    for format in [Format::Ppm, Format::Pfm] {
        let picture = FilePicture::linear(LinearPicture::new(301, 300, [0.5; 4]));
        let mut sizes = Sizes::default();
        picture.write_to(format, &mut sizes).unwrap();
        let (last, pieces) = sizes.0.split_last().unwrap();
        assert!(
            !pieces.is_empty() && pieces.iter().all(|size| size.is_multiple_of(4096)),
            "{:?}",
            sizes.0
        );
        assert_eq!(
            pieces.iter().sum::<usize>() + last,
            picture.encode(format).unwrap().len()
        );
    }
}

#[test]
fn a_file_has_as_many_pixels_as_its_header_says() {
    let mut file = PpmWriter::new(Vec::new(), 3, 2).unwrap();
    file.pixels(&[[1; 4]; 4]).unwrap();
    assert_eq!(
        file.pixels(&[[1; 4]; 3]).unwrap_err().kind(),
        io::ErrorKind::InvalidInput
    );
    assert_eq!(
        file.finish().unwrap_err().to_string(),
        "2 pixels of the picture are missing"
    );
    assert_eq!(
        PpmWriter::new(Vec::new(), 0, 2).unwrap_err(),
        EncodeError {
            width: 0,
            height: 2
        }
    );
}

#[test]
fn pictures_are_converted_to_the_format() {
    let shades =
        LinearPicture::from_pixels(2, 1, vec![[0.5, 2.0, f32::NAN, 1.0], [0.0, 0.25, 1.0, 0.0]])
            .unwrap();
    let picture = FilePicture::linear(shades);
    let png = decode_picture(&picture.encode(Format::Png).unwrap()).unwrap();
    assert_eq!(
        png.to_stored().pixels(),
        [[128, 255, 0, 255], [0, 64, 255, 0]]
    );
    assert_eq!(
        picture.encode(Format::Ppm).unwrap(),
        encode_ppm(&png.to_stored()).unwrap()
    );
    let pfm = decode_picture(&png.encode(Format::Pfm).unwrap()).unwrap();
    assert_eq!(pfm.to_linear().get(0, 0), [128.0 / 255.0, 1.0, 0.0, 1.0]);
    assert_eq!(
        pfm.to_stored(),
        opaque(&png.to_stored()),
        "levels survive as floats"
    );
}

#[test]
fn pictures_without_pixels_do_not_fit() {
    let nothing = FilePicture::stored(Picture8::new(0, 5, [0; 4]));
    for format in Format::ALL {
        let error = nothing.encode(format).unwrap_err();
        let expected = EncodeError {
            width: 0,
            height: 5,
        };
        assert_eq!(error.to_string(), expected.to_string());
    }
}

fn differing(reference: &FilePicture, actual: &FilePicture) -> usize {
    let [r, a] = Pair::new(reference, actual, None).compared();
    compare(&r, &a).unwrap().differing
}

#[test]
fn a_file_without_alpha_is_opaque_beside_one_that_states_no_background() {
    let png = FilePicture::stored(stored());
    let ppm = decode_picture(&encode_ppm(&stored()).unwrap()).unwrap();
    // Every fifth of 256, from the first.
    assert_eq!(differing(&png, &ppm), 52);
    assert_eq!(differing(&ppm, &png), 52);
    let pair = Pair::new(&png, &ppm, None);
    assert_eq!(pair.alpha(), AlphaUse::Opaque { of_reference: true });
    assert_eq!(differing(&png, &FilePicture::stored(opaque(&stored()))), 52);
}

/// Straight alpha against a file without alpha is put over the stated background, in linear light.
#[test]
fn a_picture_with_alpha_is_put_over_its_background_before_one_without() {
    let pixels = vec![[200, 100, 255, 102], [9, 9, 9, 255], [7, 8, 9, 0]];
    let straight = FilePicture {
        background: Some([10.0, 20.0, 30.0]),
        ..FilePicture::stored(Picture8::from_pixels(3, 1, pixels).unwrap()).encoded(Encoding::Srgb)
    };
    let read = decode_picture(&straight.encode(Format::Png).unwrap()).unwrap();
    assert_eq!(read, straight, "the chunks come back");
    let flat = FilePicture {
        has_alpha: false,
        ..FilePicture::stored(Picture8::new(3, 1, [0, 0, 0, 255]))
    };
    let pair = Pair::new(&read, &flat, None);
    assert_eq!(pair.alpha(), AlphaUse::Flattened { of_reference: true });
    let mut row = [Levels([0.0; 4]); 3];
    pair.compared()[0].level_row(0, &mut row);
    // By the formulas of IEC 61966-2-1 in Python: 0.4 of the light of 200 and 0.6 of that of 10,
    // and so on.
    let known = [132.555_771, 66.421_994, 171.104_004];
    for (level, known) in row[0].rgb().into_iter().zip(known) {
        assert!((level - known).abs() < 1e-5, "{level} is not {known}");
    }
    assert_eq!(
        row[1],
        Levels([9.0, 9.0, 9.0, 255.0]),
        "opaque pixels stay as they are"
    );
    let background = Levels([10.0, 20.0, 30.0, 255.0]);
    assert_eq!(row[2], background, "colours under alpha 0 do not count");
}

#[test]
fn colours_under_alpha_0_do_not_count() {
    let picture = |pixel| FilePicture::stored(Picture8::new(2, 2, pixel));
    let (red, green) = (picture([255, 0, 0, 0]), picture([0, 255, 0, 0]));
    assert_eq!(differing(&red, &green), 0);
    let [r, a] = Pair::new(&red, &green, None).displayed();
    let map = crate::compare::metrics::flip_map(&r, &a).unwrap();
    assert!(map.pixels().iter().all(|error| *error == 0.0));
    // One level of one channel.
    let (more, less) = (picture([9, 9, 9, 128]), picture([9, 9, 9, 127]));
    let [r, a] = Pair::new(&more, &less, None).compared();
    let difference = compare(&r, &a).unwrap();
    assert_eq!(
        (255.0 * difference.max, difference.coverage_mismatches),
        (1.0, 0)
    );
}

/// One picture in both encodings: stored in 8 bits as sRGB, and as linear floats.
#[test]
fn the_linear_one_of_two_encodings_is_encoded_without_rounding() {
    let ramp = LinearPicture::from_pixels(
        256,
        1,
        (0..256)
            .map(|i| [(i as f32 / 255.0).powi(2), -0.0, 1.0, 1.0])
            .collect(),
    )
    .unwrap();
    let floats = decode_picture(&encode_pfm(&ramp).unwrap()).unwrap();
    let bytes = super::super::encoding::store(&ramp, Encoding::Srgb);
    for (stated, is_stated) in [(Some(Encoding::Srgb), true), (None, false)] {
        let stored = FilePicture {
            encoding: stated,
            ..FilePicture::stored(bytes.clone())
        };
        let stored = decode_picture(&stored.encode(Format::Png).unwrap()).unwrap();
        for pictures in [[&stored, &floats], [&floats, &stored]] {
            let pair = Pair::new(pictures[0], pictures[1], None);
            let of = |i: usize| usize::from(std::ptr::eq(pictures[i], &floats));
            let expected = [(Encoding::Srgb, is_stated), (Encoding::Linear, false)];
            let used = pair.encodings().map(|used| (used.encoding, used.is_stated));
            assert_eq!(used, [expected[of(0)], expected[of(1)]]);
            let [r, a] = pair.compared();
            let most = 255.0 * compare(&r, &a).unwrap().max;
            // Half a level, and the f32 arithmetic of `srgb_encode` that chose the level: 2⁻²⁴
            // of 255.
            assert!(
                0.4 < most && most <= 0.5 + 255.0 / f64::from(1 << 24),
                "{most}"
            );
        }
    }
    // Two pictures in one encoding are compared as stored.
    let linear = FilePicture::stored(ramp.map(|pixel| pixel.map(quantise)));
    let [r, a] = Pair::new(&linear, &floats, Some(Encoding::Linear)).compared();
    assert!(255.0 * compare(&r, &a).unwrap().max <= 0.5 + 255.0 / f64::from(1 << 24));
}

#[test]
fn a_cut_file_is_an_error_wherever_it_is_cut() {
    let files = [
        encode_png(&stored()).unwrap(),
        encode_ppm(&stored()).unwrap(),
        encode_pfm(&linear()).unwrap(),
    ];
    for bytes in files {
        for end in 0..bytes.len() {
            assert!(
                decode_picture(&bytes[..end]).is_err(),
                "the first {end} of {} bytes",
                bytes.len()
            );
        }
        let longer = [&bytes[..], b"x"].concat();
        assert_eq!(
            decode_picture(&longer).is_ok(),
            bytes.starts_with(&png::SIGNATURE),
            "PNG has an end of its own"
        );
    }
}

#[test]
fn a_changed_byte_never_panics() {
    for bytes in [
        encode_png(&stored()).unwrap(),
        encode_ppm(&stored()).unwrap(),
        encode_pfm(&linear()).unwrap(),
    ] {
        for at in 0..bytes.len() {
            for change in [0x01, 0x80, 0xff] {
                let mut bytes = bytes.clone();
                bytes[at] ^= change;
                if let Ok(picture) = decode_picture(&bytes) {
                    assert!(picture.size()[0] > 0);
                }
            }
        }
    }
    // The checksum detects changes inside the compressed pixels. Signature 8, IHDR 25, then length
    // and type of IDAT.
    let mut bytes = encode_png(&stored()).unwrap();
    bytes[8 + 25 + 8 + 20] ^= 1;
    assert!(message(&bytes).starts_with("broken PNG file: "));
    let mut bytes = encode_png(&stored()).unwrap();
    bytes[8 + 24] ^= 1;
    let told = "broken PNG file: it is damaged: the checksum of its chunk IHDR is wrong";
    assert_eq!(message(&bytes), told);
}

/// Returns a PNG file with these samples.
fn png_of(
    [width, height]: [u32; 2],
    colour: ::png::ColorType,
    depth: ::png::BitDepth,
    samples: &[u8],
    set: impl FnOnce(&mut ::png::Encoder<'_, &mut Vec<u8>>),
) -> Vec<u8> {
    let mut out = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut out, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    set(&mut encoder);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(samples).unwrap();
    writer.finish().unwrap();
    out
}

#[test]
fn png_files_of_all_colour_types_are_read() {
    use ::png::{BitDepth, ColorType};
    let encode = |colour, depth, samples: &[u8]| {
        decode_picture(&png_of([2, 1], colour, depth, samples, |_| {})).unwrap()
    };
    let pixels = |picture: &FilePicture| picture.to_stored().pixels().to_vec();
    let grey = encode(ColorType::Grayscale, BitDepth::Eight, &[7, 200]);
    assert_eq!(
        (pixels(&grey), grey.has_alpha),
        (vec![[7, 7, 7, 255], [200, 200, 200, 255]], false)
    );
    let grey = encode(
        ColorType::GrayscaleAlpha,
        BitDepth::Eight,
        &[7, 0, 200, 255],
    );
    assert_eq!(
        (pixels(&grey), grey.has_alpha),
        (vec![[7, 7, 7, 0], [200, 200, 200, 255]], true)
    );
    let colour = encode(ColorType::Rgb, BitDepth::Eight, &[1, 2, 3, 4, 5, 6]);
    assert_eq!(
        (pixels(&colour), colour.has_alpha),
        (vec![[1, 2, 3, 255], [4, 5, 6, 255]], false)
    );
    // Few bits: 2 of 3 is 170 of 255, and 1 of 15 is 17.
    let few = encode(ColorType::Grayscale, BitDepth::Two, &[0b1001_0000]);
    assert_eq!(pixels(&few), [[170, 170, 170, 255], [85, 85, 85, 255]]);
    let few = encode(ColorType::Grayscale, BitDepth::Four, &[0x1f]);
    assert_eq!(pixels(&few), [[17, 17, 17, 255], [255; 4]]);
    let bits = encode(ColorType::Grayscale, BitDepth::One, &[0b0100_0000]);
    assert_eq!(pixels(&bits), [[0, 0, 0, 255], [255; 4]]);
    // 16 bits: 257 k is k, and 0x017f = 383 is 1.49 levels.
    let deep: Vec<u8> = [257u16, 514, 65_535, 0, 383, 257]
        .iter()
        .flat_map(|sample| sample.to_be_bytes())
        .collect();
    let deep = encode(ColorType::Rgb, BitDepth::Sixteen, &deep);
    assert_eq!(pixels(&deep), [[1, 2, 255, 255], [0, 1, 1, 255]]);
    let FilePixels::Deep { picture, maximum } = &deep.pixels else {
        panic!("16 bits are kept");
    };
    assert_eq!(
        (picture.get(1, 0), *maximum),
        ([0, 383, 257, 65_535], 65_535)
    );
}

#[test]
fn pictures_of_16_bits_are_compared_as_such() {
    let deep = |sample: u16| {
        let [high, low] = sample.to_be_bytes();
        let (colour, depth) = (::png::ColorType::Grayscale, ::png::BitDepth::Sixteen);
        decode_picture(&png_of([1, 1], colour, depth, &[high, low], |_| {})).unwrap()
    };
    let most = |a: &FilePicture, b: &FilePicture| {
        let [r, a] = Pair::new(a, b, None).compared();
        255.0 * compare(&r, &a).unwrap().max
    };
    // Two values near 127 are rounded once each, and their difference once.
    let error = most(&deep(0x8000), &deep(0x8055)) - 255.0 * 85.0 / 65535.0;
    assert!(error.abs() < 3.0 * 128.0 * f64::EPSILON, "{error}");
    // 8-bit levels are exact in 16 bits and in any other range that holds them.
    let byte = decode_picture(b"P5 1 1 255 \x80").unwrap();
    assert_eq!(most(&byte, &deep(0x8080)), 0.0);
    let odd = decode_picture(b"P5 1 1 510 \x01\x00").unwrap();
    assert_eq!(most(&byte, &odd), 0.0, "256 of 510 is 128 of 255");
    let odd = decode_picture(b"P5 1 1 100 \x07").unwrap();
    assert!(
        (most(&byte, &odd) - (128.0 - 17.85)).abs() < 128.0 * f64::EPSILON,
        "not rounded"
    );
}

#[test]
fn a_transparent_colour_becomes_alpha_and_interlaced_rows_are_put_in_order() {
    use ::png::{BitDepth, ColorType};
    let keyed = png_of(
        [2, 1],
        ColorType::Rgb,
        BitDepth::Eight,
        &[1, 2, 3, 4, 5, 6],
        |e| {
            e.set_trns(vec![0, 4, 0, 5, 0, 6]);
        },
    );
    let keyed = decode_picture(&keyed).unwrap();
    assert!(keyed.has_alpha);
    assert_eq!(keyed.to_stored().pixels(), [[1, 2, 3, 255], [4, 5, 6, 0]]);
    // A header that says interlaced, and one pass per pixel of 2 × 2: 1 (0, 0), 6 (1, 0), 7 (0, 1)
    // and (1, 1).
    let rows = [[0, 10].as_slice(), &[0, 20], &[0, 30, 40]].concat();
    let mut data = vec![0x78, 0x01, 0x01, 7, 0, 0xf8, 0xff];
    data.extend(&rows);
    let adler = rows.iter().fold((1u32, 0u32), |(a, b), byte| {
        let a = a + u32::from(*byte);
        (a, b + a)
    });
    data.extend((adler.1 << 16 | adler.0).to_be_bytes());
    let bytes = [
        png::SIGNATURE.to_vec(),
        chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 2, 8, 0, 0, 0, 1]),
        chunk(b"IDAT", &data),
        chunk(b"IEND", &[]),
    ]
    .concat();
    let grey: Vec<u8> = decode_picture(&bytes)
        .unwrap()
        .to_stored()
        .pixels()
        .iter()
        .map(|pixel| pixel[0])
        .collect();
    assert_eq!(grey, [10, 20, 30, 40]);
}

/// The chunks of a PNG file state its encoding. A chunk that is not understood is reported.
#[test]
fn chunks_that_state_the_encoding_are_read() {
    use ::png::{BitDepth, ColorType};
    let plain = png_of([1, 1], ColorType::Grayscale, BitDepth::Eight, &[9], |_| {});
    // After the signature and IHDR.
    let with = |chunks: &[Vec<u8>]| {
        let bytes = [&plain[..33], &chunks.concat(), &plain[33..]].concat();
        decode_picture(&bytes).unwrap()
    };
    let gamma = |units: u32| chunk(b"gAMA", &units.to_be_bytes());
    let srgb = chunk(b"sRGB", &[0]);
    let cicp = |transfer: u8| chunk(b"cICP", &[1, transfer, 0, 1]);
    // A profile: name, method, an empty zlib stream.
    let profile = chunk(b"iCCP", b"p\0\0\x78\x01\x01\0\0\xff\xff\0\0\0\x01");
    let (linear, is_srgb) = (Some(Encoding::Linear), Some(Encoding::Srgb));
    for (chunks, encoding, note) in [
        (vec![], None, ""),
        (vec![srgb.clone()], is_srgb, ""),
        (vec![gamma(100_000)], linear, ""),
        (vec![gamma(45_455)], is_srgb, ""),
        (vec![srgb.clone(), gamma(100_000)], is_srgb, ""),
        (vec![cicp(8)], linear, ""),
        (vec![cicp(13), gamma(100_000)], is_srgb, ""),
        (
            vec![cicp(16)],
            None,
            "its colour space cICP 1-16 is not understood: it is passed over",
        ),
        (
            vec![gamma(55_556)],
            None,
            "its gamma of 0.55556 (gAMA) is not understood: it is passed over",
        ),
        (
            vec![gamma(0)],
            None,
            "its gamma of 0 (gAMA) is not understood: it is passed over",
        ),
        (vec![srgb.clone(), gamma(0)], is_srgb, ""),
        (
            vec![profile, gamma(100_000)],
            linear,
            "its colour profile (iCCP) is not understood: its samples count as linear",
        ),
    ] {
        let picture = with(&chunks);
        assert_eq!(picture.encoding, encoding, "{chunks:?}");
        assert_eq!(picture.notes.join(""), note, "{chunks:?}");
    }
    // A stated encoding reads back as it was written.
    for encoding in [None, linear, is_srgb] {
        let picture = FilePicture {
            encoding,
            background: encoding.map(|_| [1.0, 2.0, 3.0]),
            ..FilePicture::stored(stored())
        };
        let bytes = picture.encode(Format::Png).unwrap();
        assert_eq!(decode_picture(&bytes).unwrap(), picture);
    }
}

#[test]
fn an_animation_gives_its_still_picture_and_says_so() {
    use ::png::{BitDepth, ColorType};
    let mut bytes = png_of([1, 1], ColorType::Grayscale, BitDepth::Eight, &[9], |_| {});
    let control = chunk(b"acTL", &[0, 0, 0, 2, 0, 0, 0, 0]);
    bytes.splice(33..33, control);
    let picture = decode_picture(&bytes).unwrap();
    assert_eq!(picture.to_stored().pixels(), [[9, 9, 9, 255]]);
    assert_eq!(
        picture.notes,
        ["the file is an animation: this is its still picture"]
    );
}

/// Returns a chunk of a PNG file.
fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut bytes = (data.len() as u32).to_be_bytes().to_vec();
    bytes.extend(kind.iter().chain(data));
    bytes.extend(crc(&bytes[4..]).to_be_bytes());
    bytes
}

/// Palettes are looked up. This one has two colours, one bit per pixel, and is written by hand
/// because the encoder has none.
#[test]
fn png_palettes_are_looked_up() {
    // zlib, one stored block of two bytes: filter 0, pixels 1 0. Then Adler-32 of 00 80.
    let pixels = [
        0x78, 0x01, 0x01, 2, 0, 0xfd, 0xff, 0x00, 0x80, 0x00, 0x82, 0x00, 0x81,
    ];
    let bytes = [
        png::SIGNATURE.to_vec(),
        chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 1, 1, 3, 0, 0, 0]),
        chunk(b"PLTE", &[10, 20, 30, 40, 50, 60]),
        chunk(b"IDAT", &pixels),
        chunk(b"IEND", &[]),
    ]
    .concat();
    let picture = decode_picture(&bytes).unwrap();
    assert_eq!(
        picture.to_stored().pixels(),
        [[40, 50, 60, 255], [10, 20, 30, 255]]
    );

    // A header with 100,000 pixels per side must be rejected before anything is allocated.
    let huge = [
        png::SIGNATURE.to_vec(),
        chunk(
            b"IHDR",
            &[0, 1, 0x86, 0xa0, 0, 1, 0x86, 0xa0, 8, 6, 0, 0, 0],
        ),
        chunk(b"IDAT", &pixels),
        chunk(b"IEND", &[]),
    ]
    .concat();
    assert_eq!(
        message(&huge),
        "100000×100000 pixels are too many: expected at most 268435456, and 1048576 a side"
    );
}

/// Computes CRC-32 as in ISO/IEC 15948, annex D.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 {
                0xedb8_8320 ^ (crc >> 1)
            } else {
                crc >> 1
            }
        })
    })
}

#[test]
fn ppm_files_of_others_are_read() {
    let pixels = |bytes: &[u8]| decode_picture(bytes).unwrap().to_stored().pixels().to_vec();
    assert_eq!(
        pixels(b"P6 # by hand\n#\n 1\t1 \r\n 255\n\x01\x20\n"),
        [[1, 32, 10, 255]],
        "samples may look like space"
    );
    assert_eq!(pixels(b"P6 1 1 1 \x00\x01\x01"), [[0, 255, 255, 255]]);
    // 7/15 of 255 is 119. In 16 bits, 32768/65535 of 255 is 127.502.
    assert_eq!(pixels(b"P6 1 1 15 \x00\x07\x0f"), [[0, 119, 255, 255]]);
    assert_eq!(
        pixels(b"P6 1 1 65535 \x00\x00\x80\x00\xff\xff"),
        [[0, 128, 255, 255]]
    );
}

#[test]
fn portable_pixmaps_of_all_kinds_are_read() {
    let read = |bytes: &[u8]| decode_picture(bytes).unwrap();
    let pixels = |bytes: &[u8]| read(bytes).to_stored().pixels().to_vec();
    let grey = |levels: &[u8]| -> Vec<[u8; 4]> {
        levels
            .iter()
            .map(|level| [*level, *level, *level, 255])
            .collect()
    };
    // 1 is black; plain digits need no space; raw rows end with their byte.
    for file in [
        &b"P1\n# bits\n3 2\n0 1 1\n1 0 0\n"[..],
        b"P1 3 2 011100",
        b"P1 3 2 0\n1#a\n1\n100",
        b"P4\n3 2\n\x60\x80",
        b"P4 3 2 \x7f\x9f",
    ] {
        assert_eq!(pixels(file), grey(&[255, 0, 0, 0, 255, 255]), "{file:?}");
    }
    for file in [
        &b"P2 3 1 255 7 0200\n255"[..],
        b"P2\r\n3 1\r\n# comment\r\n255\r\n7\r\n200 # more\n255\r\n",
        b"P5 3 1 255 \x07\xc8\xff",
        b"P5 3 1 255#\n\x07\xc8\xff",
        b"P7\nWIDTH 3\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nTUPLTYPE GRAYSCALE\nENDHDR\n\x07\xc8\xff",
    ] {
        assert_eq!(pixels(file), grey(&[7, 200, 255]), "{file:?}");
    }
    assert_eq!(
        pixels(b"P3 1 2 15 0 7 15 15 1 0"),
        [[0, 119, 255, 255], [255, 17, 0, 255]]
    );
    let alpha = read(b"P7\n# a\nMAXVAL 255\nDEPTH 4\nHEIGHT 1\nWIDTH 1\nTUPLTYPE RGB_ALPHA\nENDHDR\n\x01\x02\x03\x04");
    assert_eq!(
        (alpha.to_stored().pixels(), alpha.has_alpha),
        (&[[1, 2, 3, 4]][..], true)
    );
    // The same picture in two ranges and layouts.
    let plain = read(b"P3 1 1 1000 0 500 1000");
    assert_eq!(plain, read(b"P6 1 1 1000 \x00\x00\x01\xf4\x03\xe8"));
    assert_eq!(differing(&plain, &read(b"P3 1 1 2 0 1 2")), 0);
    assert_eq!(
        pixels(
            b"P7\nWIDTH 2\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nTUPLTYPE BLACKANDWHITE\nENDHDR\n\x00\x01"
        ),
        grey(&[0, 255]),
        "in PAM 1 is white"
    );
}

#[test]
fn the_first_of_several_pictures_is_read_and_that_is_said() {
    for file in [
        &b"P6 1 1 255 abcP6 1 1 255 xyz"[..],
        b"P3 1 1 255 97 98 99\nP3 1 1 255 1 2 3\n",
    ] {
        let picture = decode_picture(file).unwrap();
        assert_eq!(picture.to_stored().pixels(), [[97, 98, 99, 255]]);
        assert_eq!(
            picture.notes,
            ["the file holds several pictures: this is the first"]
        );
    }
    assert_eq!(
        message(b"P6 1 1 255 abcd"),
        "broken PPM file: it goes on after its last pixel: expected its end, or another picture"
    );
    let spaced = decode_picture(b"P6 1 1 255 abc\r\n").unwrap();
    assert_eq!(
        spaced.notes,
        ["the white space after its last pixel is passed over"]
    );
    // The format says that LF is red, a is green, b is blue, and the last byte is left over.
    let shifted = "it goes on after its last pixel: expected one byte of white space before its samples, found CR LF";
    assert_eq!(
        message(b"P6\r\n1 1\r\n255\r\nab\x20"),
        format!("broken PPM file: {shifted}")
    );
    // If no byte is left over, LF is a sample like any other.
    let lf = decode_picture(b"P5 1 1 255\r\n").unwrap();
    assert_eq!(
        (lf.to_stored().pixels(), lf.notes.len()),
        (&[[10, 10, 10, 255]][..], 0)
    );
    assert!(
        decode_picture(b"P2 1 1 255 9 \n\n# end")
            .unwrap()
            .notes
            .is_empty()
    );
}

#[test]
fn broken_pixmaps_are_told() {
    for (file, told) in [
        (
            &b"P3 1 1 255 1 2"[..],
            "broken PPM file: it ends too early: samples are missing",
        ),
        (
            b"P2 1 1 255 x",
            "broken PGM file: a sample is \"x\": expected a number",
        ),
        (
            b"P2 1 1 255 -1",
            "broken PGM file: a sample is \"-1\": expected a number",
        ),
        (
            b"P2 1 1 255 256",
            "broken PGM file: a sample is 256: expected at most 255, as its header says",
        ),
        (
            b"P2 1 1 9 99999",
            "broken PGM file: a sample is 99999: expected at most 65535",
        ),
        (
            b"P1 2 1 02",
            "broken PBM file: a sample is \"2\": expected 0 or 1",
        ),
        (
            b"P1 2 1 0",
            "broken PBM file: it ends too early: samples are missing",
        ),
        (
            b"P4 9 1 a",
            "broken PBM file: it ends too early: expected 2 bytes of samples, found 1",
        ),
        (
            b"P5 1 1 65536 ab",
            "broken PGM file: the largest sample is 65536: expected 1 to 65535",
        ),
        (
            b"P7\nWIDTH 1\nENDHDR\n",
            "broken PAM file: its header has no HEIGHT",
        ),
        (
            b"P7\nWIDTH 1\n",
            "broken PAM file: it ends too early: expected a line ENDHDR",
        ),
        (
            b"P7\nWIDE 1\nENDHDR\n",
            "broken PAM file: a line begins with WIDE: expected WIDTH, HEIGHT, DEPTH, MAXVAL, TUPLTYPE or ENDHDR",
        ),
        (
            b"P7\nWIDTH x\nENDHDR\n",
            "broken PAM file: WIDTH is \"x\": expected a number",
        ),
        (
            b"P7\nWIDTH 1\nHEIGHT 1\nDEPTH 5\nMAXVAL 1\nENDHDR\n",
            "broken PAM file: it has 5 samples a pixel of type ``: expected 1 (GRAYSCALE), 2 (GRAYSCALE_ALPHA), 3 (RGB) or 4 (RGB_ALPHA)",
        ),
        (
            b"P5 1048577 1 255 ",
            "1048577×1 pixels are too many: expected at most 268435456, and 1048576 a side",
        ),
    ] {
        assert_eq!(message(file), told);
    }
    assert!(message(&[b"P7\n".to_vec(), vec![b'x'; 5000]].concat()).len() < 200);
}

/// A header that promises much costs no more than the bytes that follow it.
#[test]
fn a_short_file_with_a_large_header_ends_too_early() {
    for head in [
        "P6 16384 16384 255 ",
        "P5 16384 16384 65535 ",
        "PF 16384 16384 -1 ",
        "P4 16384 16384 ",
    ] {
        let told = message(format!("{head}abc").as_bytes());
        assert!(
            told.contains("it ends too early: expected") && told.ends_with("found 3"),
            "{told}"
        );
    }
    assert!(message(b"P3 16384 16384 255 1 2").contains("it ends too early"));
}

#[test]
fn pfm_files_of_others_are_read() {
    let header = |text: &str, sample: [u8; 4], count: usize| {
        [text.as_bytes(), &sample.repeat(count)].concat()
    };
    let picture = decode_picture(&header("PF 1 1\n2.5\n", 0.25f32.to_be_bytes(), 3)).unwrap();
    assert_eq!(picture.to_linear().pixels(), [[0.25, 0.25, 0.25, 1.0]]);
    let picture = decode_picture(&header("Pf\n2 1\n-1\n", 0.75f32.to_le_bytes(), 2)).unwrap();
    assert_eq!(picture.to_linear().pixels(), [[0.75, 0.75, 0.75, 1.0]; 2]);
}

#[test]
fn broken_headers_are_told() {
    let expected = "expected PNG, PBM, PGM, PPM (P1 to P6), PAM, PFM, BMP or Targa (.tga)";
    assert_eq!(message(b""), format!("the file is empty: {expected}"));
    for text in ["P8 1 1 255 0 0 0", "P", "P6", "P65", "PNG", "v 0 0 0"] {
        let told = format!("not a picture that can be read: {expected}");
        assert_eq!(message(text.as_bytes()), told);
    }
    assert_eq!(
        message(b"\xff\xd8\xff\xe0\0\x10JFIF"),
        format!("it is a JPEG file, which is not read: {expected}")
    );
    assert_eq!(
        message(b"P6 x 1 255 "),
        "broken PPM file: the width is \"x\": expected a number"
    );
    assert_eq!(
        message(b"P6 1 -1 255 "),
        "broken PPM file: the height is \"-1\": expected a number"
    );
    assert_eq!(
        message(b"P6 1 1 # no end"),
        "broken PPM file: the largest sample is \"\": expected a number"
    );
    assert_eq!(
        message(b"P6 1 1 0 abc"),
        "broken PPM file: the largest sample is 0: expected 1 to 65535"
    );
    assert_eq!(
        message(b"P6 1 1 9 \x00\x09\x0a"),
        "broken PPM file: a sample is 10: expected at most 9, as its header says"
    );
    assert_eq!(
        message(b"P6 0 1 255 "),
        "broken PPM file: it has no pixels: expected a width and a height of at least 1"
    );
    assert_eq!(
        message(b"P6 2 1 255 abc"),
        "broken PPM file: it ends too early: expected 6 bytes of samples, found 3"
    );
    assert_eq!(
        message(b"P6 4000000000 4000000000 255 "),
        "4000000000×4000000000 pixels are too many: expected at most 268435456, and 1048576 a side"
    );
    assert!(
        message(b"P6 4294967296 4294967296 255 ").contains("too many"),
        "the product, 2^64, does not wrap"
    );
    assert_eq!(
        message(b"PF 1 1 0 abcd"),
        "broken PFM file: the scale tells no order of bytes: expected a negative or a positive number"
    );
    assert!(message(b"PF 1 1 nan abcd").contains("order of bytes"));
    assert!(
        message(&[b"P6 ".to_vec(), vec![0xff; 1000]].concat()).len() < 200,
        "no flood of bytes"
    );
}

#[test]
fn files_go_by_path_and_errors_name_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let picture = FilePicture::stored(stored());
    for name in ["a.png", "a.ppm", "a.pfm"] {
        write_picture(&path(name), &picture).unwrap();
        assert_eq!(
            opaque(&read_picture(&path(name)).unwrap().to_stored()),
            opaque(&stored())
        );
    }
    assert_eq!(read_picture(&path("a.png")).unwrap().to_stored(), stored());
    for name in ["a.png", "a.ppm", "a.pfm"] {
        std::fs::remove_file(path(name)).unwrap();
        let error = read_picture(&path(name)).unwrap_err().to_string();
        assert!(
            error.starts_with(&format!("{}: cannot be read: ", path(name).display())),
            "{error}"
        );
    }
    assert!(read_picture(folder.path()).is_err(), "a directory");
    #[cfg(target_os = "linux")]
    {
        let error = read_picture(Path::new("/dev/zero"))
            .unwrap_err()
            .to_string();
        assert!(
            error.starts_with("/dev/zero: not a picture that can be read"),
            "{error}, after reading as much as a picture may have"
        );
    }

    let nothing = FilePicture::stored(Picture8::new(0, 5, [0; 4]));
    assert!(
        write_picture(&path("b.png"), &nothing)
            .unwrap_err()
            .to_string()
            .contains("b.png: cannot be written: a picture of 0×5 pixels")
    );
    assert!(matches!(
        write_picture(&path("b.gif"), &picture),
        Err(ImageFileError::UnknownEnding { .. })
    ));
    assert!(!path("b.png").exists() && !path("b.gif").exists());
}

/// An uncompressed BMP of 2 × 2 pixels in 24 bits, as a rasterizer without a library writes it:
/// bottom row first, blue first.
const BMP: &[u8] = b"BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x02\0\0\0\x02\0\0\0\x01\0\x18\0\0\0\0\0\x10\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\
\x01\x02\x03\x04\x05\x06\0\0\x07\x08\x09\x0a\x0b\x0c\0\0";

/// The same pixels as Targa, type 2, from the top down.
const TARGA: &[u8] = b"\0\0\x02\0\0\0\0\0\0\0\0\0\x02\0\x02\0\x18\x20\
\x07\x08\x09\x0a\x0b\x0c\x01\x02\x03\x04\x05\x06";

#[test]
fn bitmaps_of_rasterizers_without_a_library_are_read() {
    let pixels = [
        [9, 8, 7, 255],
        [12, 11, 10, 255],
        [3, 2, 1, 255],
        [6, 5, 4, 255],
    ];
    let named = |bytes, name: &str| read_picture_from(bytes, Path::new(name));
    for (bytes, name) in [(BMP, "a.bmp"), (BMP, "no ending"), (TARGA, "a.TGA")] {
        let picture = named(bytes, name).unwrap();
        assert_eq!(picture.to_stored().pixels(), pixels, "{name}");
        assert_eq!(
            (picture.has_alpha, picture.encoding),
            (false, None),
            "{name}"
        );
    }
    // Targa has no signature: only the ending of the name identifies it.
    let error = named(TARGA, "a.png").unwrap_err().to_string();
    assert!(error.contains("not a picture that can be read"), "{error}");
    for (bytes, name) in [
        (&BMP[..60], "a.bmp"),
        (&TARGA[..20], "a.tga"),
        (b"text", "a.tga"),
    ] {
        let error = named(bytes, name).unwrap_err().to_string();
        assert!(error.contains("broken"), "{name}: {error}");
    }
    // A header that claims 2³¹ − 1 columns.
    let mut large = BMP.to_vec();
    large[18..22].copy_from_slice(&[0xff, 0xff, 0xff, 0x7f]);
    let error = named(&large, "a.bmp").unwrap_err().to_string();
    assert!(
        error.contains("a.bmp: ") && !error.contains("panic"),
        "{error}"
    );
}

/// Exif data in either byte order, with and without JPEG's marker in front, and as a SHORT or a
/// LONG.
#[test]
fn an_orientation_of_exif_is_told() {
    let plain = FilePicture::stored(stored()).encode(Format::Png).unwrap();
    let with = |data: &[u8], at: usize| {
        let bytes = [&plain[..at], &chunk(b"eXIf", data), &plain[at..]].concat();
        decode_picture(&bytes).unwrap()
    };
    // After IHDR, and before IEND.
    let places = [33, plain.len() - 12];
    let little = |kind: u8, value: u8| {
        // Header, two entries (the first of another tag), no further directory.
        let head = b"II*\0\x08\0\0\0\x02\0\x0f\x01\x02\0\x01\0\0\0a\0\0\0\x12\x01";
        [
            &head[..],
            &[kind, 0, 1, 0, 0, 0, value, 0, 0, 0, 0, 0, 0, 0],
        ]
        .concat()
    };
    let big = |value: u8| {
        let head = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0";
        [&head[..], &[value, 0, 0, 0, 0, 0, 0]].concat()
    };
    let note = "its Exif orientation 6 (to be shown turned clockwise by 90 degrees) is passed over: pixels count as they are stored";
    let marked = [&b"Exif\0\0"[..], &little(3, 6)].concat();
    for data in [little(3, 6), little(4, 6), big(6), marked] {
        for at in places {
            assert_eq!(with(&data, at).notes, [note], "{data:?} at {at}");
        }
    }
    let orientations = (0..=9).map(|value| with(&big(value), 33).notes.len());
    assert_eq!(
        orientations.collect::<Vec<_>>(),
        [0, 0, 1, 1, 1, 1, 1, 1, 1, 0]
    );
    // Data that are cut off or are not Exif state nothing and break nothing.
    let whole = big(6);
    for end in 0..19 {
        assert_eq!(with(&whole[..end], 33).notes, [""; 0], "{end} bytes");
    }
    let far = [&b"II*\0\xff\xff\xff\xff"[..], &little(3, 6)].concat();
    assert_eq!(with(&far, 33).notes, [""; 0]);
}

/// A PNG file names the program, which can then recognise its own files.
#[test]
fn a_png_file_names_its_software() {
    let named = FilePicture::stored(stored()).encode(Format::Png).unwrap();
    let mark = b"tEXtSoftware\0fastphong";
    assert!(named.windows(mark.len()).any(|part| part == mark));
    assert_eq!(decode_picture(&named).unwrap().to_stored(), stored());
}

#[test]
fn formats_without_alpha_hold_a_picture_over_the_background_that_it_states() {
    let stored = Picture8::from_pixels(3, 1, vec![[255, 0, 0, 255], [255, 0, 0, 51], [9; 4]]);
    let mut stored = stored.unwrap();
    stored.pixels_mut()[2][3] = 0;
    let mut picture = FilePicture::stored(stored).encoded(Encoding::Linear);
    let rgb = |picture: &FilePicture, format| {
        let read = decode_picture(&picture.encode(format).unwrap()).unwrap();
        read.to_stored().pixels().to_vec()
    };
    // Without a background, colours stay as they are.
    let unchanged = [[255, 0, 0, 255], [255, 0, 0, 255], [9, 9, 9, 255]];
    assert_eq!(rgb(&picture, Format::Ppm), unchanged);
    picture.background = Some([0.0, 100.0, 200.0]);
    // A fifth of red, four fifths of the background.
    let over = [[255, 0, 0, 255], [51, 80, 160, 255], [0, 100, 200, 255]];
    for format in [Format::Ppm, Format::Pfm] {
        assert_eq!(rgb(&picture, format), over);
    }
    assert_eq!(rgb(&picture, Format::Png)[1], [255, 0, 0, 51]);
    // PFM keeps 16 bits, too: 77 is between two of 255 levels.
    let pixels = vec![[77, 0, 0, u16::MAX], [0; 4]];
    let deep = FilePixels::Deep {
        picture: Picture::from_pixels(2, 1, pixels).unwrap(),
        maximum: u16::MAX,
    };
    let deep = FilePicture {
        has_alpha: true,
        background: Some([0.0; 3]),
        ..FilePicture::of_pixels(deep)
    };
    let read = decode_picture(&deep.encode(Format::Pfm).unwrap()).unwrap();
    assert_eq!(read.to_linear().pixels()[0][0], 77.0 / 65535.0);
}

#[test]
fn a_float_map_of_an_srgb_picture_holds_linear_floats() {
    let stored = Picture8::from_pixels(1, 1, vec![[0, 128, 255, 255]]).unwrap();
    let picture = FilePicture::stored(stored).encoded(Encoding::Srgb);
    let read = decode_picture(&picture.encode(Format::Pfm).unwrap()).unwrap();
    let expected = [0.0, 128.0 / 255.0, 1.0].map(|c| Encoding::Srgb.decode(c) as f32);
    assert_eq!(read.to_linear().pixels()[0][..3], expected);
}

#[test]
fn bytes_behind_the_end_of_a_png_file_are_told() {
    let mut bytes = encode_png(&Picture8::new(2, 1, [9; 4])).expect("a picture");
    assert!(decode_picture(&bytes).unwrap().notes.is_empty());
    bytes.extend(b"one more");
    let told = decode_picture(&bytes).unwrap().notes;
    assert_eq!(told, ["8 bytes behind its end are not read"]);
}
