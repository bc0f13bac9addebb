//! The mesh of a surface over two parameters: a sheet, a ball with poles, or a closed tube.

use crate::mesh::{GivenNormals, MeshBuilder, MeshError, PolygonMesh};
use alloc::vec::Vec;
use glam::{DVec3, Vec3};

/// The way in which the edges of a parameter grid are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topology {
    /// Nothing is joined: the sheet has four open edges.
    Sheet,
    /// The last column joins the first. The first and the last row are one point each, and cells
    /// there are triangles.
    Ball,
    /// The last column joins the first, and the last row joins the first.
    Tube,
}

/// A grid of cells over a surface: quads, or two triangles each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParameterGrid {
    /// The way in which its edges are joined.
    pub topology: Topology,
    /// How many cells there are along the first parameter: at least 3 if columns are joined, else
    /// at least 1.
    pub columns: usize,
    /// How many cells there are along the second parameter: at least 2 on a ball, 3 on a tube, 1 on
    /// a sheet.
    pub rows: usize,
    /// True if quads are split into two triangles.
    pub triangles: bool,
}

impl ParameterGrid {
    /// Makes the grid. A resolution that is too low is raised to the lowest that the topology
    /// allows.
    pub fn new(topology: Topology, columns: usize, rows: usize, triangles: bool) -> Self {
        let (least_columns, least_rows) = match topology {
            Topology::Sheet => (1, 1),
            Topology::Ball => (3, 2),
            Topology::Tube => (3, 3),
        };
        ParameterGrid {
            topology,
            columns: columns.max(least_columns),
            rows: rows.max(least_rows),
            triangles,
        }
    }

    /// Returns how many polygons the mesh has; `u64::MAX` if that overflows.
    pub fn polygon_count(&self) -> u64 {
        let (columns, rows) = (self.columns as u64, self.rows as u64);
        if !self.triangles {
            columns.saturating_mul(rows)
        } else if self.topology == Topology::Ball {
            columns.saturating_mul(rows - 1).saturating_mul(2)
        } else {
            columns.saturating_mul(rows).saturating_mul(2)
        }
    }

    /// Makes the mesh of a surface. `surface(column, row)` returns the point and the unit normal
    /// there.
    ///
    /// Polygons are counter-clockwise seen from the side that ∂column × ∂row points to. `surface`
    /// is called once for each position, row after row; at a pole it is called only for column 0.
    ///
    /// # Errors
    /// [`MeshError::TooLarge`] before anything is allocated; [`MeshError::NotFinite`] if the
    /// surface is not finite.
    pub fn mesh(
        &self,
        mut surface: impl FnMut(usize, usize) -> (DVec3, DVec3),
    ) -> Result<PolygonMesh, MeshError> {
        if self.polygon_count() > PolygonMesh::MAX_POLYGONS as u64 {
            return Err(MeshError::TooLarge);
        }
        let (stored_columns, stored_rows) = match self.topology {
            Topology::Sheet => (self.columns + 1, self.rows + 1),
            Topology::Ball => (self.columns, self.rows + 1),
            Topology::Tube => (self.columns, self.rows),
        };
        let mut positions: Vec<Vec3> = Vec::with_capacity(stored_columns * stored_rows);
        let mut normals: Vec<Vec3> = Vec::with_capacity(stored_columns * stored_rows);
        for row in 0..stored_rows {
            let width = if self.is_pole(row) { 1 } else { stored_columns };
            for column in 0..width {
                let (position, normal) = surface(column, row);
                positions.push(position.as_vec3());
                normals.push(normal.as_vec3());
            }
        }
        self.joined(positions, normals)
    }

    /// Joins the points of a surface into polygons.
    fn joined(&self, positions: Vec<Vec3>, normals: Vec<Vec3>) -> Result<PolygonMesh, MeshError> {
        let polygons = self.polygon_count() as usize;
        let mut builder = MeshBuilder::new(positions);
        builder.reserve(polygons, polygons * if self.triangles { 3 } else { 4 });
        for row in 0..self.rows {
            for column in 0..self.columns {
                self.cell(&mut builder, column, row);
            }
        }
        builder.normals(GivenNormals {
            values: normals,
            corners: None,
        });
        builder.finish()
    }

    fn is_pole(&self, row: usize) -> bool {
        self.topology == Topology::Ball && (row == 0 || row == self.rows)
    }

    /// Returns the index of the position at `(column, row)`. Both wrap around where the grid is
    /// joined.
    fn index(&self, column: usize, row: usize) -> u32 {
        let wrapped = if column == self.columns { 0 } else { column };
        let index = match self.topology {
            Topology::Sheet => row * (self.columns + 1) + column,
            Topology::Tube => (if row == self.rows { 0 } else { row }) * self.columns + wrapped,
            Topology::Ball if row == 0 => 0,
            Topology::Ball if row == self.rows => (row - 1) * self.columns + 1,
            Topology::Ball => (row - 1) * self.columns + 1 + wrapped,
        };
        // At most 2^24 polygons have fewer than 2^26 positions.
        index as u32
    }

    /// Adds the polygons of one cell.
    fn cell(&self, builder: &mut MeshBuilder, column: usize, row: usize) {
        let [a, b, c, d] =
            [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| self.index(column + i, row + j));
        if self.is_pole(row) {
            builder.polygon(&[a, c, d]);
        } else if self.is_pole(row + 1) {
            builder.polygon(&[a, b, c]);
        } else if self.triangles {
            builder.polygon(&[a, b, c]).polygon(&[a, c, d]);
        } else {
            builder.polygon(&[a, b, c, d]);
        }
    }
}
