//! The mesh of a whole scene in world space, as OBJ and MTL files.

use super::formats::token;
use super::terms::exponent;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use fastphong::frame::{Geometry, PreparedScene};
use fastphong::mesh::Material;
use fastphong::scene::{Culling, Scene, SpecularModel};
use glam::DVec3;
use std::collections::HashMap;
use std::io::Write;

/// A material that faces use.
pub struct NamedMaterial {
    pub name: String,
    pub material: Material,
}

/// The faces and materials of a scene.
pub struct Mesh {
    /// The polygon of the scene of each face, in ascending order.
    pub faces: Vec<u32>,
    /// The materials in use.
    pub materials: Vec<NamedMaterial>,
    /// The index into `materials` for each material of the prepared scene.
    pub named: Vec<Option<usize>>,
    /// True if the colours of vertices multiply a material.
    pub is_coloured: bool,
}

impl Mesh {
    /// Collects the polygons that have a normal, and their materials.
    pub fn new(scene: &Scene, prepared: &PreparedScene) -> Mesh {
        let geometry = prepared.geometry();
        let has_normal = |p: &u32| geometry.faces[*p as usize] != [0.0; 3];
        let faces: Vec<u32> = (0..prepared.polygon_count() as u32)
            .filter(has_normal)
            .collect();
        let mut mesh = Mesh {
            materials: Vec::new(),
            named: vec![None; prepared.materials().len()],
            is_coloured: (0..prepared.materials().len() as u32).any(|m| prepared.is_coloured(m)),
            faces,
        };
        let names = names(scene);
        for &face in &mesh.faces {
            let index = material_of(prepared, face);
            if mesh.named[index].is_some() {
                continue;
            }
            let (name, material) = (&names[index], prepared.materials()[index]);
            let is_known = |known: &NamedMaterial| {
                known.material == material && (known.name == *name || name.is_empty())
            };
            let known = mesh.materials.iter().position(is_known);
            mesh.named[index] = Some(known.unwrap_or(mesh.materials.len()));
            if known.is_none() {
                let name = unused(name, &mesh.materials);
                mesh.materials.push(NamedMaterial { name, material });
            }
        }
        mesh
    }

    /// Returns the index of a face's material.
    pub fn material(&self, prepared: &PreparedScene, face: u32) -> usize {
        self.named[material_of(prepared, face)].unwrap_or_default()
    }

    /// Returns the text of the OBJ file.
    pub fn obj(&self, scene: &Scene, prepared: &PreparedScene, made: &str) -> Vec<u8> {
        let mut text = Obj::new(scene, prepared, self.is_coloured);
        let mut material = None;
        let mut object = None;
        for &face in &self.faces {
            let at = text.object_of(face);
            if object != Some(at) && scene.objects.len() > 1 {
                let name = token(&scene.objects[at].name, "object");
                text.line(format_args!("o {}_{name}", at + 1));
            }
            object = Some(at);
            let own = self.material(prepared, face);
            if material != Some(own) {
                text.line(format_args!("usemtl {}", self.materials[own].name));
                material = Some(own);
            }
            text.face(face);
        }
        let mut out = Vec::new();
        let colours = if self.is_coloured { " r g b" } else { "" };
        let head = format!(
            "# {made}\n# World space, y as in the scene; front faces are counter-clockwise.\n\
             # v x y z{colours}, vt without meaning, vn, f v/vt/vn\nmtllib mesh.mtl\n"
        );
        out.extend_from_slice(head.as_bytes());
        out.append(&mut text.positions);
        out.extend_from_slice(b"vt 0 0 0\n");
        out.append(&mut text.normals);
        out.append(&mut text.faces);
        out
    }

    /// Returns the text of the MTL file.
    pub fn mtl(&self, scene: &Scene, made: &str) -> String {
        let cosine = match scene.specular {
            SpecularModel::Phong => "R.V",
            SpecularModel::Blinn => "N.H",
        };
        let mut text = format!("# {made}\n# Ns is the exponent of {cosine}.\n");
        for NamedMaterial { name, material } in &self.materials {
            let three = |c: [f32; 3]| format!("{} {} {}", c[0], c[1], c[2]);
            text += &format!(
                "\nnewmtl {name}\nKa {}\nKd {}\nKs {}\nNs {}\nillum 2\n",
                three(material.ambient),
                three(material.diffuse),
                three(material.specular),
                exponent(scene, material)
            );
        }
        text
    }
}

/// Returns the name of each material of the prepared scene; empty if it has none.
fn names(scene: &Scene) -> Vec<String> {
    let of_object = |object: &fastphong::scene::Object| {
        let mesh = object.mesh.clone();
        let is_replaced = object.material.is_some();
        // Behind the last material of a mesh there is one for polygons without any.
        (0..=mesh.materials().len()).map(move |index| match mesh.material_name(index) {
            Some(name) if !is_replaced => token(name, ""),
            _ => String::new(),
        })
    };
    scene.objects.iter().flat_map(of_object).collect()
}

/// Returns `name`, with a number behind it if another material has it.
fn unused(name: &str, others: &[NamedMaterial]) -> String {
    let name = if name.is_empty() { "material" } else { name };
    let numbered = |n: usize| match n {
        1 => name.into(),
        n => format!("{name}_{n}"),
    };
    let is_free = |name: &String| others.iter().all(|other| other.name != *name);
    // One of these names is not among the others, because they are more.
    let mut all = (1..=others.len() + 1).map(numbered);
    all.find(is_free).unwrap_or_default()
}

