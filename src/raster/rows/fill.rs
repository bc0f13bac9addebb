//! Triangles into a band whose pixels are given numbers that are linear over them, those of their corners or of their polygon, wherever
//! they are nearer than what was drawn before.
//!
//! Nothing here knows a shader, only what its pixels are made of: what is compiled serves all shaders whose pixels are alike.

use super::band::Cells;
use super::batch::{Batch, Kind, each_bit};
use super::facets::Facet;
use super::paint::outside;
use super::read::Numbers;
use super::small::SmallTriangle;
use super::tiny::Fragments;
use super::triangle::{Starts, Triangle};
use crate::frame::Frame;
use crate::number::{Lanes, Num, Planes, get_each};
use crate::raster::depth::SampleDepth;
use crate::walk::Attribute;

/// How many numbers triangles have whose pixels are `P`: their depth, and those of the pixels.
pub(super) const fn facets<F, P: Planes<F>>() -> usize {
    match P::COUNT {
        Some(count) => 1 + count,
        None => 1,
    }
}

/// What fills triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Filler<'a, A, Q> {
    pub frame: &'a Frame,
    /// The numbers.
    pub numbers: Numbers<'a, A, Q>,
    /// How depth is compared and kept.
    pub depth: SampleDepth,
    /// Whether pixels have different materials.
    pub has_materials: bool,
}

impl<A: Attribute<f32>, Q: Planes<f32>> Filler<'_, A, Q> {
    /// Draws those triangles of a batch whose bits `drawn` has on the band that begins with row `top`, in order. `fragments` are the
    /// pixels of its tiny ones.
    #[inline(always)]
    pub fn batch<M: Lanes, P: Planes<M::F>>(
        &self,
        m: M,
        (batch, drawn): (&mut Batch, u32),
        (fragments, starts): (&Fragments, &mut Starts),
        top: usize,
        cells: &mut Cells<'_, M, P>,
    ) {
        let facets = facets::<M::F, P>();
        batch.read_numbers(m, self.frame, (self.numbers, facets), drawn);
        if self.has_materials {
            batch.read_materials(self.frame, drawn);
        }
        let (batch, others) = (&*batch, batch.others());
        each_bit(
            drawn,
            #[inline(always)]
            |k| {
                if others >> k & 1 == 0 {
                    let material = batch.material(k);
                    fragments.each(
                        m,
                        (batch, facets),
                        k,
                        #[inline(always)]
                        |place, numbers| cells.put_one(place, numbers, material),
                    );
                } else if batch.kind(k) == Kind::Small as i32 {
                    let triangle = SmallTriangle::new(m, batch, k);
                    if self.has_materials {
                        triangle.draw::<true, P>(m, starts, top, cells);
                    } else {
                        triangle.draw::<false, P>(m, starts, top, cells);
                    }
                } else if let Some(triangle) = batch.large(k) {
                    large(m, (batch, k), &triangle, top, cells);
                }
            },
        );
    }
}

/// Draws large triangle `k` of a batch.
#[inline(always)]
fn large<M: Lanes, P: Planes<M::F>>(
    m: M,
    (batch, k): (&Batch, usize),
    triangle: &Triangle,
    top: usize,
    cells: &mut Cells<'_, M, P>,
) {
    let (material, across) = (batch.material(k), triangle.across());
    let across = [m.splat(across[0]), m.splat(across[1])];
    triangle.runs(
        top,
        #[inline(always)]
        |row, pixels, weights| {
            let mut group = pixels.start / M::WIDTH;
            // Columns from the first pixel on, which is exact; before it, nothing is drawn.
            let (mut column, next) = (
                m.ramp(-((pixels.start % M::WIDTH) as f32), 1.0),
                m.stride(1.0),
            );
            cells.each(
                row,
                group..pixels.end.div_ceil(M::WIDTH),
                #[inline(always)]
                |cell| {
                    let weights = [
                        across[0].mul_add(column, m.splat(weights[0])),
                        across[1].mul_add(column, m.splat(weights[1])),
                    ];
                    let mut i = 0;
                    let (depth, pixel) = get_each::<M::F, (M::F, P)>(
                        #[inline(always)]
                        || {
                            i += 1;
                            Facet::of(&batch.facets, i - 1, k).lanes(m, weights)
                        },
                    );
                    cell.put(m, outside(m, group, &pixels), depth, pixel, material);
                    column = column + next;
                    group += 1;
                },
            );
        },
    );
}
