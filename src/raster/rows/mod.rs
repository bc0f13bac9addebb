//! The row engine: a deferred renderer on SIMD.
//!
//! ```text
//! bin ───────► set up ────────► rasterise ──────────────► G-buffer ─► shade ─► picture
//! ../bins.rs   triangles.rs     tiny.rs   pixel by pixel  tile.rs     shade.rs
//!              8 triangles in   small.rs  block by block  16 rows     one call per row,
//!              the lanes        quads.rs  row by row      of blocks   as long as the material stays
//!                               runs.rs   run by run
//! ```
//!
//! Polygons are binned into bands of 16 scanlines. The polygons of a band are set up in batches and
//! rasterised in drawing order, with a depth test, into a tile: the band's G-buffer. A pixel of the
//! tile holds depth, material, and the method's varyings or the values that its walk returns. Then
//! `shade_blocks` in `shading/kernels/mod.rs` shades each row once. So the shading cost per pixel
//! does not depend on the size of triangles, and hidden pixels are never shaded. Bands are
//! independent: each is one job for a thread.
//!
//! Where each polygon has one colour, that colour is the only varying, packed as the picture stores
//! it (`packed.rs`).
//!
//! Three coverage paths find the same pixels:
//!
//! - *tiny* triangles are tested pixel by pixel, eight triangles at a time;
//! - *small* triangles are tested by edge functions, eight pixels at a time;
//! - everything else is drawn by *runs*. Large triangles and slivers find their runs by the
//!   crossings of their edges. Runs of other polygons, and of methods with more than `MOST` values
//!   per pixel, come from the active edges of the span engine. Small convex quadrangles find them
//!   eight quadrangles at a time, with the same result to the bit.
//!
//! Some methods remember the pixel before, as the slerp methods and fast Phong with a fixed count
//! of Newton's steps. Their walk kernels take many runs at a time.
//!
//! Who calls whom, for one frame:
//!
//! ```text
//! draw                 once        sets the method up and bins; its caller sends bands to a picture or streams them row by row
//!   each_band          once        runs the closure below for every band, on the threads of the pool (../bands.rs)
//!     fill_tile        a band      works in this thread's buffers
//!       rasterise      a band      is compiled for an instruction set (`with_level!`); goes through the band's polygons in order
//!         triangles    a batch     set-up, coverage and plane equations of up to 32 triangles
//!         quads        a batch     set-up and runs of up to 8 convex quadrangles
//!         add_polygon  a polygon   finds the runs of any other polygon and queues them
//!         draw_runs    a queue     walks along the runs and writes them into the tile
//!     shade            a row       calls the method's kernel, stretch by stretch
//! ```
//!
//! A method appears here as its [`Kernels`](crate::shading::Kernels), which are called for a
//! stretch of a row or a batch of runs. So this engine is compiled once per instruction set, and
//! not once per method.

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
use super::spans::NO_POLYGON;
use super::spans::active::ActiveEdges;
use crate::frame::row_tiles::TILE_HEIGHT as HEIGHT;
use crate::frame::{Frame, Polygon};
use crate::number::SimdLevel;
use crate::number::lanes::Lanes;
use crate::number::parallel::for_each_chunk;
use crate::number::simd::{BLOCK, Token, vectorize};
use crate::picture::Picture;
use crate::picture::encoding::quantise;
use crate::shading::light::Uniforms;
use crate::shading::{CellLayout, ShadingRate, SimdKernels, UniformsIndex, Variant, WalkKernel};
use alloc::borrow::Cow;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::cell::Cell;
use core::ops::Range;
use quads::QuadBatch;
use runs::RunQueue;
use shade::RowBuffers;
use small::{RowStarts, SmallTriangle};
use tile::{MOST, Tile, ValueCount};
use tiny::Fragments;
use triangles::{Batch, CoveragePath, bits};

/// Evaluates an expression in which a name stands for the [`Token`] of an instruction set.
macro_rules! with_level {
    ($level:expr, $token:ident => $work:expr) => {
        match $level {
            #[cfg(target_arch = "x86_64")]
            $crate::number::SimdLevel::Avx2 => {
                type $token = fearless_simd::Avx2;
                $work
            }
            #[cfg(target_arch = "x86_64")]
            $crate::number::SimdLevel::Avx512 => {
                type $token = fearless_simd::Avx512;
                $work
            }
            #[cfg(target_arch = "aarch64")]
            $crate::number::SimdLevel::Neon => {
                type $token = fearless_simd::Neon;
                $work
            }
            level => unreachable!("the method has loops for {level:?}"),
        }
    };
}
use with_level;

