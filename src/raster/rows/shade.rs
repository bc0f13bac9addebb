//! One row of a band, from planes to colours.

use super::band::Row;
use crate::number::Lanes;
use crate::shader::Shader;
use alloc::vec::Vec;
use core::ops::Range;

/// Shades what was drawn of a row into three channels, linear and not yet clamped. All of it has material `only`, or the
/// last plane tells each pixel's.
#[inline(always)]
pub(super) fn row<S: Shader, M: Lanes>(
    m: M,
    consts: &[S::Consts<M::F>],
    only: Option<u32>,
    row: &Row,
    line: &mut [Vec<f32>; 3],
) {
    let drawn = row.drawn.clone();
    match only {
        Some(material) => run::<S, M>(m, &consts[material as usize], row, drawn, line),
        None => {
            let materials = row.materials();
            let is_drawn = |x: usize| row.depth(0)[x] < f32::INFINITY;
            let mut x = drawn.start;
            while x < drawn.end {
                if !is_drawn(x) {
                    x += 1;
                    continue;
                }
                let (first, material) = (x, materials[x].to_bits());
                while x < drawn.end && (!is_drawn(x) || materials[x].to_bits() == material) {
                    x += 1;
                }
                run::<S, M>(m, &consts[material as usize], row, first..x, line);
            }
        }
    }
}

/// Shades the pixels `pixels`, and up to a group behind them, which what comes next is written over.
#[inline(always)]
fn run<S: Shader, M: Lanes>(
    m: M,
    consts: &S::Consts<M::F>,
    row: &Row,
    pixels: Range<usize>,
    [red, green, blue]: &mut [Vec<f32>; 3],
) {
    // A copy that nothing else refers to: loads from it can leave the loop.
    let consts = *consts;
    let nothing = m.splat(f32::INFINITY);
    let mut x = pixels.start;
    while x < pixels.end {
        if m.any(m.less(m.load(row.depth(x)), nothing)) {
            let [r, g, b] = S::shade(&consts, row.get::<M, S::Pixel<M::F>>(m, x));
            m.store(r, &mut red[x..]);
            m.store(g, &mut green[x..]);
            m.store(b, &mut blue[x..]);
        }
        x += M::WIDTH;
    }
}
