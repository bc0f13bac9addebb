//! Polygon meshes.
//!
//! A [`PolygonMesh`] holds polygons with any number of sides. Concave polygons are allowed, and
//! nothing is ever triangulated. [`builtin`] makes shapes by name, `read` reads files (with the
//! feature `io`), and [`MeshBuilder`] collects polygons that a program makes itself:
//!
//! ```
//! use fastphong::mesh::MeshBuilder;
//! use fastphong::mesh::vertex_normals::{NormalSource, vertex_normals};
//! use glam::Vec3;
//!
//! let mut builder = MeshBuilder::new(vec![Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y]);
//! builder.polygon(&[0, 1, 2, 3]);
//! let mesh = builder.finish()?;
//! assert_eq!(mesh.polygon_count(), 1);
//! let normals = vertex_normals(&mesh, NormalSource::Averaged);
//! assert_eq!(normals.corners.len(), 4);
//! # Ok::<(), fastphong::mesh::MeshError>(())
//! ```

mod material;

pub use material::Material;
pub mod builtin;
mod cap_sums;
#[doc(hidden)]
pub mod edges;
mod fans;
#[doc(hidden)]
pub mod newell;
#[doc(hidden)]
pub mod orientation;
mod origin;
#[cfg(feature = "io")]
pub mod read;
mod shapes;
pub mod vertex_normals;
#[doc(hidden)]
pub mod weld;
pub(crate) mod winding;

use self::vertex_normals::NormalRule;
#[cfg(feature = "io")]
use self::vertex_normals::{NormalSource, NormalWeight};
use crate::note::{Note, Setting};
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use glam::{DVec3, Vec3};

/// Normals that came with a mesh: from its formula or its file.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenNormals {
    /// Unit vectors. A zero vector stands for a missing normal, which the average of L21 3.1
    /// replaces.
    pub values: Vec<Vec3>,
    /// The index into `values` for each corner, in the order of [`PolygonMesh::corners`]. `None`
    /// means that `values[i]` belongs to position `i`.
    pub corners: Option<Vec<u32>>,
}

impl GivenNormals {
    /// Makes normals of which the one at index i belongs to position i.
    pub fn by_vertex(values: impl IntoIterator<Item = Vec3>) -> Self {
        GivenNormals {
            values: values.into_iter().collect(),
            corners: None,
        }
    }

    /// Makes normals that corners share: `corners` holds the index into `values` for each corner,
    /// in the order of [`PolygonMesh::corners`].
    pub fn by_corner(values: Vec<Vec3>, corners: Vec<u32>) -> Self {
        GivenNormals {
            values,
            corners: Some(corners),
        }
    }
}

/// A mesh of polygons that share positions.
///
/// [`MeshBuilder`] makes it and checks every index once, so that code that reads a mesh can rely on
/// all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonMesh {
    origin: DVec3,
    positions: Vec<Vec3>,
    corners: Vec<u32>,
    /// The end of each polygon in `corners`; it starts where the previous one ends.
    ends: Vec<u32>,
    /// One entry per polygon, or none for a mesh of one part.
    parts: Vec<u32>,
    /// One entry per polygon, or none for a mesh without groups.
    smoothing_groups: Vec<u32>,
    /// True if the mesh's file says which polygons are smooth, even if it only says that all are.
    states_smoothing: bool,
    /// True if polygons are faceted only because the file has no normals for them. Nobody decided
    /// that they are, so whoever asks for averages gets them.
    is_flat_for_lack: bool,
    /// True if the file says of a material in use that its polygons are seen from both sides.
    is_double_sided: bool,
    given_normals: Option<GivenNormals>,
    colours: Vec<Vec3>,
    attributes: Vec<[f32; 4]>,
    materials: Vec<Material>,
    /// The names of the materials in their file; empty if they have none.
    material_names: Vec<String>,
    /// An index into `materials` per polygon. An index past the end means no material.
    polygon_materials: Vec<u32>,
    was_read: bool,
    /// The axis that points up in files of this format, if the format has a custom.
    up_by_custom: Option<char>,
    normal_rule: NormalRule,
}

