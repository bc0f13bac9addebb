//! OFF files, the object file format of Geomview: text, with colours and normals of vertices and
//! colours of faces.

use super::error::{Place, Refusal, quote};
use super::polygons::{Polygons, file_goes_on, look_like_bytes};
use super::words::{Words, number, text};
use super::{Beside, MeshFormat, Parts};
use crate::note::{Note, Notes};
use glam::{DVec3, Vec3};
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
        let head = read_head(&mut words)?;
        let polygons = read_body(&words, &head)?;
        if polygons.count() == 0 {
            let problem = "has no polygon: expected faces of at least three corners";
            return Err(Refusal::whole(problem));
        }
        polygons.finish()
    }
}

/// Returns the words of a file. Comments begin with `#`.
fn words(bytes: &[u8]) -> Words<'_> {
    Words::new(bytes, 0, 1).with_comments()
}

/// The keyword and the counts. The letters before `OFF` list the properties of vertices besides
/// their positions, in any order.
struct Head {
    /// `N`: a normal.
    has_normals: bool,
    /// `C`: a colour.
    has_colours: bool,
    /// `ST`: two texture coordinates.
    has_texture: bool,
    /// `4`: a fourth coordinate.
    has_weight: bool,
    vertices: usize,
    faces: usize,
}

impl Head {
    /// Returns the index of a vertex's normal among its values.
    fn normal(&self) -> usize {
        3 + usize::from(self.has_weight)
    }

