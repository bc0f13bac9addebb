//! The binary data of a glTF file. An accessor describes values, a view is a range of bytes, and a
//! buffer is a file or a part of this one.

use super::super::Beside;
use super::super::error::{Refusal, quote};
use base64::Engine;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};
use gltf::accessor::DataType;
use gltf::accessor::sparse::IndexType;
use gltf::buffer::{Source, View};
use gltf::{Accessor, Document};
use std::collections::HashMap;
use std::format;
use std::string::String;
use std::vec;
use std::vec::Vec;

/// The most bytes that all buffers may have together. Many buffers may name one file.
const MOST: usize = 1 << 30;

/// The buffers of a file.
pub(super) struct Buffers {
    bytes: HashMap<usize, Vec<u8>>,
    /// The bytes of all buffers. It also limits accessors that have no bytes and would be all
    /// zeros.
    total: usize,
}

impl Buffers {
    /// Reads the buffers of `document`. `bin` is the one inside a GLB file.
    ///
    /// # Errors
    /// If one cannot be read, or all together are over the limit.
    pub(super) fn read(
        document: &Document,
        bin: Option<Vec<u8>>,
        beside: Beside,
    ) -> Result<Buffers, Refusal> {
        let mut bin = bin;
        let mut buffers = Buffers {
            bytes: HashMap::new(),
            total: 0,
        };
        for buffer in document.buffers() {
            let index = buffer.index();
            let bytes = match buffer.source() {
                Source::Bin => bin.take().ok_or_else(|| {
                    let expected = "expected a binary chunk or a `uri`";
                    Refusal::whole(format!("buffer {index} has no bytes: {expected}"))
                })?,
                Source::Uri(uri) => read_uri(index, uri, beside)?,
            };
            buffers.total = buffers.total.saturating_add(bytes.len());
            if buffers.total > MOST {
                let most = MOST >> 20;
                let problem = format!("its buffers are over {most} MiB: expected at most that");
                return Err(Refusal::whole(problem));
            }
            buffers.bytes.insert(index, bytes);
        }
        Ok(buffers)
    }

    /// Returns the bytes of a view from `offset` on, as far as they exist.
    fn view(&self, view: &View, offset: usize) -> &[u8] {
        let all = self.bytes.get(&view.buffer().index());
        let all = all.map_or(&[][..], |bytes| &bytes[..]);
        let own = all.get(view.offset()..).unwrap_or_default();
        let own = &own[..own.len().min(view.length())];
        own.get(offset..).unwrap_or_default()
    }

    /// Checks that a view lies within its buffer.
    fn check_view(&self, view: &View) -> Result<(), Refusal> {
        let held = self.bytes.get(&view.buffer().index()).map_or(0, Vec::len);
        match view.offset().checked_add(view.length()) {
            Some(end) if end <= held => Ok(()),
            _ => {
                let index = view.index();
                let expected = format!("expected it to end within {held} bytes");
                let problem = format!("buffer view {index} reaches beyond its buffer: {expected}");
                Err(Refusal::whole(problem))
            }
        }
    }

    /// Reads the elements of an accessor as `N` values each. Normalised integers become fractions.
    ///
    /// # Errors
    /// If an element has fewer values, or elements reach beyond their view.
    pub(super) fn read_vectors<const N: usize>(
        &self,
        accessor: &Accessor,
    ) -> Result<Vec<[f32; N]>, Refusal> {
        let found = accessor.dimensions().multiplicity();
        if found < N {
            let index = accessor.index();
            let problem = format!("accessor {index} has {found} values per element: expected {N}");
            return Err(Refusal::whole(problem));
        }
        let kind = accessor.data_type();
        let divisor = match (accessor.normalized(), kind) {
            (true, DataType::I8) => 127.0,
            (true, DataType::U8) => 255.0,
            (true, DataType::I16) => 32_767.0,
            (true, DataType::U16) => 65_535.0,
            _ => 1.0,
        };
        let size = kind.size();
        let decode = |element: &[u8]| {
            let mut values = [0.0; N];
            for (decoded, bytes) in values.iter_mut().zip(element.chunks_exact(size)) {
                let value = (value(kind, bytes) / divisor) as f32;
                // The smallest signed integer is one below −divisor and also means −1.
                *decoded = if divisor > 1.0 {
                    value.max(-1.0)
                } else {
                    value
                };
            }
            values
        };
        let mut elements: Vec<[f32; N]> = match accessor.view() {
            Some(view) => {
                self.check_view(&view)?;
                let stride = view.stride().unwrap_or(accessor.size());
                let bytes = self.view(&view, accessor.offset());
                let bytes = checked(bytes, accessor, stride)?;
                let elements = bytes.chunks(stride.max(1)).take(accessor.count());
                elements.map(decode).collect()
            }
            None if accessor.count() > self.total => {
                let (index, count) = (accessor.index(), accessor.count());
                let problem = format!(
                    "accessor {index} says {count} elements and has no bytes: expected a buffer view"
                );
                return Err(Refusal::whole(problem));
            }
            None => vec![[0.0; N]; accessor.count()],
        };
        self.replace_sparse(accessor, &mut elements, decode)?;
        Ok(elements)
    }

