//! The polygons that readers collect, and the common rules that make a mesh from them.

use super::Parts;
use super::error::{Place, Refusal};
use crate::mesh::newell::unit_normal;
use crate::mesh::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use crate::note::{Note, Notes};
use crate::picture::Rgb;
use core::mem::take;
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::format;
use std::string::String;
use std::vec;
use std::vec::Vec;

/// The polygons of a file, as far as it was read.
#[derive(Default)]
pub(super) struct Polygons {
    pub positions: Vec<DVec3>,
    /// The index and the place of each position that a mesh cannot have.
    unusable: Vec<(u32, Place)>,
    /// One normal of any length per position; empty if the file has none.
    pub normals: Vec<DVec3>,
    /// One linear colour per position; empty if the file has none.
    pub colours: Vec<Vec3>,
    /// The corners of all whole polygons, then the corners so far of the polygon that is being
    /// read.
    pub corners: Vec<u32>,
    ends: Vec<u32>,
    materials: Vec<Material>,
    material_names: Vec<String>,
    /// The material of each polygon, up to the last polygon that has one; `u32::MAX` for none.
    of_polygons: Vec<u32>,
    /// The material of each colour, by the bits of the colour.
    of_colours: HashMap<[u32; 3], u32>,
    /// The smoothing group of each polygon; empty if the file does not say which polygons are
    /// smooth.
    groups: Vec<u32>,
    /// What the reader and the polygons' rules skipped or changed.
    pub notes: Notes,
}

/// Stands for no material, and for no index.
const NONE: u32 = u32::MAX;

impl Polygons {
    /// Returns how many polygons there are.
    pub(super) fn count(&self) -> usize {
        self.ends.len()
    }

    /// Returns how many corners whole polygons have.
    fn whole(&self) -> usize {
        self.ends.last().map_or(0, |&end| end as usize)
    }

    /// Adds a position. If a mesh cannot have it, no polygon may use it.
    pub(super) fn push_position(&mut self, position: DVec3, place: Place) {
        if !is_position(position) {
            self.unusable.push((self.positions.len() as u32, place));
        }
        self.positions.push(position);
    }

    /// Adds a note about positions that a mesh cannot have. Depth cameras write them for pixels
    /// without a depth, and no polygon uses them.
    ///
    /// # Errors
    /// If a polygon uses one.
    fn check_positions(&mut self) -> Result<(), Refusal> {
        if self.unusable.is_empty() {
            return Ok(());
        }
        let mut is_used = vec![false; self.positions.len()];
        let whole = &self.corners[..self.whole()];
        for &corner in whole {
            is_used[corner as usize] = true;
        }
        let mut unusable = self.unusable.iter();
        if let Some(&(index, place)) = unusable.find(|(index, _)| is_used[*index as usize]) {
            let [x, y, z] = self.positions[index as usize].to_array();
            let problem =
                format!("vertex {index} is {x}, {y}, {z}: expected finite numbers, at most 3.4e38");
            return Err(Refusal::at(place, problem));
        }
        for _ in &self.unusable {
            let text = "a vertex that no face uses is not finite, or over 3.4e38: it is left out";
            let kind = "vertex-not-finite";
            self.notes.count(kind, 0, || Note::warning(kind, text));
        }
        Ok(())
    }

    /// Ends the polygon whose corners were pushed. A corner that repeats the one before it is left
    /// out, and so is a polygon with fewer than three different corners. Returns false if the
    /// polygon is left out.
    ///
    /// # Errors
    /// If the mesh becomes larger than a mesh may be.
    pub(super) fn end_polygon(&mut self, place: Place) -> Result<bool, Refusal> {
        let start = self.whole();
        let own = &self.corners[start..];
        // Nearly all polygons pass this test and are not copied.
        let is_sound = match *own {
            [a, b, c] => a != b && b != c && c != a,
            [first, .., last] if own.len() > 3 => {
                first != last && own.windows(2).all(|two| two[0] != two[1])
            }
            _ => false,
        };
        if !is_sound {
            let mut kept = self.corners.split_off(start);
            let written = kept.len();
            kept.dedup();
            while kept.len() > 1 && kept[0] == kept[kept.len() - 1] {
                kept.pop();
            }
            if kept.len() < 3 {
                count_small_face(&mut self.notes, 0);
                return Ok(false);
            }
            if kept.len() < written {
                count_repeated_corner(&mut self.notes, 0);
            }
            self.corners.append(&mut kept);
        }
        let most = PolygonMesh::MAX_POLYGONS;
        if self.ends.len() >= most {
            let problem = format!("too many polygons: expected at most {most}");
            return Err(Refusal::at(place, problem));
        }
        let most = PolygonMesh::MAX_CORNERS;
        if self.corners.len() > most {
            let problem = format!("too many corners: expected at most {most}");
            return Err(Refusal::at(place, problem));
        }
        self.ends.push(self.corners.len() as u32);
        Ok(true)
    }

