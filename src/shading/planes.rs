//! Values that are made of numbers, one plane of the G-buffer each.

use crate::number::{Num, Vec3};

/// A value that is made of numbers: a number, a vector, a tuple of them, or one a light.
pub trait Planes<F: Num>: Copy {
    /// Returns how many numbers it has where there are `lights` lights.
    fn count(lights: usize) -> usize;
    /// Gives its numbers in order, with indices from `next` on.
    fn put(self, next: &mut usize, to: &mut impl FnMut(usize, F));
    /// Takes as many numbers by their indices.
    fn get(lights: usize, next: &mut usize, from: impl Fn(usize) -> F + Copy) -> Self;
    /// Returns `of` the numbers of two values, number by number.
    fn zip(self, other: Self, of: impl Fn(F, F) -> F + Copy) -> Self;
}

/// Gives each number of `value` with its index to a closure that is inlined: only an argument itself can say that.
#[inline(always)]
pub(crate) fn put_each<F: Num, P: Planes<F>>(value: P, mut to: impl FnMut(usize, F)) {
    value.put(&mut 0, &mut to);
}

/// Makes a value of the numbers that a closure gives for their indices.
#[inline(always)]
pub(crate) fn get_each<F: Num, P: Planes<F>>(lights: usize, from: impl Fn(usize) -> F + Copy) -> P {
    P::get(lights, &mut 0, from)
}

/// Returns the sum, number by number.
#[inline(always)]
pub(crate) fn sum<F: Num, P: Planes<F>>(a: P, b: P) -> P {
    a.zip(
        b,
        #[inline(always)]
        |a, b| a + b,
    )
}

/// Returns a value times a factor, number by number.
#[inline(always)]
pub(crate) fn scaled<F: Num, P: Planes<F>>(value: P, factor: F) -> P {
    value.zip(
        value,
        #[inline(always)]
        |number, _| number * factor,
    )
}

impl<F: Num> Planes<F> for F {
    #[inline(always)]
    fn count(_: usize) -> usize {
        1
    }
    #[inline(always)]
    fn put(self, next: &mut usize, to: &mut impl FnMut(usize, F)) {
        to(*next, self);
        *next += 1;
    }
    #[inline(always)]
    fn get(_: usize, next: &mut usize, from: impl Fn(usize) -> F + Copy) -> Self {
        *next += 1;
        from(*next - 1)
    }
    #[inline(always)]
    fn zip(self, other: Self, of: impl Fn(F, F) -> F + Copy) -> Self {
        of(self, other)
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
            fn put(self, next: &mut usize, to: &mut impl FnMut(usize, F)) {
                $(self.$field.put(next, to);)+
            }
            #[inline(always)]
            fn get(lights: usize, next: &mut usize, from: impl Fn(usize) -> F + Copy) -> Self {
                #[allow(clippy::redundant_closure_call)] // the fields in order
                ($make)($(<$kind as Planes<F>>::get(lights, next, from)),+)
            }
            #[inline(always)]
            fn zip(self, other: Self, of: impl Fn(F, F) -> F + Copy) -> Self {
                #[allow(clippy::redundant_closure_call)] // likewise
                ($make)($(self.$field.zip(other.$field, of)),+)
            }
        }
    };
}
pub(super) use planes;

planes!([] Vec3<F>, { x: F, y: F, z: F }, |x, y, z| Vec3 { x, y, z });
planes!([A: Planes, B: Planes] (A, B), { 0: A, 1: B }, |a, b| (a, b));
planes!([A: Planes, B: Planes, C: Planes] (A, B, C), { 0: A, 1: B, 2: C }, |a, b, c| (a, b, c));

/// For so many lights all numbers are stepped and stored, without a count: they stay in registers.
const MOST_UNROLLED: usize = 8;

/// One value a light, for up to `L` lights; those of lights that there are, or all where they are few.
#[derive(Clone, Copy, Debug)]
pub struct PerLight<F, const L: usize> {
    values: [F; L],
    pub(super) count: usize,
}

impl<F: Copy, const L: usize> PerLight<F, L> {
    /// Makes room for the values of `lights` lights, all of them `first`.
    #[inline(always)]
    pub fn new(lights: usize, first: F) -> Self {
        PerLight {
            values: [first; L],
            count: lights,
        }
    }

    /// Returns how many values are stepped and stored.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        if L <= MOST_UNROLLED { L } else { self.count }
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
        PerLight::<(), L>::new(lights, ()).len()
    }
    #[inline(always)]
    fn put(self, next: &mut usize, to: &mut impl FnMut(usize, F)) {
        let mut i = 0;
        while i < self.len() {
            self[i].put(next, to);
            i += 1;
        }
    }
    #[inline(always)]
    fn get(lights: usize, next: &mut usize, from: impl Fn(usize) -> F + Copy) -> Self {
        let mut all = Self::new(lights, F::get(lights, next, from));
        let mut i = 1;
        while i < all.len() {
            all[i] = F::get(lights, next, from);
            i += 1;
        }
        all
    }
    #[inline(always)]
    fn zip(mut self, other: Self, of: impl Fn(F, F) -> F + Copy) -> Self {
        let mut i = 0;
        while i < self.len() {
            self[i] = of(self[i], other[i]);
            i += 1;
        }
        self
    }
}
