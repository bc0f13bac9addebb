//! The visible line: the span seen at each pixel of a scanline, by a depth buffer of one line and the span engine's depth test.

use super::active::PolygonSpan;
use crate::raster::depth::SampleDepth;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// The number of the span, or polygon, at a pixel where there is none.
pub const NOTHING: u32 = u32::MAX;

/// Steps depth along a span. Where `sees` returns a depth to store, span `number` is seen.
#[inline(always)]
fn walk<'a>(
    span: &PolygonSpan,
    line: impl Iterator<Item = (&'a mut f32, &'a mut u32)>,
    number: u32,
    sees: impl Fn(f32, f32) -> Option<f32>,
) {
    let mut q = span.depth;
    for (depth, seen) in line {
        if let Some(kept) = sees(q, *depth) {
            (*depth, *seen) = (kept, number);
        }
        q += span.depth_step;
    }
}

/// The nearest span at each pixel of one scanline, and its depth.
#[derive(Debug)]
pub(crate) struct VisibleLine {
    spans: Vec<PolygonSpan>,
    depth: Vec<f32>,
    seen: Vec<u32>,
    drawn: Range<usize>,
    rule: SampleDepth,
}

impl VisibleLine {
    pub fn new(width: usize, rule: SampleDepth) -> Self {
        VisibleLine {
            spans: Vec::new(),
            depth: vec![f32::INFINITY; width],
            seen: vec![NOTHING; width],
            drawn: 0..0,
            rule,
        }
    }

    /// Empties the line.
    pub fn clear(&mut self) {
        self.spans.clear();
        self.depth[self.drawn.clone()].fill(f32::INFINITY);
        self.seen[self.drawn.clone()].fill(NOTHING);
        self.drawn = 0..0;
    }

    /// Draws a span: it is seen where its depth is strictly less than what was drawn before.
    pub fn draw(&mut self, span: PolygonSpan) {
        let number = self.spans.len() as u32;
        let pixels = span.start as usize..span.end as usize;
        self.drawn = if self.drawn.is_empty() {
            pixels.clone()
        } else {
            self.drawn.start.min(pixels.start)..self.drawn.end.max(pixels.end)
        };
        let line = self.depth[pixels.clone()]
            .iter_mut()
            .zip(&mut self.seen[pixels]);
        let rule = self.rule;
        // The fast path has a loop of its own, without decisions.
        if rule.is_plain() {
            walk(&span, line, number, |q, depth| (q < depth).then_some(q));
        } else {
            walk(&span, line, number, |q, depth| rule.seen(q, depth));
        }
        self.spans.push(span);
    }

    /// Returns the depth at each pixel, as finely as it is stored; infinite where nothing was drawn.
    pub fn depth(&self) -> impl Iterator<Item = f32> {
        self.depth.iter().map(|kept| self.rule.shown(*kept))
    }

    /// Returns the polygon seen at pixel `x`, or [`NOTHING`].
    pub fn polygon(&self, x: usize) -> u32 {
        self.spans
            .get(self.seen[x] as usize)
            .map_or(NOTHING, |span| span.polygon)
    }

    /// Returns the spans that were drawn on this line, hidden ones too.
    pub fn spans(&self) -> &[PolygonSpan] {
        &self.spans
    }

    /// Calls `visit` with each visible run, from left to right: a span and the pixels at which it is seen.
    #[inline(always)]
    pub fn runs(&self, mut visit: impl FnMut(&PolygonSpan, Range<usize>)) {
        let mut x = self.drawn.start;
        while x < self.drawn.end {
            let number = self.seen[x];
            let start = x;
            x += 1;
            while x < self.drawn.end && self.seen[x] == number {
                x += 1;
            }
            if number != NOTHING {
                visit(&self.spans[number as usize], start..x);
            }
        }
    }
}
