//! STL files: separate triangles, binary or as text.
//!
//! A file repeats a vertex's position in each triangle around it, so the reader merges positions
//! that are exactly equal. The format cannot say which edges are smooth. A mesh drawn on its own
//! therefore gets creases, with weights by angle. The reader ignores the normals of facets, as most
//! programs do: the vertices imply them, and many files have zeros there.

use super::content::is_binary_stl;
use super::error::{Place, Refusal, quote};
use super::polygons::{Polygons, is_position};
use super::words::{Words, number, text};
use super::{Beside, MeshFormat, Parts};
use crate::mesh::PolygonMesh;
use crate::mesh::origin::origin;
use crate::mesh::vertex_normals::{NormalRule, NormalSource, NormalWeight};
use crate::mesh::weld::weld_repeated;
use crate::note::{Note, Notes};
use glam::{DVec3, Vec3};
use std::format;
use std::vec::Vec;

/// An edge is sharp if its polygons meet at more than this angle in degrees.
const CREASE: f64 = 40.0;
/// The bytes of a binary file's header.
const HEADER: usize = 80;
/// The byte where triangles start, after the header and the triangle count.
const START: usize = HEADER + 4;
/// The bytes of a triangle: its normal, three vertices, and two bytes of attributes.
const TRIANGLE: usize = 50;

/// The format.
pub(super) struct Stl;

impl MeshFormat for Stl {
    fn name(&self) -> &'static str {
        "an STL file"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["stl"]
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        is_binary_stl(bytes) || begins_as_text(bytes)
    }

    fn read(&self, bytes: &[u8], _: Beside) -> Result<Parts, Refusal> {
        let soup = if is_text(bytes) && !is_binary_stl(bytes) {
            read_text(bytes)?
        } else {
            read_binary(bytes)?
        };
        if soup.ends.is_empty() {
            let expected = "expected triangles, binary or as `facet` statements";
            return Err(Refusal::whole(format!("has no triangle: {expected}")));
        }
        let mut parts = soup.welded()?.finish()?;
        parts.builder.normal_rule(NormalRule {
            source: NormalSource::Crease(CREASE),
            weight: NormalWeight::Angle,
        });
        parts.builder.up_by_custom('z');
        Ok(parts)
    }
}

/// Facets that share no positions.
#[derive(Default)]
struct Soup {
    /// One position per corner.
    positions: Vec<DVec3>,
    /// The end of each facet in `positions`.
    ends: Vec<u32>,
    notes: Notes,
}

impl Soup {
    /// Merges equal positions and returns the polygons. Positions are equal if they are so after
    /// the mesh has rounded them.
    fn welded(self) -> Result<Polygons, Refusal> {
        let origin = origin(&self.positions);
        let rounded = self.positions.iter().map(|&p| (p - origin).as_vec3());
        let (corners, count) = weld_repeated(&rounded.collect::<Vec<Vec3>>());
        let mut polygons = Polygons::default();
        polygons.positions.reserve(count);
        polygons.notes = self.notes;
        polygons.corners.reserve(corners.len());
        let mut start = 0;
        for &end in &self.ends {
            let facet = start..end as usize;
            for (&corner, &position) in corners[facet.clone()].iter().zip(&self.positions[facet]) {
                // Indices follow first occurrence, so a new index is always the next one.
                if corner as usize == polygons.positions.len() {
                    polygons.positions.push(position);
                }
                polygons.corners.push(corner);
            }
            start = end as usize;
            polygons.end_polygon(Place::Line(0))?;
        }
        Ok(polygons)
    }
}

/// True if the first word is `solid`, or the first two are `facet normal`: some programs leave
/// `solid` out.
fn begins_as_text(bytes: &[u8]) -> bool {
    // Some programs write comments first, though the format has none.
    let mut words = Words::new(&bytes[..bytes.len().min(1 << 12)], 0, 1).with_comments();
    let [first, second] = [(); 2].map(|()| words.next().unwrap_or_default());
    first.eq_ignore_ascii_case(b"solid")
        || first.eq_ignore_ascii_case(b"facet") && second.eq_ignore_ascii_case(b"normal")
}

/// True if a file is text: it has no zero byte near its start, or begins as text and has the word
/// `vertex` three times. Some binary files begin with `solid` too, but zeros fill their headers.
fn is_text(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(1024)];
    let is_vertex = |word: &&[u8]| word.eq_ignore_ascii_case(b"vertex");
    let mut vertices = head.windows(6).filter(is_vertex);
    !head.contains(&0) || begins_as_text(bytes) && vertices.nth(2).is_some()
}

