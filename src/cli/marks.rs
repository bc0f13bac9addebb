//! The marks by which the program knows files that it made: where it chooses a name, it replaces no others.
//!
//! A PNG file has a chunk that names its software, a page its title, Markdown the command that made it, a manual page its own name.
//! PPM and PFM have no room for a mark: there any picture of the format counts as one's own.

use super::files;
use super::output::Contents;
use fastphong::picture::image_file::Format;
use std::path::Path;

/// Bytes at the beginning of a file in which its mark stands.
const BEGINNING: u64 = 1 << 14;

/// Kind and data of the chunk by which a PNG file names its software (ISO/IEC 15948, 11.3.3.3).
const SOFTWARE: &[u8] = b"tEXtSoftware\0fastphong";

/// True if nothing is at `path` that would be lost: no file, no plain one, or one with the mark of these contents.
pub fn is_free(path: &Path, contents: Contents) -> bool {
    files::beginning(path, BEGINNING).is_none_or(|bytes| is_marked(&bytes, contents))
}

/// True if a file that begins with `bytes` has the mark of these contents.
fn is_marked(bytes: &[u8], contents: Contents) -> bool {
    let has = |mark: &[u8]| bytes.windows(mark.len()).any(|part| part == mark);
    match contents {
        Contents::Picture(Format::Png) => has(SOFTWARE),
        Contents::Picture(Format::Ppm) => bytes.starts_with(b"P6\n"),
        Contents::Picture(Format::Pfm) => bytes.starts_with(b"PF\n"),
        Contents::Page => has(b"<title>fastphong: "),
        Contents::Markdown => has(b"Made by `fastphong "),
        Contents::Manual => has(b".TH fastphong"),
        // No command chooses names for these.
        Contents::Json | Contents::Csv => false,
    }
}
