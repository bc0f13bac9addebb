//! Groups of values: varyings, pixels, a polygon's constants. In the G-buffer each value of a
//! varying or pixel has its own place.

use crate::number::{Num, Vec3};

/// A group of values: one value, a vector, a tuple of groups, or one value per light.
pub trait Values<F: Num>: Copy {
    /// The most lights that the group has values for.
    const LIGHTS: usize = usize::MAX;
    /// Makes a group for `lights` lights whose values are all `value`.
    fn filled(lights: usize, value: F) -> Self;
    /// Passes the values to `to` in order, to be read or changed. Their indices begin at `next`,
    /// which moves on.
    fn each(&mut self, next: &mut usize, to: &mut impl FnMut(usize, &mut F));
    /// Replaces each value x by `of(x, y)`, where y is the value at the same index of `other`.
    fn zip(&mut self, other: Self, of: impl Fn(F, F) -> F + Copy);
}

/// Calls `to` with the index and a reference of each value, and returns the changed group. It is a
/// function because a closure can be marked `#[inline(always)]` only as an argument.
#[inline(always)]
pub(crate) fn each<F: Num, P: Values<F>>(mut value: P, mut to: impl FnMut(usize, &mut F)) -> P {
    value.each(&mut 0, &mut to);
    value
}

/// Returns how many values a group has for `lights` lights.
#[inline(always)]
pub(crate) fn count<P: Values<f32>>(lights: usize) -> usize {
    let mut count = 0;
    // `each` leaves the index after the last value, which is the count.
    P::filled(lights, 0.0).each(&mut count, &mut |_, _| ());
    count
}

/// Returns a group whose values are multiplied by `factor`.
#[inline(always)]
pub(crate) fn scaled<F: Num, P: Values<F>>(group: P, factor: F) -> P {
    each(group, |_, value| *value = *value * factor)
}

/// Returns the sum of groups, value by value.
#[inline(always)]
pub(crate) fn sum<F: Num, P: Values<F>, const N: usize>(all: [P; N]) -> P {
    let mut sum = all[0];
    for other in &all[1..] {
        sum.zip(*other, |a, b| a + b);
    }
    sum
}

/// The empty group.
impl<F: Num> Values<F> for () {
    #[inline(always)]
    fn filled(_: usize, _: F) {}
    #[inline(always)]
    fn each(&mut self, _: &mut usize, _: &mut impl FnMut(usize, &mut F)) {}
    #[inline(always)]
    fn zip(&mut self, _: (), _: impl Fn(F, F) -> F + Copy) {}
}

impl<F: Num, P: Values<F>, const N: usize> Values<F> for [P; N] {
    const LIGHTS: usize = P::LIGHTS;
    #[inline(always)]
    fn filled(lights: usize, value: F) -> Self {
        [P::filled(lights, value); N]
    }
    #[inline(always)]
    fn each(&mut self, next: &mut usize, to: &mut impl FnMut(usize, &mut F)) {
        for value in self {
            value.each(next, to);
        }
    }
    #[inline(always)]
    fn zip(&mut self, other: Self, of: impl Fn(F, F) -> F + Copy) {
        for (value, other) in self.iter_mut().zip(other) {
            value.zip(other, of);
        }
    }
}

impl<F: Num> Values<F> for F {
    #[inline(always)]
    fn filled(_: usize, value: F) -> F {
        value
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

/// Returns the least of some counts.
pub(crate) const fn least(mut counts: &[usize]) -> usize {
    let mut least = usize::MAX;
    while let [count, rest @ ..] = counts {
        if *count < least {
            least = *count;
        }
        counts = rest;
    }
    least
}

/// Implements [`Values`] for a structure, with its fields in order.
macro_rules! values {
    ([$($parameter:ident),*] $name:ty, { $($field:tt: $kind:ty),+ }, $make:expr) => {
        impl<F: Num, $($parameter: Values<F>),*> Values<F> for $name {
            const LIGHTS: usize = $crate::shading::walks::values::least(&[$(<$kind as Values<F>>::LIGHTS),+]);
            #[inline(always)]
            fn filled(lights: usize, value: F) -> Self {
                #[allow(clippy::redundant_closure_call)] // the fields in order
                ($make)($(<$kind as Values<F>>::filled(lights, value)),+)
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

pub(crate) use values;

values!([] Vec3<F>, { x: F, y: F, z: F }, |x, y, z| Vec3 { x, y, z });
values!([A, B] (A, B), { 0: A, 1: B }, |a, b| (a, b));
values!([A, B, C] (A, B, C), { 0: A, 1: B, 2: C }, |a, b, c| (a, b, c));

/// The most lights for which all places are stepped and stored, without a count, so that the values
/// stay in registers.
const MOST_UNROLLED: usize = 4;

/// One value per light, for up to `L` lights. Only the values of lights that exist are stored, or
/// all `L` if they are few.
#[derive(Clone, Copy, Debug)]
pub struct PerLight<F, const L: usize> {
    /// The value of each light. Values after the last light are never shaded.
    pub values: [F; L],
    pub(crate) count: usize,
}

impl<F: Copy, const L: usize> PerLight<F, L> {
    /// Makes the values for `lights` lights, all of them `first`.
    #[inline(always)]
    pub fn new(lights: usize, first: F) -> Self {
        PerLight {
            values: [first; L],
            count: lights,
        }
    }

    /// Returns how many values are stepped and stored.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        if L <= MOST_UNROLLED { L } else { self.count }
    }
}

impl<F: Num, const L: usize> Values<F> for PerLight<F, L> {
    const LIGHTS: usize = L;
    #[inline(always)]
    fn filled(lights: usize, value: F) -> Self {
        Self::new(lights, value)
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

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Stores a group for `lights` lights, loads it again, and returns its values.
    fn put_and_taken<P: Values<f32>>(lights: usize, value: P) -> Vec<f32> {
        let all = |value: P| {
            let mut all = Vec::new();
            each(value, |_, x: &mut f32| all.push(*x));
            all
        };
        let values = all(value);
        assert_eq!(count::<P>(lights), values.len());
        let back = each(P::filled(lights, 0.0), |i, x| *x = values[i]);
        assert_eq!(all(back), values);
        let twice: Vec<f32> = values.iter().map(|x| x + x).collect();
        let mut sum = value;
        sum.zip(back, |a, b| a + b);
        assert_eq!(all(sum), twice);
        values
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
        assert_eq!(put_and_taken(1, (1.0, v(2.0))), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(
            put_and_taken(1, (1.0, 2.0, (3.0, 4.0))),
            [1.0, 2.0, 3.0, 4.0]
        );
        assert_eq!(
            put_and_taken(1, [(1.0, 2.0), (3.0, 4.0)]),
            [1.0, 2.0, 3.0, 4.0]
        );
        assert!(put_and_taken(1, ()).is_empty());
    }

    /// With up to 4 lights all places are stepped; with more, only the places of lights that exist.
    #[test]
    fn there_is_a_value_for_each_light() {
        fn of<const L: usize>(lights: usize) -> Vec<f32> {
            let mut all = PerLight::<f32, L>::new(lights, 0.5);
            (0..lights).for_each(|i| all.values[i] = i as f32);
            put_and_taken(lights, all)
        }
        assert_eq!(of::<1>(1), [0.0]);
        assert_eq!(of::<4>(3), [0.0, 1.0, 2.0, 0.5]);
        assert_eq!(of::<64>(3), [0.0, 1.0, 2.0]);
        assert_eq!(of::<64>(64).len(), 64);
    }
}
