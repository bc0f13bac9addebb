//! Small triangles, group by group: narrow ones row by row of their boxes, others between the limits of each row.

use super::band::{Cell, Cells, MOST_PLANES};
use super::batch::{Batch, Small};
use super::facets::{Facet, Facets};
use super::fill::facets;
use super::triangle::{Groups, Line, Starts};
use crate::number::{Lanes, Num, Planes, get_each};

/// A depth, and the numbers that pixels are given.
type Numbers<F> = [F; 1 + MOST_PLANES];

/// A small triangle that is drawn group by group.
///
/// Its numbers are exact, but for roundings, at the first pixel of its first group, or of the first one of each row, and grow from there:
/// finding them anew in each group took 46 instructions a group where 28 do now (`phong-rsqrt`, AVX2).
///
/// That costs accuracy where a triangle is thin. Barycentric coordinates are in 0..=1 where it is covered and grow by at most
/// [`STEEPEST`](super::batch::STEEPEST) a pixel. A covered pixel is at most 15 rows and 15 columns from where numbers begin, so that no
/// coordinate is over 121 on the way; 6 roundings of that where they begin, one of each of 17 sums, and 6 of each of 30 steps, are below
/// 3600 · 2⁻²⁴, which is below 2⁻¹² of how far corners are apart. Along a row, from its first group on, it is less: where a coordinate
/// grows by more than 1 a pixel no two pixels of a row are covered. A triangle that is 2 pixels thick is within 2⁻¹⁵.
pub(super) struct SmallTriangle<'a, M: Lanes> {
    small: Small<'a>,
    groups: Groups<M>,
    /// Those of its batch, and its number in it.
    facets: (&'a Facets, usize),
    material: u32,
}

impl<'a, M: Lanes> SmallTriangle<'a, M> {
    /// Triangle number `k` of a batch.
    #[inline(always)]
    pub fn new(m: M, batch: &'a Batch, k: usize) -> Self {
        let small = batch.small(k);
        SmallTriangle {
            groups: Groups::new(m, &small),
            small,
            facets: (&batch.facets, k),
            material: batch.material(k),
        }
    }

    /// Draws it into the band that begins with row `top`, with its material if pixels have `MATERIALS`.
    #[inline(always)]
    pub fn draw<const MATERIALS: bool, P: Planes<M::F>>(
        &self,
        m: M,
        starts: &mut Starts,
        top: usize,
        cells: &mut Cells<'_, M, P>,
    ) {
        let [first, end] = self.groups.groups;
        if end - first <= 2 {
            self.narrow::<MATERIALS, P>(m, top, cells);
        } else {
            self.wide::<MATERIALS, P>(m, starts, top, cells);
        }
    }

    /// One or two groups a row: all of them are looked at. Limits would take longer than what they spare.
    #[inline(always)]
    fn narrow<const MATERIALS: bool, P: Planes<M::F>>(
        &self,
        m: M,
        top: usize,
        cells: &mut Cells<'_, M, P>,
    ) {
        let [first, end] = self.groups.groups;
        let has_two = end - first == 2;
        let (growth, down) = (
            self.growth::<P>(m, self.small.growth()),
            self.growth::<P>(m, self.small.fall()),
        );
        let mut functions = self.groups.first(m, &self.small);
        let (all, k) = self.facets;
        let start = all.at(m, k, facets::<M::F, P>(), self.small.weights());
        let (counted, width) = (m.number(m.counted()), m.splat(M::WIDTH as f32));
        let (mut at, mut across) = (growth, growth);
        let mut i = 0;
        while i < facets::<M::F, P>() {
            at[i] = growth[i].mul_add(counted, m.splat(start[i]));
            across[i] = growth[i] * width;
            i += 1;
        }
        for row in self.small.rows(top) {
            if let Some(mut cell) = cells.cell::<MATERIALS>(row, first) {
                self.put(m, &mut cell, functions, &at);
            }
            if has_two && let Some(mut cell) = cells.cell::<MATERIALS>(row, first + 1) {
                self.put(
                    m,
                    &mut cell,
                    self.groups.beside(functions),
                    &Self::grown::<P>(at, &across),
                );
            }
            functions = self.groups.below(functions);
            at = Self::grown::<P>(at, &down);
        }
    }

