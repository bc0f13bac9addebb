//! The memory of a band of scanlines: depth, and what the walks gave to each pixel.

use crate::number::{Lanes, Num, Pair, Planes, get_each, put_each};
use crate::raster::depth::{SampleDepth, level_of};
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;
use core::slice::ChunksExact;

/// Depth and planes of a band, group by group: the depths of eight neighbouring pixels, their first plane, their second, and
/// so on lie together. A group is one place in memory then, whatever its planes are, and what was just written to it by the
/// triangle beside is read back as it was written, which processors do without waiting.
#[derive(Debug, Default)]
pub(crate) struct Band {
    rows: usize,
    /// Groups a row, an even number.
    groups: usize,
    /// Numbers a group.
    size: usize,
    values: Vec<f32>,
    /// The number of the material of each pixel, as bits; empty where all pixels have the same.
    materials: Vec<f32>,
    /// The groups of a row between which anything may have been drawn: see [`Band::drawn`].
    drawn: Range<usize>,
}

/// With more planes than this a row is no longer near.
pub(super) const MOST_PLANES: usize = 16;

/// How many numbers the depth and the planes of a group have.
const fn size<M: Lanes, P: Planes<M::F>>() -> usize {
    match P::COUNT {
        Some(count) => (1 + count) * M::WIDTH,
        None => 0,
    }
}

impl Band {
    /// Makes room for `rows` rows of `width` pixels of `P`, all of them empty; with room for their materials if
    /// `has_materials`.
    pub fn prepare<M: Lanes, P: Planes<M::F>>(
        &mut self,
        rows: usize,
        width: usize,
        has_materials: bool,
    ) {
        let (groups, size) = (width.div_ceil(2 * M::WIDTH) * 2, size::<M, P>());
        // Bands are empty after they were taken: only another division of the memory has to be emptied.
        if (self.rows, self.groups, self.size) != (rows, groups, size) {
            (self.rows, self.groups, self.size) = (rows, groups, size);
            self.values.clear();
            self.values.resize(rows * groups * size, f32::INFINITY);
        }
        self.materials.resize(
            if has_materials {
                rows * groups * M::WIDTH
            } else {
                0
            },
            0.0,
        );
        self.drawn = groups..0;
    }

