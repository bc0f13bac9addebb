//! Values that are made of numbers, one plane of the G-buffer each.

use crate::number::{Num, Vec3};

/// A value that is made of numbers: a number, a vector, a tuple of them, or one per light.
pub trait Planes<F: Num>: Copy {
    /// Makes a value for `lights` lights of nothing but `number`.
    fn filled(lights: usize, number: F) -> Self;
    /// Gives its numbers in order, to be read or changed, with indices from `next` on.
    fn each(&mut self, next: &mut usize, to: &mut impl FnMut(usize, &mut F));
    /// Replaces its numbers by `of` them and those of another value, number by number.
    fn zip(&mut self, other: Self, of: impl Fn(F, F) -> F + Copy);
}

/// Gives each number of `value` with its index to a closure that is inlined: only an argument itself can say that. Returns the
/// value as the closure leaves it.
#[inline(always)]
pub(crate) fn each<F: Num, P: Planes<F>>(mut value: P, mut to: impl FnMut(usize, &mut F)) -> P {
    value.each(&mut 0, &mut to);
    value
}

/// Returns the number of numbers in a value for `lights` lights.
#[inline(always)]
pub(crate) fn count<P: Planes<f32>>(lights: usize) -> usize {
    let mut count = 0;
    P::filled(lights, 0.0).each(&mut count, &mut |_, _| ());
    count
}

/// Returns a value times a factor, number by number.
#[inline(always)]
pub(crate) fn scaled<F: Num, P: Planes<F>>(value: P, factor: F) -> P {
    each(value, |_, number| *number = *number * factor)
}

impl<F: Num> Planes<F> for F {
    #[inline(always)]
    fn filled(_: usize, number: F) -> F {
        number
    }
    #[inline(always)]
    fn each(&mut self, next: &mut usize, to: &mut impl FnMut(usize, &mut F)) {
        to(*next, self);
        *next += 1;
    }
    #[inline(always)]
    fn zip(&mut self, other: F, of: impl Fn(F, F) -> F + Copy) {
        *self = of(*self, other);
    }
}

/// Implements [`Planes`] for a structure: its fields in order.
macro_rules! planes {
    ([$($parameter:ident),*] $name:ty, { $($field:tt: $kind:ty),+ }, $make:expr) => {
        impl<F: Num, $($parameter: Planes<F>),*> Planes<F> for $name {
            #[inline(always)]
            fn filled(lights: usize, number: F) -> Self {
                #[allow(clippy::redundant_closure_call)] // the fields in order
                ($make)($(<$kind as Planes<F>>::filled(lights, number)),+)
            }
            #[inline(always)]
            fn each(&mut self, next: &mut usize, to: &mut impl FnMut(usize, &mut F)) {
                $(self.$field.each(next, to);)+
            }
            #[inline(always)]
            fn zip(&mut self, other: Self, of: impl Fn(F, F) -> F + Copy) {
                $(self.$field.zip(other.$field, of);)+
            }
        }
    };
}
pub(super) use planes;

planes!([] Vec3<F>, { x: F, y: F, z: F }, |x, y, z| Vec3 { x, y, z });
planes!([A, B] (A, B), { 0: A, 1: B }, |a, b| (a, b));
planes!([A, B, C] (A, B, C), { 0: A, 1: B, 2: C }, |a, b, c| (a, b, c));

/// For so many lights all numbers are stepped and stored, without a count: they stay in registers.
const MOST_UNROLLED: usize = 8;

/// One value per light, for up to `L` lights; only the lights that exist are stored, or all `L` if they are few.
#[derive(Clone, Copy, Debug)]
pub struct PerLight<F, const L: usize> {
    /// The value of each light; those after the last light are never read.
    pub values: [F; L],
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

    /// Returns the number of values that are stepped and stored.
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        if L <= MOST_UNROLLED { L } else { self.count }
    }
}

impl<F: Num, const L: usize> Planes<F> for PerLight<F, L> {
    #[inline(always)]
    fn filled(lights: usize, number: F) -> Self {
        Self::new(lights, number)
    }
    #[inline(always)]
    fn each(&mut self, next: &mut usize, to: &mut impl FnMut(usize, &mut F)) {
        for i in 0..self.len() {
            self.values[i].each(next, to);
        }
    }
    #[inline(always)]
    fn zip(&mut self, other: Self, of: impl Fn(F, F) -> F + Copy) {
        for i in 0..self.len() {
            self.values[i] = of(self.values[i], other.values[i]);
        }
    }
}
