//! Collects the triangles and the materials of a glTF file's nodes.

use super::super::Parts;
use super::super::error::{Place, Refusal, quote};
use super::super::polygons::{POINTS_OR_LINES, Polygons, coloured, is_position, points_or_lines};
use super::accessors::Buffers;
use super::document::{Document, Node, entry, numbers};
use super::nodes::Pose;
use super::primitives::{self, Triangles};
use crate::mesh::{Material, PolygonMesh};
use crate::note::Note;
use glam::{DVec3, Vec3};
use serde_json::Value;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::format;

/// The polygons of the nodes that were added so far.
pub(super) struct Reader<'a> {
    document: &'a Document,
    /// True if a primitive of the file has a material.
    has_materials: bool,
    polygons: Polygons,
    /// The triangles of primitives that were read before, by the indices of mesh and primitive.
    /// Many nodes may share a mesh.
    known: HashMap<(usize, usize), Option<Triangles>>,
    /// The material of the mesh for each material of the file.
    materials: HashMap<Option<usize>, u32>,
    has_normals: bool,
    has_colours: bool,
    /// True if a material in use is seen from both sides.
    is_double_sided: bool,
}

impl<'a> Reader<'a> {
    /// Begins to collect. `document` has the materials.
    pub(super) fn new(document: &'a Document) -> Self {
        let primitives = document.meshes.iter().flat_map(|mesh| &mesh.primitives);
        let mut materials = primitives.map(|primitive| primitive.material);
        Reader {
            document,
            has_materials: materials.any(|material| material.is_some()),
            polygons: Polygons::default(),
            known: HashMap::new(),
            materials: HashMap::new(),
            has_normals: false,
            has_colours: false,
            is_double_sided: false,
        }
    }

    /// Adds the mesh of a node in all its poses.
    ///
    /// # Errors
    /// If something of the mesh cannot be read, or there is too much.
    pub(super) fn add(
        &mut self,
        node: &Node,
        poses: &[Pose],
        buffers: &mut Buffers,
    ) -> Result<(), Refusal> {
        let Some(index) = node.mesh else {
            return Ok(());
        };
        let mesh = entry(&self.document.meshes, index, "mesh")?;
        let weights = node.weights.as_ref().or(mesh.weights.as_ref());
        if weights.is_some_and(|weights| weights.iter().any(|weight| *weight != 0.0)) {
            self.warn("morph-targets", "morph targets are not applied");
        }
        for (own, primitive) in mesh.primitives.iter().enumerate() {
            let key = (index, own);
            if let Entry::Vacant(unread) = self.known.entry(key) {
                unread.insert(primitives::read(primitive, buffers)?);
            }
            let material = self.material(primitive.material)?;
            // Taken out while `place` borrows the reader, and put back.
            let triangles = self.known.remove(&key).flatten();
            match &triangles {
                Some(triangles) => {
                    for pose in poses {
                        self.place(triangles, pose, material)?;
                    }
                }
                None => self.polygons.notes.push(points_or_lines()),
            }
            self.known.insert(key, triangles);
        }
        Ok(())
    }

    /// Returns the material of the mesh for a material of the file. A part without one is white, as
    /// glTF says, unless no part of the file has one.
    fn material(&mut self, index: Option<usize>) -> Result<Option<u32>, Refusal> {
        if let Some(known) = self.materials.get(&index) {
            return Ok(Some(*known));
        }
        let white = Value::Null;
        let material = match index {
            Some(index) => entry(&self.document.materials, index, "material")?,
            None if self.has_materials => &white,
            None => return Ok(None),
        };
        let extensions = &material["extensions"];
        let specular = &extensions["KHR_materials_pbrSpecularGlossiness"];
        let (colour, texture) = if specular.is_null() {
            let metallic = &material["pbrMetallicRoughness"];
            (&metallic["baseColorFactor"], &metallic["baseColorTexture"])
        } else {
            (&specular["diffuseFactor"], &specular["diffuseTexture"])
        };
        let emission = &material["emissiveFactor"];
        let [mode, cutoff, is_double_sided] =
            ["alphaMode", "alphaCutoff", "doubleSided"].map(|key| &material[key]);
        let is_some = |value: &Value| !value.is_null();
        for (value, is_right, expected) in [
            (material, material.is_object(), "an object"),
            (
                colour,
                numbers::<4>(colour).is_some(),
                "a colour of four numbers",
            ),
            (
                emission,
                numbers::<3>(emission).is_some(),
                "an emission of three numbers",
            ),
            (mode, mode.is_string(), "an `alphaMode` in quotes"),
            (cutoff, cutoff.is_number(), "an `alphaCutoff` of a number"),
            (
                is_double_sided,
                is_double_sided.is_boolean(),
                "a `doubleSided` of true or false",
            ),
        ] {
            if is_some(value) && !is_right {
                let index = index.unwrap_or_default();
                let text = format!(
                    "material {index} has something else where glTF has {expected}: it is ignored"
                );
                let kind = "material/wrong-type";
                self.polygons
                    .notes
                    .count(kind, 0, || Note::warning(kind, text));
            }
        }
        if is_some(texture) || is_some(&material["normalTexture"]) {
            self.warn("material/texture", "textures are not drawn");
        }
        let colour @ [r, g, b, alpha] = numbers(colour).unwrap_or([1.0; 4]);
        let is_opaque = match mode.as_str() {
            Some("BLEND") => alpha >= 1.0 && !is_some(texture),
            Some("MASK") => alpha >= cutoff.as_f64().unwrap_or(0.5) && !is_some(texture),
            _ => true,
        };
        if !is_opaque {
            let text = "transparency is not drawn, all surfaces are opaque";
            self.warn("material/transparency", text);
        }
        if numbers(emission).unwrap_or([0.0; 3]) != [0.0; 3] {
            self.warn("material/emission", "emission is not drawn");
        }
        if is_some(&extensions["KHR_materials_unlit"]) {
            self.warn("material/unlit", "unlit materials are drawn lit");
        }
        self.is_double_sided |= is_double_sided == true;
        if colour.iter().any(|channel| !(0.0..=1.0).contains(channel)) {
            let kind = "material/clamped";
            let text = "a colour of a material is out of 0 to 1 and is clamped to it";
            self.polygons
                .notes
                .count(kind, 0, || Note::warning(kind, text));
        }
        let own: Material = coloured([r, g, b].map(|channel| channel.clamp(0.0, 1.0) as f32));
        let name = material["name"].as_str().map(quote).unwrap_or_default();
        let added = self.polygons.add_material(own, name);
        self.materials.insert(index, added);
        Ok(Some(added))
    }