    /// Returns write access to all groups. Where nearer samples hide farther ones, writes are depth-tested. The caller reports
    /// the groups that it touches with [`Band::extend`]; others are not shaded.
    #[inline(always)]
    pub(super) fn cells<M: Lanes, P: Planes<M::F>>(
        &mut self,
        m: M,
        depth: SampleDepth,
    ) -> Cells<'_, M, P> {
        Cells {
            values: &mut self.values,
            materials: &mut self.materials,
            a_row: self.groups,
            depth,
            test: DepthTest::new(m, depth),
            pixel: PhantomData,
        }
    }

    /// Where its numbers are.
    pub(super) fn layout<M: Lanes, P: Planes<M::F>>(&self) -> Layout {
        Layout {
            a_row: (self.groups * M::WIDTH) as i32,
            numbers: (size::<M, P>() / M::WIDTH) as i32,
        }
    }

    /// Says that the groups `groups` of any row may be drawn.
    #[inline(always)]
    pub(super) fn extend(&mut self, groups: Range<usize>) {
        self.drawn = self.drawn.start.min(groups.start)..self.drawn.end.max(groups.end);
    }

    /// The groups of each row between which anything may have been drawn: an even number from an even one on.
    pub fn drawn(&self) -> Range<usize> {
        // Nothing drawn: from the end to the beginning.
        self.drawn.start.min(self.drawn.end) & !1..self.drawn.end.next_multiple_of(2)
    }

    /// Groups of a row, two by two, from left to right.
    #[inline(always)]
    pub fn row<M: Lanes, P: Planes<M::F>>(
        &self,
        row: usize,
        groups: Range<usize>,
    ) -> ChunksExact<'_, f32> {
        let size = size::<M, P>();
        self.values[(row * self.groups + groups.start) * size..][..groups.len() * size]
            .chunks_exact(2 * size)
    }

    /// The depth of two groups, and what is stored beside it.
    #[inline(always)]
    pub fn pixels<M: Lanes, P: Planes<Pair<M::F>>>(m: M, groups: &[f32]) -> (Pair<M::F>, P) {
        let (first, second) = groups.split_at(groups.len() / 2);
        let mut at = 0;
        get_each::<_, (Pair<M::F>, P)>(
            #[inline(always)]
            || {
                at += M::WIDTH;
                Pair(
                    m.load(&first[at - M::WIDTH..at]),
                    m.load(&second[at - M::WIDTH..at]),
                )
            },
        )
    }

    /// What is stored of one group beside its depth.
    #[inline(always)]
    pub fn pixel<M: Lanes, P: Planes<M::F>>(m: M, group: &[f32]) -> P {
        let mut at = M::WIDTH;
        get_each(
            #[inline(always)]
            || {
                at += M::WIDTH;
                m.load(&group[at - M::WIDTH..at])
            },
        )
    }

    /// Empties what was drawn of a row.
    #[inline(always)]
    pub fn empty_row<M: Lanes, P: Planes<M::F>>(&mut self, m: M, row: usize) {
        let (drawn, size) = (self.drawn(), size::<M, P>());
        let first = row * self.groups + drawn.start;
        for group in self.values[first * size..][..drawn.len() * size].chunks_exact_mut(size) {
            m.store(m.splat(f32::INFINITY), group);
        }
    }

    /// Up to where the pixels of a row, of `pixels`, have the same material, and which one; `only` if all have the same.
    pub fn same_material<M: Lanes, P: Planes<M::F>>(
        &self,
        row: usize,
        pixels: Range<usize>,
        only: u32,
    ) -> (usize, u32) {
        if self.materials.is_empty() {
            return (pixels.end, only);
        }
        let first = row * self.groups;
        let is_drawn = |x: usize| {
            let group = first + x / M::WIDTH;
            self.values[group * size::<M, P>() + x % M::WIDTH] < f32::INFINITY
        };
        let mut drawn = pixels.clone().filter(|&x| is_drawn(x));
        let material = |x: usize| self.materials[first * M::WIDTH + x].to_bits();
        match drawn.next().map(material) {
            None => (pixels.end, only),
            Some(same) => (
                drawn.find(|&x| material(x) != same).unwrap_or(pixels.end),
                same,
            ),
        }
    }
}

/// The groups of a band.
pub(crate) struct Cells<'a, M: Lanes, P> {
    values: &'a mut [f32],
    materials: &'a mut [f32],
    /// Groups a row.
    a_row: usize,
    depth: SampleDepth,
    test: DepthTest<M>,
    pixel: PhantomData<P>,
}

/// How the depths of a group are compared and kept.
#[derive(Clone, Copy)]
struct DepthTest<M: Lanes> {
    /// What is stored counts as no nearer than this.
    least: M::F,
    /// The largest level, if levels are kept in place of depths.
    most: Option<M::F>,
}

impl<M: Lanes> DepthTest<M> {
    #[inline(always)]
    fn new(m: M, depth: SampleDepth) -> Self {
        DepthTest {
            least: m.splat(if depth.hides() {
                f32::NEG_INFINITY
            } else {
                f32::INFINITY
            }),
            most: depth.most().map(
                #[inline(always)]
                |most| m.splat(most as f32),
            ),
        }
    }
}

