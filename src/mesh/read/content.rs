//! Recognises files of other formats by their bytes, so that an error can say what a file is.

/// The first bytes of files that occur under the names of meshes and material libraries.
const SIGNATURES: [(&[u8], &str); 29] = [
    // UTF-32 comes before UTF-16, because its mark begins with the mark of UTF-16.
    (b"\xff\xfe\0\0", UTF_32),
    (b"\0\0\xfe\xff", UTF_32),
    (b"\xff\xfe", UTF_16),
    (b"\xfe\xff", UTF_16),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"\x1f\x8b", "a gzip archive in a gzip archive"),
    (b"\xfd7zXZ\0", "an xz archive"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (b"BZh", "a bzip2 archive"),
    (b"\x28\xb5\x2f\xfd", "a Zstandard archive"),
    (b"Rar!\x1a\x07", "a RAR archive"),
    (b"%PDF", "a PDF document"),
    (b"glTF", "a binary glTF file"),
    (b"Kaydara FBX Binary", "a binary FBX file"),
    (b"; FBX", "a text FBX file"),
    (b"BLENDER", "a Blender file"),
    (b"#usda", "a text USD file"),
    (b"PXR-USDC", "a binary USD file"),
    (b"#VRML", "a VRML file"),
    (b"ISO-10303-21", "a STEP file"),
    (b"xof ", "a DirectX file"),
    (b"# vtk DataFile", "a VTK file"),
    (b"$MeshFormat", "a Gmsh file"),
    (b"MeshVersionFormatted", "a Medit file"),
    (b"\0\0\xff\xff", COFF),
    (b"!<arch>\n", "a library of object files"),
    (
        b"version https://git-lfs.github.com",
        "a pointer of Git LFS, not the file (`git lfs pull` fetches it)",
    ),
];

const UTF_16: &str = "UTF-16 text (not UTF-8)";
const UTF_32: &str = "UTF-32 text (not UTF-8)";
/// Compilers on Windows write these files, with the ending `.obj`.
const COFF: &str = "a compiled object file (COFF)";
const TEXT_STL: &str = "a text STL file";
const BINARY_STL: &str = "a binary STL file";

/// Returns a description of `bytes` if they are plainly not the text of an OBJ, MTL or scene file.
pub(crate) fn foreign(bytes: &[u8]) -> Option<&'static str> {
    let known = SIGNATURES
        .iter()
        .find(|(start, _)| bytes.starts_with(start));
    match bytes {
        _ if bytes.starts_with(b"PK\x03\x04") => Some(archive(bytes)),
        _ if known.is_some() => known.map(|(_, what)| *what),
        // Two ASCII characters in UTF-32 or UTF-16 without a byte-order mark.
        [1..=127, 0, 0, 0, 1..=127, 0, 0, 0, ..] | [0, 0, 0, 1..=127, 0, 0, 0, 1..=127, ..] => {
            Some(UTF_32)
        }
        [1..=127, 0, 1..=127, 0, ..] | [0, 1..=127, 0, 1..=127, ..] => Some(UTF_16),
        _ if is_binary_stl(bytes) => Some(BINARY_STL),
        _ if is_3ds(bytes) => Some("a 3DS file"),
        _ if is_coff(bytes) => Some(COFF),
        _ if is_iges(bytes) => Some("an IGES file"),
        _ if bytes.get(257..262) == Some(b"ustar") => Some("a tar archive"),
        _ => foreign_text(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)),
    }
}

/// Returns the little-endian 32-bit number at byte `at`.
fn u32_at(bytes: &[u8], at: usize) -> Option<u64> {
    let four = bytes.get(at..at + 4)?.first_chunk()?;
    Some(u32::from_le_bytes(*four).into())
}

/// True if the file is as long as its triangle count says: a header of 80 bytes, four for the
/// count, and 50 for each triangle.
pub(super) fn is_binary_stl(bytes: &[u8]) -> bool {
    let triangles = u32_at(bytes, 80).filter(|triangles| *triangles > 0);
    triangles.is_some_and(|triangles| bytes.len() as u64 == 84 + 50 * triangles)
}

/// True if the first chunk of a 3DS file is as long as the file.
fn is_3ds(bytes: &[u8]) -> bool {
    bytes.starts_with(b"MM") && u32_at(bytes, 2) == Some(bytes.len() as u64)
}

