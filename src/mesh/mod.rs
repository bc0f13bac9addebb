//! Polygon meshes: polygons of any number of sides, concave ones too, never triangulated.

mod material;

pub use material::Material;
pub mod builtin;
mod cap_sums;
#[doc(hidden)]
pub mod edges;
mod fans;
pub mod newell;
#[doc(hidden)]
pub mod orientation;
mod origin;
#[cfg(feature = "io")]
pub mod read;
pub mod shapes;
pub mod vertex_normals;
#[doc(hidden)]
pub mod weld;
pub(crate) mod winding;

use self::vertex_normals::NormalRule;
#[cfg(feature = "io")]
use self::vertex_normals::{NormalSource, NormalWeight};
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use glam::{DVec3, Vec3};

/// Normals that came with a mesh: by formula, or from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenNormals {
    /// Unit vectors, or zero where the source has none (the average of L21 3.1 is used there).
    pub values: Vec<Vec3>,
    /// The entry of `values` that each corner uses; `None` means that `values[i]` belongs to position `i`.
    pub corners: Option<Vec<u32>>,
}

/// A mesh of polygons with shared positions.
///
/// Made by [`MeshBuilder`], which checks every index, so that what reads a mesh need not.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonMesh {
    origin: DVec3,
    positions: Vec<Vec3>,
    corners: Vec<u32>,
    ends: Vec<u32>,
    parts: Vec<u32>,
    smoothing_groups: Vec<u32>,
    /// True if the file of the mesh says what is smooth, if only that all of it is.
    states_smoothing: bool,
    given_normals: Option<GivenNormals>,
    colours: Vec<Vec3>,
    attributes: Vec<[f32; 4]>,
    materials: Vec<Material>,
    /// The names of materials in their file; empty if they have none.
    material_names: Vec<String>,
    polygon_materials: Vec<u32>,
    was_read: bool,
    /// The axis that is up by the custom of the file's format.
    up_by_custom: Option<char>,
    normal_rule: NormalRule,
}

impl PolygonMesh {
    /// The most polygons that a mesh may have: 16 million, so that polygon numbers are exact in an `f32`.
    pub const MAX_POLYGONS: usize = 1 << 24;
    /// The most corners, all polygons together: 128 million.
    pub const MAX_CORNERS: usize = 1 << 27;

    /// The smoothing group of polygons that are not smoothed: all their corners have the polygon's own normal.
    pub const FACETED: u32 = 0;

    /// Returns the point of model space that [`PolygonMesh::positions`] count from: 0, unless the mesh was made by
    /// [`MeshBuilder::from_f64`] and lies far from 0.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Returns the positions, relative to [`PolygonMesh::origin`].
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Returns the number of polygons.
    pub fn polygon_count(&self) -> usize {
        self.ends.len()
    }

    /// Returns all corners, polygon after polygon: each an index into [`PolygonMesh::positions`].
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Returns the range of [`PolygonMesh::corners`] that polygon `p` has.
    pub fn corner_range(&self, p: usize) -> core::ops::Range<usize> {
        let start = if p == 0 { 0 } else { self.ends[p - 1] as usize };
        start..self.ends[p] as usize
    }

    /// Returns the corners of polygon `p`: indices into [`PolygonMesh::positions`], counter-clockwise seen from outside.
    pub fn polygon(&self, p: usize) -> &[u32] {
        &self.corners[self.corner_range(p)]
    }

    /// Returns all polygons in order.
    pub fn polygons(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        (0..self.polygon_count()).map(|p| self.polygon(p))
    }

    /// Returns the part of the mesh that polygon `p` belongs to: in an OBJ file its object (`o`). Vertex normals are never
    /// averaged over two parts.
    pub fn part(&self, p: usize) -> u32 {
        self.parts.get(p).copied().unwrap_or(0)
    }

    /// True if the mesh has more than one part.
    pub fn has_parts(&self) -> bool {
        !self.parts.is_empty()
    }

