//! PLY files, the polygon file format of Stanford: text, or binary in either byte order.
//!
//! The reader uses positions, normals and colours of vertices, faces of any number of sides with
//! their colours, and strips of triangles. It skips all other elements and properties of the
//! header.

mod body;
mod header;

use super::error::Refusal;
use super::polygons::{Polygons, file_goes_on};
use super::words::Words;
use super::{Beside, MeshFormat, Parts};
use crate::note::Note;
use body::{Body, decode};
use glam::DVec3;
use header::{Coding, Element, Header, Property};
use std::format;
use std::vec::Vec;

/// The format.
pub(super) struct Ply;

impl MeshFormat for Ply {
    fn name(&self) -> &'static str {
        "a PLY file"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["ply"]
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        let mut words = Words::new(&bytes[..bytes.len().min(1 << 12)], 0, 1);
        words.next() == Some(b"ply") && words.next_in_line().is_none()
    }

    fn read(&self, bytes: &[u8], _: Beside) -> Result<Parts, Refusal> {
        if bytes.is_empty() {
            return Err(Refusal::whole("is empty: expected a PLY file"));
        }
        if !self.recognises(bytes) {
            return Err(Refusal::whole(
                "does not begin with `ply`: expected a PLY file",
            ));
        }
        let header = header::read(bytes)?;
        let mut polygons = read_body(bytes, &header, false);
        // Some programs write more words in each line than their header says. Read as one stream of
        // words, their file fails or has words left over. It is then read again line by line.
        let is_whole = matches!(&polygons, Ok((_, true)));
        if header.coding == Coding::Text
            && !is_whole
            && let Ok((mut by_lines, true)) = read_body(bytes, &header, true)
            && by_lines.count() > 0
        {
            let text = "lines have more words than the header says: they are ignored";
            by_lines.notes.push(Note::warning("words-left-over", text));
            polygons = Ok((by_lines, true));
        }
        let (mut polygons, is_whole) = polygons.map_err(|refusal| Refusal {
            notes: header.notes.clone(),
            ..refusal
        })?;
        if polygons.count() == 0 {
            return Err(no_polygon(&polygons));
        }
        if !is_whole {
            polygons.notes.push(file_goes_on());
        }
        polygons.notes.append(header.notes);
        if header.has_texture {
            let text = "textures are not drawn";
            polygons.notes.push(Note::warning("texture", text));
        }
        polygons.finish()
    }
}

/// Makes the error for a file without polygons.
fn no_polygon(polygons: &Polygons) -> Refusal {
    Refusal::whole(match polygons.positions.len() {
        0 => "has no polygon: expected elements `vertex` and `face`".into(),
        points => format!(
            "has {points} points and no polygon: expected faces (MeshLab and Open3D make a surface from points)"
        ),
    })
}

/// Reads all elements, and returns true with them if they end where the file does. With `by_lines`,
/// each element of a text begins a new line, and the rest of the previous line is skipped.
fn read_body(bytes: &[u8], header: &Header, by_lines: bool) -> Result<(Polygons, bool), Refusal> {
    let vertices = header.elements.iter().filter(|e| e.name == "vertex");
    let vertices = vertices.map(|element| element.count).sum();
    let mut body = Body::new(bytes, header, by_lines);
    let mut polygons = Polygons::default();
    // An element without properties has no bytes. Skipping it avoids a loop over whatever count the
    // header claims.
    let elements = header.elements.iter();
    for element in elements.filter(|element| !element.properties.is_empty()) {
        match element.name.as_str() {
            "vertex" => read_vertices(&mut body, element, &mut polygons)?,
            "face" => read_faces(&mut body, element, vertices, &mut polygons)?,
            "tristrips" => read_strips(&mut body, element, vertices, &mut polygons)?,
            _ => {
                for _ in 0..element.count {
                    body.end_element();
                    skip_all(&mut body, &element.properties)?;
                }
            }
        }
    }
    body.end_element();
    let is_whole = body.is_at_its_end();
    Ok((polygons, is_whole))
}

