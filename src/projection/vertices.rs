//! All vertices through the camera: blocks of them at once where nothing stands in the way.

use super::view::{Codes, View, reach};
use crate::camera::Projection;
use crate::frame::{FrameError, Models, ScreenVertex, SubPixel};
use crate::parallel::for_each_chunk;
use crate::scene::Clipping;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use glam::{DMat4, DVec4};

/// Vertices that are placed together, in arrays of their coordinates, so that the compiler makes vectors of them.
const BLOCK: usize = 32;
/// Vertices that one thread takes at a time.
const CHUNK: usize = 64 * BLOCK;

/// Adding it to a number of magnitude below 2⁵¹ rounds that to an integer, halves to even as `rint` does, and leaves the
/// integer in the lowest bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// Places all vertices, says for each which planes it is beyond, and returns whether any is beyond one.
///
/// # Errors
/// [`FrameError::Vertex`] for the first vertex that is nowhere: a number of it is not finite, or its weight not positive.
pub(super) fn place(
    view: &View<'_>,
    models: &Models,
    vertices: &mut [ScreenVertex],
    codes: &mut [Codes],
) -> Result<bool, FrameError> {
    let (is_any_beyond, first_invalid) = (AtomicBool::new(false), AtomicUsize::new(usize::MAX));
    for_each_chunk((vertices, codes), CHUNK, &|first, (vertices, codes): (&mut [ScreenVertex], &mut [Codes])| {
        codes.fill(0);
        let end = first + vertices.len();
        let mut at = first;
        while at < end {
            let object = &models.objects[models.object_of(at)];
            let to = end.min(object.end);
            let range = at - first..to - first;
            let placing = Placing::new(view, view.clip_matrix * DMat4::from(object.transform));
            let found = placing.vertices(models, at, &mut vertices[range.clone()], &mut codes[range]);
            match found {
                Ok(false) => (),
                Ok(true) => is_any_beyond.store(true, Ordering::Relaxed),
                Err(vertex) => _ = first_invalid.fetch_min(vertex, Ordering::Relaxed),
            }
            at = to;
        }
    });
    match first_invalid.into_inner() {
        usize::MAX => Ok(is_any_beyond.into_inner()),
        index => Err(FrameError::Vertex { index }),
    }
}

/// Numbers of one coordinate of the vertices of a block.
type Lanes = [f64; BLOCK];

/// The way of one object's vertices onto the picture.
struct Placing<'a> {
    view: &'a View<'a>,
    matrix: DMat4,
    /// Samples a row, and rows.
    size: [f64; 2],
    is_perspective: bool,
    /// Whether polygons are cut by the guard band, and how far it reaches in x/w and y/w.
    clips: bool,
    guard: [f64; 2],
    /// The near distance.
    near: f64,
    /// Between them w is positive, and near/w far inside the range of an `f32`.
    least_w: f64,
    most_w: f64,
}

impl<'a> Placing<'a> {
    fn new(view: &'a View<'a>, matrix: DMat4) -> Self {
        let near = view.scene.camera.near;
        let (is_perspective, least_w, most_w) = match view.scene.camera.projection {
            Projection::Orthographic { .. } => (false, 1.0, 1.0),
            Projection::Perspective { .. } => {
                (true, (near * 1e-30).max(f64::MIN_POSITIVE), (near * 1e30).min(f64::MAX))
            }
        };
        let size = [view.width, view.height].map(f64::from);
        let clips = view.scene.clipping == Clipping::Planes;
        let guard = [view.width, view.height].map(reach);
        Placing { view, matrix, size, is_perspective, clips, guard, near, least_w, most_w }
    }

    /// Places vertices from `first` on; whether any is beyond a plane, or the number of one that is nowhere.
    fn vertices(
        &self,
        models: &Models,
        first: usize,
        vertices: &mut [ScreenVertex],
        codes: &mut [Codes],
    ) -> Result<bool, usize> {
        let mut is_any_beyond = false;
        for (block, (out, codes)) in vertices.chunks_mut(BLOCK).zip(codes.chunks_mut(BLOCK)).enumerate() {
            let from = first + block * BLOCK;
            let [x, y, z] = [&models.x, &models.y, &models.z].map(|all| lanes(&all[from..from + out.len()]));
            let [c_x, c_y, c_z, c_w] = core::array::from_fn(|row| self.row(row, &x, &y, &z));
            let is_inside = self.all_inside([1.0; 2], &c_x, &c_y, &c_z, &c_w);
            if is_inside || (self.clips && self.all_inside(self.guard, &c_x, &c_y, &c_z, &c_w)) {
                if self.is_perspective {
                    self.block::<true>(&c_x, &c_y, &c_z, &c_w, out);
                } else {
                    self.block::<false>(&c_x, &c_y, &c_z, &c_w, out);
                }
                if !is_inside {
                    is_any_beyond = true;
                    sides(&c_x, &c_y, &c_w, codes);
                }
                continue;
            }
            for (i, (vertex, codes)) in out.iter_mut().zip(codes).enumerate() {
                let clip = DVec4::new(c_x[i], c_y[i], c_z[i], c_w[i]);
                *codes = self.view.codes(clip);
                *vertex = self.view.vertex(clip);
                is_any_beyond |= *codes != 0;
                if !clip.is_finite() || !self.view.is_valid(vertex) {
                    return Err(from + i);
                }
            }
        }
        Ok(is_any_beyond)
    }