/// Returns the vertices of a triangle of a binary file.
fn vertices(triangle: &[u8; TRIANGLE]) -> [DVec3; 3] {
    let value = |at: usize| {
        let four = triangle[at..].first_chunk().copied().unwrap_or_default();
        f64::from(f32::from_le_bytes(four))
    };
    // The first 12 bytes are the normal, which is ignored.
    [12, 24, 36].map(|at| DVec3::new(value(at), value(at + 4), value(at + 8)))
}

/// True if a triangle behind those that the header states is one, and no text. The least lower-case
/// letters as a number are 2e20, and a scene does not reach farther than 1e15.
fn is_plausible(triangle: &[u8; TRIANGLE]) -> bool {
    const FARTHEST: f64 = 1e15;
    let is_near = |vertex: &DVec3| vertex.is_finite() && vertex.abs().max_element() <= FARTHEST;
    vertices(triangle).iter().all(is_near)
}

/// True if the vertices of a triangle are finite.
fn is_finite(triangle: &[u8; TRIANGLE]) -> bool {
    vertices(triangle).iter().all(|vertex| vertex.is_finite())
}

/// Returns how many triangles of a binary file are read. The header states a number, which may be
/// wrong. The bytes behind that many triangles are triangles if the file ends with one.
fn triangle_count(body: &[u8], stated: u32, notes: &mut Notes) -> usize {
    let (triangles, others) = body.as_chunks();
    let held = triangles.len();
    let count = stated as usize;
    let rest = triangles.get(count..).unwrap_or_default();
    if rest.is_empty() && stated != u32::MAX {
        return count;
    }
    // A program that writes to a pipe cannot go back to fill in the count.
    let is_unstated = stated == 0 || stated == u32::MAX;
    let behind = body.get(TRIANGLE * count..).unwrap_or_default();
    if !is_unstated && behind.iter().all(|byte| *byte == behind[0]) {
        // The file is padded.
        return count;
    }
    let (text, count) = if is_unstated || others.is_empty() && rest.iter().all(is_plausible) {
        (format!("all {held} in the file are read"), held)
    } else {
        (format!("{} bytes behind are ignored", behind.len()), count)
    };
    let noun = if stated == 1 { "triangle" } else { "triangles" };
    let text = format!("the header says {stated} {noun}: {text}");
    notes.push(Note::warning("triangle-count", text));
    count
}

/// Reads the triangles of a binary file.
fn read_binary(bytes: &[u8]) -> Result<Soup, Refusal> {
    let Some(stated) = bytes.get(HEADER..START).and_then(|four| four.first_chunk()) else {
        let length = bytes.len();
        return Err(Refusal::whole(format!(
            "is {length} bytes long: expected text that begins with `solid`, or a binary file of at least {START} bytes"
        )));
    };
    let body = &bytes[START..];
    let mut notes = Notes::default();
    let count = triangle_count(body, u32::from_le_bytes(*stated), &mut notes);
    let (triangles, _) = body.as_chunks();
    let held = triangles.len();
    if count > held {
        let problem = format!(
            "the file ends in triangle {} of {count}: expected all of them",
            held + 1
        );
        return Err(Refusal::at(Place::Byte(bytes.len()), problem));
    }
    if count > PolygonMesh::MAX_POLYGONS {
        let most = PolygonMesh::MAX_POLYGONS;
        return Err(Refusal::whole(format!(
            "too many polygons: expected at most {most}"
        )));
    }
    let triangles = &triangles[..count];
    if let Some(i) = triangles.iter().position(|triangle| !is_finite(triangle)) {
        let problem = format!(
            "triangle {} has a coordinate that is not finite: expected finite numbers",
            i + 1
        );
        return Err(Refusal::at(Place::Byte(START + TRIANGLE * i), problem));
    }
    let positions = triangles.iter().flat_map(vertices).collect();
    if triangles.iter().any(|triangle| triangle[48..] != [0, 0]) {
        let text =
            "the two bytes after each triangle, where some programs store colours, are not read";
        notes.push(Note::warning("triangle-attributes", text));
    }
    let ends = (1..=count as u32).map(|triangle| 3 * triangle).collect();
    Ok(Soup {
        positions,
        ends,
        notes,
    })
}