    /// Replaces the elements that a sparse accessor lists one by one.
    fn replace_sparse<const N: usize>(
        &self,
        accessor: &Accessor,
        elements: &mut [[f32; N]],
        decode: impl Fn(&[u8]) -> [f32; N],
    ) -> Result<(), Refusal> {
        let Some(sparse) = accessor.sparse() else {
            return Ok(());
        };
        let (indices, values) = (sparse.indices(), sparse.values());
        let (kind, width) = match indices.index_type() {
            IndexType::U8 => (DataType::U8, 1),
            IndexType::U16 => (DataType::U16, 2),
            IndexType::U32 => (DataType::U32, 4),
        };
        let stride = indices.view().stride().unwrap_or(width);
        let places = self.view(&indices.view(), indices.offset());
        let own = self.view(&values.view(), values.offset());
        let own_stride = values.view().stride().unwrap_or(accessor.size());
        let places = places.chunks(stride.max(1)).filter(|n| n.len() >= width);
        let own = own.chunks(own_stride.max(1));
        let own = own.filter(|element| element.len() >= accessor.size());
        let mut replaced = 0;
        for (place, element) in places.zip(own).take(sparse.count()) {
            let replaced_index = value(kind, &place[..width]) as usize;
            let count = elements.len();
            let Some(place) = elements.get_mut(replaced_index) else {
                let index = accessor.index();
                let problem = format!(
                    "accessor {index} replaces element {replaced_index}: expected an element below {count}"
                );
                return Err(Refusal::whole(problem));
            };
            *place = decode(element);
            replaced += 1;
        }
        if replaced == sparse.count() {
            Ok(())
        } else {
            Err(beyond(accessor))
        }
    }

    /// Reads the elements of an accessor as indices.
    ///
    /// # Errors
    /// If they are not unsigned integers, or reach beyond their view.
    pub(super) fn read_indices(&self, accessor: &Accessor) -> Result<Vec<u32>, Refusal> {
        let kind = accessor.data_type();
        let view = accessor.view();
        let is_whole = matches!(kind, DataType::U8 | DataType::U16 | DataType::U32);
        let (true, Some(view)) = (is_whole && accessor.sparse().is_none(), view) else {
            let index = accessor.index();
            let problem =
                format!("accessor {index} has no indices: expected whole numbers from 0 on");
            return Err(Refusal::whole(problem));
        };
        let size = kind.size();
        self.check_view(&view)?;
        let stride = view.stride().unwrap_or(size);
        let bytes = checked(self.view(&view, accessor.offset()), accessor, stride)?;
        let elements = bytes.chunks(stride.max(1)).take(accessor.count());
        Ok(elements
            .map(|own| value(kind, &own[..size]) as u32)
            .collect())
    }
}

/// Returns `bytes` if they hold all elements of an accessor.
fn checked<'a>(bytes: &'a [u8], accessor: &Accessor, stride: usize) -> Result<&'a [u8], Refusal> {
    let size = accessor.size();
    let before = accessor.count().saturating_sub(1).checked_mul(stride);
    let needed = before.and_then(|before| before.checked_add(size));
    let is_there = needed.is_some_and(|needed| needed <= bytes.len()) && stride >= size;
    if accessor.count() == 0 || is_there {
        Ok(bytes)
    } else {
        Err(beyond(accessor))
    }
}

/// Makes the error for an accessor whose view is too short.
fn beyond(accessor: &Accessor) -> Refusal {
    let (index, count) = (accessor.index(), accessor.count());
    Refusal::whole(format!(
        "accessor {index} of {count} elements reaches beyond its buffer view: expected all of them in it"
    ))
}