    /// True if a primitive of points or lines was left out.
    pub(super) fn has_points_or_lines(&self) -> bool {
        self.polygons.notes.has(POINTS_OR_LINES)
    }

    /// Returns how many triangles there are so far.
    pub(super) fn count(&self) -> usize {
        self.polygons.count()
    }

    /// Adds triangles where a node places them.
    fn place(
        &mut self,
        own: &Triangles,
        pose: &Pose,
        material: Option<u32>,
    ) -> Result<(), Refusal> {
        // Then no vertex is left to tell the winding.
        if own.triangles.is_empty() {
            return Ok(());
        }
        let before = self.polygons.positions.len();
        let most = PolygonMesh::MAX_CORNERS;
        if own.positions.len() > most - before {
            let problem = format!("too many corners: expected at most {most}");
            return Err(Refusal::whole(problem));
        }
        self.place_vertices(own, pose)?;
        let is_flat = own.normals.is_empty();
        // A mirroring transform turns the winding around, so its triangles are turned back.
        let is_mirrored = pose.of_vertex(own, 0).matrix3.determinant() < 0.0;
        let polygons = &mut self.polygons;
        for triangle in &own.triangles {
            let mut corners = triangle.map(|corner| before as u32 + corner);
            if is_mirrored {
                corners.swap(1, 2);
            }
            polygons.corners.extend(corners);
            if polygons.end_polygon(Place::Byte(0))? {
                polygons.set_flat(is_flat);
                if let Some(material) = material {
                    polygons.set_material(material);
                }
            }
        }
        Ok(())
    }

    /// Adds the vertices of triangles.
    fn place_vertices(&mut self, own: &Triangles, pose: &Pose) -> Result<(), Refusal> {
        let polygons = &mut self.polygons;
        let before = polygons.positions.len();
        let three = |v: &[f32; 3]| DVec3::from_array(v.map(f64::from));
        for (v, position) in own.positions.iter().enumerate() {
            let position = pose.of_vertex(own, v).transform_point3(three(position));
            if !is_position(position) {
                let problem = "a position is not finite, or its node moves it past 3.4e38: expected finite numbers";
                return Err(Refusal::whole(problem));
            }
            polygons.positions.push(position);
        }
        self.has_normals |= !own.normals.is_empty();
        if self.has_normals {
            // Earlier vertices without normals get zeros.
            polygons.normals.resize(before, DVec3::ZERO);
            // The cofactor matrix: the inverse transpose times the determinant, whose sign is taken
            // off. It needs no inverse, so a flattening transform does no harm.
            let turned = |(v, n): (usize, &[f32; 3])| {
                let matrix = pose.of_vertex(own, v).matrix3;
                let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
                let (n, sign) = (three(n), matrix.determinant().signum());
                sign * (y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z)
            };
            let turned = own.normals.iter().enumerate().map(turned);
            polygons.normals.extend(turned);
            polygons
                .normals
                .resize(polygons.positions.len(), DVec3::ZERO);
        }
        self.has_colours |= !own.colours.is_empty();
        if self.has_colours {
            // Vertices without a colour get white, which changes nothing.
            polygons.colours.resize(before, Vec3::ONE);
            let colours = own.colours.iter().map(|c| Vec3::from_array(*c));
            polygons.colours.extend(colours);
            polygons.colours.resize(polygons.positions.len(), Vec3::ONE);
        }
        Ok(())
    }

    /// Adds a warning, unless it is there.
    fn warn(&mut self, kind: &'static str, text: &'static str) {
        self.polygons.notes.push(Note::warning(kind, text));
    }

    /// Returns the mesh and the notes.
    ///
    /// # Errors
    /// If a triangle uses a position that a mesh cannot have.
    pub(super) fn finish(self) -> Result<Parts, Refusal> {
        let mut parts = self.polygons.finish()?;
        parts.builder.up_by_custom('y');
        parts.builder.flat_without_normals();
        if self.is_double_sided {
            parts.builder.double_sided();
        }
        Ok(parts)
    }
}
