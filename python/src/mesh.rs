//! Meshes from arrays, which arrive as bytes, or from files.

use crate::errors::{input_error, memory_error, value_error};
use crate::inputs::Input;
use crate::pool::run;
use crate::settings::{overlay, texts};
use crate::stored::Stored;
use fastphong::glam::{DVec3, Vec3};
use fastphong::memory::{bytes as shown, check_free};
use fastphong::mesh::read::coloured;
use fastphong::mesh::vertex_normals::vertex_normals as normals;
use fastphong::mesh::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use fastphong::note::{Level, Note, Notes};
use fastphong::scene::input;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Bytes of memory per byte of an array while a mesh is made of it: for a copy, the values, and the
/// mesh.
const ARRAY_BYTE: u64 = 4;

/// A mesh whose arrays are checked.
#[pyclass(frozen, module = "fastphong._fastphong")]
pub struct Mesh {
    pub mesh: Arc<PolygonMesh>,
    /// The name of the mesh in messages.
    pub name: String,
    /// Notes about the mesh's file or arrays.
    pub notes: Notes,
}

/// Returns the values that `bytes` hold, of `N` bytes each.
pub fn numbers<const N: usize, T>(
    bytes: &[u8],
    of: fn([u8; N]) -> T,
) -> impl ExactSizeIterator<Item = T> {
    bytes.as_chunks::<N>().0.iter().map(move |&bytes| of(bytes))
}

/// Returns the integers that `bytes` hold.
pub fn integers(bytes: &[u8]) -> Vec<u32> {
    numbers(bytes, u32::from_le_bytes).collect()
}

/// Returns the vectors that `bytes` hold, three `f64` each.
fn vectors(bytes: &[u8]) -> impl Iterator<Item = DVec3> {
    let vectors = bytes.as_chunks::<24>().0.iter();
    vectors.map(|bytes| {
        let mut numbers = numbers(bytes, f64::from_le_bytes);
        DVec3::from_array([(); 3].map(|()| numbers.next().unwrap_or_default()))
    })
}

/// Returns the vectors that `bytes` hold, three `f64` each, rounded to `f32`.
fn singles(bytes: &[u8]) -> Vec<Vec3> {
    vectors(bytes).map(|v| v.as_vec3()).collect()
}

/// A material of another library: if it is only a base colour, and then ambient, diffuse and
/// specular colour and the shininess, each of which may be missing.
type GivenMaterial = (
    bool,
    Option<[f32; 3]>,
    Option<[f32; 3]>,
    Option<[f32; 3]>,
    Option<f32>,
);

/// Returns a material as the readers of mesh files make it: glTF's from a base colour, MTL's from
/// the rest.
fn material((is_base, ambient, diffuse, specular, shininess): GivenMaterial) -> Material {
    let usual = Material::MTL;
    let diffuse = diffuse.unwrap_or(usual.diffuse);
    if is_base {
        coloured(diffuse)
    } else {
        Material {
            ambient: ambient.unwrap_or(usual.ambient),
            diffuse,
            specular: specular.unwrap_or(usual.specular),
            shininess: shininess.unwrap_or(usual.shininess),
        }
    }
}

#[pymethods]
impl Mesh {
    /// Makes a mesh from arrays of little-endian numbers: three `f64` per vertex, a `u32` per
    /// corner, for each polygon the index behind its last corner, three `f64` per normal of a
    /// vertex or a corner, three `f64` per vertex as its colour, and for each polygon the index of
    /// its material. `warnings` are sentences about what the arrays leave out.
    #[new]
    #[pyo3(signature = (name, vertices, corners, ends, normals, colours, materials, warnings))]
    #[allow(clippy::too_many_arguments)] // the boundary passes arrays one by one
    fn new(
        py: Python<'_>,
        name: String,
        vertices: &[u8],
        corners: &[u8],
        ends: &[u8],
        normals: Option<&[u8]>,
        colours: Option<&[u8]>,
        materials: Option<(Vec<GivenMaterial>, Vec<u8>)>,
        warnings: Vec<String>,
    ) -> PyResult<Mesh> {
        let arrays = [Some(vertices), Some(corners), Some(ends), normals, colours];
        let size: u64 = arrays
            .iter()
            .flatten()
            .map(|bytes| bytes.len() as u64)
            .sum();
        let needed = ARRAY_BYTE * size;
        let needs = format!("a mesh of these arrays needs about {}", shown(needed));
        check_free(needed, &needs, "a smaller mesh").map_err(memory_error)?;
        let [vertices, corners, ends] = [vertices, corners, ends].map(<[u8]>::to_vec);
        let [normals, colours] = [normals, colours].map(|bytes| bytes.map(<[u8]>::to_vec));
        let made = run(py, move || {
            let vertices: Vec<DVec3> = vectors(&vertices).collect();
            let (corners, ends) = (integers(&corners), integers(&ends));
            let [normals, colours] = [normals, colours].map(|bytes| bytes.as_deref().map(singles));
            let mut builder = MeshBuilder::from_f64(&vertices);
            // Arrays are no more reliable than a file, so sides and normals are chosen as for a
            // file.
            builder.read_from_file();
            add_polygons(&mut builder, &corners, &ends);
            if let Some(values) = normals {
                let is_by_vertex = values.len() == vertices.len();
                let corners = (!is_by_vertex).then(|| (0..corners.len() as u32).collect());
                builder.normals(GivenNormals { values, corners });
            }
            if let Some(colours) = colours {
                builder.colours(colours);
            }
            if let Some((materials, of_polygons)) = materials {
                let materials = materials.into_iter().map(material).collect();
                builder.materials(materials, integers(&of_polygons));
            }
            builder.finish()
        });
        let notes = warnings.into_iter();
        Ok(Mesh {
            mesh: Arc::new(made?.map_err(value_error)?),
            name,
            notes: notes.map(|text| Note::warning("arrays", text)).collect(),
        })
    }