/// Decodes a little-endian value.
fn value(kind: DataType, bytes: &[u8]) -> f64 {
    match (kind, bytes) {
        (DataType::I8, &[a, ..]) => f64::from(a as i8),
        (DataType::U8, &[a, ..]) => f64::from(a),
        (DataType::I16, &[a, b, ..]) => f64::from(i16::from_le_bytes([a, b])),
        (DataType::U16, &[a, b, ..]) => f64::from(u16::from_le_bytes([a, b])),
        (DataType::U32, &[a, b, c, d, ..]) => f64::from(u32::from_le_bytes([a, b, c, d])),
        (DataType::F32, &[a, b, c, d, ..]) => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => 0.0,
    }
}

/// Reads a buffer by its address, which contains the data itself or names a file beside this one.
fn read_uri(index: usize, uri: &str, beside: Beside) -> Result<Vec<u8>, Refusal> {
    if let Some(data) = uri.strip_prefix("data:") {
        /// Some writers leave out the `=` signs at the end.
        const ANY: GeneralPurpose = GeneralPurpose::new(
            &base64::alphabet::STANDARD,
            GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
        );
        let text = data.split_once(";base64,").map(|(_, text)| text);
        let bytes = text.and_then(|text| ANY.decode(text.trim_ascii()).ok());
        return bytes.ok_or_else(|| {
            let problem = format!("buffer {index} has a `data:` address: expected base64 in it");
            Refusal::whole(problem)
        });
    }
    let name = unescaped(uri);
    if name.contains("://") {
        let (name, expected) = (quote(&name), "expected a file beside this one");
        return Err(Refusal::whole(format!(
            "buffer {index} is at `{name}`: {expected}"
        )));
    }
    if let Some(bare) = bare_of_outside(&name) {
        // Exporters write paths of the machine that they ran on. A file must not make this program
        // read other folders, so only the bare name is looked for.
        return beside(bare).map_err(|error| {
            let (name, bare) = (quote(&name), quote(bare));
            Refusal::whole(format!(
                "buffer `{name}` is outside the folder of this file, and `{bare}` in it cannot be read ({error}): expected it there"
            ))
        });
    }
    beside(&name).map_err(|error| {
        let name = quote(&name);
        Refusal::whole(format!(
            "buffer `{name}` cannot be read ({error}): expected it beside this file"
        ))
    })
}

/// Returns the bare file name of a path that leaves its folder; `None` if the path stays inside.
fn bare_of_outside(path: &str) -> Option<&str> {
    let parts = || path.split(['/', '\\']);
    let mut depth = 0i64;
    let is_outside = parts().enumerate().any(|(i, part)| {
        match part {
            ".." => depth -= 1,
            "." => {}
            "" => {
                // A path that begins with a separator is absolute.
                if i == 0 {
                    depth = -1;
                }
            }
            _ => depth += 1,
        }
        // So is a path that begins with a drive.
        depth < 0 || (i == 0 && part.ends_with(':'))
    });
    let bare = parts()
        .next_back()
        .filter(|bare| !matches!(*bare, "" | "." | ".."));
    is_outside.then(|| bare.unwrap_or("nothing"))
}

/// Decodes the `%20` notation in a relative address.
fn unescaped(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, others @ ..] = rest {
        let digits = others.get(..2).filter(|_| *first == b'%');
        let digits = digits.and_then(|two| std::str::from_utf8(two).ok());
        match digits.and_then(|two| u8::from_str_radix(two, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &others[2..];
            }
            None => {
                bytes.push(*first);
                rest = others;
            }
        }
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_that_leave_the_folder_are_recognised() {
        for path in [
            "../../etc/a",
            "/etc/a",
            "a/../../a",
            r"C:\b\a",
            r"\\host\a",
            "c:/a",
            "./../a",
        ] {
            assert_eq!(bare_of_outside(path), Some("a"), "{path}");
        }
        for path in ["a", "./a", "b/a", "b/../a", r"b\a", "b//a", "..a"] {
            assert_eq!(bare_of_outside(path), None, "{path}");
        }
        assert_eq!(bare_of_outside("../.."), Some("nothing"));
    }

    #[test]
    fn addresses_are_unescaped() {
        assert_eq!(unescaped("a%20b%C3%A9.bin"), "a bé.bin");
        assert_eq!(unescaped("100%.bin%2"), "100%.bin%2");
        assert_eq!(unescaped("%ff"), "%ff");
    }
}
