//! What a file that should hold text holds instead, told by its first bytes.

/// The first bytes of files that are met under the names of meshes and of material libraries.
const SIGNATURES: [(&[u8], &str); 11] = [
    (b"\xff\xfe", UTF_16),
    (b"\xfe\xff", UTF_16),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"%PDF", "a PDF document"),
    (b"glTF", "a binary glTF file"),
    (b"<?xml", "an XML document"),
    (
        b"version https://git-lfs.github.com",
        "a pointer of Git LFS, not the file (`git lfs pull` fetches it)",
    ),
];

const UTF_16: &str = "UTF-16 text (not UTF-8)";

/// Returns what `bytes` are, if they are plainly no text that OBJ and MTL files could hold.
pub(super) fn foreign(bytes: &[u8]) -> Option<&'static str> {
    let known = SIGNATURES
        .iter()
        .find(|(start, _)| bytes.starts_with(start));
    match bytes {
        _ if known.is_some() => known.map(|(_, what)| *what),
        // The ASCII characters of UTF-16 without a byte-order mark.
        [1..=127, 0, 1..=127, 0, ..] | [0, 1..=127, 0, 1..=127, ..] => Some(UTF_16),
        _ if is_html(bytes) => Some("a page of HTML"),
        _ => None,
    }
}

fn is_html(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = bytes.trim_ascii_start();
    let starts: [&[u8]; 3] = [b"<!doctype html", b"<html", b"<head"];
    starts.iter().any(|start| {
        let begin = text.get(..start.len());
        begin.is_some_and(|begin| begin.eq_ignore_ascii_case(start))
    })
}