impl PolygonMesh {
    /// The most polygons that a mesh may have: 16 million. An `f32` holds every index up to that
    /// exactly.
    pub const MAX_POLYGONS: usize = 1 << 24;
    /// The most corners that all polygons together may have: 128 million.
    pub const MAX_CORNERS: usize = 1 << 27;

    /// The smoothing group of polygons that are not smoothed: each of their corners has the
    /// polygon's own normal.
    pub const FACETED: u32 = 0;

    /// Returns the point of model space that [`PolygonMesh::positions`] are relative to. It is 0
    /// unless [`MeshBuilder::from_f64`] made the mesh and the mesh lies far from 0.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Returns the positions, relative to [`PolygonMesh::origin`].
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Returns how many polygons the mesh has.
    pub fn polygon_count(&self) -> usize {
        self.ends.len()
    }

    /// Returns all corners, polygon after polygon. Each is an index into
    /// [`PolygonMesh::positions`].
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Returns the range of polygon `p` in [`PolygonMesh::corners`].
    pub fn corner_range(&self, p: usize) -> core::ops::Range<usize> {
        let start = if p == 0 { 0 } else { self.ends[p - 1] as usize };
        start..self.ends[p] as usize
    }

    /// Returns the corners of polygon `p`: indices into [`PolygonMesh::positions`],
    /// counter-clockwise seen from outside.
    pub fn polygon(&self, p: usize) -> &[u32] {
        &self.corners[self.corner_range(p)]
    }

    /// Returns all polygons in order.
    pub fn polygons(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        (0..self.polygon_count()).map(|p| self.polygon(p))
    }

    /// Returns the part of the mesh that polygon `p` belongs to. In an OBJ file this is its object
    /// (`o`). Vertex normals are never averaged across parts.
    pub fn part(&self, p: usize) -> u32 {
        self.parts.get(p).copied().unwrap_or(0)
    }

    /// True if the mesh has more than one part.
    pub fn has_parts(&self) -> bool {
        !self.parts.is_empty()
    }

    /// Returns the smoothing group of polygon `p`: [`PolygonMesh::FACETED`] if it is not smoothed,
    /// `None` if the mesh has no groups and all of it is smooth.
    pub fn smoothing_group(&self, p: usize) -> Option<u32> {
        self.smoothing_groups.get(p).copied()
    }

    /// True if the mesh has smoothing groups.
    pub fn has_smoothing_groups(&self) -> bool {
        !self.smoothing_groups.is_empty()
    }

    /// True if the mesh has smoothing groups, or its file puts all polygons into one of them.
    pub fn states_smoothing(&self) -> bool {
        self.states_smoothing || self.has_smoothing_groups()
    }

    /// True if polygons are faceted only because the file has no normals for them.
    /// [`NormalSource::Averaged`](vertex_normals::NormalSource::Averaged) smooths them.
    #[doc(hidden)]
    pub fn is_flat_for_lack(&self) -> bool {
        self.is_flat_for_lack
    }

    /// True if the file says of a material in use that its polygons are seen from both sides.
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub fn is_double_sided(&self) -> bool {
        self.is_double_sided
    }

    /// Returns the normals that came with the mesh, if it has some.
    pub fn given_normals(&self) -> Option<&GivenNormals> {
        self.given_normals.as_ref()
    }

    /// Returns the colour of each position as linear red, green and blue. The slice is empty if the
    /// mesh has no colours.
    pub fn colours(&self) -> &[Vec3] {
        &self.colours
    }

    /// True if positions have colours that a scene may light. Attributes take the place of colours,
    /// so a mesh with attributes has none.
    pub(crate) fn has_lit_colours(&self) -> bool {
        self.attributes.is_empty() && !self.colours.is_empty()
    }

