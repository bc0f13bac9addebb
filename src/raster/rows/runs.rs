//! The run path: large triangles, polygons of any shape, and methods whose pixels are recurrences, all by runs of pixels on a
//! scanline.

use super::tile::{Tile, Writer};
use super::triangles::{Batch, LINE};
use crate::frame::SubPixel;
use crate::number::lanes::Lanes;
use crate::number::simd::BLOCK;
use crate::raster::setup::SetUp;
use crate::raster::spans::active::{ActiveEdges, Span};
use crate::raster::spans::edge::{Crossing, first_centre};
use crate::raster::spans::edge_table::{TableEdge, for_each_edge};
use crate::shading::{Pixels, Run, start_len};
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::{Simd, f32x8, i32x8};

/// Where a run lies: its row in the tile, its pixels, depth at the first one and its growth.
#[derive(Clone, Debug)]
struct Place {
    row: usize,
    pixels: Range<usize>,
    depth: [f32; 2],
}

/// Runs that wait to be walked along, all of them by one call.
#[derive(Debug, Default)]
pub(crate) struct RunQueue {
    places: Vec<Place>,
    runs: Vec<Run>,
    /// What each run starts from: see [`start_len`].
    starts: Vec<f32>,
    /// What the walks give.
    walked: Vec<f32>,
    /// Blocks of all runs.
    blocks: usize,
    /// The edges of a polygon that are still to come.
    edges: Vec<(i32, TableEdge)>,
}

/// As many blocks are walked along by one call: what they give stays in the first cache.
const MOST_BLOCKS: usize = 128;

/// The walk of a method along runs.
pub(super) type WalkKernel = fn(&Pixels<'_>, &mut [f32]);

impl RunQueue {
    /// Adds a run, which has its numbers at the end of `starts` already.
    fn push(&mut self, uniforms: u32, place: Place) {
        self.blocks += place.pixels.len().div_ceil(BLOCK);
        self.runs.push(Run {
            uniforms,
            x: place.pixels.start as u32,
            pixels: place.pixels.len() as u32,
        });
        self.places.push(place);
    }

    /// True if the runs are enough to be drawn.
    pub fn is_full(&self) -> bool {
        self.blocks >= MOST_BLOCKS
    }

    fn clear(&mut self) {
        self.places.clear();
        self.runs.clear();
        self.starts.clear();
        self.blocks = 0;
    }

    /// Returns what adds runs of triangle `k` of a batch, for a method that is walked along: its varyings are linear over it, and
    /// `across` is how much its barycentric coordinates grow from pixel to pixel.
    #[inline(always)]
    pub fn triangle<'a, S: Simd>(
        &'a mut self,
        m: Lanes<S>,
        setup: &SetUp<'_>,
        batch: &'a Batch,
        k: usize,
        across: [f32; 2],
    ) -> TriangleRuns<'a, S> {
        let count = setup.varyings.count;
        TriangleRuns {
            m,
            batch,
            k,
            count,
            step: batch.planes.growth(m, k, 1 + count, across),
            uniforms: setup.uniforms_of(batch.listed[k].number),
            queue: self,
        }
    }

    /// Adds the runs of polygon `number`, of any shape: its edges step what they carry from row to row.
    pub fn add_polygon(
        &mut self,
        setup: &SetUp<'_>,
        active: &mut ActiveEdges<'_>,
        number: u32,
        rows: &Range<usize>,
    ) {
        let frame = setup.frame;
        let (uniforms, width) = (setup.uniforms_of(number), frame.width() as u32);
        self.edges.clear();
        let mut edges = core::mem::take(&mut self.edges);
        for_each_edge(
            frame,
            rows.start as i32..rows.end as i32,
            number,
            |row, edge| {
                edges.push((row, edge));
            },
        );
        edges.sort_by_key(|(row, _)| *row);
        let mut next = 0;
        let mut row = edges.first().map_or(rows.end as i32, |(row, _)| *row);
        while row < rows.end as i32 {
            let begin = edges[next..].iter().take_while(|(first, _)| *first == row);
            let new = next..next + begin.count();
            next = new.end;
            active.next(edges[new].iter().map(|(_, edge)| edge), row);
            if active.is_empty() && next == edges.len() {
                break;
            }
            active.spans(width, |active, span: Span| {
                active.start(&span, 0, &mut self.starts);
                let place = Place {
                    row: row as usize - rows.start,
                    pixels: span.start as usize..span.end as usize,
                    depth: [span.depth, span.depth_step],
                };
                self.push(uniforms, place);
            });
            row += 1;
        }
        active.clear();
        self.edges = edges;
    }

    /// True if no run waits.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Says which blocks of a tile the runs may draw.
    pub fn extend(&self, tile: &mut Tile) {
        for Place { pixels, .. } in &self.places {
            tile.extend(pixels.start / BLOCK..pixels.end.div_ceil(BLOCK));
        }
    }

    /// Walks along the runs, if the method has a walk: `planes` numbers a pixel.
    pub fn walk(&mut self, setup: &SetUp<'_>, walk: Option<WalkKernel>, planes: usize) {
        let Some(walk) = walk else { return };
        let room = self.blocks * BLOCK * planes;
        // A block before and after: what is loaded from there is not written.
        self.walked
            .resize(self.walked.len().max(room + 2 * BLOCK), 0.0);
        let job = Pixels {
            parameters: setup.parameters,
            uniforms: &setup.uniforms,
            extras: setup.extras,
            runs: &self.runs,
            starts: &self.starts,
        };
        walk(&job, &mut self.walked[BLOCK..BLOCK + room]);
    }

    /// Draws the runs, in order. Their pixels are what was walked, or the varyings themselves.
    #[inline(always)]
    pub fn draw<S: Simd>(
        &mut self,
        m: Lanes<S>,
        setup: &SetUp<'_>,
        is_walked: bool,
        planes: usize,
        writer: &mut Writer<'_, S, 0>,
    ) {
        let len = start_len(setup.varyings.great_circle, setup.varyings.count);
        let mut walked = BLOCK;
        for (i, place) in self.places.iter().enumerate() {
            let material = m.splat(self.runs[i].uniforms as f32);
            if is_walked {
                let length = place.pixels.len().next_multiple_of(BLOCK);
                let from = &self.walked[walked - BLOCK..walked + length * planes + BLOCK];
                draw_run(
                    m,
                    place,
                    writer,
                    #[inline(always)]
                    |number, x| match number - 1 {
                        plane if plane < planes => {
                            m.load(&from[(BLOCK as isize + x) as usize + plane * length..])
                        }
                        _ => material,
                    },
                );
                walked += length * planes;
            } else {
                let (at, step) = self.starts[i * len..][..len].split_at(planes);
                draw_run(
                    m,
                    place,
                    writer,
                    #[inline(always)]
                    |number, x| match number - 1 {
                        plane if plane < planes => {
                            m.ramp(at[plane] + x as f32 * step[plane], step[plane])
                        }
                        _ => material,
                    },
                );
            }
        }
        self.clear();
    }
}