fn skip_all(body: &mut Body, properties: &[Property]) -> Result<(), Refusal> {
    properties
        .iter()
        .try_for_each(|property| body.skip(property))
}

/// The properties of vertices that the reader uses, with their possible names: position, normal,
/// colour. An index into this list is a *slot*.
const VERTEX: [&[&str]; 9] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx", "normal_x"],
    &["ny", "normal_y"],
    &["nz", "normal_z"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
];

/// True if a property is the list of a face's or a strip's corners.
fn is_corners(property: &Property) -> bool {
    property.count.is_some() && matches!(&*property.name, "vertex_indices" | "vertex_index")
}

/// Returns the slot of each property in [`VERTEX`], and `None` for others. Slots below `first` do
/// not count.
fn slots(element: &Element, first: usize) -> Vec<Option<usize>> {
    let slot = |property: &Property| {
        let names = VERTEX.iter().skip(first);
        let mut names = names.map(|names| names.contains(&&*property.name));
        let found = names.position(|is_own| is_own);
        found
            .filter(|_| property.count.is_none())
            .map(|slot| first + slot)
    };
    element.properties.iter().map(slot).collect()
}

/// Returns the factors that scale a full colour channel to 1.
fn scales(element: &Element, slots: &[Option<usize>]) -> [f64; 3] {
    [6, 7, 8].map(|channel| {
        let property = slots.iter().position(|slot| *slot == Some(channel));
        property.map_or(1.0, |at| 1.0 / element.properties[at].kind.full())
    })
}

/// Returns the size of an element in bytes; `None` if it has lists, whose size varies.
fn row_size(element: &Element) -> Option<usize> {
    let sizes = element
        .properties
        .iter()
        .map(|property| match property.count {
            Some(_) => None,
            None => Some(property.kind.size()),
        });
    sizes.sum()
}

/// Returns the value of each slot of a vertex whose bytes are `row`; 0 for a slot that the file
/// does not have.
#[inline]
fn values_of_row(row: &[u8], is_big: bool, element: &Element, slots: &[Option<usize>]) -> [f64; 9] {
    let (mut values, mut rest) = ([0.0; 9], row);
    for (property, slot) in element.properties.iter().zip(slots) {
        let (own, others) = rest.split_at(property.kind.size().min(rest.len()));
        if let Some(slot) = slot {
            values[*slot] = decode(own, property.kind, is_big);
        }
        rest = others;
    }
    values
}

/// Reads the value of each slot of a vertex in a text, or of an element with lists.
#[inline]
fn values_one_by_one(
    body: &mut Body,
    element: &Element,
    slots: &[Option<usize>],
) -> Result<[f64; 9], Refusal> {
    let mut values = [0.0; 9];
    for (property, slot) in element.properties.iter().zip(slots) {
        match slot {
            Some(slot) => values[*slot] = body.value(property.kind)?,
            None => body.skip(property)?,
        }
    }
    Ok(values)
}

fn read_vertices(
    body: &mut Body,
    element: &Element,
    polygons: &mut Polygons,
) -> Result<(), Refusal> {
    let slots = slots(element, 0);
    let has = |first: usize| (first..first + 3).all(|slot| slots.contains(&Some(slot)));
    if !has(0) {
        let problem = "its vertices have no x, y and z: expected properties of these names";
        return Err(Refusal::whole(problem));
    }
    let scales = scales(element, &slots);
    let (has_normals, has_colours) = (has(3), has(6));
    let row_size = row_size(element);
    let room = body.room(element);
    polygons.positions.reserve(room);
    polygons.normals.reserve(if has_normals { room } else { 0 });
    polygons.colours.reserve(if has_colours { room } else { 0 });
    for _ in 0..element.count {
        body.end_element();
        let place = body.place();
        let values = match row_size.map(|size| body.row(size)).transpose()?.flatten() {
            Some((row, is_big)) => values_of_row(row, is_big, element, &slots),
            None => values_one_by_one(body, element, &slots)?,
        };
        let [x, y, z, nx, ny, nz, r, g, b] = values;
        let position = DVec3::new(x, y, z);
        let place = match body {
            Body::Text { words, .. } => words.place(),
            Body::Binary { .. } => place,
        };
        polygons.push_position(position, place);
        if has_normals {
            polygons.normals.push(DVec3::new(nx, ny, nz));
        }
        if has_colours {
            let [r_scale, g_scale, b_scale] = scales;
            let colour = DVec3::new(r * r_scale, g * g_scale, b * b_scale);
            polygons.colours.push(colour.as_vec3());
        }
    }
    Ok(())
}

