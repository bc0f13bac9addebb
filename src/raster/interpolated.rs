//! Interpolated attributes themselves as pictures: the colours of vertices, and places on the surface as a checkerboard
//! (L5, Interpolation Across Triangles).
//!
//! Linear on the screen, or, if the frame asks for it, linear in space for one division a pixel. Under a perspective camera
//! the first bends the squares of a board at every diagonal (L5, *What's wrong?*), the second does not.

use super::barycentric::{self, Edges};
use super::scanline;
use super::supersampling::{draw_anyhow, draw_rows};
use super::target::{Target, linear_picture};
use crate::frame::Frame;
use crate::lighting::{Lighting, Rgb};
use crate::number::{Machine, Num, Real, Scalar, each};
use crate::picture::LinearPicture;
use crate::scene::Interpolation;
use crate::shader::{Corner, Corners, Shader, SpanOf};
use crate::walk::{Lerp, Linear};
use core::marker::PhantomData;

/// The colours of the vertices ([`Frame::colour`]), interpolated: linear, clamped to 0..=1; alpha 0 where nothing is seen.
pub fn vertex_colours(frame: &Frame) -> LinearPicture {
    colours(frame, None)
}

/// [`vertex_colours`] by the barycentric renderer (CS171 1, Algorithm 2), which passes over polygons of more than three
/// corners.
pub fn barycentric_vertex_colours(frame: &Frame, edges: Edges) -> LinearPicture {
    colours(frame, Some(edges))
}

fn colours(frame: &Frame, edges: Option<Edges>) -> LinearPicture {
    shown(frame, edges, |target| draw::<Colour>(frame, edges, target))
}

/// A checkerboard on the world's x and z, the plane of a floor: alpha 0 where nothing is seen.
/// ```text
/// C(x, z) = c_1 if ⌊x/s⌋ + ⌊z/s⌋ is even, else c_2      (L5, Image Function, whose plane is x, y)
/// ```
/// `size` is s, in world units, over 0; `colours` are c_1 and c_2.
pub fn checkerboard(frame: &Frame, size: f64, colours: [Rgb; 2]) -> LinearPicture {
    board(frame, None, size, colours)
}

/// [`checkerboard`] by the barycentric renderer, which passes over polygons of more than three corners.
pub fn barycentric_checkerboard(
    frame: &Frame,
    edges: Edges,
    size: f64,
    colours: [Rgb; 2],
) -> LinearPicture {
    board(frame, Some(edges), size, colours)
}

fn board(frame: &Frame, edges: Option<Edges>, size: f64, colours: [Rgb; 2]) -> LinearPicture {
    shown(frame, edges, |target| {
        draw::<World>(
            frame,
            edges,
            &mut Squares {
                target,
                size,
                colours,
            },
        )
    })
}

/// What `draw` gives, sample by sample, as a picture. The barycentric renderer comes back to samples that it drew.
fn shown(frame: &Frame, edges: Option<Edges>, draw: impl FnOnce(&mut dyn Target)) -> LinearPicture {
    let mut picture = linear_picture(frame);
    match edges {
        None => draw_rows(frame, &mut picture, draw),
        Some(_) => draw_anyhow(frame, &mut picture, draw),
    }
    picture
}

/// Takes world coordinates and passes on the colour of the square that they are in.
struct Squares<'a> {
    target: &'a mut dyn Target,
    size: f64,
    colours: [Rgb; 2],
}

impl Target for Squares<'_> {
    fn store(&mut self, x: usize, row: usize, places: &[[f32; 3]]) {
        for (column, [world_x, _, world_z]) in (x..).zip(places) {
            let square = |coordinate: f32| libm::floor(f64::from(coordinate) / self.size);
            // ⌊x/s⌋ + ⌊z/s⌋ is even where half of it is whole.
            let half = (square(*world_x) + square(*world_z)) / 2.0;
            let colour = self.colours[usize::from(half != libm::floor(half))]; // C(x, z)
            self.target.store(column, row, &[colour]);
        }
    }
}

