//! The row engine: a deferred renderer, on SIMD.
//!
//! ```text
//! bin ───────► set up ────────► rasterise ──────────────► G-buffer ─► shade ─► picture
//! ../bins.rs   triangles.rs     tiny.rs   pixel by pixel  tile.rs     shade.rs
//!              8 triangles in   small.rs  block by block  16 rows     one call per row,
//!              the lanes        quads.rs  row by row      of blocks   as long as the material stays
//!                               runs.rs   run by run
//! ```
//!
//! Polygons are binned into bands of 16 scanlines. Those of a band are set up in batches and rasterised, in drawing order, with a
//! depth test: the method's varyings, or the pixels that its walk returns, are written into a tile, the band's G-buffer, beside depth
//! and material. Then each row is shaded once, by `shade_blocks` in `shading/kernels/mod.rs`. So the shading cost per pixel does not
//! depend on the size of triangles, and hidden pixels are never shaded. Bands are independent: each is one job for a thread.
//!
//! Where each polygon has one colour, that colour is the only varying, packed as the picture stores it (`packed.rs`).
//!
//! Three coverage paths find the same pixels. *Tiny* triangles are tested pixel by pixel, eight triangles at a time. *Small* ones are
//! tested by edge functions, eight pixels at a time. Everything else is drawn by *runs*: large triangles and slivers by the crossings
//! of their edges; polygons of more corners, and pixels of more than `MOST` numbers, by the active edges of the span engine. Runs of
//! small convex quadrangles are found for eight quadrangles at a time, and are the same to the bit. Only the three slerp methods and fast Phong
//! with a number of Newton's steps remember the pixel before: their walk kernels take many runs at a time.
//!
//! Who calls whom, for one frame:
//!
//! ```text
//! draw                 once        sets the method up and bins; its caller chooses where bands go: a picture, or rows that stream
//!   each_band          once        runs the closure below for every band, on the threads of the pool (../bands.rs)
//!     fill_tile        a band      with this thread's buffers
//!       rasterise      a band      compiled for an instruction set (`with_level!`): goes through the band's polygons in order
//!         triangles    a batch     set-up, coverage and plane equations of up to 32 triangles
//!         quads        a batch     set-up and runs of up to 8 convex quadrangles
//!         add_polygon  a polygon   runs of all others, in a queue
//!         draw_runs    a queue     walks along them, and writes them into the tile
//!     shade            a row       calls the method's kernel, stretch by stretch
//! ```
//!
//! A method is its [`Kernels`](crate::shading::Kernels) here, called for a stretch of a row or a batch of runs. All of this is
//! compiled once per instruction set.

mod packed;
mod quads;
mod runs;
mod shade;
mod small;
mod tile;
mod tiny;
mod triangles;

use super::bands::EachBand;
use super::bins::{Bins, Listed};
use super::depth::SampleDepth;
use super::setup::{SetUp, Varyings};
use super::spans::NOTHING;
use super::spans::active::ActiveEdges;
use crate::frame::row_tiles::TILE_HEIGHT as HEIGHT;
use crate::frame::{Frame, Polygon};
use crate::number::Level;
use crate::number::lanes::Lanes;
use crate::number::parallel::for_each_chunk;
use crate::number::simd::{BLOCK, Token, vectorize};
use crate::picture::Picture;
use crate::picture::encoding::quantise;
use crate::shading::light::Uniforms;
use crate::shading::{CellLayout, LitAt, SimdKernels, UniformsIndex, Variant, WalkKernel};
use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::ops::Range;
use quads::QuadBatch;
use runs::RunQueue;
use shade::RowBuffers;
use small::{RowStarts, SmallTriangle};
use tile::{MOST, NumberCount, Tile};
use tiny::Fragments;
use triangles::{Batch, CoveragePath, bits};

/// Evaluates an expression in which a name stands for the [`Token`] of a level.
macro_rules! with_level {
    ($level:expr, $token:ident => $work:expr) => {
        match $level {
            #[cfg(target_arch = "x86_64")]
            $crate::number::Level::Avx2 => {
                type $token = fearless_simd::Avx2;
                $work
            }
            #[cfg(target_arch = "x86_64")]
            $crate::number::Level::Avx512 => {
                type $token = fearless_simd::Avx512;
                $work
            }
            #[cfg(target_arch = "aarch64")]
            $crate::number::Level::Neon => {
                type $token = fearless_simd::Neon;
                $work
            }
            level => unreachable!("the method has loops for {level:?}"),
        }
    };
}
use with_level;

/// Memory that a thread keeps from tile to tile, and from frame to frame.
#[derive(Debug, Default)]
struct Buffers {
    tile: Tile,
    batch: Batch,
    quads: QuadBatch,
    fragments: Fragments,
    starts: RowStarts,
    queue: RunQueue,
    line: RowBuffers,
    /// Memory for the varyings of the next frame, and for its packed colours.
    varyings: Vec<f32>,
    packed: Vec<f32>,
}