    /// Any number of groups a row, between the limits of each row.
    #[inline(always)]
    fn wide<const MATERIALS: bool, P: Planes<M::F>>(
        &self,
        m: M,
        starts: &mut Starts,
        top: usize,
        cells: &mut Cells<'_, M, P>,
    ) {
        let (all, k) = self.facets;
        let (mut across, mut ramps) = (
            self.growth::<P>(m, self.small.growth()),
            [m.splat(0.0); 1 + MOST_PLANES],
        );
        let (counted, width) = (m.number(m.counted()), m.splat(M::WIDTH as f32));
        let mut i = 0;
        while i < facets::<M::F, P>() {
            (across[i], ramps[i]) = (across[i] * width, across[i] * counted);
            i += 1;
        }
        self.groups.rows(
            m,
            (&self.small, top),
            cells.row_and_group(),
            starts,
            (
                facets::<M::F, P>(),
                #[inline(always)]
                |i, weights| Facet::of(all, i, k).lanes(m, weights),
            ),
            #[inline(always)]
            |line, starts| {
                let mut functions = self.groups.of_line(m, starts, &line);
                let (
                    Line {
                        row,
                        groups,
                        numbers,
                        of_eight,
                    },
                    mut at,
                ) = (line, ramps);
                let mut i = 0;
                while i < facets::<M::F, P>() {
                    at[i] = m.splat(starts.values[i][of_eight]) + ramps[i];
                    i += 1;
                }
                if !MATERIALS {
                    cells.plain(
                        numbers,
                        #[inline(always)]
                        |cell| self.put_next(m, cell, &mut functions, &mut at, &across),
                    );
                } else if groups.start < groups.end {
                    cells.each(
                        row,
                        groups,
                        #[inline(always)]
                        |cell| self.put_next(m, cell, &mut functions, &mut at, &across),
                    );
                }
            },
        );
    }

    /// Draws a group; `functions` and `at` are those of the group beside then.
    #[inline(always)]
    fn put_next<P: Planes<M::F>>(
        &self,
        m: M,
        cell: &mut Cell<'_, M, P>,
        functions: &mut [M::I; 3],
        at: &mut Numbers<M::F>,
        across: &Numbers<M::F>,
    ) {
        self.put(m, cell, *functions, at);
        *functions = self.groups.beside(*functions);
        *at = Self::grown::<P>(*at, across);
    }

    /// Draws a group with these edge functions and numbers.
    #[inline(always)]
    fn put<P: Planes<M::F>>(
        &self,
        m: M,
        cell: &mut Cell<'_, M, P>,
        functions: [M::I; 3],
        at: &Numbers<M::F>,
    ) {
        let mut i = 0;
        let pixel = get_each(
            #[inline(always)]
            || {
                i += 1;
                at[i]
            },
        );
        cell.put(
            m,
            Groups::<M>::outside(functions),
            at[0],
            pixel,
            self.material,
        );
    }

    /// How much its numbers grow where the coordinates grow by `growth`.
    #[inline(always)]
    fn growth<P: Planes<M::F>>(&self, m: M, growth: [f32; 2]) -> Numbers<M::F> {
        let (all, k) = self.facets;
        let steps = all.growth(m, k, facets::<M::F, P>(), growth);
        let mut grown = [m.splat(0.0); 1 + MOST_PLANES];
        let mut i = 0;
        while i < facets::<M::F, P>() {
            grown[i] = m.splat(steps[i]);
            i += 1;
        }
        grown
    }

    /// The numbers `at`, grown by `growth`.
    #[inline(always)]
    fn grown<P: Planes<M::F>>(mut at: Numbers<M::F>, growth: &Numbers<M::F>) -> Numbers<M::F> {
        let mut i = 0;
        while i < facets::<M::F, P>() {
            at[i] = at[i] + growth[i];
            i += 1;
        }
        at
    }
}