/// Adds the runs of a triangle to a queue.
pub(super) struct TriangleRuns<'a, S> {
    m: Lanes<S>,
    queue: &'a mut RunQueue,
    batch: &'a Batch,
    k: usize,
    count: usize,
    /// Growth of depth and varyings from pixel to pixel.
    step: [f32; LINE],
    uniforms: u32,
}

impl<S: Simd> TriangleRuns<'_, S> {
    /// Adds a run, with the barycentric coordinates of the second and the third corner at its first pixel.
    #[inline(always)]
    pub fn add(&mut self, row: usize, pixels: Range<usize>, weights: [f32; 2]) {
        let Self { m, k, count, .. } = *self;
        let at = self.batch.planes.at(m, k, 1 + count, weights);
        let starts = &mut self.queue.starts;
        // Whole lines: what is past the last number is cut off.
        let first = starts.len();
        starts.extend_from_slice(&at[1..]);
        starts.truncate(first + count);
        starts.extend_from_slice(&self.step[1..]);
        starts.truncate(first + 2 * count);
        let depth = [at[0], self.step[0]];
        self.queue.push(self.uniforms, Place { row, pixels, depth });
    }
}

/// Draws a run; `number` gives each number but depth, at the block that begins `x` pixels after the run's first one.
#[inline(always)]
fn draw_run<S: Simd, const N: usize>(
    m: Lanes<S>,
    place: &Place,
    writer: &mut Writer<'_, S, N>,
    number: impl Fn(usize, isize) -> f32x8<S>,
) {
    let Place { row, pixels, depth } = place;
    for block in pixels.start / BLOCK..pixels.end.div_ceil(BLOCK) {
        let x = (block * BLOCK) as isize - pixels.start as isize;
        writer.put(
            (row * writer.blocks + block) * writer.stride(),
            outside(m, block, pixels),
            m.ramp(depth[0] + x as f32 * depth[1], depth[1]),
            #[inline(always)]
            |i| number(i, x),
        );
    }
}