    /// Returns four values for each position, which methods outside this crate may read. The slice
    /// is empty if the mesh has none.
    pub fn attributes(&self) -> &[[f32; 4]] {
        &self.attributes
    }

    /// Returns the materials that polygons refer to. The slice may be empty.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Returns the material of polygon `p` as an index into [`PolygonMesh::materials`]; `None`
    /// stands for the default material.
    pub fn polygon_material(&self, p: usize) -> Option<usize> {
        self.polygon_materials
            .get(p)
            .map(|&m| m as usize)
            .filter(|&m| m < self.materials.len())
    }

    /// True if the mesh was read from a file. Its polygons may then be wound either way, while a
    /// shape by formula is known to be counter-clockwise.
    #[doc(hidden)]
    pub fn was_read(&self) -> bool {
        self.was_read
    }

    /// Returns the axis that points up in files of this format, if the format has a custom: `z` for
    /// STL, `y` for glTF.
    pub fn up_by_custom(&self) -> Option<char> {
        self.up_by_custom
    }

    /// Returns a note for a mesh in a format where z points up by custom.
    pub(crate) fn up_note(&self) -> Option<Note> {
        let is_z = self.up_by_custom == Some('z');
        let note = || Note::remark("mesh/up", "z is up in most STL files: ");
        is_z.then(|| note().set(Setting::word("camera.up", "z")))
    }

    /// Returns the rule for vertex normals when the mesh is drawn on its own and the caller sets no
    /// other rule: uniform averages for a shape by formula or a mesh that a program builds, the
    /// custom of its format for a mesh that was read from a file.
    pub fn normal_rule(&self) -> NormalRule {
        self.normal_rule
    }

    /// Returns the name of a material in the mesh's file, if it has one.
    pub fn material_name(&self, material: usize) -> Option<&str> {
        self.material_names.get(material).map(String::as_str)
    }

    /// Sets the material of all polygons that have none.
    #[cfg(feature = "io")]
    pub(crate) fn set_default_material(&mut self, default: Material) {
        let index = self.materials.len() as u32;
        self.materials.push(default);
        self.polygon_materials.resize(self.ends.len(), index);
        let materials = self.polygon_materials.iter_mut();
        // Any index past the end meant no material; the minimum turns each of them into the new
        // index.
        materials.for_each(|material| *material = index.min(*material));
    }

    /// Returns the smallest and the largest coordinates, in model space, of all positions that
    /// polygons use; `None` if there are no polygons.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let mut used = self.corners.iter().map(|&c| self.positions[c as usize]);
        let first = used.next()?;
        let (low, high) = used.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        Some((self.origin + low.as_dvec3(), self.origin + high.as_dvec3()))
    }
}