std::thread_local! {
    static BUFFERS: RefCell<Buffers> = RefCell::default();
}

/// A method on a frame, and the layout of its pixels.
struct RowEngine<'a> {
    level: Level,
    setup: SetUp<'a>,
    kernels: &'a SimdKernels,
    /// Walks along runs, if the method remembers the pixel before.
    walk: Option<WalkKernel>,
    /// True if triangles are drawn by plane equations, not run by run as all other polygons are.
    is_planar: bool,
    test: SampleDepth,
    cell: CellLayout,
    /// The uniforms that all pixels can be shaded with, if there are any such.
    only: Option<UniformsIndex>,
    /// True if the only varying is a polygon's colour: `packed.rs`.
    is_packed: bool,
    background: [u8; 4],
}

/// Draws a method on a frame, tile by tile. `is_levels` where the picture stores levels of linear intensity.
pub(super) fn draw(
    variant: &Variant,
    frame: &Frame,
    level: Level,
    is_levels: bool,
    each_band: &mut EachBand<'_>,
) {
    let is_scaled = is_levels && frame.samples() == 1;
    let scale = if is_scaled { 255.0 } else { 1.0 };
    let [memory, packed] = BUFFERS.with_borrow_mut(|buffers| {
        [&mut buffers.varyings, &mut buffers.packed].map(core::mem::take)
    });
    let Some(mut rows) = RowEngine::new(variant, frame, level, scale, memory) else {
        unreachable!("`Variant::plan` chooses the span engine where a method has no loops");
    };
    let kept = match is_scaled {
        true => rows.pack(packed),
        false => packed,
    };
    let bins = Bins::new(frame, HEIGHT);
    each_band(HEIGHT, &|number, band, target| {
        BUFFERS.with_borrow_mut(|buffers| {
            rows.fill_tile(&bins, (number, &band), buffers);
            for row in 0..band.len() {
                rows.shade(row, buffers, target);
            }
        });
    });
    if let Cow::Owned(values) = rows.setup.varyings.values {
        let (varyings, packed) = match rows.is_packed {
            true => (kept, values),
            false => (values, kept),
        };
        BUFFERS.with_borrow_mut(|buffers| (buffers.varyings, buffers.packed) = (varyings, packed));
    }
}

/// Returns the number of the polygon that is seen at each sample where a method is drawn, or [`NOTHING`].
///
/// Depth is rounded as coverage path and instruction set have it, so that of two polygons of nearly equal depth each may show
/// another one. The tiles are therefore filled by the method's own loops, with polygon numbers in the place of varyings.
pub(super) fn polygon_numbers(variant: &Variant, frame: &Frame, level: Level) -> Picture<u32> {
    let mut picture = Picture::new(frame.width(), frame.height(), NOTHING);
    let Some(rows) = RowEngine::new(variant, frame, level, 1.0, Vec::new()) else {
        unreachable!("`Variant::plan` chooses the span engine where a method has no loops");
    };
    let rows = rows.numbering();
    let bins = Bins::new(frame, HEIGHT);
    let a_band = HEIGHT * frame.width();
    for_each_chunk(
        picture.pixels_mut(),
        a_band,
        &|start, pixels: &mut [u32]| {
            let number = start / a_band;
            let band = number * HEIGHT..((number + 1) * HEIGHT).min(frame.height());
            BUFFERS.with_borrow_mut(|buffers| {
                rows.fill_tile(&bins, (number, &band), buffers);
                for (row, to) in pixels.chunks_exact_mut(frame.width()).enumerate() {
                    rows.take_numbers(row, &mut buffers.tile, to);
                }
            });
        },
    );
    picture
}

/// Returns the number of some uniforms that all pixels can be shaded with, if there are any: where the method reads none there but
/// the scale, or where all polygons have the same ones. Objects of a scene bring their own materials, which are often equal.
fn only_uniforms(setup: &SetUp<'_>, lit_at: LitAt) -> Option<UniformsIndex> {
    let (frame, polygons) = (setup.frame, setup.frame.polygons());
    // A frame without polygons may have no material either.
    let first = polygons.first()?.material;
    if lit_at != LitAt::Pixel {
        // Colours that are too large for the fast path are then clamped, whichever material they are of.
        let is_slow = |uniforms: &Uniforms| !uniforms.model.is_fast;
        let slow = setup.uniforms.iter().position(is_slow);
        return Some(UniformsIndex(slow.unwrap_or(0) as u32));
    }
    if setup.is_by_polygon {
        return None;
    }
    let is_first = |polygon: &Polygon| polygon.material == first;
    let are_alike = frame.lightings().windows(2).all(|two| two[0] == two[1]);
    (are_alike || polygons.iter().all(is_first)).then(|| setup.uniforms_of_material(first))
}

