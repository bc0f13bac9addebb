//! The row engine: a deferred renderer, on SIMD.
//!
//! ```text
//! bin ─► set up ─────────► rasterise ──────────────► G-buffer ─► shade ─► picture
//!        triangles.rs      tiny.rs   pixel by pixel  tile.rs     shade.rs
//!        8 in the lanes    small.rs  block by block  16 rows     a row by one
//!        of a block        runs.rs   run by run      of blocks   call a material
//! ```
//!
//! Polygons are binned into tiles of 16 scanlines. Those of a tile are set up in batches and rasterised, in drawing order, with a
//! depth test: what the method interpolates is written into the tile's G-buffer, beside depth and material. Then each row is shaded
//! once. So shading costs the same for a pixel of a triangle of two pixels as in one of a thousand, and hidden pixels are never
//! shaded. Tiles are independent: one is one unit of work for a thread.
//!
//! Three coverage paths find the same pixels. *Tiny* triangles are tested pixel by pixel, eight triangles at a time. *Small* ones are
//! tested by edge functions, eight pixels at a time. Everything else is drawn by *runs*: large triangles by the crossings of their
//! edges, n-gons by the active edges of the span engine, and the recurrences of fast, Duff's and slerp Phong by
//! their walk kernels, many runs at a time.
//!
//! Nothing here knows a method or a light: a method is its [`Kernels`](crate::shading::Kernels), called once a row or a batch of
//! runs, and all of this is compiled once an instruction set.

mod runs;
mod shade;
mod small;
mod tile;
mod tiny;
mod triangles;

use super::bands::Bands;
use super::bins::{Bins, Listed};
use super::depth::SampleDepth;
use super::setup::SetUp;
use super::spans::active::ActiveEdges;
use crate::frame::Frame;
use crate::number::Level;
use crate::number::lanes::Lanes;
use crate::number::simd::{Token, vectorize};
use crate::shading::{SimdKernels, Variant};
use core::ops::Range;
use runs::{RunQueue, Triangle};
use shade::Line;
use small::{RowStarts, SmallTriangle};
use tile::{Count, DepthTest, Tile};
use tiny::Fragments;
use triangles::{Batch, Kind, LINE, each_bit};

/// Scanlines of a tile: edges are seldom started anew, and every thread gets some.
const HEIGHT: usize = 16;

/// Memory that a thread keeps from tile to tile.
#[derive(Debug, Default)]
struct Scratch {
    tile: Tile,
    batch: Batch,
    fragments: Fragments,
    starts: RowStarts,
    queue: RunQueue,
    line: Line,
}

/// A method on a frame, and how its pixels are kept.
struct Rows<'a> {
    setup: SetUp<'a>,
    kernels: &'a SimdKernels,
    test: DepthTest,
    /// Planes of a pixel: what is walked, or interpolated.
    planes: usize,
    /// Numbers of a pixel: its depth, its planes, and its material if materials differ.
    numbers: usize,
    has_material: bool,
    /// The uniforms of all pixels where they do not.
    only: u32,
}

