//! CS171's algorithms as they are printed, in `f64`: slow, and meant to be read beside the text.
//!
//! There is one function per algorithm, over triangles. They share no arithmetic with the engines
//! of [`crate::raster`] or with [`mod@crate::reference`], so that each can be checked against the
//! others.
//!
//! | algorithm | here |
//! |---|---|
//! | 1 Raster_Triangle | [`raster_triangle`] |
//! | 2 Raster_Colored_Triangle | [`raster_colored_triangle`] |
//! | 3 Lighting | [`lighting()`] |
//! | 4 Gouraud_Shading | [`gouraud_shading`] |
//! | 5 Raster_Colored_Triangle in NDC | [`raster_colored_ndc_triangle`] |
//! | 6 Flat_Shading | [`flat_shading`] |
//! | 7 Phong_Shading | [`phong_shading`] |
//! | 8 the full one: depth buffer, back faces culled | [`full_shading`] |

pub mod barycentric;
mod lighting;
mod rasterize;
mod shading;

pub use lighting::lighting;
pub use rasterize::{
    ndc_to_screen, raster_colored_ndc_triangle, raster_colored_triangle, raster_triangle,
    world_to_ndc,
};
pub use shading::{flat_shading, full_shading, gouraud_shading, phong_shading, render};

use crate::picture::{Alpha, Picture};
use glam::DVec3;

/// The rule for pixels whose centres lie on an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Inside {
    /// They belong to every triangle with the edge: α, β, γ ∈ [0, 1], as in the algorithms. Shared
    /// edges are drawn twice.
    #[default]
    Closed,
    /// They belong to no triangle: 0 < α, β, γ < 1, as in the text. Shared edges become holes.
    Open,
}

/// The rule for two points at equal depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ties {
    /// The later one is seen: `!(NDC.z > buffer(x, y))`, as in Algorithm 8.
    #[default]
    Later,
    /// The earlier one is seen: "less than the value stored", as in the text and in every other
    /// engine here.
    Earlier,
}

/// How the text is read where it allows two readings.
///
/// # Where the text is not followed
///
/// * γ is `f_ab(p) / f_ab(c)`. The text divides by `f_ac(p)` ([`barycentric::printed_gamma`]).
/// * "very shiny … p value close to 1" is the wrong way round. A large exponent makes the small
///   highlight of a shiny surface, as its own Figure 7 shows. The exponent is the material's.
/// * Algorithm 4 passes on the corners where it means their NDC and their colours.
/// * In the text a point is inside if 0 < α, β, γ < 1, in the algorithms if they are in [0, 1]:
///   [`Inside`].
/// * The text draws points that are *less* deep than the buffer, Algorithm 8 points that are *not
///   deeper*: [`Ties`].
/// * Algorithm 7 passes an interpolated normal to a lighting model that expects a unit normal.
///   [`Reading::normalise`] makes it one. Without it, highlights between the corners are lost.
/// * Colours, world coordinates and normals are interpolated linearly on the screen. That is right
///   only under an orthographic camera. NDC is right under both. A frame that asks for perspective
///   interpolation gets it (`src/frame/perspective.rs`).
/// * The test against the cube is not clipping: a corner behind the eye has no position on the
///   picture ([`world_to_ndc`]). The polygons of a frame are clipped, and then tested as well.
/// * `cross.z < 0` lets a triangle without area through, and f_ij then divides by zero. Such a
///   triangle is left out.
/// * Pixels are tested at their centres, and only those of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Pixels on edges.
    pub inside: Inside,
    /// Points at equal depth.
    pub ties: Ties,
    /// True if interpolated and averaged normals are normalised, which Algorithms 6 and 7 omit.
    pub normalise: bool,
    /// True if [`full_shading`] leaves out back faces, as Algorithm 8 does.
    pub cull: bool,
}

impl Default for Reading {
    /// Follows the algorithms, with unit normals.
    fn default() -> Self {
        Reading {
            inside: Inside::Closed,
            ties: Ties::Later,
            normalise: true,
            cull: true,
        }
    }
}

