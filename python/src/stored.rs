//! A mesh with everything that was read about it, for pickle.

use crate::errors::value_error;
use crate::mesh::{Mesh, add_polygons, ends, integers, numbers, packed};
use crate::settings::texts;
use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::vertex_normals::{NormalRule, NormalSource, NormalWeight};
use fastphong::mesh::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use fastphong::note::{Level, Note};
use pyo3::prelude::*;
use std::sync::Arc;

/// The sources of normals without a parameter. A crease is stored as the index behind them.
const SOURCES: [NormalSource; 3] = [
    NormalSource::Averaged,
    NormalSource::Auto,
    NormalSource::Given,
];

const WEIGHTS: [NormalWeight; 4] = [
    NormalWeight::Uniform,
    NormalWeight::Area,
    NormalWeight::Angle,
    NormalWeight::Max,
];

/// What pickle stores of a mesh. Arrays are little-endian bytes.
#[derive(FromPyObject, IntoPyObject)]
#[pyo3(from_item_all)]
pub struct Stored {
    name: String,
    warnings: Vec<String>,
    remarks: Vec<String>,
    origin: [f64; 3],
    /// Three `f32` each.
    positions: Vec<u8>,
    corners: Vec<u8>,
    ends: Vec<u8>,
    parts: Vec<u8>,
    smoothing_groups: Vec<u8>,
    states_smoothing: bool,
    /// Three `f32` each.
    normals: Option<Vec<u8>>,
    normal_corners: Option<Vec<u8>>,
    /// Three `f32` each.
    colours: Vec<u8>,
    /// Ten `f32` each: ambient, diffuse, specular, shininess.
    materials: Vec<u8>,
    material_names: Vec<String>,
    polygon_materials: Vec<u8>,
    was_read: bool,
    is_flat_for_lack: bool,
    is_double_sided: bool,
    up_by_custom: Option<char>,
    /// The source of normals, the angle of a crease, the weight.
    normal_rule: (usize, f64, usize),
}

/// Returns `f32` values as bytes.
fn floats(values: impl IntoIterator<Item = f32>) -> Vec<u8> {
    values.into_iter().flat_map(f32::to_le_bytes).collect()
}

fn of_vectors(vectors: &[Vec3]) -> Vec<u8> {
    floats(vectors.iter().flat_map(|v| v.to_array()))
}

/// Returns groups of `N` `f32` values.
fn groups<const N: usize>(bytes: &[u8]) -> Vec<[f32; N]> {
    let values: Vec<f32> = numbers(bytes, f32::from_le_bytes).collect();
    values.as_chunks().0.to_vec()
}

fn to_vectors(bytes: &[u8]) -> Vec<Vec3> {
    groups(bytes).into_iter().map(Vec3::from_array).collect()
}

impl Stored {
    /// Stores a mesh.
    pub fn new(own: &Mesh) -> Stored {
        let mesh: &PolygonMesh = &own.mesh;
        let polygons = || 0..mesh.polygon_count();
        let of_polygons =
            |of: &dyn Fn(usize) -> u32| packed(&polygons().map(of).collect::<Vec<_>>());
        let rule = mesh.normal_rule();
        let (source, crease) = match rule.source {
            NormalSource::Crease(degrees) => (SOURCES.len(), degrees),
            source => {
                let index = SOURCES.iter().position(|known| *known == source);
                (index.unwrap_or_default(), 0.0)
            }
        };
        let weight = WEIGHTS.iter().position(|known| *known == rule.weight);
        let given = mesh.given_normals();
        let materials = mesh.materials().iter();
        let none = u32::MAX;
        Stored {
            name: own.name.clone(),
            warnings: texts(&own.notes, Level::Warning),
            remarks: texts(&own.notes, Level::Remark),
            origin: mesh.origin().to_array(),
            positions: of_vectors(mesh.positions()),
            corners: packed(mesh.corners()),
            ends: packed(&ends(mesh)),
            parts: if mesh.has_parts() {
                of_polygons(&|p| mesh.part(p))
            } else {
                Vec::new()
            },
            smoothing_groups: if mesh.has_smoothing_groups() {
                of_polygons(&|p| mesh.smoothing_group(p).unwrap_or_default())
            } else {
                Vec::new()
            },
            states_smoothing: mesh.states_smoothing(),
            normals: given.map(|given| of_vectors(&given.values)),
            normal_corners: given.and_then(|given| given.corners.as_deref().map(packed)),
            colours: of_vectors(mesh.colours()),
            materials: floats(materials.flat_map(|m| {
                let colours = [m.ambient, m.diffuse, m.specular];
                colours.into_iter().flatten().chain([m.shininess])
            })),
            material_names: (0..mesh.materials().len())
                .map_while(|m| mesh.material_name(m).map(str::to_owned))
                .collect(),
            polygon_materials: if mesh.materials().is_empty() {
                Vec::new()
            } else {
                of_polygons(&|p| mesh.polygon_material(p).map_or(none, |m| m as u32))
            },
            was_read: mesh.was_read(),
            is_flat_for_lack: mesh.is_flat_for_lack(),
            is_double_sided: mesh.is_double_sided(),
            up_by_custom: mesh.up_by_custom(),
            normal_rule: (source, crease, weight.unwrap_or_default()),
        }
    }

    /// Makes the mesh again.
    pub fn mesh(self) -> PyResult<Mesh> {
        let origin = DVec3::from_array(self.origin);
        let mut builder = MeshBuilder::around(origin, to_vectors(&self.positions));
        add_polygons(
            &mut builder,
            &integers(&self.corners),
            &integers(&self.ends),
        );
        if self.was_read {
            builder.read_from_file();
        }
        if self.is_flat_for_lack {
            builder.flat_without_normals();
        }
        if self.is_double_sided {
            builder.double_sided();
        }
        let (source, degrees, weight) = self.normal_rule;
        let source = SOURCES.get(source).copied();
        let materials = groups::<10>(&self.materials).into_iter();
        let materials = materials.map(|[a, b, c, d, e, f, g, h, i, shininess]| Material {
            ambient: [a, b, c],
            diffuse: [d, e, f],
            specular: [g, h, i],
            shininess,
        });
        builder
            .parts(integers(&self.parts))
            .smoothing_groups(integers(&self.smoothing_groups))
            .stating_smoothing(self.states_smoothing)
            .colours(to_vectors(&self.colours))
            .materials(materials.collect(), integers(&self.polygon_materials))
            .material_names(self.material_names)
            .normal_rule(NormalRule {
                source: source.unwrap_or(NormalSource::Crease(degrees)),
                weight: WEIGHTS.get(weight).copied().unwrap_or_default(),
            });
        if let Some(values) = self.normals {
            builder.normals(GivenNormals {
                values: to_vectors(&values),
                corners: self.normal_corners.map(|corners| integers(&corners)),
            });
        }
        if let Some(axis) = self.up_by_custom {
            builder.up_by_custom(axis);
        }
        let warnings = self.warnings.into_iter();
        let warnings = warnings.map(|text| Note::warning("stored", text));
        let remarks = self.remarks.into_iter();
        let remarks = remarks.map(|text| Note::remark("stored", text));
        Ok(Mesh {
            mesh: Arc::new(builder.finish().map_err(value_error)?),
            name: self.name,
            notes: warnings.chain(remarks).collect(),
        })
    }
}