    /// Adds a material and returns its index. An empty name means no name.
    pub(super) fn add_material(&mut self, material: Material, name: String) -> u32 {
        self.materials.push(material);
        self.material_names.push(name);
        self.materials.len() as u32 - 1
    }

    /// Returns the index of the material for a linear colour, which is added if it is new.
    pub(super) fn material_of_colour(&mut self, colour: Rgb) -> u32 {
        // Adding 0.0 turns −0.0 into 0.0, so that equal colours have equal bits.
        let key = colour.map(|channel| (channel + 0.0).to_bits());
        if let Some(index) = self.of_colours.get(&key) {
            return *index;
        }
        let index = self.add_material(coloured(colour), String::new());
        self.of_colours.insert(key, index);
        index
    }

    /// Sets the material of the last polygon.
    #[cfg(feature = "gltf")]
    pub(super) fn set_material(&mut self, material: u32) {
        if let Some(last) = self.ends.len().checked_sub(1) {
            self.set_material_of(last, material);
        }
    }

    fn set_material_of(&mut self, polygon: usize, material: u32) {
        let count = self.of_polygons.len().max(polygon + 1);
        self.of_polygons.resize(count, NONE);
        self.of_polygons[polygon] = material;
    }

    /// Sets the last polygon's material to one of a linear colour, as
    /// [`set_colour_of`](Self::set_colour_of).
    pub(super) fn set_colour(&mut self, colour: DVec3) {
        if let Some(last) = self.ends.len().checked_sub(1) {
            self.set_colour_of(last, colour);
        }
    }

    /// Sets a polygon's material to one of a linear colour. A colour that is not finite is ignored;
    /// one that is out of range is clamped.
    pub(super) fn set_colour_of(&mut self, polygon: usize, colour: DVec3) {
        if !colour.is_finite() {
            let text = "a colour of a face is not three finite numbers: the face has none";
            let kind = "face-colour-not-finite";
            self.notes.count(kind, 0, || Note::warning(kind, text));
            return;
        }
        let within = colour.clamp(DVec3::ZERO, DVec3::ONE);
        if within != colour {
            let text = "a colour of a face is out of range and is clamped to it";
            let kind = "face-colour-clamped";
            self.notes.count(kind, 0, || Note::warning(kind, text));
        }
        let material = self.material_of_colour(within.as_vec3().to_array());
        self.set_material_of(polygon, material);
    }

    /// Marks the last polygon as flat or smooth.
    #[cfg(feature = "gltf")]
    pub(super) fn set_flat(&mut self, is_flat: bool) {
        const SMOOTH: u32 = PolygonMesh::FACETED + 1;
        self.groups.resize(self.ends.len(), SMOOTH);
        if let (true, Some(last)) = (is_flat, self.groups.last_mut()) {
            *last = PolygonMesh::FACETED;
        }
    }

    /// Makes the mesh of these polygons.
    ///
    /// # Errors
    /// If a polygon uses a position that a mesh cannot have.
    pub(super) fn finish(mut self) -> Result<Parts, Refusal> {
        self.check_positions()?;
        self.drop_unused();
        let mut builder = MeshBuilder::from_f64(&self.positions);
        builder.read_from_file();
        let of_flat = self.positions_of_flat();
        builder.set_polygons(take(&mut self.corners), take(&mut self.ends));
        if !self.normals.is_empty() {
            let unit = |normal: &DVec3| unit_normal(*normal).map_or(Vec3::ZERO, |n| n.as_vec3());
            let values: Vec<Vec3> = self.normals.iter().map(unit).collect();
            let zeros = values.iter().filter(|normal| **normal == Vec3::ZERO);
            // A glTF file with flat polygons has zeros for their vertices, which are no fault of
            // the file.
            let (zeros, own) = (zeros.count() - of_flat, values.len() - of_flat);
            if zeros == own {
                let text = "the normals of the file have length zero: they are not used";
                self.notes.push(Note::warning("normals-all-zero", text));
            } else {
                if zeros > 0 {
                    let text = format!(
                        "{zeros} of {own} normals of the file have length zero: their corners count as without a normal"
                    );
                    self.notes.push(Note::warning("normals-zero", text));
                }
                let corners = None;
                builder.normals(GivenNormals { values, corners });
            }
        }
        self.choose_colours();
        self.add_colours(&mut builder);
        builder.stating_smoothing(!self.groups.is_empty());
        if self.groups.contains(&PolygonMesh::FACETED) {
            builder.smoothing_groups(take(&mut self.groups));
        }
        if !self.of_polygons.is_empty() {
            let polygons = builder.polygon_count();
            self.of_polygons.resize(polygons, NONE);
            builder.materials(self.materials, self.of_polygons);
            if self.material_names.iter().any(|name| !name.is_empty()) {
                builder.material_names(self.material_names);
            }
        }
        Ok(Parts {
            builder,
            positions: self.positions,
            notes: self.notes,
        })
    }

