//! OFF files, the object file format of Geomview: text, with colours and normals of vertices and
//! colours of faces.

use super::error::{Place, Refusal, quote};
use super::polygons::Polygons;
use super::words::{Words, number, text};
use super::{Beside, MeshFormat, Parts};
use glam::DVec3;
use std::format;
use std::vec::Vec;

/// The format.
pub(super) struct Off;

impl MeshFormat for Off {
    fn name(&self) -> &'static str {
        "an OFF file"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["off"]
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        let head = &bytes[..bytes.len().min(1 << 12)];
        let first = words(head).next();
        first.is_some_and(|word| split_keyword(word).is_some())
    }

    fn read(&self, bytes: &[u8], _: Beside) -> Result<Parts, Refusal> {
        let mut words = words(bytes);
        let (kind, [vertices, faces]) = read_head(&mut words)?;
        let mut polygons = Polygons::default();
        read_vertices(&mut words, kind, vertices, &mut polygons)?;
        read_faces(&mut words, vertices, faces, &mut polygons)?;
        if polygons.count() == 0 {
            let problem = "has no polygon: expected faces of at least three corners";
            return Err(Refusal::whole(problem));
        }
        polygons.finish()
    }
}

/// Returns the words of a file. Comments begin with `#`.
fn words(bytes: &[u8]) -> Words<'_> {
    let start = if bytes.starts_with(b"\xef\xbb\xbf") {
        3
    } else {
        0
    };
    Words::new(bytes, start, 1).with_comments()
}

/// The properties of vertices besides their positions. The letters before `OFF` list them.
#[derive(Clone, Copy)]
struct Kind {
    /// `N`: a normal.
    has_normals: bool,
    /// `C`: a colour.
    has_colours: bool,
    /// `4`: a fourth coordinate.
    has_weight: bool,
    /// `n`: the file says how many coordinates a vertex has.
    has_dimension: bool,
}

/// Splits the first word into the letters before `OFF` and the digits after it. A well-known
/// collection of files writes the first count right there.
fn split_keyword(word: &[u8]) -> Option<(&[u8], &[u8])> {
    let at = word.windows(3).position(|three| three == b"OFF")?;
    let (letters, rest) = (&word[..at], &word[at + 3..]);
    let is_known = letters.iter().all(|letter| b"STCN4n".contains(letter));
    let is_count = rest.iter().all(u8::is_ascii_digit);
    (is_known && is_count).then_some((letters, rest))
}

/// Reads the keyword and the counts of vertices and faces.
fn read_head(words: &mut Words) -> Result<(Kind, [usize; 2]), Refusal> {
    let expected = "expected OFF, COFF, NOFF or CNOFF";
    let Some(word) = words.next() else {
        return Err(Refusal::whole(format!("is empty: {expected}")));
    };
    let Some((letters, glued)) = split_keyword(word) else {
        let problem = format!("`{}`: {expected}", quote(&text(word)));
        return Err(Refusal::at(words.place(), problem));
    };
    let has = |letter: u8| letters.contains(&letter);
    let kind = Kind {
        has_normals: has(b'N'),
        has_colours: has(b'C'),
        has_weight: has(b'4'),
        has_dimension: has(b'n'),
    };
    let mut before = words.clone();
    if before.next_in_line().is_some_and(|word| word == b"BINARY") {
        let problem = "is a binary OFF file: expected OFF text (meshconv and geomview write it)";
        return Err(Refusal::whole(problem));
    }
    if kind.has_dimension {
        let dimension = words.finite("the number of coordinates")?;
        if dimension != 3.0 {
            let problem = format!("{dimension} coordinates per vertex: expected 3");
            return Err(Refusal::at(words.place(), problem));
        }
    }
    let vertices = read_count(words, glued, "the number of vertices")?;
    let faces = read_count(words, b"", "the number of faces")?;
    // The edge count may follow in this line. Nobody needs it.
    words.end_line();
    Ok((kind, [vertices, faces]))
}

/// Reads a count from `glued`, the digits behind the keyword, or from the next word if there are
/// none. `what` names it in errors.
fn read_count(words: &mut Words, glued: &[u8], what: &str) -> Result<usize, Refusal> {
    let word = match glued {
        b"" => words.next().ok_or_else(|| words.ends_before(what))?,
        digits => digits,
    };
    let count = number(word).filter(|count| count.is_finite());
    let count = count.ok_or_else(|| words.no_number(word))?;
    let expected = match count.fract() == 0.0 && count >= 0.0 {
        true if count < 4e9 => return Ok(count as usize),
        true => "less than 4000000000",
        false => "a whole number",
    };
    let problem = format!("`{}`: expected {what}, {expected}", quote(&text(word)));
    Err(Refusal::at(words.place(), problem))
}

