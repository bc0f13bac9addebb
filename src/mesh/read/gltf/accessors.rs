//! The binary data of a glTF file. An accessor describes values, a view is a range of bytes, and a
//! buffer is a file or a part of this one. Only what is asked for is read.

use super::super::Beside;
use super::super::error::{Refusal, quote};
use super::document::{Accessor, Document, Sparse, SparsePart, compression, entry, unread};
use base64::Engine;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};
use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::format;
use std::string::String;
use std::vec;
use std::vec::Vec;

/// The most bytes that all buffers may have together. Many buffers may name one file.
const MOST: usize = 1 << 30;
/// The most elements that an accessor without bytes may have if the buffers are short. It would be
/// all zeros.
const ZEROS: usize = 1 << 16;

/// The buffers of a file.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    /// The binary chunk of a GLB file.
    bin: Option<&'a [u8]>,
    beside: Beside<'a>,
    /// The buffers that were read so far.
    bytes: HashMap<usize, Cow<'a, [u8]>>,
    /// How many bytes these have.
    total: usize,
}

/// The form of a value in a buffer.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Form {
    /// Returns the form with this number.
    fn of(number: usize, accessor: usize) -> Result<Form, Refusal> {
        Ok(match number {
            5120 => Form::I8,
            5121 => Form::U8,
            5122 => Form::I16,
            5123 => Form::U16,
            5125 => Form::U32,
            5126 => Form::F32,
            _ => {
                let problem = format!(
                    "accessor {accessor} has values of type {number}: expected 5120, 5121, 5122, 5123, 5125 or 5126"
                );
                return Err(Refusal::whole(problem));
            }
        })
    }

    fn size(self) -> usize {
        match self {
            Form::I8 | Form::U8 => 1,
            Form::I16 | Form::U16 => 2,
            Form::U32 | Form::F32 => 4,
        }
    }

    /// Returns what a normalised integer is divided by.
    fn full(self) -> f64 {
        match self {
            Form::I8 => 127.0,
            Form::U8 => 255.0,
            Form::I16 => 32_767.0,
            Form::U16 => 65_535.0,
            Form::U32 | Form::F32 => 1.0,
        }
    }

    /// Decodes a little-endian value.
    #[inline]
    fn decode(self, bytes: &[u8]) -> f64 {
        match (self, bytes) {
            (Form::I8, &[a, ..]) => f64::from(a as i8),
            (Form::U8, &[a, ..]) => f64::from(a),
            (Form::I16, &[a, b, ..]) => f64::from(i16::from_le_bytes([a, b])),
            (Form::U16, &[a, b, ..]) => f64::from(u16::from_le_bytes([a, b])),
            (Form::U32, &[a, b, c, d, ..]) => f64::from(u32::from_le_bytes([a, b, c, d])),
            (Form::F32, &[a, b, c, d, ..]) => f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => 0.0,
        }
    }
}

/// Returns how many values an element has.
fn width(kind: &str, accessor: usize) -> Result<usize, Refusal> {
    Ok(match kind {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => {
            let kind = quote(kind);
            let problem = format!(
                "accessor {accessor} has elements of type `{kind}`: expected SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4"
            );
            return Err(Refusal::whole(problem));
        }
    })
}

impl<'a> Buffers<'a> {
    /// Prepares to read the buffers of `document`. `bin` is the one inside a GLB file.
    pub(super) fn new(document: &'a Document, bin: Option<&'a [u8]>, beside: Beside<'a>) -> Self {
        Buffers {
            document,
            bin,
            beside,
            bytes: HashMap::new(),
            total: 0,
        }
    }

    /// Returns the bytes of a buffer.
    ///
    /// # Errors
    /// If it cannot be read, or all buffers together are over the limit.
    fn buffer(&mut self, index: usize) -> Result<&[u8], Refusal> {
        let unread = match self.bytes.entry(index) {
            Entry::Occupied(known) => return Ok(&*known.into_mut()),
            Entry::Vacant(unread) => unread,
        };
        let buffers = &self.document.buffers;
        let bytes = match &entry(buffers, index, "buffer")?.uri {
            Some(uri) => Cow::Owned(read_uri(index, uri, self.beside)?),
            None => {
                let is_first = buffers[..index].iter().all(|before| before.uri.is_some());
                let bin = self.bin.filter(|_| is_first).ok_or_else(|| {
                    let expected = "expected a binary chunk or a `uri`";
                    Refusal::whole(format!("buffer {index} has no bytes: {expected}"))
                })?;
                Cow::Borrowed(bin)
            }
        };
        self.total = self.total.saturating_add(bytes.len());
        if self.total > MOST {
            let most = MOST >> 20;
            let problem = format!("its buffers are over {most} MiB: expected at most that");
            return Err(Refusal::whole(problem));
        }
        Ok(&*unread.insert(bytes))
    }

    /// Returns the bytes of a view, and the distance of its elements; 0 if it says none.
    ///
    /// # Errors
    /// If they are compressed, or not within their buffer.
    fn view(&mut self, index: usize) -> Result<(&[u8], usize), Refusal> {
        let document = self.document;
        let view = entry(&document.buffer_views, index, "buffer view")?;
        // A buffer that stands for what compressed views unpack to may have no bytes.
        let buffer = entry(&document.buffers, view.buffer, "buffer")?;
        let is_empty = buffer.uri.is_none() && compression(&buffer.extensions).is_some();
        if let Some(name) = compression(&view.extensions).filter(|_| is_empty) {
            return Err(unread(name));
        }
        let all = self.buffer(view.buffer)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let own = end.and_then(|end| all.get(view.byte_offset..end));
        let own = own.ok_or_else(|| {
            let held = all.len();
            let expected = format!("expected it to end within {held} bytes");
            Refusal::whole(format!(
                "buffer view {index} reaches beyond its buffer: {expected}"
            ))
        })?;
        Ok((own, view.byte_stride))
    }