    /// One coordinate in clip space, in the order of additions of a product of matrix and vector.
    #[inline(always)]
    fn row(&self, row: usize, x: &Lanes, y: &Lanes, z: &Lanes) -> Lanes {
        let [a, b, c, d] = [0, 1, 2, 3].map(|column| self.matrix.col(column)[row]);
        let mut clip = [0.0; BLOCK];
        for i in 0..BLOCK {
            clip[i] = a * x[i] + b * y[i] + c * z[i] + d;
        }
        clip
    }

    /// Whether all are between the near and the far plane, and x and y within `reach` times w: finite then, and inside
    /// every plane that is as far out or farther.
    #[inline(always)]
    fn all_inside(&self, reach: [f64; 2], x: &Lanes, y: &Lanes, z: &Lanes, w: &Lanes) -> bool {
        let mut inside = true;
        for i in 0..BLOCK {
            // As the planes compute it: the sign of a difference is exact.
            let [right, bottom] = reach.map(|reach| reach * w[i]);
            inside &= (x[i].abs() <= right) & (y[i].abs() <= bottom) & (z[i] >= 0.0) & (z[i] <= w[i]);
            inside &= (w[i] >= self.least_w) & (w[i] <= self.most_w);
        }
        inside
    }

    /// What [`View::vertex`] gives for vertices inside all planes, to the bit. Orthographic ones have w = 1.
    #[inline(always)]
    fn block<const PERSPECTIVE: bool>(&self, x: &Lanes, y: &Lanes, z: &Lanes, w: &Lanes, out: &mut [ScreenVertex]) {
        let over_w = |c: f64, w: f64| if PERSPECTIVE { c / w } else { c };
        let nearest = |pixels: f64| (pixels * 256.0 + ROUNDING).to_bits() as i32;
        let (mut columns, mut rows) = ([0; BLOCK], [0; BLOCK]);
        let (mut depths, mut weights) = ([0.0; BLOCK], [1.0; BLOCK]);
        for i in 0..BLOCK {
            columns[i] = nearest((over_w(x[i], w[i]) * 0.5 + 0.5) * self.size[0]);
            rows[i] = nearest((0.5 - over_w(y[i], w[i]) * 0.5) * self.size[1]);
            depths[i] = over_w(z[i], w[i]) as f32;
        }
        if PERSPECTIVE && self.view.needs_inv_w {
            for i in 0..BLOCK {
                weights[i] = (self.near / w[i]) as f32;
            }
        }
        for (i, vertex) in out.iter_mut().enumerate() {
            let [x, y] = [columns[i], rows[i]].map(SubPixel::from_bits);
            *vertex = ScreenVertex { x, y, depth: depths[i], inv_w: weights[i] };
        }
    }
}

/// The sides of the view that vertices between near and far plane are beyond, as [`View::codes`] has them.
#[inline(always)]
fn sides(x: &Lanes, y: &Lanes, w: &Lanes, codes: &mut [Codes]) {
    let mut all = [0; BLOCK];
    for i in 0..BLOCK {
        let bit = |beyond: bool, bit: Codes| if beyond { 1 << bit } else { 0 };
        all[i] = bit(x[i] < -w[i], 0) | bit(x[i] > w[i], 1) | bit(y[i] < -w[i], 2) | bit(y[i] > w[i], 3);
    }
    codes.copy_from_slice(&all[..codes.len()]);
}

/// A block's numbers; where there are fewer, the last one fills it.
#[inline(always)]
fn lanes(from: &[f32]) -> Lanes {
    match <&[f32; BLOCK]>::try_from(from) {
        Ok(whole) => whole.map(f64::from),
        Err(_) => core::array::from_fn(|i| f64::from(from[i.min(from.len() - 1)])),
    }
}
