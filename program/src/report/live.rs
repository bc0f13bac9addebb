//! The parts that the page needs to draw a scene itself: the module, and the scene with its files.

use alloc::string::{String, ToString};
use alloc::vec::Vec;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use fastphong_report::MODULE;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde_json::json;
use std::io::Write;

/// The most visible polygons of a scene that readers can turn on the page. A third of them turn at
/// 24 frames a second (docs/performance.md).
pub const MOST_POLYGONS: usize = 150_000;

/// The most packed bytes of a scene's files in the page.
const MOST_PACKED: usize = 300_000;

/// The most bytes of a mesh file in the page: packing reduces text to a tenth at best.
pub const MOST_BYTES: u64 = 10 * MOST_PACKED as u64;

/// Writes a scene that the page can draw, as JSON: `scene`, its text in TOML, and `files`, names
/// and packed contents. Files have the names that the scene uses. Returns `None` if the files are
/// too large for the page.
pub fn live_scene(scene: &str, files: &[(String, Vec<u8>)]) -> Option<String> {
    let packed: Vec<(&String, String)> = files
        .iter()
        .map(|(name, bytes)| (name, packed(bytes)))
        .collect();
    let size: usize = packed.iter().map(|(_, text)| text.len()).sum();
    (size <= MOST_PACKED).then(|| json!({ "scene": scene, "files": packed }).to_string())
}

/// Returns the packed module as JSON, which the page unpacks.
pub(super) fn module() -> String {
    json!(packed(MODULE)).to_string()
}

/// Deflates bytes and writes them in base 64.
pub(super) fn packed(bytes: &[u8]) -> String {
    let mut deflate = ZlibEncoder::new(Vec::new(), Compression::new(9));
    let written = deflate.write_all(bytes).and_then(|()| deflate.finish());
    STANDARD.encode(written.expect("memory takes all that is written"))
}
