//! All vertices through the camera, in whole blocks wherever a block is inside all planes.

use super::view::{BEYOND_PLANES, Codes, View, reach};
use crate::frame::{FrameError, Models, ScreenVertex, SubPixel};
use crate::number::parallel::for_each_chunk;
use crate::number::vectorized;
use crate::scene::{Clipping, Projection};
use crate::sync::{AtomicBool, AtomicUsize, Ordering};
use glam::{DMat4, DVec4};

/// How many vertices are placed together, in arrays of their coordinates, so that the compiler uses
/// vector instructions.
const BLOCK: usize = 32;
/// How many vertices one thread takes at a time.
const CHUNK: usize = 64 * BLOCK;

/// A constant that rounds by addition: 1.5 · 2⁵². Adding a float below 2⁵¹ in magnitude rounds it
/// to an integer, halves to even as `rint` does, and leaves the integer in the lowest bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// What is known about vertices once they are placed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    /// True if any vertex is beyond a plane.
    pub is_any_beyond: bool,
    /// The least and the largest near/w of the vertices on the picture, rounded down to powers of
    /// two. They are +∞ and 0 if no vertex is on the picture, or nothing is weighted.
    pub weights: [f64; 2],
}

impl Placed {
    const NONE: Placed = Placed {
        is_any_beyond: false,
        weights: [f64::INFINITY, 0.0],
    };

    fn add(&mut self, other: Placed) {
        self.is_any_beyond |= other.is_any_beyond;
        let [least, largest] = &mut self.weights;
        *least = least.min(other.weights[0]);
        *largest = largest.max(other.weights[1]);
    }
}

/// How many bits of an `f64` are below its exponent.
const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;

/// Places all vertices, and finds for each the planes that it is beyond.
///
/// # Errors
/// [`FrameError::Vertex`] for the first vertex without a valid place: a value of it is not finite,
/// or its weight is not positive.
pub(super) fn place(
    view: &View<'_>,
    models: &Models,
    vertices: &mut [ScreenVertex],
    codes: &mut [Codes],
) -> Result<Placed, FrameError> {
    let (is_any_beyond, first_invalid) = (AtomicBool::new(false), AtomicUsize::new(usize::MAX));
    // Weights are compared by their exponents, which are in the order of the weights and fit in an
    // atomic integer. A weight is positive, so its sign bit is 0.
    let exponent = |weight: f64| (weight.to_bits() >> MANTISSA) as usize;
    let exponents = Placed::NONE.weights.map(|w| AtomicUsize::new(exponent(w)));
    for_each_chunk((vertices, codes), CHUNK, &|first,
                                               (vertices, codes): (
        &mut [ScreenVertex],
        &mut [Codes],
    )| {
        codes.fill(0);
        let end = first + vertices.len();
        let mut at = first;
        while at < end {
            let object = &models.objects[models.object_of(at)];
            let to = end.min(object.end);
            let range = at - first..to - first;
            let placing = Placing::new(view, view.clip_matrix * DMat4::from(object.transform));
            let found = vectorized(
                #[inline(always)]
                || placing.vertices(models, at, &mut vertices[range.clone()], &mut codes[range]),
            );
            match found {
                Ok(placed) => {
                    if placed.is_any_beyond {
                        is_any_beyond.store(true, Ordering::Relaxed);
                    }
                    let [least, largest] = placed.weights.map(exponent);
                    exponents[0].fetch_min(least, Ordering::Relaxed);
                    exponents[1].fetch_max(largest, Ordering::Relaxed);
                }
                Err(vertex) => _ = first_invalid.fetch_min(vertex, Ordering::Relaxed),
            }
            at = to;
        }
    });
    match first_invalid.into_inner() {
        usize::MAX => Ok(Placed {
            is_any_beyond: is_any_beyond.into_inner(),
            weights: exponents.map(|e| f64::from_bits((e.into_inner() as u64) << MANTISSA)),
        }),
        index => Err(FrameError::Vertex { index }),
    }
}

/// A coordinate of each vertex of a block.
type Coord = [f64; BLOCK];

/// The projection of one object's vertices onto the picture.
struct Placing<'a> {
    view: &'a View<'a>,
    matrix: DMat4,
    /// How many samples a row has, and how many rows there are.
    size: [f64; 2],
    is_perspective: bool,
    /// True if polygons are cut at the guard band.
    clips: bool,
    /// How far the guard band reaches in x/w and y/w.
    guard: [f64; 2],
    /// The near distance.
    near: f64,
    /// The factor of z in the condition that [`View::z_scale`] describes.
    z_scale: f64,
    /// Between these limits w is positive, and 1/w is far inside the range of an `f32`.
    least_w: f64,
    most_w: f64,
}

