use std::format;
use std::string::{String, ToString};
use std::vec;

use super::*;
use crate::compare::metrics::compare;

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
    assert_eq!(
        back,
        FilePicture {
            pixels: FilePixels::Stored(stored()),
            has_alpha: true
        }
    );
    let back = decode_picture(&encode_ppm(&stored()).unwrap()).unwrap();
    assert_eq!(
        back,
        FilePicture {
            pixels: FilePixels::Stored(opaque(&stored())),
            has_alpha: false
        }
    );
    let back = decode_picture(&encode_pfm(&linear()).unwrap()).unwrap();
    assert_eq!(
        back,
        FilePicture {
            pixels: FilePixels::Linear(linear()),
            has_alpha: false
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

/// Sizes around the ends of the chunks that are converted and written.
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

        // Parts may end anywhere.
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

#[test]
fn alpha_counts_only_if_both_files_have_it() {
    let png = FilePicture::stored(stored());
    let ppm = decode_picture(&encode_ppm(&stored()).unwrap()).unwrap();
    let [a, b] = comparable(&png, &ppm);
    assert!(compare(&a, &b).unwrap().equal);
    let [a, b] = comparable(&png, &FilePicture::stored(opaque(&stored())));
    // Every fifth of 256, from the first.
    assert_eq!(compare(&a, &b).unwrap().coverage_mismatches, 52);
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
}

#[test]
fn png_files_of_all_colour_types_are_read() {
    let encode = |bytes: &[u8], colour: image::ExtendedColorType| {
        let mut out = Vec::new();
        image::ImageEncoder::write_image(
            image::codecs::png::PngEncoder::new(&mut out),
            bytes,
            2,
            1,
            colour,
        )
        .unwrap();
        decode_picture(&out).unwrap()
    };
    let pixels = |picture: &FilePicture| picture.to_stored().pixels().to_vec();
    let grey = encode(&[7, 200], image::ExtendedColorType::L8);
    assert_eq!(
        (pixels(&grey), grey.has_alpha),
        (vec![[7, 7, 7, 255], [200, 200, 200, 255]], false)
    );
    let grey = encode(&[7, 0, 200, 255], image::ExtendedColorType::La8);
    assert_eq!(
        (pixels(&grey), grey.has_alpha),
        (vec![[7, 7, 7, 0], [200, 200, 200, 255]], true)
    );
    let colour = encode(&[1, 2, 3, 4, 5, 6], image::ExtendedColorType::Rgb8);
    assert_eq!(
        (pixels(&colour), colour.has_alpha),
        (vec![[1, 2, 3, 255], [4, 5, 6, 255]], false)
    );
    // 16 bits are most significant byte first in the file and in native order here. 257 k is k, and
    // 0x017f = 383 is 1.49 levels.
    let deep: Vec<u8> = [257u16, 514, 65_535, 0, 383, 257]
        .iter()
        .flat_map(|sample| sample.to_ne_bytes())
        .collect();
    assert_eq!(
        pixels(&encode(&deep, image::ExtendedColorType::Rgb16)),
        [[1, 2, 255, 255], [0, 1, 1, 255]]
    );
}

/// Palettes are looked up. This one has two colours, one bit per pixel, and is written by hand
/// because the encoder has none.
#[test]
fn png_palettes_are_looked_up() {
    let chunk = |kind: &[u8; 4], data: &[u8]| {
        let mut bytes = (data.len() as u32).to_be_bytes().to_vec();
        bytes.extend(kind.iter().chain(data));
        bytes.extend(crc(&bytes[4..]).to_be_bytes());
        bytes
    };
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
        "100000×100000 pixels are too many: expected at most 67108864"
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
    assert_eq!(
        message(b""),
        "not a picture that can be read: expected PNG, PPM (P6) or PFM"
    );
    assert_eq!(
        message(b"P3 1 1 255 0 0 0"),
        "not a picture that can be read: expected PNG, PPM (P6) or PFM"
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
        "4000000000×4000000000 pixels are too many: expected at most 67108864"
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
            error.starts_with("/dev/zero: not a picture"),
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