    /// Returns the smoothing group of polygon `p`, [`PolygonMesh::FACETED`] for none; `None` where the mesh has no groups
    /// and all of it is smooth.
    pub fn smoothing_group(&self, p: usize) -> Option<u32> {
        self.smoothing_groups.get(p).copied()
    }

    /// True if the mesh has smoothing groups.
    pub fn has_smoothing_groups(&self) -> bool {
        !self.smoothing_groups.is_empty()
    }

    /// True if the mesh has smoothing groups, or its file puts all polygons into one of them.
    #[doc(hidden)]
    pub fn states_smoothing(&self) -> bool {
        self.states_smoothing || self.has_smoothing_groups()
    }

    /// Returns the normals that came with the mesh, if any did.
    pub fn given_normals(&self) -> Option<&GivenNormals> {
        self.given_normals.as_ref()
    }

    /// Returns the colour of each position, linear red, green, blue; empty where the mesh has no colours.
    pub fn colours(&self) -> &[Vec3] {
        &self.colours
    }

    /// True if positions have colours, and no attributes in their place: a scene may light them.
    pub(crate) fn has_lit_colours(&self) -> bool {
        self.attributes.is_empty() && !self.colours.is_empty()
    }

    /// Returns four numbers for each position, for methods outside this crate; empty where the mesh has none.
    pub fn attributes(&self) -> &[[f32; 4]] {
        &self.attributes
    }

    /// Returns the materials that polygons refer to; may be empty.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Returns the material of polygon `p`: an index into [`PolygonMesh::materials`], `None` for the default material.
    pub fn polygon_material(&self, p: usize) -> Option<usize> {
        self.polygon_materials
            .get(p)
            .map(|&m| m as usize)
            .filter(|&m| m < self.materials.len())
    }

    /// True if the mesh was read from a file. Nobody vouches for the winding of its polygons then, as shapes by formula do.
    pub(crate) fn was_read(&self) -> bool {
        self.was_read
    }

    /// Returns the axis that is up by the custom of the format of the file, if it has one: `z` for STL, `y` for glTF.
    #[doc(hidden)]
    pub fn up_by_custom(&self) -> Option<char> {
        self.up_by_custom
    }

    /// Returns the rule for the vertex normals of the mesh when it is drawn on its own and nothing else is said: uniform averages
    /// for a shape by formula or a mesh that a program builds, what its format has for one that was read from a file.
    pub fn normal_rule(&self) -> NormalRule {
        self.normal_rule
    }

    /// Returns the name that the file of the mesh gives a material, if it gives it one.
    #[doc(hidden)]
    pub fn material_name(&self, material: usize) -> Option<&str> {
        self.material_names.get(material).map(String::as_str)
    }

    /// Gives `default` to the polygons without a material.
    #[cfg(feature = "io")]
    pub(crate) fn set_default_material(&mut self, default: Material) {
        let number = self.materials.len() as u32;
        self.materials.push(default);
        self.polygon_materials.resize(self.ends.len(), number);
        let materials = self.polygon_materials.iter_mut();
        materials.for_each(|material| *material = number.min(*material));
    }

    /// Returns the smallest and largest coordinates in model space over all positions that polygons use; `None` without
    /// polygons.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let mut used = self.corners.iter().map(|&c| self.positions[c as usize]);
        let first = used.next()?;
        let (low, high) = used.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        Some((self.origin + low.as_dvec3(), self.origin + high.as_dvec3()))
    }
}