impl<'a> Placing<'a> {
    fn new(view: &'a View<'a>, matrix: DMat4) -> Self {
        let near = view.scene.camera.near;
        let (is_perspective, least_w, most_w) = match view.scene.camera.projection {
            Projection::Orthographic { .. } => (false, 1.0, 1.0),
            Projection::Perspective { .. } => (true, 1e-30, 1e30),
        };
        let size = [view.width, view.height].map(f64::from);
        let clips = view.scene.clipping == Clipping::Planes;
        let guard = [view.width, view.height].map(reach);
        Placing {
            view,
            matrix,
            size,
            is_perspective,
            clips,
            guard,
            near,
            z_scale: view.z_scale,
            least_w,
            most_w,
        }
    }

    /// Places vertices from index `first` on. Returns what is known about them, or the index of a
    /// vertex without a valid place.
    #[inline(always)]
    fn vertices(
        &self,
        models: &Models,
        first: usize,
        vertices: &mut [ScreenVertex],
        codes: &mut [Codes],
    ) -> Result<Placed, usize> {
        let mut placed = Placed::NONE;
        // The last block may have fewer vertices. It is placed in a whole block and then copied.
        let (mut last, mut last_codes) = ([ScreenVertex::default(); BLOCK], [0; BLOCK]);
        let mut at = 0;
        while at < vertices.len() {
            let (out, codes) = (&mut vertices[at..], &mut codes[at..]);
            let count = out.len().min(BLOCK);
            match (out.first_chunk_mut(), codes.first_chunk_mut()) {
                (Some(out), Some(codes)) => {
                    placed.add(self.block(models, first + at, BLOCK, out, codes)?);
                }
                _ => {
                    placed.add(self.block(
                        models,
                        first + at,
                        count,
                        &mut last,
                        &mut last_codes,
                    )?);
                    out.copy_from_slice(&last[..count]);
                    codes.copy_from_slice(&last_codes[..count]);
                }
            }
            at += count;
        }
        Ok(placed)
    }

    /// Places the `count` vertices of a block.
    #[inline(always)]
    fn block(
        &self,
        models: &Models,
        from: usize,
        count: usize,
        out: &mut [ScreenVertex; BLOCK],
        codes: &mut [Codes; BLOCK],
    ) -> Result<Placed, usize> {
        let (x, y, z) = (
            lanes(&models.x, from, count),
            lanes(&models.y, from, count),
            lanes(&models.z, from, count),
        );
        let (c_x, c_y) = (self.row(0, &x, &y, &z), self.row(1, &x, &y, &z));
        let (c_z, c_w) = (self.row(2, &x, &y, &z), self.row(3, &x, &y, &z));
        let is_inside = self.all_inside([1.0; 2], &c_x, &c_y, &c_z, &c_w);
        // The fast paths: the whole block is inside the view, or at least inside the guard band,
        // where every vertex has its place but may be beyond a side of the view.
        if is_inside || (self.clips && self.all_inside(self.guard, &c_x, &c_y, &c_z, &c_w)) {
            let weights = if self.is_perspective {
                self.on_picture::<true>(&c_x, &c_y, &c_z, &c_w, out)
            } else {
                self.on_picture::<false>(&c_x, &c_y, &c_z, &c_w, out)
            };
            if !is_inside {
                sides(&c_x, &c_y, &c_w, codes);
            }
            return Ok(Placed {
                is_any_beyond: !is_inside,
                weights,
            });
        }
        let mut placed = Placed::NONE;
        for i in 0..count {
            let clip = DVec4::new(c_x[i], c_y[i], c_z[i], c_w[i]);
            codes[i] = self.view.codes(clip);
            // Cuts are tolerated a little beyond a plane, but a mesh's own vertices are not.
            out[i] = match codes[i] & BEYOND_PLANES {
                0 => self.view.vertex(clip),
                _ => self.view.nowhere(),
            };
            placed.is_any_beyond |= codes[i] != 0;
            if self.view.needs_inv_w && codes[i] & BEYOND_PLANES == 0 {
                placed.add(Placed {
                    is_any_beyond: false,
                    weights: [out[i].inv_w; 2],
                });
            }
            if !View::is_in_range(clip) || !self.view.is_valid(&out[i]) {
                return Err(from + i);
            }
        }
        Ok(placed)
    }

