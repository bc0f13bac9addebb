//! The row engine: bands of scanlines, shaded row by row.
//!
//! A band's polygons are drawn one after the other: where one is nearer than what was drawn before, what its walk gives to the
//! pixel ([`Shader::Pixel`]) is written into planes beside the depth. Then each row is shaded once, two groups of pixels at a
//! time, over the row and not over the span: shading costs the same for a pixel in a triangle of two pixels as in one of a
//! thousand, and hidden pixels are never shaded.
//!
//! Bands are independent of one another: one is one unit of work for a thread.
//!
//! Tried and dropped (5,040 triangles at 1920x1080, `phong-rsqrt` and `naive-phong`, AVX2, one thread, least of 30 frames or more,
//! on a machine that varies by more than small differences): finding the runs of all triangles first, scanline by scanline,
//! and drawing them into planes of a single row, 3.9 ms against 3.2 to 3.8; choosing pixels by a select, with all
//! loads before the first store, 4.3 against 3.2, or by `vblendvps` itself: the compiler makes masked stores of both, and bytes are
//! chosen instead; storing some of the background with each two groups that are shaded, as storing it at once waits for memory: 2.0 and
//! 2.0 ms. `docs/performance.md` has the rest.

mod band;
mod batch;
mod facets;
mod fill;
mod paint;
mod place;
mod polygon;
mod read;
mod shade;
mod small;
mod tiny;
mod triangle;

use super::bands::{Bands, Scratch};
use super::bins::{Bins, Listed};
use super::depth::SampleDepth;
use super::setup::SetUp;
use super::sink::RowSink;
use crate::frame::Frame;
use crate::number::{Lanes, Machine, Pair, Planes, Scalar};
use crate::shader::{Given, Shader};
use crate::walk::Attribute;
pub(crate) use band::Band;
use band::Layout;
pub(crate) use batch::Batch;
use core::ops::Range;
use fill::Filler;
use paint::Painter;
use read::Numbers;
use shade::{Colours, Constants};
pub(crate) use tiny::Fragments;
pub(crate) use triangle::Starts;

/// Scanlines a band: edges are seldom started anew, and every thread gets some.
const HEIGHT: usize = 16;

/// The constants of a shader's material, for two groups at a time.
type Consts<S, M> = <S as Shader>::Consts<Pair<<M as Machine>::F>>;

/// What fills triangles with a shader's numbers.
type FillerOf<'a, S> = Filler<'a, <S as Shader>::Attribute<f32>, <S as Shader>::Polygon<f32>>;

/// Returns why the engine cannot draw `frame` with shader `S`; `None` where it can.
pub(crate) fn refusal<S: Shader, M: Lanes>(frame: &Frame) -> Option<&'static str> {
    let depth = SampleDepth::new(frame);
    if !depth.is_interpolated() {
        Some("the row engine interpolates depth and does not compute it per sample")
    } else if depth.is_cut_by_cube() {
        Some("the row engine does not test samples against the NDC cube")
    } else if paint::planes::<S, M>().is_none() {
        Some("the row engine cannot keep what this method follows along a span")
    } else {
        None
    }
}

