//! Reads portable pixmaps: PBM, PGM and PPM, plain (P1 to P3) and raw (P4 to P6), PAM (P7), and PFM
//! (PF, Pf).
//!
//! Samples stay as the file has them, together with the largest value that its header states.
//! Nothing is rounded.

use std::io::{self, BufRead};
use std::string::String;
use std::vec::Vec;
use std::{fmt, format, str, vec};

use super::super::{
    DecodeError, FilePicture, FilePixels, MAX_PIXELS, ReadProblem, checked_size, reserved,
};
use crate::picture::Picture;

/// The longest word of a header that is read. A file that is no pixmap may have words of any
/// length.
const LONGEST: usize = 200;

/// A format of the family, identified by the first two bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Kind {
    /// The name in messages.
    name: &'static str,
    layout: Layout,
}

/// The order and form of the samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layout {
    /// Digits 0 and 1, where 1 is black.
    PlainBits,
    /// Rows of bits, packed into bytes from the highest bit on, where 1 is black.
    RawBits,
    /// Numbers in text, with this many channels.
    Plain(usize),
    /// One byte each, or two with the high one first, with this many channels.
    Raw(usize),
    /// PAM: a header of lines that states everything.
    Arbitrary,
    /// Floats, the bottom row first, with this many channels.
    Floats(usize),
}

impl Kind {
    /// Returns the format that the first bytes of a file announce.
    pub(crate) fn announced(bytes: &[u8]) -> Option<Kind> {
        let [b'P', digit, after, ..] = bytes else {
            return None;
        };
        let is_apart = is_space(*after) || *after == b'#';
        let (name, layout) = match digit {
            b'1' => ("PBM", Layout::PlainBits),
            b'2' => ("PGM", Layout::Plain(1)),
            b'3' => ("PPM", Layout::Plain(3)),
            b'4' => ("PBM", Layout::RawBits),
            b'5' => ("PGM", Layout::Raw(1)),
            b'6' => ("PPM", Layout::Raw(3)),
            b'7' => ("PAM", Layout::Arbitrary),
            b'F' => ("PFM", Layout::Floats(3)),
            b'f' => ("PFM", Layout::Floats(1)),
            _ => return None,
        };
        is_apart.then_some(Kind { name, layout })
    }
}

/// Reads the picture of a file whose first bytes announce `kind`. If the file holds several
/// pictures, reads the first.
pub(crate) fn read(kind: Kind, input: &mut dyn BufRead) -> Result<FilePicture, ReadProblem> {
    let mut file = Reader {
        kind,
        input,
        last_space: b' ',
        may_be_shifted: false,
    };
    // Skip the two bytes that announced the format.
    file.fill(&mut [0; 2])?;
    let mut picture = match kind.layout {
        Layout::Floats(channels) => return file.floats(channels),
        Layout::Arbitrary => file.arbitrary()?,
        Layout::PlainBits | Layout::RawBits => {
            let size = file.size()?;
            file.integers(size, 1, 1)?
        }
        Layout::Plain(channels) | Layout::Raw(channels) => {
            let size = file.size()?;
            let maximum = file.number("the largest sample")?;
            file.integers(size, channels, maximum)?
        }
    };
    let note = match file.rest()? {
        Rest::Nothing => return Ok(picture),
        Rest::Space => "the white space after its last pixel is passed over",
        Rest::Picture => "the file holds several pictures: this is the first",
    };
    picture.notes.push(note.into());
    Ok(picture)
}

/// A file that is read from start to end.
struct Reader<'a> {
    kind: Kind,
    input: &'a mut dyn BufRead,
    /// The white space that ended the last word.
    last_space: u8,
    /// True if a byte of the header may have been taken for a sample.
    may_be_shifted: bool,
}

/// What follows the picture in the file.
enum Rest {
    Nothing,
    /// White space after binary samples. White space at the end of text is normal.
    Space,
    Picture,
}

