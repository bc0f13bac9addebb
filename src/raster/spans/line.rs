//! The visible line: which span is seen at each pixel of a scanline, by a depth buffer of one line
//! and the span engine's depth test.

use super::active::PolygonSpan;
use crate::raster::depth::{CallersDepth, DepthTest, SampleDepth};
use alloc::vec;
use alloc::vec::Vec;
use core::mem::take;
use core::ops::Range;

/// The index of the span, or of the polygon, at a pixel that shows none.
pub const NO_POLYGON: u32 = u32::MAX;

/// A pixel that shows no span: infinitely far away.
const EMPTY: (f32, u32) = (f32::INFINITY, NO_POLYGON);

/// Steps depth along a span. Span `index` is seen wherever `sees` returns a depth to store.
#[inline(always)]
fn walk(
    span: &PolygonSpan,
    pixels: &mut [(f32, u32)],
    index: u32,
    sees: impl Fn(f32, f32) -> Option<f32>,
) {
    let mut q = span.depth;
    for (depth, seen) in pixels {
        if let Some(kept) = sees(q, *depth) {
            (*depth, *seen) = (kept, index);
        }
        q += span.depth_step;
    }
}

/// The nearest span at each pixel of one scanline, and its depth.
#[derive(Debug)]
pub(crate) struct VisibleLine {
    spans: Vec<PolygonSpan>,
    /// The depth at each pixel, and the index of the span seen there.
    pixels: Vec<(f32, u32)>,
    drawn: Range<usize>,
    rule: SampleDepth,
}

impl VisibleLine {
    pub fn new(width: usize, rule: SampleDepth) -> Self {
        VisibleLine {
            spans: Vec::new(),
            pixels: vec![EMPTY; width],
            drawn: 0..0,
            rule,
        }
    }

    /// Empties the line.
    pub fn clear(&mut self) {
        self.spans.clear();
        self.pixels[take(&mut self.drawn)].fill(EMPTY);
    }

    /// Draws a span. It is seen where its depth is strictly less than the depths drawn before.
    pub fn draw(&mut self, span: PolygonSpan) {
        let index = self.spans.len() as u32;
        let pixels = span.start as usize..span.end as usize;
        // An empty range is 0..0 and would pull the start of the union to 0.
        self.drawn = if self.drawn.is_empty() {
            pixels.clone()
        } else {
            self.drawn.start.min(pixels.start)..self.drawn.end.max(pixels.end)
        };
        let pixels = &mut self.pixels[pixels];
        let rule = self.rule;
        // The fast path has its own loop, without any other test.
        if rule.is_plain() {
            walk(&span, pixels, index, |q, depth| (q < depth).then_some(q));
        } else {
            walk(&span, pixels, index, |q, depth| rule.seen(q, depth));
        }
        self.spans.push(span);
    }

    /// Empties the pixels that fail the test against the caller's depth. Stores the depths of the
    /// other pixels in the caller's buffer.
    pub fn hide_behind(&mut self, depth: CallersDepth<'_>) {
        match depth.test.test {
            DepthTest::Less => self.hide::<false, false>(depth),
            DepthTest::LessOrEqual => self.hide::<false, true>(depth),
            DepthTest::Greater => self.hide::<true, false>(depth),
            DepthTest::GreaterOrEqual => self.hide::<true, true>(depth),
        }
    }

    fn hide<const REVERSED: bool, const EQUAL: bool>(
        &mut self,
        CallersDepth { stored, test }: CallersDepth<'_>,
    ) {
        let drawn = self.drawn.clone();
        for (pixel, stored) in self.pixels[drawn.clone()]
            .iter_mut()
            .zip(&mut stored[drawn])
        {
            if test.hide::<REVERSED, EQUAL>(&mut pixel.0, stored) {
                *pixel = EMPTY;
            }
        }
    }

    /// Returns the depth at each pixel, rounded as it is stored; infinite where nothing was drawn.
    pub fn depth(&self) -> impl Iterator<Item = f32> {
        self.pixels.iter().map(|(kept, _)| self.rule.shown(*kept))
    }

    /// Returns the depth at pixel `x` as it is stored.
    pub fn stored(&self, x: usize) -> f32 {
        self.pixels[x].0
    }

    /// Returns the span seen at pixel `x`, an index into [`VisibleLine::spans`], or [`NO_POLYGON`].
    #[cfg(feature = "io")]
    pub fn span_at(&self, x: usize) -> u32 {
        self.pixels[x].1
    }

    /// Returns the polygon seen at pixel `x`, or [`NO_POLYGON`].
    pub fn polygon(&self, x: usize) -> u32 {
        self.spans
            .get(self.pixels[x].1 as usize)
            .map_or(NO_POLYGON, |span| span.polygon)
    }

    /// Returns the spans that were drawn on this line, hidden ones too.
    pub fn spans(&self) -> &[PolygonSpan] {
        &self.spans
    }

    /// Calls `visit` with each visible run, from left to right: a span and the pixels at which it
    /// is seen.
    #[inline(always)]
    pub fn runs(&self, mut visit: impl FnMut(&PolygonSpan, Range<usize>)) {
        let mut x = self.drawn.start;
        while x < self.drawn.end {
            // A stretch of empty pixels is found like any run, but is not visited.
            let index = self.pixels[x].1;
            let start = x;
            x += 1;
            while x < self.drawn.end && self.pixels[x].1 == index {
                x += 1;
            }
            if index != NO_POLYGON {
                visit(&self.spans[index as usize], start..x);
            }
        }
    }
}
