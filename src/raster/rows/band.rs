//! The memory of one scanline: depth, and what the walks gave to each pixel, plane by plane.

use crate::number::{Lanes, Planes, get_each, put_each};
use alloc::vec::Vec;
use core::ops::Range;

/// Values behind the end of a row, so that a group may reach over it.
const PADDING: usize = 32;

/// Depth and planes of a scanline: what is drawn together is near, in the L1 cache for a few planes.
#[derive(Debug, Default)]
pub(crate) struct Row {
    stride: usize,
    /// Depth, then the planes.
    values: Vec<f32>,
    /// The pixels between which anything was drawn.
    pub drawn: Range<usize>,
}

impl Row {
    /// Makes room for `width` pixels with `planes` planes, all of them empty.
    pub fn prepare(&mut self, width: usize, planes: usize) {
        let stride = (width + PADDING).next_multiple_of(16);
        if self.stride != stride || self.values.len() != stride * (planes + 1) {
            self.stride = stride;
            self.values.clear();
            self.values.resize(stride * (planes + 1), f32::INFINITY);
            self.drawn = 0..0;
        }
    }

    /// Notes that the pixels `from..to` may be drawn.
    #[inline(always)]
    pub fn note(&mut self, from: usize, to: usize) {
        self.drawn = match self.drawn.is_empty() {
            true => from..to,
            false => self.drawn.start.min(from)..self.drawn.end.max(to),
        };
    }

    /// Depth from pixel `x` on.
    #[inline(always)]
    pub fn depth(&self, x: usize) -> &[f32] {
        &self.values[x..self.stride]
    }

    /// Stores `pixel` and `depth` where `mask` says so.
    #[inline(always)]
    pub fn put<M: Lanes, P: Planes<M::F>>(&mut self, m: M, x: usize, mask: M::Mask, depth: M::F, pixel: P) {
        let mut at = x;
        put_each(
            (depth, pixel),
            #[inline(always)]
            |new: M::F| {
                let place = &mut self.values[at..at + M::WIDTH];
                let old = m.load(place);
                m.store(m.blend(mask, new, old), place);
                at += self.stride;
            },
        );
    }

    /// Stores the number of a material, behind the planes, where `mask` says so.
    #[inline(always)]
    pub fn put_material<M: Lanes>(&mut self, m: M, x: usize, mask: M::Mask, material: u32) {
        let at = self.values.len() - self.stride + x;
        let place = &mut self.values[at..at + M::WIDTH];
        m.store(m.blend(mask, m.splat(f32::from_bits(material)), m.load(place)), place);
    }

    /// The numbers of the materials.
    pub fn materials(&self) -> &[f32] {
        &self.values[self.values.len() - self.stride..]
    }

    /// What is stored from pixel `x` on.
    #[inline(always)]
    pub fn get<M: Lanes, P: Planes<M::F>>(&self, m: M, x: usize) -> P {
        let mut at = x;
        get_each(
            #[inline(always)]
            || {
                at += self.stride;
                m.load(&self.values[at..at + M::WIDTH])
            },
        )
    }

    /// Empties it.
    pub fn clear(&mut self) {
        self.values[self.drawn.clone()].fill(f32::INFINITY);
        self.drawn = 0..0;
    }
}