impl Reader<'_> {
    /// Reads the next byte. Returns `None` at the end.
    fn byte(&mut self) -> io::Result<Option<u8>> {
        let byte = self.input.fill_buf()?.first().copied();
        self.input.consume(usize::from(byte.is_some()));
        Ok(byte)
    }

    fn peek(&mut self) -> io::Result<Option<u8>> {
        Ok(self.input.fill_buf()?.first().copied())
    }

    /// Fills `bytes` and returns how many were filled: fewer only at the end of the file.
    fn fill(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let mut filled = 0;
        while filled < bytes.len() {
            let found = self.input.fill_buf()?;
            let count = found.len().min(bytes.len() - filled);
            if count == 0 {
                break;
            }
            bytes[filled..][..count].copy_from_slice(&found[..count]);
            self.input.consume(count);
            filled += count;
        }
        Ok(filled)
    }

    /// Skips white space and comments. A comment runs from `#` to the end of its line.
    fn skip_space(&mut self) -> io::Result<()> {
        while let Some(byte) = self.peek()? {
            match byte {
                b'#' => self.skip_comment()?,
                byte if is_space(byte) => self.input.consume(1),
                _ => break,
            }
        }
        Ok(())
    }

    fn skip_comment(&mut self) -> io::Result<()> {
        while let Some(byte) = self.byte()? {
            if byte == b'\n' || byte == b'\r' {
                break;
            }
        }
        Ok(())
    }

    /// Reads the next word, and the one byte of white space, or the comment, that ends it.
    fn word(&mut self) -> io::Result<Vec<u8>> {
        self.skip_space()?;
        let mut word = Vec::new();
        while let Some(byte) = self.byte()? {
            match byte {
                b'#' => {
                    self.skip_comment()?;
                    break;
                }
                byte if is_space(byte) || word.len() > LONGEST => {
                    self.last_space = byte;
                    break;
                }
                byte => word.push(byte),
            }
        }
        Ok(word)
    }

    fn number<N: str::FromStr>(&mut self, what: &str) -> Result<N, ReadProblem> {
        let word = self.word()?;
        let text = str::from_utf8(&word).ok();
        let number = text
            .filter(|text| !text.starts_with('+'))
            .and_then(|text| text.parse().ok());
        number.ok_or_else(|| self.not_a_number(what, &word))
    }

    fn not_a_number(&self, what: &str, word: &[u8]) -> ReadProblem {
        self.broken(format!("{what} is \"{}\": expected a number", start(word)))
    }

    fn size(&mut self) -> Result<[usize; 2], ReadProblem> {
        let width = self.number("the width")?;
        let height = self.number("the height")?;
        Ok(checked_size(self.kind.name, width, height)?)
    }

    /// Reads the header of a PAM file and its samples.
    fn arbitrary(&mut self) -> Result<FilePicture, ReadProblem> {
        let names = ["WIDTH", "HEIGHT", "DEPTH", "MAXVAL"];
        let mut values = [None; 4];
        let (mut tuple_type, mut type_follows) = (Vec::new(), false);
        loop {
            let word = self.word()?;
            match names.iter().position(|known| known.as_bytes() == word) {
                Some(index) => values[index] = Some(self.number(names[index])?),
                None if word == b"ENDHDR" => break,
                None if word == b"TUPLTYPE" => type_follows = true,
                None if type_follows => (tuple_type, type_follows) = (word, false),
                None if word.is_empty() && self.peek()?.is_none() => {
                    return Err(self.broken("it ends too early: expected a line ENDHDR"));
                }
                None => {
                    let expected = "WIDTH, HEIGHT, DEPTH, MAXVAL, TUPLTYPE or ENDHDR";
                    let problem =
                        format!("a line begins with {}: expected {expected}", start(&word));
                    return Err(self.broken(problem));
                }
            }
        }
        // Samples begin after the line, which may end in CR LF.
        while self.last_space != b'\n' {
            match self.byte()? {
                Some(byte) => self.last_space = byte,
                None => break,
            }
        }
        let mut stated = [0u64; 4];
        for ((stated, value), name) in stated.iter_mut().zip(values).zip(names) {
            let missing = || self.broken(format!("its header has no {name}"));
            *stated = value.ok_or_else(missing)?;
        }
        let [width, height, depth, maximum] = stated;
        let size = checked_size(self.kind.name, width, height)?;
        let known = match &*tuple_type {
            b"" => (1..=4).contains(&depth).then_some(depth),
            b"BLACKANDWHITE" | b"GRAYSCALE" => Some(1),
            b"BLACKANDWHITE_ALPHA" | b"GRAYSCALE_ALPHA" => Some(2),
            b"RGB" => Some(3),
            b"RGB_ALPHA" => Some(4),
            _ => None,
        };
        // A deeper picture would have samples that the type does not name, and they would be
        // ignored. Nobody writes such files.
        if known != Some(depth) {
            let found = format!("{depth} samples a pixel of type `{}`", start(&tuple_type));
            let expected = "1 (GRAYSCALE), 2 (GRAYSCALE_ALPHA), 3 (RGB) or 4 (RGB_ALPHA)";
            return Err(self.broken(format!("it has {found}: expected {expected}")));
        }
        self.integers(size, depth as usize, maximum)
    }

    /// Reads integer samples: grey; grey and alpha; red, green, blue; or these and alpha. `maximum`
    /// stands for full intensity.
    fn integers(
        &mut self,
        size: [usize; 2],
        channels: usize,
        maximum: u64,
    ) -> Result<FilePicture, ReadProblem> {
        let maximum = match u16::try_from(maximum) {
            Ok(maximum @ 1..) => maximum,
            _ => {
                let problem = format!("the largest sample is {maximum}: expected 1 to 65535");
                return Err(self.broken(problem));
            }
        };
        // If the last line of the header ends in CR LF, the format says that LF is the first
        // sample, and the last byte of the file is left over. That byte may look like white space,
        // and is not.
        self.may_be_shifted = self.last_space == b'\r' && self.peek()? == Some(b'\n');
        let pixels = match 255 % maximum {
            // Every sample is a whole grey level.
            0 => {
                let factor = 255 / maximum;
                let level = |sample| (sample * factor) as u8;
                FilePixels::Stored(self.pixels(size, channels, maximum, level)?)
            }
            _ => FilePixels::Deep {
                picture: self.pixels(size, channels, maximum, |sample| sample)?,
                maximum,
            },
        };
        Ok(FilePicture {
            has_alpha: channels.is_multiple_of(2),
            ..FilePicture::of_pixels(pixels)
        })
    }

    /// Reads rows of samples into pixels.
    fn pixels<S: Copy>(
        &mut self,
        [width, height]: [usize; 2],
        channels: usize,
        maximum: u16,
        stored: impl Fn(u16) -> S,
    ) -> Result<Picture<[S; 4]>, ReadProblem> {
        let full = stored(maximum);
        let mut pixels = reserved(width, height)?;
        let mut row = vec![0u16; width * channels];
        let mut bytes = Vec::new();
        for y in 0..height {
            match self.kind.layout {
                Layout::PlainBits => self.plain_bits(&mut row)?,
                Layout::Plain(_) => {
                    for sample in &mut row {
                        *sample = self.plain_sample()?;
                    }
                }
                Layout::RawBits => {
                    self.raw_row(&mut bytes, width.div_ceil(8), y, height)?;
                    for (x, sample) in row.iter_mut().enumerate() {
                        // In PBM a set bit is black.
                        *sample = u16::from(bytes[x / 8] >> (7 - x % 8) & 1 == 0);
                    }
                }
                _ if maximum < 256 => {
                    self.raw_row(&mut bytes, row.len(), y, height)?;
                    for (sample, byte) in row.iter_mut().zip(&bytes) {
                        *sample = u16::from(*byte);
                    }
                }
                _ => {
                    self.raw_row(&mut bytes, 2 * row.len(), y, height)?;
                    for (sample, pair) in row.iter_mut().zip(bytes.as_chunks().0) {
                        *sample = u16::from_be_bytes(*pair);
                    }
                }
            }
            if let Some(sample) = row.iter().find(|sample| **sample > maximum) {
                return Err(self.broken(format!(
                    "a sample is {sample}: expected at most {maximum}, as its header says"
                )));
            }
            pixels.extend(row.chunks_exact(channels).map(|samples| {
                let at = |channel: usize| stored(samples[channel]);
                match channels {
                    1 => [at(0), at(0), at(0), full],
                    2 => [at(0), at(0), at(0), at(1)],
                    3 => [at(0), at(1), at(2), full],
                    _ => [at(0), at(1), at(2), at(3)],
                }
            }));
        }
        Ok(whole(width, height, pixels))
    }

    /// Reads `count` bytes: row `y` of `height`.
    fn raw_row(
        &mut self,
        bytes: &mut Vec<u8>,
        count: usize,
        y: usize,
        height: usize,
    ) -> Result<(), ReadProblem> {
        bytes.resize(count, 0);
        let found = self.fill(bytes)?;
        if found == count {
            return Ok(());
        }
        let (expected, found) = (height * count, y * count + found);
        let samples = format!("expected {expected} bytes of samples, found {found}");
        Err(self.broken(format!("it ends too early: {samples}")))
    }

    /// Reads digits, which need no space between them.
    fn plain_bits(&mut self, row: &mut [u16]) -> Result<(), ReadProblem> {
        for sample in row {
            self.skip_space()?;
            *sample = match self.byte()? {
                Some(b'0') => 1,
                Some(b'1') => 0,
                Some(byte) => {
                    let found = byte.escape_ascii();
                    let problem = format!("a sample is \"{found}\": expected 0 or 1");
                    return Err(self.broken(problem));
                }
                None => return Err(self.broken("it ends too early: samples are missing")),
            };
        }
        Ok(())
    }

    fn plain_sample(&mut self) -> Result<u16, ReadProblem> {
        self.skip_space()?;
        if self.peek()?.is_none() {
            return Err(self.broken("it ends too early: samples are missing"));
        }
        let sample: u64 = self.number("a sample")?;
        let problem = || self.broken(format!("a sample is {sample}: expected at most 65535"));
        u16::try_from(sample).map_err(|_| problem())
    }

    /// Returns what follows the picture.
    ///
    /// # Errors
    /// If anything but white space or another picture follows. The file then holds more than its
    /// header says.
    fn rest(&mut self) -> Result<Rest, ReadProblem> {
        let is_text = matches!(self.kind.layout, Layout::PlainBits | Layout::Plain(_));
        let has_more = self.peek()?.is_some();
        if is_text {
            self.skip_space()?;
        } else if !self.may_be_shifted {
            while self.peek()?.is_some_and(is_space) {
                self.input.consume(1);
            }
        }
        let mut next = [0; 3];
        let found = self.fill(&mut next)?;
        match Kind::announced(&next[..found]) {
            Some(_) => Ok(Rest::Picture),
            None if found == 0 && has_more && !is_text => Ok(Rest::Space),
            None if found == 0 => Ok(Rest::Nothing),
            None if self.may_be_shifted => {
                let expected = "expected one byte of white space before its samples, found CR LF";
                Err(self.broken(format!("it goes on after its last pixel: {expected}")))
            }
            None => {
                let expected = "expected its end, or another picture";
                Err(self.broken(format!("it goes on after its last pixel: {expected}")))
            }
        }
    }

    /// Reads the rest of a PFM file, in either byte order. The size of the scale is ignored,
    /// because programs do not agree on its unit.
    fn floats(&mut self, channels: usize) -> Result<FilePicture, ReadProblem> {
        let [width, height] = self.size()?;
        let scale: f32 = self.number("the scale")?;
        if scale == 0.0 || !scale.is_finite() {
            let expected = "expected a negative or a positive number";
            return Err(self.broken(format!("the scale tells no order of bytes: {expected}")));
        }
        let float = if scale < 0.0 {
            f32::from_le_bytes
        } else {
            f32::from_be_bytes
        };
        let mut pixels = reserved(width, height)?;
        let mut bytes = Vec::new();
        for y in 0..height {
            self.raw_row(&mut bytes, 4 * channels * width, y, height)?;
            let samples = bytes.as_chunks().0;
            pixels.extend(samples.chunks_exact(channels).map(|samples| {
                // A grey picture has one channel, which the remainder takes for all three.
                let at = |channel: usize| float(samples[channel % channels]);
                [at(0), at(1), at(2), 1.0]
            }));
        }
        if self.peek()?.is_some() {
            let problem = "it goes on after its last pixel: expected its end";
            return Err(self.broken(problem));
        }
        // The file has the bottom row first: swap the rows.
        for y in 0..height / 2 {
            let (upper, lower) = pixels.split_at_mut((height - 1 - y) * width);
            upper[y * width..][..width].swap_with_slice(&mut lower[..width]);
        }
        let picture = whole(width, height, pixels);
        Ok(FilePicture {
            has_alpha: false,
            ..FilePicture::of_pixels(FilePixels::Linear(picture))
        })
    }

    fn broken(&self, problem: impl Into<String>) -> ReadProblem {
        DecodeError::malformed(self.kind.name, problem).into()
    }
}

/// Makes a picture of the pixels, all of which were read.
fn whole<P: Copy>(width: usize, height: usize, pixels: Vec<P>) -> Picture<P> {
    debug_assert!(pixels.len() as u64 <= MAX_PIXELS, "the size was checked");
    Picture::from_pixels(width, height, pixels).expect("every row was read")
}

/// Returns the start of a word for a message.
fn start(word: &[u8]) -> impl fmt::Display {
    word[..word.len().min(20)].escape_ascii()
}

/// True for white space as these formats define it.
fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r')
}