/// Draws `frame` with a shader, band by band.
pub(crate) fn draw<S: Shader, M: Lanes>(
    m: M,
    frame: &Frame,
    parameters: &[u32],
    bands: &mut dyn Bands,
) {
    // A constant of its own: what comes after is then not even compiled for shaders that have no planes.
    if const { paint::planes::<S, M>().is_none() } {
        return;
    }
    let bins = Bins::new(frame, HEIGHT);
    // Only polygons of other shapes need attributes where normals are read as they are.
    let normals = if S::ATTRIBUTE_IS_NORMAL && bins.are_triangles() {
        frame.normals_on_screen()
    } else {
        None
    };
    let setup = match normals {
        Some(_) => SetUp::<S, Scalar>::without_attributes(Scalar, frame, parameters),
        None => SetUp::new(Scalar, frame, parameters),
    };
    let numbers = match normals {
        _ if S::GIVEN == Given::Polygon => Numbers::Polygons(&setup.polygons),
        Some(normals) => Numbers::Normals(normals),
        None => Numbers::Attributes(&setup.attributes),
    };
    let only = only_material(frame);
    let consts = Constants::<S, M>::new(m, frame, parameters, only);
    let (depth, has_materials) = (SampleDepth::new(frame), only.is_none());
    let painter = Painter::<S> {
        frame,
        setup: &setup,
        depth,
    };
    let filler = Filler {
        frame,
        numbers,
        depth,
        has_materials,
    };
    bands.each(HEIGHT, &|number, rows, scratch, sink| {
        scratch
            .band
            .prepare::<M, S::Pixel<M::F>>(HEIGHT, frame.width(), has_materials);
        for polygons in bins.band(number) {
            paint::<S, M>(m, (&painter, &filler), polygons, &rows, scratch);
        }
        for row in 0..rows.len() {
            shade::<S, M>(m, frame, &consts, row, scratch, sink);
        }
    });
}

/// Draws polygons into a band, in order.
fn paint<S: Shader, M: Lanes>(
    m: M,
    (painter, filler): (&Painter<'_, S>, &FillerOf<'_, S>),
    polygons: &[Listed],
    rows: &Range<usize>,
    scratch: &mut Scratch,
) {
    let mut edges = polygon::Edges::default();
    let mut rest = polygons;
    while let Some((next, others)) = rest.split_first() {
        if const { <S::Attribute<f32> as Attribute<f32>>::IS_PLANAR } && next.is_triangle() {
            let taken = triangles::<S, M>(m, (painter, filler), rest, rows, scratch);
            rest = &rest[taken..];
            continue;
        }
        let next = next.number;
        let material = painter.frame.polygons()[next as usize].material;
        edges.runs(
            painter.frame,
            &painter.setup.attributes,
            rows,
            next,
            &mut |row, pixels, depth, attribute| {
                let place = (rows.start, row - rows.start);
                run::<S, M>(
                    m,
                    painter,
                    place,
                    pixels,
                    (next, material),
                    depth,
                    attribute,
                    &mut scratch.band,
                );
            },
        );
        rest = others;
    }
}

/// Draws triangles from the front of `polygons`; gives how many.
fn triangles<S: Shader, M: Lanes>(
    m: M,
    (painter, filler): (&Painter<'_, S>, &FillerOf<'_, S>),
    polygons: &[Listed],
    rows: &Range<usize>,
    scratch: &mut Scratch,
) -> usize {
    let layout = scratch.band.layout::<M, S::Pixel<M::F>>();
    // A constant of its own: only one of both is compiled.
    if const { matches!(S::GIVEN, Given::Walked) } {
        let Found { taken, drawn } = find(m, painter.frame, polygons, rows, None, scratch);
        walk(m, painter, drawn, rows.start, scratch);
        taken
    } else {
        let Found { taken, drawn } = find(m, painter.frame, polygons, rows, Some(layout), scratch);
        fill::<M, _, _, S::Pixel<M::F>>(m, filler, drawn, rows.start, scratch);
        taken
    }
}

/// Triangles that were read from a list.
struct Found {
    /// How many.
    taken: usize,
    /// Bit k: whether triangle k may be drawn.
    drawn: u32,
}

/// Reads triangles from the front of `polygons` and finds where they lie in a band; with `tiny`, its layout, also which pixels
/// the tiny ones cover. Compiled once for an instruction set and not for each shader.
#[inline(never)]
fn find<M: Lanes>(
    m: M,
    frame: &Frame,
    polygons: &[Listed],
    rows: &Range<usize>,
    tiny: Option<Layout>,
    scratch: &mut Scratch,
) -> Found {
    let Scratch {
        band,
        batch,
        fragments,
        ..
    } = scratch;
    m.vectorize(
        #[inline(always)]
        || {
            let taken = batch.read(frame, polygons);
            band.extend(batch.place(m, frame.width(), rows, tiny.is_some()));
            let mut drawn = batch.others();
            if let Some(layout) = tiny {
                drawn |= fragments.find(m, batch, rows.start, layout);
            }
            Found { taken, drawn }
        },
    )
}