    /// Reads a mesh file, or makes a built-in mesh.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Mesh> {
        let input = Input::new(path);
        run(py, move || {
            input.check_meshes([input.name.as_str()].into_iter(), Path::new(""))?;
            let loaded =
                input::load_mesh_by(&input.name, Path::new(""), &mut |path| input.read(path));
            let (mesh, notes) = loaded.map_err(|error| input_error(error, &input.path))?;
            Ok(Mesh {
                mesh,
                name: input.name,
                notes,
            })
        })?
    }

    /// Returns everything about the mesh, for pickle.
    #[getter]
    fn stored(&self) -> Stored {
        Stored::new(self)
    }

    /// Makes the mesh that was stored.
    #[staticmethod]
    fn restored(py: Python<'_>, stored: Stored) -> PyResult<Mesh> {
        run(py, move || stored.mesh())?
    }

    /// Returns the warnings about the mesh's file or arrays.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        texts(&self.notes, Level::Warning)
    }

    /// Returns the vertices, three `f64` each.
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let positions = self.mesh.positions().iter();
        let positions = positions.map(|p| (self.mesh.origin() + p.as_dvec3()).to_array());
        let bytes: Vec<u8> = positions.flatten().flat_map(f64::to_le_bytes).collect();
        PyBytes::new(py, &bytes)
    }

    /// Returns the vertex index of each corner, `u32`.
    #[getter]
    fn corners<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &packed(self.mesh.corners()))
    }

    /// Returns for each polygon the index behind its last corner, `u32`.
    #[getter]
    fn ends<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &packed(&ends(&self.mesh)))
    }

    /// True if the mesh has vertex colours.
    #[getter]
    fn has_colours(&self) -> bool {
        !self.mesh.colours().is_empty()
    }

    /// True if the mesh has its own normals.
    #[getter]
    fn has_normals(&self) -> bool {
        self.mesh.given_normals().is_some()
    }
}

/// Adds polygons to a mesh. `ends` are the indices behind their last corners.
pub fn add_polygons(builder: &mut MeshBuilder, corners: &[u32], ends: &[u32]) {
    builder.reserve(ends.len(), corners.len());
    let mut start = 0;
    for &end in ends {
        let end = end as usize;
        builder.polygon(corners.get(start..end).unwrap_or_default());
        start = end;
    }
}

/// Returns for each polygon the index behind its last corner.
pub fn ends(mesh: &PolygonMesh) -> Vec<u32> {
    let polygons = 0..mesh.polygon_count();
    polygons.map(|p| mesh.corner_range(p).end as u32).collect()
}

/// Returns integers as little-endian bytes.
pub fn packed(values: &[u32]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

/// Returns the unit normals, three `f32` each, and for each corner the index of its normal, `u32`.
#[pyfunction]
pub fn vertex_normals<'py>(
    py: Python<'py>,
    mesh: &Mesh,
    settings: &str,
) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>)> {
    let over = overlay(settings)?;
    let mut own = mesh.mesh.clone();
    let found = run(py, move || {
        let rule = over.normal_rule(own.normal_rule()).map_err(value_error)?;
        if let Some(part) = over.weld().map_err(value_error)? {
            Arc::make_mut(&mut own).weld(part);
        }
        let found = normals(&own, rule);
        let values = found.values.iter().flat_map(|v| v.to_array());
        let values: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
        Ok::<_, PyErr>((values, packed(&found.corners)))
    });
    let (values, corners) = found??;
    Ok((PyBytes::new(py, &values), PyBytes::new(py, &corners)))
}
