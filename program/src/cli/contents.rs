//! The kinds of files that fastphong writes, and the marks by which it recognises its own. Where
//! the program chooses a file's name, it replaces only a file that has its mark.
//!
//! A PNG file has a chunk that names its software; a page has its title, Markdown the command that
//! made it, a manual page its name. PPM and PFM files carry no mark, and any picture in these
//! formats counts as ours: a PFM header allows no comments, and the short PPM readers that authors
//! of rasterizers write expect none.

use super::files;
use crate::export::{HEAD, MADE_BY};
use fastphong::picture::image_file::{FilePicture, Format};
use fastphong::picture::{Encoding, Picture8};
use std::fmt;
use std::io::{self, Write};
use std::path::Path;

/// How many bytes at the beginning of a file are searched for its mark.
const BEGINNING: u64 = 1 << 14;

/// The type and the data of the PNG chunk that names the software (ISO/IEC 15948, 11.3.3.3).
const SOFTWARE: &[u8] = b"tEXtSoftware\0fastphong";

/// The PNG chunk that marks the map of a difference: its length, type, data and checksum.
const MAP: &[u8] = b"\0\0\0\x10tEXtTitle\0Difference\xe9\x05\x92\x12";

/// How many bytes of a PNG file stand before its second chunk.
const PNG_HEADER: usize = 33;

/// Writes the map of a difference as a marked PNG file.
///
/// # Errors
/// As [`FilePicture::encode`], and any error of `out`.
pub fn write_map(map: Picture8, out: &mut dyn Write) -> io::Result<()> {
    let map = FilePicture::stored(map).encoded(Encoding::Srgb);
    let bytes = map.encode(Format::Png)?;
    let (header, rest) = bytes.split_at(PNG_HEADER);
    [header, MAP, rest]
        .iter()
        .try_for_each(|part| out.write_all(part))
}

/// True if [`write_map`] wrote the file at `path`.
pub fn is_map(path: &Path) -> bool {
    let bytes = files::beginning(path, BEGINNING).unwrap_or_default();
    bytes.windows(MAP.len()).any(|part| part == MAP)
}

/// The kind of a file's contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contents {
    /// A picture in this format.
    Picture(Format),
    /// A page in HTML.
    Page,
    /// Data in JSON.
    Json,
    /// Results of tests in XML.
    Xml,
    /// Tables in CSV.
    Csv,
    /// Text in Markdown.
    Markdown,
    /// A page of the manual.
    Manual,
    /// A file of a scene for other programs, except its picture.
    Export,
}

impl Contents {
    /// Returns the file endings for these contents.
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            Contents::Picture(Format::Png) => &["png"],
            Contents::Picture(Format::Ppm) => &["ppm"],
            Contents::Picture(Format::Pfm) => &["pfm"],
            Contents::Page => &["html", "htm"],
            Contents::Json => &["json"],
            Contents::Xml => &["xml"],
            Contents::Csv => &["csv"],
            Contents::Markdown => &["md"],
            Contents::Manual => &["1"],
            Contents::Export => &["obj", "mtl", "json", "h", "py", "csv", "txt"],
        }
    }

    /// True if writing to `path` loses nothing: there is no file, it is not a plain one, or it has
    /// the mark of these contents.
    pub fn is_own(self, path: &Path) -> bool {
        files::beginning(path, BEGINNING).is_none_or(|bytes| self.marks(&bytes))
    }

    /// True if a file that begins with `bytes` has the mark of these contents.
    fn marks(self, bytes: &[u8]) -> bool {
        let has = |mark: &[u8]| bytes.windows(mark.len()).any(|part| part == mark);
        match self {
            Contents::Picture(Format::Png) => has(SOFTWARE),
            Contents::Picture(Format::Ppm) => bytes.starts_with(b"P6\n"),
            Contents::Picture(Format::Pfm) => bytes.starts_with(b"PF\n"),
            Contents::Page => has(b"<title>fastphong: "),
            Contents::Markdown => has(b"Made by `fastphong "),
            Contents::Manual => has(b".TH fastphong"),
            // Tables have no comments, so they are known by their columns.
            Contents::Export => has(MADE_BY.as_bytes()) || bytes.starts_with(HEAD.as_bytes()),
            // No command chooses names for these.
            Contents::Json | Contents::Xml | Contents::Csv => false,
        }
    }
}

impl fmt::Display for Contents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Contents::Picture(_) => "a picture",
            Contents::Page => "a page in HTML",
            Contents::Json => "JSON",
            Contents::Xml => "XML",
            Contents::Csv => "CSV",
            Contents::Markdown => "Markdown",
            Contents::Manual => "a manual page",
            Contents::Export => "a scene for other programs",
        })
    }
}
