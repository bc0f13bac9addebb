//! Open surfaces over a square: corrugated sheet and terrain.

use super::grid::{ParameterGrid, Topology};
use super::noise::fractal_noise;
use crate::mesh::{MeshError, PolygonMesh};
use core::f64::consts::PI;
use glam::{DVec2, DVec3, Vec3};

/// Returns the coordinate of grid line `k` of `n` over −1..=1.
fn across(k: usize, n: usize) -> f64 {
    (2.0 * k as f64 - n as f64) / n as f64
}

/// Makes a wavy sheet over the square −1..=1, facing +z, with `z = amplitude · sin(π waves x)`.
/// `waves` whole waves run across it.
///
/// Linear interpolation of normals hides its inflections: between equal normals it shades flat.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if a parameter is not finite.
pub fn corrugated(
    waves: f64,
    amplitude: f64,
    segments: usize,
    rows: usize,
    triangles: bool,
) -> Result<PolygonMesh, MeshError> {
    let grid = ParameterGrid::new(Topology::Sheet, segments, rows, triangles);
    grid.mesh(|column, row| {
        let (x, y) = (across(column, grid.columns), across(row, grid.rows));
        let phase = PI * waves * x;
        let slope = amplitude * PI * waves * libm::cos(phase);
        (
            DVec3::new(x, y, amplitude * libm::sin(phase)),
            DVec3::new(-slope, 0.0, 1.0).normalize(),
        )
    })
}

/// The parameters of a terrain of noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terrain {
    /// The height of the largest hills.
    pub amplitude: f64,
    /// How many of the largest hills stand along a side.
    pub frequency: f64,
    /// How many sizes of hills there are. Each is half as wide and half as high as the previous
    /// one.
    pub octaves: usize,
    /// The seed of the noise. Each seed makes another terrain.
    pub seed: u64,
}

/// Makes hills over the square −1..=1 of x and z, with y upward. Equal parameters make equal hills
/// on every platform.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if a parameter is not finite.
pub fn terrain(
    terrain: Terrain,
    columns: usize,
    rows: usize,
    triangles: bool,
) -> Result<PolygonMesh, MeshError> {
    let grid = ParameterGrid::new(Topology::Sheet, columns, rows, triangles);
    grid.mesh(|column, row| {
        // z decreases from row to row, away from the viewer, so that column direction × row
        // direction points up.
        let (x, z) = (across(column, grid.columns), -across(row, grid.rows));
        let scale = terrain.frequency / 2.0;
        let (height, gradient) =
            fractal_noise(DVec2::new(x, z) * scale, terrain.octaves, terrain.seed);
        let slope = terrain.amplitude * scale * gradient;
        (
            DVec3::new(x, terrain.amplitude * height, z),
            DVec3::new(-slope.x, 1.0, -slope.y).normalize(),
        )
    })
}

impl PolygonMesh {
    /// Colours each position by its height: from grass at the bottom over rock to snow at the top.
    pub(in crate::mesh) fn colour_by_height(&mut self) {
        const GRASS: Vec3 = Vec3::new(0.2, 0.5, 0.1);
        const ROCK: Vec3 = Vec3::new(0.5, 0.4, 0.3);
        const SNOW: Vec3 = Vec3::ONE;
        let heights = self.positions.iter().map(|p| p.y);
        let low = heights.clone().fold(f32::INFINITY, f32::min);
        let high = heights.clone().fold(f32::NEG_INFINITY, f32::max);
        // Scales heights to 0..=2: grass to rock below 1, rock to snow above.
        let over = if high > low { 2.0 / (high - low) } else { 0.0 };
        let colour = |y: f32| match (y - low) * over {
            t if t < 1.0 => GRASS.lerp(ROCK, t),
            t => ROCK.lerp(SNOW, t - 1.0),
        };
        self.colours = heights.map(colour).collect();
    }
}
