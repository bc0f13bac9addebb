//! The visible line: which span is seen at each pixel of a scanline. Spans that lie over one
//! another are drawn into a depth buffer of one line, by the span engine's depth test.

use super::active::PolygonSpan;
use super::columns::Columns;
use crate::raster::depth::{CallersDepth, DepthTest, SampleDepth};
use alloc::vec;
use alloc::vec::Vec;
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

/// The spans of one scanline, and which of them is seen at each pixel.
///
/// Where no span lies over another, each is seen whole. Else, and where anyone asks for pixels, the
/// spans are drawn into a depth buffer of one line.
#[derive(Debug)]
pub(crate) struct VisibleLine {
    spans: Vec<PolygonSpan>,
    /// The columns of the spans, as far as none lies over another.
    covered: Columns,
    /// True while no span lies over another.
    is_apart: bool,
    /// How many of the spans are drawn.
    drawn: usize,
    /// The depth at each pixel, and the index of the span seen there.
    pixels: Vec<(f32, u32)>,
    /// The pixels from the first to the last that was drawn.
    reach: Range<usize>,
    rule: SampleDepth,
}

/// The pixels of a line on which all spans are drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DrawnLine<'a> {
    /// The spans, hidden ones too.
    pub spans: &'a [PolygonSpan],
    pixels: &'a [(f32, u32)],
    rule: &'a SampleDepth,
}

impl VisibleLine {
    pub fn new(width: usize, rule: SampleDepth) -> Self {
        VisibleLine {
            spans: Vec::new(),
            covered: Columns::new(width),
            is_apart: true,
            drawn: 0,
            pixels: vec![EMPTY; width],
            reach: width..0,
            rule,
        }
    }

    /// Empties the line.
    pub fn clear(&mut self) {
        if self.drawn > 0 {
            self.pixels[self.reach.clone()].fill(EMPTY);
            self.reach = self.pixels.len()..0;
            self.drawn = 0;
        }
        self.spans.clear();
        self.covered.clear();
        self.is_apart = true;
    }

    /// Adds a span.
    #[inline(always)]
    pub fn add(&mut self, span: PolygonSpan) {
        debug_assert!(
            self.rule.cube.is_some() || (span.depth.is_finite() && span.depth_step.is_finite()),
            "depths between two planes are finite"
        );
        self.spans.reserve(1); // room first, so that the span stays in registers until it is stored
        if self.is_apart {
            self.is_apart = self.covered.add(span.pixels());
        }
        self.spans.push(span);
    }

    /// Draws the spans that are not drawn yet. A span is seen where its depth is strictly less than
    /// the depths drawn before.
    fn draw(&mut self) {
        let (rule, is_plain) = (self.rule, self.rule.is_plain());
        for (span, index) in self.spans[self.drawn..].iter().zip(self.drawn as u32..) {
            let pixels = span.pixels();
            self.reach.start = self.reach.start.min(pixels.start);
            self.reach.end = self.reach.end.max(pixels.end);
            let pixels = &mut self.pixels[pixels];
            // The fast path has its own loop, without any other test.
            if is_plain {
                walk(span, pixels, index, |q, depth| (q < depth).then_some(q));
            } else {
                walk(span, pixels, index, |q, depth| rule.seen(q, depth));
            }
        }
        self.drawn = self.spans.len();
    }

    /// Returns the pixels, with all spans drawn.
    pub fn drawn(&mut self) -> DrawnLine<'_> {
        self.draw();
        DrawnLine {
            spans: &self.spans,
            pixels: &self.pixels,
            rule: &self.rule,
        }
    }

    /// Returns the spans, hidden ones too.
    pub fn spans(&self) -> &[PolygonSpan] {
        &self.spans
    }

    /// True if each span is seen whole, so that none need be drawn.
    fn is_whole(&self) -> bool {
        // On an empty pixel every sample is drawn, as depths are finite, unless it is outside of
        // the NDC cube.
        self.is_apart && self.drawn == 0 && self.rule.cube.is_none()
    }

    /// Empties the pixels that fail the test against the caller's depth. Stores the depths of the
    /// other pixels in the caller's buffer.
    pub fn hide_behind(&mut self, depth: CallersDepth<'_>) {
        self.draw();
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
        let reach = self.reach();
        for (pixel, stored) in self.pixels[reach.clone()]
            .iter_mut()
            .zip(&mut stored[reach])
        {
            if test.hide::<REVERSED, EQUAL>(&mut pixel.0, stored) {
                *pixel = EMPTY;
            }
        }
    }

    /// Calls `visit` with each visible run: a span and the pixels at which it is seen. Runs do not
    /// overlap, and may come in any order.
    #[inline(always)]
    pub fn runs(&mut self, mut visit: impl FnMut(&PolygonSpan, Range<usize>)) {
        let mut whole = &[][..];
        if self.is_whole() {
            whole = &self.spans;
        } else {
            self.draw();
        }
        let whole = whole.iter().map(|span| (span, span.pixels()));
        // A stretch of empty pixels has no span. Without drawn spans there are no stretches.
        let pieces = stretches(&self.pixels, self.reach(), |pixel| pixel.1);
        let pieces =
            pieces.filter_map(|(index, pixels)| Some((self.spans.get(index as usize)?, pixels)));
        // A loop over both, so that the code of `visit` is compiled once.
        for (span, pixels) in whole.chain(pieces) {
            visit(span, pixels);
        }
    }

    /// Calls `visit` with each stretch of pixels at which any span is seen, from left to right.
    pub fn stretches(&mut self, mut visit: impl FnMut(Range<usize>)) {
        if self.is_whole() {
            return self.covered.for_each_stretch(visit);
        }
        self.draw();
        let is_seen = |pixel: &(f32, u32)| pixel.1 != NO_POLYGON;
        for (is_seen, pixels) in stretches(&self.pixels, self.reach(), is_seen) {
            if is_seen {
                visit(pixels);
            }
        }
    }

    /// Returns the pixels from the first to the last that was drawn.
    fn reach(&self) -> Range<usize> {
        match self.drawn {
            0 => 0..0,
            _ => self.reach.clone(),
        }
    }
}