/// Reads the next line that is not blank into `values`, and returns its place. It must hold at
/// least `least` numbers, which need not be finite.
fn read_line(
    words: &mut Words,
    least: usize,
    what: &str,
    values: &mut Vec<f64>,
) -> Result<Place, Refusal> {
    values.clear();
    let mut word = words.next();
    while let Some(found) = word {
        match number(found) {
            Some(value) => values.push(value),
            // After the values that matter, the line may hold anything.
            None if values.len() >= least => break,
            None => return Err(words.no_number(found)),
        }
        word = words.next_in_line();
    }
    match values.len() {
        0 => Err(words.ends_before(what)),
        found if found < least => {
            let problem = format!("{found} numbers: expected {least}");
            Err(Refusal::at(words.place(), problem))
        }
        _ => {
            let place = words.place();
            words.end_line();
            Ok(place)
        }
    }
}

fn read_vertices(
    words: &mut Words,
    kind: Kind,
    count: usize,
    polygons: &mut Polygons,
) -> Result<(), Refusal> {
    let normal = 3 + usize::from(kind.has_weight);
    let colour = normal + 3 * usize::from(kind.has_normals);
    let least = colour + 3 * usize::from(kind.has_colours);
    let mut values = Vec::new();
    let mut colours = Vec::new();
    for _ in 0..count {
        let place = read_line(words, least, "its last vertex", &mut values)?;
        let mut position = DVec3::from_slice(&values);
        if kind.has_weight {
            if values[3] == 0.0 {
                let problem =
                    "a vertex with w = 0: expected another number, as x, y and z are divided by it";
                return Err(Refusal::at(place, problem));
            }
            position /= values[3];
        }
        polygons.push_position(position, place);
        if kind.has_normals {
            let own = DVec3::from_slice(&values[normal..]);
            polygons.normals.push(own);
        }
        if kind.has_colours {
            colours.push(DVec3::from_slice(&values[colour..]));
        }
    }
    let is_in_bytes = are_in_bytes(colours.iter().copied());
    let colours = colours.into_iter();
    let colours = colours.map(|own| scaled(own, is_in_bytes).as_vec3());
    polygons.colours = colours.collect();
    Ok(())
}

/// Reads faces. A face has its corner count, then its corners, which may continue on further lines,
/// and a colour behind the last corner on its line.
fn read_faces(
    words: &mut Words,
    vertices: usize,
    count: usize,
    polygons: &mut Polygons,
) -> Result<(), Refusal> {
    const LAST: &str = "the end of its last face";
    // The polygon of each colour, and the colour.
    let mut colours: Vec<(usize, DVec3)> = Vec::new();
    let mut colour = Vec::new();
    for _ in 0..count {
        let sides = words.finite(LAST)?;
        if sides.fract() != 0.0 || sides < 0.0 {
            let problem = format!("a face of {sides} corners: expected a whole number");
            return Err(Refusal::at(words.place(), problem));
        }
        for _ in 0..sides as u64 {
            let corner = words.finite(LAST)?;
            if corner.fract() != 0.0 || !(0.0..vertices as f64).contains(&corner) {
                let last = vertices.saturating_sub(1);
                let problem =
                    format!("vertex index {corner} is out of range: expected 0 to {last}");
                return Err(Refusal::at(words.place(), problem));
            }
            polygons.corners.push(corner as u32);
        }
        colour.clear();
        while let Some(value) = words.next_in_line().and_then(number) {
            colour.push(value);
        }
        let is_kept = polygons.end_polygon(words.place())?;
        words.end_line();
        if let (true, Some(colour)) = (is_kept, face_colour(&colour)) {
            colours.push((polygons.count() - 1, colour));
        }
    }
    let is_in_bytes = are_in_bytes(colours.iter().map(|(_, colour)| *colour));
    for (polygon, colour) in colours {
        polygons.set_colour_of(polygon, scaled(colour, is_in_bytes));
    }
    Ok(())
}

/// Returns the colour behind a face's corners, as the file says it. It has three or four values. A
/// single value would be an index into a table that the file does not have, and means no colour.
fn face_colour(values: &[f64]) -> Option<DVec3> {
    let (&[r, g, b] | &[r, g, b, _]) = values else {
        return None;
    };
    Some(DVec3::new(r, g, b))
}

/// True if colours of whole numbers are 0 to 255. Only all of them together tell, because a single
/// one may be black.
fn are_in_bytes(mut colours: impl Iterator<Item = DVec3>) -> bool {
    colours.any(|colour| is_whole(colour) && colour.max_element() > 1.0)
}

fn is_whole(colour: DVec3) -> bool {
    colour.fract() == DVec3::ZERO
}

/// Returns a colour scaled to 0 to 1. Colours with a fraction are so already, up to rounding, unless
/// a channel is so large that they must be averages of bytes.
fn scaled(colour: DVec3, is_in_bytes: bool) -> DVec3 {
    let is_byte = if is_whole(colour) {
        is_in_bytes
    } else {
        colour.max_element() > 8.0
    };
    if is_byte { colour / 255.0 } else { colour }
}