/// Draws those triangles that were found whose bits `drawn` has, on the band that begins with row `top`.
#[inline(never)]
fn walk<S: Shader, M: Lanes>(
    m: M,
    painter: &Painter<'_, S>,
    drawn: u32,
    top: usize,
    scratch: &mut Scratch,
) {
    let Scratch { band, batch, .. } = scratch;
    m.vectorize(
        #[inline(always)]
        || {
            batch.read_depths(m, painter.frame, drawn);
            batch.read_materials(painter.frame, drawn);
            painter.batch(m, (batch, drawn), top, &mut band.cells(m, painter.depth));
        },
    );
}

/// The same where the pixels are `P` and no walk gives them: compiled once for all shaders of which that is so.
#[inline(never)]
fn fill<M: Lanes, A: Attribute<f32>, Q: Planes<f32>, P: Planes<M::F>>(
    m: M,
    filler: &Filler<'_, A, Q>,
    drawn: u32,
    top: usize,
    scratch: &mut Scratch,
) {
    let Scratch {
        band,
        batch,
        fragments,
        starts,
        ..
    } = scratch;
    m.vectorize(
        #[inline(always)]
        || {
            filler.batch::<M, P>(
                m,
                (batch, drawn),
                (fragments, starts),
                top,
                &mut band.cells(m, filler.depth),
            )
        },
    );
}

/// Draws one run of a polygon of another shape.
#[inline(never)]
#[allow(clippy::too_many_arguments)] // as of what it calls
fn run<S: Shader, M: Lanes>(
    m: M,
    painter: &Painter<'_, S>,
    place: (usize, usize),
    pixels: Range<usize>,
    polygon: (u32, u32),
    depth: [f32; 2],
    attribute: paint::SpanIn<S>,
    band: &mut Band,
) {
    m.vectorize(
        #[inline(always)]
        || {
            band.extend(pixels.start / M::WIDTH..pixels.end.div_ceil(M::WIDTH));
            painter.run(
                m,
                place,
                pixels,
                polygon,
                depth,
                attribute,
                &mut band.cells(m, painter.depth),
            );
        },
    );
}

/// Shades row `row` of a band.
#[inline(never)]
fn shade<S: Shader, M: Lanes>(
    m: M,
    frame: &Frame,
    consts: &Constants<S, M>,
    row: usize,
    scratch: &mut Scratch,
    sink: &mut dyn RowSink,
) {
    let Scratch { band, line, .. } = scratch;
    let width = frame.width();
    let Range { start, end } = band.drawn();
    let drawn = (start * M::WIDTH).min(width)..(end * M::WIDTH).min(width);
    let mut colours = match sink.bytes(row) {
        Some((texels, background)) => Colours::Packed(texels, background),
        None => {
            for channel in line.iter_mut() {
                channel.resize(channel.len().max(width + 2 * M::WIDTH), 0.0);
            }
            Colours::Linear(line)
        }
    };
    m.vectorize(
        #[inline(always)]
        || {
            if let Colours::Packed(texels, background) = &mut colours {
                texels[..drawn.start].fill(*background);
                texels[drawn.end..].fill(*background);
            }
            shade::row::<S, M>(m, consts, row, band, &mut colours);
        },
    );
    if matches!(colours, Colours::Linear(_)) {
        let [depth, r, g, b] = &*line;
        let from = drawn.start;
        sink.row(
            row,
            drawn,
            &depth[from..],
            [&r[from..], &g[from..], &b[from..]],
        );
    }
}

/// The number of the one material that all polygons have, if there is only one: objects of a scene bring their own, which are often
/// the same.
fn only_material(frame: &Frame) -> Option<u32> {
    if frame
        .lightings()
        .iter()
        .all(|lighting| *lighting == frame.lightings()[0])
    {
        return Some(0);
    }
    let first = frame
        .polygons()
        .first()
        .map_or(0, |polygon| polygon.material);
    frame
        .polygons()
        .iter()
        .all(|polygon| polygon.material == first)
        .then_some(first)
}