impl<'a> RowEngine<'a> {
    /// Sets up a method on a frame: see [`SetUp::new`]. Returns `None` if the method has no loops for the instruction set.
    fn new(
        variant: &'a Variant,
        frame: &'a Frame,
        level: Level,
        scale: f32,
        memory: Vec<f32>,
    ) -> Option<RowEngine<'a>> {
        let setup = SetUp::new(variant, frame, level, scale, memory);
        let kernels = (setup.kernels.simd)(level)?;
        let [_, walked, _] = (setup.kernels.counts)(frame.light_count());
        let walks_along =
            |first: &Uniforms| (setup.kernels.walks_along_runs)(setup.parameters, &first.model);
        let walk = kernels
            .walk
            .filter(|_| setup.uniforms.first().is_some_and(walks_along));
        let only = only_uniforms(&setup, variant.row().needs.lit_at);
        let extras = setup.extras.count();
        let varyings = match walk {
            Some(_) => walked,
            None => setup.varyings.count - extras,
        };
        let cell = CellLayout {
            varyings,
            extras,
            has_uniforms: only.is_none(),
        };
        let [r, g, b] = frame.background().map(quantise);
        Some(RowEngine {
            level,
            test: SampleDepth::new(frame),
            is_planar: walk.is_none() && cell.count() <= MOST,
            cell,
            is_packed: false,
            only,
            background: [r, g, b, 0],
            kernels,
            walk,
            setup,
        })
    }

    /// Puts the number of each polygon in the place of varyings and materials. Coverage paths and depths stay as they are.
    fn numbering(mut self) -> Self {
        self.setup.varyings = Varyings::none();
        self.setup.is_by_polygon = true;
        self.cell = CellLayout {
            has_uniforms: true,
            ..CellLayout::default()
        };
        (self.only, self.walk) = (None, None);
        self
    }

    /// Moves the polygon numbers of row `row` out of a tile of an engine that is [numbering](Self::numbering).
    fn take_numbers(&self, row: usize, tile: &mut Tile, to: &mut [u32]) {
        let blocks = tile.drawn();
        let cells = tile.row(row, blocks.clone());
        let to = to.get_mut(blocks.start * BLOCK..).unwrap_or_default();
        let blocks = cells.chunks_exact(tile.stride());
        for (to, block) in to.chunks_mut(BLOCK).zip(blocks) {
            for (x, to) in to.iter_mut().enumerate() {
                if block[BLOCK * CellLayout::DEPTH + x] < f32::INFINITY {
                    let number = block[BLOCK * tile.cell.uniforms() + x];
                    *to = CellLayout::uniforms_of(number).0;
                }
            }
        }
        tile.clear_row(row);
    }

    /// Empties a tile and rasterises all polygons of a band into it.
    fn fill_tile(
        &self,
        bins: &Bins,
        (number, band): (usize, &Range<usize>),
        buffers: &mut Buffers,
    ) {
        let width = self.setup.frame.width();
        buffers.tile.prepare(HEIGHT, width, self.cell);
        buffers.queue.prepare(self.setup.varyings.count);
        for polygons in bins.band(number) {
            with_level!(self.level, S => self.rasterise::<S>(polygons, band, buffers));
        }
    }

    /// Rasterises polygons into a tile, in order.
    fn rasterise<S: Token>(&self, polygons: &[Listed], rows: &Range<usize>, buffers: &mut Buffers) {
        let (simd, varyings) = (S::get(), &self.setup.varyings);
        let mut active = None;
        let mut rest = polygons;
        while let Some(next) = rest.first() {
            let mut taken = 1;
            if next.is_triangle() && self.is_planar {
                // Triangles are drawn at once: runs from before them come first.
                self.draw_runs(simd, buffers);
                // The numbers that most methods have on most scenes.
                taken = match self.cell.count() {
                    2 => self.triangles::<S, 2>(simd, rest, rows, buffers),
                    5 => self.triangles::<S, 5>(simd, rest, rows, buffers),
                    6 => self.triangles::<S, 6>(simd, rest, rows, buffers),
                    4 => self.triangles::<S, 4>(simd, rest, rows, buffers),
                    _ => self.triangles::<S, 0>(simd, rest, rows, buffers),
                };
            } else {
                let mut is_drawn = false;
                if next.is_quadrangle() && self.is_planar {
                    (taken, is_drawn) = match self.cell.count() {
                        2 => self.quads::<S, 2>(simd, rest, rows, buffers),
                        5 => self.quads::<S, 5>(simd, rest, rows, buffers),
                        6 => self.quads::<S, 6>(simd, rest, rows, buffers),
                        4 => self.quads::<S, 4>(simd, rest, rows, buffers),
                        _ => self.quads::<S, 0>(simd, rest, rows, buffers),
                    };
                }
                if !is_drawn {
                    let new = || ActiveEdges::new(self.setup.frame, varyings);
                    let active = active.get_or_insert_with(new);
                    for listed in &rest[..taken] {
                        let queue = &mut buffers.queue;
                        queue.add_polygon(&self.setup, active, listed.number, rows);
                    }
                }
            }
            rest = &rest[taken..];
            if buffers.queue.is_full() {
                self.draw_runs(simd, buffers);
            }
        }
        self.draw_runs(simd, buffers);
    }

    /// Draws triangles from the front of `polygons`, and returns their number.
    #[inline(never)]
    fn triangles<S: Token, const N: usize>(
        &self,
        simd: S,
        polygons: &[Listed],
        rows: &Range<usize>,
        buffers: &mut Buffers,
    ) -> usize {
        let (taken, tiny, others) = find(simd, self.setup.frame, polygons, rows, buffers);
        vectorize(
            simd,
            #[inline(always)]
            || {
                let (m, top) = (Lanes(simd), rows.start);
                let (batch, fragments) = (&mut buffers.batch, &buffers.fragments);
                let all = tiny | others;
                batch.set_up_planes::<S, N>(m, &self.setup, (self.cell, self.test), all);
                let writer = &mut buffers.tile.writer::<S, N>(m, self.test);
                for k in bits(all) {
                    if others >> k & 1 == 0 {
                        fragments.draw(m, batch, k, writer);
                    } else if batch.path[k] == CoveragePath::Small as i32 {
                        SmallTriangle::new(m, batch, k).draw(&mut buffers.starts, top, writer);
                    } else {
                        runs::draw_large(m, (batch, k), top, writer);
                    }
                }
            },
        );
        taken
    }

    /// Draws quadrangles from the front of `polygons`, and returns their number and true; or, if the first one is not of those that
    /// [`QuadBatch`] draws, the number of the polygons that runs must draw, and false.
    #[inline(never)]
    fn quads<S: Token, const N: usize>(
        &self,
        simd: S,
        polygons: &[Listed],
        rows: &Range<usize>,
        buffers: &mut Buffers,
    ) -> (usize, bool) {
        let (frame, count) = (self.setup.frame, NumberCount::<N>(self.cell.count()));
        let taken = buffers.quads.gather(frame, polygons);
        vectorize(
            simd,
            #[inline(always)]
            || {
                let (m, width) = (Lanes(simd), frame.width());
                let bounded = buffers.quads.bound(m, width, rows);
                let others = bounded.others;
                if others & 1 == 1 {
                    return (others.trailing_ones() as usize, false);
                }
                // Quadrangles are drawn at once: runs from before them come first.
                self.draw_runs(simd, buffers);
                let taken = taken.min(others.trailing_zeros() as usize);
                let drawn = bounded.drawn & ((1 << taken) - 1);
                let Buffers { quads, tile, .. } = buffers;
                quads.read::<N>(&self.setup, (self.cell, self.test), drawn);
                quads.find_runs(m, &bounded, (width, rows), count);
                tile.extend(bounded.blocks());
                let writer = &mut tile.writer::<S, N>(m, self.test);
                for k in bits(drawn) {
                    quads.draw(m, k, rows.start, writer);
                }
                (taken, true)
            },
        )
    }

    /// Draws the runs that were found.
    #[inline(never)]
    fn draw_runs<S: Token>(&self, simd: S, buffers: &mut Buffers) {
        let Buffers { tile, queue, .. } = buffers;
        if queue.is_empty() {
            return;
        }
        queue.extend(tile);
        vectorize(
            simd,
            #[inline(always)]
            || {
                let m = Lanes(simd);
                let writer = tile.writer(m, self.test);
                queue.draw(m, &self.setup, self.walk, self.cell, writer);
            },
        );
    }
}

/// Gathers triangles from the front of `polygons` and finds their places in a tile. Returns their number, bits for the tiny ones
/// that cover a pixel, and bits for those that are not tiny.
#[inline(never)]
fn find<S: Token>(
    simd: S,
    frame: &Frame,
    polygons: &[Listed],
    rows: &Range<usize>,
    buffers: &mut Buffers,
) -> (usize, u32, u32) {
    let Buffers { tile, batch, .. } = buffers;
    vectorize(
        simd,
        #[inline(always)]
        || {
            let m = Lanes(simd);
            let taken = batch.gather(frame, polygons);
            let (blocks, others) = batch.set_up(m, frame.width(), rows);
            tile.extend(blocks);
            let tiny = buffers.fragments.find(m, batch, rows.start, tile);
            (taken, tiny, others)
        },
    )
}

#[cfg(test)]
mod tests;