    /// Returns one coordinate in clip space. Products are added in the order of a product of matrix
    /// and vector.
    #[inline(always)]
    fn row(&self, row: usize, x: &Coord, y: &Coord, z: &Coord) -> Coord {
        let matrix = self.matrix.row(row);
        let mut clip = [0.0; BLOCK];
        for i in 0..BLOCK {
            clip[i] = matrix.x * x[i] + matrix.y * y[i] + matrix.z * z[i] + matrix.w;
        }
        clip
    }

    /// True if all vertices lie between the near and the far plane, and x and y are within `reach`
    /// times w. They are then finite, and inside every plane that is as far out or farther.
    #[inline(always)]
    fn all_inside(&self, reach: [f64; 2], x: &Coord, y: &Coord, z: &Coord, w: &Coord) -> bool {
        let mut inside = true;
        // `&` in place of `&&` keeps the loop without branches, so that it runs on vectors.
        for i in 0..BLOCK {
            // As the planes compute it: the sign of a difference is exact.
            let (right, bottom) = (reach[0] * w[i], reach[1] * w[i]);
            inside &= (x[i].abs() <= right) & (y[i].abs() <= bottom);
            inside &= (z[i] >= 0.0) & (z[i] * self.z_scale <= w[i]);
            inside &= (w[i] >= self.least_w) & (w[i] <= self.most_w);
        }
        inside
    }

    /// Computes the vertices to the same bits as [`View::vertex`] does inside all planes.
    /// Orthographic vertices have w = 1. Returns the least and the largest weight, if there are
    /// any.
    #[inline(always)]
    fn on_picture<const PERSPECTIVE: bool>(
        &self,
        x: &Coord,
        y: &Coord,
        z: &Coord,
        w: &Coord,
        out: &mut [ScreenVertex; BLOCK],
    ) -> [f64; 2] {
        let (mut weights, [mut least, mut largest]) = ([1.0; BLOCK], Placed::NONE.weights);
        if PERSPECTIVE && self.view.needs_inv_w {
            for i in 0..BLOCK {
                weights[i] = self.near / w[i];
            }
            for weight in weights {
                (least, largest) = (least.min(weight), largest.max(weight));
            }
        }
        for i in 0..BLOCK {
            out[i] = ScreenVertex {
                x: nearest((over::<PERSPECTIVE>(x[i], w[i]) * 0.5 + 0.5) * self.size[0]),
                y: nearest((0.5 - over::<PERSPECTIVE>(y[i], w[i]) * 0.5) * self.size[1]),
                depth: if PERSPECTIVE { -1.0 / w[i] } else { z[i] },
                inv_w: weights[i],
            };
        }
        [least, largest]
    }
}

/// Divides by w. Without perspective w is 1, and nothing is divided.
#[inline(always)]
fn over<const PERSPECTIVE: bool>(c: f64, w: f64) -> f64 {
    if PERSPECTIVE { c / w } else { c }
}

/// Rounds to the nearest 1/256 pixel.
#[inline(always)]
fn nearest(pixels: f64) -> SubPixel {
    SubPixel::from_bits((pixels * 256.0 + ROUNDING).to_bits() as i32)
}

/// Computes the sides of the view that each vertex is beyond, as [`View::codes`] does, for vertices
/// between the near and the far plane.
#[inline(always)]
fn sides(x: &Coord, y: &Coord, w: &Coord, codes: &mut [Codes; BLOCK]) {
    for i in 0..BLOCK {
        let (left, right) = (Codes::from(x[i] < -w[i]), Codes::from(x[i] > w[i]));
        let (bottom, top) = (Codes::from(y[i] < -w[i]), Codes::from(y[i] > w[i]));
        codes[i] = left | right << 1 | bottom << 2 | top << 3;
    }
}

/// Loads a block of coordinates. A block that is not full is filled with copies of its last vertex.
#[inline(always)]
fn lanes(all: &[f32], from: usize, count: usize) -> Coord {
    let of_block = &all[from..from + count];
    let mut lanes = [0.0; BLOCK];
    match of_block.first_chunk::<BLOCK>() {
        Some(whole) => {
            for i in 0..BLOCK {
                lanes[i] = f64::from(whole[i]);
            }
        }
        None => {
            for i in 0..BLOCK {
                lanes[i] = f64::from(of_block[i.min(count - 1)]);
            }
        }
    }
    lanes
}
