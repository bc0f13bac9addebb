//! Broken files: a fixed series of random changes to good ones. All must give a mesh or an error.

use super::*;
use crate::number::test_random::Random;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::string::ToString;

const OBJ: &[&str] = &[
    "# cube\nmtllib a.mtl b.mtl\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
     usemtl red\ns 1\nf 4 3 2 1\nf 5 6 7 8\ng sides\nusemtl blue # sky\nf 1 2 6 5\nf 2 3 7 6\ns off\nf 3 4 8 7\nf 4 1 5 8\n",
    "v 0 0 0 1\r\nv 1 0 0 1 0.5 0.25\r\nv 1 1 0\r\nvt 0 0\r\nvt 1 1\r\nvn 0 0 1\r\nvn 0 0.6 0.8\r\n\
     f 1/1/1 2/2/2 3/-1/-1\r\nf -3//1 -2//2 \\\r\n-1//1\r\n",
    "\u{feff}o Gr\u{fc}n\nv 1e-3 -2.5E+2 .5\nv 3 1 4\nv 1 5 9\nv 2 6 5\nf 1 2 3 4\nl 1 2 3\np 4\nf 1 1 2 3\nf 1 2\nvp 1 2\n",
];
const MTL: &str = "newmtl red\nKa 0.1\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 20\nillum 2\nmap_Kd a b.png\n\n\
                   newmtl blue # sky\nKd spectral f.rfl\nKs xyz 1 1 1\nNi 1.5\nTr 0\nd -halo 0.5\nillum 1\n";
/// Tokens that confuse readers of OBJ files. They are inserted besides single bytes.
const TOKENS: &[&str] = &[
    "\n",
    "\\\n",
    "#",
    " ",
    "/",
    "//",
    "-",
    "0",
    "-1",
    "9",
    "nan",
    "inf",
    "1e999",
    "1.#QNAN",
    "-nan(ind)",
    "1,5",
    "call ",
    "KD ",
    "map_Kd a",
    "d ",
    "Tr ",
    "\\\r",
    "\r\n",
    "99999999999999999999",
    "f ",
    "v ",
    "vn ",
    "usemtl ",
    "mtllib ",
    "newmtl ",
    "Kd ",
    "Ns ",
    "\r",
    "\u{85}",
    "\u{a0}",
    "\0",
    "-9223372036854775808",
];

/// Random changes.
struct Series(Random);

impl Series {
    fn below(&mut self, n: usize) -> usize {
        self.0.below(n.max(1) as u64) as usize
    }

    /// Makes one change to `bytes`.
    fn change(&mut self, bytes: &mut Vec<u8>) {
        let at = self.below(bytes.len());
        match self.below(6) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << self.below(8),
            1 => bytes.truncate(at),
            2 if !bytes.is_empty() => drop(bytes.remove(at)),
            3 => {
                let token = TOKENS[self.below(TOKENS.len())];
                bytes.splice(at..at, token.bytes());
            }
            4 => {
                let mut lines: Vec<&[u8]> = bytes.split_inclusive(|&b| b == b'\n').collect();
                let (a, b) = (self.below(lines.len()), self.below(lines.len()));
                if !lines.is_empty() {
                    lines.swap(a, b);
                }
                *bytes = lines.concat();
            }
            _ => {
                let end = at + self.below(bytes.len() - at);
                let copy = bytes[at..end].to_vec();
                bytes.splice(at..at, copy);
            }
        }
    }
}

#[test]
fn changed_files_end_in_a_mesh_or_an_error() {
    let mut series = Series(Random::new(1));
    let (mut meshes, mut errors) = (0, 0);
    for round in 0..12_000 {
        let mut obj = OBJ[round % OBJ.len()].as_bytes().to_vec();
        let mut mtl = MTL.as_bytes().to_vec();
        for _ in 0..=series.below(4) {
            series.change(&mut obj);
            series.change(&mut mtl);
        }
        let result = catch_unwind(AssertUnwindSafe(|| {
            parse_mesh("t.obj", &obj, |_| Ok(mtl.clone()))
        }));
        let parsed = result.unwrap_or_else(|_| panic!("panic at {obj:?} with {mtl:?}"));
        match &parsed {
            Ok(loaded) => {
                meshes += 1;
                // The parser must not fail on anything that the checks let through.
                assert!(
                    !loaded.notes.to_string().contains("gave up"),
                    "{} {mtl:?}",
                    loaded.notes
                );
            }
            Err(error) => {
                errors += 1;
                assert!(
                    !format!("{error}").contains("gave up") && !format!("{error}").contains('\n'),
                    "{error}: {obj:?}"
                );
            }
        }
    }
    // Both outcomes must be frequent, or the changes are too mild or too wild to find anything.
    assert!(
        meshes > 2_000 && errors > 2_000,
        "{meshes} meshes, {errors} errors"
    );
}