/// Divides pixels within `reach` into stretches for which `of` returns the same, as long as
/// possible.
#[inline(always)]
fn stretches<T: PartialEq>(
    pixels: &[(f32, u32)],
    reach: Range<usize>,
    of: impl Fn(&(f32, u32)) -> T,
) -> impl Iterator<Item = (T, Range<usize>)> {
    let (mut x, mut rest) = (reach.start, &pixels[reach]);
    core::iter::from_fn(move || {
        let here = of(rest.first()?);
        let is_other = |pixel: &(f32, u32)| of(pixel) != here;
        let count = rest.iter().position(is_other).unwrap_or(rest.len());
        let start = x;
        (x, rest) = (x + count, &rest[count..]);
        Some((here, start..x))
    })
}

impl DrawnLine<'_> {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::FrameBuilder;
    use crate::number::test_random::Random;
    use crate::scene::Clipping;

    const WIDTH: usize = 130;

    fn line(clipping: Clipping) -> VisibleLine {
        let mut builder = FrameBuilder::new(WIDTH as u32, 1);
        builder.clipping(clipping);
        VisibleLine::new(WIDTH, SampleDepth::new(&builder.finish().expect("a frame")))
    }

    fn span(polygon: u32, pixels: Range<usize>, depth: f32) -> PolygonSpan {
        PolygonSpan {
            polygon,
            left: 0,
            start: pixels.start as u32,
            end: pixels.end as u32,
            t0: 0.0,
            dt: 0.0,
            depth,
            depth_step: 0.001,
        }
    }

    /// Returns the polygon at each pixel, by the visible runs. Checks that runs do not overlap, and
    /// that the stretches are their pixels.
    fn seen(line: &mut VisibleLine) -> Vec<u32> {
        let mut seen = vec![NO_POLYGON; WIDTH];
        line.runs(|span, pixels| {
            let here = &mut seen[pixels];
            assert!(here.iter().all(|polygon| *polygon == NO_POLYGON));
            here.fill(span.polygon);
        });
        let mut covered = vec![false; WIDTH];
        line.stretches(|pixels| covered[pixels].fill(true));
        assert_eq!(
            covered,
            seen.iter().map(|p| *p != NO_POLYGON).collect::<Vec<_>>()
        );
        seen
    }

    #[test]
    fn spans_that_are_not_drawn_are_seen_as_if_they_were() {
        let mut random = Random::new(57);
        let (mut line, mut whole) = (line(Clipping::Planes), 0);
        for _ in 0..2000 {
            line.clear();
            for polygon in 0..random.below(4) as u32 {
                let start = random.below(WIDTH as u64) as usize;
                let count = 1 + random.below((WIDTH - start).min(70) as u64) as usize;
                line.add(span(polygon, start..start + count, random.signed().abs()));
            }
            whole += usize::from(line.is_whole());
            let found = seen(&mut line);
            let drawn = line.drawn();
            let expected: Vec<u32> = (0..WIDTH).map(|x| drawn.polygon(x)).collect();
            assert_eq!(found, expected, "{:?}", line.spans());
            assert_eq!(seen(&mut line), expected, "drawn: {:?}", line.spans());
        }
        assert!(
            (500..1500).contains(&whole),
            "{whole} lines of 2000 without overlap"
        );
    }

    #[test]
    fn samples_outside_of_the_cube_are_not_seen() {
        let mut line = line(Clipping::NdcCube);
        line.add(span(7, 3..9, 0.9975));
        let seen = seen(&mut line);
        assert_eq!(seen[2..7], [NO_POLYGON, 7, 7, 7, NO_POLYGON]);
    }
}