impl<M: Lanes, P: Planes<M::F>> Cells<'_, M, P> {
    /// Gives the groups `groups` of row `row`, from left to right.
    #[inline(always)]
    pub fn each(
        &mut self,
        row: usize,
        groups: Range<usize>,
        mut visit: impl FnMut(&mut Cell<'_, M, P>),
    ) {
        let (mut first, end) = (
            row * self.a_row + groups.start,
            row * self.a_row + groups.end,
        );
        let size = size::<M, P>();
        for values in self.values[first * size..end * size].chunks_exact_mut(size) {
            visit(&mut Cell {
                values,
                materials: self.materials,
                number: first,
                test: self.test,
                pixel: PhantomData,
            });
            first += 1;
        }
    }

    /// Gives the groups from number `from` of the band up to number `to`, 0 or more, if there are any; their pixels have no materials.
    #[inline(always)]
    pub fn plain(&mut self, [from, to]: [i32; 2], mut visit: impl FnMut(&mut Cell<'_, M, P>)) {
        let size = size::<M, P>();
        // Not over a slice of the groups: that takes more registers than there are.
        let (mut from, to) = (from as u32 as usize, to as u32 as usize);
        while from < to {
            let Some(values) = self.values.get_mut(from..from + size) else {
                return;
            };
            visit(&mut Cell {
                values,
                materials: &mut [],
                number: 0,
                test: self.test,
                pixel: PhantomData,
            });
            from += size;
        }
    }

    /// Group `group` of row `row`, whose pixels have `MATERIALS` or none.
    #[inline(always)]
    pub fn cell<const MATERIALS: bool>(
        &mut self,
        row: usize,
        group: usize,
    ) -> Option<Cell<'_, M, P>> {
        let (number, size) = (row * self.a_row + group, size::<M, P>());
        let values = self.values.get_mut(number * size..(number + 1) * size)?;
        let materials: &mut [f32] = if MATERIALS { self.materials } else { &mut [] };
        Some(Cell {
            values,
            materials,
            number,
            test: self.test,
            pixel: PhantomData,
        })
    }

    /// How many numbers there are a row, and a group.
    #[inline(always)]
    pub fn row_and_group(&self) -> [usize; 2] {
        [self.a_row * size::<M, P>(), size::<M, P>()]
    }

    /// Stores one pixel, its depth and then its numbers, at a place that [`Layout::places`] gave.
    #[inline(always)]
    pub fn put_one(&mut self, place: i32, numbers: &[f32], material: u32) {
        // Places are 0 or more: so the end of what is stored is in bounds if it is at all.
        let (place, size) = (place as u32 as usize, size::<M, P>());
        let values = &mut self.values[place..place + (size - M::WIDTH + 1)];
        let numbers = &numbers[..size / M::WIDTH];
        let depth = self.depth.kept(numbers[0]);
        if !self.depth.hides() || depth < values[0] {
            values[0] = depth;
            let mut i = 1;
            while i < numbers.len() {
                values[i * M::WIDTH] = numbers[i];
                i += 1;
            }
            if !self.materials.is_empty() {
                self.materials[place / size * M::WIDTH + place % size] = f32::from_bits(material);
            }
        }
    }
}

/// Where the numbers of a band are, whatever they mean.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// Pixels a row, as there is room for.
    a_row: i32,
    /// Numbers a pixel: its depth and its planes.
    numbers: i32,
}

impl Layout {
    /// Where the first number of the pixel in row `row` and column `column` is, by triangle.
    #[inline(always)]
    pub fn places<M: Lanes>(self, m: M, row: M::I, column: M::I) -> M::I {
        let in_group = column & m.int(M::WIDTH as i32 - 1);
        // As many numbers a row as 32 bits hold: a band has at most 16 rows of them.
        (row * m.int(self.a_row) + (column - in_group)) * m.int(self.numbers) + in_group
    }
}

/// One group of pixels.
pub(crate) struct Cell<'a, M: Lanes, P> {
    values: &'a mut [f32],
    materials: &'a mut [f32],
    /// Its number in the band.
    number: usize,
    test: DepthTest<M>,
    pixel: PhantomData<P>,
}

impl<M: Lanes, P: Planes<M::F>> Cell<'_, M, P> {
    /// Stores `depth` and `pixel` where `outside` is not below 0 and `depth` is less than what was stored before; and `material`,
    /// where materials are stored.
    ///
    /// It writes in any case: which groups are seen, and which of them wholly, cannot be predicted where triangles are small.
    #[inline(always)]
    pub fn put(&mut self, m: M, outside: M::I, depth: M::F, pixel: P, material: u32) {
        let values = &mut self.values[..size::<M, P>()];
        let DepthTest { least, most } = self.test;
        let depth = match most {
            None => depth,
            Some(most) => level_of(m, depth, most),
        };
        let kept = m.kept(outside, depth, m.load(values).max(least));
        let mut at = 0;
        put_each(
            (depth, pixel),
            #[inline(always)]
            |new: M::F| {
                let place = &mut values[at..at + M::WIDTH];
                m.store(m.keep(kept, m.load(place), new), place);
                at += M::WIDTH;
            },
        );
        if !self.materials.is_empty() {
            let place = &mut self.materials[self.number * M::WIDTH..][..M::WIDTH];
            m.store(
                m.keep(kept, m.load(place), m.splat(f32::from_bits(material))),
                place,
            );
        }
    }
}