/// Draws large triangle `k` of a batch into the tile that begins with row `top`.
#[inline(always)]
pub(super) fn draw_large<S: Simd, const N: usize>(
    m: Lanes<S>,
    batch: &Batch,
    k: usize,
    top: usize,
    writer: &mut Writer<'_, S, N>,
) {
    let Some(triangle) = Triangle::of(batch, k) else {
        return;
    };
    let count = writer.count.get();
    let step: [f32; LINE] = batch.planes.growth(m, k, count, triangle.across());
    triangle.runs(
        top,
        #[inline(always)]
        |row, pixels, weights| {
            let at = batch.planes.at(m, k, count, weights);
            let place = Place {
                row,
                pixels,
                depth: [at[0], step[0]],
            };
            draw_run(
                m,
                &place,
                writer,
                #[inline(always)]
                |i, x| m.ramp(at[i] + x as f32 * step[i], step[i]),
            );
        },
    );
}

/// Returns a number below 0 at those pixels of block `block` that a run does not have.
#[inline(always)]
fn outside<S: Simd>(m: Lanes<S>, block: usize, pixels: &Range<usize>) -> i32x8<S> {
    let (first, k) = ((block * BLOCK) as i32, m.counted());
    (k - m.int(pixels.start as i32 - first)) | (m.int(pixels.end as i32 - 1 - first) - k)
}

/// A triangle of any size, by the crossings of its edges with the scanlines.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    columns: Range<i32>,
    rows: Range<i32>,
    x: [i32; 3],
    y: [i32; 3],
    /// One over twice its area, below 0 where its corners run the other way around.
    over_area: f32,
}

impl Triangle {
    /// Returns triangle `k` of a batch, if it has an area.
    pub fn of(batch: &Batch, k: usize) -> Option<Triangle> {
        let (x, y) = (
            [0, 1, 2].map(|i| batch.x[i][k]),
            [0, 1, 2].map(|i| batch.y[i][k]),
        );
        let ([xa, xb, xc], [ya, yb, yc]) = (x, y);
        let wide = i64::from;
        let area = wide(xb - xa) * wide(yc - ya) - wide(xc - xa) * wide(yb - ya);
        (area != 0).then_some(Triangle {
            columns: batch.columns[0][k]..batch.columns[1][k],
            rows: batch.rows[0][k]..batch.rows[1][k],
            x,
            y,
            over_area: 1.0 / area as f32,
        })
    }

    /// Returns how much the barycentric coordinates of the second and the third corner grow from pixel to pixel.
    #[inline(always)]
    pub fn across(&self) -> [f32; 2] {
        let (y, scale) = (&self.y, 256.0 * self.over_area);
        [(y[2] - y[0]) as f32 * scale, (y[0] - y[1]) as f32 * scale]
    }

    /// Gives its runs: the row in the tile that begins with row `top`, the pixels, and the barycentric coordinates of the second and
    /// the third corner at the first of them.
    #[inline(always)]
    pub fn runs(&self, top: usize, mut visit: impl FnMut(usize, Range<usize>, [f32; 2])) {
        let Triangle {
            x,
            y,
            columns,
            rows,
            ..
        } = self;
        // From the top corner two edges go down; the third one follows one of them.
        let mut order = [0usize, 1, 2];
        order.sort_unstable_by_key(|&i| y[i]);
        let [above, middle, below] = order.map(|i| [x[i], y[i]].map(SubPixel::from_bits));
        let bend = first_centre(middle[1]).clamp(rows.start, rows.end);
        let mut long = Crossing::new(above, below, rows.start);
        let function = |i: usize, j: usize, column: i32, row: i32| {
            let wide = i64::from;
            let (px, py) = (256 * wide(column) + 128, 256 * wide(row) + 128);
            wide(x[j] - x[i]) * (py - wide(y[i])) - wide(y[j] - y[i]) * (px - wide(x[i]))
        };
        for (from, to, rows) in [
            (above, middle, rows.start..bend),
            (middle, below, bend..rows.end),
        ] {
            if rows.is_empty() {
                continue;
            }
            let mut short = Crossing::new(from, to, rows.start);
            for row in rows {
                let (p, q) = (long.pixel(), short.pixel());
                let (start, end) = (p.min(q).max(columns.start), p.max(q).min(columns.end));
                if start < end {
                    let weight =
                        |i: usize, j: usize| function(i, j, start, row) as f32 * self.over_area;
                    let pixels = start as usize..end as usize;
                    visit(row as usize - top, pixels, [weight(2, 0), weight(0, 1)]);
                }
                long.advance();
                short.advance();
            }
        }
    }
}