/// Returns a description of a ZIP archive. The names of the files in it, which are not compressed,
/// tell formats that are ZIP archives.
fn archive(bytes: &[u8]) -> &'static str {
    // Names stand before each file, at the start of the archive, and in the directory at its end.
    let ends = [
        bytes.len().min(1 << 12),
        bytes.len().saturating_sub(1 << 14),
    ];
    let parts = [&bytes[..ends[0]], &bytes[ends[1]..]];
    let holds = |name: &[u8]| {
        let mut parts = parts.iter();
        parts.any(|part| part.windows(name.len()).any(|window| window == name))
    };
    match () {
        _ if holds(b"3D/3dmodel.model") => "a 3MF file",
        _ if holds(b".usdc") || holds(b".usda") => "a USDZ file",
        _ => "a ZIP archive",
    }
}

/// True if the first line belongs to the start section of an IGES file: 72 columns, then `S` and
/// the line number.
fn is_iges(bytes: &[u8]) -> bool {
    let is_line = bytes.get(72..80) == Some(b"S      1") || bytes.get(72..80) == Some(b"S0000001");
    is_line && bytes[..72].is_ascii()
}

/// Returns how to make a mesh file from a file that is `what`. Messages append it to what was
/// expected; it is empty for a file without a shape.
pub(super) fn advice(what: &str) -> &'static str {
    /// A word of the descriptions above, and the advice for it.
    const ADVICE: [(&str, &str); 14] = [
        (
            "glTF",
            " (this program was built without the feature `gltf`)",
        ),
        ("FBX", "; Blender or assimp converts it"),
        ("COLLADA", "; Blender or assimp converts it"),
        ("3DS", "; assimp converts it"),
        ("DirectX", "; assimp converts it"),
        ("Blender", "; Blender itself exports one"),
        ("USD", "; Blender converts it"),
        ("VRML", "; MeshLab converts it"),
        ("X3D", "; MeshLab converts it"),
        (
            "3MF",
            "; a slicer such as PrusaSlicer, or MeshLab, converts it",
        ),
        ("AMF", "; assimp converts it"),
        ("VTK", "; meshio or ParaView converts it"),
        ("STEP", "; Gmsh or FreeCAD makes a mesh of it"),
        ("IGES", "; Gmsh or FreeCAD makes a mesh of it"),
    ];
    const MESHES: [&str; 2] = ["Gmsh", "Medit"];
    if MESHES.iter().any(|name| what.contains(name)) {
        return "; meshio converts it";
    }
    let mut known = ADVICE.iter();
    let found = known.find(|(word, _)| what.contains(word));
    found.map_or("", |(_, advice)| *advice)
}

/// True if the file has the header of a COFF object for x86, ARM or their 64-bit successors. The
/// test is strict, because text may begin with these bytes too: there must be sections, the symbols
/// must lie within the file, and there must be no header of a program.
fn is_coff(bytes: &[u8]) -> bool {
    let is_machine = matches!(
        bytes,
        [0x4c, 0x01, ..] | [0x64, 0x86, ..] | [0x64, 0xaa, ..] | [0xc4, 0x01, ..]
    );
    is_machine
        && bytes.get(2..4).is_some_and(|sections| sections != [0, 0])
        && u32_at(bytes, 8).is_some_and(|symbols| symbols <= bytes.len() as u64)
        && bytes.get(16..18) == Some(&[0, 0])
}

/// Returns a description of the text in `bytes`, by its first word outside of comments; `None` if
/// that does not tell.
fn foreign_text(bytes: &[u8]) -> Option<&'static str> {
    let text = bytes.trim_ascii_start();
    if text.starts_with(b"<") {
        return foreign_markup(text);
    }
    let is_object = || {
        let inside = text[1..].trim_ascii_start().first();
        matches!(inside, Some(b'"' | b'}'))
    };
    if text.starts_with(b"{") && is_object() {
        let has_asset = text
            .windows(7)
            .take(1 << 20)
            .any(|part| part == b"\"asset\"");
        return Some(if has_asset {
            "a glTF file (JSON)"
        } else {
            "a JSON document"
        });
    }
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r'));
    let mut lines = lines.map(<[u8]>::trim_ascii);
    let line = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"))?;
    let mut words = line.split(u8::is_ascii_whitespace);
    let word = words.next().unwrap_or_default();
    if word.eq_ignore_ascii_case(b"solid") {
        let is_binary = text.iter().take(84).any(|byte| *byte == 0);
        return Some(if is_binary { BINARY_STL } else { TEXT_STL });
    }
    // Letters before `OFF` stand for texture coordinates, colours, normals, a fourth coordinate and
    // a dimension.
    let off = word.strip_suffix(b"OFF");
    match word {
        b"ply" if words.next().is_none() => Some("a PLY file"),
        b"COFF" => Some("an OFF file with colours (COFF)"),
        _ if off.is_some_and(|kind| kind.iter().all(|letter| b"STCN4n".contains(letter))) => {
            Some("an OFF file")
        }
        _ => None,
    }
}

