//! Values that are made of numbers, one plane of the G-buffer each.

use crate::number::{Num, Vec3};

/// A value that is made of numbers: a number, a vector, a tuple of them, or one a light.
pub trait Planes<F: Num>: Copy {
    /// Returns how many numbers it has where there are `lights` lights.
    fn count(lights: usize) -> usize;
    /// Gives its numbers in order.
    fn put(self, to: &mut impl FnMut(F));
    /// Takes as many numbers in the same order.
    fn get(lights: usize, from: &mut impl FnMut() -> F) -> Self;
    /// Returns the sum, number by number.
    fn plus(self, step: Self) -> Self;
}

/// Gives the numbers of `value` in order, to a closure that is inlined: only an argument itself can say that.
#[inline(always)]
pub(crate) fn put_each<F: Num, P: Planes<F>>(value: P, mut to: impl FnMut(F)) {
    value.put(&mut to);
}

/// Takes the numbers of a value in order, likewise.
#[inline(always)]
pub(crate) fn get_each<F: Num, P: Planes<F>>(lights: usize, mut from: impl FnMut() -> F) -> P {
    P::get(lights, &mut from)
}

impl<F: Num> Planes<F> for F {
    #[inline(always)]
    fn count(_: usize) -> usize {
        1
    }
    #[inline(always)]
    fn put(self, to: &mut impl FnMut(F)) {
        to(self);
    }
    #[inline(always)]
    fn get(_: usize, from: &mut impl FnMut() -> F) -> Self {
        from()
    }
    #[inline(always)]
    fn plus(self, step: Self) -> Self {
        self + step
    }
}

/// A structure as the planes of its fields, in order.
macro_rules! planes {
    ([$($parameter:ident: $bound:ident),*] $name:ty, { $($field:tt: $kind:ty),+ }, $make:expr) => {
        impl<F: Num, $($parameter: $bound<F>),*> Planes<F> for $name {
            #[inline(always)]
            fn count(lights: usize) -> usize {
                0 $(+ <$kind as Planes<F>>::count(lights))+
            }
            #[inline(always)]
            fn put(self, to: &mut impl FnMut(F)) {
                $(self.$field.put(to);)+
            }
            #[inline(always)]
            fn get(lights: usize, from: &mut impl FnMut() -> F) -> Self {
                #[allow(clippy::redundant_closure_call)] // the fields in order
                ($make)($(<$kind as Planes<F>>::get(lights, from)),+)
            }
            #[inline(always)]
            fn plus(self, step: Self) -> Self {
                #[allow(clippy::redundant_closure_call)]
                ($make)($(Planes::<F>::plus(self.$field, step.$field)),+)
            }
        }
    };
}
pub(super) use planes;

planes!([] Vec3<F>, { x: F, y: F, z: F }, |x, y, z| Vec3 { x, y, z });
planes!([A: Planes, B: Planes] (A, B), { 0: A, 1: B }, |a, b| (a, b));
planes!([A: Planes, B: Planes, C: Planes] (A, B, C), { 0: A, 1: B, 2: C }, |a, b, c| (a, b, c));
impl<F: Num, const N: usize> Planes<F> for [F; N] {
    #[inline(always)]
    fn count(_: usize) -> usize {
        N
    }
    #[inline(always)]
    fn put(self, to: &mut impl FnMut(F)) {
        let mut i = 0;
        while i < N {
            to(self[i]);
            i += 1;
        }
    }
    #[inline(always)]
    fn get(_: usize, from: &mut impl FnMut() -> F) -> Self {
        let mut all = [from(); N];
        let mut i = 1;
        while i < N {
            all[i] = from();
            i += 1;
        }
        all
    }
    #[inline(always)]
    fn plus(mut self, step: Self) -> Self {
        let mut i = 0;
        while i < N {
            self[i] = self[i] + step[i];
            i += 1;
        }
        self
    }
}

/// For so many lights all numbers are stepped and stored, without a count: they stay in registers.
const MOST_UNROLLED: usize = 8;

/// One number a light, for up to `L` lights; those of lights that there are, or all where they are few.
#[derive(Clone, Copy, Debug)]
pub struct PerLight<F, const L: usize> {
    values: [F; L],
    count: usize,
}

impl<F: Num, const L: usize> PerLight<F, L> {
    /// Makes room for the numbers of `lights` lights, all of them `first`.
    #[inline(always)]
    pub fn new(lights: usize, first: F) -> Self {
        PerLight {
            values: [first; L],
            count: if L <= MOST_UNROLLED { L } else { lights },
        }
    }
}

impl<F, const L: usize> core::ops::Index<usize> for PerLight<F, L> {
    type Output = F;
    #[inline(always)]
    fn index(&self, light: usize) -> &F {
        &self.values[light]
    }
}

impl<F, const L: usize> core::ops::IndexMut<usize> for PerLight<F, L> {
    #[inline(always)]
    fn index_mut(&mut self, light: usize) -> &mut F {
        &mut self.values[light]
    }
}

impl<F: Num, const L: usize> Planes<F> for PerLight<F, L> {
    #[inline(always)]
    fn count(lights: usize) -> usize {
        if L <= MOST_UNROLLED { L } else { lights }
    }
    #[inline(always)]
    fn put(self, to: &mut impl FnMut(F)) {
        let mut i = 0;
        while i < if L <= MOST_UNROLLED { L } else { self.count } {
            to(self.values[i]);
            i += 1;
        }
    }
    #[inline(always)]
    fn get(lights: usize, from: &mut impl FnMut() -> F) -> Self {
        let mut all = Self::new(lights, from());
        let mut i = 1;
        while i < if L <= MOST_UNROLLED { L } else { lights } {
            all.values[i] = from();
            i += 1;
        }
        all
    }
    #[inline(always)]
    fn plus(mut self, step: Self) -> Self {
        let mut i = 0;
        while i < if L <= MOST_UNROLLED { L } else { self.count } {
            self.values[i] = self.values[i] + step.values[i];
            i += 1;
        }
        self
    }
}