fn draw<Q: Quantity>(frame: &Frame, edges: Option<Edges>, target: &mut dyn Target) {
    match (edges, frame.interpolation()) {
        (None, Interpolation::Screen) => {
            scanline::draw::<OnScreen<Q>, Scalar>(Scalar, frame, &[], target)
        }
        (None, Interpolation::Perspective) => {
            scanline::draw::<Weighted<Q>, Scalar>(Scalar, frame, &[], target)
        }
        (Some(edges), Interpolation::Screen) => {
            barycentric::draw::<OnScreen<Q>, Scalar>(Scalar, frame, &[], edges, target);
        }
        (Some(edges), Interpolation::Perspective) => {
            barycentric::draw::<Weighted<Q>, Scalar>(Scalar, frame, &[], edges, target);
        }
    }
}

/// What is interpolated: three numbers of a vertex.
trait Quantity: 'static {
    fn of<M: Machine>(corner: &Corner<'_, M>) -> [M::One; 3];
}

struct Colour;

impl Quantity for Colour {
    #[inline(always)]
    fn of<M: Machine>(corner: &Corner<'_, M>) -> [M::One; 3] {
        corner.colour()
    }
}

struct World;

impl Quantity for World {
    #[inline(always)]
    fn of<M: Machine>(corner: &Corner<'_, M>) -> [M::One; 3] {
        corner.world()
    }
}

/// Shows what is interpolated, linear on the screen. Not a shading method, so it is not in the table.
struct OnScreen<Q>(PhantomData<Q>);

impl<Q: Quantity> Shader for OnScreen<Q> {
    type Consts<N: Num> = N;
    type Attribute<R: Real> = Lerp<[R; 3]>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = [Linear<M::F>; 3];
    type Pixel<F: Num> = [F; 3];

    fn consts<N: Num>(_: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> N {
        of(1.0)
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &M::One, corner: &Corner<'_, M>) -> Lerp<[M::One; 3]> {
        Lerp(Q::of(corner))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &M::One, _: &Corners<'_, M, Lerp<[M::One; 3]>>) {}
    #[inline(always)]
    fn walk<M: Machine>(m: M, _: &M::One, _: &(), span: &SpanOf<Self, M::One>) -> Self::Walk<M> {
        each(
            #[inline(always)]
            |i| Linear::new(m, span.attribute.at[i], span.attribute.step[i]),
        )
    }
    #[inline(always)]
    fn shade<F: Num>(_: &F, value: [F; 3]) -> [F; 3] {
        value
    }
}

/// The same, linear in space: value/w and 1/w are interpolated and divided.
struct Weighted<Q>(PhantomData<Q>);

impl<Q: Quantity> Shader for Weighted<Q> {
    type Consts<N: Num> = N;
    type Attribute<R: Real> = Lerp<([R; 3], R)>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = ([Linear<M::F>; 3], Linear<M::F>);
    type Pixel<F: Num> = ([F; 3], F);

    fn consts<N: Num>(_: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> N {
        of(1.0)
    }
    #[inline(always)]
    fn vertex<M: Machine>(one: &M::One, corner: &Corner<'_, M>) -> Lerp<([M::One; 3], M::One)> {
        Lerp((Q::of(corner), *one))
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &M::One, _: &Corners<'_, M, Lerp<([M::One; 3], M::One)>>) {}
    #[inline(always)]
    fn walk<M: Machine>(m: M, _: &M::One, _: &(), span: &SpanOf<Self, M::One>) -> Self::Walk<M> {
        let (at, step) = (span.attribute.at, span.attribute.step);
        let value = each(
            #[inline(always)]
            |i| Linear::new(m, at.0[i], step.0[i]),
        );
        (value, Linear::new(m, at.1, step.1))
    }
    #[inline(always)]
    fn shade<F: Num>(one: &F, (value, weight): Self::Pixel<F>) -> [F; 3] {
        let w = *one / weight;
        [value[0] * w, value[1] * w, value[2] * w]
    }
}