    /// Returns how many positions have no normal because their polygons are flat. Flat and smooth
    /// polygons share none.
    fn positions_of_flat(&self) -> usize {
        let mut is_flat = vec![false; self.positions.len()];
        let mut start = 0;
        for (&end, &group) in self.ends.iter().zip(&self.groups) {
            if group == PolygonMesh::FACETED {
                for &corner in &self.corners[start..end as usize] {
                    is_flat[corner as usize] = true;
                }
            }
            start = end as usize;
        }
        is_flat.into_iter().filter(|is_flat| *is_flat).count()
    }

    /// Drops the colours of faces, or those of vertices, if the file has both: their product would
    /// be the colour of neither. Vertices of one colour are what programs write that colour faces.
    fn choose_colours(&mut self) {
        let are_finite = self.colours.iter().all(|colour| colour.is_finite());
        if self.of_colours.is_empty() || self.colours.is_empty() || !are_finite {
            return;
        }
        let text = if self.colours.iter().all(|colour| *colour == self.colours[0]) {
            self.colours.clear();
            "vertices and faces have colours: those of the faces are used, as all vertices have one"
        } else {
            self.of_polygons.clear();
            "vertices and faces have colours: those of the faces are not used"
        };
        self.notes.push(Note::warning("colours-of-both", text));
    }

    /// Passes the colours of positions to the builder if all are finite.
    fn add_colours(&mut self, builder: &mut MeshBuilder) {
        if self.colours.is_empty() {
            return;
        }
        if self.colours.iter().any(|colour| !colour.is_finite()) {
            let text = "a colour is not three finite numbers: the colours are not used";
            self.notes.push(Note::warning("colours-not-finite", text));
            return;
        }
        let is_outside = |c: &Vec3| c.min_element() < 0.0 || c.max_element() > 1.0;
        if self.colours.iter().any(is_outside) {
            let text = "a colour is not within 0 to 1: what is shown is clamped at each pixel";
            self.notes.push(Note::warning("colours-over-range", text));
            if look_like_bytes(self.colours.iter().copied()) {
                self.notes.push(like_bytes());
            }
        }
        // A surface cannot reflect less than nothing.
        let colours = take(&mut self.colours).into_iter();
        builder.colours(colours.map(|colour| colour.max(Vec3::ZERO)).collect());
    }

    /// Drops positions that no polygon uses. They must not count for the view or for rounding.
    fn drop_unused(&mut self) {
        self.corners.truncate(self.whole());
        let Some(new) = indices_of_used(&self.corners, self.positions.len()) else {
            return;
        };
        keep(&mut self.positions, &new);
        keep(&mut self.normals, &new);
        keep(&mut self.colours, &new);
        let corners = self.corners.iter_mut();
        corners.for_each(|corner| *corner = new[*corner as usize]);
    }
}

/// Returns the new index of each of `count` entries after those that no corner uses are dropped,
/// and [`NONE`] for the dropped ones. Returns `None` if all are used.
pub(super) fn indices_of_used(corners: &[u32], count: usize) -> Option<Vec<u32>> {
    // First 0 marks the used entries, then they get ascending indices.
    let mut new = vec![NONE; count];
    corners.iter().for_each(|&corner| new[corner as usize] = 0);
    if !new.contains(&NONE) {
        return None;
    }
    let used = new.iter_mut().filter(|index| **index == 0);
    used.zip(0..).for_each(|(index, used)| *index = used);
    Some(new)
}

/// Drops the entries without a new index: see [`indices_of_used`].
pub(super) fn keep<T>(entries: &mut Vec<T>, new: &[u32]) {
    let mut indices = new.iter();
    entries.retain(|_| indices.next().is_some_and(|index| *index != NONE));
}

/// Counts a face that is left out. `line` is 0 if it has no line.
pub(super) fn count_small_face(notes: &mut Notes, line: usize) {
    let text = "a face of fewer than three different corners is left out";
    let kind = "face-small";
    notes.count(kind, line, || Note::warning(kind, text));
}

/// Counts a face with a corner twice in a row. `line` is 0 if it has no line.
pub(super) fn count_repeated_corner(notes: &mut Notes, line: usize) {
    let text = "a corner that repeats the one before it is left out";
    let kind = "face-corner-repeated";
    notes.count(kind, line, || Note::warning(kind, text));
}

/// Returns the note about values behind the last face.
pub(super) fn file_goes_on() -> Note {
    let text = "the file goes on after the last face that it counts: the rest is ignored";
    Note::warning("file-goes-on", text)
}

