//! The barycentric renderer: CS171's bounding-box rasterizer, which the span shaders' speed is measured against.
//!
//! For each triangle every pixel of its bounding box is tested with three edge functions; where it is inside, they give
//! its barycentric coordinates, and attributes are interpolated and shaded there and then (CS171 1, Algorithms 1, 2).
//! Shading is the methods' own text, so that what differs in speed is rasterization and interpolation.

use super::depth::SampleDepth;
use super::setup::SetUp;
use super::target::Target;
use crate::frame::{Frame, ScreenVertex};
use crate::number::{Machine, each};
use crate::shader::{Shader, Span};
use crate::walk::{Attribute, Walk};
use alloc::vec;

/// To whom the pixels whose centres lie exactly on an edge belong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Edges {
    /// To the polygon right of or below the edge (the top-left rule): as in every other engine here.
    #[default]
    TopLeft,
    /// To every triangle that has the edge, as CS171 prints it: shared edges are drawn twice.
    Closed,
}

/// The edge function of the line through i and j, in exact integers (sub-pixels²).
///
/// ```text
/// f_ij(x, y) = (y_i − y_j) x + (x_j − x_i) y + x_i y_j − x_j y_i            (CS171 1)
/// ```
struct EdgeFunction {
    across: i64,
    down: i64,
    constant: i64,
}

impl EdgeFunction {
    fn new(i: &ScreenVertex, j: &ScreenVertex) -> Self {
        let bits = |v: &ScreenVertex| (i64::from(v.x.to_bits()), i64::from(v.y.to_bits()));
        let ((xi, yi), (xj, yj)) = (bits(i), bits(j));
        EdgeFunction {
            across: yi - yj,
            down: xj - xi,
            constant: xi * yj - xj * yi,
        }
    }

    #[inline(always)]
    fn at(&self, x: i64, y: i64) -> i64 {
        self.across * x + self.down * y + self.constant // f_ij
    }

    /// Whether pixels on the edge itself are inside a triangle whose inside is where f ≥ 0: left and top edges.
    fn owns_its_pixels(&self) -> bool {
        self.across > 0 || (self.across == 0 && self.down > 0)
    }
}

/// Draws the triangles of `frame` into `target`; polygons with more corners are passed over.
pub(crate) fn draw<S: Shader, M: Machine>(
    m: M,
    frame: &Frame,
    parameters: &[u32],
    edges: Edges,
    target: &mut dyn Target,
) {
    const { assert!(M::WIDTH == 1, "this renderer goes pixel by pixel") };
    let setup = SetUp::<S, M>::new(m, frame, parameters);
    let depth = SampleDepth::new(frame);
    let mut depth_buffer = vec![f32::INFINITY; frame.width() * frame.height()];
    for (number, polygon) in frame.polygons().iter().enumerate() {
        let &[a, mut b, mut c] = frame.corners(polygon) else {
            continue;
        };
        let vertex = |v: u32| &frame.vertices()[v as usize];
        let doubled_area = EdgeFunction::new(vertex(a), vertex(b)).at_vertex(vertex(c));
        if doubled_area == 0 {
            continue;
        }
        if doubled_area < 0 {
            core::mem::swap(&mut b, &mut c);
        }
        let corners = [vertex(a), vertex(b), vertex(c)];
        let functions = [
            EdgeFunction::new(corners[1], corners[2]),
            EdgeFunction::new(corners[2], corners[0]),
            EdgeFunction::new(corners[0], corners[1]),
        ];
        // f ≥ 1 is f > 0 in integers: the edges that do not own their pixels need that.
        let least: [i64; 3] =
            each(|i| i64::from(edges == Edges::TopLeft && !functions[i].owns_its_pixels()));
        let scale = 1.0 / doubled_area.abs() as f32;
        let attributes: [_; 3] = each(|i| setup.attributes[[a, b, c][i] as usize]);
        let depths = corners.map(|corner| depth.of_corner(frame, corner));
        let (x_range, y_range) = bounding_box(frame, &corners);
        let material = polygon.material as usize;
        for row in y_range {
            let y = 256 * row as i64 + 128;
            for column in x_range.clone() {
                let x = 256 * column as i64 + 128;
                let f: [i64; 3] = each(|i| functions[i].at(x, y));
                if (0..3).any(|i| f[i] < least[i]) {
                    continue;
                }
                // α = f_bc(p) / f_bc(a), and likewise β and γ: f_bc(a) is the doubled area for all three.
                let weights: [f32; 3] = each(|i| f[i] as f32 * scale);
                let q = weights[0] * depths[0] + weights[1] * depths[1] + weights[2] * depths[2];
                let nearest = &mut depth_buffer[row * frame.width() + column];
                let Some(kept) = depth.seen(q, *nearest) else {
                    continue;
                };
                *nearest = kept;
                let start = Span {
                    x: m.one(column as f32 + 0.5),
                    y: m.one(row as f32 + 0.5),
                    attribute: S::Attribute::barycentric(
                        m,
                        each(|i| m.one(weights[i])),
                        attributes,
                    ),
                };
                let mut walk = S::walk(m, &setup.consts[material], &setup.polygons[number], &start);
                let rgb = S::shade(&setup.pixel_consts[material], walk.next());
                target.store(column, row, &[each(|i| m.first(rgb[i]))]);
            }
        }
    }
}

impl EdgeFunction {
    fn at_vertex(&self, v: &ScreenVertex) -> i64 {
        self.at(i64::from(v.x.to_bits()), i64::from(v.y.to_bits()))
    }
}

/// The pixels whose centres may lie in a triangle: columns and rows.
fn bounding_box(
    frame: &Frame,
    corners: &[&ScreenVertex; 3],
) -> (core::ops::Range<usize>, core::ops::Range<usize>) {
    let range = |coordinates: [i32; 3], limit: usize| {
        let (mut low, mut high) = (coordinates[0], coordinates[0]);
        for c in coordinates {
            (low, high) = (low.min(c), high.max(c));
        }
        // Centres at 256 p + 128, both ends included for closed edges.
        let first = (low - 128 + 255).div_euclid(256).max(0) as usize;
        let last = (high - 128).div_euclid(256) + 1;
        first.min(limit)..(last.max(0) as usize).min(limit)
    };
    (
        range(corners.map(|v| v.x.to_bits()), frame.width()),
        range(corners.map(|v| v.y.to_bits()), frame.height()),
    )
}