/// Which values are interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// None: one colour per triangle, of the average corner (Algorithm 6).
    Flat,
    /// The colours of the corners (Algorithms 4 and 5).
    Gouraud,
    /// World coordinates and normals (Algorithm 7).
    Phong,
}

/// The corners of a triangle.
pub type Corners = [TriangleCorner; 3];

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleCorner {
    /// v: the position, in the space of lights and eye.
    pub world: DVec3,
    /// n: the unit normal.
    pub normal: DVec3,
    /// The normalised device coordinates: x to the right, y upward, z from near to far. Visible
    /// ones are in −1..=1.
    pub ndc: DVec3,
    /// The reciprocal of the depth in any unit, above 0, for perspective interpolation. Equal at
    /// all corners for interpolation on the screen, as printed.
    pub inv_w: f64,
}

/// The raster grid, and the buffer grid of Algorithm 8.
#[derive(Clone, Debug)]
pub struct Raster {
    /// Red, green, blue in 0..=1. Alpha is 1 where a triangle was drawn.
    pub colours: Picture<[f64; 4]>,
    /// The NDC depth of the drawn points, and the largest double elsewhere.
    pub buffer: Picture<f64>,
}

impl Raster {
    /// Makes an empty grid of `width` × `height` pixels with this background.
    pub fn new(width: usize, height: usize, background: DVec3) -> Raster {
        let [r, g, b] = background.to_array();
        Raster {
            colours: Picture::new(width, height, [r, g, b, 0.0]),
            buffer: Picture::new(width, height, f64::MAX),
        }
    }

    /// Returns the counts of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.colours.width(), self.colours.height()]
    }

    /// Returns the mean of each `side` × `side` samples, including alpha. With straight alpha, the
    /// colour of a partly covered square is the mean of its covered samples. A `side` of 0 counts
    /// as 1, and samples beyond the last whole square are left out.
    pub fn filtered(&self, side: usize, alpha: Alpha) -> Picture<[f64; 4]> {
        let side = side.max(1);
        let [width, height] = self.size().map(|count| count / side);
        let mut picture = Picture::new(width, height, [0.0; 4]);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let positions = (0..side * side).map(|i| (x * side + i % side, y * side + i / side));
            let samples = positions.map(|(x, y)| self.colours.get(x, y));
            let covered = samples.clone().filter(|sample| sample[3] > 0.0).count();
            let all = (side * side) as f64;
            // How many samples the colour is the mean of, and the least alpha among them.
            let (count, least) = match alpha {
                Alpha::Straight if covered > 0 => (covered as f64, 1.0),
                _ => (all, 0.0),
            };
            let counted = samples.filter(|sample| sample[3] >= least);
            let [r, g, b] = counted.fold([0.0; 3], |sum: [f64; 3], sample| {
                core::array::from_fn(|c| sum[c] + sample[c] / count)
            });
            picture.row_mut(y)[x] = [r, g, b, covered as f64 / all];
        }
        picture
    }

    /// Fills a pixel: Fill(x, y, grid, color).
    fn fill(&mut self, x: usize, y: usize, colour: DVec3) {
        self.colours.row_mut(y)[x] = [colour.x, colour.y, colour.z, 1.0];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_that_is_covered_in_part_has_the_colour_of_its_covered_samples() {
        let mut raster = Raster::new(4, 2, DVec3::new(1.0, 0.5, 0.0));
        raster.fill(0, 0, DVec3::new(0.25, 0.25, 0.25));
        raster.fill(1, 1, DVec3::new(0.75, 0.25, 0.25));
        let straight = raster.filtered(2, Alpha::Straight);
        assert_eq!(
            straight.pixels(),
            [[0.5, 0.25, 0.25, 0.5], [1.0, 0.5, 0.0, 0.0]]
        );
        let flattened = raster.filtered(2, Alpha::Flattened);
        assert_eq!(
            flattened.pixels(),
            [[0.75, 0.375, 0.125, 0.5], [1.0, 0.5, 0.0, 0.0]]
        );
    }
}