/// Reads the facets of a text word by word. Line ends matter only after names, and keywords may be
/// in any case.
fn read_text(bytes: &[u8]) -> Result<Soup, Refusal> {
    let mut words = Words::new(bytes, 0, 1).with_comments();
    let mut soup = Soup::default();
    let mut is_inside = false;
    while let Some(word) = words.next() {
        match keyword(word) {
            Some(Keyword::Solid) => pass_over_name(&mut words),
            Some(Keyword::Facet) if !is_inside => {
                is_inside = true;
                pass_over_normal(&mut words);
            }
            Some(Keyword::Vertex) if is_inside => {
                let mut vertex = [0.0; 3];
                for value in &mut vertex {
                    *value = words.finite("the end of a vertex")?;
                }
                let position = DVec3::from_array(vertex);
                if !is_position(position) {
                    let [x, y, z] = vertex;
                    let problem =
                        format!("a vertex at {x}, {y}, {z}: expected numbers of at most 3.4e38");
                    return Err(Refusal::at(words.place(), problem));
                }
                soup.positions.push(position);
            }
            Some(Keyword::Loop) if is_inside => {}
            Some(Keyword::EndFacet) if is_inside => {
                is_inside = false;
                end_facet(&mut soup, &words)?;
            }
            _ => {
                let expected = if is_inside {
                    "`outer loop`, `vertex`, `endloop` or `endfacet`"
                } else {
                    "`facet`, `solid` or `endsolid`"
                };
                let problem = format!("`{}`: expected {expected}", quote(&text(word)));
                return Err(Refusal::at(words.place(), problem));
            }
        }
    }
    if is_inside {
        Err(words.ends_before("`endfacet`"))
    } else {
        Ok(soup)
    }
}

/// Ends a facet and checks its size.
fn end_facet(soup: &mut Soup, words: &Words) -> Result<(), Refusal> {
    let start = soup.ends.last().map_or(0, |&end| end as usize);
    let found = soup.positions.len() - start;
    if found < 3 {
        let problem = format!("a facet of {found} vertices: expected three");
        return Err(Refusal::at(words.place(), problem));
    }
    let most = PolygonMesh::MAX_POLYGONS;
    if soup.ends.len() == most {
        let problem = format!("too many polygons: expected at most {most}");
        return Err(Refusal::at(words.place(), problem));
    }
    let most = PolygonMesh::MAX_CORNERS;
    if soup.positions.len() > most {
        let problem = format!("too many corners: expected at most {most}");
        return Err(Refusal::at(words.place(), problem));
    }
    soup.ends.push(soup.positions.len() as u32);
    Ok(())
}

/// A keyword of a text file.
#[derive(Clone, Copy, PartialEq)]
enum Keyword {
    /// `solid` or `endsolid`, which a name may follow.
    Solid,
    Facet,
    Vertex,
    /// `outer`, `loop` or `endloop`.
    Loop,
    EndFacet,
}

/// Returns the keyword `word`, if it is one.
fn keyword(word: &[u8]) -> Option<Keyword> {
    const KEYWORDS: [(&[u8], Keyword); 8] = [
        (b"vertex", Keyword::Vertex),
        (b"outer", Keyword::Loop),
        (b"loop", Keyword::Loop),
        (b"endloop", Keyword::Loop),
        (b"facet", Keyword::Facet),
        (b"endfacet", Keyword::EndFacet),
        (b"solid", Keyword::Solid),
        (b"endsolid", Keyword::Solid),
    ];
    let mut known = KEYWORDS.iter();
    let found = known.find(|(known, _)| known.eq_ignore_ascii_case(word));
    found.map(|(_, keyword)| *keyword)
}

/// Skips the name of a solid. It ends with the line, or before the next statement if the whole file
/// is one line. A word counts as a statement only if what follows fits, because a solid may be
/// called `facet normal things`.
fn pass_over_name(words: &mut Words) {
    loop {
        let before = words.clone();
        let Some(word) = words.next_in_line() else {
            return;
        };
        let mut ahead = words.clone();
        let mut next = || ahead.next_in_line().unwrap_or_default();
        let is_statement = match keyword(word) {
            Some(Keyword::Facet) => {
                next().eq_ignore_ascii_case(b"normal") && number(next()).is_some()
            }
            Some(Keyword::Solid) => true,
            _ => false,
        };
        if is_statement {
            *words = before;
            return;
        }
    }
}

/// Skips `normal` and its numbers, up to the next keyword.
fn pass_over_normal(words: &mut Words) {
    for _ in 0..4 {
        let before = words.clone();
        if words.next().is_none_or(|word| keyword(word).is_some()) {
            *words = before;
            return;
        }
    }
}
