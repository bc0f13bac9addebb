//! Varyings: what vertices carry and spans interpolate, as numbers in memory.

use crate::number::{Num, Vec3};
use crate::shading::increments::{GreatCircle, Linear, Sines};

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

/// What a vertex carries, and what interpolation makes of it along a span.
pub trait Varying<F: Num>: Planes<F> {
    /// What a span starts from: [`Linear`], or [`GreatCircle`] for unit normals.
    type Span: Planes<F>;
    /// True if edges and spans are great circles.
    const GREAT_CIRCLE: bool = false;
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
planes!([] Vec3<F>, { x: F, y: F, z: F }, |x, y, z| Vec3 { x, y, z });
planes!([A: Planes, B: Planes] (A, B), { 0: A, 1: B }, |a, b| (a, b));
planes!([A: Planes, B: Planes, C: Planes] (A, B, C), { 0: A, 1: B, 2: C }, |a, b, c| (a, b, c));
planes!([V: Planes] Linear<V>, { at: V, step: V }, |at, step| Linear { at, step });
planes!([] UnitNormal<F>, { 0: Vec3<F> }, UnitNormal);
planes!(
    [] GreatCircle<F>,
    { from: Vec3<F>, to: Vec3<F>, sines: Sines<F> },
    |from, to, sines| GreatCircle { from, to, sines }
);
planes!([] Sines<F>, { t: [F; 2], rest: [F; 2], step: [F; 2] }, |t, rest, step| Sines {
    t,
    rest,
    step
});

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

/// A unit normal, interpolated along the great circle at uniform speed (L21 4.7).
#[derive(Clone, Copy, Debug)]
pub struct UnitNormal<F>(pub Vec3<F>);

impl<F: Num> Varying<F> for UnitNormal<F> {
    type Span = GreatCircle<F>;
    const GREAT_CIRCLE: bool = true;
}

impl<F: Num> Varying<F> for Vec3<F> {
    type Span = Linear<Self>;
}

impl<F: Num, A: Planes<F>, B: Planes<F>> Varying<F> for (A, B) {
    type Span = Linear<Self>;
}

impl<F: Num, A: Planes<F>, B: Planes<F>, C: Planes<F>> Varying<F> for (A, B, C) {
    type Span = Linear<Self>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Puts a value and takes it back, where there are `lights` lights; returns its numbers.
    fn put_and_taken<P: Planes<f32>>(lights: usize, value: P) -> Vec<f32> {
        let all = |value: P| {
            let mut all = Vec::new();
            put_each(value, |x| all.push(x));
            all
        };
        let numbers = all(value);
        assert_eq!(P::count(lights), numbers.len());
        let mut rest = numbers.iter();
        let back: P = get_each(lights, || *rest.next().expect("as many as were put"));
        assert_eq!(rest.next(), None, "all numbers are taken");
        assert_eq!(all(back), numbers);
        let twice: Vec<f32> = numbers.iter().map(|x| x + x).collect();
        assert_eq!(all(value.plus(back)), twice);
        numbers
    }

    #[test]
    fn values_come_back_as_they_were_put() {
        let v = |x: f32| Vec3 {
            x,
            y: x + 1.0,
            z: x + 2.0,
        };
        assert_eq!(put_and_taken(1, 4.0), [4.0]);
        assert_eq!(put_and_taken(1, v(1.0)), [1.0, 2.0, 3.0]);
        assert_eq!(put_and_taken(1, UnitNormal(v(1.0))), [1.0, 2.0, 3.0]);
        assert_eq!(put_and_taken(1, [1.0, 2.0]), [1.0, 2.0]);
        assert_eq!(put_and_taken(1, (1.0, v(2.0))), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(
            put_and_taken(1, (1.0, [2.0], (3.0, 4.0))),
            [1.0, 2.0, 3.0, 4.0]
        );
        let linear = Linear {
            at: (1.0, 2.0),
            step: (3.0, 4.0),
        };
        assert_eq!(put_and_taken(1, linear), [1.0, 2.0, 3.0, 4.0]);
        let sines = Sines {
            t: [7.0, 8.0],
            rest: [9.0, 10.0],
            step: [11.0, 12.0],
        };
        let circle = GreatCircle {
            from: v(1.0),
            to: v(4.0),
            sines,
        };
        let numbers: Vec<f32> = (1..=12).map(|x| x as f32).collect();
        assert_eq!(put_and_taken(1, circle), numbers);
    }

    /// Of few lights all that there is room for are stepped, of many as many as there are.
    #[test]
    fn there_is_a_number_for_each_light() {
        fn of<const L: usize>(lights: usize) -> Vec<f32> {
            let mut all = PerLight::<f32, L>::new(lights, 0.5);
            (0..lights).for_each(|i| all[i] = i as f32);
            put_and_taken(lights, all)
        }
        assert_eq!(of::<1>(1), [0.0]);
        assert_eq!(of::<4>(3), [0.0, 1.0, 2.0, 0.5]);
        assert_eq!(of::<64>(3), [0.0, 1.0, 2.0]);
        assert_eq!(of::<64>(64).len(), 64);
    }
}