/// The buffers that a thread keeps from tile to tile and from frame to frame.
#[derive(Debug, Default)]
struct Buffers {
    tile: Tile,
    /// The depths of the tile's pixels, where another engine finds them.
    depths: Tile,
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
    static BUFFERS: Cell<Option<Box<Buffers>>> = const { Cell::new(None) };
}

/// Lends this thread's buffers to `work`. They are taken out meanwhile: a shader that draws inside
/// finds none and makes others, and after a panic none are left that hold half a tile.
fn with_buffers<T>(work: impl FnOnce(&mut Buffers) -> T) -> T {
    let mut buffers = BUFFERS.take().unwrap_or_default();
    let result = work(&mut buffers);
    BUFFERS.set(Some(buffers));
    result
}

/// A method on a frame, and the layout of its pixels.
struct RowEngine<'a> {
    level: SimdLevel,
    setup: SetUp<'a>,
    kernels: &'a SimdKernels,
    /// The kernel that walks along runs, if the method remembers the pixel before.
    walk: Option<WalkKernel>,
    /// True if triangles are drawn by plane equations. Else they are drawn by runs, like all other
    /// polygons.
    is_planar: bool,
    test: SampleDepth,
    cell: CellLayout,
    /// The uniforms that all pixels can be shaded with, if one set will do.
    only: Option<UniformsIndex>,
    /// True if a polygon's packed colour is the only varying: see `packed.rs`.
    is_packed: bool,
    /// Finds the depths that are compared with the caller's and stored there, if this engine draws
    /// triangles by runs. Depths of runs are rounded otherwise than those of planes, and a second
    /// pass by another method must find its own.
    depths: Option<Box<RowEngine<'a>>>,
    background: [u8; 4],
}

/// Draws a method on a frame, tile by tile. `is_levels` says that the picture stores levels of
/// linear intensity, `has_depth` that there is a caller's depth buffer.
pub(super) fn draw(
    variant: &Variant,
    frame: &Frame,
    level: SimdLevel,
    is_levels: bool,
    has_depth: bool,
    each_band: &mut EachBand<'_>,
) {
    // Supersampled pixels are averaged as linear floats and become levels later.
    let is_levels = is_levels && frame.samples() == 1;
    let scale = if is_levels {
        let row = variant.row().on(frame);
        row.kernels(frame.light_count(), frame.is_local())
            .scale_of_bytes()
    } else {
        1.0
    };
    let [memory, packed] =
        with_buffers(|buffers| [&mut buffers.varyings, &mut buffers.packed].map(core::mem::take));
    let Some(mut rows) = RowEngine::new(variant, frame, level, scale, memory) else {
        unreachable!("`Variant::plan` chooses the span engine where a method has no loops");
    };
    if has_depth && !rows.is_planar {
        rows.depths = Some(Box::new(RowEngine::of_depths(frame, level)));
    }
    let kept = if is_levels { rows.pack(packed) } else { packed };
    let bins = Bins::new(frame, HEIGHT);
    each_band(HEIGHT, &|index, band, target| {
        with_buffers(|buffers| {
            rows.fill_tile(&bins, index, &band, buffers);
            for row in 0..band.len() {
                rows.shade(row, buffers, target);
            }
        });
    });
    if let Cow::Owned(values) = rows.setup.varyings.values {
        let (varyings, packed) = if rows.is_packed {
            (kept, values)
        } else {
            (values, kept)
        };
        with_buffers(|buffers| (buffers.varyings, buffers.packed) = (varyings, packed));
    }
}

/// The depths that every method of the row engine stores in a caller's buffer.
pub(super) struct RowDepths<'a>(RowEngine<'a>);

impl<'a> RowDepths<'a> {
    pub fn new(frame: &'a Frame, level: SimdLevel) -> Self {
        RowDepths(RowEngine::of_depths(frame, level))
    }

