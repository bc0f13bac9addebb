//! Which polygon the barycentric renderer shows at each pixel.

use super::barycentric::{self, Edges};
use super::target::Target;
use super::visibility::NOTHING;
use crate::frame::Frame;
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, Scalar};
use crate::picture::Picture;
use crate::shader::{Corner, Corners, Shader, SpanOf};
use crate::walk::{Constant, Lerp};
use alloc::vec::Vec;

/// The number of the polygon that the barycentric renderer shows at each pixel, an index into [`Frame::polygons`], or
/// [`NOTHING`].
///
/// That of [`polygon_numbers`](super::polygon_numbers), but where depths agree to within rounding.
pub fn barycentric_polygon_numbers(frame: &Frame, edges: Edges) -> Picture<u32> {
    let mut by_first: Vec<_> = (0..)
        .zip(frame.polygons())
        .map(|(number, polygon)| (polygon.first, number))
        .collect();
    by_first.sort_unstable();
    let mut target = Numbers {
        by_first,
        picture: Picture::new(frame.width(), frame.height(), NOTHING),
    };
    barycentric::draw::<FirstCorner, Scalar>(Scalar, frame, &[], edges, &mut target);
    target.picture
}

/// Takes the "colours" of [`FirstCorner`] for what they are.
struct Numbers {
    /// Where the corners of each polygon begin, which tells polygons apart, and its number; in ascending order.
    by_first: Vec<(u32, u32)>,
    picture: Picture<u32>,
}

impl Target for Numbers {
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        for (texel, [high, low, _]) in self.picture.row_mut(row)[x..].iter_mut().zip(colours) {
            let first = ((*high as u32) << 16) | *low as u32;
            let place = self.by_first.binary_search_by_key(&first, |entry| entry.0);
            *texel = place.map_or(NOTHING, |place| self.by_first[place].1);
        }
    }
}

/// Shows where a polygon's corners begin, in two halves of 16 bits, which an `f32` holds exactly. Not a shading method,
/// so it is not in the table.
struct FirstCorner;

impl Shader for FirstCorner {
    type Consts<N: Num> = N;
    type Attribute<R: Real> = Lerp<()>;
    type Polygon<R: Real> = [R; 3];
    type Walk<M: Machine> = Constant<[M::F; 3]>;
    type Pixel<F: Num> = [F; 3];

    fn consts<N: Num>(_: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> N {
        of(0.0)
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &M::One, _: &Corner<'_, M>) -> Lerp<()> {
        Lerp(())
    }
    #[inline(always)]
    fn polygon<M: Machine>(zero: &M::One, corners: &Corners<'_, M, Lerp<()>>) -> [M::One; 3] {
        let first = corners.polygon.first;
        [
            corners.machine.one((first >> 16) as f32),
            corners.machine.one((first & 0xFFFF) as f32),
            *zero,
        ]
    }
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &M::One,
        number: &[M::One; 3],
        _: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        Constant(number.map(|half| m.splat(half)))
    }
    #[inline(always)]
    fn shade<F: Num>(_: &F, number: [F; 3]) -> [F; 3] {
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{FrameBuilder, SubPixel, Vertex};
    use crate::lighting::Material;
    use crate::raster::polygon_numbers;
    use crate::test_random::Random;
    use glam::DVec3;

    /// Small triangles of random places and depths; enough that the second half of the number is not all of it.
    fn triangles(count: usize, side: u32) -> Frame {
        let mut random = Random::new(7);
        let mut builder = FrameBuilder::new(side, side);
        let material =
            builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
        for number in 0..count {
            let depth = 0.5 + 0.5 * random.signed();
            let centre = [
                random.below(u64::from(256 * side)) as i32,
                random.below(u64::from(256 * side)) as i32,
            ];
            let corners = [(); 3].map(|()| {
                let [x, y] =
                    centre.map(|c| SubPixel::from_bits(c + random.below(1024) as i32 - 512));
                builder.vertex(Vertex {
                    x,
                    y,
                    depth,
                    inv_w: 1.0,
                    normal: [0.0, 0.0, 1.0],
                    material,
                })
            });
            builder.polygon(&corners, [0.0, 0.0, 1.0], number as u32);
        }
        builder.finish().unwrap()
    }

    #[test]
    fn it_shows_the_polygons_of_the_scanline_engine() {
        // Depth is constant over a triangle, so that only the rounding of it could part the two: one depth in 2²³.
        let frame = triangles(30_000, 300);
        let scanline = polygon_numbers(&frame);
        let seen = scanline.texels().iter().filter(|n| **n != NOTHING);
        assert!(
            seen.clone().any(|n| *n > 65_536 / 3),
            "numbers of over 16 bits are among them"
        );
        let barycentric = barycentric_polygon_numbers(&frame, Edges::TopLeft);
        let other = scanline
            .texels()
            .iter()
            .zip(barycentric.texels())
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(other, 0, "of {} pixels", seen.count());
    }
}
