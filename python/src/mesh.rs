//! Meshes from arrays, which arrive as bytes, or from files.

use crate::errors::{input_error, value_error};
use crate::pool::install;
use crate::settings::{overlay, texts};
use fastphong::glam::{DVec3, Vec3};
use fastphong::mesh::vertex_normals as normals;
use fastphong::mesh::{GivenNormals, MeshBuilder, MeshError, PolygonMesh};
use fastphong::note::{Level, Notes};
use fastphong::scene::input;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::Path;
use std::sync::Arc;

/// A mesh whose arrays are checked.
#[pyclass(frozen, module = "fastphong._fastphong")]
pub struct Mesh {
    pub mesh: Arc<PolygonMesh>,
    /// The name of the mesh in messages.
    pub name: String,
    /// Notes about the mesh's file.
    pub notes: Notes,
}

/// Returns the values that `bytes` hold, of `N` bytes each.
fn numbers<const N: usize, T>(
    bytes: &[u8],
    of: fn([u8; N]) -> T,
) -> impl ExactSizeIterator<Item = T> {
    bytes.as_chunks::<N>().0.iter().map(move |&bytes| of(bytes))
}

/// Returns the vectors that `bytes` hold, three `f64` each.
fn vectors(bytes: &[u8]) -> Vec<DVec3> {
    let numbers: Vec<f64> = numbers(bytes, f64::from_le_bytes).collect();
    numbers
        .as_chunks()
        .0
        .iter()
        .map(|&v| DVec3::from_array(v))
        .collect()
}

/// Returns the vectors that `bytes` hold, three `f64` each, rounded to `f32`.
fn singles(bytes: &[u8]) -> Vec<Vec3> {
    vectors(bytes).iter().map(|v| v.as_vec3()).collect()
}

/// The arrays of a mesh, as little-endian bytes.
struct Arrays<'a> {
    /// Three `f64` per vertex.
    vertices: &'a [u8],
    /// A `u32` per corner.
    corners: &'a [u8],
    /// For each polygon the index behind its last corner, `u32`.
    ends: &'a [u8],
    /// Three `f64` per vertex, or per corner.
    normals: Option<&'a [u8]>,
    /// Three `f64` per vertex.
    colours: Option<&'a [u8]>,
}

impl Arrays<'_> {
    fn mesh(&self) -> Result<PolygonMesh, MeshError> {
        let vertices = vectors(self.vertices);
        let mut builder = MeshBuilder::from_f64(&vertices);
        // Arrays are no more reliable than a file, so sides and normals are chosen as for a file.
        builder.read_from_file();
        let corners: Vec<u32> = numbers(self.corners, u32::from_le_bytes).collect();
        let ends = numbers(self.ends, u32::from_le_bytes);
        builder.reserve(ends.len(), corners.len());
        let mut start = 0;
        for end in ends {
            let end = end as usize;
            builder.polygon(corners.get(start..end).unwrap_or_default());
            start = end;
        }
        if let Some(values) = self.normals.map(singles) {
            let is_by_vertex = values.len() == vertices.len();
            let corners = (!is_by_vertex).then(|| (0..corners.len() as u32).collect());
            builder.normals(GivenNormals { values, corners });
        }
        if let Some(colours) = self.colours {
            builder.colours(singles(colours));
        }
        builder.finish()
    }
}

#[pymethods]
impl Mesh {
    /// Makes a mesh from arrays.
    #[new]
    #[pyo3(signature = (name, vertices, corners, ends, normals, colours))]
    fn new(
        py: Python<'_>,
        name: String,
        vertices: &[u8],
        corners: &[u8],
        ends: &[u8],
        normals: Option<&[u8]>,
        colours: Option<&[u8]>,
    ) -> PyResult<Mesh> {
        let arrays = Arrays {
            vertices,
            corners,
            ends,
            normals,
            colours,
        };
        let mesh = py.detach(|| arrays.mesh()).map_err(value_error)?;
        Ok(Mesh {
            mesh: Arc::new(mesh),
            name,
            notes: Notes::default(),
        })
    }

    /// Reads a mesh file, or makes a built-in mesh.
    #[staticmethod]
    fn load(py: Python<'_>, name: String) -> PyResult<Mesh> {
        let loaded = py.detach(|| input::load_mesh(&name, Path::new("")));
        let (mesh, notes) = loaded.map_err(|error| input_error(error, Path::new(&name)))?;
        Ok(Mesh { mesh, name, notes })
    }

    /// Returns the warnings about the mesh's file.
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
        let corners = self.mesh.corners().iter();
        let bytes: Vec<u8> = corners.flat_map(|c| c.to_le_bytes()).collect();
        PyBytes::new(py, &bytes)
    }

    /// Returns for each polygon the index behind its last corner, `u32`.
    #[getter]
    fn ends<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let ends = (0..self.mesh.polygon_count()).map(|p| self.mesh.corner_range(p).end as u32);
        let bytes: Vec<u8> = ends.flat_map(u32::to_le_bytes).collect();
        PyBytes::new(py, &bytes)
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

/// Returns the unit normals, three `f32` each, and for each corner the index of its normal, `u32`.
#[pyfunction]
pub fn vertex_normals<'py>(
    py: Python<'py>,
    mesh: &Mesh,
    settings: &str,
) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>)> {
    let rule = overlay(settings)?.normal_rule(mesh.mesh.normal_rule());
    let rule = rule.map_err(value_error)?;
    let (values, corners) = py.detach(|| {
        let found = install(|| normals::vertex_normals(&mesh.mesh, rule))?;
        let values = found.values.iter().flat_map(|v| v.to_array());
        let values: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
        let corners: Vec<u8> = found.corners.iter().flat_map(|c| c.to_le_bytes()).collect();
        Ok::<_, PyErr>((values, corners))
    })?;
    Ok((PyBytes::new(py, &values), PyBytes::new(py, &corners)))
}