    /// Returns the depth of a polygon at pixels of scanline `row` that it covers.
    pub fn at<const N: usize>(&self, polygon: u32, row: usize, pixels: [usize; N]) -> [f32; N] {
        let frame = self.0.setup.frame;
        let top = row / HEIGHT * HEIGHT;
        let band = top..(top + HEIGHT).min(frame.height());
        let polygons = [Listed::new(frame, polygon)];
        with_buffers(|buffers| {
            buffers.tile.prepare(HEIGHT, frame.width(), self.0.cell);
            buffers.queue.prepare(0);
            with_level!(self.0.level, S => self.0.rasterise::<S>(&polygons, &band, buffers));
            let tile = &mut buffers.tile;
            let depths = pixels.map(|x| tile.depth(row - top, x));
            (0..band.len()).for_each(|row| tile.clear_row(row));
            depths
        })
    }
}

/// Returns the index of the polygon that is seen at each sample where a method is drawn, or
/// [`NO_POLYGON`].
///
/// Coverage paths and instruction sets round depth differently, so of two polygons at nearly equal
/// depth they may show different ones. The tiles are therefore filled by the method's own loops,
/// with polygon indices in place of varyings.
pub(super) fn polygon_indices(variant: &Variant, frame: &Frame, level: SimdLevel) -> Picture<u32> {
    let mut picture = Picture::new(frame.width(), frame.height(), NO_POLYGON);
    let Some(rows) = RowEngine::new(variant, frame, level, 1.0, Vec::new()) else {
        unreachable!("`Variant::plan` chooses the span engine where a method has no loops");
    };
    let rows = rows.showing_indices();
    let bins = Bins::new(frame, HEIGHT);
    let a_band = HEIGHT * frame.width();
    for_each_chunk(
        picture.pixels_mut(),
        a_band,
        &|start, pixels: &mut [u32]| {
            let index = start / a_band;
            let band = index * HEIGHT..((index + 1) * HEIGHT).min(frame.height());
            with_buffers(|buffers| {
                rows.fill_tile(&bins, index, &band, buffers);
                for (row, to) in pixels.chunks_exact_mut(frame.width()).enumerate() {
                    rows.take_indices(row, &mut buffers.tile, to);
                }
            });
        },
    );
    picture
}