    /// Returns the index of a vertex's colour among its values.
    fn colour(&self) -> usize {
        self.normal() + 3 * usize::from(self.has_normals)
    }
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

/// Reads the keyword and the counts of vertices, faces and edges.
fn read_head(words: &mut Words) -> Result<Head, Refusal> {
    let expected = "expected OFF, COFF, NOFF or CNOFF";
    let Some(word) = words.next() else {
        return Err(Refusal::whole(format!("is empty: {expected}")));
    };
    let Some((letters, glued)) = split_keyword(word) else {
        let problem = format!("`{}`: {expected}", quote(&text(word)));
        return Err(Refusal::at(words.place(), problem));
    };
    let has = |letter: u8| letters.contains(&letter);
    let mut before = words.clone();
    if before.next_in_line().is_some_and(|word| word == b"BINARY") {
        let problem = "is a binary OFF file: expected OFF text (meshconv and geomview write it)";
        return Err(Refusal::whole(problem));
    }
    if has(b'n') {
        let dimension = words.finite("the number of coordinates")?;
        if dimension != 3.0 {
            let problem = format!("{dimension} coordinates per vertex: expected 3");
            return Err(Refusal::at(words.place(), problem));
        }
    }
    let vertices = read_count(words, glued, "the number of vertices")?;
    let line = words.place();
    let faces = read_count(words, b"", "the number of faces")?;
    pass_over_edges(words, line == words.place());
    Ok(Head {
        has_normals: has(b'N'),
        has_colours: has(b'C'),
        has_texture: has(b'T'),
        has_weight: has(b'4'),
        vertices,
        faces,
    })
}

/// Skips the count of edges, which nobody needs and some files do not have. If the other counts are
/// in one line, it is in that line. Else it is alone in the next line.
fn pass_over_edges(words: &mut Words, are_in_one_line: bool) {
    let mut ahead = words.clone();
    let is_there = match ahead.next_in_line() {
        Some(_) => true,
        None if are_in_one_line => false,
        None => ahead.next().is_some() && ahead.clone().next_in_line().is_none(),
    };
    if is_there {
        *words = ahead;
    }
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

/// The meaning of line breaks in a file.
#[derive(Clone, Copy)]
struct Layout {
    /// True if each vertex has its own line, where further values may follow.
    has_vertex_lines: bool,
    /// True if a face's colour follows on the line of its last corner.
    has_face_lines: bool,
    /// How many values a vertex's colour has, in a file without lines of vertices.
    channels: usize,
}

/// Reads vertices and faces. Nearly all files have a line for each. A file that cannot be read so
/// may break its lines anywhere, as the format allows. It must then end with its last face.
fn read_body(words: &Words, head: &Head) -> Result<Polygons, Refusal> {
    const BY_LINES: Layout = Layout {
        has_vertex_lines: true,
        has_face_lines: true,
        channels: 0,
    };
    let mut by_lines = words.clone();
    by_lines.end_line();
    let refusal = match read_laid_out(by_lines, head, BY_LINES) {
        Ok((polygons, _)) => return Ok(polygons),
        Err(refusal) => refusal,
    };
    let channels: &[usize] = if head.has_colours { &[4, 3] } else { &[0] };
    for &channels in channels {
        for has_face_lines in [true, false] {
            let layout = Layout {
                has_vertex_lines: false,
                has_face_lines,
                channels,
            };
            if let Ok((polygons, true)) = read_laid_out(words.clone(), head, layout) {
                return Ok(polygons);
            }
        }
    }
    Err(refusal)
}

/// Reads vertices and faces. Returns true with them if the file ends there and all faces are
/// polygons.
fn read_laid_out(
    mut words: Words,
    head: &Head,
    layout: Layout,
) -> Result<(Polygons, bool), Refusal> {
    let mut polygons = Polygons::default();
    let of_vertices = read_vertices(&mut words, head, layout, &mut polygons)?;
    let (coloured, of_faces) = read_faces(&mut words, head, layout, &mut polygons)?;
    let is_whole = words.next().is_none();
    if !is_whole {
        polygons.notes.push(file_goes_on());
    }
    let ranges = [Range::of(&of_vertices), Range::of(&of_faces)];
    let colours = scaled(&of_vertices, ranges[0].or(ranges[1]), &mut polygons.notes);
    polygons.colours = colours.iter().map(|colour| colour.as_vec3()).collect();
    let colours = scaled(&of_faces, ranges[1].or(ranges[0]), &mut polygons.notes);
    for (polygon, colour) in coloured.into_iter().zip(colours) {
        polygons.set_colour_of(polygon, colour);
    }
    let is_whole = is_whole && polygons.count() == head.faces;
    Ok((polygons, is_whole))
}

/// Counts a case of a kind, whose note is a warning with this text.
fn count(notes: &mut Notes, kind: &'static str, place: Place, text: &'static str) {
    let line = match place {
        Place::Line(line) => line,
        Place::Byte(_) => 0,
    };
    notes.count(kind, line, || Note::warning(kind, text));
}

/// A number, and how it is written.
#[derive(Clone, Copy)]
struct Number {
    value: f64,
    /// True if it is written as an integer: `1`, but not `1.0`.
    is_integer: bool,
}

impl Number {
    fn read(word: &[u8]) -> Option<Number> {
        let value = number(word)?;
        let is_of_integer = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'+' | b'-');
        let is_integer = word.iter().all(is_of_integer);
        Some(Number { value, is_integer })
    }
}

/// Returns the vector of the first three numbers.
fn vector(numbers: &[Number]) -> DVec3 {
    DVec3::new(numbers[0].value, numbers[1].value, numbers[2].value)
}

/// Reads the values of a vertex, at least `least`, which need not be finite, and returns its place.
/// With `by_lines` it reads all numbers of the next line that is not blank.
fn read_values(
    words: &mut Words,
    least: usize,
    by_lines: bool,
    values: &mut Vec<Number>,
) -> Result<Place, Refusal> {
    const LAST: &str = "its last vertex";
    values.clear();
    let mut word = words.next();
    while let Some(found) = word {
        match Number::read(found) {
            Some(value) => values.push(value),
            // After the values that matter, the line may hold anything.
            None if values.len() >= least => break,
            None => return Err(words.no_number(found)),
        }
        word = match by_lines {
            true => words.next_in_line(),
            false if values.len() == least => None,
            false => words.next(),
        };
    }
    let place = words.place();
    match values.len() {
        0 => return Err(words.ends_before(LAST)),
        found if found < least && by_lines => {
            let problem = format!("{found} numbers: expected {least}");
            return Err(Refusal::at(place, problem));
        }
        found if found < least => return Err(words.ends_before(LAST)),
        _ if by_lines => drop(words.end_line()),
        _ => {}
    }
    Ok(place)
}

/// Reads vertices, and returns their colours as the file writes them; none if it has none.
fn read_vertices(
    words: &mut Words,
    head: &Head,
    layout: Layout,
    polygons: &mut Polygons,
) -> Result<Vec<Colour>, Refusal> {
    let (normal, colour) = (head.normal(), head.colour());
    let texture = 2 * usize::from(head.has_texture);
    let least = match (layout.has_vertex_lines, head.has_colours) {
        (true, true) => colour + 3,
        (true, false) => colour,
        (false, _) => colour + layout.channels + texture,
    };
    let mut values = Vec::new();
    let mut colours = Vec::new();
    let named = if head.has_colours { 4 } else { 0 };
    // The first line with values that the keyword does not name.
    let mut first_unnamed = None;
    for _ in 0..head.vertices {
        let place = read_values(words, least, layout.has_vertex_lines, &mut values)?;
        let mut position = vector(&values);
        if head.has_weight {
            let weight = values[3].value;
            if weight == 0.0 {
                let problem =
                    "a vertex with w = 0: expected another number, as x, y and z are divided by it";
                return Err(Refusal::at(place, problem));
            }
            position /= weight;
        }
        polygons.push_position(position, place);
        if head.has_normals {
            polygons.normals.push(vector(&values[normal..]));
        }
        let behind = &values[colour..];
        let others = behind.len().saturating_sub(texture);
        // Many programs write colours without the `C` in the keyword.
        if head.has_colours || matches!(others, 3 | 4) {
            colours.push(Colour::new(behind));
        }
        if others > named {
            first_unnamed = first_unnamed.or(Some(place));
        }
    }
    let is_colour = |colour: &Colour| colour.value.min_element() >= 0.0;
    let are_colours = colours.len() == head.vertices && colours.iter().all(is_colour);
    if !head.has_colours && are_colours {
        return Ok(colours);
    }
    if let Some(place) = first_unnamed {
        let text = "values that the keyword does not name follow a vertex: they are ignored";
        count(&mut polygons.notes, "vertex-values", place, text);
    }
    Ok(if head.has_colours {
        colours
    } else {
        Vec::new()
    })
}

/// Reads faces, and returns the polygons that have colours, with these as the file writes them. A
/// face has its corner count, then its corners, which may continue on further lines, and a colour
/// behind the last corner on its line.
fn read_faces(
    words: &mut Words,
    head: &Head,
    layout: Layout,
    polygons: &mut Polygons,
) -> Result<(Vec<usize>, Vec<Colour>), Refusal> {
    const LAST: &str = "the end of its last face";
    let (mut coloured, mut colours) = (Vec::new(), Vec::new());
    let mut behind = Vec::new();
    for _ in 0..head.faces {
        let sides = words.finite(LAST)?;
        if sides.fract() != 0.0 || sides < 0.0 {
            let problem = format!("a face of {sides} corners: expected a whole number");
            return Err(Refusal::at(words.place(), problem));
        }
        for _ in 0..sides as u64 {
            let corner = words.finite(LAST)?;
            if corner.fract() != 0.0 || !(0.0..head.vertices as f64).contains(&corner) {
                let last = head.vertices.saturating_sub(1);
                let problem =
                    format!("vertex index {corner} is out of range: expected 0 to {last}");
                return Err(Refusal::at(words.place(), problem));
            }
            polygons.corners.push(corner as u32);
        }
        let is_kept = polygons.end_polygon(words.place())?;
        if !layout.has_face_lines {
            continue;
        }
        behind.clear();
        let place = words.place();
        while let Some(word) = words.next_in_line() {
            match Number::read(word) {
                Some(value) => behind.push(value),
                // The rest is a remark.
                None => break,
            }
        }
        words.end_line();
        match behind.len() {
            // A single value would be an index into a table that the file does not have, and means
            // no colour.
            0 | 1 => {}
            3 | 4 if is_kept => {
                coloured.push(polygons.count() - 1);
                colours.push(Colour::new(&behind));
            }
            3 | 4 => {}
            _ => {
                let text = "the values behind a face's corners are no colour of three or four numbers: they are ignored";
                count(&mut polygons.notes, "face-values", place, text);
            }
        }
    }
    Ok((coloured, colours))
}

/// A colour as the file writes it.
#[derive(Clone, Copy)]
struct Colour {
    value: DVec3,
    /// True if all three channels are written as integers.
    is_integer: bool,
}

impl Colour {
    fn new(numbers: &[Number]) -> Colour {
        Colour {
            value: vector(numbers),
            is_integer: numbers[..3].iter().all(|number| number.is_integer),
        }
    }
}

/// The range of the channels of colours.
#[derive(Clone, Copy)]
enum Range {
    /// 0 to 1.
    Unit,
    /// 0 to 255.
    Bytes,
}

impl Range {
    /// Returns the range of all these colours. Integers are bytes and other numbers are 0 to 1, as
    /// the format says, unless these plainly are bytes. If all are the integers 0 and 1, the range
    /// is not known.
    fn of(colours: &[Colour]) -> Option<Range> {
        let is_over_one = |colour: &Colour| colour.value.max_element() > 1.0;
        if colours.iter().any(|colour| !colour.is_integer) {
            let are_bytes = look_like_bytes(written(colours, false));
            Some(if are_bytes { Range::Bytes } else { Range::Unit })
        } else {
            colours.iter().any(is_over_one).then_some(Range::Bytes)
        }
    }
}

/// Returns the colours that are written as integers, or those that are not.
fn written(colours: &[Colour], as_integers: bool) -> impl Iterator<Item = Vec3> {
    let colours = colours.iter();
    let own = colours.filter(move |colour| colour.is_integer == as_integers);
    own.map(|colour| colour.value.as_vec3())
}

/// Returns colours scaled to 0 to 1, and notes a range that is a guess.
fn scaled(colours: &[Colour], range: Option<Range>, notes: &mut Notes) -> Vec<DVec3> {
    let has_floats = colours.iter().any(|colour| !colour.is_integer);
    let are_bytes = match range {
        Some(Range::Bytes) => [true; 2],
        // A file of two programs.
        Some(Range::Unit) => [look_like_bytes(written(colours, true)), false],
        None => [false; 2],
    };
    let is_one = |colour: &Colour| colour.value.max_element() == 1.0;
    let guess = match range {
        Some(Range::Bytes) if has_floats => {
            "the colours look like 0 to 255, though not all are integers: they are divided by 255"
        }
        Some(Range::Unit) if are_bytes[0] => {
            "some colours are integers from 0 to 255, others are not: only the integers are divided by 255"
        }
        None if colours.iter().any(is_one) => {
            "the colours are integers from 0 to 1: they are not divided by 255"
        }
        _ => "",
    };
    if !guess.is_empty() {
        notes.push(Note::warning("colours-range", guess));
    }
    let scale = |colour: &Colour| {
        let is_byte = are_bytes[usize::from(!colour.is_integer)];
        if is_byte {
            colour.value / 255.0
        } else {
            colour.value
        }
    };
    colours.iter().map(scale).collect()
}
