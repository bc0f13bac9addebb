//! Files packed by gzip. Their first bytes tell them, and they are unpacked in memory.

use flate2::bufread::GzDecoder;
use std::borrow::Cow;
use std::io::{Error, Read, Result};
use std::vec::Vec;
use std::{format, vec};

/// The first bytes of a packed file.
pub(crate) const MAGIC: [u8; 2] = [0x1f, 0x8b];

/// The most bytes that are unpacked. A small file may unpack to a thousand times its size and
/// exhaust the memory.
const MOST: usize = 1 << 30;

/// Returns `bytes`, unpacked if gzip packed them. Like gzip itself, this joins several packed files
/// and ignores bytes after the last one.
///
/// # Errors
/// If they are damaged or cut off, or unpack to more than [`MOST`] bytes.
pub(crate) fn unpacked(bytes: &[u8]) -> Result<Cow<'_, [u8]>> {
    let out = unpack(bytes, MOST)?;
    match out {
        Some(out) if out.len() > MOST => {
            let problem = format!("packed by gzip, holds more than {} MiB", MOST >> 20);
            Err(Error::other(problem))
        }
        Some(out) => Ok(Cow::Owned(out)),
        None => Ok(Cow::Borrowed(bytes)),
    }
}

/// Returns about the first `most` bytes that gzip packed in `bytes`; returns `bytes` itself if they
/// are not packed or damaged.
pub(crate) fn start(bytes: &[u8], most: usize) -> Cow<'_, [u8]> {
    match unpack(bytes, most) {
        Ok(Some(out)) => Cow::Owned(out),
        _ => Cow::Borrowed(bytes),
    }
}

/// Unpacks until there are more than `most` bytes. Returns `None` if nothing is packed.
fn unpack(bytes: &[u8], most: usize) -> Result<Option<Vec<u8>>> {
    if !bytes.starts_with(&MAGIC) {
        return Ok(None);
    }
    let (mut rest, mut out) = (bytes, Vec::new());
    let mut block = vec![0; 1 << 16];
    while rest.starts_with(&MAGIC) {
        let mut member = GzDecoder::new(rest);
        loop {
            let read = member.read(&mut block);
            let count = read.map_err(|error| Error::other(format!("packed by gzip, {error}")))?;
            if count == 0 {
                break;
            }
            out.try_reserve(count)
                .map_err(|_| Error::other("packed by gzip, more than fits into memory"))?;
            out.extend_from_slice(&block[..count]);
            if out.len() > most {
                return Ok(Some(out));
            }
        }
        rest = member.into_inner();
    }
    Ok(Some(out))
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::GzEncoder;
    use std::io::Write;

    fn packed(bytes: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
        encoder.write_all(bytes).expect("memory");
        encoder.finish().expect("memory")
    }

    #[test]
    fn packed_files_are_unpacked_and_others_stay_unchanged() {
        for bytes in [&b""[..], b"v 0 0 0\n", &[7; 200_000]] {
            assert_eq!(*unpacked(bytes).expect("nothing to do"), *bytes);
            assert_eq!(*unpacked(&packed(bytes)).expect("sound"), *bytes);
        }
        let two = [packed(b"v 0 "), packed(b"0 0"), vec![0; 512]].concat();
        assert_eq!(*unpacked(&two).expect("sound"), *b"v 0 0 0");
    }

    #[test]
    fn damaged_and_cut_off_files_are_errors() {
        let whole = packed(&[b'a'; 1000]);
        for end in 2..whole.len() {
            assert!(unpacked(&whole[..end]).is_err(), "{end}");
        }
        let mut wrong = whole.clone();
        let checksum = wrong.len() - 8;
        wrong[checksum] ^= 1;
        assert!(unpacked(&wrong).is_err());
    }

    #[test]
    fn unpacking_ends_past_the_most_bytes() {
        let bomb = packed(&vec![0; 10 << 20]);
        assert!(bomb.len() < 100_000);
        let out = unpack(&bomb, 1 << 20).expect("sound").expect("packed");
        assert!(((1 << 20) + 1..=(1 << 20) + (1 << 16)).contains(&out.len()));
        assert!(start(&bomb, 100).len() <= 1 << 17);
    }
}