/// Draws a method on a frame, tile by tile. `is_bytes` where `bands` stores bytes.
pub(super) fn draw(
    variant: &Variant,
    frame: &Frame,
    level: Level,
    is_bytes: bool,
    bands: &mut dyn Bands,
) {
    let scale = if is_bytes && frame.samples() == 1 {
        255.0
    } else {
        1.0
    };
    let setup = SetUp::new(variant, frame, level, scale);
    let Some(kernels) = setup.kernels.on(level) else {
        return; // no plan asks for the row engine there
    };
    let depth = SampleDepth::new(frame);
    let [_, planes] = (setup.kernels.counts)(frame.light_count());
    let planes = planes + setup.extras.count();
    let only = only_material(&setup);
    let rows = Rows {
        test: DepthTest {
            hides: depth.hides(),
            most: depth.most(),
        },
        planes,
        numbers: 1 + planes + usize::from(only.is_none()),
        has_material: only.is_none(),
        only: only.unwrap_or(0),
        kernels,
        setup,
    };
    let bins = Bins::new(frame, HEIGHT);
    bands.each(HEIGHT, &|number, band, target| {
        with_scratch(|scratch| {
            scratch.tile.prepare(HEIGHT, frame.width(), rows.numbers);
            for polygons in bins.band(number) {
                match level {
                    #[cfg(target_arch = "x86_64")]
                    Level::Avx2 => rows.rasterise::<fearless_simd::Avx2>(polygons, &band, scratch),
                    #[cfg(target_arch = "x86_64")]
                    Level::Avx512 => {
                        rows.rasterise::<fearless_simd::Avx512>(polygons, &band, scratch)
                    }
                    #[cfg(target_arch = "aarch64")]
                    Level::Neon => rows.rasterise::<fearless_simd::Neon>(polygons, &band, scratch),
                    _ => return, // no plan asks for it
                }
            }
            for row in 0..band.len() {
                rows.shade(row, scratch, target);
            }
        });
    });
}

/// Gives `work` what this thread keeps from band to band.
fn with_scratch(work: impl FnOnce(&mut Scratch)) {
    std::thread_local! {
        static KEPT: core::cell::RefCell<Scratch> = core::cell::RefCell::default();
    }
    KEPT.with_borrow_mut(work);
}

/// Returns the number of the uniforms that all polygons have, if there is only one: objects of a scene bring their own material,
/// which are often the same.
fn only_material(setup: &SetUp<'_>) -> Option<u32> {
    let (frame, polygons) = (setup.frame, setup.frame.polygons());
    if setup.is_by_polygon {
        return None;
    }
    if frame
        .lightings()
        .iter()
        .all(|lighting| *lighting == frame.lightings()[0])
    {
        return Some(0);
    }
    let first = polygons.first().map_or(0, |polygon| polygon.material);
    polygons
        .iter()
        .all(|polygon| polygon.material == first)
        .then_some(first)
}

