//! Packed colours, for methods that light each polygon once, in pictures of levels. A polygon's
//! colour is packed into one float, as the picture stores it, and a row is shaded by reading it.

use super::RowEngine;
use super::tile::Tile;
use crate::number::lanes::Lanes;
use crate::number::parallel::for_each_chunk;
use crate::number::simd::{BLOCK, Token, vectorize};
use crate::raster::setup::Per;
use crate::shading::{CellLayout, RowColours, ShadeRow};
use alloc::vec::Vec;
use fearless_simd::{Bytes, SimdBase, SimdMask, i32x8, u8x32};

/// How many polygons one call packs: whole blocks of any instruction set.
const BATCH: usize = 8 * BLOCK;
/// How many polygons one thread packs at a time.
const CHUNK: usize = 1 << 13;

/// The bits of red, green and blue in a packed colour, red lowest.
const COLOUR: u32 = 0xFF_FFFF;
/// The other bits. With them any colour is a normal float from 2 to 8. If all corners of a polygon
/// have the same normal float it is interpolated exactly, because all differences and steps are 0.
const NORMAL: u32 = 0x4000_0000;
/// The other bits of an opaque pixel: alpha 255.
const OPAQUE: u32 = 0xFF00_0000;

impl RowEngine<'_> {
    /// Replaces the polygons' varyings by packed colours, if each polygon has one colour. The
    /// colours are written to `packed`, whose contents do not matter. The method's own kernel
    /// computes the bytes, so they equal the bytes of any other path. Returns the memory that is no
    /// longer needed.
    pub(super) fn pack(&mut self, mut packed: Vec<f32>) -> Vec<f32> {
        let (setup, kernels, cell) = (&mut self.setup, self.kernels, self.cell);
        let is_constant = matches!(setup.varyings.per, Per::Polygon) && self.walk.is_none();
        let Some(only) = self
            .only
            .filter(|_| is_constant && cell.varyings > 0 && cell.extras == 0)
        else {
            return packed;
        };
        let count = cell.varyings;
        let job = ShadeRow {
            parameters: setup.parameters,
            uniforms: &setup.uniforms[only.0 as usize],
            extras: setup.extras,
            cell,
        };
        let values = &setup.varyings.values;
        packed.resize(setup.frame.polygons().len(), 0.0);
        for_each_chunk(&mut packed[..], CHUNK, &|first, packed: &mut [f32]| {
            let values = &values[first * count..][..packed.len() * count];
            // Depths stay 0, which counts as drawn everywhere.
            let mut cells = alloc::vec![0.0; BATCH * cell.count()];
            let mut bytes = [[0; 4]; BATCH];
            let batches = packed.chunks_mut(BATCH).zip(values.chunks(BATCH * count));
            for (to, values) in batches {
                for (k, varying) in values.chunks_exact(count).enumerate() {
                    let block = &mut cells[k / BLOCK * cell.stride()..][..cell.stride()];
                    for (i, value) in varying.iter().enumerate() {
                        block[BLOCK * CellLayout::varying(i) + k % BLOCK] = *value;
                    }
                }
                (kernels.shade)(&job, &cells, &mut RowColours::Bytes(&mut bytes, [0; 4]));
                for (to, colour) in to.iter_mut().zip(bytes) {
                    *to = f32::from_bits(u32::from_le_bytes(colour) & COLOUR | NORMAL);
                }
            }
        });
        setup.varyings.count = 1;
        self.cell.varyings = 1;
        self.is_packed = true;
        core::mem::replace(&mut setup.varyings.values, packed.into()).into_owned()
    }

    /// Writes row `row` of a tile of packed colours to pixels, which begin at the first drawn
    /// block.
    pub(super) fn show<S: Token>(&self, tile: &Tile, row: usize, to: &mut [[u8; 4]]) {
        let (m, cells) = (Lanes(S::get()), tile.row(row, tile.drawn()));
        vectorize(
            m.0,
            #[inline(always)]
            || {
                let background = m.int(i32::from_le_bytes(self.background));
                // One exclusive or turns the bits `NORMAL` into the bits `OPAQUE`.
                let others = m.int((NORMAL ^ OPAQUE) as i32);
                let blocks = cells.chunks_exact(tile.stride());
                for (block, to) in blocks.zip(to.chunks_mut(BLOCK)) {
                    let depth = m.load(&block[BLOCK * CellLayout::DEPTH..]);
                    let packed = m.load(&block[BLOCK * CellLayout::varying(0)..]);
                    let is_drawn: i32x8<S> = depth.simd_lt(m.splat(f32::INFINITY)).to_vector();
                    let packed: i32x8<S> = Bytes::bitcast(packed);
                    let opaque = packed ^ others;
                    // Selects `opaque` where the mask is all ones, else `background`.
                    let pixels = background ^ ((opaque ^ background) & is_drawn);
                    let bytes: u8x32<S> = Bytes::to_bytes(pixels);
                    match to.len() {
                        BLOCK => bytes.store_slice(to.as_flattened_mut()),
                        // The picture ends inside this block.
                        _ => {
                            let mut whole = [[0; 4]; BLOCK];
                            bytes.store_slice(whole.as_flattened_mut());
                            to.copy_from_slice(&whole[..to.len()]);
                        }
                    }
                }
            },
        );
    }
}