/// The reason why a mesh cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// A position, normal, colour or attribute holds a NaN or an infinity.
    #[non_exhaustive]
    NotFinite {
        /// `position`, `normal`, `colour` or `attribute`.
        what: &'static str,
        /// Its index among all of its kind, from 0.
        index: usize,
    },
    /// A corner of a polygon refers to a position or normal that does not exist.
    #[non_exhaustive]
    IndexOutOfRange {
        /// `position` or `normal`.
        what: &'static str,
        /// The polygon, counted from 0.
        polygon: usize,
        /// The index that does not exist.
        index: u32,
        /// How many positions or normals there are.
        count: usize,
    },
    /// A polygon has fewer than three corners.
    TooFewCorners {
        /// The polygon, counted from 0.
        polygon: usize,
    },
    /// There is not one colour per position.
    ColourCount {
        /// How many colours there are.
        found: usize,
        /// How many positions there are.
        expected: usize,
    },
    /// There is not one set of four attributes per position.
    AttributeCount {
        /// How many sets there are.
        found: usize,
        /// How many positions there are.
        expected: usize,
    },
    /// There is not one part, or not one smoothing group, per polygon.
    GroupCount {
        /// How many entries there are.
        found: usize,
        /// How many polygons there are.
        expected: usize,
    },
    /// The mesh has more polygons than [`PolygonMesh::MAX_POLYGONS`] or more corners than
    /// [`PolygonMesh::MAX_CORNERS`].
    TooLarge,
    /// There is not one normal per position, or not one normal index per corner.
    NormalCount {
        /// How many there are.
        found: usize,
        /// How many positions or corners there are.
        expected: usize,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            MeshError::NotFinite { what, index } => {
                write!(f, "{what} {index} is not finite: expected finite numbers")
            }
            MeshError::IndexOutOfRange {
                what,
                polygon,
                index,
                count,
            } => write!(
                f,
                "polygon {polygon} uses {what} {index}: expected an index below {count}"
            ),
            MeshError::TooFewCorners { polygon } => {
                write!(f, "polygon {polygon} has fewer than three corners")
            }
            MeshError::TooLarge => write!(
                f,
                "the mesh is over the limit of {} polygons or {} corners",
                PolygonMesh::MAX_POLYGONS,
                PolygonMesh::MAX_CORNERS
            ),
            MeshError::ColourCount { found, expected } => {
                write!(f, "{found} colours where {expected} were expected")
            }
            MeshError::AttributeCount { found, expected } => {
                write!(
                    f,
                    "attributes of {found} positions where {expected} were expected"
                )
            }
            MeshError::GroupCount { found, expected } => {
                write!(
                    f,
                    "groups of {found} polygons where {expected} were expected"
                )
            }
            MeshError::NormalCount { found, expected } => {
                write!(f, "{found} normals where {expected} were expected")
            }
        }
    }
}

impl core::error::Error for MeshError {}

/// Collects positions and polygons, then checks them once.
#[derive(Clone, Debug)]
pub struct MeshBuilder {
    mesh: PolygonMesh,
}

impl MeshBuilder {
    /// Starts a mesh with these positions.
    pub fn new(positions: Vec<Vec3>) -> Self {
        MeshBuilder::around(DVec3::ZERO, positions)
    }

    /// Starts a mesh with positions in `f64`. If they lie far from 0 compared with their extent,
    /// they are rounded to `f32` relative to [`PolygonMesh::origin`], so that small details
    /// survive. Pass only positions that polygons use: others count toward the extent.
    ///
    /// ```
    /// use fastphong::mesh::MeshBuilder;
    /// use glam::DVec3;
    ///
    /// let far = DVec3::new(500_000.0, 0.0, 5_400_000.0);
    /// let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| far + 0.3 * p);
    /// let mut builder = MeshBuilder::from_f64(&corners);
    /// builder.polygon(&[0, 1, 2]);
    /// let mesh = builder.finish()?;
    /// assert_eq!(mesh.origin() + mesh.positions()[0].as_dvec3(), far);
    /// assert!(mesh.positions().iter().all(|p| p.length() < 1.0));
    /// # Ok::<(), fastphong::mesh::MeshError>(())
    /// ```
    pub fn from_f64(positions: &[DVec3]) -> Self {
        let origin = origin::origin(positions);
        let relative = positions.iter().map(|&p| (p - origin).as_vec3());
        MeshBuilder::around(origin, relative.collect())
    }

    /// Starts a mesh with positions relative to an origin.
    #[doc(hidden)]
    pub fn around(origin: DVec3, positions: Vec<Vec3>) -> Self {
        MeshBuilder {
            mesh: PolygonMesh {
                origin,
                positions,
                corners: Vec::new(),
                ends: Vec::new(),
                parts: Vec::new(),
                smoothing_groups: Vec::new(),
                states_smoothing: false,
                is_flat_for_lack: false,
                is_double_sided: false,
                given_normals: None,
                colours: Vec::new(),
                attributes: Vec::new(),
                materials: Vec::new(),
                material_names: Vec::new(),
                polygon_materials: Vec::new(),
                was_read: false,
                up_by_custom: None,
                normal_rule: NormalRule::default(),
            },
        }
    }

