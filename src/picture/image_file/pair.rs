//! Two picture files made comparable in encoding, alpha and size.

use super::{FilePicture, FilePixels};
use crate::picture::{Encoding, LevelRows, Levels, over};
use core::fmt;
use std::format;
use std::string::String;

/// The encoding in which a picture is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UsedEncoding {
    /// The encoding.
    pub encoding: Encoding,
    /// True if the file states it, false if it was assumed.
    pub is_stated: bool,
}

impl UsedEncoding {
    /// Returns the encoding that `picture` states. Otherwise returns `assumed`, or else linear for
    /// floats and sRGB for integers.
    pub(super) fn of(picture: &FilePicture, assumed: Option<Encoding>) -> UsedEncoding {
        let usual = match picture.pixels {
            FilePixels::Linear(_) => Encoding::Linear,
            FilePixels::Stored(_) | FilePixels::Deep { .. } => Encoding::Srgb,
        };
        UsedEncoding {
            encoding: picture.encoding.or(assumed).unwrap_or(usual),
            is_stated: picture.encoding.is_some(),
        }
    }
}

/// What alpha does in a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlphaUse {
    /// Neither file has alpha.
    Absent,
    /// Both files have alpha. It is compared like a channel, and colours under alpha 0 are ignored.
    Compared,
    /// One file has alpha and states a background. Its picture is put over that background.
    Flattened {
        /// True if that file is the reference.
        of_reference: bool,
    },
    /// One file has alpha and states no background. The other file counts as opaque, and alpha is
    /// compared.
    Opaque {
        /// True if that file is the reference.
        of_reference: bool,
    },
}

/// A reference picture and an actual picture, to be compared.
///
/// Two pictures in one encoding are compared as stored. If the encodings differ, the linear picture
/// is encoded as sRGB, without rounding. If the sizes differ, the part that both have is compared,
/// from the upper left corner on.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    pictures: [&'a FilePicture; 2],
    encodings: [UsedEncoding; 2],
    alpha: AlphaUse,
}

impl<'a> Pair<'a> {
    /// Makes a pair. `assumed` is the encoding of files that state none. Without it, PFM counts as
    /// linear and all other formats as sRGB.
    pub fn new(
        reference: &'a FilePicture,
        actual: &'a FilePicture,
        assumed: Option<Encoding>,
    ) -> Pair<'a> {
        let pictures = [reference, actual];
        let of_reference = reference.has_alpha;
        let alpha = match [reference.has_alpha, actual.has_alpha] {
            [false, false] => AlphaUse::Absent,
            [true, true] => AlphaUse::Compared,
            _ => {
                let has_alpha = if of_reference { reference } else { actual };
                match has_alpha.background {
                    _ if is_opaque(has_alpha) => AlphaUse::Absent,
                    Some(_) => AlphaUse::Flattened { of_reference },
                    None => AlphaUse::Opaque { of_reference },
                }
            }
        };
        Pair {
            pictures,
            encodings: pictures.map(|picture| UsedEncoding::of(picture, assumed)),
            alpha,
        }
    }

    /// Returns the pair as if both pictures had the encoding of the reference.
    #[doc(hidden)]
    pub fn as_stored(&self) -> Pair<'a> {
        Pair {
            encodings: [self.encodings[0]; 2],
            ..*self
        }
    }

    /// Returns the encodings of the reference and of the actual picture.
    pub fn encodings(&self) -> [UsedEncoding; 2] {
        self.encodings
    }

    /// Returns the encoding in which the pictures are compared.
    pub fn compared_encoding(&self) -> Encoding {
        match self.encodings.map(|used| used.encoding) {
            [Encoding::Linear, Encoding::Linear] => Encoding::Linear,
            _ => Encoding::Srgb,
        }
    }

    /// Returns what alpha does in the comparison.
    pub fn alpha(&self) -> AlphaUse {
        self.alpha
    }

    /// Returns width and height of the part that both pictures have, in pixels.
    pub fn common_size(&self) -> [usize; 2] {
        let [reference, actual] = self.pictures.map(FilePicture::size);
        [0, 1].map(|i| reference[i].min(actual[i]))
    }

    /// True if both pictures have the same size.
    pub fn is_one_size(&self) -> bool {
        self.pictures[0].size() == self.pictures[1].size()
    }

    /// True if the pictures have different encodings, so that the linear one is encoded before they
    /// are compared.
    #[doc(hidden)]
    pub fn has_two_encodings(&self) -> bool {
        self.encodings[0].encoding != self.encodings[1].encoding
    }

    /// Returns the line about the encodings of the pictures, stated or assumed. `names` are the
    /// names of the reference and the other picture.
    #[doc(hidden)]
    pub fn encodings_text(&self, names: [impl fmt::Display; 2]) -> String {
        let [reference, actual] = [0, 1].map(|i| {
            let (name, used) = (&names[i], self.encodings[i]);
            let encoding = used.encoding.name();
            if used.is_stated {
                format!("{name} states {encoding}")
            } else {
                format!("{name} states none, {encoding} is assumed")
            }
        });
        let encoded = if self.has_two_encodings() {
            "; the linear picture was encoded as srgb, unrounded"
        } else {
            ""
        };
        format!("encodings: {reference}; {actual}{encoded}\n")
    }

    /// Returns a note on alpha if only one of the pictures has it. `names` are the names of the
    /// reference and the other picture.
    #[doc(hidden)]
    pub fn alpha_text(&self, names: [impl fmt::Display; 2]) -> Option<String> {
        let (of_reference, done) = match self.alpha {
            AlphaUse::Absent | AlphaUse::Compared => return None,
            AlphaUse::Flattened { of_reference } => {
                (of_reference, "is drawn over the background that it states")
            }
            AlphaUse::Opaque { of_reference } => {
                let done =
                    "states no background to draw it over, and is compared with an opaque picture";
                (of_reference, done)
            }
        };
        let [reference, actual] = names;
        Some(if of_reference {
            format!("{actual} has no alpha: {reference} {done}")
        } else {
            format!("{reference} has no alpha: {actual} {done}")
        })
    }

    /// Returns the reference and the actual picture as they are compared.
    pub fn compared(&self) -> [impl LevelRows + Copy + use<'a>; 2] {
        [0, 1].map(|i| LevelView {
            background: match self.alpha {
                AlphaUse::Flattened { .. } => Some(self.background(i, self.pictures[i])),
                _ => None,
            },
            keeps_alpha: matches!(self.alpha, AlphaUse::Compared | AlphaUse::Opaque { .. }),
            ..self.view(i, self.compared_encoding())
        })
    }

    /// Returns both pictures as a screen shows them: in sRGB, clamped between black and white, over
    /// one background. It is the reference's background, or else the actual picture's, or else
    /// black.
    pub fn displayed(&self) -> [impl LevelRows + Copy + use<'a>; 2] {
        let [reference, actual] = self.pictures;
        let stating = if reference.background.is_some() {
            reference
        } else {
            actual
        };
        [0, 1].map(|i| LevelView {
            background: match self.alpha {
                AlphaUse::Absent => None,
                AlphaUse::Compared | AlphaUse::Flattened { .. } | AlphaUse::Opaque { .. } => {
                    Some(self.background(i, stating))
                }
            },
            is_clamped: true,
            ..self.view(i, Encoding::Srgb)
        })
    }

    fn view(&self, index: usize, encoding: Encoding) -> LevelView<'a> {
        let (from, to) = (self.encodings[index].encoding, encoding);
        let whole = || core::array::from_fn(|level| converted(level as f64, from, to));
        LevelView {
            picture: self.pictures[index],
            size: self.common_size(),
            from,
            to,
            whole: (from != to).then(whole),
            background: None,
            keeps_alpha: false,
            is_clamped: false,
        }
    }

    /// Returns the background that `stating` states, in levels of the picture with this index;
    /// black if it states none.
    fn background(&self, index: usize, stating: &FilePicture) -> [f64; 3] {
        let of_reference = core::ptr::eq(stating, self.pictures[0]);
        let from = self.encodings[usize::from(!of_reference)].encoding;
        let to = self.encodings[index].encoding;
        let background = stating.background.unwrap_or_default();
        background.map(|level| converted(level, from, to))
    }
}

