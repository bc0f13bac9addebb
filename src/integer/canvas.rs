//! The caller's picture, into which triangles are drawn row by row.

use super::gradients::{Gradients, Plane};
use super::pixel::Pixel;
use super::vector::Vector;
use fixed::types::I24F8;

/// The most pixels that are stepped at once. Every piece starts from its plane equations again, so
/// that the rounding of steps cannot add up over more pixels.
const PIECE: usize = 128;

/// A corner of a triangle or polygon on the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vertex {
    /// The column in pixels from the left edge of the picture, within ±1,024. The centre of the
    /// first pixel is at 0.5.
    pub x: I24F8,
    /// The row in pixels from the upper edge of the picture, within ±1,024.
    pub y: I24F8,
    /// The depth; 0 is nearest. Only a canvas with a depth buffer reads it.
    pub depth: u16,
    /// The normal. Only its direction counts.
    pub normal: Vector,
}

/// A picture to draw triangles and convex polygons into, with a depth buffer if you pass one.
///
/// Corners go clockwise around a polygon, with y downward. Polygons that are seen from behind are
/// not drawn.
///
/// # Which polygons fit
///
/// A polygon with more than three corners is drawn as triangles around its first corner. Therefore
/// it fits only if it is convex and its corners lie within ±1,024 pixels. Clip other polygons
/// first.
///
/// # Which pixels are covered
///
/// Coverage is exact, as everywhere in this crate: a pixel belongs to a triangle if an odd count of
/// the triangle's edges lie left of the pixel's centre, or on it. So triangles that share an edge
/// share no pixel and leave no hole.
///
/// # Error of perspective
///
/// Normals, colours and depth are interpolated on the screen. If the depth in space varies by 10 %
/// from corner to corner of a triangle, a normal between two others is up to 2.4 % of the way off:
/// with normals 15° apart that is 0.6° or 2 levels. If it varies by 50 %, it is 10 % and 2.4°. On
/// finer triangles the error is smaller.
///
/// # Slivers
///
/// If values change by more than ⅛ per pixel, as in slivers at a silhouette, a triangle is lit
/// pixel by pixel from weights that are clamped to 0–1. So nothing overflows, however thin a
/// triangle is.
#[derive(Debug)]
pub struct Canvas<'a, P> {
    pixels: &'a mut [P],
    depth: Option<&'a mut [u16]>,
    pub(super) width: i32,
    pub(super) height: i32,
}

impl<'a, P: Pixel> Canvas<'a, P> {
    /// Makes a canvas of a picture's pixels, row by row from the top, and of their depths.
    ///
    /// A pixel is drawn where its depth is below the buffer's. Fill the buffer with 65,535 before
    /// each frame.
    ///
    /// Returns `None` if a side is 0 or above 1,024, or if a slice does not have `width` × `height`
    /// entries.
    pub fn new(
        pixels: &'a mut [P],
        depth: Option<&'a mut [u16]>,
        width: usize,
        height: usize,
    ) -> Option<Self> {
        let is_fit = (1..=1024).contains(&width) && (1..=1024).contains(&height);
        let is_full = |len: usize| len == width * height;
        if !is_fit || !is_full(pixels.len()) || depth.as_ref().is_some_and(|d| !is_full(d.len())) {
            return None;
        }
        Some(Self {
            pixels,
            depth,
            width: width as i32,
            height: height as i32,
        })
    }

    /// True if it has a depth buffer.
    #[inline(always)]
    pub(super) fn has_depth(&self) -> bool {
        self.depth.is_some()
    }

    /// Passes the visible pixels of a row to `shade`, from column `first` to before `end`, in
    /// pieces with the column where each begins. `depth` is the plane of 16-bit depths, divided by
    /// 2¹⁶.
    #[inline(always)]
    pub(super) fn row(
        &mut self,
        y: i32,
        (first, end): (i32, i32),
        (depth, gradients): (&Plane, &Gradients),
        mut shade: impl FnMut(&mut [P], i32),
    ) {
        let at = (y * self.width) as usize;
        let range = at + first as usize..at + end as usize;
        // `get_mut` never fails here. Indexing would link a panic, which firmware must not have.
        let Some(line) = self.pixels.get_mut(range.clone()) else {
            return;
        };
        let Some(buffer) = self.depth.as_mut().and_then(|depth| depth.get_mut(range)) else {
            let mut x = first;
            for piece in line.chunks_mut(PIECE) {
                let pixels = piece.len() as i32;
                shade(piece, x);
                x += pixels;
            }
            return;
        };
        let mut z = depth.at(gradients.place(first, y));
        let mut i = 0;
        while i < buffer.len() {
            // Gather a run of visible pixels and shade it at once. If this pixel is hidden the run
            // is empty: skip one pixel.
            let from = i;
            while i < buffer.len() && i < from + PIECE {
                let near = clamped(z);
                if near >= buffer[i] {
                    break;
                }
                buffer[i] = near;
                z = z.wrapping_add(depth.step);
                i += 1;
            }
            if i > from {
                if let Some(piece) = line.get_mut(from..i) {
                    shade(piece, first + from as i32);
                }
            } else {
                z = z.wrapping_add(depth.step);
                i += 1;
            }
        }
    }

    /// Tests a pixel's depth and stores it in the buffer. Returns the pixel if it is visible.
    #[inline(always)]
    pub(super) fn pixel(&mut self, x: i32, y: i32, depth: u16) -> Option<&mut P> {
        let at = (y * self.width + x) as usize;
        if let Some(buffer) = &mut self.depth {
            let before = buffer.get_mut(at)?;
            if depth >= *before {
                return None;
            }
            *before = depth;
        }
        self.pixels.get_mut(at)
    }
}

/// Returns a Q30 depth in 16 bits. Planes round, so a depth may leave 0–1 a little.
#[inline(always)]
fn clamped(z: i32) -> u16 {
    (z >> 14).clamp(0, 65535) as u16
}
