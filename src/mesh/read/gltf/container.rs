//! The container of a glTF file: JSON alone, or a GLB file of chunks.

use super::super::error::{Place, Refusal};
use super::super::words::text_end;
use std::format;

/// The first bytes of a GLB file.
pub(super) const GLB: &[u8] = b"glTF";
/// The bytes of a GLB header: `glTF`, the version, the length of the file.
const HEADER: usize = 12;
/// The bytes before a chunk: its length and its type.
const OF_CHUNK: usize = 8;

/// The parts of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    /// The binary chunk of a GLB file.
    pub bin: Option<&'a [u8]>,
    /// True for a GLB file, whose JSON has no lines that a reader could look up.
    pub is_glb: bool,
}

/// Returns the parts of `bytes`. Chunks of unknown types are ignored, and so is what follows the
/// end that a GLB file states, unless it is a whole chunk.
///
/// # Errors
/// If there is no JSON, or a chunk is longer than the file.
pub(super) fn open(bytes: &[u8]) -> Result<Container<'_>, Refusal> {
    let parts = if bytes.starts_with(GLB) {
        open_glb(bytes)?
    } else {
        Container {
            json: bytes,
            bin: None,
            is_glb: false,
        }
    };
    let json = parts.json;
    let json = text_end(json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json));
    if json.is_empty() {
        return Err(Refusal::whole("is empty: expected a glTF file"));
    }
    Ok(Container { json, ..parts })
}

fn open_glb(bytes: &[u8]) -> Result<Container<'_>, Refusal> {
    let have = bytes.len();
    let u32_at = |at: usize| {
        let four = bytes.get(at..).and_then(|rest| rest.first_chunk());
        four.map(|four| u32::from_le_bytes(*four))
    };
    let (Some(version), Some(stated)) = (u32_at(4), u32_at(8)) else {
        let problem =
            format!("the file ends after {have} bytes: expected {HEADER} of a GLB header");
        return Err(Refusal::at(Place::Byte(have), problem));
    };
    match version {
        1 => return Err(super::document::version_1()),
        2 => {}
        _ => {
            let problem = format!("is a GLB file of version {version}: expected version 2");
            return Err(Refusal::whole(problem));
        }
    }
    if stated as usize > have {
        let problem = format!("the file says {stated} bytes and has {have}: expected all of them");
        return Err(Refusal::at(Place::Byte(8), problem));
    }
    let least = HEADER + OF_CHUNK;
    if (stated as usize) < least {
        let problem = format!("the file says {stated} bytes: expected at least {least}");
        return Err(Refusal::at(Place::Byte(8), problem));
    }
    let (mut json, mut bin, mut at) = (None, None, HEADER);
    while let (Some(length), Some(kind)) = (u32_at(at), bytes.get(at + 4..at + OF_CHUNK)) {
        let (name, slot) = match kind {
            b"JSON" => ("JSON", &mut json),
            b"BIN\0" => ("binary", &mut bin),
            _ => ("", &mut None),
        };
        let rest = &bytes[at + OF_CHUNK..];
        match (rest.get(..length as usize), name) {
            (Some(chunk), _) => *slot = slot.or(Some(chunk)),
            // The last chunk has no type that matters, or these bytes are no chunk at all.
            (None, "") => break,
            (None, _) if slot.is_some() || at >= stated as usize => break,
            (None, name) => {
                let left = rest.len();
                let problem = format!(
                    "its {name} chunk says {length} bytes and has {left}: expected all of them"
                );
                return Err(Refusal::at(Place::Byte(at), problem));
            }
        }
        at += OF_CHUNK + length as usize;
    }
    let json = json.ok_or_else(|| Refusal::whole("has no JSON chunk: expected one of glTF 2.0"))?;
    Ok(Container {
        json,
        bin,
        is_glb: true,
    })
}