/// Reads the index of a vertex, of which there are `vertices`. Returns `None` for −1, which ends a
/// strip.
#[inline]
fn read_index(
    body: &mut Body,
    property: &Property,
    vertices: usize,
) -> Result<Option<u32>, Refusal> {
    let index = body.value(property.kind)?;
    if index == -1.0 {
        return Ok(None);
    }
    if index.fract() == 0.0 && index >= 0.0 && index < vertices as f64 {
        Ok(Some(index as u32))
    } else {
        Err(body.no_index(index, vertices))
    }
}

fn read_faces(
    body: &mut Body,
    element: &Element,
    vertices: usize,
    polygons: &mut Polygons,
) -> Result<(), Refusal> {
    if !element.properties.iter().any(is_corners) {
        return match element.count {
            0 => Ok(()),
            _ => Err(Refusal::whole(
                "its faces have no list `vertex_indices`: expected a property of this name",
            )),
        };
    }
    let slots = slots(element, 6);
    // If lines have more words than the header says, the words behind the corners may mean
    // anything.
    let has_colours =
        !body.is_by_lines() && [6, 7, 8].iter().all(|slot| slots.contains(&Some(*slot)));
    let scales = scales(element, &slots);
    for _ in 0..element.count {
        body.end_element();
        let mut colour = [0.0; 3];
        for (property, slot) in element.properties.iter().zip(&slots) {
            match (slot, property.count) {
                (Some(slot), _) => colour[slot - 6] = body.value(property.kind)?,
                (None, Some(kind)) if is_corners(property) => {
                    for _ in 0..body.count(kind)? {
                        match read_index(body, property, vertices)? {
                            Some(index) => polygons.corners.push(index),
                            None => return Err(body.no_index(-1.0, vertices)),
                        }
                    }
                }
                _ => body.skip(property)?,
            }
        }
        if polygons.end_polygon(body.place())? && has_colours {
            polygons.set_colour(DVec3::from(colour) * DVec3::from(scales));
        }
    }
    Ok(())
}

/// Reads strips of triangles. Each corner from the third on makes a triangle with the two before
/// it, and every second triangle is turned around so that all face one way. An index of −1 begins a
/// new strip.
fn read_strips(
    body: &mut Body,
    element: &Element,
    vertices: usize,
    polygons: &mut Polygons,
) -> Result<(), Refusal> {
    for _ in 0..element.count {
        body.end_element();
        for property in &element.properties {
            let kind = match property.count {
                Some(kind) if is_corners(property) => kind,
                _ => {
                    body.skip(property)?;
                    continue;
                }
            };
            let (mut before, mut length) = ([0; 2], 0usize);
            for _ in 0..body.count(kind)? {
                let Some(corner) = read_index(body, property, vertices)? else {
                    length = 0;
                    continue;
                };
                let [a, b] = before;
                if length >= 2 {
                    let triangle = match length % 2 {
                        0 => [a, b, corner],
                        _ => [b, a, corner],
                    };
                    polygons.corners.extend(triangle);
                    polygons.end_polygon(body.place())?;
                }
                before = [b, corner];
                length += 1;
            }
        }
    }
    Ok(())
}