/// A mesh that could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshError {
    /// A position, normal, colour or attribute holds a NaN or an infinity.
    NotFinite {
        /// The number of the vector, counted from 0.
        index: usize,
    },
    /// A polygon names a position, normal or material that does not exist.
    IndexOutOfRange {
        /// The polygon, counted from 0.
        polygon: usize,
        /// The index that it names.
        index: u32,
    },
    /// A polygon has fewer than three corners.
    TooFewCorners {
        /// The polygon, counted from 0.
        polygon: usize,
    },
    /// The colours are not one a position.
    ColourCount {
        /// The number found.
        found: usize,
        /// The number expected.
        expected: usize,
    },
    /// The attributes are not four numbers a position.
    AttributeCount {
        /// The number found.
        found: usize,
        /// The number expected.
        expected: usize,
    },
    /// The parts or the smoothing groups are not one a polygon.
    GroupCount {
        /// The number found.
        found: usize,
        /// The number expected.
        expected: usize,
    },
    /// More polygons than [`PolygonMesh::MAX_POLYGONS`] or more corners than [`PolygonMesh::MAX_CORNERS`].
    TooLarge,
    /// There is not one normal per position, or not one normal index per corner.
    NormalCount {
        /// The number found.
        found: usize,
        /// The number expected.
        expected: usize,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            MeshError::NotFinite { index } => write!(f, "vector {index} is not finite"),
            MeshError::IndexOutOfRange { polygon, index } => {
                write!(
                    f,
                    "polygon {polygon} names index {index}, which does not exist"
                )
            }
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
    /// Starts from `positions`.
    pub fn new(positions: Vec<Vec3>) -> Self {
        MeshBuilder::around(DVec3::ZERO, positions)
    }

    /// Starts from positions in `f64`, all of which should be used. Where they lie far from 0 compared with their extent,
    /// they are rounded to `f32` relative to [`PolygonMesh::origin`], so that what is small stays exact.
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

    fn around(origin: DVec3, positions: Vec<Vec3>) -> Self {
        MeshBuilder {
            mesh: PolygonMesh {
                origin,
                positions,
                corners: Vec::new(),
                ends: Vec::new(),
                parts: Vec::new(),
                smoothing_groups: Vec::new(),
                states_smoothing: false,
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

    /// Makes room for `polygons` polygons with `corners` corners together.
    pub fn reserve(&mut self, polygons: usize, corners: usize) {
        self.mesh.ends.reserve_exact(polygons);
        self.mesh.corners.reserve_exact(corners);
    }

    /// Adds a polygon: indices of its positions, counter-clockwise seen from outside.
    pub fn polygon(&mut self, corners: &[u32]) -> &mut Self {
        self.mesh.corners.extend_from_slice(corners);
        // A mesh past u32 is past MAX_CORNERS, and `finish` refuses it by the corners' own count.
        self.mesh.ends.push(self.mesh.corners.len() as u32);
        self
    }

    /// Adds the normals that belong to the mesh.
    pub fn normals(&mut self, normals: GivenNormals) -> &mut Self {
        self.mesh.given_normals = Some(normals);
        self
    }

    /// Adds the part that each polygon belongs to: see [`PolygonMesh::part`]. Empty for one part.
    pub fn parts(&mut self, of_polygons: Vec<u32>) -> &mut Self {
        self.mesh.parts = of_polygons;
        self
    }

    /// Adds the smoothing group of each polygon: see [`PolygonMesh::smoothing_group`]. Empty for none.
    pub fn smoothing_groups(&mut self, of_polygons: Vec<u32>) -> &mut Self {
        self.mesh.smoothing_groups = of_polygons;
        self
    }

    /// Adds colours, one a position: linear red, green, blue.
    pub fn colours(&mut self, colours: Vec<Vec3>) -> &mut Self {
        self.mesh.colours = colours;
        self
    }

    /// Adds attributes, four numbers a position: a method may read them at each vertex
    /// ([`Lit::attributes`](crate::shading::Lit::attributes)), in the place of colours.
    pub fn attributes(&mut self, attributes: Vec<[f32; 4]>) -> &mut Self {
        self.mesh.attributes = attributes;
        self
    }

    /// Adds materials, and for each polygon the one it has (an index past the end means none).
    pub fn materials(&mut self, materials: Vec<Material>, of_polygons: Vec<u32>) -> &mut Self {
        self.mesh.materials = materials;
        self.mesh.polygon_materials = of_polygons;
        self
    }

    /// Notes that the mesh is read from a file: see [`PolygonMesh::was_read`]. Its normals are those of the file, or averages
    /// by angle.
    #[cfg(feature = "io")]
    #[doc(hidden)]
    pub fn read_from_file(&mut self) -> &mut Self {
        self.mesh.was_read = true;
        self.normal_rule(NormalRule {
            source: NormalSource::Auto,
            weight: NormalWeight::Angle,
        })
    }

    /// Sets the rule for the vertex normals of the mesh on its own: see [`PolygonMesh::normal_rule`].
    #[cfg(feature = "io")]
    pub(crate) fn normal_rule(&mut self, rule: NormalRule) -> &mut Self {
        self.mesh.normal_rule = rule;
        self
    }

    /// Notes which axis is up by the custom of the format of the file.
    #[cfg(feature = "io")]
    pub(crate) fn up_by_custom(&mut self, axis: char) -> &mut Self {
        self.mesh.up_by_custom = Some(axis);
        self
    }

    /// Sets all polygons: their corners one after the other, and the number of them up to the end of each.
    #[cfg(feature = "io")]
    pub(crate) fn set_polygons(&mut self, corners: Vec<u32>, ends: Vec<u32>) -> &mut Self {
        (self.mesh.corners, self.mesh.ends) = (corners, ends);
        self
    }

    /// Returns the number of polygons so far.
    #[cfg(feature = "io")]
    pub(crate) fn polygon_count(&self) -> usize {
        self.mesh.ends.len()
    }

    /// Notes that the file of the mesh says what is smooth.
    #[cfg(feature = "io")]
    pub(crate) fn stating_smoothing(&mut self, states: bool) -> &mut Self {
        self.mesh.states_smoothing = states;
        self
    }

    /// Adds the names of the materials, in their order.
    #[cfg(feature = "io")]
    pub(crate) fn material_names(&mut self, names: Vec<String>) -> &mut Self {
        self.mesh.material_names = names;
        self
    }

    /// Checks and returns the mesh.
    ///
    /// # Errors
    /// [`MeshError`] when a vector is not finite, an index does not exist, a polygon has fewer than three corners, an
    /// attribute does not have as many entries as it should, or the mesh is over its limits.
    pub fn finish(self) -> Result<PolygonMesh, MeshError> {
        let mesh = self.mesh;
        if mesh.ends.len() > PolygonMesh::MAX_POLYGONS
            || mesh.corners.len() > PolygonMesh::MAX_CORNERS
        {
            return Err(MeshError::TooLarge);
        }
        check_finite(&mesh.positions)?;
        for (polygon, corners) in mesh.polygons().enumerate() {
            if corners.len() < 3 {
                return Err(MeshError::TooFewCorners { polygon });
            }
            check_indices(polygon, corners, mesh.positions.len())?;
        }
        for groups in [&mesh.parts, &mesh.smoothing_groups] {
            let (found, expected) = (groups.len(), mesh.ends.len());
            if !groups.is_empty() && found != expected {
                return Err(MeshError::GroupCount { found, expected });
            }
        }
        check_finite(&mesh.colours)?;
        if !mesh.colours.is_empty() && mesh.colours.len() != mesh.positions.len() {
            return Err(MeshError::ColourCount {
                found: mesh.colours.len(),
                expected: mesh.positions.len(),
            });
        }
        let is_finite = |numbers: &[f32; 4]| numbers.iter().all(|number| number.is_finite());
        if let Some(index) = mesh.attributes.iter().position(|four| !is_finite(four)) {
            return Err(MeshError::NotFinite { index });
        }
        if !mesh.attributes.is_empty() && mesh.attributes.len() != mesh.positions.len() {
            return Err(MeshError::AttributeCount {
                found: mesh.attributes.len(),
                expected: mesh.positions.len(),
            });
        }
        if let Some(normals) = &mesh.given_normals {
            check_finite(&normals.values)?;
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

fn check_finite(vectors: &[Vec3]) -> Result<(), MeshError> {
    match vectors.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(MeshError::NotFinite { index }),
        None => Ok(()),
    }
}

fn check_indices(polygon: usize, indices: &[u32], count: usize) -> Result<(), MeshError> {
    match indices.iter().find(|&&i| i as usize >= count) {
        Some(&index) => Err(MeshError::IndexOutOfRange { polygon, index }),
        None => Ok(()),
    }
}
