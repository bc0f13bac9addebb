//! A picture of the caller's with what triangles are drawn into it.

use super::gradients::{Gradients, Plane};
use super::pixel::Pixel;
use super::vector::Vector;
use fixed::types::I24F8;

/// The most pixels that are stepped at once: then values are evaluated anew.
const PIECE: usize = 128;

/// A corner of a triangle or polygon on the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vertex {
    /// Columns from the left edge of the picture, within ±1,024: 0.5 is the centre of the first pixel.
    pub x: I24F8,
    /// Rows from the upper edge of the picture, within ±1,024.
    pub y: I24F8,
    /// The depth, 0 nearest. It is read where the canvas has a depth buffer.
    pub depth: u16,
    /// The normal, of which only the direction counts.
    pub normal: Vector,
}

/// A picture to draw triangles and convex polygons into: rows of pixels, and depth if there is any.
///
/// Corners go clockwise round a polygon, y downward; polygons seen from behind are left out. A
/// polygon with more than three corners is drawn as the triangles about its first corner. So it fits if it
/// is convex and its corners lie within ±1,024 pixels: cut others before.
///
/// Coverage is exact, as everywhere in this crate: a pixel belongs to the triangle with an odd number
/// of edges left of its centre, or on it. So triangles that share an edge share no pixel and leave no
/// hole.
///
/// Normals, colours and depth are interpolated on the screen. Where a triangle's depth in space varies
/// by 10 % from corner to corner, a normal is then up to 2.4 % of the way off between its ends, which
/// at 15° is 0.6° or 2 levels; by 50 %: 10 %, 2.4°. Finer triangles have less of it.
///
/// Triangles whose values change by more than ⅛ a pixel, as slivers at a silhouette, are lit pixel by
/// pixel from weights that are clamped to 0–1. So nothing overflows, however thin a triangle is.
#[derive(Debug)]
pub struct Canvas<'a, P> {
    pixels: &'a mut [P],
    depth: Option<&'a mut [u16]>,
    pub(super) width: i32,
    pub(super) height: i32,
}

impl<'a, P: Pixel> Canvas<'a, P> {
    /// Makes a canvas of a picture's rows, one after another, and of the depths of its pixels.
    ///
    /// A pixel is drawn where its depth is below the buffer's: fill it with 65,535 for each frame.
    ///
    /// Returns `None` if a side is 0 or above 1,024, or a slice has not `width` × `height` entries.
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

    /// Hands the visible pixels of a row from column `first` to before `end` to `shade`, in pieces,
    /// with the column where each begins. `depth` is the plane of 16-bit depths over 2¹⁶.
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
            // Passes what is hidden, then gathers what is seen.
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

    /// Returns a pixel to draw, if its depth of 16 bits is below the buffer's, which it then is.
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

/// Returns a depth of 30 fractional bits as 16 bits.
#[inline(always)]
fn clamped(z: i32) -> u16 {
    (z >> 14).clamp(0, 65535) as u16
}