/// Returns the index of uniforms that all pixels can be shaded with, if there are any. One set will
/// do if the method reads only the scale at a pixel, or if all polygons have equal uniforms. A
/// scene's objects bring their own materials, which are often equal.
fn only_uniforms(setup: &SetUp<'_>, shading_rate: ShadingRate) -> Option<UniformsIndex> {
    let (frame, polygons) = (setup.frame, setup.frame.polygons());
    // A frame without polygons may have no material either.
    let first = polygons.first()?.material;
    if shading_rate != ShadingRate::Pixel {
        // If any material is too bright for the fast path, its uniforms are chosen for all: then
        // colours are clamped, whichever material they belong to.
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
    /// Sets up a method on a frame, with the parameters of [`SetUp::new`]. Returns `None` if the
    /// method has no loops for the instruction set.
    fn new(
        variant: &'a Variant,
        frame: &'a Frame,
        level: SimdLevel,
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
        let only = only_uniforms(&setup, variant.row().needs.shading_rate);
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
            depths: None,
            only,
            background: [r, g, b, 0],
            kernels,
            walk,
            setup,
        })
    }

    /// Makes an engine that finds depths as methods do that draw triangles by plane equations.
    fn of_depths(frame: &'a Frame, level: SimdLevel) -> RowEngine<'a> {
        let setup = SetUp::of_depths(frame);
        let kernels = (setup.kernels.simd)(level);
        RowEngine {
            level,
            kernels: kernels.expect("flat shading has loops for each instruction set"),
            setup,
            walk: None,
            is_planar: true,
            test: SampleDepth::new(frame),
            cell: CellLayout::default(),
            is_packed: false,
            depths: None,
            only: None,
            background: [0; 4],
        }
    }

    /// Changes the engine so that pixels hold the index of their polygon in place of varyings and
    /// material. Coverage paths and depths do not change.
    fn showing_indices(mut self) -> Self {
        self.setup.varyings = Varyings::none();
        self.setup.is_by_polygon = true;
        self.cell = CellLayout {
            has_uniforms: true,
            ..CellLayout::default()
        };
        (self.only, self.walk) = (None, None);
        self
    }

    /// Moves the polygon indices of row `row` out of a tile, and empties the row. The engine must
    /// be [showing indices](Self::showing_indices).
    fn take_indices(&self, row: usize, tile: &mut Tile, to: &mut [u32]) {
        let blocks = tile.drawn();
        let cells = tile.row(row, blocks.clone());
        let to = to.get_mut(blocks.start * BLOCK..).unwrap_or_default();
        let blocks = cells.chunks_exact(tile.stride());
        for (to, block) in to.chunks_mut(BLOCK).zip(blocks) {
            for (x, to) in to.iter_mut().enumerate() {
                if block[BLOCK * CellLayout::DEPTH + x] < f32::INFINITY {
                    let index = block[BLOCK * tile.cell.uniforms() + x];
                    *to = CellLayout::uniforms_of(index).0;
                }
            }
        }
        tile.clear_row(row);
    }

    /// Prepares an empty tile and rasterises all polygons of a band into it.
    fn fill_tile(&self, bins: &Bins, index: usize, band: &Range<usize>, buffers: &mut Buffers) {
        if let Some(depths) = &self.depths {
            core::mem::swap(&mut buffers.tile, &mut buffers.depths);
            depths.fill_tile(bins, index, band, buffers);
            core::mem::swap(&mut buffers.tile, &mut buffers.depths);
        }
        let width = self.setup.frame.width();
        buffers.tile.prepare(HEIGHT, width, self.cell);
        buffers.queue.prepare(self.setup.varyings.count);
        for polygons in bins.band(index) {
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
                // Triangles are drawn immediately. So runs that wait in the queue are drawn before
                // them, to keep the drawing order.
                self.draw_runs(simd, buffers);
                // Compiled separately for the value counts that most methods have on most scenes.
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
                        queue.add_polygon(&self.setup, active, listed.index, rows);
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

    /// Draws triangles from the front of `polygons`, and returns how many it took.
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
                batch.set_up_planes::<S, N>(m, &self.setup, self.cell, self.test, all);
                let writer = &mut buffers.tile.writer::<S, N>(m, self.test);
                // Triangles are drawn in order, whichever path each takes: equal depths must not
                // change places.
                for k in bits(all) {
                    if others >> k & 1 == 0 {
                        fragments.draw(m, batch, k, writer);
                    } else if batch.path[k] == CoveragePath::Small as i32 {
                        SmallTriangle::new(m, batch, k).draw(&mut buffers.starts, top, writer);
                    } else {
                        runs::draw_large(m, batch, k, top, writer);
                    }
                }
            },
        );
        taken
    }

    /// Draws quadrangles from the front of `polygons`. Returns how many it drew, and true. If
    /// [`QuadBatch`] cannot draw the first one, returns how many polygons the run path must draw,
    /// and false.
    #[inline(never)]
    fn quads<S: Token, const N: usize>(
        &self,
        simd: S,
        polygons: &[Listed],
        rows: &Range<usize>,
        buffers: &mut Buffers,
    ) -> (usize, bool) {
        let (frame, count) = (self.setup.frame, ValueCount::<N>(self.cell.count()));
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
                // Quadrangles are drawn immediately. So runs that wait in the queue are drawn
                // before them, to keep the drawing order.
                self.draw_runs(simd, buffers);
                // The batch ends at the first quadrangle that the run path must draw.
                let taken = taken.min(others.trailing_zeros() as usize);
                let drawn = bounded.drawn & ((1 << taken) - 1);
                let Buffers { quads, tile, .. } = buffers;
                quads.read::<N>(&self.setup, self.cell, self.test, drawn);
                quads.find_runs(m, &bounded, width, rows, count);
                tile.extend(bounded.blocks());
                let writer = &mut tile.writer::<S, N>(m, self.test);
                for k in bits(drawn) {
                    quads.draw(m, k, rows.start, writer);
                }
                (taken, true)
            },
        )
    }

    /// Draws the runs that wait in the queue.
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

/// Gathers triangles from the front of `polygons` and finds their pixels in a tile. Returns how
/// many it took, a bit for each tiny triangle that covers a pixel, and a bit for each triangle that
/// is not tiny.
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