/// The kind of [`points_or_lines`].
pub(super) const POINTS_OR_LINES: &str = "points-or-lines";

/// Returns the note about points and lines.
pub(super) fn points_or_lines() -> Note {
    Note::warning(POINTS_OR_LINES, "points and lines are not drawn")
}

/// Returns the note about colours that [`look_like_bytes`].
pub(super) fn like_bytes() -> Note {
    let text = "the colours look like 0 to 255: divide them by 255";
    Note::warning("colours-like-bytes", text)
}

/// True if linear colours look like bytes: most channels above 0 are also over 1, and all are at
/// most 255. One channel must be over 8, because colours that are only a little too bright are no
/// bytes.
pub(super) fn look_like_bytes(colours: impl Iterator<Item = Vec3>) -> bool {
    let (mut most, mut over, mut lit) = (0f32, 0usize, 0usize);
    for channel in colours.flat_map(|colour| colour.to_array()) {
        most = most.max(channel);
        over += usize::from(channel > 1.0);
        lit += usize::from(channel > 0.0);
    }
    most > 8.0 && most <= 255.0 && 2 * over > lit
}

/// True if a mesh can have this position: its coordinates are finite and in the range of an `f32`.
pub(super) fn is_position(position: DVec3) -> bool {
    // `is_finite` is needed besides the maximum, which may ignore a NaN.
    position.is_finite() && position.abs().max_element() <= f64::from(f32::MAX)
}

/// Returns a material with a colour of the file and a faint highlight. The coefficients sum to 1
/// for white, so that nothing is clamped under one light of strength 1.
pub fn coloured(colour: Rgb) -> Material {
    const AMBIENT: f32 = 0.1;
    const DIFFUSE: f32 = 0.8;
    const SPECULAR: f32 = 0.1;
    Material {
        ambient: colour.map(|channel| AMBIENT * channel),
        diffuse: colour.map(|channel| DIFFUSE * channel),
        specular: [SPECULAR; 3],
        ..Material::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn colours_in_bytes_are_recognised() {
        let look = |colours: &[[f32; 3]]| look_like_bytes(colours.iter().copied().map(Vec3::from));
        assert!(look(&[
            [255.0, 0.0, 0.0],
            [0.0, 255.0, 0.0],
            [0.0; 3],
            [1.0, 9.0, 2.0]
        ]));
        assert!(look(&[[9.0, 0.0, 0.0]]));
        assert!(!look(&[[256.0, 9.0, 9.0]]));
        assert!(!look(&[[255.0, 0.5, 0.5]]));
        assert!(!look(&[[1.5, 2.0, 8.0]]));
        assert!(!look(&[[1.0; 3]]) && !look(&[]));
    }

    #[test]
    fn polygons_are_cleaned_and_positions_without_one_are_dropped() {
        let mut polygons = Polygons {
            positions: (0..6)
                .map(|i| DVec3::new(i.into(), (i * i).into(), 0.0))
                .collect(),
            normals: vec![DVec3::Z; 6],
            colours: (0..6).map(|i| Vec3::splat(i as f32 / 8.0)).collect(),
            ..Polygons::default()
        };
        let mut kept = Vec::new();
        for corners in [&[1, 2, 4][..], &[1, 1, 2], &[1, 2], &[2, 2, 4, 5, 2], &[]] {
            polygons.corners.extend_from_slice(corners);
            kept.push(
                polygons
                    .end_polygon(Place::Line(1))
                    .expect("within the limits"),
            );
        }
        assert_eq!(kept, [true, false, false, true, false]);
        let red = polygons.material_of_colour([1.0, 0.0, 0.0]);
        polygons.set_material_of(1, red);
        assert_eq!(polygons.material_of_colour([1.0, -0.0, 0.0]), red);
        let parts = polygons.finish().expect("a mesh");
        let mesh = parts.builder.finish().expect("a mesh");
        let found: Vec<&[u32]> = mesh.polygons().collect();
        assert_eq!(found, [&[0, 1, 2], &[1, 2, 3]]);
        assert_eq!(mesh.positions()[2], Vec3::new(4.0, 16.0, 0.0));
        assert_eq!(mesh.colours()[3], Vec3::splat(5.0 / 8.0));
        assert_eq!(
            mesh.given_normals().map(|given| given.values.len()),
            Some(4)
        );
        assert_eq!([0, 1].map(|p| mesh.polygon_material(p)), [None; 2]);
        let told = [
            "a face of fewer than three different corners is left out (3 times)",
            "a corner that repeats the one before it is left out",
            "vertices and faces have colours: those of the faces are not used",
        ];
        let notes: Vec<String> = parts.notes.iter().map(ToString::to_string).collect();
        assert_eq!(notes, told);
    }
}