    /// Reserves memory for `polygons` more polygons that have `corners` corners together.
    pub fn reserve(&mut self, polygons: usize, corners: usize) {
        self.mesh.ends.reserve_exact(polygons);
        self.mesh.corners.reserve_exact(corners);
    }

    /// Adds a polygon. `corners` are indices into the positions, counter-clockwise seen from
    /// outside.
    pub fn polygon(&mut self, corners: &[u32]) -> &mut Self {
        self.mesh.corners.extend_from_slice(corners);
        // The cast may wrap only past MAX_CORNERS, and `finish` refuses such a mesh by the length
        // of `corners` itself.
        self.mesh.ends.push(self.mesh.corners.len() as u32);
        self
    }

    /// Sets the mesh's own normals.
    pub fn normals(&mut self, normals: GivenNormals) -> &mut Self {
        self.mesh.given_normals = Some(normals);
        self
    }

    /// Sets the part that each polygon belongs to: see [`PolygonMesh::part`]. An empty list makes
    /// one part of all polygons.
    pub fn parts(&mut self, of_polygons: Vec<u32>) -> &mut Self {
        self.mesh.parts = of_polygons;
        self
    }

    /// Sets the smoothing group of each polygon: see [`PolygonMesh::smoothing_group`]. An empty
    /// list means no groups.
    pub fn smoothing_groups(&mut self, of_polygons: Vec<u32>) -> &mut Self {
        self.mesh.smoothing_groups = of_polygons;
        self
    }

    /// Sets one colour per position: linear red, green and blue.
    pub fn colours(&mut self, colours: Vec<Vec3>) -> &mut Self {
        self.mesh.colours = colours;
        self
    }

    /// Sets four attributes per position. They take the place of colours: a method may read them at
    /// each vertex through [`LightAt::attributes`](crate::shading::LightAt::attributes).
    pub fn attributes(&mut self, attributes: Vec<[f32; 4]>) -> &mut Self {
        self.mesh.attributes = attributes;
        self
    }

    /// Sets the materials, and for each polygon an index into them. An index past the end means no
    /// material.
    pub fn materials(&mut self, materials: Vec<Material>, of_polygons: Vec<u32>) -> &mut Self {
        self.mesh.materials = materials;
        self.mesh.polygon_materials = of_polygons;
        self
    }

    /// Marks the mesh as read from a file: see [`PolygonMesh::was_read`]. Its rule is then to use
    /// the file's normals, and averages weighted by angle where it has none.
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub fn read_from_file(&mut self) -> &mut Self {
        self.mesh.was_read = true;
        self.normal_rule(NormalRule {
            source: NormalSource::Auto,
            weight: NormalWeight::Angle,
        })
    }

    /// Sets the rule for vertex normals: see [`PolygonMesh::normal_rule`].
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub fn normal_rule(&mut self, rule: NormalRule) -> &mut Self {
        self.mesh.normal_rule = rule;
        self
    }

    /// Sets the axis that points up in files of this format.
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub fn up_by_custom(&mut self, axis: char) -> &mut Self {
        self.mesh.up_by_custom = Some(axis);
        self
    }

    /// Sets all polygons at once: their corners one after the other, and the end of each polygon in
    /// that list.
    #[cfg(feature = "io")]
    pub(crate) fn set_polygons(&mut self, corners: Vec<u32>, ends: Vec<u32>) -> &mut Self {
        (self.mesh.corners, self.mesh.ends) = (corners, ends);
        self
    }

    /// Returns how many polygons were added so far.
    #[cfg(feature = "io")]
    pub(crate) fn polygon_count(&self) -> usize {
        self.mesh.ends.len()
    }

    /// Sets if the mesh's file says which polygons are smooth.
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub fn stating_smoothing(&mut self, states: bool) -> &mut Self {
        self.mesh.states_smoothing = states;
        self
    }