/// Returns a description of a text that begins with `<`.
fn foreign_markup(text: &[u8]) -> Option<&'static str> {
    let begins = |start: &[u8]| {
        let begin = text.get(..start.len());
        begin.is_some_and(|begin| begin.eq_ignore_ascii_case(start))
    };
    let head = &text[..text.len().min(4096)];
    let holds = |tag: &[u8]| head.windows(tag.len()).any(|part| part == tag);
    match () {
        _ if holds(b"<COLLADA") => Some("a COLLADA file"),
        _ if holds(b"<X3D") => Some("an X3D file"),
        _ if holds(b"<VTKFile") => Some("a VTK file"),
        _ if holds(b"<amf") => Some("an AMF file"),
        _ if begins(b"<!doctype html") || begins(b"<html") || begins(b"<head") => {
            Some("a page of HTML")
        }
        _ if begins(b"<?xml") => Some("an XML document"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec;
    use std::vec::Vec;

    #[test]
    fn formats_are_recognised_by_their_bytes() {
        let mut stl = vec![b' '; 80];
        stl.extend(2u32.to_le_bytes());
        stl.extend([0; 100]);
        let mut solid = stl.clone();
        solid[..5].copy_from_slice(b"solid");
        let mut coff = vec![0x64, 0x86, 3, 0];
        coff.extend([0; 60]);
        let text = "v 0 0 0\n".chars();
        let utf_32: Vec<u8> = text.flat_map(|c| u32::from(c).to_le_bytes()).collect();
        let marked = [&b"\xff\xfe\0\0"[..], &utf_32].concat();
        for (bytes, what) in [
            (&b"solid cube\n facet normal 0 0 1\n"[..], TEXT_STL),
            (b"# by hand\r\nSOLID\r\n", TEXT_STL),
            (&stl, BINARY_STL),
            (&solid, BINARY_STL),
            (b"ply\nformat ascii 1.0\n", "a PLY file"),
            (b"OFF\n8 6 12\n", "an OFF file"),
            (b"STNOFF 8 6 12\n", "an OFF file"),
            (b"# OFF\nCOFF\n8 6 12\n", "an OFF file with colours (COFF)"),
            (
                b"\xef\xbb\xbf {\"asset\": {\"version\": \"2.0\"}}",
                "a glTF file (JSON)",
            ),
            (b"{}", "a JSON document"),
            (b"glTF\x02\0\0\0", "a binary glTF file"),
            (b"Kaydara FBX Binary  \0\x1a\0", "a binary FBX file"),
            (b"; FBX 7.3.0 project file\n", "a text FBX file"),
            (&coff, COFF),
            (b"\0\0\xff\xff\x01\0\x64\x86", COFF),
            (&utf_32, UTF_32),
            (&marked, UTF_32),
            (b"\xff\xfev\0 \0", UTF_16),
            (b"<?xml version=\"1.0\"?>\n<COLLADA>", "a COLLADA file"),
            (b"PK\x03\x04..3D/3dmodel.model", "a 3MF file"),
            (b"PK\x03\x04", "a ZIP archive"),
            (b"# vtk DataFile Version 3.0", "a VTK file"),
        ] {
            assert_eq!(foreign(bytes), Some(what), "{bytes:?}");
        }
    }

    #[test]
    fn texts_that_may_be_meshes_are_not_foreign() {
        for text in [
            "",
            "# solid\nv 0 0 0\n",
            "o solid\n",
            "off\n",
            "s off\n",
            "plyboard\n",
            "d\u{86}\n",
            "hello\n",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        ] {
            assert_eq!(foreign(text.as_bytes()), None, "{text:?}");
        }
        // 84 letters are no STL file: the count that the letters spell does not fit the length.
        assert_eq!(foreign(&[b'v'; 84]), None);
    }
}