/// Returns the index of a polygon's material in the prepared scene.
fn material_of(prepared: &PreparedScene, polygon: u32) -> usize {
    let corner = prepared.corners(polygon as usize)[0];
    prepared.geometry().materials[corner as usize] as usize
}

/// Returns the position of a vertex on the first side in the world.
pub fn position(geometry: &Geometry, vertex: usize) -> DVec3 {
    let models = &geometry.models;
    let transform = models.objects[models.object_of(vertex)].transform;
    transform.transform_point3(models.position(vertex))
}

/// The lines of an OBJ file.
struct Obj<'a> {
    scene: &'a Scene,
    prepared: &'a PreparedScene,
    is_coloured: bool,
    positions: Vec<u8>,
    normals: Vec<u8>,
    faces: Vec<u8>,
    /// The indices of positions with their colours, and of normals, by their bits.
    known_positions: HashMap<[u64; 6], usize>,
    known_normals: HashMap<[u32; 3], usize>,
    /// The indices in the file for each vertex of the geometry; 0 if it is not in it yet.
    vertices: Vec<[usize; 2]>,
}

impl<'a> Obj<'a> {
    fn new(scene: &'a Scene, prepared: &'a PreparedScene, is_coloured: bool) -> Obj<'a> {
        Obj {
            scene,
            prepared,
            is_coloured,
            positions: Vec::new(),
            normals: Vec::new(),
            faces: Vec::new(),
            known_positions: HashMap::new(),
            known_normals: HashMap::new(),
            vertices: vec![[0; 2]; prepared.geometry().normals.len()],
        }
    }

    /// Adds a line among the faces.
    fn line(&mut self, line: core::fmt::Arguments<'_>) {
        // Writing to memory cannot fail.
        let _ = writeln!(self.faces, "{line}");
    }

    /// Returns the index of a face's object.
    fn object_of(&self, face: u32) -> usize {
        let corner = self.prepared.corners(face as usize)[0] as usize;
        self.prepared.geometry().models.object_of(corner)
    }

    /// Adds a face. If normals at its corners say that its front is where the corners run
    /// clockwise, they are reversed.
    fn face(&mut self, face: u32) {
        let mut corners = self.prepared.corners(face as usize).to_vec();
        let is_turned = self.scene.two_sided && self.is_turned(face, &corners);
        // The order of corners decides which side is culled, and must stay if one is.
        let is_negated = is_turned && self.scene.culling != Culling::None;
        if is_turned && !is_negated {
            corners.reverse();
        }
        self.faces.push(b'f');
        for corner in corners {
            let [position, normal] = self.vertex(corner as usize, is_negated);
            let _ = write!(self.faces, " {position}/1/{normal}");
        }
        self.faces.push(b'\n');
    }

    /// True if the normal of a face, with which two-sided lighting works, points away from the side
    /// on which its corners run counter-clockwise.
    fn is_turned(&self, face: u32, corners: &[u32]) -> bool {
        let geometry = self.prepared.geometry();
        let at = |i: usize| position(geometry, corners[i % corners.len()] as usize);
        let first = at(0);
        let wound: DVec3 = (0..corners.len())
            .map(|i| (at(i) - first).cross(at(i + 1) - first))
            .sum();
        let normal = DVec3::from_array(geometry.faces[face as usize].map(f64::from));
        wound.dot(normal) < 0.0
    }

    /// Returns the indices of a vertex's position and normal in the file, and adds them if they are
    /// new.
    fn vertex(&mut self, vertex: usize, is_negated: bool) -> [usize; 2] {
        if self.vertices[vertex] != [0; 2] && !is_negated {
            return self.vertices[vertex];
        }
        let geometry = self.prepared.geometry();
        let p = position(geometry, vertex);
        let is_coloured = self.prepared.is_coloured(geometry.materials[vertex]);
        let [r, g, b, _] = if is_coloured {
            geometry.attributes(vertex as u32)
        } else {
            Geometry::NO_ATTRIBUTES
        };
        let [x, y, z] = p.to_array().map(|c| (c + 0.0).to_bits());
        let [red, green, blue] = [r, g, b].map(|c| u64::from(c.to_bits()));
        let next = self.known_positions.len() + 1;
        let key = [x, y, z, red, green, blue];
        let position = *self.known_positions.entry(key).or_insert_with(|| {
            let [x, y, z] = p.to_array().map(shortest);
            let _ = write!(self.positions, "v {x} {y} {z}");
            if self.is_coloured {
                let _ = write!(self.positions, " {r} {g} {b}");
            }
            self.positions.push(b'\n');
            next
        });
        let sign = if is_negated { -1.0 } else { 1.0 };
        let n = geometry.normals[vertex].map(|c| sign * c + 0.0);
        let next = self.known_normals.len() + 1;
        let normal = *self
            .known_normals
            .entry(n.map(f32::to_bits))
            .or_insert_with(|| {
                let _ = writeln!(self.normals, "vn {} {} {}", n[0], n[1], n[2]);
                next
            });
        if !is_negated {
            self.vertices[vertex] = [position, normal];
        }
        [position, normal]
    }
}

/// Writes a coordinate with as many digits as it takes to read the same `f32`, if it is one, and
/// else the same `f64`. Simple readers know no exponents, so there are none.
fn shortest(c: f64) -> String {
    let (c, single) = (c + 0.0, c as f32 + 0.0);
    if f64::from(single) == c {
        format!("{single}")
    } else {
        format!("{c}")
    }
}