    /// True if an accessor has no bytes.
    pub(super) fn is_all_zeros(&self, index: usize) -> bool {
        let accessor = self.document.accessors.get(index);
        accessor.is_some_and(|own| own.buffer_view.is_none() && own.sparse.is_none())
    }

    /// Reads the elements of an accessor as `N` values each. Normalised integers become fractions.
    ///
    /// # Errors
    /// If an element has fewer values, or elements reach beyond their view.
    pub(super) fn read_vectors<const N: usize>(
        &mut self,
        index: usize,
    ) -> Result<Vec<[f32; N]>, Refusal> {
        let accessor = entry(&self.document.accessors, index, "accessor")?;
        let form = Form::of(accessor.component_type, index)?;
        let full = if accessor.normalized {
            form.full()
        } else {
            1.0
        };
        self.read(index, accessor, |value| {
            if full > 1.0 {
                // The smallest signed integer is one below −full and also means −1.
                (value / full).max(-1.0) as f32
            } else {
                value as f32
            }
        })
    }

    /// Reads the elements of an accessor as indices.
    ///
    /// # Errors
    /// If they are not unsigned integers, or reach beyond their view.
    pub(super) fn read_indices(&mut self, index: usize) -> Result<Vec<u32>, Refusal> {
        let accessor = entry(&self.document.accessors, index, "accessor")?;
        let form = Form::of(accessor.component_type, index)?;
        if !matches!(form, Form::U8 | Form::U16 | Form::U32) {
            let problem =
                format!("accessor {index} has no indices: expected whole numbers from 0 on");
            return Err(Refusal::whole(problem));
        }
        let elements: Vec<[u32; 1]> = self.read(index, accessor, |value| value as u32)?;
        Ok(elements.into_flattened())
    }

    /// Reads the elements of accessor `index` as `N` values each.
    fn read<const N: usize, T: Copy + Default>(
        &mut self,
        index: usize,
        accessor: &Accessor,
        convert: impl Fn(f64) -> T,
    ) -> Result<Vec<[T; N]>, Refusal> {
        let (count, form) = (accessor.count, Form::of(accessor.component_type, index)?);
        let found = width(&accessor.kind, index)?;
        if found < N {
            let problem = format!("accessor {index} has {found} values per element: expected {N}");
            return Err(Refusal::whole(problem));
        }
        let size = form.size();
        let element = |bytes: &[u8]| {
            let mut values = [T::default(); N];
            for (decoded, bytes) in values.iter_mut().zip(bytes.chunks_exact(size)) {
                *decoded = convert(form.decode(bytes));
            }
            values
        };
        let beyond = || {
            Refusal::whole(format!(
                "accessor {index} of {count} elements reaches beyond its buffer view: expected all of them in it"
            ))
        };
        // First, because they tell how many bytes the buffers have.
        let sparse = accessor.sparse.as_ref();
        let places = sparse
            .map(|sparse| self.places(index, sparse))
            .transpose()?;
        let mut elements: Vec<[T; N]> = match accessor.buffer_view {
            Some(view) => {
                let own = self.elements(view, accessor.byte_offset, found * size, count)?;
                own.ok_or_else(beyond)?.map(element).collect()
            }
            None if count > self.total.max(ZEROS) => {
                let problem = format!(
                    "accessor {index} says {count} elements and has no bytes: expected a buffer view"
                );
                return Err(Refusal::whole(problem));
            }
            None => vec![[T::default(); N]; count],
        };
        let Some((sparse, places)) = sparse.zip(places) else {
            return Ok(elements);
        };
        let places = places.ok_or_else(beyond)?;
        let SparsePart {
            buffer_view,
            byte_offset,
            ..
        } = sparse.values;
        let own = self.elements(buffer_view, byte_offset, found * size, sparse.count)?;
        for (place, own) in places.into_iter().zip(own.ok_or_else(beyond)?) {
            let replaced = elements.get_mut(place).ok_or_else(|| {
                let expected = format!("expected an element below {count}");
                Refusal::whole(format!(
                    "accessor {index} replaces element {place}: {expected}"
                ))
            })?;
            *replaced = element(own);
        }
        Ok(elements)
    }

    /// Returns which elements a sparse accessor replaces; `None` if they reach beyond their view.
    fn places(&mut self, index: usize, sparse: &Sparse) -> Result<Option<Vec<usize>>, Refusal> {
        let part = &sparse.indices;
        let form = Form::of(part.component_type, index)?;
        let all = self.elements(
            part.buffer_view,
            part.byte_offset,
            form.size(),
            sparse.count,
        )?;
        Ok(all.map(|all| all.map(|bytes| form.decode(bytes) as usize).collect()))
    }

    /// Returns `count` elements of `size` bytes each, which begin `offset` bytes into a view;
    /// `None` if they reach beyond it.
    fn elements(
        &mut self,
        view: usize,
        offset: usize,
        size: usize,
        count: usize,
    ) -> Result<Option<impl Iterator<Item = &[u8]>>, Refusal> {
        let (bytes, stride) = self.view(view)?;
        let stride = if stride == 0 { size } else { stride };
        let before = count.saturating_sub(1).checked_mul(stride);
        let needed = before.and_then(|before| before.checked_add(size));
        let bytes = bytes.get(offset..).unwrap_or_default();
        let is_there = needed.is_some_and(|needed| needed <= bytes.len()) && stride >= size;
        let elements = bytes.chunks(stride).take(count);
        Ok((count == 0 || is_there).then_some(elements))
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