/// True if every pixel is fully covered.
pub(super) fn is_opaque(picture: &FilePicture) -> bool {
    match &picture.pixels {
        FilePixels::Stored(picture) => picture.pixels().iter().all(|pixel| pixel[3] == 255),
        FilePixels::Deep { picture, maximum } => {
            picture.pixels().iter().all(|pixel| pixel[3] == *maximum)
        }
        FilePixels::Linear(picture) => picture.pixels().iter().all(|pixel| pixel[3] == 1.0),
    }
}

/// Converts a grey level to another encoding, without rounding.
fn converted(level: f64, from: Encoding, to: Encoding) -> f64 {
    if from == to {
        level
    } else {
        255.0 * to.encode(from.decode(level / 255.0))
    }
}

/// A picture of a file, read row by row in the grey levels in which it is compared or shown.
#[derive(Clone, Copy, Debug)]
struct LevelView<'a> {
    picture: &'a FilePicture,
    size: [usize; 2],
    /// The encoding of the file.
    from: Encoding,
    /// The encoding of the returned levels.
    to: Encoding,
    /// The background to put the picture over, in the encoding of the file.
    background: Option<[f64; 3]>,
    /// True if alpha is returned; otherwise it is full.
    keeps_alpha: bool,
    /// The 256 whole levels, converted, if the encodings differ.
    whole: Option<[f64; 256]>,
    /// True if levels are clamped to 0..=255. NaN then becomes 0.
    is_clamped: bool,
}

/// Puts a pixel over `background` in linear light, and returns its colour in the encoding of the
/// file.
pub(super) fn flattened(pixel: Levels, background: [f64; 3], encoding: Encoding) -> [f64; 3] {
    let alpha = pixel.alpha();
    if alpha == 0.0 {
        return background;
    }
    if alpha == 255.0 {
        return pixel.rgb();
    }
    let linear = |level: f64| encoding.decode(level / 255.0);
    let [r, g, b] = pixel.rgb().map(linear);
    let linear = over([r, g, b, alpha / 255.0], background.map(linear));
    linear.map(|c| 255.0 * encoding.encode(c))
}

impl LevelRows for LevelView<'_> {
    fn size(&self) -> [usize; 2] {
        self.size
    }

    fn level_row(&self, y: usize, levels: &mut [Levels]) {
        self.picture.stored_levels(y, levels);
        for pixel in levels {
            let mut rgb = match self.background {
                Some(background) => flattened(*pixel, background, self.from),
                None => pixel.rgb(),
            };
            if let Some(whole) = &self.whole {
                rgb = rgb.map(|level| match level as u8 {
                    byte if f64::from(byte) == level => whole[usize::from(byte)],
                    _ => converted(level, self.from, self.to),
                });
            }
            if self.is_clamped {
                // NaN fails the first comparison and becomes 0.
                rgb = rgb.map(|level| if level > 0.0 { level.min(255.0) } else { 0.0 });
            }
            let [r, g, b] = rgb;
            let alpha = if self.keeps_alpha {
                pixel.alpha()
            } else {
                255.0
            };
            *pixel = Levels([r, g, b, alpha]);
        }
    }
}
