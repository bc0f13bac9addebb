//! Shades one span by the kernels of a method, without an engine.

use crate::number::SimdLevel;
use crate::number::simd::BLOCK;
use crate::shading::light::Uniforms;
use crate::shading::{
    CellLayout, Extras, Kernels, Pixels, PolygonConstants, RowColours, Run, RunList, ShadeRow,
    SpanBench, SpanPlace, UniformsIndex, Variant, Vertices,
};
use alloc::vec;
use alloc::vec::Vec;

/// The most values at both ends of a span, for four lights.
const MOST: usize = 40;

/// A span after its set-up.
struct Started {
    kernels: &'static Kernels,
    extras: Extras,
    list: RunList,
    constants: PolygonConstants,
}

impl Started {
    /// Returns the arguments for the kernels.
    fn job<'a>(&'a self, variant: &'a Variant, uniforms: &'a Uniforms) -> Pixels<'a> {
        Pixels {
            parameters: variant.parameters(),
            uniforms: core::slice::from_ref(uniforms),
            extras: self.extras,
            constants: &self.constants,
            list: &self.list,
        }
    }
}

/// Lights both vertices of a span of `pixels` pixels and sets it up.
fn start(variant: &Variant, bench: &SpanBench, uniforms: &Uniforms, pixels: usize) -> Started {
    let lights = uniforms.lights.len();
    let kernels = variant.row().kernels(lights, bench.is_local());
    let extras = bench.extras(variant);
    let [own, _, planned] = (kernels.counts)(lights);
    let varyings = own + extras.count();
    let mut ends = [0.0; MOST];
    for (k, end) in ends[..2 * varyings]
        .chunks_exact_mut(varyings.max(1))
        .enumerate()
    {
        let vertex = Vertices {
            uniforms,
            normals: &bench.normals[k..=k],
            points: &bench.points[k..=k],
            attributes: &[[0.0; 4]],
        };
        (kernels.vertices)(&vertex, &mut end[..own]);
        if extras.point {
            end[own..own + 3].copy_from_slice(&bench.points[k]);
        }
        if extras.weight {
            end[varyings - 1] = 1.0;
        }
    }
    let dt = 1.0 / pixels as f32;
    let mut constants = PolygonConstants::default();
    if planned > 0 || !kernels.kinds.is_empty() {
        constants.values.resize(planned, 0.0);
        let to = &mut constants.values;
        constants.kinds = vec![(kernels.polygon)(
            variant.parameters(),
            uniforms,
            &bench.polygon(pixels as f32, |x| x).corners(),
            to,
        )];
    }
    let mut list = RunList::new(varyings);
    let run = Run {
        uniforms: UniformsIndex(0),
        polygon: 0,
        x: 0,
        pixels: pixels as u32,
        to: 0,
    };
    let place = SpanPlace {
        y: 0,
        t0: 0.5 * dt,
        dt,
        start: 0,
        pixels: pixels as u32,
    };
    let (left, right) = ends[..2 * varyings].split_at(varyings);
    list.add(kernels.needs, run, [left, right], place);
    Started {
        kernels,
        extras,
        list,
        constants,
    }
}

/// The memory for a span that an instruction set shades again and again, laid out as a row of the
/// G-buffer.
#[derive(Clone, Debug)]
pub struct SpanRow {
    uniforms: Uniforms,
    walked: Vec<f32>,
    cells: Vec<f32>,
    bytes: Vec<[u8; 4]>,
}

impl SpanRow {
    /// Allocates the memory for a span of `pixels` pixels.
    ///
    /// # Panics
    /// If `pixels` is not a multiple of 16.
    pub fn new(variant: &Variant, bench: &SpanBench, pixels: usize) -> SpanRow {
        assert!(pixels.is_multiple_of(2 * BLOCK), "whole blocks");
        let lights = bench.lighting.lights.len();
        let kernels = variant.row().kernels(lights, bench.is_local());
        let uniforms = bench.uniforms(variant, kernels.scale_of_bytes());
        let [varyings, planes, _] = (kernels.counts)(lights);
        let planes = planes.max(varyings) + bench.extras(variant).count();
        SpanRow {
            uniforms,
            walked: vec![0.0; planes * pixels],
            cells: vec![0.0; (1 + planes) * pixels],
            bytes: vec![[0; 4]; pixels],
        }
    }

    /// Returns the colours of the last span, as RGBA.
    pub fn bytes(&self) -> &[[u8; 4]] {
        &self.bytes
    }
}

impl Variant {
    /// Shades one span into `out`, one pixel at a time: lights its two vertices, sets it up, and
    /// shades as many pixels as `out` has.
    #[doc(hidden)]
    pub fn shade_span(&self, bench: &SpanBench, out: &mut [[f32; 3]]) {
        let uniforms = bench.prepared(self);
        let started = start(self, bench, uniforms, out.len());
        (started.kernels.pixels)(&started.job(self, uniforms), out);
    }

    /// Shades one span by the kernels of an instruction set, as the row engine calls them: first
    /// the walk into a row of the G-buffer, then from the row to bytes. Does nothing for scalar
    /// code.
    #[doc(hidden)]
    pub fn shade_span_on(&self, level: SimdLevel, bench: &SpanBench, row: &mut SpanRow) {
        let pixels = row.bytes.len();
        let started = start(self, bench, &row.uniforms, pixels);
        let Some(simd) = (started.kernels.simd)(level) else {
            return;
        };
        let [varyings, walked, _] = (started.kernels.counts)(row.uniforms.lights.len());
        let walks_along =
            (started.kernels.walks_along_runs)(self.parameters(), &row.uniforms.model);
        let walk = simd.walk.filter(|_| walks_along);
        let mut cell = CellLayout {
            varyings,
            extras: started.extras.count(),
            has_uniforms: false,
        };
        if let Some(walk) = walk {
            walk(&started.job(self, &row.uniforms), &mut row.walked);
            (cell.varyings, cell.extras) = (walked, 0);
        }
        let cells = row.cells.chunks_exact_mut(cell.stride());
        for (first, block) in (0..pixels).step_by(BLOCK).zip(cells) {
            let varyings = &mut block[BLOCK * CellLayout::varying(0)..];
            for (plane, to) in varyings.chunks_exact_mut(BLOCK).enumerate() {
                if walk.is_some() {
                    to.copy_from_slice(&row.walked[plane * pixels + first..][..BLOCK]);
                    continue;
                }
                let [at, step] = started.list.starts.of(0).of(plane);
                for (k, to) in to.iter_mut().enumerate() {
                    *to = at + (first + k) as f32 * step;
                }
            }
        }
        let job = ShadeRow {
            parameters: self.parameters(),
            uniforms: &row.uniforms,
            extras: started.extras,
            cell,
        };
        let mut colours = RowColours::Bytes(&mut row.bytes, [0; 4]);
        (simd.shade)(&job, &row.cells[..cell.count() * pixels], &mut colours);
    }
}