    /// Says that polygons are faceted only because the file has no normals for them.
    #[cfg(feature = "gltf")]
    #[doc(hidden)]
    pub fn flat_without_normals(&mut self) -> &mut Self {
        self.mesh.is_flat_for_lack = true;
        self
    }

    /// Says that the file wants polygons to be seen from both sides.
    #[cfg(feature = "gltf")]
    #[doc(hidden)]
    pub fn double_sided(&mut self) -> &mut Self {
        self.mesh.is_double_sided = true;
        self
    }

    /// Sets the names of the materials, in the order of the materials.
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub fn material_names(&mut self, names: Vec<String>) -> &mut Self {
        self.mesh.material_names = names;
        self
    }

    /// Checks the mesh and returns it.
    ///
    /// # Errors
    /// [`MeshError`] if a position, normal, colour or attribute is not finite, an index does not
    /// exist, a polygon has fewer than three corners, a list does not have one entry per position,
    /// polygon or corner as it should, or the mesh is over its limits.
    pub fn finish(self) -> Result<PolygonMesh, MeshError> {
        let mesh = self.mesh;
        if mesh.ends.len() > PolygonMesh::MAX_POLYGONS
            || mesh.corners.len() > PolygonMesh::MAX_CORNERS
        {
            return Err(MeshError::TooLarge);
        }
        check_finite("position", &mesh.positions)?;
        for (polygon, corners) in mesh.polygons().enumerate() {
            if corners.len() < 3 {
                return Err(MeshError::TooFewCorners { polygon });
            }
            check_indices("position", polygon, corners, mesh.positions.len())?;
        }
        for groups in [&mesh.parts, &mesh.smoothing_groups] {
            let (found, expected) = (groups.len(), mesh.ends.len());
            if !groups.is_empty() && found != expected {
                return Err(MeshError::GroupCount { found, expected });
            }
        }
        check_finite("colour", &mesh.colours)?;
        if !mesh.colours.is_empty() && mesh.colours.len() != mesh.positions.len() {
            return Err(MeshError::ColourCount {
                found: mesh.colours.len(),
                expected: mesh.positions.len(),
            });
        }
        let is_finite = |values: &[f32; 4]| values.iter().all(|value| value.is_finite());
        if let Some(index) = mesh.attributes.iter().position(|four| !is_finite(four)) {
            let what = "attribute";
            return Err(MeshError::NotFinite { what, index });
        }
        if !mesh.attributes.is_empty() && mesh.attributes.len() != mesh.positions.len() {
            return Err(MeshError::AttributeCount {
                found: mesh.attributes.len(),
                expected: mesh.positions.len(),
            });
        }
        if let Some(normals) = &mesh.given_normals {
            check_finite("normal", &normals.values)?;
            let (found, expected) = match &normals.corners {
                None => (normals.values.len(), mesh.positions.len()),
                Some(corners) => (corners.len(), mesh.corners.len()),
            };
            if found != expected {
                return Err(MeshError::NormalCount { found, expected });
            }
            if let Some(corners) = &normals.corners {
                for polygon in 0..mesh.polygon_count() {
                    check_indices(
                        "normal",
                        polygon,
                        &corners[mesh.corner_range(polygon)],
                        normals.values.len(),
                    )?;
                }
            }
        }
        Ok(mesh)
    }
}

fn check_finite(what: &'static str, vectors: &[Vec3]) -> Result<(), MeshError> {
    match vectors.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(MeshError::NotFinite { what, index }),
        None => Ok(()),
    }
}

fn check_indices(
    what: &'static str,
    polygon: usize,
    indices: &[u32],
    count: usize,
) -> Result<(), MeshError> {
    match indices.iter().find(|&&i| i as usize >= count) {
        Some(&index) => Err(MeshError::IndexOutOfRange {
            what,
            polygon,
            index,
            count,
        }),
        None => Ok(()),
    }
}