impl Rows<'_> {
    /// Rasterises polygons into a tile, in order.
    fn rasterise<S: Token>(&self, polygons: &[Listed], rows: &Range<usize>, scratch: &mut Scratch) {
        let simd = S::get();
        let is_linear = self.setup.kernels.linear;
        let mut active = None;
        let mut rest = polygons;
        while let Some((next, others)) = rest.split_first() {
            if is_linear && next.is_triangle() {
                // Triangles are drawn at once: what was before them must be drawn first.
                self.draw_runs(simd, scratch);
                if self.numbers == 4 {
                    rest = &rest[self.triangles::<S, 4>(simd, rest, rows, scratch)..];
                } else {
                    rest = &rest[self.triangles::<S, 0>(simd, rest, rows, scratch)..];
                }
                continue;
            }
            let varyings = &self.setup.varyings;
            if next.is_triangle() && !varyings.great_circle && varyings.count < LINE {
                rest = &rest[self.triangle_runs(simd, rest, rows, scratch)..];
            } else {
                let active = active.get_or_insert_with(|| {
                    ActiveEdges::new(self.setup.frame, &self.setup.varyings)
                });
                scratch
                    .queue
                    .add_polygon(&self.setup, active, next.number, rows);
                rest = others;
            }
            if scratch.queue.is_full() {
                self.draw_runs(simd, scratch);
            }
        }
        self.draw_runs(simd, scratch);
    }

    /// Draws triangles from the front of `polygons`; gives how many.
    #[inline(never)]
    fn triangles<S: Token, const N: usize>(
        &self,
        simd: S,
        polygons: &[Listed],
        rows: &Range<usize>,
        scratch: &mut Scratch,
    ) -> usize {
        let (taken, drawn, others) = find(simd, self.setup.frame, polygons, rows, scratch);
        let Scratch {
            tile,
            batch,
            fragments,
            starts,
            ..
        } = scratch;
        vectorize(
            simd,
            #[inline(always)]
            || {
                let m = Lanes(simd);
                batch.set_up_planes(m, &self.setup, Count::<N>(self.numbers), drawn | others);
                let writer = &mut tile.writer::<S, N>(m, self.test);
                each_bit(
                    drawn | others,
                    #[inline(always)]
                    |k| {
                        if others >> k & 1 == 0 {
                            fragments.draw(m, batch, k, writer);
                        } else if batch.kind[k] == Kind::Small as i32 {
                            SmallTriangle::new(m, batch, k).draw(starts, rows.start, writer);
                        } else {
                            runs::draw_large(m, batch, k, rows.start, writer);
                        }
                    },
                );
            },
        );
        taken
    }

    /// Finds the runs of triangles from the front of `polygons`; gives how many.
    #[inline(never)]
    fn triangle_runs<S: Token>(
        &self,
        simd: S,
        polygons: &[Listed],
        rows: &Range<usize>,
        scratch: &mut Scratch,
    ) -> usize {
        let (taken, drawn, others) = find(simd, self.setup.frame, polygons, rows, scratch);
        let Scratch {
            batch,
            fragments,
            queue,
            ..
        } = scratch;
        vectorize(
            simd,
            #[inline(always)]
            || {
                let m = Lanes(simd);
                let count = Count::<0>(1 + self.setup.varyings.count);
                batch.set_up_planes(m, &self.setup, count, drawn | others);
                each_bit(
                    drawn | others,
                    #[inline(always)]
                    |k| {
                        let top = rows.start;
                        if others >> k & 1 == 0 {
                            let [_, b, c] = &batch.edges;
                            let across = [b, c].map(|f| f.right[k] as f32 * batch.over_area[k]);
                            let mut runs = queue.triangle(m, &self.setup, batch, k, across);
                            fragments.runs(
                                batch,
                                k,
                                top,
                                #[inline(always)]
                                |row, pixels, at| runs.add(row, pixels, at),
                            );
                        } else if let Some(triangle) = Triangle::of(batch, k) {
                            let across = triangle.across();
                            let mut runs = queue.triangle(m, &self.setup, batch, k, across);
                            triangle.runs(
                                top,
                                #[inline(always)]
                                |row, pixels, at| runs.add(row, pixels, at),
                            );
                        }
                    },
                );
            },
        );
        taken
    }

    /// Draws the runs that were found.
    #[inline(never)]
    fn draw_runs<S: Token>(&self, simd: S, scratch: &mut Scratch) {
        let Scratch { tile, queue, .. } = scratch;
        if queue.is_empty() {
            return;
        }
        queue.extend(tile);
        queue.walk(&self.setup, self.kernels.walk, self.planes);
        vectorize(
            simd,
            #[inline(always)]
            || {
                let m = Lanes(simd);
                let is_walked = self.kernels.walk.is_some();
                queue.draw(
                    m,
                    &self.setup,
                    is_walked,
                    self.planes,
                    &mut tile.writer(m, self.test),
                );
            },
        );
    }
}

/// Gathers triangles from the front of `polygons` and finds where they lie in a tile. Gives how many, and bits for the tiny ones that
/// cover anything and for the others.
#[inline(never)]
fn find<S: Token>(
    simd: S,
    frame: &Frame,
    polygons: &[Listed],
    rows: &Range<usize>,
    scratch: &mut Scratch,
) -> (usize, u32, u32) {
    let Scratch {
        tile,
        batch,
        fragments,
        ..
    } = scratch;
    vectorize(
        simd,
        #[inline(always)]
        || {
            let m = Lanes(simd);
            let taken = batch.gather(frame, polygons);
            let (blocks, others) = batch.set_up(m, frame.width(), rows);
            tile.extend(blocks);
            let tiny = fragments.find(m, batch, rows.start, tile.layout());
            (taken, tiny, others)
        },
    )
}

#[cfg(test)]
mod tests;
